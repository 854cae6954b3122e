/* What a session has to say, told to the host on its own thread. Part of <hapflow/hapflow.h>. */
#ifndef HAPFLOW_LOG_H
#define HAPFLOW_LOG_H

#include <hapflow/session.h>

HAPFLOW_BEGIN_DECLS

/* Tells what has happened since the last call (at the first: since the session began) to hapflow_session_config.log.
 * [main] A few times a second is enough; without a log function it does nothing. Told are:
 *
 *     faults and remarks of hapflow_report.faults of each tool, as they come and go; FORCE_LIMITED and SLEW_LIMITED,
 *     which are of everyday, once a session
 *     frames that the session's fluid was too slow for
 *     frames that hit a limit of the solver
 *     what the system said to the priority of each owned servo, and that one has ended
 *
 * Servo and fluid write no log, and wait for none: it is made here, of what they report. What came and went between two
 * calls is not seen, but for what is counted.
 * Errors: HANDLE, BUSY. */
HAPFLOW_API hapflow_result hapflow_session_poll(hapflow_session session);

HAPFLOW_END_DECLS

#endif
