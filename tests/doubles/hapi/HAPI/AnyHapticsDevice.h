// A double: a device with a thread of its own at about 1 kHz, in a hand that rests in the origin.
#ifndef DOUBLE_HAPI_ANY_HAPTICS_DEVICE_H
#define DOUBLE_HAPI_ANY_HAPTICS_DEVICE_H

#include <HAPI/HAPIHapticsDevice.h>

#include <atomic>
#include <chrono>
#include <thread>

namespace HAPI {

class AnyHapticsDevice : public HAPIHapticsDevice {
public:
    ~AnyHapticsDevice() override { stop(); }
    ErrorCode enableDevice() override {
        running = true;
        thread = std::thread([this] {
            while (running) {
                tick(1e-3);
                std::this_thread::sleep_for(std::chrono::milliseconds(1));
            }
        });
        return SUCCESS;
    }
    ErrorCode releaseDevice() override {
        stop();
        return HAPIHapticsDevice::releaseDevice();
    }

private:
    void stop() {
        running = false;
        if (thread.joinable()) thread.join();
    }
    std::atomic<bool> running{false};
    std::thread thread;
};

} // namespace HAPI

#endif
