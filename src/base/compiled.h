/* SPDX-License-Identifier: MIT */
/* compiled.h - what was compiled in (smear_config.h), as the sets and ranges that fields of the interface may have. */
#ifndef SMEAR_COMPILED_H
#define SMEAR_COMPILED_H

#include "smear.h"
#include "base/base.h"

/* smear_frame.edges may be SMEAR_EDGES_SMOOTH. */
#define SMEAR_EDGES (SMEAR_WITH_FOG && SMEAR_WITH_SUBFRAMES)

/* frame.scene may be there. */
#define SMEAR_HAS_SCENE (SMEAR_WITH_SKY || SMEAR_WITH_LIGHTS)

/* desc.methods */
#define SMEAR_SET_SUMS (SMEAR_SET(SMEAR_ACCUMULATE) | SMEAR_SET_ACCUMULATE_BANDS)
enum {
    SMEAR_SET_COMPILED
        = (int)(SMEAR_SET(SMEAR_NONE) | (SMEAR_WITH_ACCUMULATE ? SMEAR_SET_SUMS : 0u)
                               | (SMEAR_WITH_RECONSTRUCT ? SMEAR_SET(SMEAR_RECONSTRUCT) : 0u)
                               | (SMEAR_WITH_FILTERS ? SMEAR_SET_FILTERS : 0u) | (SMEAR_WITH_LAYERS ? SMEAR_SET_LAYERS : 0u)
                               | (SMEAR_WITH_SUBFRAMES ? SMEAR_SET(SMEAR_SUBFRAMES) | SMEAR_SET(SMEAR_AUTO) : 0u)
                               | (SMEAR_WITH_LINES ? SMEAR_SET_SKETCH : 0u) | (SMEAR_WITH_TIMEMASK ? SMEAR_SET(SMEAR_TIMEMASK) : 0u))
};

/* Other fields of desc. */
enum {
    SMEAR_CACHE_STATIC_MOST = SMEAR_WITH_DAMAGE ? 1 : 0,
    SMEAR_BUFFER_AGE_MOST = SMEAR_WITH_DAMAGE ? 7 : 0,
    SMEAR_PASSES_MOST = SMEAR_WITH_FILTERS ? 3 : 1,
    SMEAR_SCATTER_MOST = SMEAR_WITH_FILTERS ? 1 : 0,
    SMEAR_DITHER_DEFAULT = SMEAR_WITH_DITHER ? SMEAR_DITHER_ORDERED : SMEAR_DITHER_NONE,
    SMEAR_DOUBLED_MOST = SMEAR_WITH_DISPLAY ? SMEAR_DOUBLED_XY : SMEAR_DOUBLED_NONE,
    SMEAR_INSPECT_MOST = SMEAR_WITH_DEBUG
};

/* Fields of a frame; of light space and path, what is least is the default. Scales are those that are used: 0 once 0 has become 256. */
enum {
    SMEAR_LIGHT_SPACE_LEAST = SMEAR_WITH_LINEAR ? SMEAR_LIGHT_LINEAR : SMEAR_LIGHT_ENCODED,
    SMEAR_PATH_LEAST = SMEAR_WITH_CURVES ? SMEAR_PATH_CURVE : SMEAR_PATH_LINE,
    SMEAR_PATH_MOST = SMEAR_WITH_CURVES ? SMEAR_PATH_SCREW : SMEAR_PATH_LINE,
    SMEAR_SHUTTER_MODE_MOST = SMEAR_WITH_SCALES ? SMEAR_SHUTTER_FIXED : SMEAR_SHUTTER_NATIVE,
    SMEAR_WEIGHTS_MOST = SMEAR_WITH_FILTERS ? SMEAR_WEIGHTS_JIMENEZ : SMEAR_WEIGHTS_STACK,
    SMEAR_FILTER_KINDS = SMEAR_WITH_FILTERS,
    SMEAR_CAMERA_STEP_MOST = SMEAR_WITH_FILTERS ? 4 : 0,
    SMEAR_SCALE_LEAST = SMEAR_WITH_SCALES ? 0 : 256,
    SMEAR_SCALE_MOST = SMEAR_WITH_SCALES ? 16128 : 256,
    SMEAR_SUM_SAMPLES_MOST = SMEAR_WITH_LINEAR ? 1024 : 257,    /* of codes alone, sums have 16 bits */
    SMEAR_LAYERS_MOST = SMEAR_WITH_LAYERS ? SMEAR_LAYERS_MAX : 0,
    SMEAR_ORTHOGRAPHIC_MOST = SMEAR_WITH_VIEWS,
    SMEAR_FOG_MOST = SMEAR_WITH_FOG,
    SMEAR_EDGES_MOST = SMEAR_EDGES ? SMEAR_EDGES_SMOOTH : SMEAR_EDGES_HARD,
    SMEAR_OVERLAY_MOST = SMEAR_WITH_OVERLAY
};
#define SMEAR_SHUTTER_US_ANY SMEAR_WITH_SCALES

/* Fields of a draw. */
enum {
    SMEAR_BILLBOARD_MOST = SMEAR_WITH_VIEWS ? SMEAR_BILLBOARD_UPRIGHT : SMEAR_BILLBOARD_NONE,
    SMEAR_VERTEX_COLORS_MOST = SMEAR_WITH_GOURAUD,
    SMEAR_DEFORM_MOST = SMEAR_WITH_DEFORM,
    SMEAR_ALPHA_MOST = SMEAR_WITH_ALPHA ? SMEAR_SHADOW : SMEAR_OPAQUE,
    SMEAR_TEXTURE_MOST = SMEAR_WITH_TEXTURE
};

/* Smaller pictures of a texture halve sizes that are powers of two, down to 1 x 1. */
static inline bool texture_has_levels(uint32_t width, uint32_t height, uint32_t levels)
{
    return levels == 0 || ((width & (width - 1)) == 0 && (height & (height - 1)) == 0 && levels <= 12 && (width | height) >> levels != 0);
}

/* ------------------------------------------------------------------ what a desc's set of methods needs */

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
