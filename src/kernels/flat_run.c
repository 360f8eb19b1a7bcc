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
#endif
