/* SPDX-License-Identifier: MIT */
/* points.h - tiny triangles as the pixels they cover: their edge functions, which are the weights of the corners there,
 * become depth codes. Eight at once, for machines of which AVX2 makes that worth it (eights.h). */
#ifndef SMEAR_KERNELS_POINTS_H
#define SMEAR_KERNELS_POINTS_H

#include "base/fixmath.h"
#include "kernels/triangles.h"

/* What turns edge functions into weights. */
struct tiny_scale {
    uint32_t recip;             /* q16 of 1 / normalised area, rounded down */
    int up;
};

static inline struct tiny_scale tiny_scale_make(int32_t area)
{
    int up = count_leading_zeros((uint32_t)area);
    return (struct tiny_scale){ (recip_norm((uint32_t)area << up) >> 14) - 1u, up };
}

/* Returns e / area in q16, rounded down by up to 2^-14: three weights that add up to one are never negative, so
 * what they weigh stays between its vertices. */
static inline uint32_t tiny_weight(struct tiny_scale s, int32_t e)
{
    return ((uint32_t)e << s.up >> 16) * s.recip >> 15;
}

/* Returns floor(a w / 2^16) for a weight below one. */
static inline int32_t tiny_times(int32_t a, uint32_t w)
{
#if SMEAR_HAS_MUL64
    return (int32_t)((int64_t)a * (int64_t)w >> 16);
#else
    return (a >> 16) * (int32_t)w + (int32_t)(((uint32_t)a & 0xffffu) * w >> 16);
#endif
}

/* Returns the nearest depth code (smear_depth_units) of units q11. */
static inline uint32_t tiny_code(int32_t units)
{
    return units < 32768 << 11 ? (uint32_t)(units + 0x400) >> 11
                               : ((uint32_t)units + ((32768u - 2048u) << 15) + 0x4000u) >> 15;
}

/* Returns the nearest depth code (smear_depth_units) at weights w1 and w2, from units q11. */
static inline uint32_t tiny_depth(int32_t q0, int32_t q1, int32_t q2, uint32_t w1, uint32_t w2)
{
    return tiny_code(q0 + tiny_times(q1 - q0, w1) + tiny_times(q2 - q0, w2));
}

/* Whether depths differ so little that colours may be mixed on the screen: off by at most 1/128 of their range. */
static inline bool tiny_is_even(int32_t q0, int32_t q1, int32_t q2)
{
    int32_t low = min_i32(q0, min_i32(q1, q2)), high = max_i32(q0, max_i32(q1, q2));
    return high - low <= low >> 5;
}

/* Eight triangles, as struct smear_triangles has four of them, and the depths of their corners. */
struct smear_eight {
    uint32_t seen, far, tiny, back;
    int32_t area[8];
    uint32_t low[8], high[8], edge1[8], edge2[8];
    int32_t e1[8], e2[8];
    uint32_t covered[8];
    int32_t depth[3][8];                /* units q11, in the order that is clockwise on the screen */
};

/* Does for eight triangles what triangles_fn does for four. `setup.both_sides` and all else is the same. */
typedef void eight_fn(struct smear_eight *out, const struct smear_place *place, const uint16_t index[24],
                      const struct triangles_setup *s);

/* Pixels of tiny triangles that cover one or two centres. */
struct smear_points {
    uint32_t first, second;             /* bit k: triangle k has that pixel; elements of others are undefined */
    uint32_t row[2][8];                 /* the tile row it is in */
    uint32_t entry[2][8][4];            /* x and y in halves; depth code, below 0xffff; 0; the triangle's colour */
    uint32_t w1[2][8], w2[2][8];        /* weights q16 of the second and the third corner */
};

struct points_setup {
    uint32_t row_recip;                 /* 2^22 / rows of a tile row, rounded up; rows of the frame are below 2048 */
    bool even;                          /* only triangles whose depths are even (tiny_is_even) */
};

