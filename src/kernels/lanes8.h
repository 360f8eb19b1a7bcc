/* SPDX-License-Identifier: MIT */
/* lanes8.h - eight words, or sixteen halves, in the lanes of AVX2: what all variants for it are written in (avx2.h). Beside
 * the operators of C: loads and stores, halves, look-ups in tables and planes of narrower elements, and what base/fixmath.h
 * has for one number, to the same bits.
 *
 * lanes8_NAME is of words without a sign or of either kind, lanes8i_NAME of words with one. Unlike the operators, intrinsics
 * and lanes8 wrap. */
#ifndef SMEAR_KERNELS_LANES8_H
#define SMEAR_KERNELS_LANES8_H

#include "base/fixmath.h"
#include "base/noise.h"
#include "base/tables.h"
#include "kernels/avx2.h"

#if SMEAR_AVX2

/* They are written to memory and read from it by loads and stores below alone. */
typedef uint32_t lanes8 __attribute__((vector_size(32)));
typedef int32_t lanes8i __attribute__((vector_size(32)));

SMEAR_AVX2_INLINE lanes8 lanes8_all(uint32_t a) { return (lanes8)_mm256_set1_epi32((int)a); }
SMEAR_AVX2_INLINE lanes8i lanes8i_all(int32_t a) { return (lanes8i)_mm256_set1_epi32(a); }
SMEAR_AVX2_INLINE lanes8 lanes8_numbers(void) { return (lanes8){ 0, 1, 2, 3, 4, 5, 6, 7 }; }
SMEAR_AVX2_INLINE lanes8i lanes8i_numbers(void) { return (lanes8i){ 0, 1, 2, 3, 4, 5, 6, 7 }; }

/* Constants that loops often need lie in memory, where they are an operand of an instruction. Of any other, GCC 12 makes one by
 * three, and again wherever it runs out of registers. */
enum lanes8_constant {
    LANES8_1, LANES8_8, LANES8_15, LANES8_16, LANES8_17, LANES8_24, LANES8_31, LANES8_53, LANES8_64, LANES8_127, LANES8_128, LANES8_135,
    LANES8_255, LANES8_256, LANES8_511, LANES8_1023, LANES8_4095, LANES8_4096, LANES8_4915, LANES8_32768, LANES8_35822, LANES8_65535,
    LANES8_65536,
    LANES8_LESS_2,              /* all bits but the lowest */
    LANES8_RED_BLUE,            /* of a pixel */
    LANES8_2_19, LANES8_2_22, LANES8_2_31,      /* powers of two */
    LANES8_BREAK_15,            /* fifteen times the depth code from where units are 16 to one */
    LANES8_WORDS
};

extern const uint32_t smear_lanes8_words[LANES8_WORDS][8];

SMEAR_AVX2_INLINE lanes8 lanes8_word(enum lanes8_constant c)
{
    return (lanes8)_mm256_loadu_si256((const __m256i *)(const void *)smear_lanes8_words[c]);
}

SMEAR_AVX2_INLINE lanes8i lanes8i_word(enum lanes8_constant c) { return (lanes8i)lanes8_word(c); }

/* first + number step */
SMEAR_AVX2_INLINE lanes8 lanes8_ramp(uint32_t first, uint32_t step, lanes8 numbers)
{
    return lanes8_all(first) + lanes8_all(step) * numbers;
}

/* ------------------------------------------------------------------ memory */

SMEAR_AVX2_INLINE lanes8 lanes8_load(const void *p) { return (lanes8)_mm256_loadu_si256((const __m256i *)p); }
SMEAR_AVX2_INLINE lanes8i lanes8i_load(const void *p) { return (lanes8i)_mm256_loadu_si256((const __m256i *)p); }
SMEAR_AVX2_INLINE void lanes8_store(void *p, lanes8 a) { _mm256_storeu_si256((__m256i *)p, (__m256i)a); }
SMEAR_AVX2_INLINE void lanes8i_store(void *p, lanes8i a) { _mm256_storeu_si256((__m256i *)p, (__m256i)a); }

/* Stores the elements whose mask has its highest bit set. */
SMEAR_AVX2_INLINE void lanes8_store_some(void *p, lanes8 a, lanes8 mask)
{
    _mm256_maskstore_epi32((int *)p, (__m256i)mask, (__m256i)a);
}

