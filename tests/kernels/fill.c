/* SPDX-License-Identifier: MIT */
/* fill.c - how check_kernels calls kernels/fill.h. */
#include "kernels/fill.h"

#include "tests/kernels/kernels.h"

static void words_reference(struct kernel_call *c) { pixels_fill_reference(c->plane[0], c->word[0], c->n); }
static void words_unrolled(struct kernel_call *c) { pixels_fill_unrolled(c->plane[0], c->word[0], c->n); }

static void narrow_reference(struct kernel_call *c)
{
    pixels_fill_narrow_reference(c->plane[0], c->word[0] & 0xffffu, c->n);
}

static void narrow_unrolled(struct kernel_call *c)
{
    pixels_fill_narrow_unrolled(c->plane[0], c->word[0] & 0xffffu, c->n);
}

#if SMEAR_AVX2
static void words_avx2(struct kernel_call *c)
{
    if (c->n < 8)
        pixels_fill_reference(c->plane[0], c->word[0], c->n);
    else
        smear_fill_avx2(c->plane[0], c->word[0], (size_t)c->n * 4);
}

static void narrow_avx2(struct kernel_call *c)
{
    if (c->n < 16)
        pixels_fill_narrow_reference(c->plane[0], c->word[0] & 0xffffu, c->n);
    else
        smear_fill_avx2(c->plane[0], (c->word[0] & 0xffffu) * 0x10001u, (size_t)c->n * 2);
}
#endif

extern const struct kernel kernels_fill[];
const struct kernel kernels_fill[] = {
    { .name = "pixels_fill", .most = 150, .size = { 4 },
      .form = { { "reference", words_reference }, { "unrolled", words_unrolled },
#if SMEAR_AVX2
                { "avx2", words_avx2 },
#endif
      } },
    { .name = "pixels_fill_narrow", .most = 300, .size = { 2 },
      .form = { { "reference", narrow_reference }, { "unrolled", narrow_unrolled },
#if SMEAR_AVX2
                { "avx2", narrow_avx2 },
#endif
      } },
    { .name = NULL }
};
