/* SPDX-License-Identifier: MIT */
/* 2-camera.c - a camera that flies around towers on a chequered ground, in fog.
 *
 * What is new: colours of faces; one mesh in many places; a camera that looks at a point. Nothing moves but the camera, and all
 * is blurred, what is near more than what is far. */
#include "panel.h"

#include <smear_math.h>

enum { TILES = 12, GROUND = 2 * TILES * TILES, TOWERS = 8, TRIANGLES = GROUND + 12 * TOWERS, DRAWS = TOWERS + 1 };

static uint64_t memory[SMEAR_MEMORY_SKETCH(PANEL_WIDTH, PANEL_HEIGHT, TRIANGLES, DRAWS)];

static int16_t ground_corner[(TILES + 1) * (TILES + 1) * 3];
static uint16_t ground_side[GROUND * 3];
static uint8_t ground_color[GROUND * 4];
static const int16_t tower_corner[] = { -1, 0, -1, 1, 0, -1, 1, 5, -1, -1, 5, -1, -1, 0, 1, 1, 0, 1, 1, 5, 1, -1, 5, 1 };
static const uint16_t tower_side[] = {
    4, 5, 6, 4, 6, 7, 1, 0, 3, 1, 3, 2, 5, 1, 2, 5, 2, 6, 0, 4, 7, 0, 7, 3, 7, 6, 2, 7, 2, 3, 0, 1, 5, 0, 5, 4
};
static smear_desc desc;
static smear_mesh ground, tower;
static smear_material paint[TOWERS];
static smear_frame frame;
static smear_fog fog;
static smear_draw draw;                         /* without an id: it stands still */

static void make_ground(void)
{
    for (int i = 0; i < (TILES + 1) * (TILES + 1); i++) {
        ground_corner[3 * i] = (int16_t)(i % (TILES + 1) - TILES / 2);
        ground_corner[3 * i + 2] = (int16_t)(i / (TILES + 1) - TILES / 2);
    }
    for (int i = 0; i < TILES * TILES; i++) {
        const int a = i / TILES * (TILES + 1) + i % TILES, corner[6] = { 0, TILES + 1, TILES + 2, 0, TILES + 2, 1 };
        for (int k = 0; k < 6; k++)
            ground_side[6 * i + k] = (uint16_t)(a + corner[k]);
        for (int k = 0; k < 8; k++)             /* of both triangles r g b a */
            ground_color[8 * i + k] = k % 4 == 3 ? 255 : (i / TILES + i) % 2 ? 90 : 200;
    }
    ground.position = ground_corner, ground.vertex_count = (TILES + 1) * (TILES + 1), ground.index = ground_side;
    ground.triangle_count = GROUND, ground.face_color = ground_color, ground.scale = 3;     /* metres a tile */
}

int main(void)
{
    smear_context *ctx;
    smear_camera camera = smear_perspective(SMEAR_DEGREES(60), SMEAR_Q16(0.5), 0);
    desc.width = PANEL_WIDTH, desc.height = PANEL_HEIGHT, desc.max_triangles = TRIANGLES, desc.max_draws = DRAWS;
    desc.format = SMEAR_RGB565_SWAPPED, desc.flush = panel_flush;
    desc.methods = SMEAR_SET(SMEAR_AUTO) | SMEAR_SET_SKETCH, frame.target = SMEAR_SKETCH;
    int result = smear_init(&ctx, &desc, memory, sizeof memory);
    make_ground();
    tower.position = tower_corner, tower.vertex_count = 8, tower.index = tower_side, tower.triangle_count = 12;
    fog.color = frame.clear = 0xa0b8d0, fog.near_plane = SMEAR_Q16(8), fog.far_plane = SMEAR_Q16(30);
    for (int i = 0; i < TOWERS; i++)
        paint[i].color[i % 3] = 220, paint[i].color[(i + 1) % 3] = (uint8_t)(60 + 20 * i), paint[i].color[3] = 255;
    frame.camera = &camera, frame.fog = &fog, frame.light_space = SMEAR_LIGHT_ENCODED;

    uint32_t angle = SMEAR_DEGREES(25);
    for (int n = 0; result == SMEAR_OK && panel_next(n); n++, angle += SMEAR_DEGREES(3)) {
        smear_vec3 eye = smear_vec(smear_sin(angle) / 14, SMEAR_Q16(5), smear_cos(angle) / 14);        /* q24: 18 metres */
        camera.pose = smear_look_at(eye, smear_vec(0, SMEAR_Q16(1.5), 0), smear_vec(0, 1, 0));
        smear_begin(ctx, &frame);
        draw.mesh = &ground, draw.material = NULL, draw.now = NULL;     /* white, where it was made */
        smear_submit(ctx, &draw);
        for (int i = 0; i < TOWERS; i++) {
            smear_transform place = smear_compose(smear_rotate_y((uint32_t)i * SMEAR_TURNS(1.0 / TOWERS)), smear_move(0, 0, SMEAR_Q16(9)));
            draw.mesh = &tower, draw.material = &paint[i], draw.now = &place;
            smear_submit(ctx, &draw);           /* copies what `place` is */
        }
        result = smear_render(ctx);
    }
    return result != SMEAR_OK;
}
