/* SPDX-License-Identifier: MIT */
/* eights.h - eight triangles, the pixels of eight tiny ones, and eight vertices at once, by AVX2. */
#ifndef SMEAR_KERNELS_EIGHTS_H
#define SMEAR_KERNELS_EIGHTS_H

#include "base/tables.h"
#include "kernels/avx2.h"
#include "kernels/points.h"

#if SMEAR_AVX2
SMEAR_AVX2_FUNCTION static inline __m256i eight_load(const void *p) { return _mm256_loadu_si256((const __m256i *)p); }

SMEAR_AVX2_FUNCTION static inline void eight_store(void *p, __m256i v) { _mm256_storeu_si256((__m256i *)p, v); }

/* Takes the highest bit of each word. */
SMEAR_AVX2_FUNCTION static inline uint32_t eight_signs(__m256i v)
{
    return (uint32_t)_mm256_movemask_ps(_mm256_castsi256_ps(v));
}

SMEAR_AVX2_FUNCTION static inline __m256i eight_all(int32_t a) { return _mm256_set1_epi32(a); }

/* Loads 16 bytes from each of two addresses. */
SMEAR_AVX2_FUNCTION static inline __m256i eight_two(const void *low, const void *high)
{
    return _mm256_inserti128_si256(_mm256_castsi128_si256(_mm_loadu_si128((const __m128i *)low)),
                                   _mm_loadu_si128((const __m128i *)high), 1);
}

/* Makes the words of eight vectors of four, of which each vector has two: those of the k-th and the (k + 4)-th. */
SMEAR_AVX2_FUNCTION static inline void eight_store_columns(void *out, __m256i a, __m256i b, __m256i c, __m256i d)
{
    const __m256i ab = _mm256_unpacklo_epi32(a, b), cd = _mm256_unpacklo_epi32(c, d);
    const __m256i AB = _mm256_unpackhi_epi32(a, b), CD = _mm256_unpackhi_epi32(c, d);
    const __m256i r0 = _mm256_unpacklo_epi64(ab, cd), r1 = _mm256_unpackhi_epi64(ab, cd);
    const __m256i r2 = _mm256_unpacklo_epi64(AB, CD), r3 = _mm256_unpackhi_epi64(AB, CD);
    __m128i *const to = (__m128i *)out;
    _mm_storeu_si128(to, _mm256_castsi256_si128(r0));
    _mm_storeu_si128(to + 1, _mm256_castsi256_si128(r1));
    _mm_storeu_si128(to + 2, _mm256_castsi256_si128(r2));
    _mm_storeu_si128(to + 3, _mm256_castsi256_si128(r3));
    _mm_storeu_si128(to + 4, _mm256_extracti128_si256(r0, 1));
    _mm_storeu_si128(to + 5, _mm256_extracti128_si256(r1, 1));
    _mm_storeu_si128(to + 6, _mm256_extracti128_si256(r2, 1));
    _mm_storeu_si128(to + 7, _mm256_extracti128_si256(r3, 1));
}

/* Shifts words by so many bits as are 0 there, and counts these. */
SMEAR_AVX2_FUNCTION static inline __m256i eight_zeros_step(__m256i *a, int bits)
{
    const __m256i none = _mm256_cmpeq_epi32(_mm256_srli_epi32(*a, 32 - bits), _mm256_setzero_si256());
    const __m256i more = _mm256_and_si256(none, eight_all(bits));
    *a = _mm256_sllv_epi32(*a, more);
    return more;
}

/* Returns how many leading zeros words have that are not 0. */
SMEAR_AVX2_FUNCTION static inline __m256i eight_zeros(__m256i a)
{
    __m256i zeros = eight_zeros_step(&a, 16);
    zeros = _mm256_or_si256(zeros, eight_zeros_step(&a, 8));
    zeros = _mm256_or_si256(zeros, eight_zeros_step(&a, 4));
    zeros = _mm256_or_si256(zeros, eight_zeros_step(&a, 2));
    return _mm256_or_si256(zeros, eight_zeros_step(&a, 1));
}

