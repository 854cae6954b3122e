//! A number that any thread may lower and none may raise: a limit.

use crate::sync::{Arc, AtomicU64, Ordering};

/// A number, not negative, that only falls; shared by all clones of this handle.
///
/// Thread: any, for all methods. Cost: one atomic operation each; lock-free.
#[derive(Clone, Debug)]
pub struct Ceiling(Arc<AtomicU64>);

impl Ceiling {
    /// It begins at `value`; what is no number, or below 0, counts as 0. Thread: main (allocates).
    #[must_use]
    pub fn new(value: f64) -> Self {
        Self(Arc::new(AtomicU64::new(ordered(value))))
    }

    /// Where it is now.
    #[must_use]
    pub fn get(&self) -> f64 {
        f64::from_bits(self.0.load(Ordering::Acquire))
    }

    /// Lowers it to `value`; a higher one leaves it.
    pub fn lower(&self, value: f64) {
        self.0.fetch_min(ordered(value), Ordering::AcqRel);
    }
}

/// The bits of a number that is not negative: they are in the order of the numbers.
fn ordered(value: f64) -> u64 {
    // Not -0, whose bits would be the highest.
    if value > 0.0 { value.to_bits() } else { 0 }
}

#[cfg(all(test, not(loom)))]
mod tests {
    use super::*;

    #[test]
    fn it_falls_and_never_rises() {
        let ceiling = Ceiling::new(4.0);
        let other = ceiling.clone();
        for (value, now) in [(5.0, 4.0), (f64::INFINITY, 4.0), (1.5, 1.5), (1e-300, 1e-300), (2.0, 1e-300)] {
            other.lower(value);
            assert_eq!(ceiling.get(), now);
        }
    }

    #[test]
    fn what_is_no_number_counts_as_zero() {
        for value in [f64::NAN, -0.0, -1.0, f64::NEG_INFINITY] {
            assert_eq!(Ceiling::new(value).get(), 0.0);
            let ceiling = Ceiling::new(4.0);
            ceiling.lower(value);
            assert_eq!(ceiling.get(), 0.0);
        }
    }
}
