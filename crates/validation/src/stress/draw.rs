//! Values of settings, from their whole ranges and from outside them, for whatever the settings table holds.

use super::dice::Dice;
use glam::DVec3;
use hapflow_engine::settings::{
    BODY_SETTINGS, Kind, OBSTACLE_SETTINGS, SETTINGS, SOURCE_SETTINGS, Setting, TOOL_SETTINGS,
};
use hapflow_engine::{Scene, Value};

/// A setting of a scene, by its full path.
#[derive(Clone, Debug)]
pub(super) struct Address {
    pub path: String,
    pub kind: Kind,
    pub live: bool,
}

/// Every setting that `scene` has.
pub(super) fn addresses(scene: &Scene) -> Vec<Address> {
    let mut all = Vec::new();
    add(&mut all, SETTINGS, "");
    scene.sources.iter().for_each(|s| add(&mut all, SOURCE_SETTINGS, &format!("source.{}.", s.name)));
    scene.obstacles.iter().for_each(|o| add(&mut all, OBSTACLE_SETTINGS, &format!("obstacle.{}.", o.name)));
    scene.bodies.iter().for_each(|b| add(&mut all, BODY_SETTINGS, &format!("body.{}.", b.name)));
    scene.more_tools.iter().for_each(|t| add(&mut all, TOOL_SETTINGS, &format!("tool.{}.", t.name)));
    all
}

fn add<T>(all: &mut Vec<Address>, table: &[Setting<T>], owner: &str) {
    all.extend(table.iter().map(|s| Address {
        path: format!("{owner}{}", s.path),
        kind: s.kind,
        live: s.live,
    }));
}

/// A value that fits; none for a text, which only its own parser knows.
pub(super) fn fitting(kind: &Kind, dice: &mut Dice) -> Option<Value> {
    Some(match *kind {
        Kind::Number { min, max } => Value::Number(number(min, max, dice)),
        Kind::Integer { min, max } => Value::Number(number(min, max, dice).round()),
        Kind::Bool => Value::Bool(dice.chance(0.5)),
        Kind::Choice(words) => Value::Text((*dice.pick(words)?).into()),
        Kind::Text => return None,
        Kind::Vector { min, max } => {
            let mut coordinate = || number(min, max, dice);
            Value::Vector(DVec3::new(coordinate(), coordinate(), coordinate()))
        }
    })
}

/// An end of the range, or between: even, or even in powers of ten.
fn number(min: f64, max: f64, dice: &mut Dice) -> f64 {
    match dice.whole(0, 9) {
        0 => min,
        1 => max,
        2..=4 => dice.within(min, max),
        _ if min > 0.0 => dice.scale(min, max),
        _ => {
            let size = dice.scale(1e-6 * max, max);
            if min < 0.0 && dice.chance(0.5) { (-size).max(min) } else { size }
        }
    }
}

/// A value that does not fit.
pub(super) fn misfit(kind: &Kind, dice: &mut Dice) -> Value {
    let text = || Value::Text("no such word".into());
    match *kind {
        Kind::Number { min, max } => match dice.whole(0, 3) {
            0 => text(),
            _ => Value::Number(beyond(min, max, dice)),
        },
        Kind::Integer { min, max } => match dice.whole(0, 3) {
            0 => text(),
            1 => Value::Number(min + 0.5),
            _ => Value::Number(beyond(min, max, dice)),
        },
        Kind::Bool | Kind::Text => Value::Number(1.0),
        Kind::Choice(_) => text(),
        Kind::Vector { min, max } => {
            let mut v = DVec3::splat(0.5 * (min + max));
            v[dice.whole(0, 2)] = beyond(min, max, dice);
            Value::Vector(v)
        }
    }
}

/// A number outside a range, or none at all.
fn beyond(min: f64, max: f64, dice: &mut Dice) -> f64 {
    let past = (max - min) * dice.scale(1e-9, 1e9);
    let numbers = [min - past, max + past, f64::NAN, f64::INFINITY, f64::NEG_INFINITY, f64::MAX, f64::MIN];
    dice.pick(&numbers).copied().unwrap_or(f64::NAN)
}
