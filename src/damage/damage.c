/* SPDX-License-Identifier: MIT */
/* damage.c - see damage.h.
 *
 * Scenes are told apart by 64 bits of hash, in which two that differ in one word always differ, and others by
 * chance but for one in 2^64. What draws point to counts as far as it is a few words: vertices, indices and
 * texels only by their place (smear_frame.refresh). */
#include "damage/damage.h"

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

#endif
