/* Where the hand is. Part of <hapflow/hapflow.h>. */
#ifndef HAPFLOW_TOOL_STATE_H
#define HAPFLOW_TOOL_STATE_H

#include <hapflow/result.h>

HAPFLOW_BEGIN_DECLS

/* Where the hand is, and when. In the frame of the device; that is the scene's, unless the scene has a mapping. */
typedef struct hapflow_tool_state {
    uint32_t size; /* sizeof(hapflow_tool_state) */
    uint32_t tool; /* which tool of the scene, from 0: below hapflow_session_tool_count */
    uint32_t buttons; /* bit n: button n is down */
    uint32_t reserved; /* 0 */
    double time_s; /* time of this state since the session's start, s: 0 to 1e7, never less than the tool's last */
    double dt_s; /* time since its last tick, s: not negative. 0 leaves the force; above 0.01 counts as 0.01 */
    double position[3]; /* m, each within 1000 */
    double orientation[4]; /* unit quaternion x, y, z, w, tool to device frame; its length is within 1e-3 of 1 */
    double velocity[3]; /* m/s, each within 1000 */
    double angular_velocity[3]; /* rad/s, in the device frame, each within 1e5 */
} hapflow_tool_state;
HAPFLOW_ASSERT_SIZE(hapflow_tool_state, 136);

/* Fills `state` for a tool at rest in the origin, at time 0, with dt_s 0.001; `size` is sizeof *state. [any]
 * Errors: NULL, STRUCT. */
HAPFLOW_API hapflow_result hapflow_tool_state_init(hapflow_tool_state* state, uint32_t size);

HAPFLOW_END_DECLS

#endif
