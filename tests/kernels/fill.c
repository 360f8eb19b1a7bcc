/* SPDX-License-Identifier: MIT */
/* fill.c - how check_kernels calls kernels/fill.h. */
#include "kernels/fill.h"

#include "tests/kernels/kernels.h"

static void pixels_fill_reference(uint32_t *p, uint32_t value, int32_t n)
{
    for (int32_t i = 0; i < n; i++)
        p[i] = value;
}

static void pixels_fill_narrow_reference(uint16_t *p, uint32_t value, int32_t n)
{
    for (int32_t i = 0; i < n; i++)
        p[i] = (uint16_t)value;
}

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

/* Three rows: whole ones, or of eights or any number. */
static int32_t row_width(const struct kernel_call *c)
{
    const int32_t width = (int32_t)((c->word[1] >> 4) % (uint32_t)(c->n / 3 + 1));
    return (c->word[1] & 3u) == 0 ? c->n / 3 : (c->word[1] & 3u) == 1 ? width : width & ~7;
}

static void rows_reference(struct kernel_call *c)
{
    for (int32_t i = 0; i < 3; i++)
        pixels_fill_reference((uint32_t *)c->plane[0] + i * (c->n / 3), c->word[0], row_width(c));
}

static void rows_unrolled(struct kernel_call *c) { pixels_fill_rows(c->plane[0], c->word[0], row_width(c), c->n / 3, 3); }

KERNELS(fill) = {
    { .name = "pixels_fill", .most = 150, .size = { 4 },
      .form = { { "reference", words_reference }, { "unrolled", words_unrolled } } },
    { .name = "pixels_fill_narrow", .most = 300, .size = { 2 },
      .form = { { "reference", narrow_reference }, { "unrolled", narrow_unrolled } } },
    { .name = "pixels_fill_rows", .most = 240, .size = { 4 },
      .form = { { "reference", rows_reference }, { "unrolled", rows_unrolled } } },
    { .name = NULL }
};
