//! Devices from C: in a loop of the host, and in the threads of a session that ticks its servo itself.
// A test's helpers fail as the test does.
#![allow(clippy::unwrap_used, clippy::panic)]

mod c_support;

use c_support::{
    Api, DRIVE_OWNED, Device, DeviceConfig, JET, SECOND, Session, SessionConfig, ToolState, Variant, Wrench,
    code, made, shown,
};
use hapflow::engine::run::{RunOptions, virtual_clock};
use hapflow::engine::{Parts, Value, load, settings};
use std::ffi::CStr;
use std::ops::ControlFlow;
use std::ptr::{null, null_mut};
use std::sync::atomic::{AtomicU64, Ordering};
use std::thread;
use std::time::Duration;

fn ready() -> Api {
    Api::ready(Variant::Shipped)
}

fn down(newtons: f64) -> Wrench {
    Wrench { force: [0.0, -newtons, 0.0], ..Wrench::ZERO }
}

/// What the host's loop gives for the tap's hand: the force of each tick.
fn tap_with_its_hand(api: &Api, ticks: u64) -> Vec<[f64; 3]> {
    let settings = c"run.backend = analytic-jet".as_ptr();
    let scene = c"tap".as_ptr();
    let config = SessionConfig { scene, settings, ..api.config() };
    let mut session = Session::default();
    assert_eq!((api.session_create)(&config, &mut session), code::OK);
    // The session's gate has ramped and limited already.
    let settings = c"gate.ramp_in = 0".as_ptr();
    let config = DeviceConfig { scene, settings, ..made(api.device_config_init) };
    let mut device = Device::default();
    assert_eq!((api.device_open)(&config, &mut device), code::OK);
    let tick = |n: u64| {
        let time_s = n as f64 * 1e-3;
        assert_eq!((api.fluid_advance)(session, time_s), code::OK);
        let state = ToolState { dt_s: 1e-3, ..api.read(device, time_s) };
        let (result, wrench) = api.tick(session, &state);
        assert!(result >= 0 && (api.device_write)(device, &wrench, state.dt_s) >= 0, "tick {n}");
        wrench.force
    };
    (0..ticks).map(tick).collect()
}

#[test]
fn a_host_drives_the_simulated_hand_as_a_run_in_rust_does() {
    let mut scene = load("tap").unwrap();
    settings::set(&mut scene, "run.backend", &Value::Text("analytic-jet".into())).unwrap();
    settings::set(&mut scene, "run.duration", &Value::Number(0.8)).unwrap();
    let mut progress = |_: hapflow::engine::run::Progress<'_>| ControlFlow::Continue(());
    let options = RunOptions {
        parts: Parts::default(),
        threads: 1,
        pictures_at: &[],
        record: None,
        guide: &mut |_| ControlFlow::Continue(()),
        progress: &mut progress,
    };
    let rust = virtual_clock(&scene, options).unwrap().recording.rows;
    let c = tap_with_its_hand(&ready(), 800);
    assert_eq!(c.len(), rust.len());
    for (c, rust) in c.iter().zip(&rust) {
        let apart = c.iter().zip(rust.sent.force.to_array()).map(|(a, b)| (a - b).abs());
        assert!(apart.fold(0.0, f64::max) < 1e-9, "{c:?}, {:?} at {} s", rust.sent.force, rust.time_s);
    }
    assert!(c.iter().any(|force| force[1] < -0.05), "nothing was felt");
}

/// Presses a hand that wants to rest down for two seconds, and says how far it gives way, mm.
fn pressed(api: &Api, device: Device, from: u64, wrench: &Wrench) -> f64 {
    let at = |n: u64| api.read(device, n as f64 * 1e-3).position[1];
    let last = (from..from + 2000).fold(0.0, |_, n| {
        let y = at(n);
        assert!((api.device_write)(device, wrench, 1e-3) >= 0);
        y
    });
    -1e3 * last
}

#[test]
fn no_write_presses_harder_than_the_devices_gate_allows() {
    let api = ready();
    // A hand with a grip of 300 N/m.
    let device = api.open(c"hand", c"gate.max_force = 3\ngate.ramp_in = 0.1\n").unwrap();
    let fair = pressed(&api, device, 0, &down(1.5));
    assert!((fair - 5.0).abs() < 0.1, "{fair} mm");
    let most = pressed(&api, device, 2000, &down(1e300));
    assert!((most - 10.0).abs() < 0.1, "{most} mm");
    // What is refused takes the force off, until it is cleared.
    let nan = Wrench { torque: [f64::NAN; 3], ..Wrench::ZERO };
    assert_eq!((api.device_write)(device, &nan, 1e-3), code::NOT_FINITE);
    assert!(pressed(&api, device, 4000, &down(1.5)).abs() < 0.1);
    assert_eq!((api.device_write)(device, &down(1.5), 1e-3), code::FORCE_HELD);
    assert_eq!((api.device_clear_faults)(device), code::OK);
    assert!((pressed(&api, device, 6000, &down(1.5)) - 5.0).abs() < 0.1);
    assert_eq!((api.device_write)(device, &down(1.5), 0.0), code::NO_TIME);
    assert_eq!((api.device_write)(device, &down(1.5), 0.5), code::LATE);
    assert_eq!((api.device_close)(device), code::OK);
    assert_eq!((api.device_write)(device, &down(1.5), 1e-3), code::HANDLE);
}

