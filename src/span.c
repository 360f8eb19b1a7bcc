/* SPDX-License-Identifier: MIT */
/* span.c - inner loops of the raster: flat, plain texels, and everything else in blocks. */
#include "span.h"

#include "pixel.h"

enum { BLOCK_MAX = 16 };

static const int32_t inverse[BLOCK_MAX + 1] = {     /* 2^30 / n */
    0, 1 << 30, 1 << 29, 357913941, 1 << 28, 214748365, 178956971, 153391689, 1 << 27,
    119304647, 107374182, 97612893, 89478485, 82595525, 76695845, 71582788, 1 << 26
};

static void span_flat(const struct setup *s, const struct span *p)
{
    uint32_t *color = p->color;
    uint16_t *depth = p->depth;
    uint32_t z = p->z, c = s->color & 0xffffffu, dz = (uint32_t)p->dz;
    int32_t n = p->b - p->a, i = 0;
    do {
        uint32_t code = z >> 16;
        if (code > depth[i]) {
            depth[i] = (uint16_t)code;
            color[i] = c;
        }
        z += dz;
    } while (++i < n);
}

/* ------------------------------------------------------------------ texture coordinates */

/* The blocks of a span: from the first pixel that the frame shows, wherever it is cut; the last one takes the pixel at
 * its end as well. */
struct walk {
    int32_t x, last;        /* where the next block begins; the span's last pixel */
    int32_t start;          /* where the one before began */
    int32_t q, u, v;        /* planes there */
    int32_t at_u, at_v;     /* coordinates there: texels q16, or turns 2^(32 - shift) */
    int32_t nearness;       /* quadratic: middle / (k q), q15. Divided: relative change of q per pixel, q16 */
    struct smear_texture_run run;       /* of the block before x */
};

/* Coordinates from planes. Slivers, whose planes are anything, give anything: it wraps. */
SMEAR_INLINE void walk_find(struct walk *w, const struct setup *s)
{
    const struct texture_setup *t = &s->texture;
    if (t->mode == TEXTURE_QUADRATIC) {
        uint32_t n = (uint32_t)w->q >> 16, k = t->recip_base + (n * n >> 17);
        int32_t u = (w->u >> 16) * (int32_t)k, v = (w->v >> 16) * (int32_t)k;
        w->nearness = (int32_t)k;
        if (!t->turns) {
            u >>= t->shift;
            v >>= t->shift;
        }
        w->at_u = add_wrap(t->u_base, u);
        w->at_v = add_wrap(t->v_base, v);
    } else if (t->mode == TEXTURE_AFFINE) {
        w->at_u = w->u;
        w->at_v = w->v;
    } else {
        uint32_t q = (uint32_t)max_i32(w->q, 1 << 11);
        int zeros = count_leading_zeros(q);                     /* at least 1 */
        int32_t r = (int32_t)recip_norm(q << zeros);            /* 1/q = r 2^(zeros - 61) */
        /* |U| <= q (and a step more by rounding), so U 2^(zeros - 2) fits; its quotient is the ratio in q27. */
        int32_t u = mulh_i32(shl_wrap(w->u >> 1, zeros - 1), r);
        int32_t v = mulh_i32(shl_wrap(w->v >> 1, zeros - 1), r);
        const struct smear_sampler *m = &s->draw->sampler;
        w->at_u = t->turns ? u : smear_sampler_texel_u(m, shl_wrap(u, 2));
        w->at_v = t->turns ? v : smear_sampler_texel_v(m, shl_wrap(v, 2));
        if (t->bent)
            w->nearness = mulh_i32(t->slope, r) >> (20 - zeros);
    }
}

/* Goes on by a block; returns how many pixels it has.
 *
 * Along a row u'' = -2 u' q'/q: with the chord's step d and b = d q'/q, the parabola from the chord's start to its end
 * has steps d + b (n - 2), 4 b less every 2 pixels. */
