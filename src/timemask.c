/* SPDX-License-Identifier: MIT */
/* timemask.c - a tile in blocks of pixels: its moving triangles one after the other, segment by segment of the exposure,
 * into time slots over the still scene; then their mean. */
#include "timemask.h"

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

static const struct smear_triangle *triangle_of(const struct job *j, const struct smear_mover *m,
                                                const struct smear_segment **segment)
{
    const struct smear_geometry *g = j->tile->frame->geometry;
    const struct smear_triangle *t = geometry_triangle(g, m->triangle);
    *segment = &g->segment[t->segment];
    return t;
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

/* Bounds over the tile's triangles, q8 px. */
struct tile_motion {
    int32_t bend;               /* how far an edge's middle lies off where its ends say, whole exposure as a segment */
    int32_t travel;
};

/* Edges are taken to sweep evenly: what an edge that turns or grows lies off in the middle, |move x change| / (4 length),
 * and what its vertices do. */
static int32_t edge_bend(const int32_t *const open[3], const int32_t *const close[3], int i, int j)
{
    int32_t ex = open[j][PATH_X] - open[i][PATH_X], ey = open[j][PATH_Y] - open[i][PATH_Y];
    int32_t cx = close[j][PATH_X] - close[i][PATH_X] - ex, cy = close[j][PATH_Y] - close[i][PATH_Y] - ey;
    int32_t mx = close[i][PATH_X] - open[i][PATH_X], my = close[i][PATH_Y] - open[i][PATH_Y];
    int64_t turn = (int64_t)mx * cy - (int64_t)my * cx;
    int64_t length = max_i32(abs_i32(ex + (cx >> 1)), abs_i32(ey + (cy >> 1))) + 16;
    turn = (turn < 0 ? -turn : turn) >> 2;
    /* Quotient to the next power of two would do; bits are few. */
    int32_t over = 0;
    while (turn > length) {
        turn >>= 1;
        over = 2 * over + 1;
    }
    return over;
}

static void mover_motion(struct tile_motion *b, const struct smear_geometry *g, const struct smear_segment *s,
                         const struct smear_triangle *t)
{
    const int32_t *open[3], *close[3];
    for (int i = 0; i < 3; i++) {
        const int32_t *record = geometry_vertex(g, s, t->vertex[i]);
        open[i] = record + s->motion;
        close[i] = open[i] + PATH_POSE_WORDS;
        b->bend = max_i32(b->bend, path_bend(record, s) >> 1);
        b->travel = max_i32(b->travel, max_i32(abs_i32(close[i][PATH_X] - open[i][PATH_X]),
                                               abs_i32(close[i][PATH_Y] - open[i][PATH_Y])));
    }
    b->bend = max_i32(b->bend, max_i32(edge_bend(open, close, 0, 1),
                                       max_i32(edge_bend(open, close, 1, 2), edge_bend(open, close, 2, 0))));
}

/* The fewest segments that do for all triangles of the tile. */
static void choose_segments(struct job *j)
{
    const struct smear_moving_tile *t = j->tile;
    struct tile_motion motion = { 0, 0 };
    for (uint32_t i = 0; i < t->mover_count; i++)
        if (mover_is_in(&t->mover[i], t->column)) {
            const struct smear_segment *segment;
            const struct smear_triangle *triangle = triangle_of(j, &t->mover[i], &segment);
            mover_motion(&motion, t->frame->geometry, segment, triangle);
        }
    int log2 = 0;
    while (log2 < SEGMENTS_LOG2_MAX
           && (motion.bend >> (2 * log2) > j->settings->bend
               || (int64_t)motion.travel * shutter_bend(t->shutter, log2) >> 16 > j->settings->bend))
        log2++;
    j->segments_log2 = log2;
    j->slots_log2 = j->slots.slots_log2 - log2;
    for (int i = 0; i <= 1 << log2; i++)
        j->time[i] = t->shutter->time[i * (SHUTTER_SLOTS >> log2)];
}

/* ------------------------------------------------------------------ triangles */

static void pose_at(struct timemask_pose *p, const struct job *j, const int32_t *const record[3],
                    const struct smear_segment *s, int32_t time)
{
    int32_t x = j->x * 256 + 128, y = j->y * 256 + 128;
    for (int i = 0; i < 3; i++) {
        int32_t place[3];
        path_at(place, record[i], s, time);
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

/* Fragments of a triangle in one segment; `first` is the segment's first slot. */
static void draw_segment(struct job *j, const struct timemask_cover *c, const struct timemask_shade *s, int32_t first)
{
    const struct smear_raster_target *still = &j->tile->still;
    struct timemask_run run[TIMEMASK_BLOCK];
    for (int32_t y = c->y0; y < c->y1; y++) {
        int32_t n = smear_timemask_row(c, y, run);
        const uint16_t *depth = still->depth + still_at(&still->window_rows, still, j->x, j->y + y);
        for (int32_t i = 0; i < n; i++) {
            uint32_t code = timemask_depth(s, y, &run[i]);
            if (code <= depth[run[i].x])
                continue;
            uint32_t color = s->gouraud || s->sampler != NULL ? smear_timemask_color(s, y, &run[i]) : s->color;
            uint32_t mask = (UINT32_MAX >> (32 - (run[i].to - run[i].from))) << (first + run[i].from);
            smear_timemask_slots_add(&j->slots, (uint32_t)(y * TIMEMASK_BLOCK + run[i].x), mask, color, code);
            j->fragments++;
        }
    }
}

static void draw_mover(struct job *j, const struct smear_mover *m)
{
    const struct smear_raster_frame *frame = j->tile->frame;
    const struct smear_segment *segment;
    const struct smear_triangle *t = triangle_of(j, m, &segment);
    const int32_t *record[3];
    for (int i = 0; i < 3; i++)
        record[i] = geometry_vertex(frame->geometry, segment, t->vertex[i]);
    struct timemask_pose pose[2];
    pose_at(&pose[0], j, record, segment, j->time[0]);
    for (int i = 0; i < 1 << j->segments_log2; i++) {
        struct timemask_pose *a = &pose[i & 1], *b = &pose[~i & 1];
        struct timemask_cover c;
        pose_at(b, j, record, segment, j->time[i + 1]);
        if (!smear_timemask_cover(&c, a, b, j->width, j->height, j->slots_log2))
            continue;
        struct timemask_shade s;
        smear_timemask_shade(&s, frame, segment, t, a, b, j->slots_log2, j->settings->tap);
        draw_segment(j, &c, &s, i << j->slots_log2);
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

static int32_t block_height(int32_t slots)
{
    return slots > 16 ? TIMEMASK_BLOCK : TIMEMASK_BLOCK / 2;
}

size_t smear_timemask_bytes(int32_t slots)
{
    return timemask_slots_bytes((uint32_t)(TIMEMASK_BLOCK * block_height(slots)));
}

uint32_t smear_timemask_tile(const struct smear_moving_tile *t, const struct smear_timemask_settings *settings)
{
    const int32_t height = block_height(settings->slots);
    struct job j = { .tile = t, .settings = settings };
    smear_timemask_slots_place(&j.slots, t->work, (uint32_t)(TIMEMASK_BLOCK * height),
                               31 - count_leading_zeros((uint32_t)settings->slots), t->frame->linear);
    choose_segments(&j);
    for (j.y = t->still.y0; j.y < t->still.y1; j.y += height)
        for (j.x = t->still.x0; j.x < t->still.x1; j.x += TIMEMASK_BLOCK) {
            j.width = min_i32(t->still.x1 - j.x, TIMEMASK_BLOCK);
            j.height = min_i32(t->still.y1 - j.y, height);
            smear_timemask_slots_clear(&j.slots);
            for (uint32_t i = 0; i < t->mover_count; i++)
                if (mover_is_in(&t->mover[i], t->column))
                    draw_mover(&j, &t->mover[i]);
            finish_block(&j);
        }
    return j.fragments;
}
