/* SPDX-License-Identifier: MIT */
/* tiny_draw.c - see tiny_draw.h. */
#include "raster/tiny_draw.h"

#include "kernels/tiny_box.h"
#include "raster/fog.h"

/* The pixels whose centres may be covered, from the first to that behind the last one, and the range of depth units. */
struct tiny_span {
    int32_t left, top, right, bottom, low, high;
};

/* Records begin with x and y, q8 px, less than 2^15 px from 0, and depth units from 0 on. */
static inline void tiny_span(struct tiny_span *s, const int32_t *v0, const int32_t *v1, const int32_t *v2)
{
    s->left = (min_i32(v0[0], min_i32(v1[0], v2[0])) + 127) >> 8;
    s->right = (max_i32(v0[0], max_i32(v1[0], v2[0])) + 127) >> 8;
    s->top = (min_i32(v0[1], min_i32(v1[1], v2[1])) + 127) >> 8;
    s->bottom = (max_i32(v0[1], max_i32(v1[1], v2[1])) + 127) >> 8;
    s->low = min_i32(v0[2], min_i32(v1[2], v2[2]));
    s->high = max_i32(v0[2], max_i32(v1[2], v2[2]));
}

/* 0 for edges that go up (left ones) or right (top ones), whose centres count, else -1. */
static inline int32_t tiny_corner_bias(int32_t dx, int32_t dy) { return (dx - dy * 65536 - 1) >> 31; }

/* Records begin with x and y, q8 px, and depth units; clockwise, less than 16 px apart. (x, y) is the box's first pixel, at most as far
 * from them. */
static inline void tiny_corners(struct tiny_box *b, const int32_t *v0, const int32_t *v1, const int32_t *v2, int32_t x,
                                int32_t y)
{
    const int32_t x1 = v1[0] - v0[0], y1 = v1[1] - v0[1], x2 = v2[0] - v0[0], y2 = v2[1] - v0[1], area = x1 * y2 - x2 * y1;
    const int32_t cx = x * 256 + 128 - v0[0], cy = y * 256 + 128 - v0[1];
    const int32_t bias1 = tiny_corner_bias(-x2, -y2), bias2 = tiny_corner_bias(x1, y1);
    const struct tiny_scale scale = tiny_scale_make(area);
    b->up = scale.up;
    b->recip = scale.recip;
    b->e1 = y2 * cx - x2 * cy + bias1;
    b->e2 = x1 * cy - y1 * cx + bias2;
    b->sum = area + tiny_corner_bias(x2 - x1, y2 - y1) + bias1 + bias2;
    b->right1 = y2 * 256;
    b->right2 = -y1 * 256;
    b->down1 = -x2 * 256;
    b->down2 = x1 * 256;
    tiny_units(b, v1[2] - v0[2], v2[2] - v0[2]);
}

static inline void tiny_channel_make(struct tiny_channel *c, uint32_t c0, uint32_t c1, uint32_t c2, uint32_t round)
{
    c->to1 = (int32_t)(c1 & 0xffffu) - (int32_t)(c0 & 0xffffu);
    c->to2 = (int32_t)(c2 & 0xffffu) - (int32_t)(c0 & 0xffffu);
    c->base = ((c0 & 0xffffu) << 14) + round;
}

/* Two words of each corner: red and green, blue. What rounds is 2^21 for codes, 0 for linear light. */
static inline void tiny_colors(struct tiny_box *b, const uint32_t *c0, const uint32_t *c1, const uint32_t *c2, uint32_t round)
{
    for (int i = 0; i < 3; i++) {
        const int word = i & 1, shift = i << 3 & 16;        /* red, blue, green */
        tiny_channel_make(&b->channel[i], c0[word] >> shift, c1[word] >> shift, c2[word] >> shift, round);
    }
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
        tiny_colors(b, c0, c1, (const uint32_t *)v[2] + l->color, channel_round(b->transfer) << 6);
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
