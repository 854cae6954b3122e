//! A ball in a hand in an open box of fluid.

use super::bench::{fluid, hand, open_gate};
use super::ways;
use crate::Setup;
use crate::case::Parameter;
use glam::DVec3;
use hapflow_engine::{Form, Scene};
use hapflow_fluid::Aabb;

/// Depth of the fluid, in edges.
const DEPTH_SHARE: f64 = 0.6;
/// Spacings in the edge, as shipped.
pub(super) const CELLS: f64 = 16.0;

/// Parameters of every pool that is felt.
pub(super) const PARAMETERS: &[Parameter] = &[
    Parameter::number("edge", "m", "0.1", [0.05, 0.5], "Edge of the box; the fluid is 0.6 of it deep."),
    Parameter::number("viscosity", "Pa·s", "0.1", [0.0, 100.0], "Viscosity of the fluid."),
    Parameter::number("tool_radius", "m", "0.012", [0.005, 0.1], "Radius of the ball."),
    Parameter::number("speed", "m/s", "0.2", [0.02, 1.0], "Highest speed of the hand."),
    Parameter::number(
        "gain",
        "",
        "10",
        [0.0, 100.0],
        "Factor on the fluid's force; 0 takes what makes 1 N at rest.",
    ),
    Parameter::number("fluid_hz", "Hz", "60", [20.0, 500.0], "Fluid frames a second."),
    Parameter::number("fluid_delay", "frames", "1", [0.0, 1.0], "Time that a frame takes to compute."),
    Parameter::word("coupling", "local", ways::WORDS, "Which couplings are measured; `bench felt` has all."),
    Parameter::whole("seeds", "4", [1.0, 64.0], "Fluids over which the truth is the mean."),
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

/// The box of `setup` with a ball at `place` (shares of the edge from the middle of the floor).
pub(super) fn scene(setup: &Setup<'_>, place: DVec3) -> Scene {
    let mut scene = Scene::default();
    let edge = setup.number("edge");
    let upright = |height: f64| {
        let half = DVec3::new(0.5 * edge, 0.0, 0.5 * edge);
        Aabb { min: -half, max: half + DVec3::Y * height }
    };
    scene.bounds = Aabb { min: DVec3::splat(-edge), max: DVec3::new(edge, 2.0 * edge, edge) };
    scene.container = Some(upright(1.2 * edge));
    scene.pools = vec![upright(DEPTH_SHARE * edge)];
    scene.tool.form = Form::ball(setup.number("tool_radius"));
    scene.tool.position = place * edge;
    scene.run.fluid_hz = setup.number("fluid_hz");
    scene.run.fluid_delay = setup.number("fluid_delay");
    scene.hand = hand(setup);
    open_gate(&mut scene);
    scene.fluid = fluid(setup, &scene);
    scene
}
