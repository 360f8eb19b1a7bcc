/* SPDX-License-Identifier: MIT */
/* raster.c - lists of triangles: which are drawn pixel by pixel, which are made ready for their rows (setup.c) and covered
 * (cover.c), and what is kept of those that go on in the next rows. */
#include "raster/raster.h"

#include "raster/cover_texels.h"
#include "raster/cover_tiny8.h"
#include "raster/fog.h"
#include "raster/kept.h"
#include "raster/span.h"
#include "raster/tiny_list.h"

/* ------------------------------------------------------------------ a triangle */

enum { ENTRIES_MAX = 512 };

static inline struct kept *entry_at(const struct smear_raster_cache *cache, uint32_t i)
{
    return (struct kept *)(void *)((uint8_t *)cache->entry + (size_t)i * cache->entry_bytes);
}

struct smear_raster_cache smear_raster_cache_make(void *memory, size_t bytes, int count, const struct smear_bins *bins)
{
    uint32_t entry_bytes = sizeof(struct kept);
    for (uint32_t i = 0; i < bins->segment_count; i++)
        entry_bytes = max_u32(entry_bytes, (uint32_t)kept_bytes(&bins->segment[i]));
    const uint32_t entries = min_u32((uint32_t)(bytes / entry_bytes), ENTRIES_MAX) / (uint32_t)count;
    const struct smear_raster_cache cache = { memory, (uint16_t)entries, (uint16_t)entry_bytes };
    for (uint32_t i = 0; i < entries * (uint32_t)count; i++)
        entry_at(&cache, i)->triangle = SMEAR_NO_TRIANGLE;
    return cache;
}

struct smear_raster_cache smear_raster_cache_of(const struct smear_raster_cache *first, int i)
{
    return (struct smear_raster_cache){ entry_at(first, (uint32_t)i * first->entries), first->entries, first->entry_bytes };
}

enum { PROBES = 16 };

/* Whether an entry keeps nothing that rows from the target's on need. */
static inline bool entry_is_free(const struct kept *entry, const struct smear_raster_target *target)
{
    return entry->triangle == SMEAR_NO_TRIANGLE || entry->end <= target->y0;
}

/* The entry of a triangle that continues rows above the target's or goes on below them; null for others, and where all
 * entries that it may have are others' still. `known`: it holds the triangle's setup. */
