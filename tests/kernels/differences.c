/* SPDX-License-Identifier: MIT */
/* differences.c - how check_kernels calls kernels/differences.h: pixels and depths that are often alike, compared with others up
 * to three pixels away. */
#include "kernels/differences.h"

#include "tests/kernels/kernels.h"

enum { REACH = 3 };             /* planes go on so far to either side of the pixels */
enum { THERE, SUM, MOVING };    /* words */

static void prepare(struct kernel_call *c)
{
    uint32_t *color = c->plane[0], *behind = c->plane[1];
    uint16_t *depth = c->plane[2], *deep = c->plane[3];
    const int32_t pixels = c->n + 2 * REACH;
    const uint32_t alike = 1 + kernel_random() % 7u;
    for (int32_t i = 0; i < pixels; i++) {
        if (i > 0 && (kernel_random() & alike) != 0)
            color[i] = color[i - 1];
        if ((kernel_random() & alike) != 0)
            behind[i] = color[i];
        if (i > 0 && (kernel_random() & alike) != 0)
            depth[i] = (uint16_t)(depth[i - 1] + kernel_random() % 3u);
        if ((kernel_random() & alike) != 0)
            deep[i] = (uint16_t)(depth[i] + kernel_random() % 2u);
    }
    for (int i = 0; i < 4; i++)
        c->bytes[i] = pixels * (i < 2 ? 4 : 2);
    c->word[MOVING] &= 0xffu;
}

static void call(struct kernel_call *c, uint32_t (*form)(const struct difference_rows *r, int32_t n, uint32_t *moving))
{
    const uint32_t *color = c->plane[0], *behind = c->plane[1];
    const uint16_t *depth = c->plane[2], *deep = c->plane[3];
    const int32_t there = (int32_t)(c->word[THERE] % (2 * REACH + 1u)) - REACH,
                  there_behind = (int32_t)((c->word[THERE] >> 8) % (2 * REACH + 1u)) - REACH;
    const struct difference_rows rows = { color + REACH, behind + REACH, depth + REACH, deep + REACH, there, there_behind };
    c->word[SUM] = form(&rows, c->n, &c->word[MOVING]);
}

static void reference(struct kernel_call *c) { call(c, differences_reference); }

/* Rows of four to eight pixels. */
static void block(struct kernel_call *c, uint32_t (*form)(const struct difference_block *b, uint32_t *moving))
{
    const uint32_t *color = c->plane[0], *behind = c->plane[1];
    const uint16_t *depth = c->plane[2], *deep = c->plane[3];
    const int32_t there = (int32_t)(c->word[THERE] % (2 * REACH + 1u)) - REACH,
                  there_behind = (int32_t)((c->word[THERE] >> 8) % (2 * REACH + 1u)) - REACH;
    const int32_t n = 4 + c->n % 5, pitch = n + c->n % 3, pitch_behind = n + c->n % 2, rows = (c->n - n) / (n + 2) + 1;
    const struct difference_block rows_of = { { color + REACH, behind + REACH, depth + REACH, deep + REACH, there, there_behind },
                                              pitch, pitch_behind, rows, n };
    c->word[SUM] = form(&rows_of, &c->word[MOVING]);
}

static void block_reference(struct kernel_call *c) { block(c, difference_block_reference); }

static void block_best(struct kernel_call *c) { block(c, difference_block); }

#if DIFFERENCES_ASM_ARMV6M
static uint32_t row_armv6m(const struct difference_rows *r, int32_t n, uint32_t *moving)
{
    const struct difference_block row = { *r, n, n, 1, n };
    return smear_difference_block_armv6m(&row, moving);
}

static void armv6m(struct kernel_call *c) { call(c, row_armv6m); }
#endif

extern const struct kernel kernels_differences[];
const struct kernel kernels_differences[] = {
    { .name = "differences", .least = 1, .most = 35, .size = { 4, 4, 2, 2 }, .prepare = prepare, .timed = 8,
      .form = { { "reference", reference },
#if DIFFERENCES_ASM_ARMV6M
                { "armv6m", armv6m },
#endif
      } },
    { .name = "differences of blocks", .least = 8, .most = 60, .size = { 4, 4, 2, 2 }, .prepare = prepare, .timed = 40,
      .form = { { "reference", block_reference }, { "best", block_best } } },
    { .name = NULL }
};
