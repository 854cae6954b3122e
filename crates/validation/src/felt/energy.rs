//! Energy that the coupling makes by itself, over random models that come late and change at random.

use super::{bench, ways};
use crate::case::Parameter;
use crate::measure::Felt;
use crate::run::Report;
use crate::{Case, Measure, Setup, ValidationError};
use glam::{DVec3, Mat3, Vec3};
use hapflow_devices::{HandPreset, HandSettings};
use hapflow_engine::Scene;
use hapflow_haptics::{CouplingKind, Law, LawNode, LocalModel, Rendering, ToolState, Wrench};

/// Length of a motion, ticks.
const TICKS: u32 = 500;
/// Largest force of a model (N), its change over the law's reach (N), and its damping (N·s/m).
const FORCE: f64 = 1.5;
const CHANGE: f64 = 0.5;
const DAMPING: f64 = 2.0;
/// Distance of the law's places, m.
const SPACING: f64 = 0.005;

pub(super) const CASE: Case = Case {
    name: "felt-energy",
    about: "energy that the coupling itself gives to the hand, over random closed-form fields that change at random and come late, in all hands",
    source: "passivity: what is rendered beyond the newest model may do no work on the hand (Hannaford & Ryu 2002, doi:10.1109/70.988969)",
    parameters: &[
        Parameter::number("tool_radius", "m", "0.015", [0.005, 0.1], "Radius of the ball."),
        Parameter::number("gain", "", "1", [0.0, 100.0], "Factor on the force."),
        Parameter::whole("trials", "100000", [1.0, 1e7], "Motions in each of the five hands."),
        Parameter::whole("seed", "1", [0.0, 1e9], "Which motions."),
        Parameter::word("coupling", "local", ways::WORDS, "Only `local` makes anything by itself."),
    ],
    length: "tool_radius",
    cells: [4.0; 3],
    variants: &[],
    run,
};

fn run(setup: &Setup<'_>) -> Result<Report, ValidationError> {
    let trials = setup.number("trials") as u64;
    let seed = setup.number("seed") as u64;
    let mut scene = Scene::default();
    scene.run.coupling = CouplingKind::Local;
    let mut measures = Vec::new();
    for preset in HandPreset::ALL {
        let each = |k: usize| {
            let mut random = Random(seed.wrapping_mul(1 << 32) + k as u64 * 8 + preset as u64 + 1);
            motion(&HandSettings::preset(preset), &mut random, setup.number("gain"))
        };
        let rises = bench::in_parallel(trials as usize, setup.threads(), each);
        let most = rises.into_iter().fold(0.0, f64::max);
        let measure = Measure::zero("energy_own_J", "J", most, 1.0).goal(1e-3);
        let felt = Felt::of(&scene, preset.name(), None, Some(1e-4));
        measures.push(Measure { felt: Some(felt), ..measure });
    }
    let simulated_s = 5e-3 * trials as f64 * f64::from(TICKS);
    Ok(Report { measures, particles: 0, simulated_s, backend: "closed-form", config: scene.fluid_config(1) })
}

/// A small random generator, the same everywhere.
struct Random(u64);

impl Random {
    /// From −1 to 1.
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        let mixed = (self.0 ^ (self.0 >> 33)).wrapping_mul(0xff51afd7ed558ccd);
        (mixed >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    fn vector(&mut self) -> DVec3 {
        DVec3::new(self.next(), self.next(), self.next())
    }
}

/// One motion in a random field; the largest rise of the coupling's own energy, J.
fn motion(hand: &HandSettings, random: &mut Random, gain: f64) -> f64 {
    let mut rendering = Rendering::new(CouplingKind::Local);
    let mass = hand.device_mass_kg + hand.hand_mass_kg;
    let damping = hand.device_damping_n_s_per_m + hand.hand_damping_n_s_per_m;
    let (mut place, mut velocity, wish) = (DVec3::ZERO, random.vector() * 0.2, random.vector() * 0.02);
    let frame_s = 1.0 / (140.0 + 110.0 * random.next());
    let mut model = LocalModel::default();
    let (mut due, mut sum, mut lowest, mut most) = (0.0, 0.0_f64, 0.0_f64, 0.0_f64);
    for n in 0..TICKS {
        let time_s = f64::from(n) * 1e-3;
        let fresh = time_s >= due;
        if fresh {
            model = random_model(random, model.frame + 1, place, time_s, frame_s);
            // On time, or late by up to three frames.
            due = time_s + frame_s * if random.next() > 0.0 { 1.0 } else { 2.5 + 1.5 * random.next() };
        }
        let tool = ToolState { velocity, ..ToolState::at((place / 60e-6).round() * 60e-6) };
        let sent = rendering.tick(&model, fresh, &tool, time_s, gain).force;
        let law = model.evaluate(&ToolState { velocity, ..ToolState::at(place) }).force * gain;
        let pull = hand.hand_stiffness_n_per_m * (wish - place) - damping * velocity + sent;
        velocity += pull / mass * 1e-3;
        let way = velocity * 1e-3;
        place += way;
        sum += (sent - law).dot(way);
        lowest = lowest.min(sum);
        most = most.max(sum - lowest);
    }
    most
}

/// A force that changes linearly with the place round `centre`, and is damped.
fn random_model(random: &mut Random, frame: u64, centre: DVec3, time_s: f64, frame_s: f64) -> LocalModel {
    let slope = [0; 3].map(|_| random.vector() * (CHANGE / SPACING));
    let damping = -Mat3::from_diagonal(Vec3::splat((DAMPING * random.next().abs()) as f32));
    let force = |p: DVec3| {
        let by = slope.map(|s| s.dot(p - centre));
        LawNode { force: DVec3::from(by).as_vec3(), by_velocity: damping }
    };
    LocalModel {
        frame,
        path_end_s: time_s,
        published_s: time_s,
        frame_s,
        wrench: Wrench::from_force(random.vector() * FORCE),
        law: Law::tabulate(centre, DVec3::ZERO, SPACING, force),
        ..LocalModel::default()
    }
}
