/* SPDX-License-Identifier: MIT */
/* timemask_slots.c - entries of pixels: taken, lost, merged, averaged. */
#include "timemask_slots.h"

void smear_timemask_slots_place(struct timemask_slots *b, void *memory, uint32_t pixels, int32_t slots_log2, bool linear)
{
    b->held = memory;
    b->color = b->held + TIMEMASK_ENTRIES * pixels;
    b->depth = (uint16_t *)(void *)(b->color + TIMEMASK_ENTRIES * pixels);
    b->pixels = pixels;
    b->slots_log2 = slots_log2;
    b->linear = linear;
}

void smear_timemask_slots_clear(struct timemask_slots *b)
{
    __builtin_memset(b->held, 0, TIMEMASK_ENTRIES * b->pixels * sizeof *b->held);
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

/* Slots of `both` in which a is nearer than b, where their courses may cross: `depth` is a's in the middle of the exposure
 * less b's, in 1/32, `slope` a's slope less b's. */
static SMEAR_NOINLINE uint32_t nearer_slots(int32_t depth, int32_t slope, uint32_t both, int32_t last_slot)
{
    int32_t first = 31 - count_leading_zeros(both & (0u - both)), last = 31 - count_leading_zeros(both);
    int32_t begin = depth + slope * (2 * first - last_slot), end = depth + slope * (2 * last - last_slot);
    if (begin > 0 && end > 0)
        return both;
    if (begin <= 0 && end <= 0)
        return 0;
    /* They cross: slots before are those whose difference has the sign of the first. */
    int32_t step = (end - begin) / (last - first);
    int32_t count = step == 0 ? 1 : clamp_i32(-begin / step, 0, last - first - 1) + 1;
    uint32_t before = both & ((2u << (first + count - 1)) - 1u);
    return begin > 0 ? before : both & ~before;
}

/* ------------------------------------------------------------------ merging */

/* 2^22 / n, rounded up. */
static const uint32_t over[33] = {
    0, 4194304, 2097152, 1398102, 1048576, 838861, 699051, 599187, 524288, 466034, 419431, 381301,
    349526, 322639, 299594, 279621, 262144, 246724, 233017, 220753, 209716, 199729, 190651, 182362,
    174763, 167773, 161320, 155345, 149797, 144632, 139811, 135301, 131072
};

/* (a wa + b wb) / n with n = wa + wb slots: equal codes keep their mean. */
static uint32_t mean_of_two(uint32_t a, uint32_t wa, uint32_t b, uint32_t wb, bool linear)
{
    uint32_t n = wa + wb, out[3];
    for (int c = 0; c < 3; c++) {
        int shift = 16 - 8 * c;
        uint32_t ca = a >> shift & 255u, cb = b >> shift & 255u;
        if (linear)         /* the sum is below 2^21 */
            out[c] = smear_srgb_encode[mulh_u32((smear_srgb_decode[ca] * wa + smear_srgb_decode[cb] * wb) << 11, over[n]) >> 5];
        else                /* below 2^13 */
            out[c] = mulh_u32((ca * wa + cb * wb + n / 2) << 18, over[n]) >> 8;
    }
    return pixel_make(0, out[0], out[1], out[2]);
}

static inline uint32_t distance(uint32_t a, uint32_t b)
{
    return a > b ? a - b : b - a;
}

struct entry {
    uint32_t held, color, depth;
};

static inline struct entry entry_at(const struct timemask_slots *b, uint32_t at)
{
    return (struct entry){ b->held[at], b->color[at], b->depth[at] };
}

static inline void entry_put(struct timemask_slots *b, uint32_t at, const struct entry *e)
{
    b->held[at] = e->held;
    b->color[at] = e->color;
    b->depth[at] = (uint16_t)e->depth;
}

/* Two entries in one: in the course of the longer. */
static struct entry entry_join(const struct entry *a, const struct entry *b, bool linear)
{
    uint32_t wa = count_bits(a->held), wb = count_bits(b->held);
    const struct entry *longer = wa < wb ? b : a;
    struct entry e;
    e.held = a->held | b->held;
    e.color = mean_of_two(a->color, wa, b->color, wb, linear) | (longer->color & 0xff000000u);
    e.depth = longer->depth;
    return e;
}

/* How much it matters that two entries become one: by depths, and by colours. */
static uint32_t unlikeness(const struct entry *a, const struct entry *b)
{
    uint32_t color = distance(pixel_red(a->color), pixel_red(b->color))
                   + distance(pixel_green(a->color), pixel_green(b->color))
                   + distance(pixel_blue(a->color), pixel_blue(b->color));
    return (distance(a->depth, b->depth) + 16u) * (color + 16u);
}

/* All entries are taken: the two of four that are most alike share one. */
static SMEAR_NOINLINE void merge(struct timemask_slots *b, uint32_t pixel, const struct entry *fresh)
{
    struct entry all[TIMEMASK_ENTRIES + 1];
    for (uint32_t e = 0; e < TIMEMASK_ENTRIES; e++)
        all[e] = entry_at(b, pixel * TIMEMASK_ENTRIES + e);
    all[TIMEMASK_ENTRIES] = *fresh;
    uint32_t first = 0, second = 1, least = UINT32_MAX;
    for (uint32_t i = 0; i < TIMEMASK_ENTRIES; i++)
        for (uint32_t j = i + 1; j <= TIMEMASK_ENTRIES; j++) {
            uint32_t d = unlikeness(&all[i], &all[j]);
            if (d < least) {
                least = d;
                first = i;
                second = j;
            }
        }
    struct entry joined = entry_join(&all[first], &all[second], b->linear);
    entry_put(b, pixel * TIMEMASK_ENTRIES + first, &joined);
    if (second != TIMEMASK_ENTRIES)
        entry_put(b, pixel * TIMEMASK_ENTRIES + second, fresh);
}

/* ------------------------------------------------------------------ fragments */

/* Depth codes of one surface, for all that matters here. */
static inline bool is_level(uint32_t a, uint32_t b)
{
    return distance(a, b) <= a >> 6;
}

void smear_timemask_slots_add(struct timemask_slots *b, uint32_t pixel, uint32_t mask, uint32_t color, uint32_t depth,
                              int32_t slope)
{
    const int32_t last_slot = (1 << b->slots_log2) - 1;
    uint32_t *const held = b->held + pixel * TIMEMASK_ENTRIES, *const colors = b->color + pixel * TIMEMASK_ENTRIES;
    uint16_t *const depths = b->depth + pixel * TIMEMASK_ENTRIES;
    uint32_t occupied = 0;
    for (uint32_t i = 0; i < TIMEMASK_ENTRIES; i++)
        occupied |= held[i];
    if ((occupied & mask) != 0) {
        for (uint32_t i = 0; i < TIMEMASK_ENTRIES; i++) {
            uint32_t both = held[i] & mask;
            if (both == 0)
                continue;
            int32_t apart = ((int32_t)depth - (int32_t)depths[i]) * 32;
            int32_t turn = slope - timemask_slope_of(colors[i]), most = abs_i32(turn) * last_slot;
            uint32_t taken = apart > most ? both : apart <= -most ? 0 : nearer_slots(apart, turn, both, last_slot);
            mask &= ~both | taken;
            held[i] &= ~taken;
        }
        if (mask == 0)
            return;
    }
    uint32_t free = TIMEMASK_ENTRIES;
    for (uint32_t i = TIMEMASK_ENTRIES; i-- > 0;) {
        if (held[i] == 0) {
            free = i;
        } else if (colors[i] << 8 == color << 8 && is_level(depths[i], depth)) {
            held[i] |= mask;
            return;
        }
    }
    struct entry fresh = { mask, color, depth };
    if (free < TIMEMASK_ENTRIES)
        entry_put(b, pixel * TIMEMASK_ENTRIES + free, &fresh);
    else
        merge(b, pixel, &fresh);
}

/* Linear light, entry by entry; `rest` slots of the still colour. */
static uint32_t mean_linear(const struct timemask_slots *b, uint32_t pixel, uint32_t still)
{
    uint32_t rest = 1u << b->slots_log2, sum[3] = { 0, 0, 0 }, half = rest >> 1;
    for (uint32_t e = 0; e <= TIMEMASK_ENTRIES; e++) {
        uint32_t at = pixel * TIMEMASK_ENTRIES + e;
        uint32_t n = e < TIMEMASK_ENTRIES ? count_bits(b->held[at]) : rest, color = e < TIMEMASK_ENTRIES ? b->color[at] : still;
        rest -= n;
        if (n == 0)
            continue;
        sum[0] += n * smear_srgb_decode[pixel_red(color)];
        sum[1] += n * smear_srgb_decode[pixel_green(color)];
        sum[2] += n * smear_srgb_decode[pixel_blue(color)];
    }
    for (int c = 0; c < 3; c++)
        sum[c] = smear_srgb_encode[(sum[c] + half) >> b->slots_log2 >> 4];
    return pixel_make(0, sum[0], sum[1], sum[2]);
}

uint32_t smear_timemask_slots_mean(const struct timemask_slots *b, uint32_t pixel, uint32_t still)
{
    const uint32_t all = UINT32_MAX >> (32 - (1 << b->slots_log2));
    uint32_t rest = 1u << b->slots_log2, half = rest >> 1, red_blue = half * 0x10001u, green = half;
    for (uint32_t at = pixel * TIMEMASK_ENTRIES, end = at + TIMEMASK_ENTRIES; at < end; at++) {
        uint32_t held = b->held[at];
        if (held == 0)
            continue;
        if (held == all)
            return b->color[at] & 0xffffffu;
        if (b->linear)
            return mean_linear(b, pixel, still);
        uint32_t n = count_bits(held), color = b->color[at];
        rest -= n;
        red_blue += (color & 0xff00ffu) * n;
        green += (color >> 8 & 0xffu) * n;
    }
    red_blue += (still & 0xff00ffu) * rest;
    green += (still >> 8 & 0xffu) * rest;
    return (red_blue >> b->slots_log2 & 0xff00ffu) | (green >> b->slots_log2 & 0xffu) << 8;
}
