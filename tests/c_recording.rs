//! Recordings from C.
// A test's helpers fail as the test does.
#![allow(clippy::unwrap_used, clippy::panic)]

mod c_support;

use c_support::{Api, JET, Session, SessionConfig, Variant, code, scratch};
use std::ffi::CString;
use std::path::{Path, PathBuf};
use std::ptr::{null, null_mut};

fn file(name: &str) -> PathBuf {
    scratch().join(format!("recording-{}-{name}", std::process::id()))
}

fn record(api: &Api, session: Session, path: &Path) -> i32 {
    (api.session_record)(session, CString::new(path.to_str().unwrap()).unwrap().as_ptr())
}

fn recorded(api: &Api) -> Session {
    api.try_create_with(JET, SessionConfig { record: 1, ..api.config() }).unwrap()
}

#[test]
fn what_was_recorded_is_played_again_as_it_was() {
    let api = Api::ready(Variant::Shipped);
    let (session, path) = (recorded(&api), file("played.csv"));
    assert_eq!(record(&api, session, &path), code::OK);
    let place = |n: u64| [0.01 * (0.03 * n as f64).sin(), 1e-3 / 3.0, 0.0];
    for n in 0..200 {
        let mut state = api.state(n);
        state.position = place(n);
        assert_eq!((api.fluid_advance)(session, state.time_s), code::OK);
        assert_eq!(api.tick(session, &state).0, code::OK);
    }
    let (mut ticks, mut lost) = (7, 7);
    assert_eq!((api.session_record_stop)(session, &mut ticks, &mut lost), code::OK);
    assert_eq!((ticks, lost), (200, 0));
    let settings = format!("run.motion = {}\nrun.motion_origin = scene\n", path.display());
    let device = api.open(c"replay", &CString::new(settings).unwrap()).unwrap_or_else(|c| {
        panic!("{c}: {}", api.error());
    });
    for n in 0..200 {
        assert_eq!(api.read(device, n as f64 * 1e-3).position, place(n), "{n}");
    }
}

#[test]
fn what_cannot_be_recorded_is_a_code_and_a_reason() {
    let api = Api::ready(Variant::Shipped);
    let (mut ticks, mut lost) = (7, 7);
    let without = api.jet();
    assert_eq!(record(&api, without, &file("never.csv")), code::RECORDING);
    assert!(api.error().contains("recording: the session was opened without"), "{}", api.error());
    let session = recorded(&api);
    assert_eq!((api.session_record_stop)(session, &mut ticks, &mut lost), code::RECORDING);
    assert_eq!((api.session_record)(session, null()), code::NULL);
    assert_eq!((api.session_record)(session, c"\xff".as_ptr()), code::TEXT);
    assert_eq!(record(&api, session, Path::new("/nowhere/at/all.csv")), code::FILE);
    assert!(api.error().starts_with("/nowhere/at/all.csv: No such file"), "{}", api.error());
    assert_eq!(record(&api, session, &file("once.csv")), code::OK);
    assert_eq!(record(&api, session, &file("never.csv")), code::RECORDING);
    assert_eq!((api.session_record_stop)(session, null_mut(), &mut lost), code::NULL);
    assert_eq!((api.session_record_stop)(session, &mut ticks, null_mut()), code::NULL);
    assert!(!file("never.csv").exists() && (ticks, lost) == (7, 7));
    // Without a stop it ends with its session.
    api.run(session, 0, 10);
    assert_eq!((api.session_destroy)(session), code::OK);
    assert_eq!(std::fs::read_to_string(file("once.csv")).unwrap().lines().count(), 11);
    assert_eq!((api.session_record_stop)(session, &mut ticks, &mut lost), code::HANDLE);
    for wrong in [2, u32::MAX] {
        let config = SessionConfig { record: wrong, ..api.config() };
        assert_eq!(api.try_create_with(JET, config), Err(code::UNSUPPORTED));
    }
}

#[test]
#[cfg(target_os = "linux")]
fn a_full_disc_is_told_at_the_stop_and_harms_no_tick() {
    let api = Api::ready(Variant::Shipped);
    let session = recorded(&api);
    assert_eq!(record(&api, session, Path::new("/dev/full")), code::OK);
    assert!(api.run(session, 0, 2000).last().unwrap().force[1] < -0.1);
    let (mut ticks, mut lost) = (7, 7);
    assert_eq!((api.session_record_stop)(session, &mut ticks, &mut lost), code::FILE);
    assert!(api.error().starts_with("/dev/full: No space left"), "{}", api.error());
    assert_eq!((ticks, lost), (7, 7));
}
