//! Every setting in one table: path, unit, range, whether it may change while a session runs, and what it does.
//!
//! Scene files, `--set`, `[[change]]`, the C ABI and the README's table all read it. Settings of a source are
//! addressed by its name: `source.tap.speed`; those of an obstacle or a body likewise.

use crate::form::{Form, FormKind};
use crate::scene::{BackendKind, DeviceKind, FreeBody, MotionOrigin, Obstacle, Scene, ToolSettings};
use crate::{SceneError, Value};
use hapflow_fluid::{ContainerForm, InteractionMode, Kernel, Liquid, Solver, Source};
use hapflow_haptics::{CouplingKind, FilterSpec};

/// What a setting may be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    /// A number in a range.
    Number {
        /// Smallest.
        min: f64,
        /// Largest.
        max: f64,
    },
    /// A whole number in a range.
    Integer {
        /// Smallest.
        min: f64,
        /// Largest.
        max: f64,
    },
    /// Yes or no.
    Bool,
    /// One of these words.
    Choice(&'static [&'static str]),
    /// A text that its own parser checks.
    Text,
    /// Three numbers, each in a range.
    Vector {
        /// Smallest.
        min: f64,
        /// Largest.
        max: f64,
    },
}

impl Kind {
    /// The range in `unit` or the words, as an error or a table says it.
    pub fn allowed(&self, unit: &str) -> String {
        let unit = if unit.is_empty() { String::new() } else { format!(" {unit}") };
        match self {
            Self::Number { min, max } => format!("a number from {min} to {max}{unit}"),
            Self::Integer { min, max } => format!("a whole number from {min} to {max}{unit}"),
            Self::Bool => "true or false".into(),
            Self::Choice(words) => format!("one of {}", words.join(", ")),
            Self::Text => "a text in quotes".into(),
            Self::Vector { min, max } => format!("three numbers [x, y, z], each from {min} to {max}{unit}"),
        }
    }

    /// Whether `value` is of this kind and in its range.
    pub fn fits(&self, value: &Value) -> bool {
        match (self, value) {
            (Self::Number { min, max }, Value::Number(n)) => n >= min && n <= max,
            (Self::Integer { min, max }, Value::Number(n)) => n >= min && n <= max && n.fract() == 0.0,
            (Self::Bool, Value::Bool(_)) | (Self::Text, Value::Text(_)) => true,
            (Self::Choice(words), Value::Text(t)) => words.contains(&t.as_str()),
            (Self::Vector { min, max }, Value::Vector(v)) => {
                v.to_array().iter().all(|c| c >= min && c <= max)
            }
            _ => false,
        }
    }
}

/// One setting of a `T`.
pub struct Setting<T> {
    /// Path, or the last part of it for a source.
    pub path: &'static str,
    /// Unit; empty for none.
    pub unit: &'static str,
    /// What it may be.
    pub kind: Kind,
    /// Whether it may change while a session runs.
    pub live: bool,
    /// What it does.
    pub about: &'static str,
    get: fn(&T) -> Value,
    set: fn(&mut T, &Value) -> Result<(), String>,
}

impl<T> Clone for Setting<T> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<T> Copy for Setting<T> {}

impl<T> std::fmt::Debug for Setting<T> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Setting").field("path", &self.path).field("kind", &self.kind).finish_non_exhaustive()
    }
}

impl<T> Setting<T> {
    /// Its value in `owner`.
    pub fn get(&self, owner: &T) -> Value {
        (self.get)(owner)
    }

    /// The range or the words, as an error or a table says it.
    pub fn allowed(&self) -> String {
        self.kind.allowed(self.unit)
    }

    /// Sets it in `owner`; `running` refuses what holds for a whole session.
    pub(crate) fn put(
        &self,
        owner: &mut T,
        path: &str,
        value: &Value,
        running: bool,
    ) -> Result<(), SceneError> {
        if running && !self.live {
            return Err(SceneError::NotLive(path.into()));
        }
        let bad =
            |expected: String| SceneError::BadValue { path: path.into(), value: value.to_string(), expected };
        if !self.kind.fits(value) {
            return Err(bad(self.allowed()));
        }
        (self.set)(owner, value).map_err(bad)
    }
}

macro_rules! number {
    ($path:literal, $unit:literal, $min:literal..=$max:literal, $live:ident, $($field:ident).+, $about:literal) => {
        Setting {
            path: $path,
            unit: $unit,
            kind: Kind::Number { min: $min, max: $max },
            live: $live,
            about: $about,
            get: |s| Value::Number(s.$($field).+),
            set: |s, v| { s.$($field).+ = v.number(); Ok(()) },
        }
    };
}

macro_rules! integer {
    ($path:literal, $min:literal..=$max:literal, $($field:ident).+, $about:literal) => {
        Setting {
            path: $path,
            unit: "",
            kind: Kind::Integer { min: $min, max: $max },
            live: LIVE,
            about: $about,
            get: |s| Value::Number(s.$($field).+ as f64),
            set: |s, v| { s.$($field).+ = v.number() as usize; Ok(()) },
        }
    };
}

macro_rules! flag {
    ($path:literal, $($field:ident).+, $about:literal) => {
        Setting {
            path: $path,
            unit: "",
            kind: Kind::Bool,
            live: LIVE,
            about: $about,
            get: |s| Value::Bool(s.$($field).+),
            set: |s, v| { s.$($field).+ = v.bool(); Ok(()) },
        }
    };
}

