/* SPDX-License-Identifier: MIT */
/* velocity.c - how check_kernels calls the velocities of spans: each call makes triangles' planes from numbers, nearly still
 * or at any place, and writes one row of a target, which the form for eight pixels only takes where it marks tiles. */
#include "raster/span.h"

#include "tests/kernels/kernels.h"

#if SMEAR_AVX2
enum { DEPTH, VELOCITY };       /* planes */
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

static void spans(struct kernel_call *c, bool marks)
{
    uint32_t seed = c->word[SEED];
    const uint32_t shape = c->word[SHAPE];
    int32_t vertex[8] = { 0 };
    uint8_t moving[64] = { 0 };
    vertex[VERTEX_X] = LEFT * 256 + around_0(&seed, 12);
    vertex[VERTEX_Y] = ROW * 256 + around_0(&seed, 12);
    const struct smear_raster_frame frame = { .width = 1024, .velocity_scale = 32768, .reach_q3 = 13 * 8 };
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
#endif

extern const struct kernel kernels_velocity[];
const struct kernel kernels_velocity[] = {
#if SMEAR_AVX2
    { .name = "span_velocity (made, written)", .most = 160, .size = { 2, 4 }, .timed = 64,
      .form = { { "reference", reference }, { "avx2", eight } } },
#endif
    { .name = NULL }
};
