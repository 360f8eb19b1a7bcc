/* SPDX-License-Identifier: MIT */
/* tiny8.c - the pixels of eight tiny triangles by AVX2, made as tiny8.h says. A triangle costs a fourth of what it does alone. */
#include "kernels/tiny8.h"

#if SMEAR_AVX2

#include "base/fixmath.h"
#include "base/pixel.h"
#include "kernels/texel_lit.h"
#include "kernels/tiny_weights.h"

/* An element for each triangle. Pairs of halves have the first in the lower one. */
struct tiny8 {
    int32_t corner[8];                  /* pairs: the first pixel of the box, x y */
    int32_t row[8];                     /* pairs: minus the width of the box, 1 */
    int32_t per_width[8];               /* pairs: 2^11 / width, rounded up, twice */
    int32_t pixels[8];                  /* of the box */
    int32_t centre[8];                  /* pairs: from v[0] to the centre of pixel (0, 0), modulo 2^16 */
    int32_t normal1[8], normal2[8];     /* pairs: how edge functions grow */
    int32_t bias1[8], bias2[8], sum[8]; /* of the edge functions; and what all three add up to */
    int32_t area[8], zeros[8];
    int32_t recip[8];                  /* pairs: tiny_scale.recip, twice */
    int32_t q[8], q_high[8], q_low[8]; /* depth: of v[0], and pairs of how it changes, parts of 15 or 16 bits each */
    int32_t seed[8], seed_q[8], zeros_q[8];
    int32_t e[8], to_u[8], to_v[8]; /* pairs */
    int32_t u[8], v[8];
    int32_t light[3][8], to_light[3][8]; /* r g b; pairs */
    int32_t color[8];
};

SMEAR_AVX2_INLINE __m256i v8_all(int32_t a) { return _mm256_set1_epi32(a); }
SMEAR_AVX2_INLINE __m256i v8_load(const int32_t *p) { return _mm256_loadu_si256((const __m256i *)(const void *)p); }
SMEAR_AVX2_INLINE void v8_store(int32_t *p, __m256i a) { _mm256_storeu_si256((__m256i *)(void *)p, a); }
SMEAR_AVX2_INLINE __m256i v8_add(__m256i a, __m256i b) { return _mm256_add_epi32(a, b); }
SMEAR_AVX2_INLINE __m256i v8_sub(__m256i a, __m256i b) { return _mm256_sub_epi32(a, b); }
SMEAR_AVX2_INLINE __m256i v8_pair(__m256i low, __m256i high) { return _mm256_blend_epi16(low, _mm256_slli_epi32(high, 16), 0xaa); }
SMEAR_AVX2_INLINE __m256i v8_dot(__m256i a, __m256i b) { return _mm256_madd_epi16(a, b); }
/* The element of each pixel's triangle. */
SMEAR_AVX2_INLINE __m256i v8_of(const int32_t *p, __m256i triangle) { return _mm256_permutevar8x32_epi32(v8_load(p), triangle); }
/* All ones where a is not less than b, as numbers without a sign. */
SMEAR_AVX2_INLINE __m256i v8_at_least(__m256i a, __m256i b) { return _mm256_cmpeq_epi32(_mm256_max_epu32(a, b), a); }
SMEAR_AVX2_INLINE __m256i v8_fits_half(__m256i a) { return _mm256_cmpeq_epi32(_mm256_srai_epi32(_mm256_slli_epi32(a, 16), 16), a); }

/* ------------------------------------------------------------------ triangles */

/* Four words of a vertex of each triangle. */
struct tiny8_corner {
    __m256i word[4];
};

/* Loads 2, 3 or 4 words: what lies behind a record may be another core's to write. */
SMEAR_AVX2_INLINE __m128i tiny8_record(const int32_t *p, int words)
{
    return words == 4 ? _mm_loadu_si128((const __m128i *)(const void *)p)
         : words == 3 ? _mm_maskload_epi32((const int *)p, _mm_setr_epi32(-1, -1, -1, 0))
                      : _mm_loadl_epi64((const __m128i *)(const void *)p);
}

SMEAR_AVX2_INLINE __m256i tiny8_two_records(const int32_t *a, const int32_t *b, int words)
{
    return _mm256_inserti128_si256(_mm256_castsi128_si256(tiny8_record(a, words)), tiny8_record(b, words), 1);
}

