/* SPDX-License-Identifier: MIT */
/* timemask.c - a tile in blocks of pixels: its moving triangles one after the other, segment by segment of
 * the exposure, into time slots over the still scene; then their mean. */
#include "temporal/timemask.h"

#include "geometry/shutter.h"
#include "temporal/timemask_cover.h"
#include "temporal/timemask_shade.h"
#include "temporal/timemask_samples.h"
#include "temporal/timemask_spread.h"
#include "geometry/transform.h"

/* Paths are cut into chords: all of a block alike, so that neighbours agree at their edges. */
enum { SEGMENTS_MAX = 8, SEGMENTS_LOG2_MAX = 3 };

enum { PIXELS_LOG2 = 7, PIECES_LOG2 = 4 };     /* entries of a block, at most */

enum { SPARSE_LOG2_MAX = 2 };

enum {
    LISTED = 100,                               /* moving triangles that are drawn in order of depth */
    LOOK_EVERY = 4                              /* after so many it is seen whether the rest is hidden */
};

/* What the blocks of a tile share. */
struct job {
    const struct smear_moving_tile *tile;
    const struct smear_timemask_settings *settings;
    struct timemask_samples slots;
    uint32_t *list;                             /* depth code, then place in the
                                                 * tile's list from `first` on */
    uint32_t listed, first, next;
    int32_t segments_log2;
    int32_t slots_log2;                         /* of a segment */
    int32_t time[SEGMENTS_MAX + 1];             /* where segments meet */
    int32_t across_log2, down_log2;             /* px from a sample to the next */
    bool swapped;                               /* the block's rows run down: they are long where
                                                 * samples lie apart across */
    int32_t front, back;                        /* depth codes: no moving triangle is at or before, beyond this */
    int32_t x, y, last_x, last_y;               /* pixels of the block's first and last sample */
    int32_t width, height;                      /* its samples: in a row, rows */
    int32_t stride;                             /* from a row of entries to the next */
    bool even;                                  /* slots are */
    uint32_t fragments;
};

/* A moving triangle, looked up. */
struct moving {
    const struct smear_path_bounds *bounds;
    const struct smear_triangle *triangle;
    const struct smear_segment *segment;
    const int32_t *record[3];
};

static void moving_take(struct moving *m, const struct job *j, uint32_t i)
{
    const struct smear_bins *g = j->tile->frame->bins;
    uint32_t triangle = j->tile->moving[i].triangle;
    m->bounds = bins_bounds(g, triangle);
    m->triangle = bins_triangle(g, triangle);
    m->segment = &g->segment[m->triangle->segment];
    /* What is mirrored turns the other way round. */
    const int order[3] = { 0, j->swapped ? 2 : 1, j->swapped ? 1 : 2 };
    for (int k = 0; k < 3; k++)
        m->record[k] = bins_vertex(g, m->segment, m->triangle->vertex[order[k]]);
}

/* ------------------------------------------------------------------ order */

/* Shell sort, greatest first. */
static void sort_down(uint32_t *a, uint32_t n)
{
    static const uint8_t gaps[] = { 57, 23, 10, 4, 1 };
    for (uint32_t k = 0; k < sizeof gaps; k++) {
        uint32_t gap = gaps[k];
        for (uint32_t i = gap; i < n; i++) {
            uint32_t key = a[i], at = i;
            for (; at >= gap && a[at - gap] < key; at -= gap)
                a[at] = a[at - gap];
            a[at] = key;
        }
    }
}

/* Lists the tile's moving triangles from `next` on, as many as there is room for, the nearest first. What is merged in
 * a pixel is hardly ever hidden by what comes later then. */
static void list_moving(struct job *j)
{
    const struct smear_moving_tile *t = j->tile;
    j->first = j->next;
    j->listed = 0;
    for (; j->next < t->moving_count && j->next - j->first < 65536u && j->listed < LISTED; j->next++)
        if (moving_is_in(&t->moving[j->next], t)
            /* the last samples lie there */
            || (j->across_log2 != 0 && t->moving[j->next].first == t->column + 1))
            j->list[j->listed++] = (uint32_t)t->moving[j->next].nearest << 16
                                 | (65535u - (j->next - j->first));
    sort_down(j->list, j->listed);
}

