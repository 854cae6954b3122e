//! All solid surfaces round a particle: ground, container and bodies, behind one visit.

use crate::World;
use crate::body::{BodyNow, BodyTable, BodyTables, Contact};
use crate::wall::{WallTable, WallTerms};
use glam::Vec3;

/// Ground and container, in f32.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Walls {
    ground: Option<f32>,
    container: Option<(Vec3, Vec3)>,
    /// Half thickness of the container's walls, m.
    half: f32,
}

impl Walls {
    pub fn new(world: &World, spacing: f64) -> Self {
        let corners = world.container.map(|c| (c.inner.min.as_vec3(), c.inner.max.as_vec3()));
        Self { ground: world.ground.map(|y| y as f32), container: corners, half: spacing as f32 }
    }

    /// Calls `meet(distance, normal)` for each wall closer than `margin`.
    pub fn visit(&self, p: Vec3, margin: f32, mut meet: impl FnMut(f32, Vec3)) {
        if let Some(height) = self.ground
            && p.y - height < margin
        {
            meet(p.y - height, Vec3::Y);
        }
        if let Some((min, max)) = self.container
            && p.y < max.y
        {
            let sides = [
                (p.x - min.x, Vec3::X),
                (max.x - p.x, -Vec3::X),
                (p.z - min.z, Vec3::Z),
                (max.z - p.z, -Vec3::Z),
            ];
            if sides.iter().all(|s| s.0 > -self.half) {
                visit_inside(p.y - min.y, &sides, margin, meet);
            } else if p.y > min.y {
                self.visit_outside(&sides, margin, meet);
            }
        }
    }

    /// A particle outside the box meets the one wall that it stands before, from its outer side.
    fn visit_outside(&self, sides: &[(f32, Vec3); 4], margin: f32, mut meet: impl FnMut(f32, Vec3)) {
        let mut behind = sides.iter().filter(|s| s.0 <= -self.half);
        if let (Some(&(d, inward)), None) = (behind.next(), behind.next())
            && -d - 2.0 * self.half < margin
        {
            meet(-d - 2.0 * self.half, -inward);
        }
    }
}

fn visit_inside(above: f32, sides: &[(f32, Vec3); 4], margin: f32, mut meet: impl FnMut(f32, Vec3)) {
    if above < margin {
        meet(above, Vec3::Y);
    }
    for &(distance, normal) in sides {
        if distance < margin {
            meet(distance, normal);
        }
    }
}

/// Everything solid, frozen for one sub-step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Solids<'a> {
    pub walls: &'a Walls,
    pub bodies: &'a [BodyNow],
    pub plane: &'a WallTable,
    pub tables: &'a BodyTables,
}

/// One surface as a particle meets it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Meeting {
    pub contact: Contact,
    /// Number of the body, or none for a wall.
    pub body: Option<usize>,
    /// Acceleration of the surface, m/s².
    pub acceleration: Vec3,
    /// 1/mass of what is hit, 1/kg.
    pub inverse_mass: f32,
}

impl Solids<'_> {
    /// Calls `meet` for each surface closer than `margin` to `p`.
    pub fn visit(&self, p: Vec3, margin: f32, mut meet: impl FnMut(Meeting)) {
        self.walls.visit(p, margin, |distance, normal| {
            let contact = Contact { distance, normal, velocity: Vec3::ZERO, arm: Vec3::ZERO };
            meet(Meeting { contact, body: None, acceleration: Vec3::ZERO, inverse_mass: 0.0 });
        });
        for (index, body) in self.bodies.iter().enumerate() {
            if let Some(contact) = body.contact(p, margin) {
                let (acceleration, inverse_mass) = (body.acceleration, body.inverse_mass);
                meet(Meeting { contact, body: Some(index), acceleration, inverse_mass });
            }
        }
    }

    /// Kernel integrals over the solid that was met. At an edge their normal is not that of the nearest surface: it
    /// becomes the meeting's.
    pub fn terms(&self, meeting: &mut Meeting) -> WallTerms {
        let Contact { distance, arm, .. } = meeting.contact;
        let Some(index) = meeting.body else { return self.plane.at(distance) };
        match self.tables.get(index) {
            BodyTable::Distance(table) => table.at(distance),
            BodyTable::Place(map) => {
                let frame = self.bodies[index].frame;
                let (terms, outward) = map.at(frame.to_body_direction(arm));
                let turned = outward.map(|n| frame.to_scene_direction(n));
                meeting.contact.normal = turned.unwrap_or(meeting.contact.normal);
                terms
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Aabb, OpenBox};
    use glam::DVec3;

    fn met(p: Vec3) -> Vec<(f32, Vec3)> {
        let inner = Aabb { min: DVec3::new(-1.0, 0.0, -1.0), max: DVec3::new(1.0, 0.5, 1.0) };
        let world = World {
            bounds: Aabb { min: DVec3::splat(-9.0), max: DVec3::splat(9.0) },
            ground: Some(-1.0),
            container: Some(OpenBox { inner }),
            ..World::default()
        };
        let mut list = vec![];
        Walls::new(&world, 0.05).visit(p, 0.2, |d, n| list.push((d, n)));
        list
    }

    #[test]
    fn an_open_box_has_a_floor_and_four_walls_from_both_sides() {
        assert_eq!(met(Vec3::new(0.0, 0.3, 0.0)), vec![]);
        assert_eq!(met(Vec3::new(0.0, 0.1, 0.0)), vec![(0.1, Vec3::Y)]);
        let corner = met(Vec3::new(0.9, 0.1, -0.9));
        assert_eq!(corner.len(), 3);
        assert!(corner.contains(&(0.1, Vec3::Y)));
        let outside = met(Vec3::new(1.2, 0.3, 0.0));
        assert_eq!(outside.len(), 1);
        assert!((outside[0].0 - 0.1).abs() < 1e-5 && outside[0].1 == Vec3::X);
        assert_eq!(met(Vec3::new(0.95, 0.6, 0.0)), vec![], "above the rim");
        assert_eq!(met(Vec3::new(5.0, -0.9, 0.0)), vec![(0.100000024, Vec3::Y)]);
    }
}
