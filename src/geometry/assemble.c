/* SPDX-License-Identifier: MIT */
/* assemble.c - the loop over a draw's triangles.
 *
 * The cheapest rejection comes first: vertices share an outcode, the triangle faces away, it touches no pixel centre.
 * Only then are vertices shaded, transformed to the other poses and stored, once each. Triangles that need clipping
 * take a path of their own; those of one or two unshaded pixels are finished here: they become points. */
#include "geometry/assemble.h"

#include "geometry/batch.h"
#include "geometry/places.h"
#include "geometry/ranges.h"
#include "geometry/tiny.h"
#include "geometry/vertex.h"

/* ------------------------------------------------------------------ records of vertices */

static SMEAR_RARE uint32_t shade_face(const struct batch *b, uint32_t triangle, bool back)
{
    struct smear_face face = smear_face_of(b->d, triangle, back);
    return smear_face_color(b->d, b->segment, &face);
}

static inline uint32_t color_of_face(const struct batch *b, uint32_t triangle, bool back)
{
    if (b->face_color != NULL) {
        const uint8_t *c = b->face_color + 4 * triangle;
        return pixel_of_bytes(c);
    }
    return b->segment->shade == SHADE_FLAT ? shade_face(b, triangle, back) : 0xffffffffu;
}

/* Stores a vertex; returns the first word of its record. */
static inline uint32_t store_vertex(const struct batch *b, uint32_t index, const struct smear_screen *screen, uint32_t triangle,
                                    bool back)
{
    const struct smear_assembly *d = b->d;
    const struct smear_segment *s = b->segment;
    struct smear_bins *g = b->a->bins;
    uint32_t word = g->vertex_words;
    uint32_t *record = g->pool + word;
    g->vertex_words = word + s->stride;
    store_place(record, screen);
    if (segment_textured(s))
        store_mesh_uv(record + s->uv, d, index);
    if (SMEAR_WITH_GOURAUD && b->vertex_color != NULL) {      /* as smear_shade has it */
        const uint8_t *c = b->vertex_color + 4 * index;
        record[s->color] = (uint32_t)c[0] << 8 | (uint32_t)c[1] << 24;
        record[s->color + 1] = (uint32_t)c[2] << 8 | c[3] * 257u << 16;
    } else if (segment_colored(s)) {
        smear_vertex_store_color(record + s->color, d, index, triangle, back);
    }
    if (segment_moves(s) != 0)
        smear_batch_store_motion(record + s->motion, b, index, screen);
    return word;
}

/* Returns the vertex's record, as struct smear_cached_vertex has it, which it stores where that has not been done since `base`. */
static SMEAR_RARE uint32_t store_cached(const struct batch *b, struct smear_cached_vertex *v, uint32_t triangle, bool back)
{
    const bool shares = batch_shares(b, back);
    if (SMEAR_SMALL_CODE && shares && v->stored > b->segment->base)
        return v->stored;
    const uint32_t stored = store_vertex(b, index_of(v), &v->screen, triangle, back) + 1;
    if (shares)
        v->stored = stored;
    return stored;
}

/* Does so without a call for those that are stored. */
static inline uint32_t stored_vertex(const struct batch *b, struct smear_cached_vertex *v, uint32_t base, uint32_t triangle, bool back)
{
    return !SMEAR_SMALL_CODE && v->stored > base ? v->stored : store_cached(b, v, triangle, back);
}

/* Returns where records begin that faces share; UINT32_MAX where they do not. */
static inline uint32_t shared_base(const struct batch *b, bool back) { return batch_shares(b, back) ? b->segment->base : UINT32_MAX; }

/* ------------------------------------------------------------------ what tiny triangles cover */

/* A pixel that a triangle covers, and its edge functions there: twice the areas opposite to corners 1 and 2, q16. */
struct covered {
    int32_t x, y, e1, e2;
};

enum { TINY_BOX = 2, COVERED_KEPT = 2 };
struct tiny_cover {
    int32_t area;                   /* twice the area, q16 px */
    int32_t count;                  /* centres covered */
    struct covered covered[COVERED_KEPT];       /* the first of them, row by row */
};

