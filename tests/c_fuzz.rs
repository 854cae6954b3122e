//! The C interface called at random, with arguments that are wrong in every way that the header says is refused:
//! nothing crashes, no panic is even caught, outputs stay on failure, and no force is wrong.
// A test's helpers fail as the test does.
#![allow(clippy::unwrap_used, clippy::panic)]

mod c_support;

use c_support::{
    Api, BodyConfig, DRIVE_OWNED, Device, JET, Random, Scene, Session, SessionConfig, SourceConfig,
    ToolConfig, ToolState, Variant, Wrench, code, made,
};
use std::ffi::{CString, c_char};
use std::ptr::{null, null_mut};

/// Memory for any struct or text, which may lie at any address, with a guard behind it.
const ROOM: usize = 8192;
const GUARD: u8 = 0xa5;

/// Numbers that are wrong somewhere, and some that are right.
const NUMBERS: [f64; 18] = [
    f64::NAN,
    f64::INFINITY,
    f64::NEG_INFINITY,
    f64::MAX,
    f64::MIN_POSITIVE,
    -0.0,
    0.0,
    1.0,
    -1.0,
    1e-3,
    0.02,
    0.5,
    10.0,
    1e4,
    1e7,
    1e9,
    1e300,
    -1e300,
];

const PATHS: [&[u8]; 16] = [
    b"fluid.viscosity\0",
    b"fluid.gravity\0",
    b"fluid.solver\0",
    b"fluid.two_way\0",
    b"fluid.max_substeps\0",
    b"tool.radius\0",
    b"tool.force_scale\0",
    b"gate.max_force\0",
    b"gate.ramp_in\0",
    b"source.tap.speed\0",
    b"source.tap.on\0",
    b"run.fluid_hz\0",
    b"source..\0",
    b"\0",
    b"\xff\xfe\0",
    b"fluid.\xc3\xa9\0",
];

const VALUES: [&[u8]; 12] = [
    b"true\0",
    b"false\0",
    b"0.1\0",
    b"nan\0",
    b"-inf\0",
    b"[0, -9.81, 0]\0",
    b"[1, nan, 2]\0",
    b"[[[[\0",
    b"muller\0",
    b"\"\0",
    b"\xf0\x28\0",
    b"\0",
];

const SCENES: [&str; 7] = [
    JET,
    "[run]\nbackend = \"analytic-jet\"\n[[obstacle]]\nname = \"a\"\n",
    "",
    "[fluid]\nspacing = -1\n",
    "[[source]]\nname = 3\n",
    "\u{0}\u{1}",
    "[run]\nfluid_hz = 1e999\n",
];

/// One run of random calls.
struct Fuzz {
    api: Api,
    random: Random,
    sessions: Vec<Session>,
    stale: Vec<Session>,
    devices: Vec<Device>,
    scenes: Vec<Scene>,
    tick: u64,
    memory: Vec<u8>,
    /// How often each result came.
    results: std::collections::BTreeMap<i32, u32>,
}

impl Fuzz {
    fn new(seed: u64) -> Self {
        let (api, random) = (Api::load(Variant::Shipped), Random(seed));
        let (sessions, stale, devices, scenes) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        let (memory, results) = (vec![GUARD; ROOM + 16], Default::default());
        Self { api, random, sessions, stale, devices, scenes, tick: 0, memory, results }
    }

    fn session(&mut self) -> Session {
        let random = &mut self.random;
        match random.below(12) {
            0 => Session { id: random.next() },
            1 => Session { id: random.below(70) | random.below(4) << 32 },
            2 if !self.stale.is_empty() => *random.of(&self.stale),
            _ if self.sessions.is_empty() => Session::default(),
            _ => *random.of(&self.sessions),
        }
    }

    fn device(&mut self) -> Device {
        match self.random.below(8) {
            0 => Device { id: self.random.below(70) | self.random.below(4) << 32 },
            _ if self.devices.is_empty() => Device::default(),
            _ => *self.random.of(&self.devices),
        }
    }

    fn number(&mut self) -> f64 {
        if self.random.below(3) == 0 { *self.random.of(&NUMBERS) } else { self.random.unit() }
    }

    fn path(&mut self) -> *const c_char {
        if self.random.below(20) == 0 { null() } else { self.random.of(&PATHS).as_ptr().cast() }
    }

