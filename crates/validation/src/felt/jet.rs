//! A ball in a hand under a falling jet.

use super::bench::{fluid, hand, open_gate};
use super::ways;
use crate::case::Parameter;
use crate::{Setup, worlds};
use glam::DVec3;
use hapflow_engine::{BackendKind, Form, Scene};
use hapflow_fluid::Aabb;

/// Height of the outlet over the ball's centre, m.
const FALL: f64 = 0.06;
/// Spacings in the jet's diameter, as shipped: real time on two cores.
pub(super) const CELLS: f64 = 5.0;

/// Parameters of every jet that is felt.
pub(super) const PARAMETERS: &[Parameter] = &[
    Parameter::number("diameter", "m", "0.02", [0.005, 0.1], "Diameter of the jet at its outlet."),
    Parameter::number("speed", "m/s", "1.2", [0.2, 5.0], "Speed at the outlet, 60 mm above the ball."),
    Parameter::number("tool_radius", "m", "0.015", [0.005, 0.1], "Radius of the ball."),
    Parameter::number(
        "offset",
        "m",
        "0.012",
        [0.0, 0.1],
        "Distance from the axis, where the side is looked at.",
    ),
    Parameter::number("crossing_speed", "m/s", "0.2", [0.02, 1.0], "Speed at which the axis is crossed."),
    Parameter::number("viscosity", "Pa·s", "0.001", [0.0, 100.0], "Viscosity of the fluid."),
    Parameter::number(
        "gain",
        "",
        "0",
        [0.0, 100.0],
        "Factor on the fluid's force; 0 takes what makes 1 N on the axis.",
    ),
    Parameter::number("fluid_hz", "Hz", "60", [20.0, 500.0], "Fluid frames a second."),
    Parameter::number("fluid_delay", "frames", "1", [0.0, 1.0], "Time that a frame takes to compute."),
    Parameter::word("coupling", "local", ways::WORDS, "Which couplings are measured; `bench felt` has all."),
    Parameter::word(
        "backend",
        "cpu",
        &["cpu", "analytic-jet"],
        "Particles, or a jet in closed form, which has no scatter.",
    ),
    Parameter::whole("seeds", "8", [1.0, 64.0], "Fluids over which the truth is the mean."),
    Parameter::word("hand", "normal", &["free", "light", "normal", "firm", "arm"], "Whose hand it is."),
    Parameter::number("hand_mass", "kg", "-1", [-1.0, 10.0], "Its mass; below 0 it is the hand's own."),
    Parameter::number(
        "hand_damping",
        "N·s/m",
        "-1",
        [-1.0, 50.0],
        "Its damping; below 0 it is the hand's own.",
    ),
    Parameter::number(
        "hand_stiffness",
        "N/m",
        "-1",
        [-1.0, 5000.0],
        "Its stiffness; below 0 it is the hand's own.",
    ),
];

/// The jet of `setup` on a ball on its axis.
pub(super) fn scene(setup: &Setup<'_>) -> Scene {
    let mut scene = Scene::default();
    let reach = 4.0 * setup.number("diameter").max(setup.number("tool_radius"));
    scene.bounds =
        Aabb { min: DVec3::new(-reach, -0.05, -reach), max: DVec3::new(reach, FALL + 0.03, reach) };
    scene.sources = vec![worlds::jet(FALL, setup.number("diameter"), setup.number("speed"))];
    scene.tool.form = Form::ball(setup.number("tool_radius"));
    scene.run.fluid_hz = setup.number("fluid_hz");
    scene.run.fluid_delay = setup.number("fluid_delay");
    if setup.word("backend") == "analytic-jet" {
        scene.run.backend = BackendKind::AnalyticJet;
    }
    scene.hand = hand(setup);
    open_gate(&mut scene);
    scene.fluid = fluid(setup, &scene);
    scene
}
