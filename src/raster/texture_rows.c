/* SPDX-License-Identifier: MIT */
/* texture_rows.c - texels: nearest, opaque, sizes powers of two, repeated. Unlit ones in the target's own pixels are
 * copied; others become pixels where they change, in a light that is the same for the whole triangle. Rows of
 * a triangle are drawn together, a block of pixels after the other. */
#include "raster/texture_rows.h"

#include "raster/texcoord.h"

#if SMEAR_SPAN_ROWS

/* ------------------------------------------------------------------ texels */

enum texels {
    TEXELS_WIDE,            /* 0xAARRGGBB, copied */
    TEXELS_NARROW,          /* RGB565, copied */
    TEXELS_LIT,             /* of any format and light, to 32 bits */
    TEXELS_LIT_NARROW       /* to RGB565 */
};

SMEAR_INLINE bool are_lit(enum texels kind) { return kind >= TEXELS_LIT; }
SMEAR_INLINE bool are_narrow(enum texels kind) { return kind == TEXELS_NARROW || kind == TEXELS_LIT_NARROW; }

/* The last texel of a run, and the pixel that it became. Where textures are
 * magnified, most pixels look like those before them. */
struct lit {
    uint32_t index, pixel;              /* the order in which registers are filled by hand */
    uint32_t from_v, mask_v, from_u;    /* index = v >> from_v & mask_v | u >> from_u */
    uint32_t texel;
    uint32_t red, green, blue;          /* light: codes */
    const struct smear_sampler *sampler;
    bool narrow;
};

/* The light is even, and no linear one: see smear_rows_choose. */
static SMEAR_NOINLINE void lit_start(struct lit *l, const struct setup *s)
{
    l->index = ~0u;
    l->texel = 0;
    l->pixel = 0;           /* that of black */
    l->red = l->green = l->blue = 255;
    if (segment_gouraud(s->segment)) {
        l->red = (uint32_t)s->channel[0].at >> 16 & 255u;
        l->green = (uint32_t)s->channel[1].at >> 16 & 255u;
        l->blue = (uint32_t)s->channel[2].at >> 16 & 255u;
    } else if (s->segment->shade == SHADE_FLAT) {
        l->red = pixel_red(s->color);
        l->green = pixel_green(s->color);
        l->blue = pixel_blue(s->color);
    }
    const struct smear_sampler *m = l->sampler = &s->draw->sampler;
    l->narrow = target_is_direct(s->target);
    l->from_v = 32u - m->log2_height - m->log2_width;
    l->mask_v = ((1u << m->log2_height) - 1u) << m->log2_width;
    l->from_u = 32u - m->log2_width;
}

/* The pixel of another texel. */
static SMEAR_NOINLINE uint32_t lit_find(struct lit *l, uint32_t index)
{
    const uint32_t pair = 0xff00ffu, t = sampler_fetch(l->sampler, index, l->sampler->format) & 0xffffffu;
    l->index = index;
    if (t == l->texel)
        return l->pixel;
    /* code_times, of red and blue in one word */
    uint32_t rb = (pixel_red(t) * l->red << 16) + pixel_blue(t) * l->blue + 0x800080u;
    rb = (rb + (rb >> 8 & pair)) >> 8 & pair;
    const uint32_t p = rb | code_times(pixel_green(t), l->green) << 8;
    l->texel = t;
    l->pixel = l->narrow ? rgb565_nearest(p) : p;
    return l->pixel;
}

SMEAR_INLINE uint32_t lit_pixel(struct lit *l, uint32_t index)
{
    return index == l->index ? l->pixel : lit_find(l, index);
}

/* ------------------------------------------------------------------ pixels */

SMEAR_INLINE uint32_t packed_index(uint64_t uv, int log2_width, int log2_height)
{
    return (uint32_t)(uv >> 32) >> (32 - log2_height) << log2_width | (uint32_t)uv >> (32 - log2_width);
}

/* Pixel i becomes a texel. */
SMEAR_INLINE void put_texel(void *color, int32_t i, const void *texels, struct lit *lit, uint32_t index,
                            enum texels kind)
{
    if (kind == TEXELS_NARROW)
        ((uint16_t *)color)[i] = ((const uint16_t *)texels)[index];
    else if (kind == TEXELS_WIDE)
        ((uint32_t *)color)[i] = ((const uint32_t *)texels)[index];
    else if (kind == TEXELS_LIT_NARROW)
        ((uint16_t *)color)[i] = (uint16_t)lit_pixel(lit, index);
    else
        ((uint32_t *)color)[i] = lit_pixel(lit, index);
}

SMEAR_INLINE void texel_pixel(void *color, uint16_t *depth, uint32_t z, const void *texels, struct lit *lit,
                              uint64_t uv, int log2_width, int log2_height, enum texels kind)
{
    uint16_t code = (uint16_t)(z >> 16);
    if (code > *depth) {
        *depth = code;
        put_texel(color, 0, texels, lit, packed_index(uv, log2_width, log2_height), kind);
    }
}

/* A run of pixels along a course, and where it has come to. Coordinates are stepped both at once where words
 * have 64 bits, else each alone. Bends are negative: what steps gain. */
#if UINTPTR_MAX > 0xffffffffu
struct texel_run {
    uint64_t uv, step, bend;
    void *color;
    uint16_t *depth;
    uint32_t z, dz;
    const void *texels;
    struct lit *lit;
    uint64_t bits, fold;        /* of an index; what brings those of u next to those of v */
};

