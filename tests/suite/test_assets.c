/* SPDX-License-Identifier: MIT */
/* test_assets.c - every model file at hand loads, is drawn by the library, and looks like the
 * reference, cameras and animations of the file included. */
#include "tests/ref/accuracy.h"

#include "tests/host.h"

enum { WIDTH = 320, HEIGHT = 240 };

static const double coverage_bar = 0.001;       /* of all pixels */
static const double velocity_bar = 1.0 / 8.0;   /* px per frame, RMS */
static const double color_bar = 2.0;            /* codes, over the whole frame, edges included */

/* What a picture of the library is, beside the reference. */
struct likeness {
    double coverage;            /* share of pixels drawn by one and background in the other */
    double color_rms;           /* codes */
    double covered;             /* share of pixels drawn by the reference */
    int moving;                 /* pixels with a velocity */
    double velocity_rms;        /* px per frame, away from edges of draws */
};

static struct likeness likeness_of(const struct ref_frame *frame, const struct shot *sharp,
                                   const struct shot *under)
{
    struct likeness l = {0};
    double sum = 0.0;
    size_t pixels = (size_t)frame->width * (size_t)frame->height;
    for (size_t i = 0; i < pixels; i++) {
        l.coverage += isinf(frame->depth[i]) != isinf(under->distance[i]);
        l.covered += !isinf(frame->depth[i]);
        l.moving +=
            fabsf(under->velocity[2 * i]) > 0.0f || fabsf(under->velocity[2 * i + 1]) > 0.0f;
        for (size_t k = 0; k < 3; k++) {
            double d = sharp->rgb[3 * i + k] - 255.0 * ref_srgb_encode(frame->color[3 * i + k]);
            sum += d * d;
        }
    }
    struct ref_difference d;
    struct ref_planes planes = {.width = frame->width, .height = frame->height,
                                .depth = under->distance, .velocity = under->velocity};
    ref_compare(frame, &planes, &d);
    l.velocity_rms = d.velocity_rms;
    l.coverage /= (double)pixels;
    l.covered /= (double)pixels;
    l.color_rms = sqrt(sum / (3.0 * (double)pixels));
    return l;
}

/* ------------------------------------------------------------------ the files */

static void check_subject(struct subject *s)
{
    struct shot sharp OWNED(shot_free) = {0}, under = {0}, blurred = {0};
    struct ref_frame frame OWNED(ref_frame_free) = { 0 };
    const struct shot_options plain = {0}, look = {.look = true};
    struct present_options present = subject_options(s), none;
    present.shutter_poses = true;
    present.method = SMEAR_RECONSTRUCT;
    present.reconstruct = SMEAR_FENCE | SMEAR_CORNER | SMEAR_BOX | SMEAR_UNIFORM;
    none = present;
    none.method = SMEAR_NONE;
    END_UNLESS(reference_take(s, &present, WIDTH, HEIGHT, &frame));
    if (shot_take(s, &none, &plain, &sharp) && shot_take(s, &present, &look, &under)
        && shot_take(s, &present, &plain, &blurred)) {
        struct likeness l = likeness_of(&frame, &sharp, &under);
        say("    %-26s %5.2f s %6u %6u  %5.1f  %6.3f  %5.2f  %6d  %5.3f\n", s->name, s->time,
            sharp.stats.triangles_in, sharp.stats.triangles_drawn, 100.0 * l.covered,
            100.0 * l.coverage, l.color_rms, l.moving, l.velocity_rms);
        CHECK_BAR(l.coverage, coverage_bar, s->name);
        CHECK_BAR(l.color_rms, color_bar, s->name);
        CHECK_BAR(l.velocity_rms, velocity_bar, s->name);
        CHECK(l.covered > 0.01);
        CHECK_EQ(sharp.stats.triangles_dropped, 0);
        /* Looking at the rows is only looking. */
        CHECK_EQ(under.stats.crc32, blurred.stats.crc32);
        if (l.moving == 0)
            CHECK_EQ(blurred.stats.crc32, sharp.stats.crc32);
    }
    shot_free(&under);
    shot_free(&blurred);
}

/* As the files are, and with a camera that circles them, so that all of them move. */
static void check_files(bool circling)
{
    const char *folder = asset_folder();
    if (folder == NULL) {
        say("    no folder of models: set SMEAR_ASSETS\n");
        return;
    }
    char **list = asset_list(folder);
    REQUIRE(list != NULL);
    int count = 0;
    say("    %-26s %7s %6s %6s  %5s  %6s  %5s  %6s  %5s\n",
        circling ? "model, camera circles" : "model", "time", "in", "drawn", "fill%", "cover%",
        "rms", "moving", "v rms");
    for (char **path = list; *path != NULL; path++, count++) {
        struct subject s OWNED(subject_close) = { 0 };
        if (!subject_open_file(&s, *path, WIDTH, HEIGHT))
            continue;
        if (!circling || CHECK(subject_circle(&s, 4.0)))
            check_subject(&s);
    }
    CHECK(count > 0);
    asset_list_free(list);
}

static void test_every_model_at_hand_looks_like_the_reference(void)
{
    check_files(false);
}

static void test_every_model_looks_like_the_reference_in_motion(void)
{
    check_files(true);
}

#include "build/suites/assets.h"
