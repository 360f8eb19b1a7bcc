/* SPDX-License-Identifier: MIT */
/* velocity.c - how check_kernels calls the velocities of spans, and of rows of one colour: each call makes triangles' planes from
 * numbers, nearly still or at any place, and writes rows of a target, which the forms for eight pixels only take where it marks
 * tiles. */
#include "raster/texture_rows.h"

#include "tests/kernels/kernels.h"

#if SMEAR_AVX2
enum { DEPTH, VELOCITY, COLOR };        /* planes */
enum { SEED, SHAPE, MARKS };    /* words */
enum { LEFT = 8 * 29, ROW = 37 };

static uint32_t next(uint32_t *seed)
{
    *seed = *seed * 1664525u + 1013904223u;
    return *seed >> 8;
}

static int32_t around_0(uint32_t *seed, int bits)
{
    return (int32_t)(next(seed) & ((1u << bits) - 1u)) - (1 << (bits - 1));
}

/* Numerators of points that go some pixels away in a pose, or anywhere. */
static void make_pose(struct setup *s, int pose, uint32_t *seed, uint32_t shape)
{
    const int bits = (shape & 1u) != 0 ? 8 : 14;
    struct plane *r = &s->ratio[pose], *axis[2] = { &s->px[pose], &s->py[pose] };
    r->at = (1 << 27) + around_0(seed, 20);
    r->dx = around_0(seed, bits);
    r->dy = around_0(seed, bits);
    if ((shape & 14u) == 0)
        r->at -= 1 << 27;       /* behind the eye */
    for (int i = 0; i < 2; i++) {
        const int32_t here = (i == 0 ? LEFT : ROW) * 256 + 128 - s->v[0][i == 0 ? VERTEX_X : VERTEX_Y];
        const int32_t there = (int32_t)((int64_t)plane_at(r, LEFT, ROW) * here >> 20);
        axis[i]->dx = (i == 0 ? r->at >> 12 : 0) + around_0(seed, bits);
        axis[i]->dy = 0;
        axis[i]->at = there - LEFT * axis[i]->dx + around_0(seed, (shape & 32u) != 0 ? 18 : 22);
        if ((shape & 30u) == 2)
            axis[i]->at = around_0(seed, 24) * 64;
    }
}

static void make_setup(struct setup *s, uint32_t *seed, uint32_t shape)
{
    s->poses = (uint8_t)(shape >> 6 & 1u) + 1;
    s->velocity_affine = (shape >> 7 & 3u) == 0;
    s->clamp_velocity = !s->velocity_affine || (shape >> 9 & 1u);
    s->vx = (struct plane){ around_0(seed, 22), around_0(seed, 12), around_0(seed, 8) };
    s->vy = (struct plane){ around_0(seed, 22), around_0(seed, 12), around_0(seed, 8) };
    for (int i = 0; i < 2; i++)
        make_pose(s, i, seed, shape);
}

static const struct smear_raster_frame frame = { .width = 1024, .velocity_scale = 32768, .reach_q3 = 13 * 8 };

/* A vertex within some pixels of (LEFT, ROW). */
static void make_vertex(int32_t vertex[8], uint32_t *seed)
{
    vertex[VERTEX_X] = LEFT * 256 + around_0(seed, 12);
    vertex[VERTEX_Y] = ROW * 256 + around_0(seed, 12);
}

static void spans(struct kernel_call *c, bool marks)
{
    uint32_t seed = c->word[SEED];
    const uint32_t shape = c->word[SHAPE];
    int32_t vertex[8] = { 0 };
    uint8_t moving[64] = { 0 };
    make_vertex(vertex, &seed);
    const struct smear_raster_target target = {
        .x0 = LEFT, .x1 = LEFT + (c->n & ~7), .depth = c->plane[DEPTH], .velocity8 = (shape >> 10 & 1u) ? c->plane[VELOCITY] : NULL,
        .velocity16 = (shape >> 10 & 1u) ? NULL : c->plane[VELOCITY], .moving = marks ? moving : NULL, .tile_shift = 4
    };
    struct setup s = { .frame = &frame, .target = &target, .v = { vertex, vertex, vertex } };
    make_setup(&s, &seed, shape);
    for (int i = 0; i < 4; i++) {
        const int32_t n = c->n & ~7;
        if (n == 0)
            return;
        const int32_t from = (int32_t)(next(&seed) % (uint32_t)n), to = from + 1 + (int32_t)(next(&seed) % (uint32_t)(n - from));
        const int32_t over = (int32_t)(next(&seed) & 3u) * 5;
        const struct span p = {
            .a = LEFT + from, .b = LEFT + to, .left = LEFT + from, .right = LEFT + to + over, .y = ROW,
            .depth = (uint16_t *)c->plane[DEPTH] + from, .at = from, .z = next(&seed) << 8, .dz = around_0(&seed, 20)
        };
        smear_span_velocity(&s, &p);
    }
}