SMEAR_INLINE void run_index_start(struct texel_run *r, int log2_width, int log2_height)
{
    r->bits = (uint64_t)(0u - (1u << (32 - log2_height))) << 32 | (0u - (1u << (32 - log2_width)));
    r->fold = 1u + ((uint64_t)1 << (32 - log2_height));
    __asm__("" : "+r"(r->fold));        /* one product, not a shift and a sum */
}

SMEAR_INLINE void run_course(struct texel_run *r, struct course c)
{
    const struct smear_texture_run run = course_packed(c);
    r->uv = run.at;
    r->step = run.step;
    r->bend = run.bend;
}

SMEAR_INLINE uint64_t run_uv(const struct texel_run *r) { return r->uv; }

SMEAR_INLINE uint32_t run_index(const struct texel_run *r, int log2_width, int log2_height)
{
    return (uint32_t)((r->uv & r->bits) * r->fold >> (64 - log2_width - log2_height));
}

SMEAR_INLINE void run_step(struct texel_run *r)
{
    r->uv += r->step;
    r->step += r->bend;
}
#else
struct texel_run {              /* the order in which registers are filled by hand */
    uint32_t dz, du, dv, bend_u, bend_v;
    const uint16_t *end;
    void *color;
    uint16_t *depth;
    uint32_t z, u, v;
    const void *texels;
    int32_t count;
    struct lit *lit;
};

SMEAR_INLINE void run_index_start(struct texel_run *r, int log2_width, int log2_height)
{
    (void)r, (void)log2_width, (void)log2_height;
}

SMEAR_INLINE void run_course(struct texel_run *r, struct course c)
{
    r->u = c.u;
    r->v = c.v;
    r->du = c.du;
    r->dv = c.dv;
    r->bend_u = 0u - c.bend_u;
    r->bend_v = 0u - c.bend_v;
}

SMEAR_INLINE uint64_t run_uv(const struct texel_run *r) { return packed_uv(r->u, r->v); }

SMEAR_INLINE uint32_t run_index(const struct texel_run *r, int log2_width, int log2_height)
{
    return r->v >> (32 - log2_height) << log2_width | r->u >> (32 - log2_width);
}

SMEAR_INLINE void run_step(struct texel_run *r)
{
    r->u += r->du;
    r->v += r->dv;
    r->du += r->bend_u;
    r->dv += r->bend_v;
}
#endif

#if defined(__ARM_ARCH_6M__) && defined(__OPTIMIZE__)
#define TEXELS_BY_HAND 1

/* One pixel, where the depth lies AT and the colour PLACE further on;
 * LABEL is behind it. z in r2, u in r3, v in r4. */
#define PIXEL_BY_HAND(LOAD, STORE, SIZE, AT, PLACE, LABEL) \
        "lsrs r6, r2, #16\n\t" \
        "ldrh r7, [r1, #" AT "]\n\t" \
        "add r2, r8\n\t" \
        "cmp r7, r6\n\t" \
        "bhs " LABEL "f\n\t" \
        "strh r6, [r1, #" AT "]\n\t" \
        "lsrs r6, r4, %[from_v]\n\t" \
        "lsls r6, r6, %[to_v]\n\t" \
        "lsrs r7, r3, %[from_u]\n\t" \
        "lsls r7, r7, #" SIZE "\n\t" \
        "orrs r6, r7\n\t" \
        LOAD " r6, [r5, r6]\n\t" \
        STORE " r6, [r0, #" PLACE "]\n" \
        LABEL ": "

/* Keeps the run, at r0, and fills the registers of its steps. */
#define STEPS_BY_HAND \
        ".syntax unified\n\t" \
        "push {r0}\n\t" \
        "ldm r0!, {r1, r2, r3, r4, r5, r6}\n\t" \
        "mov r8, r1\n\t" \
        "mov r9, r2\n\t" \
        "mov r10, r3\n\t" \
        "mov r11, r4\n\t" \
        "mov r12, r5\n\t"

/* LOAD, STORE, SIZE, NEXT, STEP: of texels and pixels; a pixel's size as
 * a power of two, where the next one is, two. */
#define PAIRS_BY_HAND(LOAD, STORE, SIZE, NEXT, STEP) \
    __asm__ volatile( \
        STEPS_BY_HAND \
        "mov lr, r6\n\t" \
        "ldm r0, {r0, r1, r2, r3, r4, r5}\n" \
        "1:\n\t" \
        PIXEL_BY_HAND(LOAD, STORE, SIZE, "0", "0", "2") \
        "add r3, r9\n\t" \
        "add r4, r10\n\t" \
        "add r9, r11\n\t" \
        "add r10, r12\n\t" \
        PIXEL_BY_HAND(LOAD, STORE, SIZE, "2", NEXT, "3") \
        "add r3, r9\n\t" \
        "add r4, r10\n\t" \
        "add r9, r11\n\t" \
        "add r10, r12\n\t" \
        "adds r0, #" STEP "\n\t" \
        "adds r1, #4\n\t" \
        "cmp r1, lr\n\t" \
        "bne 1b\n\t" \
        "ldr r6, [sp]\n\t" \
        "ldr r6, [r6, #48]\n\t" \
        "lsrs r6, r6, #1\n\t" \
        "bcc 5f\n\t" \
        PIXEL_BY_HAND(LOAD, STORE, SIZE, "0", "0", "4") \
        "adds r0, #" NEXT "\n\t" \
        "adds r1, #2\n" \
        "5: pop {r7}\n\t" \
        "str r0, [r7, #24]\n\t" \
        "str r1, [r7, #28]\n\t" \
        "str r2, [r7, #32]" \
        : "+r"(r0) \
        : [from_v] "i"(32 - log2_height), [to_v] "i"(log2_width + (kind == TEXELS_NARROW ? 1 : 2)), \
          [from_u] "i"(32 - log2_width) \
        : "r1", "r2", "r3", "r4", "r5", "r6", "r7", "r8", "r9", "r10", "r11", "r12", "lr", "cc", "memory")

