//! Scenes that a host builds by calls.
// A test's helpers fail as the test does.
#![allow(clippy::unwrap_used, clippy::panic)]

mod c_support;

use c_support::{
    Api, BodyConfig, JET, ObstacleConfig, Scene, Session, SessionConfig, SourceConfig, ToolConfig, Variant,
    Wrench, code, made,
};
use hapflow::engine::{load, parse, shipped};
use std::ffi::{CStr, CString};
use std::ptr::{null, null_mut};

fn ready() -> Api {
    Api::ready(Variant::Shipped)
}

/// [`JET`] once more, by calls.
fn jet(api: &Api) -> Scene {
    let scene = api.scene();
    let text = |path: &CStr, value: &CStr| (api.scene_set_text)(scene, path.as_ptr(), value.as_ptr());
    assert_eq!(text(c"run.backend", c"analytic-jet"), code::OK);
    assert_eq!(text(c"run.device", c"null"), code::OK);
    for (path, value) in [(c"run.duration", 0.2), (c"run.fluid_hz", 100.0), (c"gate.ramp_in", 0.02)] {
        assert_eq!((api.scene_set)(scene, path.as_ptr(), value), code::OK);
    }
    assert_eq!((api.scene_set_bounds)(scene, &[-0.1, -0.12, -0.1], &[0.1, 0.12, 0.1]), code::OK);
    let tap = SourceConfig {
        name: c"tap".as_ptr(),
        position: [0.0, 0.05, 0.0],
        speed: 1.5,
        ..made(api.source_config_init)
    };
    let mut index = 7;
    assert_eq!(((api.scene_add_source)(scene, &tap, &mut index), index), (code::OK, 0));
    scene
}

fn session_of(api: &Api, built: Scene) -> Session {
    let mut session = Session::default();
    let made = (api.session_create)(&SessionConfig { built, ..api.config() }, &mut session);
    assert_eq!(made, code::OK, "{}", api.error());
    session
}

#[test]
fn a_scene_that_is_built_is_the_one_of_the_file() {
    let api = ready();
    let built = jet(&api);
    let forces = api.run(session_of(&api, built), 0, 100);
    assert!(forces.last().unwrap().force[1] < -0.1);
    assert_eq!(forces, api.run(api.jet(), 0, 100));
    let mut written = parse(&api.written(built), "built").unwrap();
    written.name = "jet".into();
    assert_eq!(written, parse(JET, "jet").unwrap());
}

#[test]
fn a_scene_serves_several_sessions_and_may_go_before_them() {
    let api = ready();
    let built = jet(&api);
    let first = session_of(&api, built);
    assert_eq!((api.scene_set)(built, c"source.tap.speed".as_ptr(), 0.5), code::OK);
    let second = session_of(&api, built);
    assert_eq!((api.scene_destroy)(built), code::OK);
    assert_eq!((api.scene_destroy)(built), code::HANDLE);
    let [first, second] = [first, second].map(|s| api.run(s, 0, 100).last().unwrap().force[1]);
    assert!(first < 3.0 * second && second < 0.0, "{first} {second}");
    let mut session = Session::default();
    let stale = SessionConfig { built, ..api.config() };
    assert_eq!((api.session_create)(&stale, &mut session), code::HANDLE);
}

#[test]
fn every_shipped_scene_is_loaded_written_and_parsed_as_it_was() {
    let api = ready();
    for (name, _) in shipped() {
        let (mut loaded, mut parsed) = (Scene::default(), Scene::default());
        let c_name = CString::new(*name).unwrap();
        assert_eq!((api.scene_load)(c_name.as_ptr(), &mut loaded), code::OK);
        assert_eq!((api.scene_check)(loaded), code::OK);
        let text = api.written(loaded);
        assert_eq!(parse(&text, "written").unwrap(), load(name).unwrap());
        assert_eq!((api.scene_parse)(text.as_ptr().cast(), text.len(), &mut parsed), code::OK);
        assert_eq!(api.written(parsed), text, "{name}");
    }
}

