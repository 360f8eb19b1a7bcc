/* SPDX-License-Identifier: MIT */
/* 7-scene.c - a chrome ball that bounces, and a red one that circles it, under a sky.
 * What is new: a sky; shadows, that of a mesh and a round, soft one; a polished surface, which shows a picture of what is around it. */
#include "panel.h"
#include <smear_math.h>
#include <smear_matcap.h>
#include <smear_scene.h>

enum { RINGS = 10, SECTORS = 20, VERTICES = 11 * 21, BALL = 2 * RINGS * SECTORS, TRIANGLES = 3 * BALL + 4, CHROME = 64, F = 1 << 14 };

static uint64_t memory[SMEAR_MEMORY(PANEL_WIDTH, PANEL_HEIGHT, TRIANGLES, 5)];
static const int16_t floor_corner[] = { -F, 0, -F, -F, 0, F, F, 0, F, F, 0, -F }, floor_uv[] = { 0, 0, 0, F, F, F, F, 0 };
static const uint16_t floor_side[] = { 0, 1, 2, 0, 2, 3 }, check[4] = { 0xb596, 0x738e, 0x738e, 0xb596 };
static const smear_texture checks = { check, NULL, 2, 2, SMEAR_TEXEL_565, SMEAR_REPEAT, SMEAR_REPEAT, 0 };
static int16_t ball_corner[VERTICES * 3], ball_uv[VERTICES * 2];
static uint16_t ball_side[BALL * 3], reflected[CHROME * CHROME];
static int8_t ball_normal[VERTICES * 3];
static const smear_texture chrome = { reflected, NULL, CHROME, CHROME, SMEAR_TEXEL_565, SMEAR_CLAMP, SMEAR_CLAMP, 0 };
static const smear_mesh ball = { ball_corner, ball_normal, ball_uv, NULL, NULL, ball_side, BALL, VERTICES, 14, 15, 1, { 0, 0, 0 }, { 0 } };
static const smear_mesh ground = { floor_corner, NULL, floor_uv, NULL, NULL, floor_side, 2, 4, 11, 12, 1, { 0, 0, 0 }, { 0 } };
static const smear_material polished = { &chrome, { 0 }, SMEAR_OPAQUE, 0, 1, 0, 0, 0, 0 };       /* unlit */
static const smear_material tiled = { &checks, { 0 }, SMEAR_OPAQUE, 0, 0, 0, 0, 0, 0 };
static const smear_material red = { NULL, { 220, 0, 0, 255 }, SMEAR_OPAQUE, 0, 0, 0, 0, 0, 0 };
static smear_sky sky = SMEAR_SKY(0x2858b0, 0xc8dcf4, 0xb0a890, 0x706858);       /* up, above and below the horizon, down */
static smear_scene scene;
static smear_desc desc;
static smear_frame frame;
static smear_draw draw;

static void make_ball(void)
{
    for (int i = 0; i < VERTICES; i++) {
        const smear_transform t = smear_from_euler((uint32_t)(i % 21) * SMEAR_TURNS(1.0 / SECTORS),
                                                   (uint32_t)(i / 21) * SMEAR_TURNS(0.5 / RINGS) - SMEAR_TURNS(0.25), 0);
        for (int k = 0; k < 3; k++)             /* its z */
            ball_corner[3 * i + k] = (int16_t)(t.basis[3 * k + 2] / 1024), ball_normal[3 * i + k] = (int8_t)(t.basis[3 * k + 2] / 132104);
    }
    for (int i = 0; i < 3 * BALL; i++) {        /* two triangles of each field */
        static const uint8_t corner[6] = { 0, 21, 22, 0, 22, 1 };
        ball_side[i] = (uint16_t)(i / 6 / SECTORS * 21 + i / 6 % SECTORS + corner[i % 6]);
    }
    for (int i = 0; i < CHROME * CHROME; i++) {         /* a ball that reflects a sky with the sun, and a floor */
        const int x = i % CHROME - 41, y = CHROME / 2 - i / CHROME, tone = y > 0 ? 30 - y * 3 / 4 : y > -4 ? 6 : 8 - y / 4;
        reflected[i] = x * x + (y - 18) * (y - 18) < 14 ? 0xffff : (uint16_t)(tone << 11 | tone << 6 | (y > 0 ? tone / 2 + 15 : tone));
    }
}

static void submit(smear_context *ctx, uint32_t id, const smear_mesh *mesh, const smear_material *material, smear_transform now)
{
    draw.id = id, draw.mesh = mesh, draw.material = material, draw.now = &now;
    smear_submit(ctx, &draw);
}

int main(void)
{
    const smear_vec3 sun = smear_vec(5898, 13107, 7864), up = smear_vec(0, 1, 0), floor = smear_vec(0, 0, 0);
    smear_context *ctx;
    smear_camera camera = smear_perspective(SMEAR_DEGREES(45), SMEAR_Q16(0.5), 0);
    desc.width = PANEL_WIDTH, desc.height = PANEL_HEIGHT, desc.max_triangles = TRIANGLES, desc.max_draws = 5;
    desc.format = SMEAR_RGB565_SWAPPED, desc.flush = panel_flush;
    int result = smear_init(&ctx, &desc, memory, sizeof memory);
    make_ball();
    camera.pose = smear_look_at(smear_vec(SMEAR_Q16(-1), SMEAR_Q16(2), SMEAR_Q16(6)), smear_vec(0, SMEAR_Q16(0.9), 0), up);
    scene.sky = &sky, frame.scene = &scene, frame.camera = &camera, frame.target = SMEAR_DRAFT;
    for (int n = 0; result == SMEAR_OK && panel_next(n); n++) {
        const smear_transform bounce = smear_move(0, SMEAR_Q16(2.8) - (n % 24 - 12) * (n % 24 - 12) * SMEAR_Q16(0.0125), 0);
        smear_transform orbit = smear_scale(SMEAR_Q24(0.4), SMEAR_Q24(0.4), SMEAR_Q24(0.4));
        orbit.origin[0] = SMEAR_Q16(2), orbit.origin[1] = SMEAR_Q16(0.7);
        orbit = smear_compose(smear_rotate_y((uint32_t)n * SMEAR_DEGREES(10)), orbit);
        smear_begin(ctx, &frame);
        submit(ctx, 0, &ground, &tiled, smear_move(0, 0, 0));
        smear_matcap_uv(ball_uv, &ball, &bounce, &camera), submit(ctx, 1, &ball, &polished, bounce);
        submit(ctx, 2, &ball, &red, orbit);
        submit(ctx, 3, &ball, &smear_shadow_material, smear_compose(smear_shadow_on(floor, up, sun), bounce));
        submit(ctx, 4, &smear_blob, &smear_blob_material, smear_blob_under(smear_apply(orbit, floor), 0, SMEAR_Q16(0.5)));
        result = smear_render(ctx);
    }
    return result != SMEAR_OK;
}
