/* SPDX-License-Identifier: MIT */
/* draws_layers.c - SMEAR_OBJECT, SMEAR_LAYERED: what the core asks of blurred layers (others.h), their memory, and their frames. */
#include "draws.h"

#include "filter/filtered.h"
#include "layers/layer.h"
#include "base/compiled.h"
#include "smear_memory.h"

#if SMEAR_WITH_LAYERS

static void lay_out_layer_rows(struct smear_layer_rows *r, struct smear_arena *a, const smear_desc *d)
{
    const int32_t margin = (d->reach + 3) & ~3;     /* nodes of streaks lie 4 px apart, from the frame's side on */
    *r = (struct smear_layer_rows){ .margin = margin, .width = d->width + 2 * margin,
                                    .height = d->height + 2 * d->tile, .rows = d->tile + 2 * d->reach };
    const size_t layer = (size_t)r->width * (size_t)r->rows, cells = (size_t)(r->width / d->tile) + 1u;
    r->color = arena_take(a, layer, 4);
    r->depth = arena_take(a, layer, 2);
    smear_velocity_lay_out(&r->velocity8, &r->velocity16, a, layer, d->reach);
    r->cell = arena_take(a, 2 * cells, sizeof *r->cell);
    r->over = arena_take(a, (size_t)d->width * (size_t)d->tile, 4);
    r->over_depth = arena_take(a, (size_t)d->width * (size_t)d->tile, 2);
    r->row_first = arena_take(a, (size_t)r->rows, sizeof *r->row_first);
    r->row_end = arena_take(a, (size_t)r->rows, sizeof *r->row_end);
    r->work_bytes = (uint32_t)smear_streak_work(d->tile);
    r->work = arena_take(a, d->workers, r->work_bytes);
}

void smear_layers_lay_out(struct smear_context *c, struct smear_arena *a, const smear_desc *d)
{
    struct smear_layers measured, *l = arena_take(a, 1, sizeof *l);
    c->layers = l;
    if (l == NULL)          /* only measured */
        l = &measured;
    *l = (struct smear_layers){ 0 };
    lay_out_layer_rows(&l->rows, a, d);
    c->group_of = l->group_of = arena_take(a, d->max_draws, sizeof *l->group_of);
    l->group = arena_take(a, d->max_draws, sizeof *l->group);
    l->order = arena_take(a, d->max_draws, sizeof *l->order);
    c->sequence = l->sequence = arena_take(a, d->max_draws, sizeof *l->sequence);
    l->layer_of = arena_take(a, d->max_draws, sizeof *l->layer_of);
    l->setting = arena_take(a, SMEAR_LAYERS_MAX, sizeof *l->setting);
}

void smear_layers_keep(struct smear_context *c, const smear_frame *f)
{
    struct smear_layers *l = c->layers;
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
            s->has_older = s->layer.open != NULL && s->layer.close != NULL;
            if (!smear_camera_is_of_kind(&s->camera[1], s->camera) || !smear_camera_is_of_kind(&s->camera[2], s->camera)) {
                s->camera[1] = s->camera[2] = s->camera[0];
                s->has_older = false;
            }
        }
        s->layer.camera = s->layer.open = s->layer.close = NULL;
        s->shutter = s->layer.shutter_degrees != 0
                   ? (int32_t)(((uint32_t)s->layer.shutter_degrees << 16) / f->shutter.degrees) : 1 << 16;
    }
}

/* ------------------------------------------------------------------ what draws.c and draws_prepare.c ask */

bool smear_layers_are_curved(struct smear_context *c)
{
    struct smear_layer_setting *s = c->layers->setting;
    for (int i = 0; SMEAR_WITH_CURVES && i < c->layers->setting_count; i++, s++)
        if (s->has_camera && smear_cameras_are_curved(&c->shot, s->camera, s->has_older))
            return true;
    return false;
}

