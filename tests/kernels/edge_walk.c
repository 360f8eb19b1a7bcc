/* SPDX-License-Identifier: MIT */
/* edge_walk.c - how check_kernels calls kernels/edge_walk.h. */
#include "kernels/edge_walk.h"
#include "kernels/flat_lines_armv6m.h"

#include "tests/kernels/kernels.h"

enum { AX, AY, BX, BY, Y };       /* words */

static int32_t word(const struct kernel_call *c, int i) { return (int32_t)c->word[i]; }

/* Edges of all lengths, near to one that ends in a pixel's centre now and then. */
static void prepare(struct kernel_call *c)
{
    const int32_t longest = (1 << 20) - 512, half = longest / 2, most = min_i32(1 << between(4, 20), longest);
    const int32_t ax = between(-half, half), ay = between(-half, half);
    int32_t bx = ax + between(-most, most), by = ay + between(1, between(0, 1) ? most : longest);
    if (between(0, 3) == 0) {
        bx = (bx & ~255) + between(127, 129);
        by = (by & ~255) + 256 + between(127, 129);
    }
    const int32_t first = (ay + 127) >> 8, end = (by + 127) >> 8;
    c->word[AX] = (uint32_t)ax;
    c->word[AY] = (uint32_t)ay;
    c->word[BX] = (uint32_t)bx;
    c->word[BY] = (uint32_t)by;
    c->word[Y] = (uint32_t)(first < end ? between(first, end - 1) : end);
}

/* What all of them are to find: by remainders, exactly. */
struct edge_rest {
    int32_t x;              /* q8: the edge's place at this row's centres,
                             * rounded up; 127 more for edge_pixel */
    int32_t rest;           /* what was added by rounding, in 1/dy: -dy < rest <= 0 */
    int32_t step, step_rest;
    int32_t dy;
};

static void edge_rest_start(struct edge_rest *e, const int32_t *a, const int32_t *b, int32_t y)
{
    const int32_t dx = b[0] - a[0], dy = b[1] - a[1];       /* |dx| <= 2^20 */
    const int32_t first = (a[1] + 127) >> 8;        /* first row below a */
    const int32_t down = first * 256 + 128 - a[1];  /* 0 .. 255 */
    const uint32_t rows = (uint32_t)(y - first);
    e->dy = dy;
    e->x = a[0] + 127;
    e->step = divide_floor(dx * 256, dy, &e->step_rest);
    e->x += divide_floor(dx * down, dy, &e->rest);
    if (rows != 0) {        /* rows < 2^12 - 2^10, rests < 2^20: the sum fits */
        const uint32_t rest = (uint32_t)e->rest + rows * (uint32_t)e->step_rest;
        e->x += e->step * (int32_t)rows + (int32_t)(rest / (uint32_t)dy);
        e->rest = (int32_t)(rest % (uint32_t)dy);
    }
    if (e->rest > 0) {
        e->rest -= dy;
        e->x++;
    }
}

static int32_t edge_rest_pixel(const struct edge_rest *e)
{
    return e->x >> 8;
}

static void edge_rest_step(struct edge_rest *e)
{
    e->x += e->step;
    e->rest += e->step_rest;
    if (e->rest > 0) {
        e->rest -= e->dy;
        e->x++;
    }
}

/* Pixels of up to n rows that have a centre beside the edge. */
#define CALL(NAME, FORM) \
    static void NAME(struct kernel_call *c) \
    { \
        const int32_t a[2] = { word(c, AX), word(c, AY) }, b[2] = { word(c, BX), word(c, BY) }; \
        const int32_t rows = min_i32(((b[1] + 127) >> 8) - word(c, Y), c->n); \
        struct FORM##_walker e; \
        if (rows > 0) \
            FORM##_start(&e, a, b, word(c, Y)); \
        for (int32_t i = 0; i < rows; i++, FORM##_step(&e)) \
            ((int32_t *)c->plane[0])[i] = FORM##_pixel(&e); \
    }

#define edge_rest_walker edge_rest
#define edge_walker edge_walk
CALL(by_rest, edge_rest)
CALL(best, edge)

/* The same by divisions, and without where that will do. */
static void fine_by(struct kernel_call *c, bool divided)
{
    const int32_t a[2] = { word(c, AX), word(c, AY) }, b[2] = { word(c, BX), word(c, BY) };
    const int32_t first = (a[1] + 127) >> 8, rows = min_i32(((b[1] + 127) >> 8) - word(c, Y), c->n);
    const struct edge_way way = edge_way_of(a, b);
    struct edge_fine e;
    if (rows <= 0)
        return;
    if (divided || !edge_fine_near(&e, &way))
        edge_fine_divided(&e, &way);
    if (word(c, Y) != first)
        edge_fine_pass(&e, (uint32_t)(word(c, Y) - first));
    for (int32_t i = 0; i < rows; i++, edge_fine_step(&e))
        ((int32_t *)c->plane[0])[i] = edge_fine_pixel(&e);
}

static void fine_divided(struct kernel_call *c) { fine_by(c, true); }
static void fine_near(struct kernel_call *c) { fine_by(c, false); }

#if SMEAR_FLAT_LINES && SMEAR_ASM_ARMV6M
static void fine_best(struct kernel_call *c)
{
    const int32_t a[2] = { word(c, AX), word(c, AY) }, b[2] = { word(c, BX), word(c, BY) };
    const int32_t first = (a[1] + 127) >> 8, rows = min_i32(((b[1] + 127) >> 8) - word(c, Y), c->n);
    struct flat_lines l;
    if (rows <= 0)
        return;
    if (!flat_lines_side_armv6m(&l, 1, a, b)) {
        fine_near(c);
        return;
    }
    struct edge_fine e = { l.x[1][0], (int32_t)l.x[1][1], l.step[1][0], (int32_t)l.step[1][1] };
    edge_fine_pass(&e, (uint32_t)(word(c, Y) - first));
    for (int32_t i = 0; i < rows; i++, edge_fine_step(&e))
        ((int32_t *)c->plane[0])[i] = edge_fine_pixel(&e);
}
#define BEST , { "best", fine_best }
#else
#define BEST
#endif

KERNELS(edge_walk) = {
    { .name = "edge_walk", .least = 1, .most = 19, .size = { 4 }, .prepare = prepare,
      .form = { { "reference", by_rest }, { "best", best } } },
    { .name = "edge_fine", .least = 1, .most = 19, .size = { 4 }, .prepare = prepare,
      .form = { { "reference", by_rest }, { "divided", fine_divided }, { "near", fine_near } BEST } },
    { .name = NULL }
};
