/* SPDX-License-Identifier: MIT */
/* frame.c - the order of the stages and the rolling window. Start reading here.
 *
 *     for each part of the frame (one, unless the triangle list is too small):
 *         assemble    every draw's triangles into lists per tile row
 *         for each tile row:
 *             raster      the row's list into the window: colour, depth, velocity
 *             reduce      longest velocity per tile
 *             finish      the row above, which now has neighbours on both sides:
 *                         neighbourhoods, then per tile: blur, blended draws, conversion; then flush
 */
#include "timed.h"

#include "fixmath.h"
#include "pixel.h"
#include "tilemax.h"

/* ------------------------------------------------------------------ poses */

/* Weights of the poses now, open, close for an instant, q24; they add up to one. */
struct instant {
    int32_t weight[3];
};

static const struct instant sharp_instant = { { 1 << 24, 0, 0 } };

/* `u` in q16 runs from -1 at shutter open to 1 at shutter close.
 *
 * Poses at shutter open, centre and close: the parabola through them. A pose one frame ago: the straight line
 * through it and now, inside and beyond. */
static struct instant instant_at(const struct smear_context *c, int32_t u)
{
    struct instant i;
    if (c->frame.shutter_poses) {
        int64_t square = (int64_t)u * u >> 16;
        i.weight[1] = (int32_t)((square - u) * 128);
        i.weight[2] = (int32_t)((square + u) * 128);
    } else {
        /* Frames from now: the exposure's centre plus u half exposures. */
        int64_t half = ((uint32_t)c->frame.shutter_degrees << 20) / 45u;       /* degrees / 720, q24 */
        int64_t centre = c->frame.exposure == SMEAR_TRAILING ? -half
                       : c->frame.exposure == SMEAR_LEADING ? half : 0;
        i.weight[1] = (int32_t)-(centre + (half * u >> 16));
        i.weight[2] = 0;
    }
    i.weight[0] = (1 << 24) - i.weight[1] - i.weight[2];
    return i;
}

static bool same_transform(const smear_transform *a, const smear_transform *b)
{
    for (int i = 0; i < 9; i++)
        if (a->basis[i] != b->basis[i])
            return false;
    return a->origin[0] == b->origin[0] && a->origin[1] == b->origin[1]
        && a->origin[2] == b->origin[2];
}

static bool same_camera(const smear_camera *a, const smear_camera *b)
{
    return same_transform(&a->pose, &b->pose) && a->focal == b->focal
        && a->half_height == b->half_height;
}

static bool is_mirrored(const smear_transform *t)
{
    /* Sign of the determinant, in 20-bit entries. */
    int64_t b[9];
    for (int i = 0; i < 9; i++)
        b[i] = t->basis[i] >> 11;
    int64_t d = b[0] * (b[4] * b[8] - b[5] * b[7]) - b[1] * (b[3] * b[8] - b[5] * b[6])
              + b[2] * (b[3] * b[7] - b[4] * b[6]);
    return d < 0;
}

/* Where a draw is in each known pose; equal poses mean it does not move. */
struct draw_poses {
    const smear_transform *object[3];   /* now, open, close */
    const smear_camera *camera[3];
    const int16_t *position[3];
};

static void poses_of(const struct smear_context *c, const struct smear_submitted *s,
                     struct draw_poses *p)
{
    static const smear_transform identity = SMEAR_IDENTITY;
    const smear_draw *d = &s->draw;
    const smear_transform *object = d->now != NULL ? d->now : &identity;
    for (int i = 0; i < 3; i++) {
        p->object[i] = object;
        p->camera[i] = &c->camera;
        p->position[i] = d->mesh->position;
    }
    if (c->frame.cut || d->motion == SMEAR_MOTION_NONE)
        return;
    if (c->camera_moves) {
        p->camera[1] = &c->camera_open;
        if (c->frame.shutter_poses)
            p->camera[2] = &c->camera_close;
    }
    if (d->cut || d->motion == SMEAR_MOTION_CAMERA)
        return;
    if (SMEAR_WITH_DEFORM && d->open_position != NULL)
        p->position[1] = d->open_position;
    if (d->open != NULL)
        p->object[1] = d->open;
    else if (SMEAR_WITH_IDS && !c->frame.shutter_poses && s->kept >= 0 && c->kept[s->kept].has_before)
        p->object[1] = &c->kept[s->kept].before;
    if (c->frame.shutter_poses) {
        if (SMEAR_WITH_DEFORM && d->close_position != NULL)
            p->position[2] = d->close_position;
        if (d->close != NULL)
            p->object[2] = d->close;
    }
}

