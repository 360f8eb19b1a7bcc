/* SPDX-License-Identifier: MIT */
/* line.c - the mean along the line on which each block of 8 x 8 pixels moves, and where its pixels do not move alike, along each one's own.
 * Where only the camera's motion is blurred, told from the block's depth, that is the plain form of [GPUGems3] chapter 27: the displacement
 * is kept as the velocity of the block's middle, and no other is looked at. */
#include "filter/filter.h"

#include "base/fixmath.h"
#include "filter/gather.h"
#include "kernels/line_means.h"

enum {
    TILE_MOST = 64,                 /* px wide */
    SHORT = 4, LONG = 8 * 4         /* quarters of a displacement's pixels: shorter ones do not leave the pixel */
};

/* Returns the edge of a block, px: tiles may be smaller than one usually is. */
static inline int32_t block_edge(const struct smear_window *w) { return min_i32(w->tile, 8); }

/* Returns which pixel of the window has the displacement of the block that has pixel (x, y): its middle. */
static inline uint32_t block_middle(const struct smear_window *w, int32_t x, int32_t y)
{
    const int32_t block = block_edge(w), half = block >> 1;
    x = min_i32((x & -block) + half, w->width - 1);
    return (uint32_t)(window_ring_row(w, min_i32((y & -block) + half, w->height - 1)) * w->width + x);
}

/* Pixels that share a displacement: rows [y0, y1) of the table, columns [x0, x1). */
struct block_run {
    int32_t x0, x1, y0, y1;
    int32_t taps, log;          /* twice as many as a mean takes, 2^log, where the way is long */
    int32_t x[2 * LINE_TAPS_MAX], y[2 * LINE_TAPS_MAX];         /* distances from a pixel to its taps, px */
    int32_t left, right;        /* how far they reach */
};

/* Returns the nearest depth code of the outer pixels of a block. */
static uint32_t nearest_of(const struct smear_window *w, int32_t x0, int32_t x1, int32_t y0, int32_t y1)
{
    uint32_t nearest = 0;
    for (int32_t y = y0; y < y1; y += y + 1 < y1 ? y1 - 1 - y0 : 1) {
        const uint16_t *depth = w->depth + window_ring_row(w, y) * w->width;
        nearest = max_u32(nearest, max_u32(depth[x0], depth[x1 - 1]));
    }
    return nearest;
}

/* Finds half the displacement of what is seen at a place, 1/8 px. It is no longer than the reach along either axis, the direction is
 * kept. */
static struct smear_pixel_velocity block_velocity(const struct smear_window *w, const struct smear_flow *flow, int32_t x, int32_t y,
                                                  uint32_t code)
{
    const int32_t most = w->reach * 512;
    int32_t d[2];
    smear_flow_at(flow, min_i32(x, w->width - 1), min_i32(y, w->height - 1), smear_depth_units((uint16_t)code), d);
    const int32_t length = max_i32(abs_i32(d[0]), abs_i32(d[1]));
    for (int i = 0; i < 2 && length > most; i++)
        d[i] = mul_shift(d[i], ratio_q30(most, length), 30);
    return (struct smear_pixel_velocity){ (d[0] + 32) >> 6, (d[1] + 32) >> 6 };
}

void smear_line_look(const struct smear_window *w, const struct smear_flow *flow, int32_t row, int32_t column)
{
    const int32_t x0 = column << w->tile_shift, x1 = min_i32(x0 + w->tile, w->width);
    const int32_t y0 = row << w->tile_shift, y1 = min_i32(y0 + w->tile, w->height);
    const int32_t block = block_edge(w);
    bool moves = false;
    for (int32_t y = y0; y < y1; y += block)
        for (int32_t x = x0; x < x1; x += block) {
            const uint32_t code = nearest_of(w, x, min_i32(x + block, x1), y, min_i32(y + block, y1));
            const struct smear_pixel_velocity v = block_velocity(w, flow, x + block / 2, y + block / 2, code);
            window_velocity_store(w, (int32_t)block_middle(w, x, y), v.x, v.y);
            moves = moves || (v.x | v.y) != 0;
        }
    window_around(w, row)[column].kind = moves ? TILE_UNIFORM : TILE_STATIC;
}

