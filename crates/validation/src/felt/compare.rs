//! Every coupling with every filter at every fluid rate, side by side: figures, spectra, what an error costs, and what a tick does.

use super::bench::{Bench, steady};
use super::crossing::Crossed;
use super::spectrum::{self, Spectrum};
use super::ticks;
use super::ways::Way;
use super::{closed_loop, crossing, figures, jet, lag, still};
use crate::run::Report;
use crate::{Case, Row, Setup, ValidationError};
use glam::DVec3;
use hapflow_engine::Value;
use hapflow_haptics::CouplingKind;
use hapflow_realtime::process_cpu_s;
use serde_json::json;
use std::time::Instant;

/// Fluid rates, Hz.
const RATES: [f64; 4] = [30.0, 60.0, 125.0, 250.0];
/// The rate of the picture and of a quick look, Hz.
const SHOWN: f64 = 60.0;
/// Spacings of the plot of error against cost, in the jet's diameter; the last is the truth's.
const CELLS: [f64; 3] = [4.0, 5.0, 7.0];
/// Seeds of a quick look, and of the long swings: their lag and size are sums over half a second and more.
const FEW: f64 = 2.0;
const SWUNG: f64 = 4.0;

/// What was found.
#[derive(Clone, Debug)]
pub enum Found {
    /// Figures, as `validate` tells them.
    Rows(Vec<Row>),
    /// How a force is spread over frequencies.
    Spectrum(Spectrum),
    /// What an error costs.
    Point(Point),
    /// A crossing of the jet, tick by tick.
    Crossing(Crossing),
}

/// Error of a crossing with coupling `local`, against what the fluid costs.
#[derive(Clone, Debug)]
pub struct Point {
    /// Spacing, m.
    pub dx: f64,
    /// Fluid frames a second, Hz.
    pub fluid_hz: f64,
    /// Difference from the truth at the finest spacing, below 20 Hz, over the truth's size.
    pub error: f64,
    /// CPU time of all threads for a simulated second, hand and servo included, s.
    pub cost: f64,
}

impl Point {
    /// One line of JSON.
    pub fn json(&self) -> serde_json::Value {
        json!({
            "case": crossing::CASE.name,
            "quantity": "error_against_cost",
            "coupling": "local",
            "dx": self.dx,
            "fluid_hz": self.fluid_hz,
            "error": self.error,
            "cpu_s_per_sim_s": self.cost,
        })
    }
}

/// A crossing.
#[derive(Clone, Debug)]
pub struct Crossing {
    /// Coupling and filter.
    pub way: String,
    /// Fluid frames a second, Hz.
    pub fluid_hz: f64,
    /// What was sent, a force a millisecond, N.
    pub sent: Vec<DVec3>,
    /// What should have been, N.
    pub truth: Vec<DVec3>,
}

/// Compares all, or with `quick` the couplings with their own filters at 60 Hz; `begin` hears of each run, `tell` of what came.
///
/// # Errors
/// What a case refuses.
pub fn felt(
    quick: bool,
    threads: usize,
    mut begin: impl FnMut(&str),
    mut tell: impl FnMut(Found),
) -> Result<(), ValidationError> {
    for hz in RATES.into_iter().filter(|hz| !quick || *hz == SHOWN) {
        begin(&format!("couplings at {hz} Hz"));
        let rate = Rate { quick, hz, threads };
        rate.still(&mut tell)?;
        rate.crossing(&mut tell)?;
        rate.swinging(&mut tell)?;
        rate.ticks(&mut tell)?;
    }
    for point in CELLS.into_iter().flat_map(|cells| RATES.map(|hz| (cells, hz))) {
        if !quick {
            begin(&format!("error against cost, {} spacings, {} Hz", point.0, point.1));
            tell(Found::Point(cost(point, threads)?));
        }
    }
    Ok(())
}

/// All ways at one fluid rate.
struct Rate {
    quick: bool,
    hz: f64,
    threads: usize,
}

