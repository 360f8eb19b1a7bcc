/* SPDX-License-Identifier: MIT */
/* pixel_rows.c - how check_kernels calls kernels/pixel_rows.h. */
#include "kernels/pixel_rows.h"

#include "tests/kernels/kernels.h"

/* Words of a call: the first column, the layout, whether L4 is dithered, eight thresholds. */
enum { X, LAYOUT, IS_DITHERED, THRESHOLDS, WIDTH = 8 };

static void xrgb8888_reference(struct kernel_call *c) { row_xrgb8888_reference(c->plane[0], c->plane[1], c->n); }
#if SMEAR_VECTORS
static void xrgb8888_vector(struct kernel_call *c) { row_xrgb8888_vector(c->plane[0], c->plane[1], c->n); }
#endif

static void prepare_nearest(struct kernel_call *c) { c->word[LAYOUT] &= 1u; }

static void rgb565_reference(struct kernel_call *c)
{
    row_rgb565_reference(c->plane[0], c->plane[1], c->n, c->word[LAYOUT] != 0);
}

static void rgb565_unrolled(struct kernel_call *c)
{
    smear_row_rgb565_unrolled(c->plane[0], c->plane[1], c->n, c->word[LAYOUT] != 0);
}

static void prepare_dithered(struct kernel_call *c)
{
    c->word[X] &= 15u;
    c->word[LAYOUT] %= 3u;
    for (int i = 0; i < WIDTH; i++)
        c->word[THRESHOLDS + i] = 4u * (c->word[THRESHOLDS + i] & 63u) + 2u;
}

static const uint8_t *thresholds(const struct kernel_call *c)
{
    static uint8_t row[WIDTH];
    for (int i = 0; i < WIDTH; i++)
        row[i] = (uint8_t)c->word[THRESHOLDS + i];
    return row;
}

static void dithered_reference(struct kernel_call *c)
{
    row_dithered_reference(c->plane[0], c->plane[1], c->n, (int32_t)c->word[X], thresholds(c), WIDTH - 1,
                           (enum row_16bit)c->word[LAYOUT]);
}

/* A row of L4 begins with column 0, which lies X / 2 bytes before what is written. */
static void prepare_l4(struct kernel_call *c)
{
    prepare_dithered(c);
    c->word[X] &= 8u;
    c->word[IS_DITHERED] &= 1u;
    c->bytes[0] = ((int32_t)c->word[X] + c->n + 1) / 2;
}

static void l4_reference(struct kernel_call *c)
{
    row_l4_reference(c->plane[0], c->plane[1], c->n, (int32_t)c->word[X],
                     c->word[IS_DITHERED] != 0 ? thresholds(c) : NULL, WIDTH - 1);
}

#ifndef __OPTIMIZE_SIZE__
static void dithered_blocks(struct kernel_call *c)
{
    smear_row_dithered_blocks(c->plane[0], c->plane[1], c->n, (int32_t)c->word[X], thresholds(c),
                              (enum row_16bit)c->word[LAYOUT]);
}

static void l4_blocks(struct kernel_call *c)
{
    smear_row_l4_blocks(c->plane[0], c->plane[1], c->n, (int32_t)c->word[X],
                        c->word[IS_DITHERED] != 0 ? thresholds(c) : NULL);
}
#endif

extern const struct kernel kernels_pixel_rows[];
const struct kernel kernels_pixel_rows[] = {
    { .name = "row_xrgb8888", .most = 35, .size = { 4, 4 },
      .form = { { "reference", xrgb8888_reference },
#if SMEAR_VECTORS
                { "vector", xrgb8888_vector },
#endif
      } },
    { .name = "row_rgb565", .most = 67, .size = { 2, 4 }, .prepare = prepare_nearest,
      .form = { { "reference", rgb565_reference }, { "unrolled", rgb565_unrolled } } },
    { .name = "row_dithered", .most = 67, .size = { 2, 4 }, .prepare = prepare_dithered,
      .form = { { "reference", dithered_reference },
#ifndef __OPTIMIZE_SIZE__
                { "blocks", dithered_blocks },
#endif
      } },
    { .name = "row_l4", .most = 67, .size = { 1, 4 }, .prepare = prepare_l4,
      .form = { { "reference", l4_reference },
#ifndef __OPTIMIZE_SIZE__
                { "blocks", l4_blocks },
#endif
      } },
    { .name = NULL }
};
