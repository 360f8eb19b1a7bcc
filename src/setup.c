/* SPDX-License-Identifier: MIT */
/* setup.c - gradients and planes of a triangle.
 *
 * Perspective: u/w, v/w and 1/w are planes; span.c takes the quotient every 4, 8 or 16 pixels, by the error bound
 * found here, and interpolates between. */
#include "setup.h"

/* ------------------------------------------------------------------ gradients */

/* (n 256 / area) with n = a1 y2 - a2 y1 (or a2 x1 - a1 x2): change per pixel of an attribute that changes by a1 and
 * a2 along the two edges; to nearest, clamped. */
static int32_t gradient(const struct setup *s, int64_t n)
{
    if (n == 0)
        return 0;
    uint64_t size = n < 0 ? 0u - (uint64_t)n : (uint64_t)n;
    int zeros = count_leading_zeros_64(size);
    int32_t top = (int32_t)(size << zeros >> 33);           /* n = top 2^(33 - zeros) */
    int32_t g = mulh_i32(top, (int32_t)s->area_recip);
    g = scale_sat(g, clamp_i32(s->area_zeros - zeros - 20, -31, 31));
    return n < 0 ? -g : g;
}

/* (frac q8) x slope / 256, exact floor without a wide product. */
static inline int32_t part_of(int32_t slope, int32_t frac)
{
    return mul_wrap(slope >> 8, frac) + ((slope & 255) * frac >> 8);
}

/* A plane through three values; values and their differences fit 32 bits. */
void smear_plane_make(struct setup *s, struct plane *p, int32_t a0, int32_t a1, int32_t a2)
{
    int32_t d1 = sub_wrap(a1, a0), d2 = sub_wrap(a2, a0);
    p->dx = p->dy = 0;
    if ((d1 | d2) != 0 && !s->sliver) {
        p->dx = gradient(s, (int64_t)d1 * s->y2 - (int64_t)d2 * s->y1);
        p->dy = gradient(s, (int64_t)d2 * s->x1 - (int64_t)d1 * s->x2);
        const int32_t steep = 1 << 28;      /* a plane this steep has no exact pixels: thinner than 1/16 px */
        if (p->dx > steep || p->dx < -steep || p->dy > steep || p->dy < -steep) {
            p->dx = p->dy = 0;
            s->sliver = true;
        }
    }
    /* Pixel (x, y) whose centre is nearest to v[0] from below right, then back to the origin, wrapping. */
    int32_t x = s->v[0][VERTEX_X] >> 8, y = s->v[0][VERTEX_Y] >> 8;
    int32_t fx = 128 - (s->v[0][VERTEX_X] & 255), fy = 128 - (s->v[0][VERTEX_Y] & 255);
    int32_t here = add_wrap(a0, add_wrap(part_of(p->dx, fx), part_of(p->dy, fy)));
    p->at = sub_wrap(here, add_wrap(mul_wrap(p->dx, x), mul_wrap(p->dy, y)));
}

void smear_setup_area(struct setup *s, uint64_t area)
{
    s->area_zeros = count_leading_zeros_64(area);
    s->area_recip = recip_norm_precise((uint32_t)(area << s->area_zeros >> 32));
    s->sliver = false;
}

/* ------------------------------------------------------------------ depth */

void smear_setup_depth(struct setup *s)
{
    int32_t q0 = s->v[0][VERTEX_DEPTH], q1 = s->v[1][VERTEX_DEPTH], q2 = s->v[2][VERTEX_DEPTH];
    smear_plane_make(s, &s->depth, q0, q1, q2);
    int32_t low = min_i32(q0, min_i32(q1, q2)), high = max_i32(q0, max_i32(q1, q2));
    s->slope = high < SLOPE_BREAK ? SLOPE_FAR : low >= SLOPE_BREAK ? SLOPE_NEAR : SLOPE_BOTH;
}

/* ------------------------------------------------------------------ colour */

/* floor(a q / 2^15), a 16-bit. */
static inline int32_t times_q15(int32_t a, int32_t q)
{
    return a * (q >> 15) + (a * (q & 0x7fff) >> 15);
}

/* floor(a q / 2^16), a of 16 bits without sign. */
static inline int32_t times_q16(int32_t a, int32_t q)
{
    return a * (q >> 16) + (int32_t)((uint32_t)a * ((uint32_t)q & 0xffffu) >> 16);
}

void smear_setup_color(struct setup *s)
{
    s->perspective_color = false;
    if (s->segment->shade != SHADE_GOURAUD)
        return;
    int channels = s->draw->alpha == SMEAR_OPAQUE ? 3 : 4;
    int32_t q[3], low_q = INT32_MAX, high_q = 0, value[4][3];
    uint32_t range = 0;
    for (int i = 0; i < 3; i++) {
        q[i] = s->v[i][VERTEX_DEPTH];
        low_q = min_i32(low_q, q[i]);
        high_q = max_i32(high_q, q[i]);
    }
    for (int c = 0; c < channels; c++) {
        for (int i = 0; i < 3; i++)
            value[c][i] = channel_value(s, i, c);
        for (int i = 0; i < 3; i++)
            range = max_u32(range, magnitude_i32(value[c][i] - value[c][i == 2 ? 0 : i + 1]));
    }
    /* Interpolated on the screen, a value is off by at most range x change of 1/w / 4: half a code is allowed. */
    if (!s->segment->flat_depth && range != 0)
        s->perspective_color = smear_times_over((uint32_t)(high_q - low_q), range >> 8, (uint32_t)low_q)
                             > 4u * 128u;
    for (int c = 0; c < channels; c++) {
        for (int i = 0; i < 3 && s->perspective_color; i++)
            value[c][i] = times_q16(value[c][i] >> 8, q[i]);
        smear_plane_make(s, &s->channel[c], value[c][0], value[c][1], value[c][2]);
    }
}

