//! What goes in and what comes out, for every filter.

use super::*;
use glam::DVec3;
use std::f64::consts::TAU;

const RATE: f64 = 1000.0;
const FRAME: f64 = 1.0 / 60.0;
const EVERY: [&str; 11] = [
    "none",
    "bartlett-hann:11@servo",
    "bartlett-hann:11@fluid",
    "hann:7",
    "hamming:2",
    "blackman:21@fluid",
    "boxcar:17",
    "butterworth:50",
    "butterworth:30:1",
    "butterworth:80:7",
    "one-euro:5:0.5",
];

fn filter(text: &str) -> Filter {
    Filter::new(&text.parse().unwrap(), RATE).unwrap()
}

fn force(x: f64) -> Wrench {
    Wrench { force: DVec3::new(x, -2.0 * x, 0.5 * x), torque: DVec3::new(0.0, 0.1 * x, -x) }
}

/// Amplitude of the answer to a sine of size 1, by quadrature over a whole number of periods.
fn measured_gain(text: &str, frequency_hz: f64) -> f64 {
    let mut filter = filter(text);
    let (mut re, mut im) = (0.0, 0.0);
    for tick in 0..8000 {
        let (sin, cos) = (TAU * frequency_hz * f64::from(tick) / RATE).sin_cos();
        let answer = filter.step(force(sin), true).force.x;
        if tick >= 4000 {
            re += answer * sin / 2000.0;
            im += answer * cos / 2000.0;
        }
    }
    re.hypot(im)
}

fn decibels(gain: f64) -> f64 {
    20.0 * gain.log10()
}

fn assert_decibels(text: &str, table: &[(f64, f64)], tolerance: f64) {
    for &(frequency, expected) in table {
        let measured = decibels(measured_gain(text, frequency));
        assert!((measured - expected).abs() < tolerance, "{text} at {frequency} Hz: {measured} dB");
        let stated = decibels(filter(text).gain(frequency, FRAME));
        assert!((measured - stated).abs() < 0.01, "{text} at {frequency} Hz: {measured}, stated {stated} dB");
    }
}

#[test]
fn a_constant_comes_out_at_once_and_for_ever() {
    for text in EVERY {
        let mut filter = filter(text);
        for tick in 0..300 {
            let answer = filter.step(force(3.0), tick % 16 == 0);
            assert!((answer - force(3.0)).force.length() < 1e-12, "{text} at {tick}: {answer:?}");
            assert!((answer - force(3.0)).torque.length() < 1e-12, "{text} at {tick}: {answer:?}");
        }
    }
}

#[test]
fn the_answer_to_an_impulse_is_the_normalised_window() {
    for kind in WindowKind::ALL {
        for taps in [1, 3, 10, 11, 64] {
            let mut filter = filter(&format!("{}:{taps}", kind.name()));
            filter.step(Wrench::ZERO, false);
            let weights = kind.weights(taps);
            let sum: f64 = weights.iter().sum();
            for weight in weights.iter().chain(&[0.0; 20]).enumerate() {
                let sample = if weight.0 == 0 { force(1.0) } else { Wrench::ZERO };
                assert_eq!(filter.step(sample, false), force(1.0) * (weight.1 / sum));
            }
        }
    }
}

#[test]
fn taps_at_the_fluid_are_frames() {
    let mut frames = filter("bartlett-hann:11@fluid");
    let mut ticks = filter("bartlett-hann:11@servo");
    ticks.step(Wrench::ZERO, false);
    frames.step(Wrench::ZERO, true);
    for frame in 0..30 {
        let sample = force((frame as f64 * 0.7).sin());
        let expected = ticks.step(sample, false);
        assert_eq!(frames.step(sample, true), expected);
        for _ in 0..15 {
            assert_eq!(frames.step(force(99.0), false), expected);
        }
    }
}

#[test]
fn before_the_first_frame_the_sample_is_handed_on() {
    let mut filter = filter("hann:5@fluid");
    assert_eq!(filter.step(force(1.0), false), force(1.0));
    assert_eq!(filter.step(force(2.0), false), force(2.0));
    assert!((filter.step(force(3.0), true) - force(3.0)).force.length() < 1e-12);
    assert!((filter.step(force(4.0), false) - force(3.0)).force.length() < 1e-12);
}

#[test]
fn a_ramp_comes_late_by_the_stated_delay() {
    for text in EVERY.into_iter().filter(|text| !text.starts_with("one-euro")) {
        let mut filter = filter(text);
        let tap = if text.ends_with("@fluid") { FRAME } else { 1.0 / RATE };
        let mut late = f64::NAN;
        for tick in 0..3000 {
            let time = f64::from(tick) * tap;
            late = time - filter.step(force(time), true).force.x;
        }
        assert!((late - filter.delay_s(FRAME)).abs() < 1e-9, "{text}: {late}");
    }
}

#[test]
fn delays_are_the_known_ones() {
    assert!((filter("bartlett-hann:11").delay_s(FRAME) - 0.005).abs() < 1e-15);
    assert!((filter("bartlett-hann:11@fluid").delay_s(FRAME) - 5.0 / 60.0).abs() < 1e-15);
    assert!((filter("bartlett-hann:11@fluid").delay_s(1.0 / 30.0) - 5.0 / 30.0).abs() < 1e-15);
    assert!((filter("butterworth:50").delay_s(FRAME) - 0.0045).abs() < 5e-5);
    assert!((filter("butterworth:30:4").delay_s(FRAME) - 0.0138).abs() < 1e-4);
    assert_eq!(filter("none").delay_s(FRAME), 0.0);
    assert!((filter("one-euro:20:0").delay_s(FRAME) - 1.0 / (TAU * 20.0)).abs() < 1e-15);
}

