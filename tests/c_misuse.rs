//! The C interface held wrong: every mistake is a code, no force, and nothing else.
// A test's helpers fail as the test does.
#![allow(clippy::unwrap_used, clippy::panic)]

mod c_support;

use c_support::{
    Api, Device, JET, PLATE, Random, Report, SECOND, Session, SessionConfig, ToolState, Variant, Wrench,
    code, made,
};
use hapflow::engine::run::{RunOptions, virtual_clock};
use hapflow::engine::{Parts, parse};
use hapflow::haptics::FaultSet;
use std::ffi::{CStr, CString, c_char};
use std::ops::ControlFlow;
use std::ptr::{null, null_mut};

fn ready() -> Api {
    Api::ready(Variant::Shipped)
}

fn felt(wrench: &Wrench) -> f64 {
    wrench.force[1].abs()
}

#[test]
fn nothing_comes_before_the_version() {
    let api = Api::load(Variant::Shipped);
    assert_eq!(api.try_create(JET), Err(code::NOT_NEGOTIATED));
    assert!(api.error().contains("hapflow_negotiate"));
    let mut chosen = 99;
    for (oldest, newest) in [(2, 9), (0, 0), (1, 0), (u32::MAX, u32::MAX)] {
        assert_eq!((api.negotiate)(oldest, newest, &mut chosen), code::VERSION);
    }
    assert_eq!(chosen, 99);
    assert_eq!(api.try_create(JET), Err(code::NOT_NEGOTIATED));
    for (oldest, newest) in [(1, 1), (0, 7), (1, u32::MAX)] {
        assert_eq!((api.negotiate)(oldest, newest, &mut chosen), code::OK);
        assert_eq!(chosen, 1);
    }
    assert!(api.try_create(JET).is_ok());
    assert!((api.version)() >= 1000);
}

#[test]
fn null_pointers_are_refused_and_outputs_stay() {
    let api = ready();
    let session = api.jet();
    let path = c"fluid.viscosity".as_ptr();
    let (state, mut number) = (api.state(0), 5.0);
    assert_eq!((api.negotiate)(1, 1, null_mut()), code::NULL);
    assert_eq!((api.last_error)(null_mut(), 0, null_mut()), code::NULL);
    assert_eq!((api.last_error)(null_mut(), 9, &mut 0), code::NULL);
    assert_eq!((api.session_config_init)(null_mut(), 56), code::NULL);
    assert_eq!((api.tool_state_init)(null_mut(), 136), code::NULL);
    assert_eq!((api.report_init)(null_mut(), 280), code::NULL);
    assert_eq!((api.session_create)(null(), &mut Session::default()), code::NULL);
    assert_eq!((api.session_create)(&api.config(), null_mut()), code::NULL);
    assert_eq!((api.session_set)(session, null(), 1.0), code::NULL);
    assert_eq!((api.session_set_text)(session, path, null()), code::NULL);
    assert_eq!((api.session_set_vector)(session, path, null()), code::NULL);
    assert_eq!((api.session_get)(session, null(), &mut number), code::NULL);
    assert_eq!((api.session_get)(session, path, null_mut()), code::NULL);
    assert_eq!((api.session_get_text)(session, path, null_mut(), 0, null_mut()), code::NULL);
    assert_eq!((api.session_report)(session, null_mut()), code::NULL);
    assert_eq!((api.session_report_of)(session, 0, null_mut()), code::NULL);
    assert_eq!((api.session_tool_count)(session, null_mut()), code::NULL);
    assert_eq!((api.session_servo_pace)(session, 0, null_mut()), code::NULL);
    assert_eq!((api.servo_pace_init)(null_mut(), 72), code::NULL);
    assert_eq!((api.device_config_init)(null_mut(), 56), code::NULL);
    assert_eq!((api.obstacle_count)(session, null_mut()), code::NULL);
    assert_eq!((api.session_body_report)(session, 1, 0, null_mut()), code::NULL);
    assert_eq!((api.body_report_init)(null_mut(), 184), code::NULL);
    assert_eq!((api.obstacle_move)(session, 0, null(), &[0.0; 4]), code::NULL);
    assert_eq!((api.obstacle_move)(session, 0, &[0.0; 3], null()), code::NULL);
    assert_eq!((api.fluid_particles)(session, null_mut(), 0, null_mut()), code::NULL);
    assert_eq!((api.session_particles)(session, null_mut(), 0, null_mut()), code::NULL);
    assert_eq!((api.session_particles)(session, null_mut(), 1, &mut 0), code::NULL);
    assert_eq!((api.servo_tick)(session, &state, null_mut()), code::NULL);
    let mut wrench = Wrench::UNTOUCHED;
    assert_eq!((api.servo_tick)(session, null(), &mut wrench), code::NULL);
    assert_eq!((wrench, number), (Wrench::ZERO, 5.0));
}

