//! A thousand sessions and devices of the C interface, one after the other. Alone in its process, whose memory it looks at.
// A test's helpers fail as the test does.
#![allow(clippy::unwrap_used, clippy::panic)]

mod c_support;

use c_support::{Api, Variant, Wrench, code};

/// Memory of the process that is in use, KiB; 0 where it cannot be read.
fn resident_kib() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|l| l.strip_prefix("VmRSS:"));
    line.and_then(|l| l.trim().strip_suffix(" kB")?.trim().parse().ok()).unwrap_or(0)
}

#[test]
fn a_thousand_sessions_come_and_go_and_leave_nothing() {
    let api = Api::ready(Variant::Shipped);
    let mut before = 0;
    for n in 0..1000 {
        let device = api.open(c"hand", c"").unwrap();
        let session = api.jet();
        let scene = api.scene();
        assert!(api.written(scene).len() > 10);
        assert_eq!((api.scene_destroy)(scene), code::OK);
        api.run(session, 0, 2);
        assert_eq!((api.device_close)(device), code::OK);
        assert!(api.settings(session).len() > 60);
        assert_eq!((api.session_destroy)(session), code::OK);
        assert_eq!(api.tick(session, &api.state(3)), (code::HANDLE, Wrench::ZERO));
        if n == 100 {
            before = resident_kib();
        }
    }
    let grown = resident_kib().saturating_sub(before);
    assert!(grown < 4 << 10, "{grown} KiB more after 900 sessions and devices");
}
