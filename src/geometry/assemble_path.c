/* SPDX-License-Identifier: MIT */
/* assemble_path.c - the loop over a moving draw's triangles: as assemble.c, at three instants at once.
 *
 * A triangle is kept if it may be seen at any time of the exposure. It is listed under the first tile row that it may
 * touch, together with the bounds of its path (struct smear_path_bounds): all that a tile needs to choose its
 * method. */
#include "geometry/assemble_path.h"

#include "geometry/clip.h"
#include "geometry/path.h"
#include "geometry/path_places.h"

#if SMEAR_WITH_SUBFRAMES

static int code_at(uint32_t outcodes, int key)
{
    return (int)(outcodes >> 8 * key & 255u);
}

static void find_vertex(struct path_vertex *v, const struct smear_assembler *a,
                        const struct smear_assembly *d, uint32_t tag)
{
    struct smear_homogeneous h;
    v->tag = tag;
    v->stored = 0;
    v->outcodes = 0;
    for (int key = 0; key < KEYS; key++)
        v->outcodes |= (uint32_t)placement_project(&v->screen[key], &h, placement_of(d, key), tag & 0xffffu,
                                                   &a->viewport) << 8 * key;
}

/* ------------------------------------------------------------------ bounds */

static uint16_t sixteenths(int32_t q8)
{
    return (uint16_t)min_i32((q8 + 15) >> 4, 65535);
}

/* Returns the depth code of units q11, rounded up. */
static uint16_t code_above(int32_t depth)
{
    uint32_t units = ((uint32_t)depth >> 11) + 1u;
    return (uint16_t)(units < 32768u ? units : min_u32(32768u + ((units - 32768u) >> 4) + 1u, 65535u));
}

/* Finds a triangle's bounds. Returns false when it can't cover a pixel of the part of the frame that is being
 * filled. */
static bool find_bounds(struct smear_path_bounds *b, const struct smear_assembler *a,
                        const struct smear_assembly *d, const struct smear_screen *const corner[3])
{
    int32_t x0 = INT32_MAX, x1 = INT32_MIN, y0 = INT32_MAX, y1 = INT32_MIN, depth = 0, overshoot = 0,
            travel = 0, curvature = 0;
    for (int i = 0; i < 3; i++) {
        const struct smear_screen *p = corner[i];
        for (int key = 0; key < KEYS; key++) {
            x0 = min_i32(x0, p[key].x);
            x1 = max_i32(x1, p[key].x);
            y0 = min_i32(y0, p[key].y);
            y1 = max_i32(y1, p[key].y);
            depth = max_i32(depth, p[key].depth);
        }
        /* Halved; below zero the parabola may peak between its places, by at most an eighth of the whole. */
        int32_t dip = p[MIDDLE].depth - (int32_t)(((uint32_t)p[OPEN].depth + (uint32_t)p[CLOSE].depth) >> 1);
        overshoot = max_i32(overshoot, dip >> 2);
        int32_t dx = abs_i32(p[CLOSE].x - p[OPEN].x), dy = abs_i32(p[CLOSE].y - p[OPEN].y);
        travel = max_i32(travel, max_i32(dx, dy) + (min_i32(dx, dy) >> 1));
        curvature = max_i32(curvature, abs_i32(p[OPEN].x + p[CLOSE].x - 2 * p[MIDDLE].x));
        curvature = max_i32(curvature, abs_i32(p[OPEN].y + p[CLOSE].y - 2 * p[MIDDLE].y));
    }
    /* A parabola leaves the box of its three places by at most an eighth of the curvature. */
    int32_t margin = (curvature >> 3) + bins_margin(a->bins) * 256;
    struct box box = { (x0 - margin + 127) >> 8, (y0 - margin + 127) >> 8, (x1 + margin + 128 + 127) >> 8,
                       (y1 + margin + 128 + 127) >> 8 };
    /* Of the whole frame, so that it is the same in every part. */
    const bool large = min_i32(box.x1, a->viewport.width) - max_i32(box.x0, 0) > PATH_LARGE_PX
                    || min_i32(box.y1, a->viewport.height) - max_i32(box.y0, 0) > PATH_LARGE_PX;
    box_cut(&box, a);
    if (box_is_empty(&box) || (!is_blend(d) && (box.x0 >= a->path_x1 || box.x1 <= a->path_x0)))
        return false;
    *b = (struct smear_path_bounds){
        .x0 = (int16_t)box.x0, .y0 = (int16_t)box.y0, .x1 = (int16_t)box.x1, .y1 = (int16_t)box.y1,
        .travel = sixteenths(travel), .curvature = sixteenths(curvature),
        .nearest = code_above(min_i32(depth + overshoot, SMEAR_DEPTH_MAX)),
        .flags = (uint8_t)((d->material->texture != NULL && d->mesh->uv != NULL ? PATH_TEXTURED : 0)
                            | (SMEAR_WITH_ALPHA && d->material->alpha != SMEAR_OPAQUE ? PATH_SUBFRAMES : 0)
                            | (large ? PATH_LARGE : 0))
    };
    return true;
}