macro_rules! vector {
    ($path:literal, $unit:literal, $min:literal..=$max:literal, $live:ident, $($field:ident).+, $about:literal) => {
        Setting {
            path: $path,
            unit: $unit,
            kind: Kind::Vector { min: $min, max: $max },
            live: $live,
            about: $about,
            get: |s| Value::Vector(s.$($field).+),
            set: |s, v| { s.$($field).+ = v.vector(); Ok(()) },
        }
    };
}

macro_rules! text {
    ($path:literal, $($field:ident).+, $about:literal) => {
        Setting {
            path: $path,
            unit: "",
            kind: Kind::Text,
            live: FIXED,
            about: $about,
            get: |s| Value::Text(s.$($field).+.clone()),
            set: |s, v| { s.$($field).+ = v.text().to_string(); Ok(()) },
        }
    };
}

/// A choice among the variants of an enum, in the order of its words.
macro_rules! choice {
    ($path:literal, $live:ident, $($field:ident).+, [$($word:literal => $variant:path),+], $about:literal) => {
        Setting {
            path: $path,
            unit: "",
            kind: Kind::Choice(&[$($word),+]),
            live: $live,
            about: $about,
            get: |s| Value::Text(match s.$($field).+ { $($variant => $word),+ }.to_string()),
            set: |s, v| {
                s.$($field).+ = match v.text() { $($word => $variant,)+ other => return Err(other.to_string()) };
                Ok(())
            },
        }
    };
}

/// May change while a session runs.
const LIVE: bool = true;
/// Holds for a whole session.
const FIXED: bool = false;

/// Settings of a scene.
pub const SETTINGS: &[Setting<Scene>] =
    &joined::<_, SETTINGS_LENGTH>(&[RUN_AND_FLUID, &form_settings(FIRST_TOOL_FORM), OTHERS]);

const SETTINGS_LENGTH: usize = RUN_AND_FLUID.len() + FORM.len() + OTHERS.len();

