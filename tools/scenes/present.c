/* SPDX-License-Identifier: MIT */
/* present.c - from the floats of a scene to the integers of the library; present.h has the rules */
#include "tools/scenes/present.h"

#include "tools/scenes/methods.h"
#include "tools/scenes/present_surface.h"
#include "tools/scenes/xform.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define PI 3.14159265358979323846

/* Largest coordinate handed to the library, as a distance in its units; Q16.16 ends at 32768. */
#define WORLD_LIMIT 30000.0

/* Smallest near plane: 64 steps of Q16.16. Below, a pixel next to the eye is less than a step. */
#define NEAR_LIMIT (1.0 / 1024.0)

/* The near plane is moved out where the nearest thing is this many times farther: depth codes get
 * coarse beyond 256 near planes. Moved by powers of two, so that it rests while things move. */
#define NEAR_SLACK 128.0

/* Without poses of the shutter OPEN is a frame ago and CLOSE two frames ago. */
enum { NOW, OPEN, CLOSE, POSES };

#define NOT_KEPT INT_MAX

/* What one submitted draw points to. */
struct slot {
    smear_mesh mesh;
    smear_transform pose[POSES];
    int16_t *position[POSES];       /* of deformed draws */
    int8_t *normal;
    int vertex_room;
};

/* A draw of the scene in this frame. */
struct plan {
    int converted;
    bool drawn, cut, deformed;
    struct bounds bounds;           /* deformed: over all its poses */
    struct grid grid;
    int exponent;                   /* the basis is the matrix x 2^-exponent */
};

struct presenter {
    struct scene *scene;
    struct scene_instant instant[POSES];
    int converted_count, converted_room;
    struct converted *converted;
    struct texture_store texture;
    int plan_room;
    struct plan *plan;
    int *converted_of_draw;         /* remembered from the frame before; -1 */
    int *kept_exponent;             /* with keep_ids: of each draw's first frame; NOT_KEPT before */
    bool is_kept;                   /* with keep_ids: the world is that of the first frame */
    double kept_reference[3], kept_scale;
    int slot_room;
    struct slot **slot;
    smear_draw *draw;
    struct backdrop backdrop;
    struct presented out;
};

static int32_t fixed(double x, int fraction_bits)
{
    return (int32_t)llround(clamp(ldexp(x, fraction_bits), -2147483647.0, 2147483647.0));
}

/* ------------------------------------------------------------------ surfaces */

static int find_converted(const struct presenter *p, const struct scene_surface *surface)
{
    for (int i = 0; i < p->converted_count; i++)
        if (p->converted[i].surface == surface)
            return i;
    return -1;
}

/* Converts surfaces not seen before. Those of neighbouring draws of one node get one grid. */
static bool convert_new(struct presenter *p, const struct scene_instant *now, struct failure *f)
{
    for (int i = 0; i < now->draw_count;) {
        int end = i, first_new = p->converted_count;
        struct bounds bounds = empty_bounds;
        for (; end < now->draw_count; end++) {
            const struct scene_draw *d = &now->draw[end];
            if (end > i && (d->node < 0 || d->node != now->draw[i].node))
                break;
            int *known = &p->converted_of_draw[end];
            if (*known >= 0 && p->converted[*known].surface == d->surface)
                continue;
            *known = find_converted(p, d->surface);
            if (*known >= 0)
                continue;
            if (!grow((void **)&p->converted, &p->converted_room, p->converted_count + 1,
                      sizeof *p->converted, f))
                return false;
            *known = p->converted_count;
            struct converted *c = &p->converted[p->converted_count++];
            *c = (struct converted){ .surface = d->surface, .bounds = empty_bounds };
            if (!add_positions(&c->bounds, d->surface->position, d->surface->vertex_count))
                return fail(f, "a vertex position is not a number (draw %d)", end);
            add_bounds(&bounds, &c->bounds);
        }
        const struct grid grid = bounds.min[0] <= bounds.max[0] ? grid_over(&bounds) : (struct grid){ .step = 1.0 };
        for (int j = first_new; j < p->converted_count; j++) {
            struct converted *c = &p->converted[j];
            if (c->bounds.min[0] <= c->bounds.max[0])
                c->grid = grid;
            if (!convert_surface(c, &p->texture, f))
                return false;
        }
        i = end;
    }
    return true;
}

/* ------------------------------------------------------------------ world and cameras */

static void transform_point(const double m[16], const double in[3], double out[3])
{
    for (int row = 0; row < 3; row++)
        out[row] = m[row] * in[0] + m[4 + row] * in[1] + m[8 + row] * in[2] + m[12 + row];
}

static double distance(const double a[3], const double b[3])
{
    double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
    return sqrt(x * x + y * y + z * z);
}

/* How far things are, over every pose of the frame. */
struct reach {
    double farthest;                /* distance from the reference or from the pose's own camera */
    double min_depth, max_depth;    /* along the view of the pose's own camera */
};

