//! What a fluid is made of: settings that may change while it runs, and the world it stands in.

use crate::{Container, FluidError, Kernel, Shape, limits, solver};
use glam::DVec3;
use std::f64::consts::TAU;

/// How the fluid is solved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Solver {
    /// The thesis's model after Müller, Charypar & Gross 2003: poly6/spiky/viscosity kernels, p = k(ρ − ρ₀),
    /// contacts by impulses. The baseline.
    Muller,
    /// Weakly compressible SPH with a stiff state equation and density diffusion (δ-SPH), walls and bodies as
    /// analytic volumes.
    Wcsph,
    /// Divergence-free SPH: incompressible by iteration, with the walls and bodies of `wcsph`. Its sub-steps follow the
    /// flow and not a speed of sound.
    Dfsph,
}

/// Which particles act on which. It may be switched while the fluid runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum InteractionMode {
    /// Full SPH.
    Full,
    /// Gravity and contacts only: a thin spray or a waterfall, much cheaper.
    None,
    /// Particles act on each other in every other sub-step: cheaper, and softer.
    Mixed,
}

/// Settings of the fluid; all may change while it runs. Ranges are checked by [`FluidConfig::check`].
#[derive(Clone, Debug, PartialEq)]
pub struct FluidSettings {
    /// How the fluid is solved.
    pub solver: Solver,
    /// Which particles act on which.
    pub mode: InteractionMode,
    /// Rest particle spacing dx, m: a particle stands for ρ₀ dx³ of mass.
    pub spacing: f64,
    /// Kernel of `wcsph`; `muller` has three of its own, and `dfsph` takes Wendland's.
    pub kernel: Kernel,
    /// Kernel support in spacings; 0 takes the solver's own (2.7 for `wcsph` and `dfsph`, 2 for `muller`).
    pub support: f64,
    /// Rest density ρ₀, kg/m³.
    pub rest_density: f64,
    /// Dynamic viscosity μ, Pa·s.
    pub viscosity: f64,
    /// Surface tension σ, N/m; 0 leaves its passes out.
    pub surface_tension: f64,
    /// Stiffness k of `muller`, p = k(ρ − ρ₀), m²/s².
    pub stiffness: f64,
    /// Share of `muller`'s pressure below zero that is kept, 0..1: 1 is the thesis's p = k(ρ − ρ₀) as written,
    /// whose pull at a free surface tears a jet into hot clumps; 0 lets a free surface be free.
    pub cohesion: f64,
    /// Speed of sound of `wcsph`, m/s; 0 takes ten times the highest speed that the scene's drops and sources
    /// can give.
    pub sound_speed: f64,
    /// Density diffusion δ of `wcsph`, dimensionless.
    pub density_diffusion: f64,
    /// Artificial viscosity α, dimensionless. `wcsph`: against noise at the particle spacing it is as strong as a
    /// kinematic viscosity α c H/20, and it leaves smooth flow alone. `muller`, which boils without it: 1.6 times
    /// that, on all flow. See [`FluidConfig::effective_viscosity`].
    pub artificial_viscosity: f64,
    /// Particle shifting of `wcsph`: how fast particles spread to where there is room, a diffusivity in units of
    /// c dx; 0 leaves it out.
    pub shifting: f64,
    /// Acoustic damper ζ of `wcsph`, in units of c dx.
    pub acoustic_damping: f64,
    /// Pressure of `wcsph` that all is under, Pa, for a fluid without free surface: what is below it can pull.
    pub background_pressure: f64,
    /// Share of the compression by gravity and flow that the pressure of `dfsph` may leave unanswered.
    pub tolerance: f64,
    /// Most iterations of each solve of `dfsph` in a sub-step.
    pub max_iterations: usize,
    /// Rate at which velocities decay everywhere, 1/s.
    pub damping: f64,
    /// Largest distance that a particle may travel in one fluid frame, m; 0 sets no cap.
    pub max_displacement: f64,
    /// Age at which a particle vanishes, s; 0 keeps it for ever.
    pub lifetime: f64,
    /// Most particles at once; sources wait while it is reached.
    pub max_particles: usize,
    /// Acceleration of gravity, m/s².
    pub gravity: DVec3,
    /// Share of the normal velocity that a particle keeps in a contact by impulse, 0..1.
    pub restitution: f64,
    /// Two-way: fluid and bodies push each other. One-way: bodies push the fluid and feel nothing.
    pub two_way: bool,
    /// Most sub-steps in one fluid frame; settings that need more are refused.
    pub max_substeps: usize,
    /// Whether fluid at rest is left out of the computation until something comes near.
    pub sleep: bool,
}

