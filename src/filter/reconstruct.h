/* SPDX-License-Identifier: MIT */
/* reconstruct.h - what the forms of the reconstruction filter share: directions of neighbourhoods and what follows from
 * a pixel's motion and depth. */
#ifndef SMEAR_RECONSTRUCT_H
#define SMEAR_RECONSTRUCT_H

#include "filter/filter.h"

#include "filter/gather.h"

/* The direction of a neighbourhood. */
struct direction {
    struct vector v;
    int32_t length;             /* |v|, q8 */
    int32_t pairs;              /* 0: shorter than 2 px, nothing is gathered */
    int32_t spacing;            /* 2^12 / pairs: distance of pairs in units of v */
    uint32_t center;            /* the centre's weight times its speed: 1.2 / (2 pairs), q12 */
};

/* What follows from a pixel's velocity in a neighbourhood. */
struct own_motion {
    const struct direction *around;     /* the neighbourhood it is valid for; null at first */
    uint32_t word;
    struct vector second;       /* the second direction, as long as the first */
    int32_t background;         /* speed that taps not in front start with, q8 */
    uint32_t over;              /* its inverse_speed */
    bool slow;                  /* at most 1/2 px */
};

/* What follows from a pixel's depth: what lies in front and behind, each found once it is needed. */
struct own_depth {
    uint32_t units;
    uint32_t front, front_scale;        /* fully in front from here on; 2^30 / (front - units) */
    uint32_t behind, behind_scale;      /* fully behind down to here; 2^30 / (units - behind) */
    uint16_t code;
    bool has_front, has_behind;
};

struct gathering {
    const struct smear_window *w;
    const struct smear_row_table *rows;
    bool linear, box, fence, guertin, orthographic;
    int32_t wanted;             /* pairs */
    uint32_t far_units;         /* orthographic: depth units from the eye to the far plane */
    const uint32_t *color;      /* the window's planes from the tile's first column on */
    const uint16_t *depth_code;
    int32_t x0;                 /* that column */
    struct own_motion motion;
    struct own_depth depth;
    uint32_t front_word;        /* velocity of the last tap in front */
    int32_t front_speed;        /* q8 */
    int32_t background;         /* of the pixel: greatest speed so far, q8 */
    uint32_t over;              /* its inverse_speed */
};

/* The 3 x 3 neighbourhoods whose directions the tile's pixels may take: each looks one up as tile_looked_up() does. */
struct choice {
    struct direction direction[9];
    const struct direction *at[3][3];   /* beyond the frame: the nearest inside it */
    bool alike;                         /* no need to look */
    bool gathers;                       /* one of them is long enough */
};

/* 1/20 and 1/19 of units up to 2^20, in products of 32 bits. */
static const uint32_t share_20 = 52429, share_19 = 55188;      /* q20 */

#endif
