//! A recorded motion, as a smooth curve through its samples.

use crate::motion_csv::{MAX_SAMPLES, check_order, check_sample, read_samples};
use crate::{AtEnd, MotionError, PathPoint};
use glam::DVec3;
use std::fs::File;
use std::path::Path;

/// The motions that are built in, with their CSV text.
const BUILTIN: [(&str, &str); 1] = [("tremor", include_str!("../motions/tremor.csv"))];
const BUILTIN_NAMES: [&str; BUILTIN.len()] = [BUILTIN[0].0];

/// End and beginning closer than this are one place, m: the last digit of a file written to a micrometre.
const CLOSED_M: f64 = 1e-6;

/// Where something was at one time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MotionSample {
    /// Time, s, within ±1 000 000.
    pub time_s: f64,
    /// Position, m, each coordinate within ±10.
    pub position: DVec3,
}

/// A trajectory through samples: between two of them a cubic (Hermite) curve, so that positions are those of
/// the samples, and velocity has no jump. The velocity at a sample is that of the parabola through it and its
/// neighbours, so a motion of constant acceleration comes out exactly.
///
/// Before its first sample it rests there; after the last one it rests or repeats ([`AtEnd`]).
#[derive(Clone, Debug, PartialEq)]
pub struct Motion {
    name: String,
    samples: Box<[MotionSample]>,
    velocities: Box<[DVec3]>,
}

impl Motion {
    /// Reads a CSV file with the columns `time_s,x_m,y_m,z_m`; others are ignored.
    ///
    /// # Errors
    /// [`MotionError`] with file, line, column, value and what is allowed.
    pub fn load(path: &Path) -> Result<Self, MotionError> {
        let file = path.display().to_string();
        let source = File::open(path)
            .map_err(|error| MotionError::Open { file: file.clone(), cause: error.to_string() })?;
        Self::build(read_samples(source, &file)?, file)
    }

    /// Reads the text of such a file; `name` stands for the file in errors.
    ///
    /// # Errors
    /// As [`load`](Self::load).
    pub fn parse(text: &str, name: &str) -> Result<Self, MotionError> {
        Self::build(read_samples(text.as_bytes(), name)?, name.to_owned())
    }

    /// Takes samples from elsewhere; `name` stands for the file in errors.
    ///
    /// # Errors
    /// As [`load`](Self::load), with line n + 1 for sample n.
    pub fn from_samples(samples: Vec<MotionSample>, name: &str) -> Result<Self, MotionError> {
        for (n, sample) in samples.iter().enumerate() {
            check_sample(sample, name, n as u64 + 2)?;
        }
        for (n, pair) in samples.windows(2).enumerate() {
            check_order(pair[0].time_s, pair[1].time_s, name, n as u64 + 3)?;
        }
        Self::build(samples, name.to_owned())
    }

    /// The built-in motion called `name`. `tremor`: four seconds of a hand that tries to hold still, 8-12 Hz
    /// tremor of about 0.2 mm on a slow drift of some millimetres, from the origin and back to it.
    pub fn builtin(name: &str) -> Option<Self> {
        let (name, text) = BUILTIN.into_iter().find(|(known, _)| *known == name)?;
        Self::parse(text, name).ok()
    }

    /// Names of the built-in motions.
    pub fn builtin_names() -> &'static [&'static str] {
        &BUILTIN_NAMES
    }

    /// The same motion with every position put elsewhere.
    ///
    /// # Errors
    /// As [`from_samples`](Self::from_samples).
    pub fn map(&self, place: impl Fn(DVec3) -> DVec3) -> Result<Self, MotionError> {
        let sample = |s: &MotionSample| MotionSample { position: place(s.position), ..*s };
        Self::from_samples(self.samples.iter().map(sample).collect(), &self.name)
    }

    fn build(samples: Vec<MotionSample>, name: String) -> Result<Self, MotionError> {
        if !(2..=MAX_SAMPLES).contains(&samples.len()) {
            return Err(MotionError::Length { file: name, samples: samples.len() });
        }
        let velocities = velocities(&samples, gap_m(&samples) <= CLOSED_M);
        Ok(Self { name, samples: samples.into(), velocities })
    }

    /// Its file, or the name that it was given.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Its samples, earliest first; never fewer than two.
    pub fn samples(&self) -> &[MotionSample] {
        &self.samples
    }

    /// Time of the first sample, s.
    pub fn start_s(&self) -> f64 {
        self.samples[0].time_s
    }

    /// Time of the last sample, s.
    pub fn end_s(&self) -> f64 {
        self.samples[self.samples.len() - 1].time_s
    }

    /// Checks that it can repeat.
    ///
    /// # Errors
    /// [`MotionError::NotClosed`] if it ends more than a micrometre from where it begins.
    pub fn check_closed(&self) -> Result<(), MotionError> {
        let gap_m = gap_m(&self.samples);
        if gap_m <= CLOSED_M {
            Ok(())
        } else {
            Err(MotionError::NotClosed { file: self.name.clone(), gap_m })
        }
    }

    /// Where it is at `time_s`, s, and how fast. A time that is not a number counts as before the start. One
    /// that repeats without being closed jumps back. Costs one binary search.
    pub fn at(&self, time_s: f64, at_end: AtEnd) -> PathPoint {
        let (start, end) = (self.start_s(), self.end_s());
        if time_s.is_nan() || time_s < start {
            return PathPoint::at_rest(self.samples[0].position);
        }
        match at_end {
            AtEnd::Hold if time_s >= end => PathPoint::at_rest(self.samples[self.samples.len() - 1].position),
            AtEnd::Hold => self.between(time_s),
            AtEnd::Repeat if time_s.is_finite() => {
                self.between(start + (time_s - start).rem_euclid(end - start))
            }
            AtEnd::Repeat => self.between(start),
        }
    }

    /// `time_s` must lie between the first and the last sample.
    fn between(&self, time_s: f64) -> PathPoint {
        let after = self.samples.partition_point(|sample| sample.time_s <= time_s);
        let n = after.clamp(1, self.samples.len() - 1) - 1;
        let (a, b) = (self.samples[n], self.samples[n + 1]);
        let ends = [
            PathPoint { position: a.position, velocity: self.velocities[n] },
            PathPoint { position: b.position, velocity: self.velocities[n + 1] },
        ];
        hermite(ends, b.time_s - a.time_s, time_s - a.time_s)
    }
}

