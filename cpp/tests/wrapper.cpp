// Every function of hapflow.hpp, as a host uses it and as it should not. Says what failed, and exits with 1.
#include <hapflow/hapflow.hpp>

#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <locale>
#include <string>
#include <thread>
#include <type_traits>
#include <utility>
#include <vector>

static int failed = 0;
#define CHECK(...) \
    do { \
        if (!(__VA_ARGS__)) { \
            std::printf("%s:%d: %s\n", __FILE__, __LINE__, #__VA_ARGS__); \
            failed++; \
        } \
    } while (false)

using hapflow::Body;
using hapflow::BodyList;
using hapflow::Box;
using hapflow::Config;
using hapflow::Device;
using hapflow::DeviceConfig;
using hapflow::Error;
using hapflow::Obstacle;
using hapflow::Scene;
using hapflow::Session;
using hapflow::Shape;
using hapflow::Source;
using hapflow::Tick;
using hapflow::Tool;
using hapflow::ToolState;
using hapflow::Vec3;
using hapflow::Wrench;

// What must not compile, or must not throw.
static_assert(!std::is_copy_constructible_v<Session> && !std::is_copy_assignable_v<Session>);
static_assert(std::is_nothrow_move_constructible_v<Session> && std::is_nothrow_move_assignable_v<Session>);
static_assert(std::is_nothrow_destructible_v<Session>);
static_assert(!std::is_copy_constructible_v<Device> && !std::is_copy_assignable_v<Device>);
static_assert(std::is_nothrow_move_constructible_v<Device> && std::is_nothrow_move_assignable_v<Device>);
static_assert(noexcept(std::declval<Device&>().read(0, std::declval<ToolState&>())));
static_assert(noexcept(std::declval<Device&>().write(Wrench{}, 0)));
static_assert(!std::is_copy_constructible_v<Scene> && !std::is_copy_assignable_v<Scene>);
static_assert(std::is_nothrow_move_constructible_v<Scene> && std::is_nothrow_move_assignable_v<Scene>);
static_assert(std::is_nothrow_copy_constructible_v<Error> && std::is_base_of_v<std::runtime_error, Error>);
static_assert(noexcept(std::declval<Session&>().tick(ToolState{})));
static_assert(noexcept(std::declval<Session&>().emergency_stop()));
static_assert(noexcept(std::declval<Session&>().limit_force(1, 1)));
static_assert(noexcept(std::declval<Session&>().move_obstacle(0, Vec3{})));
static_assert(noexcept(std::declval<Session&>().publish_obstacles()));
static_assert(std::is_trivially_copyable_v<Tick> && std::is_trivially_copyable_v<ToolState>);

// From another file of this program: the header is there twice.
std::uint32_t negotiated_elsewhere();

// A jet in closed form on a ball at rest: a force at no cost.
static const char* const jet = R"(
[run]
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

// To be put behind it: a second tool in a jet of its own, and a plate beside it.
static const char* const more = R"(
[[source]]
name = "right"
position = [0.06, 0.05, 0.0]
diameter = 0.02
speed = 1.0
[[tool]]
[[tool]]
name = "second"
position = [0.06, 0.0, 0.0]
[[obstacle]]
name = "plate"
position = [-0.06, 0.0, 0.0]
)";

static Session open_jet(const char* settings = "") {
    Config config;
    config.toml = jet;
    config.settings = settings;
    return Session(config);
}

static bool zero(const Wrench& w) {
    for (std::size_t i = 0; i < 3; i++) {
        if (w.force[i] != 0 || w.torque[i] != 0) {
            return false;
        }
    }
    return true;
}

// Ticks at rest at `from` ms to `to` ms, with the fluid; the last one.
static Tick run(Session& session, int from, int to) {
    ToolState state;
    Tick tick;
    for (int n = from; n < to; n++) {
        state.time_s = n * 1e-3;
        session.fluid_advance(state.time_s);
        tick = session.tick(state);
        CHECK(tick.ok());
    }
    return tick;
}

// That `body` throws an Error of this code, whose text has all these parts.
template <class Body>
static void throws(int line, hapflow_result code, std::vector<std::string> parts, Body body) {
    try {
        body();
        std::printf("line %d: nothing was thrown\n", line);
        failed++;
    } catch (const Error& error) {
        bool good = error.code() == code && std::strstr(error.what(), error.detail()) != nullptr;
        for (const std::string& part : parts) {
            good = good && std::string(error.what()).find(part) != std::string::npos;
        }
        if (!good) {
            std::printf("line %d: %d, \"%s\", \"%s\"\n", line, error.code(), error.what(), error.detail());
            failed++;
        }
    }
}
#define THROWS(code, parts, ...) throws(__LINE__, code, std::vector<std::string> parts, [&] { __VA_ARGS__; })

static void versions() {
    CHECK(hapflow::negotiate() == HAPFLOW_ABI_VERSION);
    CHECK(negotiated_elsewhere() == HAPFLOW_ABI_VERSION);
    CHECK(hapflow::version() == hapflow_version() && hapflow::version() > 0);
}

