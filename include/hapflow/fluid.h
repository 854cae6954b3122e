/* Frames of the fluid, and its particles. Part of <hapflow/hapflow.h>. */
#ifndef HAPFLOW_FLUID_H
#define HAPFLOW_FLUID_H

#include <hapflow/session.h>

HAPFLOW_BEGIN_DECLS

/* The functions [fluid] are for a fluid that the host steps; one that the session steps refuses them
 * (HAPFLOW_ERROR_DRIVE). */

/* Steps every fluid frame that has ended by `time_s` on the servo's clock (s, 0 to 1e7); frame n ends at
 * n / run.fluid_hz. [fluid] Often there is none to step. Call it before the tick of the same time: the run is then the
 * same each time, to the last bit.
 *
 * A frame's model reaches the servo when the next frame ends, as on a machine that computes in real time.
 * Errors: HANDLE, BUSY, DRIVE, NOT_FINITE, FAULTED, TIME (more than 10 s after the newest frame's end: another
 * clock?). */
HAPFLOW_API hapflow_result hapflow_fluid_advance(hapflow_session session, double time_s);

/* Steps one frame, whose tool path ends at `end_s` on the servo's clock. [fluid] For a thread that steps in real
 * time, each period of run.fluid_hz, and leaves out what it was too slow for. `end_s` is after that of the frame
 * before, at most 1e7.
 * Errors: HANDLE, BUSY, DRIVE, NOT_FINITE, FAULTED, TIME. */
HAPFLOW_API hapflow_result hapflow_fluid_step(hapflow_session session, double end_s);

/* The particles at the end of the newest frame. [fluid] `positions` has room for `capacity` particles, three floats
 * each (m); `count` becomes the number that there are. With a capacity of 0 `positions` may be null, and only the
 * count is told. Too small a buffer gets the first ones, and HAPFLOW_REMARK_MORE. The order is no identity.
 * Errors: HANDLE, BUSY, DRIVE, NULL, FAULTED. */
HAPFLOW_API hapflow_result hapflow_fluid_particles(hapflow_session session, float* positions, size_t capacity,
                                                   size_t* count);

/* The particles that came last, whoever steps the fluid. [main] `positions`, `capacity` and `count` as in
 * hapflow_fluid_particles. A call with a capacity of 0 takes what has come, and asks for more, which comes with the
 * next fluid frame; the call with a buffer after it gets what was taken, so that its count holds. One with a buffer
 * that follows no such call takes and asks by itself. There are none until the first have come.
 * May wait while the fluid copies its particles, for a fraction of a millisecond.
 * Errors: HANDLE, BUSY, NULL. */
HAPFLOW_API hapflow_result hapflow_session_particles(hapflow_session session, float* positions, size_t capacity,
                                                     size_t* count);

HAPFLOW_END_DECLS

#endif
