/* SPDX-License-Identifier: MIT */
/* looks8.c - see looks8.h. Functions are those of setup.c for eight triangles. */
#include "raster/looks8.h"

#include "kernels/wide8.h"
#include "raster/cover.h"

#if SMEAR_AVX2

/* What all planes are made of. */
struct faces8 {
    struct lanes8_four word[3];             /* of records, the depth and those behind it */
    lanes8i q[3], low_q, high_q;            /* depths */
    lanes8i x, y;                           /* of vertex 0: its pixel, */
    lanes8i fx, fy;                         /* and from there to the pixel's centre, q8 */
    lanes8i recip, zeros;                   /* as in struct planes8 */
    lanes8i x1, y1, x2, y2;                 /* edges, q8 */
    lanes8i depth_dx, depth_dy;
    lanes8i bounds[4];
};

static inline SMEAR_AVX2_FUNCTION void faces8_make(struct faces8 *f, const struct poses *p, const struct planes8 *planes)
{
    const struct corner8 first = corner8_of(p, 0);
    for (int j = 0; j < 3; j++) {
        for (int word = 0; word < 4; word++)
            f->word[j].of[word] = lanes8i_load(p->word[j][VERTEX_DEPTH + word]);
        f->q[j] = f->word[j].of[0];
    }
    f->low_q = lanes8i_min3(f->q[0], f->q[1], f->q[2]);
    f->high_q = lanes8i_max3(f->q[0], f->q[1], f->q[2]);
    f->x = first.x >> 8;
    f->y = first.y >> 8;
    f->fx = 128 - (first.x & 255);
    f->fy = 128 - (first.y & 255);
    f->x1 = lanes8i_load(planes->x1);
    f->y1 = lanes8i_load(planes->y1);
    f->x2 = lanes8i_load(planes->x2);
    f->y2 = lanes8i_load(planes->y2);
    f->recip = lanes8i_load(planes->area_recip);
    f->zeros = lanes8i_load(planes->area_zeros);
    f->depth_dx = lanes8i_load(planes->dx);
    f->depth_dy = lanes8i_load(planes->dy);
    for (int i = 0; i < 4; i++)
        f->bounds[i] = lanes8i_load(p->bounds[i]);
}

/* Those whose boxes are so large that textured ones are made ready here. */
SMEAR_AVX2_INLINE uint32_t large8(const struct faces8 *f)
{
    const lanes8i width = ((f->bounds[2] + 127) >> 8) - ((f->bounds[0] + 127) >> 8);
    const lanes8i height = ((f->bounds[3] + 127) >> 8) - ((f->bounds[1] + 127) >> 8);
    return lanes8i_signs(lanes8i_max(width, height) > (int32_t)SMALL_TEXTURED_PX);
}

/* ------------------------------------------------------------------ planes */

/* Sums and products modulo 2^32. */
SMEAR_AVX2_INLINE lanes8i add8(lanes8i a, lanes8i b) { return (lanes8i)((lanes8)a + (lanes8)b); }
SMEAR_AVX2_INLINE lanes8i sub8(lanes8i a, lanes8i b) { return (lanes8i)((lanes8)a - (lanes8)b); }
SMEAR_AVX2_INLINE lanes8i mul8(lanes8i a, lanes8i b) { return (lanes8i)((lanes8)a * (lanes8)b); }

/* The larger one of numbers without a sign. */
SMEAR_AVX2_INLINE lanes8i max8(lanes8i a, lanes8i b) { return (lanes8i)_mm256_max_epu32((__m256i)a, (__m256i)b); }

/* A value at each vertex, and how much it may change per pixel: a plane that is steeper has no exact pixels. */
struct values8 {
    lanes8i at[3], steep;
};

