//! What a session takes from outside of hapflow in place of its own parts, by name.

use crate::SceneError;
use crate::scene::Scene;
use crate::scene_device::open_own;
use crate::session::open_backend;
use hapflow_devices::{DeviceError, HapticDevice};
use hapflow_fluid::{FluidBackend, FluidConfig, FluidError};
use hapflow_haptics::{Coupling, CouplingKind, ToolState};
use hapflow_realtime::Clock;
use std::collections::BTreeMap;
use std::sync::Arc;

/// Makes a fluid. One that fails while it runs gives loads that are not finite: the session makes a fault of them.
pub type BackendMaker = Arc<dyn Fn(&FluidConfig) -> Result<Box<dyn FluidBackend>, FluidError> + Send + Sync>;
/// Makes a coupling, one for each tool; or says why not. One that fails gives an answer that is not finite.
pub type CouplingMaker = Arc<dyn Fn() -> Result<Box<dyn Coupling>, String> + Send + Sync>;
/// Opens a device, which a hand may hold; its origin is to be where the tool starts, in the device frame, m.
pub type DeviceMaker = Arc<dyn Fn(glam::DVec3) -> Result<Box<dyn HapticDevice>, DeviceError> + Send + Sync>;

/// Parts that plugins bring, by the names by which a scene's `plugin.…` asks for them.
#[derive(Clone, Default)]
pub struct Parts {
    /// For `plugin.backend`. Such a fluid shows nobody what is round a tool, so that `run.coupling` must not be `local`.
    pub backends: BTreeMap<String, BackendMaker>,
    /// For `plugin.coupling`.
    pub couplings: BTreeMap<String, CouplingMaker>,
    /// For `plugin.device`; opened by [`run::real_time`](crate::run::real_time).
    pub devices: BTreeMap<String, DeviceMaker>,
}

impl std::fmt::Debug for Parts {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let names = (self.backends.keys(), self.couplings.keys(), self.devices.keys());
        f.debug_tuple("Parts").field(&names).finish()
    }
}

impl Parts {
    /// Lets `scene` take what there is one of, where it does not say.
    ///
    /// # Errors
    /// Several to choose from.
    pub fn choose(&self, scene: &mut Scene) -> Result<(), SceneError> {
        let plugin = &mut scene.plugin;
        choose("plugin.backend", &self.backends, &mut plugin.backend)?;
        choose("plugin.coupling", &self.couplings, &mut plugin.coupling)?;
        choose("plugin.device", &self.devices, &mut plugin.device)
    }

    pub(crate) fn open_backend(
        &self,
        scene: &Scene,
        config: &FluidConfig,
    ) -> Result<Box<dyn FluidBackend>, SceneError> {
        let Some(make) = find("plugin.backend", &self.backends, &scene.plugin.backend)? else {
            return Ok(open_backend(scene, config)?);
        };
        if scene.coupling() == CouplingKind::Local {
            return Err(SceneError::BadValue {
                path: "run.coupling".into(),
                value: "\"local\"".into(),
                expected: "direct or momentum: local looks at the fluid round the tool, which a plugin's does not show"
                    .into(),
            });
        }
        Ok(make(config)?)
    }

    pub(crate) fn make_coupling(&self, scene: &Scene) -> Result<Box<dyn Coupling>, SceneError> {
        match find("plugin.coupling", &self.couplings, &scene.plugin.coupling)? {
            Some(make) => make().map_err(SceneError::Refused),
            None => Ok(scene.run.coupling.build()),
        }
    }

    pub(crate) fn open_device(
        &self,
        scene: &Scene,
        clock: &Arc<dyn Clock>,
    ) -> Result<Box<dyn HapticDevice>, SceneError> {
        match find("plugin.device", &self.devices, &scene.plugin.device)? {
            Some(open) => {
                let start = scene.mapping()?.device_state(ToolState::at(scene.tool.position)).position;
                Ok(open(start)?)
            }
            None => open_own(scene, clock),
        }
    }
}

fn choose<M>(path: &str, parts: &BTreeMap<String, M>, name: &mut String) -> Result<(), SceneError> {
    let mut names = parts.keys();
    match (name.is_empty(), names.next(), names.next()) {
        (true, Some(one), None) => name.clone_from(one),
        (true, Some(_), Some(_)) => return Err(unknown(path, parts, name)),
        _ => {}
    }
    Ok(())
}

/// The part of that name; none if the scene asks for none.
fn find<'a, M>(path: &str, parts: &'a BTreeMap<String, M>, name: &str) -> Result<Option<&'a M>, SceneError> {
    match parts.get(name) {
        None if !name.is_empty() => Err(unknown(path, parts, name)),
        found => Ok(found),
    }
}

fn unknown<M>(path: &str, parts: &BTreeMap<String, M>, name: &str) -> SceneError {
    let names: Vec<_> = parts.keys().map(String::as_str).collect();
    let expected = match names[..] {
        [] => "empty, as no plugin is loaded that brings one (hapflow run --plugin)".into(),
        _ => format!("one of those that plugins bring: {}", names.join(", ")),
    };
    SceneError::BadValue { path: path.into(), value: format!("\"{name}\""), expected }
}
