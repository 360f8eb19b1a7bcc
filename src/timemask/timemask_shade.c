/* SPDX-License-Identifier: MIT */
/* timemask_shade.c - planes in time of a moving triangle's attributes, and colours from them. */
#include "timemask/timemask_cover.h"

#include "base/pixel.h"
#include "raster/fog.h"

enum {
    MOST_SLOPE = 1 << 20,
    STEEP = 1 << 28,            /* a plane so steep has no exact pixels, its triangle is a sliver */
    LEVEL_LOG2 = 8,             /* triangles whose depths differ by less than 2^-8 have one depth at a time */
    TURN_LOG2 = 8,              /* slopes are taken to stay where depths along
                                 * edges change by less than 2^-7 */
    COLOR_OFF = 64, TEXEL_OFF = 16,     /* 1/64 code, texel: what perspective may matter and be left out */
    TAPS_MAX = 8
};

/* ------------------------------------------------------------------ slopes */

/* What turns differences along the edges from vertex 0 into slopes: the edges' parts over the area, times 2^shift. */
struct shape {
    int32_t x1, y1, x2, y2;
    int shift;
};

/* The slopes of a plane through values at the vertices, per pixel; 0 where they would be too steep to have exact
 * pixels. */
struct slopes {
    int32_t dx, dy;
    int64_t fine_dx, fine_dy;   /* with `fine` more bits */
    int fine;
};

/* From so many q8 px on, as corners at the guard band are, slopes of whole steps would add up to many of them. */
enum { FINE_LOG2 = 10, FAR_OFF = 256 << 8 };

/* False when the triangle has no area. */
static bool shape_make(struct shape *s, const struct timemask_pose *p)
{
    int32_t x1 = p->x[1] - p->x[0], y1 = p->y[1] - p->y[0], x2 = p->x[2] - p->x[0], y2 = p->y[2] - p->y[0];
    int64_t area = cross_wide(x1, y1, x2, y2);
    if (area == 0)
        return false;
    uint64_t size = (uint64_t)(area < 0 ? -area : area);
    int zeros = count_leading_zeros_64(size);
    /* 1 / size = r 2^(zeros - 93) */
    int32_t r = (int32_t)recip_norm_precise((uint32_t)(size << zeros >> 32));
    if (area < 0)
        r = -r;
    uint32_t longest = (uint32_t)abs_i32(x1) | (uint32_t)abs_i32(y1) | (uint32_t)abs_i32(x2)
                     | (uint32_t)abs_i32(y2);
    int down = 31 - count_leading_zeros(longest);
    s->x1 = (int32_t)(mul_wide(x1, r) >> down);
    s->y1 = (int32_t)(mul_wide(y1, r) >> down);
    s->x2 = (int32_t)(mul_wide(x2, r) >> down);
    s->y2 = (int32_t)(mul_wide(y2, r) >> down);
    s->shift = clamp_i32(93 - 8 - zeros - down, 0, 63);
    return true;
}

static struct slopes slopes_of(const struct shape *s, const int32_t a[3])
{
    int32_t d1 = sub_wrap(a[1], a[0]), d2 = sub_wrap(a[2], a[0]);
    const int fine = min_i32(s->shift, FINE_LOG2);
    const int64_t fine_dx = cross_wide(d1, d2, s->y1, s->y2) >> (s->shift - fine);
    const int64_t fine_dy = cross_wide(d2, d1, s->x2, s->x1) >> (s->shift - fine);
    const int64_t dx = fine_dx >> fine, dy = fine_dy >> fine;
    if (dx > STEEP || dx < -STEEP || dy > STEEP || dy < -STEEP)
        return (struct slopes){ 0, 0, 0, 0, 0 };
    return (struct slopes){ (int32_t)dx, (int32_t)dy, fine_dx, fine_dy, fine };
}

/* Returns the value at the point that attributes go with. */
static inline int32_t point_of(const int32_t a[3])
{
    return (int32_t)(((int64_t)a[0] + a[0] + a[1] + a[2]) >> 2);
}

