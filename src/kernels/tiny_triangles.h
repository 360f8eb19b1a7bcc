/* SPDX-License-Identifier: MIT */
/* tiny_triangles.h - draws those triangles of a list that are tiny, one after the other. */
#ifndef SMEAR_KERNELS_TINY_TRIANGLES_H
#define SMEAR_KERNELS_TINY_TRIANGLES_H

#include "kernels/points_list.h"
#include "kernels/tiny_corners.h"
#include "kernels/tiny_triangles_armv7em.h"

/* Elsewhere compilers inline what makes one triangle after the other ready. */
#define TINY_TRIANGLES SMEAR_ASM_ARMV7EM

/* A triangle of a list, entry i lies i entries before `top`. */
struct triangle_entry {
    uint16_t vertex[3], segment; /* words from the segment's first vertex; clockwise on the screen */
    uint32_t next;               /* or UINT32_MAX */
    uint32_t color;              /* 0x??RRGGBB, where it is not shaded */
};

/* Tiny triangles have boxes of up to TINY_SIDE columns and rows, and TINY_AREA pixels. */
enum { TINY_SIDE = 8,
       TINY_AREA = 32 };

/* What is drawn, and where. Vertices begin with x and y, q8 px, less than 2^14 px from 0, and depth units from 0 on; then two words
 * of colour where they are shaded: red and green, blue. */
struct tiny_triangles {
#if SMEAR_ASM_ARMV7EM
    uint32_t row[8], right[2], number, next, to_pixel, one_color, weights[2], twice[2], units[2], channel[9], nearest[4];
    uint32_t numbered;    /* the segment, in the upper half */
    const int32_t *first; /* its first vertex */
    const void *top;
    uint32_t kind, low, end, stride, origin;
    const uint16_t *seed;
#endif
    struct points_plane plane;
    const int32_t *vertex; /* the segment's first */
    uint32_t segment;
    bool even;           /* only where depths are nearly even (tiny_is_even) */
    bool shaded, narrow; /* shaded: by codes */
};

static inline bool tiny_triangle_reference(const struct tiny_triangles *t, const int32_t *const v[3], uint32_t color)
{
    const struct points_plane *const p = &t->plane;
    struct tiny_box b = { .stride = p->stride, .shaded = t->shaded, .narrow = t->narrow };
    struct tiny_span s;
    tiny_span_reference(&s, v[0], v[1], v[2]);
    b.columns = s.right - s.left;
    b.rows = s.bottom - s.top;
    if (b.columns > TINY_SIDE || b.rows > TINY_SIDE || b.columns * b.rows > TINY_AREA)
        return false;
    if (!tiny_codes(&b, v[0][2], s.low, s.high) || (t->even && !tiny_is_even(v[0][2], v[1][2], v[2][2])))
        return false;
    const int32_t left = max_i32(s.left, (int32_t)p->x0), top = max_i32(s.top, (int32_t)p->y0);
    b.columns = min_i32(s.right, (int32_t)(p->x0 + p->width)) - left;
    b.rows = min_i32(s.bottom, (int32_t)(p->y0 + p->height)) - top;
    if (b.columns <= 0 || b.rows <= 0)
        return true;
    tiny_corners_reference(&b, v[0], v[1], v[2], left, top);
    if (b.shaded)
        tiny_colors_reference(&b, (const uint32_t *)v[0] + 3, (const uint32_t *)v[1] + 3, (const uint32_t *)v[2] + 3, 1u << 21);
    else
        b.color = b.narrow ? rgb565_nearest(color) : color & 0xffffffu;
    const int32_t at = (top - (int32_t)p->y0) * p->stride + left - (int32_t)p->x0;
    b.depth = p->depth + at;
    b.pixels = pixel_after(p->pixels, at, b.narrow);
    tiny_box_reference(&b);
    return true;
}

/* Draws triangles from entry `head` on. Returns the first entry that is of another segment, or no tiny triangle, or whose depth codes
 * have their break in it; or UINT32_MAX. */
static inline uint32_t tiny_triangles_reference(struct tiny_triangles *t, uint32_t head)
{
    while (head != UINT32_MAX) {
        struct triangle_entry e;
        __builtin_memcpy(&e, (const uint8_t *)t->plane.top - (size_t)head * sizeof e, sizeof e);
        const int32_t *const v[3] = { t->vertex + e.vertex[0], t->vertex + e.vertex[1], t->vertex + e.vertex[2] };
        if (e.segment != t->segment || !tiny_triangle_reference(t, v, e.color))
            break;
        head = e.next;
    }
    return head;
}

