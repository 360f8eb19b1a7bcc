/* SPDX-License-Identifier: MIT */
/* texel_lanes.h - what rows and columns of texels have in common where eight pixels are drawn at once (texel_rows.h). */
#ifndef SMEAR_KERNELS_TEXEL_LANES_H
#define SMEAR_KERNELS_TEXEL_LANES_H

#include "kernels/texel_lit.h"
#include "kernels/texel_rows.h"
#include "kernels/wrapped_axis.h"

#if SMEAR_AVX2

/* Loads a number from memory wherever it is used: compilers would make it anew, in two or three instructions. */
SMEAR_AVX2_INLINE __m256i texels_all(int32_t a)
{
    __m256i lanes = _mm256_set1_epi32(a);
    __asm__("" : "+x"(lanes));
    return lanes;
}

/* How many texels q16 a ratio has. */
struct ratio_lanes {
    lanes8i scale;
    __m128i up, down;
};

/* A picture that wraps. */
struct wrap_lanes {
    struct wrapped_axis across, down;
    lanes8i width;
    struct ratio_lanes u, v;
};

/* What all pixels of a triangle have in common. */
struct texel_lanes {
    const void *texels;
    __m256i u_down, v_down, v_mask;     /* an index, or of narrow texels that of a pair: v >> down & mask | u >> down */
    __m256i odd_down, half;             /* u >> down & 16: of the texels of a pair, the second */
    int32_t x_most, x_most8;            /* where the last sixteen columns begin, the last eight */
    void *color;
    uint16_t *depth;
    ptrdiff_t stride;
    bool narrow;
    struct lit_lanes lit;
    struct wrap_lanes wrap;
};

/* A row. */
struct row_lanes {
    int32_t row;
    void *color;                        /* of pixel 0 */
    uint16_t *depth;
    uint32_t z, dz;
    __m256i evens, eight;               /* i dz for i = 0 2 .. 14, and 0 .. 7 */
};

/* Texels are copied as pixels of 32 or 16 bits, or lit: then both of them are drawn, but those of 16 bits alone in usual
 * light (lights_are_usual). Wrapped ones are lit, too. */
enum look { LOOK_WIDE, LOOK_NARROW, LOOK_LIT, LOOK_LIT_USUAL, LOOK_WRAPPED };

SMEAR_AVX2_INLINE bool look_is_lit(enum look look) { return look >= LOOK_LIT; }

SMEAR_AVX2_INLINE bool look_is_narrow(const struct texel_lanes *k, enum look look)
{
    return look == LOOK_LIT || look == LOOK_WRAPPED ? k->narrow : look != LOOK_WIDE;
}

/* Shifts that make an index. */
SMEAR_AVX2_INLINE void lanes_turns(struct texel_lanes *k, const struct texel_rows *t, int pairs)
{
    k->u_down = _mm256_set1_epi32(32 - t->log2_width + pairs);
    k->v_down = _mm256_set1_epi32(32 - t->log2_height - t->log2_width + pairs);
    k->v_mask = _mm256_set1_epi32((int32_t)(((1u << t->log2_height) - 1u) << (t->log2_width - pairs)));
    k->odd_down = _mm256_set1_epi32(28 - t->log2_width);
    k->half = texels_all(16);
}

SMEAR_AVX2_INLINE struct ratio_lanes ratio_start(int32_t scale, int shift)
{
    return (struct ratio_lanes){ lanes8i_all(scale), _mm_cvtsi32_si128(max_i32(shift, 0)), _mm_cvtsi32_si128(max_i32(-shift, 0)) };
}

/* As wrapped_texel. */
SMEAR_AVX2_INLINE __m256i ratio_texels(const struct ratio_lanes *k, __m256i ratio)
{
    return _mm256_sra_epi32(_mm256_sll_epi32((__m256i)lanes8i_mulh((lanes8i)ratio, k->scale), k->up), k->down);
}

