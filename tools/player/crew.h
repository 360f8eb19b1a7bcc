/* SPDX-License-Identifier: MIT */
/* crew.h - threads that stand for the other cores of a device. */
#ifndef SMEAR_TOOLS_CLI_CREW_H
#define SMEAR_TOOLS_CLI_CREW_H

#include "tools/failure.h"

#include <smear.h>

struct crew;

/* Starts `workers` - 1 threads with the indices 1 to workers - 1; null on failure. */
struct crew *crew_start(int workers, struct failure *f);

/* smear_render with the crew's help; null is a crew of nobody. */
int crew_render(struct crew *crew, smear_context *ctx);

/* Ends the threads. Null is allowed. */
void crew_stop(struct crew *crew);

/* For smear_desc.idle: lets another thread run. */
void crew_idle(void *user);

#endif
