/* SPDX-License-Identifier: MIT */
/* failures_other.c - rows of the failure catalogue about what the library keeps and how exactly:
 * velocities, depth, light, layers, small frames, large coordinates; and what holds for every
 * scene. */
#include "tests/suite/failures.h"

#include "tests/context_rig.h"

#define PI 3.14159265358979323846

/* Picture and truth of a whole scene. */
static double scene_rmse(const char *scene, const struct fail_method *method)
{
    struct subject s OWNED(subject_close) = { 0 };
    double error = NAN;
    if (!subject_open(&s, scene))
        return NAN;
    struct present_options present = fail_options(&s, method);
    uint8_t *rgb = fail_take(&s, &present, 0, 0);
    const struct ref_truth *truth = truth_of(&s, &present, FAIL_INSTANTS);
    if (rgb != NULL && truth != NULL)
        error = fail_rmse(&s, rgb, truth, fail_whole(&s));
    free(rgb);
    return error;
}

/* The largest error of velocities away from edges of draws, against those of the reference. */
static double velocity_error(const char *scene, const struct fail_method *method)
{
    struct subject s OWNED(subject_close) = { 0 };
    struct ref_frame frame;
    struct shot shot;
    struct ref_difference d;
    double worst = NAN;
    if (!subject_open(&s, scene))
        return NAN;
    struct present_options present = fail_options(&s, method);
    if (reference_take(&s, &present, s.width, s.height, &frame)) {
        if (fail_look(&s, &present, &shot)) {
            struct ref_planes planes = {.width = s.width, .height = s.height,
                                        .depth = shot.distance, .velocity = shot.velocity};
            ref_compare(&frame, &planes, &d);
            if (CHECK(d.velocity_pixels > d.pixels / 2))
                worst = d.velocity_max;
            shot_free(&shot);
        }
        ref_frame_free(&frame);
    }
    return worst;
}

/* ------------------------------------------------------------------ 17 billboard, 32 deformed */

static void billboard(const struct fail_method *method, double number[])
{
    number[0] = scene_rmse("fail/billboard", method);
    if (method->method == SMEAR_RECONSTRUCT)
        number[1] = velocity_error("fail/billboard", method);
}

/* A quad that is two triangles in one frame and four in the next: its motion must be that of the
 * draw. */
static const int16_t quad[] = {-512, -512, 0, 512, -512, 0, 512, 512, 0, -512, 512, 0, 0, 0, 0};
static const uint16_t two[] = {0, 1, 2, 0, 2, 3}, four[] = {0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4};

enum { QUAD_EDGE = 64 };

static bool draw_quads(const struct fail_method *method, const smear_mesh *first,
                       const smear_mesh *second, uint8_t rgb[QUAD_EDGE * QUAD_EDGE * 4])
{
    static const smear_material red = {.color = {220, 60, 40, 255}, .unlit = 1};
    smear_desc desc = {.width = QUAD_EDGE, .height = QUAD_EDGE, .reach = FAIL_REACH,
                       .methods = (uint16_t)(SMEAR_SET(method->method) | SMEAR_SET(SMEAR_RECONSTRUCT)),
                       .max_triangles = 16};
    smear_camera camera = {.pose = SMEAR_IDENTITY, .focal = 2 << 16, .near_plane = 1 << 15};
    RIG(r, &desc, false);
    bool ok = true;
    for (int i = 0; i < 2 && ok; i++) {
        smear_transform pose = SMEAR_IDENTITY;
        smear_frame frame = {.camera = &camera, .method = (uint8_t)method->method,
                             .samples = (uint16_t)method->samples, .shutter.degrees = 360,
                             .filter.flags = (uint8_t)method->flags,
                             .target = (uint16_t)method->target,
                             .filter.weights = (uint8_t)method->weights,
                             .filter.pingpong.spread = method->spread};
        pose.origin[0] = (i - 1) * 32768;
        pose.origin[2] = -4 * 65536;
        smear_draw draw = {.id = 7, .mesh = i == 0 ? first : second, .material = &red,
                           .now = &pose};
        ok = CHECK_EQ(rig_frame(&r, &frame, &draw, 1), SMEAR_OK);
    }
    memcpy(rgb, r.picture, QUAD_EDGE * QUAD_EDGE * 4);
    return ok;
}

