/* SPDX-License-Identifier: MIT */
/* layered.c - see layer.h.
 *
 *     static      triangles of no group, into the row
 *     list        where each group lies in the row and around it
 *     for each group, from the farthest to the nearest:
 *         draw    as it is in the middle of the exposure, into rows of its own
 *         merge   blurred, by coverage and depth, over the row
 *     finish      blended draws, conversion; flush
 *
 * A group that does not reach the row costs nothing there. */
#include "layers/layer.h"

#include "kernels/fill.h"
#include "display/band.h"
#include "display/points.h"

#if SMEAR_WITH_LAYERS

/* What the jobs of a tile row share. */
struct layers_row {
    struct row_job row;
    struct smear_layers *layers;
    int32_t samples;
    struct smear_raster_target background;      /* what is static, and what was merged over it */
    bool mixes;                 /* groups pass through each other */
    /* the group that is being merged */
    struct smear_group *group;
    struct smear_streak streak;
    struct smear_layer_area area;
    int32_t vx, vy;             /* of taps: no farther than there are pixels */
    struct smear_raster_target target;      /* rows that are drawn */
    struct smear_raster_frame frame;
};

/* Few taps along one displacement. */
static inline bool is_two_camera(const struct layers_row *r)
{
    return r->group->method == SMEAR_OBJECT && r->layers->setting[r->group->layer].layer.two_camera;
}

/* Taps over a background, not sums along streaks. */
static inline bool gathers(const struct layers_row *r)
{
    return r->group->method == SMEAR_LAYERED || is_two_camera(r);
}

/* ------------------------------------------------------------------ draw */

static void background_job(void *argument, int job, int worker)
{
    const struct layers_row *r = (const struct layers_row *)argument;
    struct smear_raster_target t = r->background;
    (void)worker;
    if (!smear_row_draw_opaque(&r->row, job, &t, 0))
        return;
    for (int32_t y = t.y0; r->mixes && (r->row.steps & ROW_CLEAR) && y < t.y1; y++)
        pixels_fill(r->layers->rows.over + target_row(&t.window_rows, &t, y) + t.x0, 0, t.x1 - t.x0);
}

/* Clears columns [x0, x1) of a row of the target's planes. */
static void clear_columns(const struct smear_raster_target *t, int32_t row, int32_t x0, int32_t x1)
{
    int32_t at = row * t->window_rows.stride + x0, n = x1 - x0;
    if (n <= 0)
        return;
    pixels_fill(t->color + at, SMEAR_UNCOVERED, n);
    pixels_clear_narrow(t->depth + at, n);
    if (t->velocity8 != NULL)
        __builtin_memset(t->velocity8 + 2 * at, 0, (size_t)n * 2);
    if (t->velocity16 != NULL)
        __builtin_memset(t->velocity16 + 2 * at, 0, (size_t)n * 4);
}

/* Draws the group's rows, in as many cuts of columns as there are workers. */
static void draw_job(void *argument, int job, int worker)
{
    const struct layers_row *r = (const struct layers_row *)argument;
    struct smear_raster_target t = r->target;
    int32_t units = (t.x1 - t.x0 + 15) >> 4, n = r->row.rows->jobs.workers, x0 = t.x0;
    (void)worker;
    t.x1 = min_i32(x0 + units * (job + 1) / n * 16, t.x1);
    t.x0 = x0 + units * job / n * 16;
    if (t.x0 >= t.x1)
        return;
    if (r->row.steps & ROW_CLEAR)
        for (int32_t row = t.window_rows.ring_row; row < r->area.rows; row++)
            clear_columns(&t, row, t.x0, t.x1);
    t.over = r->row.rows->refill != NULL;
    if (r->row.steps & ROW_DRAW)
        smear_raster_list(&r->frame, &t, r->group->head);
}

/* Finds what is drawn in each row. Pixels of texels, which have written something else on top, get to say whether they are covered. */
static void find_extents(const struct layers_row *r)
{
    const struct smear_layer_rows *rows = &r->layers->rows;
    for (int32_t y = 0; y < r->area.rows; y++) {
        const uint16_t *depth = rows->depth + y * rows->width;
        uint32_t *color = rows->color + y * rows->width;
        int32_t first = r->target.x0, end = r->target.x1;
        while (first < end && depth[first] == 0)
            first++;
        while (end > first && depth[end - 1] == 0)
            end--;
        rows->row_first[y] = (int16_t)first;
        rows->row_end[y] = (int16_t)end;
        for (int32_t x = first; r->group->textured && x < end; x++)
            color[x] = depth[x] != 0 ? color[x] & 0xffffffu : SMEAR_UNCOVERED;
    }
}

