//! Wait-free hand-overs, clocks and real-time threads of hapflow.
//!
//! What two threads pass each other goes through one of four things, none of which locks, waits or allocates
//! after it was built:
//!
//! | need | here | writer | reader |
//! |---|---|---|---|
//! | the newest value, older ones do not matter | [`latest()`] | wait-free | wait-free |
//! | every value in order, the oldest go on overflow | [`ring()`] | wait-free | lock-free |
//! | bits that any thread raises | [`SharedFlags`] | wait-free | wait-free |
//! | a limit that any thread lowers | [`Ceiling`] | lock-free | wait-free |
//!
//! What a handle of the C interface names lies in a [`Lane`], which lets one thread in at a time and finds stale handles.
//!
//! Time comes from a [`Clock`]: [`RealClock`] for a hand, [`HostClock`] for a
//! host's servo, [`VirtualClock`] for tests and replays. Threads that
//! must keep time come from [`spawn_realtime`], which goes on without the priority where the system refuses it,
//! and says why.
//!
//! Thread classes, as each item states them: *main* may block and allocate; *servo* may do neither; *any* may be
//! called by several threads at once.
//!
//! All atomics come from one private module, so that `RUSTFLAGS="--cfg loom" cargo test -p hapflow-realtime
//! --release --test loom` tries every interleaving of small models with
//! [loom](https://docs.rs/loom) in place of the real ones.

mod ceiling;
mod clock;
mod flags;
mod lane;
mod latest;
mod memory;
mod os;
mod priority;
mod ring;
mod status;
mod stop;
mod sync;
mod thread;

pub use ceiling::Ceiling;
pub use clock::{
    Clock, DEFAULT_SPIN_MARGIN, HostClock, RealClock, VirtualClock, process_cpu_s, thread_cpu_ns,
};
pub use flags::SharedFlags;
pub use lane::{Alone, Claimed, Faultable, Lane, Refused, Sharing};
pub use latest::{LatestReader, LatestWriter, latest, latest_with};
pub use memory::{lock_memory, unlock_memory};
pub use priority::{is_realtime, set_normal_priority, set_realtime_priority};
pub use ring::{MAX_RING_CAPACITY, RingConsumer, RingProducer, ring};
pub use status::{Grant, RealtimeStatus, Refusal};
pub use stop::{catch_stop, stop_asked};
pub use thread::{RealtimeThread, spawn_realtime};
