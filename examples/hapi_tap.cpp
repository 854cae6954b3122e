// An ordinary HAPI program with a solid ball in layer 0, and a jet of water in layer 1: the lines with hapflow are all that
// it took. Needs HAPI (GPL), and so is this example.
// SPDX-License-Identifier: GPL-2.0-or-later
//
//     ./hapi_tap 10          seconds
#include <HAPI/AnyHapticsDevice.h>
#include <HAPI/FrictionSurface.h>
#include <HAPI/GodObjectRenderer.h>
#include <HAPI/HapticPrimitive.h>

#include <hapflow/hapi/FluidRenderer.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <thread>

static void run(double seconds) {
    HAPI::AnyHapticsDevice device;
    device.setHapticsRenderer(new HAPI::GodObjectRenderer, 0);
    hapflow::adapter::Options water("tap");                            // the fluid: 1
    auto* fluid = new hapflow::hapi::FluidRenderer(water);             // 2
    device.setHapticsRenderer(fluid, 1);                               // 3

    if (device.initDevice() != HAPI::HAPIHapticsDevice::SUCCESS) {
        std::fprintf(stderr, "hapi_tap: %s\n", device.getLastErrorMsg().c_str());
        return;
    }
    device.enableDevice();
    auto* ball = new HAPI::HapticPrimitive(new HAPI::Collision::Sphere(HAPI::Vec3(0.05, -0.04, 0), 0.03),
                                           new HAPI::FrictionSurface);
    device.addShape(ball, 0);

    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
    while (std::chrono::steady_clock::now() < end) {
        device.transferObjects();
        const HAPI::Vec3 force = device.getForce();
        const hapflow::Report report = fluid->fluid()->session().report(); // a look at the fluid: 4
        std::printf("force %7.3f %7.3f %7.3f N  particles %llu  faults %#x\n", force.x, force.y, force.z,
                    0ULL + report.particles, report.faults);
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    device.releaseDevice();
}

int main(int argc, char** argv) try {
    run(argc > 1 ? std::atof(argv[1]) : 10);
} catch (const std::exception& error) {
    std::fprintf(stderr, "hapi_tap: %s\n", error.what());
    return 1;
}