SMEAR_AVX2_INLINE struct tiny8_corner tiny8_corner_load(const int32_t *record, const uint16_t vertex[8][4], int i, int words)
{
    const __m256i a = tiny8_two_records(record + vertex[0][i], record + vertex[4][i], words);
    const __m256i b = tiny8_two_records(record + vertex[1][i], record + vertex[5][i], words);
    const __m256i c = tiny8_two_records(record + vertex[2][i], record + vertex[6][i], words);
    const __m256i d = tiny8_two_records(record + vertex[3][i], record + vertex[7][i], words);
    const __m256i ab = _mm256_unpacklo_epi32(a, b), cd = _mm256_unpacklo_epi32(c, d);
    const __m256i ab2 = _mm256_unpackhi_epi32(a, b), cd2 = _mm256_unpackhi_epi32(c, d);
    return (struct tiny8_corner){ { _mm256_unpacklo_epi64(ab, cd), _mm256_unpackhi_epi64(ab, cd), _mm256_unpacklo_epi64(ab2, cd2),
                                    _mm256_unpackhi_epi64(ab2, cd2) } };
}

SMEAR_AVX2_INLINE __m256i v8_least(__m256i a, __m256i b, __m256i c) { return _mm256_min_epi32(a, _mm256_min_epi32(b, c)); }
SMEAR_AVX2_INLINE __m256i v8_most(__m256i a, __m256i b, __m256i c) { return _mm256_max_epi32(a, _mm256_max_epi32(b, c)); }
SMEAR_AVX2_INLINE __m256i v8_first_pixel(__m256i a) { return _mm256_srai_epi32(v8_add(a, v8_all(127)), 8); }

/* -1 where centres on the edge do not count, else 0: tiny_bias. */
SMEAR_AVX2_INLINE __m256i v8_bias(__m256i dx, __m256i dy)
{
    return _mm256_xor_si256(_mm256_srai_epi32(v8_sub(_mm256_slli_epi32(dy, 16), dx), 31), v8_all(-1));
}

static const uint16_t tiny8_per_width[17] = {
    2048, 2048, 1024, 683, 512, 410, 342, 293, 256, 228, 205, 187, 171, 158, 147, 137, 128
};

/* Finds boxes and edges. Returns which are tiny. */
SMEAR_AVX2_INLINE __m256i tiny8_make_edges(struct tiny8 *s, const struct tiny8_look *l, const struct tiny8_corner c[3])
{
    const __m256i x = c[0].word[0], y = c[0].word[1];
    const __m256i left = v8_first_pixel(v8_least(x, c[1].word[0], c[2].word[0])),
                  right = v8_first_pixel(v8_most(x, c[1].word[0], c[2].word[0]));
    const __m256i top = v8_first_pixel(v8_least(y, c[1].word[1], c[2].word[1])),
                  bottom = v8_first_pixel(v8_most(y, c[1].word[1], c[2].word[1]));
    const __m256i width = v8_sub(right, left), height = v8_sub(bottom, top);
    const __m256i large = _mm256_or_si256(_mm256_cmpgt_epi32(_mm256_max_epi32(width, height), v8_all(l->most)),
                                          _mm256_cmpgt_epi32(_mm256_mullo_epi32(width, height), v8_all(TINY8_BOX)));
    const __m256i cut_left = _mm256_max_epi32(left, v8_all(l->x0)), cut_top = _mm256_max_epi32(top, v8_all(l->y0)),
                  zero = v8_all(0);
    const __m256i cut_width = _mm256_max_epi32(v8_sub(_mm256_min_epi32(right, v8_all(l->x1)), cut_left), zero);
    const __m256i cut_height = _mm256_max_epi32(v8_sub(_mm256_min_epi32(bottom, v8_all(l->y1)), cut_top), zero);
    const __m256i x1 = v8_sub(c[1].word[0], x), y1 = v8_sub(c[1].word[1], y), x2 = v8_sub(c[2].word[0], x),
                  y2 = v8_sub(c[2].word[1], y);
    const __m256i normal1 = v8_pair(y2, v8_sub(zero, x2)), normal2 = v8_pair(v8_sub(zero, y1), x1),
                  area = v8_dot(normal1, v8_pair(x1, y1));
    const __m256i bias1 = v8_bias(v8_sub(zero, x2), v8_sub(zero, y2)), bias2 = v8_bias(x1, y1),
                  bias0 = v8_bias(v8_sub(x2, x1), v8_sub(y2, y1));
    v8_store(s->pixels, _mm256_andnot_si256(large, _mm256_mullo_epi32(cut_width, cut_height)));
    v8_store(s->corner, v8_pair(cut_left, cut_top));
    v8_store(s->row, v8_pair(v8_sub(zero, cut_width), v8_all(1)));
    v8_store(s->per_width, cut_width);
    v8_store(s->centre, v8_pair(v8_sub(v8_all(128), x), v8_sub(v8_all(128), y)));
    v8_store(s->normal1, normal1);
    v8_store(s->normal2, normal2);
    v8_store(s->bias1, bias1);
    v8_store(s->bias2, bias2);
    v8_store(s->sum, v8_add(v8_add(area, bias0), v8_add(bias1, bias2)));
    v8_store(s->area, area);
    return _mm256_andnot_si256(large, v8_all(-1));
}