/* Finds the pixels of those of eight triangles that are seen, tiny, and cover no more than two centres. */
typedef void points_fn(struct smear_points *out, const struct smear_eight *t, const uint32_t color[8],
                       const struct points_setup *s);

static inline void eight_take(struct smear_eight *out, int k, const struct smear_triangles *four, const int32_t depth[3])
{
    const int from = k & 3;
    const bool back = (four->back >> from & 1u) != 0;
    out->seen |= (four->seen >> from & 1u) << k;
    out->far |= (four->far >> from & 1u) << k;
    out->tiny |= (four->tiny >> from & 1u) << k;
    out->back |= (uint32_t)back << k;
    out->area[k] = four->area[from];
    out->low[k] = four->low[from];
    out->high[k] = four->high[from];
    out->edge1[k] = four->edge1[from];
    out->edge2[k] = four->edge2[from];
    out->e1[k] = four->e1[from];
    out->e2[k] = four->e2[from];
    out->covered[k] = four->covered[from];
    out->depth[0][k] = depth[0];
    out->depth[1][k] = depth[back ? 2 : 1];
    out->depth[2][k] = depth[back ? 1 : 2];
}

static inline void eight_reference(struct smear_eight *out, const struct smear_place *place, const uint16_t index[24],
                                   const struct triangles_setup *s)
{
    struct smear_triangles four = { .seen = 0 };
    out->seen = out->far = out->tiny = out->back = 0;
    for (int k = 0; k < 8; k++) {
        const uint16_t *i = index + 3 * k;
        if ((k & 3) == 0)
            triangles_reference(&four, place, i, s);
        const int32_t depth[3] = { place[i[0]].screen.depth, place[i[s->second]].screen.depth, place[i[s->third]].screen.depth };
        eight_take(out, k, &four, depth);
    }
}

/* Makes a pixel of triangle k of the centre that bit i of `covered` stands for. */
static inline void point_make(struct smear_points *out, int n, int k, const struct smear_eight *t, int i, uint32_t color,
                              uint32_t row_recip)
{
    const struct tiny_scale scale = tiny_scale_make(t->area[k]);
    const int32_t right = (i & 1) * 256, down = (i >> 1) * 256;
    const uint32_t w1 = tiny_weight(scale, t->e1[k] + right * pair_y(t->edge2[k]) - down * pair_x(t->edge2[k]));
    const uint32_t w2 = tiny_weight(scale, t->e2[k] - right * pair_y(t->edge1[k]) + down * pair_x(t->edge1[k]));
    const int32_t x = pair_x(t->low[k]) + (i & 1), y = pair_y(t->low[k]) + (i >> 1);
    out->row[n][k] = (uint32_t)y * row_recip >> 22;
    out->entry[n][k][0] = pair_of(x, y);
    out->entry[n][k][1] = tiny_depth(t->depth[0][k], t->depth[1][k], t->depth[2][k], w1, w2) | 0xffff0000u;
    out->entry[n][k][2] = 0;
    out->entry[n][k][3] = color;
    out->w1[n][k] = w1;
    out->w2[n][k] = w2;
}

static inline void points_reference(struct smear_points *out, const struct smear_eight *t, const uint32_t color[8],
                                    const struct points_setup *s)
{
    out->first = out->second = 0;
    for (int k = 0; k < 8; k++) {
        if ((t->seen & t->tiny & 1u << k) == 0 || (0x177fu >> t->covered[k] & 1u) == 0
            || (s->even && !tiny_is_even(t->depth[0][k], t->depth[1][k], t->depth[2][k])))
            continue;
        const uint32_t more = t->covered[k] & (t->covered[k] - 1u);
        out->first |= 1u << k;
        point_make(out, 0, k, t, __builtin_ctz(t->covered[k]), color[k], s->row_recip);
        if (more == 0)
            continue;
        out->second |= 1u << k;
        point_make(out, 1, k, t, __builtin_ctz(more), color[k], s->row_recip);
    }
}

#endif
