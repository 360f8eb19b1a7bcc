/* SPDX-License-Identifier: MIT */
/* damage.h - what stands still from frame to frame: kept in the window (smear_desc.cache_static), or by the display
 * (smear_desc.buffer_age). */
#ifndef SMEAR_DAMAGE_H
#define SMEAR_DAMAGE_H

#include "context.h"

/* The draw is among what stands still in a frame of a timed method. */
static inline bool draw_is_static(const struct smear_context *c, uint32_t i)
{
    return !c->raster_draw[i].moves && c->raster_draw[i].alpha != SMEAR_BLEND;
}

/* Before anything is drawn: whether it is the last frame's scene that stands still (is_same). */
void smear_damage_begin(struct smear_context *c);

/* Nothing shows it any longer: something else is drawn. */
static inline void damage_forget(struct smear_context *c)
{
    if (c->still != NULL)
        c->still->is_same = c->still->is_whole = false;
}

/* All rows have been drawn, or held. */
void smear_damage_end(struct smear_context *c);

/* The next tiles beside each other that must be drawn and sent, of a row whose moving triangles are listed: from tile
 * `end` of the run before, or 0, on. False when there are no more. */
struct smear_damage_run {
    int first, end;                 /* [first, end) */
};

bool smear_damage_next_run(const struct smear_context *c, int row, struct smear_damage_run *run);

/* They have all been sent. */
void smear_damage_row_sent(struct smear_context *c, int row);

#endif
