/* SPDX-License-Identifier: MIT */
/* points_place.c - where points are seen during the exposure: see overlay.h.
 *
 * Positions become 15-bit steps from the eye, as many of them to a unit as the point's distance allows, which the rows of a
 * projection take as they take vertices. Between poses places are sums in clip space, as those of draws are. */
#include "overlay/overlay.h"

#include "base/fixmath.h"
#include "geometry/transform.h"

#if SMEAR_WITH_OVERLAY

/* An end of the exposure in clip space: rows of what is added up for an offset from the eye, q16, for the way that a point goes
 * in a frame, and of where eyes are that the pose of now has not. */
struct lens_end {
    int32_t offset[4][4], way[4][3]; /* the last is 0; ways: q2, as their sums are short */
    int64_t eyes[4];
};

/* What is the same for all points. */
struct lens {
    struct smear_projection projection; /* of offsets from the eye of now */
    struct lens_end end[2];
    const struct smear_shot *shot;
    struct smear_viewport viewport;
    int32_t eye[3];
    uint32_t apart;  /* eyes, at least by their highest bit */
    bool still;      /* they are one, in one direction */
    int shift;       /* rows for steps of 2^exponent are in the projection's scale times 2^-(shift + exponent) */
    int32_t unit;    /* length of projection.m[0] / 2 */
    uint32_t pixel;  /* of a point at distance 1, in units: q16 */
    int depth_shift; /* of the projection */
};

/* Where a point is at one end of its streak. */
struct end {
    struct smear_homogeneous h; /* times 2^exponent in the lens's scale */
    struct smear_screen s;
};

/* ------------------------------------------------------------------ the lens */

static const smear_camera *camera_of(const struct smear_shot *shot, int k)
{
    return &shot->camera[shot->camera_moves && !shot->cut ? k : 0];
}

static void make_pose(struct smear_projection *p, const smear_camera *camera, int32_t height)
{
    static const smear_transform identity = SMEAR_IDENTITY;
    static const smear_mesh unit = { .scale = 1 };
    struct smear_view view;
    smear_transform at_eye = identity;
    for (int i = 0; i < 3; i++)
        at_eye.origin[i] = camera->pose.origin[i];
    smear_view_compose(&view, &at_eye, &unit, &camera->pose);
    smear_projection_make(p, &view, camera, height, 0);
}

/* Returns how far a point is on its way in a pose, q16 frames. */
static int32_t way_at(const struct smear_shot *shot, int k)
{
    if (k != 0 && shot_is_curved(shot))
        return smear_shot_time(shot, k) >> 8;
    return k == 0 ? 0 : k == 1 ? -65536
                               : 65536;
}

/* What poses add to the rows, q24: of offsets and of ways. */
struct sums {
    int64_t offset[4][3], way[4][3];
};

static uint64_t make_sums(struct sums *sum, const struct smear_projection pose[], const int32_t weight[], const struct smear_shot *shot,
                          int poses)
{
    uint64_t any = 0;
    for (int r = 0; r < 4; r++)
        for (int j = 0; j < 3; j++) {
            int64_t offset = 0, way = 0;
            for (int k = 0; k < poses; k++) {
                const int64_t term = r == 3 && !is_orthographic(&pose[0]) ? 0 : mul_wide(pose[k].m[r][j], weight[k]);
                offset += term;
                way += (term >> 16) * way_at(shot, k);
            }
            sum->offset[r][j] = offset;
            sum->way[r][j] = way;
            any |= (uint64_t)(offset ^ offset >> 63) | (uint64_t)(way ^ way >> 63);
        }
    return any;
}

/* Brings the sums of an end to 28 bits, of which cores without a wide product leave out the last two. */
static void make_end(struct lens_end *end, const struct sums *sum, const struct smear_projection pose[], const int32_t weight[],
                     const struct smear_shot *shot, int poses, int down)
{
    const int64_t most = 1 << 29;
    for (int r = 0; r < 4; r++) {
        end->eyes[r] = end->offset[r][3] = 0;
        for (int j = 0; j < 3; j++) {
            end->offset[r][j] = (int32_t)(sum->offset[r][j] >> down) & ~3;
            end->way[r][j] = (int32_t)(sum->way[r][j] >> down) >> 14;
            for (int k = 1; k < poses && (r < 3 || is_orthographic(&pose[0])); k++) {
                const int64_t apart = (int64_t)camera_of(shot, 0)->pose.origin[j] - camera_of(shot, k)->pose.origin[j];
                const int64_t row = mul_wide(pose[k].m[r][j], weight[k]) >> down >> 4;
                end->eyes[r] += (row < -most ? -most : row > most ? most
                                                                  : row)
                                  * apart
                             >> 12;
            }
        }
    }
}

