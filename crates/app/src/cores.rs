//! How much of this machine there is.

/// Processors that this program may use; one where nobody knows.
pub fn cores() -> usize {
    std::thread::available_parallelism().map_or(1, std::num::NonZero::get)
}
