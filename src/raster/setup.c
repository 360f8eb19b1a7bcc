/* SPDX-License-Identifier: MIT */
/* setup.c - gradients and planes of a triangle.
 *
 * Perspective: u/w, v/w and 1/w are planes. Their quotients are polynomials of second degree where that is
 * near enough; else span.c takes them at the ends of blocks of pixels, and interpolates between. Which, and
 * how long blocks are, is decided here, by bounds of their errors. */
#include "raster/setup.h"

#include "kernels/gradient.h"
#include "raster/fog.h"

/* ------------------------------------------------------------------ gradients */

SMEAR_STATIC_ASSERT(offsetof(struct setup, y1) == offsetof(struct setup, x1) + 4
                        && offsetof(struct setup, x2) == offsetof(struct setup, x1) + 8
                        && offsetof(struct setup, y2) == offsetof(struct setup, x1) + 12,
                    "kernels know the edges");

/* Slopes from the differences along the two edges; none beyond `steep`: a plane so steep has no exact pixels, its triangle is a
 * sliver. */
static void plane_slopes(const struct setup *s, struct plane *p, int32_t d1, int32_t d2, int32_t steep)
{
    p->dx = p->dy = 0;
    if ((d1 | d2) == 0)
        return;
    const uint64_t both = gradients(&s->x1, d1, d2, s->area_recip, s->area_zeros);
    const int32_t dx = (int32_t)(uint32_t)both, dy = (int32_t)(uint32_t)(both >> 32);
    if (dx <= steep && dx >= -steep && dy <= steep && dy >= -steep) {
        p->dx = dx;
        p->dy = dy;
    }
}

/* Value a0 at v[0]: to the pixel whose centre is nearest to it, then back to the origin, wrapping. */
static void plane_place(const struct setup *s, struct plane *p, int32_t a0)
{
    int32_t x = s->v[0][VERTEX_X] >> 8, y = s->v[0][VERTEX_Y] >> 8;
    int32_t fx = 128 - (s->v[0][VERTEX_X] & 255), fy = 128 - (s->v[0][VERTEX_Y] & 255);
    int32_t here = add_wrap(a0, add_wrap(slope_part(p->dx, fx), slope_part(p->dy, fy)));
    p->at = sub_wrap(here, add_wrap(mul_wrap(p->dx, x), mul_wrap(p->dy, y)));
}

void smear_plane_make(const struct setup *s, struct plane *p, int32_t a0, int32_t a1, int32_t a2)
{
    plane_slopes(s, p, sub_wrap(a1, a0), sub_wrap(a2, a0), PLANE_STEEP);
    plane_place(s, p, a0);
}

static void setup_area(struct setup *s, uint64_t area)
{
    s->area_zeros = count_leading_zeros_64(area);
    s->area_recip = recip_norm_precise((uint32_t)(area << s->area_zeros >> 32));
}

/* ------------------------------------------------------------------ depth */

static void setup_depth(struct setup *s)
{
    int32_t q0 = s->v[0][VERTEX_DEPTH], q1 = s->v[1][VERTEX_DEPTH], q2 = s->v[2][VERTEX_DEPTH];
    if (draw_is_shadow(s->draw)) {      /* in front of what it lies on, by a 512th of the distance */
        q0 += q0 >> 9;
        q1 += q1 >> 9;
        q2 += q2 >> 9;
    }
    smear_plane_make(s, &s->depth, q0, q1, q2);
    int32_t low = min_i32(q0, min_i32(q1, q2)), high = max_i32(q0, max_i32(q1, q2));
    s->slope = high < SLOPE_BREAK ? SLOPE_FAR : low >= SLOPE_BREAK ? SLOPE_NEAR : SLOPE_BOTH;
}

/* ------------------------------------------------------------------ colour */

