/* SPDX-License-Identifier: MIT */
/* model_scene.c - scenes from model files: their draws, their cameras, and the automatic camera. */
#include "tools/scenes/scene.h"

#include "tools/scenes/xform.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ------------------------------------------------------------------ shadows */

/* What the draws of a scene cast on the ground, as further draws behind them. Host only. */

/* Surfaces of shadows: one for each surface of a scene, or a round one for all of them. */
struct shadow {
    struct scene_shadow wish;
    double ground;                      /* height of the plane */
    struct scene_surface *surface;
};

/* The sun stands so high at least, as a part of its distance: ten degrees. Lower ones cast shadows that leave all pictures. */
#define LOWEST_SUN 0.1736

/* A round shadow is so much larger than what it lies under, as its edge is soft. */
#define SOFT 1.25

static const float disc_position[] = { -1, 0, -1, -1, 0, 1, 1, 0, 1, 1, 0, -1 };
static const float disc_uv[] = { 0, 0, 0, 1, 1, 1, 1, 0 };
static const uint32_t disc_index[] = { 0, 1, 2, 0, 2, 3 };
static const struct image disc_image = { .width = 32, .height = 32 };          /* its size alone: the library has the texels */

static struct scene_surface disc_of(const struct scene_shadow *wish)
{
    return (struct scene_surface){
        .vertex_count = 4, .triangle_count = 2, .position = disc_position, .uv = disc_uv, .index = disc_index,
        .material = { .image = &disc_image, .base = { 0, 0, 0, (float)wish->darkness }, .shadow = SCENE_SHADOW_BLOB },
    };
}

/* Holes of a texture let light through. */
static struct scene_surface flat_of(const struct scene_surface *of, const struct scene_shadow *wish)
{
    const bool has_holes = of->material.alpha == MODEL_ALPHA_MASK && of->material.image != NULL;
    struct scene_surface s = *of;
    s.normal = s.color = s.face_color = NULL;
    s.uv = has_holes ? of->uv : NULL;
    s.material.image = has_holes ? of->material.image : NULL;
    memcpy(s.material.base, (float[4]){ 0, 0, 0, (float)wish->darkness }, sizeof s.material.base);
    s.material.shadow = SCENE_SHADOW_PLANAR;
    return s;
}

/* Makes shadows of `count` surfaces, which outlive them. The sun has to stand above the ground. */
static bool shadow_open(struct shadow *shadow, const struct scene_shadow *wish, double ground, const struct scene_surface *surface,
                        int count, struct failure *f)
{
    const double *light = wish->light;
    const double length = sqrt(light[0] * light[0] + light[1] * light[1] + light[2] * light[2]);
    *shadow = (struct shadow){ .wish = *wish, .ground = ground };
    if (wish->kind == SCENE_SHADOW_NONE)
        return true;
    if (wish->kind == SCENE_SHADOW_PLANAR && !(light[1] > 0))
        return fail(f, "no shadow falls on the ground from a sun that is not above it (--sun says another, --shadow blob needs none)");
    shadow->wish.light[1] = fmax(light[1], LOWEST_SUN * length);
    shadow->surface = calloc((size_t)count + 1, sizeof *shadow->surface);
    if (shadow->surface == NULL)
        return fail(f, "out of memory");
    for (int i = 0; i < count && wish->kind == SCENE_SHADOW_PLANAR; i++)
        shadow->surface[i] = flat_of(&surface[i], wish);
    if (wish->kind == SCENE_SHADOW_BLOB)
        shadow->surface[0] = disc_of(wish);
    return true;
}

static void shadow_close(struct shadow *shadow) { free(shadow->surface); }

/* How many draws are cast by `count` of them, however they lie. */
static int shadow_draws(const struct shadow *shadow, int count)
{
    return shadow->wish.kind == SCENE_SHADOW_NONE ? 0 : shadow->wish.kind == SCENE_SHADOW_BLOB ? count > 0 : count;
}

static bool casts(const struct scene_draw *d) { return !d->hidden && d->surface->material.alpha != MODEL_ALPHA_BLEND; }

/* Takes places along the light to the ground: each loses light / light.y times its height. */
static struct xform fall_of(const struct shadow *shadow)
{
    const double *light = shadow->wish.light;
    struct xform fall = xform_move(0, 0, 0);
    for (int row = 0; row < 3; row++) {
        const double along = light[row] / light[1];
        fall.m[4 + row] -= along;
        fall.m[12 + row] += along * shadow->ground;
    }
    return fall;
}

static void cast_flat(const struct shadow *shadow, const struct scene_surface *first, struct scene_draw *out, const struct scene_draw *in)
{
    struct xform world;
    memcpy(world.m, in->world, sizeof world.m);
    world = xform_mul(fall_of(shadow), world);
    *out = *in;
    memcpy(out->world, world.m, sizeof out->world);
    out->surface = &shadow->surface[in->surface - first];
    out->normal = NULL;
    out->hidden = !casts(in);
}

