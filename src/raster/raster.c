/* SPDX-License-Identifier: MIT */
/* raster.c - lists of triangles: which are drawn pixel by pixel, which are made ready for their rows (setup.c) and covered
 * (cover.c), and what is kept of those that go on in the next rows. */
#include "raster/raster.h"

#include "raster/cover_texels.h"
#include "raster/cover_tiny8.h"
#include "raster/flat_list.h"
#include "raster/fog.h"
#include "raster/front_order.h"
#include "raster/kept_found.h"
#include "raster/point.h"
#include "raster/span.h"
#include "raster/tiny_list.h"

/* ------------------------------------------------------------------ a triangle */

static inline bool has_levels(const struct setup *s)
{
    return SMEAR_WITH_TEXTURE && SMEAR_WITH_BOUNDS && segment_textured(s->segment) && s->draw->sampler.levels != 0;
}

#if SMEAR_KEPT_LISTS
/* Whether the target's columns may cut a triangle's rows off. */
static inline bool box_is_cut(const struct setup *s, const struct pixel_box *box)
{
    return max_i32(box->left, 0) < s->target->x0 || min_i32(box->right, s->frame->width) > s->target->x1;
}

/* Keeps a setup; again, where something is kept. */
static inline void keep_setup(struct kept *k, struct setup *s, uint32_t triangle, const struct pixel_box *box, int32_t end, bool small)
{
    const struct smear_raster_target *target = s->target;
    if (k == NULL)
        k = kept_add(&target->cache, triangle);
    if (k == NULL)
        return;
    const bool rows = s->rows != NULL && !small && !target_has_velocity(target);
    k->kind = rows ? KEPT_ROWS : KEPT_SETUP;
    k->order = rows ? (uint8_t)smear_cover_order(s) : 0;
    k->cut = box_is_cut(s, box);
    kept_keep(k, s, triangle, end);
}
#endif

static inline struct bounds bounds_of(const int32_t *const v[3])
{
    return (struct bounds){ min_i32(v[0][VERTEX_X], min_i32(v[1][VERTEX_X], v[2][VERTEX_X])),
                            min_i32(v[0][VERTEX_Y], min_i32(v[1][VERTEX_Y], v[2][VERTEX_Y])),
                            max_i32(v[0][VERTEX_X], max_i32(v[1][VERTEX_X], v[2][VERTEX_X])),
                            max_i32(v[0][VERTEX_Y], max_i32(v[1][VERTEX_Y], v[2][VERTEX_Y])) };
}

SMEAR_INLINE void start(struct setup *s, const struct smear_raster_frame *frame, const struct smear_raster_target *target,
                        const struct smear_segment *segment, uint32_t color, const int32_t *const v[3])
{
    s->frame = frame;
    s->target = target;
    s->segment = segment;
    s->draw = &frame->draw[segment->draw];
    s->color = color;
    for (int i = 0; i < 3; i++)
        s->v[i] = v[i];
}

static inline void start_fog(struct setup *s, bool in_fog)
{
    if (!SMEAR_WITH_FOG)
        return;
    s->fog = FOG_NONE;
    if (in_fog)
        smear_fog_triangle(s);
}

/* The planes start with the background's velocity: static triangles write theirs only over others, after the first one that
 * moves. */
static inline void start_velocity(struct setup *s, bool *moved)
{
    const bool fixed = draw_is_fixed(s->draw), moves = segment_moves(s->segment) != 0 || fixed;
    s->writes_velocity = target_has_velocity(s->target) && !draw_is_blended(s->draw) && (moves || *moved);
    s->velocity_unknown = frame_has_depth_velocity(s->frame) && !fixed;
    if (moves)
        *moved = true;
}

/* Makes its planes where they are needed and not there. Returns whether it did. */
static inline bool make_velocity(struct setup *s)
{
    if (!setup_writes_velocity(s) || s->has_velocity)
        return false;
    smear_setup_velocity(s);
    s->has_velocity = true;
    return true;
}

/* Draws a triangle of few pixels by the weights of its vertices. False where it needs gradients. */
SMEAR_INLINE bool draw_tiny(const struct setup *s, uint64_t area, int32_t pixels, const struct pixel_box *box, bool in_fog)
{
    if (cover_is_tiny(s, pixels, in_fog)) {
        cover_tiny(s, (int32_t)area, box, in_fog);
        return true;
    }
    return cover_has_texels(s, pixels) && smear_cover_texels(s, (int32_t)area, box);
}

