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

static inline SMEAR_AVX2_FUNCTION lanes8 pixels8_of(const struct shade8 *p, bool linear)
{
    if (linear)
        return lanes8_encode_pixels(p->r >> 12 & 4095u, p->g >> 12 & 4095u, p->b >> 12 & 4095u);
    return (p->r & 0xff0000u) | (p->g >> 8 & 0xff00u) | (p->b >> 16 & 255u);
}

static inline SMEAR_AVX2_FUNCTION struct shaded8 shaded8_over(struct shaded8 old, const struct shade8 *p, bool linear)
{
    const lanes8i code = (lanes8i)(p->z >> 16), seen = code > old.depth;
    if (linear && !lanes8_any((lanes8)seen))
        return old;
    return (struct shaded8){ lanes8_choose(seen, pixels8_of(p, linear), old.color),
                             (lanes8i)_mm256_max_epi32((__m256i)code, (__m256i)old.depth) };
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

/* ------------------------------------------------------------------ boxes */

SMEAR_AVX2_INLINE void shade_box_rows(const struct shade_box *b, bool linear, bool narrow)
{
    const lanes8 n = lanes8_numbers();
    struct shade8 p = shade8_make(b->z, b->dz, &b->k, n);
    lanes8 e0 = lanes8_ramp((uint32_t)b->e[0], (uint32_t)b->e_right[0], n);
    lanes8 e1 = lanes8_ramp((uint32_t)b->e[1], (uint32_t)b->e_right[1], n);
    lanes8 e2 = lanes8_ramp((uint32_t)b->e[2], (uint32_t)b->e_right[2], n);
    const lanes8 down0 = lanes8_all((uint32_t)b->e_down[0]), down1 = lanes8_all((uint32_t)b->e_down[1]);
    const lanes8 down2 = lanes8_all((uint32_t)b->e_down[2]), z_down = lanes8_all(b->dz_down);
    const lanes8 r_down = lanes8_all(b->k_down[0]), g_down = lanes8_all(b->k_down[1]), b_down = lanes8_all(b->k_down[2]);
    uint16_t *depth = b->depth;
    void *pixels = b->pixels;
    for (int32_t rows = b->rows; rows > 0; rows--) {
        const lanes8i old = lanes8i_load_halves(depth), outside = (lanes8i)(e0 | e1 | e2) >> 31;
        const lanes8i code = (lanes8i)(p.z >> 16) & ~outside, seen = code > old;
        if (lanes8_any((lanes8)seen)) {
            const struct shaded8 out = { pixels8_of(&p, linear), (lanes8i)_mm256_max_epi32((__m256i)code, (__m256i)old) };
            _mm_storeu_si128((__m128i *)(void *)depth, shaded8_depths(&out));
            if (narrow) {
                const __m256i half = (__m256i)lanes8_narrow(out.color), nearer = (__m256i)seen;
                const __m128i color = _mm_packus_epi32(_mm256_castsi256_si128(half), _mm256_extracti128_si256(half, 1));
                const __m128i mask = _mm_packs_epi32(_mm256_castsi256_si128(nearer), _mm256_extracti128_si256(nearer, 1));
                __m128i *const to = (__m128i *)pixels;
                _mm_storeu_si128(to, _mm_blendv_epi8(_mm_loadu_si128(to), color, mask));
            } else {
                lanes8_store((uint32_t *)pixels, lanes8_choose(seen, out.color, lanes8_load((uint32_t *)pixels)));
            }
        }
        depth += b->stride;
        pixels = pixel_after(pixels, b->stride, narrow);
        e0 += down0;
        e1 += down1;
        e2 += down2;
        p.z += z_down;
        p.r += r_down;
        p.g += g_down;
        p.b += b_down;
    }
}

SMEAR_AVX2_FUNCTION void smear_shade_box_avx2(const struct shade_box *b)
{
    if (b->narrow && b->linear)
        shade_box_rows(b, true, true);
    else if (b->narrow)
        shade_box_rows(b, false, true);
    else if (b->linear)
        shade_box_rows(b, true, false);
    else
        shade_box_rows(b, false, false);
}
#endif
