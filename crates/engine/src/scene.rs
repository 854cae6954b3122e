//! A scene: everything that a session is made of, as plain data.

use crate::force_limit::ForceLimit;
use crate::form::Form;
use crate::{SceneError, Value, settings};
use glam::DVec3;
use hapflow_devices::falcon::{FREE_DISCS, FalconOptions, Geometry};
use hapflow_devices::{DeviceInfo, HandPreset, HandSettings, Segment};
use hapflow_fluid::{
    Aabb, BodyConfig, Container, ContainerForm, FluidConfig, FluidSettings, MIN_MASS_RATIO, Source, World,
};
use hapflow_haptics::{
    Clutch, CouplingKind, FilterSpec, GateSettings, Mapping, Rim, SolidFeel, ToolState, Workspace,
};

/// Who computes the fluid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BackendKind {
    /// Particles on the CPU.
    Cpu,
    /// Jets in closed form.
    AnalyticJet,
}

/// Which device moves the tool.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DeviceKind {
    /// A simulated hand on a simulated device, after the scene's script.
    Hand,
    /// A recorded motion.
    Replay,
    /// One that stays where it is.
    Null,
    /// A Novint Falcon at this machine's USB.
    Falcon,
    /// A Falcon that is emulated down to USB transfers, in a hand that does as the scene's script says.
    EmulatedFalcon,
    /// A device of Force Dimension, by its maker's library.
    ForceDimension,
    /// A device of 3D Systems, by its maker's library.
    Touch,
    /// A SpaceMouse of 3Dconnexion.
    SpaceMouse,
}

/// Which Falcon, and how.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FalconSettings {
    /// Firmware image to load if none runs; empty: none.
    pub firmware: String,
    /// Lengths and strengths: a shipped set or a file.
    pub geometry: String,
    /// Serial number; empty takes the first.
    pub serial: String,
}

/// Where the origin of a recorded motion is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MotionOrigin {
    /// Where the tool starts; its axes are the device's.
    Tool,
    /// The scene's, with its axes, as in a recording.
    Scene,
}

/// How a scene is run.
#[derive(Clone, Debug, PartialEq)]
pub struct RunSettings {
    /// Simulated time, s.
    pub duration: f64,
    /// Fluid frames a second, Hz.
    pub fluid_hz: f64,
    /// On the virtual clock: time from the end of a frame's tool path until its model is published, in frames.
    pub fluid_delay: f64,
    /// How the tool meets the fluid.
    pub coupling: CouplingKind,
    /// What smooths the force; none takes the coupling's own.
    pub filter: Option<FilterSpec>,
    /// Who computes the fluid.
    pub backend: BackendKind,
    /// Which device moves the tool.
    pub device: DeviceKind,
    /// Motion of the replay device: a shipped name or a CSV file.
    pub motion: String,
    /// Where its origin is.
    pub motion_origin: MotionOrigin,
}

/// What a scene takes of plugins, by name, in place of what [`RunSettings`] has; none where the name is empty.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PluginSettings {
    /// Who computes the fluid.
    pub backend: String,
    /// How the tool meets it.
    pub coupling: String,
    /// Which device moves the tool.
    pub device: String,
}

/// Most tools in a scene.
pub const MAX_TOOLS: usize = 8;

/// A tool in a hand.
#[derive(Clone, Debug, PartialEq)]
pub struct ToolSettings {
    /// Name by which settings address it; the first tool needs none.
    pub name: String,
    /// Its shape.
    pub form: Form,
    /// Mass of its body in the fluid (coupling `momentum`), kg.
    pub mass: f64,
    /// Collision response coefficient C_R (coupling `momentum`), 0..1.
    pub collision_response: f64,
    /// Where it starts, m.
    pub position: DVec3,
    /// Factor on the fluid's force before filter and gate.
    pub force_scale: f64,
    /// Factor on the lift, beside that one (coupling `local`).
    pub buoyancy_scale: f64,
    /// How the scene's solids feel; not at all with a stiffness of 0.
    pub solids: SolidFeel,
}

