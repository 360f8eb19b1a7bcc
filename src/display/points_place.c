/* SPDX-License-Identifier: MIT */
/* points_place.c - where points are seen during the exposure: see points.h.
 *
 * Positions become 15-bit steps from the eye, as many of them to a unit as the point's distance allows, which the rows of a
 * projection take as they take vertices. Between poses places are sums in clip space, as those of draws are. */
#include "display/points.h"

#include "base/fixmath.h"
#include "geometry/transform.h"

#if SMEAR_WITH_OVERLAY

/* What is the same for all points. */
struct lens {
    struct smear_projection projection[3];      /* of offsets from the eye, in one scale */
    const smear_transform *eye[3];
    const struct smear_instant *at[2];
    const struct smear_shot *shot;
    struct smear_viewport viewport;
    int poses;
    int32_t unit;               /* length of projection[0].m[0] / 2 */
    uint32_t pixel;             /* of a point at distance 1, in units: q16 */
    int depth_shift;            /* of projection[0] */
};

/* Where a point is at one end of its streak. */
struct end {
    struct smear_homogeneous h; /* times 2^(exponent - 8) in the projection's scale */
    struct smear_screen s;
};

/* ------------------------------------------------------------------ the lens */

static void make_pose(struct lens *l, int k, int32_t height)
{
    static const smear_transform identity = SMEAR_IDENTITY;
    static const smear_mesh unit = { .scale = 1 };
    const smear_camera *camera = &l->shot->camera[l->shot->camera_moves && !l->shot->cut ? k : 0];
    struct smear_view view;
    smear_transform at_eye = identity;
    for (int i = 0; i < 3; i++)
        at_eye.origin[i] = camera->pose.origin[i];
    smear_view_compose(&view, &at_eye, &unit, &camera->pose);
    smear_projection_make(&l->projection[k], &view, camera, height);
    l->eye[k] = &camera->pose;
}

static void make_lens(struct lens *l, const struct smear_rows *rows)
{
    static const int32_t one[3] = { 1 << 24, 1 << 24, 1 << 24 };
    l->viewport = (struct smear_viewport){ rows->window.width, rows->window.height };
    l->poses = 1;
    for (int k = 1; k < 3; k++)
        if ((l->at[0]->weight[k] | l->at[1]->weight[k]) != 0)
            l->poses = k + 1;
    for (int k = 0; k < l->poses; k++)
        make_pose(l, k, rows->window.height);
    smear_projection_weigh(l->projection, one, l->poses, 0, &l->shot->camera[0]);
    const int32_t *m = l->projection[0].m[0];
    const uint64_t square = (uint64_t)((int64_t)m[0] * m[0]) + (uint64_t)((int64_t)m[1] * m[1])
                          + (uint64_t)((int64_t)m[2] * m[2]);
    l->unit = (int32_t)(sqrt_floor_64(square) >> 1);
    l->depth_shift = l->projection[0].depth_shift;
    /* Pixels per unit at distance 1 are focal height / 2. */
    const uint32_t pixels = (uint32_t)max_i32(narrow_sat((int64_t)l->shot->camera[0].focal * l->viewport.height >> 17), 1);
    l->pixel = is_orthographic(&l->projection[0]) ? 0 : 65536u / pixels;
}

/* ------------------------------------------------------------------ poses of a point */

/* Finds where it is in each pose: its path is a line. */
static void find_poses(int32_t at[3][3], const struct lens *l, const smear_point *point)
{
    const struct smear_shot *shot = l->shot;
    for (int i = 0; i < 3; i++) {
        const int64_t now = point->now[i];
        int64_t step = now - point->before[i];
        if (SMEAR_WITH_SCALES && shot->object_scale != 256)
            step = step * (int32_t)shot->object_scale >> 8;
        if (shot->cut)
            step = 0;
        at[0][i] = point->now[i];
        for (int k = 1; k < l->poses; k++) {
            int64_t moved = k == 1 ? -step : step;
            if (shot_is_curved(shot))
                moved = step * (smear_shot_time(shot, k) >> 8) >> 16;
            at[k][i] = narrow_sat(now + moved);
        }
    }
}

/* Finds the point at the ends of its streak. Returns the exponent: steps from the eye are q16 units times 2^exponent. */
static int transform_ends(struct end end[2], const struct lens *l, const smear_point *point)
{
    int32_t at[3][3];
    uint32_t any = 1u << 10;
    find_poses(at, l, point);
    for (int k = 0; k < l->poses; k++)
        for (int i = 0; i < 3; i++) {
            at[k][i] = narrow_sat((int64_t)at[k][i] - l->eye[k]->origin[i]);
            any |= (uint32_t)(at[k][i] ^ at[k][i] >> 31);
        }
    const int exponent = 17 - count_leading_zeros(any);         /* below 2^15 */
    end[0].h = end[1].h = (struct smear_homogeneous){ 0, 0, 0, 0 };
    for (int k = 0; k < l->poses; k++) {
        int16_t v[3];
        struct smear_homogeneous h;
        for (int i = 0; i < 3; i++)
            v[i] = (int16_t)(exponent >= 0 ? at[k][i] >> exponent : shl_wrap(at[k][i], -exponent));
        transform_inline(&h, &l->projection[k], v);
        for (int e = 0; e < 2; e++) {
            const int32_t weight = l->at[e]->weight[k];
            if (weight == 0)
                continue;
            struct smear_homogeneous part = { mulh_i32(h.x, weight), mulh_i32(h.y, weight), mulh_i32(h.w, weight), 0 };
            part.distance = is_orthographic(&l->projection[0]) ? mulh_i32(h.distance, weight) : part.w;
            homogeneous_add(&end[e].h, &part);
        }
    }
    return exponent;
}

