/* SPDX-License-Identifier: MIT */
/* triangles.h - which triangles may be seen, four at once: those that face the viewer and whose box has pixel centres.
 * Of those in a box of 2 x 2 pixels, which centres they cover. */
#ifndef SMEAR_KERNELS_TRIANGLES_H
#define SMEAR_KERNELS_TRIANGLES_H

#include "kernels/places.h"

/* Pairs of halves are x in the lower one and y in the upper one. */
struct smear_triangles {
    uint32_t seen;                      /* bit k: triangle k may be seen */
    uint32_t far;                       /* bit k: its edges are too long for halves, nothing else is known of it */
    uint32_t tiny;                      /* bit k: its box has at most 2 x 2 pixels; e1, e2 and `covered` are known */
    uint32_t back;                      /* bit k: it is seen from behind, and its edges change places */
    int32_t area[4];                    /* twice the area, q16 px */
    uint32_t low[4], high[4];           /* the box: first pixel, and one beyond the last one, of its columns and rows */
    uint32_t edge1[4], edge2[4];        /* q8 px, to the second and the third corner */
    int32_t e1[4], e2[4];               /* edge functions at the box's first centre (struct tiny_edges) */
    uint32_t covered[4];                /* bit 0: that centre is covered; 1: that to the right; 2: below; 3: right below */
};

struct triangles_setup {
    uint32_t low, high;                 /* what of the frame is filled, as a box: coordinates below 2^15 */
    bool both_sides;                    /* those that face away are seen from behind */
    int margin;                         /* boxes are so many pixels larger on every side than what they have of centres */
    int second, third;                  /* places in an index triple of the corners that follow clockwise: 1 and 2 or 2
                                         * and 1 */
};

/* Looks at four triangles of three indices each, which name places of which all are there. Coordinates are below 2^29
 * in magnitude. Elements of triangles that are not seen are undefined; where none is seen, all are. */
typedef void triangles_fn(struct smear_triangles *out, const struct smear_place *place, const uint16_t index[12],
                          const struct triangles_setup *s);

enum { TRIANGLES_EDGE_MOST = 32766 };           /* q8 px */

static inline int32_t pair_x(uint32_t pair) { return (int16_t)(pair & 0xffffu); }
static inline int32_t pair_y(uint32_t pair) { return (int16_t)(pair >> 16); }
static inline uint32_t pair_of(int32_t x, int32_t y) { return ((uint32_t)x & 0xffffu) | (uint32_t)y << 16; }

#if SMEAR_VECTORS
/* The same corner of four triangles: places of two in each vector of four numbers, and pairs of `first`. */
struct triangles_corner {
    smear_v4i place01, place23;
    smear_v8i first;
};

static inline smear_v4i place_load(const struct smear_place *p)
{
    return (smear_v4i)v4u_load((const uint32_t *)(const void *)p);
}

static inline void triangles_corner_load(struct triangles_corner *c, const struct smear_place *place, const uint16_t *index)
{
    const smear_v4i a = place_load(place + index[0]), b = place_load(place + index[3]);
    const smear_v4i d = place_load(place + index[6]), e = place_load(place + index[9]);
    c->place01 = v4i_low_pairs(a, b);
    c->place23 = v4i_low_pairs(d, e);
    c->first = (smear_v8i)v4i_lasts(a, b, d, e);
}

/* Returns a - b, which wraps where nobody asks for it. */
static inline smear_v4i v4i_less(smear_v4i a, smear_v4i b) { return (smear_v4i)((smear_v4u)a - (smear_v4u)b); }

/* Turns pairs (x, y) into (y, -x). */
static inline smear_v8i pairs_turned(smear_v8i a)
{
    const smear_v4u swapped = (smear_v4u)a >> 16 | (smear_v4u)a << 16, upper = v4u_all(0xffff0000u);
    return (smear_v8i)((smear_v8u)(swapped ^ upper) - (smear_v8u)upper);
}

/* Returns dy 2^16 - dx for pairs (dx, dy). */
static inline smear_v4u pairs_slope(smear_v8i a)
{
    return ((smear_v4u)a & 0xffff0000u) - (smear_v4u)((smear_v4i)((smear_v4u)a << 16) >> 16);
}

static inline smear_v4u pairs_x256(smear_v8i a) { return (smear_v4u)((smear_v4i)((smear_v4u)a << 16) >> 8); }
static inline smear_v4u pairs_y256(smear_v8i a) { return (smear_v4u)((smear_v4i)a >> 16) << 8; }

