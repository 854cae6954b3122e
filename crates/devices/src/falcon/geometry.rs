//! Lengths, angles and ratios of a Falcon, and the files that carry them.

use crate::read_text_at_most;
use hapflow_haptics::{RangeError, check_range};
use std::path::Path;
use toml::{Table, Value};

/// The shipped parameter sets.
const SHIPPED: [(&str, &str); 2] = [
    ("libnifalcon", include_str!("../../falcon/libnifalcon.toml")),
    ("martin", include_str!("../../falcon/martin.toml")),
];

/// The largest parameter file that is read, bytes.
const MAX_FILE_BYTES: u64 = 65_536;

/// The parameters of one Falcon. Each leg is an arm that turns about an axis of the base, and a parallelogram
/// from its elbow to the grip.
#[derive(Clone, Debug, PartialEq)]
pub struct Geometry {
    /// From an arm's axis to its elbow, m, 0.001 to 1.
    pub arm_m: f64,
    /// Length of the parallelogram, m, 0.001 to 1.
    pub link_m: f64,
    /// Offset pieces at the parallelogram's two ends, together, m, 0 to 0.5.
    pub link_offset_m: f64,
    /// Radius at which the arms' axes lie less that at which the links hold the grip, m, ±0.5.
    pub radial_offset_m: f64,
    /// The same, sideways, m, ±0.1.
    pub lateral_offset_m: f64,
    /// Directions of the legs about z, from x towards y: top, right, left; degrees, ±360.
    pub azimuth_deg: [f64; 3],
    /// Arm angles at encoder count 0, from the base's plane towards z, degrees, ±90.
    pub zero_deg: [f64; 3],
    /// Encoder counts a motor turn, 1 to 1 000 000.
    pub encoder_counts: f64,
    /// Motor turns an arm turn, 0.1 to 1000.
    pub gear_ratio: f64,
    /// Motor counts a newton metre at an arm's axis, 1 to 1 000 000.
    pub counts_per_nm: f64,
}

/// Why a parameter set was refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum GeometryError {
    /// Neither a shipped name nor a file that can be read.
    #[error(
        "geometry {name}: no shipped set has that name ({known}), and as a file it cannot be read, {cause}"
    )]
    Open {
        /// What was asked for.
        name: String,
        /// The shipped names.
        known: String,
        /// What the system says.
        cause: String,
    },
    /// The file is no TOML.
    #[error("geometry {file}: {cause}")]
    Syntax {
        /// The file.
        file: String,
        /// What is wrong with it, with its line.
        cause: String,
    },
    /// A key that is missing, unknown, or no number.
    #[error("geometry {file}: {key} {problem}")]
    Key {
        /// The file.
        file: String,
        /// The key.
        key: String,
        /// What is wrong with it.
        problem: &'static str,
    },
    /// A number outside its range.
    #[error("geometry {file}: {cause}")]
    Range {
        /// The file.
        file: String,
        /// The number.
        cause: RangeError,
    },
}

impl Geometry {
    /// Names of the shipped sets, the default first.
    pub const NAMES: [&str; SHIPPED.len()] = [SHIPPED[0].0, SHIPPED[1].0];

    /// The shipped set of that name, or the one in that file.
    ///
    /// # Errors
    /// [`GeometryError`] with file, key, value and what is allowed.
    pub fn load(name: &str) -> Result<Self, GeometryError> {
        if let Some((_, text)) = SHIPPED.into_iter().find(|(known, _)| *known == name) {
            return Self::parse(text, name);
        }
        let text =
            read_text_at_most(Path::new(name), MAX_FILE_BYTES).map_err(|cause| GeometryError::Open {
                name: name.to_owned(),
                known: Self::NAMES.join(", "),
                cause: cause.to_string(),
            })?;
        Self::parse(&text, name)
    }

    /// Reads the text of a parameter file; `file` is for errors.
    ///
    /// # Errors
    /// As [`load`](Self::load).
    pub fn parse(text: &str, file: &str) -> Result<Self, GeometryError> {
        let table: Table = text.parse().map_err(|cause: toml::de::Error| GeometryError::Syntax {
            file: file.to_owned(),
            cause: cause.to_string().trim_end().replace('\n', " "),
        })?;
        let mut keys = Keys { file, table };
        let geometry = Self {
            arm_m: keys.number("arm_m")?,
            link_m: keys.number("link_m")?,
            link_offset_m: keys.number("link_offset_m")?,
            radial_offset_m: keys.number("radial_offset_m")?,
            lateral_offset_m: keys.number("lateral_offset_m")?,
            azimuth_deg: keys.three("azimuth_deg")?,
            zero_deg: keys.three("zero_deg")?,
            encoder_counts: keys.number("encoder_counts")?,
            gear_ratio: keys.number("gear_ratio")?,
            counts_per_nm: keys.number("counts_per_nm")?,
        };
        keys.end()?;
        geometry.check().map_err(|cause| GeometryError::Range { file: file.to_owned(), cause })?;
        Ok(geometry)
    }

    /// The text of a parameter file, which [`parse`](Self::parse) reads back to the bit.
    pub fn text(&self) -> String {
        let three = |values: [f64; 3]| format!("{values:?}");
        [
            ("arm_m", self.arm_m.to_string()),
            ("link_m", self.link_m.to_string()),
            ("link_offset_m", self.link_offset_m.to_string()),
            ("radial_offset_m", self.radial_offset_m.to_string()),
            ("lateral_offset_m", self.lateral_offset_m.to_string()),
            ("azimuth_deg", three(self.azimuth_deg)),
            ("zero_deg", three(self.zero_deg)),
            ("encoder_counts", self.encoder_counts.to_string()),
            ("gear_ratio", self.gear_ratio.to_string()),
            ("counts_per_nm", self.counts_per_nm.to_string()),
        ]
        .map(|(key, value)| format!("{key} = {value}\n"))
        .concat()
    }

