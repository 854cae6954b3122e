//! What a session tells its log function, and what that may not do.
// A test's helpers fail as the test does.
#![allow(clippy::unwrap_used, clippy::panic)]

mod c_support;

use c_support::{
    Api, DRIVE_OWNED, JET, SECOND, Session, SessionConfig, ToolState, Variant, code, made, shown,
};
use std::cell::RefCell;
use std::ffi::{c_char, c_void};
use std::thread;
use std::time::Duration;

type Besides = Box<dyn FnMut(&Api)>;

/// A log, and what the log function is to do besides.
struct Listener {
    api: Api,
    lines: RefCell<Vec<String>>,
    besides: RefCell<Option<Besides>>,
}

extern "C" fn listen(level: u32, text: *const c_char, user: *mut c_void) {
    // SAFETY: what `Listener::config` gave, on the thread that has it.
    let listener = unsafe { &*user.cast::<Listener>() };
    listener.lines.borrow_mut().push(format!("{level} {}", shown(text)));
    if let Some(besides) = listener.besides.borrow_mut().as_mut() {
        besides(&listener.api);
    }
}

impl Listener {
    fn new(api: Api) -> Self {
        Self { api, lines: RefCell::default(), besides: RefCell::default() }
    }

    fn session(&self, toml: &str, config: SessionConfig) -> Session {
        let log_user = (&raw const *self).cast_mut().cast();
        self.api.try_create_with(toml, SessionConfig { log: Some(listen), log_user, ..config }).unwrap()
    }

    /// What a poll tells.
    fn poll(&self, session: Session) -> Vec<String> {
        assert_eq!((self.api.session_poll)(session), code::OK);
        self.lines.take()
    }
}

#[test]
fn faults_are_told_as_they_come_and_go_and_nothing_twice() {
    let api = Api::ready(Variant::Shipped);
    let listener = Listener::new(api);
    let session = listener.session(JET, api.config());
    api.run(session, 0, 100);
    assert_eq!(listener.poll(session), [""; 0]);
    assert_eq!((api.session_emergency_stop)(session), code::OK);
    let stopped = listener.poll(session);
    assert_eq!(stopped, ["1 fault: emergency stop; no force until the faults are cleared"]);
    assert_eq!(listener.poll(session), [""; 0]);
    assert_eq!(api.tick(session, &ToolState { time_s: f64::NAN, ..api.state(100) }).0, code::NOT_FINITE);
    assert!(listener.poll(session)[0].starts_with("1 fault: a tool state was refused"));
    assert_eq!((api.session_clear_faults)(session), code::OK);
    api.run(session, 101, 103);
    assert_eq!(listener.poll(session).len(), 2);
    // A tick that found no frame for long.
    api.tick(session, &api.state(500));
    assert!(listener.poll(session).iter().any(|l| l.starts_with("2 remark: the fluid's newest frame")));
}

#[test]
fn a_session_without_a_log_function_tells_nobody() {
    let api = Api::ready(Variant::Shipped);
    let session = api.jet();
    assert_eq!((api.session_emergency_stop)(session), code::OK);
    assert_eq!((api.session_poll)(session), code::OK);
}

#[test]
fn of_several_tools_it_is_said_which() {
    let api = Api::ready(Variant::Shipped);
    let listener = Listener::new(api);
    let session = listener.session(&format!("{JET}{SECOND}"), api.config());
    api.run(session, 0, 50);
    let late = ToolState { tool: 1, ..api.state(49) };
    api.tick(session, &late);
    api.tick(session, &ToolState { time_s: 0.4, ..late });
    let told = listener.poll(session);
    assert!(!told.is_empty() && told.iter().all(|line| line.starts_with("2 tool 1: remark: ")), "{told:?}");
}

#[test]
fn a_log_function_may_call_everything_but_main_of_its_own_session() {
    let api = Api::ready(Variant::Shipped);
    let listener = Listener::new(api);
    let session = listener.session(JET, api.config());
    let other = api.jet();
    *listener.besides.borrow_mut() = Some(Box::new(move |api| {
        assert_eq!(api.get(session, "tool.radius"), Err(code::BUSY));
        assert_eq!((api.session_poll)(session), code::BUSY);
        assert_eq!((api.session_report)(session, &mut made(api.report_init)), code::BUSY);
        assert_eq!((api.session_destroy)(session), code::BUSY);
        assert!(api.tick(session, &api.state(0)).0 >= 0);
        assert!(api.get(other, "tool.radius").is_ok());
        assert_eq!((api.session_clear_faults)(session), code::OK);
    }));
    assert_eq!((api.session_emergency_stop)(session), code::OK);
    assert_eq!(listener.poll(session).len(), 1);
    *listener.besides.borrow_mut() = None;
    assert_eq!((api.session_destroy)(session), code::OK);
    assert_eq!((api.session_poll)(session), code::HANDLE);
}

#[test]
fn a_session_that_drives_itself_tells_its_priority_and_what_was_left_out() {
    let api = Api::ready(Variant::Shipped);
    let listener = Listener::new(api);
    // A fluid of 1000 frames a second, each with many sub-steps: no machine keeps up.
    let toml = "[run]\nfluid_hz = 1000\ndevice = \"null\"\n[[pool]]\nmin = [-0.02, -0.02, -0.02]\n\
                max = [0.02, 0.02, 0.02]\n[fluid]\nspacing = 0.005\nsound_speed = 400\n";
    let own = SessionConfig { servo_drive: DRIVE_OWNED, fluid_drive: DRIVE_OWNED, ..api.config() };
    let session = listener.session(toml, own);
    let first = listener.poll(session);
    assert!(first.iter().any(|l| l.contains("real-time priority of the servo: ")), "{first:?}");
    let slow = "fluid frames were left out: the fluid is too slow";
    while !listener.poll(session).iter().any(|line| line.starts_with("2 ") && line.contains(slow)) {
        thread::sleep(Duration::from_millis(10));
    }
    assert_eq!((api.session_destroy)(session), code::OK);
}