/* floor(a q / 2^16), a of 16 bits without sign. */
static inline int32_t times_q16(int32_t a, int32_t q)
{
    return a * (q >> 16) + (int32_t)((uint32_t)a * ((uint32_t)q & 0xffffu) >> 16);
}

/* Red, green or blue of a vertex; where there is no texture, in the triangle's part of fog. */
static int32_t value_in_fog(const struct setup *s, int vertex, int c)
{
    const int32_t value = channel_value(s, vertex, c);
    return SMEAR_WITH_FOG && fog_is_even(s) && !segment_textured(s->segment) ? fog_channel(s->frame, value, c, fog_even_part(s)) : value;
}

static void setup_color(struct setup *s)
{
    s->even_color = s->perspective_color = false;
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
            value[c][i] = c < 3 ? value_in_fog(s, i, c) : channel_value(s, i, c);
        for (int i = 0; i < 3; i++)
            range = max_u32(range, magnitude_i32(value[c][i] - value[c][i == 2 ? 0 : i + 1]));
    }
    s->even_color = range == 0;
    /* Interpolated on the screen, a value is off by at most
     * range x change of 1/w / 4: half a code is TEXTURE_OFF. */
    if (!segment_flat_depth(s->segment) && range != 0)
        s->perspective_color = smear_times_over((uint32_t)(high_q - low_q), range >> 8, (uint32_t)low_q)
                             > 4u * 128u;
    if (s->perspective_color) {     /* and one within a block, where 1/w changes by no more than this */
        uint32_t over_16 = min_u32(magnitude_i32(s->depth.dx), 1u << 26) * 16u;
        uint32_t off = smear_times_over(min_u32(over_16, (uint32_t)(high_q - low_q)), range >> 8,
                                        (uint32_t)low_q);
        s->color_block = off <= 4u * 256u ? 16 : off <= 16u * 256u ? 8 : 4;
    }
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

/* What the frame shows of the triangle's box: pixels across, and depth units, which the covered pixels keep to. */
struct seen {
    int32_t width;
    int32_t low_q, high_q;
};

static void seen_find(struct seen *seen, const struct setup *s, int32_t low_q, int32_t high_q)
{
    int32_t x0 = s->bounds.x0, x1 = s->bounds.x1, y0 = s->bounds.y0, y1 = s->bounds.y1;
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
        int64_t low = here + mul_wide(dx, (dx > 0 ? x0 : x1) - vx) + mul_wide(dy, (dy > 0 ? y0 : y1) - vy);
        int64_t high = here + mul_wide(dx, (dx > 0 ? x1 : x0) - vx) + mul_wide(dy, (dy > 0 ? y1 : y0) - vy);
        int32_t margin = (int32_t)((magnitude_i32(dx) + magnitude_i32(dy)) >> 1);      /* v[0] is no centre */
        seen->low_q = clamp_i32(narrow_sat(low - margin), low_q, high_q);
        seen->high_q = clamp_i32(narrow_sat(high + margin), low_q, high_q);
    }
}

/* How long blocks may be whose error over 16 pixels is `off` and grows by so much when their length doubles. */
static uint8_t block_longest(uint32_t off, uint32_t growth, uint32_t limit, int32_t width)
{
    int32_t block = COLOR_BLOCK_MAX;
    while (block < BLOCK_LONGEST && block < width && off * growth <= limit) {
        off *= growth;
        block *= 2;
    }
    return (uint8_t)block;
}

/* Chooses the blocks. `chord` is the error of a chord over 16 pixels, in 1/64 texel q14, `width` the longest row
 * there can be; `change` how much q changes over 16 pixels, q12, where it is least. Errors of chords fall with the square of
 * their length, those of parabolas with its cube.
 *
 * Over n pixels, where coordinates change by t texels at the rate they have where q is least, and q by a part r of what it is there,
 * a chord is off by t r / 4 at most, and a parabola by t r^2 / 12 sqrt(3): of s in [0, 1] it is
 * t r / (1 + r) s (1 - s) (1 / (1 + r s) - (2 + r) / (2 + 2 r)). It is taken for t r^2 / 16. */
