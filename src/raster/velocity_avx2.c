/* SPDX-License-Identifier: MIT */
/* velocity_avx2.c - the velocities of spans, eight pixels at once: exact ones at eight places in the lanes of words, of as many
 * spans as have room, then a block of eight pixels from each place to the next. Numbers are those of velocity.c; the few places
 * where those need more than 32 bits are left to it. It takes a tenth of the instructions. */
#include "raster/velocity.h"

#include "kernels/planes8.h"
#include "kernels/wide_lanes.h"
#include "raster/texture_rows.h"

#if SMEAR_AVX2

/* Vectors at eight places; `beyond`: lanes that do not hold. */
struct motion8 {
    lanes8i x, y, beyond;
};

SMEAR_AVX2_INLINE lanes8i motion8_plane_at(const struct plane *p, lanes8i x, lanes8i y)
{
    return (lanes8i)((uint32_t)p->at + (lanes8)y * (uint32_t)p->dy + (lanes8)x * (uint32_t)p->dx);
}

/* ------------------------------------------------------------------ triangles */

/* The motion of a vertex in one or two poses, as its record has it: displacement, ratio, displacement, ratio. */
SMEAR_AVX2_INLINE lanes8i motion8_of_vertex(const struct setup *s, int i)
{
    const lanes8i words = lanes8i_numbers() < s->poses * (int32_t)MOTION_WORDS;
    return (lanes8i)_mm256_maskload_epi32((const int *)(s->v[i] + s->segment->motion), (__m256i)words);
}

/* The ratio of each element. */
SMEAR_AVX2_INLINE lanes8i motion8_ratio(lanes8i motion)
{
    return lanes8i_permute(motion, (lanes8i){ MOTION_RATIO, MOTION_RATIO, MOTION_RATIO, MOTION_WORDS + MOTION_RATIO,
                                              MOTION_WORDS + MOTION_RATIO, MOTION_WORDS + MOTION_RATIO, 7, 7 });
}

SMEAR_AVX2_FUNCTION bool smear_velocity_ends_avx2(const struct setup *s, int32_t dx[3], int32_t dy[3])
{
    const lanes8i far_out = lanes8i_all(1 << 22);
    lanes8i beyond = lanes8i_all(0);
    for (int i = 0; i < 3; i++) {
        const lanes8i motion = motion8_of_vertex(s, i), ratio = lanes8i_max(motion8_ratio(motion), lanes8i_all(1));
        const lanes8i zeros = lanes8i_zeros(ratio), r = (lanes8i)lanes8_recip_norm(lanes8_left((lanes8)ratio, zeros));
        const lanes8i here = lanes8i_mulh((lanes8i)((lanes8)motion << 4), r);
        const lanes8i far = lanes8i_scale(here, zeros - 13, &beyond) & (lanes8i){ -1, -1, 0, -1, -1, 0, 0, 0 };
        int32_t end[8];
        lanes8i_store(end, lanes8i_max(lanes8i_min(far, far_out), -far_out));
        dx[i] = end[MOTION_WORDS + MOTION_DX] - end[MOTION_DX];
        dy[i] = end[MOTION_WORDS + MOTION_DY] - end[MOTION_DY];
    }
    return (lanes8i_signs(beyond) & 0x1bu) == 0;
}

/* The values of place_term() at a vertex, and the ratios'. */
SMEAR_AVX2_INLINE lanes8i motion8_terms(const struct setup *s, int i, int down, lanes8i *beyond)
{
    const int32_t x = s->v[i][VERTEX_X] - s->v[0][VERTEX_X], y = s->v[i][VERTEX_Y] - s->v[0][VERTEX_Y], far_out = 1 << 30;
    const lanes8i motion = motion8_of_vertex(s, i), ratio = motion8_ratio(motion) >> down;
    const lanes8i here = product8_without(product8_of((lanes8i){ x, y, 0, x, y, 0, 0, 0 }, ratio), 7, beyond);
    const lanes8i up = lanes8i_all(max_i32(13 - down, 0)), there = lanes8i_left(motion, up) >> max_i32(down - 13, 0);
    *beyond |= (lanes8i_abs(here) >= far_out) | (lanes8i_abs(motion) >= lanes8i_right(lanes8i_all(far_out), up));
    const lanes8i sum = lanes8i_max(lanes8i_min((lanes8i)((lanes8)here + (lanes8)there), lanes8i_all(far_out)), lanes8i_all(-far_out));
    return lanes8i_choose((lanes8i){ 0, 0, -1, 0, 0, -1, 0, 0 }, (lanes8i)((lanes8)ratio << 13), sum);
}

