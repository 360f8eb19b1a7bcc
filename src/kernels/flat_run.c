/* SPDX-License-Identifier: MIT */
/* flat_run.c - see flat_run.h. */
#include "kernels/flat_run.h"

#include "kernels/lanes8.h"

#if SMEAR_AVX2
/* The depth codes of eight pixels where the nearer one counts, and which of them stay as they are. */
struct flat8 {
    __m128i depth, stays;
};

static inline SMEAR_AVX2_FUNCTION struct flat8 flat8_of(const uint16_t *depth, lanes8 z)
{
    const __m256i code = (__m256i)(z >> 16);
    const __m128i codes = _mm_packus_epi32(_mm256_castsi256_si128(code), _mm256_extracti128_si256(code, 1));
    const __m128i old = _mm_loadu_si128((const __m128i *)(const void *)depth), most = _mm_max_epu16(codes, old);
    return (struct flat8){ most, _mm_cmpeq_epi16(most, old) };
}

static inline SMEAR_AVX2_FUNCTION lanes8 flat8_wide(const uint32_t *color, struct flat8 f, uint32_t value)
{
    return lanes8_choose((lanes8i)_mm256_cvtepi16_epi32(f.stays), lanes8_load(color), lanes8_all(value));
}

static inline SMEAR_AVX2_FUNCTION __m128i flat8_narrow(const uint16_t *pixels, struct flat8 f, uint32_t value)
{
    return _mm_blendv_epi8(_mm_set1_epi16((int16_t)value), _mm_loadu_si128((const __m128i *)(const void *)pixels), f.stays);
}

static inline SMEAR_AVX2_FUNCTION void flat8_store(uint16_t *p, __m128i a) { _mm_storeu_si128((__m128i *)(void *)p, a); }

/* The last eight, with some of those before, are found before either is stored: loads wait long for stores that they take
 * parts of. Half the instructions of flat_run_vector. */
SMEAR_AVX2_FUNCTION void smear_flat_run_avx2(uint32_t *color, uint16_t *depth, int32_t n, uint32_t z, uint32_t dz, uint32_t value)
{
    const lanes8 steps = lanes8_ramp(0, dz, lanes8_numbers());
    for (;; n -= 8, color += 8, depth += 8, z += 8 * dz) {
        const struct flat8 f = flat8_of(depth, steps + z);
        const lanes8 first = flat8_wide(color, f, value);
        const bool is_last = n < 16;
        if (is_last && n > 8) {
            const int32_t on = n - 8;
            const struct flat8 g = flat8_of(depth + on, steps + (z + (uint32_t)on * dz));
            lanes8_store(color + on, flat8_wide(color + on, g, value));
            flat8_store(depth + on, g.depth);
        }
        lanes8_store(color, first);
        flat8_store(depth, f.depth);
        if (is_last)
            return;
    }
}

SMEAR_AVX2_FUNCTION void smear_flat_run_narrow_avx2(uint16_t *pixels, uint16_t *depth, int32_t n, uint32_t z, uint32_t dz,
                                                    uint32_t value)
{
    const lanes8 steps = lanes8_ramp(0, dz, lanes8_numbers());
    for (;; n -= 8, pixels += 8, depth += 8, z += 8 * dz) {
        const struct flat8 f = flat8_of(depth, steps + z);
        const __m128i first = flat8_narrow(pixels, f, value);
        const bool is_last = n < 16;
        if (is_last && n > 8) {
            const int32_t on = n - 8;
            const struct flat8 g = flat8_of(depth + on, steps + (z + (uint32_t)on * dz));
            flat8_store(pixels + on, flat8_narrow(pixels + on, g, value));
            flat8_store(depth + on, g.depth);
        }
        flat8_store(pixels, first);
        flat8_store(depth, f.depth);
        if (is_last)
            return;
    }
}

/* ------------------------------------------------------------------ rows */

/* All ones in lanes below n, from flat_masks + 32 - n on, and in lanes from n on, from flat_masks + 16 - n on. */
static const uint16_t flat_masks[48] = {
    0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0,
    0xffff, 0xffff, 0xffff, 0xffff, 0xffff, 0xffff, 0xffff, 0xffff,
    0xffff, 0xffff, 0xffff, 0xffff, 0xffff, 0xffff, 0xffff, 0xffff,
    0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0
};

