//! `dfsph`: its force is the pressure's own and does not hang on how many iterations it took, and its sub-steps follow the
//! flow.

#[cfg(test)]
mod common;

use common::{Run, ball_volume, tank_scene};
use hapflow_fluid::Solver;

const RADIUS: f64 = 0.05;

/// Of a ball held in a tank: mean force over Archimedes', deviation of a sub-step's force over the mean, and mean number
/// of iterations a sub-step.
fn held(tolerance: f64, cells: u32) -> [f64; 3] {
    let mut config = tank_scene(Solver::Dfsph, 0.2, cells, RADIUS);
    config.settings.tolerance = tolerance;
    // Each frame is one sub-step.
    config.frame_hz = 200.0;
    let mut run = Run::new(&config);
    run.run(0.5);
    let outputs: Vec<_> = (0..80).map(|_| run.frame()).collect();
    assert!(outputs.iter().all(|o| o.substeps == 1));
    let forces: Vec<_> = outputs.iter().map(|o| o.loads[0].force().y).collect();
    let mean = forces.iter().sum::<f64>() / forces.len() as f64;
    let square = forces.iter().map(|f| (f - mean).powi(2)).sum::<f64>() / forces.len() as f64;
    let iterations = outputs.iter().map(|o| o.iterations).sum::<usize>() as f64 / outputs.len() as f64;
    [mean / (1000.0 * 9.81 * ball_volume(RADIUS)), square.sqrt() / mean, iterations]
}

#[test]
fn the_force_does_not_hang_on_the_iterations() {
    for cells in [12, 16] {
        let results = [0.04, 0.02, 0.01].map(|tolerance| held(tolerance, cells));
        for [mean, noise, _] in results {
            assert!((mean - 1.0).abs() < 0.03 && noise < 0.005, "{cells} cells: {results:?}");
        }
        let [loose, usual, tight] = results;
        assert!((usual[0] - tight[0]).abs() < 0.01, "{cells} cells: {results:?}");
        assert!(loose[2] < usual[2] && usual[2] < tight[2], "{cells} cells: {results:?}");
    }
}

#[test]
fn a_fluid_without_free_surface_is_refused() {
    let mut config = tank_scene(Solver::Dfsph, 0.2, 10, RADIUS);
    config.settings.background_pressure = 50.0;
    let text = config.check().unwrap_err().to_string();
    assert!(text.contains("fluid.background_pressure must be 0, and is 50 Pa"), "{text}");
}

/// `wcsph` steps by the speed of sound, whatever moves.
#[test]
fn water_at_rest_needs_few_sub_steps() {
    let [stiff, free] = [Solver::Wcsph, Solver::Dfsph].map(|solver| {
        let mut run = Run::new(&tank_scene(solver, 0.2, 10, RADIUS));
        (run.run(0.1).substeps, run.frame().iterations)
    });
    assert!(free.0 * 4 <= stiff.0, "{} and {}", stiff.0, free.0);
    assert!(stiff.1 == 0 && free.1 > 0);
}