SMEAR_AVX2_FUNCTION bool smear_velocity_planes_avx2(struct setup *s, int down)
{
    const struct plane_triangle triangle = { s->v[0][VERTEX_X], s->v[0][VERTEX_Y], s->x1, s->y1, s->x2, s->y2, s->area_recip,
                                             s->area_zeros };
    lanes8i beyond = lanes8i_all(0);
    struct plane_values values;
    struct plane_eight planes;
    for (int i = 0; i < 3; i++)
        lanes8i_store(values.of[i], motion8_terms(s, i, down, &beyond));
    if ((lanes8i_signs(beyond) & 0x1bu) != 0)
        return false;
    smear_plane_eight_avx2(&planes, &triangle, &values);
    for (int pose = 0; pose < s->poses; pose++) {
        struct plane *const out[MOTION_WORDS] = { &s->px[pose], &s->py[pose], &s->ratio[pose] };
        for (int i = 0; i < MOTION_WORDS; i++) {
            const int from = pose * MOTION_WORDS + i;
            *out[i] = (struct plane){ planes.at[from], planes.dx[from], planes.dy[from] };
        }
    }
    return true;
}

/* ------------------------------------------------------------------ places */

/* One component of pose_displacement(): from the numerator and from the pixel's place. */
SMEAR_AVX2_INLINE lanes8i motion8_component(lanes8i n, lanes8i ratio, lanes8i here, lanes8i r, lanes8i shift, lanes8i *beyond)
{
    const lanes8i rest = lanes8i_less(n, product8_without(product8_of(ratio, here), 20, beyond), beyond);
    *beyond |= rest == INT32_MIN;
    return lanes8i_scale(product8_of(rest, r).high, shift, beyond);
}

SMEAR_AVX2_INLINE struct motion8 motion8_of_pose(const struct setup *s, int pose, lanes8i x, lanes8i y)
{
    const lanes8i ratio = motion8_plane_at(&s->ratio[pose], x, y);
    const lanes8i d = lanes8i_max(ratio, lanes8i_all(1 << 12)), zeros = lanes8i_zeros(d);
    const lanes8i r = (lanes8i)lanes8_recip_norm(lanes8_left((lanes8)d, zeros));
    const lanes8i here_x = (lanes8i)((lanes8)x << 8) + (128 - s->v[0][VERTEX_X]);
    const lanes8i here_y = (lanes8i)((lanes8)y << 8) + (128 - s->v[0][VERTEX_Y]);
    struct motion8 m = { .beyond = lanes8i_all(0) };
    m.x = motion8_component(motion8_plane_at(&s->px[pose], x, y), ratio, here_x, r, zeros - 9, &m.beyond);
    m.y = motion8_component(motion8_plane_at(&s->py[pose], x, y), ratio, here_y, r, zeros - 9, &m.beyond);
    m.beyond |= (lanes8i_abs(m.x) | lanes8i_abs(m.y)) >> 29 != 0;
    return m;
}

/* As displacement_between(). */
SMEAR_AVX2_INLINE struct motion8 motion8_displacement(const struct setup *s, lanes8i x, lanes8i y)
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

/* Places at which velocities are exact, and how they change from each to the next, q16. */
struct places8 {
    int32_t count;
    int32_t column[16], row[16];        /* eight, and what a store of eight from any of them on reaches */
    int32_t x[8], y[8], step_x[8], step_y[8];
};

SMEAR_AVX2_INLINE lanes8i motion8_next(lanes8i at) { return lanes8i_permute(at, (lanes8i){ 1, 2, 3, 4, 5, 6, 7, 7 }); }

SMEAR_AVX2_INLINE lanes8i motion8_step(lanes8i at, lanes8i over)
{
    const lanes8i change = motion8_next(at) - at;
    return ((change >> 8) * over + (((change & 255) * over + 0x8000) >> 8)) >> 8;
}

/* Adds the places of a span from column x, a multiple of 8, on: of as many blocks as have room, and the place behind them. There is
 * room for two places at least. Returns how many blocks. */
SMEAR_AVX2_INLINE int32_t places8_add(struct places8 *k, const struct span *p, int32_t x)
{
    const int32_t blocks = min_i32((p->b - x + 7) >> 3, 7 - k->count);
    const lanes8i last = lanes8i_all(p->right - 1);
    lanes8i_store(k->column + k->count, lanes8i_min(lanes8i_max(lanes8i_numbers() * 8 + x, lanes8i_all(p->a)), last));
    lanes8i_store(k->row + k->count, lanes8i_all(p->y));
    k->count += blocks + 1;
    return blocks;
}

