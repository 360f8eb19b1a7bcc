/* SPDX-License-Identifier: MIT */
/* test_ribbon.c - lines in the world (smear_ribbon.h): corners against double precision; hidden, seen and blurred by every method; lines
 * of OBJ files. */
#include "smear_ribbon.h"

#include "tests/random.h"
#include "tests/rig.h"
#include "tools/convert/segments.h"

#include <math.h>

enum { SEGMENTS = 20, SIDE = 64 };

static int16_t position[SMEAR_RIBBON_POSITIONS(SEGMENTS)];
static uint16_t corners[SMEAR_RIBBON_INDICES(SEGMENTS)];

/* ------------------------------------------------------------------ corners */

/* How many units a step of the ribbon's mesh is. */
static double step_of(const smear_ribbon *r) { return ldexp(1, -r->mesh.shift); }

/* How far corners are from where they should be, in steps. */
static double error_of(const smear_ribbon *r, const int16_t *got, const int32_t end[2][3], const smear_camera *camera)
{
    double worst = 0, along[3];
    for (int k = 0; k < 3; k++)
        along[k] = ((double)end[1][k] - end[0][k]) / 65536;
    for (int e = 0; e < 2; e++) {
        double away[3], depth = 0, half = r->width / 131072.0, size = 0;
        for (int k = 0; k < 3; k++) {
            away[k] = ((double)end[e][k] - camera->pose.origin[k]) / 65536;
            depth -= away[k] * camera->pose.basis[3 * k + 2] / (1 << 24);
        }
        const double pixel = 2 * (camera->half_height > 0 ? camera->half_height / 65536.0 : depth / (camera->focal / 65536.0));
        if (r->rows != 0)
            half = fmax(half, r->pixels / 256.0 * pixel / r->rows / 2);
        for (int k = 0; k < 3 && camera->half_height > 0; k++)
            away[k] = -camera->pose.basis[3 * k + 2];
        double side[3] = { along[1] * away[2] - along[2] * away[1], along[2] * away[0] - along[0] * away[2],
                           along[0] * away[1] - along[1] * away[0] };
        for (int k = 0; k < 3; k++)
            size += side[k] * side[k];
        for (int k = 0; k < 3; k++)
            for (int way = -1; way <= 1; way += 2) {
                const double want = end[e][k] / 65536.0 + way * side[k] / sqrt(size) * half;
                const double is = got[6 * e + (way > 0 ? 3 : 0) + k] * step_of(r) + r->place.origin[k] / 65536.0;
                worst = fmax(worst, fabs(is - want) / (step_of(r) + half / 256));
            }
    }
    return worst;
}

static void test_corners_are_those_of_double_precision(void)
{
    smear_segment segment[SEGMENTS];
    for (int turn = 0; turn < 200; turn++) {
        const int32_t room = 1 << (12 + turn % 12);
        smear_camera camera[2];
        for (int i = 0; i < 2; i++) {
            camera[i] = smear_perspective(SMEAR_DEGREES(40), SMEAR_Q16(0.1), 0);
            camera[i].pose = smear_from_euler(random_u32(), random_u32(), random_u32());
            for (int k = 0; k < 3; k++)
                camera[i].pose.origin[k] = camera[i].pose.basis[3 * k + 2] / 128 * 3;
            if (turn % 3 == 2)
                camera[i].half_height = 3 << 16;
        }
        for (int i = 0; i < SEGMENTS; i++)
            for (int k = 0; k < 12; k++) {
                int32_t *at = k < 6 ? &segment[i].now[k / 3][k % 3] : &segment[i].before[k / 3 - 2][k % 3];
                *at = (int32_t)(random_u32() % (uint32_t)(2 * room)) - room;
            }
        smear_ribbon r = { .segment = segment, .count = SEGMENTS, .width = (int32_t)(random_u32() % 9000), .position = position,
                           .index = corners, .pixels = 300, .rows = (uint16_t)(turn % 2 * 240) };
        smear_ribbon_place(&r, &camera[0], &camera[1]);
        for (int i = 0; i < SEGMENTS; i++) {
            CHECK(error_of(&r, position + 12 * i, segment[i].now, &camera[0]) <= 1.5);
            CHECK(error_of(&r, position + 12 * (SEGMENTS + i), segment[i].before, &camera[1]) <= 1.5);
        }
    }
}

/* ------------------------------------------------------------------ pictures */

