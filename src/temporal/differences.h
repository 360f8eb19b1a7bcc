/* SPDX-License-Identifier: MIT */
/* differences.h - how unlike pixels are that lie behind one another on their path. */
#ifndef SMEAR_TEMPORAL_DIFFERENCES_H
#define SMEAR_TEMPORAL_DIFFERENCES_H

#include "base/pixel.h"

/* Pixels of a row at an instant, what is static behind them, and depth codes of both: larger is nearer. */
struct difference_rows {
    const uint32_t *color, *behind;
    const uint16_t *depth, *deep;
    int32_t there, there_behind;        /* where the pixels lie that they are compared with, in pixels from these: in color and
                                         * depth, and in behind and deep */
};

static inline uint32_t difference_squared(uint32_t a, uint32_t b)
{
    const int32_t r = (int32_t)pixel_red(a) - (int32_t)pixel_red(b), g = (int32_t)pixel_green(a) - (int32_t)pixel_green(b),
                  u = (int32_t)pixel_blue(a) - (int32_t)pixel_blue(b);
    return (uint32_t)(r * r + g * g + u * u);
}

/* Returns the squared differences of n >= 1 pixels, and adds to *moving how many of them are not as what is static. An edge
 * between two pixels counts where it moves: what is static must lie behind, else it hides the edge. Upper eight bits of
 * pixels may be anything: they tell pixels apart, but are no difference. */
static inline uint32_t differences_reference(const struct difference_rows *r, int32_t n, uint32_t *moving)
{
    const uint32_t *color_there = r->color + r->there, *behind_there = r->behind + r->there_behind;
    const uint16_t *depth_there = r->depth + r->there, *deep_there = r->deep + r->there_behind;
    uint32_t sum = 0, count = 0;
    for (int32_t i = 0; i < n; i++) {
        const uint32_t here = r->color[i], next = color_there[i], depth = r->depth[i];
        const bool moves = depth != r->deep[i] || here != r->behind[i];
        count += moves;
        if (here == next)
            continue;
        if (moves ? depth_there[i] > depth : depth_there[i] >= depth) {
            if (depth_there[i] == deep_there[i] && next == behind_there[i])
                continue;
        } else if (!moves) {
            continue;
        }
        sum += difference_squared(here, next);
    }
    *moving += count;
    return sum;
}

/* Some rows of n pixels; so far from one to the next are color and depth, and behind and deep. */
struct difference_block {
    struct difference_rows first;
    int32_t pitch, pitch_behind, rows, n;
};

/* For up to 8 pixels in a row. */
static inline uint32_t difference_block(const struct difference_block *b, uint32_t *moving)
{
    struct difference_rows r = b->first;
    uint32_t sum = 0;
    for (int32_t i = 0; i < b->rows; i++) {
        sum += differences_reference(&r, b->n, moving);
        r.color += b->pitch;
        r.depth += b->pitch;
        r.behind += b->pitch_behind;
        r.deep += b->pitch_behind;
    }
    return sum;
}

#endif
