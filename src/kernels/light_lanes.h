/* SPDX-License-Identifier: MIT */
/* light_lanes.h - what pixels add to sums of light (light_sums.h), in lanes. */
#ifndef SMEAR_KERNELS_LIGHT_LANES_H
#define SMEAR_KERNELS_LIGHT_LANES_H

#include "kernels/lanes8.h"
#include "kernels/light_sums.h"

#if SMEAR_AVX2

SMEAR_AVX2_INLINE lanes8 lanes8_all16(uint32_t a) { return lanes8_all(a * 0x10001u); }

/* The lower half of each word of a, the upper one of b. */
SMEAR_AVX2_INLINE lanes8 lanes8_halves_of(lanes8 a, lanes8 b) { return (lanes8)_mm256_blend_epi16((__m256i)a, (__m256i)b, 0xaa); }
SMEAR_AVX2_INLINE lanes8 lanes8_without(lanes8 a, lanes8 mask) { return (lanes8)_mm256_andnot_si256((__m256i)mask, (__m256i)a); }

/* Numbers in all lanes, which loops take from memory, as those of lanes8.h: of halves, but for the last one. */
struct light_numbers {
    uint32_t by[8], more[8], beyond[8], dark_by[8], dark_more[8], even[8], green[8];
};

extern const struct light_numbers smear_light_numbers;

/* Returns twice the light of sixteen codes q8, smear_srgb_light, or one more: the lesser of a cubic for dark codes and one for
 * others. */
SMEAR_AVX2_INLINE lanes8 light_twice16(lanes8 far)
{
    const struct light_numbers *const n = &smear_light_numbers;
    const lanes8 square = lanes8_mulh16(far, far);
    const lanes8 inner = lanes8_add16(lanes8_mulh16(far, lanes8_load(n->by)), lanes8_load(n->more));
    const lanes8 high = lanes8_add16(lanes8_mulh16(square, inner), lanes8_load(n->beyond));
    const lanes8 slope = lanes8_add16(lanes8_mulh16(square, lanes8_load(n->dark_by)), lanes8_load(n->dark_more));
    return lanes8_min16(lanes8_mulh16(far, slope), high);
}

/* How light is scaled: rounded by a threshold, as it is, or shifted up. */
enum light_scale { LIGHT_ROUNDED, LIGHT_PLAIN, LIGHT_RAISED };

SMEAR_AVX2_INLINE enum light_scale light_scale_of(const struct light_instant *t)
{
    return t->down != 0 ? LIGHT_ROUNDED : t->up != 0 ? LIGHT_RAISED : LIGHT_PLAIN;
}

/* An instant, ready for lanes. */
struct instant_lanes {
    lanes8 threshold, white;
    __m128i shift;
};

SMEAR_AVX2_INLINE struct instant_lanes instant_lanes_of(const struct light_instant *t)
{
    return (struct instant_lanes){ lanes8_all16(2 * t->threshold), lanes8_all(t->white << 16),
                                   _mm_cvtsi32_si128(t->down != 0 ? t->down + 1 : t->up - 1) };
}

/* What sixteen codes q8 add. */
SMEAR_AVX2_INLINE lanes8 light_added16(lanes8 far, const struct instant_lanes *t, enum light_scale scale)
{
    const lanes8 twice = light_twice16(far);
    if (scale == LIGHT_ROUNDED)
        return (lanes8)_mm256_srl_epi16((__m256i)lanes8_add16(twice, t->threshold), t->shift);
    if (scale == LIGHT_PLAIN)
        return lanes8_right16(twice, 1);
    return (lanes8)_mm256_sll_epi16((__m256i)(twice & lanes8_load(smear_light_numbers.even)), t->shift);
}

/* Adds eight pixels of which red and blue are in `rb`, green and white in `gn`. */
SMEAR_AVX2_INLINE void light_sums_add8(const struct packed_sums *sums, ptrdiff_t at, lanes8 rb, lanes8 gn)
{
    lanes8_store(sums->rb + at, lanes8_load(sums->rb + at) + rb);
    lanes8_store(sums->gn + at, lanes8_load(sums->gn + at) + gn);
}
#endif

#endif
