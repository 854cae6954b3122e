//! Fluid and tool exchange momentum: what a driven body gains is C_R times the fluid's impulse, no more and no
//! less, and with C_R = 1 and nothing else in the scene fluid and body together keep their momentum.

#[cfg(test)]
mod common;

use common::{Run, SOLVERS, jet_scene, kinetic_energy, momentum, vector};
use glam::DVec3;
use hapflow_fluid::{BodyDrive, BodySample, BodyState, FrameOutput, Solver};

/// A column of water that has left its tap and meets a ball in empty space without gravity, a little off its
/// centre. The ball is about to be hit.
fn struck(solver: Solver, spacing: f64, mass: f64, share: f64) -> (Run, BodyState) {
    let mut config = jet_scene(solver, spacing);
    config.settings.gravity = DVec3::ZERO;
    config.world.sources[0].position = DVec3::new(0.004, 0.07, 0.0);
    config.world.bodies[0].mass = mass;
    config.world.bodies[0].collision_response = share;
    let mut run = Run::new(&config);
    run.run(0.03);
    config.world.sources[0].on = false;
    run.configure(&config);
    // The last layer is out of the source's lead after two spacings.
    let last = run.run(2.2 * spacing / 1.5);
    (run, last.bodies[0])
}

/// One frame in which the fluid pushes the ball on from `state`.
fn drive(run: &mut Run, state: &BodyState) -> FrameOutput {
    run.frame_with(BodyDrive::Driven { velocity: state.velocity }, &[BodySample::at(state.position)])
}

#[test]
fn momentum_is_kept_where_the_body_takes_all() {
    for solver in SOLVERS {
        for spacing in [0.005, 0.004] {
            let (mut run, mut state) = struck(solver, spacing, 0.05, 1.0);
            let mass = run.config.settings.particle_mass();
            let before = momentum(&run.snapshot(), mass);
            for _ in 0..40 {
                state = drive(&mut run, &state).bodies[0];
            }
            let gained = state.velocity * 0.05;
            let lost = before - momentum(&run.snapshot(), mass);
            assert!(
                gained.length() > 0.1 * before.length(),
                "{solver:?}, dx {spacing} m: it must be hit: {gained}"
            );
            assert!(
                (gained - lost).length() < 1e-3 * lost.length(),
                "{solver:?}, dx {spacing} m: {gained} {lost}"
            );
        }
    }
}

#[test]
fn the_body_takes_its_share_of_every_frame() {
    for solver in SOLVERS {
        for share in [0.0, 0.2, 1.0] {
            let (mut run, mut state) = struck(solver, 0.005, 0.05, share);
            let mut pushed = 0;
            for _ in 0..40 {
                let output = drive(&mut run, &state);
                let impulse = output.loads[0].force() / run.config.frame_hz;
                let gained = (output.bodies[0].velocity - state.velocity) * 0.05;
                pushed += usize::from(impulse.length() > 1e-6);
                assert!(
                    (gained - share * impulse).length() < 1e-9,
                    "{solver:?}, {share}: {gained} of {impulse}"
                );
                state = output.bodies[0];
            }
            assert!(pushed >= 10, "{solver:?}: the ball must be hit, and was in {pushed} frames");
        }
    }
}

/// A heavy tool hardly yields, so that the same particles hit it whatever its share.
#[test]
fn a_fifth_of_the_response_is_a_fifth_of_the_gain() {
    for solver in SOLVERS {
        let gain = |share: f64| {
            let (mut run, mut state) = struck(solver, 0.005, 100.0, share);
            for _ in 0..10 {
                state = drive(&mut run, &state).bodies[0];
            }
            state.velocity.y
        };
        let (all, fifth) = (gain(1.0), gain(0.2));
        assert!(all < -1e-6 && (fifth / all - 0.2).abs() < 1e-3, "{solver:?}: {fifth} of {all}");
    }
}

/// Known answer for contacts by impulse: j = (1 + e) Δv / (1/m + C_R/M); the particle loses j/m and the ball gains
/// C_R j/M, so that without restitution they go on together.
#[test]
fn one_particle_and_a_ball_of_twice_its_mass_share_their_motion() {
    for (share, restitution) in [(1.0, 0.0), (0.2, 0.0), (1.0, 0.5)] {
        let mut config = jet_scene(Solver::Muller, 0.005);
        let mass = config.settings.particle_mass();
        config.settings.gravity = DVec3::ZERO;
        config.settings.restitution = restitution;
        config.world.bodies[0].collision_response = share;
        config.world.bodies[0].mass = 2.0 * mass;
        // A tap so thin that a layer is one particle, closed after the first.
        config.world.sources[0].diameter = 0.0005;
        let mut run = Run::new(&config);
        while run.frame().particles == 0 {}
        config.world.sources[0].on = false;
        run.configure(&config);
        let mut state = run.frame().bodies[0];
        for _ in 0..40 {
            state = drive(&mut run, &state).bodies[0];
        }
        let view = run.snapshot();
        assert_eq!(view.ids.len(), 1);
        let (particle, ball) = (vector(&view.velocities[0]), state.velocity);
        let j = (1.0 + restitution) * 1.5 / (1.0 / mass + share / (2.0 * mass));
        let expected = [DVec3::NEG_Y * (1.5 - j / mass), DVec3::NEG_Y * (share * j / (2.0 * mass))];
        // The particle stands 0.2 mm off the axis: the normal leans by a hundredth.
        let case =
            format!("C_R {share}, e {restitution}: particle {particle}, ball {ball}, not {expected:?}");
        assert!((particle - expected[0]).length() < 0.02 && (ball - expected[1]).length() < 0.02, "{case}");
    }
}

/// Many particles at once must not give a light ball more than they have.
#[test]
fn a_light_ball_takes_no_more_energy_than_there_is() {
    for solver in SOLVERS {
        for mass in [1e-4, 1e-3, 1e-2] {
            let (mut run, mut state) = struck(solver, 0.005, mass, 1.0);
            let particle = run.config.settings.particle_mass();
            let energy = kinetic_energy(&run.snapshot(), particle);
            for frame in 0..40 {
                state = drive(&mut run, &state).bodies[0];
                let now =
                    kinetic_energy(&run.snapshot(), particle) + 0.5 * mass * state.velocity.length_squared();
                assert!(now < 1.01 * energy, "{solver:?}, {mass} kg, frame {frame}: {now} J of {energy} J");
            }
            assert!(state.velocity.length() > 0.1, "{solver:?}, {mass} kg: it must be hit");
        }
    }
}
