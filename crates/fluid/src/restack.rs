//! Room for everybody: particles that lie in each other's room rise to where there is some.
//!
//! Without interaction a pool falls into a few layers, ten particles deep in one place. Switched on like that, it
//! bursts at any step length. So before forces resume, from the floor up, each cell of two spacings keeps eight
//! particles on its sites and hands the rest to the cell above. Velocities stay; the energy of height that it
//! takes is what the fall had given.

use crate::FluidConfig;
use crate::particles::Particles;
use crate::solids::Solids;
use glam::{IVec3, Vec3};
use std::collections::BTreeMap;

/// Highest cell; a guard, far above any container.
const TOP: i32 = 10_000;

/// Cells in order of height, then z, then x.
type Cells = BTreeMap<[i32; 3], Vec<u32>>;

/// Spreads crowded particles.
pub(crate) fn restack(particles: &mut Particles, config: &FluidConfig, solids: &Solids<'_>) {
    let lattice = Lattice::new(config);
    let mut cells = Cells::new();
    for i in 0..particles.len() {
        let c = lattice.cell(particles.position(i));
        cells.entry([c.y, c.z, c.x]).or_default().push(i as u32);
    }
    while let Some(([y, z, x], mut here)) = cells.pop_first() {
        let sites = lattice.sites(IVec3::new(x, y, z), solids);
        let newcomers = here.iter().any(|&i| lattice.cell(particles.position(i as usize)).y < y);
        if (here.len() <= sites.len() && !newcomers) || y >= TOP {
            continue;
        }
        // The lowest stay.
        here.sort_by(|&a, &b| particles.y[a as usize].total_cmp(&particles.y[b as usize]));
        let rest = here.split_off(sites.len().min(here.len()));
        for (&i, &site) in here.iter().zip(&sites) {
            particles.set_position(i as usize, site);
        }
        if !rest.is_empty() {
            cells.entry([y + 1, z, x]).or_default().extend(rest);
        }
    }
}

/// Whether a particle may be put at `p`: not in a solid, nor too close before one.
pub(crate) fn is_free(p: Vec3, spacing: f32, solids: &Solids<'_>) -> bool {
    let mut free = true;
    solids.visit(p, 0.2 * spacing, |_| free = false);
    free
}

/// Where lattices of particles are laid: on the floor, into the container's corner.
pub(crate) fn corner(config: &FluidConfig) -> Vec3 {
    let floor = Vec3::Y * config.world.ground.unwrap_or(0.0) as f32;
    config.world.container.map_or(floor, |c| c.inner.min.as_vec3())
}

/// Cells of two spacings.
struct Lattice {
    corner: Vec3,
    spacing: f32,
}

impl Lattice {
    fn new(config: &FluidConfig) -> Self {
        Self { corner: corner(config), spacing: config.settings.spacing as f32 }
    }

    fn cell(&self, position: Vec3) -> IVec3 {
        ((position - self.corner) / (2.0 * self.spacing)).floor().as_ivec3()
    }

    /// Up to eight places in a cell, the lower four first, none in a solid.
    fn sites(&self, cell: IVec3, solids: &Solids<'_>) -> Vec<Vec3> {
        let place = |k: u8| {
            let bit = |n: u8| f32::from(k >> n & 1);
            let within = (Vec3::new(bit(0), bit(2), bit(1)) + 0.5) * self.spacing;
            self.corner + cell.as_vec3() * (2.0 * self.spacing) + within
        };
        (0..8).map(place).filter(|p| is_free(*p, self.spacing, solids)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::BodyTables;
    use crate::particles::Newborn;
    use crate::solids::Walls;
    use crate::wall::WallTable;
    use crate::{Aabb, FluidSettings, World};
    use glam::DVec3;

    #[test]
    fn a_heap_becomes_a_stack_of_the_same_particles() {
        let inner = Aabb { min: DVec3::ZERO, max: DVec3::new(0.04, 1.0, 0.04) };
        let world = World {
            bounds: Aabb { min: DVec3::splat(-1.0), max: DVec3::splat(1.0) },
            container: Some(crate::Container::open_box(inner)),
            ..World::default()
        };
        let settings = FluidSettings { spacing: 0.01, ..FluidSettings::default() };
        let config = FluidConfig { settings, world, frame_hz: 100.0, threads: 1 };
        let mut particles = Particles::new();
        particles.extend(&[Newborn { position: Vec3::splat(0.005), ..Newborn::default() }; 100]);
        let (walls, plane) =
            (Walls::new(&config.world, &config.settings), WallTable::plane(config.settings.kernel, 0.027));
        let tables = BodyTables::new(&[], crate::Kernel::Wendland, 0.027);
        let solids = Solids { walls: &walls, bodies: &[], plane: &plane, tables: &tables };
        restack(&mut particles, &config, &solids);
        for i in 0..100 {
            for j in 0..i {
                assert!(particles.position(i).distance(particles.position(j)) > 0.0099);
            }
        }
        let before: Vec<_> = (0..100).map(|i| particles.position(i)).collect();
        restack(&mut particles, &config, &solids);
        assert!((0..100).all(|i| particles.position(i) == before[i]), "a stack stays as it is");
    }
}
