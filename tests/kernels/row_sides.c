/* SPDX-License-Identifier: MIT */
/* row_sides.c - how check_kernels calls kernels/row_sides.h: n rows of a triangle, or as many as it has from some row on. */
#include "kernels/row_sides.h"

#include "kernels/avx2.h"
#include "tests/kernels/kernels.h"

enum { CORNERS, Y = 6, WIDTH };      /* words */

/* Corners of a triangle that is clockwise on the screen, far away now and then, and some on one level. */
static void prepare(struct kernel_call *c)
{
    const int32_t far = kernel_between(0, 3) == 0 ? 100000 : 3000;
    int32_t *const at = (int32_t *)&c->word[CORNERS];
    for (int i = 0; i < 6; i++)
        at[i] = kernel_between(-far / 2, 256 * c->n + far / 2);
    if (kernel_between(0, 3) == 0)
        at[3] = at[1];
    const int64_t area = (int64_t)(at[2] - at[0]) * (at[5] - at[1]) - (int64_t)(at[4] - at[0]) * (at[3] - at[1]);
    for (int i = 0; i < 2 && area < 0; i++) {
        const int32_t swap = at[2 + i];
        at[2 + i] = at[4 + i];
        at[4 + i] = swap;
    }
    c->word[Y] = (uint32_t)kernel_between(-far / 512, c->n);
    c->word[WIDTH] = (uint32_t)kernel_between(0, 60);
}

static void sides_by(struct kernel_call *c, bool best)
{
    const int32_t *const at = (const int32_t *)&c->word[CORNERS], width = (int32_t)c->word[WIDTH];
    const int32_t *const corner[3] = { at, at + 2, at + 4 };
    struct span_side side[ROW_SIDES];
    struct corners k;
    corners_find(&k, corner, (int32_t)c->word[Y], INT16_MAX);
    const int32_t n = min_i32(k.end - k.first, c->n);
    if (n <= 0)
        return;
#if SMEAR_AVX2
    if (best && smear_has_avx2())
        smear_row_sides_avx2(side, &k, k.first, n, width);
    else
#else
    (void)best;
#endif
        row_sides_reference(side, &k, k.first, n, width);
    for (int32_t i = 0; i < n; i++)
        ((struct span_side *)c->plane[0])[i] = side[i];
}

static void reference(struct kernel_call *c) { sides_by(c, false); }
static void best(struct kernel_call *c) { sides_by(c, true); }

/* The same, but made ready once, and found in parts of some rows. */
static void carried(struct kernel_call *c)
{
#if SMEAR_AVX2
    const int32_t *const at = (const int32_t *)&c->word[CORNERS], *const corner[3] = { at, at + 2, at + 4 };
    struct corners k;
    corners_find(&k, corner, (int32_t)c->word[Y], INT16_MAX);
    const int32_t end = k.first + min_i32(k.end - k.first, c->n);
    if (smear_has_avx2()) {
        struct carried_sides sides;
        if (k.first < end)
            smear_sides_carry_avx2(&sides, corner, k.first);
        for (int32_t y = k.first, next; y < end; y = next) {
            struct span_side side[ROW_SIDES];
            next = min_i32(y + 1 + (y & INT16_MAX) % 11, end);
            carried_sides_go(&sides, y - sides.y);
            smear_row_sides_carried_avx2(side, &sides, next - y, (int32_t)c->word[WIDTH]);
            for (int32_t i = y; i < next; i++)
                ((struct span_side *)c->plane[0])[i - k.first] = side[i - y];
        }
        return;
    }
#endif
    sides_by(c, false);
}

extern const struct kernel kernels_row_sides[];
const struct kernel kernels_row_sides[] = {
    { .name = "row_sides", .least = 1, .most = 29, .size = { 12 }, .align = { 4 }, .prepare = prepare, .timed = 29,
      .form = { { "reference", reference }, { "best", best }, { "carried", carried } } },
    { .name = NULL }
};
