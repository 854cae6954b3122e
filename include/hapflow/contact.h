/* What a tool touches, and where solids let it be. Part of <hapflow/hapflow.h>. */
#ifndef HAPFLOW_CONTACT_H
#define HAPFLOW_CONTACT_H

#include <hapflow/session.h>

HAPFLOW_BEGIN_DECLS

/* The solids of a scene are felt by tools whose setting tool.solid_stiffness is above 0. The tool counts as the ball
 * round it. Its proxy is where that ball would be if solids stopped it: a spring and a damper draw the hand to it. */

/* Contacts that a tool can have at once. */
#define HAPFLOW_MAX_CONTACTS 8u

/* What is touched: hapflow_contact.solid. */
enum {
    HAPFLOW_SOLID_GROUND = 1, /* index 0 */
    HAPFLOW_SOLID_CONTAINER = 2, /* index 0: its floor; 1, 2: the walls at smallest and largest x; 3, 4: those of z */
    HAPFLOW_SOLID_OBSTACLE = 3, /* the obstacle `index`, as hapflow_obstacle_move counts them */
};

/* One contact. Vectors are in the scene's frame. */
typedef struct hapflow_contact {
    uint32_t solid; /* HAPFLOW_SOLID_... */
    uint32_t index; /* which of them, from 0 */
    double depth; /* how far the hand is beyond where the solid lets the tool be, along the normal, m */
    double point[3]; /* where, on the surface, m */
    double normal[3]; /* unit vector, outward from the solid */
    double force[3]; /* on the hand, before the gate, N */
} hapflow_contact;
HAPFLOW_ASSERT_SIZE(hapflow_contact, 88);

/* What tool `tool`, from 0, touched at its newest tick. [main] Never waits for it. `contacts` has room for `capacity`
 * structs of `size` bytes: sizeof *contacts. `count` becomes the number that there are: 0 where solids are not felt.
 * With a capacity of 0 `contacts` may be null, and only the count is told; that of a later tick may be another. One
 * of HAPFLOW_MAX_CONTACTS holds all; too small a buffer gets the first ones, and HAPFLOW_REMARK_MORE.
 * Errors: HANDLE, BUSY, NULL, STRUCT (size), INDEX. */
HAPFLOW_API hapflow_result hapflow_session_contacts(hapflow_session session, uint32_t tool, hapflow_contact* contacts,
                                                    uint32_t size, size_t capacity, size_t* count);

/* The proxy of tool `tool`, from 0, at its newest tick: `position` (m) and `orientation` (unit quaternion x, y, z, w) in
 * the scene's frame. [main] What to draw, for it is in no wall. Where solids are not felt it is the tool's body in the
 * fluid.
 * Errors: HANDLE, BUSY, NULL, INDEX. */
HAPFLOW_API hapflow_result hapflow_session_proxy(hapflow_session session, uint32_t tool, double position[3],
                                                 double orientation[4]);

HAPFLOW_END_DECLS

#endif
