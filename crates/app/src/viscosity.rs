//! The viscosity of a scene in words: the stated one, and what the solver adds to it.

use hapflow_engine::BackendKind;
use hapflow_engine::Scene;
use hapflow_fluid::InteractionMode;
use serde_json::{Value, json};

/// The line of a table.
pub fn told(scene: &Scene) -> String {
    let stated = scene.fluid.viscosity;
    let Some([added, wavelength]) = added(scene) else { return "plays no part".into() };
    let verdict = if added > stated { "more than the stated one" } else { "less than the stated one" };
    let wavelength = 1e3 * wavelength;
    format!("{stated} Pa·s; the solver adds up to {added:.2e} to waves of {wavelength:.1} mm, {verdict}")
}

/// The same as JSON; null where viscosity plays no part.
pub fn json(scene: &Scene) -> Value {
    added(scene).map_or(Value::Null, |[added, wavelength]| {
        json!({
            "stated_Pa_s": scene.fluid.viscosity,
            "added_Pa_s": added,
            "at_wavelength_m": wavelength,
            "exceeds_stated": added > scene.fluid.viscosity,
        })
    })
}

/// The most that the solver adds (Pa·s) at the wavelength (m) that it resolves well.
fn added(scene: &Scene) -> Option<[f64; 2]> {
    let config = scene.fluid_config(1);
    let particles = scene.run.backend == BackendKind::Cpu && scene.plugin.backend.is_empty();
    let viscous = particles && config.settings.mode != InteractionMode::None;
    let wavelength = config.resolved_wavelength();
    viscous.then(|| [config.added_viscosity(wavelength), wavelength])
}

#[cfg(test)]
mod tests {
    use super::*;
    use hapflow_engine::settings::set;

    fn scene(settings: &[(&str, &str)]) -> Scene {
        let mut scene = hapflow_engine::load("tap").unwrap();
        for (path, value) in settings {
            set(&mut scene, path, &hapflow_engine::Value::parse(value)).unwrap();
        }
        scene
    }

    #[test]
    fn it_says_which_is_larger_and_where_there_is_none() {
        assert!(told(&scene(&[])).ends_with("more than the stated one"));
        assert!(told(&scene(&[("fluid.liquid", "oil")])).ends_with("less than the stated one"));
        assert_eq!(told(&scene(&[("fluid.mode", "none")])), "plays no part");
        assert_eq!(json(&scene(&[("run.backend", "analytic-jet")])), Value::Null);
        assert_eq!(json(&scene(&[("fluid.viscosity", "0.5")]))["stated_Pa_s"], 0.5);
    }
}