static inline uint32_t listed_moving(const struct job *j, uint32_t i)
{
    return j->first + 65535u - (j->list[i] & 0xffffu);
}

/* ------------------------------------------------------------------ segments */

/* How far the shutter's slots lie off an even course within one of 2^log2 segments, q16 of the exposure. */
static int32_t shutter_bend(const struct smear_shutter_times *s, int log2)
{
    int step = SHUTTER_SAMPLES >> log2;
    int32_t worst = 0;
    for (int first = 0; first < SHUTTER_SAMPLES; first += step) {
        int32_t from = s->time[first], length = s->time[first + step] - from;
        for (int i = 1; i < step; i++)
            worst = max_i32(worst, abs_i32(s->time[first + i] - from - (length * i >> (5 - log2))));
    }
    return worst;
}

/* The fewest segments that do for all triangles of the tile, of the whole exposure. */
static void choose_segments(struct job *j)
{
    const struct smear_moving_tile *t = j->tile;
    int32_t curvature = 0, travel = 0;               /* q8 px */
    for (uint32_t i = 0; i < t->moving_count; i++) {
        const struct smear_path_bounds *b = bins_bounds(t->frame->bins, t->moving[i].triangle);
        if (moving_is_in(&t->moving[i], t) && b->interval == 0) {
            travel = max_i32(travel, b->travel << 4);
            curvature = max_i32(curvature, b->curvature << 3);
        }
    }
    curvature >>= 4;                                 /* what edges that follow parabolas leave of it, about */
    int log2 = 0;
    while (log2 < SEGMENTS_LOG2_MAX
           && (curvature >> (2 * log2) > j->settings->curvature
               || (!j->even && (int64_t)travel * shutter_bend(t->shutter, log2) >> 16 > j->settings->curvature)))
        log2++;
    j->segments_log2 = log2;
    j->slots_log2 = j->slots.slots_log2 - log2;
    for (int i = 0; i <= 1 << log2; i++)
        j->time[i] = t->shutter->time[i * (SHUTTER_SAMPLES >> log2)];
}

/* ------------------------------------------------------------------ samples */

/* How all moving triangles of a tile go. */
struct flow {
    int32_t least[2], most[2];  /* q8 px: the shortest and the longest ways along both axes */
    int32_t nearest, farthest;  /* depth codes */
};

static inline bool is_sparse(const struct job *j)
{
    return (j->across_log2 | j->down_log2) != 0;
}

/* Of units q4. */
static inline int32_t depth_code(int32_t units)
{
    return units < 32768 << 4 ? (units + 8) >> 4 : (units + ((15 * 32768) << 4) + 128) >> 8;
}

enum { LARGE_BEND = 16 };       /* 1/16 px */

/* Not a sliver: its area is a quarter of that of its box, or more. */
static bool is_wide(const struct timemask_pose *p)
{
    int64_t x1 = p->x[1] - p->x[0], y1 = p->y[1] - p->y[0], x2 = p->x[2] - p->x[0], y2 = p->y[2] - p->y[0];
    int64_t area = x1 * y2 - x2 * y1, width = max_i32(p->x[0], max_i32(p->x[1], p->x[2]))
                                            - min_i32(p->x[0], min_i32(p->x[1], p->x[2]));
    int64_t height = max_i32(p->y[0], max_i32(p->y[1], p->y[2]))
                   - min_i32(p->y[0], min_i32(p->y[1], p->y[2]));
    return (area < 0 ? -area : area) * 2 >= width * height;
}

/* Displacements at the vertices, q8 px, during the whole exposure; of a triangle much
 * larger than the tile at the tile's corners in its plane: a floor may stand still at the
 * horizon and rush by here. How many: 3 or 4. */
