/* SPDX-License-Identifier: MIT */
/* depth_range.c - how check_kernels calls kernels/depth_range.h. */
#include "kernels/depth_range.h"

#include "tests/kernels/kernels.h"

enum { ROWS, LEAST, MOST };

/* In some calls one depth stands out. */
static void prepare(struct kernel_call *c)
{
    uint16_t *const depth = (uint16_t *)c->plane[0];
    c->word[ROWS] = (uint32_t)between(1, c->n < 4 ? c->n : 4);
    if (between(0, 1) == 0)
        return;
    for (int32_t i = 0; i < c->n; i++)
        depth[i] = (uint16_t)(0x7ff0 + (depth[i] & 0x1f));
    depth[between(0, c->n - 1)] = (uint16_t)between(0, 0xffff);
}

#define CALL(FORM) \
    static void FORM(struct kernel_call *c) \
    { \
        const int32_t rows = (int32_t)c->word[ROWS], columns = c->n / rows; \
        const struct depth_range range = depth_range_##FORM((const uint16_t *)c->plane[0], columns, columns, rows); \
        c->word[LEAST] = range.least; \
        c->word[MOST] = range.most; \
    }

CALL(reference)
VECTORS(CALL(lanes))

KERNELS(depth_range) = {
    { .name = "depth_range", .least = 1, .most = 140, .size = { 2 }, .prepare = prepare,
      .form = { { "reference", reference } VECTOR_FORM("lanes", lanes) } },
    { .name = NULL }
};
