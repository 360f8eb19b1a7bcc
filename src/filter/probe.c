/* SPDX-License-Identifier: MIT */
/* probe.c - see probe.h. */
#include "filter/probe.h"

#include "context.h"

struct smear_probe smear_probe(const smear_context *c)
{
    return (struct smear_probe){ &c->rows, c->filtered, &c->temporal, c->frame.method, c->frame.samples, c->shot.half_exposure,
                                 c->direct };
}