void smear_layers_bend(struct smear_context *c)
{
    struct smear_layer_setting *s = c->layers->setting;
    for (int i = 0; SMEAR_WITH_CURVES && i < c->layers->setting_count; i++, s++)
        if (s->has_camera)
            smear_cameras_bend(&c->shot, s->camera, s->has_older);
}

const smear_camera *smear_layers_camera(const struct smear_context *c, uint32_t i)
{
    const struct smear_layers *l = c->layers;
    const uint32_t layer = l->layer_of[i];
    return layer != SMEAR_NO_LAYER && l->setting[layer].has_camera ? l->setting[layer].camera : NULL;
}

const struct smear_instant *smear_layers_instant(struct smear_context *c, uint32_t i, const struct smear_instant *instant)
{
    const struct smear_group *group = draw_is_grouped(c, i) ? &c->layers->group[c->group_of[i]] : NULL;
    c->assembler.keep_motion = group != NULL && group->method == SMEAR_LAYERED;
    return group == NULL || group->method == SMEAR_NONE ? &smear_instant_now : instant;
}

bool smear_layers_assemble(struct smear_context *c, const struct smear_assembly *a)
{
    return smear_groups_assemble(c->layers, &c->assembler, a);
}

/* ------------------------------------------------------------------ a frame */

/* Finds which draws are blurred as layers, and how they move. */
static SMEAR_NOINLINE void find_layers(struct smear_context *c, const struct smear_instant *middle)
{
    SMEAR_ENTER_STAGE(SMEAR_STAGE_ASSEMBLE);
    const struct smear_instant open = smear_instant_at(&c->shot, -65536), close = smear_instant_at(&c->shot, 65536);
    struct smear_layers *l = c->layers;
    smear_groups_begin(l);
    for (uint32_t i = 0; i < c->draw_count; i++)
        smear_groups_find_layer(l, i, &c->submitted[i].draw);
    for (uint32_t i = 0; i < c->draw_count; i++) {
        const smear_draw *draw = &c->submitted[i].draw;
        struct smear_draw_poses poses;
        struct smear_placement key[2], at;
        if (l->layer_of[i] == SMEAR_NO_LAYER || c->raster_draw[i].alpha >= SMEAR_BLEND)
            continue;
        const struct smear_layer_setting *setting = &l->setting[l->layer_of[i]];
        poses_of(&poses, c, i);
        const bool moves = setting->layer.method != SMEAR_NONE && poses_differ(&poses);
        if (moves && !c->raster_draw[i].moves) {        /* before the layer's camera alone */
            c->raster_draw[i].moves = true;
            c->stats.draws_moved++;
        }
        if (!moves && !setting->has_camera && !setting->layer.over)
            continue;
        smear_draw_poses_place(&key[0], &poses, &c->shot, draw->mesh, moves ? &open : &smear_instant_now);
        smear_draw_poses_place(&key[1], &poses, &c->shot, draw->mesh, moves ? &close : &smear_instant_now);
        smear_draw_poses_place(&at, &poses, &c->shot, draw->mesh, moves ? middle : &smear_instant_now);
        smear_groups_add(l, i, draw, key, &at, &c->assembler.viewport, moves);
    }
    smear_groups_end(l, c->draw_count);
}

/* What is static is drawn once; each group of draws that move alike is drawn once, blurred and merged over it. */
int smear_layers_render(struct smear_context *c)
{
    const struct smear_instant middle = smear_instant_middle(&c->shot);
    int result = SMEAR_OK;
    c->has_groups = true;
    find_layers(c, &middle);
    for (int row = 0, end; row < c->rows.window.rows && result == SMEAR_OK; row = end) {
        struct smear_refill refill;
        end = smear_draws_assemble(c, row, row, c->rows.window.rows, &middle, &refill);
        result = smear_layered_rows(c->layers, &c->rows, c->frame.samples, row, end);
    }
    return result;
}

#endif
