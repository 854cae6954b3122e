//! The two things that cross between a hand and a fluid: where the tool is, and what it feels.

use glam::{DQuat, DVec3};

/// Pose and motion of a tool in the scene frame (SI, right-handed, y up).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ToolState {
    /// Position of the tool point, m.
    pub position: DVec3,
    /// Orientation, unit quaternion, tool frame to scene frame.
    pub orientation: DQuat,
    /// Linear velocity of the tool point, m/s.
    pub velocity: DVec3,
    /// Angular velocity in the scene frame, rad/s.
    pub angular_velocity: DVec3,
    /// Bit n is set while button n is down.
    pub buttons: u32,
}

impl ToolState {
    /// A tool at rest at `position`.
    pub fn at(position: DVec3) -> Self {
        Self { position, ..Self::default() }
    }

    /// True when no number in it is NaN or infinite.
    pub fn is_finite(&self) -> bool {
        self.position.is_finite()
            && self.orientation.is_finite()
            && self.velocity.is_finite()
            && self.angular_velocity.is_finite()
    }
}

impl Default for ToolState {
    fn default() -> Self {
        Self {
            position: DVec3::ZERO,
            orientation: DQuat::IDENTITY,
            velocity: DVec3::ZERO,
            angular_velocity: DVec3::ZERO,
            buttons: 0,
        }
    }
}

/// Force and torque on a tool, in the scene frame; the torque is about the tool point.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Wrench {
    /// Force, N.
    pub force: DVec3,
    /// Torque about the tool point, N·m.
    pub torque: DVec3,
}

impl Wrench {
    /// No force and no torque.
    pub const ZERO: Self = Self { force: DVec3::ZERO, torque: DVec3::ZERO };

    /// A pure force, N.
    pub fn from_force(force: DVec3) -> Self {
        Self { force, torque: DVec3::ZERO }
    }

    /// True when no number in it is NaN or infinite.
    pub fn is_finite(&self) -> bool {
        self.force.is_finite() && self.torque.is_finite()
    }
}

impl std::ops::Add for Wrench {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self { force: self.force + other.force, torque: self.torque + other.torque }
    }
}

impl std::ops::Sub for Wrench {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self { force: self.force - other.force, torque: self.torque - other.torque }
    }
}

impl std::ops::AddAssign for Wrench {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl std::ops::Mul<f64> for Wrench {
    type Output = Self;
    fn mul(self, scale: f64) -> Self {
        Self { force: self.force * scale, torque: self.torque * scale }
    }
}
