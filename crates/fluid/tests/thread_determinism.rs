//! The number of worker threads changes nothing: particles and loads are equal bit for bit, also while another
//! fluid runs beside, and a run can be repeated.

#[cfg(test)]
mod common;

use common::{Run, SOLVERS, jet_scene, tank_scene};
use glam::DVec3;
use hapflow_fluid::{
    BodyDrive, BodyLoad, BodySample, FluidConfig, FluidSettings, Kernel, ParticleView, Solver,
};

const FRAMES: u32 = 20;

/// Everything that a run has to say, as bits: −0 is not 0 here, and a NaN equals itself.
#[derive(Debug, PartialEq)]
struct Trace {
    ids: Vec<u32>,
    floats: Vec<u32>,
    loads: Vec<u64>,
}

impl Trace {
    fn new(view: &ParticleView, loads: &[BodyLoad]) -> Self {
        let rows = view.positions.iter().chain(&view.velocities).flatten();
        let vectors = loads.iter().flat_map(|l| [l.pressure_force, l.viscous_force, l.torque]);
        Self {
            ids: view.ids.clone(),
            floats: rows.chain(&view.pressures).map(|x| x.to_bits()).collect(),
            loads: vectors.flat_map(|v| v.to_array()).map(f64::to_bits).collect(),
        }
    }
}

/// A jet that bursts on a ball and then on the ground, and a tank in which a ball moves.
fn scenes() -> Vec<FluidConfig> {
    let mut scenes = Vec::new();
    for solver in SOLVERS {
        let mut jet = jet_scene(solver, 0.004);
        jet.world.ground = Some(-0.03);
        scenes.push(FluidConfig { frame_hz: 150.0, ..jet });
        scenes.push(tank_scene(solver, 0.12, 11, 0.03));
    }
    // Stiff honey with a surface, by the other kernel: all that a scene can have over and above.
    let mut honey = tank_scene(Solver::Wcsph, 0.12, 11, 0.03);
    honey.settings =
        FluidSettings { viscosity: 300.0, surface_tension: 0.06, kernel: Kernel::Cubic, ..honey.settings };
    scenes.push(honey);
    scenes
}

fn frame(run: &mut Run, loads: &mut Vec<BodyLoad>, k: u32) {
    let along = |k: u32| DVec3::X * (0.01 * f64::from(k) / f64::from(FRAMES));
    let start = run.config.world.bodies[0].position;
    let dt = 1.0 / run.config.frame_hz;
    let sample = |k: u32| BodySample {
        time: dt * f64::from(k),
        velocity: along(1) / dt,
        ..BodySample::at(start + along(k))
    };
    loads.extend(run.frame_with(BodyDrive::Led, &[sample(k), sample(k + 1)]).loads);
}

/// `beside`: whether a second fluid lives and runs frame about with the first.
fn trace(scene: &FluidConfig, threads: usize, beside: bool) -> Trace {
    let config = FluidConfig { threads, ..scene.clone() };
    let mut runs: Vec<_> = (0..1 + usize::from(beside)).map(|_| (Run::new(&config), Vec::new())).collect();
    for k in 0..FRAMES {
        runs.iter_mut().for_each(|(run, loads)| frame(run, loads, k));
    }
    let mut traces: Vec<_> = runs.iter_mut().map(|(run, loads)| Trace::new(&run.snapshot(), loads)).collect();
    if beside {
        assert!(traces[0] == traces[1], "two fluids of one scene differ");
    }
    traces.swap_remove(0)
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    for scene in scenes() {
        let one = trace(&scene, 1, false);
        assert!(one.ids.len() > 500, "the scene must be more than a few chunks: {}", one.ids.len());
        assert!(one.loads.iter().any(|&bits| f64::from_bits(bits) != 0.0), "the tool must feel something");
        for threads in [2, 3, 8] {
            let other = trace(&scene, threads, false);
            assert_eq!(
                one.ids, other.ids,
                "order of particles, {:?} with {threads} threads",
                scene.settings.solver
            );
            assert!(one == other, "{:?} with {threads} threads", scene.settings.solver);
        }
    }
}

#[test]
fn two_fluids_at_once_do_not_disturb_each_other() {
    for scene in scenes() {
        assert!(trace(&scene, 1, false) == trace(&scene, 2, true), "{:?}", scene.settings.solver);
    }
}
