//! The tables of `docs/c-abi.md`: every function as the header has it, and every mistake with what comes of it, tried
//! out here.
// A test's helpers fail as the test does.
#![allow(clippy::unwrap_used, clippy::panic)]

mod c_support;

use c_support::header::{Prototype, prototypes};
use c_support::{
    Api, DRIVE_OWNED, Device, Scene, Session, SessionConfig, SourceConfig, ToolState, Variant, Wrench, code,
    made, root,
};
use std::ffi::{CStr, c_char, c_void};
use std::ptr::{null, null_mut};
use std::sync::atomic::{AtomicBool, Ordering};
use std::{env, fs, thread};

/// Compares a table of the document with `now`, or writes it there.
fn compare(table: &str, now: &str) {
    let path = root().join("docs/c-abi.md");
    let text = fs::read_to_string(&path).unwrap();
    let (begin, end) = (format!("<!-- {table} -->\n"), format!("<!-- end of {table} -->"));
    let (before, rest) = text.split_once(&begin).unwrap_or_else(|| panic!("no {begin}"));
    let (then, after) = rest.split_once(&end).unwrap_or_else(|| panic!("no {end}"));
    if then != now && env::var_os("HAPFLOW_BLESS").is_some_and(|v| v == "1") {
        fs::write(&path, [before, &begin, now, &end, after].concat()).unwrap();
    } else {
        assert_eq!(then, now, "docs/c-abi.md is old: HAPFLOW_BLESS=1 cargo test --test c_docs");
    }
}

/// `| function | class | what it does | fails with |`
fn row(function: &Prototype) -> String {
    let (what, rest) = function.comment.split_once(". [").unwrap();
    let (class, rest) = rest.split_once(']').unwrap();
    let errors = rest.split_once("Errors: ").map_or("", |(_, e)| e.split_once('.').map_or(e, |e| e.0));
    let errors = errors.strip_prefix("as ").map_or(errors.into(), |other| format!("as `{other}`"));
    format!("| `{}` | {class} | {} | {errors} |\n", function.name, what)
}

#[test]
fn the_table_of_functions_is_the_headers() {
    let mut table = String::from("| function | class | what it does | fails with |\n|---|---|---|---|\n");
    prototypes().iter().for_each(|function| table += &row(function));
    compare("functions", &table);
}

/// What a mistake came to: the result, and the wrench if the call gives one.
type Came = (i32, Option<Wrench>);

/// A mistake in a session that has just felt its full force, in its tick 150.
struct Mistake {
    what: &'static str,
    make: fn(&Api, Session) -> Came,
}

/// A tick with a state that is wrong.
fn tick(api: &Api, session: Session, spoil: fn(&mut ToolState)) -> Came {
    let mut state = api.state(150);
    spoil(&mut state);
    let (result, wrench) = api.tick(session, &state);
    (result, Some(wrench))
}

fn create(api: &Api, spoil: fn(&mut SessionConfig)) -> Came {
    let mut config = SessionConfig { scene: c"tap".as_ptr(), ..api.config() };
    spoil(&mut config);
    ((api.session_create)(&config, &mut Session::default()), None)
}

fn null_device(api: &Api) -> Device {
    api.open(c"null", c"").unwrap()
}

fn with_devices(api: &Api, servo_drive: u32, devices: &[Device]) -> Came {
    with_devices_in(api, c_support::JET, servo_drive, devices)
}

fn with_devices_in(api: &Api, toml: &str, servo_drive: u32, devices: &[Device]) -> Came {
    let (device_count, devices) = (devices.len() as u32, devices.as_ptr());
    let config = SessionConfig { servo_drive, device_count, devices, ..api.config() };
    (api.try_create_with(toml, config).err().unwrap_or(code::OK), None)
}

