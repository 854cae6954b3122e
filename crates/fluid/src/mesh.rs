//! A body whose surface is a closed mesh of triangles: what it weighs, and how far a point is from it.
//!
//! Volume and inertia are integrals over the tetrahedra between the faces and a point (Mirtich 1996,
//! doi:10.1080/10867651.1996.10487458). Distances are exact at the nodes of a grid, with the sign of the
//! angle-weighted normal at the nearest place (Bærentzen & Aanæs 2005, doi:10.1109/TVCG.2005.49), and linear between
//! them.

use crate::node_grid::NodeGrid;
use crate::triangle::Part;
use crate::triangle_tree::TriangleTree;
use glam::{DMat3, DVec3, Vec3};
use std::collections::HashMap;

/// Most triangles of a mesh.
pub const MAX_TRIANGLES: usize = 200_000;
/// Farthest that a vertex may be from the origin, m.
const FARTHEST: f64 = 1e5;
/// Least volume of a mesh as a share of that of the box round it: less is a sheet.
const LEAST_FILL: f64 = 1e-6;
/// Nodes of the grid of distances, and of its longest side.
const NODES: f64 = 200_000.0;
const LONGEST: f64 = 128.0;
/// How far beyond the mesh the grid goes, as a share of its longest side.
const MARGIN: f64 = 0.1;

/// Why a mesh is none.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum MeshError {
    /// No triangle.
    #[error("it has no triangle")]
    Empty,
    /// Too many triangles.
    #[error("it has {0} triangles; there may be {MAX_TRIANGLES}")]
    TooMany(usize),
    /// A vertex that is not finite, or too far away.
    #[error("vertex {0} (from 0): each coordinate must be finite and within {FARTHEST} m")]
    Vertex(usize),
    /// A triangle with a vertex that is not there.
    #[error("triangle {0} (from 0) names a vertex that is not there")]
    Index(usize),
    /// A surface with holes.
    #[error("it is not closed: {0} of its edges have no other side")]
    Open(usize),
    /// A surface that holds nothing.
    #[error("it holds no volume")]
    Flat,
}

/// A closed surface of triangles, about the centre of its volume.
#[derive(Clone, PartialEq)]
pub struct Mesh {
    vertices: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
    volume: f64,
    /// Moments of inertia for a mass of 1 kg, kg m².
    inertia: DMat3,
    low: Vec3,
    high: Vec3,
    radius: f64,
    grid: NodeGrid,
    distances: Vec<f32>,
}

impl std::fmt::Debug for Mesh {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Mesh").field("triangles", &self.triangles.len()).finish_non_exhaustive()
    }
}

impl Mesh {
    /// The body within `triangles` between `vertices` (m). It is moved so that the centre of its volume is the
    /// origin, and turned inside out if need be; vertices at the same place are one.
    ///
    /// # Errors
    /// A mesh that is not closed, holds nothing, or has a vertex or a triangle that cannot be.
    pub fn new(vertices: &[DVec3], triangles: &[[u32; 3]]) -> Result<Self, MeshError> {
        let (mut vertices, mut triangles) = welded(vertices, triangles)?;
        check_closed(&triangles)?;
        let mut moments = Moments::of(&vertices, &triangles);
        if moments.volume < 0.0 {
            triangles.iter_mut().for_each(|t| t.swap(1, 2));
            moments = Moments::of(&vertices, &triangles);
        }
        let (low, high) = bounds(&vertices);
        let least = LEAST_FILL * (high - low).max_element().powi(3);
        if !(moments.volume.is_finite() && moments.volume > least) {
            return Err(MeshError::Flat);
        }
        let centre = moments.first / moments.volume;
        vertices.iter_mut().for_each(|v| *v -= centre);
        let (low, high) = ((low - centre).as_vec3(), (high - centre).as_vec3());
        let grid = distance_grid(low, high);
        let inertia = Moments::of(&vertices, &triangles).inertia();
        let radius = vertices.iter().map(|v| v.length()).fold(0.0, f64::max);
        let distances = distances(&vertices, &triangles, &grid);
        Ok(Self { vertices, triangles, volume: moments.volume, inertia, low, high, radius, grid, distances })
    }

