//! Weakly compressible SPH with density diffusion and particle shifting (δ⁺-SPH), staggered in time.
//!
//! State is the pressure over rest density P = p/ρ₀ (m²/s²). With V the volume of a particle, f = −W'/r V, d = x_j − x_i, and
//! K a number of the kernel (30 for Wendland C2, 80/3 for the cubic spline, 29.8 for the low-pass):
//!
//! ```text
//! dP_i/dt = −c² Σ f (v_j−v_i)·d + δ (H/2) c Σ 2 f (P_j − P_i − g·d) + q_i           at x(t+dt), v(t+dt)
//! L_i     = K/H² Σ f ((v_j−v_i)·d) d                                               ∇²v where div v = 0
//! a_i     = −Σ f (P̂_i + P̂_j) d + ν L_i − κ K/H² Σ f ((L_j−L_i)·d) d + walls + g
//! δx_i    = −σ c dx Σ f d dt                                                        within the fluid
//! ```
//!
//! with P̂ = max(−T, P − ζ c dx div) + P₀, P₀ a background pressure and T a slight tension. ζ grows where the flow is
//! quiet (see `QUIET_DAMPING`).
//!
//! Sources: Molteni & Colagrossi 2009 (doi:10.1016/j.cpc.2008.12.004) for the diffusion; Fourtakas et al. 2019
//! (doi:10.1016/j.compfluid.2019.06.009) for leaving the hydrostatic part out of it. The
//! viscous term is central, as Monaghan's (2005, doi:10.1088/0034-4885/68/8/R01), so that it keeps angular momentum and
//! leaves a fluid alone that turns as a whole; but weighted by f, not f/r²: the sum then lies where there are particles, and
//! is within 1 % of the same in all directions of a lattice, where the other is 10 % low in shear and 7 % high in stretching.
//! Lind et al. 2012 (doi:10.1016/j.jcp.2011.10.027) and Sun
//! et al. 2017 (doi:10.1016/j.cma.2016.10.028) for the shifting: the pressure of a disordered neighbourhood is
//! no longer needed to spread particles, and what that costs in drag falls away. The term with κ takes the viscous
//! term twice: it stops what changes from particle to particle and leaves flow alone that is smooth over H. κ stands within
//! the inner L, and grows with it (see `QUIET_SHARE`). q_i leads P slowly to the pressure of the summed density, because an integrated density forgets
//! how many particles there are. Walls: see `wall.rs`; they push and never pull. Where ν is so large that sound could go on for
//! far longer, ν L is solved for instead (`viscosity.rs`); surface tension comes on top (`tension.rs`).

use super::viscosity::is_implicit;
use super::{Pass, Record, RowPass, Rows, Scratch, sweep};
use crate::body::BodyLoad;
use crate::lanes::{add_scaled, difference, dot, fma};
use crate::pair_kernel::{PairKernel, apart, with_kernel};
use crate::particles::Particles;
use crate::solids::Meeting;
use crate::wall::WallTerms;
use crate::{FluidConfig, Kernel};
use glam::Vec3;
use pulp::Simd;
use rayon::prelude::*;

/// Sub-steps between two looks at the summed density.
pub(crate) const PACKING_INTERVAL: u64 = 10;
/// Time in which the pressure follows the summed density, s.
const PACKING_TIME: f32 = 0.1;
/// Largest density error that packing acts on at once.
const PACKING_CLIP: f32 = 0.02;
/// Below this share of full neighbourhood a particle lies at a free surface and packing leaves it alone.
const FREE_SURFACE: f32 = 0.95;

/// Kinematic viscosity that the noise filter is as strong as at the particle spacing, m²/s: α c H/20 (Monaghan
/// 2005).
pub(crate) fn artificial_viscosity(config: &FluidConfig) -> f64 {
    let s = &config.settings;
    s.artificial_viscosity * config.sound_speed() * s.support_length() / 20.0
}

/// κ at its full strength, m⁴/s: in a flow of wave number k it acts as a kinematic viscosity κ k². The viscous sum
/// answers noise with about −K/H² of it.
pub(crate) fn noise_filter(config: &FluidConfig) -> f64 {
    artificial_viscosity(config) * config.settings.support_length().powi(2)
        / config.settings.kernel_in_use().viscous_factor()
}

/// Share of the filter that acts on quiet flow. From there it grows with what it filters, to the whole where H² |L| nears
/// α c: a jet that breaks on a plate needs all of it, and all of it would hold a body back that is towed slowly, by 1 % of
/// its lift.
pub(crate) const QUIET_SHARE: f32 = 0.1;

