/* SPDX-License-Identifier: MIT */
/* measure.c - what a conversion costs, and how far its vertices are from where the model has them: the result
 * is played by the code that plays it on the device. */
#include "tools/convert/build.h"

#include "tools/model/matrix.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ------------------------------------------------------------------ bytes */

/* On a core with 32-bit pointers. */
enum { MESH_BYTES = 60, TEXTURE_BYTES = 16, MATERIAL_BYTES = 16, TRANSFORM_BYTES = 48, MODEL_BYTES = 108 };

static size_t mesh_arrays(const smear_model *m, uint32_t index)
{
    const smear_mesh *mesh = &m->mesh[index];
    size_t vertices = mesh->vertex_count, triangles = mesh->triangle_count;
    for (uint32_t i = 0; i < index; i++)
        if (m->mesh[i].position == mesh->position)
            return 0;
    return vertices * (6 + (mesh->normal != NULL ? 3u : 0u) + (mesh->uv != NULL ? 4u : 0u)
                       + (mesh->color != NULL ? 4u : 0u))
         + triangles * (6 + (mesh->face_color != NULL ? 4u : 0u));
}

static size_t texel_bytes(const struct conversion *c, int index)
{
    const smear_texture *t = &c->texture[index];
    size_t count = convert_texel_count(t);
    if (c->same_texels[index] != index)
        return 0;
    return t->format == SMEAR_TEXEL_8888 ? 4 * count
         : t->format == SMEAR_TEXEL_565  ? 2 * count : count + 4 * (size_t)c->palette_count[index];
}

static size_t align8(size_t bytes)
{
    return (bytes + 7) & ~(size_t)7;
}

void count_bytes(struct conversion *c)
{
    const smear_model *m = &c->model;
    struct convert_bytes *b = &c->bytes;
    size_t vertices = m->deformed_vertices, nodes = m->node_count;
    b->open = align8((size_t)c->texture_count * TEXTURE_BYTES)
            + align8((size_t)m->material_count * MATERIAL_BYTES) + align8((size_t)m->mesh_count * MESH_BYTES);
    b->meshes = (size_t)m->mesh_count * MESH_BYTES + (size_t)m->material_count * MATERIAL_BYTES;
    for (uint32_t i = 0; i < m->mesh_count; i++)
        b->meshes += mesh_arrays(m, i);
    b->textures = (size_t)c->texture_count * TEXTURE_BYTES;
    for (int i = 0; i < c->texture_count; i++)
        b->textures += texel_bytes(c, i);
    b->animation = MODEL_BYTES + (size_t)m->draw_count * sizeof *m->draw + nodes * sizeof *m->node
                 + (size_t)c->joint_count * sizeof *m->joint + (size_t)c->skin_count * sizeof *m->skin
                 + (size_t)c->influence_count + (size_t)c->target_count * sizeof *m->target
                 + (size_t)c->delta_count * sizeof *m->delta + (size_t)c->delta_normals
                 + (size_t)m->weight_count * 2 + (size_t)m->clip_count * sizeof *m->clip
                 + (size_t)c->channel_count * sizeof *m->channel + (size_t)c->key_times * 2
                 + (size_t)c->key_values * 2 + (size_t)c->text_size;
    for (size_t poses = 1; poses <= 3; poses++)
        b->actor[poses - 1] = SMEAR_ACTOR_HEAD_BYTES + align8(nodes * TRANSFORM_BYTES)
                            + align8(m->joint_count * 48u) + align8(m->weight_count * 2u)
                            + align8((size_t)m->deformed_count * MESH_BYTES)
                            + align8(m->normals ? 3 * vertices : 0)
                            + poses * (align8((size_t)m->transform_count * TRANSFORM_BYTES)
                                       + align8(6 * vertices));
}

/* ------------------------------------------------------------------ errors */

static void device_point(double out[3], const smear_draw *draw, int vertex)
{
    const smear_mesh *mesh = draw->mesh;
    double at[3];
    for (int k = 0; k < 3; k++)
        at[k] = ldexp((double)(mesh->position[3 * vertex + k] + mesh->offset[k])
                      * (mesh->scale != 0 ? mesh->scale : 1), -mesh->shift);
    for (int row = 0; row < 3; row++) {
        out[row] = draw->now->origin[row] / 65536.0;
        for (int k = 0; k < 3; k++)
            out[row] += draw->now->basis[3 * row + k] / 16777216.0 * at[k];
    }
}

/* The largest distance between a vertex here and there, in world units. */
static double largest_distance(const struct converter *c, smear_actor *actor, const struct model_pose *pose)
{
    double largest = 0;
    for (int i = 0; i < c->out->model.draw_count; i++) {
        smear_draw draw;
        if (smear_actor_draw(actor, i, &draw) != SMEAR_OK)
            return INFINITY;
        for (int k = 0; k < c->out->origin_count[i]; k++) {
            const struct convert_origin *o = &c->out->origin[i][k];
            const struct model_draw *from = &pose->draw[o->draw];
            double in_file[3], there[3], here[3], sum = 0;
            matrix_point(in_file, from->world, from->position + 3 * o->vertex);
            transform_double(there, c->root, in_file);
            device_point(here, &draw, o->mesh_vertex);
            for (int axis = 0; axis < 3; axis++)
                sum += (here[axis] - there[axis]) * (here[axis] - there[axis]);
            largest = fmax(largest, sqrt(sum));
        }
    }
    return largest;
}

static bool measure_clip(struct converter *c, smear_actor *actor, struct model_pose *pose, int index)
{
    int clip = c->options->clip[index];
    struct convert_clip_report *report = &c->out->clip_report[index];
    double duration = c->model->clip[clip].duration;
    int steps = (int)fmin(ceil(duration * 60), 240);
    for (int i = 0; i <= steps; i++) {
        int32_t time = (int32_t)floor((steps > 0 ? duration * i / steps : 0) * 65536 + 0.5);
        smear_play play = { .clip = (uint16_t)index, .time = time };
        if (!model_pose(c->model, clip, time / 65536.0, false, pose, c->f))
            return false;
        if (smear_actor_set(actor, SMEAR_POSE_NOW, &play) != SMEAR_OK)
            return fail(c->f, "the result cannot be played");
        double error = largest_distance(c, actor, pose) * c->out->pixels_per_unit;
        if (error > report->error_px) {
            report->error_px = error;
            report->error_time = time / 65536.0;
        }
    }
    c->out->error_px = fmax(c->out->error_px, report->error_px);
    return true;
}

bool measure(struct converter *c)
{
    struct model_pose pose = { 0 };
    smear_actor *actor;
    size_t bytes = smear_actor_memory(&c->out->model, 1);
    void *memory = malloc(bytes);
    const smear_play rest = { .rest = 1 };
    if (memory == NULL)
        return out_of_memory(c->f);
    bool ok = smear_actor_init(&actor, &c->out->model, 1, memory, bytes) == SMEAR_OK
           && smear_actor_set(actor, SMEAR_POSE_NOW, &rest) == SMEAR_OK;
    ok = ok || fail(c->f, "the result cannot be played");
    ok = ok && model_pose(c->model, MODEL_CLIP_NONE, 0, false, &pose, c->f);
    if (ok)
        c->out->rest_error_px = c->out->error_px = largest_distance(c, actor, &pose)
                                                 * c->out->pixels_per_unit;
    for (int i = 0; i < c->options->clip_count && ok; i++)
        ok = measure_clip(c, actor, &pose, i);
    model_pose_free(&pose);
    free(memory);
    return ok;
}
