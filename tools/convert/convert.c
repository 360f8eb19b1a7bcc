/* SPDX-License-Identifier: MIT */
/* convert.c - the order of a conversion's stages, and what they share. See convert.h. */
#include "tools/convert/build.h"

#include "tools/model/exact.h"

#include "tools/model/matrix.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ------------------------------------------------------------------ memory */

void *pile_alloc(struct convert_pile *pile, size_t count, size_t size, struct failure *f)
{
    if (pile->count == pile->room
        && !grow((void **)&pile->block, &pile->room, pile->count + 1, sizeof *pile->block, f))
        return NULL;
    void *block = calloc(count > 0 ? count : 1, size);
    if (block == NULL)
        out_of_memory(f);
    else
        pile->block[pile->count++] = block;
    return block;
}

void pile_free(struct convert_pile *pile)
{
    for (int i = 0; i < pile->count; i++)
        free(pile->block[i]);
    free(pile->block);
    free(pile);
}

void *list_add(struct list *l, int count, struct failure *f)
{
    if (count > (1 << 30) - l->count) {
        fail(f, "is too large");
        return NULL;
    }
    /* room for one more, so that the address of nothing is not null */
    if (!grow(&l->data, &l->room, l->count + count + 1, l->size, f))
        return NULL;
    void *added = (char *)l->data + (size_t)l->count * l->size;
    memset(added, 0, (size_t)count * l->size);
    l->count += count;
    return added;
}

void *list_keep(struct list *l, struct convert_pile *pile, struct failure *f)
{
    void *kept = pile_alloc(pile, (size_t)l->count, l->size, f);
    if (kept != NULL && l->count > 0)
        memcpy(kept, l->data, (size_t)l->count * l->size);
    return kept;
}

void list_free(struct list *l)
{
    free(l->data);
    l->data = NULL;
    l->count = l->room = 0;
}

/* ------------------------------------------------------------------ small things */

static double column_length(const double m[16], int column)
{
    const double *a = m + 4 * column;
    return sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
}

double largest_column(const double m[16])
{
    return fmax(column_length(m, 0), fmax(column_length(m, 1), column_length(m, 2)));
}

void transform_double(double out[3], const double m[16], const double p[3])
{
    for (int row = 0; row < 3; row++)
        out[row] = m[row] * p[0] + m[4 + row] * p[1] + m[8 + row] * p[2] + m[12 + row];
}

bool is_identity(const double m[16])
{
    double identity[16];
    matrix_identity(identity);
    for (int i = 0; i < 16; i++)
        if (m[i] != identity[i])
            return false;
    return true;
}

bool to_fixed(int32_t *out, double x, int fraction_bits, double limit, struct failure *f)
{
    if (!(fabs(x) <= limit))
        return fail(f, "a transform is out of range (%g): use --scale or --fit", x);
    *out = (int32_t)floor(ldexp(x, fraction_bits) + 0.5);
    return true;
}

/* ------------------------------------------------------------------ the world */

/* The file's world to the result's, and what a pixel is. */
static bool choose_world(struct converter *c)
{
    const struct convert_options *o = c->options;
    struct model_pose pose = { 0 };
    double min[3], max[3], radius = 0, extent = 0, scale = o->scale;
    bool ok = model_pose(c->model, MODEL_CLIP_NONE, 0, false, &pose, c->f);
    bool any = ok && model_pose_bounds(&pose, min, max);
    model_pose_free(&pose);
    if (!ok)
        return false;
    if (!any)
        return fail(c->f, "has nothing to draw");
    for (int k = 0; k < 3; k++) {
        radius += (max[k] - min[k]) * (max[k] - min[k]);
        extent = fmax(extent, max[k] - min[k]);
    }
    radius = sqrt(radius) / 2;
    if (o->fit > 0 && extent > 0)
        scale = o->fit / extent;
    matrix_identity(c->root);
    for (int k = 0; k < 3; k++)
        c->root[5 * k] = scale;
    if (o->z_up) {
        c->root[5] = c->root[10] = 0;
        c->root[6] = -scale;
        c->root[9] = scale;
    }
    double half = o->fov_degrees * 3.14159265358979323846 / 360;
    c->out->distance = o->distance > 0 ? o->distance : radius > 0 ? radius * scale / exact_sin(half) : 1;
    c->out->pixels_per_unit = o->rows * exact_cos(half) / (2 * exact_sin(half) * c->out->distance);
    c->tolerance = o->clip_error_px / c->out->pixels_per_unit / 4;
    memcpy(c->out->root, c->root, sizeof c->root);
    return true;
}