static inline smear_v4u centre_bit(smear_v4u e0, smear_v4u e1, smear_v4u e2, uint32_t bit)
{
    return (smear_v4u)((smear_v4i)(e0 | e1 | e2) >= 0) & bit;
}

/* Finds which centres of tiny boxes are covered, as triangle_cover does. Pairs fit halves there; what others give is not used. */
static inline smear_v4u triangles_cover(struct smear_triangles *out, const struct triangles_corner *corner,
                                        smear_v8i edge1, smear_v8i edge2, smear_v4i area, smear_v8i low, smear_v8i high)
{
    const smear_v8i at = v4i_narrow((smear_v4i)((smear_v4u)corner->place01 << 16) >> 16,
                                    (smear_v4i)((smear_v4u)corner->place23 << 16) >> 16);
    const smear_v8i centre = (smear_v8i)(((smear_v8u)low << 8) + (smear_v8u)v8i_all(128) - (smear_v8u)at);
    const smear_v8i turned = pairs_turned(centre);
    const smear_v4u slope1 = pairs_slope(edge1), slope2 = pairs_slope(edge2);
    smear_v4u e2 = (smear_v4u)v8i_dot(edge1, turned), e1 = -(smear_v4u)v8i_dot(edge2, turned), e0 = (smear_v4u)area - e1 - e2;
    e0 += (smear_v4u)((smear_v4i)(slope2 - slope1) >= 0);
    e1 += (smear_v4u)((smear_v4i)slope2 <= 0);
    e2 += (smear_v4u)((smear_v4i)slope1 >= 0);
    v4u_store((uint32_t *)out->e1, e1);
    v4u_store((uint32_t *)out->e2, e2);
    const smear_v4u x1 = pairs_x256(edge1), y1 = pairs_y256(edge1), x2 = pairs_x256(edge2), y2 = pairs_y256(edge2);
    smear_v4u bits = centre_bit(e0, e1, e2, 1u) | centre_bit(e0 + (y1 - y2), e1 + y2, e2 - y1, 2u);
    e0 += x2 - x1;
    e1 -= x2;
    e2 += x1;
    bits |= centre_bit(e0, e1, e2, 4u) | centre_bit(e0 + (y1 - y2), e1 + y2, e2 - y1, 8u);
    const smear_v4u two = (smear_v4u)((smear_v8i)((smear_v8u)high - (smear_v8u)low) > v8i_all(1));
    const smear_v4u wide = (smear_v4u)((smear_v4i)(two << 16) >> 16), tall = (smear_v4u)((smear_v4i)two >> 16);
    bits &= 1u | (wide & 2u) | (tall & 4u) | (wide & tall & 8u);
    v4u_store(out->covered, bits);
    return bits;
}

SMEAR_INLINE void triangles_vector(struct smear_triangles *out, const struct smear_place *place, const uint16_t index[12],
                                   const struct triangles_setup *s)
{
    struct triangles_corner c0, c1, c2;
    triangles_corner_load(&c0, place, index);
    triangles_corner_load(&c1, place, index + s->second);
    triangles_corner_load(&c2, place, index + s->third);
    smear_v8i edge1 = v4i_narrow(v4i_less(c1.place01, c0.place01), v4i_less(c1.place23, c0.place23));
    smear_v8i edge2 = v4i_narrow(v4i_less(c2.place01, c0.place01), v4i_less(c2.place23, c0.place23));
    const smear_v8i end = ((edge1 ^ (edge1 >> 15)) == v8i_all(INT16_MAX)) | ((edge2 ^ (edge2 >> 15)) == v8i_all(INT16_MAX));
    const smear_v4i far = (smear_v4i)end != 0;
    smear_v4i area = v8i_dot(edge1, pairs_turned(edge2));
    out->back = 0;
    if (s->both_sides) {
        const smear_v4i back = area < 0;
        const smear_v4u first = v4u_choose(back, (smear_v4u)edge2, (smear_v4u)edge1);
        edge2 = (smear_v8i)v4u_choose(back, (smear_v4u)edge1, (smear_v4u)edge2);
        edge1 = (smear_v8i)first;
        area = v4i_less(area ^ back, back);
        out->back = v4i_signs(back);
    }
    smear_v8i low = v8i_min(c0.first, v8i_min(c1.first, c2.first)), high = v8i_max(c0.first, v8i_max(c1.first, c2.first));
    const smear_v8u margin = (smear_v8u)v8i_all((int16_t)s->margin);
    low = (smear_v8i)((smear_v8u)low - margin);
    high = (smear_v8i)((smear_v8u)high + margin);
    const smear_v4i large = (smear_v4i)((smear_v8i)((smear_v8u)high - (smear_v8u)low) > v8i_all(2)) != 0;
    low = v8i_max(low, (smear_v8i)v4u_all(s->low));
    high = v8i_min(high, (smear_v8i)v4u_all(s->high));
    const smear_v4i is_full = (smear_v4i)(smear_v8i)(high > low) == -1;
    smear_v4i seen = (area > 0) & is_full & ~far;
    out->far = v4i_signs(far);
    out->tiny = 0;
    out->seen = v4i_signs(seen);
    if (out->seen == 0)
        return;
    v4u_store((uint32_t *)out->area, (smear_v4u)area);
    v4u_store(out->low, (smear_v4u)low);
    v4u_store(out->high, (smear_v4u)high);
    v4u_store(out->edge1, (smear_v4u)edge1);
    v4u_store(out->edge2, (smear_v4u)edge2);
    out->tiny = out->seen & ~v4i_signs(large);
    if (out->tiny == 0)
        return;
    const smear_v4u covered = triangles_cover(out, &c0, edge1, edge2, area, low, high);
    seen &= large | (smear_v4i)(covered != 0);
    out->seen = v4i_signs(seen);
}
#define triangles_look triangles_vector
#else
triangles_fn triangles_look;            /* nowhere: SMEAR_PLACES */
#endif

