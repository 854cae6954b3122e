/* Results, a sentence on each, and the last error in full. Part of <hapflow/hapflow.h>. */
#ifndef HAPFLOW_RESULT_H
#define HAPFLOW_RESULT_H

#include <hapflow/base.h>

HAPFLOW_BEGIN_DECLS

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
    HAPFLOW_ERROR_HANDLE = -5, /* the session, device or scene is null, was destroyed or closed, or never was */
    HAPFLOW_ERROR_BUSY = -6, /* another thread is in a function of this class, for this session (or tool, device, scene) */
    HAPFLOW_ERROR_FULL = -7, /* HAPFLOW_MAX_SESSIONS, _DEVICES or _SCENES are there: destroy or close one */
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
    HAPFLOW_ERROR_FAULTED = -19, /* the fluid, or the scene, panicked before: destroy it */
    HAPFLOW_ERROR_INDEX = -20, /* an index that is not below the count */
    HAPFLOW_ERROR_DRIVE = -21, /* the session's own thread does that: tick the servo, or step the fluid */
    HAPFLOW_ERROR_DEVICE = -22, /* the device cannot be opened, or does not answer any more */
    HAPFLOW_ERROR_FILE = -23, /* a file cannot be written; hapflow_last_error has path and cause */
    HAPFLOW_ERROR_RECORDING = -24, /* there is a recording, there is none, or the session was made without */
};

/* A sentence on a result, in English. [any] Never null; lasts as long as the process; any number may be asked. */
HAPFLOW_API const char* hapflow_result_text(hapflow_result result);

/* What exactly was wrong when a [main] function last failed on this thread: field, value, allowed range, and line in
 * a scene. [main] Written to `text`, which has room for `capacity` bytes, NUL included; `length` becomes the length
 * of the whole message, without NUL. With a capacity of 0 `text` may be null, and only the length is told. Too small
 * a buffer gets the beginning, and HAPFLOW_REMARK_MORE. Empty if nothing has failed; a success leaves it as it is.
 * Errors: NULL. */
HAPFLOW_API hapflow_result hapflow_last_error(char* text, size_t capacity, size_t* length);

HAPFLOW_END_DECLS

#endif
