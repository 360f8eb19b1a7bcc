/* SPDX-License-Identifier: MIT */
/* scene_cost.c - what smear_scene.h costs: a frame of 240x240 over a ground that fills its lower half, and by how much longer it
 * takes with a sky, a round shadow, and the shadow of a ball of 96 triangles on the ground; of these, how many pixels they darken. In
 * the units of platform.h's clock. */
#include "tests/target/cost.h"

#include "smear_math.h"
#include "smear_scene.h"

enum { AROUND = 8, RINGS = 6, CORNERS = AROUND * (RINGS + 1) };

enum extra { NOTHING, SKY, BLOB, PLANAR, EXTRAS };

static const char *const names[EXTRAS] = { "nothing ", "sky     ", "blob    ", "planar  " };

struct way {
    const char *name;
    smear_method method;
    int32_t turn;               /* of the camera from frame to frame, 2^-16 turns, up */
    int32_t step;               /* of what is shaded, 1/65536 unit, to the right */
};

static const struct way ways[] = { { "sharp", SMEAR_NONE, 0, 0 },
                                   { "draft, what has a shadow moves", SMEAR_AUTO, 0, ONE / 4 },
                                   { "draft, the camera turns", SMEAR_AUTO, 300, 0 } };

static const int16_t corner[] = { -200, 0, -200, -200, 0, 200, 200, 0, 200, 200, 0, -200 };
static const uint16_t side[] = { 0, 1, 2, 0, 2, 3 };
static const smear_mesh ground = { .position = corner, .index = side, .vertex_count = 4, .triangle_count = 2 };
static const smear_material paint = { .color = { 180, 170, 140, 255 }, .unlit = 1 };
static int16_t ball_corner[CORNERS * 3];
static uint16_t ball_side[AROUND * RINGS * 6];
static const smear_mesh ball = { .position = ball_corner, .index = ball_side, .vertex_count = CORNERS,
                                 .triangle_count = AROUND * RINGS * 2, .shift = 8 };

static uint16_t picture[2][WIDTH * WIDTH];
static uint16_t *shown;

static int keep(void *user, const smear_band *band)
{
    (void)user;
    const uint16_t *in = (const uint16_t *)band->pixels;
    for (int32_t i = 0; i < band->width * band->height; i++)
        shown[band->y * WIDTH + i] = in[i];
    smear_band_done(context);
    return 0;
}

static void make_ball(void)
{
    for (uint32_t i = 0; i < CORNERS; i++) {
        const uint32_t across = i % AROUND * (UINT32_MAX / AROUND), down = i / AROUND * (UINT32_MAX / 2 / RINGS);
        ball_corner[3 * i] = (int16_t)((smear_sin(across) >> 12) * (smear_sin(down) >> 12) >> 16);
        ball_corner[3 * i + 1] = (int16_t)(smear_cos(down) >> 16);
        ball_corner[3 * i + 2] = (int16_t)((smear_cos(across) >> 12) * (smear_sin(down) >> 12) >> 16);
    }
    for (uint32_t i = 0; i < AROUND * RINGS; i++) {
        const uint32_t next = i % AROUND == AROUND - 1 ? i + 1 - AROUND : i + 1;
        const uint32_t v[6] = { i, i + AROUND, next, next, i + AROUND, next + AROUND };
        for (int k = 0; k < 6; k++)
            ball_side[6 * i + (uint32_t)k] = (uint16_t)v[k];
    }
}

/* Returns what a frame takes with an extra; 0 where it fails. */
static uint32_t cost(const struct way *w, enum extra extra)
{
    const smear_desc desc = { .width = WIDTH, .height = WIDTH, .format = SMEAR_RGB565, .max_draws = 4, .max_triangles = 300,
                              .methods = (uint16_t)(SMEAR_SET(w->method) | (w->method == SMEAR_AUTO ? SMEAR_SET_SKETCH : 0)),
                              .flush = keep };
    smear_sky sky = SMEAR_SKY(0x3060b0, 0xc0d8f0, 0x708060, 0x303820);
    const smear_scene scene = { .sky = extra == SKY ? &sky : NULL };
    const smear_transform fall = smear_shadow_on(smear_vec(0, 0, 0), smear_vec(0, ONE, 0), smear_vec(ONE / 4, ONE, ONE / 4));
    uint32_t count = begin_context(&desc);
    for (int i = 0; i < FRAMES && count != 0; i++) {
        smear_camera eye = smear_perspective(SMEAR_DEGREES(50), ONE / 10, 0);
        eye.pose = smear_compose(smear_move(0, 2 * ONE, 8 * ONE), smear_rotate_x((uint32_t)(w->turn * (i - 1) - 2000) << 16));
        const smear_frame frame = { .camera = &eye, .method = (uint8_t)w->method, .clear = 0x203040, .target = SMEAR_DRAFT,
                                    .light_space = SMEAR_LIGHT_ENCODED, .scene = &scene, .shutter.path = SMEAR_PATH_LINE };
        const smear_vec3 thing = smear_vec(w->step * i, ONE, 0);
        const smear_transform place = extra == BLOB ? smear_blob_under(thing, 0, ONE)
                                                    : smear_compose(fall, smear_move(thing.x, thing.y, thing.z));
        const smear_draw draws[2] = { { .id = 1, .mesh = &ground, .material = &paint },
                                      { .id = 2, .mesh = extra == BLOB ? &smear_blob : &ball,
                                        .material = extra == BLOB ? &smear_blob_material : &smear_shadow_material, .now = &place } };
        count = draw_frame(&frame, draws, extra >= BLOB ? 2 : 1);
    }
    return count;
}

static bool report(const struct way *w)
{
    uint32_t bare = 0;
    platform_print(w->name);
    platform_print("\n");
    for (int i = 0; i < EXTRAS; i++) {
        shown = picture[i != NOTHING];
        const uint32_t count = cost(w, (enum extra)i);
        uint32_t other = 0;
        if (count == 0)
            return false;
        bare = i == NOTHING ? count : bare;
        for (int k = 0; i != NOTHING && k < WIDTH * WIDTH; k++)
            other += picture[0][k] != picture[1][k];
        platform_print("  ");
        platform_print(names[i]);
        print_decimal(i == NOTHING ? count : count - bare);
        platform_print(", pixels ");
        print_decimal(other);
        platform_print("\n");
    }
    return true;
}

int main(int argc, char **argv)
{
    (void)argc;
    (void)argv;
    bool done = true;
    make_ball();
    begin_report(" per frame of 240x240, and by how much more with what a scene has\n");
    for (size_t i = 0; i < sizeof ways / sizeof *ways; i++)
        done = report(&ways[i]) && done;
    return done ? 0 : 1;
}
