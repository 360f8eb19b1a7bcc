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

/* ------------------------------------------------------------------ merging */

/* 2^18 / n, rounded up. */
static const uint32_t over[33] = {
    0, 262144, 131072, 87382, 65536, 52429, 43691, 37450, 32768, 29128, 26215, 23832, 21846, 20165, 18725, 17477,
    16384, 15421, 14564, 13798, 13108, 12484, 11916, 11398, 10923, 10486, 10083, 9710, 9363, 9040, 8739, 8457, 8192
};

/* (a wa + b wb) / n to nearest, with n = wa + wb >= 2 slots. */
static uint32_t mean_of_two(uint32_t a, uint32_t wa, uint32_t b, uint32_t wb, bool linear)
{
    uint32_t n = wa + wb, out[3];
    for (int c = 0; c < 3; c++) {
        int shift = 16 - 8 * c;
        uint32_t ca = a >> shift & 255u, cb = b >> shift & 255u;
        if (linear) {       /* q12, below 2^17 for 32 slots */
            uint32_t sum = (smear_srgb_decode[ca] * wa + smear_srgb_decode[cb] * wb) >> 4;
            out[c] = smear_srgb_encode[sum * (over[n] >> 3) >> 15];
        } else {
            out[c] = (ca * wa + cb * wb + n / 2) * over[n] >> 18;
        }
    }
    return pixel_make(0, out[0], out[1], out[2]);
}

static inline uint32_t distance(uint32_t a, uint32_t b)
{
    return a > b ? a - b : b - a;
}

/* All entries are taken: the two of four that lie closest in depth share one. */
static void merge(struct timemask_slots *b, uint32_t pixel, uint32_t mask, uint32_t color, uint32_t depth)
{
    uint32_t held[TIMEMASK_ENTRIES + 1], colors[TIMEMASK_ENTRIES + 1], depths[TIMEMASK_ENTRIES + 1];
    for (uint32_t e = 0; e < TIMEMASK_ENTRIES; e++) {
        held[e] = b->held[e * b->pixels + pixel];
        colors[e] = b->color[e * b->pixels + pixel];
        depths[e] = b->depth[e * b->pixels + pixel];
    }
    held[TIMEMASK_ENTRIES] = mask;
    colors[TIMEMASK_ENTRIES] = color;
    depths[TIMEMASK_ENTRIES] = depth;
    uint32_t first = 0, second = 1, least = UINT32_MAX;
    for (uint32_t i = 0; i < TIMEMASK_ENTRIES; i++)
        for (uint32_t j = i + 1; j <= TIMEMASK_ENTRIES; j++) {
            uint32_t d = distance(depths[i], depths[j]);
            if (d < least) {
                least = d;
                first = i;
                second = j;
            }
        }
    uint32_t wa = count_bits(held[first]), wb = count_bits(held[second]);
    uint32_t at = first * b->pixels + pixel;
    b->held[at] = held[first] | held[second];
    b->color[at] = mean_of_two(colors[first], wa, colors[second], wb, b->linear);
    b->depth[at] = (uint16_t)((depths[first] + depths[second] + 1) >> 1);
    if (second == TIMEMASK_ENTRIES)
        return;
    at = second * b->pixels + pixel;
    b->held[at] = mask;
    b->color[at] = color;
    b->depth[at] = (uint16_t)depth;
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
    for (uint32_t e = 0; e < TIMEMASK_ENTRIES; e++) {
        uint32_t at = e * b->pixels + pixel;
        uint32_t both = b->held[at] & mask;
        if (both != 0) {
            if (depth > b->depth[at])
                b->held[at] &= ~mask;
            else
                mask &= ~both;
        }
        if (b->held[at] == 0)
            free = e;
        else if (b->color[at] == color && is_level(b->depth[at], depth))
            same = e;
    }
    if (mask == 0)
        return;
    if (same < TIMEMASK_ENTRIES) {
        b->held[same * b->pixels + pixel] |= mask;
    } else if (free < TIMEMASK_ENTRIES) {
        uint32_t at = free * b->pixels + pixel;
        b->held[at] = mask;
        b->color[at] = color;
        b->depth[at] = (uint16_t)depth;
    } else {
        merge(b, pixel, mask, color, depth);
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