/* Does what recip_norm does. The table is read by words that lie in it. */
SMEAR_AVX2_FUNCTION static inline __m256i eight_recip(__m256i m)
{
    const __m256i at = _mm256_and_si256(_mm256_srli_epi32(m, 22), eight_all(511));
    const __m256i pair = _mm256_i32gather_epi32((const int *)(const void *)smear_recip_seed, _mm256_srli_epi32(at, 1), 4);
    const __m256i shift = _mm256_slli_epi32(_mm256_and_si256(at, eight_all(1)), 4);
    const __m256i r = _mm256_and_si256(_mm256_srlv_epi32(pair, shift), eight_all(0xffff));
    const __m256i product = _mm256_mullo_epi32(_mm256_srli_epi32(m, 11), r);
    const __m256i error = _mm256_sub_epi32(eight_all(INT32_MIN), product);
    return _mm256_add_epi32(_mm256_slli_epi32(r, 19), _mm256_srai_epi32(_mm256_mullo_epi32(r, _mm256_srai_epi32(error, 4)), 8));
}

/* ------------------------------------------------------------------ triangles */

/* The same corner of eight triangles: x and y of triangles 0, 1, 4, 5 and of 2, 3, 6, 7, and the rest in their order. */
struct eight_corner {
    __m256i place01, place23, first, depth;
};

SMEAR_AVX2_FUNCTION static inline void eight_corner_load(struct eight_corner *c, const struct smear_place *place, const uint16_t *index)
{
    const __m256i a = eight_two(place + index[0], place + index[12]), b = eight_two(place + index[3], place + index[15]);
    const __m256i d = eight_two(place + index[6], place + index[18]), e = eight_two(place + index[9], place + index[21]);
    const __m256i ab = _mm256_unpackhi_epi32(a, b), de = _mm256_unpackhi_epi32(d, e);
    c->place01 = _mm256_unpacklo_epi64(a, b);
    c->place23 = _mm256_unpacklo_epi64(d, e);
    c->depth = _mm256_unpacklo_epi64(ab, de);
    c->first = _mm256_unpackhi_epi64(ab, de);
}

/* Returns the edges from a to b, q8 px in halves that saturate. */
SMEAR_AVX2_FUNCTION static inline __m256i eight_edge(const struct eight_corner *a, const struct eight_corner *b)
{
    return _mm256_packs_epi32(_mm256_sub_epi32(b->place01, a->place01), _mm256_sub_epi32(b->place23, a->place23));
}

/* Turns pairs (x, y) into (y, -x). */
SMEAR_AVX2_FUNCTION static inline __m256i eight_turned(__m256i a)
{
    const __m256i swapped = _mm256_or_si256(_mm256_slli_epi32(a, 16), _mm256_srli_epi32(a, 16));
    return _mm256_sign_epi16(swapped, eight_all(-0x10000 + 1));
}

/* Returns dy 2^16 - dx for pairs (dx, dy). */
SMEAR_AVX2_FUNCTION static inline __m256i eight_slope(__m256i a)
{
    const __m256i dx = _mm256_srai_epi32(_mm256_slli_epi32(a, 16), 16);
    return _mm256_sub_epi32(_mm256_and_si256(a, eight_all(-0x10000)), dx);
}

SMEAR_AVX2_FUNCTION static inline __m256i eight_x256(__m256i a) { return _mm256_srai_epi32(_mm256_slli_epi32(a, 16), 8); }
SMEAR_AVX2_FUNCTION static inline __m256i eight_y256(__m256i a) { return _mm256_slli_epi32(_mm256_srai_epi32(a, 16), 8); }

/* Returns `bit` where one of the edge functions is negative, else 0. */
SMEAR_AVX2_FUNCTION static inline __m256i eight_beyond(__m256i e0, __m256i e1, __m256i e2, int32_t bit)
{
    const __m256i all = _mm256_or_si256(e0, _mm256_or_si256(e1, e2));
    return _mm256_and_si256(_mm256_srai_epi32(all, 31), eight_all(bit));
}

