/* SPDX-License-Identifier: MIT */
/* flat_run.c - how check_kernels calls kernels/flat_run.h. */
#include "kernels/flat_lines_bind.h"

#include "tests/kernels/kernels.h"

enum { Z, DZ, COLOR, DZ_DOWN, LEFT, RIGHT = LEFT + 4, ALL = RIGHT + 4 };      /* words; of edges, x and y of both ends */
enum { STRIDE = 35, COLUMNS = 32 };

#define CALLS(FORM) \
    static void wide_##FORM(struct kernel_call *c) \
    { \
        flat_run_##FORM(c->plane[0], c->plane[1], c->n, c->word[Z], c->word[DZ], c->word[COLOR], false); \
    } \
    static void narrow_##FORM(struct kernel_call *c) \
    { \
        flat_run_##FORM(c->plane[0], c->plane[1], c->n, c->word[Z], c->word[DZ], c->word[COLOR] & 0xffffu, true); \
    }

/* What flat_lines is to draw. */
static void flat_lines_reference(struct flat_lines *l, int32_t n)
{
    struct edge_fine side[2];
    flat_lines_take_sides(l, side);
    for (; n > 0; n--) {
        void *const pixels = (void *)((uintptr_t)l->depth * (l->narrow ? 1u : 2u) + l->to_pixels);
        const int32_t a = max_i32(edge_fine_pixel(&side[0]), l->x0), b = min_i32(edge_fine_pixel(&side[1]), l->x1);
        for (int32_t x = a; x < b; x++)
            flat_pixel(pixels, l->depth, x, flat_code(l->z + l->dz * (uint32_t)x, l->breaks), l->narrow ? l->color & 0xffffu : l->color,
                       l->narrow);
        flat_lines_go_down(l, side);
    }
    flat_lines_side(l, 0, &side[0]);
    flat_lines_side(l, 1, &side[1]);
}

CALLS(reference)
CALLS(unrolled)
VECTORS(CALLS(vector))

static void wide_best(struct kernel_call *c)
{
    flat_run(c->plane[0], c->plane[1], c->n, c->word[Z], c->word[DZ], c->word[COLOR], false);
}

static void narrow_best(struct kernel_call *c)
{
    flat_run(c->plane[0], c->plane[1], c->n, c->word[Z], c->word[DZ], c->word[COLOR] & 0xffffu, true);
}

/* Edges reach beyond the rows and all columns, at least as far down as the rows are. */
static void rows_prepare(struct kernel_call *c)
{
    for (int i = LEFT; i < ALL; i += 4) {
        c->word[i] = (uint32_t)(between(-2000, 6000) + (i == RIGHT ? 4000 : 0));
        c->word[i + 1] = (uint32_t)between(-300, 127);
        c->word[i + 2] = (uint32_t)(between(-2000, 6000) + (i == RIGHT ? 4000 : 0));
        c->word[i + 3] = (uint32_t)(c->n / STRIDE * 256 + between(256, 600));
    }
}

/* Depth is small enough that sums and differences fit; often it is exactly at the break in a pixel. */
static void breaks_prepare(struct kernel_call *c)
{
    const uint32_t bits = 5 + random_u32() % 24u, x = random_u32() % STRIDE, row = random_u32() % 4u;
    rows_prepare(c);
    c->word[DZ] = (uint32_t)((int32_t)c->word[DZ] >> bits);
    c->word[DZ_DOWN] = (uint32_t)((int32_t)c->word[DZ_DOWN] >> bits);
    c->word[Z] = (uint32_t)between(-1, 1) - c->word[DZ] * x - c->word[DZ_DOWN] * row;
}

/* In two parts, of which the first is a row. */
static void lines_by(struct kernel_call *c, bool narrow, bool breaks, bool best)
{
    const int32_t *const left = (const int32_t *)&c->word[LEFT], *const right = (const int32_t *)&c->word[RIGHT];
    const int32_t rows = c->n / STRIDE;
    struct flat_lines l = { .x0 = c->n % (STRIDE - COLUMNS), .z = c->word[Z], .dz = c->word[DZ], .dz_down = c->word[DZ_DOWN],
                            .depth = c->plane[1], .depth_bytes = 2 * STRIDE, .narrow = narrow, .breaks = breaks };
    struct edge_fine e;
    l.x1 = l.x0 + COLUMNS;
    l.to_pixels = (uintptr_t)c->plane[0] - (uintptr_t)c->plane[1] * (narrow ? 1u : 2u);
    l.color = narrow ? (c->word[COLOR] & 0xffffu) * 0x10001u : c->word[COLOR];
    edge_fine_start(&e, left, left + 2, -((left[1] + 127) >> 8));
    flat_lines_side(&l, 0, &e);
    edge_fine_start(&e, right, right + 2, -((right[1] + 127) >> 8));
    flat_lines_side(&l, 1, &e);
    for (int32_t part = 1, n = rows; n > 0; n -= part, part = n) {
        if (best)
            flat_lines(&l, part, narrow);
        else
            flat_lines_reference(&l, part);
    }
    c->word[LEFT] = l.x[0][1];
    c->word[RIGHT] = l.x[1][0];
    c->word[Z] = l.z;
}

static void wide_lines(struct kernel_call *c) { lines_by(c, false, false, false); }
static void wide_lines_best(struct kernel_call *c) { lines_by(c, false, false, true); }
static void narrow_lines(struct kernel_call *c) { lines_by(c, true, false, false); }
static void narrow_lines_best(struct kernel_call *c) { lines_by(c, true, false, true); }
static void wide_across(struct kernel_call *c) { lines_by(c, false, true, false); }
static void wide_across_best(struct kernel_call *c) { lines_by(c, false, true, true); }
static void narrow_across(struct kernel_call *c) { lines_by(c, true, true, false); }
static void narrow_across_best(struct kernel_call *c) { lines_by(c, true, true, true); }

KERNELS(flat_run) = {
    { .name = "flat_run", .least = 1, .most = 19, .size = { 4, 2 },
      .form = { { "reference", wide_reference }, { "unrolled", wide_unrolled } VECTOR_FORM("vector", wide_vector),
                { "best", wide_best } } },
    { .name = "flat_run (narrow)", .least = 1, .most = 19, .size = { 2, 2 },
      .form = { { "reference", narrow_reference }, { "unrolled", narrow_unrolled } VECTOR_FORM("vector", narrow_vector),
                { "best", narrow_best } } },
    { .name = "flat_lines", .least = STRIDE, .most = 4 * STRIDE, .size = { 4, 2 }, .prepare = rows_prepare,
      .form = { { "reference", wide_lines }, { "best", wide_lines_best } } },
    { .name = "flat_lines (narrow)", .least = STRIDE, .most = 4 * STRIDE, .size = { 2, 2 }, .prepare = rows_prepare,
      .form = { { "reference", narrow_lines }, { "best", narrow_lines_best } } },
    { .name = "flat_lines (across)", .least = STRIDE, .most = 4 * STRIDE, .size = { 4, 2 }, .prepare = breaks_prepare,
      .form = { { "reference", wide_across }, { "best", wide_across_best } } },
    { .name = "flat_lines (across, narrow)", .least = STRIDE, .most = 4 * STRIDE, .size = { 2, 2 }, .prepare = breaks_prepare,
      .form = { { "reference", narrow_across }, { "best", narrow_across_best } } },
    { .name = NULL }
};
