/* SPDX-License-Identifier: MIT */
/* raster.c - triangle setup, exact edges, spans.
 *
 * Coverage. A pixel belongs to a triangle if its centre is inside, by the top-left rule. In row y an edge lies at
 * x(y) = x0 + (yc - y0) dx / dy, an exact fraction that is stepped with its remainder; pixels from ceil(left) to
 * ceil(right) - 1 are covered. Both triangles at an edge see the same fraction, so no pixel is drawn twice or
 * missed. Small triangles use edge functions instead, which say the same without a division.
 *
 * Attributes are planes over the screen, a + x dx + y dy in 32-bit wrapping arithmetic: exact modulo 2^32 wherever
 * one starts, so the picture does not depend on how the frame is cut into columns and bands.
 *
 * Perspective: u/w, v/w and 1/w are planes; the quotient is taken every 4, 8 or 16 pixels (by an error bound) at
 * multiples of that step, and interpolated between. */
#include "raster.h"

#include "fixmath.h"
#include "pixel.h"

struct plane {
    int32_t at;             /* at the centre of pixel (0, 0) of the frame, modulo 2^32 */
    int32_t dx, dy;
};

static inline int32_t plane_at(const struct plane *p, int32_t x, int32_t y)
{
    return add_wrap(p->at, add_wrap(mul_wrap(p->dx, x), mul_wrap(p->dy, y)));
}

enum { BLOCK_MAX = 16 };

enum depth_slope {          /* smear.h, smear_depth_units */
    SLOPE_FAR,              /* code = units */
    SLOPE_NEAR,             /* code = 32768 + (units - 32768) / 16 */
    SLOPE_BOTH
};
static const int32_t slope_break = 32768 << 11;     /* q11 */

enum span_kind { SPAN_FLAT, SPAN_TEXEL, SPAN_GENERAL };

struct setup {
    const struct smear_raster_frame *frame;
    const struct smear_raster_target *target;
    const struct smear_segment *segment;
    const struct smear_raster_draw *draw;
    const int32_t *v[3];            /* records, in the triangle's order */

    /* Edge vectors from v[0], q8, and 1 / (twice the area). */
    int32_t x1, y1, x2, y2;
    uint32_t area_recip;            /* 2^61 / normalised area */
    int area_zeros;                 /* area << zeros is normalised to 64 bits */
    bool area_negative;
    bool sliver;                    /* some gradient is out of range: attributes are constant */

    enum span_kind kind;
    enum depth_slope slope;
    struct plane depth;             /* units q11 */

    uint32_t color;                 /* 0xAARRGGBB: flat */
    struct plane channel[4];        /* SHADE_GOURAUD: r g b a, codes (or linear >> 8) in q16, + 1/2 */

    bool perspective;               /* texture: planes are u/w, v/w; else texels */
    uint8_t block_shift;            /* log2 of pixels between divisions */
    struct plane u, v_;

    uint8_t poses;                  /* velocity: 0 writes zero or nothing, 1 or 2 poses */
    bool writes_velocity;
    bool velocity_affine;
    bool clamp_velocity;
    struct plane vx, vy;            /* affine: displacement q18 px */
    struct plane px[2], py[2], ratio[2];    /* else: numerators and denominator per pose */
};

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
    return (n < 0) != s->area_negative ? -g : g;
}

/* (frac q8) x slope / 256, exact floor without a wide product. */
static inline int32_t part_of(int32_t slope, int32_t frac)
{
    return mul_wrap(slope >> 8, frac) + ((slope & 255) * frac >> 8);
}

/* A plane through three values; values and their differences fit 32 bits. */
static void plane_make(struct setup *s, struct plane *p, int32_t a0, int32_t a1, int32_t a2)
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

static void setup_edges(struct setup *s)
{
    s->x1 = s->v[1][VERTEX_X] - s->v[0][VERTEX_X];
    s->y1 = s->v[1][VERTEX_Y] - s->v[0][VERTEX_Y];
    s->x2 = s->v[2][VERTEX_X] - s->v[0][VERTEX_X];
    s->y2 = s->v[2][VERTEX_Y] - s->v[0][VERTEX_Y];
    int64_t area = (int64_t)s->x1 * s->y2 - (int64_t)s->x2 * s->y1;
    s->area_negative = area < 0;
    uint64_t size = area < 0 ? 0u - (uint64_t)area : (uint64_t)area;
    s->area_zeros = count_leading_zeros_64(size);
    s->area_recip = recip_norm_precise((uint32_t)(size << s->area_zeros >> 32));
    s->sliver = false;
}

/* ------------------------------------------------------------------ depth */

static void setup_depth(struct setup *s)
{
    int32_t q0 = s->v[0][VERTEX_DEPTH], q1 = s->v[1][VERTEX_DEPTH], q2 = s->v[2][VERTEX_DEPTH];
    plane_make(s, &s->depth, q0, q1, q2);
    int32_t low = min_i32(q0, min_i32(q1, q2)), high = max_i32(q0, max_i32(q1, q2));
    s->slope = high < slope_break ? SLOPE_FAR : low >= slope_break ? SLOPE_NEAR : SLOPE_BOTH;
}

/* Depth code in 16.16, rounding included, of units in q11; and how it steps. */
static inline uint32_t code_from_units(int32_t units, enum depth_slope slope)
{
    return slope == SLOPE_FAR ? ((uint32_t)units << 5) + 0x8000u
                              : ((uint32_t)units << 1) + (0x80000000u - 0x08000000u + 0x8000u);
}

static inline int32_t step_from_units(int32_t units, enum depth_slope slope)
{
    return shl_wrap(units, slope == SLOPE_FAR ? 5 : 1);
}

/* ------------------------------------------------------------------ colour */

