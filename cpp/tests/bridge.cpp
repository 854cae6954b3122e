// The wrapper over the cxx bridge, beside the one over the C interface: one libhapflow, and one session, for both.
#include <hapflow/cxx.hpp>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#define CHECK(condition)                                                                    \
    do {                                                                                    \
        if (!(condition)) {                                                                 \
            std::fprintf(stderr, "%s:%d: %s\n", __FILE__, __LINE__, #condition);            \
            std::exit(1);                                                                   \
        }                                                                                   \
    } while (false)

// Of a library with the feature test-hooks alone.
extern "C" void hapflow_test_panic_next_call(void);

static hapflow::Config jet() {
    hapflow::Config config;
    config.toml = R"([run]
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
[[obstacle]]
name = "ball"
radius = 0.01
position = [0.05, 0.0, 0.0]
[gate]
ramp_in = 0.02
)";
    config.threads = 1;
    return config;
}

static hapflow::ToolState at(int tick) {
    hapflow::ToolState state;
    state.time_s = tick * 1e-3;
    state.position[0] = 0.002 * std::sin(20 * state.time_s);
    return state;
}

template <class Call>
static hapflow_result code_of(Call call, const std::string& says = {}) {
    try {
        call();
    } catch (const hapflow::Error& error) {
        if (std::string(error.what()).find(says) == std::string::npos) {
            std::fprintf(stderr, "%s\n", error.what());
            std::exit(1);
        }
        return error.code();
    }
    return 0;
}

static void the_force_is_the_same_over_both_roads() {
    hapflow::Session c(jet());
    hapflow::cxx::Session over_cxx(jet());
    double most = 0;
    for (int tick = 0; tick < 300; tick++) {
        c.fluid_advance(tick * 1e-3);
        over_cxx.fluid_advance(tick * 1e-3);
        const hapflow::Tick a = c.tick(at(tick)), b = over_cxx.tick(at(tick));
        CHECK(a.result == b.result && a.wrench.force == b.wrench.force && a.wrench.torque == b.wrench.torque);
        most = std::fmax(most, std::fabs(a.wrench.force[1]));
    }
    CHECK(most > 0.1);
    CHECK(over_cxx.report().tick == 300 && over_cxx.report().tick == c.report().tick);
}

static void a_session_is_shared() {
    hapflow::Session owner(jet());
    {
        auto shared = hapflow::cxx::Session::share(owner.handle());
        CHECK(shared.handle().id == owner.handle().id && shared.tool_count() == 1 && shared.obstacle_count() == 1);
        shared.set("source.tap.speed", 1.25);
        shared.set("gate.max_force", std::string("3"));
        // Ticks of one and of the other are those of one tool.
        CHECK(shared.tick(at(0)).ok() && owner.tick(at(1)).ok() && shared.tick(at(2)).ok());
        CHECK(owner.report().tick == 3);
    }
    CHECK(owner.get("source.tap.speed") == 1.25 && owner.get("gate.max_force") == 3);
    CHECK(owner.tick(at(3)).ok()); // it is still there

    hapflow::cxx::Session other(jet());
    hapflow_report report;
    CHECK(hapflow_report_init(&report, sizeof report) == 0);
    CHECK(hapflow_session_report(other.handle(), &report) == 0); // and the other way, by C
    owner.destroy();
    CHECK(code_of([&] { static_cast<void>(hapflow::cxx::Session::share(owner.handle())); }) == HAPFLOW_ERROR_HANDLE);
}

static void what_is_wrong_is_said() {
    hapflow::Config config = jet();
    config.settings = "fluid.viscosity = -1";
    CHECK(code_of([&] { hapflow::cxx::Session s(config); }, "session: settings:1: fluid.viscosity = -1: must be a number from 0") ==
          HAPFLOW_ERROR_VALUE);
    config.settings = std::string("a\0b", 3);
    CHECK(code_of([&] { hapflow::cxx::Session s(config); }) == HAPFLOW_ERROR_TEXT);
    config.settings = "\xff";
    CHECK(code_of([&] { hapflow::cxx::Session s(config); }) == HAPFLOW_ERROR_TEXT);
    config = jet();
    config.servo_drive = HAPFLOW_DRIVE_OWNED;
    CHECK(code_of([&] { hapflow::cxx::Session s(config); }) == HAPFLOW_ERROR_UNSUPPORTED);

    hapflow::cxx::Session session(jet());
    CHECK(code_of([&] { session.set("source.tap.sped", 1.0); }, "source.tap.speed") == HAPFLOW_ERROR_SETTING);
    CHECK(code_of([&] { session.set("source.tap.speed", std::numeric_limits<double>::infinity()); }) < 0);
    CHECK(session.get<std::string>("source.tap.speed") == "1.5");
    CHECK(session.move_obstacle(7, {}) == HAPFLOW_ERROR_INDEX && session.publish_obstacles() == 0);
    CHECK(session.limit_force(1e9, 0) == HAPFLOW_ERROR_VALUE);
    hapflow::ToolState bad = at(0);
    bad.position[0] = std::numeric_limits<double>::quiet_NaN();
    const hapflow::Tick tick = session.tick(bad);
    CHECK(tick.result == HAPFLOW_ERROR_NOT_FINITE && tick.wrench.force == hapflow::Vec3{});
    session.clear_faults();
    CHECK(session.tick(at(1)).ok() && session.emergency_stop() == 0);
}

static void a_session_that_was_moved_from_is_null() {
    hapflow::cxx::Session first(jet());
    const auto id = first.handle().id;
    hapflow::cxx::Session second(std::move(first));
    CHECK(second.handle().id == id && first.handle().id == 0);
    CHECK(first.tick(at(0)).result == HAPFLOW_ERROR_HANDLE && first.publish_obstacles() == HAPFLOW_ERROR_HANDLE);
    CHECK(code_of([&] { static_cast<void>(first.tool_count()); }) == HAPFLOW_ERROR_HANDLE);
    first = std::move(second);
    CHECK(first.tick(at(0)).ok());
    first.destroy();
    CHECK(first.tick(at(1)).result == HAPFLOW_ERROR_HANDLE);
}

static void particles_go_where_there_is_room() {
    hapflow::Config config;
    config.scene = "tap";
    config.settings = "fluid.spacing = 0.01";
    hapflow::cxx::Session session(config);
    session.fluid_advance(0.1);
    const std::size_t count = session.particles({});
    CHECK(count > 3);
    std::array<float, 7> few{};
    few[6] = -7;
    CHECK(session.particles({few.data(), few.size()}) == count && few[1] != 0 && few[6] == -7);
    std::vector<float> all;
    session.latest_particles(all);
    session.fluid_step(0.12);
    session.latest_particles(all);
    CHECK(all.size() % 3 == 0 && all.size() >= 3 * count);
}

static void a_panic_of_the_library_is_a_result() {
    hapflow::cxx::Session session(jet());
    hapflow_test_panic_next_call();
    const hapflow::Tick tick = session.tick(at(0));
    CHECK(tick.result == HAPFLOW_ERROR_PANIC && tick.wrench.force == hapflow::Vec3{});
    hapflow_test_panic_next_call();
    CHECK(code_of([&] { session.set("source.tap.speed", 1.0); }, "a panic inside") == HAPFLOW_ERROR_PANIC);
}

int main() {
    the_force_is_the_same_over_both_roads();
    a_session_is_shared();
    what_is_wrong_is_said();
    a_session_that_was_moved_from_is_null();
    particles_go_where_there_is_room();
    a_panic_of_the_library_is_a_result();
    std::puts("all passed");
}