static bool pose_differs(const struct draw_poses *p, int i)
{
    return (SMEAR_WITH_DEFORM && p->position[i] != p->position[0]) || !same_transform(p->object[i], p->object[0])
        || !same_camera(p->camera[i], p->camera[0]);
}

static void project_pose(struct smear_projection *out, const struct smear_context *c,
                         const struct draw_poses *p, int i, const smear_mesh *mesh)
{
    struct smear_view view;
    smear_view_compose(&view, p->object[i], mesh, &p->camera[i]->pose);
    smear_projection_make(out, &view, p->camera[i], c->window.height);
}

/* Where the vertices are at an instant: a sum of poses, linear in clip space. */
static void place(struct smear_placement *out, const struct smear_context *c, const struct draw_poses *p,
                  const smear_mesh *mesh, const struct instant *instant)
{
    struct smear_projection sum[3];
    const int16_t *position[3];
    int32_t weight[3];
    int count = 0;
    out->extra_count = 0;
    for (int k = 0; k < 3; k++) {
        if (instant->weight[k] == 0)
            continue;
        project_pose(&sum[count], c, p, k, mesh);
        position[count] = p->position[k];
        weight[count++] = instant->weight[k];
    }
    if (count > 1)
        smear_projection_weigh(sum, weight, count, &c->camera);
    out->now = sum[0];
    out->position = position[0];
    for (int k = 1; k < count; k++) {
        if (!SMEAR_WITH_DEFORM || position[k] == out->position) {
            smear_projection_add(&out->now, &sum[k]);
        } else {
            out->extra[out->extra_count] = sum[k];
            out->extra_position[out->extra_count++] = position[k];
        }
    }
}

/* Everything the assembler needs of draw `i`, for the given instant. */
static SMEAR_NOINLINE void make_assembly(struct smear_context *c, uint32_t i, const struct instant *instant,
                          struct smear_assembly *a)
{
    static const smear_material plain = { 0 };
    const struct smear_submitted *s = &c->submitted[i];
    struct draw_poses poses;
    poses_of(c, s, &poses);
    a->mesh = s->draw.mesh;
    a->material = s->draw.material != NULL ? s->draw.material : &plain;
    a->draw = (uint16_t)i;
    a->mirrored = is_mirrored(poses.object[0]);
    a->moves = 0;
    a->path = false;
    smear_shading_make(&a->shading, poses.object[0], a->material,
                       SMEAR_WITH_LINEAR && c->frame.light == SMEAR_LIGHT_LINEAR);

    bool moves = pose_differs(&poses, 1) || pose_differs(&poses, 2);
    place(&a->at, c, &poses, a->mesh, moves ? instant : &sharp_instant);
    if (!moves)
        return;
    if (SMEAR_WITH_SUBFRAMES && c->assembler.keep_paths) {
        struct instant open = instant_at(c, -65536), close = instant_at(c, 65536);
        a->path = true;
        place(&a->key[0], c, &poses, a->mesh, &open);
        place(&a->key[1], c, &poses, a->mesh, &close);
    }
    if (!SMEAR_WITH_RECONSTRUCT || !c->assembler.keep_motion)
        return;
    /* Velocity is measured from the open pose to the close pose, or to now. Where the drawn instant is the later pose
     * itself, one further pose is enough. */
    project_pose(&a->pose[0], c, &poses, 1, a->mesh);
    a->pose_position[0] = poses.position[1];
    a->moves = 1;
    if (c->frame.shutter_poses || instant->weight[0] != 1 << 24) {
        int later = c->frame.shutter_poses ? 2 : 0;
        project_pose(&a->pose[1], c, &poses, later, a->mesh);
        a->pose_position[1] = poses.position[later];
        a->moves = 2;
    }
}