static void setup_color(struct setup *s, uint32_t color)
{
    s->color = color;
    if (s->segment->shade != SHADE_GOURAUD)
        return;
    for (int c = 0; c < 4; c++) {
        int32_t a[3];
        for (int i = 0; i < 3; i++) {
            uint32_t word = (uint32_t)s->v[i][s->segment->color + (c >> 1)];
            a[i] = (int32_t)((c & 1 ? word >> 16 : word & 0xffffu) << 8);
            /* Codes are rounded by 1/2; linear light is looked up by its floor. Both keep a margin from 0 and
             * 256 that rounding errors of the plane do not cross. */
            a[i] = s->frame->linear && c < 3 ? clamp_i32(a[i], 0x400, 0xffe000)
                                             : min_i32(a[i] + 0x8000, 0xff8000);
        }
        if (c == 3 && s->draw->alpha == SMEAR_OPAQUE)
            break;
        plane_make(s, &s->channel[c], a[0], a[1], a[2]);
    }
}

/* ------------------------------------------------------------------ texture */

static inline int32_t mesh_u(const struct setup *s, int i)
{
    return (int16_t)(s->v[i][s->segment->uv] & 0xffff);
}

static inline int32_t mesh_v(const struct setup *s, int i)
{
    return s->v[i][s->segment->uv] >> 16;
}

/* floor(a q / 2^15), a 16-bit. */
static inline int32_t times_q15(int32_t a, int32_t q)
{
    return a * (q >> 15) + (a * (q & 0x7fff) >> 15);
}

static uint32_t magnitude(int32_t a)
{
    return a < 0 ? 0u - (uint32_t)a : (uint32_t)a;
}

/* a b / c for 0 <= a, b and c > 0, by reciprocal; clamped. Good to 2^-18, for bounds. */
static uint32_t times_over(uint32_t a, uint32_t b, uint32_t c)
{
    int zeros = count_leading_zeros(c);
    uint32_t over = mulh_u32(a, recip_norm(c << zeros));        /* a / c 2^(29 - zeros) */
    uint64_t r = (uint64_t)over * b;
    int shift = 29 - zeros;
    r = shift >= 0 ? r >> shift : r << -shift;
    return r > UINT32_MAX ? UINT32_MAX : (uint32_t)r;
}

static void setup_texture(struct setup *s)
{
    const struct smear_sampler *t = &s->draw->sampler;
    int32_t u[3], v[3], q[3];
    int32_t low_q = INT32_MAX, high_q = 0;
    for (int i = 0; i < 3; i++) {
        u[i] = mesh_u(s, i);
        v[i] = mesh_v(s, i);
        q[i] = s->v[i][VERTEX_DEPTH];
        low_q = min_i32(low_q, q[i]);
        high_q = max_i32(high_q, q[i]);
    }

    /* Texels travelled over the triangle, and the relative change of 1/w: linear interpolation of a quotient over a
     * stretch is off by at most travel x change / 4 in its middle. */
    uint32_t travel = 0;
    for (int i = 0; i < 3; i++) {
        int j = i == 2 ? 0 : i + 1;
        uint32_t du = magnitude(sampler_texel_u(t, (u[i] - u[j]) * 16384) >> 10);  /* q6 texels */
        uint32_t dv = magnitude(sampler_texel_v(t, (v[i] - v[j]) * 16384) >> 10);
        travel = max_u32(travel, max_u32(du, dv));
    }
    /* Error in 1/64 texel; 1/16 texel is allowed. */
    uint32_t error = s->segment->flat_depth ? 0
                   : times_over((uint32_t)(high_q - low_q), travel, (uint32_t)low_q) >> 2;
    s->perspective = error > 4;
    if (!s->perspective) {
        int32_t tu[3], tv[3];
        for (int i = 0; i < 3; i++) {
            tu[i] = sampler_texel_u(t, u[i] * 16384);
            tv[i] = sampler_texel_v(t, v[i] * 16384);
        }
        plane_make(s, &s->u, tu[0], tu[1], tu[2]);
        plane_make(s, &s->v_, tv[0], tv[1], tv[2]);
        s->block_shift = 4;
        return;
    }
    plane_make(s, &s->u, times_q15(u[0], q[0]), times_q15(u[1], q[1]), times_q15(u[2], q[2]));
    plane_make(s, &s->v_, times_q15(v[0], q[0]), times_q15(v[1], q[1]), times_q15(v[2], q[2]));

    /* Over n pixels: n |du/dx| texels and n |dq/dx| / q, both largest where q is smallest. |du/dx| there is at
     * most (|U'| + |u| |q'|) / q in ratio; in q29 x pixels it is scaled like any ratio. */
    uint32_t slope_q = min_u32(magnitude(s->depth.dx), 1u << 27);
    s->block_shift = 4;
    for (; s->block_shift > 2; s->block_shift--) {
        uint32_t change = times_over(slope_q << s->block_shift, 1u << 12, (uint32_t)low_q);   /* q12 */
        uint32_t worst = 0;
        for (int i = 0; i < 3; i++) {
            uint32_t ru = times_over(magnitude(s->u.dx - times_q15(u[i], s->depth.dx)), 1u << 16,
                                     (uint32_t)q[i]);       /* ratio per pixel, q16 of 2^15 mesh units */
            uint32_t rv = times_over(magnitude(s->v_.dx - times_q15(v[i], s->depth.dx)), 1u << 16,
                                     (uint32_t)q[i]);
            uint32_t tu = magnitude(sampler_texel_u(t, (int32_t)min_u32(ru, 0xffffu) << 13) >> 10);
            uint32_t tv = magnitude(sampler_texel_v(t, (int32_t)min_u32(rv, 0xffffu) << 13) >> 10);
            worst = max_u32(worst, max_u32(tu, tv));        /* texels per pixel, q6 */
        }
        uint64_t off = ((uint64_t)worst << s->block_shift) * change >> 14;      /* q6 texels */
        if (off <= 4)
            break;
    }
}

