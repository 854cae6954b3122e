//! Optional parts: their tables, and a library that was built without them.
// A test's helpers fail as the test does.
#![allow(clippy::unwrap_used, clippy::panic)]

mod c_support;

use c_support::{Api, DRIVE_OWNED, Device, JET, Session, SessionConfig, Variant, Wrench, code, made};
use std::ffi::{CStr, c_char, c_void};
use std::ptr::null;
use std::thread;
use std::time::Duration;

/// A table: its size, and the functions in it.
fn table(api: &Api, name: &CStr) -> Option<Vec<usize>> {
    let table: *const u32 = (api.extension)(name.as_ptr()).cast();
    if table.is_null() {
        return None;
    }
    // SAFETY: a table begins with its size, a zero, and has pointers to functions up to there.
    unsafe {
        assert_eq!(*table.add(1), 0);
        let functions = (*table as usize - 8) / size_of::<usize>();
        Some(std::slice::from_raw_parts(table.add(2).cast(), functions).to_vec())
    }
}

/// What `features` of the build info lists.
fn has_feature(api: &Api, name: &str) -> bool {
    let info = api.build_info();
    let line = info.lines().find_map(|line| line.strip_prefix("features =")).unwrap().to_string();
    line.split_whitespace().any(|word| word == name)
}

#[test]
fn a_parts_table_has_the_functions_of_its_header() {
    // Nothing is negotiated.
    let api = Api::load(Variant::Shipped);
    let device = [
        api.device_config_init as *const () as usize,
        api.device_open as *const () as usize,
        api.device_close as *const () as usize,
        api.device_read as *const () as usize,
        api.device_write as *const () as usize,
        api.device_clear_faults as *const () as usize,
    ];
    assert_eq!(table(&api, c"hapflow.device/1").unwrap(), device);
    assert_eq!(table(&api, c"hapflow.log/1").unwrap(), [api.session_poll as *const () as usize]);
    for name in [c"", c"hapflow.device/2", c"hapflow.device", c"hapflow.device/1 ", c"device/1", c"\xff"] {
        assert!(table(&api, name).is_none(), "{name:?}");
    }
    assert!((api.extension)(null()).is_null());
    assert!(has_feature(&api, "device") && has_feature(&api, "log"));
}

extern "C" fn listen(_: u32, _: *const c_char, _: *mut c_void) {}

#[test]
fn a_library_without_parts_says_so_and_does_the_rest() {
    let (bare, shipped) = (Api::ready(Variant::Bare), Api::ready(Variant::Shipped));
    assert!(table(&bare, c"hapflow.device/1").is_none() && table(&bare, c"hapflow.log/1").is_none());
    assert!(!has_feature(&bare, "device") && !has_feature(&bare, "log"));
    let config = made(shipped.device_config_init);
    let mut device = Device { id: 7 };
    let results = [
        (bare.device_config_init)(&mut { config }, 56),
        (bare.device_open)(&config, &mut device),
        (bare.device_close)(device),
        (bare.device_read)(device, 0.0, &mut bare.state(0)),
        (bare.device_write)(device, &Wrench::ZERO, 1e-3),
        (bare.device_clear_faults)(device),
        (bare.session_poll)(Session::default()),
    ];
    assert_eq!(results, [code::UNSUPPORTED; 7]);
    assert_eq!(device, Device { id: 7 });
    for (config, says) in [
        (SessionConfig { log: Some(listen), ..bare.config() }, "log"),
        (
            SessionConfig { servo_drive: DRIVE_OWNED, device_count: 1, devices: &device, ..bare.config() },
            "device_count",
        ),
    ] {
        assert_eq!(bare.try_create_with(JET, config), Err(code::UNSUPPORTED));
        assert!(bare.error().starts_with(says), "{}", bare.error());
    }
    assert_eq!(bare.run(bare.jet(), 0, 100), shipped.run(shipped.jet(), 0, 100));
    // Its own device is the scene's.
    let session =
        bare.try_create_with(JET, SessionConfig { servo_drive: DRIVE_OWNED, ..bare.config() }).unwrap();
    while bare.report(session).tick == 0 {
        thread::sleep(Duration::from_millis(1));
    }
    assert_eq!((bare.session_destroy)(session), code::OK);
}
