/* SPDX-License-Identifier: MIT */
/* timemask.c - a tile in blocks of pixels: its moving triangles one after the other, segment by segment of the exposure,
 * into time slots over the still scene; then their mean. */
#include "timemask.h"

#include "shutter.h"
#include "timemask_cover.h"
#include "timemask_shade.h"
#include "timemask_slots.h"
#include "transform.h"

/* Paths are cut into chords: all of a block alike, so that neighbours agree at their edges. */
enum { SEGMENTS_MAX = 8, SEGMENTS_LOG2_MAX = 3 };

enum { LISTED = 128 };                          /* movers that are drawn in order of depth */

/* What the blocks of a tile share. */
struct job {
    const struct smear_moving_tile *tile;
    const struct smear_timemask_settings *settings;
    struct timemask_slots slots;
    uint32_t *list;                             /* depth code, then place in the tile's list from `first` on */
    uint32_t listed, first, next;
    int32_t segments_log2;
    int32_t slots_log2;                         /* of a segment */
    int32_t time[SEGMENTS_MAX + 1];             /* where segments meet */
    int32_t x, y, width, height;                /* the block */
    uint32_t fragments;
};

/* A moving triangle, looked up. */
struct mover {
    const struct smear_path_bounds *bounds;
    const struct smear_triangle *triangle;
    const struct smear_segment *segment;
    const int32_t *record[3];
};