SMEAR_AVX2_INLINE void places8_make(struct places8 *k, const struct setup *s)
{
    /* 2^16 / pixels to the next place; where that is one pixel no change is needed. */
    static const int32_t inverse[8] = { 8192, 0, 32768, 21845, 16384, 13107, 10922, 9362 };
    const lanes8i column = lanes8i_load(k->column), row = lanes8i_load(k->row);
    const lanes8i over = lanes8i_permute(lanes8i_load(inverse), (motion8_next(column) - column) & 7);
    struct motion8 m = motion8_store(s, motion8_displacement(s, column, row));
    lanes8i_store(k->x, m.x);
    lanes8i_store(k->y, m.y);
    uint32_t beyond = lanes8i_signs(m.beyond) & ((1u << k->count) - 1u);
    if (beyond != 0) {
        for (; beyond != 0; beyond &= beyond - 1) {
            const int i = __builtin_ctz(beyond);
            int32_t exact[2];
            smear_velocity_exact(s, k->column[i], k->row[i], exact);
            k->x[i] = exact[0];
            k->y[i] = exact[1];
        }
        m.x = lanes8i_load(k->x);
        m.y = lanes8i_load(k->y);
    }
    lanes8i_store(k->step_x, motion8_step(m.x, over));
    lanes8i_store(k->step_y, motion8_step(m.y, over));
}

