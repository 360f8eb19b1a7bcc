/* SPDX-License-Identifier: MIT */
/* pixel_rows_avx2.c - sixteen pixels of 16 bits a round, or eight of 32. */
#include "kernels/lanes8.h"
#include "kernels/pixel_rows.h"

#if SMEAR_AVX2
/* Eight pixels; the last eight of a row overlap those before them. */
SMEAR_AVX2_FUNCTION void smear_rows_xrgb8888_avx2(uint32_t *out, ptrdiff_t out_stride, const uint32_t *in, ptrdiff_t in_stride,
                                                  int32_t rows, int32_t n)
{
    for (; rows > 0; rows--, out += out_stride, in += in_stride) {
        if (n < 8) {
            row_xrgb8888_vector(out, in, n);
            continue;
        }
        for (ptrdiff_t i = 0; i < n - 7; i += 8)
            lanes8_store(out + i, lanes8_load(in + i) & 0xffffffu);
        if ((n & 7) != 0)
            lanes8_store(out + n - 8, lanes8_load(in + n - 8) & 0xffffffu);
    }
}

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

/* Sixteen pixels, codes 2^8 as halves, a channel each, in the order of places 0 to 3, 8 to 11, 4 to 7, 12 to 15. */
struct planes {
    lanes8 red, green, blue;
};

SMEAR_AVX2_INLINE struct planes planes_of(lanes8 a, lanes8 b)
{
    const __m256i turn = _mm256_broadcastsi128_si256(_mm_setr_epi8(0, 4, 8, 12, 1, 5, 9, 13, 2, 6, 10, 14, 3, 7, 11, 15));
    const __m256i zero = _mm256_setzero_si256();
    const __m256i c = _mm256_shuffle_epi8((__m256i)a, turn), d = _mm256_shuffle_epi8((__m256i)b, turn);
    const __m256i low = _mm256_unpacklo_epi32(c, d), high = _mm256_unpackhi_epi32(c, d);
    return (struct planes){ (lanes8)_mm256_unpacklo_epi8(zero, high), (lanes8)_mm256_unpackhi_epi8(zero, low),
                            (lanes8)_mm256_unpacklo_epi8(zero, low) };
}

/* What sixteen columns add, in the order of planes: steps for 31 levels and for 63, or thresholds. */
struct steps {
    lanes8 of_31, of_63;
};

/* Finds the steps of thresholds of the form 4 k + 2 (smear_dither_steps), of which there are eight. */
SMEAR_AVX2_INLINE struct steps steps_of(const uint8_t *threshold)
{
    const __m256i k = _mm256_srli_epi32(_mm256_cvtepu8_epi32(_mm_loadl_epi64((const __m128i *)(const void *)threshold)), 2);
    const __m256i step = (__m256i)lanes8_of_halves(smear_dither_steps, (lanes8)k);
    const lanes8 both = (lanes8)_mm256_packus_epi32(step, step);
    return (struct steps){ both, lanes8_right16(both, 1) };
}

SMEAR_AVX2_INLINE struct steps thresholds_of(const uint8_t *threshold)
{
    const __m256i columns = _mm256_cvtepu8_epi16(_mm_loadu_si128((const __m128i *)(const void *)threshold));
    const lanes8 ordered = (lanes8)_mm256_permute4x64_epi64(columns, 0xd8);
    return (struct steps){ ordered, ordered };
}

/* Return sums whose upper five or six bits are a level of 31 or 63, of codes 2^8: by a step, as in pixel_rows.c; or level_q16 / 2^8
 * and any threshold, times what fills a half. */
SMEAR_AVX2_INLINE lanes8 sums_by_steps(lanes8 upper, bool is_31, struct steps s)
{
    return lanes8_add16(lanes8_mulh16(upper, lanes8_all(is_31 ? 0xf900f900u : 0xfd00fd00u)), is_31 ? s.of_31 : s.of_63);
}

SMEAR_AVX2_INLINE lanes8 sums_by_thresholds(lanes8 upper, bool is_31, struct steps s)
{
    const lanes8 factor = lanes8_all(is_31 ? 0x1f001f00u : 0x3f003f00u), code = lanes8_right16(upper, 8);
    const lanes8 part = lanes8_mulh16(lanes8_add16(code, lanes8_right16(code, 7)), factor);
    return lanes8_left16(lanes8_add16(lanes8_add16(lanes8_mulh16(upper, factor), part), s.of_31), is_31 ? 3 : 2);
}

SMEAR_AVX2_INLINE lanes8 sums_of(lanes8 upper, bool is_31, struct steps s, bool by_steps)
{
    return by_steps ? sums_by_steps(upper, is_31, s) : sums_by_thresholds(upper, is_31, s);
}

