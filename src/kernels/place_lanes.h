/* SPDX-License-Identifier: MIT */
/* place_lanes.h - places of texel_places.h, eight at once: where blocks of pixels meet, and what coordinates do between. */
#ifndef SMEAR_KERNELS_PLACE_LANES_H
#define SMEAR_KERNELS_PLACE_LANES_H

#include "kernels/texel_lanes.h"

#if SMEAR_AVX2

/* The most places that are found together, and elements before and in all of what they are found in. */
enum { PLACES_LISTED = 128, PLACES_BEFORE = 8, PLACES_ALL = PLACES_BEFORE + PLACES_LISTED + 8 };

/* Coordinates of blocks' pixels 0, and how they change; `bent`: steps change, too. */
struct block_lanes {
    int32_t u[PLACES_ALL], v[PLACES_ALL], du[PLACES_ALL], dv[PLACES_ALL], ddu[PLACES_ALL], ddv[PLACES_ALL];
    bool bent;
};

struct plane_lanes {
    __m256i at, dx, dy;
};

struct place_lanes {
    __m256i u, v, nearness;
};

/* What places of a triangle have in common. */
struct planes_lanes {
    struct plane_lanes q, u, v;
    __m256i slope;
    __m128i up;
    bool divided, parabolic;
    __m256i least_q, first_up, exponent, seed, half, low, one, turns, center;       /* numbers of recip_norm and others */
};

SMEAR_AVX2_INLINE struct plane_lanes plane_start(const struct texel_plane *p)
{
    return (struct plane_lanes){ _mm256_set1_epi32(p->at), _mm256_set1_epi32(p->dx), _mm256_set1_epi32(p->dy) };
}

SMEAR_AVX2_INLINE void planes_start(struct planes_lanes *k, const struct texel_planes *p)
{
    k->q = plane_start(&p->q);
    k->u = plane_start(&p->u);
    k->v = plane_start(&p->v);
    k->slope = _mm256_set1_epi32(p->slope);
    k->up = _mm_cvtsi32_si128(p->up);
    k->divided = p->divided;
    k->parabolic = p->parabolic;
    k->least_q = texels_all(1 << 11);
    k->exponent = texels_all(158);
    k->first_up = texels_all(157);
    k->seed = texels_all(255);
    k->half = texels_all(16);
    k->low = texels_all(0xffff);
    k->one = texels_all(INT32_MIN);
    k->turns = texels_all(~255);
    k->center = texels_all(128);
}

SMEAR_AVX2_INLINE __m256i plane_lanes_at(const struct plane_lanes *p, __m256i x, __m256i row)
{
    return _mm256_add_epi32(p->at, _mm256_add_epi32(_mm256_mullo_epi32(p->dx, x), _mm256_mullo_epi32(p->dy, row)));
}

/* As mulh_i32. */
SMEAR_AVX2_INLINE __m256i mulh_lanes(__m256i a, __m256i b)
{
    const __m256i even = _mm256_mul_epi32(a, b), odd = _mm256_mul_epi32(_mm256_srli_epi64(a, 32), _mm256_srli_epi64(b, 32));
    return _mm256_blend_epi32(_mm256_srli_epi64(even, 32), odd, 0xaa);
}

/* As part_by. */
SMEAR_AVX2_INLINE __m256i part_lanes(__m256i a, __m256i part)
{
    const __m256i even = _mm256_mul_epi32(a, part);
    const __m256i odd = _mm256_mul_epi32(_mm256_srli_epi64(a, 32), _mm256_srli_epi64(part, 32));
    return _mm256_blend_epi32(_mm256_srli_epi64(even, 16), _mm256_slli_epi64(odd, 16), 0xaa);
}

/* 158 less count_leading_zeros: a float's exponent, of a number without what would round it up to a power of two. */
SMEAR_AVX2_INLINE __m256i exponent_lanes(__m256i a)
{
    const __m256i cut = _mm256_andnot_si256(_mm256_srli_epi32(a, 8), a);
    return _mm256_srli_epi32(_mm256_castps_si256(_mm256_cvtepi32_ps(cut)), 23);
}

/* As recip_norm. Seeds are gathered in pairs. */
SMEAR_AVX2_INLINE __m256i recip_lanes(const struct planes_lanes *k, __m256i m)
{
    const __m256i index = _mm256_and_si256(_mm256_srli_epi32(m, 23), k->seed);
    const __m256i second = _mm256_and_si256(_mm256_srli_epi32(m, 18), k->half);
    const __m256i pair = _mm256_i32gather_epi32((const int *)(const void *)smear_recip_seed, index, 4);
    const __m256i r = _mm256_and_si256(_mm256_srlv_epi32(pair, second), k->low);
    const __m256i error = _mm256_sub_epi32(k->one, _mm256_mullo_epi32(_mm256_srli_epi32(m, 11), r));
    return _mm256_add_epi32(_mm256_slli_epi32(r, 19),
                            _mm256_srai_epi32(_mm256_mullo_epi32(r, _mm256_srai_epi32(error, 4)), 8));
}

