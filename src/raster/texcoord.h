/* SPDX-License-Identifier: MIT */
/* texcoord.h - texture coordinates along a row: polynomials, or exact where blocks of pixels meet
 * and chords or parabolas between (setup.h). And colours, exact there, too. */
#ifndef SMEAR_TEXCOORD_H
#define SMEAR_TEXCOORD_H

#include "raster/fog.h"

#include "kernels/texel_run.h"

/* a / n for n up to 16, good to 2^-16 of it; exact where n is a power of two. */
static inline int32_t part_of(int32_t a, int32_t n) { return part_by(a, inverse[n]); }

/* Coordinates from planes. Slivers, whose planes are anything, give anything: it wraps. */
SMEAR_INLINE struct place place_at(const struct texture_setup *t, enum texture_mode mode,
                                   const struct smear_sampler *m, int32_t q, int32_t u, int32_t v, bool turns)
{
    struct place p = { u, v, 0 };
    if (mode == TEXTURE_DIVIDED) {
        p = place_divided(q, u, v, t->slope, t->parabolic);
        if (!turns) {
            p.u = smear_sampler_texel(m, 0, shl_wrap(p.u, 2) >> t->spare);
            p.v = smear_sampler_texel(m, 1, shl_wrap(p.v, 2) >> t->spare);
        }
    }
    return p;
}

/* From one place to another n pixels further on. */
SMEAR_INLINE struct texcoord texcoord_between(const struct texture_setup *t, struct place from, struct place to,
                                              int32_t n, bool turns)
{
    return places_between(from, to, n, t->up, t->parabolic, turns);
}

/* Where polynomials hold: from pixel (x, y) on. */
SMEAR_INLINE struct texcoord texcoord_curved(const struct texture_setup *t, const struct smear_sampler *m,
                                             int32_t x, int32_t y, bool turns)
{
    uint32_t word[2][3];
    x -= t->x0;
    y -= t->y0;
    for (int i = 0; i < 2; i++) {
        const struct curve *c = &t->curve[i];
        int32_t dx = add_wrap(c->dx, mul_wrap(c->dxy, y)), along = mul_wrap(c->dxx, x);
        int32_t at = add_wrap(c->at, mul_wrap(add_wrap(c->dy, mul_wrap(c->dyy, y)), y));
        int32_t value[3] = { add_wrap(at, mul_wrap(add_wrap(dx, along), x)),
                             add_wrap(dx, mul_wrap(c->dxx, 2 * x + 1)), mul_wrap(c->dxx, -2) };
        for (int k = 0; k < 3; k++)
            word[i][k] = (uint32_t)(turns ? value[k] : smear_sampler_texel(m, i, value[k]));
    }
    return (struct texcoord){ word[0][0], word[1][0], word[0][1], word[1][1], word[0][2], word[1][2] };
}

/* Value of a channel whose plane is value / w, q16. */
static inline int32_t channel_over_w(int32_t over_w, int zeros, int32_t r)
{
    return clamp_i32(mulh_i32(shl_wrap(over_w >> 1, zeros - 1), r) >> 3, 0, 0xffffff);
}

/* Whether fog goes into channels; else into pixels. */
static inline bool has_channels_in_fog(const struct setup *s)
{
    return fog_of(s) != FOG_NONE && !segment_textured(s->segment) && draw_is_opaque(s->draw);
}

/* Channels r g b and, where `count` is 4, a of a pixel as channel_value has them: in fog, where that goes into them. */
SMEAR_INLINE void channels_of_pixel(int32_t c[4], const struct setup *s, int count, int32_t x, int32_t y)
{
    const int32_t units = plane_at(&s->depth, x, y);
    if (s->perspective_color) {
        const uint32_t q = (uint32_t)max_i32(units, 1);
        const int zeros = count_leading_zeros(q);
        const int32_t recip = (int32_t)recip_norm(q << zeros);
        for (int i = 0; i < count; i++)
            c[i] = channel_over_w(plane_at(&s->channel[i], x, y), zeros, recip);
    } else if (segment_gouraud(s->segment)) {
        for (int i = 0; i < count; i++)
            c[i] = plane_at(&s->channel[i], x, y);
    } else {
        for (int i = 0; i < count; i++)
            c[i] = channel_value_of_code(s->frame, s->color >> (16 - 8 * i) & 255u);
    }
    if (SMEAR_WITH_FOG && has_channels_in_fog(s)) {
        const int32_t part = smear_fog_part(frame_fog(s->frame), units);
        for (int i = 0; i < 3; i++)
            c[i] = fog_channel(s->frame, c[i], i, part);
    }
}

/* Their steps from one end of a block of n > 0 pixels to the other; in fog `from` may become the mean (smear_fog_steps). */
SMEAR_INLINE void channel_steps(int32_t step[4], int32_t from[4], const int32_t to[4], int count, int32_t n, const struct setup *s)
{
    if (SMEAR_WITH_FOG && has_channels_in_fog(s))
        smear_fog_steps(step, from, to, n, s->frame);
    else
        for (int i = 0; i < count; i++)
            step[i] = part_of(to[i] - from[i], n);
}

SMEAR_INLINE struct smear_texture_run texcoord_packed(struct texcoord c)
{
    return (struct smear_texture_run){ packed_uv(c.u, c.v), packed_step(c.du, c.dv),
                                       0u - packed_step(c.curvature_u, c.curvature_v) };
}

/* In blocks of so many pixels: of a span that is short, single ones,
 * which cost less but where polynomials hold. */
static inline int32_t block_of(const struct texture_setup *t, int32_t left, int32_t right)
{
    return right - left <= SHORT_SPAN && t->mode != TEXTURE_CURVED ? 1 : t->block;
}

#endif
