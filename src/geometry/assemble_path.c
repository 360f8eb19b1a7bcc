/* SPDX-License-Identifier: MIT */
/* assemble_path.c - the loop over a moving draw's triangles: as assemble.c, at three instants at once.
 *
 * A triangle is kept if it may be seen at any time of the exposure. It is listed under the first tile row that it may
 * touch, together with the bounds of its path (struct smear_path_bounds): all that a tile needs to choose its
 * method. */
#include "geometry/assemble.h"

#include "geometry/path.h"
#include "geometry/ranges.h"
#include "geometry/reproject.h"
#include "geometry/shot.h"
#include "geometry/space.h"
#include "geometry/vertex.h"

#if SMEAR_WITH_SUBFRAMES

enum { OPEN, CLOSE, MIDDLE, KEYS };     /* as keys of an assembly, then the instant that is drawn */

/* A vertex at all three instants: an entry of a direct-mapped cache in the memory of the other one. */
struct path_vertex {
    uint32_t tag, stored;               /* as in struct smear_cached_vertex */
    struct smear_screen screen[KEYS];
    uint32_t outcodes;                  /* a byte for each instant, see code_at() */
};

static inline const struct smear_placement *placement_of(const struct smear_assembly *d, int key)
{
    return key == MIDDLE ? &d->at : &d->motion.key[key];
}

SMEAR_STATIC_ASSERT(sizeof(struct path_vertex) <= 2 * sizeof(struct smear_cached_vertex), "two for one");

/* A bit of path_vertex.outcodes above those of the instants: the vertex has a path in space. */
#define IN_SPACE (1u << 24)

/* Whether the parabola on the screen through three places holds. Of a vertex that goes straight and comes nearer by the part d
 * of its distance, as it travels T px, that leaves out about T d^2 / 5 px; and of its depth a part of d^3 / 3, which counts
 * wherever the triangle reaches. A turn of the camera by t to either side leaves out T t^2 / 15: `turned` is t^2 / 3, q30. */
static bool holds(const struct smear_screen screen[KEYS], uint32_t turned)
{
    enum { APART_MOST = 320, FEW = 64 << 8 };         /* T d^2, q8 px: the path errs by a quarter of a pixel */
    const int32_t depth = screen[MIDDLE].depth;
    int32_t nearer = 0, travel = 0;
    for (int key = OPEN; key <= CLOSE; key++) {
        nearer = max_i32(nearer, abs_i32(screen[key].depth - depth));
        travel += max_i32(abs_i32(screen[key].x - screen[MIDDLE].x), abs_i32(screen[key].y - screen[MIDDLE].y));
    }
    if (nearer > depth >> 2)
        return false;
    if (nearer < depth >> 4 && travel < FEW)
        return true;
    const int down = max_i32(17 - count_leading_zeros((uint32_t)depth), 0);
    const uint32_t part = (uint32_t)(nearer >> down), whole = (uint32_t)(depth >> down);       /* 15 bits */
    const uint32_t turns = turned == 0 ? 0 : (uint32_t)((uint64_t)(whole * whole) * turned >> 30);
    return (uint64_t)(uint32_t)travel * (part * part + turns) <= (uint64_t)APART_MOST * (whole * whole);
}

static uint32_t turned_by(const struct smear_assembler *a)
{
    const uint32_t turn = SMEAR_WITH_CURVES ? a->bins->shot->turn >> 16 : 0;        /* t = 2 pi turn / 2^16 */
    return turn * turn * 27u >> 3;
}

/* Completes the outcodes of a vertex. */
static inline void find_kind(struct path_vertex *v, bool orthographic, uint32_t turned)
{
    const uint32_t any = v->outcodes | v->outcodes >> 8 | v->outcodes >> 16;
    if ((any & OUT_CLIP) != 0 || (!orthographic && !holds(v->screen, turned)))
        v->outcodes |= IN_SPACE;
}

