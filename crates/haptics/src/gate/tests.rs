//! What the gate lets through, and what it never does.

use super::*;

const DT: f64 = 0.001;
const FRESH: ModelAge = ModelAge::FRESH;
/// 60 Hz: stale after 50 ms.
const FRAME: f64 = 1.0 / 60.0;

fn gate(change: impl FnOnce(&mut GateSettings)) -> SafetyGate {
    let mut settings = GateSettings::default();
    change(&mut settings);
    SafetyGate::new(settings).unwrap()
}

/// A gate without ramp and with the fastest slew.
fn open() -> SafetyGate {
    gate(|s| {
        s.ramp_in_s = 0.0;
        s.max_slew_n_per_s = 1e6;
        s.max_torque_slew_nm_per_s = 1e5;
    })
}

fn along_x(x: f64) -> Wrench {
    Wrench::from_force(DVec3::X * x)
}

/// Wants `x` N for some ticks, and gives the last force, N.
fn run(gate: &mut SafetyGate, ticks: usize, x: f64, age: &ModelAge) -> f64 {
    (0..ticks).fold(0.0, |_, _| gate.pass(along_x(x), age, FaultSet::NONE, DT).force().x)
}

fn aged(age_s: f64) -> ModelAge {
    ModelAge { age_s, frame_s: FRAME }
}

#[test]
fn what_is_within_every_limit_passes_unchanged() {
    let wanted = Wrench { force: DVec3::new(1.0, -2.0, 0.5), torque: DVec3::new(0.01, 0.0, -0.02) };
    let mut gate = open();
    assert_eq!(gate.pass(wanted, &FRESH, FaultSet::NONE, DT).wrench(), wanted);
    assert_eq!(gate.faults(), FaultSet::NONE);
}

#[test]
fn sizes_are_cut_apart_and_directions_stay() {
    let wanted = Wrench { force: DVec3::new(30.0, 0.0, -40.0), torque: DVec3::new(0.0, 0.05, 0.0) };
    let mut gate = open();
    let sent = gate.pass(wanted, &FRESH, FaultSet::NONE, DT);
    assert!((sent.force() - DVec3::new(2.4, 0.0, -3.2)).length() < 1e-12);
    assert_eq!(sent.torque(), wanted.torque);
    assert_eq!(gate.faults(), FaultSet::FORCE_LIMITED);
    assert!(gate.latched().is_empty());
}

#[test]
fn the_force_ramps_in_from_zero() {
    let mut gate = gate(|_| {});
    for tick in 1..=600 {
        let sent = gate.pass(along_x(2.0), &FRESH, FaultSet::NONE, DT).force().x;
        let expected = 2.0 * (f64::from(tick) * DT / 0.5).min(1.0);
        assert!((sent - expected).abs() < 1e-9, "tick {tick}: {sent}");
    }
}

#[test]
fn a_force_above_the_limit_ramps_in_no_faster() {
    let mut gate = gate(|_| {});
    let half = run(&mut gate, 250, 1e300, &FRESH);
    assert!((half - 2.0).abs() < 1e-9, "{half}");
}

#[test]
fn a_jump_is_spread_over_the_slew() {
    let mut gate = gate(|s| s.ramp_in_s = 0.0);
    for tick in 1..=6 {
        let sent = gate.pass(along_x(3.5), &FRESH, FaultSet::NONE, DT).force().x;
        assert!((sent - f64::from(tick).min(3.5)).abs() < 1e-9, "tick {tick}: {sent}");
        assert_eq!(gate.faults().contains(FaultSet::SLEW_LIMITED), tick < 4);
    }
}

#[test]
fn old_data_is_held_then_faded_then_nothing() {
    let mut gate = open();
    gate.pass(along_x(2.0), &aged(0.0), FaultSet::NONE, DT);
    assert_eq!(gate.pass(along_x(2.0), &aged(0.0499), FaultSet::NONE, DT).force().x, 2.0);
    assert!(gate.faults().is_empty());
    for tick in 1..=200 {
        let age = aged(0.051 + f64::from(tick) * DT);
        let sent = gate.pass(along_x(2.0), &age, FaultSet::NONE, DT).force().x;
        let expected = 2.0 * (1.0 - f64::from(tick) * DT / 0.1).max(0.0);
        assert!((sent - expected).abs() < 1e-9, "tick {tick}: {sent}");
        assert_eq!(gate.faults(), FaultSet::STALE);
    }
    assert!(gate.latched().is_empty());
}

