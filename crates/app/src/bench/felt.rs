//! `hapflow bench felt`: every coupling with every filter at every fluid rate.

use crate::cli::FeltArgs;
use crate::cores::cores;
use crate::draw::chart::{self, Chart, Series};
use crate::run::Failure;
use crate::validate::{plot::make_folder, table};
use hapflow_validation::bench::{self, CostPoint, Crossing, Found, Spectrum};
use std::path::Path;

/// Width of a picture, and height of a panel, pixels.
const WIDTH: u32 = 1200;
const PANEL: u32 = 300;
/// What the picture of the crossing shows.
const SHOWN: [&str; 3] = ["local", "momentum bartlett-hann:11@servo", "momentum bartlett-hann:11@fluid"];
/// Colours of what was sent and of the truth.
const SENT: [u8; 3] = [213, 94, 0];
const TRUTH: [u8; 3] = [34, 46, 58];

/// Measures, tells and draws.
pub fn felt(args: &FeltArgs) -> Result<(), Failure> {
    eprintln!("couplings, filters and fluid rates side by side; up to an hour, with --quick minutes");
    make_folder(args.plot.as_deref())?;
    let threads = cores();
    if !args.json {
        super::say(&table::head());
    }
    let mut all = Vec::new();
    bench::felt(
        args.quick,
        threads,
        |what| eprintln!("{what} ..."),
        |found| {
            tell(&found, args.json);
            all.push(found);
        },
    )?;
    args.plot.as_ref().map_or(Ok(()), |folder| draw(&all, folder))
}

/// One line for each figure; spectra and crossings are for the eye and for machines.
fn tell(found: &Found, json: bool) {
    match found {
        Found::Rows(rows) if json => rows.iter().for_each(|row| super::say(&row.json().to_string())),
        Found::Rows(rows) => rows.iter().for_each(|row| super::say(&table::line(row, false))),
        Found::Spectrum(spectrum) if json => super::say(&spectrum.json().to_string()),
        Found::Point(point) if json => super::say(&point.json().to_string()),
        Found::Point(p) => super::say(&format!(
            "dx {:.2} mm, {} Hz: error {:.2} %, {:.3} CPU-s a simulated second",
            1e3 * p.dx,
            p.fluid_hz,
            100.0 * p.error,
            p.cost
        )),
        Found::Spectrum(_) | Found::Crossing(_) => {}
    }
}

fn draw(all: &[Found], folder: &Path) -> Result<(), Failure> {
    let crossings: Vec<_> =
        all.iter().filter_map(|f| if let Found::Crossing(c) = f { Some(c) } else { None }).collect();
    let spectra: Vec<_> =
        all.iter().filter_map(|f| if let Found::Spectrum(s) = f { Some(s) } else { None }).collect();
    let points: Vec<_> =
        all.iter().filter_map(|f| if let Found::Point(p) = f { Some(p) } else { None }).collect();
    let shown = SHOWN.iter().filter_map(|name| crossings.iter().find(|c| c.way == *name));
    save(&shown.map(|c| crossing(c)).collect::<Vec<_>>(), &folder.join("felt-crossing.png"))?;
    save(&spectrum_panels(&spectra), &folder.join("felt-spectra.png"))?;
    if !points.is_empty() {
        chart::save(&[cost(&points)], &folder.join("felt-cost.png"), WIDTH, 2 * PANEL)?;
    }
    Ok(())
}

fn save(charts: &[Chart], path: &Path) -> Result<(), Failure> {
    chart::save(charts, path, WIDTH, PANEL * charts.len().max(1) as u32)?;
    Ok(())
}

/// Side force and axial force over time, over the truth.
fn crossing(c: &Crossing) -> Chart {
    let line = |force: &[glam::DVec3], axis: usize| {
        force.iter().enumerate().map(|(n, f)| [1e-3 * n as f64, f[axis]]).collect::<Vec<_>>()
    };
    let truth =
        |axis| Series::new(if axis == 0 { "truth" } else { "" }, line(&c.truth, axis)).coloured(TRUTH);
    let sent = |axis| Series::new(if axis == 0 { "sent" } else { "" }, line(&c.sent, axis)).coloured(SENT);
    Chart {
        title: format!("{}: across and along the jet, fluid at {} Hz", c.way, c.fluid_hz),
        x_label: "time (s)".into(),
        y_label: "force (N)".into(),
        series: vec![truth(1), truth(0), sent(1), sent(0)],
        log: false,
    }
}

/// A panel for each kind of spectrum and fluid rate.
fn spectrum_panels(spectra: &[&Spectrum]) -> Vec<Chart> {
    let mut kinds: Vec<_> = spectra.iter().map(|s| (s.of, s.fluid_hz)).collect();
    kinds.sort_by(|a, b| a.0.cmp(b.0).then(a.1.total_cmp(&b.1)));
    kinds.dedup();
    let panel = |&(of, hz): &(&'static str, f64)| {
        let here = spectra.iter().filter(|s| s.of == of && s.fluid_hz == hz && is_named(&s.way));
        let what = if of == "sent" { "steady jet" } else { "crossing, less the truth" };
        Chart {
            title: format!("{what}, fluid at {hz} Hz"),
            x_label: "frequency (Hz)".into(),
            y_label: "force in a third of an octave (N)".into(),
            series: here.map(|s| Series::new(s.way.as_str(), s.bands.clone())).collect(),
            log: true,
        }
    };
    kinds.iter().map(panel).collect()
}

/// Couplings as they are meant: all filters would hide each other.
fn is_named(way: &str) -> bool {
    SHOWN.contains(&way) || way == "direct"
}

/// Error against cost, a line for each spacing, its points the fluid's rates.
fn cost(points: &[&CostPoint]) -> Chart {
    let mut spacings: Vec<_> = points.iter().map(|p| p.dx).collect();
    spacings.dedup();
    let line = |dx: &f64| {
        let mut line: Vec<_> =
            points.iter().filter(|p| p.dx == *dx).map(|p| [p.cost, 100.0 * p.error]).collect();
        line.sort_by(|a, b| a[0].total_cmp(&b[0]));
        Series::new(format!("dx {:.2} mm", 1e3 * dx), line)
    };
    Chart {
        title: "local, crossing: error against cost, fluid at 30, 60, 125, 250 Hz".into(),
        x_label: "CPU time for a simulated second (s)".into(),
        y_label: "error (%)".into(),
        series: spacings.iter().map(line).collect(),
        log: true,
    }
}
