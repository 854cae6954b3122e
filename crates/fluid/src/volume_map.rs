//! The integrals of `wall.rs` round bodies with edges, rims or thin parts, where a distance does not tell how much of
//! a particle's support is solid: tabulated over the body's own space (volume maps: Bender, Kugelstadt, Weiler &
//! Koschier 2019, doi:10.1145/3359566.3364676).
//!
//! A shape that is alike round its axis needs a table over radius and height, a box one over an eighth; and of a long
//! straight part one place stands for all. What is left is at most two supports long and wide, whatever the size.

use crate::node_grid::NodeGrid;
use crate::wall::WallTerms;
use crate::{Kernel, Shape};
use glam::{DVec3, IVec3, Mat3, Vec3};
use rayon::prelude::*;

/// Most nodes: where there would be more, the body is far larger than a support, and is taken for smooth, as edges are a
/// small share of it.
const MOST_NODES: usize = 300_000;

/// One node: the integrals, with the whole gradient.
#[derive(Clone, Copy, Debug, Default)]
struct Node {
    terms: WallTerms,
    gradient: Vec3,
}

/// See the module.
#[derive(Clone, Debug)]
pub(crate) struct VolumeMap {
    fold: Fold,
    grid: NodeGrid,
    nodes: Vec<Node>,
}

/// By which symmetry places of a body are taken for one.
#[derive(Clone, Copy, Debug)]
enum Fold {
    /// Round the y axis, and across y = 0: coordinates are radius, height and nothing.
    Round,
    /// Across three planes.
    Mirror,
    /// None.
    Open,
}

impl Fold {
    /// Nodes a support.
    fn nodes(self) -> u32 {
        match self {
            Self::Round | Self::Mirror => 10,
            Self::Open => 8,
        }
    }

    /// The place that stands for `point`, and the directions there of its coordinates.
    fn place(self, point: Vec3) -> (Vec3, Mat3) {
        let side = Vec3::ONE.copysign(point);
        match self {
            Self::Open => (point, Mat3::IDENTITY),
            Self::Mirror => (point.abs(), Mat3::from_diagonal(side)),
            Self::Round => {
                let radius = point.x.hypot(point.z);
                let radial = if radius > 1e-9 { Vec3::new(point.x, 0.0, point.z) / radius } else { Vec3::X };
                let height = Vec3::Y * side.y;
                (Vec3::new(radius, point.y.abs(), 0.0), Mat3::from_cols(radial, height, radial.cross(height)))
            }
        }
    }
}

impl VolumeMap {
    /// For `shape`, or none where its distance tells all.
    pub fn for_shape(shape: &Shape, kernel: Kernel, support: f64) -> Option<Self> {
        let (fold, low, high) = room(shape, support)?;
        let step = support / f64::from(fold.nodes());
        let grid = NodeGrid::spanning(low, high, step as f32);
        (grid.len() <= MOST_NODES).then(|| {
            let nodes = integrate(shape, (kernel, support), &grid, fold.nodes());
            Self { fold, grid, nodes }
        })
    }

    /// The integrals at `point` of the body's frame, and the direction of their gradient there, out of the solid;
    /// none where the solid is on all sides or on none.
    pub fn at(&self, point: Vec3) -> (WallTerms, Option<Vec3>) {
        let (place, basis) = self.fold.place(point);
        let (mut terms, mut gradient) = (WallTerms::default(), Vec3::ZERO);
        for (node, share) in self.grid.blend(place) {
            terms.add_scaled(&self.nodes[node].terms, share);
            gradient += share * self.nodes[node].gradient;
        }
        terms.gradient = -gradient.length();
        let outward = (terms.gradient < 0.0).then(|| basis * (gradient / terms.gradient));
        (terms, outward)
    }
}

