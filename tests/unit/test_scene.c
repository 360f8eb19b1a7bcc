/* SPDX-License-Identifier: MIT */
/* test_scene.c - a sky over a ground with a round shadow and that of a wedge, before a camera that turns: the same bits on every
 * machine. Needs neither libc nor floating point. */
#include "tests/test.h"

#include <smear_math.h>
#include <smear_scene.h>

enum { WIDTH = 80, HEIGHT = 60, ONE = 1 << 16 };

static uint64_t memory[8000];

static const int16_t ground_place[] = { -99, 0, -99, -99, 0, 99, 99, 0, 99, 99, 0, -99 };
static const uint16_t ground_side[] = { 0, 1, 2, 0, 2, 3 };
static const smear_mesh ground = { .position = ground_place, .index = ground_side, .vertex_count = 4, .triangle_count = 2 };
static const smear_material paint = { .color = { 180, 170, 140, 255 }, .unlit = 1 };
static const int16_t wedge_place[] = { -90, -90, 90, 90, -90, 90, 0, 90, 0, 0, -90, -90 };
static const uint16_t wedge_side[] = { 0, 1, 2, 1, 3, 2, 3, 0, 2, 0, 3, 1 };
static const smear_mesh wedge = { .position = wedge_place, .index = wedge_side, .vertex_count = 4, .triangle_count = 4, .shift = 7 };

static int swallow(void *user, const smear_band *band)
{
    (void)user;
    (void)band;
    return 0;
}

/* Returns the sum of the third frame, or 0. */
static uint32_t sum_of(smear_method method, smear_light_space space, smear_format format, uint16_t target, uint32_t roll)
{
    smear_desc desc = { .width = WIDTH, .height = HEIGHT, .format = (uint8_t)format, .max_draws = 4, .max_triangles = 64,
                        .debug = { .crc = 1 }, .flush = swallow };
    const smear_transform fall = smear_shadow_on(smear_vec(0, 0, 0), smear_vec(0, 1, 0), smear_vec(ONE / 2, ONE, ONE / 4));
    smear_sky sky = SMEAR_SKY(0x3060b0, 0xc0d8f0, 0x708060, 0x303820);
    const smear_scene scene = { .sky = &sky };
    smear_stats stats = { 0 };
    smear_context *ctx;
    desc.methods = (uint16_t)(SMEAR_SET(method) | (target != 0 ? SMEAR_SET_SKETCH : 0));
    if (smear_init(&ctx, &desc, memory, sizeof memory) != SMEAR_OK)
        return 0;
    for (int i = 0; i < 3; i++) {
        smear_camera eye = smear_perspective(SMEAR_DEGREES(60), ONE / 8, 0);
        const smear_vec3 thing = smear_vec(ONE / 2 * i, ONE, -ONE);
        const smear_transform round = smear_blob_under(thing, 0, ONE), place = smear_move(thing.x, thing.y, thing.z),
                              flat = smear_compose(fall, place);
        const smear_draw draw[] = { { .id = 1, .mesh = &ground, .material = &paint },
                                    { .id = 2, .mesh = &wedge, .now = &place },
                                    { .id = 3, .mesh = &wedge, .material = &smear_shadow_material, .now = &flat, .path = SMEAR_PATH_LINE },
                                    { .id = 4, .mesh = &smear_blob, .material = &smear_blob_material, .now = &round } };
        const smear_frame frame = { .camera = &eye, .method = (uint8_t)method, .scene = &scene, .light_space = (uint8_t)space,
                                    .target = target, .shutter.path = SMEAR_PATH_LINE };
        eye.pose = smear_compose(smear_move(0, 3 * ONE / 2, 4 * ONE), smear_rotate_z(roll));
        eye.pose = smear_compose(eye.pose, smear_rotate_x(SMEAR_DEGREES(4) * (uint32_t)i));
        int result = smear_begin(ctx, &frame);
        for (int k = 0; k < 4 && result == SMEAR_OK; k++)
            result = smear_submit(ctx, &draw[k]);
        if (result == SMEAR_OK)
            result = smear_render(ctx);
        if (result != SMEAR_OK)
            return 0;
        smear_get_stats(ctx, &stats);
    }
    return stats.crc32;
}

static void test_a_sky_and_shadows_are_the_same_everywhere(void)
{
    CHECK_EQ(sum_of(SMEAR_NONE, SMEAR_LIGHT_LINEAR, SMEAR_XRGB8888, 0, SMEAR_DEGREES(10)), 3721858322u);
    CHECK_EQ(sum_of(SMEAR_NONE, SMEAR_LIGHT_ENCODED, SMEAR_RGB565, 0, SMEAR_DEGREES(10)), 2717440830u);
    CHECK_EQ(sum_of(SMEAR_SUBFRAMES, SMEAR_LIGHT_LINEAR, SMEAR_RGB565, 0, SMEAR_DEGREES(10)), 2869526878u);
    CHECK_EQ(sum_of(SMEAR_AUTO, SMEAR_LIGHT_ENCODED, SMEAR_RGB565, 0, SMEAR_DEGREES(10)), 4078571770u);
    CHECK_EQ(sum_of(SMEAR_AUTO, SMEAR_LIGHT_LINEAR, SMEAR_XRGB8888, SMEAR_DRAFT, SMEAR_DEGREES(10)), 3472821502u);
    CHECK_EQ(sum_of(SMEAR_AUTO, SMEAR_LIGHT_ENCODED, SMEAR_L8, SMEAR_SKETCH, SMEAR_DEGREES(10)), 248272258u);
    CHECK_EQ(sum_of(SMEAR_NONE, SMEAR_LIGHT_ENCODED, SMEAR_XRGB8888, 0, 0), 1490331334u);
    CHECK_EQ(sum_of(SMEAR_SUBFRAMES, SMEAR_LIGHT_LINEAR, SMEAR_XRGB8888, 0, 0), 1581780654u);
}

#include "build/suites/scene.h"
