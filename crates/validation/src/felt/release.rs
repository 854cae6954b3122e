//! A hand that lets go: what the tool does by itself.

use super::bench::{Bench, scripted};
use super::closed_loop::Trace;
use super::{figures, jet, pool};
use crate::measure::Felt;
use crate::run::Report;
use crate::{Case, Measure, Setup, ValidationError};
use glam::DVec3;
use hapflow_devices::{HandPreset, HandSettings, Segment};
use hapflow_engine::{Scene, run::TICK_S};
use hapflow_haptics::{CouplingKind, FilterSpec};

/// Way by which the hand pulls the tool away before it lets go (m), and how fast (s).
const PULL: f64 = 0.01;
const PULL_S: f64 = 0.1;
/// Time from then on; its last part, which is looked at; and the very end, which a low pass spoils, s.
const FREE_S: f64 = 2.1;
const LOOKED_AT_S: f64 = 1.0;
const SPOILT_S: f64 = 0.1;
/// Height of the ball in the pool, in edges.
const HEIGHT: f64 = 0.3;
/// Largest swing beyond the truth's, N.
const LIMIT: f64 = 0.02;
/// Factor on the gain that is wished.
const WISHED: f64 = 4.0;

const ABOUT: &str =
    "a hand in each of the five grips pulls the tool aside and lets go: does it swing on by itself?";
const SOURCE: &str = "the same hand in the same fluid, stepped at 1 kHz and answering at once";

pub(super) const POOL: Case = Case {
    name: "felt-release",
    about: ABOUT,
    source: SOURCE,
    parameters: pool::PARAMETERS,
    length: "edge",
    cells: [pool::CELLS; 3],
    variants: &[&[("viscosity", "0.1")], &[("viscosity", "0.001")], &[("viscosity", "1")]],
    run: |setup| run(setup, pool::scene(setup, DVec3::Y * HEIGHT)),
};

pub(super) const JET: Case = Case {
    name: "felt-release-jet",
    about: ABOUT,
    source: SOURCE,
    parameters: jet::PARAMETERS,
    length: "diameter",
    cells: [jet::CELLS; 3],
    variants: &[],
    run: |setup| run(setup, jet::scene(setup)),
};

fn run(setup: &Setup<'_>, scene: Scene) -> Result<Report, ValidationError> {
    let mut bench = Bench::new(setup, scene)?;
    // The truth's scene, and after it that of each way.
    let mut scenes = vec![truth(&bench)];
    for way in bench.ways()? {
        scenes.push(bench.felt(&way)?);
    }
    let hands: Vec<_> = HandPreset::ALL.into_iter().flat_map(|hand| [(hand, 1.0), (hand, WISHED)]).collect();
    let in_hands = |scene: &Scene| hands.iter().map(|&(hand, more)| released(scene, hand, more)).collect();
    let all: Vec<Scene> = scenes.iter().flat_map::<Vec<_>, _>(in_hands).collect();
    let traces = bench.run_each(&all)?;
    let swings: Vec<f64> = all.iter().zip(&traces).map(|(scene, trace)| swing(&scene.hand, trace)).collect();
    let (floors, own) = swings.split_at(hands.len());
    let mut measures = Vec::new();
    for (k, (scene, own)) in all[hands.len()..].iter().zip(own).enumerate() {
        let ((hand, more), floor) = (hands[k % hands.len()], floors[k % hands.len()]);
        let row = |name, goal| Measure {
            felt: Some(Felt::of(scene, hand.name(), Some(floor), goal)),
            ..Measure::zero(name, "N", (own - floor).max(0.0), 1.0)
        };
        measures.push(if more == WISHED {
            row("limit_cycle_4_N", Some(LIMIT))
        } else {
            row("limit_cycle_N", None).goal(LIMIT)
        });
    }
    Ok(bench.report(measures))
}

