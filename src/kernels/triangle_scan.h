/* SPDX-License-Identifier: MIT */
/* triangle_scan.h - goes over a mesh's triangles, whose vertices lie in a cache, to the next one that may be seen. */
#ifndef SMEAR_KERNELS_TRIANGLE_SCAN_H
#define SMEAR_KERNELS_TRIANGLE_SCAN_H

#include "kernels/tiny_corners.h"
#include "kernels/triangle_scan_armv7em.h"

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

#if FRONT_COVERS
/* Where triangles go that do not become points, with their vertices: a vertex has three words, and two of colour if there are `colors`. */
struct scan_records {
    const struct points_rings *rings;
    uint32_t *pool, *words;         /* of vertices; how many words of it are in use */
    uint32_t first;                 /* vertices whose `stored` is less are new */
    uint32_t segment;               /* in the upper half */
    const uint8_t *colors;          /* red, green, blue and alpha of each vertex; or null */
};
#endif

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
    const uint8_t *color;           /* of triangles: red, green, blue and alpha of each; or null */
    const uint16_t *first;          /* their indices begin here */
    int32_t room;                   /* triangles; goes down by those that became points or were stored */
#endif
#if SCAN_MIXES
    const uint8_t *vertex_color;    /* of vertices, where `color` is null: points mix them */
    bool even;                      /* but only where depths are nearly even (tiny_is_even) */
#endif
#if FRONT_COVERS
    const struct scan_records *records;
    int32_t least;                  /* triangles that cover so many pixels or more are stored while there is room */
#endif
};

enum { SCAN_POINTS = 2 };

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
/* The colour of a triangle that faces the viewer, if there are colours. */
static inline uint32_t scan_color(const struct triangle_scan *s)
{
    const uint8_t *const c = s->color + (s->index - s->first) / 3 * 4;
    return pixel_make(c[3], c[0], c[1], c[2]);
}

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
    const uint32_t color = s->color != NULL ? scan_color(s) : 0;
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

/* Returns where in the segment a vertex lies, which it stores if it is new. */
static inline uint32_t scan_stored(const struct scan_records *r, struct scan_vertex *v)
{
    if (v->stored < r->first) {
        uint32_t *record = r->pool + *r->words;
        v->stored = *r->words + 1;
        *record++ = (uint32_t)v->screen.x;
        *record++ = (uint32_t)v->screen.y;
        *record++ = (uint32_t)v->screen.depth;
        if (r->colors != NULL) {
            const uint8_t *const c = r->colors + 4 * (v->tag & 0xffffu);
            *record++ = (uint32_t)c[0] << 8 | (uint32_t)c[1] << 24;
            *record++ = (uint32_t)c[2] << 8 | c[3] * 257u << 16;
        }
        *r->words = (uint32_t)(record - r->pool);
    }
    return v->stored - r->first;
}

/* Takes a triangle that covers so many pixels. Returns whether it was stored, in the ring of its first row. */
static inline bool scan_store(struct triangle_scan *s, int32_t covered)
{
    const struct scan_records *const r = s->records;
    if (covered < s->least || s->room == 0)
        return false;
    s->room--;
    const uint32_t v0 = scan_stored(r, s->v[0]), v1 = scan_stored(r, s->v[2]), v2 = scan_stored(r, s->v[1]) | r->segment;
    const uint32_t color = s->color != NULL ? scan_color(s) : 0xffffffffu;
    points_link(r->rings, (int32_t)(s->front->low >> 16),
                (struct point_entry){ (uint16_t)v0, (uint16_t)v1, (uint16_t)v2, (uint16_t)(v2 >> 16), 0, color });
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
    const int64_t product = (int64_t)x1 * y2 - (int64_t)x2 * y1;
    const int32_t area = product > 0 ? 1 : product < 0 ? -1 : 0;
#if FRONT_COVERS
    if (area > 0 && s->front != NULL) {
        const int32_t covered = front_cover_reference(s->front, &v0->screen.x, &v1->screen.x, &v2->screen.x);
        return covered == 0 || scan_points(s, covered) || scan_store(s, covered) ? SCAN_DONE : SCAN_FRONT;
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

#if TINY_COVER_ARMV7EM
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

#if TINY_COVER_ARMV7EM
SMEAR_STATIC_ASSERT(offsetof(struct triangle_scan, vertex_color) == 92 && offsetof(struct triangle_scan, even) == 96
                        && offsetof(struct triangle_scan, records) == 100 && offsetof(struct triangle_scan, least) == 104
                        && offsetof(struct scan_records, colors) == 20 && offsetof(struct front_cover, low) == 72,
                    "the assembly knows struct triangle_scan");

/* The next index in r0, the scan in r1, the size of vertices in r12, the end in lr. Three fifths of the instructions that compilers
 * take for a triangle that faces away. */
static inline enum scan_end triangle_scan_armv7em(struct triangle_scan *s)
{
    register struct triangle_scan *r1 __asm__("r1") = s;
    register uint32_t r2 __asm__("r2");
    __asm__ volatile(".syntax unified\n\t"
                     "ldrd r0, lr, [r1, #40]\n\t"
                     "mov r12, #40\n\t"
                     "b 19f\n"
                     "11: " TRIANGLE_SCAN_ENTRIES
                     "12: " TRIANGLE_SCAN_TEST TRIANGLE_SCAN_AREA
                     "cmp r3, #0\n\t"
                     "blt 20f\n\t"
                     "orrs r2, r2, r3\n\t"
                     "bne 21f\n\t"
                     "b 18f\n"
                     "20: ldr r2, [r1, #48]\n\t"
                     "cmp r2, #0\n\t"
                     "bne 24f\n"
                     "18: adds r0, #6\n"
                     "19: cmp r0, lr\n\t"
                     "bne 11b\n\t"
                     "movs r2, #0\n\t"
                     "b 29f\n" TRIANGLE_SCAN_FRONT TRIANGLE_SCAN_POINTS TRIANGLE_SCAN_EVEN TRIANGLE_SCAN_CODES TRIANGLE_SCAN_MIX
                         TRIANGLE_SCAN_STORE TRIANGLE_SCAN_ENTRY TRIANGLE_SCAN_RECORD TRIANGLE_SCAN_MISSING TRIANGLE_SCAN_FIND
                             TRIANGLE_SCAN_SEEN TRIANGLE_SCAN_STOP
                     : "+r"(r1), "=r"(r2)
                     :
                     : "r0", "r3", "r4", "r5", "r6", "r7", "r8", "r9", "r10", "r11", "r12", "lr", "cc", "memory");
    return (enum scan_end)r2;
}
#endif

static inline enum scan_end triangle_scan(struct triangle_scan *s)
{
#if TINY_COVER_ARMV7EM
    return triangle_scan_armv7em(s);
#else
    return triangle_scan_reference(s);
#endif
}

#endif
