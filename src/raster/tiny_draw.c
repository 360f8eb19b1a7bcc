/* SPDX-License-Identifier: MIT */
/* tiny_draw.c - see tiny_draw.h. */
#include "raster/tiny_draw.h"

#include "geometry/tiny.h"
#include "kernels/tiny_box.h"
#include "raster/fog.h"

/* Records begin with x and y, q8 px, and depth units; clockwise, less than 16 px apart. (x, y) is the box's first pixel, at most as far
 * from them. */
static inline void tiny_corners(struct tiny_box *b, const int32_t *v0, const int32_t *v1, const int32_t *v2, int32_t x,
                                int32_t y)
{
    const int32_t x1 = v1[0] - v0[0], y1 = v1[1] - v0[1], x2 = v2[0] - v0[0], y2 = v2[1] - v0[1], area = x1 * y2 - x2 * y1;
    const struct tiny_scale scale = tiny_scale_make(area);
    struct tiny_edges e;
    tiny_start(&e, v0[0], v0[1], x1, y1, x2, y2, area, x, y);
    b->up = scale.up;
    b->recip = scale.recip;
    b->e1 = e.e1;
    b->e2 = e.e2;
    b->sum = e.e0 + e.e1 + e.e2;
    b->right1 = e.right1;
    b->right2 = e.right2;
    b->down1 = e.down1;
    b->down2 = e.down2;
    tiny_units(b, v1[2] - v0[2], v2[2] - v0[2]);
}

/* Takes colours on to the fog's, by the one part that a triangle has of it. */
static SMEAR_NOINLINE void colors_in_fog(struct tiny_box *b, const struct setup *s)
{
    static const uint8_t shift[3] = { 16, 0, 8 };       /* red, blue, green */
    const int32_t part = fog_even_part(s) >> 1;
    const uint32_t round = channel_round(b->transfer) << 6;
    for (int i = 0; i < 3; i++) {
        struct tiny_channel *const c = &b->channel[i];
        const uint32_t code = frame_fog(s->frame)->color >> shift[i] & 255u;
        const int32_t there = (int32_t)(channel_of_code(code, b->transfer) >> 8), value = (int32_t)((c->base - round) >> 14);
        c->base = ((uint32_t)(value + ((there - value) * part >> 15)) << 14) + round;
        c->to1 -= c->to1 * part >> 15;
        c->to2 -= c->to2 * part >> 15;
    }
}

/* Draws n rows of a box whose first pixel is at index `at`. */
static inline void draw_rows(struct tiny_box *b, const struct smear_raster_target *t, int32_t at, int32_t n)
{
    const bool narrow = SMEAR_DIRECT && b->narrow;
    b->depth = t->depth + at;
    b->pixels = narrow ? (void *)(t->direct + at) : t->color + at;
    b->rows = n;
    tiny_box(b, narrow);
}

void smear_tiny_box(struct tiny_look *l, const struct smear_raster_target *t, const int32_t *const v[3], uint32_t color,
                    const struct pixel_box *box, const struct tiny_depths *depths, const struct setup *fog)
{
    struct tiny_box *const b = &l->box;
    const int32_t left = max_i32(box->left, t->x0), bottom = min_i32(box->bottom, t->y1);
    const int32_t top = max_i32(box->top, t->y0);
    b->columns = min_i32(box->right, t->x1) - left;
    if (!SMEAR_SMALL_CODE && (b->columns <= 0 || top >= bottom))        /* draw_any has looked at that */
        return;
    tiny_codes(b, v[0][VERTEX_DEPTH], depths->low, depths->high);
    tiny_corners(b, v[0], v[1], v[2], left, top);
    if (SMEAR_WITH_GOURAUD && b->shaded) {
        const uint32_t *const c0 = (const uint32_t *)v[0] + l->color, *const c1 = (const uint32_t *)v[1] + l->color;
        tiny_channels(b->channel, c0, c1, (const uint32_t *)v[2] + l->color, b->transfer);
        if (SMEAR_WITH_FOG && (SMEAR_SMALL_CODE || fog != NULL) && fog_is_even(fog))
            colors_in_fog(b, fog);
    } else {
        b->color = target_pixel(t, color);
    }
    const struct smear_plane_rows *const w = &t->window_rows;
    int32_t ring_row = w->ring_row + (top - t->y0);
    for (int32_t rows = bottom - top; rows > 0;) {
        ring_row -= ring_row >= w->ring ? w->ring : 0;
        const int32_t n = min_i32(rows, w->ring - ring_row);
        draw_rows(b, t, ring_row * w->stride - w->x0 + left, n);
        ring_row += n;
        rows -= n;
    }
}

bool smear_tiny_draw(struct tiny_look *l, const struct smear_raster_target *t, const int32_t *const v[3], uint32_t color)
{
    struct pixel_box box;
    box_span(&box.left, &box.right, v[0][VERTEX_X], v[1][VERTEX_X], v[2][VERTEX_X]);
    box_span(&box.top, &box.bottom, v[0][VERTEX_Y], v[1][VERTEX_Y], v[2][VERTEX_Y]);
    const struct tiny_depths depths = tiny_depths_of(v);
    const int32_t columns = box.right - box.left, rows = box.bottom - box.top;
    if (columns > SMALL_PX || rows > SMALL_PX || columns * rows > TINY_PIXELS || !tiny_suits(l, &depths))
        return false;
    smear_tiny_box(l, t, v, color, &box, &depths, NULL);
    return true;
}