/* ------------------------------------------------------------------ assembling */

/* Assembles all draws for the tile rows [first, end). False when the store is full. */
static bool assemble_rows(struct smear_context *c, int first, int end, const struct instant *instant,
                          bool drop)
{
    smear_geometry_reset(&c->geometry, first, end);
    smear_assembler_reset(&c->assembler);
    for (uint32_t i = 0; i < c->draw_count; i++) {
        struct smear_assembly a;
        make_assembly(c, i, instant, &a);
        if (!(SMEAR_WITH_SUBFRAMES && a.path ? smear_assemble_path(&c->assembler, &a, drop) : smear_assemble(&c->assembler, &a, drop)))
            return false;
    }
    return true;
}

/* Assembles as many tile rows of [first, end) as find room; returns their end. Rows above are included for what is
 * finished a row late: from *top on, at most from `least` on where room is short. When that is too much, triangles are
 * dropped and counted. */
static int assemble_part(struct smear_context *c, int *top, int least, int first, int end, const struct instant *instant)
{
    uint32_t start = stage_start(c);
    for (;;) {
        uint32_t drawn = c->assembler.triangles_drawn, dropped = c->assembler.triangles_dropped;
        bool last = end - first <= 1 && *top == least;
        if (assemble_rows(c, *top, end, instant, last))
            break;
        c->assembler.triangles_drawn = drawn;
        c->assembler.triangles_dropped = dropped;
        if (end - first > 1)
            end = first + (end - first) / 2;
        else
            ++*top;
        c->stats.triangles_split++;
    }
    c->opaque = c->blend = c->moving = SMEAR_NO_TRIANGLE;
    for (int row = *top; row < first; row++)
        c->opaque = smear_geometry_advance(&c->geometry, c->geometry.opaque_last, c->opaque, row);
    stage_end(c, &c->stats.time_submit, start);
    return end;
}

/* ------------------------------------------------------------------ raster */

static void clear_rows(struct smear_context *c, int32_t y0, int32_t y1, int32_t x0, int32_t x1)
{
    struct smear_window *w = &c->window;
    uint32_t clear = c->frame.clear & 0xffffffu;
    for (int32_t y = y0; y < y1; y++) {
        int32_t at = window_slot(w, y) * w->width + x0, n = x1 - x0;
        pixels_fill(w->color + at, clear, n);
        __builtin_memset(w->depth + at, 0, (size_t)n * 2);
        if (w->velocity8 != NULL)
            __builtin_memset(w->velocity8 + 2 * at, 0, (size_t)n * 2);
        if (w->velocity16 != NULL)
            __builtin_memset(w->velocity16 + 2 * at, 0, (size_t)n * 4);
        if (c->inspect != NULL)
            __builtin_memset(c->inspect + 2 * at, 0, (size_t)n * 8);
    }
}

static void raster_job(void *argument, int job, int worker)
{
    const struct row_job *r = (const struct row_job *)argument;
    struct smear_context *c = r->c;
    struct smear_window *w = &c->window;
    struct smear_raster_target t;
    (void)worker;
    smear_row_target(c, r->row, &t);
    smear_job_columns(c, job, &t.x0, &t.x1);
    if (t.x0 >= t.x1)
        return;
    clear_rows(c, t.y0, t.y1, t.x0, t.x1);
    if (SMEAR_WITH_RECONSTRUCT && c->assembler.keep_motion) {
        t.velocity8 = w->velocity8;
        t.velocity16 = w->velocity16;
        t.inspect = c->inspect;
    }
    smear_raster_list(&c->raster, &t, c->opaque);
}

/* Blended draws straight over the window's rows: where no filter will read them. */
static void blend_job(void *argument, int job, int worker)
{
    const struct row_job *r = (const struct row_job *)argument;
    struct smear_raster_target t;
    (void)worker;
    smear_row_target(r->c, r->row, &t);
    smear_job_columns(r->c, job, &t.x0, &t.x1);
    if (t.x0 < t.x1)
        smear_raster_list(&r->c->raster, &t, r->c->blend);
}

