/* SPDX-License-Identifier: MIT */
/* line_means.c - how check_kernels calls kernels/line_means.h: rows of a block whose taps lie up to 21 pixels away, in any order. */
#include "kernels/line_means.h"

#include "base/pixel.h"
#include "base/tables.h"
#include "kernels/packed_sums.h"
#include "kernels/vector.h"
#include "tests/kernels/kernels.h"

enum { REACH = 21 };            /* planes go on so far to either side of the pixels, and of one behind them */
enum { IN, OUT };               /* planes */
enum { LOG, ROWS, GAP_IN, GAP_OUT, SPARSE, OFFSET };    /* words; of each tap from OFFSET on */
_Static_assert((int)OFFSET + (int)LINE_TAPS_MAX <= (int)KERNEL_WORDS, "each tap has a word");

static int32_t rows_of(const struct kernel_call *c) { return 1 + (int32_t)(c->word[ROWS] % 3u); }
static int32_t in_stride(const struct kernel_call *c) { return c->n + (int32_t)(c->word[GAP_IN] % 5u); }
static int32_t out_stride(const struct kernel_call *c) { return c->n + (int32_t)(c->word[GAP_OUT] % 5u); }

/* Lines cross pixels that are often alike; their fourth channel is whatever texels had. */
static void prepare(struct kernel_call *c)
{
    uint32_t *in = c->plane[IN];
    const int32_t rows = rows_of(c), pixels = (rows - 1) * in_stride(c) + c->n + 1 + 2 * REACH;
    const uint32_t alike = random_u32() % 4u;
    for (int32_t i = 0; i < pixels; i++)
        in[i] = i > 0 && random_u32() % 4u < alike ? in[i - 1] : in[i];
    c->bytes[IN] = pixels * 4;
    c->bytes[OUT] = ((rows - 1) * out_stride(c) + c->n) * 4;
}

/* What a fourth channel becomes is nobody's matter. */
static void forget_fourth(struct kernel_call *c)
{
    uint32_t *out = c->plane[OUT];
    for (int32_t i = 0; i < c->bytes[OUT] / 4; i++)
        out[i] &= 0xffffffu;
}

static void call(struct kernel_call *c, void (*means)(const struct line_block *b, bool linear), bool linear)
{
    const uint32_t *in = c->plane[IN];
    struct line_block b = { .in = in + REACH, .out = c->plane[OUT], .in_stride = in_stride(c), .out_stride = out_stride(c),
                            .columns = c->n, .rows = rows_of(c), .log = (int32_t)(c->word[LOG] % (LINE_TAPS_LOG_MAX + 1u)),
                            .sparse = c->word[SPARSE] % 2u != 0 && c->n % LINE_SPARSE == 0 };
    b.sparse = b.sparse && b.log == LINE_TAPS_LOG_MAX;
    for (int k = 0; k < LINE_TAPS_MAX; k++)
        b.offset[k] = (int32_t)(c->word[OFFSET + k] % (2 * REACH + 1u)) - REACH;
    means(&b, linear);
    forget_fourth(c);
}

/* The code whose square comes next to one of such a size, as near as a table of 1024 roots tells it. */
static uint32_t root(uint32_t square)
{
    if (square < 3)
        return square > 0;
    if (square < 4092)
        return (smear_sqrt_q3[(square + 1) / 4] + 2u) / 4;
    return smear_sqrt_q3[(square + 32) / 64 < 1023 ? (square + 32) / 64 : 1023];
}

/* Each channel by itself. */
static uint32_t mean_of(const uint32_t *in, const struct line_block *b, bool linear)
{
    uint32_t sum[3] = { 0, 0, 0 }, mean = 0;
    for (int k = 0; k < 1 << b->log; k++) {
        const uint32_t c = in[b->offset[k]];
        for (int channel = 0; channel < 3; channel++) {
            const uint32_t code = c >> 8 * channel & 0xffu;
            sum[channel] += linear ? code * code : code;
        }
    }
    for (int channel = 0; channel < 3; channel++)
        mean |= (linear ? root(sum[channel] >> b->log) : (sum[channel] + (1u << b->log) / 2) >> b->log)
             << 8 * channel;
    return mean;
}

