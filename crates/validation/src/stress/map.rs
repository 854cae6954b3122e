//! The stability map: the step that a fluid takes, and the longest at which it stays calm, against stiffness and
//! viscosity.

use crate::worlds;
use glam::DVec3;
use hapflow_fluid::{
    CpuBackend, FluidBackend, FluidConfig, FluidError, FluidSettings, FrameInput, ParticleView, Solver,
    step_limits,
};

/// Cells of the tank along an edge, and their spacing, m.
const CELLS: f64 = 7.0;
const SPACING: f64 = 0.005;
/// Viscosities, Pa·s.
const VISCOSITIES: [f64; 7] = [1e-3, 1e-2, 0.1, 1.0, 10.0, 100.0, 1000.0];
/// Speeds of sound of `wcsph`, in units of the highest speed of the flow.
const SOUNDS: [f64; 3] = [5.0, 10.0, 40.0];
/// Stiffnesses k of `muller`, m²/s².
const STIFFNESSES: [f64; 3] = [10.0, 100.0, 1e3];
/// Steps that are tried, in units of the one that is taken.
const LONGEST: f64 = 16.0;
/// How near the longest calm step is found.
const NEAR: f64 = 1.1;
/// Steps of a run.
const STEPS: usize = 250;
/// Speed of the disorder that a run starts with, and of the wildest that counts as calm, as shares of the highest speed
/// of the flow: `muller` starts without pressure, and has to settle.
const DISORDER: f64 = 0.05;
const CALM: f64 = 0.5;

/// One place of the map.
#[derive(Clone, Debug)]
pub struct Place {
    /// The solver, and how stiff it is.
    pub stiffness: String,
    /// Solver.
    pub solver: Solver,
    /// Viscosity, Pa·s.
    pub viscosity: f64,
    /// The step that the solver takes, s.
    pub taken: f64,
    /// The longest at which a tank stays calm, s; none where it is longer than 16 of those taken, or shorter than a 16th.
    pub calm: Option<f64>,
}

/// The map of all solvers; `tell` hears of each place as it is found.
///
/// # Errors
/// What the fluid refuses.
pub fn map(mut tell: impl FnMut(&Place)) -> Result<Vec<Place>, FluidError> {
    let mut places = Vec::new();
    for (stiffness, settings) in stiffnesses() {
        for viscosity in VISCOSITIES {
            let config = tank(FluidSettings { viscosity, ..settings.clone() });
            let taken = step_limits(&config, config.reference_speed()).shortest();
            let calm = longest_calm(&config, taken)?;
            let place =
                Place { stiffness: stiffness.clone(), solver: settings.solver, viscosity, taken, calm };
            tell(&place);
            places.push(place);
        }
    }
    Ok(places)
}

fn stiffnesses() -> Vec<(String, FluidSettings)> {
    let base = |solver| FluidSettings { solver, spacing: SPACING, ..FluidSettings::default() };
    let reference = tank(base(Solver::Wcsph)).reference_speed();
    let sound =
        |n: f64| (format!("c = {n} v"), FluidSettings { sound_speed: n * reference, ..base(Solver::Wcsph) });
    let k = |k: f64| (format!("k = {k} m²/s²"), FluidSettings { stiffness: k, ..base(Solver::Muller) });
    let dfsph = [("incompressible".to_string(), base(Solver::Dfsph))];
    SOUNDS.map(sound).into_iter().chain(dfsph).chain(STIFFNESSES.map(k)).collect()
}

fn tank(settings: FluidSettings) -> FluidConfig {
    let world = worlds::tank(DVec3::splat(CELLS * SPACING));
    FluidConfig {
        settings: FluidSettings { max_substeps: 100_000, ..settings },
        world,
        frame_hz: 1000.0,
        threads: 1,
    }
}

/// By halving, in powers, between a 16th of what is taken and 16 times that.
fn longest_calm(config: &FluidConfig, taken: f64) -> Result<Option<f64>, FluidError> {
    let (mut calm, mut wild) = (taken / LONGEST, taken * LONGEST);
    if !stays_calm(config, calm)? || stays_calm(config, wild)? {
        return Ok(None);
    }
    while wild / calm > NEAR {
        let middle = (calm * wild).sqrt();
        *if stays_calm(config, middle)? { &mut calm } else { &mut wild } = middle;
    }
    Ok(Some(calm))
}

/// Whether a tank that is stirred a little stays calm with steps of `dt` seconds, and no guard has to help.
fn stays_calm(config: &FluidConfig, dt: f64) -> Result<bool, FluidError> {
    let mut fluid = CpuBackend::new(config)?;
    let speed = DISORDER * config.reference_speed();
    let stir = |x: DVec3| (x * (997.0 / SPACING)).sin();
    fluid.set_flow(|x| speed * DVec3::new(stir(x).y, stir(x).z, stir(x).x));
    fluid.submit_in(&FrameInput { duration: STEPS as f64 * dt, bodies: &[] }, STEPS);
    if fluid.poll().is_none_or(|output| output.degraded) {
        return Ok(false);
    }
    let mut view = ParticleView::default();
    fluid.snapshot(&mut view);
    let most = 0.5 * (CALM * config.reference_speed()).powi(2) * view.ids.len() as f64;
    Ok(super::ledger::kinetic(crate::run::vectors(&view.velocities)) < most)
}