/* ------------------------------------------------------------------ texture */

uint32_t smear_times_over(uint32_t a, uint32_t b, uint32_t c)
{
    int zeros = count_leading_zeros(c);
    uint32_t over = mulh_u32(a, recip_norm(c << zeros));        /* a / c 2^(29 - zeros) */
    uint64_t r = (uint64_t)over * b;
    int shift = 29 - zeros;
    r = shift >= 0 ? r >> shift : r << -shift;
    return r > UINT32_MAX ? UINT32_MAX : (uint32_t)r;
}

/* Least depth units at the corners of the part of the triangle's box that lies in the frame; may be negative. */
static int32_t least_depth_seen(const struct setup *s)
{
    int32_t x0 = INT32_MAX, x1 = INT32_MIN, y0 = INT32_MAX, y1 = INT32_MIN;
    for (int i = 0; i < 3; i++) {
        x0 = min_i32(x0, s->v[i][VERTEX_X]);
        x1 = max_i32(x1, s->v[i][VERTEX_X]);
        y0 = min_i32(y0, s->v[i][VERTEX_Y]);
        y1 = max_i32(y1, s->v[i][VERTEX_Y]);
    }
    x0 = max_i32(x0 >> 8, 0);
    y0 = max_i32(y0 >> 8, 0);
    x1 = min_i32(x1 >> 8, s->frame->width - 1);
    y1 = min_i32(y1 >> 8, s->frame->height - 1);
    return plane_at(&s->depth, s->depth.dx > 0 ? x0 : x1, s->depth.dy > 0 ? y0 : y1);
}

void smear_setup_texture(struct setup *s)
{
    const struct smear_sampler *t = &s->draw->sampler;
    int32_t u[3], v[3], q[3];
    int32_t low_q = INT32_MAX, high_q = 0;
    for (int i = 0; i < 3; i++) {
        u[i] = setup_mesh_u(s, i);
        v[i] = setup_mesh_v(s, i);
        q[i] = s->v[i][VERTEX_DEPTH];
        low_q = min_i32(low_q, q[i]);
        high_q = max_i32(high_q, q[i]);
    }

    /* Texels travelled over the triangle, and the relative change of 1/w: linear interpolation of a quotient over a
     * stretch is off by at most travel x change / 4 in its middle. */
    uint32_t travel = 0;
    for (int i = 0; i < 3; i++) {
        int j = i == 2 ? 0 : i + 1;
        uint32_t du = magnitude_i32(sampler_texel_u(t, (u[i] - u[j]) * 16384) >> 10);  /* q6 texels */
        uint32_t dv = magnitude_i32(sampler_texel_v(t, (v[i] - v[j]) * 16384) >> 10);
        travel = max_u32(travel, max_u32(du, dv));
    }
    /* Error in 1/64 texel; 1/16 texel is allowed, and 1/8 within a block. */
    uint32_t error = s->segment->flat_depth ? 0
                   : smear_times_over((uint32_t)(high_q - low_q), travel, (uint32_t)low_q) >> 2;
    s->perspective = error > 4;
    if (!s->perspective) {
        int32_t tu[3], tv[3];
        for (int i = 0; i < 3; i++) {
            tu[i] = sampler_texel_u(t, u[i] * 16384);
            tv[i] = sampler_texel_v(t, v[i] * 16384);
        }
        smear_plane_make(s, &s->u, tu[0], tu[1], tu[2]);
        smear_plane_make(s, &s->v_, tv[0], tv[1], tv[2]);
        s->block_shift = 4;
        return;
    }
    smear_plane_make(s, &s->u, times_q15(u[0], q[0]), times_q15(u[1], q[1]), times_q15(u[2], q[2]));
    smear_plane_make(s, &s->v_, times_q15(v[0], q[0]), times_q15(v[1], q[1]), times_q15(v[2], q[2]));

    /* Within a block of n pixels: n |du/dx| texels and n |dq/dx| / q. |du/dx| = |U' - u q'| / q, linear in u, so a
     * vertex bounds its upper part; q is least at a corner of what is seen of the triangle's box. */
    uint32_t seen_q = (uint32_t)max_i32(low_q, least_depth_seen(s));
    uint32_t slope_q = min_u32(magnitude_i32(s->depth.dx), 1u << 26);
    uint32_t worst = 0;             /* texels per pixel, q6 */
    for (int i = 0; i < 3; i++) {
        uint32_t ru = smear_times_over(magnitude_i32(sub_wrap(s->u.dx, times_q15(u[i], s->depth.dx))),
                                       1u << 16, seen_q);      /* q16 of 2^15 mesh units */
        uint32_t rv = smear_times_over(magnitude_i32(sub_wrap(s->v_.dx, times_q15(v[i], s->depth.dx))),
                                       1u << 16, seen_q);
        uint32_t tu = magnitude_i32(sampler_texel_u(t, (int32_t)min_u32(ru, 0xffffu) << 13) >> 10);
        uint32_t tv = magnitude_i32(sampler_texel_v(t, (int32_t)min_u32(rv, 0xffffu) << 13) >> 10);
        worst = max_u32(worst, max_u32(tu, tv));
    }
    uint32_t change = smear_times_over(slope_q << 4, 1u << 12, seen_q);     /* over 16 pixels, q12 */
    uint64_t off = ((uint64_t)worst << 4) * change >> 14;                   /* q6 texels */
    s->block_shift = off <= 8 ? 4 : off <= 32 ? 3 : 2;      /* the error falls with the square */
}

