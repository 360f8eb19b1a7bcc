/* SPDX-License-Identifier: MIT */
/* linear_runs.c - how check_kernels calls kernels/linear_runs.h: alphas that are often 0 or 255, light that is often even. */
#include "kernels/linear_runs.h"

#include "tests/kernels/kernels.h"

/* ------------------------------------------------------------------ texels in light */

static void light(struct kernel_call *c, void (*fn)(uint32_t *texel, int32_t n, const struct light_ramp *k))
{
    struct light_ramp k;
    for (int i = 0; i < 4; i++) {
        k.c[i] = c->word[i];
        k.d[i] = (c->word[8] & 3u) == 0 ? 0 : c->word[4 + i];
    }
    fn(c->plane[0], c->n, &k);
}

static void light_reference(struct kernel_call *c) { light(c, light_texels_reference); }
static void light_best(struct kernel_call *c) { light(c, light_texels); }

/* ------------------------------------------------------------------ blends */

static void prepare_blend(struct kernel_call *c)
{
    uint32_t *in = c->plane[2];
    for (int32_t i = 0; i < c->n; i++) {
        const uint32_t kind = kernel_random() & 3u;
        in[i] = kind == 0 ? in[i] & 0xffffffu : kind == 1 ? in[i] | 0xff000000u : in[i];
    }
}

static void blend_by_reference(struct kernel_call *c)
{
    blend_linear_reference(c->plane[0], c->plane[1], c->plane[2], c->n, c->word[0], c->word[1]);
}

static void blend_best(struct kernel_call *c)
{
    blend_linear(c->plane[0], c->plane[1], c->plane[2], c->n, c->word[0], c->word[1]);
}

extern const struct kernel kernels_linear_runs[];
const struct kernel kernels_linear_runs[] = {
    { .name = "light_texels", .most = 35, .size = { 4 }, .timed = 16,
      .form = { { "reference", light_reference }, { "best", light_best } } },
    { .name = "blend_linear", .most = 35, .size = { 4, 2, 4 }, .prepare = prepare_blend, .timed = 16,
      .form = { { "reference", blend_by_reference }, { "best", blend_best } } },
    { .name = NULL }
};
