//! Weakly compressible SPH with density diffusion (δ-SPH), staggered in time.
//!
//! State is the pressure over rest density P = p/ρ₀ (m²/s²). With V the volume of a particle, f = C (1−r/H)³ V
//! the Wendland gradient over r, d = x_j − x_i:
//!
//! ```text
//! dP_i/dt = −c² Σ f (v_j−v_i)·d + δ (H/2) c Σ 2 f (P_j − P_i − g·d) + q_i           at x(t+dt), v(t+dt)
//! a_i     = −Σ f (P̂_i + P̂_j) d + 10 ν Σ f ((v_j−v_i)·d)/(r²+η²) d + walls + g      P̂ = max(0, P + P₀ − ζ c dx div)
//! ```
//!
//! Sources: Molteni & Colagrossi 2009 (doi:10.1016/j.cpc.2008.12.004) for the diffusion; Fourtakas et al. 2019
//! (doi:10.1016/j.compfluid.2019.06.009) for leaving the hydrostatic part out of it; Monaghan 2005
//! (doi:10.1088/0034-4885/68/8/R01) for the viscous term. q_i leads P slowly to the pressure of the summed
//! density, because an integrated density forgets how many particles there are. Walls: see `wall.rs`.
//! Pressure never pulls: a free surface has P = 0.

use super::{Pass, RowPass, Rows, sweep, sweep_with_loads};
use crate::body::BodyLoad;
use crate::lanes::{add_scaled, difference, dot, fma, for_lanes, splat3, sum3};
use crate::particles::Particles;
use crate::solids::Meeting;
use crate::{FluidConfig, kernel};
use glam::Vec3;
use pulp::Simd;

/// Sub-steps between two looks at the summed density.
pub(crate) const PACKING_INTERVAL: u64 = 10;
/// Time in which the pressure follows the summed density, s.
const PACKING_TIME: f32 = 0.1;
/// Largest density error that packing acts on at once.
const PACKING_CLIP: f32 = 0.02;
/// Below this share of full neighbourhood a particle lies at a free surface and packing leaves it alone.
const FREE_SURFACE: f32 = 0.95;

/// Kinematic viscosity that the solver adds to the stated one between particles, m²/s: α c H/20 (Monaghan 2005).
pub(crate) fn artificial_viscosity(config: &FluidConfig) -> f64 {
    let s = &config.settings;
    s.artificial_viscosity * config.sound_speed() * s.support_length() / 20.0
}

/// Below this share a particle is spray: a drop or a sheet one particle thick.
const SPRAY: f32 = 0.75;
/// Time in which spray forgets its pressure, s.
const SPRAY_TIME: f32 = 0.003;

/// Constants of one configuration.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Wcsph {
    support: f32,
    inverse_support: f32,
    /// C V: scale of f.
    scale: f32,
    /// Scale of the summed kernel.
    sum_scale: f32,
    mass: f32,
    sound: f32,
    diffusion: f32,
    damper: f32,
    viscosity: f32,
    wall_viscosity: f32,
    /// Distance below which the slope of the velocity at a wall is no longer looked for, m.
    least_distance: f32,
    /// Pressure over rest density that all is under, m²/s².
    background: f32,
    eta2: f32,
    gravity: Vec3,
    two_way: bool,
}

impl Wcsph {
    pub fn new(config: &FluidConfig) -> Self {
        let s = &config.settings;
        let (dx, h, c) = (s.spacing, s.support_length(), config.sound_speed());
        let volume = dx.powi(3) / kernel::wendland_lattice_moment(dx, h);
        let artificial = artificial_viscosity(config);
        Self {
            support: h as f32,
            inverse_support: (1.0 / h) as f32,
            scale: (kernel::wendland_gradient_scale(h) * volume) as f32,
            sum_scale: (kernel::wendland(0.0, h) * dx.powi(3) / kernel::wendland_lattice_sum(dx, h)) as f32,
            mass: s.particle_mass() as f32,
            sound: c as f32,
            diffusion: (s.density_diffusion * 0.5 * h * c) as f32,
            damper: (s.acoustic_damping * c * dx) as f32,
            viscosity: (s.kinematic_viscosity() + artificial) as f32,
            wall_viscosity: s.kinematic_viscosity() as f32,
            least_distance: (0.25 * dx) as f32,
            background: (s.background_pressure / s.rest_density) as f32,
            eta2: (0.0025 * h * h) as f32,
            gravity: s.gravity.as_vec3(),
            two_way: s.two_way,
        }
    }

    /// Rows of [divergence 1/s, diffusion m²/s³, –, –].
    pub fn rates(&self, pass: Pass<'_>, rows: &mut Rows) {
        sweep(pass, Rates(self), rows);
    }

    /// Rows of [summed density over ρ₀, –, –, –].
    pub fn packing(&self, pass: Pass<'_>, rows: &mut Rows) {
        sweep(pass, Packing(self), rows);
    }

