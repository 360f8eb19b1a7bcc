/* SPDX-License-Identifier: MIT */
/* span.c - inner loops of the raster: flat, plain texels, and everything else in blocks. */
#include "span.h"

#include "pixel.h"

enum { BLOCK_MAX = 16 };

/* Spans of at most this many pixels have a place for each: exact, and no dearer than the ends of a block. */
enum { SHORT_SPAN = 4 };

static const int32_t inverse[BLOCK_MAX + 1] = {     /* 2^16 / n */
    0, 65536, 32768, 21845, 16384, 13107, 10923, 9362, 8192, 7282, 6554, 5958, 5461, 5041, 4681, 4369, 4096
};

/* a / n for n up to 16, good to 2^-16 of it; exact where n is a power of two. */
static inline int32_t part_of(int32_t a, int32_t n)
{
#if SMEAR_HAS_MUL64
    return (int32_t)((int64_t)a * inverse[n] >> 16);
#else
    return (a >> 16) * inverse[n] + (int32_t)(((uint32_t)a & 0xffffu) * (uint32_t)inverse[n] >> 16);
#endif
}

void smear_span_flat(const struct setup *s, const struct span *p)
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

/* Where blocks meet: texels q16, or turns 2^(32 - shift). */
struct place {
    int32_t u, v;
    int32_t nearness;       /* quadratic: middle / (k q), q15. Divided: relative change of q per pixel, q16 */
};

/* Coordinates from planes. Slivers, whose planes are anything, give anything: it wraps. */
SMEAR_INLINE struct place place_at(const struct texture_setup *t, const struct smear_sampler *m, int32_t q, int32_t u,
                                   int32_t v, bool turns)
{
    struct place p = { u, v, 0 };
    if (t->mode == TEXTURE_QUADRATIC) {
        uint32_t n = (uint32_t)q >> 16, k = t->recip_base + (n * n >> 17);
        p.u = (u >> 16) * (int32_t)k;
        p.v = (v >> 16) * (int32_t)k;
        p.nearness = (int32_t)k;
        if (!turns) {
            p.u >>= t->shift;
            p.v >>= t->shift;
        }
        p.u = add_wrap(p.u, t->u_base);
        p.v = add_wrap(p.v, t->v_base);
    } else if (t->mode == TEXTURE_DIVIDED) {
        uint32_t d = (uint32_t)max_i32(q, 1 << 11);
        int zeros = count_leading_zeros(d);                     /* at least 1 */
        int32_t r = (int32_t)recip_norm(d << zeros);            /* 1/q = r 2^(zeros - 61) */
        /* |U| <= q (and a step more by rounding), so U 2^(zeros - 2) fits; its quotient is the ratio in q27. */
        p.u = mulh_i32(shl_wrap(u >> 1, zeros - 1), r);
        p.v = mulh_i32(shl_wrap(v >> 1, zeros - 1), r);
        if (!turns) {
            p.u = smear_sampler_texel_u(m, shl_wrap(p.u, 2));
            p.v = smear_sampler_texel_v(m, shl_wrap(p.v, 2));
        }
        if (t->bent)
            p.nearness = mulh_i32(t->slope, r) >> (20 - zeros);
    }
    return p;
}

/* Coordinates of a block on its way: start, steps, and what these lose every 2 pixels. */
struct course {
    uint32_t u, v, du, dv, bend_u, bend_v;
};

/* From one place to another n pixels further on.
 *
 * Along a row u'' = -2 u' q'/q: with the chord's step d and b = d q'/q, the parabola from the chord's start to its end
 * has steps d + b (n - 2), 4 b less every 2 pixels. */
SMEAR_INLINE struct course course_between(const struct texture_setup *t, struct place from, struct place to, int32_t n,
                                          int up, bool turns)
{
    struct course c = { (uint32_t)from.u << up, (uint32_t)from.v << up, 0, 0, 0, 0 };
    int32_t du = part_of(sub_wrap(to.u, from.u), n), dv = part_of(sub_wrap(to.v, from.v), n);
    if (t->bent) {
        int32_t nearness = from.nearness + to.nearness;                                     /* q'/q, q16: */
        int32_t rate = t->mode == TEXTURE_QUADRATIC ? mul_wrap(t->slope, nearness) >> 17 : nearness >> 1;
        int32_t bu = mul_wrap(du >> 13, rate) >> 1, bv = mul_wrap(dv >> 13, rate) >> 1;     /* 4 b */
        du = add_wrap(du, mul_wrap(bu >> 2, n - 2));
        dv = add_wrap(dv, mul_wrap(bv >> 2, n - 2));
        c.bend_u = (uint32_t)bu << up;
        c.bend_v = (uint32_t)bv << up;
    }
    c.du = (uint32_t)du << up;
    c.dv = (uint32_t)dv << up;
    if (turns) {
        c.u = turns_start(c.u);
        c.du = turns_step(c.du);
        c.bend_u = turns_step(c.bend_u);
    }
    return c;
}

