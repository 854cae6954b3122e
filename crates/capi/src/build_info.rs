//! `hapflow_build_info`: what the library is and has, as lines.

use crate::caller::{Buffer, Out};
use crate::code::Code;
use crate::fence::fence_main;
use crate::library::{NEWEST_ABI, OLDEST_ABI};
use hapflow_engine::settings::{Kind, SETTINGS};
use std::ffi::c_char;

/// Optional parts of the build.
const FEATURES: &[(&str, bool)] = &[
    ("device", cfg!(feature = "device")),
    ("log", cfg!(feature = "log")),
    ("test-hooks", cfg!(feature = "test-hooks")),
    ("debug-assertions", cfg!(debug_assertions)),
];

/// The words of a setting that is a choice.
fn words(path: &str) -> String {
    match SETTINGS.iter().find(|s| s.path == path).map(|s| s.kind) {
        Some(Kind::Choice(words)) => words.join(" "),
        _ => String::new(),
    }
}

fn joined<'a>(names: impl Iterator<Item = &'a str>) -> String {
    names.collect::<Vec<_>>().join(" ")
}

/// The lines.
fn text() -> String {
    let abi: Vec<String> = (OLDEST_ABI..=NEWEST_ABI).map(|v| v.to_string()).collect();
    let lines = [
        ("version", env!("CARGO_PKG_VERSION").to_string()),
        ("abi", abi.join(" ")),
        ("target", format!("{} {}", std::env::consts::ARCH, std::env::consts::OS)),
        ("features", joined(FEATURES.iter().filter(|f| f.1).map(|f| f.0))),
        ("backends", words("run.backend")),
        ("solvers", words("fluid.solver")),
        ("modes", words("fluid.mode")),
        ("couplings", words("run.coupling")),
        ("tools", words("tool.shape")),
        ("devices", joined(hapflow_devices::list().iter().map(|d| d.name))),
        ("scenes", joined(hapflow_engine::shipped().iter().map(|s| s.0))),
    ];
    lines.iter().map(|(key, value)| format!("{key} = {value}\n")).collect()
}

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn hapflow_build_info(out: Buffer<c_char>, capacity: usize, length: Out<usize>) -> Code {
    fence_main(|| Ok(out.enumerate_text(capacity, length, &text())?))
}
