//! How long a sub-step may be, so that no setting can make the fluid explode.

use crate::solver::{muller, viscosity, wcsph};
use crate::{FluidConfig, FluidError, InteractionMode, Solver};

/// Courant number of `wcsph`.
pub(crate) const COURANT: f64 = 0.8;
/// Longest explicit step of `wcsph`, in H²/ν.
pub(crate) const EXPLICIT_VISCOSITY: f64 = 0.015;

/// What bounds the length of a sub-step, s; infinite where nothing does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepLimits {
    /// Sound and flow (Courant–Friedrichs–Lewy), and where there is no sound, gravity.
    pub cfl: f64,
    /// Explicit viscosity; that of `wcsph` is implicit where it alone would ask for steps a third as long as sound does.
    pub viscous: f64,
    /// Forces: gravity and surface tension (Monaghan 1992, doi:10.1146/annurev.aa.30.090192.002551).
    pub force: f64,
    /// Contacts: no particle crosses more than a third of a spacing.
    pub contact: f64,
}

impl StepLimits {
    /// The shortest of them, s.
    pub fn shortest(&self) -> f64 {
        self.cfl.min(self.viscous).min(self.force).min(self.contact)
    }
}

/// Step limits of `config` while the fastest particle has `speed` (m/s).
///
/// `wcsph` is staggered and stable to c dt/dx = 1.5 at rest (measured); 0.8 leaves room for motion. `muller`
/// has no damping of its own and gets half of that. `dfsph` knows no sound: 0.4 of the way to a
/// neighbour at the speed of the flow (Bender & Koschier 2015), and at rest 0.25 of the time in which gravity goes it
/// (Monaghan 1992, doi:10.1146/annurev.aa.30.090192.002551). Viscosity: the explicit operators' own spectral bounds with
/// a margin (see the solver files). Contact: tunnelling.
pub fn step_limits(config: &FluidConfig, speed: f64) -> StepLimits {
    let s = &config.settings;
    let (dx, h) = (s.spacing, s.support_length());
    let contact = dx / 3.0 / speed.max(1e-9);
    if s.mode == InteractionMode::None {
        let never = f64::INFINITY;
        return StepLimits { cfl: never, viscous: never, force: never, contact };
    }
    let (sound, nu) = (config.sound_speed(), s.kinematic_viscosity());
    let explicit = if viscosity::is_implicit(config) { 0.0 } else { nu };
    let (courant, c, decay) = match s.solver {
        Solver::Wcsph => (
            COURANT,
            sound + speed,
            explicit / EXPLICIT_VISCOSITY + wcsph::artificial_viscosity(config) / 0.007,
        ),
        Solver::Dfsph => (0.4, speed.max(1.6 * (s.gravity.length() * dx).sqrt()), nu / EXPLICIT_VISCOSITY),
        Solver::Muller => (0.4, sound + speed, (nu + muller::artificial_viscosity(config)) / 0.04),
    };
    // Mixed gives every other sub-step the push of two.
    let share = if s.mode == InteractionMode::Mixed { 0.7 } else { 1.0 };
    // What the surface of a ball of one spacing feels; without sound gravity is in the flow's limit.
    let fall = if s.solver == Solver::Dfsph { 0.0 } else { s.gravity.length() };
    let push = fall + 2.0 * s.surface_tension / (s.rest_density * dx * dx);
    StepLimits {
        cfl: share * courant * dx / c.max(1e-9),
        viscous: share * h * h / decay.max(1e-12),
        force: share * 0.25 * (dx / push.max(1e-12)).sqrt(),
        contact,
    }
}

/// Highest speed to reckon with in a frame of `frame_s` seconds that begins with `seen` m/s. Where the sub-step follows
/// the flow alone, that is what gravity and the sources can make of it.
pub(crate) fn expected_speed(config: &FluidConfig, seen: f64, frame_s: f64) -> f64 {
    if config.settings.solver != Solver::Dfsph {
        return seen.max(config.reference_speed());
    }
    let sources = config.world.sources.iter().map(|s| s.speed).fold(seen, f64::max);
    sources + config.settings.gravity.length() * frame_s
}

/// Sub-steps that a frame of `frame_s` seconds needs.
pub(crate) fn substeps(config: &FluidConfig, frame_s: f64, speed: f64) -> usize {
    let needed = ((frame_s / step_limits(config, speed).shortest()).ceil() as usize).max(1);
    // Mixed sub-steps come in pairs, so that every frame gets the same share of them.
    if config.settings.mode == InteractionMode::Mixed { needed.next_multiple_of(2) } else { needed }
}

/// Refuses settings that need more sub-steps a frame than are allowed, and says which setting is to blame.
pub(crate) fn check_substeps(config: &FluidConfig) -> Result<(), FluidError> {
    let frame = 1.0 / config.frame_hz;
    let limits = step_limits(config, config.reference_speed());
    let needed = substeps(config, frame, config.reference_speed());
    let allowed = config.settings.max_substeps;
    if needed <= allowed {
        return Ok(());
    }
    let cause = match limits.shortest() {
        shortest if shortest == limits.viscous => "fluid.viscosity",
        shortest if shortest == limits.force => "fluid.surface_tension",
        _ if config.settings.solver == Solver::Dfsph => "the speed of the flow",
        _ => "the speed of sound",
    };
    Err(FluidError::TooStiff {
        cause,
        needed,
        allowed,
        frame_hz: config.frame_hz,
        spacing: config.settings.spacing,
    })
}