#[test]
fn butterworth_leaves_half_the_power_at_its_cutoff() {
    for order in 1..=8 {
        for cutoff in [10.0, 50.0, 125.0, 400.0] {
            let gain = measured_gain(&format!("butterworth:{cutoff}:{order}"), cutoff);
            assert!((gain - 0.5_f64.sqrt()).abs() < 1e-6, "order {order} at {cutoff} Hz: {gain}");
        }
    }
}

#[test]
fn butterworth_of_50_hz_has_the_known_attenuations() {
    let table = [(50.0, -3.01), (60.0, -4.9), (100.0, -12.7), (125.0, -16.8), (250.0, -32.0)];
    assert_decibels("butterworth:50", &table, 0.3);
    assert_decibels("butterworth:30:4", &[(60.0, -24.4), (100.0, -43.0), (125.0, -51.3)], 0.3);
}

#[test]
fn butterworth_of_order_2_overshoots_a_step_by_4_percent() {
    let mut filter = filter("butterworth:50");
    filter.step(Wrench::ZERO, false);
    let peak = (0..200).map(|_| filter.step(force(1.0), false).force.x).fold(0.0, f64::max);
    assert!((peak - 1.044).abs() < 0.002, "{peak}");
}

#[test]
fn bartlett_hann_of_11_ticks_has_the_known_attenuations() {
    let table = [(70.0, -3.0), (60.0, -2.2), (100.0, -6.4), (125.0, -10.5), (250.0, -41.6)];
    assert_decibels("bartlett-hann:11", &table, 0.1);
}

#[test]
fn bartlett_hann_of_11_frames_at_60_hz_passes_to_4_hz() {
    let gain = decibels(filter("bartlett-hann:11@fluid").gain(4.2, FRAME));
    assert!((gain + 3.0).abs() < 0.1, "{gain}");
}

#[test]
fn a_boxcar_of_one_frame_cancels_the_frame_rate() {
    assert!(measured_gain("boxcar:8", 125.0) < 1e-12);
    assert!(measured_gain("boxcar:4", 250.0) < 1e-12);
}

#[test]
fn one_euro_without_beta_is_a_first_order_low_pass() {
    assert_decibels("one-euro:20:0", &[(60.0, -10.42), (250.0, -21.57)], 0.02);
    let mut filter = filter("one-euro:20:0");
    filter.step(Wrench::ZERO, false);
    let alpha = 1.0 / (1.0 + RATE / (TAU * 20.0));
    for n in 1..50 {
        let answer = filter.step(force(1.0), false).force.x;
        assert!((answer - (1.0 - (1.0 - alpha).powi(n))).abs() < 1e-12);
    }
}

#[test]
fn one_euro_is_faster_while_the_force_changes_and_turns_with_the_axes() {
    let rise = |beta: f64, direction: DVec3| {
        let mut filter = filter(&format!("one-euro:1:{beta}"));
        filter.step(Wrench::ZERO, false);
        let mut answer = Wrench::ZERO;
        for _ in 0..20 {
            answer = filter.step(Wrench::from_force(direction), false);
        }
        answer.force
    };
    assert!(rise(1.0, DVec3::X).x > 3.0 * rise(0.0, DVec3::X).x);
    let slanted = DVec3::new(0.6, 0.0, 0.8);
    assert!((rise(1.0, slanted) - slanted * rise(1.0, DVec3::X).x).length() < 1e-12);
}

#[test]
fn what_is_not_finite_is_handed_on_but_not_kept() {
    for text in EVERY {
        let mut filter = filter(text);
        filter.step(force(1.0), true);
        for bad in [f64::NAN, f64::INFINITY] {
            assert!(!filter.step(force(bad), true).is_finite(), "{text} hid it");
        }
        let answer = filter.step(force(1.0), true);
        assert!((answer - force(1.0)).force.length() < 1e-12, "{text} kept it");
    }
}

#[test]
fn an_overflow_does_not_stay_inside() {
    for text in EVERY {
        let mut filter = filter(text);
        for tick in 0..50 {
            filter.step(force(if tick % 2 == 0 { 8e307 } else { -8e307 }), true);
        }
        for _ in 0..20_000 {
            filter.step(force(1.0), true);
        }
        assert!(filter.step(force(1.0), true).is_finite(), "{text}");
    }
}

#[test]
fn reset_forgets() {
    for text in EVERY {
        let mut filter = filter(text);
        for tick in 0..50 {
            filter.step(force(f64::from(tick)), true);
        }
        filter.reset();
        let answer = filter.step(force(-1.0), true);
        assert!((answer - force(-1.0)).force.length() < 1e-12, "{text}: {answer:?}");
    }
}

#[test]
fn numbers_are_checked_against_the_rate_in_use() {
    let spec = FilterSpec::Butterworth { cutoff_hz: 300.0, order: 2 };
    assert!(Filter::new(&spec, 1000.0).is_ok());
    let error = Filter::new(&spec, 500.0).unwrap_err();
    assert_eq!(error.to_string(), "cutoff_hz = 300 is outside its range 0.1 to 249.5");
    let none = FilterSpec::Window { kind: WindowKind::Hann, taps: 0, place: TapPlace::Servo };
    assert!(Filter::new(&none, 1000.0).is_err());
    assert!(Filter::new(&FilterSpec::None, f64::NAN).is_err());
}
