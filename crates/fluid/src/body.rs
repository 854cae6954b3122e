//! Bodies in the fluid: how they move in a frame, and the load that the fluid puts on them.

use crate::periodic::Periodic;
use crate::shape::Frame;
use crate::volume_map::VolumeMap;
use crate::wall::WallTable;
use crate::{BodyConfig, Kernel, Shape};
use glam::{DQuat, DVec3, Vec3};

/// Least mass of a driven body, as a share of the mass of fluid that it displaces (measured: stable from 0.06 in
/// `wcsph` and 0.09 in `muller`).
pub const MIN_MASS_RATIO: f64 = 0.15;

/// Faster than any hand, m/s: such a step is a jump and no motion.
const JUMP_SPEED: f64 = 20.0;

/// Pose and motion of a body at one instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodySample {
    /// Time, s, on the clock of the frame's path.
    pub time: f64,
    /// Position of its origin, m.
    pub position: DVec3,
    /// Orientation, body to scene.
    pub orientation: DQuat,
    /// Velocity, m/s.
    pub velocity: DVec3,
    /// Angular velocity in the scene frame, rad/s.
    pub angular_velocity: DVec3,
}

/// State of a body at the end of a frame.
pub type BodyState = BodySample;

impl BodySample {
    fn is_finite(&self) -> bool {
        self.position.is_finite()
            && self.orientation.is_finite()
            && self.velocity.is_finite()
            && self.angular_velocity.is_finite()
    }

    /// At rest at `position`.
    pub fn at(position: DVec3) -> Self {
        Self {
            time: 0.0,
            position,
            orientation: DQuat::IDENTITY,
            velocity: DVec3::ZERO,
            angular_velocity: DVec3::ZERO,
        }
    }
}

/// Who moves a body in a frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum BodyDrive {
    /// It follows the path, whatever the fluid does.
    Led,
    /// It starts the frame with this velocity (m/s) and the fluid pushes it; the path gives its orientation.
    /// The push is explicit: a body of less than [`MIN_MASS_RATIO`] of the mass of fluid that it displaces
    /// would be thrown about by the fluid that it accelerates.
    Driven {
        /// Velocity at the start of the frame, m/s.
        velocity: DVec3,
    },
    /// It goes where the fluid and gravity take it, from where it is, and walls and other bodies stop it; the path
    /// plays no part. It may be lighter than the fluid.
    Free,
}

/// Motion of one body in one frame.
#[derive(Clone, Copy, Debug)]
pub struct BodyMotion<'a> {
    /// Who moves it.
    pub drive: BodyDrive,
    /// Samples of its path in order of time, at least one unless it is free, spread over the frame; a body that is
    /// led ends at the last.
    pub path: &'a [BodySample],
}

/// Mean load of the fluid on a body over a frame; the torque is about the body's origin.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BodyLoad {
    /// Force by pressure (and contacts), N.
    pub pressure_force: DVec3,
    /// Force by viscous friction, N.
    pub viscous_force: DVec3,
    /// Torque, N·m.
    pub torque: DVec3,
}

impl BodyLoad {
    /// Whole force, N.
    pub fn force(&self) -> DVec3 {
        self.pressure_force + self.viscous_force
    }

    /// Takes the reaction to forces on a particle (N) that stands `arm` (m) from the origin.
    pub(crate) fn react(&mut self, pressure: Vec3, viscous: Vec3, arm: Vec3) {
        self.pressure_force -= pressure.as_dvec3();
        self.viscous_force -= viscous.as_dvec3();
        self.torque -= arm.cross(pressure + viscous).as_dvec3();
    }

    pub(crate) fn add_scaled(&mut self, other: &Self, scale: f64) {
        self.pressure_force += other.pressure_force * scale;
        self.viscous_force += other.viscous_force * scale;
        self.torque += other.torque * scale;
    }

    /// Adds to `loads` what each chunk of particles gave, in the order of the chunks: `parts` has `loads.len()` for each.
    pub(crate) fn add_chunks(loads: &mut [Self], parts: &[Self]) {
        for part in parts.chunks(loads.len().max(1)) {
            for (load, part) in loads.iter_mut().zip(part) {
                load.add_scaled(part, 1.0);
            }
        }
    }
}

/// A body while a frame is stepped.
#[derive(Clone, Debug)]
pub(crate) struct Body {
    pub config: BodyConfig,
    pub state: BodySample,
    /// Acceleration, m/s²: the wall pressure is extrapolated with it. Of a led body its mean over the frame.
    pub acceleration: DVec3,
    /// Acceleration by which the fluid last moved a driven body, m/s², where it is swayed by a prompt one.
    yielded: DVec3,
    drive: BodyDrive,
}