static uint32_t middle_of(uint32_t a, uint32_t b)
{
    uint32_t mean = 0;
    for (int channel = 0; channel < 24; channel += 8)
        mean |= ((a >> channel & 0xffu) + (b >> channel & 0xffu) + 1) / 2 << channel;
    return mean;
}

static void one_by_one(const struct line_block *b, bool linear)
{
    for (int32_t i = 0; i < b->rows * b->columns; i++) {
        const int32_t x = i % b->columns, y = i / b->columns, part = b->sparse ? x % LINE_SPARSE : 0;
        const uint32_t *in = b->in + y * b->in_stride + x - part;
        uint32_t mean = mean_of(in, b, linear);
        if (part != 0) {
            const uint32_t next = mean_of(in + LINE_SPARSE, b, linear), middle = middle_of(mean, next);
            mean = part == 1 ? middle_of(mean, middle) : part == 2 ? middle : middle_of(middle, next);
        }
        b->out[y * b->out_stride + x] = mean;
    }
}

static void codes_reference(struct kernel_call *c) { call(c, smear_line_means_reference, false); }
static void codes_one_by_one(struct kernel_call *c) { call(c, one_by_one, false); }
static void codes_best(struct kernel_call *c) { call(c, smear_line_means, false); }
static void light_reference(struct kernel_call *c) { call(c, smear_line_means_reference, true); }
static void light_one_by_one(struct kernel_call *c) { call(c, one_by_one, SMEAR_WITH_LINEAR); }
static void light_best(struct kernel_call *c) { call(c, smear_line_means, true); }

/* Eight taps, as most lines have. */
static void prepare_eight(struct kernel_call *c)
{
    c->word[LOG] = LINE_TAPS_LOG_MAX;
    c->word[SPARSE] = 0;
    prepare(c);
}

/* And of those that are long. */
static void prepare_sparse(struct kernel_call *c)
{
    prepare_eight(c);
    c->word[SPARSE] = 1;
}

/* ------------------------------------------------------------------ means of pictures */

/* Pictures are often alike, or nearly so. */
static void prepare_mix(struct kernel_call *c)
{
    uint32_t *in = c->plane[IN], *out = c->plane[OUT];
    const uint32_t alike = random_u32() % 4u;
    c->bytes[IN] = c->bytes[OUT] = c->n * 4;
    for (int32_t i = 0; i < c->n; i++) {
        const uint32_t near = out[i] ^ (random_u32() & 0x0f0f0fu);
        in[i] = random_u32() % 4u < alike ? out[i] : random_u32() % 2u != 0 ? near : in[i];
    }
}

typedef void mixer(uint32_t *mean, uint32_t *more, const uint32_t *last, int32_t n, int32_t k, bool linear);

static void mix(struct kernel_call *c, mixer *mixes, bool linear)
{
    const uint32_t *const in = c->plane[IN];
    uint32_t more[64], last[64];
    for (int32_t i = 0; i < c->n; i++) {
        more[i] = in[i];
        last[i] = in[i % 3 != 0 ? i : c->n - 1 - i];
    }
    mixes(c->plane[OUT], more, last, c->n, 1 + (int32_t)(c->word[LOG] % 3u), linear);
    forget_fourth(c);
}

