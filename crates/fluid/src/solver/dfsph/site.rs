//! What the places and velocities of one sub-step make of each particle, before its pressure is known.
//!
//! Sums over the fluid hold the part of a slope that is not in a wall. The pressure's goes on there: across the wall with
//! gravity as the moving wall feels it, along it with the fluid's own slope; and so does the velocity's along it.

use super::Dfsph;
use crate::body::BodyLoad;
use crate::lanes::{add_scaled, difference, dot};
use crate::pair_kernel::{PairKernel, Wendland, apart};
use crate::particles::Particles;
use crate::solids::Meeting;
use crate::solver::{Pass, Record, RowPass, wcsph};
use crate::wall::WallTerms;
use glam::{Mat3, Vec3};
use pulp::Simd;

/// Time in which gaps within the fluid may close, s.
const CLOSING_TIME: f32 = 0.1;
/// Below this share of a full neighbourhood a particle lies at a free surface.
const FREE_SURFACE: f32 = 0.95;
/// Largest density error that is mended in one sub-step.
const LARGEST_EXCESS: f32 = 0.02;
/// Least share of its room that a wall is said to leave to another.
const LEAST_ROOM: f32 = 0.1;

/// d, d² and f of pairs, in supports.
#[inline(always)]
pub(super) fn slope<S: Simd>(simd: S, i: [S::f32s; 3], j: [S::f32s; 3]) -> ([S::f32s; 3], S::f32s, S::f32s) {
    let (d, r2) = apart(simd, i, j);
    (d, r2, Wendland.slope(simd, r2))
}

/// What the others round a particle make of it.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Crowd {
    /// Share of its neighbourhood that fluid and walls fill.
    pub fill: f32,
    /// Share that the walls leave.
    room: f32,
    /// Σ f d, 1/m.
    crowding: Vec3,
    /// L, 1/(m s).
    pub laplacian: Vec3,
}

#[derive(Clone, Copy)]
pub(super) struct Look<'a>(pub &'a Dfsph);

impl RowPass<6, 7> for Look<'_> {
    type Row = Crowd;

    fn record(self, p: &Particles, i: usize) -> Record {
        let [x, y, z] = self.0.sums.scaled(p, i);
        [x, y, z, p.u[i], p.v[i], p.w[i], 0.0, 0.0]
    }

    #[inline(always)]
    fn pair<S: Simd>(self, simd: S, i: &[S::f32s; 6], j: &[S::f32s; 6], sums: &mut [S::f32s; 7]) {
        let (d, r2, f) = slope(simd, [i[0], i[1], i[2]], [j[0], j[1], j[2]]);
        let [fill, cx, cy, cz, laplacian @ ..] = sums;
        *fill = Wendland.add_value(simd, r2, *fill);
        let mut crowding = [*cx, *cy, *cz];
        add_scaled(simd, &mut crowding, f, d);
        [*cx, *cy, *cz] = crowding;
        let dv = difference(simd, [i[3], i[4], i[5]], [j[3], j[4], j[5]]);
        add_scaled(simd, laplacian, simd.mul_f32s(f, dot(simd, dv, d)), d);
    }

    fn row(self, pass: &Pass<'_>, i: usize, sums: [f32; 7], _: &mut [BodyLoad]) -> Crowd {
        let s = &self.0.sums;
        let [fill, cx, cy, cz, lx, ly, lz] = sums;
        let room: f32 = pass.meetings.of(i).iter().map(|(_, terms)| 1.0 - terms.volume).product();
        Crowd {
            fill: fill * s.sum_scale + 1.0 - room,
            room,
            crowding: Vec3::new(cx, cy, cz) * (s.support * s.scale),
            laplacian: Vec3::new(lx, ly, lz) * s.viscous_scale,
        }
    }
}

/// What a particle has to do in the solves.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Site {
    /// Change of its unknown for a unit of what is left over, m²; 0 where it takes no part.
    pub relief: f32,
    /// κ, 1/s.
    pub closing: f32,
    /// Share of density that is too much.
    pub excess: f32,
    /// Acceleration by friction and the noise filter, m/s².
    pub steady: Vec3,
    /// Σ f d, 1/m.
    pub crowding: Vec3,
    pub shore: Shore,
}

/// The walls that a particle meets, all together.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Shore {
    /// Share of the neighbourhood that the walls leave.
    room: f32,
    /// N, 1/m.
    pub inward: Vec3,
    /// N·e_wall, 1/s.
    pub shove: f32,
    /// Share, 0..1, to which the fluid bears on a wall: where it does not, a wall must not hold a droplet up.
    pub bearing: f32,
    /// What the sum of the pressure's slope over the fluid lacks across the walls, m/s².
    known: Vec3,
    /// Share of the moments along the walls that is counted: never so much that little would tell of all.
    counted: f32,
    /// From the slope over the fluid, and what is known across the walls, to the whole.
    whole: Mat3,
}

impl Shore {
    /// The whole slope, from its sum over the fluid.
    fn slope(&self, sum: Vec3) -> Vec3 {
        self.whole * (sum + self.known)
    }

    /// Acceleration by what all walls hide of a slope that has this sum over the fluid, m/s².
    pub fn hidden(&self, sum: Vec3) -> Vec3 {
        -self.bearing * (self.slope(sum) - sum)
    }

