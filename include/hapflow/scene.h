/* Scenes: those that the library brings along, and those that a host builds. Part of <hapflow/hapflow.h>. */
#ifndef HAPFLOW_SCENE_H
#define HAPFLOW_SCENE_H

#include <hapflow/result.h>

HAPFLOW_BEGIN_DECLS

/* A scene that the library brings along. */
typedef struct hapflow_scene_info {
    uint32_t size; /* sizeof(hapflow_scene_info) */
    uint32_t reserved; /* 0 */
    const char* name; /* as hapflow_session_config.scene takes it. All three texts last as long as the process */
    const char* about; /* one line about it */
    const char* toml; /* the scene file */
} hapflow_scene_info;
#if UINTPTR_MAX > 0xffffffffu
HAPFLOW_ASSERT_SIZE(hapflow_scene_info, 32);
#endif

/* Empties `info`, for a struct of `size` bytes: sizeof *info. [any] Errors: NULL, STRUCT. */
HAPFLOW_API hapflow_result hapflow_scene_info_init(hapflow_scene_info* info, uint32_t size);

/* How many scenes the library brings along. [main, several at once] Needs no negotiation. */
HAPFLOW_API uint32_t hapflow_scene_count(void);

/* The shipped scene `index`, from 0. [main, several at once] Needs no negotiation. Errors: NULL, STRUCT, INDEX. */
HAPFLOW_API hapflow_result hapflow_scene_get(uint32_t index, hapflow_scene_info* info);

/* Scenes that are built by calls, at once in a process. */
#define HAPFLOW_MAX_SCENES 64u

/* A scene that the host builds. A session copies it (hapflow_session_config.built): it may be changed, used again or
 * destroyed afterwards. Every part is checked as it comes; hapflow_last_error has field, value and range, and the scene
 * stays as it was. */
typedef struct hapflow_scene {
    uint64_t id; /* 0: no scene */
} hapflow_scene;
HAPFLOW_ASSERT_SIZE(hapflow_scene, 8);

/* Makes an empty scene: no fluid yet, and one tool, whose settings are tool.radius and so on. [main, several at once]
 * The host owns it, and destroys it. Errors: NOT_NEGOTIATED, NULL, FULL. */
HAPFLOW_API hapflow_result hapflow_scene_create(hapflow_scene* scene);

/* Makes a scene of a shipped one, by its name, or of a file, by its path. [main, several at once]
 * Errors: NOT_NEGOTIATED, NULL, TEXT, NOT_FOUND, SCENE, FULL. */
HAPFLOW_API hapflow_result hapflow_scene_load(const char* name, hapflow_scene* scene);

/* Makes a scene of the text of a scene file, of `length` bytes; 0: up to its NUL. [main, several at once]
 * Errors: NOT_NEGOTIATED, NULL, TEXT, SCENE, FULL. */
HAPFLOW_API hapflow_result hapflow_scene_parse(const char* toml, size_t length, hapflow_scene* scene);

/* Ends a scene; its handle is stale from then on. [main, several at once] Sessions that were made of it go on.
 * Errors: HANDLE. */
HAPFLOW_API hapflow_result hapflow_scene_destroy(hapflow_scene scene);

/* Sets any setting to a number, live or not, by the path of a scene file. [main] "fluid.spacing", "source.tap.speed".
 * Errors: HANDLE, BUSY, FAULTED, NULL, TEXT, SETTING, VALUE, NOT_FINITE. */
HAPFLOW_API hapflow_result hapflow_scene_set(hapflow_scene scene, const char* path, double value);

/* The same for three numbers. [main] Errors: as hapflow_scene_set. */
HAPFLOW_API hapflow_result hapflow_scene_set_vector(hapflow_scene scene, const char* path, const double value[3]);

/* The same for any setting, with its value as a command line has it: "true", "1.5", "[0, -9.81, 0]", "wcsph". [main]
 * Errors: as hapflow_scene_set. */
