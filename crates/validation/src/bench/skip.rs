//! What each thing costs where it is, and that it costs nothing where it is not.

use super::rig::{Rig, cost, cube, median, with};
use crate::ValidationError;
use crate::worlds::body;
use glam::DVec3;
use hapflow_engine::{Session, SessionOptions, load};
use hapflow_fluid::{Aabb, FluidConfig, Shape, Source};
use serde_json::json;
use std::time::Instant;

/// Rounds in turns, and frames a round.
const ROUNDS: usize = 7;
const FRAMES: usize = 4;
/// Time in which a tank comes to rest and falls asleep, s.
const SETTLING: f64 = 2.0;
/// Side of the tank, m, and particles along it.
const SIDE: f64 = 0.1;
const CELLS: f64 = 14.0;
/// The ball in it.
const BALL: Shape = Shape::Sphere { radius: 0.02 };
/// Ratio that an unused thing must stay below: noise of a busy machine.
const NOISE: f64 = 1.05;

/// One comparison.
#[derive(Clone, Debug)]
pub struct Saving {
    /// What was compared.
    pub name: &'static str,
    /// In words, against what.
    pub about: &'static str,
    /// The number.
    pub value: f64,
    /// Its unit: × for a ratio of costs.
    pub unit: &'static str,
    /// The most that it should be; none where it only informs.
    pub goal: Option<f64>,
}

impl Saving {
    /// Whether the goal is met; none where there is none.
    pub fn met(&self) -> Option<bool> {
        Some(self.value <= self.goal?)
    }

    /// One line of JSON.
    pub fn json(&self) -> serde_json::Value {
        json!({
            "name": self.name,
            "about": self.about,
            "value": self.value,
            "unit": self.unit,
            "goal": self.goal,
            "met": self.met(),
        })
    }
}

/// A thing, and the same without it or awake.
struct Pair {
    name: &'static str,
    about: &'static str,
    goal: Option<f64>,
    with: FluidConfig,
    without: FluidConfig,
    /// Time in which both settle first, s.
    settle: f64,
    /// Whether the first body stirs.
    stirs: bool,
}

/// All comparisons; `tell` hears of each as it is made.
///
/// # Errors
/// What fluid or session refuse.
pub fn skip(mut tell: impl FnMut(&Saving)) -> Result<(), ValidationError> {
    for pair in asleep().into_iter().chain(features()) {
        let value = pair.ratio()?;
        tell(&Saving { name: pair.name, about: pair.about, value, unit: "×", goal: pair.goal });
    }
    tell(&waking()?);
    tell(&start()?);
    Ok(())
}

fn tank() -> FluidConfig {
    cube(SIDE, CELLS)
}

/// With the ball at `place`.
fn with_ball(config: &FluidConfig, place: DVec3) -> FluidConfig {
    with(config, |_, world| world.bodies.push(body(BALL, place)))
}

/// Comparisons of fluid that may sleep with the same that may not.
fn asleep() -> [Pair; 3] {
    let pair = |name, about, goal, without: FluidConfig, stirs| Pair {
        name,
        about,
        goal,
        with: with(&without, |settings, _| settings.sleep = true),
        without,
        settle: SETTLING,
        stirs,
    };
    let away = with_ball(&tank(), DVec3::Y * 1.8 * SIDE);
    let within = with_ball(&tank(), DVec3::Y * 0.5 * SIDE);
    [
        pair("asleep", "tank at rest, the tool away, against the same awake", Some(0.01), away, false),
        pair(
            "still-tool",
            "tank at rest round a tool that is still, against the same awake",
            Some(1.0),
            within,
            false,
        ),
        pair(
            "half-asleep",
            "a tank asleep beside one that is stirred, against both awake",
            Some(0.6),
            two_tanks(),
            true,
        ),
    ]
}

/// A tank, and beside it one like it, of slabs, in which the ball is.
fn two_tanks() -> FluidConfig {
    let (wide, thick) = (SIDE, 0.2 * SIDE);
    let middle = DVec3::X * 3.0 * SIDE;
    let wall = |offset: DVec3, size: DVec3| body(Shape::Box { size }, middle + offset);
    let (across, up) = (0.5 * (wide + thick), DVec3::Y * wide);
    let side = DVec3::new(thick, 2.0 * wide + 2.0 * thick, wide + 2.0 * thick);
    let floor = DVec3::new(wide + 2.0 * thick, thick, wide + 2.0 * thick);
    let front = DVec3::new(wide + 2.0 * thick, side.y, thick);
    with(&with_ball(&tank(), middle + 0.5 * up), |_, world| {
        world.bounds.max.x = middle.x + 2.0 * wide;
        world.pools.push(Aabb { min: world.pools[0].min + middle, max: world.pools[0].max + middle });
        world.bodies.push(wall(DVec3::NEG_Y * 0.5 * thick, floor));
        world.bodies.extend([1.0, -1.0].map(|sign| wall(sign * across * DVec3::X + 0.5 * up, side)));
        world.bodies.extend([1.0, -1.0].map(|sign| wall(sign * across * DVec3::Z + 0.5 * up, front)));
    })
}

