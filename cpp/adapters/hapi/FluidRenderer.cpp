// SPDX-License-Identifier: GPL-2.0-or-later
#include <hapflow/hapi/FluidRenderer.h>

#include <hapflow/hapi/Shapes.h>
#include <hapflow/hapi/Snapshot.h>

#include <exception>
#include <utility>

namespace hapflow::hapi {

// HAPI copies it into its list; this object's making is the only registration.
HAPI::HAPIHapticsRenderer::HapticsRendererRegistration FluidRenderer::renderer_registration(
    "HapflowFluid", [] { return hapflow_hapi_create(nullptr); });

FluidRenderer::FluidRenderer(adapter::Options options)
    : fluid_(std::make_shared<adapter::Fluid>(std::move(options))) {}

FluidRenderer::FluidRenderer(std::shared_ptr<adapter::Fluid> fluid, std::uint32_t tool)
    : fluid_(std::move(fluid)), tool_(tool) {}

void FluidRenderer::calibrate(HAPI::HAPIHapticsDevice* device) noexcept {
    try {
        if (device != nullptr) {
            scale_.store(magnification(*device), std::memory_order_relaxed);
        }
    } catch (...) {
        // A matrix without a scale: the last one stays.
    }
}

void FluidRenderer::initRenderer(HAPI::HAPIHapticsDevice* device) {
    calibrate(device);
    fluid_->go(tool_);
}

void FluidRenderer::releaseRenderer(HAPI::HAPIHapticsDevice*) {
    fluid_->hold(tool_);
}

void FluidRenderer::preProcessShapes(HAPI::HAPIHapticsDevice* device, const HapticShapeVector& shapes) {
    calibrate(device);
    if (tool_ != 0) {
        return;
    }
    try {
        const Shapes taken = obstacles_of(shapes, origin_);
        fluid_->obstacles(taken.obstacles, taken.orientations);
        shape_error_ = taken.left_out == 0 ? "" : std::to_string(taken.left_out) + " shapes are no obstacles: only " +
                                                      "spheres, cylinders and boxes of an even scale can be";
    } catch (const std::exception& error) {
        shape_error_ = error.what();
    } catch (...) {
        shape_error_ = "the shapes cannot be read";
    }
}

HAPI::HAPIForceEffect::EffectOutput FluidRenderer::renderHapticsOneStep(HAPI::HAPIHapticsDevice* device,
                                                                        const HapticShapeVector&, HAPI::HAPITime) {
    try {
        const double scale = scale_.load(std::memory_order_relaxed);
        const Wrench wrench = fluid_->step(tool_, snapshot(*device, origin_, scale));
        return {from_scene(wrench.force), from_scene(wrench.torque)};
    } catch (...) {
        return {};
    }
}

} // namespace hapflow::hapi

extern "C" HAPI::HAPIHapticsRenderer* hapflow_hapi_create(const char* scene) {
    try {
        return new hapflow::hapi::FluidRenderer(hapflow::adapter::Options(scene != nullptr ? scene : "tap"));
    } catch (...) {
        return nullptr;
    }
}
