/* SPDX-License-Identifier: MIT */
/* setup.c - gradients and planes of a triangle.
 *
 * Perspective: u/w, v/w and 1/w are planes; span.c takes the quotient at the ends of blocks of pixels, and interpolates
 * between. How long blocks are and how quotients are taken is decided here, by bounds of their errors. */
#include "setup.h"

/* ------------------------------------------------------------------ gradients */

/* Products of 64 bits: where the core has none, from two of 32. */
static inline int64_t product(int32_t a, int32_t b)
{
#if SMEAR_HAS_MUL64
    return (int64_t)a * b;
#else
    return (int64_t)((uint64_t)(uint32_t)mulh_i32(a, b) << 32 | (uint32_t)mul_wrap(a, b));
#endif
}

/* a b / 2^down, which fits; b often has 16 bits. */
static inline int32_t times_down(int32_t a, int32_t b, int down)
{
#if !SMEAR_HAS_MUL64 && !SMEAR_ONE_COPY
    if ((uint32_t)b + 32768u < 65536u) {
        int32_t high = (a >> 16) * b, low = (int32_t)((uint32_t)a & 0xffffu) * b;      /* a b = high 2^16 + low */
        high += low >> 16;
        return down >= 16 ? high >> (down - 16)
                          : (int32_t)((uint32_t)high << (16 - down) | ((uint32_t)low & 0xffffu) >> down);
    }
#endif
    return (int32_t)(product(a, b) >> down);
}

/* a b - c d for edges b and d: those shorter than 128 px take products of 16 bits. */
static inline int64_t cross(int32_t a, int32_t b, int32_t c, int32_t d)
{
#if !SMEAR_HAS_MUL64 && !SMEAR_ONE_COPY
    if ((((uint32_t)b + 32768u) | ((uint32_t)d + 32768u)) < 65536u) {
        int32_t high = (int32_t)((uint32_t)((a >> 16) * b) - (uint32_t)((c >> 16) * d));
        int32_t low1 = (int32_t)((uint32_t)a & 0xffffu) * b, low2 = (int32_t)((uint32_t)c & 0xffffu) * d;
        return ((int64_t)low1 - low2) + (int64_t)((uint64_t)(int64_t)high << 16);
    }
#endif
    return product(a, b) - product(c, d);
}

static inline uint64_t product_u32(uint32_t a, uint32_t b)
{
#if SMEAR_HAS_MUL64
    return (uint64_t)a * b;
#else
    return (uint64_t)mulh_u32(a, b) << 32 | a * b;
#endif
}

/* a b below 2^64; a is seldom above 2^32. */
static inline uint64_t times(uint64_t a, uint32_t b)
{
    return !SMEAR_ONE_COPY && a >> 32 == 0 ? product_u32((uint32_t)a, b) : a * b;
}

/* (n 256 / area) 2^shift with n = a1 y2 - a2 y1 (or a2 x1 - a1 x2): change per pixel of an attribute that changes by a1
 * and a2 along the two edges; to nearest, clamped. recip: 1 / area, or that times a mantissa. */
static int32_t gradient(int64_t n, uint32_t recip, int shift)
{
    if (n == 0)
        return 0;
    uint64_t size = n < 0 ? 0u - (uint64_t)n : (uint64_t)n;
    int zeros;                                              /* n = top 2^(33 - zeros) */
#if UINTPTR_MAX > 0xffffffffu || SMEAR_ONE_COPY
    zeros = count_leading_zeros_64(size);
    uint32_t high = (uint32_t)(size << zeros >> 32);
#else
    uint32_t high = (uint32_t)(size >> 32), low = (uint32_t)size;
    if (high != 0) {
        zeros = count_leading_zeros(high);
        high = high << zeros | low >> 1 >> (31 - zeros);
    } else {
        zeros = count_leading_zeros(low);
        high = low << zeros;
        zeros += 32;
    }
#endif
    int32_t top = (int32_t)(high >> 1);
    int32_t g = mulh_i32(top, (int32_t)recip);
    g = scale_sat(g, clamp_i32(shift - zeros - 20, -31, 31));
    return n < 0 ? -g : g;
}

