/* SPDX-License-Identifier: MIT */
/* layers.c - groups of draws (layer.h), and tile rows in which they are merged over the still scene.
 *
 *     still       triangles of no group, into the row
 *     list        where each group lies in the row and around it
 *     for each group, from the farthest to the nearest:
 *         draw    as it is in the middle of the exposure, into rows of its own
 *         merge   blurred, by coverage and depth, over the row
 *     finish      blended draws, conversion; flush
 *
 * A group that does not reach the row costs nothing there. */
#include "layers.h"

#include "assemble.h"
#include "object.h"
#include "pixel.h"
#include "raster.h"

/* ------------------------------------------------------------------ groups */

void smear_layers_begin(struct smear_context *c)
{
    c->layers.on = true;
    c->layers.group_count = 0;
    for (uint32_t i = 0; i < c->draw_count; i++)
        c->layers.group_of[i] = SMEAR_NO_GROUP;
}

/* Vertices that stand for a draw. */
enum { SAMPLES = 24 };

/* What vertices of a draw say of its motion. */
struct motion {
    int32_t x, y, depth, longest, count;
};

static void measure(struct motion *m, const struct smear_context *c, const smear_mesh *mesh,
                    const struct smear_placement key[2], const struct smear_placement *middle)
{
    const struct smear_viewport *viewport = &c->assembler.viewport;
    const int32_t far_out = 1 << 20;
    uint32_t step = max_u32(mesh->vertex_count / SAMPLES, 1);
    *m = (struct motion){ 0, 0, 0, 0, 0 };
    for (uint32_t i = step >> 1; i < mesh->vertex_count && m->count < SAMPLES; i += step) {
        struct smear_homogeneous h;
        struct smear_screen open, close, now;
        if (((placement_project(&open, &h, &key[0], i, viewport) | placement_project(&close, &h, &key[1], i, viewport)
              | placement_project(&now, &h, middle, i, viewport)) & OUT_NEAR) != 0)
            continue;
        int32_t x = clamp_i32(close.x - open.x, -far_out, far_out), y = clamp_i32(close.y - open.y, -far_out, far_out);
        m->x += x;
        m->y += y;
        m->depth += now.depth / SAMPLES;
        m->longest = max_i32(m->longest, max_i32(abs_i32(x), abs_i32(y)));
        m->count++;
    }
}

void smear_layers_add(struct smear_context *c, uint32_t draw, const smear_mesh *mesh, uint8_t layer,
                      const struct smear_placement key[2], const struct smear_placement *middle)
{
    struct smear_layers *l = &c->layers;
    struct motion m;
    measure(&m, c, mesh, key, middle);
    if (m.longest < 8)          /* 1/32 px */
        return;
    int32_t vx = m.x / m.count, vy = m.y / m.count, depth = m.depth / m.count * SAMPLES;
    struct smear_group *last = l->group_count != 0 ? &l->group[l->group_count - 1] : NULL;
    if (last == NULL || last->layer != layer || abs_i32(last->vx - vx) > 64 || abs_i32(last->vy - vy) > 64) {
        last = &l->group[l->group_count++];
        *last = (struct smear_group){ .vx = vx, .vy = vy, .depth = depth, .layer = layer };
    }
    l->group_of[draw] = (uint16_t)(l->group_count - 1);
}

void smear_layers_end(struct smear_context *c)
{
    struct smear_layers *l = &c->layers;
    for (uint32_t i = 0; i < l->group_count; i++) {
        uint32_t at = i;
        for (; at > 0 && l->group[l->order[at - 1]].depth > l->group[i].depth; at--)
            l->order[at] = l->order[at - 1];
        l->order[at] = (uint16_t)i;
    }
}

/* The store takes triangles of layers at the places that layer.h tells, into lists of their own. */
bool smear_layers_assemble(struct smear_context *c, const struct smear_assembly *a, bool drop)
{
    struct smear_geometry *g = &c->geometry;
    const struct smear_viewport viewport = c->assembler.viewport;
    uint32_t *opaque = g->opaque_last;
    int end = g->row_end;
    c->assembler.viewport = (struct smear_viewport){ c->layers.rows.width, c->layers.rows.height };
    g->opaque_last = g->mover_last;
    g->row_end = end + g->mover_rows;
    bool added = smear_assemble(&c->assembler, a, drop);
    g->row_end = end;
    g->opaque_last = opaque;
    c->assembler.viewport = viewport;
    c->layers.group[c->layers.group_of[a->draw]].end = g->triangle_count;
    return added;
}

