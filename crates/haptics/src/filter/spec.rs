//! The description of a filter, as it is written in a scene: `bartlett-hann:11@servo`.

use super::{FilterError, WindowKind};
use crate::check_range;
use std::fmt;
use std::str::FromStr;

/// Rate of the servo that a description is checked against, Hz.
pub const DEFAULT_SERVO_RATE_HZ: f64 = 1000.0;
/// Most taps of a window: 4.096 s at 1 kHz, and about 5 µs a tick.
pub const MAX_TAPS: usize = 4096;
/// Highest order of a Butterworth filter.
pub const MAX_BUTTERWORTH_ORDER: usize = 8;
/// Order of a Butterworth filter that names none.
pub const DEFAULT_BUTTERWORTH_ORDER: usize = 2;

/// Lowest cutoff of a Butterworth filter, Hz: below it one would wait for seconds.
const MIN_CUTOFF_HZ: f64 = 0.1;
/// Highest cutoff as a share of the rate; at one half a digital low pass is no filter any more.
const MAX_CUTOFF_SHARE: f64 = 0.499;

/// A filter for each use of a force that comes in frames (couplings `momentum` and `direct`): of those with at most half the
/// ripple of the thesis's window over ticks that with the least error, by `hapflow bench filters` at 60 Hz. `local` is best
/// without any.
pub const FILTER_PRESETS: [(&str, &str); 3] =
    [("jet", "one-euro:5:5"), ("crossing", "butterworth:20:1"), ("stirring", "butterworth:20:2")];

const KNOWN: &str = "none, bartlett-hann:TAPS, hann:TAPS, hamming:TAPS, blackman:TAPS, boxcar:TAPS (each with @servo or \
                     @fluid), butterworth:CUTOFF_HZ[:ORDER], one-euro:MIN_CUTOFF_HZ:BETA, and presets jet, crossing, stirring";
const WINDOW_FORM: &str = "WINDOW:TAPS[@servo|@fluid], such as bartlett-hann:11@fluid";
const BUTTERWORTH_FORM: &str = "butterworth:CUTOFF_HZ[:ORDER], such as butterworth:50:2";
const ONE_EURO_FORM: &str = "one-euro:MIN_CUTOFF_HZ:BETA, such as one-euro:5:0.5";

/// What the taps of a window are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum TapPlace {
    /// The newest forces that the servo computed, one a tick (at 1 kHz, 11 taps are 11 ms).
    #[default]
    Servo,
    /// The newest forces that the fluid computed, one a frame: the thesis as it is written. At a fluid of 60
    /// Hz, 11 taps are 183 ms, and the delay is 83 ms.
    Fluid,
}

impl fmt::Display for TapPlace {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Servo => "servo",
            Self::Fluid => "fluid",
        })
    }
}

impl FromStr for TapPlace {
    type Err = FilterError;
    fn from_str(text: &str) -> Result<Self, FilterError> {
        match text {
            "servo" => Ok(Self::Servo),
            "fluid" => Ok(Self::Fluid),
            _ => Err(FilterError::UnknownPlace { place: text.to_owned() }),
        }
    }
}