static void mover_take(struct mover *m, const struct job *j, uint32_t i)
{
    const struct smear_geometry *g = j->tile->frame->geometry;
    uint32_t triangle = j->tile->mover[i].triangle;
    m->bounds = geometry_bounds(g, triangle);
    m->triangle = geometry_triangle(g, triangle);
    m->segment = &g->segment[m->triangle->segment];
    for (int k = 0; k < 3; k++)
        m->record[k] = geometry_vertex(g, m->segment, m->triangle->vertex[k]);
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

/* Lists the tile's movers from `next` on, as many as there is room for, the nearest first. What is merged in a pixel is
 * hardly ever hidden by what comes later then. */
static void list_movers(struct job *j)
{
    const struct smear_moving_tile *t = j->tile;
    j->first = j->next;
    j->listed = 0;
    for (; j->next < t->mover_count && j->next - j->first < 65536u && j->listed < LISTED; j->next++)
        if (mover_is_in(&t->mover[j->next], t->column))
            j->list[j->listed++] = (uint32_t)t->mover[j->next].nearest << 16 | (65535u - (j->next - j->first));
    sort_down(j->list, j->listed);
}

static inline uint32_t listed_mover(const struct job *j, uint32_t i)
{
    return j->first + 65535u - (j->list[i] & 0xffffu);
}

/* ------------------------------------------------------------------ segments */

/* How far the shutter's slots lie off an even course within one of 2^log2 segments, q16 of the exposure. */
static int32_t shutter_bend(const struct smear_shutter *s, int log2)
{
    int step = SHUTTER_SLOTS >> log2;
    int32_t worst = 0;
    for (int first = 0; first < SHUTTER_SLOTS; first += step) {
        int32_t from = s->time[first], length = s->time[first + step] - from;
        for (int i = 1; i < step; i++)
            worst = max_i32(worst, abs_i32(s->time[first + i] - from - (length * i >> (5 - log2))));
    }
    return worst;
}

/* Edges are taken to sweep evenly: how far one that turns or grows lies off in the middle, |move x change| / (4 length),
 * q8 px, rounded up. */
static int32_t edge_bend(const struct mover *m, int i, int j)
{
    const int32_t *a = m->record[i] + m->segment->motion, *b = m->record[j] + m->segment->motion;
    int32_t ex = b[PATH_X] - a[PATH_X], ey = b[PATH_Y] - a[PATH_Y];
    int32_t cx = b[PATH_POSE_WORDS + PATH_X] - a[PATH_POSE_WORDS + PATH_X] - ex;
    int32_t cy = b[PATH_POSE_WORDS + PATH_Y] - a[PATH_POSE_WORDS + PATH_Y] - ey;
    int32_t mx = a[PATH_POSE_WORDS + PATH_X] - a[PATH_X], my = a[PATH_POSE_WORDS + PATH_Y] - a[PATH_Y];
    int64_t turn = (int64_t)mx * cy - (int64_t)my * cx;
    uint32_t length = (uint32_t)max_i32(abs_i32(ex + (cx >> 1)), abs_i32(ey + (cy >> 1))) + 16u;
    turn = (turn < 0 ? -turn : turn) >> 2;
    int zeros = count_leading_zeros(length);
    uint64_t over = (uint64_t)(turn >> 8) * recip_norm(length << zeros) >> (61 - 8 - zeros);
    return over >= INT32_MAX ? INT32_MAX : (int32_t)over + 1;
}

/* The fewest segments that do for all triangles of the tile, of the whole exposure. */
static void choose_segments(struct job *j)
{
    const struct smear_moving_tile *t = j->tile;
    int32_t bend = 0, travel = 0;               /* q8 px */
    struct mover m;
    for (uint32_t i = 0; i < t->mover_count; i++) {
        if (!mover_is_in(&t->mover[i], t->column))
            continue;
        mover_take(&m, j, i);
        if (m.bounds->piece == 0) {
            travel = max_i32(travel, m.bounds->travel << 4);
            bend = max_i32(bend, m.bounds->bend << 3);
            bend = max_i32(bend, max_i32(edge_bend(&m, 0, 1), max_i32(edge_bend(&m, 1, 2), edge_bend(&m, 2, 0))));
        }
    }
    int log2 = 0;
    while (log2 < SEGMENTS_LOG2_MAX
           && (bend >> (2 * log2) > j->settings->bend
               || (int64_t)travel * shutter_bend(t->shutter, log2) >> 16 > j->settings->bend))
        log2++;
    j->segments_log2 = log2;
    j->slots_log2 = j->slots.slots_log2 - log2;
    for (int i = 0; i <= 1 << log2; i++)
        j->time[i] = t->shutter->time[i * (SHUTTER_SLOTS >> log2)];
}

/* ------------------------------------------------------------------ triangles */

static void pose_at(struct timemask_pose *p, const struct job *j, const struct mover *m, int32_t time)
{
    int32_t x = j->x * 256 + 128, y = j->y * 256 + 128;
    for (int i = 0; i < 3; i++) {
        int32_t place[3];
        path_at(place, m->record[i], m->segment, time);
        p->x[i] = place[0] - x;
        p->y[i] = place[1] - y;
        p->depth[i] = clamp_i32(place[2], SMEAR_DEPTH_MIN, SMEAR_DEPTH_MAX);      /* a parabola overshoots */
    }
}

/* Rows of the still scene. */
static inline uint32_t still_at(const struct smear_plane_rows *r, const struct smear_raster_target *t, int32_t x, int32_t y)
{
    int32_t slot = r->slot0 + (y - t->y0);
    if (slot >= r->ring)
        slot -= r->ring;
    return (uint32_t)(slot * r->stride + x - r->x0);
}

/* The slots of a run in which a fragment is nearer than the still scene, where both meet: `begin` is how much nearer it is
 * in slot `from`, in 1/32, and 2 `slope` how that changes per slot. */
static SMEAR_NOINLINE uint32_t slots_before_still(int32_t begin, int32_t slope, int32_t from, int32_t count)
{
    int32_t end = begin + 2 * slope * (count - 1);
    if (begin > 0 && end > 0)
        return UINT32_MAX >> (32 - count) << from;
    if (begin <= 0 && end <= 0)
        return 0;
    int32_t before = clamp_i32(-begin / (2 * slope), 0, count - 2) + 1;     /* slots before they meet */
    return begin > 0 ? UINT32_MAX >> (32 - before) << from : UINT32_MAX >> (32 - (count - before)) << (from + before);
}

/* A triangle in a segment of 2^slots_log2 slots with poses at its start, middle and end; `first` is its first slot. */
static void draw_segment(struct job *j, const struct mover *m, const struct timemask_pose *const pose[3], int32_t first,
                         int32_t slots_log2)
{
    const struct smear_raster_target *still = &j->tile->still;
    struct timemask_cover c;
    struct timemask_shade s;
    struct timemask_run run[TIMEMASK_RUNS];
    if (!smear_timemask_cover(&c, pose, j->width, j->height, slots_log2, j->settings->edge))
        return;
    smear_timemask_shade(&s, j->tile->frame, m->segment, m->triangle, pose, slots_log2, j->settings->tap);
    /* Slopes as they are kept, below and from code 32768; and how far the middle of the exposure is off. */
    const uint32_t kept[2] = { smear_timemask_slope(s.slope[0]) << 24, smear_timemask_slope(s.slope[1]) << 24 };
    const int32_t slope[2] = { timemask_slope_of(kept[0]), timemask_slope_of(kept[1]) };
    const int32_t last_slot = (1 << j->slots.slots_log2) - 1 - 2 * first;
    const bool plain = !s.gouraud && s.sampler == NULL;
    for (int32_t y = c.y0; y < c.y1; y++) {
        int32_t n = smear_timemask_row(&c, y, run);
        const uint16_t *depth = still->depth + still_at(&still->window_rows, still, j->x, j->y + y);
        for (int32_t i = 0; i < n; i++) {
            const struct timemask_run *r = &run[i];
            int32_t count = r->to - r->from;
            uint32_t code = timemask_depth(&s, y, r), high = code >> 15;
            int32_t apart = ((int32_t)code - (int32_t)depth[r->x]) * 32, most = abs_i32(slope[high]) * (count - 1);
            if (apart <= -most)
                continue;
            uint32_t mask = UINT32_MAX >> (32 - count) << (first + r->from);
            if (apart <= most)
                mask = slots_before_still(apart - slope[high] * (count - 1), slope[high], first + r->from, count);
            if (mask == 0)
                continue;
            /* From the run's middle to that of the exposure; a depth that would leave its range there stays level. */
            int32_t middle = (int32_t)code + (slope[high] * (last_slot - (r->from + r->to - 1)) >> 5);
            uint32_t color = plain ? s.color : smear_timemask_color(&s, y, r);
            if ((uint32_t)middle < 65536u)
                smear_timemask_slots_add(&j->slots, (uint32_t)(y * TIMEMASK_BLOCK + r->x), mask, color | kept[high],
                                         (uint32_t)middle, slope[high]);
            else
                smear_timemask_slots_add(&j->slots, (uint32_t)(y * TIMEMASK_BLOCK + r->x), mask, color, code, 0);
            j->fragments++;
        }
    }
}

static void draw_whole(struct job *j, const struct mover *m)
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

/* One that is there for a piece of the exposure: as it is in the middle of each slot. */
static void draw_piece(struct job *j, const struct mover *m)
{
    struct timemask_pose pose;
    int32_t slots = 1 << j->slots.slots_log2;
    for (int32_t slot = 0; slot < slots; slot++) {
        int32_t time = smear_shutter_instant(j->tile->shutter, slot, slots);
        if (!path_piece_time(&time, m->bounds->piece))
            continue;
        const struct timemask_pose *poses[3] = { &pose, &pose, &pose };
        pose_at(&pose, j, m, time);
        draw_segment(j, m, poses, slot, 0);
    }
}

static void draw_mover(struct job *j, uint32_t i)
{
    struct mover m;
    mover_take(&m, j, i);
    const struct smear_path_bounds *b = m.bounds;
    if (b->x0 >= j->x + j->width || b->x1 <= j->x || b->y0 >= j->y + j->height || b->y1 <= j->y)
        return;
    if (b->piece == 0)
        draw_whole(j, &m);
    else
        draw_piece(j, &m);
}

/* ------------------------------------------------------------------ blocks */

static void finish_block(const struct job *j)
{
    const struct smear_moving_tile *t = j->tile;
    const struct smear_raster_target *still = &t->still;
    for (int32_t y = 0; y < j->height; y++) {
        const uint32_t *color = still->color + still_at(&still->color_rows, still, j->x, j->y + y);
        uint32_t *out = t->out + (j->y + y - still->y0) * t->tile + (j->x - still->x0);
        for (int32_t x = 0; x < j->width; x++) {
            uint32_t at = (uint32_t)(y * TIMEMASK_BLOCK + x);
            out[x] = smear_timemask_slots_mean(&j->slots, at, color[x]);
        }
    }
}

/* Rows of a block that the memory is enough for. */
static int32_t block_height(uint32_t work_bytes)
{
    int32_t height = TIMEMASK_BLOCK;
    while (work_bytes != 0 && height > 1
           && timemask_slots_bytes((uint32_t)(TIMEMASK_BLOCK * height)) + LISTED * sizeof(uint32_t) > work_bytes)
        height >>= 1;
    return height;
}

size_t smear_timemask_work(int32_t tile)
{
    (void)tile;
    return timemask_slots_bytes(TIMEMASK_BLOCK * TIMEMASK_BLOCK) + LISTED * sizeof(uint32_t);
}

uint32_t smear_timemask_tile(const struct smear_moving_tile *t, const struct smear_timemask_settings *settings)
{
    const int32_t height = block_height(t->work_bytes);
    struct job j = { .tile = t, .settings = settings, .list = t->work };
    smear_timemask_slots_place(&j.slots, j.list + LISTED, (uint32_t)(TIMEMASK_BLOCK * height),
                               31 - count_leading_zeros((uint32_t)settings->slots), t->frame->linear);
    choose_segments(&j);
    list_movers(&j);
    for (j.y = t->still.y0; j.y < t->still.y1; j.y += height)
        for (j.x = t->still.x0; j.x < t->still.x1; j.x += TIMEMASK_BLOCK) {
            j.width = min_i32(t->still.x1 - j.x, TIMEMASK_BLOCK);
            j.height = min_i32(t->still.y1 - j.y, height);
            smear_timemask_slots_clear(&j.slots);
            if (j.first != 0) {         /* did not fit at once: from the start */
                j.next = 0;
                list_movers(&j);
            }
            for (;;) {
                for (uint32_t i = 0; i < j.listed; i++)
                    draw_mover(&j, listed_mover(&j, i));
                if (j.next == t->mover_count)
                    break;
                list_movers(&j);
            }
            finish_block(&j);
        }
    return j.fragments;
}
