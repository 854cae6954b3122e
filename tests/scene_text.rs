//! A scene that is built by calls, written, and read again is the same scene.
#![allow(clippy::unwrap_used, clippy::panic)]

use glam::DVec3;
use hapflow::engine::settings::{Kind, OBSTACLE_SETTINGS, SETTINGS, SOURCE_SETTINGS, TOOL_SETTINGS, set};
use hapflow::engine::{Obstacle, Scene, ToolSettings, Value, load, parse, shipped, write};
use hapflow::fluid::{Aabb, Source};

/// splitmix64.
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    fn below(&mut self, count: usize) -> usize {
        (self.next() % count as u64) as usize
    }

    fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn number(&mut self, min: f64, max: f64) -> f64 {
        min + (max - min) * self.unit()
    }

    fn vector(&mut self, size: f64) -> DVec3 {
        DVec3::from_array(std::array::from_fn(|_| self.number(-size, size)))
    }

    fn pick<'a>(&mut self, words: &[&'a str]) -> &'a str {
        words[self.below(words.len())]
    }

    /// A value of a kind; for texts one of `words`.
    fn value(&mut self, kind: Kind, words: &[&str]) -> Value {
        match kind {
            Kind::Number { min, max } => Value::Number(self.number(min, max)),
            Kind::Integer { min, max } => Value::Number(self.number(min, max).round()),
            Kind::Bool => Value::Bool(self.below(2) == 0),
            Kind::Choice(words) => Value::Text(self.pick(words).into()),
            Kind::Text => Value::Text(self.pick(words).into()),
            Kind::Vector { max, .. } => Value::Vector(self.vector(max)),
        }
    }
}

const NAMES: [&str; 10] =
    ["", "a", "tap-2", "two words", "a.b", "quo\"te", "back\\slash", "ünïcode", "line\nbreak", "#[x]='"];

/// Texts for settings with a grammar of their own, and some that those refuse.
const TEXTS: [&str; 8] =
    ["auto", "none", "butterworth:50:4@servo", "hann:11@fluid", "-z y x", "tremor", "C:\\a \"b\"", "\t"];

/// Sets some settings to anything that the scene takes.
fn spoil(random: &mut Random, scene: &mut Scene, path: &str, kind: Kind) {
    if random.below(3) > 0 {
        return;
    }
    let mut changed = scene.clone();
    let value = random.value(kind, &TEXTS);
    if set(&mut changed, path, &value).is_ok() && changed.check().is_ok() {
        *scene = changed;
    }
}

fn any_scene(seed: u64) -> Scene {
    let mut random = Random(seed);
    let mut scene =
        Scene { name: random.pick(&NAMES).into(), about: random.pick(&NAMES).into(), ..Scene::default() };
    let corners = |random: &mut Random| {
        let (a, b) = (random.vector(0.4), random.vector(0.4));
        Aabb { min: a.min(b), max: a.max(b) }
    };
    for _ in 0..random.below(3) {
        let _ = scene.add_source(Source { name: random.pick(&NAMES).into(), ..Source::default() });
        let _ = scene.add_obstacle(Obstacle { name: random.pick(&NAMES).into(), ..Obstacle::default() });
        let _ = scene.add_tool(ToolSettings { name: random.pick(&NAMES).into(), ..ToolSettings::default() });
        scene.add_pool(corners(&mut random)).unwrap();
        scene.add_sink(corners(&mut random)).unwrap();
    }
    if random.below(2) == 0 {
        scene.set_container(Some(corners(&mut random))).unwrap();
        scene.set_ground(Some(random.number(-1.0, 1.0))).unwrap();
    }
    if scene.check().is_err() {
        return Scene::default();
    }
    for setting in SETTINGS {
        spoil(&mut random, &mut scene, setting.path, setting.kind);
    }
    for (kind, names, table) in [
        ("source", scene.sources.iter().map(|s| s.name.clone()).collect::<Vec<_>>(), kinds(SOURCE_SETTINGS)),
        ("obstacle", scene.obstacles.iter().map(|o| o.name.clone()).collect(), kinds(OBSTACLE_SETTINGS)),
        ("tool", scene.more_tools.iter().map(|t| t.name.clone()).collect(), kinds(TOOL_SETTINGS)),
    ] {
        for (name, (path, what)) in names.iter().flat_map(|n| table.iter().map(move |t| (n, t))) {
            spoil(&mut random, &mut scene, &format!("{kind}.{name}.{path}"), *what);
        }
    }
    add_changes(&mut random, &mut scene);
    scene
}

