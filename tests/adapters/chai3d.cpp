// The CHAI3D adapter in a double of CHAI3D.
#include "support.hpp"

#include <hapflow_chai3d.hpp>

#include <memory>

using chai3d::cMatrix3d;
using chai3d::cVector3d;
using hapflow::Vec3;

/// A world with the fluid, and a tool of a device with a workspace of 40 mm in 1 unit.
struct Stage {
    explicit Stage(hapflow::adapter::Options options = jet()) : fluid(new cHapflowFluid(std::move(options))) {
        tool.setHapticDevice(device);
        tool.setWorkspaceRadius(1);
        tool.start();
        fluid->setWorkspaceScaleFactor(tool.getWorkspaceScaleFactor());
        world.addChild(fluid);
    }

    /// The hand is at a place of the scene.
    void put(const hapflow::ToolState& state) {
        const double s = tool.getWorkspaceScaleFactor();
        const cMatrix3d rot = fluid->getGlobalRot();
        device->position = rot * hapflow::chai3d_axes::from_scene(state.position) + fluid->getGlobalPos() * (1 / s);
        device->velocity = rot * hapflow::chai3d_axes::from_scene(state.velocity);
    }

    /// Force in the scene's axes. `add`: by apply().
    Vec3 step(bool add = false) {
        tool.updateFromDevice();
        tool.computeInteractionForces();
        if (add) {
            fluid->apply(&tool);
        }
        tool.applyToDevice();
        cMatrix3d back;
        fluid->getGlobalRot().transr(back);
        return hapflow::chai3d_axes::to_scene(back * device->force);
    }

    chai3d::cWorld world;
    std::shared_ptr<chai3d::ScriptedDevice> device = std::make_shared<chai3d::ScriptedDevice>();
    chai3d::cToolCursor tool{&world};
    cHapflowFluid* fluid; // the world's
};

static cMatrix3d about(const Vec3& axis, double angle) {
    const double c = std::cos(angle), s = std::sin(angle), x = axis[0], y = axis[1], z = axis[2];
    cMatrix3d m;
    const double rows[3][3] = {{c + x * x * (1 - c), x * y * (1 - c) - z * s, x * z * (1 - c) + y * s},
                               {y * x * (1 - c) + z * s, c + y * y * (1 - c), y * z * (1 - c) - x * s},
                               {z * x * (1 - c) - y * s, z * y * (1 - c) + x * s, c + z * z * (1 - c)}};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) m(i, j) = rows[i][j];
    return m;
}

static void axes_are_the_scenes() {
    CHECK(near(hapflow::chai3d_axes::to_scene(cVector3d(1, 2, 3)), {{2, 3, 1}}));
    CHECK(near(hapflow::chai3d_axes::to_scene(cVector3d(25, 50, 75), 25), {{2, 3, 1}}));
    const double third = 1 / std::sqrt(3.0);
    const Vec3 turns[] = {{{1, 0, 0}}, {{0, 1, 0}}, {{0, 0, 1}}, {{third, -third, third}}, {{-0.6, 0, 0.8}}};
    for (const Vec3& axis : turns) {
        for (double angle = -3.1; angle <= 3.15; angle += 0.1) {
            const auto q = hapflow::chai3d_axes::to_scene(about(axis, angle));
            const double s = std::sin(angle / 2), c = std::cos(angle / 2);
            const double sign = q[3] * c + s * (q[0] * axis[1] + q[1] * axis[2] + q[2] * axis[0]) < 0 ? -1 : 1;
            CHECK(std::fabs(q[0] - sign * s * axis[1]) < 1e-7 && std::fabs(q[1] - sign * s * axis[2]) < 1e-7);
            CHECK(std::fabs(q[2] - sign * s * axis[0]) < 1e-7 && std::fabs(q[3] - sign * c) < 1e-7);
        }
    }
}

static void the_force_is_the_wrappers() {
    const auto want = expected(300);
    for (const bool add : {false, true}) {
        for (const bool moved : {false, true}) {
            clock_s = 0;
            Stage stage;
            stage.fluid->setHapticEnabled(!add);
            if (moved) {
                stage.fluid->setLocalPos({0.3, -0.2, 0.1});
                stage.fluid->setLocalRot(about({{0, 0.6, 0.8}}, 0.7));
            }
            double most = 0;
            for (int tick = 0; tick < 300; tick++) {
                clock_s = tick * period_s;
                stage.put(motion(tick));
                const Vec3 felt = stage.step(add);
                CHECK(near(felt, want[static_cast<std::size_t>(tick)].force, 1e-9));
                most = std::fmax(most, length(felt));
            }
            CHECK(most > 0.1);
            CHECK(stage.tool.events.m_interactions.size() == (add ? 0 : 1));
            CHECK(add || stage.tool.events.m_interactions[0].m_object == stage.fluid);
        }
    }
}