HAPFLOW_API hapflow_result hapflow_scene_set_text(hapflow_scene scene, const char* path, const char* value);

/* Sets the box outside of which particles vanish, by its corners, m, each coordinate within 100. [main]
 * Errors: HANDLE, BUSY, FAULTED, NULL, VALUE, NOT_FINITE. */
HAPFLOW_API hapflow_result hapflow_scene_set_bounds(hapflow_scene scene, const double min[3], const double max[3]);

/* Axes of hapflow_scene_set_periodic. */
enum {
    HAPFLOW_AXIS_X = 1 << 0,
    HAPFLOW_AXIS_Y = 1 << 1,
    HAPFLOW_AXIS_Z = 1 << 2,
};

/* Lets particles that leave the bounds along these axes, any sum of HAPFLOW_AXIS_..., come in on the other side. [main]
 * Errors: HANDLE, BUSY, FAULTED, UNSUPPORTED (another bit). */
HAPFLOW_API hapflow_result hapflow_scene_set_periodic(hapflow_scene scene, uint32_t axes);

/* Sets the height of the ground, m, within 100. [main] With `height` null there is none.
 * Errors: HANDLE, BUSY, FAULTED, VALUE, NOT_FINITE. */
HAPFLOW_API hapflow_result hapflow_scene_set_ground(hapflow_scene scene, const double* height);

/* Sets the inside of the open box, by its corners, m, each coordinate within 100. [main] With both null there is none. The
 * setting container.shape makes a round tank or a bowl of it.
 * Errors: HANDLE, BUSY, FAULTED, NULL (one of the two), VALUE, NOT_FINITE. */
HAPFLOW_API hapflow_result hapflow_scene_set_container(hapflow_scene scene, const double min[3], const double max[3]);

/* Shapes of obstacles and tools. */
enum {
    HAPFLOW_SHAPE_SPHERE = 1, /* a ball */
    HAPFLOW_SHAPE_DISC = 2, /* a flat round plate, its axis up, of `thickness` */
    HAPFLOW_SHAPE_CYLINDER = 3, /* the same by its other name, of `length` */
    HAPFLOW_SHAPE_CAPSULE = 4, /* a rod with round ends, its axis up; `length` lies between the middles of its ends */
    HAPFLOW_SHAPE_BOX = 5, /* edges `extent` along the axes */
    HAPFLOW_SHAPE_MESH = 6, /* what the closed mesh of `file` holds, about the centre of its volume */
};

#define HAPFLOW_KIND_SOURCE_CONFIG 3u

/* A jet. What its fields may be, the settings source.NAME.* say. */
typedef struct hapflow_source_config {
    uint32_t kind; /* HAPFLOW_KIND_SOURCE_CONFIG */
    uint32_t size; /* sizeof(hapflow_source_config) */
    const void* next; /* null */
    const char* name; /* by which settings address it; null: its number */
    double position[3]; /* centre of the outlet, m */
    double direction[3]; /* of the jet, of any length but 0 */
    double diameter; /* of the outlet, m */
    double speed; /* at the outlet, m/s */
    double period; /* of an intermittent jet, s; 0: it runs steadily */
    double duty; /* share of the period in which it runs */
    uint32_t on; /* 1: it runs; 0: it does not, yet */
    uint32_t reserved; /* 0 */
} hapflow_source_config;
#if UINTPTR_MAX > 0xffffffffu
HAPFLOW_ASSERT_SIZE(hapflow_source_config, 112);
#endif

/* Fills `config` with the defaults: 20 mm straight down at 1 m/s from the origin; `size` is sizeof *config. [any]
 * Errors: NULL, STRUCT. */
HAPFLOW_API hapflow_result hapflow_source_config_init(hapflow_source_config* config, uint32_t size);

/* Adds a source; `index` becomes its number, and may be null. [main]
 * Errors: HANDLE, BUSY, FAULTED, NULL, STRUCT, UNSUPPORTED, TEXT, VALUE (also of a name that is there), NOT_FINITE. */
