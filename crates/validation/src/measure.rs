//! What a case measured, and what it is compared with.

use hapflow_engine::Scene;

/// What a measured value is compared with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Target {
    /// A known value that is not 0; the error is relative.
    Value(f64),
    /// Nothing; the error is in units of `scale`, which is in the quantity's own unit.
    Zero {
        /// The scale.
        scale: f64,
    },
    /// Its own limit as the spacing goes to nothing; the error is relative.
    Limit,
}

/// A measured quantity.
#[derive(Clone, Debug, PartialEq)]
pub struct Measure {
    /// Its name.
    pub quantity: &'static str,
    /// Its unit; "1" for a number.
    pub unit: &'static str,
    /// What was measured.
    pub measured: f64,
    /// What it should be.
    pub target: Target,
    /// Largest error that is good enough, if there is a goal.
    pub goal: Option<f64>,
    /// Least observed order that the goal asks for.
    pub least_order: Option<f64>,
    /// How it was felt, if it was.
    pub felt: Option<Felt>,
}

/// How a force was felt. The measure's own goal is then what it must reach at least.
#[derive(Clone, Debug, PartialEq)]
pub struct Felt {
    /// The coupling.
    pub coupling: &'static str,
    /// The filter.
    pub filter: String,
    /// Fluid frames a second, Hz.
    pub fluid_hz: f64,
    /// The hand.
    pub hand: String,
    /// The same figure for the truth's own seeds, each against the others, where it has several.
    pub floor: Option<f64>,
    /// Largest error that is as good as is wished.
    pub goal: Option<f64>,
}

impl Felt {
    /// As `scene` is felt in a hand of that name.
    pub(crate) fn of(scene: &Scene, hand: &str, floor: Option<f64>, goal: Option<f64>) -> Self {
        Self {
            coupling: scene.run.coupling.name(),
            filter: scene.filter().to_string(),
            fluid_hz: scene.run.fluid_hz,
            hand: hand.into(),
            floor,
            goal,
        }
    }
}

impl Measure {
    /// `measured` against the known value `reference`.
    pub(crate) fn new(quantity: &'static str, unit: &'static str, measured: f64, reference: f64) -> Self {
        let target = Target::Value(reference);
        Self { quantity, unit, measured, target, goal: None, least_order: None, felt: None }
    }

    /// `measured` against 0, in units of `scale`.
    pub(crate) fn zero(quantity: &'static str, unit: &'static str, measured: f64, scale: f64) -> Self {
        Self { target: Target::Zero { scale }, ..Self::new(quantity, unit, measured, 0.0) }
    }

    /// `measured` against its own limit at spacing 0.
    pub(crate) fn limit(quantity: &'static str, unit: &'static str, measured: f64) -> Self {
        Self { target: Target::Limit, ..Self::new(quantity, unit, measured, 0.0) }
    }

    /// With a goal for the error.
    pub(crate) fn goal(self, goal: f64) -> Self {
        Self { goal: Some(goal), ..self }
    }

    /// With a goal for the observed order too.
    pub(crate) fn order_at_least(self, order: f64) -> Self {
        Self { least_order: Some(order), ..self }
    }
}