/* ------------------------------------------------------------------ records */

static void store_path(uint32_t *record, const struct smear_segment *s,
                       const struct smear_screen screen[KEYS])
{
    store_place(record, &screen[MIDDLE]);
    store_place(record + s->motion, &screen[OPEN]);
    store_place(record + s->motion + PATH_POSE_WORDS, &screen[CLOSE]);
}

/* What the loop over a draw's triangles needs for each of them. */
struct path_batch {
    struct smear_assembler *a;
    struct smear_assembly *d;
    struct smear_segment *segment;      /* the newest */
    bool shares;                        /* all faces of a vertex share its record */
    uint16_t parts;                     /* of the triangle at hand: those that have been added, now or before */
    uint16_t parts_before;              /* before: they are left out */
};

static uint32_t store_path_vertex(const struct path_batch *b, struct path_vertex *v, uint32_t triangle,
                                  bool back)
{
    const struct smear_assembly *d = b->d;
    const struct smear_segment *s = b->segment;
    bool shares = b->shares && (!back || !segment_by_vertices(s));
    if (shares && v->stored > s->base)
        return v->stored - 1;
    struct smear_bins *g = b->a->bins;
    uint32_t word = g->vertex_words, index = v->tag & 0xffffu;
    uint32_t *record = g->pool + word;
    g->vertex_words = word + s->stride;
    store_path(record, s, v->screen);
    if (segment_textured(s))
        store_uv(record + s->uv, d->mesh->uv[2 * index], d->mesh->uv[2 * index + 1]);
    if (segment_colored(s))
        smear_vertex_store_color(record + s->color, d, index, triangle, back);
    if (shares)
        v->stored = word + 1;
    return word;
}

/* Whether no vertex moves, not even by a step (q8 px). */
static bool is_static(const struct smear_path_bounds *bounds)
{
    return bounds->travel + bounds->curvature == 0;
}

static uint32_t *list_of(const struct path_batch *b, const struct smear_path_bounds *bounds)
{
    struct smear_bins *g = b->a->bins;
    uint32_t *list = is_blend(b->d) ? g->blend_last : is_static(bounds) ? g->opaque_last : g->moving_last;
    return &list[bins_row(g, bounds->y0)];
}

/* Whether the next part of the triangle has been added already. */
static bool is_added(struct path_batch *b)
{
    const bool added = b->parts < b->parts_before;
    b->parts = (uint16_t)(b->parts + added);
    return added;
}

static bool has_room(struct path_batch *b)
{
    struct smear_segment *s = make_room(b->a, b->d, b->segment, 2);
    if (s == NULL || b->a->path_count == b->a->path_limit)
        return false;
    b->segment = s;
    return true;
}

/* Marks the tiles in which a triangle is seen at some time. */
static void mark_tiles(const struct smear_damaged_tiles *d, const struct smear_path_bounds *b)
{
    const struct smear_tile_box box = tile_box_of(d, b->x0, b->x1, b->y0, b->y1);
    for (int row = box.y0; row <= box.y1; row++)
        for (int column = box.x0; column <= box.x1; column++)
            tile_mark(&d->tile[row * (d->columns + 1) + column]);
}