/* Makes planes through values: smear_plane_make(). */
static SMEAR_AVX2_FUNCTION void planes8_make(struct plane8 *out, const struct faces8 *f, const struct values8 *values, int count)
{
    for (int i = 0; i < count; i++) {
        const lanes8i a0 = values[i].at[0], steep = values[i].steep;
        const lanes8i d1 = sub8(values[i].at[1], a0), d2 = sub8(values[i].at[2], a0);
        lanes8i dx = gradient8(wide8_cross(d1, f->y2, d2, f->y1), f->recip, f->zeros);
        lanes8i dy = gradient8(wide8_cross(d2, f->x1, d1, f->x2), f->recip, f->zeros);
        const lanes8i beyond = (lanes8i_abs(dx) > steep) | (lanes8i_abs(dy) > steep);
        dx &= ~beyond;
        dy &= ~beyond;
        const lanes8i here = add8(a0, add8(part8(dx, f->fx), part8(dy, f->fy)));
        lanes8i_store(out[i].at, sub8(here, add8(mul8(dx, f->x), mul8(dy, f->y))));
        lanes8i_store(out[i].dx, dx);
        lanes8i_store(out[i].dy, dy);
    }
}

/* 1 / c, so that quotients are products shifted to the right; c has 1 to 19 leading zeros. */
struct over8 {
    lanes8 recip;
    lanes8i shift;
};

SMEAR_AVX2_INLINE struct over8 over8_make(lanes8i c)
{
    const lanes8i zeros = lanes8i_zeros(c);
    return (struct over8){ lanes8_recip_norm(lanes8_left((lanes8)c, zeros)), 29 - zeros };
}

/* smear_times_over(a, b, c), but for what is larger than INT32_MAX, which it is then. */
SMEAR_AVX2_INLINE lanes8i times_over8(lanes8i a, lanes8i b, const struct over8 *c)
{
    const lanes8 over = lanes8_mulh((lanes8)a, c->recip), high = lanes8_mulh(over, (lanes8)b);
    const lanes8 r = lanes8_left(high, 32 - c->shift) | lanes8_right(over * (lanes8)b, c->shift);
    return lanes8i_choose((lanes8i)lanes8_right(high, c->shift - 1) == 0, (lanes8i)r, lanes8i_all(INT32_MAX));
}

/* ------------------------------------------------------------------ colours */

/* channel_value() of one half of a word of each vertex. */
SMEAR_AVX2_INLINE lanes8i level8(lanes8i word, int half, bool linear)
{
    const lanes8i a = half != 0 ? (lanes8i)((lanes8)word >> 16 << 8) : (word & 0xffff) << 8;
    return linear ? lanes8i_min(lanes8i_max(a, lanes8i_all(0x400)), lanes8i_all(0xffe000)) : lanes8i_min(a + 0x8000, lanes8i_all(0xff8000));
}

SMEAR_AVX2_INLINE void values8_load(struct values8 *v, const struct faces8 *f, int word, int half, bool linear)
{
    v->at[0] = level8(f->word[0].of[word], half, linear);
    v->at[1] = level8(f->word[1].of[word], half, linear);
    v->at[2] = level8(f->word[2].of[word], half, linear);
    v->steep = lanes8i_all(1 << 28);
}

/* All ones where the words of all vertices are equal. */
SMEAR_AVX2_INLINE lanes8i flat8(const struct faces8 *f, int word)
{
    const lanes8i *const a = f->word[0].of + word, *const b = f->word[1].of + word, *const c = f->word[2].of + word;
    return ((a[0] ^ b[0]) | (a[0] ^ c[0]) | (((a[1] ^ b[1]) | (a[1] ^ c[1])) & 0xffff)) == 0;
}

/* Colours of those that have one. */
SMEAR_AVX2_INLINE lanes8 color8(const struct values8 value[3], bool linear)
{
    const lanes8 r = (lanes8)value[0].at[0], g = (lanes8)value[1].at[0], b = (lanes8)value[2].at[0];
    return linear ? lanes8_encode_pixels(r >> 12, g >> 12, b >> 12)
                  : (r & 0xff0000u) | (g >> 8 & 0xff00u) | b >> 16;
}

/* times_q16(), of a channel and the depth. */
SMEAR_AVX2_INLINE lanes8i over_w8(lanes8i value, lanes8i q)
{
    const lanes8i a = value >> 8;
    return a * (q >> 16) + (lanes8i)((lanes8)a * (lanes8)(q & 0xffff) >> 16);
}