static void inspect_rows(struct smear_context *c, int row)
{
    const struct smear_window *w = &c->window;
    for (int32_t y = row_top(c, row); y < row_bottom(c, row); y++) {
        int32_t at = window_slot(w, y) * w->width;
        c->desc.inspect(c->desc.user, y, w->color + at, w->depth + at,
                        c->inspect + 2 * at);
    }
}

/* Draws tile row `row` into the window. */
static void draw_row(struct smear_context *c, int row)
{
    struct row_job job = { .c = c, .row = row };
    uint32_t start = stage_start(c);
    c->opaque = smear_geometry_advance(&c->geometry, c->geometry.opaque_last, c->opaque, row);
    for (int32_t i = 0; i < c->window.columns; i++)
        c->window.moving[i] = 0;
    smear_jobs_run(&c->jobs, raster_job, &job, c->jobs.workers);
    if (c->inspect != NULL)
        inspect_rows(c, row);
    stage_end(c, &c->stats.time_raster, start);
}

static void blend_row(struct smear_context *c, int row)
{
    if (!SMEAR_WITH_ALPHA || !c->blends)
        return;
    struct row_job job = { .c = c, .row = row };
    c->blend = smear_geometry_advance(&c->geometry, c->geometry.blend_last, c->blend, row);
    smear_jobs_run(&c->jobs, blend_job, &job, c->jobs.workers);
}

/* ------------------------------------------------------------------ finishing without a filter */

static void convert_job(void *argument, int job, int worker)
{
    const struct row_job *r = (const struct row_job *)argument;
    int32_t x0, x1;
    (void)worker;
    smear_job_columns(r->c, job, &x0, &x1);
    smear_band_convert_window(r, x0, x1);
}

static int finish_sharp(struct smear_context *c, int row)
{
    uint32_t start = stage_start(c);
    struct row_job job = { .c = c, .row = row, .band = smear_band_begin(c) };
    smear_jobs_run(&c->jobs, convert_job, &job, c->jobs.workers);
    stage_end(c, &c->stats.time_convert, start);
    return smear_band_flush(c, row, job.band);
}

/* ------------------------------------------------------------------ finishing with a filter */

static void reduce_job(void *argument, int column, int worker)
{
    const struct row_job *r = (const struct row_job *)argument;
    const struct smear_window *w = &r->c->window;
    (void)worker;
    if (w->moving[column])
        smear_tilemax(w, r->row, column);
    else
        window_motion(w, r->row)[column] = (struct smear_tile_motion){ 0, 0, 0, 0, 0, 0 };
}

static void reduce_row(struct smear_context *c, int row)
{
    struct row_job job = { .c = c, .row = row };
    uint32_t start = stage_start(c);
    smear_jobs_run(&c->jobs, reduce_job, &job, c->window.columns);
    stage_end(c, &c->stats.time_reduce, start);
}

static struct smear_row_table row_table(const struct smear_context *c, int row)
{
    return (struct smear_row_table){ c->row_offset, row_top(c, row) - c->window.reach };
}

static bool is_still(const struct smear_window *w, int row, int column)
{
    return window_around(w, row)[column].kind == TILE_STILL;
}

/* Still tiles go to the display as they lie in the window, a run of them at once: the job of the run's first tile. */
static void convert_still(const struct row_job *r, int column)
{
    const struct smear_window *w = &r->c->window;
    if (column > 0 && is_still(w, r->row, column - 1))
        return;
    int end = column + 1;
    while (end < w->columns && is_still(w, r->row, end))
        end++;
    smear_band_convert_window(r, tile_left(r->c, column), tile_right(r->c, end - 1));
}

