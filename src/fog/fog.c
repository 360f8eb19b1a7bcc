/* SPDX-License-Identifier: MIT */
/* fog.c - see raster/fog.h. */
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

/* The largest difference of a channel. */
static uint32_t contrast(uint32_t a, uint32_t b)
{
    uint32_t most = 0;
    for (int shift = 0; shift < 24; shift += 8)
        most = max_u32(most, (uint32_t)abs_i32((int32_t)(a >> shift & 255u) - (int32_t)(b >> shift & 255u)));
    return most;
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
    f->contrast = (uint8_t)max_u32(contrast(f->color, 0), contrast(f->color, 0xffffffu));
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
    f->scale = min_u32((q.mantissa + (1u << 13)) >> 14, 0xffffu);
    f->shift = (int8_t)(q.shift + 6);
    f->base = quotient_round(quotient_of((uint64_t)begin << 16, range));
    if (fog->near_plane > camera->near_plane) {
        q = quotient_of(nearest, begin);
        q.shift -= 11;
        f->near_units = quotient_round(q);
    }
    f->zeros = (uint8_t)count_leading_zeros((uint32_t)max_i32(f->near_units, 1));
}

int32_t smear_fog_part(const struct smear_fog_levels *fog, int32_t units)
{
    uint32_t q = (uint32_t)max_i32(units, 1);
    if (units >= fog->near_units)
        return 0;
    if (SMEAR_WITH_VIEWS && fog->flat_depth)
        return clamp_i32(fog->base - (int32_t)(mulh_u32(fog->scale, q) >> clamp_i32(fog->shift, 0, 31)), 0, 65536);
    int zeros = SMEAR_HAS_CLZ ? count_leading_zeros(q) : fog->zeros;        /* few are left, as fog ends where it does */
    for (q <<= zeros; !SMEAR_HAS_CLZ && (int32_t)q >= 0; q <<= 1)
        zeros++;
    const uint32_t over = fog->scale * ((recip_norm(q) + (1u << 13)) >> 14);        /* 1 / q = r 2^(zeros - 61) */
    return clamp_i32((int32_t)(over >> clamp_i32(fog->shift - zeros, 1, 31)) - fog->base, 0, 65536);
}

/* ------------------------------------------------------------------ a triangle */

/* A code in the numbers of codes below. */
enum { CODE = 16 };

/* By how much a channel of the colour, or of black or white where that is null, changes between two parts of fog. */
static uint32_t codes_between(const struct smear_raster_frame *frame, const uint32_t *color, int32_t part, int32_t other)
{
    const struct smear_fog_levels *fog = frame_fog(frame);
    if (!frame_is_linear(frame))
        return ((uint32_t)(part - other) * (color != NULL ? contrast(*color, fog->color) : fog->contrast) + 4095u) >> 12;
    if (color != NULL)
        return CODE * contrast(fog_pixel(frame, *color, part), fog_pixel(frame, *color, other));
    return CODE * max_u32(contrast(fog_pixel(frame, 0, part), fog_pixel(frame, 0, other)),
                          contrast(fog_pixel(frame, 0xffffffu, part), fog_pixel(frame, 0xffffffu, other)));
}

/* Codes by which one part of fog may be off at a triangle's nearest and farthest vertex together. */
enum { FOG_STEP = 4 * CODE };

/* Returns the part of fog that is near enough for all depths from low to high, units q11, of a colour or, where that is null, of
 * any; -1: none is. */
static int32_t fog_between(const struct smear_raster_frame *frame, int32_t low, int32_t high, const uint32_t *color)
{
    const struct smear_fog_levels *fog = frame_fog(frame);
    if (low >= fog->near_units)
        return 0;
    const int32_t most = smear_fog_part(fog, low), least = smear_fog_part(fog, high);
    if (codes_between(frame, NULL, most, least) > FOG_STEP
        && (color == NULL || codes_between(frame, color, most, least) > FOG_STEP))
        return -1;
    return (most + least) >> 1;
}

/* The triangle's colour, where it has one. */
static inline const uint32_t *one_color(const struct setup *s)
{
    return !segment_textured(s->segment) && !segment_gouraud(s->segment) ? &s->color : NULL;
}

static inline int32_t lowest(const struct setup *s)
{
    return min_i32(s->v[0][VERTEX_DEPTH], min_i32(s->v[1][VERTEX_DEPTH], s->v[2][VERTEX_DEPTH]));
}

static inline int32_t highest(const struct setup *s)
{
    return max_i32(s->v[0][VERTEX_DEPTH], max_i32(s->v[1][VERTEX_DEPTH], s->v[2][VERTEX_DEPTH]));
}

