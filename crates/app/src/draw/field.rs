//! The density of the fluid in space, kept only where there is fluid.

use glam::{IVec3, Vec3};

use super::kernels::Kernel;
use super::scene::Box3;
use super::solid::Solid;

/// The density at the surface; it is about 1 deep in the fluid.
pub(crate) const SURFACE: f32 = 0.5;
/// Cells along a side of a block, and nodes along a side with the shared far ones.
pub(crate) const CELLS: i32 = 8;
const NODES: usize = CELLS as usize + 1;
/// How fast the density may rise inside a wall, per cell; slow enough for the surface to lie on the wall.
const CUT: f32 = 0.3;
/// Marks a block without fluid.
const ABSENT: u32 = u32::MAX;
/// Most blocks that the table may have places for.
const MOST_PLACES: f32 = 3e6;

/// What is in a block.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Content {
    /// No fluid.
    Empty,
    /// Nothing but fluid.
    Full,
    /// Some surface: the block with this number.
    Mixed(usize),
}

/// Density and foam on a grid of nodes, in blocks.
pub(crate) struct Field {
    pub low: Vec3,
    pub cell: f32,
    /// Blocks along each axis.
    pub blocks: IVec3,
    table: Vec<u32>,
    contents: Vec<Content>,
    nodes: Vec<[f32; NODES.pow(3)]>,
    foam: Vec<[f32; NODES.pow(3)]>,
    walls: Vec<(Vec3, Vec3)>,
}

impl Field {
    /// The field of `kernels` inside the box `low` to `high`, with the fluid flush with `walls`.
    pub fn new(
        kernels: &[Kernel],
        spacing: f32,
        (low, high): (Vec3, Vec3),
        walls: &[Box3],
        solids: &[Solid],
    ) -> Self {
        let side = CELLS as f32;
        let size = high - low;
        let least = (size.element_product() / MOST_PLACES).cbrt() / side;
        let cell = (0.5 * spacing).max(least);
        let blocks = (size / (cell * side)).ceil().as_ivec3().clamp(IVec3::ONE, IVec3::splat(4096));
        let table = vec![ABSENT; (blocks.x * blocks.y * blocks.z) as usize];
        let corners = walls.iter().map(|wall| (Vec3::from(wall.min), Vec3::from(wall.max))).collect();
        let mut field =
            Self { low, cell, blocks, table, contents: vec![], nodes: vec![], foam: vec![], walls: corners };
        for kernel in kernels {
            field.splat(kernel, kernel.behind.and_then(|number| walls.get(number)));
        }
        field.share_foam();
        walls.iter().for_each(|wall| field.fill_to(wall, spacing));
        solids.iter().for_each(|solid| field.wet_to(solid, spacing));
        field.sort_out();
        field
    }

    /// Adds one blob; that of an image reaches but a little out of its box.
    fn splat(&mut self, kernel: &Kernel, room: Option<&Box3>) {
        let (mut low, mut high) = (kernel.centre - kernel.extent, kernel.centre + kernel.extent);
        if let Some(room) = room {
            low = low.max(Vec3::from(room.min) - 2.0 * self.cell);
            high = high.min(Vec3::from(room.max) + 2.0 * self.cell);
        }
        let first = ((low - self.low) / self.cell).ceil().as_ivec3();
        let last = ((high - self.low) / self.cell).floor().as_ivec3();
        // A block's nodes are 0 to 8, and node 8 is also node 0 of the next block.
        let from = (first - 1).div_euclid(IVec3::splat(CELLS)).max(IVec3::ZERO);
        let to = last.div_euclid(IVec3::splat(CELLS)).min(self.blocks - 1);
        for z in from.z..=to.z {
            for y in from.y..=to.y {
                for x in from.x..=to.x {
                    let block = IVec3::new(x, y, z);
                    let slot = self.claim(block);
                    let range = (first - block * CELLS, last - block * CELLS);
                    self.splat_block(kernel, block, slot, range);
                }
            }
        }
    }

    /// Adds the part of a blob that lies in one block.
    fn splat_block(&mut self, kernel: &Kernel, block: IVec3, slot: usize, (first, last): (IVec3, IVec3)) {
        let (from, to) = (first.max(IVec3::ZERO), last.min(IVec3::splat(CELLS)));
        let corner = self.low + (block * CELLS).as_vec3() * self.cell - kernel.centre;
        let along = kernel.squash.x_axis * self.cell;
        for z in from.z..=to.z {
            for y in from.y..=to.y {
                let row = node(0, y, z);
                let start = corner + IVec3::new(from.x, y, z).as_vec3() * self.cell;
                let mut q = kernel.squash * start;
                for x in from.x..=to.x {
                    let rest = 1.0 - q.length_squared();
                    if rest > 0.0 {
                        let value = kernel.peak * rest * rest * rest;
                        self.nodes[slot][row + x as usize] += value;
                        self.foam[slot][row + x as usize] += value * kernel.foam;
                    }
                    q += along;
                }
            }
        }
    }

