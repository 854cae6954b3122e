//! The newest value of one thread for one other: a triple buffer.
//!
//! Three buffers: the writer owns one, the reader owns one, and the third lies between them. To publish, the
//! writer swaps its buffer with the middle one and marks that one fresh; to update, the reader swaps its own with
//! a fresh middle one. Each side does one atomic swap, so neither ever waits, and no value is seen half written:
//! a buffer has one owner at any time, and ownership passes with the swap (release by the giver, acquire by the
//! taker). Nothing is allocated after construction.
//!
//! **Where old values go.** The reader only ever lends its buffer out and exchanges it whole: it drops nothing.
//! An old value is dropped or overwritten by the writer, when the writer next fills the buffer that holds it. So
//! a published immutable setting (main → servo) is this same thing with the writer on main: the old settings are
//! freed on main. Up to two superseded values stay alive until then. Two things to mind on the reader's side:
//! - do not clone an `Arc` out of the value, or its last clone may be dropped there after all;
//! - the buffers themselves go with the handle that is dropped last: drop the reader outside of the time loop,
//!   or before the writer.
//!
//! Sources: H. R. Simpson, "Four-slot fully asynchronous communication mechanism", IEE Proceedings E 137(1), 1990,
//! which does without a swap at the cost of a fourth slot; the three-slot form with a swap is that of the crate
//! [triple_buffer](https://docs.rs/triple_buffer).

use std::{fmt, marker::PhantomData};

use crate::sync::{Arc, AtomicUsize, Ordering, UnsafeCell};

/// The bits of the state that number the middle buffer.
const INDEX: usize = 0b011;
/// Set in the state while the reader has not taken the middle buffer.
const FRESH: usize = 0b100;

struct Shared<T> {
    buffers: [UnsafeCell<T>; 3],
    /// Number of the middle buffer, and `FRESH`.
    middle: AtomicUsize,
}

// SAFETY: a buffer is touched only by the handle that owns its number, and numbers change hands only by a swap of
// `middle` with release and acquire. So a `T` is never used by two threads at once, and `Send` is enough.
unsafe impl<T: Send> Sync for Shared<T> {}

/// Makes a hand-over that starts with `initial` on both sides.
///
/// Thread: main (allocates). Cost: two clones. Use [`latest_with`] where `T` is not `Clone`.
#[must_use]
pub fn latest<T: Send + Clone>(initial: T) -> (LatestWriter<T>, LatestReader<T>) {
    latest_with(|| initial.clone())
}

/// Makes a hand-over whose three buffers are made by `make`.
///
/// For values with memory of their own: let `make` reserve it, fill it in place through [`LatestWriter::buffer`],
/// and nothing is ever allocated again. The reader starts with the value made first.
///
/// Thread: main (allocates).
#[must_use]
pub fn latest_with<T: Send>(mut make: impl FnMut() -> T) -> (LatestWriter<T>, LatestReader<T>) {
    let buffers = [make(), make(), make()].map(UnsafeCell::new);
    let shared = Arc::new(Shared { buffers, middle: AtomicUsize::new(1) });
    let writer = LatestWriter { shared: Arc::clone(&shared), own: 2, _value: PhantomData };
    (writer, LatestReader { shared, own: 0, _value: PhantomData })
}

/// The side that publishes; made by [`latest()`].
pub struct LatestWriter<T> {
    shared: Arc<Shared<T>>,
    own: usize,
    /// Makes this `Sync` only where `T` is.
    _value: PhantomData<T>,
}

impl<T: Send> LatestWriter<T> {
    /// Publishes `value`; drops the value that was in the writer's buffer.
    ///
    /// Thread: the writer's. Cost: one move, one drop of an old `T`, one atomic swap; wait-free.
    pub fn write(&mut self, value: T) {
        *self.buffer() = value;
        self.publish();
    }