/* Finds which centres of tiny boxes are covered, as triangle_cover does. */
SMEAR_AVX2_FUNCTION static inline __m256i eight_cover(struct smear_eight *out, const struct eight_corner *corner, __m256i edge1,
                                                      __m256i edge2, __m256i area, __m256i low, __m256i high)
{
    const __m256i none = _mm256_setzero_si256(), ones = eight_all(-1);
    const __m256i at = _mm256_packs_epi32(_mm256_srai_epi32(_mm256_slli_epi32(corner->place01, 16), 16),
                                          _mm256_srai_epi32(_mm256_slli_epi32(corner->place23, 16), 16));
    const __m256i centre = _mm256_sub_epi16(_mm256_add_epi16(_mm256_slli_epi16(low, 8), _mm256_set1_epi16(128)), at);
    const __m256i turned = eight_turned(centre), slope1 = eight_slope(edge1), slope2 = eight_slope(edge2);
    __m256i e2 = _mm256_madd_epi16(edge1, turned), e1 = _mm256_sub_epi32(none, _mm256_madd_epi16(edge2, turned));
    __m256i e0 = _mm256_sub_epi32(_mm256_sub_epi32(area, e1), e2);
    e0 = _mm256_add_epi32(e0, _mm256_cmpgt_epi32(_mm256_sub_epi32(slope2, slope1), ones));
    e1 = _mm256_add_epi32(e1, _mm256_cmpgt_epi32(eight_all(1), slope2));
    e2 = _mm256_add_epi32(e2, _mm256_cmpgt_epi32(slope1, ones));
    eight_store(out->e1, e1);
    eight_store(out->e2, e2);
    const __m256i x1 = eight_x256(edge1), y1 = eight_y256(edge1), x2 = eight_x256(edge2), y2 = eight_y256(edge2);
    const __m256i right0 = _mm256_sub_epi32(y1, y2);
    __m256i beyond = eight_beyond(e0, e1, e2, 1);
    beyond = _mm256_or_si256(beyond, eight_beyond(_mm256_add_epi32(e0, right0), _mm256_add_epi32(e1, y2), _mm256_sub_epi32(e2, y1), 2));
    e0 = _mm256_add_epi32(e0, _mm256_sub_epi32(x2, x1));
    e1 = _mm256_sub_epi32(e1, x2);
    e2 = _mm256_add_epi32(e2, x1);
    beyond = _mm256_or_si256(beyond, eight_beyond(e0, e1, e2, 4));
    beyond = _mm256_or_si256(beyond, eight_beyond(_mm256_add_epi32(e0, right0), _mm256_add_epi32(e1, y2), _mm256_sub_epi32(e2, y1), 8));
    const __m256i two = _mm256_cmpgt_epi16(_mm256_sub_epi16(high, low), _mm256_set1_epi16(1));
    const __m256i wide = _mm256_or_si256(_mm256_srai_epi32(_mm256_slli_epi32(two, 16), 16), eight_all(1 | 4));
    const __m256i tall = _mm256_or_si256(_mm256_srai_epi32(two, 16), eight_all(1 | 2));
    const __m256i in_box = _mm256_and_si256(_mm256_and_si256(wide, tall), eight_all(15));
    const __m256i covered = _mm256_andnot_si256(beyond, in_box);
    eight_store(out->covered, covered);
    return covered;
}

/* Edges, and twice their areas. */
struct eight_edges {
    __m256i edge1, edge2, area;
};

/* Turns those over that are seen from behind. */
SMEAR_AVX2_FUNCTION static inline void eight_turn_over(struct smear_eight *out, struct eight_edges *e, struct eight_corner *c1,
                                                       struct eight_corner *c2)
{
    const __m256i back = _mm256_srai_epi32(e->area, 31), edge1 = e->edge1, depth1 = c1->depth;
    e->edge1 = _mm256_blendv_epi8(edge1, e->edge2, back);
    e->edge2 = _mm256_blendv_epi8(e->edge2, edge1, back);
    c1->depth = _mm256_blendv_epi8(depth1, c2->depth, back);
    c2->depth = _mm256_blendv_epi8(c2->depth, depth1, back);
    e->area = _mm256_abs_epi32(e->area);
    out->back = eight_signs(back);
}

