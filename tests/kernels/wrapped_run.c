/* SPDX-License-Identifier: MIT */
/* wrapped_run.c - how check_kernels calls kernels/wrapped_run.h: pictures of up to 64 texels, walks that are slow or any. */
#include "kernels/wrapped_run.h"

#include "tests/kernels/kernels.h"

enum { AT, STEP = 2, CHANGE = 4, SHAPE = 6 };       /* words */

static void prepare_walk(struct kernel_call *c)
{
    c->bytes[1] = 64 * 4;
    if (kernel_random() % 4u == 0)
        return;
    c->word[STEP + 1] = (uint32_t)((int32_t)c->word[STEP + 1] >> 14);
    c->word[CHANGE + 1] = (uint32_t)((int32_t)c->word[CHANGE + 1] >> 20);
    if ((kernel_random() & 1u) != 0)
        c->word[CHANGE] = c->word[CHANGE + 1] = 0;
}

static uint64_t pair(const struct kernel_call *c, int word)
{
    return (uint64_t)c->word[word + 1] << 32 | c->word[word];
}

static void walk_by(struct kernel_call *c, bool best)
{
    const uint32_t shape = c->word[SHAPE];
    const int32_t width = (int32_t)(shape & 7u) + 1, height = (int32_t)(shape >> 3 & 7u) + 1;
    const struct wrapped_texels t = { c->plane[1], width, height, (int)((shape >> 6 & 255u) % 3u), (int)((shape >> 14 & 255u) % 3u) };
    const struct wrapped_walk w = { pair(c, AT), pair(c, STEP), pair(c, CHANGE) };
#if SMEAR_AVX2
    if (best && smear_has_avx2()) {
        smear_wrapped_run_avx2(c->plane[0], &t, &w, c->n);
        return;
    }
#else
    (void)best;
#endif
    wrapped_run_reference(c->plane[0], &t, w, c->n);
}

static void walk(struct kernel_call *c) { walk_by(c, false); }
static void walk_best(struct kernel_call *c) { walk_by(c, true); }

static void nearer_by_reference(struct kernel_call *c)
{
    nearer_run_reference(c->plane[0], c->plane[1], c->plane[2], c->n, c->word[0], c->word[1]);
}

static void nearer_best(struct kernel_call *c)
{
#if SMEAR_AVX2
    if (c->n >= 8 && smear_has_avx2()) {
        smear_nearer_run_avx2(c->plane[0], c->plane[1], c->plane[2], c->n, c->word[0], c->word[1]);
        return;
    }
#endif
    nearer_by_reference(c);
}

extern const struct kernel kernels_wrapped_run[];
const struct kernel kernels_wrapped_run[] = {
    { .name = "wrapped_run", .most = 35, .size = { 4, 4 }, .prepare = prepare_walk, .timed = 16,
      .form = { { "reference", walk }, { "best", walk_best } } },
    { .name = "nearer_run", .most = 35, .size = { 4, 2, 4 }, .timed = 16,
      .form = { { "reference", nearer_by_reference }, { "best", nearer_best } } },
    { .name = NULL }
};
