//! Zero angles and motor strength of one Falcon, from readings that were taken at it.
//!
//! Zero angles: the arms' angles that a known place asks for, less what the encoders counted. Strength: motors that carry a
//! load in the air give its weight, whatever they are said to give; from two loads on, the grip's own weight drops out.

use crate::falcon::{Geometry, Kinematics, PoseError, torques_of};
use glam::DVec3;
use hapflow_haptics::{RangeError, check_range};

/// Standard gravity, m/s².
pub(super) const GRAVITY: f64 = 9.80665;
/// Loads differ by at least so much, kg: a fifth of a newton, above what a motor's count and friction leave open.
pub const LEAST_LOAD_KG: f64 = 0.02;
/// Largest load, kg: with the grip some 6 N, which the weakest direction still carries.
pub const LARGEST_LOAD_KG: f64 = 0.5;
/// Cosine of the largest angle between what a load adds and the vertical: 25 degrees.
const UPRIGHT: f64 = 0.9;

/// Encoder counts while the grip was held at a known place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlaceReading {
    /// The counts, top, right, left; a mean may have fractions.
    pub counts: [f64; 3],
    /// The place in the Falcon's frame, m.
    pub place: DVec3,
}

/// What the motors gave while a load hung from the grip and nothing else touched it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LoadReading {
    /// The force that they would have given if one count were one newton metre, N.
    pub pull: DVec3,
    /// The load, kg; 0 for the bare grip.
    pub load_kg: f64,
}

/// What places tell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Zeros {
    /// Arm angles at encoder count 0, degrees.
    pub zero_deg: [f64; 3],
    /// Largest distance between a place and where its counts then put it, m: 0 for a single place.
    pub off_m: f64,
}

/// What loads tell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Strength {
    /// Motor counts a newton metre at an arm's axis.
    pub counts_per_nm: f64,
    /// Mass of the grip by its own weight, kg.
    pub grip_kg: f64,
}

/// Why readings give no calibration.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum CalibrationError {
    /// There are none.
    #[error("calibration: no reading of a place; give at least one")]
    NoPlace,
    /// A place or counts without a pose. Readings count from 1.
    #[error("calibration, reading {reading}: {cause}")]
    Pose {
        /// The reading.
        reading: usize,
        /// What is wrong with it.
        cause: PoseError,
    },
    /// Loads that do not differ.
    #[error("calibration: loads must differ by at least {LEAST_LOAD_KG} kg; take one reading without a load")]
    SameLoads,
    /// What a load adds to the motors' pull is not up.
    #[error(
        "calibration: what the load adds points {degrees:.0} degrees off the vertical: stand the Falcon level, and let the \
         load hang freely"
    )]
    NotUp {
        /// How far off, degrees.
        degrees: f64,
    },
    /// A result that no Falcon has.
    #[error("calibration: {0}; are the readings right?")]
    Range(#[from] RangeError),
}

impl LoadReading {
    /// Of a single moment: with these encoder counts and these motor counts.
    ///
    /// # Errors
    /// [`PoseError`] if the counts have no pose.
    pub fn at(
        kinematics: &Kinematics,
        encoders: [f64; 3],
        motors: [f64; 3],
        load_kg: f64,
    ) -> Result<Self, PoseError> {
        let place = kinematics.forward(kinematics.geometry().angles(encoders), DVec3::NAN)?;
        Ok(Self { pull: kinematics.force(place, torques_of(motors, 1.0))?, load_kg })
    }
}