static void deformed(const struct fail_method *method, double number[])
{
    static uint8_t changed[QUAD_EDGE * QUAD_EDGE * 4], same[QUAD_EDGE * QUAD_EDGE * 4];
    const smear_mesh simple = {.position = quad, .vertex_count = 4, .index = two,
                               .triangle_count = 2, .shift = 10};
    const smear_mesh fine = {.position = quad, .vertex_count = 5, .index = four,
                             .triangle_count = 4, .shift = 10};
    number[0] = scene_rmse("fail/arm", method);
    if (draw_quads(method, &simple, &fine, changed) && draw_quads(method, &fine, &fine, same)) {
        number[1] = 0.0;
        for (size_t i = 0; i < sizeof same; i++)
            number[1] = fmax(number[1], abs(changed[i] - same[i]));
    }
    if (method->method == SMEAR_RECONSTRUCT)
        number[2] = velocity_error("fail/arm", method);
}

/* ------------------------------------------------------------------ 18 light */

static void light(const struct fail_method *method, double number[])
{
    struct subject s OWNED(subject_close) = { 0 };
    number[0] = scene_rmse("fail/light", method);
    END_UNLESS(subject_open(&s, "fail/light"));
    struct present_options present = fail_options(&s, method);
    uint8_t *rgb = fail_take(&s, &present, 0, 0), *sharp = fail_sharp(&s, &present);
    if (rgb != NULL && sharp != NULL)
        number[1] = fail_difference(&s, rgb, sharp, fail_whole(&s));
    free(rgb);
    free(sharp);
}

/* ------------------------------------------------------------------ 24 velocity quantisation */

/* Largest difference between the held scene and its sharp picture. */
static double held_difference(const char *scene, const struct fail_method *method, int width,
                              int height)
{
    struct subject s OWNED(subject_close) = { 0 };
    double worst = NAN;
    if (!subject_open(&s, scene) || !CHECK(subject_hold(&s)))
        return NAN;
    if (width != 0) {
        s.width = width;
        s.height = height;
    }
    struct present_options present = fail_options(&s, method);
    uint8_t *rgb = fail_take(&s, &present, 0, 0), *sharp = fail_sharp(&s, &present);
    if (rgb != NULL && sharp != NULL)
        worst = fail_difference(&s, rgb, sharp, fail_whole(&s));
    free(rgb);
    free(sharp);
    return worst;
}

/* In degrees; of half the exposure in 1/8 px, as the filter reads it. */
static double direction_error(const struct fail_method *method)
{
    struct subject s OWNED(subject_close) = { 0 };
    double worst = 0.0;
    bool ok = subject_open(&s, "fail/sweep");
    if (!ok)
        return NAN;
    for (int lap = 0; lap < FAIL_SWEEP_LAPS && ok; lap++) {
        struct present_options present = fail_options(&s, method);
        struct shot shot;
        double angle = 2 * PI * lap / FAIL_SWEEP_LAPS, vx = -cos(angle), vy = sin(angle);
        s.time = FAIL_TIME + 2 * lap / FAIL_FPS;
        ok = fail_look(&s, &present, &shot);
        for (int i = 0; ok && i < s.width * s.height; i++) {
            double x = shot.packed[2 * i], y = shot.packed[2 * i + 1];
            worst = fmax(worst, fabs(atan2(x * vy - y * vx, x * vx + y * vy)) * 180 / PI);
        }
        if (ok)
            shot_free(&shot);
    }
    return ok ? worst : NAN;
}

static void velocity_steps(const struct fail_method *method, double number[])
{
    number[0] = held_difference("fail/still", method, 0, 0);
    if (method->method == SMEAR_RECONSTRUCT)
        number[1] = direction_error(method);
}

