/* SPDX-License-Identifier: MIT */
/* needs.h - what a desc asks for, as far as it was compiled in. */
#ifndef SMEAR_NEEDS_H
#define SMEAR_NEEDS_H

#include "base/base.h"
#include "smear.h"

static inline bool has_window(const smear_desc *d) { return SMEAR_WITH_RECONSTRUCT && !d->sharp; }
static inline bool has_half(const smear_desc *d) { return SMEAR_WITH_FILTERS && d->half; }
static inline bool is_temporal(const smear_desc *d) { return SMEAR_WITH_SUBFRAMES && d->timed; }
static inline bool has_layers(const smear_desc *d) { return SMEAR_WITH_LAYERS && d->layers; }
static inline bool has_sums(const smear_desc *d) { return SMEAR_WITH_ACCUMULATE && d->accumulate; }
static inline bool caches_static(const smear_desc *d) { return SMEAR_WITH_DAMAGE && d->cache_static; }
static inline bool has_buffer_age(const smear_desc *d) { return SMEAR_WITH_DAMAGE && d->buffer_age; }

/* Rows are drawn a tile at a time; else a band at a time. */
static inline bool has_tiles(const smear_desc *d) { return has_window(d) || is_temporal(d) || has_layers(d); }

/* Pixel rows that are drawn together. */
static inline int32_t row_px(const smear_desc *d) { return has_tiles(d) ? d->tile : d->band_rows; }

#endif
