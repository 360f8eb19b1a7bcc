/* SPDX-License-Identifier: MIT */
/* tilemax_avx2.c - the tile maximum, eight pixels at once, and the neighbour maximum, eight tiles at once, to the bits of
 * tilemax.c. They take a seventh of the instructions. */
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

/* ------------------------------------------------------------------ neighbours */

/* Motions of eight tiles: the longest, and their lowest and highest component along x and y; pairs of halves. */
struct motions8 {
    lanes8 longest, x, y;
};

SMEAR_AVX2_INLINE struct motions8 motions8_load(const struct smear_tile_motion *motion, lanes8i column)
{
    const char *const words = (const char *)motion;         /* three each */
    const lanes8i at = column + column + column;
    return (struct motions8){ lanes8_gather(words, at), lanes8_gather(words + 4, at), lanes8_gather(words + 8, at) };
}

/* What is known of the neighbourhoods of eight tiles. */
struct neighbors8 {
    struct motions8 own;
    lanes8 square, longest;             /* the winner's, which is 1.01^2 times as long where it is the tile itself */
    lanes8i scale;                      /* of the winner */
    lanes8 low_x, high_x, low_y, high_y;        /* of all: lowest of the lower halves, highest of the upper ones */
    /* The largest step of velocity within a tile or from it to the own range, as halves: of those above and below it, beside it,
     * at its corners and of the tile itself. */
    lanes8 upright, sideways, diagonal, here;
};

/* How far ranges of velocities lie apart, as halves: to one side, to the other. */
SMEAR_AVX2_INLINE lanes8 gap8(lanes8 a, lanes8 b)
{
    const lanes8 swapped = b << 16 | b >> 16, flip = lanes8_all(0xffff0001u);
    return (lanes8)_mm256_sign_epi16(_mm256_subs_epi16((__m256i)a, (__m256i)swapped), (__m256i)flip);
}

/* Adds the tiles of one row at the columns given; returns their steps. */
SMEAR_AVX2_INLINE lanes8 neighbors8_add(struct neighbors8 *n, const struct smear_tile_motion *motion,
                                        const struct smear_tile_neighborhood *around, lanes8i column, bool is_centre)
{
    const struct motions8 m = motions8_load(motion, column);
    const lanes8 square = (lanes8)lanes8_dot(m.longest, m.longest) * (is_centre ? 10201u : 10000u);
    const lanes8 most = (lanes8)_mm256_max_epu32((__m256i)square, (__m256i)n->square);
    const lanes8i kept = most == n->square;
    n->longest = lanes8_choose(kept, n->longest, m.longest);
    n->scale = lanes8i_choose(kept, n->scale, lanes8i_all(is_centre ? 65536 : 64887));
    n->square = most;
    n->low_x = lanes8i_min16(n->low_x, m.x);
    n->high_x = lanes8i_max16(n->high_x, m.x);
    n->low_y = lanes8i_min16(n->low_y, m.y);
    n->high_y = lanes8i_max16(n->high_y, m.y);
    /* The upper byte of a word that ends with the record. */
    const lanes8 rough = lanes8_gather_upper((const char *)around + 4, column + column + column) >> 24;
    const lanes8i still = (m.x | m.y) == lanes8_all(0);
    return lanes8i_max16(lanes8_choose(still, lanes8_all(0), rough), lanes8i_max16(gap8(m.x, n->own.x), gap8(m.y, n->own.y)));
}

/* Adds the tiles at the columns and beside them, in their order; beyond the frame the nearest inside stands twice, which changes
 * nothing. */
SMEAR_AVX2_INLINE void neighbors8_row(struct neighbors8 *n, const struct smear_window *w, int32_t row, lanes8i column, bool is_own)
{
    const struct smear_tile_motion *const motion = window_motion(w, row);
    const struct smear_tile_neighborhood *const around = window_around(w, row);
    const lanes8i left = lanes8i_max(column - 1, lanes8i_all(0)), right = lanes8i_min(column + 1, lanes8i_all(w->columns - 1));
    lanes8 *const middle = is_own ? &n->here : &n->upright, *const beside = is_own ? &n->sideways : &n->diagonal;
    *beside = lanes8i_max16(*beside, neighbors8_add(n, motion, around, left, false));
    *middle = lanes8i_max16(*middle, neighbors8_add(n, motion, around, column, is_own));
    *beside = lanes8i_max16(*beside, neighbors8_add(n, motion, around, right, false));
}

