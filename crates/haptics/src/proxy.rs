//! The proxy: where a tool would be if solids could stop a hand, and the force that draws the hand to it.
//!
//! The tool is the ball round it. Its proxy is the point nearest to the hand that the ball can get to without passing
//! through a solid (god object: Zilles & Salisbury 1995, doi:10.1109/IROS.1995.525876; with a size, and moved in
//! steps between planes: Ruspini, Kolarov & Khatib 1997, doi:10.1145/258734.258878). All solids are convex. So at any
//! place of the proxy each of them lies whole behind one plane, and within all those planes the proxy may go anywhere
//! at once, however fast the hand is: it goes to the place there that is nearest to the hand, looks for the planes
//! again, and so on until it stays.
//!
//! Hand and proxy are held together by a spring and a damper, which push along the normals and have no friction
//! (virtual coupling: Colgate, Stanley & Brown 1995, doi:10.1109/IROS.1995.525875). At a tick of T seconds the spring
//! K and the damper B never give a hand more energy than they took if the device itself damps with
//! b > K T/2 + B (Colgate & Schenkel, Journal of Robotic Systems 14(1), 1997): at 1 kHz and without a damper,
//! K < 2000 b.

use crate::{Solid, SolidKind, ToolState};
use glam::{DMat3, DQuat, DVec3};

#[cfg(test)]
mod tests;

/// Contacts that a tool can have at once, and that a report has room for.
pub const MAX_CONTACTS: usize = 8;

/// Moves of the proxy in one tick; it goes on at the next.
const MOST_MOVES: usize = 32;
/// A shorter move is none, m.
const SETTLED_M: f64 = 1e-9;
/// What is closer touches, m.
const TOUCHES_M: f64 = 1e-6;
/// Planes whose normals are nearer to each other than this (as the square of the sine) count as one.
const PARALLEL: f64 = 1e-10;

/// How solids feel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SolidFeel {
    /// Stiffness of the virtual coupling, N/m; 0: solids are not felt.
    pub stiffness_n_per_m: f64,
    /// Its damping, N·s/m.
    pub damping_n_s_per_m: f64,
}

/// A place at which the tool touches a solid, in the scene's frame.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Contact {
    /// Where, on the surface, m.
    pub point: DVec3,
    /// Outward unit normal of the surface.
    pub normal: DVec3,
    /// How far the hand is behind where it could be, along the normal, m.
    pub depth_m: f64,
    /// Force on the hand, N.
    pub force: DVec3,
    /// What is touched.
    pub kind: SolidKind,
    /// Which of that kind, from 0.
    pub index: u32,
}

/// What came of a tick: where the tool is, and what it touches.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Touching {
    /// Position of the proxy, m.
    pub proxy: DVec3,
    /// Its orientation, unit quaternion: the tool's.
    pub orientation: DQuat,
    /// Velocity of the proxy, m/s: that of the hand, but with a solid that it presses on.
    pub velocity: DVec3,
    contacts: [Contact; MAX_CONTACTS],
    count: usize,
}

impl Touching {
    /// A tool that touches nothing.
    pub fn nothing(tool: &ToolState) -> Self {
        let (proxy, orientation, velocity) = (tool.position, tool.orientation, tool.velocity);
        Self { proxy, orientation, velocity, ..Self::default() }
    }

    /// The contacts.
    pub fn contacts(&self) -> &[Contact] {
        &self.contacts[..self.count]
    }

    /// Force of all contacts on the hand, N.
    pub fn force(&self) -> DVec3 {
        self.contacts().iter().map(|c| c.force).sum()
    }
}

/// The proxy of one tool. Thread: servo; it allocates nothing.
#[derive(Clone, Debug, Default)]
pub struct Proxy {
    position: Option<DVec3>,
    pressed: Pressed,
}

impl Proxy {
    /// Forgets where it was: it begins anew at the hand.
    pub fn reset(&mut self) {
        *self = Self::default();
    }

    /// Goes as near to `hand` (m) as a ball of `radius` metres gets among the `solids`.
    pub fn follow(&mut self, hand: DVec3, radius: f64, solids: &[Solid]) {
        let mut at = self.position.unwrap_or(hand);
        for _ in 0..MOST_MOVES {
            let planes = Planes::around(at, hand, radius, solids);
            self.pressed = planes.nearest_to(hand).unwrap_or(Pressed { place: at, ..Pressed::default() });
            let moved = self.pressed.place.distance(at);
            at = self.pressed.place;
            if moved < SETTLED_M || self.pressed.count == 0 {
                break;
            }
        }
        self.position = Some(at);
    }

    /// What the hand feels at the place that [`follow`](Self::follow) found among the same `solids`.
    pub fn touch(&self, hand: &ToolState, radius: f64, solids: &[Solid], feel: SolidFeel) -> Touching {
        let proxy = self.position.unwrap_or(hand.position);
        let mut pressed = self.pressed;
        pressed.keep(|plane| solids[plane.solid].distance(proxy).0 - radius <= TOUCHES_M);
        let point = |plane: &Plane| proxy - plane.normal * radius;
        let approach = pressed.planes.map(|p| {
            (hand.velocity - solids.get(p.solid).map_or(DVec3::ZERO, |s| s.velocity_at(point(&p))))
                .dot(p.normal)
        });
        let speeds = multipliers(pressed.planes(), approach).unwrap_or_default();
        let mut touching = Touching { proxy, ..Touching::nothing(hand) };
        for (k, plane) in pressed.planes().iter().enumerate() {
            let push = feel.stiffness_n_per_m * pressed.depths[k] - feel.damping_n_s_per_m * speeds[k];
            touching.velocity -= plane.normal * speeds[k];
            touching.contacts[k] = Contact {
                point: point(plane),
                normal: plane.normal,
                depth_m: (proxy - hand.position).dot(plane.normal),
                // A damper would hold back a hand that leaves: solids do not stick.
                force: plane.normal * push.max(0.0),
                kind: solids[plane.solid].kind,
                index: solids[plane.solid].index,
            };
        }
        touching.count = pressed.count;
        touching
    }
}

