//! The binary interface as it was published: symbols, prototypes, layouts and numbers, compared with
//! `crates/capi/abi/`. Programs that are compiled against a release hold on to all of them.
// A test's helpers fail as the test does.
#![allow(clippy::unwrap_used, clippy::panic)]
#![cfg(all(unix, target_pointer_width = "64"))]

mod c_support;

use c_support::header::{constants, prototypes, structs};
use c_support::{Variant, compile, library, root, scratch};
use std::collections::BTreeSet;
use std::env;
use std::ffi::OsStr;
use std::fmt::Write as _;
use std::fs;
use std::process::Command;

/// Compares `now` with the snapshot `name`, or makes it the snapshot.
fn compare(name: &str, now: &str) {
    let path = root().join("crates/capi/abi").join(name);
    if env::var_os("HAPFLOW_BLESS").is_some_and(|v| v == "1") {
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(&path, now).unwrap();
    }
    let then = fs::read_to_string(&path).unwrap_or_default();
    let lines = |text: &str| text.lines().map(String::from).collect::<BTreeSet<_>>();
    let (old, new) = (lines(&then), lines(now));
    let (gone, come): (Vec<_>, Vec<_>) = (old.difference(&new).collect(), new.difference(&old).collect());
    // A struct's own line may change as it grows at its end: its fields' lines must not.
    let step = if gone.iter().all(|line| line.starts_with("struct ")) {
        "Something came to it: programs that are compiled go on, and the release's minor number goes up."
    } else {
        "Something changed or went: programs that are compiled BREAK. Grow at the end instead; else a new \
         HAPFLOW_ABI_VERSION, and the old one is no longer spoken."
    };
    assert!(
        then == now,
        "the C interface is not that of crates/capi/abi/{name}\n  gone: {gone:#?}\n  new: {come:#?}\n{step}\n\
         If that is meant: HAPFLOW_BLESS=1 cargo test --test c_snapshot, the version step, and a line in the \
         changelog."
    );
}

/// Names that the library exports.
fn exported() -> BTreeSet<String> {
    let library = library(Variant::Shipped);
    let nm = Command::new("nm").args(["-D", "--defined-only"]).arg(library).output().unwrap();
    let listed = String::from_utf8(nm.stdout).unwrap();
    listed.lines().filter_map(|line| line.rsplit(' ').next()).map(String::from).collect()
}

#[test]
fn the_symbols_and_prototypes_are_those_of_the_snapshot() {
    let mut declared = prototypes();
    declared.sort_by(|a, b| a.name.cmp(&b.name));
    assert_eq!(declared.iter().map(|p| p.name.clone()).collect::<BTreeSet<_>>(), exported());
    let lines: Vec<_> = declared.iter().map(|p| format!("{};\n", p.declared)).collect();
    compare("symbols.txt", &lines.concat());
}

/// A C program that prints every layout and number.
fn program() -> String {
    let mut c = String::from(
        "#include <hapflow/hapflow.h>\n#include <stdio.h>\n\
         #define SIZE(type) printf(\"struct %s: size %zu, align %zu\\n\", #type, sizeof(type), _Alignof(type));\n\
         #define FIELD(type, field) printf(\"%s.%s: at %zu, %zu bytes\\n\", #type, #field, offsetof(type, field), \
         sizeof(((type*)0)->field));\n\
         #define NUMBER(name) printf(\"%s = %lld\\n\", #name, (long long)(name));\n\
         int main(void) {\n",
    );
    for record in structs() {
        let name = record.name;
        writeln!(c, "    SIZE({name})").unwrap();
        for field in record.fields {
            writeln!(c, "    FIELD({name}, {field})").unwrap();
        }
    }
    for name in constants() {
        writeln!(c, "    NUMBER({name})").unwrap();
    }
    c + "    return 0;\n}\n"
}

#[test]
fn the_layouts_and_numbers_are_those_of_the_snapshot() {
    let (source, binary) = (scratch().join("layouts.c"), scratch().join("layouts"));
    fs::write(&source, program()).unwrap();
    let args = [source.as_os_str(), OsStr::new("-o"), binary.as_os_str()];
    compile("cc", "c11", &args).unwrap_or_else(|e| panic!("{e}"));
    let output = Command::new(&binary).output().unwrap();
    let printed = String::from_utf8(output.stdout).unwrap();
    assert!(structs().len() >= 8 && constants().len() >= 40 && printed.lines().count() > 100);
    compare("layouts.txt", &printed);
}
