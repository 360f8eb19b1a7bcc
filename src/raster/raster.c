/* SPDX-License-Identifier: MIT */
/* raster.c - triangles of lists, in order, each in one of five forms: a point, which assembly has finished; a box of few pixels without
 * a texture (tiny_draw.h), or with one (few_draw.h); rows of one colour (cover.h); all others, which are made ready (setup.c), covered
 * (cover.c), and kept where they go on in the next rows. */
#include "raster/raster.h"

#include "base/pixel.h"
#include "kernels/kernels.h"
#include "raster/cover.h"
#include "raster/fog.h"
#include "raster/kept.h"
#include "raster/span.h"

/* ------------------------------------------------------------------ points */

/* A finished pixel; in fog there are none. */
static inline void draw_point(const struct smear_raster_frame *frame,
                              const struct smear_raster_target *target, const struct smear_triangle *t,
                              bool moved)
{
    const int32_t x = t->vertex[POINT_X], y = t->vertex[POINT_Y];
    if (x < target->x0 || x >= target->x1 || y < target->y0 || y >= target->y1)
        return;
    const int32_t at = target_row(&target->window_rows, target, y) + x;
    if (t->vertex[POINT_DEPTH] <= target->depth[at])
        return;
    target->depth[at] = t->vertex[POINT_DEPTH];
    target_put(target, at, t->color);
    if (moved && target_has_velocity(target))
        smear_velocity_still(target, at, frame_has_depth_velocity(frame));
}

/* ------------------------------------------------------------------ a triangle */

static inline bool has_levels(const struct setup *s)
{
    return SMEAR_WITH_TEXTURE && SMEAR_WITH_BOUNDS && segment_textured(s->segment) && s->draw->sampler.levels != 0;
}