fn kinds<T>(table: &[hapflow::engine::settings::Setting<T>]) -> Vec<(&'static str, Kind)> {
    table.iter().map(|s| (s.path, s.kind)).collect()
}

fn add_changes(random: &mut Random, scene: &mut Scene) {
    for _ in 0..random.below(3) {
        let mut settings = vec![("fluid.viscosity".to_string(), Value::Number(random.number(0.0, 0.01)))];
        if let Some(source) = scene.sources.first() {
            settings.push((format!("source.{}.on", source.name), Value::Bool(false)));
            settings.push((format!("source.{}.on", source.name), Value::Bool(true)));
        }
        let mut changed = scene.clone();
        changed.add_change(random.number(0.0, 9.0), &settings).unwrap();
        if changed.check().is_ok() {
            *scene = changed;
        }
    }
}

fn again(scene: &Scene) -> Scene {
    let text = write(scene);
    parse(&text, "again").unwrap_or_else(|e| panic!("{e}\n{text}"))
}

#[test]
fn every_shipped_scene_is_written_and_read_as_it_was() {
    for (name, _) in shipped() {
        let scene = load(name).unwrap();
        assert_eq!(again(&scene), scene, "{name}");
    }
    assert_eq!(write(&Scene::default()), "name = \"scene\"\n", "what says nothing is short");
}

#[test]
fn so_is_any_scene() {
    let (mut plain, mut with_parts) = (0, 0);
    for seed in 0..400 {
        let scene = any_scene(seed);
        assert_eq!(again(&scene), scene, "seed {seed}\n{}", write(&scene));
        plain += usize::from(scene == Scene::default());
        with_parts += usize::from(!scene.sources.is_empty() && !scene.changes.is_empty());
    }
    assert!(plain < 200 && with_parts > 20, "{plain} {with_parts}");
}

#[test]
fn what_cannot_be_is_refused_with_field_value_and_range_and_changes_nothing() {
    let mut scene = Scene::default();
    let tap = Source { name: "tap".into(), ..Source::default() };
    assert_eq!(scene.add_source(tap.clone()).unwrap(), 0);
    assert_eq!(scene.add_source(Source { name: String::new(), ..tap.clone() }).unwrap(), 1);
    assert_eq!(scene.sources[1].name, "1");
    let before = scene.clone();
    let mut refuse = |act: &dyn Fn(&mut Scene) -> Option<hapflow::engine::SceneError>, words: &str| {
        let told = act(&mut scene).unwrap_or_else(|| panic!("{words}")).to_string();
        assert_eq!((told.as_str(), &scene), (words, &before));
    };
    refuse(&|s| s.add_source(tap.clone()).err(), "source.name = \"tap\": must be a name that no other has");
    refuse(
        &|s| s.add_source(Source { name: "b".into(), speed: 99.0, ..tap.clone() }).err(),
        "source.b.speed = 99: must be a number from 0 to 20 m/s",
    );
    refuse(
        &|s| s.add_source(Source { name: "b".into(), speed: f64::NAN, ..tap.clone() }).err(),
        "source.b.speed = NaN: must be a number from 0 to 20 m/s",
    );
    refuse(
        &|s| s.add_pool(Aabb { min: DVec3::X, max: DVec3::ONE }).err(),
        "pool.min = [1, 0, 0]: must be below max = [1, 1, 1]",
    );
    refuse(
        &|s| s.set_bounds(Aabb { min: DVec3::splat(-101.0), max: DVec3::ONE }).err(),
        "bounds.min = -101: must be a number from -100 to 100",
    );
    refuse(&|s| s.set_ground(Some(f64::NAN)).err(), "ground = NaN: must be a number from -100 to 100");
    refuse(&|s| s.add_change(-1.0, &[]).err(), "change.at_s = -1: must be a number from 0 to 3600");
    refuse(
        &|s| s.add_change(1.0, &[("run.fluid_hz".into(), Value::Number(60.0))]).err(),
        "run.fluid_hz cannot change while a session runs: set it before it starts",
    );
    refuse(
        &|s| s.add_tool(ToolSettings::default()).err(),
        "tool.name = \"0\": must be a name that no other has",
    );
    for n in 1..8 {
        let tool = ToolSettings { name: String::new(), ..ToolSettings::default() };
        assert_eq!(scene.add_tool(tool).unwrap(), n);
    }
    let told = scene.add_tool(ToolSettings { name: "ninth".into(), ..ToolSettings::default() }).unwrap_err();
    assert_eq!(told.to_string(), "tools = 9: must be at most 8");
}
