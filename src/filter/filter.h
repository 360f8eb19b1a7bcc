/* SPDX-License-Identifier: MIT */
/* filter.h - what a blur reads and writes.
 *
 * A blur only reads the window, writes one tile of finished pixels into memory of the job's own, and never works in
 * place: what a neighbour still has to read is never overwritten. Tiles may be done in any order on any core. */
#ifndef SMEAR_FILTER_H
#define SMEAR_FILTER_H

#include "smear.h"

#include "base/base.h"
#include "base/pixel.h"
#include "geometry/reproject.h"
#include "raster/window.h"

/* Interleaved gradient noise [Jimenez14]: frac(52.9829189 frac(0.06711056 x + 0.00583715 y)). The inner factors in q32; adding them
 * steps from pixel to pixel. */
#define NOISE_X 288237660u
#define NOISE_Y 25070368u

/* Returns the noise, q16. The outer factor is 53 - 0.0170811, 35822 in q21. */
static inline uint32_t noise_of(uint32_t inner)
{
    return (inner * 53u - ((inner >> 16) * 35822u >> 5)) >> 16;
}

struct smear_blur_settings {
    smear_transfer transfer;    /* of what is averaged */
    bool orthographic;          /* depth units are even in distance */
    int32_t samples;            /* wanted taps */
    bool lines;                 /* only the middles of blocks have a velocity: the camera's motion alone is blurred (line.c) */
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

/* Finds the velocity of each block of tile `column` of a row that is drawn, and whether any moves. */
void smear_line_look(const struct smear_window *w, const struct smear_flow *flow, int32_t row, int32_t column);

/* Takes the unweighted mean along each block's line or, where its pixels do not move alike, along each one's own velocity. */
uint32_t smear_blur_mean(uint32_t *out, const struct smear_window *w, const struct smear_row_table *rows, int32_t row,
                         int32_t column, const struct smear_blur_settings *settings);

/* Gathers with the weights of other filters (settings->weights). */
uint32_t smear_blur_weights(uint32_t *out, const struct smear_window *w, const struct smear_row_table *rows,
                            int32_t row, int32_t column, const struct smear_blur_settings *settings);

/* Copies a tile that nothing moves in. */
void smear_blur_copy(uint32_t *out, const struct smear_window *w, const struct smear_row_table *rows,
                     int32_t column);

/* Reduces the velocities of tile `column` of tile row `row`. */
void smear_tilemax(const struct smear_window *w, int32_t row, int32_t column);

/* Finds the 3 x 3 neighbourhood of every tile in `row`, where rows up to `known` have been reduced: the row being
 * finished knows all three, the one below it is looked at with two. With `corner`, a diagonal neighbour counts only if
 * its motion points along the diagonal [Guertin14]. Where the reach exceeds a tile, all tiles within it count whose
 * motion leads here. */
void smear_neighbormax_row(const struct smear_window *w, int32_t row, int32_t known, bool corner);

/* A window at half the size, with colour, depth and velocity of 2 x 2 pixels each, and its result at full
 * size.
 *
 * A filter runs in it as in any window, on a quarter of the pixels, with half the reach. Its result is blended with the
 * frame by how fast each pixel moves: a static pixel keeps all its detail, bit for bit, but gets what the blur changes
 * there; a moving one gets the blur and, of the detail within 2 x 2 pixels, keeps what lies across its motion. */

/* Fills tile `column` of tile row `row` from the window of the whole frame: with the mean colour (of linear light, or
 * of codes) and with the depth and velocity of the nearest pixel. */
void smear_half_reduce(const struct smear_window *half, const struct smear_window *full, int32_t row,
                       int32_t column, smear_transfer transfer);

/* Writes the tile of the whole frame to `out`, rows full->tile apart: `blurred` is the
 * tile of half the size, rows half->tile apart. */
void smear_half_blend(uint32_t *out, const uint32_t *blurred, const struct smear_window *half,
                      const struct smear_window *full, int32_t row, int32_t column);

/* How velocities are stored, as in struct smear_raster_frame. */
struct smear_camera_store {
    int32_t velocity_scale, inspect_scale, reach_q3;
    int32_t *inspect;           /* a plane like the window's; or null */
};

/* Gives pixels of unknown velocity in [x0, x1) x [y0, y1) of the window that of their depth. Blocks of `step` x `step`
 * pixels (step is 1, 2 or 4) share one velocity, that of the nearest depth in the middle of the block; what is more
 * than 1/16 farther away gets its own. Marks the tiles that move. */
void smear_camera_velocity(const struct smear_window *w, const struct smear_reprojection *r,
                           const struct smear_camera_store *store, int32_t step, int32_t x0, int32_t x1,
                           int32_t y0, int32_t y1);

/* Both components of a velocity that is still to be told from depth: in
 * 8 or in 16 bits it lies beyond every reach. */
#define SMEAR_VELOCITY_UNKNOWN8 ((int8_t)-128)
#define SMEAR_VELOCITY_UNKNOWN16 ((int16_t)-32640)     /* the same byte twice */

/* ------------------------------------------------------------------ pingpong.c */

enum { PINGPONG_PASSES_MAX = 3 };

/* One pass over a frame. */
struct smear_pass {
    int32_t taps;
    /* Streaks of so many pixels or fewer are left to the last pass, which then takes all passes' taps: no
     * steps of passes fit between their pixels. */
    int32_t direct_up_to, all_taps, direct_spacing;
    bool is_last;
    int32_t spacing;            /* half the distance of two taps, as a share of half the exposure's displacement: q20 */
    int32_t reach;              /* rows above and below that it may read */
    int32_t jitter;             /* q8 of `spacing` to either side */
    int32_t bias;               /* q8 of the distance; at most 255: no tap is left out */
    bool spread;                /* moving things come over what is static */
};

/* Plans the passes of a frame; returns how many there are. Zeros in p that mean a default have been resolved. */
int smear_pingpong_plan(struct smear_pass pass[PINGPONG_PASSES_MAX], const smear_pingpong *p, int32_t reach);

/* Makes one pass over the rows [y0, y1) of tile `column` in tile row `row`. It reads `in`, a plane like the window's
 * colour, and writes to `out`: a plane like the window's where `stride` is 0, else the tile's first pixel in row y0,
 * with rows `stride` pixels apart. Returns the taps taken. */
uint32_t smear_pingpong_pass(uint32_t *out, int32_t stride, const uint32_t *in, const struct smear_window *w,
                             const struct smear_row_table *rows, const struct smear_pass *pass, int32_t row,
                             int32_t column, int32_t y0, int32_t y1,
                             const struct smear_blur_settings *settings);

#endif