#[test]
fn data_that_comes_back_ramps_in_without_a_jump() {
    let mut gate = gate(|_| {});
    run(&mut gate, 500, 2.0, &aged(0.0));
    run(&mut gate, 50, 2.0, &aged(1.0));
    assert!((gate.gain() - 0.5).abs() < 1e-9);
    let mut before = 1.0;
    for _ in 0..300 {
        let sent = gate.pass(along_x(2.0), &aged(0.0), FaultSet::NONE, DT).force().x;
        assert!(sent >= before && sent - before < 0.0041, "{before} to {sent}");
        before = sent;
    }
    assert!((before - 2.0).abs() < 1e-9);
}

#[test]
fn ages_that_make_no_sense_are_stale() {
    for age in [ModelAge::MISSING, aged(f64::NAN), aged(f64::INFINITY)] {
        let mut gate = open();
        assert_eq!(gate.pass(along_x(1.0), &age, FaultSet::NONE, DT), GatedWrench::ZERO);
        assert_eq!(gate.faults(), FaultSet::STALE);
    }
    let odd = ModelAge { age_s: 1e-3, frame_s: f64::NAN };
    assert!(odd.is_stale(3.0) && !aged(-1.0).is_stale(3.0) && !FRESH.is_stale(3.0));
}

#[test]
fn a_fault_means_zero_at_once_until_it_is_cleared() {
    let faults =
        [FaultSet::PANIC, FaultSet::DEVICE_LOST, FaultSet::EMERGENCY_STOP, FaultSet::NON_FINITE_INPUT];
    for fault in faults {
        let mut gate = gate(|s| s.ramp_in_s = 0.0);
        run(&mut gate, 9, 4.0, &FRESH);
        assert_eq!(gate.pass(along_x(4.0), &FRESH, fault, DT), GatedWrench::ZERO);
        for _ in 0..99 {
            assert_eq!(gate.pass(along_x(4.0), &FRESH, FaultSet::NONE, DT), GatedWrench::ZERO);
        }
        assert_eq!(gate.latched(), fault);
        assert_eq!(gate.gain(), 0.0);
        gate.clear_faults(FaultSet::NONE);
        assert!(gate.pass(along_x(4.0), &FRESH, FaultSet::NONE, DT).force().x > 0.5);
    }
}

#[test]
fn after_clearing_the_force_ramps_in_again() {
    let mut gate = gate(|_| {});
    run(&mut gate, 600, 4.0, &FRESH);
    gate.pass(along_x(f64::NAN), &FRESH, FaultSet::NONE, DT);
    assert_eq!(gate.latched(), FaultSet::NON_FINITE_FORCE);
    gate.clear_faults(FaultSet::NONE);
    let sent = gate.pass(along_x(4.0), &FRESH, FaultSet::NONE, DT).force().x;
    assert!((sent - 0.008).abs() < 1e-9, "{sent}");
}

#[test]
fn a_cause_that_stays_latches_again() {
    let mut gate = open();
    gate.pass(along_x(1.0), &FRESH, FaultSet::FLUID_FAULT, DT);
    gate.clear_faults(FaultSet::NONE);
    assert_eq!(gate.pass(along_x(1.0), &FRESH, FaultSet::FLUID_FAULT, DT), GatedWrench::ZERO);
    assert_eq!(gate.latched(), FaultSet::FLUID_FAULT);
}

#[test]
fn remarks_let_the_force_through() {
    let mut gate = open();
    let remarks = FaultSet::PATH_OVERFLOW | FaultSet::LATE_TICK;
    assert_eq!(gate.pass(along_x(1.0), &FRESH, remarks, DT).force().x, 1.0);
    assert_eq!(gate.faults(), remarks);
    gate.pass(along_x(1.0), &FRESH, FaultSet::NONE, DT);
    assert!(gate.faults().is_empty());
}

