/* SPDX-License-Identifier: MIT */
/* layer.h - blurred layers: what is blurred on its own and merged over the background, which is the static scene.
 *
 * Draws of a blurred layer that move alike form a group. A group is drawn as it is in the middle of the
 * exposure into rows of its own: those of the tile row and as many above and below as the blur reads, and
 * columns beyond the frame's sides, so that what enters the frame is there before it does. */
#ifndef SMEAR_LAYER_H
#define SMEAR_LAYER_H

#include "display/row.h"
#include "geometry/assemble.h"

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
    struct smear_layer_cell *cell;      /* layer.h */
    uint32_t *color;                    /* 0xff000000 where nothing is drawn */
    uint16_t *depth;
    /* Of the frame's tile row, where groups pass through each other: what was merged before (colours times coverage, coverage in
     * the top byte), and about its depth codes. */
    uint32_t *over;
    uint16_t *over_depth;
    int16_t *row_first, *row_end;       /* the columns of each row within which something is drawn */
    void *work;                         /* work_bytes per worker: layer.h */
    uint32_t work_bytes;
    /* What was drawn last, of which the next tile row of the same group needs the lower part again. */
    const struct smear_group *drawn;    /* null: none that is of use */
    int32_t x0, y0, x1, y1;             /* columns, and rows of the layer's frame */
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
    smear_transfer transfer;
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

/* Draws and finishes the tile rows [first, end), a part of the frame that has been assembled; `samples` of filters.
 * Returns as smear_band_flush. */
int smear_layered_rows(struct smear_layers *l, struct smear_rows *rows, int32_t samples, int first, int end);

/* Call before the draws of a frame are looked at. */
void smear_groups_begin(struct smear_layers *l);

/* Finds the layer of draw number `index`. */
void smear_groups_find_layer(struct smear_layers *l, uint32_t index, const smear_draw *draw);

/* Takes in a draw of a blurred layer: finds its displacement from its places at shutter open and close. One that does
 * not move on the screen stays with the static scene, but for those of layers that lie over it. */
void smear_groups_add(struct smear_layers *l, uint32_t index, const smear_draw *draw, const struct smear_placement key[2],
                      const struct smear_placement *middle, const struct smear_viewport *viewport, bool moves);

/* Call after the last of `draw_count` draws: it orders groups, and draws by groups. */
void smear_groups_end(struct smear_layers *l, uint32_t draw_count);

/* Assembles a draw of a group into lists of its own. Returns false where there is no room. */
bool smear_groups_assemble(struct smear_layers *l, struct smear_assembler *assembler, const struct smear_assembly *a);

/* Finds each group's part of the moving triangles' list, from `head` on. */
void smear_groups_list(struct smear_layers *l, const struct smear_bins *bins, uint32_t head);

/* Does so where a tile row is drawn from several fills of the store: begins, adds triangles of a group, from `head` on, and
 * ends. A group that has none keeps no head. Returns the first that is not the group's. */
void smear_groups_list_begin(struct smear_layers *l);
uint32_t smear_groups_list_add(struct smear_group *group, const struct smear_bins *bins, uint32_t head);
void smear_groups_list_end(struct smear_layers *l);

/* Finds where groups lie in part behind others that are merged before them; returns false where none does. `reach` is
 * that of filters. */
bool smear_groups_find_mixed(struct smear_layers *l, int32_t reach);

/* A group of draws blurred along one velocity, over the background: the two-camera approach with known
 * coverage and depth. */

/* A velocity as lines of pixels along it, one pixel per step of its longer axis. A difference of two sums
 * along a line is the mean around each of its pixels, whatever the length. */
struct smear_streak {
    bool upright;               /* steps go down, not right */
    int32_t slope;              /* of the other axis, q16, within -1 .. 1 */
    int32_t half;               /* whole pixels on both sides of the middle one */
    uint32_t inner, rest;       /* the weight of a pixel beyond the whole ones is `rest`, of a whole one inner + rest,
                                 * a power of two */
    uint32_t length;            /* sum of the weights, 128 .. 256 */
    uint32_t over;              /* 2^22 / length, rounded up */
    int32_t node;               /* log2 of the steps from one node to the next: means are taken there and mixed
                                 * between */
    int32_t reach_x, reach_y;   /* px from a pixel to the farthest that its mean takes */
};

/* Returns half the length of the longest streak, px. */
static inline int32_t streak_half_max(int32_t width)
{
    return clamp_i32(width >> 2, 16, 120);
}

/* Makes the streak of a displacement in q8 px. One that is longer than `half_max` on both sides, or reaches more than
 * `reach` rows up and down, is shortened. */
void smear_streak_make(struct smear_streak *s, int32_t vx, int32_t vy, int32_t half_max, int32_t reach);

/* Returns the bytes of work memory per worker for tiles of this edge. */
size_t smear_streak_work(int32_t tile);

/* Merges the area; returns how many pixels it went over. */
uint32_t smear_streak_merge(const struct smear_streak *s, const struct smear_layer_area *a);

/* The longest velocity of a column as wide as a tile, or of it and its neighbours, 1/8 px. */
struct smear_layer_cell {
    int16_t x, y;
};

enum { SMEAR_GATHER_TAPS = 64 };

/* Finds the layer's cells. */
void smear_gather_cells(const struct smear_layer_area *a);

/* Merges the area; returns the taps taken. */
uint32_t smear_gather_merge(const struct smear_layer_area *a);

/* Merges the mean of `samples` places along one displacement (q8 px): the two-camera approach as it is. Returns the
 * taps taken. */
uint32_t smear_two_camera_merge(const struct smear_layer_area *a, int32_t vx, int32_t vy);

#endif
