/* SPDX-License-Identifier: MIT */
/* test_filters.c - filters beside the reconstruction: camera velocity from depth against that of vertices, passes against
 * direct taps, half size; on scenes of the suite. */
#include "accuracy.h"

#include "test.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void suite_filters(void);

/* ------------------------------------------------------------------ velocity from depth */

/* RMS and largest distance of two pictures' velocities where both see a surface, px in the exposure. */
static bool compare_velocities(struct subject *s, const struct present_options *vertices, int step, double *rms,
                               double *largest)
{
    struct shot_options options = { .look = true, .reach = 60, .tile = 64 };
    struct present_options depth = *vertices;
    struct shot a, b;
    double sum = 0.0;
    int count = 0;
    depth.camera_step = step;
    *rms = *largest = INFINITY;
    if (!shot_take(s, vertices, &options, &a))
        return false;
    if (!shot_take(s, &depth, &options, &b)) {
        shot_free(&a);
        return false;
    }
    double open = vertices->shutter_degrees / 360.0;
    *largest = 0.0;
    for (int i = 0; i < a.width * a.height; i++) {
        if (a.depth[i] == 0)
            continue;
        double x = (double)(a.velocity[2 * i] - b.velocity[2 * i]) * open;
        double y = (double)(a.velocity[2 * i + 1] - b.velocity[2 * i + 1]) * open;
        sum += x * x + y * y;
        *largest = fmax(*largest, hypot(x, y));
        count++;
    }
    CHECK(count > a.width * a.height / 4);
    CHECK(a.stats.draws_moved > b.stats.draws_moved);
    *rms = sqrt(sum / count);
    shot_free(&a);
    shot_free(&b);
    return true;
}

static void test_camera_velocity_from_depth_is_that_of_vertices(void)
{
    static const char *const scene[] = { "suite/pan", "suite/dolly", "suite/roll", "test/terrain", "test/ortho" };
    for (int k = 0; k < 5; k++) {
        struct subject s;
        if (!subject_open(&s, scene[k]))
            continue;
        if (k >= 3 && !subject_circle(&s, 1.0))
            continue;
        /* Hills seen at a glance: depths too steep for blocks; and much of what is carried on to the future of a frame
         * has left the eye. */
        for (int poses = 0; poses < 4; poses++)
            for (int step = 1; step <= 4; step *= 2) {      /* a tenth, a half and all of a quarter pixel */
                if (k == 3 && (step > 1 || poses == 1 || poses == 2))
                    continue;
                struct present_options p = subject_options(&s);
                double rms, largest;
                char name[80];
                p.method = SMEAR_RECONSTRUCT;
                p.shutter_poses = poses == 3;
                p.exposure = poses == 1 ? SMEAR_TRAILING : poses == 2 ? SMEAR_LEADING : SMEAR_CENTRED;
                snprintf(name, sizeof name, "%s, poses %d, step %d", scene[k], poses, step);
                if (!compare_velocities(&s, &p, step, &rms, &largest))
                    continue;
                say("      %-34s %.3f px RMS, at most %.2f\n", name, rms, largest);
                CHECK_BAR(rms, step == 1 ? 0.03 : step == 2 ? 0.125 : 0.26, name);
            }
        subject_close(&s);
    }
}

/* ------------------------------------------------------------------ memory */

static int take_nothing(void *user, const smear_band *band)
{
    (void)user;
    (void)band;
    return 0;
}

static void test_memory_of_passes_and_half_size_is_a_constant(void)
{
    static const int16_t size[][2] = { { 1, 1 }, { 7, 5 }, { 33, 17 }, { 128, 64 }, { 240, 240 }, { 321, 479 }, { 2048, 3 } };
    for (int i = 0; i < 7; i++)
        for (int tile = 8; tile <= 64; tile *= 2)
            for (int reach = 1; reach <= tile; reach++)
                for (int passes = 0; passes <= 3; passes++)
                    for (int half = 0; half < 2; half++) {
                        size_t w = (size_t)size[i][0], h = (size_t)size[i][1], r = (size_t)reach, t = (size_t)tile;
                        smear_desc desc = { .width = size[i][0], .height = size[i][1], .reach = (int16_t)reach,
                                            .tile = (int16_t)tile, .format = SMEAR_RGB565, .max_triangles = 100,
                                            .max_draws = 4, .passes = (uint8_t)passes, .half = (uint8_t)half,
                                            .flush = take_nothing };
                        size_t room = SMEAR_MEMORY_SIZE_TILE(w, h, r, 100, 4, t)
                                    + SMEAR_PASSES_BYTES(w, r, t, (size_t)passes)
                                    + (half ? SMEAR_HALF_BYTES(w, r, t) : 0u), need = smear_memory_size(&desc);
                        if (!CHECK(need > 0 && need <= room && room - need < 2048)) {
                            say("  %d x %d, tile %d, reach %d, passes %d, half %d: %zu of %zu\n", size[i][0], size[i][1],
                                tile, reach, passes, half, need, room);
                            return;
                        }
                    }
    smear_desc bad = { .width = 64, .height = 64, .flush = take_nothing, .passes = 4 };
    CHECK_EQ((int64_t)smear_memory_size(&bad), 0);
    bad.passes = 2;
    bad.sharp = 1;
    CHECK_EQ((int64_t)smear_memory_size(&bad), 0);
    bad.passes = 0;
    bad.half = 1;
    CHECK_EQ((int64_t)smear_memory_size(&bad), 0);
    bad.sharp = 0;
    bad.half = 2;
    CHECK_EQ((int64_t)smear_memory_size(&bad), 0);
}

void suite_filters(void)
{
    RUN(test_memory_of_passes_and_half_size_is_a_constant);
    RUN(test_camera_velocity_from_depth_is_that_of_vertices);
}