impl Default for FluidSettings {
    fn default() -> Self {
        Self {
            solver: Solver::Wcsph,
            mode: InteractionMode::Full,
            spacing: 0.005,
            kernel: Kernel::LowPass,
            support: 0.0,
            rest_density: 1000.0,
            viscosity: 0.001,
            surface_tension: 0.0,
            stiffness: 100.0,
            cohesion: 0.0,
            sound_speed: 0.0,
            density_diffusion: 0.2,
            artificial_viscosity: 0.1,
            shifting: 0.07,
            acoustic_damping: 0.5,
            background_pressure: 0.0,
            tolerance: 0.02,
            max_iterations: 50,
            damping: 0.0,
            max_displacement: 0.0,
            lifetime: 0.0,
            max_particles: 200_000,
            gravity: DVec3::new(0.0, -9.81, 0.0),
            restitution: 0.0,
            two_way: true,
            max_substeps: 2000,
            sleep: false,
        }
    }
}

impl FluidSettings {
    /// Kernel support H, m.
    pub fn support_length(&self) -> f64 {
        let own = match self.solver {
            Solver::Muller => 2.0,
            Solver::Wcsph | Solver::Dfsph => 2.7,
        };
        self.spacing * if self.support > 0.0 { self.support } else { own }
    }

    /// The kernel that the pair loops and walls of `wcsph` and `dfsph` take.
    pub(crate) fn kernel_in_use(&self) -> Kernel {
        if self.solver == Solver::Dfsph { Kernel::Wendland } else { self.kernel }
    }

    /// Mass of one particle, kg.
    pub fn particle_mass(&self) -> f64 {
        self.rest_density * self.spacing.powi(3)
    }

    /// Kinematic viscosity ν = μ/ρ₀, m²/s.
    pub fn kinematic_viscosity(&self) -> f64 {
        self.viscosity / self.rest_density
    }
}

/// A box with edges along the axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aabb {
    /// Corner of the smallest coordinates, m.
    pub min: DVec3,
    /// Corner of the largest coordinates, m.
    pub max: DVec3,
}

impl Aabb {
    /// True when `point` lies in the box or on its face.
    pub fn contains(&self, point: DVec3) -> bool {
        point.cmpge(self.min).all() && point.cmple(self.max).all()
    }

    /// True when the corners are finite and in order.
    pub fn is_valid(&self) -> bool {
        self.min.is_finite() && self.max.is_finite() && self.min.cmplt(self.max).all()
    }
}

/// A round jet source.
#[derive(Clone, Debug, PartialEq)]
pub struct Source {
    /// Name by which settings address it.
    pub name: String,
    /// Centre of the outlet, m.
    pub position: DVec3,
    /// Direction of the jet, any length but zero.
    pub direction: DVec3,
    /// Diameter of the outlet, m.
    pub diameter: f64,
    /// Speed at the outlet, m/s.
    pub speed: f64,
    /// Whether it runs.
    pub on: bool,
    /// Period of an intermittent jet, s; 0 runs steadily.
    pub period: f64,
    /// Share of the period in which it runs, 0..1.
    pub duty: f64,
}

impl Default for Source {
    /// A steady jet of 20 mm straight down at 1 m/s, from the origin.
    fn default() -> Self {
        Self {
            name: "0".into(),
            position: DVec3::ZERO,
            direction: DVec3::NEG_Y,
            diameter: 0.02,
            speed: 1.0,
            on: true,
            period: 0.0,
            duty: 1.0,
        }
    }
}

impl Source {
    /// Volume flow while it runs, m³/s.
    pub fn flow(&self) -> f64 {
        std::f64::consts::FRAC_PI_4 * self.diameter * self.diameter * self.speed
    }

    /// Whether it runs at time `t` (s).
    pub fn runs_at(&self, t: f64) -> bool {
        self.on && (self.period <= 0.0 || t.rem_euclid(self.period) < self.duty * self.period)
    }
}

/// A body that stands in the fluid and moves as it is told.
#[derive(Clone, Debug, PartialEq)]
pub struct BodyConfig {
    /// Its shape.
    pub shape: Shape,
    /// Its mass, kg; it counts where the body is driven and not led ([`crate::BodyDrive::Driven`]).
    pub mass: f64,
    /// Collision response coefficient C_R, 0..1: the share of the fluid's impulse that a driven body takes.
    pub collision_response: f64,
    /// Where it starts, m.
    pub position: DVec3,
}

impl Default for BodyConfig {
    /// A ball of 15 mm radius and 0.1 kg in the origin.
    fn default() -> Self {
        let shape = Shape::Sphere { radius: 0.015 };
        Self { shape, mass: 0.1, collision_response: 1.0, position: DVec3::ZERO }
    }
}