/* Adds a triangle to its list. There must be room. */
static void list_triangle(struct path_batch *b, struct smear_path_bounds *bounds, const uint16_t vertex[3],
                          const struct smear_face *face)
{
    struct smear_bins *g = b->a->bins;
    const int32_t *record[3];
    for (int i = 0; i < 3; i++)
        record[i] = bins_vertex(g, b->segment, vertex[i]);
    uint32_t color = smear_face_color(b->d, b->segment, face);
    if (smear_vertex_flat_color(&color, b->segment, record, b->d->shading.linear))
        bounds->flags |= PATH_FLAT;
    struct smear_triangle *t = bins_add_path(g, list_of(b, bounds), bounds);
    for (int i = 0; i < 3; i++)
        t->vertex[i] = vertex[i];
    t->segment = (uint16_t)(b->segment - g->segment);
    t->color = color;
    b->parts++;
    b->a->path_count++;
    b->a->path_static_count += is_static(bounds);
    if (assembler_has_damage(b->a))
        mark_tiles(b->a->damaged, bounds);
    b->a->triangles_drawn++;
}

/* Adds a triangle whose vertices are clockwise on the screen where it is seen from the side that is drawn. Returns
 * false where there is no room. */
static bool add_triangle(struct path_batch *b, struct path_vertex *v0, struct path_vertex *v1,
                         struct path_vertex *v2, uint32_t triangle, bool back)
{
    const struct smear_screen *const corner[3] = { v0->screen, v1->screen, v2->screen };
    struct smear_path_bounds bounds;
    if (!find_bounds(&bounds, b->a, b->d, corner) || is_added(b))
        return true;
    if (!has_room(b))
        return false;
    uint32_t base = b->segment->base;
    uint16_t offset0 = (uint16_t)(store_path_vertex(b, v0, triangle, back) - base);
    uint16_t offset1 = (uint16_t)(store_path_vertex(b, v1, triangle, back) - base);
    uint16_t offset2 = (uint16_t)(store_path_vertex(b, v2, triangle, back) - base);
    struct smear_face face = smear_face_of(b->d, triangle, back);
    const uint16_t offset[3] = { offset0, offset1, offset2 };
    list_triangle(b, &bounds, offset, &face);
    return true;
}

/* ------------------------------------------------------------------ clipped */

/* A triangle while it is clipped. It is large and lies on the stack: there is one, and all ways to clip work on it. */
struct clipping {
    struct smear_clip_polygon polygon;      /* vertex[0 .. 2] are the triangle's own, in the mesh's order */
    /* What it is clipped against: the exposure, or one of PATH_INTERVALS parts of it. */
    struct smear_depths depths[KEYS];
    int codes[KEYS];
    uint8_t interval;                       /* as in struct smear_path_bounds */
    struct smear_face face;
};

static struct smear_homogeneous *place_at(struct smear_clip_vertex *v, int key)
{
    return key == MIDDLE ? &v->now : &v->pose[key];
}

/* Exchanges the present pose, which is the one that is clipped, with another one. */
static void exchange(struct smear_clip_polygon *p, int key)
{
    for (int i = 0; i < p->count; i++) {
        struct smear_clip_vertex *v = clip_corner(p, i);
        struct smear_homogeneous h = v->now;
        v->now = v->pose[key];
        v->pose[key] = h;
    }
}

/* Clips to what is in front of the near plane and within the guard band at all three instants. */
static void clip_all(struct clipping *c)
{
    struct smear_clip_polygon *p = &c->polygon;
    smear_clip_polygon(p, &c->depths[MIDDLE], c->codes[MIDDLE]);
    for (int key = OPEN; key <= CLOSE && p->count != 0; key++) {
        exchange(p, key);
        smear_clip_polygon(p, &c->depths[key], c->codes[key] & ~OUT_FAR);
        exchange(p, key);
    }
}

/* Divides what is left. Places on the screen take the room of those before the division: x, y, and depth for w. The distance in
 * the middle becomes the corner's record in the pool: word + 1, or 0. */