static void find_vertex(struct path_vertex *v, const struct smear_assembler *a, const struct smear_assembly *d, uint32_t tag)
{
    v->tag = tag;
    v->stored = 0;
    v->outcodes = 0;
    for (int key = 0; key < KEYS; key++)
        v->outcodes |= (uint32_t)placement_project_any(&v->screen[key], placement_of(d, key), tag & 0xffffu, &a->viewport) << 8 * key;
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

/* Returns the flags that all triangles of a draw have. */
static int path_flags(const struct smear_assembly *d)
{
    return (d->material->texture != NULL && d->mesh->uv != NULL ? PATH_TEXTURED : 0)
         | (SMEAR_WITH_ALPHA && d->material->alpha != SMEAR_OPAQUE ? PATH_SUBFRAMES : 0);
}

/* Returns the curvature of a parabola, which leaves the box of its three places by at most an eighth of that. */
static int32_t curvature_of(const struct smear_screen p[KEYS])
{
    return max_i32(abs_i32(p[OPEN].x + p[CLOSE].x - 2 * p[MIDDLE].x), abs_i32(p[OPEN].y + p[CLOSE].y - 2 * p[MIDDLE].y));
}

/* Finds a triangle's bounds. Returns false when it can't cover a pixel of the part of the frame that is being filled. */
static bool find_bounds(struct smear_path_bounds *b, const struct smear_assembler *a,
                        const struct smear_assembly *d, const struct smear_screen *const corner[3])
{
    int32_t x0 = INT32_MAX, x1 = INT32_MIN, y0 = INT32_MAX, y1 = INT32_MIN, depth = 0, overshoot = 0, travel = 0, curvature = 0;
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
        curvature = max_i32(curvature, curvature_of(p));
    }
    int32_t margin = ((curvature + 4) >> 3) + bins_margin(a->bins) * 256;
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
        .flags = (uint8_t)(path_flags(d) | (large ? PATH_LARGE : 0))
    };
    return true;
}

/* ------------------------------------------------------------------ records */

static void store_path(uint32_t *record, const struct smear_segment *s, const struct smear_screen screen[KEYS])
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
    /* Of a triangle in space: its vertices in the mesh's order, their places, and the scale of those. */
    struct path_vertex *const *vertex;
    struct smear_homogeneous place[3][KEYS];
    int8_t scale;
    uint8_t flat_depth;
};

static void set_scale(const struct path_batch *b)
{
    b->segment->scale = b->scale;
    b->segment->flat_depth = b->flat_depth;
}

static void make_space(struct smear_space *space, const struct path_batch *b)
{
    set_scale(b);
    smear_space_make(space, b->a->bins, b->segment, b->a->viewport.width, b->a->viewport.height);
}

/* Finds the places of a triangle's vertices in space, all poses in one scale. Rows of an orthographic camera have a bit more than
 * places. */
static SMEAR_NOINLINE void find_places(struct path_batch *b, struct path_vertex *const v[3])
{
    const struct smear_assembly *d = b->d;
    const bool even = is_orthographic(&d->at.now);
    struct smear_placement at;
    int scale[KEYS], distance_scale[KEYS], least = INT8_MAX, least_distance = INT8_MAX;
    b->vertex = v;
    for (int key = 0; key < KEYS; key++) {
        d->place_fine(&at, d, key, projection_coarse(b->a->viewport.height, even));
        scale[key] = at.now.scale;
        distance_scale[key] = at.now.distance_scale;
        least = min_i32(least, scale[key] - even);
        least_distance = min_i32(least_distance, distance_scale[key]);
        for (int i = 0; i < 3; i++)
            placement_transform(&b->place[i][key], &at, v[i]->tag & 0xffffu);
    }
    least = max_i32(least, even ? 0 : INT8_MIN);
    b->scale = (int8_t)max_i32(least_distance, INT8_MIN);
    for (int key = 0; key < KEYS; key++) {
        const int up = clamp_i32(least - scale[key], -31, 31), distance_up = clamp_i32(b->scale - distance_scale[key], -31, 31);
        for (int i = 0; i < 3; i++)
            smear_space_scale(&b->place[i][key], up, distance_up);
    }
    if (even)
        b->flat_depth = (uint8_t)(1 + least);
}

static const struct smear_homogeneous *places_of(const struct path_batch *b, const struct path_vertex *v)
{
    return b->place[v == b->vertex[0] ? 0 : v == b->vertex[1] ? 1 : 2];
}

