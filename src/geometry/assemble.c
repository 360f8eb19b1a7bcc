/* SPDX-License-Identifier: MIT */
/* assemble.c - the loop over a draw's triangles.
 *
 * The cheapest rejection comes first: vertices share an outcode, the triangle faces away, it touches no pixel centre.
 * Only then are vertices shaded, transformed to the other poses and stored, once each. Triangles that need clipping
 * take a path of their own; those of one or two unshaded pixels are finished here: they become points. */
#include "geometry/assemble.h"

#include "geometry/clip.h"
#include "base/fixmath.h"
#include "geometry/tiny.h"

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
    if (a->serial == 0)         /* after that, serial numbers tell old vertices from new ones */
        forget_all(a);
}

static uint32_t index_of(const struct smear_cached_vertex *v)
{
    return v->tag & 0xffffu;
}

/* Returns where the vertex is now, before the division: from the cache, or transformed again into *found. */
static const struct smear_homogeneous *now_of(struct smear_homogeneous *found, const struct smear_assembly *d,
                                              const struct smear_cached_vertex *v)
{
#if SMEAR_FAST_STACK
    placement_transform(found, &d->at, index_of(v));
    return found;
#else
    (void)found;
    (void)d;
    return &v->now;
#endif
}

static uint32_t displaced(int32_t there, int32_t ratio, int32_t now)
{
    const int64_t far_out = (1 << 27) - 1;
    int64_t d = there - ((int64_t)ratio * now >> 20);
    return (uint32_t)(int32_t)(d < -far_out ? -far_out : d > far_out ? far_out : d);
}

/* Stores the words of MOTION_*: the point of the surface that is at `now` on the screen is at `h` in another pose. */
static void store_motion(uint32_t out[MOTION_WORDS], const struct smear_assembly *d, int pose,
                         const struct smear_homogeneous *h, const struct smear_homogeneous *now,
                         const struct smear_screen *screen, const struct smear_viewport *viewport)
{
    /* x' / w in q8 and w' / w in q20; the pose's rows have a scale of their own. */
    int scale = d->at.now.scale - d->pose[pose].scale;
    int zeros = count_leading_zeros((uint32_t)now->w);
    int32_t r = (int32_t)recip_norm((uint32_t)now->w << zeros);         /* 2^(61 - zeros) / w */
    /* Rows stay below 2^30; small meshes leave more room, which the high products need. */
    int up = count_leading_zeros((uint32_t)(abs_i32(h->x) | abs_i32(h->y) | abs_i32(h->w) | 1)) - 1;
    int shift = zeros - 29 + scale - up;
    int32_t x = scale_sat(mulh_i32(shl_wrap(h->x, up), r), clamp_i32(shift + 8, -31, 31));
    int32_t y = scale_sat(mulh_i32(shl_wrap(h->y, up), r), clamp_i32(shift + 8, -31, 31));
    int32_t ratio = scale_sat(mulh_i32(shl_wrap(h->w, up), r), clamp_i32(shift + 20, -31, 31));
    out[MOTION_DX] = displaced(x, ratio, screen->x - viewport->width * 128);
    out[MOTION_DY] = displaced(y, ratio, screen->y - viewport->height * 128);
    out[MOTION_RATIO] = (uint32_t)ratio;
}

/* Whether the display lacks one of the tiles that the box reaches into; notes where triangles are seen. */
static inline bool is_damaged(const struct smear_assembler *a, const struct box *box)
{
    if (!assembler_has_damage(a))
        return true;
    const struct smear_tile_box tiles = tile_box_of(a->damaged, box->x0, box->x1, box->y0, box->y1);
    if (a->damaged->seen != NULL)
        tile_box_add(a->damaged->seen, tiles);
    return !a->damaged->only || tile_box_is_damaged(a->damaged, tiles);
}

/* What the loop over a draw's triangles needs for each of them. */
struct batch {
    struct smear_assembler *a;
    const struct smear_assembly *d;
    struct smear_segment *segment;      /* the newest */
    bool shares;                        /* all faces of a vertex share its record */
    bool partial;                       /* only a part of the frame is being filled */
    bool points;                        /* triangles have only a colour and a depth: tiny ones become points */
    bool double_sided;
    const uint8_t *face_color;          /* flat colours that need no shading; null: they are shaded */
    const uint8_t *vertex_color;        /* codes of vertices that need no shading; null: they are shaded, or none */
};

/* ------------------------------------------------------------------ clipped triangles */

/* What clipping leaves of a triangle. */
struct clipped {
    struct smear_clip_polygon polygon;
    struct smear_screen screen[SMEAR_CLIP_MAX];
    struct smear_face face;
    int64_t area;               /* twice the polygon's area, positive when it is clockwise on the screen */
};