HAPFLOW_API hapflow_result hapflow_scene_add_source(hapflow_scene scene, const hapflow_source_config* config,
                                                    uint32_t* index);

#define HAPFLOW_KIND_OBSTACLE_CONFIG 4u

/* Something solid. What its fields may be, the settings obstacle.NAME.* say. */
typedef struct hapflow_obstacle_config {
    uint32_t kind; /* HAPFLOW_KIND_OBSTACLE_CONFIG */
    uint32_t size; /* sizeof(hapflow_obstacle_config) */
    const void* next; /* null */
    const char* name; /* by which settings address it; null: its number */
    uint32_t shape; /* HAPFLOW_SHAPE_... */
    uint32_t reserved; /* 0 */
    double radius; /* of all but a box and a mesh, m */
    double thickness; /* of a disc, m */
    double position[3]; /* until the host moves it, m */
    double length; /* of a cylinder or a capsule, m */
    double extent[3]; /* edges of a box, m */
    double scale; /* metres a unit of `file` */
    const char* file; /* of a mesh, Wavefront OBJ or STL; null: none */
    const void* mesh; /* null */
} hapflow_obstacle_config;
#if UINTPTR_MAX > 0xffffffffu
HAPFLOW_ASSERT_SIZE(hapflow_obstacle_config, 128);
#endif

/* Fills `config` with the defaults: a ball of 20 mm radius in the origin; `size` is sizeof *config. [any]
 * Errors: NULL, STRUCT. */
HAPFLOW_API hapflow_result hapflow_obstacle_config_init(hapflow_obstacle_config* config, uint32_t size);

/* Adds an obstacle; `index` becomes its number, as hapflow_obstacle_move counts them, and may be null. [main]
 * Errors: as hapflow_scene_add_source. */
HAPFLOW_API hapflow_result hapflow_scene_add_obstacle(hapflow_scene scene, const hapflow_obstacle_config* config,
                                                      uint32_t* index);

#define HAPFLOW_KIND_TOOL_CONFIG 5u

/* A tool in a hand. What its fields may be, the settings tool.* say. */
typedef struct hapflow_tool_config {
    uint32_t kind; /* HAPFLOW_KIND_TOOL_CONFIG */
    uint32_t size; /* sizeof(hapflow_tool_config) */
    const void* next; /* null */
    const char* name; /* by which settings address it; null: its number */
    uint32_t shape; /* HAPFLOW_SHAPE_... */
    uint32_t reserved; /* 0 */
    double radius; /* of all but a box and a mesh, m */
    double thickness; /* of a disc, m */
    double mass; /* of its body in the fluid (coupling momentum), kg */
    double collision_response; /* share of the fluid's impulse that it takes (coupling momentum) */
    double position[3]; /* where it starts, m */
    double force_scale; /* factor on the fluid's force */
    double solid_stiffness; /* how stiff solids feel, N/m; 0: they are not felt */
    double solid_damping; /* how much they slow it, N s/m */
    double length; /* of a cylinder or a capsule, m */
    double extent[3]; /* edges of a box, m */
    double scale; /* metres a unit of `file` */
    const char* file; /* of a mesh, Wavefront OBJ or STL; null: none */
    const void* mesh; /* null */
    double buoyancy_scale; /* factor on the lift alone, beside force_scale (coupling local) */
} hapflow_tool_config;
#if UINTPTR_MAX > 0xffffffffu
HAPFLOW_ASSERT_SIZE(hapflow_tool_config, 176);
#endif

/* Fills `config` with the defaults: a ball of 15 mm radius in the origin; `size` is sizeof *config. [any]
 * Errors: NULL, STRUCT. */
HAPFLOW_API hapflow_result hapflow_tool_config_init(hapflow_tool_config* config, uint32_t size);

