/* SPDX-License-Identifier: MIT */
/* test_near.c - surfaces that lie closely above each other while both pass the near plane: the upper one is seen by every
 * method as the mean of many instants has it. And what begins in the eye. */
#include "tests/rig.h"

enum { WIDTH = 120, HEIGHT = 80, BYTES = WIDTH * HEIGHT * 4 };

/* A floor from behind the eye to the horizon, and a stripe on it: 1/64 unit per step. */
static const int16_t floor_position[] = { -2000, 0, 1200, 2000, 0, 1200, 2000, 0, -4000, -2000, 0, -4000 };
static const int16_t stripe_position[] = { -40, 1, 1200, 40, 1, 1200, 40, 1, -4000, -40, 1, -4000 };
static const smear_mesh ground = { .position = floor_position, .vertex_count = 4, .index = square_index,
                                   .triangle_count = 2, .shift = 6 };
static const smear_mesh stripe = { .position = stripe_position, .vertex_count = 4, .index = square_index,
                                   .triangle_count = 2, .shift = 6 };

/* The picture of a method as the camera drives aslant over the floor. */
static bool draw(uint8_t method, int32_t samples, double near_plane, uint8_t out[BYTES])
{
    static const smear_material grey = { .color = { 60, 60, 60, 255 }, .unlit = 1 };
    static const smear_material white = { .color = { 240, 240, 240, 255 }, .unlit = 1 };
    static const smear_transform still = SMEAR_IDENTITY;
    const smear_draw draws[2] = {
        { .id = 1, .mesh = &ground, .material = &grey, .now = &still },
        { .id = 2, .mesh = &stripe, .material = &white, .now = &still }
    };
    smear_desc desc = small_desc(WIDTH, HEIGHT);
    desc.format = SMEAR_XRGB8888;
    desc.methods |= SMEAR_SET(SMEAR_ACCUMULATE) | SMEAR_SET_TEMPORAL;
    RIG(r, &desc, false);
    bool ok = true;
    for (int i = 0; i < 2 && ok; i++) {
        smear_camera camera = camera_at(0.2 - 0.5 * i, 1.0, 2.0 - 0.9 * i, 0.5);
        camera.near_plane = q16(near_plane);
        const smear_frame frame = { .camera = &camera, .method = method, .samples = (uint16_t)samples,
                                    .light_space = SMEAR_LIGHT_ENCODED };
        rig_forget_output(&r);
        ok = CHECK_EQ(rig_frame(&r, &frame, draws, 2), SMEAR_OK) && CHECK(r.picture_size == (size_t)BYTES);
    }
    memcpy(out, r.picture, BYTES);
    return ok;
}

/* Pixels that are off by more than a third of what tells the stripe from the floor. */
static int pixels_off(const uint8_t *a, const uint8_t *b)
{
    int count = 0;
    for (int i = 0; i < BYTES; i += 4)
        count += abs(a[i] - b[i]) > 60;
    return count;
}

static void check_stripe(double near_plane, int least_white)
{
    static uint8_t want[BYTES], got[BYTES];
    static const struct { uint8_t method; int samples; } by[] = {
        { SMEAR_SUBFRAMES, 16 }, { SMEAR_SUBFRAMES, 32 }, { SMEAR_TIMEMASK, 8 }, { SMEAR_TIMEMASK, 16 }, { SMEAR_TIMEMASK, 32 },
        { SMEAR_AUTO, 0 }
    };
    int white = 0;
    END_UNLESS(draw(SMEAR_ACCUMULATE, 64, near_plane, want));
    for (int i = 0; i < BYTES; i += 4)
        white += want[i] > 200;
    CHECK(white > least_white);
    for (int i = 0; i < (int)(sizeof by / sizeof *by); i++)
        if (draw(by[i].method, by[i].samples, near_plane, got) && !CHECK(pixels_off(got, want) <= 20))
            CHECK_EQ(by[i].method * 100 + by[i].samples, pixels_off(got, want));
}

static void test_a_stripe_on_a_floor_that_the_near_plane_cuts_below_the_frame_is_seen(void)
{
    check_stripe(0.3, 400);
}

static void test_a_stripe_on_a_floor_that_the_near_plane_cuts_in_the_frame_is_seen(void)
{
    check_stripe(1.8, 40);
}

/* Triangles that turn about a corner in the eye, with the least near plane: there, a place that is rounded is many pixels off. Tiles draw
 * what lies in their bounds. */
static bool draw_at_the_eye(int tile, uint32_t number, uint8_t out[BYTES])
{
    enum { TRIANGLES = 24 };
    static const smear_material light = { .color = { 230, 200, 90, 255 }, .unlit = 1, .double_sided = 1 };
    static const smear_transform still = SMEAR_IDENTITY;
    int16_t position[9 * TRIANGLES];
    uint16_t index[3 * TRIANGLES];
    random_state = number * 2654435761u + 1u;
    for (int i = 0; i < 9 * TRIANGLES; i++)
        position[i] = (int16_t)(i % 9 < 3 ? 0 : between(-2000, 2000));
    for (int i = 0; i < 3 * TRIANGLES; i++)
        index[i] = (uint16_t)i;
    const smear_mesh mesh = { .position = position, .vertex_count = 3 * TRIANGLES, .index = index, .triangle_count = TRIANGLES };
    smear_transform open = SMEAR_IDENTITY, close = SMEAR_IDENTITY;
    random_rotation(open.basis, 1);
    random_rotation(close.basis, 1);
    const smear_draw a = { .id = 1, .mesh = &mesh, .material = &light, .now = &still, .open = &open, .close = &close };
    const smear_camera camera = { .pose = SMEAR_IDENTITY, .focal = 65536, .near_plane = 1 };
    const smear_frame frame = { .camera = &camera, .method = SMEAR_SUBFRAMES, .samples = 8, .light_space = SMEAR_LIGHT_ENCODED,
                                .shutter = { .poses = 1 } };
    smear_desc desc = small_desc(WIDTH, HEIGHT);
    desc.format = SMEAR_XRGB8888;
    desc.methods = SMEAR_SET_TEMPORAL;
    desc.tile = (int16_t)tile;
    desc.max_triangles = 2000;
    RIG(r, &desc, false);
    const bool ok = CHECK_EQ(rig_frame(&r, &frame, &a, 1), SMEAR_OK) && CHECK(r.picture_size == (size_t)BYTES);
    memcpy(out, r.picture, BYTES);
    return ok;
}

static void test_what_begins_in_the_eye_is_the_same_in_tiles_of_any_size(void)
{
    static uint8_t small[BYTES], large[BYTES];
    for (uint32_t i = 1; i <= 200; i++) {
        REQUIRE(draw_at_the_eye(8, i, small) && draw_at_the_eye(64, i, large));
        if (!CHECK(memcmp(small, large, BYTES) == 0))
            CHECK_EQ(i, 0);
    }
}

#include "build/suites/near.h"
