//! All solid surfaces round a particle: ground, container and bodies, behind one visit.

use crate::body::{BodyNow, BodyTable, BodyTables, Contact};
use crate::wall::{WallTable, WallTerms};
use crate::{Container, ContainerForm, FluidSettings, World};
use glam::Vec3;

/// Axes that count for the distance from an upright one.
const LEVEL: Vec3 = Vec3::new(1.0, 0.0, 1.0);

/// Ground and container, in f32.
#[derive(Clone, Debug)]
pub(crate) struct Walls {
    ground: Option<f32>,
    vessel: Option<Vessel>,
    /// Half thickness of the container's walls, m.
    half: f32,
    /// The kernel's integrals over a round wall, from within.
    hollow: Option<WallTable>,
}

/// The container.
#[derive(Clone, Copy, Debug)]
enum Vessel {
    Box {
        min: Vec3,
        max: Vec3,
    },
    /// About a vertical axis through the middle of its floor.
    Cylinder {
        foot: Vec3,
        top: f32,
        radius: f32,
    },
    /// Round its centre.
    Bowl {
        centre: Vec3,
        top: f32,
        radius: f32,
    },
}

impl Vessel {
    fn new(container: &Container) -> Self {
        let (foot, top) = (container.foot().as_vec3(), container.inner.max.y as f32);
        let radius = container.radius() as f32;
        match container.form {
            ContainerForm::Box => {
                Self::Box { min: container.inner.min.as_vec3(), max: container.inner.max.as_vec3() }
            }
            ContainerForm::Cylinder => Self::Cylinder { foot, top, radius },
            ContainerForm::Bowl => Self::Bowl { centre: foot + radius * Vec3::Y, top, radius },
        }
    }
}

impl Walls {
    pub fn new(world: &World, settings: &FluidSettings) -> Self {
        let round = world.container.filter(|c| c.form != ContainerForm::Box);
        let table = |c: Container| {
            WallTable::round(c.mean_curvature(), settings.kernel_in_use(), settings.support_length())
        };
        Self {
            ground: world.ground.map(|y| y as f32),
            vessel: world.container.as_ref().map(Vessel::new),
            half: settings.spacing as f32,
            hollow: round.map(table),
        }
    }

    /// Calls `meet(distance, normal, whether it is a round wall's inside)` for each wall closer than `margin`.
    pub fn visit(&self, p: Vec3, margin: f32, mut meet: impl FnMut(f32, Vec3, bool)) {
        if let Some(height) = self.ground
            && p.y - height < margin
        {
            meet(p.y - height, Vec3::Y, false);
        }
        match self.vessel {
            Some(Vessel::Box { min, max }) if p.y < max.y => {
                self.visit_box(p, min, max, margin, |distance, normal| meet(distance, normal, false));
            }
            Some(Vessel::Cylinder { foot, top, radius }) if p.y < top => {
                let above = p.y - foot.y;
                let inside = self.visit_round(p - foot, LEVEL, radius, margin, |d, n, hollow| {
                    if hollow || above > 0.0 {
                        meet(d, n, hollow);
                    }
                });
                if inside && above < margin {
                    meet(above, Vec3::Y, false);
                }
            }
            Some(Vessel::Bowl { centre, top, radius }) if p.y < top => {
                self.visit_round(p - centre, Vec3::ONE, radius, margin, meet);
            }
            _ => {}
        }
    }

    /// The round wall as met from within or from outside, and which; `arm` counts along `axes`.
    fn visit_round(
        &self,
        arm: Vec3,
        axes: Vec3,
        radius: f32,
        margin: f32,
        mut meet: impl FnMut(f32, Vec3, bool),
    ) -> bool {
        let arm = arm * axes;
        let (length, outward) = (arm.length(), arm.normalize_or(Vec3::X));
        let inside = radius - length;
        if inside > -self.half {
            if inside < margin {
                meet(inside, -outward, true);
            }
            return true;
        }
        let outside = -inside - 2.0 * self.half;
        if outside < margin {
            meet(outside, outward, false);
        }
        false
    }

    /// Where one that was at `from` and is put to `to` by a body may go: through no wall of the container.
    pub fn hold(&self, from: Vec3, to: Vec3) -> Vec3 {
        let within = |arm: Vec3, axes: Vec3, radius: f32| (arm * axes).length() < radius + self.half;
        let back = |centre: Vec3, axes: Vec3, radius: f32| {
            let arm = to - centre;
            arm * (Vec3::ONE - axes) + (arm * axes).clamp_length_max(radius) + centre
        };
        match self.vessel {
            Some(Vessel::Box { min, max }) if from.y < max.y && to.y < max.y => {
                let inside = from.cmpgt(min - self.half).all() && from.cmplt(max + self.half).all();
                if inside { to.clamp(min, max) } else { to }
            }
            Some(Vessel::Cylinder { foot, top, radius }) if from.y < top && to.y < top => {
                let inside = from.y > foot.y - self.half && within(from - foot, LEVEL, radius);
                let held = back(foot, LEVEL, radius);
                if inside { held.with_y(held.y.max(foot.y)) } else { to }
            }
            Some(Vessel::Bowl { centre, top, radius }) if from.y < top && to.y < top => {
                let inside = within(from - centre, Vec3::ONE, radius);
                if inside { back(centre, Vec3::ONE, radius) } else { to }
            }
            _ => to,
        }
    }

