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
#include "layers/layer_rows.h"
#include "display/damage.h"
#include "temporal/temporal_rows.h"

#include "display/pixel_format.h"
#include "base/fixmath.h"
#include "base/pixel.h"
#include "kernels/fill.h"
#include "filter/tilemax.h"
#include "raster/velocity.h"

/* ------------------------------------------------------------------ poses */

const smear_transform smear_identity = SMEAR_IDENTITY;

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
        int64_t half = c->half_exposure;
        int64_t centre = c->frame.exposure == SMEAR_TRAILING ? -half
                       : c->frame.exposure == SMEAR_LEADING ? half : 0;
        i.weight[1] = (int32_t)-(centre + (half * u >> 16));
        i.weight[2] = 0;
    }
    i.weight[0] = (1 << 24) - i.weight[1] - i.weight[2];
    return i;
}

static bool same_camera(const smear_camera *a, const smear_camera *b)
{
    return a == b || (same_transform(&a->pose, &b->pose) && a->focal == b->focal
                      && a->half_height == b->half_height);
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
    int32_t deform;                     /* of the way between their vertices, q8 */
    bool projected[3];                  /* `projection` holds */
    struct smear_projection projection[3];
};

/* The layer of a draw, if it has a camera of its own. */
static const struct smear_layer_setting *layer_with_camera(const struct smear_context *c,
                                                           const struct smear_submitted *s)
{
    if (!has_layers(c))
        return NULL;
    uint32_t layer = c->layers->layer_of[s - c->submitted];
    return layer != SMEAR_NO_LAYER && c->layers->setting[layer].has_camera ? &c->layers->setting[layer]
                                                                           : NULL;
}

static uint32_t magnitude_of(int32_t a)
{
    return a < 0 ? 0u - (uint32_t)a : (uint32_t)a;
}

static int32_t scaled(int32_t now, int32_t other, uint32_t scale_q8)
{
    return narrow_sat(now + (((int64_t)other - now) * (int32_t)scale_q8 >> 8));
}

/* Deformation is not scaled further: weights of ten frames by it have eight bits. */
enum { DEFORM_MOST = 8 << 8 };

/* Brings the other poses nearer to that of now, or farther: smear_frame.object_scale. */
static void scale_object(struct draw_poses *p, smear_transform made_poses[3], uint32_t scale)
{
    for (int i = 1; i < 3; i++) {
        const smear_transform *other = p->object[i], *now = p->object[0];
        smear_transform *made = &made_poses[i];
        for (int k = 0; k < 9; k++)
            made->basis[k] = scaled(now->basis[k], other->basis[k], scale);
        for (int k = 0; k < 3; k++)
            made->origin[k] = scaled(now->origin[k], other->origin[k], scale);
        p->object[i] = made;
        if (scale == 0)
            p->position[i] = p->position[0];
    }
    p->deform = min_i32((int32_t)scale, DEFORM_MOST);
}

/* Turns a billboard with the camera of each pose. */
static void turn_billboard(struct draw_poses *p, smear_transform made_poses[3], bool upright)
{
    for (int pose = 0; pose < 3; pose++) {
        const int32_t *camera = p->camera[pose]->pose.basis;
        int32_t turn[9], made[9];
        for (int i = 0; i < 9; i++)
            turn[i] = camera[i];
        if (upright) {
            /* The camera's x axis, without its y. Looking straight up or down it stays as long. */
            uint32_t length = sqrt_floor_64((uint64_t)((int64_t)camera[0] * camera[0]
                                                       + (int64_t)camera[6] * camera[6]));
            int32_t x = 1 << 24, z = 0;
            if (length > 1u << 16) {
                x = ratio_q30((int64_t)min_u32(magnitude_of(camera[0]), length), length) >> 6;
                z = ratio_q30((int64_t)min_u32(magnitude_of(camera[6]), length), length) >> 6;
                x = camera[0] < 0 ? -x : x;
                z = camera[6] < 0 ? -z : z;
            }
            const int32_t about_y[9] = { x, 0, -z, 0, 1 << 24, 0, z, 0, x };
            for (int i = 0; i < 9; i++)
                turn[i] = about_y[i];
        }
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++) {
                int64_t sum = 0;
                for (int k = 0; k < 3; k++)
                    sum += (int64_t)turn[3 * i + k] * p->object[pose]->basis[3 * k + j];
                made[3 * i + j] = narrow_sat(sum >> 24);
            }
        for (int i = 0; i < 3; i++)
            made_poses[pose].origin[i] = p->object[pose]->origin[i];
        for (int i = 0; i < 9; i++)
            made_poses[pose].basis[i] = made[i];
        p->object[pose] = &made_poses[pose];
    }
}

/* Of the object alone. */
static void object_poses(struct smear_context *c, const struct smear_submitted *s, struct draw_poses *p)
{
    const smear_draw *d = &s->draw;
    if (c->frame.cut || d->cut || d->motion != SMEAR_MOTION_FULL)
        return;
    if (d->open_position != NULL && (d->open_count == 0 || d->open_count == d->mesh->vertex_count))
        p->position[1] = d->open_position;
    if (d->open != NULL)
        p->object[1] = d->open;
    else if (!c->frame.shutter_poses && s->kept >= 0 && c->kept[s->kept].has_before)
        p->object[1] = &c->kept[s->kept].before;
    if (c->frame.shutter_poses) {
        if (d->close_position != NULL && (d->close_count == 0 || d->close_count == d->mesh->vertex_count))
            p->position[2] = d->close_position;
        if (d->close != NULL)
            p->object[2] = d->close;
    }
    if (SMEAR_WITH_SCALES && c->frame.object_scale != 256)
        scale_object(p, c->made, c->frame.object_scale);
}