static void choose_blocks(struct texture_setup *t, uint64_t chord, int32_t width, uint32_t change)
{
    uint32_t n = (uint32_t)min_i32(width, 16), off = chord >> 46 != 0 ? UINT32_MAX : (uint32_t)(chord >> 14);
    if (off < 1u << 20)
        off = off * (n * n) >> 8;
    t->parabolic = false;
    if (off <= TEXTURE_OFF) {       /* half of that if long: more pixels come near it and show the next texel */
        t->block = block_longest((uint32_t)chord, 4, TEXTURE_OFF << 13, width);
        return;
    }
    const uint32_t rest = off < 1u << 18 && change <= 4096 ? off * (change * n >> 4) >> 14 : UINT32_MAX;
    t->parabolic = rest <= 64 * PARABOLA_OFF;
    t->block = !t->parabolic ? 1 : rest <= 8 * PARABOLA_OFF ? 8 : 4;
    if (rest <= PARABOLA_OFF)
        t->block = block_longest(off * change, 8, PARABOLA_OFF << 14, width);
}

/* A triangle's texture coordinates, mesh units, and depths. */
struct corners {
    int32_t uv[2][3], q[3];
    int32_t low_q, high_q;
    int32_t middle[2], width[2];    /* of coordinates */
};

/* Texels, q6, of so much of a ratio (texture.h). */
static uint32_t texels_q6(const struct setup *s, int axis, int32_t ratio)
{
    return magnitude_i32(smear_sampler_texel(&s->draw->sampler, axis, ratio) >> 10);
}

/* Coordinates, which need no perspective. */
static void setup_affine(struct setup *s, const struct corners *k)
{
    struct texture_setup *t = &s->texture;
    t->mode = TEXTURE_AFFINE;
    t->q = (struct plane){ 0, 0, 0 };
    t->parabolic = false;
    t->block = BLOCK_LONGEST;
    t->shift = (int8_t)(18 - s->draw->sampler.uv_shift);
    for (int i = 0; i < 2; i++) {
        int32_t a[3];
        for (int j = 0; j < 3; j++) {
            a[j] = k->uv[i][j] * 16384;
            if (!t->turns)
                a[j] = smear_sampler_texel(&s->draw->sampler, i, a[j]);
        }
        plane_slopes(s, &t->uv[i], sub_wrap(a[1], a[0]), sub_wrap(a[2], a[0]), INT32_MAX - 1);
        plane_place(s, &t->uv[i], a[0]);
    }
}

/* How the weights of v[1] and v[2] change per pixel, and how far sums of products with them are to be shifted. */
struct weights {
    int32_t dx[2], dy[2];
    int shift;
};

static void weights_make(struct weights *w, const struct setup *s)
{
    const uint32_t longest = magnitude_i32(s->x1) | magnitude_i32(s->y1) | magnitude_i32(s->x2)
                           | magnitude_i32(s->y2);
    const int up = count_leading_zeros(longest) - 1;
    const int32_t recip = (int32_t)s->area_recip;
    w->dx[0] = mulh_i32(shl_wrap(s->y2, up), recip);
    w->dx[1] = -mulh_i32(shl_wrap(s->y1, up), recip);
    w->dy[0] = -mulh_i32(shl_wrap(s->x2, up), recip);
    w->dy[1] = mulh_i32(shl_wrap(s->x1, up), recip);
    w->shift = clamp_i32(s->area_zeros - up - 21, -31, 31);
}

/* Slope of what changes by d1 and d2 to v[1] and v[2]. */
static inline int32_t weighed(const struct weights *w, const int32_t weight[2], int32_t d1, int32_t d2)
{
    return scale_sat(mulh_i32(weight[0], d1) + mulh_i32(weight[1], d2), w->shift);
}

