/* SPDX-License-Identifier: MIT */
/* timemask.c - a tile in blocks of pixels: its moving triangles one after the other, segment by segment of
 * the exposure, into time samples over the background; then their mean. */
#include "temporal/subframes.h"

#include "geometry/path.h"
#include "timemask/timemask_cover.h"
#include "geometry/transform.h"

/* Paths are cut into chords: all of a block alike, so that neighbours agree at their edges. */
enum { SEGMENTS_MAX = 8, SEGMENTS_LOG2_MAX = 3 };

enum { PIXELS_LOG2 = 7 };       /* entries of a block, at most */

enum { LISTED = 100 };          /* moving triangles that are drawn in order of depth */

/* What the blocks of a tile share. */
struct job {
    const struct smear_tile_run *tile;
    const struct smear_timemask_settings *settings;
    struct timemask_samples samples;
    uint32_t *list;                             /* depth code, then place in the
                                                 * tile's list from `first` on */
    uint32_t listed, first, next;
    int32_t segments_log2;
    int32_t samples_log2;                       /* of a segment */
    int32_t time[SEGMENTS_MAX + 1];             /* where segments meet */
    int32_t x, y, width, height;                /* the block's pixels */
    int32_t stride;                             /* from a row of entries to the next */
    bool even;                                  /* samples are evenly spaced */
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
    for (int k = 0; k < 3; k++)
        m->record[k] = bins_vertex(g, m->segment, m->triangle->vertex[k]);
}

/* ------------------------------------------------------------------ order */

/* Sorts, the greatest first. */
static void sort_down(uint32_t *a, uint32_t n)
{
    for (uint32_t i = 1; i < n; i++) {
        const uint32_t key = a[i];
        uint32_t at = i;
        for (; at > 0 && a[at - 1] < key; at--)
            a[at] = a[at - 1];
        a[at] = key;
    }
}

/* Lists the tile's moving triangles from `next` on, as many as there is room for, the nearest first. What is merged in
 * a pixel is hardly ever hidden by what comes later then. */
static void list_moving(struct job *j)
{
    const struct smear_tile_run *t = j->tile;
    j->first = j->next;
    j->listed = 0;
    for (; j->next < t->moving_count && j->next - j->first < 65536u && j->listed < LISTED; j->next++)
        if (moving_is_in(&t->moving[j->next], t))
            j->list[j->listed++] = (uint32_t)t->moving[j->next].nearest << 16
                                 | (65535u - (j->next - j->first));
    sort_down(j->list, j->listed);
}

static inline uint32_t listed_moving(const struct job *j, uint32_t i)
{
    return j->first + 65535u - (j->list[i] & 0xffffu);
}

/* ------------------------------------------------------------------ segments */

/* Returns how far the shutter's times lie off an even course within one of 2^log2 segments, q16 of the exposure. */
static int32_t shutter_curvature(const struct smear_shutter_times *s, int log2)
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
    const struct smear_tile_run *t = j->tile;
    int32_t curvature = 0, travel = 0;               /* q8 px */
    for (uint32_t i = 0; i < t->moving_count; i++) {
        const struct smear_path_bounds *b = bins_bounds(t->frame->bins, t->moving[i].triangle);
        if (!moving_is_in(&t->moving[i], t))
            continue;
        travel = max_i32(travel, b->travel << 4);
        curvature = max_i32(curvature, b->curvature << 3);
    }
    curvature >>= 4;                                 /* what edges that follow parabolas leave of it, about */
    int log2 = 0;
    while (log2 < SEGMENTS_LOG2_MAX
           && (curvature >> (2 * log2) > j->settings->curvature
               || (!j->even && mul_wide(travel, shutter_curvature(t->shutter, log2)) >> 16 > j->settings->curvature)))
        log2++;
    j->segments_log2 = log2;
    j->samples_log2 = j->samples.samples_log2 - log2;
    for (int i = 0; i <= 1 << log2; i++)
        j->time[i] = t->shutter->time[i * (SHUTTER_SAMPLES >> log2)];
}

/* ------------------------------------------------------------------ triangles */

/* The triangle at a time, 0 .. SHUTTER_CLOSE, as the block sees it. Most often it is asked for one of the places that
 * are kept. */
