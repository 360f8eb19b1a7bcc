/* SPDX-License-Identifier: MIT */
/* subframe_pose.c - a triangle of some tiles at an instant: its vertices along their paths. */
#include "temporal/subframe_tile.h"

#include "base/fixmath.h"
#include "geometry/transform.h"

/* Shifts the vertices along an axis. */
static SMEAR_RARE void shift_along(struct posed *p, const struct smear_bins *g, const struct smear_triangle *t, int axis, int32_t shift)
{
    for (int i = 0; i < 3; i++)
        if (path_is_shifted(bins_vertex(g, p->segment, t->vertex[i]) + p->segment->motion, axis))
            p->record[i].word[axis] += shift;
}

/* Keeps the vertices within the guard band, of which (x, y) is the middle. */
static SMEAR_RARE void keep_within(struct posed *p, int32_t x, int32_t y, int32_t guard)
{
    for (int i = 0; i < 3; i++) {
        p->record[i].word[VERTEX_X] = clamp_i32(p->record[i].word[VERTEX_X], x - guard, x + guard);
        p->record[i].word[VERTEX_Y] = clamp_i32(p->record[i].word[VERTEX_Y], y - guard, y + guard);
    }
    p->bounds = bounds_of(p->v[0], p->v[1], p->v[2]);
}

/* Makes the vertices' records, and their box in `bounds`. Between places within the guard band a parabola may leave it. */
static inline void place(struct posed *p, const struct subframes *f, const struct smear_triangle *t, int32_t u)
{
    const struct smear_raster_frame *frame = f->t->frame;
    const struct smear_segment *s = p->segment;
    const int32_t guard = SMEAR_GUARD_PX << 8, x = frame->width << 7, y = frame->height << 7;       /* the middle of the frame */
    int32_t box[4];
    for (int i = 0; i < 3; i++)
        p->v[i] = p->record[i].word;
    path_triangle(box, p->record, bins_vertex(frame->bins, s, 0), t->vertex, s->motion, u);
    p->bounds = (struct bounds){ box[0], box[1], box[2], box[3] };
    if (SMEAR_EDGES && (f->shift[VERTEX_X] | f->shift[VERTEX_Y]) != 0) {
        shift_along(p, frame->bins, t, VERTEX_X, f->shift[VERTEX_X]);
        shift_along(p, frame->bins, t, VERTEX_Y, f->shift[VERTEX_Y]);
        p->bounds = bounds_of(p->v[0], p->v[1], p->v[2]);
    }
    const struct bounds *const b = &p->bounds;
    if (((b->x0 - x + guard) | (x + guard - b->x1) | (b->y0 - y + guard) | (y + guard - b->y1)) < 0)
        keep_within(p, x, y, guard);
}

/* Takes vertices as they are. */
static inline void take(struct posed *p, const struct smear_bins *g, const struct smear_triangle *t)
{
    for (int i = 0; i < 3; i++)
        p->v[i] = bins_vertex(g, p->segment, t->vertex[i]);
    p->bounds = bounds_of(p->v[0], p->v[1], p->v[2]);
}

static SMEAR_RARE void clamp_depths(struct posed *p)
{
    for (int i = 0; i < 3; i++)
        p->record[i].word[VERTEX_DEPTH] = clamp_i32(p->record[i].word[VERTEX_DEPTH], SMEAR_DEPTH_MIN, SMEAR_DEPTH_MAX);
}

/* Completes the records of a triangle that is seen. */
static inline void complete(struct posed *p, const struct smear_bins *g, const struct smear_triangle *t)
{
    const struct smear_segment *s = p->segment;
    const uint32_t usual = 1u << 30;        /* depths that need no clamp are less beyond the least */
    SMEAR_STATIC_ASSERT(SMEAR_DEPTH_MAX - SMEAR_DEPTH_MIN >= (1 << 30), "depths that are usual are within the range");
    const uint32_t any = (uint32_t)(p->record[0].word[VERTEX_DEPTH] - SMEAR_DEPTH_MIN)
                       | (uint32_t)(p->record[1].word[VERTEX_DEPTH] - SMEAR_DEPTH_MIN)
                       | (uint32_t)(p->record[2].word[VERTEX_DEPTH] - SMEAR_DEPTH_MIN);
    if (any >= usual)
        clamp_depths(p);
    if (s->motion == VERTEX_BASE_WORDS)
        return;
    for (int i = 0; i < 3; i++)         /* all that there may be: the path behind it has as many words */
        __builtin_memcpy(p->record[i].word + VERTEX_BASE_WORDS, bins_vertex(g, s, t->vertex[i]) + VERTEX_BASE_WORDS,
                         sizeof p->record[i].word - VERTEX_BASE_WORDS * sizeof p->record[i].word[0]);
}