#[test]
fn stale_and_doubled_handles_are_codes() {
    let api = ready();
    let old = api.jet();
    assert_eq!((api.session_destroy)(old), code::OK);
    let new = api.jet();
    assert_ne!(old, new);
    let garbage =
        [0, 1, 64, 65, u64::MAX, 1 << 32, (1 << 32) + 65, new.id + (1 << 32)].map(|id| Session { id });
    for handle in garbage.into_iter().chain([old]) {
        assert_eq!((api.session_destroy)(handle), code::HANDLE);
        assert_eq!(api.tick(handle, &api.state(0)), (code::HANDLE, Wrench::ZERO));
        assert_eq!((api.fluid_advance)(handle, 0.1), code::HANDLE);
        assert_eq!((api.fluid_step)(handle, 0.1), code::HANDLE);
        assert_eq!((api.fluid_particles)(handle, null_mut(), 0, &mut 0), code::HANDLE);
        assert_eq!((api.session_particles)(handle, null_mut(), 0, &mut 0), code::HANDLE);
        assert_eq!(api.set(handle, "fluid.viscosity", 1.0), code::HANDLE);
        assert_eq!(api.get(handle, "fluid.viscosity"), Err(code::HANDLE));
        assert_eq!((api.session_emergency_stop)(handle), code::HANDLE);
        assert_eq!((api.session_clear_faults)(handle), code::HANDLE);
        assert_eq!((api.session_report)(handle, null_mut()), code::HANDLE);
        assert_eq!((api.session_report_of)(handle, 1, null_mut()), code::HANDLE);
        assert_eq!((api.session_tool_count)(handle, null_mut()), code::HANDLE);
        assert_eq!((api.session_servo_pace)(handle, 0, null_mut()), code::HANDLE);
        assert_eq!((api.session_poll)(handle), code::HANDLE);
        let device = Device { id: handle.id };
        assert_eq!((api.device_read)(device, 0.0, null_mut()), code::HANDLE);
        assert_eq!((api.device_write)(device, null(), 1e-3), code::HANDLE);
        assert_eq!((api.device_clear_faults)(device), code::HANDLE);
        assert_eq!((api.device_close)(device), code::HANDLE);
        assert_eq!((api.obstacle_count)(handle, null_mut()), code::HANDLE);
        assert_eq!((api.session_body_report)(handle, 1, 0, null_mut()), code::HANDLE);
        assert_eq!((api.obstacle_move)(handle, 0, null(), null()), code::HANDLE);
        assert_eq!((api.obstacle_publish)(handle), code::HANDLE);
        assert_eq!(api.tick(handle, &ToolState { tool: 1, ..api.state(0) }), (code::HANDLE, Wrench::ZERO));
    }
    assert_eq!(api.run(new, 0, 5).len(), 5);
    assert_eq!(((api.session_destroy)(new), (api.session_destroy)(new)), (code::OK, code::HANDLE));
}

/// A tool state that is refused, and how.
fn bad_states(good: ToolState) -> Vec<(i32, ToolState)> {
    let mut bad = Vec::new();
    for number in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        bad.push((code::NOT_FINITE, ToolState { time_s: number, ..good }));
        bad.push((code::NOT_FINITE, ToolState { dt_s: number, ..good }));
        for axis in 0..3 {
            let mut states = [good; 4];
            states[0].position[axis] = number;
            states[1].orientation[axis] = number;
            states[2].velocity[axis] = number;
            states[3].angular_velocity[axis] = number;
            bad.extend(states.map(|s| (code::NOT_FINITE, s)));
        }
    }
    for orientation in [[0.0; 4], [0.0, 0.0, 0.0, 1.002], [0.5, 0.5, 0.5, 0.45], [1e300; 4]] {
        bad.push((code::ORIENTATION, ToolState { orientation, ..good }));
    }
    bad.push((code::VALUE, ToolState { position: [0.0, 1001.0, 0.0], ..good }));
    bad.push((code::VALUE, ToolState { velocity: [-1e300, 0.0, 0.0], ..good }));
    bad.push((code::VALUE, ToolState { angular_velocity: [0.0, 0.0, 2e5], ..good }));
    bad.push((code::TIME, ToolState { dt_s: -1e-3, ..good }));
    bad.push((code::TIME, ToolState { time_s: good.time_s - 1e-3, ..good }));
    bad.push((code::TIME, ToolState { time_s: -1.0, ..good }));
    bad.push((code::TIME, ToolState { time_s: 2e7, ..good }));
    bad.push((code::INDEX, ToolState { tool: 1, ..good }));
    bad.push((code::INDEX, ToolState { tool: u32::MAX, ..good }));
    bad.push((code::UNSUPPORTED, ToolState { reserved: 1, ..good }));
    bad.push((code::STRUCT, ToolState { size: 0, ..good }));
    bad.push((code::STRUCT, ToolState { size: 135, ..good }));
    bad
}