    fn value(&mut self) -> *const c_char {
        if self.random.below(20) == 0 { null() } else { self.random.of(&VALUES).as_ptr().cast() }
    }

    /// Some of the memory, at an odd address as well.
    fn place<T>(&mut self) -> *mut T {
        match self.random.below(10) {
            0 => null_mut(),
            at => self.memory[(at as usize - 1) % 8..].as_mut_ptr().cast(),
        }
    }

    fn struct_size(&mut self, right: usize) -> u32 {
        match self.random.below(6) {
            0 => self.random.below(300) as u32,
            1 => self.random.below(4200) as u32,
            2 => u32::MAX - self.random.below(2) as u32,
            _ => right as u32,
        }
    }

    /// A call of a text or a buffer with room for `capacity`: what lies behind it stays.
    fn buffered(&mut self, bytes_each: usize, call: impl Fn(*mut u8, usize, *mut usize) -> i32) -> i32 {
        self.memory.fill(GUARD);
        let capacity = self.random.below(40) as usize;
        let start = self.random.below(8) as usize;
        let to = if self.random.below(10) == 0 { null_mut() } else { self.memory[start..].as_mut_ptr() };
        let mut length = usize::MAX;
        let result = call(to, capacity, &mut length);
        let end = start + capacity * bytes_each;
        assert!(self.memory[end..].iter().all(|b| *b == GUARD), "wrote behind the buffer");
        assert!(result < 0 || length != usize::MAX);
        assert!(result >= 0 || (length == usize::MAX && self.memory.iter().all(|b| *b == GUARD)));
        result
    }

    fn state(&mut self) -> ToolState {
        self.tick += 1;
        let mut state = self.api.state(self.tick);
        for _ in 0..self.random.below(3) {
            let (number, axis) = (self.number(), self.random.below(3) as usize);
            match self.random.below(12) {
                0 => state.time_s = number,
                1 => state.dt_s = number,
                2 => state.orientation[axis] = number,
                3 => state.size = self.struct_size(136),
                4 => state.tool = self.random.below(2) as u32,
                5 => state.angular_velocity[axis] = number,
                6 => state.velocity[axis] = number,
                _ => state.position[axis] = 0.1 * self.random.unit(),
            }
        }
        state
    }

    fn tick(&mut self) -> i32 {
        let (session, state) = (self.session(), self.state());
        let mut wrench = Wrench::UNTOUCHED;
        // A state that says a larger size has that much behind it.
        let mut room = [0_u8; 4200];
        // SAFETY: a ToolState is plain bytes, fewer than the room has.
        unsafe { (&raw const state).cast::<u8>().copy_to_nonoverlapping(room.as_mut_ptr(), 136) };
        let from = if self.random.below(30) == 0 { null() } else { room.as_ptr().cast() };
        let result = (self.api.servo_tick)(session, from, &mut wrench);
        let numbers = [wrench.force, wrench.torque].concat();
        if result < 0 {
            assert_eq!(wrench, Wrench::ZERO, "{result}");
        }
        assert!(numbers.iter().all(|n| n.is_finite() && n.abs() <= 50.0), "{result}: {wrench:?}");
        result
    }

    fn config(&mut self) -> SessionConfig {
        let scene = *self.random.of(&SCENES);
        let mut config = SessionConfig {
            toml: scene.as_ptr().cast(),
            toml_length: scene.len().max(1),
            ..self.api.config()
        };
        match self.random.below(24) {
            0 => config.kind = self.random.below(3) as u32,
            1 => config.size = self.random.below(56) as u32,
            2 => config.next = SCENES.as_ptr().cast(),
            3 => config.threads = self.random.next() as u32 | 1025,
            4 => config.fluid_drive = 2,
            5 => config.scene = c"tap".as_ptr(),
            6 => config.toml = null(),
            7 => config.settings = self.path(),
            8 => config.settings = c"run.fluid_hz = 60\n\n# x\nfluid.viscosity=1".as_ptr(),
            9..=12 => config.fluid_drive = DRIVE_OWNED,
            13 => config.servo_drive = 2,
            14 => config.device_count = 1,
            16 => config.record = 2,
            17 => config.reserved = 1,
            15 => (config.servo_drive, config.device_count) = (DRIVE_OWNED, 1),
            _ => {}
        }
        if config.toml_length == 1 {
            config.toml = c" ".as_ptr();
        }
        config
    }

