/* Couplings that others bring, as plugins of `hapflow run`: how a tool moves in the fluid, and what of the fluid's load
 * becomes the force on the hand. A draft: it may still change. Part of <hapflow/hapflow.h>; what a plugin is, and what holds
 * for all its functions, says <hapflow/fluid_backend.h>.
 *
 * There is one coupling for each tool, and it is asked once a fluid frame, not in the servo. Its force passes the filter,
 * that of coupling `direct` unless the scene names one, and the safety gate. */
#ifndef HAPFLOW_COUPLING_H
#define HAPFLOW_COUPLING_H

#include <hapflow/result.h>
#include <hapflow/wrench.h>

HAPFLOW_BEGIN_DECLS

/* A table of functions that couple a tool with a fluid. */
#define HAPFLOW_EXTENSION_COUPLING "hapflow.coupling/1"

/* A tool's body at the edge of a frame, and the hand's newest place. It grows at its end. */
typedef struct hapflow_coupling_frame {
    uint32_t size; /* sizeof(hapflow_coupling_frame) of hapflow */
    uint32_t reserved; /* 0 */
    double frame_s; /* length of a frame, s */
    double body_position[3]; /* m */
    double body_velocity[3]; /* m/s */
    double body_mass; /* kg */
    double hand_position[3]; /* where the frame's path ends, m */
    double hand_velocity[3]; /* m/s */
    hapflow_wrench load; /* of the fluid on the body, in the mean over the frame; zero at its beginning */
} hapflow_coupling_frame;
HAPFLOW_ASSERT_SIZE(hapflow_coupling_frame, 168);

/* The table. None of its functions may be null. */
typedef struct hapflow_coupling_extension {
    uint32_t size; /* bytes of this table */
    uint32_t reserved; /* 0 */
    const char* name; /* that of the setting plugin.coupling */
    /* Makes a coupling for a tool: `coupling` becomes whatever the others are to get. [main] */
    hapflow_result (*create)(void** coupling);
    /* How the body is to move: `driven` stays 0, and it follows the hand, or becomes 1, and it starts with `velocity` (m/s)
     * and the fluid pushes it. [fluid] */
    hapflow_result (*begin)(void* coupling, const hapflow_coupling_frame* frame, uint32_t* driven, double velocity[3]);
    /* What the hand is to feel until the next frame's end, in the scene's frame: `felt` is zero before. [fluid] */
    hapflow_result (*end)(void* coupling, const hapflow_coupling_frame* frame, hapflow_wrench* felt);
    /* Ends a coupling. */
    void (*destroy)(void* coupling);
} hapflow_coupling_extension;
#if UINTPTR_MAX > 0xffffffffu
HAPFLOW_ASSERT_SIZE(hapflow_coupling_extension, 48);
#endif

HAPFLOW_END_DECLS

#endif
