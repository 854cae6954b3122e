//! Every shape that a tool or an obstacle may have: from a scene file, back to one, and felt by the fluid.
#![allow(clippy::unwrap_used, clippy::panic)]

mod common;

use common::{JET, open};
use glam::DVec3;
use hapflow::engine::{FormKind, parse, write};
use hapflow::fluid::Shape;
use hapflow::haptics::ToolState;
use std::fs;

/// A cube of 20 mm edges in millimetres.
const CUBE: &str = "v -10 -10 -10\nv 10 -10 -10\nv 10 10 -10\nv -10 10 -10\nv -10 -10 10\nv 10 -10 10\n\
    v 10 10 10\nv -10 10 10\nf 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 3 4 8 7\nf 1 5 8 4\nf 2 3 7 6\n";

/// A folder of its own, with the cube in it.
fn folder(name: &str) -> std::path::PathBuf {
    let folder = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    fs::create_dir_all(&folder).unwrap();
    fs::write(folder.join("cube.obj"), CUBE).unwrap();
    folder
}

#[test]
fn a_scene_has_every_shape_and_writes_it_as_it_was() {
    let file = folder("shapes").join("scene.toml");
    let text = "[tool]\nshape = \"capsule\"\nradius = 0.01\nlength = 0.05\n\
        [[obstacle]]\nshape = \"box\"\nsize = [0.1, 0.02, 0.03]\nposition = [0.2, 0, 0]\n\
        [[obstacle]]\nshape = \"cylinder\"\nradius = 0.02\nlength = 0.1\nposition = [-0.2, 0, 0]\n\
        [[obstacle]]\nname = \"cube\"\nshape = \"mesh\"\nfile = \"cube.obj\"\nscale = 0.001\nposition = [0, 0.2, 0]\n";
    let scene = parse(text, file.to_str().unwrap()).unwrap();
    assert_eq!(scene.tool.form.shape(), Shape::Capsule { radius: 0.01, length: 0.05 });
    assert_eq!(scene.obstacles[0].form.shape(), Shape::Box { size: DVec3::new(0.1, 0.02, 0.03) });
    assert_eq!(scene.obstacles[1].form.shape(), Shape::Disc { radius: 0.02, thickness: 0.1 });
    assert_eq!(scene.obstacles[2].form.kind, FormKind::Mesh);
    assert!((scene.obstacles[2].form.shape().volume() - 8e-6).abs() < 1e-12);
    let again = parse(&write(&scene), "again").unwrap();
    assert_eq!(again.obstacles, scene.obstacles);
    assert_eq!(again.tool, scene.tool);
}

#[test]
fn a_mesh_that_is_none_is_told_with_file_and_line() {
    let folder = folder("broken");
    fs::write(folder.join("open.obj"), CUBE.replace("f 1 2 6 5\n", "")).unwrap();
    fs::write(folder.join("odd.obj"), "v 0 0\n").unwrap();
    let told = |mesh: &str| {
        let text = format!("[tool]\nshape = \"mesh\"\n{mesh}\n");
        parse(&text, folder.join("s.toml").to_str().unwrap()).unwrap_err().to_string()
    };
    let open = told("file = \"open.obj\"");
    assert!(open.contains("s.toml:3: tool.file = ") && open.contains("4 of its edges"), "{open}");
    let odd = told("file = \"odd.obj\"");
    assert!(odd.contains("odd.obj:1: three numbers expected"), "{odd}");
    assert!(told("file = \"none.obj\"").contains("none.obj"));
    let without = told("");
    assert!(without.contains("tool.0.file = \"\": must be a file"), "{without}");
}

