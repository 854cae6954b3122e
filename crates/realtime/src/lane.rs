//! A place for one thing, entered by generation: the gatekeeper of what a handle names.
//!
//! One atomic word holds the generation (upper half) and who is inside (lower half), so that a stale handle never
//! disturbs who came after it, and no order between two atomics has to be argued.
//!
//! ```text
//! vacant ──claim──► claimed ──open(generation)──► open ◄──► entered by one, or shared by many
//!    ▲                 ▲                           │
//!    └──── dropped ────┴──── close: waits out who is inside
//! ```

use crate::sync::{AtomicU64, Ordering, UnsafeCell};
use std::fmt;
use std::ops::{Deref, DerefMut};
use std::ptr::NonNull;

/// Nobody may enter.
const SHUT: u64 = 1 << 31;
/// One thread has it for itself.
const ALONE: u64 = 1 << 30;
/// It is empty and may be claimed.
const VACANT: u64 = 1 << 29;
/// Threads that share it.
const SHARERS: u64 = VACANT - 1;

/// Why nobody got in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Refused {
    /// Another generation, or none.
    Stale,
    /// Somebody is inside.
    Busy,
}

/// What can be entered alone, and marked if that goes wrong.
pub trait Faultable {
    /// Marks it, as a thread panics inside. Must not panic. Thread: the one that panics.
    fn fault(&mut self);
}

/// A place for a `T`, which threads enter that know its generation: one alone, or several to look. It may be a static.
///
/// What is entered alone is marked ([`Faultable`]) when a thread panics inside, and is left.
pub struct Lane<T> {
    word: AtomicU64,
    content: UnsafeCell<Option<T>>,
}

// SAFETY: the content is reached through `Alone` and `Claimed`, which the word gives to one thread at a time
// (hence `T: Send`), and through `Sharing`, which asks for `T: Sync` itself.
unsafe impl<T: Send> Sync for Lane<T> {}

impl<T> Lane<T> {
    /// An empty one. Thread: any.
    #[cfg(not(loom))]
    #[must_use]
    pub const fn vacant() -> Self {
        Self { word: AtomicU64::new(SHUT | VACANT), content: UnsafeCell::new(None) }
    }

    /// The same; the model checker's parts are not made while compiling.
    #[cfg(loom)]
    #[must_use]
    pub fn vacant() -> Self {
        Self { word: AtomicU64::new(SHUT | VACANT), content: UnsafeCell::new(None) }
    }

    /// Takes it for filling, if it is empty. Thread: any; wait-free.
    pub fn claim(&self) -> Option<Claimed<'_, T>> {
        let found = self.word.load(Ordering::Relaxed);
        let taken = word(generation(found), SHUT | ALONE);
        let vacant = word(generation(found), SHUT | VACANT);
        self.word.compare_exchange(vacant, taken, Ordering::Acquire, Ordering::Relaxed).ok()?;
        Some(Claimed { lane: self })
    }

    /// Shuts it for who knows the generation `expected`, and waits until everybody has left. Thread: main (blocks);
    /// whoever is inside must not call it.
    ///
    /// # Errors
    /// [`Refused::Stale`] if another generation is inside, or somebody else shuts it.
    pub fn close(&self, expected: u32) -> Result<Claimed<'_, T>, Refused> {
        let mut found = self.word.load(Ordering::Relaxed);
        loop {
            if refuses(found, expected) {
                return Err(Refused::Stale);
            }
            match self.word.compare_exchange_weak(found, found | SHUT, Ordering::Relaxed, Ordering::Relaxed) {
                Ok(_) => break,
                Err(now) => found = now,
            }
        }
        let empty = word(expected, SHUT);
        let mut pause = Pause::default();
        while self.word.compare_exchange(empty, empty | ALONE, Ordering::Acquire, Ordering::Relaxed).is_err()
        {
            pause.wait();
        }
        Ok(Claimed { lane: self })
    }
}

impl<T: Faultable> Lane<T> {
    /// Enters alone. Thread: any; wait-free: one compare-and-swap.
    ///
    /// # Errors
    /// [`Refused`]: another generation, or somebody is inside.
    pub fn enter(&self, expected: u32) -> Result<Alone<'_, T>, Refused> {
        let free = word(expected, 0);
        self.word
            .compare_exchange(free, free | ALONE, Ordering::Acquire, Ordering::Relaxed)
            .map_err(|found| if refuses(found, expected) { Refused::Stale } else { Refused::Busy })?;
        // SAFETY: `ALONE` was raised just now, by this thread. The pointer is only used for writing while it is.
        match self.content.with_mut(|content| unsafe { (*content).as_mut() }) {
            Some(content) => Ok(Alone { lane: self, content: NonNull::from(content) }),
            None => {
                self.word.fetch_and(!ALONE, Ordering::Release);
                Err(Refused::Stale)
            }
        }
    }
}