/* ------------------------------------------------------------------ indices */

struct index_range {
    uint32_t least, most;
};

/* The range of n indices; of none it is 65535 .. 0. */
static inline struct index_range indices_range_reference(const uint16_t *index, int32_t n)
{
    struct index_range r = { UINT16_MAX, 0 };
    for (int32_t i = 0; i < n; i++) {
        r.least = min_u32(r.least, index[i]);
        r.most = max_u32(r.most, index[i]);
    }
    return r;
}

#if SMEAR_VECTORS
/* Eight at once, in the order of signed numbers: SSE2 has no unsigned minimum of 16 bits. */
static inline struct index_range indices_range_vector(const uint16_t *index, int32_t n)
{
    const smear_v8i sign = v8i_all(INT16_MIN);
    smear_v8i least = v8i_all(INT16_MAX), most = sign;
    int32_t i = 0;
    for (; i + 8 <= n; i += 8) {
        const smear_v8i a = v8i_load(index + i) ^ sign;
        least = v8i_min(least, a);
        most = v8i_max(most, a);
    }
    struct index_range r = indices_range_reference(index + i, n - i);
    for (int k = 0; k < 8; k++) {
        r.least = min_u32(r.least, (uint16_t)least[k] ^ 0x8000u);
        r.most = max_u32(r.most, (uint16_t)most[k] ^ 0x8000u);
    }
    return r;
}
#define indices_range indices_range_vector
#else
#define indices_range indices_range_reference
#endif

/* ------------------------------------------------------------------ positions */

/* Finds the least and the greatest x, y and z of n positions; 0 of none. */
static inline void positions_box_reference(int16_t box[6], const int16_t *p, int32_t n)
{
    for (int k = 0; k < 3; k++)
        box[k] = box[k + 3] = n != 0 ? p[k] : 0;
    for (const int16_t *const end = p + 3 * n; p < end; p += 3)
        for (int k = 0; k < 3; k++) {
            box[k] = p[k] < box[k] ? p[k] : box[k];
            box[k + 3] = p[k] > box[k + 3] ? p[k] : box[k + 3];
        }
}

#if SMEAR_VECTORS
/* Two positions at once, and what a vector has of the third one, but for the last. */
static inline void positions_box_vector(int16_t box[6], const int16_t *p, int32_t n)
{
    if (n < 3) {
        positions_box_reference(box, p, n);
        return;
    }
    smear_v8i least = v8i_load((const uint16_t *)p), most = least;
    for (int32_t i = 2; i < n - 1; i += 2) {
        const smear_v8i a = v8i_load((const uint16_t *)p + 3 * min_i32(i, n - 3));
        least = v8i_min(least, a);
        most = v8i_max(most, a);
    }
    const int16_t *const last = p + 3 * (n - 1);
    for (int k = 0; k < 3; k++) {
        box[k] = (int16_t)min_i32(min_i32(least[k], least[k + 3]), last[k]);
        box[k + 3] = (int16_t)max_i32(max_i32(most[k], most[k + 3]), last[k]);
    }
}
#define positions_box positions_box_vector
#else
#define positions_box positions_box_reference
#endif

#endif
