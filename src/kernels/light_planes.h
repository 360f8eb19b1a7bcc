/* SPDX-License-Identifier: MIT */
/* light_planes.h - colours of a triangle's pixels: planes; or planes over w whose quotients are exact where blocks of pixels
 * meet, and follow chords between. */
#ifndef SMEAR_KERNELS_LIGHT_PLANES_H
#define SMEAR_KERNELS_LIGHT_PLANES_H

#include "kernels/lanes8.h"
#include "kernels/texel_places.h"
#include "kernels/texel_spans.h"

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
/* Planes of a triangle, and some blocks of a row: from block number `first` on, eight if they are single pixels, else seven.
 * Short rows share the lanes: four of them, of a block each, or two of three. */
struct light_lanes {
    const struct light_planes *p;
    const struct texel_spans *spans;
    int32_t span, left, last, block, log2_block;
    int32_t from_x, until_x;            /* of pixels in [from_x, until_x) the blocks are known */
    int32_t found, found_end, found_block, found_lanes;     /* spans of which all blocks are known, of as many lanes each */
    __m128i down;                       /* log2_block, as shifts of lanes take it */
    lanes8i left_lanes, most;           /* the last pixel that begins a block, or lies in the last one, less `left` */
    lanes8i first;                      /* of the blocks that are known; lanes are counted from it */
    lanes8i from[3], step[3];
};

struct planes_light {
    lanes8i c[3];
};

/* Begins with no row. */
SMEAR_AVX2_INLINE void light_start(struct light_lanes *k, const struct light_planes *p)
{
    *k = (struct light_lanes){ .p = p };
}

/* Takes the present span's blocks from those that were found. */
SMEAR_AVX2_INLINE void light_take(struct light_lanes *k)
{
    k->first = lanes8i_all(-((k->span - k->found) * k->found_lanes));
    k->from_x = INT32_MIN;
    k->until_x = INT32_MAX;
}

/* Begins the row of span number i; spans come in their order. */
SMEAR_AVX2_INLINE void light_row(struct light_lanes *k, const struct texel_spans *s, int32_t i, int32_t block)
{
    k->spans = s;
    k->span = i;
    k->left = s->left[i];
    k->last = s->right[i] - 1;
    k->block = block;
    k->log2_block = 31 - count_leading_zeros((uint32_t)block);
    k->down = _mm_cvtsi32_si128(k->log2_block);
    k->left_lanes = lanes8i_all(k->left);
    k->most = lanes8i_all(max_i32(k->last - k->left - (block > 1), 0));
    k->until_x = INT32_MIN;
    if (i < k->found_end && block == k->found_block)
        light_take(k);
}

/* How many spans from the present one on have so few blocks that they share the lanes; 1: it has all of them. */
SMEAR_AVX2_INLINE int32_t light_sharers(const struct light_lanes *k)
{
    const struct texel_spans *const s = k->spans;
    const int32_t i = k->span, rest = s->count - i, one = 1 << k->log2_block, three = 3 << k->log2_block;
    if (k->last - k->left > three || rest < 2)
        return 1;
    if (rest >= 4 && k->last - k->left <= one) {
        const __m128i right4 = _mm_loadu_si128((const __m128i *)(const void *)(s->right + i));
        const __m128i width = _mm_sub_epi32(right4, _mm_loadu_si128((const __m128i *)(const void *)(s->left + i)));
        if (_mm_movemask_epi8(_mm_cmpgt_epi32(width, _mm_set1_epi32(one + 1))) == 0)
            return 4;
    }
    return s->right[i + 1] - 1 - s->left[i + 1] <= three ? 2 : 1;
}

/* Numbers of spans that share the lanes, or of one, each in the lanes that it has. */
SMEAR_AVX2_INLINE lanes8i light_shared(const int32_t *numbers, int32_t sharers)
{
    if (sharers == 1)
        return lanes8i_all(numbers[0]);
    if (sharers == 2)
        return lanes8i_of_two(_mm_set1_epi32(numbers[0]), _mm_set1_epi32(numbers[1]));
    const __m256i four = _mm256_cvtepu32_epi64(_mm_loadu_si128((const __m128i *)(const void *)numbers));
    return (lanes8i)_mm256_or_si256(four, _mm256_slli_epi64(four, 32));
}

SMEAR_AVX2_INLINE lanes8i light_plane8(const struct texel_plane *p, lanes8i x, lanes8i row)
{
    return (lanes8i)(lanes8_all((uint32_t)p->at) + lanes8_all((uint32_t)p->dy) * (lanes8)row + lanes8_all((uint32_t)p->dx) * (lanes8)x);
}