/* Puts the disc under the middle of what is drawn. */
static void cast_round(const struct shadow *shadow, struct scene_draw *out, const struct scene_draw *in, int count)
{
    double low[3] = { INFINITY, INFINITY, INFINITY }, high[3] = { -INFINITY, -INFINITY, -INFINITY };
    for (int i = 0; i < count; i++)
        for (int k = 0; k < in[i].surface->vertex_count && casts(&in[i]); k++) {
            struct xform world;
            memcpy(world.m, in[i].world, sizeof world.m);
            const float *at = in[i].position + 3 * (size_t)k;
            const struct vec3 p = xform_point(world, vec3((double)at[0], (double)at[1], (double)at[2]));
            const double place[3] = { p.x, p.y, p.z };
            for (int axis = 0; axis < 3; axis++) {
                low[axis] = fmin(low[axis], place[axis]);
                high[axis] = fmax(high[axis], place[axis]);
            }
        }
    *out = (struct scene_draw){ .surface = shadow->surface, .position = disc_position, .node = -1, .hidden = !(low[0] <= high[0]) };
    if (out->hidden)
        return;
    const double wide = (high[0] - low[0]) / 2 * SOFT, deep = (high[2] - low[2]) / 2 * SOFT, least = fmax(wide, deep) / 8;
    const struct xform disc = xform_mul(xform_move((low[0] + high[0]) / 2, shadow->ground, (low[2] + high[2]) / 2),
                                        xform_scale(fmax(wide, least), 1, fmax(deep, least)));
    memcpy(out->world, disc.m, sizeof out->world);
}

/* Adds them to an instant whose draws have `first` as the first of all surfaces; its list has room. */
static void shadow_cast(const struct shadow *shadow, const struct scene_surface *first, struct scene_instant *instant)
{
    const int count = instant->draw_count;
    if (shadow->wish.kind == SCENE_SHADOW_BLOB && count > 0)
        cast_round(shadow, &instant->draw[count], instant->draw, count);
    for (int i = 0; i < count && shadow->wish.kind == SCENE_SHADOW_PLANAR; i++)
        cast_flat(shadow, first, &instant->draw[count + i], &instant->draw[i]);
    instant->draw_count += shadow_draws(shadow, count);
}

#define PI 3.14159265358979323846

/* Screens full of triangles in a frame; more take minutes with many instants. */
enum { MAX_COVER = 1024 };

struct model_scene {
    const struct model *model;
    int clip;
    bool loop;
    struct scene_surface *surface;      /* of every primitive of every mesh, mesh after mesh */
    int *first;                         /* per mesh: its first surface */
    struct shadow shadow;
    int camera;                         /* of the file, or -1: `fixed` */
    struct scene_camera fixed;
    double aspect;
};

static void model_instant_free(struct scene *scene, struct scene_instant *instant)
{
    (void)scene;
    if (instant->store != NULL)
        model_pose_free(instant->store);
    free(instant->store);
    free(instant->draw);
}

static void model_scene_free(struct scene *scene)
{
    struct model_scene *m = scene->data;
    if (m == NULL)
        return;
    shadow_close(&m->shadow);
    free(m->surface);
    free(m->first);
    free(m);
}

/* A camera node may be scaled; a camera is a rotation. The view direction is kept, then the
 * upright. */
static bool camera_from_node(const struct model_camera *camera, const double world[16],
                             struct scene_camera *out, struct failure *f)
{
    struct vec3 z = vec3(world[8], world[9], world[10]), up = vec3(world[4], world[5], world[6]);
    struct vec3 origin = vec3(world[12], world[13], world[14]);
    struct vec3 x = vec3_unit(vec3_cross(vec3_unit(up), vec3_unit(z)));
    double size = vec3_length(x) + vec3_length(origin);
    z = vec3_unit(z);
    if (!(vec3_length(x) > 0.5) || !isfinite(size))
        return fail(f, "the camera's node has no direction (scale of zero)");
    struct xform pose = xform_axes(x, vec3_cross(z, x), z, origin);
    *out = (struct scene_camera){.orthographic = camera->orthographic, .yfov = camera->yfov,
                                 .half_height = camera->ymag, .znear = camera->znear,
                                 .zfar = camera->zfar};
    memcpy(out->pose, pose.m, sizeof out->pose);
    /* glTF lets an orthographic camera see from its own plane on; a near plane has to lie before
     * it. */
    if (!(out->znear > 0))
        out->znear = out->zfar > 0 ? out->zfar * 1e-4 : 1e-3;
    return true;
}