/* ------------------------------------------------------------------ planes in time */

/* How a triangle goes through a segment. */
struct course {
    bool started;
    bool turns;                 /* its shape is another one at the end */
    struct shape shape, start, end;         /* in the middle; where it turns also at both ends */
    int32_t x, y, x_change, y_change;       /* the point that attributes go with: q8 px from
                                             * the block's first centre */
};

/* Whether slopes change so much between two poses that it matters: edges by more than 1/8 of the longest (or,
 * where texels or colours go with the surface, by more than 1/4 px: elsewhere in a large triangle so much is
 * all there is of its motion), or depths along them by more than a part of depth. */
static bool shape_turns(const struct timemask_pose *a, const struct timemask_pose *b, bool has_one_color)
{
    int32_t change = 0, deeper = 0, size = 0;
    for (int i = 1; i < 3; i++) {
        int32_t ex = a->x[i] - a->x[0], ey = a->y[i] - a->y[0], ez = a->depth[i] - a->depth[0];
        int32_t fx = b->x[i] - b->x[0], fy = b->y[i] - b->y[0], fz = b->depth[i] - b->depth[0];
        size = max_i32(size, max_i32(abs_i32(ex), abs_i32(ey)));
        change = max_i32(change, max_i32(abs_i32(fx - ex), abs_i32(fy - ey)));
        deeper = max_i32(deeper, abs_i32((fz >> 1) - (ez >> 1)));
    }
    return change > (has_one_color ? size >> 3 : 64) || deeper > a->depth[0] >> TURN_LOG2;
}

static void course_start(struct course *c, const struct timemask_pose *const pose[3], bool has_one_color)
{
    c->started = true;
    bool seen = shape_make(&c->shape, pose[1]);
    c->turns = !seen || shape_turns(pose[0], pose[2], has_one_color);
    if (c->turns) {     /* where it is seen from its edge, slopes are those of another time */
        bool at_start = shape_make(&c->start, pose[0]),
             at_end = shape_make(&c->end, pose[2]);
        if (!seen)
            c->shape = at_start ? c->start : c->end;
        if (!at_start)
            c->start = c->shape;
        if (!at_end)
            c->end = c->shape;
    }
    c->x = point_of(pose[1]->x);
    c->y = point_of(pose[1]->y);
    c->x_change = point_of(pose[2]->x) - point_of(pose[0]->x);
    c->y_change = point_of(pose[2]->y) - point_of(pose[0]->y);
}

/* |change| + |curve| all over the block. */
static int64_t change_size(int64_t change, int32_t dx, int32_t dy, int64_t curve)
{
    int64_t corner = mul_wide(abs_i32(dx), TIMEMASK_WIDTH) + mul_wide(abs_i32(dy), TIMEMASK_HEIGHT);
    return (change < 0 ? -change : change) + corner + (curve < 0 ? -curve : curve);
}

static int64_t dot2(int32_t ax, int32_t ay, int32_t bx, int32_t by) { return mul_wide(ax, bx) + mul_wide(ay, by); }

/* From values at the three vertices at the start, in the middle and at the end. The attribute is a plane with
 * the value v of a point at c and slopes g around it; all three change with time:
 *
 *     v + v' t + (g + g' t) (x - c - c' t) = v + g (x - c) + t (v' - g c' + g' (x - c)) - t^2 g' c'
 *
 * A plane that changes by more than there are bits for becomes one value. */