/// What a free body moves in.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Medium {
    /// Density of the fluid, kg/m³.
    pub density: f64,
    /// Gravity, m/s².
    pub gravity: DVec3,
    /// Whether the fluid answers the acceleration of a body within the same sub-step, with up to the displaced mass.
    pub prompt: bool,
}

impl Body {
    pub fn new(config: BodyConfig) -> Self {
        Self {
            state: BodySample::at(config.position),
            config,
            acceleration: DVec3::ZERO,
            yielded: DVec3::ZERO,
            drive: BodyDrive::Led,
        }
    }

    /// Takes the drive of a new frame of `duration` seconds.
    pub fn begin_frame(&mut self, motion: &BodyMotion<'_>, duration: f64) {
        let last = motion.path.last().copied().filter(BodySample::is_finite).unwrap_or(self.state);
        self.drive = motion.drive;
        match motion.drive {
            BodyDrive::Led if duration > 0.0 => {
                self.acceleration = (last.velocity - self.state.velocity) / duration;
            }
            BodyDrive::Led => self.acceleration = DVec3::ZERO,
            BodyDrive::Driven { velocity } => {
                self.state.velocity = velocity;
                self.acceleration = DVec3::ZERO;
            }
            BodyDrive::Free => {}
        }
    }

    /// Moves on by `dt`, of which the frame's share so far ends at `share` (0..1).
    pub fn advance(&mut self, motion: &BodyMotion<'_>, share: f64, dt: f64) {
        match self.drive {
            BodyDrive::Led => self.follow(motion.path, share, dt),
            BodyDrive::Driven { .. } => {
                self.state.position += self.state.velocity * dt;
                if let Some(last) = motion.path.last() {
                    self.state.orientation = last.orientation;
                }
            }
            BodyDrive::Free => {
                self.state.position += self.state.velocity * dt;
                self.turn(dt);
            }
        }
    }

    /// Turns on for `dt`. The angular momentum stays as it is, so that no spin, however fast, grows by itself.
    fn turn(&mut self, dt: f64) {
        let (s, inertia) = (&mut self.state, self.config.shape.inertia(self.config.mass));
        let momentum = s.orientation * (inertia * (s.orientation.inverse() * s.angular_velocity));
        let turn = DQuat::from_scaled_axis(s.angular_velocity * dt);
        s.orientation = (turn * s.orientation).normalize();
        s.angular_velocity = s.orientation * (inertia.inverse() * (s.orientation.inverse() * momentum));
    }

    fn follow(&mut self, path: &[BodySample], share: f64, dt: f64) {
        // A broken sample leaves the body where it is: it must not cost the fluid.
        let target = sample_path(path, share).filter(BodySample::is_finite).unwrap_or(self.state);
        let velocity = (target.position - self.state.position) / dt;
        // A tool that is put elsewhere does not shovel the fluid between.
        let velocity = if velocity.length() <= JUMP_SPEED { velocity } else { DVec3::ZERO };
        self.state = BodySample { velocity, ..target };
    }

    /// Takes the load of the fluid over `dt`; a driven body yields to it by its share, a free one with gravity.
    pub fn push(&mut self, load: &BodyLoad, medium: &Medium, dt: f64) {
        match self.drive {
            BodyDrive::Led => {}
            BodyDrive::Driven { .. } if self.is_swayed_by(medium) => self.yield_to(load, medium, dt),
            BodyDrive::Driven { .. } => {
                self.state.velocity += load.force() * (dt * self.contact_inverse_mass());
            }
            BodyDrive::Free => self.fall(load, medium, dt),
        }
    }

    /// Whether a fluid answers at once with more mass than a driven body has.
    fn is_swayed_by(&self, medium: &Medium) -> bool {
        medium.prompt && self.contact_inverse_mass() * self.carried(medium) > 1.0
    }

    /// As in `fall`, the mass that answers is on both sides.
    fn yield_to(&mut self, load: &BodyLoad, medium: &Medium, dt: f64) {
        let (carried, inverse) = (self.carried(medium), self.contact_inverse_mass());
        let pull = load.force() + carried * self.yielded;
        self.yielded = inverse * pull / (1.0 + inverse * carried);
        self.state.velocity += self.yielded * dt;
    }

