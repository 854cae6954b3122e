// hapflow for C++17: the C interface of <hapflow/hapflow.h> with values, destructors and exceptions. Header only.
//
//     hapflow::Config config;
//     config.scene = "tap";
//     hapflow::Session session(config);
//     hapflow::ToolState state;
//     for (each tick at about 1 kHz) {                              the host's loop
//         session.fluid_advance(state.time_s);                      here, or fluid_step in a thread of its own
//         hapflow::Tick tick = session.tick(state);                 tick.wrench.force goes to the device
//     }
//
// What a function does, and what it may be given, is said in hapflow.h, which is the contract; here is said how C++
// sees it. Each function has the thread class of the C function below it:
//
//     [main]      may block and allocate. One thread at a time a session; it need not always be the same.
//     [servo]     wait-free: no lock, no allocation, no system call, no log. One thread at a time a tool or device.
//     [fluid]     computes, for milliseconds. One thread at a time a session.
//     [obstacle]  wait-free, as [servo]. One thread at a time a session.
//     [any]       lock-free, by any number of threads at once.
//
// Functions of different classes may run on one Session at the same time. Only to move it, to assign to it and to
// let it end, a thread must have it for itself; so for a Device. Whatever fails throws Error; a function that is noexcept
// gives the result instead. Remarks (positive results) are no errors.
#ifndef HAPFLOW_HAPFLOW_HPP
#define HAPFLOW_HAPFLOW_HPP

#include <hapflow/hapflow.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <locale>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace hapflow {

/// Three numbers: x, y, z.
using Vec3 = std::array<double, 3>;
/// The newest tick, and the newest fluid frame: see hapflow_report.
using Report = hapflow_report;
using BodyReport = hapflow_body_report; ///< A body at the end of the newest fluid frame, and the fluid's load on it.

/// Which list of a scene a body is in.
enum class BodyList : std::uint32_t {
    tools = HAPFLOW_BODY_TOOL,         ///< Tools, the first first.
    obstacles = HAPFLOW_BODY_OBSTACLE, ///< Obstacles.
    free = HAPFLOW_BODY_FREE,          ///< What floats or sinks.
};
/// A scene that the library brings along: see hapflow_scene_info. Its texts last as long as the process.
using SceneInfo = hapflow_scene_info;
/// A haptic device that the library knows: see hapflow_device_info. Its texts last as long as the process.
using DeviceInfo = hapflow_device_info;
/// How an owned servo keeps time: see hapflow_servo_pace. Its texts last as long as the session.
using ServoPace = hapflow_servo_pace;
/// What a tool touches: see hapflow_contact.
using Contact = hapflow_contact;

/// A function of the library failed. what() tells all of it: the function, its argument, the result, the detail.
class Error : public std::runtime_error {
public:
    /// `detail` may be empty.
    Error(hapflow_result code, const std::string& where, const std::string& detail)
        : std::runtime_error(where + ": " + (detail.empty() ? hapflow_result_text(code) : detail)),
          code_(code),
          detail_(detail.empty() ? std::string::npos : where.size() + 2) {}

    /// Which failure: HAPFLOW_ERROR_...
    [[nodiscard]] hapflow_result code() const noexcept { return code_; }

    /// What exactly was wrong, as hapflow_last_error told it: field, value, allowed range, line in a scene. Where the
    /// library tells no more than the result, its sentence on that. Lasts as long as this error.
    [[nodiscard]] const char* detail() const noexcept {
        return detail_ == std::string::npos ? hapflow_result_text(code_) : what() + detail_;
    }

private:
    hapflow_result code_;
    std::size_t detail_; // where in what()
};

namespace detail {

/// The text that `read(buffer, capacity, &length)` gives, which must never fail: by two calls, or more if it grows
/// meanwhile.
template <class Read>
std::string whole_text(Read read) {
    std::string text;
    std::size_t length = 0;
    for (read(nullptr, 0, &length); length > text.size();) {
        text.resize(length);
        // The last byte is the string's own NUL, which the library writes as a NUL again.
        read(text.data(), text.size() + 1, &length);
    }
    text.resize(length);
    return text;
}

/// The message of the last [main] function that failed on this thread.
inline std::string last_error() {
    return whole_text([](char* text, std::size_t capacity, std::size_t* length) {
        static_cast<void>(hapflow_last_error(text, capacity, length));
    });
}

/// For functions that leave no message.
inline void check(hapflow_result result, const char* where) {
    if (result < 0) {
        throw Error(result, where, {});
    }
}

/// For [main] functions, which leave one.
inline void check_main(hapflow_result result, const std::string& where) {
    if (result < 0) {
        throw Error(result, where, last_error());
    }
}

/// A text for C, which ends at its first NUL: one inside would cut it without a word.
inline const char* c_text(const std::string& text, const char* where) {
    if (text.find('\0') != std::string::npos) {
        throw Error(HAPFLOW_ERROR_TEXT, where, "a text with a NUL inside");
    }
    return text.c_str();
}

inline const char* c_text_or_null(const std::string& text, const char* where) {
    return text.empty() ? nullptr : c_text(text, where);
}

/// What `get(index, &info)` gives for every index below `count`.
template <class Info, class Init, class Get>
std::vector<Info> all(std::uint32_t count, Init init, Get get) {
    std::vector<Info> infos(count);
    for (std::uint32_t index = 0; index < count; index++) {
        check(init(&infos[index], static_cast<std::uint32_t>(sizeof(Info))), "list");
        check(get(index, &infos[index]), "list");
    }
    return infos;
}

/// The ways to set a setting, which a session and a scene have in common. [main] `Owner` has set_number, set_vector and
/// set_text. A session takes live settings only, a scene all.
template <class Owner>
class Settable {
public:
    /// Sets a setting to a number, or a switch to true or false. [main]
    template <class T, std::enable_if_t<std::is_arithmetic_v<T>, int> = 0>
    void set(const std::string& path, T value) {
        if constexpr (std::is_same_v<T, bool>) {
            set(path, std::string(value ? "true" : "false"));
        } else {
            check_main(owner().set_number(c_text(path, "set"), static_cast<double>(value)), "set");
        }
    }