static int displacements(int32_t out[4][2], const struct job *j, const struct moving *m)
{
    const struct smear_path_bounds *b = m->bounds;
    const struct smear_raster_target *tile = &j->tile->still;
    const int32_t scale = b->interval == 0 ? 1 : PATH_INTERVALS;
    int32_t value[2][3];
    struct timemask_pose p;
    for (int i = 0; i < 3; i++) {
        const int32_t *middle = m->record[i], *open = middle + m->segment->motion,
                      *close = open + PATH_POSE_WORDS;
        for (int axis = 0; axis < 2; axis++) {
            value[axis][i] = (close[axis] - open[axis]) * scale;
            out[i][axis] = value[axis][i];
        }
        p.x[i] = middle[PATH_X] - (tile->x0 + tile->x1) * 128;
        p.y[i] = middle[PATH_Y] - (tile->y0 + tile->y1) * 128;
    }
    struct timemask_shape shape;
    if (min_i32(b->x1 - b->x0, b->y1 - b->y0) <= 3 * j->tile->tile || b->curvature > LARGE_BEND || !is_wide(&p)
        || !smear_timemask_shape(&shape, &p))
        return 3;
    const int32_t half_x = (tile->x1 - tile->x0) >> 1, half_y = (tile->y1 - tile->y0) >> 1;
    for (int axis = 0; axis < 2; axis++) {
        struct timemask_slopes s = smear_timemask_slopes(&shape, value[axis]);
        int32_t low = min_i32(value[axis][0], min_i32(value[axis][1], value[axis][2]));
        int32_t high = max_i32(value[axis][0], max_i32(value[axis][1], value[axis][2]));
        int64_t middle = value[axis][0] - (((int64_t)s.dx * p.x[0] + (int64_t)s.dy * p.y[0]) >> 8);
        for (int i = 0; i < 4; i++) {
            int64_t at = middle + (int64_t)s.dx * (i & 1 ? half_x : -half_x)
                       + (int64_t)s.dy * (i & 2 ? half_y : -half_y);
            out[i][axis] = (int32_t)(at < low ? low : at > high ? high : at);
        }
    }
    return 4;
}

static void flow_add(struct flow *f, const struct job *j, const struct moving *m)
{
    int32_t d[4][2], low = INT32_MAX, high = INT32_MIN;
    const int places = displacements(d, j, m);
    for (int axis = 0; axis < 2; axis++) {
        int32_t from = d[0][axis], to = from;
        for (int i = 1; i < places; i++) {
            from = min_i32(from, d[i][axis]);
            to = max_i32(to, d[i][axis]);
        }
        f->least[axis] = min_i32(f->least[axis], from > 0 ? from : to < 0 ? -to : 0);
        f->most[axis] = max_i32(f->most[axis], max_i32(-from, to));
    }
    for (int i = 0; i < 3; i++) {
        const int32_t *middle = m->record[i], *open = middle + m->segment->motion,
                      *close = open + PATH_POSE_WORDS;
        low = min_i32(low, min_i32(middle[PATH_DEPTH], min_i32(open[PATH_DEPTH], close[PATH_DEPTH])));
        high = max_i32(high, max_i32(middle[PATH_DEPTH], max_i32(open[PATH_DEPTH], close[PATH_DEPTH])));
    }
    /* Parabolas leave the range of their places by at most an
     * eighth of it; planes of slivers are less exact. */
    low = max_i32(low - ((high - low) >> 2), 0);
    f->farthest = min_i32(f->farthest, depth_code(low >> 7) - 2);
    f->nearest = max_i32(f->nearest, m->bounds->nearest + 2);
}

/* Samples lie apart where all moving triangles of the tile go far along an axis, and not much along the other. */
static void choose_samples(struct job *j)
{
    const struct smear_moving_tile *t = j->tile;
    struct flow f = { { INT32_MAX, INT32_MAX }, { 0, 0 }, 0, 65535 };
    j->across_log2 = j->down_log2 = 0;
    if (j->settings->sparse == 0)
        return;
    const int32_t one = j->settings->sparse << 8;
    for (uint32_t i = 0; i < t->moving_count; i++) {
        struct moving m;
        if (!moving_is_in(&t->moving[i], t))
            continue;
        moving_take(&m, j, i);
        flow_add(&f, j, &m);
        if (max_i32(f.least[0], f.least[1]) < 2 * one)
            return;
    }
    j->front = f.nearest;
    j->back = f.farthest;
    const int u = f.least[0] >= f.least[1] ? 0 : 1;
    int log2 = 0, aside_log2 = 0;
    while (log2 < SPARSE_LOG2_MAX && f.least[u] >= one << (log2 + 1))
        log2++;
    if (f.least[1 - u] > f.least[u] >> 1 && f.least[1 - u] >= 2 * one) {
        log2 = min_i32(log2, 2);
        aside_log2 = 1;
    }
    j->across_log2 = u == 0 ? log2 : aside_log2;
    j->down_log2 = u == 0 ? aside_log2 : log2;
    j->swapped = j->across_log2 > j->down_log2;
}