/* Finds which centres of the box are covered, and keeps the first. */
static inline void cover(struct tiny_cover *t, const struct box *box, const struct smear_screen *v0, const struct smear_screen *v1,
                         const struct smear_screen *v2)
{
    const int32_t x = box->x0, y = box->y0;
    const int32_t x1 = v1->x - v0->x, y1 = v1->y - v0->y, x2 = v2->x - v0->x, y2 = v2->y - v0->y;
    struct tiny_edges e;
    t->area = x1 * y2 - x2 * y1;
    t->count = 0;
    tiny_start(&e, v0->x, v0->y, x1, y1, x2, y2, t->area, x, y);
    for (int32_t row = y; row < box->y1; row++) {
        int32_t e0 = e.e0, e1 = e.e1, e2 = e.e2;
        for (int32_t column = x; column < box->x1; column++) {
            if ((e0 | e1 | e2) >= 0) {
                if (t->count < COVERED_KEPT)
                    t->covered[t->count] = (struct covered){ column, row, e1, e2 };
                t->count++;
            }
            e0 += e.right0;
            e1 += e.right1;
            e2 += e.right2;
        }
        e.e0 += e.down0;
        e.e1 += e.down1;
        e.e2 += e.down2;
    }
}

static void forget_all(struct smear_assembler *a)
{
    for (uint32_t i = 0; i <= a->cache_mask; i++)
        a->cache[i].tag = 0;
    a->serial = 0;
    a->cache_has_paths = false;
}

void smear_assembler_reset(struct smear_assembler *a)
{
    a->path_count = 0;
    a->resume = (struct smear_resume){ 0, 0 };
    if (a->serial == 0)         /* after that, serial numbers tell old vertices from new ones */
        forget_all(a);
}

/* ------------------------------------------------------------------ whole triangles */

/* Triangles of up to this many covered pixels become points, which are no larger than a triangle with vertices. */
enum { POINTS_MAX = 2 };

static SMEAR_RARE void add_points(struct batch *b, struct smear_cached_vertex *const v[3], uint32_t triangle, bool back,
                                  const struct tiny_cover *t)
{
    struct smear_bins *g = b->a->bins;
    const struct smear_segment *s = b->segment;
    const bool colored = segment_colored(s);
    const uint32_t *corner[3] = { NULL, NULL, NULL };
    struct tiny_channel channel[3] = { { 0, 0, 0 } };
    uint32_t color = 0;
    if (!colored)
        color = color_of_face(b, triangle, back);
    if (segment_by_vertices(s))
        for (int i = 0; i < 3; i++)
            corner[i] = g->pool + stored_vertex(b, v[i], shared_base(b, back), triangle, back) - 1 + s->color;
    if (colored)
        tiny_channels(channel, corner[0], corner[1], corner[2], b->d->shading.transfer);
    const struct tiny_scale scale = tiny_scale_make(t->area);
    const int32_t q0 = v[0]->screen.depth, q1 = v[1]->screen.depth, q2 = v[2]->screen.depth;
    for (int i = 0; i < t->count; i++) {
        const struct covered *p = &t->covered[i];
        const uint32_t w1 = tiny_weight(scale, p->e1), w2 = tiny_weight(scale, p->e2);
        if (colored)
            color = tiny_color(channel, w1, w2, shading_is_linear(&b->d->shading));
        bins_add(g, &g->opaque_last[bins_row(g, p->y)], (uint32_t)p->x, (uint32_t)p->y, tiny_depth(q0, q1, q2, w1, w2), SMEAR_POINT, color);
    }
}

/* Finds room for a triangle and three vertices. Returns false where there is none. */
static SMEAR_RARE bool find_room(struct batch *b)
{
    struct smear_segment *s = make_room(b->a, b->d, b->segment, POINTS_MAX, 0);
    if (s == NULL)
        return false;
    b->segment = s;
    if (SMEAR_SMALL_CODE)
        return true;
    const struct smear_bins *g = b->a->bins;
    const uint32_t words = (ROOM_AHEAD + 1u) * 3u * s->stride;
    if (g->vertex_words + words - s->base <= 65536u && bins_has_room(g, words, (ROOM_AHEAD + 1u) * POINTS_MAX))
        b->room = ROOM_AHEAD;
    return true;
}