/// How much more sound is damped in quiet fluid, where nothing else is lost by it: a column that has been let go stops
/// bouncing in half a second and not in one and a half. A jet that is damped so ripples five times as much.
const QUIET_DAMPING: f32 = 6.2;
/// Largest bulk viscosity, in dx²/dt: noise grows from 4 on (measured).
const MOST_DAMPING: f32 = 2.8;

/// Tension that the fluid bears before it parts, in ρ₀ c²: a falling jet is drawn together by it. That of water's surface
/// over a drop of a few millimetres is as large; a stronger one clumps particles.
const TENSION: f64 = 2e-4;
/// Least share of a moment that is taken to lie in the fluid, when the whole is found from it.
pub(super) const LEAST_FLUID: f32 = 0.4;
/// Distance below which the slope of the velocity at a wall is no longer looked for, in spacings.
pub(crate) const LEAST_DISTANCE: f32 = 0.25;
/// Longest shift in a sub-step, in spacings.
const LONGEST_SHIFT: f32 = 0.05;
/// From this share of a full neighbourhood to this, the noise filter sets in: at a free surface the sum over one side
/// takes any shear for noise.
const FILTERED: [f32; 2] = [0.85, 0.95];

/// How far within the fluid a particle lies whose neighbourhood is filled to `fill`, 0..1.
pub(super) fn within(fill: f32) -> f32 {
    ((fill - FILTERED[0]) / (FILTERED[1] - FILTERED[0])).clamp(0.0, 1.0)
}

/// Below this share a particle is spray: a drop or a sheet one particle thick.
const SPRAY: f32 = 0.75;
/// Time in which spray forgets its pressure, s.
const SPRAY_TIME: f32 = 0.003;

/// Constants of one configuration.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Wcsph {
    kernel: Kernel,
    pub(super) support: f32,
    inverse_support: f32,
    /// C V: scale of f.
    pub(super) scale: f32,
    /// Scale of the viscous sum, in supports.
    pub(super) viscous_scale: f32,
    /// Scale of the summed kernel.
    pub(super) sum_scale: f32,
    pub(super) mass: f32,
    pub(super) sound: f32,
    diffusion: f32,
    damper: f32,
    /// Stated kinematic viscosity, m²/s; 0 where it is implicit.
    pub(super) viscosity: f32,
    /// κ of the noise filter, m⁴/s.
    pub(super) filter: f32,
    spacing: f32,
    /// H²/(α c): 1 over the Laplacian that wakes the whole filter, m s.
    rough: f32,
    /// Diffusivity of the shifting, m²/s.
    shifting: f32,
    longest_shift: f32,
    /// Distance below which the slope of the velocity at a wall is no longer looked for, m.
    least_distance: f32,
    /// Pressure over rest density that all is under, m²/s².
    background: f32,
    /// Lowest pressure over rest density, m²/s².
    floor: f32,
    gravity: Vec3,
    pub(super) two_way: bool,
}

impl Wcsph {
    pub fn new(config: &FluidConfig) -> Self {
        let s = &config.settings;
        let (dx, h, c) = (s.spacing, s.support_length(), config.sound_speed());
        let kernel = s.kernel_in_use();
        let volume = dx.powi(3) / kernel.lattice_moment(dx, h);
        Self {
            kernel,
            support: h as f32,
            inverse_support: (1.0 / h) as f32,
            scale: (kernel.gradient_scale(h) * volume) as f32,
            viscous_scale: (kernel.viscous_factor() * kernel.gradient_scale(h) * volume) as f32,
            sum_scale: (kernel.value(0.0, h) * dx.powi(3) / kernel.lattice_sum(dx, h)) as f32,
            mass: s.particle_mass() as f32,
            sound: c as f32,
            diffusion: (s.density_diffusion * 0.5 * h * c) as f32,
            damper: (s.acoustic_damping * c * dx) as f32,
            viscosity: if is_implicit(config) { 0.0 } else { s.kinematic_viscosity() as f32 },
            filter: noise_filter(config) as f32,
            spacing: dx as f32,
            rough: (h * h / (s.artificial_viscosity * c).max(1e-9)) as f32,
            shifting: (s.shifting * c * dx) as f32,
            longest_shift: LONGEST_SHIFT * dx as f32,
            least_distance: LEAST_DISTANCE * dx as f32,
            background: (s.background_pressure / s.rest_density) as f32,
            floor: -(s.background_pressure / s.rest_density + TENSION * c * c) as f32,
            gravity: s.gravity.as_vec3(),
            two_way: s.two_way,
        }
    }