static void make_lens(struct lens *l, const struct smear_rows *rows, const struct smear_instant *const at[2])
{
    static const int32_t one[3] = { 1 << 24, 1 << 24, 1 << 24 };
    const smear_camera *now = camera_of(l->shot, 0);
    struct smear_projection pose[3];
    struct sums sum[2];
    int poses = 1;
    l->viewport = (struct smear_viewport){ rows->window.width, rows->window.height };
    for (int k = 1; k < 3; k++)
        if ((at[0]->weight[k] | at[1]->weight[k]) != 0)
            poses = k + 1;
    l->still = !l->shot->camera_moves || l->shot->cut;
    l->apart = 0;
    for (int k = 0; k < poses; k++) {
        const int32_t *eye = camera_of(l->shot, k)->pose.origin;
        make_pose(&pose[k], camera_of(l->shot, k), rows->window.height);
        for (int j = 0; j < 3; j++) {
            const int32_t apart = narrow_sat((int64_t)now->pose.origin[j] - eye[j]);
            l->apart |= (uint32_t)(apart ^ apart >> 31);
            l->eye[j] = now->pose.origin[j];
        }
    }
    struct smear_projection *const out[3] = { &pose[0], &pose[1], &pose[2] };
    const struct smear_projection *const in[3] = { &pose[0], &pose[1], &pose[2] };
    smear_projection_weigh(out, in, one, poses, now);
    l->projection = pose[0];
    uint64_t any = 1u << 28;
    for (int e = 0; e < 2; e++)
        any |= make_sums(&sum[e], pose, at[e]->weight, l->shot, poses);
    const int down = 36 - count_leading_zeros_64(any);
    for (int e = 0; e < 2; e++)
        make_end(&l->end[e], &sum[e], pose, at[e]->weight, l->shot, poses, down);
    l->shift = down - 40;
    const int32_t *m = l->projection.m[0];
    l->unit = (int32_t)(sqrt_floor_64((uint64_t)dot_wide(m, 1, m, 1)) >> 1);
    l->depth_shift = l->projection.depths.depth_shift;
    /* Pixels per unit at distance 1 are focal height / 2. */
    const uint32_t pixels = (uint32_t)max_i32(narrow_sat(mul_wide(l->shot->camera[0].focal, l->viewport.height) >> 17), 1);
    l->pixel = is_orthographic(&l->projection) ? 0 : 65536u / pixels;
}

/* ------------------------------------------------------------------ ends of a streak */

/* Returns a - b, saturated. */
static inline int32_t difference(int32_t a, int32_t b)
{
    const int32_t d = sub_wrap(a, b);
    return ((a ^ b) & (a ^ d)) >= 0 ? d : a < 0 ? INT32_MIN
                                                : INT32_MAX;
}

static inline uint32_t bits_of(int32_t a) { return (uint32_t)(a ^ a >> 31); }

static inline int16_t in_steps(int32_t a, int exponent)
{
    return (int16_t)(exponent >= 0 ? a >> exponent : shl_wrap(a, -exponent));
}

/* Returns a row's sum for three of 15 bits. Its factors have 14, so that it takes three products. */
static inline int32_t way_row(const int32_t m[3], const int16_t w[3])
{
    return (w[0] * m[0] + w[1] * m[1] + w[2] * m[2]) >> 2;
}

static int32_t eyes_of(const struct lens_end *end, int r, int exponent)
{
    return narrow_sat(exponent >= 0 ? end->eyes[r] >> exponent : end->eyes[r] * (1 << -exponent));
}

/* Finds the point at the ends of its streak. Returns the exponent: steps from the eye are q16 units times 2^exponent. */
static int transform_ends(struct end end[2], const struct lens *l, const smear_point *point)
{
    int32_t offset[3], way[3];
    int16_t v[3], w[3];
    uint32_t any = 1u << 10 | l->apart;
    for (int i = 0; i < 3; i++) {
        offset[i] = difference(point->now[i], l->eye[i]);
        way[i] = l->shot->cut ? 0 : difference(point->now[i], point->before[i]);
        if (SMEAR_WITH_SCALES && l->shot->object_scale != 256)
            way[i] = narrow_sat(mul_wide(way[i], (int32_t)l->shot->object_scale) >> 8);
        any |= bits_of(offset[i]) | bits_of(way[i]);
    }
    const int exponent = 17 - count_leading_zeros(any); /* below 2^15 */
    for (int i = 0; i < 3; i++) {
        v[i] = in_steps(offset[i], exponent);
        w[i] = in_steps(way[i], exponent);
    }
    const int rows = is_orthographic(&l->projection) ? 4 : 3;
    int32_t row[2][4];
    for (int r = 0; r < rows; r++) {
        const int32_t from_eye = transform_row(l->end[0].offset[r], v, 0);
        row[0][r] = from_eye + way_row(l->end[0].way[r], w);
        row[1][r] = (l->still ? from_eye : transform_row(l->end[1].offset[r], v, 0)) + way_row(l->end[1].way[r], w);
        for (int e = 0; e < 2 && !l->still; e++)
            row[e][r] = narrow_sat((int64_t)row[e][r] + eyes_of(&l->end[e], r, exponent));
    }
    for (int e = 0; e < 2; e++)
        end[e].h = (struct smear_homogeneous){ row[e][0], row[e][1], row[e][2], row[e][rows - 1] };
    return exponent;
}