/* Returns a channel of light, linear, 65535 is one. */
static uint16_t channel_of(double value, double part)
{
    return (uint16_t)(65535 * part * value + 0.5);
}

/* The file's lights in the result's world. As everywhere, 3/10 of the sun come from everywhere. */
static bool find_lights(struct converter *c)
{
    struct conversion *out = c->out;
    struct model_lights lights;
    double turned[3][3] = { { 0 } };
    const double scale = fabs(c->root[0]);
    if (!model_find_lights(c->model, &lights, c->f))
        return false;
    const double *const from[3] = { lights.direction[MODEL_SUN], lights.direction[MODEL_SECOND], lights.place };
    for (int i = 0; i < MODEL_LIGHTS; i++)
        for (int row = 0; row < 3; row++)
            for (int k = 0; k < 3; k++)
                turned[i][row] += c->root[4 * k + row] * from[i][k];
    for (int k = 0; k < 3; k++)
        out->lamp_is_beyond |= lights.has[MODEL_LAMP] && !(fabs(turned[MODEL_LAMP][k]) < 32767);
    out->has_sun = lights.has[MODEL_SUN];
    lights.has[MODEL_LAMP] &= !out->lamp_is_beyond;
    out->has_lights = lights.has[MODEL_SECOND] || lights.has[MODEL_LAMP];
    for (int k = 0; k < 3; k++) {
        out->sun.direction[k] = (int32_t)floor(turned[MODEL_SUN][k] / scale * 65536 + 0.5);
        out->sun.ambient[k] = channel_of(lights.color[MODEL_SUN][k], 0.3);
        out->sun.diffuse[k] = channel_of(lights.color[MODEL_SUN][k], 0.7);
        out->lights.direction[k] = (int32_t)floor(turned[MODEL_SECOND][k] / scale * 65536 + 0.5);
        out->lights.diffuse[k] = channel_of(lights.color[MODEL_SECOND][k], 1);
        if (lights.has[MODEL_LAMP]) {
            out->lights.lamp_diffuse[k] = channel_of(lights.color[MODEL_LAMP][k], 1);
            out->lights.lamp[k] = (int32_t)floor(turned[MODEL_LAMP][k] * 65536 + 0.5);
        }
    }
    if (lights.has[MODEL_LAMP])
        out->lights.reach = (int32_t)(fmin(lights.reach * scale, 32767) * 65536);
    return true;
}

/* ------------------------------------------------------------------ the result */

static bool keep_lists(struct converter *c)
{
    struct conversion *out = c->out;
    smear_model *m = &out->model;
    m->mesh = list_keep(&c->mesh, c->pile, c->f);
    m->draw = list_keep(&c->draws, c->pile, c->f);
    m->joint = list_keep(&c->joint, c->pile, c->f);
    m->skin = list_keep(&c->skins, c->pile, c->f);
    m->influence = list_keep(&c->influence, c->pile, c->f);
    m->target = list_keep(&c->target, c->pile, c->f);
    m->delta = list_keep(&c->delta, c->pile, c->f);
    m->delta_normal = list_keep(&c->delta_normal, c->pile, c->f);
    m->clip = list_keep(&c->clip, c->pile, c->f);
    m->channel = list_keep(&c->channel, c->pile, c->f);
    m->key_time = list_keep(&c->key_time, c->pile, c->f);
    m->key_value = list_keep(&c->key_value, c->pile, c->f);
    m->text = list_keep(&c->text, c->pile, c->f);
    out->texture_report = list_keep(&c->texture_report, c->pile, c->f);
    if (m->mesh == NULL || m->draw == NULL || m->joint == NULL || m->skin == NULL || m->influence == NULL
        || m->target == NULL || m->delta == NULL || m->delta_normal == NULL || m->clip == NULL
        || m->channel == NULL || m->key_time == NULL || m->key_value == NULL || m->text == NULL
        || out->texture_report == NULL)
        return false;
    m->mesh_count = (uint16_t)c->mesh.count;
    m->draw_count = (uint16_t)c->draws.count;
    m->clip_count = (uint16_t)c->clip.count;
    m->transform_count = (uint16_t)c->transform_count;
    m->deformed_count = (uint16_t)c->deformed_count;
    m->joint_count = (uint16_t)c->joint_limit;
    m->normals = c->has_normals;
    m->deformed_vertices = c->deformed_vertices;
    out->joint_count = c->joint.count;
    out->skin_count = c->skins.count;
    out->target_count = c->target.count;
    out->delta_count = c->delta.count;
    out->delta_normals = c->delta_normal.count;
    out->influence_count = c->influence.count;
    out->channel_count = c->channel.count;
    out->key_times = c->key_time.count;
    out->key_values = c->key_value.count;
    out->text_size = c->text.count;
    return m->deformed_vertices <= 1u << 20
        || fail(c->f, "has more than a million vertices that are deformed");
}

