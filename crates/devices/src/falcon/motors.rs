//! Motor counts: what a torque is on the wire.

use glam::DVec3;

/// Largest motor count either way: what the maker's own software sends at most.
pub const MAX_MOTOR_COUNTS: i16 = 4095;

/// The motor counts for `torques` (N·m at the arms' axes), `counts_per_nm` each; a positive count pulls its arm in.
/// Where one would be beyond [`MAX_MOTOR_COUNTS`] all are made smaller by the same factor, so that the force keeps its
/// direction. Torques that are not finite give none.
pub fn motor_counts(torques: DVec3, counts_per_nm: f64) -> [i16; 3] {
    let wanted = torques * -counts_per_nm;
    if !wanted.is_finite() {
        return [0; 3];
    }
    let limit = f64::from(MAX_MOTOR_COUNTS);
    let scale = (limit / wanted.abs().max_element()).min(1.0);
    // Nothing asked: 0 times a scale of 1.
    (wanted * scale).to_array().map(|count| count.round() as i16)
}

/// The torques that these counts give, N·m.
pub fn torques_of<C: Into<f64>>(counts: [C; 3], counts_per_nm: f64) -> DVec3 {
    DVec3::from_array(counts.map(C::into)) / -counts_per_nm
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_stay_in_range_and_direction() {
        assert_eq!(motor_counts(DVec3::new(0.1, -0.2, 0.0), 10_000.0), [-1000, 2000, 0]);
        assert_eq!(motor_counts(DVec3::new(0.8, -2.0, 0.4), 10_000.0), [-1638, 4095, -819]);
        assert_eq!(motor_counts(DVec3::new(f64::MAX, 0.0, f64::MIN), 1.0), [-4095, 0, 4095]);
        for torques in [DVec3::ZERO, DVec3::NAN, DVec3::INFINITY, DVec3::splat(f64::MAX) * 10.0] {
            assert_eq!(motor_counts(torques, 1e4), [0; 3]);
        }
        assert_eq!(torques_of([-1000, 2000, 0], 10_000.0), DVec3::new(0.1, -0.2, 0.0));
    }
}
