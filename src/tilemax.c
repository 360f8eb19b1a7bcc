/* SPDX-License-Identifier: MIT */
/* tilemax.c - the tile maximum and neighbour maximum of [McGuire12], exact at every size. */
#include "tilemax.h"

#include "fixmath.h"

void smear_tilemax(const struct smear_window *w, int32_t row, int32_t column)
{
    struct smear_tile_motion m = { 0, 0, INT16_MAX, INT16_MIN, INT16_MAX, INT16_MIN };
    int32_t longest = -1;
    int32_t x0 = column << w->tile_shift, x1 = min_i32(x0 + w->tile, w->width);
    int32_t y0 = row << w->tile_shift, y1 = min_i32(y0 + w->tile, w->height);
    for (int32_t y = y0; y < y1; y++) {
        int32_t at = window_slot(w, y) * w->width;
        for (int32_t x = x0; x < x1; x++) {
            int32_t vx, vy;
            if (w->velocity8 != NULL) {
                vx = w->velocity8[2 * (at + x)];
                vy = w->velocity8[2 * (at + x) + 1];
            } else {
                vx = w->velocity16[2 * (at + x)];
                vy = w->velocity16[2 * (at + x) + 1];
            }
            int32_t square = vx * vx + vy * vy;
            if (square > longest) {
                longest = square;
                m.x = (int16_t)vx;
                m.y = (int16_t)vy;
            }
            m.min_x = (int16_t)min_i32(m.min_x, vx);
            m.max_x = (int16_t)max_i32(m.max_x, vx);
            m.min_y = (int16_t)min_i32(m.min_y, vy);
            m.max_y = (int16_t)max_i32(m.max_y, vy);
        }
    }
    window_motion(w, row)[column] = m;
}

static int sign(int32_t a)
{
    return (a > 0) - (a < 0);
}

static bool points_here(const struct smear_tile_motion *m, int32_t dx, int32_t dy)
{
    int s = sign(dx * m->x) + sign(dy * m->y);
    return dx == 0 || dy == 0 || s == 2 || s == -2;
}

/* As in PPSv2: the centre's motion counts 1.01 times, and the winner is shortened by 1.01. */
static void neighborhood(const struct smear_window *w, int32_t row, int32_t column, int32_t known,
                         bool corner)
{
    struct smear_tile_neighborhood *out = &window_around(w, row)[column];
    struct smear_tile_motion best = { 0, 0, 0, 0, 0, 0 };
    int64_t longest = -1;
    bool centre_wins = true;
    int32_t min_x = INT16_MAX, max_x = INT16_MIN, min_y = INT16_MAX, max_y = INT16_MIN;
    for (int32_t dy = -1; dy <= 1; dy++) {
        if (row + dy < 0 || row + dy > known)
            continue;
        for (int32_t dx = -1; dx <= 1; dx++) {
            if (column + dx < 0 || column + dx >= w->columns)
                continue;
            const struct smear_tile_motion *m = &window_motion(w, row + dy)[column + dx];
            min_x = min_i32(min_x, m->min_x);
            max_x = max_i32(max_x, m->max_x);
            min_y = min_i32(min_y, m->min_y);
            max_y = max_i32(max_y, m->max_y);
            int64_t square = (int64_t)(m->x * m->x + m->y * m->y) * (dx == 0 && dy == 0 ? 10201 : 10000);
            if (square > longest && (!corner || points_here(m, dx, dy))) {
                longest = square;
                best = *m;
                centre_wins = dx == 0 && dy == 0;
            }
        }
    }
    /* 1/8 px to 1/256 px is 32; 32 / 1.01 = 31.6832, or 2076389 / 2^16. */
    const int64_t centre_scale = 2097152, other_scale = 2076389;
    int64_t scale = centre_wins ? centre_scale : other_scale;
    out->x = (int16_t)((best.x * scale + 0x8000) >> 16);
    out->y = (int16_t)((best.y * scale + 0x8000) >> 16);
    int32_t spread = max_i32(max_x - min_x, max_y - min_y);
    int32_t length = (int32_t)sqrt_q3((uint32_t)(best.x * best.x + best.y * best.y)) >> 3;
    out->kind = (max_x | max_y | min_x | min_y) == 0 ? TILE_STILL
              : spread <= max_i32(6, length >> 2) ? TILE_UNIFORM : TILE_COMPLEX;
}

void smear_neighbormax_row(const struct smear_window *w, int32_t row, int32_t known, bool corner)
{
    for (int32_t column = 0; column < w->columns; column++)
        neighborhood(w, row, column, known, corner);
}