/// Everything at which `normal` · x is at least `least`; what it keeps out of is behind it.
#[derive(Clone, Copy, Debug, Default)]
struct Plane {
    normal: DVec3,
    least: f64,
    /// Its distance from the proxy, m; negative behind it.
    distance: f64,
    /// Number of the solid behind it.
    solid: usize,
}

impl Plane {
    /// By how much `point` is behind it, m.
    fn misses(&self, point: DVec3) -> f64 {
        self.least - self.normal.dot(point)
    }
}

/// A place on up to three planes, and how deep the goal is behind it: goal = place − Σ depth · normal.
#[derive(Clone, Copy, Debug, Default)]
struct Pressed {
    place: DVec3,
    planes: [Plane; 3],
    depths: [f64; 3],
    count: usize,
}

impl Pressed {
    fn planes(&self) -> &[Plane] {
        &self.planes[..self.count]
    }

    /// Leaves out planes that are not `wanted`.
    fn keep(&mut self, wanted: impl Fn(&Plane) -> bool) {
        let mut kept = 0;
        for k in 0..self.count {
            if wanted(&self.planes[k]) {
                (self.planes[kept], self.depths[kept]) = (self.planes[k], self.depths[k]);
                kept += 1;
            }
        }
        self.count = kept;
    }
}

/// The planes nearest to the proxy.
struct Planes {
    list: [Plane; MAX_CONTACTS],
    count: usize,
}

impl Planes {
    /// Those that can be in the way of a ball of `radius` from `at` to `goal`.
    fn around(at: DVec3, goal: DVec3, radius: f64, solids: &[Solid]) -> Self {
        let mut planes = Self { list: [Plane::default(); MAX_CONTACTS], count: 0 };
        // The way ends nearer to the goal than it begins.
        let reach = 2.0 * at.distance(goal) + SETTLED_M;
        for (solid, body) in solids.iter().enumerate() {
            let (distance, normal) = body.distance(at);
            let distance = distance - radius;
            if distance <= reach {
                planes.insert(Plane { normal, least: normal.dot(at) - distance, distance, solid });
            }
        }
        planes
    }

    /// Keeps the nearest.
    fn insert(&mut self, plane: Plane) {
        let mut at = self.count.min(MAX_CONTACTS - 1);
        if self.count == MAX_CONTACTS && self.list[at].distance <= plane.distance {
            return;
        }
        while at > 0 && self.list[at - 1].distance > plane.distance {
            self.list[at] = self.list[at - 1];
            at -= 1;
        }
        self.list[at] = plane;
        self.count = (self.count + 1).min(MAX_CONTACTS);
    }

    fn planes(&self) -> &[Plane] {
        &self.list[..self.count]
    }

    /// The place within all planes that is nearest to `goal`: the goal, or a place on one, two or three planes that
    /// all push away from it. None if there is no such place.
    fn nearest_to(&self, goal: DVec3) -> Option<Pressed> {
        let all = self.planes();
        let try_these = |chosen: &[usize]| self.pressed(goal, chosen);
        try_these(&[])
            .or_else(|| (0..all.len()).find_map(|i| try_these(&[i])))
            .or_else(|| pairs(all.len()).find_map(|[i, j]| try_these(&[i, j])))
            .or_else(|| {
                let triples = pairs(all.len()).flat_map(|[i, j]| (j + 1..all.len()).map(move |k| [i, j, k]));
                triples.into_iter().find_map(|chosen| try_these(&chosen))
            })
    }

    /// The place on the `chosen` planes that is nearest to `goal`, if it is within all others too, and each of them is
    /// needed.
    fn pressed(&self, goal: DVec3, chosen: &[usize]) -> Option<Pressed> {
        let mut pressed = Pressed { place: goal, count: chosen.len(), ..Pressed::default() };
        let mut behind = [0.0; 3];
        for (k, &index) in chosen.iter().enumerate() {
            pressed.planes[k] = self.list[index];
            behind[k] = self.list[index].misses(goal);
        }
        pressed.depths = multipliers(pressed.planes(), behind)?;
        for k in 0..chosen.len() {
            pressed.place += pressed.planes[k].normal * pressed.depths[k];
        }
        let needed = pressed.depths.iter().all(|d| *d >= 0.0);
        let within = self.planes().iter().all(|p| p.misses(pressed.place) <= 0.1 * SETTLED_M);
        (needed && within).then_some(pressed)
    }
}

fn pairs(count: usize) -> impl Iterator<Item = [usize; 2]> {
    (0..count).flat_map(move |i| (i + 1..count).map(move |j| [i, j]))
}

/// The numbers m with which Σ m · normal has the component `along[k]` along each of up to three normals; none if the
/// normals do not part.
fn multipliers(planes: &[Plane], along: [f64; 3]) -> Option<[f64; 3]> {
    let normal = |k: usize| planes.get(k).map(|p| p.normal);
    let entry = |i: usize, j: usize| match (normal(i), normal(j)) {
        (Some(a), Some(b)) => a.dot(b),
        _ => f64::from(u8::from(i == j)),
    };
    let column = |j: usize| DVec3::new(entry(0, j), entry(1, j), entry(2, j));
    let products = DMat3::from_cols(column(0), column(1), column(2));
    let known = DVec3::from_array(std::array::from_fn(|k| if k < planes.len() { along[k] } else { 0.0 }));
    (products.determinant() > PARALLEL).then(|| (products.inverse() * known).to_array())
}
