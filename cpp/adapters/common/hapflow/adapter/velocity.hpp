// Velocity of a hand whose host gives none, or a noisy one.
#ifndef HAPFLOW_ADAPTER_VELOCITY_HPP
#define HAPFLOW_ADAPTER_VELOCITY_HPP

#include <hapflow/hapflow.hpp>

#include <cmath>
#include <cstddef>

namespace hapflow::adapter {

/// Differences of positions through a first-order low pass that is exact for uneven ticks, as the library's own devices
/// have it. A repeated sample, which some drivers give, makes no peak of twice the velocity. It starts at rest, and anew
/// after a gap, and after a sample that is no number.
class VelocityEstimator {
public:
    /// `cutoff_hz`: of the low pass, Hz. 70 lets a hand's fastest motion through with 2.3 ms of delay.
    explicit VelocityEstimator(double cutoff_hz = 70) noexcept : cutoff_hz_(cutoff_hz) {}

    /// Takes the position (m) `dt_s` after the last, and gives the velocity, m/s. [servo]
    Vec3 update(const Vec3& position, double dt_s) noexcept {
        if (!known_ || !(dt_s <= longest_gap_s)) {
            velocity_ = {};
        } else if (dt_s > 0) {
            const double share = -std::expm1(-two_pi * cutoff_hz_ * dt_s);
            for (std::size_t i = 0; i < 3; i++) {
                velocity_[i] += share * ((position[i] - last_[i]) / dt_s - velocity_[i]);
            }
        }
        last_ = position;
        known_ = std::isfinite(position[0] + position[1] + position[2]);
        return velocity_;
    }

    /// Forgets every sample. [servo]
    void reset() noexcept { *this = VelocityEstimator(cutoff_hz_); }

private:
    static constexpr double two_pi = 6.283185307179586;
    static constexpr double longest_gap_s = 0.1;

    double cutoff_hz_;
    bool known_ = false;
    Vec3 last_{};
    Vec3 velocity_{};
};

} // namespace hapflow::adapter

#endif