static void what_the_library_has() {
    CHECK(hapflow::build_info().find("\nscenes = tap ") != std::string::npos);
    bool tap = false;
    for (const hapflow::SceneInfo& scene : hapflow::scenes()) {
        tap = tap || std::string(scene.name) == "tap";
        CHECK(std::strstr(scene.toml, "[run]") != nullptr && std::strlen(scene.about) > 0);
    }
    CHECK(tap);
    bool hand = false;
    for (const hapflow::DeviceInfo& device : hapflow::devices()) {
        hand = hand || (std::string(device.name) == "hand" && device.max_force > 0);
    }
    CHECK(hand);

    std::vector<hapflow::Setting> settings;
    {
        const Session session = open_jet();
        settings = session.settings();
    } // and they outlive it
    std::size_t known = 0;
    for (const hapflow::Setting& s : settings) {
        if (s.path == "fluid.viscosity") {
            known += s.kind == HAPFLOW_SETTING_NUMBER && s.live && s.min == 0 && s.max == 10000 && s.group == "fluid";
            known += s.usual == "0.001" && s.unit == "Pa\u00b7s" && !s.about.empty() && s.choices.empty();
        } else if (s.path == "fluid.mode") {
            known += s.choices == std::vector<std::string>{"full", "none", "mixed"} && s.live;
        } else if (s.path == "run.fluid_hz") {
            known += !s.live && s.kind == HAPFLOW_SETTING_NUMBER;
        } else if (s.path == "source.tap.on") {
            known += s.kind == HAPFLOW_SETTING_SWITCH;
        }
    }
    CHECK(known == 5);
}

static void errors() {
    const Error plain(HAPFLOW_ERROR_BUSY, "here", "");
    CHECK(plain.code() == HAPFLOW_ERROR_BUSY);
    CHECK(std::string(plain.detail()) == hapflow_result_text(HAPFLOW_ERROR_BUSY));
    CHECK(std::string(plain.what()) == std::string("here: ") + plain.detail());
    const Error copy(Error(HAPFLOW_ERROR_VALUE, "there", "x = 1: no"));
    CHECK(std::string(copy.what()) == "there: x = 1: no" && std::string(copy.detail()) == "x = 1: no");
}

static void creation_fails_with_the_reason() {
    Config config;
    THROWS(HAPFLOW_ERROR_SCENE, {"session: exactly one of scene, toml and built"}, Session{config});
    config.scene = "no-such-scene";
    THROWS(HAPFLOW_ERROR_NOT_FOUND, {"no-such-scene"}, Session{config});
    config.scene = std::string("tap\0", 4);
    THROWS(HAPFLOW_ERROR_TEXT, {"scene: a text with a NUL inside"}, Session{config});
    config.scene = "tap";
    config.settings = "fluid.viscosity = -1";
    THROWS(HAPFLOW_ERROR_VALUE, ({"settings:1: fluid.viscosity = -1", "from 0 to 10000"}), Session{config});
    config.settings.clear();
    config.threads = 100000;
    THROWS(HAPFLOW_ERROR_VALUE, {"threads = 100000"}, Session{config});
    config.scene.clear();
    config.threads = 0;
    config.toml = "[run]\nduration = soon\n";
    THROWS(HAPFLOW_ERROR_SCENE, {"2"}, Session{config});
    config.toml = jet + std::string("\0no such line", 13); // its length counts, not its first NUL
    THROWS(HAPFLOW_ERROR_SCENE, {}, Session{config});
    config.toml = "\xff";
    THROWS(HAPFLOW_ERROR_TEXT, {}, Session{config});
}

static void a_tick_gives_force() {
    Session session = open_jet();
    const Tick tick = run(session, 0, 200);
    CHECK(tick.result == HAPFLOW_OK && std::string(tick.text()) == hapflow_result_text(HAPFLOW_OK));
    CHECK(tick.wrench.force[1] < -0.05 && std::abs(tick.wrench.force[0]) < 0.01);

    const hapflow::Report report = session.report();
    CHECK(report.tick == 200 && report.faults == 0 && report.force[1] == tick.wrench.force[1]);
    CHECK(report.fluid_frame == 19 && report.time_s == 0.199);
}

static void a_tick_carries_every_field() {
    Session session = open_jet();
    ToolState state;
    state.time_s = 0.25;
    state.position = {0.01, 0.02, 0.03};
    CHECK(session.tick(state).ok());
    const hapflow::Report report = session.report();
    CHECK(report.time_s == 0.25);
    CHECK(report.position[0] == 0.01 && report.position[1] == 0.02 && report.position[2] == 0.03);

    state.dt_s = 0;
    CHECK(session.tick(state).result == HAPFLOW_REMARK_NO_TIME);
    state.dt_s = 0.02;
    CHECK(session.tick(state).result == HAPFLOW_REMARK_LATE);
    // One wrong field each: it has to arrive to be refused.
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto refused = [&](hapflow_result code, auto change) {
        session.clear_faults();
        ToolState wrong;
        wrong.time_s = 0.25;
        change(wrong);
        const Tick tick = session.tick(wrong);
        CHECK(tick.result == code && !tick.ok() && zero(tick.wrench));
        CHECK((session.report().faults & HAPFLOW_FAULT_INPUT) != 0);
    };
    refused(HAPFLOW_ERROR_TIME, [&](ToolState& s) { s.time_s = 0.2; });
    refused(HAPFLOW_ERROR_INDEX, [&](ToolState& s) { s.tool = 1; });
    refused(HAPFLOW_ERROR_ORIENTATION, [&](ToolState& s) { s.orientation = {0, 0, 0, 2}; });
    refused(HAPFLOW_ERROR_VALUE, [&](ToolState& s) { s.position[2] = 2000; });
    refused(HAPFLOW_ERROR_NOT_FINITE, [&](ToolState& s) { s.velocity[1] = nan; });
    refused(HAPFLOW_ERROR_NOT_FINITE, [&](ToolState& s) { s.angular_velocity[0] = nan; });
    session.clear_faults();
    state.dt_s = 0.001;
    state.buttons = 5;
    CHECK(session.tick(state).result == HAPFLOW_OK);
}

