/* SPDX-License-Identifier: MIT */
/* triangles.c - how check_kernels calls kernels/triangles.h: fours of triangles among
 * sixteen vertices, near one another or far apart, of which each call makes many from one number; ranges of indices, boxes of positions. */
#include "kernels/triangles.h"

#include "tests/kernels/kernels.h"

enum { VERTICES = 16, FOURS = 64, SEED = 0 };

/* Four triangles, the part of the frame they are in, and how they are seen. */
struct fours {
    struct smear_place place[VERTICES];
    uint16_t index[12];
    struct triangles_setup setup;
};

static uint32_t next(uint32_t *seed)
{
    *seed = *seed * 1664525u + 1013904223u;
    return *seed >> 8 ^ *seed << 24;
}

static void make(struct fours *f, uint32_t *seed)
{
    const uint32_t bits = 2 + next(seed) % 19u, flags = next(seed) >> 8;
    const int32_t x = (int32_t)(next(seed) % 5000u) * 16, y = (int32_t)(next(seed) % 5000u) * 16;
    for (int i = 0; i < VERTICES; i++) {
        struct smear_screen *s = &f->place[i].screen;
        const uint32_t mask = (1u << bits) - 1u;
        const uint32_t coarse = (flags & 8u) != 0 ? 127u : 0u;       /* edges go through centres of pixels */
        *s = (struct smear_screen){ x + (int32_t)(next(seed) & mask & ~coarse), y + (int32_t)(next(seed) & mask & ~coarse), 0 };
        if ((flags & 0x1c00u) == 0) {           /* about the corners of two by two pixels */
            s->x = x + (int32_t)(next(seed) >> 4 & 1u) * 440 + (int32_t)(next(seed) & 63u);
            s->y = y + (int32_t)(next(seed) >> 4 & 1u) * 440 + (int32_t)(next(seed) & 63u);
        }
        s->depth = (int32_t)(next(seed) % 0x7ffffffu >> (flags >> 5 & 3u) * 3u) + 4096;
        if (i > 0 && (flags & 512u) != 0)       /* even ones */
            s->depth = f->place[0].screen.depth + (s->depth >> 12);
        if (i > 0 && (flags & 0x6000u) == 0)    /* and just even */
            s->depth = f->place[0].screen.depth + (next(seed) & 256u ? f->place[0].screen.depth >> 5 : 0);
        f->place[i].first = place_first(s->x, s->y);
    }
    for (int i = 0; i < 12; i++)
        f->index[i] = (uint16_t)(next(seed) >> 8) % VERTICES;
    const int second = (int)(flags & 1u) + 1;
    const int32_t low = (flags & 4u) != 0 ? (x >> 8) + 1 : 0;
    f->setup = (struct triangles_setup){ pair_of(low, low / 2), pair_of(low + 320, (y >> 8) + 2), (flags & 2u) != 0,
                                         (int)(flags >> 4 & 1u), second, 3 - second };
}

/* Keeps what is defined. */
static uint32_t sum_up(uint32_t sum, const struct smear_triangles *t)
{
    sum = sum * 31u + (t->seen | t->far << 4 | (t->seen & t->tiny) << 8 | (t->seen & t->back) << 12);
    for (int k = 0; k < 4; k++) {
        if ((t->seen >> k & 1u) == 0)
            continue;
        sum = sum * 31u + (uint32_t)t->area[k];
        sum = (sum * 31u + t->low[k]) * 31u + t->high[k];
        sum = (sum * 31u + t->edge1[k]) * 31u + t->edge2[k];
        if ((t->tiny >> k & 1u) != 0)
            sum = ((sum * 31u + (uint32_t)t->e1[k]) * 31u + (uint32_t)t->e2[k]) * 31u + t->covered[k];
    }
    return sum;
}

static inline int32_t triangle_bias(int32_t dx, int32_t dy) { return ~(dy * 65536 - dx) >> 31; }

/* Finds which centres of a tiny box are covered. */
static inline void triangle_cover(struct smear_triangles *out, int k, const struct smear_place *first)
{
    const int32_t x1 = pair_x(out->edge1[k]), y1 = pair_y(out->edge1[k]);
    const int32_t x2 = pair_x(out->edge2[k]), y2 = pair_y(out->edge2[k]);
    const int32_t cx = (int16_t)(pair_x(out->low[k]) * 256 + 128 - first->screen.x);
    const int32_t cy = (int16_t)(pair_y(out->low[k]) * 256 + 128 - first->screen.y);
    int32_t e2 = x1 * cy - y1 * cx, e1 = y2 * cx - x2 * cy;
    int32_t e0 = out->area[k] - e1 - e2 + triangle_bias(x2 - x1, y2 - y1);
    e1 += triangle_bias(-x2, -y2);
    e2 += triangle_bias(x1, y1);
    out->e1[k] = e1;
    out->e2[k] = e2;
    out->covered[k] = 0;
    for (int i = 0; i < 4; i++) {
        const int32_t right = (i & 1) * 256, down = (i >> 1) * 256;
        const int32_t all = (e0 + right * (y1 - y2) + down * (x2 - x1)) | (e1 + right * y2 - down * x2)
                          | (e2 - right * y1 + down * x1);
        if (all >= 0 && pair_x(out->low[k]) + (i & 1) < pair_x(out->high[k])
            && pair_y(out->low[k]) + (i >> 1) < pair_y(out->high[k]))
            out->covered[k] |= 1u << i;
    }
}

