// A double of HAPI's force effects.
#ifndef DOUBLE_HAPI_FORCE_EFFECT_H
#define DOUBLE_HAPI_FORCE_EFFECT_H

#include <HAPI/HAPITypes.h>

namespace HAPI {

class HAPIHapticsDevice;

class HAPIForceEffect : public H3DUtil::RefCountedClass {
public:
    struct EffectInput {
        explicit EffectInput(HAPIHapticsDevice* d, const TimeStamp& dt = 0) : deltaT(dt), hd(d) {}
        TimeStamp deltaT;
        HAPIHapticsDevice* hd;
    };

    struct EffectOutput {
        EffectOutput(const Vec3& f = Vec3(), const Vec3& t = Vec3()) : force(f), torque(t) {}
        Vec3 force;
        Vec3 torque;
    };

    virtual EffectOutput calculateForces(const EffectInput& input) = 0;
};

} // namespace HAPI

#endif
