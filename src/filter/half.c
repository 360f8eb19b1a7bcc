/* SPDX-License-Identifier: MIT */
/* half.c - reduces 2 x 2 pixels to one, and blends them with what a filter makes of that one. */
#include "filter/filter.h"

#include "base/pixel.h"

/* Returns the mean of four pixels; that of equal ones is exact. */
static uint32_t mean_of(uint32_t a, uint32_t b, uint32_t c, uint32_t d, smear_transfer transfer)
{
    const uint32_t pixel[4] = { a, b, c, d };
    uint32_t out = 0;
    for (int shift = 0; shift < 24; shift += 8) {
        uint32_t sum = 0;
        for (int i = 0; i < 4; i++)
            sum += value_of_code(pixel[i] >> shift & 255u, transfer);
        out |= code_of_value((sum + (channel_round(transfer) >> 14)) >> 2, transfer) << shift;
    }
    return out;
}

/* Returns half of a velocity's component to nearest, symmetric about zero. */
static inline int32_t half_of(int32_t v)
{
    return v < 0 ? -((1 - v) >> 1) : (v + 1) >> 1;
}

void smear_half_reduce(const struct smear_window *half, const struct smear_window *full, int32_t row,
                       int32_t column, smear_transfer transfer)
{
    int32_t x0 = column << half->tile_shift, x1 = min_i32(x0 + half->tile, half->width);
    int32_t y0 = row << half->tile_shift, y1 = min_i32(y0 + half->tile, half->height);
    const int32_t limit = half->reach * 8;
    for (int32_t y = y0; y < y1; y++) {
        int32_t above = window_ring_row(full, 2 * y) * full->width;
        int32_t below = window_ring_row(full, min_i32(2 * y + 1, full->height - 1)) * full->width;
        int32_t to = window_ring_row(half, y) * half->width;
        for (int32_t x = x0; x < x1; x++) {
            int32_t left = 2 * x, right = min_i32(2 * x + 1, full->width - 1);
            const int32_t at[4] = { above + left, above + right, below + left, below + right };
            int32_t nearest = at[0];
            for (int i = 1; i < 4; i++)
                if (full->depth[at[i]] > full->depth[nearest])
                    nearest = at[i];
            struct smear_pixel_velocity v = window_velocity(full, (uint32_t)nearest);
            half->color[to + x] = mean_of(full->color[at[0]], full->color[at[1]], full->color[at[2]],
                                          full->color[at[3]], transfer);
            half->depth[to + x] = full->depth[nearest];
            /* Rounding up may leave the reach by a part of a step. */
            window_velocity_store(half, to + x, clamp_i32(half_of(v.x), -limit, limit),
                                  clamp_i32(half_of(v.y), -limit, limit));
        }
    }
}

/* Returns what motion of v along an axis (half the exposure's, 1/8 px) leaves of the detail along it, 0 .. 256: all up
 * to 1/2 px, none from 2 px on. */
static inline int32_t kept_share(int32_t v)
{
    return 256 - clamp_i32((abs_i32(v) - 4) * 21, 0, 256);
}

/* A pixel's share of detail along x, along y and along both. */
struct shares {
    int32_t x, y, both;
};

static struct shares shares_of(const struct smear_window *full, int32_t at)
{
    struct smear_pixel_velocity v = window_velocity(full, (uint32_t)at);
    struct shares s = { kept_share(v.x), kept_share(v.y), 0 };
    s.both = min_i32(s.x, s.y);
    return s;
}

/* Blends one channel of the four pixels of a block (row by row): four times the blur, and of each difference within the
 * block what motion leaves. */
static void blend_channel(uint32_t out[4], const uint32_t own[4], uint32_t blur, uint32_t sharp,
                          const struct shares share[4], int shift)
{
    const int32_t a = (int32_t)(own[0] >> shift & 255u), b = (int32_t)(own[1] >> shift & 255u);
    const int32_t c = (int32_t)(own[2] >> shift & 255u), d = (int32_t)(own[3] >> shift & 255u);
    const int32_t base = (int32_t)(blur >> shift & 255u) * 4;
    const int32_t mean = a + b + c + d - (int32_t)(sharp >> shift & 255u) * 4;
    const int32_t along_x = a - b + c - d, along_y = a + b - c - d, both = a - b - c + d;
    for (int i = 0; i < 4; i++) {
        int32_t x = i & 1 ? -along_x : along_x, y = i & 2 ? -along_y : along_y;
        int32_t xy = i == 1 || i == 2 ? -both : both;
        int32_t detail = x * share[i].x + y * share[i].y + (mean + xy) * share[i].both;
        out[i] |= (uint32_t)clamp_i32((base + (detail >> 8) + 2) >> 2, 0, 255) << shift;
    }
}

void smear_half_blend(uint32_t *out, const uint32_t *blurred, const struct smear_window *half,
                      const struct smear_window *full, int32_t row, int32_t column)
{
    const int32_t tile = full->tile;
    int32_t x0 = column << full->tile_shift, x1 = min_i32(x0 + tile, full->width);
    int32_t y0 = row << full->tile_shift, y1 = min_i32(y0 + tile, full->height);
    for (int32_t y = y0; y < y1; y += 2, out += 2 * tile, blurred += half->tile) {
        /* What lies beyond the frame stands for its last row or column, and is not written. */
        int32_t upper = window_ring_row(full, y) * full->width;
        int32_t lower = window_ring_row(full, min_i32(y + 1, full->height - 1)) * full->width;
        const uint32_t *before = half->color + window_ring_row(half, y >> 1) * half->width;
        for (int32_t x = x0; x < x1; x += 2) {
            int32_t right = min_i32(x + 1, full->width - 1), count_x = min_i32(2, x1 - x),
                    count_y = min_i32(2, y1 - y);
            const int32_t at[4] = { upper + x, upper + right, lower + x, lower + right };
            uint32_t own[4], mixed[4] = { 0, 0, 0, 0 };
            struct shares share[4];
            for (int i = 0; i < 4; i++) {
                own[i] = full->color[at[i]];
                share[i] = shares_of(full, at[i]);
            }
            for (int shift = 0; shift < 24; shift += 8)
                blend_channel(mixed, own, blurred[(x - x0) >> 1], before[x >> 1], share, shift);
            for (int32_t j = 0; j < count_y; j++)
                for (int32_t i = 0; i < count_x; i++)
                    out[j * tile + x - x0 + i] = mixed[2 * j + i];
        }
    }
}