/* e, less what it is on the average, at v[0]'s pixel and per pixel, q32; 1 + e at the vertices, q14; where in its pixel v[0] is. */
struct depth_change {
    int32_t at, dx, dy;
    int32_t vertex[3];
    int32_t fx, fy;
};

/* Terms of a polynomial, from mesh units to turns. One by one they stay in registers, in a loop the code is shorter. */
SMEAR_INLINE void turns_make(int32_t value[6], int up, int32_t step)
{
    const int32_t half = step >> 1;
    for (int i = 0; SMEAR_SMALL_CODE && i < 6; i++)
        value[i] = add_wrap(shl_wrap(value[i], up), half) & -step;
    if (SMEAR_SMALL_CODE)
        return;
    value[0] = add_wrap(shl_wrap(value[0], up), half) & -step;
    value[1] = add_wrap(shl_wrap(value[1], up), half) & -step;
    value[2] = add_wrap(shl_wrap(value[2], up), half) & -step;
    value[3] = add_wrap(shl_wrap(value[3], up), half) & -step;
    value[4] = add_wrap(shl_wrap(value[4], up), half) & -step;
    value[5] = add_wrap(shl_wrap(value[5], up), half) & -step;
}

/* One coordinate's polynomial. False where it is steep. */
static bool curve_make(struct setup *s, const struct weights *w, const struct depth_change *e,
                       const struct corners *k, int axis, int32_t step)
{
    const struct smear_sampler *m = &s->draw->sampler;
    const int32_t *u = k->uv[axis], middle = k->middle[axis];
    const int32_t a0 = (u[0] - middle) * e->vertex[0], d1 = (u[1] - middle) * e->vertex[1] - a0;
    const int32_t d2 = (u[2] - middle) * e->vertex[2] - a0;
    const int32_t dx = weighed(w, w->dx, d1, d2), dy = weighed(w, w->dy, d1, d2);
    if ((magnitude_i32(dx) | magnitude_i32(dy)) >> (12 + m->uv_shift) != 0)
        return false;           /* a quarter turn per pixel */
    const int32_t here = a0 + slope_part(dx, e->fx) + slope_part(dy, e->fy);
    int32_t value[6] = {
        middle * 16384 + here - mulh_i32(here, e->at),
        dx - mulh_i32(dx, e->at) - mulh_i32(here, e->dx), dy - mulh_i32(dy, e->at) - mulh_i32(here, e->dy),
        -mulh_i32(dx, e->dx), -mulh_i32(dx, e->dy) - mulh_i32(dy, e->dx), -mulh_i32(dy, e->dy)
    };
    if (s->texture.turns)
        turns_make(value, 18 - m->uv_shift, step);
    value[0] += step >> 1;
    s->texture.curve[axis] = (struct curve){ value[0], value[1], value[2], value[3], value[4], value[5] };
    return true;
}

/* a over the larger of a texture's sizes, rounded down. */
static inline uint32_t over_size(uint32_t a, const struct smear_sampler *m)
{
    if (!SMEAR_SMALL_CODE && m->turns)
        return a >> max_u32(m->log2_width, m->log2_height);
    return a / (uint32_t)max_i32(m->width, m->height);
}

/* Around the middle of its range, q = m (1 + e) with |e| <= E. With planes e and W = (u - u_middle)
 * (1 + e), u is u_middle + W / (1 + e), nearly u_middle + W (1 + 3/16 E^2 - e): off by at most 13/16 E^2 W,
 * in corners; 3/16 makes it least on the average. Without perspective (`flat`) e is 0. False where the
 * triangle is too large for 32 bits or the error is. */
