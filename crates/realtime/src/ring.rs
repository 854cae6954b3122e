//! Every sample of one thread for one other, in order: a bounded ring whose oldest samples go on overflow.
//!
//! The producer must neither wait nor lose the *newest* samples, so it overwrites the oldest, even one that the
//! consumer is about to read. A plain ring would have both touch one slot then, which is undefined behaviour even
//! if the reader throws the torn copy away (H.-J. Boehm, "Can seqlocks get along with programming language memory
//! models?", MSPC 2012). Here slots hold no samples, only *tickets*: a sequence number and the number of a buffer
//! that holds the sample. There are two buffers more than slots: each side owns one.
//! - Push writes the producer's own buffer and swaps its ticket into the slot of that sequence number; the buffer
//!   in the ticket that comes out is the producer's next one. If that ticket was unread, its sample is lost.
//! - Pop looks at the slot of the next sequence number. If the ticket there is that one, it exchanges it, by
//!   compare and swap, for an empty ticket with the consumer's own buffer, and so owns the sample before it reads
//!   it. If the producer was there first, the ticket has a later number, which says exactly which samples went.
//!
//! So a buffer has one owner at any time, and a sample may be any `Copy` type. Sequence numbers are never used
//! twice (48 bits: 8900 years at 1 kHz), so the compare and swap has no ABA problem.
//!
//! Sources: L. Lamport, "Specifying concurrent program modules", ACM TOPLAS 5(2), 1983, for the ring of one
//! producer and one consumer; the exchange of buffers is that of [`latest`](crate::latest()), once a slot.

use std::{cmp::Ordering::*, fmt, marker::PhantomData};

use crate::sync::{Arc, AtomicU64, Ordering, UnsafeCell};

/// The most samples that a ring can hold.
pub const MAX_RING_CAPACITY: usize = (1 << BUFFER_BITS) - 2;

const BUFFER_BITS: u32 = 16;

/// A sequence number (0: empty, there is no sample) and the number of the buffer that goes with it, in one word.
#[derive(Clone, Copy)]
struct Ticket(u64);

impl Ticket {
    fn new(sequence: u64, buffer: usize) -> Self {
        Self(sequence << BUFFER_BITS | buffer as u64)
    }

    fn empty(buffer: usize) -> Self {
        Self::new(0, buffer)
    }

    fn sequence(self) -> u64 {
        self.0 >> BUFFER_BITS
    }

    fn buffer(self) -> usize {
        (self.0 & ((1 << BUFFER_BITS) - 1)) as usize
    }
}

struct Shared<T> {
    slots: Box<[AtomicU64]>,
    /// Two more than slots. A sample is `None` only before its buffer's first use.
    buffers: Box<[UnsafeCell<Option<T>>]>,
}

// SAFETY: a buffer is touched only by the handle that owns its number; numbers change hands only by swaps of a
// slot with release and acquire. So a `T` is never used by two threads at once, and `Send` is enough.
unsafe impl<T: Send> Sync for Shared<T> {}

impl<T> Shared<T> {
    fn capacity(&self) -> u64 {
        self.slots.len() as u64
    }

    fn slot(&self, sequence: u64) -> &AtomicU64 {
        &self.slots[(sequence % self.capacity()) as usize]
    }
}

/// Makes a ring that holds `capacity` samples, from 1 to [`MAX_RING_CAPACITY`] (others are taken as the nearest).
///
/// Choose it for the longest time that the consumer may stay away: 1 kHz and a pause of 0.5 s are 500 samples.
///
/// Thread: main (allocates).
#[must_use]
pub fn ring<T: Copy + Send>(capacity: usize) -> (RingProducer<T>, RingConsumer<T>) {
    let capacity = capacity.clamp(1, MAX_RING_CAPACITY);
    let slots = (0..capacity).map(|buffer| AtomicU64::new(Ticket::empty(buffer).0)).collect();
    let buffers = (0..capacity + 2).map(|_| UnsafeCell::new(None)).collect();
    let shared = Arc::new(Shared { slots, buffers });
    let producer = RingProducer { shared: Arc::clone(&shared), own: capacity, next: 1, _value: PhantomData };
    (producer, RingConsumer { shared, own: capacity + 1, next: 1, lost: 0, _value: PhantomData })
}

/// The side that writes samples; made by [`ring()`].
pub struct RingProducer<T> {
    shared: Arc<Shared<T>>,
    own: usize,
    /// The sequence number of the next sample.
    next: u64,
    _value: PhantomData<T>,
}

impl<T: Copy + Send> RingProducer<T> {
    /// Appends `sample`; true if the ring was full, so that its oldest sample is lost.
    ///
    /// Thread: the producer's. Cost: one copy, one atomic swap; wait-free.
    pub fn push(&mut self, sample: T) -> bool {
        // SAFETY: the producer owns buffer `own` until the swap below.
        self.shared.buffers[self.own].with_mut(|buffer| unsafe { *buffer = Some(sample) });
        let ticket = Ticket::new(self.next, self.own);
        let old = Ticket(self.shared.slot(self.next).swap(ticket.0, Ordering::AcqRel));
        self.own = old.buffer();
        self.next += 1;
        old.sequence() != 0
    }

    /// How many samples the ring holds at most.
    ///
    /// Thread: the producer's. Cost: none.
    #[must_use]
    pub fn capacity(&self) -> usize {
        self.shared.slots.len()
    }
}

impl<T> fmt::Debug for RingProducer<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("RingProducer").field("next", &self.next).finish_non_exhaustive()
    }
}

