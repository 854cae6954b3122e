//! The device that a scene asks for.

use crate::SceneError;
use crate::scene::{DeviceKind, MotionOrigin, Scene};
use glam::DVec3;
use hapflow_devices::{
    AtEnd, HapticDevice, Motion, NullDevice, Replay, Segment, SimulatedHand, TargetScript,
};
use hapflow_haptics::ToolState;
use std::path::Path;

/// The device that `scene` asks for. Its positions are in the device frame of the scene's mapping.
///
/// # Errors
/// A motion that cannot be read, or a hand that cannot be.
pub fn open_device(scene: &Scene) -> Result<Box<dyn HapticDevice>, SceneError> {
    let mapping = scene.mapping()?;
    let place = |p: DVec3| mapping.device_state(ToolState::at(p)).position;
    let start = place(scene.tool.position);
    Ok(match scene.run.device {
        DeviceKind::Null => Box::new(NullDevice::new(start)),
        DeviceKind::Replay => {
            let motion = motion(&scene.run.motion)?;
            let (motion, start) = match scene.run.motion_origin {
                MotionOrigin::Tool => (motion, start),
                MotionOrigin::Scene => (motion.map(place)?, DVec3::ZERO),
            };
            Box::new(Replay::new(motion, start, AtEnd::Hold)?)
        }
        DeviceKind::Hand => {
            let script: Vec<_> = scene.script.iter().map(|s| to_device(s, &place)).collect();
            let script = TargetScript::new(start, &script, AtEnd::Hold)?;
            Box::new(SimulatedHand::new(scene.hand, script)?)
        }
    })
}

/// The shipped motion of that name, or that of a file.
fn motion(name: &str) -> Result<Motion, SceneError> {
    match Motion::builtin(name) {
        Some(motion) => Ok(motion),
        None => Ok(Motion::load(Path::new(name))?),
    }
}

/// A script's segment, turned from the scene's frame into the device's.
fn to_device(segment: &Segment, place: &impl Fn(DVec3) -> DVec3) -> Segment {
    match *segment {
        Segment::Hold { duration_s } => Segment::Hold { duration_s },
        Segment::MoveTo { position, duration_s } => Segment::MoveTo { position: place(position), duration_s },
        Segment::Sine { amplitude, frequency_hz, duration_s } => {
            Segment::Sine { amplitude: place(amplitude) - place(DVec3::ZERO), frequency_hz, duration_s }
        }
        Segment::Circle { centre, frequency_hz, duration_s } => {
            Segment::Circle { centre: place(centre), frequency_hz, duration_s }
        }
    }
}
