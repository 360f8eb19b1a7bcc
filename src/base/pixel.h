/* SPDX-License-Identifier: MIT */
/* pixel.h - the working pixel: 0xAARRGGBB, r g b as sRGB codes in both light modes.
 *
 * A working pixel is what the display would show, in 8 bits. Linear light is a matter of how values are
 * multiplied, interpolated and averaged (through smear_srgb_decode and back), not of how they are kept: so a
 * window costs the same in both modes, and a pixel that nothing blurs passes every filter unchanged. */
#ifndef SMEAR_PIXEL_H
#define SMEAR_PIXEL_H

#include "base/fixed.h"
#include "base/tables.h"

/* What a frame multiplies, interpolates and averages: codes as they are, or the linear light that they stand for, of which 65535 is
 * one. Who handles colours hands it on to what is below, which asks. */
enum { TRANSFER_CODES, TRANSFER_LINEAR };
typedef uint8_t smear_transfer;

static inline bool transfer_is_linear(smear_transfer t) { return SMEAR_WITH_LINEAR && t == TRANSFER_LINEAR; }

static inline uint32_t value_of_code(uint32_t code, smear_transfer t)
{
    return transfer_is_linear(t) ? smear_srgb_decode[code] : code;
}

static inline uint32_t code_of_value(uint32_t value, smear_transfer t)
{
    return transfer_is_linear(t) ? smear_srgb_encode[value >> 4] : value;
}

/* Codes as they are, or light of 12 bits; and the code of that, which may be more than one. */
static inline uint32_t short_of_code(uint32_t code, smear_transfer t)
{
    return transfer_is_linear(t) ? smear_srgb_decode[code] >> 4 : code;
}

static inline uint32_t code_of_short(uint32_t value, smear_transfer t)
{
    return transfer_is_linear(t) ? smear_srgb_encode[min_u32(value, 4095u)] : min_u32(value, 255u);
}

/* The code of a sum of values, which may be more than one. */
static inline uint32_t code_of_sum(uint32_t value, smear_transfer t)
{
    return code_of_value(min_u32(value, value_of_code(255u, t)), t);
}

static inline uint32_t pixel_red(uint32_t p) { return p >> 16 & 255u; }
static inline uint32_t pixel_green(uint32_t p) { return p >> 8 & 255u; }
static inline uint32_t pixel_blue(uint32_t p) { return p & 255u; }
static inline uint32_t pixel_alpha(uint32_t p) { return p >> 24; }

static inline uint32_t pixel_make(uint32_t a, uint32_t r, uint32_t g, uint32_t b)
{
    return a << 24 | r << 16 | g << 8 | b;
}

/* Makes a pixel of bytes r g b a. */
static inline uint32_t pixel_of_bytes(const uint8_t *c) { return pixel_make(c[3], c[0], c[1], c[2]); }

/* Returns a b / 255 to nearest for codes a and b, exactly for all pairs. */
static inline uint32_t code_times(uint32_t a, uint32_t b)
{
    uint32_t t = a * b + 128u;
    return (t + (t >> 8)) >> 8;
}

/* Makes a pixel of values. */
static inline uint32_t pixel_of_values(uint32_t r, uint32_t g, uint32_t b, smear_transfer t)
{
    return pixel_make(0, code_of_value(r, t), code_of_value(g, t), code_of_value(b, t));
}

/* A channel is what is interpolated between vertices: q16 codes, or linear light << 8. */
static inline uint32_t channel_of_code(uint32_t code, smear_transfer t)
{
    return transfer_is_linear(t) ? (uint32_t)smear_srgb_decode[code] << 8 : code << 16;
}

/* That of a vertex's 16 bits: codes are rounded by 1/2; linear light is looked up by its floor. Both keep a margin from 0 and 256 that
 * rounding errors of a plane do not cross. */
static inline int32_t channel_of_vertex(uint32_t value, smear_transfer t)
{
    const int32_t a = (int32_t)(value << 8);
    return transfer_is_linear(t) ? clamp_i32(a, 0x400, 0xffe000) : min_i32(a + 0x8000, 0xff8000);
}

