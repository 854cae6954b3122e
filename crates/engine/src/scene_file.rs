//! Reading a scene from TOML, and writing it. Every error names the file, the line, the field, the value and what it must be.

use crate::builtin;
use crate::scene::{Change, Scene};
use crate::scene_builder::{FARTHEST_M, LATEST_S};
use crate::settings::{self, Named};
use crate::{SceneError, Value};
use glam::DVec3;
use hapflow_devices::{HandPreset, HandSettings, Segment};
use hapflow_fluid::Aabb;
use std::path::Path;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// Reads the scene in `text`; `file` names it in errors.
///
/// # Errors
/// The first thing that is wrong.
pub fn parse(text: &str, file: &str) -> Result<Scene, SceneError> {
    let reader = Reader { text, file };
    let root =
        DeTable::parse(text).map_err(|e| reader.error_at(e.span().map_or(0, |s| s.start), e.message()))?;
    let mut scene = Scene { name: file.to_string(), ..Scene::default() };
    // What has a name first: settings and changes address them by name.
    for key in NAMED {
        if let Some((at, value)) = root.get_ref().get_key_value(key) {
            reader.section(&mut scene, at.get_ref(), value)?;
        }
    }
    for (key, value) in root.get_ref() {
        if !NAMED.contains(&key.get_ref().as_ref()) {
            reader.section(&mut scene, key.get_ref(), value)?;
        }
    }
    scene.changes.sort_by(|a, b| a.at_s.total_cmp(&b.at_s));
    scene.check().map_err(|e| reader.error_at(reader.line_of(&e), &e.to_string()))?;
    Ok(scene)
}

struct Reader<'a> {
    text: &'a str,
    file: &'a str,
}

type Item<'i> = Spanned<DeValue<'i>>;

/// The tables that are not settings.
const SECTIONS: [&str; 8] = ["container", "bounds", "source", "obstacle", "body", "pool", "sink", "change"];

/// Those that are read first.
const NAMED: [&str; 5] = ["source", "obstacle", "body", "tool", "hand"];

