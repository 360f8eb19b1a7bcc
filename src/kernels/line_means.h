/* SPDX-License-Identifier: MIT */
/* line_means.h - means of pixels that lie along a line: all pixels of a block take theirs at the same distances. */
#ifndef SMEAR_LINE_MEANS_H
#define SMEAR_LINE_MEANS_H

#include "base/base.h"

enum { LINE_TAPS_LOG_MAX = 3, LINE_TAPS_MAX = 1 << LINE_TAPS_LOG_MAX };

/* A block of pixels and its taps. */
struct line_block {
    const uint32_t *in;         /* XRGB codes of its first pixel; rows `in_stride` apart */
    uint32_t *out;              /* rows `out_stride` apart */
    int32_t in_stride, out_stride;
    int32_t columns, rows;
    int32_t log;                /* 2^log taps, log 0 .. LINE_TAPS_LOG_MAX, but 1, which no line has: */
    int32_t offset[LINE_TAPS_MAX];      /* from a pixel to each */
    bool sparse;                /* of most taps; rows have a multiple of LINE_SPARSE columns, and their ends have taps: means are taken of
                                 * every fourth pixel, and what lies between two is theirs */
};

enum { LINE_SPARSE = 4 };

/* Returns the mean of two codes, rounded up. */
static inline uint32_t line_between(uint32_t a, uint32_t b) { return (a | b) - ((a ^ b) >> 1 & 0x7f7f7fu); }

/* Writes the mean of each pixel's taps; with `linear` that of their light, for which the squares of codes stand, as a code. The fourth
 * channel may be anything: texels are copied with theirs. */
void smear_line_means(const struct line_block *b, bool linear);

/* Mixes picture k, 1 .. 3, with those before it: writes the mean of `mean` and `more`; of these and `last`, where k is 2; where k is 3,
 * of `mean`, which weighs twice, `more`, which is lost, and `last`. With `linear` that of their light. Their upper eight bits may be
 * anything. */
void smear_line_mix(uint32_t *mean, uint32_t *more, const uint32_t *last, int32_t n, int32_t k, bool linear);

/* What all variants give. */
void smear_line_means_reference(const struct line_block *b, bool linear);
void smear_line_mix_reference(uint32_t *mean, uint32_t *more, const uint32_t *last, int32_t n, int32_t k, bool linear);

#endif