/* ------------------------------------------------------------------ the screen */

/* By a part (q30, at most one) of the way: between the two, however far apart they are. */
static SMEAR_PRODUCT_CALL int32_t go_towards(int32_t from, int32_t to, int32_t part)
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
    h->x = scale_sat(h->x, clamp_i32(shift, -31, 31));
    h->y = scale_sat(h->y, clamp_i32(shift, -31, 31));
    h->distance = scale_sat(h->distance, clamp_i32(shift, -31, 31));
    h->w = p->m[2][3];
}

/* Returns the radius of a disc in pixels, q8, where 1 / distance is recip 2^(zeros - 61), of exponent - 8. */
static int32_t radius_of(const struct lens *l, int32_t size, int32_t recip, int zeros, int exponent)
{
    if (size == 0)
        return 0;
    const int up = count_leading_zeros((uint32_t)size) - 1;
    const int32_t high = mulh_i32(mulh_i32(shl_wrap(size, up), l->unit), recip);
    return min_i32(scale_sat(high, clamp_i32(zeros - up - 13 - exponent, -31, 31)), 64 << 8);
}

/* Puts the ends of a streak on the screen. Returns the mean of 1 / distance: the result 2^(zeros - 61). */
static int32_t project_ends(struct end end[2], const struct lens *l, int *zeros)
{
    int digits[2];
    uint32_t recip[2];
    for (int e = 0; e < 2; e++) {
        struct smear_homogeneous *h = &end[e].h;
        h->w = max_i32(h->w, 1);
        digits[e] = count_leading_zeros((uint32_t)h->w);
        recip[e] = recip_norm((uint32_t)h->w << digits[e]);
        const int down = 21 - digits[e];
        if (down <= 0 || is_orthographic(&l->projection)) {
            smear_project(&end[e].s, &l->projection.depths, h, &l->viewport);
            continue;
        }
        const int32_t half = 1 << (down - 1);
        end[e].s.x = (l->viewport.width << 7) + ((mulh_i32(h->x, (int32_t)recip[e]) + half) >> down);
        end[e].s.y = (l->viewport.height << 7) + ((mulh_i32(h->y, (int32_t)recip[e]) + half) >> down);
    }
    *zeros = max_i32(digits[0], digits[1]);
    return (int32_t)(((recip[0] >> (*zeros - digits[0])) + (recip[1] >> (*zeros - digits[1]))) >> 1);
}

