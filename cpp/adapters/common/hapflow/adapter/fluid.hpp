// A fluid as a haptics library's own loop meets it: what the adapters have in common. It has its own clock, filters
// velocities, limits forces, and may be held, handed other obstacles and let go while a servo steps it.
#ifndef HAPFLOW_ADAPTER_FLUID_HPP
#define HAPFLOW_ADAPTER_FLUID_HPP

#include <hapflow/adapter/limiter.hpp>
#include <hapflow/adapter/road.hpp>
#include <hapflow/adapter/velocity.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace hapflow::adapter {

/// How a fluid is made.
struct Options {
    /// The scene by name or path. `settings`: lines `path = value` on top of it.
    explicit Options(std::string scene = "tank", std::string settings = {}) {
        config.scene = std::move(scene);
        config.settings = std::move(settings);
        config.fluid_drive = HAPFLOW_DRIVE_OWNED;
    }

    /// Of the session; the fluid steps itself. With HAPFLOW_DRIVE_HOST each step of the servo steps it, for small fluids.
    Config config;
    /// Low pass of velocities that come of positions, Hz; 0: velocities as the host gives them.
    double velocity_cutoff_hz = 70;
    /// Seconds that never go back, or empty for the machine's steady clock. Called on the servo's thread: it must not wait.
    std::function<double()> clock;
};

/// Where the hand is, in the scene's frame and in metres.
struct Hand {
    Vec3 position{};                                 ///< m.
    std::array<double, 4> orientation{{0, 0, 0, 1}}; ///< Unit quaternion x, y, z, w.
    Vec3 velocity{};                                 ///< m/s; looked at only without a low pass.
    Vec3 angular_velocity{};                         ///< rad/s.
    std::uint32_t buttons = 0;                       ///< Bit n: button n is down.
    double force_gain = 1;                           ///< Factor on what it feels, before the limits.
};

/// A fluid that tools of a haptics library are in. It must outlive the servo's last step.
class Fluid {
public:
    /// Takes milliseconds to seconds, as the scene has particles. [main] Throws Error with the reason.
    explicit Fluid(Options options) : options_(std::move(options)) {
        if (!options_.clock) {
            options_.clock = [] {
                return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
            };
        }
        if (options_.config.built != nullptr) {
            // It need not live longer than this call.
            options_.config.toml = options_.config.built->write();
            options_.config.built = nullptr;
        }
        begin(std::make_unique<Life>(options_, Parts{}));
    }

    Fluid(const Fluid&) = delete;
    Fluid& operator=(const Fluid&) = delete;

    /// What tool `tool` of the scene feels, from 0. [servo] Zero where there is no such tool, while it is held, and on
    /// every failure.
    Wrench step(std::uint32_t tool, const Hand& hand) noexcept {
        try {
            Life& life = *now_.load(std::memory_order_acquire);
            if (tool >= life.lanes.size()) {
                return {};
            }
            if (held_[tool].load(std::memory_order_acquire)) {
                life.lanes[tool].rest();
                return {};
            }
            return life.step(tool, hand, options_.clock());
        } catch (...) {
            return {};
        }
    }

    /// Lets no force out on a tool until go(). [any] Nothing is freed that a step uses.
    void hold(std::uint32_t tool) noexcept { let(tool, true); }

    /// Lets it out again, from zero at a limited rate. [any]
    void go(std::uint32_t tool) noexcept { let(tool, false); }

    /// How many tools the scene has. [any]
    [[nodiscard]] std::uint32_t tool_count() const noexcept {
        return static_cast<std::uint32_t>(now_.load(std::memory_order_acquire)->lanes.size());
    }

    /// Seconds on the clock of this fluid's ticks. [any]
    [[nodiscard]] double now() const { return options_.clock(); }

    /// Sets a live setting, for now and for whenever obstacles come to it. [main]
    void set(const std::string& path, const std::string& value) {
        session().set(path, value);
        options_.config.settings += "\n" + path + " = " + value;
    }

    /// These are the obstacles, after those of the scene. [main] If they differ in more than their places from those that
    /// there were, the fluid begins anew with them; else they move there within the next frame. Throws Error if they
    /// cannot be, and leaves all as it was.
    void obstacles(const std::vector<Obstacle>& parts, const std::vector<std::array<double, 4>>& orientations) {
        if (!same_forms(parts)) {
            begin(std::make_unique<Life>(options_, parts));
        }
        Life& life = *now_.load(std::memory_order_acquire);
        const auto first = session().obstacle_count() - static_cast<std::uint32_t>(parts.size());
        for (std::size_t i = 0; i < parts.size(); i++) {
            const auto index = first + static_cast<std::uint32_t>(i);
            detail::check(life.session.move_obstacle(index, parts[i].position, orientations[i]), "move_obstacle");
        }
        if (!parts.empty()) {
            detail::check(life.session.publish_obstacles(), "publish_obstacles");
        }
    }

