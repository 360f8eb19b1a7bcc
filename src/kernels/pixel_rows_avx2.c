/* SPDX-License-Identifier: MIT */
/* pixel_rows_avx2.c - sixteen pixels of 16 bits a round. */
#include "kernels/lanes8.h"
#include "kernels/pixel_rows.h"

#if SMEAR_AVX2
/* Sixteen pixels as halves: blue and red of the first eight by turns, of the last eight; green of all, in the order of
 * places 0 to 3, 8 to 11, 4 to 7, 12 to 15, which is that of packing. */
struct sixteen {
    lanes8 low, high, green;
};

SMEAR_AVX2_INLINE struct sixteen sixteen_of(lanes8 a, lanes8 b)
{
    const __m256i low_green = _mm256_broadcastsi128_si256(_mm_setr_epi8(1, -1, 5, -1, 9, -1, 13, -1, -1, -1, -1, -1, -1, -1, -1, -1));
    const __m256i high_green = _mm256_broadcastsi128_si256(_mm_setr_epi8(-1, -1, -1, -1, -1, -1, -1, -1, 1, -1, 5, -1, 9, -1, 13, -1));
    return (struct sixteen){ a & 0xff00ffu, b & 0xff00ffu,
                             (lanes8)_mm256_shuffle_epi8((__m256i)a, low_green) | (lanes8)_mm256_shuffle_epi8((__m256i)b, high_green) };
}

/* Makes pixels of levels, in their order. */
SMEAR_AVX2_INLINE lanes8 pixels_of(struct sixteen k, enum row_16bit format)
{
    const lanes8 place = lanes8_all(SMEAR_WITH_RGB && format == ROW_555 ? 1u << 16 | 1024u : 2048u << 16 | 1u);
    const __m256i packed = _mm256_packus_epi32((__m256i)lanes8_dot(k.low, place), (__m256i)lanes8_dot(k.high, place));
    const __m256i pixels = (__m256i)((lanes8)packed | lanes8_left16(k.green, 5));
    const lanes8 ordered = (lanes8)_mm256_permute4x64_epi64(pixels, 0xd8);
    return format == ROW_565_SWAPPED ? lanes8_left16(ordered, 8) | lanes8_right16(ordered, 8) : ordered;
}

/* A code's nearest level is (code factor / 2^14 + 1) / 2, of all 256 codes. */
SMEAR_AVX2_INLINE lanes8 nearest16(lanes8 code, uint32_t factor)
{
    return (lanes8)_mm256_mulhrs_epi16((__m256i)code, (__m256i)lanes8_all(factor << 16 | factor));
}

SMEAR_AVX2_INLINE void nearest_avx2(uint16_t *out, const uint32_t *in, int32_t n, enum row_16bit format)
{
    const bool is_555 = SMEAR_WITH_RGB && format == ROW_555;
    for (; n >= 16; n -= 16, in += 16, out += 16) {
        struct sixteen k = sixteen_of(lanes8_load(in), lanes8_load(in + 8));
        k.low = nearest16(k.low, 3984);
        k.high = nearest16(k.high, 3984);
        k.green = nearest16(k.green, is_555 ? 3984 : 8095);
        lanes8_store(out, pixels_of(k, format));
    }
    smear_row_nearest_vector(out, in, n, format);
}

SMEAR_AVX2_FUNCTION void smear_row_nearest_avx2(uint16_t *out, const uint32_t *in, int32_t n, enum row_16bit format)
{
    if (SMEAR_WITH_RGB && format == ROW_555)
        nearest_avx2(out, in, n, ROW_555);
    else if (SMEAR_WITH_RGB565 && format == ROW_565_SWAPPED)
        nearest_avx2(out, in, n, ROW_565_SWAPPED);
    else if (SMEAR_WITH_RGB565)
        nearest_avx2(out, in, n, ROW_565);
}

/* level_q16 / 2^8 and a threshold, of which the upper byte is the level. */
SMEAR_AVX2_INLINE lanes8 dithered16(lanes8 code, uint32_t levels, lanes8 threshold)
{
    const lanes8 factor = lanes8_all(levels << 16 | levels);
    const lanes8 part = lanes8_mulh16(lanes8_add16(code, lanes8_right16(code, 7)), lanes8_left16(factor, 8));
    return lanes8_right16(lanes8_add16(lanes8_add16(lanes8_mul16(code, factor), part), threshold), 8);
}

/* Thresholds of sixteen columns in the order of sixteen_of. */
SMEAR_AVX2_INLINE struct sixteen sixteen_thresholds(__m128i columns)
{
    const __m128i low = _mm_unpacklo_epi8(columns, columns), high = _mm_unpackhi_epi8(columns, columns);
    return (struct sixteen){ (lanes8)_mm256_cvtepu8_epi16(low), (lanes8)_mm256_cvtepu8_epi16(high),
                             (lanes8)_mm256_permute4x64_epi64(_mm256_cvtepu8_epi16(columns), 0xd8) };
}

/* Blocks of sixteen columns, the first of which has a number that sixteen divides. Where thresholds repeat, a block that is
 * like the one before it looks like it: flat areas are long. */
SMEAR_AVX2_INLINE void dithered_avx2(uint16_t *out, const uint32_t *in, int32_t blocks, int32_t x, const uint8_t *threshold,
                                     int32_t mask, enum row_16bit format)
{
    const bool is_555 = SMEAR_WITH_RGB && format == ROW_555, repeats = mask == 7;
    const __m128i eight = _mm_loadl_epi64((const __m128i *)(const void *)threshold);
    struct sixteen step = sixteen_thresholds(_mm_unpacklo_epi64(eight, eight));
    lanes8 last_a = lanes8_all(0), last_b = last_a, pixels = last_a;
    for (bool first = true; blocks > 0; blocks--, in += 16, out += 16, x += 16) {
        const lanes8 a = lanes8_load(in), b = lanes8_load(in + 8);
        if (!repeats)
            step = sixteen_thresholds(_mm_loadu_si128((const __m128i *)(const void *)(threshold + (x & mask))));
        if (first || !repeats || lanes8_any((a ^ last_a) | (b ^ last_b))) {
            struct sixteen k = sixteen_of(a, b);
            k.low = dithered16(k.low, 31, step.low);
            k.high = dithered16(k.high, 31, step.high);
            k.green = dithered16(k.green, is_555 ? 31 : 63, step.green);
            pixels = pixels_of(k, format);
            last_a = a;
            last_b = b;
            first = false;
        }
        lanes8_store(out, pixels);
    }
}

SMEAR_AVX2_FUNCTION void smear_row_dithered_avx2(uint16_t *out, const uint32_t *in, int32_t n, int32_t x, const uint8_t *threshold,
                                                 int32_t mask, enum row_16bit format)
{
    const int32_t head = min_i32(-x & 15, n), blocks = (n - head) >> 4, done = head + 16 * blocks;
    if (head != 0)
        smear_row_dithered_vector(out, in, head, x, threshold, mask, format);
    if (SMEAR_WITH_RGB && format == ROW_555)
        dithered_avx2(out + head, in + head, blocks, x + head, threshold, mask, ROW_555);
    else if (SMEAR_WITH_RGB565 && format == ROW_565_SWAPPED)
        dithered_avx2(out + head, in + head, blocks, x + head, threshold, mask, ROW_565_SWAPPED);
    else if (SMEAR_WITH_RGB565)
        dithered_avx2(out + head, in + head, blocks, x + head, threshold, mask, ROW_565);
    if (done != n)
        smear_row_dithered_vector(out + done, in + done, n - done, x + done, threshold, mask, format);
}
#endif
