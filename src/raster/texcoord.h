/* SPDX-License-Identifier: MIT */
/* texcoord.h - texture coordinates along a row: polynomials, or exact where blocks of pixels meet
 * and chords or parabolas between (setup.h). */
#ifndef SMEAR_TEXCOORD_H
#define SMEAR_TEXCOORD_H

#include "raster/setup.h"

/* Spans of at most this many pixels have a place for each: exact, and no dearer than the ends of a block. */
enum { SHORT_SPAN = 4 };

static const int32_t inverse[COLOR_BLOCK_MAX + 1] = {       /* 2^16 / n */
    0, 65536, 32768, 21845, 16384, 13107, 10923, 9362, 8192, 7282, 6554, 5958, 5461, 5041, 4681, 4369, 4096
};

/* 2^16 / n for what block_next returns. */
static inline int32_t inverse_of(int32_t n)
{
    return n <= COLOR_BLOCK_MAX ? inverse[n] : n == BLOCK_LONG ? 65536 / BLOCK_LONG : 65536 / BLOCK_LONGEST;
}

/* a part / 2^16. */
static inline int32_t part_by(int32_t a, int32_t part)
{
#if SMEAR_HAS_MUL64
    return (int32_t)((int64_t)a * part >> 16);
#else
    return (a >> 16) * part + (int32_t)(((uint32_t)a & 0xffffu) * (uint32_t)part >> 16);
#endif
}

/* a / n for n up to 16, good to 2^-16 of it; exact where n is a power of two. */
static inline int32_t part_of(int32_t a, int32_t n) { return part_by(a, inverse[n]); }

/* Where blocks meet: texels q16, or turns 2^(32 - shift). */
struct place {
    int32_t u, v;
    int32_t nearness;       /* relative change of q per pixel, q16 */
};

/* Coordinates from planes. Slivers, whose planes are anything, give anything: it wraps. */
SMEAR_INLINE struct place place_at(const struct texture_setup *t, enum texture_mode mode,
                                   const struct smear_sampler *m, int32_t q, int32_t u, int32_t v, bool turns)
{
    struct place p = { u, v, 0 };
    if (mode == TEXTURE_DIVIDED) {
        uint32_t d = (uint32_t)max_i32(q, 1 << 11);
        int zeros = count_leading_zeros(d);                     /* at least 1 */
        int32_t r = (int32_t)recip_norm(d << zeros);            /* 1/q = r 2^(zeros - 61) */
        /* |U| <= q (and a step more by rounding), so U 2^(zeros - 2)
         * fits; its quotient is the ratio in q27. */
        p.u = mulh_i32(shl_wrap(u >> 1, zeros - 1), r);
        p.v = mulh_i32(shl_wrap(v >> 1, zeros - 1), r);
        if (!turns) {
            p.u = smear_sampler_texel(m, 0, shl_wrap(p.u, 2));
            p.v = smear_sampler_texel(m, 1, shl_wrap(p.v, 2));
        }
        if (t->parabolic)
            p.nearness = mulh_i32(t->slope, r) >> (20 - zeros);
    }
    return p;
}

/* Coordinates along a block: those of its first pixel, their steps, and what these lose from pixel to pixel. */
struct texcoord {
    uint32_t u, v, du, dv, curvature_u, curvature_v;
};

/* From one place to another n pixels further on.
 *
 * Along a row u'' = -2 u' q'/q: with the chord's step d and b = d q'/q, the parabola from the chord's start
 * to its end has steps from d + b (n - 1) on, each 2 b less. */
