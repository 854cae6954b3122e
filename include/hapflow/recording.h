/* Recordings: every tick in a file, while a session runs. Part of <hapflow/hapflow.h>. */
#ifndef HAPFLOW_RECORDING_H
#define HAPFLOW_RECORDING_H

#include <hapflow/session.h>

HAPFLOW_BEGIN_DECLS

/* Writes every tick of every tool to a CSV file from now on, in whatever drive. [main] The session was made with
 * hapflow_session_config.record = 1. `path` is the first tool's file, made anew; any other's has its number before the
 * extension, as run.csv and run.1.csv. A thread of its own writes; no tick waits for it.
 *
 * The columns are time_s; x_m, y_m, z_m and vx_m_s, vy_m_s, vz_m_s of the tool; raw_, filtered_ and sent_fx_N, _fy_N,
 * _fz_N; in the scene's frame. Every number reads back to the last bit. The device "replay" plays such a file with the
 * settings run.motion = its path and run.motion_origin = scene.
 * Errors: HANDLE, BUSY, NULL, TEXT, FILE (with path and cause), RECORDING (one is under way, or record was 0). */
HAPFLOW_API hapflow_result hapflow_session_record(hapflow_session session, const char* path);

/* Ends the recording with the newest tick. [main] `ticks` becomes the number that was written, of all tools, and `lost`
 * that of ticks that are missing, since they came faster than the file took them. Waits for the file. Without it a
 * recording ends with its session.
 * Errors: HANDLE, BUSY, NULL, FILE (it could not be written to its end: a full disc), RECORDING (there is none). */
HAPFLOW_API hapflow_result hapflow_session_record_stop(hapflow_session session, uint64_t* ticks, uint64_t* lost);

HAPFLOW_END_DECLS

#endif
