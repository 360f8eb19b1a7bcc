/* SPDX-License-Identifier: MIT */
/* setup.c - see setup.h. */
#include "tools/options/setup.h"

#include "tools/options/options_filter.h"
#include "tools/options/say.h"

#include <stdlib.h>

static bool is_temporal_method(const struct render_options *o)
{
    return o->shutter_degrees > 0 && smear_method_is_temporal(o->method);
}

static bool is_layered_method(const struct render_options *o)
{
    return o->shutter_degrees > 0 && smear_method_has_layers(o->method);
}

/* For sketches and drafts SMEAR_AUTO has a window beside it: its tiles are those of a filter. */
static unsigned method_set(const struct render_options *o)
{
    const bool has_kind = o->method == SMEAR_CAMERA || o->method == SMEAR_HALF;
    if (o->shutter_degrees == 0 && o->edges == SMEAR_EDGES_HARD)
        return SMEAR_SET(SMEAR_NONE);
    if (o->method == SMEAR_AUTO)
        return SMEAR_SET(SMEAR_AUTO) | (o->target >= SMEAR_DRAFT ? SMEAR_SET_SKETCH : 0u);
    return SMEAR_SET(o->method)
         | (has_kind && o->filter == SMEAR_FILTER_PINGPONG ? SMEAR_SET(SMEAR_PINGPONG) : 0u);
}

/* What --motion and --mask say of each draw. */
static int set_draws(const struct render_options *o, struct source *source, struct setup *out)
{
    struct failure f = { "" };
    struct scene_instant instant = { 0 };
    int status = STATUS_OK;
    if (o->motion_count == 0 && o->mask == NULL)
        return STATUS_OK;
    if (!scene_pose(&source->scene, 0.0, &instant, &f)) {
        status = say_bad_input(source->name, &f);
    } else {
        size_t room = (size_t)instant.draw_count + 1;
        out->motion = o->motion_count > 0 ? calloc(room, 1) : NULL;
        out->layers = o->mask != NULL ? calloc(room, 1) : NULL;
        if ((out->motion == NULL && o->motion_count > 0) || (out->layers == NULL && o->mask != NULL)) {
            fail(&f, "out of memory");
            status = say_bad_input(source->name, &f);
        }
        if (status == STATUS_OK && o->motion_count > 0)
            status = source_motion(source, o->motion, o->motion_count, &instant, out->motion);
        if (status == STATUS_OK && o->mask != NULL)
            status = source_mask(source, o->mask, &instant, out->layers);
        out->present.motion = out->motion;
        out->present.motion_count = out->motion != NULL ? instant.draw_count : 0;
        out->present.layers = out->layers;
        out->present.layers_count = out->layers != NULL ? instant.draw_count : 0;
    }
    scene_instant_free(&source->scene, &instant);
    return status;
}

int setup_change(const struct render_options *o, const struct source *source, struct setup *out)
{
    static const smear_layer masked = { .mask = SOURCE_MASKED };
    const struct scene *scene = &source->scene;
    bool is_builtin = !source->is_file;
    out->width = is_builtin && !o->has_size ? scene->width : o->width;
    out->height = is_builtin && !o->has_size ? scene->height : o->height;
    out->present = (struct present_options){
        .fps = is_builtin && !o->has_fps ? scene->fps : o->fps,
        .exposure = o->exposure,
        .shutter_poses = o->shutter_poses, .path = o->path, .method = o->method,
        .samples = o->exact ? 0 : o->samples, .light = o->light,
        .clear = is_builtin && !o->has_clear ? scene->clear : o->clear, .backdrop = o->backdrop,
        .fog = o->fog, .sky = o->sky, .lights = o->lights, .edges = o->edges,
        .reconstruct = o->reconstruct, .target = o->target, .budget = o->budget,
        .filter = o->filter, .camera_step = o->camera_step, .pingpong = o->pingpong,
        .weights = o->weights, .turn_scale = o->turn_scale, .way_scale = o->way_scale,
        .object_scale = o->object_scale,
        .motion = out->present.motion, .motion_count = out->present.motion_count,
        .layers = out->present.layers, .layers_count = out->present.layers_count,
        .layer = o->mask != NULL ? &masked : NULL, .layer_count = o->mask != NULL,
    };
    out->present.shutter_degrees = shutter_degrees_at(o, out->present.fps);
    if (o->tile == 4 && (is_temporal_method(o) || is_layered_method(o) || o->scatter || o->method == SMEAR_HALF))
        return say_bad_usage("--tile", "4 is for none, accumulate, reconstruct, camera and pingpong");
    if (!o->lights.has_sun && !o->lights.has_second && o->lights.reach == 0) {
        const int status = source_lights(source, &out->present.lights);
        if (status != STATUS_OK)
            return status;
    }
    return options_reach(o, out->height, &out->reach, &out->tile);
}

int setup_open(const struct render_options *o, struct source *source, struct setup *out)
{
    *out = (struct setup){ .motion = NULL };
    int status = setup_change(o, source, out);
    return status == STATUS_OK ? set_draws(o, source, out) : status;
}

void setup_release(struct setup *setup)
{
    free(setup->motion);
    free(setup->layers);
    *setup = (struct setup){ .motion = NULL };
}

struct device_setup setup_device(const struct setup *s, const struct render_options *o)
{
    return (struct device_setup){
        .width = s->width, .height = s->height, .reach = s->reach, .tile = s->tile,
        .format = o->format, .dither = o->dither, .doubled = o->doubled, .methods = method_set(o),
        .cache_static = o->cache_static && is_temporal_method(o),
        .keep_display = o->keep_display && (is_temporal_method(o) || method_set(o) == SMEAR_SET(SMEAR_NONE)),
        .scatter = o->scatter && (method_set(o) & SMEAR_SET_FILTERS) != 0, .threads = o->threads, .arena = o->arena,
    };
}

struct present_options setup_frame(const struct setup *s, const struct render_options *o,
                                   long frame)
{
    struct present_options p = s->present;
    for (int i = 0; i < o->cut_count; i++)
        if (o->cut[i] == frame)
            p.cut = true;
    return p;
}
