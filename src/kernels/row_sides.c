/* SPDX-License-Identifier: MIT */
/* row_sides.c - see row_sides.h: eight rows at once. */
#include "kernels/row_sides.h"

#include "kernels/edge_lanes.h"

#if SMEAR_AVX2

/* Stores eight sides, each of which has an element of every vector. */
SMEAR_AVX2_INLINE void store_sides(struct span_side *side, __m256i left, __m256i right, __m256i edge)
{
    /* Elements where they are to be in one of three vectors. */
    const __m256i l = _mm256_permutevar8x32_epi32(left, _mm256_setr_epi32(0, 3, 6, 1, 4, 7, 2, 5));
    const __m256i r = _mm256_permutevar8x32_epi32(right, _mm256_setr_epi32(5, 0, 3, 6, 1, 4, 7, 2));
    const __m256i e = _mm256_permutevar8x32_epi32(edge, _mm256_setr_epi32(2, 5, 0, 3, 6, 1, 4, 7));
    __m256i *const out = (__m256i *)(void *)side;
    _mm256_storeu_si256(out, _mm256_blend_epi32(_mm256_blend_epi32(l, r, 0x92), e, 0x24));
    _mm256_storeu_si256(out + 1, _mm256_blend_epi32(_mm256_blend_epi32(l, r, 0x24), e, 0x49));
    _mm256_storeu_si256(out + 2, _mm256_blend_epi32(_mm256_blend_epi32(l, r, 0x49), e, 0x92));
}

SMEAR_AVX2_FUNCTION void smear_row_sides_avx2(struct span_side *side, const struct corners *c, int32_t y, int32_t n, int32_t width)
{
    int32_t left[ROW_SIDES + 16], right[ROW_SIDES + 16];
    const __m256i zero = _mm256_setzero_si256(), most = _mm256_set1_epi32(width);
    corners_sides(left, right, c, y, n);
    for (int32_t i = 0; i < n; i += 8) {
        const __m256i edge = (__m256i)lanes8i_load(right + i);
        store_sides(side + i, _mm256_max_epi32((__m256i)lanes8i_load(left + i), zero), _mm256_min_epi32(edge, most), edge);
    }
}
#endif
