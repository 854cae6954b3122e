//! Steadiness: random scenes that are shaken by all means, and what must hold whatever is asked.
//!
//! A trial draws a scene (`scenery.rs`) with settings from the whole of their ranges, moves its bodies as no hand would
//! (`motion.rs`), changes whatever may be changed while it runs, and asks for frames from 0.1 to 100 ms. After each frame
//! the `judge.rs` looks: all finite, nobody outside the container, density, speed, energy and force within bounds that follow
//! from what was put in (`ledger.rs`). Settings outside their ranges must be refused.

mod crowd;
mod dice;
mod draw;
mod felt;
mod judge;
mod ledger;
mod map;
mod motion;
mod scenery;
mod trial;

pub use map::{Place, map};
use serde_json::json;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc;

/// What is tried.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Subject {
    /// The fluid.
    #[default]
    Fluid,
    /// What a hand feels.
    Felt,
}

impl Subject {
    fn run(self, seed: u64) -> Result<(), String> {
        match self {
            Self::Fluid => trial::run(seed),
            Self::Felt => felt::run(seed),
        }
    }

    /// Words of the command that tries it.
    const fn command(self) -> &'static str {
        match self {
            Self::Fluid => "hapflow stress",
            Self::Felt => "hapflow stress felt",
        }
    }

    /// Seeds of its trials that failed once, and must not again.
    pub fn failed_once(self) -> Vec<u64> {
        let text = match self {
            Self::Fluid => include_str!("../../stress-seeds.txt"),
            Self::Felt => include_str!("../../stress-felt-seeds.txt"),
        };
        let lines = text.lines().map(|l| l.split('#').next().unwrap_or_default().trim());
        lines.filter_map(|l| l.parse().ok()).collect()
    }
}

/// What came of a trial.
#[derive(Clone, Debug, PartialEq)]
pub struct Verdict {
    /// What was tried.
    pub subject: Subject,
    /// Its number in this run, from 0.
    pub trial: u64,
    /// Its seed, which alone makes it what it is.
    pub seed: u64,
    /// Why it failed; none if it did not.
    pub reason: Option<String>,
}

impl Verdict {
    /// Whether all held.
    pub fn pass(&self) -> bool {
        self.reason.is_none()
    }

    /// The command that repeats the trial.
    pub fn repeat(&self) -> String {
        format!("{} --trials 1 --seed {}", self.subject.command(), self.seed)
    }

    /// One line of JSON.
    pub fn json(&self) -> serde_json::Value {
        json!({
            "trial": self.trial,
            "seed": self.seed,
            "pass": self.pass(),
            "reason": self.reason,
            "repeat": self.repeat(),
        })
    }
}

/// Runs the trial of `subject` with `seed`, as number `trial`.
pub fn attempt(subject: Subject, trial: u64, seed: u64) -> Verdict {
    let outcome = catch_unwind(AssertUnwindSafe(|| subject.run(seed)));
    let reason = outcome.unwrap_or_else(|_| Err("it panicked".into())).err();
    Verdict { subject, trial, seed, reason }
}

/// Runs the trials of `subject` with all `seeds` on so many `threads`; `tell` hears of each in order.
pub fn run(subject: Subject, seeds: &[u64], threads: usize, mut tell: impl FnMut(&Verdict)) {
    let (next, (to, from)) = (AtomicU64::new(0), mpsc::channel());
    std::thread::scope(|scope| {
        for _ in 0..threads.max(1) {
            let (next, to) = (&next, to.clone());
            scope.spawn(move || {
                while let k = next.fetch_add(1, Ordering::Relaxed)
                    && let Some(&seed) = seeds.get(k as usize)
                    && to.send(attempt(subject, k, seed)).is_ok()
                {}
            });
        }
        drop(to);
        let mut early = std::collections::BTreeMap::new();
        let mut due = 0;
        for verdict in from {
            early.insert(verdict.trial, verdict);
            while let Some(verdict) = early.remove(&due) {
                tell(&verdict);
                due += 1;
            }
        }
    });
}
