//! Writing a scene as TOML: what differs from a scene that says nothing, in a form that reads back as the same scene.

use crate::Value;
use crate::scene::{Change, Scene};
use crate::settings::{Named, SETTINGS, container_word, is_shorthand};
use glam::DVec3;
use hapflow_devices::Segment;
use hapflow_fluid::{Aabb, ContainerForm};
use std::fmt::Write as _;

/// The scene as the text of a scene file, which [`parse`](crate::parse) makes the same scene of.
pub fn write(scene: &Scene) -> String {
    let mut text = format!("name = {}\n", quoted(&scene.name));
    if !scene.about.is_empty() {
        text += &format!("about = {}\n", quoted(&scene.about));
    }
    if let Some(height) = scene.ground {
        text += &format!("ground = {height}\n");
    }
    let axes = ["x", "y", "z"].iter().zip(scene.periodic).filter(|(_, on)| *on).map(|(axis, _)| quoted(axis));
    if scene.periodic.contains(&true) {
        text += &format!("periodic = [{}]\n", axes.collect::<Vec<_>>().join(", "));
    }
    text += &tables(scene);
    if scene.bounds != Scene::default().bounds {
        text += &aabb("[bounds]", &scene.bounds);
    }
    text += &container(scene);
    scene.pools.iter().for_each(|pool| text += &aabb("[[pool]]", pool));
    scene.sinks.iter().for_each(|sink| text += &aabb("[[sink]]", sink));
    scene.sources.iter().for_each(|source| text += &named(source));
    scene.obstacles.iter().for_each(|obstacle| text += &named(obstacle));
    scene.bodies.iter().for_each(|body| text += &named(body));
    if has_tool_list(scene) {
        scene.tools().for_each(|tool| text += &named(tool));
    }
    scene.changes.iter().for_each(|c| text += &change(c));
    text
}

fn container(scene: &Scene) -> String {
    let shape = match scene.container_form {
        ContainerForm::Box => String::new(),
        round => format!("shape = {}\n", quoted(container_word(round))),
    };
    match &scene.container {
        Some(inner) => aabb("[container]", inner) + &shape,
        None if shape.is_empty() => shape,
        None => format!("\n[container]\n{shape}"),
    }
}

/// Whether the tools are written as `[[tool]]`: a single one needs a name only if it is not its number.
fn has_tool_list(scene: &Scene) -> bool {
    !scene.more_tools.is_empty() || scene.tool.name != "0"
}

/// The tables of settings, in their order: `[run]`, `[fluid]` …
fn tables(scene: &Scene) -> String {
    let (usual, mut text, mut open) = (Scene::default(), String::new(), "");
    for setting in SETTINGS {
        let Some((table, field)) = setting.path.split_once('.') else { continue };
        // Tools may have a list of their own, and a container stands with its corners.
        let elsewhere =
            is_shorthand(setting.path) || table == "container" || (table == "tool" && has_tool_list(scene));
        let now = setting.get(scene);
        if elsewhere || now == setting.get(&usual) {
            continue;
        }
        if open != table {
            text += &format!("\n[{table}]\n");
            open = table;
        }
        text += &format!("{field} = {}\n", literal(&now));
    }
    if !scene.script.is_empty() {
        // The hand is the last table.
        let head = if open == "hand" { "" } else { "\n[hand]\n" };
        text += &format!("{head}script = [\n{}]\n", scene.script.iter().map(segment).collect::<String>());
    }
    text
}

/// A value as TOML has it.
fn literal(value: &Value) -> String {
    match value {
        Value::Text(text) => quoted(text),
        other => other.to_string(),
    }
}

/// A text in quotes, on one line.
fn quoted(text: &str) -> String {
    let mut quoted = String::from('"');
    for letter in text.chars() {
        match letter {
            '"' | '\\' => quoted.extend(['\\', letter]),
            control if control.is_control() => {
                let _ = write!(quoted, "\\u{:04X}", u32::from(control));
            }
            other => quoted.push(other),
        }
    }
    quoted + "\""
}

fn vector(v: DVec3) -> Value {
    Value::Vector(v)
}

fn aabb(head: &str, b: &Aabb) -> String {
    format!("\n{head}\nmin = {}\nmax = {}\n", vector(b.min), vector(b.max))
}

/// One of several things that have a name.
fn named<T: Named>(thing: &T) -> String {
    let usual = T::default();
    let mut text = format!("\n[[{}]]\nname = {}\n", T::KIND, quoted(thing.name()));
    for setting in T::TABLE {
        let now = setting.get(thing);
        if now != setting.get(&usual) {
            let _ = writeln!(text, "{} = {}", setting.path, literal(&now));
        }
    }
    text
}

fn change(change: &Change) -> String {
    let mut text = format!("\n[[change]]\nat_s = {}\n", change.at_s);
    for (path, value) in &change.settings {
        let _ = writeln!(text, "{} = {}", key(path), literal(value));
    }
    text
}

/// A path as a key; a name in it may have letters that a bare key cannot have.
fn key(path: &str) -> String {
    let bare = |part: &str| {
        !part.is_empty() && part.bytes().all(|b| b.is_ascii_alphanumeric() || b == b'_' || b == b'-')
    };
    if path.split('.').all(bare) { path.into() } else { quoted(path) }
}

fn segment(segment: &Segment) -> String {
    match *segment {
        Segment::Hold { duration_s } => format!("    {{ hold = {duration_s} }},\n"),
        Segment::MoveTo { position, duration_s } => {
            format!("    {{ move = {}, in = {duration_s} }},\n", vector(position))
        }
        Segment::Sine { amplitude, frequency_hz, duration_s } => {
            format!("    {{ swing = {}, hz = {frequency_hz}, for = {duration_s} }},\n", vector(amplitude))
        }
        Segment::Circle { centre, frequency_hz, duration_s } => {
            format!("    {{ circle = {}, hz = {frequency_hz}, for = {duration_s} }},\n", vector(centre))
        }
    }
}