/// What surrounds the fluid; fixed for a session, but for the sources' settings.
#[derive(Clone, Debug, PartialEq)]
pub struct World {
    /// Particles that leave it vanish.
    pub bounds: Aabb,
    /// Axes (x, y, z) along which the bounds are a period instead: what leaves comes in on the other side. The
    /// period is at least three times the kernel's support.
    pub periodic: [bool; 3],
    /// Height of a level ground, m.
    pub ground: Option<f64>,
    /// What holds the fluid.
    pub container: Option<Container>,
    /// Jets.
    pub sources: Vec<Source>,
    /// Particles inside them vanish.
    pub sinks: Vec<Aabb>,
    /// Boxes filled with fluid at rest at the start.
    pub pools: Vec<Aabb>,
    /// Bodies, first of all the tool.
    pub bodies: Vec<BodyConfig>,
    /// Which of many equal starts: particles stand off the lattice of a pool by a little, at random.
    pub seed: u32,
}

impl Default for World {
    /// Nothing, within a metre.
    fn default() -> Self {
        Self {
            bounds: Aabb { min: DVec3::splat(-0.5), max: DVec3::splat(0.5) },
            periodic: [false; 3],
            ground: None,
            container: None,
            sources: Vec::new(),
            sinks: Vec::new(),
            pools: Vec::new(),
            bodies: Vec::new(),
            seed: 0,
        }
    }
}

impl World {
    /// Whether there is fluid at the start, or a source that may give some.
    pub fn may_hold_fluid(&self) -> bool {
        !(self.pools.is_empty() && self.sources.is_empty())
    }
}

/// All that a backend needs to know.
#[derive(Clone, Debug, PartialEq)]
pub struct FluidConfig {
    /// Settings of the fluid.
    pub settings: FluidSettings,
    /// What surrounds it.
    pub world: World,
    /// Rate of fluid frames, Hz.
    pub frame_hz: f64,
    /// Worker threads, 1 to 1024.
    pub threads: usize,
}

impl FluidConfig {
    /// Highest speed that drops and sources, on or off, can give to the fluid, m/s; the measure of the speed of sound.
    pub fn reference_speed(&self) -> f64 {
        let g = self.settings.gravity.length();
        let drop = self.world.bounds.max.y - self.world.bounds.min.y;
        let pool = self.world.pools.iter().map(|p| p.max.y - p.min.y).fold(0.0, f64::max);
        let floor = self.floor_height();
        let fall = |s: &Source| (s.position.y - floor).clamp(0.0, drop);
        let jet = self.world.sources.iter().map(|s| (s.speed * s.speed + 2.0 * g * fall(s)).sqrt());
        // A sheet one particle thick draws itself in at this speed (Taylor and Culick).
        let sheet =
            2.0 * self.settings.surface_tension / (self.settings.rest_density * self.settings.spacing);
        jet.fold((2.0 * g * pool).max(sheet).sqrt(), f64::max).max(0.1)
    }

    /// Lowest solid floor, or the lower bound, m.
    fn floor_height(&self) -> f64 {
        let bounds = self.world.bounds.min.y;
        let container = self.world.container.map(|c| c.inner.min.y);
        [self.world.ground, container]
            .into_iter()
            .flatten()
            .fold(f64::INFINITY, f64::min)
            .min(1e9)
            .max(bounds)
    }

    /// Speed of sound of the solver, m/s.
    pub fn sound_speed(&self) -> f64 {
        match self.settings.solver {
            Solver::Muller => self.settings.stiffness.max(0.0).sqrt(),
            Solver::Wcsph | Solver::Dfsph if self.settings.sound_speed > 0.0 => self.settings.sound_speed,
            Solver::Wcsph | Solver::Dfsph => 10.0 * self.reference_speed(),
        }
    }

    /// Highest speed that anything in the fluid may have, m/s: the last guard.
    pub fn highest_speed(&self) -> f64 {
        self.sound_speed().max(5.0 * self.reference_speed())
    }

    /// The most that the solver adds to the stated viscosity in a flow of this wavelength (m), Pa·s. `wcsph` adds the less
    /// the longer the waves, and to quiet flow a tenth of this; in mode none nothing is viscous.
    /// `tests/effective_viscosity.rs` measures it.
    pub fn added_viscosity(&self, wavelength: f64) -> f64 {
        if self.settings.mode == InteractionMode::None {
            return 0.0;
        }
        self.settings.rest_density * solver::added_viscosity(self, TAU / wavelength)
    }

    /// Wavelength at which the solver's own viscosity is told: ten spacings, the shortest that it resolves well, m.
    pub fn resolved_wavelength(&self) -> f64 {
        10.0 * self.settings.spacing
    }