SMEAR_INLINE struct smear_texture_run course_packed(struct course c)
{
    return (struct smear_texture_run){ packed_uv(c.u, c.v), packed_step(c.du, c.dv), 0u - packed_step(c.bend_u, c.bend_v) };
}

/* The blocks of a span: from the first pixel that the frame shows, wherever it is cut; the last one takes the pixel at
 * its end as well, unless blocks are single pixels. */
struct walk {
    int32_t x, last;        /* where the next block begins; the span's last pixel */
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
    int32_t n = min_i32(w->block, w->last - w->x);
    w->start = w->x;
    w->x += n;
    w->q = add_wrap(w->q, mul_wrap(t->q.dx, n));
    w->u = add_wrap(w->u, mul_wrap(t->u.dx, n));
    w->v = add_wrap(w->v, mul_wrap(t->v.dx, n));
    w->place = place_at(t, &s->draw->sampler, w->q, w->u, w->v, t->turns);
    w->run = course_packed(course_between(t, from, w->place, n, t->up, t->turns));
    return n + (w->x == w->last && (n == 0 || w->block > 1));
}

/* Where the block begins in which pixel a is drawn, of a span from `left` to `last`. */
static inline int32_t block_start(int32_t left, int32_t last, int32_t a, int32_t block)
{
    return left + (max_i32(min_i32(a, last - 1) - left, 0) & -block);
}

/* In blocks of so many pixels: of a span that is short, single ones. */
static inline int32_t block_of(const struct texture_setup *t, int32_t left, int32_t right)
{
    return right - left <= SHORT_SPAN ? 1 : t->block;
}

static void walk_begin(struct walk *w, const struct setup *s, const struct span *p, bool textured)
{
    int32_t left = max_i32(p->left, 0), right = min_i32(p->right, s->frame->width);
    w->last = right - 1;
    w->block = textured ? block_of(&s->texture, left, right) : s->color_block;
    w->x = block_start(left, w->last, p->a, w->block);
}

/* The first block. */
static int32_t walk_first(struct walk *w, const struct setup *s, const struct span *p)
{
    const struct texture_setup *t = &s->texture;
    walk_begin(w, s, p, true);
    w->q = plane_at(&t->q, w->x, p->y);
    w->u = plane_at(&t->u, w->x, p->y);
    w->v = plane_at(&t->v, w->x, p->y);
    w->place = place_at(t, &s->draw->sampler, w->q, w->u, w->v, t->turns);
    return walk_next(w, s);
}

/* ------------------------------------------------------------------ plain texels */

#if SMEAR_SPAN_ROWS

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

#if defined(__ARM_ARCH_6M__) && defined(__OPTIMIZE__)
#define TEXELS_BY_HAND 1

/* In the order in which the registers are filled. */
struct texel_pairs {
    uint32_t dz, du, dv, bend_u, bend_v;
    const uint16_t *end;
    uint32_t *color;
    uint16_t *depth;
    uint32_t z, u, v;
    const uint32_t *texels;
};

/* run_texels for an even number of pixels, on cores with eight registers that do everything and six that only add:
 * compilers keep half of the values on the stack, which doubles the instructions. 17 a pixel. u and v are stepped each
 * alone. Afterwards *p has color, depth, z, u, v for the next pixel. */