static void project_corners(struct clipping *c, const struct smear_viewport *viewport)
{
    for (int i = 0; i < c->polygon.count; i++) {
        struct smear_clip_vertex *v = clip_corner(&c->polygon, i);
        for (int key = 0; key < KEYS; key++) {
            struct smear_homogeneous *h = place_at(v, key);
            struct smear_screen screen;
            smear_project(&screen, &c->depths[key], h, viewport);
            screen_clamp(&screen, viewport);
            *h = (struct smear_homogeneous){ screen.x, screen.y, screen.depth, 0 };
        }
    }
}

static struct smear_screen screen_at(struct clipping *c, int corner, int key)
{
    const struct smear_homogeneous *h = place_at(clip_corner(&c->polygon, corner), key);
    return (struct smear_screen){ h->x, h->y, h->w };
}

static int64_t area_at(struct clipping *c, int i, int k, int key)
{
    const struct smear_screen p0 = screen_at(c, 0, key), p1 = screen_at(c, i, key), p2 = screen_at(c, k, key);
    return area_of(&p0, &p1, &p2);
}

static uint32_t store_corner(const struct path_batch *b, struct smear_clip_vertex *v, const struct smear_screen screen[KEYS])
{
    struct smear_bins *g = b->a->bins;
    const struct smear_segment *s = b->segment;
    const uint32_t stored = (uint32_t)v->now.distance;
    if (stored > s->base)
        return stored - 1;
    uint32_t word = g->vertex_words, *record = g->pool + word;
    g->vertex_words = word + s->stride;
    v->now.distance = (int32_t)(word + 1);
    store_path(record, s, screen);
    smear_vertex_store_clipped(record, s, v);
    return word;
}

/* Adds one triangle of the fan, whose corners are clockwise when it is seen from its side. Returns false where there is
 * no room. */
static bool add_fan(struct path_batch *b, struct clipping *c, const int fan[3])
{
    struct smear_screen screen[3][KEYS];
    for (int i = 0; i < 3; i++)
        for (int key = 0; key < KEYS; key++)
            screen[i][key] = screen_at(c, fan[i], key);
    const struct smear_screen *const corner[3] = { screen[0], screen[1], screen[2] };
    struct smear_path_bounds bounds;
    if (!find_bounds(&bounds, b->a, b->d, corner))
        return true;
    /* Rounding may turn over a sliver of the fan: at instants that is seen, among what is static it is not. */
    if (is_static(&bounds) && area_of(&corner[0][MIDDLE], &corner[1][MIDDLE], &corner[2][MIDDLE]) <= 0)
        return true;
    if (is_added(b))
        return true;
    if (!has_room(b))
        return false;
    bounds.interval = c->interval;
    if (c->interval != 0) {
        bounds.flags |= PATH_INTERVAL;
        /* The travel counts for the whole exposure. */
        bounds.travel = (uint16_t)min_i32(bounds.travel * PATH_INTERVALS, 65535);
    }
    const struct smear_segment *s = b->segment;
    uint16_t offset[3];
    for (int k = 0; k < 3; k++)
        offset[k] = (uint16_t)(store_corner(b, clip_corner(&c->polygon, fan[k]), corner[k]) - s->base);
    list_triangle(b, &bounds, offset, &c->face);
    return true;
}

/* Clips the triangle and adds what is left, if it is seen from the side that is drawn (c->face.back: counter-clockwise) at some
 * instant. Returns false where there is no room. */
static bool add_cut(struct path_batch *b, struct clipping *c)
{
    const struct smear_assembly *d = b->d;
    smear_clip_start(&c->polygon, CLIP_POSES, segment_textured(b->segment), segment_colored(b->segment));
    clip_all(c);
    project_corners(c, &b->a->viewport);
    const int count = c->polygon.count;
    bool seen = false;
    for (int key = 0; key < KEYS && !seen; key++) {
        int64_t area = 0;
        for (int i = 2; i < count; i++)
            area += area_at(c, i - 1, i, key);
        seen = ((area > 0) != d->mirrored) == c->face.back && area != 0;
    }
    if (!seen)
        return true;
    bool turn = d->mirrored == c->face.back;    /* the fan runs against the clock on the side that is drawn */
    for (int i = 2; i < count; i++) {
        const int fan[3] = { 0, turn ? i : i - 1, turn ? i - 1 : i };
        if (!add_fan(b, c, fan))
            return false;
    }
    return true;
}

