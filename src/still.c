/* SPDX-License-Identifier: MIT */
/* still.c - see still.h.
 *
 * Scenes are told apart by 64 bits of hash, in which two that differ in one word always differ, and others by
 * chance but for one in 2^64. What draws point to counts as far as it is a few words: vertices, indices and
 * texels only by their place (smear_frame.refresh). */
#include "still.h"

#if SMEAR_WITH_STILL

/* ------------------------------------------------------------------ hash */

/* Two lanes, in each of which every step is a permutation of its state, and of the word. */
static void mix(uint32_t h[2], uint32_t word)
{
    h[0] = (h[0] ^ word) * 0x85ebca6bu;
    h[0] ^= h[0] >> 15;
    h[1] = ((h[1] << 5 | h[1] >> 27) ^ word) * 0xc2b2ae35u;
    h[1] ^= h[1] >> 13;
}

static void mix_pointer(uint32_t h[2], const void *p)
{
    const uint64_t place = (uintptr_t)p;
    mix(h, (uint32_t)place);
    if (sizeof p > 4)
        mix(h, (uint32_t)(place >> 32));
}

static void mix_words(uint32_t h[2], const int32_t *word, int count)
{
    for (int i = 0; i < count; i++)
        mix(h, (uint32_t)word[i]);
}

static void mix_transform(uint32_t h[2], const smear_transform *t)
{
    mix_words(h, t->basis, 9);
    mix_words(h, t->origin, 3);
}

static void mix_camera(uint32_t h[2], const smear_camera *c)
{
    mix_transform(h, &c->pose);
    const int32_t lens[4] = { c->focal, c->half_height, c->near_plane, c->far_plane };
    mix_words(h, lens, 4);
}

static void mix_mesh(uint32_t h[2], const smear_mesh *m)
{
    const void *const part[6] = { m->position, m->normal, m->uv, m->color, m->face_color, m->index };
    for (int i = 0; i < 6; i++)
        mix_pointer(h, part[i]);
    mix(h, m->triangle_count);
    mix(h, (uint32_t)m->vertex_count << 16 | (uint32_t)(uint8_t)m->shift << 8 | m->uv_shift);
    mix(h, (uint32_t)m->scale);
    mix_words(h, m->offset, 3);
    for (int i = 0; i < 6; i++)
        mix(h, (uint32_t)m->bounds[i]);
}

static void mix_texture(uint32_t h[2], const smear_texture *t)
{
    mix_pointer(h, t->texels);
    mix_pointer(h, t->palette);
    mix(h, (uint32_t)t->width << 16 | t->height);
    mix(h, (uint32_t)t->format << 16 | (uint32_t)t->wrap_u << 8 | t->wrap_v);
}

static void mix_material(uint32_t h[2], const smear_material *m)
{
    const uint8_t *color = m->color;
    mix(h, (uint32_t)color[0] << 24 | (uint32_t)color[1] << 16 | (uint32_t)color[2] << 8 | color[3]);
    mix(h, (uint32_t)m->alpha << 24 | (uint32_t)m->cutoff << 16 | (uint32_t)m->unlit << 2
               | (uint32_t)m->double_sided << 1 | m->bilinear);
    mix(h, m->texture != NULL);
    if (m->texture != NULL)
        mix_texture(h, m->texture);
}

static void mix_draw(uint32_t h[2], const smear_draw *d)
{
    mix_mesh(h, d->mesh);
    mix_transform(h, d->now != NULL ? d->now : &smear_identity);
    mix(h, (uint32_t)d->billboard << 1 | (d->material != NULL));
    if (d->material != NULL)
        mix_material(h, d->material);
}

/* ------------------------------------------------------------------ frames */

void smear_still_begin(struct smear_context *c)
{
    struct smear_still *s = c->still;
    if (s == NULL)
        return;
    uint32_t scene[2] = { 0, 0 };
    mix_camera(scene, &c->camera);
    mix(scene, c->frame.clear << 8 | c->frame.light);
    for (uint32_t i = 0; i < c->draw_count; i++)
        if (!c->raster_draw[i].moves)
            mix_draw(scene, &c->submitted[i].draw);
    s->is_same = s->is_whole && !c->frame.refresh && scene[0] == s->scene[0] && scene[1] == s->scene[1];
    s->is_whole = false;
    s->scene[0] = scene[0];
    s->scene[1] = scene[1];
    c->assembler.path_still_count = 0;
    if (s->due.tile == NULL)
        return;
    c->assembler.due = &s->due;
    for (uint32_t i = 0; !s->is_same && i < c->desc.max_draws; i++)
        s->seen[i] = (struct smear_tile_box){ UINT8_MAX, 0, UINT8_MAX, 0 };
    if (!s->is_same)
        for (int32_t i = 0; i < c->window.columns * c->window.rows; i++)
            s->due.tile[i] = c->desc.display_buffers;
}

void smear_still_end(struct smear_context *c)
{
    struct smear_still *s = c->still;
    if (s == NULL)
        return;
    c->stats.still_kept = still_holds(c);
    /* triangles with paths of no length were drawn among what stands still */
    s->is_whole = !s->keeps || c->assembler.path_still_count == 0;
}

/* ------------------------------------------------------------------ tiles that the display keeps */

bool smear_still_next_run(const struct smear_context *c, int row, struct smear_tile_run *run)
{
    const int columns = (int)c->window.columns;
    int first = run->end;
    run->end = columns;
    if (c->still != NULL && c->still->due.tile != NULL) {
        const uint8_t *due = &c->still->due.tile[row * columns];
        while (first < columns && due[first] == 0)
            first++;
        for (run->end = first; run->end < columns && due[run->end] != 0;)
            run->end++;
    }
    run->first = first;
    return first < columns;
}

/* What a tile with movers shows is right for none of the buffers later. */
void smear_still_row_sent(struct smear_context *c, int row)
{
    if (c->still == NULL || c->still->due.tile == NULL)
        return;
    uint8_t *due = &c->still->due.tile[row * c->window.columns];
    for (int32_t i = 0; i < c->window.columns; i++) {
        c->stats.tiles_kept += due[i] == 0;
        due[i] = (due[i] & TILE_DUE_NOW) != 0 ? c->desc.display_buffers : due[i] != 0 ? (uint8_t)(due[i] - 1) : 0;
    }
}

#endif