SMEAR_INLINE void pairs_by_hand(struct texel_pairs *p, int log2_width, int log2_height)
{
    register struct texel_pairs *r0 __asm__("r0") = p;
    __asm__ volatile(
        ".syntax unified\n\t"
        "push {r0}\n\t"
        "ldm r0!, {r1, r2, r3, r4, r5, r6}\n\t"
        "mov r8, r1\n\t"
        "mov r9, r2\n\t"
        "mov r10, r3\n\t"
        "mov r11, r4\n\t"
        "mov r12, r5\n\t"
        "mov lr, r6\n\t"
        "ldm r0, {r0, r1, r2, r3, r4, r5}\n"
        "1:\n\t"
        "lsrs r6, r2, #16\n\t"
        "ldrh r7, [r1, #0]\n\t"
        "add r2, r8\n\t"
        "cmp r7, r6\n\t"
        "bhs 2f\n\t"
        "strh r6, [r1, #0]\n\t"
        "lsrs r6, r4, %[from_v]\n\t"
        "lsls r6, r6, %[to_v]\n\t"
        "lsrs r7, r3, %[from_u]\n\t"
        "lsls r7, r7, #2\n\t"
        "orrs r6, r7\n\t"
        "ldr r6, [r5, r6]\n\t"
        "str r6, [r0, #0]\n"
        "2: add r3, r9\n\t"
        "add r4, r10\n\t"
        "lsrs r6, r2, #16\n\t"
        "ldrh r7, [r1, #2]\n\t"
        "add r2, r8\n\t"
        "cmp r7, r6\n\t"
        "bhs 3f\n\t"
        "strh r6, [r1, #2]\n\t"
        "lsrs r6, r4, %[from_v]\n\t"
        "lsls r6, r6, %[to_v]\n\t"
        "lsrs r7, r3, %[from_u]\n\t"
        "lsls r7, r7, #2\n\t"
        "orrs r6, r7\n\t"
        "ldr r6, [r5, r6]\n\t"
        "str r6, [r0, #4]\n"
        "3: add r3, r9\n\t"
        "add r4, r10\n\t"
        "add r9, r11\n\t"
        "add r10, r12\n\t"
        "adds r0, #8\n\t"
        "adds r1, #4\n\t"
        "cmp r1, lr\n\t"
        "bne 1b\n\t"
        "pop {r7}\n\t"
        "str r0, [r7, #24]\n\t"
        "str r1, [r7, #28]\n\t"
        "str r2, [r7, #32]\n\t"
        "str r3, [r7, #36]\n\t"
        "str r4, [r7, #40]"
        : "+r"(r0)
        : [from_v] "i"(32 - log2_height), [to_v] "i"(log2_width + 2), [from_u] "i"(32 - log2_width)
        : "r1", "r2", "r3", "r4", "r5", "r6", "r7", "r8", "r9", "r10", "r11", "r12", "lr", "cc", "memory");
}
#else
#define TEXELS_BY_HAND 0
#endif

/* What it takes to step coordinates: where words have 64 bits both at once, else each alone. */
#if UINTPTR_MAX > 0xffffffffu
struct stepper {
    uint64_t uv, step, bend;
};

SMEAR_INLINE struct stepper stepper_make(struct course c)
{
    const struct smear_texture_run run = course_packed(c);
    struct stepper s = { run.at, run.step, run.bend };
    __asm__("" : "+r"(s.bend));     /* a negative, of which compilers keep both */
    return s;
}

SMEAR_INLINE void stepper_next(struct stepper *s) { s->uv += s->step; }
SMEAR_INLINE void stepper_bend(struct stepper *s) { s->step += s->bend; }

SMEAR_INLINE uint32_t stepper_index(const struct stepper *s, int log2_width, int log2_height)
{
    return packed_index(s->uv, log2_width, log2_height);
}
#else
struct stepper {
    struct course at;
};

SMEAR_INLINE struct stepper stepper_make(struct course c)
{
    c.bend_u = 0u - c.bend_u;
    c.bend_v = 0u - c.bend_v;
    __asm__("" : "+r"(c.bend_u), "+r"(c.bend_v));       /* negatives, of which compilers keep both */
    return (struct stepper){ c };
}

SMEAR_INLINE void stepper_next(struct stepper *s)
{
    s->at.u += s->at.du;
    s->at.v += s->at.dv;
}

SMEAR_INLINE void stepper_bend(struct stepper *s)
{
    s->at.du += s->at.bend_u;
    s->at.dv += s->at.bend_v;
}

SMEAR_INLINE uint32_t stepper_index(const struct stepper *s, int log2_width, int log2_height)
{
    return s->at.v >> (32 - log2_height) << log2_width | s->at.u >> (32 - log2_width);
}
#endif

SMEAR_INLINE void texel_step(uint32_t *color, uint16_t *depth, uint32_t *z, uint32_t dz, const uint32_t *texels,
                             struct stepper *s, int log2_width, int log2_height)
{
    uint16_t code = (uint16_t)(*z >> 16);
    if (code > *depth) {
        __asm__ volatile ("");      /* nothing of this in advance: that takes more registers than there are */
        *depth = code;
        *color = texels[stepper_index(s, log2_width, log2_height)];
    }
    *z += dz;
    stepper_next(s);
}

