/* SPDX-License-Identifier: MIT */
/* triangle_scan.c - how check_kernels calls kernels/triangle_scan.h: triangles of a small mesh, some of whose vertices lie in the
 * cache, scanned to the end. */
#include "kernels/triangle_scan.h"

#include "tests/kernels/kernels.h"

enum { VERTICES = 24, ENTRIES = 16, TAG = 7 << 16 };
enum { LOOK, CENTRE, STOPS };      /* words */
#if FRONT_COVERS
enum { RINGS = 4, ROOM = 7, BASE = 6 };

/* Where points go. */
struct points {
    struct point_entry entry[2 * ROOM];
    uint32_t last[RINGS], count;
    uint8_t color[4 * 40 + 3];
    struct points_rings rings;
#if FRONT_COVERS
    uint32_t pool[BASE + 3 * ROOM * 5], words;
    struct scan_records records;
#endif
};

static void points_make(struct points *p)
{
    *p = (struct points){ .count = 0 };
    for (int i = 0; i < RINGS; i++)
        p->last[i] = UINT32_MAX;
    for (int i = 0; i < 4 * 40 + 3; i++)
        p->color[i] = (uint8_t)(i * 73);
    p->rings = (struct points_rings){ p->entry + (2 * ROOM - 1), p->last, (1u << 22) / 40u, &p->count, smear_recip_seed };
#if FRONT_COVERS
    p->words = BASE;
    p->records = (struct scan_records){ &p->rings, p->pool, &p->words, BASE + 1, 5 << 16, NULL };
#endif
}

static uint32_t points_sum(const struct points *p, uint32_t sum)
{
    for (int i = 0; i < RINGS; i++)
        sum = sum * 31u + p->last[i];
    for (int i = 0; i < 2 * ROOM; i++) {
        const struct point_entry *const e = &p->entry[i];
        sum = ((sum * 31u + (e->x | (uint32_t)e->y << 16)) * 31u + (e->depth ^ (uint32_t)e->kind << 16)) * 31u + (e->color ^ e->next);
    }
#if FRONT_COVERS
    for (int i = 0; i < BASE + 3 * ROOM * 5; i++)
        sum = sum * 31u + p->pool[i];
    sum = sum * 31u + p->words;
#endif
    return sum * 31u + p->count;
}
#endif

/* Indices of vertices, a few of which the mesh does not have. */
static void prepare(struct kernel_call *c)
{
    uint16_t *index = c->plane[0];
    for (int32_t i = 0; i < 3 * c->n; i++)
        index[i] = (uint16_t)(kernel_between(0, 63) == 0 ? kernel_between(0, 65535) : kernel_between(0, VERTICES - 1));
    int16_t *position = c->plane[1];
    for (int32_t i = 0; i < 3 * c->n; i++)
        position[i] = (int16_t)(kernel_between(0, 5) == 0 ? kernel_between(-30000, 30000) : kernel_between(-2000, 2000));
}

/* Near vertices are apart by less than a pixel, or by up to eight; others by up to the frame's size. */
static void setup_make(struct vertex_setup *v, const struct kernel_call *c)
{
    const int32_t steps = 1 << (24 + 2 * (c->word[LOOK] >> 8 & 3u));
    const int32_t m[3][4] = { { steps, 1 << 12, 0, (int32_t)(c->word[CENTRE] >> 5 & 0xffffffu) },
                              { 1 << 12, steps, 0, (int32_t)(c->word[CENTRE] >> 8 & 0xffffffu) },
                              { 0, 0, 1 << ((c->word[LOOK] & 1024u) != 0 ? 12 : 22), 3 << 21 } };
    const int depth_shift = (c->word[LOOK] & 2048u) != 0 ? -4 : -12;
    const struct place_setup s = { m, 1 << 20, 1 << 23, 0x2aaaaaaa, depth_shift, 4096, 0x43ff8000, 160 << 7, 120 << 7 };
    vertex_setup_make(v, &s);
    (void)vertex_setup_for(v, 1 << 22);
}

#if FRONT_COVERS
static uint32_t front_sum(const struct triangle_scan *s, uint32_t sum)
{
    const struct front_cover *const f = s->front;
    sum = (sum * 31u + f->low) * 31u + f->high;
    if (s->covered == FRONT_LARGE)
        return sum;
    sum = (sum * 31u + (uint32_t)f->tiny.area) * 31u + (uint32_t)f->tiny.count;
    for (int i = 0; i < f->tiny.count; i++) {
        const struct covered *const k = &f->tiny.covered[i];
        sum = (((sum * 31u + (uint32_t)k->x) * 31u + (uint32_t)k->y) * 31u + (uint32_t)k->e1) * 31u + (uint32_t)k->e2;
    }
    return sum;
}
#endif

