/* What the hand feels. Part of <hapflow/hapflow.h>. */
#ifndef HAPFLOW_WRENCH_H
#define HAPFLOW_WRENCH_H

#include <hapflow/base.h>

HAPFLOW_BEGIN_DECLS

/* What the hand is to feel: finite, and within the limits of the scene's safety gate. Never grows. */
typedef struct hapflow_wrench {
    double force[3]; /* N, in the frame of the tool state */
    double torque[3]; /* N m, about the tool's position */
} hapflow_wrench;
HAPFLOW_ASSERT_SIZE(hapflow_wrench, 48);

HAPFLOW_END_DECLS

#endif
