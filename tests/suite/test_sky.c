/* SPDX-License-Identifier: MIT */
/* test_sky.c - skies against the elevation of every pixel in doubles, sharp and the mean of instants; the same sky in every format,
 * however the frame is cut; what is refused. Host only. */
#include <smear_math.h>
#include <smear_scene.h>

#include "tests/rig.h"

enum { WIDTH = 240, HEIGHT = 240, PIXELS = WIDTH * HEIGHT, INSTANTS = 256, ALL_METHODS = (1 << SMEAR_METHOD_COUNT) - 2 };

static const uint32_t colors[3][4] = { { 0x3060b0, 0xc0d8f0, 0x708060, 0x303820 }, { 0x000000, 0xffffff, 0x000000, 0xffffff },
                                       { 0x203060, 0xf0a060, 0xf0a060, 0x102018 } };

static smear_sky sky_of(int k) { return (smear_sky)SMEAR_SKY(colors[k][0], colors[k][1], colors[k][2], colors[k][3]); }

static smear_desc desc_of(uint32_t methods)
{
    return (smear_desc){ .width = WIDTH, .height = HEIGHT, .format = SMEAR_XRGB8888, .reach = 12,
                         .methods = (uint16_t)(methods & ~(1u << SMEAR_DEFAULT_METHOD)) };
}

/* ------------------------------------------------------------------ in doubles */

/* How a camera turns: up, and about its own axis. */
struct turn {
    double pitch, roll, pitch_step, roll_step;          /* at shutter open and close: less and more by a step */
    double fov;
    bool flat;
};

static void basis_of(double out[9], double pitch, double roll)
{
    const double c = cos(pitch), s = sin(pitch), a = cos(roll), b = sin(roll);
    const double m[9] = { a, -b, 0, c * b, c * a, -s, s * b, s * a, c };
    memcpy(out, m, sizeof m);
}

static smear_camera camera_of(const struct turn *t, double at)
{
    double basis[9];
    smear_camera camera = { .near_plane = q16(0.1), .focal = q16(1 / tan(t->fov / 2)) };
    basis_of(basis, t->pitch + at * t->pitch_step, t->roll + at * t->roll_step);
    for (int i = 0; i < 9; i++)
        camera.pose.basis[i] = q24(basis[i]);
    if (t->flat) {
        camera.focal = 0;
        camera.half_height = q16(2);
        camera.far_plane = q16(20);
    }
    return camera;
}

/* The colour of one point of the picture at one instant. */
static void color_at(double out[3], const struct turn *t, const double basis[9], const uint32_t color[4], double x, double y)
{
    const double k = t->flat ? 0 : tan(t->fov / 2), right = (2 * x - WIDTH) / HEIGHT * k, up = (HEIGHT - 2 * y) / HEIGHT * k;
    const double sine = (basis[3] * right + basis[4] * up - basis[5]) / sqrt(right * right + up * up + 1);
    const uint32_t near_color = sine >= 0 ? color[1] : color[2], far_color = sine >= 0 ? color[0] : color[3];
    for (int c = 0; c < 3; c++) {
        const double a = near_color >> (16 - 8 * c) & 255u, b = far_color >> (16 - 8 * c) & 255u;
        out[c] = a + (b - a) * fabs(sine);
    }
}

/* The mean of a pixel over the exposure, codes: points in it where the horizon is near. */
static void mean_at(double out[3], const struct turn *t, const double (*basis)[9], int instants, const uint32_t color[4], int x, int y,
                    bool linear)
{
    const int points = instants == 1 ? 16 : 2;
    double sum[3] = { 0 };
    for (int k = 0; k < instants; k++)
        for (int i = 0; i < points * points; i++) {
            double one[3];
            color_at(one, t, basis[k], color, x + (i % points + 0.5) / points, y + (i / points + 0.5) / points);
            for (int c = 0; c < 3; c++)
                sum[c] += linear ? light_of(one[c]) : one[c];
        }
    for (int c = 0; c < 3; c++) {
        const double mean = sum[c] / (instants * points * points);
        out[c] = linear ? code_of(mean) : mean;
    }
}

enum { EVERY_ROW = 3, EVERY_COLUMN = 7, SAMPLES = (HEIGHT / EVERY_ROW) * (WIDTH / EVERY_COLUMN) };

/* What some of the pixels are. */
struct truth {
    const struct turn *turn;
    int instants, sky;
    bool linear;
    double mean[SAMPLES][3];
};

static void find_truth(struct truth *out, const struct turn *t, int instants, int k, bool linear)
{
    static double basis[INSTANTS][9];
    if (out->turn == t && out->instants == instants && out->sky == k && out->linear == linear)
        return;
    for (int i = 0; i < instants; i++) {
        const double at = (2.0 * i + 1) / instants - 1;
        basis_of(basis[i], t->pitch + at * t->pitch_step, t->roll + at * t->roll_step);
    }
    for (int i = 0; i < SAMPLES; i++)
        mean_at(out->mean[i], t, (const double (*)[9])basis, instants, colors[k], i % (WIDTH / EVERY_COLUMN) * EVERY_COLUMN,
                i / (WIDTH / EVERY_COLUMN) * EVERY_ROW, linear);
    out->turn = t;
    out->instants = instants;
    out->sky = k;
    out->linear = linear;
}