/* What is found in a cache goes into the call's words, as a sum. */
static void scan_by(struct kernel_call *c, enum scan_end (*form)(struct triangle_scan *s))
{
    struct scan_vertex cache[ENTRIES] = { { .tag = 0 } };
    struct vertex_setup setup;
    const int second = (c->word[LOOK] & 1u) != 0 ? 2 : 4;
    const uint16_t *const index = c->plane[0];
    uint32_t sum = 0;
    setup_make(&setup, c);
    struct triangle_scan s = { .second = second, .third = 6 - second, .tag = TAG, .mask = ENTRIES - 1, .cache = cache, .setup = &setup,
                               .position = c->plane[1], .vertex_count = (uint32_t)min_i32(c->n, VERTICES), .width = 160 << 8,
                               .height = 120 << 8, .index = index, .end = index + 3 * c->n,
                               .behind = (c->word[LOOK] & 2u) != 0 ? INT32_MIN : 0 };
#if !SMEAR_HAS_MUL64
    s.side = scan_side(s.height);
#endif
#if FRONT_COVERS
    struct front_cover front = { .low = 0 };
    struct points points;
    points_make(&points);
    s.front = (c->word[LOOK] & 12u) != 0 ? &front : NULL;
    s.rings = (c->word[LOOK] & 48u) != 0 ? &points.rings : NULL;
    s.color = points.color + 2;
    s.first = index;
    s.room = ROOM;
#endif
#if SCAN_MIXES
    s.color = (c->word[LOOK] & 64u) != 0 ? points.color + 2 : NULL;
    s.vertex_color = points.color + 1;
    s.even = (c->word[LOOK] & 128u) != 0;
#endif
#if FRONT_COVERS
    s.records = &points.records;
    s.least = (c->word[LOOK] & 4096u) != 0 ? INT32_MAX : (c->word[LOOK] & 8192u) != 0 ? SCAN_POINTS + 1 : 1;
    points.records.colors = (c->word[LOOK] & 16384u) != 0 ? points.color + 3 : NULL;
    if ((c->word[LOOK] & 32768u) != 0 && s.rings == NULL)
        s.color = NULL;
#endif
    for (enum scan_end at = form(&s); at != SCAN_DONE; at = form(&s)) {
        sum = sum * 31u + (uint32_t)at + (uint32_t)(s.index - index) * 8u;
        if (at == SCAN_FRONT || at == SCAN_ANY)
            sum = sum * 31u + (uint32_t)((s.v[0] - cache) + 16 * (s.v[1] - cache) + 256 * (s.v[2] - cache));
#if FRONT_COVERS
        if (at == SCAN_FRONT && s.front != NULL)
            sum = front_sum(&s, sum * 31u + (uint32_t)s.covered);
#endif
        if (at == SCAN_OUTSIDE)
            s.v[0]->outcode = s.v[0]->screen.x < 0 ? 1 : s.v[0]->screen.y < 0 ? 4 : 8;
        if (at == SCAN_UNREADY)
            *s.v[0] = (struct scan_vertex){ .tag = s.missing, .outcode = 16 };
        if (at == SCAN_SLOW)
            s.index += 3;
    }
    for (int i = 0; i < ENTRIES; i++)
        sum = ((sum * 31u + cache[i].tag) * 31u + cache[i].stored) * 31u
            + (uint32_t)(cache[i].screen.x ^ cache[i].screen.y ^ cache[i].screen.depth ^ cache[i].now.w);
#if FRONT_COVERS
    sum = points_sum(&points, sum * 31u + (uint32_t)s.room);
#endif
    c->word[STOPS] = sum;
}

static enum scan_end scan_best(struct triangle_scan *s) { return triangle_scan(s); }
static enum scan_end scan_slow(struct triangle_scan *s) { return triangle_scan_reference(s); }
static void reference(struct kernel_call *c) { scan_by(c, scan_slow); }
static void best(struct kernel_call *c) { scan_by(c, scan_best); }

extern const struct kernel kernels_triangle_scan[];
const struct kernel kernels_triangle_scan[] = {
    { .name = "triangle_scan", .most = 40, .size = { 6, 6 }, .align = { 2, 2 }, .prepare = prepare, .timed = 40,
      .form = { { "reference", reference }, { "best", best } } },
    { .name = NULL }
};