static inline struct kept *cache_find(const struct smear_raster_target *target, uint32_t triangle,
                                      bool continues, bool goes_on, bool *known)
{
    *known = false;
    if (!SMEAR_RASTER_CACHE || target->cache.entries == 0 || !(continues || goes_on))
        return NULL;
    struct kept *free = NULL;
    uint32_t at = (triangle * 40503u & 0xffffu) * target->cache.entries >> 16;
    for (int i = 0; i < PROBES; i++) {
        struct kept *entry = entry_at(&target->cache, at);
        if (continues && entry->triangle == triangle) {
            *known = true;
            return entry;
        }
        if (free == NULL && entry_is_free(entry, target)) {
            free = entry;
            if (!continues)
                break;
        }
        if (++at == target->cache.entries)
            at = 0;
    }
    return goes_on ? free : NULL;
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

static inline bool has_levels(const struct setup *s)
{
    return SMEAR_WITH_TEXTURE && SMEAR_WITH_BOUNDS && segment_textured(s->segment) && s->draw->sampler.levels != 0;
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
    struct bounds bounds;
    if (given != NULL)
        bounds = *given;
    else
        bounds = bounds_of(v);
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
    struct kept *const kept = cache_find(target, triangle, continues, goes_on, &known);
    struct setup s;
    struct smear_raster_draw smaller;
    start(&s, frame, target, segment, color, v);
    const uint64_t area = !known || small ? setup_edges(&s) : 1;   /* large ones are covered without edge vectors */
    SMEAR_ASSERT((int64_t)area > 0);
    if (known) {
        kept_take(kept, &s);
        if (!goes_on)
            kept->triangle = SMEAR_NO_TRIANGLE;
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
        if (has_levels(&s))
            smear_setup_shrink(&s, &smaller);
        if (cover_is_narrow(target))
            smear_cover_choose(&s, small);
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

/* A finished pixel; in fog there are none. */
static inline void draw_point(const struct smear_raster_frame *frame,
                              const struct smear_raster_target *target, const struct smear_triangle *t,
                              bool moved)
{
    int32_t x = t->vertex[POINT_X], y = t->vertex[POINT_Y] - target->y0;
    if (x < target->x0 || x >= target->x1 || (uint32_t)y >= (uint32_t)(target->y1 - target->y0))
        return;
    int32_t ring_row = target->window_rows.ring_row + y;
    if (ring_row >= target->window_rows.ring)
        ring_row -= target->window_rows.ring;
    int32_t at = ring_row * target->window_rows.stride + x - target->window_rows.x0;
    if (t->vertex[POINT_DEPTH] <= target->depth[at])
        return;
    target->depth[at] = t->vertex[POINT_DEPTH];
    target_put(target, at, t->color);
    if (moved && target_has_velocity(target))
        smear_velocity_still(target, at, frame_has_depth_velocity(frame));
}

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
    bool moved = target->over;
    while (head != SMEAR_NO_TRIANGLE) {
        const uint32_t number = head;
        const struct smear_triangle *t = bins_triangle(frame->bins, number);
        head = t->next;
        draw_entry(frame, target, t, number, &moved, in_fog);
    }
}

#if SMEAR_AVX2
/* Copies up to eight triangles of one segment, from `head` on, but for points. Returns how many. */
static inline int take_tiny8(const struct smear_bins *bins, uint32_t head, uint16_t vertex[8][4], uint32_t color[8])
{
    const uint16_t segment = bins_triangle(bins, head)->segment;
    int n = 0;
    do {
        const struct smear_triangle *t = bins_triangle(bins, head);
        head = t->next;
        if (t->segment == SMEAR_POINT)
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

/* Draws up to eight triangles of one segment, the first of which is `head`, and points among them. Returns what follows. */
static uint32_t draw_tiny8(const struct smear_raster_frame *frame, const struct smear_raster_target *target, uint32_t head,
                           const struct tiny8_look *look, bool *moved)
{
    struct tiny8_pixels pixels;
    uint16_t vertex[8][4];
    uint32_t color[8];
    const int n = take_tiny8(frame->bins, head, vertex, color);
    smear_tiny8_avx2(&pixels, look, (const uint16_t(*)[4])vertex, color);
    int32_t start = 0;
    for (int k = 0; k < n;) {
        const uint32_t number = head;
        const struct smear_triangle *t = bins_triangle(frame->bins, number);
        head = t->next;
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
    bool moved = target->over, suits = false;
    uint32_t segment = SMEAR_POINT;
    struct tiny8_look look;
    while (head != SMEAR_NO_TRIANGLE) {
        const uint32_t number = head;
        const struct smear_triangle *t = bins_triangle(frame->bins, number);
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
        }
        for (int i = 0; i < 3; i++)
            v[i] = bins_vertex(frame->bins, g, t->vertex[i]);
        /* After one that is large, some are not even looked at. */
        if (suits && (tiny || (number & 3u) == 0))
            tiny = tiny_draw(&look, v, t->color);
        else
            tiny = false;
        if (!tiny)
            draw_triangle(frame, target, g, t->color, number, v, NULL, &moved);
    }
}
#endif

void smear_raster_list(const struct smear_raster_frame *frame, const struct smear_raster_target *target, uint32_t head)
{
#if SMEAR_AVX2
    if (!frame_has_fog(frame) && head != SMEAR_NO_TRIANGLE && tiny8_suit(target)) {
        draw_list_tiny8(frame, target, head);
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
    if (HAS_LOOP_FOR_FOG && frame_has_fog(frame))
        draw_in_fog(frame, target, segment, color, SMEAR_NO_TRIANGLE, v, bounds, &moved);
    else
        draw_triangle(frame, target, segment, color, SMEAR_NO_TRIANGLE, v, bounds, &moved);
}