/* In scene D of the peers it takes 25 instructions a triangle where triangles_vector takes 70. */
SMEAR_AVX2_FUNCTION static inline void eight_avx2(struct smear_eight *out, const struct smear_place *place, const uint16_t index[24],
                                                  const struct triangles_setup *s)
{
    struct eight_corner c0, c1, c2;
    eight_corner_load(&c0, place, index);
    eight_corner_load(&c1, place, index + s->second);
    eight_corner_load(&c2, place, index + s->third);
    struct eight_edges e = { eight_edge(&c0, &c1), eight_edge(&c0, &c2), _mm256_setzero_si256() };
    const __m256i most = _mm256_set1_epi16(INT16_MAX), ones = eight_all(-1);
    const __m256i end = _mm256_or_si256(_mm256_cmpeq_epi16(_mm256_xor_si256(e.edge1, _mm256_srai_epi16(e.edge1, 15)), most),
                                        _mm256_cmpeq_epi16(_mm256_xor_si256(e.edge2, _mm256_srai_epi16(e.edge2, 15)), most));
    const __m256i near = _mm256_cmpeq_epi32(end, _mm256_setzero_si256());
    e.area = _mm256_madd_epi16(e.edge1, eight_turned(e.edge2));
    out->back = 0;
    if (s->both_sides)
        eight_turn_over(out, &e, &c1, &c2);
    const __m256i margin = _mm256_set1_epi16((int16_t)s->margin);
    __m256i low = _mm256_min_epi16(c0.first, _mm256_min_epi16(c1.first, c2.first));
    __m256i high = _mm256_max_epi16(c0.first, _mm256_max_epi16(c1.first, c2.first));
    low = _mm256_sub_epi16(low, margin);
    high = _mm256_add_epi16(high, margin);
    const __m256i large = _mm256_cmpgt_epi16(_mm256_sub_epi16(high, low), _mm256_set1_epi16(2));
    low = _mm256_max_epi16(low, eight_all((int32_t)s->low));
    high = _mm256_min_epi16(high, eight_all((int32_t)s->high));
    const __m256i full = _mm256_cmpeq_epi32(_mm256_cmpgt_epi16(high, low), ones);
    const __m256i seen = _mm256_and_si256(_mm256_and_si256(full, near), _mm256_cmpgt_epi32(e.area, _mm256_setzero_si256()));
    out->far = eight_signs(near) ^ 255u;
    out->tiny = 0;
    out->seen = eight_signs(seen);
    if (out->seen == 0)
        return;
    eight_store(out->area, e.area);
    eight_store(out->low, low);
    eight_store(out->high, high);
    eight_store(out->edge1, e.edge1);
    eight_store(out->edge2, e.edge2);
    eight_store(out->depth[0], c0.depth);
    eight_store(out->depth[1], c1.depth);
    eight_store(out->depth[2], c2.depth);
    out->tiny = out->seen & eight_signs(_mm256_cmpeq_epi32(large, _mm256_setzero_si256()));
    if (out->tiny == 0)
        return;
    const __m256i covered = eight_cover(out, &c0, e.edge1, e.edge2, e.area, low, high);
    out->seen &= ~(out->tiny & eight_signs(_mm256_cmpeq_epi32(covered, _mm256_setzero_si256())));
}

/* ------------------------------------------------------------------ pixels of tiny triangles */

/* What all pixels of eight triangles are made of. */
struct eight_weights {
    __m256i up, recip;                  /* struct tiny_scale */
    __m256i q0, q1, q2;                 /* depths, and how the other two differ from the first */
    __m256i color;
};

SMEAR_AVX2_FUNCTION static inline __m256i eight_weight(const struct eight_weights *w, __m256i e)
{
    return _mm256_srli_epi32(_mm256_mullo_epi32(_mm256_srli_epi32(_mm256_sllv_epi32(e, w->up), 16), w->recip), 15);
}

/* Returns floor(a w / 2^16), as tiny_times does. */
SMEAR_AVX2_FUNCTION static inline __m256i eight_times(__m256i a, __m256i w)
{
    const __m256i low = _mm256_mullo_epi32(_mm256_and_si256(a, eight_all(0xffff)), w);
    return _mm256_add_epi32(_mm256_mullo_epi32(_mm256_srai_epi32(a, 16), w), _mm256_srli_epi32(low, 16));
}

