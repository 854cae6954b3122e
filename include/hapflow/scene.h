/* Scenes that the library brings along. Part of <hapflow/hapflow.h>. */
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

HAPFLOW_END_DECLS

#endif
