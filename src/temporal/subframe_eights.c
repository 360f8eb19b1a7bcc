/* SPDX-License-Identifier: MIT */
/* subframe_eights.c - see subframe_eights.h. What is drawn, and in which order, is what subframe_pose.c and the raster make of
 * one triangle after the other. */
#include "temporal/subframe_eights.h"

#include "geometry/path.h"
#include "geometry/transform.h"

#if SMEAR_AVX2

void smear_subframe_eights_begin(struct subframe_eights *e, const struct subframes *f, int32_t time, struct subframe_box *all)
{
    const struct smear_raster_frame *frame = f->t->frame;
    const struct smear_raster_target *tile = &f->t->background;
    const int32_t guard = SMEAR_GUARD_PX << 8, x = frame->width << 7, y = frame->height << 7;
    e->f = f;
    e->all = all;
    e->time = time;
    e->segment = NULL;
    e->count = 0;
    e->setup = (struct poses_setup){ .phase = path_phase(time), .low = { x - guard, y - guard }, .high = { x + guard, y + guard },
                                     .depth_least = SMEAR_DEPTH_MIN, .depth_most = SMEAR_DEPTH_MAX,
                                     .x0 = tile->x0, .y0 = tile->y0, .x1 = tile->x1, .y1 = tile->y1, .tiny_box = TINY8_BOX };
}

void smear_subframe_eights_end(struct subframe_eights *e)
{
    struct poses poses;
    const struct subframes *f = e->f;
    if (e->count == 0)
        return;
    for (int k = e->count; k < 8; k++)
        __builtin_memcpy(e->vertex[k], e->vertex[0], sizeof e->vertex[0]);
    smear_poses_avx2(&poses, &e->setup, (const uint16_t(*)[4])e->vertex, e->count);
    e->count = 0;
    if (poses.seen == 0)
        return;
    const struct subframe_box box = { poses.box[0], poses.box[1], poses.box[2], poses.box[3] };
    box_add(e->all, &box);
    smear_raster_poses(f->t->frame, &f->work, e->segment, e->has_look ? &e->look : NULL, e->color, &poses);
}

static void begin_segment(struct subframe_eights *e, const struct smear_segment *segment)
{
    const struct subframes *f = e->f;
    e->segment = segment;
    e->has_look = smear_raster_look(&e->look, f->t->frame, &f->work, segment);
    e->setup.vertex = bins_vertex(f->t->frame->bins, segment, 0);
    e->setup.motion = segment->motion;
    e->setup.tiny = e->has_look ? e->look.most : 0;
}

bool smear_subframe_eights_add(struct subframe_eights *e, uint32_t triangle)
{
    const struct smear_bins *g = e->f->t->frame->bins;
    const struct smear_triangle *t = bins_triangle(g, triangle);
    const struct smear_segment *segment = &g->segment[t->segment];
    const bool alone = bins_bounds(g, triangle)->interval != 0;
    if (alone || segment != e->segment) {
        smear_subframe_eights_end(e);
        if (alone)
            return false;
        begin_segment(e, segment);
    }
    __builtin_memcpy(e->vertex[e->count], t->vertex, sizeof t->vertex);
    e->color[e->count++] = t->color;
    if (e->count == 8)
        smear_subframe_eights_end(e);
    return true;
}

#endif
