/* SPDX-License-Identifier: MIT */
/* light_planes.h - colours of a triangle's pixels: planes; or planes over w whose quotients are exact where blocks of pixels
 * meet, and follow chords between. */
#ifndef SMEAR_KERNELS_LIGHT_PLANES_H
#define SMEAR_KERNELS_LIGHT_PLANES_H

#include "kernels/lanes8.h"
#include "kernels/texel_places.h"

/* Red, green and blue, q16 codes, or linear light with 8 bits more. */
struct light_planes {
    struct texel_plane c[3];
    int32_t block;              /* pixels: 0 where planes are the colours; else 1, 4, 8 or 16: then they are those over w, */
    struct texel_plane q;       /* which is 1 / q */
};

/* The colours over w, exactly. */
static inline void light_over_w(int32_t out[3], const struct light_planes *p, int32_t x, int32_t row)
{
    const uint32_t q = (uint32_t)max_i32(texel_plane_at(&p->q, x, row), 1);
    const int zeros = count_leading_zeros(q);
    const int32_t recip = (int32_t)recip_norm(q << zeros);
    for (int i = 0; i < 3; i++)
        out[i] = clamp_i32(mulh_i32(shl_wrap(texel_plane_at(&p->c[i], x, row) >> 1, zeros - 1), recip) >> 3, 0, 0xffffff);
}

/* The colours of pixel x of a row of pixels [left, right), in blocks of p->block, or `block` of another number. */
static inline void light_planes_at(uint32_t out[3], const struct light_planes *p, int32_t left, int32_t right, int32_t block, int32_t x,
                                   int32_t row)
{
    if (p->block == 0) {
        for (int i = 0; i < 3; i++)
            out[i] = (uint32_t)texel_plane_at(&p->c[i], x, row);
        return;
    }
    const int32_t last = right - 1, start = block == 1 ? x : block_start(left, last, x, block), n = min_i32(block, last - start);
    int32_t from[3], to[3];
    light_over_w(from, p, start, row);
    light_over_w(to, p, start + n, row);
    for (int i = 0; i < 3; i++)
        out[i] = (uint32_t)(from[i] + (n > 0 ? part_by(to[i] - from[i], inverse[n]) * (x - start) : 0));
}

#if SMEAR_AVX2
/* Planes of a triangle, and some blocks of a row: from block number `first` on, eight if they are single pixels, else seven. */
struct light_lanes {
    const struct light_planes *p;
    int32_t left, last, row, block, log2_block;
    int32_t first, from_x, until_x;     /* of pixels in [from_x, until_x) the blocks are known */
    lanes8i most;                       /* the last pixel that begins a block, or lies in the last one, less `left` */
    lanes8i from[3], step[3];
};

struct planes_light {
    lanes8i c[3];
};

/* Begins a row; nothing is found yet. */
SMEAR_AVX2_INLINE void light_row(struct light_lanes *k, int32_t left, int32_t right, int32_t block, int32_t row)
{
    k->left = left;
    k->last = right - 1;
    k->row = row;
    k->block = block;
    k->log2_block = 31 - count_leading_zeros((uint32_t)block);
    k->until_x = INT32_MIN;
    k->most = lanes8i_all(max_i32(right - 1 - left - (block > 1), 0));
}

SMEAR_AVX2_INLINE lanes8i light_plane8(const struct texel_plane *p, lanes8i x, int32_t row)
{
    return (lanes8i)(lanes8_all((uint32_t)p->at + (uint32_t)p->dy * (uint32_t)row) + lanes8_all((uint32_t)p->dx) * (lanes8)x);
}

/* Channel i at the beginnings of blocks, and its steps: `part` is the inverse of their lengths, the others of q. */
SMEAR_AVX2_INLINE void light_find_channel(struct light_lanes *k, int i, lanes8i x, lanes8i next, lanes8i zeros, lanes8i recip,
                                          lanes8i part)
{
    const lanes8i over_w = lanes8i_left(light_plane8(&k->p->c[i], x, k->row) >> 1, zeros - 1);
    const lanes8i from = lanes8i_max(lanes8i_min(lanes8i_mulh(over_w, recip) >> 3, lanes8i_all(0xffffff)), lanes8i_all(0));
    const lanes8i way = lanes8i_permute(from, next) - from;
    const __m256i even = _mm256_mul_epi32((__m256i)way, (__m256i)part);
    const __m256i odd = _mm256_mul_epi32(_mm256_srli_epi64((__m256i)way, 32), _mm256_srli_epi64((__m256i)part, 32));
    k->from[i] = from;
    k->step[i] = (lanes8i)_mm256_blend_epi32(_mm256_srli_epi64(even, 16), _mm256_slli_epi64(odd, 16), 0xaa);
}

/* Finds the blocks from that of pixel x on. */
SMEAR_AVX2_INLINE void light_find(struct light_lanes *k, int32_t at)
{
    const int32_t first = max_i32(min_i32(at, k->last - (k->block > 1)) - k->left, 0) >> k->log2_block;
    const int32_t start = k->left + (first << k->log2_block), until = start + ((k->block > 1 ? 7 : 8) << k->log2_block);
    const lanes8i next = { 1, 2, 3, 4, 5, 6, 7, 7 };
    const lanes8i x = lanes8i_min((lanes8i)lanes8_ramp((uint32_t)start, (uint32_t)k->block, lanes8_numbers()), lanes8i_all(k->last));
    const lanes8i q = lanes8i_max(light_plane8(&k->p->q, x, k->row), lanes8i_all(1)), zeros = lanes8i_zeros(q);
    const lanes8i recip = (lanes8i)lanes8_recip_norm(lanes8_left((lanes8)q, zeros));
    const lanes8i part = (lanes8i)lanes8_gather(inverse, lanes8i_permute(x, next) - x);
    k->first = first;
    k->from_x = first == 0 ? INT32_MIN : start;
    k->until_x = until >= k->last + (k->block == 1) ? INT32_MAX : until;
    light_find_channel(k, 0, x, next, zeros, recip, part);
    light_find_channel(k, 1, x, next, zeros, recip, part);
    light_find_channel(k, 2, x, next, zeros, recip, part);
}

SMEAR_AVX2_INLINE lanes8i light_channel8(const struct light_lanes *k, int i, lanes8i at, lanes8i beyond)
{
    return (lanes8i)((lanes8)lanes8i_permute(k->from[i], at) + (lanes8)lanes8i_permute(k->step[i], at) * (lanes8)beyond);
}

/* The colours of eight pixels from x on; of those beyond the row any numbers. */
SMEAR_AVX2_INLINE struct planes_light planes_light_at(struct light_lanes *k, int32_t x)
{
    if (x < k->from_x || x + 7 >= k->until_x)
        light_find(k, x);
    const lanes8i column = lanes8i_all(x - k->left) + lanes8i_numbers();
    const lanes8i number = lanes8i_min(column, k->most) >> k->log2_block;
    const lanes8i beyond = column - (number << k->log2_block), at = number - k->first;
    const lanes8i r = light_channel8(k, 0, at, beyond), g = light_channel8(k, 1, at, beyond), b = light_channel8(k, 2, at, beyond);
    return (struct planes_light){ { r, g, b } };
}
#endif

#endif
