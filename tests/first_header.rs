//! A host that was compiled with the first header of this version of the interface runs on today's library, and feels what
//! one of today's header feels.
//!
//! `tests/first_header/hapflow/hapflow.h` is that header, byte for byte, as it first came (commit 363ad48, 24 November
//! 2026). It never changes while `HAPFLOW_ABI_VERSION` is what it says; with a new version comes the first header of that.
#![allow(clippy::unwrap_used, clippy::panic)]

mod c_support;

use c_support::{Variant, compile, library, root, scratch};
use std::ffi::OsStr;
use std::process::Command;

/// What the host says that was compiled with these flags.
fn said(name: &str, flags: &[&str]) -> String {
    let (library, program) = (library(Variant::Shipped), scratch().join(name));
    let source = root().join("tests/first_header/host.c");
    let mut args: Vec<&OsStr> = flags.iter().map(OsStr::new).collect();
    args.extend([source.as_os_str(), library.as_os_str(), OsStr::new("-lm"), OsStr::new("-o")]);
    args.push(program.as_os_str());
    compile("cc", "c11", &args).unwrap_or_else(|e| panic!("{e}"));
    let output = Command::new(program).env("LD_LIBRARY_PATH", library.parent().unwrap()).output().unwrap();
    let (out, err) = (String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    assert!(output.status.success(), "{name}: {}\n{out}\n{err}", output.status);
    out.into_owned()
}

#[test]
fn a_host_of_the_first_header_feels_what_one_of_todays_does() {
    let (first, newest) = (said("first-host", &[]), said("newest-host", &["-DNEWEST"]));
    assert_eq!(first.lines().filter(|line| line.starts_with("force ")).count(), 2);
    assert_eq!(first, newest);
}
