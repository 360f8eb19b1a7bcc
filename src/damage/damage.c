/* SPDX-License-Identifier: MIT */
/* damage.c - see damage.h.
 *
 * Scenes are told apart by 64 bits of hash, in which two that differ in one word always differ, and others by
 * chance but for one in 2^64. What draws point to counts as far as it is a few words: vertices, indices and
 * texels only by their place (smear_frame.refresh). */
#include "damage/damage.h"

#include "base/compiled.h"
#include "display/band.h"
#include "draws.h"
#include "methods/sharp.h"

#if SMEAR_WITH_DAMAGE

/* ------------------------------------------------------------------ hash */

/* Two lanes, in each of which every step is a permutation of its state, and of the word. */
SMEAR_NOINLINE void smear_damage_mix(uint32_t h[2], const int32_t *word, int count)
{
    uint32_t h0 = h[0], h1 = h[1];
    for (int i = 0; i < count; i++) {
        h0 = (h0 ^ (uint32_t)word[i]) * 0x85ebca6bu;
        h0 ^= h0 >> 15;
        h1 = ((h1 << 5 | h1 >> 27) ^ (uint32_t)word[i]) * 0xc2b2ae35u;
        h1 ^= h1 >> 13;
    }
    h[0] = h0;
    h[1] = h1;
}

static void mix_transform(uint32_t h[2], const smear_transform *t)
{
    smear_damage_mix(h, t->basis, 9);
    smear_damage_mix(h, t->origin, 3);
}

static void mix_mesh(uint32_t h[2], const smear_mesh *m)
{
    enum { PARTS = 6, WORDS = PARTS * POINTER_WORDS };
    const void *const part[PARTS] = { m->position, m->normal, m->uv, m->color, m->face_color, m->index };
    int32_t word[WORDS + 9];
    for (int i = 0; i < PARTS; i++)
        damage_put_pointer(word + i * POINTER_WORDS, part[i]);
    for (int i = 0; i < 3; i++) {
        word[WORDS + i] = (int32_t)((uint32_t)m->bounds[i] << 16 | (uint16_t)m->bounds[3 + i]);
        word[WORDS + 3 + i] = m->offset[i];
    }
    word[WORDS + 6] = (int32_t)m->triangle_count;
    word[WORDS + 7] = damage_bytes(m->vertex_count >> 8, m->vertex_count & 255, (uint8_t)m->shift, m->uv_shift);
    word[WORDS + 8] = m->scale;
    smear_damage_mix(h, word, WORDS + 9);
}

static void mix_material(uint32_t h[2], const smear_material *m)
{
    static const smear_texture none = { 0 };
    const smear_texture *t = m->texture != NULL ? m->texture : &none;
    int32_t word[5 + 2 * POINTER_WORDS] = {
        damage_bytes(m->color[0], m->color[1], m->color[2], m->color[3]),
        damage_bytes(m->alpha, m->cutoff, m->unlit != 0, (m->double_sided != 0) << 1 | (m->bilinear != 0)),
        (int32_t)((uint32_t)t->width << 16 | t->height), damage_bytes(t->levels, t->format, t->wrap_u, t->wrap_v),
        damage_bytes(0, 0, m->gloss, m->shine)
    };
    damage_put_pointer(word + 5, t->texels);
    damage_put_pointer(word + 5 + POINTER_WORDS, t->palette);
    smear_damage_mix(h, word, (int)(sizeof word / sizeof *word));
}

/* ------------------------------------------------------------------ frames */

void smear_damage_begin(struct smear_damage *d, const smear_camera *camera, uint32_t clear, uint16_t kind,
                        const struct smear_sun *sun)
{
    const int32_t word[] = { camera->focal, camera->half_height, camera->near_plane, camera->far_plane, (int32_t)clear, kind };
    d->next[0] = d->next[1] = 0;
    mix_transform(d->next, &camera->pose);
    smear_damage_mix(d->next, word, (int)(sizeof word / sizeof *word));
    for (int i = 0; i < 3; i++) {
        const int32_t light[] = { sun->direction[i], sun->ambient[i], sun->diffuse[i] };
        smear_damage_mix(d->next, light, 3);
    }
    if (SMEAR_WITH_LIGHTS && sun->lights != NULL)
        smear_damage_mix(d->next, sun->lights->word, LIGHTS_WORDS);
}

/* Takes in as much of a draw as its picture depends on. */
static void mix_draw(uint32_t h[2], const smear_draw *draw)
{
    const int32_t look = (int32_t)draw->billboard << 1 | (draw->material != NULL);
    mix_mesh(h, draw->mesh);
    mix_transform(h, draw->now);
    smear_damage_mix(h, &look, 1);
    if (draw->material != NULL)
        mix_material(h, draw->material);
}

