//! Implicit viscosity of `wcsph`, where the explicit one would need steps far shorter than sound does.
//!
//! The velocities at the end of the step are those whose own friction leads to them (backward Euler):
//!
//! ```text
//! v − dt ν (L v + Σ F (I − n n)(v_wall − v)) = v*          v*: by all other forces, F: friction over distance
//! ```
//!
//! with the solver's own viscous sum L and its own friction F at walls (see `wcsph.rs` and `wall.rs`). Both are
//! symmetric, so conjugate gradients find them (Hestenes & Stiefel 1952, doi:10.6028/jres.049.044), from the velocities
//! before, by passes over the neighbours and without a matrix; the diagonal is the preconditioner, that of a full
//! neighbourhood. What the last step leaves unsolved is spread evenly over all, so that the fluid's momentum changes by what
//! the walls give, and by nothing else.

use super::{Pass, Record, RowPass, Rows, Scratch, sweep};
use crate::body::BodyLoad;
use crate::lanes::{add_scaled, difference, dot};
use crate::pair_kernel::{PairKernel, apart, with_kernel};
use crate::particles::Particles;
use crate::solids::Meeting;
use crate::wall::WallTerms;
use crate::{FluidConfig, Kernel, Solver, limits};
use glam::{DVec3, Vec3};
use pulp::Simd;

/// How many times longer the acoustic step must be than the explicit viscous one.
const STIFF: f64 = 3.0;
/// Residual over the velocities, in the mean square, at which they are found.
const TOLERANCE: f64 = 1e-5;
/// Most iterations.
const ITERATIONS: usize = 200;

/// Constants of one configuration.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Viscosity {
    kernel: Kernel,
    support: f32,
    /// Scale of the viscous sum.
    scale: f32,
    /// Kinematic viscosity, m²/s.
    viscosity: f32,
    least_distance: f32,
    gravity: Vec3,
    mass: f32,
    two_way: bool,
}

/// Room for the solution: velocities, residuals, directions and what the matrix makes of them.
#[derive(Debug, Default)]
pub(crate) struct Room {
    x: Rows,
    r: Rows,
    p: Rows,
    mp: Rows,
}

/// Whether the viscosity of `config` is solved for.
pub(crate) fn is_implicit(config: &FluidConfig) -> bool {
    let s = &config.settings;
    let explicit =
        limits::EXPLICIT_VISCOSITY * s.support_length().powi(2) / s.kinematic_viscosity().max(1e-12);
    s.solver == Solver::Wcsph && STIFF * explicit < limits::COURANT * s.spacing / config.sound_speed()
}

impl Viscosity {
    /// None where it is explicit.
    pub fn new(config: &FluidConfig) -> Option<Self> {
        let s = &config.settings;
        let (dx, h) = (s.spacing, s.support_length());
        let volume = dx.powi(3) / s.kernel.lattice_moment(dx, h);
        is_implicit(config).then(|| Self {
            kernel: s.kernel,
            support: h as f32,
            scale: (s.kernel.viscous_factor() * s.kernel.gradient_scale(h) * volume) as f32,
            viscosity: s.kinematic_viscosity() as f32,
            least_distance: super::wcsph::LEAST_DISTANCE * dx as f32,
            gravity: s.gravity.as_vec3(),
            mass: s.particle_mass() as f32,
            two_way: s.two_way,
        })
    }

    /// Adds the friction to the accelerations `rows` over a step `dt` (s), and to the loads. False if it was not found
    /// to the tolerance; what is not a number at all is left out.
    pub fn solve(
        &self,
        pass: Pass<'_>,
        dt: f32,
        room: &mut Room,
        scratch: &mut Scratch,
        rows: &mut Rows,
        loads: &mut [BodyLoad],
    ) -> bool {
        let system = System { viscosity: self, pass, weight: dt * self.viscosity };
        let found = system.find(dt, room, scratch, rows);
        if system.product(&room.x, &room.r, |_| 1.0).is_finite() {
            system.finish(dt, room, rows, loads);
        }
        found
    }
}

