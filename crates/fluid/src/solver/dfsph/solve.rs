//! The two solves and the sums that they repeat.

use super::{Dfsph, Surroundings};
use crate::body::BodyLoad;
use crate::lanes::{add_scaled, difference, fma};
use crate::particles::Particles;
use crate::solver::dfsph::descent::{Descent, violation};
use crate::solver::dfsph::site::{self, Site};
use crate::solver::{Pass, Record, RowPass, Rows, Scratch, sweep};
use glam::Vec3;
use pulp::Simd;

/// Mean share of density that may be too much.
const DENSITY_ERROR: f32 = 1e-3;

/// Both solves of one sub-step; the unknowns stand in `aux`.
pub(super) struct Solve<'a> {
    pub solver: &'a Dfsph,
    pub around: Surroundings<'a>,
    pub particles: &'a mut Particles,
    pub sites: &'a [Site],
    pub openings: &'a mut Vec<f32>,
    pub descent: &'a mut Descent,
    pub scratch: &'a mut Scratch,
}

impl Solve<'_> {
    /// The divergence solve, from the pressures in `aux`: leaves there those that keep the volume, and their accelerations
    /// in `rows`. Returns the number of iterations.
    pub fn keep_divergence(&mut self, rows: &mut Rows) -> usize {
        let unanswered = self.compression_without_pressure(rows);
        let mut iterations = 1;
        loop {
            self.try_pressures(rows);
            let (sites, openings) = (self.sites, &*self.openings);
            let left = |i: usize| -openings[i] - sites[i].closing;
            let enough = violation(&self.particles.aux, sites, left) <= self.solver.tolerance * unanswered;
            if enough || iterations >= self.solver.max_iterations {
                return iterations;
            }
            let scale = (1.0 / self.around.dt, self.solver.most);
            self.descent.advance(&mut self.particles.aux, sites, scale, left);
            self.particles.refresh_images();
            iterations += 1;
        }
    }

    /// How much the sub-step would compress the fluid without any pressure, 1/s.
    fn compression_without_pressure(&mut self, rows: &mut Rows) -> f32 {
        self.descent.begin(&self.particles.aux);
        self.particles.aux.fill(0.0);
        self.try_pressures(rows);
        let (sites, openings) = (self.sites, &*self.openings);
        let unanswered = violation(&self.particles.aux, sites, |i| -openings[i] - sites[i].closing);
        self.descent.restore(&mut self.particles.aux);
        self.particles.refresh_images();
        unanswered
    }

    /// Accelerations under the pressures in `aux`, and how room opens with the velocities that they lead to.
    fn try_pressures(&mut self, rows: &mut Rows) {
        let Self { solver, around, particles, sites, .. } = self;
        sweep(around.pass(particles), Push { solver, sites }, rows, self.scratch, &mut []);
        for (i, &[x, y, z, _]) in rows.iter().enumerate() {
            let dt = if particles.held[i] > 0.0 { 0.0 } else { around.dt };
            let end = particles.velocity(i) + (Vec3::new(x, y, z) + solver.gravity) * dt;
            (particles.lx[i], particles.ly[i], particles.lz[i]) = end.into();
        }
        self.find_openings(Walls::Mirrors);
    }

    /// How room opens with the velocities or shifts in `lx`, `ly`, `lz`.
    fn find_openings(&mut self, walls: Walls) {
        let Self { solver, around, particles, sites, .. } = self;
        particles.refresh_images();
        let opening = Opening { solver, sites, walls };
        sweep(around.pass(particles), opening, self.openings, self.scratch, &mut []);
    }

    /// Accelerations and loads under the pressures that were found.
    pub fn load(&mut self, rows: &mut Rows, loads: &mut [BodyLoad]) {
        let Self { solver, around, particles, sites, .. } = self;
        if !loads.is_empty() {
            sweep(around.pass(particles), Push { solver, sites }, rows, self.scratch, loads);
        }
    }

    /// Takes the pressures over, one step ahead: in a fluid at rest they converge in the course of time.
    pub fn take_pressures(&mut self) {
        for (i, (site, opening)) in self.sites.iter().zip(&*self.openings).enumerate() {
            let ahead = site.relief / self.around.dt * (-opening - site.closing);
            self.particles.p[i] = (self.particles.aux[i] + ahead).clamp(0.0, self.solver.most);
        }
    }

    /// The constant-density solve: leaves what particles are shifted by in `shifts`. Returns the number of iterations.
    pub fn keep_density(&mut self, shifts: &mut Rows) -> usize {
        self.particles.aux.fill(0.0);
        shifts.clear();
        self.openings.fill(0.0);
        self.descent.begin(&self.particles.aux);
        for iteration in 0..self.solver.max_iterations {
            let (sites, openings) = (self.sites, &*self.openings);
            let left = |i: usize| sites[i].excess - openings[i];
            if violation(&self.particles.aux, sites, left) <= DENSITY_ERROR {
                return iteration;
            }
            self.descent.advance(&mut self.particles.aux, sites, (1.0, f32::INFINITY), left);
            self.try_shifts(shifts);
        }
        self.solver.max_iterations
    }

    /// Shifts by the unknowns in `aux`, and how room opens with them.
    fn try_shifts(&mut self, shifts: &mut Rows) {
        let Self { solver, around, particles, sites, .. } = self;
        particles.refresh_images();
        sweep(around.pass(particles), Spread { solver, sites }, shifts, self.scratch, &mut []);
        for (i, &[x, y, z, _]) in shifts.iter().enumerate() {
            (particles.lx[i], particles.ly[i], particles.lz[i]) = (x, y, z);
        }
        self.find_openings(Walls::Still);
    }
}