// A disc that is half in the jet is tilted.
static void a_tick_gives_torque() {
    Config config;
    config.scene = "tap";
    config.settings = "fluid.spacing = 0.01\nrun.fluid_hz = 60\ntool.shape = disc\ntool.radius = 0.04\n";
    Session session(config);
    ToolState state;
    state.position[0] = 0.03;
    Tick tick;
    for (int n = 0; n < 400; n++) {
        state.time_s = n * 1e-3;
        session.fluid_advance(state.time_s);
        tick = session.tick(state);
    }
    const hapflow::Report report = session.report();
    for (std::size_t i = 0; i < 3; i++) {
        CHECK(tick.wrench.torque[i] == report.torque[i] && tick.wrench.force[i] == report.force[i]);
    }
    CHECK(tick.wrench.torque[2] > 1e-4);
}

static void a_stop_holds_until_it_is_cleared() {
    Session session = open_jet();
    CHECK(!zero(run(session, 0, 100).wrench));
    CHECK(session.emergency_stop() == HAPFLOW_OK);
    const Tick held = run(session, 100, 200);
    CHECK(held.result == HAPFLOW_REMARK_FORCE_HELD && zero(held.wrench));
    CHECK((session.report().faults & HAPFLOW_FAULT_EMERGENCY_STOP) != 0);
    session.clear_faults();
    CHECK(!zero(run(session, 200, 300).wrench));
}

// As in German.
struct Comma : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
};

static void vectors_are_read_in_every_locale() {
    const Session session = open_jet();
    const std::locale before = std::locale::global(std::locale(std::locale::classic(), new Comma));
    CHECK(session.get<Vec3>("fluid.gravity") == Vec3{{0, -9.81, 0}});
    std::locale::global(before);
}

static void settings() {
    Session session = open_jet("fluid.viscosity = 0.5");
    CHECK(session.get("fluid.viscosity") == 0.5);
    session.set("fluid.viscosity", 0.25);
    CHECK(session.get<double>("fluid.viscosity") == 0.25);
    session.set("tool.force_scale", 2); // an int is a number
    CHECK(session.get("tool.force_scale") == 2);

    session.set("source.tap.on", false);
    CHECK(!session.get<bool>("source.tap.on") && session.get<std::string>("source.tap.on") == "false");
    session.set("source.tap.on", "true"); // and a literal is a text
    CHECK(session.get<bool>("source.tap.on") && session.get("source.tap.on") == 1);

    const Vec3 gravity{{0.125, -1e-7, 30}};
    session.set("fluid.gravity", gravity);
    CHECK(session.get<Vec3>("fluid.gravity") == gravity);
    session.set("fluid.gravity", {0, -9.81, 0});
    CHECK(session.get<Vec3>("fluid.gravity") == Vec3{{0, -9.81, 0}});
    session.set("fluid.gravity", std::string("[0, -3, 0]"));
    CHECK(session.get<std::string>("fluid.gravity") == "[0, -3, 0]");
    session.set("fluid.mode", "none");
    CHECK(session.get<std::string>("fluid.mode") == "none");

    THROWS(HAPFLOW_ERROR_VALUE, {"set: fluid.viscosity = -1: must be a number from 0 to 10000 Pa"},
           session.set("fluid.viscosity", -1.0));
    CHECK(session.get("fluid.viscosity") == 0.25);
    THROWS(HAPFLOW_ERROR_SETTING, ({"set: ", "fluid.viscosity"}), session.set("fluid.viscosty", 1.0));
    THROWS(HAPFLOW_ERROR_FIXED, {"run.fluid_hz"}, session.set("run.fluid_hz", 60));
    THROWS(HAPFLOW_ERROR_NOT_FINITE, {"fluid.gravity"}, session.set("fluid.gravity", {0, HUGE_VAL, 0}));
    THROWS(HAPFLOW_ERROR_VALUE, {"tool.radius"}, session.set("tool.radius", true));
    THROWS(HAPFLOW_ERROR_TEXT, {"NUL"}, session.set(std::string("a\0b", 3), 1.0));
    THROWS(HAPFLOW_ERROR_TEXT, {"NUL"}, session.set("fluid.mode", std::string("no\0ne", 5)));
    THROWS(HAPFLOW_ERROR_SETTING, {"get: "}, static_cast<void>(session.get("no.such")));
    THROWS(HAPFLOW_ERROR_VALUE, {"fluid.mode"}, static_cast<void>(session.get("fluid.mode")));
    THROWS(HAPFLOW_ERROR_VALUE, {"tool.radius"}, static_cast<void>(session.get<bool>("tool.radius")));
    THROWS(HAPFLOW_ERROR_VALUE, {"fluid.viscosity = 0.25: not three numbers"},
           static_cast<void>(session.get<Vec3>("fluid.viscosity")));
}

