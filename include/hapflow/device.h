/* Haptic devices that the library knows. Part of <hapflow/hapflow.h>. */
#ifndef HAPFLOW_DEVICE_H
#define HAPFLOW_DEVICE_H

#include <hapflow/result.h>

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

HAPFLOW_END_DECLS

#endif