static void reach_point(struct reach *reach, const double point[3], const double reference[3],
                        const struct scene_camera *camera, bool is_seen)
{
    const double *eye = camera->pose + 12, *back = camera->pose + 8;
    reach->farthest = fmax(reach->farthest, fmax(distance(point, reference), distance(point, eye)));
    if (!is_seen)
        return;
    double depth = -((point[0] - eye[0]) * back[0] + (point[1] - eye[1]) * back[1] +
                     (point[2] - eye[2]) * back[2]);
    reach->min_depth = fmin(reach->min_depth, depth);
    reach->max_depth = fmax(reach->max_depth, depth);
}

static void reach_draw(struct reach *reach, const struct plan *plan, const struct bounds *b,
                       const double world[16], const double reference[3],
                       const struct scene_camera *camera)
{
    double point[3];
    for (int corner = 0; corner < 8; corner++) {
        const double object[3] = { (corner & 1 ? b->max : b->min)[0],
                                   (corner & 2 ? b->max : b->min)[1],
                                   (corner & 4 ? b->max : b->min)[2] };
        transform_point(world, object, point);
        reach_point(reach, point, reference, camera, true);
    }
    transform_point(world, plan->grid.fold, point);
    reach_point(reach, point, reference, camera, false);
}

static bool check_camera(const struct scene_camera *c, struct failure *f)
{
    for (int i = 0; i < 16; i++)
        if (!isfinite(c->pose[i]))
            return fail(f, "the camera's pose is not a number");
    if (c->orthographic ? !(c->half_height > 0.0) || !isfinite(c->half_height) || !(c->znear >= 0.0)
                        : !(c->yfov > 0.0) || !(c->yfov < PI) || !(c->znear > 0.0))
        return fail(f, "the camera has no valid field of view or near plane");
    if (!isfinite(c->znear) || !isfinite(c->zfar) || c->zfar < 0.0 ||
        (c->zfar > 0.0 && c->zfar <= c->znear))
        return fail(f, "the camera's far plane is not beyond its near plane");
    return true;
}

/* The planes between which things are drawn. Codes of an orthographic depth divide far - near
 * evenly, so planes far beyond everything would waste them. */
static void choose_planes(const struct scene_camera *camera, const struct reach *reach,
                          double *near_plane, double *far_plane)
{
    bool has_depth = reach->max_depth >= reach->min_depth;
    *near_plane = camera->znear;
    *far_plane = camera->zfar;
    if (!camera->orthographic) {
        while (has_depth && reach->min_depth > *near_plane * NEAR_SLACK)
            *near_plane *= 2.0;
        if (*far_plane > 0.0 && *near_plane > *far_plane / 2.0)
            *near_plane = camera->znear;
        return;
    }
    double thick = camera->half_height;
    if (has_depth)
        thick = fmax(reach->max_depth - reach->min_depth, camera->half_height / 64.0);
    if (has_depth && (*far_plane == 0.0 || *far_plane - *near_plane > 4.0 * thick)) {
        *near_plane = fmax(*near_plane, reach->min_depth - thick / 16.0);
        double behind = fmax(reach->max_depth, *near_plane) + thick / 16.0;
        *far_plane = *far_plane > 0.0 ? fmin(*far_plane, behind) : behind;
    }
    if (*far_plane <= *near_plane)
        *far_plane = *near_plane + thick;
}

/* Chooses the world's scale, for this frame or, with `keep`, for the first and all after it. */
static bool choose_world(struct presenter *p, bool keep, const struct reach *reach,
                         struct failure *f)
{
    const struct scene_camera *camera = &p->instant[NOW].camera;
    struct presented *out = &p->out;
    double near_plane, far_plane, farthest = reach->farthest;
    double room = keep && !p->is_kept ? WORLD_LIMIT / 4.0 : WORLD_LIMIT;    /* things will move */
    int exponent;                   /* world_scale = 2^exponent */
    choose_planes(camera, reach, &near_plane, &far_plane);
    out->orthographic = camera->orthographic;
    if (camera->orthographic) {
        farthest = fmax(farthest, fmax(far_plane, camera->half_height * 4.0));
        exponent = ilogb(room / 2.0 / farthest);
    } else {
        exponent = -ilogb(near_plane);
        if (farthest > 0.0 && exponent > ilogb(room / farthest))
            exponent = ilogb(room / farthest);
    }
    if (keep && p->is_kept)
        exponent = ilogb(p->kept_scale);
    if (exponent < -1000 || exponent > 1000)
        return fail(f, "the scene is too large or too small");
    if (ldexp(farthest, exponent) > WORLD_LIMIT)
        return fail(f, "things move %g away, too far for the scale of the first frame", farthest);
    if (!camera->orthographic && ldexp(near_plane, exponent) < NEAR_LIMIT)
        return fail(f, "near plane %g and farthest vertex %g are too far apart for fixed point",
                    near_plane, farthest);
    out->world_scale = ldexp(1.0, exponent);
    /* the library wants near > 0: an orthographic camera may as well stand a unit farther back */
    if (camera->orthographic && near_plane * out->world_scale < 1.0)
        out->camera_back = 1.0;
    out->near_plane = near_plane * out->world_scale + out->camera_back;
    out->far_plane = far_plane > 0.0 ? far_plane * out->world_scale + out->camera_back : 0.0;
    if (out->far_plane > WORLD_LIMIT)
        out->far_plane = 0.0;       /* perspective: nothing is that far */
    if (keep) {
        p->kept_scale = out->world_scale;
        p->is_kept = true;
    }
    return true;
}

