//! What a recorded hand feels in a scene, on the virtual clock: the same each time, as fast as it goes.
//!
//! ```sh
//! cargo run --release --example replay -- tap tremor                  # a scene and a motion, by name or as files
//! cargo run --release --example replay -- tap run.csv run.motion_origin=scene fluid.viscosity=0.1
//! ```
//!
//! A motion is a CSV file with the columns time_s, x_m, y_m, z_m; so is what `hapflow run --record run.csv` wrote.

use hapflow::engine::run::{RunOptions, virtual_clock};
use hapflow::engine::{Parts, Scene, Value, load, settings};
use std::error::Error;
use std::ops::ControlFlow;

fn main() -> Result<(), Box<dyn Error>> {
    let mut words = std::env::args().skip(1);
    let (name, motion) = (words.next().unwrap_or("tap".into()), words.next().unwrap_or("tremor".into()));
    let mut scene = load(&name)?;
    set(&mut scene, "run.device", "replay")?;
    set(&mut scene, "run.motion", &motion)?;
    for word in words {
        let (path, value) =
            word.split_once('=').ok_or(format!("{word}: write it as path.to.setting=VALUE"))?;
        set(&mut scene, path, value)?;
    }
    let mut go_on = |_: hapflow::engine::run::Progress<'_>| ControlFlow::Continue(());
    let options = RunOptions {
        threads: 0,
        pictures_at: &[],
        record: None,
        parts: Parts::default(),
        guide: &mut |_| ControlFlow::Continue(()),
        progress: &mut go_on,
    };
    println!("time_s,fx_N,fy_N,fz_N");
    for tick in virtual_clock(&scene, options)?.recording.rows {
        let force = tick.sent.force;
        println!("{},{},{},{}", tick.time_s, force.x, force.y, force.z);
    }
    Ok(())
}

fn set(scene: &mut Scene, path: &str, value: &str) -> Result<(), Box<dyn Error>> {
    Ok(settings::set(scene, path, &Value::parse(value))?)
}
