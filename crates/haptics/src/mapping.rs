//! From the device frame to the scene frame and back.

use crate::{Axes, RangeError, Rim, ToolState, Wrench, check_range};
use glam::DVec3;

/// Where a device sits in a scene: position = `offset` + `scale` · turned device position.
///
/// The axes of the world and those of the tool are turned together, so a device at its rest orientation is a
/// tool at rest in the scene. Forces come back turned but not scaled. So the hand feels every impedance of
/// the scene (stiffness, damping, mass) multiplied by `scale`: a device that covers a scene ten times its
/// size makes water ten times as stiff. And of the power that the tool gives the scene by forces, the hand
/// gives 1/`scale`.
///
/// Default: device frame and scene frame are the same, and nothing lies around the workspace.
#[derive(Clone, Debug, PartialEq)]
pub struct Mapping {
    scale: f64,
    axes: Axes,
    offset: DVec3,
    rim: Option<Rim>,
}

impl Mapping {
    /// `scale`: scene metres a device metre, 0.001 to 1000, default 1. `axes`: default [`Axes::IDENTITY`].
    /// `offset`: where the device's origin is in the scene, m, within ±1000 m, default 0.
    ///
    /// # Errors
    /// [`RangeError`] if a number is outside its range.
    pub fn new(scale: f64, axes: Axes, offset: DVec3) -> Result<Self, RangeError> {
        check_range("scale", scale, 1e-3, 1e3)?;
        check_range("offset x (m)", offset.x, -1e3, 1e3)?;
        check_range("offset y (m)", offset.y, -1e3, 1e3)?;
        check_range("offset z (m)", offset.z, -1e3, 1e3)?;
        Ok(Self { scale, axes, offset, rim: None })
    }

    /// The same mapping with a soft rim round the device's workspace.
    pub fn with_rim(self, rim: Rim) -> Self {
        Self { rim: Some(rim), ..self }
    }

    /// Scene metres a device metre.
    pub fn scale(&self) -> f64 {
        self.scale
    }

    /// A device's state, in the scene.
    pub fn to_scene(&self, device: ToolState) -> ToolState {
        let turn = self.axes.rotation();
        ToolState {
            position: self.axes.to_scene(device.position) * self.scale + self.offset,
            orientation: (turn * device.orientation * turn.conjugate()).normalize(),
            velocity: self.axes.to_scene(device.velocity) * self.scale,
            angular_velocity: self.axes.to_scene(device.angular_velocity),
            buttons: device.buttons,
        }
    }

    /// The device state that [`to_scene`](Self::to_scene) would make `scene` of.
    pub fn device_state(&self, scene: ToolState) -> ToolState {
        let turn = self.axes.rotation();
        ToolState {
            position: self.axes.to_device(scene.position - self.offset) / self.scale,
            orientation: (turn.conjugate() * scene.orientation * turn).normalize(),
            velocity: self.axes.to_device(scene.velocity) / self.scale,
            angular_velocity: self.axes.to_device(scene.angular_velocity),
            buttons: scene.buttons,
        }
    }

    /// A wrench of the scene, for the device: turned, not scaled.
    pub fn to_device(&self, scene: Wrench) -> Wrench {
        Wrench { force: self.axes.to_device(scene.force), torque: self.axes.to_device(scene.torque) }
    }

    /// A wrench of the device, in the scene: the way back of [`to_device`](Self::to_device).
    pub fn wrench_to_scene(&self, device: Wrench) -> Wrench {
        Wrench { force: self.axes.to_scene(device.force), torque: self.axes.to_scene(device.torque) }
    }

    /// What the rim does to a device in this state, in the device frame; nothing without a rim.
    pub fn rim_force(&self, device: &ToolState) -> Wrench {
        self.rim.map_or(Wrench::ZERO, |rim| Wrench::from_force(rim.force(device.position)))
    }
}

