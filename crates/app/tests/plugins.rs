//! `hapflow run --plugin`, with the plugins of the examples.
#![allow(clippy::unwrap_used, clippy::panic)]

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

fn scratch() -> &'static Path {
    Path::new(env!("CARGO_TARGET_TMPDIR"))
}

/// `libNAME.so` of a source, with words for the compiler.
fn built(compiler: &str, source: &Path, name: &str, words: &[&str]) -> PathBuf {
    let (root, made) =
        (Path::new(env!("CARGO_MANIFEST_DIR")).join("../.."), scratch().join(format!("lib{name}.so")));
    let mut command = Command::new(compiler);
    command.args(["-O2", "-shared", "-fPIC", "-I"]).arg(root.join("include")).args(words);
    let output = command.arg(root.join(source)).arg("-o").arg(&made).arg("-lm").output().unwrap();
    assert!(output.status.success(), "{output:?}");
    made
}

/// Runs the scene `tap`, where it costs nothing, into a folder.
fn run(folder: &str, words: &[&str]) -> (Output, String) {
    let out = scratch().join(folder);
    let common = ["run", "tap", "--coupling", "direct", "--set", "run.backend=analytic-jet", "--out"];
    let mut command = Command::new(env!("CARGO_BIN_EXE_hapflow"));
    command.args(common).arg(&out).args(words).env("HAPFLOW_PLUGIN_PATH", scratch());
    let output = command.output().unwrap();
    let told = String::from_utf8(output.stderr.clone()).unwrap();
    (output, told)
}

fn summary(folder: &str) -> serde_json::Value {
    serde_json::from_slice(&std::fs::read(scratch().join(folder).join("summary.json")).unwrap()).unwrap()
}

#[test]
fn a_plugins_fluid_is_taken_by_file_by_name_and_by_setting() {
    let file = built("cc", Path::new("examples/plugins/jet_fluid.c"), "jet_fluid", &[]);
    let (output, told) = run("plugin-own", &["--duration", "0.5"]);
    assert!(output.status.success(), "{told}");
    let (own, file) = (summary("plugin-own"), file.to_str().unwrap());
    assert_eq!(own["backend"], "analytic-jet");
    for (n, plugin) in [file, "jet_fluid"].into_iter().enumerate() {
        let folder = format!("plugin-fluid-{n}");
        let (output, told) = run(&folder, &["--duration", "0.5", "--plugin", plugin]);
        assert!(output.status.success(), "{told}");
        let plugins = summary(&folder);
        assert_eq!(plugins["backend"], "jet-fluid");
        let largest = |summary: &serde_json::Value| summary["max_force_N"].as_f64().unwrap();
        assert!(largest(&own) > 0.05, "{own}");
        assert!((largest(&plugins) - largest(&own)).abs() < 1e-12, "{plugins} {own}");
    }
    let (output, told) = run("plugin-wrong", &["--plugin", "jet_fluid", "--set", "plugin.backend=jet"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(told.contains("must be one of those that plugins bring: jet-fluid"), "{told}");
    let (output, told) = run("plugin-twice", &["--plugin", "jet_fluid", "--plugin", file]);
    assert_eq!(output.status.code(), Some(2));
    assert!(told.contains("two plugins bring a fluid named jet-fluid"), "{told}");
    let (output, told) = run("plugin-none", &["--plugin", "no_such"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(
        told.starts_with("hapflow: --plugin no_such: no libno_such.so in HAPFLOW_PLUGIN_PATH ("),
        "{told}"
    );
}

#[test]
fn a_run_whose_plugin_fails_is_written_and_ends_with_the_reason() {
    let source = scratch().join("failing.c");
    let text = std::fs::read_to_string(
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/plugins/jet_fluid.c"),
    );
    let failing = "fluid->time_s > 0.3 ? HAPFLOW_ERROR_PANIC : HAPFLOW_OK";
    let spoilt = text
        .unwrap()
        .replace("result->substeps = SAMPLES;\n    return HAPFLOW_OK", &format!("return {failing}"));
    assert!(spoilt.contains(failing));
    std::fs::write(&source, spoilt).unwrap();
    let file = built("cc", &source, "failing", &[]);
    let (output, told) = run("plugin-failing", &["--duration", "0.5", "--plugin", file.to_str().unwrap()]);
    assert_eq!(output.status.code(), Some(1), "{told}");
    let why = "hapflow: plugin: fluid jet-fluid, frame that ends at 0.310 s: step gave result -";
    assert!(told.starts_with(why), "{told}");
    let faults = summary("plugin-failing")["faults"].to_string();
    assert!(faults.contains("FLUID_FAULT"), "{faults}");
}

#[test]
fn a_plugins_device_moves_the_tool_in_real_time() {
    built("c++", Path::new("examples/plugins/bobbing_device.cpp"), "bobbing_device", &["-std=c++17"]);
    let (output, told) = run("plugin-device", &["--duration", "0.5", "--plugin", "bobbing_device"]);
    assert!(output.status.success(), "{told}");
    let summary = summary("plugin-device");
    assert!(summary["timing"]["late_ticks"].is_number(), "{summary}");
    let rows = std::fs::read_to_string(scratch().join("plugin-device/force.csv")).unwrap();
    assert!(rows.lines().count() > 100, "{}", rows.lines().count());
}
