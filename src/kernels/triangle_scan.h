/* SPDX-License-Identifier: MIT */
/* triangle_scan.h - goes over a mesh's triangles, whose vertices lie in a cache, to the next one that may be seen. */
#ifndef SMEAR_KERNELS_TRIANGLE_SCAN_H
#define SMEAR_KERNELS_TRIANGLE_SCAN_H

#include "kernels/front_cover_armv6m.h"
#include "kernels/tiny_corners.h"
#include "kernels/tiny_points.h"
#include "kernels/vertices.h"

/* Scans mix the colours of points, too, where triangles have none. */
#define SCAN_MIXES TINY_COVER_ARMV7EM

/* A vertex of the cache. */
struct scan_vertex {
    uint32_t tag;                   /* a draw's number << 16 | vertex index; 0: none */
    uint32_t stored;                /* the caller's, 0 where the vertex is new */
    struct smear_screen screen;
    int32_t outcode;                /* 0: within the frame */
    struct smear_homogeneous now;
};

/* Bits of outcodes: a triangle whose vertices share one is not seen. */
enum { SCAN_REJECT = 63 };

/* Where a scan stopped. */
enum scan_end {
    SCAN_DONE,              /* at the end */
    SCAN_FRONT,             /* after a triangle v[0], v[2], v[1] that is clockwise on the screen, within the frame */
    SCAN_ANY,               /* after another one that may be seen */
    SCAN_OUTSIDE,           /* before a triangle: v[0] has been found and lies beside the frame; the caller gives it an outcode */
    SCAN_UNREADY,           /* before a triangle: the setup is not ready for v[0], whose tag is `missing` */
    SCAN_SLOW               /* before a triangle whose vertices have one place in the cache, or an index too many */
};

struct triangle_scan {
    int32_t second, third;          /* bytes from a triangle's first index to those that follow it clockwise */
    uint32_t tag, mask;             /* vertex i is entry (tag | i) & mask of the cache */
    struct scan_vertex *cache;
    const struct vertex_setup *setup;
    const int16_t *position;        /* of vertices, three each */
    uint32_t vertex_count;          /* 0: all that the cache lacks is SCAN_SLOW */
    uint32_t width, height;         /* of the frame, q8 px; positive as int32_t */
    const uint16_t *index, *end;    /* three each; the scan moves `index` */
    int32_t behind;                 /* INT32_MIN: triangles that face away are SCAN_ANY, too. Else 0 */
    struct scan_vertex *v[3];       /* of a triangle: its first, third and second */
    uint32_t missing;
#if FRONT_COVERS
    struct front_cover *front;      /* of SCAN_FRONT, of which those that cover nothing pass; null: unknown */
    int32_t covered;                /* and how many pixels of it are covered */
    const struct points_rings *rings;   /* where those of up to SCAN_POINTS pixels go while there is room; null: nowhere */
    const uint8_t *color;           /* of triangles then: red, green, blue and alpha of each; or null */
    const uint16_t *first;          /* their indices begin here */
    int32_t room;                   /* triangles; goes down by those that became points */
#endif
#if SCAN_MIXES
    const uint8_t *vertex_color;    /* of vertices, where `color` is null: points mix them */
    bool even;                      /* but only where depths are nearly even (tiny_is_even) */
#endif
#if !SMEAR_HAS_MUL64
    uint32_t side;                  /* a power of two: where x differs by less, areas have 32 bits (scan_side) */
#endif
};

enum { SCAN_POINTS = 2 };

#if !SMEAR_HAS_MUL64
/* Twice an area is at most a triangle's width, less than two such sides, times the frame's height, q8 px. */
static inline uint32_t scan_side(uint32_t height)
{
    uint32_t side = 1u << 15;
    while (height != 0 && side > (1u << 30) / height)
        side >>= 1;
    return side;
}
#endif

