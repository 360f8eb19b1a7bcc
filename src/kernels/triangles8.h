/* SPDX-License-Identifier: MIT */
/* triangles8.h - eight triangles at once, for machines of which AVX2 makes that worth it. */
#ifndef SMEAR_KERNELS_TRIANGLES8_H
#define SMEAR_KERNELS_TRIANGLES8_H

#include "kernels/lanes8.h"
#include "kernels/triangles.h"

/* Eight triangles, as struct smear_triangles has four of them, and the depths of their corners. */
struct smear_triangles8 {
    uint32_t seen, far, tiny, back;
    int32_t area[8];
    uint32_t low[8], high[8], edge1[8], edge2[8];
    int32_t e1[8], e2[8];
    uint32_t covered[8];
    int32_t depth[3][8];                /* units q11, in the order that is clockwise on the screen */
};

/* Does for eight triangles what triangles_fn does for four. `setup.both_sides` and all else is the same. */
typedef void triangles8_fn(struct smear_triangles8 *out, const struct smear_place *place, const uint16_t index[24],
                           const struct triangles_setup *s);

static inline void triangles8_take(struct smear_triangles8 *out, int k, const struct smear_triangles *four, const int32_t depth[3])
{
    const int from = k & 3;
    const bool back = (four->back >> from & 1u) != 0;
    out->seen |= (four->seen >> from & 1u) << k;
    out->far |= (four->far >> from & 1u) << k;
    out->tiny |= (four->tiny >> from & 1u) << k;
    out->back |= (uint32_t)back << k;
    out->area[k] = four->area[from];
    out->low[k] = four->low[from];
    out->high[k] = four->high[from];
    out->edge1[k] = four->edge1[from];
    out->edge2[k] = four->edge2[from];
    out->e1[k] = four->e1[from];
    out->e2[k] = four->e2[from];
    out->covered[k] = four->covered[from];
    out->depth[0][k] = depth[0];
    out->depth[1][k] = depth[back ? 2 : 1];
    out->depth[2][k] = depth[back ? 1 : 2];
}

static inline void triangles8_reference(struct smear_triangles8 *out, const struct smear_place *place, const uint16_t index[24],
                                        const struct triangles_setup *s)
{
    struct smear_triangles four = { .seen = 0 };
    out->seen = out->far = out->tiny = out->back = 0;
    for (int k = 0; k < 8; k++) {
        const uint16_t *i = index + 3 * k;
        if ((k & 3) == 0)
            triangles_reference(&four, place, i, s);
        const int32_t depth[3] = { place[i[0]].screen.depth, place[i[s->second]].screen.depth, place[i[s->third]].screen.depth };
        triangles8_take(out, k, &four, depth);
    }
}

#if SMEAR_AVX2

/* The same corner of eight triangles: x and y of triangles 0, 1, 4, 5 and of 2, 3, 6, 7, and the rest in their order. */
struct triangles8_corner {
    lanes8 place01, place23, first, depth;
};

SMEAR_AVX2_INLINE struct triangles8_corner triangles8_corner_load(const struct smear_place *place, const uint16_t *index)
{
    const __m256i a = (__m256i)lanes8i_load_two(place + index[0], place + index[12]);
    const __m256i b = (__m256i)lanes8i_load_two(place + index[3], place + index[15]);
    const __m256i c = (__m256i)lanes8i_load_two(place + index[6], place + index[18]);
    const __m256i d = (__m256i)lanes8i_load_two(place + index[9], place + index[21]);
    const __m256i ab = _mm256_unpackhi_epi32(a, b), cd = _mm256_unpackhi_epi32(c, d);
    return (struct triangles8_corner){ (lanes8)_mm256_unpacklo_epi64(a, b), (lanes8)_mm256_unpacklo_epi64(c, d),
                                       (lanes8)_mm256_unpackhi_epi64(ab, cd), (lanes8)_mm256_unpacklo_epi64(ab, cd) };
}

