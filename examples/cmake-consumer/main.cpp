// The least that feels something: half a second under a tap, in the host's own loop.
#include <hapflow/hapflow.hpp>

#include <cstdio>
#include <exception>

int main(int argc, char** argv) try {
    hapflow::Config config;
    config.scene = "tap";
    config.settings = argc > 1 ? argv[1] : ""; // on top of the scene, as "fluid.spacing = 0.01"
    hapflow::Session session(config);

    hapflow::ToolState state; // at rest under the tap
    hapflow::Tick tick;
    for (int n = 0; n < 500; n++) {
        state.time_s = n * 1e-3;
        session.fluid_advance(state.time_s);
        tick = session.tick(state);
    }
    const hapflow::Vec3& force = tick.wrench.force;
    std::printf("hapflow %u: %s; force %.3f %.3f %.3f N\n", hapflow::version(), tick.text(), force[0], force[1],
                force[2]);
    return tick.ok() ? 0 : 1;
} catch (const std::exception& error) {
    std::fprintf(stderr, "consumer: %s\n", error.what());
    return 1;
}