/* Adds a tool to the first, which every scene has; `index` becomes its number, from 1, and may be null. [main]
 * Errors: as hapflow_scene_add_source. */
HAPFLOW_API hapflow_result hapflow_scene_add_tool(hapflow_scene scene, const hapflow_tool_config* config,
                                                  uint32_t* index);

#define HAPFLOW_KIND_BODY_CONFIG 6u

/* A rigid body that goes where fluid and gravity take it; walls, obstacles, tools and other bodies stop it. What its
 * fields may be, the settings body.NAME.* say. */
typedef struct hapflow_body_config {
    uint32_t kind; /* HAPFLOW_KIND_BODY_CONFIG */
    uint32_t size; /* sizeof(hapflow_body_config) */
    const void* next; /* null */
    const char* name; /* by which settings address it; null: its number */
    uint32_t shape; /* HAPFLOW_SHAPE_... */
    uint32_t reserved; /* 0 */
    double radius; /* of all but a box and a mesh, m */
    double thickness; /* of a disc, m */
    double density; /* its mean density, kg/m3 */
    double position[3]; /* where it starts, m */
    double length; /* of a cylinder or a capsule, m */
    double extent[3]; /* edges of a box, m */
    double scale; /* metres a unit of `file` */
    const char* file; /* of a mesh, Wavefront OBJ or STL; null: none */
    const void* mesh; /* null */
} hapflow_body_config;
#if UINTPTR_MAX > 0xffffffffu
HAPFLOW_ASSERT_SIZE(hapflow_body_config, 136);
#endif

/* Fills `config` with the defaults: a ball of 20 mm radius in the origin, half as dense as water; `size` is sizeof
 * *config. [any] Errors: NULL, STRUCT. */
HAPFLOW_API hapflow_result hapflow_body_config_init(hapflow_body_config* config, uint32_t size);

/* Adds a body; `index` becomes its number, as hapflow_session_body_report counts them, and may be null. [main]
 * Errors: as hapflow_scene_add_source. */
HAPFLOW_API hapflow_result hapflow_scene_add_body(hapflow_scene scene, const hapflow_body_config* config,
                                                  uint32_t* index);

/* Adds a box filled with fluid at the start, by its corners, m, each coordinate within 100; `index` becomes its number,
 * and may be null. [main] Errors: HANDLE, BUSY, FAULTED, NULL, VALUE, NOT_FINITE. */
HAPFLOW_API hapflow_result hapflow_scene_add_pool(hapflow_scene scene, const double min[3], const double max[3],
                                                  uint32_t* index);

/* Adds a box in which particles vanish, likewise. [main] Errors: HANDLE, BUSY, FAULTED, NULL, VALUE, NOT_FINITE. */
HAPFLOW_API hapflow_result hapflow_scene_add_sink(hapflow_scene scene, const double min[3], const double max[3],
                                                  uint32_t* index);

/* Adds new values for live settings at a time of the run (s, 0 to 3600): lines `path = value`. [main]
 * Errors: HANDLE, BUSY, FAULTED, NULL, TEXT, SETTING, FIXED, VALUE, NOT_FINITE. */
HAPFLOW_API hapflow_result hapflow_scene_add_change(hapflow_scene scene, double at_s, const char* settings);

/* Looks whether all of the scene can be run together; the error is what hapflow_session_create would say. [main]
 * Errors: HANDLE, BUSY, FAULTED, VALUE, SCENE. */
HAPFLOW_API hapflow_result hapflow_scene_check(hapflow_scene scene);

/* Writes a scene as the text of a scene file, which hapflow_scene_parse makes an equal scene of. [main] `text`,
 * `capacity` and `length` as in hapflow_last_error. Errors: HANDLE, BUSY, FAULTED, NULL. */
HAPFLOW_API hapflow_result hapflow_scene_write(hapflow_scene scene, char* text, size_t capacity, size_t* length);

HAPFLOW_END_DECLS

#endif
