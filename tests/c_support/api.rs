//! libhapflow's functions and structs, written down a second time from the header.

use super::{JET, Variant, code, library, scratch};
use libloading::Library;
use std::ffi::{CStr, CString, c_char, c_void};
use std::sync::atomic::{AtomicU32, Ordering};

#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Session {
    pub id: u64,
}

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct SessionConfig {
    pub kind: u32,
    pub size: u32,
    pub next: *const c_void,
    pub scene: *const c_char,
    pub toml: *const c_char,
    pub toml_length: usize,
    pub settings: *const c_char,
    pub threads: u32,
    pub fluid_drive: u32,
    pub servo_drive: u32,
    pub device_count: u32,
    pub devices: *const Device,
    pub log: Option<LogFunction>,
    pub log_user: *mut c_void,
    pub record: u32,
    pub reserved: u32,
    pub built: Scene,
}

/// `hapflow_log_function`: level, text, user.
pub type LogFunction = extern "C" fn(u32, *const c_char, *mut c_void);

#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Device {
    pub id: u64,
}

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct DeviceConfig {
    pub kind: u32,
    pub size: u32,
    pub next: *const c_void,
    pub name: *const c_char,
    pub scene: *const c_char,
    pub toml: *const c_char,
    pub toml_length: usize,
    pub settings: *const c_char,
}

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct ServoPace {
    pub size: u32,
    pub owned: u32,
    pub running: u32,
    pub priority: u32,
    pub ticks: u64,
    pub late: u64,
    pub median_s: f64,
    pub p99_s: f64,
    pub longest_s: f64,
    pub priority_text: *const c_char,
    pub device: *const c_char,
}

#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ToolState {
    pub size: u32,
    pub tool: u32,
    pub buttons: u32,
    pub reserved: u32,
    pub time_s: f64,
    pub dt_s: f64,
    pub position: [f64; 3],
    pub orientation: [f64; 4],
    pub velocity: [f64; 3],
    pub angular_velocity: [f64; 3],
}

#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wrench {
    pub force: [f64; 3],
    pub torque: [f64; 3],
}

impl Wrench {
    pub const ZERO: Self = Self { force: [0.0; 3], torque: [0.0; 3] };
    /// What no tick gives: shows whether it was written.
    pub const UNTOUCHED: Self = Self { force: [777.0; 3], torque: [777.0; 3] };
}

#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Report {
    pub size: u32,
    pub faults: u32,
    pub tick: u64,
    pub time_s: f64,
    pub position: [f64; 3],
    pub body: [f64; 3],
    pub raw_force: [f64; 3],
    pub raw_torque: [f64; 3],
    pub force: [f64; 3],
    pub torque: [f64; 3],
    pub model_frame: u64,
    pub model_age_s: f64,
    pub fluid_frame: u64,
    pub fluid_time_s: f64,
    pub particles: u64,
    pub substeps: u64,
    pub max_speed: f64,
    pub load_force: [f64; 3],
    pub load_torque: [f64; 3],
    pub degraded: u64,
}

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct SceneInfo {
    pub size: u32,
    pub reserved: u32,
    pub name: *const c_char,
    pub about: *const c_char,
    pub toml: *const c_char,
}

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct DeviceInfo {
    pub size: u32,
    pub sensed_dof: u32,
    pub driven_dof: u32,
    pub hardware: u32,
    pub max_force: f64,
    pub name: *const c_char,
    pub about: *const c_char,
}

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct SettingInfo {
    pub size: u32,
    pub kind: u32,
    pub live: u32,
    pub reserved: u32,
    pub min: f64,
    pub max: f64,
    pub path: *const c_char,
    pub group: *const c_char,
    pub unit: *const c_char,
    pub about: *const c_char,
    pub choices: *const c_char,
    pub usual: *const c_char,
}

#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Contact {
    pub solid: u32,
    pub index: u32,
    pub depth: f64,
    pub point: [f64; 3],
    pub normal: [f64; 3],
    pub force: [f64; 3],
}