/* ------------------------------------------------------------------ 25 depth quantisation */

/* The largest amplitude of a period of 2 to 16 rows in the mean error of the ground's rows. */
static void ground(const struct fail_method *method, double number[])
{
    enum { TOP = 40, ROWS = 80 };
    struct subject s OWNED(subject_close) = { 0 };
    double row[ROWS];
    END_UNLESS(subject_open(&s, "fail/ground"));
    struct present_options present = fail_options(&s, method);
    uint8_t *rgb = fail_take(&s, &present, 0, 0);
    const struct ref_truth *truth = truth_of(&s, &present, FAIL_INSTANTS);
    if (rgb != NULL && truth != NULL) {
        number[0] = 0.0;
        for (int y = 0; y < ROWS; y++) {
            row[y] = 0.0;
            for (int x = 0; x < s.width; x++) {
                int at = 3 * ((TOP + y) * s.width + x) + 1;
                row[y] += (rgb[at] - truth->code[at]) / s.width;
            }
        }
        for (int k = ROWS / 16; k <= ROWS / 2; k++) {
            double c = 0.0, d = 0.0;
            for (int y = 0; y < ROWS; y++) {
                c += row[y] * cos(2 * PI * k * y / ROWS) * 2 / ROWS;
                d += row[y] * sin(2 * PI * k * y / ROWS) * 2 / ROWS;
            }
            number[0] = fmax(number[0], hypot(c, d));
        }
    }
    free(rgb);
}

/* ------------------------------------------------------------------ what an exposure can show */

/* How far a picture goes beyond the colours, channel by channel, that its scene has at any of 9
 * instants of the exposure. */
static double beyond_colors(struct subject *s, const struct present_options *present,
                            const uint8_t *rgb)
{
    enum { INSTANTS = 9 };
    int low[3] = {255, 255, 255}, high[3] = {0, 0, 0}, worst = 0;
    double open, close, time = s->time;
    present_exposure(time, present, &open, &close);
    for (int i = 0; i < INSTANTS; i++) {
        s->time = open + (close - open) * i / (INSTANTS - 1);
        uint8_t *sharp = fail_sharp(s, present);
        for (int k = 0; sharp != NULL && k < s->width * s->height * 3; k++) {
            low[k % 3] = sharp[k] < low[k % 3] ? sharp[k] : low[k % 3];
            high[k % 3] = sharp[k] > high[k % 3] ? sharp[k] : high[k % 3];
        }
        free(sharp);
    }
    s->time = time;
    for (int k = 0; k < s->width * s->height * 3; k++) {
        int d = rgb[k] < low[k % 3] ? low[k % 3] - rgb[k] : rgb[k] - high[k % 3];
        worst = d > worst ? d : worst;
    }
    return worst;
}

static double moving_beyond(const char *scene, const struct fail_method *method, int width,
                            int height)
{
    struct subject s OWNED(subject_close) = { 0 };
    double worst = NAN;
    if (!subject_open(&s, scene))
        return NAN;
    if (width != 0) {
        s.width = width;
        s.height = height;
    }
    struct present_options present = fail_options(&s, method);
    uint8_t *rgb = fail_take(&s, &present, 0, 0);
    if (rgb != NULL)
        worst = beyond_colors(&s, &present, rgb);
    free(rgb);
    return worst;
}

/* ------------------------------------------------------------------ 26 small targets */

