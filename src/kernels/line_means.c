/* SPDX-License-Identifier: MIT */
/* line_means.c - see line_means.h.
 *
 * Of 8 taps at most, red and blue add up beside each other in a word, and so do all three channels: what these have more is
 * green, 256 times. */
#include "kernels/line_means.h"

#include "base/fixmath.h"
#include "base/pixel.h"
#include "base/tables.h"
#include "kernels/packed_sums.h"
#include "kernels/vector.h"
#if PACKED_ASM_ARMV6M
#include "kernels/line_means_armv6m.h"
#endif

/* Rounds sums of 2^log codes. */
SMEAR_INLINE uint32_t mean_of(uint32_t all, uint32_t red_blue, int32_t log)
{
    const uint32_t half = (1u << log) >> 1, green = ((all - red_blue) >> 8) + half;
    return ((red_blue + half * 0x10001u) >> log & 0xff00ffu) | (green >> log & 0xffu) << 8;
}

SMEAR_INLINE uint32_t code_mean(const uint32_t *in, const int32_t *offset, int32_t log)
{
    uint32_t all = 0, red_blue = 0;
    for (int k = 0; k < 1 << log; k++) {
        const uint32_t c = in[offset[k]];
        all += c;
        red_blue += c & 0xff00ffu;
    }
    return mean_of(all, red_blue, log);
}

/* Most pixels of a line are alike: their light is not asked for. */
static uint32_t light_mean(const uint32_t *in, const int32_t *offset, int32_t log)
{
    const uint32_t first = in[offset[0]];
    uint32_t r = 0, g = 0, b = 0, differs = 0;
    for (int k = 1; k < 1 << log; k++)
        differs |= in[offset[k]] ^ first;
    if (differs == 0)
        return first & 0xffffffu;
    for (int k = 0; k < 1 << log; k++) {
        const uint32_t c = in[offset[k]];
        r += smear_srgb_decode[pixel_red(c)];
        g += smear_srgb_decode[pixel_green(c)];
        b += smear_srgb_decode[pixel_blue(c)];
    }
    return pixel_make(0, smear_srgb_encode[r >> (log + 4)], smear_srgb_encode[g >> (log + 4)], smear_srgb_encode[b >> (log + 4)]);
}

void smear_line_means_reference(const struct line_block *b, bool linear)
{
    for (int32_t y = 0; y < b->rows; y++)
        for (int32_t x = 0; x < b->columns; x++) {
            const uint32_t *in = b->in + y * b->in_stride + x;
            b->out[y * b->out_stride + x] = SMEAR_WITH_LINEAR && linear ? light_mean(in, b->offset, b->log)
                                                                        : code_mean(in, b->offset, b->log);
        }
}

/* Codes of a number of taps that is known. */
SMEAR_INLINE void code_means(const struct line_block *b, int32_t log)
{
    for (int32_t y = 0; y < b->rows; y++) {
        const uint32_t *in = b->in + y * b->in_stride, *const end = in + b->columns;
        uint32_t *out = b->out + y * b->out_stride;
#if SMEAR_VECTORS
        const uint32_t half = (1u << log) >> 1;
        for (; end - in >= 4; in += 4, out += 4) {
            smear_v4u all = { 0, 0, 0, 0 }, red_blue = { 0, 0, 0, 0 };
            for (int k = 0; k < 1 << log; k++) {
                const smear_v4u c = v4u_load(in + b->offset[k]);
                all += c;
                red_blue += c & 0xff00ffu;
            }
            const smear_v4u green = ((all - red_blue) >> 8) + half;
            v4u_store(out, ((red_blue + half * 0x10001u) >> log & 0xff00ffu) | (green >> log & 0xffu) << 8);
        }
#endif
        for (; in != end; in++, out++)
            *out = code_mean(in, b->offset, log);
    }
}

#if PACKED_ASM_ARMV6M
/* Eight taps, two pixels at once. */
static void code_means8(const struct line_block *b)
{
    const int32_t even = b->columns & ~1;
    int32_t bytes[8];
    for (int k = 0; k < 8; k++)
        bytes[k] = b->offset[k] * 4;
    for (int32_t y = 0; y < b->rows; y++) {
        const uint32_t *in = b->in + y * b->in_stride;
        uint32_t *out = b->out + y * b->out_stride;
        if (even != 0)
            line_means_armv6m(out, in, bytes, even);
        if (even != b->columns)
            out[even] = code_mean(in + even, b->offset, 3);
    }
}
#else
static void code_means8(const struct line_block *b) { code_means(b, 3); }
#endif

void smear_line_means(const struct line_block *b, bool linear)
{
    if (SMEAR_WITH_LINEAR && linear)
        smear_line_means_reference(b, true);
    else if (b->log == 3)
        code_means8(b);
    else if (b->log == 2)
        code_means(b, 2);
    else
        code_means(b, b->log);
}
