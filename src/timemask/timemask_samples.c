/* SPDX-License-Identifier: MIT */
/* timemask_samples.c - entries of pixels: taken, lost, merged, averaged. */
#include "timemask/timemask_cover.h"

void smear_timemask_samples_place(struct timemask_samples *b, void *memory, int32_t pixels_log2,
                                  int32_t samples_log2, smear_transfer transfer)
{
    size_t pixels = (size_t)1 << pixels_log2;
    b->any = (uint32_t *)memory;
    b->held = b->any + pixels;
    b->color = b->held + TIMEMASK_ENTRIES * pixels;
    b->depth = (uint16_t *)(void *)(b->color + TIMEMASK_ENTRIES * pixels);
    b->count = (uint8_t *)(b->depth + TIMEMASK_ENTRIES * pixels);
    b->pixels_log2 = pixels_log2;
    b->samples_log2 = samples_log2;
    b->transfer = transfer;
}

void smear_timemask_samples_clear(struct timemask_samples *b)
{
    size_t pixels = (size_t)1 << b->pixels_log2;
    __builtin_memset(b->any, 0, pixels * sizeof *b->any);
    __builtin_memset(b->count, 0, pixels);
}

static inline uint32_t count_bits(uint32_t m)
{
    m -= m >> 1 & 0x55555555u;
    m = (m & 0x33333333u) + (m >> 2 & 0x33333333u);
    return ((m + (m >> 4)) & 0x0f0f0f0fu) * 0x01010101u >> 24;
}

/* ------------------------------------------------------------------ depth in time */

uint32_t smear_timemask_slope(int32_t slope)
{
    uint32_t size = min_u32((uint32_t)abs_i32(slope), 15u << 14), sign = slope < 0 ? 128u : 0;
    if (size < 8)
        return sign | size;
    int exponent = 29 - count_leading_zeros(size);
    return sign | (uint32_t)exponent << 3 | (size >> (exponent - 1) & 7u);
}

SMEAR_NOINLINE uint32_t smear_timemask_nearer(int32_t depth, int32_t slope, uint32_t both, int32_t twice_middle)
{
    int32_t first = 31 - count_leading_zeros(both & (0u - both)), last = 31 - count_leading_zeros(both);
    int32_t begin = depth + slope * (2 * first - twice_middle), end = depth + slope * (2 * last - twice_middle);
    if (begin > 0 && end > 0)
        return both;
    if (begin <= 0 && end <= 0)
        return 0;
    /* They cross: samples before are those whose difference has the sign of the first. */
    int32_t count = clamp_i32(-begin / (2 * slope), 0, last - first - 1) + 1;
    uint32_t before = both & ((2u << (first + count - 1)) - 1u);
    return begin > 0 ? before : both & ~before;
}

/* ------------------------------------------------------------------ merging */

/* (a wa + b wb) / n with n = wa + wb samples: equal codes keep their mean. */
static uint32_t mean_of_two(uint32_t a, uint32_t wa, uint32_t b, uint32_t wb, smear_transfer transfer)
{
    const uint32_t n = wa + wb, over = ((1u << 22) + n - 1u) / n;
    uint32_t out = 0;
    for (int shift = 0; shift < 24; shift += 8) {
        const uint32_t x = a >> shift & 255u, y = b >> shift & 255u;
        if (transfer_is_linear(transfer))         /* sums are below 2^21 */
            out |= (uint32_t)smear_srgb_encode[mulh_u32((smear_srgb_decode[x] * wa + smear_srgb_decode[y] * wb) << 11, over) >> 5] << shift;
        else                /* below 2^13: products with over / 2^4 fit */
            out |= ((x * wa + y * wb + (n >> 1)) * ((over + 15u) >> 4) >> 18) << shift;
    }
    return out;
}

static inline uint32_t distance(uint32_t a, uint32_t b)
{
    return a > b ? a - b : b - a;
}

struct entry {
    uint32_t held, color, depth;
};

static inline struct entry entry_at(const struct timemask_samples *b, uint32_t pixel, uint32_t i)
{
    uint32_t at = (i << b->pixels_log2) + pixel;
    return (struct entry){ b->held[at], b->color[at], b->depth[at] };
}

static inline void entry_put(struct timemask_samples *b, uint32_t pixel, uint32_t i, const struct entry *e)
{
    uint32_t at = (i << b->pixels_log2) + pixel;
    b->held[at] = e->held;
    b->color[at] = e->color;
    b->depth[at] = (uint16_t)e->depth;
}

/* Two entries in one: in the course of the longer. */
static struct entry entry_join(const struct entry *a, const struct entry *b, smear_transfer transfer)
{
    uint32_t wa = count_bits(a->held), wb = count_bits(b->held);
    const struct entry *longer = wa < wb ? b : a;
    struct entry e = { a->held | b->held, longer->color, longer->depth };
    if ((a->color ^ b->color) << 8 != 0)
        e.color = mean_of_two(a->color, wa, b->color, wb, transfer) | (longer->color & 0xff000000u);
    return e;
}

enum { ALIKE = 48 * 64 };       /* no need to look for better ones */

/* How much it matters that two entries become one: by depth and colour. */
static inline uint32_t apart(const struct entry *a, const struct entry *b)
{
    uint32_t color = distance(pixel_red(a->color), pixel_red(b->color))
                   + distance(pixel_green(a->color), pixel_green(b->color))
                   + distance(pixel_blue(a->color), pixel_blue(b->color));
    return (distance(a->depth, b->depth) + 16u) * (color + 16u);
}