    /// The session as it is now, for reports, particles and faults; obstacles() replaces it. [main]
    [[nodiscard]] Road::Session& session() noexcept { return now_.load(std::memory_order_acquire)->session; }

private:
    using Parts = std::vector<Obstacle>;

    /// What is remembered of a tool from tick to tick. Touched by its servo alone.
    struct Lane {
        Lane(const Options& options, const Road::Session& session)
            : velocity(options.velocity_cutoff_hz),
              force(session.get("gate.max_force"), session.get("gate.max_slew")),
              torque(session.get("gate.max_torque"), session.get("gate.max_torque_slew")) {}

        void rest() noexcept {
            velocity.reset();
            force.reset();
            torque.reset();
        }

        bool begun = false;
        double last_s = 0;
        VelocityEstimator velocity;
        Limiter force;
        Limiter torque;
    };

    /// A session, from its beginning until obstacles come that it was not made with.
    struct Life {
        Life(const Options& options, const Parts& with)
            : parts(with),
              filtered(options.velocity_cutoff_hz > 0),
              driven(options.config.fluid_drive == HAPFLOW_DRIVE_HOST),
              begun_s(options.clock()),
              session(made(options.config, with)),
              lanes(session.tool_count(), Lane(options, session)) {}

        /// The configuration's own session, or one of its scene with the obstacles added.
        static Road::Session made(const Config& config, const Parts& parts) {
            if (parts.empty()) {
                return Road::Session(config);
            }
            Scene scene = config.toml.empty() ? Scene::load(config.scene) : Scene::parse(config.toml);
            for (const Obstacle& part : parts) {
                scene.add(part);
            }
            Config with = config;
            with.scene.clear();
            with.toml.clear();
            with.built = &scene;
            return Road::Session(with);
        }

        Wrench step(std::uint32_t tool, const Hand& hand, double clock_s) {
            Lane& lane = lanes[tool];
            ToolState state;
            state.tool = tool;
            state.time_s = std::max(clock_s - begun_s, lane.last_s);
            state.dt_s = lane.begun ? state.time_s - lane.last_s : 0.001;
            state.position = hand.position;
            state.orientation = hand.orientation;
            const Vec3 estimate = lane.velocity.update(hand.position, state.dt_s);
            state.velocity = filtered ? estimate : hand.velocity;
            state.angular_velocity = hand.angular_velocity;
            state.buttons = hand.buttons;
            lane.begun = true;
            lane.last_s = state.time_s;
            if (driven) {
                session.fluid_advance(state.time_s);
            }
            const Tick tick = session.tick(state);
            return {lane.force.limit(times(tick.wrench.force, hand.force_gain), state.dt_s),
                    lane.torque.limit(times(tick.wrench.torque, hand.force_gain), state.dt_s)};
        }

        static Vec3 times(const Vec3& v, double factor) noexcept {
            return {{v[0] * factor, v[1] * factor, v[2] * factor}};
        }

        Parts parts;
        bool filtered;
        bool driven;
        double begun_s;
        Road::Session session;
        std::vector<Lane> lanes;
    };

    void let(std::uint32_t tool, bool held) noexcept {
        if (tool < held_.size()) {
            held_[tool].store(held, std::memory_order_release);
        }
    }

    [[nodiscard]] bool same_forms(const Parts& parts) const noexcept {
        const auto same = [](const Obstacle& a, const Obstacle& b) {
            return a.shape == b.shape && a.radius == b.radius && a.thickness == b.thickness && a.length == b.length &&
                   a.extent == b.extent;
        };
        const Parts& had = now_.load(std::memory_order_acquire)->parts;
        return std::equal(parts.begin(), parts.end(), had.begin(), had.end(), same);
    }

    /// The old session ends; a step that is under way in it is waited for, and one that comes late to it gives zero. Its
    /// shell stays, since a servo may still look at it.
    void begin(std::unique_ptr<Life> life) {
        lives_.push_back(std::move(life));
        Life* old = now_.exchange(lives_.back().get(), std::memory_order_acq_rel);
        if (old != nullptr) {
            old->session.destroy();
        }
    }

    Options options_;
    std::vector<std::unique_ptr<Life>> lives_;
    std::atomic<Life*> now_{nullptr};
    std::array<std::atomic<bool>, HAPFLOW_MAX_TOOLS> held_{};
};

} // namespace hapflow::adapter

#endif
