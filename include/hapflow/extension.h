/* Optional parts of the library, by name and revision. Part of <hapflow/hapflow.h>.
 *
 * A library may be built without them. It has all functions of these headers all the same; those of a part that is
 * absent do nothing and say HAPFLOW_ERROR_UNSUPPORTED. A host that asks for a part's table knows before, and needs no
 * function of it by name. `features` of hapflow_build_info lists the parts as well. */
#ifndef HAPFLOW_EXTENSION_H
#define HAPFLOW_EXTENSION_H

#include <hapflow/device.h>
#include <hapflow/log.h>

HAPFLOW_BEGIN_DECLS

/* The table of functions of an optional part, one of the structs below; null if `name` is null or not one of those that
 * this library has. [any] Needs no negotiation. It lasts as long as the process, and never changes. A revision only
 * grows at its end: look at `size` before a field that came later. */
HAPFLOW_API const void* hapflow_extension(const char* name);

/* Devices in a loop of the host, or opened by it for a session; without it hapflow_session_config.device_count is 0. */
#define HAPFLOW_EXTENSION_DEVICE "hapflow.device/1"

/* Functions of device.h, by their last words. A plugin with this table brings a device of its own: fluid_backend.h says what
 * a plugin is. config_init and open [main] get a configuration without a name; one device is open at a time. read and
 * write [servo] need no gate: hapflow's comes before, and what is read is checked. clear_faults is not called. */
typedef struct hapflow_device_extension {
    uint32_t size; /* bytes of this table */
    uint32_t reserved; /* 0 */
    hapflow_result (*config_init)(hapflow_device_config* config, uint32_t size);
    hapflow_result (*open)(const hapflow_device_config* config, hapflow_device* device);
    hapflow_result (*close)(hapflow_device device);
    hapflow_result (*read)(hapflow_device device, double time_s, hapflow_tool_state* state);
    hapflow_result (*write)(hapflow_device device, const hapflow_wrench* wrench, double dt_s);
    hapflow_result (*clear_faults)(hapflow_device device);
} hapflow_device_extension;
#if UINTPTR_MAX > 0xffffffffu
HAPFLOW_ASSERT_SIZE(hapflow_device_extension, 56);
#endif

/* The log function of a session; without it hapflow_session_config.log is null. */
#define HAPFLOW_EXTENSION_LOG "hapflow.log/1"

/* Functions of log.h. */
typedef struct hapflow_log_extension {
    uint32_t size; /* bytes of this table */
    uint32_t reserved; /* 0 */
    hapflow_result (*poll)(hapflow_session session);
} hapflow_log_extension;
#if UINTPTR_MAX > 0xffffffffu
HAPFLOW_ASSERT_SIZE(hapflow_log_extension, 16);
#endif

HAPFLOW_END_DECLS

#endif