    /// Sets any setting, with its value as a command line has it: "true", "1.5", "[0, -9.81, 0]", "wcsph". [main]
    void set(const std::string& path, const std::string& value) {
        const char* c_path = c_text(path, "set");
        check_main(owner().set_text(c_path, c_text(value, "set")), "set");
    }

    /// The same for a literal, which would else be taken for a bool. [main]
    void set(const std::string& path, const char* value) { set(path, std::string(value)); }

    /// Sets a setting to three numbers. [main]
    void set(const std::string& path, const Vec3& value) {
        check_main(owner().set_vector(c_text(path, "set"), value.data()), "set");
    }

    /// The same, written out: set("fluid.gravity", {0, -9.81, 0}). [main]
    template <std::size_t N>
    void set(const std::string& path, const double (&value)[N]) {
        static_assert(N == 3, "x, y and z");
        set(path, Vec3{{value[0], value[1], value[2]}});
    }

private:
    [[nodiscard]] Owner& owner() noexcept { return static_cast<Owner&>(*this); }
};

template <class T>
constexpr std::uint32_t size_of() noexcept {
    return static_cast<std::uint32_t>(sizeof(T));
}

/// A struct of the library as its init function makes it: what this wrapper does not know keeps its default.
template <class T>
T made(hapflow_result (*init)(T*, std::uint32_t)) {
    T made{};
    check(init(&made, size_of<T>()), "init");
    return made;
}

template <std::size_t N>
void copy(const std::array<double, N>& from, double (&to)[N]) noexcept {
    for (std::size_t i = 0; i < N; i++) {
        to[i] = from[i];
    }
}

template <std::size_t N>
void copy(const double (&from)[N], std::array<double, N>& to) noexcept {
    for (std::size_t i = 0; i < N; i++) {
        to[i] = from[i];
    }
}

} // namespace detail

/// Agrees with the library on the version of the C interface, once a process; every Session does it first. [main,
/// several at once] Gives the version.
inline std::uint32_t negotiate() {
    // If it throws, the next call tries again.
    static const std::uint32_t chosen = [] {
        std::uint32_t version = 0;
        detail::check(hapflow_negotiate(HAPFLOW_ABI_VERSION, HAPFLOW_ABI_VERSION, &version), "negotiate");
        return version;
    }();
    return chosen;
}

/// The release of the library: major * 1000000 + minor * 1000 + patch. [any]
[[nodiscard]] inline std::uint32_t version() noexcept {
    return hapflow_version();
}

/// What the library is and has, one `key = value` a line: see hapflow_build_info. [main, several at once]
[[nodiscard]] inline std::string build_info() {
    return detail::whole_text([](char* text, std::size_t capacity, std::size_t* length) {
        detail::check(hapflow_build_info(text, capacity, length), "build_info");
    });
}

/// The scenes that the library brings along. [main, several at once]
[[nodiscard]] inline std::vector<SceneInfo> scenes() {
    return detail::all<SceneInfo>(hapflow_scene_count(), hapflow_scene_info_init, hapflow_scene_get);
}

/// The haptic devices that the library knows, plugged in or not. [main, several at once]
[[nodiscard]] inline std::vector<DeviceInfo> devices() {
    return detail::all<DeviceInfo>(hapflow_device_count(), hapflow_device_info_init, hapflow_device_get);
}

namespace detail {

/// The name of the optional part whose table this is.
template <class Table>
struct Part;
template <>
struct Part<hapflow_device_extension> {
    static constexpr const char* name = HAPFLOW_EXTENSION_DEVICE;
};
template <>
struct Part<hapflow_log_extension> {
    static constexpr const char* name = HAPFLOW_EXTENSION_LOG;
};

} // namespace detail

/// The table of an optional part, as extension<hapflow_device_extension>(); null where the library has none. [any] It
/// lasts as long as the process.
template <class Table>
[[nodiscard]] const Table* extension() noexcept {
    return static_cast<const Table*>(hapflow_extension(detail::Part<Table>::name));
}

/// A box with edges along the axes.
struct Box {
    Vec3 min{}; ///< Corner of the smallest coordinates, m, each within 100.
    Vec3 max{}; ///< Corner of the largest.
};

/// Shape of an obstacle or a tool.
enum class Shape : std::uint32_t {
    sphere = HAPFLOW_SHAPE_SPHERE,     ///< A ball.
    disc = HAPFLOW_SHAPE_DISC,         ///< A flat round plate, its axis up, of `thickness`.
    cylinder = HAPFLOW_SHAPE_CYLINDER, ///< The same by its other name, of `length`.
    capsule = HAPFLOW_SHAPE_CAPSULE,   ///< A rod with round ends, its axis up; `length` between their middles.
    box = HAPFLOW_SHAPE_BOX,           ///< Edges `extent` along the axes.
    mesh = HAPFLOW_SHAPE_MESH,         ///< What the closed mesh of `file` holds, about the centre of its volume.
};

