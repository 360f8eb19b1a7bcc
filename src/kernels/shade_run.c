/* SPDX-License-Identifier: MIT */
/* shade_run.c - see shade_run.h. */
#include "kernels/shade_run.h"

#include "kernels/lanes8.h"

#if SMEAR_AVX2
/* Depth and colour of eight pixels: z, red, green and blue. */
struct shade8 {
    lanes8 z, r, g, b;
};

/* What they look like then. */
struct shaded8 {
    lanes8 color;
    lanes8i depth;
};

static inline SMEAR_AVX2_FUNCTION struct shaded8 shaded8_over(struct shaded8 old, const struct shade8 *p, bool linear)
{
    const lanes8i code = (lanes8i)(p->z >> 16), seen = code > old.depth;
    if (linear && !lanes8_any((lanes8)seen))
        return old;
    const lanes8 pixel = linear ? lanes8_encode(p->r >> 12 & 4095u) << 16 | lanes8_encode(p->g >> 12 & 4095u) << 8
                                      | lanes8_encode(p->b >> 12 & 4095u)
                                : (p->r & 0xff0000u) | (p->g >> 8 & 0xff00u) | (p->b >> 16 & 255u);
    return (struct shaded8){ lanes8_choose(seen, pixel, old.color), (lanes8i)_mm256_max_epi32((__m256i)code, (__m256i)old.depth) };
}

static inline SMEAR_AVX2_FUNCTION struct shaded8 shaded8_of(const uint32_t *color, const uint16_t *depth, const struct shade8 *p,
                                                            bool linear)
{
    return shaded8_over((struct shaded8){ lanes8_load(color), lanes8i_load_halves(depth) }, p, linear);
}

static inline SMEAR_AVX2_FUNCTION __m128i shaded8_depths(const struct shaded8 *p)
{
    const __m256i depth = (__m256i)p->depth;
    return _mm_packus_epi32(_mm256_castsi256_si128(depth), _mm256_extracti128_si256(depth, 1));
}

static inline SMEAR_AVX2_FUNCTION void shaded8_store(uint32_t *color, uint16_t *depth, const struct shaded8 *p)
{
    _mm_storeu_si128((__m128i *)(void *)depth, shaded8_depths(p));
    lanes8_store(color, p->color);
}

static inline SMEAR_AVX2_FUNCTION struct shade8 shade8_make(uint32_t z, uint32_t dz, const struct shade *k, lanes8 numbers)
{
    return (struct shade8){ lanes8_ramp(z, dz, numbers), lanes8_ramp(k->c[0], k->d[0], numbers), lanes8_ramp(k->c[1], k->d[1], numbers),
                            lanes8_ramp(k->c[2], k->d[2], numbers) };
}

static inline SMEAR_AVX2_FUNCTION void shade8_step(struct shade8 *p, uint32_t dz, const struct shade *k, uint32_t n)
{
    p->z += lanes8_all(dz * n);
    p->r += lanes8_all(k->d[0] * n);
    p->g += lanes8_all(k->d[1] * n);
    p->b += lanes8_all(k->d[2] * n);
}

/* The first eights, and what is left with some of the last one: those are found before either is stored, as loads wait long for
 * stores that they take parts of. */
static inline SMEAR_AVX2_FUNCTION void shade_eights(uint32_t *color, uint16_t *depth, int32_t n, uint32_t z, uint32_t dz,
                                                    const struct shade *k, bool linear)
{
    struct shade8 p = shade8_make(z, dz, k, lanes8_numbers());
    for (;; n -= 8, color += 8, depth += 8) {
        const struct shaded8 first = shaded8_of(color, depth, &p, linear);
        if (n < 16 && n > 8) {
            const int32_t on = n - 8;
            shade8_step(&p, dz, k, (uint32_t)on);
            const struct shaded8 last = shaded8_of(color + on, depth + on, &p, linear);
            shaded8_store(color, depth, &first);
            shaded8_store(color + on, depth + on, &last);
            return;
        }
        shaded8_store(color, depth, &first);
        if (n == 8)
            return;
        shade8_step(&p, dz, k, 8);
    }
}

/* The first four, and the last four. */
static inline SMEAR_AVX2_FUNCTION void shade_few(uint32_t *color, uint16_t *depth, int32_t n, uint32_t z, uint32_t dz,
                                                 const struct shade *k, bool linear)
{
    const int32_t on = n - 4;
    const struct shade8 p = shade8_make(z, dz, k, lanes8_numbers_few(n));
    const __m128i depths = _mm_unpacklo_epi64(_mm_loadl_epi64((const __m128i *)(const void *)depth),
                                              _mm_loadl_epi64((const __m128i *)(const void *)(depth + on)));
    const struct shaded8 old = { lanes8_load_few(color, n), (lanes8i)_mm256_cvtepu16_epi32(depths) };
    const struct shaded8 out = shaded8_over(old, &p, linear);
    const __m128i codes = shaded8_depths(&out);
    _mm_storel_epi64((__m128i *)(void *)depth, codes);
    _mm_storel_epi64((__m128i *)(void *)(depth + on), _mm_unpackhi_epi64(codes, codes));
    lanes8_store_few(color, out.color, n);
}

/* A third of the reference's instructions. */
SMEAR_AVX2_FUNCTION void smear_shade_run_avx2(uint32_t *color, uint16_t *depth, int32_t n, uint32_t z, uint32_t dz,
                                              const struct shade *k, bool linear)
{
    if (n >= 8 && linear)
        shade_eights(color, depth, n, z, dz, k, true);
    else if (n >= 8)
        shade_eights(color, depth, n, z, dz, k, false);
    else if (linear)
        shade_few(color, depth, n, z, dz, k, true);
    else
        shade_few(color, depth, n, z, dz, k, false);
}
#endif