/* Channel i at the beginnings of blocks, and its steps: `part` is the inverse of their lengths, the others of q. */
SMEAR_AVX2_INLINE void light_find_channel(struct light_lanes *k, int i, lanes8i x, lanes8i row, lanes8i next, lanes8i zeros,
                                          lanes8i recip, lanes8i part)
{
    const lanes8i over_w = lanes8i_left(light_plane8(&k->p->c[i], x, row) >> 1, zeros - 1);
    const lanes8i from = lanes8i_max(lanes8i_min(lanes8i_mulh(over_w, recip) >> 3, lanes8i_all(0xffffff)), lanes8i_all(0));
    const lanes8i way = lanes8i_permute(from, next) - from;
    const __m256i even = _mm256_mul_epi32((__m256i)way, (__m256i)part);
    const __m256i odd = _mm256_mul_epi32(_mm256_srli_epi64((__m256i)way, 32), _mm256_srli_epi64((__m256i)part, 32));
    k->from[i] = from;
    k->step[i] = (lanes8i)_mm256_blend_epi32(_mm256_srli_epi64(even, 16), _mm256_slli_epi64(odd, 16), 0xaa);
}

/* Finds the blocks from that of pixel x on, and those of spans that share the lanes. */
SMEAR_AVX2_INLINE void light_find(struct light_lanes *k, int32_t at)
{
    const int32_t sharers = light_sharers(k), lanes = 8 / sharers;
    const lanes8i number = lanes8i_numbers(), next = lanes8i_min(number + 1, number | (lanes - 1));
    const lanes8i row = light_shared(k->spans->row + k->span, sharers);
    const lanes8i last = light_shared(k->spans->right + k->span, sharers) - 1;
    lanes8i x = light_shared(k->spans->left + k->span, sharers);
    if (sharers > 1) {
        k->found = k->span;
        k->found_end = k->span + sharers;
        k->found_block = k->block;
        k->found_lanes = lanes;
        light_take(k);
    } else {
        const int32_t first = max_i32(min_i32(at, k->last - (k->block > 1)) - k->left, 0) >> k->log2_block;
        const int32_t start = k->left + (first << k->log2_block), until = start + ((k->block > 1 ? 7 : 8) << k->log2_block);
        k->found_end = 0;               /* blocks of another length may have been found of spans to come */
        k->first = lanes8i_all(first);
        k->from_x = first == 0 ? INT32_MIN : start;
        k->until_x = until >= k->last + (k->block == 1) ? INT32_MAX : until;
        x = lanes8i_all(start);
    }
    x = lanes8i_min(x + ((number & (lanes - 1)) << k->log2_block), last);
    const lanes8i q = lanes8i_max(light_plane8(&k->p->q, x, row), lanes8i_all(1)), zeros = lanes8i_zeros(q);
    const lanes8i recip = (lanes8i)lanes8_recip_norm(lanes8_left((lanes8)q, zeros));
    const lanes8i part = (lanes8i)lanes8_gather(inverse, lanes8i_permute(x, next) - x);
    light_find_channel(k, 0, x, row, next, zeros, recip, part);
    light_find_channel(k, 1, x, row, next, zeros, recip, part);
    light_find_channel(k, 2, x, row, next, zeros, recip, part);
}

SMEAR_AVX2_INLINE lanes8i light_channel8(const struct light_lanes *k, int i, lanes8i at, lanes8i beyond)
{
    return (lanes8i)((lanes8)lanes8i_permute(k->from[i], at) + (lanes8)lanes8i_permute(k->step[i], at) * (lanes8)beyond);
}

/* The colours of eight pixels from x on, whose columns these are; of those beyond the row any numbers. */
SMEAR_AVX2_INLINE struct planes_light planes_light_at(struct light_lanes *k, int32_t x, lanes8i column)
{
    if (x < k->from_x || x + 7 >= k->until_x)
        light_find(k, x);
    const lanes8i along = column - k->left_lanes;
    const lanes8i number = (lanes8i)_mm256_sra_epi32((__m256i)lanes8i_min(along, k->most), k->down);
    const lanes8i beyond = along - (lanes8i)_mm256_sll_epi32((__m256i)number, k->down), at = number - k->first;
    const lanes8i r = light_channel8(k, 0, at, beyond), g = light_channel8(k, 1, at, beyond), b = light_channel8(k, 2, at, beyond);
    return (struct planes_light){ { r, g, b } };
}
#endif

#endif