#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Scene {
    pub id: u64,
}

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct SourceConfig {
    pub kind: u32,
    pub size: u32,
    pub next: *const c_void,
    pub name: *const c_char,
    pub position: [f64; 3],
    pub direction: [f64; 3],
    pub diameter: f64,
    pub speed: f64,
    pub period: f64,
    pub duty: f64,
    pub on: u32,
    pub reserved: u32,
}

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct ObstacleConfig {
    pub kind: u32,
    pub size: u32,
    pub next: *const c_void,
    pub name: *const c_char,
    pub shape: u32,
    pub reserved: u32,
    pub radius: f64,
    pub thickness: f64,
    pub position: [f64; 3],
    pub length: f64,
    pub extent: [f64; 3],
    pub scale: f64,
    pub file: *const c_char,
    pub mesh: *const c_void,
}

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct ToolConfig {
    pub kind: u32,
    pub size: u32,
    pub next: *const c_void,
    pub name: *const c_char,
    pub shape: u32,
    pub reserved: u32,
    pub radius: f64,
    pub thickness: f64,
    pub mass: f64,
    pub collision_response: f64,
    pub position: [f64; 3],
    pub force_scale: f64,
    pub solid_stiffness: f64,
    pub solid_damping: f64,
    pub length: f64,
    pub extent: [f64; 3],
    pub scale: f64,
    pub file: *const c_char,
    pub mesh: *const c_void,
    pub buoyancy_scale: f64,
}

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct BodyConfig {
    pub kind: u32,
    pub size: u32,
    pub next: *const c_void,
    pub name: *const c_char,
    pub shape: u32,
    pub reserved: u32,
    pub radius: f64,
    pub thickness: f64,
    pub density: f64,
    pub position: [f64; 3],
    pub length: f64,
    pub extent: [f64; 3],
    pub scale: f64,
    pub file: *const c_char,
    pub mesh: *const c_void,
}

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct BodyReport {
    pub size: u32,
    pub reserved: u32,
    pub position: [f64; 3],
    pub orientation: [f64; 4],
    pub velocity: [f64; 3],
    pub angular_velocity: [f64; 3],
    pub pressure_force: [f64; 3],
    pub viscous_force: [f64; 3],
    pub torque: [f64; 3],
}

/// A corner of a box.
type Corner = *const [f64; 3];

macro_rules! functions {
    ($($name:ident: fn($($arg:ty),*) $(-> $out:ty)?;)+) => {
        /// The library, loaded. The functions are declared safe: a test gives them wrong values on purpose, but
        /// only such as the header says are refused.
        #[derive(Clone, Copy)]
        pub struct Api {
            $(pub $name: extern "C" fn($($arg),*) $(-> $out)?,)+
            pub test_panic_next_call: Option<extern "C" fn()>,
        }

        fn bind(library: &Library) -> Api {
            // SAFETY: the types are those of the header.
            unsafe {
                Api {
                    $($name: *library.get(concat!("hapflow_", stringify!($name))).unwrap(),)+
                    test_panic_next_call: library.get("hapflow_test_panic_next_call").ok().map(|f| *f),
                }
            }
        }
    };
}