/* run_texels on cores with eight registers that do everything and six that only add:
 * compilers keep half of the values on the stack, which doubles the instructions.
 * 18 a pixel. u and v are stepped each alone. */
SMEAR_INLINE void pairs_by_hand(struct texel_run *p, int log2_width, int log2_height, enum texels kind)
{
    register struct texel_run *r0 __asm__("r0") = p;
    if (kind == TEXELS_NARROW)
        PAIRS_BY_HAND("ldrh", "strh", "1", "2", "4");
    else
        PAIRS_BY_HAND("ldr", "str", "2", "4", "8");
}

/* The same of lit texels of any size. On the stack from sp on: the words of struct lit up to
 * from_u, the end, the struct, the run. v and u make the index, which lit_find takes if it is new. */
#define LIT_PIXEL_BY_HAND(STORE, AT, PLACE, LABEL, KNOWN) \
        "lsrs r6, r2, #16\n\t" \
        "ldrh r7, [r1, #" AT "]\n\t" \
        "add r2, r8\n\t" \
        "cmp r7, r6\n\t" \
        "bhs " LABEL "f\n\t" \
        "strh r6, [r1, #" AT "]\n\t" \
        "ldr r7, [sp, #8]\n\t" \
        "movs r6, r4\n\t" \
        "lsrs r6, r7\n\t" \
        "ldr r7, [sp, #12]\n\t" \
        "ands r6, r7\n\t" \
        "ldr r7, [sp, #16]\n\t" \
        "movs r5, r3\n\t" \
        "lsrs r5, r7\n\t" \
        "orrs r5, r6\n\t" \
        "ldr r7, [sp]\n\t" \
        "cmp r5, r7\n\t" \
        "beq " KNOWN "f\n\t" \
        "bl 8f\n" \
        KNOWN ": ldr r6, [sp, #4]\n\t" \
        STORE " r6, [r0, #" PLACE "]\n" \
        LABEL ": "

#define LIT_PAIRS_BY_HAND(STORE, NEXT, STEP) \
    __asm__ volatile( \
        STEPS_BY_HAND \
        "ldr r7, [r0, #28]\n\t" \
        "push {r6, r7}\n\t" \
        "ldm r7!, {r1, r2, r3, r4, r5}\n\t" \
        "push {r1, r2, r3, r4, r5}\n\t" \
        "ldm r0, {r0, r1, r2, r3, r4}\n" \
        "1:\n\t" \
        LIT_PIXEL_BY_HAND(STORE, "0", "0", "2", "3") \
        "add r3, r9\n\t" \
        "add r4, r10\n\t" \
        "add r9, r11\n\t" \
        "add r10, r12\n\t" \
        LIT_PIXEL_BY_HAND(STORE, "2", NEXT, "4", "5") \
        "add r3, r9\n\t" \
        "add r4, r10\n\t" \
        "add r9, r11\n\t" \
        "add r10, r12\n\t" \
        "adds r0, #" STEP "\n\t" \
        "adds r1, #4\n\t" \
        "ldr r7, [sp, #20]\n\t" \
        "cmp r1, r7\n\t" \
        "bne 1b\n\t" \
        "ldr r6, [sp, #28]\n\t" \
        "ldr r6, [r6, #48]\n\t" \
        "lsrs r6, r6, #1\n\t" \
        "bcc 9f\n\t" \
        LIT_PIXEL_BY_HAND(STORE, "0", "0", "6", "7") \
        "adds r0, #" NEXT "\n\t" \
        "adds r1, #2\n\t" \
        "b 9f\n" \
        "8: push {r0, r1, r2, r3}\n\t" \
        "mov r6, r12\n\t" \
        "mov r7, lr\n\t" \
        "push {r6, r7}\n\t" \
        "str r5, [sp, #24]\n\t" \
        "ldr r0, [sp, #48]\n\t" \
        "movs r1, r5\n\t" \
        "bl %c[find]\n\t" \
        "str r0, [sp, #28]\n\t" \
        "pop {r6, r7}\n\t" \
        "mov r12, r6\n\t" \
        "mov lr, r7\n\t" \
        "pop {r0, r1, r2, r3}\n\t" \
        "bx lr\n" \
        "9: add sp, #28\n\t" \
        "pop {r7}\n\t" \
        "str r0, [r7, #24]\n\t" \
        "str r1, [r7, #28]\n\t" \
        "str r2, [r7, #32]" \
        : "+r"(r0) \
        : [find] "i"(lit_find) \
        : "r1", "r2", "r3", "r4", "r5", "r6", "r7", "r8", "r9", "r10", "r11", "r12", "lr", "cc", "memory")

