//! Couplings: how a tool moves in the fluid, and what of the fluid's load becomes the force on the hand.
//!
//! A coupling has two halves. Once a fluid frame, on the fluid's side, it says how the tool's body moves
//! ([`Coupling::begin_frame`]) and makes a [`LocalModel`](crate::LocalModel) of what came of it ([`Coupling::end_frame`]).
//! At every servo tick a [`Rendering`](crate::Rendering) makes a force of it at the hand's newest position.

use crate::{ToolState, Wrench};
use glam::DVec3;

/// The couplings there are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CouplingKind {
    /// The body follows the device whatever the fluid does; the hand feels the mean load of a fluid frame.
    Direct,
    /// The thesis's: the body has a mass and is driven to the device by a force; the hand feels the fluid's
    /// share of its change of momentum. The baseline.
    Momentum,
    /// The body goes where the hand will be when the frame's answer is felt, and the hand feels a model of the fluid
    /// round the tool at its own newest place.
    Local,
}

impl CouplingKind {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Direct, Self::Momentum, Self::Local];

    /// Name by which a scene asks for it.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Direct => "direct",
            Self::Momentum => "momentum",
            Self::Local => "local",
        }
    }

    /// The coupling of that name.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.name() == name)
    }

    /// The coupling itself. Thread: main (allocates).
    pub fn build(self) -> Box<dyn Coupling> {
        match self {
            Self::Direct => Box::new(Direct),
            Self::Momentum => Box::new(Momentum::default()),
            Self::Local => Box::new(Local),
        }
    }
}

/// The tool's body at the edge of a frame.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BodyState {
    /// Position, m.
    pub position: DVec3,
    /// Velocity, m/s.
    pub velocity: DVec3,
    /// Mass, kg.
    pub mass: f64,
    /// Share of the fluid's impulse that a driven body takes, 0..1.
    pub collision_response: f64,
}

/// How the body is to move in a frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Drive {
    /// Along the device's path.
    Led,
    /// From this velocity (m/s), then as the fluid pushes it.
    Driven {
        /// Velocity after the drive's impulse.
        velocity: DVec3,
    },
}

/// The fluid-side half of a coupling. Thread: fluid.
pub trait Coupling: Send {
    /// Whether the tool's path is carried on to where the hand will be when the frame's answer is felt.
    fn leads(&self) -> bool {
        false
    }

    /// How the body moves in the frame of `frame_s` seconds whose tool path ends at `device`.
    fn begin_frame(&mut self, body: &BodyState, device: &ToolState, frame_s: f64) -> Drive;

    /// The wrench for the hand, of the frame's mean `load` and the `body` at its end.
    fn end_frame(&mut self, body: &BodyState, load: Wrench, frame_s: f64) -> Wrench;
}

/// See [`CouplingKind::Direct`].
#[derive(Debug)]
struct Direct;

impl Coupling for Direct {
    fn begin_frame(&mut self, _: &BodyState, _: &ToolState, _: f64) -> Drive {
        Drive::Led
    }

    fn end_frame(&mut self, _: &BodyState, load: Wrench, _: f64) -> Wrench {
        load
    }
}

/// See [`CouplingKind::Momentum`]. The drive force F = m (Δx/Δt − v)/Δt would bring the body to the device in
/// one step of the simulation; its impulse is applied at the frame's start and taken off the change of
/// momentum: F_hand = (P_after − P_before − F Δt)/Δt.
#[derive(Debug, Default)]
struct Momentum {
    after_drive: DVec3,
}

impl Coupling for Momentum {
    fn begin_frame(&mut self, body: &BodyState, device: &ToolState, frame_s: f64) -> Drive {
        let drive_force = body.mass * ((device.position - body.position) / frame_s - body.velocity) / frame_s;
        self.after_drive = body.velocity + drive_force * frame_s / body.mass;
        Drive::Driven { velocity: self.after_drive }
    }

    fn end_frame(&mut self, body: &BodyState, load: Wrench, frame_s: f64) -> Wrench {
        let force = body.mass * (body.velocity - self.after_drive) / frame_s;
        Wrench { force, torque: load.torque * body.collision_response }
    }
}

/// See [`CouplingKind::Local`].
#[derive(Debug)]
struct Local;

impl Coupling for Local {
    fn leads(&self) -> bool {
        true
    }

    fn begin_frame(&mut self, _: &BodyState, _: &ToolState, _: f64) -> Drive {
        Drive::Led
    }

    fn end_frame(&mut self, _: &BodyState, load: Wrench, _: f64) -> Wrench {
        load
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const BODY: BodyState =
        BodyState { position: DVec3::ZERO, velocity: DVec3::Z, mass: 0.2, collision_response: 0.5 };

    #[test]
    fn a_driven_body_arrives_at_the_device_in_one_frame() {
        let (device, dt) = (ToolState::at(DVec3::new(0.01, -0.02, 0.0)), 1.0 / 60.0);
        let drive = CouplingKind::Momentum.build().begin_frame(&BODY, &device, dt);
        let Drive::Driven { velocity } = drive else { panic!("{drive:?}") };
        assert!((BODY.position + velocity * dt - device.position).length() < 1e-12);
    }

    #[test]
    fn only_the_fluids_share_is_felt() {
        let (device, dt) = (ToolState::at(DVec3::X), 0.02);
        let mut coupling = CouplingKind::Momentum.build();
        let Drive::Driven { velocity } = coupling.begin_frame(&BODY, &device, dt) else { panic!() };
        let undisturbed = BodyState { velocity, ..BODY };
        assert_eq!(coupling.end_frame(&undisturbed, Wrench::ZERO, dt).force, DVec3::ZERO);
        let pushed = BodyState { velocity: velocity - DVec3::Y * 0.1, ..BODY };
        let felt = coupling.end_frame(&pushed, Wrench::ZERO, dt).force;
        assert!((felt - DVec3::new(0.0, -0.2 * 0.1 / 0.02, 0.0)).length() < 1e-12);
    }

    #[test]
    fn names_go_both_ways() {
        for kind in CouplingKind::ALL {
            assert_eq!(CouplingKind::from_name(kind.name()), Some(kind));
        }
        assert_eq!(CouplingKind::from_name("haptic"), None);
    }
}