static void timed_make(struct timemask_timed *t, const struct course *c, const int32_t *const value[3])
{
    struct slopes g = slopes_of(&c->shape, value[1]);
    int32_t v = point_of(value[1]);
    int64_t v_change = (int64_t)point_of(value[2]) - point_of(value[0]);
    int64_t at = v - (dot2(g.dx, g.dy, c->x, c->y) >> 8);
    if (abs_i32(c->x) >= FAR_OFF || abs_i32(c->y) >= FAR_OFF)
        at = v - ((g.fine_dx * c->x + g.fine_dy * c->y) >> (8 + g.fine));
    int64_t change = v_change - (dot2(g.dx, g.dy, c->x_change, c->y_change) >> 8), curve = 0;
    t->change_dx = t->change_dy = 0;
    if (c->turns) {
        struct slopes start = slopes_of(&c->start, value[0]),
                      end = slopes_of(&c->end, value[2]);
        t->change_dx = end.dx - start.dx;
        t->change_dy = end.dy - start.dy;
        change -= dot2(t->change_dx, t->change_dy, c->x, c->y) >> 8;
        curve = -(dot2(t->change_dx, t->change_dy, c->x_change, c->y_change) >> 8);
    }
    t->dx = g.dx;
    t->dy = g.dy;
    if (change_size(change, t->change_dx, t->change_dy, curve) >= INT32_MAX) {
        at = v;
        change = curve = 0;
        t->dx = t->dy = t->change_dx = t->change_dy = 0;
    }
    t->at = (int32_t)(uint32_t)(uint64_t)at;
    t->change = (int32_t)change;
    t->curve = (int32_t)curve;
}

static inline int32_t least_of(const int32_t a[3]) { return min_i32(a[0], min_i32(a[1], a[2])); }
static inline int32_t most_of(const int32_t a[3]) { return max_i32(a[0], max_i32(a[1], a[2])); }
static inline uint32_t spread(const int32_t a[3]) { return (uint32_t)most_of(a) - (uint32_t)least_of(a); }

/* ------------------------------------------------------------------ values over w */

/* Whether interpolation on the screen is off by more than `off`; both in 1/64 of what counts. */
static bool needs_w(const struct timemask_pose *const pose[3], uint32_t range, uint32_t off)
{
    for (int k = 0; k < 3; k += 2) {
        int32_t low = least_of(pose[k]->depth);
        if (smear_times_over(spread(pose[k]->depth), range, (uint32_t)low) >> 2 > off)
            return true;
    }
    return false;
}

/* 1/w at all poses, scaled. */
struct over_w {
    int32_t q[3][3];
};

static void over_w_make(struct timemask_shade *s, struct over_w *w, const struct course *c,
                        const struct timemask_pose *const pose[3])
{
    int32_t high = max_i32(most_of(pose[0]->depth),
                           max_i32(most_of(pose[1]->depth), most_of(pose[2]->depth)));
    int up = count_leading_zeros((uint32_t)high) - 6;       /* room for changes */
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < 3; i++)
            w->q[k][i] = up >= 0 ? pose[k]->depth[i] << up : pose[k]->depth[i] >> -up;
    const int32_t *value[3] = { w->q[0], w->q[1], w->q[2] };
    timed_make(&s->q, c, value);
}

/* An attribute that stays with the vertices; over w when that is given. */
static void attribute_make(struct timemask_timed *t, const struct course *c, const struct over_w *w,
                           const int32_t a[3])
{
    int32_t over[3][3];
    const int32_t *value[3] = { a, a, a };
    for (int k = 0; k < 3 && w != NULL; k++) {
        for (int i = 0; i < 3; i++)
            over[k][i] = times_q15(a[i], w->q[k][i]);
        value[k] = over[k];
    }
    timed_make(t, c, value);
}

/* ------------------------------------------------------------------ set-up */

static void shade_depth(struct timemask_shade *s, struct course *c, const struct timemask_pose *const pose[3],
                        const struct timemask_cover *cover, bool has_one_color)
{
    int32_t depth[3][3];
    s->depth_low = INT32_MAX;
    s->depth_high = INT32_MIN;
    for (int k = 0; k < 3; k++) {
        for (int i = 0; i < 3; i++)
            depth[k][i] = pose[k]->depth[i] >> 7;
        s->depth_low = min_i32(s->depth_low, least_of(depth[k]));
        s->depth_high = max_i32(s->depth_high, most_of(depth[k]));
    }
    if (s->depth_high - s->depth_low <= s->depth_high >> LEVEL_LOG2) {
        s->depth = (struct timemask_timed){ .at = point_of(depth[1]),
                                            .change = point_of(depth[2]) - point_of(depth[0]) };
    } else {
        const int32_t *value[3] = { depth[0], depth[1], depth[2] };
        course_start(c, pose, has_one_color);
        timed_make(&s->depth, c, value);
    }
    int32_t change = s->depth.change + s->depth.change_dx * cover->middle_x
                   + s->depth.change_dy * cover->middle_y;
    s->slope = clamp_i32(change >> s->samples_log2, -MOST_SLOPE, MOST_SLOPE);
}

