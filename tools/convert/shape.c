/* SPDX-License-Identifier: MIT */
/* shape.c - which draws of the model become one draw of the result,
 * and their vertices on grids of int16 steps. */
#include "tools/convert/build.h"

#include "tools/model/exact.h"

#include <math.h>
#include <string.h>

/* ------------------------------------------------------------------ which draws go together */

static const struct model_material *material_of(const struct converter *c, const struct model_primitive *p)
{
    return &c->model->material[p->material];
}

static bool has_texture(const struct converter *c, const struct model_primitive *p)
{
    return material_of(c, p)->image >= 0 && p->uv != NULL && c->options->texture != CONVERT_NO_TEXTURE;
}

static bool has_normals(const struct converter *c, const struct model_primitive *p)
{
    return p->normal != NULL && !c->options->flat;
}

static bool go_together(const struct converter *c, const struct source_draw *a, const struct source_draw *b)
{
    const struct model_primitive *p = a->primitive, *q = b->primitive;
    return p->material == q->material && a->skin == b->skin && !a->is_shared && !b->is_shared
        && (a->skin >= 0 || a->at.node == b->at.node) && p->target_count == 0 && q->target_count == 0
        && material_of(c, p)->alpha != MODEL_ALPHA_BLEND && has_normals(c, p) == has_normals(c, q)
        && (p->uv != NULL) == (q->uv != NULL) && (p->color != NULL) == (q->color != NULL);
}

/* ------------------------------------------------------------------ their vertices in floating point */

/* Normals go with the cofactors of a matrix; they are brought back to length one. */
static void turn_normal(float out[3], const double m[16], const float n[3])
{
    double cofactor[9], turned[3], sign = 0;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
            cofactor[3 * i + j] = m[4 * j1 + i1] * m[4 * j2 + i2] - m[4 * j2 + i1] * m[4 * j1 + i2];
        }
    for (int i = 0; i < 3; i++)
        sign += m[i] * cofactor[3 * i];
    for (int i = 0; i < 3; i++) {
        turned[i] = 0;
        for (int j = 0; j < 3; j++)
            turned[i] += cofactor[3 * i + j] * (double)n[j];
    }
    double length = sqrt(turned[0] * turned[0] + turned[1] * turned[1] + turned[2] * turned[2]);
    for (int i = 0; i < 3; i++)
        out[i] = length > 0 ? (float)((sign < 0 ? -turned[i] : turned[i]) / length) : 0;
}

static bool is_mirrored(const double m[16])
{
    double determinant = m[0] * (m[5] * m[10] - m[9] * m[6]) - m[4] * (m[1] * m[10] - m[9] * m[2])
                       + m[8] * (m[1] * m[6] - m[5] * m[2]);
    return determinant < 0;
}

static void copy_vertex(const struct source_draw *d, struct shape *s, int to, int v)
{
    const struct model_primitive *p = d->primitive;
    for (int k = 0; k < 3; k++)
        s->position[3 * to + k] = p->position[3 * v + k];
    if (d->bakes) {
        const double at[3] = { (double)p->position[3 * v], (double)p->position[3 * v + 1],
                               (double)p->position[3 * v + 2] };
        double world[3];
        transform_double(world, d->at.matrix, at);
        for (int k = 0; k < 3; k++)
            s->position[3 * to + k] = (float)world[k];
    }
    if (s->normal != NULL && d->bakes)
        turn_normal(s->normal + 3 * to, d->at.matrix, p->normal + 3 * v);
    else if (s->normal != NULL)
        memcpy(s->normal + 3 * to, p->normal + 3 * v, 3 * sizeof *s->normal);
    if (s->uv != NULL)
        memcpy(s->uv + 2 * to, p->uv + 2 * v, 2 * sizeof *s->uv);
    if (s->color != NULL)
        memcpy(s->color + 4 * to, p->color + 4 * v, 4 * sizeof *s->color);
}