/// A jet. By default 20 mm straight down at 1 m/s from the origin.
struct Source {
    std::string name;            ///< By which settings address it; empty: its number.
    Vec3 position{};             ///< Centre of the outlet, m.
    Vec3 direction{{0, -1, 0}};  ///< Of the jet, of any length but 0.
    double diameter = 0.02;      ///< Of the outlet, m.
    double speed = 1;            ///< At the outlet, m/s.
    double period = 0;           ///< Of an intermittent jet, s; 0: it runs steadily.
    double duty = 1;             ///< Share of the period in which it runs.
    bool on = true;              ///< It runs.
};

/// Something solid. By default a ball of 20 mm radius in the origin.
struct Obstacle {
    std::string name;            ///< By which settings address it; empty: its number.
    Shape shape = Shape::sphere; ///< Its shape.
    double radius = 0.02;        ///< m.
    double thickness = 0.01;     ///< Of a disc, m.
    Vec3 position{};             ///< Until the host moves it, m.
    double length = 0.04;        ///< Of a cylinder or a capsule, m.
    Vec3 extent{{0.03, 0.03, 0.03}}; ///< Edges of a box, m.
    std::string file{};          ///< Of a mesh, Wavefront OBJ or STL.
    double scale = 1;            ///< Metres a unit of that file.
};

/// A tool in a hand. By default a ball of 15 mm radius in the origin.
struct Tool {
    std::string name;                ///< By which settings address it; empty: its number.
    Shape shape = Shape::sphere;     ///< Its shape.
    double radius = 0.015;           ///< m.
    double thickness = 0.01;         ///< Of a disc, m.
    double mass = 0.1;               ///< Of its body in the fluid (coupling momentum), kg.
    double collision_response = 0.2; ///< Share of the fluid's impulse that it takes (coupling momentum).
    Vec3 position{};                 ///< Where it starts, m.
    double force_scale = 1;          ///< Factor on the fluid's force.
    double solid_stiffness = 0;      ///< How stiff solids feel, N/m; 0: they are not felt.
    double solid_damping = 0;        ///< How much they slow it, N s/m.
    double length = 0.04;            ///< Of a cylinder or a capsule, m.
    Vec3 extent{{0.03, 0.03, 0.03}}; ///< Edges of a box, m.
    std::string file{};              ///< Of a mesh, Wavefront OBJ or STL.
    double scale = 1;                ///< Metres a unit of that file.
    double buoyancy_scale = 1;       ///< Factor on the lift alone, beside force_scale (coupling local).
};

/// A rigid body that goes where fluid and gravity take it; walls, obstacles, tools and other bodies stop it. By default a
/// ball of 20 mm radius in the origin, half as dense as water.
struct Body {
    std::string name;                ///< By which settings address it; empty: its number.
    Shape shape = Shape::sphere;     ///< Its shape.
    double radius = 0.02;            ///< Of all but a box and a mesh, m.
    double thickness = 0.01;         ///< Of a disc, m.
    double density = 500;            ///< Its mean density, kg/m3.
    Vec3 position{};                 ///< Where it starts, m.
    double length = 0.04;            ///< Of a cylinder or a capsule, m.
    Vec3 extent{{0.03, 0.03, 0.03}}; ///< Edges of a box, m.
    std::string file{};              ///< Of a mesh, Wavefront OBJ or STL.
    double scale = 1;                ///< Metres a unit of that file.
};

/// A scene that is built by calls, each checked by itself. A session copies it. Owns the scene of the C interface, and
/// destroys it.
class Scene : public detail::Settable<Scene> {
public:
    /// An empty one: no fluid yet, and one tool, whose settings are tool.radius and so on. [main, several at once]
    Scene() {
        negotiate();
        detail::check_main(hapflow_scene_create(&scene_), "scene");
    }

    /// A shipped one, by its name, or that of a file, by its path. [main, several at once]
    [[nodiscard]] static Scene load(const std::string& name) {
        negotiate();
        Scene scene{nullptr};
        detail::check_main(hapflow_scene_load(detail::c_text(name, "load"), &scene.scene_), "load");
        return scene;
    }

    /// That of the text of a scene file. [main, several at once]
    [[nodiscard]] static Scene parse(const std::string& toml) {
        negotiate();
        Scene scene{nullptr};
        detail::check_main(hapflow_scene_parse(toml.c_str(), toml.size(), &scene.scene_), "parse");
        return scene;
    }

    Scene(const Scene&) = delete;
    Scene& operator=(const Scene&) = delete;

    /// Leaves a null scene in `other`: all that it does fails with HAPFLOW_ERROR_HANDLE. [any] But this thread must have
    /// both for itself, as for every move.
    Scene(Scene&& other) noexcept : scene_(std::exchange(other.scene_, hapflow_scene{})) {}

    /// Destroys what it had, and takes over the other's. [main] This thread must have both for itself.
    Scene& operator=(Scene&& other) noexcept {
        if (this != &other) {
            end();
            scene_ = std::exchange(other.scene_, hapflow_scene{});
        }
        return *this;
    }

    /// Ends the scene; sessions that were made of it go on. [main]
    ~Scene() { end(); }

    /// For functions of hapflow.h that are not here. Never destroy it. [any]
    [[nodiscard]] hapflow_scene handle() const noexcept { return scene_; }

    /// Sets the box outside of which particles vanish. [main]
    void set_bounds(const Box& box) {
        detail::check_main(hapflow_scene_set_bounds(scene_, box.min.data(), box.max.data()), "set_bounds");
    }

    /// Lets particles that leave the bounds along these axes come in on the other side. [main]
    void set_periodic(bool x, bool y, bool z) {
        const int axes = (x ? int{HAPFLOW_AXIS_X} : 0) | (y ? int{HAPFLOW_AXIS_Y} : 0) | (z ? int{HAPFLOW_AXIS_Z} : 0);
        detail::check_main(hapflow_scene_set_periodic(scene_, static_cast<std::uint32_t>(axes)), "set_periodic");
    }

