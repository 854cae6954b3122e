//! The C interface as a C program sees it: the header, the symbols, and the example against a run in Rust.
// A test's helpers fail as the test does.
#![allow(clippy::unwrap_used, clippy::panic)]

mod c_support;

use c_support::header::{self, prototypes};
use c_support::{Variant, compile, library, root, scratch};
use glam::DVec3;
use hapflow::engine::{Scene, Session, SessionOptions, Value, load, settings};
use hapflow::haptics::ToolState;
use std::collections::BTreeSet;
use std::ffi::OsStr;
use std::fs;
use std::path::Path;
use std::process::Command;

#[test]
fn each_header_is_clean_alone_and_included_twice_in_c_and_in_cpp() {
    for name in header::there() {
        let source = scratch().join(format!("header-{name}.c"));
        let include = format!("#include <hapflow/{name}.h>\n");
        fs::write(&source, format!("{include}{include}int hapflow_unused;\n")).unwrap();
        for (compiler, standard, language) in
            [("cc", "c11", "c"), ("cc", "c17", "c"), ("c++", "c++17", "c++")]
        {
            let args = ["-fsyntax-only", "-x", language].map(OsStr::new);
            let said = compile(compiler, standard, &[args[0], args[1], args[2], source.as_os_str()]);
            said.unwrap_or_else(|e| panic!("{name}.h, {standard}: {e}"));
        }
    }
}

#[test]
fn hapflow_h_includes_every_other_header() {
    let mut all = header::included();
    all.push("hapflow".into());
    all.sort();
    assert_eq!(all, header::there());
}

#[test]
fn what_is_exported_is_what_the_header_declares_and_nothing_else() {
    let nm =
        Command::new("nm").args(["-D", "--defined-only"]).arg(library(Variant::Shipped)).output().unwrap();
    let listed = String::from_utf8(nm.stdout).unwrap();
    let exported: BTreeSet<_> =
        listed.lines().filter_map(|l| l.rsplit(' ').next()).map(String::from).collect();
    let declared: BTreeSet<_> = prototypes().into_iter().map(|p| p.name).collect();
    assert_eq!(exported, declared);
    assert!(exported.len() > 15 && exported.iter().all(|name| name.starts_with("hapflow_")));
}

#[test]
fn every_function_states_its_thread_class() {
    for prototype in prototypes() {
        let (name, comment) = (prototype.name, prototype.comment);
        let classes = ["[main", "[servo]", "[fluid]", "[obstacle]", "[any]"]
            .iter()
            .filter(|c| comment.contains(**c))
            .count();
        assert_eq!(classes, 1, "{name}: {comment}");
    }
}

/// A program that counts every allocation in its process while it ticks and drives a device, also on refusals and
/// after a stop.
#[cfg(all(target_os = "linux", target_env = "gnu"))]
const COUNTING: &str = r#"
#include <hapflow/hapflow.h>
#include <math.h>
static volatile long calls;
void* __libc_malloc(size_t); void* __libc_calloc(size_t, size_t); void* __libc_realloc(void*, size_t);
void* __libc_memalign(size_t, size_t); void __libc_free(void*);
void* malloc(size_t n) { calls++; return __libc_malloc(n); }
void* calloc(size_t n, size_t s) { calls++; return __libc_calloc(n, s); }
void* realloc(void* p, size_t n) { calls++; return __libc_realloc(p, n); }
int posix_memalign(void** p, size_t a, size_t n) { calls++; *p = __libc_memalign(a, n); return *p ? 0 : 12; }
void free(void* p) { calls += p != 0; __libc_free(p); }

int main(void) {
    uint32_t version;
    hapflow_session_config config;
    hapflow_session session;
    hapflow_tool_state state;
    hapflow_wrench wrench;
    if (hapflow_negotiate(1, 1, &version) || hapflow_session_config_init(&config, sizeof config)) return 2;
    config.scene = "tap";
    config.settings = "run.backend = analytic-jet";
    const double place[3] = {0.1, 0, 0}, upright[4] = {0, 0, 0, 1};
    if (hapflow_session_create(&config, &session) || hapflow_tool_state_init(&state, sizeof state)) return 3;
    hapflow_device_config hand;
    hapflow_device device;
    if (hapflow_device_config_init(&hand, sizeof hand) || hapflow_device_open(&hand, &device)) return 10;
    long before_all = calls;
    if (before_all < 10) return 4; /* not counting */
    for (int n = 0; n < 3000; n++) {
        state.time_s = n * 1e-3;
        if (hapflow_fluid_advance(session, state.time_s)) return 5;
        long before = calls;
        if (hapflow_device_read(device, state.time_s, &state)) return 11;
        if (n == 2000) state.velocity[0] = NAN;
        hapflow_result result = hapflow_servo_tick(session, &state, &wrench);
        if (n == 2000 && result != HAPFLOW_ERROR_NOT_FINITE) return 6;
        if (n == 2500) hapflow_session_emergency_stop(session);
        if (n == 2700) wrench.force[0] = NAN;
        if ((hapflow_device_write(device, &wrench, state.dt_s) < 0) != (n == 2700)) return 12;
        if (hapflow_obstacle_move(session, 0, place, upright) != HAPFLOW_ERROR_INDEX) return 8;
        if (hapflow_obstacle_publish(session)) return 9;
        state.velocity[0] = 0;
        if (calls != before) return 1;
    }
    if (hapflow_device_close(device)) return 13;
    return hapflow_session_destroy(session) ? 7 : 0;
}
"#;

