/* SPDX-License-Identifier: MIT */
/* span.c - inner loops of the raster: flat, and everything else in blocks. */
#include "raster/span.h"

#include "raster/texcoord.h"
#include "base/pixel.h"
#include "kernels/flat_run.h"

static void span_of_color(const struct setup *s, const struct span *p, uint32_t pixel)
{
    const uint32_t color = target_pixel(s->target, pixel);
    if (target_is_direct(s->target))
        flat_run_reference(p->color, p->depth, p->b - p->a, p->z, (uint32_t)p->dz, color, true);
    else
        flat_run_reference(p->color, p->depth, p->b - p->a, p->z, (uint32_t)p->dz, color, false);
}

void smear_span_flat(const struct setup *s, const struct span *p) { span_of_color(s, p, s->color); }

#if SMEAR_WITH_FOG
void smear_span_level(const struct setup *s, const struct span *p)
{
    span_of_color(s, p, smear_fog_row_color(s, max_i32(p->left, 0), min_i32(p->right, s->frame->width), p->y));
}
#endif

uint32_t smear_span_darkened(uint32_t pixel, uint32_t over, smear_transfer t) { return blended_pixel(pixel, over, true, t); }

/* By polynomials, of any row; what is as before becomes what that did. Codes that have no shadow yet become darker by two products. */
void smear_span_texels_shadow(const struct setup *s, const struct span *p)
{
    const struct smear_sampler *const m = &s->draw->sampler;
    const smear_transfer transfer = frame_transfer(s->frame);
    struct texcoord c = texcoord_curved(&s->texture, m, p->a, p->y, true);
    const uint8_t *const texels = (const uint8_t *)m->texels;
    const uint32_t *const palette = m->palette, dz = (uint32_t)p->dz, pair = 0xff00ffu;
    const int up = m->log2_width, from_u = 31 - up, from_v = 31 - m->log2_height;      /* sampler_index */
    uint32_t *color = (uint32_t *)p->color, z = p->z, last = 0, from = 0, dark = 0;
    const uint16_t *depth = p->depth, *const end = depth + (p->b - p->a);
    for (; !SMEAR_SMALL_CODE && depth != end; depth++, color++, z += dz) {
        const uint32_t over = palette[texels[(c.v >> 1 >> from_v) << up | c.u >> 1 >> from_u]], was = *color;
        c.u += c.du, c.du -= c.curvature_u;
        c.v += c.dv, c.dv -= c.curvature_v;
        if (over >> 24 <= was >> 24 || z >> 16 <= *depth)
            continue;
        if (over != last || was != from) {
            const uint32_t rest = 256u - (over >> 24) - (over >> 31);
            last = over, from = was;
            if ((over << 8 | was >> 24 | transfer) != 0)
                dark = smear_span_darkened(was, over, transfer);
            else
                dark = over | (((was & pair) * rest + 0x800080u) >> 8 & pair) | (pixel_green(was) * rest + 0x80u) >> 8 << 8;
        }
        *color = dark;
    }
}

/* ------------------------------------------------------------------ blocks */

/* The blocks of a span: from the first pixel that the frame shows, wherever it is cut; the last one takes the
 * pixel at its end as well, unless blocks are single pixels. */
struct walk {
    int32_t x, last, y;     /* where the next block begins; the span's last pixel; its row */
    int32_t start;          /* where the one before began */
    int32_t block;          /* their pixels */
    int32_t q, u, v;        /* planes at x */
    struct place place;     /* there */
    struct smear_texture_run run;       /* of the block before x */
};

/* Goes on by a block; returns how many pixels it has. */
static int32_t walk_next(struct walk *w, const struct setup *s)
{
    const struct texture_setup *t = &s->texture;
    const struct place from = w->place;
    int32_t n = block_next(w->block, w->last - w->x);
    const int32_t count = n + (w->x + n == w->last && (n == 0 || w->block > 1));
    w->start = w->x;
    w->x += n;
    if (t->mode == TEXTURE_CURVED) {
        w->run = texcoord_packed(texcoord_curved(t, &s->draw->sampler, w->start, w->y, t->turns));
        return count;
    }
    w->q = add_wrap(w->q, mul_wrap(t->q.dx, n));
    w->u = add_wrap(w->u, mul_wrap(t->uv[0].dx, n));
    w->v = add_wrap(w->v, mul_wrap(t->uv[1].dx, n));
    w->place = place_at(t, t->mode, &s->draw->sampler, w->q, w->u, w->v, t->turns);
    w->run = texcoord_packed(texcoord_between(t, from, w->place, n, t->turns));
    return count;
}