/// Which filter, with its numbers. Parsed with [`FromStr`], printed with [`Display`](fmt::Display) such that
/// it parses to the same again:
///
/// | written | filter |
/// |---|---|
/// | `none` | the force as it is |
/// | `bartlett-hann:11@fluid`, and `hann`, `hamming`, `blackman`, `boxcar` | weighted mean of the last 1 to 4096 taps |
/// | `butterworth:50:2@servo` | low pass of order 1 to 8 (default 2), cutoff 0.1 Hz to just below half the rate |
/// | `one-euro:5:0.5@servo` | one-euro filter: lowest cutoff 0.001 to 500 Hz, beta 0 to 1000 Hz/(N/s) |
///
/// Taps are `@servo` where no place is written; only windows may be `@fluid`. A name of [`FILTER_PRESETS`] is read as its filter.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum FilterSpec {
    /// No filter: what comes in goes out.
    #[default]
    None,
    /// A weighted mean of the newest taps, delayed by half its length.
    Window {
        /// Shape of the window.
        kind: WindowKind,
        /// Number of taps, 1 to [`MAX_TAPS`]; 1 is no filter.
        taps: usize,
        /// What the taps are.
        place: TapPlace,
    },
    /// A Butterworth low pass at the servo's rate: less delay than a window of equal smoothness, a little
    /// overshoot (4 % of a step at order 2).
    Butterworth {
        /// Frequency at which half the power is left (−3.01 dB), Hz.
        cutoff_hz: f64,
        /// Order, 1 to [`MAX_BUTTERWORTH_ORDER`].
        order: usize,
    },
    /// A one-euro filter at the servo's rate: smooth while the force rests, quick while it changes.
    OneEuro {
        /// Cutoff while the force rests, Hz, 0.001 to 500.
        min_cutoff_hz: f64,
        /// Rise of the cutoff with the force's rate of change, Hz/(N/s), 0 to 1000.
        beta: f64,
    },
}

impl FilterSpec {
    /// Checks every number, for a servo of `servo_rate_hz`.
    ///
    /// # Errors
    /// [`FilterError::Range`], or [`FilterError::AllZero`] for a window of two zeros (`hann:2`).
    pub fn check(&self, servo_rate_hz: f64) -> Result<(), FilterError> {
        check_range("servo_rate_hz", servo_rate_hz, 100.0, 100_000.0)?;
        match *self {
            Self::None => Ok(()),
            Self::Window { kind, taps, .. } => check_window(kind, taps),
            Self::Butterworth { cutoff_hz, order } => {
                check_range("cutoff_hz", cutoff_hz, MIN_CUTOFF_HZ, MAX_CUTOFF_SHARE * servo_rate_hz)?;
                check_range("order", order as f64, 1.0, MAX_BUTTERWORTH_ORDER as f64)?;
                Ok(())
            }
            Self::OneEuro { min_cutoff_hz, beta } => {
                check_range("min_cutoff_hz", min_cutoff_hz, 0.001, 500.0)?;
                check_range("beta", beta, 0.0, 1000.0)?;
                Ok(())
            }
        }
    }
}

fn check_window(kind: WindowKind, taps: usize) -> Result<(), FilterError> {
    check_range("taps", taps as f64, 1.0, MAX_TAPS as f64)?;
    // Windows that end in zero are nothing but their ends when they have two taps.
    if kind.weights(taps).iter().all(|weight| *weight == 0.0) {
        return Err(FilterError::AllZero { name: kind.name(), taps });
    }
    Ok(())
}

impl fmt::Display for FilterSpec {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::None => f.write_str("none"),
            Self::Window { kind, taps, place } => write!(f, "{}:{taps}@{place}", kind.name()),
            Self::Butterworth { cutoff_hz, order } => write!(f, "butterworth:{cutoff_hz}:{order}@servo"),
            Self::OneEuro { min_cutoff_hz, beta } => write!(f, "one-euro:{min_cutoff_hz}:{beta}@servo"),
        }
    }
}

impl FromStr for FilterSpec {
    type Err = FilterError;
    fn from_str(text: &str) -> Result<Self, FilterError> {
        let preset = FILTER_PRESETS.iter().find(|(name, _)| *name == text.trim());
        let (body, place) = split_place(preset.map_or(text.trim(), |(_, filter)| filter))?;
        let mut parts = body.split(':');
        let name = parts.next().unwrap_or_default();
        let spec = match (name, WindowKind::from_name(name)) {
            (_, Some(kind)) => parse_window(kind, &mut parts, place)?,
            ("none", _) => parse_none(&mut parts, place)?,
            ("butterworth", _) => parse_butterworth(&mut parts, place)?,
            ("one-euro", _) => parse_one_euro(&mut parts, place)?,
            _ => return Err(FilterError::UnknownName { name: name.to_owned(), known: KNOWN }),
        };
        spec.check(DEFAULT_SERVO_RATE_HZ)?;
        Ok(spec)
    }
}

