//! The devices that are taken through the list, each with what stands behind it.

use glam::DVec3;
use hapflow::devices::falcon::{
    EmulatedFalcon, EmulatedHand, EmulatedTransport, Falcon, FalconOptions, Geometry, Kinematics, Trouble,
};
use hapflow::devices::hid::{Gone, Reports, SpaceMouse};
use hapflow::devices::sdk::{ForceDimension, OpenHaptics};
use hapflow::devices::{
    AtEnd, HandSettings, HapticDevice, Motion, NullDevice, Replay, SimulatedHand, TargetScript,
};
use hapflow::realtime::{Clock, VirtualClock};
use libloading::Library;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::{Arc, Mutex};

/// Something that fails: its name, and what lets it fail or takes that back.
pub type Failure = (&'static str, Box<dyn Fn(bool)>);

/// A device, and what a test sees and does behind it.
pub struct Subject {
    pub name: &'static str,
    /// Where its grip rests, m.
    pub place: DVec3,
    /// The force at its motors, N. Nothing to be seen of a simulated hand, whose motors are itself, nor where there are none.
    pub felt: Option<Box<dyn Fn() -> DVec3>>,
    /// What takes it away while it is used. Nothing, where there is no cable and nobody who could fall silent.
    pub failures: Vec<Failure>,
    device: Option<Box<dyn HapticDevice>>,
    /// Lets a millisecond pass behind it.
    pass: Box<dyn FnMut()>,
}

impl Subject {
    fn simulated(name: &'static str, place: DVec3, device: impl HapticDevice + 'static) -> Self {
        let device: Option<Box<dyn HapticDevice>> = Some(Box::new(device));
        Self { name, place, felt: None, failures: Vec::new(), device, pass: Box::new(|| {}) }
    }

    /// The device, once.
    pub fn open(&mut self) -> Box<dyn HapticDevice> {
        self.device.take().unwrap()
    }

    /// A millisecond passes.
    pub fn step(&mut self) {
        (self.pass)();
    }
}

/// Every device that can be had here.
pub fn all() -> Vec<Subject> {
    let mut all = vec![
        Subject::simulated("null", DVec3::Y, NullDevice::new(DVec3::Y)),
        Subject::simulated("replay", DVec3::new(0.02, 1.0, 0.0), replay()),
        Subject::simulated("hand", DVec3::new(0.01, 0.02, 0.03), hand()),
        emulated_falcon(),
        space_mouse(),
    ];
    match (force_dimension(), touch()) {
        (Some(force_dimension), Some(touch)) => all.extend([force_dimension, touch]),
        _ => println!("SKIPPED: makers' libraries, whose stand-ins need a C compiler"),
    }
    all
}

fn replay() -> Replay {
    let motion = Motion::parse("time_s,x_m,y_m,z_m\n0,0,0,0\n1,0.02,0,0\n2,0.02,0,0\n", "line.csv").unwrap();
    Replay::new(motion, DVec3::Y, AtEnd::Hold).unwrap()
}

fn hand() -> SimulatedHand {
    let script = TargetScript::new(DVec3::new(0.01, 0.02, 0.03), &[], AtEnd::Hold).unwrap();
    SimulatedHand::new(HandSettings::default(), script).unwrap()
}

fn emulated_falcon() -> Subject {
    let options = FalconOptions::new(Geometry::load("libnifalcon").unwrap());
    // Where the hand that homes it leaves it, the middle of its workspace.
    let hand = EmulatedHand::new(Kinematics::new(options.geometry.clone()), &[], true).unwrap();
    let device = Arc::new(Mutex::new(EmulatedFalcon::new(hand, Trouble::default(), true)));
    let clock = Arc::new(VirtualClock::new());
    let transport = EmulatedTransport::new(Arc::clone(&device), Arc::clone(&clock) as _);
    let mut falcon = Falcon::new(Box::new(transport), options).unwrap();
    falcon.prepare(&mut |_| ControlFlow::Continue(())).unwrap();
    let (felt, board) = (Arc::clone(&device), Arc::clone(&device));
    let quiet = Arc::clone(&clock);
    let failure = |name, fail: fn(&mut EmulatedFalcon, u64)| -> Failure {
        let (device, clock) = (Arc::clone(&device), Arc::clone(&clock));
        let now = move || clock.now_ns();
        (
            name,
            Box::new(move |on| {
                let device = &mut *device.lock().unwrap();
                *device.trouble() = Trouble::default();
                if on {
                    fail(device, now());
                }
            }),
        )
    };
    let failures = vec![
        failure("its cable is out", |device, now| device.trouble().unplugged_ns = Some(now)),
        failure("it is silent", |device, _| device.trouble().silent_after = Some(device.commanded().1)),
        failure("it says nonsense", |device, _| device.trouble().garbles_every = 1),
        failure("it has lost its marks", |device, _| device.hand().unhome()),
    ];
    let mut last_commands = 0;
    Subject {
        name: "falcon",
        place: DVec3::ZERO,
        felt: Some(Box::new(move || {
            let device = &mut *felt.lock().unwrap();
            device.hand().felt()
        })),
        failures,
        device: Some(Box::new(falcon)),
        // The driver moves the clock, but where it is silent.
        pass: Box::new(move || {
            let mut device = board.lock().unwrap();
            let commands = device.commanded().1;
            if commands == last_commands {
                quiet.advance_ns(1_000_000);
            }
            last_commands = commands;
            device.hand().live(quiet.now_ns());
        }),
    }
}

/// A cap that is pushed to the right, and turned, as far as it goes, and after a tenth of a second let go.
#[derive(Clone, Default)]
struct Cap(Arc<Mutex<CapState>>);

#[derive(Default)]
struct CapState {
    gone: bool,
    pushed_ms: u32,
    waiting: bool,
}

impl Reports for Cap {
    fn next(&mut self, report: &mut [u8]) -> Result<usize, Gone> {
        let mut cap = self.0.lock().unwrap();
        if cap.gone {
            return Err(Gone);
        }
        if !std::mem::take(&mut cap.waiting) {
            return Ok(0);
        }
        let right = if cap.pushed_ms <= 100 { 350_i16 } else { 0 }.to_le_bytes();
        report[..13].copy_from_slice(&[1, right[0], right[1], 0, 0, 0, 0, 0, 0, 0, 0, right[0], right[1]]);
        Ok(13)
    }
}

fn space_mouse() -> Subject {
    let cap = Cap::default();
    cap.0.lock().unwrap().waiting = true;
    let (cable, hand) = (cap.clone(), cap.clone());
    Subject {
        failures: vec![("its cable is out", Box::new(move |out| cable.0.lock().unwrap().gone = out))],
        pass: Box::new(move || {
            let mut cap = hand.0.lock().unwrap();
            cap.pushed_ms += 1;
            cap.waiting = true;
        }),
        // A tenth of a second at full speed.
        ..Subject::simulated(
            "spacemouse",
            DVec3::new(0.1 * SpaceMouse::SPEED_M_PER_S, 1.0, 0.0),
            SpaceMouse::over(Box::new(cap), DVec3::Y),
        )
    }
}

/// The stand-in for a maker's library, which the C compiler makes anew for each device.
fn stand_in(source: &str) -> Option<(PathBuf, Arc<Library>)> {
    static COUNT: AtomicU32 = AtomicU32::new(0);
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("crates/devices/tests/sdk").join(source);
    let name = format!("conformance-{}-{}.so", std::process::id(), COUNT.fetch_add(1, Ordering::Relaxed));
    let library = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let built = Command::new("cc").args(["-shared", "-fPIC", "-o"]).arg(&library).arg(source).status();
    assert!(built.ok()?.success());
    // SAFETY: a library of this test's own.
    let loaded = unsafe { Library::new(&library) }.unwrap();
    Some((library, Arc::new(loaded)))
}

fn set(library: &Library, state: u32, place: DVec3) {
    // SAFETY: the type is that of the function in both stand-ins.
    let set = unsafe { library.get::<extern "C" fn(u32, f64, f64, f64, u32) -> i32>("fake_set") }.unwrap();
    set(state, place.x, place.y, place.z, 0);
}

/// The force as the stand-in has it.
fn force(library: &Library) -> DVec3 {
    let mut all = [0.0; 7];
    // SAFETY: both stand-ins write at most seven numbers.
    unsafe { library.get::<extern "C" fn(*mut f64) -> i32>("fake_get").unwrap()(all.as_mut_ptr()) };
    DVec3::from_slice(&all)
}

fn force_dimension() -> Option<Subject> {
    let (path, library) = stand_in("fake_dhd.c")?;
    set(&library, 1, DVec3::new(0.03, 0.01, 0.02));
    let device = ForceDimension::open_with(&[&path], DVec3::ZERO).unwrap();
    let (felt, cable) = (Arc::clone(&library), Arc::clone(&library));
    Some(Subject {
        name: "force-dimension",
        place: DVec3::new(0.01, 0.02, 0.03),
        // Its x is to the user, its y right, its z up.
        felt: Some(Box::new(move || {
            let own = force(&felt);
            DVec3::new(own.y, own.z, own.x)
        })),
        failures: vec![("its cable is out", Box::new(move |out| set(&cable, u32::from(!out), DVec3::ZERO)))],
        device: Some(Box::new(device)),
        pass: Box::new(move || {
            // SAFETY: the type is that of the function.
            unsafe { library.get::<extern "C" fn() -> i32>("fake_pass").unwrap()() };
        }),
    })
}

fn touch() -> Option<Subject> {
    let (path, library) = stand_in("fake_hd.c")?;
    let device = OpenHaptics::open_with(&[&path], DVec3::ZERO).unwrap();
    set(&library, 0, DVec3::new(10.0, 20.0, 30.0));
    let (felt, cable) = (Arc::clone(&library), Arc::clone(&library));
    Some(Subject {
        name: "touch",
        place: DVec3::new(0.01, 0.02, 0.03),
        felt: Some(Box::new(move || force(&felt))),
        failures: vec![(
            "its library tells of an error",
            Box::new(move |out| set(&cable, if out { 0x0300 } else { 0 }, DVec3::ZERO)),
        )],
        device: Some(Box::new(device)),
        pass: Box::new(move || {
            // SAFETY: the type is that of the function.
            unsafe { library.get::<extern "C" fn(i32) -> i32>("fake_run").unwrap()(1) };
        }),
    })
}