#if SMEAR_KEPT_LISTS
/* Draws rows [y, end) of a triangle of which sides are kept. */
static SMEAR_NOINLINE void draw_face_parts(const struct kept_list *l, const struct flat_carried *face, int32_t y, int32_t end)
{
    struct flat_area area = l->area;
    for (int32_t stop; y < end; y = stop) {
        stop = min_i32(y + FLAT_FACE_ROWS, y < l->turn ? min_i32(l->turn, end) : end);
        if (y >= l->turn) {
            area.pixels = pixel_after(l->area.pixels, -l->back, area.narrow);
            area.depth = l->area.depth - l->back;
        }
        smear_flat_carried_avx2(&area, face, y, stop);
    }
}

static inline void draw_face(const struct kept_list *l, const struct flat_carried *face, int32_t y, int32_t end)
{
    if (end <= l->turn && end - y <= FLAT_FACE_ROWS)
        smear_flat_carried_avx2(&l->area, face, y, end);
    else
        draw_face_parts(l, face, y, end);
}

static inline void draw_kept_face(const struct smear_raster_target *target, struct kept *k)
{
    leave_kept(target, k, k->end > target->y1);
    draw_face(kept_list_of(&target->cache), &((const struct kept_face *)(void *)k)->face, target->y0, min_i32(k->end, target->y1));
}

#if SMEAR_LANE_ROWS
static SMEAR_NOINLINE void draw_texels(const struct smear_raster_frame *frame, const struct smear_raster_target *target,
                                       struct kept_texels *k, int32_t y, int32_t end)
{
    const struct smear_sampler *const m = &frame->draw[k->draw].sampler;
    if (k->kept.kind == KEPT_CURVES)
        smear_lane_curves_on(&k->texels, target, m, y, end, frame->width);
    else
        smear_lane_places_on(&k->texels, target, m, y, end, frame->width);
}
#endif

/* Draws the next rows of a triangle where more than its setup is kept. */
SMEAR_INLINE bool draw_carried(const struct smear_raster_frame *frame, const struct smear_raster_target *target, struct kept *k)
{
    if (k->kind == KEPT_FACE) {
        draw_kept_face(target, k);
        return true;
    }
#if SMEAR_LANE_ROWS
    if (k->kind >= KEPT_CURVES) {
        leave_kept(target, k, k->end > target->y1);
        draw_texels(frame, target, (struct kept_texels *)(void *)k, target->y0, min_i32(k->end, target->y1));
        return true;
    }
#else
    (void)frame;
#endif
    return false;
}

/* Draws a large triangle of one colour, of which sides are kept. False where it is none, or there is no room. */
static inline bool keep_face(const struct setup *s, uint32_t triangle, const struct pixel_box *box, int32_t end)
{
    const struct smear_raster_target *t = s->target;
    if (!s->flat || target_has_velocity(t) || t->x1 - t->x0 < FLAT_FACE_LEAST || !smear_has_avx2())
        return false;
    struct kept_face *const k = (struct kept_face *)(void *)kept_add(&t->cache, triangle);
    if (k == NULL)
        return false;
    k->kept.kind = KEPT_FACE;
    k->kept.end = (int16_t)end;
    smear_cover_carry(s, &k->face, box->top);
    draw_face(kept_list_of(&t->cache), &k->face, box->top, box->bottom);
    return true;
}

/* Draws a large triangle of copied texels likewise. */
static SMEAR_NOINLINE bool keep_texels(const struct setup *s, uint32_t triangle, const struct pixel_box *box, int32_t end)
{
#if SMEAR_LANE_ROWS
    const struct smear_raster_target *t = s->target;
    const bool shrunk = s->draw != &s->frame->draw[s->segment->draw];       /* a sampler is not kept */
    if (s->rows == NULL || shrunk || target_has_velocity(t) || !smear_lane_carries(s, box_is_cut(s, box)))
        return false;
    struct kept_texels *const k = (struct kept_texels *)(void *)kept_add(&t->cache, triangle);
    if (k == NULL)
        return false;
    k->kept.kind = smear_lane_carry(&k->texels, s, box->top) ? KEPT_CURVES : KEPT_PLACES;
    k->kept.end = (int16_t)end;
    k->draw = s->segment->draw;
    draw_texels(s->frame, t, k, box->top, box->bottom);
    return true;
#else
    (void)s;
    (void)triangle;
    (void)box;
    (void)end;
    return false;
#endif
}