/* Slopes from the differences along the two edges, times 2^shift; none beyond `steep`: a plane so steep has no exact
 * pixels, its triangle is a sliver. */
static void plane_slopes(const struct setup *s, struct plane *p, int32_t d1, int32_t d2, uint32_t recip,
                         int shift, int32_t steep)
{
    p->dx = p->dy = 0;
    if ((d1 | d2) == 0)
        return;
    int32_t dx = gradient(cross(d1, s->y2, d2, s->y1), recip, s->area_zeros + shift);
    int32_t dy = gradient(cross(d2, s->x1, d1, s->x2), recip, s->area_zeros + shift);
    if (dx <= steep && dx >= -steep && dy <= steep && dy >= -steep) {
        p->dx = dx;
        p->dy = dy;
    }
}

/* (frac q8) x slope / 256, exact floor without a wide product. */
static inline int32_t part_of(int32_t slope, int32_t frac)
{
    return mul_wrap(slope >> 8, frac) + ((slope & 255) * frac >> 8);
}

/* Value a0 at v[0]: to the pixel whose centre is nearest to it, then back to the origin, wrapping. */
static void plane_place(const struct setup *s, struct plane *p, int32_t a0)
{
    int32_t x = s->v[0][VERTEX_X] >> 8, y = s->v[0][VERTEX_Y] >> 8;
    int32_t fx = 128 - (s->v[0][VERTEX_X] & 255), fy = 128 - (s->v[0][VERTEX_Y] & 255);
    int32_t here = add_wrap(a0, add_wrap(part_of(p->dx, fx), part_of(p->dy, fy)));
    p->at = sub_wrap(here, add_wrap(mul_wrap(p->dx, x), mul_wrap(p->dy, y)));
}

/* A plane through three values; values and their differences fit 32 bits. */
void smear_plane_make(const struct setup *s, struct plane *p, int32_t a0, int32_t a1, int32_t a2)
{
    plane_slopes(s, p, sub_wrap(a1, a0), sub_wrap(a2, a0), s->area_recip, 0, 1 << 28);
    plane_place(s, p, a0);
}

void smear_setup_area(struct setup *s, uint64_t area)
{
    s->area_zeros = count_leading_zeros_64(area);
    s->area_recip = recip_norm_precise((uint32_t)(area << s->area_zeros >> 32));
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
static int32_t times_q15(int32_t a, int32_t q)
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
    s->color_block = 16;
    if (!segment_gouraud(s->segment))
        return;
    int channels = draw_is_opaque(s->draw) ? 3 : 4;
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
    /* Interpolated on the screen, a value is off by at most range x change of 1/w / 4: half a code is TEXTURE_OFF. */
    if (!segment_flat_depth(s->segment) && range != 0)
        s->perspective_color = smear_times_over((uint32_t)(high_q - low_q), range >> 8, (uint32_t)low_q)
                             > 4u * 128u;
    if (s->perspective_color) {     /* and one within a block, where 1/w changes by no more than this */
        uint32_t over_16 = min_u32(magnitude_i32(s->depth.dx), 1u << 26) * 16u;
        uint32_t off = smear_times_over(min_u32(over_16, (uint32_t)(high_q - low_q)), range >> 8, (uint32_t)low_q);
        s->color_block = off <= 4u * 256u ? 16 : off <= 16u * 256u ? 8 : 4;
    }
    for (int c = 0; c < channels; c++) {
        for (int i = 0; i < 3 && s->perspective_color; i++)
            value[c][i] = times_q16(value[c][i] >> 8, q[i]);
        smear_plane_make(s, &s->channel[c], value[c][0], value[c][1], value[c][2]);
    }
}

/* ------------------------------------------------------------------ texture */

enum {
    TEXTURE_OFF = 2,            /* 1/64 texel: what a coordinate may be off between the ends of a block, or affine */
    QUADRATIC_OFF = 1,          /* and at the ends, where 1/q is a parabola */
    QUADRATIC_RANGE = 23593     /* widest E, q16: 0.36 */
};

