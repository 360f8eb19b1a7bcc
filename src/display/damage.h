/* SPDX-License-Identifier: MIT */
/* damage.h - what is asked of damage/: what is static from frame to frame, and what shows it already: the window (desc.reuse.cache_static),
 * or the display (desc.reuse.buffer_age). Only what differs, the damage, is drawn. Temporal methods know what moves. Draws of
 * sharp frames are compared with those of the last one, each with that at its place in the order, where desc.methods says so. */
#ifndef SMEAR_DAMAGE_H
#define SMEAR_DAMAGE_H

#include "display/row.h"
#include "geometry/vertex.h"

/* A draw of the last frame, where that was sharp. */
struct smear_damaged_draw {
    uint32_t look[2];               /* hash of all that its picture depends on */
    struct smear_tile_box box;      /* where it is seen, at most */
    bool changed;                   /* its look is not that of the frame before */
};

enum { COMPARES_NEVER, COMPARES_OTHERS, COMPARES_THIS };

struct smear_damage {
    uint32_t scene[2];              /* hash of all that a picture of what is static depends on */
    uint32_t next[2];               /* hash of this frame's, so far */
    bool caches;                    /* desc.reuse.cache_static: the window has all rows of the frame */
    bool is_whole;                  /* all that the last frame drew of it is in the window, or on the display */
    bool is_same;                   /* and it is what this frame wants; if it compares, but for draws that changed */
    uint8_t compares;               /* draws, of this frame or of others: they lie behind this struct */
    /* desc.reuse.buffer_age, else null: */
    struct smear_damaged_tiles tiles;   /* for how many frames each tile must still be drawn, this one included, or
                                         * TILE_DAMAGED_NOW */
    struct smear_tile_box *seen;        /* where each static draw is seen, in their order */
    uint32_t *over;                     /* sum of hashes of what lies over each tile; null without SMEAR_WITH_OVERLAY */
};

/* Whether what is static need not be drawn: the window shows it. */
static inline bool static_is_cached(const struct smear_damage *d)
{
    return SMEAR_WITH_DAMAGE && d != NULL && d->caches && d->is_same;
}

/* Whether the window must stay as it is: the next frame may want what is static of it. */
static inline bool static_is_kept(const struct smear_damage *d) { return SMEAR_WITH_DAMAGE && d != NULL && d->caches; }

/* Whether only damaged tiles are drawn and sent. */
static inline bool damage_has_tiles(const struct smear_damage *d)
{
    return SMEAR_WITH_DAMAGE && d != NULL && d->tiles.tile != NULL;
}

/* Whether draws of the frame, which is sharp, are compared. */
static inline bool damage_compares(const struct smear_damage *d)
{
    return SMEAR_WITH_DAMAGE && d != NULL && d->compares == COMPARES_THIS;
}

/* Draws of the last frame, in their order; those that it had not are seen nowhere. */
static inline struct smear_damaged_draw *damage_draws(struct smear_damage *d)
{
    return (struct smear_damaged_draw *)(void *)(d + 1);
}

/* Forgets what is shown: something else is drawn. */
static inline void damage_forget(struct smear_damage *d)
{
    if (SMEAR_WITH_DAMAGE && d != NULL)
        d->is_same = d->is_whole = false;
}

/* Tiles [first, end) of a row. */
struct smear_damage_run {
    int first, end;
};

/* Finds the next tiles beside each other that must be drawn and sent, of a row whose moving triangles are listed: from
 * tile `end` of the run before, or 0, on. False when there are no more. */
bool smear_damage_next_run(const struct smear_damage *d, const struct smear_rows *rows, int row,
                           struct smear_damage_run *run);

/* Notes that the row's damaged tiles have been sent. */
void smear_damage_row_sent(struct smear_damage *d, const struct smear_rows *rows, int row);

#endif