/* Returns the depth code, as tiny_code does. */
SMEAR_AVX2_FUNCTION static inline __m256i eight_code(__m256i units)
{
    const __m256i far = _mm256_srli_epi32(_mm256_add_epi32(units, eight_all(0x400)), 11);
    const __m256i near = _mm256_srli_epi32(_mm256_add_epi32(units, eight_all(((32768 - 2048) << 15) + 0x4000)), 15);
    return _mm256_blendv_epi8(near, far, _mm256_cmpgt_epi32(eight_all(32768 << 11), units));
}

/* Makes the n-th pixels: `at` is 1 for the one on the right, 2 for the one below, or both. */
SMEAR_AVX2_FUNCTION static inline void eight_points(struct smear_points *out, int n, const struct smear_eight *t,
                                                    const struct eight_weights *w, __m256i at, const struct points_setup *s)
{
    const __m256i right = _mm256_srai_epi32(_mm256_slli_epi32(at, 31), 31), down = _mm256_srai_epi32(_mm256_slli_epi32(at, 30), 31);
    const __m256i edge1 = eight_load(t->edge1), edge2 = eight_load(t->edge2);
    __m256i e1 = eight_load(t->e1), e2 = eight_load(t->e2);
    e1 = _mm256_add_epi32(e1, _mm256_and_si256(eight_y256(edge2), right));
    e2 = _mm256_sub_epi32(e2, _mm256_and_si256(eight_y256(edge1), right));
    e1 = _mm256_sub_epi32(e1, _mm256_and_si256(eight_x256(edge2), down));
    e2 = _mm256_add_epi32(e2, _mm256_and_si256(eight_x256(edge1), down));
    const __m256i w1 = eight_weight(w, e1), w2 = eight_weight(w, e2);
    const __m256i depth = _mm256_add_epi32(w->q0, _mm256_add_epi32(eight_times(w->q1, w1), eight_times(w->q2, w2)));
    const __m256i code = _mm256_or_si256(eight_code(depth), eight_all(-0x10000));
    /* Minus one in the half of a column or row that is further on. */
    const __m256i place = _mm256_sub_epi16(eight_load(t->low), _mm256_blend_epi16(right, down, 0xaa));
    const __m256i row = _mm256_srli_epi32(_mm256_mullo_epi32(_mm256_srli_epi32(place, 16), eight_all((int32_t)s->row_recip)), 22);
    eight_store(out->row[n], row);
    eight_store(out->w1[n], w1);
    eight_store(out->w2[n], w2);
    eight_store_columns(out->entry[n], place, code, _mm256_setzero_si256(), w->color);
}

/* In scene D of the peers it takes 30 instructions a pixel where one after the other they take 130. */
SMEAR_AVX2_FUNCTION static inline void points_avx2(struct smear_points *out, const struct smear_eight *t, const uint32_t color[8],
                                                   const struct points_setup *s)
{
    const __m256i covered = eight_load(t->covered), none = _mm256_setzero_si256();
    uint32_t first = t->seen & t->tiny & eight_signs(_mm256_slli_epi32(_mm256_srlv_epi32(eight_all(0x177f), covered), 31));
    const __m256i q0 = eight_load(t->depth[0]), q1 = eight_load(t->depth[1]), q2 = eight_load(t->depth[2]);
    if (s->even) {
        const __m256i low = _mm256_min_epi32(q0, _mm256_min_epi32(q1, q2)), high = _mm256_max_epi32(q0, _mm256_max_epi32(q1, q2));
        first &= ~eight_signs(_mm256_cmpgt_epi32(_mm256_sub_epi32(high, low), _mm256_srai_epi32(low, 5)));
    }
    out->first = first;
    out->second = 0;
    if (first == 0)
        return;
    struct eight_weights w;
    const __m256i area = eight_load(t->area);
    w.up = eight_zeros(area);
    w.recip = _mm256_sub_epi32(_mm256_srli_epi32(eight_recip(_mm256_sllv_epi32(area, w.up)), 14), eight_all(1));
    w.q0 = q0;
    w.q1 = _mm256_sub_epi32(q1, q0);
    w.q2 = _mm256_sub_epi32(q2, q0);
    w.color = eight_load(color);
    /* The places of the lowest bit, and of the one after it, for 0 .. 15. */
    const __m256i lowest = _mm256_setr_epi8(0, 0, 1, 0, 2, 0, 1, 0, 3, 0, 1, 0, 2, 0, 1, 0, 0, 0, 1, 0, 2, 0, 1, 0, 3, 0, 1, 0, 2, 0, 1, 0);
    eight_points(out, 0, t, &w, _mm256_shuffle_epi8(lowest, covered), s);
    const __m256i more = _mm256_and_si256(covered, _mm256_add_epi32(covered, eight_all(-1)));
    out->second = first & ~eight_signs(_mm256_cmpeq_epi32(more, none));
    if (out->second != 0)
        eight_points(out, 1, t, &w, _mm256_shuffle_epi8(lowest, more), s);
}