/* Stores the path in space of a vertex and, where it has one on the screen, that behind the record. */
static SMEAR_RARE void store_in_space(uint32_t *record, struct path_batch *b, const struct path_vertex *v)
{
    const struct smear_homogeneous *const place = places_of(b, v);
    set_scale(b);
    smear_space_store(record, b->segment, &place[OPEN], &place[MIDDLE], &place[CLOSE]);
    if ((v->outcodes & IN_SPACE) != 0)
        return;
    uint32_t *const beyond = store_place(record + b->segment->stride, &v->screen[MIDDLE]) + PATH_POSE_WORDS;
    store_place(beyond, &v->screen[OPEN]);
    store_place(beyond + PATH_POSE_WORDS, &v->screen[CLOSE]);
    b->a->bins->vertex_words += SCREEN_PATH_WORDS;
}

static uint32_t store_path_vertex(struct path_batch *b, struct path_vertex *v, uint32_t triangle, bool back, bool in_space)
{
    const struct smear_assembly *d = b->d;
    const struct smear_segment *s = b->segment;
    const bool alone = (v->outcodes & IN_SPACE) == 0 && in_space;
    bool shares = b->shares && (!back || !segment_by_vertices(s)) && !alone;
    if (shares && v->stored > s->base)
        return v->stored - 1;
    struct smear_bins *g = b->a->bins;
    uint32_t word = g->vertex_words, index = v->tag & 0xffffu;
    uint32_t *record = g->pool + word;
    g->vertex_words = word + s->stride;
    if (in_space)
        store_in_space(record, b, v);
    else
        store_path(record, s, v->screen);
    if (segment_textured(s))
        store_mesh_uv(record + s->uv, d, index);
    if (segment_colored(s))
        smear_vertex_store_color(record + s->color, d, index, triangle, back);
    if (shares)
        v->stored = word + 1;
    return word;
}

/* Whether the next part of the triangle has been added already. */
static bool is_added(struct path_batch *b)
{
    const bool added = b->parts < b->parts_before;
    b->parts = (uint16_t)(b->parts + added);
    return added;
}

