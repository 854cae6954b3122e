//! Where a simulated hand wants to be.

use crate::{AtEnd, PathPoint};
use glam::{DQuat, DVec3};
use hapflow_haptics::{RangeError, check_range};
use std::f64::consts::TAU;

/// One thing that a hand does. Scene frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Segment {
    /// Stays where it is.
    Hold {
        /// For how long, s, 0.001 to 3600.
        duration_s: f64,
    },
    /// Moves straight to a place, from rest to rest with the least jerk, as people reach: share of the way 10
    /// τ³ − 15 τ⁴ + 6 τ⁵ (T. Flash and N. Hogan, J. Neurosci. 5 (1985),
    /// doi:10.1523/JNEUROSCI.05-07-01688.1985).
    MoveTo {
        /// The place, m, each coordinate within ±10.
        position: DVec3,
        /// For how long, s, 0.001 to 3600.
        duration_s: f64,
    },
    /// Swings about where it is, p + A sin 2πft. It begins at full speed, not at rest.
    Sine {
        /// Amplitude and direction A, m, each coordinate within ±1.
        amplitude: DVec3,
        /// Frequency f, Hz, 0.001 to 50.
        frequency_hz: f64,
        /// For how long, s, 0.001 to 3600. After a whole number of swings it is where it began.
        duration_s: f64,
    },
    /// Circles about a place, at a constant height, from where it is: stirring. Positive frequencies turn
    /// from z towards x, anticlockwise as seen from above. It begins at full speed.
    Circle {
        /// Centre, m, each coordinate within ±10; its height does not matter.
        centre: DVec3,
        /// Turns a second, Hz, −50 to 50 but for 0.
        frequency_hz: f64,
        /// For how long, s, 0.001 to 3600. After a whole number of turns it is where it began.
        duration_s: f64,
    },
}

/// Why a script was refused. Segments count from 0.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum ScriptError {
    /// The place where the hand starts is outside its range.
    #[error("script start: {0}")]
    Start(RangeError),
    /// A number of a segment is outside its range.
    #[error("script segment {segment}: {cause}")]
    Segment {
        /// Which segment.
        segment: usize,
        /// Which number.
        cause: RangeError,
    },
    /// It is to repeat, but does not end where it starts.
    #[error(
        "script ends {gap_m} m from where it starts: add a move back to the start, or let it hold at its end"
    )]
    NotClosed {
        /// Distance from end to start, m.
        gap_m: f64,
    },
}

/// A segment with when and where it begins.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Part {
    begin_s: f64,
    from: DVec3,
    segment: Segment,
}

/// A sequence of [`Segment`]s, from time 0 on. Before that, the hand wants to be at the start.
#[derive(Clone, Debug, PartialEq)]
pub struct TargetScript {
    parts: Box<[Part]>,
    /// Where it starts, and where it ends.
    places: [DVec3; 2],
    duration_s: f64,
    at_end: AtEnd,
}

impl TargetScript {
    /// A script that starts at `start`, m, each coordinate within ±10; without segments the hand stays there.
    ///
    /// # Errors
    /// [`ScriptError`] if a number is outside its range, or a script that repeats does not end where it
    /// starts (to a micrometre).
    pub fn new(start: DVec3, segments: &[Segment], at_end: AtEnd) -> Result<Self, ScriptError> {
        check_place(start, 10.0, ["start x (m)", "start y (m)", "start z (m)"])
            .map_err(ScriptError::Start)?;
        let mut parts = Vec::with_capacity(segments.len());
        let (mut begin_s, mut from) = (0.0, start);
        for (n, &segment) in segments.iter().enumerate() {
            segment.check().map_err(|cause| ScriptError::Segment { segment: n, cause })?;
            parts.push(Part { begin_s, from, segment });
            begin_s += segment.duration_s();
            from = segment.at(from, segment.duration_s()).position;
        }
        let gap_m = from.distance(start);
        if at_end == AtEnd::Repeat && gap_m > 1e-6 {
            return Err(ScriptError::NotClosed { gap_m });
        }
        Ok(Self { parts: parts.into(), places: [start, from], duration_s: begin_s, at_end })
    }

    /// Time from start to end, s; 0 without segments.
    pub fn duration_s(&self) -> f64 {
        self.duration_s
    }

    /// Where the hand starts, m.
    pub fn start(&self) -> DVec3 {
        self.places[0]
    }

