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

use super::{Pass, Record, RowPass, Rows, Scratch, sweep};
use crate::FluidConfig;
use crate::body::BodyLoad;
use crate::lanes::{add_scaled, difference, dot, fma};
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
    pub fn densities(&self, pass: Pass<'_>, scratch: &mut Scratch, rows: &mut Rows) {
        sweep(pass, Densities(self), rows, scratch, &mut []);
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
    pub fn accelerations(&self, pass: Pass<'_>, scratch: &mut Scratch, rows: &mut Rows) {
        sweep(pass, Accelerations(self), rows, scratch, &mut []);
    }

    /// Force of the surface by the sums of its normal and curvature.
    fn surface_tension(&self, normal: Vec3, curvature: f32) -> Vec3 {
        let scale = self.mass * self.poly6_slope;
        let length = normal.length() * scale;
        if length > self.inside {
            normal * (self.tension * curvature * scale * scale / length)
        } else {
            Vec3::ZERO
        }
    }
}

#[derive(Clone, Copy)]
struct Densities<'a>(&'a Muller);

impl RowPass<3, 1> for Densities<'_> {
    type Row = [f32; 4];

    fn record(self, p: &Particles, i: usize) -> Record {
        [p.x[i], p.y[i], p.z[i], 0.0, 0.0, 0.0, 0.0, 0.0]
    }

    #[inline(always)]
    fn pair<S: Simd>(self, simd: S, i: &[S::f32s; 3], j: &[S::f32s; 3], [sum]: &mut [S::f32s; 1]) {
        let d = difference(simd, *i, *j);
        let h2 = simd.splat_f32s(self.0.support * self.0.support);
        let t = simd.max_f32s(simd.sub_f32s(h2, dot(simd, d, d)), simd.splat_f32s(0.0));
        *sum = fma(simd, simd.mul_f32s(t, t), t, *sum);
    }

    fn row(self, _: &Pass<'_>, _: usize, [sum]: [f32; 1], _: &mut [BodyLoad]) -> [f32; 4] {
        [sum * self.0.poly6 * self.0.mass, 0.0, 0.0, 0.0]
    }
}

#[derive(Clone, Copy)]
struct Accelerations<'a>(&'a Muller);

impl RowPass<8, 7> for Accelerations<'_> {
    type Row = [f32; 4];

    fn record(self, p: &Particles, i: usize) -> Record {
        [p.x[i], p.y[i], p.z[i], p.u[i], p.v[i], p.w[i], p.p[i], p.aux[i]]
    }

    /// Force by pressure and viscosity, and, where there is surface tension, normal and curvature of the colour field.
    #[inline(always)]
    fn pair<S: Simd>(self, simd: S, i: &[S::f32s; 8], j: &[S::f32s; 8], sums: &mut [S::f32s; 7]) {
        let s = self.0;
        let (zero, half) = (simd.splat_f32s(0.0), simd.splat_f32s(-0.5));
        let [fx, fy, fz, nx, ny, nz, curvature] = sums;
        let d = difference(simd, [i[0], i[1], i[2]], [j[0], j[1], j[2]]);
        let r2 = dot(simd, d, d);
        let r = simd.sqrt_f32s(r2);
        let t = simd.max_f32s(simd.sub_f32s(simd.splat_f32s(s.support), r), zero);
        let volume = simd.mul_f32s(t, j[7]);
        let pressure = simd.mul_f32s(simd.mul_f32s(half, simd.add_f32s(i[6], j[6])), t);
        let apart = simd.add_f32s(r, simd.splat_f32s(1e-6 * s.support));
        let along = simd.div_f32s(simd.mul_f32s(volume, pressure), apart);
        let mut force = [*fx, *fy, *fz];
        add_scaled(simd, &mut force, along, d);
        let dv = difference(simd, [i[3], i[4], i[5]], [j[3], j[4], j[5]]);
        add_scaled(simd, &mut force, simd.mul_f32s(volume, simd.splat_f32s(s.viscosity)), dv);
        [*fx, *fy, *fz] = force;
        if s.tension > 0.0 {
            let h2 = simd.splat_f32s(s.support * s.support);
            let volume = simd.mul_f32s(simd.max_f32s(simd.sub_f32s(h2, r2), zero), j[7]);
            let mut normal = [*nx, *ny, *nz];
            add_scaled(
                simd,
                &mut normal,
                simd.mul_f32s(volume, simd.max_f32s(simd.sub_f32s(h2, r2), zero)),
                d,
            );
            [*nx, *ny, *nz] = normal;
            let shape = fma(simd, simd.splat_f32s(-7.0), r2, simd.mul_f32s(simd.splat_f32s(3.0), h2));
            *curvature = fma(simd, volume, shape, *curvature);
        }
    }

    fn row(self, pass: &Pass<'_>, i: usize, sums: [f32; 7], _: &mut [BodyLoad]) -> [f32; 4] {
        let s = self.0;
        let [fx, fy, fz, nx, ny, nz, curvature] = sums;
        let tension = s.surface_tension(Vec3::new(nx, ny, nz), curvature);
        let a = (Vec3::new(fx, fy, fz) * (s.mass * s.spiky) + tension) * pass.particles.aux[i];
        [a.x, a.y, a.z, 0.0]
    }
}
