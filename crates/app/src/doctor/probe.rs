//! Asks the system. All judgement is in [`judge`](super::judge).

use super::judge::{FALCON, Falcon, System, Usb};
use super::parse;
use super::timer::{self, Lateness};
use hapflow_realtime::{Grant, RealClock, lock_memory, spawn_realtime, unlock_memory};
use std::io;
use std::path::Path;

/// The first words of a file, if it can be read.
fn word(path: impl AsRef<Path>) -> Option<String> {
    parse::word(&std::fs::read_to_string(path).ok()?)
}

/// What the system says of itself.
pub fn system() -> System {
    let os = ["/etc/os-release", "/usr/lib/os-release"];
    let containers = ["/.dockerenv", "/run/.containerenv", "/run/systemd/container"];
    System {
        os: os.iter().find_map(|path| parse::os_name(&word(path)?)),
        kernel: word("/proc/sys/kernel/osrelease"),
        realtime_kernel: word("/proc/version").is_some_and(|v| parse::is_realtime_kernel(&v)),
        container: containers.iter().any(|path| Path::new(path).exists()),
    }
}

/// Cores that this process may use.
pub fn cores() -> Option<usize> {
    std::thread::available_parallelism().ok().map(std::num::NonZero::get)
}

/// The vectors that the fluid computes in, in pulp's word.
pub fn simd() -> String {
    parse::simd_level(&format!("{:?}", pulp::Arch::new())).into()
}

/// Whether all memory may be locked, and the limit (`ulimit -l`) before it was asked. Nothing stays locked.
pub fn memory() -> (Grant, Option<String>) {
    let limit = word("/proc/self/limits").and_then(|text| parse::memory_limit(&text));
    let grant = Grant::from(lock_memory());
    if grant.is_granted() {
        let _ = unlock_memory();
    }
    (grant, limit)
}

/// Runs a 1 kHz loop of `ticks` ticks on a thread as the servo's: what it was granted, and how late it was.
pub fn servo(priority: u8, ticks: u32) -> Result<(Grant, Lateness), String> {
    let thread = spawn_realtime("hapflow-doctor", priority, move || timer::run(&RealClock::new(), ticks))
        .map_err(|error| error.to_string())?;
    let grant = thread.status().priority.clone();
    let late = thread.join().map_err(|_| "it ended early".to_string())?;
    Ok((grant, late))
}

/// The first core's cpufreq governor and driver.
pub fn governor() -> (Option<String>, Option<String>) {
    let folder = Path::new("/sys/devices/system/cpu/cpu0/cpufreq");
    (word(folder.join("scaling_governor")), word(folder.join("scaling_driver")))
}

/// USB devices in `sys` (`/sys/bus/usb/devices`), whose files are in `dev` (`/dev/bus/usb`).
pub fn usb(sys: &Path, dev: &Path) -> Usb {
    match std::fs::read_dir(dev) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Usb::Absent,
        Err(error) => return Usb::Unreadable(error.to_string()),
        Ok(_) => {}
    }
    let mut devices = 0;
    let mut falcon = None;
    for entry in std::fs::read_dir(sys).into_iter().flatten().flatten() {
        let read = |name: &str| word(entry.path().join(name));
        let id = |name: &str| parse::usb_id(&read(name)?);
        // Interfaces are listed too, and have no such files.
        let (Some(vendor), Some(product)) = (id("idVendor"), id("idProduct")) else { continue };
        devices += 1;
        if (vendor, product) == FALCON
            && let Some(node) =
                parse::usb_node(dev, &read("busnum").unwrap_or_default(), &read("devnum").unwrap_or_default())
        {
            let refused = std::fs::OpenOptions::new().write(true).open(&node).err().map(|e| e.to_string());
            falcon = Some(Falcon { node, refused });
        }
    }
    Usb::Readable { devices, falcon }
}

/// The render nodes in `dev` (`/dev/dri`), each with its driver as `sys` (`/sys/class/drm`) tells it.
pub fn gpu(dev: &Path, sys: &Path) -> Vec<(String, Option<String>)> {
    let mut nodes: Vec<_> = std::fs::read_dir(dev)
        .into_iter()
        .flatten()
        .flatten()
        .map(|entry| entry.file_name().to_string_lossy().into_owned())
        .filter(|name| name.starts_with("renderD"))
        .map(|name| {
            let driver = word(sys.join(&name).join("device/uevent")).and_then(|text| parse::driver(&text));
            (name, driver)
        })
        .collect();
    nodes.sort();
    nodes
}

