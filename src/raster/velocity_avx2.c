/* SPDX-License-Identifier: MIT */
/* velocity_avx2.c - the velocities of a span, eight pixels at once: exact ones at eight places of a row in the lanes of
 * words, then a block of eight pixels from each to the next. Numbers are those of velocity.c; the few places where
 * those need more than 32 bits are left to it. It takes a sixth of the instructions. */
#include "raster/velocity.h"

#include "kernels/lanes8.h"
#include "raster/span.h"

#if SMEAR_AVX2

/* Vectors at eight places; `beyond`: lanes that do not hold. */
struct motion8 {
    lanes8i x, y, beyond;
};

SMEAR_AVX2_INLINE lanes8i motion8_plane_at(const struct plane *p, lanes8i x, int32_t y)
{
    return (lanes8i)(lanes8_all((uint32_t)p->at + (uint32_t)p->dy * (uint32_t)y) + (lanes8)x * (uint32_t)p->dx);
}

/* Products of 64 bits, by their words. */
struct product8 {
    lanes8i high;
    lanes8 low;
};

SMEAR_AVX2_INLINE struct product8 motion8_times(lanes8i a, lanes8i b)
{
    const __m256i even = _mm256_mul_epi32((__m256i)a, (__m256i)b);
    const __m256i odd = _mm256_mul_epi32(_mm256_srli_epi64((__m256i)a, 32), _mm256_srli_epi64((__m256i)b, 32));
    return (struct product8){ (lanes8i)_mm256_blend_epi32(_mm256_srli_epi64(even, 32), odd, 0xaa),
                              (lanes8)_mm256_blend_epi32(even, _mm256_slli_epi64(odd, 32), 0xaa) };
}

/* scale_sat(a, shift) for shift of -31 .. 31, where it saturates `beyond` is set. */
SMEAR_AVX2_INLINE lanes8i motion8_scale(lanes8i a, lanes8i shift, lanes8i *beyond)
{
    const lanes8i up = lanes8i_max(shift, lanes8i_all(0)), down = lanes8i_max(-shift, lanes8i_all(0));
    const lanes8 half = lanes8_left(lanes8_all(1), down) >> 1;
    *beyond |= lanes8i_abs(a) > (lanes8i)lanes8_right(lanes8_all(INT32_MAX), up);
    const lanes8i sum = (lanes8i)((lanes8)a + half);
    return lanes8i_left(lanes8i_right(sum, down), up);
}

/* One component of pose_displacement(): from the numerator and from the pixel's place. */
SMEAR_AVX2_INLINE lanes8i motion8_component(lanes8i n, lanes8i ratio, lanes8i here, lanes8i r, lanes8i shift, lanes8i *beyond)
{
    const struct product8 p = motion8_times(ratio, here);
    const lanes8i part = (lanes8i)((lanes8)p.high << 12 | p.low >> 20);
    const lanes8i rest = (lanes8i)((lanes8)n - (lanes8)part);
    *beyond |= (part >> 12) != p.high;
    *beyond |= ((n ^ part) & (n ^ rest)) < 0;
    *beyond |= rest == INT32_MIN;
    return motion8_scale(motion8_times(rest, r).high, shift, beyond);
}

SMEAR_AVX2_INLINE struct motion8 motion8_of_pose(const struct setup *s, int pose, lanes8i x, int32_t y)
{
    const lanes8i ratio = motion8_plane_at(&s->ratio[pose], x, y);
    const lanes8i d = lanes8i_max(ratio, lanes8i_all(1 << 12)), zeros = lanes8i_zeros(d);
    const lanes8i r = (lanes8i)lanes8_recip_norm(lanes8_left((lanes8)d, zeros));
    const lanes8i here_x = (lanes8i)((lanes8)x << 8) + (128 - s->v[0][VERTEX_X]);
    const lanes8i here_y = lanes8i_all(y * 256 + 128 - s->v[0][VERTEX_Y]);
    struct motion8 m = { .beyond = lanes8i_all(0) };
    m.x = motion8_component(motion8_plane_at(&s->px[pose], x, y), ratio, here_x, r, zeros - 9, &m.beyond);
    m.y = motion8_component(motion8_plane_at(&s->py[pose], x, y), ratio, here_y, r, zeros - 9, &m.beyond);
    m.beyond |= (lanes8i_abs(m.x) | lanes8i_abs(m.y)) >> 29 != 0;
    return m;
}