SMEAR_AVX2_INLINE lanes8i range8(const struct values8 *v)
{
    return lanes8i_max3(v->at[0], v->at[1], v->at[2]) - lanes8i_min3(v->at[0], v->at[1], v->at[2]);
}

/* Chooses how colours follow from planes; values become those over w. */
static inline SMEAR_AVX2_FUNCTION void colors8_choose(struct looks8 *out, const struct faces8 *f, struct values8 value[4], int channels,
                                                      bool flat_depth)
{
    lanes8i range = lanes8i_max3(range8(&value[0]), range8(&value[1]), range8(&value[2]));
    if (channels > 3)
        range = lanes8i_max(range, range8(&value[3]));
    out->even = lanes8i_signs(range == 0);
    lanes8i_store(out->color_block, lanes8i_all(16));
    if (flat_depth)
        return;
    const struct over8 low = over8_make(f->low_q);
    const lanes8i span = f->high_q - f->low_q;
    const lanes8i perspective = times_over8(span, range >> 8, &low) > 4 * 128;
    out->perspective = lanes8i_signs(perspective);
    if (out->perspective == 0)
        return;
    const lanes8i over_16 = lanes8i_min(lanes8i_abs(f->depth_dx), lanes8i_all(1 << 26)) << 4;
    const lanes8i off = times_over8(lanes8i_min(over_16, span), range >> 8, &low);
    lanes8i_store(out->color_block, 16 - (perspective & (off > 4 * 256) & 8) - (perspective & (off > 16 * 256) & 4));
    for (int c = 0; c < channels; c++) {
        lanes8i *const at = value[c].at;
        at[0] = lanes8i_choose(perspective, over_w8(at[0], f->q[0]), at[0]);
        at[1] = lanes8i_choose(perspective, over_w8(at[1], f->q[1]), at[1]);
        at[2] = lanes8i_choose(perspective, over_w8(at[2], f->q[2]), at[2]);
    }
}

static inline SMEAR_AVX2_FUNCTION void colors8_make(struct looks8 *out, const struct faces8 *f, const struct smear_raster_frame *frame,
                                                    const struct smear_segment *segment, uint32_t wanted)
{
    const bool opaque = draw_is_opaque(&frame->draw[segment->draw]), linear = frame_is_linear(frame);
    const int channels = opaque ? 3 : 4, word = segment->color - VERTEX_DEPTH;
    struct values8 value[4];
    values8_load(&value[0], f, word, 0, linear);
    values8_load(&value[1], f, word, 1, linear);
    values8_load(&value[2], f, word + 1, 0, linear);
    if (!opaque)
        values8_load(&value[3], f, word + 1, 1, false);
    if (opaque && !segment_textured(segment)) {
        out->flat = lanes8i_signs(flat8(f, word));
        if ((wanted & out->flat) != 0)
            lanes8_store(out->color, color8(value, linear));
    }
    if ((wanted & ~out->flat) == 0)
        return;
    colors8_choose(out, f, value, channels, segment_flat_depth(segment));
    planes8_make(out->channel, f, value, channels);
}

/* ------------------------------------------------------------------ texture */

/* Coordinates, mesh units. */
struct coordinates8 {
    const struct smear_sampler *sampler;
    lanes8i uv[2][3], middle[2], width[2];
    lanes8i travel;                 /* texels, q6 */
    lanes8i flat;                   /* all ones: needs no perspective */
};

SMEAR_AVX2_INLINE lanes8i texel8(const struct smear_sampler *m, int axis, lanes8i ratio)
{
    const int32_t scale = m->scale[axis], shift = m->shift[axis];
    const lanes8i t = scale == 1 << 29 ? ratio >> 3 : lanes8i_mulh(ratio, lanes8i_all(scale));
    return shift >= 0 ? (lanes8i)((lanes8)t << (uint32_t)shift) : t >> -shift;
}

SMEAR_AVX2_INLINE lanes8i texels8_q6(const struct smear_sampler *m, int axis, lanes8i ratio)
{
    return lanes8i_abs(texel8(m, axis, ratio) >> 10);
}

