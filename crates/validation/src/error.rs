//! What the suite refuses, and why.

use hapflow_engine::SceneError;
use hapflow_fluid::FluidError;

/// A case, a parameter or a value that cannot be.
#[derive(Debug, thiserror::Error)]
pub enum ValidationError {
    /// No case of that name.
    #[error("no case \"{name}\"{hint}")]
    UnknownCase {
        /// What was asked for.
        name: String,
        /// The nearest name, or where to find them.
        hint: String,
    },
    /// No chosen case has that parameter.
    #[error("no parameter \"{name}\" in {cases}{hint}")]
    UnknownParameter {
        /// What was asked for.
        name: String,
        /// The cases that were chosen.
        cases: String,
        /// The nearest name, or where to find them.
        hint: String,
    },
    /// A value that does not fit a parameter.
    #[error("{case}.{name} = {value}: must be {expected}")]
    BadValue {
        /// The case.
        case: &'static str,
        /// The parameter.
        name: &'static str,
        /// The value.
        value: String,
        /// What it must be.
        expected: String,
    },
    /// A spacing that no fluid may have.
    #[error("--dx {0}: must be a number from {lowest} to {highest} m", lowest = .1[0], highest = .1[1])]
    Spacing(f64, [f64; 2]),
    /// `--set` without `=`.
    #[error("--set {0}: write it as NAME=VALUE, for example radius=0.05 or fluid.artificial_viscosity=0.01")]
    NotASetting(String),
    /// A setting that the case itself makes.
    #[error("{case} sets {path} = {value} itself: leave it out, or say it by the case's own parameters")]
    Owned {
        /// The case.
        case: &'static str,
        /// The setting.
        path: String,
        /// The value that the case gives it.
        value: String,
    },
    /// A setting of the scene's table.
    #[error(transparent)]
    Setting(#[from] SceneError),
    /// What the fluid refuses of a benchmark.
    #[error(transparent)]
    Bench(#[from] FluidError),
    /// What the fluid refuses.
    #[error("{case} at dx = {dx} m: {cause}")]
    Fluid {
        /// The case.
        case: &'static str,
        /// Spacing, m.
        dx: f64,
        /// Why.
        cause: FluidError,
    },
}

impl ValidationError {
    /// True where the fluid is not made for the case: a solver that needs a free surface, say.
    pub fn is_unsupported(&self) -> bool {
        matches!(self, Self::Fluid { cause: FluidError::Unsupported { .. }, .. })
    }
}