/// The side that reads samples; made by [`ring()`].
pub struct RingConsumer<T> {
    shared: Arc<Shared<T>>,
    own: usize,
    /// The sequence number of the oldest sample neither read nor known to be lost.
    next: u64,
    /// Samples lost since [`lost`](Self::lost) was called.
    lost: u64,
    _value: PhantomData<T>,
}

impl<T: Copy + Send> RingConsumer<T> {
    /// Takes the oldest sample that is still there, or `None` if all were read.
    ///
    /// Samples come in the order of their pushes and each at most once; a gap shows in [`lost`](Self::lost).
    ///
    /// Thread: the consumer's. Cost: one copy, one atomic load and one compare and swap, and as much again each
    /// time the producer overwrites the very sample that is being taken; lock-free.
    pub fn pop(&mut self) -> Option<T> {
        loop {
            let seen = Ticket(self.shared.slot(self.next).load(Ordering::Acquire));
            match seen.sequence().cmp(&self.next) {
                // Empty: this sample is not there yet. (What was skipped is known to be overwritten, so that no
                // unread ticket is ever older than `next`.)
                Less => return None,
                Equal if self.claim(seen) => return self.read(),
                // The claim failed because the producer was there first: look again.
                Equal => {}
                Greater => self.skip_to(seen.sequence() - self.shared.capacity() + 1),
            }
        }
    }

    /// How many samples were overwritten unread since this was called last, as far as [`pop`](Self::pop) has come:
    /// exact once `pop` has answered `None`.
    ///
    /// Thread: the consumer's. Cost: none.
    pub fn lost(&mut self) -> u64 {
        std::mem::take(&mut self.lost)
    }

    /// How many samples the ring holds at most.
    ///
    /// Thread: the consumer's. Cost: none.
    #[must_use]
    pub fn capacity(&self) -> usize {
        self.shared.slots.len()
    }

    /// Exchanges the ticket for an empty one; on success the buffer of `seen` is the consumer's own.
    fn claim(&mut self, seen: Ticket) -> bool {
        let empty = Ticket::empty(self.own);
        let slot = self.shared.slot(self.next);
        // The load that gave `seen` has acquired the sample: a ticket is stored once. Release hands back `own`.
        let claimed = slot.compare_exchange(seen.0, empty.0, Ordering::Release, Ordering::Relaxed).is_ok();
        if claimed {
            self.own = seen.buffer();
            self.next += 1;
        }
        claimed
    }

    fn read(&self) -> Option<T> {
        // SAFETY: the consumer owns buffer `own` until its next claim, which needs `&mut self`.
        self.shared.buffers[self.own].with(|buffer| unsafe { *buffer })
    }

    /// A ticket with sequence number `s` was seen, so all up to `s - capacity` were overwritten, and `oldest`, the
    /// one after those, was written at least once.
    fn skip_to(&mut self, oldest: u64) {
        self.lost += oldest - self.next;
        self.next = oldest;
    }
}

impl<T> fmt::Debug for RingConsumer<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("RingConsumer")
            .field("next", &self.next)
            .field("lost", &self.lost)
            .finish_non_exhaustive()
    }
}

#[cfg(all(test, not(loom)))]
mod tests {
    use super::*;

    fn drain(consumer: &mut RingConsumer<u64>) -> Vec<u64> {
        std::iter::from_fn(|| consumer.pop()).collect()
    }

    #[test]
    fn samples_come_in_order_and_once() {
        let (mut producer, mut consumer) = ring(4);
        assert_eq!(consumer.pop(), None);
        for round in 0..5 {
            for sample in 0..3 {
                assert!(!producer.push(10 * round + sample));
            }
            assert_eq!(drain(&mut consumer), [0, 1, 2].map(|sample| 10 * round + sample));
        }
        assert_eq!(consumer.lost(), 0);
    }

    #[test]
    fn the_oldest_go_on_overflow_and_are_counted() {
        let (mut producer, mut consumer) = ring(3);
        let overwrote = (0..10).filter(|&sample| producer.push(sample)).count();
        assert_eq!(overwrote, 7);
        assert_eq!(drain(&mut consumer), [7, 8, 9]);
        assert_eq!(consumer.lost(), 7);
        assert_eq!(consumer.lost(), 0, "counted once");
    }

    #[test]
    fn overflow_after_some_were_read() {
        let (mut producer, mut consumer) = ring(2);
        producer.push(0);
        producer.push(1);
        assert_eq!(consumer.pop(), Some(0));
        assert!(!producer.push(2));
        assert!(producer.push(3));
        assert_eq!(drain(&mut consumer), [2, 3]);
        assert_eq!(consumer.lost(), 1);
    }

    #[test]
    fn capacity_is_brought_into_range() {
        let (mut producer, mut consumer) = ring(0);
        assert_eq!(producer.capacity(), 1);
        producer.push(1);
        producer.push(2);
        assert_eq!(drain(&mut consumer), [2]);
        assert_eq!(ring::<u8>(usize::MAX).1.capacity(), MAX_RING_CAPACITY);
    }

    #[test]
    fn the_largest_ring_numbers_all_its_buffers() {
        let (mut producer, mut consumer) = ring(MAX_RING_CAPACITY);
        let count = 2 * MAX_RING_CAPACITY as u64 + 5;
        let overwrote = (0..count).filter(|&sample| producer.push(sample)).count();
        assert_eq!(overwrote, MAX_RING_CAPACITY + 5);
        assert!(drain(&mut consumer).into_iter().eq(count - MAX_RING_CAPACITY as u64..count));
    }
}