/* ------------------------------------------------------------------ triangles */

/* The triangle at a time, 0 .. SHUTTER_CLOSE, in the distances between samples. Most often it is
 * asked for one of the places that are kept. */
static void pose_at(struct timemask_pose *p, const struct job *j, const struct moving *m, int32_t time)
{
    int32_t x = j->x * 256 + 128, y = j->y * 256 + 128;
    int32_t *across = j->swapped ? p->y : p->x, *down = j->swapped ? p->x : p->y;
    if ((time & (SHUTTER_CLOSE / 2 - 1)) == 0) {
        int at = time == SHUTTER_CLOSE / 2 ? 0 : m->segment->motion + (time != 0 ? PATH_POSE_WORDS : 0);
        for (int i = 0; i < 3; i++) {
            const int32_t *place = m->record[i] + at;
            across[i] = (place[PATH_X] - x) >> j->across_log2;
            down[i] = (place[PATH_Y] - y) >> j->down_log2;
            p->depth[i] = place[PATH_DEPTH];
        }
        return;
    }
    for (int i = 0; i < 3; i++) {
        int32_t place[3];
        path_at(place, m->record[i], m->segment, time);
        across[i] = (place[PATH_X] - x) >> j->across_log2;
        down[i] = (place[PATH_Y] - y) >> j->down_log2;
        p->depth[i] = clamp_i32(place[2], SMEAR_DEPTH_MIN, SMEAR_DEPTH_MAX);      /* a parabola overshoots */
    }
}

/* Rows of the still scene. */
static inline uint32_t still_at(const struct smear_plane_rows *r, const struct smear_raster_target *t,
                                int32_t x, int32_t y)
{
    int32_t slot = r->ring_row + (y - t->y0);
    if (slot >= r->ring)
        slot -= r->ring;
    return (uint32_t)(slot * r->stride + x - r->x0);
}

/* The slots of a run in which a fragment is nearer than the still scene, where both meet: `begin` is how much
 * nearer it is in slot `from`, in 1/32, and 2 `slope` how that changes per slot. */
static SMEAR_NOINLINE uint32_t slots_before_still(int32_t begin, int32_t slope, int32_t from, int32_t count)
{
    int32_t end = begin + 2 * slope * (count - 1);
    if (begin > 0 && end > 0)
        return UINT32_MAX >> (32 - count) << from;
    if (begin <= 0 && end <= 0)
        return 0;
    int32_t before = clamp_i32(-begin / (2 * slope), 0, count - 2) + 1;     /* slots before they meet */
    return begin > 0 ? UINT32_MAX >> (32 - before) << from
                     : UINT32_MAX >> (32 - (count - before)) << (from + before);
}

/* Slots [0, i). */
static const uint32_t below[33] = {
    0, 0x1, 0x3, 0x7, 0xf, 0x1f, 0x3f, 0x7f, 0xff, 0x1ff, 0x3ff, 0x7ff, 0xfff, 0x1fff, 0x3fff, 0x7fff, 0xffff,
    0x1ffff, 0x3ffff, 0x7ffff, 0xfffff, 0x1fffff, 0x3fffff, 0x7fffff, 0xffffff, 0x1ffffff, 0x3ffffff,
    0x7ffffff, 0xfffffff, 0x1fffffff, 0x3fffffff, 0x7fffffff, 0xffffffff
};

/* How depth codes follow from units q4, below and from code 32768. */
struct code_slope {
    int32_t add, shift;
    int32_t slope, size;        /* per slot, 1/16, as it is kept; its magnitude */
    uint32_t kept;
};

/* What fragments of a triangle in a segment share. */
struct painter {
    const struct timemask_shade *shade;
    struct code_slope code[2];
    int32_t first;              /* slot */
    int32_t last_slot;          /* of the exposure, less 2 `first` */
    int32_t time_shift;         /* from twice a slot to time */
};