    /// The same, `factor` times as large.
    pub fn scaled(&self, factor: f64) -> Self {
        let small = factor as f32;
        let grid = NodeGrid { low: self.grid.low * small, step: self.grid.step * small, ..self.grid };
        Self {
            vertices: self.vertices.iter().map(|v| v * factor).collect(),
            triangles: self.triangles.clone(),
            volume: self.volume * factor.powi(3),
            inertia: self.inertia * (factor * factor),
            low: self.low * small,
            high: self.high * small,
            radius: self.radius * factor,
            grid,
            distances: self.distances.iter().map(|d| d * small).collect(),
        }
    }

    /// Its vertices, m.
    pub fn vertices(&self) -> &[DVec3] {
        &self.vertices
    }

    /// The vertices of each triangle, anticlockwise from outside.
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// Volume, m³.
    pub fn volume(&self) -> f64 {
        self.volume
    }

    /// Tensor of inertia about the origin of a body of `mass` (kg) of even density, kg m².
    pub fn inertia(&self, mass: f64) -> DMat3 {
        self.inertia * mass
    }

    /// Radius of the ball round the origin that holds it, m.
    pub fn bounding_radius(&self) -> f64 {
        self.radius
    }

    /// Corners of the box round it, m.
    pub(crate) fn bounds(&self) -> [Vec3; 2] {
        [self.low, self.high]
    }

    /// Signed distance (m, negative inside) and outward unit normal at `point`.
    pub fn distance(&self, point: Vec3) -> (f32, Vec3) {
        // Half a step from its side, where the differences are whole.
        let half = Vec3::splat(0.5 * self.grid.step);
        let within = point.clamp(self.grid.low + half, self.grid.high() - half);
        let (distance, normal) = (self.sample(within), self.slope(within));
        if within == point {
            return (distance, normal);
        }
        // Beyond the grid, from the place of the surface that is nearest to its side.
        let off = point - (within - distance * normal);
        let length = off.length();
        if length > 0.0 { (length, off / length) } else { (distance, normal) }
    }

    fn sample(&self, point: Vec3) -> f32 {
        self.grid.blend(point).map(|(node, share)| share * self.distances[node]).sum()
    }

    /// Central differences: between linear pieces the slope would jump.
    fn slope(&self, point: Vec3) -> Vec3 {
        let along = |axis: Vec3| {
            let step = 0.5 * self.grid.step * axis;
            self.sample(point + step) - self.sample(point - step)
        };
        Vec3::new(along(Vec3::X), along(Vec3::Y), along(Vec3::Z)).normalize_or(Vec3::Y)
    }
}

/// Integrals over what is inside: of 1, x and x ⊗ x.
struct Moments {
    volume: f64,
    first: DVec3,
    second: DMat3,
}

impl Moments {
    fn of(vertices: &[DVec3], triangles: &[[u32; 3]]) -> Self {
        let mut sum = Self { volume: 0.0, first: DVec3::ZERO, second: DMat3::ZERO };
        let outer = |v: DVec3| DMat3::from_cols(v * v.x, v * v.y, v * v.z);
        for t in triangles {
            let [a, b, c] = t.map(|k| vertices[k as usize]);
            let (six, s) = (a.dot(b.cross(c)), a + b + c);
            sum.volume += six / 6.0;
            sum.first += s * (six / 24.0);
            sum.second += (outer(a) + outer(b) + outer(c) + outer(s)) * (six / 120.0);
        }
        sum
    }

    /// Tensor of inertia of 1 kg about the origin.
    fn inertia(&self) -> DMat3 {
        let s = self.second * self.volume.recip();
        DMat3::from_diagonal(DVec3::splat(s.x_axis.x + s.y_axis.y + s.z_axis.z)) - s
    }
}

