//! A hand that swings in a jet, along and across it.

use super::bench::{Bench, WARM_UP, scripted};
use super::figures;
use super::jet;
use super::ways::Way;
use crate::run::Report;
use crate::{Case, Measure, Setup, ValidationError};
use glam::DVec3;
use hapflow_devices::Segment;

/// Frequency (Hz), amplitude (m), duration (s) and its last part that is looked at (s, whole periods): what was before a
/// swing is still felt in its first part by who feels it late.
const SWINGS: [[f64; 4]; 3] = [[1.0, 0.008, 1.5, 1.0], [2.0, 0.005, 1.0, 0.5], [3.0, 0.004, 1.0, 2.0 / 3.0]];

pub(super) const CASE: Case = Case {
    name: "felt-lag",
    about: "a hand swings in a jet at 1, 2 and 3 Hz, along it and across: lag and size of the force",
    source: "the hand's path through a fluid stepped at 1 kHz that answers at once, mean over seeds",
    parameters: jet::PARAMETERS,
    length: "diameter",
    cells: [jet::CELLS; 3],
    variants: &[
        // Its goals are for 60 Hz; other rates stand in `bench felt`.
        &[("backend", "cpu")],
        &[("backend", "analytic-jet")],
    ],
    run,
};

fn run(setup: &Setup<'_>) -> Result<Report, ValidationError> {
    let mut bench = Bench::new(setup, jet::scene(setup))?;
    let mut measures = Vec::new();
    for way in bench.ways()? {
        measures.extend(swung(&mut bench, &way)?);
    }
    Ok(bench.report(measures))
}

/// The worst of all frequencies and both directions.
pub(super) fn swung(bench: &mut Bench<'_>, way: &Way) -> Result<Vec<Measure>, ValidationError> {
    let felt = bench.felt(way)?;
    let aside = DVec3::X * bench.setup.number("offset");
    let (mut lag, mut gain, mut floor) = (0.0_f64, 0.0_f64, [0.0_f64; 2]);
    for (place, along) in [(DVec3::ZERO, DVec3::Y), (aside, DVec3::X)] {
        let segments = SWINGS.map(|[frequency_hz, size, duration_s, _]| Segment::Sine {
            amplitude: along * size,
            frequency_hz,
            duration_s,
        });
        let scene = scripted(&felt, place, &segments, 0.0);
        let trace = bench.run(&scene)?;
        let truth = bench.truth_of(&trace)?;
        let mut end = WARM_UP;
        for [hz, _, duration, part] in SWINGS {
            end += duration;
            let part = (1e3 * (end - part)) as usize..(1e3 * end) as usize;
            // The jet's force stays along it, whichever way the hand goes.
            let of = |a: &[DVec3], b: &[DVec3]| {
                figures::lag_and_gain(&a[part.clone()], &b[part.clone()], hz, DVec3::Y)
            };
            let [own_lag, own_gain] = of(&trace.sent, &truth.mean);
            lag = lag.max(own_lag.abs());
            gain = gain.max((own_gain - 1.0).abs());
            floor[0] = floor[0].max(truth.floor(|a, b| of(a, b)[0].abs()));
            floor[1] = floor[1].max(truth.floor(|a, b| (of(a, b)[1] - 1.0).abs()));
        }
    }
    let mark = |m: Measure, floor, goal| bench.mark(m, &felt, Some(floor), Some(goal));
    Ok(vec![
        mark(Measure::zero("lag_s", "s", lag, 1.0).goal(5e-3), floor[0], 2e-3),
        mark(Measure::zero("gain_error", "1", gain, 1.0).goal(0.1), floor[1], 0.04),
    ])
}
