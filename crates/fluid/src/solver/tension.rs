//! Surface tension of `wcsph`: a force on the free surface by its curvature (Brackbill, Kothe & Zemach 1992,
//! doi:10.1016/0021-9991(92)90240-Y; for SPH Morris 2000, Int. J. Numer. Methods Fluids 33, 333).
//!
//! With the colour c = Σ V W, 1 deep in the fluid, n its gradient and n̂ the direction of it, inwards; d = x_j − x_i and
//! f = −W'/r V of the kernel poly6, whose gradient is the smoothest:
//!
//! ```text
//! n_i = Σ f d
//! k_i = −2 Σ |n_j| f (n̂_j − n̂_i)·d / Σ |n_j| f (d² − (n̂_i·d)²)       −div n̂, by what lies along the surface
//! a_i = 2σ/ρ₀ k_i n_i − |n_i| R
//! ```
//!
//! The integral of |n| through the fluid's side of a surface is a half: hence 2σ. Neighbours count by how much they
//! lie in the surface, so that deep in the fluid nothing is felt of their disorder.
//!
//! Forces that are found one by one do not sum to nothing. Over a closed surface they must; where it ends on a
//! solid, to what it pulls the solid with: σ for each metre of the edge, along the surface, which is the stress
//! 2σ|n| (I − n̂n̂) over the part of the neighbourhood that is solid. R takes what is left over from all of the
//! surface, so that momentum is exact. Solids continue the colour as planes do: the angle of contact is 90°.

use super::{Pass, Record, RowPass, Rows, Scratch, sweep};
use crate::body::BodyLoad;
use crate::lanes::{add_scaled, difference, dot, fma};
use crate::particles::Particles;
use crate::solids::Meeting;
use crate::{FluidConfig, Solver, kernel};
use glam::{DVec3, Vec3};
use pulp::Simd;

/// Constants of one configuration.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Tension {
    support: f32,
    inverse_support: f32,
    /// Scale of n by sums in supports, 1/m.
    scale: f32,
    /// Largest curvature: that of a ball of one spacing's radius, 1/m.
    sharpest: f32,
    /// 2σ/ρ₀, m³/s².
    strength: f32,
    mass: f32,
    two_way: bool,
}

/// Acceleration of a particle, m/s².
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Pull {
    /// By the curvature of the surface.
    pub curvature: Vec3,
    /// By the solids that the surface ends on.
    pub edge: Vec3,
}

impl Tension {
    /// None where there is none.
    pub fn new(config: &FluidConfig) -> Option<Self> {
        let s = &config.settings;
        let (dx, h) = (s.spacing, s.support_length());
        let volume = dx.powi(3) / kernel::poly6_lattice_moment(dx, h);
        (s.surface_tension > 0.0 && s.solver == Solver::Wcsph).then(|| Self {
            support: h as f32,
            inverse_support: (1.0 / h) as f32,
            scale: (-kernel::poly6_slope_over_r(0.0, h) * volume * h) as f32,
            sharpest: (2.0 / dx) as f32,
            strength: (2.0 * s.surface_tension / s.rest_density) as f32,
            mass: s.particle_mass() as f32,
            two_way: s.two_way,
        })
    }

    /// Rows of [n̂, |n| 1/m].
    pub fn normals(&self, pass: Pass<'_>, scratch: &mut Scratch, rows: &mut Rows) {
        sweep(pass, Normals(self), rows, scratch, &mut []);
    }

    /// What the surface does to each particle; adds the bodies' loads.
    pub fn pulls(
        &self,
        pass: Pass<'_>,
        normals: &Rows,
        scratch: &mut Scratch,
        pulls: &mut Vec<Pull>,
        loads: &mut [BodyLoad],
    ) {
        sweep(pass, Pulls { tension: self, normals }, pulls, scratch, loads);
    }

    /// Adds it to the accelerations, less what is left over.
    pub fn add(&self, particles: &Particles, normals: &Rows, pulls: &[Pull], rows: &mut Rows) {
        let real = || (0..pulls.len()).filter(|&i| !particles.is_image(i));
        let surface: f64 = real().map(|i| f64::from(normals[i][3])).sum();
        let left: DVec3 = real().map(|i| (pulls[i].curvature - pulls[i].edge).as_dvec3()).sum();
        let rest = (left / surface.max(f64::MIN_POSITIVE)).as_vec3();
        for (row, (pull, normal)) in rows.iter_mut().zip(pulls.iter().zip(normals)) {
            let a = pull.curvature - normal[3] * rest;
            (row[0], row[1], row[2]) = (row[0] + a.x, row[1] + a.y, row[2] + a.z);
        }
    }

