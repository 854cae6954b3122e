//! The C++ wrapper, the other examples, and the installed tree, as programs outside of hapflow see them.
// A test's helpers fail as the test does.
#![allow(clippy::unwrap_used, clippy::panic)]

mod c_support;

use c_support::{Bridge, Variant, compile, header, library, root, scratch};
use hapflow_host::{Extensions, find};
use std::collections::BTreeSet;
use std::ffi::{OsStr, OsString};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// What keeps the fluid cheap in the dev profile.
const COARSE: &str = "fluid.spacing = 0.01";

/// Bits of a report's faults that go by themselves.
const REMARKS: u32 = 1 << 3 | 1 << 6 | 1 << 8 | 1 << 9 | 1 << 10;

/// Whether a program is there; a test without it says that it left something out.
fn there(program: &str) -> bool {
    let found = Command::new(program).arg("--version").output().is_ok_and(|o| o.status.success());
    if !found {
        println!("SKIPPED, for there is no {program}");
    }
    found
}

/// g++, and clang++ where it is installed.
fn compilers() -> impl Iterator<Item = &'static str> {
    ["c++", "clang++"].into_iter().filter(|c| *c == "c++" || there(c))
}

/// Compiles C++ against the wrapper in the source tree, with the warnings that a strict host has.
fn compile_cpp(compiler: &str, args: &[&OsStr]) {
    let include = root().join("cpp/include");
    let strict =
        ["-Wpedantic", "-Wconversion", "-Wsign-conversion", "-Wshadow", "-Wold-style-cast", "-pthread"];
    let mut all: Vec<&OsStr> = strict.iter().map(OsStr::new).collect();
    all.extend([OsStr::new("-I"), include.as_os_str()]);
    all.extend(args);
    compile(compiler, "c++17", &all).unwrap_or_else(|e| panic!("{compiler}: {e}"));
}

/// Compiles and links C++ sources into a program of this name.
fn link_cpp(compiler: &str, sources: &[&Path], name: &str) -> PathBuf {
    let (program, library) = (scratch().join(name), library(Variant::Shipped));
    let mut args: Vec<&OsStr> = sources.iter().map(|s| s.as_os_str()).collect();
    args.extend([OsStr::new("-L"), library.parent().unwrap().as_os_str(), OsStr::new("-lhapflow")]);
    args.extend([OsStr::new("-o"), program.as_os_str()]);
    compile_cpp(compiler, &args);
    program
}

/// Runs a program with the shipped library.
fn run(program: &Path, args: &[&str]) -> Output {
    let library = library(Variant::Shipped);
    Command::new(program).args(args).env("LD_LIBRARY_PATH", library.parent().unwrap()).output().unwrap()
}

