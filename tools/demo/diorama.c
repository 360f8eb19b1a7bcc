/* SPDX-License-Identifier: MIT */
/* diorama.c - see diorama.h. Every file is a scene of its own (model_scene.c); a diorama poses each
 * once per actor and gathers the draws. */
#include "tools/demo/diorama.h"

#include "tools/model/model.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

struct part {                           /* a loaded file */
    struct model model;
    struct scene scene;
    bool *is_wheel, *is_front;          /* per node */
    double *radius;                     /* per node that is a wheel */
};

struct diorama {
    const struct diorama_kind *kind;
    struct scene set;
    struct part *part;                  /* one per file */
    struct diorama_place *place;        /* one per actor */
};

/* ------------------------------------------------------------------ poses */

/* An instant keeps one instant of the set and one per actor. */
static struct scene_instant *instants_of(const struct diorama *d, struct scene_instant *out)
{
    if (out->store == NULL)
        out->store = calloc((size_t)d->kind->cast_count + 1, sizeof(struct scene_instant));
    return out->store;
}

static bool gather_room(const struct scene_instant *from, int count, struct scene_instant *out,
                        struct failure *f)
{
    int draws = 0;
    for (int i = 0; i < count; i++)
        draws += from[i].draw_count;
    if (out->draw == NULL)
        out->draw = calloc((size_t)draws + 1, sizeof *out->draw);
    out->draw_count = draws;
    return out->draw != NULL || fail(f, "out of memory");
}

/* A wheel turns about its own x axis, which is its axle, and steers about y. */
static struct xform turn_of_node(const struct part *part, int node,
                                 const struct diorama_place *place)
{
    if (node < 0 || !part->is_wheel[node])
        return xform_identity();
    struct xform roll = xform_turn_x(place->rolled / part->radius[node]);
    return part->is_front[node] ? xform_mul(xform_turn_y(place->steer), roll) : roll;
}

/* Draws of one node belong together, and so no two actors share one: an actor's are counted from
 * `first_node`. */
static void put_actor(const struct part *part, const struct diorama_place *place, int first_node,
                      const struct scene_instant *from, struct scene_draw *draw)
{
    for (int i = 0; i < from->draw_count; i++) {
        struct xform own;
        draw[i] = from->draw[i];
        memcpy(own.m, draw[i].world, sizeof own.m);
        own = xform_mul(own, turn_of_node(part, draw[i].node, place));
        own = xform_mul(place->world, own);
        memcpy(draw[i].world, own.m, sizeof own.m);
        draw[i].epoch = place->epoch;
        draw[i].node += first_node;
    }
}

static void find_places(struct diorama *d, double time)
{
    for (int i = 0; i < d->kind->cast_count; i++)
        d->place[i] = (struct diorama_place){ .world = xform_identity() };
    d->kind->place(time, d->place);
}

static bool diorama_pose(struct scene *scene, double time, struct scene_instant *out,
                         struct failure *f)
{
    struct diorama *d = scene->data;
    int count = d->kind->cast_count;
    struct scene_instant *from = instants_of(d, out);
    if (from == NULL)
        return fail(f, "out of memory");
    find_places(d, out->now);
    for (int i = 0; i < count; i++)
        from[i + 1].now = d->place[i].clip_time;
    find_places(d, time);
    if (!scene_pose_joined(&d->set, time, out->now, &from[0], f))
        return false;
    for (int i = 0; i < count; i++) {
        struct part *part = &d->part[d->kind->file_of(i)];
        if (!scene_pose_joined(&part->scene, d->place[i].clip_time, from[i + 1].now, &from[i + 1], f))
            return false;
    }
    if (!gather_room(from, count + 1, out, f))
        return false;

    out->camera = from[0].camera;
    memcpy(out->draw, from[0].draw, (size_t)from[0].draw_count * sizeof *out->draw);
    struct scene_draw *draw = out->draw + from[0].draw_count;
    for (int i = 0, node = 0; i < count; i++) {
        const struct part *part = &d->part[d->kind->file_of(i)];
        put_actor(part, &d->place[i], node, &from[i + 1], draw);
        draw += from[i + 1].draw_count;
        node += part->model.node_count;
    }
    return true;
}

