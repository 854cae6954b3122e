/* What the build has. Part of <hapflow/hapflow.h>. */
#ifndef HAPFLOW_BUILD_H
#define HAPFLOW_BUILD_H

#include <hapflow/result.h>

HAPFLOW_BEGIN_DECLS

/* What this library is and has, one `key = value` a line. [main, several at once] Needs no negotiation. `text`,
 * `capacity` and `length` as in hapflow_last_error. Lists are separated by one space, and may be empty; keys may
 * come to it, and have no order:
 *
 *     version     release, as 0.1.0
 *     abi         every version of this interface that it speaks
 *     target      processor, operating system
 *     features    optional parts of the build: those of extension.h by their second word, as device; and others
 *     backends    words of the setting run.backend; likewise
 *     solvers     of fluid.solver
 *     modes       of fluid.mode
 *     couplings   of run.coupling
 *     tools       of tool.shape
 *     devices     names of the devices
 *     scenes      names of the shipped scenes
 *
 * Errors: NULL. */
HAPFLOW_API hapflow_result hapflow_build_info(char* text, size_t capacity, size_t* length);

HAPFLOW_END_DECLS

#endif