const RUN_AND_FLUID: &[Setting<Scene>] = &[
    number!("run.duration", "s", 0.01..=3600.0, FIXED, run.duration, "Simulated time of a run."),
    number!(
        "run.fluid_hz",
        "Hz",
        10.0..=1000.0,
        FIXED,
        run.fluid_hz,
        "Fluid frames a second; each gives the servo one new model."
    ),
    number!(
        "run.fluid_delay",
        "frames",
        0.0..=1.0,
        FIXED,
        run.fluid_delay,
        "Time that a frame takes to compute, on the virtual clock."
    ),
    choice!("run.coupling", FIXED, run.coupling, ["direct" => CouplingKind::Direct, "momentum" => CouplingKind::Momentum, "local" => CouplingKind::Local], "How tool and fluid meet: `direct` leads the tool along the device's path and renders the fluid's mean load; `momentum` is the thesis's baseline; `local` renders a model of the fluid round the tool, at the hand's newest place."),
    Setting {
        path: "run.filter",
        unit: "",
        kind: Kind::Text,
        live: FIXED,
        about: "What smooths the force: none, bartlett-hann:11@fluid, boxcar:10@servo, butterworth:50@servo, one-euro:5:0.5@servo …; jet, crossing or stirring, a preset for that use of momentum or direct; \"auto\" takes the coupling's own.",
        get: |s| Value::Text(s.run.filter.map_or("auto".into(), |f| f.to_string())),
        set: set_filter,
    },
    choice!("run.backend", FIXED, run.backend, ["cpu" => BackendKind::Cpu, "analytic-jet" => BackendKind::AnalyticJet], "Who computes the fluid: particles on the CPU, or jets in closed form."),
    choice!("run.device", FIXED, run.device, ["hand" => DeviceKind::Hand, "replay" => DeviceKind::Replay, "null" => DeviceKind::Null, "falcon" => DeviceKind::Falcon, "emulated-falcon" => DeviceKind::EmulatedFalcon, "force-dimension" => DeviceKind::ForceDimension, "touch" => DeviceKind::Touch, "spacemouse" => DeviceKind::SpaceMouse], "What moves the tool: a simulated hand, a recorded motion, nothing, or a device; `hapflow devices` says more."),
    text!(
        "run.motion",
        run.motion,
        "Motion of the replay device: a shipped name or a CSV file (time_s,x_m,y_m,z_m)."
    ),
    choice!("run.motion_origin", FIXED, run.motion_origin, ["tool" => MotionOrigin::Tool, "scene" => MotionOrigin::Scene], "Where that motion begins: at the tool's start, in the device's axes, or where it says in the scene, as a recording has it."),
    text!(
        "plugin.backend",
        plugin.backend,
        "Fluid of a plugin (`hapflow run --plugin`), by its name, in place of `run.backend`; not with coupling `local`."
    ),
    text!(
        "plugin.coupling",
        plugin.coupling,
        "Coupling of a plugin, by its name, in place of `run.coupling`."
    ),
    text!(
        "plugin.device",
        plugin.device,
        "Device of a plugin, by its file's name, in place of `run.device`: in real time."
    ),
    choice!("fluid.solver", LIVE, fluid.solver, ["wcsph" => Solver::Wcsph, "dfsph" => Solver::Dfsph, "muller" => Solver::Muller], "`wcsph`: stiff, with density diffusion and analytic walls; `dfsph`: incompressible by iteration, the same walls; `muller`: the thesis's."),
    choice!("fluid.mode", LIVE, fluid.mode, ["full" => InteractionMode::Full, "none" => InteractionMode::None, "mixed" => InteractionMode::Mixed], "Which particles act on which: all; none (gravity and contacts only); or in every other sub-step."),
    number!(
        "fluid.spacing",
        "m",
        1e-4..=1.0,
        LIVE,
        fluid.spacing,
        "Rest particle spacing; a particle has the mass rest_density × spacing³. A change resamples the fluid."
    ),
    Setting {
        path: "fluid.rest_particles",
        unit: "1/m³",
        kind: Kind::Number { min: 1.0, max: 1e12 },
        live: LIVE,
        about: "Rest particles a cubic metre: the thesis's way to say the spacing, 1/spacing³.",
        get: |s| Value::Number((s.fluid.spacing.powi(-3) * 1e3).round() / 1e3),
        set: |s, v| {
            s.fluid.spacing = v.number().powf(-1.0 / 3.0);
            Ok(())
        },
    },
    choice!("fluid.kernel", LIVE, fluid.kernel, ["low-pass" => Kernel::LowPass, "wendland" => Kernel::Wendland, "cubic" => Kernel::Cubic], "Kernel of wcsph: low-pass is blind to how the particles stand at 2.7 spacings, Wendland C2 and the cubic spline see it a little. muller has its own three."),
    number!(
        "fluid.support",
        "spacings",
        0.0..=4.0,
        LIVE,
        fluid.support,
        "Influence radius of a particle; 0 takes the solver's own (wcsph and dfsph 2.7, muller 2.0), else at least 1.2."
    ),
    Setting {
        path: "fluid.liquid",
        unit: "",
        kind: Kind::Choice(&["custom", "water", "oil", "glycerine", "honey"]),
        live: LIVE,
        about: "Takes density, viscosity and surface tension of a liquid at 20 °C (honey 25 °C); single values are set over it. \"custom\" leaves them, and stands where they are no liquid's.",
        get: |s| Value::Text(s.fluid.liquid().map_or("custom", liquid_name).into()),
        set: |s, v| {
            if let Some(liquid) = Liquid::ALL.into_iter().find(|&l| liquid_name(l) == v.text()) {
                s.fluid.set_liquid(liquid);
            }
            Ok(())
        },
    },
    number!("fluid.rest_density", "kg/m³", 1e-3..=1e5, LIVE, fluid.rest_density, "Density at rest."),
    number!(
        "fluid.viscosity",
        "Pa·s",
        0.0..=1e4,
        LIVE,
        fluid.viscosity,
        "Dynamic viscosity, to any stiffness. What the solver adds comes on top."
    ),
    number!(
        "fluid.artificial_viscosity",
        "",
        0.0..=1.0,
        LIVE,
        fluid.artificial_viscosity,
        "α: what the solver adds for stability. wcsph: a filter of noise at the particle spacing, as strong there as a kinematic viscosity α c H/20. muller: 1.6 times that, on all flow."
    ),
    number!(
        "fluid.shifting",
        "",
        0.0..=0.5,
        LIVE,
        fluid.shifting,
        "How fast particles of wcsph spread to where there is room: a diffusivity in units of c dx. 0 leaves it out."
    ),
    number!(
        "fluid.background_pressure",
        "Pa",
        0.0..=1e7,
        LIVE,
        fluid.background_pressure,
        "Pressure of wcsph that all is under: for a fluid without free surface, which may then pull."
    ),
    number!(
        "fluid.surface_tension",
        "N/m",
        0.0..=10.0,
        LIVE,
        fluid.surface_tension,
        "Surface tension; water 0.0727. At 0 it is not computed. Solids are wetted at an angle of 90° (wcsph)."
    ),
    number!(
        "fluid.stiffness",
        "m²/s²",
        0.0..=1e5,
        LIVE,
        fluid.stiffness,
        "k of muller's p = k(ρ − ρ₀): the higher, the less compressible and the finer the steps."
    ),
    number!(
        "fluid.cohesion",
        "",
        0.0..=1.0,
        LIVE,
        fluid.cohesion,
        "Share of muller's negative pressure that is kept: 1 as the thesis writes it, 0 for free surfaces that stay calm."
    ),
    number!(
        "fluid.sound_speed",
        "m/s",
        0.0..=2000.0,
        LIVE,
        fluid.sound_speed,
        "Speed of sound of wcsph; 0 takes ten times the highest speed that the scene can give."
    ),
    number!(
        "fluid.density_diffusion",
        "",
        0.0..=0.3,
        LIVE,
        fluid.density_diffusion,
        "δ of wcsph: smooths the pressure."
    ),
    number!(
        "fluid.acoustic_damping",
        "c dx",
        0.0..=1.0,
        LIVE,
        fluid.acoustic_damping,
        "ζ of wcsph: takes sound out."
    ),
    number!(
        "fluid.tolerance",
        "",
        1e-4..=0.5,
        LIVE,
        fluid.tolerance,
        "Share of the compression by gravity and flow that the pressure of dfsph may leave unanswered."
    ),
    integer!(
        "fluid.max_iterations",
        1.0..=1000.0,
        fluid.max_iterations,
        "Most iterations of each solve of dfsph in a sub-step."
    ),
    number!("fluid.damping", "1/s", 0.0..=1000.0, LIVE, fluid.damping, "Rate at which all velocities decay."),
    number!(
        "fluid.max_displacement",
        "m",
        0.0..=10.0,
        LIVE,
        fluid.max_displacement,
        "Farthest that a particle may go in one fluid frame; 0 sets no cap."
    ),
    number!(
        "fluid.lifetime",
        "s",
        0.0..=1e6,
        LIVE,
        fluid.lifetime,
        "Age at which a particle vanishes; 0 keeps it."
    ),
    integer!(
        "fluid.max_particles",
        1.0..=5e6,
        fluid.max_particles,
        "Most particles at once; sources wait while it is reached."
    ),
    integer!(
        "fluid.max_substeps",
        1.0..=1e5,
        fluid.max_substeps,
        "Most sub-steps a frame; settings that need more are refused."
    ),
    flag!(
        "fluid.sleep",
        fluid.sleep,
        "Whether fluid at rest is left out of the computation until something comes near: full mode, without lifetime and repeating sides."
    ),
    vector!("fluid.gravity", "m/s²", -100.0..=100.0, LIVE, fluid.gravity, "Acceleration of gravity."),
    number!(
        "fluid.restitution",
        "",
        0.0..=1.0,
        LIVE,
        fluid.restitution,
        "Share of the normal velocity that a particle keeps in a contact by impulse (muller, mode none)."
    ),
    flag!(
        "fluid.two_way",
        fluid.two_way,
        "true: fluid and tool push each other; false: the tool pushes the fluid and feels nothing."
    ),
    Setting {
        path: "container.shape",
        unit: "",
        kind: Kind::Choice(&["box", "cylinder", "bowl"]),
        live: FIXED,
        about: "Shape of the container within its corners: a box, a round tank, or a bowl, which is a part of a hollow ball. Round ones are only felt by way of the fluid.",
        get: |s| Value::Text(container_word(s.container_form).into()),
        set: |s, v| {
            s.container_form = match v.text() {
                "cylinder" => ContainerForm::Cylinder,
                "bowl" => ContainerForm::Bowl,
                _ => ContainerForm::Box,
            };
            Ok(())
        },
    },
];