/* 26 a pixel. */
SMEAR_INLINE void lit_by_hand(struct texel_run *p, enum texels kind)
{
    register struct texel_run *r0 __asm__("r0") = p;
    if (are_narrow(kind))
        LIT_PAIRS_BY_HAND("strh", "2", "4");
    else
        LIT_PAIRS_BY_HAND("str", "4", "8");
}
#else
#define TEXELS_BY_HAND 0
#endif

SMEAR_INLINE void texel_step(struct texel_run *r, int32_t i, int log2_width, int log2_height, enum texels kind)
{
    uint16_t code = (uint16_t)(r->z >> 16);
    if (code > r->depth[i]) {
        __asm__ volatile ("");      /* nothing of this in advance: that takes more registers than there are */
        r->depth[i] = code;
        put_texel(r->color, i, r->texels, r->lit, run_index(r, log2_width, log2_height), kind);
    }
    r->z += r->dz;
    __asm__("" : "+r"(r->z));       /* one sum, not one for every other pixel */
    run_step(r);
}

SMEAR_INLINE void run_advance(struct texel_run *r, int32_t n, bool narrow)
{
    r->depth += n;
    r->color = pixel_after(r->color, n, narrow);
}

/* Twelve values are as many as ARM has registers for; compilers would rather keep copies of some. */
#if defined(__arm__) && defined(__OPTIMIZE__) && (defined(__thumb2__) || !defined(__thumb__))
#define ALL_IN_REGISTERS \
    __asm__("" : "+r"(u), "+r"(v), "+r"(du), "+r"(dv), "+r"(z), "+r"(depth), "+r"(color) \
               : "r"(bend_u), "r"(bend_v), "r"(dz), "r"(texels), "r"(end))
#else
#define ALL_IN_REGISTERS (void)0
#endif

/* n > 1 pixels from the start of a block. Afterwards color, depth and z are those of the next pixel. */
SMEAR_INLINE void run_texels(struct texel_run *run, int32_t n, int log2_width, int log2_height, enum texels kind)
{
#if TEXELS_BY_HAND
    if (are_lit(kind) || __builtin_constant_p(log2_width)) {
        run->count = n;
        run->end = run->depth + (n & ~1);
        if (are_lit(kind))
            lit_by_hand(run, kind);
        else
            pairs_by_hand(run, log2_width, log2_height, kind);
        return;
    }
#endif
#if UINTPTR_MAX > 0xffffffffu
    struct texel_run r = *run;      /* in registers */
    for (; n >= 4; n -= 4) {
        __asm__("" : "+r"(n));      /* else compilers multiply to know all values at the end in advance */
        texel_step(&r, 0, log2_width, log2_height, kind);
        texel_step(&r, 1, log2_width, log2_height, kind);
        texel_step(&r, 2, log2_width, log2_height, kind);
        texel_step(&r, 3, log2_width, log2_height, kind);
        run_advance(&r, 4, are_narrow(kind));
    }
    if (n & 2) {
        texel_step(&r, 0, log2_width, log2_height, kind);
        texel_step(&r, 1, log2_width, log2_height, kind);
        run_advance(&r, 2, are_narrow(kind));
    }
    if (n & 1) {
        texel_step(&r, 0, log2_width, log2_height, kind);
        run_advance(&r, 1, are_narrow(kind));
    }
    run->color = r.color;
    run->depth = r.depth;
    run->z = r.z;
#else
    uint32_t u = run->u, v = run->v, du = run->du, dv = run->dv, z = run->z;
    const uint32_t bend_u = run->bend_u, bend_v = run->bend_v, dz = run->dz;
    const void *const texels = run->texels;
    struct lit *const lit = run->lit;
    void *color = run->color;
    uint16_t *depth = run->depth, *const end = depth + (n & ~1);
#define TEXEL_STEP(I) \
    do { \
        ALL_IN_REGISTERS; \
        if (z >> 16 > depth[I]) { \
            SMEAR_KEEP_BRANCH(); \
            depth[I] = (uint16_t)(z >> 16); \
            put_texel(color, I, texels, lit, \
                      v >> (32 - log2_height) << log2_width | u >> (32 - log2_width), kind); \
        } \
        z += dz; \
        u += du; \
        v += dv; \
        du += bend_u; \
        dv += bend_v; \
    } while (0)
    for (; depth != end; depth += 2, color = pixel_after(color, 2, are_narrow(kind))) {
        TEXEL_STEP(0);
        TEXEL_STEP(1);
    }
    if (n & 1) {
        texel_pixel(color, depth, z, texels, lit, packed_uv(u, v), log2_width, log2_height, kind);
        color = pixel_after(color, 1, are_narrow(kind));
        depth++;
        z += dz;
    }
    run->color = color;
    run->depth = depth;
    run->z = z;
#endif
}

/* ------------------------------------------------------------------ blocks */

/* On Cortex-M0+ a pointer of its own: members lie too far from the setup's start for its loads. */
static inline const struct texture_setup *texture_of(const struct setup *s)
{
    const struct texture_setup *t = &s->texture;
#if defined(__ARM_ARCH_6M__)
    __asm__("" : "+r"(t));
#endif
    return t;
}

/* A run, and planes and place where its block ends. */
struct track {
    struct texel_run run;
    int32_t q, u, v;
    struct place place;
};