/* Brings fog to the library's units. */
static bool fill_fog(struct presented *out, const struct present_fog *fog, struct failure *f)
{
    const double begin = fog->begin * out->world_scale + out->camera_back;
    const double end = fog->end * out->world_scale + out->camera_back;
    if (end > WORLD_LIMIT)
        return fail(f, "fog that ends %g away is too far for fixed point; here it may be %g", fog->end,
                    (WORLD_LIMIT - out->camera_back) / out->world_scale);
    if (end <= out->near_plane)
        return fail(f, "fog that ends %g away ends before the camera's near plane, %g", fog->end,
                    (out->near_plane - out->camera_back) / out->world_scale);
    out->fog = (smear_fog){ .color = fog->color, .near_plane = fixed(begin, 16), .far_plane = fixed(end, 16) };
    out->frame.fog = &out->fog;
    return true;
}

static uint16_t channel_of(unsigned color, int channel, double part)
{
    return (uint16_t)(65535 * part * present_srgb_decode((uint8_t)(color >> (16 - 8 * channel))) + 0.5);
}

/* Makes a direction of the library's of one of any length. */
static void fill_direction(int32_t out[3], const double direction[3])
{
    const double length = fabs(direction[0]) + fabs(direction[1]) + fabs(direction[2]);
    for (int i = 0; i < 3; i++)
        out[i] = fixed(direction[i] / length, 16);
}

static void fill_sun(struct presented *out, const struct present_lights *lights)
{
    fill_direction(out->sun.direction, lights->sun_direction);
    for (int i = 0; i < 3; i++) {
        out->sun.ambient[i] = channel_of(lights->sun, i, 0.3);
        out->sun.diffuse[i] = channel_of(lights->sun, i, 0.7);
    }
    out->frame.light = &out->sun;
}

/* Brings lights to the library's units. */
static bool fill_lights(struct presented *out, const struct present_lights *lights, const double reference[3], struct failure *f)
{
    double place[3], farthest = lights->reach * out->world_scale;
    out->lights = (smear_lights){ .shader = &smear_lights_shader };
    for (int i = 0; i < 3; i++) {
        place[i] = (lights->place[i] - reference[i]) * out->world_scale;
        farthest = fmax(farthest, fabs(place[i]));
    }
    const bool has_lamp = lights->reach > 0.0 && farthest <= WORLD_LIMIT;
    if (lights->reach > 0.0 && !has_lamp && !lights->are_of_file)
        return fail(f, "the lamp is too far away for fixed point");
    for (int i = 0; i < 3; i++) {
        if (lights->has_second)
            out->lights.diffuse[i] = channel_of(lights->second, i, 1);
        if (has_lamp) {
            out->lights.lamp[i] = fixed(place[i], 16);
            out->lights.lamp_diffuse[i] = channel_of(lights->lamp, i, 1);
        }
    }
    if (lights->has_second)
        fill_direction(out->lights.direction, lights->direction);
    out->lights.reach = has_lamp ? fixed(lights->reach * out->world_scale, 16) : 0;
    out->extras.lights = &out->lights;
    out->frame.scene = &out->extras;
    return true;
}

static void fill_sky(struct presented *out, const struct present_sky *sky)
{
    if (!sky->is_wanted)
        return;
    out->sky = (smear_sky)SMEAR_SKY(sky->zenith, sky->horizon, sky->ground, sky->nadir);
    out->extras.sky = &out->sky;
    out->frame.scene = &out->extras;
}

static void fill_camera(smear_camera *out, const struct scene_camera *camera,
                        const double reference[3], const struct presented *world)
{
    *out = (smear_camera){ .near_plane = fixed(world->near_plane, 16),
                           .far_plane = fixed(world->far_plane, 16) };
    for (int row = 0; row < 3; row++) {
        for (int column = 0; column < 3; column++)
            out->pose.basis[row * 3 + column] = fixed(camera->pose[column * 4 + row], 24);
        out->pose.origin[row] =
            fixed((camera->pose[12 + row] - reference[row]) * world->world_scale +
                      camera->pose[8 + row] * world->camera_back, 16);
    }
    if (camera->orthographic)
        out->half_height = fixed(camera->half_height * world->world_scale, 16);
    else
        out->focal = fixed(1.0 / tan(camera->yfov / 2.0), 16);
}

