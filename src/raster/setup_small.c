/* SPDX-License-Identifier: MIT */
/* setup_small.c - planes and polynomials of small triangles, from weights.
 *
 * A pixel's weights of v[1] and v[2] are planes, whose slopes are the edges over the area: one reciprocal. What changes
 * by d1 and d2 to these vertices has the slopes d1 g1 + d2 g2: two products of 32 bits. With few pixels from v[0] on,
 * slopes of 15 bits after the point suffice.
 *
 * Perspective: with 1/w = (1 + e) / w0, where e is such a plane, a coordinate is u0 + B - e A, where A changes by the
 * differences d of coordinates, and B by d (1 + e): exact at the vertices but for e^2. Where 1/w changes by a part c of
 * that at v[0], and coordinates by t texels, they are off by less than c^2 t / 3. */
#include "raster/setup.h"

/* The changes from v[0] to v[1] and to v[2]. */
struct beyond {
    int32_t to1, to2;
};

/* The slopes of weights, q15; twice the area, and the longer side of the box, q8. */
struct slopes {
    int32_t x1, x2, y1, y2;
    int32_t area, across;
};

static inline int32_t beyond_range(struct beyond b)
{
    return max_i32(max_i32(b.to1, b.to2), 0) - min_i32(min_i32(b.to1, b.to2), 0);
}

static inline int32_t weigh(struct beyond b, int32_t g1, int32_t g2)
{
    return add_wrap(mul_wrap(b.to1, g1), mul_wrap(b.to2, g2));
}

/* floor(a g / 2^15), modulo 2^32. */
static SMEAR_PRODUCT_CALL int32_t part_q15(int32_t a, int32_t g) { return mul_shift(a, g, 15); }

/* The same for |g| <= 2^16. */
static inline int32_t part_of_q15(int32_t a, int32_t g)
{
    if (SMEAR_HAS_MUL64)
        return part_q15(a, g);
    return add_wrap(mul_wrap(a >> 15, g), (a & 0x7fff) * g >> 15);
}

/* (frac q8) x slope / 256, floor. */
static inline int32_t part_of(int32_t slope, int32_t frac)
{
    return mul_wrap(slope >> 8, frac) + ((slope & 255) * frac >> 8);
}

/* From v[0], where a plane has the value a0, to the pixel whose centre is nearest, then back to the origin, wrapping. */
static void place(struct plane *p, const struct setup *s, int32_t a0)
{
    const int32_t x = s->v[0][VERTEX_X], y = s->v[0][VERTEX_Y];
    const int32_t here = add_wrap(a0, add_wrap(part_of(p->dx, 128 - (x & 255)), part_of(p->dy, 128 - (y & 255))));
    p->at = sub_wrap(here, add_wrap(mul_wrap(p->dx, x >> 8), mul_wrap(p->dy, y >> 8)));
}

/* One edge component over the area, q15. recip: 2^61 / (area << up). */
static SMEAR_PRODUCT_CALL int32_t slope(int32_t edge, int32_t recip, int down)
{
    return (mulh_i32(edge * (1 << 18), recip) + (1 << down >> 1)) >> down;
}

/* False for slivers, whose weights' slopes are steeper than 8 per pixel. */
static inline bool slopes_make(struct slopes *g, const struct setup *s, int32_t area)
{
    g->area = area;
    g->across = max_i32(s->bounds.x1 - s->bounds.x0, s->bounds.y1 - s->bounds.y0);
    if (g->across * 32 > area || area < 128)
        return false;
    const int up = count_leading_zeros((uint32_t)area), down = 24 - up;
    const int32_t recip = (int32_t)recip_norm((uint32_t)area << up);
    g->x1 = slope(s->y2, recip, down);
    g->x2 = slope(-s->y1, recip, down);
    g->y1 = slope(-s->x2, recip, down);
    g->y2 = slope(s->x1, recip, down);
    return true;
}

/* Whether an attribute that changes by `range` has slopes of at most 2^16 per pixel. */
static inline bool is_gentle(const struct slopes *g, int32_t range)
{
    return (uint32_t)range * ((uint32_t)g->across >> 4) <= (uint32_t)g->area << 3;
}

/* ------------------------------------------------------------------ depth */

static inline void depth_make(struct setup *s, const struct slopes *g, struct beyond q)
{
    s->depth.dx = add_wrap(part_q15(q.to1, g->x1), part_q15(q.to2, g->x2));
    s->depth.dy = add_wrap(part_q15(q.to1, g->y1), part_q15(q.to2, g->y2));
    place(&s->depth, s, s->v[0][VERTEX_DEPTH]);
}

