/* SPDX-License-Identifier: MIT */
/* timemask_shade.c - planes in time of a moving triangle's attributes, and colours from them. */
#include "timemask_shade.h"

#include "pixel.h"

enum {
    MOST_SLOPE = 1 << 20,
    AFFINE_OFF = 8,             /* 1/64 texel, or 1/64 code: what perspective may matter and be left out */
    TAPS_MAX = 8
};

/* ------------------------------------------------------------------ planes */

/* A triangle at one end of a segment, as setup.c sees it: the vertices in an order that makes its area positive. */
struct pose_setup {
    struct setup setup;
    int32_t record[3][VERTEX_BASE_WORDS];
    uint8_t order[3];
};

static uint64_t pose_start(struct pose_setup *p, const struct timemask_pose *pose)
{
    struct setup *s = &p->setup;
    for (int i = 0; i < 3; i++) {
        p->record[i][VERTEX_X] = pose->x[i];
        p->record[i][VERTEX_Y] = pose->y[i];
        p->record[i][VERTEX_DEPTH] = pose->depth[i];
        p->order[i] = (uint8_t)i;
        s->v[i] = p->record[i];
    }
    int64_t area = (int64_t)setup_edges(s);
    if (area < 0) {
        s->v[1] = p->record[2];
        s->v[2] = p->record[1];
        p->order[1] = 2;
        p->order[2] = 1;
        area = (int64_t)setup_edges(s);
    }
    if (area > 0)
        smear_setup_area(s, (uint64_t)area);
    return (uint64_t)area;
}

/* Poses of a segment, and which of them has an area to take slopes from. */
struct segment_setup {
    struct pose_setup pose[3];
    const struct pose_setup *shape[3];
    bool turns;                 /* slopes are not the same */
    int32_t x, y, x_change, y_change;       /* a point that attributes go with: q8 px from the block's first centre */
};

/* At the point that attributes go with. */
static inline int32_t point_of(const int32_t a[3])
{
    return (int32_t)(((int64_t)a[0] + a[0] + a[1] + a[2]) >> 2);
}

static void slopes_of(struct plane *p, const struct pose_setup *shape, const int32_t value[3])
{
    const uint8_t *o = shape->order;
    smear_plane_make(&shape->setup, p, value[o[0]], value[o[1]], value[o[2]]);
}

/* |change| + |curve| all over the block. */
static int64_t change_size(int64_t change, int32_t dx, int32_t dy, int64_t curve)
{
    int64_t corner = TIMEMASK_WIDTH * (int64_t)abs_i32(dx) + TIMEMASK_HEIGHT * (int64_t)abs_i32(dy);
    return (change < 0 ? -change : change) + corner + (curve < 0 ? -curve : curve);
}

/* From values at the three vertices at the start, in the middle and at the end. The attribute is a plane with the value v of
 * a point at c and slopes g around it; all three change with time:
 *
 *     v + v' t + (g + g' t) (x - c - c' t) = v + g (x - c) + t (v' - g c' + g' (x - c)) - t^2 g' c'
 *
 * A plane that changes by more than there are bits for is so steep that it has no exact pixels: it becomes one value. */
static void timed_make(struct timemask_timed *t, const struct segment_setup *s, const int32_t *const value[3])
{
    struct plane p, start, end;
    slopes_of(&p, s->shape[1], value[1]);
    int32_t v = point_of(value[1]);
    int64_t v_change = (int64_t)point_of(value[2]) - point_of(value[0]);
    int64_t at = v - (((int64_t)p.dx * s->x + (int64_t)p.dy * s->y) >> 8);
    int64_t change = v_change - (((int64_t)p.dx * s->x_change + (int64_t)p.dy * s->y_change) >> 8), curve = 0;
    t->change_dx = t->change_dy = 0;
    if (s->turns) {
        slopes_of(&start, s->shape[0], value[0]);
        slopes_of(&end, s->shape[2], value[2]);
        t->change_dx = end.dx - start.dx;
        t->change_dy = end.dy - start.dy;
        change -= ((int64_t)t->change_dx * s->x + (int64_t)t->change_dy * s->y) >> 8;
        curve = -(((int64_t)t->change_dx * s->x_change + (int64_t)t->change_dy * s->y_change) >> 8);
    }
    t->dx = p.dx;
    t->dy = p.dy;
    if (change_size(change, t->change_dx, t->change_dy, curve) >= INT32_MAX) {
        at = v;
        change = curve = 0;
        t->dx = t->dy = t->change_dx = t->change_dy = 0;
    }
    t->at = (int32_t)(uint32_t)(uint64_t)at;
    t->change = (int32_t)change;
    t->curve = (int32_t)curve;
}