impl<T: Sync> Lane<T> {
    /// Enters with others. Thread: any; lock-free.
    ///
    /// # Errors
    /// [`Refused`]: another generation, or somebody has it alone.
    pub fn share(&self, expected: u32) -> Result<Sharing<'_, T>, Refused> {
        let mut found = self.word.load(Ordering::Relaxed);
        loop {
            if refuses(found, expected) {
                return Err(Refused::Stale);
            }
            if found & ALONE != 0 || found & SHARERS == SHARERS {
                return Err(Refused::Busy);
            }
            match self.word.compare_exchange_weak(found, found + 1, Ordering::Acquire, Ordering::Relaxed) {
                Ok(_) => break,
                Err(now) => found = now,
            }
        }
        // SAFETY: this thread is counted among the sharers, so nobody fills or empties the cell.
        match self.content.with(|content| unsafe { (*content).as_ref() }) {
            Some(content) => Ok(Sharing { lane: self, content: NonNull::from(content) }),
            None => {
                self.word.fetch_sub(1, Ordering::Release);
                Err(Refused::Stale)
            }
        }
    }
}

impl<T> fmt::Debug for Lane<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Lane").finish_non_exhaustive()
    }
}

fn word(generation: u32, state: u64) -> u64 {
    u64::from(generation) << 32 | state
}

fn generation(word: u64) -> u32 {
    (word >> 32) as u32
}

fn refuses(found: u64, expected: u32) -> bool {
    generation(found) != expected || found & SHUT != 0
}

/// One thread inside, with the content for itself; dropped, it has left.
pub struct Alone<'a, T: Faultable> {
    lane: &'a Lane<T>,
    content: NonNull<T>,
}

impl<T: Faultable> Deref for Alone<'_, T> {
    type Target = T;
    fn deref(&self) -> &T {
        // SAFETY: `ALONE` is up until the drop: no other reference to the content exists.
        unsafe { self.content.as_ref() }
    }
}

impl<T: Faultable> DerefMut for Alone<'_, T> {
    fn deref_mut(&mut self) -> &mut T {
        // SAFETY: as above.
        unsafe { self.content.as_mut() }
    }
}

impl<T: Faultable> Drop for Alone<'_, T> {
    fn drop(&mut self) {
        if std::thread::panicking() {
            self.fault();
        }
        self.lane.word.fetch_and(!ALONE, Ordering::Release);
    }
}

/// One of several threads inside; dropped, it has left.
pub struct Sharing<'a, T> {
    lane: &'a Lane<T>,
    content: NonNull<T>,
}

impl<T> Deref for Sharing<'_, T> {
    type Target = T;
    fn deref(&self) -> &T {
        // SAFETY: while this thread is counted, nobody has the content for itself.
        unsafe { self.content.as_ref() }
    }
}

impl<T> Drop for Sharing<'_, T> {
    fn drop(&mut self) {
        self.lane.word.fetch_sub(1, Ordering::Release);
    }
}

/// A lane that nobody can enter, to be filled or emptied. Dropped, it is vacant.
pub struct Claimed<'a, T> {
    lane: &'a Lane<T>,
}

impl<T> Claimed<'_, T> {
    /// The last generation that was in it; 0 before the first. Thread: the claim's.
    #[must_use]
    pub fn generation(&self) -> u32 {
        generation(self.lane.word.load(Ordering::Relaxed))
    }

    /// Fills it, and lets threads in that know `generation`. Thread: the claim's; what was in it is dropped here.
    pub fn open(self, generation: u32, content: T) {
        // SAFETY: the claim excludes every other thread.
        self.lane.content.with_mut(|place| unsafe { *place = Some(content) });
        self.lane.word.store(word(generation, 0), Ordering::Release);
        std::mem::forget(self);
    }

    /// Lets threads in again that knew the last generation, to what it has. Thread: the claim's.
    pub fn reopen(self) {
        self.lane.word.store(word(self.generation(), 0), Ordering::Release);
        std::mem::forget(self);
    }

    /// Empties it. Thread: the claim's.
    pub fn take(&mut self) -> Option<T> {
        // SAFETY: the claim excludes every other thread.
        self.lane.content.with_mut(|content| unsafe { (*content).take() })
    }
}