    /// What the pressures change by, and what the accelerations need.
    pub fn rates(&self, pass: Pass<'_>, scratch: &mut Scratch, rates: &mut Vec<Rates>) {
        with_kernel!(self.kernel, |k| sweep(pass, RatesPass(self, k), rates, scratch, &mut []));
    }

    /// Rows of [share of the neighbourhood that is filled, –, –, –].
    pub fn packing(&self, pass: Pass<'_>, scratch: &mut Scratch, rows: &mut Rows) {
        with_kernel!(self.kernel, |k| sweep(pass, Packing(self, k), rows, scratch, &mut []));
    }

    /// Rows of [acceleration without gravity m/s², –]; adds the bodies' loads.
    pub fn accelerations(
        &self,
        pass: Pass<'_>,
        rates: &[Rates],
        scratch: &mut Scratch,
        rows: &mut Rows,
        loads: &mut [BodyLoad],
    ) {
        with_kernel!(self.kernel, |kernel| {
            sweep(pass, Accelerations { solver: self, kernel, rates }, rows, scratch, loads)
        });
    }

    /// Sets the packing feedback from the summed densities.
    pub fn take_packing(&self, particles: &mut Particles, rows: &Rows) {
        let c2 = self.sound * self.sound;
        for (i, &[fill, ..]) in rows.iter().enumerate() {
            particles.fill[i] = fill;
            particles.inner[i] = within(fill);
            let error = (fill - 1.0 - particles.p[i] / c2).clamp(-PACKING_CLIP, PACKING_CLIP);
            particles.slow[i] = match fill {
                fill if fill < SPRAY => -particles.p[i] / SPRAY_TIME,
                fill if fill < FREE_SURFACE => 0.0,
                _ => c2 / PACKING_TIME * error,
            };
        }
    }

    /// Takes the pressure over `dt` and the pressure that acts from the rates, and turns shift velocities into
    /// shifts.
    pub fn take_rates(&self, particles: &mut Particles, rates: &mut [Rates], dt: f32) {
        let most = MOST_DAMPING * self.spacing * self.spacing / dt.max(1e-9);
        let (n, p) = (rates.len(), particles);
        let (fill, inner, slow, held) = (&p.fill, &p.inner, &p.slow, &p.held);
        let laplacian = (&mut p.lx[..n], &mut p.ly[..n], &mut p.lz[..n]).into_par_iter();
        let each =
            (&mut p.p[..n], &mut p.aux[..n], laplacian, rates).into_par_iter().with_min_len(1024).enumerate();
        each.for_each(|(i, (p, acting, laplacian, rates))| {
            rates.shift = self.shift(rates, dt, fill[i] >= FREE_SURFACE && held[i] <= 0.0);
            // Spray that has been squeezed lets go at once: a drop splashes on a wall and does not bounce.
            let lets_go = fill[i] < SPRAY && rates.divergence > 0.0;
            let free = lets_go || held[i] > 0.0;
            *p = if free { 0.0 } else { self.pressure_after(*p, rates, slow[i], dt) };
            let rough = (QUIET_SHARE + self.rough * rates.laplacian.length()).min(1.0);
            let damper = (self.damper * (1.0 + QUIET_DAMPING * (1.0 - rough))).min(most);
            let damped = *p - damper * rates.divergence;
            *acting = damped.clamp(self.floor, 2.0 * self.sound * self.sound) + self.background;
            let l = rates.laplacian * (inner[i] * rough);
            (*laplacian.0, *laplacian.1, *laplacian.2) = (l.x, l.y, l.z);
        });
    }

    /// The shift of a particle over `dt`, m.
    fn shift(&self, rates: &Rates, dt: f32, inside: bool) -> Vec3 {
        let shift = if inside { rates.shift * dt } else { Vec3::ZERO };
        shift.clamp_length_max(self.longest_shift)
    }

    /// What a pressure becomes over `dt`, the shift taken.
    fn pressure_after(&self, p: f32, rates: &Rates, slow: f32, dt: f32) -> f32 {
        let c2 = self.sound * self.sound;
        // A shifted particle takes the hydrostatic pressure of its new place.
        let change = dt * (rates.diffusion + slow - c2 * rates.divergence) + rates.shift.dot(self.gravity);
        // No more than twice the density at rest bears: what is squeezed without end, between solids or by a cap
        // on speeds, would else load them without end.
        (p + change).clamp(self.floor, c2)
    }