/* As displacement_between(). */
SMEAR_AVX2_INLINE struct motion8 motion8_displacement(const struct setup *s, lanes8i x, int32_t y)
{
    if (s->velocity_affine)
        return (struct motion8){ (lanes8i)((lanes8)motion8_plane_at(&s->vx, x, y) + 512u) >> 10,
                                 (lanes8i)((lanes8)motion8_plane_at(&s->vy, x, y) + 512u) >> 10, lanes8i_all(0) };
    const struct motion8 open = motion8_of_pose(s, 0, x, y);
    struct motion8 close = { lanes8i_all(0), lanes8i_all(0), lanes8i_all(0) };
    if (s->poses == 2)
        close = motion8_of_pose(s, 1, x, y);
    const struct motion8 m = { (lanes8i)((lanes8)close.x - (lanes8)open.x),
                               (lanes8i)((lanes8)close.y - (lanes8)open.y), open.beyond | close.beyond };
    return m;
}

/* As smear_velocity_store(), for scales below 2^16. */
SMEAR_AVX2_INLINE struct motion8 motion8_store(const struct setup *s, struct motion8 d)
{
    const int32_t scale = s->frame->velocity_scale;
    d.beyond |= (lanes8i_abs(d.x) | lanes8i_abs(d.y)) >> 15 != 0;
    d.x = (lanes8i)((lanes8)d.x * (uint32_t)scale) >> 8;
    d.y = (lanes8i)((lanes8)d.y * (uint32_t)scale) >> 8;
    if (s->clamp_velocity) {
        const int32_t reach = s->frame->reach_q3 * 2;
        const lanes8 x = (lanes8)(d.x >> 12), y = (lanes8)(d.y >> 12);
        d.beyond |= (lanes8i)(x * x + y * y) > reach * reach;
    }
    return d;
}

/* Places in the row of a span at which velocities are exact, and how they change from each to the next, q16. */
struct places8 {
    int32_t x[8], y[8], step_x[8], step_y[8];
};

SMEAR_AVX2_INLINE lanes8i motion8_step(lanes8i at, lanes8i over)
{
    const lanes8i change = lanes8i_permute(at, (lanes8i){ 1, 2, 3, 4, 5, 6, 7, 7 }) - at;
    return ((change >> 8) * over + (((change & 255) * over + 0x8000) >> 8)) >> 8;
}

/* Finds them from column `first`, a multiple of 8, on; the span's first pixel and its last may come before or after. */
SMEAR_AVX2_INLINE void places8_make(struct places8 *k, const struct setup *s, const struct span *p, int32_t first)
{
    /* 2^16 / pixels to the next place; where that is one pixel no change is needed. */
    static const int32_t inverse[8] = { 8192, 0, 32768, 21845, 16384, 13107, 10922, 9362 };
    const lanes8i last = lanes8i_all(p->right - 1);
    const lanes8i at = lanes8i_min(lanes8i_max(lanes8i_numbers() * 8 + first, lanes8i_all(p->a)), last);
    const lanes8i next = lanes8i_min(lanes8i_numbers() * 8 + (first + 8), last);
    const lanes8i over = lanes8i_permute(lanes8i_load(inverse), (next - at) & 7);
    struct motion8 m = motion8_store(s, motion8_displacement(s, at, p->y));
    lanes8i_store(k->x, m.x);
    lanes8i_store(k->y, m.y);
    uint32_t beyond = lanes8i_signs(m.beyond);
    if (beyond != 0) {
        for (int32_t i = 0; i < 8; i++) {
            int32_t exact[2];
            if ((beyond >> i & 1u) == 0)
                continue;
            smear_velocity_exact(s, min_i32(max_i32(first + 8 * i, p->a), p->right - 1), p->y, exact);
            k->x[i] = exact[0];
            k->y[i] = exact[1];
        }
        m.x = lanes8i_load(k->x);
        m.y = lanes8i_load(k->y);
    }
    lanes8i_store(k->step_x, motion8_step(m.x, over));
    lanes8i_store(k->step_y, motion8_step(m.y, over));
}