functions! {
    result_text: fn(i32) -> *const c_char;
    last_error: fn(*mut c_char, usize, *mut usize) -> i32;
    negotiate: fn(u32, u32, *mut u32) -> i32;
    version: fn() -> u32;
    session_config_init: fn(*mut SessionConfig, u32) -> i32;
    session_create: fn(*const SessionConfig, *mut Session) -> i32;
    session_destroy: fn(Session) -> i32;
    session_set: fn(Session, *const c_char, f64) -> i32;
    session_set_vector: fn(Session, *const c_char, *const [f64; 3]) -> i32;
    session_set_text: fn(Session, *const c_char, *const c_char) -> i32;
    session_get: fn(Session, *const c_char, *mut f64) -> i32;
    session_get_text: fn(Session, *const c_char, *mut c_char, usize, *mut usize) -> i32;
    build_info: fn(*mut c_char, usize, *mut usize) -> i32;
    scene_info_init: fn(*mut SceneInfo, u32) -> i32;
    scene_count: fn() -> u32;
    scene_get: fn(u32, *mut SceneInfo) -> i32;
    device_info_init: fn(*mut DeviceInfo, u32) -> i32;
    device_count: fn() -> u32;
    device_get: fn(u32, *mut DeviceInfo) -> i32;
    device_config_init: fn(*mut DeviceConfig, u32) -> i32;
    device_open: fn(*const DeviceConfig, *mut Device) -> i32;
    device_close: fn(Device) -> i32;
    device_read: fn(Device, f64, *mut ToolState) -> i32;
    device_write: fn(Device, *const Wrench, f64) -> i32;
    device_clear_faults: fn(Device) -> i32;
    servo_pace_init: fn(*mut ServoPace, u32) -> i32;
    extension: fn(*const c_char) -> *const c_void;
    session_poll: fn(Session) -> i32;
    session_servo_pace: fn(Session, u32, *mut ServoPace) -> i32;
    setting_info_init: fn(*mut SettingInfo, u32) -> i32;
    session_setting_count: fn(Session, *mut u32) -> i32;
    session_setting_info: fn(Session, u32, *mut SettingInfo) -> i32;
    session_emergency_stop: fn(Session) -> i32;
    session_clear_faults: fn(Session) -> i32;
    scene_create: fn(*mut Scene) -> i32;
    scene_load: fn(*const c_char, *mut Scene) -> i32;
    scene_parse: fn(*const c_char, usize, *mut Scene) -> i32;
    scene_destroy: fn(Scene) -> i32;
    scene_set: fn(Scene, *const c_char, f64) -> i32;
    scene_set_vector: fn(Scene, *const c_char, *const [f64; 3]) -> i32;
    scene_set_text: fn(Scene, *const c_char, *const c_char) -> i32;
    scene_set_bounds: fn(Scene, Corner, Corner) -> i32;
    scene_set_periodic: fn(Scene, u32) -> i32;
    scene_set_ground: fn(Scene, *const f64) -> i32;
    scene_set_container: fn(Scene, Corner, Corner) -> i32;
    source_config_init: fn(*mut SourceConfig, u32) -> i32;
    scene_add_source: fn(Scene, *const SourceConfig, *mut u32) -> i32;
    obstacle_config_init: fn(*mut ObstacleConfig, u32) -> i32;
    scene_add_obstacle: fn(Scene, *const ObstacleConfig, *mut u32) -> i32;
    tool_config_init: fn(*mut ToolConfig, u32) -> i32;
    scene_add_tool: fn(Scene, *const ToolConfig, *mut u32) -> i32;
    body_config_init: fn(*mut BodyConfig, u32) -> i32;
    scene_add_body: fn(Scene, *const BodyConfig, *mut u32) -> i32;
    scene_add_pool: fn(Scene, Corner, Corner, *mut u32) -> i32;
    scene_add_sink: fn(Scene, Corner, Corner, *mut u32) -> i32;
    scene_add_change: fn(Scene, f64, *const c_char) -> i32;
    scene_check: fn(Scene) -> i32;
    scene_write: fn(Scene, *mut c_char, usize, *mut usize) -> i32;
    session_limit_force: fn(Session, f64, f64) -> i32;
    session_contacts: fn(Session, u32, *mut Contact, u32, usize, *mut usize) -> i32;
    session_proxy: fn(Session, u32, *mut [f64; 3], *mut [f64; 4]) -> i32;
    session_record: fn(Session, *const c_char) -> i32;
    session_record_stop: fn(Session, *mut u64, *mut u64) -> i32;
    session_report: fn(Session, *mut Report) -> i32;
    session_report_of: fn(Session, u32, *mut Report) -> i32;
    session_tool_count: fn(Session, *mut u32) -> i32;
    tool_state_init: fn(*mut ToolState, u32) -> i32;
    report_init: fn(*mut Report, u32) -> i32;
    servo_tick: fn(Session, *const ToolState, *mut Wrench) -> i32;
    fluid_advance: fn(Session, f64) -> i32;
    fluid_step: fn(Session, f64) -> i32;
    obstacle_count: fn(Session, *mut u32) -> i32;
    obstacle_move: fn(Session, u32, *const [f64; 3], *const [f64; 4]) -> i32;
    obstacle_publish: fn(Session) -> i32;
    body_report_init: fn(*mut BodyReport, u32) -> i32;
    session_body_report: fn(Session, u32, u32, *mut BodyReport) -> i32;
    fluid_particles: fn(Session, *mut f32, usize, *mut usize) -> i32;
    session_particles: fn(Session, *mut f32, usize, *mut usize) -> i32;
}