/* An upright line two units away that moves to the right; its lower half is behind a wall. Finds the red of each pixel. */
static bool draw_line(int method, uint8_t red[SIDE * SIDE])
{
    static const int16_t corner[] = { -4, -4, 0, 4, -4, 0, 4, 0, 0, -4, 0, 0 };
    static const uint16_t side[] = { 0, 1, 2, 0, 2, 3 };
    static const smear_material glow = { .color = { 255, 0, 0, 255 }, .unlit = 1 }, wall = { .color = { 0, 0, 255, 255 }, .unlit = 1 };
    const smear_mesh mesh = { .position = corner, .vertex_count = 4, .index = side, .triangle_count = 2 };
    const smear_transform near = smear_move(0, 0, SMEAR_Q16(-1.5));
    smear_camera camera = smear_perspective(SMEAR_DEGREES(90), SMEAR_Q16(0.5), 0);
    smear_segment segment = { { { 0, SMEAR_Q16(-1), SMEAR_Q16(-2) }, { 0, SMEAR_Q16(1), SMEAR_Q16(-2) } },
                              { { SMEAR_Q16(-0.5), SMEAR_Q16(-1), SMEAR_Q16(-2) }, { SMEAR_Q16(-0.5), SMEAR_Q16(1), SMEAR_Q16(-2) } } };
    smear_ribbon r = { .segment = &segment, .count = 1, .width = SMEAR_Q16(0.125), .position = position, .index = corners,
                       .draw.material = &glow };
    const smear_frame frame = { .camera = &camera, .method = (uint8_t)method, .light_space = SMEAR_LIGHT_ENCODED,
                                .samples = method == SMEAR_ACCUMULATE ? 256 : 64 };
    smear_desc desc = { .width = SIDE, .height = SIDE, .tile = 8, .reach = 8, .flush = place_band,
                        .methods = (uint16_t)SMEAR_SET(method) };
    smear_ribbon_place(&r, &camera, &camera);
    const smear_draw draw[2] = { { .mesh = &mesh, .material = &wall, .now = &near }, r.draw };
    RIG(rig, &desc, false);
    const bool ok = CHECK_EQ(rig_frame(&rig, &frame, draw, 2), SMEAR_OK);
    for (int i = 0; ok && i < SIDE * SIDE; i++)
        red[i] = (uint8_t)(((const uint32_t *)(const void *)rig.picture)[i] >> 16);
    return ok;
}

/* Of those that blur all that moves, whatever its size. */
static bool is_whole(int method) { return method != SMEAR_NONE && (method < SMEAR_CAMERA || method > SMEAR_HALF); }

/* 8 pixels in a frame, half of them while the shutter is open, 2 pixels wide: light of 2 over about 6 pixels. */
static void test_lines_are_hidden_and_blurred_by_every_method(void)
{
    uint8_t truth[SIDE * SIDE], red[SIDE * SIDE];
    if (!draw_line(SMEAR_ACCUMULATE, truth))
        return;
    for (int method = SMEAR_NONE; method < SMEAR_METHOD_COUNT; method++) {
        const uint8_t *free_row = red + (SIDE / 4 + 4) * SIDE, *hidden_row = red + (SIDE / 2 + 4) * SIDE;
        double squares = 0;
        int sum = 0, seen = 0;
        if (!draw_line(method, red))
            continue;
        for (int x = 0; x < SIDE; x++) {
            sum += free_row[x];
            seen += free_row[x] > 8;
            CHECK_EQ(hidden_row[x], 0);
        }
        for (int i = 0; i < SIDE * SIDE; i++)
            squares += (red[i] - truth[i]) * (red[i] - truth[i]);
        CHECK(sum > 255 * (is_whole(method) ? 1.9 : 0.9) && sum < 255 * 2.5);
        CHECK(is_whole(method) ? seen == 5 || seen == 6 : seen == 2);
        CHECK(!is_whole(method) || method == SMEAR_RECONSTRUCT      /* of codes; instants of half a pixel err by more */
              || sqrt(squares / (SIDE * SIDE)) <= (method == SMEAR_SUBFRAMES ? 1.7 : 1.0));
    }
}

/* ------------------------------------------------------------------ lines of files */

static bool convert(const char *text, double scale, int *count, struct failure *f)
{
    uint8_t *bytes;
    size_t size;
    *f = (struct failure){ "" };
    const bool ok = segments_to_header((const uint8_t *)text, strlen(text), scale, "edge", "edge.obj", &bytes, &size, count, f);
    if (ok)
        CHECK(strstr((char *)bytes, "{ { { -32768, 0, 0 }, { 32768, 98304, 0 } }, { { -32768, 0, 0 }, { 32768, 98304, 0 } } },\n") != NULL
              && strstr((char *)bytes, "#define EDGE_SEGMENTS ") != NULL);
    free(bytes);
    return ok;
}

static void test_lines_of_files_become_segments(void)
{
    static const char *const bad[] = { "v 1 2\n", "v 1 2 x\n", "v 1 2 40000\n", "v 0 0 0\nl 1 2\n", "v 0 0 0\nl 1 x\n", "v 0 0 0\nl -2 1\n",
                                       "v 0 0 0\nl 0 1\n", "v 0 0 0\nf 1 1 1\n", "v 0 0 0\nl 1\n", "" };
    struct failure f;
    int count;
    CHECK(convert("v -.5 0 0\nv .5 1.5 0\nl 1 2\n", 1, &count, &f) && count == 1);
    CHECK(convert("v -5 0 0\nv 5 15 0\nvt 0 0\nl -2/1 -1/1 1\nf 1 2 1\nl 2 1 2\n", 0.1, &count, &f) && count == 4);
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
        CHECK(!convert(bad[i], 1, &count, &f) && f.text[0] != '\0');
}

#include "build/suites/ribbon.h"