    /// Rows of [acceleration without gravity m/s², –]; adds the bodies' loads.
    pub fn accelerations(
        &self,
        pass: Pass<'_>,
        rows: &mut Rows,
        partial: &mut Vec<BodyLoad>,
        loads: &mut [BodyLoad],
    ) {
        sweep_with_loads(pass, Accelerations(self), rows, partial, loads);
    }

    /// Sets the packing feedback from the summed densities.
    pub fn take_packing(&self, particles: &mut Particles, rows: &Rows) {
        let c2 = self.sound * self.sound;
        for (i, row) in rows.iter().enumerate() {
            particles.fill[i] = row[0];
            let error = (row[0] - 1.0 - particles.p[i] / c2).clamp(-PACKING_CLIP, PACKING_CLIP);
            particles.slow[i] = match row[0] {
                fill if fill < SPRAY => -particles.p[i] / SPRAY_TIME,
                fill if fill < FREE_SURFACE => 0.0,
                _ => c2 / PACKING_TIME * error,
            };
        }
    }

    /// Takes the pressure over `dt` and the pressure that acts from the rates.
    pub fn take_rates(&self, particles: &mut Particles, rows: &Rows, dt: f32) {
        let c2 = self.sound * self.sound;
        for (i, &[divergence, diffusion, ..]) in rows.iter().enumerate() {
            let rate = diffusion + particles.slow[i] - c2 * divergence;
            // Spray that has been squeezed lets go at once: a drop splashes on a wall and does not bounce.
            let lets_go = particles.fill[i] < SPRAY && divergence > 0.0;
            let free = lets_go || particles.held[i] > 0.0;
            let p = if free { 0.0 } else { (particles.p[i] + dt * rate).max(-self.background) };
            particles.p[i] = p;
            particles.aux[i] = (p - self.damper * divergence + self.background).max(0.0);
        }
    }

    /// What a wall does to the divergence.
    fn wall_divergence(&self, pass: &Pass<'_>, meeting: &Meeting, velocity: Vec3) -> f32 {
        let approach = (meeting.contact.velocity - velocity).dot(meeting.contact.normal);
        approach * pass.solids.terms(meeting).gradient
    }

    /// Acceleration by a wall: [pressure, friction].
    fn wall_acceleration(&self, pass: &Pass<'_>, meeting: &Meeting, velocity: Vec3, p: f32) -> [Vec3; 2] {
        let terms = pass.solids.terms(meeting);
        let n = meeting.contact.normal;
        // Wall pressure = the particle's, extrapolated with gravity as the moving wall feels it. Where the
        // fluid bears no pressure there is none to extrapolate, and a wall must not hold a droplet up.
        let field = self.gravity - meeting.acceleration;
        let bearing = (2.0 * p / (field.length() * self.support).max(1e-9)).min(1.0);
        let along = field.dot(n) * n;
        let moment = terms.normal_moment * along + terms.tangent_moment * (field - along);
        let push = -2.0 * p * terms.gradient * n - bearing * moment;
        // A wall pushes and never pulls.
        let push = push - push.dot(n).min(0.0) * n;
        let slip = meeting.contact.velocity - velocity;
        let slip = slip - slip.dot(n) * n;
        let slope = slip / meeting.contact.distance.max(self.least_distance);
        [push, self.wall_viscosity * terms.friction * slope]
    }
}

#[derive(Clone, Copy)]
struct Rates<'a>(&'a Wcsph);

impl RowPass for Rates<'_> {
    #[inline(always)]
    fn row<S: Simd>(self, simd: S, pass: &Pass<'_>, i: usize, _: &mut [BodyLoad]) -> [f32; 4] {
        let (s, p) = (self.0, pass.particles);
        let (xi, vi) = (p.position(i), p.velocity(i));
        let [divergence, diffusion] = pair_rates(simd, s, pass, i);
        let mut total = divergence * s.scale;
        pass.solids.visit(xi, s.support, |m| total += s.wall_divergence(pass, &m, vi));
        [total, diffusion * 2.0 * s.scale * s.diffusion, 0.0, 0.0]
    }
}

#[inline(always)]
fn pair_rates<S: Simd>(simd: S, s: &Wcsph, pass: &Pass<'_>, i: usize) -> [f32; 2] {
    let p = pass.particles;
    let xi = splat3(simd, p.position(i).to_array());
    let vi = splat3(simd, p.velocity(i).to_array());
    let pi = simd.splat_f32s(p.p[i]);
    let gravity = splat3(simd, s.gravity.to_array());
    let (ih, one, zero) = (simd.splat_f32s(s.inverse_support), simd.splat_f32s(1.0), simd.splat_f32s(0.0));
    let (mut divergence, mut diffusion) = (zero, zero);
    for range in pass.grid.neighbours(i) {
        for_lanes!(S, simd, range, [x: p.x, y: p.y, z: p.z, u: p.u, v: p.v, w: p.w, pj: p.p], live, {
            let d = difference(simd, xi, [x, y, z]);
            let q = simd.mul_f32s(simd.sqrt_f32s(dot(simd, d, d)), ih);
            let t = simd.mul_f32s(simd.max_f32s(simd.sub_f32s(one, q), zero), live);
            let f = simd.mul_f32s(simd.mul_f32s(t, t), t);
            let dv = difference(simd, vi, [u, v, w]);
            divergence = fma(simd, f, dot(simd, dv, d), divergence);
            let dp = simd.sub_f32s(simd.sub_f32s(pj, pi), dot(simd, gravity, d));
            diffusion = fma(simd, f, dp, diffusion);
        });
    }
    [simd.reduce_sum_f32s(divergence), simd.reduce_sum_f32s(diffusion)]
}

