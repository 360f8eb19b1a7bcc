/* SPDX-License-Identifier: MIT */
/* tiny_corners.h - makes the box of a tiny triangle ready (tiny_box.h): edge functions, weights, depths and colours of its corners. */
#ifndef SMEAR_KERNELS_TINY_CORNERS_H
#define SMEAR_KERNELS_TINY_CORNERS_H

#include "kernels/tiny_box.h"

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

#endif
