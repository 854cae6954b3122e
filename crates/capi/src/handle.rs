//! Handles: the number of a place, and which of those that were there it means.

use crate::caller::Plain;
use crate::code::Code;
use crate::contract::as_in_header;

/// `hapflow_session`.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Handle {
    pub id: Id,
}

as_in_header!(Handle = hapflow_session { id });

/// `hapflow_device`.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DeviceHandle {
    pub id: Id,
}

as_in_header!(DeviceHandle = hapflow_device { id });

/// `hapflow_scene`.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SceneHandle {
    pub id: Id,
}

as_in_header!(SceneHandle = hapflow_scene { id });

// SAFETY: repr(C), a number.
unsafe impl Plain for DeviceHandle {}

/// A handle's number: place + 1 in the lower half, generation in the upper; 0 is null.
#[repr(transparent)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Id(u64);

impl Id {
    /// Of nothing.
    pub const NULL: Self = Self(0);

    pub fn new(place: usize, generation: u32) -> Self {
        Self(u64::from(generation) << 32 | (place as u64 + 1))
    }

    pub fn generation(self) -> u32 {
        (self.0 >> 32) as u32
    }

    /// The place that it names.
    pub fn of<T>(self, places: &[T]) -> Result<&T, Code> {
        let index = (self.0 & u64::from(u32::MAX)).wrapping_sub(1);
        usize::try_from(index).ok().and_then(|i| places.get(i)).ok_or(Code::ERROR_HANDLE)
    }
}

/// The generation after `last`; never 0, so that no handle is null.
pub fn next_generation(last: u32) -> u32 {
    last.checked_add(1).unwrap_or(1)
}
