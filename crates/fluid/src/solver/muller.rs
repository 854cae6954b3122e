//! The thesis's fluid, after Müller, Charypar & Gross 2003 (SCA 2003): the baseline.
//!
//! ```text
//! ρ_i = Σ m W_poly6          p = k (ρ − ρ₀ − forgiven), its part below zero times the cohesion
//! ρ_i a_i = −Σ m (p_i+p_j)/(2ρ_j) ∇W_spiky + μ Σ m (v_j−v_i)/ρ_j ∇²W_viscosity − σ ∇²c n/|n|
//! ```
//!
//! with the colour field c = Σ m/ρ W_poly6 and n = ∇c. Contacts with bodies and walls are impulses (see
//! `cpu.rs`). `forgiven` is the density that particles have too much of when interaction is switched on: it
//! fades away in a quarter of a second instead of bursting.

use super::{Pass, RowPass, Rows, sweep};
use crate::FluidConfig;
use crate::body::BodyLoad;
use crate::lanes::{add_scaled, difference, dot, fma, for_lanes, splat3, sum3};
use crate::particles::Particles;
use glam::Vec3;
use pulp::Simd;
use std::f64::consts::PI;

/// Time in which forgiven density fades, s.
const FORGIVE_TIME: f32 = 0.25;

/// Kinematic viscosity that the solver adds to the stated one, m²/s: 1.6 α c H/20.
///
/// One kernel for density and another for pressure do not conserve energy together: a tank at rest heats up
/// and boils over unless the viscosity is at least 0.15 c H/20 (measured at two spacings).
pub(crate) fn artificial_viscosity(config: &FluidConfig) -> f64 {
    let s = &config.settings;
    1.6 * s.artificial_viscosity * config.sound_speed() * s.support_length() / 20.0
}

/// Constants of one configuration.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Muller {
    support: f32,
    mass: f32,
    rest_density: f32,
    stiffness: f32,
    cohesion: f32,
    viscosity: f32,
    tension: f32,
    /// Kernel constants: poly6, spiky/viscosity slope, poly6 slope.
    poly6: f32,
    spiky: f32,
    poly6_slope: f32,
    /// |n| below which a particle lies inside, 1/m.
    inside: f32,
}

impl Muller {
    pub fn new(config: &FluidConfig) -> Self {
        let s = &config.settings;
        let h = s.support_length();
        Self {
            support: h as f32,
            mass: s.particle_mass() as f32,
            rest_density: s.rest_density as f32,
            stiffness: s.stiffness as f32,
            cohesion: s.cohesion as f32,
            viscosity: config.effective_viscosity() as f32,
            tension: s.surface_tension as f32,
            poly6: (315.0 / (64.0 * PI * h.powi(9))) as f32,
            spiky: (45.0 / (PI * h.powi(6))) as f32,
            poly6_slope: (945.0 / (32.0 * PI * h.powi(9))) as f32,
            inside: (0.5 / h) as f32,
        }
    }

    /// Rows of [density kg/m³, –, –, –].
    pub fn densities(&self, pass: Pass<'_>, rows: &mut Rows) {
        sweep(pass, Densities(self), rows);
    }

    /// Takes pressures from the densities; `forgive` when interaction has just been switched on.
    pub fn take_densities(&self, particles: &mut Particles, rows: &Rows, forgive: bool, dt: f32) {
        let fade = (-dt / FORGIVE_TIME).exp();
        for (i, row) in rows.iter().enumerate() {
            let excess = row[0] - self.rest_density;
            let forgiven = if forgive { excess.max(0.0) } else { particles.slow[i] * fade };
            particles.slow[i] = forgiven;
            let p = self.stiffness * (excess - forgiven);
            particles.p[i] = if p < 0.0 { self.cohesion * p } else { p };
            particles.aux[i] = 1.0 / row[0];
        }
    }

    /// Rows of [acceleration without gravity m/s², –].
    pub fn accelerations(&self, pass: Pass<'_>, rows: &mut Rows) {
        sweep(pass, Accelerations(self), rows);
    }
}

#[derive(Clone, Copy)]
struct Densities<'a>(&'a Muller);

