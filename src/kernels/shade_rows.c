/* SPDX-License-Identifier: MIT */
/* shade_rows.c - see shade_rows.h. */
#include "kernels/shade_rows.h"

#if SMEAR_AVX2

/* The table ends in more than three codes of 255, so that words are read within it. */
SMEAR_AVX2_INLINE lanes8 shade_code(lanes8 light)
{
    const lanes8i at = lanes8i_min((lanes8i)(light >> 12 & 4095u), lanes8i_all(4092));
    return (lanes8)_mm256_i32gather_epi32((const int *)(const void *)smear_srgb_encode, (__m256i)at, 1) & 255u;
}

SMEAR_AVX2_INLINE lanes8 shades_of(const struct planes_light *c, bool linear)
{
    const lanes8 r = (lanes8)c->c[0], g = (lanes8)c->c[1], b = (lanes8)c->c[2];
    if (linear)
        return shade_code(r) << 16 | shade_code(g) << 8 | shade_code(b);
    return (r & 0xff0000u) | (g >> 8 & 0xff00u) | (b >> 16 & 255u);
}

/* Writes eight pixels, of which those with `seen` are new. */
SMEAR_AVX2_INLINE void shades_store(void *pixels, lanes8 color, lanes8i seen, bool narrow)
{
    if (!narrow) {
        lanes8_store(pixels, lanes8_choose(seen, color, lanes8_load(pixels)));
        return;
    }
    const __m256i half = (__m256i)lanes8_narrow(color), mask = (__m256i)seen;
    const __m128i all = _mm_packus_epi32(_mm256_castsi256_si128(half), _mm256_extracti128_si256(half, 1));
    const __m128i masks = _mm_packs_epi32(_mm256_castsi256_si128(mask), _mm256_extracti128_si256(mask, 1));
    __m128i *const to = (__m128i *)pixels;
    _mm_storeu_si128(to, _mm_blendv_epi8(_mm_loadu_si128(to), all, masks));
}

/* Colours that are planes: of eight pixels from column 0 on, in row 0. */
struct shade_planes {
    lanes8 c[3];
};

SMEAR_AVX2_INLINE struct planes_light shades_at(const struct shade_planes *k, const struct light_planes *p, int32_t x, int32_t row)
{
    const uint32_t column = (uint32_t)x, down = (uint32_t)row;
    const lanes8 r = k->c[0] + lanes8_all((uint32_t)p->c[0].dx * column + (uint32_t)p->c[0].dy * down);
    const lanes8 g = k->c[1] + lanes8_all((uint32_t)p->c[1].dx * column + (uint32_t)p->c[1].dy * down);
    const lanes8 b = k->c[2] + lanes8_all((uint32_t)p->c[2].dx * column + (uint32_t)p->c[2].dy * down);
    return (struct planes_light){ { (lanes8i)r, (lanes8i)g, (lanes8i)b } };
}

SMEAR_AVX2_INLINE void shade_rows_of(const struct shade_rows *t, const struct texel_spans *s, bool linear, bool narrow, bool blocks)
{
    const lanes8 numbers = lanes8_numbers();
    const int32_t x_most = t->x1 - 8;
    struct light_lanes light;
    struct shade_planes planes;
    light_start(&light, &t->light);
    for (int i = 0; i < 3; i++)
        planes.c[i] = lanes8_ramp((uint32_t)t->light.c[i].at, (uint32_t)t->light.c[i].dx, numbers);
    for (int32_t i = 0; i < s->count; i++) {
        const int32_t row = s->row[i], a = s->a[i], b = s->b[i];
        const ptrdiff_t at = row * t->stride;
        const uint32_t dz = s->dz[i];
        const lanes8 steps = lanes8_all(dz) * numbers;
        uint16_t *const depth = t->depth + at;
        void *const pixels = narrow ? (void *)((uint16_t *)t->color + at) : (uint32_t *)t->color + at;
        if (blocks)
            light_row(&light, s, i, t->light.block);
        for (int32_t next = a; next < b; next += 8) {
            const int32_t x = min_i32(next, x_most);        /* columns before `next` are drawn already, or not at all */
            const lanes8i column = lanes8i_all(x) + (lanes8i)numbers;
            const lanes8i inside = (lanes8i_all(b) > column) & (column > lanes8i_all(next - 1));
            const lanes8i code = (lanes8i)((lanes8_all(s->z[i] + dz * (uint32_t)x) + steps) >> 16) & inside;
            const lanes8i old = lanes8i_load_halves(depth + x), seen = code > old;
            if (!lanes8i_any(seen))
                continue;
            const struct planes_light c = blocks ? planes_light_at(&light, x) : shades_at(&planes, &t->light, x, row);
            const __m256i most = (__m256i)lanes8i_max(code, old);
            _mm_storeu_si128((__m128i *)(void *)(depth + x), _mm_packus_epi32(_mm256_castsi256_si128(most),
                                                                              _mm256_extracti128_si256(most, 1)));
            shades_store(narrow ? (void *)((uint16_t *)pixels + x) : (uint32_t *)pixels + x, shades_of(&c, linear), seen, narrow);
        }
    }
}

SMEAR_AVX2_INLINE void shade_rows_kind(const struct shade_rows *t, const struct texel_spans *s, bool linear, bool narrow)
{
    if (t->light.block != 0)
        shade_rows_of(t, s, linear, narrow, true);
    else
        shade_rows_of(t, s, linear, narrow, false);
}

SMEAR_AVX2_FUNCTION void smear_shade_rows_avx2(const struct shade_rows *t, const struct texel_spans *s)
{
    if (t->linear && t->narrow)
        shade_rows_kind(t, s, true, true);
    else if (t->linear)
        shade_rows_kind(t, s, true, false);
    else if (t->narrow)
        shade_rows_kind(t, s, false, true);
    else
        shade_rows_kind(t, s, false, false);
}
#endif
