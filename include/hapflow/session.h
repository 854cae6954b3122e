/* A session: how it is made, ended and stopped. Part of <hapflow/hapflow.h>. */
#ifndef HAPFLOW_SESSION_H
#define HAPFLOW_SESSION_H

#include <hapflow/device.h>
#include <hapflow/scene.h>

HAPFLOW_BEGIN_DECLS

/* Sessions at once in a process. */
#define HAPFLOW_MAX_SESSIONS 64u

/* A session: a scene, its fluid and its tools. Host or session tick the servo, and host or session step the fluid. */
typedef struct hapflow_session {
    uint64_t id; /* 0: no session */
} hapflow_session;
HAPFLOW_ASSERT_SIZE(hapflow_session, 8);

#define HAPFLOW_KIND_SESSION_CONFIG 1u

/* Who drives a half of a session, in any combination: hapflow_session_config.servo_drive and .fluid_drive.
 *
 * OWNED, of the servo: a real-time thread for each device reads it, ticks its tool and writes the force, at 1 kHz from
 * the session's creation on; hapflow_servo_tick is refused (HAPFLOW_ERROR_DRIVE). The session's clock then begins at
 * its creation, and the newest time on it is hapflow_report.time_s. A thread ends when its device is lost, or in a
 * panic, with zero force and the fault latched. hapflow_session_servo_pace says how they keep time.
 *
 * OWNED, of the fluid: a thread steps it, once a fluid frame on the servo's clock. With a servo of the host that is the
 * time of its ticks: without ticks it stands still. Frames that it is too slow for are left out. It is as fast as the
 * machine, so that no run is quite another's. */
enum {
    HAPFLOW_DRIVE_HOST = 0, /* the host: hapflow_servo_tick; hapflow_fluid_advance or hapflow_fluid_step */
    HAPFLOW_DRIVE_OWNED = 1, /* threads of the session */
};

/* How much what is told matters. */
enum {
    HAPFLOW_LOG_ERROR = 1, /* there is no force, until a person has seen to it */
    HAPFLOW_LOG_WARNING = 2, /* it is not as good as it should be */
    HAPFLOW_LOG_INFO = 3, /* good to know */
};

/* Gets one line of text, without its end, at a time; `level` is HAPFLOW_LOG_..., `text` lasts for the call, and `user`
 * is hapflow_session_config.log_user. Called by hapflow_session_poll alone, on the thread that calls it. Every function
 * may be called from within, but those of class [main] of the same session, and hapflow_session_destroy of it, are
 * refused (HAPFLOW_ERROR_BUSY). It must return: no exception and no longjmp may leave it. */
typedef void (*hapflow_log_function)(uint32_t level, const char* text, void* user);

/* How a session is made. Exactly one of `scene`, `toml` and `built` is given. */
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
    uint32_t servo_drive; /* HAPFLOW_DRIVE_...; HOST by default */
    uint32_t device_count; /* how many `devices`: 0 with a servo of the host, else to the scene's number of tools */
    /* Devices of an owned servo, in the order of the tools; a tool without one stays where it is. The session takes
     * them over, with no force on them, and closes them in the end: their handles are stale from then on. (If it cannot
     * be made they stay as they were; but where the system starts no thread they are closed.) With a count of 0 it is
     * not looked at, and the device of the scene, as run.device has it, is opened for the first tool. */
    const hapflow_device* devices;
    hapflow_log_function log; /* what is told of the session goes there; or null */
    void* log_user; /* handed to it, and not looked at */
    uint32_t record; /* 1: hapflow_session_record may be called; 0: then nothing is kept ready for it */
    uint32_t reserved; /* 0 */
    hapflow_scene built; /* a scene that was built by calls, which is copied; or null, as 0 */
} hapflow_session_config;
#if UINTPTR_MAX > 0xffffffffu
HAPFLOW_ASSERT_SIZE(hapflow_session_config, 104);
#endif

/* Fills `config` with the defaults, for a struct of `size` bytes: sizeof *config. [any] Errors: NULL, STRUCT. */
HAPFLOW_API hapflow_result hapflow_session_config_init(hapflow_session_config* config, uint32_t size);

/* Makes a session. [main, several at once] Takes milliseconds to seconds, as the scene has particles. The host owns
 * the session, and destroys it.
 * Errors: NOT_NEGOTIATED, NULL, STRUCT, UNSUPPORTED, TEXT, SCENE, NOT_FOUND, SETTING, VALUE, FULL, HANDLE (of a
 * device or scene), BUSY and FAULTED (of a scene), DEVICE. */
HAPFLOW_API hapflow_result hapflow_session_create(const hapflow_session_config* config, hapflow_session* session);

/* Ends a session; its handle is stale from then on. [main, several at once] Threads of its own end first, the servos
 * before the fluid, with zero force on their devices. Calls of other threads that are under way are waited for; later
 * ones are refused. Errors: HANDLE, BUSY (from its log function). */
HAPFLOW_API hapflow_result hapflow_session_destroy(hapflow_session session);

/* No force on any tool from its next tick on, until the faults are cleared. [any] Errors: HANDLE. */
HAPFLOW_API hapflow_result hapflow_session_emergency_stop(hapflow_session session);

/* Takes back every fault; the force then comes up slowly, as at a start. [any] A cause that is still there raises its
 * fault again. Only a person who has seen that the device is safe should lead to this call. Errors: HANDLE. */
HAPFLOW_API hapflow_result hapflow_session_clear_faults(hapflow_session session);

/* From the next tick on, no force on any tool is larger than `max_force` (N), and no torque than `max_torque` (N m), for
 * the rest of the session. [any] Such a limit can be lowered and never raised; it begins as the scene's gate.max_force
 * and gate.max_torque, and those settings cannot be raised above it either. A force that is up shrinks at once. Of two
 * calls at once the lower of each counts.
 * Errors: HANDLE, NOT_FINITE, VALUE (negative, or above the present limit); both then stay as they were. */
HAPFLOW_API hapflow_result hapflow_session_limit_force(hapflow_session session, double max_force, double max_torque);

HAPFLOW_END_DECLS

#endif