    fn create(&mut self) -> i32 {
        if self.sessions.len() > 5 {
            return self.destroy();
        }
        let (config, mut session) = (self.config(), Session { id: 9 });
        let result = (self.api.session_create)(&config, &mut session);
        if result >= 0 {
            self.sessions.push(session);
        } else {
            assert_eq!(session, Session { id: 9 });
        }
        result
    }

    fn destroy(&mut self) -> i32 {
        let session = self.session();
        let result = (self.api.session_destroy)(session);
        let known = self.sessions.iter().position(|s| *s == session);
        assert_eq!(result, if known.is_some() { code::OK } else { code::HANDLE });
        self.stale.extend(known.map(|at| self.sessions.swap_remove(at)));
        result
    }

    /// A device is opened, used or closed.
    fn use_device(&mut self) -> i32 {
        let (api, device) = (self.api, self.device());
        self.memory.fill(GUARD);
        match self.random.below(8) {
            0 if self.devices.len() < 4 => match api.open(c"hand", c"") {
                Ok(device) => {
                    self.devices.push(device);
                    code::OK
                }
                Err(failed) => failed,
            },
            0 if self.random.below(4) == 0 => {
                self.devices.retain(|d| *d != device);
                (api.device_close)(device)
            }
            1 => (api.device_clear_faults)(device),
            2 => {
                let size = self.struct_size(136).to_ne_bytes();
                self.memory[..4].copy_from_slice(&size);
                (api.device_read)(device, self.tick as f64 * 1e-3, self.memory.as_mut_ptr().cast())
            }
            3 => (api.device_read)(device, self.number(), self.place()),
            _ => {
                let wrench = Wrench { force: [self.number(); 3], torque: [self.number(); 3] };
                let from = if self.random.below(10) == 0 { null() } else { &raw const wrench };
                (api.device_write)(device, from, if self.random.below(2) == 0 { 1e-3 } else { self.number() })
            }
        }
    }

    fn scene(&mut self) -> Scene {
        match self.random.below(8) {
            0 => Scene { id: self.random.below(70) | self.random.below(4) << 32 },
            _ if self.scenes.is_empty() => Scene::default(),
            _ => *self.random.of(&self.scenes),
        }
    }

    /// Corners, one of them perhaps null.
    fn corners(&mut self) -> [Option<[f64; 3]>; 2] {
        std::array::from_fn(|_| (self.random.below(10) > 0).then(|| std::array::from_fn(|_| self.number())))
    }

    /// A scene is made, changed, made a session of or destroyed.
    fn build(&mut self) -> i32 {
        let (api, scene, [min, max]) = (self.api, self.scene(), self.corners());
        let at = |corner: &Option<[f64; 3]>| corner.as_ref().map_or(null(), |c| &raw const *c);
        let (min, max, index) = (at(&min), at(&max), null_mut());
        match self.random.below(18) {
            15 => {
                let (radius, shape, density) = (self.number(), self.random.below(8) as u32, self.number());
                let config = BodyConfig { radius, shape, density, ..made(api.body_config_init) };
                (api.scene_add_body)(scene, &config, index)
            }
            16 => (api.scene_set_periodic)(scene, self.random.below(9) as u32),
            0 | 1 if self.scenes.len() < 8 => {
                let mut made = Scene::default();
                let result = (api.scene_create)(&mut made);
                self.scenes.extend((result == code::OK).then_some(made));
                result
            }
            2 if self.random.below(8) == 0 => {
                self.scenes.retain(|s| *s != scene);
                (api.scene_destroy)(scene)
            }
            3 => (api.scene_set)(scene, self.path(), self.number()),
            4 => (api.scene_set_text)(scene, self.path(), self.value()),
            5 => (api.scene_set_bounds)(scene, min, max),
            6 => (api.scene_set_container)(scene, min, max),
            7 => (api.scene_set_ground)(scene, &self.number()),
            8 => (api.scene_add_pool)(scene, min, max, index),
            9 => (api.scene_add_sink)(scene, min, max, self.place()),
            10 => {
                let (position, speed) = ([self.number(); 3], self.number());
                let config =
                    SourceConfig { position, speed, name: self.value(), ..made(api.source_config_init) };
                (api.scene_add_source)(scene, &config, index)
            }
            11 => {
                let (radius, shape) = (self.number(), self.random.below(8) as u32);
                let config = ToolConfig { radius, shape, name: self.value(), ..made(api.tool_config_init) };
                (api.scene_add_tool)(scene, &config, index)
            }
            12 => (api.scene_add_change)(scene, self.number(), self.value()),
            13 => (api.scene_check)(scene),
            14 => self.buffered(1, |to, n, length| (api.scene_write)(scene, to.cast(), n, length)),
            _ => {
                let mut session = Session::default();
                let config = SessionConfig { built: scene, ..api.config() };
                let result = (api.session_create)(&config, &mut session);
                assert!(result < 0 || (api.session_destroy)(session) == code::OK);
                result
            }
        }
    }

