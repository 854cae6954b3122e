/* The newest tick, the newest frame, and faults. Part of <hapflow/hapflow.h>. */
#ifndef HAPFLOW_REPORT_H
#define HAPFLOW_REPORT_H

#include <hapflow/session.h>

HAPFLOW_BEGIN_DECLS

/* Bits of hapflow_report.faults. The first group latches: no force until it is cleared. So does a bit that is not
 * here. */
enum {
    HAPFLOW_FAULT_INPUT = 1 << 0, /* a tool state was refused */
    HAPFLOW_FAULT_FORCE = 1 << 1, /* a computed force was not finite */
    HAPFLOW_FAULT_PANIC = 1 << 2, /* a defect of the library */
    HAPFLOW_FAULT_DEVICE_LOST = 1 << 4, /* the device no longer answers */
    HAPFLOW_FAULT_EMERGENCY_STOP = 1 << 5, /* hapflow_session_emergency_stop */
    HAPFLOW_FAULT_FLUID = 1 << 7, /* the fluid gave up */
    /* Remarks, which go by themselves. */
    HAPFLOW_FAULT_STALE = 1 << 3, /* the fluid's newest frame is too old, or there is none: the force fades */
    HAPFLOW_FAULT_PATH_OVERFLOW = 1 << 6, /* part of the tool's path never reached the fluid */
    HAPFLOW_FAULT_LATE_TICK = 1 << 8, /* the servo ticked late */
    HAPFLOW_FAULT_FORCE_LIMITED = 1 << 9, /* the wanted force or torque was larger than allowed */
    HAPFLOW_FAULT_SLEW_LIMITED = 1 << 10, /* it changed faster than allowed */
};

/* The newest tick, and the newest fluid frame. Vectors are in the scene's frame. */
typedef struct hapflow_report {
    uint32_t size; /* sizeof(hapflow_report) */
    uint32_t faults; /* HAPFLOW_FAULT_... of the newest tick, and what was raised since */
    uint64_t tick; /* number of the tick, from 1; 0: none yet */
    double time_s; /* its time, s */
    double position[3]; /* the tool, m */
    double body[3]; /* the tool's body in the fluid, m */
    double raw_force[3]; /* what the coupling gave, N */
    double raw_torque[3]; /* N m */
    double force[3]; /* what left the gate, N */
    double torque[3]; /* N m */
    uint64_t model_frame; /* the fluid frame that the tick used; 0: none yet */
    double model_age_s; /* its age, s; while there is none, the time since the first tick */
    uint64_t fluid_frame; /* number of the newest fluid frame, from 1; 0: none yet */
    double fluid_time_s; /* fluid time at its end, s */
    uint64_t particles; /* particles at its end */
    uint64_t substeps; /* its sub-steps */
    double max_speed; /* highest particle speed in it, m/s */
    double load_force[3]; /* mean load of the fluid on the first tool in it, N */
    double load_torque[3]; /* N m */
    uint64_t degraded; /* frames so far that hit a limit of the solver */
} hapflow_report;
HAPFLOW_ASSERT_SIZE(hapflow_report, 280);

/* Empties `report`, for a struct of `size` bytes: sizeof *report. [any] Errors: NULL, STRUCT. */
HAPFLOW_API hapflow_result hapflow_report_init(hapflow_report* report, uint32_t size);

/* Reads the newest tick of the first tool, and the newest frame. [main] Never waits for either.
 * Errors: HANDLE, BUSY, NULL, STRUCT. */
HAPFLOW_API hapflow_result hapflow_session_report(hapflow_session session, hapflow_report* report);

/* The same with the newest tick of tool `tool`, from 0. [main] Errors: HANDLE, BUSY, NULL, STRUCT, INDEX. */
HAPFLOW_API hapflow_result hapflow_session_report_of(hapflow_session session, uint32_t tool, hapflow_report* report);

HAPFLOW_END_DECLS

#endif