/* Loads eight halves as words. */
SMEAR_AVX2_INLINE lanes8 lanes8_load_halves(const void *p)
{
    return (lanes8)_mm256_cvtepu16_epi32(_mm_loadu_si128((const __m128i *)p));
}

SMEAR_AVX2_INLINE lanes8i lanes8i_load_halves(const void *p) { return (lanes8i)lanes8_load_halves(p); }

/* Makes eight words of four and four. */
SMEAR_AVX2_INLINE lanes8i lanes8i_of_two(__m128i low, __m128i high)
{
    return (lanes8i)_mm256_inserti128_si256(_mm256_castsi128_si256(low), high, 1);
}

/* Loads four words from each of two addresses. */
SMEAR_AVX2_INLINE lanes8i lanes8i_load_two(const void *low, const void *high)
{
    return lanes8i_of_two(_mm_loadu_si128((const __m128i *)low), _mm_loadu_si128((const __m128i *)high));
}

/* The numbers of the first four and the last four of n = 4 .. 8 pixels; and how these are loaded and stored. */
SMEAR_AVX2_INLINE lanes8 lanes8_numbers_few(int32_t n)
{
    const __m256i last = _mm256_inserti128_si256(_mm256_setzero_si256(), _mm_set1_epi32(n - 4), 1);
    return (lanes8)_mm256_add_epi32(_mm256_setr_epi32(0, 1, 2, 3, 0, 1, 2, 3), last);
}

SMEAR_AVX2_INLINE lanes8 lanes8_load_few(const uint32_t *p, int32_t n) { return (lanes8)lanes8i_load_two(p, p + n - 4); }

SMEAR_AVX2_INLINE void lanes8_store_few(uint32_t *p, lanes8 a, int32_t n)
{
    v4u_store(p, (smear_v4u)_mm256_castsi256_si128((__m256i)a));
    v4u_store(p + n - 4, (smear_v4u)_mm256_extracti128_si256((__m256i)a, 1));
}

/* Four vectors, and the same turned by fours: element i of four vectors j becomes element j of vector i. */
struct lanes8_four {
    lanes8i of[4];
};

SMEAR_AVX2_INLINE struct lanes8_four lanes8_turned(lanes8i a, lanes8i b, lanes8i c, lanes8i d)
{
    const __m256i ab = _mm256_unpacklo_epi32((__m256i)a, (__m256i)b), cd = _mm256_unpacklo_epi32((__m256i)c, (__m256i)d);
    const __m256i ab2 = _mm256_unpackhi_epi32((__m256i)a, (__m256i)b), cd2 = _mm256_unpackhi_epi32((__m256i)c, (__m256i)d);
    return (struct lanes8_four){ { (lanes8i)_mm256_unpacklo_epi64(ab, cd), (lanes8i)_mm256_unpackhi_epi64(ab, cd),
                                   (lanes8i)_mm256_unpacklo_epi64(ab2, cd2), (lanes8i)_mm256_unpackhi_epi64(ab2, cd2) } };
}

/* Stores element k of each vector one after the other, for k = 0 .. 7: 32 words. */
SMEAR_AVX2_INLINE void lanes8_store_columns(void *out, lanes8i a, lanes8i b, lanes8i c, lanes8i d)
{
    const struct lanes8_four turned = lanes8_turned(a, b, c, d);
    __m128i *const to = (__m128i *)out;
    _mm_storeu_si128(to, _mm256_castsi256_si128((__m256i)turned.of[0]));
    _mm_storeu_si128(to + 1, _mm256_castsi256_si128((__m256i)turned.of[1]));
    _mm_storeu_si128(to + 2, _mm256_castsi256_si128((__m256i)turned.of[2]));
    _mm_storeu_si128(to + 3, _mm256_castsi256_si128((__m256i)turned.of[3]));
    _mm_storeu_si128(to + 4, _mm256_extracti128_si256((__m256i)turned.of[0], 1));
    _mm_storeu_si128(to + 5, _mm256_extracti128_si256((__m256i)turned.of[1], 1));
    _mm_storeu_si128(to + 6, _mm256_extracti128_si256((__m256i)turned.of[2], 1));
    _mm_storeu_si128(to + 7, _mm256_extracti128_si256((__m256i)turned.of[3], 1));
}

/* ------------------------------------------------------------------ choices */