/// A jet presses on each of them, straight down.
#[test]
fn a_jet_presses_on_every_shape() {
    let file = folder("pressed").join("scene.toml");
    for (shape, least) in [
        ("shape = \"box\"\nsize = [0.05, 0.02, 0.05]", 0.2),
        ("shape = \"capsule\"\nradius = 0.015\nlength = 0.02", 0.1),
        ("shape = \"cylinder\"\nradius = 0.03\nlength = 0.02", 0.2),
        ("shape = \"mesh\"\nfile = \"cube.obj\"\nscale = 0.002", 0.2),
    ] {
        let text = format!("{JET}\n[tool]\n{shape}\n");
        let scene = parse(&text, file.to_str().unwrap()).unwrap();
        let mut session = open(&scene, 2);
        let (mut servo, mut fluid) = (session.take_servo().unwrap(), session.take_fluid().unwrap());
        let mut force = DVec3::ZERO;
        for k in 1..30 {
            fluid.publish(f64::from(k) * 0.01);
            fluid.compute(f64::from(k) * 0.01);
            servo.tick(&ToolState::default(), f64::from(k) * 0.01, 1e-3);
            if k >= 20 {
                force += servo.newest().raw.force * 0.1;
            }
        }
        assert!(force.y < -least && force.x.hypot(force.z) < 0.1 * -force.y, "{shape}: {force}");
    }
}

/// Water in a round container stays in it and comes to rest, level.
#[test]
fn a_bowl_and_a_round_tank_hold_water() {
    for (shape, top, depth) in [("bowl", 0.05, 0.035), ("cylinder", 0.08, 0.04)] {
        let text = format!(
            "[run]\nfluid_hz = 50\ndevice = \"null\"\n[fluid]\nspacing = 0.005\n\
             [tool]\nradius = 0.005\nposition = [0, 0.2, 0]\n\
             [bounds]\nmin = [-0.1, -0.1, -0.1]\nmax = [0.1, 0.3, 0.1]\n\
             [container]\nmin = [-0.05, 0, -0.05]\nmax = [0.05, {top}, 0.05]\nshape = \"{shape}\"\n\
             [[pool]]\nmin = [-0.05, 0, -0.05]\nmax = [0.05, {depth}, 0.05]\n"
        );
        let scene = parse(&text, shape).unwrap();
        let again = parse(&write(&scene), "again").unwrap();
        assert_eq!((again.container, again.container_form), (scene.container, scene.container_form));
        let mut session = open(&scene, 2);
        let mut fluid = session.take_fluid().unwrap();
        let mut view = hapflow::fluid::ParticleView::default();
        fluid.snapshot(&mut view);
        let filled = view.positions.len();
        for k in 1..=50 {
            fluid.compute(f64::from(k) * 0.02);
        }
        fluid.snapshot(&mut view);
        assert_eq!(view.positions.len(), filled, "{shape}: none is lost");
        let volume = filled as f64 * 0.005_f64.powi(3);
        // A cap of the ball of 50 mm radius, or a disc of 50 mm.
        let full = match shape {
            "bowl" => std::f64::consts::PI * depth * depth * (0.05 - depth / 3.0),
            _ => std::f64::consts::PI * 0.05 * 0.05 * depth,
        };
        assert!((volume / full - 1.0).abs() < 0.1, "{shape}: {volume} m³, not {full}");
        let out = view.positions.iter().filter(|p| {
            let from = if shape == "bowl" { p[1] - 0.05 } else { 0.0 };
            p[0].hypot(p[2]).hypot(from) > 0.0501 || p[1] < -0.001
        });
        assert_eq!(out.count(), 0, "{shape}: all are within");
        let top = view.positions.iter().map(|p| f64::from(p[1])).fold(0.0, f64::max);
        assert!((top - depth * (volume / full)).abs() < 0.005, "{shape}: level {top} m");
        let fastest = view.velocities.iter().map(|v| v[0].hypot(v[1]).hypot(v[2])).fold(0.0, f32::max);
        assert!(fastest < 0.12, "{shape}: {fastest} m/s");
    }
    let told =
        parse("[container]\nmin = [0, 0, 0]\nmax = [1, 2, 1]\nshape = \"bowl\"\n", "deep").unwrap_err();
    assert!(told.to_string().contains("container (depth of a bowl) = 2"), "{told}");
    let told =
        parse("[container]\nmin = [0, 0, 0]\nmax = [1, 1, 1]\nshape = \"round\"\n", "odd").unwrap_err();
    assert!(
        told.to_string().contains("odd:4: container.shape = \"round\": must be one of box, cylinder, bowl"),
        "{told}"
    );
}
