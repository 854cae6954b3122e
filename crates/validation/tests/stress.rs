//! Random scenes that are shaken by all means: see `hapflow_validation::stress`.
#![allow(clippy::unwrap_used, clippy::panic)]

use hapflow_validation::stress::{self, Subject, Verdict};

/// Every build tries these.
const TRIALS: u64 = 200;
const FELT_TRIALS: u64 = 300;

fn failures(subject: Subject, seeds: &[u64]) -> Vec<serde_json::Value> {
    let (mut failed, mut count) = (Vec::new(), 0);
    stress::run(subject, seeds, 2, |verdict| {
        assert_eq!(verdict.trial, count, "in order");
        count += 1;
        if !verdict.pass() {
            failed.push(verdict.json());
        }
    });
    assert_eq!(count, seeds.len() as u64);
    failed
}

#[test]
fn nothing_that_is_asked_for_breaks_the_fluid() {
    let failed = failures(Subject::Fluid, &(0..TRIALS).collect::<Vec<_>>());
    assert!(failed.is_empty(), "{failed:#?}");
}

#[test]
fn whatever_goes_wrong_the_hand_is_safe() {
    let failed = failures(Subject::Felt, &(0..FELT_TRIALS).collect::<Vec<_>>());
    assert!(failed.is_empty(), "{failed:#?}");
}

#[test]
fn what_failed_once_does_not_fail_again() {
    for subject in [Subject::Fluid, Subject::Felt] {
        let seeds = subject.failed_once();
        assert!(!seeds.is_empty());
        let failed = failures(subject, &seeds);
        assert!(failed.is_empty(), "{failed:#?}");
    }
}

#[test]
fn a_trial_is_repeated_by_its_command() {
    let verdict = Verdict { subject: Subject::Fluid, trial: 3, seed: 1234, reason: Some("it leaks".into()) };
    let line = verdict.json();
    assert_eq!(line["repeat"], "hapflow stress --trials 1 --seed 1234");
    assert_eq!(
        (&line["trial"], &line["pass"], &line["reason"]),
        (&3.into(), &false.into(), &"it leaks".into())
    );
    assert!(line["seed"] == 1234 && line.as_object().unwrap().len() == 5);
    let felt = Verdict { subject: Subject::Felt, ..verdict };
    assert_eq!(felt.repeat(), "hapflow stress felt --trials 1 --seed 1234");
    for subject in [Subject::Fluid, Subject::Felt] {
        assert!(stress::attempt(subject, 0, 5) == stress::attempt(subject, 0, 5));
    }
}
