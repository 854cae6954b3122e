//! Couplings: how a tool moves in the fluid, and what of the fluid's load becomes the force on the hand.
//!
//! A coupling has two halves. Once a fluid frame, on the fluid's side, it says how the tool's body moves
//! ([`Coupling::begin_frame`]) and makes a [`LocalModel`](crate::LocalModel) of what came of it ([`Coupling::end_frame`]).
//! At every servo tick a [`Rendering`](crate::Rendering) makes a force of it at the hand's newest position.

use crate::local::Local;
use crate::{Law, Neighbourhood, ToolState, Wrench};
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
            Self::Local => Box::new(Local::default()),
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

/// A frame that has been stepped.
#[derive(Clone, Copy, Debug)]
pub struct FrameEnd<'a> {
    /// The body at its end.
    pub body: BodyState,
    /// Mean load of the fluid on it.
    pub load: Wrench,
    /// Its length, s.
    pub frame_s: f64,
    /// Radius of the ball round the tool, m.
    pub radius: f64,
    /// Volume of the tool, m³.
    pub volume: f64,
    /// Factor on the lift that the hand feels, beside the one on the whole force.
    pub buoyancy_scale: f64,
    /// The way that the tool was led in it.
    pub path: &'a [ToolState],
    /// Where the hand is expected in the middle of the time in which this frame is felt.
    pub felt_at: ToolState,
    /// The fluid round the tool, if the coupling looks at it.
    pub around: Option<Neighbourhood<'a>>,
}

/// What of a frame is for the hand.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Answer {
    /// What does not depend on where the tool is.
    pub wrench: Wrench,
    /// The force that does.
    pub law: Law,
    /// Mass of fluid that goes along with the tool; its inertia is in neither, kg.
    pub added_mass: f64,
}

impl Answer {
    /// A wrench wherever the tool is.
    fn constant(wrench: Wrench) -> Self {
        Self { wrench, law: Law::default(), added_mass: 0.0 }
    }
}

/// The fluid-side half of a coupling. Thread: fluid.
pub trait Coupling: Send {
    /// Whether the tool's path is carried on to where the hand will be when the frame's answer is felt.
    fn leads(&self) -> bool {
        false
    }

    /// Share of the hand's acceleration with which that path goes on, 0..1.
    fn bend(&self) -> f64 {
        1.0
    }

    /// By how much what is no law comes late, where frames of `frame_s` seconds are averaged, s.
    fn late_s(&self, _frame_s: f64) -> f64 {
        0.0
    }

    /// How the body moves in the frame of `frame_s` seconds whose tool path ends at `device`.
    fn begin_frame(&mut self, body: &BodyState, device: &ToolState, frame_s: f64) -> Drive;

    /// How far round a tool of `radius` metres it looks at the fluid, m; none if it does not.
    fn looks(&self, _radius: f64) -> Option<f64> {
        None
    }

    /// What of the frame is for the hand.
    fn end_frame(&mut self, frame: &FrameEnd<'_>) -> Answer;
}

/// See [`CouplingKind::Direct`].
#[derive(Debug)]
struct Direct;

impl Coupling for Direct {
    fn begin_frame(&mut self, _: &BodyState, _: &ToolState, _: f64) -> Drive {
        Drive::Led
    }

    fn end_frame(&mut self, frame: &FrameEnd<'_>) -> Answer {
        Answer::constant(frame.load)
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

    fn end_frame(&mut self, frame: &FrameEnd<'_>) -> Answer {
        let body = &frame.body;
        let force = body.mass * (body.velocity - self.after_drive) / frame.frame_s;
        Answer::constant(Wrench { force, torque: frame.load.torque * body.collision_response })
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
        let mut felt = |body| {
            let felt_at = ToolState::default();
            let load = Wrench::ZERO;
            let frame = FrameEnd {
                body,
                load,
                frame_s: dt,
                radius: 0.01,
                volume: 1e-6,
                buoyancy_scale: 1.0,
                path: &[],
                felt_at,
                around: None,
            };
            coupling.end_frame(&frame).wrench.force
        };
        assert_eq!(felt(undisturbed), DVec3::ZERO);
        let pushed = BodyState { velocity: velocity - DVec3::Y * 0.1, ..BODY };
        assert!((felt(pushed) - DVec3::new(0.0, -0.2 * 0.1 / 0.02, 0.0)).length() < 1e-12);
    }

    #[test]
    fn names_go_both_ways() {
        for kind in CouplingKind::ALL {
            assert_eq!(CouplingKind::from_name(kind.name()), Some(kind));
        }
        assert_eq!(CouplingKind::from_name("haptic"), None);
    }
}
