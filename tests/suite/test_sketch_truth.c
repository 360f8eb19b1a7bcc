/* SPDX-License-Identifier: MIT */
/* test_sketch_truth.c - how far sketches are from the mean of many exact instants. Host only. */
#include "tests/ref/accuracy.h"
#include "tests/test.h"

/* Codes of a scene's picture, encoded light, exact poses, and the bar. */
static void check_scene(const char *name, double bar)
{
    struct subject s OWNED(subject_close) = { 0 };
    struct shot sketch OWNED(shot_free) = { 0 }, sharp OWNED(shot_free) = { 0 };
    END_UNLESS(subject_open(&s, name));
    struct present_options options = subject_options(&s), none;
    options.shutter_poses = true;
    options.light = SMEAR_LIGHT_ENCODED;
    options.method = SMEAR_AUTO;
    options.target = SMEAR_SKETCH;
    none = options;
    none.method = SMEAR_NONE;
    const struct ref_truth *truth = truth_of(&s, &options, 64);
    REQUIRE(truth != NULL && shot_take(&s, &options, &(struct shot_options){ 0 }, &sketch)
            && shot_take(&s, &none, &(struct shot_options){ 0 }, &sharp));
    const double error = rmse_to_truth(sketch.rgb, truth), before = rmse_to_truth(sharp.rgb, truth);
    CHECK(sketch.stats.tiles[SMEAR_CAMERA] > 0);
    CHECK_BAR(error, bar, name);
    CHECK_BAR(error * error, before * before / 2, name);
}

static void test_scenes_are_as_near_to_the_truth_as_a_sketch_is(void)
{
    check_scene("suite/pan", 7);
    check_scene("suite/roll", 7);
    check_scene("suite/arena", 7);
    check_scene("suite/dolly", 9);
    check_scene("suite/textured", 12);
    check_scene("demo/race", 9);
    check_scene("test/ortho", 5);           /* with a car that is squeezed askew as it turns */
    check_scene("fail/sky", 11);            /* small things before the clear colour */
    truth_forget();
}

#include "build/suites/sketch_truth.h"
