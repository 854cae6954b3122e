//! The cxx bridge: libhapflow_cxx beside libhapflow in one program.
#![allow(clippy::unwrap_used, clippy::panic)]

mod c_support;
#[path = "../crates/cxx-bridge/src/fence.rs"]
mod fence;

use c_support::{Bridge, Variant, compile, library, root, scratch};
use fence::{Failure, fence};
use std::ffi::{OsStr, OsString};
use std::fs;
use std::process::Command;

#[test]
fn a_program_over_the_bridge_shares_a_session_with_c() {
    let (hooks, program) = (library(Variant::Hooks), scratch().join("cxx-bridge"));
    let strict =
        ["-Wconversion", "-Wsign-conversion", "-Wshadow", "-Wold-style-cast", "-pthread"].map(OsString::from);
    let mut args = strict.to_vec();
    args.extend(["-I".into(), root().join("cpp/include").into_os_string()]);
    args.push(root().join("cpp/tests/bridge.cpp").into_os_string());
    args.extend(Bridge::built().args());
    args.extend(["-L".into(), hooks.parent().unwrap().as_os_str().into(), "-lhapflow".into()]);
    args.extend(["-o".into(), program.clone().into_os_string()]);
    let args: Vec<&OsStr> = args.iter().map(OsString::as_os_str).collect();
    compile("c++", "c++17", &args).unwrap_or_else(|e| panic!("{e}"));
    let paths = std::env::join_paths([hooks.parent().unwrap(), Bridge::built().folder()]).unwrap();
    let output = Command::new(program).env("LD_LIBRARY_PATH", paths).output().unwrap();
    let err = String::from_utf8_lossy(&output.stderr);
    assert_eq!(String::from_utf8_lossy(&output.stdout), "all passed\n", "{err}");
}

#[test]
fn the_bridge_has_no_session_of_its_own() {
    let names = |option: &str| {
        let library = Bridge::built().folder().join("libhapflow_cxx.so");
        let output = Command::new("nm").args(["-D", option]).arg(library).output().unwrap();
        String::from_utf8_lossy(&output.stdout).into_owned()
    };
    let is_c = |line: &&str| line.split_whitespace().last().is_some_and(|n| n.starts_with("hapflow_"));
    assert!(names("--undefined-only").lines().any(|l| l.ends_with(" hapflow_servo_tick")));
    assert_eq!(names("--defined-only").lines().filter(is_c).count(), 0);
}

#[test]
fn every_bridged_function_can_fail_and_none_panics() {
    let source = fs::read_to_string(root().join("crates/cxx-bridge/src/lib.rs")).unwrap();
    let bridged = source.split_once("extern \"Rust\" {").unwrap().1;
    let functions: Vec<_> = bridged.split(" fn ").skip(1).collect();
    assert!(functions.len() > 15);
    for function in functions {
        assert!(function.contains("-> Result<"), "{function}");
    }
    let caught = fence(|| -> Result<(), Failure> { panic!("on purpose") }).unwrap_err();
    assert_eq!(caught.to_string(), "-1 a panic inside the bridge: please report it");
    assert_eq!(fence(|| Ok(7)), Ok(7));
}