/// What a command wrote to stdout; the test fails with the rest if the command did.
fn said(output: &Output) -> String {
    let (out, err) = (String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    assert!(output.status.success(), "{}\n{out}\n{err}", output.status);
    out.into_owned()
}

#[test]
fn the_wrapper_is_clean_alone_and_included_twice() {
    let source = scratch().join("cpp-header.cpp");
    fs::write(&source, "#include <hapflow/hapflow.hpp>\n#include <hapflow/hapflow.hpp>\n").unwrap();
    for compiler in compilers() {
        compile_cpp(compiler, &[OsStr::new("-fsyntax-only"), source.as_os_str()]);
    }
}

#[test]
fn every_function_of_the_wrapper_does_what_it_says() {
    let second = scratch().join("cpp-second.cpp");
    let text = "#include <hapflow/hapflow.hpp>\nstd::uint32_t negotiated_elsewhere();\n\
                std::uint32_t negotiated_elsewhere() { return hapflow::negotiate(); }\n";
    fs::write(&second, text).unwrap();
    for compiler in compilers() {
        let program = link_cpp(
            compiler,
            &[&root().join("cpp/tests/wrapper.cpp"), &second],
            &format!("cpp-wrapper-{compiler}"),
        );
        assert!(said(&run(&program, &[])).contains("all passed"));
        assert_eq!(needed(&program), declared());
    }
}

/// Functions of the library that a program calls. Of a header only what is used gets into it.
fn needed(program: &Path) -> BTreeSet<String> {
    let nm = said(&Command::new("nm").arg("-u").arg(program).output().unwrap());
    let name = |line: &str| line.trim().strip_prefix("U ").map(String::from);
    nm.lines().filter_map(name).filter(|name| name.starts_with("hapflow_")).collect()
}

/// Functions of the C interface.
fn declared() -> BTreeSet<String> {
    header::prototypes().into_iter().map(|p| p.name).collect()
}

#[test]
fn every_function_of_a_class_states_its_thread_class() {
    let wrapper = fs::read_to_string(root().join("cpp/include/hapflow/hapflow.hpp")).unwrap();
    assert!(functions_with_a_class(&wrapper, "Session") > 20);
    assert!(functions_with_a_class(&wrapper, "Device") > 5);
    assert!(functions_with_a_class(&wrapper, "Scene") > 10);
}

fn functions_with_a_class(wrapper: &str, class: &str) -> u32 {
    let begin = format!("\nclass {class} ");
    let class = wrapper.split_once(&begin).unwrap().1.split_once("private:").unwrap().0;
    let (mut comment, mut functions) = (String::new(), 0);
    for line in class.lines().map(str::trim) {
        if let Some(text) = line.strip_prefix("///") {
            comment += text;
        } else if !comment.is_empty() && line.contains('{') {
            let classes = ["[main", "[servo]", "[fluid]", "[obstacle]", "[any]"];
            let classes = classes.iter().filter(|c| comment.contains(**c));
            assert_eq!(classes.count(), 1, "{line}\n{comment}");
            functions += 1;
            comment.clear();
        }
    }
    functions
}

#[test]
fn the_host_loop_feels_the_tap_in_real_time_and_is_short() {
    let source = root().join("examples/host_loop.cpp");
    assert!(fs::read_to_string(&source).unwrap().lines().count() < 90);
    let program = link_cpp("c++", &[&source], "cpp-host-loop");
    let out = said(&run(&program, &["0.3", COARSE]));
    // On a machine under load frames may be left out, and remarks be made: what must hold is that nothing latched.
    let last: Vec<&str> = out.lines().last().unwrap().split_whitespace().collect();
    let after = |word: &str| last[last.iter().position(|w| *w == word).unwrap() + 1];
    let faults = u32::from_str_radix(after("faults").trim_start_matches("0x"), 16).unwrap();
    assert_eq!(faults & !REMARKS, 0, "{out}");
    assert!(
        last[0].parse::<f64>().unwrap() >= 0.3 && after("ticks") != "0" && after("frames") != "0",
        "{out}"
    );

    let wrong = run(&program, &["0.3", "fluid.viscosity = -1"]);
    assert_eq!(wrong.status.code(), Some(1));
    let err = String::from_utf8_lossy(&wrong.stderr);
    assert!(err.contains("fluid.viscosity = -1: must be a number from 0 to 10000 Pa·s"), "{err}");
}

#[test]
fn the_python_example_feels_the_tap() {
    if !there("python3") {
        return;
    }
    let python = |args: &[&str]| {
        let script = root().join("examples/hapflow_ctypes.py");
        let mut command = Command::new("python3");
        command.arg("-B").arg(script).arg(library(Variant::Shipped)).args(args).output().unwrap()
    };
    let out = said(&python(&["0.4", COARSE]));
    let last: Vec<&str> = out.lines().last().unwrap().split_whitespace().collect();
    assert_eq!((out.lines().count(), last[0]), (8, "0.350"), "{out}");
    assert!(last[3].parse::<f64>().unwrap() < -0.05, "nothing was felt: {out}");

    let wrong = python(&["0.4", "fluid.viscosity = -1"]);
    assert!(!wrong.status.success() && wrong.stdout.is_empty());
    assert!(String::from_utf8_lossy(&wrong.stderr).contains("fluid.viscosity = -1: must be a number"));
}

/// Installs the library under test to a fresh place, and moves the tree from there: nothing may depend on the first.
fn installed(name: &str) -> PathBuf {
    let (first, moved) = (scratch().join(format!("{name} first")), scratch().join(format!("{name} moved")));
    for old in [&first, &moved] {
        drop(fs::remove_dir_all(old));
    }
    let mut dist = Command::new("bash");
    dist.arg(root().join("tools/dist.sh")).arg("--prefix").arg(&first);
    let both = scratch().join(format!("{name} libraries"));
    fs::create_dir_all(&both).unwrap();
    fs::copy(library(Variant::Shipped), both.join("libhapflow.so")).unwrap();
    fs::copy(Bridge::built().folder().join("libhapflow_cxx.so"), both.join("libhapflow_cxx.so")).unwrap();
    said(&dist.arg("--library").arg(both.join("libhapflow.so")).output().unwrap());
    fs::rename(&first, &moved).unwrap();
    moved
}

#[test]
fn what_is_installed_is_complete_and_knows_no_place() {
    let tree = installed("cpp-dist");
    for file in [
        "lib/libhapflow.so",
        "lib/cmake/hapflow/hapflowConfig.cmake",
        "lib/cmake/hapflow/hapflowConfigVersion.cmake",
        "lib/pkgconfig/hapflow.pc",
        "lib/libhapflow_cxx.so",
        "include/hapflow/hapflow.hpp",
        "include/hapflow/cxx.hpp",
        "include/hapflow/cxx/bridge.h",
        "include/rust/cxx.h",
        "share/hapflow/cxx/bridge.cc",
        "share/hapflow/cxx/cxx.cc",
        "share/doc/hapflow/README.md",
        "share/doc/hapflow/LICENSE-APACHE",
        "share/doc/hapflow/LICENSE-MIT",
        "share/doc/hapflow/THIRD-PARTY-NOTICES.md",
        "share/doc/hapflow/CHANGELOG.md",
        "share/hapflow/scenes/tap.toml",
        "share/hapflow/examples/tap.c",
        "share/hapflow/examples/cmake-consumer/CMakeLists.txt",
        "share/hapflow/examples/plugins/CMakeLists.txt",
        "share/hapflow/adapters/CMakeLists.txt",
        "share/hapflow/adapters/common/hapflow/adapter/fluid.hpp",
        "share/hapflow/adapters/hapi/LICENSE",
    ] {
        assert!(tree.join(file).metadata().unwrap_or_else(|e| panic!("{file}: {e}")).len() > 0, "{file}");
    }
    for header in header::there() {
        assert!(tree.join(format!("include/hapflow/{header}.h")).is_file(), "{header}.h");
    }
    for file in ["cmake/hapflow/hapflowConfigVersion.cmake", "pkgconfig/hapflow.pc"] {
        let text = fs::read_to_string(tree.join("lib").join(file)).unwrap();
        assert!(text.contains(env!("CARGO_PKG_VERSION")) && !text.contains('@'), "{text}");
        assert!(!text.contains(root().to_str().unwrap()), "{text}");
    }
    // Stripped, with what it exports still there.
    let nm = |args: &[&str]| {
        let output = Command::new("nm").args(args).arg(tree.join("lib/libhapflow.so")).output().unwrap();
        String::from_utf8_lossy(&output.stdout).into_owned()
    };
    assert!(nm(&["-D", "--defined-only"]).contains("hapflow_servo_tick") && nm(&[]).is_empty());

    for wrong in [&["--prefix"][..], &["--no-such"], &["--library", "/no/such/file"]] {
        let output = Command::new("bash").arg(root().join("tools/dist.sh")).args(wrong).output().unwrap();
        assert_eq!(output.status.code(), Some(2), "{wrong:?}");
        assert!(String::from_utf8_lossy(&output.stderr).starts_with("dist.sh: "), "{output:?}");
    }
}

#[test]
fn a_program_builds_with_the_flags_of_pkg_config() {
    if !there("pkg-config") {
        return;
    }
    // A path with a space is quoted for a shell.
    let tree = installed("cpp-pkg");
    let pkg_config = |args: &[&str]| {
        let mut command = Command::new("pkg-config");
        command.env("PKG_CONFIG_PATH", tree.join("lib/pkgconfig")).args(args).arg("hapflow");
        said(&command.output().unwrap()).trim().to_string()
    };
    assert_eq!(pkg_config(&["--modversion"]), env!("CARGO_PKG_VERSION"));
    let (source, program) =
        (root().join("examples/cmake-consumer/main.cpp"), scratch().join("cpp-pkg-program"));
    let line = format!(
        "c++ -std=c++17 '{}' {} -o '{}'",
        source.display(),
        pkg_config(&["--cflags", "--libs"]),
        program.display()
    );
    said(&Command::new("sh").args(["-c", &line]).output().unwrap());
    let mut program = Command::new(program);
    let out = said(&program.arg(COARSE).env("LD_LIBRARY_PATH", tree.join("lib")).output().unwrap());
    assert!(out.contains("force"), "{out}");
}

/// The consumer's project over the bridge.
const BRIDGED: &str = "cmake_minimum_required(VERSION 3.16)\nproject(consumer LANGUAGES CXX)\n\
    find_package(hapflow 0.1 CONFIG REQUIRED COMPONENTS cxx)\nadd_executable(consumer main.cpp)\n\
    target_link_libraries(consumer PRIVATE hapflow::cxx)\n";

#[test]
fn a_project_builds_with_find_package() {
    if !there("cmake") {
        return;
    }
    let (tree, build) = (installed("cpp-cmake"), scratch().join("cpp-cmake-build"));
    let configure = |prefix: &Path| {
        drop(fs::remove_dir_all(&build));
        let mut option = OsString::from("-DCMAKE_PREFIX_PATH=");
        option.push(prefix);
        let source = tree.join("share/hapflow/examples/cmake-consumer");
        Command::new("cmake").arg("-S").arg(source).arg("-B").arg(&build).arg(option).output().unwrap()
    };
    said(&configure(&tree));
    said(&Command::new("cmake").arg("--build").arg(&build).output().unwrap());
    // CMake gives the program the library's folder; nobody else does.
    let mut consumer = Command::new(build.join("consumer"));
    let out = said(&consumer.arg(COARSE).env_remove("LD_LIBRARY_PATH").output().unwrap());
    assert!(out.contains("done; force"), "{out}");
    let readelf = Command::new("readelf").arg("-d").arg(build.join("consumer")).output().unwrap();
    assert!(said(&readelf).contains("Shared library: [libhapflow.so]"), "it remembers a whole path");

    // A tree without its library is not found, and says so.
    fs::remove_file(tree.join("lib/libhapflow.so")).unwrap();
    let broken = configure(&tree);
    let err = String::from_utf8_lossy(&broken.stderr);
    assert!(!broken.status.success() && err.contains("libhapflow.so"), "{err}");
}

#[test]
fn the_plugins_of_the_examples_build_with_find_package() {
    if !there("cmake") {
        return;
    }
    let (tree, build) = (installed("cpp-plugins"), scratch().join("cpp-plugins-build"));
    drop(fs::remove_dir_all(&build));
    let mut option = OsString::from("-DCMAKE_PREFIX_PATH=");
    option.push(&tree);
    let (source, mut cmake) = (tree.join("share/hapflow/examples/plugins"), Command::new("cmake"));
    said(&cmake.arg("-S").arg(source).arg("-B").arg(&build).arg(option).output().unwrap());
    said(&Command::new("cmake").arg("--build").arg(&build).output().unwrap());
    let load = |name: &str| Extensions::load(&find(name, Some(build.as_os_str())).unwrap()).unwrap();
    assert_eq!(load("jet_fluid").fluid.unwrap().name(), "jet-fluid");
    assert_eq!(load("bobbing_device").device.unwrap().name(), "bobbing_device");
    let readelf = Command::new("readelf").arg("-d").arg(build.join("libjet_fluid.so")).output().unwrap();
    assert!(!said(&readelf).contains("libhapflow"), "a plugin needs no libhapflow");
}

#[test]
fn a_project_over_the_bridge_builds_with_find_package() {
    if !there("cmake") {
        return;
    }
    let (tree, source) = (installed("cpp-bridged"), scratch().join("cpp-bridged"));
    drop(fs::remove_dir_all(&source));
    fs::create_dir_all(&source).unwrap();
    fs::write(source.join("CMakeLists.txt"), BRIDGED).unwrap();
    let consumer = fs::read_to_string(root().join("examples/cmake-consumer/main.cpp")).unwrap();
    let consumer =
        consumer.replace("hapflow.hpp", "cxx.hpp").replace("hapflow::Session", "hapflow::cxx::Session");
    fs::write(source.join("main.cpp"), consumer).unwrap();
    let mut option = OsString::from("-DCMAKE_PREFIX_PATH=");
    option.push(&tree);
    let (build, mut cmake) = (source.join("build"), Command::new("cmake"));
    said(&cmake.arg("-S").arg(&source).arg("-B").arg(&build).arg(&option).output().unwrap());
    said(&Command::new("cmake").arg("--build").arg(&build).output().unwrap());
    let mut consumer = Command::new(build.join("consumer"));
    let out = said(&consumer.arg(COARSE).env_remove("LD_LIBRARY_PATH").output().unwrap());
    assert!(out.contains("done; force"), "{out}");

    // Without it, it is not found.
    fs::remove_file(tree.join("lib/libhapflow_cxx.so")).unwrap();
    fs::remove_dir_all(&build).unwrap();
    let mut cmake = Command::new("cmake");
    let broken = cmake.arg("-S").arg(&source).arg("-B").arg(&build).arg(&option).output().unwrap();
    let err = String::from_utf8_lossy(&broken.stderr);
    assert!(!broken.status.success() && err.contains("there is no component cxx"), "{err}");
}

#[test]
fn the_adapters_that_have_no_stack_are_left_out_in_a_line_each() {
    if !there("cmake") {
        return;
    }
    let (tree, build) = (installed("cpp-adapters"), scratch().join("cpp-adapters-build"));
    drop(fs::remove_dir_all(&build));
    let mut option = OsString::from("-DCMAKE_PREFIX_PATH=");
    option.push(&tree);
    let mut cmake = Command::new("cmake");
    cmake.arg("-S").arg(tree.join("share/hapflow/adapters")).arg("-B").arg(&build).arg(option);
    // What was built somewhere on this machine is not to be found by itself.
    cmake.arg("-DCMAKE_FIND_USE_PACKAGE_REGISTRY=OFF");
    let out = said(&cmake.output().unwrap());
    for (stack, target) in [("CHAI3D", "adapter"), ("HAPI", "adapter"), ("H3D", "node")] {
        let lines = out.lines().filter(|l| l.contains(&format!("the {stack} {target} is left out")));
        assert_eq!(lines.count(), 1, "{out}");
    }
}