/* ------------------------------------------------------------------ texture */

/* e: its values at v[1] and v[2] and its slopes, q15. */
struct depth_change {
    struct beyond e;
    int32_t dx, dy;
};

static inline void change_make(struct depth_change *k, const struct slopes *g, int32_t q0, struct beyond q)
{
    const int up = count_leading_zeros((uint32_t)q0) - 1;
    const int32_t recip = (int32_t)recip_norm((uint32_t)q0 << 1 << up);     /* 1/q0 = recip 2^(up - 60) */
    k->e.to1 = mulh_i32(shl_wrap(q.to1, up), recip) >> 13;
    k->e.to2 = mulh_i32(shl_wrap(q.to2, up), recip) >> 13;
    k->dx = weigh(k->e, g->x1, g->x2) >> 15;
    k->dy = weigh(k->e, g->y1, g->y2) >> 15;
}

/* One coordinate's polynomial around v[0]'s pixel, q15 mesh units. fx, fy: from v[0] to that pixel's centre, q8. */
static inline void curve_make(struct curve *c, const struct slopes *g, const struct depth_change *k, int32_t u0,
                              struct beyond u, int32_t fx, int32_t fy)
{
    const struct beyond b = { u.to1 + part_of_q15(u.to1, k->e.to1), u.to2 + part_of_q15(u.to2, k->e.to2) };
    const int32_t ax = weigh(u, g->x1, g->x2), ay = weigh(u, g->y1, g->y2);
    const int32_t dx = weigh(b, g->x1, g->x2), dy = weigh(b, g->y1, g->y2);
    const int32_t xx = -part_of_q15(ax, k->dx), yy = -part_of_q15(ay, k->dy);
    const int32_t xy = -add_wrap(part_of_q15(ax, k->dy), part_of_q15(ay, k->dx));
    c->dxx = xx;
    c->dxy = xy;
    c->dyy = yy;
    c->dx = add_wrap(dx, add_wrap(mul_wrap(2 * fx, xx), mul_wrap(xy, fy)) >> 8);
    c->dy = add_wrap(dy, add_wrap(mul_wrap(2 * fy, yy), mul_wrap(xy, fx)) >> 8);
    c->at = add_wrap(shl_wrap(u0, 15), add_wrap(part_of(add_wrap(dx, add_wrap(mul_wrap(xx, fx), mul_wrap(xy, fy)) >> 8), fx),
                                                part_of(add_wrap(dy, mul_wrap(yy, fy) >> 8), fy)));
}

/* As the raster wants it: turns q32, those of v in steps of CURVE_STEP; or mesh units q14. */
static inline void curve_scale(struct curve *c, const struct smear_sampler *m, int32_t step)
{
    if (!m->turns) {
        *c = (struct curve){ c->at >> 1, c->dx >> 1, c->dy >> 1, c->dxx >> 1, c->dxy >> 1, c->dyy >> 1 };
        return;
    }
    const int up = 17 - m->uv_shift;
    c->at = add_wrap(shl_wrap(c->at, up) & -step, step >> 1);
    c->dx = shl_wrap(c->dx, up) & -step;
    c->dy = shl_wrap(c->dy, up) & -step;
    c->dxx = shl_wrap(c->dxx, up) & -step;
    c->dxy = shl_wrap(c->dxy, up) & -step;
    c->dyy = shl_wrap(c->dyy, up) & -step;
}

