/* SPDX-License-Identifier: MIT */
/* test_sketch_truth.c - how far sketches are from the mean of many exact instants. Host only. */
#include "tests/ref/accuracy.h"
#include "tests/test.h"

#include <stdlib.h>

/* Codes of a scene's picture, encoded light, exact poses, and the bar. */
static void check_scene(const char *name, double bar)
{
    enum { INSTANTS = 64 };
    struct subject s;
    struct shot sketch, sharp;
    if (!subject_open(&s, name))
        return;
    struct present_options options = subject_options(&s);
    const struct shot_options none = { 0 };
    struct image exact = { 0 };
    struct failure failure = { { 0 } };
    options.shutter_poses = true;
    options.light = SMEAR_LIGHT_ENCODED;
    options.method = SMEAR_AUTO;
    options.target = SMEAR_SKETCH;
    if (!CHECK(presenter_exact(s.presenter, s.time, &options, s.width, s.height, INSTANTS, &exact, &failure)))
        return;
    if (shot_take(&s, &options, &none, &sketch)) {
        const int pixels = s.width * s.height;
        double sum = 0, before = 0;
        options.method = SMEAR_NONE;
        if (shot_take(&s, &options, &none, &sharp)) {
            for (int i = 0; i < 3 * pixels; i++) {
                const double truth = exact.rgba[4 * (i / 3) + i % 3];
                sum += (sketch.rgb[i] - truth) * (sketch.rgb[i] - truth);
                before += (sharp.rgb[i] - truth) * (sharp.rgb[i] - truth);
            }
            CHECK(sketch.stats.tiles[SMEAR_CAMERA] > 0);
            CHECK_BAR(sum / (3 * pixels), bar * bar, name);
            CHECK_BAR(sum, before / 2, name);
            shot_free(&sharp);
        }
        shot_free(&sketch);
    }
    image_free(&exact);
    subject_close(&s);
}

static void test_scenes_are_as_near_to_the_truth_as_a_sketch_is(void)
{
    check_scene("suite/pan", 7);
    check_scene("suite/roll", 7);
    check_scene("suite/arena", 7);
    check_scene("suite/dolly", 9);
    check_scene("suite/textured", 12);
    check_scene("demo/race", 9);
}

#include "build/suites/sketch_truth.h"
