//! The ways from a fluid to a hand that are compared.

use crate::ValidationError;
use hapflow_engine::Scene;
use hapflow_haptics::{CouplingKind, FilterSpec};

/// A coupling with a filter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Way {
    pub coupling: CouplingKind,
    /// None takes the coupling's own.
    pub filter: Option<FilterSpec>,
}

/// Words for the ways that `--set coupling=` may pick.
pub(crate) const WORDS: &[&str] = &["all", "momentum", "direct", "local"];

/// Filters that each coupling is tried with.
const FILTERS: [&str; 5] = [
    "none",
    "bartlett-hann:11@fluid",
    "bartlett-hann:11@servo",
    "butterworth:50:2@servo",
    "one-euro:5:0.5@servo",
];

/// The thesis's window, whose taps are ticks or fluid frames.
fn thesis(place: &str) -> Result<Way, ValidationError> {
    let filter = format!("bartlett-hann:11@{place}").parse().map_err(hapflow_engine::SceneError::from)?;
    Ok(Way { coupling: CouplingKind::Momentum, filter: Some(filter) })
}

impl Way {
    /// The thesis's coupling with the window over ticks, which others are measured against.
    pub fn baseline() -> Result<Self, ValidationError> {
        thesis("servo")
    }

    /// Every coupling with every filter, or with `quick` as they are meant.
    pub fn all(quick: bool) -> Result<Vec<Self>, ValidationError> {
        if quick {
            return Self::named("all");
        }
        let mut ways = Vec::new();
        for coupling in CouplingKind::ALL {
            for text in FILTERS {
                let filter = Some(text.parse().map_err(hapflow_engine::SceneError::from)?);
                ways.push(Self { coupling, filter });
            }
        }
        Ok(ways)
    }

    /// Coupling and filter.
    pub fn name(&self) -> String {
        match self.filter {
            None | Some(FilterSpec::None) => self.coupling.name().into(),
            Some(filter) => format!("{} {filter}", self.coupling.name()),
        }
    }

    /// The ways of one word.
    pub fn named(word: &str) -> Result<Vec<Self>, ValidationError> {
        let kinds = CouplingKind::ALL.into_iter().filter(|kind| word == "all" || word == kind.name());
        let mut ways = Vec::new();
        for coupling in kinds {
            match coupling {
                CouplingKind::Momentum => ways.extend([thesis("fluid")?, thesis("servo")?]),
                _ => ways.push(Self { coupling, filter: None }),
            }
        }
        Ok(ways)
    }

    /// `scene`, felt this way with a factor of `gain` on the force.
    pub fn scene(&self, scene: &Scene, gain: f64) -> Scene {
        let mut scene = scene.clone();
        (scene.run.coupling, scene.run.filter) = (self.coupling, self.filter);
        scene.tool.force_scale = gain;
        scene
    }
}
