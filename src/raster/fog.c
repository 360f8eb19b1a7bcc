/* SPDX-License-Identifier: MIT */
/* fog.c - see fog.h. */
#include "raster/fog.h"

#include "raster/texcoord.h"

#if SMEAR_WITH_FOG

/* ------------------------------------------------------------------ a frame */

/* a / b = mantissa 2^-shift, a mantissa of 29 or 30 bits. */
struct quotient {
    uint32_t mantissa;
    int shift;
};

static struct quotient quotient_of(uint64_t a, uint32_t b)
{
    const int zeros = count_leading_zeros_64(a | 1), zeros_b = count_leading_zeros(b);
    const uint32_t top = (uint32_t)(a << zeros >> 32);              /* a = top 2^(32 - zeros) */
    return (struct quotient){ mulh_u32(top, recip_norm_precise(b << zeros_b)), zeros - zeros_b - 3 };
}

/* To nearest, at most INT32_MAX. */
static int32_t quotient_round(struct quotient q)
{
    if (q.shift <= 0)
        return q.mantissa >> max_i32(31 + q.shift, 0) != 0 ? INT32_MAX : (int32_t)(q.mantissa << -q.shift);
    return q.shift > 31 ? 0 : (int32_t)(((q.mantissa >> (q.shift - 1)) + 1u) >> 1);
}

void smear_fog_make(struct smear_raster_frame *frame, const smear_fog *fog, const smear_camera *camera)
{
    struct smear_fog_levels *f = &frame->fog;
    f->on = fog != NULL;
    if (fog == NULL)
        return;
    const uint32_t range = (uint32_t)(fog->far_plane - fog->near_plane), begin = (uint32_t)fog->near_plane;
    struct quotient q;
    f->color = fog->color & 0xffffffu;
    f->flat_depth = SMEAR_WITH_VIEWS && camera->half_height > 0;
    f->near_units = INT32_MAX;
    if (f->flat_depth) {        /* part = base - units q11 (far - near) 2^16 / (range NEAR 2^11) */
        const uint32_t over_units = 0xf0f2b67eu;        /* 2^62 / (NEAR 2^11) */
        q = quotient_of((uint64_t)(uint32_t)(camera->far_plane - camera->near_plane) << 16, range);
        f->scale = mulh_u32(q.mantissa, over_units);
        f->shift = (int8_t)(q.shift - 2);
        f->base = quotient_round(quotient_of((uint64_t)(uint32_t)max_i32(camera->far_plane - fog->near_plane, 0) << 16, range));
        return;
    }
    /* part = near NEAR 2^11 2^16 / (range units q11) - base */
    const uint64_t nearest = (uint64_t)(uint32_t)camera->near_plane * SMEAR_DEPTH_NEAR;
    q = quotient_of(nearest, range);
    f->scale = q.mantissa;
    f->shift = (int8_t)(q.shift + 2);
    f->base = quotient_round(quotient_of((uint64_t)begin << 16, range));
    if (fog->near_plane > camera->near_plane) {
        q = quotient_of(nearest, begin);
        q.shift -= 11;
        f->near_units = quotient_round(q);
    }
}

int32_t smear_fog_part(const struct smear_fog_levels *fog, int32_t units)
{
    const uint32_t q = (uint32_t)max_i32(units, 1);
    if (units >= fog->near_units)
        return 0;
    if (SMEAR_WITH_VIEWS && fog->flat_depth)
        return clamp_i32(fog->base - (int32_t)(mulh_u32(fog->scale, q) >> clamp_i32(fog->shift, 0, 31)), 0, 65536);
    const int zeros = count_leading_zeros(q);       /* 1 / q = r 2^(zeros - 61) */
    const uint32_t over = mulh_u32(fog->scale, recip_norm(q << zeros));
    return clamp_i32((int32_t)(over >> clamp_i32(fog->shift - zeros, 0, 31)) - fog->base, 0, 65536);
}

/* ------------------------------------------------------------------ a triangle */

uint32_t smear_fog_contrast(const struct smear_raster_frame *frame, uint32_t color)
{
    const uint32_t fog = frame_fog(frame)->color;
    uint32_t most = 0;
    for (int shift = 0; shift < 24; shift += 8)
        most = max_u32(most, (uint32_t)abs_i32((int32_t)(color >> shift & 255u) - (int32_t)(fog >> shift & 255u)));
    return most;
}

/* What fog adds from the nearest to the farthest vertex by which a triangle with one part of it is off, half of it each:
 * codes, q16. */
enum { FOG_STEP = 4 << 16 };

int32_t smear_fog_between(const struct smear_fog_levels *fog, int32_t low, int32_t high, uint32_t contrast)
{
    const int32_t most = smear_fog_part(fog, low), least = smear_fog_part(fog, high);
    return (uint32_t)(most - least) * contrast > FOG_STEP ? -1 : (int32_t)fog_part_256((most + least) >> 1);
}

