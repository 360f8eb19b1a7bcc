/* SPDX-License-Identifier: MIT */
/* texel_lit.h - what eight texels become in light, by AVX2: for rows of a triangle (texel_rows.h). */
#ifndef SMEAR_KERNELS_TEXEL_LIT_H
#define SMEAR_KERNELS_TEXEL_LIT_H

#include "base/pixel.h"
#include "kernels/avx2.h"
#include "kernels/light_planes.h"

#if SMEAR_AVX2

/* Texels of any format, and the light on them. Its blocks, if there are any, are those of coordinates that follow chords, or
 * single pixels of rows that have SHORT_SPAN of them at most. */
struct texel_lights {
    const uint32_t *palette;
    int format;                         /* smear_texel_format */
    bool linear;
    bool plain;                         /* white: texels keep their codes */
    struct light_planes planes;
};

/* light: as light_planes_at() finds it. */
static inline uint32_t lit_texel_reference(const struct texel_lights *k, uint32_t t, const uint32_t light_of[3])
{
    uint32_t code[3];
    for (int i = 0; i < 3; i++) {
        const uint32_t of_texel = t >> (16 - 8 * i) & 255u, light = light_of[i];
        code[i] = k->plain ? of_texel : k->linear ? code_times_linear(of_texel, light >> 8 & 0xffffu)
                                                  : code_times(of_texel, light >> 16 & 255u);
    }
    return pixel_make(0, code[0], code[1], code[2]);
}

/* Light of the levels of RGB565: of red and blue, and of green. */
struct lit_levels {
    uint32_t five[32], six[64];
};

extern const struct lit_levels smear_lit_levels;

/* Numbers, eight times each: compilers that know them make them anew wherever they are used, in three instructions. */
struct lit_numbers {
    uint32_t five[8], six[8], code[8], half[8];             /* masks */
    uint32_t by_rb[8], more_rb[8], by_g[8], more_g[8];      /* rgb565_nearest: of pairs, and of words */
    uint32_t green[8], red[8];                              /* where they lie in RGB565, red shifted up by 5 */
    uint32_t by_five[8], more_five[8], by_six[8], more_six[8];      /* codes of levels: of pairs, and of words */
    uint32_t pair[8], round[8];                             /* mask of pairs, and 1/2 in pairs q8 */
};

extern const struct lit_numbers smear_lit_numbers;

SMEAR_AVX2_INLINE __m256i lit_number(const uint32_t number[8]) { return _mm256_loadu_si256((const __m256i *)(const void *)number); }

/* Light of eight pixels. Codes: of red and blue (pairs, blue first), then of green, twice. Linear: of red, green and blue, 65536
 * is one. */
struct lit_light {
    __m256i c[3];
};

/* What all pixels of a triangle have in common. */
struct lit_lanes {
    const uint32_t *palette;
    int format;
    bool linear, plain, even, white;    /* white: green and blue are as red */
    uint32_t at[3], dx[3], dy[3];
    __m256i step[3];                    /* i dx for i = 0 .. 7 */
    struct lit_light light;             /* if even */
    struct light_lanes *blocks;         /* or null */
};

SMEAR_AVX2_INLINE bool lit_planes_equal(const struct texel_plane *a, const struct texel_plane *b)
{
    return a->at == b->at && a->dx == b->dx && a->dy == b->dy;
}

/* Codes or light of eight pixels from values as those of struct texel_lights. */
SMEAR_AVX2_INLINE struct lit_light lit_light_from(__m256i r, __m256i g, __m256i b, bool linear)
{
    if (linear) {
        const __m256i low = lit_number(smear_lit_numbers.half);
        struct lit_light l = { { _mm256_and_si256(_mm256_srli_epi32(r, 8), low), _mm256_and_si256(_mm256_srli_epi32(g, 8), low),
                                 _mm256_and_si256(_mm256_srli_epi32(b, 8), low) } };
        for (int i = 0; i < 3; i++)
            l.c[i] = _mm256_add_epi32(l.c[i], _mm256_srli_epi32(l.c[i], 15));
        return l;
    }
    const __m256i pair = _mm256_set1_epi32(0xff00ff);
    return (struct lit_light){ { _mm256_and_si256(_mm256_blend_epi16(_mm256_srli_epi32(b, 16), r, 0xaa), pair),
                                 _mm256_and_si256(_mm256_blend_epi16(_mm256_srli_epi32(g, 16), g, 0xaa), pair),
                                 _mm256_setzero_si256() } };
}

/* Whether texels of RGB565 are in linear light that planes give: what most triangles in light are. */
SMEAR_AVX2_INLINE bool lights_are_usual(const struct texel_lights *k)
{
    return k->format == SMEAR_TEXEL_565 && k->linear && !k->plain && k->planes.block == 0;
}