/* ------------------------------------------------------------------ the screen */

/* By a part (q30, at most one) of the way: between the two, however far apart they are. */
static int32_t go_towards(int32_t from, int32_t to, int32_t part)
{
    return (int32_t)(from + (((int64_t)to - from) * part >> 30));
}

/* Brings the end that lies before the near plane to it. Returns the part of the exposure that is left, q16. */
static uint32_t clip_near(struct end end[2], int32_t near)
{
    const bool hidden[2] = { end[0].h.distance < near, end[1].h.distance < near };
    if (!hidden[0] && !hidden[1])
        return 65536u;
    if (hidden[0] && hidden[1])
        return 0;
    struct smear_homogeneous *h = &end[hidden[0] ? 0 : 1].h;
    const struct smear_homogeneous *to = &end[hidden[0] ? 1 : 0].h;
    const int32_t part = ratio_q30((int64_t)near - h->distance, (int64_t)to->distance - h->distance);
    h->x = go_towards(h->x, to->x, part);
    h->y = go_towards(h->y, to->y, part);
    h->w = go_towards(h->w, to->w, part);
    h->distance = near;
    return 65536u - (uint32_t)(part >> 14);
}

/* Brings an end into the scale of the projection: an orthographic view is not the same in another. */
static void unscale(struct smear_homogeneous *h, int shift, const struct smear_projection *p)
{
    h->x = scale_sat(h->x, shift);
    h->y = scale_sat(h->y, shift);
    h->distance = scale_sat(h->distance, shift);
    h->w = p->m[2][3];
}

/* Returns the radius of a disc in pixels, q8, at a distance w of exponent - 8. */
static int32_t radius_of(const struct lens *l, int32_t size, int32_t w, int exponent)
{
    if (size == 0)
        return 0;
    const int up = count_leading_zeros((uint32_t)size) - 1, zeros = count_leading_zeros((uint32_t)w);
    const int32_t high = mulh_i32(mulh_i32(shl_wrap(size, up), l->unit), (int32_t)recip_norm((uint32_t)w << zeros));
    return min_i32(scale_sat(high, clamp_i32(zeros - up - 13 - exponent, -31, 31)), 64 << 8);
}

static uint16_t depth_code(int32_t units_q11)
{
    const uint32_t units = (uint32_t)units_q11 >> 11;
    return (uint16_t)(units < 32768u ? units : min_u32(32768u + ((units - 32768u) >> 4), 65535u));
}

/* Returns sqrt(x) for x < 2^31, relative error below 2^-8 and 1/2 step. */
static uint32_t rough_root(uint32_t x)
{
    int up = -3;
    for (; x >= 1u << 20; x >>= 2)
        up++;
    return up < 0 ? sqrt_q3(x) >> -up : sqrt_q3(x) << up;
}

/* A dot: its radius with a pixel's smoothness in it, q8; how much of it is 1/256 pixel, q21; the light of its middle, q16. */
struct dot {
    int32_t radius, per_radius;
    uint32_t light;
};

/* A disc of radius R has the light of (1 - (r / a)^2)^2 where a^2 = 3 R^2; 5/4 more make it smooth at any place. */
static struct dot dot_of(int32_t radius, uint32_t light)
{
    enum { SMOOTH = 5 << 14, LEAST = 128 };
    if (radius < LEAST) {
        light = light * (uint32_t)(radius * radius) >> 14;
        radius = LEAST;
    }
    const uint32_t square = 3u * (uint32_t)(radius * radius) + SMOOTH;     /* q16, below 2^30 */
    const int32_t a = (int32_t)rough_root(square), per_radius = ((1 << 21) + a / 2) / a;
    const uint32_t peak = 65536u - (uint32_t)(per_radius * per_radius * 5 >> 12);      /* 1 - 5/4 / a^2 */
    return (struct dot){ a, per_radius, (peak >> 1) * light >> 15 };
}

