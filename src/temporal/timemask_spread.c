/* SPDX-License-Identifier: MIT */
/* timemask_spread.c - straight lines between samples, over the still scene. */
#include "temporal/timemask_spread.h"

static int32_t samples_of(const struct timemask_spread *s)
{
    return ((s->width - 1) >> s->across_log2) + (s->across_log2 != 0 ? 2 : 1);
}

static void take_row(struct timemask_spread *s, int32_t row)
{
    for (int32_t i = 0; i < samples_of(s); i++)
        smear_timemask_samples_sum(s->slots, (uint32_t)(row * s->down + i * s->right), s->sum[row & 1].word[i]);
}

/* A sample's sum. */
struct sum {
    uint32_t word[TIMEMASK_SUM_WORDS];
};

/* Sums of a row of pixels, times 2^down_log2. */
static const struct sum *rows_mix(struct timemask_spread *s, int32_t y, struct sum mix[TIMEMASK_WIDTH])
{
    const int32_t down = 1 << s->down_log2, part = y & (down - 1), row = y >> s->down_log2;
    if (part == 0 && (row == 0 || down == 1))
        take_row(s, row);
    if (part == 0 && down != 1)
        take_row(s, row + 1);
    const struct timemask_sums *above = &s->sum[row & 1], *below = &s->sum[~row & 1];
    for (int32_t i = 0; i < samples_of(s); i++)
        for (int k = 0; k < TIMEMASK_SUM_WORDS; k++)
            mix[i].word[k] = down == 1 ? above->word[i][k]
                           : above->word[i][k] * (uint32_t)(down - part) + below->word[i][k] * (uint32_t)part;
    return mix;
}

/* The rest of the exposure shows the still scene. */
SMEAR_INLINE uint32_t over_still(const uint32_t sum[TIMEMASK_SUM_WORDS], uint32_t still, int shift,
                                 bool linear)
{
    const uint32_t all = 1u << shift, half = all >> 1;
    if (linear) {
        uint32_t rest = all - sum[3], down = (uint32_t)shift + 4;
        return pixel_make(0,
                          smear_srgb_encode[(sum[0] + smear_srgb_decode[pixel_red(still)] * rest + half)
                                            >> down],
                          smear_srgb_encode[(sum[1] + smear_srgb_decode[pixel_green(still)] * rest + half)
                                            >> down],
                          smear_srgb_encode[(sum[2] + smear_srgb_decode[pixel_blue(still)] * rest + half)
                                            >> down]);
    }
    uint32_t rest = all - (sum[1] & 0xffffu);
    uint32_t red_blue = sum[0] + (still & 0xff00ffu) * rest + half * 0x10001u;
    uint32_t green = (sum[1] >> 16) + pixel_green(still) * rest + half;
    return (red_blue >> shift & 0xff00ffu) | (green >> shift & 0xffu) << 8;
}

/* A pixel where the still scene may lie between moving triangles: samples are asked again. */
static SMEAR_NOINLINE void sum_before(const struct timemask_spread *s, int32_t x, int32_t y, int32_t code,
                                      uint32_t sum[TIMEMASK_SUM_WORDS])
{
    const int32_t across = 1 << s->across_log2, down = 1 << s->down_log2;
    const int32_t right = x & (across - 1), low = y & (down - 1);
    int32_t pixel = (y >> s->down_log2) * s->down + (x >> s->across_log2) * s->right;
    sum[0] = sum[1] = sum[2] = sum[3] = 0;
    for (int i = 0; i < 4; i++) {
        uint32_t weight = (uint32_t)((i & 1 ? right : across - right) * (i & 2 ? low : down - low));
        uint32_t one[TIMEMASK_SUM_WORDS];
        if (weight == 0)
            continue;
        smear_timemask_samples_sum_before(s->slots,
                                        (uint32_t)(pixel + (i & 1 ? s->right : 0) + (i & 2 ? s->down : 0)),
                                        code, one);
        for (int k = 0; k < TIMEMASK_SUM_WORDS; k++)
            sum[k] += one[k] * weight;
    }
}

SMEAR_INLINE void spread_row(struct timemask_spread *s, int32_t y, uint32_t *out, const uint32_t *color,
                             const uint16_t *depth, bool linear)
{
    const int words = linear ? (int)TIMEMASK_SUM_WORDS : 2;
    const int shift = s->slots->slots_log2 + s->across_log2 + s->down_log2;
    const int32_t across = 1 << s->across_log2;
    uint32_t sum[TIMEMASK_SUM_WORDS], step[TIMEMASK_SUM_WORDS];
    struct sum mix[TIMEMASK_WIDTH];
    const struct sum *sample = rows_mix(s, y, mix);
    for (int32_t x = 0; x < s->width; x++) {
        if ((x & (across - 1)) == 0) {
            int32_t i = x >> s->across_log2;
            for (int k = 0; k < words; k++) {
                sum[k] = sample[i].word[k] << s->across_log2;
                step[k] = across == 1 ? 0 : sample[i + 1].word[k] - sample[i].word[k];
            }
        }
        if ((int32_t)depth[x] < s->back) {
            out[x] = over_still(sum, color[x], shift, linear);
        } else if ((int32_t)depth[x] >= s->front) {
            out[x] = color[x];
        } else {
            uint32_t own[TIMEMASK_SUM_WORDS];
            sum_before(s, x, y, depth[x], own);
            out[x] = over_still(own, color[x], shift, linear);
        }
        for (int k = 0; k < words; k++)
            sum[k] += step[k];
    }
}

void smear_timemask_spread(struct timemask_spread *s, int32_t y, uint32_t *out, const uint32_t *color,
                           const uint16_t *depth)
{
    if (s->slots->linear)
        spread_row(s, y, out, color, depth, true);
    else
        spread_row(s, y, out, color, depth, false);
}