/* Channels of the vertices, q16 (see channel_value in setup.h). */
struct channels {
    int32_t value[3][3];
};

static void channels_read(struct channels *out, const struct smear_segment *g, const int32_t *const record[3],
                          smear_transfer transfer)
{
    for (int i = 0; i < 3; i++)
        for (int c = 0; c < 3; c++) {
            uint32_t word = (uint32_t)record[i][g->color + (c >> 1)];
            out->value[c][i] = channel_of_vertex(c & 1 ? word >> 16 : word & 0xffffu, transfer);
        }
}

static void shade_channels(struct timemask_shade *s, const struct course *c, const struct over_w *w,
                           struct channels *k)
{
    for (int i = 0; i < 3; i++) {
        int32_t *value = k->value[i];
        s->channel_low[i] = least_of(value);
        s->channel_high[i] = most_of(value);
        for (int n = 0; n < 3 && w != NULL; n++)
            value[n] >>= 8;
        attribute_make(&s->channel[i], c, w, value);
    }
}

static void shade_gouraud(struct timemask_shade *s, const struct course *c,
                          const struct timemask_pose *const pose[3], const int32_t *const record[3])
{
    struct channels k;
    struct over_w w;
    channels_read(&k, s->segment, record, frame_transfer(s->frame));
    uint32_t range = max_u32(spread(k.value[0]), max_u32(spread(k.value[1]), spread(k.value[2]))) >> 10;
    s->over_w = !s->segment->flat_depth && needs_w(pose, range, COLOR_OFF);
    if (s->over_w)
        over_w_make(s, &w, c, pose);
    shade_channels(s, c, s->over_w ? &w : NULL, &k);
}

static void shade_texture(struct timemask_shade *s, const struct course *c,
                          const struct timemask_pose *const pose[3], const int32_t *const record[3])
{
    const struct smear_sampler *m = s->sampler;
    struct channels k;
    struct over_w w;
    int32_t u[3], v[3];
    for (int i = 0; i < 3; i++) {       /* mesh units */
        u[i] = (int16_t)(record[i][s->segment->uv] & 0xffff);
        v[i] = record[i][s->segment->uv] >> 16;
    }
    uint32_t range = max_u32(magnitude_i32(smear_sampler_texel(m, 0, (int32_t)spread(u) * 16384) >> 10),
                             magnitude_i32(smear_sampler_texel(m, 1, (int32_t)spread(v) * 16384) >> 10));
    s->over_w = !s->segment->flat_depth && needs_w(pose, range, TEXEL_OFF);
    if (s->over_w)
        over_w_make(s, &w, c, pose);
    if (s->gouraud) {
        channels_read(&k, s->segment, record, frame_transfer(s->frame));
        shade_channels(s, c, s->over_w ? &w : NULL, &k);
    }
    s->turns_shift = (int8_t)(!m->turns ? 0 : (s->over_w ? 20 : 18) - m->uv_shift);
    for (int i = 0; i < 3 && !s->over_w; i++) {
        u[i] = m->turns ? u[i] * 16384 : smear_sampler_texel(m, 0, u[i] * 16384);
        v[i] = m->turns ? v[i] * 16384 : smear_sampler_texel(m, 1, v[i] * 16384);
    }
    attribute_make(&s->u, c, s->over_w ? &w : NULL, u);
    attribute_make(&s->v, c, s->over_w ? &w : NULL, v);
    s->travel = 0;
    for (int i = 0; i < 3; i++) {
        int32_t dx = abs_i32(pose[2]->x[i] - pose[0]->x[i]), dy = abs_i32(pose[2]->y[i] - pose[0]->y[i]);
        s->travel = max_i32(s->travel, max_i32(dx, dy) + (min_i32(dx, dy) >> 1));
    }
}