#[test]
fn a_bad_state_gives_no_force_until_it_is_cleared_and_then_no_jump() {
    let api = ready();
    let session = api.jet();
    let full = felt(api.run(session, 0, 150).last().unwrap());
    assert!(full > 0.1, "nothing was felt: {full}");
    for (n, (expected, state)) in (150..).zip(bad_states(api.state(149))) {
        assert_eq!(api.tick(session, &state), (expected, Wrench::ZERO), "{state:?}");
        assert_eq!(api.report(session).faults & 1, 1);
        assert_eq!(api.tick(session, &api.state(149)), (code::FORCE_HELD, Wrench::ZERO));
        assert_eq!((api.session_clear_faults)(session), code::OK);
        let first = felt(&api.run(session, 149, 150)[0]);
        assert!(first < 0.1 * full, "{first} N at once after {state:?}, case {n}");
    }
    assert!(felt(api.run(session, 150, 200).last().unwrap()) > 0.9 * full);
}

#[test]
fn a_fault_that_is_cleared_before_the_next_tick_leaves_no_jump_either() {
    let api = ready();
    let session = api.jet();
    let mut full = 0.0;
    for k in 0..bad_states(api.state(0)).len() {
        let next = 101 * k as u64 + 100;
        let felt_now = felt(api.run(session, next - 100, next).last().unwrap());
        assert!(felt_now > 0.9 * full && felt_now > 0.1, "{felt_now} N, and not {full}");
        full = felt_now;
        let (expected, bad) = bad_states(api.state(next - 1))[k];
        assert_eq!(api.tick(session, &bad), (expected, Wrench::ZERO));
        assert_eq!((api.session_clear_faults)(session), code::OK);
        let first = felt(&api.run(session, next, next + 1)[0]);
        assert!(first < 0.1 * full, "{first} N at once after {bad:?}");
    }
}

/// Both tools of a session, at rest in their jets, over the ticks `from..to`; the last results and wrenches.
fn run_two(api: &Api, session: Session, from: u64, to: u64) -> [(i32, Wrench); 2] {
    let mut last = [(code::OK, Wrench::ZERO); 2];
    for n in from..to {
        let state = api.state(n);
        assert_eq!((api.fluid_advance)(session, state.time_s), code::OK);
        let second = ToolState { tool: 1, position: [0.06, 0.0, 0.0], ..state };
        last = [state, second].map(|state| api.tick(session, &state));
    }
    last
}

#[test]
fn each_tool_has_its_own_force_and_a_bad_state_of_one_stops_both() {
    let api = ready();
    let session = api.try_create(&format!("{JET}{SECOND}")).unwrap();
    let mut count = 0;
    assert_eq!(((api.session_tool_count)(session, &mut count), count), (code::OK, 2));
    let full = run_two(&api, session, 0, 150).map(|(result, wrench)| {
        assert_eq!(result, code::OK);
        felt(&wrench)
    });
    assert!(full[1] > 0.05 && full[0] > 1.3 * full[1], "{full:?}");
    for tool in 0..2 {
        let report = api.report_of(session, tool);
        assert_eq!((report.tick, report.force[1].abs()), (150, full[tool as usize]));
    }
    assert_eq!(api.report_of(session, 0), api.report(session));
    let mut report = made(api.report_init);
    assert_eq!((api.session_report_of)(session, 2, &mut report), code::INDEX);
    assert_eq!((api.error(), report.tick), ("no tool 2: there are 2, from 0".into(), 0));

    let wrong = [(code::NOT_FINITE, 0), (code::NOT_FINITE, 1), (code::INDEX, 2), (code::INDEX, 8)];
    for (n, (expected, tool)) in (1..).map(|n| 100 + 50 * n).zip(wrong) {
        let bad = ToolState { tool, position: [0.0, f64::NAN, 0.0], ..api.state(n) };
        assert_eq!(api.tick(session, &bad), (expected, Wrench::ZERO));
        assert_eq!(run_two(&api, session, n, n + 1), [(code::FORCE_HELD, Wrench::ZERO); 2], "{tool}");
        assert_eq!(api.report_of(session, 1).faults & 1, 1);
        assert_eq!((api.session_clear_faults)(session), code::OK);
        let first = run_two(&api, session, n + 1, n + 2);
        assert!((0..2).all(|k| first[k].0 == code::OK && felt(&first[k].1) < 0.1 * full[k]), "{first:?}");
        let again = run_two(&api, session, n + 2, n + 50);
        assert!((0..2).all(|k| felt(&again[k].1) > 0.9 * full[k]), "{again:?}");
    }
}

#[test]
fn each_tool_has_its_own_time() {
    let api = ready();
    let session = api.try_create(&format!("{JET}{SECOND}")).unwrap();
    let second = |n| ToolState { tool: 1, ..api.state(n) };
    assert_eq!(api.tick(session, &api.state(50)).0, code::OK);
    assert_eq!(api.tick(session, &second(20)).0, code::OK);
    assert_eq!((api.report_of(session, 0).time_s, api.report_of(session, 1).time_s), (0.05, 0.02));
    assert_eq!(api.tick(session, &second(10)), (code::TIME, Wrench::ZERO));
}