type Parts<'a> = std::str::Split<'a, char>;

fn split_place(text: &str) -> Result<(&str, TapPlace), FilterError> {
    match text.split_once('@') {
        Some((body, place)) => Ok((body, place.parse()?)),
        None => Ok((text, TapPlace::Servo)),
    }
}

fn parse_none(parts: &mut Parts, place: TapPlace) -> Result<FilterSpec, FilterError> {
    servo_only("none", place)?;
    end(parts, "none")?;
    Ok(FilterSpec::None)
}

fn parse_window(kind: WindowKind, parts: &mut Parts, place: TapPlace) -> Result<FilterSpec, FilterError> {
    let taps = count("taps", required(parts, "taps", WINDOW_FORM)?, MAX_TAPS)?;
    end(parts, WINDOW_FORM)?;
    Ok(FilterSpec::Window { kind, taps, place })
}

fn parse_butterworth(parts: &mut Parts, place: TapPlace) -> Result<FilterSpec, FilterError> {
    servo_only("butterworth", place)?;
    let limit = MAX_CUTOFF_SHARE * DEFAULT_SERVO_RATE_HZ;
    let text = required(parts, "cutoff_hz", BUTTERWORTH_FORM)?;
    let cutoff_hz = number("cutoff_hz", text, MIN_CUTOFF_HZ, limit)?;
    let order = match parts.next() {
        Some(text) => count("order", text, MAX_BUTTERWORTH_ORDER)?,
        None => DEFAULT_BUTTERWORTH_ORDER,
    };
    end(parts, BUTTERWORTH_FORM)?;
    Ok(FilterSpec::Butterworth { cutoff_hz, order })
}

fn parse_one_euro(parts: &mut Parts, place: TapPlace) -> Result<FilterSpec, FilterError> {
    servo_only("one-euro", place)?;
    let text = required(parts, "min_cutoff_hz", ONE_EURO_FORM)?;
    let min_cutoff_hz = number("min_cutoff_hz", text, 0.001, 500.0)?;
    let beta = number("beta", required(parts, "beta", ONE_EURO_FORM)?, 0.0, 1000.0)?;
    end(parts, ONE_EURO_FORM)?;
    Ok(FilterSpec::OneEuro { min_cutoff_hz, beta })
}

fn servo_only(name: &'static str, place: TapPlace) -> Result<(), FilterError> {
    match place {
        TapPlace::Servo => Ok(()),
        TapPlace::Fluid => Err(FilterError::ServoOnly { name }),
    }
}

fn required<'a>(
    parts: &mut Parts<'a>,
    field: &'static str,
    form: &'static str,
) -> Result<&'a str, FilterError> {
    parts.next().filter(|text| !text.is_empty()).ok_or(FilterError::Missing { field, form })
}

fn end(parts: &mut Parts, form: &'static str) -> Result<(), FilterError> {
    match parts.next() {
        None => Ok(()),
        Some(part) => Err(FilterError::Surplus { part: part.to_owned(), form }),
    }
}

fn count(field: &'static str, text: &str, max: usize) -> Result<usize, FilterError> {
    let expected = "a whole number";
    text.parse().map_err(|_| FilterError::NotANumber {
        field,
        value: text.to_owned(),
        expected,
        min: 1.0,
        max: max as f64,
    })
}