/* Writes velocities, in 1/8 px, of pixels from index `at` on that are chosen by `which`. */
SMEAR_AVX2_INLINE void velocity8_write(const struct smear_raster_target *t, int32_t at, lanes8i x, lanes8i y, lanes8i which)
{
    if (t->velocity8 == NULL) {
        const lanes8 pair = lanes8_pair((lanes8)x, (lanes8)y);
        _mm256_maskstore_epi32((int *)(void *)(t->velocity16 + 2 * at), (__m256i)which, (__m256i)pair);
        return;
    }
    __m128i *const out = (__m128i *)(void *)(t->velocity8 + 2 * at);
    const __m256i pair = _mm256_packus_epi32((__m256i)((x & 255) | (y & 255) << 8), (__m256i)(which & 0xffff));
    const __m256i ordered = _mm256_permute4x64_epi64(pair, 0xd8);       /* velocities, then the choice */
    const __m128i old = _mm_loadu_si128(out), chosen = _mm256_extracti128_si256(ordered, 1);
    _mm_storeu_si128(out, _mm_blendv_epi8(old, _mm256_castsi256_si128(ordered), chosen));
}

bool smear_span_velocity_fits8(const struct setup *s, const struct span *p)
{
    const struct smear_raster_target *t = s->target;
    return smear_has_avx2() && p->mask == NULL && t->moving != NULL && !target_is_inspected(t) && (p->a & ~7) >= t->x0
        && ((p->b + 7) & ~7) <= t->x1 && (uint32_t)s->frame->velocity_scale >> 16 == 0;
}

SMEAR_AVX2_FUNCTION
void smear_span_velocity_avx2(const struct setup *s, const struct span *p)
{
    enum { BLOCKS = 7 };        /* of eight places */
    const struct smear_raster_target *t = s->target;
    const int32_t start = p->a & ~7, at = p->at - (p->a - start);
    const uint16_t *depth = p->depth - (p->a - start);
    const lanes8i lane = lanes8i_numbers();
    lanes8 z = p->z + ((lanes8)lane - (uint32_t)(p->a - start)) * (uint32_t)p->dz;
    struct places8 k;
    for (int32_t first = start; first < p->b; first += 8 * BLOCKS) {
        places8_make(&k, s, p, first);
        for (int32_t i = 0, x = first; i < BLOCKS && x < p->b; i++, x += 8, z += 8u * (uint32_t)p->dz) {
            const lanes8i column = lane + x;
            const lanes8i inside = (column >= p->a) & (column < p->b);
            const lanes8i drawn = inside & ((lanes8i)(z >> 16) > lanes8i_load_halves(depth + (x - start)));
            if (!lanes8i_any(drawn))
                continue;
            const lanes8i from = lane - max_i32(p->a - x, 0);
            lanes8i vx = from * k.step_x[i] + k.x[i], vy = from * k.step_y[i] + k.y[i];
            if (x + 8 >= p->right) {        /* the span's last pixel is exact */
                const lanes8i is_last = column == p->right - 1;
                vx = lanes8i_choose(is_last, lanes8i_all(k.x[i + 1]), vx);
                vy = lanes8i_choose(is_last, lanes8i_all(k.y[i + 1]), vy);
            }
            velocity8_write(t, at + (x - start), (vx + 0x1000) >> 13, (vy + 0x1000) >> 13, drawn);
        }
    }
}

#endif