    /// Sets the height of the ground, m. [main]
    void set_ground(double height) { detail::check_main(hapflow_scene_set_ground(scene_, &height), "set_ground"); }

    /// Takes the ground away. [main]
    void clear_ground() { detail::check_main(hapflow_scene_set_ground(scene_, nullptr), "clear_ground"); }

    /// Sets the inside of the open box. [main]
    void set_container(const Box& box) {
        const hapflow_result result = hapflow_scene_set_container(scene_, box.min.data(), box.max.data());
        detail::check_main(result, "set_container");
    }

    /// Takes the open box away. [main]
    void clear_container() {
        detail::check_main(hapflow_scene_set_container(scene_, nullptr, nullptr), "clear_container");
    }

    /// Adds a source, and gives its number. [main]
    std::uint32_t add(const Source& source) {
        auto c = detail::made(hapflow_source_config_init);
        c.name = detail::c_text_or_null(source.name, "add source");
        detail::copy(source.position, c.position);
        detail::copy(source.direction, c.direction);
        c.diameter = source.diameter;
        c.speed = source.speed;
        c.period = source.period;
        c.duty = source.duty;
        c.on = source.on ? 1 : 0;
        std::uint32_t index = 0;
        detail::check_main(hapflow_scene_add_source(scene_, &c, &index), "add source");
        return index;
    }

    /// Adds an obstacle, and gives its number, as Session::move_obstacle counts them. [main]
    std::uint32_t add(const Obstacle& obstacle) {
        auto c = detail::made(hapflow_obstacle_config_init);
        c.name = detail::c_text_or_null(obstacle.name, "add obstacle");
        form(obstacle, c, "add obstacle");
        detail::copy(obstacle.position, c.position);
        std::uint32_t index = 0;
        detail::check_main(hapflow_scene_add_obstacle(scene_, &c, &index), "add obstacle");
        return index;
    }

    /// Adds a body, and gives its number. [main]
    std::uint32_t add(const Body& body) {
        auto c = detail::made(hapflow_body_config_init);
        c.name = detail::c_text_or_null(body.name, "add body");
        form(body, c, "add body");
        c.density = body.density;
        detail::copy(body.position, c.position);
        std::uint32_t index = 0;
        detail::check_main(hapflow_scene_add_body(scene_, &c, &index), "add body");
        return index;
    }

    /// Adds a tool to the first, which every scene has, and gives its number, from 1. [main]
    std::uint32_t add(const Tool& tool) {
        auto c = detail::made(hapflow_tool_config_init);
        c.name = detail::c_text_or_null(tool.name, "add tool");
        form(tool, c, "add tool");
        c.mass = tool.mass;
        c.collision_response = tool.collision_response;
        detail::copy(tool.position, c.position);
        c.force_scale = tool.force_scale;
        c.buoyancy_scale = tool.buoyancy_scale;
        c.solid_stiffness = tool.solid_stiffness;
        c.solid_damping = tool.solid_damping;
        std::uint32_t index = 0;
        detail::check_main(hapflow_scene_add_tool(scene_, &c, &index), "add tool");
        return index;
    }

    /// Adds a box filled with fluid at the start, and gives its number. [main]
    std::uint32_t add_pool(const Box& box) { return add_box(hapflow_scene_add_pool, box, "add_pool"); }

    /// Adds a box in which particles vanish, and gives its number. [main]
    std::uint32_t add_sink(const Box& box) { return add_box(hapflow_scene_add_sink, box, "add_sink"); }

    /// Adds new values for live settings, lines `path = value`, at a time of the run, s. [main]
    void add_change(double at_s, const std::string& settings) {
        const char* c_settings = detail::c_text(settings, "add_change");
        detail::check_main(hapflow_scene_add_change(scene_, at_s, c_settings), "add_change");
    }

    /// Throws what a session of it would throw, if it cannot be run. [main]
    void check() const { detail::check_main(hapflow_scene_check(scene_), "check"); }

    /// The text of a scene file, which parse() makes an equal scene of. [main]
    [[nodiscard]] std::string write() const {
        return detail::whole_text([&](char* text, std::size_t capacity, std::size_t* length) {
            detail::check_main(hapflow_scene_write(scene_, text, capacity, length), "write");
        });
    }

private:
    /// The shape of an obstacle or a tool.
    template <class Formed, class Config> static void form(const Formed& formed, Config& c, const char* doing) {
        c.shape = static_cast<std::uint32_t>(formed.shape);
        c.radius = formed.radius;
        c.thickness = formed.thickness;
        c.length = formed.length;
        detail::copy(formed.extent, c.extent);
        c.file = detail::c_text_or_null(formed.file, doing);
        c.scale = formed.scale;
    }

    friend class detail::Settable<Scene>;

    explicit Scene(std::nullptr_t) noexcept {}

    // Fails only if there is no scene any more, and then there is nothing to do.
    void end() noexcept {
        if (scene_.id != 0) {
            static_cast<void>(hapflow_scene_destroy(scene_));
        }
    }

    template <class Add>
    std::uint32_t add_box(Add c_add, const Box& box, const char* where) {
        std::uint32_t index = 0;
        detail::check_main(c_add(scene_, box.min.data(), box.max.data(), &index), where);
        return index;
    }