SMEAR_INLINE int32_t walk_on(struct walk *w, const struct setup *s)
{
    const struct texture_setup *t = &s->texture;
    const int up = t->up;
    int32_t n = min_i32(t->block, w->last - w->x);
    w->run.at = packed_uv((uint32_t)w->at_u << up, (uint32_t)w->at_v << up);
    w->run.bend = 0;
    w->start = w->x;
    if (n == 0)
        return 1;
    int32_t u = w->at_u, v = w->at_v, nearness = w->nearness;
    w->x += n;
    w->q = add_wrap(w->q, mul_wrap(t->q.dx, n));
    w->u = add_wrap(w->u, mul_wrap(t->u.dx, n));
    w->v = add_wrap(w->v, mul_wrap(t->v.dx, n));
    walk_find(w, s);
    int32_t du = sub_wrap(w->at_u, u), dv = sub_wrap(w->at_v, v);
    if (n == BLOCK_MAX) {
        du >>= 4;
        dv >>= 4;
    } else {
        du = mulh_i32(du, inverse[n]) * 4;
        dv = mulh_i32(dv, inverse[n]) * 4;
    }
    if (t->bent) {
        nearness += w->nearness;                                                /* q'/q, q16: */
        int32_t rate = t->mode == TEXTURE_QUADRATIC ? mul_wrap(t->slope, nearness) >> 17 : nearness >> 1;
        int32_t bu = mul_wrap(du >> 13, rate) >> 1, bv = mul_wrap(dv >> 13, rate) >> 1;     /* 4 b */
        du = add_wrap(du, mul_wrap(bu >> 2, n - 2));
        dv = add_wrap(dv, mul_wrap(bv >> 2, n - 2));
        w->run.bend = 0u - packed_step((uint32_t)bu << up, (uint32_t)bv << up);
    }
    w->run.step = packed_step((uint32_t)du << up, (uint32_t)dv << up);
    return n + (w->x == w->last);
}

static SMEAR_NOINLINE int32_t walk_next(struct walk *w, const struct setup *s)
{
    return walk_on(w, s);
}

SMEAR_INLINE void walk_begin(struct walk *w, const struct setup *s, const struct span *p, int32_t block)
{
    w->last = min_i32(p->right, s->frame->width) - 1;
    w->x = max_i32(p->left, 0);
    w->x += max_i32(min_i32(p->a, w->last - 1) - w->x, 0) & -block;
}

SMEAR_INLINE void walk_place(struct walk *w, const struct setup *s, int32_t x, int32_t y)
{
    const struct texture_setup *t = &s->texture;
    w->q = plane_at(&t->q, x, y);
    w->u = plane_at(&t->u, x, y);
    w->v = plane_at(&t->v, x, y);
    w->nearness = 0;
}

/* The first block. */
static SMEAR_NOINLINE int32_t walk_first(struct walk *w, const struct setup *s, const struct span *p)
{
    const struct texture_setup *t = &s->texture;
    walk_begin(w, s, p, t->block);
    walk_place(w, s, w->x, p->y);
    walk_find(w, s);
    return walk_on(w, s);
}

/* ------------------------------------------------------------------ plain texels */

SMEAR_INLINE uint32_t packed_index(uint64_t uv, int log2_width, int log2_height)
{
    return (uint32_t)uv >> (32 - log2_height) << log2_width | (uint32_t)(uv >> 32) >> (32 - log2_width);
}

SMEAR_INLINE void texel_pixel(uint32_t *color, uint16_t *depth, uint32_t z, const uint32_t *texels, uint64_t uv,
                              int log2_width, int log2_height)
{
    uint16_t code = (uint16_t)(z >> 16);
    if (code > *depth) {
        *depth = code;
        *color = texels[packed_index(uv, log2_width, log2_height)];
    }
}

/* Nearest texels, opaque, unlit, 32-bit, sizes powers of two, repeated: the plain case. */
SMEAR_INLINE void span_texel(const struct setup *s, const struct span *p, int log2_width, int log2_height)
{
    const uint32_t *texels = s->draw->sampler.texels;
    const uint32_t dz = (uint32_t)p->dz;
    uint32_t *color = p->color;
    uint16_t *depth = p->depth;
    uint32_t z = p->z;
    struct walk w;
    int32_t a = p->a, count = walk_first(&w, s, p);
    for (;;) {
        int32_t skip = a - w.start, n = min_i32(w.start + count, p->b) - a, rest = 0;
        uint64_t uv = w.run.at, step = w.run.step, bend = w.run.bend;
        a += n;
        if (skip > 0) {             /* a cut of the frame within the block: to the end of a piece, then on */
            for (; skip >= 2; skip -= 2) {
                uv += 2 * step;
                step += bend;
            }
            if (skip != 0) {
                uv += step;
                rest = n - 1;
                n = 1;
            }
        }
        for (;;) {
            for (; n >= 4; n -= 4, depth += 4, color += 4) {
                texel_pixel(color, depth, z, texels, uv, log2_width, log2_height);
                z += dz;
                uv += step;
                texel_pixel(color + 1, depth + 1, z, texels, uv, log2_width, log2_height);
                z += dz;
                uv += step;
                step += bend;
                texel_pixel(color + 2, depth + 2, z, texels, uv, log2_width, log2_height);
                z += dz;
                uv += step;
                texel_pixel(color + 3, depth + 3, z, texels, uv, log2_width, log2_height);
                z += dz;
                uv += step;
                step += bend;
            }
            if (n >= 2) {
                texel_pixel(color, depth, z, texels, uv, log2_width, log2_height);
                z += dz;
                uv += step;
                texel_pixel(color + 1, depth + 1, z, texels, uv, log2_width, log2_height);
                z += dz;
                uv += step;
                step += bend;
                n -= 2;
                depth += 2;
                color += 2;
            }
            if (n != 0) {
                texel_pixel(color++, depth++, z, texels, uv, log2_width, log2_height);
                z += dz;
                uv += step;
            }
            if (rest == 0)
                break;
            step += bend;
            n = rest;
            rest = 0;
        }
        if (a >= p->b)
            return;
        count = walk_next(&w, s);
    }
}

