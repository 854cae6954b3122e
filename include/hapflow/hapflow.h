/* hapflow: lets a hand feel a fluid. The C interface of libhapflow, C11 and C++17. This file is the contract.
 *
 * Life of a session
 * -----------------
 *     uint32_t version;
 *     hapflow_negotiate(HAPFLOW_ABI_VERSION, HAPFLOW_ABI_VERSION, &version);   before anything else
 *     hapflow_session_config config;
 *     hapflow_session_config_init(&config, sizeof config);
 *     config.scene = "tap";                                                    or config.toml = "..."
 *     hapflow_session session;
 *     hapflow_session_create(&config, &session);
 *     for (each tick at about 1 kHz) {                                         the host's loop
 *         hapflow_fluid_advance(session, state.time_s);                        here, or in a thread of its own
 *         hapflow_servo_tick(session, &state, &wrench);                        wrench.force goes to the device
 *     }
 *     hapflow_session_destroy(session);
 *
 * With config.fluid_drive = HAPFLOW_DRIVE_OWNED the session steps the fluid in a thread of its own, which keeps the
 * time of the ticks: the loop is then hapflow_servo_tick alone.
 *
 * Every function below says how it may be called, with one of these classes:
 *
 *     [main]      may block and allocate. One thread at a time a session; it need not always be the same.
 *     [servo]     wait-free: no lock, no allocation, no system call, no log. One thread at a time a tool.
 *     [fluid]     computes, for milliseconds. One thread at a time a session.
 *     [obstacle]  wait-free, as [servo]. One thread at a time a session.
 *     [any]       lock-free, by any number of threads at once.
 *
 * Functions of different classes may run at the same time on the same session, and so may ticks of different tools.
 * Two threads in functions of one class and session ([any] apart), or in ticks of one tool, are an error of the host
 * that is found: the second gets HAPFLOW_ERROR_BUSY, and zero force. Different sessions know nothing of each other.
 *
 * Rules for all functions
 * -----------------------
 * - Results: negative, it failed; zero, it is done; positive, it is done and there is a remark.
 * - On failure outputs are untouched. But a hapflow_wrench is always written, and is then zero.
 * - Everything is SI and double, right-handed, y up. Quaternions are x, y, z, w.
 * - A pointer must not be null unless its function says so (HAPFLOW_ERROR_NULL). It need not be aligned. What a
 *   pointer points to is the caller's, and is not looked at after the call. Texts are UTF-8 and end with a NUL.
 * - Texts that the library shows are its own, never change, and last as long as is said where they stand.
 * - A number that is NaN or infinite is refused, everywhere (HAPFLOW_ERROR_NOT_FINITE).
 * - Handles are values. A stale one is refused (HAPFLOW_ERROR_HANDLE), as is zero, which is null.
 * - Structs that begin with a size are made by their init function, with their sizeof; configurations begin with
 *   kind, size and next. A published struct only grows at its end: a program that was compiled with an older header
 *   keeps working, and what it does not know has its default.
 * - No panic of the library's Rust code leaves it: HAPFLOW_ERROR_PANIC, zero force, and the session is faulted.
 *   (Out of memory, as in all Rust, the process ends.)
 * - Numbers of results, kinds and faults are never used again for something else.
 * - The library stays in memory once it is loaded; dlclose does not unload it.
 *
 * What is optional will be asked for by name and revision, as "hapflow.fluid/1"; nothing is yet.
 */
#ifndef HAPFLOW_HAPFLOW_H
#define HAPFLOW_HAPFLOW_H

#include <stddef.h>
#include <stdint.h>

#if defined(_WIN32)
#define HAPFLOW_API __declspec(dllimport)
#else
#define HAPFLOW_API
#endif

