//! What went wrong, as bits that fit in one atomic.

use std::fmt;
use std::ops::{BitOr, BitOrAssign};

/// A set of faults and remarks. A fault *latches*: the gate gives no force until a person has cleared it. A
/// remark says what happened and goes by itself. A bit without a name here counts as a fault.
///
/// | bit | name | latches | meaning |
/// |---|---|---|---|
/// | 0 | `NON_FINITE_INPUT` | yes | the tool state had a NaN or an infinity |
/// | 1 | `NON_FINITE_FORCE` | yes | the wanted wrench had one |
/// | 2 | `PANIC` | yes | code on the servo's path panicked |
/// | 3 | `STALE` | no | the fluid's data is too old; the force fades and comes back by itself |
/// | 4 | `DEVICE_LOST` | yes | the device no longer answers |
/// | 5 | `EMERGENCY_STOP` | yes | somebody asked for no force |
/// | 6 | `PATH_OVERFLOW` | no | the fluid was too slow to fetch the tool's path; the oldest of it is lost |
/// | 7 | `FLUID_FAULT` | yes | the fluid gave up: it exploded, or its thread died |
/// | 8 | `LATE_TICK` | no | the servo ticked late |
/// | 9 | `FORCE_LIMITED` | no | the wanted force or torque was larger than allowed |
/// | 10 | `SLEW_LIMITED` | no | it changed faster than allowed |
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct FaultSet(u32);

impl FaultSet {
    /// Nothing.
    pub const NONE: Self = Self(0);
    /// The tool state had a NaN or an infinity. Latches.
    pub const NON_FINITE_INPUT: Self = Self(1);
    /// The wanted wrench had a NaN or an infinity. Latches.
    pub const NON_FINITE_FORCE: Self = Self(1 << 1);
    /// Code on the servo's path panicked. Latches.
    pub const PANIC: Self = Self(1 << 2);
    /// The fluid's data is too old. A remark.
    pub const STALE: Self = Self(1 << 3);
    /// The device no longer answers. Latches.
    pub const DEVICE_LOST: Self = Self(1 << 4);
    /// Somebody asked for no force. Latches.
    pub const EMERGENCY_STOP: Self = Self(1 << 5);
    /// Part of the tool's path never reached the fluid. A remark.
    pub const PATH_OVERFLOW: Self = Self(1 << 6);
    /// The fluid gave up. Latches.
    pub const FLUID_FAULT: Self = Self(1 << 7);
    /// The servo ticked late. A remark.
    pub const LATE_TICK: Self = Self(1 << 8);
    /// The wanted force or torque was larger than allowed. A remark.
    pub const FORCE_LIMITED: Self = Self(1 << 9);
    /// The wanted force or torque changed faster than allowed. A remark.
    pub const SLEW_LIMITED: Self = Self(1 << 10);

