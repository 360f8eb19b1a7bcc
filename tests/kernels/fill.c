/* SPDX-License-Identifier: MIT */
/* fill.c - how check_kernels calls kernels/fill.h. */
#include "kernels/fill.h"

#include "tests/kernels/kernels.h"

static void words_reference(struct kernel_call *c) { pixels_fill_reference(c->plane[0], c->word[0], c->n); }
static void words_unrolled(struct kernel_call *c) { pixels_fill(c->plane[0], c->word[0], c->n); }

static void narrow_reference(struct kernel_call *c)
{
    pixels_fill_narrow_reference(c->plane[0], c->word[0] & 0xffffu, c->n);
}

static void narrow_unrolled(struct kernel_call *c)
{
    pixels_fill_narrow(c->plane[0], c->word[0] & 0xffffu, c->n);
}


extern const struct kernel kernels_fill[];
const struct kernel kernels_fill[] = {
    { .name = "pixels_fill", .most = 150, .size = { 4 },
      .form = { { "reference", words_reference }, { "unrolled", words_unrolled } } },
    { .name = "pixels_fill_narrow", .most = 300, .size = { 2 },
      .form = { { "reference", narrow_reference }, { "unrolled", narrow_unrolled } } },
    { .name = NULL }
};
