//! What a C program can ask for before it knows anything: settings, scenes, devices, and what the build has.
// A test's helpers fail as the test does.
#![allow(clippy::unwrap_used, clippy::panic)]

mod c_support;

use c_support::{Api, JET, SessionConfig, SettingInfo, Variant, code, made, shown};
use hapflow::engine::settings::{OBSTACLE_SETTINGS, SETTINGS, SOURCE_SETTINGS, TOOL_SETTINGS};
use hapflow::engine::shipped;
use std::collections::BTreeSet;
use std::ffi::{CStr, CString};
use std::ptr::null_mut;

fn ready() -> Api {
    Api::ready(Variant::Shipped)
}

#[test]
fn every_setting_is_listed_once_with_the_scenes_things_by_name() {
    let api = ready();
    let two = format!("{JET}\n[[source]]\nname = \"hose\"\nposition = [0.05, 0.05, 0.0]\n")
        .replace("backend = \"analytic-jet\"", "")
        + "[[obstacle]]\nname = \"stone\"\nposition = [0.0, -0.08, 0.0]\n"
        + "[[tool]]\nradius = 0.02\n[[tool]]\nname = \"left\"\nposition = [0.06, 0.0, 0.0]\n";
    let session = api.try_create(&two).unwrap();
    let all = api.settings(session);
    assert_eq!(
        all.len(),
        SETTINGS.len() + 2 * SOURCE_SETTINGS.len() + OBSTACLE_SETTINGS.len() + TOOL_SETTINGS.len()
    );
    let paths: BTreeSet<_> = all.iter().map(|s| shown(s.path)).collect();
    assert_eq!(paths.len(), all.len());
    assert!(paths.contains("source.tap.speed") && paths.contains("source.hose.speed"));
    assert!(paths.contains("obstacle.stone.radius") && paths.contains("tool.left.radius"));
    for info in &all {
        let (path, group) = (shown(info.path), shown(info.group));
        assert_eq!(path.rsplit_once('.').unwrap().0, group);
        assert!(!shown(info.about).is_empty(), "{path}");
        assert_eq!((info.size, info.reserved), (80, 0));
        assert!(info.min < info.max || [3, 4, 5].contains(&info.kind), "{path}");
    }
}

#[test]
fn a_setting_says_what_the_engine_says() {
    let api = ready();
    let session = api.jet();
    let all = api.settings(session);
    let find = |path: &str| *all.iter().find(|s| shown(s.path) == path).unwrap();
    let facts = |i: SettingInfo| (i.kind, i.live, i.min, i.max);
    let speed = find("source.tap.speed");
    assert_eq!((facts(speed), shown(speed.unit)), ((1, 1, 0.0, 20.0), "m/s"));
    assert_eq!(facts(find("fluid.max_particles")), (2, 1, 1.0, 5e6));
    assert_eq!(facts(find("fluid.two_way")), (3, 1, 0.0, 0.0));
    let solver = find("fluid.solver");
    assert_eq!((facts(solver), shown(solver.choices)), ((4, 1, 0.0, 0.0), "wcsph\ndfsph\nmuller"));
    assert_eq!(shown(solver.usual), "wcsph");
    assert_eq!(facts(find("run.filter")), (5, 0, 0.0, 0.0));
    assert_eq!(facts(find("fluid.gravity")), (6, 1, -100.0, 100.0));
    assert_eq!(shown(find("fluid.gravity").usual), "[0, -9.81, 0]");
}

#[test]
fn what_is_live_can_be_set_to_its_value_and_what_is_not_cannot() {
    let api = ready();
    let session = api.jet();
    for info in api.settings(session) {
        // SAFETY: the session's text, while the session lives.
        let path = unsafe { CStr::from_ptr(info.path) };
        let value = CString::new(api.get_text(session, path)).unwrap();
        let result = (api.session_set_text)(session, path.as_ptr(), value.as_ptr());
        let expected = if info.live == 1 { code::OK } else { code::FIXED };
        assert_eq!(result, expected, "{path:?} = {value:?}: {}", api.error());
    }
}

#[test]
fn the_usual_value_is_taken_back_by_a_configuration() {
    let api = ready();
    let toml = CString::new(JET).unwrap();
    for info in api.settings(api.jet()) {
        let line = CString::new(format!("{} = {}", shown(info.path), shown(info.usual))).unwrap();
        let config = SessionConfig { toml: toml.as_ptr(), settings: line.as_ptr(), ..api.config() };
        let mut session = c_support::Session::default();
        let result = (api.session_create)(&config, &mut session);
        assert_eq!(result, code::OK, "{line:?}: {}", api.error());
        assert_eq!((api.session_destroy)(session), code::OK);
    }
}