/* Returns the depth in the middle of a streak whose mean of 1 / distance is given. */
static int32_t middle_depth(const struct end end[2], const struct smear_depths *d, int32_t recip, int zeros)
{
    if (depths_are_even(d))
        return (end[0].s.depth >> 1) + (end[1].s.depth >> 1);
    const int32_t depth = scale_sat(mulh_i32(d->depth_mantissa, recip), clamp_i32(d->depth_shift + zeros, -31, 31));
    return clamp_i32(depth, SMEAR_DEPTH_MIN, SMEAR_DEPTH_MAX);
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
    enum { SMOOTH = 5 << 14,
           LEAST = 128 };
    if (radius < LEAST) {
        light = light * (uint32_t)(radius * radius) >> 14;
        radius = LEAST;
    }
    const uint32_t square = 3u * (uint32_t)(radius * radius) + SMOOTH; /* q16, below 2^30 */
    const int32_t a = (int32_t)rough_root(square);                     /* 361 .. 28400 */
    const int zeros = count_leading_zeros((uint32_t)a);
    const int32_t per_radius = (int32_t)((recip_norm((uint32_t)a << zeros) + (1u << (39 - zeros))) >> (40 - zeros));
    const uint32_t peak = 65536u - (uint32_t)(per_radius * per_radius * 5 >> 12); /* 1 - 5/4 / a^2 */
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
    const int down = most >= 1 << 15 ? 3 : most < 1 << 11 ? -4
                                                          : 0;
    const int32_t dx = down >= 0 ? x >> down : x * 16, dy = down >= 0 ? y >> down : y * 16;
    const uint32_t square = (uint32_t)(dx * dx) + (uint32_t)(dy * dy);
    const uint32_t rough = max_u32(rough_root(square), 1);
    const int rough_zeros = count_leading_zeros(rough); /* Heron's rule; of less than 8 the root is its own */
    const uint32_t over = rough_zeros > 28 ? rough : mulh_u32(square, recip_norm(rough << rough_zeros)) >> (29 - rough_zeros);
    const uint32_t root = max_u32((rough + over) >> 1, 1);
    const int zeros = count_leading_zeros(root);
    const uint32_t recip = recip_norm(root << zeros); /* 1 / root = recip 2^(zeros - 61) */
    const int32_t length = (int32_t)(down >= 0 ? root << down : (root + 8) >> 4);
    const int32_t scale = (int32_t)(((uint32_t)dot->per_radius * (recip >> 13)) >> (33 - zeros));
    p->x = end[0].s.x + (x >> 1);
    p->y = end[0].s.y + (y >> 1);
    p->along_x = (int16_t)((dx * scale + (1 << 14)) >> 15);
    p->along_y = (int16_t)((dy * scale + (1 << 14)) >> 15);
    p->length = length * dot->per_radius >> 9;
    if (p->length >= SMEAR_POINT_SHORT) { /* of 15/16 of the light */
        p->gain = mulh_u32((uint32_t)a * (dot->light + (dot->light >> 4) + (dot->light >> 8)), recip) >> (29 - zeros + down);
        return true;
    }
    p->length = p->length * 18919 >> 15; /* 1 / sqrt(3) */
    p->gain = dot->light;
    if (square == 0)
        p->along_x = (int16_t)dot->per_radius;
    return true;
}

/* Finds where a point is seen, and its streak there; false where it is not. */
static bool place(smear_point *point, struct lens *l)
{
    struct end end[2];
    struct smear_projection *p = &l->projection;
    int shift = transform_ends(end, l, point) + l->shift;
    if (is_orthographic(p)) {
        unscale(&end[0].h, shift, p);
        unscale(&end[1].h, shift, p);
        shift = 0;
    }
    const int32_t near = max_i32(scale_sat(p->depths.near_distance, clamp_i32(-shift, -31, 31)), 1);
    const int32_t far = p->depths.far_distance == INT32_MAX ? INT32_MAX : scale_sat(p->depths.far_distance, clamp_i32(-shift, -31, 31));
    const uint32_t seen = clip_near(end, near);
    if (seen == 0 || (end[0].h.distance > far && end[1].h.distance > far))
        return false;
    p->depths.depth_shift = (int16_t)(l->depth_shift - (is_orthographic(p) ? 0 : shift));
    if (is_orthographic(p)) {
        const int32_t nearer = scale_sat(point->size, clamp_i32(p->distance_scale - 17, -31, 31));
        for (int e = 0; e < 2; e++)
            end[e].h.distance = max_i32(sub_wrap(end[e].h.distance, nearer), near);
    }
    int zeros;
    const int32_t recip = project_ends(end, l, &zeros), radius = radius_of(l, point->size, recip, zeros, shift + 8);
    const struct dot dot = dot_of(radius, (seen >> 1) * ((255u - point->fade) * 257u + (point->fade == 0)) >> 15);
    const int32_t middle = middle_depth(end, &p->depths, recip, zeros);
    const uint32_t nearer = mulh_u32((uint32_t)middle << 4, (uint32_t)radius * l->pixel << 2), /* in 4 steps */
        room = (uint32_t)(SMEAR_DEPTH_MAX - middle);
    point->place.depth = depth_code_of((uint32_t)(nearer < room >> 2 ? middle + (int32_t)(nearer << 2) : SMEAR_DEPTH_MAX) >> 11);
    return make_streak(&point->place, end, &dot, &l->viewport);
}

void smear_points_place(const struct smear_rows *rows, const struct smear_shot *shot, const struct smear_instant *from,
                        const struct smear_instant *to)
{
    const smear_points *points = rows->overlay->points;
    const struct smear_instant *const at[2] = { from, to };
    struct lens lens;
    if (points->count == 0)
        return;
    lens.shot = shot;
    make_lens(&lens, rows, at);
    for (uint32_t i = 0; i < points->count; i++)
        if (!place(&points->point[i], &lens))
            points->point[i].place.y1 = INT16_MIN;
}

#endif
