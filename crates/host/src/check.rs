//! What a library of the C interface must do whoever wrote it.

use crate::Plugin;
use crate::generated::*;
use std::fs;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::Instant;

/// One thing that was looked at.
pub struct Finding {
    /// What.
    pub name: &'static str,
    /// What was wrong; or, where it holds, what was measured.
    pub verdict: Result<String, String>,
}

/// A jet in closed form on a ball at rest, of which a force comes at no cost.
const JET: &str = "[run]\nduration = 1\nfluid_hz = 100\nbackend = \"analytic-jet\"\ndevice = \"null\"\n\
    [bounds]\nmin = [-0.1, -0.12, -0.1]\nmax = [0.1, 0.12, 0.1]\n\
    [[source]]\nname = \"tap\"\nposition = [0.0, 0.05, 0.0]\ndiameter = 0.02\nspeed = 1.5\n\
    [gate]\nramp_in = 0.02\nmax_force = 4\n";

/// Largest force that the scene's gate lets out, N.
const MAX_FORCE: f64 = 4.0;

type Verdict = Result<String, String>;
type Look = fn(Plugin) -> Verdict;

/// The order matters: before it has negotiated a library must refuse.
const LOOKS: [(&str, Look); 6] = [
    ("versions", versions),
    ("misuse", misuse),
    ("nan", nan),
    ("threads", threads),
    ("timing", timing),
    ("memory", memory),
];

/// Puts a library that was not used before in this process through its paces, and tells each finding as it comes: one that
/// crashes ends the process behind the last. Takes some seconds.
pub fn check(plugin: Plugin, mut tell: impl FnMut(&Finding)) -> bool {
    let mut holds = true;
    for (name, look) in LOOKS {
        let finding = Finding { name, verdict: look(plugin) };
        holds &= finding.verdict.is_ok();
        tell(&finding);
    }
    holds
}

/// The verdict of a result that is not the wanted one.
fn wants(what: &str, result: i32, wanted: i32) -> Result<(), String> {
    if result == wanted { Ok(()) } else { Err(format!("{what}: result {result}, must be {wanted}")) }
}

/// The verdict of something that does not hold.
fn must(holds: bool, what: impl FnOnce() -> String) -> Result<(), String> {
    if holds { Ok(()) } else { Err(what()) }
}

fn versions(plugin: Plugin) -> Verdict {
    wants("a session before a version was agreed on", plugin.create(JET).0, HAPFLOW_ERROR_NOT_NEGOTIATED)?;
    wants("versions of the far future", plugin.negotiate(u32::MAX, u32::MAX).0, HAPFLOW_ERROR_VERSION)?;
    wants("versions the wrong way round", plugin.negotiate(2, 1).0, HAPFLOW_ERROR_VERSION)?;
    let (result, chosen) = plugin.negotiate(HAPFLOW_ABI_VERSION, HAPFLOW_ABI_VERSION);
    wants("this interface's version", result, HAPFLOW_OK)?;
    wants("the version that was chosen", chosen as i32, HAPFLOW_ABI_VERSION as i32)?;
    // SAFETY: takes nothing.
    let release = unsafe { plugin.functions.hapflow_version() };
    Ok(format!(
        "interface {chosen}, release {}.{}.{}",
        release / 1_000_000,
        release / 1000 % 1000,
        release % 1000
    ))
}

fn misuse(plugin: Plugin) -> Verdict {
    wants("a scene that is none", plugin.create("no scene").0, HAPFLOW_ERROR_SCENE)?;
    let session = session(plugin)?;
    refused(plugin, "a tick without a state", session, None, HAPFLOW_ERROR_NULL)?;
    let mut state = plugin.state(0.0);
    state.size = 3;
    refused(plugin, "a state of 3 bytes", session, Some(&state), HAPFLOW_ERROR_STRUCT)?;
    wants("the end of a session", plugin.destroy(session), HAPFLOW_OK)?;
    wants("a second end", plugin.destroy(session), HAPFLOW_ERROR_HANDLE)?;
    let state = plugin.state(0.0);
    for (what, id) in [("a null session", 0), ("a session that ended", session.id), ("no session", u64::MAX)]
    {
        refused(plugin, what, hapflow_session { id }, Some(&state), HAPFLOW_ERROR_HANDLE)?;
    }
    Ok("every mistake is refused, with zero force".into())
}

fn nan(plugin: Plugin) -> Verdict {
    let session = session(plugin)?;
    felt(plugin, session, 0, 200)?;
    for (n, field) in (0..3).zip(["position", "velocity", "orientation"]) {
        let mut state = plugin.state(0.3 * f64::from(n + 1));
        match n {
            0 => state.position[1] = f64::NAN,
            1 => state.velocity[1] = f64::INFINITY,
            _ => state.orientation[1] = f64::NAN,
        }
        refused(plugin, field, session, Some(&state), HAPFLOW_ERROR_NOT_FINITE)?;
        let state = plugin.state(0.3 * f64::from(n + 1));
        refused(plugin, "the tick after it", session, Some(&state), HAPFLOW_REMARK_FORCE_HELD)?;
        wants("faults are cleared", plugin.clear_faults(session), HAPFLOW_OK)?;
        felt(plugin, session, 300 * (n + 1), 200)?;
    }
    wants("the end of a session", plugin.destroy(session), HAPFLOW_OK)?;
    Ok("latches zero force until it is cleared".into())
}

