/* SPDX-License-Identifier: MIT */
/* span.h - the pixels of one triangle in one row. */
#ifndef SMEAR_SPAN_H
#define SMEAR_SPAN_H

#include "kernels/kernels.h"
#include "raster/setup.h"

/* Longest span: a frame's width, and what blurred layers have beyond it on both sides (layer.h). */
enum { SPAN_MAX = 2048 + 2 * 64 };

/* Pixels [a, b) of row y, a part of the triangle's whole span [left, right). */
struct span {
    int32_t a, b, left, right, y;
    void *color;                /* of pixel a: 16 bits where the target is direct, else 32 */
    uint16_t *depth;
    int32_t at;                 /* index of pixel a in the window's planes */
    uint32_t z;                 /* code 16.16 of pixel a */
    int32_t dz;
    uint32_t *mask;             /* cutout: a bit per pixel from a on, set where it was drawn; else null */
};

/* Writes colour and depth where the span passes the depth test (and cutout, blend). */
typedef void smear_span_fn(const struct setup *s, const struct span *p);

/* One colour, opaque, or in one part of fog for each row; a shadow of texels of a palette by a polynomial; and everything. */
smear_span_fn smear_span_flat, smear_span_level, smear_span_texels_shadow, smear_span_general;

/* How many of n pixels come before the first one beyond the
 * break of the depth code, which lies among them. */
static inline int32_t pixels_to_break(int32_t units, int32_t dx, int32_t n)
{
    int32_t before = dx > 0 ? (SLOPE_BREAK - units + dx - 1) / dx : (units - SLOPE_BREAK) / -dx + 1;
    return clamp_i32(before, 1, n - 1);
}

/* Writes velocities where the span will pass the depth test; comes before the colours, which write depth.
 * With a mask it comes after them and goes by the mask. */
void smear_span_velocity(const struct setup *s, const struct span *p);

/* Marks the tiles of a span: their maximum must be looked for. Jobs never share a tile of a window; rows of layers, whose jobs
 * may, have no marks. */
static inline void span_mark_tiles(const struct smear_raster_target *t, const struct span *p)
{
    if (t->moving == NULL)
        return;
    for (int32_t tile = p->a >> t->tile_shift; tile <= (p->b - 1) >> t->tile_shift; tile++)
        t->moving[tile] = 1;
}

/* One pixel without a motion of its own: its velocity is zero or, where the
 * camera's is still to be told from depth, unknown. */
void smear_velocity_still(const struct smear_raster_target *t, int32_t at, bool unknown);

/* Blends a colour over a pixel, or a shadow: as if of all that cover the pixel only the darkest did, whose alpha its top byte keeps. */
static inline uint32_t blended_pixel(uint32_t pixel, uint32_t over, bool shadow, smear_transfer transfer)
{
    const uint32_t has = pixel_alpha(over), had = shadow ? pixel_alpha(pixel) : 0;
    if (shadow && has <= had)
        return pixel;
    const uint32_t part = had == 0 ? has : (has - had) * 255u / (255u - had);
    return pixel_blend(pixel & 0xffffffu, over, part, transfer) | (shadow ? has << 24 : 0);
}

/* A call of it for shadows, where loops would keep too little in registers. */
uint32_t smear_span_darkened(uint32_t pixel, uint32_t over, smear_transfer t);

/* Whole spans of rows one below the other, from row y on. */
enum { SPAN_ROWS = 32 };

struct span_rows {
    int32_t y, count;
    bool cut;                   /* the triangle may reach beyond the target's columns,
                                 * where there is more of the frame */
    int32_t at;                 /* index of column 0 of the first row in the
                                 * planes: colour and depth lie alike */
    enum depth_slope slope;     /* in which these rows lie */
    struct span_side side[SPAN_ROWS];
};

/* Finds what draws rows at once. Null where there is no such loop for a triangle. */
smear_rows_fn *smear_rows_choose(const struct setup *s);

/* Interpolated colours without a texture, opaque: color_rows.c. */
smear_rows_fn smear_rows_shade;

/* Whole rows lie in the target and in one slope of the depth code, and have no velocities. */
static inline bool rows_are_whole(const struct setup *s, const struct span_rows *r)
{
    return r->slope != SLOPE_BOTH && !s->writes_velocity && !r->cut;
}

/* Pixels [a, b) of a row, where the next run may begin, and depth codes 16.16 from pixel 0 on. */
struct row_run {
    int32_t a, b, next;
    uint32_t z, dz;
};

/* Finds the next run of a row: within the target's columns and one slope of the depth code, from the first pixel that is seen to the
 * last one. False when there is none. Writes its velocities. smear_row_run_next does so where there are pixels from p->next on. */
bool smear_row_run_next(struct row_run *p, const struct setup *s, const struct span_rows *r, int32_t row);
static inline bool row_run_next(struct row_run *p, const struct setup *s, const struct span_rows *r, int32_t row)
{
    return p->next < r->side[row].right && smear_row_run_next(p, s, r, row);
}

/* Finds the first run of a row, whose codes step by p->dz: of rows that are `whole` all of it, which is the only one. */
static inline bool row_run_first(struct row_run *p, const struct setup *s, const struct span_rows *r, int32_t row, bool whole)
{
    p->a = p->next = r->side[row].left;
    p->b = r->side[row].right;
    if (p->a >= p->b || !whole)
        return row_run_next(p, s, r, row);
    p->z = code_from_units(plane_at(&s->depth, 0, r->y + row), r->slope);
    return true;
}

/* Makes a run that of the pixels from the first one that is seen to the last one, `depth` being of column 0; false where there are none. */
bool smear_row_run_seen(struct row_run *p, const uint16_t *depth);

#endif