/// Calls `call` for a session from its own log function.
fn from_the_log(api: &Api, call: fn(&Api, Session) -> i32) -> Came {
    struct Told {
        api: Api,
        session: Session,
        call: fn(&Api, Session) -> i32,
        came: Option<i32>,
    }
    extern "C" fn listen(_: u32, _: *const c_char, user: *mut c_void) {
        // SAFETY: it is `told`, which nobody else looks at during the poll.
        let told = unsafe { &mut *user.cast::<Told>() };
        told.came = Some((told.call)(&told.api, told.session));
    }
    let mut told = Told { api: *api, session: Session::default(), call, came: None };
    let log_user = (&raw mut told).cast();
    let config = SessionConfig { log: Some(listen), log_user, ..api.config() };
    let session = api.try_create_with(c_support::JET, config).unwrap();
    // SAFETY: `told` lives, and is looked at by this thread alone.
    unsafe { (*log_user.cast::<Told>()).session = session };
    assert_eq!((api.session_emergency_stop)(session), code::OK);
    assert_eq!((api.session_poll)(session), code::OK);
    (told.came.unwrap(), None)
}

fn read_radius(api: &Api, session: Session) -> i32 {
    api.get(session, "tool.radius").err().unwrap_or(code::OK)
}

fn set_text(api: &Api, session: Session, path: &CStr, value: &CStr) -> Came {
    ((api.session_set_text)(session, path.as_ptr(), value.as_ptr()), None)
}

/// The second of two threads that tick one session.
fn tick_in_two_threads(api: &Api, session: Session) -> Came {
    let (state, found) = (api.state(150), AtomicBool::new(false));
    let until_found = || {
        for _ in 0..50_000_000 {
            let (result, wrench) = api.tick(session, &state);
            if result == code::BUSY {
                found.store(true, Ordering::Relaxed);
                return Some((result, Some(wrench)));
            }
            if found.load(Ordering::Relaxed) {
                return None;
            }
        }
        None
    };
    thread::scope(|scope| {
        let other = scope.spawn(until_found);
        let mine = until_found();
        mine.or(other.join().unwrap()).unwrap()
    })
}

fn panicking(api: &Api, call: impl Fn() -> Came) -> Came {
    (api.test_panic_next_call.unwrap())();
    call()
}

