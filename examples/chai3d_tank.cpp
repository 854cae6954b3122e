// A CHAI3D program whose tool stirs a tank of water: a device, a world, a tool, a haptic thread. The lines with hapflow are
// all that the water took. It opens no window; world->renderAll of a program with one draws the particles.
//
//     ./chai3d_tank 10          seconds
#include <hapflow_chai3d.hpp>

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <exception>

using namespace chai3d;

static cWorld* world;
static cToolCursor* tool;
static cHapflowFluid* fluid;
static std::atomic<bool> running{true};
static std::atomic<bool> finished{false};

static void render_haptics() {
    while (running) {
        world->computeGlobalPositions(true);
        tool->updateFromDevice();
        tool->computeInteractionForces();
        fluid->apply(tool); // the fluid: 1
        tool->applyToDevice();
    }
    finished = true;
}

static void run(double seconds) {
    cHapticDeviceHandler handler;
    cGenericHapticDevicePtr device;
    handler.getDevice(device, 0);

    world = new cWorld();
    tool = new cToolCursor(world);
    world->addChild(tool);
    tool->setHapticDevice(cHapflowLimitedDevice::create(device)); // no more than the device can: 2
    tool->setWorkspaceRadius(1.0);
    tool->start();

    fluid = new cHapflowFluid(hapflow::adapter::Options("tank"));     // 3
    fluid->setWorkspaceScaleFactor(tool->getWorkspaceScaleFactor()); // 4
    fluid->setLocalPos(0.0, 0.0, -1.0);                             // the middle of the water in that of the hand: 5
    fluid->setHapticEnabled(false);                                 // for apply(), which gives the torque too: 6
    world->addChild(fluid);                                         // 7

    cThread haptics;
    haptics.start(render_haptics, CTHREAD_PRIORITY_HAPTICS);
    for (double t = 0; t < seconds; t += 0.1) {
        cSleepMs(100);
        const cVector3d force = tool->getDeviceGlobalForce();
        std::printf("force %7.3f %7.3f %7.3f N\n", force.x(), force.y(), force.z());
    }
    running = false;
    while (!finished) cSleepMs(1);
    tool->stop();
    delete world;
}

int main(int argc, char** argv) try {
    run(argc > 1 ? std::atof(argv[1]) : 10);
} catch (const std::exception& error) {
    std::fprintf(stderr, "chai3d_tank: %s\n", error.what());
    return 1;
}
