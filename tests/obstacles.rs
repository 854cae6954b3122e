//! Obstacles: they shield the tool, and the host moves them while the fluid runs.
#![allow(clippy::unwrap_used, clippy::panic)]

mod common;

use common::{JET, open};
use glam::{DQuat, DVec3};
use hapflow::engine::{Scene, Value, parse, settings};
use hapflow::haptics::ToolState;

/// A plate over the tool, in the jet.
fn shielded() -> Scene {
    let text = format!(
        "{JET}\n[[obstacle]]\nname = \"plate\"\nshape = \"disc\"\nradius = 0.04\nthickness = 0.008\n\
         position = [0.0, 0.028, 0.0]\n"
    );
    parse(&text, "shielded").unwrap()
}

#[test]
fn a_plate_shields_the_tool_until_the_host_takes_it_away() {
    let mut session = open(&shielded(), 2);
    let mut mover = session.take_obstacles().unwrap();
    assert_eq!(mover.count(), 1);
    let (mut servo, mut fluid) = (session.take_servo().unwrap(), session.take_fluid().unwrap());
    let mut run = |mover: &mut hapflow::engine::ObstacleMover, frames: std::ops::Range<i32>, x: f64| {
        let mut sum = 0.0;
        let count = f64::from(frames.end - frames.start);
        for k in frames {
            assert!(mover.set(0, DVec3::new(x, 0.028, 0.0), DQuat::IDENTITY));
            mover.publish();
            fluid.publish(f64::from(k) * 0.01);
            fluid.compute(f64::from(k) * 0.01);
            servo.tick(&ToolState::default(), f64::from(k) * 0.01, 1e-3);
            sum -= servo.newest().raw.force.y / count;
        }
        sum
    };
    run(&mut mover, 1..20, 0.0);
    let under = run(&mut mover, 20..40, 0.0);
    for k in 40..60 {
        run(&mut mover, k..k + 1, 0.003 * f64::from(k - 39));
    }
    run(&mut mover, 60..70, 0.06);
    let free = run(&mut mover, 70..90, 0.06);
    assert!(under < 0.02 && free > 0.1, "under the plate {under} N, free {free} N");
}

#[test]
fn what_cannot_be_is_refused() {
    let mut session = open(&shielded(), 1);
    let mut mover = session.take_obstacles().unwrap();
    assert!(session.take_obstacles().is_none());
    assert!(!mover.set(1, DVec3::ZERO, DQuat::IDENTITY));
    assert!(!mover.set(0, DVec3::NAN, DQuat::IDENTITY));
    assert!(!mover.set(0, DVec3::ZERO, DQuat::from_xyzw(0.0, 0.0, 0.0, 0.0)));
    assert!(session.set("obstacle.plate.shape", &Value::Text("sphere".into())).is_err());
    session.set("obstacle.plate.position", &Value::Vector(DVec3::X * 0.1)).unwrap();
    assert_eq!(session.get("obstacle.plate.position").unwrap(), Value::Vector(DVec3::X * 0.1));
    let twice = format!("{JET}\n[[obstacle]]\nname = \"a\"\n[[obstacle]]\nname = \"a\"\n");
    let text = parse(&twice, "twice.toml").unwrap_err().to_string();
    assert!(text.contains("obstacle name = \"a\": two of them"), "{text}");
    let mut scene = shielded();
    assert!(settings::set(&mut scene, "obstacle.plate.radius", &Value::Number(-1.0)).is_err());
}