    /// The number of a block, made if it is absent.
    fn claim(&mut self, block: IVec3) -> usize {
        let place = self.place(block);
        if self.table[place] == ABSENT {
            self.table[place] = self.nodes.len() as u32;
            self.nodes.push([0.0; NODES.pow(3)]);
            self.foam.push([0.0; NODES.pow(3)]);
        }
        self.table[place] as usize
    }

    fn place(&self, block: IVec3) -> usize {
        ((block.z * self.blocks.y + block.y) * self.blocks.x + block.x) as usize
    }

    /// Turns summed foam into the mean at each node.
    fn share_foam(&mut self) {
        for (foam, nodes) in self.foam.iter_mut().zip(&self.nodes) {
            for (f, n) in foam.iter_mut().zip(nodes) {
                *f /= n.max(1e-3);
            }
        }
    }

    /// Lets the fluid touch the walls and the floor of a box, and cuts off what sticks out of them.
    fn fill_to(&mut self, wall: &Box3, spacing: f32) {
        let (low, high) = (Vec3::from(wall.min), Vec3::from(wall.max));
        let inset = 1.1 * spacing;
        let (near, far) = (low + inset, (high - inset).with_y(f32::MAX));
        let cell = self.cell;
        self.change(|field, p, value| {
            let depth = (p - low).min((high - p).with_y(f32::MAX)).min_element();
            if p.y > high.y || depth < -2.0 * cell || depth > 2.0 * inset + cell {
                return value;
            }
            let inner = field.sample(p.max(near).min(far.max(near)));
            value.max(inner).min(SURFACE + CUT * depth / cell)
        });
    }

    /// Lets the fluid beside a solid go on into it, so that no sliver of air shows between them.
    fn wet_to(&mut self, solid: &Solid, spacing: f32) {
        let (gap, skin) = (0.6 * spacing, 3.0 * self.cell);
        self.change(|field, p, value| {
            let Some((distance, out)) = solid.distance(p) else { return value };
            if distance > gap || distance < -skin {
                return value;
            }
            value.max(field.sample(p + out * (gap - distance)))
        });
    }

    /// Gives every node a new density, from where it is and the density so far.
    fn change(&mut self, new: impl Fn(&Self, Vec3, f32) -> f32) {
        let mut changes = Vec::new();
        for (block, slot) in self.present() {
            for (i, value) in self.nodes[slot].iter().enumerate() {
                let p = self.low + (block * CELLS + unpack(i)).as_vec3() * self.cell;
                let changed = new(self, p, *value);
                if changed != *value {
                    changes.push((slot, i, changed));
                }
            }
        }
        changes.into_iter().for_each(|(slot, i, value)| self.nodes[slot][i] = value);
    }

    /// Every block that is present and its number.
    fn present(&self) -> Vec<(IVec3, usize)> {
        let b = self.blocks;
        let block = |i: usize| {
            let i = i as i32;
            IVec3::new(i % b.x, i / b.x % b.y, i / (b.x * b.y))
        };
        let present = self.table.iter().enumerate().filter(|(_, slot)| **slot != ABSENT);
        present.map(|(i, slot)| (block(i), *slot as usize)).collect()
    }

    /// Notes what is in every block.
    fn sort_out(&mut self) {
        self.contents = self.nodes.iter().enumerate().map(|(i, nodes)| content(i, nodes)).collect();
    }

    /// What is in `block`; none outside the grid.
    pub fn content(&self, block: IVec3) -> Option<Content> {
        let inside = block.cmpge(IVec3::ZERO).all() && block.cmplt(self.blocks).all();
        inside.then(|| self.slot(block).map_or(Content::Empty, |slot| self.contents[slot]))
    }

    /// The number of a block that is present.
    fn slot(&self, block: IVec3) -> Option<usize> {
        if block.cmplt(IVec3::ZERO).any() || block.cmpge(self.blocks).any() {
            return None;
        }
        let slot = self.table[self.place(block)];
        (slot != ABSENT).then_some(slot as usize)
    }

    /// The density at `p`.
    pub fn sample(&self, p: Vec3) -> f32 {
        let g = (p - self.low) / self.cell;
        self.slot_at(g).map_or(0.0, |(slot, local)| trilinear(&self.nodes[slot], local))
    }

    /// How much the fluid foams at `p`, 0 to 1.
    pub fn foam(&self, p: Vec3) -> f32 {
        let g = (p - self.low) / self.cell;
        self.slot_at(g).map_or(0.0, |(slot, local)| trilinear(&self.foam[slot], local))
    }

    /// The density in the block `slot` at `local`, in cells from the block's corner.
    pub fn sample_block(&self, slot: usize, local: Vec3) -> f32 {
        trilinear(&self.nodes[slot], local)
    }