/* Brings planes and depths to fewer bits of scale, as vertices are. */
static void lower_scale(struct smear_depths *d, int down)
{
    d->depth_shift = (int16_t)(d->depth_shift - down);
    d->near_distance = max_i32(scale_sat(d->near_distance, clamp_i32(-down, -31, 31)), 1);
    if (d->far_distance != INT32_MAX)
        d->far_distance = scale_sat(d->far_distance, clamp_i32(-down, -31, 31));
}

/* Returns a coordinate at time u (q16, -1 .. 1) of the path from open over middle to close. */
static int32_t on_path(int64_t open, int64_t middle, int64_t close, int32_t u)
{
    int64_t along = (close - open) + ((open + close - 2 * middle) * u >> 16);
    return (int32_t)(middle + (along * u >> 17));
}

/* Places `out` on the path of `v`. */
static void place_on_path(struct smear_homogeneous *out, const struct smear_clip_vertex *v, int32_t u)
{
    const struct smear_homogeneous *open = &v->pose[OPEN], *middle = &v->now, *close = &v->pose[CLOSE];
    out->x = on_path(open->x, middle->x, close->x, u);
    out->y = on_path(open->y, middle->y, close->y, u);
    out->w = on_path(open->w, middle->w, close->w, u);
    out->distance = out->w;
}

static void scale_homogeneous(struct smear_homogeneous *h, int down)
{
    h->x = scale_sat(h->x, clamp_i32(-down, -31, 31));
    h->y = scale_sat(h->y, clamp_i32(-down, -31, 31));
    h->w = scale_sat(h->w, clamp_i32(-down, -31, 31));
}

/* Adds a triangle that the near plane cuts at some instants, each time elsewhere: what is in front of the plane
 * throughout would be too little. In a short interval of the exposure that is about what is in front in its middle; at
 * its ends a little of that may lie behind, though not behind the eye. */
static SMEAR_NOINLINE bool add_intervals(struct path_batch *b, struct clipping *c)
{
    const struct smear_assembly *d = b->d;
    struct smear_clip_vertex corner[3];
    /* One scale for all poses, with two bits of room: parabolas leave the range of their three places. */
    const int16_t own[KEYS] = { d->motion.key[OPEN].now.scale, d->motion.key[CLOSE].now.scale, d->at.now.scale };
    const int scale = min_i32(own[MIDDLE], min_i32(own[OPEN], own[CLOSE])) - 2;
    for (int i = 0; i < 3; i++) {
        corner[i] = c->polygon.vertex[i];
        for (int k = 0; k < KEYS; k++)
            scale_homogeneous(place_at(&corner[i], k), own[k] - scale);
    }
    lower_scale(&c->depths[MIDDLE], own[MIDDLE] - scale);
    c->depths[OPEN] = c->depths[CLOSE] = c->depths[MIDDLE];
    for (int key = OPEN; key <= CLOSE; key++)
        c->depths[key].near_distance = max_i32(c->depths[MIDDLE].near_distance >> 2, 1);
    for (int k = 0; k < KEYS; k++)
        c->codes[k] = OUT_NEAR | OUT_GUARD | OUT_FAR;
    const int32_t step = 131072 / PATH_INTERVALS;
    for (int interval = 0; interval < PATH_INTERVALS; interval++) {
        int32_t begin = interval * step - 65536;
        for (int i = 0; i < 3; i++) {
            struct smear_clip_vertex *part = &c->polygon.vertex[i];
            *part = corner[i];
            place_on_path(&part->pose[OPEN], &corner[i], begin);
            place_on_path(&part->now, &corner[i], begin + step / 2);
            place_on_path(&part->pose[CLOSE], &corner[i], begin + step);
        }
        c->interval = (uint8_t)(interval + 1);
        if (!add_cut(b, c))
            return false;
    }
    return true;
}

