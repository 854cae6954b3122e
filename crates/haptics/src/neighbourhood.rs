//! The fluid round a tool, as a coupling sees it.

use glam::{DVec3, Vec3};

/// How full and how fast a fluid is at the nodes of a cubic lattice.
#[derive(Clone, Copy, Debug)]
pub struct Neighbourhood<'a> {
    /// Density of the fluid, kg/m³.
    pub density: f64,
    /// Its viscosity, Pa·s.
    pub viscosity: f64,
    /// Acceleration of gravity, m/s².
    pub gravity: DVec3,
    /// Place of the first node, m.
    pub origin: DVec3,
    /// Distance between nodes, m.
    pub spacing: f64,
    /// Nodes along an edge.
    pub side: usize,
    /// All nodes, x running first, then y, z: the share that fluid fills, and that times the velocity (m/s).
    pub nodes: &'a [[f32; 4]],
}

/// The fluid of one node.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parcel {
    /// Where it is, m.
    pub place: Vec3,
    /// Its velocity, m/s.
    pub velocity: Vec3,
    /// Its mass, kg.
    pub mass: f32,
}

impl Neighbourhood<'_> {
    /// What is not empty.
    pub fn parcels(&self) -> impl Iterator<Item = Parcel> + '_ {
        let whole = (self.density * self.spacing.powi(3)) as f32;
        let full = self.nodes.iter().enumerate().filter(|(_, node)| node[0] > 1e-3);
        full.map(move |(k, [fill, x, y, z])| Parcel {
            place: self.place(k).as_vec3(),
            velocity: Vec3::new(*x, *y, *z) / *fill,
            mass: whole * fill,
        })
    }

    /// Where node `k` is, m.
    pub fn place(&self, k: usize) -> DVec3 {
        let n = self.side;
        self.origin + self.spacing * DVec3::new((k % n) as f64, (k / n % n) as f64, (k / (n * n)) as f64)
    }
}