/* Finds a vertex that the cache lacks. */
static inline enum scan_end scan_find(struct triangle_scan *s, struct scan_vertex *v, uint32_t tag)
{
    const uint32_t i = tag & 0xffffu;
    if (i >= s->vertex_count)
        return SCAN_SLOW;
    s->v[0] = v;
    s->missing = tag;
    v->tag = 0;
    if (!vertex_find_reference(&v->screen, &v->now, s->position + 3 * i, s->setup))
        return SCAN_UNREADY;
    v->tag = tag;
    v->stored = 0;
    v->outcode = 0;
    return (uint32_t)v->screen.x > s->width || (uint32_t)v->screen.y > s->height ? SCAN_OUTSIDE : SCAN_DONE;
}

#if SCAN_MIXES
/* Points from `first` on, whose weights are known, take their colour from vertices. */
static inline void scan_mix_reference(const struct triangle_scan *s, uint32_t first)
{
    const struct tiny_cover *const t = &s->front->tiny;
    const uint8_t *c[3];
    for (int i = 0; i < 3; i++)
        c[i] = s->vertex_color + 4 * (s->v[(3 - i) % 3]->tag & 0xffffu);
    for (int32_t k = 0; k < t->count; k++) {
        uint32_t code[3];
        for (int i = 0; i < 3; i++) {
            struct tiny_channel channel;
            tiny_channel_make(&channel, c[0][i] * 256u, c[1][i] * 256u, c[2][i] * 256u, 1u << 21);
            code[i] = tiny_channel_at(&channel, (uint32_t)t->covered[k].e1, (uint32_t)t->covered[k].e2, false);
        }
        points_entry(s->rings, first + (uint32_t)k)->color = pixel_make(0, code[0], code[1], code[2]);
    }
}
#endif

#if FRONT_COVERS
/* Takes a triangle that covers so many pixels. Returns whether it became points. */
static inline bool scan_points(struct triangle_scan *s, int32_t covered)
{
    const int32_t *const depth[3] = { &s->v[0]->screen.depth, &s->v[2]->screen.depth, &s->v[1]->screen.depth };
    bool points = covered <= SCAN_POINTS && s->rings != NULL && s->room != 0;
#if SCAN_MIXES
    points = points && (s->color != NULL || !s->even || tiny_is_even(*depth[0], *depth[1], *depth[2]));
#endif
    if (!points) {
        s->covered = covered;
        return false;
    }
    s->room--;
    uint32_t color = 0;
    if (s->color != NULL) {
        const uint8_t *const c = s->color + (s->index - s->first) / 3 * 4;
        color = pixel_make(c[3], c[0], c[1], c[2]);
    }
#if SCAN_MIXES
    const uint32_t first = *s->rings->count;
#endif
    tiny_points_reference(s->rings, &s->front->tiny, depth[0], depth[1], depth[2], color);
#if SCAN_MIXES
    if (s->color == NULL)
        scan_mix_reference(s, first);
#endif
    return true;
}
#endif

/* Takes one triangle, with vertices that are there. SCAN_DONE: it is not seen. */
static inline enum scan_end scan_one(struct triangle_scan *s)
{
    const struct scan_vertex *v0 = s->v[0], *v1 = s->v[2], *v2 = s->v[1];
    if ((v0->outcode | v1->outcode | v2->outcode) != 0)
        return (v0->outcode & v1->outcode & v2->outcode & SCAN_REJECT) != 0 ? SCAN_DONE : SCAN_ANY;
    const int32_t x1 = v1->screen.x - v0->screen.x, y1 = v1->screen.y - v0->screen.y;
    const int32_t x2 = v2->screen.x - v0->screen.x, y2 = v2->screen.y - v0->screen.y;
#if SMEAR_HAS_MUL64
    const int64_t product = (int64_t)x1 * y2 - (int64_t)x2 * y1;
    const int32_t area = product > 0 ? 1 : product < 0 ? -1 : 0;
#else
    if ((((uint32_t)x1 + s->side) | ((uint32_t)x2 + s->side)) >= 2 * s->side)
        return SCAN_ANY;            /* products need more than 32 bits */
    const int32_t area = x1 * y2 - x2 * y1;
#endif
#if FRONT_COVERS
    if (area > 0 && s->front != NULL) {
        const int32_t covered = front_cover_reference(s->front, &v0->screen.x, &v1->screen.x, &v2->screen.x);
        return covered == 0 || scan_points(s, covered) ? SCAN_DONE : SCAN_FRONT;
    }
#endif
    return area > 0 ? SCAN_FRONT : (area & s->behind) != 0 ? SCAN_ANY : SCAN_DONE;
}

