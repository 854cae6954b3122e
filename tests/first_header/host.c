/* A host of the first header, which is compiled with the newest one as well (-DNEWEST): both print the same. */
#ifdef NEWEST
#include <hapflow/hapflow.h>
#else
#include "hapflow/hapflow.h" /* the one beside this file */
#endif

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define DONE(call)                                                                                     \
    do {                                                                                               \
        hapflow_result result = (call);                                                                \
        if (result < 0) {                                                                              \
            fprintf(stderr, "line %d: %s\n", __LINE__, hapflow_result_text(result));                   \
            exit(1);                                                                                   \
        }                                                                                              \
    } while (0)
#define MUST(condition)                                                                                \
    do {                                                                                               \
        if (!(condition)) {                                                                            \
            fprintf(stderr, "line %d: %s\n", __LINE__, #condition);                                    \
            exit(1);                                                                                   \
        }                                                                                              \
    } while (0)

/* A struct, and what the host has behind it: a library that takes it for a longer one is found. */
#define WITH_NEIGHBOUR(type)                                                                           \
    struct {                                                                                           \
        type it;                                                                                       \
        unsigned char neighbour[256];                                                                  \
    }
#define MAKE(made, init)                                                                               \
    do {                                                                                               \
        memset(&(made), 0xa5, sizeof(made));                                                           \
        DONE(init(&(made).it, (uint32_t)sizeof(made).it));                                             \
    } while (0)
#define UNTOUCHED(made) MUST(untouched((made).neighbour))

static int untouched(const unsigned char neighbour[256]) {
    for (int i = 0; i < 256; i++) {
        if (neighbour[i] != 0xa5) return 0;
    }
    return 1;
}

static hapflow_session create(const char* scene, const char* toml, const char* settings) {
    WITH_NEIGHBOUR(hapflow_session_config) config;
    MAKE(config, hapflow_session_config_init);
    config.it.scene = scene;
    config.it.toml = toml;
    config.it.settings = settings;
    config.it.threads = 1;
    hapflow_session session;
    DONE(hapflow_session_create(&config.it, &session));
    UNTOUCHED(config);
    return session;
}

/* A hand that bobs under the jet: the force of the last tick is printed, to the last bit. */
static void feel(hapflow_session session, int ticks) {
    WITH_NEIGHBOUR(hapflow_tool_state) state;
    WITH_NEIGHBOUR(hapflow_wrench) wrench;
    MAKE(state, hapflow_tool_state_init);
    memset(&wrench, 0xa5, sizeof wrench);
    for (int n = 0; n < ticks; n++) {
        state.it.time_s = n * 1e-3;
        state.it.position[0] = 0.004 * sin(25 * state.it.time_s);
        state.it.velocity[0] = 0.1 * cos(25 * state.it.time_s);
        DONE(hapflow_fluid_advance(session, state.it.time_s));
        DONE(hapflow_servo_tick(session, &state.it, &wrench.it));
    }
    UNTOUCHED(state);
    UNTOUCHED(wrench);
    const double* f = wrench.it.force;
    MUST(f[1] < -0.05 && isfinite(f[0]) && isfinite(f[2]));
    printf("force %.17g %.17g %.17g\n", f[0], f[1], f[2]);
}

static void look(hapflow_session session) {
    WITH_NEIGHBOUR(hapflow_report) report;
    MAKE(report, hapflow_report_init);
    DONE(hapflow_session_report(session, &report.it));
    UNTOUCHED(report);
    size_t count;
    DONE(hapflow_fluid_particles(session, NULL, 0, &count));
    MUST(count == report.it.particles && report.it.force[1] < -0.05);
    printf("report %llu %.17g %llu %u\n", 0ULL + report.it.tick, report.it.force[1], 0ULL + report.it.fluid_frame,
           report.it.faults);
}

static void settings(hapflow_session session) {
    double value;
    DONE(hapflow_session_set(session, "source.tap.speed", 1.25));
    DONE(hapflow_session_set_text(session, "gate.max_force", "3"));
    DONE(hapflow_session_get(session, "source.tap.speed", &value));
    MUST(value == 1.25);
    char text[200];
    size_t length;
    MUST(hapflow_session_set(session, "fluid.viscosity", -1) == HAPFLOW_ERROR_VALUE);
    DONE(hapflow_last_error(text, sizeof text, &length));
    printf("refused %s\n", text);
}

static void stop(hapflow_session session) {
    hapflow_tool_state state;
    hapflow_wrench wrench;
    DONE(hapflow_tool_state_init(&state, sizeof state));
    DONE(hapflow_session_emergency_stop(session));
    state.time_s = 100;
    MUST(hapflow_servo_tick(session, &state, &wrench) > 0 && wrench.force[1] == 0);
    DONE(hapflow_session_clear_faults(session));
    DONE(hapflow_session_destroy(session));
    MUST(hapflow_servo_tick(session, &state, &wrench) == HAPFLOW_ERROR_HANDLE && wrench.force[1] == 0);
}

int main(void) {
    uint32_t chosen = 0;
    DONE(hapflow_negotiate(HAPFLOW_ABI_VERSION, HAPFLOW_ABI_VERSION, &chosen));
    MUST(chosen == HAPFLOW_ABI_VERSION && hapflow_version() > 0);
    const char* jet = "[run]\nduration = 0.2\nfluid_hz = 100\nbackend = \"analytic-jet\"\ndevice = \"null\"\n"
                      "[bounds]\nmin = [-0.1, -0.12, -0.1]\nmax = [0.1, 0.12, 0.1]\n"
                      "[[source]]\nname = \"tap\"\nposition = [0.0, 0.05, 0.0]\ndiameter = 0.02\nspeed = 1.5\n";
    hapflow_session closed_form = create(NULL, jet, "gate.ramp_in = 0.02");
    feel(closed_form, 300);
    look(closed_form);
    settings(closed_form);
    stop(closed_form);
    hapflow_session particles = create("tap", NULL, "fluid.spacing = 0.01");
    feel(particles, 400);
    look(particles);
    DONE(hapflow_session_destroy(particles));
    return 0;
}
