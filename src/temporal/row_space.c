/* SPDX-License-Identifier: MIT */
/* row_space.c - see row_lists.h.
 *
 * With the vertices h0, h1, h2 before the division and p = (x, y, 1) a pixel, the weights of the vertices at p are those with
 * p = sum e_i h_i: e_i goes with (h_j x h_k) p, which is even in the pixel, and so is the place sum e_i o_i at another time
 * before its division. */
#include "temporal/row_lists.h"

#include "base/fixmath.h"

enum {
    CROSS_BITS = 32,        /* of products of two places: those of three then fit */
    EVEN_BITS = 46,         /* of factors of a pixel's place, which has 12 */
    SUM_DOWN = 18           /* from a sum of sides to 31 bits */
};

/* Shifts some values down so that all have so many bits. Returns by how much. */
static int normalize(int64_t *value, int count, int bits)
{
    uint64_t all = 0;
    for (int i = 0; i < count; i++)
        all |= magnitude(value[i]);
    const int down = all == 0 ? 0 : max_i32(64 - count_leading_zeros_64(all) - bits, 0);
    for (int i = 0; i < count; i++)
        value[i] >>= down;
    return down;
}

/* Makes an even value of factors of (x, y, 1), at a pixel's middle, given in half pixels from the frame's. */
static void make_even(struct smear_even *e, const int64_t factor[3], int32_t x, int32_t y, int32_t step, int coarse)
{
    e->at = factor[0] * x + factor[1] * y + factor[2] * (2 << coarse);
    e->right = factor[0] * 2 * step;
    e->down = factor[1] * 2 * step;
}

static void cross(int64_t out[3], const struct smear_homogeneous *a, const struct smear_homogeneous *b)
{
    out[0] = cross_wide(a->y, a->w, b->y, b->w);
    out[1] = cross_wide(a->w, a->x, b->w, b->x);
    out[2] = cross_wide(a->x, a->y, b->x, b->y);
}

static void places_at(struct smear_homogeneous place[3], struct smear_space *space, const int32_t *const record[3], int32_t phase)
{
    for (int i = 0; i < 3; i++)
        smear_space_at(&place[i], space, record[i], phase);
}

/* Finds what makes depths of sums of sides. `whole`: the triangle's X Y W, above 0. */
static void find_nearness(struct smear_plane_motion *m, const struct smear_space *space, int64_t whole)
{
    const int zeros = count_leading_zeros_64((uint64_t)whole);
    const uint32_t r = recip_norm((uint32_t)((uint64_t)whole << zeros >> 32));      /* 1 / whole = r 2^(zeros - 93) */
    m->nearness = mulh_i32(space->depths.depth_mantissa, (int32_t)r);
    /* depth q11 = mantissa 2^(29 + shift) sum / (2^(1 + coarse) whole) */
    m->nearness_shift = 14 + 1 + space->depths.coarse + 93 - zeros - 32 - 29 - space->depths.depth_shift - SUM_DOWN;
}

bool smear_plane_motion_make(struct smear_plane_motion *m, struct smear_space *space, const int32_t *const record[3],
                             int32_t x, int32_t y, int32_t step)
{
    struct smear_homogeneous place[3];
    int64_t side[3][3];
    x = 2 * x + 1 - space->viewport.width;
    y = 2 * y + 1 - space->viewport.height;
    places_at(place, space, record, 0);
    for (int i = 0; i < 3; i++)
        cross(side[i], &place[i == 2 ? 0 : i + 1], &place[i == 0 ? 2 : i - 1]);
    normalize(&side[0][0], 9, CROSS_BITS);
    const int64_t whole = side[0][0] * place[0].x + side[0][1] * place[0].y + side[0][2] * place[0].w;
    if (whole <= 0)
        return false;
    m->width = space->viewport.width;
    m->height = space->viewport.height;
    m->coarse = space->depths.coarse;
    m->is_even = depths_are_even(&space->depths);
    find_nearness(m, space, whole);
    for (int i = 0; i < 3; i++) {
        make_even(&m->side[i], side[i], x, y, step, space->depths.coarse);
        m->depth[i] = m->is_even ? max_i32(depth_even(&space->depths, place[i].distance), 0) >> 14 : 0;
    }
    for (int k = 0; k < 2; k++) {
        int64_t factor[3][3];
        places_at(place, space, record, k == 0 ? -(1 << 30) : 1 << 30);
        for (int c = 0; c < 3; c++) {
            factor[0][c] = side[0][c] * place[0].x + side[1][c] * place[1].x + side[2][c] * place[2].x;
            factor[1][c] = side[0][c] * place[0].y + side[1][c] * place[1].y + side[2][c] * place[2].y;
            factor[2][c] = side[0][c] * place[0].w + side[1][c] * place[1].w + side[2][c] * place[2].w;
        }
        normalize(&factor[0][0], 9, EVEN_BITS);
        for (int r = 0; r < 3; r++)
            make_even(&m->pose[k][r], factor[r], x, y, step, space->depths.coarse);
    }
    return true;
}