uint32_t smear_times_over(uint32_t a, uint32_t b, uint32_t c)
{
    int zeros = count_leading_zeros(c);
    uint32_t over = mulh_u32(a, recip_norm(c << zeros));        /* a / c 2^(29 - zeros) */
    uint64_t r = product_u32(over, b);
    int shift = 29 - zeros;
    r = shift >= 0 ? r >> shift : r << -shift;
    return r > UINT32_MAX ? UINT32_MAX : (uint32_t)r;
}

/* What the frame shows of the triangle's box: pixels across, and depth units, which the covered pixels keep to. */
struct seen {
    int32_t width;
    int32_t low_q, high_q;
};

static void seen_find(struct seen *seen, const struct setup *s, int32_t low_q, int32_t high_q)
{
    int32_t x0 = INT32_MAX, x1 = INT32_MIN, y0 = INT32_MAX, y1 = INT32_MIN;
    for (int i = 0; i < 3; i++) {
        x0 = min_i32(x0, s->v[i][VERTEX_X]);
        x1 = max_i32(x1, s->v[i][VERTEX_X]);
        y0 = min_i32(y0, s->v[i][VERTEX_Y]);
        y1 = max_i32(y1, s->v[i][VERTEX_Y]);
    }
    bool cut = (x0 | y0) < 0 || x1 >= s->frame->width << 8 || y1 >= s->frame->height << 8;
    x0 = max_i32(x0 >> 8, 0);
    y0 = max_i32(y0 >> 8, 0);
    x1 = min_i32(x1 >> 8, s->frame->width - 1);
    y1 = min_i32(y1 >> 8, s->frame->height - 1);
    seen->width = x1 - x0 + 1;
    seen->low_q = low_q;
    seen->high_q = high_q;
    if (cut) {      /* else the vertices are seen, too. Corners may lie far off the triangle: wide sums */
        const struct plane *q = &s->depth;
        int32_t dx = q->dx, dy = q->dy, vx = s->v[0][VERTEX_X] >> 8, vy = s->v[0][VERTEX_Y] >> 8;
        int64_t here = s->v[0][VERTEX_DEPTH];
        int64_t low = here + (int64_t)dx * ((dx > 0 ? x0 : x1) - vx) + (int64_t)dy * ((dy > 0 ? y0 : y1) - vy);
        int64_t high = here + (int64_t)dx * ((dx > 0 ? x1 : x0) - vx) + (int64_t)dy * ((dy > 0 ? y1 : y0) - vy);
        int32_t margin = (int32_t)((magnitude_i32(dx) + magnitude_i32(dy)) >> 1);      /* v[0] is no centre */
        seen->low_q = clamp_i32(narrow_sat(low - margin), low_q, high_q);
        seen->high_q = clamp_i32(narrow_sat(high + margin), low_q, high_q);
    }
}

/* Chooses the blocks. `off` is the error of a chord over 16 pixels, in 1/64 texel, `width` the longest row there can be;
 * `change` how much q changes over 16 pixels, q12. Errors of chords fall with the square of their length; a parabola in
 * pieces of 2 pixels errs as a chord of 2 and by a part that falls with the cube. */
static void choose_blocks(struct texture_setup *t, uint32_t off, int32_t width, uint32_t change)
{
    uint32_t n = (uint32_t)min_i32(width, 16);
    if (off < 1u << 20)
        off = off * (n * n) >> 8;
    t->bent = false;
    t->block = 16;
    if (off <= TEXTURE_OFF)
        return;
    t->bent = off <= 64 * TEXTURE_OFF && change <= 4096;
    uint32_t rest = t->bent ? off * (change * n >> 4) >> 13 : 0;
    t->block = !t->bent ? 1 : rest <= TEXTURE_OFF ? 16 : rest <= 8 * TEXTURE_OFF ? 8 : 4;
}

