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

/* Rows in which the short side has a bend, where `bent`; else it is `part`. Of the two sides the lesser one is the left one. */
SMEAR_AVX2_INLINE void sides_find(struct span_side *side, int32_t n, int32_t width, const struct edge_walk *whole,
                                  const struct edge_walk *part, const struct edge_walk *below, int32_t upper, bool bent)
{
    struct edge_lanes a = edge_lanes_start(whole->x, whole->step), b = edge_lanes_start(part->x, part->step), c = b;
    const lanes8i zero = lanes8i_all(0), most = lanes8i_all(width);
    lanes8i rest = lanes8i_all(upper) - lanes8i_numbers();
    if (bent)
        c = edge_lanes_start(below->x, below->step);
    for (;; side += 8, rest -= 8) {
        const lanes8i one = edge_lanes_pixels(&a), up = edge_lanes_pixels(&b);
        const lanes8i other = bent ? lanes8i_choose(rest > 0, up, edge_lanes_pixels(&c)) : up;
        const lanes8i edge = lanes8i_max(one, other);
        store_sides(side, (__m256i)lanes8i_max(lanes8i_min(one, other), zero), (__m256i)lanes8i_min(edge, most), (__m256i)edge);
        n -= 8;
        if (n <= 0)
            return;
        edge_lanes_next(&a);
        edge_lanes_next(&b);
        if (bent)
            edge_lanes_next(&c);
    }
}

SMEAR_AVX2_FUNCTION void smear_row_sides_avx2(struct span_side *side, const struct corners *c, int32_t y, int32_t n, int32_t width)
{
    const int32_t upper = c->knee - y;
    struct edge_walk whole, part, below;
    edge_start(&whole, c->top, c->bottom, y);
    if (upper <= 0)
        edge_start(&part, c->middle, c->bottom, y);
    else
        edge_start(&part, c->top, c->middle, y);
    if (upper <= 0 || upper >= n) {
        sides_find(side, n, width, &whole, &part, &part, 0, false);
        return;
    }
    edge_start(&below, c->middle, c->bottom, c->knee);
    below.x -= below.step * (uint32_t)upper;
    sides_find(side, n, width, &whole, &part, &below, upper, true);
}

/* ------------------------------------------------------------------ sides that go on */

/* One from corner a to b, of which some row is given that lies below a. */
SMEAR_AVX2_INLINE void side_carry(struct carried_sides *c, int side, const int32_t *a, const int32_t *b, int32_t row)
{
    struct edge_walk e;
    edge_start(&e, a, b, row);
    c->x[side] = e.x - e.step * (uint64_t)(int64_t)(row - c->y);
    c->step[side] = e.step;
}

SMEAR_AVX2_FUNCTION void smear_sides_carry_avx2(struct carried_sides *c, const int32_t *const corner[3], int32_t y)
{
    struct corners k;
    corners_find(&k, corner, y, INT16_MAX);
    *c = (struct carried_sides){ .y = y };
    c->knee = (k.middle[1] + 127) >> 8;
    side_carry(c, SIDE_LONG, k.top, k.bottom, y);
    if (c->knee > y)
        side_carry(c, SIDE_ABOVE, k.top, k.middle, y);
    if (k.bottom[1] > k.middle[1])
        side_carry(c, SIDE_BELOW, k.middle, k.bottom, max_i32(y, c->knee));
}

SMEAR_AVX2_FUNCTION void smear_row_sides_carried_avx2(struct span_side *side, const struct carried_sides *c, int32_t n, int32_t width)
{
    const int32_t upper = c->knee - c->y;
    const int short_side = upper > 0 ? SIDE_ABOVE : SIDE_BELOW;
    const struct edge_walk whole = { c->x[SIDE_LONG], c->step[SIDE_LONG] }, part = { c->x[short_side], c->step[short_side] };
    if (upper <= 0 || upper >= n) {
        sides_find(side, n, width, &whole, &part, &part, 0, false);
        return;
    }
    const struct edge_walk below = { c->x[SIDE_BELOW], c->step[SIDE_BELOW] };
    sides_find(side, n, width, &whole, &part, &below, upper, true);
}
#endif