#[test]
fn a_tick_without_length_keeps_the_force() {
    let mut gate = open();
    gate.pass(along_x(1.0), &FRESH, FaultSet::NONE, DT);
    for dt in [0.0, -1.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        assert_eq!(gate.pass(along_x(3.0), &FRESH, FaultSet::NONE, dt).force().x, 1.0);
        assert!(gate.latched().is_empty());
    }
    assert_eq!(gate.pass(along_x(3.0), &FRESH, FaultSet::PANIC, f64::NAN), GatedWrench::ZERO);
}

#[test]
fn a_long_tick_counts_as_10_ms() {
    let mut gate = gate(|_| {});
    let sent = gate.pass(along_x(2.0), &FRESH, FaultSet::NONE, 5.0).force().x;
    assert!((sent - 2.0 * MAX_TICK_S / 0.5).abs() < 1e-12, "{sent}");
}

#[test]
fn limits_can_be_lowered_while_it_runs() {
    let mut gate = open();
    gate.pass(along_x(4.0), &FRESH, FaultSet::NONE, DT);
    let lower = GateSettings { max_force_n: 1.0, max_slew_n_per_s: 1.0, ..*gate.settings() };
    gate.set_settings(lower).unwrap();
    assert!(gate.pass(along_x(4.0), &FRESH, FaultSet::NONE, DT).force().x <= 1.0);
    let bad = GateSettings { max_force_n: f64::NAN, ..lower };
    assert_eq!(gate.set_settings(bad).unwrap_err().field, "max_force_n");
    assert_eq!(gate.settings(), &lower);
    gate.set_settings(GateSettings { max_force_n: 0.0, ..lower }).unwrap();
    assert_eq!(gate.pass(along_x(4.0), &FRESH, FaultSet::NONE, DT), GatedWrench::ZERO);
}

#[test]
fn shortening_keeps_the_direction_at_any_size() {
    for size in [5e-324, 1e-310, 1e-200, 1.0, 1e200, 1e300, f64::MAX] {
        let short = shorten(DVec3::new(size, -size, 0.0), 5e-324_f64.max(size / 1e3).min(1.0));
        assert!(short.is_finite() && short.z == 0.0 && short.x == -short.y, "{size}: {short}");
    }
    assert_eq!(shorten(DVec3::X, 0.0), DVec3::ZERO);
}

/// xorshift64*: enough for a test, and the same everywhere.
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        self.0.wrapping_mul(0x2545_F491_4F6C_DD1D)
    }

    fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// One time in `odds` something that breaks careless code, else −10 to 10.
    fn number(&mut self, odds: u64, nasty: &[f64]) -> f64 {
        match self.next() % odds {
            0 => nasty[self.next() as usize % nasty.len()],
            _ => 20.0 * self.unit() - 10.0,
        }
    }

    fn wrench(&mut self, odds: u64, nasty: &[f64]) -> Wrench {
        let mut vector = || DVec3::from_array(std::array::from_fn(|_| self.number(odds, nasty)));
        Wrench { force: vector(), torque: vector() }
    }
}

const FINITE: [f64; 8] = [1e300, -1e300, f64::MAX, f64::MIN, 5e-324, -1e-310, 0.0, -0.0];
const NASTY: [f64; 6] = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e300, 5e-324, -0.0];

fn random_settings(random: &mut Random) -> GateSettings {
    GateSettings {
        max_force_n: 50.0 * random.unit(),
        max_torque_nm: 5.0 * random.unit(),
        max_slew_n_per_s: 1.0 + 5000.0 * random.unit(),
        max_torque_slew_nm_per_s: 0.01 + 100.0 * random.unit(),
        ramp_in_s: 0.05 * random.unit(),
        stale_hold_frames: 1.0 + 3.0 * random.unit(),
        stale_fade_s: 0.05 * random.unit(),
    }
}