SMEAR_INLINE void track_go(struct track *k, const struct texture_setup *t, enum texture_mode mode, int32_t n)
{
    const struct place from = k->place;
    const int32_t q = add_wrap(k->q, mul_wrap(t->q.dx, n)), u = add_wrap(k->u, mul_wrap(t->uv[0].dx, n));
    const int32_t v = add_wrap(k->v, mul_wrap(t->uv[1].dx, n));
    const struct place to = place_at(t, mode, NULL, q, u, v, true);
    const struct course c = course_between(t, from, to, n, true);
    k->q = q;
    k->u = u;
    k->v = v;
    k->place = to;
    run_course(&k->run, c);
}

/* With few registers functions of their own: the loops over pixels take them all. */
#if UINTPTR_MAX > 0xffffffffu
#define TRACK_FUNCTION SMEAR_INLINE
#else
#define TRACK_FUNCTION static SMEAR_NOINLINE
#endif

#if UINTPTR_MAX > 0xffffffffu
/* The course of the next n pixels. */
TRACK_FUNCTION void track_next(struct track *k, const struct texture_setup *t, int32_t n)
{
    track_go(k, t, t->mode, n);
}
#elif SMEAR_HAS_MUL64
TRACK_FUNCTION void track_next(struct track *k, const struct texture_setup *t, int32_t n)
{
    if (t->mode == TEXTURE_DIVIDED)
        track_go(k, t, TEXTURE_DIVIDED, n);
    else
        track_go(k, t, TEXTURE_AFFINE, n);
}
#else

/* What both coordinates of a block have in common. */
struct going {
    int32_t n, part;            /* 2^16 / n */
    int32_t recip, rate;        /* place_at's r; change of q, q16 */
    int up, recip_up;
    bool bent;
};

/* track_go for one coordinate after the other: what both take at once is more than there are registers. */
SMEAR_INLINE void coordinate_go(const struct going *g, const struct plane *plane, int32_t *restrict value,
                                int32_t *restrict place, uint32_t *restrict at, uint32_t *restrict step,
                                uint32_t *restrict bend, uint32_t mask)
{
    const int32_t here = add_wrap(*value, mul_wrap(plane->dx, g->n)), from = *place;
    const int32_t to = mulh_i32(shl_wrap(here >> 1, g->recip_up), g->recip);
    int32_t change = part_by(sub_wrap(to, from), g->part);
    *value = here;
    *place = to;
    *at = (uint32_t)from << g->up;
    *bend = 0;
    if (g->bent) {
        const int32_t b = mul_wrap(change >> 13, g->rate) >> 2;
        change = add_wrap(change, mul_wrap(b, g->n - 1) >> 1);
        *bend = 0u - ((uint32_t)b << g->up & mask);
    }
    *step = (uint32_t)change << g->up & mask;
}

static SMEAR_NOINLINE void divided_go(struct track *restrict k, const struct texture_setup *restrict t,
                                      int32_t n)
{
    struct going g = { .n = n, .part = inverse[n], .up = t->up, .bent = t->bent };
    const int32_t q = add_wrap(k->q, mul_wrap(t->q.dx, n));
    const uint32_t d = (uint32_t)max_i32(q, 1 << 11);
    const int zeros = count_leading_zeros(d);
    int32_t nearness = 0;
    k->q = q;
    g.recip = (int32_t)recip_norm(d << zeros);
    g.recip_up = zeros - 1;
    if (g.bent)
        nearness = mulh_i32(t->slope, g.recip) >> (20 - zeros);
    g.rate = (k->place.nearness + nearness) >> 1;
    k->place.nearness = nearness;
    coordinate_go(&g, &t->uv[0], &k->u, &k->place.u, &k->run.u, &k->run.du, &k->run.bend_u, ~0u);
    coordinate_go(&g, &t->uv[1], &k->v, &k->place.v, &k->run.v, &k->run.dv, &k->run.bend_v, ~255u);
    k->run.v = turns_start(k->run.v);
}

/* The course of the next n pixels. */
TRACK_FUNCTION void track_next(struct track *k, const struct texture_setup *t, int32_t n)
{
    if (t->mode == TEXTURE_DIVIDED)
        divided_go(k, t, n);
    else
        track_go(k, t, TEXTURE_AFFINE, n);
}
#endif

/* At pixel (x, y). */
TRACK_FUNCTION void track_start(struct track *k, const struct texture_setup *t, int32_t x, int32_t y)
{
    k->q = plane_at(&t->q, x, y);
    k->u = plane_at(&t->uv[0], x, y);
    k->v = plane_at(&t->uv[1], x, y);
    k->place = place_at(t, t->mode, NULL, k->q, k->u, k->v, true);
}

/* ------------------------------------------------------------------ pieces */

SMEAR_NOINLINE bool smear_rows_piece(struct rows_piece *p, const struct setup *s, const struct span_rows *r,
                                     int32_t row, int32_t a)
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
    if (s->writes_velocity) {
        const int32_t at = r->at + row * s->target->window_rows.stride + p->a;
        const struct span span = {
            .a = p->a, .b = p->b, .right = r->side[row].edge, .y = y,
            .depth = s->target->depth + at, .at = at,
            .z = p->z + p->dz * (uint32_t)p->a, .dz = (int32_t)p->dz
        };
        smear_span_velocity(s, &span);
    }
    return true;
}