/* Begins or goes on with the triangles of a group in a row that is refilled; false when there are none left. A tile row
 * above and below belongs to that of groups. */
static bool fill_group(const struct layers_row *r, const struct smear_group *group, bool next)
{
    struct smear_rows *rows = r->row.rows;
    const int row = r->row.row;
    rows->refill->group = (uint16_t)(group - r->layers->group);
    if (next ? !smear_row_fill_next(rows) : !smear_row_fill(rows, row, FILL_GROUP))
        return false;
    rows->moving = SMEAR_NO_TRIANGLE;
    for (int i = row; i <= row + 2; i++)
        rows->moving = smear_bins_merge(&rows->bins, rows->bins.moving_last, rows->moving, i, row_top(rows, row));
    return true;
}

static void draw_refilled(struct layers_row *r)
{
    struct smear_rows *rows = r->row.rows;
    r->row.steps = ROW_CLEAR;
    smear_jobs_run(&rows->jobs, draw_job, r, rows->jobs.workers);
    r->row.steps = ROW_DRAW;
    for (bool any = fill_group(r, r->group, false); any; any = fill_group(r, r->group, true)) {
        r->group->head = rows->moving;
        smear_jobs_run(&rows->jobs, draw_job, r, rows->jobs.workers);
    }
}

/* Draws the group's triangles: its part of the list of moving ones. */
static void draw_listed(struct layers_row *r)
{
    struct smear_jobs *jobs = &r->row.rows->jobs;
    struct smear_triangle *tail = bins_triangle(&r->row.rows->bins, r->group->tail);
    const uint32_t after = tail->next;
    tail->next = SMEAR_NO_TRIANGLE;
    r->row.steps = ROW_ALL;
    smear_jobs_run(jobs, draw_job, r, jobs->workers);
    tail->next = after;
}

/* Moves what was drawn of the group for the tile row before to where the area has it; the target begins below that. */
static void keep_drawn(struct layers_row *r)
{
    struct smear_layer_rows *l = &r->layers->rows;
    struct smear_raster_target *t = &r->target;
    if (l->drawn == r->group && l->x0 <= t->x0 && l->x1 >= t->x1 && l->y0 <= t->y0 && l->y1 > t->y0 && r->row.rows->refill == NULL) {
        const size_t n = (size_t)l->width, kept = (size_t)(l->y1 - t->y0), from = (size_t)(t->y0 - l->y0);
        for (size_t i = 0; from != 0 && i < kept; i++) {
            __builtin_memcpy(l->color + i * n, l->color + (i + from) * n, n * sizeof *l->color);
            __builtin_memcpy(l->depth + i * n, l->depth + (i + from) * n, n * sizeof *l->depth);
            if (t->velocity8 != NULL)
                __builtin_memcpy(l->velocity8 + 2 * i * n, l->velocity8 + 2 * (i + from) * n, 2 * n);
            if (t->velocity16 != NULL)
                __builtin_memcpy(l->velocity16 + 2 * i * n, l->velocity16 + 2 * (i + from) * n, 4 * n);
        }
        t->y0 = l->y1;
        t->window_rows.ring_row = t->color_rows.ring_row = (int32_t)kept;
    }
    l->drawn = r->group;
    l->x0 = t->x0;
    l->x1 = t->x1;
    l->y0 = t->y0 - t->window_rows.ring_row;
    l->y1 = t->y1;
}

static void draw_group(struct layers_row *r)
{
    keep_drawn(r);
    if (r->row.rows->refill != NULL)
        draw_refilled(r);
    else
        draw_listed(r);
    find_extents(r);
}

/* ------------------------------------------------------------------ merge */

static void merge_job(void *argument, int job, int worker)
{
    const struct layers_row *r = (const struct layers_row *)argument;
    struct smear_rows *rows = r->row.rows;
    struct smear_layer_area area = r->area;
    smear_job_columns(rows, job, &area.left, &area.right);
    area.work = (uint8_t *)area.work + (uint32_t)worker * r->layers->rows.work_bytes;
    const uint32_t samples = is_two_camera(r) ? smear_two_camera_merge(&area, r->vx, r->vy)
                           : gathers(r)       ? smear_gather_merge(&area)
                                              : smear_streak_merge(&r->streak, &area);
    rows->samples[worker] += samples;
}

