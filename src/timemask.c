/* SPDX-License-Identifier: MIT */
/* timemask.c - a tile in blocks of pixels: its moving triangles one after the other, segment by segment of the exposure,
 * into time slots over the still scene; then their mean. */
#include "timemask.h"

#include "shutter.h"
#include "timemask_cover.h"
#include "timemask_shade.h"
#include "timemask_slots.h"

/* Paths are cut into chords: all of a block alike, so that neighbours agree at their edges. */
enum { SEGMENTS_MAX = 8, SEGMENTS_LOG2_MAX = 3 };

/* What the blocks of a tile share. */
struct job {
    const struct smear_moving_tile *tile;
    const struct smear_timemask_settings *settings;
    struct timemask_slots slots;
    int32_t segments_log2;
    int32_t slots_log2;                         /* of a segment */
    int32_t time[SEGMENTS_MAX + 1];             /* where segments meet */
    int32_t x, y, width, height;                /* the block */
    uint32_t fragments;
};

/* A moving triangle. */
struct mover {
    const struct smear_path_bounds *bounds;
    const struct smear_triangle *triangle;
    const struct smear_segment *segment;
    const int32_t *record[3];
};

/* Movers that may be seen in a box of pixels. */
static bool mover_take(struct mover *m, const struct job *j, uint32_t i)
{
    const struct smear_moving_tile *t = j->tile;
    const struct smear_geometry *g = t->frame->geometry;
    if (!mover_is_in(&t->mover[i], t->column))
        return false;
    m->bounds = geometry_bounds(g, t->mover[i].triangle);
    if (m->bounds->x0 >= j->x + j->width || m->bounds->x1 <= j->x
        || m->bounds->y0 >= j->y + j->height || m->bounds->y1 <= j->y)
        return false;
    m->triangle = geometry_triangle(g, t->mover[i].triangle);
    m->segment = &g->segment[m->triangle->segment];
    for (int k = 0; k < 3; k++)
        m->record[k] = geometry_vertex(g, m->segment, m->triangle->vertex[k]);
    return true;
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
    for (uint32_t i = 0; i < t->mover_count; i++)
        if (mover_take(&m, j, i) && m.bounds->piece == 0) {
            travel = max_i32(travel, m.bounds->travel << 4);
            bend = max_i32(bend, m.bounds->bend << 3);
            bend = max_i32(bend, max_i32(edge_bend(&m, 0, 1), max_i32(edge_bend(&m, 1, 2), edge_bend(&m, 2, 0))));
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
        p->depth[i] = max_i32(place[2], 1);
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

/* A triangle in a segment of 2^slots_log2 slots, from pose a to pose b; `first` is the segment's first slot. */
static void draw_segment(struct job *j, const struct mover *m, const struct timemask_pose *a,
                         const struct timemask_pose *b, int32_t first, int32_t slots_log2)
{
    const struct smear_raster_target *still = &j->tile->still;
    struct timemask_cover c;
    struct timemask_shade s;
    struct timemask_run run[TIMEMASK_BLOCK];
    if (!smear_timemask_cover(&c, a, b, j->width, j->height, slots_log2))
        return;
    smear_timemask_shade(&s, j->tile->frame, m->segment, m->triangle, a, b, slots_log2, j->settings->tap);
    for (int32_t y = c.y0; y < c.y1; y++) {
        int32_t n = smear_timemask_row(&c, y, run);
        const uint16_t *depth = still->depth + still_at(&still->window_rows, still, j->x, j->y + y);
        for (int32_t i = 0; i < n; i++) {
            uint32_t code = timemask_depth(&s, y, &run[i]);
            if (code <= depth[run[i].x])
                continue;
            uint32_t color = s.gouraud || s.sampler != NULL ? smear_timemask_color(&s, y, &run[i]) : s.color;
            uint32_t mask = (UINT32_MAX >> (32 - (run[i].to - run[i].from))) << (first + run[i].from);
            smear_timemask_slots_add(&j->slots, (uint32_t)(y * TIMEMASK_BLOCK + run[i].x), mask, color, code);
            j->fragments++;
        }
    }
}

static void draw_mover(struct job *j, const struct mover *m)
{
    struct timemask_pose pose[2];
    pose_at(&pose[0], j, m, j->time[0]);
    for (int i = 0; i < 1 << j->segments_log2; i++) {
        pose_at(&pose[~i & 1], j, m, j->time[i + 1]);
        draw_segment(j, m, &pose[i & 1], &pose[~i & 1], i << j->slots_log2, j->slots_log2);
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
        pose_at(&pose, j, m, time);
        draw_segment(j, m, &pose, &pose, slot, 0);
    }
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
            uint32_t at = (uint32_t)(y * TIMEMASK_BLOCK + x), held = 0;
            for (uint32_t e = 0; e < TIMEMASK_ENTRIES; e++)
                held |= j->slots.held[e * j->slots.pixels + at];
            out[x] = held == 0 ? color[x] : smear_timemask_slots_mean(&j->slots, at, color[x]);
        }
    }
}

/* Rows of a block that the memory is enough for. */
static int32_t block_height(uint32_t work_bytes)
{
    int32_t height = TIMEMASK_BLOCK;
    while (work_bytes != 0 && height > 1 && timemask_slots_bytes((uint32_t)(TIMEMASK_BLOCK * height)) > work_bytes)
        height >>= 1;
    return height;
}

size_t smear_timemask_work(int32_t tile)
{
    (void)tile;
    return timemask_slots_bytes(TIMEMASK_BLOCK * TIMEMASK_BLOCK);
}

uint32_t smear_timemask_tile(const struct smear_moving_tile *t, const struct smear_timemask_settings *settings)
{
    const int32_t height = block_height(t->work_bytes);
    struct job j = { .tile = t, .settings = settings, .x = t->still.x0, .y = t->still.y0, .width = t->tile,
                     .height = t->tile };
    struct mover m;
    smear_timemask_slots_place(&j.slots, t->work, (uint32_t)(TIMEMASK_BLOCK * height),
                               31 - count_leading_zeros((uint32_t)settings->slots), t->frame->linear);
    choose_segments(&j);
    for (j.y = t->still.y0; j.y < t->still.y1; j.y += height)
        for (j.x = t->still.x0; j.x < t->still.x1; j.x += TIMEMASK_BLOCK) {
            j.width = min_i32(t->still.x1 - j.x, TIMEMASK_BLOCK);
            j.height = min_i32(t->still.y1 - j.y, height);
            smear_timemask_slots_clear(&j.slots);
            for (uint32_t i = 0; i < t->mover_count; i++) {
                if (!mover_take(&m, &j, i))
                    continue;
                if (m.bounds->piece == 0)
                    draw_mover(&j, &m);
                else
                    draw_piece(&j, &m);
            }
            finish_block(&j);
        }
    return j.fragments;
}
