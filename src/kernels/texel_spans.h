/* SPDX-License-Identifier: MIT */
/* texel_spans.h - spans that are drawn at once. */
#ifndef SMEAR_KERNELS_TEXEL_SPANS_H
#define SMEAR_KERNELS_TEXEL_SPANS_H

#include "base/base.h"

/* The most spans of a call, a multiple of eight. */
enum { TEXEL_SPANS = 128 };

/* Pixels [a, b) of rows that reach from `left` to `right`: left <= a < b <= right. Depth codes 16.16 are z + x dz. */
struct texel_spans {
    int32_t count;
    int32_t row[TEXEL_SPANS], left[TEXEL_SPANS], right[TEXEL_SPANS], a[TEXEL_SPANS], b[TEXEL_SPANS];
    uint32_t z[TEXEL_SPANS], dz[TEXEL_SPANS];
};

#endif
