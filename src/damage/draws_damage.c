/* SPDX-License-Identifier: MIT */
/* draws_damage.c - which draws and tiles of a frame are drawn again: see draws.h. */
#include "base/compiled.h"
#include "damage/damage.h"
#include "display/band.h"
#include "draws.h"
#include "methods/sharp.h"

#if SMEAR_WITH_DAMAGE

void smear_damage_lay_out(struct smear_context *c, struct smear_arena *a, const smear_desc *d)
{
    const struct smear_window *w = &c->rows.window;
    const bool tiles = has_buffer_age(d);
    const bool compares = compares_sharp(d);
    struct smear_tile_box *seen = tiles && is_temporal(d) ? arena_take(a, d->max_draws, sizeof *seen) : NULL;
    uint32_t *over = SMEAR_OVERLAY_MOST && tiles ? arena_take(a, (size_t)w->columns * (size_t)w->rows, sizeof *over) : NULL;
    const struct smear_damaged_tiles damaged = {
        tiles ? arena_take(a, (size_t)w->columns * (size_t)w->rows, 1) : NULL,
        (uint8_t)(w->columns - 1), (uint8_t)w->tile_shift, false, NULL
    };
    const size_t draws = compares ? d->max_draws * sizeof(struct smear_damaged_draw) : 0;
    c->damage = c->temporal.damage = arena_take(a, 1, sizeof *c->damage + draws);
    if (c->damage == NULL)          /* only measured */
        return;
    *c->damage = (struct smear_damage){ .caches = caches_static(d), .compares = (uint8_t)(compares ? COMPARES_OTHERS : COMPARES_NEVER),
                                        .tiles = damaged, .seen = seen, .over = over };
    if (over != NULL)
        __builtin_memset(over, 0, (size_t)w->columns * (size_t)w->rows * sizeof *over);
    if (tiles)                      /* counted on where a frame finds out nothing, too */
        __builtin_memset(damaged.tile, 0, (size_t)w->columns * (size_t)w->rows);
}

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
    const uint16_t kind = (uint16_t)(c->frame.light_space | c->frame.edges << 1 | damage_compares(d) << 2 | (c->shot.reach & 127) << 3);
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

/* Finds the box of the corners of the bounds, in q8 px. False where one lies before the near plane. */
static bool find_corners(struct smear_screen *least, struct smear_screen *most, const struct smear_placement *p, const int16_t b[6],
                         const struct smear_viewport *viewport)
{
    *least = (struct smear_screen){ .x = INT32_MAX, .y = INT32_MAX };
    *most = (struct smear_screen){ .x = INT32_MIN, .y = INT32_MIN };
    for (int i = 0; i < 8; i++) {
        const int16_t corner[3] = { b[(i & 1) * 3], b[(i >> 1 & 1) * 3 + 1], b[(i >> 2) * 3 + 2] };
        struct smear_homogeneous h;
        struct smear_screen s;
        transform_vertex(&h, &p->now, corner);
        if (((unsigned)placement_see(&s, &h, p, viewport) & OUT_NEAR) != 0 || h.w <= 0)
            return false;
        least->x = min_i32(least->x, s.x);
        least->y = min_i32(least->y, s.y);
        most->x = max_i32(most->x, s.x);
        most->y = max_i32(most->y, s.y);
    }
    return true;
}

/* Finds the tiles in which something of a draw may be seen, by its bounds: all where those are not given, or reach behind the
 * near plane. */
static struct smear_tile_box tiles_of_draw(const struct smear_context *c, uint32_t i)
{
    const smear_draw *draw = &c->submitted[i].draw;
    struct smear_draw_poses poses;
    struct smear_placement at;
    smear_draw_poses_make(&poses, &c->shot, draw, NULL);
    smear_draw_poses_place(&at, &poses, &c->shot, draw->mesh, &smear_instant_now);
    enum { MARGIN = 2 << 8 };       /* q8 px: more than places of vertices are rounded by */
    const struct smear_damaged_tiles *tiles = &c->damage->tiles;
    const struct smear_viewport *viewport = &c->assembler.viewport;
    const int16_t *b = draw->mesh->bounds;
    struct smear_screen least, most;
    if ((b[0] | b[1] | b[2] | b[3] | b[4] | b[5]) == 0 || at.extra_count != 0 || at.position != draw->mesh->position
        || !find_corners(&least, &most, &at, b, viewport))
        return tile_box_of(tiles, 0, viewport->width, 0, viewport->height);
    const int32_t x0 = max_i32((least.x - MARGIN) >> 8, 0), x1 = min_i32((most.x + MARGIN) >> 8, viewport->width);
    const int32_t y0 = max_i32((least.y - MARGIN) >> 8, 0), y1 = min_i32((most.y + MARGIN) >> 8, viewport->height);
    return x0 < x1 && y0 < y1 ? tile_box_of(tiles, x0, x1, y0, y1) : tile_box_none();
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

/* Whether a sharp frame of which the display shows a part lacks a draw. */
static bool is_lacking(struct smear_damage *d, uint32_t i)
{
    struct smear_damaged_draw *const r = &damage_draws(d)[i];
    d->tiles.seen = r->changed ? &r->box : NULL;
    return r->changed || tile_box_is_damaged(&d->tiles, r->box);
}

bool smear_draws_is_damaged(struct smear_context *c, uint32_t i, bool known, struct smear_tile_box **seen)
{
    struct smear_damage *d = c->damage;
    if (damage_compares(d))
        return is_lacking(d, i);
    const bool is_static = draw_is_static(c, i);
    if (is_static)
        *seen = *seen == NULL ? d->seen : *seen + 1;
    d->tiles.only = is_static && d->is_same && known;
    d->tiles.seen = !is_static || d->is_same ? NULL : *seen;
    return !d->tiles.only || tile_box_is_damaged(&d->tiles, **seen);
}

/* ------------------------------------------------------------------ rows of sharp frames */

/* Draws a run of tiles of a row whose lists have been moved on. */
static int draw_damaged_run(struct smear_rows *rows, int row, const struct smear_damage_run *run)
{
    struct row_job job = { .rows = rows, .row = row };
    const uint32_t start = stage_start(rows);
    job.x0 = tile_left(rows, run->first);
    job.x1 = tile_right(rows, run->end - 1);
    smear_row_run(rows, smear_sharp_draw_job, &job, FILL_STATIC | FILL_MOVING);
    smear_row_blend_columns(&job);
    stage_end(rows, &rows->stats->time.raster, start);
    return smear_band_finish(&job);
}

static int draw_damaged_row(struct smear_rows *rows, struct smear_damage *damage, int row)
{
    struct smear_damage_run run = { 0, 0 };
    int result = SMEAR_OK;
    const uint32_t start = stage_start(rows);
    smear_sharp_advance_lists(rows, row);
    row_advance_blended(rows, row);
    stage_end(rows, &rows->stats->time.raster, start);
    while (result == SMEAR_OK && smear_damage_next_run(damage, rows, row, &run))
        result = draw_damaged_run(rows, row, &run);
    smear_damage_row_sent(damage, rows, row);
    return result;
}

int smear_damage_rows(struct smear_rows *rows, struct smear_damage *damage, int first, int end)
{
    int result = SMEAR_OK;
    for (int row = first; row < end && result == SMEAR_OK; row++)
        result = draw_damaged_row(rows, damage, row);
    return result;
}

#endif