impl Api {
    /// A library of its own for this test, nothing negotiated: a copy under another name has its own statics.
    pub fn load(variant: Variant) -> Self {
        static COPIES: AtomicU32 = AtomicU32::new(0);
        let name = format!("{}-{}.so", std::process::id(), COPIES.fetch_add(1, Ordering::Relaxed));
        let copy = scratch().join(name);
        std::fs::copy(library(variant), &copy).unwrap();
        // SAFETY: its initialisers are those of Rust's standard library.
        let library = unsafe { Library::new(&copy) }.unwrap();
        std::fs::remove_file(&copy).unwrap();
        let api = bind(&library);
        std::mem::forget(library);
        api
    }

    /// The same, negotiated.
    pub fn ready(variant: Variant) -> Self {
        let api = Self::load(variant);
        assert_eq!((api.negotiate)(1, 1, &mut 0), code::OK);
        api
    }

    pub fn config(&self) -> SessionConfig {
        SessionConfig { threads: 1, ..made(self.session_config_init) }
    }

    /// Makes a session of a scene's text.
    pub fn try_create(&self, toml: &str) -> Result<Session, i32> {
        self.try_create_with(toml, self.config())
    }

    /// The same, with all else as `config` says.
    pub fn try_create_with(&self, toml: &str, config: SessionConfig) -> Result<Session, i32> {
        let config = SessionConfig { toml: toml.as_ptr().cast(), toml_length: toml.len(), ..config };
        let mut session = Session::default();
        match (self.session_create)(&config, &mut session) {
            code::OK => Ok(session),
            failed => Err(failed),
        }
    }

    /// A session of [`JET`].
    pub fn jet(&self) -> Session {
        self.try_create(JET).unwrap_or_else(|c| panic!("{c}: {}", self.error()))
    }

    /// Opens a device by its name, with these settings.
    pub fn open(&self, name: &CStr, settings: &CStr) -> Result<Device, i32> {
        let (name, settings) = (name.as_ptr(), settings.as_ptr());
        let config = DeviceConfig { name, settings, ..made(self.device_config_init) };
        let mut device = Device::default();
        match (self.device_open)(&config, &mut device) {
            code::OK => Ok(device),
            failed => Err(failed),
        }
    }

    /// Where a device is.
    pub fn read(&self, device: Device, time_s: f64) -> ToolState {
        let mut state = made(self.tool_state_init);
        assert_eq!((self.device_read)(device, time_s, &mut state), code::OK);
        state
    }

    pub fn pace(&self, session: Session, tool: u32) -> ServoPace {
        let mut pace = made(self.servo_pace_init);
        assert_eq!((self.session_servo_pace)(session, tool, &mut pace), code::OK);
        pace
    }

    /// A tool at rest in the origin, at tick `n`.
    pub fn state(&self, n: u64) -> ToolState {
        ToolState { time_s: n as f64 * 1e-3, ..made(self.tool_state_init) }
    }

    pub fn tick(&self, session: Session, state: &ToolState) -> (i32, Wrench) {
        let mut wrench = Wrench::UNTOUCHED;
        let code = (self.servo_tick)(session, state, &mut wrench);
        (code, wrench)
    }

    /// Fluid and servo over the ticks `from..to`, at rest; every wrench.
    pub fn run(&self, session: Session, from: u64, to: u64) -> Vec<Wrench> {
        let tick = |n| {
            let state = self.state(n);
            assert_eq!((self.fluid_advance)(session, state.time_s), code::OK);
            let (result, wrench) = self.tick(session, &state);
            assert!(result >= 0, "{result}");
            wrench
        };
        (from..to).map(tick).collect()
    }

    pub fn report(&self, session: Session) -> Report {
        let mut report = made(self.report_init);
        assert_eq!((self.session_report)(session, &mut report), code::OK);
        report
    }

    pub fn report_of(&self, session: Session, tool: u32) -> Report {
        let mut report = made(self.report_init);
        assert_eq!((self.session_report_of)(session, tool, &mut report), code::OK);
        report
    }

