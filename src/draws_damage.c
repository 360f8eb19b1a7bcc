/* SPDX-License-Identifier: MIT */
/* draws_damage.c - what of a frame is damaged (damage.h), by its draws, before they are assembled. */
#include "draws.h"

#include "geometry/pose.h"

#if SMEAR_WITH_DAMAGE

void smear_draws_begin_damage(struct smear_context *c)
{
    struct smear_damage *d = c->damage;
    if (d != NULL && d->compares != COMPARES_NEVER)
        d->compares = c->frame.method == SMEAR_NONE ? COMPARES_THIS : COMPARES_OTHERS;
    if (!smear_method_is_temporal(c->frame.method) && !damage_compares(d))
        damage_forget(d);
}

void smear_draws_end_damage(struct smear_context *c, int result)
{
    if (result == SMEAR_OK && c->damage != NULL && (c->frame.method != SMEAR_NONE || damage_compares(c->damage)))
        smear_damage_end(c->damage, &c->rows, c->frame.method != SMEAR_NONE && c->assembler.path_static_count != 0);
}

/* Finds out whether all that the frame's draws share is the last frame's; `with_static`: and what does not move. */
static void begin_damage(struct smear_context *c, bool with_static)
{
    struct smear_damage *d = c->damage;
    const uint8_t kind = (uint8_t)(c->frame.light_space | c->frame.edges << 1 | damage_compares(d) << 7);
    smear_damage_begin(d, &c->shot.camera[0], c->frame.clear, kind, &c->sun);
    for (uint32_t i = 0; with_static && i < c->draw_count; i++)
        if (!c->raster_draw[i].moves)
            smear_damage_add(d, &c->submitted[i].draw);
    smear_damage_find(d, &c->rows, c->frame.refresh);
    if (SMEAR_OVERLAY_MOST)
        smear_damage_find_overlay(d, &c->rows);
    if (damage_has_tiles(d))
        c->assembler.damaged = &d->tiles;
}

void smear_draws_find_damage(struct smear_context *c)
{
    if (c->damage == NULL)
        return;
    begin_damage(c, true);
    c->assembler.path_static_count = 0;
}

static struct smear_tile_box tiles_of_draw(const struct smear_context *c, uint32_t i)
{
    const smear_draw *draw = &c->submitted[i].draw;
    struct smear_draw_poses poses;
    struct smear_placement at;
    smear_draw_poses_make(&poses, &c->shot, draw, NULL);
    smear_draw_poses_place(&at, &poses, &c->shot, draw->mesh, &smear_instant_now);
    return smear_vertex_tiles(&at, draw->mesh, &c->assembler.viewport, &c->damage->tiles);
}

/* All damaged tiles are known before the first draw is assembled: draws that changed are seen within their bounds. Where exactly,
 * their triangles tell for the next frame, but not where cores assemble parts of whole frames. */
void smear_draws_find_changes(struct smear_context *c)
{
    struct smear_damage *d = c->damage;
    if (!damage_compares(d))
        return;
    begin_damage(c, false);
    const bool in_parts = !d->is_same && c->rows.jobs.workers > 1;
    for (uint32_t i = 0; i < c->draw_count; i++)
        if (smear_damage_compare(d, &c->submitted[i].draw, i)) {
            const struct smear_tile_box none = tile_box_none(), box = d->is_same || in_parts ? tiles_of_draw(c, i) : none;
            smear_damage_move(d, i, &box, c->desc.reuse.buffer_age);
            if (!in_parts)
                damage_draws(d)[i].box = none;
        }
    smear_damage_drop(d, c->draw_count, &c->desc);
    d->tiles.only = d->is_same;
    if (in_parts)
        c->assembler.damaged = NULL;
}

#endif
