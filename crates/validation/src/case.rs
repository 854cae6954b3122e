//! A case: a flow with a known answer.

use crate::run::Report;
use crate::{Setup, ValidationError};
use hapflow_engine::settings::Kind;

/// A physical parameter of a case.
#[derive(Clone, Copy, Debug)]
pub struct Parameter {
    /// Name, as `--set` addresses it.
    pub name: &'static str,
    /// Unit; empty for none.
    pub unit: &'static str,
    /// Its value if nobody says otherwise, as it is written on the command line.
    pub default: &'static str,
    /// What it may be.
    pub kind: Kind,
    /// What it is.
    pub about: &'static str,
}

impl Parameter {
    /// A number from `min` to `max`.
    pub(crate) const fn number(
        name: &'static str,
        unit: &'static str,
        default: &'static str,
        [min, max]: [f64; 2],
        about: &'static str,
    ) -> Self {
        Self { name, unit, default, kind: Kind::Number { min, max }, about }
    }

    /// A whole number from `min` to `max`.
    pub(crate) const fn whole(
        name: &'static str,
        default: &'static str,
        [min, max]: [f64; 2],
        about: &'static str,
    ) -> Self {
        Self { name, unit: "", default, kind: Kind::Integer { min, max }, about }
    }

    /// One of `words`.
    pub(crate) const fn word(
        name: &'static str,
        default: &'static str,
        words: &'static [&'static str],
        about: &'static str,
    ) -> Self {
        Self { name, unit: "", default, kind: Kind::Choice(words), about }
    }

    /// Rest density of the fluid, which most cases let be chosen.
    pub(crate) const DENSITY: Self =
        Self::number("density", "kg/m³", "1000", [1.0, 20_000.0], "Rest density of the fluid.");
}

/// Parameters of a case that are also run by default, and their values.
pub type Variant = &'static [(&'static str, &'static str)];

/// A flow with a known answer.
#[derive(Clone, Copy, Debug)]
pub struct Case {
    /// Its name.
    pub name: &'static str,
    /// What it is, in a line.
    pub about: &'static str,
    /// Where its reference comes from.
    pub source: &'static str,
    /// Its physical parameters.
    pub parameters: &'static [Parameter],
    /// The parameter that spacings are a share of, so that a case costs the same at every size.
    pub length: &'static str,
    /// Spacings in it. The goals are for the first, the shipped one; the finer ones show how errors fall.
    pub cells: [f64; 3],
    /// Further settings that are run at the shipped spacing when nobody chooses these parameters; the first
    /// stands for the defaults, and is run at every spacing.
    pub variants: &'static [Variant],
    /// Runs it.
    pub(crate) run: fn(&Setup<'_>) -> Result<Report, ValidationError>,
}
