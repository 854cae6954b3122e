//! What a 3Dconnexion device says.
//!
//! As public drivers read it (Linux, `drivers/hid`; spacenavd): a report is a number and 16-bit little-endian values. 1 is
//! the cap's shift along its axes, and on newer devices its turn too; 2 is the turn; 3 are the buttons. Its axes: x right,
//! y to the user, z down. At rest all are 0.

use glam::DVec3;

/// The cap's farthest deflection, either way.
const FULL: f64 = 350.0;

/// Where the cap stands, and the buttons.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MotionReport {
    /// Shift, share of the farthest, along x right, y up, z to the user.
    pub shift: DVec3,
    /// Turn about the same axes, share of the farthest.
    pub turn: DVec3,
    /// Bit n is set while button n is down.
    pub buttons: u32,
}

impl MotionReport {
    /// Takes a report; what is none is passed over.
    pub fn take(&mut self, report: &[u8]) {
        match report.split_first() {
            Some((1, values)) => {
                self.shift = vector(values).unwrap_or(self.shift);
                self.turn = values.get(6..).and_then(vector).unwrap_or(self.turn);
            }
            Some((2, values)) => self.turn = vector(values).unwrap_or(self.turn),
            Some((3, values)) => {
                let bytes = std::array::from_fn(|n| values.get(n).copied().unwrap_or(0));
                self.buttons = u32::from_le_bytes(bytes);
            }
            _ => {}
        }
    }
}

/// Three values in our axes, each within ±1.
fn vector(values: &[u8]) -> Option<DVec3> {
    let mut pairs = values.chunks_exact(2).map(|pair| f64::from(i16::from_le_bytes([pair[0], pair[1]])));
    let (x, y, z) = (pairs.next()?, pairs.next()?, pairs.next()?);
    Some((DVec3::new(x, -z, y) / FULL).clamp(DVec3::NEG_ONE, DVec3::ONE))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_generations_are_read() {
        let mut cap = MotionReport::default();
        // 350 right, 175 to the user, -350 down: up.
        cap.take(&[1, 0x5E, 0x01, 0xAF, 0x00, 0xA2, 0xFE]);
        assert_eq!(cap.shift, DVec3::new(1.0, 1.0, 0.5));
        cap.take(&[2, 0, 0, 0, 0, 0x5E, 0x01]);
        assert_eq!(cap.turn, DVec3::new(0.0, -1.0, 0.0));
        cap.take(&[3, 0b10, 0x01]);
        assert_eq!(cap.buttons, 0x102);
        cap.take(&[1, 0, 0, 0, 0, 0, 0, 0x5E, 0x01, 0, 0, 0, 0]);
        assert_eq!((cap.shift, cap.turn), (DVec3::ZERO, DVec3::X));
    }

    #[test]
    fn what_is_no_report_changes_nothing() {
        let sound = MotionReport { shift: DVec3::X, turn: DVec3::Y, buttons: 0 };
        for report in [&[][..], &[1], &[1, 2, 3], &[2, 1, 2, 3, 4, 5], &[9, 1, 2, 3, 4, 5, 6]] {
            let mut cap = sound;
            cap.take(report);
            assert_eq!(cap, sound);
        }
    }

    #[test]
    fn no_report_is_beyond_the_farthest() {
        let mut cap = MotionReport::default();
        cap.take(&[1, 0xFF, 0x7F, 0x00, 0x80, 0xFF, 0x7F]);
        assert_eq!(cap.shift, DVec3::new(1.0, -1.0, -1.0));
    }
}