#ifdef __cplusplus
#define HAPFLOW_ASSERT_SIZE(type, bytes) static_assert(sizeof(type) == (bytes), #type)
extern "C" {
#else
#define HAPFLOW_ASSERT_SIZE(type, bytes) _Static_assert(sizeof(type) == (bytes), #type)
#endif

/* The version of this interface: what to give to hapflow_negotiate. */
#define HAPFLOW_ABI_VERSION 1u

/* Sessions at once in a process. */
#define HAPFLOW_MAX_SESSIONS 64u

/* Tools of a session. */
#define HAPFLOW_MAX_TOOLS 8u

/* ---------------------------------------------------------------------------------------------------- results */

typedef int32_t hapflow_result;

enum {
    HAPFLOW_OK = 0,
    /* Remarks: it is done. Of several that hold, the one with the lowest number is told. */
    HAPFLOW_REMARK_FORCE_HELD = 1, /* a fault holds the force at zero until hapflow_session_clear_faults */
    HAPFLOW_REMARK_NO_TIME = 2, /* dt_s was 0: the force stayed as it was */
    HAPFLOW_REMARK_LATE = 3, /* dt_s was above 10 ms: the force changed no more than in 10 ms */
    HAPFLOW_REMARK_MORE = 4, /* there is more than the buffer holds; the rest was left out */
    /* Failures. */
    HAPFLOW_ERROR_PANIC = -1, /* a defect of the library; the session is faulted */
    HAPFLOW_ERROR_NOT_NEGOTIATED = -2, /* hapflow_negotiate was not called, or had no success */
    HAPFLOW_ERROR_VERSION = -3, /* host and library have no version in common */
    HAPFLOW_ERROR_NULL = -4, /* a pointer is null */
    HAPFLOW_ERROR_HANDLE = -5, /* the session is null, was destroyed, or never was */
    HAPFLOW_ERROR_BUSY = -6, /* another thread is in a function of this class, for this session (or tool) */
    HAPFLOW_ERROR_FULL = -7, /* HAPFLOW_MAX_SESSIONS are there: destroy one */
    HAPFLOW_ERROR_STRUCT = -8, /* kind or size of a struct is wrong: call its init function */
    HAPFLOW_ERROR_UNSUPPORTED = -9, /* a field, or a chained struct, that this library does not know */
    HAPFLOW_ERROR_TEXT = -10, /* a text is not UTF-8 */
    HAPFLOW_ERROR_SCENE = -11, /* the scene cannot be read or run; hapflow_last_error has line and field */
    HAPFLOW_ERROR_NOT_FOUND = -12, /* no shipped scene and no file of that name */
    HAPFLOW_ERROR_SETTING = -13, /* no setting of that path; hapflow_last_error has the nearest */
    HAPFLOW_ERROR_VALUE = -14, /* outside its range, or of the wrong type; hapflow_last_error has the range */
    HAPFLOW_ERROR_FIXED = -15, /* the setting cannot change while a session runs */
    HAPFLOW_ERROR_NOT_FINITE = -16, /* a number is NaN or infinite */
    HAPFLOW_ERROR_ORIENTATION = -17, /* the length of the quaternion differs from 1 by more than 1e-3 */
    HAPFLOW_ERROR_TIME = -18, /* a time goes back, is negative, or is too far ahead */
    HAPFLOW_ERROR_FAULTED = -19, /* the fluid panicked before: destroy the session */
    HAPFLOW_ERROR_INDEX = -20, /* an index that is not below the count */
    HAPFLOW_ERROR_DRIVE = -21, /* the session's own thread steps the fluid */
};

/* A sentence on a result, in English. [any] Never null; lasts as long as the process; any number may be asked. */
HAPFLOW_API const char* hapflow_result_text(hapflow_result result);

/* What exactly was wrong when a [main] function last failed on this thread: field, value, allowed range, and line in
 * a scene. [main] Written to `text`, which has room for `capacity` bytes, NUL included; `length` becomes the length
 * of the whole message, without NUL. With a capacity of 0 `text` may be null, and only the length is told. Too small
 * a buffer gets the beginning, and HAPFLOW_REMARK_MORE. Empty if nothing has failed; a success leaves it as it is.
 * Errors: NULL. */
HAPFLOW_API hapflow_result hapflow_last_error(char* text, size_t capacity, size_t* length);

/* ---------------------------------------------------------------------------------------------------- version */

/* Agrees on a version of this interface. [main] Comes before anything else; a host gives HAPFLOW_ABI_VERSION twice,
 * or the range that it can live with. `chosen` becomes the highest that both know. Repeating it is harmless.
 * Errors: VERSION, NULL. */
HAPFLOW_API hapflow_result hapflow_negotiate(uint32_t oldest, uint32_t newest, uint32_t* chosen);

/* The release of the library: major * 1000000 + minor * 1000 + patch. [any] Needs no negotiation. */
HAPFLOW_API uint32_t hapflow_version(void);

/* ------------------------------------------------------------------------------------------- what the build has */

/* What this library is and has, one `key = value` a line. [main, several at once] Needs no negotiation. `text`,
 * `capacity` and `length` as in hapflow_last_error. Lists are separated by one space, and may be empty; keys may
 * come to it, and have no order:
 *
 *     version     release, as 0.1.0
 *     abi         every version of this interface that it speaks
 *     target      processor, operating system
 *     features    optional parts of the build
 *     backends    words of the setting run.backend; likewise
 *     solvers     of fluid.solver
 *     modes       of fluid.mode
 *     couplings   of run.coupling
 *     tools       of tool.shape
 *     devices     names of the devices
 *     scenes      names of the shipped scenes
 *
 * Errors: NULL. */
HAPFLOW_API hapflow_result hapflow_build_info(char* text, size_t capacity, size_t* length);

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

/* A haptic device that the library knows; whether one is plugged in is not asked. */
typedef struct hapflow_device_info {
    uint32_t size; /* sizeof(hapflow_device_info) */
    uint32_t sensed_dof; /* degrees of freedom that it measures, to 6; 3: the position alone */
    uint32_t driven_dof; /* degrees of freedom that it drives, to 6; 3: the force alone */
    uint32_t hardware; /* 1: a machine that a person holds; 0: simulated */
    double max_force; /* largest force, N; 0 where nothing is felt */
    const char* name; /* word of the setting run.device. Both texts last as long as the process */
    const char* about; /* one line about it */
} hapflow_device_info;
#if UINTPTR_MAX > 0xffffffffu
HAPFLOW_ASSERT_SIZE(hapflow_device_info, 40);
#endif

/* Empties `info`, for a struct of `size` bytes: sizeof *info. [any] Errors: NULL, STRUCT. */
HAPFLOW_API hapflow_result hapflow_device_info_init(hapflow_device_info* info, uint32_t size);

/* How many devices the library knows. [main, several at once] Needs no negotiation. */
HAPFLOW_API uint32_t hapflow_device_count(void);

/* The device `index`, from 0. [main, several at once] Needs no negotiation. Errors: NULL, STRUCT, INDEX. */
HAPFLOW_API hapflow_result hapflow_device_get(uint32_t index, hapflow_device_info* info);

/* ---------------------------------------------------------------------------------------------------- sessions */

/* A session: a scene, its fluid and its tools. The host ticks the servo; it steps the fluid, or the session does. */
typedef struct hapflow_session {
    uint64_t id; /* 0: no session */
} hapflow_session;
HAPFLOW_ASSERT_SIZE(hapflow_session, 8);

#define HAPFLOW_KIND_SESSION_CONFIG 1u

/* Who steps the fluid: hapflow_session_config.fluid_drive. */
enum {
    HAPFLOW_DRIVE_HOST = 0, /* the host, by hapflow_fluid_advance or hapflow_fluid_step */
    /* A thread of the session, once a fluid frame on the clock that the ticks move on: without ticks it stands still.
     * Frames that it is too slow for are left out. It is as fast as the machine, so that no run is quite another's. */
    HAPFLOW_DRIVE_OWNED = 1,
};

/* How a session is made. Exactly one of `scene` and `toml` is given. */
typedef struct hapflow_session_config {
    uint32_t kind; /* HAPFLOW_KIND_SESSION_CONFIG */
    uint32_t size; /* sizeof(hapflow_session_config) */
    const void* next; /* null */
    const char* scene; /* name of a shipped scene, as "tap", or path of a scene file; or null */
    const char* toml; /* text of a scene file; or null */
    size_t toml_length; /* its bytes; 0: up to its NUL */
    const char* settings; /* lines `path = value` that are set on top, as "fluid.viscosity = 0.1\n"; or null */
    uint32_t threads; /* worker threads of the fluid, to 1024; 0: all cores but one. Results do not depend on it */
    uint32_t fluid_drive; /* HAPFLOW_DRIVE_...; HOST by default */
} hapflow_session_config;
#if UINTPTR_MAX > 0xffffffffu
HAPFLOW_ASSERT_SIZE(hapflow_session_config, 56);
#endif

/* Fills `config` with the defaults, for a struct of `size` bytes: sizeof *config. [any] Errors: NULL, STRUCT. */
HAPFLOW_API hapflow_result hapflow_session_config_init(hapflow_session_config* config, uint32_t size);

/* Makes a session. [main, several at once] Takes milliseconds to seconds, as the scene has particles. The host owns
 * the session, and destroys it.
 * Errors: NOT_NEGOTIATED, NULL, STRUCT, UNSUPPORTED, TEXT, SCENE, NOT_FOUND, SETTING, VALUE, FULL. */
HAPFLOW_API hapflow_result hapflow_session_create(const hapflow_session_config* config, hapflow_session* session);

/* Ends a session; its handle is stale from then on. [main, several at once] Calls of other threads that are under
 * way are waited for; later ones are refused. Errors: HANDLE. */
HAPFLOW_API hapflow_result hapflow_session_destroy(hapflow_session session);

/* Sets a live setting to a number. [main] Acts from the next fluid frame and the next tick on. The paths are those
 * of a scene file ("fluid.viscosity", "source.tap.speed"), with its units and ranges.
 * Errors: HANDLE, BUSY, NULL, TEXT, SETTING, FIXED, VALUE (range, type, or not stable), NOT_FINITE; the setting then
 * keeps its value. */
HAPFLOW_API hapflow_result hapflow_session_set(hapflow_session session, const char* path, double value);

/* The same for three numbers. [main] Errors: as hapflow_session_set. */
HAPFLOW_API hapflow_result hapflow_session_set_vector(hapflow_session session, const char* path,
                                                      const double value[3]);

/* The same for any setting, with its value as a command line has it: "true", "1.5", "[0, -9.81, 0]", "wcsph".
 * [main] Errors: as hapflow_session_set. */
HAPFLOW_API hapflow_result hapflow_session_set_text(hapflow_session session, const char* path, const char* value);

/* Reads a setting that is a number, or a switch (0 or 1). [main]
 * Errors: HANDLE, BUSY, NULL, TEXT, SETTING, VALUE (neither). */
HAPFLOW_API hapflow_result hapflow_session_get(hapflow_session session, const char* path, double* value);

/* Reads any setting as a text. [main] `text`, `capacity` and `length` as in hapflow_last_error.
 * Errors: HANDLE, BUSY, NULL, TEXT, SETTING. */
HAPFLOW_API hapflow_result hapflow_session_get_text(hapflow_session session, const char* path, char* text,
                                                    size_t capacity, size_t* length);

/* What a setting may be: hapflow_setting_info.kind. A kind that is not here can be shown and set as a text. */
enum {
    HAPFLOW_SETTING_NUMBER = 1, /* a number from min to max: hapflow_session_set */
    HAPFLOW_SETTING_INTEGER = 2, /* the same, whole */
    HAPFLOW_SETTING_SWITCH = 3, /* "true" or "false": hapflow_session_set_text */
    HAPFLOW_SETTING_CHOICE = 4, /* one of `choices`: hapflow_session_set_text */
    HAPFLOW_SETTING_TEXT = 5, /* a text with a grammar of its own, which `about` tells */
    HAPFLOW_SETTING_VECTOR = 6, /* three numbers, each from min to max: hapflow_session_set_vector */
};

/* A setting of a session, with all that a panel needs to show it. The texts belong to the session, never change, and
 * last until it is destroyed; none is null. */
typedef struct hapflow_setting_info {
    uint32_t size; /* sizeof(hapflow_setting_info) */
    uint32_t kind; /* HAPFLOW_SETTING_... */
    uint32_t live; /* 1: may change while the session runs; 0: only before it is made */
    uint32_t reserved; /* 0 */
    double min; /* smallest; 0 where kind says nothing of it */
    double max; /* largest */
    const char* path; /* as "fluid.viscosity", "source.tap.speed" */
    const char* group; /* the path without its last word, as "source.tap" */
    const char* unit; /* as "m/s"; UTF-8, as all texts are; empty for none */
    const char* about; /* a sentence on what it does */
    const char* choices; /* every word of a choice, separated by newlines; else empty */
    const char* usual; /* its value where a scene says nothing, as hapflow_session_set_text takes it */
} hapflow_setting_info;
#if UINTPTR_MAX > 0xffffffffu
HAPFLOW_ASSERT_SIZE(hapflow_setting_info, 80);
#endif

/* Empties `info`, for a struct of `size` bytes: sizeof *info. [any] Errors: NULL, STRUCT. */
HAPFLOW_API hapflow_result hapflow_setting_info_init(hapflow_setting_info* info, uint32_t size);

/* How many settings the session has: those of the scene with its first tool, and those of every other tool, source and
 * obstacle by its name. [main] It stays as it is.
 * Errors: HANDLE, BUSY, NULL. */
HAPFLOW_API hapflow_result hapflow_session_setting_count(hapflow_session session, uint32_t* count);

/* The setting `index`, from 0. [main] The order is that of the documentation, with those by name at the end.
 * Errors: HANDLE, BUSY, NULL, STRUCT, INDEX. */
HAPFLOW_API hapflow_result hapflow_session_setting_info(hapflow_session session, uint32_t index,
                                                        hapflow_setting_info* info);

/* No force on any tool from its next tick on, until the faults are cleared. [any] Errors: HANDLE. */
HAPFLOW_API hapflow_result hapflow_session_emergency_stop(hapflow_session session);

/* Takes back every fault; the force then comes up slowly, as at a start. [any] A cause that is still there raises its
 * fault again. Only a person who has seen that the device is safe should lead to this call. Errors: HANDLE. */
HAPFLOW_API hapflow_result hapflow_session_clear_faults(hapflow_session session);

/* ---------------------------------------------------------------------------------------------------- servo */

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

/* What the hand is to feel: finite, and within the limits of the scene's safety gate. Never grows. */
typedef struct hapflow_wrench {
    double force[3]; /* N, in the frame of the tool state */
    double torque[3]; /* N m, about the tool's position */
} hapflow_wrench;
HAPFLOW_ASSERT_SIZE(hapflow_wrench, 48);

/* Fills `state` for a tool at rest in the origin, at time 0, with dt_s 0.001; `size` is sizeof *state. [any]
 * Errors: NULL, STRUCT. */
HAPFLOW_API hapflow_result hapflow_tool_state_init(hapflow_tool_state* state, uint32_t size);

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

/* ---------------------------------------------------------------------------------------------------- fluid */

/* The functions [fluid] are for a fluid that the host steps; one that the session steps refuses them
 * (HAPFLOW_ERROR_DRIVE). */

/* Steps every fluid frame that has ended by `time_s` on the servo's clock (s, 0 to 1e7); frame n ends at
 * n / run.fluid_hz. [fluid] Often there is none to step. Call it before the tick of the same time: the run is then the
 * same each time, to the last bit.
 *
 * A frame's model reaches the servo when the next frame ends, as on a machine that computes in real time.
 * Errors: HANDLE, BUSY, DRIVE, NOT_FINITE, FAULTED, TIME (more than 10 s after the newest frame's end: another
 * clock?). */
HAPFLOW_API hapflow_result hapflow_fluid_advance(hapflow_session session, double time_s);

/* Steps one frame, whose tool path ends at `end_s` on the servo's clock. [fluid] For a thread that steps in real
 * time, each period of run.fluid_hz, and leaves out what it was too slow for. `end_s` is after that of the frame
 * before, at most 1e7.
 * Errors: HANDLE, BUSY, DRIVE, NOT_FINITE, FAULTED, TIME. */
HAPFLOW_API hapflow_result hapflow_fluid_step(hapflow_session session, double end_s);

/* The particles at the end of the newest frame. [fluid] `positions` has room for `capacity` particles, three floats
 * each (m); `count` becomes the number that there are. With a capacity of 0 `positions` may be null, and only the
 * count is told. Too small a buffer gets the first ones, and HAPFLOW_REMARK_MORE. The order is no identity.
 * Errors: HANDLE, BUSY, DRIVE, NULL, FAULTED. */
HAPFLOW_API hapflow_result hapflow_fluid_particles(hapflow_session session, float* positions, size_t capacity,
                                                   size_t* count);

/* The particles that came last, whoever steps the fluid. [main] `positions`, `capacity` and `count` as in
 * hapflow_fluid_particles. A call with a capacity of 0 takes what has come, and asks for more, which comes with the
 * next fluid frame; the call with a buffer after it gets what was taken, so that its count holds. One with a buffer
 * that follows no such call takes and asks by itself. There are none until the first have come.
 * May wait while the fluid copies its particles, for a fraction of a millisecond.
 * Errors: HANDLE, BUSY, NULL. */
HAPFLOW_API hapflow_result hapflow_session_particles(hapflow_session session, float* positions, size_t capacity,
                                                     size_t* count);

/* ---------------------------------------------------------------------------------------------------- obstacles */

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

/* ---------------------------------------------------------------------------------------------------- report */

/* Bits of hapflow_report.faults. The first group latches: no force until it is cleared. So does a bit that is not
 * here. */
enum {
    HAPFLOW_FAULT_INPUT = 1 << 0, /* a tool state was refused */
    HAPFLOW_FAULT_FORCE = 1 << 1, /* a computed force was not finite */
    HAPFLOW_FAULT_PANIC = 1 << 2, /* a defect of the library */
    HAPFLOW_FAULT_DEVICE_LOST = 1 << 4, /* the device no longer answers */
    HAPFLOW_FAULT_EMERGENCY_STOP = 1 << 5, /* hapflow_session_emergency_stop */
    HAPFLOW_FAULT_FLUID = 1 << 7, /* the fluid gave up */
    /* Remarks, which go by themselves. */
    HAPFLOW_FAULT_STALE = 1 << 3, /* the fluid's newest frame is too old, or there is none: the force fades */
    HAPFLOW_FAULT_PATH_OVERFLOW = 1 << 6, /* part of the tool's path never reached the fluid */
    HAPFLOW_FAULT_LATE_TICK = 1 << 8, /* the servo ticked late */
    HAPFLOW_FAULT_FORCE_LIMITED = 1 << 9, /* the wanted force or torque was larger than allowed */
    HAPFLOW_FAULT_SLEW_LIMITED = 1 << 10, /* it changed faster than allowed */
};

/* The newest tick, and the newest fluid frame. Vectors are in the scene's frame. */
typedef struct hapflow_report {
    uint32_t size; /* sizeof(hapflow_report) */
    uint32_t faults; /* HAPFLOW_FAULT_... of the newest tick, and what was raised since */
    uint64_t tick; /* number of the tick, from 1; 0: none yet */
    double time_s; /* its time, s */
    double position[3]; /* the tool, m */
    double body[3]; /* the tool's body in the fluid, m */
    double raw_force[3]; /* what the coupling gave, N */
    double raw_torque[3]; /* N m */
    double force[3]; /* what left the gate, N */
    double torque[3]; /* N m */
    uint64_t model_frame; /* the fluid frame that the tick used; 0: none yet */
    double model_age_s; /* its age, s; while there is none, the time since the first tick */
    uint64_t fluid_frame; /* number of the newest fluid frame, from 1; 0: none yet */
    double fluid_time_s; /* fluid time at its end, s */
    uint64_t particles; /* particles at its end */
    uint64_t substeps; /* its sub-steps */
    double max_speed; /* highest particle speed in it, m/s */
    double load_force[3]; /* mean load of the fluid on the first tool in it, N */
    double load_torque[3]; /* N m */
    uint64_t degraded; /* frames so far that hit a limit of the solver */
} hapflow_report;
HAPFLOW_ASSERT_SIZE(hapflow_report, 280);

/* Empties `report`, for a struct of `size` bytes: sizeof *report. [any] Errors: NULL, STRUCT. */
HAPFLOW_API hapflow_result hapflow_report_init(hapflow_report* report, uint32_t size);

/* Reads the newest tick of the first tool, and the newest frame. [main] Never waits for either.
 * Errors: HANDLE, BUSY, NULL, STRUCT. */
HAPFLOW_API hapflow_result hapflow_session_report(hapflow_session session, hapflow_report* report);

/* The same with the newest tick of tool `tool`, from 0. [main] Errors: HANDLE, BUSY, NULL, STRUCT, INDEX. */
HAPFLOW_API hapflow_result hapflow_session_report_of(hapflow_session session, uint32_t tool, hapflow_report* report);

#ifdef __cplusplus
}
#endif
#undef HAPFLOW_ASSERT_SIZE
#endif
