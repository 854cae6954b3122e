//! An emulated Falcon at a USB that is not there: unmodified libusb runs against it under umockdev's preload library.
//!
//! A folder stands for `/sys` and `/dev`. The device's file is a FIFO, which libusb waits to write to when it waits for
//! transfers: a full one is "nothing has ended". Its ioctls come over a socket, as umockdev's preload library passes them:
//! the client sends (1, request, argument); the server may fetch and store the client's memory by (5, address, length)
//! and (6, address, length), and ends with (3, result, errno).

use hapflow_devices::falcon::{EmulatedFalcon, LinkError, USB_PACKET_BYTES};
use std::collections::VecDeque;
use std::ffi::CString;
use std::io::{self, Read, Write};
use std::os::fd::FromRawFd;
use std::os::unix::ffi::OsStrExt;
use std::os::unix::fs::symlink;
use std::os::unix::net::{UnixListener, UnixStream};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

/// The emulated device lives so much faster than the clock, to save time.
const SPEED: u64 = 4;
/// Serial number of the device.
pub const SERIAL: &str = "HF000042";

const DEVICE: [u8; 18] = [18, 1, 0, 2, 0, 0, 0, 8, 0x03, 0x04, 0x48, 0xCB, 0, 6, 1, 2, 3, 1];
const CONFIGURATION: [u8; 32] = [
    9, 2, 32, 0, 1, 1, 0, 0x80, 50, 9, 4, 0, 0, 2, 255, 255, 255, 0, 7, 5, 0x81, 2, 64, 0, 0, 7, 5, 0x02, 2,
    64, 0, 0,
];

/// A machine with one Falcon.
pub struct Machine {
    root: PathBuf,
    /// Address of the Falcon on its bus: another one each time it is plugged in.
    address: u8,
    pub side: Arc<Side>,
}

/// The device's side of the cable.
pub struct Side {
    pub falcon: Mutex<EmulatedFalcon>,
    /// Every IN transfer of this number is refused; 0 is never.
    pub stalls_every: AtomicUsize,
    /// Likewise OUT,
    pub refuses_every: AtomicUsize,
    /// and IN transfers that bring anything, of any length.
    pub noise_every: AtomicUsize,
    /// Transfers to the device never end, nor do vendor requests.
    pub deaf: AtomicBool,
    /// Programs that have the device open.
    pub clients: AtomicUsize,
    /// One of them has its interface.
    claimed: AtomicBool,
    origin: Instant,
    packets: AtomicUsize,
    written: AtomicUsize,
    gate: Mutex<Gate>,
    gone: AtomicBool,
}

/// Whether transfer `n` is one of every `every`.
fn hits(every: &AtomicUsize, n: usize) -> bool {
    let every = every.load(Ordering::Acquire);
    every > 0 && n.is_multiple_of(every)
}

impl Side {
    pub fn now(&self) -> u64 {
        self.origin.elapsed().as_nanos() as u64 * SPEED
    }
}

/// The FIFO: open is "something has ended".
struct Gate {
    fifo: std::fs::File,
    full: bool,
}

impl Gate {
    fn make(path: &Path) -> io::Result<Self> {
        let name = CString::new(path.as_os_str().as_bytes())?;
        // SAFETY: the name is a C string; a file descriptor that could be opened is owned by the file from here on.
        let fifo = unsafe {
            libc::mkfifo(name.as_ptr(), 0o666);
            let fd = libc::open(name.as_ptr(), libc::O_RDWR | libc::O_NONBLOCK | libc::O_CLOEXEC);
            if fd < 0 {
                return Err(io::Error::last_os_error());
            }
            libc::fcntl(fd, libc::F_SETPIPE_SZ, 4096);
            std::fs::File::from_raw_fd(fd)
        };
        let mut gate = Self { fifo, full: false };
        gate.set(false);
        Ok(gate)
    }