static void pose_at(struct timemask_pose *p, const struct job *j, const struct moving *m, int32_t time)
{
    const int32_t x = j->x * 256 + 128, y = j->y * 256 + 128;
    const bool is_kept = (time & (SHUTTER_CLOSE / 2 - 1)) == 0;
    const int at = time == SHUTTER_CLOSE / 2 ? 0 : m->segment->motion + (time != 0 ? PATH_POSE_WORDS : 0);
    for (int i = 0; i < 3; i++) {
        int32_t between[3];
        const int32_t *place = m->record[i] + at;
        if (!is_kept) {
            path_at(between, m->record[i], m->segment, time);
            between[2] = clamp_i32(between[2], SMEAR_DEPTH_MIN, SMEAR_DEPTH_MAX);     /* a parabola overshoots */
            place = between;
        }
        p->x[i] = place[PATH_X] - x;
        p->y[i] = place[PATH_Y] - y;
        p->depth[i] = place[PATH_DEPTH];
    }
}

/* How depth codes follow from units q4, below and from code 32768. */
struct code_slope {
    int32_t add, shift;
    int32_t slope, size;        /* per sample, 1/16, as it is kept; its magnitude */
    uint32_t kept;
};

/* What fragments of a triangle in a segment share. */
struct painter {
    const struct timemask_shade *shade;
    struct code_slope code[2];
    int32_t first;              /* sample */
    int32_t last_sample;        /* of the exposure, less 2 `first` */
};

/* Adds the fragments of a block to its samples. */
static void paint(struct job *j, const struct timemask_cover *c, const struct painter *p)
{
    const struct timemask_shade *s = p->shade;
    const struct smear_raster_target *target = &j->tile->background;
    uint32_t run[TIMEMASK_RUNS];
    for (int32_t y = c->y0; y < c->y1; y++) {
        const uint16_t *background = target->depth + target_row(&target->window_rows, target, j->y + y) + j->x;
        const int32_t n = smear_timemask_row(c, y, run);
        for (int32_t i = 0; i < n; i++) {
            const int32_t x = timemask_run_x(run[i]), from = timemask_run_from(run[i]), to = timemask_run_to(run[i]);
            const int32_t units = clamp_i32(timemask_value(&s->depth, x, y, timemask_middle(s, run[i])), s->depth_low, s->depth_high);
            const struct code_slope *k = &p->code[units >= 32768 << 4];
            const int32_t code = (units + k->add) >> k->shift, slope = k->slope, reach = k->size * (to - from - 1) >> 5;
            const int32_t behind = background[x];
            if (code + reach <= behind)
                continue;
            struct timemask_fragment f;
            f.mask = timemask_below(p->first + to) ^ timemask_below(p->first + from);
            if (code - reach <= behind) {
                f.mask = smear_timemask_nearer((code - behind) * 32, slope, f.mask, 2 * p->first + from + to - 1);
                if (f.mask == 0)
                    continue;
            }
            /* From the run's middle to that of the exposure. A depth that would leave its range there stays as it is. */
            f.depth = code + (slope * (p->last_sample + 1 - (from + to)) >> 5);
            f.slope = slope;
            f.color = k->kept;
            if ((uint32_t)f.depth > 65535u) {
                f.depth = code;
                f.slope = 0;
                f.color = 0;
            }
            f.color |= smear_timemask_color(s, y, run[i]);
            smear_timemask_samples_add(&j->samples, (uint32_t)(y * j->stride + x), f);
            j->fragments++;
        }
    }
}

/* Draws a triangle in a segment with poses at its start, middle and end; `first` is its first sample. */
static void draw_segment(struct job *j, const struct moving *m, const struct timemask_pose *const pose[3], int32_t first)
{
    struct timemask_cover c;
    struct timemask_shade s;
    if (!smear_timemask_cover(&c, pose, j->width, j->height, j->samples_log2, j->settings->edge))
        return;
    smear_timemask_shade(&s, j->tile->frame, m->segment, m->triangle->color,
                         (m->bounds->flags & PATH_FLAT) != 0, m->record, pose, &c, j->settings->tap);
    struct painter p = { .shade = &s, .first = first, .last_sample = (1 << j->samples.samples_log2) - 1 - 2 * first };
    for (int i = 0; i < 2; i++) {
        struct code_slope *k = &p.code[i];
        k->add = i == 0 ? 8 : ((15 * 32768) << 4) + 128;
        k->shift = i == 0 ? 4 : 8;
        k->kept = smear_timemask_slope(i == 0 ? s.slope : s.slope >> 4) << 24;
        k->slope = timemask_slope_of(k->kept);
        k->size = abs_i32(k->slope);
    }
    paint(j, &c, &p);
}