/* Finds out whether there is fog between the depths of the poses; one colour, and so much of it, become another one. */
static bool is_in_fog(struct timemask_shade *s, const struct timemask_pose *const pose[3], bool has_one_color)
{
    int32_t low = INT32_MAX, high = 0;
    for (int k = 0; k < 3; k++) {
        low = min_i32(low, least_of(pose[k]->depth));
        high = max_i32(high, most_of(pose[k]->depth));
    }
    const int32_t part = smear_fog_between(s->frame, low, high, has_one_color ? &s->color : NULL);
    if (part >= 0 && has_one_color) {
        s->color = fog_pixel(s->frame, s->color, part);
        return false;
    }
    return part != 0;
}

void smear_timemask_shade(struct timemask_shade *s, const struct smear_raster_frame *frame,
                          const struct smear_segment *segment, uint32_t color, bool is_flat,
                          const int32_t *const record[3], const struct timemask_pose *const pose[3],
                          const struct timemask_cover *cover, int32_t tap)
{
    struct course course;
    course.started = false;
    s->frame = frame;
    s->segment = segment;
    s->samples_log2 = cover->samples_log2;
    s->tap = tap;
    s->color = color & 0xffffffu;
    s->sampler = segment_textured(segment) ? &frame->draw[segment->draw].sampler : NULL;
    s->gouraud = segment_gouraud(segment) && !is_flat;
    const bool has_one_color = !s->gouraud && s->sampler == NULL;
    s->in_fog = SMEAR_WITH_FOG && frame_has_fog(frame) && is_in_fog(s, pose, has_one_color);
    shade_depth(s, &course, pose, cover, has_one_color);
    if (has_one_color)
        return;
    if (!course.started)
        course_start(&course, pose, false);
    if (SMEAR_WITH_TEXTURE && s->sampler != NULL)
        shade_texture(s, &course, pose, record);
    else
        shade_gouraud(s, &course, pose, record);
}

/* ------------------------------------------------------------------ colours */

/* w at a time: 1/q = recip 2^(zeros - 61). */
struct quotient {
    int zeros;
    int32_t recip;
};

static struct quotient quotient_at(const struct timemask_shade *s, int32_t x, int32_t y, int32_t time)
{
    uint32_t q = (uint32_t)max_i32(timemask_value(&s->q, x, y, time), 1 << 11);
    int zeros = count_leading_zeros(q);
    return (struct quotient){ zeros, (int32_t)recip_norm(q << zeros) };
}

/* a / q, q27. */
static int32_t quotient_of(const struct quotient *w, int32_t a)
{
    return mulh_i32(shl_wrap(a >> 1, w->zeros - 1), w->recip);
}

static void channels_at(const struct timemask_shade *s, int32_t x, int32_t y, int32_t time, int32_t out[3])
{
    for (int c = 0; c < 3; c++)
        out[c] = timemask_value(&s->channel[c], x, y, time);
    if (s->over_w) {
        struct quotient w = quotient_at(s, x, y, time);
        for (int c = 0; c < 3; c++)
            out[c] = quotient_of(&w, out[c]) >> 4;
    }
    for (int c = 0; c < 3; c++)
        out[c] = clamp_i32(out[c], s->channel_low[c], s->channel_high[c]);
}

/* Coordinates in turns or texels q16, as samplers take them. */
static void texel_at(const struct timemask_shade *s, int32_t x, int32_t y, int32_t time, int32_t *u,
                     int32_t *v)
{
    const struct smear_sampler *m = s->sampler;
    *u = timemask_value(&s->u, x, y, time);
    *v = timemask_value(&s->v, x, y, time);
    if (s->over_w) {
        struct quotient w = quotient_at(s, x, y, time);
        *u = quotient_of(&w, *u);
        *v = quotient_of(&w, *v);
        if (!m->turns) {
            *u = smear_sampler_texel(m, 0, shl_wrap(*u, 2));
            *v = smear_sampler_texel(m, 1, shl_wrap(*v, 2));
        }
    }
    *u = shl_wrap(*u, s->turns_shift);
    *v = shl_wrap(*v, s->turns_shift);
}

