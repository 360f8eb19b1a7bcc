/* SPDX-License-Identifier: MIT */
/* texture_track.h - along rows of a triangle from block to block: as its setup has it, by functions where registers are few. */
#ifndef SMEAR_TEXTURE_TRACK_H
#define SMEAR_TEXTURE_TRACK_H

#include "kernels/texel_track.h"
#include "raster/texcoord.h"
#include "raster/texture_rows.h"

/* On Cortex-M0+ a pointer of its own: members lie too far from the setup's start for its loads. */
static inline const struct texture_setup *texture_of(const struct setup *s)
{
    const struct texture_setup *t = &s->texture;
    if (SMEAR_ON_ARMV6M)
        SMEAR_KEEP_VALUE(t);
    return t;
}

/* Goes on by n pixels, at most a block, where no places are divided. */
TRACK_GO void track_go(struct texel_track *k, const struct texture_setup *t, int32_t n)
{
    const struct place from = k->place;
    k->u = add_wrap(k->u, mul_wrap(t->uv[0].dx, n));
    k->v = add_wrap(k->v, mul_wrap(t->uv[1].dx, n));
    k->place = (struct place){ k->u, k->v, 0 };
    texcoord_run(&k->run, texcoord_between(t, from, k->place, n, true));
}

/* Finds the coordinates of the next n pixels. */
TRACK_NEXT void track_next(struct texel_track *k, const struct texture_setup *t, int32_t n)
{
    if (t->mode == TEXTURE_DIVIDED)
        texel_track_part(k, n);
    else
        track_go(k, t, n);
}

/* A whole block where places are quotients, and n of its pixels. */
TRACK_BLOCK void track_block(struct texel_track *k) { texel_track_next(k); }
TRACK_BLOCK void track_part(struct texel_track *k, int32_t n) { texel_track_part(k, n); }

/* What a triangle's tracks have in common. */
SMEAR_INLINE void track_prepare(struct texel_track *k, const struct texture_setup *t)
{
    texel_track_length(k, 31 - count_leading_zeros(t->block));
    k->dq = shl_wrap(t->q.dx, k->log2);
    k->du = shl_wrap(t->uv[0].dx, k->log2);
    k->dv = shl_wrap(t->uv[1].dx, k->log2);
    k->qx = t->q.dx;
    k->ux = t->uv[0].dx;
    k->vx = t->uv[1].dx;
    k->up = t->up;
    k->slope = t->slope;
    k->seed = smear_recip_seed;
    k->parabolic = t->parabolic;
    texcoord_run(&k->run, (struct texcoord){ 0, 0, 0, 0, 0, 0 });
}

SMEAR_STATIC_ASSERT(offsetof(struct texture_setup, uv) == offsetof(struct texture_setup, q) + 12, "texel_track_start takes nine words");

/* At pixel (x, y). */
TRACK_FUNCTION void track_start(struct texel_track *k, const struct texture_setup *t, int32_t x, int32_t y)
{
    if (TEXEL_TRACK_STARTS && t->mode == TEXTURE_DIVIDED) {
        texel_track_start(k, &t->q.at, x, y);
        return;
    }
    k->q = plane_at(&t->q, x, y);
    k->u = plane_at(&t->uv[0], x, y);
    k->v = plane_at(&t->uv[1], x, y);
    k->place = place_at(t, t->mode, NULL, k->q, k->u, k->v, true);
}

#endif