/* Depths of no still scene. */
static const uint16_t nothing[TIMEMASK_WIDTH] = { 0 };

/* The fragments of a block. */
SMEAR_INLINE uint32_t paint(struct job *j, const struct timemask_cover *c, const struct painter *p,
                            bool plain, bool turns)
{
    /* Own copies: what is written might be anything. */
    const struct timemask_shade *s = p->shade;
    const struct smear_raster_target *target = &j->tile->still;
    const struct timemask_timed depth = s->depth;
    const int32_t low = s->depth_low, high = s->depth_high, first = p->first, last_slot = p->last_slot + 1;
    const int32_t time_shift = p->time_shift;
    const uint32_t flat = s->color;
    struct timemask_samples own = j->slots;
    uint32_t fragments = 0, run[TIMEMASK_RUNS];
    for (int32_t y = c->y0; y < c->y1; y++) {
        const int32_t n = smear_timemask_row(c, y, run);
        if (n == 0)
            continue;
        const struct timemask_here row = timemask_here(&depth, 0, y);
        const uint32_t pixel = (uint32_t)(y * j->stride);
        const uint16_t *still = nothing;
        if (!is_sparse(j))
            still = target->depth + still_at(&target->window_rows, target, j->x, j->y + y);
        for (int32_t i = 0; i < n; i++) {
            int32_t x = timemask_run_x(run[i]), from = timemask_run_from(run[i]),
                    to = timemask_run_to(run[i]);
            int32_t time = ((from + to) << time_shift) - (1 << (TIMEMASK_TIME_LOG2 - 1));
            int32_t change = row.change;
            if (turns)
                change = add_wrap(change,
                                  add_wrap(mul_wrap(depth.change_dx, x), timemask_part(depth.curve, time)));
            int32_t units = add_wrap(add_wrap(row.at, mul_wrap(depth.dx, x)), timemask_part(change, time));
            units = clamp_i32(units, low, high);
            const struct code_slope *k = &p->code[units >= 32768 << 4];
            int32_t code = (units + k->add) >> k->shift, slope = k->slope,
                    reach = k->size * (to - from - 1) >> 5;
            int32_t behind = still[x];
            if (code + reach <= behind)
                continue;
            struct timemask_fragment f;
            f.low = max_i32(code - reach, 0);
            f.mask = below[first + to] ^ below[first + from];
            if (code - reach <= behind) {
                f.mask = slots_before_still((code - behind) * 32 - slope * (to - from - 1), slope,
                                            first + from, to - from);
                if (f.mask == 0)
                    continue;
            }
            /* From the run's middle to that of the exposure; a depth that
             * would leave its range there stays level. */
            f.depth = code + (slope * (last_slot - (from + to)) >> 5);
            f.slope = slope;
            f.color = k->kept;
            if ((uint32_t)f.depth > 65535u) {
                f.depth = code;
                f.slope = 0;
                f.color = 0;
            }
            f.color |= plain ? flat : smear_timemask_color(s, y, run[i]);
            timemask_samples_add(&own, pixel + (uint32_t)x, f, code + reach);
            fragments++;
        }
    }
    return fragments;
}

/* A triangle in a segment of 2^slots_log2 slots with poses at its start,
 * middle and end; `first` is its first slot. */
static void draw_segment(struct job *j, const struct moving *m, const struct timemask_pose *const pose[3],
                         int32_t first, int32_t slots_log2)
{
    struct timemask_cover c;
    struct timemask_shade s;
    if (!smear_timemask_cover(&c, pose, j->width, j->height, slots_log2, j->settings->edge))
        return;
    smear_timemask_shade(&s, j->tile->frame, m->segment, m->triangle->color,
                         (m->bounds->flags & PATH_FLAT) != 0, m->record, pose, &c,
                         max_i32(j->settings->tap >> max_i32(j->across_log2, j->down_log2), 1));
    if (m->bounds->interval != 0) {    /* its ends may lie before the near plane, where
                                     * depths end: its middle tells */
        s.depth.change = s.depth.change_dx = s.depth.change_dy = s.depth.curve = 0;
        s.slope = 0;
    }
    struct painter p = { .shade = &s, .first = first, .last_slot = (1 << j->slots.slots_log2) - 1 - 2 * first,
                         .time_shift = TIMEMASK_TIME_LOG2 - 1 - slots_log2 };
    for (int i = 0; i < 2; i++) {
        struct code_slope *k = &p.code[i];
        k->add = i == 0 ? 8 : ((15 * 32768) << 4) + 128;
        k->shift = i == 0 ? 4 : 8;
        k->kept = smear_timemask_slope(i == 0 ? s.slope : s.slope >> 4) << 24;
        k->slope = timemask_slope_of(k->kept);
        k->size = abs_i32(k->slope);
    }
    if (s.gouraud || s.sampler != NULL)
        j->fragments += paint(j, &c, &p, false, true);
    else if ((s.depth.change_dx | s.depth.change_dy | s.depth.curve) != 0)
        j->fragments += paint(j, &c, &p, true, true);
    else
        j->fragments += paint(j, &c, &p, true, false);
}

