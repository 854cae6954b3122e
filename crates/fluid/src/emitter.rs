//! Jets: layers of particles that carry exactly the stated flow.

use crate::Source;
use crate::particles::Newborn;
use glam::{DVec3, Vec3};
use std::f64::consts::{PI, TAU};

/// Angle between neighbouring points of a sunflower, and between layers: no layer repeats another.
const GOLDEN_ANGLE: f64 = PI * (3.0 - 2.236_067_977_499_79);

/// Length over which the source still leads its particles, in spacings.
const INLET_SPACINGS: f64 = 2.0;

/// State of one source.
#[derive(Clone, Debug, Default)]
pub(crate) struct Emitter {
    /// Volume owed, m³.
    owed: f64,
    layers: u64,
}

impl Emitter {
    /// Emits what `source` owes after `dt` seconds ending at time `t`, into `out`; at most `room` particles.
    /// The volume of a layer's particles is exactly the flow over the layer's time.
    pub fn emit(
        &mut self,
        source: &Source,
        spacing: f64,
        t: f64,
        dt: f64,
        room: usize,
        out: &mut Vec<Newborn>,
    ) {
        if !source.runs_at(t) || source.flow() <= 0.0 {
            return;
        }
        let area = source.flow() / source.speed;
        let points = (area / (spacing * spacing)).round().max(1.0);
        let layer = points * spacing.powi(3);
        self.owed += source.flow() * dt;
        while self.owed >= layer && points as usize <= room.saturating_sub(out.len()) {
            self.owed -= layer;
            // The layer left the outlet a while ago: it has travelled since.
            self.emit_layer(source, spacing, points as usize, self.owed / area, out);
        }
        self.owed = self.owed.min(layer);
    }

    fn emit_layer(
        &mut self,
        source: &Source,
        spacing: f64,
        points: usize,
        travelled: f64,
        out: &mut Vec<Newborn>,
    ) {
        let axis = source.direction.normalize_or(DVec3::NEG_Y);
        let (across, along) = axis.any_orthonormal_pair();
        let turn = (self.layers as f64 * GOLDEN_ANGLE) % TAU;
        self.layers += 1;
        for k in 0..points {
            let r = 0.5 * source.diameter * ((k as f64 + 0.5) / points as f64).sqrt();
            let angle = turn + k as f64 * GOLDEN_ANGLE;
            let offset = (across * angle.cos() + along * angle.sin()) * r;
            let position: Vec3 = (source.position + axis * travelled + offset).as_vec3();
            let held = (INLET_SPACINGS * spacing - travelled).max(0.0) / source.speed;
            let velocity = (axis * source.speed).as_vec3();
            out.push(Newborn { position, velocity, held: held as f32, ..Newborn::default() });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn source(diameter: f64, speed: f64) -> Source {
        Source {
            name: "jet".into(),
            position: DVec3::new(0.0, 0.1, 0.0),
            direction: DVec3::NEG_Y,
            diameter,
            speed,
            on: true,
            period: 0.0,
            duty: 1.0,
        }
    }

    #[test]
    fn the_flux_is_the_stated_one() {
        for (diameter, speed, spacing, dt) in
            [(0.02, 1.5, 0.005, 2e-4), (0.02, 0.7, 0.003, 1e-3), (0.013, 3.0, 0.004, 7e-3)]
        {
            let (s, mut e, mut out) = (source(diameter, speed), Emitter::default(), Vec::new());
            let steps = (2.0 / dt) as usize;
            for k in 0..steps {
                e.emit(&s, spacing, k as f64 * dt, dt, usize::MAX, &mut out);
            }
            let volume = out.len() as f64 * spacing.powi(3);
            let expected = PI / 4.0 * diameter * diameter * speed * steps as f64 * dt;
            // Never off by more than the layer that is still owed.
            let layer = (PI / 4.0 * (diameter / spacing).powi(2)).round() * spacing.powi(3);
            assert!((volume - expected).abs() <= layer * 1.001, "{volume} {expected}");
            let radius = |b: &Newborn| b.position.x.hypot(b.position.z) as f64;
            assert!(out.iter().all(|b| radius(b) < 0.5 * diameter));
        }
    }

    #[test]
    fn an_intermittent_source_runs_its_duty() {
        let s = Source { period: 0.2, duty: 0.25, ..source(0.02, 1.0) };
        let (mut e, mut out) = (Emitter::default(), Vec::new());
        for k in 0..20_000 {
            e.emit(&s, 0.004, k as f64 * 1e-4, 1e-4, usize::MAX, &mut out);
        }
        let volume = out.len() as f64 * 0.004_f64.powi(3);
        assert!((volume / (s.flow() * 2.0 * 0.25) - 1.0).abs() < 0.02);
    }

    #[test]
    fn a_full_fluid_gets_no_more_and_no_burst_later() {
        let (s, mut e, mut out) = (source(0.02, 1.0), Emitter::default(), Vec::new());
        for k in 0..1000 {
            e.emit(&s, 0.005, f64::from(k) * 1e-3, 1e-3, 100, &mut out);
        }
        assert!(out.len() <= 100);
        let before = out.len();
        e.emit(&s, 0.005, 1.0, 1e-3, usize::MAX, &mut out);
        assert!(out.len() - before <= 26, "{}", out.len() - before);
    }
}
