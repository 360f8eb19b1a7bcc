/* SPDX-License-Identifier: MIT */
/* tilemax.c - the tile maximum and neighbour maximum of [McGuire12], exact at every size. */
#include "filter/filter.h"

#include "base/fixmath.h"

/* Beyond these, measured on the scenes of the quality suite, the mean along the own velocity loses to weighted taps. */
enum {
    small_spread = 6,           /* 1/8 px: the widest range of velocities that all count as one, */
    small_step = 16,            /* 1/8 px: the largest step of velocity from pixel to pixel that does not show, */
    small_share = 2,            /* or 1/2^small_share of the longest motion */
    small_carry = 32            /* 1/8 px: less motion along an axis hardly carries anything out of a tile */
};

/* Returns the step from one velocity to another. One of a pixel and more from what stands still is an edge where all is slow: what is
 * carried over it is seen. */
static int32_t change(struct smear_pixel_velocity a, struct smear_pixel_velocity b)
{
    const int32_t step = max_i32(abs_i32(a.x - b.x), abs_i32(a.y - b.y));
    return step >= 8 && ((a.x | a.y) == 0 || (b.x | b.y) == 0) ? max_i32(step, small_step + 1) : step;
}

/* Whether n velocities of a row are those above them, as most are: blocks of pixels share one. */
static bool are_as_above(const struct smear_window *w, uint32_t at, uint32_t above, int32_t n)
{
    const uint32_t end = at + (uint32_t)n;
    uint32_t differs = 0;
    if (w->velocity8 == NULL)
        for (; at < end; at++, above++)
            differs |= velocity_word(NULL, w->velocity16, at) ^ velocity_word(NULL, w->velocity16, above);
    for (; at < end; at++, above++)
        differs |= velocity_word(w->velocity8, NULL, at) ^ velocity_word(w->velocity8, NULL, above);
    return differs == 0;
}