#[cfg(all(target_os = "linux", target_env = "gnu"))]
#[test]
fn a_tick_and_a_device_allocate_nothing() {
    let (source, program) = (scratch().join("counting.c"), scratch().join("counting"));
    fs::write(&source, COUNTING).unwrap();
    link(&source, &program);
    let library = library(Variant::Shipped);
    let status = Command::new(&program).env("LD_LIBRARY_PATH", library.parent().unwrap()).status().unwrap();
    assert_eq!(status.code(), Some(0));
}

/// Compiles a C program against the shipped library, as the example's head says.
fn link(source: &Path, program: &Path) {
    let library = library(Variant::Shipped);
    let from = library.parent().map(Path::as_os_str).unwrap();
    let args = [source.as_os_str(), OsStr::new("-L"), from, OsStr::new("-lhapflow"), OsStr::new("-o")];
    compile("cc", "c11", &[&args[..], &[program.as_os_str()]].concat()).unwrap_or_else(|e| panic!("{e}"));
}

/// Runs `examples/tap.c`, and gives its rows.
fn tap_in_c(seconds: &str, settings: &str) -> Vec<[f64; 4]> {
    let program = scratch().join(format!("tap-{seconds}"));
    link(&root().join("examples/tap.c"), &program);
    let library = library(Variant::Shipped);
    let from = library.parent().unwrap();
    let output =
        Command::new(&program).args([seconds, settings]).env("LD_LIBRARY_PATH", from).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let text = String::from_utf8(output.stdout).unwrap();
    let row = |line: &str| {
        let numbers: Vec<f64> = line.split(',').map(|n| n.parse().unwrap()).collect();
        <[f64; 4]>::try_from(numbers).unwrap()
    };
    text.lines().skip(1).map(row).collect()
}

/// The example's motion, in its own words.
fn tool_at(time_s: f64) -> ToolState {
    let s = time_s - time_s.trunc();
    ToolState {
        position: DVec3::new(0.0, -0.16 * (s * s) * ((1.0 - s) * (1.0 - s)), 0.0),
        velocity: DVec3::new(0.0, -0.32 * s * (1.0 - s) * (1.0 - 2.0 * s), 0.0),
        ..ToolState::default()
    }
}

/// The same run on the engine's virtual clock: as `run::virtual_clock` drives it.
fn tap_in_rust(scene: &Scene, ticks: u64) -> Vec<[f64; 4]> {
    let mut session = Session::open(scene, SessionOptions::hosted()).unwrap();
    let (mut servo, mut fluid) = (session.take_servo().unwrap(), session.take_fluid().unwrap());
    let end = |k: u64| k as f64 / scene.run.fluid_hz;
    let mut frames = 0;
    let mut tick = |n: u64| {
        let time_s = n as f64 * 1e-3;
        while end(frames + 1) <= time_s + 1e-9 {
            frames += 1;
            fluid.publish(end(frames));
            fluid.compute(end(frames));
        }
        let force = servo.tick(&tool_at(time_s), time_s, 1e-3).force();
        [time_s, force.x, force.y, force.z]
    };
    (0..ticks).map(&mut tick).collect()
}

#[test]
fn the_c_example_gives_the_force_of_the_rust_run() {
    for (seconds, ticks, changes) in [
        ("0.4", 400, [("fluid.spacing", "0.01"), ("run.fluid_hz", "60")]),
        ("1.2", 1200, [("run.backend", "analytic-jet"), ("tool.radius", "0.02")]),
    ] {
        let mut scene = load("tap").unwrap();
        let mut lines = String::new();
        for (path, value) in changes {
            settings::set(&mut scene, path, &Value::parse(value)).unwrap();
            lines += &format!("{path} = {value}\n");
        }
        let (c, rust) = (tap_in_c(seconds, &lines), tap_in_rust(&scene, ticks));
        assert_eq!(c.len(), rust.len());
        for (c, rust) in c.iter().zip(&rust) {
            for (c, rust) in c.iter().zip(rust) {
                assert!((c - rust).abs() <= 1e-9, "{c} in C, {rust} in Rust");
            }
        }
        assert!(rust.iter().any(|row| row[2] < -0.05), "nothing was felt");
    }
}

#[test]
fn a_session_drives_the_simulated_hand_in_threads_of_its_own() {
    let program = scratch().join("hand");
    link(&root().join("examples/hand.c"), &program);
    let mut hand = Command::new(&program);
    hand.args(["1.2", "run.backend = analytic-jet\ngate.ramp_in = 0"]);
    hand.env("LD_LIBRARY_PATH", library(Variant::Shipped).parent().unwrap());
    let output = hand.output().unwrap();
    let (out, err) = (String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    assert!(output.status.success(), "{err}");
    assert!(err.contains("real-time priority of the servo: "), "{err}");
    let down = |line: &str| -> Option<f64> {
        line.rsplit(", ").next()?.strip_suffix(" N down")?.trim().parse().ok()
    };
    assert!(out.lines().filter_map(down).fold(0.0, f64::max) > 0.05, "nothing was felt: {out}");
    assert!(out.lines().last().unwrap().contains(" ticks, "), "{out}");
}

#[test]
fn the_example_says_what_is_wrong_and_is_short() {
    let source = fs::read_to_string(root().join("examples/tap.c")).unwrap();
    assert!(source.lines().count() < 60);
    tap_in_c("0.01", "run.backend = \"analytic-jet\"");
    let mut program = Command::new(scratch().join("tap-0.01"));
    program
        .args(["0.01", "fluid.viscosity = -1"])
        .env("LD_LIBRARY_PATH", library(Variant::Shipped).parent().unwrap());
    let output = program.output().unwrap();
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(!output.status.success() && output.stdout.is_empty());
    assert!(said.contains("fluid.viscosity = -1: must be a number from 0 to 10000 Pa·s"), "{said}");
}
