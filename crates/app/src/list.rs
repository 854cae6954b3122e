//! `hapflow scenes` and `hapflow devices`.

use crate::viscosity;
use hapflow_engine::settings::table as settings_table;
use hapflow_engine::{load, shipped};
use std::io::Write;

/// Prints a line; a closed pipe is no reason to fail.
fn say(line: &str) {
    let _ = writeln!(std::io::stdout(), "{line}");
}

/// Lists the shipped scenes, or all settings.
pub fn scenes(settings: bool) {
    if settings {
        return say(&settings_table());
    }
    for (name, _) in shipped() {
        if let Ok(scene) = load(name) {
            say(&format!("{name:<18} {}", scene.about));
            say(&format!("{:<18} viscosity {}", "", viscosity::told(&scene)));
        }
    }
    say("\nRun one with `hapflow run NAME`, or a TOML file of your own with `hapflow run FILE`.");
}

/// Lists the devices.
pub fn devices() {
    for device in hapflow_devices::list() {
        let hardware = if device.hardware { "hardware" } else { "simulated" };
        say(&format!(
            "{:<8} {hardware}, senses {} and drives {} degrees of freedom, up to {} N: {}",
            device.name, device.sensed_dof, device.driven_dof, device.max_force_n, device.about
        ));
    }
    say("\nChoose one with `hapflow run --set run.device=NAME`; `--motion FILE` replays a recorded hand.");
}