static void range_of(int32_t *low, int32_t *high, const int32_t *const value[3])
{
    *low = INT32_MAX;
    *high = INT32_MIN;
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < 3; i++) {
            *low = min_i32(*low, value[k][i]);
            *high = max_i32(*high, value[k][i]);
        }
}

static inline uint32_t spread(const int32_t a[3])
{
    return (uint32_t)max_i32(a[0], max_i32(a[1], a[2])) - (uint32_t)min_i32(a[0], min_i32(a[1], a[2]));
}

/* Whether slopes change so much between two poses that it matters: edges by more than 1/8 of the longest, or depths
 * along them by more than 1/512 of depth. */
static bool shape_turns(const struct timemask_pose *a, const struct timemask_pose *b)
{
    int32_t change = 0, deeper = 0, size = 0;
    for (int i = 1; i < 3; i++) {
        int32_t ex = a->x[i] - a->x[0], ey = a->y[i] - a->y[0], ez = a->depth[i] - a->depth[0];
        int32_t fx = b->x[i] - b->x[0], fy = b->y[i] - b->y[0], fz = b->depth[i] - b->depth[0];
        size = max_i32(size, max_i32(abs_i32(ex), abs_i32(ey)));
        change = max_i32(change, max_i32(abs_i32(fx - ex), abs_i32(fy - ey)));
        deeper = max_i32(deeper, abs_i32((fz >> 1) - (ez >> 1)));
    }
    return change > size >> 3 || deeper > a->depth[0] >> 10;
}

/* ------------------------------------------------------------------ set-up */

/* floor(a q / 2^15), a of 16 bits. */
static int32_t times_q15(int32_t a, int32_t q)
{
    return a * (q >> 15) + (a * (q & 0x7fff) >> 15);
}

/* Channel c of a vertex, q16: see channel_value in setup.h. */
static int32_t channel_of(const int32_t *record, const struct smear_segment *g, int c, bool linear)
{
    uint32_t word = (uint32_t)record[g->color + (c >> 1)];
    int32_t a = (int32_t)((c & 1 ? word >> 16 : word & 0xffffu) << 8);
    return linear ? clamp_i32(a, 0x400, 0xffe000) : min_i32(a + 0x8000, 0xff8000);
}

static uint32_t channels_pixel(const int32_t c[3], bool linear)
{
    if (linear)
        return pixel_make(0, smear_srgb_encode[c[0] >> 12], smear_srgb_encode[c[1] >> 12], smear_srgb_encode[c[2] >> 12]);
    return pixel_make(0, (uint32_t)c[0] >> 16, (uint32_t)c[1] >> 16, (uint32_t)c[2] >> 16);
}

/* Values of the vertices that go into planes, times 1/w where that is wanted. */
static void values_make(struct timemask_timed *t, const struct segment_setup *poses, const int32_t (*q)[3],
                        const int32_t a[3])
{
    int32_t over[3][3];
    const int32_t *value[3] = { a, a, a };
    for (int k = 0; k < 3 && q != NULL; k++) {
        for (int i = 0; i < 3; i++)
            over[k][i] = times_q15(a[i], q[k][i]);
        value[k] = over[k];
    }
    timed_make(t, poses, value);
}

/* Whether interpolation on the screen is off by too much: range of the values, in 1/64 of what counts. */
static bool needs_w(const struct timemask_pose *p, uint32_t range)
{
    int32_t low = min_i32(p->depth[0], min_i32(p->depth[1], p->depth[2]));
    int32_t high = max_i32(p->depth[0], max_i32(p->depth[1], p->depth[2]));
    return smear_times_over((uint32_t)(high - low), range, (uint32_t)low) >> 2 > AFFINE_OFF;
}

static void shade_depth(struct timemask_shade *s, const struct segment_setup *poses,
                        const struct timemask_pose *const pose[3])
{
    int32_t depth[3][3];
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < 3; i++)
            depth[k][i] = pose[k]->depth[i] >> 7;
    const int32_t *value[3] = { depth[0], depth[1], depth[2] };
    timed_make(&s->depth, poses, value);
    range_of(&s->depth_low, &s->depth_high, value);
    int32_t change = s->depth.change + s->depth.change_dx * (TIMEMASK_WIDTH / 2) + s->depth.change_dy * (TIMEMASK_HEIGHT / 2);
    change = clamp_i32(change >> s->slots_log2, -MOST_SLOPE, MOST_SLOPE);
    s->slope[0] = change;
    s->slope[1] = change >> 4;
}

