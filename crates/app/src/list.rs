//! `hapflow scenes` and `hapflow devices`.

use crate::viscosity;
use hapflow_devices::DeviceInfo;
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

/// Lists the devices, those that are there and those that are not.
pub fn devices(json: bool) {
    let devices = hapflow_devices::list();
    if json {
        let all: Vec<_> = devices.iter().map(device_json).collect();
        return say(&format!("{:#}", serde_json::Value::Array(all)));
    }
    for device in devices {
        let there = device.presence();
        say(&format!("{:<16} {}", device.name, device.about));
        say(&format!("{:<16} {}", "", capabilities(&device)));
        match there {
            Ok(found) => say(&format!("{:<16} present: {found}", "")),
            Err(error) => say(&format!("{:<16} absent: {error}", "")),
        }
    }
    say("\nChoose one with `hapflow run --device NAME`; `--motion FILE` replays a recorded hand.");
}

/// What it can, without the limits that it does not have.
fn capabilities(device: &DeviceInfo) -> String {
    let kind = if device.hardware { "hardware" } else { "simulated" };
    let (sensed, driven) = (device.sensed_dof, device.driven_dof);
    let mut text = format!("{kind}, senses {sensed} and drives {driven} degrees of freedom");
    let limits = [
        (device.max_force_n, "N"),
        (device.max_stiffness_n_per_m, "N/m"),
        (device.max_damping_n_s_per_m, "N·s/m"),
    ];
    for (limit, unit) in limits.into_iter().filter(|(limit, _)| *limit > 0.0) {
        text += &format!(", up to {limit} {unit}");
    }
    let [x, y, z] = device.workspace_m.map(|size| (1e3 * size).round());
    if x > 0.0 {
        text += &format!(", over {x} x {y} x {z} mm");
    }
    text + &format!(", {} Hz", device.rate_hz)
}

fn device_json(device: &DeviceInfo) -> serde_json::Value {
    let there = device.presence();
    serde_json::json!({
        "name": device.name,
        "about": device.about,
        "hardware": device.hardware,
        "present": there.is_ok(),
        "found": there.unwrap_or_else(|error| error.to_string()),
        "sensed_dof": device.sensed_dof,
        "driven_dof": device.driven_dof,
        "max_force_N": device.max_force_n,
        "max_stiffness_N_per_m": device.max_stiffness_n_per_m,
        "max_damping_N_s_per_m": device.max_damping_n_s_per_m,
        "workspace_m": device.workspace_m,
        "rate_Hz": device.rate_hz,
    })
}
