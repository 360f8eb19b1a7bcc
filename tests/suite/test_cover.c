/* SPDX-License-Identifier: MIT */
/* test_cover.c - how often triangles cover the picture (tools/scenes/sight.c), by which frames are refused that would
 * take minutes. */
#include "tests/test.h"
#include "tools/scenes/scene.h"

/* A camera at (0, 0, 2) that sees from -1 to 1 at z = 1 in both directions. */
static struct scene_camera camera_at_two(void)
{
    return (struct scene_camera){ .pose = { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 2, 1 }, .yfov = 1.5707963267948966,
                                  .znear = 0.5 };
}

/* Of one triangle, `times` over. */
static double cover_of(const float corner[9], int times, bool orthographic, double enough)
{
    static uint32_t index[3 * 64];
    for (uint32_t i = 0; i < 3u * (uint32_t)times; i++)
        index[i] = i % 3;
    const struct scene_surface surface = { .vertex_count = 3, .triangle_count = times, .position = corner, .index = index };
    struct scene_draw draw = { .surface = &surface, .world = { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 }, .position = corner };
    struct scene_instant instant = { .camera = camera_at_two(), .draw_count = 1, .draw = &draw };
    if (orthographic) {
        instant.camera.orthographic = true;
        instant.camera.half_height = 1;
    }
    return scene_cover(&instant, 1, enough);
}

static void test_a_triangle_covers_its_part_of_the_picture(void)
{
    static const float half[9] = { -1, -1, 1, 1, -1, 1, -1, 1, 1 }, behind[9] = { -1, -1, 3, 1, -1, 3, -1, 1, 3 };
    static const float beside[9] = { 5, -1, 1, 7, -1, 1, 5, 1, 1 };
    CHECK_CLOSE(cover_of(half, 1, false, 100), 0.5, 1e-9);
    CHECK_CLOSE(cover_of(half, 1, true, 100), 0.5, 1e-9);
    CHECK_CLOSE(cover_of(half, 40, false, 100), 20, 1e-9);
    CHECK_CLOSE(cover_of(behind, 1, false, 100), 0, 0);
    CHECK_CLOSE(cover_of(beside, 1, false, 100), 0, 0);
}

static void test_none_covers_it_more_than_once(void)
{
    static const float huge[9] = { -1e6f, -1e6f, -9, 1e6f, -1e6f, -9, 0, 1e6f, -9 };
    static const float through[9] = { -9, -9, 9, 9, -9, 9, 0, 9, -9 };     /* from behind the eye to far before it */
    CHECK_CLOSE(cover_of(huge, 1, false, 100), 1, 1e-9);
    CHECK(cover_of(through, 1, false, 100) > 0.0 && cover_of(through, 1, false, 100) <= 1.0);
    CHECK(cover_of(huge, 64, false, 3) > 3.0 && cover_of(huge, 64, false, 3) < 6.0);    /* it stops there */
}

#include "build/suites/cover.h"