impl Dfsph {
    /// Place and unknown of a particle.
    fn unknown(&self, p: &Particles, i: usize) -> Record {
        let [x, y, z] = self.sums.scaled(p, i);
        [x, y, z, p.aux[i], 0.0, 0.0, 0.0, 0.0]
    }
}

/// Adds to Σ f (P_i + P_j) d; `i`, `j`: place, P.
#[inline(always)]
fn add_push<S: Simd>(simd: S, i: &[S::f32s; 4], j: &[S::f32s; 4], sum: &mut [S::f32s; 3]) {
    let (d, _, f) = site::slope(simd, [i[0], i[1], i[2]], [j[0], j[1], j[2]]);
    add_scaled(simd, sum, simd.mul_f32s(f, simd.add_f32s(i[3], j[3])), d);
}

/// Rows of [acceleration without gravity under the pressures in `aux`, m/s², –].
#[derive(Clone, Copy)]
pub(super) struct Push<'a> {
    pub solver: &'a Dfsph,
    pub sites: &'a [Site],
}

impl RowPass<4, 3> for Push<'_> {
    type Row = [f32; 4];

    fn record(self, p: &Particles, i: usize) -> Record {
        self.solver.unknown(p, i)
    }

    #[inline(always)]
    fn pair<S: Simd>(self, simd: S, i: &[S::f32s; 4], j: &[S::f32s; 4], sums: &mut [S::f32s; 3]) {
        add_push(simd, i, j, sums);
    }

    fn row(self, pass: &Pass<'_>, i: usize, sums: [f32; 3], loads: &mut [BodyLoad]) -> [f32; 4] {
        let (s, site, p) = (&self.solver.sums, &self.sites[i], pass.particles.aux[i]);
        let fluid = Vec3::from(sums) * (s.support * s.scale);
        let slope = fluid - 2.0 * p * site.crowding;
        let a = site.steady - fluid - 2.0 * p * site.shore.inward + site.shore.hidden(slope);
        if s.two_way && !loads.is_empty() && site.relief > 0.0 {
            self.load(pass, i, slope, loads);
        }
        [a.x, a.y, a.z, 0.0]
    }
}

impl Push<'_> {
    /// Loads the bodies with what particle `i` gets from them.
    fn load(self, pass: &Pass<'_>, i: usize, slope: Vec3, loads: &mut [BodyLoad]) {
        let (s, p, shore) = (&self.solver.sums, pass.particles, &self.sites[i].shore);
        for (m, terms) in pass.meetings.of(i) {
            let Some(body) = m.body else { continue };
            let mirrored = 2.0 * p.aux[i] * shore.share(terms) * terms.gradient * m.contact.normal;
            let push = shore.hidden_by(self.solver.gravity, m, terms, slope) - mirrored;
            let drag = s.friction(m, terms, p.velocity(i));
            loads[body].react(push * s.mass, drag * s.mass, m.contact.arm);
        }
    }
}