/* All entries are taken: two that are alike share one. What is new first
 * looks for one like itself, from the latest on. */
static SMEAR_NOINLINE void merge(struct timemask_samples *b, uint32_t pixel, const struct entry *fresh)
{
    struct entry all[TIMEMASK_ENTRIES];
    uint32_t first = 0, second = TIMEMASK_ENTRIES, least = UINT32_MAX;
    for (uint32_t i = TIMEMASK_ENTRIES; i-- > 0 && least > ALIKE;) {
        all[i] = entry_at(b, pixel, i);
        uint32_t d = apart(&all[i], fresh);
        if (d < least) {
            least = d;
            first = i;
        }
    }
    for (uint32_t i = 0; i < TIMEMASK_ENTRIES && least > 4 * ALIKE; i++)
        for (uint32_t j = i + 1; j < TIMEMASK_ENTRIES; j++) {
            uint32_t d = apart(&all[i], &all[j]);
            if (d < least) {
                least = d;
                first = i;
                second = j;
            }
        }
    struct entry joined = entry_join(&all[first], second < TIMEMASK_ENTRIES ? &all[second] : fresh,
                                     b->transfer);
    entry_put(b, pixel, first, &joined);
    if (second < TIMEMASK_ENTRIES)
        entry_put(b, pixel, second, fresh);
}

/* ------------------------------------------------------------------ fragments */

/* Whether an entry is of the same colour and, as far as that matters, the same surface. */
static bool is_same(const struct timemask_samples *b, uint32_t at, uint32_t color,
                    int32_t depth)
{
    return (b->color[at] ^ color) << 8 == 0 && abs_i32((int32_t)b->depth[at] - depth) <= depth >> 6;
}

/* Adds a fragment where others have a say or entries run out. */
static void contest(struct timemask_samples *b, uint32_t pixel, const struct timemask_fragment *f)
{
    const int32_t last_sample = (1 << b->samples_log2) - 1;
    uint32_t mask = f->mask, n = b->count[pixel];
    for (uint32_t i = 0; i < n;) {
        uint32_t at = (i << b->pixels_log2) + pixel, both = b->held[at] & mask;
        if (both != 0) {
            int32_t deeper = (f->depth - (int32_t)b->depth[at]) * 32;
            int32_t turn = f->slope - timemask_slope_of(b->color[at]), most = abs_i32(turn) * last_sample;
            uint32_t taken = deeper > most   ? both
                           : deeper <= -most ? 0
                                             : smear_timemask_nearer(deeper, turn, both, last_sample);
            mask &= ~both | taken;
            b->held[at] &= ~taken;
            if (b->held[at] == 0) {     /* the last one takes its place */
                struct entry last = entry_at(b, pixel, --n);
                entry_put(b, pixel, i, &last);
                continue;
            }
        }
        i++;
    }
    b->count[pixel] = (uint8_t)n;
    if (mask == 0)
        return;
    b->any[pixel] |= mask;
    for (uint32_t i = n; i-- > 0;) {
        uint32_t at = (i << b->pixels_log2) + pixel;
        if (is_same(b, at, f->color, f->depth)) {
            b->held[at] |= mask;
            return;
        }
    }
    struct entry fresh = { mask, f->color, (uint32_t)f->depth };
    if (n == TIMEMASK_ENTRIES) {
        merge(b, pixel, &fresh);
        return;
    }
    entry_put(b, pixel, n, &fresh);
    b->count[pixel] = (uint8_t)(n + 1);
}

void smear_timemask_samples_add(struct timemask_samples *b, uint32_t pixel, struct timemask_fragment f)
{
    uint32_t any = b->any[pixel], n = b->count[pixel];
    if ((any & f.mask) != 0 || n == TIMEMASK_ENTRIES) {
        contest(b, pixel, &f);
        return;
    }
    uint32_t at = (n << b->pixels_log2) + pixel, before = at - (1u << b->pixels_log2);
    b->any[pixel] = any | f.mask;
    if (n != 0 && is_same(b, before, f.color, f.depth)) {
        b->held[before] |= f.mask;
        return;
    }
    b->held[at] = f.mask;
    b->color[at] = f.color;
    b->depth[at] = (uint16_t)f.depth;
    b->count[pixel] = (uint8_t)(n + 1);
}

/* ------------------------------------------------------------------ means */

uint32_t smear_timemask_samples_mean(const struct timemask_samples *b, uint32_t pixel, uint32_t background)
{
    uint32_t rest = 1u << b->samples_log2, sum[3] = { rest >> 1, rest >> 1, rest >> 1 }, out = 0;
    for (uint32_t i = 0, at = pixel; i <= b->count[pixel]; i++, at += 1u << b->pixels_log2) {
        const bool own = i < b->count[pixel];
        const uint32_t n = own ? count_bits(b->held[at]) : rest, color = own ? b->color[at] : background;
        rest -= n;
        for (int k = 0; k < 3; k++)
            sum[k] += n * value_of_code(color >> 8 * k & 255u, b->transfer);
    }
    for (int k = 0; k < 3; k++)
        out |= code_of_value(sum[k] >> b->samples_log2, b->transfer) << 8 * k;
    return out;
}