/* Each channel by itself; a third is 85 and a quarter of 256. Words that are the same stay. */
static uint32_t mixed(uint32_t a, uint32_t b, uint32_t c, uint32_t count, bool linear)
{
    bool light = false;
    uint32_t out = 0;
    for (int channel = 0; channel < 24; channel += 8) {
        const int32_t x = (int32_t)(a >> channel & 0xffu) / 2, y = (int32_t)(b >> channel & 0xffu) / 2;
        const int32_t z = (int32_t)(c >> channel & 0xffu) / 2;
        light = light || (linear && (x - y < -8 || x - y >= 8 || (count == 3 && (x - z < -8 || x - z >= 8))));
    }
    for (int channel = 0; channel < 24; channel += 8) {
        const uint32_t x = a >> channel & 0xffu, y = b >> channel & 0xffu, z = c >> channel & 0xffu;
        const uint32_t sum = x + y + (count == 3 ? z : 0);
        const uint32_t lights = smear_srgb_light[x] + smear_srgb_light[y] + (count == 3 ? smear_srgb_light[z] : 0u);
        const uint32_t code = count == 3 ? (85 * sum + sum / 4 + 128) / 256 : (2 * sum + count) / (2 * count);
        out |= (light ? smear_srgb_encode[(lights * (65536 / count) + 32768) >> 16] : code) << channel;
    }
    return a == b && (count == 2 || a == c) ? a : out;
}

static void mix_one_by_one(uint32_t *mean, uint32_t *more, const uint32_t *last, int32_t n, int32_t k, bool linear)
{
    for (int32_t i = 0; i < n; i++) {
        const uint32_t other = k == 3 ? mixed(more[i], last[i], 0, 2, linear) : more[i];
        mean[i] = mixed(mean[i], other, last[i], k == 2 ? 3 : 2, linear);
    }
}

static void mix_reference(struct kernel_call *c) { mix(c, smear_line_mix_reference, false); }
static void mix_each(struct kernel_call *c) { mix(c, mix_one_by_one, false); }
static void mix_best(struct kernel_call *c) { mix(c, smear_line_mix, false); }
static void mix_light_reference(struct kernel_call *c) { mix(c, smear_line_mix_reference, true); }
static void mix_light_each(struct kernel_call *c) { mix(c, mix_one_by_one, SMEAR_WITH_LINEAR); }
static void mix_light_best(struct kernel_call *c) { mix(c, smear_line_mix, true); }

#if SMEAR_VECTORS
#define BEST "vector"
#elif PACKED_ASM_ARMV6M
#define BEST "armv6m"
#else
#define BEST "plain"
#endif

KERNELS(line_means) = {
    { .name = "line_means", .least = 1, .most = 25, .size = { 4, 4 }, .prepare = prepare, .timed = 24,
      .form = { { "reference", codes_reference }, { "one by one", codes_one_by_one }, { BEST, codes_best } } },
    { .name = "line_means (eight taps)", .least = 1, .most = 25, .size = { 4, 4 }, .prepare = prepare_eight, .timed = 24,
      .form = { { "reference", codes_reference }, { "one by one", codes_one_by_one }, { BEST, codes_best } } },
    { .name = "line_means (sparse)", .least = 4, .most = 40, .size = { 4, 4 }, .prepare = prepare_sparse, .timed = 24,
      .form = { { "reference", codes_reference }, { "one by one", codes_one_by_one }, { BEST, codes_best } } },
    { .name = "line_means (sparse light)", .least = 4, .most = 40, .size = { 4, 4 }, .prepare = prepare_sparse, .timed = 24,
      .form = { { "reference", light_reference }, { "one by one", light_one_by_one }, { BEST, light_best } } },
    { .name = "line_means (light)", .least = 1, .most = 25, .size = { 4, 4 }, .prepare = prepare, .timed = 24,
      .form = { { "reference", light_reference }, { "one by one", light_one_by_one }, { BEST, light_best } } },
    { .name = "line_mix", .least = 1, .most = 25, .size = { 4, 4 }, .prepare = prepare_mix, .timed = 24,
      .form = { { "reference", mix_reference }, { "one by one", mix_each }, { BEST, mix_best } } },
    { .name = "line_mix (light)", .least = 1, .most = 25, .size = { 4, 4 }, .prepare = prepare_mix, .timed = 24,
      .form = { { "reference", mix_light_reference }, { "one by one", mix_light_each }, { BEST, mix_light_best } } },
    { .name = NULL }
};