/* ------------------------------------------------------------------ vertices */

/* A setup as vectors: pairs of factors as struct place_row has them. */
struct eight_row {
    __m256i high_xy, high_z, low_xy, low_z, offset;
};

struct eight_rows {
    struct eight_row row[3];
    const struct place_setup *s;
};

SMEAR_AVX2_FUNCTION static inline __m256i eight_pair(int32_t a, int32_t b)
{
    return eight_all((int32_t)(((uint32_t)a & 0xffffu) | (uint32_t)b << 16));
}

SMEAR_AVX2_FUNCTION static inline void eight_rows_make(struct eight_rows *rows, const struct place_setup *s)
{
    for (int r = 0; r < 3; r++) {
        const int32_t *m = s->m[r];
        rows->row[r] = (struct eight_row){ eight_pair(m[0] >> 16, m[1] >> 16), eight_pair(0, m[2] >> 16),
                                           eight_pair((m[0] & 0xffff) >> 2, (m[1] & 0xffff) >> 2),
                                           eight_pair(0, (m[2] & 0xffff) >> 2), eight_all(m[3]) };
    }
    rows->s = s;
}

SMEAR_AVX2_FUNCTION static inline __m256i eight_row_of(const struct eight_row *row, __m256i xy, __m256i yz)
{
    const __m256i high = _mm256_add_epi32(_mm256_madd_epi16(xy, row->high_xy), _mm256_madd_epi16(yz, row->high_z));
    const __m256i low = _mm256_add_epi32(_mm256_madd_epi16(xy, row->low_xy), _mm256_madd_epi16(yz, row->low_z));
    return _mm256_add_epi32(_mm256_add_epi32(high, _mm256_srai_epi32(low, 14)), row->offset);
}

/* Returns floor(a b / 2^32). */
SMEAR_AVX2_FUNCTION static inline __m256i eight_mulh(__m256i a, __m256i b)
{
    const __m256i even = _mm256_srli_epi64(_mm256_mul_epi32(a, b), 32);
    const __m256i odd = _mm256_mul_epi32(_mm256_srli_epi64(a, 32), _mm256_srli_epi64(b, 32));
    return _mm256_blend_epi32(even, odd, 0xaa);
}

/* Returns a / 2^down, rounded to nearest, for `half` of 2^(down - 1). */
SMEAR_AVX2_FUNCTION static inline __m256i eight_down(__m256i a, __m256i half, __m256i down)
{
    return _mm256_srav_epi32(_mm256_add_epi32(a, half), down);
}

/* Does what place_scaled does. */
SMEAR_AVX2_FUNCTION static inline __m256i eight_scaled(__m256i a, __m256i shift)
{
    const __m256i down = _mm256_min_epi32(_mm256_sub_epi32(_mm256_setzero_si256(), shift), eight_all(31));
    const __m256i half = _mm256_sllv_epi32(eight_all(1), _mm256_sub_epi32(down, eight_all(1)));
    const __m256i most = _mm256_srlv_epi32(eight_all(INT32_MAX), shift);
    const __m256i up = _mm256_sllv_epi32(_mm256_min_epi32(a, most), shift);
    return _mm256_blendv_epi8(up, eight_down(a, half, down), _mm256_srai_epi32(shift, 31));
}