/// Most obstacles in a scene.
pub const MAX_OBSTACLES: usize = 32;

/// Something solid that stands in the fluid, or that the host moves.
#[derive(Clone, Debug, PartialEq)]
pub struct Obstacle {
    /// Name by which settings address it.
    pub name: String,
    /// Its shape.
    pub form: Form,
    /// Where it is, m, until the host moves it.
    pub position: DVec3,
}

impl Default for Obstacle {
    /// A ball of 20 mm radius in the origin.
    fn default() -> Self {
        Self { name: "0".into(), form: Form::ball(0.02), position: DVec3::ZERO }
    }
}

/// Most free bodies in a scene.
pub const MAX_BODIES: usize = 32;

/// A rigid body that goes where fluid and gravity take it. Walls, obstacles, tools and other bodies stop it.
#[derive(Clone, Debug, PartialEq)]
pub struct FreeBody {
    /// Name by which settings address it.
    pub name: String,
    /// Its shape.
    pub form: Form,
    /// Its mean density, kg/m³.
    pub density: f64,
    /// Where it starts, m.
    pub position: DVec3,
}

impl Default for FreeBody {
    /// A ball of 20 mm radius in the origin, half as dense as water.
    fn default() -> Self {
        Self { name: "0".into(), form: Form::ball(0.02), density: 500.0, position: DVec3::ZERO }
    }
}

impl Default for ToolSettings {
    /// A ball of 15 mm radius and 0.1 kg in the origin.
    fn default() -> Self {
        Self {
            name: "0".into(),
            form: Form::ball(0.015),
            mass: 0.1,
            collision_response: 0.2,
            position: DVec3::ZERO,
            force_scale: 1.0,
            buoyancy_scale: 1.0,
            solids: SolidFeel { stiffness_n_per_m: 0.0, damping_n_s_per_m: 0.0 },
        }
    }
}

/// From device to scene.
#[derive(Clone, Debug, PartialEq)]
pub struct MappingSettings {
    /// Scene metres a device metre.
    pub scale: f64,
    /// Scene axes in device axes, such as "x y z".
    pub axes: String,
    /// Device origin in the scene, m.
    pub offset: DVec3,
    /// Radius of the device's workspace, beyond which a soft rim pushes back, m; 0 has none.
    pub rim_radius: f64,
    /// Stiffness of the rim, N/m.
    pub rim_stiffness: f64,
    /// Button of the clutch, from 1; 0 is none.
    pub clutch_button: u32,
    /// Mass of the device's grip whose weight is taken off the hand, kg.
    pub carried_mass: f64,
}

/// New values for some settings at a time.
#[derive(Clone, Debug, PartialEq)]
pub struct Change {
    /// Simulated time, s.
    pub at_s: f64,
    /// Paths and values.
    pub settings: Vec<(String, Value)>,
}

impl Change {
    /// The `settings` (paths and values) from `at_s` seconds on: shorthands first ([`settings::is_shorthand`]), then in
    /// the order of their paths, of two for one the last.
    pub fn new(at_s: f64, mut settings: Vec<(String, Value)>) -> Self {
        settings.reverse();
        settings.sort_by_cached_key(|(path, _)| (!settings::is_shorthand(path), path.clone()));
        settings.dedup_by(|later, kept| later.0 == kept.0);
        Self { at_s, settings }
    }
}

