/* SPDX-License-Identifier: MIT */
/* blend_rows.c - how check_kernels calls kernels/blend_rows.h: spans one over the other, in rows some of which turn back; alphas
 * that are often 0 or 255. */
#include "kernels/blend_rows.h"

#include "tests/kernels/kernels.h"

#if SMEAR_AVX2
enum { Z, DZ, OVER, SEED };     /* words */
enum { SPANS = 11, FIRST = 100, TURN = 8 };

static void prepare(struct kernel_call *c)
{
    const uint32_t kind = kernel_random() & 3u;
    c->word[SEED] = kernel_random();
    c->word[OVER] = kind == 0 ? c->word[OVER] & 0xffffffu : kind == 1 ? c->word[OVER] | 0xff000000u : c->word[OVER];
}

/* Spans of so many columns. */
static void spans_make(struct texel_spans *s, const struct kernel_call *c, int32_t columns)
{
    uint32_t seed = c->word[SEED];
    s->count = SPANS;
    for (int i = 0; i < SPANS; i++) {
        seed = seed * 1664525u + 1013904223u;
        const int32_t a = FIRST + (int32_t)(seed >> 8) % columns, most = FIRST + columns - a;
        s->row[i] = i;
        s->left[i] = s->a[i] = a;
        s->right[i] = s->b[i] = a + 1 + (int32_t)(seed >> 16) % ((seed & 1u) != 0 ? min_i32(most, 9) : most);
        s->z[i] = c->word[Z] + seed;
        s->dz[i] = c->word[DZ];
    }
}

/* Rows all lie in the same memory, but for the colours of the last ones: a pixel farther back. */
static void rows_by(struct kernel_call *c, bool linear, bool best)
{
    struct texel_spans s;
    const struct blend_rows t = { .color = (uint32_t *)c->plane[0] - FIRST + 1, .depth = (const uint16_t *)c->plane[1] - FIRST,
                                  .x0 = FIRST, .x1 = FIRST + c->n - 1, .turn = TURN, .back = 1, .over = c->word[OVER], .linear = linear };
    spans_make(&s, c, c->n - 1);
    if (best && smear_has_avx2())
        smear_blend_rows_avx2(&t, &s);
    else
        blend_rows_reference(&t, &s);
}

static void codes(struct kernel_call *c) { rows_by(c, false, false); }
static void codes_best(struct kernel_call *c) { rows_by(c, false, true); }
static void linear(struct kernel_call *c) { rows_by(c, true, false); }
static void linear_best(struct kernel_call *c) { rows_by(c, true, true); }
#define KERNEL(NAME, CALL) \
    { .name = NAME, .least = BLEND_ROWS_LEAST + 1, .most = 67, .size = { 4, 2 }, .prepare = prepare, .timed = 240, \
      .form = { { "reference", CALL }, { "avx2", CALL##_best } } }
#else
#define KERNEL(NAME, CALL) { .name = NULL }
#endif

extern const struct kernel kernels_blend_rows[];
const struct kernel kernels_blend_rows[] = {
    KERNEL("blend_rows (codes)", codes),
    KERNEL("blend_rows (linear)", linear),
    { .name = NULL }
};
