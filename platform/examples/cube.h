/* SPDX-License-Identifier: MIT */
/* cube.h - a cube that flies past, blurred, on the display of display.h: what all examples draw. C99 or C++11. */
#include <smear.h>
#include <smear_math.h>

static smear_context *ctx;
#include "display.h"            /* SCREEN_WIDTH, _HEIGHT, _FORMAT; where two: _BANDS, _WORKERS; display_begin(), display_workers() */
#ifndef SCREEN_BANDS
#define SCREEN_BANDS 1
#endif
#ifndef SCREEN_WORKERS
#define SCREEN_WORKERS 1
#endif

/* For 32 triangles and 4 draws. */
static uint64_t memory[SMEAR_MEMORY(SCREEN_WIDTH, SCREEN_HEIGHT, 32, 4, SCREEN_FORMAT)
                       + (SCREEN_BANDS - 1) * SMEAR_MEMORY_BAND(SCREEN_WIDTH, SCREEN_HEIGHT, SCREEN_FORMAT)
                       + (SCREEN_WORKERS - 1) * SMEAR_MEMORY_WORKER(SCREEN_WIDTH, SCREEN_HEIGHT)];
static const int16_t corner[] = { -1, -1, -1,  1, -1, -1,  1, 1, -1,  -1, 1, -1,  -1, -1, 1,  1, -1, 1,  1, 1, 1,  -1, 1, 1 };
static const uint16_t side[] = {                /* counter-clockwise seen from outside */
    4, 5, 6,  4, 6, 7,  1, 0, 3,  1, 3, 2,  5, 1, 2,  5, 2, 6,  0, 4, 7,  0, 7, 3,  7, 6, 2,  7, 2, 3,  0, 1, 5,  0, 5, 4
};
static smear_desc desc;                         /* all zero: the default of every field */
static smear_mesh cube;
static smear_camera camera;
static smear_frame frame;
static smear_draw draw;

/* Once: the display, then the library. Returns SMEAR_OK or what smear_error_text() explains. */
static int cube_begin(void)
{
    desc.width = SCREEN_WIDTH;
    desc.height = SCREEN_HEIGHT;
    desc.max_triangles = 32;
    desc.max_draws = 4;
    desc.format = SCREEN_FORMAT;
    desc.bands = SCREEN_BANDS;
    desc.workers = SCREEN_WORKERS;
    display_begin(&desc);
    cube.position = corner;
    cube.vertex_count = 8;
    cube.index = side;
    cube.triangle_count = 12;
    camera = smear_perspective(SMEAR_DEGREES(50), SMEAR_Q16(0.5), 0);
    frame.camera = &camera;
    frame.clear = 0x203040;
    draw.id = 1;
    draw.mesh = &cube;
    const int result = smear_init(&ctx, &desc, memory, sizeof memory);
#if SCREEN_WORKERS > 1
    if (result == SMEAR_OK)
        display_workers();
#endif
    return result;
}

/* Draws one frame: from left to right in 20 frames, turning. */
static int cube_frame(void)
{
    static int number;
    smear_transform pose = smear_move((number - 10) * SMEAR_Q16(0.4), 0, SMEAR_Q16(-6));
    pose = smear_compose(pose, smear_rotate_y(number * SMEAR_DEGREES(18)));
    draw.now = &pose;
    number = (number + 1) % 20;
    smear_begin(ctx, &frame);
    smear_submit(ctx, &draw);
    return smear_render(ctx);
}
