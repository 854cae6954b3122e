//! A ball that is drawn slowly through a tank must not feel the lattice of the particles, nor drag that water has not.

use crate::case::{Case, Parameter};
use crate::reference::{GRAVITY, SphereInTube, ball_volume};
use crate::run::{Report, Run};
use crate::{Measure, Setup, ValidationError, stats, worlds};
use glam::DVec3;
use hapflow_fluid::{BodySample, Shape};
use std::f64::consts::TAU;

/// Time at rest before the ball starts, and time in which it gets its speed, s.
const REST: f64 = 0.5;
const START: f64 = 0.3;
/// Way at full speed, in spacings of the shipped resolution: periods of the lattice.
const PERIODS: f64 = 6.0;

pub(super) const CASE: Case = Case {
    name: "tow",
    about: "a ball towed sideways through a cube of water: the lattice's ripple, and drag beyond water's own",
    source: "Archimedes ρ g V as the scale; drag by Schiller & Naumann 1933",
    parameters: &[
        Parameter::number("radius", "m", "0.08", [0.005, 0.15], "Radius of the ball."),
        Parameter::number("side", "m", "0.4", [0.05, 2.0], "Side of the cube of water."),
        Parameter::number("speed", "m/s", "0.1", [0.03, 0.3], "Speed of the tow."),
        Parameter::DENSITY,
    ],
    length: "side",
    cells: [22.0, 25.0, 28.0],
    variants: &[&[("speed", "0.1")], &[("speed", "0.03")], &[("speed", "0.3")]],
    run,
};

fn run(setup: &Setup<'_>) -> Result<Report, ValidationError> {
    let (radius, side, speed) = (setup.number("radius"), setup.number("side"), setup.number("speed"));
    let way = PERIODS * setup.shipped_dx();
    let full = way / speed;
    let start = DVec3::new(-0.5 * (way + 0.5 * speed * START), 0.5 * side, 0.0);
    let mut world = worlds::tank(DVec3::splat(side));
    world.bodies = vec![worlds::body(Shape::Sphere { radius }, start)];
    let mut run = Run::start(setup, setup.config(world))?;
    let motion = |t: f64| tow(start, speed, t - REST);
    run.record(REST + START, motion, |_| 0.0);
    let (mut along, mut up) = (Vec::new(), Vec::new());
    for _ in 0..(full / run.dt()).round() as usize {
        let output = run.step(Some(vec![motion(run.time() + run.dt())]));
        let force = output.loads[0].force();
        along.push([run.time(), force.x]);
        up.push([run.time(), force.y]);
    }
    let (density, viscosity) = (setup.number("density"), run.config().settings.viscosity);
    let archimedes = density * GRAVITY * ball_volume(radius);
    let ripple = [along.as_slice(), &up].map(|force| amplitude(force, TAU * speed / setup.dx));
    let ball = SphereInTube { radius, blockage: 0.0, density, viscosity };
    let spurious = -stats::mean(&along) - ball.free_drag(speed);
    let drag = Measure::zero("spurious_drag", "N", spurious, archimedes);
    Ok(run.report(vec![
        Measure::zero("lattice_ripple", "N", ripple[0].max(ripple[1]), archimedes).goal(1e-3),
        if speed == 0.1 { drag.goal(0.01) } else { drag },
    ]))
}

/// Amplitude of the oscillation of angular frequency `omega` (rad/s).
fn amplitude(force: &stats::Series, omega: f64) -> f64 {
    let [c, s] = stats::sine(force, omega);
    c.hypot(s)
}

/// The ball `time` seconds after it was set off from `start`: evenly up to `speed`, and on.
fn tow(start: DVec3, speed: f64, time: f64) -> BodySample {
    let (ramp, full) = (time.clamp(0.0, START), (time - START).max(0.0));
    let x = 0.5 * speed * ramp * ramp / START + speed * full;
    BodySample { velocity: DVec3::X * speed * ramp / START, ..BodySample::at(start + DVec3::X * x) }
}