static void fluid_and_particles() {
    Config config;
    config.scene = "tap";
    config.settings = "fluid.spacing = 0.01\nrun.fluid_hz = 60";
    config.threads = 1;
    Session session(config);
    CHECK(session.particles().empty());
    session.fluid_advance(0.2);
    CHECK(session.report().fluid_frame == 12);
    session.fluid_step(0.25);
    CHECK(session.report().fluid_frame == 13);

    std::vector<float> positions(7, 1.0F);
    session.particles(positions);
    CHECK(positions.size() == session.report().particles * 3 && positions.size() > 30);
    CHECK(positions == session.particles());
    for (const float coordinate : positions) {
        CHECK(std::abs(coordinate) < 1);
    }

    THROWS(HAPFLOW_ERROR_TIME, {"fluid_step: "}, session.fluid_step(0.25));
    THROWS(HAPFLOW_ERROR_TIME, {"fluid_advance: "}, session.fluid_advance(100));
    THROWS(HAPFLOW_ERROR_NOT_FINITE, {"fluid_advance: "}, session.fluid_advance(HUGE_VAL));
    // The detail is of this error, not of a [main] function's before it.
    THROWS(HAPFLOW_ERROR_SETTING, {"no.such"}, session.set("no.such", 1));
    THROWS(HAPFLOW_ERROR_TIME, {hapflow_result_text(HAPFLOW_ERROR_TIME)}, session.fluid_step(0.1));
}

static void several_tools_and_obstacles() {
    Config config;
    config.toml = std::string(jet) + more;
    Session session(config);
    CHECK(session.tool_count() == 2 && session.obstacle_count() == 1);
    ToolState first, second;
    second.tool = 1;
    second.position[0] = 0.06;
    Tick ticks[2];
    for (int n = 0; n < 200; n++) {
        first.time_s = second.time_s = n * 1e-3;
        CHECK(session.move_obstacle(0, {{-0.06, n * 1e-5, 0}}) == HAPFLOW_OK);
        CHECK(session.publish_obstacles() == HAPFLOW_OK);
        session.fluid_advance(first.time_s);
        ticks[0] = session.tick(first);
        ticks[1] = session.tick(second);
    }
    CHECK(ticks[0].ok() && ticks[1].ok());
    CHECK(ticks[1].wrench.force[1] < -0.05 && ticks[0].wrench.force[1] < 1.3 * ticks[1].wrench.force[1]);
    CHECK(session.report().force[1] == ticks[0].wrench.force[1]);
    CHECK(session.report(1).force[1] == ticks[1].wrench.force[1]);
    THROWS(HAPFLOW_ERROR_INDEX, {"report: no tool 2"}, static_cast<void>(session.report(2)));

    CHECK(session.move_obstacle(1, Vec3{}) == HAPFLOW_ERROR_INDEX);
    CHECK(session.move_obstacle(0, Vec3{}, {{0, 0, 0, 2}}) == HAPFLOW_ERROR_ORIENTATION);
    CHECK(session.move_obstacle(0, {{HUGE_VAL, 0, 0}}) == HAPFLOW_ERROR_NOT_FINITE);
}