    fn visit_box(&self, p: Vec3, min: Vec3, max: Vec3, margin: f32, meet: impl FnMut(f32, Vec3)) {
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
    /// Those that may be met.
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
    /// It is the inside of a round wall.
    hollow: bool,
}

impl Solids<'_> {
    /// Calls `meet` for each surface closer than `margin` to `p`.
    pub fn visit(&self, p: Vec3, margin: f32, mut meet: impl FnMut(Meeting)) {
        self.walls.visit(p, margin, |distance, normal, hollow| {
            let contact = Contact { distance, normal, velocity: Vec3::ZERO, arm: Vec3::ZERO };
            meet(Meeting { contact, body: None, acceleration: Vec3::ZERO, inverse_mass: 0.0, hollow });
        });
        for body in self.bodies {
            if let Some(contact) = body.contact(p, margin) {
                let (acceleration, inverse_mass) = (body.acceleration, body.inverse_mass);
                meet(Meeting { contact, body: Some(body.index), acceleration, inverse_mass, hollow: false });
            }
        }
    }

    /// Kernel integrals over the solid that was met. At an edge their normal is not that of the nearest surface: it
    /// becomes the meeting's.
    pub fn terms(&self, meeting: &mut Meeting) -> WallTerms {
        let Contact { distance, arm, .. } = meeting.contact;
        let Some(index) = meeting.body else {
            let hollow = self.walls.hollow.as_ref().filter(|_| meeting.hollow);
            return hollow.unwrap_or(self.plane).at(distance);
        };
        match self.tables.get(index) {
            BodyTable::Distance(table) => table.at(distance),
            BodyTable::Place(map) => {
                let Some(body) = self.bodies.iter().find(|b| b.index == index) else {
                    return WallTerms::default();
                };
                let frame = body.frame;
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
    use crate::Aabb;
    use glam::DVec3;

    fn met_in(form: ContainerForm, p: Vec3) -> Vec<(f32, Vec3)> {
        let inner = Aabb { min: DVec3::new(-1.0, 0.0, -1.0), max: DVec3::new(1.0, 0.5, 1.0) };
        let world = World {
            bounds: Aabb { min: DVec3::splat(-9.0), max: DVec3::splat(9.0) },
            ground: Some(-1.0),
            container: Some(Container { inner, form }),
            ..World::default()
        };
        let mut list = vec![];
        let settings = FluidSettings { spacing: 0.05, ..FluidSettings::default() };
        Walls::new(&world, &settings).visit(p, 0.2, |d, n, _| list.push((d, n)));
        list
    }

    fn met(p: Vec3) -> Vec<(f32, Vec3)> {
        met_in(ContainerForm::Box, p)
    }

    fn close(found: &[(f32, Vec3)], expected: &[(f32, Vec3)]) {
        assert_eq!(found.len(), expected.len(), "{found:?}");
        for (f, e) in found.iter().zip(expected) {
            assert!((f.0 - e.0).abs() < 1e-5 && (f.1 - e.1).length() < 1e-5, "{found:?}");
        }
    }

    #[test]
    fn a_round_tank_and_a_bowl_have_walls_from_both_sides() {
        let tank = |p: [f32; 3]| met_in(ContainerForm::Cylinder, Vec3::from(p));
        close(&tank([0.0, 0.3, 0.54]), &[]);
        close(&tank([0.54, 0.1, 0.72]), &[(0.1, Vec3::new(-0.6, 0.0, -0.8)), (0.1, Vec3::Y)]);
        close(&tank([0.0, 0.3, 1.2]), &[(0.1, Vec3::Z)]);
        close(&tank([0.9, 0.6, 0.0]), &[]);
        // One metre wide and half as deep: part of a ball of 1.25 m about y = 1.25.
        let bowl = |p: [f32; 3]| met_in(ContainerForm::Bowl, Vec3::from(p));
        close(&bowl([0.0, 0.1, 0.0]), &[(0.1, Vec3::Y)]);
        close(&bowl([0.69, 0.33, 0.0]), &[(0.1, Vec3::new(-0.6, 0.8, 0.0))]);
        close(&bowl([0.0, -0.2, 0.0]), &[(0.1, Vec3::NEG_Y)]);
        close(&bowl([0.0, 0.3, 0.0]), &[]);
    }

    #[test]
    fn a_body_puts_nobody_through_a_wall() {
        let inner = Aabb { min: DVec3::new(-1.0, 0.0, -1.0), max: DVec3::new(1.0, 1.0, 1.0) };
        let hold = |form, from: [f32; 3], to: [f32; 3]| {
            let world = World { container: Some(Container { inner, form }), ..World::default() };
            let settings = FluidSettings { spacing: 0.05, ..FluidSettings::default() };
            Walls::new(&world, &settings).hold(from.into(), to.into()).to_array()
        };
        let (inside, outside) = ([0.5, 0.5, 0.0], [1.5, 0.5, 0.0]);
        for form in [ContainerForm::Box, ContainerForm::Cylinder] {
            assert_eq!(hold(form, inside, outside), [1.0, 0.5, 0.0]);
            assert_eq!(hold(form, inside, [0.5, -0.3, 0.0]), [0.5, 0.0, 0.0]);
            assert_eq!(hold(form, inside, [1.5, 1.1, 0.0]), [1.5, 1.1, 0.0], "over the rim");
            assert_eq!(hold(form, [1.2, 0.5, 0.0], outside), outside, "from outside");
        }
        assert_eq!(hold(ContainerForm::Bowl, [0.0, 0.5, 0.0], [0.0, -0.3, 0.0]), [0.0, 0.0, 0.0]);
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