    hapflow_result set_number(const char* path, double value) { return hapflow_scene_set(scene_, path, value); }
    hapflow_result set_vector(const char* path, const double* v) { return hapflow_scene_set_vector(scene_, path, v); }
    hapflow_result set_text(const char* path, const char* v) { return hapflow_scene_set_text(scene_, path, v); }

    hapflow_scene scene_{};
};

/// How a session is made. Exactly one of `scene`, `toml` and `built` is given.
struct Config {
    std::string scene;             ///< Name of a shipped scene, as "tap", or path of a scene file.
    std::string toml;              ///< Text of a scene file.
    std::string settings;          ///< Lines `path = value` that are set on top.
    const Scene* built = nullptr;  ///< A scene that was built; it is copied, and must live only until the session is made.
    bool record = false;           ///< Session::record may be called.
    std::uint32_t threads = 0;     ///< Worker threads of the fluid; 0: all cores but one. Results do not depend on it.
    std::uint32_t fluid_drive = 0; ///< HAPFLOW_DRIVE_HOST, or _OWNED: the session steps the fluid itself.
    std::uint32_t servo_drive = 0; ///< HAPFLOW_DRIVE_HOST, or _OWNED: the session ticks the servo itself.
    /// Gets each line that Session::poll() has to tell, with its level (HAPFLOW_LOG_...), on the thread that polls. It
    /// may call no function of that session of class [main]. What it throws comes out of poll().
    std::function<void(std::uint32_t level, const std::string& text)> log;
};

/// Which device, and how it is made: see hapflow_device_config.
struct DeviceConfig {
    std::string name;     ///< As DeviceInfo has it; empty: that of the scene.
    std::string scene;    ///< Name of a shipped scene, or path of a scene file; or empty.
    std::string toml;     ///< Text of a scene file; or empty.
    std::string settings; ///< Lines `path = value` that are set on top.
};

/// Where the hand is, and when: see hapflow_tool_state. By default at rest in the origin, at time 0.
struct ToolState {
    double time_s = 0;                                 ///< Since the session's start, never before the tool's last, s.
    double dt_s = 0.001;                               ///< Since the last tick, s.
    Vec3 position{};                                   ///< m.
    std::array<double, 4> orientation{{0, 0, 0, 1}};   ///< Unit quaternion x, y, z, w, tool to device frame.
    Vec3 velocity{};                                   ///< m/s.
    Vec3 angular_velocity{};                           ///< rad/s, in the device frame.
    std::uint32_t buttons = 0;                         ///< Bit n: button n is down.
    std::uint32_t tool = 0;                            ///< Which one of the scene, from 0.
};

/// What the hand is to feel. Finite, and within the limits of the scene's safety gate.
struct Wrench {
    Vec3 force{};  ///< N, in the frame of the tool state.
    Vec3 torque{}; ///< N m, about the tool's position.
};

/// A haptic device for a loop of the host, behind a safety gate of its own; or to be given to a Session. Owns the
/// device of the C interface, and closes it.
class Device {
public:
    /// Opens a device. [main, several at once]
    explicit Device(const DeviceConfig& config) {
        negotiate();
        auto c = detail::made(hapflow_device_config_init);
        c.name = detail::c_text_or_null(config.name, "name");
        c.scene = detail::c_text_or_null(config.scene, "scene");
        c.toml = config.toml.empty() ? nullptr : config.toml.data();
        c.toml_length = config.toml.size();
        c.settings = detail::c_text_or_null(config.settings, "settings");
        blank_ = detail::made(hapflow_tool_state_init);
        detail::check_main(hapflow_device_open(&c, &device_), "device");
    }

    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    /// Leaves a null device in `other`: all that it does fails with HAPFLOW_ERROR_HANDLE. [any] But this thread must
    /// have both for itself, as for every move.
    Device(Device&& other) noexcept : device_(other.release()), blank_(other.blank_) {}

    /// Closes what it had, and takes over the other's. [main] This thread must have both for itself.
    Device& operator=(Device&& other) noexcept {
        if (this != &other) {
            end();
            device_ = other.release();
            blank_ = other.blank_;
        }
        return *this;
    }

    /// Takes the force off and lets go of it, if close() has not; waits for calls under way. [main]
    ~Device() { end(); }

    /// Takes the force off and lets go of it now. [main] Waits for calls of other threads that are under way.
    void close() { detail::check_main(hapflow_device_close(device_), "close"); }

    /// For functions of device.h that are not here. Never close it. [any]
    [[nodiscard]] hapflow_device handle() const noexcept { return device_; }

    /// Where it is at `time_s`: `state` becomes what Session::tick takes, but keeps its `tool`. [servo] Gives the
    /// result; on failure `state` is as it was.
    hapflow_result read(double time_s, ToolState& state) noexcept {
        hapflow_tool_state c = blank_;
        const hapflow_result result = hapflow_device_read(device_, time_s, &c);
        if (result >= 0) {
            state.time_s = c.time_s;
            state.dt_s = c.dt_s;
            state.buttons = c.buttons;
            detail::copy(c.position, state.position);
            detail::copy(c.orientation, state.orientation);
            detail::copy(c.velocity, state.velocity);
            detail::copy(c.angular_velocity, state.angular_velocity);
        }
        return result;
    }

    /// What the hand is to feel until the next write, `dt_s` after the last. [servo] Gives the result.
    hapflow_result write(const Wrench& wrench, double dt_s) noexcept {
        hapflow_wrench c{};
        detail::copy(wrench.force, c.force);
        detail::copy(wrench.torque, c.torque);
        return hapflow_device_write(device_, &c, dt_s);
    }

    /// Takes back every fault; the force then comes up slowly, as at first. [any]
    void clear_faults() { detail::check(hapflow_device_clear_faults(device_), "clear_faults"); }

private:
    friend class Session;