void smear_plane_motion_go(struct smear_plane_motion *m, bool down)
{
    for (int i = 0; i < 3; i++) {
        m->side[i].at += down ? m->side[i].down : m->side[i].right;
        m->pose[0][i].at += down ? m->pose[0][i].down : m->pose[0][i].right;
        m->pose[1][i].at += down ? m->pose[1][i].down : m->pose[1][i].right;
    }
}

/* Returns the depth of a place of the triangle, q11 >> 14. */
static int32_t depth_of(const struct smear_plane_motion *m)
{
    const int64_t sum = m->side[0].at + m->side[1].at + m->side[2].at;
    if (m->is_even) {
        const int down = max_i32(64 - 15 - count_leading_zeros_64((uint64_t)sum | 1u), 0);       /* depths have 17 bits */
        uint32_t depths = 0;
        for (int i = 0; i < 3; i++)
            depths += (uint32_t)(m->side[i].at >> down) * (uint32_t)m->depth[i];
        return (int32_t)(depths / max_u32((uint32_t)(sum >> down), 1));
    }
    const int64_t product = (sum >> SUM_DOWN) * m->nearness;
    const int down = m->nearness_shift;
    return down >= 63 ? 0 : down >= 0 ? narrow_sat(product >> down) : product == 0 ? 0 : INT32_MAX;
}

/* Divides a place at open or close: 1/16 px from the frame's centre. False where it lies behind the eye. */
static bool divide(int32_t out[2], const struct smear_even pose[3], int coarse)
{
    if (pose[2].at <= 0)
        return false;
    const int up = count_leading_zeros_64((uint64_t)pose[2].at);
    const int32_t r = (int32_t)recip_norm((uint32_t)((uint64_t)pose[2].at << up >> 32));     /* 1 / W = r 2^(up - 93) */
    for (int i = 0; i < 2; i++) {
        const int down = 32 - up + 12 - coarse;         /* of what lies within 2048 px 31 bits are left */
        const int64_t part = down >= 0 ? pose[i].at >> down : pose[i].at * ((int64_t)1 << -down);
        out[i] = (mulh_i32(narrow_sat(part), r) + (1 << 12)) >> 13;
    }
    return true;
}

bool smear_plane_motion_at(struct smear_place_motion *out, const struct smear_plane_motion *m, int32_t x, int32_t y)
{
    int32_t open[2], close[2];
    if ((m->side[0].at | m->side[1].at | m->side[2].at) < 0)
        return false;
    const int32_t depth = depth_of(m);
    if (depth > SMEAR_DEPTH_MAX >> 14)
        return false;
    *out = (struct smear_place_motion){ 0, 0, PLACE_UNKNOWN, (uint16_t)clamp_i32(depth, 1, UINT16_MAX) };
    if (!divide(open, m->pose[0], m->coarse) || !divide(close, m->pose[1], m->coarse))
        return true;
    const int32_t twice_x = 16 * (2 * x + 1 - m->width), twice_y = 16 * (2 * y + 1 - m->height);
    out->x = close[0] - open[0];
    out->y = close[1] - open[1];
    out->bend = max_i32(abs_i32(open[0] + close[0] - twice_x), abs_i32(open[1] + close[1] - twice_y));
    return true;
}