/* How texels become pixels where there is no loop for each way: lit where `lit` is not null. */
static inline enum texels texels_of(const struct setup *s, const struct lit *lit)
{
    const bool narrow = target_is_direct(s->target);
    return lit != NULL ? (narrow ? TEXELS_LIT_NARROW : TEXELS_LIT) : narrow ? TEXELS_NARROW : TEXELS_WIDE;
}

/* Pixels [first, end) of a block of which the run has come to pixel i. */
static void run_texels_cut(const struct setup *s, struct texel_run *r, int32_t i, int32_t first, int32_t end)
{
    const enum texels kind = texels_of(s, r->lit);
    const struct smear_sampler *m = &s->draw->sampler;
    for (; i < end; i++, r->z += r->dz) {
        if (i >= first)
            texel_pixel(r->color, r->depth, r->z, m->texels, r->lit, run_uv(r), m->log2_width, m->log2_height,
                        kind);
        run_advance(r, 1, are_narrow(kind));
        run_step(r);
    }
}

/* Pixels [from, end) of a row, which are a block; some may lie outside the
 * piece. False when no more are to be drawn. */
static SMEAR_NOINLINE bool run_texels_pieces(const struct setup *s, const struct span_rows *r, int32_t row,
                                             struct texel_run *run, struct rows_piece *p, int32_t from,
                                             int32_t end)
{
    for (int32_t x = from;; x = p->a) {
        run_texels_cut(s, run, x - from, p->a - from, min_i32(p->b, end) - from);
        if (p->b >= end)
            return true;
        if (!smear_rows_piece(p, s, r, row, p->b))
            return false;
        run->dz = p->dz;
        run->z = p->z + p->dz * (uint32_t)p->a;
    }
}

/* ------------------------------------------------------------------ rows */

/* Numbers of rows. */
struct row_list {
    int32_t count;
    uint8_t row[SPAN_ROWS];
};

/* Rows whose blocks would be single pixels: a place for each. */
static SMEAR_NOINLINE void draw_places(const struct setup *s, const struct span_rows *r,
                                       const struct row_list *list, struct lit *lit)
{
    const enum texture_mode mode = s->texture.mode == TEXTURE_DIVIDED ? TEXTURE_DIVIDED : TEXTURE_AFFINE;
    const struct smear_raster_target *target = s->target;
    const struct texture_setup *t = texture_of(s);
    const struct smear_sampler *m = &s->draw->sampler;
    const enum texels kind = texels_of(s, lit);
    const bool narrow = are_narrow(kind), plain = rows_are_plain(s, r);
    const int up = t->up, log2_width = m->log2_width, log2_height = m->log2_height;
    const void *const texels = m->texels;
    struct rows_piece p;
    p.dz = (uint32_t)step_from_units(s->depth.dx, s->slope);
    for (int32_t i = 0; i < list->count; i++) {
        const int32_t row = list->row[i], y = r->y + row, at = r->at + row * target->window_rows.stride;
        p.a = r->side[row].left;
        p.b = r->side[row].right;
        p.z = code_from_units(plane_at(&s->depth, 0, y), s->slope);
        if (!plain && !smear_rows_piece(&p, s, r, row, p.a))
            continue;
        do {
            int32_t q = plane_at(&t->q, p.a, y), u = plane_at(&t->uv[0], p.a, y),
                    v = plane_at(&t->uv[1], p.a, y);
            uint32_t z = p.z + p.dz * (uint32_t)p.a;
            uint16_t *depth = target->depth + (at + p.a), *const end = target->depth + (at + p.b);
            void *color = narrow ? (void *)(target->direct + (at + p.a)) : target->color + (at + p.a);
            for (; depth < end; depth++, color = pixel_after(color, 1, narrow)) {
                if (z >> 16 > *depth) {
                    const struct place place = place_at(t, mode, NULL, q, u, v, true);
                    *depth = (uint16_t)(z >> 16);
                    put_texel(color, 0, texels, lit,
                              (uint32_t)place.v << up >> (32 - log2_height) << log2_width
                                  | (uint32_t)place.u << up >> (32 - log2_width), kind);
                }
                z += p.dz;
                q = add_wrap(q, t->q.dx);
                u = add_wrap(u, t->uv[0].dx);
                v = add_wrap(v, t->uv[1].dx);
            }
        } while (!plain && smear_rows_piece(&p, s, r, row, p.b));
    }
}