/* ------------------------------------------------------------------ velocity */

static void setup_velocity(struct setup *s)
{
    const struct smear_segment *g = s->segment;
    const struct smear_raster_target *t = s->target;
    s->poses = g->moves;
    s->writes_velocity = (t->velocity8 != NULL || t->velocity16 != NULL)
                      && s->draw->alpha != SMEAR_BLEND;
    if (!s->writes_velocity || s->poses == 0)
        return;

    /* Displacement close - open (or now - before) per vertex, q8; and how much depths change between the poses. */
    int32_t dx[3], dy[3];
    uint32_t longest = 0, low = UINT32_MAX, high = 0;
    int32_t far_x = 0;
    for (int i = 0; i < 3; i++) {
        const int32_t *open = s->v[i] + g->motion;
        dx[i] = -open[MOTION_DX];
        dy[i] = -open[MOTION_DY];
        low = min_u32(low, (uint32_t)open[MOTION_RATIO]);
        high = max_u32(high, (uint32_t)open[MOTION_RATIO]);
        if (s->poses == 2) {
            const int32_t *close = open + MOTION_WORDS;
            dx[i] += close[MOTION_DX];
            dy[i] += close[MOTION_DY];
            low = min_u32(low, (uint32_t)close[MOTION_RATIO]);
            high = max_u32(high, (uint32_t)close[MOTION_RATIO]);
        }
        longest = max_u32(longest, magnitude(dx[i]) + magnitude(dy[i]));
        far_x = max_i32(far_x, (int32_t)max_u32(magnitude(s->v[i][VERTEX_X] - s->v[0][VERTEX_X]),
                                                magnitude(s->v[i][VERTEX_Y] - s->v[0][VERTEX_Y])));
    }
    /* Half the exposure's displacement in 1/8 px against the reach: |dx| + |dy| bounds the length. */
    s->clamp_velocity = (uint64_t)longest * (uint32_t)s->frame->velocity_scale >> 21
                      >= (uint32_t)s->frame->reach_q3;

    /* Interpolating displacements on the screen is off by at most (size + displacement) x change / 4. */
    uint32_t size = (uint32_t)far_x + longest;
    uint32_t error = times_over(size, high - low, low) >> 2;
    s->velocity_affine = error <= 8;            /* 1/32 px */
    if (s->velocity_affine) {
        const int32_t limit = (1 << 20) - 1;
        for (int i = 0; i < 3; i++) {
            dx[i] = clamp_i32(dx[i], -limit, limit) * 1024;
            dy[i] = clamp_i32(dy[i], -limit, limit) * 1024;
        }
        plane_make(s, &s->vx, dx[0], dx[1], dx[2]);
        plane_make(s, &s->vy, dy[0], dy[1], dy[2]);
        return;
    }
    /* A surface point's place in a pose is sum(b r X) / sum(b r): b screen weights, r = w_pose / w_now. Places are
     * taken from v[0], in q8; ratios are scaled to 2^16 at the largest so that products stay in 31 bits. */
    int down = 0;
    while (high >> down > 0xffff)
        down++;
    for (int pose = 0; pose < s->poses; pose++) {
        int32_t x[3], y[3], r[3];
        for (int i = 0; i < 3; i++) {
            const int32_t *m = s->v[i] + g->motion + pose * MOTION_WORDS;
            int32_t ratio = max_i32(m[MOTION_RATIO] >> down, 1);
            int32_t px = clamp_i32(s->v[i][VERTEX_X] - s->v[0][VERTEX_X] + m[MOTION_DX],
                                   -(1 << 21), 1 << 21);
            int32_t py = clamp_i32(s->v[i][VERTEX_Y] - s->v[0][VERTEX_Y] + m[MOTION_DY],
                                   -(1 << 21), 1 << 21);
            x[i] = (int32_t)((int64_t)px * ratio >> 7);         /* q8 2^16 / 2^7: 30 bits */
            y[i] = (int32_t)((int64_t)py * ratio >> 7);
            r[i] = ratio << 13;                                 /* 29 bits */
        }
        plane_make(s, &s->px[pose], x[0], x[1], x[2]);
        plane_make(s, &s->py[pose], y[0], y[1], y[2]);
        plane_make(s, &s->ratio[pose], r[0], r[1], r[2]);
    }
}

/* Place in a pose, relative to v[0], q8: 2^20 n / d of the planes above. */
static void pose_place(const struct setup *s, int pose, int32_t x, int32_t y, int32_t out[2])
{
    uint32_t d = (uint32_t)max_i32(plane_at(&s->ratio[pose], x, y), 1);
    int zeros = count_leading_zeros(d);
    uint32_t r = recip_norm(d << zeros);
    /* n r / 2^32 = n / d 2^(29 - zeros). */
    out[0] = scale_sat(mulh_i32(plane_at(&s->px[pose], x, y), (int32_t)r), zeros - 9);
    out[1] = scale_sat(mulh_i32(plane_at(&s->py[pose], x, y), (int32_t)r), zeros - 9);
}

/* Displacement between the poses at a pixel, q8 px. */
static void displacement_at(const struct setup *s, int32_t x, int32_t y, int32_t out[2])
{
    if (s->velocity_affine) {
        out[0] = (plane_at(&s->vx, x, y) + 512) >> 10;
        out[1] = (plane_at(&s->vy, x, y) + 512) >> 10;
        return;
    }
    int32_t open[2], close[2];
    pose_place(s, 0, x, y, open);
    if (s->poses == 2) {
        pose_place(s, 1, x, y, close);
    } else {
        close[0] = x * 256 + 128 - s->v[0][VERTEX_X];
        close[1] = y * 256 + 128 - s->v[0][VERTEX_Y];
    }
    out[0] = clamp_i32(sub_wrap(close[0], open[0]), -(1 << 22), 1 << 22);
    out[1] = clamp_i32(sub_wrap(close[1], open[1]), -(1 << 22), 1 << 22);
}