static void copy_draw(const struct converter *c, struct shape *s, int draw)
{
    const struct source_draw *d = &c->draw[draw];
    const struct model_primitive *p = d->primitive;
    bool flips = d->bakes && is_mirrored(d->at.matrix);
    for (int v = 0; v < p->vertex_count; v++) {
        copy_vertex(d, s, s->vertex_count + v, v);
        s->origin[s->vertex_count + v] = (struct convert_origin){ .draw = draw, .vertex = v };
    }
    for (int t = 0; t < p->triangle_count; t++) {
        uint32_t *out = s->index + 3 * (s->triangle_count + t);
        for (int k = 0; k < 3; k++)
            out[k] = p->index[3 * t + (flips && k > 0 ? 3 - k : k)] + (uint32_t)s->vertex_count;
    }
    s->vertex_count += p->vertex_count;
    s->triangle_count += p->triangle_count;
}

static bool fill_shape(struct converter *c, struct shape *s)
{
    const struct model_primitive *first = c->draw[s->draw[0]].primitive;
    size_t vertices = 0, triangles = 0;
    for (int i = 0; i < s->draw_count; i++) {
        vertices += (size_t)c->draw[s->draw[i]].primitive->vertex_count;
        triangles += (size_t)c->draw[s->draw[i]].primitive->triangle_count;
    }
    if (vertices > 1u << 27 || triangles > 1u << 27)
        return fail(c->f, "has too many vertices");
    s->position = pile_alloc(c->pile, vertices, 3 * sizeof *s->position, c->f);
    s->index = pile_alloc(c->pile, triangles, 3 * sizeof *s->index, c->f);
    s->origin = pile_alloc(c->pile, vertices, sizeof *s->origin, c->f);
    bool ok = s->position != NULL && s->index != NULL && s->origin != NULL;
    if (ok && has_normals(c, first))
        ok = (s->normal = pile_alloc(c->pile, vertices, 3 * sizeof *s->normal, c->f)) != NULL;
    if (ok && has_texture(c, first))
        ok = (s->uv = pile_alloc(c->pile, vertices, 2 * sizeof *s->uv, c->f)) != NULL;
    if (ok && first->color != NULL)
        ok = (s->color = pile_alloc(c->pile, vertices, 4 * sizeof *s->color, c->f)) != NULL;
    for (int i = 0; i < s->draw_count && ok; i++)
        copy_draw(c, s, s->draw[i]);
    if (ok && !add_positions(&s->bounds, s->position, s->vertex_count))
        return fail(c->f, "a vertex is out of range");
    if (ok && s->skin >= 0)
        add_bounds(&c->skin[s->skin].in, &s->bounds);
    return ok && (s->uv == NULL || c->options->texture != CONVERT_BAKED || bake_texture(c, s));
}

/* A morphed shape may be anywhere its targets take it alone. */
static void bound_targets(struct converter *c, struct shape *s)
{
    for (int v = 0; v < s->vertex_count && s->target_count > 0; v++) {
        const struct source_draw *d = &c->draw[s->origin[v].draw];
        for (int t = 0; t < s->target_count; t++) {
            const float *delta = d->primitive->target_position[t];
            if (delta == NULL)
                continue;
            const float *p = d->primitive->position + 3 * s->origin[v].vertex;
            double at[3], world[3];
            for (int k = 0; k < 3; k++)
                world[k] = at[k] = (double)p[k] + (double)delta[3 * s->origin[v].vertex + k];
            if (d->bakes)
                transform_double(world, d->at.matrix, at);
            for (int k = 0; k < 3; k++) {
                s->bounds.min[k] = fmin(s->bounds.min[k], world[k]);
                s->bounds.max[k] = fmax(s->bounds.max[k], world[k]);
            }
        }
    }
}

static int shape_with_same_vertices(const struct converter *c, int draw, int before)
{
    for (int i = 0; i < before; i++) {
        const struct source_draw *a = &c->draw[c->shape[i].draw[0]], *b = &c->draw[draw];
        if (a->is_shared && b->is_shared && a->primitive == b->primitive && a->primitive->target_count == 0
            && c->shape[i].skin < 0 && b->skin < 0)
            return c->shape[i].same >= 0 ? c->shape[i].same : i;
    }
    return -1;
}