/* Finds the places of eight vertices as places_fn does of four. Returns for which of them: bit k stands for the k-th; others
 * take more than what most of them take, and theirs are undefined. w of any lengths may stand side by side. In scene A of
 * the peers it takes 20 instructions a vertex where places_vector takes 60. */
SMEAR_AVX2_FUNCTION static inline uint32_t places_avx2(struct smear_place out[8], const int16_t v[24], const struct eight_rows *rows)
{
    const struct place_setup *s = rows->s;
    const __m256i a = eight_two(v, v + 12), b = eight_two(v + 4, v + 16), ones = eight_all(-1);
    /* Vertices lie at bytes 0, 6 and 12 of a; the third and the fourth also at 4 and 10 of b. */
    const __m256i xy_a = _mm256_broadcastsi128_si256(_mm_setr_epi8(0, 1, 2, 3, 6, 7, 8, 9, 12, 13, 14, 15, -1, -1, -1, -1));
    const __m256i xy_b = _mm256_broadcastsi128_si256(_mm_setr_epi8(-1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, 10, 11, 12, 13));
    const __m256i yz_a = _mm256_broadcastsi128_si256(_mm_setr_epi8(2, 3, 4, 5, 8, 9, 10, 11, -1, -1, -1, -1, -1, -1, -1, -1));
    const __m256i yz_b = _mm256_broadcastsi128_si256(_mm_setr_epi8(-1, -1, -1, -1, -1, -1, -1, -1, 6, 7, 8, 9, 12, 13, 14, 15));
    const __m256i xy = _mm256_or_si256(_mm256_shuffle_epi8(a, xy_a), _mm256_shuffle_epi8(b, xy_b));
    const __m256i yz = _mm256_or_si256(_mm256_shuffle_epi8(a, yz_a), _mm256_shuffle_epi8(b, yz_b));
    const __m256i w = eight_row_of(&rows->row[2], xy, yz), zeros = eight_zeros(w);
    const __m256i down = _mm256_sub_epi32(eight_all(21), zeros), shift = _mm256_add_epi32(eight_all(s->depth_shift), zeros);
    /* Those to be left out: w < near, w > far, down < 1, shift > PLACES_UP_MOST. */
    const __m256i before = _mm256_cmpgt_epi32(eight_all(s->near_distance), w), behind = _mm256_cmpgt_epi32(w, eight_all(s->far_distance));
    const __m256i shifts = _mm256_or_si256(_mm256_cmpgt_epi32(eight_all(1), down), _mm256_cmpgt_epi32(shift, eight_all(PLACES_UP_MOST)));
    const uint32_t found = eight_signs(_mm256_or_si256(_mm256_or_si256(before, behind), shifts)) ^ 255u;
    const __m256i r = eight_recip(_mm256_sllv_epi32(w, zeros));
    const __m256i half = _mm256_sllv_epi32(eight_all(1), _mm256_add_epi32(down, ones));
    __m256i x = eight_down(eight_mulh(eight_row_of(&rows->row[0], xy, yz), r), half, down);
    __m256i y = eight_down(eight_mulh(eight_row_of(&rows->row[1], xy, yz), r), half, down);
    x = _mm256_add_epi32(x, eight_all(s->x));
    y = _mm256_add_epi32(y, eight_all(s->y));
    __m256i depth = eight_scaled(eight_mulh(eight_all(s->depth_mantissa), r), shift);
    depth = _mm256_max_epi32(_mm256_min_epi32(depth, eight_all(s->depth_most)), eight_all(s->depth_least));
    const __m256i px = _mm256_srai_epi32(_mm256_add_epi32(x, eight_all(127)), 8);
    const __m256i py = _mm256_srai_epi32(_mm256_add_epi32(y, eight_all(127)), 8);
    const __m256i packed = _mm256_packs_epi32(px, py);
    const __m256i first = _mm256_unpacklo_epi16(packed, _mm256_bsrli_epi128(packed, 8));
    eight_store_columns(out, x, y, depth, first);
    return found;
}
#endif

#endif