#[test]
fn sessions_with_other_numbers_of_tools_follow_each_other_in_one_place() {
    let api = ready();
    let two = format!("{JET}{SECOND}");
    for n in 0..10 {
        let tools = 1 + n % 2;
        let session = api.try_create(if tools == 2 { &two } else { JET }).unwrap();
        for tool in 0..3 {
            let expected = if tool < tools { code::OK } else { code::INDEX };
            let state = ToolState { tool, ..api.state(1) };
            assert_eq!(api.tick(session, &state).0, expected, "tool {tool} of {tools}");
        }
        assert_eq!((api.session_destroy)(session), code::OK);
        assert_eq!(api.tick(session, &ToolState { tool: 1, ..api.state(1) }).0, code::HANDLE);
    }
}

const UPRIGHT: [f64; 4] = [0.0, 0.0, 0.0, 1.0];

#[test]
fn a_plate_shields_the_tool_until_the_host_takes_it_away() {
    let api = ready();
    let cpu = JET.replace("backend = \"analytic-jet\"", "") + "\n[fluid]\nspacing = 0.006\n" + PLATE;
    let session = api.try_create(&cpu).unwrap();
    let mut count = 0;
    assert_eq!(((api.obstacle_count)(session, &mut count), count), (code::OK, 1));
    let mean = |wrenches: &[Wrench]| wrenches.iter().map(felt).sum::<f64>() / wrenches.len() as f64;
    let under = mean(&api.run(session, 0, 400)[200..]);
    // Without publishing it stays.
    assert_eq!((api.obstacle_move)(session, 0, &[0.06, 0.028, 0.0], &UPRIGHT), code::OK);
    let still = mean(&api.run(session, 400, 500));
    for n in 50..70_u32 {
        let place = [0.003 * f64::from(n - 49), 0.028, 0.0];
        assert_eq!((api.obstacle_move)(session, 0, &place, &UPRIGHT), code::OK);
        assert_eq!((api.obstacle_publish)(session), code::OK);
        api.run(session, u64::from(n) * 10, u64::from(n) * 10 + 10);
    }
    let free = mean(&api.run(session, 700, 1000)[150..]);
    assert!(under < 0.02 && still < 0.02 && free > 0.1, "under the plate {under} {still} N, free {free} N");
}

#[test]
fn a_place_that_no_obstacle_can_have_is_refused() {
    let api = ready();
    let none = api.jet();
    let mut count = 9;
    assert_eq!(((api.obstacle_count)(none, &mut count), count), (code::OK, 0));
    assert_eq!((api.obstacle_move)(none, 0, &[0.0; 3], &UPRIGHT), code::INDEX);
    assert_eq!((api.obstacle_publish)(none), code::OK);
    let session = api.try_create(&format!("{JET}{PLATE}")).unwrap();
    for (expected, index, position, orientation) in [
        (code::OK, 0, [0.0, 0.05, 0.0], [0.0, 0.6, 0.0, 0.8]),
        (code::INDEX, 1, [0.0; 3], UPRIGHT),
        (code::INDEX, u32::MAX, [f64::NAN; 3], UPRIGHT),
        (code::NOT_FINITE, 0, [0.0, f64::NAN, 0.0], UPRIGHT),
        (code::NOT_FINITE, 0, [0.0, 0.0, f64::INFINITY], UPRIGHT),
        (code::NOT_FINITE, 0, [0.0; 3], [0.0, f64::NAN, 0.0, 1.0]),
        (code::VALUE, 0, [1001.0, 0.0, 0.0], UPRIGHT),
        (code::ORIENTATION, 0, [0.0; 3], [0.0; 4]),
        (code::ORIENTATION, 0, [0.0; 3], [0.0, 0.0, 0.0, 1.002]),
        (code::ORIENTATION, 0, [0.0; 3], [1e300; 4]),
    ] {
        let result = (api.obstacle_move)(session, index, &position, &orientation);
        assert_eq!(result, expected, "{index} {position:?} {orientation:?}");
    }
    // None of it is a fault.
    assert_eq!((api.obstacle_publish)(session), code::OK);
    api.run(session, 0, 50);
    assert_eq!(api.report(session).faults & 0x7, 0);
}

#[test]
fn a_tick_without_time_or_after_a_long_pause_is_safe() {
    let api = ready();
    let session = api.jet();
    api.run(session, 0, 100);
    let before = api.tick(session, &api.state(100)).1;
    let (result, wrench) = api.tick(session, &ToolState { dt_s: 0.0, ..api.state(100) });
    assert_eq!((result, wrench.force), (code::NO_TIME, before.force));
    let (result, wrench) = api.tick(session, &ToolState { time_s: 10.1, dt_s: 10.0, ..api.state(100) });
    assert_eq!(result, code::LATE);
    assert!(felt(&wrench) <= felt(&before) + 1e-12, "old data, so that the force fades");
    let (result, wrench) = api.tick(session, &ToolState { time_s: 10.2, dt_s: 1e300, ..api.state(100) });
    assert!(result == code::LATE && wrench.force.iter().all(|f| f.is_finite()));
}

