/* SPDX-License-Identifier: MIT */
/* subframe_pose.c - a triangle of some tiles at an instant: its vertices along their paths. */
#include "temporal/subframe_pose.h"

#include "base/fixmath.h"
#include "geometry/transform.h"

struct range {
    int32_t low, high;
};

static inline struct range range_of(int32_t a, int32_t b, int32_t c)
{
    return (struct range){ min_i32(a, min_i32(b, c)), max_i32(a, max_i32(b, c)) };
}

/* Pixels of [low, high) whose centres may lie in a range of q8. */
static inline struct range pixels_of(struct range r, int32_t low, int32_t high)
{
    return (struct range){ max_i32((r.low + 127) >> 8, low), min_i32((r.high + 127) >> 8, high) };
}

/* Whether a vertex whose places at open and close are given is shifted along an axis from instant to instant. Along its way
 * it moves by itself, and steps that were not even would show; a way below two pixels does not do for that. */
static inline bool is_shifted(const int32_t *open, int axis)
{
    const int32_t *close = open + PATH_POSE_WORDS;
    const int32_t along = abs_i32(close[axis] - open[axis]);
    return along < 512 || along < abs_i32(close[1 - axis] - open[1 - axis]);
}

static inline struct range range_along(const struct posed *p, int axis)
{
    return range_of(p->record[0][axis], p->record[1][axis], p->record[2][axis]);
}

/* Shifts the vertices along an axis and returns their range. Between places within the guard band a parabola may leave it.
 * `middle`: of the frame. */
static inline struct range place_along(struct posed *p, const struct subframes *f, int axis, int32_t middle)
{
    const int32_t guard = SMEAR_GUARD_PX << 8;
    if (SMEAR_EDGES && f->shift[axis] != 0)
        for (int i = 0; i < 3; i++)
            if (is_shifted(p->v[i] + p->segment->motion, axis))
                p->record[i][axis] += f->shift[axis];
    struct range r = range_along(p, axis);
    if (r.low >= middle - guard && r.high <= middle + guard)
        return r;
    for (int i = 0; i < 3; i++)
        p->record[i][axis] = clamp_i32(p->record[i][axis], middle - guard, middle + guard);
    return range_along(p, axis);
}

static inline bool is_turned_away(const int32_t *a, const int32_t *b, const int32_t *c)
{
    const int32_t x1 = b[VERTEX_X] - a[VERTEX_X], y1 = b[VERTEX_Y] - a[VERTEX_Y];
    const int32_t x2 = c[VERTEX_X] - a[VERTEX_X], y2 = c[VERTEX_Y] - a[VERTEX_Y];
#if !SMEAR_HAS_MUL64
    const uint32_t small = 1 << 15;
    if ((((uint32_t)x1 + small) | ((uint32_t)y1 + small) | ((uint32_t)x2 + small) | ((uint32_t)y2 + small))
        < 2 * small)
        return x1 * y2 <= x2 * y1;
#endif
    return (int64_t)x1 * y2 <= (int64_t)x2 * y1;
}

bool smear_subframe_pose(struct posed *p, const struct subframes *f, uint32_t triangle, int32_t time)
{
    const struct smear_raster_frame *frame = f->t->frame;
    const struct smear_triangle *t = bins_triangle(frame->bins, triangle);
    const struct smear_segment *s = &frame->bins->segment[t->segment];
    const struct smear_raster_target *tile = &f->t->background;
    p->segment = s;
    p->color = t->color;
    if (s->path && !path_interval_time(&time, bins_bounds(frame->bins, triangle)->interval))
        return false;
    for (int i = 0; i < 3; i++)
        p->v[i] = bins_vertex(frame->bins, s, t->vertex[i]);
    const int32_t u = path_phase(time);
    /* In the middle, vertices are where their records say. */
    const bool moves = s->path && (u != 0 || (SMEAR_EDGES && (f->shift[VERTEX_X] | f->shift[VERTEX_Y]) != 0));
    struct range x, y;
    if (moves) {
        for (int i = 0; i < 3; i++)
            path_place(p->record[i], p->v[i], p->v[i] + s->motion, u);
        x = place_along(p, f, VERTEX_X, frame->width << 7);
        y = place_along(p, f, VERTEX_Y, frame->height << 7);
    } else {
        x = range_of(p->v[0][VERTEX_X], p->v[1][VERTEX_X], p->v[2][VERTEX_X]);
        y = range_of(p->v[0][VERTEX_Y], p->v[1][VERTEX_Y], p->v[2][VERTEX_Y]);
    }
    const struct range columns = pixels_of(x, tile->x0, tile->x1), rows = pixels_of(y, tile->y0, tile->y1);
    if (columns.low >= columns.high || rows.low >= rows.high)
        return false;
    p->bounds = (struct bounds){ x.low, y.low, x.high, y.high };
    p->box = (struct subframe_box){ columns.low, rows.low, columns.high, rows.high };
    if (!s->path)
        return true;
    if (!moves)
        return !is_turned_away(p->v[0], p->v[1], p->v[2]);
    if (is_turned_away(p->record[0], p->record[1], p->record[2]))
        return false;
    for (int i = 0; i < 3; i++) {
        int32_t *record = p->record[i];
        record[VERTEX_DEPTH] = clamp_i32(record[VERTEX_DEPTH], SMEAR_DEPTH_MIN, SMEAR_DEPTH_MAX);
        for (int k = VERTEX_BASE_WORDS; k < s->motion; k++)
            record[k] = p->v[i][k];
        p->v[i] = record;
    }
    return true;
}