/* Valid until the next draw's. */
static void poses_of(struct smear_context *c, const struct smear_submitted *s, struct draw_poses *p)
{
    const smear_draw *d = &s->draw;
    const smear_transform *object = d->now != NULL ? d->now : &smear_identity;
    for (int i = 0; i < 3; i++) {
        p->object[i] = object;
        p->camera[i] = &c->camera;
        p->position[i] = d->mesh->position;
        p->projected[i] = false;
    }
    p->deform = 256;
    const struct smear_layer_setting *own = layer_with_camera(c, s);
    for (int i = 0; i < 3 && own != NULL; i++)
        p->camera[i] = &own->camera[0];
    if (own != NULL && !c->frame.cut && d->motion != SMEAR_MOTION_NONE) {
        p->camera[1] = &own->camera[1];
        if (c->frame.shutter_poses)
            p->camera[2] = &own->camera[2];
    } else if (own == NULL && c->camera_moves && !c->frame.cut && d->motion != SMEAR_MOTION_NONE) {
        p->camera[1] = &c->camera_open;
        if (c->frame.shutter_poses)
            p->camera[2] = &c->camera_close;
    }
    object_poses(c, s, p);
    if (SMEAR_WITH_BILLBOARDS && d->billboard != SMEAR_BILLBOARD_NONE)
        turn_billboard(p, c->made, d->billboard == SMEAR_BILLBOARD_UPRIGHT);
}

static bool pose_differs(const struct draw_poses *p, int i)
{
    return (SMEAR_WITH_DEFORM && p->position[i] != p->position[0])
        || !same_transform(p->object[i], p->object[0]) || !same_camera(p->camera[i], p->camera[0]);
}

/* Where a draw's velocity comes from: its own vertices, its depth, or nowhere. */
static void classify_draw(struct smear_context *c, const struct smear_submitted *s,
                          struct smear_raster_draw *r)
{
    struct draw_poses p;
    poses_of(c, s, &p);
    r->moves = pose_differs(&p, 1) || pose_differs(&p, 2);
    r->fixed = false;
    if (SMEAR_WITH_FILTERS && c->raster.velocity_from_depth) {
        bool own = false, attached = true;
        for (int i = 1; i < 3; i++) {
            bool deforms = p.position[i] != p.position[0];
            own = own || deforms || !same_transform(p.object[i], p.object[0]);
            attached = attached && !deforms
                    && smear_is_attached(p.object[i], p.camera[i], p.object[0], p.camera[0]);
        }
        r->fixed = s->draw.motion == SMEAR_MOTION_NONE || (own && attached);
        r->moves = own && !attached;
    }
    c->blur.held = c->blur.held || r->fixed;
    if (SMEAR_WITH_FILTERS && c->frame.method == SMEAR_CAMERA)
        r->moves = false;
    if (r->moves)
        c->stats.draws_moved++;
}

/* Of a pose, made once. */
static const struct smear_projection *project_pose(const struct smear_context *c, struct draw_poses *p, int i,
                                                   const smear_mesh *mesh)
{
    if (!p->projected[i]) {
        struct smear_view view;
        smear_view_compose(&view, p->object[i], mesh, &p->camera[i]->pose);
        smear_projection_make(&p->projection[i], &view, p->camera[i], c->window.height);
        p->projected[i] = true;
    }
    return &p->projection[i];
}

static bool deformation_is_scaled(const struct draw_poses *p, int k)
{
    return SMEAR_WITH_SCALES && SMEAR_WITH_DEFORM && p->deform != 256 && p->position[k] != p->position[0];
}

/* Where the vertices are at an instant: a sum of poses, linear in clip space. */
static void place(struct smear_placement *out, const struct smear_context *c, struct draw_poses *p,
                  const smear_mesh *mesh, const struct instant *instant)
{
    enum { TERMS = SMEAR_WITH_SCALES && SMEAR_WITH_DEFORM ? 5 : 3 };
    struct smear_projection sum[TERMS];
    const int16_t *position[TERMS];
    int32_t weight[TERMS];
    int count = 0;
    out->extra_count = 0;
    for (int k = 0; k < 3; k++) {
        if (instant->weight[k] == 0)
            continue;
        sum[count] = *project_pose(c, p, k, mesh);
        position[count] = p->position[k];
        weight[count++] = instant->weight[k];
        if (deformation_is_scaled(p, k)) {      /* part of the way from the mesh's own vertices */
            sum[count] = sum[count - 1];
            position[count] = p->position[0];
            weight[count - 1] = (int32_t)((int64_t)instant->weight[k] * p->deform >> 8);
            weight[count] = instant->weight[k] - weight[count - 1];
            count++;
        }
    }
    if (count > 1)
        smear_projection_weigh(sum, weight, count, p->camera[0]);
    out->now = sum[0];
    out->position = position[0];
    for (int k = 1; k < count; k++) {
        if (!SMEAR_WITH_DEFORM || position[k] == out->position) {
            smear_projection_add(&out->now, &sum[k]);
        } else {
            SMEAR_ASSERT(out->extra_count < 2);         /* that of now is the first, or there is one more */
            out->extra[out->extra_count] = sum[k];
            out->extra_position[out->extra_count++] = position[k];
        }
    }
}

/* A pose between which velocity is measured. */
static void add_pose(struct smear_assembly *a, const struct smear_context *c, struct draw_poses *p,
                     int k)
{
    const int i = a->moves++;
    a->pose[i] = *project_pose(c, p, k, a->mesh);
    a->pose_position[i] = p->position[k];
    if (!SMEAR_WITH_SCALES || !SMEAR_WITH_DEFORM)
        return;
    struct smear_projection both[2] = { a->pose[i], a->pose[i] };
    int32_t deform = deformation_is_scaled(p, k) ? p->deform : 256;
    const int32_t weight[2] = { deform * 65536, (256 - deform) * 65536 };
    a->has_rest = a->has_rest || deform != 256;
    if (p->deform != 256)
        smear_projection_weigh(both, weight, 2, p->camera[0]);
    a->pose[i] = both[0];
    a->rest[i] = both[1];
}