void smear_tilemax(const struct smear_window *w, int32_t row, int32_t column)
{
    struct smear_tile_motion m = { 0, 0, INT16_MAX, INT16_MIN, INT16_MAX, INT16_MIN };
    int32_t longest = -1, rough = 0;
    int32_t x0 = column << w->tile_shift, n = min_i32(w->tile, w->width - x0);
    int32_t y0 = row << w->tile_shift, y1 = min_i32(y0 + w->tile, w->height);
    for (int32_t y = y0; y < y1; y++) {
        uint32_t at = (uint32_t)(window_ring_row(w, y) * w->width + x0), end = at + (uint32_t)n;
        uint32_t above = (uint32_t)(window_ring_row(w, max_i32(y - 1, 0)) * w->width + x0);
        const uint32_t before = x0 > 0;
        if (y > y0 && are_as_above(w, at - before, above - before, n + (int32_t)before))
            continue;
        struct smear_pixel_velocity last = window_velocity(w, at - before);
        uint32_t last_word = ~window_velocity_word(w, at);
        for (; at < end; at++, above++) {
            const uint32_t word = window_velocity_word(w, at);
            if (word == last_word && word == window_velocity_word(w, above))       /* as most: what is known of the last one holds */
                continue;
            last_word = word;
            const struct smear_pixel_velocity v = window_velocity(w, at);
            const int32_t square = v.x * v.x + v.y * v.y;
            if (square > longest) {
                longest = square;
                m.x = (int16_t)v.x;
                m.y = (int16_t)v.y;
            }
            m.min_x = (int16_t)min_i32(m.min_x, v.x);
            m.max_x = (int16_t)max_i32(m.max_x, v.x);
            m.min_y = (int16_t)min_i32(m.min_y, v.y);
            m.max_y = (int16_t)max_i32(m.max_y, v.y);
            rough = max_i32(rough, max_i32(change(v, last), change(v, window_velocity(w, above))));
            last = v;
        }
    }
    window_motion(w, row)[column] = m;
    window_around(w, row)[column].rough = (uint8_t)min_i32(rough, 255);
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

static bool moves(const struct smear_tile_motion *m)
{
    return (m->min_x | m->max_x | m->min_y | m->max_y) != 0;
}

/* Returns how far two ranges of velocities lie apart. */
static int32_t gap(const struct smear_tile_motion *a, const struct smear_tile_motion *b)
{
    int32_t x = max_i32(a->min_x - b->max_x, b->min_x - a->max_x);
    int32_t y = max_i32(a->min_y - b->max_y, b->min_y - a->max_y);
    return max_i32(max_i32(x, y), 0);
}

/* The tiles of the 3 x 3 that exist and are known, in row order. */
struct neighbors {
    const struct smear_tile_motion *motion[9];
    int32_t rough[9];
    int8_t dx[9], dy[9];
    int count;
};

static void collect(struct neighbors *n, const struct smear_window *w, int32_t row, int32_t column,
                    int32_t known)
{
    n->count = 0;
    for (int32_t dy = -1; dy <= 1; dy++) {
        if (row + dy < 0 || row + dy > known)
            continue;
        for (int32_t dx = -1; dx <= 1; dx++) {
            if (column + dx < 0 || column + dx >= w->columns)
                continue;
            const struct smear_tile_motion *m = &window_motion(w, row + dy)[column + dx];
            n->motion[n->count] = m;
            n->rough[n->count] = moves(m) ? window_around(w, row + dy)[column + dx].rough : 0;
            n->dx[n->count] = (int8_t)dx;
            n->dy[n->count++] = (int8_t)dy;
        }
    }
}

/* Whether all motion that can carry anything into or out of the tile is alike or changes without a step.
 * Along an axis on which nothing moves far, neighbours do not matter. */
static bool is_uniform(const struct neighbors *n, const struct smear_tile_motion *here)
{
    struct smear_tile_motion all = *here;
    for (int i = 0; i < n->count; i++) {
        const struct smear_tile_motion *m = n->motion[i];
        all.min_x = (int16_t)min_i32(all.min_x, m->min_x);
        all.max_x = (int16_t)max_i32(all.max_x, m->max_x);
        all.min_y = (int16_t)min_i32(all.min_y, m->min_y);
        all.max_y = (int16_t)max_i32(all.max_y, m->max_y);
    }
    int32_t widest = max_i32(max_i32(all.max_x, -all.min_x), max_i32(all.max_y, -all.min_y));
    int32_t spread = max_i32(all.max_x - all.min_x, all.max_y - all.min_y);
    if (spread <= max_i32(small_spread, widest >> small_share))
        return true;
    bool sideways = max_i32(all.max_x, -all.min_x) >= small_carry;
    bool upright = max_i32(all.max_y, -all.min_y) >= small_carry;
    int32_t step = max_i32(small_step, widest >> small_share);
    for (int i = 0; i < n->count; i++) {
        if ((n->dx[i] != 0 && !sideways) || (n->dy[i] != 0 && !upright))
            continue;
        if (n->rough[i] > step || gap(n->motion[i], here) > step)
            return false;
    }
    return true;
}

/* Finds the longest motion of a neighbourhood as PPSv2 does: the centre's counts 1.01 times, and the winner is
 * shortened by 1.01. */
static void neighborhood(const struct smear_window *w, int32_t row, int32_t column, int32_t known,
                         bool corner)
{
    struct smear_tile_neighborhood *out = &window_around(w, row)[column];
    const struct smear_tile_motion *best = NULL, *here = &window_motion(w, row)[column];
    struct neighbors n;
    uint32_t longest = 0;
    bool is_static = true;
    collect(&n, w, row, column, known);
    for (int i = 0; i < n.count; i++) {
        const struct smear_tile_motion *m = n.motion[i];
        bool centre = m == here;
        /* Squares stay below 2^18 (64 px), 1.01^2 = 10201 / 10000 of them below 2^32. */
        uint32_t square = (uint32_t)(m->x * m->x + m->y * m->y) * (centre ? 10201u : 10000u);
        is_static = is_static && !moves(m);
        if ((best == NULL || square > longest) && (!corner || points_here(m, n.dx[i], n.dy[i]))) {
            longest = square;
            best = m;
        }
    }
    /* 1/8 px to 1/256 px is 32; 32 / 1.01 = 31.6832, or 64887 / 2^11. */
    int32_t scale = best == here ? 65536 : 64887;
    out->x = (int16_t)((best->x * scale + 0x400) >> 11);
    out->y = (int16_t)((best->y * scale + 0x400) >> 11);
    out->kind = is_static ? TILE_STATIC : is_uniform(&n, here) ? TILE_UNIFORM : TILE_COMPLEX;
}

/* Whether any motion of a tile may come to the tile that lies dx, dy tiles from it: by the box of its displacements. */
static bool comes_near(const struct smear_window *w, const struct smear_tile_motion *m, int32_t dx,
                       int32_t dy)
{
    int32_t x = max_i32(m->max_x, -m->min_x), y = max_i32(m->max_y, -m->min_y);
    return max_i32(abs_i32(dx) - 1, 0) * w->tile * 8 <= x + 8
        && max_i32(abs_i32(dy) - 1, 0) * w->tile * 8 <= y + 8 && (x | y) != 0;
}

/* Whether the longest motion of a tile comes there: by a line as wide as two tiles and a tile longer than the
 * motion. */
static bool comes_along(const struct smear_window *w, const struct smear_tile_motion *m, int32_t dx,
                        int32_t dy)
{
    int32_t square = m->x * m->x + m->y * m->y, tile = w->tile * 8;                     /* 1/8 px */
    int32_t length = (int32_t)(sqrt_q3((uint32_t)square) + 7u) >> 3;
    int32_t along = abs_i32(dx * m->x + dy * m->y) * tile, across = abs_i32(dx * m->y - dy * m->x) * tile;
    return along <= square + tile * length && across <= tile * length;
}

/* Finds the longest motion of all that lead over the tile, its own first. Filters scatter each tile's longest motion to
 * the tiles along its direction, as far as the reach goes; here each tile looks for those that come to it, so that
 * tiles may be done in any order. */
static void scattered(const struct smear_window *w, int32_t row, int32_t column, int32_t known)
{
    struct smear_tile_neighborhood *out = &window_around(w, row)[column];
    const struct smear_tile_motion *here = &window_motion(w, row)[column], *best = here;
    uint32_t longest = (uint32_t)(here->x * here->x + here->y * here->y);
    bool is_static = !moves(here);
    for (int32_t dy = -w->lag; dy <= w->lag; dy++) {
        if (row + dy < 0 || row + dy > known)
            continue;
        for (int32_t dx = -w->lag; dx <= w->lag; dx++) {
            if (column + dx < 0 || column + dx >= w->columns)
                continue;
            const struct smear_tile_motion *m = &window_motion(w, row + dy)[column + dx];
            if (!comes_near(w, m, dx, dy))
                continue;
            is_static = false;
            uint32_t square = (uint32_t)(m->x * m->x + m->y * m->y);
            if (square > longest && comes_along(w, m, dx, dy)) {
                longest = square;
                best = m;
            }
        }
    }
    out->x = (int16_t)(best->x * 32);
    out->y = (int16_t)(best->y * 32);
    out->kind = is_static ? TILE_STATIC : TILE_COMPLEX;
}

void smear_neighbormax_row(const struct smear_window *w, int32_t row, int32_t known, bool corner)
{
    for (int32_t column = 0; column < w->columns; column++) {
        if (SMEAR_WITH_FILTERS && w->lag > 1)       /* desc.filter.scatter */
            scattered(w, row, column, known);
        else
            neighborhood(w, row, column, known, corner);
    }
}
