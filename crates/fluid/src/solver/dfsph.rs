//! Divergence-free SPH: a fluid that keeps its volume, by two solves a sub-step and no speed of sound.
//!
//! With P = p/ρ₀ (m²/s²), V the volume of a particle, f the Wendland gradient over r times V and d = x_j − x_i, as in
//! `wcsph.rs`, and N the gradient of the share φ of a particle's neighbourhood that solids fill:
//!
//! ```text
//! a_i  = −Σ f (P_i + P_j) d − 2 P_i N + ν L_i + walls + g        e = v + dt a
//! D_i  = Σ f (e_j − e_i)·d + 2 N·(e_wall − e_i)                  how fast room opens round a particle
//! P ≥ 0,  D_i ≥ −κ_i,  one of the two equal                      the divergence solve
//!
//! δ_i  = −Σ f (Q_i + Q_j) d − Q_i N                              what the sub-step shifts particles by
//! Q ≥ 0,  Σ f (δ_j − δ_i)·d − N·δ_i ≥ Σ V W + φ − 1, likewise    the constant-density solve
//! ```
//!
//! Sources: Bender & Koschier 2015 (doi:10.1145/2786784.2786796) and 2017 (doi:10.1109/TVCG.2016.2578335) for the two
//! solves, for pressures that only push, and for the start from those of the last sub-step. Two things differ, for the
//! sake of the force. Gravity and viscosity come before the divergence solve and not after it, so that the pressure that
//! answers them, and loads the bodies, is the smooth one, which the last sub-step's starts well. And the
//! constant-density solve moves particles and not their velocities (as Hu & Adams 2007, doi:10.1016/j.jcp.2007.07.013):
//! it mends the thousandths of a spacing that the motion of a sub-step has left; as a velocity that would be a push of
//! many times gravity, and another in each sub-step. It takes and gives no momentum, and starts from nothing, for what
//! it mended is gone. So the load is P's own, the push that the particles get, at any number of iterations.
//!
//! κ is the room that there is to fall together in: at once up to the neighbours that a level surface has, for a drop
//! has no pressure before it meets something, and slowly within the fluid. How the two are solved: `descent.rs`. Walls
//! (see `wall.rs`) are taken as mirrors, with twice N in pressure and divergence: each sum is then the other's transpose,
//! which the solves rest on. The pressure's slope into a wall is that of the last sub-step: see `site.rs`.

mod descent;
mod site;
mod solve;
#[cfg(test)]
mod tests;

use super::{Pass, Rows, Scratch, sweep};
use crate::body::BodyLoad;
use crate::meetings::Meetings;
use crate::neighbours::Neighbours;
use crate::particles::Particles;
use crate::solver::wcsph::{self, Wcsph};
use crate::vector_unit::Arch;
use crate::{FluidConfig, Kernel, kernel};
use descent::Descent;
use glam::{DVec3, Vec3};
use site::{Crowd, Look, Site, Survey};
use solve::Solve;

/// Constants of one configuration.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Dfsph {
    /// Constants of the sums that it shares with `wcsph`.
    sums: Wcsph,
    gravity: Vec3,
    /// Share of the compression that the pressure may leave unanswered.
    tolerance: f32,
    max_iterations: usize,
    /// Largest pressure over rest density, m²/s²: what stops fluid at the highest speed that the last guard leaves it. Drops
    /// between bodies that yield would else be answered by any.
    most: f32,
    /// Square of the largest factor by which the pressure's sum answers a wave on a lattice, 1/m².
    stiffest: f32,
    /// Share of a full neighbourhood that a particle of a level surface has.
    level: f32,
}

/// What the solves work with, and what they leave for the end of the sub-step.
#[derive(Clone, Debug, Default)]
pub(crate) struct Solves {
    crowds: Vec<Crowd>,
    sites: Vec<Site>,
    openings: Vec<f32>,
    shifts: Rows,
    descent: Descent,
    /// Iterations of both solves in the last sub-step.
    pub iterations: usize,
}

impl Solves {
    /// Nothing is solved yet in a sub-step.
    pub fn rest(&mut self) {
        self.shifts.clear();
        self.iterations = 0;
    }

    /// What the constant-density solve shifts particle `i` by, m.
    pub fn shift(&self, i: usize) -> Vec3 {
        self.shifts.get(i).map_or(Vec3::ZERO, |&[x, y, z, _]| Vec3::new(x, y, z))
    }
}

/// What stands round the particles in one sub-step, and how long that is.
#[derive(Clone, Copy)]
pub(crate) struct Surroundings<'a> {
    pub arch: Arch,
    pub neighbours: &'a Neighbours,
    pub meetings: &'a Meetings,
    /// Length of the sub-step, s.
    pub dt: f32,
    /// Highest speed of a particle, m/s.
    pub speed: f32,
}

