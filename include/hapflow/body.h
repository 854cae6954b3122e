/* Tools, obstacles and free bodies in the fluid: where they are, and what the fluid does to them. Part of
 * <hapflow/hapflow.h>. */
#ifndef HAPFLOW_BODY_H
#define HAPFLOW_BODY_H

#include <hapflow/session.h>

HAPFLOW_BEGIN_DECLS

/* Which list of a scene a body is in. */
enum {
    HAPFLOW_BODY_TOOL = 1, /* as the tools are counted, from 0 */
    HAPFLOW_BODY_OBSTACLE = 2, /* as hapflow_obstacle_move counts them */
    HAPFLOW_BODY_FREE = 3, /* in the order of the scene */
};

/* A body at the end of the newest fluid frame, and the mean load of the fluid in that frame, in the scene's frame. */
typedef struct hapflow_body_report {
    uint32_t size; /* sizeof(hapflow_body_report) */
    uint32_t reserved; /* 0 */
    double position[3]; /* m */
    double orientation[4]; /* unit quaternion x, y, z, w, its frame to the scene's */
    double velocity[3]; /* m/s */
    double angular_velocity[3]; /* rad/s */
    double pressure_force[3]; /* by the fluid's pressure, and by free bodies that it stops, N */
    double viscous_force[3]; /* by the fluid's friction, N */
    double torque[3]; /* of both, about its position, N m */
} hapflow_body_report;
HAPFLOW_ASSERT_SIZE(hapflow_body_report, 184);

/* Empties `report`, for a struct of `size` bytes: sizeof *report. [any] Errors: NULL, STRUCT. */
HAPFLOW_API hapflow_result hapflow_body_report_init(hapflow_body_report* report, uint32_t size);

/* Reads the body `index` of the list `which`, HAPFLOW_BODY_..., as the newest fluid frame left it. [main] Never waits for
 * the fluid; before the first frame it is where the scene puts it, without a load.
 * Errors: HANDLE, BUSY, NULL, STRUCT, UNSUPPORTED (no such list), INDEX. */
HAPFLOW_API hapflow_result hapflow_session_body_report(hapflow_session session, uint32_t which, uint32_t index,
                                                       hapflow_body_report* report);

HAPFLOW_END_DECLS

#endif