    /// The fluid's force answers the acceleration with up to the displaced mass: the wall pressure is extrapolated
    /// with it. So that mass is taken to the body's side, with the last acceleration on the other, and a body
    /// lighter than the fluid is stable too.
    fn fall(&mut self, load: &BodyLoad, medium: &Medium, dt: f64) {
        let (mass, shape) = (self.config.mass, &self.config.shape);
        let carried = self.carried(medium);
        let pull = load.force() + mass * medium.gravity + carried * self.acceleration;
        let acceleration = pull / (mass + carried);
        let s = &mut self.state;
        let (inertia, inverse) = (shape.inertia(mass), s.orientation.inverse());
        let turning = s.orientation * (inertia.inverse() * (inverse * load.torque));
        if acceleration.is_finite() && turning.is_finite() {
            self.acceleration = acceleration;
            s.velocity += acceleration * dt;
            s.angular_velocity += turning * dt;
        }
    }

    /// Holds a free body below the `fastest` (m/s) that anything here may be, turning too. Particles that together are far
    /// heavier than it would else throw it about, each as if it were alone.
    pub fn rein(&mut self, fastest: f64) {
        if self.drive == BodyDrive::Free {
            let spin = fastest / self.config.shape.bounding_radius();
            self.state.velocity = self.state.velocity.clamp_length_max(fastest);
            self.state.angular_velocity = self.state.angular_velocity.clamp_length_max(spin);
        }
    }

    /// Mass of the fluid that it displaces, kg.
    pub fn carried(&self, medium: &Medium) -> f64 {
        let volume = self.config.shape.volume();
        if volume.is_finite() { medium.density * volume } else { 0.0 }
    }

    /// 1/mass as a contact by impulse meets it, 1/kg.
    pub fn contact_inverse_mass(&self) -> f64 {
        match self.drive {
            BodyDrive::Led => 0.0,
            BodyDrive::Driven { .. } => self.config.collision_response / self.config.mass,
            BodyDrive::Free => 1.0 / self.config.mass,
        }
    }

    /// Whether it goes where forces take it.
    pub fn is_free(&self) -> bool {
        self.drive == BodyDrive::Free
    }

    pub fn end_frame(&mut self, motion: &BodyMotion<'_>) {
        if let (BodyDrive::Led, Some(last)) = (self.drive, motion.path.last().filter(|s| s.is_finite())) {
            self.state = *last;
        }
    }
}

/// The path at `share` (0..1) of its span, linear between samples.
fn sample_path(path: &[BodySample], share: f64) -> Option<BodySample> {
    let (first, last) = (path.first()?, path.last()?);
    let t = first.time + share * (last.time - first.time);
    let next = path.iter().position(|s| s.time >= t).unwrap_or(path.len() - 1);
    let (b, a) = (path[next], path[next.saturating_sub(1)]);
    let span = b.time - a.time;
    let w = if span > 0.0 { (t - a.time) / span } else { 1.0 };
    Some(BodySample {
        time: t,
        position: a.position.lerp(b.position, w),
        orientation: a.orientation.slerp(b.orientation, w),
        velocity: a.velocity.lerp(b.velocity, w),
        angular_velocity: a.angular_velocity.lerp(b.angular_velocity, w),
    })
}

/// A body frozen for one sub-step, in f32, as the particle loops meet it.
#[derive(Clone, Debug)]
pub(crate) struct BodyNow {
    /// Number of the body.
    pub index: usize,
    pub frame: Frame,
    shape: Shape,
    velocity: Vec3,
    angular_velocity: Vec3,
    pub acceleration: Vec3,
    pub inverse_mass: f32,
    reach: f32,
    periodic: Periodic,
}

/// Where a particle stands to a surface.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Contact {
    /// Signed distance, m.
    pub distance: f32,
    /// Outward unit normal.
    pub normal: Vec3,
    /// Velocity of the surface there, m/s.
    pub velocity: Vec3,
    /// From the body's origin to the particle, m.
    pub arm: Vec3,
}

impl BodyNow {
    /// Body number `index`; `margin`: how far from the surface particles still meet it, m.
    pub fn new((index, body): (usize, &Body), margin: f64, periodic: Periodic) -> Self {
        Self {
            index,
            frame: Frame::new(body.state.position, body.state.orientation),
            shape: body.config.shape.clone(),
            velocity: body.state.velocity.as_vec3(),
            angular_velocity: body.state.angular_velocity.as_vec3(),
            acceleration: body.acceleration.as_vec3(),
            inverse_mass: body.contact_inverse_mass() as f32,
            reach: (body.config.shape.bounding_radius() + margin) as f32,
            periodic,
        }
    }

