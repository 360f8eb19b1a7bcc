/* SPDX-License-Identifier: MIT */
/* subframe_eights.c - see subframe_eights.h. What is drawn, and in which order, is what subframe_pose.c and the raster make of
 * one triangle after the other. */
#include "temporal/subframe_eights.h"

#include "geometry/path.h"
#include "geometry/transform.h"

#if SMEAR_AVX2

/* ------------------------------------------------------------------ packs */

static inline void pack_begin(struct subframe_pack *pack, const struct smear_segment *segment)
{
    pack->segment = segment;
    pack->count = 0;
}

static inline void pack_add(struct subframe_pack *pack, const struct smear_triangle *t)
{
    __builtin_memcpy(pack->vertex[pack->count], t->vertex, sizeof t->vertex);
    pack->color[pack->count++] = t->color;
}

/* The vertices a segment's triangles are made of. */
static inline void take_vertices(struct poses_setup *setup, const struct smear_bins *g, const struct smear_segment *segment)
{
    setup->vertex = bins_vertex(g, segment, 0);
    setup->motion = segment->motion;
}

static inline void pack_end(struct subframe_pack *pack, const struct smear_bins *g)
{
    struct poses_setup setup;
    for (int k = pack->count; k < 8; k++)
        __builtin_memcpy(pack->vertex[k], pack->vertex[0], sizeof pack->vertex[0]);
    take_vertices(&setup, g, pack->segment);
    smear_poses_courses_avx2(&pack->courses, &setup, (const uint16_t(*)[4])pack->vertex);
}

/* The segment of a triangle that may be drawn with others; or null. */
static inline const struct smear_segment *segment_of(const struct smear_bins *g, uint32_t triangle)
{
    return bins_bounds(g, triangle)->space != 0 ? NULL : &g->segment[bins_triangle(g, triangle)->segment];
}

/* Adds the next triangle; false where there is no room for it. */
static bool packs_add(struct subframe_packs *packs, const struct smear_bins *g, uint32_t triangle)
{
    const struct smear_segment *const segment = segment_of(g, triangle);
    struct subframe_pack *pack = packs->count != 0 ? &packs->of[packs->count - 1] : NULL;
    if (pack == NULL || segment == NULL || pack->segment != segment || pack->count == 8) {
        if (packs->count == SUBFRAME_PACKS)
            return false;
        pack = &packs->of[packs->count++];
        pack_begin(pack, segment);
        pack->triangle = triangle;
    }
    pack_add(pack, bins_triangle(g, triangle));
    return true;
}

void smear_subframe_packs_make(struct subframe_packs *packs, const struct subframes *f)
{
    const struct smear_bins *g = f->t->frame->bins;
    bool room = true;
    packs->count = 0;
    for (packs->listed = 0; packs->listed < f->moving_listed; packs->listed++)
        if (!(room = packs_add(packs, g, f->listed[packs->listed])))
            break;
    for (packs->rest = f->moving_rest; room && packs->rest < f->t->moving_count; packs->rest++) {
        const struct smear_moving_triangle *const m = &f->t->moving[packs->rest];
        if (subframes_see(f, m) && !packs_add(packs, g, m->triangle))
            break;
    }
    for (int i = 0; i < packs->count; i++)
        if (packs->of[i].segment != NULL)
            pack_end(&packs->of[i], g);
}

/* ------------------------------------------------------------------ instants */

void smear_subframe_eights_begin(struct subframe_eights *e, const struct subframes *f, int32_t time, struct subframe_box *all)
{
    const struct smear_raster_frame *frame = f->t->frame;
    const struct smear_raster_target *tile = &f->work;
    const int32_t guard = SMEAR_GUARD_PX << 8, x = frame->width << 7, y = frame->height << 7;
    e->f = f;
    e->all = all;
    e->segment = NULL;
    pack_begin(&e->waiting, NULL);
    e->setup = (struct poses_setup){ .phase = path_phase(time), .low = { x - guard, y - guard }, .high = { x + guard, y + guard },
                                     .depth_least = SMEAR_DEPTH_MIN, .depth_most = SMEAR_DEPTH_MAX,
                                     .x0 = tile->x0, .y0 = tile->y0, .x1 = tile->x1, .y1 = tile->y1, .tiny_box = TINY8_BOX };
}

static void begin_segment(struct subframe_eights *e, const struct smear_segment *segment)
{
    const struct subframes *f = e->f;
    e->segment = segment;
    smear_raster_eights_make(&e->raster, f->t->frame, &f->work, segment);
    take_vertices(&e->setup, f->t->frame->bins, segment);
    e->setup.words = segment_gouraud(segment) || segment_textured(segment) ? segment->motion : VERTEX_BASE_WORDS;
    e->setup.tiny = e->raster.has_look ? e->raster.look.most : 0;
}

void smear_subframe_eights_draw(struct subframe_eights *e, const struct subframe_pack *pack)
{
    struct poses poses;
    if (pack->segment != e->segment)
        begin_segment(e, pack->segment);
    smear_poses_avx2(&poses, &e->setup, &pack->courses, pack->count);
    if (poses.seen == 0)
        return;
    const struct subframe_box box = { poses.box[0], poses.box[1], poses.box[2], poses.box[3] };
    box_add(e->all, &box);
    smear_raster_poses(&e->raster, pack->color, &poses);
}

void smear_subframe_eights_end(struct subframe_eights *e)
{
    if (e->waiting.count == 0)
        return;
    pack_end(&e->waiting, e->f->t->frame->bins);
    smear_subframe_eights_draw(e, &e->waiting);
    e->waiting.count = 0;
}

bool smear_subframe_eights_add(struct subframe_eights *e, uint32_t triangle)
{
    const struct smear_bins *g = e->f->t->frame->bins;
    const struct smear_segment *const segment = segment_of(g, triangle);
    if (segment == NULL || segment != e->waiting.segment) {
        smear_subframe_eights_end(e);
        pack_begin(&e->waiting, segment);
        if (segment == NULL)
            return false;
    }
    pack_add(&e->waiting, bins_triangle(g, triangle));
    if (e->waiting.count == 8)
        smear_subframe_eights_end(e);
    return true;
}

#endif
