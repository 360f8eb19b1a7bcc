/* SPDX-License-Identifier: MIT */
/* place_list.h - places where blocks of many rows of a triangle begin and end, found eight at once whichever rows they lie in. */
#ifndef SMEAR_KERNELS_PLACE_LIST_H
#define SMEAR_KERNELS_PLACE_LIST_H

#include "kernels/place_lanes.h"

#if SMEAR_AVX2

/* Where the first block of a span begins, and where it and others end: so many places of the list from number `at` on. */
struct listed_run {
    int32_t span, at, count;
};

/* Place i is element PLACES_BEFORE + i. */
struct place_list {
    int32_t count, runs;
    int32_t x[PLACES_ALL], row[PLACES_ALL];
    struct listed_run run[PLACES_LISTED];
};

SMEAR_AVX2_INLINE void list_start(struct place_list *l) { l->count = l->runs = 0; }

/* Adds the ends of blocks of a span from x on, up to that in which its last pixel lies, or as many as there is room for: returns
 * false, then, and x is where the last one ends. */
SMEAR_AVX2_INLINE bool list_blocks(struct place_list *l, const struct texel_spans *s, int32_t span, int32_t block, int32_t *x)
{
    const int32_t last = s->right[span] - 1, behind = min_i32(s->b[span], last), row = s->row[span], at = l->count;
    int32_t i = at, end = *x;
    for (; i < PLACES_LISTED; i++) {
        l->x[PLACES_BEFORE + i] = end;
        l->row[PLACES_BEFORE + i] = row;
        if (end >= behind)
            break;
        *x = end;
        end += block_next(block, last - end);
    }
    const bool done = i < PLACES_LISTED;
    l->count = i + done;
    if (l->count > at)
        l->run[l->runs++] = (struct listed_run){ span, at, l->count - at };
    return done;
}

/* The blocks that end in all places; those where runs begin are of no use. */
SMEAR_AVX2_INLINE void list_between(struct block_lanes *c, struct place_list *l, const struct texel_lanes *k,
                                    const struct planes_lanes *planes, enum look look)
{
    const __m256i zero = _mm256_setzero_si256(), most = _mm256_set1_epi32(BLOCK_LONGEST);
    struct place_lanes before = { zero, zero, zero };
    __m256i end = zero;
    lanes8i_store(l->x + PLACES_BEFORE + l->count, (lanes8i)zero);      /* the last eight may reach beyond the last place */
    lanes8i_store(l->row + PLACES_BEFORE + l->count, (lanes8i)zero);
    for (int32_t i = PLACES_BEFORE; i < PLACES_BEFORE + l->count; i += 8) {
        const __m256i x = (__m256i)lanes8i_load(l->x + i), from = lanes_before(end, x);
        const struct place_lanes places = places_of(k, planes, x, (__m256i)lanes8i_load(l->row + i), look);
        blocks_make(c, i, planes, _mm256_min_epu32(_mm256_sub_epi32(x, from), most), before, places, look);
        before = places;
        end = x;
    }
}
#endif

#endif