/// Of the first tool what is not its shape, and all the rest.
const OTHERS: &[Setting<Scene>] = &[
    number!(
        "tool.mass",
        "kg",
        1e-3..=100.0,
        LIVE,
        tool.mass,
        "Mass of the tool's body in the fluid (coupling momentum)."
    ),
    number!(
        "tool.collision_response",
        "",
        0.0..=1.0,
        LIVE,
        tool.collision_response,
        "C_R: share of the fluid's impulse that the body takes (coupling momentum)."
    ),
    vector!("tool.position", "m", -10.0..=10.0, FIXED, tool.position, "Where the tool starts."),
    number!(
        "tool.force_scale",
        "",
        0.0..=1000.0,
        LIVE,
        tool.force_scale,
        "Factor on the fluid's force before filter and gate: on flow and lift alike."
    ),
    number!(
        "tool.buoyancy_scale",
        "",
        0.0..=1000.0,
        LIVE,
        tool.buoyancy_scale,
        "Factor on the lift alone, times the one before (coupling local): 0 leaves the flow."
    ),
    number!(
        "tool.solid_stiffness",
        "N/m",
        0.0..=1e4,
        FIXED,
        tool.solids.stiffness_n_per_m,
        "How stiff ground, container and obstacles feel, where the tool counts as the ball round it; 0: not at all. Never gives a hand energy below (2000/s)·(b − solid_damping)/mapping.scale, with b the device's own damping."
    ),
    number!(
        "tool.solid_damping",
        "N·s/m",
        0.0..=100.0,
        FIXED,
        tool.solids.damping_n_s_per_m,
        "How much they slow the tool along their normal while it touches."
    ),
    number!(
        "gate.max_force",
        "N",
        0.0..=50.0,
        LIVE,
        gate.max_force_n,
        "Largest force that leaves. While a session runs it may only be lowered below the scene's; likewise the next three."
    ),
    number!("gate.max_torque", "N·m", 0.0..=5.0, LIVE, gate.max_torque_nm, "Largest torque that leaves."),
    number!("gate.max_slew", "N/s", 1.0..=1e6, LIVE, gate.max_slew_n_per_s, "Fastest change of the force."),
    number!(
        "gate.max_torque_slew",
        "N·m/s",
        0.01..=1e5,
        LIVE,
        gate.max_torque_slew_nm_per_s,
        "Fastest change of the torque."
    ),
    number!(
        "gate.ramp_in",
        "s",
        0.0..=10.0,
        LIVE,
        gate.ramp_in_s,
        "Time in which the force comes up at a start or after a fault."
    ),
    number!(
        "gate.stale_hold",
        "frames",
        1.0..=1000.0,
        LIVE,
        gate.stale_hold_frames,
        "Age of the fluid's data above which the force fades."
    ),
    number!("gate.stale_fade", "s", 0.0..=10.0, LIVE, gate.stale_fade_s, "Time in which it fades."),
    number!(
        "mapping.scale",
        "",
        1e-3..=1000.0,
        FIXED,
        mapping.scale,
        "Scene metres a device metre; the hand feels every impedance that many times."
    ),
    Setting {
        path: "mapping.axes",
        unit: "",
        kind: Kind::Text,
        live: FIXED,
        about: "Scene axes in device axes, such as \"x y z\" or \"-z y x\"; right-handed.",
        get: |s| Value::Text(s.mapping.axes.clone()),
        set: |s, v| {
            s.mapping.axes = v.text().to_string();
            Ok(())
        },
    },
    vector!(
        "mapping.offset",
        "m",
        -10.0..=10.0,
        FIXED,
        mapping.offset,
        "Where the device's origin is in the scene."
    ),
    number!(
        "mapping.rim_radius",
        "m",
        0.0..=10.0,
        FIXED,
        mapping.rim_radius,
        "Radius of the device's workspace, behind which a soft rim pushes back; at 0 a Falcon has its own shape, others have none."
    ),
    number!(
        "mapping.rim_stiffness",
        "N/m",
        0.0..=2000.0,
        FIXED,
        mapping.rim_stiffness,
        "Stiffness of the rim."
    ),
    Setting {
        path: "mapping.clutch_button",
        unit: "",
        kind: Kind::Integer { min: 0.0, max: 32.0 },
        live: FIXED,
        about: "Button that lets the hand move without the tool and its force, from 1; 0 is none.",
        get: |s| Value::Number(s.mapping.clutch_button.into()),
        set: |s, v| {
            s.mapping.clutch_button = v.number() as u32;
            Ok(())
        },
    },
    number!(
        "mapping.carried_mass",
        "kg",
        0.0..=1.0,
        FIXED,
        mapping.carried_mass,
        "Mass of the device's grip, whose weight is taken off the hand, within the gate's limits; a Falcon's is about 0.12."
    ),
    text!(
        "falcon.firmware",
        falcon.firmware,
        "Firmware image to load into a Falcon that has none yet; \"\" is none."
    ),
    text!(
        "falcon.geometry",
        falcon.geometry,
        "Its lengths and strengths: libnifalcon, martin, or a parameter file."
    ),
    text!(
        "falcon.serial",
        falcon.serial,
        "Its serial number, where there are several; \"\" takes the first."
    ),
    number!(
        "hand.device_mass",
        "kg",
        1e-3..=100.0,
        FIXED,
        hand.device_mass_kg,
        "Mass of the simulated device."
    ),
    number!(
        "hand.device_damping",
        "N·s/m",
        0.0..=1000.0,
        FIXED,
        hand.device_damping_n_s_per_m,
        "Damping of the simulated device."
    ),
    number!(
        "hand.device_friction",
        "N",
        0.0..=5.0,
        FIXED,
        hand.device_friction_n,
        "Dry friction of the simulated device."
    ),
    number!(
        "hand.transport_delay",
        "s",
        0.0..=0.05,
        FIXED,
        hand.transport_delay_s,
        "Time from the writing of a force until it acts; 1 to 3 ms by USB."
    ),
    number!("hand.mass", "kg", 0.0..=100.0, FIXED, hand.hand_mass_kg, "Mass of the simulated hand."),
    number!(
        "hand.damping",
        "N·s/m",
        0.0..=1000.0,
        FIXED,
        hand.hand_damping_n_s_per_m,
        "Damping of its grip."
    ),
    number!("hand.stiffness", "N/m", 0.0..=1e5, FIXED, hand.hand_stiffness_n_per_m, "Stiffness of its grip."),
    number!(
        "hand.encoder_step",
        "m",
        0.0..=0.01,
        FIXED,
        hand.encoder_step_m,
        "Step of the simulated device's encoders; 0 is exact."
    ),
    number!(
        "hand.velocity_cutoff",
        "Hz",
        1.0..=400.0,
        FIXED,
        hand.velocity_cutoff_hz,
        "Cutoff of its velocity estimate."
    ),
];