/* What rows have in common: depth steps of pixels 0 2 .. 14 and 1 3 .. 15; their colour. */
struct flat_lanes {
    __m256i steps, steps1, color;
};

static inline SMEAR_AVX2_FUNCTION __m256i flat16_load(const void *p) { return _mm256_loadu_si256((const __m256i *)p); }
static inline SMEAR_AVX2_FUNCTION void flat16_store(void *p, __m256i a) { _mm256_storeu_si256((__m256i *)p, a); }

/* Sixteen pixels, the first at z; those of the mask if there is one. */
SMEAR_AVX2_FUNCTION SMEAR_INLINE_ALWAYS void flat16_draw(const struct flat_lanes *k, void *pixels, uint16_t *depth, uint32_t z,
                                                         const uint16_t *mask, bool narrow)
{
    const __m256i first_z = _mm256_set1_epi32((int32_t)z), even = _mm256_add_epi32(first_z, k->steps),
                  odd = _mm256_add_epi32(first_z, k->steps1);
    __m256i code = _mm256_blend_epi16(_mm256_srli_epi32(even, 16), odd, 0xaa);
    if (mask != NULL)
        code = _mm256_and_si256(code, flat16_load(mask));
    const __m256i old = flat16_load(depth), most = _mm256_max_epu16(code, old), stays = _mm256_cmpeq_epi16(most, old);
    flat16_store(depth, most);
    if (narrow) {
        flat16_store(pixels, _mm256_blendv_epi8(k->color, flat16_load(pixels), stays));
        return;
    }
    uint32_t *const first = (uint32_t *)pixels, *const last = first + 8;
    const __m256i stays0 = _mm256_cvtepi16_epi32(_mm256_castsi256_si128(stays));
    const __m256i stays1 = _mm256_cvtepi16_epi32(_mm256_extracti128_si256(stays, 1));
    flat16_store(first, _mm256_blendv_epi8(k->color, flat16_load(first), stays0));
    flat16_store(last, _mm256_blendv_epi8(k->color, flat16_load(last), stays1));
}

SMEAR_AVX2_FUNCTION SMEAR_INLINE_ALWAYS void flat_rows_of(const struct flat_rows *r, struct edge_walk *a, struct edge_walk *b,
                                                          bool narrow)
{
    struct edge_walk left = *a, right = *b;
    const lanes8 evens = lanes8_numbers() * 2;
    const struct flat_lanes k = { (__m256i)lanes8_ramp(0, r->dz, evens), (__m256i)lanes8_ramp(r->dz, r->dz, evens),
                                  narrow ? _mm256_set1_epi16((int16_t)r->color) : _mm256_set1_epi32((int32_t)r->color) };
    const int32_t x0 = r->x0, x1 = r->x1, x_most = x1 - 16;
    const int32_t stride = r->stride;
    const uint32_t dz = r->dz, dz_down = r->dz_down;
    uint32_t z = r->z;
    uint16_t *depth = r->depth;
    void *pixels = r->pixels;
    for (int32_t rows = r->rows; rows > 0; rows--) {
        int32_t x = max_i32(edge_pixel(&left), x0);
        const int32_t end = min_i32(edge_pixel(&right), x1);
        edge_step(&left);
        edge_step(&right);
        for (; end - x >= 16; x += 16)
            flat16_draw(&k, pixel_after(pixels, x, narrow), depth + x, z + dz * (uint32_t)x, NULL, narrow);
        if (x < end) {
            const uint16_t *mask = flat_masks + 32 - (end - x);
            if (x > x_most) {           /* the last sixteen before the end, of which some come before x */
                mask = flat_masks + 16 - (x - (end - 16));
                x = end - 16;
            }
            flat16_draw(&k, pixel_after(pixels, x, narrow), depth + x, z + dz * (uint32_t)x, mask, narrow);
        }
        depth += stride;
        pixels = pixel_after(pixels, stride, narrow);
        z += dz_down;
    }
    *a = left;
    *b = right;
}

SMEAR_AVX2_FUNCTION void smear_flat_rows_avx2(const struct flat_rows *r, struct edge_walk *left, struct edge_walk *right)
{
    if (r->narrow)
        flat_rows_of(r, left, right, true);
    else
        flat_rows_of(r, left, right, false);
}
#endif
