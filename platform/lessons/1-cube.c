/* SPDX-License-Identifier: MIT */
/* 1-cube.c - a cube that flies to the right and turns.
 *
 * What there is in each program: memory, which you give; a mesh, corners and triangles; a camera; and a loop of frames. The
 * library remembers where draw number 1 was a frame ago, and blurs it. */
#include "panel.h"

#include <smear_math.h>

enum { TRIANGLES = 12, DRAWS = 1 };

static uint64_t memory[SMEAR_MEMORY(PANEL_WIDTH, PANEL_HEIGHT, TRIANGLES, DRAWS)];

static const int16_t corner[] = { -1, -1, -1, 1, -1, -1, 1, 1, -1, -1, 1, -1, -1, -1, 1, 1, -1, 1, 1, 1, 1, -1, 1, 1 };
static const uint16_t side[] = {                /* three corners of each triangle, counter-clockwise from outside */
    4, 5, 6, 4, 6, 7, 1, 0, 3, 1, 3, 2, 5, 1, 2, 5, 2, 6, 0, 4, 7, 0, 7, 3, 7, 6, 2, 7, 2, 3, 0, 1, 5, 0, 5, 4
};
static smear_desc desc;                         /* static, so zero: every field's default */
static smear_mesh cube;
static smear_material orange;
static smear_frame frame;
static smear_draw draw;

int main(void)
{
    smear_context *ctx;
    desc.width = PANEL_WIDTH, desc.height = PANEL_HEIGHT, desc.max_triangles = TRIANGLES, desc.max_draws = DRAWS;
    desc.format = SMEAR_RGB565_SWAPPED, desc.flush = panel_flush;
    int result = smear_init(&ctx, &desc, memory, sizeof memory);

    cube.position = corner, cube.vertex_count = 8, cube.index = side, cube.triangle_count = TRIANGLES;
    orange.color[0] = 255, orange.color[1] = 140, orange.color[2] = 30, orange.color[3] = 255;      /* r g b, opaque */
    draw.id = 1, draw.mesh = &cube, draw.material = &orange;

    smear_camera camera = smear_perspective(SMEAR_DEGREES(50), SMEAR_Q16(0.5), 0);  /* its angle, near plane, no far one */
    frame.camera = &camera, frame.clear = 0x203040;
    frame.light_space = SMEAR_LIGHT_ENCODED;    /* cheaper than linear light, and on small displays as good */

    uint32_t turn = 0;
    for (int n = 0; result == SMEAR_OK && panel_next(n); n++, turn += SMEAR_DEGREES(5)) {
        smear_transform place = smear_move((n - 30) * SMEAR_Q16(0.4), 0, SMEAR_Q16(-6));       /* metres */
        smear_transform pose = smear_compose(place, smear_rotate_y(turn));
        draw.now = &pose;
        smear_begin(ctx, &frame);
        smear_submit(ctx, &draw);
        result = smear_render(ctx);             /* calls panel_flush */
    }
    return result != SMEAR_OK;
}
