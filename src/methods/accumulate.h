/* SPDX-License-Identifier: MIT */
/* accumulate.h - sums of whole rows over instants, and their mean. */
#ifndef SMEAR_ACCUMULATE_H
#define SMEAR_ACCUMULATE_H

#include "display/row.h"

/* Sums of linear light or of codes; 16 bits are enough for codes alone. */
#if SMEAR_WITH_LINEAR
typedef uint32_t smear_sum;
enum { SUM_SAMPLES_MAX = 1024 };
#else
typedef uint16_t smear_sum;
enum { SUM_SAMPLES_MAX = 257 };
#endif

struct smear_sums {
    smear_sum *sum;             /* r g b per pixel of the frame, or of a tile row; null: there are none */
    bool whole;                 /* of the frame */
    int32_t top;                /* the first pixel row that they hold */
};

/* Empties the sums of tile rows [first, end). */
void smear_sums_clear(struct smear_sums *s, const struct smear_rows *rows, int first, int end);

/* Adds a row of the window, drawn and blended. */
void smear_sums_add_row(struct smear_sums *s, const struct smear_rows *rows, int row);

/* Writes the means of n instants back into the window's row. */
void smear_sums_average_row(const struct smear_sums *s, const struct smear_rows *rows, int row, uint32_t n);

#endif
