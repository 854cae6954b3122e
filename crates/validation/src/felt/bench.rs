//! What the felt cases measure with: runs in a hand, and their truths.

use super::closed_loop::{self, Trace};
use super::figures;
use super::truth::Truth;
use super::ways::Way;
use crate::measure::Felt;
use crate::run::Report;
use crate::{Measure, Setup, ValidationError};
use glam::DVec3;
use hapflow_devices::{HandPreset, HandSettings, Segment};
use hapflow_engine::{BackendKind, Scene};
use hapflow_fluid::FluidSettings;

/// Time in which a flow comes to be steady before the hand moves, s.
pub(super) const WARM_UP: f64 = 0.35;
/// Time for which a steady force is measured, s.
const STEADY: f64 = 1.0;
/// Speed of sound over the highest speed of the fluid, as shipped scenes have it: real time on two cores.
const SOUND: f64 = 5.0;

/// The Falcon-like device in the hand of `setup`: 0.2 kg, little friction (so that it hides nothing), encoders of 60 µm,
/// two milliseconds from a write to the force.
pub(super) fn hand(setup: &Setup<'_>) -> HandSettings {
    let preset = HandPreset::from_name(setup.word("hand")).unwrap_or_default();
    let own = HandSettings::preset(preset);
    let or = |name: &str, own: f64| Some(setup.number(name)).filter(|n| *n >= 0.0).unwrap_or(own);
    HandSettings {
        device_friction_n: 0.05,
        transport_delay_s: 0.002,
        encoder_step_m: 60e-6,
        hand_mass_kg: or("hand_mass", own.hand_mass_kg),
        hand_damping_n_s_per_m: or("hand_damping", own.hand_damping_n_s_per_m),
        hand_stiffness_n_per_m: or("hand_stiffness", own.hand_stiffness_n_per_m),
        ..own
    }
}

/// A gate that lets everything through that a device can give.
pub(super) fn open_gate(scene: &mut Scene) {
    scene.gate.ramp_in_s = 0.0;
    scene.gate.max_force_n = 9.0;
    scene.gate.max_slew_n_per_s = 1e5;
}

/// What a case measures with.
pub(super) struct Bench<'a> {
    pub setup: &'a Setup<'a>,
    /// With a factor of 1 on the force.
    pub scene: Scene,
    /// Factor that makes the truth as large as is wanted.
    pub gain: f64,
    /// The truth's mean on the still ball with a factor of 1, N.
    still: DVec3,
    simulated_s: f64,
}

impl<'a> Bench<'a> {
    /// In `scene`, with a force that is 1 N in the mean while the tool is still unless a gain was chosen.
    pub fn new(setup: &'a Setup<'a>, scene: Scene) -> Result<Self, ValidationError> {
        let place = scene.tool.position;
        let mut bench = Self::unscaled(setup, scene);
        let still = bench.truth(&bench.scene.clone(), &still_path(place), 1)?;
        bench.still = mean(steady(&still.mean));
        let chosen = setup.number("gain");
        bench.gain = if chosen > 0.0 { chosen } else { 1.0 / bench.still.length().max(1e-6) };
        Ok(bench)
    }

    /// In `scene`, with a factor of 1.
    pub fn unscaled(setup: &'a Setup<'a>, scene: Scene) -> Self {
        Self { setup, scene, gain: 1.0, still: DVec3::ZERO, simulated_s: 0.0 }
    }

    /// The ways that are measured.
    pub fn ways(&self) -> Result<Vec<Way>, ValidationError> {
        Way::named(self.setup.word("coupling"))
    }

    /// The scene felt by `way`, with the mean force of the truth on the axis.
    pub fn felt(&mut self, way: &Way) -> Result<Scene, ValidationError> {
        let mut still = way.scene(&self.scene, 1.0);
        still.hand.hand_stiffness_n_per_m = 5000.0;
        still.hand.hand_damping_n_s_per_m = 50.0;
        still.run.duration = WARM_UP + 0.4;
        let trace = self.run(&still)?;
        let own = mean(&trace.sent[(1e3 * WARM_UP) as usize..]).dot(self.still.normalize_or_zero());
        Ok(way.scene(&self.scene, self.gain * self.still.length() / own.max(1e-6)))
    }

    /// Counts `seconds` that were simulated elsewhere.
    pub fn lived_through(&mut self, seconds: f64) {
        self.simulated_s += seconds;
    }

    /// A run of `scene` in the hand.
    pub fn run(&mut self, scene: &Scene) -> Result<Trace, ValidationError> {
        self.simulated_s += scene.run.duration;
        Ok(closed_loop::run(scene, self.setup.threads())?)
    }