/* Places taps evenly on the way. */
static void block_taps(struct block_run *b, struct smear_pixel_velocity v, int32_t samples)
{
    const int32_t length = max_i32(abs_i32(v.x), abs_i32(v.y));
    const int32_t log = length < SHORT ? 0 : samples < 8 ? 2 : samples < 16 || length < LONG ? 3 : 4, n = 1 << log, half = 4 << log;
    for (int32_t k = 0; k < n; k++) {
        b->x[k] = (v.x * (2 * k + 1 - n) + half) >> (log + 3);
        b->y[k] = (v.y * (2 * k + 1 - n) + half) >> (log + 3);
    }
    b->left = min_i32(b->x[0], b->x[n - 1]);
    b->right = max_i32(b->x[0], b->x[n - 1]);
    b->taps = n;
    b->log = min_i32(log, LINE_TAPS_LOG_MAX);
}

/* Returns how many rows of a block from y on, all or one, lie at even distances in the table, as those do that taps meet. */
static int32_t rows_alike(const struct block_run *b, const uint32_t *row, int32_t y, int32_t width)
{
    const int32_t ends[2] = { b->y[0], b->y[b->taps - 1] };
    const int32_t first = y + min_i32(ends[0], ends[1]), last = b->y1 - 1 + max_i32(ends[0], ends[1]);
    return row[last] - row[first] == (uint32_t)((last - first) * width) ? b->y1 - y : 1;
}

/* Finds where taps from number `first` on lie from a pixel of columns [x, x + m->columns) in row y; within the frame. */
static void find_offsets(struct line_block *m, const struct block_run *b, const struct smear_window *w, const uint32_t *row, int32_t x,
                         int32_t y, int first)
{
    for (int k = 0; k < 1 << b->log; k++)
        m->offset[k] = (int32_t)(row[y + b->y[first + k]] - row[y]) + clamp_i32(b->x[first + k], -x, w->width - x - m->columns);
}

/* Blurs a block; columns whose taps lie beside the frame one by one. */
static void blur_block(uint32_t *out, const struct smear_window *w, const uint32_t *row, const struct block_run *b, bool linear)
{
    struct line_block m = { .in_stride = w->width, .out_stride = w->tile, .log = b->log };
    const int32_t inside = clamp_i32(w->width - b->right, b->x0, b->x1);
    for (int32_t y = b->y0; y < b->y1; y += m.rows, out += m.rows * w->tile) {
        m.rows = b->taps > LINE_TAPS_MAX ? 1 : rows_alike(b, row, y, w->width);
        for (int32_t x = b->x0; x < b->x1; x += m.columns) {
            m.columns = x + b->left >= 0 && x < inside ? inside - x : 1;
            m.in = w->color + row[y] + (uint32_t)x;
            m.out = out + (x - b->x0);
            find_offsets(&m, b, w, row, x, y, 0);
            smear_line_means(&m, linear);
            if (b->taps > LINE_TAPS_MAX) {
                uint32_t more[TILE_MOST];
                uint32_t *const mean = m.out;
                find_offsets(&m, b, w, row, x, y, LINE_TAPS_MAX);
                m.out = more;
                smear_line_means(&m, linear);
                smear_line_mix(mean, more, NULL, m.columns, 1, linear);
            }
        }
    }
}

/* Takes the mean of n taps at the midpoints of n equal parts of [-v, v], where `step` is 2 v / n in q16 px. Where things that move with
 * the camera may be in front (`held`), a tap that meets one, static and nearer, counts as the pixel itself. */
static uint32_t mean_along(const struct smear_window *w, const uint32_t *row_offset, uint32_t at, int32_t x, int32_t y,
                           struct vector step, int32_t n, uint32_t over, const struct smear_blur_settings *settings)
{
    int32_t dx = -(step.x >> 1) - (n / 2 - 1) * step.x, dy = -(step.y >> 1) - (n / 2 - 1) * step.y;
    const bool held = SMEAR_WITH_FILTERS && settings->held;
    struct even_sum sum = { 0, 0, 0, 0, 0 };
    for (int32_t i = n; i > 0; i--, dx += step.x, dy += step.y) {
        const int32_t column = clamp_i32(((x << 16) + 0x8000 + dx) >> 16, 0, w->width - 1);
        uint32_t tap = row_offset[((y << 16) + 0x8000 + dy) >> 16] + (uint32_t)column;
        if (held && w->depth[tap] > w->depth[at] && window_velocity_word(w, tap) == 0)
            tap = at;
        even_add(&sum, w->color[tap], settings);
    }
    return even_mean(&sum, over, held, settings);
}