/* Half the exposure's displacement, q16 px, no longer than the reach: the direction is kept. */
static void stored_velocity(const struct setup *s, const int32_t displacement[2], int32_t out[2])
{
    int32_t k = s->frame->velocity_scale;
    int64_t hx = ((int64_t)displacement[0] * k) >> 8, hy = ((int64_t)displacement[1] * k) >> 8;
    int32_t x = narrow_sat(hx), y = narrow_sat(hy);
    if (s->clamp_velocity) {
        /* Lengths in 1/16 px up to 2^15: squares fit. */
        int32_t sx = clamp_i32(x >> 12, -0x7fff, 0x7fff), sy = clamp_i32(y >> 12, -0x7fff, 0x7fff);
        uint32_t square = (uint32_t)(sx * sx) + (uint32_t)(sy * sy);
        uint32_t reach = (uint32_t)s->frame->reach_q3 * 2u;
        if (square > reach * reach) {
            uint32_t length = sqrt_floor_64((uint64_t)square << 8);     /* 1/256 px */
            int zeros = count_leading_zeros(length);
            uint32_t r = recip_norm(length << zeros);
            /* reach 2^16 r / 2^32 = reach / length 2^(45 - zeros), in 1/16 over 1/256 px; q16 is wanted. */
            int32_t factor = (int32_t)(mulh_u32(reach << 16, r) >> (25 - zeros));
            x = (int32_t)((int64_t)x * factor >> 16);
            y = (int32_t)((int64_t)y * factor >> 16);
        }
    }
    out[0] = x;
    out[1] = y;
}

/* ------------------------------------------------------------------ spans */

/* Pixels [a, b) of row y, a piece of the triangle's whole span [left, right). */
struct span {
    int32_t a, b, left, right, y;
    uint32_t *color;            /* of pixel a */
    uint16_t *depth;
    int32_t at;                 /* index of pixel a in the window's planes */
    uint32_t z;                 /* code 16.16 of pixel a */
    int32_t dz;
};

static inline void velocity_write(const struct smear_raster_target *t, int32_t at, int32_t x, int32_t y)
{
    if (t->velocity8 != NULL) {
        t->velocity8[2 * at] = (int8_t)x;
        t->velocity8[2 * at + 1] = (int8_t)y;
    } else {
        t->velocity16[2 * at] = (int16_t)x;
        t->velocity16[2 * at + 1] = (int16_t)y;
    }
}

/* Writes velocities where the span passes the depth test; depth itself is written with the colour. */
static void span_velocity(const struct setup *s, const struct span *p)
{
    const struct smear_raster_target *t = s->target;
    const uint16_t *depth = p->depth;
    uint32_t z = p->z;
    if (s->poses == 0) {
        for (int32_t x = p->a, at = p->at; x < p->b; x++, at++, depth++, z += (uint32_t)p->dz) {
            if (z >> 16 > *depth) {
                velocity_write(t, at, 0, 0);
                if (t->inspect != NULL)
                    t->inspect[2 * at] = t->inspect[2 * at + 1] = 0;
            }
        }
        return;
    }
    /* Exact at multiples of 8 and at the span's ends; linear between. */
    const int32_t inverse[9] = { 0, 65536, 32768, 21845, 16384, 13107, 10922, 9362, 8192 };
    int32_t x = p->a, at = p->at;
    int32_t here[2], next[2], stored[2], stored_next[2];
    displacement_at(s, x, p->y, here);
    stored_velocity(s, here, stored);
    while (x < p->b) {
        int32_t end = min_i32((x & ~7) + 8, p->right - 1), n = end - x, step[2] = { 0, 0 }, wide[2] = { 0, 0 };
        if (n > 0) {
            displacement_at(s, end, p->y, next);
            stored_velocity(s, next, stored_next);
            for (int i = 0; i < 2; i++) {
                step[i] = (int32_t)((int64_t)(stored_next[i] - stored[i]) * inverse[n] >> 16);
                wide[i] = (int32_t)((int64_t)(next[i] - here[i]) * inverse[n] >> 16);
            }
        }
        int32_t stop = min_i32(n > 0 ? end : x + 1, p->b);
        int32_t vx = stored[0], vy = stored[1], ix = here[0], iy = here[1];
        for (; x < stop; x++, at++, depth++, z += (uint32_t)p->dz) {
            if (z >> 16 > *depth) {
                velocity_write(t, at, (vx + 0x1000) >> 13, (vy + 0x1000) >> 13);
                if (t->inspect != NULL) {
                    t->inspect[2 * at] = (int32_t)((int64_t)ix * s->frame->inspect_scale >> 16);
                    t->inspect[2 * at + 1] = (int32_t)((int64_t)iy * s->frame->inspect_scale >> 16);
                }
            }
            vx += step[0];
            vy += step[1];
            ix += wide[0];
            iy += wide[1];
        }
        for (int i = 0; i < 2 && n > 0; i++) {
            here[i] = next[i];
            stored[i] = stored_next[i];
        }
    }
    /* Marks the tiles: their maximum must be looked for. */
    for (int32_t tile = p->a >> t->tile_shift; tile <= (p->b - 1) >> t->tile_shift; tile++)
        t->moving[tile] = 1;
}