/* n > 0 pixels from the start of a block. */
SMEAR_INLINE void run_texels(uint32_t *color, uint16_t *depth, int32_t n, uint32_t z, uint32_t dz,
                             const uint32_t *texels, struct course course, int log2_width, int log2_height)
{
#if TEXELS_BY_HAND
    if (log2_width == log2_height && log2_width >= 6 && log2_width <= 8) {
        struct texel_pairs p = { dz, course.du, course.dv, 0u - course.bend_u, 0u - course.bend_v, depth + (n & ~1),
                                 color, depth, z, course.u, course.v, texels };
        if (n >= 2) {
            if (log2_width == 6)
                pairs_by_hand(&p, 6, 6);
            else if (log2_width == 7)
                pairs_by_hand(&p, 7, 7);
            else
                pairs_by_hand(&p, 8, 8);
        }
        if (n & 1)
            texel_pixel(p.color, p.depth, p.z, texels, packed_uv(p.u, p.v), log2_width, log2_height);
        return;
    }
#endif
    struct stepper s = stepper_make(course);
    for (; n >= 4; n -= 4, depth += 4, color += 4) {
        __asm__("" : "+r"(n));      /* else compilers multiply to know all values at the end in advance */
        texel_step(color, depth, &z, dz, texels, &s, log2_width, log2_height);
        texel_step(color + 1, depth + 1, &z, dz, texels, &s, log2_width, log2_height);
        stepper_bend(&s);
        texel_step(color + 2, depth + 2, &z, dz, texels, &s, log2_width, log2_height);
        texel_step(color + 3, depth + 3, &z, dz, texels, &s, log2_width, log2_height);
        stepper_bend(&s);
    }
    if (n >= 2) {
        texel_step(color, depth, &z, dz, texels, &s, log2_width, log2_height);
        texel_step(color + 1, depth + 1, &z, dz, texels, &s, log2_width, log2_height);
        stepper_bend(&s);
        n -= 2;
        depth += 2;
        color += 2;
    }
    if (n != 0)
        texel_step(color, depth, &z, dz, texels, &s, log2_width, log2_height);
}

/* On Cortex-M0+ a pointer of its own: members lie too far from the setup's start for its loads. */
static inline const struct texture_setup *texture_of(const struct setup *s)
{
    const struct texture_setup *t = &s->texture;
#if defined(__ARM_ARCH_6M__)
    __asm__("" : "+r"(t));
#endif
    return t;
}

/* Pixels [first, n) of a block that is cut, by the frame's columns or by a bend of the depth code. */
static SMEAR_NOINLINE void run_texels_cut(const struct setup *s, uint32_t *color, uint16_t *depth, int32_t first,
                                          int32_t n, uint32_t z, uint32_t dz, struct smear_texture_run run)
{
    const struct smear_sampler *m = &s->draw->sampler;
    for (int32_t i = 0; i < n; i++, z += dz) {
        if (i >= first)
            texel_pixel(color + i, depth + i, z, (const uint32_t *)m->texels, run.at, m->log2_width, m->log2_height);
        run.at += run.step;
        if (i & 1)
            run.step += run.bend;
    }
}

/* Where blocks would be single pixels: a quotient for each. */
static SMEAR_NOINLINE void row_exact(const struct setup *s, uint32_t *color, uint16_t *depth, int32_t n, uint32_t z,
                                     uint32_t dz, int32_t q, int32_t u, int32_t v)
{
    const struct texture_setup *t = texture_of(s);
    const struct smear_sampler *m = &s->draw->sampler;
    const uint32_t *texels = (const uint32_t *)m->texels;
    const int log2_width = m->log2_width, log2_height = m->log2_height, up = t->up;
    for (; n > 0; n--, color++, depth++) {
        if ((uint16_t)(z >> 16) > *depth) {
            const struct place p = place_at(t, NULL, q, u, v, true);
            *depth = (uint16_t)(z >> 16);
            *color = texels[packed_index(packed_uv((uint32_t)p.u << up, (uint32_t)p.v << up), log2_width, log2_height)];
        }
        z += dz;
        q = add_wrap(q, t->q.dx);
        u = add_wrap(u, t->u.dx);
        v = add_wrap(v, t->v.dx);
    }
}

