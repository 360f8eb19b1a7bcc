/* SPDX-License-Identifier: MIT */
/* needs.h - what a desc's set of methods needs, as far as it was compiled in. */
#ifndef SMEAR_NEEDS_H
#define SMEAR_NEEDS_H

#include "base/base.h"
#include "base/compiled.h"

/* The desc has a method of the set; false without a look where none was compiled in. */
static inline bool wants(const smear_desc *d, unsigned set)
{
    return (d->methods & (unsigned)SMEAR_SET_COMPILED & set) != 0;
}

static inline bool has_window(const smear_desc *d) { return wants(d, SMEAR_SET_FILTERS); }
static inline bool is_temporal(const smear_desc *d) { return wants(d, SMEAR_SET_TEMPORAL); }
static inline bool has_layers(const smear_desc *d) { return wants(d, SMEAR_SET_LAYERS); }
static inline bool has_half(const smear_desc *d) { return wants(d, SMEAR_SET(SMEAR_HALF)); }
static inline bool has_reach(const smear_desc *d) { return wants(d, SMEAR_SET_FILTERS | SMEAR_SET_LAYERS | SMEAR_SET_SKETCH); }

/* Frames of targets beyond SMEAR_DRAFT find room for the rows that lines reach. */
static inline bool has_lines(const smear_desc *d) { return wants(d, SMEAR_SET_SKETCH); }
static inline bool caches_static(const smear_desc *d) { return SMEAR_CACHE_STATIC_MOST && d->reuse.cache_static; }
static inline bool has_buffer_age(const smear_desc *d) { return SMEAR_BUFFER_AGE_MOST != 0 && d->reuse.buffer_age; }

/* What a display keeps of sharp frames is known: SMEAR_NONE is in the set, and the window is free for them. */
static inline bool compares_sharp(const smear_desc *d)
{
    return has_buffer_age(d) && wants(d, SMEAR_SET(SMEAR_NONE)) && !caches_static(d);
}

/* Rows are drawn a tile at a time; else a band at a time. */
static inline bool has_tiles(const smear_desc *d)
{
    return wants(d, SMEAR_SET_FILTERS | SMEAR_SET_LAYERS | SMEAR_SET_TEMPORAL) || has_buffer_age(d);
}

/* Pixel rows that are drawn together. */
static inline int32_t row_px(const smear_desc *d) { return has_tiles(d) ? d->tile : d->band_rows; }

#endif