/// Distance from end to beginning, m.
fn gap_m(samples: &[MotionSample]) -> f64 {
    match samples {
        [first, .., last] => first.position.distance(last.position),
        _ => 0.0,
    }
}

/// The cubic through both ends, `length_s` apart, at `time_s` after the first one.
fn hermite([a, b]: [PathPoint; 2], length_s: f64, time_s: f64) -> PathPoint {
    let s = time_s / length_s;
    let moved = b.position - a.position;
    // Powers of s, from p(0) = a, p'(0), p(1) = b, p'(1); both ends come out to the last bit.
    let (v0, v1) = (a.velocity * length_s, b.velocity * length_s);
    let square = moved * 3.0 - v0 * 2.0 - v1;
    let cube = v0 + v1 - moved * 2.0;
    PathPoint {
        position: a.position + ((cube * s + square) * s + v0) * s,
        velocity: ((cube * (3.0 * s) + square * 2.0) * s + v0) / length_s,
    }
}

/// Velocity at every sample; a closed motion goes on over its seam.
fn velocities(samples: &[MotionSample], closed: bool) -> Box<[DVec3]> {
    let chords: Vec<Chord> = samples.windows(2).map(|pair| Chord::new(pair[0], pair[1])).collect();
    let last = chords.len() - 1;
    let mut velocities = Vec::with_capacity(samples.len());
    let seam = closed && last > 0;
    velocities.push(match seam {
        true => Chord::middle(chords[last], chords[0]),
        false => Chord::outer(chords[0], chords[last.min(1)]),
    });
    velocities.extend(chords.windows(2).map(|pair| Chord::middle(pair[0], pair[1])));
    velocities.push(match seam {
        true => velocities[0],
        false => Chord::outer(chords[last], chords[last.saturating_sub(1)]),
    });
    velocities.into()
}

/// The straight way from one sample to the next.
#[derive(Clone, Copy)]
struct Chord {
    length_s: f64,
    slope: DVec3,
}

impl Chord {
    fn new(a: MotionSample, b: MotionSample) -> Self {
        let length_s = b.time_s - a.time_s;
        Self { length_s, slope: (b.position - a.position) / length_s }
    }

    /// Velocity of the parabola over both chords where they meet.
    fn middle(a: Self, b: Self) -> DVec3 {
        (a.slope * b.length_s + b.slope * a.length_s) / (a.length_s + b.length_s)
    }