/* Clips the triangle, its vertices shaded as those of c->face, and projects what is left. */
static void clip_and_project(struct clipped *c, const struct batch *b,
                             const struct smear_cached_vertex *const corner[3])
{
    const struct smear_assembly *d = b->d;
    const struct smear_segment *s = b->segment;
    const int poses = SMEAR_WITH_RECONSTRUCT ? d->moves : 0;
    for (int i = 0; i < 3; i++) {
        struct smear_clip_vertex *v = &c->polygon.vertex[i];
        const uint32_t index = index_of(corner[i]);
        v->now = *now_of(&v->now, d, corner[i]);
        for (int pose = 0; pose < poses; pose++)
            pose_transform(&v->pose[pose], d, pose, index);
        smear_vertex_for_clipping(v, d, s, index, &c->face);
    }
    smear_clip_start(&c->polygon, poses, segment_textured(s), segment_colored(s));
    smear_clip_polygon(&c->polygon, &d->at.now, corner[0]->outcode | corner[1]->outcode | corner[2]->outcode);
    c->area = 0;
    for (int i = 0; i < c->polygon.count; i++) {
        smear_project(&c->screen[i], &d->at.now, &clip_corner(&c->polygon, i)->now, &b->a->viewport);
        if (i >= 2)
            c->area += area_of(&c->screen[0], &c->screen[i - 1], &c->screen[i]);
    }
    for (int i = 0; i < c->polygon.count; i++)
        screen_clamp(&c->screen[i], &b->a->viewport);
}

/* Stores corner i of the polygon; returns the offset of its record in the segment. */
static uint16_t store_corner(const struct batch *b, struct clipped *c, int i)
{
    const struct smear_segment *s = b->segment;
    const struct smear_clip_vertex *v = clip_corner(&c->polygon, i);
    struct smear_bins *g = b->a->bins;
    const uint32_t word = g->vertex_words;
    uint32_t *record = g->pool + word;
    g->vertex_words = word + s->stride;
    store_place(record, &c->screen[i]);
    smear_vertex_store_clipped(record, s, v);
    for (int pose = 0; pose < segment_moves(s); pose++)
        store_motion(record + s->motion + pose * MOTION_WORDS, b->d, pose, &v->pose[pose], &v->now, &c->screen[i],
                     &b->a->viewport);
    return (uint16_t)(word - s->base);
}

/* Adds the triangle of corners 0, i - 1 and i. Returns false where there is no room. */
static bool add_fan(struct batch *b, struct clipped *c, int i)
{
    const struct smear_screen *place[3] = { &c->screen[0], &c->screen[i - 1], &c->screen[i] };
    const int64_t area = area_of(place[0], place[1], place[2]);
    /* Rounding may turn over a sliver of the fan, which then covers nothing that its neighbours do not. */
    if (area == 0 || (area > 0) != (c->area > 0))
        return true;
    struct box box = box_of(place[0], place[1], place[2]);
    box_cut(&box, b->a);
    if (box_is_empty(&box) || !is_damaged(b->a, &box))
        return true;
    struct smear_segment *s = make_room(b->a, b->d, b->segment, 1);
    if (s == NULL)
        return false;
    b->segment = s;
    const uint16_t first = store_corner(b, c, 0), second = store_corner(b, c, i - 1), third = store_corner(b, c, i);
    struct smear_bins *g = b->a->bins;
    struct smear_triangle *t = bins_add(g, row_list(g, b->d, bins_row(g, box.y0)));
    b->a->triangles_drawn++;
    t->segment = (uint16_t)(s - g->segment);
    t->color = smear_face_color(b->d, s, &c->face);
    t->vertex[0] = first;
    t->vertex[1] = c->area > 0 ? second : third;
    t->vertex[2] = c->area > 0 ? third : second;
    return true;
}

/* Adds what is left of a triangle that has to be clipped, as a fan. Returns false where there is no room. */
static SMEAR_NOINLINE bool add_clipped(struct batch *b, const struct smear_cached_vertex *const corner[3],
                                       uint32_t triangle)
{
    struct clipped c;
    const bool colored = segment_colored(b->segment);
    if (colored)
        c.face = smear_face_of(b->d, triangle, false);
    clip_and_project(&c, b, corner);
    const bool back = (c.area > 0) != b->d->mirrored;
    if (c.area == 0 || (back && !b->double_sided))
        return true;
    /* Which side is seen decides the light of vertices, and only the clipped polygon tells: the back is shaded and
     * clipped again. */
    if (!colored || back)
        c.face = smear_face_of(b->d, triangle, back);
    if (colored && back)
        clip_and_project(&c, b, corner);
    for (int i = 2; i < c.polygon.count; i++)
        if (!add_fan(b, &c, i))
            return false;
    return true;
}