#[test]
fn settings_are_asked_for_wrongly() {
    let api = ready();
    let session = api.jet();
    let (mut info, mut count) = (made(api.setting_info_init), 0);
    assert_eq!((api.session_setting_count)(session, null_mut()), code::NULL);
    assert_eq!((api.session_setting_count)(session, &mut count), code::OK);
    assert_eq!((api.session_setting_info)(session, 0, null_mut()), code::NULL);
    for index in [count, u32::MAX] {
        assert_eq!((api.session_setting_info)(session, index, &mut info), code::INDEX);
        assert_eq!(api.error(), format!("no setting {index}: there are {count}, from 0"));
        assert_eq!((info.kind, shown(info.path)), (0, ""));
    }
    info.size = 79;
    assert_eq!((api.session_setting_info)(session, 0, &mut info), code::STRUCT);
    assert_eq!((api.setting_info_init)(&mut info, 79), code::STRUCT);
    assert_eq!((api.setting_info_init)(null_mut(), 80), code::NULL);
    assert_eq!((api.session_destroy)(session), code::OK);
    assert_eq!((api.session_setting_count)(session, &mut count), code::HANDLE);
    assert_eq!((api.session_setting_info)(session, 0, &mut info), code::HANDLE);
}

#[test]
fn the_shipped_scenes_are_listed_and_each_can_be_made() {
    let api = ready();
    assert_eq!((api.scene_count)() as usize, shipped().len());
    let mut info = made(api.scene_info_init);
    for (index, (name, toml)) in shipped().iter().enumerate() {
        assert_eq!((api.scene_get)(index as u32, &mut info), code::OK);
        assert_eq!((shown(info.name), shown(info.toml)), (*name, *toml));
        assert!(shown(info.about).len() > 10);
        let config = SessionConfig { scene: info.name, ..api.config() };
        let mut session = c_support::Session::default();
        assert_eq!((api.session_create)(&config, &mut session), code::OK, "{}", api.error());
    }
    assert_eq!((api.scene_get)((api.scene_count)(), &mut info), code::INDEX);
    assert_eq!((api.scene_get)(0, null_mut()), code::NULL);
    assert_eq!((api.scene_info_init)(&mut info, 31), code::STRUCT);
    assert_eq!((api.scene_info_init)(null_mut(), 32), code::NULL);
}

#[test]
fn the_devices_are_listed() {
    let api = ready();
    let mut info = made(api.device_info_init);
    let known = hapflow::devices::list();
    assert_eq!((api.device_count)() as usize, known.len());
    for (index, device) in known.iter().enumerate() {
        assert_eq!((api.device_get)(index as u32, &mut info), code::OK);
        assert_eq!((shown(info.name), shown(info.about)), (device.name, device.about));
        assert_eq!((info.sensed_dof, info.driven_dof), (device.sensed_dof.into(), device.driven_dof.into()));
        assert_eq!((info.max_force, info.hardware), (device.max_force_n, device.hardware.into()));
    }
    assert_eq!((api.device_get)(99, &mut info), code::INDEX);
    assert_eq!((api.device_get)(0, null_mut()), code::NULL);
    assert_eq!((api.device_info_init)(&mut info, 39), code::STRUCT);
    assert_eq!((api.device_info_init)(null_mut(), 40), code::NULL);
}

#[test]
fn the_build_says_what_it_has_even_before_the_version() {
    let api = Api::load(Variant::Shipped);
    let info = api.build_info();
    let line = |key: &str| {
        let found = info.lines().find_map(|l| l.strip_prefix(key)?.strip_prefix(" = "));
        found.unwrap_or_else(|| panic!("no {key} in {info}"))
    };
    assert_eq!((line("version"), line("abi")), (env!("CARGO_PKG_VERSION"), "1"));
    assert_eq!((line("solvers"), line("couplings")), ("wcsph dfsph muller", "direct momentum local"));
    assert_eq!(
        (line("backends"), line("devices")),
        ("cpu analytic-jet", "null replay hand falcon emulated-falcon force-dimension touch spacemouse")
    );
    assert!(line("scenes").starts_with("tap ") && line("target").contains(std::env::consts::ARCH));
    assert!(!line("features").contains("test-hooks"));
    assert!(line("modes").contains("full") && line("tools").contains("disc"));
    assert_eq!((api.build_info)(null_mut(), 0, null_mut()), code::NULL);
    assert!(Api::load(Variant::Hooks).build_info().contains("test-hooks"));
}