static bool has_room(struct path_batch *b, bool in_space)
{
    struct smear_segment *s = make_room(b->a, b->d, b->segment, 2, in_space ? SPACE_ROOM : 0);
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

static void add_listed(const struct path_batch *b, uint32_t *list, const struct smear_path_bounds *bounds, const uint16_t vertex[3],
                       uint32_t color)
{
    struct smear_bins *g = b->a->bins;
    void *entry = bins_triangle(g, g->triangle_count++);
    *(struct smear_path_bounds *)entry = *bounds;
    bins_add(g, &list[bins_row(g, bounds->y0)], vertex[0], vertex[1], vertex[2], (uint32_t)(b->segment - g->segment), color);
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
    if (smear_vertex_flat_color(&color, b->segment, record, b->d->shading.transfer))
        bounds->flags |= PATH_FLAT;
    /* No vertex moves, not even by a step (q8 px); before lines, which would blur it, what stays where it is moves, too. */
    const bool stands = !b->a->lines && bounds->travel + bounds->curvature == 0;
    uint32_t *list = is_blend(b->d) ? g->blend_last : stands ? g->opaque_last : g->moving_last;
    add_listed(b, list, bounds, vertex, color);
    b->parts++;
    b->a->path_count++;
    b->a->path_static_count += stands;
    if (assembler_has_damage(b->a))
        mark_tiles(b->a->damaged, bounds);
    b->a->triangles_drawn++;
}

/* ------------------------------------------------------------------ in space */

/* A parabola or an arc lies within the triangle of its ends and of the place where the lines along it there meet. */
enum { HULL_POINTS = 3 * KEYS };

/* What is seen of a path in space. */
struct extent {
    int32_t x0, y0, x1, y1, depth;
    bool passes;                /* the near plane */
};

static void extend(struct extent *e, const struct smear_space *space, const struct smear_homogeneous *h)
{
    struct smear_screen screen;
    smear_project(&screen, &space->depths, h, &space->viewport);
    screen_clamp(&screen, &space->viewport);
    e->x0 = min_i32(e->x0, screen.x);
    e->y0 = min_i32(e->y0, screen.y);
    e->x1 = max_i32(e->x1, screen.x);
    e->y1 = max_i32(e->y1, screen.y);
    e->depth = max_i32(e->depth, screen.depth);
}

/* Finds the extent of what lies in front of the near plane of all between some points: that of those in front, and of where the
 * lines from them to those behind cross the plane. Returns false where nothing is in front. */
static bool find_extent(struct extent *e, const struct smear_space *space, const struct smear_homogeneous point[HULL_POINTS])
{
    const int32_t near = space->depths.near_distance;
    bool seen = false;
    *e = (struct extent){ INT32_MAX, INT32_MAX, INT32_MIN, INT32_MIN, 0, false };
    for (int i = 0; i < HULL_POINTS; i++) {
        const struct smear_homogeneous *const front = &point[i];
        if (front->distance < near) {
            e->passes = true;
            continue;
        }
        seen = true;
        extend(e, space, front);
        for (int k = 0; k < HULL_POINTS; k++) {
            const struct smear_homogeneous *const behind = &point[k];
            if (behind->distance >= near)
                continue;
            const int32_t t = ratio_q30((int64_t)front->distance - near, (int64_t)front->distance - behind->distance);
            const struct smear_homogeneous h = { (int32_t)(front->x + (((int64_t)behind->x - front->x) * t >> 30)),
                                                 (int32_t)(front->y + (((int64_t)behind->y - front->y) * t >> 30)),
                                                 depths_are_even(&space->depths) ? front->w : near, near };
            extend(e, space, &h);
        }
    }
    return seen;
}

/* Returns the sides of the frame that a place lies beyond, in front of the eye or not. */
static int sides_of(const struct smear_homogeneous *h, const struct smear_space *space)
{
    const int64_t one = (int64_t)2 << space->depths.coarse, x = h->x * one, y = h->y * one;
    const int64_t right = mul_wide(h->w, space->viewport.width), bottom = mul_wide(h->w, space->viewport.height);
    return (x < -right ? OUT_LEFT : 0) | (x > right ? OUT_RIGHT : 0) | (y < -bottom ? OUT_TOP : 0) | (y > bottom ? OUT_BOTTOM : 0);
}

/* Whether all points lie beyond one side of the frame, or behind the far plane, and so all between them. */
static bool is_beside(const struct smear_space *space, const struct smear_homogeneous point[HULL_POINTS])
{
    int beside = OUT_LEFT | OUT_RIGHT | OUT_TOP | OUT_BOTTOM | OUT_FAR;
    for (int i = 0; i < HULL_POINTS && beside != 0; i++)
        beside &= sides_of(&point[i], space) | (point[i].distance > space->depths.far_distance ? OUT_FAR : 0);
    return beside != 0;
}

/* Whether the triangle faces the eye at a key, as the sign of X Y W of its corners tells in the order in which they are
 * clockwise on the screen; or may, where that is lost in rounding. */
static bool may_face(const struct smear_homogeneous *const place[3], int key)
{
    enum { BITS = 19 };
    uint32_t all = 1u << BITS;
    for (int i = 0; i < 3; i++)
        all |= (uint32_t)abs_i32(place[i][key].x) | (uint32_t)abs_i32(place[i][key].y) | (uint32_t)abs_i32(place[i][key].w);
    const int down = 32 - BITS - count_leading_zeros(all);
    int32_t x[3], y[3], w[3];
    for (int i = 0; i < 3; i++) {
        x[i] = place[i][key].x >> down;
        y[i] = place[i][key].y >> down;
        w[i] = place[i][key].w >> down;
    }
    int64_t sum = 0;
    for (int i = 0; i < 3; i++) {
        const int j = i == 2 ? 0 : i + 1, k = i == 0 ? 2 : i - 1;
        sum += w[i] * cross_wide(x[j], x[k], y[j], y[k]);
    }
    return sum >= -((int64_t)1 << (2 * BITS + 3));
}

static inline int32_t meeting(int32_t open, int32_t middle, int32_t close, int32_t bulge)
{
    return narrow_sat(middle + ((2 * (int64_t)middle - open - close) * bulge >> 15));
}

/* Finds the bounds of a triangle of which a vertex has a path in space. Returns false where it is never seen. */
static SMEAR_RARE bool find_bounds_in_space(struct smear_path_bounds *b, const struct path_batch *batch,
                                            const struct path_vertex *v0, const struct path_vertex *v1, const struct path_vertex *v2)
{
    const struct smear_assembler *a = batch->a;
    const struct smear_homogeneous *const place[3] = { places_of(batch, v0), places_of(batch, v1), places_of(batch, v2) };
    struct smear_homogeneous point[HULL_POINTS];
    struct smear_space space;
    int32_t travel = 1, curvature = 0;
    make_space(&space, batch);
    const int32_t bulge = SMEAR_WITH_CURVES ? smear_space_bulge(&space) : 1 << 14;
    for (int i = 0; i < 3; i++) {
        for (int key = 0; key < KEYS; key++)
            point[KEYS * i + key] = place[i][key];
        struct smear_homogeneous *const meet = &point[KEYS * i + MIDDLE];
        const struct smear_homogeneous *const open = &place[i][OPEN], *const close = &place[i][CLOSE];
        meet->x = meeting(open->x, meet->x, close->x, bulge);
        meet->y = meeting(open->y, meet->y, close->y, bulge);
        meet->distance = meeting(open->distance, meet->distance, close->distance, bulge);
        if (!depths_are_even(&space.depths))
            meet->w = meet->distance;
        if ((batch->vertex[i]->outcodes & IN_SPACE) == 0)
            curvature = max_i32(curvature, curvature_of(batch->vertex[i]->screen));
    }
    struct extent e;
    if (!(may_face(place, OPEN) || may_face(place, MIDDLE) || may_face(place, CLOSE)) || is_beside(&space, point)
        || !find_extent(&e, &space, point))
        return false;
    for (int i = 0; i < 3 && !e.passes; i++) {
        struct smear_screen open, close;
        smear_project(&open, &space.depths, &place[i][OPEN], &space.viewport);
        smear_project(&close, &space.depths, &place[i][CLOSE], &space.viewport);
        travel = max_i32(travel, max_i32(abs_i32(close.x - open.x), abs_i32(close.y - open.y)));
    }
    if (e.passes)
        travel = max_i32(a->viewport.width, a->viewport.height) << 8;
    /* Vertices without a path in space go along that on the screen from place to place. Places are rounded: where the near plane is few of
     * their units away, one is many pixels. */
    const int32_t rounded = depths_are_even(&space.depths) ? 0 : (2 << space.depths.coarse) / space.depths.near_distance;
    const int32_t margin = 1 + (curvature >> (8 + 3)) + rounded + bins_margin(a->bins);
    struct box box = { (e.x0 >> 8) - margin, (e.y0 >> 8) - margin, (e.x1 >> 8) + 1 + margin, (e.y1 >> 8) + 1 + margin };
    box_cut(&box, a);
    if (box_is_empty(&box) || (!is_blend(batch->d) && (box.x0 >= a->path_x1 || box.x1 <= a->path_x0)))
        return false;
    *b = (struct smear_path_bounds){
        .x0 = (int16_t)box.x0, .y0 = (int16_t)box.y0, .x1 = (int16_t)box.x1, .y1 = (int16_t)box.y1,
        .travel = sixteenths(travel),
        .nearest = code_above(min_i32(e.depth + (e.depth >> 4), SMEAR_DEPTH_MAX)),
        .flags = (uint8_t)(path_flags(batch->d) | PATH_SPACE),
        .space = (uint8_t)((v0->outcodes & IN_SPACE) / IN_SPACE | (v1->outcodes & IN_SPACE) / (IN_SPACE / 2)
                           | (v2->outcodes & IN_SPACE) / (IN_SPACE / 4) | (v1 != batch->vertex[1] ? PATH_REVERSED : 0))
    };
    return true;
}

/* ------------------------------------------------------------------ triangles */

/* Adds a triangle whose vertices are clockwise on the screen where it is seen from the side that is drawn. Returns
 * false where there is no room. */
static bool add_triangle(struct path_batch *b, struct path_vertex *v0, struct path_vertex *v1,
                         struct path_vertex *v2, uint32_t triangle, bool back)
{
    const struct smear_screen *const corner[3] = { v0->screen, v1->screen, v2->screen };
    struct smear_path_bounds bounds;
    const bool in_space = ((v0->outcodes | v1->outcodes | v2->outcodes) & IN_SPACE) != 0;
    if (!(in_space ? find_bounds_in_space(&bounds, b, v0, v1, v2) : find_bounds(&bounds, b->a, b->d, corner)) || is_added(b))
        return true;
    if (!has_room(b, in_space))
        return false;
    uint32_t base = b->segment->base;
    uint16_t offset0 = (uint16_t)(store_path_vertex(b, v0, triangle, back, in_space) - base);
    uint16_t offset1 = (uint16_t)(store_path_vertex(b, v1, triangle, back, in_space) - base);
    uint16_t offset2 = (uint16_t)(store_path_vertex(b, v2, triangle, back, in_space) - base);
    struct smear_face face = smear_face_of(b->d, triangle, back);
    const uint16_t offset[3] = { offset0, offset1, offset2 };
    list_triangle(b, &bounds, offset, &face);
    return true;
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

static inline void make_vertex(struct path_vertex *v, const struct smear_assembler *a, const struct smear_assembly *d, uint32_t tag)
{
    find_vertex(v, a, d, tag);
    find_kind(v, is_orthographic(&d->at.now), turned_by(a));
}

static struct path_vertex *look_up(struct path_vertex *cache, uint32_t mask, const struct smear_assembler *a,
                                   const struct smear_assembly *d, uint32_t tag,
                                   const struct path_vertex *in_use1, const struct path_vertex *in_use2,
                                   struct path_vertex *spare)
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
    make_vertex(v, a, d, tag);
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
        if (codes & IN_SPACE) {     /* bounds tell which sides are seen */
            find_places(b, v);
            return add_triangle(b, v[0], v[d->mirrored ? 1 : 2], v[d->mirrored ? 2 : 1], triangle, false) && (!d->backs
                    || add_triangle(b, v[0], v[d->mirrored ? 2 : 1], v[d->mirrored ? 1 : 2], triangle, true));
        }
    }
    /* Which sides are seen at some instant; a side that is not drawn counts as seen. */
    bool front = false, behind = !d->backs;
    struct path_vertex *v1 = v[d->mirrored ? 1 : 2], *v2 = v[d->mirrored ? 2 : 1];
    for (int key = 0; key < KEYS && !(front && behind); key++) {
        int64_t area = area_of(&v[0]->screen[key], &v1->screen[key], &v2->screen[key]);
        front = front || area > 0;
        behind = behind || area < 0;
    }
    return (!front || add_triangle(b, v[0], v1, v2, triangle, false))
        && (!behind || !d->backs || add_triangle(b, v[0], v2, v1, triangle, true));
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
    uint32_t first = max_u32(d->first, a->resume.triangle);
    const struct smear_tile_box filled = ranges_filled(a, !is_blend(d));
    for (uint32_t end = first; end < d->end; first = end) {
        end = smear_ranges_seen(a, d, filled, &first);
        const uint16_t *index = d->mesh->index + 3 * first;
        for (uint32_t i = first; i < end; i++, index += 3) {
            struct path_vertex *v[3];
            v[0] = look_up(cache, mask, a, d, tag | index[0], NULL, NULL, &spare[0]);
            v[1] = look_up(cache, mask, a, d, tag | index[1], v[0], NULL, &spare[1]);
            v[2] = look_up(cache, mask, a, d, tag | index[2], v[0], v[1], &spare[2]);
            b.parts = 0;
            b.parts_before = (uint16_t)parts_before(a, i);
            if (!add_seen(&b, v, i)) {
                a->resume = (struct smear_resume){ i, b.parts };
                return false;
            }
        }
    }
    a->resume = (struct smear_resume){ 0, 0 };
    return true;
}

#endif