static void span_flat(const struct setup *s, const struct span *p)
{
    uint32_t *color = p->color, *end = color + (p->b - p->a);
    uint16_t *depth = p->depth;
    uint32_t z = p->z, c = s->color & 0xffffffu;
    int32_t dz = p->dz;
    do {
        uint32_t code = z >> 16;
        if (code > *depth) {
            *depth = (uint16_t)code;
            *color = c;
        }
        z += (uint32_t)dz;
        depth++;
    } while (++color != end);
}

/* Texture coordinates at a pixel, texels q16. */
static inline void texel_at(const struct setup *s, int32_t x, int32_t y, int32_t out[2])
{
    if (!s->perspective) {
        out[0] = plane_at(&s->u, x, y);
        out[1] = plane_at(&s->v_, x, y);
        return;
    }
    uint32_t q = (uint32_t)max_i32(plane_at(&s->depth, x, y), 1);
    int zeros = count_leading_zeros(q);
    uint32_t r = recip_norm(q << zeros);                    /* 1/q = r 2^(zeros - 61) */
    /* U 2^(zeros - 1) fits 32 bits since |U| <= q (and one step more by rounding): ratio q29 up to a factor 2. */
    int32_t u = mulh_i32(shl_wrap(plane_at(&s->u, x, y), zeros - 2), (int32_t)r);
    int32_t v = mulh_i32(shl_wrap(plane_at(&s->v_, x, y), zeros - 2), (int32_t)r);
    out[0] = sampler_texel_u(&s->draw->sampler, shl_wrap(u, 2));
    out[1] = sampler_texel_v(&s->draw->sampler, shl_wrap(v, 2));
}

/* Texture coordinates along a span, in blocks of at most 16 pixels. Blocks start at multiples of their size or at the
 * triangle's first pixel, never at a cut of the frame: cuts must not show. */
struct walk {
    int32_t x;              /* next pixel */
    int32_t here[2];        /* texels at pixel `x` */
    int32_t next[2];        /* texels after the block */
    int32_t step[2];
};

static inline void walk_start(struct walk *w, const struct setup *s, const struct span *p)
{
    w->x = s->perspective ? max_i32(p->left, p->a & -(1 << s->block_shift)) : p->a;
    texel_at(s, w->x, p->y, w->here);
}

/* Fits the block that begins at `x`; returns how many of its pixels, from p->a on, are to be drawn. */
static inline int32_t walk_block(struct walk *w, const struct setup *s, const struct span *p)
{
    static const int32_t inverse[17] = {    /* 2^30 / n */
        0, 1 << 30, 1 << 29, 357913941, 1 << 28, 214748365, 178956971, 153391689, 1 << 27,
        119304647, 107374182, 97612893, 89478485, 82595525, 76695845, 71582788, 1 << 26
    };
    int32_t size = 1 << s->block_shift, n;
    if (!s->perspective) {
        w->step[0] = s->u.dx;
        w->step[1] = s->v_.dx;
        n = min_i32(size, p->b - w->x);
        w->next[0] = add_wrap(w->here[0], mul_wrap(w->step[0], n));
        w->next[1] = add_wrap(w->here[1], mul_wrap(w->step[1], n));
        w->x += n;
        return n;
    }
    int32_t start = w->x, end = min_i32((start & -size) + size, p->right - 1);
    n = end - start;
    if (n <= 0) {           /* the triangle's last pixel */
        w->step[0] = w->step[1] = 0;
        w->next[0] = w->here[0];
        w->next[1] = w->here[1];
        w->x = start + 1;
        return 1;
    }
    texel_at(s, end, p->y, w->next);
    for (int i = 0; i < 2; i++) {
        int32_t d = sub_wrap(w->next[i], w->here[i]);
        w->step[i] = n == size ? d >> s->block_shift : mulh_i32(d, inverse[n]) * 4;
    }
    if (start < p->a) {     /* the block began left of a cut */
        int32_t cut = p->a - start;
        w->here[0] = add_wrap(w->here[0], mul_wrap(w->step[0], cut));
        w->here[1] = add_wrap(w->here[1], mul_wrap(w->step[1], cut));
        start = p->a;
    }
    w->x = end;
    return min_i32(end, p->b) - start;
}

/* Unlit opaque texels, nearest, repeated, sizes powers of two, 32-bit: the plain case, in one loop. */
static void span_texel(const struct setup *s, const struct span *p)
{
    const struct smear_sampler *t = &s->draw->sampler;
    const uint32_t *texels = t->texels;
    uint32_t mask_u = t->mask_u, mask_v = t->mask_v;
    int down = 16 - t->log2_width;
    uint32_t *color = p->color;
    uint16_t *depth = p->depth;
    uint32_t z = p->z;
    int32_t dz = p->dz;
    struct walk w;
    walk_start(&w, s, p);
    while (w.x < p->b) {
        int32_t n = walk_block(&w, s, p);
        if (n <= 0) {
            w.here[0] = w.next[0];
            w.here[1] = w.next[1];
            continue;
        }
        uint32_t u = (uint32_t)w.here[0], v = (uint32_t)w.here[1];
        uint32_t du = (uint32_t)w.step[0], dv = (uint32_t)w.step[1];
        uint32_t *end = color + n;
        do {
            uint32_t code = z >> 16;
            if (code > *depth) {
                *depth = (uint16_t)code;
                *color = texels[(v >> down & mask_v) | (u >> 16 & mask_u)];
            }
            z += (uint32_t)dz;
            u += du;
            v += dv;
            depth++;
        } while (++color != end);
        w.here[0] = w.next[0];
        w.here[1] = w.next[1];
    }
}

