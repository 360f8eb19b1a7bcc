/* SPDX-License-Identifier: MIT */
/* pixel_steps.c - how check_kernels calls kernels/pixel_steps.h. */
#include "kernels/pixel_steps.h"

#include "tests/kernels/kernels.h"

enum { LEAST, FIRST, FOUND };

/* Pixels differ by about as much as it takes, and seldom. */
static void prepare(struct kernel_call *c)
{
    uint32_t *const a = c->plane[0], *const b = c->plane[1];
    c->word[LEAST] = (uint32_t)between(0, 32);
    c->word[FIRST] = (uint32_t)between(0, c->n);
    for (int32_t i = 0; i < c->n; i++) {
        const int shift = 8 * between(0, 3);
        const uint32_t code = a[i] >> shift & 255u, step = c->word[LEAST] + (between(0, 7) == 0 ? 1u : 0u);
        b[i] = (a[i] & ~(255u << shift)) | (code + step < 256 ? code + step : code - step) << shift;
    }
}

#define CALL(FORM) \
    static void FORM(struct kernel_call *c) \
    { \
        c->word[FOUND] = (uint32_t)next_step_##FORM(c->plane[0], c->plane[1], (int32_t)c->word[FIRST], c->n, (int32_t)c->word[LEAST]); \
    }

CALL(reference)
VECTORS(CALL(vector))

KERNELS(pixel_steps) = {
    { .name = "next_step", .most = 40, .size = { 4, 4 }, .prepare = prepare, .timed = 40,
      .form = { { "reference", reference } VECTOR_FORM("vector", vector) } },
    { .name = NULL }
};