/* Keeps a triangle that goes on; its setup again, where that is kept. True where it has been drawn. */
static SMEAR_NOINLINE bool keep(struct kept *k, struct setup *s, uint32_t triangle, const struct pixel_box *box, int32_t end, bool small)
{
    if (k == NULL && !small && (keep_face(s, triangle, box, end) || keep_texels(s, triangle, box, end)))
        return true;
    keep_setup(k, s, triangle, box, end, small);
    return false;
}
#else
static inline bool draw_carried(const struct smear_raster_frame *frame, const struct smear_raster_target *target, const struct kept *k)
{
    (void)frame;
    (void)target;
    (void)k;
    return false;
}

static inline bool keep(struct kept *k, struct setup *s, uint32_t triangle, const struct pixel_box *box, int32_t end, bool small)
{
    (void)box;
    (void)small;
    if (k != NULL)
        kept_keep(k, s, triangle, end);
    return false;
}
#endif

/* What is not kept of a setup, but found again. */
SMEAR_INLINE void complete_kept(struct setup *s, struct smear_raster_draw *smaller, bool small)
{
    if (has_levels(s))
        smear_setup_shrink(s, smaller);
    if (cover_is_narrow(s->target))
        smear_cover_choose(s, small);
}

/* Draws a triangle with these vertices, and this box of them where it is given. `triangle` is its number in the list's
 * geometry, or none. */
SMEAR_INLINE void draw_any(const struct smear_raster_frame *frame, const struct smear_raster_target *target,
                           const struct smear_segment *segment, uint32_t color, uint32_t triangle,
                           const int32_t *const v[3], const struct bounds *given, bool *moved, bool in_fog)
{
    const struct bounds bounds = given != NULL ? *given : bounds_of(v);
    const int32_t left = (bounds.x0 + 127) >> 8, right = (bounds.x1 + 127) >> 8;
    const int32_t top = (bounds.y0 + 127) >> 8, bottom = (bounds.y1 + 127) >> 8;
    const int32_t most = segment_textured(segment) ? SMALL_TEXTURED_PX : SMALL_PX;
    const bool small = right - left <= most && bottom - top <= most;
    const int32_t pixels = small ? (right - left) * (bottom - top) : INT32_MAX;
    if (max_i32(left, target->x0) >= min_i32(right, target->x1))
        return;
    const bool continues = top < target->y0, goes_on = bottom > target->y1;
    const struct pixel_box box = { left, right, max_i32(top, target->y0), min_i32(bottom, target->y1) };
    if (box.top >= box.bottom)
        return;

    bool known;
    struct kept *const kept = find_kept(target, triangle, continues, goes_on, &known);
    if (known && draw_carried(frame, target, kept))
        return;
    struct setup s;
    struct smear_raster_draw smaller;
    start(&s, frame, target, segment, color, v);
    const uint64_t area = !known || small ? setup_edges(&s) : 1;   /* large ones are covered without edge vectors */
    SMEAR_ASSERT((int64_t)area > 0);
    if (known) {
        kept_take(kept, &s);
        leave_kept(target, kept, goes_on);
    } else {
        s.bounds = bounds;
        start_fog(&s, in_fog);
    }
    start_velocity(&s, moved);
    if (!known) {
        if (has_levels(&s))
            smear_setup_level(&s, area, &smaller);
        if (draw_tiny(&s, area, pixels, &box, in_fog))
            return;
        if (!(cover_is_small(&s, small) && smear_setup_small(&s, (int32_t)area)))
            smear_setup(&s, area);
        smear_cover_choose(&s, small);
    } else {
        complete_kept(&s, &smaller, small);
    }
    const bool is_new = make_velocity(&s) || !known;
    if (is_new && (SMEAR_KEPT_LISTS || kept != NULL) && goes_on && keep(kept, &s, triangle, &box, bottom, small))
        return;
    smear_cover(&s, &box, small);
}

