/* SPDX-License-Identifier: MIT */
/* filter_ref.h - the reconstruction filter in double precision: what the library's integers
 * approximate.
 *
 * The Post Processing Stack v2 object motion blur (after McGuire et al. 2012, Guertin et al. 2014),
 * with its defaults. With p a pixel, v half its displacement during the exposure in pixels, z its
 * distance, T the tile:
 *
 *   tile maximum       the longest v of the tile's pixels inside the frame; of equals the first in
 *                      row order
 *   neighbour maximum  of the 3x3 tiles inside the frame, in row order, the centre lengthened by
 *                      1.01; of equals the first. The winner, whichever it is, is shortened by 1.01
 *   noise(x, y)        frac(52.9829189 frac(0.06711056 x + 0.00583715 y)), whole pixel coordinates
 *   v_max              the neighbour maximum at pixel centre + T/4 (cos a, sin a), a = 2 pi
 *                      noise(x + 2W, y), clamped to the tiles there are; L = |v_max|. L < 2: the
 *                      pixel stays as it is
 *   second direction   v_p L / l_p with l_p = max(|v_p|, 1/2) when 2 l_p > L, else v_max
 *   pairs              n = floor(min(clamp(floor(samples / 2), 1, 64), L / 2))
 *   taps               i = 0 .. n-1, outermost first: t = 1 - (i + 0.5)/n; along v_max for even i,
 *                      along the second direction for odd i; at s = t + o, then at s = -t + o,
 *                      o = (noise(x, y) - 0.5)/n; q is the pixel whose square holds pixel centre
 *                      + s d, clamped to the frame; its distance l = L |s|
 *   in front           f = clamp(20 (z_p - z_q) / z_p, 0, 1); 0 when q is background, 1 when only
 *                      p is
 *   speed              u = max(B + (|v_q| - B) f, 1/16), where B starts as max(l_p, 1)
 *   weight             clamp(u - l, 0, 1) / u x (1.2 - t); then B = max(B, u)
 *   centre             1.2 / (2 B n), with the last B
 *   result             weighted mean of the colours
 *
 * Differences from the original: velocity has an exact zero (hence the 1/16 px under u), depth is
 * not cut to ten bits, the tile maximum is exact at every size. Departures, chosen by the SMEAR_
 * flags of smear.h:
 *
 *   SMEAR_FENCE      where |v_p| <= 1/2 the weight of a tap is multiplied by 1 - b; b = clamp(20
 *                    (z_q - z_p) / z_q, 0, 1) is how far q is behind p, 1 when only q is background
 *   SMEAR_CORNER     a diagonal neighbour (dx, dy) counts only when sign(dx v_x) + sign(dy v_y) is
 *                    2 or -2
 *   SMEAR_BOX        1 in place of 1.2 - t and of 1.2
 *   SMEAR_DIRECTION  second direction L normalise(lerp(n, v_p/|v_p|, clamp((|v_p| - 0.5)/1.5, 0,
 *                    1))); n is the unit perpendicular of v_max on v_p's side: (-y, x)/L, negated
 *                    if its product with v_p is negative
 *
 * What a rolling window costs (`window`): while a tile row is finished, the one below it is drawn
 * but not the one below that. Where v_max is looked up in the tile row below the pixel's own, its
 * neighbour maximum lacks the three tiles below it. And tiles in whose 3x3 nothing moves are
 * copied, whatever a look-up a quarter tile away would have found. */
#ifndef SMEAR_TESTS_FILTER_REF_H
#define SMEAR_TESTS_FILTER_REF_H

#include "tools/failure.h"

#include <stdbool.h>
#include <stdint.h>

struct filter_ref_input {
    int width, height;
    const uint8_t *rgb;         /* 3 per pixel, sRGB codes */
    const uint16_t *depth;      /* depth codes of smear.h; 0: background */
    const int16_t *velocity;    /* 2 per pixel: half the displacement in the exposure, in steps */
    double velocity_step;       /* pixels per step; 0 means 1/8 */
    double near_plane, far_plane;
    bool orthographic;          /* depth codes run evenly from far to near; else no planes needed */
    int tile;                   /* pixels, >= 1 */
    int samples;                /* as in smear_frame; 0 means 8 */
    bool encoded;               /* average codes instead of linear light */
    bool whole_neighbor;        /* do not shorten a winning neighbour by 1.01, only the centre */
    bool window;                /* as a window of two tile rows sees it: below */
    unsigned flags;             /* SMEAR_FENCE | SMEAR_CORNER | SMEAR_BOX | SMEAR_DIRECTION */
};

/* Half the displacement during the exposure, packed as the library keeps it: px per frame x degrees
 * / 720, shortened to `reach` with its direction kept, rounded to steps, halves up. */
void filter_ref_pack(const double velocity[2], double shutter_degrees, double reach, double step,
                     int16_t packed[2]);

/* Tile maxima in steps, 2 per tile, row by row; the array has ceil(width / tile) x ceil(height /
 * tile) tiles. */
void filter_ref_tile_max(const struct filter_ref_input *in, int16_t *tile_max);

/* Neighbour maxima in pixels, 2 per tile, from tile maxima. */
void filter_ref_neighbor_max(const struct filter_ref_input *in, const int16_t *tile_max,
                             double *neighbor_max);

/* Interleaved gradient noise in 0..1 (Jimenez 2014). */
double filter_ref_noise(int x, int y);

/* The whole filter; `code` gets 3 values of 0..255 per pixel, sRGB-encoded, not rounded. */
bool filter_ref(const struct filter_ref_input *in, double *code, struct failure *f);

#endif
