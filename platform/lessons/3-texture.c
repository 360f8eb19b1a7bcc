/* SPDX-License-Identifier: MIT */
/* 3-texture.c - a ball of glazed bricks that rolls under a low sun, and a smaller one around it.
 *
 * What is new: normals, which make flat triangles round; places in a texture; a light of one's own. Meshes and textures come
 * from tables, which may stay in flash, or are made at the start, as here. */
#include "panel.h"

#include <smear_math.h>

enum { RINGS = 8, SECTORS = 16, VERTICES = (RINGS + 1) * (SECTORS + 1), BALL = 2 * RINGS * SECTORS, TRIANGLES = 2 * BALL, DRAWS = 2 };

static uint64_t memory[SMEAR_MEMORY(PANEL_WIDTH, PANEL_HEIGHT, TRIANGLES, DRAWS)];

static int16_t position[VERTICES * 3], place_in_texture[VERTICES * 2];
static int8_t normal[VERTICES * 3];
static uint16_t side[BALL * 3], texel[16 * 16];
static smear_desc desc;
static smear_texture bricks;
static smear_mesh ball;
static smear_material glazed;
static smear_frame frame;
static smear_light sun = { { 3, 3, 2 }, { 14000, 15000, 22000 }, { 52000, 48000, 40000 } };     /* from, everywhere, its own */
static smear_draw draw;

static void make_ball(void)
{
    for (int i = 0; i < VERTICES; i++) {
        const int ring = i / (SECTORS + 1), sector = i % (SECTORS + 1);
        const uint32_t down = (uint32_t)ring * SMEAR_TURNS(0.5 / RINGS), around = (uint32_t)sector * SMEAR_TURNS(1.0 / SECTORS);
        const int32_t wide = smear_sin(down) >> 10;     /* q24 to q14 */
        const int32_t at[3] = { wide * (smear_sin(around) >> 10) >> 14, smear_cos(down) >> 10, wide * (smear_cos(around) >> 10) >> 14 };
        for (int k = 0; k < 3; k++)
            position[3 * i + k] = (int16_t)at[k], normal[3 * i + k] = (int8_t)(at[k] * 127 >> 14);
        place_in_texture[2 * i] = (int16_t)(sector * 4 * 4096 / SECTORS), place_in_texture[2 * i + 1] = (int16_t)(ring * 2 * 4096 / RINGS);
    }
    for (int i = 0; i < BALL; i++) {            /* two triangles of each field, from its corner */
        const int a = i / 2 / SECTORS * (SECTORS + 1) + i / 2 % SECTORS, b = a + SECTORS + 2;
        side[3 * i] = (uint16_t)a, side[3 * i + 1] = (uint16_t)(i % 2 ? b : b - 1), side[3 * i + 2] = (uint16_t)(i % 2 ? a + 1 : b);
    }
    for (int i = 0; i < 16 * 16; i++) {         /* RGB565: four rows of bricks, every second half a brick aside */
        const int x = i % 16, y = i / 16, joint = y % 4 == 0 || (x + y / 4 % 2 * 4) % 8 == 0;
        texel[i] = joint ? 0xce59 : (uint16_t)(0xb186 + ((x + y / 4 % 2 * 4) / 8 + y / 4) % 3 * 0x1041);
    }
    bricks.texels = texel, bricks.width = bricks.height = 16, bricks.format = SMEAR_TEXEL_565;      /* repeats */
    ball.position = position, ball.normal = normal, ball.uv = place_in_texture, ball.uv_shift = 12, ball.shift = 14;
    ball.vertex_count = VERTICES, ball.index = side, ball.triangle_count = BALL;
    glazed.texture = &bricks;
}

int main(void)
{
    smear_context *ctx;
    smear_camera camera = smear_perspective(SMEAR_DEGREES(40), SMEAR_Q16(0.5), 0);
    desc.width = PANEL_WIDTH, desc.height = PANEL_HEIGHT, desc.max_triangles = TRIANGLES, desc.max_draws = DRAWS;
    desc.format = SMEAR_RGB565_SWAPPED, desc.flush = panel_flush;
    int result = smear_init(&ctx, &desc, memory, sizeof memory);
    make_ball();
    camera.pose = smear_move(0, 0, SMEAR_Q16(6));       /* looks along its own -z */
    frame.camera = &camera, frame.light = &sun, frame.clear = 0x182430, frame.light_space = SMEAR_LIGHT_ENCODED;
    frame.target = SMEAR_DRAFT;
    draw.mesh = &ball, draw.material = &glazed;

    uint32_t turn = 0;
    for (int n = 0; result == SMEAR_OK && panel_next(n); n++, turn += SMEAR_DEGREES(3)) {
        smear_transform roll = smear_compose(smear_move((n - 32) * SMEAR_Q16(0.06), 0, 0), smear_rotate_z(0u - turn));
        smear_transform orbit = smear_compose(smear_rotate_y(4 * turn), smear_move(SMEAR_Q16(1.4), SMEAR_Q16(0.5), 0));
        orbit = smear_compose(orbit, smear_scale(SMEAR_Q24(0.25), SMEAR_Q24(0.25), SMEAR_Q24(0.25)));
        smear_begin(ctx, &frame);
        draw.id = 1, draw.now = &roll, smear_submit(ctx, &draw);
        draw.id = 2, draw.now = &orbit, smear_submit(ctx, &draw);
        result = smear_render(ctx);
    }
    return result != SMEAR_OK;
}
