//! What the configurations of a scene's parts have in common.

use crate::caller::{Record, Text};
use crate::code::{Code, Failure};
use crate::generated as c;
use crate::session::finite;
use glam::DVec3;
use hapflow_engine::{Form, FormKind};
use std::ffi::c_void;

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

/// The shape that a config gives, by the fields that all with a shape have.
macro_rules! form_of {
    ($config:expr) => {{
        let config = $config;
        let lengths = [config.radius, config.thickness, config.length, config.scale];
        $crate::part::form(config.shape, lengths, config.extent, config.file)
    }};
}
pub(crate) use form_of;

/// The shape of this number, of a radius, a thickness, a length, a scale and an extent; its mesh is read here.
pub fn form(shape: u32, lengths: [f64; 4], extent: [f64; 3], file: Text) -> Result<Form, Failure> {
    let [radius, thickness, length, scale] = lengths;
    finite("radius, thickness, length, scale", &lengths)?;
    finite("extent", &extent)?;
    let mut form = Form::ball(radius);
    (form.kind, form.thickness, form.length, form.size) =
        (kind(shape)?, thickness, length, DVec3::from(extent));
    form.set_scale(scale);
    let file = name(file)?;
    let refused =
        |what| Failure { code: Code::ERROR_VALUE, text: format!("file = \"{file}\": must be {what}") };
    form.set_file(&file).map_err(refused)?;
    Ok(form)
}

fn kind(shape: u32) -> Result<FormKind, Failure> {
    match shape {
        c::HAPFLOW_SHAPE_SPHERE => Ok(FormKind::Sphere),
        c::HAPFLOW_SHAPE_DISC => Ok(FormKind::Disc),
        c::HAPFLOW_SHAPE_CYLINDER => Ok(FormKind::Cylinder),
        c::HAPFLOW_SHAPE_CAPSULE => Ok(FormKind::Capsule),
        c::HAPFLOW_SHAPE_BOX => Ok(FormKind::Box),
        c::HAPFLOW_SHAPE_MESH => Ok(FormKind::Mesh),
        other => {
            let text = format!("shape = {other}: must be HAPFLOW_SHAPE_SPHERE (1) to HAPFLOW_SHAPE_MESH (6)");
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

pub fn null(pointer: *const c_void) -> Result<(), Code> {
    if pointer.is_null() { Ok(()) } else { Err(Code::ERROR_UNSUPPORTED) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body_config::BodyConfig;
    use crate::obstacle_config::ObstacleConfig;
    use crate::source_config::SourceConfig;
    use crate::tool_config::ToolConfig;
    use hapflow_engine::{FreeBody, Obstacle, ToolSettings};
    use hapflow_fluid::Source;

    #[test]
    fn the_defaults_are_the_engines() {
        let named = |thing: Result<_, Failure>| thing.map_err(|f| f.text).unwrap();
        assert_eq!(named(SourceConfig::DEFAULT.thing()), Source { name: String::new(), ..Source::default() });
        let obstacle = ObstacleConfig::DEFAULT.thing().map_err(|f| f.text).unwrap();
        assert_eq!(obstacle, Obstacle { name: String::new(), ..Obstacle::default() });
        let body = BodyConfig::DEFAULT.thing().map_err(|f| f.text).unwrap();
        assert_eq!(body, FreeBody { name: String::new(), ..FreeBody::default() });
        let tool = ToolConfig::DEFAULT.thing().map_err(|f| f.text).unwrap();
        assert_eq!(tool, ToolSettings { name: String::new(), ..ToolSettings::default() });
    }
}
