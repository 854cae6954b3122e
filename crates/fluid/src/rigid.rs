//! Free bodies that meet walls and other bodies: they do not pass through, and do not bounce.
//!
//! Where points of one body are behind the surface of another, impulses take the approach out of both, one contact
//! after the other until all agree (sequential impulses: Catto 2005, "Iterative dynamics with temporal coherence"; the
//! law of Moreau and Jean, doi:10.1016/0045-7949(88)90286-4, without friction and restitution). A share of what they overlap is
//! taken back each time.

use crate::Shape;
use crate::body::{Body, BodyLoad, Medium};
use crate::periodic::Periodic;
use crate::solids::Walls;
use glam::{DMat3, DVec3, Vec3};

/// Rounds of impulses.
const ROUNDS: usize = 10;
/// Share of an overlap that a sub-step takes back, and the overlap that stays, m.
const TAKEN_BACK: f64 = 0.1;
const LEFT: f64 = 1e-5;
/// Points round the rim of a disc.
const RIM: u32 = 16;
/// Most points of a mesh; of more vertices some are passed over.
const MOST_POINTS: usize = 512;

/// A point of a body's surface that others are felt with: the middle of a ball, in the body's frame.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Feeler {
    place: DVec3,
    radius: f64,
}

/// The feelers of a shape.
fn feelers(shape: &Shape) -> Vec<Feeler> {
    let point = |place| Feeler { place, radius: 0.0 };
    match *shape {
        Shape::Sphere { radius } => vec![Feeler { place: DVec3::ZERO, radius }],
        Shape::Capsule { radius, length } => {
            [0.5, -0.5].map(|end| Feeler { place: DVec3::Y * (end * length), radius }).to_vec()
        }
        Shape::Box { size } => {
            let sign = |k: u32, bit: u32| if k >> bit & 1 == 0 { -0.5 } else { 0.5 };
            (0..8).map(|k| point(size * DVec3::new(sign(k, 0), sign(k, 1), sign(k, 2)))).collect()
        }
        Shape::Disc { radius, thickness } => (0..2 * RIM)
            .map(|k| {
                let turn = std::f64::consts::TAU * f64::from(k / 2) / f64::from(RIM);
                let face = if k % 2 == 0 { 0.5 } else { -0.5 };
                point(DVec3::new(radius * turn.cos(), face * thickness, radius * turn.sin()))
            })
            .collect(),
        Shape::Mesh(ref mesh) => {
            let step = mesh.vertices().len().div_ceil(MOST_POINTS);
            mesh.vertices().iter().step_by(step).map(|&v| point(v)).collect()
        }
        Shape::Slab { .. } | Shape::Drum { .. } => Vec::new(),
    }
}

/// Two surfaces that overlap. The free body is pushed along the normal.
#[derive(Clone, Copy, Debug)]
struct Overlap {
    free: usize,
    /// What it meets; none for a wall.
    other: Option<usize>,
    /// From the middle of each to the place, m.
    arms: [DVec3; 2],
    normal: DVec3,
    depth: f64,
    /// Sum of the impulses so far, N·s.
    impulse: f64,
}

/// What an impulse does to a free body: 1/mass (1/kg) with the mass that it carries along, as in `Body::push`, and the
/// inverse of its tensor of inertia in the scene's frame.
#[derive(Clone, Copy, Debug)]
struct Mobility {
    mass: f64,
    inertia: DMat3,
}

/// The contacts of all free bodies in one sub-step.
#[derive(Debug, Default)]
pub(crate) struct Rigid {
    feelers: Vec<Vec<Feeler>>,
    overlaps: Vec<Overlap>,
    /// Of each body; none of one that is not free.
    mobilities: Vec<Option<Mobility>>,
}

impl Rigid {
    /// Takes the shapes of `bodies`; without a free one there is nothing to do.
    pub fn take_shapes(&mut self, bodies: &[Body]) {
        self.feelers.clear();
        if bodies.iter().any(Body::is_free) {
            self.feelers.extend(bodies.iter().map(|b| feelers(&b.config.shape)));
        }
    }

