/* SPDX-License-Identifier: MIT */
/* test_noise.c - walls of noise, of grains from one pixel to eight, that travel past the camera by up to three views: as it slides,
 * turns, turns behind a long lens or rolls. The default method is near the mean of exact instants, which nearly is one grey.
 * SMEAR_CASES=1000 draws as many; SMEAR_FIRST=17 begins with that one, and names each. */
#include "tests/ref/sweep.h"

enum { WIDTH = 160, ROWS = 120, BYTES = WIDTH * ROWS * 4, TEXELS = 256, PANELS = 12 };

enum kind { SLIDE, TURN, LENS, ROLL, KINDS };

static const char *const kind_name[KINDS] = { "slide", "turn", "long lens", "roll" };

/* A case: grain and travel in pixels, angles in radians. */
struct pass {
    enum kind kind;
    double grain, travel, heading, yaw;
    double scale; /* pixels that a unit has in the middle of the wall, which is one unit away */
    bool linear, smooth; /* light; texels */
};

static uint32_t texels[TEXELS * TEXELS];

static struct pass random_pass(void)
{
    struct pass p = { .kind = (enum kind)(random_u32() % KINDS), .linear = !chance(4), .smooth = chance(4) };
    p.grain = uniform(1, 8);
    p.travel = 32 * pow(2, uniform(0, 4));
    p.heading = chance(2) ? 3.14159265 / 2 * between(0, 3) : uniform(-3.1, 3.1);
    p.yaw = chance(2) ? 0 : uniform(-0.3, 0.3);
    p.scale = ROWS / 2 * (p.kind == LENS ? 8 : 1.25);
    if (p.kind == TURN)
        p.travel = fmin(p.travel, 1.5 * p.scale);
    else if (p.kind == ROLL)
        p.travel = fmin(p.travel, 1.5 * WIDTH / 2);
    const bool grey = chance(2);
    for (int i = 0; i < TEXELS * TEXELS; i++)
        texels[i] = 0xff000000u | (grey ? 0x10101u * (random_u32() >> 24) : random_u32());
    return p;
}

/* The camera where `part` of the exposure's way is behind it: -0.5 at open, 0.5 at close. */
static smear_camera camera_of(const struct pass *p, double part)
{
    const double way = p->travel * part / (p->kind == ROLL ? WIDTH / 2 : p->scale);
    smear_camera c = { .focal = (int32_t)(p->scale / (ROWS / 2) * 65536), .near_plane = 6554, .far_plane = 100 * 65536 };
    if (p->kind == SLIDE)
        c.pose = pose_at(way * cos(p->heading), way * sin(p->heading), 0, p->yaw, 0);
    else
        c.pose = pose_at(0, 0, 0, p->yaw + (p->kind == ROLL ? 0 : way), 0);
    if (p->kind == ROLL) {
        const smear_transform eye = c.pose;
        for (int i = 0; i < 9; i += 3) {
            c.pose.basis[i] = (int32_t)lrint(eye.basis[i] * cos(way) + eye.basis[i + 1] * sin(way));
            c.pose.basis[i + 1] = (int32_t)lrint(eye.basis[i + 1] * cos(way) - eye.basis[i] * sin(way));
        }
    }
    return c;
}

