/* SPDX-License-Identifier: MIT */
/* planes8.c - see planes8.h. Numbers of 64 bits are those of even and of odd triangles. */
#include "kernels/planes8.h"

#include "kernels/lanes8.h"

#if SMEAR_AVX2

/* A plane so steep has no exact pixels, its triangle is a sliver. */
enum { STEEP = 1 << 28 };

struct wide8 {
    __m256i even, odd;
};

/* A number without its sign, 62 bits: the upper and the lower 31 of them. */
struct halves8 {
    lanes8 high, low;
    lanes8i has_high;
    lanes8i zeros;                  /* leading ones of 64 bits that are not set */
    lanes8 top;                     /* the highest 31 bits from the first one on */
};

/* Returns a b - c d. */
SMEAR_AVX2_INLINE struct wide8 wide8_cross(lanes8i a, lanes8i b, lanes8i c, lanes8i d)
{
    const __m256i even = _mm256_sub_epi64(_mm256_mul_epi32((__m256i)a, (__m256i)b), _mm256_mul_epi32((__m256i)c, (__m256i)d));
    const __m256i ab = _mm256_mul_epi32(_mm256_srli_epi64((__m256i)a, 32), _mm256_srli_epi64((__m256i)b, 32));
    const __m256i cd = _mm256_mul_epi32(_mm256_srli_epi64((__m256i)c, 32), _mm256_srli_epi64((__m256i)d, 32));
    return (struct wide8){ even, _mm256_sub_epi64(ab, cd) };
}

SMEAR_AVX2_INLINE __m256i wide8_size(__m256i a)
{
    const __m256i sign = _mm256_cmpgt_epi64(_mm256_setzero_si256(), a);
    return _mm256_sub_epi64(_mm256_xor_si256(a, sign), sign);
}

/* All ones where it is negative. */
SMEAR_AVX2_INLINE lanes8i wide8_signs(const struct wide8 *a)
{
    return (lanes8i)_mm256_blend_epi32(_mm256_srli_epi64(a->even, 32), a->odd, 0xaa) >> 31;
}

SMEAR_AVX2_INLINE struct halves8 halves8_of(__m256i even, __m256i odd)
{
    struct halves8 h;
    const __m256i high = _mm256_blend_epi32(_mm256_srli_epi64(even, 31), _mm256_slli_epi64(odd, 1), 0xaa);
    const __m256i low = _mm256_blend_epi32(even, _mm256_slli_epi64(odd, 32), 0xaa);
    h.high = (lanes8)high & 0x7fffffffu;
    h.low = (lanes8)low & 0x7fffffffu;
    h.has_high = (lanes8i)h.high > 0;
    const lanes8 first = lanes8_choose(h.has_high, h.high, h.low);
    const lanes8i zeros = lanes8i_zeros((lanes8i)first);
    h.zeros = zeros + lanes8i_choose(h.has_high, lanes8i_all(1), lanes8i_all(32));
    h.top = lanes8_left(first, zeros - 1) | ((lanes8)h.has_high & lanes8_right(h.low, 32 - zeros));
    return h;
}

/* Returns scale_sat(g, shift) for g that is not negative. */
SMEAR_AVX2_INLINE lanes8i scaled8(lanes8i g, lanes8i shift)
{
    const lanes8i up = lanes8i_max(shift, lanes8i_all(0)), down = lanes8i_max(-shift, lanes8i_all(0));
    const lanes8i most = lanes8i_all(INT32_MAX), shrinks = down > 0;
    const lanes8i rounded = lanes8i_right(g, down) + (lanes8i)(lanes8_right((lanes8)g, down - 1) & 1u);
    const lanes8i grown = lanes8i_choose(g > lanes8i_right(most, up), most, lanes8i_left(g, up));
    return lanes8i_choose(shrinks, rounded, grown);
}

/* gradient() of setup.c */
SMEAR_AVX2_INLINE lanes8i gradient8(struct wide8 n, lanes8i recip, lanes8i zeros)
{
    const struct halves8 h = halves8_of(wide8_size(n.even), wide8_size(n.odd));
    const lanes8i shift = lanes8i_max(lanes8i_min(zeros - h.zeros - 20, lanes8i_all(31)), lanes8i_all(-31));
    const lanes8i sign = wide8_signs(&n);
    return (scaled8(lanes8i_mulh((lanes8i)h.top, recip), shift) ^ sign) - sign;
}

/* recip_norm_precise */
SMEAR_AVX2_INLINE lanes8 recip_precise8(lanes8 m)
{
    const lanes8 r = lanes8_recip_norm(m);
    const lanes8i error = (lanes8i)((1u << 29) - lanes8_mulh(m, r));
    return r + (lanes8)((lanes8i)((r >> 12) * (lanes8)error) >> 17);
}

