/* A session: how it is made, ended and stopped. Part of <hapflow/hapflow.h>. */
#ifndef HAPFLOW_SESSION_H
#define HAPFLOW_SESSION_H

#include <hapflow/result.h>

HAPFLOW_BEGIN_DECLS

/* Sessions at once in a process. */
#define HAPFLOW_MAX_SESSIONS 64u

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

/* No force on any tool from its next tick on, until the faults are cleared. [any] Errors: HANDLE. */
HAPFLOW_API hapflow_result hapflow_session_emergency_stop(hapflow_session session);

/* Takes back every fault; the force then comes up slowly, as at a start. [any] A cause that is still there raises its
 * fault again. Only a person who has seen that the device is safe should lead to this call. Errors: HANDLE. */
HAPFLOW_API hapflow_result hapflow_session_clear_faults(hapflow_session session);

HAPFLOW_END_DECLS

#endif