#[test]
fn every_part_can_be_added_and_the_session_has_it() {
    let api = ready();
    let scene = jet(&api);
    assert_eq!((api.scene_set_text)(scene, c"run.backend".as_ptr(), c"cpu".as_ptr()), code::OK);
    assert_eq!((api.scene_set)(scene, c"fluid.spacing".as_ptr(), 0.01), code::OK);
    let plate = ObstacleConfig {
        name: c"plate".as_ptr(),
        shape: 2,
        radius: 0.04,
        thickness: 0.008,
        position: [0.0, 0.028, 0.0],
        ..made(api.obstacle_config_init)
    };
    let second =
        ToolConfig { position: [0.06, 0.0, 0.0], solid_stiffness: 300.0, ..made(api.tool_config_init) };
    let (low, high, mut index) = ([-0.02; 3], [0.02; 3], 7);
    assert_eq!(((api.scene_add_obstacle)(scene, &plate, &mut index), index), (code::OK, 0));
    assert_eq!(((api.scene_add_tool)(scene, &second, &mut index), index), (code::OK, 1));
    assert_eq!(((api.scene_add_pool)(scene, &low, &high, &mut index), index), (code::OK, 0));
    assert_eq!(((api.scene_add_sink)(scene, &low, &high, &mut index), index), (code::OK, 0));
    assert_eq!((api.scene_add_sink)(scene, &low, &high, null_mut()), code::OK);
    assert_eq!((api.scene_set_ground)(scene, &-0.1), code::OK);
    assert_eq!((api.scene_set_container)(scene, &low, &high), code::OK);
    let gravity = [0.0, -1.6, 0.0];
    assert_eq!((api.scene_set_vector)(scene, c"fluid.gravity".as_ptr(), &gravity), code::OK);
    let change = c"# later\nsource.tap.on = false\n\nfluid.viscosity = 0.1\n";
    assert_eq!((api.scene_add_change)(scene, 0.1, change.as_ptr()), code::OK, "{}", api.error());
    assert_eq!((api.scene_check)(scene), code::OK, "{}", api.error());
    let text = api.written(scene);
    let read = parse(&text, "parts").unwrap();
    assert_eq!((read.sinks.len(), read.pools.len(), read.ground), (2, 1, Some(-0.1)), "{text}");
    assert_eq!(read.changes[0].settings.len(), 2);
    assert!(
        read.container.is_some() && read.obstacles[0].form.radius == 0.04 && read.fluid.gravity.y == -1.6
    );
    let session = session_of(&api, scene);
    let (mut tools, mut obstacles) = (0, 0);
    assert_eq!((api.session_tool_count)(session, &mut tools), code::OK);
    assert_eq!((api.obstacle_count)(session, &mut obstacles), code::OK);
    assert_eq!((tools, obstacles), (2, 1));
    assert_eq!(api.get(session, "tool.1.solid_stiffness"), Ok(300.0));
    // And taken away again.
    assert_eq!((api.scene_set_ground)(scene, null()), code::OK);
    assert_eq!((api.scene_set_container)(scene, null(), null()), code::OK);
    let text = api.written(scene);
    assert!(!text.contains("ground") && !text.contains("container"), "{text}");
}

/// Each refusal: its result, and what the last error tells.
fn refused(api: &Api, result: i32, expected: i32, words: &[&str]) {
    let told = api.error();
    assert_eq!(result, expected, "{told}");
    assert!(words.iter().all(|word| told.contains(word)), "{told}: {words:?}");
}

