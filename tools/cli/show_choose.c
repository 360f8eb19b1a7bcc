/* SPDX-License-Identifier: MIT */
/* show_choose.c - see show.h: looks at poses of all clips, then at all points of the chosen one from some directions. */
#include "tools/cli/show.h"

#include "tools/scenes/xform.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define PI 3.14159265358979323846

/* Vertices and nodes that are posed to compare clips, and to see where one clip goes: a second of work, at most. */
enum { WORK = 1 << 24, MOST_POINTS = 1 << 20, MOST_INSTANTS = 48, TURN_FRAMES = 90, TURN_ANGLES = 24 };

/* A turn takes three seconds; a picture has about as many pixels as 480x360. */
#define FPS 30.0
#define PIXELS (480.0 * 360.0)
#define FOV_DEGREES 30.0
#define NARROWEST 0.75
#define WIDEST 2.2
#define MARGIN 0.07             /* of the picture, at each side */
#define SHORTEST (1.0 / 60.0)   /* seconds of a clip that is one */

/* Points that are to be seen. */
struct cloud {
    struct vec3 *point;
    size_t count, room;
};

/* ------------------------------------------------------------------ poses */

static size_t work_of(const struct model *model, const struct model_pose *pose)
{
    size_t work = (size_t)model->node_count + 1;
    for (int i = 0; i < pose->draw_count; i++) {
        const struct model_primitive *p = pose->draw[i].primitive;
        work += (size_t)p->vertex_count * (size_t)(1 + p->target_count + p->influences);
    }
    return work;
}

static size_t points_of(const struct model_pose *pose)
{
    size_t points = 0;
    for (int i = 0; i < pose->draw_count; i++)
        points += (size_t)pose->draw[i].primitive->vertex_count;
    return points;
}

static long clamp_count(size_t wished, long least, long most)
{
    return wished < (size_t)least ? least : wished > (size_t)most ? most : (long)wished;
}

/* Adds every `stride`-th point of a pose, in world space. */
static void add_points(struct cloud *cloud, const struct model_pose *pose, size_t stride)
{
    size_t number = 0;
    for (int i = 0; i < pose->draw_count; i++) {
        const struct model_draw *draw = &pose->draw[i];
        struct xform world;
        memcpy(world.m, draw->world, sizeof world.m);
        for (int v = 0; v < draw->primitive->vertex_count; v++) {
            const float *at = draw->position + 3 * (size_t)v;
            if (number++ % stride == 0 && cloud->count < cloud->room)
                cloud->point[cloud->count++] = xform_point(world, vec3((double)at[0], (double)at[1], (double)at[2]));
        }
    }
}

/* The points of `instants` poses, evenly over the clip, its end included. */
static bool find_points(const struct model *model, int clip, double duration, long instants, size_t each, size_t stride,
                        struct cloud *cloud, struct failure *f)
{
    struct model_pose pose = { 0 };
    bool ok = true;
    cloud->count = 0;
    cloud->room = (each / stride + 1) * (size_t)instants;
    free(cloud->point);
    cloud->point = malloc(cloud->room * sizeof *cloud->point);
    if (cloud->point == NULL)
        return fail(f, "out of memory");
    for (long i = 0; i < instants && ok; i++) {
        ok = model_pose(model, clip, instants > 1 ? duration * (double)i / (double)(instants - 1) : 0.0, false, &pose, f);
        if (ok)
            add_points(cloud, &pose, stride);
    }
    model_pose_free(&pose);
    return ok;
}

/* ------------------------------------------------------------------ the clip */

/* The way that a point goes per second, on average. */
static double speed_of(const struct cloud *cloud, long instants, double duration)
{
    const size_t each = cloud->count / (size_t)instants;
    double way = 0.0;
    for (size_t i = each; i < cloud->count; i++)
        way += vec3_length(vec3_sub(cloud->point[i], cloud->point[i - each]));
    return each > 0 ? way / (double)each / duration : 0.0;
}

/* Where one moves; of many clips of heavy models only the first are looked at. */
static bool choose_clip(const struct model *model, const struct model_pose *rest, int *clip, struct failure *f)
{
    enum { INSTANTS = 13, FEWEST = 3, POINTS = 4096 };
    const size_t poses = WORK / work_of(model, rest) + FEWEST, each = points_of(rest);
    const long instants = clamp_count(poses / (size_t)(model->clip_count + 1), FEWEST, INSTANTS);
    struct cloud cloud = { NULL, 0, 0 };
    double most = 0.0;
    size_t posed = 0;
    bool ok = true;
    *clip = MODEL_CLIP_NONE;
    for (int i = 0; i < model->clip_count && posed <= poses && ok; i++) {
        const double duration = model->clip[i].duration;
        if (duration < SHORTEST)
            continue;
        ok = find_points(model, i, duration, instants, each, each / POINTS + 1, &cloud, f);
        const double speed = ok ? speed_of(&cloud, instants, duration) : 0.0;
        if (speed > most * (1.0 + 1e-9)) {
            most = speed;
            *clip = i;
        }
        posed += (size_t)instants;
    }
    free(cloud.point);
    return ok;
}