impl Default for Mapping {
    fn default() -> Self {
        Self { scale: 1.0, axes: Axes::IDENTITY, offset: DVec3::ZERO, rim: None }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Workspace;
    use glam::DQuat;

    fn mapping(axes: &str) -> Mapping {
        Mapping::new(2.5, axes.parse().unwrap(), DVec3::new(0.1, 0.5, -0.2)).unwrap()
    }

    fn state() -> ToolState {
        ToolState {
            position: DVec3::new(0.01, -0.02, 0.03),
            orientation: DQuat::from_axis_angle(DVec3::new(0.6, 0.0, 0.8), 0.7),
            velocity: DVec3::new(-0.4, 0.2, 0.1),
            angular_velocity: DVec3::new(1.0, 2.0, -3.0),
            buttons: 5,
        }
    }

    fn assert_same(a: ToolState, b: ToolState) {
        assert!((a.position - b.position).length() < 1e-12);
        assert!((a.velocity - b.velocity).length() < 1e-12);
        assert!((a.angular_velocity - b.angular_velocity).length() < 1e-12);
        assert!(a.orientation.angle_between(b.orientation) < 1e-6);
        assert_eq!(a.buttons, b.buttons);
    }

    #[test]
    fn a_place_lands_where_it_should() {
        let scene = mapping("-z y x").to_scene(state());
        assert!((scene.position - DVec3::new(-0.075 + 0.1, -0.05 + 0.5, 0.025 - 0.2)).length() < 1e-12);
        assert!((scene.velocity - DVec3::new(-0.25, 0.5, -1.0)).length() < 1e-12);
        assert_eq!(scene.angular_velocity, DVec3::new(3.0, 2.0, 1.0));
    }

    #[test]
    fn there_and_back_is_the_same() {
        for axes in ["x y z", "-z y x", "y z x", "-x -y z"] {
            let mapping = mapping(axes);
            assert_same(mapping.device_state(mapping.to_scene(state())), state());
        }
        assert_eq!(Mapping::default().to_scene(ToolState::at(DVec3::X)), ToolState::at(DVec3::X));
    }

    #[test]
    fn power_differs_by_the_scale_alone() {
        let wrench = Wrench { force: DVec3::new(1.0, -3.0, 2.0), torque: DVec3::new(0.1, 0.2, 0.3) };
        for axes in ["x y z", "-z y x", "y z x", "-x -y z"] {
            let mapping = mapping(axes);
            let (scene, felt) = (mapping.to_scene(state()), mapping.to_device(wrench));
            let linear = felt.force.dot(state().velocity) * mapping.scale();
            assert!((linear - wrench.force.dot(scene.velocity)).abs() < 1e-12);
            let angular = felt.torque.dot(state().angular_velocity);
            assert!((angular - wrench.torque.dot(scene.angular_velocity)).abs() < 1e-12);
        }
    }

    #[test]
    fn a_spring_in_the_scene_is_stiffer_by_the_scale() {
        let mapping = mapping("y z x");
        let pull = |moved: DVec3| {
            let scene = mapping.to_scene(ToolState::at(moved));
            mapping.to_device(Wrench::from_force((scene.position - mapping.offset) * -100.0)).force
        };
        assert!((pull(DVec3::X * 0.01) - DVec3::X * -2.5).length() < 1e-12);
    }

    #[test]
    fn orientation_turns_with_the_axes_and_rest_stays_rest() {
        let mapping = mapping("-z y x");
        let rest = mapping.to_scene(ToolState::default()).orientation;
        assert!(rest.angle_between(DQuat::IDENTITY) < 1e-6);
        let device = ToolState { orientation: DQuat::from_rotation_x(0.5), ..ToolState::default() };
        // Device x is scene z here.
        let scene = mapping.to_scene(device).orientation;
        assert!(scene.angle_between(DQuat::from_rotation_z(0.5)) < 1e-6, "{scene}");
    }

    #[test]
    fn the_rim_acts_in_the_device_frame() {
        let workspace = Workspace::Sphere { centre: DVec3::ZERO, radius: 0.02 };
        let mapping = mapping("-z y x").with_rim(Rim::new(workspace, 100.0, 0.0).unwrap());
        let felt = mapping.rim_force(&ToolState::at(DVec3::X * 0.03));
        assert!((felt.force - DVec3::X * -1.0).length() < 1e-12);
        assert_eq!(Mapping::default().rim_force(&ToolState::at(DVec3::X * 9.0)), Wrench::ZERO);
    }

    #[test]
    fn numbers_are_checked() {
        let refuse = |scale, offset| Mapping::new(scale, Axes::IDENTITY, offset).unwrap_err().field;
        assert_eq!(refuse(0.0, DVec3::ZERO), "scale");
        assert_eq!(refuse(f64::NAN, DVec3::ZERO), "scale");
        assert_eq!(refuse(1.0, DVec3::Y * 2e3), "offset y (m)");
    }
}
