/* SPDX-License-Identifier: MIT */
/* filter.h - what a blur reads and writes.
 *
 * A blur only reads the window, writes one tile of finished pixels into memory of the job's own, and never works in
 * place: what a neighbour still has to read is never overwritten. Tiles may be done in any order on any core. */
#ifndef SMEAR_FILTER_H
#define SMEAR_FILTER_H

#include "base/noise.h"
#include "base/tables.h"
#include "raster/window.h"
#include "smear.h"

struct smear_blur_settings {
    bool linear;                /* average linear light, else codes */
    bool orthographic;          /* depth units are even in distance */
    int32_t samples;            /* wanted taps */
    bool dense;                 /* unweighted means take a tap per pixel of the travel, not one per two */
    bool held;                  /* something stays where it is in front of a moving camera: it must not be mixed in */
    uint8_t flags;              /* SMEAR_FENCE | ... */
    uint8_t weights;            /* smear_weights */
    uint32_t far_over_range;    /* orthographic: distance over range at units 0, q16: it tells where "5 % nearer" is */
};

/* Where the window's rows lie, by pixel row of the frame; rows beyond it stand for the nearest inside. */
struct smear_row_table {
    const uint32_t *offset;     /* of the first pixel of row `first` + i in the planes */
    int32_t first;
    int32_t y0, y1;             /* rows [y0, y1) of the tile are to be done */
};

/* Returns the depth units from the eye to the far plane of an orthographic view, 0 for others. */
static inline uint32_t blur_far_units(const struct smear_blur_settings *settings)
{
    if (!SMEAR_WITH_VIEWS || !settings->orthographic)
        return 0;
    return (uint32_t)((uint64_t)settings->far_over_range * SMEAR_DEPTH_NEAR >> 16);
}

/* Returns the tile, counted from the own one, that lies a quarter tile times a sine from `x` in the tile. Pixel
 * centres are at 1/2. */
static inline int32_t tile_jump(int32_t x, int32_t sine, int shift)
{
    return ((x << 8) + 128 + (sine * 258 * (64 << shift) >> 15)) >> (shift + 8);
}

/* Returns the neighbourhood that pixel (x, y) of a tile takes its direction from: one a quarter tile away in a random
 * direction, which hides the tiles' borders [Guertin14]. For the tile row below, the window knows only what the rows
 * drawn so far tell. */
static inline const struct smear_tile_neighborhood *tile_looked_up(const struct smear_window *w, int32_t row,
                                                                   int32_t column, int32_t x, int32_t y,
                                                                   uint32_t inner)
{
    uint32_t angle = (noise_of(inner + 2u * (uint32_t)w->width * NOISE_X) + 128u) >> 8;
    row += tile_jump(y, smear_sine[angle & 255u], w->tile_shift);
    column += tile_jump(x, smear_sine[(angle + 64u) & 255u], w->tile_shift);
    return &window_around(w, clamp_i32(row, 0, w->rows - 1))[clamp_i32(column, 0, w->columns - 1)];
}

/* Filters a tile by the reconstruction filter [McGuire12], [Guertin14], as in Post Processing Stack v2. Writes the
 * tile's rows (what is inside the frame) to `out`, w->tile pixels apart. Returns the taps taken. So do all filters
 * below. */
uint32_t smear_blur_reconstruct(uint32_t *out, const struct smear_window *w,
                                const struct smear_row_table *rows, int32_t row, int32_t column,
                                const struct smear_blur_settings *settings);

/* Takes the unweighted mean along each pixel's own velocity, for tiles in whose reach all motion is alike or changes
 * without a step. */
uint32_t smear_blur_uniform(uint32_t *out, const struct smear_window *w,
                            const struct smear_row_table *rows, int32_t row, int32_t column,
                            const struct smear_blur_settings *settings);

/* Gathers with the weights of other filters (settings->weights). */
uint32_t smear_blur_weights(uint32_t *out, const struct smear_window *w, const struct smear_row_table *rows,
                            int32_t row, int32_t column, const struct smear_blur_settings *settings);

/* Copies a tile that nothing moves in. */
void smear_blur_copy(uint32_t *out, const struct smear_window *w, const struct smear_row_table *rows,
                     int32_t column);

#endif