/* Goes on to the next triangle that the caller has to do something about. */
static inline enum scan_end triangle_scan_reference(struct triangle_scan *s)
{
    for (; s->index != s->end; s->index += 3) {
        const uint32_t tag[3] = { s->tag | s->index[0], s->tag | s->index[s->second / 2], s->tag | s->index[s->third / 2] };
        struct scan_vertex *v[3];
        for (int i = 0; i < 3; i++)
            v[i] = s->cache + (tag[i] & s->mask);
        for (int i = 0; i < 3; i++) {
            if (v[i]->tag == tag[i])
                continue;
            const bool in_use = (i > 0 && v[i] == v[0]) || (i > 1 && v[i] == v[1]);
            const enum scan_end found = in_use ? SCAN_SLOW : scan_find(s, v[i], tag[i]);
            if (found != SCAN_DONE)
                return found;
        }
        s->v[0] = v[0];
        s->v[1] = v[2];
        s->v[2] = v[1];
        const enum scan_end end = scan_one(s);
        if (end != SCAN_DONE) {
            s->index += 3;
            return end;
        }
    }
    return SCAN_DONE;
}

#if TINY_COVER_KEEPS
SMEAR_STATIC_ASSERT(sizeof(struct scan_vertex) == 40 && offsetof(struct scan_vertex, screen) == 8
                        && offsetof(struct scan_vertex, outcode) == 20 && offsetof(struct scan_vertex, now) == 24
                        && offsetof(struct triangle_scan, cache) == 16 && offsetof(struct triangle_scan, setup) == 20
                        && offsetof(struct triangle_scan, position) == 24 && offsetof(struct triangle_scan, vertex_count) == 28
                        && offsetof(struct triangle_scan, width) == 32 && offsetof(struct triangle_scan, index) == 40
                        && offsetof(struct triangle_scan, end) == 44 && offsetof(struct triangle_scan, behind) == 48
                        && offsetof(struct triangle_scan, v) == 52 && offsetof(struct triangle_scan, missing) == 64,
                    "the assembly knows struct triangle_scan");
SMEAR_STATIC_ASSERT(offsetof(struct triangle_scan, front) == 68 && offsetof(struct triangle_scan, covered) == 72
                        && offsetof(struct triangle_scan, rings) == 76 && offsetof(struct triangle_scan, color) == 80
                        && offsetof(struct triangle_scan, first) == 84 && offsetof(struct triangle_scan, room) == 88,
                    "the assembly knows struct triangle_scan");
#endif

#if TINY_COVER_ARMV6M
SMEAR_STATIC_ASSERT(offsetof(struct triangle_scan, side) == 92, "the assembly knows struct triangle_scan");

/* What does not change: the end into r8, `side` into r9 and twice that into lr, from the scan in r0. */
#define TRIANGLE_SCAN_LOAD  \
    "ldr r1, [r0, #44]\n\t" \
    "mov r8, r1\n\t"        \
    "ldr r1, [r0, #92]\n\t" \
    "mov r9, r1\n\t"        \
    "adds r1, r1, r1\n\t"   \
    "mov lr, r1\n\t"

/* Tags of the triangle whose first index r0 points to into r1, r2 and r3, its entries into r4, r7 and r5. */
#define TRIANGLE_SCAN_ENTRIES \
    "ldrh r1, [r0]\n\t"       \
    "mov r7, r11\n\t"         \
    "ldm r7!, {r3, r4}\n\t"   \
    "ldrh r2, [r0, r3]\n\t"   \
    "ldrh r3, [r0, r4]\n\t"   \
    "ldm r7!, {r4, r5, r6}\n\t" \
    "orrs r1, r4\n\t"         \
    "orrs r2, r4\n\t"         \
    "orrs r3, r4\n\t"         \
    "movs r0, #40\n\t"        \
    "movs r4, r1\n\t"         \
    "ands r4, r5\n\t"         \
    "muls r4, r0\n\t"         \
    "adds r4, r4, r6\n\t"     \
    "movs r7, r2\n\t"         \
    "ands r7, r5\n\t"         \
    "muls r7, r0\n\t"         \
    "adds r7, r7, r6\n\t"     \
    "ands r5, r3\n\t"         \
    "muls r5, r0\n\t"         \
    "adds r5, r5, r6\n\t"

