//! Free bodies of a scene: they float as Archimedes says, rest on what is solid, and are pushed by a tool that feels it.
#![allow(clippy::unwrap_used, clippy::panic)]

mod common;

use common::open;
use glam::DVec3;
use hapflow::engine::{BodyReport, Scene, parse, write};
use hapflow::haptics::ToolState;

/// A tank of 80 mm with water 50 mm deep, a tool out of the way, and a box of 30 mm.
fn tank(density: f64, more: &str) -> Scene {
    parse(
        &format!(
            "periodic = []\n[run]\nfluid_hz = 50\ndevice = \"null\"\nfilter = \"none\"\n[fluid]\nspacing = 0.005\n\
             [tool]\nradius = 0.005\nposition = [0, 0.2, 0]\n\
             [bounds]\nmin = [-0.1, -0.1, -0.1]\nmax = [0.1, 0.3, 0.1]\n\
             [container]\nmin = [-0.04, 0, -0.04]\nmax = [0.04, 0.2, 0.04]\n\
             [[pool]]\nmin = [-0.04, 0, -0.04]\nmax = [0.04, 0.05, 0.04]\n\
             [[body]]\nname = \"raft\"\nshape = \"box\"\nsize = [0.03, 0.03, 0.03]\ndensity = {density}\n\
             position = [0, 0.06, 0]\n{more}"
        ),
        "tank",
    )
    .unwrap()
}

/// The reports after `frames`, and their mean over the last half of them.
fn run(scene: &Scene, frames: u32, hand: impl Fn(f64) -> DVec3) -> (Vec<BodyReport>, Vec<DVec3>) {
    let mut session = open(scene, 2);
    let (mut servo, mut fluid) = (session.take_servo().unwrap(), session.take_fluid().unwrap());
    let mut mean = vec![DVec3::ZERO; session.body_reports().len()];
    for k in 1..=frames {
        let t = f64::from(k) * 0.02;
        servo.tick(&ToolState { position: hand(t), ..ToolState::default() }, t, 1e-3);
        fluid.publish(t);
        fluid.compute(t);
        if 2 * k > frames {
            for (sum, report) in mean.iter_mut().zip(session.body_reports()) {
                *sum += report.state.position * (2.0 / f64::from(frames));
            }
        }
    }
    (session.body_reports().to_vec(), mean)
}

#[test]
fn a_box_floats_with_its_draught_under_water() {
    // What the box displaces lifts the level: 80² h = 80² · 50 + 30³ · density / 1000.
    for density in [300.0, 700.0] {
        let level = 0.05 + 0.03_f64.powi(3) * density / 1000.0 / 0.08_f64.powi(2);
        let expected = level - 0.03 * density / 1000.0 + 0.015;
        let (reports, mean) = run(&tank(density, ""), 80, |_| DVec3::Y * 0.2);
        assert!((mean[1].y - expected).abs() < 0.0025, "{density} kg/m³: {} m, not {expected}", mean[1].y);
        assert!(reports[1].state.velocity.length() < 0.1, "{:?}", reports[1]);
        assert!(reports[1].load.pressure_force.y > 0.0 && reports[1].load.viscous_force.is_finite());
    }
}

#[test]
fn a_heavy_one_lies_on_the_floor_and_a_second_on_it() {
    let above = "[[body]]\nshape = \"sphere\"\nradius = 0.01\ndensity = 3000\nposition = [0.001, 0.09, 0]\n";
    let (reports, _) = run(&tank(2500.0, above), 60, |_| DVec3::Y * 0.2);
    assert!((reports[1].state.position.y - 0.015).abs() < 5e-4, "{:?}", reports[1].state);
    assert!((reports[2].state.position.y - 0.04).abs() < 5e-4, "{:?}", reports[2].state);
}

#[test]
fn a_tool_pushes_a_body_away_and_feels_it() {
    let mut scene = tank(300.0, "");
    scene.pools.clear();
    scene.fluid.gravity = DVec3::ZERO;
    let (reports, _) = run(&scene, 10, |t| DVec3::new(-0.03 + 0.1 * t, 0.06, 0.0));
    // The tool has come to -10 mm, where its front is 10 mm behind the box's side.
    assert!(reports[1].state.position.x > 0.009, "{:?}", reports[1].state);
    assert!(reports[1].state.velocity.x > 0.09, "{:?}", reports[1].state);
}

#[test]
fn bodies_and_periodic_axes_are_written_and_read_as_they_were() {
    let mut scene = tank(
        700.0,
        "[[body]]\nshape = \"disc\"\ndensity = 20\n[[change]]\nat_s = 1\nbody.raft.density = 900\n",
    );
    scene.periodic = [true, false, true];
    let text = write(&scene);
    assert!(text.contains("periodic = [\"x\", \"z\"]"), "{text}");
    let again = parse(&text, "again").unwrap();
    assert_eq!(
        (&again.bodies, again.periodic, &again.changes),
        (&scene.bodies, scene.periodic, &scene.changes)
    );
    let wrong = parse("periodic = [\"w\"]\n", "wrong").unwrap_err().to_string();
    assert!(wrong.contains("wrong:1: periodic: \"w\" must be one of x, y, z"), "{wrong}");
    let heavy = parse("[[body]]\ndensity = 0\n", "wrong").unwrap_err().to_string();
    assert!(heavy.contains("body.density = 0: must be a number from 1 to 100000 kg/m³"), "{heavy}");
}