/// Settings of a source, addressed as `source.NAME.…`.
pub const SOURCE_SETTINGS: &[Setting<Source>] = &[
    vector!("position", "m", -10.0..=10.0, LIVE, position, "Centre of the outlet."),
    vector!("direction", "", -10.0..=10.0, LIVE, direction, "Direction of the jet."),
    number!("diameter", "m", 0.0..=1.0, LIVE, diameter, "Diameter of the outlet: the thesis's source size."),
    number!("speed", "m/s", 0.0..=20.0, LIVE, speed, "Speed at the outlet."),
    flag!("on", on, "Whether it runs."),
    number!("period", "s", 0.0..=1000.0, LIVE, period, "Period of an intermittent jet; 0 runs steadily."),
    number!("duty", "", 0.0..=1.0, LIVE, duty, "Share of the period in which it runs."),
];

/// Every setting as a table in Markdown: path, default, what it may be, whether it is live, what it does.
pub fn table() -> String {
    let mut text =
        String::from("| setting | default | allowed | live | what it does |\n|---|---|---|---|---|\n");
    let scene = Scene::default();
    for setting in SETTINGS {
        text += &row(setting, &scene, setting.path);
    }
    for setting in SOURCE_SETTINGS {
        text += &row(setting, &Source::default(), &format!("source.NAME.{}", setting.path));
    }
    for setting in OBSTACLE_SETTINGS {
        text += &row(setting, &Obstacle::default(), &format!("obstacle.NAME.{}", setting.path));
    }
    for setting in BODY_SETTINGS {
        text += &row(setting, &FreeBody::default(), &format!("body.NAME.{}", setting.path));
    }
    text
}

fn row<T>(setting: &Setting<T>, owner: &T, path: &str) -> String {
    let live = if setting.live { "yes" } else { "no" };
    let (value, allowed) = (setting.get(owner), setting.allowed());
    format!("| {path} | {value} | {allowed} | {live} | {} |\n", setting.about.replace('|', "\\|"))
}

fn liquid_name(liquid: Liquid) -> &'static str {
    match liquid {
        Liquid::Water => "water",
        Liquid::Oil => "oil",
        Liquid::Glycerine => "glycerine",
        Liquid::Honey => "honey",
    }
}

/// Whether the setting says others in other words. In a table of a scene file and in a change these are taken first,
/// so that the others are set over them; where settings come one by one the last wins.
pub fn is_shorthand(path: &str) -> bool {
    ["fluid.liquid", "fluid.rest_particles"].contains(&path)
}

