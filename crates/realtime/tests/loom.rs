//! Small models of the hand-overs in every order that the memory model allows. Run with
//! `RUSTFLAGS="--cfg loom" cargo test -p hapflow-realtime --release --test loom`.
#![cfg(loom)]

use hapflow_realtime::{
    Ceiling, Faultable, Lane, LatestReader, LatestWriter, Refused, RingConsumer, RingProducer, SharedFlags,
    latest_with, ring,
};
use loom::{cell::UnsafeCell, sync::Arc, thread};

/// A value whose every access loom watches, even through a reference that a hand-over lent out.
struct Watched(UnsafeCell<u64>);

impl Watched {
    fn new() -> Self {
        Self(UnsafeCell::new(0))
    }

    fn get(&self) -> u64 {
        // SAFETY: what the model is to prove; loom reports an access at the same time as another.
        self.0.with(|value| unsafe { *value })
    }

    fn set(&mut self, value: u64) {
        // SAFETY: as above.
        self.0.with_mut(|old| unsafe { *old = value });
    }
}

fn fill(writer: &mut LatestWriter<Watched>, value: u64) {
    writer.buffer().set(value);
    writer.publish();
}

/// Updates once; news must be newer, no news the same.
fn look(reader: &mut LatestReader<Watched>, last: &mut u64) {
    let news = reader.update();
    let newest = reader.get().get();
    assert_eq!(newest > *last, news);
    assert!(newest >= *last);
    *last = newest;
}

#[test]
fn latest_is_whole_ordered_and_ends_with_the_newest() {
    loom::model(|| {
        let (mut writer, mut reader) = latest_with(Watched::new);
        let writing = thread::spawn(move || (1..=5).for_each(|value| fill(&mut writer, value)));
        let mut last = 0;
        (0..4).for_each(|_| look(&mut reader, &mut last));
        writing.join().unwrap();
        look(&mut reader, &mut last);
        assert_eq!(last, 5);
        assert!(!reader.update());
    });
}

#[test]
fn latest_hands_values_back_to_be_dropped_by_the_writer() {
    loom::model(|| {
        let (mut writer, mut reader) = latest_with(|| Box::new(0));
        let reading = thread::spawn(move || {
            reader.update();
            let seen = **reader.get();
            reader.update();
            assert!(**reader.get() >= seen);
            reader
        });
        (1..=3).for_each(|value| writer.write(Box::new(value)));
        let mut reader = reading.join().unwrap();
        reader.update();
        assert_eq!(**reader.get(), 3);
    });
}

/// What the consumer has seen: in order, none twice, and each sample either read or counted as lost.
#[derive(Default)]
struct Tally {
    last: u64,
    read: u64,
    lost: u64,
}

impl Tally {
    fn pop(&mut self, consumer: &mut RingConsumer<[u64; 2]>) -> bool {
        let popped = consumer.pop();
        self.lost += consumer.lost();
        if let Some([value, twin]) = popped {
            assert_eq!(twin, !value, "torn");
            self.read += 1;
            self.last = value;
            assert_eq!(self.read + self.lost, value, "in order, none twice, the gaps counted");
        }
        popped.is_some()
    }
}

fn push_all(producer: &mut RingProducer<[u64; 2]>, count: u64) -> u64 {
    (1..=count).map(|value| u64::from(producer.push([value, !value]))).sum()
}

#[allow(clippy::unwrap_used, reason = "a helper of tests")]
fn ring_model(capacity: usize, pushes: u64, pops: usize) {
    loom::model(move || {
        let (mut producer, mut consumer) = ring(capacity);
        let producing = thread::spawn(move || push_all(&mut producer, pushes));
        let mut tally = Tally::default();
        for _ in 0..pops {
            tally.pop(&mut consumer);
        }
        let overwrote = producing.join().unwrap();
        while tally.pop(&mut consumer) {}
        assert_eq!(tally.last, pushes, "the newest is never lost");
        assert_eq!(tally.read + tally.lost, pushes);
        assert_eq!(tally.lost, overwrote, "both sides count the same");
    });
}

#[test]
fn ring_of_one_overflows() {
    ring_model(1, 5, 4);
}

#[test]
fn ring_of_two_overflows() {
    ring_model(2, 6, 4);
}

#[test]
fn ring_of_three_does_not_overflow() {
    ring_model(3, 3, 4);
}

#[test]
fn a_raised_flag_publishes_what_came_before() {
    loom::model(|| {
        let flags = SharedFlags::new();
        let (mut writer, mut reader) = latest_with(Watched::new);
        let raising = flags.clone();
        let thread = thread::spawn(move || {
            fill(&mut writer, 1);
            raising.raise(1);
        });
        if flags.load() == 1 {
            assert!(reader.update());
        }
        thread.join().unwrap();
    });
}