/* ------------------------------------------------------------------ draws */

/* The largest entry of the matrices x 2^-exponent lies in (1/2, 1]: rotations keep exponent 0. */
static int common_exponent(const struct scene_draw *const draw[POSES])
{
    double largest = 0.0;
    int exponent = 0;
    for (int pose = 0; pose < POSES; pose++)
        for (int i = 0; i < 12 && draw[pose] != NULL; i++)
            if (i % 4 != 3)
                largest = fmax(largest, fabs(draw[pose]->world[i]));
    if (largest > 0.0 && frexp(largest, &exponent) == 0.5)
        exponent--;
    /* a rotation may overshoot 1 by rounding */
    if (exponent == 1 && largest < 1.0 + 1e-6)
        exponent = 0;
    return exponent;
}

static void fill_transform(smear_transform *out, const double world[16], const struct plan *plan,
                           const double reference[3], double world_scale)
{
    double origin[3];
    transform_point(world, plan->grid.fold, origin);
    for (int row = 0; row < 3; row++) {
        for (int column = 0; column < 3; column++)
            out->basis[row * 3 + column] = fixed(world[column * 4 + row], 24 - plan->exponent);
        out->origin[row] = fixed((origin[row] - reference[row]) * world_scale, 16);
    }
}

/* Room for one more draw. Slots stay where they are, as draws point into them. */
static bool slot_room(struct presenter *p, int count, struct failure *f)
{
    if (count <= p->slot_room)
        return true;
    int draws = p->slot_room;
    if (!grow((void **)&p->draw, &draws, count, sizeof *p->draw, f))
        return false;
    return grow((void **)&p->slot, &p->slot_room, count, sizeof *p->slot, f);
}

static bool slot_vertices(struct slot *slot, int count, struct failure *f)
{
    if (count <= slot->vertex_room)
        return true;
    slot->vertex_room = 0;
    for (int pose = 0; pose < POSES; pose++) {
        free(slot->position[pose]);
        slot->position[pose] = malloc((size_t)count * 3 * sizeof *slot->position[pose]);
    }
    free(slot->normal);
    slot->normal = malloc((size_t)count * 3);
    if (slot->position[NOW] == NULL || slot->position[OPEN] == NULL ||
        slot->position[CLOSE] == NULL || slot->normal == NULL)
        return out_of_memory(f);
    slot->vertex_room = count;
    return true;
}

static void fill_mesh(smear_mesh *mesh, const struct part *part, const struct plan *plan,
                      const double world_scale)
{
    int32_t scale;
    int shift;
    split_step(ldexp(plan->grid.step, plan->exponent) * world_scale, &scale, &shift);
    for (; shift > 62; shift--)     /* far smaller than a step of the world */
        scale = scale > 1 ? scale >> 1 : 1;
    if (shift < -32)                /* only where all vertices lie in one point */
        shift = -32;
    *mesh = (smear_mesh){ .position = part->position, .normal = part->normal, .uv = part->uv,
                          .color = part->color, .face_color = part->face_color,
                          .index = part->index,
                          .triangle_count = (uint32_t)part->triangle_count,
                          .vertex_count = (uint16_t)part->vertex_count, .shift = (int8_t)shift,
                          .uv_shift = (uint8_t)part->uv_shift, .scale = scale };
    memcpy(mesh->offset, plan->grid.offset, sizeof mesh->offset);
    memcpy(mesh->bounds, part->bounds, sizeof mesh->bounds);
}

