/* SPDX-License-Identifier: MIT */
/* light_sums.c - how check_kernels calls kernels/light_sums.h: colours of which many are nothing, sums with room
 * for one instant more; up to eight pairs of taps, up to 17 pixels away, around sums of instants that were added. */
#include "kernels/light_sums.h"

#include "tests/kernels/gap_depths.h"
#include "tests/kernels/kernels.h"

enum { REACH = 17 };                    /* planes go on so far to either side of the pixels */
enum { COLOR, OTHER, SUMS };            /* planes */
enum { INSTANTS, LINEAR, ALL, INSTANT, COVER, NEAREST, PAIRS, UNIT, LAST, SHAPE };      /* words */

static void make_pixels(uint32_t *pixel, int32_t n)
{
    for (int32_t i = 0; i < n; i++)
        pixel[i] &= 0xffffffu;
}

/* Often few instants, rarely codes. */
static void make_instants(struct kernel_call *c)
{
    c->word[INSTANTS] = 1 + c->word[INSTANTS] % ((c->word[SHAPE] & 7u) == 0 ? (uint32_t)LIGHT_INSTANTS_MAX : 24u);
    c->word[LINEAR] = (c->word[LINEAR] & 7u) != 0;
}

/* ------------------------------------------------------------------ sums */

static void prepare_sums(struct kernel_call *c)
{
    uint32_t *color = c->plane[COLOR], *sum = c->plane[SUMS];
    make_pixels(c->plane[COLOR], c->n);
    make_pixels(c->plane[OTHER], c->n);
    make_instants(c);
    for (int32_t i = 0; i < c->n; i++)
        if ((random_u32() & 1u) != 0)
            color[i] = PACKED_NOTHING;
    for (int32_t i = 0; i < 2 * c->n; i++)
        sum[i] &= c->word[INSTANTS] == 1 ? 0 : 0x7fff7fffu;
    c->word[ALL] = (c->word[ALL] & 3u) == 0;
    c->word[INSTANT] %= c->word[INSTANTS];
}

typedef void light_add_fn(uint32_t *color, const uint32_t *background, struct packed_sums sums, int32_t n,
                          const struct light_instant *instant);

static void add(struct kernel_call *c, light_add_fn *light_add)
{
    const struct light_instant instant = smear_light_instant(c->word[INSTANT], c->word[INSTANTS], c->word[LINEAR] != 0);
    light_add(c->plane[COLOR], c->word[ALL] != 0 ? c->plane[OTHER] : NULL, packed_sums_in(c->plane[SUMS], c->n), c->n, &instant);
}

static void add_reference(struct kernel_call *c)
{
    add(c, smear_light_add_reference);
}

#if SMEAR_VECTORS
static void add_vector(struct kernel_call *c)
{
    add(c, smear_light_add_vector);
}
#endif

/* ------------------------------------------------------------------ means */

static int32_t plane_pixels(const struct kernel_call *c) { return c->n + 2 * REACH; }

/* Sums of the first instants: the same number at all pixels, or few more, or any number. */
static void make_sums(struct kernel_call *c)
{
    const struct packed_sums sums = packed_sums_in(c->plane[SUMS], plane_pixels(c));
    const uint32_t all = c->word[INSTANTS], shape = c->word[SHAPE] >> 3 & 3u, level = random_u32() % (all + 1);
    const uint32_t instants = min_u32(all, 40);
    for (int32_t i = 0; i < plane_pixels(c); i++) {
        const uint32_t times = shape == 0 ? all : shape == 1 ? random_u32() % (all + 1) : level + random_u32() % shape;
        packed_sum_put(&sums, i, (struct packed_sum){ 0, 0 });
        for (uint32_t k = 0; k < min_u32(times, instants); k++) {
            const struct light_instant instant = smear_light_instant(k, all, c->word[LINEAR] != 0);
            uint32_t color = random_u32() & 0xffffffu, background = ~color;
            smear_light_add_reference(&color, &background, packed_sums_from(sums, i), 1, &instant);
        }
    }
}

static void prepare_means(struct kernel_call *c)
{
    for (int i = 0; i < 3; i++)
        c->bytes[i] = plane_pixels(c) * (i == COLOR ? 4 : i == OTHER ? 2 : 8);
    make_pixels(c->plane[COLOR], plane_pixels(c));
    make_instants(c);
    c->word[COVER] %= 3u;
    c->word[PAIRS] %= GAP_PAIRS_MAX + 1u;
    c->word[UNIT] = 1u << c->word[UNIT] % 5u;
    c->word[LAST] = 1 + c->word[LAST] % c->word[UNIT];
    gap_depths(c, c->plane[OTHER], plane_pixels(c), COVER, NEAREST);
    make_sums(c);
}

static void prepare_uncovered(struct kernel_call *c)
{
    c->word[COVER] = COVER_NONE;
    prepare_means(c);
}

typedef void light_means_fn(const struct gap_planes *p, int32_t at, int32_t n, const struct gap_pairs *taps,
                            const struct light_mean *mean, enum gap_cover cover);

static void means(struct kernel_call *c, light_means_fn *light_means, enum gap_cover cover)
{
    const struct light_mean mean = smear_light_mean(smear_light_full(c->word[INSTANTS]), (int32_t)c->word[PAIRS],
                                                    c->word[UNIT], c->word[LAST], c->word[LINEAR] != 0);
    const struct gap_planes planes = {
        c->plane[COLOR], c->plane[OTHER], packed_sums_in(c->plane[SUMS], plane_pixels(c)), c->word[NEAREST]
    };
    int32_t offset[GAP_PAIRS_MAX];
    for (uint32_t i = 0; i < c->word[PAIRS]; i++)
        offset[i] = (int32_t)(((c->word[SHAPE] >> 5) + 3 * i) % (2 * REACH + 1)) - REACH;
    const struct gap_pairs taps = { offset, (int32_t)c->word[PAIRS], smear_light_most(c->word[INSTANTS]) };
    light_means(&planes, REACH, c->n, &taps, &mean, cover);
}

static void means_reference(struct kernel_call *c)
{
    means(c, smear_light_means_reference, COVER_ALL);
}

#if SMEAR_VECTORS
static void means_vector(struct kernel_call *c)
{
    means(c, smear_light_means_vector, (enum gap_cover)c->word[COVER]);
}
#endif

static void means_best(struct kernel_call *c)
{
    means(c, smear_light_means, (enum gap_cover)c->word[COVER]);
}

#if SMEAR_VECTORS
#define VECTOR { "vector", add_vector },
#define MEANS_VECTOR { "vector", means_vector },
#else
#define VECTOR
#define MEANS_VECTOR
#endif

KERNELS(light_sums) = {
    { .name = "light_add", .least = 1, .most = 33, .size = { 4, 4, 8 }, .align = { 4, 4, 4 }, .prepare = prepare_sums,
      .timed = 64, .form = { { "reference", add_reference }, VECTOR } },
    { .name = "light_means", .most = 20, .size = { 4, 2, 8 }, .align = { 4, 2, 4 }, .prepare = prepare_means, .timed = 32,
      .form = { { "reference", means_reference }, MEANS_VECTOR { "best", means_best } } },
    { .name = "light_means (nothing hides)", .most = 20, .size = { 4, 2, 8 }, .align = { 4, 2, 4 },
      .prepare = prepare_uncovered, .timed = 32,
      .form = { { "reference", means_reference }, MEANS_VECTOR { "best", means_best } } },
    { .name = NULL }
};