bool find_shapes(struct converter *c)
{
    c->shape = pile_alloc(c->pile, (size_t)c->draw_count, sizeof *c->shape, c->f);
    bool *taken = pile_alloc(c->pile, (size_t)c->draw_count, sizeof *taken, c->f);
    int *draw = pile_alloc(c->pile, (size_t)c->draw_count, sizeof *draw, c->f);     /* of all shapes, one after the other */
    if (c->shape == NULL || taken == NULL || draw == NULL)
        return false;
    for (int i = 0; i < c->draw_count; i++) {
        if (taken[i])
            continue;
        const struct source_draw *d = &c->draw[i];
        struct shape *s = &c->shape[c->shape_count];
        *s = (struct shape){ .material = d->primitive->material, .skin = d->skin, .morph_node = -1,
                             .node = d->skin < 0 ? d->at.node : NO_NODE, .bounds = empty_bounds,
                             .target_count = d->primitive->target_count };
        if (s->target_count > 0)
            s->morph_node = d->node;
        s->draw = draw;
        for (int k = i; k < c->draw_count; k++)
            if (!taken[k] && (k == i || go_together(c, d, &c->draw[k]))) {
                taken[k] = true;
                s->draw[s->draw_count++] = k;
            }
        draw += s->draw_count;
        s->same = shape_with_same_vertices(c, i, c->shape_count);
        c->shape_count++;
        if (!fill_shape(c, s))
            return false;
        bound_targets(c, s);
    }
    return true;
}

/* ------------------------------------------------------------------ grids */

struct grid grid_without_fold(const struct bounds *b)
{
    const double steps = 32766, offset_limit = (1 << 20) - 2;
    struct grid grid = { .step = 1.0 };
    double step = 0;
    for (int axis = 0; axis < 3; axis++) {
        double half = (b->max[axis] - b->min[axis]) / 2, centre = fabs((b->min[axis] + b->max[axis]) / 2);
        step = fmax(step, fmax(half / steps, centre / offset_limit));
    }
    if (step > 0) {
        int32_t scale;
        int shift;
        split_step(step, &scale, &shift);
        grid.step = ldexp(scale, -shift);
    }
    for (int axis = 0; axis < 3; axis++)
        grid.offset[axis] = (int32_t)floor((b->min[axis] + b->max[axis]) / 2 / grid.step + 0.5);
    return grid;
}

/* Room for what lies between the instants that were looked at. */
static struct bounds widened(const struct bounds *b)
{
    struct bounds wide = *b;
    for (int axis = 0; axis < 3; axis++) {
        double more = (b->max[axis] - b->min[axis]) / 64;
        wide.min[axis] -= more;
        wide.max[axis] += more;
    }
    return wide;
}

/* Shapes on one node share a grid, and so do all that stand still: no crack opens between them. */
static void choose_grids(struct converter *c)
{
    for (int i = 0; i < c->skin_count; i++) {
        struct out_skin *skin = &c->skin[i];
        struct bounds wide = widened(&skin->out);
        skin->in_grid = grid_without_fold(&skin->in);
        skin->out_grid = grid_without_fold(&wide);
    }
    for (int i = 0; i < c->shape_count; i++) {
        struct bounds all = empty_bounds;
        bool morphs = false;
        for (int k = 0; k < c->shape_count; k++)
            if (c->shape[k].skin < 0 && (c->shape[k].node == c->shape[i].node)) {
                add_bounds(&all, &c->shape[k].bounds);
                morphs = morphs || c->shape[k].target_count > 0;
            }
        if (morphs)
            all = widened(&all);
        c->shape[i].grid = c->shape[i].skin >= 0 ? c->skin[c->shape[i].skin].in_grid
                         : c->shape[i].same >= 0 ? c->shape[c->shape[i].same].grid : grid_without_fold(&all);
    }
}

/* ------------------------------------------------------------------ meshes */

