//! The filter study: what each filter makes of the force of a coupling, in each use.
//!
//! A hand feels each use once without a filter; that one force then goes through every filter, so that they differ by nothing
//! else. What each lets out is compared with the truth on that hand's path.

use super::bench::{Bench, steady};
use super::{crossing, figures, jet, still, stir, ways::Way};
use crate::{Case, Setup, ValidationError};
use glam::DVec3;
use hapflow_engine::{Scene, SceneError, Value, run::TICK_S, signal};
use hapflow_haptics::{CouplingKind, Filter, FilterSpec, WindowKind, Wrench};
use serde_json::json;

/// Couplings whose force is filtered: the thesis's, with its steps, and the one that has none.
const COUPLINGS: [CouplingKind; 2] = [CouplingKind::Momentum, CouplingKind::Local];
/// Fluids over which the truth is the mean: scatter is small beside what a filter does.
const SEEDS: f64 = 2.0;
/// Lengths of windows: the thesis's over frames, a short one over frames, the thesis's over ticks, one frame of 60 Hz, two.
const WINDOWS: [&str; 5] = ["11@fluid", "3@fluid", "11@servo", "17@servo", "33@servo"];
/// All other filters.
const OTHERS: [&str; 9] = [
    "none",
    "butterworth:10:2",
    "butterworth:20:1",
    "butterworth:20:2",
    "butterworth:20:4",
    "butterworth:50:2",
    "one-euro:1:0.5",
    "one-euro:5:0.5",
    "one-euro:5:5",
];

/// What a filter made of a force.
#[derive(Clone, Debug)]
pub struct Filtered {
    /// What the hand does: `jet`, `crossing` or `stirring`.
    pub usage: &'static str,
    /// Where the force comes from.
    pub coupling: &'static str,
    /// The filter.
    pub filter: String,
    /// Root of the mean square above 20 Hz, N.
    pub ripple_n: f64,
    /// Behind the truth, negative for a lead, s.
    pub lag_s: f64,
    /// By how much its peak is above the truth's, over that; 0 if it is below.
    pub overshoot: f64,
    /// Difference below 20 Hz, over the truth's own size there.
    pub error: f64,
}

impl Filtered {
    /// One line of JSON.
    pub fn json(&self) -> serde_json::Value {
        json!({
            "use": self.usage,
            "coupling": self.coupling,
            "filter": self.filter,
            "ripple_rms_N": self.ripple_n,
            "lag_s": self.lag_s,
            "overshoot": self.overshoot,
            "force_error": self.error,
        })
    }
}

/// What a hand does with a fluid.
struct Usage {
    name: &'static str,
    case: &'static Case,
    scene: fn(&Setup<'_>) -> Scene,
    script: fn(&Setup<'_>, &Scene) -> Scene,
    /// What of the force is looked at.
    part: fn(&[DVec3]) -> Vec<DVec3>,
}

const USES: [Usage; 3] = [
    Usage {
        name: "jet",
        case: &still::CASE,
        scene: jet::scene,
        script: still::script,
        // From the beginning: the jet arrives all at once.
        part: <[DVec3]>::to_vec,
    },
    Usage {
        name: "crossing",
        case: &crossing::CASE,
        scene: jet::scene,
        script: crossing::script,
        part: |force| steady(force).to_vec(),
    },
    Usage {
        name: "stirring",
        case: &stir::CASE,
        scene: stir::scene,
        script: stir::script,
        part: |force| stir::level(steady(force)),
    },
];

/// The whole study, on `threads` threads; `tell` hears of each filter.
///
/// # Errors
/// What a session or a fluid refuses.
pub fn filters(threads: usize, mut tell: impl FnMut(&Filtered)) -> Result<(), ValidationError> {
    let specs = specs()?;
    for usage in USES {
        let mut setup = Setup::new(usage.case, threads);
        setup.set("seeds", &Value::Number(SEEDS))?;
        let mut bench = Bench::new(&setup, (usage.scene)(&setup))?;
        for coupling in COUPLINGS {
            let way = Way { coupling, filter: Some(FilterSpec::None) };
            let scene = (usage.script)(&setup, &bench.felt(&way)?);
            let trace = bench.run(&scene)?;
            let truth = (usage.part)(&bench.truth_of(&trace)?.mean);
            for spec in &specs {
                let sent = (usage.part)(&through(spec, &trace.sent, &trace.fresh)?);
                tell(&judged(&usage, coupling, spec, &sent, &truth));
            }
        }
    }
    Ok(())
}

/// Every filter of the study.
fn specs() -> Result<Vec<FilterSpec>, ValidationError> {
    let windows = WindowKind::ALL.iter().flat_map(|kind| WINDOWS.map(|w| format!("{}:{w}", kind.name())));
    let all = OTHERS.iter().map(ToString::to_string).chain(windows);
    let specs: Result<Vec<FilterSpec>, _> = all.map(|text| text.parse()).collect();
    Ok(specs.map_err(SceneError::from)?)
}

/// `force` as `spec` lets it out.
fn through(spec: &FilterSpec, force: &[DVec3], fresh: &[bool]) -> Result<Vec<DVec3>, ValidationError> {
    let mut filter = Filter::new(spec, 1.0 / TICK_S).map_err(SceneError::from)?;
    let ticks = force.iter().zip(fresh);
    Ok(ticks.map(|(force, fresh)| filter.step(Wrench::from_force(*force), *fresh).force).collect())
}

fn judged(
    usage: &Usage,
    coupling: CouplingKind,
    spec: &FilterSpec,
    sent: &[DVec3],
    truth: &[DVec3],
) -> Filtered {
    let peak = |series: &[DVec3]| series.iter().map(|f| f.length()).fold(0.0, f64::max);
    // The beginning of a jet is no ripple.
    let settled = if usage.name == "jet" { steady(sent) } else { sent };
    Filtered {
        usage: usage.name,
        coupling: coupling.name(),
        filter: spec.to_string(),
        ripple_n: signal::ripple_rms(settled),
        lag_s: figures::shift_s(sent, truth),
        overshoot: (peak(sent) / peak(&figures::slow(truth)) - 1.0).max(0.0),
        error: figures::force_error(sent, truth),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A step that comes late and once: each filter of the study keeps its height and is as late as it says.
    #[test]
    fn every_filter_is_judged_by_what_it_does() {
        let truth: Vec<_> =
            (0..3000).map(|n| DVec3::Y * (std::f64::consts::TAU * 1e-3 * f64::from(n)).sin()).collect();
        let fresh: Vec<_> = (0..truth.len()).map(|n| n % 17 == 0).collect();
        let specs = specs().unwrap();
        assert_eq!(specs.len(), OTHERS.len() + WINDOWS.len() * WindowKind::ALL.len());
        for spec in specs {
            let sent = through(&spec, &truth, &fresh).unwrap();
            let found = judged(&USES[1], CouplingKind::Momentum, &spec, &sent, &truth);
            let delay = Filter::new(&spec, 1000.0).unwrap().delay_s(0.017);
            let held = if spec.to_string().ends_with("@fluid") { 0.008 } else { 0.0 };
            // A one-euro filter is faster than it says while the force changes.
            if !matches!(spec, FilterSpec::OneEuro { .. }) {
                assert!((found.lag_s - delay - held).abs() < 4e-3, "{}: {}", found.filter, found.lag_s);
            }
            assert!(found.overshoot < 0.02, "{found:?}");
        }
    }
}
