/* SPDX-License-Identifier: MIT */
/* flat_run.c - how check_kernels calls kernels/flat_run.h. */
#include "kernels/flat_run.h"

#include "tests/kernels/kernels.h"

enum { Z, DZ, COLOR };      /* words */

#define CALLS(FORM) \
    static void wide_##FORM(struct kernel_call *c) \
    { \
        flat_run_##FORM(c->plane[0], c->plane[1], c->n, c->word[Z], c->word[DZ], c->word[COLOR], false); \
    } \
    static void narrow_##FORM(struct kernel_call *c) \
    { \
        flat_run_##FORM(c->plane[0], c->plane[1], c->n, c->word[Z], c->word[DZ], c->word[COLOR] & 0xffffu, true); \
    }

CALLS(reference)
CALLS(unrolled)
#if SMEAR_VECTORS
CALLS(vector)
#define VECTOR(CALL) , { "vector", CALL }
#else
#define VECTOR(CALL)
#endif

static void wide_best(struct kernel_call *c)
{
    flat_run(c->plane[0], c->plane[1], c->n, c->word[Z], c->word[DZ], c->word[COLOR], false);
}

static void narrow_best(struct kernel_call *c)
{
    flat_run(c->plane[0], c->plane[1], c->n, c->word[Z], c->word[DZ], c->word[COLOR] & 0xffffu, true);
}

extern const struct kernel kernels_flat_run[];
const struct kernel kernels_flat_run[] = {
    { .name = "flat_run", .least = 1, .most = 19, .size = { 4, 2 },
      .form = { { "reference", wide_reference }, { "unrolled", wide_unrolled } VECTOR(wide_vector), { "best", wide_best } } },
    { .name = "flat_run (narrow)", .least = 1, .most = 19, .size = { 2, 2 },
      .form = { { "reference", narrow_reference }, { "unrolled", narrow_unrolled } VECTOR(narrow_vector),
                { "best", narrow_best } } },
    { .name = NULL }
};
