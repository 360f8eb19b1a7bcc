/* SPDX-License-Identifier: MIT */
/* sharp_apart.h - sharp tile rows, each drawn and converted by one core in a window of its own. */
#ifndef SMEAR_SHARP_APART_H
#define SMEAR_SHARP_APART_H

#include "display/points.h"
#include "display/row.h"

/* Windows of other cores lie in the memory of temporal methods. */
#define SMEAR_SHARP_APART (SMEAR_WITH_WORKERS && SMEAR_WITH_SUBFRAMES && !SMEAR_SMALL_CODE)

/* Whether there is anything to gain, and nothing that needs rows one after the other. */
static inline bool smear_sharp_may_be_apart(const struct smear_rows *rows, bool direct, int first, int end)
{
    return SMEAR_SHARP_APART && rows->jobs.workers > 1 && end - first > rows->jobs.workers && rows->refill == NULL
        && rows->scratch_end != NULL && !direct && !rows->blends && !rows_have_overlay(rows) && rows->inspect == NULL && !rows->keeps_motion
        && rows->desc->band_rows == rows->bins.row_px;
}

/* Draws, converts and hands out the tile rows [first, end). False, and nothing is done, where there is no room. */
bool smear_sharp_rows_apart(struct smear_rows *rows, int first, int end, int *result);

#endif
