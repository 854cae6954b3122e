//! `hapflow plugin check` finds libhapflow sound, and others not.
#![allow(clippy::unwrap_used, clippy::panic)]

mod c_support;

use c_support::{Variant, compile, library, root, scratch};
use hapflow_host::{Plugin, check};
use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

/// A library that is libhapflow but for the C in it.
fn spoilt(name: &str, text: &str) -> PathBuf {
    let (source, made) = (scratch().join(format!("{name}.c")), scratch().join(format!("{name}.so")));
    fs::write(&source, format!("#include <hapflow/hapflow.h>\n{text}\n")).unwrap();
    let good = library(Variant::Shipped);
    let flags = ["-shared", "-fPIC", "-Wl,--no-as-needed", "-o"].map(OsStr::new);
    let files = [made.as_os_str(), source.as_os_str(), good.as_os_str()];
    compile("cc", "c11", &[&flags[..], &files].concat()).unwrap_or_else(|e| panic!("{e}"));
    made
}

/// One check at a time: what a hundred sessions leave is told by the memory of the whole process.
static ALONE: Mutex<()> = Mutex::new(());

/// The findings that do not hold, by name, with what they say.
fn failures(file: &Path) -> Vec<(&'static str, String)> {
    let _alone = ALONE.lock().unwrap_or_else(PoisonError::into_inner);
    let mut failures = Vec::new();
    let holds = check(Plugin::load(file).unwrap(), |finding| {
        failures.extend(finding.verdict.as_ref().err().map(|e| (finding.name, e.clone())));
    });
    assert_eq!(holds, failures.is_empty());
    failures
}

#[test]
fn libhapflow_holds_and_is_not_fresh_a_second_time() {
    let fresh = scratch().join("plugin-fresh.so");
    fs::copy(library(Variant::Shipped), &fresh).unwrap();
    assert_eq!(failures(&fresh), []);
    let second = failures(&fresh);
    assert!(
        second.len() == 1 && second[0].1.contains("before a version was agreed on: result 0, must be -2"),
        "{second:?}"
    );
}

#[test]
fn the_report_in_the_documents_has_these_findings() {
    let text = fs::read_to_string(root().join("docs/cpp.md")).unwrap();
    let (_, report) = text.split_once("```text\nok ").unwrap();
    let report = format!("ok {}", report.split_once("\n```").unwrap().0);
    let told: Vec<_> = report.lines().map(|line| line.split_whitespace().nth(1).unwrap()).collect();
    let mut found = Vec::new();
    let _alone = ALONE.lock().unwrap_or_else(PoisonError::into_inner);
    check(Plugin::load(&library(Variant::Shipped)).unwrap(), |finding| found.push(finding.name));
    assert_eq!(told, found);
}

#[test]
fn a_tick_that_writes_nothing_is_found() {
    let found = failures(&spoilt(
        "plugin-silent",
        "hapflow_result hapflow_servo_tick(hapflow_session s, const hapflow_tool_state* t, hapflow_wrench* w) {\n\
         (void)s; (void)t; (void)w; return HAPFLOW_ERROR_NULL; }",
    ));
    // The good half may be the one that another test has used in this process.
    let found: Vec<_> = found.into_iter().filter(|f| f.0 != "versions").collect();
    let names: Vec<_> = found.iter().map(|f| f.0).collect();
    assert_eq!(names, ["misuse", "nan", "threads", "timing"], "{found:?}");
    assert!(found[0].1.starts_with("a tick without a state: the wrench is [NaN"), "{found:?}");
}

#[test]
fn what_is_no_library_of_hapflow_is_refused_with_the_reason() {
    let Err(none) = Plugin::load(Path::new("/no/such/library.so")) else { panic!("there is none") };
    assert!(none.to_string().starts_with("/no/such/library.so: "), "{none}");
    let (source, made) = (scratch().join("plugin-empty.c"), scratch().join("plugin-empty.so"));
    fs::write(&source, "int nothing(void); int nothing(void) { return 0; }\n").unwrap();
    let args = ["-shared", "-fPIC", source.to_str().unwrap(), "-o", made.to_str().unwrap()];
    compile("cc", "c11", &args.map(OsStr::new)).unwrap();
    let Err(lacks) = Plugin::load(&made) else { panic!("it has nothing") };
    assert!(lacks.to_string().contains("undefined symbol: hapflow_"), "{lacks}");
}