    /// Whether it may meet anybody between two corners; across repeating sides it may.
    pub fn is_near(&self, [low, high]: [Vec3; 2]) -> bool {
        let middle = self.frame.position;
        self.periodic.any() || middle.distance(middle.clamp(low, high)) <= self.reach
    }

    /// The contact of a particle at `point`, if it is within reach.
    pub fn contact(&self, point: Vec3, margin: f32) -> Option<Contact> {
        let arm = self.periodic.shortest(point - self.frame.position);
        if arm.length_squared() > self.reach * self.reach {
            return None;
        }
        let (distance, normal) = self.shape.distance(self.frame.to_body_direction(arm));
        if distance > margin {
            return None;
        }
        Some(Contact {
            distance,
            normal: self.frame.to_scene_direction(normal),
            velocity: self.velocity + self.angular_velocity.cross(arm),
            arm,
        })
    }
}

/// The kernel integrals round a body.
#[derive(Clone, Debug)]
pub(crate) enum BodyTable {
    /// Where its distance tells all.
    Distance(WallTable),
    /// Where it has edges.
    Place(VolumeMap),
}

/// One table a body, made when the kernel or its shape changes.
#[derive(Clone, Debug)]
pub(crate) struct BodyTables {
    kernel: (Kernel, f64),
    tables: Vec<(Shape, BodyTable)>,
}

impl BodyTables {
    pub fn new(bodies: &[BodyConfig], kernel: Kernel, support: f64) -> Self {
        let mut tables = Self { kernel: (kernel, support), tables: Vec::new() };
        tables.update(bodies, kernel, support);
        tables
    }

    /// A table costs milliseconds: a body that only moves or weighs otherwise keeps its own.
    pub fn update(&mut self, bodies: &[BodyConfig], kernel: Kernel, support: f64) {
        let fits = self.kernel == (kernel, support);
        let mut old = std::mem::take(&mut self.tables).into_iter().map(|known| fits.then_some(known));
        self.kernel = (kernel, support);
        self.tables = bodies
            .iter()
            .map(|body| match old.next().flatten() {
                Some(known) if known.0 == body.shape => known,
                _ => (body.shape.clone(), BodyTable::new(&body.shape, kernel, support)),
            })
            .collect();
    }

    pub fn get(&self, index: usize) -> &BodyTable {
        &self.tables[index].1
    }
}