impl<T> Drop for Claimed<'_, T> {
    fn drop(&mut self) {
        self.lane.word.store(word(self.generation(), SHUT | VACANT), Ordering::Release);
    }
}

impl<T: Faultable> fmt::Debug for Alone<'_, T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Alone").finish_non_exhaustive()
    }
}

impl<T> fmt::Debug for Sharing<'_, T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Sharing").finish_non_exhaustive()
    }
}

impl<T> fmt::Debug for Claimed<'_, T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Claimed").finish_non_exhaustive()
    }
}

/// Waits longer and longer: a tick is over in microseconds, a fluid step in milliseconds.
#[derive(Default)]
#[cfg_attr(loom, allow(dead_code))]
struct Pause(u32);

impl Pause {
    #[cfg(loom)]
    fn wait(&mut self) {
        loom::thread::yield_now();
    }

    #[cfg(not(loom))]
    fn wait(&mut self) {
        self.0 = self.0.saturating_add(1);
        match self.0 {
            0..100 => std::hint::spin_loop(),
            100..200 => std::thread::yield_now(),
            _ => std::thread::sleep(std::time::Duration::from_micros(100)),
        }
    }
}

#[cfg(all(test, not(loom)))]
mod tests {
    use super::*;
    use std::sync::atomic::AtomicU32;
    use std::thread;

    struct Count(u64);

    impl Faultable for Count {
        fn fault(&mut self) {
            self.0 = u64::MAX;
        }
    }

    #[allow(clippy::unwrap_used, reason = "a helper of tests")]
    fn open(generation: u32, start: u64) -> Lane<Count> {
        let lane = Lane::vacant();
        lane.claim().unwrap().open(generation, Count(start));
        lane
    }

    #[test]
    fn only_the_right_generation_enters_and_only_one_thread() {
        let lane = open(3, 7);
        assert_eq!(lane.enter(2).err(), Some(Refused::Stale));
        let inside = lane.enter(3).unwrap();
        assert_eq!(inside.0, 7);
        assert_eq!(lane.enter(3).err(), Some(Refused::Busy));
        assert_eq!(lane.enter(2).err(), Some(Refused::Stale));
        drop(inside);
        assert!(lane.enter(3).is_ok());
    }

    #[test]
    fn what_was_closed_is_vacant_and_keeps_its_generation() {
        let lane = open(3, 7);
        let mut closed = lane.close(3).unwrap();
        assert_eq!(closed.take().map(|c| c.0), Some(7));
        assert!(lane.claim().is_none());
        drop(closed);
        assert_eq!(lane.enter(3).err(), Some(Refused::Stale));
        assert_eq!(lane.close(3).err(), Some(Refused::Stale));
        assert_eq!(lane.claim().map(|c| c.generation()), Some(3));
    }

    #[test]
    fn what_was_closed_may_be_opened_again_as_it_was() {
        let lane = open(3, 7);
        lane.close(3).unwrap().reopen();
        assert_eq!(lane.enter(3).unwrap().0, 7);
    }

    #[test]
    fn a_panic_inside_faults_the_content_and_leaves() {
        let lane = open(1, 0);
        let panicked = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| {
            let _inside = lane.enter(1).unwrap();
            panic!("as intended");
        }));
        assert!(panicked.is_err());
        assert_eq!(lane.enter(1).unwrap().0, u64::MAX);
    }

    #[test]
    fn no_entry_is_lost_and_closing_waits() {
        let lane = open(1, 0);
        let done = AtomicU32::new(0);
        let in_all = thread::scope(|scope| {
            for _ in 0..4 {
                scope.spawn(|| {
                    loop {
                        match lane.enter(1) {
                            Ok(mut inside) => inside.0 += 1,
                            Err(Refused::Busy) => continue,
                            Err(Refused::Stale) => break,
                        }
                        done.fetch_add(1, Ordering::Relaxed);
                    }
                });
            }
            while done.load(Ordering::Relaxed) < 1000 {
                thread::yield_now();
            }
            lane.close(1).unwrap().take().unwrap().0
        });
        assert_eq!(in_all, u64::from(done.load(Ordering::Relaxed)));
    }

    #[test]
    fn many_share() {
        let lane = Lane::vacant();
        lane.claim().unwrap().open(1, 5);
        let (a, b) = (lane.share(1).unwrap(), lane.share(1).unwrap());
        assert_eq!(*a + *b, 10);
        assert_eq!(lane.share(2).err(), Some(Refused::Stale));
    }
}