    /// Where the hand wants to be at `time_s`, s, and how fast. A time that is not a number counts as before
    /// the start. Costs one binary search.
    pub fn at(&self, time_s: f64) -> PathPoint {
        if time_s.is_nan() || time_s < 0.0 {
            return PathPoint::at_rest(self.places[0]);
        }
        match self.at_end {
            AtEnd::Repeat if self.duration_s > 0.0 && time_s.is_finite() => {
                self.within(time_s.rem_euclid(self.duration_s))
            }
            _ if time_s >= self.duration_s => PathPoint::at_rest(self.places[1]),
            _ => self.within(time_s),
        }
    }

    /// `time_s` must lie between start and end.
    fn within(&self, time_s: f64) -> PathPoint {
        let after = self.parts.partition_point(|part| part.begin_s <= time_s);
        match self.parts.get(after.saturating_sub(1)) {
            Some(part) => part.segment.at(part.from, time_s - part.begin_s),
            None => PathPoint::at_rest(self.places[0]),
        }
    }
}

impl Segment {
    /// How long it takes, s.
    pub fn duration_s(&self) -> f64 {
        match *self {
            Self::Hold { duration_s }
            | Self::MoveTo { duration_s, .. }
            | Self::Sine { duration_s, .. }
            | Self::Circle { duration_s, .. } => duration_s,
        }
    }

    fn check(&self) -> Result<(), RangeError> {
        check_range("duration_s", self.duration_s(), 1e-3, 3600.0)?;
        match *self {
            Self::Hold { .. } => Ok(()),
            Self::MoveTo { position, .. } => {
                check_place(position, 10.0, ["position x (m)", "position y (m)", "position z (m)"])
            }
            Self::Sine { amplitude, frequency_hz, .. } => {
                check_range("frequency_hz", frequency_hz, 1e-3, 50.0)?;
                check_place(amplitude, 1.0, ["amplitude x (m)", "amplitude y (m)", "amplitude z (m)"])
            }
            Self::Circle { centre, frequency_hz, .. } => {
                check_range("|frequency_hz|", frequency_hz.abs(), 1e-3, 50.0)?;
                check_place(centre, 10.0, ["centre x (m)", "centre y (m)", "centre z (m)"])
            }
        }
    }

    /// Where it has got to `time_s` after it began at `from`.
    fn at(&self, from: DVec3, time_s: f64) -> PathPoint {
        match *self {
            Self::Hold { .. } => PathPoint::at_rest(from),
            Self::MoveTo { position, duration_s } => reach(from, position, duration_s, time_s),
            Self::Sine { amplitude, frequency_hz, .. } => {
                let (sin, cos) = (TAU * frequency_hz * time_s).sin_cos();
                let velocity = amplitude * (TAU * frequency_hz * cos);
                PathPoint { position: from + amplitude * sin, velocity }
            }
            Self::Circle { centre, frequency_hz, .. } => {
                let axle = DVec3::new(centre.x, from.y, centre.z);
                let arm = DQuat::from_rotation_y(TAU * frequency_hz * time_s) * (from - axle);
                PathPoint { position: axle + arm, velocity: DVec3::Y.cross(arm) * (TAU * frequency_hz) }
            }
        }
    }
}

/// The way with the least jerk, `time_s` after its beginning.
fn reach(from: DVec3, to: DVec3, duration_s: f64, time_s: f64) -> PathPoint {
    let s = (time_s / duration_s).clamp(0.0, 1.0);
    let share = s * s * s * (10.0 + s * (6.0 * s - 15.0));
    let rate = 30.0 * s * s * (1.0 - s) * (1.0 - s) / duration_s;
    PathPoint { position: from.lerp(to, share), velocity: (to - from) * rate }
}