/* Coordinates, which need no perspective. */
static void setup_affine(struct setup *s, const int32_t u[3], const int32_t v[3])
{
    struct texture_setup *t = &s->texture;
    const struct smear_sampler *m = &s->draw->sampler;
    t->mode = TEXTURE_AFFINE;
    t->q = (struct plane){ 0, 0, 0 };
    t->bent = false;
    t->block = 16;
    int32_t a[3], b[3];
    for (int i = 0; i < 3; i++) {
        a[i] = t->turns ? u[i] * 16384 : smear_sampler_texel_u(m, u[i] * 16384);
        b[i] = t->turns ? v[i] * 16384 : smear_sampler_texel_v(m, v[i] * 16384);
    }
    t->shift = (int8_t)(18 - m->uv_shift);
    plane_slopes(s, &t->u, sub_wrap(a[1], a[0]), sub_wrap(a[2], a[0]), s->area_recip, 0, INT32_MAX - 1);
    plane_slopes(s, &t->v, sub_wrap(b[1], b[0]), sub_wrap(b[2], b[0]), s->area_recip, 0, INT32_MAX - 1);
    plane_place(s, &t->u, a[0]);
    plane_place(s, &t->v, b[0]);
}

/* Divides for every block. */
static void setup_divided(struct setup *s, const int32_t u[3], const int32_t v[3], const int32_t q[3],
                          const struct seen *seen)
{
    struct texture_setup *t = &s->texture;
    const struct smear_sampler *m = &s->draw->sampler;
    t->mode = TEXTURE_DIVIDED;
    /* All bits there are, but for differences: what is seen may lie far from the vertices. */
    int up = max_i32(count_leading_zeros((uint32_t)max_i32(q[0], max_i32(q[1], q[2]))) - 3, 0);    /* 0 .. 16 */
    int32_t q0 = q[0] << up, q1 = q[1] << up, q2 = q[2] << up;
    plane_slopes(s, &t->q, q1 - q0, q2 - q0, s->area_recip, 0, INT32_MAX - 1);
    plane_place(s, &t->q, q0);
    smear_plane_make(s, &t->u, times_q15(u[0], q0), times_q15(u[1], q1), times_q15(u[2], q2));
    smear_plane_make(s, &t->v, times_q15(v[0], q0), times_q15(v[1], q1), times_q15(v[2], q2));
    t->shift = (int8_t)(20 - m->uv_shift);
    t->slope = clamp_i32(t->q.dx, -(1 << 24) + 1, (1 << 24) - 1) * 128;

    /* Within a block of n pixels: n |du/dx| texels and n |dq/dx| / q. |du/dx| = |U' - u q'| / q, linear in u, so a
     * vertex bounds its upper part. */
    uint32_t seen_q = (uint32_t)seen->low_q << up;
    uint32_t worst = 0;             /* texels per pixel, q6 */
    for (int i = 0; i < 3; i++) {
        uint32_t ru = smear_times_over(magnitude_i32(sub_wrap(t->u.dx, times_q15(u[i], t->q.dx))),
                                       1u << 16, seen_q);      /* q16 of 2^15 mesh units */
        uint32_t rv = smear_times_over(magnitude_i32(sub_wrap(t->v.dx, times_q15(v[i], t->q.dx))),
                                       1u << 16, seen_q);
        uint32_t tu = magnitude_i32(smear_sampler_texel_u(m, (int32_t)min_u32(ru, 0xffffu) << 13) >> 10);
        uint32_t tv = magnitude_i32(smear_sampler_texel_v(m, (int32_t)min_u32(rv, 0xffffu) << 13) >> 10);
        worst = max_u32(worst, max_u32(tu, tv));
    }
    uint32_t slope_q = min_u32(magnitude_i32(t->q.dx), 1u << 27);
    uint32_t change = min_u32(smear_times_over(slope_q << 4, 1u << 12, seen_q), 1u << 16);
    uint64_t off = ((uint64_t)worst << 4) * change >> 14;
    choose_blocks(t, off > UINT32_MAX ? UINT32_MAX : (uint32_t)off, seen->width, change);
}

/* Around the middle of its range, q = m (1 + e) with |e| <= E. The parabola through 1 / (1 + e) at e = 0 and e = +-n is
 *
 *     1 + (e^2 - e) / (1 - n^2) = k ((3/4 - n^2) + (1/2 - e)^2),       k = 1 / (1 - n^2),
 *
 * off by at most E^3 / 4 (and a little) for n^2 = 3/4 E^2. With w = 1/2 - e = 3/2 - q/m a plane, and U = k (u - u_middle)
 * q/m a plane, u is u_middle + U ((3/4 - n^2) + w^2): no division and no leading zeros, 16-bit products. False when the
 * range is too wide for that. */