/* Everything the assembler needs of draw `i`, for the given instant. False where nothing of it is in view. */
static SMEAR_NOINLINE bool make_assembly(struct smear_context *c, uint32_t i, const struct instant *instant,
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
    a->path = a->fixed = a->has_rest = false;

    bool moves = pose_differs(&poses, 1) || pose_differs(&poses, 2);
    place(&a->at, c, &poses, a->mesh, moves ? instant : &sharp_instant);
    if (SMEAR_WITH_SUBFRAMES && moves && c->assembler.keep_paths) {
        struct instant open = instant_at(c, -65536), close = instant_at(c, 65536);
        a->path = true;
        place(&a->key[0], c, &poses, a->mesh, &open);
        place(&a->key[1], c, &poses, a->mesh, &close);
    }
    /* Layers reach beyond the frame. */
    if (SMEAR_WITH_BOUNDS && !has_layers(c) && smear_vertex_is_beside(a, &c->assembler.viewport))
        return false;

    smear_shading_make(&a->shading, poses.object[0], a->material, a->mesh->normal != NULL,
                       SMEAR_WITH_LINEAR && c->frame.light == SMEAR_LIGHT_LINEAR);
#if SMEAR_LEVELS
    /* In linear light, colours that are interpolated may round to other codes. */
    a->level = a->material->alpha == SMEAR_OPAQUE
            && !shading_is_linear(&a->shading) && smear_vertex_is_level(a->mesh, a->shading.lit);
#endif
    if (!moves)
        return true;
    a->fixed = c->raster_draw[i].fixed;
    if (!SMEAR_WITH_RECONSTRUCT || !c->assembler.keep_motion || !c->raster_draw[i].moves)
        return true;
    /* Velocity is measured from the open pose to the close pose, or to now. Where the drawn instant is the
     * later pose itself, one further pose is enough. */
    add_pose(a, c, &poses, 1);
    if (c->frame.shutter_poses || instant->weight[0] != 1 << 24)
        add_pose(a, c, &poses, c->frame.shutter_poses ? 2 : 0);
    return true;
}

/* ------------------------------------------------------------------ assembling */

/* Draws of a kind. */
enum draws { DRAWS_ALL, DRAWS_MOVING, DRAWS_STATIC };

static bool is_of_kind(const struct smear_context *c, uint32_t i, enum draws kind)
{
    return kind == DRAWS_ALL || draw_is_static(c, i) == (kind == DRAWS_STATIC);
}

/* Assembles draws into what `as` names. False when the store is full. */
static bool assemble_kind(struct smear_context *c, struct smear_assembler *as, const struct instant *instant,
                          bool drop, enum draws kind)
{
    struct smear_tile_box *seen = NULL;
    for (uint32_t k = 0; k < c->draw_count; k++) {
        struct smear_assembly a;
        uint32_t i = has_layers(c) ? c->layers->sequence[k] : k;
        if ((static_is_cached(c) && draw_is_static(c, i)) || (SMEAR_WITH_DAMAGE && !is_of_kind(c, i, kind)))
            continue;
        if (SMEAR_WITH_DAMAGE && kind == DRAWS_STATIC) {
            seen = seen == NULL ? c->still->seen : seen + 1;
            if (c->still->is_same && !tile_box_is_damaged(&c->still->due, *seen))
                continue;
            c->still->due.only = c->still->is_same;
            c->still->due.seen = c->still->is_same ? NULL : seen;
        }
        const struct smear_group *group = has_layers(c) && c->layers->group_of[i] != SMEAR_NO_GROUP
                                        ? &c->layers->group[c->layers->group_of[i]] : NULL;
        if (has_layers(c))
            c->assembler.keep_motion = group != NULL && group->method == SMEAR_LAYERED;
        const bool is_sharp = has_layers(c) && (group == NULL || group->method == SMEAR_NONE);
        const bool is_in_view = make_assembly(c, i, is_sharp ? &sharp_instant : instant, &a);
        if (SMEAR_WITH_BOUNDS && !is_in_view) {
            c->stats.draws_beside++;
            continue;
        }
        if (group != NULL ? !smear_layers_assemble(c, &a, drop)
                          : !(SMEAR_WITH_SUBFRAMES && a.path ? smear_assemble_path(as, &a, drop)
                                                             : smear_assemble(as, &a, drop)))
            return false;
    }
    return true;
}

/* Assembles all draws. Where the display keeps tiles, what moves comes first: it says in which of them
 * something must be drawn. */
static bool assemble_draws(struct smear_context *c, struct smear_assembler *as, const struct instant *instant,
                           bool drop)
{
    if (!SMEAR_WITH_DAMAGE || as->due == NULL)
        return assemble_kind(c, as, instant, drop, DRAWS_ALL);
    c->still->due.only = false;
    c->still->due.seen = NULL;
    return assemble_kind(c, as, instant, drop, DRAWS_MOVING)
        && assemble_kind(c, as, instant, drop, DRAWS_STATIC);
}

#if SMEAR_FAST_STACK
/* The same with what it works on brought to the stack. */
static SMEAR_NOINLINE bool assemble_fast(struct smear_context *c, const struct instant *instant, bool drop)
{
    enum { VERTICES = 64 };
    struct smear_cached_vertex cache[VERTICES];
    struct smear_bins bins = c->bins;
    struct smear_assembler as = c->assembler;
    as.bins = &bins;
    as.cache = cache;
    as.cache_mask = VERTICES - 1;
    as.serial = 0;
    smear_assembler_reset(&as);
    const bool done = assemble_draws(c, &as, instant, drop);
    c->bins = bins;
    c->assembler.path_count = as.path_count;
    c->assembler.path_static_count = as.path_static_count;
    c->assembler.triangles_drawn = as.triangles_drawn;
    c->assembler.triangles_dropped = as.triangles_dropped;
    return done;
}
#endif

