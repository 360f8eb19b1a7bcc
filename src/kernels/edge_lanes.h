/* SPDX-License-Identifier: MIT */
/* edge_lanes.h - where a triangle's edges lie in eight rows of pixels at once (edge_walk.h). */
#ifndef SMEAR_KERNELS_EDGE_LANES_H
#define SMEAR_KERNELS_EDGE_LANES_H

#include "kernels/corners.h"
#include "kernels/edge_walk.h"
#include "kernels/lanes8.h"

#if SMEAR_AVX2

/* Pixels of the edge from a to b in n rows from y on; a multiple of eight is stored. */
SMEAR_AVX2_INLINE void edge_lanes(int32_t *out, const int32_t *a, const int32_t *b, int32_t y, int32_t n)
{
    struct edge_walk e;
    edge_start(&e, a, b, y);
    /* Rows 0 1 4 5 and 2 3 6 7: their upper halves are in order, then. */
    const __m128i step = _mm_cvtsi64_si128((int64_t)e.step), step1 = _mm_slli_si128(step, 8);
    const __m256i step4 = _mm256_slli_epi64(_mm256_broadcastq_epi64(step), 2);
    __m256i first = _mm256_add_epi64(_mm256_set1_epi64x((int64_t)e.x), _mm256_broadcastsi128_si256(step1));
    first = _mm256_add_epi64(first, _mm256_blend_epi32(_mm256_setzero_si256(), step4, 0xf0));
    __m256i second = _mm256_add_epi64(first, _mm256_slli_epi64(_mm256_broadcastq_epi64(step), 1));
    for (;; out += 8) {
        const __m256 high = _mm256_shuffle_ps(_mm256_castsi256_ps(first), _mm256_castsi256_ps(second), 0xdd);
        lanes8i_store(out, (lanes8i)_mm256_castps_si256(high) >> 10);
        n -= 8;
        if (n <= 0)
            return;
        first = _mm256_add_epi64(first, _mm256_slli_epi64(step4, 1));
        second = _mm256_add_epi64(second, _mm256_slli_epi64(step4, 1));
    }
}

/* Where n rows from y on begin and end, of those that are drawn; up to fourteen more are stored. */
SMEAR_AVX2_INLINE void corners_sides(int32_t *left, int32_t *right, const struct corners *c, int32_t y, int32_t n)
{
    int32_t *const whole = c->whole_is_left ? left : right, *const part = c->whole_is_left ? right : left;
    const int32_t upper = min_i32(c->knee - y, n);
    edge_lanes(whole, c->top, c->bottom, y, n);
    if (upper > 0)
        edge_lanes(part, c->top, c->middle, y, upper);
    if (upper <= 0)
        edge_lanes(part, c->middle, c->bottom, y, n);
    else if (upper < n)
        edge_lanes(part + upper, c->middle, c->bottom, c->knee, n - upper);
}
#endif

#endif