/* Adds a triangle, for which there is room, with its vertices. */
SMEAR_INLINE void add_stored(struct batch *b, struct smear_segment *s, struct smear_cached_vertex *v0,
                             struct smear_cached_vertex *v1, struct smear_cached_vertex *v2, uint32_t triangle, bool back,
                             int32_t top)
{
    struct smear_bins *g = b->a->bins;
    const uint32_t base = shared_base(b, back), before = s->base + 1;
    const uint32_t offset0 = stored_vertex(b, v0, base, triangle, back) - before;
    const uint32_t offset1 = stored_vertex(b, v1, base, triangle, back) - before;
    const uint32_t offset2 = stored_vertex(b, v2, base, triangle, back) - before;
    bins_add(g, b->last + bins_row(g, top), offset0, offset1, offset2, (uint32_t)(s - g->segment),
             color_of_face(b, triangle, back));
}

/* Adds a triangle that lies within the guard band and is clockwise on the screen; with `cut`, it may reach, with
 * its margin, beyond the part of the frame that is being filled. Returns false when there is no room. */
SMEAR_INLINE bool add_visible(struct batch *b, struct smear_cached_vertex *v0, struct smear_cached_vertex *v1,
                              struct smear_cached_vertex *v2, uint32_t triangle, bool back, bool cut)
{
    struct box box = box_of(&v0->screen, &v1->screen, &v2->screen);
    if (SMEAR_EDGES && (SMEAR_SMALL_CODE || cut))
        box_widen(&box, b->a);
    bool tiny = box.x1 - box.x0 <= TINY_BOX && box.y1 - box.y0 <= TINY_BOX;
    if (cut)
        box_cut(&box, b->a);
    if (box_is_empty(&box) || !is_damaged(b->a, &box))
        return true;
    struct tiny_cover t;
    bool points = tiny;
    if (tiny) {
        const struct box small = box;       /* box is in registers */
        cover(&t, &small, &v0->screen, &v1->screen, &v2->screen);
        if (t.count == 0)
            return true;
        points = t.count <= POINTS_MAX && b->points && (!segment_by_vertices(b->segment) || segment_flat_depth(b->segment)
            || tiny_is_even(v0->screen.depth, v1->screen.depth, v2->screen.depth));
    }
    if (!SMEAR_SMALL_CODE && b->room != 0)
        b->room--;
    else if (!find_room(b))
        return false;
    struct smear_segment *s = b->segment;
    b->a->triangles_drawn++;
    if (points) {
        struct smear_cached_vertex *const v[3] = { v0, v1, v2 };
        add_points(b, v, triangle, back, &t);
        return true;
    }
    add_stored(b, s, v0, v1, v2, triangle, back, box.y0);
    return true;
}

static SMEAR_NOINLINE bool add_whole(struct batch *b, struct smear_cached_vertex *v0, struct smear_cached_vertex *v1,
                                     struct smear_cached_vertex *v2, uint32_t triangle, bool back, bool cut)
{
    return add_visible(b, v0, v1, v2, triangle, back, cut);
}

/* Transforms and projects a vertex that is not in the cache, at v. An index that the mesh does not have gives OUT_UNKNOWN. */
static SMEAR_NOINLINE void miss(const struct batch *b, struct smear_cached_vertex *v, uint32_t tag)
{
    const uint32_t index = tag & 0xffffu;
    v->tag = tag;
    v->stored = 0;
    v->outcode = index < b->d->mesh->vertex_count ? placement_project(&v->screen, &b->d->at, index, &b->a->viewport) : OUT_UNKNOWN;
}

static void batch_start(struct batch *b)
{
    const struct smear_assembler *a = b->a;
    const struct smear_assembly *d = b->d;
    const struct smear_segment *s = b->segment;
    const smear_mesh *mesh = d->mesh;
    const struct smear_bins *g = a->bins;
    b->shares = shares_vertices(d, s);
    b->partial = g->row_first != 0 || g->row_end * g->row_px < a->viewport.height || bins_margin(g) != 0;
    b->points = d->material->alpha == SMEAR_OPAQUE && !segment_textured(s) && segment_moves(s) == 0 && !d->fixed && bins_margin(g) == 0;
    b->double_sided = d->backs;
    b->last = is_blend(d) ? a->bins->blend_last : a->bins->opaque_last;
    if (d->shading.lit || !d->shading.white)
        return;
    if (s->shade == SHADE_FLAT && mesh->color == NULL)
        b->face_color = mesh->face_color;
    if (segment_colored(s) && !shading_is_linear(&d->shading) && mesh->face_color == NULL)
        b->vertex_color = mesh->color;
}

