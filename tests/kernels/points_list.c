/* SPDX-License-Identifier: MIT */
/* points_list.c - how check_kernels calls kernels/points_list.h. */
#include "kernels/points_list.h"

#include "tests/kernels/kernels.h"

enum { WIDTH = 7, STRIDE = 9, NEXT };      /* words */

/* Each entry is followed by that below it; the last one, and some others, are no points. */
static void prepare(struct kernel_call *c)
{
    struct point_entry *entry = c->plane[2];
    for (int32_t i = 0; i < c->n; i++) {
        struct point_entry *e = &entry[c->n - 1 - i];
        e->x = (uint16_t)kernel_between(0, WIDTH + 3);
        e->y = (uint16_t)kernel_between(0, 4);
        e->kind = i == c->n - 1 || kernel_between(0, 19) == 0 ? 3 : POINT_ENTRY;
        e->next = i + 2 < c->n || kernel_between(0, 1) == 0 ? (uint32_t)i + 1 : UINT32_MAX;
    }
}

/* The entries draw into as many pixels as there are of them, in rows. */
static void call(struct kernel_call *c, bool narrow, bool best)
{
    if (c->n == 0)
        return;
    const struct points_plane p = { (const struct point_entry *)c->plane[2] + (c->n - 1), 2, (uint32_t)(c->n < WIDTH ? c->n : WIDTH), 1,
                                    (uint32_t)(c->n < STRIDE ? 1 : c->n / STRIDE), STRIDE, c->plane[0], c->plane[1], 0, 0 };
    c->word[NEXT] = best ? points_list(&p, 0, narrow) : points_list_reference(&p, 0, narrow);
}

static void wide_reference(struct kernel_call *c) { call(c, false, false); }
static void wide_best(struct kernel_call *c) { call(c, false, true); }
static void narrow_reference(struct kernel_call *c) { call(c, true, false); }
static void narrow_best(struct kernel_call *c) { call(c, true, true); }

extern const struct kernel kernels_points_list[];
const struct kernel kernels_points_list[] = {
    { .name = "points_list", .most = 35, .size = { 2, 4, 16 }, .align = { 2, 4, 4 }, .prepare = prepare, .timed = 35,
      .form = { { "reference", wide_reference }, { "best", wide_best } } },
    { .name = "points_list (narrow)", .most = 35, .size = { 2, 2, 16 }, .align = { 2, 2, 4 }, .prepare = prepare, .timed = 35,
      .form = { { "reference", narrow_reference }, { "best", narrow_best } } },
    { .name = NULL }
};
