/* SPDX-License-Identifier: MIT */
/* smear.c - the public functions: check, keep poses, call the frame. */
#include "frame.h"

#include "base/fixmath.h"
#include "geometry/arc.h"
#include "layout.h"
#include "probe.h"
#include "validate.h"

/* ------------------------------------------------------------------ memory */

#if SMEAR_WITH_BOUNDS
void smear_mesh_find_bounds(smear_mesh *mesh)
{
    int16_t *b = mesh->bounds;
    for (int k = 0; k < 3; k++)
        b[k] = b[k + 3] = mesh->vertex_count != 0 ? mesh->position[k] : 0;
    for (uint32_t i = 3; i < mesh->vertex_count * 3u; i += 3)
        for (uint32_t k = 0; k < 3; k++) {
            const int16_t p = mesh->position[i + k];
            b[k] = p < b[k] ? p : b[k];
            b[k + 3] = p > b[k + 3] ? p : b[k + 3];
        }
}
#else
void smear_mesh_find_bounds(smear_mesh *mesh)
{
    (void)mesh;
}
#endif

size_t smear_memory_size(const smear_desc *desc)
{
    if (desc == NULL)
        return 0;
    smear_desc d = *desc;
    if (smear_resolve_desc(&d) != SMEAR_OK)
        return 0;
    struct smear_context measured;
    struct smear_arena a = { NULL, 0 };
    arena_take(&a, 1, sizeof measured);
    smear_layout(&measured, &a, &d);
    return a.used;
}

/* Makes stages know each other and the desc. */
static void connect(struct smear_context *c)
{
    const smear_desc *d = &c->desc;
    struct smear_rows *rows = &c->rows;
    rows->desc = d;
    rows->stats = &c->stats;
    rows->raster.bins = c->assembler.bins = &rows->bins;
    rows->raster.draw = c->raster_draw;
    rows->raster.width = d->width;
    rows->raster.height = c->shot.height = d->height;
    rows->jobs.workers = d->workers;
    rows->jobs.idle = d->idle;
    rows->jobs.user = d->user;
    c->assembler.viewport = (struct smear_viewport){ d->width, d->height };
}

int smear_init(smear_context **ctx, const smear_desc *desc, void *memory, size_t bytes)
{
    if (ctx == NULL || desc == NULL)
        return SMEAR_ERR_ARG;
    *ctx = NULL;
    smear_desc d = *desc;
    const int result = d.flush == NULL ? FAULT(DESC_FLUSH) : smear_resolve_desc(&d);
    if (result != SMEAR_OK)
        return result;
    if (memory == NULL || ((uintptr_t)memory & 7u) != 0 || bytes < smear_memory_size(desc))
        return SMEAR_ERR_MEMORY;

    struct smear_arena a = { (uint8_t *)memory, 0 };
    struct smear_context *c = arena_take(&a, 1, sizeof *c);
    __builtin_memset(c, 0, sizeof *c);
    smear_layout(c, &a, &d);
    c->desc = d;
    c->stats.arena_bytes = (uint32_t)a.used;
    connect(c);
    for (uint32_t i = 0; SMEAR_WITH_IDS && i < d.max_draws; i++)
        c->kept[i].id = 0;
    *ctx = c;
    return SMEAR_OK;
}

/* ------------------------------------------------------------------ frame */

/* a / b in q24, at most 100 of them. */
static int32_t ratio_q24(uint32_t a, uint32_t b)
{
    int zeros = count_leading_zeros(b);
    uint64_t ratio = (uint64_t)a * recip_norm_precise(b << zeros) >> (37 - zeros);
    return (int32_t)(ratio < (uint64_t)100 << 24 ? ratio : (uint64_t)100 << 24);
}