/* A copy of its own for fog, where size does not count: others need not ask. */
#if SMEAR_WITH_FOG && !defined(__OPTIMIZE_SIZE__) && !defined(__ARM_ARCH_6M__)
#define HAS_LOOP_FOR_FOG true
static SMEAR_NOINLINE void draw_in_fog(const struct smear_raster_frame *frame, const struct smear_raster_target *target,
                                       const struct smear_segment *segment, uint32_t color, uint32_t triangle,
                                       const int32_t *const v[3], const struct bounds *given, bool *moved)
{
    draw_any(frame, target, segment, color, triangle, v, given, moved, true);
}

static SMEAR_NOINLINE void draw_triangle(const struct smear_raster_frame *frame, const struct smear_raster_target *target,
                                         const struct smear_segment *segment, uint32_t color, uint32_t triangle,
                                         const int32_t *const v[3], const struct bounds *given, bool *moved)
{
    draw_any(frame, target, segment, color, triangle, v, given, moved, false);
}
#else
#define HAS_LOOP_FOR_FOG false
#define draw_in_fog draw_triangle
static SMEAR_NOINLINE void draw_triangle(const struct smear_raster_frame *frame, const struct smear_raster_target *target,
                                         const struct smear_segment *segment, uint32_t color, uint32_t triangle,
                                         const int32_t *const v[3], const struct bounds *given, bool *moved)
{
    draw_any(frame, target, segment, color, triangle, v, given, moved, SMEAR_WITH_FOG && frame_has_fog(frame));
}
#endif

/* Draws an entry of a list, triangle or point. */
SMEAR_INLINE void draw_entry(const struct smear_raster_frame *frame, const struct smear_raster_target *target,
                             const struct smear_triangle *t, uint32_t number, bool *moved, bool in_fog)
{
    if (t->segment == SMEAR_POINT) {
        draw_point(frame, target, t, *moved);
        return;
    }
    const struct smear_segment *segment = &frame->bins->segment[t->segment];
    const int32_t *v[3];
    for (int i = 0; i < 3; i++)
        v[i] = bins_vertex(frame->bins, segment, t->vertex[i]);
    if (in_fog)
        draw_in_fog(frame, target, segment, t->color, number, v, NULL, moved);
    else
        draw_triangle(frame, target, segment, t->color, number, v, NULL, moved);
}

SMEAR_INLINE void draw_list(const struct smear_raster_frame *frame, const struct smear_raster_target *target, uint32_t head,
                            bool in_fog)
{
    const bool flat = SMEAR_FLAT_ENTRIES && !frame_has_fog(frame) && !target_has_velocity(target);
    bool moved = target->over;
    while (head != SMEAR_NO_TRIANGLE) {
        const uint32_t number = head;
        const struct smear_triangle *t = bins_triangle(frame->bins, number);
        head = t->next;
        if (SMEAR_FLAT_ENTRIES && flat && smear_flat_entry(frame, target, t))
            continue;
        draw_entry(frame, target, t, number, &moved, in_fog);
    }
}

#if SMEAR_AVX2
/* Copies up to eight triangles of one segment, from `head` on, but for points and what is kept. Returns how many. */
static inline int take_tiny8(const struct smear_bins *bins, const struct smear_raster_cache *cache, uint32_t head,
                             uint16_t vertex[8][4], uint32_t color[8])
{
    const uint16_t segment = bins_triangle(bins, head)->segment;
    const struct kept_list *const list = kept_list_seen(cache);
    uint32_t kept = list->apart ? SMEAR_NO_TRIANGLE : list->triangle;
    uint16_t entry = kept != SMEAR_NO_TRIANGLE ? *list->link : 0;
    int n = 0;
    do {
        const uint32_t number = head;
        const struct smear_triangle *t = bins_triangle(bins, head);
        head = t->next;
        if (t->segment == SMEAR_POINT)
            continue;
        while (kept < number) {
            entry = kept_at(cache, entry)->next;
            kept = kept_triangle(cache, entry);
        }
        if (kept == number && kept_goes_on(list, kept_at(cache, entry)))
            continue;
        if (t->segment != segment)
            break;
        __builtin_memcpy(vertex[n], t->vertex, 4 * sizeof(uint16_t));
        color[n++] = t->color;
    } while (n < 8 && head != SMEAR_NO_TRIANGLE);
    for (int k = n; k < 8; k++) {
        __builtin_memcpy(vertex[k], vertex[0], sizeof vertex[0]);
        color[k] = color[0];
    }
    return n;
}

