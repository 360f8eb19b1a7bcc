/* SPDX-License-Identifier: MIT */
/* places8.h - the places of eight vertices at once, by AVX2, as places.h has them of four. */
#ifndef SMEAR_KERNELS_PLACES8_H
#define SMEAR_KERNELS_PLACES8_H

#include "kernels/lanes8.h"
#include "kernels/places.h"

#if SMEAR_AVX2

/* A setup as vectors: pairs of factors as struct place_row has them. */
struct place_row8 {
    lanes8 high_xy, high_z, low_xy, low_z, offset;
};

struct place_rows8 {
    struct place_row8 row[3];
    const struct place_setup *s;
};

SMEAR_AVX2_INLINE lanes8 place_factors8(int32_t a, int32_t b) { return lanes8_all(((uint32_t)a & 0xffffu) | (uint32_t)b << 16); }

static inline SMEAR_AVX2_FUNCTION void place_rows8_make(struct place_rows8 *rows, const struct place_setup *s)
{
    for (int r = 0; r < 3; r++) {
        const int32_t *m = s->m[r];
        rows->row[r] = (struct place_row8){ place_factors8(m[0] >> 16, m[1] >> 16), place_factors8(0, m[2] >> 16),
                                            place_factors8((m[0] & 0xffff) >> 2, (m[1] & 0xffff) >> 2),
                                            place_factors8(0, (m[2] & 0xffff) >> 2), lanes8_all((uint32_t)m[3]) };
    }
    rows->s = s;
}

SMEAR_AVX2_INLINE lanes8i place_row8_of(const struct place_row8 *row, lanes8 xy, lanes8 yz)
{
    const lanes8 high = (lanes8)lanes8_dot(xy, row->high_xy) + (lanes8)lanes8_dot(yz, row->high_z);
    const lanes8 low = (lanes8)lanes8_dot(xy, row->low_xy) + (lanes8)lanes8_dot(yz, row->low_z);
    return (lanes8i)(high + (lanes8)((lanes8i)low >> 14) + row->offset);
}

/* Returns a / 2^down, rounded to nearest, for `half` of 2^(down - 1). */
SMEAR_AVX2_INLINE lanes8i place_down8(lanes8i a, lanes8 half, lanes8i down)
{
    return lanes8i_right((lanes8i)((lanes8)a + half), down);
}

/* As place_scaled. */
SMEAR_AVX2_INLINE lanes8i place_scaled8(lanes8i a, lanes8i shift)
{
    const lanes8i down = lanes8i_min(-shift, lanes8i_all(31));
    const lanes8 half = lanes8_left(lanes8_all(1), down - 1);
    const lanes8i most = (lanes8i)lanes8_right(lanes8_all(INT32_MAX), shift), up = lanes8i_left(lanes8i_min(a, most), shift);
    return lanes8i_choose(shift >> 31, place_down8(a, half, down), up);
}

/* Spreads eight vertices: pairs (x, y) and (y, z). */
SMEAR_AVX2_INLINE void place_vertices8(lanes8 *xy, lanes8 *yz, const int16_t v[24])
{
    const __m256i a = (__m256i)lanes8i_load_two(v, v + 12), b = (__m256i)lanes8i_load_two(v + 4, v + 16);
    /* Vertices lie at bytes 0, 6 and 12 of a; the third and the fourth also at 4 and 10 of b. */
    const __m256i xy_a = _mm256_broadcastsi128_si256(_mm_setr_epi8(0, 1, 2, 3, 6, 7, 8, 9, 12, 13, 14, 15, -1, -1, -1, -1));
    const __m256i xy_b = _mm256_broadcastsi128_si256(_mm_setr_epi8(-1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, 10, 11, 12, 13));
    const __m256i yz_a = _mm256_broadcastsi128_si256(_mm_setr_epi8(2, 3, 4, 5, 8, 9, 10, 11, -1, -1, -1, -1, -1, -1, -1, -1));
    const __m256i yz_b = _mm256_broadcastsi128_si256(_mm_setr_epi8(-1, -1, -1, -1, -1, -1, -1, -1, 6, 7, 8, 9, 12, 13, 14, 15));
    *xy = (lanes8)_mm256_or_si256(_mm256_shuffle_epi8(a, xy_a), _mm256_shuffle_epi8(b, xy_b));
    *yz = (lanes8)_mm256_or_si256(_mm256_shuffle_epi8(a, yz_a), _mm256_shuffle_epi8(b, yz_b));
}

/* Finds the places of eight vertices as places_fn does of four. Returns for which of them: bit k stands for the k-th; others
 * take more than what most of them take, and theirs are undefined. w of any lengths may stand side by side. In scene A of
 * the peers it takes 20 instructions a vertex where places_vector takes 60. */
static inline SMEAR_AVX2_FUNCTION uint32_t places_avx2(struct smear_place out[8], const int16_t v[24], const struct place_rows8 *rows)
{
    const struct place_setup *s = rows->s;
    lanes8 xy, yz;
    place_vertices8(&xy, &yz, v);
    const lanes8i w = place_row8_of(&rows->row[2], xy, yz), zeros = lanes8i_zeros(w);
    const lanes8i down = 21 - zeros, shift = zeros + s->depth_shift;
    const lanes8i left_out = (w < s->near_distance) | (w > s->far_distance) | (down < 1) | (shift > (int32_t)PLACES_UP_MOST);
    const uint32_t found = lanes8i_signs(left_out) ^ 255u;
    const lanes8i r = (lanes8i)lanes8_recip_norm(lanes8_left((lanes8)w, zeros));
    const lanes8 half = lanes8_left(lanes8_all(1), down - 1);
    const lanes8 x = (uint32_t)s->x + (lanes8)place_down8(lanes8i_mulh(place_row8_of(&rows->row[0], xy, yz), r), half, down);
    const lanes8 y = (uint32_t)s->y + (lanes8)place_down8(lanes8i_mulh(place_row8_of(&rows->row[1], xy, yz), r), half, down);
    lanes8i depth = place_scaled8(lanes8i_mulh(lanes8i_all(s->depth_mantissa), r), shift);
    depth = lanes8i_max(lanes8i_min(depth, lanes8i_all(s->depth_most)), lanes8i_all(s->depth_least));
    const __m256i packed = _mm256_packs_epi32((__m256i)((lanes8i)(x + 127u) >> 8), (__m256i)((lanes8i)(y + 127u) >> 8));
    const lanes8i first = (lanes8i)_mm256_unpacklo_epi16(packed, _mm256_bsrli_epi128(packed, 8));
    lanes8_store_columns(out, (lanes8i)x, (lanes8i)y, depth, first);
    return found;
}
#endif

#endif