/* Half the exposure in frames, q24; brings f->shutter.degrees up to date. */
static int32_t half_exposure(smear_frame *f)
{
    const int32_t whole = 1 << 24, longest = 10 << 24;
    int32_t exposure;
    if (SMEAR_WITH_SHUTTER_MODES && f->shutter.us != 0) {
        exposure = ratio_q24(f->shutter.us, f->shutter.frame_us);
        if (f->shutter.mode == SMEAR_SHUTTER_CAPPED)
            exposure = min_i32(exposure, whole);
    } else {
        /* Frames in which the shutter is to be as it is in one at the rate of reference. */
        int32_t frames = whole;
        if (SMEAR_WITH_SHUTTER_MODES && f->shutter.mode != SMEAR_SHUTTER_NATIVE)
            frames = ratio_q24(1000000, f->shutter.reference_hz * f->shutter.frame_us);
        if (SMEAR_WITH_SHUTTER_MODES && f->shutter.mode == SMEAR_SHUTTER_CAPPED)
            frames = min_i32(frames, whole);
        if (!SMEAR_WITH_SHUTTER_MODES || frames == whole)
            return (int32_t)(((uint32_t)f->shutter.degrees << 20) / 45u);
        /* 2^32 / 360 = 11930465 */
        uint64_t degrees = (uint64_t)f->shutter.degrees * (uint32_t)frames;
        degrees = (degrees >> 8) * 11930465u >> 24;
        exposure = (int32_t)(degrees < (uint64_t)longest ? degrees : (uint64_t)longest);
    }
    exposure = clamp_i32(exposure, 2, longest);
    f->shutter.degrees = (uint16_t)clamp_i32((int32_t)((int64_t)exposure * 360 >> 24), 1, 3600);
    return exposure / 2;
}

/* What instants depend on. */
static void set_exposure(struct smear_context *c, smear_frame *f)
{
    c->shot.half_exposure = half_exposure(f);
    c->shot.exposure = f->shutter.exposure;
    c->shot.shutter_poses = f->shutter.poses;
    c->shot.cut = f->cut;
    c->shot.object_scale = f->scale.object;
}

/* Brings a camera's pose nearer to that of now, or farther: its rotation and its translation each by their scale. */
static void scale_camera(smear_camera *other, const smear_camera *now, const smear_frame *f)
{
    smear_transform turned;
    if (f->scale.rotation != 256) {
        smear_arc_between(&turned, &other->pose, &now->pose, -(int32_t)f->scale.rotation * (1 << 16));
        for (int i = 0; i < 9; i++)
            other->pose.basis[i] = f->scale.rotation == 0 ? now->pose.basis[i] : turned.basis[i];
        int64_t focal = now->focal + (((int64_t)other->focal - now->focal) * f->scale.rotation >> 8);
        int64_t half = now->half_height
                     + (((int64_t)other->half_height - now->half_height) * f->scale.rotation >> 8);
        other->focal = now->focal > 0 ? max_i32(narrow_sat(focal), 1) : 0;
        other->half_height = now->half_height > 0 ? max_i32(narrow_sat(half), 1) : 0;
    }
    for (int i = 0; i < 3 && f->scale.translation != 256; i++)
        other->pose.origin[i] = narrow_sat(now->pose.origin[i]
                                           + (((int64_t)other->pose.origin[i] - now->pose.origin[i])
                                              * f->scale.translation >> 8));
}

/* Copies the frame's layers, or makes the one it has without. */
static void keep_layers(struct smear_layers *l, const smear_frame *f)
{
    static const smear_layer all = { .mask = 255 };
    l->setting_count = f->layer_count != 0 ? f->layer_count : 1;
    for (int i = 0; i < l->setting_count; i++) {
        struct smear_layer_setting *s = &l->setting[i];
        s->layer = f->layer_count != 0 ? f->layer[i] : all;
        if (s->layer.method == 0)
            s->layer.method = f->method;
        s->has_camera = s->layer.camera != NULL;
        if (s->has_camera) {
            s->camera[0] = *s->layer.camera;
            s->camera[1] = s->layer.open != NULL ? *s->layer.open : s->camera[0];
            s->camera[2] = s->layer.close != NULL ? *s->layer.close : s->camera[0];
        }
        s->layer.camera = s->layer.open = s->layer.close = NULL;
        s->shutter = s->layer.shutter_degrees != 0
                   ? (int32_t)(((uint32_t)s->layer.shutter_degrees << 16) / f->shutter.degrees) : 1 << 16;
    }
}

static bool same_kind(const smear_camera *a, const smear_camera *b)
{
    return !SMEAR_WITH_ORTHOGRAPHIC || (a->half_height > 0) == (b->half_height > 0);
}

/* Finds the cameras of the three poses, of one kind: between a perspective and an orthographic view there is no path, as
 * after a cut. */