    /// Parts what overlaps, after bodies have taken their loads over `dt`; what is not free gets the force as a load.
    pub fn part(
        &mut self,
        bodies: &mut [Body],
        walls: &Walls,
        periodic: &Periodic,
        loads: &mut [BodyLoad],
        (medium, dt): (&Medium, f64),
    ) {
        if self.feelers.len() != bodies.len() {
            return;
        }
        self.find(bodies, walls, periodic);
        self.mobilities.clear();
        self.mobilities.extend(bodies.iter().map(|body| body.is_free().then(|| Mobility::of(body, medium))));
        for _ in 0..ROUNDS {
            self.overlaps.iter_mut().for_each(|overlap| overlap.press(bodies, &self.mobilities));
        }
        for overlap in &self.overlaps {
            overlap.take_back(bodies, &self.mobilities, dt);
            if let Some(other) = overlap.other.filter(|&b| !bodies[b].is_free()) {
                let push = (overlap.normal * (overlap.impulse / dt)).as_vec3();
                loads[other].react(push, Vec3::ZERO, overlap.arms[1].as_vec3());
            }
        }
    }

    fn find(&mut self, bodies: &[Body], walls: &Walls, periodic: &Periodic) {
        self.overlaps.clear();
        for a in (0..bodies.len()).filter(|&a| bodies[a].is_free()) {
            self.find_walls(a, bodies, walls);
            for b in (0..bodies.len()).filter(|&b| b != a) {
                let away = bodies[a].state.position - bodies[b].state.position;
                let away = periodic.shortest(away.as_vec3()).as_dvec3();
                let reach =
                    bodies[a].config.shape.bounding_radius() + bodies[b].config.shape.bounding_radius();
                if away.length() < reach {
                    self.find_between(bodies, a, b, away);
                    // Of two free ones, both look.
                    if !bodies[b].is_free() {
                        self.find_between(bodies, b, a, -away);
                    }
                }
            }
        }
    }

    fn find_walls(&mut self, a: usize, bodies: &[Body], walls: &Walls) {
        let state = bodies[a].state;
        for feeler in &self.feelers[a] {
            let arm = state.orientation * feeler.place;
            let place = (state.position + arm).as_vec3();
            walls.visit(place, feeler.radius as f32, |distance, normal, _| {
                let (normal, depth) = (normal.as_dvec3(), feeler.radius - f64::from(distance));
                let arms = [arm - normal * feeler.radius, DVec3::ZERO];
                self.overlaps.push(Overlap { free: a, other: None, arms, normal, depth, impulse: 0.0 });
            });
        }
    }

    /// Where feelers of `a` are behind the surface of `b`; `away`: from b to a.
    fn find_between(&mut self, bodies: &[Body], a: usize, b: usize, away: DVec3) {
        let (of_a, of_b) = (bodies[a].state, bodies[b].state);
        for feeler in &self.feelers[a] {
            let arm = of_a.orientation * feeler.place;
            let local = of_b.orientation.inverse() * (away + arm);
            let (distance, normal) = bodies[b].config.shape.distance(local.as_vec3());
            let depth = feeler.radius - f64::from(distance);
            if depth <= 0.0 {
                continue;
            }
            let normal = of_b.orientation * normal.as_dvec3();
            let arm = arm - normal * feeler.radius;
            let overlap = if bodies[a].is_free() {
                Overlap { free: a, other: Some(b), arms: [arm, away + arm], normal, depth, impulse: 0.0 }
            } else {
                let arms = [away + arm, arm];
                Overlap { free: b, other: Some(a), arms, normal: -normal, depth, impulse: 0.0 }
            };
            self.overlaps.push(overlap);
        }
    }
}

impl Overlap {
    /// The body's velocity at the place, m/s.
    fn velocity(body: &Body, arm: DVec3) -> DVec3 {
        body.state.velocity + body.state.angular_velocity.cross(arm)
    }