static void a_session_that_steps_its_fluid() {
    Config config;
    config.toml = jet;
    config.settings = "run.backend = cpu\nfluid.spacing = 0.01";
    config.threads = 1;
    config.fluid_drive = HAPFLOW_DRIVE_OWNED;
    Session session(config);
    THROWS(HAPFLOW_ERROR_DRIVE, {"fluid_advance: "}, session.fluid_advance(1));
    THROWS(HAPFLOW_ERROR_DRIVE, {"particles: "}, static_cast<void>(session.particles()));
    std::vector<float> positions(7, 1.0F);
    session.latest_particles(positions);
    CHECK(positions.empty());
    ToolState state;
    for (int n = 0; n < 20000 && positions.size() < 30; n++) {
        state.time_s = n * 1e-3;
        CHECK(session.tick(state).ok());
        session.latest_particles(positions);
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    CHECK(positions.size() >= 30 && positions.size() % 3 == 0);
    for (const float coordinate : positions) {
        CHECK(std::abs(coordinate) < 1);
    }
    config.fluid_drive = 2;
    THROWS(HAPFLOW_ERROR_UNSUPPORTED, {"fluid_drive = 2"}, Session{config});
}

static Device open_device(const char* name, const char* settings = "") {
    DeviceConfig config;
    config.name = name;
    config.settings = settings;
    return Device(config);
}

// A hand that wants to rest is pressed down for `from` to `to` ms; where it is then, mm.
static double pressed(Device& device, int from, int to, const Wrench& wrench) {
    ToolState state;
    state.tool = 3;
    for (int n = from; n < to; n++) {
        CHECK(device.read(n * 1e-3, state) == HAPFLOW_OK);
        CHECK(state.time_s == n * 1e-3 && state.tool == 3);
        CHECK(device.write(wrench, state.dt_s) >= 0);
    }
    return state.position[1] * 1e3;
}

static void a_device_in_a_loop_of_the_host() {
    Wrench down;
    down.force[1] = -1.5;
    Device device = open_device("hand", "gate.ramp_in = 0.1\ntool.position = [0, 0.01, 0]");
    CHECK(std::abs(pressed(device, 0, 2000, down) - 5) < 0.1); // 300 N/m
    ToolState state;
    CHECK(device.read(1.0, state) == HAPFLOW_ERROR_TIME && state.position[1] == 0);
    Wrench wrong;
    wrong.torque[2] = HUGE_VAL;
    CHECK(device.write(wrong, 1e-3) == HAPFLOW_ERROR_NOT_FINITE);
    CHECK(device.write(down, 1e-3) == HAPFLOW_REMARK_FORCE_HELD);
    device.clear_faults();
    CHECK(device.write(down, 1e-3) == HAPFLOW_OK);

    Device moved(std::move(device));
    CHECK(device.handle().id == 0 && device.write(down, 1e-3) == HAPFLOW_ERROR_HANDLE); // on purpose
    moved.close();
    CHECK(moved.read(9, state) == HAPFLOW_ERROR_HANDLE);
    THROWS(HAPFLOW_ERROR_HANDLE, {"close"}, moved.close());
    THROWS(HAPFLOW_ERROR_HANDLE, {"clear_faults"}, moved.clear_faults());
    moved = open_device("null");
    CHECK(moved.read(0, state) == HAPFLOW_OK);
    THROWS(HAPFLOW_ERROR_NOT_FOUND, ({"device: ", "falcn"}), open_device("falcn"));
    THROWS(HAPFLOW_ERROR_VALUE, {"hand.mass = -1"}, open_device("hand", "hand.mass = -1"));
    // None is left behind.
    for (unsigned n = 0; n < 2 * HAPFLOW_MAX_DEVICES; n++) {
        open_device("null");
    }
}

static void a_session_that_ticks_its_servo() {
    Config config;
    config.toml = jet;
    std::vector<Device> devices;
    devices.push_back(open_device("null"));
    THROWS(HAPFLOW_ERROR_VALUE, {"device_count = 1"}, Session(config, std::move(devices)));
    ToolState state;
    CHECK(devices.size() == 1 && devices[0].read(0, state) == HAPFLOW_OK); // still here

    config.servo_drive = HAPFLOW_DRIVE_OWNED;
    config.fluid_drive = HAPFLOW_DRIVE_OWNED;
    Session session(config, std::move(devices));
    CHECK(devices[0].handle().id == 0);
    while (session.report().force[1] > -0.05) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    const Tick tick = session.tick(state);
    CHECK(tick.result == HAPFLOW_ERROR_DRIVE && zero(tick.wrench));
    const hapflow::ServoPace pace = session.servo_pace();
    CHECK(pace.owned == 1 && pace.running == 1 && pace.priority != HAPFLOW_PRIORITY_NOT_ASKED);
    CHECK(std::strcmp(pace.device, "null") == 0 && std::strlen(pace.priority_text) > 0);
    CHECK(Session(config).servo_pace().owned == 1); // with the scene's device
    CHECK(open_jet().servo_pace().owned == 0);
}

static void a_session_tells_its_log() {
    std::vector<std::string> told;
    Config config;
    config.toml = jet;
    config.log = [&](std::uint32_t level, const std::string& text) {
        CHECK(level == HAPFLOW_LOG_ERROR || level == HAPFLOW_LOG_INFO);
        told.push_back(text);
        if (text.find("emergency") == std::string::npos) {
            throw std::logic_error("not that");
        }
    };
    Session first(config);
    Session session(std::move(first)); // the log moves with it
    session.poll();
    CHECK(told.empty());
    CHECK(session.emergency_stop() == HAPFLOW_OK);
    session.poll();
    CHECK(told.size() == 1 && told[0].find("fault: emergency stop") == 0);
    ToolState wrong;
    wrong.time_s = HUGE_VAL;
    CHECK(!session.tick(wrong).ok());
    bool thrown = false;
    try {
        session.poll();
    } catch (const std::logic_error&) {
        thrown = true;
    }
    CHECK(thrown && told.size() == 2);
    session.poll();
    open_jet().poll(); // nobody listens
}

static void optional_parts() {
    const auto* device = hapflow::extension<hapflow_device_extension>();
    CHECK(device != nullptr && device->size == sizeof *device);
    CHECK(device->close(hapflow_device{}) == HAPFLOW_ERROR_HANDLE);
    const auto* log = hapflow::extension<hapflow_log_extension>();
    CHECK(log != nullptr && log->size == sizeof *log);
    CHECK(log->poll(hapflow_session{}) == HAPFLOW_ERROR_HANDLE);
    CHECK(hapflow_extension("hapflow.device/999") == nullptr);
}

// The jet above, by calls.
static Scene build_jet() {
    Scene scene;
    scene.set("run.duration", 0.2);
    scene.set("run.backend", "analytic-jet");
    scene.set("run.device", std::string("null"));
    scene.set("gate.ramp_in", 0.02);
    scene.set_bounds({{{-0.1, -0.12, -0.1}}, {{0.1, 0.12, 0.1}}});
    Source tap;
    tap.name = "tap";
    tap.position = {0, 0.05, 0};
    tap.speed = 1.5;
    CHECK(scene.add(tap) == 0);
    return scene;
}

static void scenes_are_built() {
    Scene scene = build_jet();
    scene.check();
    Config config;
    config.built = &scene;
    Session built(config);
    Session read = open_jet();
    CHECK(run(built, 0, 100).wrench.force == run(read, 0, 100).wrench.force);

    // What a struct says where nothing is set is what the library says.
    Scene plain;
    CHECK(plain.add(Source{}) == 0 && plain.add(Obstacle{}) == 0 && plain.add(Tool{}) == 1 && plain.add(Body{}) == 0);
    CHECK(plain.write() == "name = \"scene\"\n\n[[source]]\nname = \"0\"\n\n[[obstacle]]\nname = \"0\"\n\n"
                           "[[body]]\nname = \"0\"\n\n[[tool]]\nname = \"0\"\n\n[[tool]]\nname = \"1\"\n");

    // Every field arrives.
    Source source;
    source.name = "s";
    source.position = {0.1, 0.2, 0.3};
    source.direction = {1, 0, 0};
    source.diameter = 0.03;
    source.speed = 2;
    source.period = 0.5;
    source.duty = 0.25;
    source.on = false;
    Obstacle obstacle{"o", Shape::disc, 0.03, 0.004, {{0.1, 0, 0}}};
    Tool tool{"t", Shape::disc, 0.02, 0.003, 0.2, 0.5, {{0, 0.1, 0}}, 2, 300, 1};
    Body body;
    body.name = "b";
    body.shape = Shape::box;
    body.extent = {0.01, 0.02, 0.03};
    body.density = 600;
    body.position = {0, -0.2, 0};
    const Box box{{{-0.3, -0.3, -0.3}}, {{0.3, 0.3, 0.3}}};
    Scene full;
    CHECK(full.add(body) == 0);
    full.set_periodic(true, false, true);
    CHECK(full.add(source) == 0 && full.add(obstacle) == 0 && full.add(tool) == 1);
    CHECK(full.add_pool(box) == 0 && full.add_sink(box) == 0 && full.add_sink(box) == 1);
    full.set_ground(-0.4);
    full.set_container(box);
    full.set("fluid.gravity", {0, -1.5, 0});
    full.set("fluid.gravity", Vec3{{0, -1.6, 0}});
    full.set("fluid.two_way", false);
    full.add_change(0.5, "source.s.on = true\n");
    const std::string text = full.write();
    for (const char* part :
         {"direction = [1, 0, 0]", "diameter = 0.03", "speed = 2", "period = 0.5", "duty = 0.25", "on = false",
          "shape = \"disc\"", "radius = 0.03", "thickness = 0.004", "position = [0.1, 0, 0]", "thickness = 0.003",
          "mass = 0.2", "collision_response = 0.5", "force_scale = 2", "solid_stiffness = 300", "solid_damping = 1",
          "[[body]]", "size = [0.01, 0.02, 0.03]", "density = 600", "periodic = [\"x\", \"z\"]", "ground = -0.4", "[container]", "[[pool]]", "gravity = [0, -1.6, 0]", "two_way = false", "source.s.on = true"}) {
        CHECK(text.find(part) != std::string::npos);
    }
    CHECK(Scene::parse(text).write() == text);
    Config floating;
    floating.toml = "[[body]]\nposition = [0.1, 0, 0]\n";
    Session session(floating);
    session.fluid_advance(0.1);
    CHECK(session.body_report(BodyList::free, 0).velocity[1] < -0.5);
    THROWS(HAPFLOW_ERROR_INDEX, {"no body 1"}, static_cast<void>(session.body_report(BodyList::free, 1)));
    full.clear_ground();
    full.clear_container();
    CHECK(full.write().find("ground") == std::string::npos && full.write().find("[container]") == std::string::npos);
    CHECK(Scene::load("tap").write().find("name = \"tap\"") == 0);
}

static void scenes_refuse_and_move() {
    Scene scene = build_jet();
    const std::string before = scene.write();
    Source tap;
    tap.name = "tap";
    THROWS(HAPFLOW_ERROR_VALUE, {"add source: source.name = \"tap\""}, scene.add(tap));
    tap.name = std::string("t\0p", 3);
    THROWS(HAPFLOW_ERROR_TEXT, {"NUL"}, scene.add(tap));
    THROWS(HAPFLOW_ERROR_VALUE, {"add_pool: pool.min"}, scene.add_pool({{{1, 1, 1}}, {{0, 0, 0}}}));
    THROWS(HAPFLOW_ERROR_FIXED, {"add_change: "}, scene.add_change(1, "run.fluid_hz = 60"));
    THROWS(HAPFLOW_ERROR_NOT_FINITE, {"set_ground"}, scene.set_ground(HUGE_VAL));
    THROWS(HAPFLOW_ERROR_SETTING, {"set: "}, scene.set("fluid.viscosty", 1));
    THROWS(HAPFLOW_ERROR_NOT_FOUND, {"load: "}, static_cast<void>(Scene::load("tapp")));
    THROWS(HAPFLOW_ERROR_SCENE, {"parse: toml:1"}, static_cast<void>(Scene::parse("[fluid\n")));
    CHECK(scene.write() == before);
    scene.set("fluid.sound_speed", 2000);
    THROWS(HAPFLOW_ERROR_VALUE, {"check: the speed of sound is too high"}, scene.check());

    const hapflow_scene handle = scene.handle();
    Scene other(std::move(scene));
    CHECK(other.handle().id == handle.id && scene.handle().id == 0); // on purpose: one that was moved from
    THROWS(HAPFLOW_ERROR_HANDLE, {"write"}, static_cast<void>(scene.write()));
    scene = Scene::load("tank");
    other = std::move(scene);
    CHECK(hapflow_scene_check(handle) == HAPFLOW_ERROR_HANDLE && other.write().find("tank") != std::string::npos);
    // None is left behind, not even by those that throw.
    std::vector<Scene> all;
    while (all.size() + 1 < HAPFLOW_MAX_SCENES) {
        all.emplace_back();
    }
    THROWS(HAPFLOW_ERROR_FULL, {"scene: "}, Scene());
}

static void solids_are_felt_and_forces_limited() {
    Scene scene = build_jet();
    scene.set_ground(-0.02);
    scene.set("tool.solid_stiffness", 400);
    Config config;
    config.built = &scene;
    Session session(config);
    ToolState state;
    for (int n = 0; n <= 20; n++) {
        state.time_s = n * 1e-3;
        state.position[1] = -0.001 * n;
        session.fluid_advance(state.time_s);
        CHECK(session.tick(state).ok());
    }
    const std::vector<hapflow::Contact> contacts = session.contacts();
    CHECK(contacts.size() == 1 && contacts[0].solid == HAPFLOW_SOLID_GROUND);
    CHECK(contacts.size() == 1 && std::abs(contacts[0].force[1] - 400 * 0.015) < 1e-9);
    CHECK(std::abs(session.proxy().position[1] + 0.005) < 1e-9 && session.proxy().orientation[3] == 1);
    THROWS(HAPFLOW_ERROR_INDEX, {"contacts: no tool 1"}, static_cast<void>(session.contacts(1)));
    THROWS(HAPFLOW_ERROR_INDEX, {"proxy: no tool 1"}, static_cast<void>(session.proxy(1)));
    CHECK(session.limit_force(0.5, 0.05) == HAPFLOW_OK);
    CHECK(session.limit_force(0.6, 0.05) == HAPFLOW_ERROR_VALUE);
    for (int n = 21; n < 100; n++) {
        state.time_s = n * 1e-3;
        session.fluid_advance(state.time_s);
        CHECK(std::abs(session.tick(state).wrench.force[1]) <= 0.5);
    }
    CHECK(session.get("gate.max_force") == 0.5);
}

static void ticks_are_recorded() {
    Config config;
    config.toml = jet;
    config.record = true;
    Session session(config);
    THROWS(HAPFLOW_ERROR_RECORDING, {"record_stop: "}, session.record_stop());
    THROWS(HAPFLOW_ERROR_FILE, {"record: /nowhere/at/all.csv: "}, session.record("/nowhere/at/all.csv"));
    session.record("/dev/null");
    CHECK(run(session, 0, 50).ok());
    const hapflow::Recorded recorded = session.record_stop();
    CHECK(recorded.ticks == 50 && recorded.lost == 0);
    Session without = open_jet();
    THROWS(HAPFLOW_ERROR_RECORDING, {"record: "}, without.record("/dev/null"));
}

// Everything of `session` is refused, and nothing of it pushes.
static void gone(Session& session) {
    const Tick tick = session.tick(ToolState{});
    CHECK(tick.result == HAPFLOW_ERROR_HANDLE && !tick.ok() && zero(tick.wrench));
    CHECK(session.emergency_stop() == HAPFLOW_ERROR_HANDLE);
    CHECK(session.limit_force(1, 1) == HAPFLOW_ERROR_HANDLE);
    THROWS(HAPFLOW_ERROR_HANDLE, {"contacts"}, static_cast<void>(session.contacts()));
    THROWS(HAPFLOW_ERROR_HANDLE, {"proxy"}, static_cast<void>(session.proxy()));
    THROWS(HAPFLOW_ERROR_HANDLE, {"record"}, session.record("/dev/null"));
    THROWS(HAPFLOW_ERROR_HANDLE, {"record_stop"}, session.record_stop());
    THROWS(HAPFLOW_ERROR_HANDLE, {"clear_faults"}, session.clear_faults());
    THROWS(HAPFLOW_ERROR_HANDLE, {"fluid_advance"}, session.fluid_advance(0));
    THROWS(HAPFLOW_ERROR_HANDLE, {"fluid_step"}, session.fluid_step(1));
    THROWS(HAPFLOW_ERROR_HANDLE, {"particles"}, static_cast<void>(session.particles()));
    THROWS(HAPFLOW_ERROR_HANDLE, {"set"}, session.set("fluid.viscosity", 1));
    THROWS(HAPFLOW_ERROR_HANDLE, {"get"}, static_cast<void>(session.get<bool>("fluid.two_way")));
    THROWS(HAPFLOW_ERROR_HANDLE, {"settings"}, static_cast<void>(session.settings()));
    THROWS(HAPFLOW_ERROR_HANDLE, {"report"}, static_cast<void>(session.report()));
    THROWS(HAPFLOW_ERROR_HANDLE, {"servo_pace"}, static_cast<void>(session.servo_pace()));
    THROWS(HAPFLOW_ERROR_HANDLE, {"poll"}, session.poll());
    THROWS(HAPFLOW_ERROR_HANDLE, {"tool_count"}, static_cast<void>(session.tool_count()));
    THROWS(HAPFLOW_ERROR_HANDLE, {"obstacle_count"}, static_cast<void>(session.obstacle_count()));
    std::vector<float> positions;
    THROWS(HAPFLOW_ERROR_HANDLE, {"latest_particles"}, session.latest_particles(positions));
    CHECK(session.move_obstacle(0, Vec3{}) == HAPFLOW_ERROR_HANDLE);
    CHECK(session.publish_obstacles() == HAPFLOW_ERROR_HANDLE);
    THROWS(HAPFLOW_ERROR_HANDLE, {"destroy"}, session.destroy());
}

static bool alive(hapflow_session handle) {
    hapflow_report report{};
    CHECK(hapflow_report_init(&report, sizeof report) == HAPFLOW_OK);
    return hapflow_session_report(handle, &report) == HAPFLOW_OK;
}

static void moves_and_lives() {
    hapflow_session handle{};
    {
        Session first = open_jet();
        handle = first.handle();
        CHECK(alive(handle));
        Session second(std::move(first));
        CHECK(second.handle().id == handle.id && first.handle().id == 0); // on purpose: a session that was moved from
        gone(first);
        CHECK(run(second, 0, 100).wrench.force[1] < 0);

        Session third = open_jet();
        const hapflow_session replaced = third.handle();
        third = std::move(second);
        CHECK(!alive(replaced) && alive(handle) && third.handle().id == handle.id);
        Session& same = third;
        third = std::move(same);
        CHECK(alive(handle));
        first = std::move(third); // one that was moved from may get a session again
        CHECK(run(first, 100, 200).wrench.force[1] < 0);

        std::vector<Session> many;
        for (int n = 0; n < 5; n++) {
            many.push_back(open_jet());
        }
        CHECK(alive(many[0].handle()));
    }
    CHECK(!alive(handle));

    // A destroyed session is refused, and its end is harmless. So is its successor in the same place.
    Session old = open_jet();
    old.destroy();
    gone(old);
    Session next = open_jet();
    gone(old);
    { Session end(std::move(old)); }
    CHECK(alive(next.handle()));

    // None is left behind, not even by constructors that throw: there is room for all that there may be.
    next.destroy();
    std::vector<Session> all;
    for (unsigned n = 0; n < HAPFLOW_MAX_SESSIONS; n++) {
        all.push_back(open_jet());
    }
    THROWS(HAPFLOW_ERROR_FULL, {}, open_jet());
}

static void three_threads_on_one_session() {
    Session session = open_jet();
    std::atomic<bool> running{true};
    std::atomic<int> refused{0};
    std::thread servo([&] {
        ToolState state;
        for (int n = 0; n < 20000; n++) {
            state.time_s = n * 1e-3;
            refused += !session.tick(state).ok();
        }
        running = false;
    });
    std::thread fluid([&] {
        for (int n = 1; running; n++) {
            session.fluid_step(n * 1e-3);
        }
    });
    while (running) {
        session.set("fluid.viscosity", session.get("fluid.viscosity") * 0.99);
        CHECK(session.report().tick <= 20000);
    }
    servo.join();
    fluid.join();
    CHECK(refused == 0);
}

int main() {
    versions();
    what_the_library_has();
    errors();
    creation_fails_with_the_reason();
    a_tick_gives_force();
    a_tick_carries_every_field();
    a_tick_gives_torque();
    a_stop_holds_until_it_is_cleared();
    settings();
    vectors_are_read_in_every_locale();
    fluid_and_particles();
    several_tools_and_obstacles();
    a_session_that_steps_its_fluid();
    a_device_in_a_loop_of_the_host();
    a_session_that_ticks_its_servo();
    a_session_tells_its_log();
    optional_parts();
    scenes_are_built();
    scenes_refuse_and_move();
    solids_are_felt_and_forces_limited();
    ticks_are_recorded();
    three_threads_on_one_session();
    moves_and_lives();
    std::printf(failed == 0 ? "all passed\n" : "%d failed\n", failed);
    return failed == 0 ? 0 : 1;
}