/* ------------------------------------------------------------------ lists */

static uint16_t code_of(int32_t depth)
{
    uint32_t units = (uint32_t)depth >> 11;
    return (uint16_t)(units < 32768u ? units : 32768u + ((units - 32768u) >> 4));
}

static void extend(struct smear_group *group, const struct smear_geometry *g, const struct smear_triangle *t)
{
    if (t->segment == SMEAR_POINT) {
        group->x0 = min_i32(group->x0, t->x);
        group->x1 = max_i32(group->x1, t->x + 1);
        group->nearest = (uint16_t)max_u32(group->nearest, t->depth);
        group->farthest = (uint16_t)min_u32(group->farthest, t->depth);
        return;
    }
    const struct smear_segment *s = &g->segment[t->segment];
    int32_t x0 = INT32_MAX, x1 = INT32_MIN, low = INT32_MAX, high = 0;
    for (int i = 0; i < 3; i++) {
        const int32_t *v = geometry_vertex(g, s, t->vertex[i]);
        x0 = min_i32(x0, v[VERTEX_X]);
        x1 = max_i32(x1, v[VERTEX_X]);
        low = min_i32(low, v[VERTEX_DEPTH]);
        high = max_i32(high, v[VERTEX_DEPTH]);
    }
    group->x0 = min_i32(group->x0, (x0 + 127) >> 8);
    group->x1 = max_i32(group->x1, (x1 + 127) >> 8);
    group->nearest = (uint16_t)max_u32(group->nearest, min_u32(code_of(high) + 1u, UINT16_MAX));
    group->farthest = (uint16_t)min_u32(group->farthest, code_of(low));
}

/* Finds each group's part of the movers' list. */
static void list_groups(struct smear_context *c)
{
    struct smear_layers *l = &c->layers;
    const struct smear_geometry *g = &c->geometry;
    for (uint32_t i = 0; i < l->group_count; i++) {
        struct smear_group *group = &l->group[i];
        group->head = group->tail = SMEAR_NO_TRIANGLE;
        group->x0 = INT32_MAX;
        group->x1 = INT32_MIN;
        group->nearest = 0;
        group->farthest = UINT16_MAX;
    }
    struct smear_group *group = l->group;
    for (uint32_t i = c->moving; i != SMEAR_NO_TRIANGLE;) {
        const struct smear_triangle *t = geometry_triangle(g, i);
        while (i >= group->end)
            group++;
        if (group->head == SMEAR_NO_TRIANGLE)
            group->head = i;
        group->tail = i;
        extend(group, g, t);
        i = t->next;
    }
    for (uint32_t i = 0; i < l->group_count; i++) {
        group = &l->group[i];
        group->x0 = max_i32(group->x0, 0) & ~15;        /* cuts of columns lie on multiples of 16 */
        group->x1 = min_i32((group->x1 + 15) & ~15, l->rows.width);
    }
}

/* ------------------------------------------------------------------ the row */

/* A tile row on its way. */
struct layers_row {
    struct row_job row;
    struct smear_raster_target still;
    bool mixes;                 /* groups pass through each other */
    /* the group that is being merged */
    struct smear_group *group;
    struct smear_streak streak;
    struct smear_streak_area area;
    struct smear_raster_target target;
    struct smear_raster_frame frame;
};

static void still_job(void *argument, int job, int worker)
{
    const struct layers_row *r = argument;
    struct smear_raster_target t = r->still;
    (void)worker;
    smear_job_columns(r->row.c, job, &t.x0, &t.x1);
    if (t.x0 >= t.x1)
        return;
    for (int32_t y = t.y0; y < t.y1; y++) {
        int32_t at = target_row(&t.window_rows, &t, y) + t.x0;
        pixels_fill(t.color + at, r->row.c->frame.clear & 0xffffffu, t.x1 - t.x0);
        __builtin_memset(t.depth + at, 0, (size_t)(t.x1 - t.x0) * 2);
    }
    smear_raster_list(&r->row.c->raster, &t, r->row.c->opaque);
    for (int32_t y = t.y0; r->mixes && y < t.y1; y++)
        pixels_fill(r->row.c->layers.rows.over + target_row(&t.window_rows, &t, y) + t.x0, 0, t.x1 - t.x0);
}

