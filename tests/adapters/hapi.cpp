// SPDX-License-Identifier: GPL-2.0-or-later
// The HAPI adapter in a double of HAPI.
#include "support.hpp"

#include <HAPI/CollisionObjects.h>
#include <HAPI/HAPIHapticsDevice.h>
#include <HAPI/HapticPrimitive.h>

#include <hapflow/hapi/FluidEffect.h>
#include <hapflow/hapi/FluidRenderer.h>
#include <hapflow/hapi/Shapes.h>
#include <hapflow/hapi/Snapshot.h>

#include <atomic>
#include <memory>
#include <thread>

using hapflow::Vec3;
using hapflow::hapi::FluidEffect;
using hapflow::hapi::FluidRenderer;

static HAPI::HAPIHapticsDevice::DeviceValues values(const hapflow::ToolState& state) {
    HAPI::HAPIHapticsDevice::DeviceValues v;
    v.position = hapflow::hapi::from_scene(state.position);
    v.velocity = hapflow::hapi::from_scene(state.velocity);
    return v;
}

static void the_force_is_the_wrappers() {
    const auto want = expected(300);
    for (const double scale : {1.0, 0.5, 3.0}) {
        clock_s = 0;
        HAPI::HAPIHapticsDevice device;
        device.calibration.scale = {scale, scale, scale};
        auto* renderer = new FluidRenderer(jet());
        const Vec3 origin{{1, 2, 3}};
        renderer->setOrigin(origin);
        device.setHapticsRenderer(renderer, 1);
        CHECK(device.initDevice() == HAPI::HAPIHapticsDevice::SUCCESS);
        double most = 0;
        for (int tick = 0; tick < 300; tick++) {
            clock_s = tick * period_s;
            hapflow::ToolState state = motion(tick);
            for (std::size_t i = 0; i < 3; i++) state.position[i] += origin[i];
            device.set(values(state));
            const Vec3 felt = hapflow::hapi::to_scene(device.tick(123).force); // HAPI's dt is not looked at
            Vec3 w = want[static_cast<std::size_t>(tick)].force;
            for (double& f : w) f /= std::fmax(scale, 1);
            CHECK(near(felt, w, 1e-9)); // the place is 1e-15 m off, for the origin that is added and taken
            most = std::fmax(most, length(felt));
        }
        CHECK(most > 0.1 / scale);
    }
}

static void rotations_are_quaternions() {
    const auto q = hapflow::hapi::to_scene(HAPI::Rotation(0, 0, 2, 1.5707963267948966));
    CHECK(std::fabs(q[2] - std::sqrt(0.5)) < 1e-15 && std::fabs(q[3] - std::sqrt(0.5)) < 1e-15 && q[0] == 0);
    const auto none = hapflow::hapi::to_scene(HAPI::Rotation(0, 0, 0, 1));
    CHECK(none[3] == 1 && none[0] == 0);
}

static void shapes_are_obstacles() {
    namespace Collision = HAPI::Collision;
    HAPI::HAPIHapticsRenderer::HapticShapeVector shapes;
    auto* ball = new HAPI::HapticPrimitive(new Collision::Sphere({0.01, 0, 0}, 0.02), nullptr);
    ball->setScale({2, 2, 2});
    ball->setPosition({0, 0.1, 0});
    ball->setRotation({0, 0, 1, 1.5707963267948966});
    shapes.push_back(ball);
    shapes.push_back(new HAPI::HapticPrimitive(new Collision::Cylinder(0.01, 0.06), nullptr));
    shapes.push_back(new HAPI::HapticPrimitive(new Collision::AABox({0, 0, 0}, {0.02, 0.04, 0.06}), nullptr));
    shapes.push_back(new HAPI::HapticPrimitive(new Collision::Plane, nullptr));
    shapes.push_back(new HAPI::HAPIHapticShape);
    auto* stretched = new HAPI::HapticPrimitive(new Collision::Sphere({}, 0.02), nullptr);
    stretched->setScale({1, 2, 1});
    shapes.push_back(stretched);

    const auto taken = hapflow::hapi::obstacles_of(shapes, {{0, 0, 1}});
    CHECK(taken.obstacles.size() == 3 && taken.orientations.size() == 3 && taken.left_out == 3);
    CHECK(taken.obstacles[0].radius == 0.04 && near(taken.obstacles[0].position, {{0, 0.12, -1}}));
    CHECK(near(taken.obstacles[1].position, {{0, 0.03, -1}}) && taken.obstacles[1].length == 0.06);
    CHECK(near(taken.obstacles[2].extent, {{0.02, 0.04, 0.06}}) && near(taken.obstacles[2].position, {{0.01, 0.02, -0.97}}));
    CHECK(std::fabs(taken.orientations[0][2] - std::sqrt(0.5)) < 1e-15);
}

