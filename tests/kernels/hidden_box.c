/* SPDX-License-Identifier: MIT */
/* hidden_box.c - how check_kernels calls kernels/hidden_box.h. */
#include "kernels/hidden_box.h"

#include "tests/kernels/kernels.h"

enum { ROWS, HALF, HIDDEN };

/* In half of all calls everything is hidden, in others all but one pixel are. */
static void prepare(struct kernel_call *c)
{
    uint16_t *const depth = (uint16_t *)c->plane[0];
    c->word[ROWS] = (uint32_t)between(1, c->n < 4 ? c->n : 4);
    c->word[HALF] = (uint32_t)between(0, 0x7fff);
    for (int32_t i = 0; i < 2 * c->n; i++)
        if (depth[i] >> 1 < c->word[HALF])
            depth[i] = (uint16_t)(2u * c->word[HALF] + (depth[i] & 1u));
    if (c->word[HALF] != 0 && between(0, 1) != 0)
        depth[between(0, 2 * c->n - 1)] = (uint16_t)(2u * c->word[HALF] - (uint32_t)between(1, 2));
}

static bool hidden_box_reference(const pixel_word *depth, ptrdiff_t stride, int32_t n, int32_t rows, uint32_t half)
{
    for (; rows > 0; rows--, depth += stride)
        for (int32_t i = 0; i < n; i++)
            if ((depth[i] & 0xffffu) >> 1 < half || depth[i] >> 17 < half)
                return false;
    return true;
}

#define CALL(FORM) \
    static void FORM(struct kernel_call *c) \
    { \
        const int32_t rows = (int32_t)c->word[ROWS], columns = c->n / rows; \
        c->word[HIDDEN] = hidden_box_##FORM((const pixel_word *)c->plane[0], columns, columns, rows, c->word[HALF]); \
    }

CALL(reference)
CALL(unrolled)
VECTORS(CALL(lanes))

KERNELS(hidden_box) = {
    { .name = "hidden_box", .least = 1, .most = 70, .size = { 4 }, .prepare = prepare,
      .form = { { "reference", reference }, { "unrolled", unrolled } VECTOR_FORM("lanes", lanes) } },
    { .name = NULL }
};