impl RowPass for Densities<'_> {
    type Row = [f32; 4];

    #[inline(always)]
    fn row<S: Simd>(self, simd: S, pass: &Pass<'_>, i: usize, _: &mut [BodyLoad]) -> [f32; 4] {
        let (s, p) = (self.0, pass.particles);
        let (h2, zero) = (simd.splat_f32s(s.support * s.support), simd.splat_f32s(0.0));
        let xi = splat3(simd, p.position(i).to_array());
        let mut sum = zero;
        for range in pass.grid.neighbours(i) {
            for_lanes!(S, simd, range, [x: p.x, y: p.y, z: p.z], live, {
                let d = difference(simd, xi, [x, y, z]);
                let t = simd.mul_f32s(simd.max_f32s(simd.sub_f32s(h2, dot(simd, d, d)), zero), live);
                sum = fma(simd, simd.mul_f32s(t, t), t, sum);
            });
        }
        [simd.reduce_sum_f32s(sum) * s.poly6 * s.mass, 0.0, 0.0, 0.0]
    }
}

#[derive(Clone, Copy)]
struct Accelerations<'a>(&'a Muller);

impl RowPass for Accelerations<'_> {
    type Row = [f32; 4];

    #[inline(always)]
    fn row<S: Simd>(self, simd: S, pass: &Pass<'_>, i: usize, _: &mut [BodyLoad]) -> [f32; 4] {
        let s = self.0;
        let mut force = Vec3::from(pair_force(simd, s, pass, i)) * (s.mass * s.spiky);
        if s.tension > 0.0 {
            force += surface_tension(simd, s, pass, i);
        }
        let a = force * pass.particles.aux[i];
        [a.x, a.y, a.z, 0.0]
    }
}

#[inline(always)]
fn pair_force<S: Simd>(simd: S, s: &Muller, pass: &Pass<'_>, i: usize) -> [f32; 3] {
    let p = pass.particles;
    let xi = splat3(simd, p.position(i).to_array());
    let vi = splat3(simd, p.velocity(i).to_array());
    let pi = simd.splat_f32s(p.p[i]);
    let (h, zero) = (simd.splat_f32s(s.support), simd.splat_f32s(0.0));
    let (half, mu, tiny) =
        (simd.splat_f32s(-0.5), simd.splat_f32s(s.viscosity), simd.splat_f32s(1e-6 * s.support));
    let mut sum = [zero; 3];
    for range in pass.grid.neighbours(i) {
        for_lanes!(S, simd, range, [x: p.x, y: p.y, z: p.z, u: p.u, v: p.v, w: p.w, pj: p.p, inverse_density: p.aux], live, {
            let d = difference(simd, xi, [x, y, z]);
            let r = simd.sqrt_f32s(dot(simd, d, d));
            let t = simd.mul_f32s(simd.max_f32s(simd.sub_f32s(h, r), zero), live);
            let volume = simd.mul_f32s(t, inverse_density);
            let pressure = simd.mul_f32s(simd.mul_f32s(half, simd.add_f32s(pi, pj)), t);
            let along = simd.div_f32s(simd.mul_f32s(volume, pressure), simd.add_f32s(r, tiny));
            add_scaled(simd, &mut sum, along, d);
            add_scaled(simd, &mut sum, simd.mul_f32s(volume, mu), difference(simd, vi, [u, v, w]));
        });
    }
    sum3(simd, sum)
}

#[inline(always)]
fn surface_tension<S: Simd>(simd: S, s: &Muller, pass: &Pass<'_>, i: usize) -> Vec3 {
    let p = pass.particles;
    let xi = splat3(simd, p.position(i).to_array());
    let (h2, zero) = (simd.splat_f32s(s.support * s.support), simd.splat_f32s(0.0));
    let (three, seven) = (simd.splat_f32s(3.0), simd.splat_f32s(-7.0));
    let (mut normal, mut laplacian) = ([zero; 3], zero);
    for range in pass.grid.neighbours(i) {
        for_lanes!(S, simd, range, [x: p.x, y: p.y, z: p.z, inverse_density: p.aux], live, {
            let d = difference(simd, xi, [x, y, z]);
            let r2 = dot(simd, d, d);
            let t = simd.mul_f32s(simd.max_f32s(simd.sub_f32s(h2, r2), zero), live);
            let volume = simd.mul_f32s(t, inverse_density);
            add_scaled(simd, &mut normal, simd.mul_f32s(volume, t), d);
            let shape = fma(simd, seven, r2, simd.mul_f32s(three, h2));
            laplacian = fma(simd, volume, shape, laplacian);
        });
    }
    let scale = s.mass * s.poly6_slope;
    let normal = Vec3::from(sum3(simd, normal)) * scale;
    let curvature = simd.reduce_sum_f32s(laplacian) * scale;
    let length = normal.length();
    if length > s.inside { normal * (s.tension * curvature / length) } else { Vec3::ZERO }
}