#[test]
fn what_cannot_be_is_refused_with_the_reason_and_the_scene_stays() {
    let api = ready();
    let scene = jet(&api);
    let before = api.written(scene);
    let source = |spoil: fn(&mut SourceConfig)| {
        let mut config = made(api.source_config_init);
        spoil(&mut config);
        (api.scene_add_source)(scene, &config, null_mut())
    };
    let obstacle = |spoil: fn(&mut ObstacleConfig)| {
        let mut config = made(api.obstacle_config_init);
        spoil(&mut config);
        (api.scene_add_obstacle)(scene, &config, null_mut())
    };
    let tool = |spoil: fn(&mut ToolConfig)| {
        let mut config = made(api.tool_config_init);
        spoil(&mut config);
        (api.scene_add_tool)(scene, &config, null_mut())
    };
    let value = code::VALUE;
    refused(&api, source(|s| s.name = c"tap".as_ptr()), value, &["source.name = \"tap\"", "no other has"]);
    refused(&api, source(|s| s.speed = 99.0), value, &["source.1.speed = 99", "0 to 20 m/s"]);
    refused(&api, source(|s| s.position[1] = f64::NAN), code::NOT_FINITE, &["position"]);
    refused(&api, source(|s| s.duty = f64::INFINITY), code::NOT_FINITE, &["duty"]);
    refused(&api, source(|s| s.on = 2), code::UNSUPPORTED, &["on = 2", "0 or 1"]);
    refused(&api, source(|s| s.reserved = 1), code::UNSUPPORTED, &[]);
    refused(&api, source(|s| s.next = JET.as_ptr().cast()), code::UNSUPPORTED, &[]);
    refused(&api, source(|s| s.kind = 1), code::STRUCT, &[]);
    refused(&api, source(|s| s.size = 111), code::STRUCT, &[]);
    refused(&api, source(|s| s.name = c"\xff".as_ptr()), code::TEXT, &[]);
    refused(&api, obstacle(|o| o.shape = 7), code::UNSUPPORTED, &["shape = 7", "HAPFLOW_SHAPE_MESH"]);
    refused(&api, obstacle(|o| o.extent[1] = f64::NAN), code::NOT_FINITE, &["extent"]);
    refused(&api, obstacle(|o| o.length = 9.0), value, &["obstacle.0.length = 9", "0.001 to 1 m"]);
    refused(&api, obstacle(|o| o.file = c"no.obj".as_ptr()), value, &["no.obj", "closed mesh"]);
    refused(&api, tool(|t| t.file = c"no.txt".as_ptr()), value, &["no.txt", "closed mesh"]);
    refused(&api, obstacle(|o| o.radius = -1.0), value, &["obstacle.0.radius = -1", "0.001 to 0.5 m"]);
    refused(&api, obstacle(|o| o.thickness = f64::NAN), code::NOT_FINITE, &["thickness"]);
    refused(
        &api,
        tool(|t| t.solid_stiffness = 2e4),
        value,
        &["tool.1.solid_stiffness = 20000", "0 to 10000"],
    );
    let body = |spoil: fn(&mut BodyConfig)| {
        let mut config = made(api.body_config_init);
        spoil(&mut config);
        (api.scene_add_body)(scene, &config, null_mut())
    };
    refused(&api, body(|b| b.density = 0.0), value, &["body.0.density = 0", "1 to 100000 kg/m³"]);
    refused(&api, body(|b| b.mesh = JET.as_ptr().cast()), code::UNSUPPORTED, &[]);
    refused(&api, (api.scene_set_periodic)(scene, 8), code::UNSUPPORTED, &["axes = 8", "0 to 7"]);
    refused(&api, tool(|t| t.name = c"0".as_ptr()), value, &["tool.name = \"0\""]);
    let (low, high) = ([0.0; 3], [1.0; 3]);
    refused(&api, (api.scene_add_pool)(scene, &high, &low, null_mut()), value, &["pool.min", "below max"]);
    refused(
        &api,
        (api.scene_add_sink)(scene, &low, &[1e3; 3], null_mut()),
        value,
        &["sink.max = 1000", "100"],
    );
    refused(&api, (api.scene_set_bounds)(scene, &low, &[f64::NAN; 3]), code::NOT_FINITE, &["max"]);
    refused(&api, (api.scene_set_container)(scene, &low, null()), code::NULL, &[]);
    refused(&api, (api.scene_set_ground)(scene, &1e9), value, &["ground = 1000000000", "-100 to 100"]);
    refused(&api, (api.scene_set_ground)(scene, &f64::NAN), code::NOT_FINITE, &["height"]);
    let change = |at_s, text: &CStr| (api.scene_add_change)(scene, at_s, text.as_ptr());
    refused(&api, change(-1.0, c""), value, &["change.at_s = -1", "0 to 3600"]);
    refused(&api, change(1.0, c"\nfluid.viscosity"), value, &["settings:2", "path = value"]);
    refused(&api, change(1.0, c"run.fluid_hz = 60"), code::FIXED, &["run.fluid_hz"]);
    refused(&api, change(1.0, c"fluid.viscosty = 1"), code::SETTING, &["did you mean fluid.viscosity"]);
    refused(&api, change(1.0, c"fluid.viscosity = nan"), value, &["fluid.viscosity = NaN"]);
    let set = |path: &CStr, number| (api.scene_set)(scene, path.as_ptr(), number);
    refused(&api, set(c"fluid.viscosity", -1.0), value, &["fluid.viscosity = -1", "0 to 10000"]);
    refused(&api, set(c"fluid.viscosity", f64::NAN), code::NOT_FINITE, &["fluid.viscosity"]);
    refused(&api, set(c"fluid.viscosty", 1.0), code::SETTING, &["did you mean"]);
    assert_eq!(api.written(scene), before);
    // What is sound by itself, and not together.
    assert_eq!(set(c"fluid.sound_speed", 2000.0), code::OK);
    refused(&api, (api.scene_check)(scene), value, &["the speed of sound is too high"]);
    let mut session = Session::default();
    let config = SessionConfig { built: scene, ..api.config() };
    refused(&api, (api.session_create)(&config, &mut session), value, &["the speed of sound is too high"]);
    let both = SessionConfig { scene: c"tap".as_ptr(), ..config };
    refused(
        &api,
        (api.session_create)(&both, &mut session),
        code::SCENE,
        &["only one of scene, toml and built"],
    );
}