static void a_plate_stops_the_jet() {
    clock_s = 0;
    HAPI::HAPIHapticsDevice device;
    auto options = jet();
    options.config.settings = "run.backend = cpu\nfluid.spacing = 0.006\nfluid.lifetime = 0.15";
    auto* renderer = new FluidRenderer(options);
    device.setHapticsRenderer(renderer, 1);
    device.initDevice();
    // The mean force of the second half of 0.3 s.
    const auto felt = [&] {
        double sum = 0;
        for (int tick = 0; tick < 300; tick++) {
            clock_s += 1e-3;
            const double force = -device.tick(1e-3).force.y;
            sum += tick >= 150 ? force / 150 : 0;
        }
        return sum;
    };
    const double open = felt();
    namespace Collision = HAPI::Collision;
    auto* plate = new HAPI::HapticPrimitive(new Collision::AABox({-0.04, -0.004, -0.04}, {0.04, 0.004, 0.04}), nullptr);
    plate->setPosition({0, 0.028, 0});
    device.addShape(plate, 1);
    device.transferObjects();
    CHECK(renderer->shapeError().empty());
    const double covered = felt();
    plate->setPosition({0.09, 0.028, 0});
    device.transferObjects();
    const double uncovered = felt();
    CHECK(open > 0.1 && covered < 0.2 * open && uncovered > 0.8 * open);

    // A shape that cannot be an obstacle changes nothing, and says so.
    device.addShape(new HAPI::HapticPrimitive(new Collision::Sphere({}, -1), nullptr), 1);
    device.transferObjects();
    CHECK(!renderer->shapeError().empty() && felt() > 0.1);
}

static void a_release_gives_zero_and_what_comes_after_rises() {
    clock_s = 0;
    HAPI::HAPIHapticsDevice device;
    auto* renderer = new FluidRenderer(jet());
    device.setHapticsRenderer(renderer, 0);
    device.initDevice();
    for (int tick = 0; tick < 200; tick++) {
        clock_s += 1e-3;
        device.tick(1e-3);
    }
    CHECK(hapflow::hapi::to_scene(device.getForce())[1] < -0.1);
    renderer->releaseRenderer(&device);
    clock_s += 1e-3;
    CHECK(device.tick(1e-3).force.y == 0); // a step that comes after the release
    renderer->initRenderer(&device);
    clock_s += 1e-3;
    CHECK(device.tick(1e-3).force.y >= -2.0);
    // A device whose calibration is nonsense, or none, and one that is not there.
    renderer->calibrate(nullptr);
    const auto nothing = renderer->renderHapticsOneStep(&device, {}, nan_value);
    CHECK(std::isfinite(nothing.force.y));
}

static void a_renderer_is_swapped_a_thousand_times_while_it_runs() {
    auto options = jet();
    options.clock = nullptr;
    auto fluid = std::make_shared<hapflow::adapter::Fluid>(options);
    HAPI::HAPIHapticsDevice device;
    device.setHapticsRenderer(new FluidRenderer(fluid), 1);
    device.initDevice();
    std::atomic<bool> running{true};
    std::thread servo([&] {
        while (running) {
            const Vec3 f = hapflow::hapi::to_scene(device.tick(1e-3).force);
            CHECK(length(f) <= 4.001);
        }
    });
    for (int i = 0; i < 1000; i++) device.setHapticsRenderer(new FluidRenderer(fluid), 1);
    running = false;
    servo.join();
    device.releaseDevice();
}

static void an_effect_is_asked_twice_a_tick() {
    const auto want = expected(300);
    clock_s = 0;
    auto fluid = std::make_shared<hapflow::adapter::Fluid>(jet());
    const H3DUtil::AutoRef<FluidEffect> effect(new FluidEffect(fluid));
    HAPI::HAPIHapticsDevice device;
    for (int tick = 0; tick < 300; tick++) {
        device.set(values(motion(tick)));
        const HAPI::HAPIForceEffect::EffectInput input(&device, 1e-3);
        clock_s = tick * period_s;
        const Vec3 first = hapflow::hapi::to_scene(effect.get()->calculateForces(input).force);
        clock_s += 5e-6;
        const Vec3 second = hapflow::hapi::to_scene(effect.get()->calculateForces(input).force);
        CHECK(near(first, want[static_cast<std::size_t>(tick)].force) && first == second);
    }
    CHECK(fluid->session().report().tick == 300);
}

static void it_is_registered_once_and_made_by_name() {
    int times = 0;
    for (const auto& entry : HAPI::HAPIHapticsRenderer::registered()) {
        if (entry.name == "HapflowFluid") {
            times++;
            const std::unique_ptr<HAPI::HAPIHapticsRenderer> made(hapflow_hapi_create("waterfall"));
            CHECK(dynamic_cast<FluidRenderer*>(made.get()) != nullptr);
        }
    }
    CHECK(times == 1);
    CHECK(hapflow_hapi_create("no such scene") == nullptr);
}

int main() {
    the_force_is_the_wrappers();
    rotations_are_quaternions();
    shapes_are_obstacles();
    a_plate_stops_the_jet();
    a_release_gives_zero_and_what_comes_after_rises();
    a_renderer_is_swapped_a_thousand_times_while_it_runs();
    an_effect_is_asked_twice_a_tick();
    it_is_registered_once_and_made_by_name();
    std::puts("all passed");
}