/// The zero angles with which `geometry` puts the readings where they were taken, in the mean over them.
///
/// # Errors
/// [`CalibrationError`] if there is no reading, one has no pose, or an angle is beyond ±90 degrees.
pub fn zeros(geometry: &Geometry, readings: &[PlaceReading]) -> Result<Zeros, CalibrationError> {
    if readings.is_empty() {
        return Err(CalibrationError::NoPlace);
    }
    let from_zero = Geometry { zero_deg: [0.0; 3], ..geometry.clone() };
    let kinematics = Kinematics::new(from_zero.clone());
    let mut zero_deg = [0.0; 3];
    for (n, reading) in readings.iter().enumerate() {
        let angles = kinematics.inverse(reading.place).map_err(at_reading(n))?;
        let turned = from_zero.angles(reading.counts);
        for arm in 0..3 {
            zero_deg[arm] += (angles[arm] - turned[arm]).to_degrees() / readings.len() as f64;
        }
    }
    for zero in zero_deg {
        check_range("zero_deg", zero, -90.0, 90.0)?;
    }
    Ok(Zeros { zero_deg, off_m: farthest(&Geometry { zero_deg, ..from_zero }, readings)? })
}

/// The largest distance between where readings were taken and where `geometry` puts them, m.
fn farthest(geometry: &Geometry, readings: &[PlaceReading]) -> Result<f64, CalibrationError> {
    let kinematics = Kinematics::new(geometry.clone());
    let mut distances = readings.iter().enumerate().map(|(n, reading)| {
        let found = kinematics.forward(geometry.angles(reading.counts), reading.place);
        found.map(|place| place.distance(reading.place)).map_err(at_reading(n))
    });
    distances.try_fold(0.0, |most: f64, distance| Ok(most.max(distance?)))
}

fn at_reading(n: usize) -> impl Fn(PoseError) -> CalibrationError {
    move |cause| CalibrationError::Pose { reading: n + 1, cause }
}