static bool setup_quadratic(struct setup *s, const int32_t u[3], const int32_t v[3], const int32_t q[3],
                            int32_t high_q, const struct seen *seen)
{
    struct texture_setup *t = &s->texture;
    const struct smear_sampler *m = &s->draw->sampler;
    uint32_t middle = ((uint32_t)seen->low_q + (uint32_t)seen->high_q) >> 1;
    uint32_t half = ((uint32_t)seen->high_q - (uint32_t)seen->low_q + 1) >> 1;
    if (half > middle >> 1)
        return false;
    int zeros = count_leading_zeros(middle);                                /* 1 .. 19 */
    uint32_t r = recip_norm_precise(middle << zeros);                       /* 1/middle = r 2^(zeros - 61) */
    uint32_t e = mulh_u32(half << zeros, r) >> 13;                          /* E, q16 */
    if (e > QUADRATIC_RANGE)
        return false;

    /* Mesh units (times the texture's size, where texels are wanted) from the middle. */
    int32_t size_u = t->turns ? 1 : m->width, size_v = t->turns ? 1 : m->height;
    int32_t middle_u = (min_i32(u[0], min_i32(u[1], u[2])) + max_i32(u[0], max_i32(u[1], u[2]))) >> 1;
    int32_t middle_v = (min_i32(v[0], min_i32(v[1], v[2])) + max_i32(v[0], max_i32(v[1], v[2]))) >> 1;
    int32_t cu[3], cv[3];
    uint32_t longest = 0;
    for (int i = 0; i < 3; i++) {
        cu[i] = (u[i] - middle_u) * size_u;
        cv[i] = (v[i] - middle_v) * size_v;
        longest |= magnitude_i32(cu[i]) | magnitude_i32(cv[i]);
    }
    int bits = 32 - count_leading_zeros(longest | 1u);                      /* at most 29 */
    /* |U| < 2 x 2^bits takes 16 bits with its sign: U in 2^-fine units. */
    int fine = 14 - bits;
    if (t->turns) {
        fine = min_i32(fine, 17 - m->uv_shift);
        t->shift = (int8_t)(17 - m->uv_shift - fine);
    } else {
        if (m->uv_shift + fine < 1)
            return false;
        t->shift = (int8_t)min_i32(m->uv_shift + fine - 1, 31);
    }
    int bits_q = 32 - count_leading_zeros((uint32_t)high_q);
    if (bits_q + zeros > 32 + 6)            /* vertices so much nearer than what is seen cost precision */
        return false;

    /* k m and the error it makes: that of the parabola, in texels. */
    uint32_t n2 = (e * e >> 16) * 3 >> 2;                                   /* q16 */
    uint32_t k = recip_norm(~(n2 << 16));                                   /* q29 */
    uint32_t recip_u = mulh_u32(k << 2, r << 1);                            /* k/middle = recip_u 2^(zeros - 61) */
    uint32_t texels = t->turns ? (uint32_t)max_i32(m->width, m->height) : 1;
    uint64_t off = times((uint64_t)texels << (bits + 6) >> m->uv_shift, (e * e >> 16) * e >> 16) >> 18;
    if (off > QUADRATIC_OFF)
        return false;
    t->mode = TEXTURE_QUADRATIC;
    t->recip_base = 24576 - (n2 >> 1);

    int down = max_i32(0, bits + bits_q - 30);              /* what brings c q into 31 bits */
    int32_t a[3], b[3];
    for (int i = 0; i < 3; i++) {
        a[i] = times_down(q[i], cu[i], down);
        b[i] = times_down(q[i], cv[i], down);
    }
    int to_units = 45 - zeros - fine - down;                /* times recip_u, then right: U with 16 more bits */
    uint32_t slope_recip = mulh_u32(s->area_recip << 1, recip_u << 1);
    plane_slopes(s, &t->u, a[1] - a[0], a[2] - a[0], slope_recip, 30 - to_units, INT32_MAX - 1);
    plane_slopes(s, &t->v, b[1] - b[0], b[2] - b[0], slope_recip, 30 - to_units, INT32_MAX - 1);
    plane_slopes(s, &t->q, q[0] - q[1], q[0] - q[2], mulh_u32(s->area_recip << 1, r << 1), zeros + 1, INT32_MAX - 1);
    plane_place(s, &t->u, (int32_t)(product(a[0], (int32_t)recip_u) >> to_units));
    plane_place(s, &t->v, (int32_t)(product(b[0], (int32_t)recip_u) >> to_units));
    plane_place(s, &t->q, (int32_t)(0x80000000u - (uint32_t)(product_u32((uint32_t)q[0], r) >> (29 - zeros))));
    for (int i = 0; i < 3; i++) {           /* their upper halves are read: to nearest */
        struct plane *p = i == 0 ? &t->u : i == 1 ? &t->v : &t->q;
        p->at = add_wrap(p->at, 0x8000);
    }
    if (t->turns) {
        t->u_base = shl_wrap(middle_u, 15 + fine);
        t->v_base = shl_wrap(middle_v, 15 + fine);
    } else {        /* texels q16 */
        t->u_base = smear_sampler_texel_u(m, middle_u * 16384);
        t->v_base = smear_sampler_texel_v(m, middle_v * 16384);
    }

    /* Per pixel u changes by at most |U'| + longest |w'|; its second derivative is twice that times w' = q'/q. */
    uint32_t change = magnitude_i32(t->q.dx);
    uint32_t rate = max_u32(magnitude_i32(t->u.dx), magnitude_i32(t->v.dx)) + (change >> 2 >> (14 - bits - fine));
    off = times(mulh_u32(change, rate), texels) >> (4 + fine + m->uv_shift);
    off += times(off, 3 * e) >> 16;
    t->slope = clamp_i32((int32_t)(product(-t->q.dx, (int32_t)(k >> 14)) >> 30), -TEXTURE_BEND_MAX, TEXTURE_BEND_MAX);
    choose_blocks(t, off > UINT32_MAX ? UINT32_MAX : (uint32_t)off, seen->width,
                  min_u32(change >> 16, 0xffffu) + (change >> 18));
    return true;
}