/* 2^61 / m, as recip_norm has it, from its seed. */
SMEAR_AVX2_INLINE __m256i tiny8_recip_from(__m256i m, __m256i seed)
{
    const __m256i error = v8_sub(v8_all(INT32_MIN), _mm256_mullo_epi32(_mm256_srli_epi32(m, 11), seed));
    return v8_add(_mm256_slli_epi32(seed, 19), _mm256_srai_epi32(_mm256_mullo_epi32(seed, _mm256_srai_epi32(error, 4)), 8));
}

SMEAR_AVX2_INLINE __m256i tiny8_recip_of(const int32_t *value, int32_t *zeros, int32_t *seed)
{
    for (int k = 0; k < 8; k++) {
        const uint32_t a = (uint32_t)value[k], up = _lzcnt_u32(a);
        zeros[k] = (int32_t)up;
        seed[k] = smear_recip_seed[(a << (up & 31u)) >> 22 & 511u];
    }
    return tiny8_recip_from(_mm256_sllv_epi32(v8_load(value), v8_load(zeros)), v8_load(seed));
}

SMEAR_AVX2_INLINE void tiny8_make_scale(struct tiny8 *s)
{
    const __m256i recip = v8_sub(_mm256_srli_epi32(tiny8_recip_of(s->area, s->zeros, s->seed), 14), v8_all(1));
    v8_store(s->recip, v8_pair(recip, recip));
}

/* Range of what goes from 0 to a and to b. */
SMEAR_AVX2_INLINE __m256i v8_range(__m256i a, __m256i b) { return v8_sub(v8_most(a, b, v8_all(0)), v8_least(a, b, v8_all(0))); }

/* Makes depths of which weights q15 are taken, and coordinates. Returns where this will do. */
SMEAR_AVX2_INLINE __m256i tiny8_make_texture(struct tiny8 *s, const struct tiny8_look *l, const struct tiny8_corner c[3],
                                             __m256i *change)
{
    const __m256i q = c[0].word[2], to1 = v8_sub(c[1].word[2], q), to2 = v8_sub(c[2].word[2], q);
    const __m256i high1 = _mm256_srai_epi32(to1, 15), high2 = _mm256_srai_epi32(to2, 15);
    __m256i good = _mm256_and_si256(v8_fits_half(high1), v8_fits_half(high2));
    v8_store(s->q, q);
    v8_store(s->q_high, v8_pair(high1, high2));
    const __m256i low = v8_all(0x7fff);
    v8_store(s->q_low, _mm256_slli_epi16(v8_pair(_mm256_and_si256(to1, low), _mm256_and_si256(to2, low)), 1));

    __m256i u[3], v[3];
    for (int i = 0; i < 3; i++) {
        u[i] = _mm256_srai_epi32(_mm256_slli_epi32(c[i].word[3], 16), 16);
        v[i] = _mm256_srai_epi32(c[i].word[3], 16);
    }
    const __m256i to_u1 = v8_sub(u[1], u[0]), to_u2 = v8_sub(u[2], u[0]), to_v1 = v8_sub(v[1], v[0]), to_v2 = v8_sub(v[2], v[0]);
    good = _mm256_and_si256(good, _mm256_and_si256(_mm256_and_si256(v8_fits_half(to_u1), v8_fits_half(to_u2)),
                                                   _mm256_and_si256(v8_fits_half(to_v1), v8_fits_half(to_v2))));
    v8_store(s->u, _mm256_slli_epi32(u[0], 15));
    v8_store(s->v, _mm256_slli_epi32(v[0], 15));
    v8_store(s->to_u, v8_pair(to_u1, to_u2));
    v8_store(s->to_v, v8_pair(to_v1, to_v2));
    *change = v8_all(0);
    if (!l->perspective) {
        v8_store(s->e, v8_all(0));
        return good;
    }
    const __m256i eighth = _mm256_srli_epi32(q, 3), twice = v8_add(eighth, eighth);
    good =
        _mm256_and_si256(good, _mm256_and_si256(v8_at_least(twice, v8_add(to1, eighth)), v8_at_least(twice, v8_add(to2, eighth))));
    const __m256i recip = tiny8_recip_of(s->q, s->zeros_q, s->seed_q), up = v8_sub(v8_load(s->zeros_q), v8_all(1));
    const __m256i e1 = _mm256_srai_epi32((__m256i)lanes8i_mulh((lanes8i)_mm256_sllv_epi32(to1, up), (lanes8i)recip), 13);
    const __m256i e2 = _mm256_srai_epi32((__m256i)lanes8i_mulh((lanes8i)_mm256_sllv_epi32(to2, up), (lanes8i)recip), 13);
    v8_store(s->e, v8_pair(e1, e2));
    const __m256i curve = v8_range(e1, e2), square = _mm256_srli_epi32(_mm256_mullo_epi32(curve, curve), 15),
                  limit = v8_all(1 << 12);
    const __m256i travel = _mm256_max_epu32(_mm256_mullo_epi32(v8_range(to_u1, to_u2), v8_all((int32_t)l->width)),
                                            _mm256_mullo_epi32(v8_range(to_v1, to_v2), v8_all((int32_t)l->height)));
    const __m256i passed = v8_add(_mm256_srl_epi32(travel, _mm_cvtsi32_si128(l->uv_shift)), v8_all(1));
    const __m256i near = _mm256_or_si256(v8_at_least(limit, _mm256_mullo_epi32(square, v8_all((int32_t)l->span))),
                                         v8_at_least(limit, _mm256_mullo_epi32(square, passed)));
    *change = curve;
    return _mm256_and_si256(good, near);
}

