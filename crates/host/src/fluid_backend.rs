//! A fluid of a plugin.

use crate::PluginError;
use crate::extension::{Library, Table};
use crate::failure::Failure;
use crate::generated::*;
use crate::limits::{FARTHEST, FASTEST, FASTEST_TURN, UNIT, within};
use glam::{DQuat, DVec3};
use hapflow_fluid::{
    Aabb, BodyConfig, BodyDrive, BodyLoad, BodySample, ContainerForm, FluidBackend, FluidConfig, FluidError,
    FrameInput, FrameOutput, ParticleView, Shape, Source, Surroundings,
};
use std::ffi::{CStr, c_char, c_void};
use std::mem::size_of;
use std::ptr;

// SAFETY: numbers, a text and functions that may be null.
unsafe impl Table for hapflow_fluid_backend_extension {
    const NAME: &'static [u8] = HAPFLOW_EXTENSION_FLUID_BACKEND;
}

type Make =
    unsafe extern "C" fn(*const hapflow_fluid_config, *mut *mut c_void, *mut c_char, usize) -> hapflow_result;
type Configure =
    unsafe extern "C" fn(*mut c_void, *const hapflow_fluid_config, *mut c_char, usize) -> hapflow_result;
type Step = unsafe extern "C" fn(
    *mut c_void,
    *const hapflow_fluid_frame,
    *mut hapflow_fluid_result,
) -> hapflow_result;
type Particles = unsafe extern "C" fn(*mut c_void, *mut f32, usize, *mut usize) -> hapflow_result;

#[derive(Clone, Copy)]
struct Functions {
    name: &'static str,
    create: Make,
    configure: Configure,
    step: Step,
    particles: Option<Particles>,
    destroy: unsafe extern "C" fn(*mut c_void),
}

/// A fluid engine of a plugin, of which fluids are made.
#[derive(Clone)]
pub struct PluginFluid {
    functions: Functions,
    failure: Failure,
}

impl PluginFluid {
    pub(crate) fn of(library: &Library) -> Result<Option<Self>, PluginError> {
        let Some(table) = library.table::<hapflow_fluid_backend_extension>()? else { return Ok(None) };
        let functions = Functions {
            name: library.name(table.name)?,
            create: library.required(table.create, "create")?,
            configure: library.required(table.configure, "configure")?,
            step: library.required(table.step, "step")?,
            particles: table.particles,
            destroy: library.required(table.destroy, "destroy")?,
        };
        Ok(Some(Self { functions, failure: Failure::default() }))
    }

    /// Its name.
    pub fn name(&self) -> &'static str {
        self.functions.name
    }

    /// Why one of its fluids failed first while it ran.
    pub fn failure(&self) -> Option<&str> {
        self.failure.reason()
    }

    /// Makes a fluid.
    ///
    /// # Errors
    /// What the plugin refuses, with its reason; and bodies that this revision of the table does not tell: meshes, and those
    /// without an end.
    pub fn create(&self, config: &FluidConfig) -> Result<Box<dyn FluidBackend>, FluidError> {
        let Self { functions, failure } = self.clone();
        let lists = Lists::of(functions.name, config)?;
        let mut fluid = ptr::null_mut();
        asked(functions.name, |reason, capacity| {
            // SAFETY: the lists last for the call, and `fluid` is there to be written.
            unsafe { (functions.create)(&lists.config(config), &mut fluid, reason, capacity) }
        })?;
        let at_rest = config.world.bodies.iter().map(|body| BodySample::at(body.position));
        let output = FrameOutput { bodies: at_rest.collect(), ..FrameOutput::default() };
        Ok(Box::new(Fluid { functions, failure, fluid, output, ready: false }))
    }
}

/// Calls a function that may give a reason.
fn asked(
    backend: &'static str,
    call: impl FnOnce(*mut c_char, usize) -> hapflow_result,
) -> Result<(), FluidError> {
    let mut reason = [0u8; 512];
    let result = call(reason.as_mut_ptr().cast(), reason.len() - 1);
    if result >= 0 {
        return Ok(());
    }
    let reason = CStr::from_bytes_until_nul(&reason).map(CStr::to_string_lossy).unwrap_or_default();
    let what = if reason.is_empty() { format!("result {result}") } else { reason.into_owned() };
    Err(FluidError::Unsupported { backend, what })
}