/// The same fluid, which answers at once.
fn truth(bench: &Bench<'_>) -> Scene {
    let mut scene = bench.scene.clone();
    scene.tool.force_scale = bench.gain;
    (scene.run.coupling, scene.run.filter) = (CouplingKind::Direct, Some(FilterSpec::None));
    (scene.run.fluid_hz, scene.run.fluid_delay) = (1.0 / TICK_S, 0.0);
    scene
}

/// `scene` in that hand, with `more` times the gain: pulled aside, and let go. No friction hides anything.
fn released(scene: &Scene, preset: HandPreset, more: f64) -> Scene {
    let HandSettings { hand_mass_kg, hand_damping_n_s_per_m, hand_stiffness_n_per_m, .. } =
        HandSettings::preset(preset);
    let place = scene.tool.position;
    let to = |position| Segment::MoveTo { position, duration_s: PULL_S };
    let mut scene = scripted(scene, place, &[to(place + DVec3::ONE.normalize() * PULL), to(place)], FREE_S);
    scene.hand = HandSettings {
        device_friction_n: 0.0,
        hand_mass_kg,
        hand_damping_n_s_per_m,
        hand_stiffness_n_per_m,
        ..scene.hand
    };
    scene.tool.force_scale *= more;
    scene
}

/// The force that the motion of the last part takes, but for a steady one: amplitude of m ẍ + b ẋ + k x below 20 Hz, N.
fn swing(hand: &HandSettings, trace: &Trace) -> f64 {
    let mass = hand.device_mass_kg + hand.hand_mass_kg;
    let damping = hand.device_damping_n_s_per_m + hand.hand_damping_n_s_per_m;
    let path = figures::slow(&trace.path);
    let end = path.len() - (SPOILT_S / TICK_S) as usize;
    let last = &path[end - (LOOKED_AT_S / TICK_S) as usize..end];
    let forces: Vec<_> = last
        .windows(3)
        .map(|w| {
            let (velocity, bend) = ((w[2] - w[0]) / (2.0 * TICK_S), w[2] - 2.0 * w[1] + w[0]);
            bend * (mass / TICK_S.powi(2)) + velocity * damping + w[1] * hand.hand_stiffness_n_per_m
        })
        .collect();
    figures::rms(&figures::difference(&forces, &trend(&forces))) * std::f64::consts::SQRT_2
}

/// The straight line through a series, by least squares: a tool that drifts does not swing.
fn trend(series: &[DVec3]) -> Vec<DVec3> {
    let middle = 0.5 * (series.len() as f64 - 1.0);
    let at = |n: usize| n as f64 - middle;
    let mean = series.iter().sum::<DVec3>() / series.len() as f64;
    let (mut slope, mut square) = (DVec3::ZERO, 0.0);
    for (n, value) in series.iter().enumerate() {
        slope += *value * at(n);
        square += at(n).powi(2);
    }
    (0..series.len()).map(|n| mean + slope * (at(n) / square)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    /// A sine of 5 Hz on a drift, in a hand: amplitude |k − m ω² + i b ω| x.
    #[test]
    fn a_swing_is_told_as_the_force_that_it_takes() {
        let hand = HandSettings::preset(HandPreset::Normal);
        let (w, size) = (TAU * 5.0, 1e-4);
        let path = (0..3000).map(|n| {
            let t = f64::from(n) * TICK_S;
            DVec3::X * (size * (w * t).sin() + 0.01 * t)
        });
        let trace = Trace { path: path.collect(), ..Trace::default() };
        let expected = size * (300.0 - 0.35 * w * w).hypot(4.5 * w);
        let found = swing(&hand, &trace);
        assert!((found / expected - 1.0).abs() < 0.03, "{found} for {expected}");
        let drift = (0..3000).map(|n| DVec3::X * 1e-5 * f64::from(n)).collect();
        assert!(swing(&hand, &Trace { path: drift, ..Trace::default() }) < 1e-4);
    }
}