impl Rate {
    fn setup(&self, case: &'static Case) -> Result<Setup<'static>, ValidationError> {
        setup(case, self.hz, self.threads, self.quick)
    }

    /// The force of the steady jet, and its spectrum.
    fn still(&self, tell: &mut impl FnMut(Found)) -> Result<(), ValidationError> {
        let setup = self.setup(&still::CASE)?;
        let timed = Timed::begin();
        let mut bench = Bench::new(&setup, jet::scene(&setup))?;
        let mut measures = still::source(&mut bench)?;
        for way in Way::all(self.quick)? {
            let held = still::Held::by(&mut bench, &way)?;
            measures.extend(held.measures(&bench));
            tell(Found::Spectrum(self.spectrum("sent", &way, held.steady())));
        }
        tell(Found::Rows(timed.rows(&setup, bench.report(measures))));
        Ok(())
    }

    /// The crossing, the spectrum of its error, and its picture.
    fn crossing(&self, tell: &mut impl FnMut(Found)) -> Result<(), ValidationError> {
        let setup = self.setup(&crossing::CASE)?;
        let timed = Timed::begin();
        let mut bench = Bench::new(&setup, jet::scene(&setup))?;
        let baseline = Crossed::by(&mut bench, &Way::baseline()?)?.added_ripple();
        let mut measures = Vec::new();
        for way in Way::all(self.quick)? {
            let crossed = Crossed::by(&mut bench, &way)?;
            measures.extend(crossed.measures(&bench, baseline));
            let [sent, truth] = crossed.forces();
            let error = figures::difference(sent, truth);
            tell(Found::Spectrum(self.spectrum("error", &way, &error)));
            if self.hz == SHOWN {
                let (sent, truth) = (sent.to_vec(), truth.to_vec());
                tell(Found::Crossing(Crossing { way: way.name(), fluid_hz: self.hz, sent, truth }));
            }
        }
        tell(Found::Rows(timed.rows(&setup, bench.report(measures))));
        Ok(())
    }

    /// Lag and size of the force on a hand that swings.
    fn swinging(&self, tell: &mut impl FnMut(Found)) -> Result<(), ValidationError> {
        let mut setup = self.setup(&lag::CASE)?;
        if !self.quick {
            setup.set("seeds", &Value::Number(SWUNG))?;
        }
        let timed = Timed::begin();
        let mut bench = Bench::new(&setup, jet::scene(&setup))?;
        let mut measures = Vec::new();
        for way in Way::all(self.quick)? {
            measures.extend(lag::swung(&mut bench, &way)?);
        }
        tell(Found::Rows(timed.rows(&setup, bench.report(measures))));
        Ok(())
    }

    /// What a tick costs.
    fn ticks(&self, tell: &mut impl FnMut(Found)) -> Result<(), ValidationError> {
        let setup = self.setup(&ticks::CASE)?;
        let timed = Timed::begin();
        tell(Found::Rows(timed.rows(&setup, ticks::run(&setup, &Way::all(self.quick)?)?)));
        Ok(())
    }

    fn spectrum(&self, of: &'static str, way: &Way, force: &[DVec3]) -> Spectrum {
        Spectrum { of, way: way.name(), fluid_hz: self.hz, bands: spectrum::bands(force) }
    }
}

/// `case` at a fluid rate.
fn setup(
    case: &'static Case,
    hz: f64,
    threads: usize,
    quick: bool,
) -> Result<Setup<'static>, ValidationError> {
    let mut setup = Setup::new(case, threads);
    setup.set("fluid_hz", &Value::Number(hz))?;
    if quick {
        setup.set("seeds", &Value::Number(FEW))?;
    }
    Ok(setup)
}

/// Error of `local` at a spacing and a rate, against the truth at the finest spacing.
fn cost((cells, hz): (f64, f64), threads: usize) -> Result<Point, ValidationError> {
    let setup = setup(&crossing::CASE, hz, threads, false)?;
    let at = |cells: f64| setup.at(setup.number("diameter") / cells);
    let (coarse, fine) = (at(cells), at(CELLS[CELLS.len() - 1]));
    let mut bench = Bench::new(&coarse, jet::scene(&coarse))?;
    let mut reference = Bench::new(&fine, jet::scene(&fine))?;
    let local = Way { coupling: CouplingKind::Local, filter: None };
    let scene = crossing::script(&coarse, &bench.felt(&local)?);
    let before = process_cpu_s();
    let trace = closed_loop::run(&scene, threads)?;
    let cost = (process_cpu_s() - before) / scene.run.duration;
    let truth = reference.truth_of(&trace)?;
    let error = figures::force_error(steady(&trace.sent), steady(&truth.mean));
    Ok(Point { dx: coarse.dx, fluid_hz: hz, error, cost })
}

/// How long something takes.
struct Timed {
    cpu_s: f64,
    begun: Instant,
}

impl Timed {
    fn begin() -> Self {
        Self { cpu_s: process_cpu_s(), begun: Instant::now() }
    }

    fn rows(&self, setup: &Setup<'_>, report: Report) -> Vec<Row> {
        Row::all(setup, report, [process_cpu_s() - self.cpu_s, self.begun.elapsed().as_secs_f64()])
    }
}
