/* SPDX-License-Identifier: MIT */
/* box_sides.c - how check_kernels calls kernels/box_sides.h. */
#include "kernels/box_sides.h"

#include "base/fixmath.h"
#include "tests/kernels/kernels.h"

/* Words: the three corners, x and y, q8 px from the box; its left side, its columns, the frame's width. */
enum { CORNERS, LEFT = 6, COLUMNS, WIDTH };

/* Triangles in and around boxes of all widths, some with corners in pixels' centres; degenerate ones, too. */
static void prepare(struct kernel_call *c)
{
    const int32_t columns = kernel_between(1, BOX_SIDES_COLUMNS), grid = kernel_between(0, 1) ? 127 : 0;
    for (int i = 0; i < 6; i++)
        c->word[CORNERS + i] = (uint32_t)((kernel_between(0, 256 * (i % 2 == 0 ? columns : 16)) & ~grid));
    c->word[LEFT] = (uint32_t)kernel_between(-20, 40);
    c->word[COLUMNS] = (uint32_t)columns;
    c->word[WIDTH] = (uint32_t)kernel_between(0, 60);
}

static void sides_by(struct kernel_call *c, void (*form)(struct span_side *side, struct box_sides *b, int32_t n))
{
    const int32_t *const v = (const int32_t *)c->word;
    struct box_sides b = { .left = v[LEFT], .columns = v[COLUMNS], .width = v[WIDTH] };
    for (int k = 0; k < 3; k++) {
        const int32_t *const from = v + 2 * k, *const to = v + 2 * ((k + 1) % 3), dx = to[0] - from[0], dy = to[1] - from[1];
        b.e[k] = dx * (128 - from[1]) - dy * (128 - from[0]);
        b.right[k] = -dy * 256;
        b.down[k] = dx * 256;
    }
    form(c->plane[0], &b, c->n);
    for (int k = 0; k < 3; k++)
        c->word[k] = (uint32_t)b.e[k];
}

static void reference(struct kernel_call *c) { sides_by(c, box_sides_reference); }
static void best(struct kernel_call *c) { sides_by(c, box_sides); }

extern const struct kernel kernels_box_sides[];
const struct kernel kernels_box_sides[] = {
    { .name = "box_sides", .least = 1, .most = 19, .size = { 12 }, .align = { 4 }, .prepare = prepare, .timed = 16,
      .form = { { "reference", reference }, { "best", best } } },
    { .name = NULL }
};