    /// A run of each of `scenes`, several at a time.
    pub fn run_each(&mut self, scenes: &[Scene]) -> Result<Vec<Trace>, ValidationError> {
        self.simulated_s += scenes.iter().map(|scene| scene.run.duration).sum::<f64>();
        let one = |k: usize| closed_loop::run(&scenes[k], 1);
        Ok(in_parallel(scenes.len(), self.setup.threads(), one).into_iter().collect::<Result<_, _>>()?)
    }

    /// What the hand should have felt on `path` in `scene`.
    pub fn truth(&mut self, scene: &Scene, path: &[DVec3], seeds: usize) -> Result<Truth, ValidationError> {
        self.simulated_s += 1e-3 * (path.len() * seeds) as f64;
        Truth::replay(self.setup, scene, path, seeds)
    }

    /// The truth of a run, with the truth's own factor, over as many seeds as were asked for.
    pub fn truth_of(&mut self, trace: &Trace) -> Result<Truth, ValidationError> {
        let mut scene = self.scene.clone();
        scene.tool.force_scale = self.gain;
        self.truth(&scene, &trace.path, self.setup.number("seeds") as usize)
    }

    /// `measure` as one of `scene`, with the truth's own scatter and a goal beyond what it must reach.
    pub fn mark(&self, measure: Measure, scene: &Scene, floor: Option<f64>, goal: Option<f64>) -> Measure {
        Measure { felt: Some(Felt::of(scene, self.setup.word("hand"), floor, goal)), ..measure }
    }

    pub fn report(self, measures: Vec<Measure>) -> Report {
        Report {
            measures,
            particles: 0,
            simulated_s: self.simulated_s,
            backend: match self.scene.run.backend {
                BackendKind::Cpu => "cpu",
                BackendKind::AnalyticJet => "analytic-jet",
            },
            config: self.scene.fluid_config(self.setup.threads()),
        }
    }
}

/// A still place, for as long as a steady force is measured.
pub(super) fn still_path(place: DVec3) -> Vec<DVec3> {
    vec![place; (1e3 * (WARM_UP + STEADY)) as usize + 1]
}

/// The part after the warm-up.
pub(super) fn steady<T>(series: &[T]) -> &[T] {
    &series[((1e3 * WARM_UP) as usize).min(series.len())..]
}

pub(super) fn mean(series: &[DVec3]) -> DVec3 {
    series.iter().sum::<DVec3>() / series.len().max(1) as f64
}

/// The shipped configuration, with the speed of sound of shipped scenes.
pub(super) fn fluid(setup: &Setup<'_>, scene: &Scene) -> FluidSettings {
    let mut config = setup.config(scene.fluid_config(1).world);
    if config.settings.sound_speed == 0.0 {
        config.settings.sound_speed = SOUND * config.reference_speed();
    }
    config.settings
}

/// A scene in which the hand starts at `from`, waits for the jet, does `segments` and holds.
pub(super) fn scripted(scene: &Scene, from: DVec3, segments: &[Segment], hold: f64) -> Scene {
    let mut scene = scene.clone();
    scene.tool.position = from;
    scene.script = vec![Segment::Hold { duration_s: WARM_UP }];
    scene.script.extend_from_slice(segments);
    let length = |s: &Segment| match *s {
        Segment::Hold { duration_s }
        | Segment::MoveTo { duration_s, .. }
        | Segment::Sine { duration_s, .. }
        | Segment::Circle { duration_s, .. } => duration_s,
    };
    scene.run.duration = scene.script.iter().map(length).sum::<f64>() + hold;
    scene
}

/// Ripple of a steady force: root of the mean square above 20 Hz.
pub(super) fn ripple(series: &[DVec3]) -> f64 {
    figures::rms(&figures::difference(series, &figures::slow(series)))
}

/// `act` of 0 to `count`, on as many threads as `threads`, in order.
pub(super) fn in_parallel<T: Send>(count: usize, threads: usize, act: impl Fn(usize) -> T + Sync) -> Vec<T> {
    let each = |worker: usize| (worker..count).step_by(threads).map(&act).collect::<Vec<_>>();
    let shares: Vec<Vec<T>> = std::thread::scope(|scope| {
        let workers: Vec<_> = (1..threads)
            .map(|w| {
                scope.spawn({
                    let each = &each;
                    move || each(w)
                })
            })
            .collect();
        let mut shares = vec![each(0)];
        shares.extend(
            workers.into_iter().map(|w| w.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic))),
        );
        shares
    });
    let mut shares: Vec<_> = shares.into_iter().map(Vec::into_iter).collect();
    (0..count).filter_map(|k| shares[k % threads].next()).collect()
}
