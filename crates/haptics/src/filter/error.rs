//! Why a filter was refused.

use crate::RangeError;

/// Why the description of a filter was refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FilterError {
    /// A name that no filter has.
    #[error("unknown filter \"{name}\"; known are {known}")]
    UnknownName {
        /// What was written.
        name: String,
        /// Every form that is understood.
        known: &'static str,
    },
    /// Something other than `servo` or `fluid` behind the `@`.
    #[error("unknown tap place \"@{place}\"; known are @servo and @fluid")]
    UnknownPlace {
        /// What was written.
        place: String,
    },
    /// A filter without taps was put at the fluid's frames.
    #[error(
        "{name} runs at the servo's rate only: write @servo or leave the place out; only windows take @fluid"
    )]
    ServoOnly {
        /// Name of the filter.
        name: &'static str,
    },
    /// A parameter that must be given was left out.
    #[error("{field} is missing: write {form}")]
    Missing {
        /// Name of the parameter.
        field: &'static str,
        /// How the filter is written.
        form: &'static str,
    },
    /// More parameters than the filter has.
    #[error("\"{part}\" is one parameter too many: write {form}")]
    Surplus {
        /// The first parameter that is too many.
        part: String,
        /// How the filter is written.
        form: &'static str,
    },
    /// A parameter that cannot be read as a number.
    #[error("{field} = \"{value}\" is not {expected} from {min} to {max}")]
    NotANumber {
        /// Name of the parameter.
        field: &'static str,
        /// What was written.
        value: String,
        /// What sort of number it must be.
        expected: &'static str,
        /// Smallest allowed.
        min: f64,
        /// Largest allowed.
        max: f64,
    },
    /// A number outside its range.
    #[error(transparent)]
    Range(#[from] RangeError),
    /// A window so short that every tap of it is zero.
    #[error("{name}:{taps} has no tap that is not zero; use 1 tap (no filter) or at least 3")]
    AllZero {
        /// Name of the window.
        name: &'static str,
        /// Its taps.
        taps: usize,
    },
}
