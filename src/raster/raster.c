/* SPDX-License-Identifier: MIT */
/* raster.c - lists of triangles: which are drawn pixel by pixel, which are made ready for their rows (setup.c) and covered
 * (cover.c), and what is kept of those that go on in the next rows. */
#include "raster/raster.h"

#include "raster/cover_texels.h"
#include "raster/cover_tiny.h"
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
    struct setup s;
    struct smear_raster_draw smaller;
    start(&s, frame, target, segment, color, v);
    const uint64_t area = !known || small ? setup_edges(&s) : 1;   /* large ones are covered without edge vectors */
    SMEAR_ASSERT((int64_t)area > 0);
    if (known) {
        kept_take(kept, &s);
        leave_kept(kept, goes_on);
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
    } else if (has_levels(&s)) {
        smear_setup_shrink(&s, &smaller);
    }
    const bool is_new = make_velocity(&s) || !known;
    if (is_new && kept != NULL && goes_on)
        kept_keep(kept, &s, triangle, bottom);
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

#if SMEAR_TINY_LIST
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
            if (suits && !look.box.shaded) {
                head = draw_flat_ones(frame, target, &look, at_once ? &points : NULL, number, &moved);
                continue;
            }
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
    for (uint32_t i = 0; i < count; i++)
        draw_entry(frame, target, bins_triangle(frame->bins, number[i]), number[i], &moved, in_fog);
}
#endif

void smear_raster_triangle(const struct smear_raster_frame *frame, const struct smear_raster_target *target,
                           const struct smear_segment *segment, uint32_t color, const int32_t *const v[3],
                           const struct bounds *bounds)
{
    bool moved = false;
#if !SMEAR_FLAT_ENTRIES
    if (flat_list_suits(frame, target, segment) && smear_flat_triangle(target, v, color, bounds, false, SMEAR_NO_TRIANGLE))
        return;
#endif
    if (HAS_LOOP_FOR_FOG && frame_has_fog(frame))
        draw_in_fog(frame, target, segment, color, SMEAR_NO_TRIANGLE, v, bounds, &moved);
    else
        draw_triangle(frame, target, segment, color, SMEAR_NO_TRIANGLE, v, bounds, &moved);
}
