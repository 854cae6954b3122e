// A double of HAPI's renderers, whose registry can be seen.
#ifndef DOUBLE_HAPI_HAPTICS_RENDERER_H
#define DOUBLE_HAPI_HAPTICS_RENDERER_H

#include <HAPI/HAPIForceEffect.h>
#include <HAPI/HAPIHapticShape.h>

#include <list>
#include <string>

namespace HAPI {

class HAPIHapticsRenderer {
public:
    typedef H3DUtil::AutoRefVector<HAPIHapticShape> HapticShapeVector;
    typedef HAPIHapticsRenderer* (*CreateInstanceFunc)();

    struct HapticsRendererRegistration {
        HapticsRendererRegistration(const std::string& n, CreateInstanceFunc c) : name(n), create_func(c) {
            registered().push_back(*this);
        }
        std::string name;
        CreateInstanceFunc create_func;
    };
    static std::list<HapticsRendererRegistration>& registered() {
        static std::list<HapticsRendererRegistration> all;
        return all;
    }

    virtual ~HAPIHapticsRenderer() = default;
    virtual void initRenderer(HAPIHapticsDevice*) {}
    virtual void releaseRenderer(HAPIHapticsDevice*) {}
    virtual void preProcessShapes(HAPIHapticsDevice*, const HapticShapeVector&) {}
    virtual HAPIForceEffect::EffectOutput renderHapticsOneStep(HAPIHapticsDevice*, const HapticShapeVector&) {
        return {};
    }
    virtual HAPIForceEffect::EffectOutput renderHapticsOneStep(HAPIHapticsDevice* hd, const HapticShapeVector& shapes,
                                                               HAPITime) {
        return renderHapticsOneStep(hd, shapes);
    }
};

} // namespace HAPI

#endif