static bool add_part(struct presenter *p, const struct converted *c, const struct part *part,
                     const struct plan *plan, const struct scene_draw *const pose[POSES],
                     const double reference[3], uint8_t motion, struct failure *f)
{
    struct presented *out = &p->out;
    if (!slot_room(p, out->draw_count + 1, f))
        return false;
    struct slot **slot_at = &p->slot[out->draw_count];
    if (*slot_at == NULL)
        *slot_at = calloc(1, sizeof **slot_at);
    struct slot *slot = *slot_at;
    if (slot == NULL)
        return out_of_memory(f);
    smear_draw *draw = &p->draw[out->draw_count];
    *draw = (smear_draw){ .mesh = &slot->mesh, .material = &c->material, .motion = motion,
                          .cut = plan->cut, .now = &slot->pose[NOW] };
    if (c->surface->material.shadow != SCENE_SHADOW_NONE)
        draw->path = SMEAR_PATH_LINE;   /* nothing that is flat turns */
    fill_mesh(&slot->mesh, part, plan, out->world_scale);
    for (int i = 0; i < POSES; i++)
        if (pose[i] != NULL)
            fill_transform(&slot->pose[i], pose[i]->world, plan, reference, out->world_scale);
    draw->open = pose[OPEN] != NULL ? &slot->pose[OPEN] : NULL;
    draw->close = pose[CLOSE] != NULL ? &slot->pose[CLOSE] : NULL;
    if (plan->deformed) {
        if (!slot_vertices(slot, part->vertex_count, f))
            return false;
        for (int i = 0; i < POSES; i++)
            if (pose[i] != NULL)
                quantise_positions(slot->position[i], pose[i]->position, part, &plan->grid);
        slot->mesh.position = slot->position[NOW];
        draw->open_position = slot->position[pose[OPEN] != NULL ? OPEN : NOW];
        draw->close_position = pose[CLOSE] != NULL ? slot->position[CLOSE] : NULL;
        slot->mesh.normal = NULL;
        if (pose[NOW]->normal != NULL) {
            quantise_normals(slot->normal, pose[NOW]->normal, part);
            slot->mesh.normal = slot->normal;
        }
    }
    out->draw_count++;
    out->triangle_count += (uint32_t)part->triangle_count;
    return true;
}

/* The draw at each pose; null where it is not known. Returns whether it was cut in between: two frames ago that only
 * means that nothing is known of then. */
static bool draw_poses(const struct presenter *p, int index, const bool has[POSES],
                       const struct scene_draw *pose[POSES])
{
    const bool has_older = !p->out.frame.shutter.poses;
    bool cut = false;
    for (int i = 0; i < POSES; i++) {
        const struct scene_instant *instant = &p->instant[i];
        pose[i] = NULL;
        if (!has[i])
            continue;
        if (index < instant->draw_count && !instant->draw[index].hidden)
            pose[i] = &instant->draw[index];
        const bool is_other = pose[i] == NULL || pose[i]->epoch != pose[NOW]->epoch;
        if (is_other && i == CLOSE && has_older)
            pose[i] = NULL;
        else
            cut = cut || is_other;
    }
    if (cut)
        pose[OPEN] = pose[CLOSE] = NULL;
    return cut;
}

/* ------------------------------------------------------------------ frames */

void present_exposure(double time, const struct present_options *options, double *open,
                      double *close)
{
    double length = options->shutter_degrees / 360.0 / options->fps;
    double before = options->exposure == SMEAR_TRAILING  ? 1.0
                  : options->exposure == SMEAR_LEADING ? 0.0
                                                        : 0.5;
    *open = time - before * length;
    *close = *open + length;
}

static bool fill_frame(smear_frame *frame, const struct present_options *o, struct failure *f)
{
    if (!(o->fps > 0.0) || !isfinite(o->fps))
        return fail(f, "the frame rate is not above zero");
    if (!(o->shutter_degrees >= 0.0) || o->shutter_degrees > 3600.0)
        return fail(f, "a shutter of %g degrees is not within 0 to 3600", o->shutter_degrees);
    long degrees = lround(o->shutter_degrees);
    *frame = (smear_frame){ .method = degrees == 0 ? SMEAR_NONE : (uint8_t)o->method,
                            .light_space = (uint8_t)o->light, .cut = o->cut || o->instant_only,
                            .samples = (uint16_t)o->samples, .target = (uint16_t)o->target, .budget = o->budget,
                            .clear = o->clear, .layer = o->layer, .layer_count = (uint8_t)o->layer_count };
    if (method_smooths_edges(o->method))
        frame->edges = (uint8_t)o->edges;
    /* A sharp frame with smooth edges is one in which nothing moves. */
    if (degrees == 0 && frame->edges != SMEAR_EDGES_HARD) {
        frame->method = (uint8_t)o->method;
        frame->cut = 1;
    }
    frame->shutter = (smear_shutter){ .degrees = (uint16_t)degrees, .exposure = (uint8_t)o->exposure,
                                      .poses = o->shutter_poses && degrees > 0 && !o->instant_only,
                                      .path = (uint8_t)o->path,
                                      .mode = (uint8_t)o->shutter_mode, .frame_us = (uint32_t)o->frame_us,
                                      .us = (uint32_t)o->shutter_us, .curve = o->shutter };
    frame->filter = (smear_filter){ .kind = (uint8_t)o->filter, .flags = (uint8_t)o->reconstruct,
                                    .weights = (uint8_t)o->weights, .camera_step = (uint8_t)o->camera_step,
                                    .pingpong = o->pingpong };
    frame->scale = (smear_motion_scale){ .rotation = (uint16_t)o->turn_scale, .translation = (uint16_t)o->way_scale,
                                  .object = (uint16_t)o->object_scale };
    return true;
}