/* Draws the next rows of a triangle whose setup is kept. */
static SMEAR_NOINLINE void draw_kept_setup(const struct smear_raster_frame *frame, const struct smear_raster_target *target,
                                           struct kept *k, bool *moved)
{
    const struct smear_triangle *const t = bins_triangle(frame->bins, k->triangle);
    const struct smear_segment *segment = &frame->bins->segment[t->segment];
    const int32_t *v[3];
    for (int i = 0; i < 3; i++)
        v[i] = bins_vertex(frame->bins, segment, t->vertex[i]);
    if (k->kind != KEPT_ROWS) {
        draw_triangle(frame, target, segment, t->color, k->triangle, v, NULL, moved);
        return;
    }
    struct setup s;
    struct smear_raster_draw smaller;
    start(&s, frame, target, segment, t->color, v);
    kept_take(k, &s);
    leave_kept(target, k, k->end > target->y1);
    s.writes_velocity = false;
    if (has_levels(&s))
        smear_setup_shrink(&s, &smaller);
    smear_cover_on(&s, k->order, min_i32(k->end, target->y1), k->cut);
}

/* Draws the next rows of what is kept of triangles up to this one. False if nothing is kept of this one. */
static bool draw_kept_to(const struct smear_raster_frame *frame, const struct smear_raster_target *target, uint32_t number, bool *moved)
{
    const struct kept_list *const list = kept_list_seen(&target->cache);
    bool found = false;
    while (list->triangle <= number) {
        const bool is_last = list->triangle == number;
        struct kept *const k = kept_at(&target->cache, *list->link);
        if (!kept_goes_on(list, k)) {
            kept_drop(&target->cache);
            continue;
        }
        found = is_last;
        if (!draw_carried(frame, target, k))
            draw_kept_setup(frame, target, k, moved);
    }
    return found;
}

/* Draws up to eight triangles of one segment, the first of which is `head`, and points and kept ones among them. Returns what
 * follows. */
static uint32_t draw_tiny8(const struct smear_raster_frame *frame, const struct smear_raster_target *target, uint32_t head,
                           const struct tiny8_look *look, bool *moved)
{
    struct tiny8_pixels pixels;
    uint16_t vertex[8][4];
    uint32_t color[8];
    const int n = take_tiny8(frame->bins, &target->cache, head, vertex, color);
    smear_tiny8_avx2(&pixels, look, (const uint16_t(*)[4])vertex, color);
    const struct kept_list *const list = kept_list_seen(&target->cache);
    int32_t start = 0;
    for (int k = 0; k < n;) {
        const uint32_t number = head;
        const struct smear_triangle *t = bins_triangle(frame->bins, number);
        head = t->next;
        if (number >= list->triangle && draw_kept_to(frame, target, number, moved))
            continue;
        if (t->segment == SMEAR_POINT) {
            draw_point(frame, target, t, *moved);
            continue;
        }
        if ((pixels.taken >> k & 1u) != 0) {
            tiny8_put(target, look, &pixels, start, pixels.end[k]);
        } else {
            const int32_t *v[3];
            for (int i = 0; i < 3; i++)
                v[i] = look->vertex + t->vertex[i];
            draw_triangle(frame, target, &frame->bins->segment[t->segment], t->color, number, v, NULL, moved);
        }
        start = pixels.end[k++];
    }
    return head;
}

static void draw_list_tiny8(const struct smear_raster_frame *frame, const struct smear_raster_target *target, uint32_t head)
{
    const struct kept_list *const list = kept_list_seen(&target->cache);
    bool moved = target->over, suits = false;
    uint32_t segment = SMEAR_POINT;
    struct tiny8_look look;
    while (head != SMEAR_NO_TRIANGLE) {
        const uint32_t number = head;
        const struct smear_triangle *t = bins_triangle(frame->bins, number);
        if (number >= list->triangle && draw_kept_to(frame, target, number, &moved)) {
            head = t->next;
            continue;
        }
        if (t->segment == SMEAR_POINT) {
            draw_point(frame, target, t, moved);
            head = t->next;
            continue;
        }
        if (t->segment != segment) {
            segment = t->segment;
            suits = smear_raster_look(&look, frame, target, &frame->bins->segment[segment]);
        }
        if (suits) {
            head = draw_tiny8(frame, target, head, &look, &moved);
            continue;
        }
        const int32_t *v[3];
        for (int i = 0; i < 3; i++)
            v[i] = bins_vertex(frame->bins, &frame->bins->segment[segment], t->vertex[i]);
        draw_triangle(frame, target, &frame->bins->segment[segment], t->color, number, v, NULL, &moved);
        head = t->next;
    }
    draw_kept_to(frame, target, SMEAR_NO_TRIANGLE - 1, &moved);
}
#endif