/// The system of one step.
#[derive(Clone, Copy)]
struct System<'a> {
    viscosity: &'a Viscosity,
    pass: Pass<'a>,
    /// dt ν, m².
    weight: f32,
}

impl System<'_> {
    /// Whether the velocity of `i` is sought: not of images, and not of what its source leads.
    fn is_sought(&self, i: usize) -> bool {
        !self.pass.particles.is_image(i) && self.pass.particles.held[i] <= 0.0
    }

    /// Σ w a·b over what is sought.
    fn product(&self, a: &Rows, b: &Rows, weight: impl Fn(usize) -> f32) -> f64 {
        let each = |i: usize| {
            let ([ax, ay, az, _], [bx, by, bz, _]) = (a[i], b[i]);
            f64::from(weight(i) * (ax * bx + ay * by + az * bz))
        };
        (0..a.len()).filter(|&i| self.is_sought(i)).map(each).sum()
    }

    /// Friction over distance at a wall, 1/m².
    fn friction(&self, met: &Meeting, terms: &WallTerms) -> f32 {
        terms.friction / met.contact.distance.max(self.viscosity.least_distance)
    }

    /// Σ F (I − n n) v over the walls that `i` meets.
    fn at_walls(&self, i: usize, velocity: impl Fn(&Meeting) -> Vec3) -> Vec3 {
        let met = self.pass.meetings.of(i).iter();
        met.map(|(m, terms)| {
            let (v, n) = (velocity(m), m.contact.normal);
            self.friction(m, terms) * (v - v.dot(n) * n)
        })
        .sum()
    }

    /// The diagonal.
    fn diagonal(&self, i: usize) -> f32 {
        let v = self.viscosity;
        let full = v.kernel.viscous_factor() as f32 / (v.support * v.support);
        let walls: f32 = self.pass.meetings.of(i).iter().map(|(m, terms)| self.friction(m, terms)).sum();
        1.0 + self.weight * (full + walls)
    }

    /// What the matrix makes of `of`, images included.
    fn apply(&self, of: &mut Rows, scratch: &mut Scratch, result: &mut Rows) {
        self.pass.particles.copy_to_images(of);
        let system = *self;
        with_kernel!(self.viscosity.kernel, |kernel| {
            sweep(self.pass, Apply { system, kernel, of }, result, scratch, &mut [])
        });
    }

    /// Finds the velocities by conjugate gradients.
    fn find(&self, dt: f32, room: &mut Room, scratch: &mut Scratch, rows: &Rows) -> bool {
        let Room { x, r, p, mp } = room;
        let enough = TOLERANCE.powi(2) * self.start(dt, x, r, rows, scratch, mp);
        p.clear();
        p.resize(r.len(), [0.0; 4]);
        let mut last = f64::INFINITY;
        for _ in 0..ITERATIONS {
            let rest = self.product(r, r, |_| 1.0);
            if rest <= enough || !rest.is_finite() {
                return rest.is_finite();
            }
            let next = self.product(r, r, |i| 1.0 / self.diagonal(i));
            let step = (next / last) as f32;
            for (i, (p, r)) in p.iter_mut().zip(r.iter()).enumerate() {
                let z = 1.0 / self.diagonal(i);
                (0..3).for_each(|a| p[a] = z * r[a] + step * p[a]);
            }
            self.apply(p, scratch, mp);
            let along = next / self.product(p, mp, |_| 1.0);
            for (((x, r), p), mp) in x.iter_mut().zip(r.iter_mut()).zip(p.iter()).zip(mp.iter()) {
                (0..3).for_each(|a| x[a] += along as f32 * p[a]);
                (0..3).for_each(|a| r[a] -= along as f32 * mp[a]);
            }
            last = next;
        }
        false
    }

    /// Starts from the velocities before. The size of the right side, squared.
    fn start(
        &self,
        dt: f32,
        x: &mut Rows,
        r: &mut Rows,
        rows: &Rows,
        scratch: &mut Scratch,
        mx: &mut Rows,
    ) -> f64 {
        let p = self.pass.particles;
        x.clear();
        x.extend((0..p.len()).map(|i| p.velocity(i).extend(0.0).to_array()));
        self.apply(x, scratch, mx);
        r.clear();
        r.resize(p.len(), [0.0; 4]);
        let mut size = 0.0;
        for i in (0..p.len()).filter(|&i| self.is_sought(i)) {
            let [ax, ay, az, _] = rows[i];
            let others = p.velocity(i) + dt * (Vec3::new(ax, ay, az) + self.viscosity.gravity);
            let right = others + self.weight * self.at_walls(i, |m| m.contact.velocity);
            size += f64::from(right.length_squared());
            let [mx, my, mz, _] = mx[i];
            r[i] = (right - Vec3::new(mx, my, mz)).extend(0.0).to_array();
        }
        size
    }

    /// Turns the velocities into accelerations, and gives the bodies their friction.
    fn finish(&self, dt: f32, room: &Room, rows: &mut Rows, loads: &mut [BodyLoad]) {
        let (v, p) = (self.viscosity, self.pass.particles);
        let sought = || (0..p.len()).filter(|&i| self.is_sought(i));
        let vector = |row: &[f32; 4]| Vec3::new(row[0], row[1], row[2]);
        let left: DVec3 = sought().map(|i| vector(&room.r[i]).as_dvec3()).sum();
        let rest = (left / sought().count().max(1) as f64).as_vec3();
        for i in sought() {
            let x = vector(&room.x[i]);
            rows[i] = ((x + rest - p.velocity(i)) / dt - v.gravity).extend(0.0).to_array();
            for (met, terms) in self.pass.meetings.of(i) {
                let (slip, n) = (met.contact.velocity - x, met.contact.normal);
                let drag = v.viscosity * self.friction(met, terms) * (slip - slip.dot(n) * n);
                if let (true, Some(body)) = (v.two_way, met.body) {
                    loads[body].react(Vec3::ZERO, drag * v.mass, met.contact.arm);
                }
            }
        }
    }
}

