/* SPDX-License-Identifier: MIT */
/* velocity_avx2.c - the velocities of a span, eight pixels at once: exact ones at eight places of a row in the lanes of
 * words, then a block of eight pixels from each to the next. Numbers are those of velocity.c; the few places where
 * those need more than 32 bits are left to it. It takes a sixth of the instructions. */
#include "raster/velocity.h"

#include "kernels/words8.h"
#include "raster/span.h"

#if SMEAR_AVX2

/* Vectors at eight places; `beyond`: lanes that do not hold. */
struct motion8 {
    smear_w8i x, y, beyond;
};

W8_FUNCTION smear_w8i motion8_plane_at(const struct plane *p, smear_w8i x, int32_t y)
{
    return (smear_w8i)(w8u_all((uint32_t)p->at + (uint32_t)p->dy * (uint32_t)y) + (smear_w8u)x * (uint32_t)p->dx);
}

W8_FUNCTION smear_w8i motion8_magnitude(smear_w8i a) { return (smear_w8i)_mm256_abs_epi32((__m256i)a); }

/* Products of 64 bits, by their words. */
struct product8 {
    smear_w8i high;
    smear_w8u low;
};

W8_FUNCTION struct product8 motion8_times(smear_w8i a, smear_w8i b)
{
    const __m256i even = _mm256_mul_epi32((__m256i)a, (__m256i)b);
    const __m256i odd = _mm256_mul_epi32(_mm256_srli_epi64((__m256i)a, 32), _mm256_srli_epi64((__m256i)b, 32));
    return (struct product8){ (smear_w8i)_mm256_blend_epi32(_mm256_srli_epi64(even, 32), odd, 0xaa),
                              (smear_w8u)_mm256_blend_epi32(even, _mm256_slli_epi64(odd, 32), 0xaa) };
}

/* scale_sat(a, shift) for shift of -31 .. 31, where it saturates `beyond` is set. */
W8_FUNCTION smear_w8i motion8_scale(smear_w8i a, smear_w8i shift, smear_w8i *beyond)
{
    const smear_w8i up = w8i_max(shift, w8i_all(0)), down = w8i_max(-shift, w8i_all(0));
    const smear_w8u half = w8u_left(w8u_all(1), down) >> 1;
    *beyond |= motion8_magnitude(a) > (smear_w8i)w8u_right(w8u_all(INT32_MAX), up);
    const smear_w8i sum = (smear_w8i)((smear_w8u)a + half);
    return (smear_w8i)w8u_left((smear_w8u)_mm256_srav_epi32((__m256i)sum, (__m256i)down), up);
}

/* One component of pose_displacement(): from the numerator and from the pixel's place. */
W8_FUNCTION smear_w8i motion8_component(smear_w8i n, smear_w8i ratio, smear_w8i here, smear_w8i r, smear_w8i shift, smear_w8i *beyond)
{
    const struct product8 p = motion8_times(ratio, here);
    const smear_w8i part = (smear_w8i)((smear_w8u)p.high << 12 | p.low >> 20);
    const smear_w8i rest = (smear_w8i)((smear_w8u)n - (smear_w8u)part);
    *beyond |= (part >> 12) != p.high;
    *beyond |= ((n ^ part) & (n ^ rest)) < 0;
    *beyond |= rest == INT32_MIN;
    return motion8_scale(motion8_times(rest, r).high, shift, beyond);
}

W8_FUNCTION struct motion8 motion8_of_pose(const struct setup *s, int pose, smear_w8i x, int32_t y)
{
    const smear_w8i ratio = motion8_plane_at(&s->ratio[pose], x, y);
    const smear_w8u d = (smear_w8u)w8i_max(ratio, w8i_all(1 << 12));
    const smear_w8i log2 = w8i_log2(d >> 12) + 12;
    const smear_w8i zeros = 31 - w8i_choose((smear_w8i)d >= 1 << 28, w8i_log2(d >> 16) + 16, log2);
    const smear_w8i r = (smear_w8i)w8u_recip_norm(w8u_left(d, zeros));
    const smear_w8i here_x = (smear_w8i)((smear_w8u)x << 8) + (128 - s->v[0][VERTEX_X]);
    const smear_w8i here_y = w8i_all(y * 256 + 128 - s->v[0][VERTEX_Y]);
    struct motion8 m = { .beyond = w8i_all(0) };
    m.x = motion8_component(motion8_plane_at(&s->px[pose], x, y), ratio, here_x, r, zeros - 9, &m.beyond);
    m.y = motion8_component(motion8_plane_at(&s->py[pose], x, y), ratio, here_y, r, zeros - 9, &m.beyond);
    m.beyond |= (motion8_magnitude(m.x) | motion8_magnitude(m.y)) >> 29 != 0;
    return m;
}

/* As displacement_between(). */
W8_FUNCTION struct motion8 motion8_displacement(const struct setup *s, smear_w8i x, int32_t y)
{
    if (s->velocity_affine)
        return (struct motion8){ (smear_w8i)((smear_w8u)motion8_plane_at(&s->vx, x, y) + 512u) >> 10,
                                 (smear_w8i)((smear_w8u)motion8_plane_at(&s->vy, x, y) + 512u) >> 10, w8i_all(0) };
    const struct motion8 open = motion8_of_pose(s, 0, x, y);
    struct motion8 close = { w8i_all(0), w8i_all(0), w8i_all(0) };
    if (s->poses == 2)
        close = motion8_of_pose(s, 1, x, y);
    const struct motion8 m = { (smear_w8i)((smear_w8u)close.x - (smear_w8u)open.x),
                               (smear_w8i)((smear_w8u)close.y - (smear_w8u)open.y), open.beyond | close.beyond };
    return m;
}