fn number(field: &'static str, text: &str, min: f64, max: f64) -> Result<f64, FilterError> {
    let refused = FilterError::NotANumber { field, value: text.to_owned(), expected: "a number", min, max };
    text.parse().map_err(|_| refused)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse(text: &str) -> FilterSpec {
        text.parse().unwrap()
    }

    fn refusal(text: &str) -> String {
        text.parse::<FilterSpec>().unwrap_err().to_string()
    }

    #[test]
    fn what_is_printed_parses_to_the_same() {
        let canonical = [
            "none",
            "bartlett-hann:11@fluid",
            "bartlett-hann:11@servo",
            "hann:3@servo",
            "hamming:2@fluid",
            "blackman:4096@servo",
            "boxcar:1@fluid",
            "butterworth:50:2@servo",
            "butterworth:0.1:8@servo",
            "one-euro:1.5:0.007@servo",
        ];
        for text in canonical {
            assert_eq!(parse(text).to_string(), text);
        }
    }

    #[test]
    fn presets_are_read_as_their_filters() {
        for (name, filter) in FILTER_PRESETS {
            assert_eq!(parse(name), parse(filter));
        }
        assert!(refusal("jet:1").contains("unknown filter \"jet\""));
    }

    #[test]
    fn what_is_left_out_takes_its_default() {
        assert_eq!(parse(" bartlett-hann:11 ").to_string(), "bartlett-hann:11@servo");
        assert_eq!(parse("butterworth:50").to_string(), "butterworth:50:2@servo");
        assert_eq!(parse("one-euro:1:0").to_string(), "one-euro:1:0@servo");
        assert_eq!(FilterSpec::default(), parse("none"));
    }

    #[test]
    fn an_unknown_name_lists_the_known_ones() {
        let text = refusal("kaiser:11");
        for name in ["kaiser", "none", "bartlett-hann", "blackman", "boxcar", "butterworth", "one-euro"] {
            assert!(text.contains(name), "{text}");
        }
        assert!(refusal("").contains("known are"));
    }

    #[test]
    fn numbers_outside_their_range_are_named() {
        assert_eq!(refusal("hann:0"), "taps = 0 is outside its range 1 to 4096");
        assert_eq!(refusal("hann:4097"), "taps = 4097 is outside its range 1 to 4096");
        assert_eq!(refusal("butterworth:500"), "cutoff_hz = 500 is outside its range 0.1 to 499");
        assert_eq!(refusal("butterworth:NaN"), "cutoff_hz = NaN is outside its range 0.1 to 499");
        assert_eq!(refusal("butterworth:50:9"), "order = 9 is outside its range 1 to 8");
        assert_eq!(refusal("one-euro:0:1"), "min_cutoff_hz = 0 is outside its range 0.001 to 500");
        assert_eq!(refusal("one-euro:1:-1"), "beta = -1 is outside its range 0 to 1000");
    }

    #[test]
    fn what_is_no_number_missing_or_too_many_is_named() {
        assert_eq!(refusal("hann:x"), "taps = \"x\" is not a whole number from 1 to 4096");
        assert_eq!(refusal("hann:1.5"), "taps = \"1.5\" is not a whole number from 1 to 4096");
        assert_eq!(refusal("butterworth:fast"), "cutoff_hz = \"fast\" is not a number from 0.1 to 499");
        assert!(refusal("hann").starts_with("taps is missing: write WINDOW:TAPS"));
        assert!(refusal("hann:").starts_with("taps is missing"));
        assert!(refusal("one-euro:1").starts_with("beta is missing"));
        assert!(refusal("none:1").starts_with("\"1\" is one parameter too many"));
        assert!(refusal("butterworth:50:2:1").starts_with("\"1\" is one parameter too many"));
    }

    #[test]
    fn places_are_checked() {
        assert_eq!(refusal("hann:3@gpu"), "unknown tap place \"@gpu\"; known are @servo and @fluid");
        for text in ["butterworth:50@fluid", "one-euro:1:0@fluid", "none@fluid"] {
            assert!(refusal(text).contains("servo's rate only"));
        }
    }

    #[test]
    fn two_taps_of_zero_are_refused_and_others_are_not() {
        for text in ["hann:2", "bartlett-hann:2", "blackman:2"] {
            assert!(refusal(text).contains("no tap that is not zero"));
        }
        for text in ["hamming:2", "boxcar:2", "hann:3", "bartlett-hann:3", "blackman:3", "hann:1"] {
            parse(text);
        }
    }
}
