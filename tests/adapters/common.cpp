// The parts that the adapters share.
#include "support.hpp"

#include <atomic>
#include <thread>

using hapflow::Vec3;
using hapflow::adapter::Fluid;
using hapflow::adapter::Hand;
using hapflow::adapter::Limiter;
using hapflow::adapter::VelocityEstimator;

static void limiter() {
    Limiter limiter(4, 1000);
    CHECK(near(limiter.limit({{0.5, 0, 0}}, 1e-3), {{0.5, 0, 0}}));
    CHECK(near(limiter.limit({{3, 0, 0}}, 1e-3), {{1.5, 0, 0}})); // a newton a millisecond
    CHECK(near(limiter.limit({{3, 0, 0}}, 0), {{1.5, 0, 0}}));
    CHECK(near(limiter.limit({{3, 0, 0}}, nan_value), {{1.5, 0, 0}}));
    for (int i = 0; i < 20; i++) {
        CHECK(length(limiter.limit({{0, 1e300, 0}}, 1.0)) <= 4 * (1 + 1e-12));
    }
    CHECK(near(limiter.limit({{0, 9, 0}}, 1e-3), {{0, 4, 0}}));
    CHECK(length(limiter.limit({{0, nan_value, 0}}, 1e-3)) == 0);
    CHECK(near(limiter.limit({{9, 0, 0}}, 1e-3), {{1, 0, 0}})); // anew from zero
    CHECK(length(limiter.limit({{std::numeric_limits<double>::infinity(), 0, 0}}, 1e-3)) == 0);
    CHECK(near(limiter.limit({{0, 0, 9}}, 7), {{0, 0, 4}})); // a pause of 7 s counts as 10 ms
    CHECK(length(limiter.limit({}, 1e-6)) == 0);
}

static void velocity() {
    VelocityEstimator estimator(70), twice(70);
    Vec3 v{};
    for (int i = 0; i <= 100; i++) {
        v = estimator.update({{i * 1e-3, 0, 0}}, 1e-3);
        // Each sample comes two times, half a tick apart.
        twice.update({{i * 1e-3, 0, 0}}, 0.5e-3);
        CHECK(twice.update({{i * 1e-3, 0, 0}}, 0.5e-3)[0] < 1.11);
    }
    CHECK(std::fabs(v[0] - (1 - std::exp(-6.283185307179586 * 70 * 0.1))) < 1e-12);
    CHECK(length(estimator.update({{9, 0, 0}}, 0.2)) == 0); // after a gap at rest
    CHECK(length(estimator.update({{9, 0, 0}}, nan_value)) == 0);
    estimator.update({{9, nan_value, 0}}, 1e-3); // is refused with its place, and forgotten
    CHECK(length(estimator.update({{9, 0, 0}}, 1e-3)) == 0 && estimator.update({{9.001, 0, 0}}, 1e-3)[0] > 0.3);
}

static void a_fluid_feels_as_the_wrapper_does() {
    const auto want = expected(300);
    clock_s = 100; // whatever the clock begins with
    Fluid fluid(jet());
    double most = 0;
    for (int tick = 0; tick < 300; tick++) {
        clock_s = 100 + tick * period_s;
        const hapflow::ToolState state = motion(tick);
        Hand hand;
        hand.position = state.position;
        hand.velocity = state.velocity;
        const hapflow::Wrench felt = fluid.step(0, hand);
        CHECK(near(felt.force, want[static_cast<std::size_t>(tick)].force));
        most = std::fmax(most, length(felt.force));
    }
    CHECK(most > 0.1);
    CHECK(length(fluid.step(1, Hand()).force) == 0 && length(fluid.step(999, Hand()).force) == 0);
}

static void what_is_wrong_is_zero_and_latches() {
    clock_s = 0;
    Fluid fluid(jet());
    const auto run = [&](int ticks) {
        hapflow::Wrench felt;
        for (int tick = 0; tick < ticks; tick++) {
            clock_s += 1e-3;
            felt = fluid.step(0, Hand());
        }
        return length(felt.force);
    };
    CHECK(run(200) > 0.1);
    Hand bad;
    bad.position[0] = nan_value;
    CHECK(length(fluid.step(0, bad).force) == 0 && run(10) == 0);
    fluid.session().clear_faults();
    CHECK(run(200) > 0.1);

    clock_s -= 5; // a clock that goes back: time stands, and the force with it
    CHECK(std::isfinite(length(fluid.step(0, Hand()).force)));
    clock_s += 5;

    fluid.hold(0);
    CHECK(run(1) == 0 && run(100) == 0);
    fluid.go(0);
    CHECK(run(1) < 10.1); // at 1000 N/s, and a gap counts as 10 ms
    CHECK(run(200) > 0.1);
}

static void settings_stay_with_new_obstacles() {
    clock_s = 0;
    Fluid fluid(jet());
    fluid.set("source.tap.speed", "2");
    hapflow::Obstacle ball;
    ball.radius = 0.01;
    ball.position = {{0.03, 0, 0}};
    fluid.obstacles({ball}, {{{0, 0, 0, 1}}});
    CHECK(fluid.session().get("source.tap.speed") == 2 && fluid.session().obstacle_count() == 1);
    const auto first = fluid.session().handle().id;
    ball.position[0] = -0.03;
    fluid.obstacles({ball}, {{{0, 0, 0, 1}}}); // moved: the same session
    CHECK(fluid.session().handle().id == first);
    ball.radius = -1;
    bool threw = false;
    try {
        fluid.obstacles({ball}, {{{0, 0, 0, 1}}});
    } catch (const hapflow::Error&) {
        threw = true;
    }
    CHECK(threw && fluid.session().handle().id == first);
    fluid.obstacles({}, {});
    CHECK(fluid.session().obstacle_count() == 0 && fluid.session().get("source.tap.speed") == 2);
}

static void obstacles_come_while_a_servo_steps() {
    hapflow::adapter::Options options = jet();
    options.clock = nullptr;
    Fluid fluid(options);
    std::atomic<bool> running{true};
    std::atomic<unsigned> steps{0};
    std::thread servo([&] {
        while (running) {
            const hapflow::Wrench felt = fluid.step(0, Hand());
            CHECK(length(felt.force) <= 4.001);
            steps++;
        }
    });
    hapflow::Obstacle ball;
    ball.radius = 0.01;
    for (int i = 0; i < 50; i++) {
        const unsigned before = steps;
        ball.radius = i % 2 == 0 ? 0.01 : 0.012;
        fluid.obstacles({ball}, {{{0, 0, 0, 1}}});
        fluid.hold(0);
        fluid.go(0);
        while (steps == before) std::this_thread::yield();
    }
    running = false;
    servo.join();
}

int main() {
    limiter();
    velocity();
    a_fluid_feels_as_the_wrapper_does();
    what_is_wrong_is_zero_and_latches();
    settings_stay_with_new_obstacles();
    obstacles_come_while_a_servo_steps();
    std::puts("all passed");
}