#[derive(Clone, Copy)]
struct Accelerations<'a>(&'a Wcsph);

impl RowPass for Accelerations<'_> {
    #[inline(always)]
    fn row<S: Simd>(self, simd: S, pass: &Pass<'_>, i: usize, loads: &mut [BodyLoad]) -> [f32; 4] {
        let (s, p) = (self.0, pass.particles);
        let (xi, vi) = (p.position(i), p.velocity(i));
        let mut total = Vec3::from(pair_acceleration(simd, s, pass, i)) * s.scale;
        pass.solids.visit(xi, s.support, |m| {
            let [push, drag] = s.wall_acceleration(pass, &m, vi, p.aux[i]);
            total += push + drag;
            if let (true, Some(body)) = (s.two_way, m.body) {
                loads[body].react(push * s.mass, drag * s.mass, m.contact.arm);
            }
        });
        [total.x, total.y, total.z, 0.0]
    }
}

#[inline(always)]
fn pair_acceleration<S: Simd>(simd: S, s: &Wcsph, pass: &Pass<'_>, i: usize) -> [f32; 3] {
    let p = pass.particles;
    let xi = splat3(simd, p.position(i).to_array());
    let vi = splat3(simd, p.velocity(i).to_array());
    let pi = simd.splat_f32s(p.aux[i]);
    let (ih, one, zero) = (simd.splat_f32s(s.inverse_support), simd.splat_f32s(1.0), simd.splat_f32s(0.0));
    let (nu, eta2) = (simd.splat_f32s(10.0 * s.viscosity), simd.splat_f32s(s.eta2));
    let mut sum = [zero; 3];
    for range in pass.grid.neighbours(i) {
        for_lanes!(S, simd, range, [x: p.x, y: p.y, z: p.z, u: p.u, v: p.v, w: p.w, pj: p.aux], live, {
            let d = difference(simd, xi, [x, y, z]);
            let r2 = dot(simd, d, d);
            let q = simd.mul_f32s(simd.sqrt_f32s(r2), ih);
            let t = simd.mul_f32s(simd.max_f32s(simd.sub_f32s(one, q), zero), live);
            let f = simd.mul_f32s(simd.mul_f32s(t, t), t);
            let dv = difference(simd, vi, [u, v, w]);
            let rate = simd.div_f32s(dot(simd, dv, d), simd.add_f32s(r2, eta2));
            let coefficient = simd.sub_f32s(simd.mul_f32s(nu, rate), simd.add_f32s(pi, pj));
            add_scaled(simd, &mut sum, simd.mul_f32s(f, coefficient), d);
        });
    }
    sum3(simd, sum)
}

#[derive(Clone, Copy)]
struct Packing<'a>(&'a Wcsph);

impl RowPass for Packing<'_> {
    #[inline(always)]
    fn row<S: Simd>(self, simd: S, pass: &Pass<'_>, i: usize, _: &mut [BodyLoad]) -> [f32; 4] {
        let s = self.0;
        let mut total = pair_packing(simd, s, pass, i) * s.sum_scale;
        pass.solids.visit(pass.particles.position(i), s.support, |m| total += pass.solids.terms(&m).volume);
        [total, 0.0, 0.0, 0.0]
    }
}

#[inline(always)]
fn pair_packing<S: Simd>(simd: S, s: &Wcsph, pass: &Pass<'_>, i: usize) -> f32 {
    let p = pass.particles;
    let xi = splat3(simd, p.position(i).to_array());
    let (ih, one, zero) = (simd.splat_f32s(s.inverse_support), simd.splat_f32s(1.0), simd.splat_f32s(0.0));
    let four = simd.splat_f32s(4.0);
    let mut sum = zero;
    for range in pass.grid.neighbours(i) {
        for_lanes!(S, simd, range, [x: p.x, y: p.y, z: p.z], live, {
            let d = difference(simd, xi, [x, y, z]);
            let q = simd.mul_f32s(simd.sqrt_f32s(dot(simd, d, d)), ih);
            let t = simd.mul_f32s(simd.max_f32s(simd.sub_f32s(one, q), zero), live);
            let t2 = simd.mul_f32s(t, t);
            sum = fma(simd, simd.mul_f32s(t2, t2), fma(simd, four, q, one), sum);
        });
    }
    simd.reduce_sum_f32s(sum)
}
