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