/// The motor strength with which the readings' pulls are their weights: by the line of least squares through them.
///
/// # Errors
/// [`CalibrationError`] if the loads do not differ, what they add is not up, or the strength is beyond 1 to 1 000 000.
pub fn strength(readings: &[LoadReading]) -> Result<Strength, CalibrationError> {
    let loads = readings.iter().map(|reading| reading.load_kg);
    let (least, most) = loads.fold((f64::INFINITY, 0.0_f64), |(a, b), load| (a.min(load), b.max(load)));
    let differ = most - least >= LEAST_LOAD_KG;
    if !differ {
        return Err(CalibrationError::SameLoads);
    }
    let count = readings.len() as f64;
    let mean_kg = readings.iter().map(|reading| reading.load_kg).sum::<f64>() / count;
    let mean_pull = readings.iter().map(|reading| reading.pull).sum::<DVec3>() / count;
    let spread: f64 = readings.iter().map(|reading| (reading.load_kg - mean_kg).powi(2)).sum();
    let along: DVec3 =
        readings.iter().map(|reading| (reading.pull - mean_pull) * (reading.load_kg - mean_kg)).sum();
    let per_kg = along / spread;
    let size = per_kg.length();
    let counts_per_nm = check_range("counts_per_nm", size / GRAVITY, 1.0, 1e6)?;
    let up = per_kg.y / size;
    if up < UPRIGHT {
        return Err(CalibrationError::NotUp { degrees: up.acos().to_degrees() });
    }
    Ok(Strength { counts_per_nm, grip_kg: mean_pull.dot(per_kg) / (size * size) - mean_kg })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn geometry() -> Geometry {
        Geometry::load("libnifalcon").unwrap()
    }

    /// What the encoders of a Falcon with these zero angles show at `place`.
    fn reading(zero_deg: [f64; 3], place: DVec3) -> PlaceReading {
        let truth = Geometry { zero_deg, ..geometry() };
        let angles = Kinematics::new(truth.clone()).inverse(place).unwrap();
        PlaceReading { counts: truth.counts(angles).map(f64::round), place }
    }

    #[test]
    fn zero_angles_are_found_to_a_count() {
        let truth = [38.0, 33.5, 36.2];
        let places =
            [DVec3::new(0.0, 0.0, 0.13), DVec3::new(0.03, -0.02, 0.12), DVec3::new(-0.02, 0.03, 0.14)];
        for count in 1..=3 {
            let readings: Vec<_> = places[..count].iter().map(|place| reading(truth, *place)).collect();
            let zeros = zeros(&geometry(), &readings).unwrap();
            for (found, truth) in zeros.zero_deg.into_iter().zip(truth) {
                assert!((found - truth).abs() < 0.5 * 0.037, "{found} in place of {truth}");
            }
            assert!(zeros.off_m < 5e-5, "{zeros:?}");
        }
    }

    /// A place that was measured wrongly shows where there are several.
    #[test]
    fn places_that_do_not_agree_are_told() {
        let mut readings = [DVec3::Z * 0.12, DVec3::Z * 0.14].map(|place| reading([35.0; 3], place)).to_vec();
        readings[1].place.z += 0.01;
        assert!(zeros(&geometry(), &readings).unwrap().off_m > 3e-3);
    }

    #[test]
    fn strength_is_found_whatever_the_grip_weighs_and_leans() {
        let tilt = DVec3::new(0.1, 1.0, -0.15).normalize();
        let pull = |load_kg| LoadReading { pull: tilt * (8000.0 * GRAVITY * (0.12 + load_kg)), load_kg };
        let found = strength(&[0.0, 0.2].map(pull)).unwrap();
        assert!((found.counts_per_nm / 8000.0 - 1.0).abs() < 1e-12, "{found:?}");
        assert!((found.grip_kg - 0.12).abs() < 1e-12, "{found:?}");
        assert_eq!(strength(&[0.0, 0.1, 0.2, 0.3].map(pull)).unwrap().counts_per_nm.round(), 8000.0);
    }

    #[test]
    fn what_gives_no_calibration_is_refused() {
        assert_eq!(zeros(&geometry(), &[]), Err(CalibrationError::NoPlace));
        let far = PlaceReading { counts: [0.0; 3], place: DVec3::Z };
        assert!(matches!(zeros(&geometry(), &[far]), Err(CalibrationError::Pose { reading: 1, .. })));
        let spun = PlaceReading { counts: [9000.0, 0.0, 0.0], place: DVec3::Z * 0.13 };
        assert!(matches!(zeros(&geometry(), &[spun]), Err(CalibrationError::Range(_))));
        let reading = |pull, load_kg| LoadReading { pull, load_kg };
        for loads in [&[][..], &[0.1], &[0.1, 0.11], &[f64::NAN, f64::NAN]] {
            let readings: Vec<_> = loads.iter().map(|load| reading(DVec3::Y, *load)).collect();
            assert_eq!(strength(&readings), Err(CalibrationError::SameLoads), "{loads:?}");
        }
        let sideways = [reading(DVec3::ZERO, 0.0), reading(DVec3::X * 1e4, 0.2)];
        assert_eq!(strength(&sideways), Err(CalibrationError::NotUp { degrees: 90.0 }));
        for still in [DVec3::ZERO, DVec3::NAN, DVec3::splat(1e300)] {
            let readings = [reading(DVec3::ZERO, 0.0), reading(still, 0.2)];
            assert!(matches!(strength(&readings), Err(CalibrationError::Range(_))), "{still}");
        }
    }

    #[test]
    fn a_moment_at_rest_reads_as_its_weight() {
        let kinematics = Kinematics::new(geometry());
        let place = DVec3::new(0.01, 0.0, 0.12);
        let torques = kinematics.torques(place, DVec3::Y * 2.0).unwrap();
        let encoders = geometry().counts(kinematics.inverse(place).unwrap());
        let motors = (torques * -6616.0).to_array();
        let reading = LoadReading::at(&kinematics, encoders, motors, 0.2).unwrap();
        assert!(reading.pull.distance(DVec3::Y * 2.0 * 6616.0) < 1e-6, "{reading:?}");
        assert!(LoadReading::at(&kinematics, [9000.0, 0.0, 0.0], motors, 0.2).is_err());
    }
}
