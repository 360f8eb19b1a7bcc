/* SPDX-License-Identifier: MIT */
/* colors_over_w.c - how check_kernels calls kernels/colors_over_w.h: planes of all values at pixels of a frame, and 1/w of any size. */
#include "kernels/colors_over_w.h"

#include "raster/texcoord.h"

#include "tests/kernels/kernels.h"

enum { PLANES = 9, Q = 9, X, Y, WORDS };

/* Values that are colours as a rule: w times 24 bits, in steps of 2^16. */
static void prepare(struct kernel_call *c)
{
    for (int32_t i = 0; i < c->n; i++) {
        int32_t *word = (int32_t *)c->plane[0] + WORDS * i;
        const int bits = kernel_between(1, 27);
        word[Q] = (1 << bits) + (int32_t)(kernel_random() & ((1u << bits) - 1u));
        word[X] = kernel_between(0, 1023);
        word[Y] = kernel_between(0, 1023);
        if ((kernel_random() & 3u) == 0)
            continue;
        for (int k = 0; k < PLANES; k += 3) {
            const int32_t here = (int32_t)((int64_t)word[Q] * kernel_between(-(1 << 20), (1 << 24) + (1 << 20)) >> 24);
            word[k + 1] = kernel_between(-1000, 1000);
            word[k + 2] = kernel_between(-1000, 1000);
            word[k] = here - word[k + 1] * word[X] - word[k + 2] * word[Y];
        }
    }
}

static void reference(struct kernel_call *c)
{
    int32_t *out = c->plane[1];
    for (int32_t i = 0; i < c->n; i++) {
        const int32_t *w = (const int32_t *)c->plane[0] + WORDS * i;
        const int zeros = count_leading_zeros((uint32_t)w[Q]);
        const int32_t recip = (int32_t)recip_norm((uint32_t)w[Q] << zeros);
        for (int k = 0; k < 3; k++) {
            const struct plane p = { w[3 * k], w[3 * k + 1], w[3 * k + 2] };
            out[3 * i + k] = channel_over_w(plane_at(&p, w[X], w[Y]), zeros, recip);
        }
    }
}

#if COLORS_OVER_W_ARMV6M
static void armv6m(struct kernel_call *c)
{
    int32_t *out = c->plane[1];
    for (int32_t i = 0; i < c->n; i++) {
        const int32_t *w = (const int32_t *)c->plane[0] + WORDS * i;
        const int zeros = count_leading_zeros((uint32_t)w[Q]);
        colors_over_w_armv6m(out + 3 * i, w, w[X], w[Y], zeros, (int32_t)recip_norm((uint32_t)w[Q] << zeros));
    }
}
#endif

extern const struct kernel kernels_colors_over_w[];
const struct kernel kernels_colors_over_w[] = {
    { .name = "colors_over_w", .most = 20, .size = { 4 * WORDS, 12 }, .align = { 4, 4 }, .prepare = prepare, .timed = 16,
      .form = { { "reference", reference },
#if COLORS_OVER_W_ARMV6M
                { "armv6m", armv6m },
#endif
      } },
    { .name = NULL }
};
