/* Haptic devices that the library knows: for a session that ticks its servo itself, or for a loop of the host. Part of
 * <hapflow/hapflow.h>. */
#ifndef HAPFLOW_DEVICE_H
#define HAPFLOW_DEVICE_H

#include <hapflow/tool_state.h>
#include <hapflow/wrench.h>

HAPFLOW_BEGIN_DECLS

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

/* Devices that are open at once in a process, those of sessions apart. */
#define HAPFLOW_MAX_DEVICES 64u

/* A device that is open. */
typedef struct hapflow_device {
    uint64_t id; /* 0: no device */
} hapflow_device;
HAPFLOW_ASSERT_SIZE(hapflow_device, 8);

#define HAPFLOW_KIND_DEVICE_CONFIG 2u

/* Which device, and how it is made. A scene, of which at most one of `scene` and `toml` is given, has the hand, its
 * script, the motion, the mapping, the first tool's place to begin at, and the limits of the gate ([gate]). */
typedef struct hapflow_device_config {
    uint32_t kind; /* HAPFLOW_KIND_DEVICE_CONFIG */
    uint32_t size; /* sizeof(hapflow_device_config) */
    const void* next; /* null */
    const char* name; /* as hapflow_device_info.name has it; or null: the scene's run.device */
    const char* scene; /* name of a shipped scene, as "tap", or path of a scene file; or null */
    const char* toml; /* text of a scene file; or null */
    size_t toml_length; /* its bytes; 0: up to its NUL */
    const char* settings; /* lines `path = value` that are set on top, as "gate.max_force = 2\n"; or null */
} hapflow_device_config;
#if UINTPTR_MAX > 0xffffffffu
HAPFLOW_ASSERT_SIZE(hapflow_device_config, 56);
#endif

/* Fills `config` with the defaults, for a struct of `size` bytes: sizeof *config. [any] Errors: NULL, STRUCT. */
HAPFLOW_API hapflow_result hapflow_device_config_init(hapflow_device_config* config, uint32_t size);

/* Opens a device. [main, several at once] The host owns it, and closes it or gives it to a session.
 * Errors: NOT_NEGOTIATED, NULL, STRUCT, UNSUPPORTED, TEXT, SCENE, NOT_FOUND, SETTING, VALUE, FULL, DEVICE. */
HAPFLOW_API hapflow_result hapflow_device_open(const hapflow_device_config* config, hapflow_device* device);

/* Takes the force off and lets go of a device; its handle is stale from then on. [main, several at once] Calls of
 * other threads that are under way are waited for; later ones are refused. Errors: HANDLE. */
HAPFLOW_API hapflow_result hapflow_device_close(hapflow_device device);

/* Where the device is at `time_s` (s, 0 to 1e7, never less than at its last reading): `state` becomes what
 * hapflow_servo_tick takes, but keeps its `tool`. [servo] But for the device's own transfer, which may be a system
 * call. `state` is one that its init function has made; its dt_s becomes the time since the last reading, 0.001 at the
 * first. Simulated devices move up to that time. One that does not answer, or answers nonsense, is lost (DEVICE): its
 * force is zero at once, and stays so until hapflow_device_clear_faults.
 * Errors: HANDLE, BUSY, NULL, STRUCT, UNSUPPORTED, NOT_FINITE, TIME, DEVICE. */
HAPFLOW_API hapflow_result hapflow_device_read(hapflow_device device, double time_s, hapflow_tool_state* state);

/* What the hand is to feel until the next write; `dt_s` is the time since the last (s, not negative; above 0.01 it
 * counts as 0.01). [servo] But for the device's own transfer.
 *
 * It passes a safety gate of the device's own, with the limits of its configuration: finite, of limited size and slew,
 * and coming up slowly at first. A wrench of zeros takes the force off at once. What is refused (NULL, NOT_FINITE,
 * TIME), and a device that is lost, latches: the force is zero at once, and stays so until hapflow_device_clear_faults.
 * Remarks: FORCE_HELD, NO_TIME, LATE.
 * Errors: HANDLE, BUSY, NULL, NOT_FINITE, TIME, DEVICE. */
HAPFLOW_API hapflow_result hapflow_device_write(hapflow_device device, const hapflow_wrench* wrench, double dt_s);

/* Takes back every fault of a device; the force then comes up slowly, as at first. [any] Only a person who has seen
 * that the device is safe should lead to this call. Errors: HANDLE. */
HAPFLOW_API hapflow_result hapflow_device_clear_faults(hapflow_device device);

HAPFLOW_END_DECLS

#endif