#[test]
fn a_reading_keeps_the_tool_and_tells_the_time() {
    let api = ready();
    let device = api.open(c"replay", c"tool.position = [0.01, 0.02, 0.03]").unwrap();
    let mut state = ToolState { tool: 3, ..made(api.tool_state_init) };
    for (time_s, dt_s) in [(0.0, 1e-3), (0.25, 0.25), (0.25, 0.0)] {
        assert_eq!((api.device_read)(device, time_s, &mut state), code::OK);
        assert_eq!((state.tool, state.time_s, state.dt_s, state.size), (3, time_s, dt_s, 136));
    }
    assert!((state.position[0] - 0.01).abs() < 0.02 && state.velocity != [0.0; 3]);
    let before = state;
    for (time_s, result) in
        [(0.1, code::TIME), (-1.0, code::TIME), (2e7, code::TIME), (f64::NAN, code::NOT_FINITE)]
    {
        assert_eq!((api.device_read)(device, time_s, &mut state), result);
    }
    assert_eq!((api.device_read)(device, 1.0, null_mut()), code::NULL);
    assert_eq!(state, before);
}

#[test]
fn devices_are_refused_with_the_reason() {
    let api = ready();
    for (name, settings, result, says) in [
        (c"falcn", c"", code::NOT_FOUND, "falcn"),
        (c"\xff", c"", code::TEXT, "UTF-8"),
        (c"replay", c"run.motion = no-such.csv", code::SCENE, "no-such.csv"),
        (c"hand", c"hand.mass = -1", code::VALUE, "hand.mass = -1"),
        (c"hand", c"hand.grip = 1", code::SETTING, "hand.grip"),
        (c"hand", c"hand.mass", code::VALUE, "path = value"),
    ] {
        assert_eq!(api.open(name, settings), Err(result), "{name:?} {settings:?}");
        assert!(api.error().contains(says), "{}", api.error());
    }
    let good: DeviceConfig = made(api.device_config_init);
    let (toml, scene) = (c"[hand]\nmass = 0.2\n".as_ptr(), c"tap".as_ptr());
    for (config, result) in [
        (DeviceConfig { kind: 1, ..good }, code::STRUCT),
        (DeviceConfig { next: (&raw const good).cast(), ..good }, code::UNSUPPORTED),
        (DeviceConfig { toml, scene, ..good }, code::SCENE),
        (DeviceConfig { toml, ..good }, code::OK),
        (DeviceConfig { scene, ..good }, code::OK),
        (good, code::OK),
    ] {
        assert_eq!((api.device_open)(&config, &mut Device::default()), result, "{config:?}");
    }
    assert_eq!((api.device_open)(null(), &mut Device::default()), code::NULL);
    assert_eq!((api.device_open)(&good, null_mut()), code::NULL);
    let alone = Api::load(Variant::Shipped);
    assert_eq!(alone.open(c"null", c""), Err(code::NOT_NEGOTIATED));
}

fn owned(api: &Api, toml: &str, fluid_drive: u32, devices: &[Device]) -> Result<Session, i32> {
    let (device_count, devices) = (devices.len() as u32, devices.as_ptr());
    let config =
        SessionConfig { servo_drive: DRIVE_OWNED, fluid_drive, device_count, devices, ..api.config() };
    api.try_create_with(toml, config)
}

/// Waits until tool `tool` feels the jet.
fn wait_for_the_jet(api: &Api, session: Session, tool: u32, hosted_fluid: bool) {
    loop {
        let report = api.report_of(session, tool);
        if report.force[1] < -0.05 {
            return;
        }
        assert_eq!(report.faults & 0b1011_0111, 0, "{report:?}");
        if hosted_fluid {
            assert!((api.fluid_advance)(session, report.time_s) >= 0);
        }
        thread::sleep(Duration::from_millis(2));
    }
}