static void diorama_instant_free(struct scene *scene, struct scene_instant *instant)
{
    struct diorama *d = scene->data;
    struct scene_instant *from = instant->store;
    if (from != NULL) {
        scene_instant_free(&d->set, &from[0]);
        for (int i = 0; i < d->kind->cast_count; i++)
            scene_instant_free(&d->part[d->kind->file_of(i)].scene, &from[i + 1]);
    }
    free(from);
    free(instant->draw);
}

/* ------------------------------------------------------------------ files */

static double radius_of_mesh(const struct model_mesh *mesh)
{
    double radius = 0;
    for (int p = 0; p < mesh->primitive_count; p++)
        for (int v = 0; v < mesh->primitive[p].vertex_count; v++)
            radius = fmax(radius, fabs((double)mesh->primitive[p].position[3 * v + 1]));
    return radius;
}

static bool find_wheels(struct part *part, struct failure *f)
{
    const struct model *model = &part->model;
    size_t count = (size_t)model->node_count + 1;
    part->is_wheel = calloc(count, sizeof *part->is_wheel);
    part->is_front = calloc(count, sizeof *part->is_front);
    part->radius = calloc(count, sizeof *part->radius);
    if (part->is_wheel == NULL || part->is_front == NULL || part->radius == NULL)
        return fail(f, "out of memory");
    for (int i = 0; i < model->node_count; i++) {
        const struct model_node *node = &model->node[i];
        if (node->mesh < 0 || strncmp(node->name, "wheel", 5) != 0)
            continue;
        part->radius[i] = radius_of_mesh(&model->mesh[node->mesh]);
        part->is_wheel[i] = part->radius[i] > 0;
        part->is_front[i] = strncmp(node->name, "wheel-front", 11) == 0;
    }
    return true;
}

static bool load_part(struct part *part, const char *path, const char *clip, struct failure *f)
{
    struct scene_view view = { .clip = MODEL_CLIP_NONE, .loop = true, .camera = -1,
                               .bilinear = true };
    if (!model_load(path, &part->model, f))
        return false;
    if (clip != NULL)
        view.clip = model_find_clip(&part->model, clip);
    if (clip != NULL && view.clip < 0)
        return fail(f, "there is no clip \"%s\"", clip);
    return scene_from_model(&part->model, &view, &part->scene, f) && find_wheels(part, f);
}

static bool load_file(struct part *part, const char *assets, const struct diorama_file *file,
                      struct failure *f)
{
    struct failure why = { "" };
    char path[2048];
    int length = snprintf(path, sizeof path, "%s/%s", assets, file->path);
    if (length < 0 || length >= (int)sizeof path)
        return fail(f, "%s: the path is too long", file->path);
    return load_part(part, path, file->clip, &why) || fail(f, "%s: %s", file->path, why.text);
}

static void free_part(struct part *part)
{
    scene_free(&part->scene);
    model_free(&part->model);
    free(part->is_wheel);
    free(part->is_front);
    free(part->radius);
}

static void diorama_free(struct scene *scene)
{
    struct diorama *d = scene->data;
    for (int i = 0; d->part != NULL && i < d->kind->file_count; i++)
        free_part(&d->part[i]);
    scene_free(&d->set);
    free(d->part);
    free(d->place);
    free(d);
}

bool diorama_open(const struct diorama_kind *kind, const char *assets, struct scene *out,
                  struct failure *f)
{
    struct diorama *d = calloc(1, sizeof *d);
    const struct stage_kind *stage = kind->stage;
    *out = (struct scene){ 0 };
    if (d == NULL)
        return fail(f, "out of memory");
    *out = (struct scene){ .name = stage->name, .width = stage->width, .height = stage->height,
                           .fps = 30, .time = stage->time, .clear = stage->clear,
                           .pose = diorama_pose, .instant_free = diorama_instant_free,
                           .destroy = diorama_free, .data = d };
    d->kind = kind;
    d->part = calloc((size_t)kind->file_count + 1, sizeof *d->part);
    d->place = calloc((size_t)kind->cast_count + 1, sizeof *d->place);
    bool ok = (d->part != NULL && d->place != NULL) || fail(f, "out of memory");
    ok = ok && stage_open(stage, 1, stage->name, &d->set, f);
    for (int i = 0; i < kind->file_count && ok; i++)
        ok = load_file(&d->part[i], assets, &kind->file[i], f);
    if (!ok)
        scene_free(out);
    return ok;
}
