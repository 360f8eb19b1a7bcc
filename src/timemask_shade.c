/* SPDX-License-Identifier: MIT */
/* timemask_shade.c - planes in time of a moving triangle's attributes, and colours from them. */
#include "timemask_shade.h"

#include "pixel.h"

enum {
    MOST_CHANGE = 1 << 25,      /* of a value in a segment: times 64 it fits */
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

/* Slopes are those of `shape`, the place is that of `place`; returns the value at the block's first pixel. */
static int64_t pose_plane(const struct pose_setup *shape, const struct pose_setup *place, const int32_t value[3],
                          struct plane *p)
{
    const uint8_t *o = shape->order;
    smear_plane_make(&shape->setup, p, value[o[0]], value[o[1]], value[o[2]]);
    const int32_t *v = place->record[0];
    return value[0] - (((int64_t)p->dx * v[VERTEX_X] + (int64_t)p->dy * v[VERTEX_Y]) >> 8);
}

/* Poses of a segment; `shape` tells which of them has an area to take slopes from. */
struct segment_setup {
    struct pose_setup end[2];
    const struct pose_setup *shape[2];
};

static bool is_within(int64_t a, int32_t dx, int32_t dy, int64_t most)
{
    const int64_t reach = TIMEMASK_BLOCK;
    return a + reach * (abs_i32(dx) + (int64_t)abs_i32(dy)) < most
        && -a + reach * (abs_i32(dx) + (int64_t)abs_i32(dy)) < most;
}

/* From values at the three vertices at both ends; a change of `most` or more makes it one value for the triangle: such
 * a plane is so steep that it has no exact pixels. */
static void timed_make(struct timemask_timed *t, const struct segment_setup *s, const int32_t a[3], const int32_t b[3],
                       int64_t most)
{
    struct plane start, end;
    int64_t at_start = pose_plane(s->shape[0], &s->end[0], a, &start);
    int64_t at_end = pose_plane(s->shape[1], &s->end[1], b, &end);
    t->at = (int32_t)(uint32_t)(uint64_t)at_start;
    t->dx = start.dx;
    t->dy = start.dy;
    int64_t change = at_end - at_start;
    t->change_dx = end.dx - start.dx;
    t->change_dy = end.dy - start.dy;
    if (!is_within(change, t->change_dx, t->change_dy, most)) {
        t->at = (int32_t)(((int64_t)a[0] + a[1] + 2 * (int64_t)a[2]) >> 2);
        change = (int32_t)(((int64_t)b[0] + b[1] + 2 * (int64_t)b[2]) >> 2) - (int64_t)t->at;
        t->dx = t->dy = t->change_dx = t->change_dy = 0;
    }
    t->change = (int32_t)change;
}

static void range_of(int32_t *low, int32_t *high, const int32_t a[3], const int32_t b[3])
{
    *low = min_i32(min_i32(min_i32(a[0], a[1]), a[2]), min_i32(min_i32(b[0], b[1]), b[2]));
    *high = max_i32(max_i32(max_i32(a[0], a[1]), a[2]), max_i32(max_i32(b[0], b[1]), b[2]));
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

/* Values of the vertices that go into planes with or without 1/w. */
struct vertex_values {
    int32_t q[2][3];            /* 1/w at both ends, all bits there are */
    bool over_w;
    const struct segment_setup *poses;
};

static void values_make(struct timemask_timed *t, const struct vertex_values *w, const int32_t a[3], int64_t most)
{
    if (!w->over_w) {
        timed_make(t, w->poses, a, a, most);
        return;
    }
    int32_t over[2][3];
    for (int end = 0; end < 2; end++)
        for (int i = 0; i < 3; i++)
            over[end][i] = times_q15(a[i], w->q[end][i]);
    timed_make(t, w->poses, over[0], over[1], most);
}

/* Whether interpolation on the screen is off by too much: range of the values, in 1/64 of what counts. */
static bool needs_w(const struct timemask_pose *p, uint32_t range)
{
    int32_t low = min_i32(p->depth[0], min_i32(p->depth[1], p->depth[2]));
    int32_t high = max_i32(p->depth[0], max_i32(p->depth[1], p->depth[2]));
    return smear_times_over((uint32_t)(high - low), range, (uint32_t)low) >> 2 > AFFINE_OFF;
}

static uint32_t spread(const int32_t a[3])
{
    return (uint32_t)max_i32(a[0], max_i32(a[1], a[2])) - (uint32_t)min_i32(a[0], min_i32(a[1], a[2]));
}

void smear_timemask_shade(struct timemask_shade *s, const struct smear_raster_frame *frame,
                          const struct smear_segment *segment, const struct smear_triangle *triangle,
                          const struct timemask_pose *a, const struct timemask_pose *b, int32_t slots_log2, int32_t tap)
{
    struct segment_setup poses;
    const int32_t *record[3];
    uint64_t area_a = pose_start(&poses.end[0], a), area_b = pose_start(&poses.end[1], b);
    poses.shape[0] = &poses.end[area_a == 0];
    poses.shape[1] = &poses.end[area_b != 0];
    for (int i = 0; i < 3; i++)
        record[i] = geometry_vertex(frame->geometry, segment, triangle->vertex[i]);

    s->frame = frame;
    s->segment = segment;
    s->slots_log2 = slots_log2;
    s->tap = tap;
    s->color = triangle->color;
    s->sampler = segment->uv != 0 ? &frame->draw[segment->draw].sampler : NULL;
    s->gouraud = segment->shade == SHADE_GOURAUD;

    int32_t depth[2][3];
    for (int i = 0; i < 3; i++) {
        depth[0][i] = a->depth[i] >> 6;
        depth[1][i] = b->depth[i] >> 6;
    }
    timed_make(&s->depth, &poses, depth[0], depth[1], MOST_CHANGE);
    range_of(&s->depth_low, &s->depth_high, depth[0], depth[1]);

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
    struct vertex_values w = { .poses = &poses };
    w.over_w = s->over_w = !segment->flat_depth && (needs_w(a, range) || needs_w(b, range));
    if (s->over_w) {
        int32_t low, high;
        range_of(&low, &high, a->depth, b->depth);
        int up = max_i32(count_leading_zeros((uint32_t)high) - 3, 0);
        for (int i = 0; i < 3; i++) {
            w.q[0][i] = a->depth[i] << up;
            w.q[1][i] = b->depth[i] << up;
        }
        timed_make(&s->q, &poses, w.q[0], w.q[1], INT32_MAX);
    }
    for (int c = 0; c < 3 && s->gouraud; c++) {
        range_of(&s->channel_low[c], &s->channel_high[c], channel[c], channel[c]);
        for (int i = 0; i < 3 && s->over_w; i++)
            channel[c][i] >>= 8;
        values_make(&s->channel[c], &w, channel[c], s->over_w ? INT32_MAX : MOST_CHANGE);
    }
    if (m == NULL)
        return;
    s->turns_shift = (int8_t)(!m->turns ? 0 : (s->over_w ? 20 : 18) - m->uv_shift);
    for (int i = 0; i < 3 && !s->over_w; i++) {
        u[i] = m->turns ? u[i] * 16384 : smear_sampler_texel_u(m, u[i] * 16384);
        v[i] = m->turns ? v[i] * 16384 : smear_sampler_texel_v(m, v[i] * 16384);
    }
    values_make(&s->u, &w, u, INT32_MAX);
    values_make(&s->v, &w, v, INT32_MAX);
    s->travel = 0;
    for (int i = 0; i < 3; i++) {
        int32_t dx = abs_i32(b->x[i] - a->x[i]), dy = abs_i32(b->y[i] - a->y[i]);
        s->travel = max_i32(s->travel, max_i32(dx, dy) + (min_i32(dx, dy) >> 1));
    }
}

/* ------------------------------------------------------------------ colours */

/* As timemask_value, for any change. */
static int32_t wide_value(const struct timemask_timed *p, int32_t x, int32_t y, int32_t time)
{
    int32_t here = add_wrap(p->at, add_wrap(mul_wrap(p->dx, x), mul_wrap(p->dy, y)));
    int32_t change = add_wrap(p->change, add_wrap(mul_wrap(p->change_dx, x), mul_wrap(p->change_dy, y)));
    const int32_t below = (1 << TIMEMASK_TIME_LOG2) - 1;
    return add_wrap(here, add_wrap(mul_wrap(change >> TIMEMASK_TIME_LOG2, time),
                                   (change & below) * time >> TIMEMASK_TIME_LOG2));
}

/* w at a time: 1/q = recip 2^(zeros - 61). */
struct quotient {
    int zeros;
    int32_t recip;
};

static struct quotient quotient_at(const struct timemask_shade *s, int32_t x, int32_t y, int32_t time)
{
    uint32_t q = (uint32_t)max_i32(wide_value(&s->q, x, y, time), 1 << 11);
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
        int32_t value = s->over_w ? quotient_of(&w, wide_value(&s->channel[c], x, y, time)) >> 4
                                  : timemask_value(&s->channel[c], x, y, time);
        out[c] = clamp_i32(value, s->channel_low[c], s->channel_high[c]);
    }
}

/* Coordinates in turns or texels q16, as samplers take them. */
static void texel_at(const struct timemask_shade *s, int32_t x, int32_t y, int32_t time, int32_t *u, int32_t *v)
{
    const struct smear_sampler *m = s->sampler;
    *u = wide_value(&s->u, x, y, time);
    *v = wide_value(&s->v, x, y, time);
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
static uint32_t texture_mean(const struct timemask_shade *s, int32_t x, int32_t y, const struct timemask_run *run,
                             int32_t light[3])
{
    uint32_t texel[TAPS_MAX];
    const bool linear = s->frame->linear;
    const int up = TIMEMASK_TIME_LOG2 - s->slots_log2;
    int32_t travel = s->travel * (run->to - run->from) >> s->slots_log2;
    int log2 = 0;
    while (1 << log2 < TAPS_MAX && s->tap << log2 < travel)
        log2++;
    int32_t u0, v0, u1, v1;
    texel_at(s, x, y, run->from << up, &u0, &v0);
    texel_at(s, x, y, run->to << up, &u1, &v1);
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

uint32_t smear_timemask_color(const struct timemask_shade *s, int32_t y, const struct timemask_run *run)
{
    int32_t x = run->x, light[3];
    if (s->gouraud) {
        channels_at(s, x, y, (run->from + run->to) << (TIMEMASK_TIME_LOG2 - 1 - s->slots_log2), light);
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
