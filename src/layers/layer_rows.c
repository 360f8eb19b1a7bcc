/* SPDX-License-Identifier: MIT */
/* layer_rows.c - groups of draws (layer.h), and tile rows in which they are merged over the still scene.
 *
 *     still       triangles of no group, into the row
 *     list        where each group lies in the row and around it
 *     for each group, from the farthest to the nearest:
 *         draw    as it is in the middle of the exposure, into rows of its own
 *         merge   blurred, by coverage and depth, over the row
 *     finish      blended draws, conversion; flush
 *
 * A group that does not reach the row costs nothing there. */
#include "layers/layer_rows.h"

#include "geometry/assemble.h"
#include "layers/layer_gather.h"
#include "layers/streak.h"
#include "base/pixel.h"
#include "kernels/fill.h"
#include "raster/raster.h"

/* ------------------------------------------------------------------ groups */

/* A draw's layer: the first that shares a bit with it. */
static uint8_t find_layer(const struct smear_context *c, const smear_draw *draw)
{
    uint32_t bits = draw->layers != 0 ? draw->layers : 1u;
    for (int i = 0; i < c->layers->setting_count; i++)
        if ((c->layers->setting[i].layer.mask & bits) != 0)
            return (uint8_t)i;
    return SMEAR_NO_LAYER;
}

void smear_layers_begin(struct smear_context *c)
{
    c->layers->on = true;
    c->layers->group_count = 0;
    for (uint32_t i = 0; i < c->draw_count; i++) {
        c->layers->group_of[i] = SMEAR_NO_GROUP;
        c->layers->layer_of[i] = find_layer(c, &c->submitted[i].draw);
    }
}

/* Vertices that stand for a draw. */
enum { SAMPLES = 24 };

/* What vertices of a draw say of its motion. */
struct motion {
    int32_t x, y, depth, longest, count;
    int32_t x0, x1, y0, y1;     /* least and largest displacements */
    bool cut;                   /* some lie before the near plane */
};

/* Vertices that are nearer than the mean count: the others are more likely hidden. */
static void measure(struct motion *m, const struct smear_context *c, const smear_mesh *mesh,
                    const struct smear_placement key[2], const struct smear_placement *middle)
{
    const struct smear_viewport *viewport = &c->assembler.viewport;
    const int32_t far_out = 1 << 20;
    int32_t x[SAMPLES], y[SAMPLES], depth[SAMPLES], n = 0, mean = 0;
    uint32_t step = max_u32(mesh->vertex_count / SAMPLES, 1);
    *m = (struct motion){ .x0 = INT32_MAX, .x1 = INT32_MIN, .y0 = INT32_MAX, .y1 = INT32_MIN };
    for (uint32_t i = step >> 1; i < mesh->vertex_count && n < SAMPLES; i += step) {
        struct smear_homogeneous h;
        struct smear_screen open, close, now;
        if (((placement_project(&open, &h, &key[0], i, viewport)
              | placement_project(&close, &h, &key[1], i, viewport)
              | placement_project(&now, &h, middle, i, viewport))
             & OUT_NEAR)
            != 0) {
            m->cut = true;
            continue;
        }
        x[n] = clamp_i32(close.x - open.x, -far_out, far_out);
        y[n] = clamp_i32(close.y - open.y, -far_out, far_out);
        depth[n] = now.depth / SAMPLES;
        mean += depth[n++];
    }
    m->depth = mean;
    for (int32_t i = 0; i < n; i++) {
        m->x0 = min_i32(m->x0, x[i]);
        m->x1 = max_i32(m->x1, x[i]);
        m->y0 = min_i32(m->y0, y[i]);
        m->y1 = max_i32(m->y1, y[i]);
        m->longest = max_i32(m->longest, max_i32(abs_i32(x[i]), abs_i32(y[i])));
        if (depth[i] < mean / n)
            continue;
        m->x += x[i];
        m->y += y[i];
        m->count++;
    }
    if (n != 0)
        m->depth /= n;
}

