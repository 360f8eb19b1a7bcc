/* SPDX-License-Identifier: MIT */
/* context.h - all state of a context. Only the top floor sees it: smear.c (public functions), layout.c (memory), draws.c
 * (draws to triangles) and frame.c (the order of stages). Methods get rows (row.h) and what is their own. */
#ifndef SMEAR_CONTEXT_H
#define SMEAR_CONTEXT_H

#include "smear.h"

#include "display/damage.h"
#include "geometry/assemble.h"
#include "geometry/pose.h"
#include "methods/temporal.h"

/* A draw of this frame, with its poses. */
struct smear_submitted {
    smear_draw draw;                /* now, open and close point to `pose` where they are known */
    smear_transform pose[3];        /* now, open (or a frame ago), close */
};

/* STATE_DRAWING: within smear_render or smear_filter_row, whose callbacks may not change the context. */
enum smear_state { STATE_IDLE, STATE_BEGUN, STATE_FILTER, STATE_DRAWING };

struct smear_context {
    smear_desc desc;                /* defaults filled in */
    enum smear_state state;
    smear_stats stats;

    /* the frame */
    smear_frame frame;              /* defaults filled in */
    struct smear_shot shot;
    struct smear_sun sun;
    struct smear_lights_used lights;        /* of sun.lights */
    struct smear_history history;
    bool has_late_ids;              /* of this frame: they found no place in the history */
    smear_camera kept_camera;
    bool has_kept_camera;
    struct smear_submitted *submitted;
    struct smear_raster_draw *raster_draw;
    uint32_t draw_count;

    /* stages and methods */
    struct smear_assembler assembler;
    struct smear_rows rows;
    bool direct;                    /* sharp rows are drawn as the display's pixels */
    uint8_t parts_wait;             /* assemblies until they are to do so again */
    uint16_t part_rows;             /* tile rows that are likely to find room at once, from the last part of the frame; 0: all */
    bool row_is_full;               /* the last one did not: the next one is not likely to */
    struct smear_temporal temporal;
    struct smear_damage *damage;    /* null without desc.reuse */

    /* methods of other systems (others.h) */
    struct smear_sums *sums;
    struct smear_filtered *filtered;
    struct smear_layers *layers;
    bool has_groups;                /* draws of the frame are drawn in groups, each on its own: */
    uint16_t *group_of;             /* per draw, */
    uint16_t *sequence;             /* and draws in the order in which groups stay together */
    bool has_fixed;                 /* a draw stays where it is before a camera that moves */
};

static inline bool frame_has_lines(const struct smear_context *c) { return temporal_has_lines(&c->temporal); }

/* And there are two pictures of it. */
static inline bool frame_has_pictures(const struct smear_context *c) { return frame_has_lines(c) && c->temporal.lines->pictures > 1; }

/* And some of what moves by itself is drawn over it. */
static inline bool frame_has_movers(const struct smear_context *c) { return frame_has_lines(c) && c->temporal.lines->movers != 0; }
static inline bool draw_is_mover(const struct smear_context *c, uint32_t i)
{
    return frame_has_lines(c) && line_is_mover(c->temporal.lines, i);
}

#endif