/* Where blocks would be single pixels: a quotient for each. */
static void span_exact(const struct setup *s, const struct span *p)
{
    const struct texture_setup *t = &s->texture;
    const struct smear_sampler *m = &s->draw->sampler;
    const uint32_t *texels = m->texels;
    uint32_t z = p->z;
    struct walk w;
    walk_place(&w, s, p->a, p->y);
    for (int32_t i = 0; i < p->b - p->a; i++) {
        if ((uint16_t)(z >> 16) > p->depth[i]) {
            walk_find(&w, s);
            p->depth[i] = (uint16_t)(z >> 16);
            p->color[i] = texels[sampler_index(m, (uint32_t)w.at_u << t->up, (uint32_t)w.at_v << t->up)];
        }
        z += (uint32_t)p->dz;
        w.q = add_wrap(w.q, t->q.dx);
        w.u = add_wrap(w.u, t->u.dx);
        w.v = add_wrap(w.v, t->v.dx);
    }
}

static void span_texel_64(const struct setup *s, const struct span *p) { span_texel(s, p, 6, 6); }
static void span_texel_128(const struct setup *s, const struct span *p) { span_texel(s, p, 7, 7); }
static void span_texel_256(const struct setup *s, const struct span *p) { span_texel(s, p, 8, 8); }

static void span_texel_any(const struct setup *s, const struct span *p)
{
    span_texel(s, p, s->draw->sampler.log2_width, s->draw->sampler.log2_height);
}

/* ------------------------------------------------------------------ everything else */

/* Value of a channel whose plane is value / w, q16. */
static inline int32_t channel_over_w(int32_t over_w, int zeros, int32_t r)
{
    return clamp_i32(mulh_i32(shl_wrap(over_w >> 1, zeros - 1), r) >> 3, 0, 0xffffff);
}

/* A block of a span: where it begins and ends in the triangle's row, and where drawing begins. Values are exact at its
 * ends, which no cut of the frame moves. */
struct block {
    int32_t start, end, x;
};

/* Channels r g b a (q16) at pixel x of a block, and their steps. Opaque draws have alpha one. */
static void channels_at(const struct setup *s, const struct span *p, const struct block *k, uint32_t c[4],
                        uint32_t d[4])
{
    int count = s->draw->alpha == SMEAR_OPAQUE ? 3 : 4;
    int32_t x = k->x, x0 = k->start, x1 = k->end;
    c[3] = 255u << 16;
    d[3] = 0;
    if (!s->perspective_color) {
        for (int i = 0; i < count; i++) {
            c[i] = (uint32_t)plane_at(&s->channel[i], x, p->y);
            d[i] = (uint32_t)s->channel[i].dx;
        }
        return;
    }
    uint32_t q0 = (uint32_t)max_i32(plane_at(&s->depth, x0, p->y), 1);
    uint32_t q1 = (uint32_t)max_i32(plane_at(&s->depth, x1, p->y), 1);
    int zeros0 = count_leading_zeros(q0), zeros1 = count_leading_zeros(q1);
    int32_t r0 = (int32_t)recip_norm(q0 << zeros0), r1 = (int32_t)recip_norm(q1 << zeros1);
    for (int i = 0; i < count; i++) {
        int32_t a = channel_over_w(plane_at(&s->channel[i], x0, p->y), zeros0, r0);
        int32_t b = channel_over_w(plane_at(&s->channel[i], x1, p->y), zeros1, r1);
        int32_t step = x1 > x0 ? mulh_i32(b - a, inverse[x1 - x0]) * 4 : 0;
        c[i] = (uint32_t)(a + step * (x - x0));
        d[i] = (uint32_t)step;
    }
}