static bool setup_curved(struct setup *s, const struct corners *k, uint32_t travel, bool flat)
{
    struct texture_setup *t = &s->texture;
    const struct smear_sampler *m = &s->draw->sampler;
    const uint32_t across = (uint32_t)max_i32(s->bounds.x1 - s->bounds.x0, s->bounds.y1 - s->bounds.y0) >> 8;
    /* A last bit of the coefficients is 2^-(14 + uv_shift) turns. Edges of 2^13 px at most. */
    if (across * across > (flat ? 1u << 26 : over_size(256u << m->uv_shift, m)) || travel > 65535u
        || k->width[0] > CURVE_TURNS << m->uv_shift)
        return false;
    const int32_t x = s->v[0][VERTEX_X], y = s->v[0][VERTEX_Y];
    struct depth_change e = { 0, 0, 0, { 16384, 16384, 16384 }, 128 - (x & 255), 128 - (y & 255) };
    if (!flat) {
        const uint32_t middle = ((uint32_t)k->low_q + (uint32_t)k->high_q) >> 1;
        const int up = count_leading_zeros(middle) - 1;
        /* 1/m = recip 2^(up - 60) */
        const int32_t recip = (int32_t)recip_norm_precise(middle << 1 << up);
        const uint32_t half = ((uint32_t)k->high_q - (uint32_t)k->low_q + 1) >> 1;
        const uint32_t steep = max_u32(magnitude_i32(s->depth.dx), magnitude_i32(s->depth.dy));
        /* Depths are rounded by 1/2. */
        if (max_u32(half, steep) > middle >> 2 || across * travel > middle)
            return false;
        const uint32_t most = (uint32_t)mulh_i32((int32_t)(half << up), recip) << 2;        /* E q30 */
        const uint32_t square = mulh_u32(most, most);
        if (mulh_u32(square << 2, travel) > CURVED_OFF)               /* E^2 travel / 4 */
            return false;
        for (int i = 0; i < 3; i++)
            e.vertex[i] += (mulh_i32(shl_wrap(k->q[i] - (int32_t)middle, up), recip) + 0x2000) >> 14;
        e.dx = mulh_i32(shl_wrap(s->depth.dx, up), recip) * 16;
        e.dy = mulh_i32(shl_wrap(s->depth.dy, up), recip) * 16;
        e.at = mulh_i32(shl_wrap(k->q[0] - (int32_t)middle, up), recip) * 16 + slope_part(e.dx, e.fx)
             + slope_part(e.dy, e.fy);
        e.at -= (int32_t)(square * 3u);
    }
    struct weights w;
    weights_make(&w, s);
    t->x0 = x >> 8;
    t->y0 = y >> 8;
    t->mode = TEXTURE_CURVED;
    t->block = 16;
    return curve_make(s, &w, &e, k, 0, 1) && curve_make(s, &w, &e, k, 1, CURVE_STEP);
}

/* The most texels per pixel, q6, of what changes by so much over q. Without textures of so many texels that they wrap, that is where
 * the change is largest. */
static uint32_t texels_most(const struct setup *s, int axis, uint32_t change[3], uint32_t q)
{
    const int count = SMEAR_SMALL_CODE || s->draw->sampler.shift[axis] > 4 ? 3 : 1;
    uint32_t most = 0;
    if (count == 1)
        change[0] = max_u32(change[0], max_u32(change[1], change[2]));
    for (int j = 0; j < count; j++) {
        const uint32_t r = smear_times_over(change[j], 1u << 16, q);        /* q16 of 2^15 mesh units */
        most = max_u32(most, texels_q6(s, axis, (int32_t)min_u32(r, 0xffffu) << 13));
    }
    return most;
}

/* Returns by how many bits coordinates may be made finer: planes of coarse units would leave bits unused, and their slopes be rounded
 * by so much that textures of a surface that passes the eye shake, where vertices lie far from what is seen. */
static int spare_bits(const struct setup *s, const struct corners *k)
{
    uint32_t all = 0;
    for (int i = 0; i < 2; i++)
        for (int j = 0; j < 3; j++)
            all |= (uint32_t)(k->uv[i][j] ^ k->uv[i][j] >> 31);
    return min_i32(count_leading_zeros(all | 1u) - 17, 15 - s->draw->sampler.uv_shift);
}