const MISTAKES: &[Mistake] = &[
    Mistake {
        what: "a session is made before `hapflow_negotiate`",
        make: |_, _| create(&Api::load(Variant::Hooks), |_| ()),
    },
    Mistake {
        what: "a version that the library does not speak",
        make: |api, _| ((api.negotiate)(7, 9, &mut 0), None),
    },
    Mistake {
        what: "a pointer is null",
        make: |api, session| ((api.session_get)(session, c"tool.radius".as_ptr(), null_mut()), None),
    },
    Mistake {
        what: "a tick without a state",
        make: |api, session| {
            let mut wrench = Wrench::UNTOUCHED;
            ((api.servo_tick)(session, null(), &mut wrench), Some(wrench))
        },
    },
    Mistake {
        what: "a tick without a wrench",
        make: |api, session| ((api.servo_tick)(session, &api.state(150), null_mut()), None),
    },
    Mistake {
        what: "a position that is NaN",
        make: |api, session| tick(api, session, |s| s.position[1] = f64::NAN),
    },
    Mistake {
        what: "a velocity that is infinite",
        make: |api, session| tick(api, session, |s| s.velocity[0] = f64::INFINITY),
    },
    Mistake {
        what: "a position 2 km away",
        make: |api, session| tick(api, session, |s| s.position[2] = 2000.0),
    },
    Mistake {
        what: "an orientation of zeros",
        make: |api, session| tick(api, session, |s| s.orientation = [0.0; 4]),
    },
    Mistake {
        what: "a time before the last tick's",
        make: |api, session| tick(api, session, |s| s.time_s = 0.1),
    },
    Mistake { what: "a `dt_s` below zero", make: |api, session| tick(api, session, |s| s.dt_s = -1e-3) },
    Mistake { what: "a `dt_s` of zero", make: |api, session| tick(api, session, |s| s.dt_s = 0.0) },
    Mistake {
        what: "a tick after a pause of half a second",
        make: |api, session| tick(api, session, |s| s.dt_s = 0.5),
    },
    Mistake { what: "a tool that there is not", make: |api, session| tick(api, session, |s| s.tool = 1) },
    Mistake {
        what: "a tool state that no init function has made",
        make: |api, session| tick(api, session, |s| s.size = 0),
    },
    Mistake {
        what: "a tick of a session that is destroyed",
        make: |api, session| {
            assert_eq!((api.session_destroy)(session), code::OK);
            tick(api, session, |_| ())
        },
    },
    Mistake {
        what: "a session is destroyed twice",
        make: |api, session| {
            assert_eq!((api.session_destroy)(session), code::OK);
            ((api.session_destroy)(session), None)
        },
    },
    Mistake { what: "two threads tick at once", make: tick_in_two_threads },
    Mistake {
        what: "the emergency stop, and a tick",
        make: |api, session| {
            assert_eq!((api.session_emergency_stop)(session), code::OK);
            tick(api, session, |_| ())
        },
    },
    Mistake {
        what: "the fluid is advanced by another clock",
        make: |api, session| ((api.fluid_advance)(session, 1e6), None),
    },
    Mistake {
        what: "a frame ends before the last one",
        make: |api, session| ((api.fluid_step)(session, 0.01), None),
    },
    Mistake {
        what: "the host steps a fluid that the session steps",
        make: |api, _| {
            let owned = SessionConfig { fluid_drive: DRIVE_OWNED, ..api.config() };
            let session = api.try_create_with(c_support::JET, owned).unwrap();
            ((api.fluid_advance)(session, 0.15), None)
        },
    },
    Mistake {
        what: "the host ticks a servo that the session ticks",
        make: |api, _| {
            let owned = SessionConfig { servo_drive: DRIVE_OWNED, ..api.config() };
            let session = api.try_create_with(c_support::JET, owned).unwrap();
            tick(api, session, |_| ())
        },
    },
    Mistake {
        what: "a device for a servo that the host ticks",
        make: |api, _| with_devices(api, 0, &[null_device(api)]),
    },
    Mistake {
        what: "more devices than the scene has tools",
        make: |api, _| with_devices(api, DRIVE_OWNED, &[null_device(api), null_device(api)]),
    },
    Mistake {
        what: "one device for two tools",
        make: |api, _| {
            let device = null_device(api);
            let toml = format!("{}{}", c_support::JET, c_support::SECOND);
            with_devices_in(api, &toml, DRIVE_OWNED, &[device, device])
        },
    },
    Mistake {
        what: "a device that a session has taken over",
        make: |api, _| {
            let device = null_device(api);
            assert_eq!(with_devices(api, DRIVE_OWNED, &[device]).0, code::OK);
            ((api.device_read)(device, 0.0, &mut made(api.tool_state_init)), None)
        },
    },
    Mistake {
        what: "a device that there is not",
        make: |api, _| (api.open(c"falcn", c"").unwrap_err(), None),
    },
    Mistake {
        what: "a device is closed twice",
        make: |api, _| {
            let device = null_device(api);
            assert_eq!((api.device_close)(device), code::OK);
            ((api.device_close)(device), None)
        },
    },
    Mistake {
        what: "a device is read at a time before its last",
        make: |api, _| {
            let device = null_device(api);
            api.read(device, 1.0);
            ((api.device_read)(device, 0.9, &mut made(api.tool_state_init)), None)
        },
    },
    Mistake {
        what: "a wrench that is NaN is written to a device",
        make: |api, _| {
            let wrench = Wrench { force: [f64::NAN; 3], ..Wrench::ZERO };
            ((api.device_write)(null_device(api), &wrench, 1e-3), None)
        },
    },
    Mistake {
        what: "a write to a device after such a one",
        make: |api, _| {
            let device = null_device(api);
            assert_eq!((api.device_write)(device, null(), 1e-3), code::NULL);
            ((api.device_write)(device, &Wrench::ZERO, 1e-3), None)
        },
    },
    Mistake {
        what: "one device more than `HAPFLOW_MAX_DEVICES`",
        make: |api, _| {
            let last = std::iter::repeat_with(|| api.open(c"null", c"")).take(65).last();
            (last.unwrap().unwrap_err(), None)
        },
    },
    Mistake {
        what: "a log function calls main of its session",
        make: |api, _| from_the_log(api, read_radius),
    },
    Mistake {
        what: "a log function destroys its session",
        make: |api, _| from_the_log(api, |api, session| (api.session_destroy)(session)),
    },
    Mistake {
        what: "an obstacle that there is not",
        make: |api, session| ((api.obstacle_move)(session, 0, &[0.0; 3], &[0.0, 0.0, 0.0, 1.0]), None),
    },
    Mistake {
        what: "a force limit above the present one",
        make: |api, session| ((api.session_limit_force)(session, 4.5, 0.1), None),
    },
    Mistake {
        what: "a limit of the gate that is raised while the session runs",
        make: |api, session| set_text(api, session, c"gate.max_force", c"4.5"),
    },
    Mistake {
        what: "a source of a name that the scene has",
        make: |api, _| {
            let (scene, tap) =
                (api.scene(), SourceConfig { name: c"tap".as_ptr(), ..made(api.source_config_init) });
            assert_eq!((api.scene_add_source)(scene, &tap, null_mut()), code::OK);
            ((api.scene_add_source)(scene, &tap, null_mut()), None)
        },
    },
    Mistake {
        what: "a pool whose corners are the wrong way round",
        make: |api, _| ((api.scene_add_pool)(api.scene(), &[1.0; 3], &[0.0; 3], null_mut()), None),
    },
    Mistake {
        what: "a session of a scene that is destroyed",
        make: |api, _| {
            let built = api.scene();
            assert_eq!((api.scene_destroy)(built), code::OK);
            let config = SessionConfig { built, ..api.config() };
            ((api.session_create)(&config, &mut Session::default()), None)
        },
    },
    Mistake {
        what: "one scene more than `HAPFLOW_MAX_SCENES`",
        make: |api, _| {
            (0..64).for_each(|_| assert_ne!(api.scene(), Scene::default()));
            ((api.scene_create)(&mut Scene::default()), None)
        },
    },
    Mistake {
        what: "a scene after a panic in it",
        make: |api, _| {
            let scene = api.scene();
            panicking(api, || ((api.scene_check)(scene), None));
            ((api.scene_check)(scene), None)
        },
    },
    Mistake {
        what: "contacts of a size that no version has",
        make: |api, session| ((api.session_contacts)(session, 0, null_mut(), 87, 0, &mut 0), None),
    },
    Mistake {
        what: "a recording in a session that was made without",
        make: |api, session| ((api.session_record)(session, c"run.csv".as_ptr()), None),
    },
    Mistake {
        what: "a recording in a folder that there is not",
        make: |api, _| {
            let config = SessionConfig { record: 1, ..api.config() };
            let session = api.try_create_with(c_support::JET, config).unwrap();
            ((api.session_record)(session, c"/nowhere/at/all.csv".as_ptr()), None)
        },
    },
    Mistake {
        what: "a recording is ended that there is not",
        make: |api, session| ((api.session_record_stop)(session, &mut 0, &mut 0), None),
    },
    Mistake {
        what: "a setting outside its range",
        make: |api, session| set_text(api, session, c"fluid.viscosity", c"-1"),
    },
    Mistake {
        what: "a setting to NaN",
        make: |api, session| ((api.session_set)(session, c"fluid.viscosity".as_ptr(), f64::NAN), None),
    },
    Mistake {
        what: "a setting of the wrong type",
        make: |api, session| set_text(api, session, c"fluid.viscosity", c"thick"),
    },
    Mistake {
        what: "a setting that there is not",
        make: |api, session| set_text(api, session, c"fluid.viscosty", c"1"),
    },
    Mistake {
        what: "a setting that is not live",
        make: |api, session| set_text(api, session, c"run.fluid_hz", c"60"),
    },
    Mistake { what: "a text that is not UTF-8", make: |api, session| set_text(api, session, c"\xff", c"1") },
    Mistake {
        what: "an index that is not below the count",
        make: |api, session| {
            ((api.session_setting_info)(session, 10_000, &mut made(api.setting_info_init)), None)
        },
    },
    Mistake {
        what: "a buffer that is too small",
        make: |api, session| {
            let mut text = [0; 4];
            let path = c"run.backend".as_ptr();
            ((api.session_get_text)(session, path, text.as_mut_ptr(), 4, &mut 0), None)
        },
    },
    Mistake {
        what: "no shipped scene of that name",
        make: |api, _| create(api, |c| c.scene = c"tapp".as_ptr()),
    },
    Mistake { what: "both `scene` and `toml`", make: |api, _| create(api, |c| c.toml = c"".as_ptr()) },
    Mistake {
        what: "a scene file with an error",
        make: |api, _| {
            create(api, |c| {
                c.scene = null();
                c.toml = c"[fluid]\nspacing = -1\n".as_ptr();
            })
        },
    },
    Mistake {
        what: "a struct that is chained, but not known",
        make: |api, _| create(api, |c| c.next = MISTAKES.as_ptr().cast()),
    },
    Mistake {
        what: "a configuration that no init function has made",
        make: |api, _| create(api, |c| c.kind = 0),
    },
    Mistake {
        what: "one session more than `HAPFLOW_MAX_SESSIONS`",
        make: |api, _| {
            let last = std::iter::repeat_with(|| api.try_create(c_support::JET)).take(65).last();
            (last.unwrap().unwrap_err(), None)
        },
    },
    Mistake {
        what: "a panic inside the library, in a tick",
        make: |api, session| panicking(api, || tick(api, session, |_| ())),
    },
    Mistake {
        what: "a panic inside the library, in the fluid",
        make: |api, session| panicking(api, || ((api.fluid_advance)(session, 0.15), None)),
    },
    Mistake {
        what: "the fluid, after a panic in it",
        make: |api, session| {
            panicking(api, || ((api.fluid_advance)(session, 0.15), None));
            ((api.fluid_advance)(session, 0.15), None)
        },
    },
];