#[test]
fn the_gate_holds_its_limits_through_the_interface() {
    let api = ready();
    let session = api.jet();
    assert_eq!(api.set(session, "tool.force_scale", 1000.0), code::OK);
    assert_eq!(api.set(session, "gate.max_force", 2.0), code::OK);
    assert_eq!(api.set(session, "gate.max_slew", 50.0), code::OK);
    let mut last = 0.0;
    for wrench in api.run(session, 0, 200) {
        let force = wrench.force.iter().map(|f| f * f).sum::<f64>().sqrt();
        assert!(force <= 2.0 && (force - last).abs() <= 0.05 + 1e-12);
        last = force;
    }
    assert!(last > 1.9);
}

#[test]
fn a_bad_scene_is_refused_with_its_line_and_field() {
    let api = ready();
    for (toml, result, words) in [
        (
            "[fluid]\nspacing = 0.01\nviscosity = -1\n",
            code::SCENE,
            &["toml:3", "fluid.viscosity = -1", "0 to 10000"][..],
        ),
        ("[fluid]\nviscosity = nan\n", code::SCENE, &["toml:2", "fluid.viscosity"]),
        ("[fluid]\nvizcosity = 1\n", code::SCENE, &["toml:2", "did you mean fluid.viscosity?"]),
        ("[fluid\n", code::SCENE, &["toml:1"]),
        ("\0", code::SCENE, &["toml:1"]),
    ] {
        assert_eq!(api.try_create(toml), Err(result), "{toml}");
        let said = api.error();
        assert!(words.iter().all(|w| said.contains(w)), "{said}");
    }
    let bytes = [0xff_u8, 0xfe];
    let config = SessionConfig { toml: bytes.as_ptr().cast(), toml_length: 2, ..api.config() };
    assert_eq!((api.session_create)(&config, &mut Session::default()), code::TEXT);
}

#[test]
fn a_bad_configuration_is_refused() {
    let api = ready();
    let good = SessionConfig { scene: c"tap".as_ptr(), ..api.config() };
    let toml = c"".as_ptr();
    for (expected, config) in [
        (code::STRUCT, SessionConfig { kind: 0, ..good }),
        (code::STRUCT, SessionConfig { size: 8, ..good }),
        (code::STRUCT, SessionConfig { size: u32::MAX, ..good }),
        (code::UNSUPPORTED, SessionConfig { next: (&raw const good).cast(), ..good }),
        (code::UNSUPPORTED, SessionConfig { fluid_drive: 2, ..good }),
        (code::VALUE, SessionConfig { threads: 1025, ..good }),
        (code::SCENE, SessionConfig { toml, ..good }),
        (code::SCENE, SessionConfig { scene: null(), ..good }),
        (code::NOT_FOUND, SessionConfig { scene: c"tapp".as_ptr(), ..good }),
        (code::TEXT, SessionConfig { scene: c"\xff".as_ptr(), ..good }),
        (code::SETTING, SessionConfig { settings: c"\n# ok\nfluid.x = 1".as_ptr(), ..good }),
        (code::VALUE, SessionConfig { settings: c"fluid.spacing = NaN".as_ptr(), ..good }),
        (code::VALUE, SessionConfig { settings: c"fluid.spacing".as_ptr(), ..good }),
    ] {
        let mut session = Session { id: 5 };
        assert_eq!((api.session_create)(&config, &mut session), expected, "{config:?}: {}", api.error());
        assert_eq!(session, Session { id: 5 });
    }
    assert!(api.error().starts_with("settings:1:"), "{}", api.error());
}

#[test]
fn settings_are_read_set_and_refused_as_the_table_says() {
    let api = ready();
    let session = api.jet();
    assert_eq!(api.set(session, "fluid.viscosity", 0.5), code::OK);
    assert_eq!(api.set(session, "source.tap.speed", 1.25), code::OK);
    assert_eq!(api.set_text(session, "fluid.two_way", "false"), code::OK);
    assert_eq!(api.set_text(session, "fluid.gravity", "[0, -1, 0]"), code::OK);
    let (gravity, nan) = ([0.0, -2.0, 0.0], [0.0, f64::NAN, 0.0]);
    assert_eq!((api.session_set_vector)(session, c"fluid.gravity".as_ptr(), &gravity), code::OK);
    for (expected, path, value) in [
        (code::VALUE, "fluid.viscosity", -1.0),
        (code::VALUE, "fluid.solver", 1.0),
        (code::NOT_FINITE, "fluid.viscosity", f64::NAN),
        (code::NOT_FINITE, "fluid.viscosity", f64::INFINITY),
        (code::SETTING, "fluid.vizcosity", 1.0),
        (code::SETTING, "", 1.0),
        (code::FIXED, "run.fluid_hz", 60.0),
    ] {
        assert_eq!(api.set(session, path, value), expected, "{path} = {value}");
        assert!(api.error().contains(path), "{}", api.error());
    }
    assert_eq!((api.session_set_vector)(session, c"fluid.gravity".as_ptr(), &nan), code::NOT_FINITE);
    assert_eq!(api.set_text(session, "fluid.gravity", "[0, nan, 0]"), code::VALUE);
    assert_eq!(api.set_text(session, "fluid.viscosity", "NaN"), code::VALUE);
    assert_eq!(
        (api.get(session, "fluid.viscosity"), api.get(session, "source.tap.speed")),
        (Ok(0.5), Ok(1.25))
    );
    assert_eq!(
        (api.get(session, "fluid.two_way"), api.get(session, "fluid.gravity")),
        (Ok(0.0), Err(code::VALUE))
    );
    // A liquid is several settings at once; one of them that is set after it is set over it.
    assert_eq!(api.set_text(session, "fluid.liquid", "honey"), code::OK);
    assert_eq!(text(&api, session, c"fluid.liquid"), "honey");
    assert_eq!(api.set(session, "fluid.viscosity", 2.0), code::OK);
    assert_eq!(api.get(session, "fluid.rest_density"), Ok(1430.0));
    assert_eq!(text(&api, session, c"fluid.liquid"), "custom");
    assert_eq!(api.set_text(session, "fluid.liquid", "milk"), code::VALUE);
    assert_eq!(api.get(session, "no.such"), Err(code::SETTING));
    assert_eq!(text(&api, session, c"fluid.gravity"), "[0, -2, 0]");
    assert_eq!(text(&api, session, c"run.backend"), "analytic-jet");
}