static void tiny(const struct fail_method *method, double number[])
{
    static const int size[][2] = {{7, 5}, {1, 1}, {1, 5}, {1, 16}, {1, 97}, {16, 1}, {97, 1},
                                  {2, 3}, {15, 17}, {17, 15}};
    double held = 0.0, beyond = 0.0;
    for (size_t i = 0; i < sizeof size / sizeof *size; i++) {
        double h = held_difference("fail/tiny", method, size[i][0], size[i][1]);
        double b = moving_beyond("fail/tiny", method, size[i][0], size[i][1]);
        if (isnan(h) || isnan(b))
            return;
        held = fmax(held, h);
        beyond = fmax(beyond, b);
    }
    number[0] = held;
    number[1] = beyond;
    struct subject s OWNED(subject_close) = { 0 };
    END_UNLESS(subject_open(&s, "fail/tiny"));
    s.width = 7;
    s.height = 5;
    struct present_options present = fail_options(&s, method);
    uint8_t *rgb = fail_take(&s, &present, 0, 0);
    const struct ref_truth *truth = truth_of(&s, &present, FAIL_INSTANTS);
    if (rgb != NULL && truth != NULL)
        number[2] = fail_rmse(&s, rgb, truth, fail_whole(&s));
    free(rgb);
}

/* ------------------------------------------------------------------ 33 highlights */

static void highlight(const struct fail_method *method, double number[])
{
    (void)method;
    (void)number;
}

/* ------------------------------------------------------------------ 34 layers */

static void layers(const struct fail_method *method, double number[])
{
    struct subject s OWNED(subject_close) = { 0 };
    END_UNLESS(subject_open(&s, "fail/layers"));
    struct present_options present = fail_options(&s, method);
    uint8_t *rgb = fail_take(&s, &present, 0, 0), *sharp = fail_sharp(&s, &present);
    if (rgb != NULL && sharp != NULL) {
        number[0] = beyond_colors(&s, &present, rgb);
        number[1] = fail_difference(&s, rgb, sharp,
                                    fail_around(&s, -FAIL_LAYER_BAR_X, 0, FAIL_LAYER_BAR / 2, 70));
    }
    free(rgb);
    free(sharp);
}

/* ------------------------------------------------------------------ 36 large coordinates */

static void far_away(const struct fail_method *method, double number[])
{
    static const int offset[][3] = {{10000, -10000, 10000}, {-10000, 3, 9999}};
    struct subject s OWNED(subject_close) = { 0 };
    END_UNLESS(subject_open(&s, "fail/far"));
    struct present_options present = fail_options(&s, method);
    uint8_t *here = fail_take(&s, &present, 0, 0);
    double worst = 0.0;
    for (size_t i = 0; i < sizeof offset / sizeof *offset; i++) {
        uint8_t *away = fail_take_away(&s, &present, offset[i]);
        worst = here != NULL && away != NULL
            ? fmax(worst, fail_difference(&s, here, away, fail_whole(&s))) : NAN;
        free(away);
    }
    number[0] = worst;
    free(here);
}

/* ------------------------------------------------------------------ every scene */

static void every_scene(const struct fail_method *method, double number[])
{
    double held = 0.0, beyond = 0.0;
    for (int i = 0; i < scene_catalog_count; i++) {
        const char *name = scene_catalog[i].name;
        if (strncmp(name, "fail/", 5) != 0)
            continue;
        double h = held_difference(name, method, 0, 0), b = moving_beyond(name, method, 0, 0);
        if (isnan(h) || isnan(b))
            return;
        if (h > 0 || b > 1)
            say("  %s, %s: %g codes when held, %g beyond its colours\n", name, method->name, h, b);
        held = fmax(held, h);
        beyond = fmax(beyond, b);
    }
    number[0] = held;
    number[1] = beyond;
}

/* ------------------------------------------------------------------ trailing, leading */

/* Larger of the errors of trailing and leading exposures, with the pose a frame ago and with those
 * of the shutter. */
static void exposures(const struct fail_method *method, double number[])
{
    struct subject s OWNED(subject_close) = { 0 };
    END_UNLESS(subject_open(&s, "fail/edge"));
    for (int i = 0; i < 2; i++) {
        double worst = 0.0;
        for (int k = 0; k < 2; k++) {
            struct present_options present = fail_options(&s, method);
            present.shutter_poses = i == 1;
            present.exposure = k == 0 ? SMEAR_TRAILING : SMEAR_LEADING;
            uint8_t *rgb = fail_take(&s, &present, 0, 0);
            const struct ref_truth *truth = truth_of(&s, &present, FAIL_INSTANTS);
            worst = rgb != NULL && truth != NULL
                ? fmax(worst, fail_rmse(&s, rgb, truth, fail_whole(&s))) : NAN;
            free(rgb);
        }
        number[i] = worst;
    }
}