/* Lists the others in `quotients`. */
SMEAR_INLINE void draw_blocks(const struct setup *s, const struct span_rows *r, struct row_list *quotients,
                              struct lit *lit, int log2_width, int log2_height, enum texels kind)
{
    const bool narrow = are_narrow(kind);
    const struct smear_raster_target *target = s->target;
    const struct texture_setup *t = texture_of(s);
    const int32_t block = t->block, least = block > 1 ? SHORT_SPAN : INT32_MAX;     /* block_of */
    const bool plain = rows_are_plain(s, r);
    struct track k;
    uint8_t *next_quotient = quotients->row;
    k.run.dz = (uint32_t)step_from_units(s->depth.dx, s->slope);
    k.run.texels = s->draw->sampler.texels;
    k.run.lit = lit;
    run_index_start(&k.run, log2_width, log2_height);
    const int32_t rows = r->count;
    for (int32_t row = 0; row < rows; row++) {
        const int32_t left = r->side[row].left, right = r->side[row].right;
        struct rows_piece p;
        if (right - left <= least) {
            *next_quotient = (uint8_t)row;
            next_quotient += left < right;
            continue;
        }
        int32_t x = left, least_rest = -1;              /* at the end of a block that lies in the piece */
        if (plain) {
            k.run.z = code_from_units(plane_at(&s->depth, x, r->y + row), s->slope);
        } else {
            if (!smear_rows_piece(&p, s, r, row, left))
                continue;
            x = block_start(left, right - 1, p.a, block);
            least_rest = x < p.a ? INT32_MAX : right - 1 - p.b;
            k.run.dz = p.dz;
            k.run.z = p.z + p.dz * (uint32_t)x;
        }
        const int32_t at = r->at + row * target->window_rows.stride + x;
        k.run.depth = target->depth + at;
        k.run.color = narrow ? (void *)(target->direct + at) : target->color + at;
        track_start(&k, t, x, r->y + row);
        int32_t rest = right - 1 - x;
        do {
            const int32_t n = min_i32(block, rest);
            track_next(&k, t, n);
            rest -= n;
            const int32_t last = rest == 0, count = n + last;
            if (rest - last >= least_rest) {
                run_texels(&k.run, count, log2_width, log2_height, kind);
            } else {
                const int32_t end = right - 1 - rest + last;
                struct texel_run run = k.run;       /* that one stays in registers */
                if (!run_texels_pieces(s, r, row, &run, &p, end - count, end))
                    break;
                least_rest = right - 1 - p.b;
                k.run = run;
            }
        } while (rest > 0);
    }
    quotients->count = (int32_t)(next_quotient - quotients->row);
}

/* ------------------------------------------------------------------ polynomials */

#if UINTPTR_MAX > 0xffffffffu
typedef uint64_t uv_pair;

SMEAR_INLINE uv_pair uv_make(int32_t u, int32_t v) { return packed_step((uint32_t)u, (uint32_t)v); }
SMEAR_INLINE uv_pair uv_add(uv_pair a, uv_pair b) { return a + b; }
SMEAR_INLINE uv_pair uv_times(uv_pair a, int32_t n) { return a * (uint64_t)(int64_t)n; }

SMEAR_INLINE void run_pair(struct texel_run *r, uv_pair at, uv_pair step, uv_pair bend)
{
    r->uv = at;
    r->step = step;
    r->bend = bend;
}
#else
typedef struct { uint32_t u, v; } uv_pair;

SMEAR_INLINE uv_pair uv_make(int32_t u, int32_t v) { return (uv_pair){ (uint32_t)u, (uint32_t)v }; }
SMEAR_INLINE uv_pair uv_add(uv_pair a, uv_pair b) { return (uv_pair){ a.u + b.u, a.v + b.v }; }

SMEAR_INLINE uv_pair uv_times(uv_pair a, int32_t n)
{
    return (uv_pair){ a.u * (uint32_t)n, a.v * (uint32_t)n };
}

SMEAR_INLINE void run_pair(struct texel_run *r, uv_pair at, uv_pair step, uv_pair bend)
{
    r->u = at.u;
    r->v = at.v;
    r->du = step.u;
    r->dv = step.v;
    r->bend_u = bend.u;
    r->bend_v = bend.v;
}
#endif

/* course_curved, whose values go on from row to row. */
SMEAR_INLINE void draw_curves(const struct setup *s, const struct span_rows *r, struct lit *lit,
                              int log2_width, int log2_height, enum texels kind)
{
    const bool narrow = are_narrow(kind);
    const struct smear_raster_target *target = s->target;
    const struct texture_setup *t = texture_of(s);
    const struct curve *cu = &t->curve[0], *cv = &t->curve[1];
    const int32_t x0 = t->x0, y = r->y - t->y0;
    const uv_pair dxx = uv_make(cu->dxx, cv->dxx), dyy = uv_make(cu->dyy, cv->dyy),
                  dxy = uv_make(cu->dxy, cv->dxy);
    const uv_pair bend = uv_add(dxx, dxx), dyy2 = uv_add(dyy, dyy);
    uv_pair dx = uv_add(uv_make(cu->dx, cv->dx), uv_times(dxy, y)),
            dy = uv_add(uv_make(cu->dy, cv->dy), uv_times(dyy, y));
    uv_pair place = uv_add(uv_make(cu->at, cv->at), uv_times(dy, y));
    dy = uv_add(dy, uv_times(dyy, y + 1));
    const bool plain = rows_are_plain(s, r);
    const uint32_t dz_down = (uint32_t)step_from_units(s->depth.dy, s->slope);
    const uintptr_t to_color = narrow ? (uintptr_t)target->direct - (uintptr_t)target->depth
                                      : (uintptr_t)target->color - 2 * (uintptr_t)target->depth;
    uint32_t z = code_from_units(plane_at(&s->depth, 0, r->y), s->slope);
    uint16_t *depth = target->depth + r->at;
    struct texel_run run;
    run.texels = s->draw->sampler.texels;
    run.lit = lit;
    run.dz = (uint32_t)step_from_units(s->depth.dx, s->slope);
    run_index_start(&run, log2_width, log2_height);
    const ptrdiff_t stride = target->window_rows.stride;
    for (const struct span_side *side = r->side, *const end = side + r->count; side != end; side++) {
        const int32_t left = side->left, n = side->right - left, x = left - x0,
                      row = (int32_t)(side - r->side);
        struct rows_piece p;
        if (n > 0 && (plain || smear_rows_piece(&p, s, r, row, left))) {
            const uv_pair along = uv_times(dxx, x);
            run_pair(&run, uv_add(place, uv_times(uv_add(dx, along), x)),
                     uv_add(dx, uv_add(along, uv_add(along, dxx))), bend);
            run.depth = depth + left;
            run.color = (void *)((narrow ? 1u : 2u) * (uintptr_t)run.depth + to_color);
            run.z = z + run.dz * (uint32_t)left;
            if (!plain) {
                run.dz = p.dz;
                run.z = p.z + p.dz * (uint32_t)left;
            }
            if (!plain && (p.a != left || p.b != left + n)) {
                struct texel_run piece = run;       /* that one stays in registers */
                run_texels_pieces(s, r, row, &piece, &p, left, left + n);
            } else if (n == 1 && TEXELS_BY_HAND) {
                texel_pixel(run.color, run.depth, run.z, run.texels, lit, run_uv(&run), log2_width,
                            log2_height, kind);
            } else {
                run_texels(&run, n, log2_width, log2_height, kind);
            }
        }
        depth += stride;
        z += dz_down;
        place = uv_add(place, dy);
        dy = uv_add(dy, dyy2);
        dx = uv_add(dx, dxy);
    }
}