/* Adds a triangle if it may be seen; its vertices are clockwise on the screen where its front is. Returns false where there is no room. */
SMEAR_INLINE bool add_triangle(struct batch *b, struct smear_cached_vertex *v0, struct smear_cached_vertex *v1,
                               struct smear_cached_vertex *v2, uint32_t triangle)
{
    const int any = v0->outcode | v1->outcode | v2->outcode;
    if (any != 0) {
        if ((v0->outcode & v1->outcode & v2->outcode & OUT_REJECT) != 0)
            return true;
        if ((any & OUT_UNKNOWN) != 0) {
            b->a->triangles_dropped++;
            return true;
        }
    }
    if ((any & OUT_CLIP) != 0) {
        const bool mirrored = b->d->mirrored;       /* clipping takes the mesh's own order */
        const struct smear_cached_vertex *corner[3] = { v0, mirrored ? v1 : v2, mirrored ? v2 : v1 };
        b->room = 0;
        return smear_batch_add_clipped(b, corner, triangle);
    }
    const int32_t side = side_of(&v0->screen, &v1->screen, &v2->screen);
    if (side < 0 ? !b->double_sided : side == 0)
        return true;
    const bool cut = any != 0 || b->partial;
    if (side < 0)
        return add_whole(b, v0, v2, v1, triangle, true, cut);
    if (SMEAR_SMALL_CODE || cut)
        return add_whole(b, v0, v1, v2, triangle, false, cut);
    SMEAR_KEEP_VALUE(v1);       /* read again: most are turned away, and have no registers for what few need */
    SMEAR_KEEP_VALUE(v2);
    return add_visible(b, v0, v1, v2, triangle, false, false);
}

/* Adds triangles [first, end). Their vertices go through the cache. Returns false where there is no room. */
static bool assemble_cached(struct batch *b, uint32_t first, uint32_t end)
{
    struct smear_assembler *a = b->a;
    const struct smear_assembly *d = b->d;
    if (b->tag == 0) {
        if (a->serial == 0xffffu || a->cache_has_paths)
            forget_all(a);
        b->tag = ++a->serial << 16;
    }
    const uint32_t tag = b->tag;
    struct smear_cached_vertex spare[2];
    struct smear_cached_vertex *const cache = a->cache;
    const uint32_t mask = a->cache_mask;
    /* Vertices are taken in the order that is clockwise on the screen for front faces. */
    const int second = d->mirrored ? 1 : 2, third = 3 - second;
    const uint16_t *index = d->mesh->index + 3 * first;

    for (uint32_t i = first; i < end; i++, index += 3) {
        uint32_t tag0 = tag | index[0], tag1 = tag | index[second], tag2 = tag | index[third];
        struct smear_cached_vertex *v0 = cache + (tag0 & mask), *v1 = cache + (tag1 & mask);
        struct smear_cached_vertex *v2 = cache + (tag2 & mask);
        if (v0->tag != tag0)
            miss(b, v0, tag0);
        if (v1->tag != tag1) {
            v1 = v1 == v0 ? &spare[0] : v1;     /* entries that this triangle already uses must not be overwritten */
            miss(b, v1, tag1);
        }
        if (v2->tag != tag2) {
            v2 = v2 == v0 || v2 == v1 ? &spare[1] : v2;
            miss(b, v2, tag2);
        }
        if (!add_triangle(b, v0, v1, v2, i)) {
            a->resume = (struct smear_resume){ i, b->parts };
            return false;
        }
    }
    return true;
}

/* ------------------------------------------------------------------ triangles by fours */

/* Triangle k of four. */
struct seen {
    const struct places *places;
    const struct smear_triangles *four;
    uint32_t k;
    uint32_t index[3];              /* clockwise on the screen */
    uint32_t triangle;
    bool back;
};

static inline uint32_t stored_place(const struct batch *b, const struct seen *t, int i, bool shares)
{
    const struct places *r = t->places;
    const uint32_t index = t->index[i];
    if (shares && r->stored[index] > b->segment->base)
        return r->stored[index] - 1;
    const uint32_t word = store_vertex(b, index, &r->place[index].screen, t->triangle, t->back);
    if (shares)
        r->stored[index] = word + 1;
    return word;
}

/* Adds a triangle that is not finished here. */
static inline void add_listed(const struct batch *b, const struct seen *t)
{
    struct smear_bins *g = b->a->bins;
    const bool shares = batch_shares(b, t->back);
    const uint32_t base = b->segment->base;
    const uint32_t offset0 = stored_place(b, t, 0, shares) - base;
    const uint32_t offset1 = stored_place(b, t, 1, shares) - base;
    const uint32_t offset2 = stored_place(b, t, 2, shares) - base;
    bins_add(g, b->last + bins_row(g, pair_y(t->four->low[t->k])), offset0, offset1, offset2,
             (uint32_t)(b->segment - g->segment), color_of_face(b, t->triangle, t->back));
}

