/* SPDX-License-Identifier: MIT */
/* texel_places.h - texture coordinates that are exact where blocks of pixels meet, and follow chords or parabolas between. */
#ifndef SMEAR_KERNELS_TEXEL_PLACES_H
#define SMEAR_KERNELS_TEXEL_PLACES_H

#include "base/fixmath.h"
#include "kernels/texel_run.h"

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

/* Turns of v have 24 bits; what u carries and borrows stays in the others, so that within a block of 17
 * pixels it makes no difference whether u and v are stepped together or each alone. */
static inline uint32_t turns_start(uint32_t v) { return (v & ~255u) | 128u; }
static inline uint32_t turns_step(uint32_t dv) { return dv & ~255u; }

/* Where blocks meet: texels q16, or turns 2^(32 - shift). */
struct place {
    int32_t u, v;
    int32_t nearness;       /* relative change of q per pixel, q16 */
};

/* The quotients of u and v by q, q27. `slope`: how q changes per pixel, times 2^7, where `parabolic`. */
SMEAR_INLINE struct place place_divided(int32_t q, int32_t u, int32_t v, int32_t slope, bool parabolic)
{
    struct place p = { 0, 0, 0 };
    uint32_t d = (uint32_t)max_i32(q, 1 << 11);
    int zeros = count_leading_zeros(d);                     /* at least 1 */
    int32_t r = (int32_t)recip_norm(d << zeros);            /* 1/q = r 2^(zeros - 61) */
    /* |U| <= q (and a step more by rounding), so U 2^(zeros - 2)
     * fits; its quotient is the ratio in q27. */
    p.u = mulh_i32(shl_wrap(u >> 1, zeros - 1), r);
    p.v = mulh_i32(shl_wrap(v >> 1, zeros - 1), r);
    if (parabolic)
        p.nearness = mulh_i32(slope, r) >> (20 - zeros);
    return p;
}

/* Coordinates along a block: those of its first pixel, their steps, and what these lose from pixel to pixel. */
struct texcoord {
    uint32_t u, v, du, dv, curvature_u, curvature_v;
};

/* From one place to another n pixels further on, shifted up.
 *
 * Along a row u'' = -2 u' q'/q: with the chord's step d and b = d q'/q, the parabola from the chord's start
 * to its end has steps from d + b (n - 1) on, each 2 b less. */
SMEAR_INLINE struct texcoord places_between(struct place from, struct place to, int32_t n, int up, bool parabolic, bool turns)
{
    struct texcoord c = { (uint32_t)from.u << up, (uint32_t)from.v << up, 0, 0, 0, 0 };
    int32_t part = inverse_of(n);
#if SMEAR_ASM_ARMV7EM
    SMEAR_KEEP_VALUE(part);             /* else compilers multiply 64 bits by 64 */
#endif
    int32_t du = part_by(sub_wrap(to.u, from.u), part), dv = part_by(sub_wrap(to.v, from.v), part);
    if (parabolic) {
        int32_t rate = (from.nearness + to.nearness + 2) >> 1;      /* q'/q, q16: each was rounded down */
        int32_t bu = mul_wrap(du >> 10, rate) >> 5, bv = mul_wrap(dv >> 10, rate) >> 5;     /* 2 b */
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

/* Along a block: its curvature is what changes lose. */
SMEAR_INLINE void texcoord_run(struct texel_run *r, struct texcoord c)
{
#if TEXELS_PACKED
    r->uv = packed_uv(c.u, c.v);
    r->duv = packed_step(c.du, c.dv);
    r->dduv = 0u - packed_step(c.curvature_u, c.curvature_v);
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

/* A value that is a plane over rows, at + x dx + row dy, modulo 2^32. */
struct texel_plane {
    int32_t at, dx, dy;
};

static inline int32_t texel_plane_at(const struct texel_plane *p, int32_t x, int32_t row)
{
    return add_wrap(p->at, add_wrap(mul_wrap(p->dx, x), mul_wrap(p->dy, row)));
}

/* What places are made of: raster/setup.h, struct texture_setup. */
struct texel_planes {
    struct texel_plane q, u, v;
    int32_t slope;
    int32_t block;              /* pixels: 1, 4, 8, 16, 32 or 64 */
    int up;
    bool divided, parabolic;    /* parabolic only if divided */
};

#endif