/* The mean of texels along the run: from its start to its end, evenly. */
static uint32_t texture_mean(const struct timemask_shade *s, int32_t x, int32_t y, uint32_t run,
                             int32_t light[3])
{
    uint32_t texel[TAPS_MAX];
    const smear_transfer transfer = frame_transfer(s->frame);
    const int up = TIMEMASK_TIME_LOG2 - s->samples_log2;
    int32_t travel = s->travel * (timemask_run_to(run) - timemask_run_from(run)) >> s->samples_log2;
    int log2 = 0;
    while (1 << log2 < TAPS_MAX && s->tap << log2 < travel)
        log2++;
    int32_t u0, v0, u1, v1;
    const int32_t half = 1 << (TIMEMASK_TIME_LOG2 - 1);
    texel_at(s, x, y, (timemask_run_from(run) << up) - half, &u0, &v0);
    texel_at(s, x, y, (timemask_run_to(run) << up) - half, &u1, &v1);
    int32_t du = sub_wrap(u1, u0) >> log2, dv = sub_wrap(v1, v0) >> log2;
    const struct smear_texture_run along = {
        .at = packed_uv((uint32_t)add_wrap(u0, du >> 1), (uint32_t)add_wrap(v0, dv >> 1)),
        .step = packed_step((uint32_t)du, (uint32_t)dv), .curvature = 0
    };
    int32_t n = 1 << log2;
    smear_sample(texel, s->sampler, &along, 0, n);
    if (n == 1 && light == NULL)
        return texel[0] & 0xffffffu;
    uint32_t sum[3] = { 0, 0, 0 };
    for (int32_t i = 0; i < n; i++)
        for (int c = 0; c < 3; c++) {
            uint32_t code = texel[i] >> (16 - 8 * c) & 255u;
            sum[c] += value_of_code(code, transfer);
        }
    uint32_t out[3];
    for (int c = 0; c < 3; c++) {
        uint32_t mean = (sum[c] + ((1u << log2) >> 1)) >> log2;
        if (light != NULL)
            mean = value_times_channel(mean, (uint32_t)light[c], transfer);
        out[c] = code_of_value(mean, transfer);
    }
    return pixel_make(0, out[0], out[1], out[2]);
}

/* Without fog. */
static uint32_t color_of(const struct timemask_shade *s, int32_t y, uint32_t run)
{
    int32_t x = timemask_run_x(run), light[3];
    if (!s->gouraud && s->sampler == NULL)
        return s->color;
    if (s->gouraud) {
        channels_at(s, x, y, timemask_middle(s, run), light);
        if (!SMEAR_WITH_TEXTURE || s->sampler == NULL)
            return pixel_of_channels((uint32_t)light[0], (uint32_t)light[1], (uint32_t)light[2], frame_transfer(s->frame));
    } else if (s->segment->shade == SHADE_FLAT) {
        for (int c = 0; c < 3; c++)
            light[c] = (int32_t)channel_of_code(s->color >> (16 - 8 * c) & 255u, frame_transfer(s->frame));
    } else {
        return texture_mean(s, x, y, run, NULL);
    }
    return texture_mean(s, x, y, run, light);
}

uint32_t smear_timemask_color(const struct timemask_shade *s, int32_t y, uint32_t run)
{
    const uint32_t color = color_of(s, y, run);
    if (!SMEAR_WITH_FOG || !s->in_fog)
        return color;
    const int32_t units = timemask_value(&s->depth, timemask_run_x(run), y, timemask_middle(s, run));
    const int32_t part = smear_fog_part(frame_fog(s->frame), clamp_i32(units, s->depth_low, s->depth_high) << 7);
    return fog_pixel(s->frame, color, part);
}