    fn set(&mut self, open: bool) {
        let mut page = [0; 4096];
        while self.full && open && self.fifo.read(&mut page).is_ok_and(|n| n > 0) {}
        while !self.full && !open && self.fifo.write(&page).is_ok_and(|n| n > 0) {}
        self.full = !open;
    }
}

impl Machine {
    /// A machine with this Falcon plugged in.
    pub fn new(name: &str, falcon: EmulatedFalcon) -> io::Result<Self> {
        let root = std::env::temp_dir().join(format!("hapflow-{name}-{}", std::process::id()));
        let _ = std::fs::remove_dir_all(&root);
        let address = 2;
        let side = plug(&root, address, falcon)?;
        Ok(Self { root, address, side })
    }

    /// Pulls the cable: transfers end, and the device's files go.
    pub fn unplug(&self) -> io::Result<()> {
        let now = self.side.now();
        self.side.falcon.lock().unwrap().trouble().unplugged_ns = Some(now);
        self.side.gate.lock().unwrap().set(true);
        std::fs::remove_file(self.root.join(LINK))?;
        std::fs::remove_dir_all(self.root.join(DEVICES))?;
        std::fs::remove_file(self.root.join("dev").join(node(self.address)))?;
        std::fs::remove_file(self.root.join("ioctl/dev").join(node(self.address)))
    }

    /// Plugs another Falcon in.
    pub fn plug(&mut self, falcon: EmulatedFalcon) -> io::Result<()> {
        self.side.gone.store(true, Ordering::Release);
        self.address += 1;
        self.side = plug(&self.root, self.address, falcon)?;
        Ok(())
    }