/* Whether any bit is set. */
SMEAR_AVX2_INLINE bool lanes8_any(lanes8 a) { return _mm256_testz_si256((__m256i)a, (__m256i)a) == 0; }
SMEAR_AVX2_INLINE bool lanes8i_any(lanes8i a) { return lanes8_any((lanes8)a); }

/* Whether all bits are set. */
SMEAR_AVX2_INLINE bool lanes8_all_set(lanes8 a) { return _mm256_testc_si256((__m256i)a, _mm256_set1_epi32(-1)) != 0; }

/* Whether a and b are equal, element by element. */
SMEAR_AVX2_INLINE bool lanes8_equal(lanes8 a, lanes8 b) { return !lanes8_any(a ^ b); }

/* Takes the highest bit of each element: that of element 0 is bit 0. */
SMEAR_AVX2_INLINE uint32_t lanes8i_signs(lanes8i a) { return (uint32_t)_mm256_movemask_ps(_mm256_castsi256_ps((__m256i)a)); }

/* Chooses per element: a where `which` is all ones, b where it is 0. */
SMEAR_AVX2_INLINE lanes8 lanes8_choose(lanes8i which, lanes8 a, lanes8 b)
{
    return (lanes8)_mm256_blendv_epi8((__m256i)b, (__m256i)a, (__m256i)which);
}

SMEAR_AVX2_INLINE lanes8i lanes8i_choose(lanes8i which, lanes8i a, lanes8i b)
{
    return (lanes8i)_mm256_blendv_epi8((__m256i)b, (__m256i)a, (__m256i)which);
}

/* Takes element `at` of a for each. */
SMEAR_AVX2_INLINE lanes8i lanes8i_permute(lanes8i a, lanes8i at)
{
    return (lanes8i)_mm256_permutevar8x32_epi32((__m256i)a, (__m256i)at);
}

/* ------------------------------------------------------------------ words */

SMEAR_AVX2_INLINE lanes8i lanes8i_min(lanes8i a, lanes8i b) { return (lanes8i)_mm256_min_epi32((__m256i)a, (__m256i)b); }
SMEAR_AVX2_INLINE lanes8i lanes8i_max(lanes8i a, lanes8i b) { return (lanes8i)_mm256_max_epi32((__m256i)a, (__m256i)b); }
SMEAR_AVX2_INLINE lanes8i lanes8i_abs(lanes8i a) { return (lanes8i)_mm256_abs_epi32((__m256i)a); }

SMEAR_AVX2_INLINE lanes8i lanes8i_min3(lanes8i a, lanes8i b, lanes8i c) { return lanes8i_min(a, lanes8i_min(b, c)); }
SMEAR_AVX2_INLINE lanes8i lanes8i_max3(lanes8i a, lanes8i b, lanes8i c) { return lanes8i_max(a, lanes8i_max(b, c)); }

/* Shifts by 0 .. 31 each; from 32 on nothing, or the sign, is left. */
SMEAR_AVX2_INLINE lanes8 lanes8_left(lanes8 a, lanes8i bits) { return (lanes8)_mm256_sllv_epi32((__m256i)a, (__m256i)bits); }
SMEAR_AVX2_INLINE lanes8 lanes8_right(lanes8 a, lanes8i bits) { return (lanes8)_mm256_srlv_epi32((__m256i)a, (__m256i)bits); }
SMEAR_AVX2_INLINE lanes8i lanes8i_left(lanes8i a, lanes8i bits) { return (lanes8i)_mm256_sllv_epi32((__m256i)a, (__m256i)bits); }
SMEAR_AVX2_INLINE lanes8i lanes8i_right(lanes8i a, lanes8i bits) { return (lanes8i)_mm256_srav_epi32((__m256i)a, (__m256i)bits); }

/* Return floor(a b / 2^32). */
SMEAR_AVX2_INLINE lanes8 lanes8_mulh(lanes8 a, lanes8 b)
{
    const __m256i even = _mm256_mul_epu32((__m256i)a, (__m256i)b);
    const __m256i odd = _mm256_mul_epu32(_mm256_srli_epi64((__m256i)a, 32), _mm256_srli_epi64((__m256i)b, 32));
    return (lanes8)_mm256_blend_epi32(_mm256_srli_epi64(even, 32), odd, 0xaa);
}

