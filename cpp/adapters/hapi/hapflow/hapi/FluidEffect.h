// SPDX-License-Identifier: GPL-2.0-or-later
// A fluid as a force effect of HAPI, for programs that have no layer to spare, or want its fades. FluidRenderer is the
// usual way: it alone sees shapes, and the calibration.
#ifndef HAPFLOW_HAPI_FLUID_EFFECT_H
#define HAPFLOW_HAPI_FLUID_EFFECT_H

#include <HAPI/HAPIForceEffect.h>

#include <hapflow/adapter/fluid.hpp>
#include <hapflow/hapi/Snapshot.h>

#include <cstdint>
#include <memory>
#include <utility>

namespace hapflow::hapi {

/// device.addEffect(new hapflow::hapi::FluidEffect(fluid)). Several in one fluid, one a device, have a tool each.
class FluidEffect : public HAPI::HAPIForceEffect {
public:
    /// `origin`: where the scene's origin is in HAPI's world, m. `scale`: how much the device's motion is magnified.
    explicit FluidEffect(std::shared_ptr<adapter::Fluid> fluid, std::uint32_t tool = 0, const Vec3& origin = {},
                         double scale = 1)
        : fluid_(std::move(fluid)), tool_(tool), origin_(origin), scale_(scale) {}

    /// While HAPI interpolates between sets of effects it asks one that is in both twice a tick: the second answer is
    /// the first. Of the same tick is what comes within half of it after the last. [servo]
    EffectOutput calculateForces(const EffectInput& input) override {
        try {
            const double now = fluid_->now();
            if (!begun_ || now - last_s_ >= 0.5 * static_cast<double>(input.deltaT)) {
                begun_ = true;
                last_s_ = now;
                wrench_ = fluid_->step(tool_, snapshot(*input.hd, origin_, scale_));
            }
            return {from_scene(wrench_.force), from_scene(wrench_.torque)};
        } catch (...) {
            return {};
        }
    }

private:
    std::shared_ptr<adapter::Fluid> fluid_;
    std::uint32_t tool_;
    Vec3 origin_;
    double scale_;
    bool begun_ = false;
    double last_s_ = 0;
    Wrench wrench_;
};

} // namespace hapflow::hapi

#endif
