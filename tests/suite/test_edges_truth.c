/* SPDX-License-Identifier: MIT */
/* test_edges_truth.c - smooth edges against the truth over pixel and exposure. Host only. */
#include "tests/host.h"
#include "tools/player/exact.h"
#include "tools/player/picture.h"

enum { SIZE = 120, INSTANTS = 24 };

/* A frame of a scene in a format, as a picture. */
static bool draw(struct presenter *presenter, const struct scene *scene, const struct present_options *options,
                 smear_format format, struct image *out)
{
    struct failure f = { "" };
    const struct device_setup setup = { .width = SIZE, .height = SIZE, .threads = 1, .methods = SMEAR_SET(SMEAR_AUTO), .format = format };
    struct device device;
    const struct presented *frame = presenter_frame(presenter, scene->time, options, &f);
    const bool ok = CHECK(device_open(&device, &setup, &f) && frame != NULL && device_fit(&device, frame, &f)
                          && device_draw(&device, frame, &f) && image_alloc(out, SIZE, SIZE, &f));
    if (ok)
        picture_expand(out, device.pixels, device.stride, format);
    device_close(&device);
    return ok;
}

/* The root mean square of differences between means over 2^blur pixels squared: what an eye sees of dither. */
static double error_of(const struct image *a, const struct image *b, int blur)
{
    const int n = 1 << blur;
    double sum = 0;
    int count = 0;
    for (int y = 0; y + n <= SIZE; y++)
        for (int x = 0; x + n <= SIZE; x++, count += 3)
            for (int c = 0; c < 3; c++) {
                double difference = 0;
                for (int k = 0; k < n * n; k++) {
                    const size_t at = 4 * (size_t)((y + k / n) * SIZE + x + k % n) + (size_t)c;
                    difference += a->rgba[at] - b->rgba[at];
                }
                sum += difference * difference / (n * n * n * n);
            }
    return sqrt(sum / count);
}

/* What a display of greys makes of colours, about. */
static void make_grey(struct image *a)
{
    for (size_t i = 0; i < (size_t)SIZE * SIZE; i++) {
        uint8_t *p = a->rgba + 4 * i;
        p[0] = p[1] = p[2] = (uint8_t)((77 * p[0] + 150 * p[1] + 29 * p[2] + 128) >> 8);
    }
}

struct seen {
    const char *name;
    smear_format format;
    int blur;
    double least;           /* what is left of the error without, at most */
};

static void check_scene(const struct seen *seen)
{
    struct failure f = { "" };
    struct scene scene OWNED(scene_free) = { 0 };
    struct image truth, hard, smooth;
    REQUIRE(scene_builtin(seen->name, &scene, &f));
    struct presenter *presenter = presenter_new(&scene, &f);
    struct present_options options = {
        .fps = scene.fps, .shutter_degrees = 180, .method = SMEAR_AUTO, .light = SMEAR_LIGHT_LINEAR, .clear = scene.clear,
        .edges = SMEAR_EDGES_SMOOTH, .shutter_poses = true
    };
    if (CHECK(presenter != NULL) && CHECK(exact_picture(presenter, scene.time, &options, SIZE, SIZE, INSTANTS, &truth, &f))) {
        if (seen->format != SMEAR_XRGB8888)
            make_grey(&truth);
        if (draw(presenter, &scene, &options, seen->format, &smooth)) {
            options.edges = SMEAR_EDGES_HARD;
            if (draw(presenter, &scene, &options, seen->format, &hard)) {
                const double without = error_of(&hard, &truth, seen->blur), with = error_of(&smooth, &truth, seen->blur);
                char text[96];
                snprintf(text, sizeof text, "%s: %.2f codes, %.2f without\n", seen->name, with, without);
                if (!CHECK(with <= without * seen->least))
                    test_print(text);
                image_free(&hard);
            }
            image_free(&smooth);
        }
        image_free(&truth);
    }
    presenter_free(presenter);
}

static void test_errors_halve(void)
{
    static const struct seen seen[] = {
        { "suite/still", SMEAR_XRGB8888, 0, 0.45 },     { "suite/teleport", SMEAR_XRGB8888, 0, 0.5 },
        { "suite/translate", SMEAR_XRGB8888, 0, 0.55 },  { "suite/cross", SMEAR_XRGB8888, 0, 0.5 },
        { "suite/subpixel", SMEAR_XRGB8888, 0, 0.5 },   { "suite/dolly", SMEAR_XRGB8888, 0, 0.6 },
        { "suite/textured", SMEAR_XRGB8888, 0, 0.8 },   { "suite/still", SMEAR_L4, 1, 0.8 },
        { "suite/still", SMEAR_L1, 2, 0.99 },
    };
    for (size_t i = 0; i < sizeof seen / sizeof *seen; i++)
        check_scene(&seen[i]);
}

#include "build/suites/edges_truth.h"