    fn get(&mut self) -> i32 {
        let (session, path, mut number) = (self.session(), self.path(), 7.0);
        let result = (self.api.session_get)(session, path, &mut number);
        assert!(result == code::OK || number == 7.0);
        result
    }

    fn init(&mut self) -> i32 {
        let api = self.api;
        self.memory.fill(GUARD);
        let which = self.random.below(9);
        let right = [104, 136, 280, 32, 40, 56, 72, 80, 184][which as usize];
        let size = self.struct_size(right);
        match which {
            0 => (api.session_config_init)(self.place(), size),
            1 => (api.tool_state_init)(self.place(), size),
            2 => (api.report_init)(self.place(), size),
            3 => (api.scene_info_init)(self.place(), size),
            4 => (api.device_info_init)(self.place(), size),
            5 => (api.device_config_init)(self.place(), size),
            6 => (api.servo_pace_init)(self.place(), size),
            8 => (api.body_report_init)(self.place(), size),
            _ => (api.setting_info_init)(self.place(), size),
        }
    }

    /// Structs that are filled, whatever their memory says before.
    fn fill(&mut self) -> i32 {
        let (api, session) = (self.api, self.session());
        self.memory.fill(self.tick as u8);
        let index = self.random.below(100) as u32;
        if self.random.below(2) == 0 {
            let size = self.struct_size(280).to_ne_bytes();
            self.memory[..4].copy_from_slice(&size);
        }
        match self.random.below(6) {
            4 => (api.session_body_report)(session, index % 5, index % 3, self.place()),
            0 if index < 50 => (api.session_report)(session, self.place()),
            0 => (api.session_report_of)(session, index % 3, self.place()),
            1 => (api.scene_get)(index % 6, self.place()),
            2 => (api.device_get)(index % 5, self.place()),
            3 => (api.session_servo_pace)(session, index % 3, self.place()),
            _ => (api.session_setting_info)(session, index, self.place()),
        }
    }