    /// The variables under which a program sees this machine's USB.
    pub fn environment(&self) -> [(&'static str, PathBuf); 2] {
        [("LD_PRELOAD", "libumockdev-preload.so.0".into()), ("UMOCKDEV_DIR", self.root.clone())]
    }
}

impl Drop for Machine {
    fn drop(&mut self) {
        self.side.gone.store(true, Ordering::Release);
        let _ = std::fs::remove_dir_all(&self.root);
    }
}

/// Opens the gate when the device has something to say.
fn watch(side: &Side) {
    while !side.gone.load(Ordering::Acquire) {
        std::thread::sleep(Duration::from_micros(50));
        let due = side.falcon.lock().unwrap().next_ns();
        if due <= side.now() {
            side.gate.lock().unwrap().set(true);
        }
    }
}

/// Where `/sys` has the device, and the bus's link to it.
const DEVICES: &str = "sys/devices/pci0000:00/0000:00:14.0/usb1/1-1";
const LINK: &str = "sys/bus/usb/devices/1-1";

fn node(address: u8) -> String {
    format!("bus/usb/001/{address:03}")
}

/// Plugs a Falcon in at this address of the first bus.
fn plug(root: &Path, address: u8, falcon: EmulatedFalcon) -> io::Result<Arc<Side>> {
    describe(root, address)?;
    let gate = Mutex::new(Gate::make(&root.join("dev").join(node(address)))?);
    let side = Arc::new(Side {
        falcon: Mutex::new(falcon),
        stalls_every: AtomicUsize::new(0),
        refuses_every: AtomicUsize::new(0),
        noise_every: AtomicUsize::new(0),
        deaf: AtomicBool::new(false),
        clients: AtomicUsize::new(0),
        claimed: AtomicBool::new(false),
        origin: Instant::now(),
        packets: AtomicUsize::new(0),
        written: AtomicUsize::new(0),
        gate,
        gone: AtomicBool::new(false),
    });
    let socket = root.join("ioctl/dev").join(node(address));
    std::fs::create_dir_all(socket.parent().unwrap_or(root))?;
    let listener = UnixListener::bind(socket)?;
    let theirs = Arc::clone(&side);
    std::thread::spawn(move || {
        for stream in listener.incoming().flatten() {
            let side = Arc::clone(&theirs);
            std::thread::spawn(move || Client::new(stream, side).serve());
        }
    });
    let theirs = Arc::clone(&side);
    std::thread::spawn(move || watch(&theirs));
    Ok(side)
}

/// The files of a Falcon at this address of the first bus.
fn describe(root: &Path, address: u8) -> io::Result<()> {
    let device = root.join(DEVICES);
    std::fs::create_dir_all(&device)?;
    let (node, minor) = (node(address), address - 1);
    let uevent = format!(
        "MAJOR=189\nMINOR={minor}\nDEVNAME={node}\nDEVTYPE=usb_device\nPRODUCT=403/cb48/600\nBUSNUM=001\nDEVNUM={address:03}\n"
    );
    for (name, text) in [
        ("busnum", "1\n"),
        ("devnum", &format!("{address}\n")),
        ("speed", "12\n"),
        ("bConfigurationValue", "1\n"),
        ("bNumConfigurations", "1\n"),
        ("idVendor", "0403\n"),
        ("idProduct", "cb48\n"),
        ("dev", &format!("189:{minor}\n")),
        ("uevent", &uevent),
    ] {
        std::fs::write(device.join(name), text)?;
    }
    std::fs::write(device.join("descriptors"), [DEVICE.as_slice(), &CONFIGURATION].concat())?;
    for folder in ["sys/bus/usb/devices", "dev/bus/usb/001", "dev/.node"] {
        std::fs::create_dir_all(root.join(folder))?;
    }
    symlink("../../../devices/pci0000:00/0000:00:14.0/usb1/1-1", root.join(LINK))?;
    symlink("../../../../../bus/usb", device.join("subsystem"))?;
    symlink(format!("189:{minor}"), root.join("dev/.node").join(node.replace('/', "_")))
}

/// A transfer as the kernel has it.
#[derive(Clone, Copy)]
struct Urb {
    address: u64,
    endpoint: u8,
    buffer: u64,
    length: usize,
}

/// One file descriptor of the program under test.
struct Client {
    stream: UnixStream,
    side: Arc<Side>,
    /// Whether it has asked for anything: the preload library also connects where a file could not be opened.
    counted: bool,
    /// Whether it has the interface.
    claims: bool,
    /// IN transfers that wait for a packet.
    pending: VecDeque<Urb>,
    /// Transfers that never end by themselves.
    stuck: VecDeque<Urb>,
    /// Transfers that have ended: status and length.
    ended: VecDeque<(Urb, i32, usize)>,
}

impl Drop for Client {
    fn drop(&mut self) {
        self.release();
        self.side.clients.fetch_sub(usize::from(self.counted), Ordering::AcqRel);
    }
}

type Answer = io::Result<(i64, i32)>;
const DONE: (i64, i32) = (0, 0);

fn refuse(errno: i32) -> (i64, i32) {
    (-1, errno)
}

impl Client {
    fn new(stream: UnixStream, side: Arc<Side>) -> Self {
        let (pending, stuck, ended) = (VecDeque::new(), VecDeque::new(), VecDeque::new());
        Self { stream, side, counted: false, claims: false, pending, stuck, ended }
    }

    fn serve(mut self) {
        while let Ok([kind, request, argument]) = self.receive() {
            if !self.counted {
                self.counted = true;
                self.side.clients.fetch_add(1, Ordering::AcqRel);
            }
            let answer = if kind == 1 { self.ioctl(request as u32, argument) } else { Ok((-100, 0)) };
            let Ok((result, errno)) = answer else { return };
            if self.send([3, result as u64, errno as u64]).is_err() {
                return;
            }
        }
    }

    fn release(&mut self) {
        if std::mem::take(&mut self.claims) {
            self.side.claimed.store(false, Ordering::Release);
        }
    }

