// What the adapters' tests share: a jet whose force costs nothing, a clock that a test sets, and the force by the plain
// wrapper for the same motion.
#ifndef HAPFLOW_TESTS_ADAPTERS_SUPPORT_HPP
#define HAPFLOW_TESTS_ADAPTERS_SUPPORT_HPP

#include <hapflow/adapter/fluid.hpp>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <vector>

#define CHECK(condition)                                                                    \
    do {                                                                                    \
        if (!(condition)) {                                                                 \
            std::fprintf(stderr, "%s:%d: %s\n", __FILE__, __LINE__, #condition);            \
            std::exit(1);                                                                   \
        }                                                                                   \
    } while (false)

inline const double nan_value = std::numeric_limits<double>::quiet_NaN();
inline const double period_s = 1.0 / 1024; ///< Of a tick: exact on any clock that begins with a whole number.
inline double clock_s = 0; ///< What the adapters' clocks say.

inline hapflow::adapter::Options jet() {
    hapflow::adapter::Options options("");
    options.config.toml = R"([run]
duration = 0.2
fluid_hz = 100
backend = "analytic-jet"
device = "null"
[bounds]
min = [-0.1, -0.12, -0.1]
max = [0.1, 0.12, 0.1]
[[source]]
name = "tap"
position = [0.0, 0.05, 0.0]
diameter = 0.02
speed = 1.5
[gate]
ramp_in = 0.02
)";
    options.config.fluid_drive = HAPFLOW_DRIVE_HOST;
    options.velocity_cutoff_hz = 0; // velocities as they are given
    options.clock = [] { return clock_s; };
    return options;
}

/// A hand that bobs under the jet and crosses it.
inline hapflow::ToolState motion(int tick) {
    hapflow::ToolState state;
    state.time_s = tick * period_s;
    state.dt_s = tick == 0 ? 0.001 : period_s;
    const double a = 6.283185307179586 * 4 * state.time_s;
    state.position = {{0.004 * std::sin(a), 0.003 * std::cos(a), 0.002 * std::sin(2 * a)}};
    const double w = 6.283185307179586 * 4;
    state.velocity = {{0.004 * w * std::cos(a), -0.003 * w * std::sin(a), 0.004 * w * std::cos(2 * a)}};
    return state;
}

/// What the plain wrapper feels on that way.
inline std::vector<hapflow::Wrench> expected(int ticks) {
    hapflow::Config config = jet().config;
    hapflow::Session session(config);
    std::vector<hapflow::Wrench> felt;
    for (int tick = 0; tick < ticks; tick++) {
        hapflow::ToolState state = motion(tick);
        session.fluid_advance(state.time_s);
        felt.push_back(session.tick(state).wrench);
    }
    return felt;
}

inline double length(const hapflow::Vec3& v) { return std::hypot(v[0], v[1], v[2]); }

/// Equal to rounding.
inline bool near(const hapflow::Vec3& a, const hapflow::Vec3& b, double within = 1e-12) {
    return length({{a[0] - b[0], a[1] - b[1], a[2] - b[2]}}) <= within * (1 + length(b));
}

#endif