static inline bool is_turned_away(const int32_t *a, const int32_t *b, const int32_t *c)
{
    const int32_t x1 = b[VERTEX_X] - a[VERTEX_X], y1 = b[VERTEX_Y] - a[VERTEX_Y];
    const int32_t x2 = c[VERTEX_X] - a[VERTEX_X], y2 = c[VERTEX_Y] - a[VERTEX_Y];
    return edges_area(x1, y1, x2, y2) <= 0;
}

/* Finds the box of the vertices within the tiles. False where it is empty, or they are turned away. */
static inline bool find_box(struct posed *p, const struct subframes *f, bool turns)
{
    const struct smear_raster_target *tile = &f->work;
    const struct bounds *const b = &p->bounds;
    p->box = (struct subframe_box){ max_i32((b->x0 + 127) >> 8, tile->x0), max_i32((b->y0 + 127) >> 8, tile->y0),
                                    min_i32((b->x1 + 127) >> 8, tile->x1), min_i32((b->y1 + 127) >> 8, tile->y1) };
    return !subframe_box_is_empty(&p->box) && !(turns && is_turned_away(p->v[0], p->v[1], p->v[2]));
}

bool smear_subframe_pose_next(struct posed *p, const struct subframes *f)
{
    for (int i = p->next; i < p->count; i++) {
        p->v[0] = p->record[0].word;
        p->v[1] = p->record[i - 1].word;
        p->v[2] = p->record[i].word;
        p->bounds = bounds_of(p->v[0], p->v[1], p->v[2]);
        p->next = i + 1;
        if (find_box(p, f, true))
            return true;
    }
    return false;
}

/* Poses a triangle in space, of which some may be left. */
static SMEAR_NOINLINE bool pose_in_space(struct posed *p, const struct subframes *f, const struct smear_triangle *t,
                                         const struct smear_path_bounds *b, int32_t u)
{
    const struct smear_raster_frame *frame = f->t->frame;
    const int32_t *const record[3] = { bins_vertex(frame->bins, p->segment, t->vertex[0]),
                                       bins_vertex(frame->bins, p->segment, t->vertex[1]),
                                       bins_vertex(frame->bins, p->segment, t->vertex[2]) };
    if (f->space->segment != p->segment)
        smear_space_make(f->space, frame->bins, p->segment, frame->width, frame->height);
    p->count = smear_space_pose(p->record, f->space, record, b->space, u, f->shift);
    p->next = 2;
    const bool seen = smear_subframe_pose_next(p, f);
    SMEAR_ASSERT(!seen || (p->box.x0 >= b->x0 && p->box.x1 <= b->x1 && p->box.y0 >= b->y0 && p->box.y1 <= b->y1));
    if (seen)
        f->space->seen |= 1u << (p->segment->draw & 31u);
    return seen;
}

bool smear_subframe_pose(struct posed *p, const struct subframes *f, uint32_t triangle, int32_t time)
{
    const struct smear_bins *g = f->t->frame->bins;
    const struct smear_triangle *t = bins_triangle(g, triangle);
    const struct smear_segment *s = &g->segment[t->segment];
    p->segment = s;
    p->color = t->color;
    p->next = p->count = 0;
    bool moves = false;
    if (s->path) {
        const struct smear_path_bounds *b = bins_bounds(g, triangle);
        if (b->space != 0)
            return pose_in_space(p, f, t, b, path_phase(time));
        /* In the middle, vertices are where their records say. */
        moves = time != SHUTTER_CLOSE / 2 || (SMEAR_EDGES && (f->shift[VERTEX_X] | f->shift[VERTEX_Y]) != 0);
        if (moves)
            place(p, f, t, path_phase(time));
    }
    if (!moves)
        take(p, g, t);
    if (!find_box(p, f, s->path != 0))
        return false;
    if (moves)
        complete(p, g, t);
    return true;
}