/* Multiplies n texels by the light of the triangle: flat, or interpolated from pixel x on. */
static void modulate(uint32_t *texel, const struct setup *s, int32_t x, int32_t y, int32_t n)
{
    bool linear = s->frame->linear;
    if (s->segment->shade == SHADE_FLAT) {
        uint32_t r = pixel_red(s->color), g = pixel_green(s->color), b = pixel_blue(s->color);
        uint32_t a = pixel_alpha(s->color);
        if (linear) {
            r = smear_srgb_decode[r];
            g = smear_srgb_decode[g];
            b = smear_srgb_decode[b];
        }
        for (; n > 0; n--, texel++) {
            uint32_t t = *texel;
            *texel = linear ? pixel_make(code_times(pixel_alpha(t), a),
                                         code_times_linear(pixel_red(t), r),
                                         code_times_linear(pixel_green(t), g),
                                         code_times_linear(pixel_blue(t), b))
                            : pixel_make(code_times(pixel_alpha(t), a), code_times(pixel_red(t), r),
                                         code_times(pixel_green(t), g), code_times(pixel_blue(t), b));
        }
        return;
    }
    uint32_t c[3], d[3], a = 255u << 16, da = 0;
    for (int i = 0; i < 3; i++) {
        c[i] = (uint32_t)plane_at(&s->channel[i], x, y);
        d[i] = (uint32_t)s->channel[i].dx;
    }
    if (s->draw->alpha != SMEAR_OPAQUE) {
        a = (uint32_t)plane_at(&s->channel[3], x, y);
        da = (uint32_t)s->channel[3].dx;
    }
    for (; n > 0; n--, texel++) {
        uint32_t t = *texel;
        *texel = linear ? pixel_make(code_times(pixel_alpha(t), a >> 16 & 255u),
                                     code_times_linear(pixel_red(t), c[0] >> 8 & 0xffffu),
                                     code_times_linear(pixel_green(t), c[1] >> 8 & 0xffffu),
                                     code_times_linear(pixel_blue(t), c[2] >> 8 & 0xffffu))
                        : pixel_make(code_times(pixel_alpha(t), a >> 16 & 255u),
                                     code_times(pixel_red(t), c[0] >> 16 & 255u),
                                     code_times(pixel_green(t), c[1] >> 16 & 255u),
                                     code_times(pixel_blue(t), c[2] >> 16 & 255u));
        for (int i = 0; i < 3; i++)
            c[i] += d[i];
        a += da;
    }
}

/* Interpolated colours without a texture. */
static void shade_plain(uint32_t *out, const struct setup *s, int32_t x, int32_t y, int32_t n)
{
    uint32_t r = (uint32_t)plane_at(&s->channel[0], x, y), dr = (uint32_t)s->channel[0].dx;
    uint32_t g = (uint32_t)plane_at(&s->channel[1], x, y), dg = (uint32_t)s->channel[1].dx;
    uint32_t b = (uint32_t)plane_at(&s->channel[2], x, y), db = (uint32_t)s->channel[2].dx;
    uint32_t a = 255u << 16, da = 0;
    if (s->draw->alpha != SMEAR_OPAQUE) {
        a = (uint32_t)plane_at(&s->channel[3], x, y);
        da = (uint32_t)s->channel[3].dx;
    }
    if (s->frame->linear) {
        for (; n > 0; n--, r += dr, g += dg, b += db, a += da)
            *out++ = pixel_make(a >> 16 & 255u, smear_srgb_encode[r >> 12 & 4095u],
                                smear_srgb_encode[g >> 12 & 4095u], smear_srgb_encode[b >> 12 & 4095u]);
    } else {
        for (; n > 0; n--, r += dr, g += dg, b += db, a += da)
            *out++ = (a << 8 & 0xff000000u) | (r & 0xff0000u) | (g >> 8 & 0xff00u) | (b >> 16 & 255u);
    }
}

/* Writes a block of colours: depth test, cutout, blend. */
static void write_block(const uint32_t *in, uint32_t *color, uint16_t *depth, uint32_t z, int32_t dz,
                        int32_t n, const struct setup *s)
{
    uint32_t cutoff = s->draw->alpha == SMEAR_CUTOUT ? s->draw->cutoff : 0;
    if (s->draw->alpha == SMEAR_BLEND) {
        for (; n > 0; n--, in++, color++, depth++, z += (uint32_t)dz)
            if (z >> 16 > *depth)
                *color = pixel_blend(*color, *in, pixel_alpha(*in), s->frame->linear);
        return;
    }
    for (; n > 0; n--, in++, color++, depth++, z += (uint32_t)dz) {
        uint32_t code = z >> 16;
        if (code > *depth && pixel_alpha(*in) >= cutoff) {
            *depth = (uint16_t)code;
            *color = *in & 0xffffffu;
        }
    }
}

/* Everything else, in blocks: texels, then light, then the write. */
static void span_general(const struct setup *s, const struct span *p)
{
    uint32_t block[BLOCK_MAX];
    uint32_t *color = p->color;
    uint16_t *depth = p->depth;
    uint32_t z = p->z;
    bool textured = s->segment->uv != 0;
    struct walk w = { .x = p->a };
    int32_t x = p->a;
    if (textured)
        walk_start(&w, s, p);
    while (x < p->b) {
        int32_t n;
        if (textured) {
            n = walk_block(&w, s, p);
            if (n > 0) {
                smear_sample(block, &s->draw->sampler, w.here[0], w.here[1], w.step[0], w.step[1], n);
                if (s->segment->shade != SHADE_NONE)
                    modulate(block, s, x, p->y, n);
            }
            w.here[0] = w.next[0];
            w.here[1] = w.next[1];
            if (n <= 0)
                continue;
        } else {
            n = min_i32(BLOCK_MAX, p->b - x);
            if (s->segment->shade == SHADE_GOURAUD)
                shade_plain(block, s, x, p->y, n);
            else
                for (int32_t i = 0; i < n; i++)
                    block[i] = s->color;
        }
        write_block(block, color, depth, z, p->dz, n, s);
        x += n;
        color += n;
        depth += n;
        z += (uint32_t)p->dz * (uint32_t)n;
    }
}