    fn slot_at(&self, g: Vec3) -> Option<(usize, Vec3)> {
        let block = (g / CELLS as f32).floor().as_ivec3();
        Some((self.slot(block)?, g - (block * CELLS).as_vec3()))
    }

    fn node_value(&self, n: IVec3) -> f32 {
        let block = n.div_euclid(IVec3::splat(CELLS));
        let local = n - block * CELLS;
        self.slot(block).map_or(0.0, |slot| self.nodes[slot][node(local.x, local.y, local.z)])
    }

    /// The normal out of the wall or floor that `p` lies on.
    pub fn wall_normal(&self, p: Vec3) -> Option<Vec3> {
        let near = 0.2 * self.cell;
        self.walls.iter().find_map(|(low, high)| {
            let (below, above) = (p - low, high - p);
            if below.min(above).min_element() < -near {
                return None;
            }
            let axis = (0..3).find(|&i| below[i] < near || (i != 1 && above[i] < near))?;
            Some(if below[axis] < near { -Vec3::AXES[axis] } else { Vec3::AXES[axis] })
        })
    }

    /// The slope of the density at `p`, smoothed by a cubic spline, per cell.
    pub fn slope(&self, p: Vec3) -> Vec3 {
        let g = (p - self.low) / self.cell;
        let base = g.floor();
        let f = g - base;
        let (wx, dx) = spline(f.x);
        let (wy, dy) = spline(f.y);
        let (wz, dz) = spline(f.z);
        let corner = base.as_ivec3() - 1;
        let mut slope = Vec3::ZERO;
        for k in 0..4 {
            for j in 0..4 {
                let row: [f32; 4] = std::array::from_fn(|i| {
                    self.node_value(corner + IVec3::new(i as i32, j as i32, k as i32))
                });
                let along = row[0] * dx[0] + row[1] * dx[1] + row[2] * dx[2] + row[3] * dx[3];
                let mean = row[0] * wx[0] + row[1] * wx[1] + row[2] * wx[2] + row[3] * wx[3];
                slope += Vec3::new(along * wy[j] * wz[k], mean * dy[j] * wz[k], mean * wy[j] * dz[k]);
            }
        }
        slope
    }
}

fn content(slot: usize, nodes: &[f32; NODES.pow(3)]) -> Content {
    if nodes.iter().all(|n| *n < SURFACE) {
        Content::Empty
    } else if nodes.iter().all(|n| *n >= SURFACE) {
        Content::Full
    } else {
        Content::Mixed(slot)
    }
}

fn node(x: i32, y: i32, z: i32) -> usize {
    (z as usize * NODES + y as usize) * NODES + x as usize
}

fn unpack(i: usize) -> IVec3 {
    IVec3::new((i % NODES) as i32, (i / NODES % NODES) as i32, (i / NODES / NODES) as i32)
}

fn trilinear(nodes: &[f32; NODES.pow(3)], local: Vec3) -> f32 {
    let local = local.clamp(Vec3::ZERO, Vec3::splat(CELLS as f32 - 1e-3));
    let base = local.as_ivec3();
    let f = local - base.as_vec3();
    let i = node(base.x, base.y, base.z);
    let line = |at: usize| nodes[at] + (nodes[at + 1] - nodes[at]) * f.x;
    let sheet = |at: usize| {
        let (a, b) = (line(at), line(at + NODES));
        a + (b - a) * f.y
    };
    let (a, b) = (sheet(i), sheet(i + NODES * NODES));
    a + (b - a) * f.z
}

/// Weights of the cubic spline at `f` between its middle nodes, and their slopes.
fn spline(f: f32) -> ([f32; 4], [f32; 4]) {
    let e = 1.0 - f;
    let near = |t: f32| (4.0 - 6.0 * t * t + 3.0 * t * t * t) / 6.0;
    let weights = [e * e * e / 6.0, near(f), near(e), f * f * f / 6.0];
    let turn = |t: f32| -2.0 * t + 1.5 * t * t;
    let slopes = [-0.5 * e * e, turn(f), -turn(e), 0.5 * f * f];
    (weights, slopes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spline_keeps_sums() {
        for f in [0.0, 0.3, 0.9] {
            let (weights, slopes) = spline(f);
            assert!((weights.iter().sum::<f32>() - 1.0).abs() < 1e-6);
            assert!(slopes.iter().sum::<f32>().abs() < 1e-6);
        }
    }

    #[test]
    fn trilinear_is_exact_on_a_slope() {
        let mut nodes = [0.0; NODES.pow(3)];
        for (i, n) in nodes.iter_mut().enumerate() {
            let p = unpack(i).as_vec3();
            *n = p.x + 2.0 * p.y - p.z;
        }
        assert!((trilinear(&nodes, Vec3::new(1.5, 2.25, 7.5)) + 1.5).abs() < 1e-4);
    }
}
