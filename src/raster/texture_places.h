/* SPDX-License-Identifier: MIT */
/* texture_places.h - rows of copied texels whose pixels have a place each, by a kernel. */
#ifndef SMEAR_TEXTURE_PLACES_H
#define SMEAR_TEXTURE_PLACES_H

#include "kernels/texel_place_rows_armv6m.h"
#include "kernels/texel_place_rows_armv7em.h"
#include "raster/texture_rows.h"

static inline struct texel_plane plane_of(const struct plane *p)
{
    return (struct texel_plane){ p->at, p->dx, p->dy };
}

/* Whole rows that are no longer than those of single pixels. False where places are not divided. */
static inline bool draw_whole_places(const struct setup *s, const struct span_rows *r)
{
    const struct smear_raster_target *target = s->target;
    const struct texture_setup *t = &s->texture;
    const struct smear_sampler *m = &s->draw->sampler;
    if (!TEXEL_PLACE_ROWS || t->mode != TEXTURE_DIVIDED)
        return false;
    struct texel_place_rows rows = {
        .side = r->side, .count = r->count, .y = r->y, .z = code_from_units(plane_at(&s->depth, 0, r->y), s->slope),
        .dz_down = (uint32_t)step_from_units(s->depth.dy, s->slope), .depth = target->depth + r->at,
        .stride = 2 * target->window_rows.stride, .longest = t->block > 1 ? (int32_t)SHORT_SPAN : INT32_MAX,
        .dz = (uint32_t)step_from_units(s->depth.dx, s->slope), .q = plane_of(&t->q), .u = plane_of(&t->uv[0]),
        .v = plane_of(&t->uv[1]), .seed = smear_recip_seed, .up = t->up, .from_u = 32 - m->log2_width, .from_v = 32 - m->log2_height,
        .to_v = m->log2_width, .texels = m->texels, .to_color = (int32_t)((uintptr_t)target->direct - (uintptr_t)target->depth)
    };
    texel_place_rows_draw(&rows);
    return true;
}

#endif
