//! A jet in closed form: the second user of the backend trait, and an oracle without any scatter.
//!
//! A jet of diameter D and speed v₀ falls freely: v(s)² = v₀² + 2 g s along its axis and A v = A₀ v₀. A tool that
//! it strikes takes F = ρ A' (v−u)² along the axis, where A' is the part of the jet's section that the tool's
//! shadow covers and u the tool's velocity along the axis; a tool that outruns the jet takes nothing. All water
//! is taken to leave at right angles (a plate; a sphere deflects less).

use crate::backend::{FluidBackend, FluidError, FrameInput, FrameOutput, ParticleView};
use crate::body::{Body, BodyLoad, Medium};
use crate::{FluidConfig, Source, Surroundings};
use glam::DVec3;
use std::f64::consts::PI;

/// Force (N) of `source`'s jet of density `density` on a tool of `radius` at `position` with `velocity`.
pub fn jet_force(
    source: &Source,
    density: f64,
    gravity: DVec3,
    radius: f64,
    position: DVec3,
    velocity: DVec3,
) -> DVec3 {
    let axis = source.direction.normalize_or(DVec3::NEG_Y);
    let from_outlet = position - source.position;
    let along = from_outlet.dot(axis);
    if along <= 0.0 || source.flow() <= 0.0 {
        return DVec3::ZERO;
    }
    let speed = (source.speed * source.speed + 2.0 * gravity.dot(axis) * along).max(0.0).sqrt();
    if speed <= 0.0 {
        return DVec3::ZERO;
    }
    let jet_radius = (source.flow() / speed / PI).sqrt();
    let offset = (from_outlet - along * axis).length();
    let relative = (speed - velocity.dot(axis)).max(0.0);
    axis * (density * covered(jet_radius, radius, offset) * relative * relative)
}

/// Puts `source`'s jet into `out`, its rim as wide as the nodes are apart.
fn pour(source: &Source, gravity: DVec3, out: &mut Surroundings) {
    let axis = source.direction.normalize_or(DVec3::NEG_Y);
    for k in 0..out.nodes().len() {
        let from_outlet = out.place(k) - source.position;
        let along = from_outlet.dot(axis);
        let speed = (source.speed * source.speed + 2.0 * gravity.dot(axis) * along).max(0.0).sqrt();
        if along > 0.0 && speed > 0.0 {
            let offset = (from_outlet - along * axis).length();
            let fill = ((source.flow() / speed / PI).sqrt() - offset) / out.spacing + 0.5;
            if fill > 0.0 {
                out.set(k, fill.min(1.0), axis * speed);
            }
        }
    }
}

/// Area (m²) of a disc of radius `a` that one of radius `b` covers at distance `d` between centres.
fn covered(a: f64, b: f64, d: f64) -> f64 {
    if d >= a + b {
        return 0.0;
    }
    if d <= (a - b).abs() {
        return PI * a.min(b).powi(2);
    }
    let angle =
        |r: f64, other: f64| ((d * d + r * r - other * other) / (2.0 * d * r)).clamp(-1.0, 1.0).acos();
    let segment = |r: f64, half: f64| r * r * (half - half.sin() * half.cos());
    segment(a, angle(a, b)) + segment(b, angle(b, a))
}

/// The backend: jets of the scene's sources, no particles.
#[derive(Debug)]
pub struct AnalyticJet {
    config: FluidConfig,
    bodies: Vec<Body>,
    time: f64,
    output: FrameOutput,
    ready: bool,
}

impl AnalyticJet {
    /// Points in a frame at which the field is evaluated.
    const SAMPLES: usize = 32;

    /// The jets of `config`.
    ///
    /// # Errors
    /// What [`FluidConfig::check`] refuses, and pools, which it cannot hold.
    pub fn new(config: &FluidConfig) -> Result<Self, FluidError> {
        Self::refuse(config)?;
        let bodies = config.world.bodies.iter().cloned().map(Body::new).collect();
        Ok(Self { config: config.clone(), bodies, time: 0.0, output: FrameOutput::default(), ready: false })
    }

    fn refuse(config: &FluidConfig) -> Result<(), FluidError> {
        config.check()?;
        if config.world.pools.is_empty() {
            return Ok(());
        }
        Err(FluidError::Unsupported { backend: "analytic-jet", what: "pools of fluid (only sources)".into() })
    }

    fn load(&self, body: &Body) -> BodyLoad {
        let s = &self.config.settings;
        let running = self.config.world.sources.iter().filter(|source| source.runs_at(self.time));
        let (x, v) = (body.state.position, body.state.velocity);
        let radius = body.config.shape.bounding_radius();
        let force = running.map(|source| jet_force(source, s.rest_density, s.gravity, radius, x, v)).sum();
        let two_way = if s.two_way { 1.0 } else { 0.0 };
        BodyLoad { pressure_force: force, ..BodyLoad::default() } * two_way
    }
}