    fn press(&mut self, bodies: &mut [Body], mobilities: &[Option<Mobility>]) {
        let (mut approach, mut gives) = (0.0, 0.0);
        for (body, arm, sign) in self.sides() {
            approach -= sign * Self::velocity(&bodies[body], arm).dot(self.normal);
            let turned = arm.cross(self.normal);
            gives += mobilities[body].map_or(0.0, |m| m.mass + turned.dot(m.inertia * turned));
        }
        let impulse = (self.impulse + approach / gives).max(0.0);
        let push = self.normal * (impulse - self.impulse);
        if !push.is_finite() {
            return;
        }
        self.impulse = impulse;
        for (body, arm, sign) in self.sides() {
            if let Some(m) = mobilities[body] {
                let state = &mut bodies[body].state;
                state.velocity += push * (sign * m.mass);
                state.angular_velocity += m.inertia * arm.cross(push * sign);
            }
        }
    }

    /// The bodies, their arms, and which way the normal pushes them.
    fn sides(&self) -> impl Iterator<Item = (usize, DVec3, f64)> + use<> {
        let other = self.other.map(|b| (b, self.arms[1], -1.0));
        std::iter::once((self.free, self.arms[0], 1.0)).chain(other)
    }

    /// Parts the two by a share of what they overlap, and lets the bodies' accelerations know what stopped them.
    fn take_back(&self, bodies: &mut [Body], mobilities: &[Option<Mobility>], dt: f64) {
        let mass = |body: usize| mobilities[body].map_or(0.0, |m| m.mass);
        let gives: f64 = self.sides().map(|(body, ..)| mass(body)).sum();
        let way = TAKEN_BACK * (self.depth - LEFT).max(0.0) / gives;
        for (body, _, sign) in self.sides() {
            let (away, share) = (self.normal * sign, mass(body));
            bodies[body].state.position += away * (share * way);
            // What was in the way takes the acceleration away that led into it, and no more: a blow would go on in `fall`.
            let into =
                (self.push_of_others(bodies, body, away) - bodies[body].acceleration.dot(away)).max(0.0);
            bodies[body].acceleration += away * into.min(share * self.impulse / dt);
        }
    }

    /// Acceleration (m/s²) along `away` of what `body` meets, where that moves towards it.
    fn push_of_others(&self, bodies: &[Body], body: usize, away: DVec3) -> f64 {
        let others = self.sides().filter(|(b, ..)| *b != body);
        others.map(|(b, ..)| bodies[b].acceleration.dot(away)).fold(0.0, f64::max)
    }
}

impl Mobility {
    fn of(body: &Body, medium: &Medium) -> Self {
        let turn = DMat3::from_quat(body.state.orientation);
        let inertia = turn * body.config.shape.inertia(body.config.mass).inverse() * turn.transpose();
        Self { mass: (body.config.mass + body.carried(medium)).recip(), inertia }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Aabb, BodyConfig, BodyDrive, BodyMotion, Container, FluidSettings, World};

    const G: DVec3 = DVec3::new(0.0, -9.81, 0.0);

    /// Bodies at these places; those that are not free stay.
    fn run(shapes: &[(Shape, DVec3, bool)], seconds: f64, density: f64) -> (Vec<Body>, Vec<BodyLoad>) {
        let inner = Aabb { min: DVec3::splat(-0.1), max: DVec3::splat(0.1) };
        let world = World { container: Some(Container::open_box(inner)), ..World::default() };
        let (walls, periodic) = (Walls::new(&world, &FluidSettings::default()), Periodic::new(&world));
        let mut bodies: Vec<_> = shapes
            .iter()
            .map(|(shape, position, _)| {
                Body::new(BodyConfig {
                    shape: shape.clone(),
                    position: *position,
                    mass: 0.1,
                    ..BodyConfig::default()
                })
            })
            .collect();
        let motion = BodyMotion { drive: BodyDrive::Free, path: &[] };
        for (body, (.., free)) in bodies.iter_mut().zip(shapes) {
            let drive = if *free { BodyDrive::Free } else { BodyDrive::Led };
            body.begin_frame(&BodyMotion { drive, path: &[] }, 1.0);
        }
        let medium = Medium { density, gravity: G, prompt: false };
        let mut rigid = Rigid::default();
        rigid.take_shapes(&bodies);
        let (dt, mut loads) = (5e-4, vec![BodyLoad::default(); bodies.len()]);
        for _ in 0..(seconds / dt) as usize {
            loads.fill(BodyLoad::default());
            for body in bodies.iter_mut().filter(|b| b.is_free()) {
                body.advance(&motion, 1.0, dt);
                body.push(&BodyLoad::default(), &medium, dt);
            }
            rigid.part(&mut bodies, &walls, &periodic, &mut loads, (&medium, dt));
        }
        (bodies, loads)
    }