static void draw_whole(struct job *j, const struct moving *m)
{
    struct timemask_pose pose[3];
    pose_at(&pose[0], j, m, j->time[0]);
    for (int i = 0; i < 1 << j->segments_log2; i++) {
        const struct timemask_pose *poses[3] = { &pose[i & 1 ? 2 : 0], &pose[1], &pose[i & 1 ? 0 : 2] };
        pose_at(&pose[1], j, m, (j->time[i] + j->time[i + 1]) >> 1);
        pose_at(&pose[i & 1 ? 0 : 2], j, m, j->time[i + 1]);
        draw_segment(j, m, poses, i << j->slots_log2, j->slots_log2);
    }
}

/* One that is there for a interval of the exposure: a segment of its slots, where slots are even and there is
 * one at least; else as it is in the middle of each slot. */
static void draw_piece(struct job *j, const struct moving *m)
{
    struct timemask_pose pose[3];
    const struct timemask_pose *poses[3] = { &pose[0], &pose[1], &pose[2] };
    int32_t slots = 1 << j->slots.slots_log2;
    if (slots >= PATH_INTERVALS && j->even) {
        for (int i = 0; i < 3; i++)
            pose_at(&pose[i], j, m, i * (SHUTTER_CLOSE / 2));
        draw_segment(j, m, poses, (m->bounds->interval - 1) * (slots / PATH_INTERVALS),
                     j->slots.slots_log2 - PIECES_LOG2);
        return;
    }
    poses[1] = poses[2] = &pose[0];
    for (int32_t slot = 0; slot < slots; slot++) {
        int32_t time = smear_shutter_instant(j->tile->shutter, slot, slots);
        if (!path_interval_time(&time, m->bounds->interval))
            continue;
        pose_at(&pose[0], j, m, time);
        draw_segment(j, m, poses, slot, 0);
    }
}

static void draw_moving(struct job *j, uint32_t i)
{
    struct moving m;
    moving_take(&m, j, i);
    const struct smear_path_bounds *b = m.bounds;
    if (b->x0 > j->last_x || b->x1 <= j->x || b->y0 > j->last_y || b->y1 <= j->y)
        return;
    if (b->interval == 0)
        draw_whole(j, &m);
    else
        draw_piece(j, &m);
}

/* The listed moving triangles, the nearest first, until the rest is hidden. */
static void draw_listed(struct job *j)
{
    for (uint32_t i = 0; i < j->listed; i++) {
        if (i != 0 && i % LOOK_EVERY == 0
            && (int32_t)(j->list[i] >> 16)
                   <= smear_timemask_samples_hidden(&j->slots, j->width, j->height, j->stride))
            return;
        draw_moving(j, listed_moving(j, i));
    }
}

/* ------------------------------------------------------------------ blocks */

/* Pixels [x, x + width) and rows [y, y + height) of the tile. */
struct block {
    int32_t width, height;
};

