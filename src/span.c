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

/* The planes at a pixel, from which its texture coordinates follow. */
struct texture_point {
    int32_t q, u, v;
};

SMEAR_INLINE struct texture_point point_at(const struct setup *s, int32_t x, int32_t y)
{
    return (struct texture_point){ plane_at(&s->depth, x, y), plane_at(&s->u, x, y),
                                   plane_at(&s->v_, x, y) };
}

SMEAR_INLINE void point_step(struct texture_point *p, const struct setup *s, int32_t n)
{
    p->q = add_wrap(p->q, mul_wrap(s->depth.dx, n));
    p->u = add_wrap(p->u, mul_wrap(s->u.dx, n));
    p->v = add_wrap(p->v, mul_wrap(s->v_.dx, n));
}

static inline int32_t shift_either(int32_t a, int up)
{
    return up >= 0 ? shl_wrap(a, up) : a >> -up;
}

/* Texels, q16: the quotients u/w over 1/w. */
SMEAR_INLINE void point_texel(const struct setup *s, const struct texture_point *p, int32_t out[2])
{
    const struct smear_sampler *t = &s->draw->sampler;
    if (!s->perspective) {
        out[0] = p->u;
        out[1] = p->v;
        return;
    }
    uint32_t q = (uint32_t)max_i32(p->q, 1);
    int zeros = count_leading_zeros(q);
    int32_t r = (int32_t)recip_norm(q << zeros);            /* 1/q = r 2^(zeros - 61) */
    /* |U| <= q (and a step more by rounding), so U 2^(zeros - 2) fits; its quotient is the ratio in q27. */
    int32_t u = mulh_i32(shl_wrap(p->u, zeros - 2), r), v = mulh_i32(shl_wrap(p->v, zeros - 2), r);
    if (t->masked) {
        out[0] = shift_either(u, t->up_u);
        out[1] = shift_either(v, t->up_v);
    } else {
        out[0] = sampler_texel_u(t, shl_wrap(u, 2));
        out[1] = sampler_texel_v(t, shl_wrap(v, 2));
    }
}

/* Texture coordinates along a span, in blocks of at most 16 pixels. Blocks start at multiples of their size or at the
 * triangle's first pixel, never at a cut of the frame: cuts must not show. */
struct walk {
    int32_t x;              /* next pixel */
    struct texture_point point;
    int32_t here[2];        /* texels at pixel `x` */
    int32_t next[2];        /* texels after the block */
    int32_t step[2];
};

SMEAR_INLINE void walk_start(struct walk *w, const struct setup *s, const struct span *p)
{
    w->x = s->perspective ? max_i32(p->left, p->a & -(1 << s->block_shift)) : p->a;
    w->point = point_at(s, w->x, p->y);
    point_texel(s, &w->point, w->here);
}