impl Reader<'_> {
    fn error_at(&self, offset: usize, what: &str) -> SceneError {
        let before = self.text.get(..offset).unwrap_or(self.text);
        let line = before.bytes().filter(|b| *b == b'\n').count() + 1;
        SceneError::File { file: self.file.into(), line, what: what.trim().replace('\n', "; ") }
    }

    fn wrong<T>(&self, item: &Item<'_>, what: &str) -> Result<T, SceneError> {
        Err(self.error_at(item.span().start, what))
    }

    /// Where the setting that `error` names stands in the file, as far as can be told.
    fn line_of(&self, error: &SceneError) -> usize {
        let message = error.to_string();
        let field = message.split(" = ").next().unwrap_or("").rsplit(['.', ' ']).next().unwrap_or("");
        let found = self.text.match_indices(field).find(|(at, _)| {
            let rest = self.text[at + field.len()..].trim_start();
            !field.is_empty() && rest.starts_with('=')
        });
        found.map_or(0, |(at, _)| at)
    }

    fn section(&self, scene: &mut Scene, key: &str, item: &Item<'_>) -> Result<(), SceneError> {
        match (key, item.get_ref()) {
            ("name", _) => scene.name = self.text_of(key, item)?,
            ("about", _) => scene.about = self.text_of(key, item)?,
            ("ground", _) => scene.ground = Some(self.number(key, item, -FARTHEST_M, FARTHEST_M)?),
            ("bounds", DeValue::Table(t)) => scene.bounds = self.aabb(key, item, t)?,
            ("container", DeValue::Table(t)) => {
                let mut corners = t.clone();
                if let Some(shape) = corners.remove("shape") {
                    let result = settings::set(scene, "container.shape", &self.value(&shape)?);
                    result.map_err(|e| self.error_at(shape.span().start, &e.to_string()))?;
                }
                if !corners.is_empty() || t.is_empty() {
                    scene.container = Some(self.aabb(key, item, &corners)?);
                }
            }
            ("pool", DeValue::Array(list)) => scene.pools = self.boxes(key, list)?,
            ("sink", DeValue::Array(list)) => scene.sinks = self.boxes(key, list)?,
            ("source", DeValue::Array(list)) => scene.sources = self.named(list)?,
            ("obstacle", DeValue::Array(list)) => scene.obstacles = self.named(list)?,
            ("body", DeValue::Array(list)) => scene.bodies = self.named(list)?,
            ("periodic", DeValue::Array(list)) => scene.periodic = self.axes(list)?,
            ("tool", DeValue::Array(list)) => {
                scene.more_tools = self.named(list)?;
                if !scene.more_tools.is_empty() {
                    scene.tool = scene.more_tools.remove(0);
                }
            }
            ("change", DeValue::Array(list)) => {
                for change in list.iter() {
                    let change = self.change(scene, change)?;
                    scene.changes.push(change);
                }
            }
            ("hand", DeValue::Table(t)) => self.hand(scene, t)?,
            (section, DeValue::Table(t)) if !SECTIONS.contains(&section) => {
                let field = |(name, value)| (format!("{section}.{}", Spanned::get_ref(name)), value);
                let mut fields: Vec<(String, &Item<'_>)> = t.iter().map(field).collect();
                fields.sort_by_key(|(path, _)| !settings::is_shorthand(path));
                for (path, value) in fields {
                    let value_at = value.span().start;
                    let given = self.located(&path, self.value(value)?);
                    let result = settings::set(scene, &path, &given);
                    result.map_err(|e| self.error_at(value_at, &e.to_string()))?;
                }
            }
            _ => return self.wrong(item, &unknown_section(key)),
        }
        Ok(())
    }

    fn value(&self, item: &Item<'_>) -> Result<Value, SceneError> {
        let number = |text: &str| text.replace('_', "").parse().unwrap_or(f64::NAN);
        Ok(match item.get_ref() {
            DeValue::String(s) => Value::Text(s.to_string()),
            DeValue::Boolean(b) => Value::Bool(*b),
            DeValue::Integer(i) => Value::Number(number(&i.to_string())),
            DeValue::Float(f) => Value::Number(number(&f.to_string())),
            DeValue::Array(list) if list.len() == 3 => {
                let mut v = DVec3::ZERO;
                for (axis, item) in list.iter().enumerate() {
                    v[axis] = self.value(item)?.number();
                }
                if v.is_nan() {
                    return self.wrong(item, "three numbers [x, y, z] expected");
                }
                Value::Vector(v)
            }
            _ => return self.wrong(item, "a number, a text, true, false or [x, y, z] expected"),
        })
    }

    fn number(&self, key: &str, item: &Item<'_>, min: f64, max: f64) -> Result<f64, SceneError> {
        match self.value(item)? {
            Value::Number(n) if n >= min && n <= max => Ok(n),
            other => self.wrong(item, &format!("{key} = {other}: must be a number from {min} to {max}")),
        }
    }

    fn text_of(&self, key: &str, item: &Item<'_>) -> Result<String, SceneError> {
        match self.value(item)? {
            Value::Text(t) => Ok(t),
            other => self.wrong(item, &format!("{key} = {other}: must be a text in quotes")),
        }
    }

    fn vector(&self, key: &str, item: &Item<'_>, limit: f64) -> Result<DVec3, SceneError> {
        match self.value(item)? {
            Value::Vector(v) if v.abs().max_element() <= limit => Ok(v),
            other => self.wrong(
                item,
                &format!("{key} = {other}: must be three numbers [x, y, z], each from -{limit} to {limit}"),
            ),
        }
    }

    fn aabb(&self, key: &str, item: &Item<'_>, table: &DeTable<'_>) -> Result<Aabb, SceneError> {
        let mut found = [None; 2];
        for (name, value) in table {
            match name.get_ref().as_ref() {
                "min" => found[0] = Some(self.vector("min", value, FARTHEST_M)?),
                "max" => found[1] = Some(self.vector("max", value, FARTHEST_M)?),
                other => {
                    return self.wrong(value, &format!("{key}.{other} is unknown: a box has min and max"));
                }
            }
        }
        let [Some(min), Some(max)] = found else {
            return self.wrong(item, &format!("{key} needs min and max, each [x, y, z]"));
        };
        let aabb = Aabb { min, max };
        if aabb.is_valid() {
            Ok(aabb)
        } else {
            self.wrong(item, &format!("{key}: each coordinate of min {min} must be below that of max {max}"))
        }
    }

    /// Some of the letters x, y and z.
    fn axes(&self, list: &[Item<'_>]) -> Result<[bool; 3], SceneError> {
        let mut axes = [false; 3];
        for item in list {
            match self.text_of("periodic", item)?.as_str() {
                "x" => axes[0] = true,
                "y" => axes[1] = true,
                "z" => axes[2] = true,
                other => {
                    return self.wrong(item, &format!("periodic: \"{other}\" must be one of x, y, z"));
                }
            }
        }
        Ok(axes)
    }

    fn boxes(&self, key: &str, list: &[Item<'_>]) -> Result<Vec<Aabb>, SceneError> {
        let read = |item: &Item<'_>| match item.get_ref() {
            DeValue::Table(t) => self.aabb(key, item, t),
            _ => self.wrong(item, &format!("{key} must be a table with min and max")),
        };
        list.iter().map(read).collect()
    }

    /// Reads several things with names; one without is called by its number.
    fn named<T: Named>(&self, list: &[Item<'_>]) -> Result<Vec<T>, SceneError> {
        list.iter().enumerate().map(|(k, item)| self.named_one(k, item)).collect()
    }

    fn named_one<T: Named>(&self, number: usize, item: &Item<'_>) -> Result<T, SceneError> {
        let kind = T::KIND;
        let DeValue::Table(fields) = item.get_ref() else {
            return self.wrong(item, &format!("{kind} must be a table: [[{kind}]]"));
        };
        let mut thing = T::default();
        thing.rename(number.to_string());
        for (name, value) in fields {
            match name.get_ref().as_ref() {
                "name" => thing.rename(self.text_of("name", value)?),
                field => self.put(&mut thing, field, value)?,
            }
        }
        Ok(thing)
    }

    /// A file that is named in a scene file lies beside that; a mesh that is shipped does not.
    fn located(&self, path: &str, value: Value) -> Value {
        let beside = Path::new(self.file).parent().unwrap_or(Path::new(""));
        let is_file = |name: &str| !name.is_empty() && builtin::mesh(name).is_none();
        match value {
            Value::Text(name) if path.ends_with(".file") && is_file(&name) => {
                Value::Text(beside.join(name).to_string_lossy().into_owned())
            }
            other => other,
        }
    }

    fn put<T: Named>(&self, thing: &mut T, field: &str, item: &Item<'_>) -> Result<(), SceneError> {
        let path = format!("{}.{field}", T::KIND);
        let Some(setting) = T::TABLE.iter().find(|s| s.path == field) else {
            let known: Vec<_> = T::TABLE.iter().map(|s| s.path).collect();
            return self.wrong(item, &format!("no setting \"{path}\"; there are {}", known.join(", ")));
        };
        let value = self.located(&path, self.value(item)?);
        setting.put(thing, &path, &value, false).map_err(|e| self.error_at(item.span().start, &e.to_string()))
    }

    fn change(&self, scene: &Scene, item: &Item<'_>) -> Result<Change, SceneError> {
        let DeValue::Table(table) = item.get_ref() else {
            return self.wrong(item, "change must be a table: [[change]]");
        };
        let Some(at) = table.get("at_s") else {
            return self.wrong(item, "change needs at_s, the time in seconds");
        };
        let at_s = self.number("at_s", at, 0.0, LATEST_S)?;
        let mut settings = Vec::new();
        for (name, value) in table {
            if name.get_ref() != "at_s" {
                self.flatten(scene, name.get_ref(), value, &mut settings)?;
            }
        }
        Ok(Change::new(at_s, settings))
    }

    /// Turns nested tables into paths, and checks each setting where it stands.
    fn flatten(
        &self,
        scene: &Scene,
        path: &str,
        item: &Item<'_>,
        out: &mut Vec<(String, Value)>,
    ) -> Result<(), SceneError> {
        if let DeValue::Table(table) = item.get_ref() {
            for (name, value) in table {
                self.flatten(scene, &format!("{path}.{}", name.get_ref()), value, out)?;
            }
            return Ok(());
        }
        let value = self.value(item)?;
        let checked = settings::set_live(&mut scene.clone(), path, &value);
        checked.map_err(|e| self.error_at(item.span().start, &e.to_string()))?;
        out.push((path.to_string(), value));
        Ok(())
    }

    fn hand(&self, scene: &mut Scene, table: &DeTable<'_>) -> Result<(), SceneError> {
        // The preset first: single values are set over it.
        if let Some(item) = table.get("preset") {
            let name = self.text_of("hand.preset", item)?;
            let Some(preset) = HandPreset::from_name(&name) else {
                let known = HandPreset::ALL.map(HandPreset::name).join(", ");
                return self.wrong(item, &format!("hand.preset = \"{name}\": must be one of {known}"));
            };
            scene.hand = HandSettings { ..HandSettings::preset(preset) };
        }
        for (name, value) in table {
            match (name.get_ref().as_ref(), value.get_ref()) {
                ("preset", _) => {}
                ("script", DeValue::Array(list)) => {
                    scene.script = list.iter().map(|s| self.segment(s)).collect::<Result<_, _>>()?;
                }
                (field, _) => {
                    let path = format!("hand.{field}");
                    let result = settings::set(scene, &path, &self.value(value)?);
                    result.map_err(|e| self.error_at(value.span().start, &e.to_string()))?;
                }
            }
        }
        Ok(())
    }

    /// `{ hold = 1.0 }`, `{ move = [x, y, z], in = 0.5 }`, `{ swing = [x, y, z], hz = 1, for = 2 }` or
    /// `{ circle = [x, y, z], hz = 1, for = 2 }`.
    fn segment(&self, item: &Item<'_>) -> Result<Segment, SceneError> {
        let help = "{ hold = SECONDS }, { move = [x, y, z], in = SECONDS }, { swing = [x, y, z], hz = HERTZ, for = SECONDS } or \
                    { circle = [x, y, z], hz = HERTZ, for = SECONDS }";
        let DeValue::Table(table) = item.get_ref() else {
            return self.wrong(item, &format!("hand.script: each entry is {help}"));
        };
        let number = |key: &str, max: f64| match table.get(key) {
            Some(item) => self.number(&format!("hand.script {key}"), item, 1e-3, max),
            None => self.wrong(item, &format!("hand.script: \"{key}\" is missing; an entry is {help}")),
        };
        let known = ["hold", "move", "in", "swing", "circle", "hz", "for"];
        if let Some((name, value)) = table.iter().find(|(n, _)| !known.contains(&n.get_ref().as_ref())) {
            return self.wrong(
                value,
                &format!("hand.script: \"{}\" is unknown; an entry is {help}", name.get_ref()),
            );
        }
        if let Some(place) = table.get("move") {
            let position = self.vector("hand.script move", place, 10.0)?;
            return Ok(Segment::MoveTo { position, duration_s: number("in", 3600.0)? });
        }
        if let Some(swing) = table.get("swing") {
            let amplitude = self.vector("hand.script swing", swing, 1.0)?;
            let (frequency_hz, duration_s) = (number("hz", 50.0)?, number("for", 3600.0)?);
            return Ok(Segment::Sine { amplitude, frequency_hz, duration_s });
        }
        if let Some(circle) = table.get("circle") {
            let centre = self.vector("hand.script circle", circle, 10.0)?;
            let (frequency_hz, duration_s) = (number("hz", 50.0)?, number("for", 3600.0)?);
            return Ok(Segment::Circle { centre, frequency_hz, duration_s });
        }
        Ok(Segment::Hold { duration_s: number("hold", 3600.0)? })
    }
}

fn unknown_section(key: &str) -> String {
    let known = [
        "name",
        "about",
        "ground",
        "bounds",
        "periodic",
        "container",
        "pool",
        "sink",
        "source",
        "obstacle",
        "body",
        "change",
        "hand",
        "run",
        "fluid",
        "tool",
        "gate",
        "mapping",
        "falcon",
    ];
    let nearest = known.into_iter().min_by_key(|k| settings::distance(k, key)).unwrap_or("");
    if known.contains(&key) {
        let lists = ["pool", "sink", "source", "obstacle", "body", "change"];
        let form = if key == "periodic" {
            "periodic = [\"x\"]".into()
        } else if lists.contains(&key) {
            format!("[[{key}]]")
        } else {
            format!("[{key}]")
        };
        format!("\"{key}\" must be written as a table, {form}")
    } else {
        format!("\"{key}\" is unknown (nearest: \"{nearest}\"); a scene has {}", known.join(", "))
    }
}

mod writer;

pub use writer::write;

#[cfg(test)]
mod tests;