static bool pose_all(struct presenter *p, double time, const struct present_options *o,
                     struct failure *f)
{
    const smear_frame *frame = &p->out.frame;
    struct present_options whole = *o;
    double open, close;
    whole.shutter_degrees = frame->shutter.degrees;
    present_exposure(time, &whole, &open, &close);
    /* With poses of the shutter, what is "now" for a blur is the middle of the exposure. */
    bool middle = frame->shutter.poses && frame->method != SMEAR_NONE;
    const double now = middle ? (open + close) / 2 : time;
    if (!scene_pose(p->scene, now, &p->instant[NOW], f))
        return false;
    if (o->instant_only)
        return true;
    if (!frame->shutter.poses) {
        open = time - 1.0 / o->fps;
        close = time - 2.0 / o->fps;
    }
    return scene_pose_joined(p->scene, open, now, &p->instant[OPEN], f) &&
           scene_pose_joined(p->scene, close, now, &p->instant[CLOSE], f);
}

static bool per_draw_room(struct presenter *p, int count, struct failure *f)
{
    int room = p->plan_room, kept_room = p->plan_room;
    if (count <= room)
        return true;
    if (!grow((void **)&p->converted_of_draw, &room, count, sizeof *p->converted_of_draw, f) ||
        !grow((void **)&p->kept_exponent, &kept_room, count, sizeof *p->kept_exponent, f))
        return false;
    for (int i = p->plan_room; i < room; i++) {
        p->converted_of_draw[i] = -1;
        p->kept_exponent[i] = NOT_KEPT;
    }
    return grow((void **)&p->plan, &p->plan_room, count, sizeof *p->plan, f);
}

/* A kept pose stays as it was given, so the basis of a draw must keep its scale. */
static bool keep_exponent(struct presenter *p, int index, struct plan *plan, struct failure *f)
{
    int *kept = &p->kept_exponent[index];
    if (*kept == NOT_KEPT)
        *kept = plan->exponent;
    if (plan->exponent - *kept > 6)
        return fail(f, "a draw grows more than 64-fold (draw %d)", index);
    plan->exponent = *kept;
    return true;
}

/* What is drawn, with which poses and on which grid; deformed draws of one node share a grid. */
static bool plan_draws(struct presenter *p, const bool has[POSES], bool keep, struct failure *f)
{
    const struct scene_instant *now = &p->instant[NOW];
    for (int i = 0; i < now->draw_count; i++) {
        const struct scene_draw *d = &now->draw[i], *pose[POSES];
        struct plan *plan = &p->plan[i];
        const struct converted *c = &p->converted[p->converted_of_draw[i]];
        *plan = (struct plan){ .converted = p->converted_of_draw[i], .bounds = empty_bounds };
        plan->drawn = !d->hidden && !c->invisible && c->part_count > 0;
        if (!plan->drawn)
            continue;
        plan->cut = draw_poses(p, i, has, pose);
        plan->deformed = d->deformed;
        plan->exponent = common_exponent(pose);
        if (keep && !d->deformed && !keep_exponent(p, i, plan, f))
            return false;
        plan->grid = c->grid;
        plan->bounds = d->deformed ? empty_bounds : c->bounds;
        for (int j = 0; j < POSES; j++) {
            if (pose[j] == NULL)
                continue;
            for (int k = 0; k < 16; k++)
                if (!isfinite(pose[j]->world[k]))
                    return fail(f, "a transform is not a number (draw %d)", i);
            if (d->deformed &&
                !add_positions(&plan->bounds, pose[j]->position, d->surface->vertex_count))
                return fail(f, "a vertex position is not a number (draw %d)", i);
        }
    }
    for (int i = 0; i < now->draw_count;) {
        struct bounds bounds = empty_bounds;
        int end = i;
        for (; end < now->draw_count; end++) {
            if (end > i && (now->draw[end].node < 0 || now->draw[end].node != now->draw[i].node))
                break;
            if (p->plan[end].drawn && p->plan[end].deformed)
                add_bounds(&bounds, &p->plan[end].bounds);
        }
        for (; i < end; i++)
            if (p->plan[i].drawn && p->plan[i].deformed)
                p->plan[i].grid = grid_over(&bounds);
    }
    return true;
}

static uint8_t motion_mode(uint8_t scene_motion)
{
    return scene_motion == SCENE_MOTION_CAMERA ? SMEAR_MOTION_CAMERA
         : scene_motion == SCENE_MOTION_NONE ? SMEAR_MOTION_NONE
                                               : SMEAR_MOTION_FULL;
}

static void reach_all(const struct presenter *p, const bool seen[POSES], const double reference[3],
                      struct reach *reach)
{
    const struct scene_draw *pose[POSES];
    *reach = (struct reach){ 0.0, INFINITY, -INFINITY };
    for (int i = 0; i < POSES; i++)
        if (seen[i])
            reach->farthest =
                fmax(reach->farthest, distance(p->instant[i].camera.pose + 12, reference));
    for (int i = 0; i < p->instant[NOW].draw_count; i++) {
        if (!p->plan[i].drawn)
            continue;
        draw_poses(p, i, seen, pose);
        for (int j = 0; j < POSES; j++)
            if (pose[j] != NULL)
                reach_draw(reach, &p->plan[i], &p->plan[i].bounds, pose[j]->world, reference,
                           &p->instant[j].camera);
    }
}

