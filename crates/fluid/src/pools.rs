//! Filling room with particles: pools at rest at the start, and the fluid itself at another spacing.

use crate::body::{Body, BodyNow};
use crate::particles::{Newborn, Particles};
use crate::periodic::Periodic;
use crate::solids::Solids;
use crate::{Aabb, FluidConfig, FluidError, Solver, restack};
use glam::{DVec3, IVec3, Vec3};
use std::collections::BTreeMap;

/// Particles stand off the lattice by up to this share of the spacing: a perfect lattice has no side forces,
/// and would hide them.
const JITTER: f32 = 0.02;

/// Least distance of a particle from a round wall at the start, in spacings.
const CLEARANCE: f64 = 0.2;

/// The pools of `config`, at rest under hydrostatic pressure, without what the bodies take up.
pub(crate) fn fill(config: &FluidConfig) -> Result<Vec<Newborn>, FluidError> {
    let spacing = config.settings.spacing;
    let wanted: f64 =
        config.world.pools.iter().map(|b| lattice(b, spacing).0.as_dvec3().element_product()).sum();
    check_count(wanted, config)?;
    let periodic = Periodic::new(&config.world);
    let bodies: Vec<_> = config
        .world
        .bodies
        .iter()
        .cloned()
        .enumerate()
        .map(|(k, b)| BodyNow::new((k, &Body::new(b)), spacing, periodic))
        .collect();
    // A pool is a box: a round container takes its corners away.
    let room = CLEARANCE * spacing;
    let cut_off = |p: Vec3| config.world.container.is_some_and(|c| c.cuts_off(p.as_dvec3(), room));
    let free = |p: Vec3| bodies.iter().all(|b| b.contact(p, 0.0).is_none()) && !cut_off(p);
    let mut random = Random::new(config.world.seed);
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

/// Refuses to fill `wanted` particles where there may be fewer.
fn check_count(wanted: f64, config: &FluidConfig) -> Result<(), FluidError> {
    let (needed, allowed) = (wanted as usize, config.settings.max_particles);
    if needed > allowed { Err(FluidError::TooManyParticles { needed, allowed }) } else { Ok(()) }
}

/// Refuses a spacing at which a fluid of `count` particles would be more particles than there may be.
pub(crate) fn check_spacing(count: usize, old_spacing: f64, config: &FluidConfig) -> Result<(), FluidError> {
    if config.settings.spacing >= old_spacing {
        return Ok(());
    }
    check_count((count as f64 * (old_spacing / config.settings.spacing).powi(3)).round(), config)
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
    fn new(seed: u32) -> Self {
        // The state of this generator is never zero.
        Self(seed.wrapping_mul(0x85EB_CA6B) ^ 0x9E37_79B9 | 1)
    }

    /// The next of a fixed sequence, −1..1 (xorshift, Marsaglia 2003, doi:10.18637/jss.v008.i14).
    fn next(&mut self) -> f32 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 17;
        self.0 ^= self.0 << 5;
        (self.0 >> 8) as f32 / (1 << 23) as f32 - 1.0
    }
}

/// What the old particles leave at a site of the new lattice.
#[derive(Clone, Copy, Default)]
struct Deposit {
    /// Share of the site's cube that they fill.
    filled: f32,
    velocity: Vec3,
    age: f32,
    held: f32,
}

/// The same fluid at the spacing of `config`: as many particles as hold the same volume, on the sites of a lattice
/// that the old ones' cubes fill best, with their mean motion. Where there are too few sites, some stand
/// double, for `restack`.
pub(crate) fn resample(
    old: &Particles,
    old_spacing: f64,
    config: &FluidConfig,
    solids: &Solids<'_>,
) -> Vec<Newborn> {
    let (spacing, corner) = (config.settings.spacing as f32, restack::corner(config));
    let place = |key: &[i32; 3]| corner + (IVec3::new(key[2], key[0], key[1]).as_vec3() + 0.5) * spacing;
    let field = deposit(old, old_spacing as f32, spacing, corner);
    let mut sites: Vec<_> =
        field.iter().filter(|(key, _)| restack::is_free(place(key), spacing, solids)).collect();
    // The fullest first; equal ones in order of height, so that a surface stays level.
    sites.sort_by(|a, b| b.1.filled.total_cmp(&a.1.filled).then(a.0.cmp(b.0)));
    let volume = old.len() as f64 * (old_spacing / config.settings.spacing).powi(3);
    let count = volume.round() as usize;
    let born = |(key, d): &(&[i32; 3], &Deposit)| Newborn {
        position: place(key),
        velocity: d.velocity / d.filled,
        age: d.age / d.filled,
        held: d.held / d.filled,
        ..Newborn::default()
    };
    sites.iter().cycle().take(if sites.is_empty() { 0 } else { count }).map(born).collect()
}

/// Lays each old particle's cube over the cubes of the new lattice; keys are height, z, x.
fn deposit(old: &Particles, old_spacing: f32, spacing: f32, corner: Vec3) -> BTreeMap<[i32; 3], Deposit> {
    let mut field: BTreeMap<[i32; 3], Deposit> = BTreeMap::new();
    let size = old_spacing / spacing;
    for i in 0..old.len() {
        // In units of the new lattice.
        let low = (old.position(i) - corner) / spacing - 0.5 * size;
        let high = low + size;
        let (first, last) = (low.floor().as_ivec3(), high.floor().as_ivec3());
        for (y, z, x) in keys(first, last) {
            let cell = IVec3::new(x, y, z).as_vec3();
            let share = (high.min(cell + 1.0) - low.max(cell)).max(Vec3::ZERO).element_product();
            if share > 0.0 {
                let d = field.entry([y, z, x]).or_default();
                d.filled += share;
                d.velocity += share * old.velocity(i);
                d.age += share * old.age[i];
                d.held += share * old.held[i];
            }
        }
    }
    field
}

fn keys(first: IVec3, last: IVec3) -> impl Iterator<Item = (i32, i32, i32)> {
    (first.y..=last.y)
        .flat_map(move |y| (first.z..=last.z).flat_map(move |z| (first.x..=last.x).map(move |x| (y, z, x))))
}
