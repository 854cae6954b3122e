// A haptic device as a plugin: a hand that bobs about where the tool starts, 1 mm up and down twice a second. A real one would
// talk to its machine in read and write, which hapflow calls at 1 kHz and which may wait for nothing but that.
//
//     c++ -std=c++17 -O2 -shared -fPIC -Iinclude examples/plugins/bobbing_device.cpp -o libbobbing_device.so
//     hapflow run tap --plugin ./libbobbing_device.so
#include <hapflow/hapflow.h>

#include <atomic>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace {

constexpr double amplitude_m = 0.001;
constexpr double angular_frequency = 2 * 6.283185307179586; // rad/s

/// There is one machine, and whoever opens it has it.
std::atomic<bool> open_already{false};
constexpr std::uint64_t handle = 1;

hapflow_result config_init(hapflow_device_config* config, std::uint32_t size) noexcept {
    if (config == nullptr) {
        return HAPFLOW_ERROR_NULL;
    }
    if (size < sizeof *config) {
        return HAPFLOW_ERROR_STRUCT;
    }
    *config = {};
    config->kind = HAPFLOW_KIND_DEVICE_CONFIG;
    config->size = size;
    return HAPFLOW_OK;
}

hapflow_result open(const hapflow_device_config* config, hapflow_device* device) noexcept {
    if (config == nullptr || device == nullptr) {
        return HAPFLOW_ERROR_NULL;
    }
    if (open_already.exchange(true)) {
        return HAPFLOW_ERROR_BUSY;
    }
    device->id = handle;
    return HAPFLOW_OK;
}

bool is_open(hapflow_device device) noexcept {
    return device.id == handle && open_already.load();
}

hapflow_result close(hapflow_device device) noexcept {
    return device.id == handle && open_already.exchange(false) ? hapflow_result{HAPFLOW_OK} : HAPFLOW_ERROR_HANDLE;
}

hapflow_result read(hapflow_device device, double time_s, hapflow_tool_state* state) noexcept {
    if (!is_open(device)) {
        return HAPFLOW_ERROR_HANDLE;
    }
    const double angle = angular_frequency * time_s;
    state->time_s = time_s;
    state->position[0] = state->position[2] = 0;
    state->position[1] = amplitude_m * std::sin(angle);
    state->velocity[0] = state->velocity[2] = 0;
    state->velocity[1] = amplitude_m * angular_frequency * std::cos(angle);
    return HAPFLOW_OK;
}

/// Nobody is there to feel it.
hapflow_result write(hapflow_device device, const hapflow_wrench*, double) noexcept {
    return is_open(device) ? HAPFLOW_OK : HAPFLOW_ERROR_HANDLE;
}

hapflow_result clear_faults(hapflow_device device) noexcept {
    return is_open(device) ? HAPFLOW_OK : HAPFLOW_ERROR_HANDLE;
}

const hapflow_device_extension table = {sizeof table, 0, config_init, open, close, read, write, clear_faults};

} // namespace

const void* hapflow_extension(const char* name) {
    return std::strcmp(name, HAPFLOW_EXTENSION_DEVICE) == 0 ? &table : nullptr;
}