    /// An empty scene.
    pub fn scene(&self) -> Scene {
        let mut scene = Scene::default();
        assert_eq!((self.scene_create)(&mut scene), code::OK);
        scene
    }

    /// A scene as the text of a scene file.
    pub fn written(&self, scene: Scene) -> String {
        in_two_calls(|text, capacity, length| (self.scene_write)(scene, text, capacity, length))
    }

    /// What a tool touches, by the two calls that the header asks for.
    pub fn contacts(&self, session: Session, tool: u32) -> Vec<Contact> {
        let (size, mut count) = (size_of::<Contact>() as u32, 0);
        assert_eq!(
            (self.session_contacts)(session, tool, std::ptr::null_mut(), size, 0, &mut count),
            code::OK
        );
        let mut contacts = vec![Contact::default(); count];
        let to = contacts.as_mut_ptr();
        assert_eq!((self.session_contacts)(session, tool, to, size, count, &mut count), code::OK);
        contacts
    }

    /// Position and orientation of a tool's proxy.
    pub fn proxy(&self, session: Session, tool: u32) -> ([f64; 3], [f64; 4]) {
        let (mut position, mut orientation) = ([7.0; 3], [7.0; 4]);
        assert_eq!((self.session_proxy)(session, tool, &mut position, &mut orientation), code::OK);
        (position, orientation)
    }

    /// The last error's message, by the two calls that the header asks for.
    pub fn error(&self) -> String {
        in_two_calls(|text, capacity, length| (self.last_error)(text, capacity, length))
    }

    pub fn build_info(&self) -> String {
        in_two_calls(|text, capacity, length| (self.build_info)(text, capacity, length))
    }

    pub fn get_text(&self, session: Session, path: &CStr) -> String {
        in_two_calls(|text, capacity, length| {
            (self.session_get_text)(session, path.as_ptr(), text, capacity, length)
        })
    }

    /// Every setting of the session.
    pub fn settings(&self, session: Session) -> Vec<SettingInfo> {
        let mut count = 0;
        assert_eq!((self.session_setting_count)(session, &mut count), code::OK);
        let setting = |index| {
            let mut info = made(self.setting_info_init);
            assert_eq!((self.session_setting_info)(session, index, &mut info), code::OK);
            info
        };
        (0..count).map(setting).collect()
    }

    pub fn set(&self, session: Session, path: &str, value: f64) -> i32 {
        (self.session_set)(session, CString::new(path).unwrap().as_ptr(), value)
    }

    pub fn set_text(&self, session: Session, path: &str, value: &str) -> i32 {
        let (path, value) = (CString::new(path).unwrap(), CString::new(value).unwrap());
        (self.session_set_text)(session, path.as_ptr(), value.as_ptr())
    }

    pub fn get(&self, session: Session, path: &str) -> Result<f64, i32> {
        let mut value = f64::NAN;
        match (self.session_get)(session, CString::new(path).unwrap().as_ptr(), &mut value) {
            code::OK => Ok(value),
            failed => Err(failed),
        }
    }
}

/// A struct as its init function makes it.
pub fn made<T>(init: extern "C" fn(*mut T, u32) -> i32) -> T {
    let mut value = std::mem::MaybeUninit::uninit();
    assert_eq!(init(value.as_mut_ptr(), size_of::<T>() as u32), code::OK);
    // SAFETY: the init function has filled it.
    unsafe { value.assume_init() }
}

/// A text by the two calls that the header asks for.
fn in_two_calls(call: impl Fn(*mut c_char, usize, *mut usize) -> i32) -> String {
    let mut length = 0;
    assert_eq!(call(std::ptr::null_mut(), 0, &mut length), code::OK);
    let mut buffer = vec![0_u8; length + 1];
    assert_eq!(call(buffer.as_mut_ptr().cast(), buffer.len(), &mut length), code::OK);
    CStr::from_bytes_with_nul(&buffer).unwrap().to_str().unwrap().into()
}

/// What the library shows.
pub fn shown<'a>(text: *const c_char) -> &'a str {
    assert!(!text.is_null());
    // SAFETY: not null, and the header says for how long it is a text.
    unsafe { CStr::from_ptr(text) }.to_str().unwrap()
}
