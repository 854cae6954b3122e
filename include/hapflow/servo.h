/* The servo: its ticks, one a tool. Part of <hapflow/hapflow.h>. */
#ifndef HAPFLOW_SERVO_H
#define HAPFLOW_SERVO_H

#include <hapflow/session.h>
#include <hapflow/tool_state.h>
#include <hapflow/wrench.h>

HAPFLOW_BEGIN_DECLS

/* Tools of a session. */
#define HAPFLOW_MAX_TOOLS 8u

/* How many tools the scene has: 1 to HAPFLOW_MAX_TOOLS. [any] It stays as it is. Each is ticked by itself, in one loop
 * with the others or by a thread of its own. Errors: HANDLE, NULL. */
HAPFLOW_API hapflow_result hapflow_session_tool_count(hapflow_session session, uint32_t* count);

/* One servo tick: the hand is at `state`; `wrench` becomes what it feels, from the newest fluid frame. [servo]
 *
 * `wrench` is written whatever happens, and is zero on every failure. A state that is refused also latches
 * HAPFLOW_FAULT_INPUT: the force stays zero, on all tools of the session, until hapflow_session_clear_faults, and then
 * comes up slowly, so that one bad sample never makes a jump. BUSY, HANDLE and DRIVE raise no fault.
 * Remarks: FORCE_HELD, NO_TIME, LATE.
 * Errors: HANDLE, BUSY, DRIVE, NULL, STRUCT, UNSUPPORTED, INDEX (no such tool), NOT_FINITE, VALUE (too far or too
 * fast), ORIENTATION, TIME. */
HAPFLOW_API hapflow_result hapflow_servo_tick(hapflow_session session, const hapflow_tool_state* state,
                                              hapflow_wrench* wrench);

/* What the system said to the priority of an owned servo's thread: hapflow_servo_pace.priority. */
enum {
    HAPFLOW_PRIORITY_NOT_ASKED = 0, /* there is no such thread */
    HAPFLOW_PRIORITY_GRANTED = 1, /* it is real-time */
    HAPFLOW_PRIORITY_REFUSED = 2, /* it ticks at ordinary priority, later at times */
};

/* How an owned servo keeps time. Of a tool that the session does not tick all is 0, and the texts are empty. */
typedef struct hapflow_servo_pace {
    uint32_t size; /* sizeof(hapflow_servo_pace) */
    uint32_t owned; /* 1: a thread of the session ticks this tool, or did */
    uint32_t running; /* 1: it still does; 0: its device was lost, or it panicked */
    uint32_t priority; /* HAPFLOW_PRIORITY_... */
    uint64_t ticks; /* its ticks so far; this and what follows lag by up to 64 ticks */
    uint64_t late; /* those that began more than 0.5 ms late */
    double median_s; /* half of all ticks took less, device included, s: to 0.1 us, and not above 200 us */
    double p99_s; /* 99 of 100 took less, s; likewise */
    double longest_s; /* the longest, s */
    const char* priority_text; /* what was said to the priority, and what a person can do */
    const char* device; /* the device, as hapflow_device_info.name has it. Both texts last as long as the session */
} hapflow_servo_pace;
#if UINTPTR_MAX > 0xffffffffu
HAPFLOW_ASSERT_SIZE(hapflow_servo_pace, 72);
#endif

/* Empties `pace`, for a struct of `size` bytes: sizeof *pace. [any] Errors: NULL, STRUCT. */
HAPFLOW_API hapflow_result hapflow_servo_pace_init(hapflow_servo_pace* pace, uint32_t size);

/* How the servo of tool `tool`, from 0, keeps time. [main] Never waits for it.
 * Errors: HANDLE, BUSY, NULL, STRUCT, INDEX. */
HAPFLOW_API hapflow_result hapflow_session_servo_pace(hapflow_session session, uint32_t tool, hapflow_servo_pace* pace);

HAPFLOW_END_DECLS

#endif