SMEAR_AVX2_INLINE lanes8 dithered_sixteen(lanes8 a, lanes8 b, struct steps s, bool by_steps, enum row_16bit format)
{
    const bool is_555 = SMEAR_WITH_RGB && format == ROW_555;
    const struct planes k = planes_of(a, b);
    const lanes8 high = sums_of(is_555 ? k.blue : k.red, true, s, by_steps) & 0xf800f800u;
    const lanes8 green = sums_of(k.green, is_555, s, by_steps) & (is_555 ? 0xf800f800u : 0xfc00fc00u);
    const lanes8 low = sums_of(is_555 ? k.red : k.blue, true, s, by_steps);
    const lanes8 pixels = lanes8_right16(high, is_555 ? 1 : 0) | lanes8_right16(green, is_555 ? 6 : 5) | lanes8_right16(low, 11);
    const lanes8 ordered = (lanes8)_mm256_permute4x64_epi64((__m256i)pixels, 0xd8);
    return format == ROW_565_SWAPPED ? lanes8_left16(ordered, 8) | lanes8_right16(ordered, 8) : ordered;
}

/* Blocks of sixteen columns by eight thresholds of the form 4 k + 2. A block that is like the one before it looks like it:
 * flat areas are long. */
SMEAR_AVX2_INLINE void dithered_by_steps(uint16_t *out, const uint32_t *in, int32_t n, const uint8_t *threshold,
                                         enum row_16bit format)
{
    const struct steps step = steps_of(threshold);
    for (ptrdiff_t i = 0; i < n;) {
        const lanes8 a = lanes8_load(in + i), b = lanes8_load(in + i + 8);
        const lanes8 pixels = dithered_sixteen(a, b, step, true, format);
        do {
            lanes8_store(out + i, pixels);
            i += 16;
        } while (i < n && !lanes8_any((lanes8_load(in + i) ^ a) | (lanes8_load(in + i + 8) ^ b)));
    }
}

/* By any thresholds. */
SMEAR_AVX2_INLINE void dithered_by_thresholds(uint16_t *out, const uint32_t *in, int32_t n, int32_t x, const uint8_t *threshold,
                                              int32_t mask, enum row_16bit format)
{
    for (int32_t i = 0; i < n; i += 16) {
        const struct steps step = thresholds_of(threshold + ((x + i) & mask));
        lanes8_store(out + i, dithered_sixteen(lanes8_load(in + i), lanes8_load(in + i + 8), step, false, format));
    }
}

static inline const uint8_t *thresholds_in(const struct dithered_rows *r, int32_t i)
{
    return r->threshold + ((r->y + i) & r->mask) * (r->mask + 1);
}

/* Columns from a first one on whose number sixteen divides. */
SMEAR_AVX2_INLINE void dithered_avx2(const struct dithered_rows *r, int32_t from, int32_t n, enum row_16bit format)
{
    uint16_t *out = r->out + from;
    const uint32_t *in = r->in + from;
    for (int32_t i = 0; i < r->rows; i++, out += r->out_stride, in += r->in_stride) {
        if (r->mask == 7)
            dithered_by_steps(out, in, n, thresholds_in(r, i), format);
        else
            dithered_by_thresholds(out, in, n, r->x + from, thresholds_in(r, i), r->mask, format);
    }
}

/* Fewer than sixteen columns, at the ends of rows. */
static SMEAR_NOINLINE void dithered_ends(const struct dithered_rows *r, int32_t from, int32_t n, enum row_16bit format)
{
    for (int32_t i = 0; i < r->rows; i++)
        smear_row_dithered_vector(r->out + i * r->out_stride + from, r->in + i * r->in_stride + from, n, r->x + from,
                                  thresholds_in(r, i), r->mask, format);
}

SMEAR_AVX2_FUNCTION void smear_rows_dithered_avx2(const struct dithered_rows *r, enum row_16bit format)
{
    const int32_t head = min_i32(-r->x & 15, r->n), whole = (r->n - head) & ~15, done = head + whole;
    if (head != 0)
        dithered_ends(r, 0, head, format);
    if (SMEAR_WITH_RGB && format == ROW_555)
        dithered_avx2(r, head, whole, ROW_555);
    else if (SMEAR_WITH_RGB565 && format == ROW_565_SWAPPED)
        dithered_avx2(r, head, whole, ROW_565_SWAPPED);
    else if (SMEAR_WITH_RGB565)
        dithered_avx2(r, head, whole, ROW_565);
    if (done != r->n)
        dithered_ends(r, done, r->n - done, format);
}
#endif
