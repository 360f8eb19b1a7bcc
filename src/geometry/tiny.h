/* SPDX-License-Identifier: MIT */
/* tiny.h - triangles of a few pixels: edge functions tell the covered centres and are also the weights of the three
 * vertices there. That costs less than gradients. The assembler and the raster share it. */
#ifndef SMEAR_TINY_H
#define SMEAR_TINY_H

#include "base/pixel.h"
#include "geometry/bins.h"
#include "kernels/tiny_weights.h"

/* Edge functions at the centre of a pixel, q16; inside is e0, e1, e2 >= 0. e1 and e2 are twice the areas
 * opposite to v[1] and v[2]. Exact in 32 bits for boxes of up to 64 x 64 px. */
struct tiny_edges {
    int32_t e0, e1, e2;
    int32_t right0, right1, right2;     /* one pixel to the right */
    int32_t down0, down1, down2;
};

/* Returns 0 for edges that go up (left ones) or right (top ones), whose centres count, else -1. */
static inline int32_t tiny_bias(int32_t dx, int32_t dy)
{
    return ~(dy * 65536 - dx) >> 31;
}

/* Starts at pixel (x, y), for v[0]'s place and the edges (x1, y1) and (x2, y2) to v[1] and v[2], all q8, and twice the area. */
static inline void tiny_start(struct tiny_edges *e, int32_t vx, int32_t vy, int32_t x1, int32_t y1,
                              int32_t x2, int32_t y2, int32_t area, int32_t x, int32_t y)
{
    int32_t cx = x * 256 + 128 - vx, cy = y * 256 + 128 - vy;
    int32_t e2 = x1 * cy - y1 * cx, e1 = y2 * cx - x2 * cy;
    e->e0 = area - e1 - e2 + tiny_bias(x2 - x1, y2 - y1);
    e->e1 = e1 + tiny_bias(-x2, -y2);
    e->e2 = e2 + tiny_bias(x1, y1);
    e->right1 = y2 * 256;
    e->right2 = -y1 * 256;
    e->right0 = (y1 - y2) * 256;
    e->down1 = -x2 * 256;
    e->down2 = x1 * 256;
    e->down0 = (x2 - x1) * 256;
}

#endif