/* Whether four bits have no more than POINTS_MAX. */
static inline bool has_few_bits(uint32_t bits) { return (0x177fu >> bits & 1u) != 0; }

/* Whether a triangle may be kept as its pixels. */
static inline bool seen_is_points(const struct batch *b, const struct seen *t)
{
    if (!b->points || (t->four->tiny >> t->k & 1u) == 0 || !has_few_bits(t->four->covered[t->k]))
        return false;
    const struct smear_place *place = t->places->place;
    return !segment_by_vertices(b->segment) || segment_flat_depth(b->segment)
        || tiny_is_even(place[t->index[0]].screen.depth, place[t->index[1]].screen.depth, place[t->index[2]].screen.depth);
}

/* Adds a tiny triangle's pixels as points. */
static inline void add_seen_points(const struct batch *b, const struct seen *t)
{
    const struct smear_triangles *four = t->four;
    const uint32_t k = t->k;
    const struct smear_place *place = t->places->place;
    struct smear_bins *g = b->a->bins;
    const bool colored = segment_colored(b->segment);
    const int32_t q0 = place[t->index[0]].screen.depth, q1 = place[t->index[1]].screen.depth;
    const int32_t q2 = place[t->index[2]].screen.depth;
    const struct tiny_scale scale = tiny_scale_make(four->area[k]);
    const uint32_t *corner[3] = { NULL, NULL, NULL };
    struct tiny_channel channel[3];
    uint32_t color = 0;
    if (!colored)
        color = color_of_face(b, t->triangle, t->back);
    if (segment_by_vertices(b->segment)) {
        const bool shares = batch_shares(b, t->back);
        for (int i = 0; i < 3; i++)
            corner[i] = g->pool + stored_place(b, t, i, shares) + b->segment->color;
    }
    if (colored)
        tiny_channels(channel, corner[0], corner[1], corner[2], b->d->shading.transfer);
    for (uint32_t bits = four->covered[k]; bits != 0; bits &= bits - 1) {
        const int32_t i = __builtin_ctz(bits), x = i & 1, y = i >> 1;
        int32_t e1 = four->e1[k], e2 = four->e2[k];
        if (x != 0) {
            e1 += pair_y(four->edge2[k]) * 256;
            e2 -= pair_y(four->edge1[k]) * 256;
        }
        if (y != 0) {
            e1 -= pair_x(four->edge2[k]) * 256;
            e2 += pair_x(four->edge1[k]) * 256;
        }
        const uint32_t w1 = tiny_weight(scale, e1), w2 = tiny_weight(scale, e2);
        const int32_t row = pair_y(four->low[k]) + y;
        if (colored)
            color = tiny_color(channel, w1, w2, shading_is_linear(&b->d->shading));
        bins_add(g, &g->opaque_last[bins_row(g, row)], (uint32_t)(pair_x(four->low[k]) + x), (uint32_t)row,
                 tiny_depth(q0, q1, q2, w1, w2), SMEAR_POINT, color);
    }
}

/* Adds a triangle that may be seen. There is room. */
static inline void add_seen(struct batch *b, const struct seen *t)
{
    const struct smear_triangles *four = t->four;
    if (assembler_has_damage(b->a)) {
        const uint32_t low = four->low[t->k], high = four->high[t->k];
        const struct box box = { pair_x(low), pair_y(low), pair_x(high), pair_y(high) };
        if (!is_damaged(b->a, &box))
            return;
    }
    b->a->triangles_drawn++;
    if (seen_is_points(b, t))
        add_seen_points(b, t);
    else
        add_listed(b, t);
}

static inline bool place_is_clipped(const struct smear_screen *s, const struct smear_viewport *viewport)
{
    return s->x == PLACE_NEAR || s->x == PLACE_FAR || (outcode_sides(s, viewport) & OUT_GUARD) != 0;
}