/* Twice the area of a triangle within the frame into r1; on to 24 where it needs more than 32 bits. */
#define TRIANGLE_SCAN_AREA  \
    "ldr r0, [r4, #8]\n\t"  \
    "ldr r1, [r7, #8]\n\t"  \
    "ldr r2, [r5, #8]\n\t"  \
    "subs r1, r1, r0\n\t"   \
    "subs r2, r2, r0\n\t"   \
    "mov r3, r9\n\t"        \
    "adds r0, r1, r3\n\t"   \
    "adds r3, r3, r2\n\t"   \
    "orrs r0, r3\n\t"       \
    "cmp r0, lr\n\t"        \
    "bhs 24f\n\t"           \
    "ldr r0, [r4, #12]\n\t" \
    "ldr r3, [r7, #12]\n\t" \
    "ldr r6, [r5, #12]\n\t" \
    "subs r3, r3, r0\n\t"   \
    "subs r6, r6, r0\n\t"   \
    "muls r1, r6\n\t"       \
    "muls r2, r3\n\t"       \
    "subs r1, r1, r2\n\t"

/* The vertex of the tag in r0, for the entry in r6, into the cache; then on to 30, as entries for v[0] are found first. All low
 * registers are kept. */
#define TRIANGLE_SCAN_FIND                                     \
    "16: push {r0, r1, r2, r3, r4, r5, r6, r7}\n\t"            \
    "mov r12, r0\n\t"                                          \
    "mov r1, r11\n\t"                                          \
    "ldr r2, [r1, #28]\n\t"                                    \
    "uxth r0, r0\n\t"                                          \
    "cmp r0, r2\n\t"                                           \
    "bhs 26b\n\t"                                              \
    "ldr r2, [r1, #24]\n\t"                                    \
    "lsls r3, r0, #1\n\t"                                      \
    "adds r0, r0, r3\n\t"                                      \
    "lsls r0, r0, #1\n\t"                                      \
    "adds r0, r0, r2\n\t"                                      \
    "ldr r1, [r1, #20]\n\t" ARMV6M_VERTEX_ROWS                 \
    "ldr r3, [sp, #24]\n\t"                                    \
    "adds r3, #24\n\t" ARMV6M_VERTEX_NOW ARMV6M_VERTEX_FIND    \
    "ldr r7, [sp, #24]\n\t"                                    \
    "mov r2, r12\n\t"                                          \
    "movs r3, #0\n\t"                                          \
    "stm r7!, {r2, r3, r4, r5, r6}\n\t"                        \
    "str r3, [r7]\n\t"                                         \
    "mov r0, r11\n\t"                                          \
    "ldr r1, [r0, #32]\n\t"                                    \
    "cmp r4, r1\n\t"                                           \
    "bhi 27f\n\t"                                              \
    "ldr r1, [r0, #36]\n\t"                                    \
    "cmp r5, r1\n\t"                                           \
    "bhi 27f\n\t"                                              \
    "ldr r1, [r0, #44]\n\t"                                    \
    "mov r8, r1\n\t"                                           \
    "pop {r0, r1, r2, r3, r4, r5, r6, r7}\n\t"                 \
    "b 30b\n" ARMV6M_VERTEX_LIMIT

/* What becomes of triangles that are not wholly within the frame; 24: those that may be seen. */
#define TRIANGLE_SCAN_SEEN \
    "17: ands r0, r1\n\t" \
    "ands r0, r2\n\t" \
    "movs r1, #63\n\t" \
    "tst r0, r1\n\t" \
    "bne 18b\n" \
    "24: movs r0, #2\n\t" \
    "mov r1, r11\n\t" \
    "adds r1, #52\n\t" \
    "stm r1!, {r4, r5, r7}\n" \
    "22: mov r1, r10\n\t" \
    "adds r1, #6\n\t" \
    "mov r10, r1\n\t" \
    "b 29f\n" \
    "25: movs r0, #5\n\t" \
    "b 29f\n"

