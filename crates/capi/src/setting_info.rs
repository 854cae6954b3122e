//! `hapflow_setting_info`: a setting with all that a panel needs to show it.

use crate::caller::{Out, Record, Shown, Text};
use crate::code::{Code, Failure};
use crate::contract::as_in_header;
use crate::fence::fence;
use crate::generated as c;
use hapflow_engine::settings::{
    BODY_SETTINGS, Kind, OBSTACLE_SETTINGS, SETTINGS, SOURCE_SETTINGS, Setting, TOOL_SETTINGS,
};
use hapflow_engine::{Scene, Value};

/// `hapflow_setting_info`.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct SettingInfo {
    size: u32,
    kind: u32,
    live: u32,
    reserved: u32,
    min: f64,
    max: f64,
    path: Text,
    group: Text,
    unit: Text,
    about: Text,
    choices: Text,
    usual: Text,
}

as_in_header!(
    SettingInfo = hapflow_setting_info {
        size,
        kind,
        live,
        reserved,
        min,
        max,
        path,
        group,
        unit,
        about,
        choices,
        usual,
    }
);

// SAFETY: repr(C), 16 bytes, two f64 and six pointers of 4 or 8 bytes: no padding; every field takes any bits.
unsafe impl Record for SettingInfo {
    const SIZE_AT: usize = 0;
    const FIRST_SIZE: usize = 32 + 6 * size_of::<usize>();
}

impl SettingInfo {
    /// What the init function writes.
    const EMPTY: Self = Self {
        size: size_of::<Self>() as u32,
        kind: 0,
        live: 0,
        reserved: 0,
        min: 0.0,
        max: 0.0,
        path: Text::EMPTY,
        group: Text::EMPTY,
        unit: Text::EMPTY,
        about: Text::EMPTY,
        choices: Text::EMPTY,
        usual: Text::EMPTY,
    };
}

/// A kind as the header numbers it, with its range and its words.
fn numbered(kind: Kind) -> (u32, f64, f64, String) {
    match kind {
        Kind::Number { min, max } => (c::HAPFLOW_SETTING_NUMBER, min, max, String::new()),
        Kind::Integer { min, max } => (c::HAPFLOW_SETTING_INTEGER, min, max, String::new()),
        Kind::Bool => (c::HAPFLOW_SETTING_SWITCH, 0.0, 0.0, String::new()),
        Kind::Choice(words) => (c::HAPFLOW_SETTING_CHOICE, 0.0, 0.0, words.join("\n")),
        Kind::Text => (c::HAPFLOW_SETTING_TEXT, 0.0, 0.0, String::new()),
        Kind::Vector { min, max } => (c::HAPFLOW_SETTING_VECTOR, min, max, String::new()),
    }
}

/// A value as `hapflow_session_get_text` gives it, and `hapflow_session_set_text` takes it.
pub fn plain(value: Value) -> String {
    match value {
        Value::Text(word) => word,
        other => other.to_string(),
    }
}

/// One setting, and its texts.
struct Entry {
    kind: u32,
    live: bool,
    min: f64,
    max: f64,
    path: Shown,
    group: Shown,
    unit: Shown,
    about: Shown,
    choices: Shown,
    usual: Shown,
}

impl Entry {
    fn new<T>(setting: &Setting<T>, path: &str, usual: &T) -> Self {
        let (kind, min, max, choices) = numbered(setting.kind);
        let group = path.rsplit_once('.').map_or("", |(group, _)| group);
        Self {
            kind,
            live: setting.live,
            min,
            max,
            path: Shown::new(path),
            group: Shown::new(group),
            unit: Shown::new(setting.unit),
            about: Shown::new(setting.about),
            choices: Shown::new(&choices),
            usual: Shown::new(&plain(setting.get(usual))),
        }
    }

    fn info(&self) -> SettingInfo {
        SettingInfo {
            kind: self.kind,
            live: self.live.into(),
            min: self.min,
            max: self.max,
            path: self.path.text(),
            group: self.group.text(),
            unit: self.unit.text(),
            about: self.about.text(),
            choices: self.choices.text(),
            usual: self.usual.text(),
            ..SettingInfo::EMPTY
        }
    }
}

/// Settings of one of a scene's things, addressed by its name.
fn entries<T: Default>(settings: &[Setting<T>], what: &str, name: &str) -> impl Iterator<Item = Entry> {
    let usual = T::default();
    settings.iter().map(move |s| Entry::new(s, &format!("{what}.{name}.{}", s.path), &usual))
}

/// Names of what a scene has any number of; a session keeps them.
pub struct Names {
    /// All but the first, whose settings need no name.
    tools: Vec<String>,
    sources: Vec<String>,
    obstacles: Vec<String>,
    bodies: Vec<String>,
}

impl Names {
    pub fn of(scene: &Scene) -> Self {
        Self {
            tools: scene.more_tools.iter().map(|t| t.name.clone()).collect(),
            sources: scene.sources.iter().map(|s| s.name.clone()).collect(),
            obstacles: scene.obstacles.iter().map(|o| o.name.clone()).collect(),
            bodies: scene.bodies.iter().map(|b| b.name.clone()).collect(),
        }
    }
}

/// Every setting of a session. What it shows to C lasts as long as it.
pub struct Panel(Vec<Entry>);

impl Panel {
    /// Every setting that `names` have.
    pub fn new(names: &Names) -> Self {
        let scene = Scene::default();
        let mut all: Vec<_> = SETTINGS.iter().map(|s| Entry::new(s, s.path, &scene)).collect();
        for name in &names.tools {
            all.extend(entries(TOOL_SETTINGS, "tool", name));
        }
        for name in &names.sources {
            all.extend(entries(SOURCE_SETTINGS, "source", name));
        }
        for name in &names.obstacles {
            all.extend(entries(OBSTACLE_SETTINGS, "obstacle", name));
        }
        for name in &names.bodies {
            all.extend(entries(BODY_SETTINGS, "body", name));
        }
        Self(all)
    }

    pub fn len(&self) -> u32 {
        u32::try_from(self.0.len()).unwrap_or(u32::MAX)
    }

    pub fn get(&self, index: u32) -> Result<SettingInfo, Failure> {
        let found = usize::try_from(index).ok().and_then(|i| self.0.get(i)).map(Entry::info);
        found.ok_or_else(|| Failure::index("setting", index, self.len()))
    }
}

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn hapflow_setting_info_init(info: Out<SettingInfo>, size: u32) -> Code {
    fence(|| info.init(&SettingInfo::EMPTY, size).map(|()| Code::OK))
}