static struct scene_surface surface_of(struct converter *c, const struct shape *s, bool *ok)
{
    const struct model_material *m = &c->model->material[s->material];
    struct scene_surface out = {
        .vertex_count = s->vertex_count, .triangle_count = s->triangle_count, .position = s->position,
        .normal = s->normal, .uv = s->uv, .color = s->color, .face_color = s->face_color, .index = s->index,
        .material = { .wrap_u = m->wrap_u, .wrap_v = m->wrap_v, .alpha = m->alpha,
                      .alpha_cutoff = m->alpha_cutoff, .double_sided = m->double_sided,
                      .unlit = m->unlit, .bilinear = c->options->bilinear },
    };
    memcpy(out.material.base, m->base, sizeof out.material.base);
    if (s->uv != NULL)
        out.material.image = shrunk_picture(c, m->image);
    *ok = s->uv == NULL || out.material.image != NULL;
    return out;
}

/* A part as arrays of our own, with all that a vertex carries. */
static bool raw_from_part(struct converter *c, const struct shape *s, const struct part *part,
                          struct raw_mesh *mesh)
{
    size_t vertices = (size_t)part->vertex_count, triangles = (size_t)part->triangle_count;
    *mesh = (struct raw_mesh){ .vertex_count = part->vertex_count, .triangle_count = part->triangle_count,
                               .position = part->position, .normal = part->normal, .uv = part->uv,
                               .color = part->color, .face_color = part->face_color, .index = part->index,
                               .origin_count = part->vertex_count };
    /* colours again, with the same bits everywhere */
    for (size_t i = 0; i < 4 * vertices && mesh->color != NULL; i++) {
        double x = (double)s->color[4 * part->source[i / 4] + i % 4];
        mesh->color[i] = i % 4 < 3 ? exact_srgb_encode(x) : exact_byte(x);
    }
    for (size_t i = 0; i < 4 * triangles && mesh->face_color != NULL; i++) {
        double x = (double)s->face_color[4 * (size_t)part->first_triangle + i];
        mesh->face_color[i] = i % 4 < 3 ? exact_srgb_encode(x) : exact_byte(x);
    }
    mesh->origin = pile_alloc(c->pile, vertices, sizeof *mesh->origin, c->f);
    if (mesh->origin == NULL)
        return false;
    for (size_t i = 0; i < vertices; i++) {
        mesh->origin[i] = s->origin[part->source[i]];
        mesh->origin[i].mesh_vertex = (int)i;
    }
    return skin_influences(c, s, mesh) && morph_deltas(c, s, mesh);
}

static void *kept_copy(struct converter *c, const void *data, size_t count, size_t size, bool *ok)
{
    if (data == NULL || !*ok)
        return NULL;
    void *copy = pile_alloc(c->pile, count, size, c->f);
    if (copy != NULL)
        memcpy(copy, data, count * size);
    *ok = *ok && copy != NULL;
    return copy;
}

/* The mesh's scale and offset for the device. */
static bool set_grid(const struct converter *c, const struct shape *s, smear_mesh *mesh)
{
    const struct grid *grid = s->skin >= 0 ? &c->skin[s->skin].out_grid : &s->grid;
    int exponent = s->node != NO_NODE ? c->node[s->node].exponent : 0, shift;
    split_step(ldexp(grid->step, exponent), &mesh->scale, &shift);
    if (shift < -32 || shift > 62)
        return fail(c->f, "is too large or too small: use --scale or --fit");
    mesh->shift = (int8_t)shift;
    memcpy(mesh->offset, grid->offset, sizeof mesh->offset);
    return true;
}