SMEAR_AVX2_INLINE void lanes_wraps(struct wrap_lanes *k, const struct texel_wraps *w)
{
    k->u = ratio_start(w->scale[0], w->shift[0]);
    k->v = ratio_start(w->scale[1], w->shift[1]);
    k->across = wrapped_axis_make(w->size[0], w->wrap[0]);
    k->down = wrapped_axis_make(w->size[1], w->wrap[1]);
    k->width = lanes8i_all(w->size[0]);
}

SMEAR_AVX2_INLINE void lanes_start(struct texel_lanes *k, const struct texel_rows *t, struct light_lanes *blocks, enum look look)
{
    k->texels = t->texels;
    k->narrow = t->narrow;
    if (look_is_lit(look))
        lit_start(&k->lit, t->lights, blocks, look == LOOK_LIT_USUAL);
    if (look == LOOK_WRAPPED)
        lanes_wraps(&k->wrap, t->wraps);
    else
        lanes_turns(k, t, look == LOOK_LIT ? t->lights->format == SMEAR_TEXEL_565 : look != LOOK_WIDE);
    k->x_most = t->x1 - 16;
    k->x_most8 = t->x1 - 8;
    k->color = t->color;
    k->depth = t->depth;
    k->stride = t->stride;
}

SMEAR_AVX2_INLINE __m256i first_8(void) { return _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7); }

/* Texels' indices, or those of pairs. */
SMEAR_AVX2_INLINE __m256i lanes_index(const struct texel_lanes *k, __m256i u, __m256i v)
{
    return _mm256_or_si256(_mm256_srlv_epi32(u, k->u_down),
                           _mm256_and_si256(_mm256_srlv_epi32(v, k->v_down), k->v_mask));
}

SMEAR_AVX2_INLINE __m256i lanes_gather(const struct texel_lanes *k, __m256i index)
{
    return _mm256_i32gather_epi32((const int *)k->texels, index, 4);
}

/* Takes the lower halves of eight words. */
SMEAR_AVX2_INLINE __m128i lower_halves(__m256i a)
{
    return _mm_packus_epi32(_mm256_castsi256_si128(a), _mm256_extracti128_si256(a, 1));
}

/* Takes the upper halves of eight words. */
SMEAR_AVX2_INLINE __m128i upper_halves(__m256i a)
{
    const __m256i pick = _mm256_setr_epi8(2, 3, 6, 7, 10, 11, 14, 15, -1, -1, -1, -1, -1, -1, -1, -1,
                                          2, 3, 6, 7, 10, 11, 14, 15, -1, -1, -1, -1, -1, -1, -1, -1);
    return _mm256_castsi256_si128(_mm256_permute4x64_epi64(_mm256_shuffle_epi8(a, pick), 0x08));
}

/* Whether all eight halves are hidden. */
SMEAR_AVX2_INLINE bool all_hidden(__m128i hidden) { return _mm_testc_si128(hidden, _mm_set1_epi16(-1)) != 0; }

/* The first of a pair of narrow texels in the lower half, or the second. */
SMEAR_AVX2_INLINE __m256i lanes_of_pairs(const struct texel_lanes *k, __m256i pairs, __m256i u)
{
    return _mm256_srlv_epi32(pairs, _mm256_and_si256(_mm256_srlv_epi32(u, k->odd_down), k->half));
}

/* The same in the upper half. */
SMEAR_AVX2_INLINE __m256i lanes_above_of_pairs(const struct texel_lanes *k, __m256i pairs, __m256i u)
{
    return _mm256_sllv_epi32(pairs, _mm256_andnot_si256(_mm256_srlv_epi32(u, k->odd_down), k->half));
}

/* Eight texels in their light. */
SMEAR_AVX2_INLINE struct lit_pairs lit_8(const struct texel_lanes *k, const struct row_lanes *r, int32_t x, __m256i u, __m256i v)
{
    const __m256i index = lanes_index(k, u, v);
    __m256i texel;
    if (k->lit.format == SMEAR_TEXEL_565) {
        texel = lanes_of_pairs(k, lanes_gather(k, index), u);
    } else if (k->lit.format == SMEAR_TEXEL_8888) {
        texel = lanes_gather(k, index);
    } else {
        const __m256i bits = _mm256_and_si256(_mm256_slli_epi32(index, 3), _mm256_set1_epi32(24));
        const __m256i byte = _mm256_srlv_epi32(lanes_gather(k, _mm256_srli_epi32(index, 2)), bits);
        texel = _mm256_i32gather_epi32((const int *)(const void *)k->lit.palette, _mm256_and_si256(byte, _mm256_set1_epi32(255)), 4);
    }
    return lit_texels(&k->lit, texel, x, r->row);
}

