//! A set of bits that any thread may raise, clear and read: faults, emergency stop.

use crate::sync::{Arc, AtomicU32, Ordering};

/// 32 bits shared by all clones of this handle; at first none is raised.
///
/// What the bits mean is the owner's matter. Who sees a bit raised also sees what the thread that raised it wrote
/// before. Clone it on main and give each thread its own handle.
///
/// Thread: any, for all methods. Cost: one atomic operation each; wait-free.
#[derive(Clone, Debug)]
pub struct SharedFlags(Arc<AtomicU32>);

impl SharedFlags {
    /// A new set with no bit raised. Thread: main (allocates).
    #[must_use]
    pub fn new() -> Self {
        Self(Arc::new(AtomicU32::new(0)))
    }

    /// Raises all of `bits`, leaving the others; answers the set as it was before.
    pub fn raise(&self, bits: u32) -> u32 {
        self.0.fetch_or(bits, Ordering::AcqRel)
    }

    /// Clears all of `bits`, leaving the others; answers the set as it was before.
    pub fn clear(&self, bits: u32) -> u32 {
        self.0.fetch_and(!bits, Ordering::AcqRel)
    }

    /// The set as it is now.
    #[must_use]
    pub fn load(&self) -> u32 {
        self.0.load(Ordering::Acquire)
    }
}

impl Default for SharedFlags {
    fn default() -> Self {
        Self::new()
    }
}

#[cfg(all(test, not(loom)))]
mod tests {
    use super::*;

    #[test]
    fn bits_are_raised_and_cleared_alone() {
        let flags = SharedFlags::new();
        let other = flags.clone();
        assert_eq!(flags.raise(0b0110), 0);
        assert_eq!(other.raise(0b0011), 0b0110);
        assert_eq!(flags.clear(0b0010), 0b0111);
        assert_eq!(other.load(), 0b0101);
    }
}