/* A part of a row: pixels [a, b), and depth codes 16.16 from pixel 0 on. */
struct piece {
    int32_t a, b;
    uint32_t z, dz;
};

/* The next piece of a row [left, right) after pixel a: within the target's columns and one slope of the depth code. False
 * when there is none. Writes its velocities. */
static SMEAR_NOINLINE bool piece_next(struct piece *p, const struct setup *s, const struct span_rows *r, int32_t row,
                                      int32_t a)
{
    int32_t y = r->y + row, units = plane_at(&s->depth, 0, y), dx = s->depth.dx;
    enum depth_slope slope = s->slope;
    p->a = max_i32(a, s->target->x0);
    p->b = min_i32(r->side[row].right, s->target->x1);
    if (p->a >= p->b)
        return false;
    if (slope == SLOPE_BOTH) {
        int32_t here = add_wrap(units, mul_wrap(dx, p->a)), last = add_wrap(units, mul_wrap(dx, p->b - 1));
        slope = here < SLOPE_BREAK ? SLOPE_FAR : SLOPE_NEAR;
        if ((last < SLOPE_BREAK) != (here < SLOPE_BREAK))
            p->b = p->a + pixels_to_bend(here, dx, p->b - p->a);
    }
    p->z = code_from_units(units, slope);
    p->dz = (uint32_t)step_from_units(dx, slope);
    if (setup_writes_velocity(s)) {
        const int32_t at = r->at + row * s->target->window_rows.stride + p->a;
        const struct span span = {
            .a = p->a, .b = p->b, .right = r->side[row].edge, .y = y, .depth = s->target->depth + at, .at = at,
            .z = p->z + p->dz * (uint32_t)p->a, .dz = (int32_t)p->dz
        };
        smear_span_velocity(s, &span);
    }
    return true;
}

/* Nearest texels, opaque, unlit, 32-bit, sizes powers of two, repeated: the plain case. */
SMEAR_INLINE void rows_texel(const struct setup *s, const struct span_rows *r, int log2_width, int log2_height)
{
    const struct smear_raster_target *target = s->target;
    const struct texture_setup *t = texture_of(s);
    const uint32_t *texels = (const uint32_t *)s->draw->sampler.texels;
    const bool in_pieces = s->slope == SLOPE_BOTH || s->writes_velocity || target->x0 > 0
                        || target->x1 < s->frame->width;
    int32_t row_q = plane_at(&t->q, 0, r->y), row_u = plane_at(&t->u, 0, r->y), row_v = plane_at(&t->v, 0, r->y);
    uint32_t row_z = code_from_units(plane_at(&s->depth, 0, r->y), s->slope);
    uint32_t *row_color = target->color + r->at;
    uint16_t *row_depth = target->depth + r->at;
    for (int32_t row = 0; row < r->count; row++) {
        const int32_t left = r->side[row].left, right = r->side[row].right;
        struct piece p;
        uint32_t z = row_z, dz = (uint32_t)step_from_units(s->depth.dx, s->slope);
        int32_t a = left, b = right;
        const bool exact = block_of(t, left, right) == 1;
        while (a < b) {
            int32_t x = a;
            if (in_pieces) {
                if (!piece_next(&p, s, r, row, a))
                    break;
                a = x = p.a;
                b = p.b;
                z = p.z;
                dz = p.dz;
                if (!exact)
                    x = block_start(left, right - 1, a, t->block);
            }
            int32_t q = add_wrap(row_q, mul_wrap(t->q.dx, x)), u = add_wrap(row_u, mul_wrap(t->u.dx, x));
            int32_t v = add_wrap(row_v, mul_wrap(t->v.dx, x));
            if (exact) {
                row_exact(s, row_color + x, row_depth + x, b - x, z + dz * (uint32_t)x, dz, q, u, v);
            } else {
                struct place here = place_at(t, NULL, q, u, v, true);
                do {
                    const int32_t n = min_i32(t->block, right - 1 - x), from = x;
                    q = add_wrap(q, mul_wrap(t->q.dx, n));
                    u = add_wrap(u, mul_wrap(t->u.dx, n));
                    v = add_wrap(v, mul_wrap(t->v.dx, n));
                    const struct place next = place_at(t, NULL, q, u, v, true);
                    const struct course course = course_between(t, here, next, n, t->up, true);
                    here = next;
                    x = from + n == right - 1 ? right : from + n;
                    const uint32_t z_from = z + dz * (uint32_t)from;
                    if (from >= a)
                        run_texels(row_color + from, row_depth + from, min_i32(x, b) - from, z_from, dz, texels, course,
                                   log2_width, log2_height);
                    else
                        run_texels_cut(s, row_color + from, row_depth + from, a - from, min_i32(x, b) - from, z_from, dz,
                                       course_packed(course));
                } while (x < b);
            }
            a = b;
            b = right;
        }
        row_z += (uint32_t)step_from_units(s->depth.dy, s->slope);
        row_q = add_wrap(row_q, t->q.dy);
        row_u = add_wrap(row_u, t->u.dy);
        row_v = add_wrap(row_v, t->v.dy);
        row_color += target->window_rows.stride;
        row_depth += target->window_rows.stride;
    }
}

