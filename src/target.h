/* SPDX-License-Identifier: MIT */
/* target.h - where triangles are drawn, and what stays the same for a frame. */
#ifndef SMEAR_TARGET_H
#define SMEAR_TARGET_H

#include "geometry.h"
#include "texture.h"

/* One plane of pixels of which some rows exist: row `y0` is row `slot0` of the memory, and after row `ring - 1` comes
 * row 0. Column x is at x - x0. */
struct smear_plane_rows {
    int32_t stride;         /* pixels */
    int32_t slot0, ring, x0;
};

/* Where a list is drawn: pixel rows [y0, y1) and columns [x0, x1) of the frame. Column cuts lie on multiples of 16 (or
 * at the frame's sides): then it does not matter how many cuts there are. */
struct smear_raster_target {
    int32_t x0, y0, x1, y1;
    uint32_t *color;                /* working pixels */
    struct smear_plane_rows color_rows;     /* of another shape than window_rows for blended lists only */
    uint16_t *depth;                /* depth codes; shares window_rows with the velocity */
    struct smear_plane_rows window_rows;
    int8_t *velocity8;              /* x y in 1/8 px, half the displacement in the exposure; or null */
    int16_t *velocity16;            /* the same where the reach needs 16 bits; or null */
    int32_t *inspect;               /* x y in 1/256 px per frame, before clamp and packing; or null */
    uint8_t *moving;                /* per column of tiles: set when a moving triangle was drawn there */
    uint8_t tile_shift;             /* log2 of the tile's edge, for `moving` */
};

/* Index of column 0 of the frame in row y of a plane. */
static inline int32_t target_row(const struct smear_plane_rows *rows, const struct smear_raster_target *t, int32_t y)
{
    int32_t slot = rows->slot0 + (y - t->y0);
    return (slot >= rows->ring ? slot - rows->ring : slot) * rows->stride - rows->x0;
}

/* What stays the same for the frame. */
struct smear_raster_draw {          /* one per draw, indexed by smear_segment.draw */
    struct smear_sampler sampler;
    uint8_t alpha;                  /* smear_alpha */
    uint8_t cutoff;
};

struct smear_raster_frame {
    const struct smear_geometry *geometry;
    const struct smear_raster_draw *draw;
    bool linear;
    int32_t width, height;
    int32_t velocity_scale;         /* q16: displacement between the motion poses to half the exposure's */
    int32_t inspect_scale;          /* q16: the same to a whole frame */
    int32_t reach_q3;               /* longest stored velocity, 1/8 px */
};

static inline bool frame_is_linear(const struct smear_raster_frame *f) { return SMEAR_WITH_LINEAR && f->linear; }

static inline bool draw_is_opaque(const struct smear_raster_draw *d) { return !SMEAR_WITH_ALPHA || d->alpha == SMEAR_OPAQUE; }
static inline bool draw_is_cutout(const struct smear_raster_draw *d) { return SMEAR_WITH_ALPHA && d->alpha == SMEAR_CUTOUT; }
static inline bool draw_is_blended(const struct smear_raster_draw *d) { return SMEAR_WITH_ALPHA && d->alpha == SMEAR_BLEND; }

#endif