/* What becomes of those that face the viewer, of the area in r1. */
#define TRIANGLE_SCAN_FRONT                                            \
    "20: movs r0, #1\n\t"                                              \
    "b 22b\n"                                                          \
    "35: b 31f\n"                                                      \
    "36: movs r6, #5\n\t"                                              \
    "b 32f\n"                                                          \
    "21: mov r0, r11\n\t"                                              \
    "adds r0, #52\n\t"                                                 \
    "stm r0!, {r4, r5, r7}\n\t"                                        \
    "ldr r6, [r0, #4]\n\t"                                             \
    "cmp r6, #0\n\t"                                                   \
    "beq 20b\n\t"                                                      \
    "str r1, [r6]\n\t"                                                 \
    "mov lr, r6\n\t"                                                   \
    "mov r8, r1\n\t" ARMV6M_FRONT_BOX("35b", "36b") ARMV6M_FRONT_EDGES \
    ARMV6M_FRONT_BIASES ARMV6M_FRONT_START ARMV6M_FRONT_PIXELS          \
    "bne 34f\n\t"                                                      \
    "add sp, #16\n\t"                                                  \
    "b 31f\n"                                                          \
    "34: str r6, [r0, #4]\n\t"                                         \
    "cmp r6, #2\n\t"                                                   \
    "bls 37f\n"                                                        \
    "33: pop {r0, r1, r2, r3}\n"                                       \
    "32: " ARMV6M_FRONT_KEEP                                            \
    "mov r1, r11\n\t"                                                  \
    "str r6, [r1, #72]\n\t"                                            \
    "b 20b\n"

/* Its pixels become points, by the rings while there is room. A triangle's colour lies two thirds as far from the first as its indices
 * do. Then it goes on from 31. */
#define TRIANGLE_SCAN_POINTS         \
    "37: mov r2, r11\n\t"               \
    "ldr r1, [r2, #76]\n\t"         \
    "cmp r1, #0\n\t"                \
    "beq 33b\n\t"                   \
    "ldr r4, [r2, #88]\n\t"         \
    "subs r4, #1\n\t"               \
    "bmi 33b\n\t"                   \
    "str r4, [r2, #88]\n\t"         \
    "add sp, #16\n\t"               \
    "mov r3, r10\n\t"               \
    "push {r2, r3}\n\t"             \
    "ldr r4, [r2, #84]\n\t"         \
    "subs r3, r3, r4\n\t"           \
    "ldr r4, 9f\n\t"                \
    "muls r3, r4\n\t"               \
    "lsls r3, r3, #1\n\t"           \
    "ldr r4, [r2, #80]\n\t"         \
    "adds r4, r4, r3\n\t"           \
    "ldrb r5, [r4, #3]\n\t"         \
    "lsls r5, r5, #8\n\t"           \
    "ldrb r3, [r4]\n\t"             \
    "orrs r5, r3\n\t"               \
    "lsls r5, r5, #8\n\t"           \
    "ldrb r3, [r4, #1]\n\t"         \
    "orrs r5, r3\n\t"               \
    "lsls r5, r5, #8\n\t"           \
    "ldrb r3, [r4, #2]\n\t"         \
    "orrs r5, r3\n\t"               \
    "adds r2, #52\n\t"              \
    "ldm r2, {r2, r4, r6}\n\t"      \
    "ldr r2, [r2, #16]\n\t"         \
    "ldr r3, [r6, #16]\n\t"         \
    "ldr r4, [r4, #16]\n\t"         \
    "movs r6, r0\n\t"               \
    "movs r0, r1\n\t"               \
    "movs r1, r6\n\t" TINY_POINTS_ARMV6M("") \
    "pop {r0, r2}\n\t"              \
    "mov r11, r0\n\t"               \
    "mov r10, r2\n"                 \
    "31: mov r0, r11\n\t" TRIANGLE_SCAN_LOAD \
    "b 18b\n\t"                     \
    ".balign 4\n"                   \
    "9: .word 0xaaaaaaab\n"