/// Everything that a session is made of.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// Its name.
    pub name: String,
    /// One line on what it shows.
    pub about: String,
    /// How it is run.
    pub run: RunSettings,
    /// What plugins bring.
    pub plugin: PluginSettings,
    /// Settings of the fluid.
    pub fluid: FluidSettings,
    /// Particles that leave it vanish.
    pub bounds: Aabb,
    /// Axes (x, y, z) along which they come in again on the other side.
    pub periodic: [bool; 3],
    /// Height of the ground, if there is one, m.
    pub ground: Option<f64>,
    /// Inner corners of what holds the fluid, open above.
    pub container: Option<Aabb>,
    /// Its shape within them.
    pub container_form: ContainerForm,
    /// Jets.
    pub sources: Vec<Source>,
    /// Boxes in which particles vanish.
    pub sinks: Vec<Aabb>,
    /// Boxes filled with fluid at the start.
    pub pools: Vec<Aabb>,
    /// What else is solid.
    pub obstacles: Vec<Obstacle>,
    /// What floats or sinks.
    pub bodies: Vec<FreeBody>,
    /// The first tool.
    pub tool: ToolSettings,
    /// The others, each for a hand of its own.
    pub more_tools: Vec<ToolSettings>,
    /// The safety gate.
    pub gate: GateSettings,
    /// From device to scene.
    pub mapping: MappingSettings,
    /// The Falcon.
    pub falcon: FalconSettings,
    /// The simulated hand.
    pub hand: HandSettings,
    /// What it does, in scene coordinates.
    pub script: Vec<Segment>,
    /// What changes while it runs, in order of time.
    pub changes: Vec<Change>,
}

impl Default for Scene {
    fn default() -> Self {
        Self {
            name: "scene".into(),
            about: String::new(),
            run: RunSettings {
                duration: 5.0,
                fluid_hz: 100.0,
                fluid_delay: 1.0,
                coupling: CouplingKind::Local,
                filter: None,
                backend: BackendKind::Cpu,
                device: DeviceKind::Hand,
                motion: "tremor".into(),
                motion_origin: MotionOrigin::Tool,
            },
            plugin: PluginSettings::default(),
            fluid: FluidSettings::default(),
            bounds: Aabb { min: DVec3::splat(-0.5), max: DVec3::splat(0.5) },
            periodic: [false; 3],
            ground: None,
            container: None,
            container_form: ContainerForm::Box,
            sources: Vec::new(),
            sinks: Vec::new(),
            pools: Vec::new(),
            obstacles: Vec::new(),
            bodies: Vec::new(),
            tool: ToolSettings::default(),
            more_tools: Vec::new(),
            gate: GateSettings::default(),
            mapping: MappingSettings {
                scale: 1.0,
                axes: "x y z".into(),
                offset: DVec3::ZERO,
                rim_radius: 0.0,
                rim_stiffness: Rim::DEFAULT_STIFFNESS_N_PER_M,
                clutch_button: 0,
                carried_mass: 0.0,
            },
            falcon: FalconSettings { geometry: Geometry::NAMES[0].into(), ..FalconSettings::default() },
            hand: HandSettings::preset(HandPreset::Normal),
            script: Vec::new(),
            changes: Vec::new(),
        }
    }
}

impl Scene {
    /// All tools, the first first.
    pub fn tools(&self) -> impl Iterator<Item = &ToolSettings> {
        std::iter::once(&self.tool).chain(&self.more_tools)
    }

    /// What the fluid's backend needs to know.
    pub fn fluid_config(&self, threads: usize) -> FluidConfig {
        let tools = self.tools().map(tool_body);
        let solids = tools.chain(self.obstacles.iter().map(obstacle_body));
        FluidConfig {
            settings: self.fluid.clone(),
            world: World {
                bounds: self.bounds,
                ground: self.ground,
                container: self.container.map(|inner| Container { inner, form: self.container_form }),
                sources: self.sources.clone(),
                sinks: self.sinks.clone(),
                pools: self.pools.clone(),
                bodies: solids.chain(self.bodies.iter().map(free_body)).collect(),
                periodic: self.periodic,
                ..World::default()
            },
            frame_hz: self.run.fluid_hz,
            threads,
        }
    }

    /// The coupling as all but itself know it: of a plugin comes a wrench wherever the hand is, as of `direct`.
    pub(crate) fn coupling(&self) -> CouplingKind {
        if self.plugin.coupling.is_empty() { self.run.coupling } else { CouplingKind::Direct }
    }

