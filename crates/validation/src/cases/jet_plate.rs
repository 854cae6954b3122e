//! A jet pushes a wide plate by the momentum that it brings across it.

use crate::case::{Case, Parameter};
use crate::reference::disc_area;
use crate::run::{Report, Run};
use crate::{Measure, Setup, ValidationError, stats, worlds};
use glam::{DQuat, DVec3};
use hapflow_fluid::{Aabb, BodySample, Shape, World};

/// Distance of the outlet from a plate at rest, and radius of the plate, in diameters of the jet.
const DISTANCE: f64 = 2.0;
const PLATE: f64 = 3.0;
/// Times that the water needs from the outlet to the plate's rim.
const PASSAGES: f64 = 32.0;

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

/// The jet and the plate.
struct Scene {
    diameter: f64,
    speed: f64,
    plate_speed: f64,
    /// From level to the plate's own tilt.
    tilt: DQuat,
    /// Simulated time, s.
    duration: f64,
}

fn run(setup: &Setup<'_>) -> Result<Report, ValidationError> {
    let scene = Scene::new(setup)?;
    let mut config = setup.config(scene.world());
    config.settings.gravity = DVec3::ZERO;
    let mut run = Run::start(setup, config)?;
    let normal = scene.tilt * DVec3::Y;
    let force = run.record(scene.duration, |t| scene.plate(t), |out| -out.loads[0].force().dot(normal));
    let steady = stats::last(&force, 0.25);
    let mean = stats::mean(steady);
    let ripple = stats::deviation(&stats::blocks(steady, run.steps_per_ms())) / mean;
    let plain = setup.number("angle_deg") == 90.0 && scene.plate_speed == 0.0;
    let relative = scene.speed - scene.plate_speed;
    let expected = setup.number("density") * disc_area(scene.diameter) * relative * relative * normal.y;
    Ok(run.report(vec![
        Measure::new("normal_force", "N", mean, expected).goal(if plain { 0.02 } else { 0.04 }),
        Measure::zero("ripple_1ms", "1", ripple, 1.0).goal(0.03),
    ]))
}

impl Scene {
    fn new(setup: &Setup<'_>) -> Result<Self, ValidationError> {
        let (diameter, speed) = (setup.number("diameter"), setup.number("speed"));
        let (plate_speed, fastest) = (setup.number("plate_speed"), 0.8 * speed);
        if plate_speed > fastest {
            let expected = format!("at most {fastest:.4} m/s, 0.8 of the jet's speed");
            let value = plate_speed.to_string();
            return Err(ValidationError::BadValue { case: CASE.name, name: "plate_speed", value, expected });
        }
        let tilt = DQuat::from_rotation_z((90.0 - setup.number("angle_deg")).to_radians());
        let duration = PASSAGES * (DISTANCE + PLATE) * diameter / (speed - plate_speed);
        Ok(Self { diameter, speed, plate_speed, tilt, duration })
    }

    /// A jet from above on the plate's face, and room for both until the end.
    fn world(&self) -> World {
        // An approaching plate starts farther off and ends at the distance; a receding one starts there.
        let travel = self.plate_speed * self.duration;
        let outlet = DISTANCE * self.diameter + (-travel).max(0.0);
        let (radius, reach) = (PLATE * self.diameter, DVec3::splat(2.0 * PLATE * self.diameter));
        let (lowest, highest) = ((-travel).min(0.0), outlet.max(-travel));
        let mut world =
            worlds::empty(Aabb { min: DVec3::Y * lowest - reach, max: DVec3::Y * highest + reach });
        world.sources = vec![worlds::jet(outlet, self.diameter, self.speed)];
        let plate = Shape::Disc { radius, thickness: 0.5 * self.diameter };
        world.bodies = vec![worlds::body(plate, self.plate(0.0).position)];
        world
    }

    /// The plate at time `t` (s). The face that the jet meets goes through the origin at first.
    fn plate(&self, t: f64) -> BodySample {
        let velocity = DVec3::NEG_Y * self.plate_speed;
        let centre = self.tilt * DVec3::NEG_Y * 0.25 * self.diameter + velocity * t;
        BodySample { orientation: self.tilt, velocity, ..BodySample::at(centre) }
    }
}