static void tile_job(void *argument, int column, int worker)
{
    const struct row_job *r = (const struct row_job *)argument;
    struct smear_context *c = r->c;
    const struct smear_window *w = &c->window;
    if (is_still(w, r->row, column) && c->blend == SMEAR_NO_TRIANGLE) {
        convert_still(r, column);
        return;
    }
    struct smear_row_table rows = row_table(c, r->row);
    uint32_t *tile = c->scratch + worker * w->tile * w->tile;
    uint8_t kind = window_around(w, r->row)[column].kind;
    if (kind == TILE_STILL)
        smear_blur_copy(tile, w, r->row, column);
    else if (kind == TILE_UNIFORM && (c->frame.reconstruct & SMEAR_UNIFORM))
        c->worker_samples[worker] += smear_blur_uniform(tile, w, &rows, r->row, column, &c->blur);
    else
        c->worker_samples[worker] += smear_blur_reconstruct(tile, w, &rows, r->row, column, &c->blur);
    if (c->blend != SMEAR_NO_TRIANGLE)
        smear_band_blend_tile(r, column, tile);
    smear_band_convert_tile(r, column, tile);
}

static void count_tiles(struct smear_context *c, int row)
{
    const struct smear_tile_neighborhood *around = window_around(&c->window, row);
    for (int32_t i = 0; i < c->window.columns; i++) {
        if (around[i].kind == TILE_STILL) {
            c->stats.tiles_still++;
            c->stats.tiles_none++;
        } else {
            c->stats.tiles_reconstruct++;
            if (around[i].kind == TILE_UNIFORM)
                c->stats.tiles_uniform++;
            else
                c->stats.tiles_complex++;
        }
    }
}

/* Finishes tile row `row`; rows up to `known` are in the window. */
static int finish_blurred(struct smear_context *c, int row, int known)
{
    struct smear_window *w = &c->window;
    bool corner = c->frame.reconstruct & SMEAR_CORNER;
    smear_neighbormax_row(w, row, known, corner);
    if (known > row)
        smear_neighbormax_row(w, known, known, corner);
    count_tiles(c, row);
    int32_t first = row_top(c, row) - w->reach;
    for (int32_t i = 0; i < w->tile + 2 * w->reach; i++)
        c->row_offset[i] = (uint32_t)(window_slot(w, clamp_i32(first + i, 0, w->height - 1)) * w->width);
    if (c->blends)
        c->blend = smear_geometry_advance(&c->geometry, c->geometry.blend_last, c->blend, row);

    uint32_t start = stage_start(c);
    struct row_job job = { .c = c, .row = row, .band = smear_band_begin(c) };
    smear_jobs_run(&c->jobs, tile_job, &job, w->columns);
    stage_end(c, &c->stats.time_blur, start);
    return smear_band_flush(c, row, job.band);
}

/* ------------------------------------------------------------------ methods */

static int render_none(struct smear_context *c)
{
    for (int row = 0; row < c->window.rows;) {
        int top = row, end = assemble_part(c, &top, row, row, c->window.rows, &sharp_instant);
        for (; row < end; row++) {
            draw_row(c, row);
            blend_row(c, row);
            int result = finish_sharp(c, row);
            if (result != SMEAR_OK)
                return result;
        }
    }
    return SMEAR_OK;
}

/* One step of the rolling window: tile row `row` has been drawn; row - 1 has a neighbour on both sides now.
 *
 *      row - 2    row - 1    row         the oldest is overwritten next
 *      drawn      drawn      drawn       colour, depth, velocity: the blur only reads them
 *                 blurred -> band -> flush
 *
 * Invariant: a filter reaches at most one tile, and the ring keeps `reach` rows of row - 2 (smear_init checks it). */
static int roll(struct smear_context *c, int row)
{
    reduce_row(c, row);
    int result = row > 0 ? finish_blurred(c, row - 1, row) : SMEAR_OK;
    if (result == SMEAR_OK && row == c->window.rows - 1)
        result = finish_blurred(c, row, row);
    return result;
}

static int render_reconstruct(struct smear_context *c)
{
    /* The sharp picture that is blurred both ways lies at the middle of the exposure. */
    struct instant middle = c->frame.shutter_poses ? sharp_instant : instant_at(c, 0);
    for (int row = 0; row < c->window.rows;) {
        int top = max_i32(row - (c->blends ? 1 : 0), 0), end = assemble_part(c, &top, top, row, c->window.rows, &middle);
        for (; row < end; row++) {
            draw_row(c, row);
            int result = roll(c, row);
            if (result != SMEAR_OK)
                return result;
        }
    }
    return SMEAR_OK;
}

