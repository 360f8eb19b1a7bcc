/* SPDX-License-Identifier: MIT */
/* test_holds.c - a vertex that keeps a path on the screen is there where it is in space, at any instant. */
#define smear_assemble_path assemble_path_of_this_suite
#include "geometry/assemble_path.c"

#include "tests/random.h"
#include "tests/test.h"

#include <math.h>

void suite_holds(void);

enum { PHASES = 9, HALF_WIDTH = 160, HALF_HEIGHT = 120 };

/* A vertex that goes straight before a camera: px from the frame's centre times its distance, and its distance in near distances. */
struct flight {
    double from[3], way[3];     /* in the middle; to close */
};

static double spread(double low, double high)
{
    return low * pow(high / low, uniform(0, 1));
}

static struct flight random_flight(void)
{
    struct flight f;
    f.from[2] = spread(1, 2000);
    const double reach = f.from[2] * spread(1, 1000), way = f.from[2] * spread(0.1, 500);
    for (int i = 0; i < 2; i++) {
        f.from[i] = uniform(-reach, reach);
        f.way[i] = uniform(-way, way);
    }
    f.way[2] = f.from[2] * spread(0.001, 0.9) * (chance(2) ? 1 : -1);
    return f;
}

/* Where it is at a phase: px from the frame's centre, and its depth, q11. */
static void exact_at(double out[3], const struct flight *f, double phase)
{
    const double w = f->from[2] + f->way[2] * phase;
    for (int i = 0; i < 2; i++)
        out[i] = (f->from[i] + f->way[i] * phase) / w;
    out[2] = SMEAR_DEPTH_MAX / w;
}

/* Finds the three places as they are kept. False where one is cut. */
static bool keys_of(struct smear_screen screen[KEYS], const struct flight *f)
{
    for (int key = 0; key < KEYS; key++) {
        const int phase = key == OPEN ? -1 : key == CLOSE ? 1 : 0;
        double at[3];
        exact_at(at, f, phase);
        if (f->from[2] + f->way[2] * phase < 1 || fabs(at[0]) >= SMEAR_GUARD_PX || fabs(at[1]) >= SMEAR_GUARD_PX)
            return false;
        screen[key].x = (int32_t)lrint(at[0] * 256) + HALF_WIDTH * 256;
        screen[key].y = (int32_t)lrint(at[1] * 256) + HALF_HEIGHT * 256;
        screen[key].depth = max_i32((int32_t)lrint(at[2]), SMEAR_DEPTH_MIN);
    }
    return true;
}

static void test_a_path_that_holds_is_within_half_a_pixel_of_space(void)
{
    int held = 0, refused = 0;
    double worst = 0, deepest = 0;
    random_state = 1;
    for (int n = 0; n < 100000; n++) {
        const struct flight f = random_flight();
        struct smear_screen screen[KEYS];
        if (!keys_of(screen, &f))
            continue;
        if (!holds(screen)) {
            refused++;
            continue;
        }
        held++;
        for (int i = 0; i < PHASES; i++) {
            const int32_t u = path_phase(i * (SHUTTER_CLOSE / (PHASES - 1)));
            double at[3];
            exact_at(at, &f, u / 1073741824.0);
            const double x = path_coordinate(screen[OPEN].x, screen[MIDDLE].x, screen[CLOSE].x, u) / 256.0 - HALF_WIDTH;
            const double y = path_coordinate(screen[OPEN].y, screen[MIDDLE].y, screen[CLOSE].y, u) / 256.0 - HALF_HEIGHT;
            const double depth = path_depth(screen[OPEN].depth, screen[MIDDLE].depth, screen[CLOSE].depth, u);
            worst = fmax(worst, fmax(fabs(x - at[0]), fabs(y - at[1])));
            deepest = fmax(deepest, fabs(depth - at[2]) / (at[2] + 8 * SMEAR_DEPTH_MIN));
            if (!CHECK_CLOSE(x, at[0], 0.5) || !CHECK_CLOSE(y, at[1], 0.5)) {
                CHECK_EQ(n, -1);
                return;
            }
        }
    }
    CHECK_CLOSE(deepest, 0, 0.02);
    CHECK(held > 10000);
    CHECK(refused > 10000);
}

/* What hardly moves on the screen keeps its path there, if its distance changes little. */
static void test_slow_things_keep_their_path_on_the_screen(void)
{
    random_state = 2;
    for (int n = 0; n < 20000; n++) {
        struct flight f = random_flight();
        struct smear_screen screen[KEYS];
        f.way[2] = f.from[2] * uniform(-0.03, 0.03);
        for (int i = 0; i < 2; i++)
            f.way[i] = f.from[i] * f.way[2] / f.from[2] + f.from[2] * uniform(-10, 10);
        if (keys_of(screen, &f) && !CHECK(holds(screen)))
            return;
    }
}

void suite_holds(void)
{
    RUN(test_a_path_that_holds_is_within_half_a_pixel_of_space);
    RUN(test_slow_things_keep_their_path_on_the_screen);
}