static void draw_moving(struct job *j, uint32_t i)
{
    struct moving m;
    moving_take(&m, j, i);
    const struct smear_path_bounds *b = m.bounds;
    if (b->x0 >= j->x + j->width || b->x1 <= j->x || b->y0 >= j->y + j->height || b->y1 <= j->y)
        return;
    struct timemask_pose pose[3];
    pose_at(&pose[0], j, &m, j->time[0]);
    for (int k = 0; k < 1 << j->segments_log2; k++) {
        const struct timemask_pose *poses[3] = { &pose[k & 1 ? 2 : 0], &pose[1], &pose[k & 1 ? 0 : 2] };
        pose_at(&pose[1], j, &m, (j->time[k] + j->time[k + 1]) >> 1);
        pose_at(&pose[k & 1 ? 0 : 2], j, &m, j->time[k + 1]);
        draw_segment(j, &m, poses, k << j->samples_log2);
    }
}

/* ------------------------------------------------------------------ blocks */

static void finish_block(const struct job *j)
{
    const struct smear_tile_run *t = j->tile;
    const struct smear_raster_target *background = &t->background;
    for (int32_t y = 0; y < j->height; y++) {
        const uint32_t *color = background->color + target_row(&background->color_rows, background, j->y + y) + j->x;
        uint32_t *out = t->out + (j->y + y - background->y0) * t->pitch + (j->x - background->x0);
        for (int32_t x = 0; x < j->width; x++) {
            uint32_t at = (uint32_t)(y * j->stride + x);
            out[x] = j->samples.count[at] == 0 ? color[x] : smear_timemask_samples_mean(&j->samples, at, color[x]);
        }
    }
}

/* Draws the block's moving triangles, as many at a time as the list has room for. */
static void draw_block(struct job *j)
{
    smear_timemask_samples_clear(&j->samples);
    if (j->first != 0) {        /* they did not fit at once: from the start */
        j->next = 0;
        list_moving(j);
    }
    for (;;) {
        for (uint32_t i = 0; i < j->listed; i++)
            draw_moving(j, listed_moving(j, i));
        if (j->next == j->tile->moving_count)
            break;
        list_moving(j);
    }
    finish_block(j);
}

size_t smear_timemask_work(int32_t tile)
{
    (void)tile;
    return timemask_samples_bytes(1u << PIXELS_LOG2) + LISTED * sizeof(uint32_t);
}

uint32_t smear_timemask_tile(const struct smear_tile_run *t, const struct smear_timemask_settings *settings)
{
    const struct smear_raster_target *background = &t->background;
    struct job j = { .tile = t, .settings = settings, .list = (uint32_t *)t->work };
    smear_timemask_samples_place(&j.samples, j.list + LISTED, PIXELS_LOG2,
                               31 - count_leading_zeros((uint32_t)settings->samples),
                                 frame_transfer(t->frame));
    j.even = smear_shutter_is_box(t->shutter);
    choose_segments(&j);
    list_moving(&j);
    /* The largest blocks whose entries fit: halves of the tile. */
    int32_t height = t->tile;
    for (j.stride = t->tile; j.stride > TIMEMASK_WIDTH;)
        j.stride >>= 1;
    while (height > TIMEMASK_HEIGHT || height * j.stride > 1 << PIXELS_LOG2)
        height >>= 1;
    for (j.y = background->y0; j.y < background->y1; j.y += height)
        for (j.x = background->x0; j.x < background->x1; j.x += j.stride) {
            j.width = min_i32(background->x1 - j.x, j.stride);
            j.height = min_i32(background->y1 - j.y, height);
            draw_block(&j);
        }
    return j.fragments;
}
