//! The servo path neither allocates nor frees, over 10⁵ ticks with every filter, new models, faults and changes.
#![allow(clippy::unwrap_used, clippy::panic)]

mod c_support;
mod common;

use c_support::{compile, root, scratch};
use common::{jet, open, word};
use glam::DVec3;
use hapflow::engine::Value;
use hapflow::haptics::{GatedWrench, ToolState};
use hapflow_host::Extensions;
use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;
use std::ffi::OsStr;

thread_local! {
    static WATCHED: Cell<bool> = const { Cell::new(false) };
    static SEEN: Cell<usize> = const { Cell::new(0) };
}

/// Counts what a watched thread allocates and frees.
struct Counting;

fn count() {
    if WATCHED.with(Cell::get) {
        SEEN.with(|seen| seen.set(seen.get() + 1));
    }
}

// SAFETY: everything is handed on to the system's allocator as it came.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        count();
        // SAFETY: the caller's contract is the same.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        count();
        // SAFETY: the caller's contract is the same.
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

fn watched<R>(work: impl FnOnce() -> R) -> (R, usize) {
    SEEN.with(|seen| seen.set(0));
    WATCHED.with(|w| w.set(true));
    let result = work();
    WATCHED.with(|w| w.set(false));
    (result, SEEN.with(Cell::get))
}

#[test]
fn the_counter_counts() {
    let (_, seen) = watched(|| std::hint::black_box(vec![1_u8; 16]));
    assert!(seen > 0);
}

#[test]
fn a_hundred_thousand_ticks_allocate_nothing() {
    let filters =
        ["none", "bartlett-hann:11@fluid", "hann:33@servo", "butterworth:50:4@servo", "one-euro:5:0.5@servo"];
    for filter in filters {
        for coupling in ["local", "direct", "momentum"] {
            let mut scene = jet(&[
                ("run.backend", word("analytic-jet")),
                ("run.filter", word(filter)),
                ("run.coupling", word(coupling)),
                ("mapping.rim_radius", Value::Number(0.05)),
                ("tool.solid_stiffness", Value::Number(500.0)),
            ]);
            // Under the tool, so that it is touched.
            scene.ground = Some(-0.012);
            let seen = ticks(&scene, 100_000 / (filters.len() * 2));
            assert_eq!(seen, 0, "{filter}, {coupling}");
        }
    }
}

fn ticks(scene: &hapflow::engine::Scene, n: usize) -> usize {
    let mut session = open(scene, 1);
    let (mut servo, mut fluid) = (session.take_servo().unwrap(), session.take_fluid().unwrap());
    let control = session.control();
    let mut allocations = 0;
    for k in 0..n {
        let t = k as f64 * 1e-3;
        if k % 10 == 0 {
            fluid.publish(t);
            fluid.compute(t);
        }
        if k % 997 == 0 {
            let force = Value::Number(1.0 + (k % 3) as f64);
            session.set("gate.max_force", &force).unwrap();
        }
        match k % 2000 {
            1500 => control.emergency_stop(),
            1600 => control.clear_faults(),
            _ => {}
        }
        let mut state = ToolState::at(DVec3::new(0.03 * (3.0 * t).sin(), 0.0, 0.0));
        if k % 3001 == 3000 {
            state.position.x = f64::NAN;
        }
        let (wrench, seen) = watched(|| servo.tick(&state, t, 1e-3));
        assert!(wrench.force().is_finite());
        allocations += seen;
    }
    allocations
}

#[test]
fn a_plugins_device_is_read_and_written_without_allocating() {
    let (source, made) =
        (root().join("examples/plugins/bobbing_device.cpp"), scratch().join("libno_alloc_device.so"));
    let words = ["-shared", "-fPIC", "-o"].map(OsStr::new);
    compile("c++", "c++17", &[&words[..], &[made.as_os_str(), source.as_os_str()]].concat()).unwrap();
    let mut device = Extensions::load(&made).unwrap().device.unwrap().open(DVec3::ZERO).unwrap();
    let (lost, seen) = watched(|| {
        let ticks = (0..10_000).map(|n| device.read(f64::from(n) * 1e-3).is_err());
        let lost = ticks.filter(|lost| *lost).count();
        device.write(GatedWrench::ZERO, 1e-3).unwrap();
        // A state that cannot be is an error, which costs nothing either.
        lost + usize::from(device.read(f64::NAN).is_ok())
    });
    assert_eq!((lost, seen), (0, 0));
}
