//! The hand-overs under two real threads at full speed: loom tries all orders of a few steps, this a few orders of
//! very many.
#![cfg(not(loom))]

use std::thread;

use hapflow_realtime::{SharedFlags, latest, ring};

const COUNT: u64 = 1_000_000;

/// As large as a real message, so that a torn copy would show.
type Sample = [u64; 16];

fn sample(value: u64) -> Sample {
    std::array::from_fn(|word| value.wrapping_mul(word as u64 + 1))
}

fn value(seen: &Sample) -> u64 {
    assert_eq!(*seen, sample(seen[0]), "torn");
    seen[0]
}

#[test]
fn latest_is_never_torn_and_ends_with_the_newest() {
    let (mut writer, mut reader) = latest(sample(0));
    let writing = thread::spawn(move || (1..=COUNT).for_each(|value| writer.write(sample(value))));
    let mut last = 0;
    while last < COUNT {
        let finished = writing.is_finished();
        let news = reader.update();
        let newest = value(reader.get());
        assert_eq!(newest > last, news, "news is newer, and nothing else is");
        last = newest;
        assert!(!finished || last == COUNT, "the writer is done, so the newest is the last");
    }
    writing.join().unwrap();
}

#[test]
fn ring_keeps_order_and_counts_what_it_lost() {
    for capacity in [1, 2, 7, 1000] {
        let (mut producer, mut consumer) = ring(capacity);
        let producing =
            thread::spawn(move || (1..=COUNT / 4).filter(|&value| producer.push(sample(value))).count());
        let (mut read, mut last, mut lost) = (0, 0, 0);
        while last < COUNT / 4 {
            let Some(seen) = consumer.pop() else { continue };
            lost += consumer.lost();
            read += 1;
            last = value(&seen);
            assert_eq!(read + lost, last, "each sample was read or is counted as lost");
        }
        assert_eq!(consumer.pop(), None);
        assert_eq!(consumer.lost(), 0);
        assert_eq!(producing.join().unwrap() as u64, lost, "both sides count the same");
    }
}

#[test]
fn flags_of_many_threads_do_not_undo_each_other() {
    let flags = SharedFlags::new();
    let toggle = |bit: u32| {
        let flags = flags.clone();
        thread::spawn(move || {
            for _ in 0..10_000 {
                assert_eq!(flags.raise(bit) & bit, 0);
                assert_eq!(flags.clear(bit) & bit, bit);
            }
            flags.raise(bit);
        })
    };
    [1, 2, 4, 8].map(toggle).into_iter().for_each(|thread| thread.join().unwrap());
    assert_eq!(flags.load(), 0b1111);
}