    /// The filter in use: the scene's, or the coupling's own. The thesis's baseline has its eleven fluid
    /// frames; `direct` smooths each frame's step over one frame, which cancels the frame rate.
    pub fn filter(&self) -> FilterSpec {
        use hapflow_haptics::{TapPlace, WindowKind};
        self.run.filter.unwrap_or(match self.coupling() {
            CouplingKind::Momentum => {
                FilterSpec::Window { kind: WindowKind::BartlettHann, taps: 11, place: TapPlace::Fluid }
            }
            // It has no steps to smooth.
            CouplingKind::Local => FilterSpec::None,
            CouplingKind::Direct => {
                let taps = (1000.0 / self.run.fluid_hz).round().max(1.0) as usize;
                FilterSpec::Window { kind: WindowKind::Boxcar, taps, place: TapPlace::Servo }
            }
        })
    }

    /// Whether a person may hold its device, which then runs in real time only.
    pub fn in_a_hand(&self) -> bool {
        self.device_info().hardware || !self.plugin.device.is_empty()
    }

    /// What is known of the device that `run.device` asks for.
    pub fn device_info(&self) -> DeviceInfo {
        match self.run.device {
            DeviceKind::Hand => hapflow_devices::HAND,
            DeviceKind::Replay => hapflow_devices::REPLAY,
            DeviceKind::Null => hapflow_devices::NULL,
            DeviceKind::Falcon => hapflow_devices::FALCON,
            DeviceKind::EmulatedFalcon => hapflow_devices::EMULATED_FALCON,
            DeviceKind::ForceDimension => hapflow_devices::FORCE_DIMENSION,
            DeviceKind::Touch => hapflow_devices::TOUCH,
            DeviceKind::SpaceMouse => hapflow_devices::SPACE_MOUSE,
        }
    }

    /// The mapping in use.
    pub(crate) fn mapping(&self) -> Result<Mapping, SceneError> {
        let m = &self.mapping;
        let refused = |e: &dyn std::fmt::Display| SceneError::Refused(format!("mapping: {e}"));
        let axes = m.axes.parse().map_err(|e| refused(&e))?;
        let mapping = Mapping::new(m.scale, axes, m.offset).map_err(|e| refused(&e))?;
        let workspace = match self.run.device {
            _ if m.rim_radius > 0.0 => Workspace::Sphere { centre: DVec3::ZERO, radius: m.rim_radius },
            DeviceKind::Falcon | DeviceKind::EmulatedFalcon if self.plugin.device.is_empty() => {
                let start = mapping.device_state(ToolState::at(self.tool.position)).position;
                Workspace::Discs { centre: start - FalconOptions::MIDDLE, discs: &FREE_DISCS }
            }
            _ => return Ok(mapping),
        };
        let rim = Rim::new(workspace, m.rim_stiffness, Rim::DEFAULT_SOFT_M).map_err(|e| refused(&e))?;
        Ok(mapping.with_rim(rim))
    }

    /// Its clutch, if it has one.
    pub(crate) fn clutch(&self) -> Option<Clutch> {
        self.mapping.clutch_button.checked_sub(1).map(Clutch::new)
    }

    /// Refuses what cannot be run.
    ///
    /// # Errors
    /// The first thing that is wrong, with its field, value and range.
    pub fn check(&self) -> Result<(), SceneError> {
        self.check_forms()?;
        self.fluid_config(1).check()?;
        self.check_names()?;
        self.check_tool_mass()?;
        self.check_buoyancy()?;
        self.gate.check()?;
        self.hand.check()?;
        self.filter().check(1000.0)?;
        self.mapping()?;
        for (k, change) in self.changes.iter().enumerate() {
            self.check_change(k, change)?;
        }
        Ok(())
    }

    /// A mesh comes from a file.
    fn check_forms(&self) -> Result<(), SceneError> {
        let tools = self.tools().map(|t| ("tool", &t.name, &t.form));
        let forms = tools.chain(self.obstacles.iter().map(|o| ("obstacle", &o.name, &o.form)));
        let mut forms = forms.chain(self.bodies.iter().map(|b| ("body", &b.name, &b.form)));
        match forms.find(|(.., form)| !form.is_whole()) {
            None => Ok(()),
            Some((kind, name, _)) => Err(SceneError::BadValue {
                path: format!("{kind}.{name}.file"),
                value: "\"\"".into(),
                expected: "a file, as its shape is \"mesh\"".into(),
            }),
        }
    }