/* ------------------------------------------------------------------ whole triangles */

/* A pixel that a triangle covers, and its edge functions there. */
struct covered {
    int32_t x, y, e1, e2;
};

/* Triangles of up to this many covered pixels become points, which are no larger than a triangle with vertices. */
enum { POINTS_MAX = 2, TINY_BOX = 2 };

/* Returns how many centres in the box the triangle covers, and lists the first POINTS_MAX of them. */
static inline int cover(struct covered out[POINTS_MAX], const struct tiny_edges *e, const struct box *box)
{
    int count = 0;
    int32_t row0 = e->e0, row1 = e->e1, row2 = e->e2;
    for (int32_t y = box->y0;;) {
        int32_t e0 = row0, e1 = row1, e2 = row2;
        for (int32_t x = box->x0;;) {
            if ((e0 | e1 | e2) >= 0) {
                if (count < POINTS_MAX)
                    out[count] = (struct covered){ x, y, e1, e2 };
                count++;
            }
            if (++x == box->x1)
                break;
            e0 += e->right0;
            e1 += e->right1;
            e2 += e->right2;
        }
        if (++y == box->y1)
            return count;
        row0 += e->down0;
        row1 += e->down1;
        row2 += e->down2;
    }
}

static SMEAR_NOINLINE uint32_t shade_face(const struct batch *b, uint32_t triangle, bool back)
{
    struct smear_face face = smear_face_of(b->d, triangle, back);
    return smear_face_color(b->d, b->segment, &face);
}

static inline uint32_t color_of_face(const struct batch *b, uint32_t triangle, bool back)
{
    if (b->face_color != NULL) {
        const uint8_t *c = b->face_color + 4 * triangle;
        return pixel_make(c[3], c[0], c[1], c[2]);
    }
    return b->segment->shade == SHADE_FLAT ? shade_face(b, triangle, back) : 0xffffffffu;
}

/* Stores a vertex; returns the first word of its record. */
static SMEAR_NOINLINE uint32_t store_vertex(const struct batch *b, const struct smear_cached_vertex *v,
                                            uint32_t triangle, bool back)
{
    const struct smear_assembly *d = b->d;
    const struct smear_segment *s = b->segment;
    const smear_mesh *mesh = d->mesh;
    struct smear_bins *g = b->a->bins;
    uint32_t word = g->vertex_words, index = index_of(v);
    uint32_t *record = g->pool + word;
    g->vertex_words = word + s->stride;
    store_place(record, &v->screen);
    if (segment_textured(s))
        store_uv(record + s->uv, mesh->uv[2 * index], mesh->uv[2 * index + 1]);
    if (SMEAR_WITH_GOURAUD && b->vertex_color != NULL) {      /* as smear_shade has it */
        const uint8_t *c = b->vertex_color + 4 * index;
        record[s->color] = (uint32_t)c[0] << 8 | (uint32_t)c[1] << 24;
        record[s->color + 1] = (uint32_t)c[2] << 8 | c[3] * 257u << 16;
    } else if (segment_colored(s)) {
        smear_vertex_store_color(record + s->color, d, index, triangle, back);
    }
    for (int pose = 0; pose < segment_moves(s); pose++) {
        struct smear_homogeneous h, now;
        pose_transform(&h, d, pose, index);
        store_motion(record + s->motion + pose * MOTION_WORDS, d, pose, &h, now_of(&now, d, v), &v->screen,
                     &b->a->viewport);
    }
    return word;
}

/* Returns the first word of the vertex's record, which it stores where that has not been done. */
static inline uint32_t stored_vertex(const struct batch *b, struct smear_cached_vertex *v, uint32_t triangle,
                                     bool back)
{
    /* Seen from behind, normals flip: such a vertex is not the one its front faces share. */
    bool shares = b->shares && (!back || !segment_by_vertices(b->segment));
    if (shares && v->stored > b->segment->base)
        return v->stored - 1;
    uint32_t word = store_vertex(b, v, triangle, back);
    if (shares)
        v->stored = word + 1;
    return word;
}

