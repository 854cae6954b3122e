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
 * comes up slowly, so that one bad sample never makes a jump. BUSY and HANDLE raise no fault.
 * Remarks: FORCE_HELD, NO_TIME, LATE.
 * Errors: HANDLE, BUSY, NULL, STRUCT, UNSUPPORTED, INDEX (no such tool), NOT_FINITE, VALUE (too far or too fast),
 * ORIENTATION, TIME. */
HAPFLOW_API hapflow_result hapflow_servo_tick(hapflow_session session, const hapflow_tool_state* state,
                                              hapflow_wrench* wrench);

HAPFLOW_END_DECLS

#endif