/* Multiplies n texels by the light of the triangle: flat, or interpolated. */
static void modulate(uint32_t *texel, const struct setup *s, const struct span *p, const struct block *k,
                     int32_t n)
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
    uint32_t c[4], d[4];
    channels_at(s, p, k, c, d);
    uint32_t a = c[3], da = d[3];
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
static void shade_plain(uint32_t *out, const struct setup *s, const struct span *p, const struct block *k,
                     int32_t n)
{
    uint32_t c[4], d[4];
    channels_at(s, p, k, c, d);
    uint32_t r = c[0], g = c[1], b = c[2], a = c[3], dr = d[0], dg = d[1], db = d[2], da = d[3];
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
                        int32_t n, const struct setup *s, uint32_t *mask, int32_t first)
{
    if (s->draw->alpha == SMEAR_CUTOUT) {
        for (int32_t i = 0; i < n; i++, z += (uint32_t)dz) {
            if (z >> 16 <= depth[i] || pixel_alpha(in[i]) < s->draw->cutoff)
                continue;
            depth[i] = (uint16_t)(z >> 16);
            color[i] = in[i] & 0xffffffu;
            if (mask != NULL)
                mask[(first + i) >> 5] |= 1u << ((first + i) & 31);
        }
        return;
    }
    if (s->draw->alpha == SMEAR_BLEND) {
        for (; n > 0; n--, in++, color++, depth++, z += (uint32_t)dz)
            if (z >> 16 > *depth)
                *color = pixel_blend(*color, *in, pixel_alpha(*in), s->frame->linear);
        return;
    }
    for (; n > 0; n--, in++, color++, depth++, z += (uint32_t)dz) {
        uint32_t code = z >> 16;
        if (code > *depth) {
            *depth = (uint16_t)code;
            *color = *in & 0xffffffu;
        }
    }
}

/* Blocks without a texture. */
static int32_t plain_next(struct walk *w, const struct setup *s)
{
    int32_t n = min_i32(s->color_block, w->last - w->x);
    w->start = w->x;
    w->x += n;
    return n + (w->x == w->last);
}

static int32_t plain_first(struct walk *w, const struct setup *s, const struct span *p)
{
    walk_begin(w, s, p, s->color_block);
    return plain_next(w, s);
}

/* In blocks: texels, then light, then the write. */
static void span_general(const struct setup *s, const struct span *p)
{
    uint32_t block[BLOCK_MAX + 1];
    uint32_t *color = p->color;
    uint16_t *depth = p->depth;
    uint32_t z = p->z;
    bool textured = s->segment->uv != 0;
    struct walk w;
    struct block k;
    k.x = p->a;
    int32_t count, n;
    if (textured)
        count = walk_first(&w, s, p);
    else
        count = plain_first(&w, s, p);
    for (;;) {
        n = min_i32(w.start + count, p->b) - k.x;
        k.start = w.start;
        k.end = min_i32(w.start + count, w.last);
        if (textured) {
            smear_sample(block, &s->draw->sampler, &w.run, k.x - k.start, n);
            if (s->segment->shade != SHADE_NONE)
                modulate(block, s, p, &k, n);
        } else if (s->segment->shade == SHADE_GOURAUD) {
            shade_plain(block, s, p, &k, n);
        } else {
            for (int32_t i = 0; i < n; i++)
                block[i] = s->color;
        }
        write_block(block, color, depth, z, p->dz, n, s, p->mask, k.x - p->a);
        k.x += n;
        color += n;
        depth += n;
        z += (uint32_t)p->dz * (uint32_t)n;
        if (k.x >= p->b)
            return;
        count = textured ? walk_next(&w, s) : plain_next(&w, s);
    }
}

smear_span_fn *smear_span_choose(const struct setup *s)
{
    const struct smear_segment *g = s->segment;
    if (s->draw->alpha != SMEAR_OPAQUE)
        return span_general;
    if (g->uv == 0)
        return g->shade == SHADE_GOURAUD ? span_general : span_flat;
    const struct smear_sampler *t = &s->draw->sampler;
    if (g->shade != SHADE_NONE || !t->turns || t->format != SMEAR_TEXEL_8888 || t->log2_width == 0
        || t->log2_height == 0)
        return span_general;
    if (s->texture.block == 1)
        return span_exact;
    if (t->width != t->height)
        return span_texel_any;
    return t->width == 64 ? span_texel_64 : t->width == 128 ? span_texel_128
         : t->width == 256 ? span_texel_256 : span_texel_any;
}