    fn receive(&mut self) -> io::Result<[u64; 3]> {
        let mut bytes = [0; 24];
        self.stream.read_exact(&mut bytes)?;
        let word = |n: usize| u64::from_ne_bytes(std::array::from_fn(|k| bytes[8 * n + k]));
        Ok([word(0), word(1), word(2)])
    }

    fn send(&mut self, words: [u64; 3]) -> io::Result<()> {
        self.stream.write_all(&words.map(u64::to_ne_bytes).concat())
    }

    fn fetch(&mut self, address: u64, length: usize) -> io::Result<Vec<u8>> {
        let mut bytes = vec![0; length];
        if length > 0 {
            self.send([5, address, length as u64])?;
            self.stream.read_exact(&mut bytes)?;
        }
        Ok(bytes)
    }

    fn store(&mut self, address: u64, bytes: &[u8]) -> io::Result<()> {
        if bytes.is_empty() {
            return Ok(());
        }
        self.send([6, address, bytes.len() as u64])?;
        self.stream.write_all(bytes)
    }

    /// Numbers as in Linux, `include/uapi/linux/usbdevice_fs.h`.
    fn ioctl(&mut self, request: u32, argument: u64) -> Answer {
        match request {
            // GET_CAPABILITIES
            0x8004_551A => self.store(argument, &0x3D_u32.to_ne_bytes()).map(|()| DONE),
            // CLAIM, DISCONNECT_CLAIM
            0x8004_550F | 0x8108_551B => {
                let others = self.side.claimed.swap(true, Ordering::AcqRel) && !self.claims;
                self.claims |= !others;
                Ok(if others { refuse(libc::EBUSY) } else { DONE })
            }
            // RELEASE
            0x8004_5510 => {
                self.release();
                Ok(DONE)
            }
            // CLEAR_HALT, RESET, RESETEP, SETINTERFACE, SETCONFIGURATION
            0x8004_5515 | 0x5514 | 0x8004_5503 | 0x8008_5504 | 0x8004_5505 => Ok(DONE),
            // GETDRIVER
            0x4104_5508 => Ok(refuse(libc::ENODATA)),
            0x8038_550A => self.submit(argument),
            0x550B => self.discard(argument),
            0x4008_550C | 0x4008_550D => self.reap(argument),
            _ => Ok(refuse(libc::ENOTTY)),
        }
    }

    fn submit(&mut self, address: u64) -> Answer {
        let raw = self.fetch(address, 56)?;
        let word = |at: usize| u64::from_ne_bytes(std::array::from_fn(|k| raw[at + k]));
        let urb =
            Urb { address, endpoint: raw[1], buffer: word(16), length: (word(24) & 0xFFFF_FFFF) as usize };
        let now = self.side.now();
        if self.side.falcon.lock().unwrap().modem_status(now) == Err(LinkError::Unplugged) {
            return Ok(refuse(libc::ENODEV));
        }
        match (raw[0], urb.endpoint & 0x80) {
            (_, 0) if self.side.deaf.load(Ordering::Acquire) => self.stuck.push_back(urb),
            (2, _) => self.control(urb)?,
            (_, 0)
                if hits(&self.side.refuses_every, self.side.written.fetch_add(1, Ordering::AcqRel) + 1) =>
            {
                self.end(urb, -libc::EPIPE, 0);
            }
            (_, 0) => {
                let bytes = self.fetch(urb.buffer, urb.length)?;
                let written = self.side.falcon.lock().unwrap().write(&bytes, now);
                self.end(urb, status(&written), bytes.len());
            }
            _ => self.pending.push_back(urb),
        }
        Ok(DONE)
    }

    fn end(&mut self, urb: Urb, status: i32, length: usize) {
        self.ended.push_back((urb, status, length));
        self.side.gate.lock().unwrap().set(true);
    }

