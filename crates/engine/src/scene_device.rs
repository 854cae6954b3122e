//! The device that a scene asks for.

use crate::scene::{DeviceKind, FalconSettings, MotionOrigin, Scene};
use crate::{Parts, SceneError};
use glam::DVec3;
use hapflow_devices::falcon::{
    self, EmulatedFalcon, EmulatedHand, EmulatedTransport, Falcon, FalconError, FalconOptions, Firmware,
    Geometry, Kinematics, Transport, Trouble,
};
use hapflow_devices::hid::SpaceMouse;
use hapflow_devices::sdk::{ForceDimension, OpenHaptics};
use hapflow_devices::{
    AtEnd, DeviceError, HapticDevice, Motion, NullDevice, Replay, Segment, SimulatedHand, TargetScript,
};
use hapflow_haptics::ToolState;
use hapflow_realtime::{Clock, RealClock};
use std::path::Path;
use std::sync::{Arc, Mutex};

/// The device that `scene` asks for. Its positions are in the device frame of the scene's mapping; the middle of a real
/// device's workspace is where the tool starts.
///
/// Some need [`HapticDevice::prepare`] before they can be read.
///
/// # Errors
/// A motion that cannot be read, a hand that cannot be, or a device that is not there.
pub fn open_device(scene: &Scene) -> Result<Box<dyn HapticDevice>, SceneError> {
    open_device_on(scene, &(Arc::new(RealClock::new()) as Arc<dyn Clock>))
}

/// The same, with an emulated device on `clock`: on a virtual one, waiting for it moves the clock.
///
/// # Errors
/// As [`open_device`].
pub fn open_device_on(scene: &Scene, clock: &Arc<dyn Clock>) -> Result<Box<dyn HapticDevice>, SceneError> {
    Parts::default().open_device(scene, clock)
}

/// The one that `run.device` names.
pub(crate) fn open_own(scene: &Scene, clock: &Arc<dyn Clock>) -> Result<Box<dyn HapticDevice>, SceneError> {
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
        DeviceKind::Falcon => {
            let options = falcon_options(&scene.falcon, start)?;
            let serial = Some(scene.falcon.serial.as_str()).filter(|serial| !serial.is_empty());
            let transport = falcon::open(serial).map_err(DeviceError::from)?;
            Box::new(Falcon::new(transport, options)?)
        }
        DeviceKind::EmulatedFalcon => {
            let options = falcon_options(&scene.falcon, start)?;
            let own = |p: DVec3| place(p) - options.offset;
            let script: Vec<_> = scene.script.iter().map(|s| to_device(s, &own)).collect();
            let transport = emulated_falcon(&options, &script, Arc::clone(clock))?;
            Box::new(Falcon::new(transport, options)?)
        }
        DeviceKind::ForceDimension => Box::new(ForceDimension::open(start)?),
        DeviceKind::Touch => Box::new(OpenHaptics::open(start)?),
        DeviceKind::SpaceMouse => Box::new(SpaceMouse::open(start)?),
    })
}

fn falcon_options(settings: &FalconSettings, middle: DVec3) -> Result<FalconOptions, DeviceError> {
    let geometry = Geometry::load(&settings.geometry).map_err(FalconError::from)?;
    let mut options = FalconOptions::new(geometry);
    if !settings.firmware.is_empty() {
        let firmware = Firmware::load(Path::new(&settings.firmware)).map_err(FalconError::from)?;
        options.firmware = Some(firmware);
    }
    options.offset += middle;
    Ok(options)
}

/// A Falcon in a hand that does as `script` says, in the Falcon's own frame. It has its firmware already, but where one
/// is to be loaded.
fn emulated_falcon(
    options: &FalconOptions,
    script: &[Segment],
    clock: Arc<dyn Clock>,
) -> Result<Box<dyn Transport>, DeviceError> {
    let hand = EmulatedHand::new(Kinematics::new(options.geometry.clone()), script, true)?;
    let device = EmulatedFalcon::new(hand, Trouble::default(), options.firmware.is_none());
    Ok(Box::new(EmulatedTransport::new(Arc::new(Mutex::new(device)), clock)))
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
