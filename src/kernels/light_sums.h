/* SPDX-License-Identifier: MIT */
/* light_sums.h - sums of pixels' light over instants, and their means over the gap between one instant and the next.
 *
 * A sum has the shape of a packed sum (packed_sums.h), with light in place of codes and, beside green, the light that
 * white has at its instants in place of their number. Light has 12 bits. Few instants add it shifted up, so that means
 * have all 16 bits to round in; more than 16 add fewer bits of it, rounded by a threshold that differs from instant to
 * instant, so that the sum has what the parts leave out. */
#ifndef SMEAR_KERNELS_LIGHT_SUMS_H
#define SMEAR_KERNELS_LIGHT_SUMS_H

#include "base/tables.h"
#include "kernels/gap_means.h"

enum { LIGHT_WHITE = 4095, LIGHT_INSTANTS_MAX = 1024 };

/* Returns the light of a code: linear, or what stands for it where codes themselves are averaged. */
SMEAR_INLINE uint32_t light_of_code(uint32_t code, bool linear)
{
    return linear ? smear_srgb_light[code] : code << 4 | code >> 4;
}

SMEAR_INLINE uint32_t code_of_light(uint32_t light, bool linear)
{
    return linear ? smear_srgb_encode[light] : (light * 255u + 2048u) >> 12;
}

/* What an instant adds: ((light + threshold) >> down) << up. */
struct light_instant {
    uint32_t threshold;
    int down, up;
    bool linear;
    uint32_t white;             /* what white adds */
};

/* Returns how instant k of `instants` (1 .. LIGHT_INSTANTS_MAX) adds. */
struct light_instant smear_light_instant(uint32_t k, uint32_t instants, bool linear);

/* Returns what white adds at all instants together: up to 65520. */
uint32_t smear_light_full(uint32_t instants);

/* Returns the most that white adds at one of so many instants. */
uint32_t smear_light_most(uint32_t instants);

/* Adds n >= 1 pixels to their sums: those that are not PACKED_NOTHING, which they become, or, where `background` is not null, all of
 * them, which become that again. The two do not overlap. */
void smear_light_add_reference(uint32_t *color, const uint32_t *background, struct packed_sums sums, int32_t n,
                               const struct light_instant *instant);
#if SMEAR_VECTORS
#define smear_light_add smear_light_add_vector
void smear_light_add_vector(uint32_t *color, const uint32_t *background, struct packed_sums sums, int32_t n,
                            const struct light_instant *instant);
#else
#define smear_light_add smear_light_add_reference
#endif

/* How the sums at a pixel and at its taps become its mean: weights in q16, which add up to one. */
struct light_mean {
    uint32_t own, pair, last;   /* of the pixel (0 where there are no pairs: one), of a pair's mean, of the last one's */
    uint32_t full;              /* the weighted sum of what is white throughout */
    uint32_t factor;            /* q16: `full` to LIGHT_WHITE */
    uint32_t half;              /* of a step of light, and what products of weights lose by their floors, about */
    bool linear;
};

/* Makes the mean of a pixel and `pairs` pairs of taps, each tap with the weight `unit`, but for `last` of the last pair's.
 * `full`: smear_light_full. */
struct light_mean smear_light_mean(uint32_t full, int32_t pairs, uint32_t unit, uint32_t last, bool linear);

/* Puts the means of n >= 0 pixels from index `at` on in place of the background, of which they have what white lacks. */
void smear_light_means_reference(const struct gap_planes *p, int32_t at, int32_t n, const struct gap_pairs *taps,
                                 const struct light_mean *mean, enum gap_cover cover);
#if SMEAR_VECTORS
#define smear_light_means smear_light_means_vector
void smear_light_means_vector(const struct gap_planes *p, int32_t at, int32_t n, const struct gap_pairs *taps,
                              const struct light_mean *mean, enum gap_cover cover);
#else
#define smear_light_means smear_light_means_reference
#endif

#endif
