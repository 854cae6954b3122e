// SPDX-License-Identifier: GPL-2.0-or-later
// A fluid as a haptics renderer of HAPI.
#ifndef HAPFLOW_HAPI_FLUID_RENDERER_H
#define HAPFLOW_HAPI_FLUID_RENDERER_H

#include <HAPI/HAPIHapticsRenderer.h>

#include <hapflow/adapter/fluid.hpp>

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>

namespace hapflow::hapi {

/// The fluid of a hapflow scene. Give it a layer of its own, and leave solids to HAPI's renderers in another:
///
///     device.setHapticsRenderer(new HAPI::GodObjectRenderer, 0);
///     device.setHapticsRenderer(new hapflow::hapi::FluidRenderer(hapflow::adapter::Options("tap")), 1);
///
/// The device owns and deletes it, as HAPI has it: one renderer a device and layer. Spheres, upright cylinders and boxes
/// (HapticPrimitive) of its layer are obstacles in the fluid. It reports no contacts. No function that HAPI calls throws.
class FluidRenderer : public HAPI::HAPIHapticsRenderer {
public:
    /// Takes milliseconds to seconds. [main] Throws hapflow::Error with the reason.
    explicit FluidRenderer(adapter::Options options = adapter::Options("tap"));

    /// One of several devices in one fluid, each with a tool of the scene, from 0. [main] Obstacles are taken from the
    /// shapes of tool 0's layer.
    explicit FluidRenderer(std::shared_ptr<adapter::Fluid> fluid, std::uint32_t tool = 0);

    /// Where the scene's origin is in HAPI's world, m. [main] Before the renderer is installed.
    void setOrigin(const Vec3& origin) noexcept { origin_ = origin; }

    /// Looks at the device's calibration anew: whoever changes it calls this. [main] initRenderer and preProcessShapes do.
    void calibrate(HAPI::HAPIHapticsDevice* device) noexcept;

    /// Sets a live setting of the scene, as ("source.tap.speed", "1.5"). [main] Throws hapflow::Error.
    void set(const std::string& path, const std::string& value) { fluid_->set(path, value); }

    /// For reports, particles and faults; and for renderers of other devices.
    [[nodiscard]] const std::shared_ptr<adapter::Fluid>& fluid() const noexcept { return fluid_; }

    /// Why the newest shapes are no obstacles, or empty. [main]
    [[nodiscard]] const std::string& shapeError() const noexcept { return shape_error_; }

    void initRenderer(HAPI::HAPIHapticsDevice* device) override;
    /// Steps that are under way, or come late, go on safely and give zero: what they use ends with the renderer.
    void releaseRenderer(HAPI::HAPIHapticsDevice* device) override;
    void preProcessShapes(HAPI::HAPIHapticsDevice* device, const HapticShapeVector& shapes) override;
    using HAPI::HAPIHapticsRenderer::renderHapticsOneStep;
    /// HAPI's dt is of a clock that may be set back; it is not looked at.
    HAPI::HAPIForceEffect::EffectOutput renderHapticsOneStep(HAPI::HAPIHapticsDevice* device,
                                                             const HapticShapeVector& shapes,
                                                             HAPI::HAPITime dt) override;

    /// Registers it as "HapflowFluid", when its library is loaded.
    static HapticsRendererRegistration renderer_registration;

private:
    std::shared_ptr<adapter::Fluid> fluid_;
    std::uint32_t tool_ = 0;
    Vec3 origin_{};
    std::atomic<double> scale_{1};
    std::string shape_error_;
};

} // namespace hapflow::hapi

/// A FluidRenderer for `scene`, a name or a path (null: "tap"), or null where it cannot be made. For programs that load
/// the adapter by dlopen; never dlclose it, for HAPI keeps its registration.
extern "C" HAPI::HAPIHapticsRenderer* hapflow_hapi_create(const char* scene);

#endif
