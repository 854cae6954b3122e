//! `hapflow stress`: random scenes that are shaken by all means, and what came of each.

use crate::cli::{StressArgs, Stressed};
use crate::cores::cores;
use crate::draw::chart::{self, Chart, Series};
use crate::run::Failure;
use hapflow_fluid::Solver;
use hapflow_validation::stress::{self, Place, Subject, Verdict};
use std::io::Write;
use std::path::Path;

/// Trials between two words on how far it is.
const TOLD_EVERY: u64 = 100;

/// Width of the map, and height of a panel, pixels.
const WIDTH: u32 = 1400;
const PANEL: u32 = 420;

/// Runs the trials, or draws the map; true if all hold.
pub fn stress(args: &StressArgs) -> Result<bool, Failure> {
    match &args.map {
        Some(path) => map(path).map(|()| true),
        None => Ok(trials(args)),
    }
}

fn trials(args: &StressArgs) -> bool {
    let seeds: Vec<u64> = (0..args.trials).map(|k| args.seed.wrapping_add(k)).collect();
    let threads = cores();
    let mut failed = 0;
    let subject = match args.what {
        Stressed::Fluid => Subject::Fluid,
        Stressed::Felt => Subject::Felt,
    };
    stress::run(subject, &seeds, threads, |verdict| {
        failed += u64::from(!verdict.pass());
        tell(args, verdict);
        let done = verdict.trial + 1;
        if done.is_multiple_of(TOLD_EVERY) || done == args.trials {
            eprintln!("{done} of {} trials, {failed} failed", args.trials);
        }
    });
    failed == 0
}

/// One line a trial: of JSON, or for people those that failed.
fn tell(args: &StressArgs, verdict: &Verdict) {
    let line = match &verdict.reason {
        _ if args.json => verdict.json().to_string(),
        Some(reason) => format!("{reason}\n    again: {}", verdict.repeat()),
        None => return,
    };
    // A closed pipe is no reason to fail.
    let _ = writeln!(std::io::stdout(), "{line}");
}

/// Draws the stability map.
fn map(path: &Path) -> Result<(), Failure> {
    let places = stress::map(|place| {
        let calm = place.calm.map_or("none found".into(), |s| format!("{:.4} ms", 1e3 * s));
        let (stiffness, viscosity) = (&place.stiffness, place.viscosity);
        eprintln!(
            "{:?}, {stiffness}, {viscosity} Pa·s: {:.4} ms, calm to {calm}",
            place.solver,
            1e3 * place.taken
        );
    })?;
    let panel =
        |(solver, name)| panel(name, &places.iter().filter(|p| p.solver == solver).collect::<Vec<_>>());
    let charts = [(Solver::Wcsph, "wcsph"), (Solver::Dfsph, "dfsph"), (Solver::Muller, "muller")].map(panel);
    chart::save(&charts, path, WIDTH, PANEL * charts.len() as u32)?;
    Ok(())
}

/// One solver: the step that it takes, pale, and the longest calm one.
fn panel(name: &str, places: &[&Place]) -> Chart {
    let mut kinds: Vec<_> = places.iter().map(|p| &p.stiffness).collect();
    kinds.dedup();
    let mut series = Vec::new();
    for (kind, colour) in kinds.into_iter().zip([[0, 114, 178], [213, 94, 0], [0, 145, 105]]) {
        let of_kind = || places.iter().filter(|p| p.stiffness == *kind);
        let taken = of_kind().map(|p| [p.viscosity, 1e3 * p.taken]).collect();
        let calm = of_kind().map(|p| [p.viscosity, 1e3 * p.calm.unwrap_or(f64::NAN)]).collect();
        series.push(Series::new("", taken).coloured(colour).faint());
        series.push(Series::new(kind.as_str(), calm).coloured(colour));
    }
    Chart {
        title: format!("{name}: longest calm step, and pale the one taken"),
        x_label: "viscosity (Pa·s)".into(),
        y_label: "step (ms)".into(),
        series,
        log: true,
    }
}