/* Makes depths of which weights q16 are taken. Returns where colours may be mixed. */
SMEAR_AVX2_INLINE __m256i tiny8_make_depth(struct tiny8 *s, const struct tiny8_look *l, const struct tiny8_corner c[3])
{
    const __m256i q = c[0].word[2], to1 = v8_sub(c[1].word[2], q), to2 = v8_sub(c[2].word[2], q);
    const __m256i high1 = _mm256_srai_epi32(to1, 16), high2 = _mm256_srai_epi32(to2, 16);
    /* Weights are taken less a half. */
    v8_store(s->q, v8_add(q, _mm256_slli_epi32(v8_add(high1, high2), 15)));
    v8_store(s->q_high, v8_pair(high1, high2));
    v8_store(s->q_low, v8_pair(to1, to2));
    if (!l->even)
        return v8_all(-1);
    const __m256i low = v8_least(q, c[1].word[2], c[2].word[2]), high = v8_most(q, c[1].word[2], c[2].word[2]);
    return _mm256_xor_si256(_mm256_cmpgt_epi32(v8_sub(high, low), _mm256_srai_epi32(low, 5)), v8_all(-1));
}

/* Makes three channels of the vertices. Returns where this will do; `change`: that of 1/w, q15, of lit texels, or 0. */
SMEAR_AVX2_INLINE __m256i tiny8_make_channels(struct tiny8 *s, const struct tiny8_look *l, const uint16_t vertex[8][4], __m256i change)
{
    __m256i channel[3][3], good = v8_all(-1);
    for (int i = 0; i < 3; i++) {
        const struct tiny8_corner c = tiny8_corner_load(l->vertex + l->color, vertex, i, 2);
        channel[i][0] = _mm256_and_si256(c.word[0], v8_all(0xffff));
        channel[i][1] = _mm256_srli_epi32(c.word[0], 16);
        channel[i][2] = _mm256_and_si256(c.word[1], v8_all(0xffff));
    }
    for (int i = 0; i < 3; i++) {
        const __m256i to1 = v8_sub(channel[1][i], channel[0][i]), to2 = v8_sub(channel[2][i], channel[0][i]);
        const __m256i bent = _mm256_mullo_epi32(_mm256_srli_epi32(v8_range(to1, to2), 8), change);
        good = _mm256_and_si256(good, _mm256_and_si256(v8_fits_half(to1), v8_fits_half(to2)));
        good = _mm256_and_si256(good, v8_at_least(v8_all(2 << 15), bent));
        v8_store(s->light[i], channel[0][i]);
        v8_store(s->to_light[i], v8_pair(to1, to2));
    }
    return good;
}