static void reference(struct kernel_call *c)
{
    spans(c, false);
}

static void eight(struct kernel_call *c)
{
    spans(c, true);
}

/* Draws rows one after the other. */
static void rows_by_spans(const struct setup *s, const struct span_rows *r)
{
    for (int32_t row = 0; row < r->count; row++) {
        const struct smear_raster_target *t = s->target;
        const int32_t b = r->side[row].right < t->x1 ? r->side[row].right : t->x1, y = r->y + row;
        for (int32_t a = r->side[row].left > t->x0 ? r->side[row].left : t->x0, end; a < b; a = end) {
            const int32_t units = plane_at(&s->depth, a, y), at = r->at + row * t->window_rows.stride + a;
            const enum depth_slope slope = s->slope != SLOPE_BOTH ? s->slope : units < SLOPE_BREAK ? SLOPE_FAR : SLOPE_NEAR;
            /* Up to the first pixel beyond the depth code's break. */
            for (end = a + 1; end < b && (s->slope != SLOPE_BOTH || (plane_at(&s->depth, end, y) < SLOPE_BREAK) == (slope == SLOPE_FAR));)
                end++;
            const struct span p = {
                .a = a, .b = end, .right = r->side[row].edge, .y = y, .color = t->color + at, .depth = t->depth + at, .at = at,
                .z = code_from_units(units, slope), .dz = step_from_units(s->depth.dx, slope)
            };
            smear_span_velocity(s, &p);
            smear_span_flat(s, &p);
        }
    }
}

static void rows(struct kernel_call *c, bool marks)
{
    enum { ROWS = 4 };
    uint32_t seed = c->word[SEED];
    const uint32_t shape = c->word[SHAPE];
    const int32_t stride = c->n / ROWS & ~7;
    int32_t vertex[8] = { 0 };
    uint8_t moving[64] = { 0 };
    make_vertex(vertex, &seed);
    const struct smear_raster_target target = {
        .x0 = LEFT, .x1 = LEFT + stride - (int32_t)(shape >> 12 & 1u) * 3, .depth = c->plane[DEPTH], .color = c->plane[COLOR],
        .velocity8 = (shape >> 10 & 1u) ? c->plane[VELOCITY] : NULL, .velocity16 = (shape >> 10 & 1u) ? NULL : c->plane[VELOCITY],
        .moving = marks ? moving : NULL, .tile_shift = 4, .window_rows = { .stride = stride }
    };
    struct setup s = { .frame = &frame, .target = &target, .v = { vertex, vertex, vertex }, .color = 0xff336699u, .flat = true,
                       .writes_velocity = true };
    if (stride == 0)
        return;
    make_setup(&s, &seed, shape);
    s.poses = (shape >> 13 & 7u) == 0 ? 0 : s.poses;
    s.velocity_unknown = (shape >> 16 & 1u) != 0;
    s.slope = (enum depth_slope[]){ SLOPE_FAR, SLOPE_NEAR, SLOPE_BOTH, SLOPE_BOTH }[shape >> 17 & 3u];
    s.depth = (struct plane){ SLOPE_BREAK - LEFT * (around_0(&seed, 18) & ~255), 0, around_0(&seed, 18) };
    s.depth.dx = (SLOPE_BREAK - s.depth.at) / LEFT;     /* the break lies among the columns */
    struct span_rows r = { .y = ROW, .count = ROWS, .cut = true, .at = -LEFT };
    for (int i = 0; i < ROWS; i++) {
        const int32_t left = LEFT - 4 + (int32_t)(next(&seed) % (uint32_t)(stride + 4));
        const int32_t edge = left + (int32_t)(next(&seed) % (uint32_t)(stride + 8));
        r.side[i] = (struct span_side){ .left = left, .right = edge, .edge = edge };
    }
    if (marks && smear_rows_motion_suit(&s))
        smear_rows_motion(&s, &r);
    else
        rows_by_spans(&s, &r);
}

static void rows_reference(struct kernel_call *c) { rows(c, false); }
static void rows_eight(struct kernel_call *c) { rows(c, true); }
#endif

extern const struct kernel kernels_velocity[];
const struct kernel kernels_velocity[] = {
#if SMEAR_AVX2
    { .name = "span_velocity (made, written)", .most = 160, .size = { 2, 4 }, .timed = 64,
      .form = { { "reference", reference }, { "avx2", eight } } },
    { .name = "rows_motion (made, written)", .most = 160, .size = { 2, 4, 4 }, .timed = 128,
      .form = { { "reference", rows_reference }, { "avx2", rows_eight } } },
#endif
    { .name = NULL }
};