static bool add_draws(struct presenter *p, const bool seen[POSES], const double reference[3],
                      const struct present_options *o, struct failure *f)
{
    const struct scene_draw *pose[POSES];
    uint32_t id = 0;
    for (int i = 0; i < p->instant[NOW].draw_count; i++) {
        const struct plan *plan = &p->plan[i];
        const struct converted *c = &p->converted[p->converted_of_draw[i]];
        bool has_motion = o->motion != NULL && i < o->motion_count;
        uint8_t motion = has_motion ? motion_mode(o->motion[i]) : SMEAR_MOTION_FULL;
        if (plan->drawn)
            draw_poses(p, i, seen, pose);
        for (int j = 0; j < c->part_count; j++) {
            id++;                   /* hidden draws keep theirs */
            if (!plan->drawn)
                continue;
            if (!add_part(p, c, &c->part[j], plan, pose, reference, motion, f))
                return false;
            smear_draw *draw = &p->draw[p->out.draw_count - 1];
            if (o->layers != NULL && i < o->layers_count)
                draw->layers = o->layers[i];
            if (o->keep_ids && !plan->deformed) {
                draw->id = id;
                draw->open = NULL;
            }
        }
    }
    p->out.draw = p->draw;
    return true;
}

/* Adds the background, behind all that is drawn. */
static bool add_backdrop(struct presenter *p, const struct present_options *o, const struct reach *reach, struct failure *f)
{
    struct presented *out = &p->out;
    const double farthest = reach->max_depth > 0.0 ? reach->max_depth * out->world_scale + out->camera_back : 0.0;
    if (!o->backdrop.is_wanted)
        return true;
    if (!slot_room(p, out->draw_count + 1, f) ||
        !backdrop_place(&p->backdrop, &o->backdrop, &out->camera[NOW], farthest, &p->draw[out->draw_count], f))
        return false;
    out->draw = p->draw;
    out->draw_count++;
    out->triangle_count += BACKDROP_TRIANGLES;
    return out->has_backdrop = true;
}

static bool present(struct presenter *p, double time, const struct present_options *o,
                    struct failure *f)
{
    struct presented *out = &p->out;
    memset(out, 0, sizeof *out);
    if (!fill_frame(&out->frame, o, f) || !pose_all(p, time, o, f))
        return false;
    const struct scene_instant *now = &p->instant[NOW];
    bool has[POSES] = { true, !o->instant_only, !o->instant_only };
    for (int i = 0; i < POSES; i++) {
        const struct scene_camera *camera = &p->instant[i].camera;
        if (!has[i])
            continue;
        if (!check_camera(camera, f))
            return false;
        const bool is_other = camera->epoch != now->camera.epoch || camera->orthographic != now->camera.orthographic;
        if (is_other && i == CLOSE && !out->frame.shutter.poses)
            has[i] = false;
        else if (is_other)
            out->frame.cut = 1;
    }
    if (!per_draw_room(p, now->draw_count, f) || !convert_new(p, now, f) ||
        !plan_draws(p, has, o->keep_ids, f))
        return false;

    /* after a cut the other poses mean nothing */
    const bool moves = out->frame.cut == 0;
    const bool seen[POSES] = { true, has[OPEN] && moves, has[CLOSE] && moves };
    const bool blurred[POSES] = { true, seen[OPEN], seen[CLOSE] && out->frame.shutter.poses };
    const double *reference = now->camera.pose + 12;
    struct reach reach;
    if (o->keep_ids) {
        if (!p->is_kept)
            memcpy(p->kept_reference, reference, sizeof p->kept_reference);
        reference = p->kept_reference;
    }
    reach_all(p, blurred, reference, &reach);
    out->extras = (smear_scene){ 0 };
    if (o->lights.has_sun)
        fill_sun(out, &o->lights);
    const bool lit = o->lights.has_second || o->lights.gloss || o->lights.reach > 0.0;
    if (!choose_world(p, o->keep_ids, &reach, f) || (o->fog.end != 0.0 && !fill_fog(out, &o->fog, f))
        || (lit && !fill_lights(out, &o->lights, reference, f)))
        return false;

    for (int i = 0; i < POSES; i++)
        if (seen[i])
            fill_camera(&out->camera[i], &p->instant[i].camera, reference, out);
    out->frame.camera = &out->camera[NOW];
    out->frame.open = seen[OPEN] && !o->keep_ids ? &out->camera[OPEN] : NULL;
    out->frame.close = seen[CLOSE] ? &out->camera[CLOSE] : NULL;
    out->frame.shutter.poses = out->frame.shutter.poses && moves;
    fill_sky(out, &o->sky);
    return add_draws(p, seen, reference, o, f) && add_backdrop(p, o, &reach, f);
}