    /// What all walls hide of a divergence; `slope`: of the vectors' slope over the fluid the diagonal, and the sums of
    /// what stands across it.
    pub fn hidden_opening(&self, slope: [f32; 6]) -> f32 {
        let ([xx, yy, zz, yz, zx, xy], m) = (slope, &self.whole);
        let diagonal = (m.x_axis.x - 1.0) * xx + (m.y_axis.y - 1.0) * yy + (m.z_axis.z - 1.0) * zz;
        self.bearing * (diagonal + m.y_axis.z * yz + m.z_axis.x * zx + m.x_axis.y * xy)
    }

    /// The same of one of them, met with these integrals.
    pub fn hidden_by(&self, gravity: Vec3, m: &Meeting, terms: &WallTerms, sum: Vec3) -> Vec3 {
        let (n, slope) = (m.contact.normal, self.slope(sum));
        let across = (gravity - m.acceleration).dot(n) * n;
        let along = self.counted * (slope - slope.dot(n) * n);
        let moments = terms.normal_moment * across + terms.tangent_moment * along;
        -self.bearing * of_moments(self.share(terms)) * moments
    }

    /// Share of a wall's room that the others leave.
    pub fn share(&self, terms: &WallTerms) -> f32 {
        self.room / (1.0 - terms.volume).max(LEAST_ROOM)
    }
}

/// Share of its moments that a wall has of whose room the others leave `share`: of what lies behind two, each has half.
fn of_moments(share: f32) -> f32 {
    0.5 * (1.0 + share)
}

/// Rows of sites; needs the pressures of the last sub-step in `aux` and the Laplacians in `lx`, `ly`, `lz`.
#[derive(Clone, Copy)]
pub(super) struct Survey<'a> {
    pub solver: &'a Dfsph,
    pub crowds: &'a [Crowd],
    pub dt: f32,
    /// κ of the noise filter, m⁴/s.
    pub filter: f32,
}

impl RowPass<6, 3> for Survey<'_> {
    type Row = Site;

    fn record(self, p: &Particles, i: usize) -> Record {
        let [x, y, z] = self.solver.sums.scaled(p, i);
        [x, y, z, p.lx[i], p.ly[i], p.lz[i], 0.0, 0.0]
    }

    #[inline(always)]
    fn pair<S: Simd>(self, simd: S, i: &[S::f32s; 6], j: &[S::f32s; 6], sums: &mut [S::f32s; 3]) {
        let (d, _, f) = slope(simd, [i[0], i[1], i[2]], [j[0], j[1], j[2]]);
        let dl = difference(simd, [i[3], i[4], i[5]], [j[3], j[4], j[5]]);
        add_scaled(simd, sums, simd.mul_f32s(f, dot(simd, dl, d)), d);
    }

    fn row(self, pass: &Pass<'_>, i: usize, sums: [f32; 3], _: &mut [BodyLoad]) -> Site {
        let (s, p, crowd) = (&self.solver.sums, pass.particles, &self.crowds[i]);
        let filter = Vec3::from(sums) * (self.filter * s.viscous_scale);
        let friction = |(m, terms): &(Meeting, WallTerms)| s.friction(m, terms, p.velocity(i));
        Site {
            steady: s.viscosity * crowd.laplacian - filter
                + pass.meetings.of(i).iter().map(friction).sum::<Vec3>(),
            shore: self.shore(pass, i),
            ..self.duties(crowd)
        }
    }
}

impl Survey<'_> {
    /// What room a particle has and takes.
    fn duties(&self, crowd: &Crowd) -> Site {
        let fill = crowd.fill;
        let closing = if fill < self.solver.level {
            (self.solver.level - fill) / self.dt
        } else if fill < FREE_SURFACE {
            0.0
        } else {
            (1.0 - fill).max(0.0) / CLOSING_TIME
        };
        // A crowd answers as its density squared, and a particle before a wall or at a surface by its own push too.
        let stiffness = self.solver.stiffest * fill.max(1.0).powi(2) + crowd.crowding.length_squared();
        let excess = (fill - 1.0).min(LARGEST_EXCESS);
        Site { relief: 1.0 / stiffness, closing, excess, crowding: crowd.crowding, ..Site::default() }
    }

    fn shore(&self, pass: &Pass<'_>, i: usize) -> Shore {
        let (gravity, support) = (self.solver.gravity, self.solver.sums.support);
        let steep = (gravity.length() * support).max(1e-9);
        let bearing = (2.0 * pass.particles.aux[i] / steep).min(1.0);
        let mut shore = Shore { room: self.crowds[i].room, bearing, counted: 1.0, ..Shore::default() };
        let mut along = Mat3::ZERO;
        for (m, terms) in pass.meetings.of(i) {
            let (n, share) = (m.contact.normal, shore.share(terms));
            let (across, part) = (Mat3::from_cols(n.x * n, n.y * n, n.z * n), of_moments(share));
            shore.inward += share * terms.gradient * n;
            shore.shove += share * terms.gradient * n.dot(m.contact.velocity);
            shore.known += part * terms.normal_moment * (across * (gravity - m.acceleration));
            along += part * terms.tangent_moment * (Mat3::IDENTITY - across);
        }
        let (most, bound) = (along.diagonal().max_element(), 1.0 - wcsph::LEAST_FLUID);
        shore.counted = bound / most.max(bound);
        shore.whole = (Mat3::IDENTITY - along * shore.counted).inverse();
        shore
    }
}
