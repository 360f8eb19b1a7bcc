/* SPDX-License-Identifier: MIT */
/* hidden_run.c - how check_kernels calls kernels/hidden_run.h. */
#include "kernels/hidden_run.h"

#include "tests/kernels/kernels.h"

enum { Z, DZ, HIDDEN };

/* Most pixels are hidden, so that runs are long. */
static void prepare(struct kernel_call *c)
{
    c->word[Z] >>= 5;
    c->word[DZ] >>= 10;
}

#define CALL(FORM) \
    static void FORM(struct kernel_call *c) \
    { \
        c->word[HIDDEN] = (uint32_t)hidden_run_##FORM(c->plane[0], c->n, c->word[Z], c->word[DZ]); \
    }

CALL(reference)
#if SMEAR_VECTORS
CALL(vector)
#define VECTOR , { "vector", vector }
#else
#define VECTOR
#endif

extern const struct kernel kernels_hidden_run[];
const struct kernel kernels_hidden_run[] = {
    { .name = "hidden_run", .most = 35, .size = { 2 }, .prepare = prepare,
      .form = { { "reference", reference } VECTOR } },
    { .name = NULL }
};
