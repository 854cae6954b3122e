// The last thing that a force passes before it leaves an adapter.
#ifndef HAPFLOW_ADAPTER_LIMITER_HPP
#define HAPFLOW_ADAPTER_LIMITER_HPP

#include <hapflow/hapflow.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace hapflow::adapter {

/// Finite, of limited size, and changing at a limited rate. What is within both limits passes as it is. Zero, and what is
/// not finite, takes the force off at once. For forces (N) and torques (N m).
class Limiter {
public:
    /// `max_size`: N; `max_slew`: N/s. Neither is negative.
    Limiter(double max_size, double max_slew) noexcept : max_size_(max_size), max_slew_(max_slew) {}

    /// What may leave `dt_s` after the last time; more than 10 ms counts as 10 ms. [servo]
    Vec3 limit(const Vec3& wanted, double dt_s) noexcept {
        const double size = length(wanted);
        if (size == 0 || !std::isfinite(size)) {
            return last_ = {};
        }
        const Vec3 shortened = toward({}, wanted, size, max_size_);
        const double dt = dt_s > 0 ? std::min(dt_s, longest_dt_s) : 0;
        const double change = length({shortened[0] - last_[0], shortened[1] - last_[1], shortened[2] - last_[2]});
        return last_ = toward(last_, shortened, change, max_slew_ * dt);
    }

    /// The force is off. [servo]
    void reset() noexcept { last_ = {}; }

private:
    static constexpr double longest_dt_s = 0.01;

    static double length(const Vec3& v) noexcept { return std::hypot(v[0], v[1], v[2]); }

    /// From `from` towards `to`, which is `distance` away, but no further than `most`.
    static Vec3 toward(const Vec3& from, const Vec3& to, double distance, double most) noexcept {
        if (distance <= most) {
            return to;
        }
        Vec3 v{};
        for (std::size_t i = 0; i < 3; i++) {
            v[i] = from[i] + (to[i] - from[i]) * (most / distance);
        }
        return v;
    }

    double max_size_;
    double max_slew_;
    Vec3 last_{};
};

} // namespace hapflow::adapter

#endif