static void walk_begin(struct walk *w, const struct setup *s, const struct span *p, bool textured)
{
    int32_t left = max_i32(p->left, 0), right = min_i32(p->right, s->frame->width);
    w->last = right - 1;
    w->block = textured ? block_of(&s->texture, left, right) : s->color_block;
    w->x = block_start(left, w->last, p->a, w->block);
    w->y = p->y;
}

/* The first block. */
static int32_t walk_first(struct walk *w, const struct setup *s, const struct span *p)
{
    const struct texture_setup *t = &s->texture;
    walk_begin(w, s, p, true);
    if (t->mode == TEXTURE_CURVED)
        return walk_next(w, s);
    w->q = plane_at(&t->q, w->x, p->y);
    w->u = plane_at(&t->uv[0], w->x, p->y);
    w->v = plane_at(&t->uv[1], w->x, p->y);
    w->place = place_at(t, t->mode, &s->draw->sampler, w->q, w->u, w->v, t->turns);
    return walk_next(w, s);
}

/* A block of a span: where it begins and ends in the triangle's row, and where drawing begins. Values are
 * exact at its ends, which no cut of the frame moves. */
struct block {
    int32_t start, end, x;
};

/* Channels r g b a (q16) at pixel x of a block, and their steps. Opaque draws have alpha one. */
static void channels_at(const struct setup *s, const struct span *p, const struct block *k, uint32_t c[4],
                        uint32_t d[4])
{
    const int count = draw_is_opaque(s->draw) ? 3 : 4;
    const bool in_fog = has_channels_in_fog(s);
    int32_t from[4], to[4], step[4] = { 0, 0, 0, 0 };
    c[3] = 255u << 16;
    d[3] = 0;
    if (!in_fog && !s->perspective_color) {
        for (int i = 0; i < count; i++) {
            c[i] = (uint32_t)plane_at(&s->channel[i], k->x, p->y);
            d[i] = (uint32_t)s->channel[i].dx;
        }
        return;
    }
    const int32_t left = max_i32(p->left, 0), right = min_i32(p->right, s->frame->width);
    if (SMEAR_WITH_FOG && in_fog && fog_row_is_even(s, left, right)) {
        const uint32_t color = smear_fog_row_color(s, left, right, p->y);
        for (int i = 0; i < 3; i++) {
            c[i] = (uint32_t)channel_value_of_code(s->frame, color >> (16 - 8 * i) & 255u);
            d[i] = 0;
        }
        return;
    }
    channels_of_pixel(from, s, count, k->start, p->y);
    channels_of_pixel(to, s, count, k->end, p->y);
    if (k->end > k->start)
        channel_steps(step, from, to, count, k->end - k->start, s);
    for (int i = 0; i < count; i++) {
        c[i] = (uint32_t)(from[i] + step[i] * (k->x - k->start));
        d[i] = (uint32_t)step[i];
    }
}

/* Multiplies n texels by the light of the triangle: flat, or interpolated. */
static void modulate(uint32_t *texel, const struct setup *s, const struct span *p, const struct block *k,
                     int32_t n)
{
    const smear_transfer transfer = frame_transfer(s->frame);
    uint32_t c[4], d[4] = { 0, 0, 0, 0 };
    if (s->segment->shade == SHADE_FLAT) {
        for (int i = 0; i < 3; i++)
            c[i] = channel_of_code(s->color >> (16 - 8 * i) & 255u, transfer);
        c[3] = pixel_alpha(s->color) << 16;
    } else {
        channels_at(s, p, k, c, d);
    }
    uint32_t a = c[3], da = d[3];
    for (; n > 0; n--, texel++) {
        uint32_t t = *texel;
        *texel = pixel_make(code_times(pixel_alpha(t), a >> 16 & 255u), code_times_channel(pixel_red(t), c[0], transfer),
                            code_times_channel(pixel_green(t), c[1], transfer), code_times_channel(pixel_blue(t), c[2], transfer));
        for (int i = 0; i < 3; i++)
            c[i] += d[i];
        a += da;
    }
}

