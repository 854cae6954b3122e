//! A random hand with a random device in a random jet, or rarely in a tank of particles.

use crate::stress::dice::Dice;
use crate::worlds;
use glam::DVec3;
use hapflow_devices::{HandPreset, HandSettings, Segment};
use hapflow_engine::{BackendKind, Form, Scene};
use hapflow_fluid::Aabb;
use hapflow_haptics::{CouplingKind, GateSettings};

/// Share of trials with particles, which cost more than all others.
const PARTICLES: f64 = 0.02;
/// Share with the coupling `local`.
const LOCAL: f64 = 0.7;
/// Filters that are tried; the empty one is the coupling's own.
const FILTERS: [&str; 7] = [
    "",
    "",
    "none",
    "bartlett-hann:11@fluid",
    "bartlett-hann:11@servo",
    "butterworth:30:2@servo",
    "one-euro:5:0.5@servo",
];
/// Half the edge of the room, m.
const ROOM: f64 = 0.3;
/// Edge of the tank, m, and its spacings.
const TANK: f64 = 0.06;
const CELLS: f64 = 8.0;
/// Time in which a hand that is left alone feels again what there is, beside the ramp, s.
const SETTLING_S: f64 = 0.3;

/// A random scene.
#[derive(Clone, Debug)]
pub(super) struct Scenery {
    pub scene: Scene,
}

impl Scenery {
    pub fn draw(dice: &mut Dice) -> Self {
        let mut scene = Scene::default();
        let room = DVec3::splat(ROOM);
        scene.bounds = Aabb { min: -room, max: room };
        scene.tool.form = Form::ball(dice.scale(0.005, 0.04));
        scene.tool.force_scale = dice.scale(0.1, 30.0);
        scene.mapping.scale = if dice.chance(0.7) { 1.0 } else { dice.scale(0.2, 5.0) };
        scene.run.fluid_hz = dice.scale(20.0, 500.0);
        scene.run.coupling = match dice.chance(LOCAL) {
            true => CouplingKind::Local,
            false => dice.pick(&CouplingKind::ALL).copied().unwrap_or(CouplingKind::Local),
        };
        scene.run.filter = dice.pick(&FILTERS).and_then(|text| text.parse().ok());
        scene.gate = gate(dice);
        scene.hand = hand(dice);
        scene.script = (0..4).map(|_| segment(dice)).collect();
        if dice.chance(PARTICLES) {
            tank(&mut scene)
        } else {
            jets(&mut scene, dice)
        }
        Self { scene }
    }

    /// Time in which all is as ever again once nothing goes wrong, s.
    pub fn quiet_s(&self) -> f64 {
        let frames = self.scene.gate.stale_hold_frames / self.scene.run.fluid_hz;
        self.scene.gate.ramp_in_s + SETTLING_S + frames
    }
}

/// The shipped limits, or any.
fn gate(dice: &mut Dice) -> GateSettings {
    if dice.chance(0.5) {
        return GateSettings::default();
    }
    GateSettings {
        max_force_n: dice.scale(0.1, 50.0),
        max_torque_nm: dice.scale(0.01, 5.0),
        max_slew_n_per_s: dice.scale(1.0, 1e6),
        max_torque_slew_nm_per_s: dice.scale(0.01, 1e5),
        ramp_in_s: dice.within(0.0, 1.5),
        // A frame takes up to one more to compute.
        stale_hold_frames: dice.within(2.0, 10.0),
        stale_fade_s: dice.within(0.0, 0.5),
    }
}

/// A corner, or between corners.
fn hand(dice: &mut Dice) -> HandSettings {
    let own = HandSettings::preset(dice.pick(&HandPreset::ALL).copied().unwrap_or_default());
    let mut about = |number: f64| number * dice.scale(0.5, 2.0);
    HandSettings {
        device_mass_kg: about(own.device_mass_kg),
        device_damping_n_s_per_m: about(own.device_damping_n_s_per_m),
        hand_mass_kg: about(own.hand_mass_kg),
        hand_damping_n_s_per_m: about(own.hand_damping_n_s_per_m),
        hand_stiffness_n_per_m: about(own.hand_stiffness_n_per_m),
        device_friction_n: dice.within(0.0, 0.3),
        transport_delay_s: dice.within(0.0, 0.005),
        encoder_step_m: if dice.chance(0.2) { 0.0 } else { dice.scale(1e-6, 1e-3) },
        velocity_cutoff_hz: dice.scale(50.0, 300.0),
    }
}

fn segment(dice: &mut Dice) -> Segment {
    let duration_s = dice.within(0.1, 1.0);
    let amplitude = dice.direction() * dice.scale(1e-3, 0.03);
    match dice.whole(0, 3) {
        0 => Segment::Hold { duration_s },
        1 => Segment::Sine { amplitude, frequency_hz: dice.scale(0.5, 8.0), duration_s },
        2 => Segment::Circle { centre: amplitude, frequency_hz: dice.scale(0.3, 4.0), duration_s },
        _ => Segment::MoveTo { position: dice.direction() * dice.within(0.0, 0.08), duration_s },
    }
}

/// One or two jets in closed form; wide ones hold the whole tool, as a pool does.
fn jets(scene: &mut Scene, dice: &mut Dice) {
    scene.run.backend = BackendKind::AnalyticJet;
    scene.fluid.viscosity = dice.scale(1e-4, 10.0);
    for k in 0..dice.whole(1, 2) {
        let mut jet = worlds::jet(dice.within(0.02, 0.2), dice.scale(0.005, 0.2), dice.scale(0.1, 4.0));
        jet.name = k.to_string();
        jet.direction = if k == 0 { DVec3::NEG_Y } else { dice.direction() };
        if dice.chance(0.3) {
            (jet.period, jet.duty) = (dice.within(0.05, 1.0), dice.within(0.1, 0.9));
        }
        scene.sources.push(jet);
    }
}

/// A small tank, with the tool at its surface.
fn tank(scene: &mut Scene) {
    let half = DVec3::new(0.5 * TANK, 0.0, 0.5 * TANK);
    let upright = |height: f64| Aabb { min: -half - DVec3::Y * 0.5 * TANK, max: half + DVec3::Y * height };
    scene.container = Some(upright(TANK));
    scene.pools = vec![upright(0.0)];
    scene.tool.form = Form::ball(0.15 * TANK);
    scene.fluid.spacing = TANK / CELLS;
    scene.fluid.viscosity = 0.1;
    scene.fluid.sound_speed = 8.0;
}
