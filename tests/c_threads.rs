//! The C interface under several threads, and panics inside it.
// A test's helpers fail as the test does.
#![allow(clippy::unwrap_used, clippy::panic)]

mod c_support;

use c_support::{Api, DRIVE_OWNED, PLATE, SECOND, Session, SessionConfig, ToolState, Variant, Wrench, code};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::thread;
use std::time::{Duration, Instant};

#[test]
fn two_threads_in_one_tick_are_found_and_refused() {
    let api = Api::ready(Variant::Shipped);
    let session = api.jet();
    api.run(session, 0, 100);
    let (busy, done) = (AtomicU64::new(0), AtomicU64::new(0));
    let patience = Instant::now() + Duration::from_secs(20);
    let state = api.state(100);
    thread::scope(|scope| {
        for _ in 0..3 {
            scope.spawn(|| {
                while busy.load(Ordering::Relaxed) < 20 && Instant::now() < patience {
                    match api.tick(session, &state) {
                        (code::BUSY, wrench) => {
                            assert_eq!(wrench, Wrench::ZERO);
                            busy.fetch_add(1, Ordering::Relaxed);
                        }
                        (result, _) => {
                            assert_eq!(result, code::OK);
                            done.fetch_add(1, Ordering::Relaxed);
                        }
                    }
                }
            });
        }
    });
    assert!(busy.load(Ordering::Relaxed) >= 20);
    assert_eq!(api.report(session).tick, 100 + done.load(Ordering::Relaxed));
}

#[test]
fn every_tool_is_ticked_by_a_thread_of_its_own() {
    let api = Api::ready(Variant::Shipped);
    let session = api.try_create(&format!("{}{SECOND}", c_support::JET)).unwrap();
    thread::scope(|scope| {
        for tool in 0..2 {
            scope.spawn(move || {
                for n in 0..20_000 {
                    let state = ToolState { tool, ..api.state(n) };
                    assert!(api.tick(session, &state).0 >= 0, "tool {tool}, tick {n}");
                }
            });
        }
    });
    assert_eq!([0, 1].map(|tool| api.report_of(session, tool).tick), [20_000; 2]);
}

#[test]
fn obstacles_are_moved_by_one_thread_beside_all_others() {
    let api = Api::ready(Variant::Shipped);
    let session = api.try_create(&format!("{}{PLATE}", c_support::JET)).unwrap();
    let move_it = |n: u64| {
        let place = [1e-6 * (n % 1000) as f64, 0.028, 0.0];
        match (api.obstacle_move)(session, 0, &place, &[0.0, 0.0, 0.0, 1.0]) {
            code::OK => (api.obstacle_publish)(session),
            refused => refused,
        }
    };
    thread::scope(|scope| {
        scope.spawn(|| (0..20_000).for_each(|n| assert_eq!(move_it(n), code::OK)));
        api.run(session, 0, 1000);
    });
    // Two at once are found.
    let (busy, patience) = (AtomicBool::new(false), Instant::now() + Duration::from_secs(20));
    thread::scope(|scope| {
        for _ in 0..2 {
            scope.spawn(|| {
                while !busy.load(Ordering::Relaxed) && Instant::now() < patience {
                    busy.fetch_or((0..1000).any(|n| move_it(n) == code::BUSY), Ordering::Relaxed);
                }
            });
        }
    });
    assert!(busy.load(Ordering::Relaxed));
    assert_eq!((api.session_destroy)(session), code::OK);
    assert_eq!(move_it(0), code::HANDLE);
}

/// Servo, fluid and main of one session, each until its handle is stale; what each did.
fn use_until_destroyed(api: &Api, session: Session, did: &[AtomicU64; 3]) {
    let until_stale = |which: usize, call: &(dyn Fn(u64) -> i32 + Sync)| {
        for n in 0.. {
            match call(n) {
                code::HANDLE => break,
                result => assert!(result >= 0, "{result}"),
            }
            did[which].fetch_add(1, Ordering::Relaxed);
        }
    };
    thread::scope(|scope| {
        scope.spawn(|| until_stale(0, &|n| api.tick(session, &api.state(n)).0));
        scope.spawn(|| until_stale(1, &|n| (api.fluid_step)(session, (n + 1) as f64 * 0.01)));
        scope.spawn(|| until_stale(2, &|n| api.set(session, "fluid.viscosity", 0.001 * (n % 7) as f64)));
        scope.spawn(|| {
            while did.iter().any(|d| d.load(Ordering::Relaxed) < 3) {
                thread::yield_now();
            }
            assert_eq!((api.session_destroy)(session), code::OK);
        });
    });
}

