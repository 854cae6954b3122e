//! A jet that falls grows faster and thinner.

use crate::case::{Case, Parameter};
use crate::reference::falling_speed;
use crate::run::{Report, Run, vectors};
use crate::{Measure, Setup, ValidationError, stats, worlds};
use glam::DVec3;
use hapflow_fluid::{Aabb, ParticleView};

/// Times that the jet needs from the outlet to where it is measured.
const PASSAGES: f64 = 12.0;

pub(super) const CASE: Case = Case {
    name: "jet-fall",
    about: "a round jet in free fall: its speed, and its radius",
    source: "Bernoulli at constant pressure: v² = v₀² + 2 g z; continuity: r² v = r₀² v₀",
    parameters: &[
        Parameter::number("diameter", "m", "0.02", [0.002, 0.2], "Diameter of the outlet."),
        Parameter::number("speed", "m/s", "1", [0.1, 10.0], "Speed at the outlet."),
        Parameter::number("drop", "m", "0.1", [0.01, 2.0], "Height of the fall."),
    ],
    length: "diameter",
    cells: [6.0, 8.0, 10.0],
    variants: &[],
    run,
};

fn run(setup: &Setup<'_>) -> Result<Report, ValidationError> {
    let (diameter, speed, drop) = (setup.number("diameter"), setup.number("speed"), setup.number("drop"));
    let low = DVec3::new(-4.0 * diameter, -drop - 2.0 * diameter, -4.0 * diameter);
    let mut world = worlds::empty(Aabb { min: low, max: DVec3::splat(4.0 * diameter) });
    world.sources = vec![worlds::jet(0.0, diameter, speed)];
    let mut run = Run::start(setup, setup.config(world))?;
    let duration = PASSAGES * drop / speed;
    let (mut speeds, mut radii) = (Vec::new(), Vec::new());
    while run.time() < duration {
        for _ in 0..run.steps_per_ms() {
            run.step(None);
        }
        if run.time() > 0.75 * duration {
            let time = run.time();
            let [v, r] = section(run.particles(), drop, setup.dx);
            speeds.push([time, v]);
            radii.push([time, r]);
        }
    }
    let expected = falling_speed(speed, drop);
    let radius = 0.5 * diameter * (speed / expected).sqrt();
    Ok(run.report(vec![
        Measure::new("speed", "m/s", stats::mean(&speeds), expected).goal(0.03),
        Measure::new("radius", "m", stats::mean(&radii), radius).goal(0.03),
    ]))
}

/// Speed of the jet, and its radius, within a spacing of `drop` below the outlet. Of an even disc the mean of r² is
/// half of the radius squared.
fn section(view: &ParticleView, drop: f64, dx: f64) -> [f64; 2] {
    let rows = vectors(&view.positions).zip(vectors(&view.velocities));
    let here: Vec<_> = rows.filter(|(x, _)| (x.y + drop).abs() < dx).collect();
    let mean = |f: fn(&(DVec3, DVec3)) -> f64| here.iter().map(f).sum::<f64>() / here.len() as f64;
    [mean(|(_, v)| -v.y), (2.0 * mean(|(x, _)| x.x * x.x + x.z * x.z)).sqrt()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_section_of_an_even_disc_has_its_radius_and_speed() {
        let n = 4000;
        let place = |k: i32| {
            let (r, a) = (0.01 * ((f64::from(k) + 0.5) / f64::from(n)).sqrt(), 2.399_963 * f64::from(k));
            [(r * a.cos()) as f32, -0.1, (r * a.sin()) as f32]
        };
        let view = ParticleView {
            positions: (0..n).map(place).collect(),
            velocities: vec![[0.0, -1.5, 0.0]; n as usize],
            ..ParticleView::default()
        };
        let [v, r] = section(&view, 0.1, 1e-3);
        assert!((v - 1.5).abs() < 1e-6 && (r / 0.01 - 1.0).abs() < 1e-3, "{v} {r}");
    }
}
