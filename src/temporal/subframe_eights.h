/* SPDX-License-Identifier: MIT */
/* subframe_eights.h - the moving triangles of some tiles at an instant, eight at once where a draw has so many. */
#ifndef SMEAR_SUBFRAME_EIGHTS_H
#define SMEAR_SUBFRAME_EIGHTS_H

#include "kernels/poses.h"
#include "raster/raster_poses.h"
#include "temporal/subframe_tile.h"

#if SMEAR_AVX2

/* Up to eight triangles of one segment that are drawn together. */
struct subframe_pack {
    const struct smear_segment *segment;        /* null: one triangle that is drawn alone */
    uint32_t triangle;
    int count;
    uint16_t vertex[8][4];              /* all eight: the first one's in place of those that are missing */
    uint32_t color[8];
    struct poses_courses courses;
};

/* Moving triangles of some tiles that may be seen, in their order: the same ones at all instants. Those listed come first. */
enum { SUBFRAME_PACKS = 32 };
struct subframe_packs {
    uint32_t listed;                    /* so many of those listed */
    uint32_t rest;                      /* and, of those that are not, those before this one of the run's */
    int count;
    struct subframe_pack of[SUBFRAME_PACKS];
};

/* An instant, and what has come to be drawn at it. */
struct subframe_eights {
    const struct subframes *f;
    struct subframe_box *all;           /* where anything was drawn */
    const struct smear_segment *segment;        /* of which there are: */
    struct poses_setup setup;
    struct raster_eights raster;
    struct subframe_pack waiting;       /* not drawn yet */
};

/* Whether an instant may be drawn so: shifts for smooth edges are each triangle's own. */
static inline bool subframe_eights_suit(const struct subframes *f)
{
    return !(SMEAR_EDGES && (f->shift[VERTEX_X] | f->shift[VERTEX_Y]) != 0) && smear_has_avx2();
}

void smear_subframe_packs_make(struct subframe_packs *packs, const struct subframes *f);

void smear_subframe_eights_begin(struct subframe_eights *e, const struct subframes *f, int32_t time, struct subframe_box *all);

/* Draws a pack that has a segment. */
void smear_subframe_eights_draw(struct subframe_eights *e, const struct subframe_pack *pack);

/* Draws a triangle with a path, or has it wait. False where it has to be drawn alone, those before it have been drawn then. */
bool smear_subframe_eights_add(struct subframe_eights *e, uint32_t triangle);

/* Draws those that wait. */
void smear_subframe_eights_end(struct subframe_eights *e);

#endif
#endif