static int render_timed(struct smear_context *c)
{
    struct instant middle = c->frame.shutter_poses ? sharp_instant : instant_at(c, 0);
    for (int row = 0, end; row < c->window.rows; row = end) {
        int top = row;
        end = assemble_part(c, &top, row, row, c->window.rows, &middle);
        int result = smear_timed_rows(c, row, end);
        if (result != SMEAR_OK)
            return result;
    }
    return SMEAR_OK;
}

/* Row y of the sums. */
static smear_sum *sums_at(const struct smear_context *c, int32_t y)
{
    return c->sums + 3 * (size_t)(y - c->sums_top) * (size_t)c->window.width;
}

static void clear_sums(struct smear_context *c, int32_t top, int32_t bottom)
{
    c->sums_top = top;
    __builtin_memset(c->sums, 0, 3 * (size_t)(bottom - top) * (size_t)c->window.width * sizeof *c->sums);
}

/* Adds the row's pixels to the sums: linear light, or codes in the same bits. */
static void add_row(struct smear_context *c, int row)
{
    const struct smear_window *w = &c->window;
    bool linear = SMEAR_WITH_LINEAR && c->frame.light == SMEAR_LIGHT_LINEAR;
    for (int32_t y = row_top(c, row); y < row_bottom(c, row); y++) {
        const uint32_t *in = w->color + window_slot(w, y) * w->width;
        smear_sum *sum = sums_at(c, y);
        for (int32_t x = 0; x < w->width; x++, sum += 3) {
            uint32_t p = in[x];
            sum[0] = (smear_sum)(sum[0] + (linear ? smear_srgb_decode[pixel_red(p)] : pixel_red(p)));
            sum[1] = (smear_sum)(sum[1] + (linear ? smear_srgb_decode[pixel_green(p)] : pixel_green(p)));
            sum[2] = (smear_sum)(sum[2] + (linear ? smear_srgb_decode[pixel_blue(p)] : pixel_blue(p)));
        }
    }
}

/* sum / n to nearest. */
static uint32_t mean_of(uint32_t sum, uint32_t n)
{
    return (sum + n / 2) / n;
}

static void average_row(struct smear_context *c, int row, uint32_t n)
{
    const struct smear_window *w = &c->window;
    bool linear = SMEAR_WITH_LINEAR && c->frame.light == SMEAR_LIGHT_LINEAR;
    for (int32_t y = row_top(c, row); y < row_bottom(c, row); y++) {
        uint32_t *out = w->color + window_slot(w, y) * w->width;
        const smear_sum *sum = sums_at(c, y);
        for (int32_t x = 0; x < w->width; x++, sum += 3) {
            uint32_t r = mean_of(sum[0], n), g = mean_of(sum[1], n), b = mean_of(sum[2], n);
            out[x] = linear ? pixel_make(0, smear_srgb_encode[r >> 4], smear_srgb_encode[g >> 4],
                                         smear_srgb_encode[b >> 4])
                            : pixel_make(0, r, g, b);
        }
    }
}

/* Draws tile rows [first, end) at every instant and adds them up. */
static void accumulate_rows(struct smear_context *c, int first, int end)
{
    uint32_t n = c->frame.samples;
    for (uint32_t k = 0; k < n; k++) {
        struct instant instant = instant_at(c, (int32_t)((2 * k + 1) * 65536u / n) - 65536);
        for (int row = first; row < end;) {
            int top = row, part = assemble_part(c, &top, row, row, end, &instant);
            for (; row < part; row++) {
                draw_row(c, row);
                blend_row(c, row);
                add_row(c, row);
            }
        }
    }
}

static int render_accumulate(struct smear_context *c)
{
    const bool whole = c->desc.accumulate == 1;
    c->stats.samples = c->frame.samples * c->stats.pixels;
    if (whole) {
        clear_sums(c, 0, c->window.height);
        accumulate_rows(c, 0, c->window.rows);
    }
    for (int row = 0; row < c->window.rows; row++) {
        if (!whole) {
            clear_sums(c, row_top(c, row), row_bottom(c, row));
            accumulate_rows(c, row, row + 1);
        }
        average_row(c, row, c->frame.samples);
        int result = finish_sharp(c, row);
        if (result != SMEAR_OK)
            return result;
    }
    return SMEAR_OK;
}

