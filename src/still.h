/* SPDX-License-Identifier: MIT */
/* still.h - what stands still, kept from frame to frame (smear_desc.keep_still). */
#ifndef SMEAR_STILL_H
#define SMEAR_STILL_H

#include "context.h"

/* The draw is among what stands still in a frame of a timed method. */
static inline bool draw_stands_still(const struct smear_context *c, uint32_t i)
{
    return !c->raster_draw[i].moves && c->raster_draw[i].alpha != SMEAR_BLEND;
}

/* Before anything is drawn: whether the window shows what this frame wants (still_holds); notes that. */
void smear_still_begin(struct smear_context *c);

/* The window holds no longer: something else is drawn into it. */
static inline void still_forget(struct smear_context *c)
{
    if (c->still != NULL)
        c->still->holds = c->still->is_whole = false;
}

/* All rows have been drawn, or held. */
void smear_still_end(struct smear_context *c);

#endif