    /// Settings address sources and obstacles by name.
    fn check_names(&self) -> Result<(), SceneError> {
        for (kind, count, most) in [
            ("obstacles", self.obstacles.len(), MAX_OBSTACLES),
            ("bodies", self.bodies.len(), MAX_BODIES),
            ("tools", self.tools().count(), MAX_TOOLS),
        ] {
            if count > most {
                return Err(SceneError::Refused(format!("{count} {kind}: there may be {most}")));
            }
        }
        let tools: Vec<_> = self.tools().map(|t| t.name.as_str()).collect();
        let sources: Vec<_> = self.sources.iter().map(|s| s.name.as_str()).collect();
        let obstacles: Vec<_> = self.obstacles.iter().map(|o| o.name.as_str()).collect();
        let bodies: Vec<_> = self.bodies.iter().map(|b| b.name.as_str()).collect();
        for (kind, names) in [("tool", tools), ("source", sources), ("obstacle", obstacles), ("body", bodies)]
        {
            if let Some(name) =
                (1..names.len()).find_map(|k| names[..k].contains(&names[k]).then_some(names[k]))
            {
                return Err(SceneError::Refused(format!(
                    "{kind} name = \"{name}\": two of them; names must differ"
                )));
            }
        }
        Ok(())
    }

    /// A driven body that is too light would be thrown about.
    fn check_tool_mass(&self) -> Result<(), SceneError> {
        let least =
            |tool: &ToolSettings| MIN_MASS_RATIO * self.fluid.rest_density * tool.form.shape().volume();
        let light = self.tools().find(|tool| tool.mass < least(tool));
        match light.filter(|_| self.coupling() == CouplingKind::Momentum) {
            None => Ok(()),
            Some(tool) => Err(SceneError::BadValue {
                path: "tool.mass".into(),
                value: format!("{}", tool.mass),
                expected: format!("at least {:.3} kg for this tool with coupling momentum", least(tool)),
            }),
        }
    }

    /// Only a coupling that looks at the fluid knows what of the force is lift.
    fn check_buoyancy(&self) -> Result<(), SceneError> {
        let scaled = self.tools().find(|tool| tool.buoyancy_scale != 1.0);
        match scaled.filter(|_| self.run.coupling != CouplingKind::Local) {
            None => Ok(()),
            Some(tool) => Err(SceneError::BadValue {
                path: "tool.buoyancy_scale".into(),
                value: format!("{}", tool.buoyancy_scale),
                expected: format!(
                    "1 with coupling {}: only local tells lift from flow",
                    self.run.coupling.name()
                ),
            }),
        }
    }

    fn check_change(&self, k: usize, change: &Change) -> Result<(), SceneError> {
        let mut after = Self { changes: Vec::new(), ..self.clone() };
        for earlier in &self.changes[..=k] {
            for (path, value) in &earlier.settings {
                settings::set_live(&mut after, path, value)?;
            }
        }
        let checked = ForceLimit::new(self.gate).check(&after.gate).and_then(|()| after.check());
        checked.map_err(|e| SceneError::Refused(format!("change at {} s: {e}", change.at_s)))
    }
}

fn tool_body(tool: &ToolSettings) -> BodyConfig {
    BodyConfig {
        shape: tool.form.shape(),
        mass: tool.mass,
        collision_response: tool.collision_response,
        position: tool.position,
    }
}

fn free_body(body: &FreeBody) -> BodyConfig {
    let shape = body.form.shape();
    let mass = body.density * shape.volume();
    BodyConfig { shape, mass, collision_response: 1.0, position: body.position }
}

fn obstacle_body(obstacle: &Obstacle) -> BodyConfig {
    BodyConfig {
        shape: obstacle.form.shape(),
        // It is led: its mass plays no part.
        mass: 1.0,
        collision_response: 0.0,
        position: obstacle.position,
    }
}