/* ------------------------------------------------------------------ a frame */

static void prepare(struct smear_context *c)
{
    struct smear_window *w = &c->window;
    smear_stats *s = &c->stats;
    *s = (smear_stats){ .arena_bytes = s->arena_bytes };
    s->pixels = (uint32_t)(w->width * w->height);
    for (int i = 0; i < c->jobs.workers; i++)
        c->worker_samples[i] = 0;
    bool linear = SMEAR_WITH_LINEAR && c->frame.light == SMEAR_LIGHT_LINEAR;
    uint32_t degrees = c->frame.shutter_degrees;

    c->raster.linear = linear;
    c->raster.velocity_scale = c->frame.shutter_poses ? 32768 : (int32_t)((degrees << 16) / 720u);
    c->raster.inspect_scale = c->frame.shutter_poses ? (int32_t)((360u << 16) / degrees) : 65536;
    c->raster.reach_q3 = w->reach * 8;
    c->assembler.keep_motion = c->frame.method == SMEAR_RECONSTRUCT;
    c->assembler.keep_paths = c->frame.method >= SMEAR_SUBFRAMES;
    c->chooser = (struct smear_chooser){ c->frame.method, c->frame.samples, c->frame.target };
    c->assembler.triangles_drawn = c->assembler.triangles_dropped = 0;

    c->blur = (struct smear_blur_settings){
        .linear = linear, .orthographic = c->camera.half_height > 0, .samples = c->frame.samples,
        .flags = c->frame.reconstruct
    };
    if (c->blur.orthographic) {
        uint32_t range = (uint32_t)(c->camera.far_plane - c->camera.near_plane);
        int zeros = count_leading_zeros(range);
        uint64_t over = (uint64_t)recip_norm_precise(range << zeros) * (uint32_t)c->camera.far_plane;
        over >>= 45 - zeros;
        c->blur.far_over_range = over > 0xffffffffu ? 0xffffffffu : (uint32_t)over;
    }

    c->blends = false;
    for (uint32_t i = 0; i < c->draw_count; i++) {
        const smear_draw *d = &c->submitted[i].draw;
        struct smear_raster_draw *r = &c->raster_draw[i];
        const smear_material *m = d->material;
        r->alpha = m != NULL ? m->alpha : (uint8_t)SMEAR_OPAQUE;
        r->cutoff = m != NULL && m->cutoff != 0 ? m->cutoff : 128;
        if (SMEAR_WITH_TEXTURE && m != NULL && m->texture != NULL)
            smear_sampler_make(&r->sampler, m->texture, d->mesh->uv_shift != 0 ? d->mesh->uv_shift : 15,
                               m->bilinear, linear);
        c->blends = c->blends || (SMEAR_WITH_ALPHA && r->alpha == SMEAR_BLEND);
        s->triangles_in += d->mesh->triangle_count;
    }
}

static void sum_up(struct smear_context *c)
{
    smear_stats *s = &c->stats;
    s->triangles_drawn = c->assembler.triangles_drawn;
    s->triangles_dropped = c->assembler.triangles_dropped;
    for (int i = 0; i < c->jobs.workers; i++)
        s->samples += c->worker_samples[i];
    uint32_t tiles = (uint32_t)(((c->window.width + c->window.tile - 1) >> c->window.tile_shift)
                                * ((c->window.height + c->window.tile - 1) >> c->window.tile_shift));
    if (c->frame.method == SMEAR_NONE)
        s->tiles_none = s->tiles_still = tiles;
    else if (c->frame.method == SMEAR_ACCUMULATE)
        s->tiles_accumulate = s->tiles_complex = tiles;
}