#[test]
fn destroying_waits_out_what_runs_and_later_calls_are_refused() {
    let api = Api::ready(Variant::Shipped);
    let cpu = c_support::JET.replace("backend = \"analytic-jet\"", "") + "\n[fluid]\nspacing = 0.01\n";
    for n in 0..20 {
        let scene = if n < 4 { &cpu } else { c_support::JET };
        let session = api.try_create(scene).unwrap();
        use_until_destroyed(&api, session, &Default::default());
        assert_eq!(api.tick(session, &api.state(0)), (code::HANDLE, Wrench::ZERO));
    }
}

#[test]
fn of_several_who_destroy_one_succeeds() {
    let api = Api::ready(Variant::Shipped);
    for _ in 0..20 {
        let session = api.jet();
        let ended = AtomicU64::new(0);
        thread::scope(|scope| {
            for _ in 0..4 {
                scope.spawn(|| match (api.session_destroy)(session) {
                    code::OK => drop(ended.fetch_add(1, Ordering::Relaxed)),
                    result => assert_eq!(result, code::HANDLE),
                });
            }
        });
        assert_eq!(ended.load(Ordering::Relaxed), 1);
    }
}

#[test]
fn anybody_may_stop_at_any_time() {
    let api = Api::ready(Variant::Shipped);
    let session = api.jet();
    api.run(session, 0, 100);
    let over = AtomicBool::new(false);
    thread::scope(|scope| {
        let stoppers: Vec<_> = (0..3)
            .map(|_| {
                scope.spawn(|| (0..2000).for_each(|_| assert_eq!((api.session_emergency_stop)(session), 0)))
            })
            .collect();
        let ticker = scope.spawn(|| {
            let mut held = 0;
            while !over.load(Ordering::Relaxed) {
                held += u64::from(api.tick(session, &api.state(100)).0 == code::FORCE_HELD);
            }
            held
        });
        stoppers.into_iter().for_each(|s| s.join().unwrap());
        while api.report(session).faults & 1 << 5 == 0 {
            thread::yield_now();
        }
        over.store(true, Ordering::Relaxed);
        let _ = ticker.join().unwrap();
    });
    assert_eq!(api.tick(session, &api.state(100)), (code::FORCE_HELD, Wrench::ZERO));
}

#[test]
fn sessions_of_several_threads_give_the_same() {
    let api = Api::ready(Variant::Shipped);
    let alone = api.run(api.jet(), 0, 120);
    thread::scope(|scope| {
        for _ in 0..4 {
            scope.spawn(|| {
                let session = api.jet();
                assert_eq!(api.run(session, 0, 120), alone);
                assert_eq!((api.session_destroy)(session), code::OK);
            });
        }
    });
}

/// A session that steps its fluid itself.
fn owned(api: &Api, scene: &str) -> Session {
    api.try_create_with(scene, SessionConfig { fluid_drive: DRIVE_OWNED, ..api.config() }).unwrap()
}

/// Ticks at the clock's own pace, until `done`; gives the number of the next tick.
fn tick_until(api: &Api, session: Session, from: u64, done: impl Fn() -> bool) -> u64 {
    let patience = Instant::now() + Duration::from_secs(20);
    for n in from.. {
        if done() {
            return n;
        }
        assert!(Instant::now() < patience, "it never came");
        assert!(api.tick(session, &api.state(n)).0 >= 0);
        thread::sleep(Duration::from_millis(1));
    }
    from
}

#[test]
fn a_session_steps_its_own_fluid_in_the_time_of_the_ticks() {
    let api = Api::ready(Variant::Shipped);
    let session = owned(&api, c_support::JET);
    let force = || api.report(session).force[1];
    let n = tick_until(&api, session, 0, || force() < -0.1);
    for call in [
        (api.fluid_advance)(session, 1.0),
        (api.fluid_step)(session, 1.0),
        (api.fluid_particles)(session, std::ptr::null_mut(), 0, &mut 0),
    ] {
        assert_eq!(call, code::DRIVE);
    }
    // Without ticks it stands still.
    thread::sleep(Duration::from_millis(50));
    let frame = api.report(session).fluid_frame;
    thread::sleep(Duration::from_millis(100));
    assert_eq!(api.report(session).fluid_frame, frame);
    tick_until(&api, session, n, || api.report(session).fluid_frame > frame);
    assert_eq!(api.set(session, "source.tap.speed", 0.5), code::OK);
    assert_eq!((api.session_destroy)(session), code::OK);
    assert_eq!(api.tick(session, &api.state(n)), (code::HANDLE, Wrench::ZERO));
}