/* ------------------------------------------------------------------ rows */

#define VELOCITIES "keeps no velocity of a pixel"

const struct fail_row fail_other_rows[] = {
    {17, "billboards, vertex animation", billboard, {
        {"rmse", "codes", 2.0, .known = {[NONE] = 7.4, [PLAIN] = 4.4, [MENDED] = 4.1}},
        {"velocity", "px", 0.5, .only = FILTERS, .otherwise = VELOCITIES},
    }, "the application gives the earlier pose and the earlier positions"},
    {18, "moving light", light, {
        {"rmse", "codes", 2.0,
         .known = {[NONE] = 14, [ACCUMULATE] = 14, [PLAIN] = 14, [MENDED] = 14, [SUBFRAMES] = 14,
         [TIMEMASK] = 14, [AUTO] = 14, [FINE] = 14}},
        {"blur where nothing moves", "codes", 0.0, .known = {0}},
    }, "a frame is lit once, at its own instant, by every method"},
    {24, "velocity quantisation", velocity_steps, {
        {"still scene", "codes", 0.0, .hard = true},
        {"direction of 8 to 18 px", "degrees", 1.0, .only = FILTERS, .otherwise = VELOCITIES},
    }, NULL},
    {25, "depth quantisation", ground, {
        {"bands of 2 to 16 rows in the error", "codes", 1.0, .known = {0}},
    }, NULL},
    {26, "small targets", tiny, {
        {"held still, 1x1 to 97x1", "codes", 0.0, .hard = true},
        {"beyond the scene's colours", "codes", 1.0, .hard = true},
        {"rmse at 7x5", "codes", 2.0,
         .known = {[NONE] = 17, [PLAIN] = 17, [MENDED] = 17, [SUBFRAMES] = 2.9}},
    }, NULL},
    {32, "skinned, stretched, other topology", deformed, {
        {"rmse", "codes", 2.0, .known = {[NONE] = 6.3, [PLAIN] = 4, [MENDED] = 3.9}},
        {"other vertex count: not the draw's motion", "codes", 0.0, .known = {0}},
        {"velocity", "px", 0.5, .only = FILTERS, .otherwise = VELOCITIES},
    }, NULL},
    {33, "highlights beyond white", highlight, {
        {"peak of the streak", "%", 5.0,
         .only = NOBODY, .otherwise = "colours end at white: there is no HDR"},
    }, NULL},
    {34, "behind and in front, in one layer", layers, {
        {"beyond the colours of the sources", "codes", 1.0, .known = {0}},
        {"still bar in front", "codes", 1.0, .known = {[PLAIN] = 140}},
    }, NULL},
    {36, "large coordinates", far_away, {
        {"10000 units away", "codes", 1.0, .hard = true},
    }, NULL},
    {0, "trailing and leading exposures", exposures, {
        {"rmse, the pose a frame ago", "codes", 2.0,
         .known = {[NONE] = 52, [PLAIN] = 8.4, [MENDED] = 5}},
        {"rmse, poses of the shutter", "codes", 2.0,
         .known = {[NONE] = 52, [PLAIN] = 8.4, [MENDED] = 5}},
    }, NULL},
    {0, "every scene of the catalogue", every_scene, {
        {"held still", "codes", 0.0,
         .known = {[ACCUMULATE] = 1.1, [PLAIN] = 1.1, [MENDED] = 1.1}, .hard = true},
        {"beyond the scene's colours", "codes", 1.0, .hard = true},
    }, NULL},
};

const int fail_other_count = sizeof fail_other_rows / sizeof *fail_other_rows;