SMEAR_AVX2_INLINE struct place_lanes places_at(const struct planes_lanes *k, __m256i x, __m256i row)
{
    struct place_lanes p = { plane_lanes_at(&k->u, x, row), plane_lanes_at(&k->v, x, row), _mm256_setzero_si256() };
    if (!k->divided)
        return p;
    const __m256i d = _mm256_max_epi32(plane_lanes_at(&k->q, x, row), k->least_q), exponent = exponent_lanes(d);
    const __m256i r = recip_lanes(k, _mm256_sllv_epi32(d, _mm256_sub_epi32(k->exponent, exponent)));
    const __m256i up = _mm256_sub_epi32(k->first_up, exponent);
    p.u = mulh_lanes(_mm256_sllv_epi32(_mm256_srai_epi32(p.u, 1), up), r);
    p.v = mulh_lanes(_mm256_sllv_epi32(_mm256_srai_epi32(p.v, 1), up), r);
    if (k->parabolic)
        p.nearness = _mm256_srav_epi32(mulh_lanes(k->slope, r), _mm256_sub_epi32(exponent, _mm256_set1_epi32(138)));
    return p;
}

/* The same as coordinates of texels. */
SMEAR_AVX2_INLINE struct place_lanes places_of(const struct texel_lanes *k, const struct planes_lanes *planes, __m256i x, __m256i row,
                                               enum look look)
{
    struct place_lanes p = places_at(planes, x, row);
    if (look == LOOK_WRAPPED && planes->divided) {
        p.u = ratio_texels(&k->wrap.u, _mm256_slli_epi32(p.u, 2));
        p.v = ratio_texels(&k->wrap.v, _mm256_slli_epi32(p.v, 2));
    }
    return p;
}

/* Takes the last lane of `before`, then seven of a. */
SMEAR_AVX2_INLINE __m256i lanes_before(__m256i before, __m256i a)
{
    return _mm256_alignr_epi8(a, _mm256_permute2x128_si256(before, a, 0x21), 12);
}

/* 2^16 / n for n up to 16, 32 and 64, which come next. */
static const int32_t lane_inverse[19] = {
    0, 65536, 32768, 21845, 16384, 13107, 10923, 9362, 8192, 7282, 6554, 5958, 5461, 5041, 4681, 4369, 4096, 2048, 1024
};

SMEAR_AVX2_INLINE void store_lanes(int32_t *out, __m256i a) { _mm256_storeu_si256((__m256i_u *)out, a); }

/* As places_between, of one coordinate. */
SMEAR_AVX2_INLINE void between_lanes(const struct planes_lanes *k, __m256i from, __m256i to, __m256i n, __m256i part, __m256i rate,
                                     __m256i mask, int32_t *step, int32_t *change)
{
    __m256i d = part_lanes(_mm256_sub_epi32(to, from), part);
    if (k->parabolic) {
        const __m256i b = _mm256_srai_epi32(_mm256_mullo_epi32(_mm256_srai_epi32(d, 10), rate), 5);
        const __m256i more = _mm256_mullo_epi32(b, _mm256_sub_epi32(n, _mm256_set1_epi32(1)));
        d = _mm256_add_epi32(d, _mm256_srai_epi32(more, 1));
        store_lanes(change, _mm256_sub_epi32(_mm256_setzero_si256(), _mm256_and_si256(_mm256_sll_epi32(b, k->up), mask)));
    } else {
        store_lanes(change, _mm256_setzero_si256());
    }
    store_lanes(step, _mm256_and_si256(_mm256_sll_epi32(d, k->up), mask));
}

/* The coordinates of eight blocks from element i on, n pixels long: of the places where they end, and where the one before does. */
SMEAR_AVX2_INLINE void blocks_make(struct block_lanes *c, int32_t i, const struct planes_lanes *k, __m256i n, struct place_lanes before,
                                   struct place_lanes to, enum look look)
{
    const struct place_lanes from = { lanes_before(before.u, to.u), lanes_before(before.v, to.v),
                                      lanes_before(before.nearness, to.nearness) };
    const __m256i number = _mm256_min_epi32(n, _mm256_add_epi32(_mm256_srli_epi32(n, 5), k->half));
    const __m256i part = _mm256_i32gather_epi32((const int *)lane_inverse, number, 4);
    const __m256i nearness = _mm256_add_epi32(from.nearness, to.nearness);
    const __m256i rate = _mm256_srai_epi32(_mm256_add_epi32(nearness, _mm256_set1_epi32(2)), 1);
    between_lanes(k, from.u, to.u, n, part, rate, _mm256_set1_epi32(-1), c->du + i, c->ddu + i);
    between_lanes(k, from.v, to.v, n, part, rate, look == LOOK_WRAPPED ? _mm256_set1_epi32(-1) : k->turns, c->dv + i,
                  c->ddv + i);
    store_lanes(c->u + i, _mm256_sll_epi32(from.u, k->up));
    if (look == LOOK_WRAPPED) {
        store_lanes(c->v + i, from.v);
        return;
    }
    store_lanes(c->v + i, _mm256_or_si256(_mm256_and_si256(_mm256_sll_epi32(from.v, k->up), k->turns), k->center));
}
#endif

#endif
