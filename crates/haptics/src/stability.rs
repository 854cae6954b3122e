//! What a device bears of an impedance that is rendered late.

use std::f64::consts::PI;

/// By how much what coupling `local` answers to the hand's place, and to its velocity, comes late until it acts, s: measured by a
/// test, with a device's velocity estimate of 70 Hz and its transport of 2 ms. The parabola through the hand's last places makes
/// up for most of it.
pub const LOCAL_DELAYS_S: [f64; 2] = [0.0016, 0.016];

/// Largest damping (N·s/m) that may be rendered `delay_s` late on a `mass_kg` that nobody holds: half of that at which
/// m v̇ = −b v(t − T) begins to swing, b T/m = π/2.
pub fn most_damping(mass_kg: f64, delay_s: f64) -> f64 {
    0.25 * PI * mass_kg / delay_s
}

/// Largest stiffness (N/m) that may be rendered `delay_s` late: late by T it takes k T off the device's own damping, of which
/// half is left.
pub fn most_stiffness(damping_n_s_per_m: f64, delay_s: f64) -> f64 {
    0.5 * damping_n_s_per_m / delay_s
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{CouplingKind, Law, LawNode, LocalModel, Rendering, ToolState, VelocityEstimator, Wrench};
    use glam::{DVec3, Mat3, Vec3};

    const MASS: f64 = 0.2;
    const OWN_DAMPING: f64 = 0.5;

    /// Whether a device that nobody holds, with encoders of 60 µm and 2 ms of transport, comes to rest after a push when
    /// coupling `local` renders `damping` and `stiffness` by a law that is exact.
    fn calms(damping: f64, stiffness: f64) -> bool {
        let law = |p: DVec3| LawNode {
            force: (p * -stiffness).as_vec3(),
            by_velocity: -Mat3::from_diagonal(Vec3::splat(damping as f32)),
        };
        let model = LocalModel {
            frame: 1,
            frame_s: 1.0 / 60.0,
            law: Law::tabulate(DVec3::ZERO, DVec3::ZERO, 0.02, law),
            ..LocalModel::default()
        };
        let mut rendering = Rendering::new(CouplingKind::Local);
        let mut estimate = VelocityEstimator::default();
        let (mut place, mut velocity, mut late) = (0.0, 0.05, [Wrench::ZERO; 2]);
        let mut swings = [0.0_f64; 2];
        for n in 0..4000 {
            let time_s = f64::from(n) * 1e-3;
            let read = DVec3::X * (place / 60e-6_f64).round() * 60e-6;
            let tool = ToolState { velocity: estimate.update(time_s, read), ..ToolState::at(read) };
            let acting = std::mem::replace(
                &mut late[n as usize % 2],
                rendering.tick(&model, n == 0, &tool, time_s, 1.0),
            );
            velocity += (acting.force.x - OWN_DAMPING * velocity) / MASS * 1e-3;
            place += velocity * 1e-3;
            let half = usize::from(n >= 2000);
            swings[half] = swings[half].max(if n % 2000 >= 1000 { velocity.abs() } else { 0.0 });
        }
        velocity.is_finite() && swings[1] < 0.01
    }

    fn most(mut good: f64, mut bad: f64, calms: impl Fn(f64) -> bool) -> f64 {
        assert!(calms(good) && !calms(bad));
        while bad / good > 1.02 {
            let middle = (good * bad).sqrt();
            if calms(middle) { good = middle } else { bad = middle }
        }
        good
    }

    /// What may be rendered is about half of what is calm.
    #[test]
    fn the_limits_are_those_of_local_itself() {
        let damping = most(1.0, 1000.0, |b| calms(b, 0.0));
        let stiffness = most(1.0, 10000.0, |k| calms(0.0, k));
        let [place_s, velocity_s] = LOCAL_DELAYS_S;
        let limits = [most_damping(MASS, velocity_s), most_stiffness(OWN_DAMPING, place_s)];
        println!(
            "calm up to {damping} N·s/m (limit {}) and {stiffness} N/m (limit {})",
            limits[0], limits[1]
        );
        for (found, limit) in [damping, stiffness].into_iter().zip(limits) {
            assert!((1.8..2.3).contains(&(found / limit)), "{found} for {limit}");
        }
    }
}