void smear_timemask_shade(struct timemask_shade *s, const struct smear_raster_frame *frame,
                          const struct smear_segment *segment, const struct smear_triangle *triangle,
                          const struct timemask_pose *const pose[3], int32_t slots_log2, int32_t tap)
{
    struct segment_setup poses;
    const int32_t *record[3];
    s->frame = frame;
    s->segment = segment;
    s->slots_log2 = slots_log2;
    s->tap = tap;
    s->color = triangle->color;
    s->sampler = segment->uv != 0 ? &frame->draw[segment->draw].sampler : NULL;
    s->gouraud = segment->shade == SHADE_GOURAUD;
    for (int i = 0; i < 3; i++)
        record[i] = geometry_vertex(frame->geometry, segment, triangle->vertex[i]);

    /* Slopes of the middle, unless it is seen from its edge then. */
    uint64_t area = pose_start(&poses.pose[1], pose[1]);
    poses.turns = area == 0 || shape_turns(pose[0], pose[2]);
    poses.shape[1] = &poses.pose[1];
    if (poses.turns) {
        uint64_t area_a = pose_start(&poses.pose[0], pose[0]), area_b = pose_start(&poses.pose[2], pose[2]);
        const struct pose_setup *some = &poses.pose[area != 0 ? 1 : area_a != 0 ? 0 : 2];
        poses.shape[0] = area_a != 0 ? &poses.pose[0] : some;
        poses.shape[1] = some;
        poses.shape[2] = area_b != 0 ? &poses.pose[2] : some;
    }
    poses.x = point_of(pose[1]->x);
    poses.y = point_of(pose[1]->y);
    poses.x_change = point_of(pose[2]->x) - point_of(pose[0]->x);
    poses.y_change = point_of(pose[2]->y) - point_of(pose[0]->y);
    shade_depth(s, &poses, pose);

    int32_t channel[3][3];
    if (s->gouraud) {
        bool equal = true;
        for (int c = 0; c < 3; c++)
            for (int i = 0; i < 3; i++) {
                channel[c][i] = channel_of(record[i], segment, c, frame->linear);
                equal = equal && channel[c][i] == channel[c][0];
            }
        if (equal && s->sampler == NULL) {
            const int32_t one[3] = { channel[0][0], channel[1][0], channel[2][0] };
            s->color = channels_pixel(one, frame->linear);
            s->gouraud = false;
        }
    }
    s->color &= 0xffffffu;
    if (!s->gouraud && s->sampler == NULL)
        return;

    /* Mesh units, and how far they reach in texels. */
    const struct smear_sampler *m = s->sampler;
    int32_t u[3], v[3];
    uint32_t range = 0;
    if (m != NULL) {
        for (int i = 0; i < 3; i++) {
            u[i] = (int16_t)(record[i][segment->uv] & 0xffff);
            v[i] = record[i][segment->uv] >> 16;
        }
        range = magnitude_i32(smear_sampler_texel_u(m, (int32_t)spread(u) * 16384) >> 10);
        range = max_u32(range, magnitude_i32(smear_sampler_texel_v(m, (int32_t)spread(v) * 16384) >> 10));
    }
    for (int c = 0; c < 3 && s->gouraud; c++)
        range = max_u32(range, spread(channel[c]) >> 10);
    int32_t over[3][3];
    const int32_t (*q)[3] = NULL;
    s->over_w = !segment->flat_depth && (needs_w(pose[0], range) || needs_w(pose[2], range));
    if (s->over_w) {
        int32_t high = 0;
        for (int k = 0; k < 3; k++)
            for (int i = 0; i < 3; i++)
                high = max_i32(high, pose[k]->depth[i]);
        int up = count_leading_zeros((uint32_t)high) - 6;          /* room for changes */
        for (int k = 0; k < 3; k++)
            for (int i = 0; i < 3; i++)
                over[k][i] = up >= 0 ? pose[k]->depth[i] << up : pose[k]->depth[i] >> -up;
        const int32_t *value[3] = { over[0], over[1], over[2] };
        q = (const int32_t (*)[3])over;
        timed_make(&s->q, &poses, value);
    }
    for (int c = 0; c < 3 && s->gouraud; c++) {
        const int32_t *value[3] = { channel[c], channel[c], channel[c] };
        range_of(&s->channel_low[c], &s->channel_high[c], value);
        for (int i = 0; i < 3 && s->over_w; i++)
            channel[c][i] >>= 8;
        values_make(&s->channel[c], &poses, q, channel[c]);
    }
    if (m == NULL)
        return;
    s->turns_shift = (int8_t)(!m->turns ? 0 : (s->over_w ? 20 : 18) - m->uv_shift);
    for (int i = 0; i < 3 && !s->over_w; i++) {
        u[i] = m->turns ? u[i] * 16384 : smear_sampler_texel_u(m, u[i] * 16384);
        v[i] = m->turns ? v[i] * 16384 : smear_sampler_texel_v(m, v[i] * 16384);
    }
    values_make(&s->u, &poses, q, u);
    values_make(&s->v, &poses, q, v);
    s->travel = 0;
    for (int i = 0; i < 3; i++) {
        int32_t dx = abs_i32(pose[2]->x[i] - pose[0]->x[i]), dy = abs_i32(pose[2]->y[i] - pose[0]->y[i]);
        s->travel = max_i32(s->travel, max_i32(dx, dy) + (min_i32(dx, dy) >> 1));
    }
}