#[derive(Clone, Copy)]
struct Apply<'a, K> {
    system: System<'a>,
    kernel: K,
    of: &'a Rows,
}

impl<K: PairKernel> RowPass<6, 3> for Apply<'_, K> {
    type Row = [f32; 4];

    fn record(self, p: &Particles, i: usize) -> Record {
        let ([x, y, z], [u, v, w, _]) = ((p.position(i) / self.system.viscosity.support).into(), self.of[i]);
        [x, y, z, u, v, w, 0.0, 0.0]
    }

    #[inline(always)]
    fn pair<S: Simd>(self, simd: S, i: &[S::f32s; 6], j: &[S::f32s; 6], sums: &mut [S::f32s; 3]) {
        let (d, r) = apart(simd, [i[0], i[1], i[2]], [j[0], j[1], j[2]]);
        let dv = difference(simd, [i[3], i[4], i[5]], [j[3], j[4], j[5]]);
        let opening = simd.mul_f32s(self.kernel.slope(simd, r), dot(simd, dv, d));
        add_scaled(simd, sums, opening, d);
    }

    fn row(self, _: &Pass<'_>, i: usize, sums: [f32; 3], _: &mut [BodyLoad]) -> [f32; 4] {
        let (s, [u, v, w, _]) = (&self.system, self.of[i]);
        if !s.is_sought(i) {
            return [0.0; 4];
        }
        let own = Vec3::new(u, v, w);
        let friction = s.at_walls(i, |_| own) - Vec3::from(sums) * s.viscosity.scale;
        (own + s.weight * friction).extend(0.0).to_array()
    }
}
