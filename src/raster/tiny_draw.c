/* SPDX-License-Identifier: MIT */
/* tiny_draw.c - see tiny_draw.h. */
#include "raster/tiny_draw.h"

#include "kernels/tiny_corners.h"
#include "raster/fog.h"

/* Takes colours on to the fog's, by the one part that a triangle has of it. */
static SMEAR_NOINLINE void colors_in_fog(struct tiny_box *b, const struct setup *s)
{
    static const uint8_t shift[3] = { 16, 0, 8 };       /* red, blue, green */
    const int32_t part = fog_even_part(s) >> 1;
    const uint32_t round = b->linear ? 0 : 1u << 21;
    for (int i = 0; i < 3; i++) {
        struct tiny_channel *const c = &b->channel[i];
        const uint32_t code = frame_fog(s->frame)->color >> shift[i] & 255u;
        const int32_t there = b->linear ? smear_srgb_decode[code] : (int32_t)(code << 8), value = (int32_t)((c->base - round) >> 14);
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
        tiny_colors(b, c0, c1, (const uint32_t *)v[2] + l->color, b->linear ? 0 : 1u << 21);
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
    struct tiny_span s;
    tiny_span(&s, v[0], v[1], v[2]);
    const struct tiny_depths depths = { s.low, s.high };
    const struct pixel_box box = { s.left, s.right, s.top, s.bottom };
    if (s.right - s.left > SMALL_PX || s.bottom - s.top > SMALL_PX || (s.right - s.left) * (s.bottom - s.top) > TINY_PIXELS
        || !tiny_suits(l, &depths))
        return false;
    smear_tiny_box(l, t, v, color, &box, &depths, NULL);
    return true;
}