/// Whether `folder` can be made, if it is not there, and written. Leaves nothing behind.
pub fn output(folder: &Path) -> io::Result<()> {
    let made = match std::fs::create_dir(folder) {
        Ok(()) => true,
        Err(error) if error.kind() == io::ErrorKind::AlreadyExists => false,
        Err(error) => return Err(error),
    };
    let file = folder.join(format!(".hapflow-doctor-{}", std::process::id()));
    let written = std::fs::write(&file, b"hapflow");
    let _ = std::fs::remove_file(&file);
    if made {
        let _ = std::fs::remove_dir(folder);
    }
    written
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::PathBuf;

    /// A folder that goes with the test.
    struct Folder(PathBuf);

    impl Folder {
        fn new(name: &str) -> Self {
            let path = std::env::temp_dir().join(format!("hapflow-doctor-{name}-{}", std::process::id()));
            let _ = std::fs::remove_dir_all(&path);
            std::fs::create_dir_all(&path).unwrap();
            Self(path)
        }

        fn write(&self, path: &str, text: &str) {
            let path = self.0.join(path);
            std::fs::create_dir_all(path.parent().unwrap()).unwrap();
            std::fs::write(path, text).unwrap();
        }
    }

    impl Drop for Folder {
        fn drop(&mut self) {
            let _ = std::fs::remove_dir_all(&self.0);
        }
    }

    fn device(folder: &Folder, name: &str, id: (&str, &str), devnum: &str) {
        for (file, text) in [("idVendor", id.0), ("idProduct", id.1), ("busnum", "1"), ("devnum", devnum)] {
            folder.write(&format!("sys/{name}/{file}"), &format!("{text}\n"));
        }
    }

    #[test]
    fn a_falcon_is_found_with_its_file() {
        let folder = Folder::new("usb");
        let (sys, dev) = (folder.0.join("sys"), folder.0.join("dev"));
        assert_eq!(usb(&sys, &dev), Usb::Absent);
        device(&folder, "usb1", ("1d6b", "0002"), "1");
        folder.write("sys/1-0:1.0/bInterfaceNumber", "00\n");
        folder.write("dev/001/001", "");
        assert_eq!(usb(&sys, &dev), Usb::Readable { devices: 1, falcon: None });
        device(&folder, "1-2", ("0403", "cb48"), "7");
        let found = |usb| match usb {
            Usb::Readable { devices: 2, falcon: Some(falcon) } => falcon,
            other => panic!("{other:?}"),
        };
        let without_file = found(usb(&sys, &dev));
        assert_eq!(without_file.node, dev.join("001/007"));
        assert!(without_file.refused.is_some());
        folder.write("dev/001/007", "");
        assert_eq!(found(usb(&sys, &dev)).refused, None);
    }

    #[test]
    fn a_bus_that_is_no_folder_cannot_be_read() {
        let folder = Folder::new("bus");
        folder.write("dev", "");
        assert!(matches!(usb(&folder.0.join("sys"), &folder.0.join("dev")), Usb::Unreadable(_)));
    }

    #[test]
    fn render_nodes_are_listed_in_order() {
        let folder = Folder::new("gpu");
        let (dev, sys) = (folder.0.join("dev"), folder.0.join("sys"));
        assert_eq!(gpu(&dev, &sys), []);
        for node in ["renderD129", "card0", "renderD128"] {
            folder.write(&format!("dev/{node}"), "");
        }
        folder.write("sys/renderD128/device/uevent", "DRIVER=amdgpu\n");
        assert_eq!(
            gpu(&dev, &sys),
            [("renderD128".into(), Some("amdgpu".into())), ("renderD129".into(), None)]
        );
    }

    #[test]
    fn the_output_folder_is_left_as_it_was() {
        let folder = Folder::new("out");
        let out = folder.0.join("out");
        assert!(output(&out).is_ok());
        assert!(!out.exists());
        std::fs::create_dir(&out).unwrap();
        assert!(output(&out).is_ok());
        assert_eq!(std::fs::read_dir(&out).unwrap().count(), 0);
        folder.write("file", "");
        assert!(output(&folder.0.join("file")).is_err());
        assert!(output(&folder.0.join("not/there")).is_err());
    }
}