/// How a scene calls this shape of its container.
pub(crate) const fn container_word(form: ContainerForm) -> &'static str {
    match form {
        ContainerForm::Box => "box",
        ContainerForm::Cylinder => "cylinder",
        ContainerForm::Bowl => "bowl",
    }
}

fn set_filter(scene: &mut Scene, value: &Value) -> Result<(), String> {
    scene.run.filter = match value.text() {
        "auto" => None,
        spec => Some(spec.parse::<FilterSpec>().map_err(|e| format!("a filter: {e}"))?),
    };
    Ok(())
}

/// What has a shape.
trait Formed {
    fn form(&self) -> &Form;
    fn form_mut(&mut self) -> &mut Form;
}

macro_rules! formed {
    ($thing:ty, $($field:ident).+) => {
        impl Formed for $thing {
            fn form(&self) -> &Form {
                &self.$($field).+
            }

            fn form_mut(&mut self) -> &mut Form {
                &mut self.$($field).+
            }
        }
    };
}

formed!(Scene, tool.form);
formed!(ToolSettings, form);
formed!(Obstacle, form);
formed!(FreeBody, form);

/// Paths of the settings of a shape, and of the first tool's.
const FORM: [&str; 7] = ["shape", "radius", "thickness", "length", "size", "file", "scale"];
const FIRST_TOOL_FORM: [&str; 7] =
    ["tool.shape", "tool.radius", "tool.thickness", "tool.length", "tool.size", "tool.file", "tool.scale"];

/// Settings of the shape of a `T`, at these paths.
const fn form_settings<T: Formed>(paths: [&'static str; 7]) -> [Setting<T>; 7] {
    macro_rules! length {
        ($at:literal, $field:ident, $max:literal, $about:literal) => {
            Setting {
                path: paths[$at],
                unit: "m",
                kind: Kind::Number { min: 1e-3, max: $max },
                live: LIVE,
                about: $about,
                get: |t: &T| Value::Number(t.form().$field),
                set: |t: &mut T, v| {
                    t.form_mut().$field = v.number();
                    Ok(())
                },
            }
        };
    }
    [
        Setting {
            path: paths[0],
            unit: "",
            kind: Kind::Choice(&["sphere", "disc", "cylinder", "capsule", "box", "mesh"]),
            live: FIXED,
            about: "Its shape. A disc lies flat, its axis up; it is a cylinder by another name, of a `thickness`.",
            get: |t: &T| Value::Text(kind_word(t.form().kind).into()),
            set: set_kind::<T>,
        },
        length!(1, radius, 0.5, "Radius of a sphere, disc, cylinder or capsule."),
        length!(2, thickness, 0.5, "Thickness of a disc."),
        length!(3, length, 1.0, "Length of a cylinder; of a capsule, between the middles of its round ends."),
        Setting {
            path: paths[4],
            unit: "m",
            kind: Kind::Vector { min: 1e-3, max: 1.0 },
            live: LIVE,
            about: "Edges of a box.",
            get: |t: &T| Value::Vector(t.form().size),
            set: |t: &mut T, v| {
                t.form_mut().size = v.vector();
                Ok(())
            },
        },
        Setting {
            path: paths[5],
            unit: "",
            kind: Kind::Text,
            live: FIXED,
            about: "Closed mesh: a Wavefront OBJ or STL file, where a scene file names it beside that; or \"cup\", which is shipped. Its centre of volume is the body's origin.",
            get: |t: &T| Value::Text(t.form().file().into()),
            set: |t: &mut T, v| t.form_mut().set_file(v.text()),
        },
        Setting {
            path: paths[6],
            unit: "m",
            kind: Kind::Number { min: 1e-6, max: 1000.0 },
            live: FIXED,
            about: "Metres a unit of that file: 0.001 for one in millimetres.",
            get: |t: &T| Value::Number(t.form().scale()),
            set: |t: &mut T, v| {
                t.form_mut().set_scale(v.number());
                Ok(())
            },
        },
    ]
}

const fn kind_word(kind: FormKind) -> &'static str {
    match kind {
        FormKind::Sphere => "sphere",
        FormKind::Disc => "disc",
        FormKind::Cylinder => "cylinder",
        FormKind::Capsule => "capsule",
        FormKind::Box => "box",
        FormKind::Mesh => "mesh",
    }
}

fn set_kind<T: Formed>(thing: &mut T, value: &Value) -> Result<(), String> {
    let known = FormKind::ALL.into_iter().find(|kind| kind_word(*kind) == value.text());
    thing.form_mut().kind = known.ok_or_else(|| value.text().to_string())?;
    Ok(())
}

/// The settings of several tables in one.
const fn joined<T, const N: usize>(tables: &[&[Setting<T>]]) -> [Setting<T>; N] {
    let mut all = [tables[0][0]; N];
    let (mut table, mut at) = (0, 0);
    while table < tables.len() {
        let mut k = 0;
        while k < tables[table].len() {
            all[at] = tables[table][k];
            (at, k) = (at + 1, k + 1);
        }
        table += 1;
    }
    all
}

/// Settings of any tool but the first, addressed as `tool.NAME.…`.
pub const TOOL_SETTINGS: &[Setting<ToolSettings>] =
    &joined::<_, { FORM.len() + TOOL_OTHERS.len() }>(&[&form_settings(FORM), TOOL_OTHERS]);

