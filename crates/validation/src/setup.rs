//! What one run of a case is given: a spacing, physical parameters and settings of the fluid.

use crate::reference::GRAVITY;
use crate::{Case, ValidationError};
use glam::DVec3;
use hapflow_engine::{Scene, Value, settings};
use hapflow_fluid::{FluidConfig, FluidSettings, World};

/// Pressure of an enclosed flow over ρ c²: with c ten times the highest speed, four times the highest dynamic pressure.
const BACKGROUND: f64 = 0.02;

/// What one run of a case is given.
#[derive(Clone, Debug)]
pub struct Setup<'a> {
    /// The case.
    pub case: &'a Case,
    /// Spacing of the particles, m.
    pub dx: f64,
    /// Values of the case's parameters, in their order.
    values: Vec<Value>,
    /// Settings of the fluid that somebody chose.
    chosen: Vec<(String, Value)>,
    /// Worker threads.
    threads: usize,
}

impl<'a> Setup<'a> {
    /// The case as it is shipped, at its first spacing.
    pub fn new(case: &'a Case, threads: usize) -> Self {
        let values = case.parameters.iter().map(|p| Value::parse(p.default)).collect();
        let mut setup = Self { case, dx: 0.0, values, chosen: Vec::new(), threads };
        setup.dx = setup.shipped_dx();
        setup
    }

    /// Gives a parameter of the case, or a setting `fluid.…`, a value.
    ///
    /// # Errors
    /// A value that does not fit, or an unknown `fluid.…`.
    pub fn set(&mut self, name: &str, value: &Value) -> Result<(), ValidationError> {
        let Some(k) = self.case.parameters.iter().position(|p| p.name == name) else {
            settings::set(&mut Scene::default(), name, value)?;
            self.chosen.push((name.into(), value.clone()));
            return Ok(());
        };
        let (p, case) = (&self.case.parameters[k], self.case.name);
        if !p.kind.fits(value) {
            let (value, expected) = (value.to_string(), p.kind.allowed(p.unit));
            return Err(ValidationError::BadValue { case, name: p.name, value, expected });
        }
        self.values[k] = value.clone();
        Ok(())
    }

    /// The same at another spacing, m.
    pub(crate) fn at(&self, dx: f64) -> Self {
        Self { dx, ..self.clone() }
    }

    /// The spacing that the goals are for, m.
    pub fn shipped_dx(&self) -> f64 {
        self.number(self.case.length) / self.case.cells[0]
    }

    /// Worker threads.
    pub(crate) fn threads(&self) -> usize {
        self.threads
    }

    /// Value of a parameter that is a number.
    pub fn number(&self, name: &str) -> f64 {
        if let Some(Value::Number(n)) = self.value(name) { *n } else { f64::NAN }
    }

    /// Value of a parameter that is a word.
    pub fn word(&self, name: &str) -> &str {
        if let Some(Value::Text(t)) = self.value(name) { t } else { "" }
    }

    fn value(&self, name: &str) -> Option<&Value> {
        self.case.parameters.iter().position(|p| p.name == name).map(|k| &self.values[k])
    }

    /// Values of the case's parameters, and all settings of `fluid` that differ from a scene's own but the spacing.
    pub fn parameters(&self, fluid: &FluidSettings) -> Vec<(String, Value)> {
        let own = self.case.parameters.iter().zip(&self.values).map(|(p, v)| (p.name.to_string(), v.clone()));
        let (plain, scene) = (Scene::default(), Scene { fluid: fluid.clone(), ..Scene::default() });
        let table = settings::SETTINGS.iter().filter(|s| s.path.starts_with("fluid."));
        let told = |path: &str| path == "fluid.spacing" || settings::is_shorthand(path);
        let differing = table.filter(|s| !told(s.path) && s.get(&scene) != s.get(&plain));
        own.chain(differing.map(|s| (s.path.to_string(), s.get(&scene)))).collect()
    }

    /// A fluid of the shipped configuration in `world`, with what was chosen, and with the case's density and
    /// viscosity where it has them.
    pub(crate) fn config(&self, world: World) -> FluidConfig {
        let mut scene = Scene::default();
        for (path, value) in &self.chosen {
            // Each was checked when it was chosen.
            let _ = settings::set(&mut scene, path, value);
        }
        let mut fluid = scene.fluid;
        fluid.spacing = self.dx;
        fluid.gravity = DVec3::NEG_Y * GRAVITY;
        let has = |name: &str| self.value(name).is_some();
        fluid.rest_density = if has("density") { self.number("density") } else { fluid.rest_density };
        fluid.viscosity = if has("viscosity") { self.number("viscosity") } else { fluid.viscosity };
        FluidConfig { settings: fluid, world, frame_hz: 1000.0, threads: self.threads }
    }

    /// Like [`Self::config`] for a flow that is driven to `speed` (m/s) by what the fluid cannot know beforehand: the
    /// speed of sound is as many times that as it is for jets and drops.
    pub(crate) fn config_at_speed(&self, world: World, speed: f64) -> FluidConfig {
        let mut config = self.config(world);
        let own = config.reference_speed();
        if config.settings.sound_speed == 0.0 && speed > own {
            config.settings.sound_speed = config.sound_speed() * speed / own;
        }
        config
    }

    /// Like [`Self::config_at_speed`] for a flow without free surface or gravity, in which `speed` (m/s) is the highest:
    /// all is under a pressure, so that the fluid can pull.
    pub(crate) fn enclosed(&self, world: World, speed: f64) -> FluidConfig {
        let mut config = self.config(world);
        config.settings.gravity = DVec3::ZERO;
        if config.settings.sound_speed == 0.0 {
            config.settings.sound_speed = config.sound_speed() * speed / config.reference_speed();
        }
        if config.settings.background_pressure == 0.0 {
            let stiffness = config.settings.rest_density * config.sound_speed().powi(2);
            config.settings.background_pressure = BACKGROUND * stiffness;
        }
        config
    }

    /// Refuses settings that were chosen and that the case sets otherwise.
    pub(crate) fn check(&self, config: &FluidConfig) -> Result<(), ValidationError> {
        let scene = Scene { fluid: config.settings.clone(), ..Scene::default() };
        for (path, _) in &self.chosen {
            let wanted = self.chosen.iter().rfind(|(p, _)| p == path).map(|(_, v)| v);
            let value = settings::get(&scene, path)?;
            if wanted != Some(&value) {
                let value = value.to_string();
                return Err(ValidationError::Owned { case: self.case.name, path: path.clone(), value });
            }
        }
        Ok(())
    }
}