/// The name of a result in the header, from the published numbers.
fn name(result: i32) -> String {
    let numbers = fs::read_to_string(root().join("crates/capi/abi/layouts.txt")).unwrap();
    let is_it = |line: &&str| {
        let kinds = ["HAPFLOW_OK ", "HAPFLOW_REMARK_", "HAPFLOW_ERROR_"];
        kinds.iter().any(|k| line.starts_with(k)) && line.ends_with(&format!(" = {result}"))
    };
    let line = numbers.lines().find(is_it).unwrap_or_else(|| panic!("no result {result}"));
    line.split_once(" = ").unwrap().0.trim_start_matches("HAPFLOW_").to_string()
}

/// A force in words, next to that of the ticks before.
fn words(force: f64, full: f64) -> &'static str {
    if force == 0.0 {
        "zero"
    } else if (force - full).abs() < 0.2 * full {
        "as before"
    } else {
        panic!("{force} after {full}")
    }
}

fn mistake_row(mistake: &Mistake) -> String {
    let api = Api::ready(Variant::Hooks);
    let session = api.jet();
    let full = api.run(session, 0, 150).last().unwrap().force[1].abs();
    assert!(full > 0.1);
    let (result, wrench) = (mistake.make)(&api, session);
    let during = wrench.map_or("-", |w| words(w.force[1].abs(), full));
    let (next, wrench) = api.tick(session, &api.state(151));
    let after = match next {
        code::HANDLE => "-",
        code::FORCE_HELD => "zero until cleared",
        code::OK => words(wrench.force[1].abs(), full),
        other => panic!("{}: then {other}", mistake.what),
    };
    assert!(after != "zero", "{}", mistake.what);
    format!("| {} | `{}` | {during} | {after} |\n", mistake.what, name(result))
}

#[test]
fn the_table_of_mistakes_is_what_happens() {
    let mut table = String::from(
        "| mistake | result | force of this call | of the next sound tick |\n|---|---|---|---|\n",
    );
    MISTAKES.iter().for_each(|mistake| table += &mistake_row(mistake));
    compare("mistakes", &table);
}