static bool start(struct converter *c)
{
    static const struct { size_t offset, size; } lists[] = {
        { offsetof(struct converter, mesh), sizeof(smear_mesh) },
        { offsetof(struct converter, material), sizeof(struct out_material) },
        { offsetof(struct converter, draws), sizeof(smear_model_draw) },
        { offsetof(struct converter, joint), sizeof(smear_model_joint) },
        { offsetof(struct converter, skins), sizeof(smear_model_skin) },
        { offsetof(struct converter, influence), 1 },
        { offsetof(struct converter, target), sizeof(smear_model_target) },
        { offsetof(struct converter, delta), sizeof(smear_model_delta) },
        { offsetof(struct converter, delta_normal), 1 },
        { offsetof(struct converter, clip), sizeof(smear_model_clip) },
        { offsetof(struct converter, channel), sizeof(smear_model_channel) },
        { offsetof(struct converter, key_time), sizeof(uint16_t) },
        { offsetof(struct converter, key_value), sizeof(int16_t) },
        { offsetof(struct converter, text), 1 },
        { offsetof(struct converter, texture), sizeof(struct out_texture) },
        { offsetof(struct converter, texture_report), sizeof(struct convert_texture_report) },
        { offsetof(struct converter, weight_factor), sizeof(double) },
    };
    for (size_t i = 0; i < sizeof lists / sizeof *lists; i++)
        ((struct list *)(void *)((char *)c + lists[i].offset))->size = lists[i].size;
    size_t nodes = (size_t)c->model->node_count;
    c->picture = pile_alloc(c->pile, (size_t)c->model->image_count, sizeof *c->picture, c->f);
    c->weight_first = pile_alloc(c->pile, nodes, sizeof *c->weight_first, c->f);
    for (size_t i = 0; c->weight_first != NULL && i < nodes; i++)
        c->weight_first[i] = -1;
    return c->picture != NULL && c->weight_first != NULL;
}

static void drop_lists(struct converter *c)
{
    struct list *const lists[] = { &c->mesh, &c->material, &c->draws, &c->joint, &c->skins, &c->influence,
                                   &c->target, &c->delta, &c->delta_normal, &c->clip, &c->channel,
                                   &c->key_time, &c->key_value, &c->text, &c->texture, &c->texture_report,
                                   &c->weight_factor };
    for (size_t i = 0; i < sizeof lists / sizeof *lists; i++)
        list_free(lists[i]);
}

static void count_file(struct converter *c)
{
    for (int i = 0; i < c->draw_count; i++) {
        c->out->triangles_in_file += c->draw[i].primitive->triangle_count;
        c->out->vertices_in_file += c->draw[i].primitive->vertex_count;
    }
}

bool convert_model(const struct model *model, const struct convert_options *options, struct conversion *out,
                   struct failure *f)
{
    *out = (struct conversion){ 0 };
    struct converter c = { .model = model, .options = options, .out = out, .f = f };
    out->pile = calloc(1, sizeof *out->pile);
    if (out->pile == NULL)
        return out_of_memory(f);
    c.pile = out->pile;
    bool ok = check_work(&c) && start(&c) && choose_world(&c) && find_lights(&c) && find_draws(&c) && find_moving_nodes(&c)
           && find_carriers(&c) && find_shapes(&c) && find_bounds(&c) && write_nodes(&c) && write_meshes(&c) && write_skins(&c)
           && write_clips(&c) && finish_textures(&c) && keep_lists(&c);
    if (ok) {
        count_file(&c);
        count_bytes(out);
        ok = out->triangles > 0
               ? measure(&c)
               : fail(f, "has nothing to draw (none of its %d triangles has an area and can be seen)",
                      out->triangles_in_file);
    }
    drop_lists(&c);
    if (!ok)
        conversion_free(out);
    return ok;
}

void conversion_free(struct conversion *c)
{
    if (c->pile != NULL)
        pile_free(c->pile);
    *c = (struct conversion){ 0 };
}
