/* SPDX-License-Identifier: MIT */
/* lines.c - see lines.h.
 *
 *     for each row of blocks, for each run of blocks with the same displacement:
 *         taps    where its line meets pixels
 *         means   of the pixels there (kernels/line_means.h) */
#include "temporal/lines.h"

#include "kernels/line_means.h"

enum { BLOCK = LINE_BLOCK };

/* Distances from a pixel to its taps, px, and how far they reach. */
struct taps {
    int32_t log;                    /* there are 2^log */
    int32_t x[LINE_TAPS_MAX], y[LINE_TAPS_MAX];
    int32_t left, right, up, down;
    bool sparse;                    /* every fourth pixel tells what lies between, as the line is long and level */
};

void smear_lines_make_flow(struct smear_flow *flow, const struct smear_shot *shot, const struct smear_window *w,
                           const smear_camera camera[3])
{
    const struct smear_shutter_order at = smear_shot_order(shot);
    const struct smear_instant middle = smear_instant_middle(shot);
    const bool spans = shot_spans_exposure(shot);
    struct smear_reprojection r;
    smear_reproject_make(&r, &camera[at.middle], &camera[at.open], &camera[at.close], spans ? smear_instant_now.weight : middle.weight,
                         spans, w->width, w->height);
    smear_flow_make(flow, &r, spans ? 65536 : shot->half_exposure >> 7);
}

void smear_lines_begin(struct smear_lines *lines, const struct smear_shot *shot, const struct smear_window *w, int pictures, bool linear)
{
    enum { QUARTER = 32768 };           /* of the exposure, from its middle */
    lines->linear = linear;
    lines->pictures = (uint8_t)pictures;
    lines->picture = 0;
    lines->movers = 0;
    lines->instant[0] = pictures == 1 ? smear_instant_middle(shot) : smear_instant_at(shot, -QUARTER);
    lines->instant[1] = smear_instant_at(shot, QUARTER);
    smear_lines_make_flow(&lines->flow, shot, w, shot->camera);
}

void smear_lines_mix(const struct smear_lines *lines, const struct smear_window *w, int32_t x0, int32_t x1, int32_t y)
{
    uint32_t *const first = w->color + window_ring_row(w, y) * w->width + x0;
    const uint32_t *const second = lines->row + (y & (w->tile - 1)) * w->width + x0;
    const struct line_block b = { .in = first, .out = first, .columns = x1 - x0, .rows = 1, .log = 1,
                                  .offset = { 0, (int32_t)(second - first) } };
    smear_line_means(&b, lines->linear);
}

void smear_lines_take_depth(const struct smear_lines *lines, const struct smear_window *w, int32_t x0, int32_t x1, int32_t y)
{
    __builtin_memcpy(lines->depth + (y & (w->tile - 1)) * w->width + x0, w->depth + window_ring_row(w, y) * w->width + x0,
                     (size_t)(x1 - x0) * sizeof *lines->depth);
}

void smear_lines_displacement(int32_t out[2], const struct smear_lines *lines, const struct smear_flow *flow, const struct smear_window *w,
                              int32_t x, int32_t y, uint32_t depth)
{
    enum { STEP = 256 };
    const int32_t most_y = 2 * 256 * w->reach, most_x = 256 * w->width;
    smear_flow_at(flow, x, y, smear_depth_units((uint16_t)depth), out);
    for (int i = 0; i < 2; i++)
        out[i] >>= lines->pictures - 1;
    for (int i = 0; i < 2; i++) {
        const int32_t most = i == 0 ? most_x : most_y, length = abs_i32(out[i]);
        if (length <= most)
            continue;
        out[1 - i] = (out[1 - i] >> 4) * (int32_t)(((uint32_t)most << 11) / (uint32_t)length) >> 7;
        out[i] = out[i] < 0 ? -most : most;
    }
    out[0] = (out[0] + STEP / 2) & -STEP;
    out[1] = (out[1] + STEP / 2) & -STEP;
}

/* Places two taps per pixel of the way, evenly. */
static void place_taps(struct taps *t, int32_t x, int32_t y)
{
    enum { LONG = 8 * 256,              /* so that what is four pixels beside each other on it is nearly alike, */
           LEVEL_LOG2 = 1 };            /* and two lie between them across */
    const int32_t length = max_i32(abs_i32(x), abs_i32(y));
    int32_t log = 0;
    while (log < LINE_TAPS_LOG_MAX && length << 1 > 256 << log)
        log++;
    const int32_t n = 1 << log, down = log + 1 + 8, half = n << 8;
    for (int32_t k = 0; k < n; k++) {
        t->x[k] = (x * (2 * k + 1 - n) + half) >> down;
        t->y[k] = (y * (2 * k + 1 - n) + half) >> down;
    }
    t->log = log;
    t->sparse = length >= LONG && abs_i32(y) << LEVEL_LOG2 <= length;
    t->left = min_i32(t->x[0], t->x[n - 1]);
    t->right = max_i32(t->x[0], t->x[n - 1]);
    t->up = min_i32(t->y[0], t->y[n - 1]);
    t->down = max_i32(t->y[0], t->y[n - 1]);
}

