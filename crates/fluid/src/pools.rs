//! Filling room with particles: pools at rest at the start, and the fluid itself at another spacing.

use crate::body::{Body, BodyNow};
use crate::particles::{Newborn, Particles};
use crate::{Aabb, FluidConfig, FluidError, Solver, kernel};
use glam::{DVec3, Vec3};
use std::collections::BTreeMap;

/// Particles stand off the lattice by up to this share of the spacing: a perfect lattice has no side forces,
/// and would hide them.
const JITTER: f32 = 0.02;

/// The pools of `config`, at rest under hydrostatic pressure, without what the bodies take up.
pub(crate) fn fill(config: &FluidConfig) -> Result<Vec<Newborn>, FluidError> {
    let spacing = config.settings.spacing;
    let wanted: f64 =
        config.world.pools.iter().map(|b| lattice(b, spacing).0.as_dvec3().element_product()).sum();
    let (needed, allowed) = (wanted as usize, config.settings.max_particles);
    if needed > allowed {
        return Err(FluidError::TooManyParticles { needed, allowed });
    }
    let bodies: Vec<_> = config.world.bodies.iter().map(|&b| BodyNow::new(&Body::new(b), spacing)).collect();
    let free = |p: Vec3| bodies.iter().all(|b| b.contact(p, 0.0).is_none());
    let mut random = Random(0x9E37_79B9);
    let mut out = Vec::new();
    for pool in &config.world.pools {
        let (count, step) = lattice(pool, spacing);
        for point in points(count) {
            let jitter = Vec3::new(random.next(), random.next(), random.next()) * JITTER * spacing as f32;
            let position = (pool.min + point * step).as_vec3() + jitter;
            if free(position) {
                out.push(Newborn {
                    position,
                    pressure: hydrostatic(config, pool, position),
                    ..Newborn::default()
                });
            }
        }
    }
    Ok(out)
}

/// Points along each axis and their distances.
fn lattice(pool: &Aabb, spacing: f64) -> (glam::UVec3, DVec3) {
    let size = pool.max - pool.min;
    let count = (size / spacing).round().max(DVec3::ONE);
    (count.as_uvec3(), size / count)
}

/// Cell centres of a lattice, in units of its step.
fn points(count: glam::UVec3) -> impl Iterator<Item = DVec3> {
    (0..count.z).flat_map(move |z| {
        (0..count.y).flat_map(move |y| (0..count.x).map(move |x| glam::UVec3::new(x, y, z).as_dvec3() + 0.5))
    })
}

/// `wcsph` starts with the pressure that it would settle to; `muller` makes its own.
fn hydrostatic(config: &FluidConfig, pool: &Aabb, position: Vec3) -> f32 {
    if config.settings.solver == Solver::Muller {
        return 0.0;
    }
    let depth = pool.max.y - f64::from(position.y);
    (-config.settings.gravity.y * depth).max(0.0) as f32
}

struct Random(u32);

impl Random {
    /// The next of a fixed sequence, −1..1 (xorshift, Marsaglia 2003, doi:10.18637/jss.v008.i14).
    fn next(&mut self) -> f32 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 17;
        self.0 ^= self.0 << 5;
        (self.0 >> 8) as f32 / (1 << 23) as f32 - 1.0
    }
}

/// The same fluid at another spacing: lattice points where the old particles fill at least half of a kernel,
/// with their mean velocity. At most `most` points.
pub(crate) fn resample(old: &Particles, old_spacing: f64, spacing: f64, most: usize) -> Vec<Newborn> {
    let h = 2.0 * old_spacing.max(spacing);
    let volume = old_spacing.powi(3);
    let mut field: BTreeMap<[i32; 3], (f64, DVec3)> = BTreeMap::new();
    let reach = (h / spacing).ceil() as i32;
    for i in 0..old.len() {
        let (x, v) = (old.position(i).as_dvec3(), old.velocity(i).as_dvec3());
        let home = (x / spacing).floor().as_ivec3();
        for offset in cube(reach) {
            let key = home + offset;
            let r = ((key.as_dvec3() + 0.5) * spacing).distance(x);
            let weight = volume * kernel::wendland(r, h);
            if weight > 0.0 {
                let entry = field.entry(key.to_array()).or_default();
                entry.0 += weight;
                entry.1 += v * weight;
            }
        }
    }
    let filled = field.iter().filter(|(_, (weight, _))| *weight > 0.5).take(most);
    filled
        .map(|(key, (weight, momentum))| Newborn {
            position: ((glam::IVec3::from(*key).as_dvec3() + 0.5) * spacing).as_vec3(),
            velocity: (*momentum / *weight).as_vec3(),
            ..Newborn::default()
        })
        .collect()
}

fn cube(reach: i32) -> impl Iterator<Item = glam::IVec3> {
    let span = -reach..=reach;
    let plane = move |z| {
        let row = -reach..=reach;
        row.flat_map(move |y| (-reach..=reach).map(move |x| glam::IVec3::new(x, y, z)))
    };
    span.flat_map(plane)
}