    hapflow_device release() noexcept { return std::exchange(device_, hapflow_device{}); }

    // Fails only if there is no device any more, and then there is nothing to do.
    void end() noexcept {
        if (device_.id != 0) {
            static_cast<void>(hapflow_device_close(device_));
        }
    }

    hapflow_device device_{};
    hapflow_tool_state blank_{};
};

/// What a servo tick gave. The wrench is zero if it failed.
struct [[nodiscard]] Tick {
    Wrench wrench;             ///< What goes to the device.
    hapflow_result result = 0; ///< Negative: it failed. Positive: it is done, and there is a remark.

    /// It is done, perhaps with a remark.
    [[nodiscard]] bool ok() const noexcept { return result >= 0; }
    /// A sentence on the result.
    [[nodiscard]] const char* text() const noexcept { return hapflow_result_text(result); }
};

namespace detail {

/// A tick by `call(state, wrench)`, which gives the result. `blank` is a state as the init function makes it.
template <class Call>
Tick ticked(const ToolState& state, hapflow_tool_state blank, Call call) noexcept {
    blank.tool = state.tool;
    blank.buttons = state.buttons;
    blank.time_s = state.time_s;
    blank.dt_s = state.dt_s;
    copy(state.position, blank.position);
    copy(state.orientation, blank.orientation);
    copy(state.velocity, blank.velocity);
    copy(state.angular_velocity, blank.angular_velocity);
    hapflow_wrench wrench{};
    Tick tick;
    tick.result = call(blank, wrench);
    copy(wrench.force, tick.wrench.force);
    copy(wrench.torque, tick.wrench.torque);
    return tick;
}

} // namespace detail

/// Where something is, in the scene's frame.
struct Pose {
    Vec3 position{};                                 ///< m.
    std::array<double, 4> orientation{{0, 0, 0, 1}}; ///< Unit quaternion x, y, z, w.
};

/// What a recording came to.
struct Recorded {
    std::uint64_t ticks = 0; ///< Ticks that were written, of all tools.
    std::uint64_t lost = 0;  ///< Ticks that are missing: they came faster than the file took them.
};

/// A setting of a session, with all that a panel needs to show it: see hapflow_setting_info.
struct Setting {
    std::uint32_t kind = 0;           ///< HAPFLOW_SETTING_...
    bool live = false;                ///< It may change while the session runs.
    double min = 0;                   ///< Smallest; 0 where kind says nothing of it.
    double max = 0;                   ///< Largest.
    std::string path;                 ///< As "fluid.viscosity".
    std::string group;                ///< The path without its last word.
    std::string unit;                 ///< As "m/s", in UTF-8; empty for none.
    std::string about;                ///< A sentence on what it does.
    std::vector<std::string> choices; ///< Every word of a choice.
    std::string usual;                ///< Its value where a scene says nothing.
};

/// A scene, its fluid and its tools; the host ticks them and steps the fluid, or lets the session do so. Owns the
/// session of the C interface, and destroys it.
class Session : public detail::Settable<Session> {
public:
    /// Makes a session: milliseconds to seconds, as the scene has particles. [main, several at once]
    explicit Session(const Config& config) : Session(config, std::vector<Device>()) {}

    /// The same with devices for a servo that the session ticks, in the order of the scene's tools. [main, several at
    /// once] It takes them over; if it throws they are as they were.
    Session(const Config& config, std::vector<Device>&& devices) : blank_(detail::made(hapflow_tool_state_init)) {
        negotiate();
        auto c = detail::made(hapflow_session_config_init);
        c.scene = detail::c_text_or_null(config.scene, "scene");
        c.toml = config.toml.empty() ? nullptr : config.toml.data();
        c.toml_length = config.toml.size();
        c.settings = detail::c_text_or_null(config.settings, "settings");
        c.threads = config.threads;
        c.fluid_drive = config.fluid_drive;
        c.record = config.record ? 1 : 0;
        c.built = config.built != nullptr ? config.built->handle() : hapflow_scene{};
        c.servo_drive = config.servo_drive;
        std::vector<hapflow_device> handles;
        for (const Device& device : devices) {
            handles.push_back(device.handle());
        }
        c.device_count = static_cast<std::uint32_t>(handles.size());
        c.devices = handles.data();
        if (config.log) {
            log_ = std::make_unique<Log>();
            log_->function = config.log;
            c.log = &Log::tell;
            c.log_user = log_.get();
        }
        detail::check_main(hapflow_session_create(&c, &session_), "session");
        for (Device& device : devices) {
            device.release();
        }
    }

    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    /// Leaves a null session in `other`: all that it does fails with HAPFLOW_ERROR_HANDLE. [any] But this thread must
    /// have both for itself, as for every move.
    Session(Session&& other) noexcept
        : session_(std::exchange(other.session_, hapflow_session{})),
          blank_(other.blank_),
          log_(std::move(other.log_)) {}

    /// Destroys what it had, and takes over the other's. [main] This thread must have both for itself.
    Session& operator=(Session&& other) noexcept {
        if (this != &other) {
            end();
            session_ = std::exchange(other.session_, hapflow_session{});
            blank_ = other.blank_;
            log_ = std::move(other.log_);
        }
        return *this;
    }

    /// Ends the session, if destroy() has not; waits for calls under way. [main]
    ~Session() { end(); }

    /// Ends the session now. [main] Waits for calls of other threads that are under way; later ones fail with
    /// HAPFLOW_ERROR_HANDLE.
    void destroy() { detail::check_main(hapflow_session_destroy(session_), "destroy"); }