    /// Every named bit with its name, lowest first.
    const NAMED: [(Self, &'static str); 11] = [
        (Self::NON_FINITE_INPUT, "NON_FINITE_INPUT"),
        (Self::NON_FINITE_FORCE, "NON_FINITE_FORCE"),
        (Self::PANIC, "PANIC"),
        (Self::STALE, "STALE"),
        (Self::DEVICE_LOST, "DEVICE_LOST"),
        (Self::EMERGENCY_STOP, "EMERGENCY_STOP"),
        (Self::PATH_OVERFLOW, "PATH_OVERFLOW"),
        (Self::FLUID_FAULT, "FLUID_FAULT"),
        (Self::LATE_TICK, "LATE_TICK"),
        (Self::FORCE_LIMITED, "FORCE_LIMITED"),
        (Self::SLEW_LIMITED, "SLEW_LIMITED"),
    ];

    /// Bits that do not latch; every other bit does, so that one unknown here errs to the safe side.
    const REMARKS: u32 = Self::STALE.0
        | Self::PATH_OVERFLOW.0
        | Self::LATE_TICK.0
        | Self::FORCE_LIMITED.0
        | Self::SLEW_LIMITED.0;

    /// The set whose bits these are; unknown ones are kept.
    pub const fn from_bits(bits: u32) -> Self {
        Self(bits)
    }

    /// Its bits.
    pub const fn bits(self) -> u32 {
        self.0
    }

    /// True when nothing is in it.
    pub const fn is_empty(self) -> bool {
        self.0 == 0
    }

    /// True when all of `other` is in it.
    pub const fn contains(self, other: Self) -> bool {
        self.0 & other.0 == other.0
    }

    /// What is in both.
    pub const fn intersection(self, other: Self) -> Self {
        Self(self.0 & other.0)
    }

    /// What is in it but not in `other`.
    pub const fn difference(self, other: Self) -> Self {
        Self(self.0 & !other.0)
    }

    /// The part of it that holds the force at zero until it is cleared.
    pub const fn latching(self) -> Self {
        Self(self.0 & !Self::REMARKS)
    }

    /// `self` if `condition` holds, else nothing.
    pub const fn when(self, condition: bool) -> Self {
        if condition { self } else { Self::NONE }
    }

    /// Names of the bits in it, lowest first. Bits without a name are left out.
    pub fn names(self) -> impl Iterator<Item = &'static str> {
        Self::NAMED.into_iter().filter(move |(bit, _)| self.contains(*bit)).map(|(_, name)| name)
    }

    /// The bits in it that have no name.
    fn unnamed(self) -> u32 {
        Self::NAMED.iter().fold(self.0, |bits, (bit, _)| bits & !bit.0)
    }
}

impl BitOr for FaultSet {
    type Output = Self;
    fn bitor(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }
}

impl BitOrAssign for FaultSet {
    fn bitor_assign(&mut self, other: Self) {
        self.0 |= other.0;
    }
}

/// Names joined with `|`, unknown bits as one hexadecimal number, `NONE` where there is nothing.
impl fmt::Display for FaultSet {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.is_empty() {
            return f.write_str("NONE");
        }
        let mut separator = "";
        for name in self.names() {
            write!(f, "{separator}{name}")?;
            separator = "|";
        }
        match self.unnamed() {
            0 => Ok(()),
            bits => write!(f, "{separator}{bits:#x}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_printed_as_names() {
        let set = FaultSet::STALE | FaultSet::PANIC | FaultSet::SLEW_LIMITED;
        assert_eq!(set.to_string(), "PANIC|STALE|SLEW_LIMITED");
        assert_eq!(set.names().collect::<Vec<_>>(), ["PANIC", "STALE", "SLEW_LIMITED"]);
        assert_eq!(FaultSet::NONE.to_string(), "NONE");
        assert_eq!(FaultSet::from_bits(1 << 31 | 4).to_string(), "PANIC|0x80000000");
    }

    #[test]
    fn the_named_bits_are_apart_and_in_order() {
        for (n, (bit, _)) in FaultSet::NAMED.iter().enumerate() {
            assert_eq!(bit.bits(), 1 << n);
        }
    }

    #[test]
    fn remarks_do_not_latch_and_unknown_bits_do() {
        let latching = FaultSet::from_bits(u32::MAX).latching();
        assert!(latching.intersection(FaultSet::STALE | FaultSet::PATH_OVERFLOW).is_empty());
        assert!(latching.contains(FaultSet::EMERGENCY_STOP | FaultSet::from_bits(1 << 20)));
        let named: Vec<_> = latching.names().collect();
        let faults =
            ["NON_FINITE_INPUT", "NON_FINITE_FORCE", "PANIC", "DEVICE_LOST", "EMERGENCY_STOP", "FLUID_FAULT"];
        assert_eq!(named, faults);
    }

    #[test]
    fn sets_are_joined_and_parted() {
        let mut set = FaultSet::PANIC;
        set |= FaultSet::STALE;
        assert!(set.contains(FaultSet::STALE) && !set.contains(FaultSet::STALE | FaultSet::DEVICE_LOST));
        assert_eq!(set.difference(FaultSet::PANIC), FaultSet::STALE);
        assert_eq!(FaultSet::PANIC.when(false), FaultSet::NONE);
    }
}
