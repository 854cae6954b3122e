//! Building: `cargo test` alone makes no libhapflow, and no C program.

use std::env;
use std::ffi::OsStr;
use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;

/// Which libhapflow.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Variant {
    /// As it is shipped.
    Shipped,
    /// With the feature `test-hooks`.
    Hooks,
    /// Without any optional part.
    Bare,
}

/// The repository's root.
pub fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Where cargo puts what it builds with this test's profile: `target/debug`.
fn profile_dir() -> PathBuf {
    let test = env::current_exe().unwrap();
    test.parent().and_then(Path::parent).unwrap().to_path_buf()
}

/// A folder for what the tests make.
pub fn scratch() -> PathBuf {
    let dir = profile_dir().join("c-tests");
    fs::create_dir_all(&dir).unwrap();
    dir
}

/// The path of libhapflow: `HAPFLOW_LIBRARY`, for one with all parts that was built in another way; else it is built
/// with this test's profile into this test's target directory.
pub fn library(variant: Variant) -> PathBuf {
    if let Some(given) = env::var_os("HAPFLOW_LIBRARY").filter(|_| variant != Variant::Bare) {
        return given.into();
    }
    static BUILT: [OnceLock<PathBuf>; 3] = [const { OnceLock::new() }; 3];
    BUILT[variant as usize].get_or_init(|| build(variant)).clone()
}

fn build(variant: Variant) -> PathBuf {
    let (folder, options): (_, &[_]) = match variant {
        Variant::Shipped => ("shipped", &[]),
        Variant::Hooks => ("hooks", &["--features", "test-hooks"]),
        Variant::Bare => ("bare", &["--no-default-features"]),
    };
    cargo_build("hapflow-capi", options, "libhapflow.so", folder)
}

/// Builds a package with this test's profile, and keeps its library in a folder of its own.
pub(super) fn cargo_build(package: &str, options: &[&str], library: &str, folder: &str) -> PathBuf {
    // All variants come out under one name: nobody else may build between cargo and the copy.
    let lock = File::create(scratch().join("lock")).unwrap();
    lock.lock().unwrap();
    let mut cargo = Command::new(env!("CARGO"));
    cargo.current_dir(root()).args(["build", "--quiet", "-p", package]).args(options);
    let (profile, target) = (profile_dir(), profile_dir().parent().unwrap().to_path_buf());
    match profile.file_name().and_then(OsStr::to_str).unwrap() {
        "debug" => {}
        name => drop(cargo.args(["--profile", name])),
    }
    assert!(cargo.arg("--target-dir").arg(target).status().unwrap().success(), "{cargo:?}");
    let made = scratch().join(folder).join(library);
    fs::create_dir_all(made.parent().unwrap()).unwrap();
    copy_whole(&profile.join(library), &made);
    made
}

/// Never in place: another test may have the old one mapped.
fn copy_whole(from: &Path, to: &Path) {
    let new = to.with_extension(format!("{}.new", std::process::id()));
    fs::copy(from, &new).unwrap();
    fs::rename(&new, to).unwrap();
}

/// Runs a compiler with warnings as errors and the header's folder, and gives what it said if it failed.
pub fn compile(compiler: &str, standard: &str, args: &[&OsStr]) -> Result<(), String> {
    let warnings = ["-Wall", "-Wextra", "-pedantic", "-Werror"];
    let mut command = Command::new(compiler);
    command.arg(format!("-std={standard}")).args(warnings).arg("-I").arg(root().join("include")).args(args);
    let output = command.output().unwrap_or_else(|e| panic!("{compiler}: {e}"));
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    if output.status.success() { Ok(()) } else { Err(said) }
}
