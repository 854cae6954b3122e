//! The load on the tool is what the water has lost: it agrees with the momentum balance of a box round the tool,
//! which is taken from the particles alone and knows nothing of loads.
//!
//! With the water inside the box as the system,
//!
//! ```text
//! force on the tool = momentum in − momentum out, per second, − d/dt momentum inside + weight of what is inside
//! ```
//!
//! The box cuts only free streams, whose pressure is nothing, so nothing else acts on its faces: it begins more
//! than a jet diameter above the ball, where the stream does not feel the ball yet.

#[cfg(test)]
mod common;

use common::{Run, SOLVERS, aabb, jet_scene, vector};
use glam::DVec3;
use hapflow_fluid::{Aabb, FluidConfig, ParticleView, Solver};
use std::collections::HashMap;

/// Frames over which forces are averaged, after as many in which the stream becomes steady.
const FRAMES: usize = 250;

/// What the box holds, by the particles' ids.
type Inside = HashMap<u32, DVec3>;

fn velocities(view: &ParticleView) -> Inside {
    view.ids.iter().zip(&view.velocities).map(|(&id, v)| (id, vector(v))).collect()
}

fn inside(view: &ParticleView, volume: &Aabb) -> Inside {
    let rows = view.ids.iter().zip(&view.positions).zip(&view.velocities);
    let here = rows.filter(|((_, x), _)| volume.contains(vector(x)));
    here.map(|((&id, _), v)| (id, vector(v))).collect()
}

/// Impulse (N·s) on the tool between two snapshots, from the momenta of the particles.
struct Balance {
    mass: f64,
    gravity: DVec3,
    volume: Aabb,
}

impl Balance {
    fn impulse(&self, before: &ParticleView, after: &ParticleView, dt: f64) -> DVec3 {
        let (all_before, all_after) = (velocities(before), velocities(after));
        let (old, new) = (inside(before, &self.volume), inside(after, &self.volume));
        // Somewhere between the snapshots a particle crossed the face: with the mean of its velocities.
        let crossing = |id: &u32| 0.5 * (all_before[id] + all_after[id]);
        let entered: DVec3 = new.keys().filter(|id| !old.contains_key(id)).map(crossing).sum();
        let left: DVec3 = old.keys().filter(|id| !new.contains_key(id)).map(crossing).sum();
        let growth = new.values().sum::<DVec3>() - old.values().sum::<DVec3>();
        let count = 0.5 * (old.len() + new.len()) as f64;
        self.mass * (entered - left - growth + self.gravity * count * dt)
    }
}

/// Mean force by the loads and by the balance, N.
fn forces(config: &FluidConfig) -> [DVec3; 2] {
    let (mut run, dt) = (Run::new(config), 1.0 / config.frame_hz);
    run.run(FRAMES as f64 * dt);
    let balance = Balance {
        mass: config.settings.particle_mass(),
        gravity: config.settings.gravity,
        volume: aabb([-0.06, -0.045, -0.06], [0.06, 0.04, 0.06]),
    };
    let (mut load, mut impulse) = (DVec3::ZERO, DVec3::ZERO);
    let mut before = run.snapshot();
    for _ in 0..FRAMES {
        load += run.frame().loads[0].force();
        let after = run.snapshot();
        impulse += balance.impulse(&before, &after, dt);
        before = after;
    }
    [load / FRAMES as f64, impulse / (FRAMES as f64 * dt)]
}

fn check(solver: Solver) {
    for spacing in [0.005, 0.004] {
        for offset in [0.0, 0.008] {
            let mut config = jet_scene(solver, spacing);
            config.world.sources[0].position.x = offset;
            let [load, balance] = forces(&config);
            let case = format!(
                "{solver:?}, dx {spacing} m, off by {offset} m: loads {load:.4}, balance {balance:.4}"
            );
            assert!(balance.y < -0.05, "the jet must push: {case}");
            if offset > 0.0 {
                assert!(balance.x < -0.05, "an off-centre jet must push aside: {case}");
            }
            // Measured: 0.3 % at most.
            assert!((load - balance).abs().max_element() < 0.02 * balance.length(), "{case}");
        }
    }
}

#[test]
fn loads_of_wcsph_are_the_water_s_loss() {
    check(SOLVERS[0]);
}

#[test]
fn loads_of_muller_are_the_water_s_loss() {
    check(SOLVERS[1]);
}
