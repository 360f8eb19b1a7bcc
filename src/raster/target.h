/* SPDX-License-Identifier: MIT */
/* target.h - where triangles are drawn, and what stays the same for a frame. */
#ifndef SMEAR_TARGET_H
#define SMEAR_TARGET_H

#include "geometry/bins.h"
#include "base/pixel.h"
#include "raster/texture.h"

/* Memory for what was found out about triangles that reach beyond a
 * target's rows, for the rows after them, and for orders of lists: raster_cache.c. */
struct smear_raster_cache {
    void *entry;
    uint16_t entries;       /* 0: none */
    uint16_t entry_bytes;
};

/* Where a list is drawn: pixel rows [y0, y1) and columns [x0, x1) of the frame. Column cuts lie on multiples
 * of 16 (or at the frame's sides): then it does not matter how many cuts there are. */
struct smear_raster_target {
    int32_t x0, y0, x1, y1;
    uint32_t *color;                /* working pixels */
    uint16_t *direct;               /* in their place: finished pixels, RGB565 of this machine's byte
                                     * order, in rows like window_rows. Opaque and cut out lists
                                     * without velocities; or null */
    struct smear_plane_rows color_rows;     /* of another shape than window_rows for blended lists only */
    uint16_t *depth;                /* depth codes; shares window_rows with the velocity */
    struct smear_plane_rows window_rows;
    int8_t *velocity8;              /* x y in 1/8 px, half the displacement in the exposure; or null */
    int16_t *velocity16;            /* the same where the reach needs 16 bits; or null */
    int32_t *inspect;               /* x y in 1/256 px per frame, before clamp and packing; or null */
    struct smear_raster_cache cache;        /* of these columns, from target to target */
    uint8_t *moving;                /* per column of tiles: set when a moving triangle was drawn there */
    bool over;                      /* triangles were drawn before the list, moving ones maybe */
    uint8_t tile_shift;             /* log2 of the tile's edge, for `moving` */
};

/* Tests and tools look at velocities. */
static inline bool target_is_inspected(const struct smear_raster_target *t)
{
    return SMEAR_WITH_DEBUG && t->inspect != NULL;
}

static inline bool target_has_velocity(const struct smear_raster_target *t)
{
    return SMEAR_WITH_RECONSTRUCT && (t->velocity8 != NULL || t->velocity16 != NULL);
}

/* Whether opaque lists may be drawn there: rows of colour and depth lie alike. */
static inline bool target_is_opaque(const struct smear_raster_target *t)
{
    const struct smear_plane_rows *const c = &t->color_rows, *const w = &t->window_rows;
    return c->stride == w->stride && c->ring_row == w->ring_row && c->ring == w->ring && c->x0 == w->x0;
}

static inline bool target_is_direct(const struct smear_raster_target *t)
{
    return SMEAR_DIRECT && t->direct != NULL;
}

/* A working pixel as the target has it. */
static inline uint32_t target_pixel(const struct smear_raster_target *t, uint32_t color)
{
    return target_is_direct(t) ? rgb565_nearest(color) : color & 0xffffffu;
}

static inline void target_put(const struct smear_raster_target *t, int32_t at, uint32_t color)
{
    if (target_is_direct(t))
        t->direct[at] = (uint16_t)rgb565_nearest(color);
    else
        t->color[at] = color & 0xffffffu;
}

/* Index of column 0 of the frame in row y of a plane. */
static inline int32_t target_row(const struct smear_plane_rows *rows, const struct smear_raster_target *t, int32_t y)
{
    int32_t ring_row = rows->ring_row + (y - t->y0);
    return (ring_row >= rows->ring ? ring_row - rows->ring : ring_row) * rows->stride - rows->x0;
}

/* The box of a triangle's vertices, q8. */
struct bounds {
    int32_t x0, y0, x1, y1;
};