static inline int32_t row_start(const struct smear_plane_rows *rows, int32_t y, int32_t y0)
{
    int32_t slot = rows->slot0 + (y - y0);
    if (slot >= rows->ring)
        slot -= rows->ring;
    return slot * rows->stride - rows->x0;
}

/* The part of [left, right) in row y that lies in one slope of the depth code and within the target's columns. */
static void draw_piece(const struct setup *s, struct span *p, int32_t a, int32_t b,
                       enum depth_slope slope, int32_t units, int32_t color_row, int32_t window_row)
{
    const struct smear_raster_target *t = s->target;
    p->a = a;
    p->b = b;
    p->color = t->color + color_row + a;
    p->at = window_row + a;
    p->depth = t->depth + p->at;
    p->z = code_from_units(units, slope);
    p->dz = step_from_units(s->depth.dx, slope);
    if (s->writes_velocity)
        span_velocity(s, p);
    if (s->kind == SPAN_FLAT)
        span_flat(s, p);
    else if (s->kind == SPAN_TEXEL)
        span_texel(s, p);
    else
        span_general(s, p);
}

static void draw_span(const struct setup *s, int32_t left, int32_t right, int32_t y)
{
    const struct smear_raster_target *t = s->target;
    int32_t a = max_i32(left, t->x0), b = min_i32(right, t->x1);
    if (a >= b)
        return;
    struct span p = { .left = left, .right = right, .y = y };
    int32_t color_row = row_start(&t->color_rows, y, t->y0);
    int32_t window_row = row_start(&t->window_rows, y, t->y0);
    int32_t units = plane_at(&s->depth, a, y);
    enum depth_slope slope = s->slope;
    if (slope == SLOPE_BOTH) {
        int32_t last = add_wrap(units, mul_wrap(s->depth.dx, b - 1 - a));
        slope = units < slope_break ? SLOPE_FAR : SLOPE_NEAR;
        if ((last < slope_break) != (units < slope_break)) {
            /* The code bends within the span: find the first pixel beyond, draw two pieces. */
            int32_t d = s->depth.dx, bend = a;
            int32_t n = d > 0 ? (slope_break - units + d - 1) / d : (units - slope_break) / -d + 1;
            bend += clamp_i32(n, 1, b - 1 - a);
            draw_piece(s, &p, a, bend, slope, units, color_row, window_row);
            units = plane_at(&s->depth, bend, y);
            slope = slope == SLOPE_FAR ? SLOPE_NEAR : SLOPE_FAR;
            a = bend;
        }
    }
    draw_piece(s, &p, a, b, slope, units, color_row, window_row);
}

/* ------------------------------------------------------------------ coverage */

/* First pixel at or right of an edge, row by row: ceil((x - 1/2 px) / 1 px) of the exact fraction. */
struct edge_walk {
    int32_t x;              /* q8, floor of the edge's place at this row's centres */
    int32_t rest;           /* and what is left of it, in 1/dy: 0 <= rest < dy */
    int32_t step, step_rest;
    int32_t dy;
};

/* From a down to b (b below a), starting at pixel row y, whose centre lies at or below a. */
static void edge_start(struct edge_walk *e, const int32_t *a, const int32_t *b, int32_t y)
{
    int32_t dx = b[VERTEX_X] - a[VERTEX_X];
    e->dy = b[VERTEX_Y] - a[VERTEX_Y];
    e->step = divide_floor(dx * 256, e->dy, &e->step_rest);     /* |dx| <= 2^20 */
    int32_t first = (a[VERTEX_Y] + 127) >> 8;                   /* first row below a */
    int32_t down = first * 256 + 128 - a[VERTEX_Y];            /* 0 .. 255 */
    e->x = a[VERTEX_X] + divide_floor(dx * down, e->dy, &e->rest);
    uint32_t rows = (uint32_t)(y - first);
    if (rows != 0) {        /* rows < 2^11, rest < 2^20: the sum fits */
        uint32_t rest = (uint32_t)e->rest + rows * (uint32_t)e->step_rest;
        e->x += e->step * (int32_t)rows + (int32_t)(rest / (uint32_t)e->dy);
        e->rest = (int32_t)(rest % (uint32_t)e->dy);
    }
}

static inline int32_t edge_pixel(const struct edge_walk *e)
{
    return (e->x + 127 + (e->rest > 0)) >> 8;
}

static inline void edge_step(struct edge_walk *e)
{
    e->x += e->step;
    e->rest += e->step_rest;
    if (e->rest >= e->dy) {
        e->rest -= e->dy;
        e->x++;
    }
}

static void cover_large(const struct setup *s)
{
    const struct smear_raster_target *t = s->target;
    const int32_t *top = s->v[0], *middle = s->v[1], *bottom = s->v[2], *swap;
    if (middle[VERTEX_Y] < top[VERTEX_Y]) { swap = top; top = middle; middle = swap; }
    if (bottom[VERTEX_Y] < middle[VERTEX_Y]) { swap = middle; middle = bottom; bottom = swap; }
    if (middle[VERTEX_Y] < top[VERTEX_Y]) { swap = top; top = middle; middle = swap; }

    int32_t y = max_i32((top[VERTEX_Y] + 127) >> 8, t->y0);
    int32_t end = min_i32((bottom[VERTEX_Y] + 127) >> 8, t->y1);
    int32_t knee = (middle[VERTEX_Y] + 127) >> 8;
    if (y >= end)
        return;
    struct edge_walk whole, part;
    edge_start(&whole, top, bottom, y);
    /* Where the middle vertex lies, seen from the long edge, decides which side is left. */
    int64_t side = (int64_t)(middle[VERTEX_X] - top[VERTEX_X]) * (bottom[VERTEX_Y] - top[VERTEX_Y])
                 - (int64_t)(bottom[VERTEX_X] - top[VERTEX_X]) * (middle[VERTEX_Y] - top[VERTEX_Y]);
    for (int half = 0; half < 2; half++) {
        int32_t stop = half == 0 ? min_i32(knee, end) : end;
        if (y >= stop)
            continue;
        edge_start(&part, half == 0 ? top : middle, half == 0 ? middle : bottom, y);
        for (; y < stop; y++) {
            int32_t a = edge_pixel(&whole), b = edge_pixel(&part);
            if (side > 0)
                draw_span(s, a, b, y);
            else
                draw_span(s, b, a, y);
            edge_step(&whole);
            edge_step(&part);
        }
    }
}