SMEAR_AVX2_INLINE lanes8i lanes8i_mulh(lanes8i a, lanes8i b)
{
    const __m256i even = _mm256_mul_epi32((__m256i)a, (__m256i)b);
    const __m256i odd = _mm256_mul_epi32(_mm256_srli_epi64((__m256i)a, 32), _mm256_srli_epi64((__m256i)b, 32));
    return (lanes8i)_mm256_blend_epi32(_mm256_srli_epi64(even, 32), odd, 0xaa);
}

/* Sums of the elements of two vectors. */
struct lanes8_sums {
    int32_t of[2];
};

SMEAR_AVX2_INLINE struct lanes8_sums lanes8i_sums(lanes8i a, lanes8i b)
{
    const __m256i pairs = _mm256_hadd_epi32((__m256i)a, (__m256i)b);
    const __m128i fours = _mm_add_epi32(_mm256_castsi256_si128(pairs), _mm256_extracti128_si256(pairs, 1));
    const __m128i all = _mm_hadd_epi32(fours, fours);
    return (struct lanes8_sums){ { _mm_cvtsi128_si32(all), _mm_extract_epi32(all, 1) } };
}

/* Differences of bytes without their sign. */
SMEAR_AVX2_INLINE lanes8 lanes8_apart(lanes8 a, lanes8 b)
{
    return (lanes8)_mm256_sub_epi8(_mm256_max_epu8((__m256i)a, (__m256i)b), _mm256_min_epu8((__m256i)a, (__m256i)b));
}

/* ------------------------------------------------------------------ halves */

/* Multiply halves: a b modulo 2^16, a b / 2^16. */
SMEAR_AVX2_INLINE lanes8 lanes8_mul16(lanes8 a, lanes8 b) { return (lanes8)_mm256_mullo_epi16((__m256i)a, (__m256i)b); }
SMEAR_AVX2_INLINE lanes8 lanes8_mulh16(lanes8 a, lanes8 b) { return (lanes8)_mm256_mulhi_epu16((__m256i)a, (__m256i)b); }

SMEAR_AVX2_INLINE lanes8 lanes8_add16(lanes8 a, lanes8 b) { return (lanes8)_mm256_add_epi16((__m256i)a, (__m256i)b); }
SMEAR_AVX2_INLINE lanes8 lanes8_sub16(lanes8 a, lanes8 b) { return (lanes8)_mm256_sub_epi16((__m256i)a, (__m256i)b); }
SMEAR_AVX2_INLINE lanes8 lanes8_left16(lanes8 a, int bits) { return (lanes8)_mm256_slli_epi16((__m256i)a, bits); }
SMEAR_AVX2_INLINE lanes8 lanes8_right16(lanes8 a, int bits) { return (lanes8)_mm256_srli_epi16((__m256i)a, bits); }

/* Takes the means of halves, rounded up. */
SMEAR_AVX2_INLINE lanes8 lanes8_mean16(lanes8 a, lanes8 b) { return (lanes8)_mm256_avg_epu16((__m256i)a, (__m256i)b); }

SMEAR_AVX2_INLINE lanes8 lanes8_min16(lanes8 a, lanes8 b) { return (lanes8)_mm256_min_epu16((__m256i)a, (__m256i)b); }
SMEAR_AVX2_INLINE lanes8 lanes8_max16(lanes8 a, lanes8 b) { return (lanes8)_mm256_max_epu16((__m256i)a, (__m256i)b); }

/* The same of halves with a sign, and whether a > b: then all ones. */
SMEAR_AVX2_INLINE lanes8 lanes8i_min16(lanes8 a, lanes8 b) { return (lanes8)_mm256_min_epi16((__m256i)a, (__m256i)b); }
SMEAR_AVX2_INLINE lanes8 lanes8i_max16(lanes8 a, lanes8 b) { return (lanes8)_mm256_max_epi16((__m256i)a, (__m256i)b); }
SMEAR_AVX2_INLINE lanes8 lanes8i_more16(lanes8 a, lanes8 b) { return (lanes8)_mm256_cmpgt_epi16((__m256i)a, (__m256i)b); }

/* Returns a.x b.x + a.y b.y of pairs of halves with a sign, x in the lower half. */
SMEAR_AVX2_INLINE lanes8i lanes8_dot(lanes8 a, lanes8 b) { return (lanes8i)_mm256_madd_epi16((__m256i)a, (__m256i)b); }