/* Adds a triangle of long edges, or one that has to be clipped, vertex by vertex. */
static SMEAR_NOINLINE bool add_far(struct batch *b, const struct seen *t)
{
    const struct places *r = t->places;
    const struct smear_viewport *viewport = &b->a->viewport;
    struct smear_cached_vertex v[3];
    bool clipped = false;
    for (int i = 0; i < 3; i++)
        clipped = clipped || place_is_clipped(&r->place[t->index[i]].screen, viewport);
    for (int i = 0; i < 3; i++) {
        if (clipped) {
            miss(b, &v[i], t->index[i]);
        } else {
            v[i].screen = r->place[t->index[i]].screen;
            v[i].outcode = outcode_sides(&v[i].screen, viewport);
            v[i].tag = t->index[i];
        }
        v[i].stored = r->stored[t->index[i]];
    }
    const bool added = add_triangle(b, &v[0], &v[1], &v[2], t->triangle);
    for (int i = 0; i < 3; i++)
        r->stored[t->index[i]] = v[i].stored;
    if (!added)
        b->a->resume = (struct smear_resume){ t->triangle, b->parts };
    return added;
}

/* Adds those of four triangles that may be seen. Returns false where there is no room. */
static inline bool add_four(struct batch *b, const struct places *r, const struct smear_triangles *four,
                            const uint16_t *index, uint32_t triangle)
{
    if (!segment_has_room(b, triangle))
        return false;
    for (uint32_t all = four->seen | four->far; all != 0; all &= all - 1) {
        const uint32_t k = (uint32_t)__builtin_ctz(all);
        const uint16_t *const corner = index + 3 * k;
        const uint32_t index1 = corner[r->setup.second], index2 = corner[r->setup.third];
        if ((four->far >> k & 1u) != 0) {
            const struct seen far = { r, four, k, { corner[0], index1, index2 }, triangle + k, false };
            if (!add_far(b, &far))
                return false;
            continue;
        }
        const bool back = (four->back >> k & 1u) != 0;
        const struct seen t = { r, four, k, { corner[0], back ? index2 : index1, back ? index1 : index2 }, triangle + k, back };
        add_seen(b, &t);
    }
    return true;
}

/* Adds triangles from `first` to where places end, or are in the way. Returns where that is; UINT32_MAX where there is no room. */
static SMEAR_NOINLINE uint32_t add_by_fours(struct batch *b, const struct places *r, uint32_t first, uint32_t end)
{
    const uint16_t *index = b->d->mesh->index + 3 * first;
    struct smear_triangles four;
    for (uint32_t i = first; i < end; i += 4, index += 12) {
        uint16_t rest[12];
        const uint16_t *these = index;
        if (end - i < 4) {          /* corners of one vertex make the others */
            for (uint32_t k = 0; k < 12; k++)
                rest[k] = index[k < 3 * (end - i) ? k : 0];
            these = rest;
        }
        if (SMEAR_PLACES)
            triangles_look(&four, r->place, these, &r->setup);
        else
            break;
        if ((four.seen | four.far) == 0)
            continue;
        if (!places_have_room(r, b->a->bins))
            return i;
        if (!add_four(b, r, &four, these, i))
            return UINT32_MAX;
    }
    return end;
}

/* Adds triangles [begin, end): by fours where the pool has room for where vertices are. */
static bool assemble_run(struct batch *b, uint32_t begin, uint32_t end)
{
    if (!SMEAR_PLACES)
        return assemble_cached(b, begin, end);
    struct places r = { .setup = places_setup(b) };
    for (uint32_t i = begin; i < end;) {
        const uint32_t last = smear_places_open(&r, b, i, end);
        uint32_t reached = last != i ? add_by_fours(b, &r, i, last) : i;
        if (reached == UINT32_MAX)
            return false;
        if (reached < last || last == i) {
            const uint32_t next = min_u32(reached + PLACES_BLOCK, end);
            if (!assemble_cached(b, reached, next))
                return false;
            reached = next;
        }
        i = reached;
    }
    return true;
}

bool smear_assemble(struct smear_assembler *a, const struct smear_assembly *d)
{
    struct batch b = { .a = a, .d = d, .segment = smear_vertex_segment(a, d) };
    if (b.segment == NULL)
        return false;
    batch_start(&b);
    const struct smear_tile_box filled = ranges_filled(a, false);
    for (uint32_t first = max_u32(d->first, a->resume.triangle), end = first; end < d->end; first = end) {
        end = smear_ranges_seen(a, d, filled, &first);
        if (!assemble_run(&b, first, end))
            return false;
    }
    a->resume = (struct smear_resume){ 0, 0 };
    return true;
}