/* Boxes of at most 8 x 8 pixels: edge functions, exact in 32 bits because no edge is longer than 9 px. */
enum { SMALL_PX = 8 };

static void cover_small(const struct setup *s, int32_t left, int32_t right, int32_t top, int32_t bottom)
{
    int32_t value[3], step_x[3], step_y[3];
    int32_t cx = left * 256 + 128, cy = top * 256 + 128;
    for (int i = 0; i < 3; i++) {
        /* Inside is >= 0 when the triangle is walked with the interior on its left (y down: clockwise). */
        const int32_t *a = s->v[i], *b = s->v[i == 2 ? 0 : i + 1];
        if (s->area_negative) {
            const int32_t *swap = a;
            a = b;
            b = swap;
        }
        int32_t dx = b[VERTEX_X] - a[VERTEX_X], dy = b[VERTEX_Y] - a[VERTEX_Y];
        value[i] = dx * (cy - a[VERTEX_Y]) - dy * (cx - a[VERTEX_X]);
        /* A centre on an edge counts for left edges (going up) and top edges (going right). */
        if (!(dy < 0 || (dy == 0 && dx > 0)))
            value[i]--;
        step_x[i] = -dy * 256;
        step_y[i] = dx * 256;
    }
    for (int32_t y = top; y < bottom; y++) {
        int32_t e0 = value[0], e1 = value[1], e2 = value[2], x = left;
        while (x < right && (e0 | e1 | e2) < 0) {
            e0 += step_x[0];
            e1 += step_x[1];
            e2 += step_x[2];
            x++;
        }
        int32_t first = x;
        while (x < right && (e0 | e1 | e2) >= 0) {
            e0 += step_x[0];
            e1 += step_x[1];
            e2 += step_x[2];
            x++;
        }
        if (x > first)
            draw_span(s, first, x, y);
        for (int i = 0; i < 3; i++)
            value[i] += step_y[i];
    }
}

static enum span_kind span_kind_of(const struct setup *s)
{
    const struct smear_segment *g = s->segment;
    if (s->draw->alpha != SMEAR_OPAQUE)
        return SPAN_GENERAL;
    if (g->uv == 0)
        return g->shade == SHADE_GOURAUD ? SPAN_GENERAL : SPAN_FLAT;
    const struct smear_sampler *t = &s->draw->sampler;
    return g->shade == SHADE_NONE && t->masked && !t->bilinear && t->format == SMEAR_TEXEL_8888
        && t->wrap_u == SMEAR_REPEAT && t->wrap_v == SMEAR_REPEAT ? SPAN_TEXEL : SPAN_GENERAL;
}

static void draw_triangle(const struct smear_raster_frame *frame,
                          const struct smear_raster_target *target, const struct smear_triangle *t,
                          bool *moved)
{
    struct setup s;
    s.frame = frame;
    s.target = target;
    s.segment = &frame->geometry->segment[t->segment];
    s.draw = &frame->draw[s.segment->draw];
    for (int i = 0; i < 3; i++)
        s.v[i] = geometry_vertex(frame->geometry, s.segment, t->vertex[i]);

    int32_t left = min_i32(s.v[0][VERTEX_X], min_i32(s.v[1][VERTEX_X], s.v[2][VERTEX_X]));
    int32_t right = max_i32(s.v[0][VERTEX_X], max_i32(s.v[1][VERTEX_X], s.v[2][VERTEX_X]));
    int32_t top = min_i32(s.v[0][VERTEX_Y], min_i32(s.v[1][VERTEX_Y], s.v[2][VERTEX_Y]));
    int32_t bottom = max_i32(s.v[0][VERTEX_Y], max_i32(s.v[1][VERTEX_Y], s.v[2][VERTEX_Y]));
    left = (left + 127) >> 8;
    right = (right + 127) >> 8;
    top = (top + 127) >> 8;
    bottom = (bottom + 127) >> 8;
    bool small = right - left <= SMALL_PX && bottom - top <= SMALL_PX;
    if (max_i32(left, target->x0) >= min_i32(right, target->x1)
        || max_i32(top, target->y0) >= min_i32(bottom, target->y1))
        return;

    setup_edges(&s);
    setup_depth(&s);
    setup_color(&s, t->color);
    s.kind = span_kind_of(&s);
    if (s.segment->uv != 0)
        setup_texture(&s);
    setup_velocity(&s);
    /* The planes start with zero velocity: still triangles need to write it only over moving ones. */
    if (s.poses == 0)
        s.writes_velocity = s.writes_velocity && *moved;
    else
        *moved = true;
    if (small)
        cover_small(&s, left, right, max_i32(top, target->y0), min_i32(bottom, target->y1));
    else
        cover_large(&s);
}

void smear_raster_list(const struct smear_raster_frame *frame, const struct smear_raster_target *target,
                       uint32_t head)
{
    bool moved = false;
    while (head != SMEAR_NO_TRIANGLE) {
        const struct smear_triangle *t = geometry_triangle(frame->geometry, head);
        draw_triangle(frame, target, t, &moved);
        head = t->next;
    }
}
