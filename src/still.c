/* SPDX-License-Identifier: MIT */
/* still.c - see still.h. What draws point to is compared as far as it is a few words: vertices, indices and
 * texels only by their place (smear_frame.refresh). */
#include "still.h"

#if SMEAR_WITH_SUBFRAMES

/* All of it, not its poses alone. */
static bool same_camera(const smear_camera *a, const smear_camera *b)
{
    return same_transform(&a->pose, &b->pose) && a->focal == b->focal && a->half_height == b->half_height
        && a->near_plane == b->near_plane && a->far_plane == b->far_plane;
}

static bool same_mesh(const smear_mesh *a, const smear_mesh *b)
{
    return a->position == b->position && a->normal == b->normal && a->uv == b->uv && a->color == b->color
        && a->face_color == b->face_color && a->index == b->index && a->triangle_count == b->triangle_count
        && a->vertex_count == b->vertex_count && a->shift == b->shift && a->uv_shift == b->uv_shift
        && a->scale == b->scale && a->offset[0] == b->offset[0] && a->offset[1] == b->offset[1]
        && a->offset[2] == b->offset[2];
}

static bool same_texture(const smear_texture *a, const smear_texture *b)
{
    return a->texels == b->texels && a->palette == b->palette && a->width == b->width && a->height == b->height
        && a->format == b->format && a->wrap_u == b->wrap_u && a->wrap_v == b->wrap_v;
}

static bool same_material(const smear_material *a, const smear_material *b)
{
    for (int i = 0; i < 4; i++)
        if (a->color[i] != b->color[i])
            return false;
    return a->texture == b->texture && a->alpha == b->alpha && a->cutoff == b->cutoff && a->unlit == b->unlit
        && a->double_sided == b->double_sided && a->bilinear == b->bilinear;
}

static bool same_draw(const struct smear_still_draw *a, const struct smear_still_draw *b)
{
    return same_mesh(&a->mesh, &b->mesh) && same_material(&a->material, &b->material)
        && same_texture(&a->texture, &b->texture) && same_transform(&a->now, &b->now)
        && a->billboard == b->billboard;
}

static struct smear_still_draw look_at(const smear_draw *d)
{
    struct smear_still_draw look = { .mesh = *d->mesh, .billboard = d->billboard };
    look.now = d->now != NULL ? *d->now : smear_identity;
    if (d->material != NULL)
        look.material = *d->material;
    if (look.material.texture != NULL)
        look.texture = *look.material.texture;
    return look;
}

void smear_still_begin(struct smear_context *c)
{
    struct smear_still *s = c->still;
    if (s == NULL)
        return;
    c->assembler.path_still_count = 0;
    bool same = s->is_whole && !c->frame.refresh && same_camera(&s->camera, &c->camera)
             && s->clear == c->frame.clear && s->light == c->frame.light;
    uint32_t count = 0;
    for (uint32_t i = 0; i < c->draw_count; i++) {
        if (!draw_stands_still(c, i))
            continue;
        const struct smear_still_draw look = look_at(&c->submitted[i].draw);
        same = same && count < s->count && same_draw(&s->draw[count], &look);
        s->draw[count++] = look;
    }
    s->holds = same && count == s->count;
    s->is_whole = false;
    s->count = count;
    s->camera = c->camera;
    s->clear = c->frame.clear;
    s->light = c->frame.light;
}

void smear_still_end(struct smear_context *c)
{
    if (c->still == NULL)
        return;
    c->stats.still_kept = c->still->holds;
    /* triangles with paths of no length were drawn among what stands still */
    c->still->is_whole = c->assembler.path_still_count == 0;
}

#endif
