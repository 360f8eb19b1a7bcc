/* SPDX-License-Identifier: MIT */
/* gradient.c - how check_kernels calls kernels/gradient.h: differences along the edges of triangles of all sizes, as plane_slopes of
 * raster/setup.c does. */
#include "kernels/gradient.h"

#include "tests/kernels/kernels.h"

#include "base/fixmath.h"

enum { X1, Y1, X2, Y2, D1, D2, RECIP, ZEROS, WORDS };

/* A number of up to so many bits, and a sign. */
static int32_t number(int bits)
{
    const int32_t size = (int32_t)(random_u32() & ((2u << between(0, bits - 1)) - 1u));
    return (random_u32() & 1u) != 0 ? -size : size;
}

static void prepare(struct kernel_call *c)
{
    for (int32_t i = 0; i < c->n; i++) {
        int32_t *word = (int32_t *)c->plane[0] + WORDS * i;
        const int bits = (random_u32() & 3u) == 0 ? 20 : 15;
        for (int k = X1; k <= Y2; k++)
            word[k] = number(bits);
        int64_t area = (int64_t)word[X1] * word[Y2] - (int64_t)word[X2] * word[Y1];
        if (area == 0) {
            word[X1] = word[Y2] = 1 << between(0, bits - 1);
            word[X2] = 0;
            area = (int64_t)word[X1] * word[X1];
        } else if (area < 0) {
            word[X1] = -word[X1];
            word[X2] = -word[X2];
            area = -area;
        }
        word[D1] = number(31);
        word[D2] = (random_u32() & 7u) == 0 ? word[D1] : number(31);
        word[ZEROS] = count_leading_zeros_64((uint64_t)area);
        word[RECIP] = (int32_t)recip_norm_precise((uint32_t)((uint64_t)area << word[ZEROS] >> 32));
    }
}

#define GRADIENTS(NAME) \
    static void NAME(struct kernel_call *c) \
    { \
        int32_t *out = c->plane[1]; \
        for (int32_t i = 0; i < c->n; i++) { \
            const int32_t *w = (const int32_t *)c->plane[0] + WORDS * i; \
            const uint64_t both = gradients_##NAME(w, w[D1], w[D2], (uint32_t)w[RECIP], w[ZEROS]); \
            out[2 * i] = (int32_t)(uint32_t)both; \
            out[2 * i + 1] = (int32_t)(uint32_t)(both >> 32); \
        } \
    }
GRADIENTS(reference)
#if GRADIENT_ARMV6M
GRADIENTS(armv6m)
#endif

KERNELS(gradient) = {
    { .name = "gradient", .most = 28, .size = { 4 * WORDS, 8 }, .align = { 4, 4 }, .prepare = prepare, .timed = 24,
      .form = { { "reference", reference },
#if GRADIENT_ARMV6M
                { "armv6m", armv6m },
#endif
      } },
    { .name = NULL }
};