/* Blended draws are drawn sharp: what moves hides them where it is in the middle of the exposure. */
static void keep_depths(const struct layers_row *r)
{
    const struct smear_layer_rows *rows = &r->layers->rows;
    for (int32_t y = 0; y < r->area.height; y++) {
        const uint16_t *depth = rows->depth + (y + r->area.top) * rows->width + rows->margin;
        uint16_t *under = r->area.background_depth + y * r->area.background_stride;
        for (int32_t x = max_i32(r->target.x0 - rows->margin, 0);
             x < min_i32(r->target.x1 - rows->margin, r->row.rows->window.width); x++)
            under[x] = (uint16_t)max_u32(under[x], depth[x]);
    }
}

/* Marks the tile columns that the group's streaks reach. */
static void mark_tiles(const struct layers_row *r)
{
    const struct smear_window *w = &r->row.rows->window;
    int32_t x0 = r->group->x0 - r->streak.reach_x - r->layers->rows.margin,
            x1 = r->group->x1 + r->streak.reach_x - r->layers->rows.margin;
    for (int32_t i = max_i32(x0, 0) >> w->tile_shift; i <= (min_i32(x1, w->width) - 1) >> w->tile_shift; i++)
        w->moving[i] |= r->group->method == SMEAR_LAYERED ? TILE_LAYERED : TILE_OBJECT;
}

/* Finds how far and along what the group is blurred. */
static void set_streak(struct layers_row *r)
{
    const struct smear_window *w = &r->row.rows->window;
    struct smear_streak *s = &r->streak;
    smear_streak_make(s, r->group->vx, r->group->vy, streak_half_max(w->width), w->reach);
    if (!gathers(r))
        return;
    const int32_t most = 2 * w->reach << 8;
    r->vx = clamp_i32(r->group->vx, -most, most);
    r->vy = clamp_i32(r->group->vy, -most, most);
    s->upright = false;
    s->reach_x = s->reach_y = w->reach;
}

/* Where the group's rows lie, and the frame's that they are merged over. */
static void set_area(struct layers_row *r)
{
    const struct smear_rows *frame = r->row.rows;
    const struct smear_layer_rows *rows = &r->layers->rows;
    const int32_t height = r->background.y1 - r->background.y0;
    r->area = (struct smear_layer_area){
        .layer = rows, .group = r->group, .rows = height + 2 * r->streak.reach_y, .top = r->streak.reach_y,
        .background = r->background.color, .background_depth = r->background.depth, .background_stride = frame->window.width,
        .height = height, .tile_shift = frame->window.tile_shift, .samples = min_i32(r->samples, SMEAR_GATHER_TAPS), .work = rows->work,
        .transfer = frame->raster.transfer
    };
}

/* What of the group's rows is drawn. Lines that go down, and taps, look beyond the group's columns. */
static void set_target(struct layers_row *r, int32_t y0, int32_t y1)
{
    const struct smear_rows *frame = r->row.rows;
    const struct smear_layer_rows *rows = &r->layers->rows;
    const struct smear_group *group = r->group;
    const int32_t beside = r->streak.upright || gathers(r) ? (2 * r->streak.reach_x + 15) & ~15 : 0;
    r->target = (struct smear_raster_target){
        .x0 = max_i32(group->x0 - beside, 0), .y0 = y0,
        .x1 = min_i32(group->x1 + beside, rows->width), .y1 = y1,
        .color = rows->color, .depth = rows->depth,
        .tile_shift = (uint8_t)frame->window.tile_shift
    };
    r->target.color_rows = r->target.window_rows = (struct smear_plane_rows){ rows->width, 0, rows->rows, 0 };
    r->frame = frame->raster;
    r->frame.width = rows->width;
    r->frame.height = rows->height;
    if (group->method != SMEAR_LAYERED)
        return;
    r->target.velocity8 = rows->velocity8;
    r->target.velocity16 = rows->velocity16;
    r->frame.velocity_scale = mul_shift(r->frame.velocity_scale, r->layers->setting[group->layer].shutter, 16);
}

static void merge_group(struct layers_row *r, struct smear_group *group)
{
    struct smear_rows *frame = r->row.rows;
    r->group = group;
    set_streak(r);
    set_area(r);
    const int32_t y0 = row_top(frame, r->row.row) + frame->window.tile - r->streak.reach_y, y1 = y0 + r->area.rows;
    set_target(r, y0, y1);
    draw_group(r);
    if (group->method == SMEAR_LAYERED)
        smear_gather_cells(&r->area);
    smear_jobs_run(&frame->jobs, merge_job, r, frame->jobs.workers);
    if (frame->blends || rows_have_points(frame))
        keep_depths(r);
    mark_tiles(r);
}

/* ------------------------------------------------------------------ the row */

