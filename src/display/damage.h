/* SPDX-License-Identifier: MIT */
/* damage.h - what is static from frame to frame, and what shows it already: the window (desc.reuse.cache_static), or the
 * display (desc.reuse.buffer_age). Only what differs, the damage, is drawn. Temporal methods know what moves. Draws of
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

/* Takes words into a hash of two lanes. */
void smear_damage_mix(uint32_t h[2], const int32_t *word, int count);

/* Words of a pointer. */
enum { POINTER_WORDS = sizeof(void *) > 4 ? 2 : 1 };

static inline void damage_put_pointer(int32_t *word, const void *p)
{
    word[0] = (int32_t)(uint32_t)(uintptr_t)p;
    if (POINTER_WORDS == 2)
        word[POINTER_WORDS - 1] = (int32_t)(uint32_t)((uint64_t)(uintptr_t)p >> 32);
}

static inline int32_t damage_bytes(int a, int b, int c, int d)
{
    return (int32_t)((uint32_t)a << 24 | (uint32_t)b << 16 | (uint32_t)c << 8 | (uint32_t)d);
}

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

/* Before anything is drawn: takes in the camera and what else a frame's picture of static draws depends on (`kind`: bits of
 * light space, edges, whether draws are compared, and reach), then each static draw, in order, then finds out whether it is the last
 * frame's scene (is_same). Of frames that compare, draws are none of it. */
void smear_damage_begin(struct smear_damage *d, const smear_camera *camera, uint32_t clear, uint16_t kind,
                        const struct smear_sun *sun);
void smear_damage_add(struct smear_damage *d, const smear_draw *draw);
void smear_damage_find(struct smear_damage *d, const struct smear_rows *rows, bool refresh);

/* Compares draw `i`; true where it changed, or something that all draws share. */
bool smear_damage_compare(struct smear_damage *d, const smear_draw *draw, uint32_t i);

/* It is seen in other tiles than in the last frame: these and those are damaged. */
void smear_damage_move(struct smear_damage *d, uint32_t i, const struct smear_tile_box *box, uint8_t age);

/* Draws from `first` on, which the last frame had and this one has not, are seen nowhere. */
void smear_damage_drop(struct smear_damage *d, uint32_t first, const smear_desc *desc);

/* Has tiles drawn over which something else lies than in the last frame. */
void smear_damage_find_overlay(struct smear_damage *d, const struct smear_rows *rows);

/* Ends a frame: all rows have been drawn or kept. `disturbed`: triangles that move by less than a step of their vertices were drawn
 * among what is static. */
void smear_damage_end(struct smear_damage *d, struct smear_rows *rows, bool disturbed);

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