fn text(api: &Api, session: Session, path: &CStr) -> String {
    let mut length = 0;
    assert_eq!((api.session_get_text)(session, path.as_ptr(), null_mut(), 0, &mut length), code::OK);
    let mut buffer = vec![1 as c_char; length + 1];
    let whole = buffer.len();
    let mut get =
        |capacity| (api.session_get_text)(session, path.as_ptr(), buffer.as_mut_ptr(), capacity, &mut length);
    assert_eq!((get(3), get(whole)), (code::MORE, code::OK));
    let bytes: Vec<u8> = buffer.iter().map(|c| *c as u8).collect();
    CStr::from_bytes_with_nul(&bytes).unwrap().to_str().unwrap().into()
}

#[test]
fn structs_of_other_sizes_are_taken_as_far_as_they_go() {
    let api = ready();
    let session = api.jet();
    api.run(session, 0, 3);
    // A program from the future: a longer struct, whose unknown tail is zero or not.
    let mut longer = [0_u64; 18];
    let to: *mut ToolState = longer.as_mut_ptr().cast();
    assert_eq!((api.tool_state_init)(to, 144), code::OK);
    assert_eq!(longer[0] as u32, 144);
    longer[2] = 0.003_f64.to_bits();
    assert!((api.servo_tick)(session, longer.as_ptr().cast(), &mut Wrench::UNTOUCHED.clone()) >= 0);
    longer[17] = 1;
    let refused = (api.servo_tick)(session, longer.as_ptr().cast(), &mut Wrench::UNTOUCHED.clone());
    assert_eq!(refused, code::UNSUPPORTED);
    let mut report = [7_u64; 36];
    assert_eq!((api.report_init)(report.as_mut_ptr().cast(), 288), code::OK);
    assert_eq!((api.session_report)(session, report.as_mut_ptr().cast()), code::OK);
    assert_eq!((report[0] as u32, report[1], report[35]), (288, 4, 0));
    for size in [0, 279, 5000, u32::MAX] {
        assert_eq!((api.report_init)(report.as_mut_ptr().cast::<Report>(), size), code::STRUCT);
    }
    report[0] = 12;
    assert_eq!((api.session_report)(session, report.as_mut_ptr().cast()), code::STRUCT);
}

/// Bytes that an init function has no business with.
const UNTOUCHED: u8 = 0x5a;

/// Makes structs of every size, older than the first, newer, and such as cannot be.
fn init_at_every_size<T>(first: usize, init: extern "C" fn(*mut T, u32) -> i32) {
    for size in (0..4200_usize).chain([1 << 16, u32::MAX as usize]) {
        let mut memory = [UNTOUCHED; 4300];
        // At an odd address.
        let result = init(memory[1..].as_mut_ptr().cast(), size as u32);
        let made = if (first..=4096).contains(&size) { size } else { 0 };
        assert_eq!(result, if made > 0 { code::OK } else { code::STRUCT }, "{size}");
        assert!(memory[0] == UNTOUCHED && memory[1 + made..].iter().all(|b| *b == UNTOUCHED), "{size}");
        assert!(made <= first || memory[1 + first..1 + made].iter().all(|b| *b == 0), "{size}");
    }
}

#[test]
fn every_init_function_takes_newer_sizes_and_writes_no_further() {
    let api = ready();
    init_at_every_size(56, api.session_config_init);
    init_at_every_size(56, api.device_config_init);
    init_at_every_size(72, api.servo_pace_init);
    init_at_every_size(136, api.tool_state_init);
    init_at_every_size(280, api.report_init);
    init_at_every_size(184, api.body_report_init);
    init_at_every_size(32, api.scene_info_init);
    init_at_every_size(40, api.device_info_init);
    init_at_every_size(80, api.setting_info_init);
}

