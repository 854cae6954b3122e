//! Where a configuration has its scene: by name, by path or as a text, with settings on top.

use crate::caller::Text;
use crate::code::{Code, Failure};
use hapflow_engine::{Scene, Value, load, parse, settings};

/// The fields of a configuration that say so.
pub struct SceneSource {
    pub scene: Text,
    pub toml: Text,
    pub toml_length: usize,
    pub settings: Text,
}

impl SceneSource {
    /// The scene, with the settings on top; where neither name nor text is given it is `otherwise`.
    pub fn read(&self, otherwise: Option<Scene>) -> Result<Scene, Failure> {
        let mut scene = self.plain(otherwise)?;
        if !self.settings.is_null() {
            apply(&mut scene, self.settings.read()?)?;
        }
        Ok(scene)
    }

    fn plain(&self, otherwise: Option<Scene>) -> Result<Scene, Failure> {
        let failed = |text: &str| Failure { code: Code::ERROR_SCENE, text: text.into() };
        match (self.scene.is_null(), self.toml.is_null()) {
            (false, true) => Ok(load(self.scene.read()?)?),
            (true, false) => Ok(parse(self.toml.read_bytes(self.toml_length)?, "toml")?),
            (true, true) => {
                otherwise.ok_or_else(|| failed("exactly one of scene, toml and built must be given"))
            }
            (false, false) => Err(failed("only one of scene and toml may be given")),
        }
    }
}

/// Applies lines of `path = value`.
fn apply(scene: &mut Scene, lines: &str) -> Result<(), Failure> {
    each_line(lines, |path, value| Ok(settings::set(scene, path, &value)?))
}

/// Reads lines of `path = value`.
pub fn assignments(lines: &str) -> Result<Vec<(String, Value)>, Failure> {
    let mut all = Vec::new();
    each_line(lines, |path, value| {
        all.push((path.into(), value));
        Ok(())
    })?;
    Ok(all)
}

/// Calls `take` for each line of `path = value`; its errors get the line's number.
fn each_line(lines: &str, mut take: impl FnMut(&str, Value) -> Result<(), Failure>) -> Result<(), Failure> {
    for (n, line) in lines.lines().enumerate() {
        let line = line.trim();
        if line.is_empty() || line.starts_with('#') {
            continue;
        }
        let taken = assignment(line).and_then(|(path, value)| take(path, value));
        taken.map_err(|f| Failure { text: format!("settings:{}: {}", n + 1, f.text), ..f })?;
    }
    Ok(())
}

fn assignment(line: &str) -> Result<(&str, Value), Failure> {
    let Some((path, value)) = line.split_once('=') else {
        let text = format!("\"{line}\": must be path = value");
        return Err(Failure { code: Code::ERROR_VALUE, text });
    };
    Ok((path.trim(), Value::parse(value)))
}