#if TINY_TRIANGLES
/* Draws tiny triangles from a number on, if it is that of one: *head follows them. */
static inline bool draw_tiny_ones(struct tiny_triangles *t, uint32_t number, uint32_t *head, bool *tiny)
{
    const uint32_t reached = tiny_triangles(t, number);
    *tiny = reached != number;
    if (*tiny)
        *head = reached;
    return *tiny;
}
#endif

#if SMEAR_FLAT_LIST && SMEAR_TINY_LIST
/* Draws triangles of one segment that have no colours of vertices, from `head` on, and points among them: those where `points` is given
 * at once. Returns what follows. */
static SMEAR_NOINLINE uint32_t draw_flat_ones(const struct smear_raster_frame *frame, const struct smear_raster_target *target,
                                              struct tiny_look *look, struct points_plane *points, uint32_t head, bool *moved)
{
    const struct smear_bins *const bins = frame->bins;
    const uint32_t segment = bins_triangle(bins, head)->segment;
    const struct smear_segment *const g = &bins->segment[segment];
    const bool whole = target->x0 <= 0 && target->x1 >= frame->width, narrow = target_is_direct(target);
    const bool keeps = SMEAR_FLAT_KEPT && whole && target->cache.entries != 0 && (target->y0 > 0 || target->y1 < frame->height);
    bool tiny = true;
#if TINY_TRIANGLES
    struct tiny_triangles triangles;
    const bool loops = points != NULL && tiny_loop(&triangles, look, points, bins, g);
#else
    const bool loops = false;
#endif
    while (head != SMEAR_NO_TRIANGLE) {
        const uint32_t number = head;
        const struct smear_triangle *t = bins_triangle(bins, number);
        if (t->segment != segment && t->segment != SMEAR_POINT)
            break;
        head = t->next;
        if (t->segment == SMEAR_POINT) {
            if (points != NULL)
                head = points_list(points, number, narrow);
            else
                draw_point(frame, target, t, *moved);
            continue;
        }
#if TINY_TRIANGLES
        if (loops && (tiny || (number & 3u) == 0) && draw_tiny_ones(&triangles, number, &head, &tiny))
            continue;
#endif
        const int32_t *const v[3] = { bins_vertex(bins, g, t->vertex[0]), bins_vertex(bins, g, t->vertex[1]),
                                      bins_vertex(bins, g, t->vertex[2]) };
        /* After one that is large, some are not even looked at. */
        if (!loops)
            tiny = (tiny || (number & 3u) == 0) && tiny_draw(look, v, t->color);
        if (!tiny && !smear_flat_triangle(target, v, t->color, NULL, whole, keeps ? number : SMEAR_NO_TRIANGLE))
            draw_triangle(frame, target, g, t->color, number, v, NULL, moved);
    }
    return head;
}
#endif

#if SMEAR_TINY_LIST
/* A list of triangles that may be tiny, and points. */
static void draw_list_tiny(const struct smear_raster_frame *frame, const struct smear_raster_target *target, uint32_t head)
{
    bool moved = target->over, suits = false, tiny = true;
    uint32_t segment = SMEAR_POINT;
    struct tiny_look look;
    struct points_plane points;
    const bool at_once = tiny_points(&points, frame, target), narrow = target_is_direct(target);
    bool loops = false;         /* tiny_loop draws */
#if TINY_TRIANGLES
    struct tiny_triangles triangles;
#endif
    while (head != SMEAR_NO_TRIANGLE) {
        const uint32_t number = head;
        const struct smear_triangle *t = bins_triangle(frame->bins, number);
        head = t->next;
        if (t->segment == SMEAR_POINT) {
            if (at_once)
                head = points_list(&points, number, narrow);
            else
                draw_point(frame, target, t, moved);
            continue;
        }
        const struct smear_segment *g = &frame->bins->segment[t->segment];
        const int32_t *v[3];
        if (t->segment != segment) {
            segment = t->segment;
            tiny = suits = tiny_look(&look, frame, target, g);
#if SMEAR_FLAT_LIST
            if (suits && !look.box.shaded) {
                head = draw_flat_ones(frame, target, &look, at_once ? &points : NULL, number, &moved);
                continue;
            }
#endif
#if TINY_TRIANGLES
            loops = suits && at_once && tiny_loop(&triangles, &look, &points, frame->bins, g);
#endif
        }
#if TINY_TRIANGLES
        if (loops && (tiny || (number & 3u) == 0) && draw_tiny_ones(&triangles, number, &head, &tiny))
            continue;
#endif
        for (int i = 0; i < 3; i++)
            v[i] = bins_vertex(frame->bins, g, t->vertex[i]);
        /* After one that is large, some are not even looked at. */
        if (!loops)
            tiny = suits && (tiny || (number & 3u) == 0) && tiny_draw(&look, v, t->color);
        if (!tiny)
            draw_triangle(frame, target, g, t->color, number, v, NULL, &moved);
    }
}
#endif

