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
 * Every function below says how it may be called, with one of these classes:
 *
 *     [main]   may block and allocate. One thread at a time a session; it need not always be the same.
 *     [servo]  wait-free: no lock, no allocation, no system call, no log. One thread at a time a tool.
 *     [fluid]  computes, for milliseconds. One thread at a time a session.
 *     [any]    lock-free, by any number of threads at once.
 *
 * Functions of different classes may run at the same time on the same session. Two threads in functions of one class
 * and session ([any] apart) are an error of the host that is found: the second gets HAPFLOW_ERROR_BUSY, and zero
 * force. Different sessions know nothing of each other.
 *
 * Rules for all functions
 * -----------------------
 * - Results: negative, it failed; zero, it is done; positive, it is done and there is a remark.
 * - On failure outputs are untouched. But a hapflow_wrench is always written, and is then zero.
 * - Everything is SI and double, right-handed, y up. Quaternions are x, y, z, w.
 * - A pointer must not be null unless its function says so (HAPFLOW_ERROR_NULL). It need not be aligned. What a
 *   pointer points to is the caller's, and is not looked at after the call. Texts are UTF-8 and end with a NUL.
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
    HAPFLOW_ERROR_BUSY = -6, /* another thread is in a function of this class, for this session */
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

/* ---------------------------------------------------------------------------------------------------- sessions */

/* A session: a scene, its fluid and its tool. The host drives both: it steps the fluid and ticks the servo. */
typedef struct hapflow_session {
    uint64_t id; /* 0: no session */
} hapflow_session;
HAPFLOW_ASSERT_SIZE(hapflow_session, 8);

#define HAPFLOW_KIND_SESSION_CONFIG 1u

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
    uint32_t reserved; /* 0 */
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

/* No force from the next tick on, until the faults are cleared. [any] Errors: HANDLE. */
HAPFLOW_API hapflow_result hapflow_session_emergency_stop(hapflow_session session);

/* Takes back every fault; the force then comes up slowly, as at a start. [any] A cause that is still there raises its
 * fault again. Only a person who has seen that the device is safe should lead to this call. Errors: HANDLE. */
HAPFLOW_API hapflow_result hapflow_session_clear_faults(hapflow_session session);

/* ---------------------------------------------------------------------------------------------------- servo */

/* Where the hand is, and when. In the frame of the device; that is the scene's, unless the scene has a mapping. */
typedef struct hapflow_tool_state {
    uint32_t size; /* sizeof(hapflow_tool_state) */
    uint32_t tool; /* 0: the only one yet */
    uint32_t buttons; /* bit n: button n is down */
    uint32_t reserved; /* 0 */
    double time_s; /* time of this state since the session's start, s: 0 to 1e7, never less than before */
    double dt_s; /* time since the last tick, s: not negative. 0 leaves the force; above 0.01 counts as 0.01 */
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

/* One servo tick: the hand is at `state`; `wrench` becomes what it feels, from the newest fluid frame. [servo]
 *
 * `wrench` is written whatever happens, and is zero on every failure. A state that is refused also latches
 * HAPFLOW_FAULT_INPUT: the force stays zero until hapflow_session_clear_faults, and then comes up slowly, so that one
 * bad sample never makes a jump. BUSY and HANDLE raise no fault.
 * Remarks: FORCE_HELD, NO_TIME, LATE.
 * Errors: HANDLE, BUSY, NULL, STRUCT, UNSUPPORTED, NOT_FINITE, VALUE (too far or too fast), ORIENTATION, TIME. */
HAPFLOW_API hapflow_result hapflow_servo_tick(hapflow_session session, const hapflow_tool_state* state,
                                              hapflow_wrench* wrench);

/* ---------------------------------------------------------------------------------------------------- fluid */

/* Steps every fluid frame that has ended by `time_s` on the servo's clock (s, 0 to 1e7); frame n ends at
 * n / run.fluid_hz. [fluid] Often there is none to step. Call it before the tick of the same time: the run is then the
 * same each time, to the last bit.
 *
 * A frame's model reaches the servo when the next frame ends, as on a machine that computes in real time.
 * Errors: HANDLE, BUSY, NOT_FINITE, FAULTED, TIME (more than 10 s after the newest frame's end: another clock?). */
HAPFLOW_API hapflow_result hapflow_fluid_advance(hapflow_session session, double time_s);

/* Steps one frame, whose tool path ends at `end_s` on the servo's clock. [fluid] For a thread that steps in real
 * time, each period of run.fluid_hz, and leaves out what it was too slow for. `end_s` is after that of the frame
 * before, at most 1e7.
 * Errors: HANDLE, BUSY, NOT_FINITE, FAULTED, TIME. */
HAPFLOW_API hapflow_result hapflow_fluid_step(hapflow_session session, double end_s);

/* The particles at the end of the newest frame. [fluid] `positions` has room for `capacity` particles, three floats
 * each (m); `count` becomes the number that there are. With a capacity of 0 `positions` may be null, and only the
 * count is told. Too small a buffer gets the first ones, and HAPFLOW_REMARK_MORE. The order is no identity.
 * Errors: HANDLE, BUSY, NULL, FAULTED. */
HAPFLOW_API hapflow_result hapflow_fluid_particles(hapflow_session session, float* positions, size_t capacity,
                                                   size_t* count);

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
    double model_age_s; /* its age, s; infinite while there is none */
    uint64_t fluid_frame; /* number of the newest fluid frame, from 1; 0: none yet */
    double fluid_time_s; /* fluid time at its end, s */
    uint64_t particles; /* particles at its end */
    uint64_t substeps; /* its sub-steps */
    double max_speed; /* highest particle speed in it, m/s */
    double load_force[3]; /* mean load of the fluid on the tool in it, N */
    double load_torque[3]; /* N m */
    uint64_t degraded; /* frames so far that hit a limit of the solver */
} hapflow_report;
HAPFLOW_ASSERT_SIZE(hapflow_report, 280);

/* Empties `report`, for a struct of `size` bytes: sizeof *report. [any] Errors: NULL, STRUCT. */
HAPFLOW_API hapflow_result hapflow_report_init(hapflow_report* report, uint32_t size);

/* Reads the newest tick and frame. [main] Never waits for either. Errors: HANDLE, BUSY, NULL, STRUCT. */
HAPFLOW_API hapflow_result hapflow_session_report(hapflow_session session, hapflow_report* report);

#ifdef __cplusplus
}
#endif
#undef HAPFLOW_ASSERT_SIZE
#endif