static bool draw(struct rig *r, const void *scene, uint8_t method, uint16_t target, double part)
{
    enum { UNIT = 1024, HIGH = 2, WIDE = 8 }; /* steps of a unit; units to either side */
    static const smear_texture texture = { .texels = texels, .width = TEXELS, .height = TEXELS };
    const struct pass *p = scene;
    const smear_material material = { .texture = &texture, .bilinear = p->smooth, .unlit = 1, .double_sided = 1 };
    static const smear_transform still = SMEAR_IDENTITY;
    static int16_t position[PANELS][12], uv[PANELS][8];
    static smear_mesh mesh[PANELS];
    smear_draw draws[PANELS];
    const bool round = p->kind == TURN || p->kind == LENS;
    const int panels = round ? PANELS : 1;
    const double half = 3.14159265358979 / PANELS, repeats = p->scale / p->grain / TEXELS * 2048;  /* of a unit */
    for (int s = 0; s < panels; s++) {
        for (int k = 0; k < 4; k++) {
            const int right = k == 1 || k == 2, up = k >= 2 ? 1 : -1;
            const double angle = half * (2 * s + (right ? 1 : -1)), high = round ? HIGH : WIDE;
            const double x = round ? sin(angle) / cos(half) : right ? WIDE : -WIDE, z = round ? -cos(angle) / cos(half) : -1;
            const double u = round ? 2 * tan(half) * right : x;
            position[s][3 * k] = (int16_t)lrint(x * UNIT);
            position[s][3 * k + 1] = (int16_t)lrint(up * high * UNIT);
            position[s][3 * k + 2] = (int16_t)lrint(z * UNIT);
            uv[s][2 * k] = (int16_t)lrint(u * repeats);
            uv[s][2 * k + 1] = (int16_t)lrint(up * high * repeats);
        }
        mesh[s] = (smear_mesh){ .position = position[s], .uv = uv[s], .vertex_count = 4, .index = square_index, .triangle_count = 2,
                                .shift = 10, .uv_shift = 11 };
        draws[s] = (smear_draw){ .id = 1 + (uint32_t)s, .mesh = &mesh[s], .material = &material, .now = &still };
    }
    const bool sharp = method == SMEAR_NONE;
    const smear_camera now = camera_of(p, sharp ? part : 0), open = camera_of(p, -0.5), close = camera_of(p, 0.5);
    const smear_frame frame = { .camera = &now, .open = sharp ? NULL : &open, .close = sharp ? NULL : &close, .method = method,
                                .light_space = p->linear ? SMEAR_LIGHT_LINEAR : SMEAR_LIGHT_ENCODED, .cut = sharp,
                                .shutter = { .poses = 1 }, .target = target };
    return CHECK_EQ(rig_frame(r, &frame, draws, panels), SMEAR_OK);
}

/* Finds how far the method's picture is from the mean of exact instants, and how far one instant is. */
static bool measure(double *error, double *sharp_error, struct rig *r, const struct pass *p)
{
    static double mean[BYTES];
    if (!sweep_mean(mean, r, draw, p, 512, p->linear) || !draw(r, p, SMEAR_NONE, 0, 0))   /* of 256 the finest are up to a code off */
        return false;
    *sharp_error = sweep_error(r, mean);
    if (!draw(r, p, SMEAR_AUTO, 0, 0))
        return false;
    *error = sweep_error(r, mean);
    return true;
}

static void test_walls_of_noise_are_near_the_exact_mean(void)
{
    static double error[SWEEP_MOST];
    const struct sweep sweep = sweep_of(24, 300);
    smear_desc desc = small_desc(WIDTH, ROWS);
    desc.methods = SMEAR_SET(SMEAR_AUTO);
    desc.max_draws = PANELS;
    RIG(r, &desc, false);
    double sharp = 0;
    for (uint32_t i = 0; i < sweep.count; i++) {
        double apart = 0;
        sweep_seed(sweep.first + i);
        const struct pass p = random_pass();
        END_UNLESS(measure(&error[i], &apart, &r, &p));
        sharp += apart / sweep.count;
        if (sweep.tells)
            printf("  %.2f codes, sharp %.1f: case %u: %s, grain %.1f travels %.0f px, heading %.2f yaw %.2f%s%s\n", error[i], apart,
                   (unsigned)(sweep.first + i), kind_name[p.kind], p.grain, p.travel, p.heading, p.yaw, p.linear ? ", linear" : "",
                   p.smooth ? ", smooth" : "");
    }
    printf("  walls of noise: sharp ones are %.1f codes off\n", sharp);
    sweep_check(error, sweep.count, "off the exact mean", 1.9, 3);
}

#include "build/suites/noise.h"
