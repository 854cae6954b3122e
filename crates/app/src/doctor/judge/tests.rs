//! Each judgement at its thresholds. The texts for Linux are tried on Linux only.

use super::*;
use crate::doctor::check::State;

fn refused(refusal: Refusal) -> Grant {
    Grant::Refused(refusal)
}

fn late(p99_us: f64) -> Lateness {
    Lateness { median_us: 0.26, p99_us, worst_us: 1234.4 }
}

#[test]
fn the_c_abi_is_that_of_the_header() {
    let header = include_str!("../../../../../include/hapflow/version.h");
    assert!(header.contains(&format!("#define HAPFLOW_ABI_VERSION {C_ABI}u")));
}

#[test]
fn versions_say_what_is_known() {
    let system = System {
        os: Some("Debian 12".into()),
        kernel: Some("6.12.1".into()),
        realtime_kernel: true,
        container: false,
    };
    let found = versions(&system).found;
    assert!(found.starts_with("hapflow "), "{found}");
    assert!(found.contains(", C ABI 1, Debian 12, "), "{found}");
    assert!(found.ends_with(", kernel 6.12.1 (PREEMPT_RT)"), "{found}");
    assert!(versions(&System::default()).found.ends_with("kernel not known on this system"));
}

#[test]
fn two_cores_are_enough() {
    assert_eq!(cores(Some(1)).state, State::Warning);
    assert_eq!(cores(Some(2)).state, State::Ok);
    assert_eq!(cores(None).found, NOT_KNOWN);
}

#[test]
fn only_scalar_code_is_a_warning() {
    for level in ["V4", "V3", "Neon", "Simd128", "a later one"] {
        assert_eq!(simd(level).state, State::Ok, "{level}");
    }
    let scalar = simd("Scalar");
    assert_eq!(scalar.state, State::Warning);
    assert!(scalar.found.contains("four times slower"));
}

#[test]
fn priority_granted_or_not_supported() {
    assert_eq!(priority(80, &Grant::Granted, false, None).state, State::Ok);
    assert_eq!(priority(80, &Grant::NotAsked, false, None).state, State::Warning);
    let check = priority(80, &refused(Refusal::NotSupported), false, None);
    assert_eq!((check.state, check.advice.as_str()), (State::Warning, NOT_KNOWN));
}

#[test]
#[cfg(target_os = "linux")]
fn a_refused_priority_comes_with_the_line_and_the_command() {
    let check = |limit, container, program: Option<&str>| {
        priority(80, &refused(Refusal::Priority { priority: 80, limit }), container, program.map(Path::new))
    };
    let plain = check(0, false, Some("/usr/bin/hapflow"));
    assert_eq!(plain.state, State::Warning);
    assert_eq!(plain.found, "real-time priority 80 refused; the limit (`ulimit -r`) is 0");
    assert!(plain.advice.contains("`@realtime - rtprio 80` to /etc/security/limits.conf"));
    assert!(plain.advice.ends_with("`sudo setcap cap_sys_nice=ep /usr/bin/hapflow`"));
    assert!(check(0, false, Some("/a b/hapflow")).advice.ends_with("=ep '/a b/hapflow'`"));
    assert!(check(79, false, None).advice.contains("limits.conf"));
    assert!(check(80, false, None).advice.contains("control group"));
    assert!(check(0, true, None).advice.contains("--cap-add SYS_NICE --ulimit rtprio=80"));
    let other = priority(80, &refused(Refusal::System { code: 22 }), false, None);
    assert!(other.found.contains("the system refused") && other.advice.contains("man 7 sched"));
}

#[test]
#[cfg(target_os = "linux")]
fn memory_that_may_not_be_locked_comes_with_the_line() {
    let granted = memory(&Grant::Granted, Some("8192 KiB"), false);
    assert_eq!(granted, Check::ok("memory", "may be locked into RAM; the limit (`ulimit -l`) is 8192 KiB"));
    let limited = refused(Refusal::MemoryLimit { limit_kib: 8192 });
    let check = memory(&limited, Some("8192 KiB"), false);
    assert_eq!(check.state, State::Warning);
    assert!(check.found.ends_with("the limit (`ulimit -l`) is 8192 KiB"));
    assert!(check.advice.contains("`@realtime - memlock unlimited` to /etc/security/limits.conf"));
    assert!(memory(&limited, None, true).advice.contains("--ulimit memlock=-1"));
    let full = memory(&refused(Refusal::System { code: 12 }), None, false);
    assert!(full.found.contains("the system refused") && full.advice.contains("mlockall"));
}

