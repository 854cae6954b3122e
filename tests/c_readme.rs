//! The README's C program works as printed.
// A test's helpers fail as the test does.
#![allow(clippy::unwrap_used, clippy::panic)]

mod c_support;

use c_support::{Variant, compile, library, scratch};
use std::ffi::OsStr;
use std::fs;
use std::process::Command;

const README: &str = include_str!("../README.md");

#[test]
fn the_readmes_c_program_runs_and_feels_the_jet() {
    let (_, rest) = README.split_once("```c\n").unwrap();
    let (program, _) = rest.split_once("```\n").unwrap();
    let (source, binary) = (scratch().join("readme.c"), scratch().join("readme"));
    fs::write(&source, program).unwrap();
    let library = library(Variant::Shipped);
    let args = [source.as_os_str(), library.as_os_str(), OsStr::new("-o"), binary.as_os_str()];
    compile("cc", "c11", &args).unwrap_or_else(|e| panic!("{e}"));
    let out = Command::new(&binary).env("LD_LIBRARY_PATH", library.parent().unwrap()).output().unwrap();
    let said = String::from_utf8(out.stdout).unwrap();
    let force: f64 = said.strip_suffix(" N down\n").unwrap().parse().unwrap();
    assert!(out.status.success() && force > 0.05 && force < 1.0, "{said}");
}
