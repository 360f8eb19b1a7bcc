/* SPDX-License-Identifier: MIT */
/* places.h - from the vertices of a mesh to the screen, four at once. */
#ifndef SMEAR_KERNELS_PLACES_H
#define SMEAR_KERNELS_PLACES_H

#include "base/fixmath.h"
#include "kernels/kernels.h"
#include "kernels/vector.h"

struct smear_screen {
    i32q8 x, y;                 /* from the top left corner of the frame */
    i32q11 depth;               /* units: proportional to 1/w for perspective */
};

/* A vertex on the screen. */
struct smear_place {
    struct smear_screen screen;
    uint32_t first;             /* the first pixels whose centres lie at or beyond x and y: x in the lower half, y in the
                                 * upper one; halves saturate */
};

/* Pixels beyond which halves of smear_place.first do not reach. */
static inline uint32_t place_first(int32_t x, int32_t y)
{
    const int32_t px = clamp_i32((x + 127) >> 8, INT16_MIN, INT16_MAX), py = clamp_i32((y + 127) >> 8, INT16_MIN, INT16_MAX);
    return ((uint32_t)px & 0xffffu) | (uint32_t)py << 16;
}

/* A projection with perspective, and a frame. */
struct place_setup {
    const int32_t (*m)[4];      /* rows x, y, w: floor(sum v_j m_j / 2^16) + m_3, factors are multiples of 4; |row| < 2^30 */
    int32_t near_distance, far_distance;        /* of w; near at least 1 */
    int32_t depth_mantissa;     /* in [2^29, 2^30] */
    int32_t depth_shift;
    int32_t depth_least, depth_most;
    int32_t x, y;               /* the frame's centre, q8 px */
};

/* places_find finds the places of four vertices of three coordinates each. It returns false, and writes nothing, where it takes
 * more than what most of them take: one lies before the near plane or behind the far plane, they are so near to the eye or so
 * far from it that shifts change their direction or grow, or their w differ in how many bits they have. */
enum { PLACES_UP_MOST = 16 };       /* bits by which depths are shifted up, at most */

#if SMEAR_VECTORS
/* The two halves of a row's factors beside the coordinates they go with: x and y, then y and z, of which y has been taken. */
struct place_row {
    smear_v8i high_xy, high_z, low_xy, low_z;
    smear_v4u offset;
};

static inline smear_v8i place_pair(int32_t a, int32_t b)
{
    const int16_t x = (int16_t)a, y = (int16_t)b;
    return (smear_v8i){ x, y, x, y, x, y, x, y };
}

static inline void place_row_make(struct place_row *row, const int32_t m[4])
{
    row->high_xy = place_pair(m[0] >> 16, m[1] >> 16);
    row->high_z = place_pair(0, m[2] >> 16);
    row->low_xy = place_pair((m[0] & 0xffff) >> 2, (m[1] & 0xffff) >> 2);
    row->low_z = place_pair(0, (m[2] & 0xffff) >> 2);
    row->offset = v4u_all((uint32_t)m[3]);
}

static inline smear_v4i place_row_of(const struct place_row *row, smear_v8i xy, smear_v8i yz)
{
    const smear_v4u high = (smear_v4u)v8i_dot(xy, row->high_xy) + (smear_v4u)v8i_dot(yz, row->high_z);
    const smear_v4i low = v8i_dot(xy, row->low_xy) + v8i_dot(yz, row->low_z);
    return (smear_v4i)(high + (smear_v4u)(low >> 14) + row->offset);
}

/* Does what recip_norm does: products of 11, 10 and 8 bits in pairs of which the other is 0. */
static inline smear_v4i place_recip(smear_v4u m)
{
    smear_v4i seed;
    for (int i = 0; i < 4; i++)
        seed[i] = smear_recip_seed[m[i] >> 22 & 511u];
    const smear_v8i s = (smear_v8i)seed;
    const smear_v4u product = ((smear_v4u)v8i_dot((smear_v8i)(m >> 21), s) << 10)
                            + (smear_v4u)v8i_dot((smear_v8i)(m >> 11 & 1023u), s);
    const smear_v4i error = (smear_v4i)(0x80000000u - product) >> 4;
    return (seed << 19) + v8i_dot((smear_v8i)(error >> 8), s) + (v8i_dot((smear_v8i)(error & 255), s) >> 8);
}

/* A setup as vectors. */
struct place_rows {
    struct place_row row[3];
    const struct place_setup *s;
};

static inline void place_rows_make(struct place_rows *rows, const struct place_setup *s)
{
    for (int r = 0; r < 3; r++)
        place_row_make(&rows->row[r], s->m[r]);
    rows->s = s;
}

/* Returns a 2^shift for a in 0 .. 2^28, rounded to nearest; what is 2^30 or more is undefined, but that. */
static inline smear_v4i place_scaled(smear_v4i a, int shift)
{
    if (shift < 0) {
        const int down = min_i32(-shift, 31);
        return (a + v4i_all(1 << (down - 1))) >> down;
    }
    return v4i_min(a, v4i_all(INT32_MAX >> shift)) << shift;
}

static inline bool places_vector(struct smear_place out[4], const int16_t v[12], const struct place_rows *rows)
{
    const struct place_setup *s = rows->s;
    const smear_v8i xy = v8i_of_pairs(v, v + 3, v + 6, v + 9), yz = v8i_of_pairs(v + 1, v + 4, v + 7, v + 10);
    const smear_v4i w = place_row_of(&rows->row[2], xy, yz);
    const int zeros = count_leading_zeros((uint32_t)w[0] | 1u), down = 21 - zeros;
    const smear_v4u beyond = ((smear_v4u)w - (uint32_t)s->near_distance) | ((uint32_t)s->far_distance - (smear_v4u)w);
    const smear_v4u other = 0u - ((smear_v4u)(w >> (31 - zeros)) ^ 1u);     /* w of another length: positive before */
    if (v4i_signs((smear_v4i)(beyond | other)) != 0 || down <= 0 || s->depth_shift + zeros > PLACES_UP_MOST)
        return false;
    const smear_v4i r = place_recip((smear_v4u)w << zeros);
    const smear_v4i half = v4i_all(1 << (down - 1));
    const smear_v4i x = ((v4i_mulh(place_row_of(&rows->row[0], xy, yz), r) + half) >> down) + s->x;
    const smear_v4i y = ((v4i_mulh(place_row_of(&rows->row[1], xy, yz), r) + half) >> down) + s->y;
    smear_v4i depth = place_scaled(v4i_mulh(v4i_all(s->depth_mantissa), r), s->depth_shift + zeros);
    depth = v4i_max(v4i_min(depth, v4i_all(s->depth_most)), v4i_all(s->depth_least));
    const smear_v4u first = v8i_pairs(v4i_narrow((x + 127) >> 8, (y + 127) >> 8));
    v4i_store_columns((int32_t *)(void *)out, x, y, depth, (smear_v4i)first);
    return true;
}
#define places_find places_vector
#else
struct place_rows {
    const struct place_setup *s;
};

/* Nowhere: SMEAR_PLACES. */
void place_rows_make(struct place_rows *rows, const struct place_setup *s);
bool places_find(struct smear_place out[4], const int16_t v[12], const struct place_rows *rows);
#endif

#endif