#[test]
fn an_owned_fluid_shows_its_particles_and_ends_in_the_middle_of_a_frame() {
    let api = Api::ready(Variant::Shipped);
    let cpu = c_support::JET.replace("backend = \"analytic-jet\"", "") + "\n[fluid]\nspacing = 0.01\n";
    let session = owned(&api, &cpu);
    let count = || {
        let mut count = 0;
        assert!((api.session_particles)(session, std::ptr::null_mut(), 0, &mut count) >= 0);
        count
    };
    tick_until(&api, session, 0, || count() > 10);
    let mut positions = vec![9.0_f32; 3 * count()];
    let mut told = 0;
    let room = positions.len() / 3;
    let result = (api.session_particles)(session, positions.as_mut_ptr(), room, &mut told);
    assert_eq!((result, told), (code::OK, room));
    assert!(positions.iter().all(|x| x.abs() < 0.15));
    for _ in 0..20 {
        let session = owned(&api, &cpu);
        assert_eq!(api.tick(session, &api.state(50)).0, code::OK);
        assert_eq!((api.session_destroy)(session), code::OK);
    }
}

/// A session with force, and the hook that makes the next call panic.
fn about_to_panic() -> (Api, Session, extern "C" fn()) {
    let api = Api::ready(Variant::Hooks);
    let session = api.jet();
    assert!(api.run(session, 0, 100).last().unwrap().force[1] < -0.1);
    (api, session, api.test_panic_next_call.unwrap())
}

/// Both bits of a fault mask are up.
fn faulted(api: &Api, session: Session, bits: u32) -> bool {
    api.report(session).faults & bits == bits
}

const PANIC: u32 = 1 << 2;
const FLUID: u32 = 1 << 7;

#[test]
fn a_panic_in_a_tick_is_a_code_without_force_and_faults_the_session() {
    let (api, session, panic_next) = about_to_panic();
    panic_next();
    assert_eq!(api.tick(session, &api.state(100)), (code::PANIC, Wrench::ZERO));
    assert!(faulted(&api, session, PANIC));
    assert_eq!(api.tick(session, &api.state(101)), (code::FORCE_HELD, Wrench::ZERO));
    assert_eq!((api.session_clear_faults)(session), code::OK);
    assert!(api.run(session, 102, 150).last().unwrap().force[1] < -0.1);
    assert_eq!((api.session_destroy)(session), code::OK);
}

#[test]
fn a_panic_of_the_fluid_ends_it_and_the_force() {
    let (api, session, panic_next) = about_to_panic();
    panic_next();
    assert_eq!((api.fluid_advance)(session, 0.2), code::PANIC);
    assert!(faulted(&api, session, PANIC | FLUID));
    assert_eq!(api.tick(session, &api.state(100)), (code::FORCE_HELD, Wrench::ZERO));
    assert_eq!((api.fluid_advance)(session, 0.2), code::FAULTED);
    assert_eq!((api.fluid_step)(session, 0.2), code::FAULTED);
    assert_eq!((api.session_destroy)(session), code::OK);
}

#[test]
fn a_panic_among_the_obstacles_ends_the_force() {
    let (api, session, panic_next) = about_to_panic();
    panic_next();
    assert_eq!((api.obstacle_publish)(session), code::PANIC);
    assert!(faulted(&api, session, PANIC));
    assert_eq!(api.tick(session, &api.state(100)), (code::FORCE_HELD, Wrench::ZERO));
    assert_eq!((api.obstacle_publish)(session), code::OK);
}

#[test]
fn a_panic_on_main_is_told_and_the_force_ends() {
    let (api, session, panic_next) = about_to_panic();
    panic_next();
    assert_eq!(api.set(session, "fluid.viscosity", 0.1), code::PANIC);
    assert!(api.error().contains("panic"));
    assert_eq!(api.tick(session, &api.state(100)), (code::FORCE_HELD, Wrench::ZERO));
    panic_next();
    assert_eq!(api.try_create(c_support::JET), Err(code::PANIC));
    assert_eq!(api.set(session, "fluid.viscosity", 0.1), code::OK);
}