/// Comparisons of a thing that is there with none, and of one that is there and unused.
fn features() -> Vec<Pair> {
    let plain = tank();
    let pair = |name, about, goal, with| Pair {
        name,
        about,
        goal,
        with,
        without: plain.clone(),
        settle: 0.05,
        stirs: false,
    };
    let source =
        |on| Source { position: DVec3::Y * 1.8 * SIDE, diameter: 0.2 * SIDE, on, ..Source::default() };
    let corner = DVec3::splat(0.09 * SIDE);
    let sink = |low: DVec3| Aabb { min: low, max: low + corner };
    let far = DVec3::Y * 1.8 * SIDE;
    vec![
        pair("nothing", "the same against itself: the noise", None, plain.clone()),
        pair("far-tool", "a tool that is far away", Some(NOISE), with_ball(&plain, far)),
        pair(
            "far-obstacles",
            "eight balls that are far away",
            Some(NOISE),
            with(&plain, |_, world| {
                world.bodies.extend((0..8).map(|_| body(BALL, far)));
            }),
        ),
        pair(
            "source-off",
            "a source that is off, at the same speed of sound: its jet may come, and would set that",
            Some(NOISE),
            with(&plain, |settings, world| {
                settings.sound_speed = plain.sound_speed();
                world.sources.push(source(false));
            }),
        ),
        pair(
            "empty-sink",
            "a sink that nothing reaches",
            Some(NOISE),
            with(&plain, |_, world| {
                world.sinks.push(sink(world.bounds.min));
            }),
        ),
        pair("inviscid", "no viscosity", Some(NOISE), with(&plain, |settings, _| settings.viscosity = 0.0)),
        pair("source", "a source that runs", None, with(&plain, |_, world| world.sources.push(source(true)))),
        pair("tool", "a ball in the fluid", None, with_ball(&plain, DVec3::Y * 0.5 * SIDE)),
        pair("one-way-tool", "the same, felt by nobody", None, {
            with(&with_ball(&plain, DVec3::Y * 0.5 * SIDE), |settings, _| settings.two_way = false)
        }),
        pair(
            "surface-tension",
            "that of water",
            None,
            with(&plain, |settings, _| settings.surface_tension = 0.0727),
        ),
        pair(
            "stiff-viscosity",
            "1000 Pa·s, implicit",
            None,
            with(&plain, |settings, _| settings.viscosity = 1000.0),
        ),
    ]
}

impl Pair {
    /// Cost with the thing over cost without, the median of some rounds.
    fn ratio(&self) -> Result<f64, ValidationError> {
        let mut rigs = [Rig::new(self.with.clone())?, Rig::new(self.without.clone())?];
        rigs.iter_mut().for_each(|rig| self.run(rig, self.settle));
        let mut round = |_| {
            let [with, without] = [0, 1].map(|k| cost(|| self.run(&mut rigs[k], FRAMES as f64 / 100.0)));
            with / without
        };
        Ok(median((0..ROUNDS).map(&mut round).collect()))
    }

    fn run(&self, rig: &mut Rig, seconds: f64) {
        let start = self.with.world.bodies.first().map_or(DVec3::ZERO, |b| b.position);
        let stirring = if self.stirs { 0.15 * SIDE } else { 0.0 };
        let place = |t: f64| start + stirring * DVec3::new((6.0 * t).sin(), 0.0, (6.0 * t).cos() - 1.0);
        (0..(seconds * 100.0).round() as usize).for_each(|_| {
            rig.frame(place);
        });
    }
}

/// By how much the force on a ball changes when the tank round it wakes.
fn waking() -> Result<Saving, ValidationError> {
    let start = DVec3::Y * 0.5 * SIDE;
    let mut rig = Rig::new(with(&with_ball(&tank(), start), |settings, _| settings.sleep = true))?;
    rig.settle(SETTLING);
    let (mut asleep, mut awake) = (DVec3::ZERO, DVec3::ZERO);
    (0..20).for_each(|_| asleep += rig.rest().loads[0].force());
    // A millimetre a second is felt by nobody, and wakes it.
    let from = SETTLING + 0.2;
    (0..20).for_each(|_| awake += rig.frame(|t| start + DVec3::X * 1e-3 * (t - from)).loads[0].force());
    Ok(Saving {
        name: "waking",
        about: "change of the force on a ball at rest when the tank round it wakes",
        value: (awake - asleep).length() / asleep.length(),
        unit: "1",
        goal: Some(0.01),
    })
}

/// Time from a scene's name to the first fluid frame.
fn start() -> Result<Saving, ValidationError> {
    let mut times = Vec::new();
    for _ in 0..ROUNDS {
        let begun = Instant::now();
        let mut session = Session::open(&load("tap")?, SessionOptions::hosted())?;
        if let Some(mut fluid) = session.take_fluid() {
            fluid.compute(fluid.frame_s());
        }
        times.push(begun.elapsed().as_secs_f64());
    }
    Ok(Saving {
        name: "start",
        about: "from the name of the scene `tap` to its first fluid frame, on the wall",
        value: median(times),
        unit: "s",
        goal: Some(0.05),
    })
}