void smear_damage_add(struct smear_damage *d, const smear_draw *draw)
{
    mix_draw(d->next, draw);
}

void smear_damage_find(struct smear_damage *d, const struct smear_rows *rows, bool refresh)
{
    if (SMEAR_WITH_FOG && frame_has_fog(&rows->raster)) {
        const struct smear_fog_levels *fog = frame_fog(&rows->raster);
        const int32_t word[] = { (int32_t)fog->scale, fog->shift, fog->base };
        smear_damage_mix(d->next, word, 3);
    }
    if (rows_have_sky(rows))
        smear_damage_mix(d->next, (const int32_t *)(const void *)rows->sky, (int)(offsetof(smear_sky, kind) / sizeof(int32_t)));
    d->is_same = d->is_whole && !refresh && d->next[0] == d->scene[0] && d->next[1] == d->scene[1];
    d->is_whole = false;
    d->scene[0] = d->next[0];
    d->scene[1] = d->next[1];
    if (!damage_has_tiles(d) || d->is_same)
        return;
    for (uint32_t i = 0; !damage_compares(d) && i < rows->desc->max_draws; i++)
        d->seen[i] = tile_box_none();
    for (int32_t i = 0; i < rows->window.columns * rows->window.rows; i++)
        d->tiles.tile[i] = rows->desc->reuse.buffer_age;
}

/* ------------------------------------------------------------------ draws of sharp frames */

/* Has tiles of a box drawn. */
static void damage_box(const struct smear_damaged_tiles *t, const struct smear_tile_box *box, uint8_t age)
{
    for (int row = box->y0; row <= box->y1; row++)
        for (int column = box->x0; column <= box->x1; column++)
            t->tile[row * (t->columns + 1) + column] = age;
}

/* A mesh whose vertices go elsewhere has written them. */
static bool deforms(const smear_draw *draw)
{
    return draw->open_position != NULL || draw->close_position != NULL;
}

bool smear_damage_compare(struct smear_damage *d, const smear_draw *draw, uint32_t i)
{
    struct smear_damaged_draw *const r = &damage_draws(d)[i];
    uint32_t look[2] = { 0, 0 };
    mix_draw(look, draw);
    r->changed = !d->is_same || deforms(draw) || look[0] != r->look[0] || look[1] != r->look[1];
    r->look[0] = look[0];
    r->look[1] = look[1];
    return r->changed;
}

void smear_damage_move(struct smear_damage *d, uint32_t i, const struct smear_tile_box *box, uint8_t age)
{
    struct smear_damaged_draw *const r = &damage_draws(d)[i];
    if (d->is_same) {
        damage_box(&d->tiles, &r->box, age);
        damage_box(&d->tiles, box, age);
    }
    r->box = *box;
}

void smear_damage_drop(struct smear_damage *d, uint32_t first, const smear_desc *desc)
{
    const struct smear_tile_box none = tile_box_none();
    for (uint32_t i = first; i < desc->max_draws; i++) {
        smear_damage_move(d, i, &none, desc->reuse.buffer_age);
        damage_draws(d)[i].look[0] = damage_draws(d)[i].look[1] = 0;
    }
}

void smear_damage_end(struct smear_damage *d, struct smear_rows *rows, bool disturbed)
{
    rows->stats->static_cached = static_is_cached(d);
    d->is_whole = !d->caches || !disturbed;
}

/* ------------------------------------------------------------------ tiles that the display keeps */

bool smear_damage_next_run(const struct smear_damage *d, const struct smear_rows *rows, int row,
                           struct smear_damage_run *run)
{
    const int columns = (int)rows->window.columns;
    int first = run->end;
    run->end = columns;
    if (damage_has_tiles(d) && d->is_same) {    /* where a frame forgets, nothing is known of tiles */
        const uint8_t *tile = &d->tiles.tile[row * columns];
        while (first < columns && tile[first] == 0)
            first++;
        for (run->end = first; run->end < columns && tile[run->end] != 0;)
            run->end++;
    }
    run->first = first;
    return first < columns;
}

/* What a tile with moving triangles shows is right for none of the buffers later. */
void smear_damage_row_sent(struct smear_damage *d, const struct smear_rows *rows, int row)
{
    if (!damage_has_tiles(d))
        return;
    uint8_t *tile = &d->tiles.tile[row * rows->window.columns];
    for (int32_t i = 0; i < rows->window.columns; i++) {
        rows->stats->tiles_kept += d->is_same && tile[i] == 0;
        tile[i] = (tile[i] & TILE_DAMAGED_NOW) != 0 ? rows->desc->reuse.buffer_age
                : tile[i] != 0 ? (uint8_t)(tile[i] - 1) : 0;
    }
}

/* ------------------------------------------------------------------ draws and tiles that are drawn again: see draws.h */

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