/* Interpolated colours without a texture. */
static void shade_untextured(uint32_t *out, const struct setup *s, const struct span *p, const struct block *k,
                             int32_t n)
{
    uint32_t c[4], d[4];
    channels_at(s, p, k, c, d);
    const smear_transfer transfer = frame_transfer(s->frame);
    uint32_t r = c[0], g = c[1], b = c[2], a = c[3], dr = d[0], dg = d[1], db = d[2], da = d[3];
    for (; n > 0; n--, r += dr, g += dg, b += db, a += da)
        *out++ = (a << 8 & 0xff000000u)
               | pixel_of_channels(r & 0xffffffu, g & 0xffffffu, b & 0xffffffu, transfer);
}

/* Writes a block of colours: depth test, cutout, blend. */
static void write_block(const uint32_t *in, void *pixels, uint16_t *depth, uint32_t z, int32_t dz,
                        int32_t n, const struct setup *s, uint32_t *mask, int32_t first)
{
    uint32_t *color = (uint32_t *)pixels;
    if (target_is_direct(s->target)) {
        uint32_t least = s->draw->alpha == SMEAR_CUTOUT ? s->draw->cutoff : 0;
        uint16_t *narrow = (uint16_t *)pixels;
        for (; n > 0; n--, in++, narrow++, depth++, z += (uint32_t)dz)
            if (z >> 16 > *depth && pixel_alpha(*in) >= least) {
                *depth = (uint16_t)(z >> 16);
                *narrow = (uint16_t)rgb565_nearest(*in);
            }
        return;
    }
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
    if (draw_is_blended(s->draw)) {
        for (; n > 0; n--, in++, color++, depth++, z += (uint32_t)dz)
            if (z >> 16 > *depth)
                *color = blended_pixel(*color, *in, draw_is_shadow(s->draw), frame_transfer(s->frame));
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

/* n colours of a block, in fog. */
static SMEAR_NOINLINE void fog_block(uint32_t *pixel, const struct setup *s, const struct span *p, const struct walk *w, int32_t n)
{
    const int32_t left = max_i32(p->left, 0), right = min_i32(p->right, s->frame->width);
    const int32_t part = smear_fog_run_part(s, left, right, w->start, w->x - w->start, p->y);
    for (; n > 0; n--, pixel++)
        *pixel = fog_pixel(s->frame, *pixel, part);
}

/* Blocks without a texture. */
static int32_t untextured_next(struct walk *w)
{
    int32_t n = block_next(w->block, w->last - w->x);
    w->start = w->x;
    w->x += n;
    return n + (w->x == w->last);
}

static int32_t untextured_first(struct walk *w, const struct setup *s, const struct span *p)
{
    walk_begin(w, s, p, false);
    return untextured_next(w);
}

/* In blocks: texels, then light, then the write. */
void smear_span_general(const struct setup *s, const struct span *p)
{
    uint32_t block[COLOR_BLOCK_MAX + 1];
    void *color = p->color;
    uint16_t *depth = p->depth;
    uint32_t z = p->z;
    bool textured = segment_textured(s->segment);
    struct walk w;
    struct block k;
    k.x = p->a;
    int32_t count, n;
    if (textured)
        count = walk_first(&w, s, p);
    else
        count = untextured_first(&w, s, p);
    for (;;) {
        while (k.x >= w.start + count)
            count = textured ? walk_next(&w, s) : untextured_next(&w);
        n = min_i32(min_i32(w.start + count, p->b) - k.x, COLOR_BLOCK_MAX + 1);
        k.start = w.start;
        k.end = min_i32(w.start + count, w.last);
        if (textured) {
            smear_sample(block, &s->draw->sampler, &w.run, k.x - k.start, n);
            if (s->segment->shade != SHADE_NONE)
                modulate(block, s, p, &k, n);
        } else if (segment_gouraud(s->segment) || has_channels_in_fog(s)) {
            shade_untextured(block, s, p, &k, n);
        } else {
            for (int32_t i = 0; i < n; i++)
                block[i] = s->color;
        }
        if (SMEAR_WITH_FOG && fog_of(s) != FOG_NONE && !has_channels_in_fog(s))
            fog_block(block, s, p, &w, n);
        write_block(block, color, depth, z, p->dz, n, s, p->mask, k.x - p->a);
        k.x += n;
        color = pixel_after(color, n, target_is_direct(s->target));
        depth += n;
        z += (uint32_t)p->dz * (uint32_t)n;
        if (k.x >= p->b)
            return;
    }
}