/* Columns [x0, x1) of the group's rows, in as many cuts as there are workers. */
static void draw_job(void *argument, int job, int worker)
{
    const struct layers_row *r = argument;
    struct smear_raster_target t = r->target;
    int32_t units = (t.x1 - t.x0 + 15) >> 4, n = r->row.c->jobs.workers, x0 = t.x0;
    (void)worker;
    t.x1 = min_i32(x0 + units * (job + 1) / n * 16, t.x1);
    t.x0 = x0 + units * job / n * 16;
    if (t.x0 >= t.x1)
        return;
    for (int32_t y = t.y0; y < t.y1; y++) {
        int32_t at = target_row(&t.window_rows, &t, y) + t.x0;
        pixels_fill(t.color + at, SMEAR_UNCOVERED, t.x1 - t.x0);
        __builtin_memset(t.depth + at, 0, (size_t)(t.x1 - t.x0) * 2);
    }
    smear_raster_list(&r->frame, &t, r->group->head);
}

/* What is drawn in each row. */
static void find_drawn(const struct smear_layer_rows *rows, const struct smear_raster_target *t)
{
    for (int32_t y = 0; y < t->y1 - t->y0; y++) {
        const uint16_t *depth = rows->depth + y * rows->width;
        int32_t first = t->x0, end = t->x1;
        uint64_t four = 0;
        while (end - first >= 4 && (__builtin_memcpy(&four, depth + first, 8), four == 0))
            first += 4;
        while (end - first >= 4 && (__builtin_memcpy(&four, depth + end - 4, 8), four == 0))
            end -= 4;
        while (first < end && depth[first] == 0)
            first++;
        while (end > first && depth[end - 1] == 0)
            end--;
        rows->row_first[y] = (int16_t)first;
        rows->row_end[y] = (int16_t)end;
    }
}

static void merge_job(void *argument, int job, int worker)
{
    const struct layers_row *r = argument;
    struct smear_streak_area area = r->area;
    smear_job_columns(r->row.c, job, &area.left, &area.right);
    area.work = (uint8_t *)area.work + (uint32_t)worker * r->row.c->layers.rows.work_bytes;
    r->row.c->worker_samples[worker] += smear_streak_merge(&r->streak, &area);
}

static void convert_job(void *argument, int job, int worker)
{
    const struct layers_row *r = argument;
    int32_t x0, x1;
    (void)worker;
    smear_job_columns(r->row.c, job, &x0, &x1);
    smear_band_convert_rows(&r->row, &r->still, x0, x1);
}

/* Tile columns that the group's streaks reach. */
static void mark_tiles(struct smear_context *c, const struct layers_row *r)
{
    const struct smear_window *w = &c->window;
    int32_t x0 = r->group->x0 - r->streak.reach_x - r->area.margin, x1 = r->group->x1 + r->streak.reach_x - r->area.margin;
    for (int32_t i = max_i32(x0, 0) >> w->tile_shift; i <= (min_i32(x1, w->width) - 1) >> w->tile_shift; i++)
        w->moving[i] = 1;
}

static int32_t reach_of(const struct smear_group *group)
{
    return (abs_i32(group->vx) >> 9) + 2;
}

/* Where groups lie in part behind others that are merged before them. */
static bool find_mixed(const struct smear_context *c)
{
    const struct smear_layers *l = &c->layers;
    bool any = false;
    for (uint32_t i = 0; i < l->group_count; i++) {
        struct smear_group *g = &l->group[l->order[i]];
        g->mixed0 = INT32_MAX;
        g->mixed1 = INT32_MIN;
        g->marks = false;
        for (uint32_t k = 0; k < i && g->head != SMEAR_NO_TRIANGLE; k++) {
            struct smear_group *before = &l->group[l->order[k]];
            int32_t x0 = max_i32(g->x0 - reach_of(g), before->x0 - reach_of(before));
            int32_t x1 = min_i32(g->x1 + reach_of(g), before->x1 + reach_of(before));
            if (before->head == SMEAR_NO_TRIANGLE || g->farthest >= before->nearest || x0 >= x1)
                continue;
            g->mixed0 = min_i32(g->mixed0, x0);
            g->mixed1 = max_i32(g->mixed1, x1);
            before->mixed0 = min_i32(before->mixed0, x0);
            before->mixed1 = max_i32(before->mixed1, x1);
            before->marks = any = true;
        }
    }
    return any;
}