static inline SMEAR_AVX2_FUNCTION void coordinates8_make(struct coordinates8 *k, const struct faces8 *f,
                                                         const struct smear_segment *segment)
{
    k->travel = lanes8i_all(0);
    for (int j = 0; j < 3; j++) {
        const lanes8 pair = (lanes8)f->word[j].of[segment->uv - VERTEX_DEPTH];
        k->uv[0][j] = lanes8_pair_x(pair);
        k->uv[1][j] = lanes8_pair_y(pair);
    }
    for (int i = 0; i < 2; i++) {
        const lanes8i low = lanes8i_min3(k->uv[i][0], k->uv[i][1], k->uv[i][2]);
        const lanes8i high = lanes8i_max3(k->uv[i][0], k->uv[i][1], k->uv[i][2]);
        k->middle[i] = (low + high) >> 1;
        k->width[i] = high - low;
        k->travel = lanes8i_max(k->travel, texels8_q6(k->sampler, i, k->width[i] << 14));
    }
    const lanes8 span = (lanes8)f->high_q - (lanes8)f->low_q, travel = (lanes8)k->travel, product = span * travel;
    const lanes8 limit = (lanes8)f->low_q * (4u * TEXTURE_OFF);
    const lanes8i within = max8((lanes8i)product, (lanes8i)limit) == (lanes8i)limit;
    k->flat = (within & ((lanes8i)lanes8_mulh(span, travel) == 0)) | lanes8i_all(segment_flat_depth(segment) ? -1 : 0);
}

/* scale_sat(a, shift) */
SMEAR_AVX2_INLINE lanes8i scale8(lanes8i a, lanes8i shift)
{
    const lanes8i up = lanes8i_max(shift, lanes8i_all(0)), down = lanes8i_max(-shift, lanes8i_all(0));
    const lanes8i most = lanes8i_all(INT32_MAX), limit = lanes8i_right(most, up);
    const lanes8i rounded = add8(lanes8i_right(a, down), (lanes8i)(lanes8_right((lanes8)a, down - 1) & 1u));
    const lanes8i grown = lanes8i_choose(a > limit, most, lanes8i_choose(a < -limit, -most, lanes8i_left(a, up)));
    return lanes8i_choose(up > 0, grown, rounded);
}

/* struct weights and struct depth_change of setup.c */
struct curves8 {
    lanes8i dx[2], dy[2], shift;
    lanes8i e_at, e_dx, e_dy, e_vertex[3];
};

static inline SMEAR_AVX2_FUNCTION void curves8_weigh(struct curves8 *w, const struct faces8 *f, const struct planes8 *planes)
{
    const lanes8i x1 = lanes8i_load(planes->x1), y1 = lanes8i_load(planes->y1);
    const lanes8i x2 = lanes8i_load(planes->x2), y2 = lanes8i_load(planes->y2);
    const lanes8i longest = lanes8i_abs(x1) | lanes8i_abs(y1) | lanes8i_abs(x2) | lanes8i_abs(y2);
    const lanes8i up = lanes8i_zeros(longest) - 1;
    w->dx[0] = lanes8i_mulh(lanes8i_left(y2, up), f->recip);
    w->dx[1] = -lanes8i_mulh(lanes8i_left(y1, up), f->recip);
    w->dy[0] = -lanes8i_mulh(lanes8i_left(x2, up), f->recip);
    w->dy[1] = lanes8i_mulh(lanes8i_left(x1, up), f->recip);
    w->shift = lanes8i_max(lanes8i_min(f->zeros - up - 21, lanes8i_all(31)), lanes8i_all(-31));
}

