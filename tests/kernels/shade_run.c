/* SPDX-License-Identifier: MIT */
/* shade_run.c - how check_kernels calls kernels/shade_run.h. */
#include "kernels/shade_run.h"

#include "tests/kernels/kernels.h"

enum { Z, DZ, COLOR, STEP = COLOR + 3, DOWN = STEP + 3, DZ_DOWN = DOWN + 3 };       /* words */
enum { STRIDE = 11 };

static void run_by(struct kernel_call *c, bool linear, bool best)
{
    struct shade k;
    for (int i = 0; i < 3; i++) {
        k.c[i] = c->word[COLOR + i];
        k.d[i] = c->word[STEP + i];
    }
#if SMEAR_AVX2
    if (best && c->n >= 4 && smear_has_avx2()) {
        smear_shade_run_avx2(c->plane[0], c->plane[1], c->n, c->word[Z], c->word[DZ], &k, linear);
        return;
    }
#elif SMEAR_ASM_ARMV6M
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

/* Rows of up to eight pixels between three edges, which the words of colours tell, too. */
static void box_by(struct kernel_call *c, bool linear, bool narrow, bool best)
{
    struct shade_box b = { .pixels = c->plane[0], .depth = c->plane[1], .stride = STRIDE, .rows = (c->n - SHADE_BOX) / STRIDE + 1,
                           .z = c->word[Z], .dz = c->word[DZ], .dz_down = c->word[DZ_DOWN], .linear = linear, .narrow = narrow };
    for (int i = 0; i < 3; i++) {
        b.k.c[i] = c->word[COLOR + i];
        b.k.d[i] = c->word[STEP + i];
        b.k_down[i] = c->word[DOWN + i];
        b.e[i] = (int32_t)(c->word[COLOR + i] >> 13) - (1 << 17);
        b.e_right[i] = (int32_t)(c->word[STEP + i] & 0xffffu) - (1 << 15);
        b.e_down[i] = (int32_t)(c->word[DOWN + i] & 0xffffu) - (1 << 15);
    }
#if SMEAR_AVX2
    if (best && smear_has_avx2()) {
        smear_shade_box_avx2(&b);
        return;
    }
#else
    (void)best;
#endif
    shade_box_reference(&b);
}

#define BOX(NAME, LINEAR, NARROW) \
    static void NAME(struct kernel_call *c) { box_by(c, LINEAR, NARROW, false); } \
    static void NAME##_best(struct kernel_call *c) { box_by(c, LINEAR, NARROW, true); }
BOX(box, false, false)
BOX(box_linear, true, false)
BOX(box_narrow, false, true)
BOX(box_linear_narrow, true, true)
#define BOX_KERNEL(TEXT, CALL, BYTES) \
    { .name = TEXT, .least = SHADE_BOX, .most = 8 * STRIDE, .size = { BYTES, 2 }, .timed = 8 * STRIDE, \
      .form = { { "reference", CALL }, { "best", CALL##_best } } }

extern const struct kernel kernels_shade_run[];
const struct kernel kernels_shade_run[] = {
    { .name = "shade_run (linear)", .least = 1, .most = 19, .size = { 4, 2 }, .timed = 16,
      .form = { { "reference", linear_reference }, { "best", linear_best } } },
    { .name = "shade_run (codes)", .least = 1, .most = 19, .size = { 4, 2 }, .timed = 16,
      .form = { { "reference", codes_reference }, { "best", codes_best } } },
    BOX_KERNEL("shade_box (codes)", box, 4),
    BOX_KERNEL("shade_box (linear)", box_linear, 4),
    BOX_KERNEL("shade_box (codes, narrow)", box_narrow, 2),
    BOX_KERNEL("shade_box (linear, narrow)", box_linear_narrow, 2),
    { .name = NULL }
};