/* As smear_velocity_store(), for scales below 2^16. */
W8_FUNCTION struct motion8 motion8_store(const struct setup *s, struct motion8 d)
{
    const int32_t scale = s->frame->velocity_scale;
    d.beyond |= (motion8_magnitude(d.x) | motion8_magnitude(d.y)) >> 15 != 0;
    d.x = (smear_w8i)((smear_w8u)d.x * (uint32_t)scale) >> 8;
    d.y = (smear_w8i)((smear_w8u)d.y * (uint32_t)scale) >> 8;
    if (s->clamp_velocity) {
        const int32_t reach = s->frame->reach_q3 * 2;
        const smear_w8u x = (smear_w8u)(d.x >> 12), y = (smear_w8u)(d.y >> 12);
        d.beyond |= (smear_w8i)(x * x + y * y) > reach * reach;
    }
    return d;
}

/* Places in the row of a span at which velocities are exact, and how they change from each to the next, q16. */
struct places8 {
    int32_t x[8], y[8], step_x[8], step_y[8];
};

W8_FUNCTION smear_w8i motion8_step(smear_w8i at, smear_w8i over)
{
    const smear_w8i change = (smear_w8i)_mm256_permutevar8x32_epi32((__m256i)at, (__m256i)(smear_w8i){ 1, 2, 3, 4, 5, 6, 7, 7 }) - at;
    return ((change >> 8) * over + (((change & 255) * over + 0x8000) >> 8)) >> 8;
}

/* Finds them from column `first`, a multiple of 8, on; the span's first pixel and its last may come before or after. */
W8_FUNCTION void places8_make(struct places8 *k, const struct setup *s, const struct span *p, int32_t first)
{
    /* 2^16 / pixels to the next place; where that is one pixel no change is needed. */
    static const int32_t inverse[8] = { 8192, 0, 32768, 21845, 16384, 13107, 10922, 9362 };
    const smear_w8i last = w8i_all(p->right - 1);
    const smear_w8i at = w8i_min(w8i_max(w8i_steps() * 8 + first, w8i_all(p->a)), last);
    const smear_w8i next = w8i_min(w8i_steps() * 8 + (first + 8), last);
    const smear_w8i over = (smear_w8i)_mm256_permutevar8x32_epi32((__m256i)w8i_load(inverse), (__m256i)((next - at) & 7));
    struct motion8 m = motion8_store(s, motion8_displacement(s, at, p->y));
    w8_store(k->x, (smear_w8u)m.x);
    w8_store(k->y, (smear_w8u)m.y);
    uint32_t beyond = (uint32_t)_mm256_movemask_ps(_mm256_castsi256_ps((__m256i)m.beyond));
    if (beyond != 0) {
        for (int32_t i = 0; i < 8; i++) {
            int32_t exact[2];
            if ((beyond >> i & 1u) == 0)
                continue;
            smear_velocity_exact(s, min_i32(max_i32(first + 8 * i, p->a), p->right - 1), p->y, exact);
            k->x[i] = exact[0];
            k->y[i] = exact[1];
        }
        m.x = w8i_load(k->x);
        m.y = w8i_load(k->y);
    }
    w8_store(k->step_x, (smear_w8u)motion8_step(m.x, over));
    w8_store(k->step_y, (smear_w8u)motion8_step(m.y, over));
}

/* Writes velocities, in 1/8 px, of pixels from index `at` on that are chosen by `which`. */
W8_FUNCTION void velocity8_write(const struct smear_raster_target *t, int32_t at, smear_w8i x, smear_w8i y, smear_w8i which)
{
    if (t->velocity8 == NULL) {
        const smear_w8u pair = w8u_low_halves((smear_w8u)x, (smear_w8u)y);
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
    const smear_w8i lane = w8i_steps();
    smear_w8u z = p->z + ((smear_w8u)lane - (uint32_t)(p->a - start)) * (uint32_t)p->dz;
    struct places8 k;
    for (int32_t first = start; first < p->b; first += 8 * BLOCKS) {
        places8_make(&k, s, p, first);
        for (int32_t i = 0, x = first; i < BLOCKS && x < p->b; i++, x += 8, z += 8u * (uint32_t)p->dz) {
            const smear_w8i column = lane + x;
            const smear_w8i inside = (column >= p->a) & (column < p->b);
            const smear_w8i drawn = inside & ((smear_w8i)(z >> 16) > (smear_w8i)w8u_load_halves(depth + (x - start)));
            if (!w8_any(drawn))
                continue;
            const smear_w8i from = lane - max_i32(p->a - x, 0);
            smear_w8i vx = from * k.step_x[i] + k.x[i], vy = from * k.step_y[i] + k.y[i];
            if (x + 8 >= p->right) {        /* the span's last pixel is exact */
                const smear_w8i is_last = column == p->right - 1;
                vx = w8i_choose(is_last, w8i_all(k.x[i + 1]), vx);
                vy = w8i_choose(is_last, w8i_all(k.y[i + 1]), vy);
            }
            velocity8_write(t, at + (x - start), (vx + 0x1000) >> 13, (vy + 0x1000) >> 13, drawn);
        }
    }
}

#endif