/* Assembles all draws for the tile rows [first, end). False when the store is full. */
static SMEAR_NOINLINE bool assemble_rows(struct smear_context *c, int first, int end,
                                         const struct instant *instant, bool drop)
{
    smear_bins_reset(&c->bins, first, end);
#if SMEAR_FAST_STACK
    if (!has_layers(c))
        return assemble_fast(c, instant, drop);
#endif
    smear_assembler_reset(&c->assembler);
    return assemble_draws(c, &c->assembler, instant, drop);
}

/* What the pool has left, between vertices and triangles, keeps setups from tile row to tile row. */
static void cache_free_pool(struct smear_context *c)
{
    const struct smear_bins *g = &c->bins;
    uint32_t first = (g->vertex_words + 1u) & ~1u;
    uint32_t end = g->pool_words - g->triangle_count * (uint32_t)(sizeof(struct smear_triangle) / 4);
    size_t bytes = first < end ? (size_t)(end - first) * 4 : 0;
    c->cache = smear_raster_cache_make(g->pool + first, bytes, c->jobs.workers);
}

/* What moves by less than a step of its vertices is drawn among what stands still, and in order with it. */
static bool still_is_disturbed(const struct smear_context *c)
{
    return static_is_cached(c) && c->assembler.path_static_count != 0;
}

/* Assembles as many tile rows of [first, end) as find room; returns their end. Rows above are included
 * for what is finished a row late: from *top on, at most from `least` on where room is short. When that
 * is too much, triangles are dropped and counted. */
static int assemble_part(struct smear_context *c, int *top, int least, int first, int end,
                         const struct instant *instant)
{
    uint32_t start = stage_start(c);
    SMEAR_ENTER_STAGE(SMEAR_STAGE_ASSEMBLE);
    for (;;) {
        uint32_t drawn = c->assembler.triangles_drawn, dropped = c->assembler.triangles_dropped;
        bool last = end - first <= 1 && *top == least, done = assemble_rows(c, *top, end, instant, last);
        if (done && !still_is_disturbed(c))
            break;
        c->assembler.triangles_drawn = drawn;
        c->assembler.triangles_dropped = dropped;
        if (SMEAR_WITH_DAMAGE && done) {
            damage_forget(c);
            continue;
        }
        if (end - first > 1)
            end = first + (end - first) / 2;
        else
            ++*top;
        c->stats.triangles_split++;
    }
    SMEAR_ENTER_STAGE(SMEAR_STAGE_DRAW);
    c->opaque = c->blend = c->moving = SMEAR_NO_TRIANGLE;
    if (SMEAR_RASTER_CACHE)
        cache_free_pool(c);
    for (int row = *top; row < first; row++)
        c->opaque = smear_bins_advance(&c->bins, c->bins.opaque_last, c->opaque, row);
    stage_end(c, &c->stats.time_submit, start);
    return end;
}

/* ------------------------------------------------------------------ raster */

static void clear_rows(struct smear_context *c, int32_t y0, int32_t y1, int32_t x0, int32_t x1)
{
    struct smear_window *w = &c->window;
    uint32_t clear = c->frame.clear & 0xffffffu;
    for (int32_t y = y0; y < y1; y++) {
        int32_t at = window_ring_row(w, y) * w->width + x0, n = x1 - x0;
        pixels_fill(w->color + at, clear, n);
        __builtin_memset(w->depth + at, 0, (size_t)n * 2);
        int velocity = SMEAR_WITH_FILTERS && c->raster.velocity_from_depth ? SMEAR_VELOCITY_UNKNOWN8 : 0;
        if (w->velocity8 != NULL)
            __builtin_memset(w->velocity8 + 2 * at, velocity, (size_t)n * 2);
        if (w->velocity16 != NULL)
            __builtin_memset(w->velocity16 + 2 * at, velocity, (size_t)n * 4);
        if (SMEAR_WITH_INSPECT && c->inspect != NULL)
            __builtin_memset(c->inspect + 2 * at, 0, (size_t)n * 8);
    }
}

/* Sharp frames straight into the band: neither working pixels nor a conversion. A row's place in the band is
 * its place in the window, which has no more rows. */
static void direct_job(void *argument, int job, int worker)
{
    const struct row_job *r = (const struct row_job *)argument;
    struct smear_context *c = r->c;
    struct smear_raster_target t;
    (void)worker;
    smear_row_target(c, r->row, &t);
    smear_job_columns(c, job, &t.x0, &t.x1);
    if (t.x0 >= t.x1)
        return;
    t.direct = (uint16_t *)(void *)r->band;
    t.cache = smear_raster_cache_of(&c->cache, job);
    const uint32_t clear = rgb565_nearest(c->frame.clear);
    int32_t at = t.x0, n = t.x1 - t.x0;
    for (int32_t y = t.y0; y < t.y1; y++, at += c->window.width) {
        pixels_fill_narrow(t.direct + at, clear, n);
        pixels_fill_narrow(t.depth + at, 0, n);
    }
    smear_raster_list(&c->raster, &t, c->opaque);
    at = t.x0;
    if (smear_format_is_swapped((smear_format)c->desc.format))
        for (int32_t y = t.y0; y < t.y1; y++, at += c->window.width)
            smear_format_swap(t.direct + at, n);
}