/* Divides for every block. */
static void setup_divided(struct setup *s, const struct corners *k)
{
    struct texture_setup *t = &s->texture;
    struct seen seen;
    seen_find(&seen, s, k->low_q, k->high_q);
    t->mode = TEXTURE_DIVIDED;
    /* All bits there are, but for differences: what is seen may lie far from the vertices. */
    int up = max_i32(count_leading_zeros((uint32_t)k->high_q) - 3, 0);      /* 0 .. 16 */
    int32_t q[3];
    for (int i = 0; i < 3; i++)
        q[i] = k->q[i] << up;
    plane_slopes(s, &t->q, q[1] - q[0], q[2] - q[0], INT32_MAX - 1);
    plane_place(s, &t->q, q[0]);
    const int spare = spare_bits(s, k);
    t->spare = (uint8_t)spare;
    t->shift = (int8_t)(20 - s->draw->sampler.uv_shift - spare);
    t->slope = clamp_i32(t->q.dx, -(1 << 24) + 1, (1 << 24) - 1) * 128;

    /* Within a block of n pixels: n |du/dx| texels and n |dq/dx| / q. |du/dx| = |U' - u q'| / q,
     * linear in u, so a vertex bounds its upper part. */
    uint32_t seen_q = (uint32_t)seen.low_q << up;
    uint32_t worst = 0;             /* texels per pixel, q6 */
    for (int i = 0; i < 2; i++) {
        int32_t over_w[3];
        for (int j = 0; j < 3; j++)
            over_w[j] = times_q15(shl_wrap(k->uv[i][j], spare), q[j]);
        struct plane *p = &t->uv[i];
        smear_plane_make(s, p, over_w[0], over_w[1], over_w[2]);
        uint32_t change[3];
        for (int j = 0; j < 3; j++)
            change[j] = magnitude_i32(sub_wrap(p->dx, times_q15(shl_wrap(k->uv[i][j], spare), t->q.dx)));
        worst = max_u32(worst, texels_most(s, i, change, seen_q) >> spare);
    }
    uint32_t slope_q = min_u32(magnitude_i32(t->q.dx), 1u << 27);
    uint32_t change = min_u32(smear_times_over(slope_q << 4, 1u << 12, seen_q), 1u << 16);
    choose_blocks(t, ((uint64_t)worst << 4) * change, seen.width, change);
}

static SMEAR_NOINLINE void setup_texture(struct setup *s)
{
    struct texture_setup *t = &s->texture;
    struct corners k;
    k.low_q = INT32_MAX;
    k.high_q = 0;
    for (int i = 0; i < 3; i++) {
        k.uv[0][i] = setup_mesh_u(s, i);
        k.uv[1][i] = setup_mesh_v(s, i);
        k.q[i] = s->v[i][VERTEX_DEPTH];
        k.low_q = min_i32(k.low_q, k.q[i]);
        k.high_q = max_i32(k.high_q, k.q[i]);
    }
    t->turns = s->draw->sampler.turns;

    /* Texels travelled over the triangle, and the relative change of 1/w: linear interpolation of a quotient
     * over a stretch is off by at most travel x change / 4 in its middle. */
    uint32_t travel = 0;
    for (int i = 0; i < 2; i++) {
        const int32_t *u = k.uv[i];
        const int32_t low = min_i32(u[0], min_i32(u[1], u[2])), high = max_i32(u[0], max_i32(u[1], u[2]));
        travel = max_u32(travel, texels_q6(s, i, (high - low) * 16384));
        k.middle[i] = (low + high) >> 1;
        k.width[i] = high - low;
    }
    const bool flat = segment_flat_depth(s->segment)
                   || (uint64_t)(uint32_t)(k.high_q - k.low_q) * travel
                          <= (uint32_t)k.low_q * (4u * TEXTURE_OFF);
    if (!setup_curved(s, &k, travel, flat)) {
        if (flat)
            setup_affine(s, &k);
        else
            setup_divided(s, &k);
    }
    t->up = t->turns ? (uint8_t)t->shift : 0;
    if (segment_gouraud(s->segment) && !s->even_color)
        t->block = (uint8_t)min_i32(t->block, s->color_block);      /* one walk for both */
    if (fog_varies(s))
        t->block = (uint8_t)min_i32(t->block, s->fog - FOG_VARIES);
}