static void find_cameras(struct smear_context *c, const smear_frame *frame)
{
    struct smear_shot *shot = &c->shot;
    const smear_camera *now = frame->camera, *close = frame->close != NULL ? frame->close : now, *open = now;
    shot->camera_moves = true;
    if (frame->open != NULL)
        open = frame->open;
    else if (c->has_kept_camera && !frame->shutter.poses)
        open = &c->kept_camera;
    else
        shot->camera_moves = frame->shutter.poses && frame->close != NULL;
    if (!same_kind(open, now) || !same_kind(close, now)) {
        shot->camera_moves = false;
        open = close = now;
    }
    shot->camera[0] = *now;
    shot->camera[1] = *open;
    shot->camera[2] = *close;
    if (SMEAR_WITH_SCALES) {
        scale_camera(&shot->camera[1], now, frame);
        scale_camera(&shot->camera[2], now, frame);
    }
    c->kept_camera = *now;
    c->has_kept_camera = true;
}

/* Validates a frame and fills in its defaults. */
static int resolve(struct smear_context *c, smear_frame *f)
{
    int result = smear_check_cameras(f);
    if (result == SMEAR_OK)
        result = smear_resolve_frame(f, &c->desc);
    if (result == SMEAR_OK)
        result = smear_check_layers(f);
    if (result == SMEAR_OK && SMEAR_WITH_SUBFRAMES && !smear_shutter_make(&c->temporal.shutter, f->shutter.curve))
        result = FAULT(FRAME_CURVE);
    return result;
}

/* Keeps a frame whose pointers have been followed. */
static void keep_frame(struct smear_context *c, const smear_frame *f)
{
    c->frame = *f;
    c->frame.camera = c->frame.open = c->frame.close = NULL;
    c->frame.shutter.curve = NULL;
    c->frame.light = NULL;
    c->frame.layer = NULL;
}

int smear_begin(smear_context *c, const smear_frame *frame)
{
    if (c == NULL || frame == NULL)
        return SMEAR_ERR_ARG;
    smear_frame f = *frame;
    const int result = resolve(c, &f);
    if (result != SMEAR_OK)
        return result;
    if (SMEAR_WITH_LAYERS && smear_method_has_layers(f.method))
        keep_layers(c->layers, &f);
    find_cameras(c, &f);
    set_exposure(c, &f);
    smear_sun_make(&c->sun, f.light);
    keep_frame(c, &f);
    c->frame_number++;
    c->draw_count = 0;
    c->state = STATE_BEGUN;
    return SMEAR_OK;
}

/* Finds the kept pose of an id: its own, else a free one, else one not seen in the last frame; or -1. */
static int32_t find_kept(struct smear_context *c, uint32_t id)
{
    int32_t spare = -1;
    uint32_t n = c->desc.max_draws, at = id % n;
    for (uint32_t i = 0; i < n; i++, at = at + 1 == n ? 0 : at + 1) {
        struct smear_kept_pose *k = &c->kept[at];
        if (k->id == id)
            return (int32_t)at;
        if (k->id == 0)
            return spare >= 0 ? spare : (int32_t)at;
        if (spare < 0 && c->frame_number - k->frame > 1u)
            spare = (int32_t)at;
    }
    return spare;
}

/* Keeps the draw's pose under its id for the next frame, and takes the last frame's where the application gives none. */
static void keep_pose(struct smear_context *c, struct smear_submitted *s)
{
    const int32_t at = SMEAR_WITH_IDS && s->draw.id != 0 ? find_kept(c, s->draw.id) : -1;
    if (at < 0)
        return;
    struct smear_kept_pose *k = &c->kept[at];
    if (k->id == s->draw.id && k->frame + 1u == c->frame_number && s->draw.open == NULL && !c->shot.shutter_poses) {
        s->pose[1] = k->pose;
        s->draw.open = &s->pose[1];
    }
    k->id = s->draw.id;
    k->frame = c->frame_number;
    k->pose = s->pose[0];
}