/* What rounds it to a code. */
static inline uint32_t channel_round(smear_transfer t) { return transfer_is_linear(t) ? 0 : 0x8000u; }

static inline uint32_t code_of_channel(uint32_t channel, smear_transfer t)
{
    return transfer_is_linear(t) ? smear_srgb_encode[channel >> 12] : channel >> 16;
}

static inline uint32_t pixel_of_channels(uint32_t r, uint32_t g, uint32_t b, smear_transfer t)
{
    return pixel_make(0, code_of_channel(r, t), code_of_channel(g, t), code_of_channel(b, t));
}

/* Multiplies a code's light by linear light (65535 is one); returns the code of the product. */
static inline uint32_t code_times_linear(uint32_t code, uint32_t light)
{
    return smear_srgb_encode[(smear_srgb_decode[code] * (light + (light >> 15))) >> 20];
}

/* The same by what is interpolated, of which so many bits may be there as may. */
static inline uint32_t code_times_channel(uint32_t code, uint32_t channel, smear_transfer t)
{
    return transfer_is_linear(t) ? code_times_linear(code, channel >> 8 & 0xffffu) : code_times(code, channel >> 16 & 255u);
}

/* A texel in a light of these channels, or, white, of blue alone. */
SMEAR_INLINE uint32_t shaded_pixel(uint32_t t, uint32_t r, uint32_t g, uint32_t b, bool white, bool linear)
{
    const smear_transfer transfer = linear ? TRANSFER_LINEAR : TRANSFER_CODES;
    const uint32_t pair = 0xff00ffu, green = code_times_channel(pixel_green(t), white ? b : g, transfer);
    if (white && !linear) {
        const uint32_t rb = (t & pair) * (b >> 16 & 255u) + 0x800080u;
        return ((rb + (rb >> 8 & pair)) >> 8 & pair) | green << 8;
    }
    return pixel_make(0, code_times_channel(pixel_red(t), white ? b : r, transfer), green,
                      code_times_channel(pixel_blue(t), b, transfer));
}

/* Returns smear_srgb_encode[light] without the table: how many borders between codes lie below. A border is the mean
 * of two codes' light; at three values that is off by one. */
static inline uint32_t srgb_encode_searched(uint32_t light)
{
    uint32_t code = 0;
    for (uint32_t step = 128; step != 0; step >>= 1)
        if ((uint32_t)smear_srgb_decode[code + step - 1] + smear_srgb_decode[code + step] < 32u * light + 16u)
            code += step;
    return code + (light == 527u || light == 1116u) - (light == 2146u);
}

/* Mixes src into dst by a of 256 parts, as codes: two channels per word; a lane is at most 0xff80 before the shift. */
static inline uint32_t pixel_mix(uint32_t dst, uint32_t src, uint32_t a)
{
    const uint32_t b = 256u - a;
    const uint32_t rb = ((src & 0xff00ffu) * a + (dst & 0xff00ffu) * b + 0x800080u) >> 8 & 0xff00ffu;
    const uint32_t g = (pixel_green(src) * a + pixel_green(dst) * b + 0x80u) >> 8;
    return rb | g << 8;
}

/* Mixes code b into code a by `part` of 256. */
static inline uint32_t code_mix(uint32_t a, uint32_t b, uint32_t part, smear_transfer t)
{
    const uint32_t sum = value_of_code(a, t) * (256u - part) + value_of_code(b, t) * part;
    return transfer_is_linear(t) ? smear_srgb_encode[sum >> 12] : (sum + 128u) >> 8;
}

/* Blends src over dst by alpha 0 .. 255: alpha 0 keeps dst exactly, 255 gives src exactly. */
static inline uint32_t pixel_blend(uint32_t dst, uint32_t src, uint32_t alpha, smear_transfer t)
{
    const uint32_t a = alpha + (alpha >> 7);
    if (!transfer_is_linear(t))
        return pixel_mix(dst, src, a);
    if (a == 256u)
        return src & 0xffffffu;
    if (a == 0)
        return dst;
    return pixel_make(0, code_mix(pixel_red(dst), pixel_red(src), a, t), code_mix(pixel_green(dst), pixel_green(src), a, t),
                      code_mix(pixel_blue(dst), pixel_blue(src), a, t));
}