#[test]
fn a_session_ticks_its_servo_itself_and_host_or_session_step_the_fluid() {
    let api = ready();
    for fluid_drive in [0, DRIVE_OWNED] {
        let session = owned(&api, JET, fluid_drive, &[]).unwrap();
        wait_for_the_jet(&api, session, 0, fluid_drive == 0);
        let state = api.state(0);
        assert_eq!(api.tick(session, &state), (code::DRIVE, Wrench::ZERO));
        assert_eq!(api.tick(session, &ToolState { size: 0, ..state }), (code::DRIVE, Wrench::ZERO));
        assert_eq!(api.tick(session, &ToolState { tool: 1, ..state }), (code::DRIVE, Wrench::ZERO));
        assert_eq!(api.report(session).faults & 1, 0, "nothing latched");
        let stepped = (api.fluid_step)(session, 1e6);
        assert_eq!(stepped == code::DRIVE, fluid_drive == DRIVE_OWNED);
        let pace = api.pace(session, 0);
        assert_eq!((pace.owned, pace.running), (1, 1));
        assert!(
            pace.priority == 1 || pace.priority == 2 && shown(pace.priority_text).starts_with("refused: ")
        );
        assert_eq!(shown(pace.device), "null");
        assert_eq!((api.session_emergency_stop)(session), code::OK);
        while api.report(session).force != [0.0; 3] {
            thread::sleep(Duration::from_millis(1));
        }
        assert_eq!((api.session_destroy)(session), code::OK);
        assert_eq!(api.tick(session, &state), (code::HANDLE, Wrench::ZERO));
    }
}

#[test]
fn ticks_of_an_owned_servo_are_counted_and_those_of_a_host_are_not() {
    let api = ready();
    let session = owned(&api, JET, 0, &[]).unwrap();
    while api.pace(session, 0).ticks < 128 {
        thread::sleep(Duration::from_millis(5));
    }
    let pace = api.pace(session, 0);
    assert!(pace.ticks <= api.report(session).tick && pace.late <= pace.ticks);
    assert!(pace.median_s > 0.0 && pace.median_s <= pace.p99_s && pace.longest_s > 0.0);
    let mut untouched = made(api.servo_pace_init);
    assert_eq!((api.session_servo_pace)(session, 1, &mut untouched), code::INDEX);
    let hosted = api.jet();
    api.run(hosted, 0, 200);
    let pace = api.pace(hosted, 0);
    assert_eq!((pace.owned, pace.running, pace.priority, pace.ticks), (0, 0, 0, 0));
    assert_eq!((shown(pace.priority_text), shown(pace.device)), ("", ""));
}

#[test]
fn devices_go_over_to_a_session_or_stay_as_they_were() {
    let api = ready();
    let at = |place: &CStr| api.open(c"null", place).unwrap();
    let devices = [at(c""), at(c"tool.position = [0.06, 0, 0]")];
    let toml = format!("{JET}{SECOND}");
    let gone = at(c"");
    assert_eq!((api.device_close)(gone), code::OK);
    // Refused, each of them, and both devices are as before.
    for (toml, list, result) in [
        (JET, &devices[..], code::VALUE),
        (&toml, &[devices[0], devices[0]][..], code::HANDLE),
        (&toml, &[devices[0], gone][..], code::HANDLE),
        (&toml, &[devices[0], Device::default()][..], code::HANDLE),
        (&toml, &[devices[0]; 9][..], code::VALUE),
        ("[fluid]\nspacing = -1\n", &devices[..1], code::SCENE),
    ] {
        assert_eq!(owned(&api, toml, 0, list), Err(result));
        for device in devices {
            assert_eq!(api.read(device, 0.0).time_s, 0.0);
        }
    }
    let no_list = SessionConfig { servo_drive: DRIVE_OWNED, device_count: 1, ..api.config() };
    assert_eq!(api.try_create_with(&toml, no_list), Err(code::NULL));
    let session = owned(&api, &toml, DRIVE_OWNED, &devices).unwrap();
    for device in devices {
        assert_eq!((api.device_read)(device, 1.0, &mut made(api.tool_state_init)), code::HANDLE);
        assert_eq!((api.device_write)(device, &Wrench::ZERO, 1e-3), code::HANDLE);
        assert_eq!((api.device_close)(device), code::HANDLE);
        assert_eq!((api.device_clear_faults)(device), code::HANDLE);
    }
    (0..2).for_each(|tool| wait_for_the_jet(&api, session, tool, false));
    assert_eq!((api.pace(session, 0).owned, api.pace(session, 1).owned), (1, 1));
    assert_eq!((api.session_destroy)(session), code::OK);
    // One device for the first of two tools.
    let session = owned(&api, &toml, DRIVE_OWNED, &[at(c"")]).unwrap();
    wait_for_the_jet(&api, session, 0, false);
    assert_eq!((api.pace(session, 1).owned, api.report_of(session, 1).tick), (0, 0));
}

#[test]
fn a_session_with_threads_of_its_own_is_destroyed_while_others_look_at_it() {
    let api = ready();
    for n in 0..10 {
        let session = owned(&api, JET, DRIVE_OWNED, &[]).unwrap();
        let reports = AtomicU64::new(0);
        thread::scope(|scope| {
            scope.spawn(|| {
                while (api.session_report)(session, &mut made(api.report_init)) != code::HANDLE {
                    reports.fetch_add(1, Ordering::Relaxed);
                }
            });
            scope.spawn(|| while api.tick(session, &api.state(0)).0 != code::HANDLE {});
            while reports.load(Ordering::Relaxed) < 1000 * n {
                thread::yield_now();
            }
            assert_eq!((api.session_destroy)(session), code::OK);
        });
    }
}