static void finish_block(const struct job *j, const struct block *b)
{
    const struct smear_moving_tile *t = j->tile;
    const struct smear_raster_target *still = &t->still;
    struct timemask_spread spread;
    if (is_sparse(j)) {
        spread.slots = &j->slots;
        spread.right = j->swapped ? j->stride : 1;
        spread.down = j->swapped ? 1 : j->stride;
        spread.across_log2 = j->across_log2;
        spread.down_log2 = j->down_log2;
        spread.width = b->width;
        spread.front = j->front;
        spread.back = j->back;
    }
    for (int32_t y = 0; y < b->height; y++) {
        const uint32_t *color = still->color + still_at(&still->color_rows, still, j->x, j->y + y);
        uint32_t *out = t->out + (j->y + y - still->y0) * t->pitch + (j->x - still->x0);
        if (is_sparse(j)) {
            smear_timemask_spread(&spread, y, out, color,
                                  still->depth + still_at(&still->window_rows, still, j->x, j->y + y));
            continue;
        }
        for (int32_t x = 0; x < b->width; x++) {
            uint32_t at = (uint32_t)(y * j->stride + x);
            out[x] = j->slots.count[at] == 0 ? color[x] : smear_timemask_samples_mean(&j->slots, at, color[x]);
        }
    }
}

/* Samples that n pixels need: where they lie apart, one at or beyond the last pixel. */
static inline int32_t samples_for(int32_t n, int32_t log2)
{
    return ((n - 1) >> log2) + (log2 != 0 ? 2 : 1);
}

/* The largest block whose samples fit, halving the tile. */
static void choose_block(struct job *j, struct block *b, int32_t pixels)
{
    int32_t width = j->tile->tile, height = width;      /* along and across the block's rows */
    const int32_t width_log2 = j->swapped ? j->down_log2 : j->across_log2;
    const int32_t height_log2 = j->swapped ? j->across_log2 : j->down_log2;
    while (samples_for(width, width_log2) > TIMEMASK_WIDTH)
        width >>= 1;
    j->stride = samples_for(width, width_log2);
    while (samples_for(height, height_log2) > TIMEMASK_HEIGHT
           || samples_for(height, height_log2) * j->stride > pixels)
        height >>= 1;
    b->width = j->swapped ? height : width;
    b->height = j->swapped ? width : height;
}

/* Log2 of the entries that the memory is enough for. */
static int pixels_log2(uint32_t work_bytes)
{
    int log2 = PIXELS_LOG2;
    while (work_bytes != 0 && log2 > 4
           && timemask_samples_bytes(1u << log2) + LISTED * sizeof(uint32_t) > work_bytes)
        log2--;
    return log2;
}

size_t smear_timemask_work(int32_t tile)
{
    (void)tile;
    return timemask_samples_bytes(1u << PIXELS_LOG2) + LISTED * sizeof(uint32_t);
}

uint32_t smear_timemask_tile(const struct smear_moving_tile *t,
                             const struct smear_timemask_settings *settings, bool *is_smooth)
{
    const int log2 = pixels_log2(t->work_bytes);
    struct job j = { .tile = t, .settings = settings, .list = (uint32_t *)t->work };
    struct block most;
    smear_timemask_samples_place(&j.slots, j.list + LISTED, log2,
                               31 - count_leading_zeros((uint32_t)settings->slots),
                               frame_is_linear(t->frame));
    j.even = smear_shutter_is_box(t->shutter);
    choose_segments(&j);
    choose_samples(&j);
    *is_smooth = is_sparse(&j);
    choose_block(&j, &most, 1 << log2);
    list_moving(&j);
    for (j.y = t->still.y0; j.y < t->still.y1; j.y += most.height)
        for (j.x = t->still.x0; j.x < t->still.x1; j.x += most.width) {
            const struct block b = { min_i32(t->still.x1 - j.x, most.width),
                                     min_i32(t->still.y1 - j.y, most.height) };
            const int32_t across = samples_for(b.width, j.across_log2),
                          down = samples_for(b.height, j.down_log2);
            j.last_x = j.x + ((across - 1) << j.across_log2);
            j.last_y = j.y + ((down - 1) << j.down_log2);
            j.width = j.swapped ? down : across;
            j.height = j.swapped ? across : down;
            smear_timemask_samples_clear(&j.slots);
            if (j.first != 0) {         /* did not fit at once: from the start */
                j.next = 0;
                list_moving(&j);
            }
            for (;;) {
                draw_listed(&j);
                if (j.next == t->moving_count)
                    break;
                list_moving(&j);
            }
            finish_block(&j, &b);
        }
    return j.fragments;
}