/* part_of() of setup.c: floor(slope part / 2^8). */
SMEAR_AVX2_INLINE lanes8i part8(lanes8i slope, lanes8i part)
{
    return (slope >> 8) * part + ((slope & 255) * part >> 8);
}

/* Coordinate i of vertex j of all triangles. */
SMEAR_AVX2_INLINE struct lanes8_four corner8(const struct poses *p, int j)
{
    return lanes8_turned(lanes8i_load_two(p->record[0][j], p->record[4][j]), lanes8i_load_two(p->record[1][j], p->record[5][j]),
                         lanes8i_load_two(p->record[2][j], p->record[6][j]), lanes8i_load_two(p->record[3][j], p->record[7][j]));
}

/* Thirty instructions a triangle, where one alone takes 300. */
SMEAR_AVX2_FUNCTION void smear_planes8_avx2(struct planes8 *out, const struct poses *p, int32_t depth_break)
{
    const struct lanes8_four v0 = corner8(p, 0), v1 = corner8(p, 1), v2 = corner8(p, 2);
    const lanes8i x = v0.of[0], y = v0.of[1], q = v0.of[2];
    const lanes8i x1 = v1.of[0] - x, y1 = v1.of[1] - y, x2 = v2.of[0] - x, y2 = v2.of[1] - y;
    const struct wide8 twice = wide8_cross(x1, y2, x2, y1);
    const struct halves8 area = halves8_of(twice.even, twice.odd);
    /* The next bit behind those of `top`; numbers without an upper half have none. */
    const lanes8 next = lanes8_right(area.low, 32 - area.zeros) & (lanes8)area.has_high & 1u;
    const lanes8 m = area.top << 1 | next;
    const lanes8 recip = recip_precise8(m);
    const lanes8i d1 = v1.of[2] - q, d2 = v2.of[2] - q;
    lanes8i dx = gradient8(wide8_cross(d1, y2, d2, y1), (lanes8i)recip, area.zeros);
    lanes8i dy = gradient8(wide8_cross(d2, x1, d1, x2), (lanes8i)recip, area.zeros);
    const lanes8i steep = lanes8i_all(STEEP);
    const lanes8i gentle = ~((lanes8i_abs(dx) > steep) | (lanes8i_abs(dy) > steep));
    dx &= gentle;
    dy &= gentle;
    const lanes8 here = (lanes8)q + (lanes8)part8(dx, 128 - (x & 255)) + (lanes8)part8(dy, 128 - (y & 255));
    out->far = lanes8i_signs(lanes8i_max3(q, v1.of[2], v2.of[2]) < depth_break);
    out->near = lanes8i_signs(lanes8i_min3(q, v1.of[2], v2.of[2]) >= depth_break);
    lanes8i_store(out->x1, x1);
    lanes8i_store(out->y1, y1);
    lanes8i_store(out->x2, x2);
    lanes8i_store(out->y2, y2);
    lanes8_store(out->area_recip, recip);
    lanes8i_store(out->area_zeros, area.zeros);
    lanes8_store(out->at, here - ((lanes8)dx * (lanes8)(x >> 8) + (lanes8)dy * (lanes8)(y >> 8)));
    lanes8i_store(out->dx, dx);
    lanes8i_store(out->dy, dy);
}

/* Twenty instructions a plane, where one alone takes 110. */
SMEAR_AVX2_FUNCTION void smear_plane_eight_avx2(struct plane_eight *out, const struct plane_triangle *t, const struct plane_values *v)
{
    const lanes8i first = lanes8i_load(v->of[0]), steep = lanes8i_all(STEEP);
    const lanes8i d1 = (lanes8i)((lanes8)lanes8i_load(v->of[1]) - (lanes8)first);
    const lanes8i d2 = (lanes8i)((lanes8)lanes8i_load(v->of[2]) - (lanes8)first);
    const lanes8i recip = lanes8i_all((int32_t)t->area_recip), zeros = lanes8i_all(t->area_zeros);
    lanes8i dx = gradient8(wide8_cross(d1, lanes8i_all(t->y2), d2, lanes8i_all(t->y1)), recip, zeros);
    lanes8i dy = gradient8(wide8_cross(d2, lanes8i_all(t->x1), d1, lanes8i_all(t->x2)), recip, zeros);
    const lanes8i gentle = ~((lanes8i_abs(dx) > steep) | (lanes8i_abs(dy) > steep));
    dx &= gentle;
    dy &= gentle;
    const lanes8 right = (lanes8)part8(dx, lanes8i_all(128 - (t->x & 255))), down = (lanes8)part8(dy, lanes8i_all(128 - (t->y & 255)));
    const lanes8 here = (lanes8)first + right + down;
    lanes8_store(out->at, here - ((lanes8)dx * (uint32_t)(t->x >> 8) + (lanes8)dy * (uint32_t)(t->y >> 8)));
    lanes8i_store(out->dx, dx);
    lanes8i_store(out->dy, dy);
}
#endif
