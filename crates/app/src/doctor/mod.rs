//! `hapflow doctor`: checks a machine and says what to do.
//!
//! [`probe`] asks the system, [`parse`] reads its files' texts, [`judge`] says what is good enough and what to do
//! otherwise, [`mod@format`] writes it down. A check is [missing](check::State::Missing) only if hapflow
//! does not run without; all else is a warning.

mod check;
mod format;
mod judge;
mod parse;
mod probe;
mod timer;

use crate::cli::DoctorArgs;
use check::{Check, State};
use hapflow_engine::SERVO_PRIORITY;
use std::io::Write;
use std::path::Path;

/// Ticks of the timer's loop: half a second.
const TICKS: u32 = 500;
/// Where runs write unless told otherwise.
const OUTPUT: &str = "out";

/// Checks the machine and prints what came of it; whether nothing is missing that hapflow needs. A closed pipe is no
/// reason to fail.
pub fn doctor(args: &DoctorArgs) -> bool {
    let checks = examine();
    let mut out = std::io::stdout();
    let _ = match args.json {
        true => writeln!(out, "{:#}", format::json(&checks)),
        false => write!(out, "{}", format::table(&checks)),
    };
    complete(&checks)
}

/// Whether nothing is missing.
fn complete(checks: &[Check]) -> bool {
    checks.iter().all(|c| c.state != State::Missing)
}

/// All checks, in the order in which they are shown. Takes half a second.
fn examine() -> Vec<Check> {
    let system = probe::system();
    let program = std::env::current_exe().ok();
    let (memory, limit) = probe::memory();
    // The timer's thread asks for the priority, as the servo's does, and runs on without it.
    let servo = probe::servo(SERVO_PRIORITY, TICKS);
    let priority = servo.as_ref().map(|(grant, _)| grant.clone()).unwrap_or_default();
    let timed = servo.map(|(grant, late)| (late, grant.is_granted()));
    let (governor, driver) = probe::governor();
    let output = probe::output(Path::new(OUTPUT)).err().map(|e| e.to_string());
    vec![
        judge::versions(&system),
        judge::cores(probe::cores()),
        judge::simd(&probe::simd()),
        judge::priority(SERVO_PRIORITY, &priority, system.container, program.as_deref()),
        judge::memory(&memory, limit.as_deref(), system.container),
        judge::timer(&timed),
        judge::governor(governor.as_deref(), driver.as_deref()),
        judge::usb(&probe::usb(Path::new("/sys/bus/usb/devices"), Path::new("/dev/bus/usb"))),
        judge::gpu(&probe::gpu(Path::new("/dev/dri"), Path::new("/sys/class/drm"))),
        judge::output(Path::new(OUTPUT), output.as_deref()),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Holds on any machine, whatever it grants.
    #[test]
    fn every_check_is_there_once_and_no_trouble_is_without_advice() {
        let checks = examine();
        let names: Vec<_> = checks.iter().map(|c| c.name).collect();
        let all = "versions cores simd priority memory timer governor usb gpu output";
        assert_eq!(names.join(" "), all);
        for check in &checks {
            assert!(!check.found.is_empty(), "{check:?}");
            assert!(check.state == State::Ok || !check.advice.is_empty(), "{check:?}");
            assert!(!check.found.contains('\n') && !check.advice.contains('\n'), "{check:?}");
        }
    }

    #[test]
    fn warnings_are_no_failure() {
        let warning = Check::warning("cores", "1", "more");
        assert!(complete(&[Check::ok("simd", "NEON"), warning.clone()]));
        assert!(!complete(&[warning, Check::missing("output", "none", "make one")]));
    }
}