/* `blocks`: where to keep those of a row. `usual`: lights_are_usual, which compilers know. */
SMEAR_AVX2_INLINE void lit_start(struct lit_lanes *k, const struct texel_lights *lights, struct light_lanes *blocks, bool usual)
{
    const struct light_planes *const l = &lights->planes;
    const __m256i numbers = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
    k->palette = lights->palette;
    k->format = usual ? SMEAR_TEXEL_565 : lights->format;
    k->linear = usual || lights->linear;
    k->plain = !usual && lights->plain;
    k->blocks = !usual && l->block != 0 ? blocks : NULL;
    light_start(blocks, l);
    k->even = !usual && l->block == 0 && (l->c[0].dx | l->c[0].dy | l->c[1].dx | l->c[1].dy | l->c[2].dx | l->c[2].dy) == 0;
    k->white = lit_planes_equal(&l->c[0], &l->c[1]) && lit_planes_equal(&l->c[0], &l->c[2]);
    k->light.c[0] = k->light.c[1] = k->light.c[2] = _mm256_setzero_si256();
    if (k->even) {
        k->light = lit_light_from(_mm256_set1_epi32(l->c[0].at), _mm256_set1_epi32(l->c[1].at), _mm256_set1_epi32(l->c[2].at),
                                  lights->linear);
        return;
    }
    for (int i = 0; i < (k->white ? 1 : 3); i++) {
        k->at[i] = (uint32_t)l->c[i].at;
        k->dx[i] = (uint32_t)l->c[i].dx;
        k->dy[i] = (uint32_t)l->c[i].dy;
        k->step[i] = _mm256_mullo_epi32(_mm256_set1_epi32(l->c[i].dx), numbers);
    }
}

/* Channel i of eight pixels from x on. */
SMEAR_AVX2_INLINE __m256i lit_channel(const struct lit_lanes *k, int i, int32_t x, int32_t row)
{
    return _mm256_add_epi32(_mm256_set1_epi32((int32_t)(k->at[i] + k->dx[i] * (uint32_t)x + k->dy[i] * (uint32_t)row)), k->step[i]);
}

SMEAR_AVX2_INLINE struct lit_light lit_light_at(const struct lit_lanes *k, int32_t x, int32_t row)
{
    if (k->even)
        return k->light;
    if (k->blocks != NULL) {
        const struct planes_light c = planes_light_at(k->blocks, x, lanes8i_numbers() + x);
        return lit_light_from((__m256i)c.c[0], (__m256i)c.c[1], (__m256i)c.c[2], k->linear);
    }
    const __m256i r = lit_channel(k, 0, x, row);
    if (k->white)
        return lit_light_from(r, r, r, k->linear);
    return lit_light_from(r, lit_channel(k, 1, x, row), lit_channel(k, 2, x, row), k->linear);
}

/* Usual light of eight pixels, and how it changes from row to row, unless it is the same throughout the triangle. */
struct lit_down {
    bool even;
    struct lit_light light;
    __m256i at[3], step[3];
};

SMEAR_AVX2_INLINE struct lit_light lit_down_made(const struct lit_down *d, const struct lit_lanes *k)
{
    return k->white ? lit_light_from(d->at[0], d->at[0], d->at[0], true) : lit_light_from(d->at[0], d->at[1], d->at[2], true);
}

SMEAR_AVX2_INLINE void lit_down_start(struct lit_down *d, const struct lit_lanes *k, int32_t x, int32_t row)
{
    uint32_t change = 0;
    for (int i = 0; i < (k->white ? 1 : 3); i++) {
        d->at[i] = lit_channel(k, i, x, row);
        d->step[i] = _mm256_set1_epi32((int32_t)k->dy[i]);
        change |= k->dx[i] | k->dy[i];
    }
    d->even = change == 0;
    d->light = lit_down_made(d, k);
}

SMEAR_AVX2_INLINE struct lit_light lit_down_light(const struct lit_down *d, const struct lit_lanes *k)
{
    return d->even ? d->light : lit_down_made(d, k);
}

SMEAR_AVX2_INLINE void lit_down_step(struct lit_down *d, const struct lit_lanes *k)
{
    if (d->even)
        return;
    d->at[0] = _mm256_add_epi32(d->at[0], d->step[0]);
    if (k->white)
        return;
    d->at[1] = _mm256_add_epi32(d->at[1], d->step[1]);
    d->at[2] = _mm256_add_epi32(d->at[2], d->step[2]);
}

/* Texels, or pixels, as red and blue (pairs, blue first) and green. */
struct lit_pairs {
    __m256i rb, g;
};

SMEAR_AVX2_INLINE struct lit_pairs lit_pairs_of_565(__m256i t)
{
    const struct lit_numbers *const n = &smear_lit_numbers;
    const __m256i red = _mm256_and_si256(_mm256_slli_epi32(t, 5), lit_number(n->red));
    const __m256i rb = _mm256_or_si256(_mm256_and_si256(t, lit_number(n->five)), red);
    const __m256i g = _mm256_and_si256(_mm256_srli_epi32(t, 5), lit_number(n->six));
    return (struct lit_pairs){
        _mm256_srli_epi16(_mm256_add_epi16(_mm256_mullo_epi16(rb, lit_number(n->by_five)), lit_number(n->more_five)), 6),
        _mm256_srli_epi32(_mm256_add_epi32(_mm256_mullo_epi16(g, lit_number(n->by_six)), lit_number(n->more_six)), 6)
    };
}