/// A configuration's lists, as C has them.
struct Lists {
    sources: Vec<hapflow_fluid_source>,
    pools: Vec<hapflow_fluid_box>,
    sinks: Vec<hapflow_fluid_box>,
    bodies: Vec<hapflow_fluid_body>,
}

impl Lists {
    fn of(backend: &'static str, config: &FluidConfig) -> Result<Self, FluidError> {
        let world = &config.world;
        let untold = || FluidError::Unsupported { backend, what: UNTOLD.into() };
        let bodies: Result<_, _> = world.bodies.iter().map(|b| body(b).ok_or_else(untold)).collect();
        Ok(Self {
            sources: world.sources.iter().map(source).collect(),
            pools: world.pools.iter().map(in_c).collect(),
            sinks: world.sinks.iter().map(in_c).collect(),
            bodies: bodies?,
        })
    }

    fn config(&self, config: &FluidConfig) -> hapflow_fluid_config {
        let (s, world) = (&config.settings, &config.world);
        hapflow_fluid_config {
            size: size_of::<hapflow_fluid_config>() as u32,
            threads: config.threads as u32,
            frame_hz: config.frame_hz,
            density: s.rest_density,
            viscosity: s.viscosity,
            surface_tension: s.surface_tension,
            spacing: s.spacing,
            gravity: s.gravity.to_array(),
            two_way: s.two_way.into(),
            has_ground: world.ground.is_some().into(),
            ground: world.ground.unwrap_or(0.0),
            bounds: in_c(&world.bounds),
            container: world.container.map_or(HAPFLOW_CONTAINER_NONE, |c| form(c.form)),
            periodic: (0..3).filter(|&axis| world.periodic[axis]).map(|axis| 1 << axis).sum(),
            inside: in_c(&world.container.map_or(NOTHING, |c| c.inner)),
            source_count: self.sources.len() as u32,
            pool_count: self.pools.len() as u32,
            sink_count: self.sinks.len() as u32,
            body_count: self.bodies.len() as u32,
            sources: self.sources.as_ptr(),
            pools: self.pools.as_ptr(),
            sinks: self.sinks.as_ptr(),
            bodies: self.bodies.as_ptr(),
        }
    }
}

const UNTOLD: &str = "bodies that are meshes, or have no end, are not told to plugins";

const NOTHING: Aabb = Aabb { min: DVec3::ZERO, max: DVec3::ZERO };

fn form(form: ContainerForm) -> u32 {
    match form {
        ContainerForm::Box => HAPFLOW_CONTAINER_BOX,
        ContainerForm::Cylinder => HAPFLOW_CONTAINER_CYLINDER,
        ContainerForm::Bowl => HAPFLOW_CONTAINER_BOWL,
    }
}

fn in_c(b: &Aabb) -> hapflow_fluid_box {
    hapflow_fluid_box { min: b.min.to_array(), max: b.max.to_array() }
}

fn source(source: &Source) -> hapflow_fluid_source {
    hapflow_fluid_source {
        position: source.position.to_array(),
        direction: source.direction.normalize_or(DVec3::NEG_Y).to_array(),
        diameter: source.diameter,
        speed: source.speed,
        period: source.period,
        duty: source.duty,
        on: source.on.into(),
        reserved: 0,
    }
}

fn body(body: &BodyConfig) -> Option<hapflow_fluid_body> {
    let (shape, radius, length, extent) = match body.shape {
        Shape::Sphere { radius } => (HAPFLOW_SHAPE_SPHERE, radius, 0.0, DVec3::ZERO),
        Shape::Disc { radius, thickness } => (HAPFLOW_SHAPE_DISC, radius, thickness, DVec3::ZERO),
        Shape::Capsule { radius, length } => (HAPFLOW_SHAPE_CAPSULE, radius, length, DVec3::ZERO),
        Shape::Box { size } => (HAPFLOW_SHAPE_BOX, 0.0, 0.0, size),
        Shape::Mesh(_) | Shape::Slab { .. } | Shape::Drum { .. } => return None,
    };
    Some(hapflow_fluid_body {
        shape,
        reserved: 0,
        radius,
        length,
        extent: extent.to_array(),
        bounding_radius: body.shape.bounding_radius(),
        mass: body.mass,
        position: body.position.to_array(),
    })
}

