/* SPDX-License-Identifier: MIT */
/* edge_lanes.h - where a triangle's edge lies in eight rows of pixels at once (edge_walk.h). */
#ifndef SMEAR_KERNELS_EDGE_LANES_H
#define SMEAR_KERNELS_EDGE_LANES_H

#include "kernels/lanes8.h"

#if SMEAR_AVX2

/* Its places in rows 0 1 4 5 and 2 3 6 7 of eight: their upper halves are in order, then. */
struct edge_lanes {
    __m256i first, second, step;    /* step: of eight rows */
};

/* x: its place in the first row, px q42, as in struct edge_walk. */
SMEAR_AVX2_INLINE struct edge_lanes edge_lanes_start(uint64_t x, uint64_t step)
{
    static const int64_t odd[4] = { 0, -1, 0, -1 }, last[4] = { 0, 0, -1, -1 };
    const __m256i along = _mm256_set1_epi64x((int64_t)step), some = _mm256_loadu_si256((const __m256i *)(const void *)odd);
    const __m256i rest = _mm256_loadu_si256((const __m256i *)(const void *)last);
    const __m256i apart = _mm256_add_epi64(_mm256_and_si256(along, some), _mm256_and_si256(_mm256_slli_epi64(along, 2), rest));
    const __m256i first = _mm256_add_epi64(_mm256_set1_epi64x((int64_t)x), apart);
    return (struct edge_lanes){ first, _mm256_add_epi64(first, _mm256_slli_epi64(along, 1)), _mm256_slli_epi64(along, 3) };
}

/* The pixels of eight rows. */
SMEAR_AVX2_INLINE lanes8i edge_lanes_pixels(const struct edge_lanes *e)
{
    const __m256 high = _mm256_shuffle_ps(_mm256_castsi256_ps(e->first), _mm256_castsi256_ps(e->second), 0xdd);
    return (lanes8i)_mm256_castps_si256(high) >> 10;
}

SMEAR_AVX2_INLINE void edge_lanes_next(struct edge_lanes *e)
{
    e->first = _mm256_add_epi64(e->first, e->step);
    e->second = _mm256_add_epi64(e->second, e->step);
}
#endif

#endif