    fn shapes() -> [(Shape, f64); 4] {
        [
            (Shape::Sphere { radius: 0.02 }, 0.02),
            (Shape::Capsule { radius: 0.01, length: 0.03 }, 0.025),
            (Shape::Box { size: DVec3::new(0.03, 0.02, 0.04) }, 0.01),
            (Shape::Disc { radius: 0.03, thickness: 0.01 }, 0.005),
        ]
    }

    #[test]
    fn what_falls_lies_on_the_floor_and_stays() {
        for (shape, half) in shapes() {
            let (bodies, _) = run(&[(shape.clone(), DVec3::Y * (half - 0.05), true)], 2.0, 0.0);
            let s = bodies[0].state;
            assert!((s.position.y - (half - 0.1)).abs() < 1e-4, "{shape:?}: {}", s.position);
            assert!(s.velocity.length() < 5e-3 && s.angular_velocity.length() < 0.1, "{shape:?}: {s:?}");
        }
    }

    /// Two rest on each other; the lower one, which is held, feels the weight, whatever fluid is carried along.
    #[test]
    fn a_body_rests_on_another_that_feels_its_weight() {
        for ((shape, half), density) in shapes().into_iter().zip([0.0, 1000.0, 0.0, 5000.0]) {
            let plate = Shape::Disc { radius: 0.08, thickness: 0.01 };
            let above = DVec3::Y * (half + 0.02);
            let (bodies, loads) =
                run(&[(plate, DVec3::ZERO, false), (shape.clone(), above, true)], 2.0, density);
            let y = bodies[1].state.position.y;
            assert!((y - half - 0.005).abs() < 1e-4, "{shape:?}: {y}");
            assert!((loads[0].force().y / (0.1 * G.y) - 1.0).abs() < 0.02, "{shape:?}: {:?}", loads[0]);
            assert!(bodies[1].acceleration.length() < 0.1, "{shape:?}: {}", bodies[1].acceleration);
            assert_eq!(bodies[0].state.velocity, DVec3::ZERO);
        }
    }

    /// The mass of fluid that a light body would carry along throws it up from no floor where there is no fluid.
    #[test]
    fn a_light_body_does_not_bounce_in_air() {
        let ball = Shape::Sphere { radius: 0.02 };
        let (bodies, _) = run(&[(ball, DVec3::ZERO, true)], 0.25, 50_000.0);
        let s = bodies[0].state;
        assert!((s.position.y + 0.08).abs() < 1e-3 && s.velocity.length() < 0.02, "{s:?}");
    }

    #[test]
    fn two_free_bodies_keep_their_momentum() {
        let ball = Shape::Sphere { radius: 0.02 };
        let inner = World::default();
        let (walls, periodic) = (Walls::new(&inner, &FluidSettings::default()), Periodic::new(&inner));
        let medium = Medium { density: 1000.0, gravity: DVec3::ZERO, prompt: false };
        let mut bodies: Vec<_> = [-0.019, 0.019]
            .map(|x| {
                Body::new(BodyConfig { shape: ball.clone(), position: DVec3::X * x, ..BodyConfig::default() })
            })
            .into();
        for (body, speed) in bodies.iter_mut().zip([3.0, -1.0]) {
            body.begin_frame(&BodyMotion { drive: BodyDrive::Free, path: &[] }, 1.0);
            body.state.velocity = DVec3::X * speed;
        }
        let mut rigid = Rigid::default();
        rigid.take_shapes(&bodies);
        rigid.part(&mut bodies, &walls, &periodic, &mut [BodyLoad::default(); 2], (&medium, 1e-3));
        let [a, b] = [bodies[0].state.velocity, bodies[1].state.velocity];
        assert!((a - DVec3::X).length() < 1e-6 && (b - DVec3::X).length() < 1e-6, "{a} {b}");
    }
}
