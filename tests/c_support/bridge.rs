//! libhapflow_cxx, and the C++ half of the bridge, compiled once.

use super::build::{cargo_build, compile, root, scratch};
use std::ffi::{OsStr, OsString};
use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

/// Where they lie.
pub struct Bridge {
    library: PathBuf,
    objects: Vec<PathBuf>,
}

impl Bridge {
    /// Built with this test's profile.
    pub fn built() -> &'static Self {
        static BUILT: OnceLock<Bridge> = OnceLock::new();
        BUILT.get_or_init(|| {
            let library = cargo_build("hapflow-cxx-bridge", &[], "libhapflow_cxx.so", "cxx");
            // Of several tests at a time only one writes.
            let lock = File::create(scratch().join("cxx-lock")).unwrap();
            lock.lock().unwrap();
            Self { library, objects: vec![object("bridge"), object("cxx")] }
        })
    }

    /// The folder of the library.
    pub fn folder(&self) -> &Path {
        self.library.parent().unwrap()
    }

    /// What a program is compiled and linked with; the generated headers are nobody's to warn of. Before `-lhapflow`.
    pub fn args(&self) -> Vec<OsString> {
        let mut args = vec!["-isystem".into(), headers().into_os_string()];
        args.extend(self.objects.iter().map(|o| o.clone().into_os_string()));
        args.push(self.library.clone().into_os_string());
        args
    }
}

fn headers() -> PathBuf {
    root().join("cpp/cxx/include")
}

fn object(name: &str) -> PathBuf {
    let source = root().join(format!("cpp/cxx/{name}.cc"));
    let (made, new) = (scratch().join(format!("{name}.o")), scratch().join(format!("{name}.o.new")));
    let headers = headers();
    let flags = ["-c", "-O1", "-fPIC", "-w", "-isystem"].map(OsStr::new);
    let files = [headers.as_os_str(), source.as_os_str(), OsStr::new("-o"), new.as_os_str()];
    compile("c++", "c++17", &[&flags[..], &files].concat()).unwrap_or_else(|e| panic!("{e}"));
    fs::rename(&new, &made).unwrap();
    made
}