/* An id may be submitted once in a frame. */
static bool is_submitted(struct smear_context *c, uint32_t id)
{
    if (!SMEAR_WITH_IDS || id == 0)
        return false;
    const int32_t at = find_kept(c, id);
    if (at >= 0)
        return c->kept[at].id == id && c->kept[at].frame == c->frame_number;
    for (uint32_t i = 0; i < c->draw_count; i++)        /* there was no room to keep it */
        if (c->submitted[i].draw.id == id)
            return true;
    return false;
}

/* Copies a pose of the application's to where the draw has its own; null stays null. */
static void copy_pose(const smear_transform **given, smear_transform *own)
{
    if (*given == NULL)
        return;
    *own = **given;
    *given = own;
}

int smear_submit(smear_context *c, const smear_draw *draw)
{
    static const smear_transform identity = SMEAR_IDENTITY;
    if (c == NULL || draw == NULL)
        return SMEAR_ERR_ARG;
    const int result = smear_check_draw(draw);
    if (result != SMEAR_OK)
        return result;
    if (c->state != STATE_BEGUN)
        return SMEAR_ERR_ORDER;
    if (is_submitted(c, draw->id))
        return FAULT(DRAW_ID);
    if (c->draw_count == c->desc.max_draws)
        return SMEAR_ERR_FULL;
    struct smear_submitted *s = &c->submitted[c->draw_count++];
    s->draw = *draw;
    if (s->draw.now == NULL)
        s->draw.now = &identity;
    copy_pose(&s->draw.now, &s->pose[0]);
    copy_pose(&s->draw.open, &s->pose[1]);
    copy_pose(&s->draw.close, &s->pose[2]);
    keep_pose(c, s);
    return SMEAR_OK;
}

int smear_render(smear_context *c)
{
    if (c == NULL)
        return SMEAR_ERR_ARG;
    if (c->state != STATE_BEGUN)
        return SMEAR_ERR_ORDER;
    c->state = STATE_IDLE;
    return smear_frame_render(c);
}

void smear_band_done(smear_context *c)
{
    /* Only this function writes the word, so a plain increment is enough. */
    unsigned sent = word_own(&c->rows.bands.sent);
    word_write(&c->rows.bands.sent, sent + 1u);
}

void smear_work(smear_context *c, int worker)
{
    if (SMEAR_WITH_WORKERS && c != NULL && worker > 0 && worker < c->rows.jobs.workers)
        smear_jobs_work(&c->rows.jobs, worker);
}

void smear_get_stats(const smear_context *c, smear_stats *stats)
{
    *stats = c->stats;
}

struct smear_probe smear_probe(const smear_context *c)
{
    return (struct smear_probe){ &c->rows, &c->filtered, &c->temporal, c->frame.method, c->frame.samples,
                                 c->shot.half_exposure, c->direct };
}

/* ------------------------------------------------------------------ the filter alone */

int smear_filter_begin(smear_context *c, const smear_frame *frame)
{
    if (!SMEAR_WITH_FILTER_ALONE || c == NULL || frame == NULL)
        return SMEAR_ERR_ARG;
    smear_frame f = *frame;
    if (f.camera == NULL || f.camera->near_plane <= 0)
        return FAULT(FRAME_CAMERA);
    const int result = smear_resolve_frame(&f, &c->desc);
    if (result != SMEAR_OK)
        return result;
    if (!smear_method_is_filter(f.method) || f.method == SMEAR_CAMERA)
        return FAULT(FRAME_METHOD);
    if (c->desc.workers > 1)
        return FAULT(DESC_WORKERS);
    f.shutter.poses = 0;
    c->shot.camera[0] = *f.camera;
    c->shot.camera[0].half_height = 0;
    c->shot.camera_moves = false;
    set_exposure(c, &f);
    keep_frame(c, &f);
    c->state = STATE_FILTER;
    smear_frame_filter_begin(c);
    return SMEAR_OK;
}

int smear_filter_row(smear_context *c, const uint32_t *color, const uint32_t *depth, const int16_t *velocity)
{
    if (!SMEAR_WITH_FILTER_ALONE || c == NULL || color == NULL || depth == NULL || velocity == NULL)
        return SMEAR_ERR_ARG;
    if (c->state != STATE_FILTER)
        return SMEAR_ERR_ORDER;
    int result = smear_frame_filter_row(c, color, depth, velocity);
    if (result != SMEAR_OK || c->filter_row == c->rows.window.height)
        c->state = STATE_IDLE;
    return result;
}