/* Makes channels of one light for each triangle. */
SMEAR_AVX2_INLINE void tiny8_make_even_light(struct tiny8 *s, const struct tiny8_look *l, const uint32_t color[8])
{
    const lanes8 colors = l->white ? lanes8_all(0xffffffu) : lanes8_load(color);
    for (int i = 0; i < 3; i++) {
        const lanes8 code = colors >> (16 - 8 * i) & 255u;
        lanes8_store(s->light[i], l->linear ? lanes8_decode(code) : code << 8);
        lanes8_store(s->to_light[i], lanes8_all(0));
    }
}

/* ------------------------------------------------------------------ covered centres */

/* Pixels that are lined up: triangle and place, x y. */
struct tiny8_places {
    int32_t triangle[8 * TINY8_BOX + 8], place[8 * TINY8_BOX + 8];
};

/* Moves the words of a mask to the front. */
static const uint32_t tiny8_to_front[16][4] = {
#define W0 0x03020100u
#define W1 0x07060504u
#define W2 0x0b0a0908u
#define W3 0x0f0e0d0cu
    { W0, W0, W0, W0 }, { W0, W0, W0, W0 }, { W1, W0, W0, W0 }, { W0, W1, W0, W0 }, { W2, W0, W0, W0 }, { W0, W2, W0, W0 },
    { W1, W2, W0, W0 }, { W0, W1, W2, W0 }, { W3, W0, W0, W0 }, { W0, W3, W0, W0 }, { W1, W3, W0, W0 }, { W0, W1, W3, W0 },
    { W2, W3, W0, W0 }, { W0, W2, W3, W0 }, { W1, W2, W3, W0 }, { W0, W1, W2, W3 }
#undef W0
#undef W1
#undef W2
#undef W3
};

SMEAR_AVX2_INLINE int32_t tiny8_line_up_four(struct tiny8_places *out, int32_t n, __m128i place, uint32_t mask, __m128i triangle)
{
    const __m128i order = _mm_loadu_si128((const __m128i *)(const void *)tiny8_to_front[mask]);
    _mm_storeu_si128((__m128i *)(void *)(out->place + n), _mm_shuffle_epi8(place, order));
    _mm_storeu_si128((__m128i *)(void *)(out->triangle + n), triangle);
    return n + __builtin_popcount(mask);
}

/* Appends the covered centres of triangle k. */
SMEAR_AVX2_INLINE int32_t tiny8_line_up(struct tiny8_places *out, int32_t n, const struct tiny8 *s, int k)
{
    const __m256i pairs = _mm256_setr_epi32(0, 0x10001, 0x20002, 0x30003, 0x40004, 0x50005, 0x60006, 0x70007);
    const __m256i by_width = v8_all(s->per_width[k]), row = v8_all(s->row[k]), corner = v8_all(s->corner[k]),
                  centre = v8_all(s->centre[k]);
    const __m256i normal1 = v8_all(s->normal1[k]), normal2 = v8_all(s->normal2[k]);
    const __m256i bias1 = v8_all(s->bias1[k]), bias2 = v8_all(s->bias2[k]), sum = v8_all(s->sum[k]);
    const __m128i triangle = _mm_set1_epi32(k);
    const int32_t pixels = s->pixels[k];
    for (int32_t i = 0; i < pixels; i += 8) {
        const __m256i number = v8_add(pairs, v8_all(i * 0x10001));
        const __m256i y = _mm256_srli_epi16(_mm256_mullo_epi16(number, by_width), 11);
        const __m256i x = v8_add(corner, _mm256_and_si256(number, v8_all(0xffff)));
        const __m256i place = _mm256_add_epi16(x, _mm256_mullo_epi16(y, row));
        const __m256i at = _mm256_add_epi16(_mm256_slli_epi16(place, 8), centre);
        const __m256i e1 = v8_add(v8_dot(at, normal1), bias1), e2 = v8_add(v8_dot(at, normal2), bias2),
                      e0 = v8_sub(v8_sub(sum, e1), e2);
        const __m256i any = _mm256_or_si256(e0, _mm256_or_si256(e1, e2));
        const uint32_t mask = _bzhi_u32(~(uint32_t)_mm256_movemask_ps(_mm256_castsi256_ps(any)), (uint32_t)(pixels - i)) & 255u;
        n = tiny8_line_up_four(out, n, _mm256_castsi256_si128(place), mask & 15u, triangle);
        if (mask > 15u)
            n = tiny8_line_up_four(out, n, _mm256_extracti128_si256(place, 1), mask >> 4, triangle);
    }
    return n;
}