/* Takes the mean of pixels [x0, x1) x [y0, y1) of the table along each one's own velocity: a tap per pixel of `travel`, the longest of
 * both axes in 1/4 px, but no more than `samples`. They are pairs. */
static uint32_t blur_own(uint32_t *out, const struct smear_window *w, const uint32_t *row, const struct block_run *b, int32_t travel,
                         const struct smear_blur_settings *settings)
{
    const int32_t n = max_i32(min_i32((travel >> 1) + 3, clamp_i32(settings->samples, 2, 128) * 2) >> 2 << 1, 2);
    const uint32_t over = ((1u << 24) + (uint32_t)n - 1u) / (uint32_t)n;
    uint32_t taken = 0;
    for (int32_t y = b->y0; y < b->y1; y++, out += w->tile)
        for (int32_t x = b->x0; x < b->x1; x++) {
            const uint32_t at = row[y] + (uint32_t)x;
            const struct smear_pixel_velocity v = window_velocity(w, at);       /* q3 */
            if (max_i32(abs_i32(v.x), abs_i32(v.y)) < SHORT) {
                out[x - b->x0] = w->color[at];
                continue;
            }
            const struct vector step = { v.x * (int32_t)(over >> 8) >> 2, v.y * (int32_t)(over >> 8) >> 2 };
            out[x - b->x0] = mean_along(w, row, at, x, y, step, n, over, settings);
            taken += (uint32_t)n;
        }
    return taken;
}

/* Whether pixels of a block, which has rows [y0, y1) of the frame, move like its middle: by its corners. */
static bool moves_alike(const struct smear_window *w, const struct block_run *b, int32_t y0, int32_t y1, struct smear_pixel_velocity v)
{
    enum { ALIKE = 6 };         /* 1/8 px */
    bool alike = true;
    for (int i = 0; i < 4; i++) {
        const int32_t row = window_ring_row(w, i & 1 ? y1 - 1 : y0) * w->width;
        const struct smear_pixel_velocity c = window_velocity(w, (uint32_t)(row + (i & 2 ? b->x1 - 1 : b->x0)));
        alike = alike && max_i32(abs_i32(c.x - v.x), abs_i32(c.y - v.y)) <= ALIKE;
    }
    return alike;
}

uint32_t smear_blur_mean(uint32_t *out, const struct smear_window *w, const struct smear_row_table *rows, int32_t row, int32_t column,
                         const struct smear_blur_settings *settings)
{
    const int32_t left = column << w->tile_shift, right = min_i32(left + w->tile, w->width), block = block_edge(w);
    const struct smear_tile_motion *m = &window_motion(w, row)[column];
    const int32_t travel = max_i32(abs_i32(m->x), abs_i32(m->y));
    /* What stays where it is must not be blurred. */
    const bool own = !settings->lines;
    const bool may_stay = own && (settings->held || (m->min_x <= 0 && m->max_x >= 0 && m->min_y <= 0 && m->max_y >= 0));
    uint32_t taken = 0;
    for (int32_t y = rows->y0, next; y < rows->y1; y = next) {
        const int32_t top = y & -block, bottom = min_i32(top + block, w->height);
        next = min_i32(bottom, rows->y1);
        for (int32_t x = left; x < right; x += block) {
            const struct smear_pixel_velocity v = window_velocity(w, block_middle(w, x, y));
            struct block_run b = { .x0 = x, .x1 = min_i32(x + block, right), .y0 = y - rows->first, .y1 = next - rows->first };
            uint32_t *to = out + (y - rows->y0) * w->tile + (x - left);
            if (own && (may_stay || !moves_alike(w, &b, top, bottom, v))) {
                taken += blur_own(to, w, rows->offset, &b, travel, settings);
                continue;
            }
            block_taps(&b, v, settings->samples);
            blur_block(to, w, rows->offset, &b, transfer_is_linear(settings->transfer));
            taken += (uint32_t)((b.x1 - b.x0) * (b.y1 - b.y0) * b.taps);
        }
    }
    return taken;
}