/* Makes the polynomials of one coordinate. Returns all ones where they are not steep. */
static inline SMEAR_AVX2_FUNCTION lanes8i curve8_make(struct curve8 *out, const struct curves8 *w, const struct faces8 *f,
                                                      const struct coordinates8 *k, int axis, int32_t step)
{
    const int uv_shift = k->sampler->uv_shift;
    const lanes8i *const u = k->uv[axis], middle = k->middle[axis];
    const lanes8i a0 = mul8(sub8(u[0], middle), w->e_vertex[0]), d1 = sub8(mul8(sub8(u[1], middle), w->e_vertex[1]), a0);
    const lanes8i d2 = sub8(mul8(sub8(u[2], middle), w->e_vertex[2]), a0);
    const lanes8i dx = scale8(add8(lanes8i_mulh(w->dx[0], d1), lanes8i_mulh(w->dx[1], d2)), w->shift);
    const lanes8i dy = scale8(add8(lanes8i_mulh(w->dy[0], d1), lanes8i_mulh(w->dy[1], d2)), w->shift);
    const lanes8i here = add8(a0, add8(part8(dx, f->fx), part8(dy, f->fy)));
    lanes8i value[6] = {
        sub8(add8(middle << 14, here), lanes8i_mulh(here, w->e_at)),
        sub8(sub8(dx, lanes8i_mulh(dx, w->e_at)), lanes8i_mulh(here, w->e_dx)),
        sub8(sub8(dy, lanes8i_mulh(dy, w->e_at)), lanes8i_mulh(here, w->e_dy)),
        -lanes8i_mulh(dx, w->e_dx), sub8(-lanes8i_mulh(dx, w->e_dy), lanes8i_mulh(dy, w->e_dx)), -lanes8i_mulh(dy, w->e_dy)
    };
    for (int i = 0; i < 6 && k->sampler->turns; i++)
        value[i] = add8((lanes8i)((lanes8)value[i] << (uint32_t)(18 - uv_shift)), lanes8i_all(step >> 1)) & -step;
    value[0] = add8(value[0], lanes8i_all(step >> 1));
    for (int i = 0; i < 6; i++)
        lanes8i_store(out->term[i], value[i]);
    return (lanes8i)((lanes8)(lanes8i_abs(dx) | lanes8i_abs(dy)) >> (uint32_t)(12 + uv_shift)) == 0;
}

/* Finds the change of depth. Returns all ones where polynomials are near enough. */
static inline SMEAR_AVX2_FUNCTION lanes8i curves8_change(struct curves8 *w, const struct faces8 *f, const struct coordinates8 *k,
                                                         lanes8i across)
{
    const lanes8i middle = (lanes8i)(((lanes8)f->low_q + (lanes8)f->high_q) >> 1), tilted = ~k->flat;
    const lanes8i up = lanes8i_zeros(middle) - 1;
    const lanes8i recip = (lanes8i)recip_precise8(lanes8_left((lanes8)middle << 1, up));
    const lanes8i half = (f->high_q - f->low_q + 1) >> 1;
    const lanes8i steep = lanes8i_max(lanes8i_abs(f->depth_dx), lanes8i_abs(f->depth_dy));
    const lanes8 most = (lanes8)lanes8i_mulh(lanes8i_left(half, up), recip) << 2;
    const lanes8 square = lanes8_mulh(most, most);
    const lanes8i far = (lanes8i_max(half, steep) > middle >> 2) | (mul8(across, k->travel) > middle)
                      | ((lanes8i)lanes8_mulh(square << 2, (lanes8)k->travel) > (int32_t)CURVED_OFF);
    for (int j = 0; j < 3; j++)
        w->e_vertex[j] = 16384 + (tilted & ((lanes8i_mulh(lanes8i_left(f->q[j] - middle, up), recip) + 0x2000) >> 14));
    w->e_dx = tilted & (lanes8i)((lanes8)lanes8i_mulh(lanes8i_left(f->depth_dx, up), recip) << 4);
    w->e_dy = tilted & (lanes8i)((lanes8)lanes8i_mulh(lanes8i_left(f->depth_dy, up), recip) << 4);
    const lanes8i here = (lanes8i)((lanes8)lanes8i_mulh(lanes8i_left(f->q[0] - middle, up), recip) << 4);
    const lanes8i at = add8(here, add8(part8(w->e_dx, f->fx), part8(w->e_dy, f->fy)));
    w->e_at = tilted & sub8(at, (lanes8i)(square * 3u));
    return k->flat | ~far;
}

