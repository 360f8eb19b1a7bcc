/* SPDX-License-Identifier: MIT */
/* damage.c - see damage.h.
 *
 * Scenes are told apart by 64 bits of hash, in which two that differ in one word always differ, and others by
 * chance but for one in 2^64. What draws point to counts as far as it is a few words: vertices, indices and
 * texels only by their place (smear_frame.refresh). */
#include "display/damage.h"

#if SMEAR_WITH_DAMAGE

/* ------------------------------------------------------------------ hash */

/* Two lanes, in each of which every step is a permutation of its state, and of the word. */
static SMEAR_NOINLINE void mix(uint32_t h[2], const int32_t *word, int count)
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

/* A pointer as two words. */
static int32_t low(const void *p)
{
    return (int32_t)(uint32_t)(uintptr_t)p;
}

static int32_t high(const void *p)
{
    return (int32_t)(uint32_t)((uint64_t)(uintptr_t)p >> 32);
}

static int32_t bytes(int a, int b, int c, int d)
{
    return (int32_t)((uint32_t)a << 24 | (uint32_t)b << 16 | (uint32_t)c << 8 | (uint32_t)d);
}

static void mix_transform(uint32_t h[2], const smear_transform *t)
{
    mix(h, t->basis, 9);
    mix(h, t->origin, 3);
}

static void mix_mesh(uint32_t h[2], const smear_mesh *m)
{
    const void *const part[6] = { m->position, m->normal, m->uv, m->color, m->face_color, m->index };
    int32_t word[24];
    for (int i = 0; i < 6; i++) {
        word[2 * i] = low(part[i]);
        word[2 * i + 1] = high(part[i]);
        word[12 + i] = m->bounds[i];
    }
    word[18] = (int32_t)m->triangle_count;
    word[19] = bytes(m->vertex_count >> 8, m->vertex_count & 255, (uint8_t)m->shift, m->uv_shift);
    word[20] = m->scale;
    for (int i = 0; i < 3; i++)
        word[21 + i] = m->offset[i];
    mix(h, word, 24);
}

static void mix_material(uint32_t h[2], const smear_material *m)
{
    static const smear_texture none = { 0 };
    const smear_texture *t = m->texture != NULL ? m->texture : &none;
    const int32_t word[] = {
        bytes(m->color[0], m->color[1], m->color[2], m->color[3]),
        bytes(m->alpha, m->cutoff, m->unlit, m->double_sided << 1 | m->bilinear),
        low(t->texels), high(t->texels), low(t->palette), high(t->palette),
        (int32_t)((uint32_t)t->width << 16 | t->height), bytes(0, t->format, t->wrap_u, t->wrap_v)
    };
    mix(h, word, (int)(sizeof word / sizeof *word));
}

/* As much of a draw as its picture depends on. */
static void mix_draw(uint32_t h[2], const smear_draw *d)
{
    const int32_t look = (int32_t)d->billboard << 1 | (d->material != NULL);
    mix_mesh(h, d->mesh);
    mix_transform(h, d->now != NULL ? d->now : &smear_identity);
    mix(h, &look, 1);
    if (d->material != NULL)
        mix_material(h, d->material);
}

/* And of a frame. */
static void mix_frame(uint32_t h[2], const struct smear_context *c)
{
    const smear_camera *camera = &c->camera;
    const int32_t word[] = { camera->focal, camera->half_height, camera->near_plane, camera->far_plane,
                             (int32_t)(c->frame.clear << 8 | c->frame.light) };
    mix_transform(h, &camera->pose);
    mix(h, word, (int)(sizeof word / sizeof *word));
}

/* ------------------------------------------------------------------ frames */

void smear_damage_begin(struct smear_context *c)
{
    struct smear_damage *s = c->still;
    if (s == NULL)
        return;
    uint32_t scene[2] = { 0, 0 };
    mix_frame(scene, c);
    for (uint32_t i = 0; i < c->draw_count; i++)
        if (!c->raster_draw[i].moves)
            mix_draw(scene, &c->submitted[i].draw);
    s->is_same = s->is_whole && !c->frame.refresh && scene[0] == s->scene[0] && scene[1] == s->scene[1];
    s->is_whole = false;
    s->scene[0] = scene[0];
    s->scene[1] = scene[1];
    c->assembler.path_static_count = 0;
    if (s->due.tile == NULL)
        return;
    c->assembler.due = &s->due;
    for (uint32_t i = 0; !s->is_same && i < c->desc.max_draws; i++)
        s->seen[i] = (struct smear_tile_box){ UINT8_MAX, 0, UINT8_MAX, 0 };
    if (!s->is_same)
        for (int32_t i = 0; i < c->window.columns * c->window.rows; i++)
            s->due.tile[i] = c->desc.buffer_age;
}

void smear_damage_end(struct smear_context *c)
{
    struct smear_damage *s = c->still;
    if (s == NULL)
        return;
    c->stats.static_cached = static_is_cached(c);
    /* triangles with paths of no length were drawn among what stands still */
    s->is_whole = !s->keeps || c->assembler.path_static_count == 0;
}

/* ------------------------------------------------------------------ tiles that the display keeps */

bool smear_damage_next_run(const struct smear_context *c, int row, struct smear_damage_run *run)
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

/* What a tile with moving triangles shows is right for none of the buffers later. */
void smear_damage_row_sent(struct smear_context *c, int row)
{
    if (c->still == NULL || c->still->due.tile == NULL)
        return;
    uint8_t *due = &c->still->due.tile[row * c->window.columns];
    for (int32_t i = 0; i < c->window.columns; i++) {
        c->stats.tiles_kept += due[i] == 0;
        due[i] = (due[i] & TILE_DAMAGED_NOW) != 0 ? c->desc.buffer_age : due[i] != 0 ? (uint8_t)(due[i] - 1) : 0;
    }
}

#endif