/* Whether one velocity tells how all of the draw moves: within a third of it and a pixel. */
static bool is_constant(const struct motion *m)
{
    if (m->cut || m->count == 0)
        return false;
    int32_t spread = max_i32(m->x1 - m->x0, m->y1 - m->y0) >> 1;
    return spread <= max_i32(abs_i32(m->x), abs_i32(m->y)) / m->count / 3 + 256;
}

static bool belongs(const struct smear_group *g, const struct smear_group *to, bool plain)
{
    if (g->layer != to->layer || g->method != to->method)
        return false;
    return plain || g->method != SMEAR_OBJECT
        || (abs_i32(g->vx - to->vx) <= 64 && abs_i32(g->vy - to->vy) <= 64);
}

void smear_layers_add(struct smear_context *c, uint32_t draw, const struct smear_placement key[2],
                      const struct smear_placement *middle, bool moves)
{
    enum { LOOKED_AT = 16 };    /* groups, from the newest: enough for parts of one
                                 * thing, and no more than linear time */
    struct smear_layers *l = c->layers;
    const struct smear_layer_setting *setting = &l->setting[l->layer_of[draw]];
    bool over = setting->has_camera || setting->layer.over;
    struct motion m;
    measure(&m, c, c->submitted[draw].draw.mesh, key, middle);
    moves = moves && (m.longest >= 8 || m.cut);             /* 1/32 px */
    if (!moves && !over)
        return;
    struct smear_group g = {
        .layer = l->layer_of[draw],
        .rank = (uint8_t)(over || setting->layer.plain ? l->layer_of[draw] + 1 : 0),
        .method = (uint8_t)(moves ? setting->layer.method : (int)SMEAR_NONE)
    };
    if (g.method == SMEAR_OBJECT && !setting->layer.plain && !is_constant(&m))
        g.method = SMEAR_LAYERED;
    if (m.count != 0) {
        g.vx = (int32_t)((int64_t)(m.x / m.count) * setting->shutter >> 16);
        g.vy = (int32_t)((int64_t)(m.y / m.count) * setting->shutter >> 16);
        g.depth = m.depth * SAMPLES;
    }
    if (!moves)
        g.vx = g.vy = 0;
    uint32_t at = l->group_count;
    for (uint32_t i = 0; i < min_u32(l->group_count, LOOKED_AT) && at == l->group_count; i++)
        if (belongs(&l->group[l->group_count - 1 - i], &g, setting->layer.plain))
            at = l->group_count - 1 - i;
    if (at == l->group_count)
        l->group[l->group_count++] = g;
    const smear_material *material = c->submitted[draw].draw.material;
    l->group[at].textured = l->group[at].textured || (material != NULL && material->texture != NULL);
    l->group_of[draw] = (uint16_t)at;
}

static bool is_before(const struct smear_group *a, const struct smear_group *b)
{
    return a->rank != b->rank ? a->rank < b->rank : a->depth < b->depth;
}

void smear_layers_end(struct smear_context *c)
{
    struct smear_layers *l = c->layers;
    for (uint32_t i = 0; i < l->group_count; i++) {
        uint32_t at = i;
        for (; at > 0 && is_before(&l->group[i], &l->group[l->order[at - 1]]); at--)
            l->order[at] = l->order[at - 1];
        l->order[at] = (uint16_t)i;
        l->group[i].end = 0;
    }
    /* Draws by groups, those of none first: `end` counts, then tells where the next draw of a group goes. */
    uint32_t still = 0;
    for (uint32_t i = 0; i < c->draw_count; i++) {
        if (l->group_of[i] == SMEAR_NO_GROUP)
            l->sequence[still++] = (uint16_t)i;
        else
            l->group[l->group_of[i]].end++;
    }
    for (uint32_t i = 0; i < l->group_count; i++) {
        uint32_t count = l->group[i].end;
        l->group[i].end = still;
        still += count;
    }
    for (uint32_t i = 0; i < c->draw_count; i++)
        if (l->group_of[i] != SMEAR_NO_GROUP)
            l->sequence[l->group[l->group_of[i]].end++] = (uint16_t)i;
}