    /// Checks every number.
    ///
    /// # Errors
    /// [`RangeError`] for the first that is outside its range.
    pub fn check(&self) -> Result<(), RangeError> {
        check_range("arm_m", self.arm_m, 0.001, 1.0)?;
        check_range("link_m", self.link_m, 0.001, 1.0)?;
        check_range("link_offset_m", self.link_offset_m, 0.0, 0.5)?;
        check_range("radial_offset_m", self.radial_offset_m, -0.5, 0.5)?;
        check_range("lateral_offset_m", self.lateral_offset_m, -0.1, 0.1)?;
        for (azimuth, zero) in self.azimuth_deg.into_iter().zip(self.zero_deg) {
            check_range("azimuth_deg", azimuth, -360.0, 360.0)?;
            check_range("zero_deg", zero, -90.0, 90.0)?;
        }
        check_range("encoder_counts", self.encoder_counts, 1.0, 1e6)?;
        check_range("gear_ratio", self.gear_ratio, 0.1, 1000.0)?;
        check_range("counts_per_nm", self.counts_per_nm, 1.0, 1e6)?;
        Ok(())
    }

    /// Arm angles at these encoder counts, rad.
    pub fn angles<C: Into<f64> + Copy>(&self, counts: [C; 3]) -> [f64; 3] {
        let per_count = self.deg_per_count();
        std::array::from_fn(|leg| (self.zero_deg[leg] + per_count * counts[leg].into()).to_radians())
    }

    /// The encoder counts at these arm angles (rad), not rounded.
    pub fn counts(&self, angles: [f64; 3]) -> [f64; 3] {
        let per_count = self.deg_per_count();
        std::array::from_fn(|leg| (angles[leg].to_degrees() - self.zero_deg[leg]) / per_count)
    }

    fn deg_per_count(&self) -> f64 {
        360.0 / (self.encoder_counts * self.gear_ratio)
    }
}

/// A file's keys, each of which is taken once.
struct Keys<'a> {
    file: &'a str,
    table: Table,
}

impl Keys<'_> {
    fn error(&self, key: &str, problem: &'static str) -> GeometryError {
        GeometryError::Key { file: self.file.to_owned(), key: key.to_owned(), problem }
    }

    fn take(&mut self, key: &str) -> Result<Value, GeometryError> {
        self.table.remove(key).ok_or_else(|| self.error(key, "is missing"))
    }

    fn number(&mut self, key: &str) -> Result<f64, GeometryError> {
        let value = self.take(key)?;
        number(&value).ok_or_else(|| self.error(key, "must be a number"))
    }

    fn three(&mut self, key: &str) -> Result<[f64; 3], GeometryError> {
        let value = self.take(key)?;
        let numbers: Option<Vec<f64>> = value.as_array().and_then(|a| a.iter().map(number).collect());
        numbers
            .and_then(|n| n.try_into().ok())
            .ok_or_else(|| self.error(key, "must be three numbers [top, right, left]"))
    }

    /// Nothing may be left over: a key that is misspelt would otherwise do nothing.
    fn end(&self) -> Result<(), GeometryError> {
        match self.table.keys().next() {
            Some(key) => Err(self.error(key, "is not known")),
            None => Ok(()),
        }
    }
}

fn number(value: &Value) -> Option<f64> {
    value.as_float().or_else(|| value.as_integer().map(|n| n as f64))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shipped_sets_are_sound_and_written_back_to_the_bit() {
        for name in Geometry::NAMES {
            let geometry = Geometry::load(name).unwrap();
            assert_eq!(Geometry::parse(&geometry.text(), "text"), Ok(geometry));
        }
    }

    #[test]
    fn one_count_is_the_known_angle() {
        let geometry = Geometry::load("libnifalcon").unwrap();
        assert!((geometry.deg_per_count() - 0.0364346591).abs() < 1e-10);
        let back = geometry.counts(geometry.angles([0, 1200, -1300]));
        for (counts, expected) in back.into_iter().zip([0.0, 1200.0, -1300.0]) {
            assert!((counts - expected).abs() < 1e-9, "{counts}");
        }
    }

    #[test]
    fn what_is_wrong_is_named() {
        let text = Geometry::load("martin").unwrap().text();
        let refuse = |from: &str, to: &str| {
            assert!(text.contains(from));
            Geometry::parse(&text.replace(from, to), "mine.toml").unwrap_err().to_string()
        };
        assert_eq!(refuse("arm_m = 0.06\n", ""), "geometry mine.toml: arm_m is missing");
        assert_eq!(refuse("arm_m", "arms_m"), "geometry mine.toml: arm_m is missing");
        assert_eq!(
            refuse("gear_ratio = 7.62", "gear_ratio = \"x\""),
            "geometry mine.toml: gear_ratio must be a number"
        );
        assert_eq!(
            refuse("gear_ratio = 7.62", "gear_ratio = 0"),
            "geometry mine.toml: gear_ratio = 0 is outside its range 0.1 to 1000"
        );
        assert!(refuse("gear_ratio = 7.62", "gear_ratio = nan").contains("NaN is outside"));
        assert!(refuse("[50.0, 50.0, 50.0]", "[50.0, 50.0]").contains("zero_deg must be three numbers"));
        assert!(refuse("arm_m = 0.06", "arm_m = 0.06\nleg_m = 1").contains("leg_m is not known"));
        assert!(refuse("arm_m = 0.06", "arm_m = ").contains("line 1"));
        let absent = Geometry::load("novint").unwrap_err().to_string();
        assert!(absent.contains("(libnifalcon, martin)"), "{absent}");
    }
}