SMEAR_AVX2_INLINE struct lit_pairs lit_pairs_of_8888(__m256i t)
{
    return (struct lit_pairs){ _mm256_and_si256(t, lit_number(smear_lit_numbers.pair)),
                               _mm256_and_si256(_mm256_srli_epi32(t, 8), lit_number(smear_lit_numbers.code)) };
}

/* code_times */
SMEAR_AVX2_INLINE __m256i lit_times(__m256i a, __m256i b)
{
    const __m256i t = _mm256_add_epi16(_mm256_mullo_epi16(a, b), lit_number(smear_lit_numbers.round));
    return _mm256_srli_epi16(_mm256_add_epi16(t, _mm256_srli_epi16(t, 8)), 8);
}

/* Channels of texels, light of which 65535 is one, in a light, of which 65536 is: as pairs of codes. */
SMEAR_AVX2_INLINE __m256i lit_product(__m256i there, __m256i light) { return _mm256_srli_epi32(_mm256_mullo_epi32(there, light), 20); }

SMEAR_AVX2_INLINE struct lit_pairs lit_linear(__m256i r, __m256i g, __m256i b, const struct lit_light *l)
{
    const lanes8 red = lanes8_encode_lowest((lanes8)lit_product(r, l->c[0])), green = (lanes8)lit_product(g, l->c[1]);
    const lanes8 blue = lanes8_encode_lowest((lanes8)lit_product(b, l->c[2]));
    const __m256i rb = _mm256_blend_epi16((__m256i)blue, (__m256i)(red << 16), 0xaa);
    return (struct lit_pairs){ _mm256_and_si256(rb, lit_number(smear_lit_numbers.pair)), (__m256i)lanes8_encode(green) };
}

/* Texels in linear light, as code_times_linear has it: of RGB565, in the lower halves of words, and of codes. */
SMEAR_AVX2_INLINE struct lit_pairs lit_linear_565(__m256i t, const struct lit_light *l)
{
    const int *const five = (const int *)(const void *)smear_lit_levels.five, *const six = (const int *)(const void *)smear_lit_levels.six;
    const __m256i low = lit_number(smear_lit_numbers.five), r = _mm256_and_si256(_mm256_srli_epi32(t, 11), low);
    const __m256i g = _mm256_and_si256(_mm256_srli_epi32(t, 5), lit_number(smear_lit_numbers.six)), b = _mm256_and_si256(t, low);
    return lit_linear(_mm256_i32gather_epi32(five, r, 4), _mm256_i32gather_epi32(six, g, 4), _mm256_i32gather_epi32(five, b, 4), l);
}

SMEAR_AVX2_INLINE struct lit_pairs lit_linear_codes(struct lit_pairs t, const struct lit_light *l)
{
    const lanes8 r = lanes8_decode((lanes8)t.rb >> 16), g = lanes8_decode((lanes8)t.g);
    const lanes8 b = lanes8_decode((lanes8)_mm256_and_si256(t.rb, lit_number(smear_lit_numbers.code)));
    return lit_linear((__m256i)r, (__m256i)g, (__m256i)b, l);
}

/* Texels from pixel x on in their light: those of RGB565 in the lower halves of words, others 0xAARRGGBB. */
SMEAR_AVX2_INLINE struct lit_pairs lit_texels(const struct lit_lanes *k, __m256i texel, int32_t x, int32_t row)
{
    const bool is_565 = k->format == SMEAR_TEXEL_565;
    if (k->linear && !k->plain && is_565) {
        const struct lit_light l = lit_light_at(k, x, row);
        return lit_linear_565(texel, &l);
    }
    const struct lit_pairs t = is_565 ? lit_pairs_of_565(texel) : lit_pairs_of_8888(texel);
    if (k->plain)
        return t;
    const struct lit_light l = lit_light_at(k, x, row);
    if (k->linear)
        return lit_linear_codes(t, &l);
    return (struct lit_pairs){ lit_times(t.rb, l.c[0]), lit_times(t.g, l.c[1]) };
}

/* As 0x00RRGGBB, or by rgb565_nearest. */
SMEAR_AVX2_INLINE __m256i lit_wide(struct lit_pairs p)
{
    return _mm256_or_si256(p.rb, _mm256_slli_epi32(p.g, 8));
}

SMEAR_AVX2_INLINE __m256i lit_narrow(struct lit_pairs p)
{
    const struct lit_numbers *const n = &smear_lit_numbers;
    const __m256i rb = _mm256_srli_epi16(_mm256_add_epi16(_mm256_mullo_epi16(p.rb, lit_number(n->by_rb)), lit_number(n->more_rb)), 11);
    const __m256i g = _mm256_add_epi32(_mm256_mullo_epi16(p.g, lit_number(n->by_g)), lit_number(n->more_g));
    const __m256i red_green = _mm256_or_si256(_mm256_srli_epi32(rb, 5), _mm256_and_si256(_mm256_srli_epi32(g, 5), lit_number(n->green)));
    return _mm256_or_si256(red_green, _mm256_and_si256(rb, lit_number(n->five)));
}

#endif

#endif