const struct presented *presenter_frame(struct presenter *presenter, double time,
                                        const struct present_options *options, struct failure *f)
{
    presenter->texture.narrow = options->texels_565;
    return present(presenter, time, options, f) ? &presenter->out : NULL;
}

int presented_submit(const struct presented *presented, smear_context *ctx)
{
    int result = smear_begin(ctx, &presented->frame);
    for (int i = 0; i < presented->draw_count && result == SMEAR_OK; i++)
        result = smear_submit(ctx, &presented->draw[i]);
    return result;
}

smear_desc presented_desc(const struct presented *presented, int width, int height)
{
    /* Clipping turns a triangle into a few; most frames need far less than this. */
    uint32_t triangles = presented->triangle_count + presented->triangle_count / 8 + 64;
    int draws = presented->draw_count > 0 ? presented->draw_count : 1;
    const smear_frame *frame = &presented->frame;
    const bool has_kind = frame->method == SMEAR_CAMERA || frame->method == SMEAR_HALF;
    const bool is_pingpong = frame->method == SMEAR_PINGPONG
                          || (has_kind && frame->filter.kind == SMEAR_FILTER_PINGPONG);
    const unsigned passes = frame->filter.pingpong.passes != 0 ? frame->filter.pingpong.passes : 2;
    const unsigned own = frame->method != SMEAR_DEFAULT_METHOD ? SMEAR_SET(frame->method) : 0;
    const unsigned methods = own | (is_pingpong ? SMEAR_SET(SMEAR_PINGPONG) : 0);
    return (smear_desc){ .width = (int16_t)width, .height = (int16_t)height, .methods = (uint16_t)methods,
                         .filter.passes = (uint8_t)(is_pingpong ? passes : 0),
                         .max_draws = (uint16_t)(draws < 65535 ? draws : 65535),
                         .max_triangles = triangles };
}

void present_tiles(smear_desc *desc, bool wide)
{
    enum { STRIP = 320 };
    const bool has_reach = (desc->methods & (SMEAR_SET_FILTERS | SMEAR_SET_LAYERS | SMEAR_SET_SKETCH)) != 0;
    const bool is_temporal = (desc->methods & SMEAR_SET_TEMPORAL) != 0;
    const int share = desc->height * 5 / 100, usual = share < 1 ? 1 : share > 64 ? 64 : share;
    const int reach = desc->reach != 0 ? desc->reach : usual, tenth = (desc->width + 9) / 10;
    const int least = is_temporal && !has_reach ? (tenth < 32 ? tenth : 32) : reach;
    if (desc->tile == 0)
        desc->tile = least <= 8 ? 8 : least <= 16 ? 16 : least <= 32 ? 32 : 64;
    const int strips = (desc->width + STRIP - 1) / STRIP;
    if (desc->strip == 0 && is_temporal && strips > 0)
        desc->strip = (int16_t)(wide ? (desc->width + strips * desc->tile - 1) / (strips * desc->tile) * desc->tile : 128);
}

double presented_depth(const struct presented *presented, uint16_t code)
{
    double units = smear_depth_units(code);
    if (code == 0)
        return INFINITY;
    double distance_units =
        presented->orthographic
            ? presented->far_plane -
                  (presented->far_plane - presented->near_plane) * units / SMEAR_DEPTH_NEAR
            : presented->near_plane * SMEAR_DEPTH_NEAR / units;
    return (distance_units - presented->camera_back) / presented->world_scale;
}

/* ------------------------------------------------------------------ life */

struct presenter *presenter_new(struct scene *scene, struct failure *f)
{
    struct presenter *p = calloc(1, sizeof *p);
    if (p == NULL) {
        out_of_memory(f);
        return NULL;
    }
    p->scene = scene;
    return p;
}

void presenter_free(struct presenter *p)
{
    if (p == NULL)
        return;
    for (int i = 0; i < p->converted_count; i++)
        converted_free(&p->converted[i]);
    texture_store_free(&p->texture);
    for (int i = 0; i < p->slot_room; i++) {
        if (p->slot[i] == NULL)
            continue;
        for (int pose = 0; pose < POSES; pose++)
            free(p->slot[i]->position[pose]);
        free(p->slot[i]->normal);
        free(p->slot[i]);
    }
    for (int pose = 0; pose < POSES; pose++)
        scene_instant_free(p->scene, &p->instant[pose]);
    free(p->converted);
    free(p->plan);
    free(p->converted_of_draw);
    free(p->kept_exponent);
    free(p->slot);
    free(p->draw);
    free(p);
}