/* ------------------------------------------------------------------ pixels */

/* Weights: q15 if `fifteen`, else q16. */
SMEAR_AVX2_INLINE __m256i tiny8_weights_at(const struct tiny8 *s, __m256i triangle, __m256i place, bool fifteen)
{
    const __m256i at = _mm256_add_epi16(_mm256_slli_epi16(place, 8), v8_of(s->centre, triangle));
    const __m256i e1 = v8_add(v8_dot(at, v8_of(s->normal1, triangle)), v8_of(s->bias1, triangle));
    const __m256i e2 = v8_add(v8_dot(at, v8_of(s->normal2, triangle)), v8_of(s->bias2, triangle));
    const __m256i up = v8_of(s->zeros, triangle), recip = v8_of(s->recip, triangle);
    const __m256i e = _mm256_blend_epi16(_mm256_srli_epi32(_mm256_sllv_epi32(e1, up), 16), _mm256_sllv_epi32(e2, up), 0xaa);
    const __m256i high = _mm256_mulhi_epu16(e, recip);
    if (fifteen)
        return high;
    return _mm256_add_epi16(_mm256_add_epi16(high, high), _mm256_srli_epi16(_mm256_mullo_epi16(e, recip), 15));
}

/* The nearest depth code of units q11. */
SMEAR_AVX2_INLINE __m256i tiny8_code_of(__m256i units) { return (__m256i)tiny_code8((lanes8)units); }

SMEAR_AVX2_INLINE __m256i tiny8_code_at(const struct tiny8 *s, __m256i triangle, __m256i weight, bool fifteen)
{
    const __m256i part = _mm256_mulhi_epu16(weight, v8_of(s->q_low, triangle));
    const __m256i high = v8_of(s->q_high, triangle), q = v8_of(s->q, triangle);
    if (fifteen)
        return tiny8_code_of(v8_add(v8_add(q, v8_dot(weight, high)), v8_dot(part, v8_all(0x10001))));
    const __m256i low = v8_add(_mm256_and_si256(part, v8_all(0xffff)), _mm256_srli_epi32(part, 16));
    return tiny8_code_of(v8_add(v8_add(q, v8_dot(_mm256_xor_si256(weight, v8_all((int32_t)0x80008000u)), high)), low));
}

/* Numbers of texels, at weights q15. */
SMEAR_AVX2_INLINE __m256i tiny8_index_at(const struct tiny8 *s, const struct tiny8_look *l, __m256i triangle, __m256i weight)
{
    __m256i p = weight;
    if (l->perspective) {
        const __m256i to_e = v8_of(s->e, triangle), e = _mm256_srai_epi32(v8_dot(weight, to_e), 15);
        const __m256i beyond = _mm256_sub_epi16(to_e, v8_pair(e, e));
        p = _mm256_add_epi16(weight, _mm256_mulhi_epi16(weight, _mm256_add_epi16(beyond, beyond)));
    }
    const __m256i u = v8_add(v8_of(s->u, triangle), v8_dot(p, v8_of(s->to_u, triangle)));
    const __m256i v = v8_add(v8_of(s->v, triangle), v8_dot(p, v8_of(s->to_v, triangle)));
    return _mm256_or_si256(_mm256_and_si256(_mm256_sra_epi32(v, _mm_cvtsi32_si128(l->from_v)), v8_all((int32_t)l->mask_v)),
                           _mm256_and_si256(_mm256_sra_epi32(u, _mm_cvtsi32_si128(l->from_u)), v8_all((int32_t)l->mask_u)));
}

SMEAR_AVX2_INLINE __m256i tiny8_pack(struct lit_pairs p, bool narrow) { return narrow ? lit_narrow(p) : lit_wide(p); }

/* Channel i of colours mixed at weights q14, q14 of 16 bits. */
SMEAR_AVX2_INLINE __m256i v8_mixed(const struct tiny8 *s, int i, __m256i triangle, __m256i weight)
{
    return v8_add(_mm256_slli_epi32(v8_of(s->light[i], triangle), 14), v8_dot(v8_of(s->to_light[i], triangle), weight));
}

