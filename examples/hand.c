/* The library's simulated hand under a tap, in threads of the session: it reads the hand, ticks and writes the force at
 * 1 kHz, and steps the fluid. The program only looks on. For POSIX.
 *
 *     cc -std=c11 -Iinclude examples/hand.c -Ltarget/release -lhapflow -o hand
 *     LD_LIBRARY_PATH=target/release ./hand 3 "fluid.spacing = 0.01"        seconds, and settings, one a line
 */
#define _POSIX_C_SOURCE 200809L
#include <hapflow/hapflow.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

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

/* What the session has to say: called by hapflow_session_poll, in this thread. */
static void say(uint32_t level, const char* text, void* user) {
    fprintf(user, "%s: %s\n", level == HAPFLOW_LOG_ERROR ? "error" : level == HAPFLOW_LOG_WARNING ? "warning" : "info",
            text);
}

int main(int argc, char** argv) {
    double seconds = argc > 1 ? atof(argv[1]) : 3;
    uint32_t version;
    check(hapflow_negotiate(HAPFLOW_ABI_VERSION, HAPFLOW_ABI_VERSION, &version), "version");

    hapflow_device_config hand;
    check(hapflow_device_config_init(&hand, sizeof hand), "device config");
    hand.scene = "tap"; /* has the hand's script */
    hand.name = "hand";
    hapflow_device device;
    check(hapflow_device_open(&hand, &device), "device");

    hapflow_session_config config;
    check(hapflow_session_config_init(&config, sizeof config), "config");
    config.scene = "tap";
    config.settings = argc > 2 ? argv[2] : NULL;
    config.servo_drive = config.fluid_drive = HAPFLOW_DRIVE_OWNED;
    config.devices = &device; /* the session's from here on */
    config.device_count = 1;
    config.log = say;
    config.log_user = stderr;
    hapflow_session session;
    check(hapflow_session_create(&config, &session), "session");

    hapflow_report report;
    check(hapflow_report_init(&report, sizeof report), "report");
    while (report.time_s < seconds) {
        nanosleep(&(struct timespec){.tv_nsec = 50000000}, NULL);
        check(hapflow_session_poll(session), "poll");
        check(hapflow_session_report(session, &report), "report");
        printf("%.3f s, hand at %6.2f mm, %7.4f N down\n", report.time_s, 1e3 * report.position[1], -report.force[1]);
    }
    hapflow_servo_pace pace;
    check(hapflow_servo_pace_init(&pace, sizeof pace), "pace");
    check(hapflow_session_servo_pace(session, 0, &pace), "pace");
    unsigned long long ticks = pace.ticks, late = pace.late;
    printf("%llu ticks, %llu late, the longest %.1f us\n", ticks, late, 1e6 * pace.longest_s);
    check(hapflow_session_destroy(session), "destroy"); /* with zero force */
    return 0;
}
