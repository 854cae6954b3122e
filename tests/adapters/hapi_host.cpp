// SPDX-License-Identifier: GPL-2.0-or-later
// A HAPI program that knows nothing of hapflow, and loads the adapter's library: hapi_host FILE
#include <HAPI/HAPIHapticsDevice.h>

#include <dlfcn.h>

#include <cstdio>

int main(int, char** argv) {
    void* library = dlopen(argv[1], RTLD_LAZY | RTLD_GLOBAL);
    if (library == nullptr) {
        std::fprintf(stderr, "%s\n", dlerror());
        return 1;
    }
    for (const auto& entry : HAPI::HAPIHapticsRenderer::registered()) std::printf("%s\n", entry.name.c_str());
    using Create = HAPI::HAPIHapticsRenderer* (*)(const char*);
    const auto create = reinterpret_cast<Create>(dlsym(library, "hapflow_hapi_create"));
    HAPI::HAPIHapticsDevice device;
    device.setHapticsRenderer(create("waterfall"), 1);
    device.initDevice();
    device.tick(1e-3);
    device.releaseDevice();
    std::printf("%s\n", create("nothing") == nullptr ? "stepped" : "made of nothing");
}