    /// The writer's own buffer, to be filled in place before [`publish`](Self::publish).
    ///
    /// It holds *some* older value (or an initial one), not the last one published: set all of it.
    ///
    /// Thread: the writer's. Cost: none.
    pub fn buffer(&mut self) -> &mut T {
        // SAFETY: the writer owns buffer `own` until the next swap, which needs `&mut self`.
        self.shared.buffers[self.own].with_mut(|buffer| unsafe { &mut *buffer })
    }

    /// Hands the buffer to the reader as the newest value; a value that the reader has not seen yet is superseded.
    ///
    /// Thread: the writer's. Cost: one atomic swap; wait-free.
    pub fn publish(&mut self) {
        let old = self.shared.middle.swap(self.own | FRESH, Ordering::AcqRel);
        self.own = old & INDEX;
    }
}

impl<T> fmt::Debug for LatestWriter<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("LatestWriter").finish_non_exhaustive()
    }
}

/// The side that sees the newest value; made by [`latest()`].
pub struct LatestReader<T> {
    shared: Arc<Shared<T>>,
    own: usize,
    /// Makes this `Sync` only where `T` is: [`get`](Self::get) needs no more than `&self`.
    _value: PhantomData<T>,
}

impl<T: Send> LatestReader<T> {
    /// Takes the newest value, if one was published since the last call; says whether there was one.
    ///
    /// Thread: the reader's. Cost: one atomic load, and one swap where there is news; wait-free, drops nothing.
    pub fn update(&mut self) -> bool {
        // Only this handle clears `FRESH`, so that what is fresh here is still fresh at the swap.
        if self.shared.middle.load(Ordering::Relaxed) & FRESH == 0 {
            return false;
        }
        let old = self.shared.middle.swap(self.own, Ordering::AcqRel);
        self.own = old & INDEX;
        true
    }

    /// The value that the last [`update`](Self::update) took, or the initial one; it stays the same until the next.
    ///
    /// Thread: the reader's. Cost: none.
    #[must_use]
    pub fn get(&self) -> &T {
        // SAFETY: the reader owns buffer `own` until the next swap, which needs `&mut self`.
        self.shared.buffers[self.own].with(|buffer| unsafe { &*buffer })
    }
}

impl<T> fmt::Debug for LatestReader<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("LatestReader").finish_non_exhaustive()
    }
}

#[cfg(all(test, not(loom)))]
mod tests {
    use super::*;

    #[test]
    fn starts_with_the_initial_value_and_no_news() {
        let (_writer, mut reader) = latest(7);
        assert!(!reader.update());
        assert_eq!(*reader.get(), 7);
    }

    #[test]
    fn the_newest_wins_and_is_news_once() {
        let (mut writer, mut reader) = latest(0);
        writer.write(1);
        writer.write(2);
        assert_eq!(*reader.get(), 0, "a value stays until update");
        assert!(reader.update());
        assert_eq!(*reader.get(), 2);
        assert!(!reader.update());
        assert_eq!(*reader.get(), 2);
    }

    #[test]
    fn buffers_are_filled_in_place_and_never_grow() {
        let (mut writer, mut reader) = latest_with(|| Vec::with_capacity(4));
        for round in 0..10 {
            let buffer = writer.buffer();
            buffer.clear();
            buffer.extend([round; 4]);
            writer.publish();
            assert!(reader.update());
            assert_eq!(*reader.get(), [round; 4]);
            assert_eq!(reader.get().capacity(), 4);
        }
    }

    #[test]
    fn old_values_are_dropped_by_the_writer() {
        let first = Arc::new(());
        let (mut writer, mut reader) = latest_with(|| None);
        writer.write(Some(Arc::clone(&first)));
        assert!(reader.update());
        writer.write(None);
        assert!(reader.update());
        assert_eq!(Arc::strong_count(&first), 2, "the reader gave it back alive");
        writer.write(None);
        writer.write(None);
        assert_eq!(Arc::strong_count(&first), 1, "the writer freed it");
    }

    #[test]
    fn a_reader_is_sent_but_shared_only_where_its_value_may_be() {
        fn sent<T: Send>(_: &T) {}
        let (writer, reader) = latest(std::cell::Cell::new(1));
        sent(&writer);
        sent(&reader);
    }
}