static void blend_job(void *argument, int job, int worker)
{
    const struct layers_row *r = (const struct layers_row *)argument;
    struct smear_raster_target t = r->background;
    (void)worker;
    smear_job_columns(r->row.rows, job, &t.x0, &t.x1);
    if (t.x0 < t.x1 && (r->row.steps & ROW_DRAW))
        smear_raster_list(&r->row.rows->raster, &t, r->row.rows->blend);
}

static void convert_job(void *argument, int job, int worker)
{
    const struct layers_row *r = (const struct layers_row *)argument;
    int32_t x0, x1;
    (void)worker;
    smear_job_columns(r->row.rows, job, &x0, &x1);
    smear_band_convert_rows(&r->row, &r->background, x0, x1);
}

static void count_tiles(const struct smear_rows *rows)
{
    for (int32_t i = 0; i < rows->window.columns; i++) {
        const uint32_t reached = rows->window.moving[i];
        if ((reached & TILE_LAYERED) != 0)
            smear_row_count(rows, TILE_COMPLEX, SMEAR_LAYERED);
        else
            smear_row_count(rows, reached == 0 ? TILE_STATIC : TILE_UNIFORM, SMEAR_OBJECT);
    }
}

/* Moves the lists on to tile row `row`: a tile row above and below belongs to that of groups. */
static void list_row(const struct layers_row *r, bool first)
{
    struct smear_rows *rows = r->row.rows;
    const int row = r->row.row;
    struct smear_layers *l = r->layers;
    if (rows->refill != NULL) {
        smear_groups_list_begin(l);
        for (uint32_t i = 0; i < l->group_count; i++) {
            rows->refill->counted &= (uint8_t)~FILL_GROUP;      /* this is the first way through each group */
            for (bool any = fill_group(r, &l->group[i], false); any; any = fill_group(r, &l->group[i], true))
                smear_groups_list_add(&l->group[i], &rows->bins, rows->moving);
        }
        smear_groups_list_end(l);
        return;
    }
    rows->opaque = row_advance(rows, rows->bins.opaque_last, rows->opaque, row);
    for (int next = first ? row : row + 2; next <= row + 2; next++)
        rows->moving = smear_bins_merge(&rows->bins, rows->bins.moving_last, rows->moving, next, row_top(rows, row));
    smear_groups_list(l, &rows->bins, rows->moving);
}

static void merge_row(struct layers_row *r)
{
    struct smear_rows *rows = r->row.rows;
    const struct smear_layers *l = r->layers;
    for (int32_t i = 0; i < rows->window.columns; i++)
        rows->window.moving[i] = 0;
    for (uint32_t i = 0; i < l->group_count; i++) {
        struct smear_group *group = &l->group[l->order[i]];
        if (group->head != SMEAR_NO_TRIANGLE && group->x0 < group->x1)
            merge_group(r, group);
    }
    count_tiles(rows);
    if (!rows->blends)
        return;
    if (rows->refill == NULL)
        rows->blend = row_advance(rows, rows->bins.blend_last, rows->blend, r->row.row);
    smear_row_run(rows, blend_job, &r->row, FILL_BLENDED);
}

static int finish_row(struct smear_layers *l, struct smear_rows *rows, int32_t samples, int row, bool first)
{
    struct layers_row r = { .row = { .rows = rows, .row = row }, .layers = l, .samples = samples };
    uint32_t start = stage_start(rows);
    smear_row_target(rows, row, &r.background);
    r.background.color_rows = r.background.window_rows
        = (struct smear_plane_rows){ rows->window.width, 0, rows->window.tile, 0 };
    list_row(&r, first);
    r.mixes = smear_groups_find_mixed(l, rows->window.reach);
    smear_row_run(rows, background_job, &r.row, FILL_STATIC | FILL_MOVING);
    stage_end(rows, &rows->stats->time.raster, start);
    start = stage_start(rows);
    merge_row(&r);
    stage_end(rows, &rows->stats->time.blur, start);
    start = stage_start(rows);
    r.row.band = smear_band_begin(rows);
    rows_list_points(rows, row_top(rows, row), row_bottom(rows, row));
    smear_jobs_run(&rows->jobs, convert_job, &r, rows->jobs.workers);
    stage_end(rows, &rows->stats->time.convert, start);
    return smear_band_flush(&r.row);
}

int smear_layered_rows(struct smear_layers *l, struct smear_rows *rows, int32_t samples, int first, int end)
{
    l->rows.drawn = NULL;
    for (int row = first; row < end; row++) {
        int result = finish_row(l, rows, samples, row, row == first);
        if (result != SMEAR_OK)
            return result;
    }
    return SMEAR_OK;
}

#endif
