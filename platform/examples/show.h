/* SPDX-License-Identifier: MIT */
/* show.h - a converted model that plays its first clip, or turns, blurred, on the display of display.h: what examples and sketches of
 * `smear convert` draw. C99 or C++11.
 *
 *     smear convert Fox.glb --clip Run --texture-size 64 --name model -o model.h */
#include <smear.h>
#include <smear_math.h>
#include "model.h"

static smear_context *ctx;
#include "display.h"            /* SCREEN_WIDTH, _HEIGHT, _FORMAT; where two: _BANDS, _WORKERS; display_begin(), display_workers() */
#ifndef SCREEN_BANDS
#define SCREEN_BANDS 1
#endif
#ifndef SCREEN_WORKERS
#define SCREEN_WORKERS 1
#endif
#ifndef SCREEN_TRIANGLES        /* drawn at once; more are drawn in parts, slower */
#define SCREEN_TRIANGLES MODEL_TRIANGLES
#endif
#ifndef SCREEN_TIME             /* milliseconds: a clock's, where there is one */
#define SCREEN_TIME(frame) ((frame) * 1000u / 30u)
#endif

static uint64_t memory[SMEAR_MEMORY(SCREEN_WIDTH, SCREEN_HEIGHT, SCREEN_TRIANGLES, MODEL_DRAWS, SCREEN_FORMAT)
                       + (SCREEN_BANDS - 1) * SMEAR_MEMORY_BAND(SCREEN_WIDTH, SCREEN_HEIGHT, SCREEN_FORMAT)
                       + (SCREEN_WORKERS - 1) * SMEAR_MEMORY_WORKER(SCREEN_WIDTH, SCREEN_HEIGHT)];
static uint64_t actor_memory[MODEL_ACTOR_BYTES(2) / 8];
static smear_desc desc;                         /* all zero: the default of every field */
static smear_actor *actor;
static smear_camera camera;
static smear_frame frame;
static smear_play play;

/* Once: the display, then the library. Returns SMEAR_OK or what smear_error_text() explains. */
static int show_begin(void)
{
    const smear_model *model = &model_model;
    smear_transform view = smear_move(model->center[0], model->center[1], model->center[2]);
    view = smear_compose(view, smear_compose(smear_rotate_y(SMEAR_DEGREES(60)), smear_rotate_x(SMEAR_DEGREES(-17))));
    desc.width = SCREEN_WIDTH;
    desc.height = SCREEN_HEIGHT;
    desc.max_triangles = SCREEN_TRIANGLES;
    desc.max_draws = MODEL_DRAWS;
    desc.format = SCREEN_FORMAT;
    desc.bands = SCREEN_BANDS;
    desc.workers = SCREEN_WORKERS;
    display_begin(&desc);
    camera = smear_perspective(SMEAR_DEGREES(40), model->radius / 4, 0);
    camera.pose = smear_compose(view, smear_move(0, 0, model->radius * 3));
    frame.camera = &camera;
    frame.clear = 0x203040;
#ifdef SCREEN_METHOD
    frame.method = SCREEN_METHOD;
    frame.target = SCREEN_TARGET;
    frame.light_space = SCREEN_LIGHT;
#endif
    play.loop = 1;
    const int result = smear_init(&ctx, &desc, memory, sizeof memory);
#if SCREEN_WORKERS > 1
    if (result == SMEAR_OK)
        display_workers();
#endif
    return result == SMEAR_OK ? smear_actor_init(&actor, model, 2, actor_memory, sizeof actor_memory) : result;
}

/* Draws one frame. */
static int show_frame(void)
{
    static uint32_t number;
    static smear_transform place;
    const smear_model *model = &model_model;
    const uint32_t ms = SCREEN_TIME(number);
    number++;
    if (model->clip_count == 0) {           /* what has no clip turns about itself, once in a second and a half */
        place = smear_move(model->center[0], model->center[1], model->center[2]);
        place = smear_compose(place, smear_rotate_y(ms % 1500u * (SMEAR_DEGREES(120) / 500u)));
        place = smear_compose(place, smear_move(-model->center[0], -model->center[1], -model->center[2]));
        play.place = &place;
    }
    play.time = (int32_t)(((ms / 1000u << 16) + (ms % 1000u << 16) / 1000u) & INT32_MAX);
    const int result = smear_actor_advance(actor, &play);
    if (result != SMEAR_OK)
        return result;
    smear_begin(ctx, &frame);
    smear_actor_submit(actor, ctx);
    return smear_render(ctx);
}