/// A fluid that a plugin made.
struct Fluid {
    functions: Functions,
    failure: Failure,
    fluid: *mut c_void,
    output: FrameOutput,
    ready: bool,
}

// SAFETY: the plugin is told that it is called in one thread at a time, and not which.
unsafe impl Send for Fluid {}

impl FluidBackend for Fluid {
    fn name(&self) -> &'static str {
        self.functions.name
    }

    fn configure(&mut self, config: &FluidConfig) -> Result<(), FluidError> {
        let lists = Lists::of(self.functions.name, config)?;
        asked(self.functions.name, |reason, capacity| {
            // SAFETY: the lists last for the call.
            unsafe { (self.functions.configure)(self.fluid, &lists.config(config), reason, capacity) }
        })
    }

    fn submit(&mut self, frame: &FrameInput<'_>) {
        let paths: Vec<Vec<_>> = frame.bodies.iter().map(|m| m.path.iter().map(sample).collect()).collect();
        let motions: Vec<_> =
            frame.bodies.iter().zip(&paths).map(|(m, path)| motion(m.drive, path)).collect();
        let mut loads = vec![NO_LOAD; motions.len()];
        let states = frame.bodies.iter().zip(&self.output.bodies);
        let states = states.map(|(m, last)| match m.drive {
            BodyDrive::Led => m.path.last().unwrap_or(last),
            BodyDrive::Driven { .. } | BodyDrive::Free => last,
        });
        let mut states: Vec<_> = states.map(sample).collect();
        let c_frame = hapflow_fluid_frame {
            size: size_of::<hapflow_fluid_frame>() as u32,
            body_count: motions.len() as u32,
            duration_s: frame.duration,
            motions: motions.as_ptr(),
        };
        let mut result = hapflow_fluid_result {
            size: size_of::<hapflow_fluid_result>() as u32,
            degraded: 0,
            particles: 0,
            substeps: 0,
            max_speed: 0.0,
            loads: loads.as_mut_ptr(),
            states: states.as_mut_ptr(),
        };
        // SAFETY: the lists have an entry for each body, and last for the call.
        let code = unsafe { (self.functions.step)(self.fluid, &c_frame, &mut result) };
        self.output.time += frame.duration;
        self.ready = true;
        match taken(code, &loads, &states) {
            Ok((loads, bodies)) => self.take(&result, loads, bodies),
            Err(what) => self.fail(&what),
        }
    }

    fn poll(&mut self) -> Option<&FrameOutput> {
        std::mem::take(&mut self.ready).then_some(&self.output)
    }

    fn snapshot(&mut self, view: &mut ParticleView) {
        *view = ParticleView::default();
        let Some(particles) = self.functions.particles else { return };
        let mut count = 0;
        // SAFETY: a capacity of 0 has nothing written.
        if unsafe { particles(self.fluid, ptr::null_mut(), 0, &mut count) } < 0 {
            return;
        }
        let room = count.min(MOST_PARTICLES);
        view.positions.resize(room, [0.0; 3]);
        // SAFETY: there is room for as many as are said.
        let result = unsafe { particles(self.fluid, view.positions.as_mut_ptr().cast(), room, &mut count) };
        view.positions.truncate(if result < 0 { 0 } else { count });
        view.positions.retain(|place| within(place.map(f64::from), FARTHEST));
        let there = view.positions.len();
        view.velocities.resize(there, [0.0; 3]);
        view.pressures.resize(there, 0.0);
        view.ids = (0..there as u32).collect();
    }

    /// Not told by this revision of the table: a session lets no coupling ask.
    fn surroundings(&mut self, _: DVec3, _: f64, _: &mut Surroundings) {}
}

/// More particles than anybody draws.
const MOST_PARTICLES: usize = 10_000_000;
/// More sub-steps than a frame has.
const MOST_SUBSTEPS: u64 = 1_000_000_000;

