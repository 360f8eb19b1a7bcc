/* SPDX-License-Identifier: MIT */
/* shade_run.c - how check_kernels calls kernels/shade_run.h. */
#include "kernels/shade_run.h"

#include "tests/kernels/kernels.h"

enum { Z, DZ, COLOR, STEP = COLOR + 3 };       /* words */

static void run_by(struct kernel_call *c, bool linear, bool avx2)
{
    struct shade k;
    for (int i = 0; i < 3; i++) {
        k.c[i] = c->word[COLOR + i];
        k.d[i] = c->word[STEP + i];
    }
#if SMEAR_AVX2
    if (avx2 && c->n >= 4 && smear_has_avx2()) {
        smear_shade_run_avx2(c->plane[0], c->plane[1], c->n, c->word[Z], c->word[DZ], &k, linear);
        return;
    }
#else
    (void)avx2;
#endif
    shade_run_reference(c->plane[0], c->plane[1], c->n, c->word[Z], c->word[DZ], &k, linear, false);
}

static void linear_reference(struct kernel_call *c) { run_by(c, true, false); }
static void linear_best(struct kernel_call *c) { run_by(c, true, true); }
static void codes_reference(struct kernel_call *c) { run_by(c, false, false); }
static void codes_best(struct kernel_call *c) { run_by(c, false, true); }

extern const struct kernel kernels_shade_run[];
const struct kernel kernels_shade_run[] = {
    { .name = "shade_run (linear)", .least = 1, .most = 19, .size = { 4, 2 }, .timed = 16,
      .form = { { "reference", linear_reference }, { "best", linear_best } } },
    { .name = "shade_run (codes)", .least = 1, .most = 19, .size = { 4, 2 }, .timed = 16,
      .form = { { "reference", codes_reference }, { "best", codes_best } } },
    { .name = NULL }
};