/* The code of light that was mixed, which is any number beside a triangle. */
SMEAR_AVX2_INLINE __m256i v8_encoded(__m256i light)
{
    return (__m256i)lanes8_encode((lanes8)lanes8i_min((lanes8i)((lanes8)light >> 18), lanes8i_word(LANES8_4095)));
}

SMEAR_AVX2_INLINE struct lit_pairs v8_shaded(const struct tiny8 *s, const struct tiny8_look *l, __m256i triangle, __m256i weight)
{
    const __m256i w = _mm256_srli_epi16(weight, 2), r = v8_mixed(s, 0, triangle, w), g = v8_mixed(s, 1, triangle, w);
    const __m256i b = v8_mixed(s, 2, triangle, w);
    if (l->linear)
        return (struct lit_pairs){ v8_pair(v8_encoded(b), v8_encoded(r)), v8_encoded(g) };
    const __m256i half = v8_all(1 << 21);
    return (struct lit_pairs){ v8_pair(_mm256_srli_epi32(v8_add(b, half), 22), _mm256_srli_epi32(v8_add(r, half), 22)),
                               _mm256_srli_epi32(v8_add(g, half), 22) };
}

/* One after the other: of a texture so small that words reach beyond it. */
static SMEAR_NOINLINE void tiny8_fetch_few(uint32_t texel[8], const struct tiny8_look *l)
{
    for (int i = 0; i < 8; i++)
        texel[i] = l->format == SMEAR_TEXEL_565 ? ((const uint16_t *)l->texels)[texel[i]]
                                                : l->palette[((const uint8_t *)l->texels)[texel[i]]];
}

/* Texels of these numbers: those of RGB565 in the lower halves of words. */
SMEAR_AVX2_INLINE __m256i tiny8_texels(const struct tiny8_look *l, __m256i number)
{
    const uint32_t last = l->mask_u | l->mask_v;
    if (l->format == SMEAR_TEXEL_8888)
        return (__m256i)lanes8_gather(l->texels, (lanes8i)number);
    if (l->format == SMEAR_TEXEL_565 && last > 0)
        return (__m256i)lanes8_of_halves(l->texels, (lanes8)number);
    if (l->format == SMEAR_TEXEL_PALETTE8 && last > 2)
        return (__m256i)lanes8_gather(l->palette, (lanes8i)lanes8_of_bytes(l->texels, (lanes8)number));
    uint32_t texel[8];
    lanes8_store(texel, (lanes8)number);
    tiny8_fetch_few(texel, l);
    return (__m256i)lanes8_load(texel);
}

SMEAR_AVX2_INLINE __m256i tiny8_light_at(const struct tiny8 *s, int i, __m256i triangle, __m256i weight)
{
    return v8_add(v8_of(s->light[i], triangle), _mm256_srai_epi32(v8_dot(v8_of(s->to_light[i], triangle), weight), 15));
}

/* As a code, rounded. */
SMEAR_AVX2_INLINE __m256i tiny8_code_of_light(__m256i light)
{
    return _mm256_srli_epi32(v8_add(_mm256_min_epu32(light, v8_all(0xff00)), v8_all(128)), 8);
}

/* Returns light of which 65536 is one from that of which 65535 is. */
SMEAR_AVX2_INLINE __m256i v8_whole(__m256i light) { return v8_add(light, _mm256_srli_epi32(light, 15)); }

SMEAR_AVX2_INLINE struct lit_pairs v8_lit(const struct tiny8 *s, const struct tiny8_look *l, __m256i triangle, __m256i weight,
                                          __m256i texel)
{
    const __m256i r = tiny8_light_at(s, 0, triangle, weight), g = tiny8_light_at(s, 1, triangle, weight),
                  b = tiny8_light_at(s, 2, triangle, weight);
    const bool is_565 = l->format == SMEAR_TEXEL_565;
    const struct lit_light light = { { v8_whole(r), v8_whole(g), v8_whole(b) } };
    if (l->linear && is_565)
        return lit_linear_565(texel, &light);
    const struct lit_pairs t = is_565 ? lit_pairs_of_565(texel) : lit_pairs_of_8888(texel);
    if (l->linear)
        return lit_linear_codes(t, &light);
    return (struct lit_pairs){ lit_times(t.rb, v8_pair(tiny8_code_of_light(b), tiny8_code_of_light(r))),
                               _mm256_and_si256(lit_times(t.g, tiny8_code_of_light(g)), v8_all(255)) };
}