static SMEAR_RARE void add_points(struct batch *b, struct smear_cached_vertex *const v[3], uint32_t triangle,
                                  bool back, const struct covered covered[POINTS_MAX], int count, int32_t area)
{
    struct smear_bins *g = b->a->bins;
    const struct smear_segment *s = b->segment;
    const uint32_t *channels[3] = { NULL, NULL, NULL };
    uint32_t color = 0;
    if (!segment_colored(s))
        color = color_of_face(b, triangle, back);
    if (segment_by_vertices(s))
        for (int i = 0; i < 3; i++)
            channels[i] = g->pool + stored_vertex(b, v[i], triangle, back) + s->color;
    struct tiny_scale scale = tiny_scale_make(area);
    int32_t q0 = v[0]->screen.depth, q1 = v[1]->screen.depth, q2 = v[2]->screen.depth;
    for (int i = 0; i < count; i++) {
        const struct covered *p = &covered[i];
        uint32_t w1 = tiny_weight(scale, p->e1), w2 = tiny_weight(scale, p->e2);
        struct smear_triangle *t = bins_add(g, &g->opaque_last[bins_row(g, p->y)]);
        t->vertex[POINT_X] = (uint16_t)p->x;
        t->vertex[POINT_Y] = (uint16_t)p->y;
        t->vertex[POINT_DEPTH] = (uint16_t)tiny_depth(q0, q1, q2, w1, w2);
        t->segment = SMEAR_POINT;
        t->color = !segment_colored(s) ? color
                                       : tiny_color(channels[0], channels[1], channels[2], w1, w2,
                                                    shading_is_linear(&b->d->shading));
    }
}

/* Adds a triangle that lies within the guard band and is clockwise on the screen; with `cut`, it may reach beyond the
 * part of the frame that is being filled. Returns false when there is no room. */
static SMEAR_NOINLINE bool add_whole(struct batch *b, struct smear_cached_vertex *v0,
                                     struct smear_cached_vertex *v1, struct smear_cached_vertex *v2,
                                     uint32_t triangle, bool back, bool cut)
{
    struct box box = box_of(&v0->screen, &v1->screen, &v2->screen);
    bool tiny = box.x1 - box.x0 <= TINY_BOX && box.y1 - box.y0 <= TINY_BOX;
    if (cut)
        box_cut(&box, b->a);
    if (box_is_empty(&box) || !is_damaged(b->a, &box))
        return true;
    struct covered covered[POINTS_MAX];
    int count = POINTS_MAX + 1;
    int32_t area = 0;
    if (tiny) {
        int32_t x1 = v1->screen.x - v0->screen.x, y1 = v1->screen.y - v0->screen.y;
        int32_t x2 = v2->screen.x - v0->screen.x, y2 = v2->screen.y - v0->screen.y;
        struct tiny_edges e;
        area = x1 * y2 - x2 * y1;
        tiny_start(&e, v0->screen.x, v0->screen.y, x1, y1, x2, y2, area, box.x0, box.y0);
        count = cover(covered, &e, &box);
        if (count == 0)
            return true;
    }
    struct smear_segment *s = make_room(b->a, b->d, b->segment, POINTS_MAX);
    if (s == NULL)
        return false;
    b->segment = s;
    b->a->triangles_drawn++;
    if (count <= POINTS_MAX && b->points
        && (!segment_by_vertices(s) || segment_flat_depth(s)
            || tiny_is_even(v0->screen.depth, v1->screen.depth, v2->screen.depth))) {
        struct smear_cached_vertex *const v[3] = { v0, v1, v2 };
        add_points(b, v, triangle, back, covered, count, area);
        return true;
    }
    struct smear_bins *g = b->a->bins;
    uint32_t base = s->base;
    uint16_t offset0 = (uint16_t)(stored_vertex(b, v0, triangle, back) - base);
    uint16_t offset1 = (uint16_t)(stored_vertex(b, v1, triangle, back) - base);
    uint16_t offset2 = (uint16_t)(stored_vertex(b, v2, triangle, back) - base);
    struct smear_triangle *t = bins_add(g, row_list(g, b->d, bins_row(g, box.y0)));
    t->vertex[0] = offset0;
    t->vertex[1] = offset1;
    t->vertex[2] = offset2;
    t->segment = (uint16_t)(s - g->segment);
    t->color = color_of_face(b, triangle, back);
    return true;
}

/* Transforms and projects a vertex. */
static inline void find_vertex(const struct smear_assembler *a, const struct smear_assembly *d,
                               struct smear_cached_vertex *v, uint32_t tag)
{
#if SMEAR_FAST_STACK
    struct smear_homogeneous passing, *now = &passing;
#else
    struct smear_homogeneous *now = &v->now;
#endif
    v->tag = tag;
    v->stored = 0;
    v->outcode = placement_project(&v->screen, now, &d->at, tag & 0xffffu, &a->viewport);
}

