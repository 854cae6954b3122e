//! `hapflow_servo_pace`: how an owned servo keeps time.

use crate::caller::{Out, Record, Shown, Text};
use crate::code::Code;
use crate::contract::as_in_header;
use crate::fence::fence;
use crate::generated as c;
use hapflow_engine::{ServoPace, Session};
use hapflow_realtime::Grant;

/// `hapflow_servo_pace`.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct ServoPaceRecord {
    size: u32,
    owned: u32,
    running: u32,
    priority: u32,
    ticks: u64,
    late: u64,
    median_s: f64,
    p99_s: f64,
    longest_s: f64,
    priority_text: Text,
    device: Text,
}

as_in_header!(
    ServoPaceRecord = hapflow_servo_pace {
        size,
        owned,
        running,
        priority,
        ticks,
        late,
        median_s,
        p99_s,
        longest_s,
        priority_text,
        device,
    }
);

// SAFETY: repr(C), 16 bytes, five 8-byte fields and two pointers of 4 or 8 bytes: no padding; every field takes any
// bits.
unsafe impl Record for ServoPaceRecord {
    const SIZE_AT: usize = 0;
    const FIRST_SIZE: usize = 56 + 2 * size_of::<usize>();
}

impl ServoPaceRecord {
    /// Of a tool that the session does not tick.
    const EMPTY: Self = Self {
        size: size_of::<Self>() as u32,
        owned: 0,
        running: 0,
        priority: c::HAPFLOW_PRIORITY_NOT_ASKED,
        ticks: 0,
        late: 0,
        median_s: 0.0,
        p99_s: 0.0,
        longest_s: 0.0,
        priority_text: Text::EMPTY,
        device: Text::EMPTY,
    };

    /// Of one that it ticks.
    fn of(pace: &ServoPace, texts: &PaceTexts) -> Self {
        Self {
            owned: 1,
            running: pace.runs.into(),
            priority: priority(&pace.priority),
            ticks: pace.ticks.count(),
            late: pace.ticks.late,
            median_s: pace.ticks.quantile_s(0.5),
            p99_s: pace.ticks.quantile_s(0.99),
            longest_s: pace.ticks.longest_ns as f64 * 1e-9,
            priority_text: texts.priority.text(),
            device: texts.device.text(),
            ..Self::EMPTY
        }
    }
}

/// One owned servo in words.
struct PaceTexts {
    priority: Shown,
    device: Shown,
}

/// The owned servos of a session in words, which last as long as it.
pub struct Paces(Vec<PaceTexts>);

impl Paces {
    /// Those of a session that has just begun, with these devices.
    pub fn new(session: &mut Session, devices: Vec<Shown>) -> Self {
        let texts = |(tool, device)| {
            let priority = session.servo_pace(tool).map(|p| p.priority.to_string());
            PaceTexts { priority: Shown::new(&priority.unwrap_or_default()), device }
        };
        Self(devices.into_iter().enumerate().map(texts).collect())
    }

    /// How the servo of `tool` keeps time.
    pub fn of(&self, session: &mut Session, tool: usize) -> ServoPaceRecord {
        let owned = session.servo_pace(tool).zip(self.0.get(tool));
        owned.map_or(ServoPaceRecord::EMPTY, |(pace, texts)| ServoPaceRecord::of(&pace, texts))
    }
}

fn priority(grant: &Grant) -> u32 {
    match grant {
        Grant::NotAsked => c::HAPFLOW_PRIORITY_NOT_ASKED,
        Grant::Granted => c::HAPFLOW_PRIORITY_GRANTED,
        Grant::Refused(_) => c::HAPFLOW_PRIORITY_REFUSED,
    }
}

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn hapflow_servo_pace_init(pace: Out<ServoPaceRecord>, size: u32) -> Code {
    fence(|| pace.init(&ServoPaceRecord::EMPTY, size).map(|()| Code::OK))
}