fn threads(plugin: Plugin) -> Verdict {
    let session = session(plugin)?;
    let ended = AtomicBool::new(false);
    let wrong = thread::scope(|scope| {
        let tick = || loop {
            let last = ended.load(Ordering::Acquire);
            let (result, wrench) = plugin.tick(session, Some(&plugin.state(0.0)));
            if let Err(wrong) = must(within(&wrench), || format!("result {result}, wrench {wrench:?}")) {
                return Some(wrong);
            }
            if last {
                return wants("a tick after the end", result, HAPFLOW_ERROR_HANDLE).err();
            }
        };
        let both = [scope.spawn(tick), scope.spawn(tick)];
        let destroyed = wants("the end while two threads tick", plugin.destroy(session), HAPFLOW_OK);
        ended.store(true, Ordering::Release);
        let mut wrong = destroyed.err();
        for thread in both {
            wrong = wrong.or(thread.join().unwrap_or_else(|_| Some("a thread panicked".into())));
        }
        wrong
    });
    wrong.map_or(Ok("a session ends while two threads tick it".into()), Err)
}

fn timing(plugin: Plugin) -> Verdict {
    let session = session(plugin)?;
    felt(plugin, session, 0, 200)?;
    let mut took: Vec<f64> = (200..2200)
        .map(|n| {
            let state = plugin.state(f64::from(n) * 1e-3);
            let begin = Instant::now();
            plugin.tick(session, Some(&state));
            begin.elapsed().as_secs_f64() * 1e6
        })
        .collect();
    took.sort_by(f64::total_cmp);
    wants("the end of a session", plugin.destroy(session), HAPFLOW_OK)?;
    let median = took[took.len() / 2];
    must(median < 1000.0, || format!("half of all ticks took more than {median:.1} us: a servo has 1000"))?;
    Ok(format!("tick p50 {median:.2} us, p99 {:.2} us", took[took.len() * 99 / 100]))
}

/// Most that may be left of a hundred sessions, bytes.
const MOST_LEFT: u64 = 1 << 20;

fn memory(plugin: Plugin) -> Verdict {
    hundred_sessions(plugin)?;
    let before = resident();
    hundred_sessions(plugin)?;
    let (Some(before), Some(after)) = (before, resident()) else {
        return Ok("not measured: this system does not tell".into());
    };
    let left = after.saturating_sub(before);
    must(left < MOST_LEFT, || format!("a hundred sessions left {} KiB behind", left / 1024))?;
    Ok(format!("a hundred sessions left {} KiB behind", left / 1024))
}

fn hundred_sessions(plugin: Plugin) -> Result<(), String> {
    for _ in 0..100 {
        let session = session(plugin)?;
        plugin.tick(session, Some(&plugin.state(0.0)));
        wants("the end of a session", plugin.destroy(session), HAPFLOW_OK)?;
    }
    Ok(())
}

/// Memory of this process that is in use, bytes.
fn resident() -> Option<u64> {
    let pages: u64 = fs::read_to_string("/proc/self/statm").ok()?.split(' ').nth(1)?.parse().ok()?;
    Some(pages * 4096)
}

fn session(plugin: Plugin) -> Result<hapflow_session, String> {
    let (result, session) = plugin.create(JET);
    wants("a session of a good scene", result, HAPFLOW_OK)?;
    Ok(session)
}

/// The result is the wanted one, and the force zero.
fn refused(
    plugin: Plugin,
    what: &str,
    session: hapflow_session,
    state: Option<&hapflow_tool_state>,
    wanted: i32,
) -> Result<(), String> {
    let (result, wrench) = plugin.tick(session, state);
    wants(what, result, wanted)?;
    must(wrench == [0.0; 6], || format!("{what}: the wrench is {wrench:?}, must be zero"))
}

/// Ticks of a tool at rest in the jet: finite and within the gate, and felt in the end.
fn felt(plugin: Plugin, session: hapflow_session, first: i32, ticks: i32) -> Result<(), String> {
    let mut force = 0.0;
    for n in first + 1..=first + ticks {
        let time = f64::from(n) * 1e-3;
        wants("the fluid", plugin.advance(session, time), HAPFLOW_OK)?;
        let (result, wrench) = plugin.tick(session, Some(&plugin.state(time)));
        must(result >= 0 && within(&wrench), || format!("result {result}, wrench {wrench:?}"))?;
        force = wrench[1].abs();
    }
    must(force > 0.05, || format!("the jet is not felt: {force} N"))
}

/// Finite, and no force beyond the gate.
fn within(wrench: &[f64; 6]) -> bool {
    let force = wrench[0].hypot(wrench[1]).hypot(wrench[2]);
    wrench.iter().all(|v| v.is_finite()) && force <= MAX_FORCE * (1.0 + 1e-9)
}