    fn call(&mut self) -> i32 {
        let (api, session) = (self.api, self.session());
        match self.random.below(38) {
            0 => (api.negotiate)(self.random.below(3) as u32, self.random.below(3) as u32, self.place()),
            1 => self.create(),
            2 if self.random.below(6) == 0 => self.destroy(),
            3 => (api.session_set)(session, self.path(), self.number()),
            4 => (api.session_set_text)(session, self.path(), self.value()),
            5 => {
                let value = [self.number(), self.number(), self.number()];
                let from = if self.random.below(10) == 0 { null() } else { &raw const value };
                (api.session_set_vector)(session, self.path(), from)
            }
            6 => self.get(),
            7 => {
                let path = self.path();
                self.buffered(1, |to, n, length| (api.session_get_text)(session, path, to.cast(), n, length))
            }
            8 => self.buffered(1, |to, n, length| (api.last_error)(to.cast(), n, length)),
            9 => self.buffered(1, |to, n, length| (api.build_info)(to.cast(), n, length)),
            10 => self.buffered(12, |to, n, length| (api.fluid_particles)(session, to.cast(), n, length)),
            11 if self.random.below(4) == 0 => {
                (api.session_limit_force)(session, self.number(), 0.1 * self.number())
            }
            11 if self.random.below(4) == 0 => (api.session_record_stop)(session, self.place(), self.place()),
            11 => (api.session_emergency_stop)(session),
            12 | 13 => (api.session_clear_faults)(session),
            14 => self.init(),
            15 => self.fill(),
            16 | 17 => {
                let time_s = self.tick as f64 * 1e-3;
                (api.fluid_advance)(session, time_s)
            }
            18 => (api.fluid_advance)(session, self.number()),
            19 if self.random.below(2) == 0 => (api.session_tool_count)(session, self.place()),
            19 => (api.fluid_step)(session, self.number()),
            20 => (api.session_setting_count)(session, self.place()),
            21 => self.buffered(12, |to, n, length| (api.session_particles)(session, to.cast(), n, length)),
            22 => {
                let (index, x, w) = (self.random.below(2) as u32, self.number(), self.number());
                let orientation = if self.random.below(2) == 0 { [0.0, 0.0, 0.0, 1.0] } else { [w; 4] };
                (api.obstacle_move)(session, index, &[x, 0.0, 0.0], &orientation)
            }
            23 if self.random.below(3) == 0 => (api.session_poll)(session),
            23 if self.random.below(4) == 0 => {
                let tool = self.random.below(2) as u32;
                (api.session_proxy)(session, tool, self.place(), self.place())
            }
            23 if self.random.below(4) == 0 => {
                let (tool, size) = (self.random.below(2) as u32, self.struct_size(88));
                self.buffered(88, |to, n, length| {
                    (api.session_contacts)(session, tool, to.cast(), size, n, length)
                })
            }
            23 if self.random.below(2) == 0 => (api.obstacle_count)(session, self.place()),
            23 => (api.obstacle_publish)(session),
            24..28 => self.use_device(),
            28 | 29 => self.build(),
            _ => self.tick(),
        }
    }

    fn run(&mut self, calls: u64) {
        for n in 0..calls {
            let result = self.call();
            // A panic is caught, but is a defect all the same.
            let known = (code::RECORDING..=code::MORE).contains(&result);
            assert!(known && ![code::PANIC, code::FAULTED].contains(&result), "call {n}: {result}");
            *self.results.entry(result).or_default() += 1;
        }
    }
}

#[test]
fn twenty_thousand_random_calls_do_no_harm() {
    let calls = std::env::var("HAPFLOW_FUZZ_CALLS").ok().and_then(|n| n.parse().ok()).unwrap_or(20_000);
    for seed in 1..=2 {
        let mut fuzz = Fuzz::new(seed);
        fuzz.run(calls / 2);
        // All that can come in one thread has come: the calls got somewhere.
        let rare = [
            code::PANIC,
            code::NOT_NEGOTIATED,
            code::BUSY,
            code::FULL,
            code::NOT_FOUND,
            code::FAULTED,
            code::DEVICE,
            code::FILE,
        ];
        let missing: Vec<_> = (code::RECORDING..=code::MORE)
            .filter(|r| !rare.contains(r) && !fuzz.results.contains_key(r))
            .collect();
        assert!(missing.is_empty(), "seed {seed}: never came: {missing:?} of {:?}", fuzz.results);
        // And the library is as good as new.
        let expected = Api::ready(Variant::Shipped);
        let same = [&fuzz.api, &expected].map(|api| api.run(api.jet(), 0, 100));
        assert_eq!(same[0], same[1]);
    }
}

#[test]
fn random_words_as_scenes_and_settings_are_refused_with_a_reason() {
    let (api, mut random) = (Api::ready(Variant::Shipped), Random(3));
    const WORDS: [&str; 20] = [
        "[fluid]",
        "[[source]]",
        "[run]",
        "[",
        "]",
        "=",
        "\n",
        " ",
        "\"",
        "#",
        "spacing",
        "speed",
        "1",
        "-",
        "e",
        "nan",
        "{",
        "}",
        ".",
        "\u{e9}",
    ];
    for _ in 0..500 {
        let text: String = (0..random.below(30)).map(|_| *random.of(&WORDS)).collect();
        let text = CString::new(text).unwrap();
        let config = SessionConfig { toml: text.as_ptr(), ..api.config() };
        let mut session = Session::default();
        match (api.session_create)(&config, &mut session) {
            code::OK => assert_eq!((api.session_destroy)(session), code::OK),
            failed => {
                assert!([code::SCENE, code::VALUE].contains(&failed), "{text:?}: {failed}");
                assert!(!api.error().is_empty());
            }
        }
    }
}