/* ------------------------------------------------------------------ the camera */

/* Axes of a camera: right, up, and back to the eye. */
struct axes {
    struct vec3 x, y, z;
};

static struct axes axes_from(double yaw)
{
    struct axes a = { .z = vec3_unit(vec3(sin(yaw), 0.31, cos(yaw))) };
    a.x = vec3_unit(vec3_cross(vec3(0, 1, 0), a.z));
    a.y = vec3_cross(a.z, a.x);
    return a;
}

/* Bounds of the points along the axes. */
static void bounds_along(const struct cloud *cloud, const struct axes *a, struct vec3 *low, struct vec3 *high)
{
    *low = vec3(INFINITY, INFINITY, INFINITY);
    *high = vec3(-INFINITY, -INFINITY, -INFINITY);
    for (size_t i = 0; i < cloud->count; i++) {
        const struct vec3 p = cloud->point[i];
        const struct vec3 at = vec3(vec3_dot(p, a->x), vec3_dot(p, a->y), vec3_dot(p, a->z));
        *low = vec3(fmin(low->x, at.x), fmin(low->y, at.y), fmin(low->z, at.z));
        *high = vec3(fmax(high->x, at.x), fmax(high->y, at.y), fmax(high->z, at.z));
    }
}

/* The direction from which it is largest, of some in which a model that looks along +z shows its face. */
static struct axes choose_axes(const struct cloud *cloud)
{
    static const double yaw[] = { 0.46, 0.8, 1.1 };
    struct axes best = axes_from(yaw[0]);
    double largest = 0.0;
    for (size_t i = 0; i < sizeof yaw / sizeof *yaw; i++) {
        const struct axes a = axes_from(yaw[i]);
        struct vec3 low, high;
        bounds_along(cloud, &a, &low, &high);
        const double size = (high.x - low.x) * (high.y - low.y);
        if (size > largest * 1.02) {
            largest = size;
            best = a;
        }
    }
    return best;
}

/* What lies on the planes of a view that holds all points, as seen from `center` along the axes: with slopes tx and ty, a point is
 * in it if |x - cx| <= tx (e - z), and likewise for y. */
struct fit {
    double right, left, top, bottom, closest;
};

static const struct fit empty_fit = { -INFINITY, -INFINITY, -INFINITY, -INFINITY, -INFINITY };

static void fit_point(struct fit *fit, struct vec3 p, const struct axes *a, double tx, double ty)
{
    const double x = vec3_dot(p, a->x), y = vec3_dot(p, a->y), z = vec3_dot(p, a->z);
    fit->right = fmax(fit->right, x + tx * z);
    fit->left = fmax(fit->left, -x + tx * z);
    fit->top = fmax(fit->top, y + ty * z);
    fit->bottom = fmax(fit->bottom, -y + ty * z);
    fit->closest = fmax(fit->closest, z);
}

/* As near as all points allow. */
static double place_eye(const struct cloud *cloud, struct vec3 center, const struct axes *a, double tx, double ty, struct vec3 *look)
{
    struct fit fit = empty_fit;
    for (size_t i = 0; i < cloud->count; i++)
        fit_point(&fit, vec3_sub(cloud->point[i], center), a, tx, ty);
    const double across = (fit.right - fit.left) / 2, up = (fit.top - fit.bottom) / 2;
    *look = vec3_add(center, vec3_add(vec3_scale(a->x, across), vec3_scale(a->y, up)));
    return fmax((fit.right + fit.left) / (2 * tx), (fit.top + fit.bottom) / (2 * ty));
}

/* Likewise for one that is turned about an axis through `center`, which stays in the middle of the picture. */
static double place_turned(const struct cloud *cloud, struct vec3 center, const struct axes *a, double tx, double ty, struct vec3 *look)
{
    double distance = 0.0;
    *look = center;
    for (int trial = 0; trial < 3; trial++) {
        struct fit fit = empty_fit;
        for (size_t i = 0; i < cloud->count; i++) {
            const struct vec3 p = vec3_sub(cloud->point[i], *look);
            for (int k = 0; k < TURN_ANGLES; k++) {
                const double c = cos(k * 2.0 * PI / TURN_ANGLES), s = sin(k * 2.0 * PI / TURN_ANGLES);
                fit_point(&fit, vec3(c * p.x + s * p.z, p.y, c * p.z - s * p.x), a, tx, ty);
            }
        }
        distance = fmax(fmax(fit.right, fit.left) / tx, fmax(fit.top, fit.bottom) / ty);
        look->y += (fit.top - fit.bottom) / 2 / a->y.y;
    }
    return distance;
}

