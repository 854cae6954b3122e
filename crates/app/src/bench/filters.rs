//! `hapflow bench filters`: the filter study.

use super::{crosses, say};
use crate::cli::FiltersArgs;
use crate::cores::cores;
use crate::draw::chart::{self, Chart, Series};
use crate::run::Failure;
use crate::validate::plot::make_folder;
use hapflow_validation::bench::{self, Filtered};

/// Width of the picture, and height of a panel, pixels.
const WIDTH: u32 = 1400;
const PANEL: u32 = 460;
/// Smallest lag and ripple that a logarithmic scale shows, ms and mN.
const LEAST: [f64; 2] = [0.1, 0.01];

/// Runs the study.
pub fn filters(args: &FiltersArgs) -> Result<(), Failure> {
    eprintln!(
        "a jet, a crossing and a stirring, each felt by two couplings, through every filter; about two minutes"
    );
    make_folder(args.plot.as_deref())?;
    if !args.json {
        say(&format!(
            "{:<9} {:<9} {:<24} {:>12} {:>9} {:>11} {:>8}",
            "use", "coupling", "filter", "ripple (mN)", "lag (ms)", "overshoot", "error"
        ));
    }
    let threads = cores();
    let mut all = Vec::new();
    bench::filters(threads, |found| {
        say(&if args.json { found.json().to_string() } else { line(found) });
        all.push(found.clone());
    })?;
    if let Some(folder) = &args.plot {
        let charts = panels(&all);
        chart::save(&charts, &folder.join("filters.png"), WIDTH, PANEL * charts.len() as u32)?;
    }
    Ok(())
}

/// A line of the table.
fn line(f: &Filtered) -> String {
    format!(
        "{:<9} {:<9} {:<24} {:>12.2} {:>9.1} {:>9.1} % {:>6.1} %",
        f.usage,
        f.coupling,
        f.filter,
        1e3 * f.ripple_n,
        1e3 * f.lag_s,
        100.0 * f.overshoot,
        100.0 * f.error
    )
}

/// One panel a use, one colour a coupling, one cross a filter.
fn panels(all: &[Filtered]) -> Vec<Chart> {
    let mut uses: Vec<_> = all.iter().map(|f| f.usage).collect();
    uses.dedup();
    let mut couplings: Vec<_> = all.iter().map(|f| f.coupling).collect();
    couplings.sort_unstable();
    couplings.dedup();
    let place = |f: &Filtered| [1e3 * f.lag_s.abs(), 1e3 * f.ripple_n];
    let shown = |[lag, ripple]: [f64; 2]| [lag.max(LEAST[0]), ripple.max(LEAST[1])];
    let panel = |usage: &str| {
        // A gap after each cross: crosses are not joined.
        let points = |coupling: &str| -> Vec<[f64; 2]> {
            let of = all.iter().filter(|f| f.usage == usage && f.coupling == coupling);
            of.flat_map(|f| [crosses(&[shown(place(f))]), vec![[f64::NAN; 2]]].concat()).collect()
        };
        Chart {
            title: format!("{usage}: every filter"),
            x_label: "lag or lead behind the truth (ms)".into(),
            y_label: "ripple above 20 Hz (mN)".into(),
            series: couplings.iter().map(|c| Series::new(*c, points(c))).collect(),
            log: true,
        }
    };
    uses.into_iter().map(panel).collect()
}
