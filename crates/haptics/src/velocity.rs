//! Velocity of a device that gives positions only.

use crate::{RangeError, check_range};
use glam::DVec3;
use std::f64::consts::TAU;

/// Differences of positions through a first-order low pass, for positions with time stamps.
///
/// The low pass is exact for a difference that holds over its interval, v += (1 − e^(−2π fc Δt)) (Δx/Δt − v):
/// how the time is cut into samples does not change the answer, late ticks included.
///
/// It starts at rest. A sample whose time stamp is not newer is skipped (the device gave the same one twice);
/// after a gap longer than [`MAX_GAP_S`](Self::MAX_GAP_S), or a clock that went back, it starts anew, since
/// nothing is known of what happened. A sample that is not finite is skipped. Cost: one exponential a sample.
#[derive(Clone, Debug)]
pub struct VelocityEstimator {
    cutoff_hz: f64,
    newest: Option<(f64, DVec3)>,
    velocity: DVec3,
}

impl VelocityEstimator {
    /// Default cutoff, Hz: lets a hand's fastest motion (about 10 Hz) through with 2.3 ms of delay, and of
    /// the jump that one encoder step makes at 1 kHz a third.
    pub const DEFAULT_CUTOFF_HZ: f64 = 70.0;
    /// Longest time between two samples that still belong together, s.
    pub const MAX_GAP_S: f64 = 0.1;

    /// `cutoff_hz`: 1 to 10 000 Hz.
    ///
    /// # Errors
    /// [`RangeError`] outside that range.
    pub fn new(cutoff_hz: f64) -> Result<Self, RangeError> {
        let cutoff_hz = check_range("velocity_cutoff_hz", cutoff_hz, 1.0, 10_000.0)?;
        Ok(Self { cutoff_hz, newest: None, velocity: DVec3::ZERO })
    }

    /// Takes the position at `time_s` (s, m) and gives the velocity, m/s.
    pub fn update(&mut self, time_s: f64, position: DVec3) -> DVec3 {
        if !time_s.is_finite() || !position.is_finite() {
            return self.velocity;
        }
        match self.newest {
            Some((time, _)) if time == time_s => {}
            Some((time, from)) if time_s > time && time_s - time <= Self::MAX_GAP_S => {
                self.advance(time_s - time, position - from);
                self.newest = Some((time_s, position));
            }
            _ => self.restart(time_s, position),
        }
        self.velocity
    }

    /// The newest velocity, m/s.
    pub fn velocity(&self) -> DVec3 {
        self.velocity
    }

    /// Forgets every sample.
    pub fn reset(&mut self) {
        self.newest = None;
        self.velocity = DVec3::ZERO;
    }

    /// How far a slowly changing velocity comes late at samples `period_s` apart, s: half a sample for the
    /// difference and T/(e^(2π fc T) − 1) for the low pass.
    pub fn delay_s(&self, period_s: f64) -> f64 {
        period_s / 2.0 + period_s / (TAU * self.cutoff_hz * period_s).exp_m1()
    }

    fn advance(&mut self, dt_s: f64, moved: DVec3) {
        let share = -(-TAU * self.cutoff_hz * dt_s).exp_m1();
        let velocity = self.velocity + (moved / dt_s - self.velocity) * share;
        // Two time stamps within 1e-300 s of each other would overflow.
        if velocity.is_finite() {
            self.velocity = velocity;
        }
    }

    fn restart(&mut self, time_s: f64, position: DVec3) {
        self.newest = Some((time_s, position));
        self.velocity = DVec3::ZERO;
    }
}

impl Default for VelocityEstimator {
    fn default() -> Self {
        Self { cutoff_hz: Self::DEFAULT_CUTOFF_HZ, newest: None, velocity: DVec3::ZERO }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What a steady motion of 1 m/s has become after `time_s`.
    fn rise(time_s: f64) -> f64 {
        1.0 - (-TAU * 70.0 * time_s).exp()
    }

    #[test]
    fn a_steady_motion_rises_with_the_time_constant() {
        let mut estimator = VelocityEstimator::default();
        for tick in 0..200 {
            let time = f64::from(tick) * 1e-3;
            let velocity = estimator.update(time, DVec3::new(time, -2.0 * time, 0.0));
            let expected = DVec3::new(1.0, -2.0, 0.0) * rise(time);
            assert!((velocity - expected).length() < 1e-12, "tick {tick}: {velocity}");
        }
    }

    #[test]
    fn how_time_is_cut_does_not_matter() {
        let mut estimator = VelocityEstimator::default();
        let mut time = 0.0;
        for step in [0.0, 1e-3, 3e-4, 2.7e-3, 1e-6, 5e-3, 0.0, 8e-4] {
            time += step;
            estimator.update(time, DVec3::X * time);
            assert!((estimator.velocity().x - rise(time)).abs() < 1e-12);
        }
    }

    #[test]
    fn a_growing_velocity_comes_late_by_the_stated_delay() {
        let mut estimator = VelocityEstimator::default();
        let mut late = 0.0;
        for tick in 0..500 {
            let time = f64::from(tick) * 1e-3;
            late = time - estimator.update(time, DVec3::Y * (0.5 * time * time)).y;
        }
        assert!((late - estimator.delay_s(1e-3)).abs() < 1e-9);
        assert!((estimator.delay_s(1e-3) - 2.31e-3).abs() < 1e-5);
    }

    #[test]
    fn repeated_samples_change_nothing() {
        let mut once = VelocityEstimator::default();
        let mut twice = VelocityEstimator::default();
        for tick in 0..50 {
            let time = f64::from(tick) * 1e-3;
            let expected = once.update(time, DVec3::X * time.sin());
            twice.update(time, DVec3::X * time.sin());
            assert_eq!(twice.update(time, DVec3::X * 9.0), expected);
        }
    }

    #[test]
    fn gaps_and_clocks_that_go_back_start_anew() {
        let mut estimator = VelocityEstimator::default();
        for time in [0.5, -1.0] {
            estimator.update(0.0, DVec3::ZERO);
            assert!(estimator.update(0.01, DVec3::X * 0.01).x > 0.9);
            assert_eq!(estimator.update(time, DVec3::X * 7.0), DVec3::ZERO);
            assert!((estimator.update(time + 0.01, DVec3::X * 7.01).x - rise(0.01)).abs() < 1e-9);
            estimator.reset();
        }
    }

    #[test]
    fn what_is_not_finite_is_skipped() {
        let mut estimator = VelocityEstimator::default();
        estimator.update(0.0, DVec3::ZERO);
        let before = estimator.update(0.01, DVec3::X * 0.01);
        assert_eq!(estimator.update(f64::NAN, DVec3::X), before);
        assert_eq!(estimator.update(0.02, DVec3::X * f64::INFINITY), before);
        assert!((estimator.update(0.02, DVec3::X * 0.02).x - rise(0.02)).abs() < 1e-12);
        let mut steep = VelocityEstimator::default();
        steep.update(0.0, DVec3::ZERO);
        assert!(steep.update(5e-324, DVec3::X * 1e300).is_finite());
    }

    #[test]
    fn the_cutoff_is_checked() {
        assert!(VelocityEstimator::new(1.0).is_ok());
        assert_eq!(VelocityEstimator::new(0.0).unwrap_err().field, "velocity_cutoff_hz");
        assert!(VelocityEstimator::new(f64::NAN).is_err());
    }
}
