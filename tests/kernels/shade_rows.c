/* SPDX-License-Identifier: MIT */
/* shade_rows.c - how check_kernels calls kernels/shade_rows.h: spans one over the other, of rows that reach beyond the columns
 * which may be written. */
#include "kernels/shade_rows.h"

#include "tests/kernels/kernels.h"

#if SMEAR_AVX2
enum { Z, DZ, COLOR, STEP = COLOR + 3, Q = STEP + 3, DQ, SHAPE, SEED };     /* words */
enum { SPANS = 11, FIRST = 100 };

static void prepare(struct kernel_call *c)
{
    c->word[SEED] = kernel_random();
    c->word[SHAPE] = kernel_random();
    if (kernel_random() % 4u == 0)
        return;
    c->word[Q] = c->word[Q] >> 1 | 1u << 24;
    c->word[DQ] = (uint32_t)((int32_t)c->word[DQ] >> 12);
}

/* Spans of n columns, of which some are drawn; numbers from a seed, so that both forms have the same. */
static void spans_make(struct texel_spans *s, const struct kernel_call *c)
{
    uint32_t seed = c->word[SEED];
    s->count = SPANS;
    for (int i = 0; i < SPANS; i++) {
        seed = seed * 1664525u + 1013904223u;
        const int32_t left = FIRST - 40 + (int32_t)(seed >> 8) % (40 + c->n), most = FIRST + c->n;
        const int32_t wide = 1 + (int32_t)(seed >> 16) % ((seed & 1u) != 0 ? 12 : 200), right = left + wide;
        const int32_t first = max_i32(left, FIRST), end = min_i32(right, most);
        s->row[i] = i;
        s->left[i] = left;
        s->right[i] = first < end ? right : FIRST + c->n;
        s->a[i] = first < end ? first + (int32_t)(seed >> 4 & 15u) % (end - first) : max_i32(left, FIRST);
        s->b[i] = min_i32(s->right[i], most);
        s->z[i] = c->word[Z] + seed;
        s->dz[i] = c->word[DZ];
    }
}

static void rows_by(struct kernel_call *c, bool linear, bool narrow, bool best)
{
    static const int32_t blocks[8] = { 0, 4, 8, 16, 1, 0, 4, 8 };
    struct texel_spans s;
    struct shade_rows t = { .color = narrow ? (void *)((uint16_t *)c->plane[0] - FIRST) : (uint32_t *)c->plane[0] - FIRST,
                            .depth = (uint16_t *)c->plane[1] - FIRST, .x0 = FIRST, .x1 = FIRST + c->n,
                            .light = { .block = blocks[c->word[SHAPE] & 7u], .q = { (int32_t)c->word[Q], (int32_t)c->word[DQ], 5 } },
                            .linear = linear, .narrow = narrow };
    for (int i = 0; i < 3; i++)
        t.light.c[i] = (struct texel_plane){ (int32_t)c->word[COLOR + i], (int32_t)c->word[STEP + i] >> 10, -777 };
    spans_make(&s, c);
    if (best && smear_has_avx2())
        smear_shade_rows_avx2(&t, &s);
    else
        shade_rows_reference(&t, &s);
}

#define ROWS(NAME, LINEAR, NARROW) \
    static void NAME(struct kernel_call *c) { rows_by(c, LINEAR, NARROW, false); } \
    static void NAME##_best(struct kernel_call *c) { rows_by(c, LINEAR, NARROW, true); }
ROWS(codes, false, false)
ROWS(linear, true, false)
ROWS(codes_narrow, false, true)
ROWS(linear_narrow, true, true)
#define KERNEL(NAME, CALL, SIZE) \
    { .name = NAME, .least = SHADE_ROWS_LEAST, .most = 67, .size = { SIZE, 2 }, .prepare = prepare, .timed = 240, \
      .form = { { "reference", CALL }, { "avx2", CALL##_best } } }
#else
#define KERNEL(NAME, CALL, SIZE) { .name = NULL }
#endif

extern const struct kernel kernels_shade_rows[];
const struct kernel kernels_shade_rows[] = {
    KERNEL("shade_rows (codes)", codes, 4),
    KERNEL("shade_rows (linear)", linear, 4),
    KERNEL("shade_rows (codes, narrow)", codes_narrow, 2),
    KERNEL("shade_rows (linear, narrow)", linear_narrow, 2),
    { .name = NULL }
};