    fn control(&mut self, urb: Urb) -> io::Result<()> {
        let setup = self.fetch(urb.buffer, 8)?;
        let (kind, number, value) = (setup[0], setup[1], u16::from_le_bytes([setup[2], setup[3]]));
        let room = usize::from(u16::from_le_bytes([setup[6], setup[7]]));
        let now = self.side.now();
        let mut falcon = self.side.falcon.lock().unwrap();
        let answer = match (kind, number) {
            (0x40, _) => falcon.control(number, value, now).map(|()| Vec::new()),
            (0xC0, 5) => falcon.modem_status(now).map(|status| vec![status, 0x60]),
            (0x80, 6) if value >> 8 == 3 => Ok(string(value as u8)),
            _ => Err(LinkError::Stalled),
        };
        drop(falcon);
        let bytes = answer.clone().unwrap_or_default();
        let bytes = &bytes[..bytes.len().min(room)];
        self.store(urb.buffer + 8, bytes)?;
        self.end(urb, status(&answer), bytes.len());
        Ok(())
    }

    fn discard(&mut self, address: u64) -> Answer {
        let take = |waiting: &mut VecDeque<Urb>| {
            let at = waiting.iter().position(|urb| urb.address == address)?;
            waiting.remove(at)
        };
        if let Some(urb) = take(&mut self.pending).or_else(|| take(&mut self.stuck)) {
            self.end(urb, -libc::ENOENT, 0);
            return Ok(DONE);
        }
        Ok(refuse(libc::EINVAL))
    }

    fn reap(&mut self, argument: u64) -> Answer {
        if self.ended.is_empty() {
            self.take_packet()?;
        }
        let Some((urb, status, length)) = self.ended.pop_front() else {
            self.side.gate.lock().unwrap().set(false);
            return Ok(refuse(libc::EAGAIN));
        };
        self.store(urb.address + 4, &status.to_ne_bytes())?;
        self.store(urb.address + 28, &(length as i32).to_ne_bytes())?;
        self.store(argument, &urb.address.to_ne_bytes())?;
        Ok(DONE)
    }

    /// Ends the oldest waiting transfer, if the device has a packet.
    fn take_packet(&mut self) -> io::Result<()> {
        let Some(urb) = self.pending.front().copied() else { return Ok(()) };
        let mut packet = [0; USB_PACKET_BYTES];
        let now = self.side.now();
        let read = self.side.falcon.lock().unwrap().read(&mut packet, now);
        if read == Ok(None) {
            return Ok(());
        }
        self.pending.pop_front();
        let (mut status, mut length) = (status(&read), read.ok().flatten().unwrap_or(0));
        let nth = self.side.packets.fetch_add(1, Ordering::AcqRel) + 1;
        if hits(&self.side.stalls_every, nth) {
            (status, length) = (-libc::EPIPE, 0);
        } else if hits(&self.side.noise_every, nth) {
            (packet, length) = noise(nth);
        }
        self.store(urb.buffer, &packet[..length])?;
        self.end(urb, status, length);
        Ok(())
    }
}

/// Bytes without a meaning, and how many: from none to a full packet.
fn noise(seed: usize) -> ([u8; USB_PACKET_BYTES], usize) {
    let mut state = seed as u64;
    let mut next = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as usize
    };
    let length = next() % (USB_PACKET_BYTES + 1);
    (std::array::from_fn(|_| next() as u8), length)
}

fn status<T>(result: &Result<T, LinkError>) -> i32 {
    match result {
        Ok(_) => 0,
        Err(LinkError::Unplugged) => -libc::ESHUTDOWN,
        Err(_) => -libc::EPIPE,
    }
}

/// A string descriptor.
fn string(index: u8) -> Vec<u8> {
    if index == 0 {
        return vec![4, 3, 9, 4];
    }
    let text = if index == 3 { SERIAL } else { "FALCON HAPTIC" };
    let units: Vec<u8> = text.encode_utf16().flat_map(u16::to_le_bytes).collect();
    [&[units.len() as u8 + 2, 3], units.as_slice()].concat()
}