#[test]
fn a_configuration_of_a_newer_header_is_taken_if_it_asks_for_nothing_new() {
    let api = ready();
    let toml = CString::new(JET).unwrap();
    // One of the first header has 56 bytes, and something else of the program behind them.
    let newer = size_of::<SessionConfig>() as u32 + 8;
    for (size, last, expected) in [
        (56, u64::MAX, code::OK),
        (newer, 0, code::OK),
        (4096, 0, code::OK),
        (newer, 1, code::UNSUPPORTED),
        (4096, 1, code::UNSUPPORTED),
    ] {
        let mut memory = [0_u64; 512];
        let config: *mut SessionConfig = memory.as_mut_ptr().cast();
        assert_eq!((api.session_config_init)(config, size), code::OK);
        // SAFETY: the memory is larger than the struct.
        unsafe { (*config).toml = toml.as_ptr() };
        let at = if size == 56 { 7 } else { size as usize / 8 - 1 };
        memory[at] = last;
        let mut session = Session::default();
        assert_eq!((api.session_create)(memory.as_ptr().cast(), &mut session), expected, "{size}");
    }
    for size in [0, 8, 55, 4097, u32::MAX] {
        let config = SessionConfig { size, toml: toml.as_ptr(), ..api.config() };
        assert_eq!((api.session_create)(&config, &mut Session::default()), code::STRUCT);
    }
}

#[test]
fn no_foreign_handle_is_taken() {
    let (api, mut random) = (ready(), Random(7));
    let known: Vec<_> = (0..3).map(|_| api.jet()).collect();
    let state = api.state(1);
    for n in 0..100_000 {
        // Any number; one with a slot that there is; a known one with a bit turned over.
        let id = match n % 3 {
            0 => random.next(),
            1 => random.below(1 << 32) << 32 | (1 + random.below(64)),
            _ => random.of(&known).id ^ 1 << random.below(64),
        };
        let session = Session { id };
        if !known.contains(&session) {
            assert_eq!(api.tick(session, &state), (code::HANDLE, Wrench::ZERO), "{id:#x}");
            assert_eq!((api.session_destroy)(session), code::HANDLE);
        }
    }
    known.iter().for_each(|session| assert_eq!(api.tick(*session, &state).0, code::OK));
}

#[test]
fn fluid_times_are_checked() {
    let api = ready();
    let session = api.jet();
    for (expected, time_s) in [
        (code::NOT_FINITE, f64::NAN),
        (code::NOT_FINITE, f64::INFINITY),
        (code::TIME, -0.1),
        (code::TIME, 2e7),
    ] {
        assert_eq!((api.fluid_advance)(session, time_s), expected);
        assert_eq!((api.fluid_step)(session, time_s), expected);
    }
    assert_eq!((api.fluid_advance)(session, 10.5), code::TIME);
    assert_eq!((api.fluid_advance)(session, 0.02), code::OK);
    assert_eq!((api.fluid_step)(session, 0.02), code::TIME);
    assert_eq!((api.fluid_step)(session, 0.035), code::OK);
    assert_eq!((api.fluid_advance)(session, 0.03), code::OK);
    assert_eq!(api.report(session).fluid_frame, 3);
    assert_eq!((api.fluid_advance)(session, 0.04), code::OK);
    assert_eq!(api.report(session).fluid_frame, 4);
}

#[test]
fn the_run_is_that_of_the_virtual_clock_to_the_last_bit() {
    let cpu = JET.replace("backend = \"analytic-jet\"", "") + "\n[fluid]\nspacing = 0.01\n";
    let odd = JET.replace("fluid_hz = 100", "fluid_hz = 60");
    for scene in [JET, &cpu, &odd] {
        let api = ready();
        let session = api.try_create(scene).unwrap();
        let c = api.run(session, 0, 200);
        let mut progress = |_: hapflow::engine::run::Progress<'_>| ControlFlow::Continue(());
        let options = RunOptions {
            parts: Parts::default(),
            threads: 1,
            pictures_at: &[],
            record: None,
            guide: &mut |_| ControlFlow::Continue(()),
            progress: &mut progress,
        };
        let rust = virtual_clock(&parse(scene, "toml").unwrap(), options).unwrap();
        let sent: Vec<_> = rust.recording.rows.iter().map(|r| r.sent.force.to_array()).collect();
        assert_eq!(c.iter().map(|w| w.force).collect::<Vec<_>>(), sent);
        assert!(felt(c.last().unwrap()) > 0.1);
        let (report, last) = (api.report(session), rust.recording.rows.last().unwrap());
        assert_eq!((report.tick, report.model_frame, report.force), (200, last.frame, *sent.last().unwrap()));
        assert_eq!(FaultSet::from_bits(report.faults), last.faults);
        assert_eq!((report.particles, report.max_speed), (rust.fluid.particles as u64, rust.fluid.max_speed));
    }
}