static bool model_scene_pose(struct scene *scene, double time, struct scene_instant *out,
                             struct failure *f)
{
    const struct model_scene *m = scene->data;
    if (out->store == NULL)
        out->store = calloc(1, sizeof(struct model_pose));
    struct model_pose *pose = out->store;
    if (pose == NULL)
        return fail(f, "out of memory");
    if (!model_pose_joined(m->model, m->clip, time, out->now, m->loop, pose, f))
        return false;

    if (out->draw == NULL && pose->draw_count > 0) {
        out->draw = calloc((size_t)(pose->draw_count + shadow_draws(&m->shadow, pose->draw_count)), sizeof *out->draw);
        if (out->draw == NULL)
            return fail(f, "out of memory");
    }
    out->draw_count = pose->draw_count;
    for (int i = 0; i < pose->draw_count; i++) {
        const struct model_draw *from = &pose->draw[i];
        int surface = m->first[m->model->node[from->node].mesh] + from->primitive_of_mesh;
        out->draw[i] = (struct scene_draw){.surface = &m->surface[surface],
                                           .position = from->position, .normal = from->normal,
                                           .deformed = from->deformed, .node = from->node};
        memcpy(out->draw[i].world, from->world, sizeof from->world);
    }

    const struct model_camera *camera = m->camera >= 0 ? &m->model->camera[m->camera] : NULL;
    if (camera == NULL)
        out->camera = m->fixed;
    else if (!camera_from_node(camera, pose->node_world + 16 * camera->node, &out->camera, f))
        return false;
    double times = scene_cover(out, m->aspect, MAX_COVER);
    shadow_cast(&m->shadow, m->surface, out);
    return times <= MAX_COVER
        || fail(f, "its triangles cover the picture more than %d times over (at %.6g s)", MAX_COVER, time);
}

static struct scene_surface surface_of(const struct model *model, const struct model_primitive *p,
                                       bool bilinear)
{
    const struct model_material *material = &model->material[p->material];
    struct scene_surface s = {
        .vertex_count = p->vertex_count, .triangle_count = p->triangle_count,
        .position = p->position, .normal = p->normal, .uv = p->uv, .color = p->color,
        .index = p->index,
        .material = {
            .wrap_u = material->wrap_u, .wrap_v = material->wrap_v, .alpha = material->alpha,
            .alpha_cutoff = material->alpha_cutoff, .double_sided = material->double_sided,
            .gloss = material->gloss, .shine = material->shine,
            .unlit = material->unlit, .bilinear = bilinear,
        },
    };
    memcpy(s.material.base, material->base, sizeof s.material.base);
    if (material->image >= 0 && p->uv != NULL)
        s.material.image = &model->image[material->image];
    return s;
}

static bool model_surfaces(struct model_scene *m, bool bilinear, int *surfaces, struct failure *f)
{
    const struct model *model = m->model;
    size_t count = 0;
    m->first = calloc((size_t)model->mesh_count + 1, sizeof *m->first);
    if (m->first == NULL)
        return fail(f, "out of memory");
    for (int i = 0; i < model->mesh_count; i++) {
        m->first[i] = (int)count;
        count += (size_t)model->mesh[i].primitive_count;
    }
    *surfaces = (int)count;
    m->surface = calloc(count + 1, sizeof *m->surface);
    if (m->surface == NULL)
        return fail(f, "out of memory");
    for (int i = 0; i < model->mesh_count; i++)
        for (int k = 0; k < model->mesh[i].primitive_count; k++)
            m->surface[m->first[i] + k] = surface_of(model, &model->mesh[i].primitive[k], bilinear);
    return true;
}

/* Instants of the clip that the automatic camera looks at: fewer of models whose poses are much work, by their vertices or by
 * nodes and channels, and only the first where nothing moves. */
static int bounds_instants(const struct model_scene *m, const struct model_pose *first, double *duration)
{
    enum { INSTANTS = 25, FEWEST = 3, VERTICES = 1 << 21, PLACES = 1 << 20 };
    const struct model *model = m->model;
    size_t vertices = 1, places = (size_t)model->node_count + 1;
    *duration = 0;
    for (int i = 0; i < model->clip_count; i++)
        if (m->clip == MODEL_CLIP_ALL || m->clip == i) {
            *duration = fmax(*duration, model->clip[i].duration);
            places += (size_t)model->clip[i].channel_count;
        }
    for (int i = 0; i < first->draw_count; i++) {
        const struct model_primitive *p = first->draw[i].primitive;
        vertices += (size_t)p->vertex_count * (size_t)(1 + p->target_count + p->influences);
    }
    const size_t deformed = VERTICES / vertices + 1, placed = PLACES / places > FEWEST ? PLACES / places : FEWEST;
    const size_t affordable = deformed < placed ? deformed : placed;
    return *duration <= 0 ? 1 : affordable < INSTANTS ? (int)affordable : INSTANTS;
}