static void rows_texel_any(const struct setup *s, const struct span_rows *r)
{
    rows_texel(s, r, s->draw->sampler.log2_width, s->draw->sampler.log2_height);
}

#if !TEXELS_BY_HAND
static void rows_texel_64(const struct setup *s, const struct span_rows *r) { rows_texel(s, r, 6, 6); }
static void rows_texel_128(const struct setup *s, const struct span_rows *r) { rows_texel(s, r, 7, 7); }
static void rows_texel_256(const struct setup *s, const struct span_rows *r) { rows_texel(s, r, 8, 8); }
#endif

smear_rows_fn *smear_rows_choose(const struct setup *s)
{
    const struct smear_sampler *t = &s->draw->sampler;
    if (!segment_textured(s->segment) || s->segment->shade != SHADE_NONE || !draw_is_opaque(s->draw) || !t->turns
        || t->format != SMEAR_TEXEL_8888 || t->log2_width == 0 || t->log2_height == 0)
        return NULL;
#if !TEXELS_BY_HAND
    if (t->width == t->height)
        return t->width == 64 ? rows_texel_64 : t->width == 128 ? rows_texel_128
             : t->width == 256 ? rows_texel_256 : rows_texel_any;
#endif
    return rows_texel_any;
}
#endif

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
    int count = draw_is_opaque(s->draw) ? 3 : 4;
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
        int32_t step = x1 > x0 ? part_of(b - a, x1 - x0) : 0;
        c[i] = (uint32_t)(a + step * (x - x0));
        d[i] = (uint32_t)step;
    }
}

/* Multiplies n texels by the light of the triangle: flat, or interpolated. */
static void modulate(uint32_t *texel, const struct setup *s, const struct span *p, const struct block *k,
                     int32_t n)
{
    const bool linear = frame_is_linear(s->frame);
    uint32_t c[4], d[4] = { 0, 0, 0, 0 };
    if (s->segment->shade == SHADE_FLAT) {
        for (int i = 0; i < 3; i++) {
            uint32_t code = s->color >> (16 - 8 * i) & 255u;
            c[i] = linear ? (uint32_t)smear_srgb_decode[code] << 8 : code << 16;
        }
        c[3] = pixel_alpha(s->color) << 16;
    } else {
        channels_at(s, p, k, c, d);
    }
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
    if (frame_is_linear(s->frame)) {
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
    if (draw_is_cutout(s->draw)) {
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
                *color = pixel_blend(*color, *in, pixel_alpha(*in), frame_is_linear(s->frame));
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
static int32_t plain_next(struct walk *w)
{
    int32_t n = min_i32(w->block, w->last - w->x);
    w->start = w->x;
    w->x += n;
    return n + (w->x == w->last);
}

static int32_t plain_first(struct walk *w, const struct setup *s, const struct span *p)
{
    walk_begin(w, s, p, false);
    return plain_next(w);
}

/* In blocks: texels, then light, then the write. */
void smear_span_general(const struct setup *s, const struct span *p)
{
    uint32_t block[BLOCK_MAX + 1];
    uint32_t *color = p->color;
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
        count = plain_first(&w, s, p);
    for (;;) {
        n = min_i32(w.start + count, p->b) - k.x;
        k.start = w.start;
        k.end = min_i32(w.start + count, w.last);
        if (textured) {
            smear_sample(block, &s->draw->sampler, &w.run, k.x - k.start, n);
            if (s->segment->shade != SHADE_NONE)
                modulate(block, s, p, &k, n);
        } else if (segment_gouraud(s->segment)) {
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
        count = textured ? walk_next(&w, s) : plain_next(&w);
    }
}
