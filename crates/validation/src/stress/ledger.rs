//! What has been put into the fluid: the most that each source of energy can have given to a kilogram of it.

use glam::DVec3;
use hapflow_fluid::FluidConfig;

/// Disorder of the start and of every change, as a share of the density: a lattice is no state of rest.
const DISORDER: f64 = 0.05;

/// Energies in J/kg, each the most so far. None is taken back: friction may keep it or not.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Ledger {
    height: f64,
    surface: f64,
    pressure: f64,
    source: f64,
    body: f64,
    squeeze: f64,
}

impl Ledger {
    /// Whatever `config` can give: by gravity, surface tension, pressure and sources.
    pub fn take_config(&mut self, config: &FluidConfig) {
        let s = &config.settings;
        let size = config.world.bounds.max - config.world.bounds.min;
        let fall = s.gravity.abs().dot(size);
        let fastest = config.world.sources.iter().map(|s| s.speed).fold(0.0, f64::max);
        self.height = self.height.max(fall);
        // All of it as drops of one spacing.
        self.surface = self.surface.max(6.0 * s.surface_tension / (s.rest_density * s.spacing));
        self.pressure = self.pressure.max(s.background_pressure / s.rest_density);
        self.source = self.source.max(0.5 * fastest * fastest);
    }

    /// The fluid as it stands when its equation of state is set: `squeeze` as [`super::crowd::squeeze`] finds it.
    pub fn take_state(&mut self, config: &FluidConfig, squeeze: f64) {
        let c = config.sound_speed();
        self.squeeze = self.squeeze.max(0.5 * c * c * (squeeze + DISORDER * DISORDER));
    }

    /// A surface that moves at `speed` (m/s): what it strikes flies off twice as fast.
    pub fn take_motion(&mut self, speed: f64) {
        self.body = self.body.max(2.0 * speed * speed);
    }

    /// A body that is in the fluid at once: what was there, a share `displaced` of all, is squeezed to twice its density.
    pub fn take_jump(&mut self, config: &FluidConfig, displaced: f64) {
        let c = config.sound_speed();
        self.squeeze += 0.5 * c * c * displaced.min(1.0);
    }

    /// All of it, J/kg.
    pub fn total(&self) -> f64 {
        self.height + self.surface + self.pressure + self.source + self.body + self.squeeze
    }

    /// The speed that gives, m/s.
    pub fn speed(&self) -> f64 {
        (2.0 * self.total()).sqrt()
    }

    /// The pressure that gives in fluid of `config`, Pa.
    pub fn pressure(&self, config: &FluidConfig) -> f64 {
        config.settings.rest_density * self.total()
    }
}

/// Kinetic energy of all velocities (m/s), for particles of 1 kg, J.
pub(super) fn kinetic(velocities: impl Iterator<Item = DVec3>) -> f64 {
    velocities.map(|v| 0.5 * v.length_squared()).sum()
}