#[test]
fn a_free_body_falls_and_is_reported() {
    let api = ready();
    let scene = jet(&api);
    let ball =
        BodyConfig { shape: 5, density: 2000.0, position: [0.05, 0.0, 0.05], ..made(api.body_config_init) };
    let mut index = 9;
    assert_eq!(((api.scene_add_body)(scene, &ball, &mut index), index), (code::OK, 0));
    assert_eq!((api.scene_set_periodic)(scene, 5), code::OK);
    let text = api.written(scene);
    assert!(text.contains("periodic = [\"x\", \"z\"]") && text.contains("shape = \"box\""), "{text}");
    let session = session_of(&api, scene);
    let report = |which, index| {
        let mut report = made(api.body_report_init);
        ((api.session_body_report)(session, which, index, &mut report), report)
    };
    let (result, before) = report(3, 0);
    assert_eq!(
        (result, before.position, before.orientation),
        (code::OK, ball.position, [0.0, 0.0, 0.0, 1.0])
    );
    assert_eq!((api.fluid_advance)(session, 0.1), code::OK);
    let (_, fallen) = report(3, 0);
    assert!(fallen.position[1] < -0.02 && fallen.velocity[1] < -0.5, "{fallen:?}");
    assert_eq!(api.get(session, "body.0.density"), Ok(2000.0));
    assert_eq!(report(1, 0).0, code::OK);
    for (which, index, expected) in
        [(1, 1, code::INDEX), (2, 0, code::INDEX), (3, 1, code::INDEX), (0, 0, code::UNSUPPORTED)]
    {
        assert_eq!(report(which, index).0, expected, "{which} {index}");
    }
}