/* The store takes triangles of layers at the places that layer.h tells, into lists of their own. */
bool smear_layers_assemble(struct smear_context *c, const struct smear_assembly *a, bool drop)
{
    struct smear_bins *g = &c->bins;
    const struct smear_viewport viewport = c->assembler.viewport;
    uint32_t *opaque = g->opaque_last;
    int end = g->row_end;
    c->assembler.viewport = (struct smear_viewport){ c->layers->rows.width, c->layers->rows.height };
    g->opaque_last = g->moving_last;
    g->row_end = end + g->moving_rows;
    bool added = smear_assemble(&c->assembler, a, drop);
    g->row_end = end;
    g->opaque_last = opaque;
    c->assembler.viewport = viewport;
    c->layers->group[c->layers->group_of[a->draw]].end = g->triangle_count;
    return added;
}

/* ------------------------------------------------------------------ lists */

static uint16_t code_of(int32_t depth)
{
    uint32_t units = (uint32_t)depth >> 11;
    return (uint16_t)(units < 32768u ? units : 32768u + ((units - 32768u) >> 4));
}

static void extend(struct smear_group *group, const struct smear_bins *g, const struct smear_triangle *t)
{
    if (t->segment == SMEAR_POINT) {
        group->x0 = min_i32(group->x0, t->vertex[POINT_X]);
        group->x1 = max_i32(group->x1, t->vertex[POINT_X] + 1);
        group->nearest = (uint16_t)max_u32(group->nearest, t->vertex[POINT_DEPTH]);
        group->farthest = (uint16_t)min_u32(group->farthest, t->vertex[POINT_DEPTH]);
        return;
    }
    const struct smear_segment *s = &g->segment[t->segment];
    int32_t x0 = INT32_MAX, x1 = INT32_MIN, low = INT32_MAX, high = 0;
    for (int i = 0; i < 3; i++) {
        const int32_t *v = bins_vertex(g, s, t->vertex[i]);
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

/* Finds each group's part of the moving triangles' list. */
static void list_groups(struct smear_context *c)
{
    struct smear_layers *l = c->layers;
    const struct smear_bins *g = &c->bins;
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
        const struct smear_triangle *t = bins_triangle(g, i);
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
    struct smear_gather_area gather;
    int32_t vx, vy;             /* of taps: no farther than there are pixels */
    struct smear_raster_target target;      /* rows that are drawn: */
    int32_t kept, down;         /* as many before them are there, so many rows further down */
    struct smear_raster_frame frame;
};

/* Few taps along one velocity. */
static inline bool is_plain(const struct layers_row *r)
{
    return r->group->method == SMEAR_OBJECT && r->row.c->layers->setting[r->group->layer].layer.plain;
}

static void still_job(void *argument, int job, int worker)
{
    const struct layers_row *r = (const struct layers_row *)argument;
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
    t.cache = smear_raster_cache_of(&r->row.c->cache, job);
    smear_raster_list(&r->row.c->raster, &t, r->row.c->opaque);
    for (int32_t y = t.y0; r->mixes && y < t.y1; y++)
        pixels_fill(r->row.c->layers->rows.over + target_row(&t.window_rows, &t, y) + t.x0, 0, t.x1 - t.x0);
}

/* Columns [x0, x1) of a row of the target's planes. */
static void clear_columns(const struct smear_raster_target *t, int32_t row, int32_t x0, int32_t x1)
{
    int32_t at = row * t->window_rows.stride + x0, n = x1 - x0;
    if (n <= 0)
        return;
    pixels_fill(t->color + at, SMEAR_UNCOVERED, n);
    __builtin_memset(t->depth + at, 0, (size_t)n * 2);
    if (t->velocity8 != NULL)
        __builtin_memset(t->velocity8 + 2 * at, 0, (size_t)n * 2);
    if (t->velocity16 != NULL)
        __builtin_memset(t->velocity16 + 2 * at, 0, (size_t)n * 4);
}

/* The same from `down` rows further down, where the planes have columns [had0, had1) drawn. */
static void copy_columns(const struct smear_raster_target *t, int32_t row, int32_t down, int32_t had0,
                         int32_t had1)
{
    const int32_t x0 = clamp_i32(had0, t->x0, t->x1), x1 = clamp_i32(had1, x0, t->x1),
                  stride = t->window_rows.stride;
    const size_t n = (size_t)(x1 - x0), to = (size_t)(row * stride + x0), from = to + (size_t)(down * stride);
    clear_columns(t, row, t->x0, x0);
    clear_columns(t, row, x1, t->x1);
    __builtin_memcpy(t->color + to, t->color + from, n * 4);
    __builtin_memcpy(t->depth + to, t->depth + from, n * 2);
    if (t->velocity8 != NULL)
        __builtin_memcpy(t->velocity8 + 2 * to, t->velocity8 + 2 * from, n * 2);
    if (t->velocity16 != NULL)
        __builtin_memcpy(t->velocity16 + 2 * to, t->velocity16 + 2 * from, n * 4);
}

/* Columns [x0, x1) of the group's rows, in as many cuts as there are workers. */
static void draw_job(void *argument, int job, int worker)
{
    const struct layers_row *r = (const struct layers_row *)argument;
    struct smear_raster_target t = r->target;
    int32_t units = (t.x1 - t.x0 + 15) >> 4, n = r->row.c->jobs.workers, x0 = t.x0;
    (void)worker;
    t.x1 = min_i32(x0 + units * (job + 1) / n * 16, t.x1);
    t.x0 = x0 + units * job / n * 16;
    if (t.x0 >= t.x1)
        return;
    const struct smear_layer_rows *rows = &r->row.c->layers->rows;
    for (int32_t row = 0; row < r->kept; row++)
        copy_columns(&t, row, r->down, rows->held.x0, rows->held.x1);
    for (int32_t row = r->kept; row < r->area.rows; row++)
        clear_columns(&t, row, t.x0, t.x1);
    smear_raster_list(&r->frame, &t, r->group->head);
}

/* Pixels of rows [y0, y1) say whether they are covered by what is on
 * top: texels have written something else there. */
static void clear_tops(const struct smear_layer_rows *rows, int32_t y0, int32_t y1)
{
    for (int32_t y = y0; y < y1; y++)
        for (int32_t x = rows->row_first[y], at = y * rows->width + x; x < rows->row_end[y]; x++, at++)
            rows->color[at] = rows->depth[at] != 0 ? rows->color[at] & 0xffffffu : SMEAR_UNCOVERED;
}

/* What is drawn in row y, of columns [x0, x1). */
static void find_drawn(const struct smear_layer_rows *rows, int32_t y, int32_t x0, int32_t x1)
{
    const uint16_t *depth = rows->depth + y * rows->width;
    int32_t first = x0, end = x1;
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

static void find_extents(const struct layers_row *r)
{
    const struct smear_layer_rows *rows = &r->row.c->layers->rows;
    for (int32_t y = 0; y < r->kept; y++) {
        bool any = rows->row_first[y + r->down] < rows->row_end[y + r->down];
        rows->row_first[y] = any ? rows->row_first[y + r->down] : (int16_t)r->target.x1;
        rows->row_end[y] = any ? rows->row_end[y + r->down] : (int16_t)r->target.x1;
    }
    for (int32_t y = r->kept; y < r->area.rows; y++)
        find_drawn(rows, y, r->target.x0, r->target.x1);
    if (r->group->textured)
        clear_tops(rows, r->kept, r->area.rows);
}

static void merge_job(void *argument, int job, int worker)
{
    const struct layers_row *r = (const struct layers_row *)argument;
    struct smear_context *c = r->row.c;
    uint32_t samples;
    if (r->group->method == SMEAR_LAYERED || is_plain(r)) {
        struct smear_gather_area area = r->gather;
        smear_job_columns(c, job, &area.left, &area.right);
        samples = is_plain(r) ? smear_plain_merge(&area, r->vx, r->vy) : smear_gather_merge(&area);
    } else {
        struct smear_streak_area area = r->area;
        smear_job_columns(c, job, &area.left, &area.right);
        area.work = (uint8_t *)area.work + (uint32_t)worker * c->layers->rows.work_bytes;
        samples = smear_streak_merge(&r->streak, &area);
    }
    c->worker_samples[worker] += samples;
}

/* Blended draws are drawn sharp: what moves hides them where it is in the middle of the exposure. */
static void keep_depths(const struct layers_row *r)
{
    const struct smear_layer_rows *rows = &r->row.c->layers->rows;
    for (int32_t y = 0; y < r->area.height; y++) {
        const uint16_t *depth = rows->depth + (y + r->area.top) * rows->width + rows->margin;
        uint16_t *still = r->area.still_depth + y * r->area.still_stride;
        for (int32_t x = max_i32(r->target.x0 - rows->margin, 0);
             x < min_i32(r->target.x1 - rows->margin, r->row.c->window.width); x++)
            still[x] = (uint16_t)max_u32(still[x], depth[x]);
    }
}

static void blend_job(void *argument, int job, int worker)
{
    const struct layers_row *r = (const struct layers_row *)argument;
    struct smear_raster_target t = r->still;
    (void)worker;
    smear_job_columns(r->row.c, job, &t.x0, &t.x1);
    if (t.x0 < t.x1)
        smear_raster_list(&r->row.c->raster, &t, r->row.c->blend);
}

static void convert_job(void *argument, int job, int worker)
{
    const struct layers_row *r = (const struct layers_row *)argument;
    int32_t x0, x1;
    (void)worker;
    smear_job_columns(r->row.c, job, &x0, &x1);
    smear_band_convert_rows(&r->row, &r->still, x0, x1);
}

/* Tile columns that the group's streaks reach. */
static void mark_tiles(struct smear_context *c, const struct layers_row *r)
{
    const struct smear_window *w = &c->window;
    int32_t x0 = r->group->x0 - r->streak.reach_x - r->area.margin,
            x1 = r->group->x1 + r->streak.reach_x - r->area.margin;
    for (int32_t i = max_i32(x0, 0) >> w->tile_shift; i <= (min_i32(x1, w->width) - 1) >> w->tile_shift; i++)
        w->moving[i] |= r->group->method == SMEAR_LAYERED ? TILE_LAYERED : TILE_OBJECT;
}

static int32_t reach_of(const struct smear_context *c, const struct smear_group *group)
{
    return group->method == SMEAR_LAYERED ? c->window.reach : (abs_i32(group->vx) >> 9) + 2;
}

/* Where groups lie in part behind others that are merged before them. */
static bool find_mixed(const struct smear_context *c)
{
    const struct smear_layers *l = c->layers;
    bool any = false;
    for (uint32_t i = 0; i < l->group_count; i++) {
        struct smear_group *g = &l->group[l->order[i]];
        g->mixed0 = INT32_MAX;
        g->mixed1 = INT32_MIN;
        g->marks = false;
        g->marked_from = UINT32_MAX;
        for (uint32_t k = 0; k < i && g->head != SMEAR_NO_TRIANGLE; k++) {
            struct smear_group *before = &l->group[l->order[k]];
            int32_t x0 = max_i32(g->x0 - reach_of(c, g), before->x0 - reach_of(c, before));
            int32_t x1 = min_i32(g->x1 + reach_of(c, g), before->x1 + reach_of(c, before));
            if (before->head == SMEAR_NO_TRIANGLE || g->rank != before->rank || g->farthest >= before->nearest
                || x0 >= x1)
                continue;
            g->mixed0 = min_i32(g->mixed0, x0);
            g->mixed1 = max_i32(g->mixed1, x1);
            before->mixed0 = min_i32(before->mixed0, x0);
            before->mixed1 = max_i32(before->mixed1, x1);
            before->marks = any = true;
            before->marked_from = min_u32(before->marked_from, g->farthest);
        }
    }
    return any;
}

static void merge_group(struct smear_context *c, struct layers_row *r, struct smear_group *group)
{
    struct smear_layer_rows *rows = &c->layers->rows;
    struct smear_streak *s = &r->streak;
    int32_t top = row_top(c, r->row.row) + c->window.tile, height = r->still.y1 - r->still.y0;
    const struct smear_layer_setting *setting = &c->layers->setting[group->layer];
    smear_streak_make(s, group->vx, group->vy, streak_half_max(c->window.width), c->window.reach);
    r->group = group;
    bool gathers = group->method == SMEAR_LAYERED || is_plain(r);
    if (gathers) {
        const int32_t most = 2 * c->window.reach << 8;
        r->vx = clamp_i32(group->vx, -most, most);
        r->vy = clamp_i32(group->vy, -most, most);
        s->upright = false;
        s->reach_x = s->reach_y = c->window.reach;
    }
    r->area = (struct smear_streak_area){
        .color = rows->color, .depth = rows->depth, .stride = rows->width, .x0 = group->x0, .x1 = group->x1,
        .rows = height + 2 * s->reach_y, .tile = c->window.tile,
        .row_first = rows->row_first, .row_end = rows->row_end, .top = s->reach_y, .margin = rows->margin,
        .still = r->still.color, .still_depth = r->still.depth, .still_stride = c->window.width,
        .over = rows->over, .over_depth = rows->over_depth, .mixed0 = group->mixed0, .mixed1 = group->mixed1,
        .marks = group->marks, .marked_from = group->marked_from, .height = height,
        .nearest = group->rank != 0 ? 65536u : group->nearest,
        .farthest = group->rank != 0 ? 65536u : group->farthest,
        .edge = rows->edge, .work = rows->work, .linear = c->raster.linear
    };
    /* Lines that go down, and taps, look beyond the drawn columns. */
    int32_t beside = s->upright || gathers ? (2 * s->reach_x + 15) & ~15 : 0;
    /* Of the tile row above, if it was the last that was merged there. */
    const int32_t y0 = top - s->reach_y, y1 = top + height + s->reach_y;
    r->kept = rows->held.group == group ? clamp_i32(rows->held.y1 - y0, 0, y1 - y0) : 0;
    r->down = y0 - rows->held.y0;
    r->target = (struct smear_raster_target){
        .x0 = max_i32(group->x0 - beside, 0), .y0 = y0 + r->kept,
        .x1 = min_i32(group->x1 + beside, rows->width), .y1 = y1,
        .color = rows->color, .depth = rows->depth,
        .tile_shift = (uint8_t)c->window.tile_shift
    };
    r->target.color_rows = r->target.window_rows
        = (struct smear_plane_rows){ rows->width, r->kept, rows->rows, 0 };
    r->frame = c->raster;
    r->frame.width = rows->width;
    r->frame.height = rows->height;
    if (group->method == SMEAR_LAYERED) {
        r->target.velocity8 = rows->velocity8;
        r->target.velocity16 = rows->velocity16;
        r->target.moving = rows->moving;
        r->frame.velocity_scale = (int32_t)((int64_t)r->frame.velocity_scale * setting->shutter >> 16);
    }
    r->gather = (struct smear_gather_area){
        .layer = rows, .x0 = r->target.x0, .x1 = r->target.x1, .rows = r->area.rows, .top = r->area.top,
        .still = r->still.color, .still_depth = r->still.depth, .still_stride = c->window.width,
        .passed = rows->over, .passed_depth = rows->over_depth,
        .mixed0 = group->mixed0, .mixed1 = group->mixed1, .marks = group->marks,
        .height = height, .tile_shift = c->window.tile_shift,
        .samples = min_i32(c->frame.samples, SMEAR_GATHER_TAPS), .linear = c->raster.linear,
        .over = group->rank != 0
    };
    if (rows->held.group != group)
        smear_streak_edges(s, rows->edge, s->upright ? rows->rows : rows->width);
    struct smear_triangle *tail = bins_triangle(&c->bins, group->tail);
    uint32_t after = tail->next;
    tail->next = SMEAR_NO_TRIANGLE;
    smear_jobs_run(&c->jobs, draw_job, r, c->jobs.workers);
    tail->next = after;
    find_extents(r);
    rows->held = (struct smear_held_rows){ group, y0, y1, r->target.x0, r->target.x1 };
    if (group->method == SMEAR_LAYERED)
        smear_gather_cells(&r->gather);
    smear_jobs_run(&c->jobs, merge_job, r, c->jobs.workers);
    if (c->blends)
        keep_depths(r);
    mark_tiles(c, r);
}

static void count_tiles(struct smear_context *c)
{
    smear_stats *s = &c->stats;
    for (int32_t i = 0; i < c->window.columns; i++) {
        uint32_t reached = c->window.moving[i];
        s->tiles_still += reached == 0;
        s->tiles_none += reached == 0;
        s->tiles_uniform += (reached & TILE_LAYERED) == 0 && reached != 0;
        s->tiles_complex += (reached & TILE_LAYERED) != 0;
        s->tiles_object += (reached & TILE_LAYERED) == 0 && reached != 0;
        s->tiles_layered += (reached & TILE_LAYERED) != 0;
    }
}

/* The moving triangles' list for tile row `row`: a tile row above and below belongs to it. */
static void advance_moving(struct smear_context *c, int row, bool first)
{
    const struct smear_bins *g = &c->bins;
    int32_t y = row_top(c, row);
    for (int next = first ? row : row + 2; next <= row + 2; next++)
        c->moving = smear_bins_merge(g, g->moving_last, c->moving, next, y);
}

static int finish_row(struct smear_context *c, int row, bool first)
{
    struct layers_row r = { .row = { .c = c, .row = row } };
    uint32_t start = stage_start(c);
    smear_row_target(c, row, &r.still);
    r.still.color_rows = r.still.window_rows
        = (struct smear_plane_rows){ c->window.width, 0, c->window.tile, 0 };
    c->opaque = smear_bins_advance(&c->bins, c->bins.opaque_last, c->opaque, row);
    advance_moving(c, row, first);
    list_groups(c);
    r.mixes = find_mixed(c);
    smear_jobs_run(&c->jobs, still_job, &r, c->jobs.workers);
    stage_end(c, &c->stats.time_raster, start);
    start = stage_start(c);
    for (int32_t i = 0; i < c->window.columns; i++)
        c->window.moving[i] = 0;
    for (uint32_t i = 0; i < c->layers->group_count; i++) {
        struct smear_group *group = &c->layers->group[c->layers->order[i]];
        if (group->head != SMEAR_NO_TRIANGLE && group->x0 < group->x1)
            merge_group(c, &r, group);
    }
    count_tiles(c);
    if (c->blends) {
        c->blend = smear_bins_advance(&c->bins, c->bins.blend_last, c->blend, row);
        smear_jobs_run(&c->jobs, blend_job, &r, c->jobs.workers);
    }
    stage_end(c, &c->stats.time_blur, start);
    start = stage_start(c);
    r.row.band = smear_band_begin(c);
    smear_jobs_run(&c->jobs, convert_job, &r, c->jobs.workers);
    stage_end(c, &c->stats.time_convert, start);
    return smear_band_flush(c, row, r.row.band);
}

int smear_layers_rows(struct smear_context *c, int first, int end)
{
    c->layers->rows.held.group = NULL;
    for (int row = first; row < end; row++) {
        int result = finish_row(c, row, row == first);
        if (result != SMEAR_OK)
            return result;
    }
    return SMEAR_OK;
}