    /// Place of a particle in supports.
    fn scaled(&self, p: &Particles, i: usize) -> [f32; 3] {
        (p.position(i) * self.inverse_support).into()
    }

    /// What a solid gives to n, 1/m.
    fn face(&self, met: &Meeting) -> Vec3 {
        let gradient = kernel::poly6_plane_gradient(met.contact.distance.into(), self.support.into());
        gradient as f32 * met.contact.normal
    }

    /// Curvature by how the normals turn along the surface, 1/m; 0 where nobody lies along it.
    fn curvature(&self, turn: f32, along: f32) -> f32 {
        let curvature = -2.0 * turn / along * self.inverse_support;
        if curvature.is_finite() { curvature.clamp(-self.sharpest, self.sharpest) } else { 0.0 }
    }
}

/// f of pairs, of 1 at distance 0; d in supports.
#[inline(always)]
fn slope<S: Simd>(simd: S, d: [S::f32s; 3]) -> S::f32s {
    let t = simd.max_f32s(simd.sub_f32s(simd.splat_f32s(1.0), dot(simd, d, d)), simd.splat_f32s(0.0));
    simd.mul_f32s(t, t)
}

#[derive(Clone, Copy)]
struct Normals<'a>(&'a Tension);

impl RowPass<3, 3> for Normals<'_> {
    type Row = [f32; 4];

    fn record(self, p: &Particles, i: usize) -> Record {
        let [x, y, z] = self.0.scaled(p, i);
        [x, y, z, 0.0, 0.0, 0.0, 0.0, 0.0]
    }

    #[inline(always)]
    fn pair<S: Simd>(self, simd: S, i: &[S::f32s; 3], j: &[S::f32s; 3], sums: &mut [S::f32s; 3]) {
        let d = difference(simd, *i, *j);
        add_scaled(simd, sums, slope(simd, d), d);
    }

    fn row(self, pass: &Pass<'_>, i: usize, sums: [f32; 3], _: &mut [BodyLoad]) -> [f32; 4] {
        let solid: Vec3 = pass.meetings.of(i).iter().map(|(met, _)| self.0.face(met)).sum();
        let n = Vec3::from(sums) * self.0.scale + solid;
        let [x, y, z] = n.normalize_or_zero().into();
        [x, y, z, n.length()]
    }
}

#[derive(Clone, Copy)]
struct Pulls<'a> {
    tension: &'a Tension,
    normals: &'a Rows,
}

impl RowPass<7, 2> for Pulls<'_> {
    type Row = Pull;

    fn record(self, p: &Particles, i: usize) -> Record {
        let ([x, y, z], [nx, ny, nz, size]) = (self.tension.scaled(p, i), self.normals[i]);
        [x, y, z, nx, ny, nz, size, 0.0]
    }

    /// Sums of how the normals turn, and of what they turn over.
    #[inline(always)]
    fn pair<S: Simd>(self, simd: S, i: &[S::f32s; 7], j: &[S::f32s; 7], sums: &mut [S::f32s; 2]) {
        let (ni, nj) = ([i[3], i[4], i[5]], [j[3], j[4], j[5]]);
        let d = difference(simd, [i[0], i[1], i[2]], [j[0], j[1], j[2]]);
        let weight = simd.mul_f32s(slope(simd, d), j[6]);
        let turn = dot(simd, difference(simd, ni, nj), d);
        let across = dot(simd, ni, d);
        let along = simd.sub_f32s(dot(simd, d, d), simd.mul_f32s(across, across));
        *sums = [fma(simd, weight, turn, sums[0]), fma(simd, weight, along, sums[1])];
    }

    fn row(self, pass: &Pass<'_>, i: usize, [turn, along]: [f32; 2], loads: &mut [BodyLoad]) -> Pull {
        let (t, [x, y, z, size]) = (self.tension, self.normals[i]);
        let normal = Vec3::new(x, y, z);
        let curvature = t.strength * size * t.curvature(turn, along) * normal;
        let mut edge = Vec3::ZERO;
        for (met, _) in pass.meetings.of(i) {
            let face = t.face(met);
            let pull = 2.0 * t.strength * size * (face - normal * normal.dot(face));
            edge += pull;
            if let (true, Some(body)) = (t.two_way, met.body) {
                loads[body].react(pull * t.mass, Vec3::ZERO, met.contact.arm);
            }
        }
        Pull { curvature, edge }
    }
}