/* ------------------------------------------------------------------ near the near plane */

/* The ground under a camera passes through the near plane, but beside the frame. What is nearer
 * than some distance then need not be drawn, and the rest is clipped once, for all instants: its
 * corners are places of the surface like any vertex. */

/* Finds where the triangle's vertices are at the three instants. */
static void place_corners(struct smear_clip_vertex corner[3], const struct smear_assembly *d,
                          const uint16_t index[3])
{
    for (int i = 0; i < 3; i++) {
        placement_transform(&corner[i].now, &d->at, index[i]);
        for (int key = OPEN; key <= CLOSE; key++)
            placement_transform(&corner[i].pose[key], &d->motion.key[key], index[i]);
    }
}

/* Returns the distance from which on all of the triangle is in front of the near plane at all times: that of the plane
 * plus the longest travel towards it. */
static int32_t safe_distance(const struct smear_clip_vertex corner[3], const struct smear_assembly *d)
{
    const struct smear_projection *now = &d->at.now;
    int64_t travel = 0;
    for (int key = OPEN; key <= CLOSE; key++)
        for (int i = 0; i < 3; i++) {
            const int up = clamp_i32(now->scale - d->motion.key[key].now.scale, -31, 31);
            const int64_t there = up < 0 ? corner[i].pose[key].w >> -up
                                         : (int64_t)corner[i].pose[key].w * ((int64_t)1 << up);
            travel = corner[i].now.w - there > travel ? corner[i].now.w - there : travel;
        }
    const int64_t safe = travel + now->depths.near_distance + 8;
    return safe < 1 << 28 ? (int32_t)safe : 1 << 28;
}

/* Whether all of the polygon lies beyond one side of the frame at the three instants, and so at all times: places
 * between are sums of those. */
static bool is_beside(struct smear_clip_polygon *p, const struct smear_viewport *viewport)
{
    int beside = OUT_LEFT | OUT_RIGHT | OUT_TOP | OUT_BOTTOM;
    for (int i = 0; i < p->count && beside != 0; i++) {
        struct smear_clip_vertex *v = clip_corner(p, i);
        for (int key = 0; key < KEYS; key++)
            beside &= smear_outcode_behind(place_at(v, key), viewport);
    }
    return beside != 0;
}

/* Whether nothing of the triangle p->vertex[0 .. 2] that is nearer than `distance` in the middle of the exposure is seen at any
 * time. One plane leaves these vertices as they are: new corners lie behind them. */
static bool is_apart(struct smear_clip_polygon *p, const struct path_batch *b, int32_t distance)
{
    struct smear_depths behind = b->d->at.now.depths;
    behind.far_distance = distance;
    smear_clip_start(p, CLIP_POSES, false, false);
    smear_clip_polygon(p, &behind, OUT_FAR);
    return is_beside(p, &b->a->viewport);
}

static bool is_behind(const struct smear_placement *p, uint32_t index)
{
    struct smear_homogeneous h;
    if (p->extra_count == 0)
        return transform_row(p->now.m[2], p->position + 3 * index) < p->now.depths.near_distance;
    placement_transform(&h, p, index);
    return h.w < p->now.depths.near_distance;
}

/* Whether the near plane cuts the triangle, or passes it during the exposure. */
static bool passes_near(const struct path_batch *b, const uint16_t index[3])
{
    const struct path_vertex *cache = (const struct path_vertex *)(const void *)b->a->cache;
    int behind = 0;
    for (int i = 0; i < 3; i++) {
        const uint32_t tag = b->a->serial << 16 | index[i];
        const struct path_vertex *v = &cache[tag & (b->a->cache_mask >> 1)];
        for (int key = 0; key < KEYS; key++)
            behind += v->tag == tag ? (code_at(v->outcodes, key) & OUT_NEAR) != 0
                                    : is_behind(placement_of(b->d, key), index[i]);
    }
    return behind != 0 && behind != 3 * KEYS;
}

