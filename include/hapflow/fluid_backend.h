/* Fluids that others bring, as plugins of `hapflow run`. A draft: it may still change. Part of <hapflow/hapflow.h>.
 *
 * A plugin is a shared library with a function hapflow_extension of its own, declared as in <hapflow/extension.h>. It gives
 * the tables that the plugin has, as that of HAPFLOW_EXTENSION_FLUID_BACKEND, and null for every other name. Tables and
 * their names last as long as the process; hapflow never unloads a plugin. It needs no libhapflow.
 *
 * What holds for the functions of all tables of plugins:
 * - Each says which thread of hapflow calls it: [main], before a run; [fluid], once a fluid frame, which may take
 *   milliseconds; [servo], at 1 kHz, which must be wait-free but for a device's own transfer. For what was made they
 *   are called by one thread at a time: calls of one are over, and their memory is seen, before those of another begin. What
 *   ends something is called by any of them.
 * - They must return, and let no exception out. They run in hapflow's process: what they break is broken.
 * - What is pointed to lasts for the call, and is not null. What a plugin is given begins with a size where it may grow: a
 *   newer hapflow gives more.
 * - A negative result, HAPFLOW_ERROR_..., is a failure; so is a number that is not finite, and a motion beyond the ranges of
 *   hapflow_tool_state. While it runs, each is a fault: the force is zero from then on, and the run tells the reason at its
 *   end.
 * - SI units, right-handed, y up. */
#ifndef HAPFLOW_FLUID_BACKEND_H
#define HAPFLOW_FLUID_BACKEND_H

#include <hapflow/result.h>

HAPFLOW_BEGIN_DECLS

/* A table of functions that compute a fluid. */
#define HAPFLOW_EXTENSION_FLUID_BACKEND "hapflow.fluid-backend/1"

/* A box with edges along the axes, m. */
typedef struct hapflow_fluid_box {
    double min[3]; /* corner of the smallest coordinates */
    double max[3]; /* corner of the largest */
} hapflow_fluid_box;
HAPFLOW_ASSERT_SIZE(hapflow_fluid_box, 48);

/* A round jet: see hapflow_source_config. */
typedef struct hapflow_fluid_source {
    double position[3]; /* centre of the outlet, m */
    double direction[3]; /* unit vector */
    double diameter; /* of the outlet, m */
    double speed; /* at the outlet, m/s */
    double period; /* of an intermittent jet, s; 0: it runs steadily */
    double duty; /* share of the period in which it runs, from its beginning */
    uint32_t on; /* 1: it runs */
    uint32_t reserved; /* 0 */
} hapflow_fluid_source;
HAPFLOW_ASSERT_SIZE(hapflow_fluid_source, 88);

/* A body that stands in the fluid: tools first, then obstacles, then what floats. */
typedef struct hapflow_fluid_body {
    uint32_t shape; /* HAPFLOW_SHAPE_...; never a mesh */
    uint32_t reserved; /* 0 */
    double radius; /* of all but a box, m */
    double length; /* thickness of a disc, and what a capsule has between the middles of its ends, m */
    double extent[3]; /* edges of a box, m */
    double bounding_radius; /* of the smallest ball round its position that holds it, m */
    double mass; /* kg; it counts where the body is not led */
    double position[3]; /* where it starts, m */
} hapflow_fluid_body;
HAPFLOW_ASSERT_SIZE(hapflow_fluid_body, 88);

/* What holds a fluid, open at its top. */
enum {
    HAPFLOW_CONTAINER_NONE = 0,
    HAPFLOW_CONTAINER_BOX = 1, /* a floor and four walls */
    HAPFLOW_CONTAINER_CYLINDER = 2, /* a floor and a round wall */
    HAPFLOW_CONTAINER_BOWL = 3, /* part of a hollow ball, as deep as its corners say, and as wide at its rim */
};

/* All that a fluid is made of. It grows at its end. */
typedef struct hapflow_fluid_config {
    uint32_t size; /* sizeof(hapflow_fluid_config) of hapflow */
    uint32_t threads; /* worker threads that it may have, 1 to 1024 */
    double frame_hz; /* fluid frames a second */
    double density; /* kg/m3 */
    double viscosity; /* Pa s */
    double surface_tension; /* N/m */
    double spacing; /* of particles, if there are any, m */
    double gravity[3]; /* m/s2 */
    uint32_t two_way; /* 1: the fluid pushes bodies; 0: they feel nothing */
    uint32_t has_ground; /* 1: there is a level ground at `ground` */
    double ground; /* m */
    hapflow_fluid_box bounds; /* outside of which there is no fluid */
    uint32_t container; /* HAPFLOW_CONTAINER_... */
    uint32_t periodic; /* bit n: along axis n what leaves `bounds` comes in on the other side */
    hapflow_fluid_box inside; /* corners of the container's inside */
    uint32_t source_count; /* of each list */
    uint32_t pool_count;
    uint32_t sink_count;
    uint32_t body_count;
    const hapflow_fluid_source* sources; /* jets. What is pointed to lasts for the call, as everything here */
    const hapflow_fluid_box* pools; /* full of fluid at rest at the start */
    const hapflow_fluid_box* sinks; /* in which fluid vanishes */
    const hapflow_fluid_body* bodies;
} hapflow_fluid_config;
#if UINTPTR_MAX > 0xffffffffu
HAPFLOW_ASSERT_SIZE(hapflow_fluid_config, 240);
#endif