/// Vertices that are at the same place made one, and triangles that are left without area taken out.
fn welded(vertices: &[DVec3], triangles: &[[u32; 3]]) -> Result<(Vec<DVec3>, Vec<[u32; 3]>), MeshError> {
    match triangles.len() {
        0 => return Err(MeshError::Empty),
        many if many > MAX_TRIANGLES => return Err(MeshError::TooMany(many)),
        _ => {}
    }
    let mut known = HashMap::new();
    let (mut kept, mut number) = (Vec::new(), Vec::with_capacity(vertices.len()));
    for (k, &v) in vertices.iter().enumerate() {
        if !(v.is_finite() && v.abs().max_element() <= FARTHEST) {
            return Err(MeshError::Vertex(k));
        }
        // −0 and 0 are one place.
        let place = (v + 0.0).to_array().map(f64::to_bits);
        number.push(*known.entry(place).or_insert_with(|| {
            kept.push(v);
            kept.len() as u32 - 1
        }));
    }
    let mut joined = Vec::with_capacity(triangles.len());
    for (k, t) in triangles.iter().enumerate() {
        let of = |corner: u32| number.get(corner as usize).copied().ok_or(MeshError::Index(k));
        let [a, b, c] = [of(t[0])?, of(t[1])?, of(t[2])?];
        if a != b && b != c && c != a {
            joined.push([a, b, c]);
        }
    }
    Ok((kept, joined))
}

/// The edges of a triangle, as it goes round.
fn edges(t: &[u32; 3]) -> [(u32, u32); 3] {
    [(t[0], t[1]), (t[1], t[2]), (t[2], t[0])]
}

/// Every edge is gone along as often in the one direction as in the other.
fn check_closed(triangles: &[[u32; 3]]) -> Result<(), MeshError> {
    let mut ways: HashMap<(u32, u32), i64> = HashMap::new();
    for (a, b) in triangles.iter().flat_map(edges) {
        *ways.entry((a.min(b), a.max(b))).or_default() += if a < b { 1 } else { -1 };
    }
    match ways.values().filter(|&&way| way != 0).count() {
        0 => Ok(()),
        open => Err(MeshError::Open(open)),
    }
}

fn bounds(vertices: &[DVec3]) -> (DVec3, DVec3) {
    vertices.iter().fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), &v| (low.min(v), high.max(v)))
}

fn distance_grid(low: Vec3, high: Vec3) -> NodeGrid {
    let size = (high - low).as_dvec3();
    let longest = size.max_element();
    let room = size + 2.0 * MARGIN * longest;
    let step = (room.element_product() / NODES).cbrt().max(longest / LONGEST);
    let margin = Vec3::splat((MARGIN * longest) as f32);
    NodeGrid::spanning(low - margin, high + margin, step as f32)
}

fn distances(vertices: &[DVec3], triangles: &[[u32; 3]], grid: &NodeGrid) -> Vec<f32> {
    let normals = part_normals(vertices, triangles);
    let tree = TriangleTree::new(triangles.iter().map(|t| t.map(|k| vertices[k as usize])).collect());
    let at = |index: usize| {
        let p = grid.place(grid.node(index)).as_dvec3();
        tree.nearest(p).map_or(f32::INFINITY, |near| {
            let normal = normals[near.triangle][match near.part {
                Part::Corner(k) => k,
                Part::Edge(k) => 3 + k,
                Part::Face => 6,
            }];
            near.square.sqrt().copysign((p - near.place).dot(normal)) as f32
        })
    };
    (0..grid.len()).map(at).collect()
}

