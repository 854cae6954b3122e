//! A SpaceNavigator at a machine that is not there: real hidraw code runs against it under umockdev's preload library.
//!
//! A folder stands for `/sys` and `/dev`; the device's file is a FIFO with a byte for each report that waits, and reading and
//! ioctls come over a socket (see the USB one).

use std::collections::VecDeque;
use std::fs::{File, OpenOptions, create_dir_all};
use std::io::{self, Read, Write};
use std::os::unix::fs::{OpenOptionsExt, symlink};
use std::os::unix::net::{UnixListener, UnixStream};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};

/// A multi-axis controller with one report of bytes.
const DESCRIPTOR: [u8; 20] = [
    0x05, 0x01, 0x09, 0x08, 0xA1, 0x01, 0x15, 0x00, 0x26, 0xFF, 0x00, 0x75, 0x08, 0x95, 0x08, 0x09, 0x01,
    0x81, 0x02, 0xC0,
];

/// A machine with one SpaceNavigator.
pub struct Machine {
    root: PathBuf,
    fifo: File,
    reports: Arc<Mutex<Reports>>,
}

/// Reports that wait; nothing is the end of the device.
type Reports = VecDeque<Option<Vec<u8>>>;

impl Machine {
    pub fn new(name: &str) -> io::Result<Self> {
        let root = std::env::temp_dir().join(format!("hapflow-{name}-{}", std::process::id()));
        let _ = std::fs::remove_dir_all(&root);
        describe(&root)?;
        let node = root.join("dev/hidraw0");
        let made = std::process::Command::new("mkfifo").arg(&node).status()?;
        assert!(made.success());
        let fifo = OpenOptions::new().read(true).write(true).custom_flags(libc::O_NONBLOCK).open(&node)?;
        let reports: Arc<Mutex<Reports>> = Arc::default();
        create_dir_all(root.join("ioctl/dev"))?;
        let listener = UnixListener::bind(root.join("ioctl/dev/hidraw0"))?;
        let (theirs, waiting) = (Arc::clone(&reports), fifo.try_clone()?);
        std::thread::spawn(move || {
            for stream in listener.incoming().flatten() {
                let (reports, fifo) = (Arc::clone(&theirs), waiting.try_clone().unwrap());
                std::thread::spawn(move || {
                    let _ = Client { stream, fifo, reports }.serve();
                });
            }
        });
        Ok(Self { root, fifo, reports })
    }

    /// The device says this.
    pub fn say(&mut self, report: &[u8]) {
        self.put(Some(report.to_vec()));
    }

    /// Its cable is pulled, after what it has said.
    pub fn unplug(&mut self) {
        self.put(None);
    }

    fn put(&mut self, report: Option<Vec<u8>>) {
        self.reports.lock().unwrap().push_back(report);
        self.fifo.write_all(b"x").unwrap();
    }

    /// The variables under which a program sees this machine's devices.
    pub fn environment(&self) -> [(&'static str, PathBuf); 2] {
        [("LD_PRELOAD", "libumockdev-preload.so.0".into()), ("UMOCKDEV_DIR", self.root.clone())]
    }
}

impl Drop for Machine {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.root);
    }
}

