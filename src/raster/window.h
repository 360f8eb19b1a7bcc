/* SPDX-License-Identifier: MIT */
/* window.h - the rolling window: the rows of the sharp frame that a filter may still read.
 *
 * A ring of pixel rows: the tile row being finished, the one below it, and `reach` rows of the one above.
 * Where the reach exceeds a tile (desc.scatter), as many tile rows below it as that covers.
 *
 *      row - 2    row - 1    row
 *      (reach)    finished   drawn        the oldest rows are overwritten next
 *
 * Depth, velocity and colour are planes of one shape. Velocities take 8 bits per axis where the reach allows
 * (1/8 px steps up to 15 px), 16 where it does not. */
#ifndef SMEAR_WINDOW_H
#define SMEAR_WINDOW_H

#include "base/fixed.h"

/* Velocity class of a tile. */
enum smear_tile_class { TILE_STATIC, TILE_UNIFORM, TILE_COMPLEX };

/* What is known of a tile's velocities, in 1/8 px; of all its pixels inside the frame. */
struct smear_tile_motion {
    int16_t x, y;                   /* the longest; of equals the first in row order */
    int16_t min_x, max_x, min_y, max_y;
};

struct smear_tile_neighborhood {
    int16_t x, y;                   /* longest of the 3 x 3 tiles, in 1/256 px */
    uint8_t kind;                   /* smear_tile_class */
    uint8_t rough;                  /* of the tile itself: largest change of velocity from a pixel to
                                     * the next, in 1/8 px; means nothing where nothing moves */
};

struct smear_window {
    int32_t width, height;          /* of the frame */
    int32_t tile, tile_shift;
    int32_t reach;
    int32_t columns, rows;          /* tiles */
    int32_t ring;                   /* pixel rows kept */
    int32_t lag;                    /* tile rows that are drawn before one is finished:
                                     * as many as the reach covers */
    uint32_t *color;
    uint16_t *depth;
    int8_t *velocity8;              /* one of the two, or none (sharp only) */
    int16_t *velocity16;
    uint8_t *moving;                /* per tile column of the row being drawn */
    struct smear_tile_motion *motion;           /* 2 lag + 1 tile rows, row r at r % (2 lag + 1) */
    struct smear_tile_neighborhood *around;     /* likewise, of rows with all neighbours */
};

/* Returns the pixels of a plane. */
static inline size_t window_plane(const struct smear_window *w) { return (size_t)w->width * (size_t)w->ring; }

static inline int32_t window_ring_row(const struct smear_window *w, int32_t y)
{
    return (int32_t)((uint32_t)y % (uint32_t)w->ring);
}

static inline struct smear_tile_motion *window_motion(const struct smear_window *w, int32_t row)
{
    return w->motion + (uint32_t)row % (2u * (uint32_t)w->lag + 1u) * (uint32_t)w->columns;
}

static inline struct smear_tile_neighborhood *window_around(const struct smear_window *w, int32_t row)
{
    return w->around + (uint32_t)row % (2u * (uint32_t)w->lag + 1u) * (uint32_t)w->columns;
}

/* Velocity of a pixel in 1/8 px: half its displacement during the exposure. */
struct smear_pixel_velocity {
    int32_t x, y;
};

/* Loads entry `at` of a plane of velocities, which is `narrow` or, where that is null, `wide`. */
static inline struct smear_pixel_velocity velocity_load(const int8_t *narrow, const int16_t *wide, size_t at)
{
    if (narrow != NULL)
        return (struct smear_pixel_velocity){ narrow[2 * at], narrow[2 * at + 1] };
    return (struct smear_pixel_velocity){ wide[2 * at], wide[2 * at + 1] };
}

/* Loads the entry as one word that is only good for comparing: most pixels move like the one before. */
static inline uint32_t velocity_word(const int8_t *narrow, const int16_t *wide, size_t at)
{
    if (narrow != NULL) {
        uint16_t word;
        __builtin_memcpy(&word, __builtin_assume_aligned(narrow + 2 * at, 2), sizeof word);
        return word;
    }
    uint32_t word;
    __builtin_memcpy(&word, __builtin_assume_aligned(wide + 2 * at, 4), sizeof word);
    return word;
}

static inline struct smear_pixel_velocity window_velocity(const struct smear_window *w, uint32_t at)
{
    return velocity_load(w->velocity8, w->velocity16, at);
}

static inline uint32_t window_velocity_word(const struct smear_window *w, uint32_t at)
{
    return velocity_word(w->velocity8, w->velocity16, at);
}

static inline void velocity_store(int8_t *narrow, int16_t *wide, int32_t at, int32_t x, int32_t y)
{
    if (narrow != NULL) {
        narrow[2 * at] = (int8_t)x;
        narrow[2 * at + 1] = (int8_t)y;
    } else {
        wide[2 * at] = (int16_t)x;
        wide[2 * at + 1] = (int16_t)y;
    }
}

static inline void window_velocity_store(const struct smear_window *w, int32_t at, int32_t x, int32_t y)
{
    velocity_store(w->velocity8, w->velocity16, at, x, y);
}

#endif
