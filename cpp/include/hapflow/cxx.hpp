// hapflow for C++17 by cxx: sessions by the Rust bridge of libhapflow_cxx, over the one libhapflow of the process.
//
//     hapflow::Config config;
//     config.scene = "tap";
//     hapflow::cxx::Session session(config);
//     hapflow::Tick tick = session.tick(state);
//
// Values, scenes, devices and errors are those of hapflow.hpp, and so are the thread classes; session.handle() goes to
// whatever function of hapflow.h is not here, and Session::share makes one of a handle. Numbers in rows are handed over as
// spans, rust::Slice. A refusal is an exception on the C++ side alone, and none on a servo's.
#ifndef HAPFLOW_CXX_HPP
#define HAPFLOW_CXX_HPP

#include <hapflow/hapflow.hpp>
#include <rust/cxx.h>
// After it, for what it shares with it.
#include <hapflow/cxx/bridge.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace hapflow::cxx {

/// Room for numbers that are someone else's.
using Floats = rust::Slice<float>;

namespace detail {

/// What the bridge says, as every other error of hapflow: the result's number comes first.
[[noreturn]] inline void rethrow(const char* where, const rust::Error& error) {
    char* text = nullptr;
    const long code = std::strtol(error.what(), &text, 10);
    throw Error(static_cast<hapflow_result>(code), where, *text == ' ' ? text + 1 : text);
}

/// A call over the bridge that may fail.
template <class Call>
auto crossed(const char* where, Call call) -> decltype(call()) {
    try {
        return call();
    } catch (const rust::Error& error) {
        rethrow(where, error);
    }
}

/// A text for Rust, which takes UTF-8 alone.
inline rust::Str text(const std::string& text, const char* where) {
    try {
        return rust::Str(text);
    } catch (const std::exception&) {
        throw Error(HAPFLOW_ERROR_TEXT, where, {});
    }
}

} // namespace detail

/// A scene, its fluid and its tools: see hapflow::Session. Owns the session over the bridge, and with it the session of the
/// C interface, but where it is shared.
class Session {
public:
    /// Makes a session: milliseconds to seconds, as the scene has particles. [main, several at once] The host drives the
    /// servo, and there is no log: for those make a hapflow::Session, and share it.
    explicit Session(const Config& config) : Session(opened(config)) {}

    /// One that somebody else owns, as hapflow::Session or a program in C. [main, several at once] It ends with that.
    [[nodiscard]] static Session share(hapflow_session handle) {
        return Session(detail::crossed("share", [&] { return bridge::share(handle.id); }));
    }

    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    /// Leaves a null session in `other`: all that it does fails with HAPFLOW_ERROR_HANDLE. [any] But this thread must
    /// have both for itself, as for every move.
    Session(Session&& other) noexcept
        : session_(std::exchange(other.session_, std::nullopt)), blank_(other.blank_) {}

    /// Destroys what it had, and takes over the other's. [main] This thread must have both for itself.
    Session& operator=(Session&& other) noexcept {
        if (this != &other) {
            session_ = std::exchange(other.session_, std::nullopt);
            blank_ = other.blank_;
        }
        return *this;
    }

    /// Ends the session, if destroy() has not, and it is not shared; waits for calls under way. [main]
    ~Session() = default;

    /// Ends the session now, also a shared one. [main] Later calls fail with HAPFLOW_ERROR_HANDLE.
    void destroy() {
        call("destroy", [](const bridge::Session& s) { s.destroy(); });
    }

    /// For functions of hapflow.h that are not here; 0 for a null session. [any] Never destroy it.
    [[nodiscard]] hapflow_session handle() const noexcept {
        try {
            return {session_ ? (*session_)->handle() : 0};
        } catch (...) {
            return {};
        }
    }

    // -------------------------------------------------------------------------------------------- servo

    /// One servo tick: the hand is at `state`, and feels the wrench. [servo] On failure the wrench is zero.
    Tick tick(const ToolState& state) noexcept {
        return hapflow::detail::ticked(state, blank_, [&](const hapflow_tool_state& c, hapflow_wrench& wrench) noexcept {
            const hapflow_result result = quiet([&](const bridge::Session& s) { return s.tick(c, wrench); });
            if (result < 0) {
                wrench = {};
            }
            return result;
        });
    }

    /// No force from the next tick on, until the faults are cleared. [any]
    hapflow_result emergency_stop() noexcept {
        return quiet([](const bridge::Session& s) { return s.emergency_stop(); });
    }

    /// Takes back every fault; the force then comes up slowly, as at a start. [any] Only a person who has seen that
    /// the device is safe should lead to this call.
    void clear_faults() {
        const hapflow_result result = quiet([](const bridge::Session& s) { return s.clear_faults(); });
        hapflow::detail::check(result, "clear_faults");
    }

    /// No force on any tool is larger than `max_force` (N) from now on, and no torque than `max_torque` (N m). [any]
    hapflow_result limit_force(double max_force, double max_torque) noexcept {
        return quiet([&](const bridge::Session& s) { return s.limit_force(max_force, max_torque); });
    }

    /// How many tools the scene has. [any]
    [[nodiscard]] std::uint32_t tool_count() const {
        return call("tool_count", [](const bridge::Session& s) { return s.tool_count(); });
    }

