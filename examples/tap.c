/* A hand under a tap: holds a ball in the jet, bobs it a centimetre down and up once a second, and prints the force.
 *
 *     cc -std=c11 -Iinclude examples/tap.c -Ltarget/release -lhapflow -o tap
 *     LD_LIBRARY_PATH=target/release ./tap 2 > force.csv
 *     ./tap 0.5 "fluid.spacing = 0.01"        seconds, and settings on top of the scene, one a line
 */
#include <hapflow/hapflow.h>
#include <stdio.h>
#include <stdlib.h>

/* Ends the program if something failed, and says what. A positive result is but a remark. */
static void check(hapflow_result result, const char* what) {
    if (result < 0) {
        char detail[512] = "";
        size_t length;
        hapflow_last_error(detail, sizeof detail, &length);
        fprintf(stderr, "%s: %s\n%s\n", what, hapflow_result_text(result), detail);
        exit(1);
    }
}

/* Where the hand is at `time_s`. A real host asks its device instead. */
static void move(hapflow_tool_state* state, double time_s) {
    double s = time_s - (double)(long)time_s; /* runs from 0 to 1 in each second */
    state->time_s = time_s;
    state->position[1] = -0.16 * (s * s) * ((1 - s) * (1 - s));
    state->velocity[1] = -0.32 * s * (1 - s) * (1 - 2 * s);
}

int main(int argc, char** argv) {
    long ticks = (long)((argc > 1 ? atof(argv[1]) : 0.5) * 1000 + 0.5);
    uint32_t version;
    check(hapflow_negotiate(HAPFLOW_ABI_VERSION, HAPFLOW_ABI_VERSION, &version), "version");

    hapflow_session_config config;
    check(hapflow_session_config_init(&config, sizeof config), "config");
    config.scene = "tap";
    config.settings = argc > 2 ? argv[2] : NULL;
    hapflow_session session;
    check(hapflow_session_create(&config, &session), "session");

    hapflow_tool_state state;
    hapflow_wrench wrench;
    check(hapflow_tool_state_init(&state, sizeof state), "state"); /* dt_s is 1 ms */
    puts("time_s,fx_n,fy_n,fz_n");
    for (long n = 0; n < ticks; n++) {
        move(&state, (double)n * 1e-3);
        check(hapflow_fluid_advance(session, state.time_s), "fluid"); /* the frames that are due */
        check(hapflow_servo_tick(session, &state, &wrench), "tick");
        const double* f = wrench.force;
        printf("%.17g,%.17g,%.17g,%.17g\n", state.time_s, f[0], f[1], f[2]);
    }
    check(hapflow_session_destroy(session), "destroy");
    return 0;
}
