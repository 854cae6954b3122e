// A double of HAPI's devices: what a test puts in comes out, and it ticks when it is told to. As in HAPI a renderer that is
// replaced is released without the lock that a step holds, and deleted under it.
#ifndef DOUBLE_HAPI_HAPTICS_DEVICE_H
#define DOUBLE_HAPI_HAPTICS_DEVICE_H

#include <HAPI/HAPIHapticsRenderer.h>

#include <array>
#include <memory>
#include <mutex>
#include <string>

namespace HAPI {

class HAPIHapticsDevice {
public:
    enum ErrorCode { SUCCESS = 0, NOT_INITIALIZED = -1, FAIL = -5 };

    struct DeviceValues {
        Vec3 force, torque, position, velocity;
        Rotation orientation;
        HAPIInt32 button_status = 0;
        void* user_data = nullptr;
    };

    virtual ~HAPIHapticsDevice() = default;

    DeviceValues getDeviceValues() {
        const std::lock_guard<std::mutex> lock(values_lock);
        return values;
    }
    Vec3 getForce() { return getDeviceValues().force; }
    const Matrix4& getPositionCalibration() { return calibration; }

    void setHapticsRenderer(HAPIHapticsRenderer* renderer, unsigned layer = 0) {
        Layer& l = layers.at(layer);
        if (l.renderer) l.renderer->releaseRenderer(this);
        std::unique_ptr<HAPIHapticsRenderer> old;
        {
            const std::lock_guard<std::mutex> lock(renderer_change_lock);
            old = std::move(l.renderer);
            l.renderer.reset(renderer);
        }
        if (renderer != nullptr && initialised) renderer->initRenderer(this);
    }

    void addShape(HAPIHapticShape* shape, unsigned layer = 0) { layers.at(layer).shapes.push_back(shape); }
    void clearShapes(unsigned layer = 0) { layers.at(layer).shapes.clear(); }

    void transferObjects() {
        for (Layer& l : layers) {
            if (l.renderer && l.shapes.size() > 0) l.renderer->preProcessShapes(this, l.shapes);
        }
    }

    virtual ErrorCode initDevice(int /* rate */ = 1024) {
        for (Layer& l : layers) {
            if (l.renderer) l.renderer->initRenderer(this);
        }
        initialised = true;
        return SUCCESS;
    }
    virtual ErrorCode enableDevice() { return SUCCESS; }
    virtual ErrorCode releaseDevice() {
        for (Layer& l : layers) {
            if (l.renderer) l.renderer->releaseRenderer(this);
        }
        initialised = false;
        return SUCCESS;
    }
    std::string getLastErrorMsg() { return ""; }

    // What HAPI does not have.

    void set(const DeviceValues& v) {
        const std::lock_guard<std::mutex> lock(values_lock);
        values = v;
    }

    HAPIForceEffect::EffectOutput tick(HAPITime dt) {
        HAPIForceEffect::EffectOutput sum;
        {
            const std::lock_guard<std::mutex> lock(renderer_change_lock);
            for (Layer& l : layers) {
                if (!l.renderer) continue;
                const auto out = l.renderer->renderHapticsOneStep(this, l.shapes, dt);
                sum = {sum.force + out.force, sum.torque + out.torque};
            }
        }
        const std::lock_guard<std::mutex> lock(values_lock);
        values.force = sum.force;
        return sum;
    }

    Matrix4 calibration;

private:
    struct Layer {
        std::unique_ptr<HAPIHapticsRenderer> renderer;
        HAPIHapticsRenderer::HapticShapeVector shapes;
    };
    std::mutex values_lock;
    std::mutex renderer_change_lock;
    DeviceValues values;
    std::array<Layer, 2> layers;
    bool initialised = false;
};

} // namespace HAPI

#endif
