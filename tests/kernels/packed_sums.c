/* SPDX-License-Identifier: MIT */
/* packed_sums.c - how check_kernels calls kernels/packed_sums.h: colours of which many are nothing, sums of any
 * value that has room for one instant more; means of sums that are whole. */
#include "kernels/packed_sums.h"

#include "tests/kernels/kernels.h"

enum { ALL, INSTANTS };         /* words */
enum { COLOR, OTHER };          /* planes */

/* Packed sums of n pixels. */
static struct packed_sums sums_of(const struct kernel_call *c) { return packed_sums_in(c->plane[2], c->n); }

static void make_pixels(struct kernel_call *c, int plane)
{
    uint32_t *pixel = c->plane[plane];
    for (int32_t i = 0; i < c->n; i++)
        pixel[i] &= 0xffffffu;
}

/* A sum of up to `instants` instants. */
static struct packed_sum any_sum(uint32_t instants)
{
    const uint32_t times = random_u32() % (instants + 1), most = 255 * times + 1;
    uint32_t channel[3];
    for (int i = 0; i < 3; i++)
        channel[i] = (random_u32() & 3u) == 0 ? most - 1 : random_u32() % most;
    return (struct packed_sum){ channel[0] << 16 | channel[2], times << 16 | channel[1] };
}

/* ------------------------------------------------------------------ sums */

static void prepare_sums(struct kernel_call *c)
{
    uint32_t *color = c->plane[COLOR];
    const struct packed_sums sums = sums_of(c);
    make_pixels(c, COLOR);
    make_pixels(c, OTHER);
    for (int32_t i = 0; i < c->n; i++) {
        if ((random_u32() & 1u) != 0)
            color[i] = PACKED_NOTHING;
        packed_sum_put(&sums, i, any_sum(PACKED_INSTANTS_MAX - 1));
    }
    c->word[ALL] = (c->word[ALL] & 3u) == 0;
}

static const uint32_t *background_of(const struct kernel_call *c) { return c->word[ALL] != 0 ? c->plane[OTHER] : NULL; }

static void add_reference(struct kernel_call *c)
{
    smear_packed_add_reference(c->plane[COLOR], background_of(c), sums_of(c), c->n);
}

static void add_best(struct kernel_call *c)
{
    smear_packed_add(c->plane[COLOR], background_of(c), sums_of(c), c->n);
}

/* ------------------------------------------------------------------ means */

static void prepare_means(struct kernel_call *c)
{
    struct packed_sum *sum = c->plane[OTHER];
    make_pixels(c, COLOR);
    c->word[INSTANTS] = (uint32_t)between(2, PACKED_INSTANTS_MAX);
    for (int32_t i = 0; i < c->n; i++)
        sum[i] = any_sum(c->word[INSTANTS]);
}

static void means_reference(struct kernel_call *c)
{
    const struct packed_mean m = smear_packed_mean(c->word[INSTANTS]);
    smear_packed_means_reference(c->plane[COLOR], c->plane[OTHER], c->n, &m);
}

#if PACKED_ASM_ARMV6M
static void means_best(struct kernel_call *c)
{
    const struct packed_mean m = smear_packed_mean(c->word[INSTANTS]);
    smear_packed_means(c->plane[COLOR], c->plane[OTHER], c->n, &m);
}
#endif

KERNELS(packed_sums) = {
    { .name = "packed_add", .least = 1, .most = 35, .size = { 4, 4, 8 }, .align = { 4, 4, 4 }, .prepare = prepare_sums,
      .timed = 128, .form = { { "reference", add_reference },
#if SMEAR_VECTORS
                              { "best", add_best },
#elif PACKED_ASM_ARMV6M
                              { "armv6m", add_best },
#else
                              { "lazy", add_best },
#endif
      } },
    { .name = "packed_means", .least = 1, .most = 35, .size = { 4, 8 }, .align = { 4, 4 }, .prepare = prepare_means,
      .timed = 128, .form = { { "reference", means_reference },
#if PACKED_ASM_ARMV6M
                              { "armv6m", means_best },
#endif
      } },
    { .name = NULL }
};