/// Rows of [shift by the unknowns in `aux`, m, –].
#[derive(Clone, Copy)]
struct Spread<'a> {
    solver: &'a Dfsph,
    sites: &'a [Site],
}

impl RowPass<4, 3> for Spread<'_> {
    type Row = [f32; 4];

    fn record(self, p: &Particles, i: usize) -> Record {
        self.solver.unknown(p, i)
    }

    #[inline(always)]
    fn pair<S: Simd>(self, simd: S, i: &[S::f32s; 4], j: &[S::f32s; 4], sums: &mut [S::f32s; 3]) {
        add_push(simd, i, j, sums);
    }

    fn row(self, pass: &Pass<'_>, i: usize, sums: [f32; 3], _: &mut [BodyLoad]) -> [f32; 4] {
        let (s, site) = (&self.solver.sums, &self.sites[i]);
        if site.relief == 0.0 {
            return [0.0; 4];
        }
        let fluid = Vec3::from(sums) * (s.support * s.scale);
        let shift = -fluid - pass.particles.aux[i] * site.shore.inward;
        [shift.x, shift.y, shift.z, 0.0]
    }
}

/// What walls are in the sum of a divergence.
#[derive(Clone, Copy)]
pub(super) enum Walls {
    /// Mirrors of the fluid that move with the walls: for velocities.
    Mirrors,
    /// At rest and nothing else: for shifts.
    Still,
}

/// Divergence of the vectors in `lx`, `ly`, `lz`: of velocities, 1/s, or of shifts.
#[derive(Clone, Copy)]
pub(super) struct Opening<'a> {
    pub solver: &'a Dfsph,
    pub sites: &'a [Site],
    pub walls: Walls,
}

impl RowPass<6, 6> for Opening<'_> {
    type Row = f32;

    fn record(self, p: &Particles, i: usize) -> Record {
        let [x, y, z] = self.solver.sums.scaled(p, i);
        [x, y, z, p.lx[i], p.ly[i], p.lz[i], 0.0, 0.0]
    }

    /// The slope of the vectors: its diagonal, and the sums of what stands across it.
    #[inline(always)]
    fn pair<S: Simd>(self, simd: S, i: &[S::f32s; 6], j: &[S::f32s; 6], sums: &mut [S::f32s; 6]) {
        let (d, _, f) = site::slope(simd, [i[0], i[1], i[2]], [j[0], j[1], j[2]]);
        let [u, v, w] = difference(simd, [i[3], i[4], i[5]], [j[3], j[4], j[5]]);
        let [x, y, z] = d.map(|d| simd.mul_f32s(f, d));
        let [xx, yy, zz, yz, zx, xy] = sums;
        *xx = fma(simd, x, u, *xx);
        *yy = fma(simd, y, v, *yy);
        *zz = fma(simd, z, w, *zz);
        *yz = fma(simd, y, w, fma(simd, z, v, *yz));
        *zx = fma(simd, z, u, fma(simd, x, w, *zx));
        *xy = fma(simd, x, v, fma(simd, y, u, *xy));
    }

    fn row(self, pass: &Pass<'_>, i: usize, sums: [f32; 6], _: &mut [BodyLoad]) -> f32 {
        let (s, p, shore) = (&self.solver.sums, pass.particles, &self.sites[i].shore);
        let [xx, yy, zz, ..] = sums;
        let towards = shore.inward.dot(Vec3::new(p.lx[i], p.ly[i], p.lz[i]));
        let (hidden, walls) = match self.walls {
            Walls::Mirrors => (shore.hidden_opening(sums), 2.0 * (shore.shove - towards)),
            Walls::Still => (0.0, -towards),
        };
        (xx + yy + zz + hidden) * (s.support * s.scale) + walls
    }
}