/* Makes the polynomials of those that have them. */
static inline SMEAR_AVX2_FUNCTION void curves8_make(struct looks8 *out, const struct faces8 *f, const struct coordinates8 *k,
                                                    const struct planes8 *planes, uint32_t wanted)
{
    const struct smear_sampler *const m = k->sampler;
    const int32_t size = max_i32(m->width, m->height), few = (int32_t)((256u << m->uv_shift) / (uint32_t)size);
    const lanes8i across = lanes8i_max(f->bounds[2] - f->bounds[0], f->bounds[3] - f->bounds[1]) >> 8;
    const lanes8i far = (mul8(across, across) > lanes8i_choose(k->flat, lanes8i_all(1 << 26), lanes8i_all(few))) | (k->travel > 65535)
                      | (k->width[0] > CURVE_TURNS << m->uv_shift);
    struct curves8 w;
    out->curved = 0;
    if ((wanted & ~lanes8i_signs(far)) == 0)
        return;
    const lanes8i near = ~far & curves8_change(&w, f, k, across);
    if ((wanted & lanes8i_signs(near)) == 0)
        return;
    curves8_weigh(&w, f, planes);
    const lanes8i u = curve8_make(&out->curve[0], &w, f, k, 0, 1), v = curve8_make(&out->curve[1], &w, f, k, 1, CURVE_STEP);
    out->curved = lanes8i_signs(near & u & v);
}

/* The larger, or the smaller of numbers of 64 bits. */
SMEAR_AVX2_INLINE __m256i wide_max(__m256i a, __m256i b) { return _mm256_blendv_epi8(b, a, _mm256_cmpgt_epi64(a, b)); }
SMEAR_AVX2_INLINE __m256i wide_min(__m256i a, __m256i b) { return _mm256_blendv_epi8(a, b, _mm256_cmpgt_epi64(a, b)); }

/* The depth at a corner of the box that lies so far from vertex 0, among those there are. */
SMEAR_AVX2_INLINE lanes8i depth8_at(const struct faces8 *f, lanes8i here, lanes8i x, lanes8i y)
{
    const struct wide8 beyond = wide8_cross(f->depth_dx, x, f->depth_dy, -y), at = wide8_of(here);
    const struct wide8 low = wide8_of(f->low_q), high = wide8_of(f->high_q);
    const __m256i even = wide_min(wide_max(_mm256_add_epi64(beyond.even, at.even), low.even), high.even);
    const __m256i odd = wide_min(wide_max(_mm256_add_epi64(beyond.odd, at.odd), low.odd), high.odd);
    return (lanes8i)_mm256_blend_epi32(even, _mm256_slli_epi64(odd, 32), 0xaa);
}

/* Finds the width of what is seen. Returns the least depth there. */
static inline SMEAR_AVX2_FUNCTION lanes8i seen8(struct looks8 *out, const struct faces8 *f, const struct smear_raster_frame *frame)
{
    const lanes8i *const b = f->bounds, none = lanes8i_all(0);
    const lanes8i inside = ((b[0] | b[1]) >= 0) & (b[2] < frame->width << 8) & (b[3] < frame->height << 8);
    const lanes8i x0 = lanes8i_max(b[0] >> 8, none), y0 = lanes8i_max(b[1] >> 8, none);
    const lanes8i x1 = lanes8i_min(b[2] >> 8, lanes8i_all(frame->width - 1)), y1 = lanes8i_min(b[3] >> 8, lanes8i_all(frame->height - 1));
    lanes8i_store(out->width, x1 - x0 + 1);
    if (!lanes8i_any(~inside))
        return f->low_q;
    const lanes8i dx = f->depth_dx, dy = f->depth_dy, margin = (lanes8i_abs(dx) + lanes8i_abs(dy)) >> 1;
    const lanes8i x = lanes8i_choose(dx > 0, x0, x1) - f->x, y = lanes8i_choose(dy > 0, y0, y1) - f->y;
    return lanes8i_choose(inside, f->low_q, depth8_at(f, f->q[0] - margin, x, y));
}

/* Up to this shift of a sampler all ratios up to 2^29 are texels in 31 bits. */
enum { TEXELS_WRAP = 4 };