/* Pose and motion of a body at a time. */
typedef struct hapflow_fluid_sample {
    double time_s; /* on the clock of the frame's path, s */
    double position[3]; /* m */
    double orientation[4]; /* unit quaternion x, y, z, w, body to scene */
    double velocity[3]; /* m/s */
    double angular_velocity[3]; /* rad/s, in the scene's frame */
} hapflow_fluid_sample;
HAPFLOW_ASSERT_SIZE(hapflow_fluid_sample, 112);

/* Who moves a body in a frame. */
enum {
    HAPFLOW_MOTION_LED = 1, /* it goes along its path, whatever the fluid does */
    HAPFLOW_MOTION_DRIVEN = 2, /* it starts with `velocity`, and the fluid pushes it */
    HAPFLOW_MOTION_FLOATING = 3, /* it goes where the fluid and gravity take it; there is no path */
};

/* How a body is to move in a frame. */
typedef struct hapflow_fluid_motion {
    uint32_t drive; /* HAPFLOW_MOTION_... */
    uint32_t sample_count; /* of `path`; at least 1, but of a body that floats */
    double velocity[3]; /* of a driven body at the start, m/s */
    const hapflow_fluid_sample* path; /* in order of time, spread over the frame */
} hapflow_fluid_motion;
#if UINTPTR_MAX > 0xffffffffu
HAPFLOW_ASSERT_SIZE(hapflow_fluid_motion, 40);
#endif

/* A frame to be stepped. It grows at its end. */
typedef struct hapflow_fluid_frame {
    uint32_t size; /* sizeof(hapflow_fluid_frame) of hapflow */
    uint32_t body_count; /* as the configuration has it */
    double duration_s; /* s */
    const hapflow_fluid_motion* motions; /* of each body */
} hapflow_fluid_frame;
#if UINTPTR_MAX > 0xffffffffu
HAPFLOW_ASSERT_SIZE(hapflow_fluid_frame, 24);
#endif

/* What the fluid does to a body, in the mean over a frame. */
typedef struct hapflow_fluid_load {
    double pressure_force[3]; /* N */
    double viscous_force[3]; /* N */
    double torque[3]; /* N m, about the body's position */
} hapflow_fluid_load;
HAPFLOW_ASSERT_SIZE(hapflow_fluid_load, 72);

/* What came of a frame. All is zero when the step begins, but for what is said otherwise. It grows at its end. */
typedef struct hapflow_fluid_result {
    uint32_t size; /* sizeof(hapflow_fluid_result) of hapflow */
    uint32_t degraded; /* 1: the frame is not as good as it should be */
    uint64_t particles; /* at its end */
    uint64_t substeps; /* that it took */
    double max_speed; /* of the fluid, m/s */
    hapflow_fluid_load* loads; /* of each body */
    /* Of each body at the frame's end. They are there already: of one that is led the path's end, of another where it was
     * at the last frame's end, which a fluid that moves bodies changes. */
    hapflow_fluid_sample* states;
} hapflow_fluid_result;
#if UINTPTR_MAX > 0xffffffffu
HAPFLOW_ASSERT_SIZE(hapflow_fluid_result, 48);
#endif

/* The table. Functions with a `reason` write there why they fail: a sentence, which has room for `capacity` bytes, NUL
 * included. Only `particles` may be null. */
typedef struct hapflow_fluid_backend_extension {
    uint32_t size; /* bytes of this table */
    uint32_t reserved; /* 0 */
    const char* name; /* that of the setting plugin.backend, as "jet-fluid" */
    /* Makes a fluid: `fluid` becomes whatever the others are to get. [main] */
    hapflow_result (*create)(const hapflow_fluid_config* config, void** fluid, char* reason, size_t capacity);
    /* Takes new settings between frames; the lists are as long as before. [fluid] On failure, which is no fault, the old
     * ones stay. */
    hapflow_result (*configure)(void* fluid, const hapflow_fluid_config* config, char* reason, size_t capacity);
    /* Steps a frame. [fluid] */
    hapflow_result (*step)(void* fluid, const hapflow_fluid_frame* frame, hapflow_fluid_result* result);
    /* Copies x, y, z of up to `capacity` particles, for pictures; `count` becomes how many there are. [fluid] On failure,
     * which is no fault, there are none. */
    hapflow_result (*particles)(void* fluid, float* positions, size_t capacity, size_t* count);
    /* Ends a fluid. */
    void (*destroy)(void* fluid);
} hapflow_fluid_backend_extension;
#if UINTPTR_MAX > 0xffffffffu
HAPFLOW_ASSERT_SIZE(hapflow_fluid_backend_extension, 56);
#endif

HAPFLOW_END_DECLS

#endif