/// Of each triangle: the angle-weighted normals at its corners, those at its edges, and its own.
fn part_normals(vertices: &[DVec3], triangles: &[[u32; 3]]) -> Vec<[DVec3; 7]> {
    let mut corners = vec![DVec3::ZERO; vertices.len()];
    let mut borders: HashMap<(u32, u32), DVec3> = HashMap::new();
    let faces: Vec<_> = triangles
        .iter()
        .map(|t| {
            let [a, b, c] = t.map(|k| vertices[k as usize]);
            (b - a).cross(c - a).normalize_or_zero()
        })
        .collect();
    for (t, &normal) in triangles.iter().zip(&faces) {
        for k in 0..3 {
            let [a, b, c] = [0, 1, 2].map(|n| vertices[t[(k + n) % 3] as usize]);
            corners[t[k] as usize] += normal * (b - a).angle_between(c - a);
        }
        edges(t).iter().for_each(|&(a, b)| *borders.entry((a.min(b), a.max(b))).or_default() += normal);
    }
    let all = |(t, &face): (&[u32; 3], &DVec3)| {
        let [a, b, c] = t.map(|k| corners[k as usize]);
        let [ab, bc, ca] = edges(t).map(|(a, b)| borders[&(a.min(b), a.max(b))]);
        [a, b, c, ab, bc, ca, face]
    };
    triangles.iter().zip(&faces).map(all).collect()
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use crate::Shape;
    use std::f64::consts::{PI, TAU};

    const CUBE: [[u32; 4]; 6] =
        [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]];

    fn box_corners(size: DVec3) -> Vec<DVec3> {
        (0..8)
            .map(|k| size * (DVec3::new(f64::from(k >> 2), f64::from(k >> 1 & 1), f64::from(k & 1)) - 0.5))
            .collect()
    }

    fn box_faces() -> Vec<[u32; 3]> {
        CUBE.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect()
    }

    /// A box of edges along the axes.
    pub(crate) fn box_mesh(size: DVec3) -> Mesh {
        Mesh::new(&box_corners(size), &box_faces()).unwrap()
    }

    /// A ball of `n` circles of latitude.
    fn ball_mesh(radius: f64, n: u32, centre: DVec3) -> Mesh {
        let mut vertices = vec![];
        for (k, m) in (0..=n).flat_map(|k| (0..2 * n).map(move |m| (k, m))) {
            let (lat, lon) = (PI * f64::from(k) / f64::from(n), TAU * f64::from(m) / f64::from(2 * n));
            let ring = if k % n == 0 { 0.0 } else { lat.sin() };
            vertices.push(centre + radius * DVec3::new(ring * lon.cos(), lat.cos(), ring * lon.sin()));
        }
        let at = |k: u32, m: u32| k * 2 * n + m % (2 * n);
        let quad = |(k, m)| {
            let [a, b, c, d] = [at(k, m), at(k + 1, m), at(k + 1, m + 1), at(k, m + 1)];
            [[a, b, c], [a, c, d]]
        };
        let triangles: Vec<_> = (0..n).flat_map(|k| (0..2 * n).map(move |m| (k, m))).flat_map(quad).collect();
        Mesh::new(&vertices, &triangles).unwrap()
    }

    fn points(reach: f32) -> impl Iterator<Item = Vec3> {
        (0..2000).map(move |k| {
            let s = |m: usize| ((k * m) % 1009) as f32 / 1009.0 - 0.5;
            Vec3::new(s(71), s(137), s(293)) * 2.0 * reach
        })
    }

    /// Largest error of the distance within `reach`, and largest angle between normals next to the surface.
    fn errors(mesh: &Mesh, shape: &Shape, reach: f32, band: f32) -> (f32, f32) {
        points(reach).fold((0.0_f32, 0.0_f32), |worst, p| {
            let ((d, n), (expected, normal)) = (mesh.distance(p), shape.distance(p));
            let angle = if expected.abs() < band { n.angle_between(normal) } else { 0.0 };
            (worst.0.max((d - expected).abs()), worst.1.max(angle))
        })
    }

    #[test]
    fn a_ball_of_triangles_is_a_ball() {
        let mesh = ball_mesh(0.03, 48, DVec3::new(0.1, 0.0, 0.2));
        let shape = Shape::Sphere { radius: 0.03 };
        assert!((mesh.volume() / shape.volume() - 1.0).abs() < 3e-3);
        let inertia = shape.inertia(2.0);
        assert!(mesh.inertia(2.0).abs_diff_eq(inertia, 4e-3 * inertia.x_axis.x));
        assert!((mesh.bounding_radius() - 0.03).abs() < 1e-4);
        let (distance, angle) = errors(&mesh, &shape, 0.045, 0.01);
        assert!(distance < 6e-4 && angle < 0.07, "{distance} m, {angle} rad");
    }

    #[test]
    fn a_box_of_triangles_is_a_box() {
        let size = DVec3::new(0.03, 0.02, 0.04);
        let (mesh, shape) = (box_mesh(size), Shape::Box { size });
        assert!((mesh.volume() / shape.volume() - 1.0).abs() < 1e-12);
        let inertia = shape.inertia(2.0);
        assert!(mesh.inertia(2.0).abs_diff_eq(inertia, 1e-12 * inertia.x_axis.x));
        // Edges are rounded within a cell of the grid, here 0.7 mm.
        let distance = errors(&mesh, &shape, 0.04, 0.0).0;
        assert!(distance < 4e-4, "{distance} m");
    }

    /// An L has a re-entrant edge, where the nearest place is an edge seen from inside.
    #[test]
    fn a_body_that_is_not_convex_knows_its_inside() {
        let outline = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]];
        let vertices: Vec<_> =
            [0.0, 1.0].iter().flat_map(|&z| outline.map(|[x, y]| DVec3::new(x, y, z) * 0.01)).collect();
        let mut triangles: Vec<[u32; 3]> = vec![];
        for [a, b, c] in [[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5]] {
            triangles.extend([[a, c, b], [a + 6, b + 6, c + 6]]);
        }
        for k in 0..6 {
            let next = (k + 1) % 6;
            triangles.extend([[k, next, next + 6], [k, next + 6, k + 6]]);
        }
        let mesh = Mesh::new(&vertices, &triangles).unwrap();
        assert!((mesh.volume() - 3e-6).abs() < 1e-15);
        let centre = (1e-6 * DVec3::new(0.005, 0.005, 0.005)
            + 1e-6 * DVec3::new(0.015, 0.005, 0.005)
            + 1e-6 * DVec3::new(0.005, 0.015, 0.005))
            / 3e-6;
        let at = |p: [f32; 3]| mesh.distance(Vec3::from(p) * 0.01 - centre.as_vec3()).0;
        assert!((at([1.5, 1.5, 0.5]) - 0.005).abs() < 2e-4, "in the notch: {}", at([1.5, 1.5, 0.5]));
        assert!((at([0.5, 0.5, 0.5]) + 0.005).abs() < 2e-4 && (at([0.9, 0.9, 0.5]) + 0.00141).abs() < 3e-4);
        assert!((at([5.0, 0.5, 0.5]) - 0.03).abs() < 1e-4, "beyond the grid: {}", at([5.0, 0.5, 0.5]));
    }

    #[test]
    fn inside_out_is_turned_and_every_flaw_has_its_name() {
        let (corners, faces) = (box_corners(DVec3::splat(0.1)), box_faces());
        let turned: Vec<_> = faces.iter().map(|&[a, b, c]| [a, c, b]).collect();
        assert_eq!(Mesh::new(&corners, &faces), Mesh::new(&corners, &turned));
        assert_eq!(Mesh::new(&corners, &[]), Err(MeshError::Empty));
        assert_eq!(Mesh::new(&corners, &faces[1..]), Err(MeshError::Open(3)));
        assert_eq!(Mesh::new(&corners[..7], &faces), Err(MeshError::Index(2)));
        let mut broken = corners.clone();
        broken[3].y = f64::NAN;
        assert_eq!(Mesh::new(&broken, &faces), Err(MeshError::Vertex(3)));
        assert_eq!(Mesh::new(&box_corners(DVec3::new(0.1, 0.0, 0.1)), &faces), Err(MeshError::Flat));
        assert_eq!(
            Mesh::new(&corners, &vec![[0, 1, 2]; MAX_TRIANGLES + 1]),
            Err(MeshError::TooMany(MAX_TRIANGLES + 1))
        );
        // One face the wrong way round.
        let mut twisted = faces.clone();
        twisted[0].swap(1, 2);
        assert_eq!(Mesh::new(&corners, &twisted), Err(MeshError::Open(3)));
        let apart: Vec<_> = faces.iter().flat_map(|t| t.map(|k| corners[k as usize])).collect();
        let loose: Vec<_> = (0..12).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect();
        assert_eq!(Mesh::new(&apart, &loose).unwrap().vertices().len(), 8, "corners at one place are one");
    }
}
