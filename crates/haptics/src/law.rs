//! A force that depends on where a tool is and how it moves, as a small table.

use crate::ToolState;
use glam::{DVec3, Mat3, Vec3};

/// How far outside of its nodes a law is carried on, in their distances.
const BEYOND: f64 = 0.25;

/// The force at one place, and its slope by the tool's velocity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LawNode {
    /// Force, N.
    pub force: Vec3,
    /// Its slope, N·s/m.
    pub by_velocity: Mat3,
}

impl LawNode {
    /// No force.
    pub const ZERO: Self = Self { force: Vec3::ZERO, by_velocity: Mat3::ZERO };

    /// Both together.
    pub fn plus(&self, other: &Self) -> Self {
        Self { force: self.force + other.force, by_velocity: self.by_velocity + other.by_velocity }
    }

    /// `factor` times as much.
    pub fn scaled(&self, factor: f64) -> Self {
        let factor = factor as f32;
        Self { force: self.force * factor, by_velocity: self.by_velocity * factor }
    }
}

/// A force as a table over 3 × 3 × 3 places: quadratic between them, linear in the velocity, and from a little outside of
/// them on the same. Costs some 0.1 µs a look.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Law {
    centre: DVec3,
    velocity: DVec3,
    spacing: f64,
    nodes: [LawNode; 27],
}

impl Law {
    /// The law of `force` round `centre` (m), for velocities round `velocity` (m/s), its places `spacing` metres apart.
    pub fn tabulate(
        centre: DVec3,
        velocity: DVec3,
        spacing: f64,
        mut force: impl FnMut(DVec3) -> LawNode,
    ) -> Self {
        let step = |k: usize| k as f64 - 1.0;
        let place = |k: usize| DVec3::new(step(k % 3), step(k / 3 % 3), step(k / 9)) * spacing;
        let nodes = std::array::from_fn(|k| force(centre + place(k)));
        // Where nothing acts, as out of reach of all fluid, nothing is looked up either.
        if nodes.iter().all(|node| *node == LawNode::ZERO) {
            return Self::default();
        }
        Self { centre, velocity, spacing, nodes }
    }

    /// The force (N) on a tool in this state.
    pub fn at(&self, tool: &ToolState) -> DVec3 {
        if self.is_none() {
            return DVec3::ZERO;
        }
        let most = 1.0 + BEYOND;
        let at =
            ((tool.position - self.centre) / self.spacing).clamp(DVec3::splat(-most), DVec3::splat(most));
        let weights =
            at.as_vec3().to_array().map(|s| [0.5 * s * (s - 1.0), 1.0 - s * s, 0.5 * s * (s + 1.0)]);
        let mut sum = LawNode::ZERO;
        for (k, node) in self.nodes.iter().enumerate() {
            let weight = weights[0][k % 3] * weights[1][k / 3 % 3] * weights[2][k / 9];
            sum.force += node.force * weight;
            sum.by_velocity += node.by_velocity * weight;
        }
        let change = (tool.velocity - self.velocity).as_vec3();
        (sum.force + sum.by_velocity * change).as_dvec3()
    }

    /// Whether there is no force anywhere.
    pub(crate) fn is_none(&self) -> bool {
        self.spacing <= 0.0
    }

    /// True when no number in it is NaN or infinite.
    pub fn is_finite(&self) -> bool {
        let places = self.centre.is_finite() && self.velocity.is_finite() && self.spacing.is_finite();
        places && self.nodes.iter().all(|n| n.force.is_finite() && n.by_velocity.is_finite())
    }

    /// The law with that of `other`, which is of the same places or none, added.
    pub fn plus(mut self, other: &Self) -> Self {
        if self.is_none() {
            return *other;
        }
        for (node, more) in self.nodes.iter_mut().zip(&other.nodes) {
            *node = node.plus(more);
        }
        self
    }

    /// The same law with `factor` times the force.
    pub fn scaled(mut self, factor: f64) -> Self {
        for node in &mut self.nodes {
            *node = node.scaled(factor);
        }
        self
    }
}

impl Default for Law {
    /// No force anywhere.
    fn default() -> Self {
        Self { centre: DVec3::ZERO, velocity: DVec3::ZERO, spacing: 0.0, nodes: [LawNode::ZERO; 27] }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn field(p: DVec3) -> LawNode {
        let p = p.as_vec3();
        let force = Vec3::new(p.x * p.y, p.z * p.z - p.x, 1.0 + p.y);
        LawNode { force, by_velocity: Mat3::from_diagonal(Vec3::new(-1.0, -2.0, -0.5 - p.x)) }
    }

    #[test]
    fn what_is_quadratic_in_place_and_linear_in_velocity_is_exact() {
        let centre = DVec3::new(0.1, -0.2, 0.3);
        let law = Law::tabulate(centre, DVec3::X * 0.1, 0.05, field);
        for shift in [DVec3::ZERO, DVec3::new(0.02, -0.04, 0.05), DVec3::new(-0.06, 0.01, 0.03)] {
            let velocity = DVec3::new(0.3, -0.1, 0.2);
            let tool = ToolState { velocity, ..ToolState::at(centre + shift) };
            let node = field(tool.position);
            let exact = node.force + node.by_velocity * (velocity - DVec3::X * 0.1).as_vec3();
            assert!((law.at(&tool) - exact.as_dvec3()).length() < 1e-5, "{}", law.at(&tool));
        }
    }

    #[test]
    fn a_law_of_no_force_is_none_and_adds_nothing() {
        let none = Law::tabulate(DVec3::X, DVec3::ZERO, 0.01, |_| LawNode::ZERO);
        assert_eq!(none, Law::default());
        let law = Law::tabulate(DVec3::ZERO, DVec3::ZERO, 0.01, field);
        assert_eq!([none.plus(&law), law.plus(&none), law.plus(&none.scaled(2.0))], [law; 3]);
    }

    #[test]
    fn far_away_it_goes_on_as_at_its_edge_and_without_nodes_there_is_none() {
        let law = Law::tabulate(DVec3::ZERO, DVec3::ZERO, 0.01, field);
        let at = |x: f64| law.at(&ToolState::at(DVec3::X * x));
        assert_eq!(at(0.0125), at(5.0));
        assert_eq!(Law::default().at(&ToolState::at(DVec3::X)), DVec3::ZERO);
        assert!(
            (law.scaled(0.5).at(&ToolState::at(DVec3::Z)) - 0.5 * law.at(&ToolState::at(DVec3::Z))).length()
                < 1e-6
        );
    }
}
