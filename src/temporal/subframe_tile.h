/* SPDX-License-Identifier: MIT */
/* subframe_tile.h - some tiles while they are drawn at several instants: what the parts of subframes.c share. */
#ifndef SMEAR_SUBFRAME_TILE_H
#define SMEAR_SUBFRAME_TILE_H

#include "geometry/space.h"
#include "kernels/depth_range.h"
#include "kernels/packed_sums.h"
#include "temporal/subframes.h"

/* Pixels [x0, x1) x [y0, y1). */
struct subframe_box {
    int32_t x0, y0, x1, y1;
};

static const struct subframe_box no_box = { INT32_MAX, INT32_MAX, INT32_MIN, INT32_MIN };

static inline void box_add(struct subframe_box *b, const struct subframe_box *add)
{
    b->x0 = min_i32(b->x0, add->x0);
    b->y0 = min_i32(b->y0, add->y0);
    b->x1 = max_i32(b->x1, add->x1);
    b->y1 = max_i32(b->y1, add->y1);
}

static inline bool subframe_box_is_empty(const struct subframe_box *b)
{
    return b->x0 >= b->x1 || b->y0 >= b->y1;
}

static inline int32_t pixels_in(const struct subframe_box *b)
{
    return subframe_box_is_empty(b) ? 0 : (b->x1 - b->x0) * (b->y1 - b->y0);
}

/* What may pass by unseen in the middle of the exposure. First small triangles that move, q8 pixels. */
struct subframe_passing {
    uint32_t ways;              /* what their edges pass of the tiles */
    uint32_t seen;              /* what those pass of the frame that lie in the tiles in the middle of the exposure */
    uint32_t covered;           /* of the tiles, in the mean over the exposure; by larger ones, too */
    uint32_t opaque;            /* the same by what is not blended */
    bool sparks;                /* some are blended and go far */
    bool in_space;              /* there are triangles with paths in space, of any size, that are not blended */
};

/* What some pixels of the tiles that lie evenly showed at the last instant, and the squares by which they changed so far, together. */
enum { PIXELS_SHOWN = 64 };

struct subframe_changes {
    uint32_t shown[PIXELS_SHOWN], sum;
};

struct subframes {
    const struct smear_tile_run *t;
    struct smear_tile_run *refilled;    /* the same where its triangles come in several fills, or null */
    struct smear_raster_target work;    /* the tile at an instant: finished pixels, depth of its own */
    struct packed_sums sums;            /* of what is not background: of codes, or of light (light_sums.h) */
    bool blends;                /* blended draws change the background, too */
    uint32_t instants;
    struct smear_space *space;  /* of the segment that was asked for last */
    int32_t shift[2];           /* smooth edges: how far what moves is shifted along x and y at this instant, q8 px */

    /* What may be seen in the tile. */
    int32_t fills;              /* of the store that it took to find out */
    uint32_t moving_seen;       /* moving triangles */
    bool closes;                /* gaps, for which it counts what is in front */
    uint32_t lowest, highest;   /* depth codes of the background; 0 where none are closed */
    uint32_t nearest;           /* nothing that moves or is blended comes nearer */
    struct subframe_box area;      /* and nothing of it is seen elsewhere */
    bool plans;                 /* it is to be found out how many instants there are: */
    struct subframe_passing passing;
    struct subframe_changes *changes;   /* from instant to instant, or null */
};

/* Whether a moving triangle may be seen. */
static inline bool subframes_see(const struct subframes *f, const struct smear_moving_triangle *m)
{
    return moving_is_in(m, f->t) && m->nearest > f->lowest;
}

/* Index of the first of the box's pixels in row y of the work planes. */
static inline int32_t work_row(const struct subframes *f, const struct subframe_box *b, int32_t y)
{
    return (y - f->t->background.y0) * f->t->pitch + (b->x0 - f->t->background.x0);
}

/* Light is summed in place of codes where it is linear, and of more instants than sums of codes have room for. */
static inline bool sums_light(const struct subframes *f)
{
    return SMEAR_WITH_LINEAR && (frame_is_linear(f->t->frame) || f->instants > PACKED_INSTANTS_MAX);
}

struct smear_tile_plan;

/* Puts means in place of the background where anything was summed, which is within `all`. Gaps are closed as the plan's
 * blocks say, unless it is null. */
void smear_subframe_average(const struct subframes *f, const struct subframe_box *all, const struct smear_tile_plan *plan);

/* Empties the sums wherever they will be read. */
void smear_subframe_sums_clear(const struct subframes *f);

/* Adds the box of instant k to the sums, and makes its colours nothing again, or background where draws are blended. */
void smear_subframe_sums_add(const struct subframes *f, const struct subframe_box *box, uint32_t k);

/* Puts colours of the background in place of PACKED_NOTHING. */
void smear_subframe_lay_over(const struct subframes *f);

/* Copies its depths in a box and, where tiles begin with whole words, perhaps one pixel more to either side. */
void smear_subframe_restore_depth(const struct subframes *f, const struct subframe_box *b);

/* The range of its depth codes in a box of the work planes, and up to `margin` pixels beyond. */
struct depth_range smear_subframe_depths(const struct subframes *f, const struct subframe_box *b, int32_t margin);

/* A triangle with its vertices at an instant. */
struct posed {
    const struct smear_segment *segment;
    uint32_t color;
    const int32_t *v[3];        /* `record`, or the vertices themselves where they do not move */
    struct bounds bounds;       /* of the vertices */
    struct subframe_box box;       /* within the tiles */
    int count, next;            /* corners of what was cut (space.h), and the next one of its fan */
    struct path_record record[SMEAR_CLIP_MAX];          /* without paths, which come last */
};

/* False where the triangle is not seen in the tiles at this time, 0 .. SHUTTER_CLOSE: elsewhere, or turned away. */
bool smear_subframe_pose(struct posed *p, const struct subframes *f, uint32_t triangle, int32_t time);

/* Goes on to the next triangle that is left of one that was cut. False where there is none. */
bool smear_subframe_pose_next(struct posed *p, const struct subframes *f);

#endif