impl BodyTable {
    fn new(shape: &Shape, kernel: Kernel, support: f64) -> Self {
        match VolumeMap::for_shape(shape, kernel, support) {
            Some(map) => Self::Place(map),
            None => Self::Distance(WallTable::for_shape(shape, kernel, support)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_led_body_follows_its_samples() {
        let samples: Vec<_> = (0..=4)
            .map(|k| BodySample { time: 0.25 * f64::from(k), ..BodySample::at(DVec3::X * f64::from(k * k)) })
            .collect();
        for (share, x) in [(0.0, 0.0), (0.25, 1.0), (0.375, 2.5), (1.0, 16.0)] {
            let s = sample_path(&samples, share).unwrap();
            assert!((s.position.x - x).abs() < 1e-12, "{share}: {}", s.position.x);
        }
    }

    /// A box that spins about any axis keeps its momentum and so its speed, however long the step.
    #[test]
    fn no_spin_grows_by_itself() {
        let shape = Shape::Box { size: DVec3::new(0.01, 0.02, 0.04) };
        let mut body = Body::new(BodyConfig { shape, ..BodyConfig::default() });
        body.state.angular_velocity = DVec3::new(300.0, 2000.0, -500.0);
        let inertia = body.config.shape.inertia(body.config.mass);
        let momentum = |b: &Body| {
            let o = b.state.orientation;
            o * (inertia * (o.inverse() * b.state.angular_velocity))
        };
        let before = momentum(&body);
        (0..1000).for_each(|_| body.turn(1e-3));
        assert!((momentum(&body) / before - 1.0).abs().max_element() < 1e-9);
    }

    /// In nothing, a free body falls; a fluid that answers its acceleration with the displaced mass slows it as the
    /// added mass says, at any ratio of densities.
    #[test]
    fn a_free_body_falls_as_its_mass_and_the_carried_fluid_say() {
        let shape = Shape::Sphere { radius: 0.05 };
        let medium = Medium { density: 1000.0, gravity: DVec3::new(0.0, -9.81, 0.0), prompt: false };
        let displaced = medium.density * shape.volume();
        for ratio in [0.05, 0.5, 1.0, 5.0] {
            let config =
                BodyConfig { shape: shape.clone(), mass: ratio * displaced, ..BodyConfig::default() };
            let mut body = Body::new(config);
            let motion = BodyMotion { drive: BodyDrive::Free, path: &[] };
            body.begin_frame(&motion, 0.01);
            for _ in 0..400 {
                let force = -displaced * medium.gravity - 0.5 * displaced * body.acceleration;
                let load = BodyLoad { pressure_force: force, ..BodyLoad::default() };
                body.push(&load, &medium, 1e-3);
                body.advance(&motion, 1.0, 1e-3);
            }
            let expected = 9.81 * (1.0 - ratio) / (ratio + 0.5);
            assert!((body.acceleration.y / expected - 1.0).abs() < 1e-9 || ratio == 1.0, "{ratio}");
            assert!(ratio != 1.0 || body.acceleration.y.abs() < 1e-9);
        }
    }

    /// A driven body that a fluid answers at once moves as its own and the added mass say, however light it is.
    #[test]
    fn a_driven_body_yields_to_a_prompt_fluid() {
        let shape = Shape::Sphere { radius: 0.05 };
        let medium = Medium { density: 1000.0, gravity: DVec3::ZERO, prompt: true };
        let displaced = medium.density * shape.volume();
        for ratio in [MIN_MASS_RATIO, 0.9, 1.1, 10.0] {
            let config =
                BodyConfig { shape: shape.clone(), mass: ratio * displaced, ..BodyConfig::default() };
            let mut body = Body::new(config);
            let path = [BodySample::at(DVec3::ZERO)];
            let motion = BodyMotion { drive: BodyDrive::Driven { velocity: DVec3::ZERO }, path: &path };
            body.begin_frame(&motion, 0.01);
            let mut last = (DVec3::ZERO, DVec3::ZERO);
            for _ in 0..400 {
                let answered = (body.state.velocity - last.0) / 1e-3;
                last = (body.state.velocity, answered);
                let force = displaced * (DVec3::Y - 0.5 * answered);
                body.push(&BodyLoad { pressure_force: force, ..BodyLoad::default() }, &medium, 1e-3);
            }
            assert!((last.1.y * (ratio + 0.5) - 1.0).abs() < 1e-9, "{ratio}: {last:?}");
        }
    }

    #[test]
    fn a_free_body_keeps_its_spin_momentum() {
        let shape = Shape::Box { size: DVec3::new(0.1, 0.2, 0.3) };
        let mut body = Body::new(BodyConfig { shape: shape.clone(), ..BodyConfig::default() });
        body.state.angular_velocity = DVec3::new(3.0, 0.1, 0.2);
        let medium = Medium { density: 0.0, gravity: DVec3::ZERO, prompt: false };
        let motion = BodyMotion { drive: BodyDrive::Free, path: &[] };
        body.begin_frame(&motion, 0.01);
        let momentum = |b: &Body| {
            let s = b.state;
            s.orientation * (shape.inertia(0.1) * (s.orientation.inverse() * s.angular_velocity))
        };
        let before = momentum(&body);
        for _ in 0..5000 {
            body.push(&BodyLoad::default(), &medium, 1e-4);
            body.advance(&motion, 1.0, 1e-4);
        }
        assert!((momentum(&body) - before).length() < 1e-3 * before.length());
    }

    #[test]
    fn a_driven_body_takes_its_share_of_an_impulse() {
        let config = BodyConfig {
            shape: Shape::Sphere { radius: 0.01 },
            mass: 0.5,
            collision_response: 0.2,
            position: DVec3::ZERO,
        };
        let mut body = Body::new(config);
        let motion = BodyMotion { drive: BodyDrive::Driven { velocity: DVec3::X }, path: &[] };
        body.begin_frame(&motion, 0.01);
        let load = BodyLoad { pressure_force: DVec3::Y, ..BodyLoad::default() };
        let medium = Medium { density: 1000.0, gravity: DVec3::NEG_Y, prompt: false };
        body.push(&load, &medium, 1.0);
        body.advance(&motion, 1.0, 0.01);
        assert!((body.state.velocity - DVec3::new(1.0, 0.4, 0.0)).length() < 1e-12);
        assert!((body.state.position - DVec3::new(0.01, 0.004, 0.0)).length() < 1e-12);
    }
}
