/* SPDX-License-Identifier: MIT */
/* shade_rows.c - see shade_rows.h. */
#include "kernels/shade_rows.h"

#if SMEAR_AVX2

SMEAR_AVX2_INLINE lanes8 shades_of(const struct planes_light *c, bool linear)
{
    const lanes8 r = (lanes8)c->c[0], g = (lanes8)c->c[1], b = (lanes8)c->c[2];
    if (linear)
        return lanes8_encode_pixels(r >> 12 & 4095u, g >> 12 & 4095u, b >> 12 & 4095u);
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

/* Colours that are planes: values at column 0 of a row, and steps to the right. */
struct shade_planes {
    lanes8 at[3], dx[3];
};

SMEAR_AVX2_INLINE lanes8 shade_plane_row(const struct texel_plane *p, int32_t row)
{
    return lanes8_all((uint32_t)p->at + (uint32_t)p->dy * (uint32_t)row);
}

SMEAR_AVX2_INLINE void shade_planes_row(struct shade_planes *k, const struct light_planes *p, int32_t row)
{
    k->at[0] = shade_plane_row(&p->c[0], row);
    k->at[1] = shade_plane_row(&p->c[1], row);
    k->at[2] = shade_plane_row(&p->c[2], row);
}

SMEAR_AVX2_INLINE struct planes_light shade_planes_at(const struct shade_planes *k, lanes8i column)
{
    const lanes8 x = (lanes8)column;
    return (struct planes_light){ { (lanes8i)(k->at[0] + k->dx[0] * x), (lanes8i)(k->at[1] + k->dx[1] * x),
                                    (lanes8i)(k->at[2] + k->dx[2] * x) } };
}

/* Where colours come from: blocks of light, or planes. */
struct shade_source {
    struct light_lanes light;
    struct shade_planes planes;
};

/* Span number i. */
SMEAR_AVX2_INLINE void shade_row(struct shade_source *k, const struct shade_rows *t, const struct texel_spans *s, int32_t i, bool linear,
                                 bool narrow, bool blocks)
{
    const int32_t x_most = t->x1 - 8, b = s->b[i];
    const ptrdiff_t at = s->row[i] * t->stride;
    const lanes8i before = lanes8i_all(s->a[i] - 1), end = lanes8i_all(b);
    const lanes8 dz = lanes8_all(s->dz[i]);
    uint16_t *const depth = t->depth + at;
    void *const pixels = narrow ? (void *)((uint16_t *)t->color + at) : (uint32_t *)t->color + at;
    int32_t x = min_i32(s->a[i], x_most);
    lanes8i column = lanes8i_numbers() + x;
    lanes8 z = lanes8_all(s->z[i]) + dz * (lanes8)column;
    for (;;) {
        const lanes8i code = (lanes8i)(z >> 16) & (end > column) & (column > before);
        const lanes8i old = lanes8i_load_halves(depth + x), seen = code > old;
        if (lanes8i_any(seen)) {
            const struct planes_light c = blocks ? planes_light_at(&k->light, x, column) : shade_planes_at(&k->planes, column);
            const __m256i most = (__m256i)lanes8i_max(code, old);
            _mm_storeu_si128((__m128i *)(void *)(depth + x), _mm_packus_epi32(_mm256_castsi256_si128(most),
                                                                              _mm256_extracti128_si256(most, 1)));
            shades_store(narrow ? (void *)((uint16_t *)pixels + x) : (uint32_t *)pixels + x, shades_of(&c, linear), seen, narrow);
        }
        x += 8;
        if (x >= b)
            return;
        column += 8;
        z += dz << 3;
        if (x > x_most) {           /* columns that are drawn again hide themselves */
            x = x_most;
            column = lanes8i_numbers() + x;
            z = lanes8_all(s->z[i]) + dz * (lanes8)column;
        }
    }
}

SMEAR_AVX2_INLINE void shade_rows_of(const struct shade_rows *t, const struct texel_spans *s, bool linear, bool narrow, bool blocks)
{
    struct shade_source k;
    if (blocks)
        light_start(&k.light, &t->light);
    for (int i = 0; i < 3; i++)
        k.planes.dx[i] = lanes8_all((uint32_t)t->light.c[i].dx);
    for (int32_t i = 0; i < s->count; i++) {
        if (blocks)
            light_row(&k.light, s, i, t->light.block);
        else
            shade_planes_row(&k.planes, &t->light, s->row[i]);
        shade_row(&k, t, s, i, linear, narrow, blocks);
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