/* Fits the block that begins at `x`; returns how many of its pixels, from p->a on, are to be drawn. */
SMEAR_INLINE int32_t walk_block(struct walk *w, const struct setup *s, const struct span *p)
{
    int32_t size = 1 << s->block_shift, n;
    if (!s->perspective) {
        w->step[0] = s->u.dx;
        w->step[1] = s->v_.dx;
        n = min_i32((w->x & -size) + size, p->b) - w->x;
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
    point_step(&w->point, s, n);
    point_texel(s, &w->point, w->next);
    int32_t du = sub_wrap(w->next[0], w->here[0]), dv = sub_wrap(w->next[1], w->here[1]);
    if (n == size) {
        w->step[0] = du >> s->block_shift;
        w->step[1] = dv >> s->block_shift;
    } else {
        w->step[0] = mulh_i32(du, inverse[n]) * 4;
        w->step[1] = mulh_i32(dv, inverse[n]) * 4;
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

/* Unlit opaque texels, nearest, repeated, 32-bit, sizes powers of two up to 256: the plain case, in one loop. Both
 * coordinates share a word, v above u, 8.8 each: one addition steps both, and what u carries into v is 1/256 texel. */
static void span_texel(const struct setup *s, const struct span *p)
{
    const struct smear_sampler *t = &s->draw->sampler;
    const uint32_t *texels = t->texels;
    uint32_t mask_u = t->mask_u, mask_v = t->mask_v;
    int down = 24 - t->log2_width;
    uint32_t *color = p->color;
    uint16_t *depth = p->depth;
    uint32_t z = p->z, dz = (uint32_t)p->dz;
    struct walk w;
    walk_start(&w, s, p);
    while (w.x < p->b) {
        int32_t n = walk_block(&w, s, p);
        uint32_t uv = (uint32_t)(w.here[1] >> 8) << 16 | ((uint32_t)w.here[0] >> 8 & 0xffffu);
        uint32_t step = ((uint32_t)((w.step[1] + 128) >> 8) << 16) + (uint32_t)((w.step[0] + 128) >> 8);
        for (int32_t i = 0; i < n; i++) {
            uint32_t code = z >> 16;
            if (code > depth[i]) {
                depth[i] = (uint16_t)code;
                color[i] = texels[(uv >> down & mask_v) | (uv >> 8 & mask_u)];
            }
            z += dz;
            uv += step;
        }
        if (n > 0) {
            color += n;
            depth += n;
        }
        w.here[0] = w.next[0];
        w.here[1] = w.next[1];
    }
}

/* Value of a channel whose plane is value / w, q16. */
static inline int32_t channel_over_w(int32_t over_w, int zeros, int32_t r)
{
    return clamp_i32(mulh_i32(shl_wrap(over_w, zeros - 2), r) >> 3, 0, 0xffffff);
}

/* Channels r g b a (q16) at pixel x and their steps, good up to the next multiple of 16. Opaque draws have alpha one. */
static void channels_at(const struct setup *s, const struct span *p, int32_t x, uint32_t c[4],
                        uint32_t d[4])
{
    int count = s->draw->alpha == SMEAR_OPAQUE ? 3 : 4;
    c[3] = 255u << 16;
    d[3] = 0;
    if (!s->perspective_color) {
        for (int i = 0; i < count; i++) {
            c[i] = (uint32_t)plane_at(&s->channel[i], x, p->y);
            d[i] = (uint32_t)s->channel[i].dx;
        }
        return;
    }
    /* Exact at the ends of the block of 16 pixels (or the triangle's), which no cut of the frame moves. */
    int32_t x0 = max_i32(x & -BLOCK_MAX, p->left), x1 = min_i32((x & -BLOCK_MAX) + BLOCK_MAX, p->right - 1);
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

/* Multiplies n texels by the light of the triangle: flat, or interpolated from pixel x on. */
static void modulate(uint32_t *texel, const struct setup *s, const struct span *p, int32_t x, int32_t n)
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
    channels_at(s, p, x, c, d);
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
static void shade_plain(uint32_t *out, const struct setup *s, const struct span *p, int32_t x, int32_t n)
{
    uint32_t c[4], d[4];
    channels_at(s, p, x, c, d);
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
                    modulate(block, s, p, x, n);
            }
            w.here[0] = w.next[0];
            w.here[1] = w.next[1];
            if (n <= 0)
                continue;
        } else {
            n = min_i32((x & -BLOCK_MAX) + BLOCK_MAX, p->b) - x;
            if (s->segment->shade == SHADE_GOURAUD)
                shade_plain(block, s, p, x, n);
            else
                for (int32_t i = 0; i < n; i++)
                    block[i] = s->color;
        }
        write_block(block, color, depth, z, p->dz, n, s, p->mask, x - p->a);
        x += n;
        color += n;
        depth += n;
        z += (uint32_t)p->dz * (uint32_t)n;
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
    bool plain = g->shade == SHADE_NONE && t->masked && t->width <= 256 && t->height <= 256
              && !t->bilinear && t->format == SMEAR_TEXEL_8888 && t->wrap_u == SMEAR_REPEAT
              && t->wrap_v == SMEAR_REPEAT;
    return plain ? span_texel : span_general;
}