#ifndef __OPTIMIZE_SIZE__
/* Finds all vertices of a mesh that the cache has room for: one after the other they cost less. */
static SMEAR_NOINLINE void find_all(const struct smear_assembler *a, const struct smear_assembly *d,
                                    uint32_t tag)
{
    struct smear_cached_vertex *v = a->cache;
    for (const uint32_t end = tag + d->mesh->vertex_count; tag != end; tag++, v++)
        find_vertex(a, d, v, tag);
}
#endif

/* Transforms a vertex that is not in the cache. An index that the mesh does not have gives OUT_UNKNOWN. */
static SMEAR_NOINLINE struct smear_cached_vertex *miss(const struct smear_assembler *a,
                                                       const struct smear_assembly *d, uint32_t tag,
                                                       const struct smear_cached_vertex *in_use1,
                                                       const struct smear_cached_vertex *in_use2,
                                                       struct smear_cached_vertex *spare)
{
    struct smear_cached_vertex *v = &a->cache[tag & a->cache_mask];
    if ((tag & 0xffffu) >= d->mesh->vertex_count) {
        spare->outcode = OUT_UNKNOWN;
        return spare;
    }
    /* An entry that this triangle already uses for another vertex must not be overwritten. */
    if (v == in_use1 || v == in_use2)
        v = spare;
    find_vertex(a, d, v, tag);
    return v;
}

static void batch_start(struct batch *b)
{
    const struct smear_assembler *a = b->a;
    const struct smear_assembly *d = b->d;
    const struct smear_segment *s = b->segment;
    const smear_mesh *mesh = d->mesh;
    const struct smear_bins *g = a->bins;
    b->shares = shares_vertices(d, s);
    b->partial = g->row_first != 0 || g->row_end * g->row_px < a->viewport.height;
    b->points = d->material->alpha == SMEAR_OPAQUE && !segment_textured(s) && segment_moves(s) == 0 && !d->fixed;
    b->double_sided = d->material->double_sided;
    if (d->shading.lit || !d->shading.white)
        return;
    if (s->shade == SHADE_FLAT && mesh->color == NULL)
        b->face_color = mesh->face_color;
    if (segment_colored(s) && !shading_is_linear(&d->shading) && mesh->face_color == NULL)
        b->vertex_color = mesh->color;
}

/* Adds a triangle if it may be seen; its vertices are clockwise on the screen where its front is. Returns false where
 * there is no room. */
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
        return add_clipped(b, corner, triangle);
    }
    const int64_t area = area_of(&v0->screen, &v1->screen, &v2->screen);
    if (area > 0)
        return add_whole(b, v0, v1, v2, triangle, false, any != 0 || b->partial);
    return area == 0 || !b->double_sided || add_whole(b, v0, v2, v1, triangle, true, any != 0 || b->partial);
}

bool smear_assemble(struct smear_assembler *a, const struct smear_assembly *d, bool drop)
{
    const smear_mesh *mesh = d->mesh;
    struct batch b = { .a = a, .d = d, .segment = smear_vertex_segment(a, d) };
    if (b.segment == NULL) {
        if (drop)
            a->triangles_dropped += mesh->triangle_count;
        return drop;
    }
    batch_start(&b);
    if (a->serial == 0xffffu || a->cache_has_paths)
        forget_all(a);
    uint32_t tag = ++a->serial << 16;
    struct smear_cached_vertex spare[3];
    struct smear_cached_vertex *const cache = a->cache;
    const uint32_t mask = a->cache_mask;
    /* Vertices are taken in the order that is clockwise on the screen for front faces. */
    const int second = d->mirrored ? 1 : 2, third = 3 - second;
    const uint16_t *index = mesh->index;
#ifndef __OPTIMIZE_SIZE__
    if (mesh->vertex_count <= mask + 1u)
        find_all(a, d, tag);
#endif

    for (uint32_t i = 0; i < mesh->triangle_count; i++, index += 3) {
        uint32_t tag0 = tag | index[0], tag1 = tag | index[second], tag2 = tag | index[third];
        struct smear_cached_vertex *v0 = cache + (tag0 & mask), *v1 = cache + (tag1 & mask);
        struct smear_cached_vertex *v2 = cache + (tag2 & mask);
        if (v0->tag != tag0)
            v0 = miss(a, d, tag0, NULL, NULL, &spare[0]);
        if (v1->tag != tag1)
            v1 = miss(a, d, tag1, v0, NULL, &spare[1]);
        if (v2->tag != tag2)
            v2 = miss(a, d, tag2, v0, v1, &spare[2]);
        if (!add_triangle(&b, v0, v1, v2, i)) {
            if (!drop)
                return false;
            a->triangles_dropped++;
        }
    }
    return true;
}