int smear_frame_render(struct smear_context *c)
{
    uint32_t start = stage_start(c);
    prepare(c);
    /* What was not compiled in has been refused by smear_begin. */
    int result;
    if (SMEAR_WITH_ACCUMULATE && c->frame.method == SMEAR_ACCUMULATE)
        result = render_accumulate(c);
    else if (SMEAR_WITH_RECONSTRUCT && c->frame.method == SMEAR_RECONSTRUCT)
        result = render_reconstruct(c);
    else if (SMEAR_WITH_SUBFRAMES && c->frame.method >= SMEAR_SUBFRAMES)
        result = render_timed(c);
    else
        result = render_none(c);
    smear_jobs_end_frame(&c->jobs);
    sum_up(c);
    stage_end(c, &c->stats.time_total, start);
    return result;
}

/* ------------------------------------------------------------------ the filter alone */

void smear_frame_filter_begin(struct smear_context *c)
{
    c->draw_count = 0;
    prepare(c);
    c->opaque = c->blend = SMEAR_NO_TRIANGLE;
    c->filter_row = 0;
}

/* Depth code of a distance in q16: near NEAR / distance in units, then the two slopes. */
static uint16_t depth_code(uint32_t distance, int32_t near_plane)
{
    if (distance == 0)
        return 0;
    if (distance <= (uint32_t)near_plane)
        return 65535;
    int zeros = count_leading_zeros(distance);
    uint64_t near_units = (uint64_t)(uint32_t)near_plane * SMEAR_DEPTH_NEAR;        /* 51 bits */
    uint32_t r = recip_norm(distance << zeros);                                     /* 2^(61 - zeros) / d */
    uint64_t units = ((near_units >> 20) * r) >> (41 - zeros);
    if (units < 32768u)
        return (uint16_t)max_u32((uint32_t)units, 2);
    return (uint16_t)min_u32(32768u + (((uint32_t)units - 32768u + 8u) >> 4), 65535u);
}

/* Half the exposure's displacement in 1/8 px, no longer than the reach; from 1/16 px per frame. */
static void pack_velocity(const struct smear_context *c, const int16_t in[2], int32_t out[2])
{
    int32_t scale = c->raster.velocity_scale;       /* q16 */
    int32_t x = (int32_t)((int64_t)in[0] * scale >> 9), y = (int32_t)((int64_t)in[1] * scale >> 9);  /* q11 */
    uint64_t square = (uint64_t)((int64_t)x * x) + (uint64_t)((int64_t)y * y);
    uint32_t reach = (uint32_t)c->window.reach << 11;
    if (square > (uint64_t)reach * reach) {
        uint32_t length = sqrt_floor_64(square);
        int32_t factor = ratio_q30(reach, length);
        x = (int32_t)((int64_t)x * factor >> 30);
        y = (int32_t)((int64_t)y * factor >> 30);
    }
    out[0] = (x + 128) >> 8;
    out[1] = (y + 128) >> 8;
}

int smear_frame_filter_row(struct smear_context *c, const uint32_t *color, const uint32_t *depth,
                           const int16_t *velocity)
{
    struct smear_window *w = &c->window;
    int32_t y = c->filter_row++, at = window_slot(w, y) * w->width;
    int row = y >> w->tile_shift;
    if ((y & (w->tile - 1)) == 0)
        for (int32_t i = 0; i < w->columns; i++)
            w->moving[i] = 0;
    for (int32_t x = 0; x < w->width; x++) {
        int32_t v[2] = { 0, 0 };
        if ((velocity[2 * x] | velocity[2 * x + 1]) != 0)
            pack_velocity(c, velocity + 2 * x, v);
        if ((v[0] | v[1]) != 0)
            w->moving[x >> w->tile_shift] = 1;
        w->color[at + x] = color[x] & 0xffffffu;
        w->depth[at + x] = depth_code(depth[x], c->camera.near_plane);
        if (w->velocity8 != NULL) {
            w->velocity8[2 * (at + x)] = (int8_t)v[0];
            w->velocity8[2 * (at + x) + 1] = (int8_t)v[1];
        } else {
            w->velocity16[2 * (at + x)] = (int16_t)v[0];
            w->velocity16[2 * (at + x) + 1] = (int16_t)v[1];
        }
    }
    if (y + 1 != row_bottom(c, row))
        return SMEAR_OK;
    int result = roll(c, row);
    if (row == w->rows - 1)
        sum_up(c);
    return result;
}
