/* SPDX-License-Identifier: MIT */
/* coins.c - a platform game: the hero jumps from one platform to the next through turning coins. */
#include "tools/demo/dioramas.h"

#include "tools/scenes/demo.h"

#include <math.h>

#define PI 3.14159265358979323846

enum { HERO, PLATFORM, WIDE, FALLING, COIN, GRASS, CLOUD, FLAG, BRICK, BLOCK, FILES };

static const struct diorama_file files[FILES] = {
    [HERO] = { "kenney-platformer/character.glb", "jump" },
    [PLATFORM] = { "kenney-platformer/platform.glb", NULL },
    [WIDE] = { "kenney-platformer/platform-medium.glb", NULL },
    [FALLING] = { "kenney-platformer/platform-falling.glb", NULL },
    [COIN] = { "kenney-platformer/coin.glb", NULL },
    [GRASS] = { "kenney-platformer/grass.glb", NULL },
    [CLOUD] = { "kenney-platformer/cloud.glb", NULL },
    [FLAG] = { "kenney-platformer/flag.glb", NULL },
    [BRICK] = { "kenney-platformer/brick.glb", NULL },
    [BLOCK] = { "kenney-platformer/block-coin.glb", NULL },
};

/* What stands still, or only turns or falls. */
static const struct item {
    int file;
    double x, y, z, turn, size;
} item[] = {
    { WIDE, -2.9, -0.55, 0.0, 0.0, 1.0 },    { PLATFORM, 1.9, -0.15, 0.0, 0.0, 1.0 },
    { FALLING, 4.9, 0.2, -0.6, 0.3, 1.0 },   { GRASS, -3.7, 0.0, 0.7, 0.4, 1.2 },
    { GRASS, -1.9, 0.0, -0.9, 2.0, 1.0 },    { FLAG, -3.9, 0.0, -0.8, -0.5, 1.4 },
    { GRASS, 2.5, 0.40, 0.5, 1.0, 0.9 },     { COIN, 0.45, 1.95, 0.0, 0.0, 1.2 },
    { COIN, 1.1, 1.65, 0.0, 0.7, 1.2 },      { COIN, 1.6, 1.15, 0.0, 1.4, 1.2 },
    { COIN, 2.2, 0.60, 0.0, 2.1, 1.2 },      { BLOCK, 4.0, 2.2, -2.4, 0.0, 0.9 },
    { BRICK, 3.1, 2.2, -2.4, 0.0, 0.9 },     { BRICK, 4.9, 2.2, -2.4, 0.0, 0.9 },
    { CLOUD, -6.5, 2.2, -9.0, 0.5, 1.8 },    { CLOUD, -5.4, 2.0, -9.4, 1.2, 1.4 },
    { CLOUD, 2.9, 4.6, -10.0, 0.2, 1.8 },    { CLOUD, 4.2, 4.4, -10.3, 1.0, 1.4 },
};
enum { ITEMS = sizeof item / sizeof *item };

static int file_of(int actor)
{
    return actor == 0 ? HERO : item[actor - 1].file;
}

#define HERO_SIZE 1.15
#define LOOP_SECONDS 1.6
#define JUMP_SECONDS 0.5        /* of it in the air, from the first platform to the second */

/* From (-2.3, 0) to (1.7, 0.4) on a parabola. */
static struct vec3 hero_at(double time)
{
    double lap = time / LOOP_SECONDS, t = (lap - floor(lap)) * LOOP_SECONDS / JUMP_SECONDS;
    t = fmin(t, 1);
    return vec3(-2.3 + 4.0 * t, 0.4 * t + 4 * 1.35 * t * (1 - t), 0);
}

static void place(double time, struct diorama_place *place)
{
    double lap = floor(time / LOOP_SECONDS), t = time - lap * LOOP_SECONDS;
    struct vec3 hero = hero_at(time);
    double lean = t < JUMP_SECONDS ? 0.25 * cos(PI * t / JUMP_SECONDS) : 0;
    struct xform at = xform_mul(xform_move(hero.x, hero.y, hero.z), xform_turn_z(lean));
    at = xform_mul(at, xform_scale(HERO_SIZE, HERO_SIZE, HERO_SIZE));
    place[0].world = xform_mul(at, xform_turn_y(0.28 * PI));
    place[0].clip_time = t;
    place[0].epoch = (int)fmod(lap, 1000);
    for (int i = 0; i < ITEMS; i++) {
        const struct item *it = &item[i];
        double turn = it->turn, y = it->y;
        if (it->file == COIN)
            turn += 2 * PI * 4 * time / LOOP_SECONDS;
        if (it->file == FALLING)
            y -= 2.6 * t * t;
        struct xform world = xform_mul(xform_move(it->x, y, it->z), xform_turn_y(turn));
        place[i + 1].world = xform_mul(world, xform_scale(it->size, it->size, it->size));
        place[i + 1].epoch = it->file == FALLING ? (int)fmod(lap, 1000) : 0;
    }
}

static void build_set(struct stage *stage)
{
    int *backdrop = stage_alloc(stage, sizeof *backdrop);
    if (backdrop == NULL)
        return;
    stage->extra = backdrop;
    *backdrop = demo_backdrop(stage);
}

static void move_set(const struct stage *stage, double time, struct scene_instant *out)
{
    const int *backdrop = stage->extra;
    struct vec3 eye = vec3(0.5, 1.9, 6.3);
    (void)time;
    stage_camera(out, xform_look(eye, vec3(0.0, 1.0, 0), vec3(0, 1, 0)), 44);
    out->camera.znear = 1;
    out->camera.zfar = 140;
    stage_place(out, *backdrop, xform_move(eye.x, -5, eye.z));
}

static const struct stage_kind stage = { "coins", 320, 240, 0.2, 0x9fd0ee, build_set, move_set };
const struct diorama_kind diorama_coins = { &stage, files, FILES, ITEMS + 1, file_of, place };
