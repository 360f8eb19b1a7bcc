/* SPDX-License-Identifier: MIT */
/* shade_run.c - how check_kernels calls kernels/shade_run.h. */
#include "kernels/shade_run.h"

#include "tests/kernels/kernels.h"

enum { Z, DZ, COLOR, STEP = COLOR + 3 };       /* words */

static void run_by(struct kernel_call *c, bool linear, bool best)
{
    struct shade k;
    for (int i = 0; i < 3; i++) {
        k.c[i] = c->word[COLOR + i];
        k.d[i] = c->word[STEP + i];
    }
#if SMEAR_ASM_ARMV6M
    if (best && !linear) {
        shade_run_armv6m(c->plane[0], c->plane[1], c->n, c->word[Z], c->word[DZ], &k);
        return;
    }
#else
    (void)best;
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