/* Narrows x and y of triangles 0, 1, 4, 5 and of 2, 3, 6, 7 to pairs of halves, which saturate. */
SMEAR_AVX2_INLINE lanes8 triangles8_pairs(lanes8 place01, lanes8 place23)
{
    return (lanes8)_mm256_packs_epi32((__m256i)place01, (__m256i)place23);
}

/* Returns the edges from a to b, q8 px. */
SMEAR_AVX2_INLINE lanes8 triangles8_edge(const struct triangles8_corner *a, const struct triangles8_corner *b)
{
    return triangles8_pairs(b->place01 - a->place01, b->place23 - a->place23);
}

/* Finds pairs of which a half is the least or the greatest number there is: all ones in that half. */
SMEAR_AVX2_INLINE lanes8 triangles8_at_end(lanes8 a)
{
    const __m256i same = _mm256_xor_si256((__m256i)a, _mm256_srai_epi16((__m256i)a, 15));
    return (lanes8)_mm256_cmpeq_epi16(same, _mm256_set1_epi16(INT16_MAX));
}

/* Turns pairs (x, y) into (y, -x). */
SMEAR_AVX2_INLINE lanes8 triangles8_turned(lanes8 a)
{
    return (lanes8)_mm256_sign_epi16((__m256i)(a << 16 | a >> 16), _mm256_set1_epi32(-0x10000 + 1));
}

/* Returns dy 2^16 - dx for pairs (dx, dy). */
SMEAR_AVX2_INLINE lanes8 triangles8_slope(lanes8 a) { return (a & 0xffff0000u) - (lanes8)lanes8_pair_x(a); }

SMEAR_AVX2_INLINE lanes8 triangles8_x256(lanes8 a) { return (lanes8)((lanes8i)(a << 16) >> 8); }
SMEAR_AVX2_INLINE lanes8 triangles8_y256(lanes8 a) { return (lanes8)lanes8_pair_y(a) << 8; }

/* Returns `bit` where one of the edge functions is negative, else 0. */
SMEAR_AVX2_INLINE lanes8 triangles8_beyond(lanes8 e0, lanes8 e1, lanes8 e2, uint32_t bit)
{
    return (lanes8)((lanes8i)(e0 | e1 | e2) >> 31) & bit;
}

/* What is known of eight triangles when their centres are looked for. */
struct triangles8_found {
    lanes8 edge1, edge2, low, high;
    lanes8i area;
};

/* Finds which centres of tiny boxes are covered, as triangle_cover does. */
SMEAR_AVX2_INLINE lanes8 triangles8_cover(struct smear_triangles8 *out, const struct triangles8_corner *corner,
                                          const struct triangles8_found *f)
{
    const lanes8 at = triangles8_pairs((lanes8)lanes8_pair_x(corner->place01), (lanes8)lanes8_pair_x(corner->place23));
    const lanes8 centre = lanes8_sub16(lanes8_add16(lanes8_left16(f->low, 8), lanes8_all(0x800080u)), at);
    const lanes8 turned = triangles8_turned(centre);
    const lanes8 slope1 = triangles8_slope(f->edge1), slope2 = triangles8_slope(f->edge2);
    lanes8 e2 = (lanes8)lanes8_dot(f->edge1, turned), e1 = -(lanes8)lanes8_dot(f->edge2, turned), e0 = (lanes8)f->area - e1 - e2;
    e0 += (lanes8)((lanes8i)(slope2 - slope1) > -1);
    e1 += (lanes8)((lanes8i)slope2 < 1);
    e2 += (lanes8)((lanes8i)slope1 > -1);
    lanes8_store(out->e1, e1);
    lanes8_store(out->e2, e2);
    const lanes8 x1 = triangles8_x256(f->edge1), y1 = triangles8_y256(f->edge1);
    const lanes8 x2 = triangles8_x256(f->edge2), y2 = triangles8_y256(f->edge2), right0 = y1 - y2;
    lanes8 beyond = triangles8_beyond(e0, e1, e2, 1) | triangles8_beyond(e0 + right0, e1 + y2, e2 - y1, 2);
    e0 += x2 - x1;
    e1 -= x2;
    e2 += x1;
    beyond |= triangles8_beyond(e0, e1, e2, 4) | triangles8_beyond(e0 + right0, e1 + y2, e2 - y1, 8);
    const lanes8 two = lanes8i_more16(lanes8_sub16(f->high, f->low), lanes8_all(0x10001u));
    const lanes8 wide = (lanes8)lanes8_pair_x(two) | (1u | 4u), tall = (lanes8)lanes8_pair_y(two) | (1u | 2u);
    const lanes8 covered = ~beyond & (wide & tall & 15u);
    lanes8_store(out->covered, covered);
    return covered;
}