impl Fluid {
    fn take(&mut self, result: &hapflow_fluid_result, loads: Vec<BodyLoad>, bodies: Vec<BodySample>) {
        self.output.loads = loads;
        self.output.bodies = bodies;
        self.output.particles = result.particles as usize;
        // All frames' are summed.
        self.output.substeps = result.substeps.min(MOST_SUBSTEPS) as usize;
        self.output.max_speed = if result.max_speed.is_finite() { result.max_speed } else { 0.0 };
        self.output.degraded = result.degraded != 0;
    }

    /// Bodies stay where they were, with loads of which the session makes a fault.
    fn fail(&mut self, what: &str) {
        let (name, time_s) = (self.functions.name, self.output.time);
        self.failure.tell(|| format!("fluid {name}, frame that ends at {time_s:.3} s: {what}"));
        self.output.loads =
            vec![BodyLoad { pressure_force: DVec3::NAN, ..BodyLoad::default() }; self.output.bodies.len()];
        self.output.degraded = true;
    }
}

/// What a step gave, or what is wrong with it.
fn taken(
    code: hapflow_result,
    loads: &[hapflow_fluid_load],
    states: &[hapflow_fluid_sample],
) -> Result<(Vec<BodyLoad>, Vec<BodySample>), String> {
    if code < 0 {
        return Err(format!("step gave result {code}"));
    }
    let loads: Vec<_> = loads.iter().map(load).collect();
    if let Some(n) = loads.iter().position(|load| !(load.force().is_finite() && load.torque.is_finite())) {
        return Err(format!("step gave body {n} a load that is not finite"));
    }
    match states.iter().position(|state| !placed(state)) {
        Some(n) => Err(format!("step gave body {n} a motion that cannot be: {:?}", from_c(&states[n]))),
        None => Ok((loads, states.iter().map(from_c).collect())),
    }
}

fn load(c: &hapflow_fluid_load) -> BodyLoad {
    BodyLoad {
        pressure_force: DVec3::from_array(c.pressure_force),
        viscous_force: DVec3::from_array(c.viscous_force),
        torque: DVec3::from_array(c.torque),
    }
}

fn placed(state: &hapflow_fluid_sample) -> bool {
    within(state.position, FARTHEST)
        && within(state.velocity, FASTEST)
        && within(state.angular_velocity, FASTEST_TURN)
        && within([DQuat::from_array(state.orientation).length() - 1.0], UNIT)
}

impl Drop for Fluid {
    fn drop(&mut self) {
        // SAFETY: it was made by the same table, and is not used again.
        unsafe { (self.functions.destroy)(self.fluid) };
    }
}

const NO_LOAD: hapflow_fluid_load =
    hapflow_fluid_load { pressure_force: [0.0; 3], viscous_force: [0.0; 3], torque: [0.0; 3] };

fn motion(drive: BodyDrive, path: &[hapflow_fluid_sample]) -> hapflow_fluid_motion {
    let (drive, velocity) = match drive {
        BodyDrive::Led => (HAPFLOW_MOTION_LED, DVec3::ZERO),
        BodyDrive::Driven { velocity } => (HAPFLOW_MOTION_DRIVEN, velocity),
        BodyDrive::Free => (HAPFLOW_MOTION_FLOATING, DVec3::ZERO),
    };
    hapflow_fluid_motion {
        drive,
        sample_count: path.len() as u32,
        velocity: velocity.to_array(),
        path: path.as_ptr(),
    }
}

fn sample(s: &BodySample) -> hapflow_fluid_sample {
    hapflow_fluid_sample {
        time_s: s.time,
        position: s.position.to_array(),
        orientation: s.orientation.to_array(),
        velocity: s.velocity.to_array(),
        angular_velocity: s.angular_velocity.to_array(),
    }
}

fn from_c(c: &hapflow_fluid_sample) -> BodySample {
    BodySample {
        time: c.time_s,
        position: DVec3::from_array(c.position),
        orientation: DQuat::from_array(c.orientation).normalize(),
        velocity: DVec3::from_array(c.velocity),
        angular_velocity: DVec3::from_array(c.angular_velocity),
    }
}
