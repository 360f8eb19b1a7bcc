/* SPDX-License-Identifier: MIT */
/* depth_range.c - how check_kernels calls kernels/depth_range.h: a box of up to four rows, whose pitch is up to
 * three codes more than their width; often of codes that are those before. */
#include "kernels/depth_range.h"

#include "tests/kernels/kernels.h"

enum { PITCH, HEIGHT, LEAST, MOST };

static void prepare(struct kernel_call *c)
{
    c->word[PITCH] = (uint32_t)c->n + (c->word[PITCH] & 3u);
    c->word[HEIGHT] = c->n > 100 ? 4 : c->word[HEIGHT] % 5u;
    c->bytes[0] = (int32_t)(c->word[PITCH] * c->word[HEIGHT] * 2u);
    uint16_t *code = c->plane[0];
    const uint32_t alike = kernel_random() % 32u;
    for (int32_t i = 1; i < c->bytes[0] / 2; i++)
        if ((kernel_random() & alike) != 0)
            code[i] = code[i - 1];
}

static void store(struct kernel_call *c, struct depth_range r)
{
    c->word[LEAST] = r.least;
    c->word[MOST] = r.most;
}

static void reference(struct kernel_call *c)
{
    store(c, depth_range_reference(c->plane[0], (int32_t)c->word[PITCH], c->n, (int32_t)c->word[HEIGHT]));
}

#if !defined(__OPTIMIZE_SIZE__)
static void unrolled(struct kernel_call *c)
{
    store(c, depth_range_unrolled(c->plane[0], (int32_t)c->word[PITCH], c->n, (int32_t)c->word[HEIGHT]));
}
#endif

extern const struct kernel kernels_depth_range[];
const struct kernel kernels_depth_range[] = {
    { .name = "depth_range (four rows)", .most = 35, .size = { 2 }, .prepare = prepare, .timed = 128,
      .form = { { "reference", reference },
#if !defined(__OPTIMIZE_SIZE__)
                { "unrolled", unrolled },
#endif
      } },
    { .name = NULL }
};