/* times_q15(a, q) */
SMEAR_AVX2_INLINE lanes8i times8_q15(lanes8i a, lanes8i q)
{
    return add8(mul8(a, q >> 15), mul8(a, q & 0x7fff) >> 15);
}

/* Values of a coordinate: itself where it needs no perspective, elsewhere over w. */
SMEAR_AVX2_INLINE void values8_of_coordinate(struct values8 *v, const struct coordinates8 *k, int axis, const lanes8i q[3])
{
    const lanes8i *const u = k->uv[axis];
    for (int j = 0; j < 3; j++)
        v->at[j] = times8_q15(u[j], q[j]);
    v->steep = lanes8i_choose(k->flat, lanes8i_all(INT32_MAX - 1), lanes8i_all(1 << 28));
    for (int j = 0; j < 3 && lanes8i_any(k->flat); j++)
        v->at[j] = lanes8i_choose(k->flat, k->sampler->turns ? u[j] << 14 : texel8(k->sampler, axis, u[j] << 14), v->at[j]);
}

/* Texels per pixel, q6, of a coordinate over w that changes by dx per pixel, as q does by slope. */
SMEAR_AVX2_INLINE lanes8i worst8(const struct coordinates8 *k, int axis, lanes8i dx, lanes8i slope, const struct over8 *seen)
{
    const lanes8i *const u = k->uv[axis];
    const lanes8i shares[3] = { lanes8i_abs(sub8(dx, times8_q15(u[0], slope))), lanes8i_abs(sub8(dx, times8_q15(u[1], slope))),
                                lanes8i_abs(sub8(dx, times8_q15(u[2], slope))) };
    const lanes8i all = lanes8i_all(1 << 16), most = lanes8i_all(0xffff);
    /* More of it is more texels, but for textures so large that these wrap. */
    if (k->sampler->shift[axis] <= TEXELS_WRAP)
        return texels8_q6(k->sampler, axis, lanes8i_min(times_over8(max8(shares[0], max8(shares[1], shares[2])), all, seen), most) << 13);
    lanes8i worst = lanes8i_all(0);
    for (int j = 0; j < 3; j++)
        worst = lanes8i_max(worst, texels8_q6(k->sampler, axis, lanes8i_min(times_over8(shares[j], all, seen), most) << 13));
    return worst;
}

/* Makes planes of coordinates, or over w and what blocks are chosen by. */
static inline SMEAR_AVX2_FUNCTION void ratios8_make(struct looks8 *out, const struct faces8 *f, const struct coordinates8 *k,
                                                    const struct smear_raster_frame *frame)
{
    const lanes8i up = lanes8i_max(lanes8i_zeros(f->high_q) - 3, lanes8i_all(0));
    const struct over8 seen = over8_make(lanes8i_left(seen8(out, f, frame), up));
    struct values8 value[3];
    value[2].at[0] = lanes8i_left(f->q[0], up);
    value[2].at[1] = lanes8i_left(f->q[1], up);
    value[2].at[2] = lanes8i_left(f->q[2], up);
    value[2].steep = lanes8i_all(INT32_MAX - 1);
    values8_of_coordinate(&value[0], k, 0, value[2].at);
    values8_of_coordinate(&value[1], k, 1, value[2].at);
    planes8_make(out->texture, f, value, 3);
    const lanes8i slope = lanes8i_load(out->texture[2].dx);
    const lanes8i u = worst8(k, 0, lanes8i_load(out->texture[0].dx), slope, &seen);
    const lanes8i v = worst8(k, 1, lanes8i_load(out->texture[1].dx), slope, &seen);
    const lanes8i slope_q = lanes8i_min(lanes8i_abs(slope), lanes8i_all(1 << 27)) << 4;
    lanes8i_store(out->worst, lanes8i_max(u, v));
    lanes8i_store(out->change, lanes8i_min(times_over8(slope_q, lanes8i_all(1 << 12), &seen), lanes8i_all(1 << 16)));
}