const TOOL_OTHERS: &[Setting<ToolSettings>] = &[
    number!(
        "mass",
        "kg",
        1e-3..=100.0,
        LIVE,
        mass,
        "Mass of the tool's body in the fluid (coupling momentum)."
    ),
    number!(
        "collision_response",
        "",
        0.0..=1.0,
        LIVE,
        collision_response,
        "C_R: share of the fluid's impulse that the body takes (coupling momentum)."
    ),
    vector!("position", "m", -10.0..=10.0, FIXED, position, "Where the tool starts."),
    number!(
        "force_scale",
        "",
        0.0..=1000.0,
        LIVE,
        force_scale,
        "Factor on the fluid's force before filter and gate: on flow and lift alike."
    ),
    number!(
        "buoyancy_scale",
        "",
        0.0..=1000.0,
        LIVE,
        buoyancy_scale,
        "Factor on the lift alone, times the one before (coupling local): 0 leaves the flow."
    ),
    number!(
        "solid_stiffness",
        "N/m",
        0.0..=1e4,
        FIXED,
        solids.stiffness_n_per_m,
        "How stiff ground, container and obstacles feel, where the tool counts as the ball round it; 0: not at all. Never gives a hand energy below (2000/s)·(b − solid_damping)/mapping.scale, with b the device's own damping."
    ),
    number!(
        "solid_damping",
        "N·s/m",
        0.0..=100.0,
        FIXED,
        solids.damping_n_s_per_m,
        "How much they slow the tool along their normal while it touches."
    ),
];

/// Settings of an obstacle, addressed as `obstacle.NAME.…`.
pub const OBSTACLE_SETTINGS: &[Setting<Obstacle>] =
    &joined::<_, { FORM.len() + OBSTACLE_OTHERS.len() }>(&[&form_settings(FORM), OBSTACLE_OTHERS]);

const OBSTACLE_OTHERS: &[Setting<Obstacle>] =
    &[vector!("position", "m", -10.0..=10.0, LIVE, position, "Where it is, until the host moves it.")];

/// Settings of a free body, addressed as `body.NAME.…`.
pub const BODY_SETTINGS: &[Setting<FreeBody>] =
    &joined::<_, { FORM.len() + BODY_OTHERS.len() }>(&[&form_settings(FORM), BODY_OTHERS]);

const BODY_OTHERS: &[Setting<FreeBody>] = &[
    number!("density", "kg/m³", 1.0..=1e5, LIVE, density, "Its mean density; water has 1000."),
    vector!("position", "m", -10.0..=10.0, FIXED, position, "Where it starts."),
];

/// Sets `path` before a session starts.
///
/// # Errors
/// An unknown path, or a value that does not fit.
pub fn set(scene: &mut Scene, path: &str, value: &Value) -> Result<(), SceneError> {
    put(scene, path, value, false)
}

/// Sets `path` as a running session may: only what is live.
///
/// # Errors
/// An unknown path, one that is not live, or a value that does not fit.
pub fn set_live(scene: &mut Scene, path: &str, value: &Value) -> Result<(), SceneError> {
    put(scene, path, value, true)
}

fn put(scene: &mut Scene, path: &str, value: &Value, running: bool) -> Result<(), SceneError> {
    if let Some((k, setting)) = find(&scene.sources, path) {
        return setting.put(&mut scene.sources[k], path, value, running);
    }
    if let Some((k, setting)) = find(&scene.obstacles, path) {
        return setting.put(&mut scene.obstacles[k], path, value, running);
    }
    if let Some((k, setting)) = find(&scene.bodies, path) {
        return setting.put(&mut scene.bodies[k], path, value, running);
    }
    if let Some((k, setting)) = find(&scene.more_tools, path) {
        return setting.put(&mut scene.more_tools[k], path, value, running);
    }
    let setting = SETTINGS.iter().find(|s| s.path == path).ok_or_else(|| unknown(scene, path))?;
    setting.put(scene, path, value, running)
}

/// The value at `path`.
///
/// # Errors
/// An unknown path.
pub fn get(scene: &Scene, path: &str) -> Result<Value, SceneError> {
    if let Some((k, setting)) = find(&scene.sources, path) {
        return Ok(setting.get(&scene.sources[k]));
    }
    if let Some((k, setting)) = find(&scene.obstacles, path) {
        return Ok(setting.get(&scene.obstacles[k]));
    }
    if let Some((k, setting)) = find(&scene.bodies, path) {
        return Ok(setting.get(&scene.bodies[k]));
    }
    if let Some((k, setting)) = find(&scene.more_tools, path) {
        return Ok(setting.get(&scene.more_tools[k]));
    }
    let setting = SETTINGS.iter().find(|s| s.path == path).ok_or_else(|| unknown(scene, path))?;
    Ok(setting.get(scene))
}

/// What a scene may hold several of, each addressed by its name: `KIND.NAME.field`.
pub(crate) trait Named: Default + 'static {
    /// First part of the path, and the name of the table in a scene file.
    const KIND: &'static str;
    /// Its settings.
    const TABLE: &'static [Setting<Self>];
    /// Its name.
    fn name(&self) -> &str;
    /// Gives it another name.
    fn rename(&mut self, name: String);
}

macro_rules! named {
    ($thing:ty, $kind:literal, $table:ident) => {
        impl Named for $thing {
            const KIND: &'static str = $kind;
            const TABLE: &'static [Setting<Self>] = $table;

            fn name(&self) -> &str {
                &self.name
            }

            fn rename(&mut self, name: String) {
                self.name = name;
            }
        }
    };
}