/* Turns those over that are seen from behind. */
SMEAR_AVX2_INLINE void triangles8_turn_over(struct smear_triangles8 *out, struct triangles8_found *f, struct triangles8_corner *c1,
                                            struct triangles8_corner *c2)
{
    const lanes8i back = f->area >> 31;
    const lanes8 edge1 = f->edge1, depth1 = c1->depth;
    f->edge1 = lanes8_choose(back, f->edge2, edge1);
    f->edge2 = lanes8_choose(back, edge1, f->edge2);
    c1->depth = lanes8_choose(back, c2->depth, depth1);
    c2->depth = lanes8_choose(back, depth1, c2->depth);
    f->area = lanes8i_abs(f->area);
    out->back = lanes8i_signs(back);
}

/* In scene D of the peers it takes 25 instructions a triangle where triangles_vector takes 70. */
static inline SMEAR_AVX2_FUNCTION void triangles8_avx2(struct smear_triangles8 *out, const struct smear_place *place,
                                                       const uint16_t index[24], const struct triangles_setup *s)
{
    const struct triangles8_corner c0 = triangles8_corner_load(place, index);
    struct triangles8_corner c1 = triangles8_corner_load(place, index + s->second);
    struct triangles8_corner c2 = triangles8_corner_load(place, index + s->third);
    struct triangles8_found f = { .edge1 = triangles8_edge(&c0, &c1), .edge2 = triangles8_edge(&c0, &c2) };
    const lanes8i near = (lanes8i)(triangles8_at_end(f.edge1) | triangles8_at_end(f.edge2)) == 0;
    f.area = lanes8_dot(f.edge1, triangles8_turned(f.edge2));
    out->back = 0;
    if (s->both_sides)
        triangles8_turn_over(out, &f, &c1, &c2);
    const lanes8 margin = lanes8_all((uint32_t)s->margin * 0x10001u);
    f.low = lanes8_sub16(lanes8i_min16(c0.first, lanes8i_min16(c1.first, c2.first)), margin);
    f.high = lanes8_add16(lanes8i_max16(c0.first, lanes8i_max16(c1.first, c2.first)), margin);
    const lanes8 large = lanes8i_more16(lanes8_sub16(f.high, f.low), lanes8_all(0x20002u));
    f.low = lanes8i_max16(f.low, lanes8_all(s->low));
    f.high = lanes8i_min16(f.high, lanes8_all(s->high));
    const lanes8i full = (lanes8i)lanes8i_more16(f.high, f.low) == -1;
    out->far = lanes8i_signs(near) ^ 255u;
    out->tiny = 0;
    out->seen = lanes8i_signs(full & near & (f.area > 0));
    if (out->seen == 0)
        return;
    lanes8i_store(out->area, f.area);
    lanes8_store(out->low, f.low);
    lanes8_store(out->high, f.high);
    lanes8_store(out->edge1, f.edge1);
    lanes8_store(out->edge2, f.edge2);
    lanes8_store(out->depth[0], c0.depth);
    lanes8_store(out->depth[1], c1.depth);
    lanes8_store(out->depth[2], c2.depth);
    out->tiny = out->seen & lanes8i_signs((lanes8i)large == 0);
    if (out->tiny == 0)
        return;
    out->seen &= ~(out->tiny & lanes8i_signs((lanes8i)triangles8_cover(out, &c0, &f) == 0));
}
#endif

#endif