/* Takes the lower halves of a, beside those of b as the upper ones; and of their upper halves. */
SMEAR_AVX2_INLINE lanes8 lanes8_pair(lanes8 a, lanes8 b)
{
    return (lanes8)_mm256_blend_epi16((__m256i)a, (__m256i)(b << 16), 0xaa);
}

SMEAR_AVX2_INLINE lanes8 lanes8_upper_pair(lanes8 a, lanes8 b)
{
    return (lanes8)_mm256_blend_epi16((__m256i)(a >> 16), (__m256i)b, 0xaa);
}

/* Takes the halves of pairs, with their signs. */
SMEAR_AVX2_INLINE lanes8i lanes8_pair_x(lanes8 a) { return (lanes8i)(a << 16) >> 16; }
SMEAR_AVX2_INLINE lanes8i lanes8_pair_y(lanes8 a) { return (lanes8i)a >> 16; }

/* ------------------------------------------------------------------ look-ups */

/* Reads words; indices are of either sign. */
SMEAR_AVX2_INLINE lanes8 lanes8_gather(const void *words, lanes8i at)
{
    return (lanes8)_mm256_i32gather_epi32((const int *)words, (__m256i)at, 4);
}

/* Reads halves before which there is another one: the half lies in the upper part of each word. */
SMEAR_AVX2_INLINE lanes8 lanes8_gather_upper(const void *halves, lanes8i at)
{
    return (lanes8)_mm256_i32gather_epi32((const int *)((const char *)halves - 2), (__m256i)at, 2);
}

/* The same with indices from 0 on of an array of two halves or more: nothing before or behind it is read. */
SMEAR_AVX2_INLINE lanes8 lanes8_gather_upper_from_0(const void *halves, lanes8i at)
{
    const lanes8i first = at == lanes8i_all(0);
    return lanes8_left(lanes8_gather_upper(halves, at - first), (lanes8i)((lanes8)first & 16u));
}

/* Reads halves of a table of an even number of them. */
SMEAR_AVX2_INLINE lanes8 lanes8_of_halves(const void *table, lanes8 at)
{
    return lanes8_right(lanes8_gather(table, (lanes8i)(at >> 1)), (lanes8i)(at << 4 & lanes8_word(LANES8_16)))
         & lanes8_word(LANES8_65535);
}

/* Reads bytes of a table of a multiple of four. */
SMEAR_AVX2_INLINE lanes8 lanes8_of_bytes(const void *table, lanes8 at)
{
    return lanes8_right(lanes8_gather(table, (lanes8i)(at >> 2)), (lanes8i)(at << 3 & lanes8_word(LANES8_24)))
         & lanes8_word(LANES8_255);
}

SMEAR_AVX2_INLINE lanes8i lanes8i_of_bytes(const void *table, lanes8 at)
{
    const lanes8 bits = lanes8_word(LANES8_24);
    return (lanes8i)lanes8_left(lanes8_gather(table, (lanes8i)(at >> 2)), (lanes8i)((at << 3 & bits) ^ bits)) >> 24;
}

/* Finds the codes of linear light 0 .. 4095 in the lowest bytes of words. */
SMEAR_AVX2_INLINE lanes8 lanes8_encode_lowest(lanes8 light)
{
    return (lanes8)_mm256_i32gather_epi32((const int *)(const void *)smear_srgb_encode, (__m256i)light, 1);
}

/* The same as words, and of three channels as pixels. */
SMEAR_AVX2_INLINE lanes8 lanes8_encode(lanes8 light) { return lanes8_encode_lowest(light) & lanes8_word(LANES8_255); }

SMEAR_AVX2_INLINE lanes8 lanes8_encode_pixels(lanes8 r, lanes8 g, lanes8 b)
{
    const __m256i third = _mm256_setr_epi8(-1, -1, 0, -1, -1, -1, 4, -1, -1, -1, 8, -1, -1, -1, 12, -1,
                                           -1, -1, 0, -1, -1, -1, 4, -1, -1, -1, 8, -1, -1, -1, 12, -1);
    const __m256i second = _mm256_setr_epi8(-1, 0, -1, -1, -1, 4, -1, -1, -1, 8, -1, -1, -1, 12, -1, -1,
                                            -1, 0, -1, -1, -1, 4, -1, -1, -1, 8, -1, -1, -1, 12, -1, -1);
    const __m256i red = _mm256_shuffle_epi8((__m256i)lanes8_encode_lowest(r), third);
    const __m256i green = _mm256_shuffle_epi8((__m256i)lanes8_encode_lowest(g), second);
    return (lanes8)red | (lanes8)green | lanes8_encode(b);
}