/* log2 x, q5: by the bits below the highest. */
static int32_t log2_q5(uint64_t x)
{
    const int zeros = count_leading_zeros_64(x);
    return (63 - zeros) * 32 + (int32_t)(x << zeros >> 58) - 32;
}

/* floor(log4(texels / pixels)) */
void smear_setup_level(struct setup *s, uint64_t area, struct smear_raster_draw *smaller)
{
    const struct smear_sampler *m = &s->draw->sampler;
    const int32_t u0 = setup_mesh_u(s, 0), v0 = setup_mesh_v(s, 0);
    const int64_t turned = cross_wide(setup_mesh_u(s, 1) - u0, setup_mesh_u(s, 2) - u0, setup_mesh_v(s, 1) - v0, setup_mesh_v(s, 2) - v0);
    s->level = 0;
    if (turned == 0)
        return;
    const int32_t texels = log2_q5(turned < 0 ? 0u - (uint64_t)turned : (uint64_t)turned)
                         + 32 * (m->log2_width + m->log2_height + 16 - 2 * m->uv_shift);       /* pixels have 16 bits below the point */
    s->level = (uint8_t)clamp_i32((texels - log2_q5(area)) >> 6, 0, m->levels);
    smear_setup_shrink(s, smaller);
}

void smear_setup_shrink(struct setup *s, struct smear_raster_draw *smaller)
{
    if (s->level == 0)
        return;
    *smaller = *s->draw;
    smear_sampler_shrink(&smaller->sampler, s->level);
    s->draw = smaller;
}

/* ------------------------------------------------------------------ all of it */

/* Without a texture and opaque: one colour throughout, which is then s->color. Faces of boxes have such vertices. */
static bool is_flat(struct setup *s)
{
    const int at = s->segment->color;
    if (fog_varies(s))
        return false;
    if (!ALWAYS_FLAT && (segment_textured(s->segment) || !draw_is_opaque(s->draw)))
        return false;
    if (!segment_gouraud(s->segment))
        return true;
    if (s->v[0][at] != s->v[1][at] || s->v[0][at] != s->v[2][at]
        || (((s->v[0][at + 1] ^ s->v[1][at + 1]) | (s->v[0][at + 1] ^ s->v[2][at + 1])) & 0xffff) != 0)
        return false;
    uint32_t code[3];
    for (int c = 0; c < 3; c++) {
        uint32_t value = (uint32_t)value_in_fog(s, 0, c);
        code[c] = code_of_channel(value, frame_transfer(s->frame));
    }
    s->color = pixel_make(0, code[0], code[1], code[2]);
    return true;
}

static inline void setup_looks(struct setup *s)
{
    s->flat = is_flat(s);
    s->has_velocity = false;
    if (!ALWAYS_FLAT && !s->flat)
        setup_color(s);
    if (SMEAR_WITH_FOG && fog_varies(s))
        smear_fog_blocks(s);
    else if (SMEAR_WITH_FOG && !segment_textured(s->segment))
        s->fog = FOG_NONE;
    if (SMEAR_WITH_TEXTURE && s->segment->uv != 0)
        setup_texture(s);
}

void smear_setup(struct setup *s, uint64_t area)
{
    setup_area(s, area);
    setup_depth(s);
    setup_looks(s);
}
