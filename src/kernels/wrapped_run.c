/* SPDX-License-Identifier: MIT */
/* wrapped_run.c - see wrapped_run.h. */
#include "kernels/wrapped_run.h"

#include "kernels/wrapped_axis.h"

#if SMEAR_AVX2

/* Pixels 0 to 3 of a walk, and how far they are from those that come next. */
struct wrapped_four {
    __m256i at, step;
};

SMEAR_AVX2_INLINE __m256i wrapped_words(uint64_t a, uint64_t b, uint64_t c, uint64_t d)
{
    return _mm256_setr_epi64x((int64_t)a, (int64_t)b, (int64_t)c, (int64_t)d);
}

SMEAR_AVX2_FUNCTION void smear_wrapped_run_avx2(uint32_t *out, const struct wrapped_texels *t, const struct wrapped_walk *w, int32_t n)
{
    const struct wrapped_axis across = wrapped_axis_make(t->width, t->wrap_u), down = wrapped_axis_make(t->height, t->wrap_v);
    const uint64_t step = w->step, change = w->curvature, four = 4 * step + 6 * change;
    const __m256i changes = _mm256_set1_epi64x((int64_t)(16 * change));
    const lanes8i width = lanes8i_all(t->width);
    struct wrapped_four k = { wrapped_words(w->at, w->at + step, w->at + 2 * step + change, w->at + 3 * (step + change)),
                              wrapped_words(four, four + 4 * change, four + 8 * change, four + 12 * change) };
    for (; n > 0; n -= 8, out += 8) {
        const __m256i first = k.at, second = _mm256_add_epi64(first, k.step);
        k.step = _mm256_add_epi64(k.step, changes);
        k.at = _mm256_add_epi64(second, k.step);
        k.step = _mm256_add_epi64(k.step, changes);
        /* Pixels 0 1 4 5 2 3 6 7. */
        const __m256 a = _mm256_castsi256_ps(first), b = _mm256_castsi256_ps(second);
        const lanes8 u = (lanes8)_mm256_castps_si256(_mm256_shuffle_ps(a, b, 0x88));
        const lanes8 v = (lanes8)_mm256_castps_si256(_mm256_shuffle_ps(a, b, 0xdd));
        const lanes8i at = wrapped_axis_index(&down, v) * width + wrapped_axis_index(&across, u);
        const lanes8 texels = (lanes8)_mm256_permute4x64_epi64((__m256i)lanes8_gather(t->texels, at), 0xd8);
        if (n >= 8)
            lanes8_store(out, texels);
        else
            lanes8_store_some(out, texels, (lanes8)(lanes8i_numbers() < n));
    }
}

/* Eight pixels. */
struct nearer8 {
    lanes8 color;
    __m128i depth;
};

SMEAR_AVX2_INLINE struct nearer8 nearer8_of(const uint32_t *color, const uint16_t *depth, const uint32_t *in, lanes8 z)
{
    const lanes8i code = (lanes8i)(z >> 16), old = lanes8i_load_halves(depth);
    const __m256i most = (__m256i)lanes8i_max(code, old);
    return (struct nearer8){ lanes8_choose(code > old, lanes8_load(in) & 0xffffffu, lanes8_load(color)),
                             _mm_packus_epi32(_mm256_castsi256_si128(most), _mm256_extracti128_si256(most, 1)) };
}

/* The last eight are found, with some of those before, before those are stored: loads wait long for stores that they take parts
 * of. */
SMEAR_AVX2_FUNCTION void smear_nearer_run_avx2(uint32_t *color, uint16_t *depth, const uint32_t *in, int32_t n, uint32_t z, uint32_t dz)
{
    const lanes8 steps = lanes8_ramp(0, dz, lanes8_numbers());
    for (;; n -= 8, color += 8, depth += 8, in += 8, z += 8 * dz) {
        const struct nearer8 first = nearer8_of(color, depth, in, steps + z);
        const bool is_last = n < 16;
        if (is_last && n > 8) {
            const int32_t on = n - 8;
            const struct nearer8 last = nearer8_of(color + on, depth + on, in + on, steps + (z + (uint32_t)on * dz));
            lanes8_store(color + on, last.color);
            _mm_storeu_si128((__m128i *)(void *)(depth + on), last.depth);
        }
        lanes8_store(color, first.color);
        _mm_storeu_si128((__m128i *)(void *)depth, first.depth);
        if (is_last)
            return;
    }
}
#endif
