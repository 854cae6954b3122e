/* Which interface, which release. Part of <hapflow/hapflow.h>. */
#ifndef HAPFLOW_VERSION_H
#define HAPFLOW_VERSION_H

#include <hapflow/result.h>

HAPFLOW_BEGIN_DECLS

/* The version of this interface: what to give to hapflow_negotiate. */
#define HAPFLOW_ABI_VERSION 1u

/* Agrees on a version of this interface. [main] Comes before anything else; a host gives HAPFLOW_ABI_VERSION twice,
 * or the range that it can live with. `chosen` becomes the highest that both know. Repeating it is harmless.
 * Errors: VERSION, NULL. */
HAPFLOW_API hapflow_result hapflow_negotiate(uint32_t oldest, uint32_t newest, uint32_t* chosen);

/* The release of the library: major * 1000000 + minor * 1000 + patch. [any] Needs no negotiation. */
HAPFLOW_API uint32_t hapflow_version(void);

HAPFLOW_END_DECLS

#endif
