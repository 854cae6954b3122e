//! What the configurations of a scene's parts have in common.

use crate::caller::{Record, Text};
use crate::code::{Code, Failure};
use crate::generated as c;
use hapflow_engine::ToolShape;

/// A configuration of something that a scene has any number of.
pub trait Part: Record {
    /// What the engine has for it.
    type Thing;

    /// What the init function writes: the engine's own defaults.
    const DEFAULT: Self;

    /// The thing; whether its numbers are in their ranges, the engine says.
    fn thing(&self) -> Result<Self::Thing, Failure>;
}

/// A name; without one, empty.
pub fn name(text: Text) -> Result<String, Code> {
    if text.is_null() { Ok(String::new()) } else { Ok(text.read()?.into()) }
}

pub fn shape(number: u32) -> Result<ToolShape, Failure> {
    match number {
        c::HAPFLOW_SHAPE_SPHERE => Ok(ToolShape::Sphere),
        c::HAPFLOW_SHAPE_DISC => Ok(ToolShape::Disc),
        other => {
            let text = format!("shape = {other}: must be HAPFLOW_SHAPE_SPHERE or HAPFLOW_SHAPE_DISC");
            Err(Failure { code: Code::ERROR_UNSUPPORTED, text })
        }
    }
}

/// 0 or 1.
pub fn flag(field: &str, number: u32) -> Result<bool, Failure> {
    match number {
        0 => Ok(false),
        1 => Ok(true),
        other => {
            let text = format!("{field} = {other}: must be 0 or 1");
            Err(Failure { code: Code::ERROR_UNSUPPORTED, text })
        }
    }
}

pub fn unreserved(number: u32) -> Result<(), Code> {
    if number == 0 { Ok(()) } else { Err(Code::ERROR_UNSUPPORTED) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::obstacle_config::ObstacleConfig;
    use crate::source_config::SourceConfig;
    use crate::tool_config::ToolConfig;
    use hapflow_engine::{Obstacle, ToolSettings};
    use hapflow_fluid::Source;

    #[test]
    fn the_defaults_are_the_engines() {
        let named = |thing: Result<_, Failure>| thing.map_err(|f| f.text).unwrap();
        assert_eq!(named(SourceConfig::DEFAULT.thing()), Source { name: String::new(), ..Source::default() });
        let obstacle = ObstacleConfig::DEFAULT.thing().map_err(|f| f.text).unwrap();
        assert_eq!(obstacle, Obstacle { name: String::new(), ..Obstacle::default() });
        let tool = ToolConfig::DEFAULT.thing().map_err(|f| f.text).unwrap();
        assert_eq!(tool, ToolSettings { name: String::new(), ..ToolSettings::default() });
    }
}
