/* SPDX-License-Identifier: MIT */
/* gap_means.h - packed sums over the gap between one instant and the next, and their means.
 *
 * A sum of N instants is a comb of N teeth where the truth is a box. What moves alike leaves the same gap from tooth to
 * tooth at all pixels: the sum's own mean over that gap, centred on each pixel, closes the comb. */
#ifndef SMEAR_KERNELS_GAP_MEANS_H
#define SMEAR_KERNELS_GAP_MEANS_H

#include "kernels/packed_sums.h"

enum { GAP_PAIRS_MAX = 8 };

/* A gap's taps: the pixel itself, and pairs of one before and one after it. The pixel and all pairs but the last have
 * the weight 2^unit_log2. */
struct gap_taps {
    const int32_t *offset;      /* of each pair, in indices */
    int32_t pairs;              /* 0 .. GAP_PAIRS_MAX */
    int unit_log2;
    uint32_t last;              /* weight of the last pair, 0 .. 2^unit_log2 */
    const struct packed_mean *mean;     /* of the instants, as often as all taps weigh together */
};

/* Planes that share their indices. */
struct gap_planes {
    uint32_t *color;            /* the background, and then the means */
    const uint16_t *depth;      /* depth codes of the background: larger is nearer */
    struct packed_sums sums;    /* of what moves before it */
    uint32_t nearest;           /* no depth code of what moves is larger */
};

/* What is known of the background at n pixels and at their taps. */
enum gap_cover {
    COVER_NONE,         /* its depth codes are all alike, and none is larger than `nearest` */
    COVER_FEW,          /* none is larger than `nearest` */
    COVER_ALL           /* nothing: it may hide what moves */
};

/* Puts the means of n >= 0 pixels from index `at` on in place of the background. A tap counts what is there, but
 *   - as the pixel itself where the background there is nearer than at the pixel and hides what moves: beyond
 *     `nearest`, or with two instants less than the pixel has, as what is at a pixel at n instants is half a gap away,
 *     or less, at n - 1 of them;
 *   - all taps as the pixel itself where the background at the pixel hides what moves: beyond `nearest`, or nearer than
 *     at a tap that has two instants more.
 * A pixel stays as it is where the weighted sum has no instant. */
void smear_gap_means_reference(const struct gap_planes *p, int32_t at, int32_t n, const struct gap_taps *taps,
                               enum gap_cover cover);
void smear_gap_means_two_passes(const struct gap_planes *p, int32_t at, int32_t n, const struct gap_taps *taps,
                                enum gap_cover cover);
#if SMEAR_VECTORS
void smear_gap_means_vector(const struct gap_planes *p, int32_t at, int32_t n, const struct gap_taps *taps,
                            enum gap_cover cover);
#endif

static inline void smear_gap_means(const struct gap_planes *p, int32_t at, int32_t n, const struct gap_taps *taps,
                                   enum gap_cover cover)
{
#if SMEAR_VECTORS
    smear_gap_means_vector(p, at, n, taps, cover);
#else
    smear_gap_means_two_passes(p, at, n, taps, cover);
#endif
}

#endif