static inline struct bounds bounds_of(const int32_t *v0, const int32_t *v1, const int32_t *v2)
{
    return (struct bounds){ min_i32(v0[VERTEX_X], min_i32(v1[VERTEX_X], v2[VERTEX_X])),
                            min_i32(v0[VERTEX_Y], min_i32(v1[VERTEX_Y], v2[VERTEX_Y])),
                            max_i32(v0[VERTEX_X], max_i32(v1[VERTEX_X], v2[VERTEX_X])),
                            max_i32(v0[VERTEX_Y], max_i32(v1[VERTEX_Y], v2[VERTEX_Y])) };
}

/* What stays the same for the frame. */
struct smear_raster_draw {          /* one per draw, indexed by smear_segment.draw */
    struct smear_sampler sampler;
    uint8_t alpha;                  /* smear_alpha */
    uint8_t cutoff;
    bool moves;                     /* its velocity comes from its vertices */
    bool fixed;                     /* still to the eye even where the camera moves: its velocity is zero */
};

/* The part of fog, q16: scale / units 2^shift - base, or with flat depth base - scale units 2^shift. See fog.c. */
struct smear_fog_levels {
    bool on, flat_depth;
    int8_t shift;
    uint8_t zeros;                  /* leading zeros that all units in fog have */
    uint8_t contrast;               /* codes between the fog and black or white, whichever is more */
    uint32_t color;                 /* 0x00RRGGBB */
    uint32_t scale;
    int32_t base;
    int32_t near_units;             /* q11: from here on to the eye there is none */
};

struct smear_raster_frame {
    const struct smear_bins *bins;
    const struct smear_raster_draw *draw;
    smear_transfer transfer;
    int32_t width, height;
    int32_t velocity_scale;         /* q16: displacement between the motion poses to half the exposure's */
    int32_t inspect_scale;          /* q16: the same to a whole frame */
    bool velocity_from_depth;       /* what has no motion of its own moves as its depth tells */
    int32_t reach_q3;               /* longest stored velocity, 1/8 px */
#if SMEAR_WITH_FOG
    struct smear_fog_levels fog;
#endif
};

#if SMEAR_WITH_FOG
static inline const struct smear_fog_levels *frame_fog(const struct smear_raster_frame *f) { return &f->fog; }
static inline bool frame_has_fog(const struct smear_raster_frame *f) { return f->fog.on; }
#else
static inline const struct smear_fog_levels *frame_fog(const struct smear_raster_frame *f)
{
    (void)f;
    return NULL;
}
static inline bool frame_has_fog(const struct smear_raster_frame *f)
{
    (void)f;
    return false;
}
#endif

/* Its velocity is told by the frame's depth and cameras, or known to be zero (smear_frame.camera_step). */
static inline bool frame_has_depth_velocity(const struct smear_raster_frame *f)
{
    return SMEAR_WITH_FILTERS && f->velocity_from_depth;
}

static inline bool draw_is_fixed(const struct smear_raster_draw *d) { return SMEAR_WITH_FILTERS && d->fixed; }

static inline smear_transfer frame_transfer(const struct smear_raster_frame *f)
{
    return SMEAR_WITH_LINEAR ? f->transfer : TRANSFER_CODES;
}

static inline bool frame_is_linear(const struct smear_raster_frame *f) { return transfer_is_linear(f->transfer); }

/* A working pixel with `over` mixed into it by a part of 65536. */
static inline uint32_t frame_mix(const struct smear_raster_frame *f, uint32_t pixel, uint32_t over, int32_t part)
{
    return pixel_mix_part(pixel, over, part, f->transfer);
}

static inline bool draw_is_opaque(const struct smear_raster_draw *d)
{
    return !SMEAR_WITH_ALPHA || d->alpha == SMEAR_OPAQUE;
}

static inline bool draw_is_cutout(const struct smear_raster_draw *d)
{
    return SMEAR_WITH_ALPHA && d->alpha == SMEAR_CUTOUT;
}

static inline bool draw_is_blended(const struct smear_raster_draw *d)
{
    return SMEAR_WITH_ALPHA && d->alpha >= SMEAR_BLEND;
}

static inline bool draw_is_shadow(const struct smear_raster_draw *d)
{
    return SMEAR_WITH_ALPHA && d->alpha == SMEAR_SHADOW;
}

#endif