/* Blurs columns [x0, x1) of rows [y0, y1), as many at once as no tap meets the end of the ring in. Taps lie in the frame and in rows
 * that are drawn. */
static void blur_within(const struct smear_lines *lines, const struct smear_window *w, const struct taps *t, int32_t x0, int32_t x1,
                        int32_t y0, int32_t y1)
{
    int32_t at = window_ring_row(w, y0);
    struct line_block b = { .in_stride = w->width, .out_stride = w->width, .columns = x1 - x0, .log = t->log,
                            .sparse = t->sparse && ((x1 - x0) & (LINE_SPARSE - 1)) == 0 };
    for (int32_t y = y0; y < y1; y += b.rows) {
        b.rows = min_i32(y1 - y, w->ring - at);
        for (int k = 0; k < 1 << t->log; k++) {
            int32_t row = at + t->y[k];
            row += row < 0 ? w->ring : row >= w->ring ? -w->ring : 0;
            b.rows = min_i32(b.rows, w->ring - row);
            b.offset[k] = (row - at) * w->width + t->x[k];
        }
        b.in = w->color + at * w->width + x0;
        b.out = lines->row + (y & (w->tile - 1)) * w->width + x0;
        smear_line_means(&b, lines->linear);
        at += b.rows;
        at -= at == w->ring ? w->ring : 0;
    }
}

/* Returns taps that lie so far aside, up and down at most. */
static struct taps taps_within(const struct taps *all, int32_t left, int32_t right, int32_t up, int32_t down)
{
    struct taps t = *all;
    for (int k = 0; k < 1 << t.log; k++) {
        t.x[k] = clamp_i32(t.x[k], left, right);
        t.y[k] = clamp_i32(t.y[k], up, down);
    }
    t.up = max_i32(t.up, up);
    t.down = min_i32(t.down, down);
    return t;
}

void smear_lines_blur_blocks(const struct smear_lines *lines, const struct smear_window *w, const int32_t d[2], int32_t x0, int32_t x1,
                             int32_t y0, int32_t y1, int32_t first, int32_t end)
{
    struct taps all;
    place_taps(&all, d[0], d[1]);
    const struct taps t = taps_within(&all, -w->width, w->width, first - y0, end - y1);
    for (int32_t x = x0, next; x < x1; x = next) {
        next = min_i32(x + BLOCK, x1);
        if (x + t.left < 0 || next + t.right + t.sparse > w->width) {
            struct taps inside = taps_within(&t, -x, w->width - next, first - y0, end - y1);
            inside.sparse = false;
            blur_within(lines, w, &inside, x, next, y0, y1);
            continue;
        }
        while (next < x1 && min_i32(next + BLOCK, x1) + t.right + t.sparse <= w->width)
            next = min_i32(next + BLOCK, x1);
        blur_within(lines, w, &t, x, next, y0, y1);
    }
}

void smear_lines_blur(const struct smear_lines *lines, const struct smear_window *w, int32_t x0, int32_t x1, int32_t y0, int32_t y1,
                      int32_t end)
{
    for (int32_t y = y0; y < y1; y += BLOCK) {
        const int32_t bottom = min_i32(y + BLOCK, y1), middle = min_i32(y + BLOCK / 2, y1 - 1);
        const uint16_t *depth = w->depth + window_ring_row(w, middle) * w->width;
        const int32_t from = min_i32(x0 + BLOCK / 2, x1 - 1);
        int32_t d[2], next[2];
        smear_lines_displacement(next, lines, &lines->flow, w, from, middle, depth[from]);
        for (int32_t x = x0, right; x < x1; x = right) {
            d[0] = next[0];
            d[1] = next[1];
            for (right = x + BLOCK; right < x1; right += BLOCK) {
                const int32_t at = min_i32(right + BLOCK / 2, x1 - 1);
                smear_lines_displacement(next, lines, &lines->flow, w, at, middle, depth[at]);
                if (next[0] != d[0] || next[1] != d[1])
                    break;
            }
            right = min_i32(right, x1);
            smear_lines_blur_blocks(lines, w, d, x, right, y, bottom, 0, end);
        }
    }
}