void smear_setup_texture(struct setup *s)
{
    struct texture_setup *t = &s->texture;
    const struct smear_sampler *m = &s->draw->sampler;
    int32_t u[3], v[3], q[3];
    int32_t low_q = INT32_MAX, high_q = 0;
    for (int i = 0; i < 3; i++) {
        u[i] = setup_mesh_u(s, i);
        v[i] = setup_mesh_v(s, i);
        q[i] = s->v[i][VERTEX_DEPTH];
        low_q = min_i32(low_q, q[i]);
        high_q = max_i32(high_q, q[i]);
    }
    t->turns = m->turns;

    /* Texels travelled over the triangle, and the relative change of 1/w: linear interpolation of a quotient over a
     * stretch is off by at most travel x change / 4 in its middle. */
    uint32_t travel = 0;
    for (int i = 0; i < 3; i++) {
        int j = i == 2 ? 0 : i + 1;
        uint32_t du = magnitude_i32(smear_sampler_texel_u(m, (u[i] - u[j]) * 16384) >> 10);  /* q6 texels */
        uint32_t dv = magnitude_i32(smear_sampler_texel_v(m, (v[i] - v[j]) * 16384) >> 10);
        travel = max_u32(travel, max_u32(du, dv));
    }
    uint32_t error = segment_flat_depth(s->segment) ? 0
                   : smear_times_over((uint32_t)(high_q - low_q), travel, (uint32_t)low_q) >> 2;
    if (error <= TEXTURE_OFF) {
        setup_affine(s, u, v);
    } else {
        struct seen seen;
        seen_find(&seen, s, low_q, high_q);
        if (!setup_quadratic(s, u, v, q, high_q, &seen))
            setup_divided(s, u, v, q, &seen);
    }
    t->up = t->turns ? (uint8_t)t->shift : 0;
    t->block = (uint8_t)min_i32(t->block, s->color_block);      /* one walk for both */
}