static inline SMEAR_AVX2_FUNCTION void textures8_make(struct looks8 *out, const struct faces8 *f, const struct smear_raster_frame *frame,
                                                      const struct smear_segment *segment, const struct planes8 *planes,
                                                      uint32_t wanted)
{
    struct coordinates8 k;
    k.sampler = &frame->draw[segment->draw].sampler;
    coordinates8_make(&k, f, segment);
    curves8_make(out, f, &k, planes, wanted);
    out->affine = lanes8i_signs(k.flat);
    if ((wanted & ~out->curved) != 0)
        ratios8_make(out, f, &k, frame);
}

SMEAR_AVX2_FUNCTION void smear_looks8_avx2(struct looks8 *out, const struct smear_raster_frame *frame,
                                           const struct smear_segment *segment, const struct poses *p, const struct planes8 *planes,
                                           uint32_t wanted)
{
    struct faces8 f;
    const bool shaded = segment_gouraud(segment), textured = segment_textured(segment);
    out->flat = !shaded && !textured && draw_is_opaque(&frame->draw[segment->draw]) ? wanted : 0;
    out->even = out->perspective = 0;
    if (!shaded && !textured)
        return;
    faces8_make(&f, p, planes);
    if (textured)
        wanted &= large8(&f);
    if (shaded)
        colors8_make(out, &f, frame, segment, wanted);
    if (textured)
        textures8_make(out, &f, frame, segment, planes, wanted);
}

/* ------------------------------------------------------------------ one of them */

static inline struct plane plane_of(const struct plane8 *p, int k) { return (struct plane){ p->at[k], p->dx[k], p->dy[k] }; }

static void take_texture(struct setup *s, const struct looks8 *l, int k)
{
    struct texture_setup *const t = &s->texture;
    const struct smear_sampler *const m = &s->draw->sampler;
    t->turns = m->turns;
    t->parabolic = false;
    if ((l->curved >> k & 1u) != 0) {
        t->mode = TEXTURE_CURVED;
        t->block = 16;
        t->shift = 0;
        t->x0 = s->v[0][VERTEX_X] >> 8;
        t->y0 = s->v[0][VERTEX_Y] >> 8;
        for (int i = 0; i < 2; i++) {
            const int32_t (*const c)[8] = l->curve[i].term;
            t->curve[i] = (struct curve){ c[0][k], c[1][k], c[2][k], c[3][k], c[4][k], c[5][k] };
        }
    } else {
        t->uv[0] = plane_of(&l->texture[0], k);
        t->uv[1] = plane_of(&l->texture[1], k);
        if ((l->affine >> k & 1u) != 0) {
            t->mode = TEXTURE_AFFINE;
            t->q = (struct plane){ 0, 0, 0 };
            t->block = BLOCK_LONGEST;
            t->shift = (int8_t)(18 - m->uv_shift);
        } else {
            t->mode = TEXTURE_DIVIDED;
            t->q = plane_of(&l->texture[2], k);
            t->shift = (int8_t)(20 - m->uv_shift);
            t->slope = clamp_i32(t->q.dx, -(1 << 24) + 1, (1 << 24) - 1) * 128;
            smear_setup_blocks(t, l->worst[k], l->width[k], l->change[k]);
        }
    }
    t->up = t->turns ? (uint8_t)t->shift : 0;
    if (segment_gouraud(s->segment) && !s->even_color)
        t->block = (uint8_t)min_i32(t->block, s->color_block);      /* one walk for both */
}

void smear_looks8_take(struct setup *s, const struct looks8 *l, int k)
{
    s->flat = (l->flat >> k & 1u) != 0;
    s->has_velocity = false;
    if (s->flat) {
        if (segment_gouraud(s->segment))
            s->color = l->color[k];
        return;
    }
    s->even_color = (l->even >> k & 1u) != 0;
    s->perspective_color = (l->perspective >> k & 1u) != 0;
    s->color_block = 16;
    if (segment_gouraud(s->segment)) {
        s->color_block = (uint8_t)l->color_block[k];
        for (int c = 0; c < (draw_is_opaque(s->draw) ? 3 : 4); c++)
            s->channel[c] = plane_of(&l->channel[c], k);
    }
    if (segment_textured(s->segment))
        take_texture(s, l, k);
}
#endif