/* By how much a picture is off: the root of the mean square, codes. */
static double error_of(const uint32_t *got, const struct truth *truth)
{
    double sum = 0;
    for (int i = 0; i < SAMPLES; i++) {
        const uint32_t pixel = got[i / (WIDTH / EVERY_COLUMN) * EVERY_ROW * WIDTH + i % (WIDTH / EVERY_COLUMN) * EVERY_COLUMN];
        for (int c = 0; c < 3; c++)
            sum += pow(truth->mean[i][c] - (double)(pixel >> (16 - 8 * c) & 255u), 2);
    }
    return sqrt(sum / (3 * SAMPLES));
}

static const struct turn turns[] = {
    { 0, 0, 0, 0, 1.05, false },           { 0.2, 0, 0, 0, 1.05, false },          { -0.1, 0.5, 0, 0, 0.8, false },
    { 1.3, 0.2, 0, 0, 2.0, false },        { 0.3, 1.5, 0, 0, 1.5, false },         { 0.4, 0.3, 0, 0, 1.0, true },
    { 0.05, 0, 0.03, 0, 1.05, false },     { 0.1, 0.4, 0.05, 0.05, 1.05, false },  { -0.3, -1.2, 0.02, 0.12, 0.9, false },
    { 0.0, 0.1, 0.002, 0.001, 1.05, false },  { 1.5707963, 0, 0, 0, 1.05, true },       { -1.5707963, 0.3, 0, 0, 1.05, true }
};

static void check_turn(const struct turn *t, int method, bool linear, int k, uint16_t target)
{
    const bool moves = t->pitch_step != 0 || t->roll_step != 0;
    smear_sky sky = sky_of(k);
    const smear_scene scene = { .sky = &sky };
    const smear_camera now = camera_of(t, 0), open = camera_of(t, -1), close = camera_of(t, 1);
    const smear_frame frame = { .camera = &now, .open = moves ? &open : NULL, .close = moves ? &close : NULL, .shutter.poses = moves,
                                .method = (uint8_t)method, .scene = &scene, .clear = 0xff00ff, .target = target,
                                .samples = method == SMEAR_ACCUMULATE ? 32 : 0,
                                .light_space = (uint8_t)(linear ? SMEAR_LIGHT_LINEAR : SMEAR_LIGHT_ENCODED) };
    const smear_desc desc = desc_of(ALL_METHODS);
    RIG(r, &desc, false);
    CHECK_EQ(rig_frame(&r, &frame, NULL, 0), SMEAR_OK);
    static struct truth truth;
    find_truth(&truth, t, moves && method != SMEAR_NONE ? INSTANTS : 1, k, linear);
    const double error = error_of((const uint32_t *)(const void *)r.picture, &truth);
    /* A horizon that these methods blur along each pixel's own way. */
    if (!CHECK(error < (method == SMEAR_CAMERA || method == SMEAR_RECONSTRUCT ? 5 : 1.5)) || getenv("SMEAR_SHOW") != NULL)
        printf("  turn %d method %d sky %d %s: %.3f\n", (int)(t - turns), method, k, linear ? "linear" : "encoded", error);
}

static void test_each_pixel_has_the_color_of_its_elevation(void)
{
    for (unsigned i = 0; i < sizeof turns / sizeof *turns; i++)
        for (int k = 0; k < 3; k++)
            for (int linear = 0; linear < 2; linear++)
                check_turn(&turns[i], SMEAR_NONE, linear != 0, k, 0);
}

static void test_every_method_blurs_it_with_the_camera(void)
{
    static const uint16_t targets[] = { 0, SMEAR_DRAFT, SMEAR_SKETCH };
    for (unsigned i = 0; i < sizeof turns / sizeof *turns; i++)
        for (int method = SMEAR_NONE + 1; method < SMEAR_METHOD_COUNT; method++)
            for (int k = 0; k < (method == SMEAR_AUTO ? 3 : 1); k++)
                check_turn(&turns[i], method, i % 2 == 0, method == SMEAR_AUTO ? 0 : (int)i % 3, targets[k]);
}

/* Behind draws, before a camera that moves: as near to the mean of 64 instants as each target asks. */
static void test_sketches_and_drafts_have_it_behind_their_draws(void)
{
    static uint32_t truth[PIXELS];
    static const uint16_t target[] = { 0, SMEAR_BALANCED, SMEAR_DRAFT, SMEAR_SKETCH };
    static const double most[] = { 0, 2.5, 6, 10 };
    const smear_desc desc = desc_of(ALL_METHODS | SMEAR_SET_SKETCH);
    for (int i = 0; i < 4; i++) {
        struct scene s;
        smear_sky sky = sky_of(0);
        const smear_scene extras = { .sky = &sky };
        make_scene(&s, 0.2, i == 0 ? SMEAR_ACCUMULATE : SMEAR_AUTO);
        smear_camera open = s.camera, close = s.camera;
        open.pose = smear_compose(open.pose, smear_rotate_x(SMEAR_DEGREES(3)));
        close.pose = smear_compose(close.pose, smear_rotate_x(SMEAR_DEGREES(357)));
        s.frame.open = &open;
        s.frame.close = &close;
        s.frame.shutter.poses = 1;
        s.frame.scene = &extras;
        s.frame.target = target[i];
        s.frame.samples = i == 0 ? 64 : 0;
        RIG(r, &desc, false);
        CHECK_EQ(rig_frame(&r, &s.frame, s.draw, SCENE_DRAWS), SMEAR_OK);
        const uint32_t *got = (const uint32_t *)(const void *)r.picture;
        if (i == 0)
            memcpy(truth, got, sizeof truth);
        const double error = rms_of(truth, got, PIXELS);
        if (!CHECK(error <= most[i]) || getenv("SMEAR_SHOW") != NULL)
            printf("  target %d: %.3f\n", target[i], error);
    }
}

#include "build/suites/sky.h"