/* A picture of the points' shape, which for one that is turned is as wide as it gets. */
static void choose_size(const struct cloud *cloud, const struct axes *a, bool turns, double aspect, struct show *out)
{
    struct vec3 low, high;
    bounds_along(cloud, a, &low, &high);
    double width = high.x - low.x;
    const double height = high.y - low.y;
    if (turns)
        width = fmax(width, hypot(width, high.z - low.z) * 0.9);
    if (aspect <= 0.0)
        aspect = height > 0.0 ? fmin(fmax(width / height, NARROWEST), WIDEST) : WIDEST;
    out->width = 8 * (int)lround(sqrt(PIXELS * aspect) / 8);
    out->height = 8 * (int)lround(sqrt(PIXELS / aspect) / 8);
}

static void choose_camera(const struct cloud *cloud, double aspect, struct show *out)
{
    const struct axes a = choose_axes(cloud), world = { vec3(1, 0, 0), vec3(0, 1, 0), vec3(0, 0, 1) };
    struct vec3 low, high, look, eye;
    bounds_along(cloud, &world, &low, &high);
    const struct vec3 center = vec3_scale(vec3_add(low, high), 0.5);
    const double radius = fmax(vec3_length(vec3_sub(high, low)) / 2, 1e-9 * (1.0 + vec3_length(center)));
    choose_size(cloud, &a, out->spin != 0.0, aspect, out);
    const double shape = aspect > 0.0 ? aspect : (double)out->width / out->height;
    const double ty = tan(FOV_DEGREES * PI / 360) * (1.0 - 2.0 * MARGIN), tx = ty * shape;
    double distance = (out->spin != 0.0 ? place_turned : place_eye)(cloud, center, &a, tx, ty, &look);
    /* Not into it: a sting towards the eye would be all that is seen. */
    distance = fmax(distance, 1.5 * radius);
    eye = vec3_add(look, vec3_scale(a.z, distance));
    const double at[6] = { eye.x, eye.y, eye.z, look.x, look.y, look.z };
    out->has_eye = true;
    for (int i = 0; i < 6; i++)
        out->has_eye = out->has_eye && fabs(at[i]) < 1e9;       /* what an option takes */
    memcpy(out->eye, at, sizeof out->eye);
    memcpy(out->look, at + 3, sizeof out->look);
    out->fov_degrees = FOV_DEGREES;
}

/* ------------------------------------------------------------------ all of it */

static void choose_time(const struct model *model, struct show *out)
{
    if (out->clip == MODEL_CLIP_NONE) {
        out->fps = FPS;
        out->frames = TURN_FRAMES;
        out->spin = 2.0 * PI * FPS / TURN_FRAMES;
        return;
    }
    const double duration = model->clip[out->clip].duration, frames = fmax(1.0, floor(duration * FPS + 0.5));
    out->fps = frames / duration;
    out->is_cut = frames > SHOW_MOST_FRAMES;
    out->frames = frames > SHOW_MOST_FRAMES ? SHOW_MOST_FRAMES : (long)frames;
    snprintf(out->clip_text, sizeof out->clip_text, "%d", out->clip);
    snprintf(out->clip_name, sizeof out->clip_name, "%s", model->clip[out->clip].name);
}

bool show_choose(const struct model *model, double aspect, struct show *out, struct failure *f)
{
    struct model_pose rest = { 0 };
    struct cloud cloud = { NULL, 0, 0 };
    *out = (struct show){ .clip = MODEL_CLIP_NONE, .clip_text = "none" };
    bool ok = model_pose(model, MODEL_CLIP_NONE, 0.0, false, &rest, f);
    const size_t each = ok ? points_of(&rest) : 0, work = ok ? work_of(model, &rest) : 1;
    ok = ok && (each > 0 || fail(f, "there are no triangles to show")) && choose_clip(model, &rest, &out->clip, f);
    if (ok) {
        choose_time(model, out);
        const double duration = (double)out->frames / out->fps;
        const size_t affordable = WORK / work < MOST_POINTS / each ? WORK / work : MOST_POINTS / each;
        const long instants = out->clip == MODEL_CLIP_NONE ? 1 : clamp_count(affordable, 3, MOST_INSTANTS);
        const size_t most = MOST_POINTS / (size_t)(out->clip == MODEL_CLIP_NONE ? TURN_ANGLES : 1);
        ok = find_points(model, out->clip, duration, instants, each, each * (size_t)instants / most + 1, &cloud, f);
    }
    if (ok)
        choose_camera(&cloud, aspect, out);
    if (ok && model->camera_count > 0) {        /* somebody has looked for it */
        out->has_eye = false;
        out->width = 480;
        out->height = 360;
    }
    free(cloud.point);
    model_pose_free(&rest);
    return ok;
}
