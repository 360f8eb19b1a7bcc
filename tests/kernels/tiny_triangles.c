/* SPDX-License-Identifier: MIT */
/* tiny_triangles.c - how check_kernels calls kernels/tiny_triangles.h. */
#include "kernels/tiny_triangles.h"

#include "tests/kernels/kernels.h"

enum { SEGMENT = 5,
       STRIDE = 9,
       LOOK = 0,
       REACHED = 1,
       PIXELS = 4,
       WORDS = 5 }; /* the last two: of each entry */

static void make_vertex(int32_t *v, int units)
{
    v[0] = kernel_between(-5 * 256, 13 * 256) >> kernel_between(0, 1);
    v[1] = kernel_between(-5 * 256, 11 * 256) >> kernel_between(0, 1);
    if (units == 0)
        v[2] = kernel_between(0, (1 << 26) - 1);
    else if (units == 1)
        v[2] = kernel_between((1 << 26) + 2, (1 << 26) + (1 << 21));
    else
        v[2] = kernel_between((1 << 26) - 8, (1 << 26) + 8) << kernel_between(0, 3);
}

/* Each entry is followed by that below it; a few are of another segment, as those without area are. */
static void prepare(struct kernel_call *c)
{
    struct triangle_entry *entry = c->plane[2];
    int32_t *const vertex = c->plane[3];
    const int units = kernel_between(0, 3);
    for (int32_t i = 0; i < c->n; i++) {
        make_vertex(vertex + WORDS * i, units == 3 ? kernel_between(0, 2) : units);
        vertex[WORDS * i + 3] &= (int32_t)0xff00ff00;
        vertex[WORDS * i + 4] &= (int32_t)0xffffff00;
    }
    for (int32_t i = 0; i < c->n; i++) {
        struct triangle_entry *const e = &entry[c->n - 1 - i];
        int32_t at[3];
        for (int k = 0; k < 3; k++)
            at[k] = WORDS * kernel_between(0, c->n - 1);
        const int32_t *const v0 = vertex + at[0], *const v1 = vertex + at[1], *const v2 = vertex + at[2];
        const int32_t area = (v1[0] - v0[0]) * (v2[1] - v0[1]) - (v2[0] - v0[0]) * (v1[1] - v0[1]);
        e->vertex[0] = (uint16_t)at[0];
        e->vertex[1] = (uint16_t)at[area > 0 ? 1 : 2];
        e->vertex[2] = (uint16_t)at[area > 0 ? 2 : 1];
        e->segment = area == 0 || kernel_between(0, 19) == 0 ? SEGMENT + 1 : SEGMENT;
        e->next = i + 1 < c->n ? (uint32_t)i + 1 : UINT32_MAX;
    }
}

/* The entries draw into PIXELS times as many pixels as there are of them, in rows. */
static void call(struct kernel_call *c, bool narrow, bool shaded, bool best)
{
    if (c->n == 0)
        return;
    const uint32_t look = c->word[LOOK], n = PIXELS * (uint32_t)c->n;
    struct tiny_triangles t = { .plane = { (const struct point_entry *)c->plane[2] + (c->n - 1), look & 3u, min_u32(n, 7), look >> 2 & 3u,
                                           n < STRIDE ? 1 : n / STRIDE, STRIDE, c->plane[0], c->plane[1], 0, 0 },
                                .vertex = c->plane[3],
                                .segment = SEGMENT,
                                .even = (look & 16u) != 0,
                                .shaded = shaded,
                                .narrow = narrow };
    tiny_triangles_begin(&t);
    for (uint32_t head = 0, reached; head < (uint32_t)c->n; head = reached + 1) {
        reached = best ? tiny_triangles(&t, head) : tiny_triangles_reference(&t, head);
        c->word[REACHED] = c->word[REACHED] * 31u + reached;
        if (reached == UINT32_MAX)
            break;
    }
}

#define CALLS(NAME, NARROW, SHADED)                                                         \
    static void NAME##_reference(struct kernel_call *c) { call(c, NARROW, SHADED, false); } \
    static void NAME##_best(struct kernel_call *c) { call(c, NARROW, SHADED, true); }

CALLS(flat, false, false)
CALLS(flat_narrow, true, false)
CALLS(codes, false, true)
CALLS(codes_narrow, true, true)

#define KERNEL(NAME, CALL, BYTES)                                                                                                      \
    {                                                                                                                                  \
        .name = NAME, .most = 20, .size = { 8, BYTES, 16, 20 }, .align = { 2, BYTES / PIXELS, 4, 4 }, .prepare = prepare, .timed = 20, \
        .form = { { "reference", CALL##_reference },                                                                                   \
                  { "best", CALL##_best } }                                                                                            \
    }

extern const struct kernel kernels_tiny_triangles[];
const struct kernel kernels_tiny_triangles[] = { KERNEL("tiny_triangles (one colour)", flat, 16),
                                                 KERNEL("tiny_triangles (one colour, narrow)", flat_narrow, 8),
                                                 KERNEL("tiny_triangles (shaded)", codes, 16),
                                                 KERNEL("tiny_triangles (shaded, narrow)", codes_narrow, 8),
                                                 { .name = NULL } };
