//! What a servo tick through the C interface costs over the same tick in Rust, side by side in one run:
//!
//! ```sh
//! cargo bench -p hapflow --bench c_tick
//! ```
//!
//! Two sessions of the same jet, one by libhapflow and one by the engine, are ticked in turns, ten ticks between two
//! fluid frames, with the same states. Told are the median of all turns, and the difference, whose goal is 100 ns.
// A benchmark's helpers fail as it does.
#![allow(clippy::unwrap_used, clippy::panic)]

#[path = "../tests/c_support/mod.rs"]
mod c_support;

use c_support::{Api, JET, ToolState, Variant, Wrench, code};
use hapflow::engine::{FluidUnit, ServoUnit, Session, SessionOptions, parse};
use hapflow::haptics;
use std::hint::black_box;
use std::time::Instant;

/// Ticks in a turn: those between two fluid frames.
const TICKS: u64 = 10;
/// Turns that are told, after as many tenths that warm up.
const TURNS: u64 = 20_000;
/// Largest difference that was aimed at, ns a tick.
const GOAL_NS: f64 = 100.0;

/// One of the two ways.
trait Side {
    /// Steps the fluid frame that ends at `time_s`.
    fn frame(&mut self, time_s: f64);
    /// One tick at rest; gives the force down.
    fn tick(&mut self, time_s: f64) -> f64;
}

/// Through the C interface.
struct Foreign {
    api: Api,
    session: c_support::Session,
    state: ToolState,
}

impl Side for Foreign {
    fn frame(&mut self, time_s: f64) {
        assert_eq!((self.api.fluid_step)(self.session, time_s), code::OK);
    }
    fn tick(&mut self, time_s: f64) -> f64 {
        self.state.time_s = time_s;
        let mut wrench = Wrench::UNTOUCHED;
        assert!((self.api.servo_tick)(self.session, &self.state, &mut wrench) >= 0);
        wrench.force[1]
    }
}

/// In Rust.
struct Own {
    servo: ServoUnit,
    fluid: FluidUnit,
    state: haptics::ToolState,
}

impl Side for Own {
    fn frame(&mut self, time_s: f64) {
        self.fluid.publish(time_s);
        self.fluid.compute(time_s);
    }
    fn tick(&mut self, time_s: f64) -> f64 {
        self.servo.tick(black_box(&self.state), time_s, 1e-3).force().y
    }
}

/// A turn of ticks after frame `n`: ns each, and the last force.
fn turn(side: &mut impl Side, n: u64) -> (f64, f64) {
    side.frame(n as f64 * 1e-2);
    let mut force = 0.0;
    let begin = Instant::now();
    for tick in 0..TICKS {
        force = black_box(side.tick((n * TICKS + tick) as f64 * 1e-3));
    }
    (begin.elapsed().as_nanos() as f64 / TICKS as f64, force)
}

fn quantile(sorted: &[f64], share: f64) -> f64 {
    sorted[((sorted.len() - 1) as f64 * share) as usize]
}

fn main() {
    let api = Api::ready(Variant::Shipped);
    let mut foreign = Foreign { api, session: api.jet(), state: api.state(0) };
    let scene = parse(JET, "jet").unwrap();
    let mut session =
        Session::open(&scene, SessionOptions { threads: 1, ..SessionOptions::hosted() }).unwrap();
    let (servo, fluid) = (session.take_servo().unwrap(), session.take_fluid().unwrap());
    let mut own = Own { servo, fluid, state: haptics::ToolState::default() };
    let (mut c, mut rust) = (Vec::new(), Vec::new());
    for n in 1..=TURNS + TURNS / 10 {
        // Each goes first as often as second.
        let (c_turn, rust_turn) = if n % 2 == 0 {
            let first = turn(&mut foreign, n);
            (first, turn(&mut own, n))
        } else {
            let first = turn(&mut own, n);
            (turn(&mut foreign, n), first)
        };
        assert_eq!(c_turn.1, rust_turn.1, "the same force");
        if n > TURNS / 10 {
            c.push(c_turn.0);
            rust.push(rust_turn.0);
        }
    }
    c.sort_by(f64::total_cmp);
    rust.sort_by(f64::total_cmp);
    println!("{:>9} {:>12} {:>12} {:>12} {:>7}", "", "in Rust, ns", "from C, ns", "difference", "ratio");
    for (name, share) in [("10 %", 0.1), ("median", 0.5), ("90 %", 0.9)] {
        let (c, rust) = (quantile(&c, share), quantile(&rust, share));
        println!("{name:>9} {rust:>12.1} {c:>12.1} {:>12.1} {:>7.2}", c - rust, c / rust);
    }
    let difference = quantile(&c, 0.5) - quantile(&rust, 0.5);
    let verdict = if difference <= GOAL_NS { "met" } else { "missed" };
    println!("goal: at most {GOAL_NS} ns a tick: {verdict}");
}
