//! A mass on a spring and a damper, moved exactly.

use glam::DVec3;

/// Terms of the series: at a quarter of the system's own time a step, what is left out is below rounding.
const TERMS: u32 = 12;
/// Longest step, s: a quarter of a tick, over which a hand's wish is straight.
const LONGEST_STEP_S: f64 = 0.25e-3;

/// m x″ + c x′ + k x = u, with a drive u that grows straight over a step. For such a drive the motion is
/// exact to rounding: the solution's Taylor series, whose every term follows from the two before it. No
/// energy is lost or made by the stepping, however stiff the spring.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Mass {
    /// m, kg.
    pub mass_kg: f64,
    /// c, N·s/m.
    pub damping_n_s_per_m: f64,
    /// k, N/m.
    pub stiffness_n_per_m: f64,
    /// x, m.
    pub position: DVec3,
    /// x′, m/s.
    pub velocity: DVec3,
}

impl Mass {
    /// Longest step for which the series is exact, s.
    pub(crate) fn longest_step_s(&self) -> f64 {
        let spring = (self.stiffness_n_per_m / self.mass_kg).sqrt();
        let damper = self.damping_n_s_per_m / self.mass_kg;
        LONGEST_STEP_S.min(0.25 / spring.max(damper).max(1e-3))
    }

    /// Moves on by `step_s` while the drive goes from `from` to `to`, N.
    pub(crate) fn advance(&mut self, from: DVec3, to: DVec3, step_s: f64) {
        let mut forcing = [from, (to - from) / step_s];
        let [mut lower, mut upper] = [self.position, self.velocity];
        let [mut position, mut velocity] = [DVec3::ZERO; 2];
        let mut weight = 1.0;
        for n in 0..=TERMS {
            position += lower * weight;
            velocity += upper * weight;
            let pull = forcing[0] - upper * self.damping_n_s_per_m - lower * self.stiffness_n_per_m;
            [lower, upper] = [upper, pull / self.mass_kg];
            forcing = [forcing[1], DVec3::ZERO];
            weight *= step_s / f64::from(n + 1);
        }
        self.position = position;
        self.velocity = velocity;
    }

    /// Dry friction of `force` (N) for `step_s`: it takes speed, and at most all.
    pub(crate) fn rub(&mut self, force: f64, step_s: f64) {
        let (speed, taken) = (self.velocity.length(), force * step_s / self.mass_kg);
        self.velocity *= if taken < speed { 1.0 - taken / speed } else { 0.0 };
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mass(mass_kg: f64, damping: f64, stiffness: f64) -> Mass {
        Mass {
            mass_kg,
            damping_n_s_per_m: damping,
            stiffness_n_per_m: stiffness,
            position: DVec3::ZERO,
            velocity: DVec3::ZERO,
        }
    }

    /// Runs to `time_s` under a drive and gives position and velocity along x.
    fn run(mut mass: Mass, time_s: f64, drive: impl Fn(f64) -> f64) -> (f64, f64) {
        let steps = (time_s / mass.longest_step_s()).ceil();
        let step = time_s / steps;
        for n in 0..steps as u32 {
            let begin = f64::from(n) * step;
            mass.advance(DVec3::X * drive(begin), DVec3::X * drive(begin + step), step);
        }
        (mass.position.x, mass.velocity.x)
    }

    #[test]
    fn underdamped_step_response() {
        let (m, c, k, t) = (0.35, 4.5, 300.0, 0.123_f64);
        let sigma: f64 = c / (2.0 * m);
        let omega = f64::sqrt(k / m - sigma * sigma);
        let decay = (-sigma * t).exp();
        let x = (1.0 - decay * ((omega * t).cos() + sigma / omega * (omega * t).sin())) / k;
        let v = decay * (omega * t).sin() / (m * omega);
        let found = run(mass(m, c, k), t, |_| 1.0);
        assert!((found.0 - x).abs() < 1e-15 && (found.1 - v).abs() < 1e-13, "{found:?} is not {x} {v}");
    }

    #[test]
    fn overdamped_and_springless_step_responses() {
        let (m, c, k, t) = (0.02, 50.0, 500.0, 0.02_f64);
        let root = f64::sqrt(c * c - 4.0 * m * k);
        let (fast, slow) = ((c + root) / (2.0 * m), (c - root) / (2.0 * m));
        let x = (1.0 - (fast * (-slow * t).exp() - slow * (-fast * t).exp()) / (fast - slow)) / k;
        let found = run(mass(m, c, k), t, |_| 1.0).0;
        assert!((found - x).abs() < 1e-14, "{found} is not {x}");
        let free = run(mass(0.2, 0.5, 0.0), 1.0, |_| 2.0).1;
        assert!((free - 4.0 * (1.0 - (-2.5_f64).exp())).abs() < 1e-12);
    }

    #[test]
    fn a_growing_drive_on_a_bare_mass() {
        let (x, v) = run(mass(2.0, 0.0, 0.0), 3.0, |t| 4.0 * t);
        assert!((x - 9.0).abs() < 1e-10 && (v - 9.0).abs() < 1e-10, "{x} {v}");
    }

    #[test]
    fn without_damping_energy_stays_for_a_thousand_swings() {
        let mut mass = mass(0.1, 0.0, 4000.0);
        mass.position = DVec3::new(0.01, -0.02, 0.0);
        let energy = |m: &Mass| 0.05 * m.velocity.length_squared() + 2000.0 * m.position.length_squared();
        let (before, step) = (energy(&mass), mass.longest_step_s());
        (0..(31.4 / step) as u32).for_each(|_| mass.advance(DVec3::ZERO, DVec3::ZERO, step));
        assert!((energy(&mass) / before - 1.0).abs() < 1e-10, "{}", energy(&mass) / before);
    }
}