static inline bool has_one_color(const struct setup *s)
{
    return !segment_textured(s->segment) && !segment_gouraud(s->segment);
}

static inline uint32_t contrast_of(const struct setup *s)
{
    return has_one_color(s) ? smear_fog_contrast(s->frame, s->color) : 255u;
}

void smear_fog_triangle(struct setup *s)
{
    const struct smear_fog_levels *fog = frame_fog(s->frame);
    const int32_t q0 = s->v[0][VERTEX_DEPTH], q1 = s->v[1][VERTEX_DEPTH], q2 = s->v[2][VERTEX_DEPTH];
    const int32_t low = min_i32(q0, min_i32(q1, q2)), high = max_i32(q0, max_i32(q1, q2));
    s->fog = FOG_NONE;
    if (low >= fog->near_units)
        return;
    const int32_t part = smear_fog_between(fog, low, high, contrast_of(s));
    if (part < 0) {
        s->fog = FOG_VARIES;
    } else if (has_one_color(s)) {
        s->color = fog_pixel(s->frame, s->color, (uint32_t)part);
    } else if (part != 0) {
        s->fog = FOG_EVEN;
        s->fog_part = (uint8_t)(part - 1);
    }
}

/* Blocks within which fog changes by more than so many codes are halved: where fog begins, a block errs by up to a quarter
 * of that. */
enum { FOG_BLOCK = 8 };

void smear_fog_blocks(struct setup *s)
{
    const struct smear_fog_levels *fog = frame_fog(s->frame);
    const int32_t q0 = s->v[0][VERTEX_DEPTH], q1 = s->v[1][VERTEX_DEPTH], q2 = s->v[2][VERTEX_DEPTH];
    const int32_t low = min_i32(q0, min_i32(q1, q2)), high = max_i32(q0, max_i32(q1, q2));
    uint32_t change = min_u32(magnitude_i32(s->depth.dx), 1u << 26) * 16u;
    if (change < (uint32_t)(high - low)) {
        /* The part and its base change by as much of them as 1 / q. */
        const uint32_t sum = (uint32_t)smear_fog_part(fog, low) + (fog->flat_depth ? 0u : (uint32_t)fog->base);
        change = smear_times_over(change, sum, (uint32_t)low) * contrast_of(s) >> 16;
    } else {
        change = (uint32_t)(smear_fog_part(fog, low) - smear_fog_part(fog, high)) * contrast_of(s) >> 16;
    }
    if (change <= FOG_BLOCK / 4 && !s->perspective_color)
        s->color_block = BLOCK_LONGEST;
    else if (change > FOG_BLOCK)
        s->color_block = (uint8_t)min_i32(s->color_block, change <= 2 * FOG_BLOCK ? 8 : 4);
}

/* ------------------------------------------------------------------ pixels */

static int32_t part_at(const struct setup *s, int32_t x, int32_t y)
{
    return smear_fog_part(frame_fog(s->frame), plane_at(&s->depth, x, y));
}

/* Channels without fog. */
static void channels_at(int32_t c[3], const struct setup *s, int32_t x, int32_t y)
{
    if (!segment_gouraud(s->segment)) {
        for (int i = 0; i < 3; i++)
            c[i] = channel_of_code(s->color >> (16 - 8 * i) & 255u, frame_is_linear(s->frame));
        return;
    }
    const uint32_t q = (uint32_t)max_i32(plane_at(&s->depth, x, y), 1);
    const int zeros = count_leading_zeros(q);
    const int32_t recip = (int32_t)recip_norm(q << zeros);
    for (int i = 0; i < 3; i++) {
        c[i] = plane_at(&s->channel[i], x, y);
        if (s->perspective_color)
            c[i] = channel_over_w(c[i], zeros, recip);
    }
}

void smear_fog_channels(int32_t c[3], const struct setup *s, int32_t x, int32_t y)
{
    const int32_t part = s->fog == FOG_EVEN ? (int32_t)fog_even_part(s) << 8 : part_at(s, x, y);
    channels_at(c, s, x, y);
    for (int i = 0; i < 3; i++) {
        const uint32_t code = frame_fog(s->frame)->color >> (16 - 8 * i) & 255u;
        c[i] += ((channel_of_code(code, frame_is_linear(s->frame)) - c[i]) >> 9) * part >> 7;
    }
}

void smear_fog_pixels(uint32_t *pixel, const struct setup *s, int32_t x, int32_t n, int32_t start, int32_t end, int32_t y)
{
    int32_t part, step = 0;
    if (s->fog == FOG_EVEN) {
        part = (int32_t)fog_even_part(s) << 8;
    } else {
        part = part_at(s, start, y);
        if (end > start) {
            step = (part_at(s, end, y) - part) / (end - start);
            part += step * (x - start);
        }
    }
    for (; n > 0; n--, pixel++, part += step)
        *pixel = fog_pixel(s->frame, *pixel, fog_part_256(part));
}

#endif