#[test]
fn nulls_and_stale_handles_are_codes() {
    let api = ready();
    let (scene, path) = (jet(&api), c"fluid.viscosity".as_ptr());
    let corner = [0.0; 3];
    assert_eq!((api.scene_create)(null_mut()), code::NULL);
    assert_eq!((api.scene_load)(null(), &mut Scene::default()), code::NULL);
    assert_eq!((api.scene_load)(c"tapp".as_ptr(), &mut Scene::default()), code::NOT_FOUND);
    assert_eq!((api.scene_parse)(null(), 0, &mut Scene::default()), code::NULL);
    assert_eq!((api.scene_set)(scene, null(), 1.0), code::NULL);
    assert_eq!((api.scene_set_text)(scene, path, null()), code::NULL);
    assert_eq!((api.scene_set_vector)(scene, path, null()), code::NULL);
    assert_eq!((api.scene_set_bounds)(scene, null(), &corner), code::NULL);
    assert_eq!((api.scene_add_pool)(scene, &corner, null(), null_mut()), code::NULL);
    assert_eq!((api.scene_add_source)(scene, null(), null_mut()), code::NULL);
    assert_eq!((api.scene_add_obstacle)(scene, null(), null_mut()), code::NULL);
    assert_eq!((api.scene_add_tool)(scene, null(), null_mut()), code::NULL);
    assert_eq!((api.scene_add_change)(scene, 1.0, null()), code::NULL);
    assert_eq!((api.scene_write)(scene, null_mut(), 0, null_mut()), code::NULL);
    let config = made(api.source_config_init);
    for stale in [0, 99, scene.id + (1 << 32), u64::MAX].map(|id| Scene { id }) {
        assert_eq!((api.scene_destroy)(stale), code::HANDLE);
        assert_eq!((api.scene_set)(stale, path, 1.0), code::HANDLE);
        assert_eq!((api.scene_check)(stale), code::HANDLE);
        assert_eq!((api.scene_add_source)(stale, &config, null_mut()), code::HANDLE);
        assert_eq!((api.scene_write)(stale, null_mut(), 0, &mut 0), code::HANDLE);
    }
    // A session's handle is none of a scene, and the other way round.
    let session = api.jet();
    assert_eq!(api.tick(Session { id: scene.id + 7 }, &api.state(0)), (code::HANDLE, Wrench::ZERO));
    assert_eq!((api.session_destroy)(session), code::OK);
}

#[test]
fn there_are_as_many_as_the_header_says_and_none_before_the_version() {
    let fresh = Api::load(Variant::Shipped);
    assert_eq!((fresh.scene_create)(&mut Scene::default()), code::NOT_NEGOTIATED);
    let api = ready();
    let all: Vec<_> = (0..64).map(|_| api.scene()).collect();
    assert_eq!((api.scene_create)(&mut Scene::default()), code::FULL);
    assert_eq!((api.scene_destroy)(all[7]), code::OK);
    let again = api.scene();
    assert!(!all.contains(&again), "a handle is never used again");
    let eighth = ToolConfig { ..made(api.tool_config_init) };
    for n in 1..8 {
        let mut index = 0;
        assert_eq!(((api.scene_add_tool)(again, &eighth, &mut index), index), (code::OK, n));
    }
    refused(&api, (api.scene_add_tool)(again, &eighth, null_mut()), code::VALUE, &["tools = 9", "at most 8"]);
}

#[test]
fn a_panic_in_a_scene_leaves_only_destroying() {
    let api = Api::ready(Variant::Hooks);
    let scene = jet(&api);
    (api.test_panic_next_call.unwrap())();
    assert_eq!((api.scene_check)(scene), code::PANIC);
    assert_eq!((api.scene_check)(scene), code::FAULTED);
    assert_eq!((api.scene_destroy)(scene), code::OK);
}
