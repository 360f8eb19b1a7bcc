/* SPDX-License-Identifier: MIT */
/* tilemax_avx2.c - the tile maximum, eight pixels at once, to the bits of smear_tilemax_reference(). It takes a seventh of
 * the instructions. */
#include "filter/tilemax.h"

#include "kernels/lanes8.h"

#if SMEAR_AVX2

/* Reads eight velocities as pairs of halves. */
SMEAR_AVX2_INLINE __m256i tilemax8_load(const struct smear_window *w, size_t at, bool narrow)
{
    if (narrow)
        return _mm256_cvtepi8_epi16(_mm_loadu_si128((const __m128i *)(const void *)(w->velocity8 + 2 * at)));
    return _mm256_loadu_si256((const __m256i *)(const void *)(w->velocity16 + 2 * at));
}

/* How far velocities lie apart, by each axis. */
SMEAR_AVX2_INLINE __m256i tilemax8_change(__m256i a, __m256i b) { return _mm256_abs_epi16(_mm256_subs_epi16(a, b)); }

struct tilemax8 {
    __m256i low, high, rough;           /* halves */
    lanes8i longest, velocity, place; /* per lane: the longest one's square, itself, its pixel in row order */
};

SMEAR_AVX2_INLINE void tilemax8_rows(struct tilemax8 *m, const struct smear_window *w, int32_t x0, int32_t y0, int32_t y1, int32_t n,
                                     bool narrow)
{
    const __m256i to_right = (__m256i)(lanes8i){ 0, 0, 1, 2, 3, 4, 5, 6 };
    lanes8i place = lanes8i_numbers();
    for (int32_t y = y0; y < y1; y++) {
        const size_t row = (size_t)(window_ring_row(w, y) * w->width + x0);
        const size_t above = (size_t)(window_ring_row(w, max_i32(y - 1, 0)) * w->width + x0);
        for (int32_t x = 0; x < n; x += 8, place += 8) {
            const size_t at = row + (size_t)x;
            const __m256i v = tilemax8_load(w, at, narrow);
            const __m256i before = x0 + x > 0 ? tilemax8_load(w, at - 1, narrow) : _mm256_permutevar8x32_epi32(v, to_right);
            const lanes8i square = lanes8_dot((lanes8)v, (lanes8)v), longer = square > m->longest;
            m->longest = lanes8i_max(m->longest, square);
            m->velocity = lanes8i_choose(longer, (lanes8i)v, m->velocity);
            m->place = lanes8i_choose(longer, place, m->place);
            m->low = _mm256_min_epi16(m->low, v);
            m->high = _mm256_max_epi16(m->high, v);
            m->rough = _mm256_max_epu16(m->rough, tilemax8_change(v, before));
            m->rough = _mm256_max_epu16(m->rough, tilemax8_change(v, tilemax8_load(w, above + (size_t)x, narrow)));
        }
    }
}

SMEAR_AVX2_FUNCTION
void smear_tilemax_avx2(const struct smear_window *w, int32_t row, int32_t column)
{
    const int32_t x0 = column << w->tile_shift, n = min_i32(w->tile, w->width - x0);
    const int32_t y0 = row << w->tile_shift, y1 = min_i32(y0 + w->tile, w->height);
    struct tilemax8 m = { _mm256_set1_epi16(INT16_MAX), _mm256_set1_epi16(INT16_MIN), _mm256_setzero_si256(), lanes8i_all(-1),
                          lanes8i_all(0), lanes8i_all(0) };
    if (w->velocity8 != NULL)
        tilemax8_rows(&m, w, x0, y0, y1, n, true);
    else
        tilemax8_rows(&m, w, x0, y0, y1, n, false);
    int16_t low[16], high[16], velocity[16];
    uint16_t rough[16];
    int32_t longest[8], place[8];
    lanes8_store(low, (lanes8)m.low);
    lanes8_store(high, (lanes8)m.high);
    lanes8_store(rough, (lanes8)m.rough);
    lanes8i_store(velocity, m.velocity);
    lanes8i_store(longest, m.longest);
    lanes8i_store(place, m.place);
    int best = 0;
    int32_t most = max_i32(rough[0], rough[1]);
    for (int i = 1; i < 8; i++) {
        if (longest[i] > longest[best] || (longest[i] == longest[best] && place[i] < place[best]))
            best = i;
        low[0] = (int16_t)min_i32(low[0], low[2 * i]);
        low[1] = (int16_t)min_i32(low[1], low[2 * i + 1]);
        high[0] = (int16_t)max_i32(high[0], high[2 * i]);
        high[1] = (int16_t)max_i32(high[1], high[2 * i + 1]);
        most = max_i32(most, max_i32(rough[2 * i], rough[2 * i + 1]));
    }
    window_motion(w, row)[column] = (struct smear_tile_motion){ velocity[2 * best], velocity[2 * best + 1], low[0], high[0], low[1],
                                                                high[1] };
    window_around(w, row)[column].rough = (uint8_t)min_i32(most, 255);
}

#endif
