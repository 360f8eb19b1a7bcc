/* SPDX-License-Identifier: MIT */
/* pixel_rows.c - how check_kernels calls kernels/pixel_rows.h. */
#include "kernels/pixel_rows.h"

#include "tests/kernels/kernels.h"

/* Words of a call: the first column, the layout, whether L4 is dithered, eight thresholds, the first row. */
enum { X, LAYOUT, IS_DITHERED, THRESHOLDS, WIDTH = 8, Y = THRESHOLDS + WIDTH };

static void xrgb8888_reference(struct kernel_call *c) { row_xrgb8888_reference(c->plane[0], c->plane[1], c->n); }
#if SMEAR_VECTORS
static void xrgb8888_vector(struct kernel_call *c) { row_xrgb8888_vector(c->plane[0], c->plane[1], c->n); }
#endif

static void prepare_nearest(struct kernel_call *c) { c->word[LAYOUT] %= 3u; }

static void nearest_reference(struct kernel_call *c)
{
    row_nearest_reference(c->plane[0], c->plane[1], c->n, (enum row_16bit)c->word[LAYOUT]);
}

#if SMEAR_VECTORS && !defined(__OPTIMIZE_SIZE__)
static void nearest_vector(struct kernel_call *c)
{
    smear_row_nearest_vector(c->plane[0], c->plane[1], c->n, (enum row_16bit)c->word[LAYOUT]);
}
#endif

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

#if SMEAR_VECTORS && !defined(__OPTIMIZE_SIZE__)
static void dithered_vector(struct kernel_call *c)
{
    smear_row_dithered_vector(c->plane[0], c->plane[1], c->n, (int32_t)c->word[X], thresholds(c), WIDTH - 1,
                              (enum row_16bit)c->word[LAYOUT]);
}

/* Thresholds of any kind, 32 of them. */
static const uint8_t *many_thresholds(const struct kernel_call *c)
{
    static uint8_t row[32];
    for (int i = 0; i < 32; i++)
        row[i] = (uint8_t)(c->word[THRESHOLDS + i % WIDTH] >> i);
    return row;
}

static void prepare_blue(struct kernel_call *c)
{
    c->word[X] &= 63u;
    c->word[LAYOUT] %= 3u;
}

static void blue_reference(struct kernel_call *c)
{
    row_dithered_reference(c->plane[0], c->plane[1], c->n, (int32_t)c->word[X], many_thresholds(c), 31,
                           (enum row_16bit)c->word[LAYOUT]);
}

static void blue_vector(struct kernel_call *c)
{
    smear_row_dithered_vector(c->plane[0], c->plane[1], c->n, (int32_t)c->word[X], many_thresholds(c), 31,
                              (enum row_16bit)c->word[LAYOUT]);
}

#endif

#ifndef __OPTIMIZE_SIZE__
/* Three rows of a third of the pixels each. */
static void rows_reference(struct kernel_call *c)
{
    const int32_t width = c->n / 3;
    for (int32_t i = 0; i < 3; i++)
        row_dithered_reference((uint16_t *)c->plane[0] + i * width, (const uint32_t *)c->plane[1] + i * width, width,
                               (int32_t)c->word[X], smear_dither_ordered + ((((int32_t)c->word[Y] & 15) + i) & 7) * 8, 7,
                               (enum row_16bit)c->word[LAYOUT]);
}

static void prepare_rows(struct kernel_call *c)
{
    c->n -= c->n % 24;
    prepare_dithered(c);
    c->word[X] &= 8u;
    c->bytes[0] = 2 * c->n;
}

static void rows_blocks(struct kernel_call *c)
{
    const int32_t width = c->n / 3;
    const struct dithered_rows rows = { c->plane[0], c->plane[1], width, width, 3, width, (int32_t)c->word[X],
                                        (int32_t)c->word[Y] & 15, .mask = 0 };
    smear_rows_dithered_blocks(&rows, (enum row_16bit)c->word[LAYOUT]);
}

#endif

/* A row of L4 begins with column 0, which lies X / 2 bytes before what is written. Some have a block of the first pixel's
 * complement, top byte and all. */
static void prepare_l4(struct kernel_call *c)
{
    uint32_t *in = c->plane[1];
    for (int i = 8; i < 16 && c->n >= 16 && (c->word[Y] & 3u) == 0; i++)
        in[i] = ~in[0];
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

KERNELS(pixel_rows) = {
    { .name = "row_xrgb8888", .most = 35, .size = { 4, 4 },
      .form = { { "reference", xrgb8888_reference } VECTOR_FORM("vector", xrgb8888_vector) } },
    { .name = "row_nearest", .most = 67, .size = { 2, 4 }, .prepare = prepare_nearest,
      .form = { { "reference", nearest_reference },
#if SMEAR_VECTORS && !defined(__OPTIMIZE_SIZE__)
                { "vector", nearest_vector },
#endif
      } },
    { .name = "row_dithered", .most = 67, .size = { 2, 4 }, .prepare = prepare_dithered,
      .form = { { "reference", dithered_reference },
#ifndef __OPTIMIZE_SIZE__
                { "blocks", dithered_blocks },
#if SMEAR_VECTORS
                { "vector", dithered_vector },
#endif
#endif
      } },
#if SMEAR_VECTORS && !defined(__OPTIMIZE_SIZE__)
    { .name = "row_dithered_blue", .most = 67, .size = { 2, 4 }, .prepare = prepare_blue,
      .form = { { "reference", blue_reference }, { "vector", blue_vector } } },
#endif
#ifndef __OPTIMIZE_SIZE__
    { .name = "rows_dithered_blocks", .most = 201, .size = { 2, 4 }, .align = { 4 }, .prepare = prepare_rows,
      .form = { { "reference", rows_reference }, { "blocks", rows_blocks } } },
#endif
    { .name = "row_l4", .most = 67, .size = { 1, 4 }, .prepare = prepare_l4,
      .form = { { "reference", l4_reference },
#ifndef __OPTIMIZE_SIZE__
                { "blocks", l4_blocks },
#endif
      } },
    { .name = NULL }
};