/* The same of a picture that wraps, at coordinates in texels q16. Halves and bytes are read with what lies before them, or with
 * what comes after the first. */
SMEAR_AVX2_INLINE struct lit_pairs lit_8_wrapped(const struct texel_lanes *k, const struct row_lanes *r, int32_t x, lanes8 u, lanes8 v)
{
    const lanes8i index = wrapped_axis_index(&k->wrap.down, v) * k->wrap.width + wrapped_axis_index(&k->wrap.across, u);
    lanes8 texel;
    if (k->lit.format == SMEAR_TEXEL_565) {
        texel = lanes8_gather_upper_from_0(k->texels, index) >> 16;
    } else if (k->lit.format == SMEAR_TEXEL_8888) {
        texel = lanes8_gather(k->texels, index);
    } else {
        const lanes8i from = lanes8i_max(index - 3, lanes8i_all(0));
        const lanes8 word = (lanes8)_mm256_i32gather_epi32((const int *)k->texels, (__m256i)from, 1);
        const lanes8 byte = lanes8_right(word, (index - from) << 3) & 255u;
        texel = lanes8_gather(k->lit.palette, (lanes8i)byte);
    }
    return lit_texels(&k->lit, (__m256i)texel, x, r->row);
}

SMEAR_AVX2_INLINE void put_wide_8(const struct row_lanes *r, int32_t x, __m256i pixels, __m128i hidden)
{
    __m256i_u *const color = (__m256i_u *)((uint32_t *)r->color + x);
    _mm256_storeu_si256(color, _mm256_blendv_epi8(pixels, _mm256_loadu_si256(color), _mm256_cvtepi16_epi32(hidden)));
}

SMEAR_AVX2_INLINE void put_halves_8(const struct row_lanes *r, int32_t x, __m128i pixels, __m128i hidden)
{
    __m128i_u *const color = (__m128i_u *)((uint16_t *)r->color + x);
    _mm_storeu_si128(color, _mm_blendv_epi8(pixels, _mm_loadu_si128(color), hidden));
}

/* Writes eight pixels of texels of RGB565 in linear light where they are not hidden. */
SMEAR_AVX2_INLINE void put_usual_8(const struct texel_lanes *k, const struct row_lanes *r, int32_t x, __m256i u, __m256i v,
                                   __m128i hidden, struct lit_light light)
{
    const __m256i texels = lanes_of_pairs(k, lanes_gather(k, lanes_index(k, u, v)), u);
    put_halves_8(r, x, lower_halves(lit_narrow(lit_linear_565(texels, &light))), hidden);
}

/* Writes eight pixels with these coordinates where they are not hidden. */
SMEAR_AVX2_INLINE void put_8(const struct texel_lanes *k, const struct row_lanes *r, int32_t x, __m256i u, __m256i v, __m128i hidden,
                             enum look look)
{
    if (look_is_lit(look)) {
        const struct lit_pairs p = look == LOOK_WRAPPED ? lit_8_wrapped(k, r, x, (lanes8)u, (lanes8)v) : lit_8(k, r, x, u, v);
        if (k->narrow)
            put_halves_8(r, x, lower_halves(lit_narrow(p)), hidden);
        else
            put_wide_8(r, x, lit_wide(p), hidden);
        return;
    }
    const __m256i texels = lanes_gather(k, lanes_index(k, u, v));
    if (look == LOOK_NARROW)
        put_halves_8(r, x, upper_halves(lanes_above_of_pairs(k, texels, u)), hidden);
    else
        put_wide_8(r, x, texels, hidden);
}
#endif

#endif
