//! Bodies in the fluid: how they move in a frame, and the load that the fluid puts on them.

use crate::shape::Frame;
use crate::wall::WallTable;
use crate::{BodyConfig, Shape};
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
}

/// Motion of one body in one frame.
#[derive(Clone, Copy, Debug)]
pub struct BodyMotion<'a> {
    /// Who moves it.
    pub drive: BodyDrive,
    /// Samples of its path in order of time, at least one, spread over the frame; a body that is led ends at
    /// the last.
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
}

/// A body while a frame is stepped.
#[derive(Clone, Debug)]
pub(crate) struct Body {
    pub config: BodyConfig,
    pub state: BodySample,
    /// Mean acceleration over the frame, m/s²: the wall pressure is extrapolated with it.
    pub acceleration: DVec3,
    driven: bool,
}

impl Body {
    pub fn new(config: BodyConfig) -> Self {
        Self { config, state: BodySample::at(config.position), acceleration: DVec3::ZERO, driven: false }
    }

    /// Takes the drive of a new frame of `duration` seconds.
    pub fn begin_frame(&mut self, motion: &BodyMotion<'_>, duration: f64) {
        let last = motion.path.last().copied().filter(BodySample::is_finite).unwrap_or(self.state);
        self.acceleration = DVec3::ZERO;
        self.driven = false;
        match motion.drive {
            BodyDrive::Led if duration > 0.0 => {
                self.acceleration = (last.velocity - self.state.velocity) / duration;
            }
            BodyDrive::Led => {}
            BodyDrive::Driven { velocity } => {
                self.state.velocity = velocity;
                self.driven = true;
            }
        }
    }

    /// Moves on by `dt`, of which the frame's share so far ends at `share` (0..1).
    pub fn advance(&mut self, motion: &BodyMotion<'_>, share: f64, dt: f64) {
        if self.driven {
            self.state.position += self.state.velocity * dt;
            if let Some(last) = motion.path.last() {
                self.state.orientation = last.orientation;
            }
        } else {
            // A broken sample leaves the body where it is: it must not cost the fluid.
            let target = sample_path(motion.path, share).filter(BodySample::is_finite).unwrap_or(self.state);
            let velocity = (target.position - self.state.position) / dt;
            // A tool that is put elsewhere does not shovel the fluid between.
            let velocity = if velocity.length() <= JUMP_SPEED { velocity } else { DVec3::ZERO };
            self.state = BodySample { velocity, ..target };
        }
    }

    /// Takes an impulse of the fluid, N·s; only a driven body yields to it, by its share.
    pub fn push(&mut self, impulse: DVec3) {
        if self.driven {
            self.state.velocity += impulse * (self.config.collision_response / self.config.mass);
        }
    }

    /// 1/mass as a contact by impulse meets it, 1/kg.
    pub fn contact_inverse_mass(&self) -> f64 {
        if self.driven { self.config.collision_response / self.config.mass } else { 0.0 }
    }

    pub fn end_frame(&mut self, motion: &BodyMotion<'_>) {
        if let (false, Some(last)) = (self.driven, motion.path.last().filter(|s| s.is_finite())) {
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
#[derive(Clone, Copy, Debug)]
pub(crate) struct BodyNow {
    frame: Frame,
    shape: Shape,
    velocity: Vec3,
    angular_velocity: Vec3,
    pub acceleration: Vec3,
    pub inverse_mass: f32,
    reach: f32,
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
    /// `margin`: how far from the surface particles still meet it, m.
    pub fn new(body: &Body, margin: f64) -> Self {
        Self {
            frame: Frame::new(body.state.position, body.state.orientation),
            shape: body.config.shape,
            velocity: body.state.velocity.as_vec3(),
            angular_velocity: body.state.angular_velocity.as_vec3(),
            acceleration: body.acceleration.as_vec3(),
            inverse_mass: body.contact_inverse_mass() as f32,
            reach: (body.config.shape.bounding_radius() + margin) as f32,
        }
    }

    /// The contact of a particle at `point`, if it is within reach.
    pub fn contact(&self, point: Vec3, margin: f32) -> Option<Contact> {
        let arm = point - self.frame.position;
        if arm.length_squared() > self.reach * self.reach {
            return None;
        }
        let (distance, normal) = self.shape.distance(self.frame.to_body(point));
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

/// One wall table a body, made when the support or the shape changes.
#[derive(Clone, Debug, Default)]
pub(crate) struct BodyTables(Vec<WallTable>);

impl BodyTables {
    pub fn new(bodies: &[BodyConfig], support: f64) -> Self {
        Self(bodies.iter().map(|b| WallTable::for_shape(&b.shape, support)).collect())
    }

    pub fn get(&self, index: usize) -> &WallTable {
        &self.0[index]
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
        body.push(DVec3::Y);
        body.advance(&motion, 1.0, 0.01);
        assert!((body.state.velocity - DVec3::new(1.0, 0.4, 0.0)).length() < 1e-12);
        assert!((body.state.position - DVec3::new(0.01, 0.004, 0.0)).length() < 1e-12);
    }
}