    // -------------------------------------------------------------------------------------------- fluid

    /// Steps every fluid frame that has ended by `time_s` on the servo's clock. [fluid]
    void fluid_advance(double time_s) {
        call("fluid_advance", [&](const bridge::Session& s) { s.fluid_advance(time_s); });
    }

    /// Steps one frame, whose tool path ends at `end_s` on the servo's clock. [fluid]
    void fluid_step(double end_s) {
        call("fluid_step", [&](const bridge::Session& s) { s.fluid_step(end_s); });
    }

    /// The particles at the end of the newest frame, as many as there is room for: x, y, z of each, in m. [fluid] Gives how
    /// many there are.
    std::size_t particles(Floats positions) {
        return call("particles", [&](const bridge::Session& s) { return s.particles(positions); });
    }

    /// The particles that came last, whoever steps the fluid; and asks for more, which come with the next frame. [main]
    /// `positions` becomes as long as needed, and keeps its room for the next time.
    void latest_particles(std::vector<float>& positions) {
        call("latest_particles", [&](const bridge::Session& s) {
            positions.resize(3 * s.latest_particles(Floats()));
            s.latest_particles(Floats(positions.data(), positions.size()));
        });
    }

    // -------------------------------------------------------------------------------------------- obstacles

    /// How many obstacles the scene has. [any]
    [[nodiscard]] std::uint32_t obstacle_count() const {
        return call("obstacle_count", [](const bridge::Session& s) { return s.obstacle_count(); });
    }

    /// Where obstacle `index`, from 0, is to be once publish_obstacles() is called. [obstacle] Gives the result.
    hapflow_result move_obstacle(std::uint32_t index, const Vec3& position,
                                 const std::array<double, 4>& orientation = {{0, 0, 0, 1}}) noexcept {
        return quiet([&](const bridge::Session& s) { return s.move_obstacle(index, position, orientation); });
    }

    /// Hands the places of all obstacles to the fluid, together. [obstacle] Gives the result.
    hapflow_result publish_obstacles() noexcept {
        return quiet([](const bridge::Session& s) { return s.publish_obstacles(); });
    }

    // -------------------------------------------------------------------------------------------- settings

    /// Sets a live setting to a number. [main]
    void set(const std::string& path, double value) {
        const rust::Str name = detail::text(path, "set");
        call("set", [&](const bridge::Session& s) { s.set_number(name, value); });
    }

    /// Sets any live setting, with its value as a command line has it. [main]
    void set(const std::string& path, const std::string& value) {
        const rust::Str name = detail::text(path, "set"), word = detail::text(value, "set");
        call("set", [&](const bridge::Session& s) { s.set_text(name, word); });
    }

    /// Reads a setting: get<double>, or get<std::string>, which reads all of them. [main]
    template <class T = double>
    [[nodiscard]] T get(const std::string& path) const {
        const rust::Str name = detail::text(path, "get");
        if constexpr (std::is_same_v<T, double>) {
            return call("get", [&](const bridge::Session& s) { return s.get_number(name); });
        } else {
            static_assert(std::is_same_v<T, std::string>, "get<double> or <std::string>");
            return std::string(call("get", [&](const bridge::Session& s) { return s.get_text(name); }));
        }
    }

    /// Reads the newest tick of a tool, and the newest frame. [main] Never waits for either.
    [[nodiscard]] Report report(std::uint32_t tool = 0) const {
        Report report{};
        call("report", [&](const bridge::Session& s) { s.report(tool, report); });
        return report;
    }

private:
    explicit Session(rust::Box<bridge::Session> session)
        : session_(std::move(session)), blank_(hapflow::detail::made(hapflow_tool_state_init)) {}

    static rust::Box<bridge::Session> opened(const Config& config) {
        if (config.log || config.servo_drive != HAPFLOW_DRIVE_HOST) {
            throw Error(HAPFLOW_ERROR_UNSUPPORTED, "session", "a log or a servo of its own: share a hapflow::Session");
        }
        bridge::Config c;
        c.scene = detail::text(config.scene, "scene");
        c.toml = detail::text(config.toml, "toml");
        c.settings = detail::text(config.settings, "settings");
        c.built = config.built != nullptr ? config.built->handle().id : 0;
        c.threads = config.threads;
        c.fluid_drive = config.fluid_drive;
        c.record = config.record;
        return detail::crossed("session", [&] { return bridge::open(c); });
    }

    template <class Call>
    auto call(const char* where, Call call) const -> decltype(call(std::declval<const bridge::Session&>())) {
        if (!session_) {
            throw Error(HAPFLOW_ERROR_HANDLE, where, {});
        }
        return detail::crossed(where, [&] { return call(**session_); });
    }

    /// For threads that nothing may be thrown in.
    template <class Call>
    hapflow_result quiet(Call call) const noexcept {
        try {
            return session_ ? static_cast<hapflow_result>(call(**session_)) : hapflow_result{HAPFLOW_ERROR_HANDLE};
        } catch (...) {
            return HAPFLOW_ERROR_PANIC;
        }
    }

    std::optional<rust::Box<bridge::Session>> session_;
    hapflow_tool_state blank_{};
};

} // namespace hapflow::cxx

#endif