/* Makes those of a triangle without a motion of its own. */
SMEAR_AVX2_INLINE void places8_still(struct places8 *k, const struct setup *s)
{
    const int32_t still = !s->velocity_unknown ? 0 : s->target->velocity8 != NULL ? SMEAR_VELOCITY_UNKNOWN8 : SMEAR_VELOCITY_UNKNOWN16;
    lanes8i_store(k->x, lanes8i_all(still * 8192));
    lanes8i_store(k->y, lanes8i_all(still * 8192));
    lanes8i_store(k->step_x, lanes8i_all(0));
    lanes8i_store(k->step_y, lanes8i_all(0));
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

/* Writes a colour and depth codes, likewise. */
SMEAR_AVX2_INLINE void flat8_write(uint32_t *color, uint16_t *depth, uint32_t value, lanes8i code, lanes8i old, lanes8i which)
{
    const __m256i nearer = (__m256i)lanes8i_choose(which, code, old);
    lanes8_store_some(color, lanes8_all(value), (lanes8)which);
    _mm_storeu_si128((__m128i *)(void *)depth, _mm_packus_epi32(_mm256_castsi256_si128(nearer), _mm256_extracti128_si256(nearer, 1)));
}

/* Blocks of a span that begin at column x, a multiple of 8, at place number `lane`. */
struct motion_part {
    const struct span *span;
    int32_t x, blocks, lane;
};

/* Writes velocities where a part will pass the depth test; with `flat` colours and depths of opaque surfaces, too. */
SMEAR_AVX2_INLINE void part_draw(const struct setup *s, const struct places8 *k, const struct motion_part *part, bool flat)
{
    const struct span *const p = part->span;
    const lanes8i number = lanes8i_numbers();
    const uint32_t value = target_pixel(s->target, s->color);
    const int32_t before = p->a - part->x;          /* less than 8 pixels */
    int32_t at = p->at - before;
    uint16_t *depth = p->depth - before;
    int32_t place = -before;                        /* of column x, from the span's first pixel; only flat rows have colours */
    lanes8 z = p->z + ((lanes8)number - (uint32_t)before) * (uint32_t)p->dz;
    for (int32_t i = part->lane, x = part->x; i < part->lane + part->blocks; i++) {
        const lanes8i column = number + x, code = (lanes8i)(z >> 16), old = lanes8i_load_halves(depth);
        const lanes8i drawn = (column >= p->a) & (column < p->b) & (code > old);
        if (lanes8i_any(drawn)) {
            const lanes8i from = number - max_i32(p->a - x, 0);
            lanes8i vx = from * k->step_x[i] + k->x[i], vy = from * k->step_y[i] + k->y[i];
            if (x + 8 >= p->right) {        /* the span's last pixel is exact */
                const lanes8i is_last = column == p->right - 1;
                vx = lanes8i_choose(is_last, lanes8i_all(k->x[i + 1]), vx);
                vy = lanes8i_choose(is_last, lanes8i_all(k->y[i + 1]), vy);
            }
            velocity8_write(s->target, at, (vx + 0x1000) >> 13, (vy + 0x1000) >> 13, drawn);
            if (flat)
                flat8_write((uint32_t *)p->color + place, depth, value, code, old, drawn);
        }
        x += 8;
        at += 8;
        depth += 8;
        place += 8;
        z += 8u * (uint32_t)p->dz;
    }
}

/* Draws `count` spans of a triangle, of as many as have room at once. */
SMEAR_AVX2_INLINE void spans_draw(const struct setup *s, const struct span *p, int32_t count, bool flat)
{
    const struct span *const end = p + count;
    struct places8 k;
    struct motion_part part[4];
    for (int32_t x = p->a & ~7; p != end;) {
        int32_t parts = 0;
        k.count = 0;
        do {
            struct motion_part *const next = &part[parts++];
            next->span = p;
            next->x = x;
            next->lane = k.count;
            next->blocks = places8_add(&k, p, x);
            x += 8 * next->blocks;
            if (x >= p->b && ++p != end)
                x = p->a & ~7;
        } while (p != end && k.count <= 6);
        if (s->poses != 0)
            places8_make(&k, s);
        else
            places8_still(&k, s);
        for (int32_t i = 0; i < parts; i++)
            part_draw(s, &k, &part[i], flat);
    }
}

/* Whether velocities of a triangle may be written in lanes. */
static inline bool motion_suits(const struct setup *s)
{
    const struct smear_raster_target *t = s->target;
    return t->moving != NULL && !target_is_inspected(t) && (uint32_t)s->frame->velocity_scale >> 16 == 0 && smear_has_avx2();
}

/* Whether a span's blocks of eight columns lie within the target's. */
static inline bool span_has_blocks(const struct setup *s, const struct span *p)
{
    return (p->a & ~7) >= s->target->x0 && ((p->b + 7) & ~7) <= s->target->x1;
}

bool smear_span_velocity_fits8(const struct setup *s, const struct span *p)
{
    return motion_suits(s) && p->mask == NULL && span_has_blocks(s, p);
}

SMEAR_AVX2_FUNCTION void smear_span_velocity_avx2(const struct setup *s, const struct span *p) { spans_draw(s, p, 1, false); }

/* ------------------------------------------------------------------ rows */

static SMEAR_AVX2_FUNCTION void flat_spans_draw(const struct setup *s, const struct span *p, int32_t count)
{
    spans_draw(s, p, count, true);
}

/* Makes the span of a row that begins at pixel a: up to the row's end, or to the depth code's break. */
static inline void span_from(struct span *p, const struct setup *s, const struct span_rows *r, int32_t row, int32_t a)
{
    const struct smear_raster_target *t = s->target;
    const int32_t y = r->y + row, dx = s->depth.dx, units = plane_at(&s->depth, a, y), at = r->at + row * t->window_rows.stride + a;
    enum depth_slope slope = s->slope;
    int32_t n = min_i32(r->side[row].right, t->x1) - a;
    if (slope == SLOPE_BOTH) {
        const int32_t last = add_wrap(units, mul_wrap(dx, n - 1));
        slope = units < SLOPE_BREAK ? SLOPE_FAR : SLOPE_NEAR;
        if ((last < SLOPE_BREAK) != (units < SLOPE_BREAK))
            n = pixels_to_break(units, dx, n);
    }
    p->a = a;
    p->b = a + n;
    p->left = r->side[row].left;
    p->right = r->side[row].edge;
    p->y = y;
    p->color = t->color + at;
    p->depth = t->depth + at;
    p->at = at;
    p->z = code_from_units(units, slope);
    p->dz = step_from_units(dx, slope);
    p->mask = NULL;
}

void smear_rows_motion(const struct setup *s, const struct span_rows *r)
{
    struct span spans[2 * SPAN_ROWS];
    int32_t count = 0;
    for (int32_t row = 0; row < r->count; row++) {
        const int32_t end = min_i32(r->side[row].right, s->target->x1);
        for (int32_t a = max_i32(r->side[row].left, s->target->x0); a < end;) {
            struct span *const p = &spans[count];
            SMEAR_ASSERT(count < 2 * SPAN_ROWS);        /* a row crosses the break once */
            span_from(p, s, r, row, a);
            a = p->b;
            if (!span_has_blocks(s, p)) {
                smear_span_velocity(s, p);
                smear_span_flat(s, p);
                continue;
            }
            if (s->poses != 0)
                span_mark_tiles(s->target, p);
            count++;
        }
    }
    flat_spans_draw(s, spans, count);
}

bool smear_rows_motion_suit(const struct setup *s)
{
    return s->flat && s->writes_velocity && !target_is_direct(s->target) && motion_suits(s);
}

#endif