/* Other reasons to stop. From 29 on it ends. */
#define TRIANGLE_SCAN_STOP \
    "26: add sp, #32\n\t" \
    "b 25b\n" TRIANGLE_SCAN_FIND \
    "1: ldr r3, [sp, #24]\n\t" \
    "movs r0, #0\n\t" \
    "str r0, [r3]\n\t" \
    "movs r0, #4\n\t" \
    "b 28f\n" \
    "27: movs r0, #3\n" \
    "28: mov r1, r11\n\t" \
    "mov r2, r12\n\t" \
    "ldr r3, [sp, #24]\n\t" \
    "str r2, [r1, #64]\n\t" \
    "str r3, [r1, #52]\n\t" \
    "add sp, #32\n" \
    "29: mov r1, r11\n\t" \
    "mov r2, r10\n\t" \
    "str r2, [r1, #40]"

/* Tells which vertex is missing, unless its entry is in use. */
#define TRIANGLE_SCAN_MISSING \
    "13: movs r0, r1\n\t" \
    "movs r6, r4\n\t" \
    "b 16f\n" \
    "14: cmp r7, r4\n\t" \
    "beq 25f\n\t" \
    "movs r0, r2\n\t" \
    "movs r6, r7\n\t" \
    "b 16f\n" \
    "15: cmp r5, r4\n\t" \
    "beq 25f\n\t" \
    "cmp r5, r7\n\t" \
    "beq 25f\n\t" \
    "movs r0, r3\n\t" \
    "movs r6, r5\n\t" \
    "b 16f\n"

/* The next index in r10, the scan in r11, what TRIANGLE_SCAN_LOAD loads in r8, r9 and lr. Two thirds of the instructions that
 * compilers take for a triangle that faces away. */
static inline enum scan_end triangle_scan_armv6m(struct triangle_scan *s)
{
    register struct triangle_scan *r0 __asm__("r0") = s;
    __asm__ volatile(".syntax unified\n\t"
                     "mov r11, r0\n\t" TRIANGLE_SCAN_LOAD
                     "ldr r0, [r0, #40]\n\t"
                     "b 19f\n"
                     "11: " TRIANGLE_SCAN_ENTRIES
                     "ldr r6, [r4]\n\t"
                     "cmp r6, r1\n\t"
                     "bne 13f\n"
                     "30: ldr r6, [r7]\n\t"
                     "cmp r6, r2\n\t"
                     "bne 14f\n\t"
                     "ldr r6, [r5]\n\t"
                     "cmp r6, r3\n\t"
                     "bne 15f\n\t"
                     "ldr r0, [r4, #20]\n\t"
                     "ldr r1, [r7, #20]\n\t"
                     "ldr r2, [r5, #20]\n\t"
                     "movs r3, r0\n\t"
                     "orrs r3, r1\n\t"
                     "orrs r3, r2\n\t"
                     "bne 17f\n\t" TRIANGLE_SCAN_AREA
                     "bgt 21f\n\t"
                     "mov r0, r11\n\t"
                     "ldr r0, [r0, #48]\n\t"
                     "tst r0, r1\n\t"
                     "bne 24f\n"
                     "18: mov r0, r10\n\t"
                     "adds r0, #6\n"
                     "19: mov r10, r0\n\t"
                     "cmp r0, r8\n\t"
                     "bne 11b\n\t"
                     "movs r0, #0\n\t"
                     "b 29f\n" TRIANGLE_SCAN_MISSING TRIANGLE_SCAN_SEEN TRIANGLE_SCAN_FRONT
                         TRIANGLE_SCAN_POINTS TRIANGLE_SCAN_STOP
                     : "+r"(r0)
                     :
                     : "r1", "r2", "r3", "r4", "r5", "r6", "r7", "r8", "r9", "r10", "r11", "r12", "lr", "cc", "memory");
    return (enum scan_end)(uintptr_t)r0;
}
#endif

#if TINY_COVER_ARMV7EM
#include "kernels/triangle_scan_armv7em.h"
#endif

static inline enum scan_end triangle_scan(struct triangle_scan *s)
{
#if TINY_COVER_ARMV6M
    return triangle_scan_armv6m(s);
#elif TINY_COVER_ARMV7EM
    return triangle_scan_armv7em(s);
#else
    return triangle_scan_reference(s);
#endif
}

#endif