#define ROWS(NAME, LOG2_WIDTH, LOG2_HEIGHT, KIND) \
    static void rows_##NAME(const struct setup *s, const struct span_rows *r) \
    { \
        struct row_list list; \
        struct lit lit; \
        if (are_lit(KIND)) \
            lit_start(&lit, s); \
        draw_blocks(s, r, &list, are_lit(KIND) ? &lit : NULL, LOG2_WIDTH, LOG2_HEIGHT, KIND); \
        if (list.count != 0) \
            draw_places(s, r, &list, are_lit(KIND) ? &lit : NULL); \
    } \
    static void curves_##NAME(const struct setup *s, const struct span_rows *r) \
    { \
        struct lit lit; \
        if (are_lit(KIND)) \
            lit_start(&lit, s); \
        draw_curves(s, r, are_lit(KIND) ? &lit : NULL, LOG2_WIDTH, LOG2_HEIGHT, KIND); \
    }
#define ANY_WIDTH  s->draw->sampler.log2_width
#define ANY_HEIGHT s->draw->sampler.log2_height

/* Loops of their own for pictures of 32 bits a texel; not for cores whose flash has no room for such. */
#ifdef __ARM_ARCH_6M__
#define WIDE_SIZES 0
#else
#define WIDE_SIZES 1
#endif

ROWS(wide_any, ANY_WIDTH, ANY_HEIGHT, TEXELS_WIDE)
#if WIDE_SIZES
ROWS(wide_64, 6, 6, TEXELS_WIDE)
ROWS(wide_128, 7, 7, TEXELS_WIDE)
ROWS(wide_256, 8, 8, TEXELS_WIDE)
#endif
ROWS(lit, ANY_WIDTH, ANY_HEIGHT, TEXELS_LIT)
#if SMEAR_DIRECT
ROWS(narrow_any, ANY_WIDTH, ANY_HEIGHT, TEXELS_NARROW)
ROWS(narrow_64, 6, 6, TEXELS_NARROW)
ROWS(narrow_128, 7, 7, TEXELS_NARROW)
ROWS(narrow_256, 8, 8, TEXELS_NARROW)
ROWS(lit_narrow, ANY_WIDTH, ANY_HEIGHT, TEXELS_LIT_NARROW)
#endif

#define CHOOSE(KIND, T) ((T)->width != (T)->height ? KIND##_any : (T)->width == 64 ? KIND##_64 \
                         : (T)->width == 128 ? KIND##_128 : (T)->width == 256 ? KIND##_256 : KIND##_any)

smear_rows_fn *smear_rows_choose(const struct setup *s)
{
    const struct smear_sampler *t = &s->draw->sampler;
    const bool narrow = target_is_direct(s->target), is_curved = s->texture.mode == TEXTURE_CURVED;
    if (s->segment->uv == 0)
        return draw_is_opaque(s->draw) && !s->flat && segment_gouraud(s->segment) ? smear_rows_shade : NULL;
    if (s->draw->alpha != SMEAR_OPAQUE || !t->turns || t->log2_width == 0
        || t->log2_height == 0)
        return NULL;
    if (s->segment->shade != SHADE_NONE || t->format != (narrow ? SMEAR_TEXEL_565 : SMEAR_TEXEL_8888)) {
        if (frame_is_linear(s->frame) || (segment_gouraud(s->segment) && !s->even_color))
            return NULL;
#if SMEAR_DIRECT
        if (narrow)
            return is_curved ? curves_lit_narrow : rows_lit_narrow;
#endif
        return is_curved ? curves_lit : rows_lit;
    }
#if SMEAR_DIRECT
    if (narrow)
        return is_curved ? CHOOSE(curves_narrow, t) : CHOOSE(rows_narrow, t);
#endif
#if WIDE_SIZES
    return is_curved ? CHOOSE(curves_wide, t) : CHOOSE(rows_wide, t);
#else
    return is_curved ? curves_wide_any : rows_wide_any;
#endif
}
#endif
