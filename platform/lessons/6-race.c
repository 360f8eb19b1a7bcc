/* SPDX-License-Identifier: MIT */
/* 6-race.c - a road with bends, your car, and two rivals: platform/game in small.
 * What is new is how it comes together: a world that is made once, things that move in it, and a camera that follows. */
#include "panel.h"

#include <smear_math.h>
#include <smear_overlay.h>

enum { STEPS = 60, STEP = 6, BEND = 120, CORNERS = 4 * (STEPS + 1), ROAD = 6 * STEPS, CARS = 3, TRIANGLES = ROAD + 24 * CARS };

static uint64_t memory[SMEAR_MEMORY_SKETCH(PANEL_WIDTH, PANEL_HEIGHT, TRIANGLES, CARS + 1)];
static const int16_t car_corner[] = { -14, 3, -34,              /* 16ths of a metre: a body and a cabin */
    14, 3, -34, 14, 10, -34, -14, 10, -34, -14, 3, 34, 14, 3, 34, 14, 15, 34, -14, 15, 34, -11, 10, -12,
    11, 10, -12, 8, 21, 2, -8, 21, 2, -11, 10, 26, 11, 10, 26, 8, 21, 20, -8, 21, 20 };
static const uint16_t car_side[] = {
    4, 5, 6, 4, 6, 7, 1, 0, 3, 1, 3, 2, 5, 1, 2, 5, 2, 6, 0, 4, 7, 0, 7, 3, 7, 6, 2, 7, 2, 3, 0, 1, 5, 0, 5, 4,
    12, 13, 14, 12, 14, 15, 9, 8, 11, 9, 11, 10, 13, 9, 10, 13, 10, 14, 8, 12, 15, 8, 15, 11, 15, 14, 10, 15, 10, 11, 8, 9, 13, 8, 13, 12 };
static int16_t road_corner[3 * CORNERS];
static uint16_t road_side[3 * ROAD];
static uint8_t road_color[4 * ROAD];
static smear_overlay_item item;
static const smear_overlay overlay = { &item, 1, NULL };
static smear_desc desc;
static smear_mesh road, car;
static smear_material paint[CARS];
static smear_frame frame;
static smear_draw draw;

/* Where one is `along` the road and `aside` of its middle, q16 metres, and turned as it goes: 8 metres to and fro in each bend. */
static smear_transform place(int32_t along, int32_t aside)
{
    const uint32_t angle = (uint32_t)(along / BEND) << 16;
    const smear_transform at = smear_move(smear_sin(angle) / 32 + aside, 0, -along);       /* q24 to 8 metres in q16 */
    return smear_compose(at, smear_rotate_y(0u - (uint32_t)(smear_cos(angle) / BEND * 8) * 256));       /* slope / 2 pi, in turns */
}

static void make_road(void)
{
    static const int16_t aside[4] = { -960, -80, 80, 960 }, field[6] = { 0, 1, 5, 0, 5, 4 };     /* grass, road, grass; corners */
    static const uint8_t color[2][2][3] = { { { 50, 100, 40 }, { 50, 140, 40 } }, { { 80, 80, 86 }, { 104, 104, 110 } } };
    for (int i = 0; i < CORNERS; i++) {
        const smear_transform at = place(i / 4 * STEP * 65536, 0);
        road_corner[3 * i] = (int16_t)(at.origin[0] / 4096 + aside[i % 4]), road_corner[3 * i + 2] = (int16_t)(at.origin[2] / 4096);
    }
    for (int i = 0; i < 3 * ROAD; i++) {        /* six corners in each field, three fields in each step */
        road_side[i] = (uint16_t)(i / 18 * 4 + i / 6 % 3 + field[i % 6]);
        road_color[i / 3 * 4 + i % 3] = color[i / 6 % 3 == 1][i / 18 % 2][i % 3], road_color[i / 3 * 4 + 3] = 255;
    }
    road.position = road_corner, road.vertex_count = CORNERS, road.index = road_side, road.triangle_count = ROAD;
    car.position = car_corner, car.vertex_count = 16, car.index = car_side, car.triangle_count = 24;
    road.face_color = road_color, road.shift = car.shift = 4;
}

int main(void)
{
    smear_context *ctx;
    smear_camera camera = smear_perspective(SMEAR_DEGREES(60), SMEAR_Q16(0.5), 0);
    desc.width = PANEL_WIDTH, desc.height = PANEL_HEIGHT, desc.max_triangles = TRIANGLES, desc.max_draws = CARS + 1;
    desc.format = SMEAR_RGB565_SWAPPED, desc.flush = panel_flush, desc.methods = SMEAR_SET(SMEAR_AUTO) | SMEAR_SET_SKETCH;
    int result = smear_init(&ctx, &desc, memory, sizeof memory);
    make_road();
    item.x = 8, item.y = 8, item.text = "LAP 1  190 KM/H", item.font = &smear_font_8x8, frame.overlay = &overlay;
    frame.camera = &camera, frame.clear = 0x88b8e8, frame.light_space = SMEAR_LIGHT_ENCODED, frame.target = SMEAR_SKETCH;

    for (int32_t n = 0; result == SMEAR_OK && panel_next(n); n++) {
        const int32_t along = n * SMEAR_Q16(1.75) + SMEAR_Q16(9);       /* metres: 190 km/h are 1.75 in a frame */
        camera.pose = smear_compose(place(along - SMEAR_Q16(7), SMEAR_Q16(-1)), smear_move(0, SMEAR_Q16(2.4), 0));
        camera.pose = smear_compose(camera.pose, smear_rotate_x(SMEAR_DEGREES(-6)));
        smear_begin(ctx, &frame);
        draw.id = 0, draw.mesh = &road, draw.material = NULL, draw.now = NULL, smear_submit(ctx, &draw);
        for (int i = 0; i < CARS; i++) {
            const smear_transform pose = place(along + i * (SMEAR_Q16(9) - n * SMEAR_Q16(0.1)), (i - 1) * SMEAR_Q16(2.5));
            paint[i].color[i] = paint[i].color[3] = 255, paint[i].color[(i + 1) % 3] = 120;
            draw.id = (uint32_t)i + 1, draw.mesh = &car, draw.material = &paint[i], draw.now = &pose, smear_submit(ctx, &draw);
        }
        result = smear_render(ctx);
    }
    return result != SMEAR_OK;
}