/* Finds the light of codes. The table is read from the half before an element on, and not for code 0, whose light is 0. */
SMEAR_AVX2_INLINE lanes8 lanes8_decode(lanes8 code)
{
    const __m256i zero = _mm256_setzero_si256(), some = _mm256_cmpgt_epi32((__m256i)code, zero);
    uintptr_t before = (uintptr_t)smear_srgb_decode - 2;
    SMEAR_KEEP_VALUE(before);
    return (lanes8)_mm256_mask_i32gather_epi32(zero, (const int *)before, (__m256i)code, some, 2) >> 16;
}

/* Returns pixels as RGB565, in the lower halves of words: rgb565_nearest. */
SMEAR_AVX2_INLINE lanes8 lanes8_narrow(lanes8 p)
{
    const lanes8 products = lanes8_mul16(p & 0xff00ffu, lanes8_all(0xf900f9u));
    const lanes8 rb = lanes8_right16(lanes8_add16(products, lanes8_all(0x3f603f6)), 11);
    const lanes8 g = (lanes8_mul16(p >> 8 & 255u, lanes8_all(253)) + 505u) >> 10;
    return rb >> 5 | g << 5 | (rb & 31u);
}

/* ------------------------------------------------------------------ fixmath.h */

/* Returns the place of the highest bit of x < 2^24, the exponent of a float; 0 for 0 as for 1. */
SMEAR_AVX2_INLINE lanes8i lanes8_log2(lanes8 x)
{
    const lanes8i exponent = (lanes8i)_mm256_castps_si256(_mm256_cvtepi32_ps((__m256i)x)) >> 23;
    return (lanes8i)_mm256_subs_epu16((__m256i)exponent, (__m256i)lanes8_word(LANES8_127));
}

/* Returns how many leading zeros a number has that is greater than 0: it loses what would round it up to a power of two. */
SMEAR_AVX2_INLINE lanes8i lanes8i_zeros(lanes8i a)
{
    const __m256i cut = _mm256_andnot_si256(_mm256_srli_epi32((__m256i)a, 8), (__m256i)a);
    return 158 - ((lanes8i)_mm256_castps_si256(_mm256_cvtepi32_ps(cut)) >> 23);
}

/* Returns recip_norm(m). */
SMEAR_AVX2_INLINE lanes8 lanes8_recip_norm(lanes8 m)
{
    const lanes8 pair = lanes8_gather(smear_recip_seed, (lanes8i)(m >> 23 & lanes8_word(LANES8_255)));
    const lanes8 r = lanes8_right(pair, (lanes8i)(m >> 18 & lanes8_word(LANES8_16))) & lanes8_word(LANES8_65535);
    const lanes8i error = (lanes8i)(lanes8_word(LANES8_2_31) - (m >> 11) * r);
    return (r << 19) + (lanes8)((lanes8i)(r * (lanes8)(error >> 4)) >> 8);
}

/* Returns sqrt_q3(x) for x < 2^20. */
SMEAR_AVX2_INLINE lanes8 lanes8_sqrt_q3(lanes8 x)
{
    /* Half of what its highest bit's place, the exponent of a float, is above 8. */
    const __m256i exponent = _mm256_srli_epi32(_mm256_castps_si256(_mm256_cvtepi32_ps((__m256i)x)), 23);
    const lanes8i above = (lanes8i)_mm256_subs_epu16(exponent, (__m256i)lanes8_word(LANES8_135));
    return lanes8_left(lanes8_of_bytes(smear_sqrt_q3, lanes8_right(x, above & lanes8i_word(LANES8_LESS_2))), above >> 1);
}

/* Returns noise_of(inner). */
SMEAR_AVX2_INLINE lanes8 lanes8_noise_of(lanes8 inner)
{
    return (inner * lanes8_word(LANES8_53) - ((inner >> 16) * lanes8_word(LANES8_35822) >> 5)) >> 16;
}
#endif

#endif