static int render_direct_row(struct smear_context *c, int row)
{
    uint32_t start = stage_start(c);
    c->opaque = smear_bins_advance(&c->bins, c->bins.opaque_last, c->opaque, row);
    struct row_job job = { .c = c, .row = row, .band = smear_band_begin(c) };
    smear_jobs_run(&c->jobs, direct_job, &job, c->jobs.workers);
    stage_end(c, &c->stats.time_raster, start);
    return smear_band_flush(c, row, job.band);
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
    t.cache = smear_raster_cache_of(&c->cache, job);
    if (SMEAR_WITH_RECONSTRUCT && c->assembler.keep_motion) {
        t.velocity8 = w->velocity8;
        t.velocity16 = w->velocity16;
        t.inspect = c->inspect;
    }
    smear_raster_list(&c->raster, &t, c->opaque);
    if (!SMEAR_WITH_FILTERS || !c->raster.velocity_from_depth)
        return;
    const struct smear_camera_store store = { c->raster.velocity_scale, c->raster.inspect_scale,
                                              c->raster.reach_q3, c->inspect };
    smear_camera_velocity(w, &c->filtering->reprojection, &store, c->frame.camera_step, t.x0, t.x1, t.y0,
                          t.y1);
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
        int32_t at = window_ring_row(w, y) * w->width;
        c->desc.inspect(c->desc.user, y, w->color + at, w->depth + at,
                        c->inspect + 2 * at);
    }
}

/* Draws tile row `row` into the window. */
static void draw_row(struct smear_context *c, int row)
{
    struct row_job job = { .c = c, .row = row };
    uint32_t start = stage_start(c);
    c->opaque = smear_bins_advance(&c->bins, c->bins.opaque_last, c->opaque, row);
    for (int32_t i = 0; i < c->window.columns; i++)
        c->window.moving[i] = 0;
    smear_jobs_run(&c->jobs, raster_job, &job, c->jobs.workers);
    if (SMEAR_WITH_INSPECT && c->inspect != NULL)
        inspect_rows(c, row);
    stage_end(c, &c->stats.time_raster, start);
}