SMEAR_AVX2_INLINE void tiny8_draw(struct tiny8_pixels *out, int32_t i, const struct tiny8 *s, const struct tiny8_look *l,
                                  const struct tiny8_places *p, enum tiny8_kind kind)
{
    const __m256i triangle = v8_load(p->triangle + i), place = v8_load(p->place + i);
    const bool textured = kind == TINY8_COPIED || kind == TINY8_LIT;
    const __m256i weight = tiny8_weights_at(s, triangle, place, textured);
    v8_store(out->at + i, v8_add(v8_dot(place, v8_all(l->stride << 16 | 1)), v8_all(l->at)));
    v8_store((int32_t *)out->code + i, tiny8_code_at(s, triangle, weight, textured));
    __m256i pixel;
    if (kind == TINY8_FLAT) {
        pixel = v8_of(s->color, triangle);
    } else if (kind == TINY8_SHADED) {
        pixel = tiny8_pack(v8_shaded(s, l, triangle, weight), l->narrow);
    } else {
        pixel = tiny8_index_at(s, l, triangle, weight);
        if (kind == TINY8_LIT)
            pixel = tiny8_pack(v8_lit(s, l, triangle, weight, tiny8_texels(l, pixel)), l->narrow);
    }
    v8_store((int32_t *)out->pixel + i, pixel);
}

SMEAR_AVX2_INLINE void tiny8_of_kind(struct tiny8_pixels *out, const struct tiny8_look *l, const uint16_t vertex[8][4],
                                     const uint32_t color[8], enum tiny8_kind kind)
{
    struct tiny8 s;
    struct tiny8_places places;
    const int words = kind == TINY8_COPIED || kind == TINY8_LIT ? 4 : 3;
    const struct tiny8_corner c[3] = { tiny8_corner_load(l->vertex, vertex, 0, words),
                                       tiny8_corner_load(l->vertex, vertex, 1, words),
                                       tiny8_corner_load(l->vertex, vertex, 2, words) };
    __m256i good = tiny8_make_edges(&s, l, c), change = v8_all(0);
    if (_mm256_testz_si256(good, good)) {       /* all are large */
        out->taken = 0;
        v8_store(out->end, v8_all(0));
        return;
    }
    tiny8_make_scale(&s);
    if (kind == TINY8_COPIED || kind == TINY8_LIT)
        good = _mm256_and_si256(good, tiny8_make_texture(&s, l, c, &change));
    else
        good = _mm256_and_si256(good, tiny8_make_depth(&s, l, c));
    if (kind == TINY8_SHADED || (kind == TINY8_LIT && l->color != 0))
        good = _mm256_and_si256(good, tiny8_make_channels(&s, l, vertex, change));
    else if (kind == TINY8_LIT)
        tiny8_make_even_light(&s, l, color);
    if (kind == TINY8_FLAT) {
        const __m256i p = v8_load((const int32_t *)color);
        v8_store(s.color, tiny8_pack((struct lit_pairs){ _mm256_and_si256(p, v8_all(0xff00ff)),
                                                         _mm256_and_si256(_mm256_srli_epi32(p, 8), v8_all(255)) },
                                     l->narrow));
    }
    out->taken = (uint32_t)_mm256_movemask_ps(_mm256_castsi256_ps(good));
    int32_t n = 0;
    for (int k = 0; k < 8; k++) {
        if ((out->taken >> k & 1u) != 0) {
            s.per_width[k] = tiny8_per_width[s.per_width[k]] * 0x10001;
            n = tiny8_line_up(&places, n, &s, k);
        }
        out->end[k] = n;
    }
    v8_store(places.triangle + n, v8_all(0));
    v8_store(places.place + n, v8_all(0));
    for (int32_t i = 0; i < n; i += 8)
        tiny8_draw(out, i, &s, l, &places, kind);
}

SMEAR_AVX2_FUNCTION void smear_tiny8_avx2(struct tiny8_pixels *out, const struct tiny8_look *l, const uint16_t vertex[8][4],
                                          const uint32_t color[8])
{
    if (l->kind == TINY8_FLAT)
        tiny8_of_kind(out, l, vertex, color, TINY8_FLAT);
    else if (l->kind == TINY8_SHADED)
        tiny8_of_kind(out, l, vertex, color, TINY8_SHADED);
    else if (l->kind == TINY8_COPIED)
        tiny8_of_kind(out, l, vertex, color, TINY8_COPIED);
    else
        tiny8_of_kind(out, l, vertex, color, TINY8_LIT);
}

#endif