impl std::ops::Mul<f64> for BodyLoad {
    type Output = Self;
    fn mul(self, scale: f64) -> Self {
        let mut out = Self::default();
        out.add_scaled(&self, scale);
        out
    }
}

impl FluidBackend for AnalyticJet {
    fn name(&self) -> &'static str {
        "analytic-jet"
    }

    fn configure(&mut self, config: &FluidConfig) -> Result<(), FluidError> {
        Self::refuse(config)?;
        self.config = config.clone();
        for (body, config) in self.bodies.iter_mut().zip(&config.world.bodies) {
            body.config = config.clone();
        }
        Ok(())
    }

    fn submit(&mut self, frame: &FrameInput<'_>) {
        let dt = frame.duration / Self::SAMPLES as f64;
        // A jet in closed form has no mass that a body would carry along.
        let medium = Medium { density: 0.0, gravity: self.config.settings.gravity, prompt: false };
        let mut loads = vec![BodyLoad::default(); self.bodies.len()];
        for (body, motion) in self.bodies.iter_mut().zip(frame.bodies) {
            body.begin_frame(motion, frame.duration);
        }
        for k in 0..Self::SAMPLES {
            self.time += dt;
            let share = (k + 1) as f64 / Self::SAMPLES as f64;
            for (b, motion) in frame.bodies.iter().enumerate().take(self.bodies.len()) {
                self.bodies[b].advance(motion, share, dt);
                let load = self.load(&self.bodies[b]);
                self.bodies[b].push(&load, &medium, dt);
                loads[b].add_scaled(&load, 1.0 / Self::SAMPLES as f64);
            }
        }
        for (body, motion) in self.bodies.iter_mut().zip(frame.bodies) {
            body.end_frame(motion);
        }
        self.output = FrameOutput {
            time: self.time,
            loads,
            bodies: self.bodies.iter().map(|b| b.state).collect(),
            substeps: Self::SAMPLES,
            ..FrameOutput::default()
        };
        self.ready = true;
    }

    fn poll(&mut self) -> Option<&FrameOutput> {
        std::mem::take(&mut self.ready).then_some(&self.output)
    }

    fn snapshot(&mut self, view: &mut ParticleView) {
        *view = ParticleView::default();
    }

    fn surroundings(&mut self, around: DVec3, reach: f64, out: &mut Surroundings) {
        out.lay(around, reach);
        let running = self.config.world.sources.iter().filter(|source| source.runs_at(self.time));
        for source in running {
            pour(source, self.config.settings.gravity, out);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn jet() -> Source {
        Source {
            name: "jet".into(),
            position: DVec3::new(0.0, 0.2, 0.0),
            direction: DVec3::NEG_Y,
            diameter: 0.02,
            speed: 1.0,
            on: true,
            period: 0.0,
            duty: 1.0,
        }
    }

    #[test]
    fn a_wide_plate_takes_rho_a_v_squared() {
        let f = jet_force(&jet(), 1000.0, DVec3::ZERO, 0.1, DVec3::ZERO, DVec3::ZERO);
        assert!((f.y + 1000.0 * PI * 0.01 * 0.01).abs() < 1e-9 && f.x == 0.0);
        // Falling 0.2 m: v² = 1 + 2·9.81·0.2, A v = A₀ v₀, so F = ρ A₀ v₀ v.
        let f = jet_force(&jet(), 1000.0, DVec3::NEG_Y * 9.81, 0.1, DVec3::ZERO, DVec3::ZERO);
        assert!((f.y + 1000.0 * PI * 1e-4 * (1.0 + 2.0 * 9.81 * 0.2_f64).sqrt()).abs() < 1e-9);
    }

    #[test]
    fn a_receding_plate_takes_less_and_a_faster_one_nothing() {
        let at = |u: f64| jet_force(&jet(), 1000.0, DVec3::ZERO, 0.1, DVec3::ZERO, DVec3::Y * u).y;
        assert!((at(-0.5) / at(0.0) - 0.25).abs() < 1e-12);
        assert!((at(0.5) / at(0.0) - 2.25).abs() < 1e-12);
        assert_eq!(at(-2.0), 0.0);
    }

    #[test]
    fn overlap_is_a_lens() {
        assert!((covered(1.0, 3.0, 0.5) - PI).abs() < 1e-12);
        assert!((covered(3.0, 1.0, 0.5) - PI).abs() < 1e-12);
        assert_eq!(covered(1.0, 1.0, 2.5), 0.0);
        // Two unit discs one radius apart: 2π/3 − √3/2.
        assert!((covered(1.0, 1.0, 1.0) - (2.0 * PI / 3.0 - 0.75_f64.sqrt())).abs() < 1e-12);
    }
}