/* ------------------------------------------------------------------ colours */

static inline int32_t value_at(const struct timemask_timed *p, int32_t x, int32_t y, int32_t time)
{
    struct timemask_here here = timemask_here(p, x, y);
    return timemask_value(p, &here, time);
}

/* w at a time: 1/q = recip 2^(zeros - 61). */
struct quotient {
    int zeros;
    int32_t recip;
};

static struct quotient quotient_at(const struct timemask_shade *s, int32_t x, int32_t y, int32_t time)
{
    uint32_t q = (uint32_t)max_i32(value_at(&s->q, x, y, time), 1 << 11);
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
    struct quotient w = { 0, 0 };
    if (s->over_w)
        w = quotient_at(s, x, y, time);
    for (int c = 0; c < 3; c++) {
        int32_t value = value_at(&s->channel[c], x, y, time);
        out[c] = clamp_i32(s->over_w ? quotient_of(&w, value) >> 4 : value, s->channel_low[c], s->channel_high[c]);
    }
}

/* Coordinates in turns or texels q16, as samplers take them. */
static void texel_at(const struct timemask_shade *s, int32_t x, int32_t y, int32_t time, int32_t *u, int32_t *v)
{
    const struct smear_sampler *m = s->sampler;
    *u = value_at(&s->u, x, y, time);
    *v = value_at(&s->v, x, y, time);
    if (s->over_w) {
        struct quotient w = quotient_at(s, x, y, time);
        *u = quotient_of(&w, *u);
        *v = quotient_of(&w, *v);
        if (!m->turns) {
            *u = smear_sampler_texel_u(m, shl_wrap(*u, 2));
            *v = smear_sampler_texel_v(m, shl_wrap(*v, 2));
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
    const bool linear = s->frame->linear;
    const int up = TIMEMASK_TIME_LOG2 - s->slots_log2;
    int32_t travel = s->travel * (timemask_run_to(run) - timemask_run_from(run)) >> s->slots_log2;
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
        .step = packed_step((uint32_t)du, (uint32_t)dv), .bend = 0
    };
    int32_t n = 1 << log2;
    smear_sample(texel, s->sampler, &along, 0, n);
    if (n == 1 && light == NULL)
        return texel[0] & 0xffffffu;
    uint32_t sum[3] = { 0, 0, 0 };
    for (int32_t i = 0; i < n; i++)
        for (int c = 0; c < 3; c++) {
            uint32_t code = texel[i] >> (16 - 8 * c) & 255u;
            sum[c] += linear ? smear_srgb_decode[code] : code;
        }
    uint32_t out[3];
    for (int c = 0; c < 3; c++) {
        uint32_t mean = (sum[c] + ((1u << log2) >> 1)) >> log2;
        if (light != NULL) {
            uint32_t l = (uint32_t)light[c];
            mean = linear ? (mean * ((l >> 8) + (l >> 23)) + 0x8000u) >> 16 : code_times(mean, l >> 16);
        }
        out[c] = linear ? smear_srgb_encode[mean >> 4] : mean;
    }
    return pixel_make(0, out[0], out[1], out[2]);
}

uint32_t smear_timemask_color(const struct timemask_shade *s, int32_t y, uint32_t run)
{
    int32_t x = timemask_run_x(run), light[3];
    if (s->gouraud) {
        channels_at(s, x, y, timemask_middle(s, run), light);
        if (s->sampler == NULL)
            return channels_pixel(light, s->frame->linear);
    } else if (s->segment->shade == SHADE_FLAT) {
        for (int c = 0; c < 3; c++) {
            uint32_t code = s->color >> (16 - 8 * c) & 255u;
            light[c] = (int32_t)(s->frame->linear ? (uint32_t)smear_srgb_decode[code] << 8 : code << 16);
        }
    } else {
        return texture_mean(s, x, y, run, NULL);
    }
    return texture_mean(s, x, y, run, light);
}