fn check_place(place: DVec3, limit: f64, fields: [&'static str; 3]) -> Result<(), RangeError> {
    for (field, value) in fields.into_iter().zip(place.to_array()) {
        check_range(field, value, -limit, limit)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn stroll() -> [Segment; 4] {
        [
            Segment::Hold { duration_s: 1.0 },
            Segment::MoveTo { position: DVec3::new(0.2, 0.0, -0.1), duration_s: 2.0 },
            Segment::Sine { amplitude: DVec3::Y * 0.03, frequency_hz: 1.5, duration_s: 2.0 },
            Segment::MoveTo { position: DVec3::ZERO, duration_s: 1.0 },
        ]
    }

    fn script(at_end: AtEnd) -> TargetScript {
        TargetScript::new(DVec3::ZERO, &stroll(), at_end).unwrap()
    }

    #[test]
    fn it_passes_the_known_places() {
        let script = script(AtEnd::Hold);
        assert_eq!(script.duration_s(), 6.0);
        assert_eq!(script.at(0.5), PathPoint::at_rest(DVec3::ZERO));
        let half = script.at(2.0);
        assert!((half.position - DVec3::new(0.1, 0.0, -0.05)).length() < 1e-15);
        // The peak of a move with the least jerk is 15/8 of its mean speed.
        assert!((half.velocity - DVec3::new(0.1, 0.0, -0.05) * (15.0 / 8.0)).length() < 1e-15);
        let quarter = script.at(1.5).position.x;
        assert!((quarter - 0.2 * 0.103515625).abs() < 1e-15, "{quarter}");
        let crest = script.at(3.0 + 1.0 / 6.0);
        assert!((crest.position - DVec3::new(0.2, 0.03, -0.1)).length() < 1e-12);
        assert!((script.at(3.0).velocity.y - 0.03 * TAU * 1.5).abs() < 1e-12);
        assert_eq!(script.at(60.0), PathPoint::at_rest(DVec3::ZERO));
    }

    #[test]
    fn velocity_is_the_slope() {
        let script = script(AtEnd::Hold);
        for n in 0..600 {
            let time = 0.005 + f64::from(n) * 0.01;
            let slope = (script.at(time + 1e-6).position - script.at(time - 1e-6).position) / 2e-6;
            assert!((script.at(time).velocity - slope).length() < 1e-8, "at {time}");
        }
    }

    #[test]
    fn positions_have_no_jump() {
        let script = script(AtEnd::Repeat);
        for n in 0..13_000 {
            let (a, b) = (script.at(f64::from(n) * 1e-3), script.at(f64::from(n + 1) * 1e-3));
            assert!(a.position.distance(b.position) < 0.5e-3, "at {n} ms");
        }
    }

    #[test]
    fn it_repeats_if_it_ends_where_it_starts() {
        let script = script(AtEnd::Repeat);
        for time in [0.3, 2.2, 3.7, 5.9] {
            assert!(script.at(time).position.distance(script.at(time + 12.0).position) < 1e-12);
        }
        let open = TargetScript::new(DVec3::ZERO, &stroll()[..2], AtEnd::Repeat).unwrap_err();
        assert!(matches!(open, ScriptError::NotClosed { gap_m } if (gap_m - 0.05_f64.sqrt()).abs() < 1e-12));
    }

    #[test]
    fn without_segments_it_stays() {
        for at_end in [AtEnd::Hold, AtEnd::Repeat] {
            let script = TargetScript::new(DVec3::Z, &[], at_end).unwrap();
            for time in [-1.0, 0.0, 9.0, f64::INFINITY, f64::NAN] {
                assert_eq!(script.at(time), PathPoint::at_rest(DVec3::Z));
            }
        }
    }

    #[test]
    fn numbers_are_checked_and_the_segment_is_named() {
        let refuse =
            |segment| TargetScript::new(DVec3::ZERO, &[stroll()[0], segment], AtEnd::Hold).unwrap_err();
        let error = refuse(Segment::Hold { duration_s: 0.0 });
        assert_eq!(error.to_string(), "script segment 1: duration_s = 0 is outside its range 0.001 to 3600");
        let error = refuse(Segment::MoveTo { position: DVec3::Y * 11.0, duration_s: 1.0 });
        assert!(error.to_string().contains("position y (m) = 11"), "{error}");
        let amplitude = DVec3::new(0.0, 0.0, f64::NAN);
        let error = refuse(Segment::Sine { amplitude, frequency_hz: 1.0, duration_s: 1.0 });
        assert!(error.to_string().contains("amplitude z (m) = NaN"), "{error}");
        let error = refuse(Segment::Sine { amplitude: DVec3::X, frequency_hz: 51.0, duration_s: 1.0 });
        assert!(error.to_string().contains("frequency_hz = 51"), "{error}");
        assert!(matches!(TargetScript::new(DVec3::NAN, &[], AtEnd::Hold), Err(ScriptError::Start(_))));
    }

    #[test]
    fn a_circle_turns_about_its_centre() {
        let circle =
            Segment::Circle { centre: DVec3::new(1.0, 9.0, 2.0), frequency_hz: 0.5, duration_s: 2.0 };
        let script = TargetScript::new(DVec3::new(1.0, 0.5, 2.1), &[circle], AtEnd::Repeat).unwrap();
        let quarter = script.at(0.5);
        assert!(quarter.position.distance(DVec3::new(1.1, 0.5, 2.0)) < 1e-12);
        let speed = TAU * 0.5 * 0.1;
        assert!(quarter.velocity.distance(DVec3::new(0.0, 0.0, -speed)) < 1e-12);
        let still = Segment::Circle { centre: DVec3::ZERO, frequency_hz: 0.0, duration_s: 1.0 };
        assert!(TargetScript::new(DVec3::X, &[still], AtEnd::Hold).is_err());
    }
}
