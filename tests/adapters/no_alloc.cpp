// SPDX-License-Identifier: GPL-2.0-or-later
// No servo call of an adapter or a wrapper allocates or frees, libhapflow's part of it included: in water that flows, with
// obstacles that come, refused samples and faults. With the fluid in a thread of its own, whose memory is its own affair.
#include "support.hpp"

#include <hapflow/hapi/FluidEffect.h>
#include <hapflow/hapi/FluidRenderer.h>
#include <hapflow_chai3d.hpp>

#include <cerrno>
#include <chrono>
#include <cstddef>
#include <memory>
#include <thread>

// --- What is counted -----------------------------------------------------------------------------------

static thread_local bool watched = false;
static thread_local int seen = 0;

static void count() noexcept { seen += watched ? 1 : 0; }

// glibc's own, which it names for this. Operator new, and Rust's, come here too.
extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);
void __libc_free(void*);

void* malloc(std::size_t size) noexcept { return count(), __libc_malloc(size); }
void* calloc(std::size_t n, std::size_t size) noexcept { return count(), __libc_calloc(n, size); }
void* realloc(void* p, std::size_t size) noexcept { return count(), __libc_realloc(p, size); }
void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept { return count(), __libc_memalign(alignment, size); }
int posix_memalign(void** p, std::size_t alignment, std::size_t size) noexcept {
    count();
    *p = __libc_memalign(alignment, size);
    return *p != nullptr ? 0 : ENOMEM;
}
void free(void* p) noexcept { count(), __libc_free(p); }
}

template <class Call>
static int allocations(Call call) {
    seen = 0;
    watched = true;
    call();
    watched = false;
    return seen;
}

// --- What must not -------------------------------------------------------------------------------------

static hapflow::adapter::Options flowing() {
    auto options = jet();
    options.config.fluid_drive = HAPFLOW_DRIVE_OWNED;
    options.velocity_cutoff_hz = 70;
    return options;
}

/// Ticks on until the fluid has been felt, and then as long again; `step` gives the force. A bad sample comes now and then,
/// after which `clear` takes back what it raised, unwatched.
template <class Step, class Clear>
static void never_allocates(Step step, Clear clear) {
    step(motion(0)); // the first may make what lasts
    int felt = 0, allocated = 0;
    for (int tick = 1; tick < 20000 && felt < 300; tick++) {
        clock_s = tick * period_s;
        hapflow::ToolState state = motion(tick);
        if (tick % 100 == 99) state.position[1] = nan_value;
        double force = 0;
        allocated += allocations([&] { force = length(step(state)); });
        CHECK(std::isfinite(force));
        felt += force > 0.1 ? 1 : 0;
        if (tick % 100 == 99) clear();
        std::this_thread::sleep_for(std::chrono::microseconds(200)); // for the fluid's thread
    }
    CHECK(felt == 300);
    CHECK(allocated == 0);
}

static void the_counter_counts() {
    CHECK(allocations([] { delete new int(7); }) == 2);
    // In the library too: a setting is a text there.
    hapflow::Session session(jet().config);
    CHECK(allocations([&] { session.set("source.tap.speed", "1.25"); }) > 0);
}

template <class Session>
static void a_session() {
    clock_s = 0;
    Session session(flowing().config);
    never_allocates([&](const hapflow::ToolState& state) { return session.tick(state).wrench.force; },
                    [&] { session.clear_faults(); });
}

static HAPI::HAPIHapticsDevice::DeviceValues values(const hapflow::ToolState& state) {
    HAPI::HAPIHapticsDevice::DeviceValues v;
    v.position = hapflow::hapi::from_scene(state.position);
    v.velocity = hapflow::hapi::from_scene(state.velocity);
    return v;
}

static void the_renderer_of_hapi() {
    clock_s = 0;
    HAPI::HAPIHapticsDevice device;
    auto* renderer = new hapflow::hapi::FluidRenderer(flowing());
    device.setHapticsRenderer(renderer, 1);
    device.initDevice();
    int cleared = 0;
    const auto clear = [&] {
        renderer->fluid()->session().clear_faults();
        // The fluid begins anew with an obstacle, off the jet, and goes on with it moved.
        hapflow::Obstacle ball;
        ball.radius = 0.01;
        ball.position = {{0.06 + 0.001 * cleared++, 0, 0}};
        if (cleared < 4) renderer->fluid()->obstacles({ball}, {{{0, 0, 0, 1}}});
    };
    never_allocates(
        [&](const hapflow::ToolState& state) {
            device.set(values(state));
            return hapflow::hapi::to_scene(device.tick(1e-3).force);
        },
        clear);
}

static void the_effect_of_hapi() {
    clock_s = 0;
    auto fluid = std::make_shared<hapflow::adapter::Fluid>(flowing());
    const H3DUtil::AutoRef<hapflow::hapi::FluidEffect> effect(new hapflow::hapi::FluidEffect(fluid));
    HAPI::HAPIHapticsDevice device;
    const HAPI::HAPIForceEffect::EffectInput input(&device, 1e-3);
    never_allocates(
        [&](const hapflow::ToolState& state) {
            device.set(values(state));
            return hapflow::hapi::to_scene(effect.get()->calculateForces(input).force);
        },
        [&] { fluid->session().clear_faults(); });
}

/// As a force of the world, or by apply(), which gives the torque too; to a device that is kept within its limits.
static void the_object_of_chai3d(bool add) {
    clock_s = 0;
    chai3d::cWorld world;
    chai3d::cToolCursor tool(&world);
    auto device = std::make_shared<chai3d::ScriptedDevice>();
    tool.setHapticDevice(cHapflowLimitedDevice::create(device, 1000, 25, [] { return clock_s; }));
    tool.setWorkspaceRadius(1);
    tool.start();
    auto* fluid = new cHapflowFluid(flowing());
    fluid->setWorkspaceScaleFactor(tool.getWorkspaceScaleFactor());
    fluid->setHapticEnabled(!add);
    world.addChild(fluid);
    const auto step = [&](const hapflow::ToolState& state) {
        device->position = hapflow::chai3d_axes::from_scene(state.position);
        tool.updateFromDevice();
        tool.computeInteractionForces();
        fluid->apply(&tool);
        tool.applyToDevice();
        return hapflow::chai3d_axes::to_scene(device->force);
    };
    // CHAI3D's own list of events grows with the first contact, and keeps its room.
    tool.events.m_interactions.reserve(8);
    never_allocates(step, [&] { fluid->fluid().session().clear_faults(); });
}

int main() {
    the_counter_counts();
    a_session<hapflow::Session>();
    a_session<hapflow::adapter::Road::Session>();
    the_renderer_of_hapi();
    the_effect_of_hapi();
    the_object_of_chai3d(false);
    the_object_of_chai3d(true);
    std::puts("all passed");
}
