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

static inline int32_t first_of(uint32_t mask)
{
    return 31 - count_leading_zeros(mask & (0u - mask));
}

static inline int32_t last_of(uint32_t mask)
{
    return 31 - count_leading_zeros(mask);
}

/* Twice the middle. */
static inline int32_t middle_of(uint32_t mask)
{
    return first_of(mask) + last_of(mask);
}

/* A depth code, in 1/32, goes by twice its slope per slot. */
struct course {
    int32_t depth, slope, middle;
};

static inline struct course course_of(uint32_t mask, uint32_t color, uint32_t depth)
{
    return (struct course){ (int32_t)depth * 32, timemask_slope_of(color), middle_of(mask) };
}

static inline int32_t course_at(const struct course *c, int32_t twice_slot)
{
    return c->depth + c->slope * (twice_slot - c->middle);
}

/* As it is kept for other slots. */
static inline uint32_t course_code(const struct course *c, uint32_t mask)
{
    return (uint32_t)clamp_i32((course_at(c, middle_of(mask)) + 16) >> 5, 0, 65535);
}

/* Slots of `both` in which a is nearer than b. */
static uint32_t nearer(const struct course *a, const struct course *b, uint32_t both)
{
    int32_t first = first_of(both), last = last_of(both);
    int32_t begin = course_at(a, 2 * first) - course_at(b, 2 * first);
    int32_t end = course_at(a, 2 * last) - course_at(b, 2 * last);
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
    struct course course = course_of(longer->held, longer->color, longer->depth);
    struct entry e;
    e.held = a->held | b->held;
    e.color = mean_of_two(a->color, wa, b->color, wb, linear) | (longer->color & 0xff000000u);
    e.depth = course_code(&course, e.held);
    return e;
}

/* How much it matters that two entries become one: by depths where they meet, and by colours. */
static uint32_t apart(const struct entry *a, const struct entry *b)
{
    struct course ca = course_of(a->held, a->color, a->depth), cb = course_of(b->held, b->color, b->depth);
    int32_t between = (ca.middle + cb.middle) >> 1;
    uint32_t deeper = (uint32_t)abs_i32(course_at(&ca, between) - course_at(&cb, between)) >> 5;
    uint32_t color = distance(pixel_red(a->color), pixel_red(b->color))
                   + distance(pixel_green(a->color), pixel_green(b->color))
                   + distance(pixel_blue(a->color), pixel_blue(b->color));
    return (deeper + 16u) * (color + 16u);
}

/* All entries are taken: the two of four that are most alike share one. */
static void merge(struct timemask_slots *b, uint32_t pixel, const struct entry *fresh)
{
    struct entry all[TIMEMASK_ENTRIES + 1];
    for (uint32_t e = 0; e < TIMEMASK_ENTRIES; e++)
        all[e] = entry_at(b, e * b->pixels + pixel);
    all[TIMEMASK_ENTRIES] = *fresh;
    uint32_t first = 0, second = 1, least = UINT32_MAX;
    for (uint32_t i = 0; i < TIMEMASK_ENTRIES; i++)
        for (uint32_t j = i + 1; j <= TIMEMASK_ENTRIES; j++) {
            uint32_t d = apart(&all[i], &all[j]);
            if (d < least) {
                least = d;
                first = i;
                second = j;
            }
        }
    struct entry joined = entry_join(&all[first], &all[second], b->linear);
    entry_put(b, first * b->pixels + pixel, &joined);
    if (second != TIMEMASK_ENTRIES)
        entry_put(b, second * b->pixels + pixel, fresh);
}

/* ------------------------------------------------------------------ fragments */

/* Depth codes of one surface, for all that matters here. */
static inline bool is_level(uint32_t a, uint32_t b)
{
    return distance(a, b) <= a >> 6;
}

void smear_timemask_slots_add(struct timemask_slots *b, uint32_t pixel, uint32_t mask, uint32_t color, uint32_t depth)
{
    uint32_t free = TIMEMASK_ENTRIES, same = TIMEMASK_ENTRIES;
    struct entry fresh = { mask, color, depth };
    struct course course = course_of(mask, color, depth);
    for (uint32_t i = 0; i < TIMEMASK_ENTRIES; i++) {
        uint32_t at = i * b->pixels + pixel, both = b->held[at] & fresh.held;
        if (both != 0) {
            struct course old = course_of(b->held[at], b->color[at], b->depth[at]);
            uint32_t taken = nearer(&course, &old, both);
            fresh.held &= ~(both & ~taken);
            if (taken != 0) {
                b->held[at] &= ~taken;
                if (b->held[at] != 0)
                    b->depth[at] = (uint16_t)course_code(&old, b->held[at]);
            }
        }
        if (b->held[at] == 0)
            free = i;
        else if (((b->color[at] ^ color) & 0xffffffu) == 0 && is_level(b->depth[at], depth))
            same = i;
    }
    if (fresh.held == 0)
        return;
    if (fresh.held != mask)
        fresh.depth = course_code(&course, fresh.held);
    if (same < TIMEMASK_ENTRIES) {
        struct entry e = entry_at(b, same * b->pixels + pixel);
        struct course old = course_of(e.held, e.color, e.depth);
        e.held |= fresh.held;
        e.depth = course_code(&old, e.held);
        entry_put(b, same * b->pixels + pixel, &e);
    } else if (free < TIMEMASK_ENTRIES) {
        entry_put(b, free * b->pixels + pixel, &fresh);
    } else {
        merge(b, pixel, &fresh);
    }
}

uint32_t smear_timemask_slots_mean(const struct timemask_slots *b, uint32_t pixel, uint32_t still)
{
    uint32_t rest = 1u << b->slots_log2, sum[3] = { 0, 0, 0 }, out[3];
    for (uint32_t e = 0; e <= TIMEMASK_ENTRIES; e++) {
        uint32_t at = e * b->pixels + pixel, color = still, n = rest;
        if (e < TIMEMASK_ENTRIES) {
            n = count_bits(b->held[at]);
            color = b->color[at];
            rest -= n;
        }
        if (n == 0)
            continue;
        for (int c = 0; c < 3; c++) {
            uint32_t code = color >> (16 - 8 * c) & 255u;
            sum[c] += n * (b->linear ? smear_srgb_decode[code] : code);
        }
    }
    for (int c = 0; c < 3; c++) {
        uint32_t mean = (sum[c] + ((1u << b->slots_log2) >> 1)) >> b->slots_log2;
        out[c] = b->linear ? smear_srgb_encode[mean >> 4] : mean;
    }
    return pixel_make(0, out[0], out[1], out[2]);
}
