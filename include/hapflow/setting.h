/* Settings of a session, with all that a panel needs to show them. Part of <hapflow/hapflow.h>. */
#ifndef HAPFLOW_SETTING_H
#define HAPFLOW_SETTING_H

#include <hapflow/session.h>

HAPFLOW_BEGIN_DECLS

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

HAPFLOW_END_DECLS

#endif