/// Runs one gate for a while and checks what must hold for every tick.
fn check_run(seed: u64, nasty: &[f64]) -> usize {
    let mut random = Random(seed);
    let settings = random_settings(&mut random);
    let mut gate = SafetyGate::new(settings).unwrap();
    let (mut before, mut felt) = (GatedWrench::ZERO, 0);
    for tick in 0..2000 {
        let wanted = random.wrench(50, nasty);
        let age = aged(0.1 * random.unit());
        let fault = FaultSet::from_bits(1 << (random.next() % 32)).when(random.next().is_multiple_of(500));
        let dt = random.number(20, &NASTY).abs() * 1e-4;
        let sent = gate.pass(wanted, &age, fault, dt);
        let allowed = if dt.is_finite() { dt.clamp(0.0, MAX_TICK_S) } else { 0.0 };
        let change = sent.wrench() - before.wrench();
        assert!(sent.wrench().is_finite(), "seed {seed} tick {tick}: {wanted:?} gave {sent:?}");
        assert!(sent.force().length() <= settings.max_force_n, "seed {seed} tick {tick}");
        assert!(sent.torque().length() <= settings.max_torque_nm, "seed {seed} tick {tick}");
        if gate.latched().is_empty() {
            let slack = 1e-13;
            assert!(change.force.length() <= settings.max_slew_n_per_s * allowed + slack);
            assert!(change.torque.length() <= settings.max_torque_slew_nm_per_s * allowed + slack);
        } else {
            assert_eq!(sent, GatedWrench::ZERO);
            if random.next().is_multiple_of(20) {
                gate.clear_faults(FaultSet::NONE);
            }
        }
        felt += usize::from(sent != GatedWrench::ZERO);
        before = sent;
    }
    felt
}

#[test]
fn whatever_comes_in_what_goes_out_is_safe() {
    let felt: usize = (1..=60).map(|seed| check_run(seed, &NASTY) + check_run(seed, &FINITE)).sum();
    assert!(felt > 60_000, "the runs were nearly all faults: {felt}");
}

#[test]
fn a_release_is_at_once_and_what_comes_next_rises_from_zero() {
    let mut gate = gate(|s| s.ramp_in_s = 0.0);
    assert!(run(&mut gate, 100, 3.0, &FRESH) > 2.99);
    assert_eq!(gate.release(), GatedWrench::ZERO);
    let next = run(&mut gate, 1, 3.0, &FRESH);
    assert!((next - 1.0).abs() < 1e-9, "{next}: 1000 N/s for 1 ms");
    assert!(gate.latched().is_empty());
}

/// `now` is a vector within `change` of `before`, shortened or not: a limit may shrink a force at once, and no more.
fn follows(before: DVec3, now: DVec3, change: f64) -> bool {
    // The point nearest to `before` on the ray from `now` outwards.
    let along = now.normalize_or_zero();
    let nearest = along * before.dot(along).max(now.length());
    nearest.distance(before) <= change + 1e-12
}

#[test]
fn a_lowered_limit_shrinks_the_force_at_once_and_makes_no_other_jump() {
    for seed in 1..=40 {
        let mut random = Random(seed);
        let settings = random_settings(&mut random);
        let mut gate = SafetyGate::new(settings).unwrap();
        let (mut force, mut torque) = (settings.max_force_n, settings.max_torque_nm);
        let mut before = Wrench::ZERO;
        for tick in 0..1000 {
            if random.next().is_multiple_of(50) {
                (force, torque) = (force * random.unit(), torque * random.unit());
                gate.lower(force, torque);
                // Never raised again, whatever is asked for.
                gate.lower(50.0, f64::INFINITY);
            }
            let now = gate.pass(random.wrench(50, &FINITE), &FRESH, FaultSet::NONE, DT).wrench();
            assert!(now.force.length() <= force && now.torque.length() <= torque, "seed {seed} tick {tick}");
            assert!(follows(before.force, now.force, settings.max_slew_n_per_s * DT), "{before:?} {now:?}");
            let turn = settings.max_torque_slew_nm_per_s * DT;
            assert!(follows(before.torque, now.torque, turn), "{before:?} {now:?}");
            before = now;
        }
    }
}

#[test]
fn what_is_no_limit_lets_nothing_out() {
    for limit in [f64::NAN, -1.0] {
        let mut gate = open();
        gate.lower(limit, limit);
        assert_eq!(run(&mut gate, 10, 2.0, &FRESH), 0.0);
    }
}
