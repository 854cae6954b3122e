//! What the tests share: small scenes.
#![allow(dead_code, clippy::unwrap_used)]

use hapflow::engine::{Scene, Session, SessionOptions, Value, parse, settings};

/// A falling jet on a ball, no ground, coarse and quick.
pub const JET: &str = r#"
name = "jet"
[run]
duration = 0.3
fluid_hz = 100
filter = "none"
device = "null"
[fluid]
spacing = 0.006
[bounds]
min = [-0.1, -0.12, -0.1]
max = [0.1, 0.12, 0.1]
[[source]]
name = "tap"
position = [0.0, 0.05, 0.0]
diameter = 0.02
speed = 1.5
[gate]
ramp_in = 0.0
"#;

/// [`JET`] with settings changed.
pub fn jet(changes: &[(&str, Value)]) -> Scene {
    let mut scene = parse(JET, "jet").unwrap();
    for (path, value) in changes {
        settings::set(&mut scene, path, value).unwrap();
    }
    scene
}

/// A word as a value.
pub fn word(text: &str) -> Value {
    Value::Text(text.into())
}

/// A session that the test drives, with `threads` workers.
pub fn open(scene: &Scene, threads: usize) -> Session {
    Session::open(scene, SessionOptions { threads, ..SessionOptions::hosted() }).unwrap()
}