static void nothing_is_felt_twice() {
    clock_s = 0;
    Stage stage;
    for (int tick = 0; tick < 200; tick++) {
        clock_s = tick * period_s;
        const Vec3 felt = stage.step(tick % 2 == 1); // the world feels the fluid already
        CHECK(length(felt) <= 4);
    }
    CHECK(stage.fluid->fluid().session().report().tick == 200);
}

static void each_tool_has_a_lane() {
    auto options = jet();
    options.config.toml += "[[tool]]\n[[tool]]\nname = \"second\"\nposition = [0.06, 0.0, 0.0]\n";
    options.config.settings = "run.coupling = direct"; // one that is fitted knows where its tool began
    clock_s = 0;
    Stage stage(options);
    chai3d::cToolCursor second(&stage.world), third(&stage.world);
    for (auto* tool : {&second, &third}) {
        tool->setHapticDevice(std::make_shared<chai3d::ScriptedDevice>());
        tool->setWorkspaceRadius(1);
        tool->start();
    }
    for (int tick = 0; tick < 200; tick++) {
        clock_s = tick * period_s;
        CHECK(length(stage.step()) <= 4);
        second.updateFromDevice();
        second.computeInteractionForces();
        third.updateFromDevice();
        third.computeInteractionForces();
    }
    // Both in the same place feel the same; for the third the scene has no tool.
    const Vec3 first = hapflow::chai3d_axes::to_scene(stage.tool.getDeviceGlobalForce());
    CHECK(length(first) > 0.1 && near(hapflow::chai3d_axes::to_scene(second.getDeviceGlobalForce()), first));
    CHECK(length(hapflow::chai3d_axes::to_scene(third.getDeviceGlobalForce())) == 0);
    CHECK(stage.fluid->fluid().session().report(1).tick == 200);
}

static void it_draws_its_particles() {
    auto options = jet();
    options.config.settings = "run.backend = cpu\nfluid.spacing = 0.008";
    clock_s = 0;
    Stage stage(options);
    chai3d::cRenderOptions opaque, transparent;
    transparent.opaque = false;
    drawn = {};
    stage.world.renderAll(transparent);
    CHECK(drawn.at == nullptr && drawn.points == 0);
    for (int tick = 0; tick < 100; tick++) {
        clock_s = tick * period_s;
        stage.step();
        stage.world.renderAll(opaque);
    }
    CHECK(drawn.points > 10 && drawn.pushed == 0);
    const auto& m = drawn.matrix;
    CHECK(m[1] == 25 && m[6] == 25 && m[8] == 25); // x to y, y to z, z to x
}

static void a_device_is_kept_within_its_limits() {
    auto real = std::make_shared<chai3d::ScriptedDevice>();
    real->m_specifications.m_maxGripperForce = 2;
    double now = 0;
    const auto device = cHapflowLimitedDevice::create(real, 1000, 25, [&] { return now; });
    CHECK(device->isDeviceAvailable() && !device->isDeviceReady() && device->open() && device->isDeviceReady());
    unsigned down = 0;
    CHECK(device->getUserSwitches(down) && down == 5 && device->getSpecifications().m_maxLinearForce == 8);
    for (int tick = 0; tick < 20; tick++) {
        const double before = real->force.x();
        now = tick * 1e-3;
        device->setForceAndTorqueAndGripperForce({3000, 0, 0}, {0, 0, 5}, 99);
        CHECK(real->force.x() <= 8 && real->force.x() - before <= 1 + 1e-9);
        CHECK(real->torque.z() == 0 && real->gripper == 2); // it drives no torque
    }
    CHECK(std::fabs(real->force.x() - 8) < 1e-12);
    device->setForceAndTorqueAndGripperForce({nan_value, 0, 0}, {}, nan_value);
    CHECK(real->force.x() == 0 && real->gripper == 0);
    CHECK(device->close() && !device->isDeviceReady());
}

static void nonsense_gives_no_force() {
    clock_s = 0;
    Stage stage;
    stage.fluid->setWorkspaceScaleFactor(0);
    stage.fluid->setWorkspaceScaleFactor(nan_value); // both left out: 25 stays
    for (int tick = 0; tick < 200; tick++) {
        clock_s = tick * period_s;
        stage.step();
    }
    CHECK(length(stage.step()) > 0.1);
    stage.device->position = {nan_value, 0, 0};
    CHECK(length(stage.step()) == 0);
}

int main() {
    axes_are_the_scenes();
    the_force_is_the_wrappers();
    nothing_is_felt_twice();
    each_tool_has_a_lane();
    it_draws_its_particles();
    a_device_is_kept_within_its_limits();
    nonsense_gives_no_force();
    std::puts("all passed");
}
