/* SPDX-License-Identifier: MIT */
/* fox.h - a converted model that plays its first clip, or turns, blurred, below a sprite that turns and a line of text, on the display of
 * display.h: what all examples draw. C99 or C++11.
 *
 *     smear convert Fox.glb --clip Run --texture-size 64 --name model -o model.h
 *     smear convert coin.png --cell 16x16 --key ff00ff --name coin -o coin.h */
#include <smear.h>
#include <smear_math.h>
#include "model.h"
#include "coin.h"

static smear_context *ctx;
#include "display.h"            /* SCREEN_WIDTH, _HEIGHT, _FORMAT; where two: _BANDS, _WORKERS; display_begin(), display_workers() */
#ifndef SCREEN_BANDS
#define SCREEN_BANDS 1
#endif
#ifndef SCREEN_WORKERS
#define SCREEN_WORKERS 1
#endif

static uint64_t memory[SMEAR_MEMORY(SCREEN_WIDTH, SCREEN_HEIGHT, MODEL_TRIANGLES, MODEL_DRAWS, SCREEN_FORMAT)
                       + (SCREEN_BANDS - 1) * SMEAR_MEMORY_BAND(SCREEN_WIDTH, SCREEN_HEIGHT, SCREEN_FORMAT)
                       + (SCREEN_WORKERS - 1) * SMEAR_MEMORY_WORKER(SCREEN_WIDTH, SCREEN_HEIGHT)];
static uint64_t actor_memory[MODEL_ACTOR_BYTES(2) / 8];
static smear_desc desc;                         /* all zero: the default of every field */
static smear_actor *actor;
static smear_camera camera;
static smear_frame frame;
static smear_overlay_item item[2];
static smear_overlay overlay;
static smear_play play;

/* Once: the display, then the library. Returns SMEAR_OK or what smear_error_text() explains. */
static int fox_begin(void)
{
    const smear_model *model = &model_model;
    smear_transform view = smear_move(model->center[0], model->center[1], model->center[2]);
    view = smear_compose(view, smear_compose(smear_rotate_y(SMEAR_DEGREES(60)), smear_rotate_x(SMEAR_DEGREES(-17))));
    desc.width = SCREEN_WIDTH;
    desc.height = SCREEN_HEIGHT;
    desc.max_triangles = MODEL_TRIANGLES;
    desc.max_draws = MODEL_DRAWS;
    desc.format = SCREEN_FORMAT;
    desc.bands = SCREEN_BANDS;
    desc.workers = SCREEN_WORKERS;
    display_begin(&desc);
    camera = smear_perspective(SMEAR_DEGREES(40), model->radius / 4, 0);
    camera.pose = smear_compose(view, smear_move(0, 0, model->radius * 3));
    frame.camera = &camera;
    frame.clear = 0x203040;
    frame.overlay = &overlay;
    item[0].x = 4, item[0].y = 4;
    item[0].image = &coin;
    item[1].x = 24, item[1].y = 8;
    item[1].text = "smear";
    item[1].font = &smear_font_8x8;
    overlay.item = item;
    overlay.count = 2;
    play.loop = 1;
    const int result = smear_init(&ctx, &desc, memory, sizeof memory);
#if SCREEN_WORKERS > 1
    if (result == SMEAR_OK)
        display_workers();
#endif
    return result == SMEAR_OK ? smear_actor_init(&actor, model, 2, actor_memory, sizeof actor_memory) : result;
}

/* Draws one frame: a thirtieth of a second further. */
static int fox_frame(void)
{
    static uint32_t number;
    const smear_model *model = &model_model;
    static smear_transform place;
    if (model->clip_count == 0) {           /* what has no clip turns about itself */
        place = smear_move(model->center[0], model->center[1], model->center[2]);
        place = smear_compose(place, smear_rotate_y(number * SMEAR_DEGREES(8)));
        place = smear_compose(place, smear_move(-model->center[0], -model->center[1], -model->center[2]));
        play.place = &place;
    }
    play.time = (int32_t)(number * 65536u / 30u & INT32_MAX);
    item[0].cell = (uint16_t)(number / 3u % coin.cells);
    number++;
    const int result = smear_actor_advance(actor, &play);
    if (result != SMEAR_OK)
        return result;
    smear_begin(ctx, &frame);
    smear_actor_submit(actor, ctx);
    return smear_render(ctx);
}
