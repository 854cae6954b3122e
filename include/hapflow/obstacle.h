/* Obstacles, which the host may move. Part of <hapflow/hapflow.h>. */
#ifndef HAPFLOW_OBSTACLE_H
#define HAPFLOW_OBSTACLE_H

#include <hapflow/session.h>

HAPFLOW_BEGIN_DECLS

/* Obstacles are in the order of the scene file, and in its frame. The host may move them while the fluid runs, whoever
 * steps that; one that it never moves stays where the setting obstacle.NAME.position has it. */

/* How many obstacles the scene has. [any] It stays as it is. Errors: HANDLE, NULL. */
HAPFLOW_API hapflow_result hapflow_obstacle_count(hapflow_session session, uint32_t* count);

/* Where obstacle `index`, from 0, is to be: `position` (m, each within 1000) and `orientation` (unit quaternion x, y,
 * z, w, its length within 1e-3 of 1). [obstacle] Nothing happens before hapflow_obstacle_publish. From then on its
 * setting is without effect.
 * Errors: HANDLE, BUSY, NULL, INDEX, NOT_FINITE, VALUE (too far), ORIENTATION. */
HAPFLOW_API hapflow_result hapflow_obstacle_move(hapflow_session session, uint32_t index, const double position[3],
                                                 const double orientation[4]);

/* Hands the places of all obstacles to the fluid, together. [obstacle] Each goes evenly to its place within the next
 * fluid frame, and pushes the fluid as fast as it goes: so move it a little, once a frame. Of several calls within a
 * frame the newest counts.
 * Errors: HANDLE, BUSY. */
HAPFLOW_API hapflow_result hapflow_obstacle_publish(hapflow_session session);

HAPFLOW_END_DECLS

#endif