#if SMEAR_FRONT_ORDER
/* Draws so many triangles in the target's order. */
static SMEAR_NOINLINE void draw_from_front(const struct smear_raster_frame *frame, const struct smear_raster_target *target, uint32_t n)
{
    const uint16_t *const order = front_order_of(&target->cache);
    bool moved = target->over;
    for (uint32_t i = 0, hidden = 0; i < n; i++) {
        const uint32_t number = order[i];
        const struct smear_triangle *t = bins_triangle(frame->bins, number);
        /* Where few are hidden, only some are looked at. */
        if ((8 * hidden + 32 > i || (i & 3u) == 0) && smear_front_hides(frame, target, t))
            hidden++;
        else
            draw_entry(frame, target, t, number, &moved, false);
    }
}
#endif

void smear_raster_list(const struct smear_raster_frame *frame, const struct smear_raster_target *target, uint32_t head)
{
#if SMEAR_KEPT_LISTS
    kept_list_begin(target);
#endif
#if SMEAR_AVX2
    if (!frame_has_fog(frame) && (head != SMEAR_NO_TRIANGLE || kept_list_seen(&target->cache)->first != 0) && tiny8_suit(target)) {
        draw_list_tiny8(frame, target, head);
        return;
    }
#endif
#if SMEAR_FRONT_ORDER
    const uint32_t ordered = smear_front_order(frame, target, head);
    if (ordered != 0) {
        draw_from_front(frame, target, ordered);
        return;
    }
#endif
#if SMEAR_TINY_LIST
    if (tiny_list_suits(frame, target)) {
        draw_list_tiny(frame, target, head);
        return;
    }
#endif
    if (HAS_LOOP_FOR_FOG && frame_has_fog(frame))
        draw_list(frame, target, head, true);
    else
        draw_list(frame, target, head, false);
}

#if SMEAR_WITH_WORKERS && SMEAR_WITH_SUBFRAMES
void smear_raster_numbers(const struct smear_raster_frame *frame, const struct smear_raster_target *target,
                          const uint32_t *number, uint32_t count)
{
    const bool in_fog = HAS_LOOP_FOR_FOG && frame_has_fog(frame);
    bool moved = target->over;
#if SMEAR_KEPT_LISTS
    kept_list_begin(target);
#endif
    for (uint32_t i = 0; i < count; i++)
        draw_entry(frame, target, bins_triangle(frame->bins, number[i]), number[i], &moved, in_fog);
}
#endif

void smear_raster_triangle(const struct smear_raster_frame *frame, const struct smear_raster_target *target,
                           const struct smear_segment *segment, uint32_t color, const int32_t *const v[3],
                           const struct bounds *bounds)
{
    bool moved = false;
#if SMEAR_FLAT_LIST && !SMEAR_FLAT_ENTRIES
    if (flat_list_suits(frame, target, segment) && smear_flat_triangle(target, v, color, bounds, false, SMEAR_NO_TRIANGLE))
        return;
#endif
    if (HAS_LOOP_FOR_FOG && frame_has_fog(frame))
        draw_in_fog(frame, target, segment, color, SMEAR_NO_TRIANGLE, v, bounds, &moved);
    else
        draw_triangle(frame, target, segment, color, SMEAR_NO_TRIANGLE, v, bounds, &moved);
}