    /// Place of a particle in supports.
    pub(super) fn scaled(&self, p: &Particles, i: usize) -> [f32; 3] {
        (p.position(i) * self.inverse_support).into()
    }

    /// Acceleration by a wall: [pressure, friction]. `slope`: sum of f (P_j − P_i) d over the fluid.
    fn wall_acceleration(
        &self,
        meeting: &Meeting,
        terms: &WallTerms,
        velocity: Vec3,
        p: f32,
        slope: Vec3,
    ) -> [Vec3; 2] {
        let n = meeting.contact.normal;
        // Wall pressure = the particle's, extrapolated: across the wall with gravity as the moving wall feels it,
        // along it with the fluid's own slope, of which the sum holds the part that is not in the wall. Where the
        // fluid bears no pressure there is none to extrapolate, and a wall must not hold a droplet up.
        let field = self.gravity - meeting.acceleration;
        let bearing = (2.0 * p / (field.length() * self.support).max(1e-9)).clamp(0.0, 1.0);
        let across = field.dot(n) * n;
        let along = (slope - slope.dot(n) * n) / (1.0 - terms.tangent_moment).max(LEAST_FLUID);
        let moment = terms.normal_moment * across + terms.tangent_moment * along;
        // Between the particle and the wall the slope bends from the fluid's own to the wall's.
        let own = slope.dot(n) / (1.0 - terms.normal_moment).max(LEAST_FLUID);
        let bend = 0.5 * meeting.contact.distance.max(0.0) * (field.dot(n) - own);
        let push = -(2.0 * p + bearing * bend) * terms.gradient * n - bearing * moment;
        // A wall pushes and never pulls.
        let push = push - push.dot(n).min(0.0) * n;
        [push, self.friction(meeting, terms, velocity)]
    }

    /// Acceleration by the friction of a wall on a particle of `velocity` (m/s), m/s².
    pub(super) fn friction(&self, meeting: &Meeting, terms: &WallTerms, velocity: Vec3) -> Vec3 {
        let n = meeting.contact.normal;
        let slip = meeting.contact.velocity - velocity;
        let slip = slip - slip.dot(n) * n;
        let rate = slip / meeting.contact.distance.max(self.least_distance);
        self.viscosity * terms.friction * rate
    }
}

/// What the first pass finds of a particle.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Rates {
    /// Divergence of the velocity, 1/s.
    pub divergence: f32,
    /// Density diffusion, m²/s³.
    pub diffusion: f32,
    /// Laplacian of the velocity by the fluid, 1/(m s).
    pub laplacian: Vec3,
    /// Σ f d over the fluid, 1/m: where the others are.
    pub crowding: Vec3,
    /// Velocity (m/s) of the shift, and from `take_rates` on the shift itself, m.
    pub shift: Vec3,
}

#[derive(Clone, Copy)]
struct RatesPass<'a, K>(&'a Wcsph, K);

impl<K: PairKernel> RowPass<7, 8> for RatesPass<'_, K> {
    type Row = Rates;

    fn record(self, p: &Particles, i: usize) -> Record {
        let [x, y, z] = self.0.scaled(p, i);
        // The hydrostatic part of the pressure diffuses nowhere.
        let p_flat = p.p[i] - self.0.gravity.dot(p.position(i));
        [x, y, z, p_flat, p.u[i], p.v[i], p.w[i], 0.0]
    }

    #[inline(always)]
    fn pair<S: Simd>(self, simd: S, i: &[S::f32s; 7], j: &[S::f32s; 7], sums: &mut [S::f32s; 8]) {
        let (d, r2) = apart(simd, [i[0], i[1], i[2]], [j[0], j[1], j[2]]);
        let f = self.1.slope(simd, r2);
        let dv = difference(simd, [i[4], i[5], i[6]], [j[4], j[5], j[6]]);
        let opening = simd.mul_f32s(f, dot(simd, dv, d));
        let [divergence, diffusion, laplacian @ .., cx, cy, cz] = sums;
        *divergence = simd.add_f32s(*divergence, opening);
        *diffusion = fma(simd, f, simd.sub_f32s(j[3], i[3]), *diffusion);
        add_scaled(simd, laplacian, opening, d);
        let mut crowding = [*cx, *cy, *cz];
        add_scaled(simd, &mut crowding, f, d);
        [*cx, *cy, *cz] = crowding;
    }

    fn row(self, pass: &Pass<'_>, i: usize, sums: [f32; 8], _: &mut [BodyLoad]) -> Rates {
        let (s, p) = (self.0, pass.particles);
        let vi = p.velocity(i);
        let [divergence, diffusion, lx, ly, lz, cx, cy, cz] = sums;
        let mut r = Rates {
            divergence: divergence * (s.support * s.scale),
            diffusion: diffusion * (2.0 * s.scale * s.diffusion),
            laplacian: Vec3::new(lx, ly, lz) * s.viscous_scale,
            crowding: Vec3::new(cx, cy, cz) * (s.support * s.scale),
            shift: Vec3::ZERO,
        };
        let mut crowding = r.crowding;
        for (m, terms) in pass.meetings.of(i) {
            let n = m.contact.normal;
            r.divergence += (m.contact.velocity - vi).dot(n) * terms.gradient;
            crowding += terms.gradient * n;
        }
        r.shift = -s.shifting * crowding;
        r
    }
}