static bool add_draw(struct converter *c, const struct shape *s, const smear_mesh *mesh, int material,
                     const struct raw_mesh *raw)
{
    smear_mesh *meshes = list_add(&c->mesh, 1, c->f);
    smear_model_draw *d = list_add(&c->draws, 1, c->f);
    if (meshes == NULL || d == NULL)
        return false;
    *meshes = *mesh;
    *d = (smear_model_draw){ .mesh = (uint16_t)(c->mesh.count - 1), .material = (uint16_t)material,
                             .node = s->node == NO_NODE ? SMEAR_MODEL_NONE : (uint16_t)s->node,
                             .skin = s->skin < 0 ? SMEAR_MODEL_NONE : (uint16_t)s->skin,
                             .deformed = SMEAR_MODEL_NONE };
    if (s->node != NO_NODE)
        d->transform = (uint16_t)c->transform_count++;
    if (raw == NULL)
        return true;
    if (s->skin >= 0 || s->target_count > 0) {
        d->deformed = (uint16_t)c->deformed_count++;
        d->vertex_first = c->deformed_vertices;
        c->deformed_vertices += mesh->vertex_count;
        c->has_normals = c->has_normals || mesh->normal != NULL;
    }
    if (s->skin >= 0) {
        size_t bytes = (size_t)(2 * raw->influences - 1) * (size_t)raw->vertex_count;
        d->influences = (uint16_t)raw->influences;
        d->influence_first = (uint32_t)c->influence.count;
        uint8_t *at = list_add(&c->influence, (int)bytes, c->f);
        if (at == NULL)
            return false;
        memcpy(at, raw->influence, bytes);
    }
    return write_targets(c, raw, d);
}

static bool finish_mesh(struct converter *c, const struct shape *s, struct raw_mesh *raw, int material,
                        int uv_shift)
{
    bool blends = c->model->material[s->material].alpha == MODEL_ALPHA_BLEND, ok = true;
    int file_order = 0;
    uint32_t *index = pile_alloc(c->pile, 3 * (size_t)raw->triangle_count, sizeof *index, c->f);
    for (int i = 0; index != NULL && i < 3 * raw->triangle_count; i++)
        index[i] = raw->index[i];
    if (index == NULL)
        return false;
    file_order = count_transforms(index, raw->triangle_count);
    if (!weld_vertices(raw, c->pile, c->f) || !order_triangles(raw, blends, c->pile, c->f))
        return false;
    if (raw->triangle_count == 0)
        return true;
    for (int i = 0; i < 3 * raw->triangle_count; i++)
        index[i] = raw->index[i];
    size_t vertices = (size_t)raw->vertex_count, triangles = (size_t)raw->triangle_count;
    smear_mesh mesh = {
        .position = kept_copy(c, raw->position, vertices, 6, &ok),
        .normal = kept_copy(c, raw->normal, vertices, 3, &ok),
        .uv = kept_copy(c, raw->uv, vertices, 4, &ok), .color = kept_copy(c, raw->color, vertices, 4, &ok),
        .face_color = kept_copy(c, raw->face_color, triangles, 4, &ok),
        .index = kept_copy(c, raw->index, triangles, 6, &ok), .triangle_count = (uint32_t)triangles,
        .vertex_count = (uint16_t)vertices, .uv_shift = (uint8_t)uv_shift
    };
    struct convert_origin **origin = &c->out->origin[c->draws.count];
    int *origin_count = &c->out->origin_count[c->draws.count];
    c->out->transformed += count_transforms(index, raw->triangle_count);
    c->out->transformed_in_file += file_order;
    c->out->triangles += raw->triangle_count;
    c->out->vertices += raw->vertex_count;
    *origin = raw->origin;
    *origin_count = raw->origin_count;
    return ok && set_grid(c, s, &mesh) && add_draw(c, s, &mesh, material, raw);
}

/* The material in the result; its texture is set in finish_textures. */
static bool material_for(struct converter *c, const struct shape *s, const smear_material *converted,
                         int *out)
{
    const struct model_material *m = &c->model->material[s->material];
    int *known = &c->material_of[2 * s->material + (s->uv != NULL)], texture = -1;
    if (*known >= 0) {
        *out = *known;
        return true;
    }
    if (s->uv != NULL && !texture_for(c, m, &texture))
        return false;
    struct out_material *material = list_add(&c->material, 1, c->f);
    if (material == NULL)
        return false;
    material->texture = texture;
    material->material = *converted;
    material->material.texture = NULL;
    for (int i = 0; i < 3; i++)
        material->material.color[i] = exact_srgb_encode((double)m->base[i]);
    material->material.gloss = m->gloss;
    material->material.shine = m->shine;
    *out = *known = c->material.count - 1;
    return true;
}

