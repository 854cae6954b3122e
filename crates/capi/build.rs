//! Link arguments of libhapflow.

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    if std::env::var("CARGO_CFG_TARGET_OS").as_deref() == Ok("linux") {
        // Worker threads and thread-locals may outlive a host's dlclose: the code must stay mapped.
        println!("cargo::rustc-cdylib-link-arg=-Wl,-z,nodelete");
        // Else a program that is linked by the file's path looks for it at that path alone.
        println!("cargo::rustc-cdylib-link-arg=-Wl,-soname,libhapflow.so");
    }
}