#if SMEAR_ASM_ARMV7EM
SMEAR_STATIC_ASSERT(offsetof(struct tiny_triangles, row) == 0 && offsetof(struct tiny_triangles, right) == 32
                        && offsetof(struct tiny_triangles, number) == 40 && offsetof(struct tiny_triangles, next) == 44
                        && offsetof(struct tiny_triangles, to_pixel) == 48 && offsetof(struct tiny_triangles, one_color) == 52
                        && offsetof(struct tiny_triangles, weights) == 56 && offsetof(struct tiny_triangles, twice) == 64
                        && offsetof(struct tiny_triangles, units) == 72 && offsetof(struct tiny_triangles, channel) == 80
                        && offsetof(struct tiny_triangles, nearest) == 116,
                    "the assembly knows what it leaves in struct tiny_triangles");
SMEAR_STATIC_ASSERT(offsetof(struct tiny_triangles, numbered) == 132 && offsetof(struct tiny_triangles, first) == 136
                        && offsetof(struct tiny_triangles, top) == 140 && offsetof(struct tiny_triangles, kind) == 144
                        && offsetof(struct tiny_triangles, low) == 148 && offsetof(struct tiny_triangles, end) == 152
                        && offsetof(struct tiny_triangles, stride) == 156 && offsetof(struct tiny_triangles, origin) == 160
                        && offsetof(struct tiny_triangles, seed) == 164 && sizeof(struct triangle_entry) == 16,
                    "the assembly knows what it finds in struct tiny_triangles");

/* Bits of `kind`, of which the first two choose a loop. */
enum { TINY_KIND_WIDE = 1, TINY_KIND_SHADED = 2, TINY_KIND_EVEN = 4 };

static inline void tiny_triangles_begin_armv7em(struct tiny_triangles *t)
{
    const struct points_plane *const p = &t->plane;
    const uint32_t depth = (uint32_t)(uintptr_t)p->depth, pixels = (uint32_t)(uintptr_t)p->pixels;
    t->numbered = t->segment << 16;
    t->first = t->vertex;
    t->top = p->top;
    t->kind = (t->narrow ? 0u : TINY_KIND_WIDE) | (t->shaded ? TINY_KIND_SHADED : 0u) | (t->even ? TINY_KIND_EVEN : 0u);
    t->low = p->x0 | p->y0 << 16;
    t->end = (p->x0 + p->width) | (p->y0 + p->height) << 16;
    t->stride = 2u * (uint32_t)p->stride;
    t->origin = depth - p->y0 * t->stride - 2u * p->x0;
    t->to_pixel = pixels - depth * (t->narrow ? 1u : 2u);
    t->seed = smear_recip_seed;
    t->nearest[0] = 249u;
    t->nearest[1] = 0x03f603f6u;
    t->nearest[2] = 253u;
    t->nearest[3] = 505u;
}

/* Little more than half of the instructions that compilers take for triangles of two or three pixels. */
static SMEAR_NOINLINE uint32_t tiny_triangles_armv7em(struct tiny_triangles *t, uint32_t head)
{
    register struct tiny_triangles *r0 __asm__("r0") = t;
    register uint32_t r1 __asm__("r1") = head;
    if (head == UINT32_MAX)
        return head;
    __asm__ volatile(".syntax unified\n" TINY_TRIANGLES_ENTRY TINY_TRIANGLES_COLOR TINY_TRIANGLES_SPAN TINY_TRIANGLES_UNITS
                         TINY_TRIANGLES_CUT TINY_TRIANGLES_EDGES TINY_TRIANGLES_BIASES TINY_TRIANGLES_ROWS TINY_TRIANGLES_SCALE
                             TINY_TRIANGLES_CHOOSE
                     "21: " TINY_TRIANGLES_PIXELS(TINY_TRIANGLES_FLAT TINY_TRIANGLES_NARROW)
                         TINY_TRIANGLES_NEXT TINY_TRIANGLES_FAR
                     "22: " TINY_TRIANGLES_PIXELS(TINY_TRIANGLES_FLAT TINY_TRIANGLES_WIDE)
                     "23: " TINY_TRIANGLES_PIXELS(TINY_TRIANGLES_SHADE_NARROW TINY_TRIANGLES_NARROW)
                     "24: " TINY_TRIANGLES_PIXELS(TINY_TRIANGLES_SHADE_WIDE TINY_TRIANGLES_WIDE)
                         TINY_TRIANGLES_NEXT
                     "7: ldr r1, [r0, #40]\n"
                     "9:"
                     : "+r"(r0), "+r"(r1)
                     :
                     : "r2", "r3", "r4", "r5", "r6", "r7", "r8", "r9", "r10", "r11", "r12", "lr", "cc", "memory");
    return r1;
}
#endif

/* Makes ready what does not change. */
static inline void tiny_triangles_begin(struct tiny_triangles *t)
{
#if SMEAR_ASM_ARMV7EM
    tiny_triangles_begin_armv7em(t);
#else
    (void)t;
#endif
}

static inline uint32_t tiny_triangles(struct tiny_triangles *t, uint32_t head)
{
#if SMEAR_ASM_ARMV7EM
    return tiny_triangles_armv7em(t, head);
#else
    return tiny_triangles_reference(t, head);
#endif
}

#endif