void smear_fog_triangle(struct setup *s)
{
    const uint32_t *color = one_color(s);
    const int32_t part = fog_between(s->frame, lowest(s), highest(s), color);
    s->fog = FOG_NONE;
    if (part < 0)
        s->fog = FOG_VARIES;
    else if (part >= 2 && color != NULL)
        s->color = fog_pixel(s->frame, *color, part);
    else if (part >= 2)
        s->fog = (uint16_t)(FOG_EVEN + ((part + 2) >> 2));
}

/* Blocks within which fog changes by more than so many codes are halved: where fog begins, a block errs by up to a quarter
 * of that. */
enum { FOG_BLOCK = 8 * CODE };

/* Codes by which fog may change along a row that has one colour. */
enum { FOG_ROW = 2 * CODE };

/* The most pixels of a row that may have one part of fog, which changes by `codes` in 16, or FOG_LEVEL for rows of any length. */
static int32_t even_pixels(const struct setup *s, uint32_t codes, uint32_t most)
{
    const int32_t left = max_i32(s->bounds.x0 >> 8, 0), right = min_i32(s->bounds.x1 >> 8, s->frame->width - 1);
    const int32_t even = codes == 0 ? INT32_MAX : (int32_t)(16 * most / codes);
    return right - left < even ? FOG_LEVEL : min_i32(even, FOG_LEVEL - 1);
}

void smear_fog_blocks(struct setup *s)
{
    const struct smear_fog_levels *fog = frame_fog(s->frame);
    const int32_t low = lowest(s), high = highest(s), most = smear_fog_part(fog, low), least = smear_fog_part(fog, high);
    const uint32_t over_16 = min_u32(magnitude_i32(s->depth.dx), 1u << 26) * 16u;
    /* the part and its base change by as much of them as 1 / q */
    const uint32_t sum = (uint32_t)most + (fog->flat_depth ? 0u : (uint32_t)fog->base);
    const uint32_t change = min_u32(smear_times_over(over_16, sum, (uint32_t)max_i32(low, 1)), 16u << 16);
    const uint32_t all = codes_between(s->frame, one_color(s), most, least);
    const uint32_t steep = all * (change >> 4) / ((uint32_t)(most - least + 15) >> 4), codes = min_u32(all, steep);
    if (segment_textured(s->segment) || !draw_is_opaque(s->draw)) {
        /* one part for a block, which errs by up to half */
        const int32_t even = even_pixels(s, steep, FOG_STEP);
        const int32_t block = even >= BLOCK_LONGEST ? BLOCK_LONGEST : even >= BLOCK_LONG ? BLOCK_LONG : even >= 16 ? 16 : even >= 8 ? 8 : 4;
        s->fog = (uint16_t)(FOG_VARIES + (even == FOG_LEVEL ? FOG_LEVEL : block));
        s->color_block = (uint8_t)min_i32(s->color_block, block);
        return;
    }
    if (!segment_gouraud(s->segment))
        s->fog = (uint16_t)(FOG_VARIES + even_pixels(s, steep, FOG_ROW));
    if (codes <= FOG_BLOCK / 4 && !s->perspective_color)
        s->color_block = BLOCK_LONGEST;
    else if (codes > FOG_BLOCK)
        s->color_block = (uint8_t)min_i32(s->color_block, codes <= 2 * FOG_BLOCK ? 8 : 4);
}

/* ------------------------------------------------------------------ pixels */

static int32_t part_at(const struct setup *s, int32_t x, int32_t y)
{
    return smear_fog_part(frame_fog(s->frame), plane_at(&s->depth, x, y));
}

uint32_t smear_fog_row_color(const struct setup *s, int32_t left, int32_t right, int32_t y)
{
    return fog_pixel(s->frame, s->color, part_at(s, (left + right) >> 1, y));
}

void smear_fog_steps(int32_t step[3], int32_t from[3], const int32_t to[3], int32_t n, const struct smear_raster_frame *frame)
{
    const int32_t little = frame_is_linear(frame) ? 0 : 3 << 15;        /* a code and a half */
    int32_t most = 0;
    for (int i = 0; i < 3; i++)
        most = max_i32(most, abs_i32(to[i] - from[i]));
    for (int i = 0; i < 3; i++) {
        step[i] = most > little ? part_by(to[i] - from[i], inverse_of(n)) : 0;
        from[i] = most > little ? from[i] : (from[i] + to[i]) >> 1;
    }
}

int32_t smear_fog_run_part(const struct setup *s, int32_t left, int32_t right, int32_t start, int32_t n, int32_t y)
{
    if (fog_is_even(s))
        return fog_even_part(s);
    return fog_is_by_rows(s) || right - left <= SHORT_SPAN ? part_at(s, (left + right) >> 1, y) : part_at(s, start + (n >> 1), y);
}

#endif
