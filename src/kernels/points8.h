/* SPDX-License-Identifier: MIT */
/* points8.h - eight tiny triangles at once as the one or two pixels they cover, for machines of which AVX2 makes that worth it. */
#ifndef SMEAR_KERNELS_POINTS8_H
#define SMEAR_KERNELS_POINTS8_H

#include "kernels/tiny_weights.h"
#include "kernels/triangles8.h"

/* Pixels of tiny triangles that cover one or two centres. */
struct smear_points8 {
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
typedef void points_fn(struct smear_points8 *out, const struct smear_triangles8 *t, const uint32_t color[8],
                       const struct points_setup *s);

/* Makes a pixel of triangle k of the centre that bit i of `covered` stands for. */
static inline void point_make(struct smear_points8 *out, int n, int k, const struct smear_triangles8 *t, int i, uint32_t color,
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

static inline void points_reference(struct smear_points8 *out, const struct smear_triangles8 *t, const uint32_t color[8],
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

#if SMEAR_AVX2

/* What all pixels of eight triangles are made of. */
struct points8 {
    lanes8i up;                         /* struct tiny_scale */
    lanes8 recip;
    lanes8 q0, q1, q2;                  /* depths, and how the other two differ from the first */
    lanes8 color;
};

/* As tiny_weight. */
SMEAR_AVX2_INLINE lanes8 points8_weight(const struct points8 *p, lanes8 e)
{
    return (lanes8_left(e, p->up) >> 16) * p->recip >> 15;
}

/* As tiny_times. */
SMEAR_AVX2_INLINE lanes8 points8_times(lanes8 a, lanes8 w) { return (lanes8)((lanes8i)a >> 16) * w + ((a & 0xffffu) * w >> 16); }

/* Makes the n-th pixels: `at` is 1 for the one on the right, 2 for the one below, or both. */
static inline SMEAR_AVX2_FUNCTION void points8_make(struct smear_points8 *out, int n, const struct smear_triangles8 *t,
                                                    const struct points8 *p, lanes8 at, const struct points_setup *s)
{
    const lanes8 right = (lanes8)((lanes8i)(at << 31) >> 31), down = (lanes8)((lanes8i)(at << 30) >> 31);
    const lanes8 edge1 = lanes8_load(t->edge1), edge2 = lanes8_load(t->edge2);
    const lanes8 e1 = lanes8_load(t->e1) + (triangles8_y256(edge2) & right) - (triangles8_x256(edge2) & down);
    const lanes8 e2 = lanes8_load(t->e2) - (triangles8_y256(edge1) & right) + (triangles8_x256(edge1) & down);
    const lanes8 w1 = points8_weight(p, e1), w2 = points8_weight(p, e2);
    const lanes8 code = tiny_code8(p->q0 + points8_times(p->q1, w1) + points8_times(p->q2, w2));
    /* Minus one in the half of a column or row that is further on. */
    const lanes8 place = lanes8_sub16(lanes8_load(t->low), (lanes8)_mm256_blend_epi16((__m256i)right, (__m256i)down, 0xaa));
    lanes8_store(out->row[n], (place >> 16) * s->row_recip >> 22);
    lanes8_store(out->w1[n], w1);
    lanes8_store(out->w2[n], w2);
    lanes8_store_columns(out->entry[n], (lanes8i)place, (lanes8i)(code | 0xffff0000u), lanes8i_all(0), (lanes8i)p->color);
}

/* In scene D of the peers it takes 30 instructions a pixel where one after the other they take 130. */
static inline SMEAR_AVX2_FUNCTION void points_avx2(struct smear_points8 *out, const struct smear_triangles8 *t,
                                                   const uint32_t color[8], const struct points_setup *s)
{
    const lanes8 covered = lanes8_load(t->covered);
    const lanes8i q0 = lanes8i_load(t->depth[0]), q1 = lanes8i_load(t->depth[1]), q2 = lanes8i_load(t->depth[2]);
    uint32_t first = t->seen & t->tiny & lanes8i_signs((lanes8i)(lanes8_right(lanes8_all(0x177f), (lanes8i)covered) << 31));
    if (s->even) {
        const lanes8i low = lanes8i_min3(q0, q1, q2);
        first &= ~lanes8i_signs((lanes8i)((lanes8)lanes8i_max3(q0, q1, q2) - (lanes8)low) > low >> 5);
    }
    out->first = first;
    out->second = 0;
    if (first == 0)
        return;
    const lanes8i area = lanes8i_load(t->area), up = lanes8i_zeros(area);
    const lanes8 recip = (lanes8_recip_norm(lanes8_left((lanes8)area, up)) >> 14) - 1u;
    const struct points8 p = { up, recip, (lanes8)q0, (lanes8)q1 - (lanes8)q0, (lanes8)q2 - (lanes8)q0, lanes8_load(color) };
    /* The places of the lowest bit, and of the one after it, for 0 .. 15. */
    const __m256i lowest = _mm256_broadcastsi128_si256(_mm_setr_epi8(0, 0, 1, 0, 2, 0, 1, 0, 3, 0, 1, 0, 2, 0, 1, 0));
    points8_make(out, 0, t, &p, (lanes8)_mm256_shuffle_epi8(lowest, (__m256i)covered), s);
    const lanes8 more = covered & (covered - 1u);
    out->second = first & ~lanes8i_signs((lanes8i)more == 0);
    if (out->second != 0)
        points8_make(out, 1, t, &p, (lanes8)_mm256_shuffle_epi8(lowest, (__m256i)more), s);
}
#endif

#endif