    /// Velocity of that parabola at the free end of `own`.
    fn outer(own: Self, other: Self) -> DVec3 {
        own.slope + (own.slope - other.slope) * (own.length_s / (own.length_s + other.length_s))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn motion(samples: &[(f64, DVec3)]) -> Motion {
        let samples = samples.iter().map(|&(time_s, position)| MotionSample { time_s, position });
        Motion::from_samples(samples.collect(), "test").unwrap()
    }

    fn uneven(place: impl Fn(f64) -> DVec3) -> Motion {
        let times = [0.0, 0.1, 0.35, 0.4, 0.9, 1.0];
        motion(&times.map(|time| (time, place(time))))
    }

    #[test]
    fn samples_are_met_to_the_last_bit() {
        let motion = uneven(|t| DVec3::new(t.sin(), t.cos(), t * t));
        for sample in motion.samples() {
            assert_eq!(motion.at(sample.time_s, AtEnd::Hold).position, sample.position);
        }
    }

    #[test]
    fn constant_acceleration_comes_out_exactly() {
        let motion = uneven(|t| DVec3::new(1.0 - 2.0 * t, 3.0 * t * t, t - t * t));
        for n in 0..100 {
            let t = f64::from(n) / 100.0;
            let point = motion.at(t, AtEnd::Hold);
            let place = DVec3::new(1.0 - 2.0 * t, 3.0 * t * t, t - t * t);
            assert!((point.position - place).length() < 1e-14);
            assert!((point.velocity - DVec3::new(-2.0, 6.0 * t, 1.0 - 2.0 * t)).length() < 1e-12);
        }
    }

    #[test]
    fn velocity_is_the_slope_and_has_no_jump() {
        let motion = uneven(|t| DVec3::new((7.0 * t).sin(), 0.0, (5.0 * t).cos()));
        let step = 1e-6;
        for n in 1..1000 {
            let t = f64::from(n) / 1000.0;
            let place = |t| motion.at(t, AtEnd::Hold).position;
            let slope = (place(t + step) - place(t - step)) / (2.0 * step);
            assert!((motion.at(t, AtEnd::Hold).velocity - slope).length() < 1e-3, "at {t}");
            let jump = motion.at(t - 1e-9, AtEnd::Hold).velocity - motion.at(t + 1e-9, AtEnd::Hold).velocity;
            assert!(n == 1000 || jump.length() < 1e-6, "at {t}");
        }
    }

    #[test]
    fn two_samples_make_a_straight_line() {
        let motion = motion(&[(1.0, DVec3::ZERO), (3.0, DVec3::Y * 4.0)]);
        let point = motion.at(1.5, AtEnd::Hold);
        assert_eq!(point, PathPoint { position: DVec3::Y, velocity: DVec3::Y * 2.0 });
    }

    #[test]
    fn outside_it_rests() {
        let motion = motion(&[(1.0, DVec3::X), (2.0, DVec3::Y)]);
        for time in [f64::NEG_INFINITY, 0.0, f64::NAN] {
            assert_eq!(motion.at(time, AtEnd::Hold), PathPoint::at_rest(DVec3::X));
        }
        for time in [2.0, 5.0, f64::INFINITY] {
            assert_eq!(motion.at(time, AtEnd::Hold), PathPoint::at_rest(DVec3::Y));
        }
    }

    #[test]
    fn a_closed_motion_repeats_without_a_jump() {
        let place = |n: i32| DVec3::X * (f64::from(n % 20) * std::f64::consts::TAU / 20.0).sin();
        let samples: Vec<_> = (0..=20).map(|n| (0.5 + f64::from(n) * 0.05, place(n))).collect();
        let motion = motion(&samples);
        assert!(motion.check_closed().is_ok());
        for time in [0.6, 0.93, 1.2] {
            let (first, later) = (motion.at(time, AtEnd::Repeat), motion.at(time + 7.0, AtEnd::Repeat));
            assert!((first.position - later.position).length() < 1e-12);
            assert!((first.velocity - later.velocity).length() < 1e-9);
        }
        let (before, after) = (motion.at(1.5 - 1e-9, AtEnd::Repeat), motion.at(1.5 + 1e-9, AtEnd::Repeat));
        assert!((before.position - after.position).length() < 1e-7);
        assert!((before.velocity - after.velocity).length() < 1e-5);
        assert!(motion.at(f64::INFINITY, AtEnd::Repeat).position.is_finite());
    }

    #[test]
    fn an_open_motion_says_how_far_it_is_open() {
        let error = motion(&[(0.0, DVec3::ZERO), (1.0, DVec3::X * 0.5)]).check_closed().unwrap_err();
        assert!(error.to_string().starts_with("motion test ends 0.5 m from where it begins"), "{error}");
    }

    #[test]
    fn what_is_no_motion_is_refused() {
        let sample = |time_s, position| MotionSample { time_s, position };
        let refuse = |samples: Vec<_>| Motion::from_samples(samples, "test").unwrap_err();
        assert!(matches!(refuse(vec![]), MotionError::Length { samples: 0, .. }));
        assert!(matches!(refuse(vec![sample(0.0, DVec3::X)]), MotionError::Length { samples: 1, .. }));
        let back = vec![sample(0.0, DVec3::X), sample(0.0, DVec3::X)];
        assert!(matches!(refuse(back), MotionError::Order { line: 3, .. }));
        let far = vec![sample(0.0, DVec3::X), sample(1.0, DVec3::Z * 11.0)];
        assert!(matches!(refuse(far), MotionError::Value { line: 3, column: "z_m", .. }));
        let open = Motion::load(Path::new("/nowhere/at/all.csv")).unwrap_err();
        assert!(open.to_string().starts_with("motion /nowhere/at/all.csv cannot be opened"), "{open}");
    }

    #[test]
    fn every_builtin_motion_is_there_and_closed() {
        assert_eq!(Motion::builtin_names(), ["tremor"]);
        for name in Motion::builtin_names() {
            let motion = Motion::builtin(name).unwrap();
            assert_eq!(motion.name(), *name);
            motion.check_closed().unwrap();
            assert_eq!(motion.at(0.0, AtEnd::Hold).position, DVec3::ZERO);
        }
        assert_eq!(Motion::builtin("walk"), None);
    }
}
