//! `hapflow scenes` and `hapflow devices`.

use hapflow_engine::settings::{SETTINGS, SOURCE_SETTINGS, Setting};
use hapflow_engine::{Scene, load, shipped};
use hapflow_fluid::Source;
use std::io::Write;

/// Prints a line; a closed pipe is no reason to fail.
fn say(line: &str) {
    let _ = writeln!(std::io::stdout(), "{line}");
}

/// Lists the shipped scenes, or all settings.
pub fn scenes(settings: bool) {
    if settings {
        return all_settings();
    }
    for (name, _) in shipped() {
        if let Ok(scene) = load(name) {
            say(&format!("{name:<18} {}", scene.about));
        }
    }
    say("\nRun one with `hapflow run NAME`, or a TOML file of your own with `hapflow run FILE`.");
}

fn all_settings() {
    say("| setting | default | allowed | live | what it does |");
    say("|---|---|---|---|---|");
    let scene = Scene::default();
    for setting in SETTINGS {
        row(setting, &scene, setting.path.to_string());
    }
    let source = Source {
        name: "NAME".into(),
        position: glam::DVec3::ZERO,
        direction: glam::DVec3::NEG_Y,
        diameter: 0.02,
        speed: 1.0,
        on: true,
        period: 0.0,
        duty: 1.0,
    };
    for setting in SOURCE_SETTINGS {
        row(setting, &source, format!("source.NAME.{}", setting.path));
    }
}

fn row<T>(setting: &Setting<T>, owner: &T, path: String) {
    let live = if setting.live { "yes" } else { "no" };
    let (value, allowed) = (setting.get(owner), setting.allowed());
    say(&format!("| {path} | {value} | {allowed} | {live} | {} |", setting.about.replace('|', "\\|")));
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