static inline void start(struct setup *s, const struct smear_raster_frame *frame, const struct smear_raster_target *target,
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

/* Draws a textured triangle of few pixels; of a smaller level if it has one. False where it needs gradients. */
static bool draw_textured(const struct smear_raster_pass *p, const struct setup *s)
{
    struct few_look look = p->texels;
    if (s->draw != look.draw)
        smear_few_take(&look, s->frame, s->target, s->segment, s->draw);
    return smear_few_draw(&look, s->target, s->v, s->color, s);
}

/* Draws a triangle of few pixels. False where it needs gradients. */
static inline bool draw_few(struct smear_raster_pass *p, const struct setup *s, int32_t pixels, const struct pixel_box *box)
{
    if (SMEAR_WITH_TEXTURE && p->textured)
        return !p->few && pixels != INT32_MAX && !fog_varies(s) && draw_textured(p, s);
    if (pixels > TINY_PIXELS || !p->boxed)
        return false;
    const struct tiny_depths depths = tiny_depths_of(s->v);
    if (fog_varies(s) || !tiny_suits(&p->box, &depths))
        return false;
    if (setup_writes_velocity(s))
        smear_velocity_tiny(&p->box, s, box, &depths);
    else
        smear_tiny_box(&p->box, s->target, s->v, s->color, box, &depths, s);
    return true;
}

/* Whether all of the target's columns of rows [top, bottom) lie beyond one of a triangle's edges, in whole pixels, each of which may be
 * one too low. A large one that does not fit into them often is elsewhere, and ready in vain. */
static inline bool is_beyond_edge(const struct smear_raster_target *t, const int32_t *const v[3], int32_t top, int32_t bottom)
{
    for (int i = 0; i < 3; i++) {
        const int32_t *const a = v[i], *const b = v[i == 2 ? 0 : i + 1];
        const int32_t dx = (b[VERTEX_X] - a[VERTEX_X]) >> 8, dy = (b[VERTEX_Y] - a[VERTEX_Y]) >> 8;
        const int32_t x = (dy >= 0 ? t->x0 : t->x1) - (a[VERTEX_X] >> 8), y = (dx >= 0 ? bottom : top) - (a[VERTEX_Y] >> 8);
        const int32_t apart = abs_i32(dx) + abs_i32(dy), off = abs_i32(x) + abs_i32(y);
        if (max_i32(apart, off) >= 1 << 15)         /* far beyond the guard band: products would not fit */
            return false;
        if (dx * y - dy * x + apart + off + 2 < 0)
            return true;
    }
    return false;
}

/* Draws a triangle, whatever it is, with these vertices, and this box of them where it is given. `number`: by which it is kept for the
 * rows below, or SMEAR_NO_TRIANGLE. */
static SMEAR_NOINLINE void draw_any(struct smear_raster_pass *p, uint32_t color, uint32_t number, const int32_t *const v[3],
                                    const struct bounds *given)
{
    const struct smear_raster_target *const target = p->target;
    const struct bounds bounds = given != NULL ? *given : bounds_of(v[0], v[1], v[2]);
    const int32_t left = (bounds.x0 + 127) >> 8, right = (bounds.x1 + 127) >> 8;
    const int32_t top = (bounds.y0 + 127) >> 8, bottom = (bounds.y1 + 127) >> 8;
    const int32_t most = segment_textured(p->segment) ? (int32_t)FEW_PX : (int32_t)SMALL_PX;
    const bool small = right - left <= most && bottom - top <= most;
    const int32_t pixels = small ? (right - left) * (bottom - top) : INT32_MAX;
    if (max_i32(left, target->x0) >= min_i32(right, target->x1))
        return;
    const bool continues = top < target->y0, goes_on = bottom > target->y1;
    const struct pixel_box box = { left, right, max_i32(top, target->y0), min_i32(bottom, target->y1) };
    if (box.top >= box.bottom)
        return;
    if (!SMEAR_SMALL_CODE && !small && (left < target->x0 || right > target->x1) && is_beyond_edge(target, v, box.top, box.bottom))
        return;

    bool known;
    struct kept *const kept = find_kept(target, number, continues, goes_on, &known);
    struct setup s;
    struct smear_raster_draw smaller;
    start(&s, p->frame, target, p->segment, color, v);
    const uint64_t area = !known ? setup_edges(&s) : 1;
    SMEAR_ASSERT((int64_t)area > 0);
    if (known) {
        smear_kept_take(kept, &s);
        leave_kept(kept, goes_on);
    } else {
        s.bounds = bounds;
        start_fog(&s, frame_has_fog(p->frame));
    }
    start_velocity(&s, &p->moved);
    if (!known) {
        if (has_levels(&s))
            smear_setup_level(&s, area, &smaller);
        if (draw_few(p, &s, pixels, &box))
            return;
        smear_setup(&s, area);
    } else if (has_levels(&s)) {
        smear_setup_shrink(&s, &smaller);
    }
    if (!known || SMEAR_DIRECT)         /* rows above may have been pixels of another kind */
        smear_cover_choose(&s, small);
    const bool is_new = make_velocity(&s) || !known;
    if (is_new && kept != NULL && goes_on)
        smear_kept_keep(kept, &s, number, bottom);
    smear_cover(&s, &box, small);
}

/* ------------------------------------------------------------------ lists */

void smear_raster_begin(struct smear_raster_pass *p, const struct smear_raster_frame *frame, const struct smear_raster_target *target)
{
    p->frame = frame;
    p->target = target;
    p->segment = NULL;
    p->moved = target->over;
    if (!HAS_FLAT_ROWS)
        return;
    p->whole = target->x0 <= 0 && target->x1 >= frame->width;
    p->keeps = p->whole && target->cache.entries != 0 && (target->y0 > 0 || target->y1 < frame->height);
}

/* Finds out how a segment's triangles are drawn. Where pixels say more than colour and depth, or are in fog, each is asked for itself. */
static SMEAR_NOINLINE void take_segment(struct smear_raster_pass *p, const struct smear_segment *segment)
{
    p->segment = segment;
    const struct smear_raster_draw *const draw = &p->frame->draw[segment->draw];
    p->boxed = tiny_look_take(&p->box, p->frame, p->target, segment);
    p->textured = smear_few_take(&p->texels, p->frame, p->target, segment, draw);
    p->few = HAS_FLAT_ROWS && p->textured && !frame_has_fog(p->frame) && !target_has_velocity(p->target)
          && !(SMEAR_WITH_BOUNDS && draw->sampler.levels != 0);
    if (!HAS_FLAT_ROWS)
        return;
    p->shadow = draw_is_shadow(draw) && !segment_textured(segment) && !segment_gouraud(segment) && !frame_has_fog(p->frame)
             && !target_has_velocity(p->target) && target_is_opaque(p->target);
    p->plain = p->boxed && !frame_has_fog(p->frame) && !target_has_velocity(p->target);
    p->flat = p->plain && !p->box.box.shaded;
    p->goes_on = SMEAR_RASTER_CACHE && p->flat && p->keeps;
    p->tiny = p->plain;
}

/* Draws a triangle of the pass's segment. After one that is large, some are not even looked at for being tiny: those that are come to
 * draw_any. */
SMEAR_INLINE void draw_triangle(struct smear_raster_pass *p, uint32_t color, uint32_t number, const int32_t *const v[3],
                                const struct bounds *given, bool looks)
{
    if (HAS_FLAT_ROWS && p->plain) {
        p->tiny = (p->tiny || looks) && smear_tiny_draw(&p->box, p->target, v, color);
        if (p->tiny || (p->flat && smear_flat_triangle(p->target, v, color, given, p->whole, p->keeps ? number : SMEAR_NO_TRIANGLE)))
            return;
    }
    if (SMEAR_WITH_TEXTURE && p->few && smear_few_draw(&p->texels, p->target, v, color, NULL))
        return;
    if (HAS_FLAT_ROWS && p->shadow)
        smear_flat_shadow(p->target, v, color, frame_transfer(p->frame));
    else
        draw_any(p, color, number, v, given);
}

void smear_raster_triangle(struct smear_raster_pass *p, const struct smear_segment *segment, uint32_t color, const int32_t *const v[3],
                           const struct bounds *bounds)
{
    if (segment != p->segment)
        take_segment(p, segment);
    draw_triangle(p, color, SMEAR_NO_TRIANGLE, v, bounds, true);
}

/* Draws a triangle that is no point. */
SMEAR_INLINE_ALWAYS void draw_listed(struct smear_raster_pass *p, const struct smear_triangle *t, uint32_t number)
{
    const struct smear_bins *const bins = p->frame->bins;
    const struct smear_segment *const segment = &bins->segment[t->segment];
    if (segment != p->segment)
        take_segment(p, segment);
    if (HAS_FLAT_ROWS && p->goes_on && smear_flat_go_on(p->target, number))
        return;
    const int32_t *const v[3] = { bins_vertex(bins, segment, t->vertex[0]), bins_vertex(bins, segment, t->vertex[1]),
                                  bins_vertex(bins, segment, t->vertex[2]) };
    draw_triangle(p, t->color, number, v, NULL, (number & 3u) == 0);
}

/* Draws `count` triangles of the target's order, from the front, but for what is hidden. Where few are, only some are looked at. */
static SMEAR_NOINLINE void draw_ordered(struct smear_raster_pass *p, uint32_t count, const struct smear_between *between)
{
    const uint16_t *const order = front_order_of(&p->target->cache);
    uint16_t least[FRONT_BLOCKS] = { 0 };
    uint32_t hidden = 0;
    for (uint32_t i = 0; i < count; i++) {
        const struct smear_triangle *const t = bins_triangle(p->frame->bins, order[i]);
        between_triangles(between, i);
        if ((8 * hidden + 32 > i || (i & 3u) == 0) && smear_front_hides(p->frame, p->target, t, least))
            hidden++;
        else
            draw_listed(p, t, order[i]);
    }
}

SMEAR_INLINE_ALWAYS void draw_any_list(const struct smear_raster_frame *frame, const struct smear_raster_target *target,
                                       struct smear_list list, const struct smear_between *between)
{
    struct smear_raster_pass p;
    const uint32_t ordered = SMEAR_FRONT_ORDER ? smear_front_order(frame, target, list) : 0;
    smear_raster_begin(&p, frame, target);
    if (ordered != 0) {
        draw_ordered(&p, ordered, between);
        return;
    }
    uint32_t i = 0;
    for (uint32_t number; (number = list_first(&list)) != SMEAR_NO_TRIANGLE; i++) {
        const struct smear_triangle *const t = bins_triangle(frame->bins, number);
        between_triangles(between, i);
        list_next(&list, t);
        if (t->segment != SMEAR_POINT)
            draw_listed(&p, t, number);
        else
            draw_point(frame, target, t, p.moved);
    }
}

static SMEAR_NOINLINE void draw_list(const struct smear_raster_frame *frame, const struct smear_raster_target *target, uint32_t head)
{
    draw_any_list(frame, target, (struct smear_list){ head, NULL, NULL }, NULL);
}

void smear_raster_list(const struct smear_raster_frame *frame, const struct smear_raster_target *target, uint32_t head)
{
    draw_list(frame, target, head);
}

#if SMEAR_POOL_PARTS
void smear_raster_numbers(const struct smear_raster_frame *frame, const struct smear_raster_target *target,
                          const uint32_t *number, uint32_t count, const struct smear_between *between)
{
    draw_any_list(frame, target, (struct smear_list){ SMEAR_NO_TRIANGLE, number, number + count }, between);
}
#endif