static inline uint32_t light_mean_of(uint32_t a, uint32_t b, uint32_t c, uint32_t d)
{
    const uint32_t sum = (uint32_t)smear_srgb_decode[a & 255u] + smear_srgb_decode[b & 255u] + smear_srgb_decode[c & 255u]
                       + smear_srgb_decode[d & 255u];
    return smear_srgb_encode[(sum + 2u) >> 6];
}

/* Returns the mean of four pixels, to nearest. */
static inline uint32_t pixel_mean(uint32_t a, uint32_t b, uint32_t c, uint32_t d, smear_transfer t)
{
    if (transfer_is_linear(t))
        return light_mean_of(a >> 16, b >> 16, c >> 16, d >> 16) << 16 | light_mean_of(a >> 8, b >> 8, c >> 8, d >> 8) << 8
             | light_mean_of(a, b, c, d);
    const uint32_t low = 0xff00ffu;         /* red and blue at once: sums have 10 bits */
    const uint32_t red_blue = (a & low) + (b & low) + (c & low) + (d & low) + 0x20002u;
    const uint32_t green = (a >> 8 & 255u) + (b >> 8 & 255u) + (c >> 8 & 255u) + (d >> 8 & 255u) + 2u;
    return (red_blue >> 2 & low) | (green >> 2) << 8;
}

/* Mixes `over` into a pixel by a part of 65536 and keeps the pixel's alpha. Dark pixels in linear light show less than a
 * 256th of it. */
static inline uint32_t pixel_mix_part(uint32_t pixel, uint32_t over, int32_t part, smear_transfer t)
{
    const uint32_t a = (uint32_t)part, b = 65536u - a;
    uint32_t out = pixel >> 24;
    if (!transfer_is_linear(t))
        return out << 24 | pixel_mix(pixel, over, (a + 128u) >> 8);
    for (int shift = 16; shift >= 0; shift -= 8)
        out = out << 8 | smear_srgb_encode[(smear_srgb_decode[over >> shift & 255u] * a
                                            + smear_srgb_decode[pixel >> shift & 255u] * b) >> 20];
    return out;
}

/* Returns the nearest levels of 5, 6 and 5 bits, red on top: (249 c + 1014) >> 11 and (253 c + 505) >> 10, both exact
 * for every code. Red and blue share a product: 255 x 249 + 1014 stays below 2^16. */
static inline uint32_t rgb565_nearest(uint32_t p)
{
    uint32_t rb = (p & 0xff00ffu) * 249u + 0x03f603f6u;
    uint32_t g = pixel_green(p) * 253u + 505u;
    return (rb >> 16 & 0xf800u) | (g >> 5 & 0x7e0u) | (rb >> 11 & 0x1fu);
}

/* The same with five bits of green, and blue on top. */
static inline uint32_t rgb555_nearest(uint32_t p)
{
    const uint32_t rb = (p & 0xff00ffu) * 249u + 0x03f603f6u, g = pixel_green(p) * 249u + 1014u;
    return (rb >> 1 & 0x7c00u) | (g >> 6 & 0x3e0u) | rb >> 27;
}

/* The pixel `n` further on: narrow ones have 16 bits, others 32. */
static inline void *pixel_after(void *pixel, int32_t n, bool narrow)
{
    return narrow ? (void *)((uint16_t *)pixel + n) : (void *)((uint32_t *)pixel + n);
}

/* A word of pixels of any width. Compilers without this attribute are to be told not to guess from types what pointers can
 * point to, if they do (-fno-strict-aliasing). */
#if SMEAR_GNU
typedef uint32_t __attribute__((may_alias)) pixel_word;
#else
typedef uint32_t pixel_word;
#endif

/* Returns the square by which two colours differ. */
static inline uint32_t pixel_square_between(uint32_t a, uint32_t b)
{
    const uint32_t red = pixel_red(a) - pixel_red(b), green = pixel_green(a) - pixel_green(b), blue = pixel_blue(a) - pixel_blue(b);
    return red * red + green * green + blue * blue;
}

#endif