SMEAR_AVX2_INLINE lanes8i lanes8_greater_half(lanes8 a) { return lanes8i_max(lanes8_pair_x(a), lanes8_pair_y(a)); }

/* Returns the kinds of tiles: as neighborhood() and is_uniform(). */
SMEAR_AVX2_INLINE lanes8i neighbors8_kind(const struct neighbors8 *n)
{
    const lanes8i low_x = lanes8_pair_x(n->low_x), high_x = lanes8_pair_y(n->high_x);
    const lanes8i low_y = lanes8_pair_x(n->low_y), high_y = lanes8_pair_y(n->high_y);
    const lanes8i far_x = lanes8i_max(high_x, -low_x), far_y = lanes8i_max(high_y, -low_y);
    const lanes8i share = lanes8i_max(far_x, far_y) >> (int32_t)small_share, spread = lanes8i_max(high_x - low_x, high_y - low_y);
    const lanes8 carried_x = (lanes8)(far_x >= (int32_t)small_carry), carried_y = (lanes8)(far_y >= (int32_t)small_carry);
    const lanes8 beside = lanes8i_max16(n->here, n->sideways & carried_x);
    const lanes8 above = lanes8i_max16(n->upright & carried_y, n->diagonal & carried_x & carried_y);
    const lanes8i rough = lanes8_greater_half(lanes8i_max16(beside, above)) > lanes8i_max(share, lanes8i_all(small_step));
    const lanes8i complex = rough & (spread > lanes8i_max(share, lanes8i_all(small_spread)));
    const lanes8i still = (low_x | high_x | low_y | high_y) == lanes8i_all(0);
    return lanes8i_choose(still, lanes8i_all(TILE_STATIC), (int32_t)TILE_UNIFORM - complex);
}

/* Eight tiles from a column on, as far as there are so many. */
static inline SMEAR_AVX2_FUNCTION void neighbormax8(const struct smear_window *w, int32_t row, int32_t known, int32_t first)
{
    const lanes8i column = lanes8i_min(lanes8i_numbers() + first, lanes8i_all(w->columns - 1));
    const lanes8 none = lanes8_all(0);
    struct neighbors8 n = { .own = motions8_load(window_motion(w, row), column), .square = none, .longest = none,
                            .scale = lanes8i_all(0), .upright = none, .sideways = none, .diagonal = none, .here = none };
    n.low_x = n.high_x = n.own.x;
    n.low_y = n.high_y = n.own.y;
    if (row > 0)
        neighbors8_row(&n, w, row - 1, column, false);
    neighbors8_row(&n, w, row, column, true);
    if (row < known)
        neighbors8_row(&n, w, row + 1, column, false);
    int32_t x[8], y[8], kind[8];
    lanes8i_store(x, (lanes8_pair_x(n.longest) * n.scale + 0x400) >> 11);
    lanes8i_store(y, (lanes8_pair_y(n.longest) * n.scale + 0x400) >> 11);
    lanes8i_store(kind, neighbors8_kind(&n));
    struct smear_tile_neighborhood *const out = window_around(w, row) + first;
    for (int32_t i = 0; i < min_i32(w->columns - first, 8); i++) {
        out[i].x = (int16_t)x[i];
        out[i].y = (int16_t)y[i];
        out[i].kind = (uint8_t)kind[i];
    }
}

SMEAR_AVX2_FUNCTION void smear_neighbormax_row_avx2(const struct smear_window *w, int32_t row, int32_t known)
{
    for (int32_t first = 0; first < w->columns; first += 8)
        neighbormax8(w, row, known, first);
}

#endif