static void merge_group(struct smear_context *c, struct layers_row *r, struct smear_group *group)
{
    const struct smear_layer_rows *rows = &c->layers.rows;
    struct smear_streak *s = &r->streak;
    int32_t top = row_top(c, r->row.row) + c->window.tile, height = r->still.y1 - r->still.y0;
    smear_streak_make(s, group->vx, group->vy, streak_half_max(c->window.width), c->window.reach);
    r->group = group;
    r->area = (struct smear_streak_area){
        .color = rows->color, .depth = rows->depth, .stride = rows->width, .x0 = group->x0, .x1 = group->x1,
        .rows = height + 2 * s->reach_y, .top = s->reach_y, .margin = rows->margin,
        .still = r->still.color, .still_depth = r->still.depth, .still_stride = c->window.width, .height = height,
        .nearest = group->nearest, .farthest = group->farthest,
        .linear = c->raster.linear,
        .row_first = rows->row_first, .row_end = rows->row_end, .edge = rows->edge, .work = rows->work,
        .over = rows->over, .over_depth = rows->over_depth,
        .mixed0 = group->mixed0, .mixed1 = group->mixed1, .marks = group->marks
    };
    const struct smear_plane_rows plane = { rows->width, 0, rows->rows, 0 };
    /* Lines that go down look beyond the drawn columns. */
    int32_t beside = s->upright ? (2 * s->reach_x + 15) & ~15 : 0;
    r->target = (struct smear_raster_target){
        .x0 = max_i32(group->x0 - beside, 0), .x1 = min_i32(group->x1 + beside, rows->width),
        .y0 = top - s->reach_y, .y1 = top + height + s->reach_y,
        .color = rows->color, .color_rows = plane, .depth = rows->depth, .window_rows = plane,
        .tile_shift = (uint8_t)c->window.tile_shift
    };
    r->frame = c->raster;
    r->frame.width = rows->width;
    r->frame.height = rows->height;
    smear_streak_edges(s, rows->edge, s->upright ? r->area.rows : rows->width);
    struct smear_triangle *tail = geometry_triangle(&c->geometry, group->tail);
    uint32_t after = tail->next;
    tail->next = SMEAR_NO_TRIANGLE;
    smear_jobs_run(&c->jobs, draw_job, r, c->jobs.workers);
    tail->next = after;
    find_drawn(rows, &r->target);
    smear_jobs_run(&c->jobs, merge_job, r, c->jobs.workers);
    mark_tiles(c, r);
}

static void count_tiles(struct smear_context *c)
{
    smear_stats *s = &c->stats;
    for (int32_t i = 0; i < c->window.columns; i++) {
        bool reached = c->window.moving[i];
        s->tiles_still += !reached;
        s->tiles_none += !reached;
        s->tiles_uniform += reached;
        s->tiles_object += reached;
    }
}

/* The movers' list for tile row `row`: a tile row above and below belongs to it. */
static void advance_movers(struct smear_context *c, int row, bool first)
{
    const struct smear_geometry *g = &c->geometry;
    int32_t y = row_top(c, row);
    for (int next = first ? row : row + 2; next <= row + 2; next++)
        c->moving = smear_geometry_merge(g, g->mover_last, c->moving, next, y);
}

static int finish_row(struct smear_context *c, int row, bool first)
{
    struct layers_row r = { .row = { c, row, NULL } };
    uint32_t start = stage_start(c);
    smear_row_target(c, row, &r.still);
    r.still.color_rows = r.still.window_rows = (struct smear_plane_rows){ c->window.width, 0, c->window.tile, 0 };
    c->opaque = smear_geometry_advance(&c->geometry, c->geometry.opaque_last, c->opaque, row);
    advance_movers(c, row, first);
    list_groups(c);
    r.mixes = find_mixed(c);
    smear_jobs_run(&c->jobs, still_job, &r, c->jobs.workers);
    stage_end(c, &c->stats.time_raster, start);
    start = stage_start(c);
    for (int32_t i = 0; i < c->window.columns; i++)
        c->window.moving[i] = 0;
    for (uint32_t i = 0; i < c->layers.group_count; i++) {
        struct smear_group *group = &c->layers.group[c->layers.order[i]];
        if (group->head != SMEAR_NO_TRIANGLE && group->x0 < group->x1)
            merge_group(c, &r, group);
    }
    count_tiles(c);
    stage_end(c, &c->stats.time_blur, start);
    start = stage_start(c);
    r.row.band = smear_band_begin(c);
    smear_jobs_run(&c->jobs, convert_job, &r, c->jobs.workers);
    stage_end(c, &c->stats.time_convert, start);
    return smear_band_flush(c, row, r.row.band);
}

int smear_layers_rows(struct smear_context *c, int first, int end)
{
    for (int row = first; row < end; row++) {
        int result = finish_row(c, row, row == first);
        if (result != SMEAR_OK)
            return result;
    }
    return SMEAR_OK;
}
