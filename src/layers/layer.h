/* SPDX-License-Identifier: MIT */
/* layer.h - blurred layers: what is blurred on its own and merged over the background, which is the static scene.
 *
 * Draws of a blurred layer that move alike form a group. A group is drawn as it is in the middle of the
 * exposure into rows of its own: those of the tile row and as many above and below as the blur reads, and
 * columns beyond the frame's sides, so that what enters the frame is there before it does. */
#ifndef SMEAR_LAYER_H
#define SMEAR_LAYER_H

#include "display/row.h"

/* The layer of a draw that is in none; its group is SMEAR_NO_GROUP, row.h. */
#define SMEAR_NO_LAYER 0xffu

/* A layer of the frame. */
struct smear_layer_setting {
    smear_layer layer;
    smear_camera camera[3];     /* now, open, close */
    bool has_camera, has_older;     /* camera[2] is that two frames ago until curves are found */
    int32_t shutter;            /* its exposure over that of the frame, q16 */
};

struct smear_group {
    int32_t vx, vy;             /* displacement during the exposure, q8 px */
    int32_t depth;              /* units q11 of its middle: farther groups are merged first */
    uint32_t end;               /* triangles of the store below this number are its own or those of groups before it */
    uint8_t layer;
    uint8_t rank;               /* 0: its depth orders it. Else it lies over all groups of lower ranks */
    bool textured;              /* texels leave their alpha in the pixels */
    uint8_t method;             /* SMEAR_OBJECT, SMEAR_LAYERED, or SMEAR_NONE: as it is now */
    /* The rest is about the tile row being drawn. */
    uint32_t head, tail;        /* its part of the moving triangles' list */
    int32_t x0, x1;             /* the columns and depth codes it keeps to */
    uint16_t nearest, farthest;
    int32_t mixed0, mixed1;     /* columns in which it passes through other groups */
    bool marks;                 /* one of those groups is merged later, */
    uint32_t marked_from;       /* none of them with depth codes below this */
};

/* Rows of a group. Pixel (x, y) of the frame lies there `margin` columns to the right and a tile row further down; so
 * do the triangles of layers in the store. */
struct smear_layer_rows {
    int32_t margin, width, height;      /* of the frame with its margins */
    int32_t rows;                       /* how many there is memory for */
    int8_t *velocity8;                  /* SMEAR_LAYERED has one of the two, as in window.h */
    int16_t *velocity16;
    struct smear_layer_cell *cell;      /* layer_gather.h */
    uint32_t *color;                    /* 0xff000000 where nothing is drawn */
    uint16_t *depth;
    /* Of the frame's tile row, where groups pass through each other: what was merged before (colours times coverage, coverage in
     * the top byte), and about its depth codes. */
    uint32_t *over;
    uint16_t *over_depth;
    int16_t *row_first, *row_end;       /* the columns of each row within which something is drawn */
    void *work;                         /* work_bytes per worker: streak.h */
    uint32_t work_bytes;
};

#define SMEAR_UNCOVERED 0xff000000u

/* A group, drawn into rows of a layer, and where it is merged. */
struct smear_layer_area {
    const struct smear_layer_rows *layer;
    const struct smear_group *group;
    int32_t rows, top;          /* rows that are drawn, and the first of them to be finished */
    uint32_t *background;       /* first pixel of the frame's row to be finished */
    uint16_t *background_depth;
    int32_t background_stride;
    int32_t left, right, height;            /* columns and rows of the frame to be finished */
    int32_t tile_shift, samples;
    void *work;                 /* smear_streak_work() */
    bool linear;
};

/* What reaches a tile of the tile row being finished, in smear_window.moving. */
enum { TILE_OBJECT = 1, TILE_LAYERED = 2 };

struct smear_layers {
    struct smear_layer_setting *setting;
    int setting_count;
    uint8_t *layer_of;          /* per draw: its setting, or SMEAR_NO_LAYER */
    uint16_t *group_of;         /* per draw */
    uint16_t *sequence;         /* draws in the order in which they are assembled: groups stay together */
    struct smear_group *group;
    uint16_t *order;            /* groups from the farthest to the nearest */
    uint32_t group_count;
    struct smear_layer_rows rows;
};

#endif
