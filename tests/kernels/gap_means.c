/* SPDX-License-Identifier: MIT */
/* gap_means.c - how check_kernels calls kernels/gap_means.h: up to eight pairs of taps, up to 17 pixels away, and sums of as
 * many instants as their weights leave room for. */
#include "kernels/gap_means.h"

#include "tests/kernels/gap_depths.h"
#include "tests/kernels/kernels.h"

enum { REACH = 17 };            /* planes go on so far to either side of the pixels */
enum { COLOR, DEPTH, SUMS };    /* planes */
enum { COVER, NEAREST, PAIRS, UNIT_LOG2, LAST, INSTANTS, SHAPE };      /* words */

static int32_t plane_pixels(const struct kernel_call *c) { return c->n + 2 * REACH; }

/* What all taps weigh. */
static uint32_t whole_weight(const struct kernel_call *c)
{
    const uint32_t unit = 1u << c->word[UNIT_LOG2];
    return c->word[PAIRS] == 0 ? unit : unit * (2 * c->word[PAIRS] - 1) + 2 * c->word[LAST];
}

/* Sums that differ by few instants from pixel to pixel, or by any number, or are all empty. */
static void make_sums(struct kernel_call *c)
{
    const struct packed_sums sums = packed_sums_in(c->plane[SUMS], plane_pixels(c));
    const uint32_t most = c->word[INSTANTS], level = random_u32() % (most + 1), shape = c->word[SHAPE] & 3u;
    for (int32_t i = 0; i < plane_pixels(c); i++) {
        uint32_t times = shape == 0 ? 0 : shape == 1 ? random_u32() % (most + 1) : level + random_u32() % shape;
        times = min_u32(times, most);
        uint32_t channel[3];
        for (int k = 0; k < 3; k++)
            channel[k] = (random_u32() & 3u) == 0 ? 255 * times : random_u32() % (255 * times + 1);
        packed_sum_put(&sums, i, (struct packed_sum){ channel[0] << 16 | channel[2], times << 16 | channel[1] });
    }
}

static void prepare(struct kernel_call *c)
{
    uint32_t *color = c->plane[COLOR];
    for (int i = 0; i < 3; i++)
        c->bytes[i] = plane_pixels(c) * (i == COLOR ? 4 : i == DEPTH ? 2 : 8);
    for (int32_t i = 0; i < plane_pixels(c); i++)
        color[i] &= 0xffffffu;
    c->word[COVER] %= 3u;
    c->word[PAIRS] %= GAP_PAIRS_MAX + 1u;
    c->word[UNIT_LOG2] %= 5u;
    c->word[LAST] %= (1u << c->word[UNIT_LOG2]) + 1u;
    while (whole_weight(c) > PACKED_INSTANTS_MAX) {
        c->word[UNIT_LOG2]--;
        c->word[LAST] >>= 1;
    }
    if (whole_weight(c) == 1)
        c->word[UNIT_LOG2] = 1;
    c->word[INSTANTS] = 1 + c->word[INSTANTS] % (PACKED_INSTANTS_MAX / whole_weight(c));
    gap_depths(c, c->plane[DEPTH], plane_pixels(c), COVER, NEAREST);
    make_sums(c);
}

static void prepare_uncovered(struct kernel_call *c)
{
    c->word[COVER] = COVER_NONE;
    prepare(c);
}

typedef void gap_means_fn(const struct gap_planes *p, int32_t at, int32_t n, const struct gap_taps *taps,
                          enum gap_cover cover);

static void call(struct kernel_call *c, gap_means_fn *means)
{
    const struct packed_mean mean = smear_packed_mean(c->word[INSTANTS] * whole_weight(c));
    const struct gap_planes planes = {
        c->plane[COLOR], c->plane[DEPTH], packed_sums_in(c->plane[SUMS], plane_pixels(c)), c->word[NEAREST]
    };
    int32_t offset[GAP_PAIRS_MAX];
    for (uint32_t i = 0; i < c->word[PAIRS]; i++)
        offset[i] = (int32_t)(((c->word[SHAPE] >> 2) + 3 * i) % (2 * REACH + 1)) - REACH;
    const struct gap_taps taps = {
        { offset, (int32_t)c->word[PAIRS], 1 }, (int)c->word[UNIT_LOG2], c->word[LAST], &mean
    };
    means(&planes, REACH, c->n, &taps, (enum gap_cover)c->word[COVER]);
}

static void reference(struct kernel_call *c)
{
    call(c, smear_gap_means_reference);
}

/* In two rows, where there are two of a length. */
static struct gap_rows rows_of(int32_t at, int32_t n)
{
    const int32_t rows = GAP_ROWS ? 2 - (n & 1) : 1;
    return (struct gap_rows){ at, n / rows, rows, n / rows };
}

static void rows_two_passes(const struct gap_planes *p, int32_t at, int32_t n, const struct gap_taps *taps, enum gap_cover cover)
{
    const struct gap_rows r = rows_of(at, n);
    smear_gap_means_two_passes(p, &r, taps, cover);
}

static void two_passes(struct kernel_call *c)
{
    call(c, rows_two_passes);
}

#if SMEAR_VECTORS
static void rows_vector(const struct gap_planes *p, int32_t at, int32_t n, const struct gap_taps *taps, enum gap_cover cover)
{
    const struct gap_rows r = rows_of(at, n);
    smear_gap_means_vector(p, &r, taps, cover);
}

static void vector(struct kernel_call *c)
{
    call(c, rows_vector);
}
#endif

KERNELS(gap_means) = {
    { .name = "gap_means", .most = 35, .size = { 4, 2, 8 }, .align = { 4, 2, 4 }, .prepare = prepare, .timed = 64,
      .form = { { "reference", reference }, { "two passes", two_passes } VECTOR_FORM("vector", vector) } },
    { .name = "gap_means (nothing hides)", .most = 35, .size = { 4, 2, 8 }, .align = { 4, 2, 4 },
      .prepare = prepare_uncovered, .timed = 64,
      .form = { { "reference", reference }, { "two passes", two_passes } VECTOR_FORM("vector", vector) } },
    { .name = NULL }
};