static inline bool edge_is_far(int32_t d) { return d > TRIANGLES_EDGE_MOST || d < -TRIANGLES_EDGE_MOST - 1; }

/* Looks at triangle k; false where it is not seen. */
static inline bool triangle_look(struct smear_triangles *out, int k, const struct smear_place *const p[3],
                                 const struct triangles_setup *s)
{
    int32_t x[2], y[2], low[2] = { INT16_MAX, INT16_MAX }, high[2] = { INT16_MIN, INT16_MIN };
    for (int i = 0; i < 2; i++) {
        x[i] = p[i + 1]->screen.x - p[0]->screen.x;
        y[i] = p[i + 1]->screen.y - p[0]->screen.y;
        if (edge_is_far(x[i]) || edge_is_far(y[i])) {
            out->far |= 1u << k;
            return false;
        }
    }
    int32_t area = x[0] * y[1] - x[1] * y[0];
    const bool back = s->both_sides && area < 0;
    area = back ? -area : area;
    if (area <= 0)
        return false;
    for (int i = 0; i < 3; i++) {
        low[0] = min_i32(low[0], pair_x(p[i]->first));
        low[1] = min_i32(low[1], pair_y(p[i]->first));
        high[0] = max_i32(high[0], pair_x(p[i]->first));
        high[1] = max_i32(high[1], pair_y(p[i]->first));
    }
    for (int i = 0; i < 2; i++) {
        low[i] = (int16_t)(low[i] - s->margin);
        high[i] = (int16_t)(high[i] + s->margin);
    }
    const bool tiny = (int16_t)(high[0] - low[0]) <= 2 && (int16_t)(high[1] - low[1]) <= 2;
    low[0] = max_i32(low[0], pair_x(s->low));
    low[1] = max_i32(low[1], pair_y(s->low));
    high[0] = min_i32(high[0], pair_x(s->high));
    high[1] = min_i32(high[1], pair_y(s->high));
    if (low[0] >= high[0] || low[1] >= high[1])
        return false;
    out->area[k] = area;
    out->low[k] = pair_of(low[0], low[1]);
    out->high[k] = pair_of(high[0], high[1]);
    out->edge1[k] = pair_of(x[back], y[back]);
    out->edge2[k] = pair_of(x[!back], y[!back]);
    out->back |= (uint32_t)back << k;
    if (!tiny)
        return true;
    out->tiny |= 1u << k;
    triangle_cover(out, k, p[0]);
    return out->covered[k] != 0;
}

static inline void triangles_reference(struct smear_triangles *out, const struct smear_place *place,
                                       const uint16_t index[12], const struct triangles_setup *s)
{
    out->seen = out->far = out->tiny = out->back = 0;
    for (int k = 0; k < 4; k++) {
        const uint16_t *i = index + 3 * k;
        const struct smear_place *const p[3] = { place + i[0], place + i[s->second], place + i[s->third] };
        out->seen |= (uint32_t)triangle_look(out, k, p, s) << k;
    }
}

static void many(struct kernel_call *c, triangles_fn *look)
{
    struct fours f;
    struct smear_triangles t;
    uint32_t seed = c->word[SEED], sum = 0;
    for (int i = 0; i < FOURS; i++) {
        make(&f, &seed);
        look(&t, f.place, f.index, &f.setup);
        sum = sum_up(sum, &t);
    }
    c->word[1] = sum;
}

static void reference(struct kernel_call *c)
{
    many(c, &triangles_reference);
}

static void range_reference(struct kernel_call *c)
{
    const struct index_range r = indices_range_reference(c->plane[0], c->n);
    c->word[0] = r.least;
    c->word[1] = r.most;
}

static void box_reference(struct kernel_call *c)
{
    positions_box_reference((int16_t *)(void *)c->word, c->plane[0], c->n);
}

#if SMEAR_VECTORS
static void look_by_vectors(struct smear_triangles *out, const struct smear_place *place, const uint16_t index[12],
                            const struct triangles_setup *s)
{
    triangles_vector(out, place, index, s);
}

static void vector(struct kernel_call *c)
{
    many(c, &look_by_vectors);
}

static void range_vector(struct kernel_call *c)
{
    const struct index_range r = indices_range_vector(c->plane[0], c->n);
    c->word[0] = r.least;
    c->word[1] = r.most;
}

static void box_vector(struct kernel_call *c)
{
    positions_box_vector((int16_t *)(void *)c->word, c->plane[0], c->n);
}
#endif

KERNELS(triangles) = {
    { .name = "triangles (made, looked at)", .least = 4 * FOURS, .most = 4 * FOURS, .size = { 1 }, .timed = 4 * FOURS,
      .form = { { "reference", reference } VECTOR_FORM("vector", vector) } },
    { .name = "indices_range", .most = 35, .size = { 2 }, .timed = 192,
      .form = { { "reference", range_reference } VECTOR_FORM("vector", range_vector) } },
    { .name = "positions_box", .most = 35, .size = { 6 }, .timed = 64,
      .form = { { "reference", box_reference } VECTOR_FORM("vector", box_vector) } },
    { .name = NULL }
};