fn describe(root: &Path) -> io::Result<()> {
    let usb = root.join("sys/devices/pci0000:00/0000:00:14.0/usb1/1-1");
    let interface = usb.join("1-1:1.0");
    let hid = interface.join("0003:046D:C626.0001");
    let raw = hid.join("hidraw/hidraw0");
    create_dir_all(&raw)?;
    let write = |folder: &Path, name: &str, text: &str| std::fs::write(folder.join(name), text);
    let uevent = "MAJOR=189\nMINOR=1\nDEVNAME=bus/usb/001/002\nDEVTYPE=usb_device\nPRODUCT=46d/c626/100\n";
    for (name, text) in [
        ("busnum", "1\n"),
        ("devnum", "2\n"),
        ("idVendor", "046d\n"),
        ("idProduct", "c626\n"),
        ("uevent", uevent),
    ] {
        write(&usb, name, text)?;
    }
    write(&interface, "uevent", "DEVTYPE=usb_interface\nPRODUCT=46d/c626/100\nINTERFACE=3/0/0\n")?;
    write(&interface, "bInterfaceNumber", "00\n")?;
    write(
        &hid,
        "uevent",
        "HID_ID=0003:0000046D:0000C626\nHID_NAME=SpaceNavigator\nHID_PHYS=usb-1/input0\nHID_UNIQ=\n",
    )?;
    std::fs::write(hid.join("report_descriptor"), DESCRIPTOR)?;
    write(&raw, "uevent", "MAJOR=240\nMINOR=0\nDEVNAME=hidraw0\n")?;
    write(&raw, "dev", "240:0\n")?;
    for folder in
        ["sys/bus/usb/devices", "sys/bus/hid/devices", "sys/class/hidraw", "sys/dev/char", "dev/.node"]
    {
        create_dir_all(root.join(folder))?;
    }
    symlink("../../../../../bus/usb", usb.join("subsystem"))?;
    symlink("../../../../../../bus/usb", interface.join("subsystem"))?;
    symlink("../../../../../../../bus/hid", hid.join("subsystem"))?;
    symlink("../../../0003:046D:C626.0001", raw.join("device"))?;
    symlink("../../../../../../../../../class/hidraw", raw.join("subsystem"))?;
    let place = "../../devices/pci0000:00/0000:00:14.0/usb1/1-1/1-1:1.0/0003:046D:C626.0001/hidraw/hidraw0";
    symlink(place, root.join("sys/class/hidraw/hidraw0"))?;
    symlink(place, root.join("sys/dev/char/240:0"))?;
    // What a FIFO says that its number is.
    symlink("240:0", root.join("sys/dev/char/0:0"))?;
    symlink("240:0", root.join("dev/.node/hidraw0"))
}

struct Client {
    stream: UnixStream,
    fifo: File,
    reports: Arc<Mutex<Reports>>,
}

impl Client {
    fn serve(&mut self) -> io::Result<()> {
        loop {
            let mut bytes = [0; 24];
            self.stream.read_exact(&mut bytes)?;
            let word = |n: usize| u64::from_ne_bytes(std::array::from_fn(|k| bytes[8 * n + k]));
            let (result, errno) = match word(0) {
                7 => self.read(word(1), word(2))?,
                1 => self.ioctl(word(1) as u8, word(2))?,
                8 => (word(2) as i64, 0),
                _ => (-100, 0),
            };
            self.send([3, result as u64, errno as u64])?;
        }
    }

    fn send(&mut self, words: [u64; 3]) -> io::Result<()> {
        self.stream.write_all(&words.map(u64::to_ne_bytes).concat())
    }

    fn store(&mut self, address: u64, bytes: &[u8]) -> io::Result<()> {
        self.send([6, address, bytes.len() as u64])?;
        self.stream.write_all(bytes)
    }

    fn read(&mut self, address: u64, room: u64) -> io::Result<(i64, i32)> {
        let waits = self.fifo.read(&mut [0]).is_ok_and(|n| n == 1);
        let report = self.reports.lock().unwrap().pop_front().filter(|_| waits);
        let report = match report {
            Some(Some(report)) => report,
            Some(None) => return Ok((-1, libc::EIO)),
            None => return Ok((-1, libc::EAGAIN)),
        };
        let len = report.len().min(room as usize);
        self.store(address, &report[..len])?;
        Ok((len as i64, 0))
    }

    /// HIDIOCGRDESCSIZE and HIDIOCGRDESC, of Linux, `include/uapi/linux/hidraw.h`.
    fn ioctl(&mut self, number: u8, address: u64) -> io::Result<(i64, i32)> {
        let size = (DESCRIPTOR.len() as u32).to_ne_bytes();
        match number {
            1 => self.store(address, &size)?,
            2 => self.store(address, &[size.as_slice(), &DESCRIPTOR].concat())?,
            _ => return Ok((-1, libc::ENOTTY)),
        }
        Ok((0, 0))
    }
}