static bool texture_make(struct setup *s, const struct slopes *g, const struct depth_change *k)
{
    struct texture_setup *t = &s->texture;
    const struct smear_sampler *m = &s->draw->sampler;
    const int32_t u0 = setup_mesh_u(s, 0), v0 = setup_mesh_v(s, 0);
    const struct beyond u = { setup_mesh_u(s, 1) - u0, setup_mesh_u(s, 2) - u0 };
    const struct beyond v = { setup_mesh_v(s, 1) - v0, setup_mesh_v(s, 2) - v0 };
    const int32_t change = beyond_range(k->e), across = beyond_range(u), down = beyond_range(v);
    const uint32_t travel = max_u32((uint32_t)across * (uint32_t)m->width, (uint32_t)down * (uint32_t)m->height);
    /* c at most 1/8, c^2 t at most 1/8 */
    if (change > 1 << 12 || (uint32_t)(change * change >> 15) * ((travel >> m->uv_shift) + 1u) > 1u << 12
        || across > CURVE_TURNS << m->uv_shift || !is_gentle(g, max_i32(across, down)))
        return false;
    const int32_t x = s->v[0][VERTEX_X], y = s->v[0][VERTEX_Y];
    const int32_t fx = 128 - (x & 255), fy = 128 - (y & 255);
    struct curve cu, cv;
    curve_make(&cu, g, k, u0, u, fx, fy);
    curve_make(&cv, g, k, v0, v, fx, fy);
    curve_scale(&cu, m, 1);
    curve_scale(&cv, m, CURVE_STEP);
    t->curve[0] = cu;
    t->curve[1] = cv;
    t->x0 = x >> 8;
    t->y0 = y >> 8;
    t->mode = TEXTURE_CURVED;
    t->turns = m->turns;
    t->block = 16;
    return true;
}

/* ------------------------------------------------------------------ light */

/* A channel of a vertex, q16 codes (or linear >> 8): codes are rounded, linear light is looked up by its floor; both keep a
 * margin from 0 and 256 that errors of slopes do not cross. */
static int32_t light_value(const struct setup *s, int vertex, int c)
{
    const uint32_t word = (uint32_t)s->v[vertex][s->segment->color + (c >> 1)];
    const int32_t value = (int32_t)(c & 1 ? word >> 16 : word & 0xffffu);
    return frame_is_linear(s->frame) && c < 3 ? value - (value >> 9) + 64 : min_i32(value, 0xff00) + 0x80;
}

/* Whether green and blue are as red, as light without a colour is. */
static inline bool light_is_white(const struct setup *s)
{
    for (int i = 0; i < 3; i++) {
        const uint32_t red_green = (uint32_t)s->v[i][s->segment->color], blue = (uint32_t)s->v[i][s->segment->color + 1];
        if (red_green != (red_green << 16 | (blue & 0xffffu)))
            return false;
    }
    return true;
}

static bool light_make(struct setup *s, const struct slopes *g, const struct depth_change *k)
{
    const int channels = draw_is_opaque(s->draw) ? 3 : 4;
    const int32_t change = beyond_range(k->e);
    int32_t most = 0;
    s->even_color = s->perspective_color = false;
    s->color_block = 16;
    if (!segment_gouraud(s->segment))
        return true;
    for (int c = 0; c < channels; c++) {
        struct plane *p = &s->channel[c];
        const int32_t value = light_value(s, 0, c);
        const struct beyond b = { light_value(s, 1, c) - value, light_value(s, 2, c) - value };
        most = max_i32(most, beyond_range(b));
        p->dx = weigh(b, g->x1, g->x2) >> 7;
        p->dy = weigh(b, g->y1, g->y2) >> 7;
        place(p, s, value << 8);
        if (!SMEAR_SMALL_FILE && c == 0 && light_is_white(s)) {
            p[1] = p[2] = *p;
            c = 2;
        }
    }
    s->even_color = most == 0;
    return is_gentle(g, most) && (uint32_t)(most >> 8) * (uint32_t)change <= 2u << 15;    /* off by half a code, as setup.c has it */
}

bool smear_setup_small(struct setup *s, int32_t area)
{
    const int32_t q0 = s->v[0][VERTEX_DEPTH];
    const struct beyond q = { s->v[1][VERTEX_DEPTH] - q0, s->v[2][VERTEX_DEPTH] - q0 };
    const int32_t low = min_i32(q0, min_i32(s->v[1][VERTEX_DEPTH], s->v[2][VERTEX_DEPTH]));
    const int32_t high = max_i32(q0, max_i32(s->v[1][VERTEX_DEPTH], s->v[2][VERTEX_DEPTH]));
    struct slopes g;
    struct depth_change k = { { 0, 0 }, 0, 0 };
    if (high - low > q0 >> 3 || !slopes_make(&g, s, area))
        return false;
    if (!segment_flat_depth(s->segment))
        change_make(&k, &g, q0, q);
    if (!texture_make(s, &g, &k) || !light_make(s, &g, &k))
        return false;
    depth_make(s, &g, q);
    s->slope = high < SLOPE_BREAK ? SLOPE_FAR : low >= SLOPE_BREAK ? SLOPE_NEAR : SLOPE_BOTH;
    s->flat = s->has_velocity = false;
    s->poses = 0;
    return true;
}