static void blend_row(struct smear_context *c, int row)
{
    if (!SMEAR_WITH_ALPHA || !c->blends)
        return;
    struct row_job job = { .c = c, .row = row };
    c->blend = smear_bins_advance(&c->bins, c->bins.blend_last, c->blend, row);
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

/* The tile row's next band, after job->y1; false when there is none. A windowed
 * context may have bands of fewer rows than a tile. */
static bool next_band(struct row_job *job)
{
    struct smear_context *c = job->c;
    job->y0 = job->y1 != 0 ? job->y1 : row_top(c, job->row);
    job->y1 = min_i32(job->y0 + c->desc.band_rows, row_bottom(c, job->row));
    if (job->y0 >= job->y1)
        return false;
    job->band = smear_band_begin(c);
    return true;
}

static int finish_sharp(struct smear_context *c, int row)
{
    struct row_job job = { .c = c, .row = row };
    int result = SMEAR_OK;
    while (result == SMEAR_OK && next_band(&job)) {
        uint32_t start = stage_start(c);
        smear_jobs_run(&c->jobs, convert_job, &job, c->jobs.workers);
        stage_end(c, &c->stats.time_convert, start);
        result = smear_band_flush_part(&job);
    }
    return result;
}

/* ------------------------------------------------------------------ finishing with a filter */

/* First pixel row of a tile row in the window that filters read, and past its last. */
static int32_t filtered_top(const struct smear_context *c, int row)
{
    return row << c->filtered->tile_shift;
}

static int32_t filtered_bottom(const struct smear_context *c, int row)
{
    return min_i32(filtered_top(c, row + 1), c->filtered->height);
}

static void half_job(void *argument, int column, int worker)
{
    const struct row_job *r = (const struct row_job *)argument;
    (void)worker;
    smear_half_reduce(r->c->half, &r->c->window, r->row, column, r->c->blur.linear);
}

static void reduce_job(void *argument, int column, int worker)
{
    const struct row_job *r = (const struct row_job *)argument;
    const struct smear_window *w = r->c->filtered;
    (void)worker;
    if (r->c->window.moving[column])
        smear_tilemax(w, r->row, column);
    else
        window_motion(w, r->row)[column] = (struct smear_tile_motion){ 0, 0, 0, 0, 0, 0 };
}

static void reduce_row(struct smear_context *c, int row)
{
    struct row_job job = { .c = c, .row = row };
    uint32_t start = stage_start(c);
    if (SMEAR_WITH_FILTERS && c->filtered == c->half)
        smear_jobs_run(&c->jobs, half_job, &job, c->window.columns);
    smear_jobs_run(&c->jobs, reduce_job, &job, c->window.columns);
    stage_end(c, &c->stats.time_reduce, start);
}

static struct smear_row_table row_table(const struct smear_context *c, int row, int32_t y0, int32_t y1)
{
    return (struct smear_row_table){ c->row_offset, filtered_top(c, row) - c->filtered->reach, y0, y1 };
}

static bool is_still(const struct smear_window *w, int row, int column)
{
    return window_around(w, row)[column].kind == TILE_STATIC;
}

/* Still tiles go to the display as they lie in the window, a run of
 * them at once: the job of the run's first tile. */
static void convert_still(const struct row_job *r, int column)
{
    const struct smear_window *w = r->c->filtered;
    if (column > 0 && is_still(w, r->row, column - 1))
        return;
    int end = column + 1;
    while (end < w->columns && is_still(w, r->row, end))
        end++;
    smear_band_convert_window(r, tile_left(r->c, column), tile_right(r->c, end - 1));
}

/* What a pass reads: what the one before it left, or the picture. */
static const uint32_t *pass_input(const struct smear_context *c, int pass)
{
    return pass == 0 ? c->filtered->color : c->filtering->pass_plane[pass - 1];
}

/* The filter, over rows [y0, y1) of a tile of the window it reads;
 * rows of `tile` are that window's tile apart. */
static void filter_tile(struct smear_context *c, uint32_t *tile, int row, int column, int32_t y0, int32_t y1,
                        int worker)
{
    const struct smear_window *w = c->filtered;
    struct smear_row_table rows = row_table(c, row, y0, y1);
    uint8_t kind = window_around(w, row)[column].kind;
    uint32_t samples = 0;
    if (kind == TILE_STATIC)
        smear_blur_copy(tile, w, &rows, column);
    else if (SMEAR_WITH_FILTERS && c->frame.filter == SMEAR_FILTER_PINGPONG)
        samples = smear_pingpong_pass(tile, w->tile, pass_input(c, c->filtering->passes - 1), w, &rows,
                                      &c->filtering->pass[c->filtering->passes - 1], row, column, y0, y1,
                                      &c->blur);
    else if ((SMEAR_WITH_FILTERS && c->frame.filter == SMEAR_FILTER_MEAN)
             || (kind == TILE_UNIFORM && (c->frame.reconstruct & SMEAR_UNIFORM)))
        samples = smear_blur_uniform(tile, w, &rows, row, column, &c->blur);
    else if (SMEAR_WITH_FILTERS && c->frame.weights != SMEAR_WEIGHTS_STACK)
        samples = smear_blur_weights(tile, w, &rows, row, column, &c->blur);
    else
        samples = smear_blur_reconstruct(tile, w, &rows, row, column, &c->blur);
    c->worker_samples[worker] += samples;
}

static void tile_job(void *argument, int column, int worker)
{
    const struct row_job *r = (const struct row_job *)argument;
    struct smear_context *c = r->c;
    const struct smear_window *w = c->filtered;
    if (is_still(w, r->row, column) && c->blend == SMEAR_NO_TRIANGLE) {
        convert_still(r, column);
        return;
    }
    uint32_t *tile = c->scratch + worker * c->window.tile * c->desc.band_rows;
    if (!SMEAR_WITH_FILTERS || w != c->half) {
        filter_tile(c, tile, r->row, column, r->y0, r->y1, worker);
    } else if (is_still(w, r->row, column)) {
        struct smear_row_table rows = row_table(c, r->row, r->y0, r->y1);
        smear_blur_copy(tile, &c->window, &rows, column);
    } else {
        uint32_t *blurred = c->half_scratch + worker * w->tile * w->tile;
        filter_tile(c, blurred, r->row, column, filtered_top(c, r->row), filtered_bottom(c, r->row), worker);
        smear_half_blend(tile, blurred, w, &c->window, r->row, column);
    }
    if (c->blend != SMEAR_NO_TRIANGLE)
        smear_band_blend_tile(r, column, tile);
    smear_band_convert_tile(r, column, tile);
}

/* ------------------------------------------------------------------ passes before the last */

/* A part of tile row `row` in pass `pass`: pixel rows [y0, y1). */
struct pass_job {
    struct smear_context *c;
    int pass, row;
    int32_t y0, y1;
};

static void pass_tile_job(void *argument, int column, int worker)
{
    const struct pass_job *r = (const struct pass_job *)argument;
    struct smear_context *c = r->c;
    struct smear_row_table rows = row_table(c, r->row, r->y0, r->y1);
    c->worker_samples[worker] += smear_pingpong_pass(c->filtering->pass_plane[r->pass], 0,
                                                     pass_input(c, r->pass), c->filtered, &rows,
                                                     &c->filtering->pass[r->pass], r->row, column, r->y0,
                                                     r->y1, &c->blur);
}

/* Offsets of the rows that a blur of tile row `row` may read; those below row `end` stand for row end - 1. */
static void fill_row_table(struct smear_context *c, int row, int32_t end)
{
    const struct smear_window *w = c->filtered;
    int32_t first = filtered_top(c, row) - w->reach;
    for (int32_t i = 0; i < w->tile + 2 * w->reach; i++)
        c->row_offset[i] = (uint32_t)(window_ring_row(w, clamp_i32(first + i, 0, end - 1)) * w->width);
}

/* Carries every pass but the last on, as far down as the rows drawn up to tile row `known` allow: each stays
 * as far behind the one before it as it reaches. Returns the end of the rows that the last pass may read. */
static int32_t run_passes(struct smear_context *c, int known)
{
    int32_t end = filtered_bottom(c, known);
    for (int i = 0; SMEAR_WITH_FILTERS && i < c->filtering->passes - 1; i++) {
        int32_t input_end = end;
        if (known != c->window.rows - 1)
            end = max_i32(end - c->filtering->pass[i].reach, 0);
        for (int32_t y = c->filtering->pass_end[i]; y < end;) {
            int row = y >> c->filtered->tile_shift;
            struct pass_job job = { c, i, row, y, min_i32(end, filtered_bottom(c, row)) };
            fill_row_table(c, row, input_end);
            smear_jobs_run(&c->jobs, pass_tile_job, &job, c->window.columns);
            y = job.y1;
        }
        c->filtering->pass_end[i] = max_i32(c->filtering->pass_end[i], end);
    }
    return end;
}

/* ------------------------------------------------------------------ a tile row */

static uint32_t *count_of(struct smear_context *c)
{
    smear_stats *s = &c->stats;
    return !SMEAR_WITH_FILTERS               ? &s->tiles_reconstruct
         : c->frame.method == SMEAR_CAMERA   ? &s->tiles_camera
         : c->frame.method == SMEAR_PINGPONG ? &s->tiles_pingpong
         : c->frame.method == SMEAR_HALF     ? &s->tiles_half
                                             : &s->tiles_reconstruct;
}

static void count_tiles(struct smear_context *c, int row)
{
    const struct smear_tile_neighborhood *around = window_around(c->filtered, row);
    for (int32_t i = 0; i < c->window.columns; i++) {
        if (around[i].kind == TILE_STATIC) {
            c->stats.tiles_still++;
            c->stats.tiles_none++;
        } else {
            ++*count_of(c);
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
    const struct smear_window *w = c->filtered;
    bool corner = c->frame.reconstruct & SMEAR_CORNER;
    smear_neighbormax_row(w, row, known, corner);
    if (known > row)        /* looked at by the pixels of this row, and by passes that are ahead */
        smear_neighbormax_row(w, row + 1, known, corner);
    count_tiles(c, row);
    int32_t end = w->height;
    if (SMEAR_WITH_FILTERS && c->frame.filter == SMEAR_FILTER_PINGPONG && c->filtering->passes > 1)
        end = run_passes(c, known);
    fill_row_table(c, row, end);
    if (c->blends)
        c->blend = smear_bins_advance(&c->bins, c->bins.blend_last, c->blend, row);

    struct row_job job = { .c = c, .row = row };
    int result = SMEAR_OK;
    while (result == SMEAR_OK && next_band(&job)) {
        uint32_t start = stage_start(c);
        smear_jobs_run(&c->jobs, tile_job, &job, w->columns);
        stage_end(c, &c->stats.time_blur, start);
        result = smear_band_flush_part(&job);
    }
    return result;
}

/* ------------------------------------------------------------------ methods */

/* The instant whose sharp picture is blurred both ways: the middle of the exposure. */
static struct instant middle_of(const struct smear_context *c)
{
    return c->frame.shutter_poses ? sharp_instant : instant_at(c, 0);
}

/* Part after part: assembled at an instant, its tile rows
 * [first, end) then drawn, finished and handed out. */
typedef int rows_fn(struct smear_context *c, int first, int end);

static int render_parts(struct smear_context *c, const struct instant *instant, rows_fn *rows)
{
    for (int row = 0, end; row < c->window.rows; row = end) {
        int top = row;
        end = assemble_part(c, &top, row, row, c->window.rows, instant);
        int result = rows(c, row, end);
        if (result != SMEAR_OK)
            return result;
    }
    return SMEAR_OK;
}

static int sharp_rows(struct smear_context *c, int first, int end)
{
    int result = SMEAR_OK;
    for (int row = first; row < end && result == SMEAR_OK; row++) {
        if (SMEAR_DIRECT && c->direct) {
            result = render_direct_row(c, row);
        } else {
            draw_row(c, row);
            blend_row(c, row);
            result = finish_sharp(c, row);
        }
    }
    return result;
}

/* One step of the rolling window: tile row `row` has been drawn; row - 1 has a neighbour on both sides now.
 *
 *      row - 2    row - 1    row         the oldest is overwritten next
 *      drawn      drawn      drawn       colour, depth, velocity: the blur only reads them
 *                 blurred -> band -> flush
 *
 * Invariant: a filter reaches at most one tile, and the ring keeps `reach` rows of row - 2 (smear_init checks
 * it). Where it reaches farther, it is finished as many rows later. */
static int roll(struct smear_context *c, int row)
{
    reduce_row(c, row);
    int lag = SMEAR_WITH_FILTERS ? c->filtered->lag : 1, result = SMEAR_OK;
    if (row >= lag)
        result = finish_blurred(c, row - lag, row);
    if (row == c->window.rows - 1)
        for (int last = max_i32(row - lag + 1, 0); last <= row && result == SMEAR_OK; last++)
            result = finish_blurred(c, last, row);
    return result;
}

static int render_filter(struct smear_context *c)
{
    struct instant middle = middle_of(c);
    if (SMEAR_WITH_FILTERS && c->raster.velocity_from_depth)
        smear_reproject_make(&c->filtering->reprojection, &c->camera, &c->camera_open, &c->camera_close,
                             middle.weight, c->frame.shutter_poses, c->window.width, c->window.height);
    for (int row = 0; row < c->window.rows;) {
        int top = max_i32(row - (c->blends ? c->filtered->lag : 0), 0),
            end = assemble_part(c, &top, top, row, c->window.rows, &middle);
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
    struct instant middle = middle_of(c);
    if (SMEAR_WITH_DAMAGE)
        smear_damage_begin(c);
    int result = render_parts(c, &middle, smear_temporal_rows);
    if (SMEAR_WITH_DAMAGE && result == SMEAR_OK)
        smear_damage_end(c);
    return result;
}

/* Which draws are blurred, and how they move. */
static SMEAR_NOINLINE void find_layers(struct smear_context *c, const struct instant *middle)
{
    SMEAR_ENTER_STAGE(SMEAR_STAGE_ASSEMBLE);
    const struct instant open = instant_at(c, -65536), close = instant_at(c, 65536);
    smear_layers_begin(c);
    for (uint32_t i = 0; i < c->draw_count; i++) {
        const struct smear_submitted *s = &c->submitted[i];
        const smear_mesh *mesh = s->draw.mesh;
        struct draw_poses poses;
        struct smear_placement key[2], at;
        if (c->layers->layer_of[i] == SMEAR_NO_LAYER || c->raster_draw[i].alpha == SMEAR_BLEND)
            continue;
        const struct smear_layer_setting *setting = &c->layers->setting[c->layers->layer_of[i]];
        poses_of(c, s, &poses);
        bool moves = setting->layer.method != SMEAR_NONE
                  && (pose_differs(&poses, 1) || pose_differs(&poses, 2));
        if (!moves && !setting->has_camera && !setting->layer.over)
            continue;
        place(&key[0], c, &poses, mesh, moves ? &open : &sharp_instant);
        place(&key[1], c, &poses, mesh, moves ? &close : &sharp_instant);
        place(&at, c, &poses, mesh, moves ? middle : &sharp_instant);
        smear_layers_add(c, i, key, &at, moves);
    }
    smear_layers_end(c);
}

static int render_layers(struct smear_context *c)
{
    struct instant middle = middle_of(c);
    find_layers(c, &middle);
    return render_parts(c, &middle, smear_layers_rows);
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
        const uint32_t *in = w->color + window_ring_row(w, y) * w->width;
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
        uint32_t *out = w->color + window_ring_row(w, y) * w->width;
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

static SMEAR_NOINLINE void prepare(struct smear_context *c)
{
    SMEAR_ENTER_STAGE(SMEAR_STAGE_ASSEMBLE);
    struct smear_window *w = &c->window;
    smear_stats *s = &c->stats;
    *s = (smear_stats){ .arena_bytes = s->arena_bytes };
    s->pixels = (uint32_t)(w->width * w->height);
    for (int i = 0; i < c->jobs.workers; i++)
        c->worker_samples[i] = 0;
    bool linear = SMEAR_WITH_LINEAR && c->frame.light == SMEAR_LIGHT_LINEAR;
    uint32_t degrees = c->frame.shutter_degrees;

    c->raster.linear = linear;
    c->raster.velocity_scale = c->frame.shutter_poses ? 32768 : c->half_exposure >> 8;
    c->raster.inspect_scale = c->frame.shutter_poses ? (int32_t)((360u << 16) / degrees) : 65536;
    c->raster.reach_q3 = w->reach * 8;
    c->assembler.keep_motion = SMEAR_WITH_RECONSTRUCT && smear_method_is_filter(c->frame.method);
    c->assembler.keep_paths = SMEAR_WITH_SUBFRAMES && smear_method_is_temporal(c->frame.method);
    const bool view_moves = c->camera_moves && !(same_camera(&c->camera, &c->camera_open)
                                                 && same_camera(&c->camera, &c->camera_close));
#ifndef __OPTIMIZE_SIZE__       /* else every draw finds it out (pose_differs) */
    c->camera_moves = view_moves;
#endif
    c->raster.velocity_from_depth = SMEAR_WITH_FILTERS && c->assembler.keep_motion
                                 && c->frame.camera_step != 0 && view_moves && !c->frame.cut
                                 && c->state != STATE_FILTER;
    /* Pairs of taps of the widest gap, 8 to either side, find room
     * between the borders of a frame this large. */
    c->chooser = (struct smear_chooser){ c->frame.method, c->frame.samples, c->frame.target,
                                         min_i32(w->width, w->height) >= 24 };
    if (SMEAR_WITH_LAYERS && c->layers != NULL)
        c->layers->on = false;
    c->assembler.triangles_drawn = c->assembler.triangles_dropped = 0;
    if (SMEAR_WITH_DAMAGE)
        c->assembler.due = NULL;        /* until smear_damage_begin */

    c->blur = (struct smear_blur_settings){
        .linear = linear, .orthographic = SMEAR_WITH_ORTHOGRAPHIC && c->camera.half_height > 0,
        .samples = c->frame.samples, .dense = c->frame.method == SMEAR_HALF,
        .flags = c->frame.reconstruct, .weights = c->frame.weights
    };
    if (SMEAR_WITH_RECONSTRUCT && SMEAR_WITH_ORTHOGRAPHIC && c->blur.orthographic) {
        uint32_t range = (uint32_t)(c->camera.far_plane - c->camera.near_plane);
        int zeros = count_leading_zeros(range);
        uint64_t over = (uint64_t)recip_norm_precise(range << zeros) * (uint32_t)c->camera.far_plane;
        over >>= 45 - zeros;
        c->blur.far_over_range = over > 0xffffffffu ? 0xffffffffu : (uint32_t)over;
    }

    c->filtered = c->frame.method == SMEAR_HALF ? c->half : w;
    if (SMEAR_WITH_FILTERS && c->filtering != NULL) {
        c->filtering->passes = smear_pingpong_plan(c->filtering->pass, &c->frame.pingpong,
                                                   c->filtered->reach);
        for (int i = 0; i < PINGPONG_PASSES_MAX - 1; i++)
            c->filtering->pass_end[i] = 0;
    }

    c->blends = false;
    c->direct = SMEAR_DIRECT && c->desc.sharp && c->frame.method == SMEAR_NONE
             && (!SMEAR_WITH_DAMAGE || c->still == NULL || !c->still->keeps)
             && c->desc.dither == SMEAR_DITHER_NONE
             && (c->desc.format == SMEAR_RGB565 || c->desc.format == SMEAR_RGB565_SWAPPED);
    for (uint32_t i = 0; i < c->draw_count; i++) {
        const smear_draw *d = &c->submitted[i].draw;
        struct smear_raster_draw *r = &c->raster_draw[i];
        const smear_material *m = d->material;
        classify_draw(c, &c->submitted[i], r);
        r->alpha = m != NULL ? m->alpha : (uint8_t)SMEAR_OPAQUE;
        r->cutoff = m != NULL && m->cutoff != 0 ? m->cutoff : 128;
        if (SMEAR_WITH_TEXTURE && m != NULL && m->texture != NULL)
            smear_sampler_make(&r->sampler, m->texture, d->mesh->uv_shift != 0 ? d->mesh->uv_shift : 15,
                               m->bilinear, linear);
        c->blends = c->blends || (SMEAR_WITH_ALPHA && r->alpha == SMEAR_BLEND);
        /* Texels that must be rounded are rounded once at the end, not wherever they are drawn. */
        c->direct = SMEAR_DIRECT && c->direct && !c->blends
                 && (m == NULL || m->texture == NULL || m->texture->format == SMEAR_TEXEL_565);
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
    if (SMEAR_WITH_DAMAGE && !smear_method_is_temporal(c->frame.method))
        damage_forget(c);
    /* What was not compiled in has been refused by smear_begin. */
    int result;
    if (SMEAR_WITH_ACCUMULATE && c->frame.method == SMEAR_ACCUMULATE)
        result = render_accumulate(c);
    else if (SMEAR_WITH_RECONSTRUCT && smear_method_is_filter(c->frame.method))
        result = render_filter(c);
    else if (SMEAR_WITH_LAYERS && method_has_layers(c->frame.method))
        result = render_layers(c);
    else if (SMEAR_WITH_SUBFRAMES && smear_method_is_temporal(c->frame.method))
        result = render_timed(c);
    else
        result = render_parts(c, &sharp_instant, sharp_rows);
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
    if (SMEAR_WITH_DAMAGE)
        damage_forget(c);
    SMEAR_ENTER_STAGE(SMEAR_STAGE_DRAW);
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
    int32_t y = c->filter_row++, at = window_ring_row(w, y) * w->width;
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