SMEAR_INLINE struct texcoord texcoord_between(const struct texture_setup *t, struct place from, struct place to,
                                              int32_t n, bool turns)
{
    const int up = t->up;
    struct texcoord c = { (uint32_t)from.u << up, (uint32_t)from.v << up, 0, 0, 0, 0 };
    const int32_t part = inverse_of(n);
    int32_t du = part_by(sub_wrap(to.u, from.u), part), dv = part_by(sub_wrap(to.v, from.v), part);
    if (t->parabolic) {
        int32_t rate = (from.nearness + to.nearness) >> 1;                                  /* q'/q, q16 */
        int32_t bu = mul_wrap(du >> 13, rate) >> 2, bv = mul_wrap(dv >> 13, rate) >> 2;     /* 2 b */
        du = add_wrap(du, mul_wrap(bu, n - 1) >> 1);
        dv = add_wrap(dv, mul_wrap(bv, n - 1) >> 1);
        c.curvature_u = (uint32_t)bu << up;
        c.curvature_v = (uint32_t)bv << up;
    }
    c.du = (uint32_t)du << up;
    c.dv = (uint32_t)dv << up;
    if (turns) {
        c.v = turns_start(c.v);
        c.dv = turns_step(c.dv);
        c.curvature_v = turns_step(c.curvature_v);
    }
    return c;
}

/* Where polynomials hold: from pixel (x, y) on. */
static inline struct texcoord texcoord_curved(const struct texture_setup *t, const struct smear_sampler *m,
                                              int32_t x, int32_t y)
{
    uint32_t word[2][3];
    x -= t->x0;
    y -= t->y0;
    for (int i = 0; i < 2; i++) {
        const struct curve *c = &t->curve[i];
        int32_t dx = add_wrap(c->dx, mul_wrap(c->dxy, y)), along = mul_wrap(c->dxx, x);
        int32_t at = add_wrap(c->at, mul_wrap(add_wrap(c->dy, mul_wrap(c->dyy, y)), y));
        int32_t value[3] = { add_wrap(at, mul_wrap(add_wrap(dx, along), x)),
                             add_wrap(dx, mul_wrap(c->dxx, 2 * x + 1)), mul_wrap(c->dxx, -2) };
        for (int k = 0; k < 3; k++)
            word[i][k] = (uint32_t)(t->turns ? value[k] : smear_sampler_texel(m, i, value[k]));
    }
    return (struct texcoord){ word[0][0], word[1][0], word[0][1], word[1][1], word[0][2], word[1][2] };
}

/* Value of a channel whose plane is value / w, q16. */
static inline int32_t channel_over_w(int32_t over_w, int zeros, int32_t r)
{
    return clamp_i32(mulh_i32(shl_wrap(over_w >> 1, zeros - 1), r) >> 3, 0, 0xffffff);
}

SMEAR_INLINE struct smear_texture_run texcoord_packed(struct texcoord c)
{
    return (struct smear_texture_run){ packed_uv(c.u, c.v), packed_step(c.du, c.dv),
                                       0u - packed_step(c.curvature_u, c.curvature_v) };
}

/* Along a block: its curvature is what changes lose. */
SMEAR_INLINE void texcoord_run(struct texel_run *r, struct texcoord c)
{
#if TEXELS_PACKED
    const struct smear_texture_run run = texcoord_packed(c);
    r->uv = run.at;
    r->duv = run.step;
    r->dduv = run.curvature;
#else
    r->u = c.u;
    r->v = c.v;
    r->du = c.du;
    r->dv = c.dv;
    r->ddu = 0u - c.curvature_u;
    r->ddv = 0u - c.curvature_v;
#endif
}

/* Where the block begins in which pixel a is drawn, of a span from `left` to `last`. */
static inline int32_t block_start(int32_t left, int32_t last, int32_t a, int32_t block)
{
    return left + (max_i32(min_i32(a, last - 1) - left, 0) & -block);
}

/* The pixels of a row's next block, where the row's last pixel comes after `rest` more. What is left of a long block is shared
 * out in parts of which the inverse is known. */
static inline int32_t block_next(int32_t block, int32_t rest)
{
    if (rest >= block)
        return block;
    return rest >= BLOCK_LONG ? BLOCK_LONG : min_i32(rest, COLOR_BLOCK_MAX);
}

/* In blocks of so many pixels: of a span that is short, single ones,
 * which cost less but where polynomials hold. */
static inline int32_t block_of(const struct texture_setup *t, int32_t left, int32_t right)
{
    return right - left <= SHORT_SPAN && t->mode != TEXTURE_CURVED ? 1 : t->block;
}

#endif