/* Finds one distance for all triangles of a draw, so that their edges still meet: the largest of DOUBLINGS + 1 for
 * which is_apart() holds for all triangles but those for which it never does. Works on *p. */
static SMEAR_NOINLINE int32_t find_apart(const struct path_batch *b, struct smear_clip_polygon *p)
{
    enum { DOUBLINGS = 5 };
    const smear_mesh *mesh = b->d->mesh;
    int32_t least = 0;
    int doublings = DOUBLINGS;
    uint32_t first = 0, end = mesh->triangle_count;         /* the triangles that pass the near plane lie between */
    for (int pass = 0; pass < 2; pass++) {
        uint32_t last = first;
        for (uint32_t i = first; i < end; i++) {
            const uint16_t *index = mesh->index + 3 * i;
            if (max_i32(index[0], max_i32(index[1], index[2])) >= (int32_t)mesh->vertex_count)
                continue;
            if (!passes_near(b, index))
                continue;
            place_corners(p->vertex, b->d, index);
            last = i;
            if (pass == 0) {
                first = least == 0 ? i : first;
                least = max_i32(least, safe_distance(p->vertex, b->d));
                continue;
            }
            int here = doublings;
            while (here >= 0 && ((least >> (29 - here)) != 0 || !is_apart(p, b, least << here)))
                here--;
            doublings = here >= 0 ? here : doublings;
        }
        end = last + 1;
    }
    while (doublings > 0 && (least >> (29 - doublings)) != 0)       /* where it holds for no triangle */
        doublings--;
    return least << doublings;
}

/* Adds a triangle that has to be clipped at some instant; its vertices are in the mesh's own order: counter-clockwise
 * where its front is seen. Returns false where there is no room. */
static SMEAR_NOINLINE bool add_clipped_path(struct path_batch *b, struct path_vertex *const vertex[3],
                                            uint32_t triangle, uint32_t codes, bool back)
{
    struct smear_assembly *d = b->d;
    struct clipping c;
    int near_codes = 0;
    for (int key = 0; key < KEYS; key++) {
        c.codes[key] = code_at(codes, key);
        c.depths[key] = placement_of(d, key)->now.depths;
        near_codes |= c.codes[key] & OUT_NEAR;
    }
    const bool passes = near_codes != 0 && !is_orthographic(&d->at.now);
    if (passes && d->apart == 0)
        d->apart = find_apart(b, &c.polygon);
    c.interval = 0;
    c.face = smear_face_of(d, triangle, back);
    struct smear_clip_vertex *corner = c.polygon.vertex;
    const uint16_t index[3] = { (uint16_t)vertex[0]->tag, (uint16_t)vertex[1]->tag, (uint16_t)vertex[2]->tag };
    place_corners(corner, d, index);
    for (int i = 0; i < 3; i++)
        smear_vertex_for_clipping(&corner[i], d, b->segment, index[i], &c.face);
    if (!passes)
        return add_cut(b, &c);
    if (safe_distance(corner, d) > d->apart || !is_apart(&c.polygon, b, d->apart))
        return add_intervals(b, &c);
    c.depths[MIDDLE].near_distance = d->apart;
    for (int key = 0; key < KEYS; key++)
        c.codes[key] = (c.codes[key] & ~OUT_NEAR) | OUT_GUARD;
    c.codes[MIDDLE] |= OUT_NEAR;
    return add_cut(b, &c);
}

/* ------------------------------------------------------------------ the loop */

/* Opens the cache, which shares its memory with the other one: what that one wrote is no vertex of this one. */
static struct path_vertex *open_cache(struct smear_assembler *a, uint32_t *mask)
{
    struct path_vertex *cache = (struct path_vertex *)(void *)a->cache;
    *mask = a->cache_mask >> 1;
    if (!a->cache_has_paths || a->serial == 0xffffu) {
        for (uint32_t i = 0; i <= *mask; i++)
            cache[i].tag = 0;
        a->serial = 0;
        a->cache_has_paths = true;
    }
    return cache;
}

