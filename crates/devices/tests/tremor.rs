//! The built-in motion `tremor`: how it was made, and that it is what it is said to be.
//!
//! To make it anew: `cargo test -p hapflow-devices --test tremor -- --ignored`.

use std::f64::consts::TAU;
use std::fmt::Write;

const FILE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/motions/tremor.csv");
const SHIPPED: &str = include_str!("../motions/tremor.csv");
/// 4 s at 200 Hz; every frequency is a multiple of 1/4 Hz, so that the motion is closed.
const SAMPLES: usize = 800;
const RATE_HZ: f64 = 200.0;
const BASE_HZ: f64 = 0.25;

/// splitmix64: the same numbers everywhere.
struct Random(u64);

impl Random {
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// One line of a spectrum.
struct Wave {
    frequency_hz: f64,
    amplitude_m: f64,
    phase: f64,
}

/// Waves at multiples `lines` of 1/4 Hz with random sizes and phases, of `rms_m` together.
fn band(random: &mut Random, lines: std::ops::RangeInclusive<u32>, rms_m: f64) -> Vec<Wave> {
    let mut waves: Vec<Wave> = lines
        .map(|n| Wave {
            frequency_hz: f64::from(n) * BASE_HZ,
            amplitude_m: 0.5 + random.unit(),
            phase: TAU * random.unit(),
        })
        .collect();
    let power: f64 = waves.iter().map(|wave| wave.amplitude_m * wave.amplitude_m / 2.0).sum();
    waves.iter_mut().for_each(|wave| wave.amplitude_m *= rms_m / power.sqrt());
    waves
}

/// The waves of one axis: physiological tremor of 8-12 Hz, drift below 1 Hz, and on x a slow way to the side.
fn axis(random: &mut Random, axis: usize) -> Vec<Wave> {
    let mut waves = band(random, 32..=48, [0.15e-3, 0.20e-3, 0.12e-3][axis]);
    waves.extend(band(random, 1..=3, [2.0e-3, 2.5e-3, 1.5e-3][axis]));
    if axis == 0 {
        waves.push(Wave { frequency_hz: BASE_HZ, amplitude_m: 0.010, phase: 0.0 });
    }
    waves
}

fn place(waves: &[Wave], time_s: f64) -> f64 {
    let at = |t: f64| -> f64 {
        waves.iter().map(|wave| wave.amplitude_m * (TAU * wave.frequency_hz * t + wave.phase).sin()).sum()
    };
    at(time_s) - at(0.0)
}

/// The file as it was made, to a tenth of a micrometre.
fn generate() -> String {
    let mut random = Random(2011);
    let axes: [Vec<Wave>; 3] = std::array::from_fn(|n| axis(&mut random, n));
    let mut text = String::from("time_s,x_m,y_m,z_m\n");
    for n in 0..=SAMPLES {
        let time = n as f64 / RATE_HZ;
        // The last sample is the first one, to the last digit.
        let [x, y, z] = axes.each_ref().map(|waves| place(waves, (n % SAMPLES) as f64 / RATE_HZ));
        let _ = writeln!(text, "{time:.3},{x:.7},{y:.7},{z:.7}");
    }
    text.replace("-0.0000000", "0.0000000")
}

fn rows(text: &str) -> Vec<[f64; 4]> {
    let row = |line: &str| {
        let mut numbers = line.split(',').map(|number| number.parse().unwrap_or(f64::NAN));
        std::array::from_fn(|_| numbers.next().unwrap_or(f64::NAN))
    };
    text.lines().skip(1).map(row).collect()
}

/// Root mean square of one column within a band of frequencies, by discrete Fourier transform, m.
fn band_rms(column: usize, low_hz: f64, high_hz: f64) -> f64 {
    let rows = &rows(SHIPPED)[..SAMPLES];
    let mut power = 0.0;
    for n in 1..SAMPLES / 2 {
        let frequency = n as f64 * BASE_HZ;
        if frequency < low_hz || frequency > high_hz {
            continue;
        }
        let (mut re, mut im) = (0.0, 0.0);
        for row in rows {
            let (sin, cos) = (TAU * frequency * row[0]).sin_cos();
            re += row[column] * cos;
            im += row[column] * sin;
        }
        let amplitude = 2.0 * re.hypot(im) / SAMPLES as f64;
        power += amplitude * amplitude / 2.0;
    }
    power.sqrt()
}

#[test]
#[ignore = "writes motions/tremor.csv"]
fn make_the_file() {
    std::fs::write(FILE, generate()).unwrap();
}

#[test]
fn the_shipped_file_is_the_one_that_is_made() {
    assert!(SHIPPED.len() < 60_000, "{} bytes", SHIPPED.len());
    let (shipped, made) = (rows(SHIPPED), rows(&generate()));
    assert_eq!(shipped.len(), SAMPLES + 1);
    assert_eq!(made.len(), SAMPLES + 1);
    // One digit of slack: sines of other systems may differ in their last bit.
    for (a, b) in shipped.iter().flatten().zip(made.iter().flatten()) {
        assert!((a - b).abs() < 1.5e-7, "{a} is not {b}");
    }
}

#[test]
fn its_tremor_and_its_drift_are_those_of_a_hand() {
    for column in 1..=3 {
        let tremor = band_rms(column, 8.0, 12.0);
        assert!((0.1e-3..=0.3e-3).contains(&tremor), "column {column}: {tremor} m");
        let drift = band_rms(column, 0.1, 1.0);
        assert!((1e-3..=10e-3).contains(&drift), "column {column}: {drift} m");
        assert!(band_rms(column, 1.1, 7.9) < 1e-7 && band_rms(column, 12.1, 99.0) < 1e-6);
    }
    let furthest =
        rows(SHIPPED).iter().flat_map(|row| [row[1], row[2], row[3]]).fold(0.0, |a: f64, b| a.max(b.abs()));
    assert!((5e-3..=25e-3).contains(&furthest), "{furthest} m");
}
