/* SPDX-License-Identifier: MIT */
/* smear.c - the public functions: check, keep poses, call the frame. */
#include "frame.h"

#include "base/compiled.h"
#include "others.h"
#include "raster/fog.h"
#include "validate.h"

#include "smear_overlay.h"

/* ------------------------------------------------------------------ memory */

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
    const size_t needed = smear_memory_size(desc);      /* 1.4 GB at most */
    if (memory == NULL || bytes < needed || ((uintptr_t)memory & 7u) != 0)
        return -(int)needed;

    struct smear_arena a = { (uint8_t *)memory, 0 };
    struct smear_context *c = SMEAR_PLACE(&d, SMEAR_PART_CONTEXT, arena_take(&a, 1, sizeof *c), sizeof *c);
    __builtin_memset(c, 0, sizeof *c);
    smear_layout(c, &a, &d);
    c->desc = d;
    c->stats.arena_bytes = (uint32_t)a.used;
    connect(c);
    smear_history_clear(&c->history);
    *ctx = c;
    return SMEAR_OK;
}

/* ------------------------------------------------------------------ frame */

/* Validates a frame and fills in its defaults. What is refused leaves the context as it was: only the last step writes to it. */
static int resolve(struct smear_context *c, smear_frame *f)
{
    int result = smear_check_cameras(f);
    if (result == SMEAR_OK)
        result = smear_resolve_frame(f, &c->desc);
    if (result == SMEAR_OK)
        result = smear_check_fog(f);
    if (result == SMEAR_OK)
        result = smear_check_layers(f);
    if (result == SMEAR_OK)
        result = smear_check_overlay(f->overlay);
    if (result == SMEAR_OK && f->scene != NULL)
        result = SMEAR_HAS_SCENE ? smear_scene_check(f->scene) : FAULT(FRAME_SCENE);
    if (result == SMEAR_OK && SMEAR_WITH_SUBFRAMES && !smear_shutter_make(&c->temporal.shutter, f->shutter.curve))
        result = FAULT(FRAME_CURVE);
    return result;
}

void smear_frame_keep(struct smear_context *c, const smear_frame *f)
{
    c->frame = *f;
    c->frame.camera = c->frame.open = c->frame.close = NULL;
    c->frame.shutter.curve = NULL;
    c->frame.light = NULL;
    c->frame.fog = NULL;
    c->frame.layer = NULL;
    c->frame.scene = NULL;
    c->rows.overlay = f->overlay;
    if (SMEAR_WITH_SKY)
        c->rows.sky = f->scene != NULL ? f->scene->sky : NULL;
}

/* Cuts at the fog's far plane, and clears to its colour. */
static void keep_fog(struct smear_context *c, const smear_fog *fog)
{
    for (int i = 0; fog != NULL && i < 3; i++) {
        smear_camera *camera = &c->shot.camera[i];
        if (camera->far_plane == 0 || camera->far_plane > fog->far_plane)
            camera->far_plane = fog->far_plane;
    }
    if (fog != NULL)
        c->frame.clear = fog->color;
    smear_fog_make(&c->rows.raster, fog, &c->shot.camera[0]);
}

/* Gives ids of the last frame that found no place, as those of the frame before it had them all, places of the latter. */
static SMEAR_NOINLINE void keep_late(struct smear_context *c)
{
    for (uint32_t i = 0; i < c->draw_count; i++)
        smear_history_keep_late(&c->history, c->submitted[i].draw.id, c->submitted[i].draw.now);
    c->has_late_ids = false;
}