    /// Viscosity that acts on a flow of the resolved wavelength: the stated one and the solver's own, Pa·s.
    pub fn effective_viscosity(&self) -> f64 {
        self.settings.viscosity + self.added_viscosity(self.resolved_wavelength())
    }

    /// Refuses what cannot be computed or cannot be stable, naming field, value and range.
    pub fn check(&self) -> Result<(), FluidError> {
        let s = &self.settings;
        range("fluid.spacing", s.spacing, 1e-4, 1.0)?;
        if s.support != 0.0 {
            range("fluid.support", s.support, 1.2, 4.0)?;
        }
        range("fluid.rest_density", s.rest_density, 1e-3, 1e5)?;
        range("fluid.viscosity", s.viscosity, 0.0, 1e4)?;
        range("fluid.surface_tension", s.surface_tension, 0.0, 10.0)?;
        range("fluid.stiffness", s.stiffness, 0.0, 1e5)?;
        range("fluid.cohesion", s.cohesion, 0.0, 1.0)?;
        range("fluid.sound_speed", s.sound_speed, 0.0, 2000.0)?;
        range("fluid.density_diffusion", s.density_diffusion, 0.0, 0.3)?;
        range("fluid.artificial_viscosity", s.artificial_viscosity, 0.0, 1.0)?;
        range("fluid.shifting", s.shifting, 0.0, 0.5)?;
        range("fluid.acoustic_damping", s.acoustic_damping, 0.0, 1.0)?;
        range("fluid.background_pressure", s.background_pressure, 0.0, 1e7)?;
        if s.solver == Solver::Dfsph && s.background_pressure > 0.0 {
            let what = "dfsph needs a free surface: fluid.background_pressure must be 0, and is";
            let what = format!("{what} {} Pa", s.background_pressure);
            return Err(FluidError::Unsupported { backend: "cpu", what });
        }
        range("fluid.tolerance", s.tolerance, 1e-4, 0.5)?;
        range("fluid.max_iterations", s.max_iterations as f64, 1.0, 1000.0)?;
        range("fluid.damping", s.damping, 0.0, 1e3)?;
        range("fluid.max_displacement", s.max_displacement, 0.0, 10.0)?;
        range("fluid.lifetime", s.lifetime, 0.0, 1e6)?;
        range("fluid.gravity", s.gravity.length(), 0.0, 100.0)?;
        range("fluid.restitution", s.restitution, 0.0, 1.0)?;
        range("run.fluid_hz", self.frame_hz, 10.0, 1000.0)?;
        range("threads", self.threads as f64, 1.0, 1024.0)?;
        self.check_world()?;
        limits::check_substeps(self)
    }

    fn check_world(&self) -> Result<(), FluidError> {
        let boxes = [("bounds", &self.world.bounds)].into_iter();
        let boxes = boxes.chain(self.world.container.iter().map(|c| ("container", &c.inner)));
        let boxes = boxes.chain(self.world.sinks.iter().map(|b| ("sink", b)));
        for (name, b) in boxes.chain(self.world.pools.iter().map(|b| ("pool", b))) {
            if !b.is_valid() {
                return Err(FluidError::Box { name, min: b.min, max: b.max });
            }
        }
        self.world.container.map_or(Ok(()), |c| c.check())?;
        let size = self.world.bounds.max - self.world.bounds.min;
        for axis in (0..3).filter(|&a| self.world.periodic[a]) {
            range("bounds (period)", size[axis], 3.0 * self.settings.support_length(), 1e3)?;
        }
        if let Some(height) = self.world.ground {
            range("ground", height, -1e3, 1e3)?;
        }
        for s in &self.world.sources {
            place("source.position", s.position)?;
            range("source.diameter", s.diameter, 0.0, 1.0)?;
            range("source.speed", s.speed, 0.0, 20.0)?;
            range("source.duty", s.duty, 0.0, 1.0)?;
            range("source.direction (length)", s.direction.length(), 1e-6, 1e6)?;
        }
        for b in &self.world.bodies {
            place("tool.position", b.position)?;
            range("tool.mass", b.mass, 1e-4, 100.0)?;
            range("tool.collision_response", b.collision_response, 0.0, 1.0)?;
            for length in b.shape.lengths() {
                range("tool.radius", length, 1e-4, 10.0)?;
            }
        }
        Ok(())
    }
}

/// Each coordinate finite and within a kilometre.
fn place(field: &'static str, position: DVec3) -> Result<(), FluidError> {
    position.to_array().into_iter().try_for_each(|c| range(field, c, -1e3, 1e3))
}

pub(crate) fn range(field: &'static str, value: f64, min: f64, max: f64) -> Result<(), FluidError> {
    if value >= min && value <= max { Ok(()) } else { Err(FluidError::Range { field, value, min, max }) }
}