/// How a shape folds, and between which coordinates its integrals change, m.
fn room(shape: &Shape, support: f64) -> Option<(Fold, Vec3, Vec3)> {
    let flat = DVec3::new(1.0, 1.0, 0.0);
    let round = |from: DVec3, to: DVec3| {
        Some((
            Fold::Round,
            ((from - support).max(DVec3::ZERO) * flat).as_vec3(),
            ((to + support) * flat).as_vec3(),
        ))
    };
    match shape {
        &Shape::Disc { radius, thickness } => {
            let rim = DVec3::new(radius, 0.5 * thickness, 0.0);
            round(rim, rim)
        }
        &Shape::Capsule { radius, length } => {
            let end = DVec3::Y * 0.5 * length;
            round(end, end + DVec3::new(radius, radius, 0.0))
        }
        Shape::Box { size } => {
            let (low, high) = ((0.5 * *size - support).max(DVec3::ZERO), 0.5 * *size + support);
            Some((Fold::Mirror, low.as_vec3(), high.as_vec3()))
        }
        Shape::Mesh(mesh) => {
            let [low, high] = mesh.bounds();
            Some((Fold::Open, low - support as f32, high + support as f32))
        }
        Shape::Sphere { .. } | Shape::Slab { .. } | Shape::Drum { .. } => None,
    }
}

/// A cell of the support, seen from its middle.
struct Tap {
    /// Its place in the field of what is filled, from the first corner of the support.
    offset: usize,
    arm: Vec3,
    value: f32,
    slope: f32,
}

/// How much of each cell is solid: full beyond half a cell's depth, and linear between.
fn filled(shape: &Shape, cells: &NodeGrid) -> Vec<f32> {
    let share = |index: usize| {
        let (distance, _) = shape.distance(cells.place(cells.node(index)));
        (0.5 - distance / cells.step).clamp(0.0, 1.0)
    };
    (0..cells.len()).into_par_iter().map(share).collect()
}

/// The support's cells, scaled so that a support that is all solid has the exact integrals.
fn taps((kernel, support): (Kernel, f64), cells: &NodeGrid, reach: i32) -> Vec<Tap> {
    let axis = || -reach..=reach;
    let mut taps: Vec<_> = axis()
        .flat_map(|x| axis().flat_map(move |y| axis().map(move |z| IVec3::new(x, y, z))))
        .filter(|k| k.length_squared() < reach * reach)
        .map(|k| {
            let arm = k.as_vec3() * cells.step;
            let r = f64::from(arm.length());
            Tap {
                offset: cells.index((k + reach).as_uvec3()),
                arm,
                value: kernel.value(r, support) as f32,
                slope: -kernel.slope_over_r(r, support) as f32,
            }
        })
        .collect();
    let value: f32 = taps.iter().map(|t| t.value).sum();
    let moment: f32 = taps.iter().map(|t| t.slope * t.arm.x * t.arm.x).sum();
    taps.iter_mut().for_each(|t| {
        t.value /= value;
        t.slope /= moment;
    });
    taps
}

fn integrate(shape: &Shape, kernel: (Kernel, f64), grid: &NodeGrid, reach: u32) -> Vec<Node> {
    let cells = grid.widened(reach);
    let (filled, taps) = (filled(shape, &cells), taps(kernel, &cells, reach as i32));
    let at = |index: usize| {
        let k = grid.node(index);
        match shape.distance(grid.place(k)).0 / kernel.1 as f32 {
            far if far >= 1.0 => Node::default(),
            // Deeper than any particle gets.
            deep if deep < -0.6 => Node { terms: SOLID, gradient: Vec3::ZERO },
            _ => node(&filled[cells.index(k)..], &taps, kernel),
        }
    };
    (0..grid.len()).into_par_iter().map(at).collect()
}

/// The integrals where all is solid.
const SOLID: WallTerms =
    WallTerms { volume: 1.0, gradient: 0.0, normal_moment: 1.0, tangent_moment: 1.0, friction: 0.0 };

