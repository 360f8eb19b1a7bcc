/* SPDX-License-Identifier: MIT */
/* gap_means.h - packed sums over the gap between one instant and the next, and their means. */
#ifndef SMEAR_KERNELS_GAP_MEANS_H
#define SMEAR_KERNELS_GAP_MEANS_H

#include "kernels/gap_taps.h"

/* A gap's taps and their weights: the pixel and all pairs but the last have 2^unit_log2. */
struct gap_taps {
    struct gap_pairs at;        /* an instant adds 1 */
    int unit_log2;
    uint32_t last;              /* of the last pair, 0 .. 2^unit_log2 */
    const struct packed_mean *mean;     /* of the instants, as often as all taps weigh together */
};

/* Rows are taken together where it is not size that counts. */
#ifdef __OPTIMIZE_SIZE__
#define GAP_ROWS 0
#else
#define GAP_ROWS 1
#endif

/* Rows of n >= 0 pixels each, the first of which begins at index `at`; one without GAP_ROWS. */
struct gap_rows {
    int32_t at, n, rows, pitch;
};

/* Puts the means of n >= 0 pixels from index `at` on in place of the background. A pixel stays as it is where the
 * weighted sum has no instant. */
void smear_gap_means_reference(const struct gap_planes *p, int32_t at, int32_t n, const struct gap_taps *taps,
                               enum gap_cover cover);
void smear_gap_means_two_passes(const struct gap_planes *p, const struct gap_rows *rows, const struct gap_taps *taps,
                                enum gap_cover cover);
#if SMEAR_VECTORS
void smear_gap_means_vector(const struct gap_planes *p, int32_t at, int32_t n, const struct gap_taps *taps,
                            enum gap_cover cover);
#endif

static inline void smear_gap_means(const struct gap_planes *p, const struct gap_rows *r, const struct gap_taps *taps,
                                   enum gap_cover cover)
{
#if SMEAR_VECTORS
    for (int32_t row = 0, at = r->at; row < r->rows; row++, at += r->pitch) {
        smear_gap_means_vector(p, at, r->n, taps, cover);
    }
#else
    smear_gap_means_two_passes(p, r, taps, cover);
#endif
}

#endif