/* Centre and half diagonal of all that is drawn from the clip's start to its end, moving parts included, and how low that reaches.
 * Where nothing is drawn, those of a unit sphere do. */
static bool model_bounds(const struct model_scene *m, struct vec3 *centre, double *radius, double *ground,
                         struct failure *f)
{
    struct model_pose pose = {0};
    double min[3] = { INFINITY, INFINITY, INFINITY }, max[3] = { -INFINITY, -INFINITY, -INFINITY };
    double low[3], high[3], duration = 0;
    int instants = 1;
    bool ok = true;
    *centre = vec3(0, 0, 0);
    *radius = 1;
    *ground = -1;
    for (int i = 0; i < instants && ok; i++) {
        ok = model_pose(m->model, m->clip, instants > 1 ? duration * i / (instants - 1) : 0, false, &pose, f);
        if (ok && i == 0)
            instants = bounds_instants(m, &pose, &duration);
        if (ok && model_pose_bounds(&pose, low, high))
            for (int k = 0; k < 3; k++) {
                min[k] = fmin(min[k], low[k]);
                max[k] = fmax(max[k], high[k]);
            }
    }
    if (ok && min[0] <= max[0]) {
        struct vec3 a = vec3(min[0], min[1], min[2]), b = vec3(max[0], max[1], max[2]);
        double r = vec3_length(vec3_sub(b, a)) / 2;
        *centre = vec3_scale(vec3_add(a, b), 0.5);
        *ground = min[1];
        if (!isfinite(r))
            ok = fail(f, "the scene has no finite bounds");
        else if (r > 0)
            *radius = r;
    }
    model_pose_free(&pose);
    return ok;
}

static bool fixed_camera(struct model_scene *m, const struct scene_view *view, struct vec3 centre, double radius, struct failure *f)
{
    struct vec3 eye, look;
    double distance, yfov = PI / 4;
    double aspect = view->aspect > 0 ? view->aspect : 4.0 / 3.0;
    if (view->has_eye) {
        eye = vec3(view->eye[0], view->eye[1], view->eye[2]);
        look = vec3(view->look[0], view->look[1], view->look[2]);
        distance = vec3_length(vec3_sub(eye, centre));
        yfov = view->fov_degrees * PI / 180;
        if (!(yfov > 0 && yfov < PI))
            return fail(f, "the field of view must lie between 0 and 180 degrees");
        if (!(vec3_length(vec3_sub(eye, look)) > 0) || !isfinite(distance))
            return fail(f, "the eye must not be the point it looks at");
    } else {
        double xfov = 2 * atan(aspect * tan(yfov / 2));
        distance = radius / sin(fmin(xfov, yfov) / 2);
        eye = vec3_add(centre, vec3_scale(vec3_unit(vec3(0.5, 0.35, 1)), distance));
        look = centre;
    }
    struct xform pose = xform_look(eye, look, vec3(0, 1, 0));
    /* An eye amid the scene has a distance near 0; then the scene's size says what is near. */
    double closest = fmax(distance, view->has_eye ? radius : 0) / 100;
    m->fixed = (struct scene_camera){.yfov = yfov, .znear = fmax(distance - 2 * radius, closest),
                                     .zfar = distance + 2 * radius};
    memcpy(m->fixed.pose, pose.m, sizeof m->fixed.pose);
    return true;
}

bool scene_from_model(const struct model *model, const struct scene_view *view, struct scene *out,
                      struct failure *f)
{
    struct model_scene *m = calloc(1, sizeof *m);
    struct vec3 centre;
    double radius, ground = 0;
    int surfaces = 0;
    *out = (struct scene){.name = "model", .width = 320, .height = 240, .fps = 30,
                          .pose = model_scene_pose, .instant_free = model_instant_free,
                          .destroy = model_scene_free, .data = m};
    if (m == NULL)
        return fail(f, "out of memory");
    m->model = model;
    m->clip = view->clip;
    m->loop = view->loop;
    m->camera = view->camera;
    m->aspect = view->aspect > 0 ? view->aspect : 4.0 / 3.0;
    bool ok = view->camera < model->camera_count ||
              fail(f, "there is no camera %d, only %d", view->camera, model->camera_count);
    ok = ok && model_surfaces(m, view->bilinear, &surfaces, f);
    if (ok && (m->camera < 0 || view->shadow.kind != SCENE_SHADOW_NONE))
        ok = model_bounds(m, &centre, &radius, &ground, f) && (m->camera >= 0 || fixed_camera(m, view, centre, radius, f));
    ok = ok && shadow_open(&m->shadow, &view->shadow, ground, m->surface, surfaces, f);
    if (!ok)
        scene_free(out);
    return ok;
}