/// The integrals over the solid cells of one support; `filled` begins at its first corner.
fn node(filled: &[f32], taps: &[Tap], (kernel, support): (Kernel, f64)) -> Node {
    let (mut volume, mut gradient) = (0.0, Vec3::ZERO);
    let solid = taps.iter().map(|tap| (filled[tap.offset], tap)).filter(|(share, _)| *share > 0.0);
    let solid: Vec<_> = solid.collect();
    for &(share, tap) in &solid {
        volume += share * tap.value;
        gradient += share * tap.slope * tap.arm;
    }
    let n = -gradient.normalize_or(Vec3::NEG_Y);
    let [mut normal, mut square, mut friction] = [0.0_f32; 3];
    for &(share, tap) in &solid {
        let share = share * tap.slope;
        let (deep, long) = (-tap.arm.dot(n), tap.arm.length_squared());
        normal += share * deep * deep;
        square += share * long;
        friction += share * deep * (long - deep * deep);
    }
    let friction = friction * (0.5 * kernel.viscous_factor() / (support * support)) as f32;
    let terms = WallTerms {
        volume,
        gradient: 0.0,
        normal_moment: normal,
        tangent_moment: 0.5 * (square - normal),
        friction,
    };
    Node { terms, gradient }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::tests::box_mesh;
    use crate::wall::WallTable;
    use std::sync::Arc;

    const DX: f64 = 0.005;
    const SUPPORT: f64 = 2.7 * DX;

    fn shapes() -> [Shape; 4] {
        [
            Shape::Box { size: DVec3::new(0.03, 0.02, 0.04) },
            Shape::Disc { radius: 0.03, thickness: 0.01 },
            Shape::Disc { radius: 0.02, thickness: 0.005 },
            Shape::Capsule { radius: 0.01, length: 0.03 },
        ]
    }

    /// A capsule's table grows with its radius over the support, and must not take all memory.
    #[test]
    fn what_is_far_larger_than_a_support_has_no_table() {
        let table = |radius: f64| {
            VolumeMap::for_shape(&Shape::Capsule { radius, length: 0.01 }, Kernel::Wendland, SUPPORT)
        };
        assert!(table(10.0 * SUPPORT).is_some());
        assert!(table(1000.0 * SUPPORT).is_none());
    }

    /// λ and its gradient by brute force, on cells of H/40.
    fn summed(shape: &Shape, point: Vec3) -> (f64, DVec3) {
        let (n, mut volume, mut gradient) = (40, 0.0, DVec3::ZERO);
        let step = SUPPORT / f64::from(n);
        let axis = || (-n..n).map(|k| (f64::from(k) + 0.5) * step);
        for (x, y, z) in axis().flat_map(|x| axis().flat_map(move |y| axis().map(move |z| (x, y, z)))) {
            let arm = DVec3::new(x, y, z);
            if shape.distance(point + arm.as_vec3()).0 < 0.0 {
                volume += Kernel::Wendland.value(arm.length(), SUPPORT) * step.powi(3);
                gradient -= Kernel::Wendland.slope_over_r(arm.length(), SUPPORT) * step.powi(3) * arm;
            }
        }
        (volume, gradient)
    }

    /// Places 0..H before faces, edges and corners of a shape.
    fn places(shape: &Shape) -> Vec<Vec3> {
        let mut places = vec![];
        let mut k = 0;
        while places.len() < 60 {
            k += 1;
            let s = |m: usize| ((k * m) % 1009) as f32 / 1009.0 - 0.5;
            let p = Vec3::new(s(71), s(137), s(293)) * 0.1;
            if (0.0..SUPPORT as f32).contains(&shape.distance(p).0) {
                places.push(p);
            }
        }
        places
    }

    /// Root of the mean squared errors of λ and of H ∇λ against the sums.
    fn errors(shape: &Shape, at: impl Fn(Vec3) -> (WallTerms, Vec3)) -> [f64; 2] {
        let places = places(shape);
        let squares = places.iter().map(|&p| {
            let ((volume, gradient), (terms, n)) = (summed(shape, p), at(p));
            let slope = (terms.gradient * n).as_dvec3() - gradient;
            [(f64::from(terms.volume) - volume).powi(2), slope.length_squared() * SUPPORT * SUPPORT]
        });
        let sum = squares.fold([0.0; 2], |sum, s| [sum[0] + s[0], sum[1] + s[1]]);
        sum.map(|s| (s / places.len() as f64).sqrt())
    }

    type Terms<'a> = Box<dyn Fn(Vec3) -> (WallTerms, Vec3) + 'a>;

    /// The terms of the map, and those of a surface that is flat or round all over.
    fn both(shape: &Shape, support: f64) -> [Terms<'_>; 2] {
        let map = VolumeMap::for_shape(shape, Kernel::Wendland, support).unwrap();
        let table = WallTable::for_shape(shape, Kernel::Wendland, support);
        let mapped = move |p: Vec3| {
            let (terms, n) = map.at(p);
            (terms, n.unwrap_or(shape.distance(p).1))
        };
        let flat = move |p: Vec3| {
            let (distance, n) = shape.distance(p);
            (table.at(distance), n)
        };
        [Box::new(mapped), Box::new(flat)]
    }

    #[test]
    fn the_integrals_are_those_of_a_sum_at_edges_too() {
        for shape in shapes() {
            let [map, flat] = both(&shape, SUPPORT).map(|at| errors(&shape, at));
            assert!(map[0] < 0.005 && map[1] < 0.02, "{shape:?}: {map:?}");
            assert!(flat[1] > 5.0 * map[1], "{shape:?}: flat {flat:?}, map {map:?}");
        }
    }

    /// Vertical force of a fluid at rest, in shares of Archimedes'. The fluid is summed on a lattice of dx/4.
    fn archimedes(shape: &Shape, dx: f64, at: impl Fn(Vec3) -> (WallTerms, Vec3)) -> f64 {
        let (step, field) = (0.25 * dx, Vec3::Y * -9.81);
        let (n, reach) = ((0.06 / step) as i32, 2.7 * dx as f32);
        let axis = || (-n..n).map(|k| (f64::from(k) + 0.5) * step);
        let mut force = 0.0;
        for (x, y, z) in axis().flat_map(|x| axis().flat_map(move |y| axis().map(move |z| (x, y, z)))) {
            let p = DVec3::new(x, y, z).as_vec3();
            if (0.0..reach).contains(&shape.distance(p).0) {
                let (t, n) = at(p);
                let across = field.dot(n) * n;
                let moment = t.normal_moment * across + t.tangent_moment * (field - across);
                let pressure = field.y * (p.y - 0.2);
                force += f64::from((2.0 * pressure * t.gradient * n + moment).y) * step.powi(3);
            }
        }
        force / (9.81 * shape.volume())
    }

    /// As thin as a spacing, a body still floats as it should; with flat surfaces it has 5 to 19 % too much.
    #[test]
    fn a_fluid_at_rest_lifts_by_the_true_volume() {
        for (dx, within) in [(0.005, 0.05), (0.0025, 0.012)] {
            for shape in shapes() {
                let [map, flat] = both(&shape, 2.7 * dx).map(|at| archimedes(&shape, dx, at));
                assert!((map - 1.0).abs() < within, "{shape:?}, dx {dx} m: {map}");
                assert!((flat - 1.0).abs() > 3.0 * (map - 1.0).abs(), "{shape:?}, dx {dx} m: {flat}, {map}");
            }
        }
    }

    /// A mesh has a coarser map, and edges that are round within a cell of its distances.
    #[test]
    fn a_mesh_has_the_integrals_of_its_shape() {
        let size = DVec3::new(0.03, 0.02, 0.04);
        let (shape, mesh) = (Shape::Box { size }, Shape::Mesh(Arc::new(box_mesh(size))));
        let [exact, map] =
            [&shape, &mesh].map(|s| VolumeMap::for_shape(s, Kernel::Wendland, SUPPORT).unwrap());
        for p in places(&shape) {
            let ((a, n), (b, m)) = (exact.at(p), map.at(p));
            assert!((a.volume - b.volume).abs() < 0.02, "{p}: {a:?}, {b:?}");
            let slope = a.gradient * n.unwrap_or(Vec3::Y) - b.gradient * m.unwrap_or(Vec3::Y);
            assert!(slope.length() * (SUPPORT as f32) < 0.12, "{p}: {a:?}, {b:?}");
            assert!((a.friction - b.friction).abs() * (SUPPORT as f32) < 0.12, "{p}: {a:?}, {b:?}");
        }
        for (dx, within) in [(0.005, 0.01), (0.0025, 0.01)] {
            let [mapped, _] = both(&mesh, 2.7 * dx);
            let lift = archimedes(&shape, dx, mapped);
            assert!((lift - 1.0).abs() < within, "dx {dx} m: {lift}");
        }
    }
}
