//! The adapters to other haptics libraries, in doubles of those: compiled with all warnings, and run.
#![allow(clippy::unwrap_used, clippy::panic)]

mod c_support;

use c_support::{Bridge, Variant, compile, library, root, scratch};
use std::ffi::{OsStr, OsString};
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// What an adapter is built of, in paths from the root.
struct Adapter {
    name: &'static str,
    includes: &'static [&'static str],
    sources: &'static [&'static str],
}

const COMMON: Adapter = Adapter { name: "common", includes: &[], sources: &[] };
const HAPI: Adapter = Adapter {
    name: "hapi",
    includes: &["cpp/adapters/hapi", "tests/doubles/hapi"],
    sources: &["cpp/adapters/hapi/FluidRenderer.cpp", "cpp/adapters/hapi/Shapes.cpp"],
};
const H3D: Adapter = Adapter {
    name: "h3d",
    includes: &["cpp/adapters/hapi", "tests/doubles/hapi", "tests/doubles/h3d"],
    sources: &[
        "cpp/adapters/hapi/FluidRenderer.cpp",
        "cpp/adapters/hapi/Shapes.cpp",
        "cpp/adapters/h3d/HapflowFluidRenderer.cpp",
    ],
};
const CHAI3D: Adapter =
    Adapter { name: "chai3d", includes: &["cpp/adapters/chai3d", "tests/doubles/chai3d"], sources: &[] };
/// Both in one program, whose memory is watched.
const WATCHED: Adapter = Adapter {
    name: "no_alloc",
    includes: &["cpp/adapters/hapi", "tests/doubles/hapi", "cpp/adapters/chai3d", "tests/doubles/chai3d"],
    ..HAPI
};

/// Which way they go to libhapflow.
#[derive(Clone, Copy, PartialEq)]
enum Via {
    C,
    Cxx,
}

impl Adapter {
    /// Flags that a strict program compiles it with.
    fn flags(&self) -> Vec<OsString> {
        let strict =
            ["-Wconversion", "-Wsign-conversion", "-Wshadow", "-Wold-style-cast", "-pthread", "-fPIC"];
        let mut flags: Vec<OsString> = strict.iter().map(OsString::from).collect();
        for include in ["cpp/include", "cpp/adapters/common"].iter().chain(self.includes) {
            flags.extend(["-I".into(), root().join(include).into_os_string()]);
        }
        flags
    }

    /// Compiles a program of it, or with `-shared` a library.
    fn link(&self, via: Via, main: &[&str], name: &str, more: &[&str]) -> PathBuf {
        let (made, library) = (scratch().join(name), library(Variant::Shipped));
        let mut args = self.flags();
        if via == Via::Cxx {
            args.push("-DHAPFLOW_VIA_CXX".into());
            args.extend(Bridge::built().args());
        }
        args.extend(more.iter().map(OsString::from));
        args.extend(main.iter().chain(self.sources).map(|s| root().join(s).into_os_string()));
        args.extend(["-L".into(), library.parent().unwrap().as_os_str().into(), "-lhapflow".into()]);
        args.extend(["-ldl".into(), "-o".into(), made.clone().into_os_string()]);
        let args: Vec<&OsStr> = args.iter().map(OsString::as_os_str).collect();
        compile("c++", "c++17", &args).unwrap_or_else(|e| panic!("{e}"));
        made
    }
}

/// Runs a program with the shipped library.
fn run(program: &Path, args: &[&OsStr]) -> Output {
    let library = library(Variant::Shipped);
    let paths = [library.parent().unwrap(), Bridge::built().folder()];
    let paths = std::env::join_paths(paths).unwrap();
    Command::new(program).args(args).env("LD_LIBRARY_PATH", paths).output().unwrap()
}

/// What it wrote, if it was content.
fn said(output: &Output) -> String {
    let (out, err) = (String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    assert!(output.status.success(), "{}\n{out}\n{err}", output.status);
    out.into_owned()
}

/// Over both roads: each compares its forces with those of the plain wrapper.
fn passes(adapter: &Adapter) {
    let main = format!("tests/adapters/{}.cpp", adapter.name);
    for (via, road) in [(Via::C, "c"), (Via::Cxx, "cxx")] {
        // LINUX is CHAI3D's, and nothing to the others.
        let name = format!("adapter-{}-{road}", adapter.name);
        let program = adapter.link(via, &[&main], &name, &["-DLINUX"]);
        assert_eq!(said(&run(&program, &[])), "all passed\n", "over {road}");
    }
}

#[test]
fn what_they_share_does_what_it_says() {
    passes(&COMMON);
}

#[test]
fn the_hapi_adapter_does_what_it_says() {
    passes(&HAPI);
}

#[test]
fn the_node_of_h3d_does_what_it_says() {
    passes(&H3D);
}

#[test]
fn a_hapi_program_loads_the_adapter_by_its_file() {
    let plugin = HAPI.link(Via::Cxx, &[], "libhapflow_hapi.so", &["-shared"]);
    // HAPI's list is one in the process, as where it is a shared library.
    let host = Adapter { sources: &[], ..HAPI };
    let host = host.link(Via::C, &["tests/adapters/hapi_host.cpp"], "hapi-host", &["-rdynamic"]);
    assert_eq!(said(&run(&host, &[plugin.as_os_str()])), "HapflowFluid\nstepped\n");
}

#[test]
fn the_examples_run_and_few_of_their_lines_are_the_fluids() {
    for (adapter, via, example) in [(&HAPI, Via::Cxx, "hapi_tap"), (&CHAI3D, Via::C, "chai3d_tank")] {
        let source = format!("examples/{example}.cpp");
        let text = std::fs::read_to_string(root().join(&source)).unwrap();
        let lines = text.lines().filter(|l| !l.trim_start().starts_with("//"));
        let ours = lines.filter(|l| l.contains("hapflow") || l.contains("Hapflow") || l.contains("fluid"));
        assert!(ours.count() <= 10, "{example}");
        let program = adapter.link(via, &[&source], example, &["-DLINUX"]);
        let out = said(&run(&program, &[OsStr::new("0.3")]));
        assert!(out.starts_with("force ") && !out.contains("nan"), "{out}");
    }
}

#[test]
fn the_chai3d_adapter_does_what_it_says() {
    passes(&CHAI3D);
}

#[test]
#[cfg(target_env = "gnu")]
fn no_servo_call_of_theirs_allocates() {
    passes(&WATCHED);
}

#[test]
fn chai3d_without_its_platform_is_refused() {
    let (source, mut args) = (scratch().join("adapter-no-platform.cpp"), CHAI3D.flags());
    std::fs::write(&source, "#include <hapflow_chai3d.hpp>\n").unwrap();
    args.extend(["-fsyntax-only".into(), source.into_os_string()]);
    let args: Vec<&OsStr> = args.iter().map(OsString::as_os_str).collect();
    let error = compile("c++", "c++17", &args).unwrap_err();
    assert!(error.contains("#error \"define LINUX, MACOSX, WIN32 or WIN64"), "{error}");
}