named!(Source, "source", SOURCE_SETTINGS);
named!(Obstacle, "obstacle", OBSTACLE_SETTINGS);
named!(FreeBody, "body", BODY_SETTINGS);
// In a path these are the tools but the first, whose settings are in the scene's own table.
named!(ToolSettings, "tool", TOOL_SETTINGS);

/// Which of `things` and which of its settings `path` means, if any.
fn find<T: Named>(things: &[T], path: &str) -> Option<(usize, &'static Setting<T>)> {
    let (name, field) = path.strip_prefix(T::KIND)?.strip_prefix('.')?.rsplit_once('.')?;
    let thing = things.iter().position(|t| t.name() == name)?;
    Some((thing, T::TABLE.iter().find(|s| s.path == field)?))
}

/// Every path of `things`.
fn paths<T: Named>(things: &[T]) -> impl Iterator<Item = String> {
    things.iter().flat_map(|t| T::TABLE.iter().map(move |s| format!("{}.{}.{}", T::KIND, t.name(), s.path)))
}

fn unknown(scene: &Scene, path: &str) -> SceneError {
    let all = SETTINGS.iter().map(|s| s.path.to_string()).chain(paths(&scene.sources));
    let all = all.chain(paths(&scene.obstacles)).chain(paths(&scene.bodies)).chain(paths(&scene.more_tools));
    let hint = match nearest(all, path) {
        Some(known) => format!("; did you mean {known}?"),
        None => "; `hapflow scenes --settings` lists them all".into(),
    };
    SceneError::UnknownSetting { path: path.into(), hint }
}

/// The one of `words` that is meant by `word`, if one is near enough.
pub fn nearest(words: impl Iterator<Item = String>, word: &str) -> Option<String> {
    let nearest = words.min_by_key(|known| distance(known, word))?;
    (distance(&nearest, word) <= 1 + word.len() / 3).then_some(nearest)
}

/// Edits between two words (Levenshtein).
pub(crate) fn distance(a: &str, b: &str) -> usize {
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, x) in a.bytes().enumerate() {
        let mut corner = row[0];
        row[0] = i + 1;
        for (j, y) in b.bytes().enumerate() {
            let replaced = corner + usize::from(x != y);
            corner = row[j + 1];
            row[j + 1] = replaced.min(corner + 1).min(row[j] + 1);
        }
    }
    row[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_setting_takes_its_own_default_back() {
        let scene = Scene::default();
        for setting in SETTINGS {
            let mut copy = scene.clone();
            set(&mut copy, setting.path, &setting.get(&scene)).unwrap_or_else(|e| panic!("{e}"));
            if !is_shorthand(setting.path) {
                assert_eq!(copy, scene, "{}", setting.path);
            }
        }
    }

    #[test]
    fn a_bad_value_is_named_with_its_range() {
        let mut scene = Scene::default();
        let text = set(&mut scene, "fluid.viscosity", &Value::Number(-1.0)).unwrap_err().to_string();
        assert_eq!(text, "fluid.viscosity = -1: must be a number from 0 to 10000 Pa·s");
        assert!(set(&mut scene, "fluid.viscosity", &Value::Number(f64::NAN)).is_err());
        let text = set(&mut scene, "fluid.solver", &Value::Text("sph".into())).unwrap_err().to_string();
        assert_eq!(text, "fluid.solver = \"sph\": must be one of wcsph, dfsph, muller");
        assert!(set(&mut scene, "run.filter", &Value::Text("hann:0".into())).is_err());
        assert_eq!(scene, Scene::default());
    }

    #[test]
    fn an_unknown_path_gets_the_nearest() {
        let text = set(&mut Scene::default(), "fluid.viscosty", &Value::Number(1.0)).unwrap_err().to_string();
        assert_eq!(text, "no setting \"fluid.viscosty\"; did you mean fluid.viscosity?");
    }

    #[test]
    fn what_is_fixed_stays_while_running() {
        let mut scene = Scene::default();
        assert!(matches!(
            set_live(&mut scene, "run.fluid_hz", &Value::Number(60.0)),
            Err(SceneError::NotLive(_))
        ));
        assert!(set_live(&mut scene, "fluid.viscosity", &Value::Number(1.0)).is_ok());
    }

    /// One by one, as on a command line, the last wins; the liquid is known by its values.
    #[test]
    fn a_liquid_sets_its_values_and_is_read_from_them() {
        let mut scene = Scene::default();
        let word = |text: &str| Value::Text(text.into());
        let liquid = |scene: &Scene| get(scene, "fluid.liquid").unwrap();
        assert_eq!(liquid(&scene), word("custom"));
        set(&mut scene, "fluid.viscosity", &Value::Number(5.0)).unwrap();
        set(&mut scene, "fluid.liquid", &word("glycerine")).unwrap();
        assert_eq!((scene.fluid.viscosity, scene.fluid.surface_tension), (1.41, 0.0634));
        assert_eq!(liquid(&scene), word("glycerine"));
        set(&mut scene, "fluid.viscosity", &Value::Number(5.0)).unwrap();
        assert_eq!((liquid(&scene), scene.fluid.rest_density), (word("custom"), 1261.0));
        set_live(&mut scene, "fluid.liquid", &word("custom")).unwrap();
        assert_eq!(scene.fluid.viscosity, 5.0);
        let text = set(&mut scene, "fluid.liquid", &word("milk")).unwrap_err().to_string();
        assert_eq!(text, "fluid.liquid = \"milk\": must be one of custom, water, oil, glycerine, honey");
    }
}