#[derive(Clone, Copy)]
struct Accelerations<'a, K> {
    solver: &'a Wcsph,
    kernel: K,
    rates: &'a [Rates],
}

impl<K: PairKernel> RowPass<7, 6> for Accelerations<'_, K> {
    type Row = [f32; 4];

    fn record(self, p: &Particles, i: usize) -> Record {
        let [x, y, z] = self.solver.scaled(p, i);
        [x, y, z, p.aux[i], p.lx[i], p.ly[i], p.lz[i], 0.0]
    }

    /// Σ f (P̂_i + P̂_j) d, and the noise filter's sum.
    #[inline(always)]
    fn pair<S: Simd>(self, simd: S, i: &[S::f32s; 7], j: &[S::f32s; 7], sums: &mut [S::f32s; 6]) {
        let (d, r2) = apart(simd, [i[0], i[1], i[2]], [j[0], j[1], j[2]]);
        let f = self.kernel.slope(simd, r2);
        let [px, py, pz, filter @ ..] = sums;
        let mut pressure = [*px, *py, *pz];
        add_scaled(simd, &mut pressure, simd.mul_f32s(f, simd.add_f32s(i[3], j[3])), d);
        [*px, *py, *pz] = pressure;
        let dl = difference(simd, [i[4], i[5], i[6]], [j[4], j[5], j[6]]);
        add_scaled(simd, filter, simd.mul_f32s(f, dot(simd, dl, d)), d);
    }

    fn row(self, pass: &Pass<'_>, i: usize, sums: [f32; 6], loads: &mut [BodyLoad]) -> [f32; 4] {
        let (s, p, rates) = (self.solver, pass.particles, &self.rates[i]);
        let vi = p.velocity(i);
        let [px, py, pz, fx, fy, fz] = sums;
        let pressure = Vec3::new(px, py, pz) * (s.support * s.scale);
        let filter = Vec3::new(fx, fy, fz) * (s.filter * s.viscous_scale);
        let slope = pressure - 2.0 * p.aux[i] * rates.crowding;
        let mut total = s.viscosity * rates.laplacian - filter - pressure;
        for (m, terms) in pass.meetings.of(i) {
            let [push, drag] = s.wall_acceleration(m, terms, vi, p.aux[i], slope);
            total += push + drag;
            if let (true, Some(body)) = (s.two_way, m.body) {
                loads[body].react(push * s.mass, drag * s.mass, m.contact.arm);
            }
        }
        [total.x, total.y, total.z, 0.0]
    }
}

#[derive(Clone, Copy)]
struct Packing<'a, K>(&'a Wcsph, K);

impl<K: PairKernel> RowPass<3, 1> for Packing<'_, K> {
    type Row = [f32; 4];

    fn record(self, p: &Particles, i: usize) -> Record {
        let [x, y, z] = self.0.scaled(p, i);
        [x, y, z, 0.0, 0.0, 0.0, 0.0, 0.0]
    }

    #[inline(always)]
    fn pair<S: Simd>(self, simd: S, i: &[S::f32s; 3], j: &[S::f32s; 3], [sum]: &mut [S::f32s; 1]) {
        *sum = self.1.add_value(simd, apart(simd, *i, *j).1, *sum);
    }

    fn row(self, pass: &Pass<'_>, i: usize, [sum]: [f32; 1], _: &mut [BodyLoad]) -> [f32; 4] {
        let s = self.0;
        let solid: f32 = pass.meetings.of(i).iter().map(|(_, terms)| terms.volume).sum();
        [sum * s.sum_scale + solid, 0.0, 0.0, 0.0]
    }
}