/* Finds the pixels that the streak may touch; false where none are in the frame. */
static bool find_box(smear_point_place *p, const struct end end[2], int32_t a, const struct smear_viewport *v)
{
    const int32_t x0 = min_i32(end[0].s.x, end[1].s.x) - a, x1 = max_i32(end[0].s.x, end[1].s.x) + a;
    const int32_t y0 = min_i32(end[0].s.y, end[1].s.y) - a, y1 = max_i32(end[0].s.y, end[1].s.y) + a;
    p->x0 = (int16_t)clamp_i32((x0 + 127) >> 8, 0, v->width);
    p->y0 = (int16_t)clamp_i32((y0 + 127) >> 8, 0, v->height);
    p->x1 = (int16_t)clamp_i32((x1 + 127) >> 8, 0, v->width);
    p->y1 = (int16_t)clamp_i32((y1 + 127) >> 8, 0, v->height);
    return p->x0 < p->x1 && p->y0 < p->y1;
}

/* Fills in the streak from one end to the other; false where nothing of it is seen. */
static bool make_streak(smear_point_place *p, const struct end end[2], const struct dot *dot, const struct smear_viewport *v)
{
    enum { LONGEST = 700 << 8 };
    const int32_t x = end[1].s.x - end[0].s.x, y = end[1].s.y - end[0].s.y, a = dot->radius;
    const int32_t most = max_i32(abs_i32(x), abs_i32(y));
    if (dot->light == 0 || most > LONGEST || !find_box(p, end, a, v))
        return false;
    const int down = most >= 1 << 15 ? 3 : most < 1 << 11 ? -4 : 0;
    const int32_t dx = down >= 0 ? x >> down : x * 16, dy = down >= 0 ? y >> down : y * 16;
    const uint32_t square = (uint32_t)(dx * dx) + (uint32_t)(dy * dy);
    const uint32_t rough = max_u32(rough_root(square), 1);
    const int32_t root = max_i32((int32_t)((rough + square / rough) >> 1), 1);          /* Heron's rule */
    const int32_t length = down >= 0 ? root << down : (root + 8) >> 4, scale = (dot->per_radius << 15) / root;
    p->x = end[0].s.x;
    p->y = end[0].s.y;
    p->along_x = (int16_t)((dx * scale + (1 << 14)) >> 15);
    p->along_y = (int16_t)((dy * scale + (1 << 14)) >> 15);
    p->length = (int32_t)((int64_t)length * dot->per_radius >> 8);
    p->gain = (uint32_t)a * dot->light / (uint32_t)max_i32(length, 1);
    if (p->length >= SMEAR_POINT_SHORT)
        return true;
    p->x += x >> 1;
    p->y += y >> 1;
    p->length = p->length * 9459 >> 15;         /* 1 / sqrt(12) */
    p->gain = dot->light;
    if (square == 0)
        p->along_x = (int16_t)dot->per_radius;
    return true;
}

/* Finds where a point is seen, and its streak there; false where it is not. */
static bool place(smear_point *point, struct lens *l)
{
    struct end end[2];
    struct smear_projection *p = &l->projection[0];
    int shift = transform_ends(end, l, point) - 8;
    if (is_orthographic(p)) {
        unscale(&end[0].h, shift, p);
        unscale(&end[1].h, shift, p);
        shift = 0;
    }
    const int32_t near = max_i32(scale_sat(p->near_distance, clamp_i32(-shift, -31, 31)), 1);
    const int32_t far = p->far_distance == INT32_MAX ? INT32_MAX : scale_sat(p->far_distance, clamp_i32(-shift, -31, 31));
    const uint32_t seen = clip_near(end, near);
    if (seen == 0 || (end[0].h.distance > far && end[1].h.distance > far))
        return false;
    const int32_t radius = radius_of(l, point->size, (end[0].h.w >> 1) + (end[1].h.w >> 1) + 1, shift + 8);
    const struct dot dot = dot_of(radius, (seen >> 1) * ((255u - point->fade) * 257u + (point->fade == 0)) >> 15);
    p->depth_shift = (int16_t)(l->depth_shift - (is_orthographic(p) ? 0 : shift));
    for (int e = 0; e < 2; e++) {
        const int32_t nearer = scale_sat(point->size, clamp_i32(p->distance_scale - 17, -31, 31));
        if (is_orthographic(p))
            end[e].h.distance = max_i32(sub_wrap(end[e].h.distance, nearer), near);
        end[e].h.w = max_i32(end[e].h.w, 1);
        smear_project(&end[e].s, p, &end[e].h, &l->viewport);
    }
    const int32_t middle = (end[0].s.depth >> 1) + (end[1].s.depth >> 1);
    const int64_t nearer = (int64_t)middle * (uint32_t)radius * l->pixel >> 24;
    point->place.depth = depth_code((int32_t)(nearer < SMEAR_DEPTH_MAX - middle ? middle + nearer : SMEAR_DEPTH_MAX));
    return make_streak(&point->place, end, &dot, &l->viewport);
}

void smear_points_place(const struct smear_rows *rows, const struct smear_shot *shot, const struct smear_instant *from,
                        const struct smear_instant *to)
{
    const smear_points *points = rows->overlay->points;
    struct lens lens = { .at = { from, to }, .shot = shot };
    if (points->count == 0)
        return;
    make_lens(&lens, rows);
    for (uint32_t i = 0; i < points->count; i++)
        if (!place(&points->point[i], &lens))
            points->point[i].place.y1 = INT16_MIN;
}

#endif