    /// For functions of hapflow.h that are not here. Never destroy it. [any]
    [[nodiscard]] hapflow_session handle() const noexcept { return session_; }

    // -------------------------------------------------------------------------------------------- servo

    /// One servo tick: the hand is at `state`, and feels the wrench. [servo] On failure the wrench is zero.
    Tick tick(const ToolState& state) noexcept {
        return detail::ticked(state, blank_, [&](const hapflow_tool_state& c, hapflow_wrench& wrench) noexcept {
            return hapflow_servo_tick(session_, &c, &wrench);
        });
    }

    /// How many tools the scene has; each is ticked by itself. [any]
    [[nodiscard]] std::uint32_t tool_count() const {
        std::uint32_t count = 0;
        detail::check(hapflow_session_tool_count(session_, &count), "tool_count");
        return count;
    }

    /// No force from the next tick on, until the faults are cleared. [any]
    hapflow_result emergency_stop() noexcept { return hapflow_session_emergency_stop(session_); }

    /// Takes back every fault; the force then comes up slowly, as at a start. [any] Only a person who has seen that
    /// the device is safe should lead to this call.
    void clear_faults() { detail::check(hapflow_session_clear_faults(session_), "clear_faults"); }

    /// From the next tick on, no force on any tool is larger than `max_force` (N), and no torque than `max_torque` (N m):
    /// for good, for such a limit can be lowered and never raised. [any] Gives the result.
    hapflow_result limit_force(double max_force, double max_torque) noexcept {
        return hapflow_session_limit_force(session_, max_force, max_torque);
    }

    /// What a tool touched at its newest tick; nothing where solids are not felt. [main]
    [[nodiscard]] std::vector<Contact> contacts(std::uint32_t tool = 0) const {
        std::vector<Contact> contacts(HAPFLOW_MAX_CONTACTS);
        std::size_t count = 0;
        const hapflow_result result = hapflow_session_contacts(session_, tool, contacts.data(),
                                                               detail::size_of<Contact>(), contacts.size(), &count);
        detail::check_main(result, "contacts");
        contacts.resize(count < contacts.size() ? count : contacts.size());
        return contacts;
    }

    /// Where a tool is to be drawn: in no wall, wherever its hand is. [main]
    [[nodiscard]] Pose proxy(std::uint32_t tool = 0) const {
        Pose pose;
        const hapflow_result result =
            hapflow_session_proxy(session_, tool, pose.position.data(), pose.orientation.data());
        detail::check_main(result, "proxy");
        return pose;
    }

    // -------------------------------------------------------------------------------------------- recording

    /// Writes every tick of every tool to a CSV file from now on; Config::record was true. [main] `path` is the first
    /// tool's file; any other's has its number before the extension.
    void record(const std::string& path) {
        detail::check_main(hapflow_session_record(session_, detail::c_text(path, "record")), "record");
    }

    /// Ends the recording with the newest tick. [main] Waits for the file.
    Recorded record_stop() {
        Recorded recorded;
        detail::check_main(hapflow_session_record_stop(session_, &recorded.ticks, &recorded.lost), "record_stop");
        return recorded;
    }

    // -------------------------------------------------------------------------------------------- fluid

    /// Steps every fluid frame that has ended by `time_s` on the servo's clock. [fluid]
    void fluid_advance(double time_s) {
        detail::check(hapflow_fluid_advance(session_, time_s), "fluid_advance");
    }

    /// Steps one frame, whose tool path ends at `end_s` on the servo's clock. [fluid] For a thread in real time.
    void fluid_step(double end_s) { detail::check(hapflow_fluid_step(session_, end_s), "fluid_step"); }

    /// The particles at the end of the newest frame: x, y, z of each, in m. [fluid] Their order is no identity.
    /// `positions` becomes as long as needed, and keeps its room for the next time.
    void particles(std::vector<float>& positions) {
        std::size_t count = 0;
        detail::check(hapflow_fluid_particles(session_, nullptr, 0, &count), "particles");
        positions.resize(count * 3);
        // The [fluid] class is this thread's own: no frame comes between the two calls.
        detail::check(hapflow_fluid_particles(session_, positions.data(), count, &count), "particles");
        positions.resize(count * 3 < positions.size() ? count * 3 : positions.size());
    }

    /// The same, in a vector of its own. [fluid]
    [[nodiscard]] std::vector<float> particles() {
        std::vector<float> positions;
        particles(positions);
        return positions;
    }

    /// The particles that came last, whoever steps the fluid, as particles() gives them; and asks for more, which come
    /// with the next fluid frame. [main] There are none until the first have come.
    void latest_particles(std::vector<float>& positions) {
        std::size_t count = 0;
        detail::check_main(hapflow_session_particles(session_, nullptr, 0, &count), "latest_particles");
        positions.resize(count * 3);
        if (count > 0) {
            const hapflow_result result = hapflow_session_particles(session_, positions.data(), count, &count);
            detail::check_main(result, "latest_particles");
        }
    }

    // -------------------------------------------------------------------------------------------- obstacles

    /// How many obstacles the scene has. [any]
    [[nodiscard]] std::uint32_t obstacle_count() const {
        std::uint32_t count = 0;
        detail::check(hapflow_obstacle_count(session_, &count), "obstacle_count");
        return count;
    }

    /// Where obstacle `index`, from 0, is to be once publish_obstacles() is called. [obstacle] Gives the result.
    hapflow_result move_obstacle(std::uint32_t index, const Vec3& position,
                                 const std::array<double, 4>& orientation = {{0, 0, 0, 1}}) noexcept {
        return hapflow_obstacle_move(session_, index, position.data(), orientation.data());
    }