int smear_begin(smear_context *c, const smear_frame *frame)
{
    if (c == NULL || frame == NULL)
        return SMEAR_ERR_ARG;
    if (c->state == STATE_DRAWING)
        return SMEAR_ERR_ORDER;
    SMEAR_ENTER_STAGE(SMEAR_STAGE_ASSEMBLE);
    smear_frame f = *frame;
    const int result = resolve(c, &f);
    if (result != SMEAR_OK)
        return result;
    if (SMEAR_WITH_LAYERS && smear_method_has_layers(f.method))
        smear_layers_keep(c, &f);
    struct smear_older *older = SMEAR_WITH_CURVES ? c->history.older : NULL;
    smear_shot_aim(&c->shot, &f, c->has_kept_camera ? &c->kept_camera : NULL,
                   older != NULL && older->has_camera ? &older->camera : NULL);
    smear_shot_expose(&c->shot, &f);
    if (older != NULL) {
        older->has_camera = c->has_kept_camera && !f.cut;
        older->camera = c->kept_camera;
    }
    c->kept_camera = *f.camera;
    c->has_kept_camera = true;
    smear_sun_make(&c->sun, f.light);
    if (SMEAR_WITH_LIGHTS && f.scene != NULL && f.scene->lights != NULL)
        c->sun.lights = f.scene->lights->shader->begin(&c->lights, f.scene->lights, &c->sun, &c->shot.camera[0]);
    smear_frame_keep(c, &f);
    if (SMEAR_FOG_MOST)
        keep_fog(c, f.fog);
    c->history.frame++;
    if (SMEAR_BLURS && c->has_late_ids)
        keep_late(c);
    c->draw_count = 0;
    c->state = STATE_BEGUN;
    return SMEAR_OK;
}

/* An id may be submitted once in a frame; `at` is its place in the history. */
static bool is_submitted(const struct smear_context *c, uint32_t id, int32_t at)
{
    if (at >= 0)
        return smear_history_has(&c->history, at, id);
    bool found = false;
    for (uint32_t i = 0; id != 0 && !found && i < c->draw_count; i++)
        found = c->submitted[i].draw.id == id;
    return found;
}

/* Copies a pose of the application's to where the draw has its own; null stays null. */
static void copy_pose(const smear_transform **given, smear_transform *own)
{
    if (*given == NULL)
        return;
    *own = **given;
    *given = own;
}

/* Keeps where a draw is for frames to come, `at` being the place of its id, or -1; and finds where it was, unless the
 * application has said so. Transforms have some 50 bytes: copies of them are much of what a draw costs on small machines, so
 * contexts that are always sharp keep none. */
static void recall(struct smear_context *c, struct smear_submitted *s, int32_t at)
{
    smear_transform unused[2];
    const bool is_sharp = c->desc.methods == SMEAR_SET(SMEAR_NONE), is_told = s->draw.open != NULL || c->shot.shutter_poses;
    const bool cut = s->draw.cut || c->shot.cut;
    int known = 0;
    if (at >= 0)
        known = smear_history_keep(&c->history, at, s->draw.id, is_sharp ? NULL : s->draw.now, cut, is_told ? unused : &s->pose[1]);
    else if (SMEAR_BLURS && !is_sharp && s->draw.id != 0)
        c->has_late_ids = true;
    if (is_told)
        return;
    s->draw.open = known > 0 ? &s->pose[1] : NULL;
    s->draw.close = known > 1 ? &s->pose[2] : NULL;
}

int smear_submit(smear_context *c, const smear_draw *draw)
{
    if (c == NULL || draw == NULL)
        return SMEAR_ERR_ARG;
    if (c->state != STATE_BEGUN)
        return SMEAR_ERR_ORDER;
    const int result = smear_check_draw(draw);
    if (result != SMEAR_OK)
        return result;
    const int32_t at = smear_history_find(&c->history, draw->id);
    if (is_submitted(c, draw->id, at))
        return FAULT(DRAW_ID);
    if (c->draw_count == c->desc.max_draws)
        return SMEAR_ERR_FULL;
    struct smear_submitted *s = &c->submitted[c->draw_count++];
    s->draw = *draw;
    copy_pose(&s->draw.now, &s->pose[0]);
    if (s->draw.now == NULL) {
        s->draw.now = &s->pose[0];
        s->pose[0] = (smear_transform){ { 0 }, { 0 } };
        s->pose[0].basis[0] = s->pose[0].basis[4] = s->pose[0].basis[8] = 1 << 24;
    }
    copy_pose(&s->draw.open, &s->pose[1]);
    copy_pose(&s->draw.close, &s->pose[2]);
    recall(c, s, at);
    return SMEAR_OK;
}

int smear_render(smear_context *c)
{
    if (c == NULL)
        return SMEAR_ERR_ARG;
    if (c->state != STATE_BEGUN)
        return SMEAR_ERR_ORDER;
    c->state = STATE_DRAWING;
    const int result = smear_frame_render(c);
    c->state = STATE_IDLE;
    return result;
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