#[test]
fn memory_on_other_systems() {
    let check = memory(&refused(Refusal::NotSupported), None, false);
    assert_eq!((check.state, check.found.as_str()), (State::Warning, NOT_KNOWN));
}

#[test]
fn the_timer_warns_above_half_a_tick() {
    let ok = timer(&Ok((late(500.0), true)));
    assert_eq!(ok.state, State::Ok);
    assert_eq!(
        ok.found,
        "1 kHz at real-time priority: late by 0.3 µs median, 500 µs at 99 %, 1234 µs at worst"
    );
    assert_eq!(timer(&Ok((late(500.1), true))).state, State::Warning);
    assert_eq!(timer(&Ok((late(f64::INFINITY), true))).state, State::Warning);
    let none = timer(&Err("no room".into()));
    assert_eq!(none.state, State::Missing);
    assert!(none.found.contains("no room"));
}

#[test]
#[cfg(target_os = "linux")]
fn a_late_timer_without_priority_sends_to_the_priority() {
    assert!(timer(&Ok((late(900.0), false))).advice.contains("`priority`"));
    assert!(timer(&Ok((late(900.0), true))).advice.contains("PREEMPT_RT"));
}

#[test]
fn microseconds_are_short() {
    assert_eq!([0.0, 0.26, 9.94, 9.95, 123.4].map(us), ["0.0", "0.3", "9.9", "10", "123"]);
}

#[test]
fn only_powersave_is_a_warning() {
    assert_eq!(governor(None, None).state, State::Ok);
    assert_eq!(governor(Some("schedutil"), None), Check::ok("governor", "schedutil"));
    let check = governor(Some("powersave"), Some("intel_pstate"));
    assert_eq!(check.state, State::Warning);
    assert!(check.found.starts_with("powersave (intel_pstate)"));
    assert_eq!(check.advice.contains("scaling_governor"), cfg!(target_os = "linux"));
}

#[test]
fn usb_without_a_falcon_is_well() {
    for found in [Usb::Absent, Usb::Readable { devices: 3, falcon: None }] {
        let check = usb(&found);
        assert_eq!(check.state, State::Ok);
        assert!(check.advice.contains("the simulated hand feels"));
    }
    assert_eq!(usb(&Usb::Unreadable("denied".into())).state, State::Warning);
}

#[test]
fn a_falcon_that_may_not_be_written_comes_with_the_rule() {
    let found = |refused: Option<&str>| {
        let falcon = Falcon { node: "/dev/bus/usb/001/004".into(), refused: refused.map(Into::into) };
        usb(&Usb::Readable { devices: 3, falcon: Some(falcon) })
    };
    let writable = found(None);
    assert_eq!(writable.state, State::Ok);
    assert!(writable.found.contains("/dev/bus/usb/001/004"));
    let refused = found(Some("denied"));
    assert_eq!(refused.state, State::Warning);
    assert_eq!(refused.advice.contains(UDEV_RULE), cfg!(target_os = "linux"));
    let ids = [FALCON.0, FALCON.1].map(|id| format!("==\"{id:04x}\""));
    assert!(ids.iter().all(|id| UDEV_RULE.contains(id)));
}

#[test]
fn a_gpu_is_never_a_warning() {
    assert_eq!(gpu(&[]).state, State::Ok);
    let check = gpu(&[("renderD128".into(), Some("i915".into())), ("renderD129".into(), None)]);
    assert_eq!((check.state, check.found.as_str()), (State::Ok, "renderD128 (i915), renderD129"));
    assert!(check.advice.contains("computes on the CPU"));
}

#[test]
fn without_a_folder_hapflow_does_not_run() {
    assert_eq!(output(Path::new("out"), None), Check::ok("output", "out can be written"));
    let check = output(Path::new("out"), Some("denied"));
    assert_eq!((check.state, check.found.as_str()), (State::Missing, "out cannot be written: denied"));
    assert!(check.advice.contains("--out DIR"));
}
