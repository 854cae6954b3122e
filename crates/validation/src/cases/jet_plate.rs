//! A jet pushes a wide plate by the momentum that it brings across it.

use crate::case::{Case, Parameter};
use crate::reference::disc_area;
use crate::run::{Report, Run};
use crate::{Measure, Setup, ValidationError, stats, worlds};
use glam::{DQuat, DVec3};
use hapflow_fluid::{Aabb, BodySample, Shape};

/// Distance of the outlet from a plate at rest, and radius of the plate, in diameters of the jet.
const DISTANCE: f64 = 2.0;
const PLATE: f64 = 3.0;
/// Times that the water needs from the outlet to the plate's rim.
const PASSAGES: f64 = 16.0;

pub(super) const CASE: Case = Case {
    name: "jet-plate",
    about: "a jet without gravity on a wide plate, normal or inclined, at rest or moving along the jet",
    source: "balance of momentum: ρ A (v − u)² sin θ, Batchelor 1967, An Introduction to Fluid Dynamics, §5.15 (doi:10.1017/CBO9780511800955)",
    parameters: &[
        Parameter::number("diameter", "m", "0.02", [0.002, 0.2], "Diameter of the jet."),
        Parameter::number("speed", "m/s", "1.5", [0.1, 10.0], "Speed of the jet."),
        Parameter::number("angle_deg", "°", "90", [30.0, 90.0], "Angle between jet and plate; 90 is normal."),
        Parameter::number(
            "plate_speed",
            "m/s",
            "0",
            [-2.0, 2.0],
            "Speed of the plate along the jet; above 0 it recedes. Below 0.8 of the jet's.",
        ),
        Parameter::DENSITY,
    ],
    length: "diameter",
    cells: [6.0, 8.0, 10.0],
    variants: &[
        &[("angle_deg", "90"), ("plate_speed", "0")],
        &[("angle_deg", "60")],
        &[("angle_deg", "45")],
        &[("plate_speed", "0.3")],
        &[("plate_speed", "-0.3")],
    ],
    run,
};

fn run(setup: &Setup<'_>) -> Result<Report, ValidationError> {
    let (diameter, speed) = (setup.number("diameter"), setup.number("speed"));
    let (angle, plate_speed) = (setup.number("angle_deg").to_radians(), setup.number("plate_speed"));
    let relative = speed - plate_speed;
    if relative < 0.2 * speed {
        return Err(ValidationError::BadValue {
            case: CASE.name,
            name: "plate_speed",
            value: plate_speed.to_string(),
            expected: format!("at most 0.8 of the jet's speed, {} m/s", 0.8 * speed),
        });
    }
    let (distance, radius) = (DISTANCE * diameter, PLATE * diameter);
    let duration = PASSAGES * (distance + radius) / relative;
    // An approaching plate starts farther off and ends there; a receding one starts there.
    let outlet = distance + (-plate_speed * duration).max(0.0);
    let reach = DVec3::splat(2.0 * radius);
    let travel = DVec3::Y * plate_speed * duration;
    let corners = [DVec3::ZERO, -travel, DVec3::Y * outlet];
    let low = corners.into_iter().fold(DVec3::INFINITY, DVec3::min) - reach;
    let high = corners.into_iter().fold(DVec3::NEG_INFINITY, DVec3::max) + reach;
    let mut world = worlds::empty(Aabb { min: low, max: high });
    world.sources = vec![worlds::jet(outlet, diameter, speed)];
    world.bodies = vec![worlds::body(Shape::Disc { radius, thickness: 0.5 * diameter }, DVec3::ZERO)];
    let mut config = setup.config(world);
    config.settings.gravity = DVec3::ZERO;
    let mut run = Run::start(setup, config)?;
    let tilt = DQuat::from_rotation_z(std::f64::consts::FRAC_PI_2 - angle);
    let normal = tilt * DVec3::Y;
    // The face that the jet meets goes through the origin.
    let centre = normal * -0.25 * diameter;
    let plate = |t: f64| BodySample {
        orientation: tilt,
        velocity: DVec3::NEG_Y * plate_speed,
        ..BodySample::at(centre + DVec3::NEG_Y * plate_speed * t)
    };
    let force = run.record(duration, plate, |output| -output.loads[0].force().dot(normal));
    let steady = stats::last(&force, 0.25);
    let mean = stats::mean(steady);
    let expected = setup.number("density") * disc_area(diameter) * relative * relative * angle.sin();
    let ripple = stats::deviation(&stats::blocks(steady, run.steps_per_ms())) / mean;
    let plain = setup.number("angle_deg") == 90.0 && plate_speed == 0.0;
    Ok(run.report(vec![
        Measure::new("normal_force", "N", mean, expected).goal(if plain { 0.02 } else { 0.04 }),
        Measure::zero("ripple_1ms", "1", ripple, 1.0).goal(0.03),
    ]))
}
