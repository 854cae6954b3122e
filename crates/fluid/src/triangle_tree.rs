//! Triangles in a tree of boxes, to find the nearest of many.

use crate::triangle::{Part, nearest};
use glam::DVec3;

/// Triangles in a leaf.
const LEAF: usize = 4;

/// The tree: each branch is followed by its first half, and knows where its second is.
pub(crate) struct TriangleTree {
    triangles: Vec<[DVec3; 3]>,
    order: Vec<usize>,
    nodes: Vec<Node>,
}

struct Node {
    low: DVec3,
    high: DVec3,
    first: usize,
    end: usize,
    /// Number of the second half; 0 for a leaf.
    second: usize,
}

/// The nearest place of all triangles.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Nearest {
    pub square: f64,
    pub place: DVec3,
    pub triangle: usize,
    pub part: Part,
}

impl TriangleTree {
    pub fn new(triangles: Vec<[DVec3; 3]>) -> Self {
        let order = (0..triangles.len()).collect();
        let mut tree = Self { triangles, order, nodes: Vec::new() };
        tree.branch(0, tree.triangles.len());
        tree
    }

    fn branch(&mut self, first: usize, end: usize) {
        let corners = self.order[first..end].iter().flat_map(|&t| self.triangles[t]);
        let (low, high) =
            corners.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), c| (low.min(c), high.max(c)));
        let this = self.nodes.len();
        self.nodes.push(Node { low, high, first, end, second: 0 });
        if end - first <= LEAF {
            return;
        }
        let (axis, middle) = ((high - low).max_position(), (end - first) / 2);
        let along = |t: &usize| self.triangles[*t].iter().map(|c| c[axis]).sum::<f64>();
        self.order[first..end].select_nth_unstable_by(middle, |a, b| along(a).total_cmp(&along(b)));
        self.branch(first, first + middle);
        self.nodes[this].second = self.nodes.len();
        self.branch(first + middle, end);
    }

    /// The nearest place to `p`; none if there is no triangle.
    pub fn nearest(&self, p: DVec3) -> Option<Nearest> {
        let mut best = None;
        self.look(0, p, &mut best);
        best
    }

    fn look(&self, at: usize, p: DVec3, best: &mut Option<Nearest>) {
        let node = &self.nodes[at];
        if self.square(at, p) >= best.map_or(f64::INFINITY, |b| b.square) {
            return;
        }
        if node.second == 0 {
            return self.order[node.first..node.end].iter().for_each(|&t| self.try_triangle(t, p, best));
        }
        let (mut near, mut far) = (at + 1, node.second);
        if self.square(far, p) < self.square(near, p) {
            std::mem::swap(&mut near, &mut far);
        }
        self.look(near, p, best);
        self.look(far, p, best);
    }

    fn try_triangle(&self, triangle: usize, p: DVec3, best: &mut Option<Nearest>) {
        let (place, part) = nearest(&self.triangles[triangle], p);
        let square = place.distance_squared(p);
        if square < best.map_or(f64::INFINITY, |b| b.square) {
            *best = Some(Nearest { square, place, triangle, part });
        }
    }

    /// Squared distance of `p` from a node's box.
    fn square(&self, at: usize, p: DVec3) -> f64 {
        let node = &self.nodes[at];
        (node.low - p).max(p - node.high).max(DVec3::ZERO).length_squared()
    }
}