static struct path_vertex *look_up(struct path_vertex *cache, uint32_t mask, const struct smear_assembler *a,
                                   const struct smear_assembly *d, uint32_t tag,
                                   const struct path_vertex *in_use1, const struct path_vertex *in_use2,
                                   struct path_vertex *spare, struct path_places *places)
{
    struct path_vertex *v = &cache[tag & mask];
    if (v->tag == tag)
        return v;
    if ((tag & 0xffffu) >= d->mesh->vertex_count) {
        spare->outcodes = OUT_UNKNOWN;
        return spare;
    }
    if (v == in_use1 || v == in_use2)       /* this triangle still needs it */
        v = spare;
    if (!path_places_take(v, places, tag))
        find_vertex(v, a, d, tag);
    return v;
}

static bool add_seen(struct path_batch *b, struct path_vertex *const v[3], uint32_t triangle)
{
    const struct smear_assembly *d = b->d;
    const uint32_t codes = v[0]->outcodes | v[1]->outcodes | v[2]->outcodes;
    if (codes != 0) {
        const uint32_t shared = v[0]->outcodes & v[1]->outcodes & v[2]->outcodes;
        const uint32_t any = codes | codes >> 8 | codes >> 16;
        if (shared & shared >> 8 & shared >> 16 & OUT_REJECT)
            return true;
        if (any & OUT_UNKNOWN) {
            b->a->triangles_dropped++;
            return true;
        }
        if (any & OUT_CLIP)
            return add_clipped_path(b, v, triangle, codes, false)
                && (!d->material->double_sided || add_clipped_path(b, v, triangle, codes, true));
    }
    /* Which sides are seen at some instant; a side that is not drawn counts as seen. */
    bool front = false, behind = !d->material->double_sided;
    struct path_vertex *v1 = v[d->mirrored ? 1 : 2], *v2 = v[d->mirrored ? 2 : 1];
    for (int key = 0; key < KEYS && !(front && behind); key++) {
        int64_t area = area_of(&v[0]->screen[key], &v1->screen[key], &v2->screen[key]);
        front = front || area > 0;
        behind = behind || area < 0;
    }
    return (!front || add_triangle(b, v[0], v1, v2, triangle, false))
        && (!behind || !d->material->double_sided || add_triangle(b, v[0], v2, v1, triangle, true));
}

bool smear_assemble_path(struct smear_assembler *a, struct smear_assembly *d)
{
    struct path_batch b = { .a = a, .d = d, .segment = smear_vertex_segment(a, d) };
    if (b.segment == NULL)
        return false;
    b.shares = shares_vertices(d, b.segment);
    uint32_t mask;
    struct path_vertex *cache = open_cache(a, &mask), spare[3];
    uint32_t tag = ++a->serial << 16;
    struct path_places places;
    path_places_open(&places, a, d);
    const uint32_t first = max_u32(d->first, a->resume.triangle);
    const uint16_t *index = d->mesh->index + 3 * first;
#ifndef __OPTIMIZE_SIZE__
    /* One after the other they cost less. */
    if (d->mesh->vertex_count <= mask + 1u && first == 0 && d->end == d->mesh->triangle_count)
        for (uint32_t i = 0; i < d->mesh->vertex_count; i++)
            if (!path_places_take(&cache[i], &places, tag + i))
                find_vertex(&cache[i], a, d, tag + i);
#endif
    for (uint32_t i = first; i < d->end; i++, index += 3) {
        struct path_vertex *v[3];
        v[0] = look_up(cache, mask, a, d, tag | index[0], NULL, NULL, &spare[0], &places);
        v[1] = look_up(cache, mask, a, d, tag | index[1], v[0], NULL, &spare[1], &places);
        v[2] = look_up(cache, mask, a, d, tag | index[2], v[0], v[1], &spare[2], &places);
        b.parts = 0;
        b.parts_before = (uint16_t)parts_before(a, i);
        if (!add_seen(&b, v, i)) {
            a->resume = (struct smear_resume){ i, b.parts };
            return false;
        }
    }
    a->resume = (struct smear_resume){ 0, 0 };
    return true;
}

#endif
