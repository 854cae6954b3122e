//! A button that lets the hand move without the tool.

use crate::ToolState;
use glam::DVec3;

/// While its button is down the tool stays where it is, and the device may be brought to where there is room again, as a
/// mouse is lifted. The caller sends no force of the scene meanwhile.
#[derive(Clone, Copy, Debug)]
pub struct Clutch {
    button: u32,
    /// Added to the device's places, m.
    shift: DVec3,
    /// Where the tool stays, while the button is down.
    held: Option<DVec3>,
}

impl Clutch {
    /// A clutch on button `button`, 0 to 31.
    pub fn new(button: u32) -> Self {
        Self { button, shift: DVec3::ZERO, held: None }
    }

    /// The state that counts for the device's own, and whether the clutch is out.
    pub fn step(&mut self, device: &ToolState) -> (ToolState, bool) {
        if device.buttons.checked_shr(self.button).unwrap_or(0) & 1 == 0 {
            self.held = None;
            return (ToolState { position: device.position + self.shift, ..*device }, false);
        }
        let held = *self.held.get_or_insert(device.position + self.shift);
        self.shift = held - device.position;
        (ToolState { position: held, velocity: DVec3::ZERO, ..*device }, true)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_tool_stays_while_the_button_is_down_and_goes_on_from_there() {
        let mut clutch = Clutch::new(2);
        let at = |x: f64, buttons| ToolState { velocity: DVec3::X, buttons, ..ToolState::at(DVec3::X * x) };
        assert_eq!(clutch.step(&at(1.0, 0b011)), (at(1.0, 0b011), false));
        for x in [1.1, 0.5, 0.2] {
            let (state, out) = clutch.step(&at(x, 0b100));
            assert!(out && state.velocity == DVec3::ZERO);
            assert!((state.position.x - 1.1).abs() < 1e-12);
        }
        let (state, out) = clutch.step(&at(0.3, 0));
        assert!(!out && (state.position.x - 1.2).abs() < 1e-12);
        // A second time on top of the first.
        clutch.step(&at(0.3, 0b100));
        clutch.step(&at(0.0, 0b100));
        assert!((clutch.step(&at(0.1, 0)).0.position.x - 1.3).abs() < 1e-12);
    }
}