impl<'a> Surroundings<'a> {
    fn pass(self, particles: &'a Particles) -> Pass<'a> {
        Pass { arch: self.arch, particles, neighbours: self.neighbours, meetings: self.meetings }
    }
}

impl Dfsph {
    pub fn new(config: &FluidConfig) -> Self {
        let s = &config.settings;
        let (dx, h) = (s.spacing, s.support_length());
        Self {
            sums: Wcsph::new(config),
            gravity: s.gravity.as_vec3(),
            tolerance: s.tolerance as f32,
            max_iterations: s.max_iterations,
            most: config.highest_speed().powi(2) as f32,
            stiffest: stiffest_wave(dx, h) as f32,
            level: level_surface(dx, h) as f32,
        }
    }

    /// One sub-step: accelerations without gravity (m/s²) to `rows`, and the bodies' loads; shifts stay in `solves`.
    pub fn step(
        &self,
        around: Surroundings<'_>,
        particles: &mut Particles,
        solves: &mut Solves,
        scratch: &mut Scratch,
        rows: &mut Rows,
        loads: &mut [BodyLoad],
    ) {
        self.look(around, particles, solves, scratch);
        let Solves { sites, openings, shifts, descent, iterations, .. } = solves;
        let mut solve = Solve { solver: self, around, particles, sites, openings, descent, scratch };
        *iterations = solve.keep_divergence(rows);
        solve.load(rows, loads);
        solve.take_pressures();
        *iterations += solve.keep_density(shifts);
    }

    /// Looks round each particle, and starts from the last sub-step's pressures.
    fn look(
        &self,
        around: Surroundings<'_>,
        particles: &mut Particles,
        solves: &mut Solves,
        scratch: &mut Scratch,
    ) {
        let Solves { crowds, sites, .. } = solves;
        sweep(around.pass(particles), Look(self), crowds, scratch, &mut []);
        for (i, crowd) in crowds.iter().enumerate() {
            let free = particles.held[i] <= 0.0;
            particles.aux[i] = if free { particles.p[i] } else { 0.0 };
            let l = crowd.laplacian * wcsph::within(crowd.fill);
            (particles.lx[i], particles.ly[i], particles.lz[i]) = l.into();
        }
        particles.refresh_images();
        let survey = Survey { solver: self, crowds, dt: around.dt, filter: self.filter(around) };
        sweep(around.pass(particles), survey, sites, scratch, &mut []);
        for (i, site) in sites.iter_mut().enumerate() {
            if particles.is_image(i) || particles.held[i] > 0.0 {
                *site = Site::default();
            }
        }
    }

    /// κ of the noise filter of `wcsph`, m⁴/s: with ten times the highest speed that there is for the speed of sound,
    /// and no more than the length of the sub-step bears (see `limits.rs`).
    fn filter(&self, around: Surroundings<'_>) -> f32 {
        let square = self.sums.support.powi(2);
        let free = (square / around.dt - self.sums.viscosity / 0.015).max(0.0);
        let bearable = 0.007 * free * square / 30.0;
        (self.sums.filter * 10.0 * around.speed / self.sums.sound).min(bearable)
    }
}

/// Sum over the sites of a cubic lattice within the support, its middle left out.
fn lattice_sum(dx: f64, h: f64, term: impl Fn(DVec3) -> f64) -> f64 {
    let reach = (h / dx).ceil() as i32;
    let along = || (-reach..=reach).map(f64::from);
    let sites = along().flat_map(|x| along().flat_map(move |y| along().map(move |z| DVec3::new(x, y, z))));
    sites.filter(|d| *d != DVec3::ZERO).map(|d| term(d * dx)).sum()
}

/// Square of the largest factor by which the pressure's sum answers a wave on a lattice, 1/m².
fn stiffest_wave(dx: f64, h: f64) -> f64 {
    let volume = dx.powi(3) / Kernel::Wendland.lattice_moment(dx, h);
    let answer = |wave: DVec3| {
        let along = wave.normalize();
        lattice_sum(dx, h, |d| {
            -volume * kernel::wendland_slope_over_r(d.length(), h) * d.dot(along) * wave.dot(d).sin()
        })
    };
    let directions = [DVec3::X, DVec3::new(1.0, 1.0, 0.0), DVec3::ONE];
    let waves = directions.iter().flat_map(|d| (1..64).map(move |k| *d * f64::from(k) / 64.0));
    waves.map(|w| answer(w * std::f64::consts::PI / dx).powi(2)).fold(0.0, f64::max)
}

/// Share of a full neighbourhood that a particle in the topmost layer of a lattice has.
fn level_surface(dx: f64, h: f64) -> f64 {
    let (own, all) = (kernel::wendland(0.0, h), |d: DVec3| kernel::wendland(d.length(), h));
    let whole = own + lattice_sum(dx, h, all);
    let below = own + lattice_sum(dx, h, |d| if d.y > 0.5 * dx { 0.0 } else { all(d) });
    below / whole
}