impl Faultable for Watched {
    fn fault(&mut self) {}
}

// SAFETY: what the models are to prove.
unsafe impl Sync for Watched {}

#[allow(clippy::unwrap_used, reason = "a helper of tests")]
fn lane(generation: u32) -> Arc<Lane<Watched>> {
    let lane = Lane::vacant();
    lane.claim().unwrap().open(generation, Watched::new());
    Arc::new(lane)
}

/// Enters and counts itself, if it gets in.
fn count_in(lane: &Lane<Watched>, generation: u32) -> Result<(), Refused> {
    let mut inside = lane.enter(generation)?;
    let before = inside.get();
    inside.set(before + 1);
    Ok(())
}

#[test]
fn one_enters_at_a_time_and_closing_waits_for_them() {
    loom::model(|| {
        let lane = lane(1);
        let enter = || {
            let lane = Arc::clone(&lane);
            thread::spawn(move || count_in(&lane, 1).is_ok())
        };
        let others = [enter(), enter()];
        let in_it = lane.close(1).unwrap().take().unwrap().get();
        let entered = others.into_iter().filter_map(|other| other.join().unwrap().then_some(())).count();
        assert_eq!(in_it, entered as u64, "nobody comes in after it was closed, and no count is lost");
    });
}

#[test]
fn those_who_share_see_what_was_opened_until_it_is_closed() {
    // Over all orders: a model in which nobody ever got in would prove nothing.
    let seen = std::sync::Arc::new(std::sync::atomic::AtomicU32::new(0));
    let count = std::sync::Arc::clone(&seen);
    loom::model(move || {
        let lane = Arc::new(Lane::<Watched>::vacant());
        let theirs = Arc::clone(&lane);
        let count = std::sync::Arc::clone(&count);
        let sharing = thread::spawn(move || {
            for _ in 0..2 {
                if let Ok(inside) = theirs.share(1) {
                    assert_eq!(inside.get(), 7);
                    count.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
                }
            }
        });
        let mut value = Watched::new();
        value.set(7);
        lane.claim().unwrap().open(1, value);
        lane.close(1).unwrap().take().unwrap().set(8);
        sharing.join().unwrap();
        assert!(lane.share(1).is_err());
    });
    assert!(seen.load(std::sync::atomic::Ordering::Relaxed) > 0);
}

#[test]
fn a_stale_generation_never_meets_the_next() {
    loom::model(|| {
        let lane = lane(1);
        let theirs = Arc::clone(&lane);
        let stale = thread::spawn(move || (0..2).filter(|_| count_in(&theirs, 1).is_ok()).count());
        drop(lane.close(1).unwrap().take());
        lane.claim().unwrap().open(2, Watched::new());
        assert_eq!(count_in(&lane, 2), Ok(()));
        stale.join().unwrap();
        assert_eq!(lane.enter(2).unwrap().get(), 1);
    });
}

#[test]
fn of_two_who_close_one_does_and_of_two_who_claim_one_does() {
    loom::model(|| {
        let lane = lane(1);
        let theirs = Arc::clone(&lane);
        let close = |lane: &Lane<Watched>| lane.close(1).is_ok_and(|mut closed| closed.take().is_some());
        let other = thread::spawn(move || close(&theirs));
        let mine = close(&lane);
        assert_ne!(mine, other.join().unwrap());
        let theirs = Arc::clone(&lane);
        let claim = |lane: &Lane<Watched>, generation| {
            lane.claim().map(|claimed| claimed.open(generation, Watched::new())).is_some()
        };
        let other = thread::spawn(move || claim(&theirs, 2));
        let mine = claim(&lane, 3);
        assert_ne!(mine, other.join().unwrap());
        assert_eq!(count_in(&lane, if mine { 3 } else { 2 }), Ok(()));
    });
}

#[test]
fn what_is_opened_again_is_as_it_was() {
    loom::model(|| {
        let lane = lane(1);
        let theirs = Arc::clone(&lane);
        let entering = thread::spawn(move || count_in(&theirs, 1).is_ok());
        lane.close(1).unwrap().reopen();
        let entered = entering.join().unwrap();
        assert_eq!(lane.enter(1).unwrap().get(), u64::from(entered));
    });
}

#[test]
fn a_ceiling_ends_at_the_lowest() {
    loom::model(|| {
        let ceiling = Ceiling::new(4.0);
        let (a, b) = (ceiling.clone(), ceiling.clone());
        let first = thread::spawn(move || a.lower(2.0));
        let second = thread::spawn(move || b.lower(3.0));
        let seen = ceiling.get();
        assert!(ceiling.get() <= seen);
        first.join().unwrap();
        second.join().unwrap();
        assert_eq!(ceiling.get(), 2.0);
    });
}