#[test]
fn particles_come_in_two_calls() {
    let api = ready();
    let scene = JET.replace("backend = \"analytic-jet\"", "") + "\n[fluid]\nspacing = 0.01\n";
    let session = api.try_create(&scene).unwrap();
    let mut count = 9;
    assert_eq!((api.fluid_particles)(session, null_mut(), 0, &mut count), code::OK);
    assert_eq!(count, 0);
    api.run(session, 0, 101);
    assert_eq!((api.fluid_particles)(session, null_mut(), 0, &mut count), code::OK);
    assert_eq!(count as u64, api.report(session).particles);
    assert!(count > 10);
    let mut positions = vec![9.0_f32; 3 * count + 3];
    assert_eq!((api.fluid_particles)(session, positions.as_mut_ptr(), 4, &mut count), code::MORE);
    assert!(positions[11] < 1.0 && positions[12] == 9.0);
    assert_eq!((api.fluid_particles)(session, positions.as_mut_ptr(), count + 1, &mut count), code::OK);
    let (known, rest) = positions.split_at(3 * count);
    assert!(known.iter().all(|x| x.abs() < 0.15) && rest == [9.0; 3]);
}

#[test]
fn particles_come_to_main_with_the_frame_after_they_were_asked_for() {
    let api = ready();
    let scene = JET.replace("backend = \"analytic-jet\"", "") + "\n[fluid]\nspacing = 0.01\n";
    let session = api.try_create(&scene).unwrap();
    let count = || {
        let mut count = 9;
        assert_eq!((api.session_particles)(session, null_mut(), 0, &mut count), code::OK);
        count
    };
    assert_eq!(count(), 0);
    api.run(session, 0, 51);
    // What was asked for came with the first frame, before anything flowed in far.
    let first = count();
    assert!(first > 0);
    // The count holds, though another frame comes.
    api.run(session, 51, 101);
    let mut positions = vec![9.0_f32; 3 * first + 3];
    let mut fetch = |capacity| {
        let mut told = 0;
        let result = (api.session_particles)(session, positions.as_mut_ptr(), capacity, &mut told);
        (result, told, positions[3 * capacity])
    };
    assert_eq!(fetch(first), (code::OK, first, 9.0));
    // And a call that follows no count takes the newest.
    let (result, newest, _) = fetch(2);
    assert!(result == code::MORE && newest > first, "{newest} after {first}");
    assert!(positions[..3 * first].iter().all(|x| x.abs() < 0.15));
}

#[test]
fn the_emergency_stop_holds_until_it_is_cleared() {
    let api = ready();
    let session = api.jet();
    let full = felt(api.run(session, 0, 150).last().unwrap());
    assert_eq!((api.session_emergency_stop)(session), code::OK);
    assert_eq!(api.report(session).faults & 1 << 5, 1 << 5);
    assert_eq!(api.run(session, 150, 160), vec![Wrench::ZERO; 10]);
    assert_eq!(api.tick(session, &api.state(160)).0, code::FORCE_HELD);
    assert_eq!((api.session_clear_faults)(session), code::OK);
    let again = api.run(session, 161, 200);
    assert!(felt(&again[0]) < 0.1 * full && felt(&again[38]) > 0.9 * full);
}

#[test]
fn two_sessions_know_nothing_of_each_other() {
    let api = ready();
    let alone = api.run(api.jet(), 0, 100);
    let (a, b, stopped) = (api.jet(), api.jet(), api.jet());
    assert_eq!((api.session_emergency_stop)(stopped), code::OK);
    let (mut of_a, mut of_b) = (Vec::new(), Vec::new());
    for n in 0..100 {
        of_a.extend(api.run(a, n, n + 1));
        api.run(stopped, n, n + 1);
        of_b.extend(api.run(b, n, n + 1));
    }
    assert_eq!((&of_a, &of_b), (&alone, &alone));
    assert_eq!(api.set(a, "fluid.viscosity", 1.0), code::OK);
    assert_ne!(api.get(b, "fluid.viscosity"), Ok(1.0));
}

#[test]
fn a_full_table_says_so() {
    let api = ready();
    let all: Vec<_> = (0..64).map(|_| api.jet()).collect();
    assert_eq!(api.try_create(JET), Err(code::FULL));
    assert_eq!((api.session_destroy)(all[31]), code::OK);
    assert!(api.try_create(JET).is_ok());
    assert_eq!(api.try_create(JET), Err(code::FULL));
}

#[test]
fn every_result_has_a_text_and_so_has_nonsense() {
    let api = ready();
    for result in (-25..10).chain([i32::MIN, i32::MAX]) {
        // SAFETY: the header says that it is a text, for ever.
        let text = unsafe { CStr::from_ptr((api.result_text)(result)) };
        assert!(text.to_str().unwrap().len() > 3);
    }
}

#[test]
fn the_last_error_is_of_this_thread_and_may_be_cut() {
    let api = ready();
    let session = api.jet();
    assert_eq!(api.error(), "");
    let path = CString::new("fluid.viscositi").unwrap();
    assert_eq!((api.session_set)(session, path.as_ptr(), 1.0), code::SETTING);
    std::thread::scope(|s| s.spawn(|| assert_eq!(api.error(), "")).join().unwrap());
    let (mut buffer, mut length) = ([1 as c_char; 8], 0);
    assert_eq!((api.last_error)(buffer.as_mut_ptr(), 8, &mut length), code::MORE);
    assert!(buffer[7] == 0 && buffer[6] != 0 && length > 8);
}