/* The shape's vertices once more, for another node. */
static bool repeat_shape(struct converter *c, const struct shape *s, int first_draw, int draw_count)
{
    for (int i = first_draw; i < first_draw + draw_count; i++) {
        const smear_model_draw before = ((smear_model_draw *)c->draws.data)[i];
        smear_mesh mesh = ((smear_mesh *)c->mesh.data)[before.mesh];
        struct convert_origin *origin = pile_alloc(c->pile, (size_t)c->out->origin_count[i], sizeof *origin,
                                                   c->f);
        if (origin == NULL || !set_grid(c, s, &mesh))
            return false;
        memcpy(origin, c->out->origin[i], (size_t)c->out->origin_count[i] * sizeof *origin);
        for (int k = 0; k < c->out->origin_count[i]; k++)
            origin[k].draw = s->draw[0];
        c->out->origin[c->draws.count] = origin;
        c->out->origin_count[c->draws.count] = c->out->origin_count[i];
        c->out->triangles += (int)mesh.triangle_count;
        if (!add_draw(c, s, &mesh, before.material, NULL))
            return false;
    }
    return true;
}

struct written {
    int first, count;           /* draws */
};

static bool write_shape(struct converter *c, struct shape *s, struct texture_store *store,
                        struct written *written)
{
    bool ok;
    int material = -1;
    struct scene_surface surface = surface_of(c, s, &ok);
    struct converted converted = { .surface = &surface, .bounds = s->bounds, .grid = s->grid };
    written->first = c->draws.count;
    ok = ok && convert_surface(&converted, store, c->f);
    if (ok && converted.invisible)
        c->out->invisible += s->draw_count;
    else
        ok = ok && material_for(c, s, &converted.material, &material);
    for (int i = 0; i < converted.part_count && ok; i++) {
        struct raw_mesh raw;
        ok = c->draws.count < c->draw_room || fail(c->f, "has too many parts");
        ok = ok && raw_from_part(c, s, &converted.part[i], &raw)
          && finish_mesh(c, s, &raw, material, converted.part[i].uv_shift);
    }
    converted_free(&converted);
    written->count = c->draws.count - written->first;
    return ok;
}

bool write_meshes(struct converter *c)
{
    struct texture_store store = { 0 };
    struct written *written = pile_alloc(c->pile, (size_t)c->shape_count, sizeof *written, c->f);
    choose_grids(c);
    /* a shape of more than 65535 vertices becomes several draws */
    c->draw_room = c->shape_count;
    for (int i = 0; i < c->shape_count; i++)
        c->draw_room += c->shape[i].triangle_count / 21000;
    c->out->origin = pile_alloc(c->pile, (size_t)c->draw_room, sizeof *c->out->origin, c->f);
    c->out->origin_count = pile_alloc(c->pile, (size_t)c->draw_room, sizeof *c->out->origin_count, c->f);
    c->material_of = pile_alloc(c->pile, 2 * (size_t)c->model->material_count, sizeof *c->material_of, c->f);
    bool ok = written != NULL && c->out->origin != NULL && c->out->origin_count != NULL
           && c->material_of != NULL;
    for (int i = 0; ok && i < 2 * c->model->material_count; i++)
        c->material_of[i] = -1;
    c->transform_count = 1;
    for (int i = 0; i < c->shape_count && ok; i++) {
        struct shape *s = &c->shape[i];
        if (s->same >= 0 && c->draws.count + written[s->same].count > c->draw_room)
            ok = fail(c->f, "has too many parts");
        else
            ok = s->same >= 0 ? repeat_shape(c, s, written[s->same].first, written[s->same].count)
                              : write_shape(c, s, &store, &written[i]);
    }
    texture_store_free(&store);
    if (ok && c->draws.count >= (int)SMEAR_MODEL_NONE)
        return fail(c->f, "has more than 65534 draws");
    return ok;
}