    /// Hands the places of all obstacles to the fluid, together. [obstacle] Gives the result.
    hapflow_result publish_obstacles() noexcept { return hapflow_obstacle_publish(session_); }

    // -------------------------------------------------------------------------------------------- settings

    /// Reads a setting: get<double>, get<bool>, get<Vec3>, or get<std::string>, which reads all of them. [main] A
    /// setting of another type throws an Error with HAPFLOW_ERROR_VALUE.
    template <class T = double>
    [[nodiscard]] T get(const std::string& path) const {
        if constexpr (std::is_same_v<T, double>) {
            double value = 0;
            const char* c_path = detail::c_text(path, "get");
            detail::check_main(hapflow_session_get(session_, c_path, &value), "get");
            return value;
        } else if constexpr (std::is_same_v<T, bool>) {
            const std::string text = get_text(path);
            if (text != "true" && text != "false") {
                throw Error(HAPFLOW_ERROR_VALUE, "get", path + " = " + text + ": not true or false");
            }
            return text == "true";
        } else if constexpr (std::is_same_v<T, Vec3>) {
            return vector(path, get_text(path));
        } else {
            static_assert(std::is_same_v<T, std::string>, "get<double>, <bool>, <Vec3> or <std::string>");
            return get_text(path);
        }
    }

    /// Every setting that the session has: those of the scene, then those of each source. [main]
    [[nodiscard]] std::vector<Setting> settings() const {
        std::uint32_t count = 0;
        detail::check_main(hapflow_session_setting_count(session_, &count), "settings");
        std::vector<Setting> settings(count);
        for (std::uint32_t index = 0; index < count; index++) {
            auto c = detail::made(hapflow_setting_info_init);
            detail::check_main(hapflow_session_setting_info(session_, index, &c), "settings");
            std::vector<std::string> choices;
            std::istringstream lines(c.choices);
            for (std::string word; std::getline(lines, word);) {
                choices.push_back(word);
            }
            settings[index] = {c.kind,  c.live != 0, c.min,   c.max,   c.path,
                               c.group, c.unit,      c.about, choices, c.usual};
        }
        return settings;
    }

    /// Reads the newest tick of a tool, and the newest frame. [main] Never waits for either.
    [[nodiscard]] Report report(std::uint32_t tool = 0) const {
        auto report = detail::made(hapflow_report_init);
        detail::check_main(hapflow_session_report_of(session_, tool, &report), "report");
        return report;
    }

    /// Reads a body as the newest fluid frame left it. [main] Never waits for the fluid.
    [[nodiscard]] BodyReport body_report(BodyList which, std::uint32_t index) const {
        auto report = detail::made(hapflow_body_report_init);
        const auto list = static_cast<std::uint32_t>(which);
        detail::check_main(hapflow_session_body_report(session_, list, index, &report), "body_report");
        return report;
    }

    /// How the servo of a tool keeps time, if the session ticks it. [main] Never waits for it.
    [[nodiscard]] ServoPace servo_pace(std::uint32_t tool = 0) const {
        auto pace = detail::made(hapflow_servo_pace_init);
        detail::check_main(hapflow_session_servo_pace(session_, tool, &pace), "servo_pace");
        return pace;
    }

    /// Tells Config::log what has happened since the last call; a few times a second is enough. [main]
    void poll() {
        detail::check_main(hapflow_session_poll(session_), "poll");
        if (log_ && log_->thrown) {
            std::rethrow_exception(std::exchange(log_->thrown, nullptr));
        }
    }

private:
    // What the library calls; it stays where it is when the session is moved.
    struct Log {
        std::function<void(std::uint32_t, const std::string&)> function;
        std::exception_ptr thrown; // the first; nothing may leave through the library

        static void tell(std::uint32_t level, const char* text, void* user) noexcept {
            Log& log = *static_cast<Log*>(user);
            try {
                log.function(level, text);
            } catch (...) {
                log.thrown = log.thrown ? log.thrown : std::current_exception();
            }
        }
    };

    // Fails only if there is no session any more, and then there is nothing to do.
    void end() noexcept {
        if (session_.id != 0) {
            static_cast<void>(hapflow_session_destroy(session_));
        }
    }

    friend class detail::Settable<Session>;

    hapflow_result set_number(const char* path, double value) { return hapflow_session_set(session_, path, value); }
    hapflow_result set_vector(const char* path, const double* v) {
        return hapflow_session_set_vector(session_, path, v);
    }
    hapflow_result set_text(const char* path, const char* v) { return hapflow_session_set_text(session_, path, v); }

    [[nodiscard]] std::string get_text(const std::string& path) const {
        const char* c_path = detail::c_text(path, "get");
        return detail::whole_text([&](char* text, std::size_t capacity, std::size_t* length) {
            detail::check_main(hapflow_session_get_text(session_, c_path, text, capacity, length), "get");
        });
    }

    /// "[0, -9.81, 0]", whatever the program's locale.
    static Vec3 vector(const std::string& path, const std::string& text) {
        std::istringstream in(text);
        in.imbue(std::locale::classic());
        Vec3 v{};
        char open = 0, first = 0, second = 0, close = 0;
        in >> open >> v[0] >> first >> v[1] >> second >> v[2] >> close;
        if (!in || open != '[' || first != ',' || second != ',' || close != ']') {
            throw Error(HAPFLOW_ERROR_VALUE, "get", path + " = " + text + ": not three numbers");
        }
        return v;
    }

    hapflow_session session_{};
    hapflow_tool_state blank_{};
    std::unique_ptr<Log> log_;
};

} // namespace hapflow

#endif
