/* SPDX-License-Identifier: MIT */
/* test_path.c - places between three instants: exact at these, to nearest between. */
#include "geometry/path.h"

#include "geometry/transform.h"

#include "tests/random.h"
#include "tests/test.h"

enum { WORDS = 12, SHIFT = 31 };

/* A coordinate within the guard band of a frame of 2048 pixels. */
static int32_t random_coordinate(void)
{
    const int32_t guard = SMEAR_GUARD_PX << 8;
    uint32_t kind = random_u32() % 4u;
    int32_t centre = 1024 << 8;
    return kind == 0 ? centre - guard : kind == 1 ? centre + guard
                                                  : centre - guard + (int32_t)(random_u32() % (uint32_t)(2 * guard + 1));
}

static int32_t random_depth(void)
{
    uint32_t kind = random_u32() % 4u;
    return kind == 0 ? SMEAR_DEPTH_MIN : kind == 1 ? SMEAR_DEPTH_MAX
                                                   : (int32_t)(random_u32() % (uint32_t)SMEAR_DEPTH_MAX) + 1;
}

/* The same in 64 bits, times 2^31: middle 2^31 + slope u 2^15 + bend u^2, u in q15. */
static int64_t exact(int32_t open, int32_t middle, int32_t close, int32_t time)
{
    int64_t u = time - SHUTTER_CLOSE / 2, slope = (int64_t)close - open, bend = (int64_t)open + close - 2 * (int64_t)middle;
    return slope * u * 32768 + bend * u * u;        /* less the middle */
}

static int64_t distance(int64_t a, int64_t b)
{
    return a > b ? a - b : b - a;
}

static void test_the_three_places_are_met(void)
{
    for (int i = 0; i < 2000; i++) {
        int32_t p[3], d[3];
        for (int k = 0; k < 3; k++) {
            p[k] = random_coordinate();
            d[k] = random_depth();
        }
        for (int k = 0; k < 3; k++) {
            int32_t u = path_phase(k * SHUTTER_CLOSE / 2);
            CHECK_EQ(path_coordinate(p[0], p[1], p[2], u), p[k]);
            CHECK(distance(path_depth(d[0], d[1], d[2], u), d[k]) <= 8);
        }
    }
}

static void test_coordinates_are_the_nearest_on_the_parabola(void)
{
    random_state = 1;
    int64_t sum = 0, most = 0;
    for (int i = 0; i < 20000; i++) {
        int32_t p[3];
        for (int k = 0; k < 3; k++)
            p[k] = random_coordinate();
        int32_t time = (int32_t)(random_u32() % (SHUTTER_CLOSE + 1u));
        int64_t is = (int64_t)(path_coordinate(p[0], p[1], p[2], path_phase(time)) - p[1]) * ((int64_t)1 << SHIFT);
        int64_t error = is - exact(p[0], p[1], p[2], time);
        sum += error >> 16;
        most = distance(error, 0) > most ? distance(error, 0) : most;
    }
    CHECK(most <= ((int64_t)1 << (SHIFT - 1)) + ((int64_t)1 << (SHIFT - 6)));   /* half a step and a 64th */
    CHECK(distance(sum / 20000, 0) <= 1 << (SHIFT - 16 - 6));                   /* no drift */
}

static void test_depths_are_near_the_parabola(void)
{
    random_state = 2;
    for (int i = 0; i < 20000; i++) {
        int32_t d[3];
        for (int k = 0; k < 3; k++)
            d[k] = random_depth();
        int32_t time = (int32_t)(random_u32() % (SHUTTER_CLOSE + 1u));
        int64_t is = ((int64_t)path_depth(d[0], d[1], d[2], path_phase(time)) - d[1]) * ((int64_t)1 << (SHIFT - 8));
        CHECK(distance(is, exact(d[0], d[1], d[2], time) / 256) <= (int64_t)12 << (SHIFT - 8));
    }
}

static void test_what_stands_still_keeps_its_place(void)
{
    random_state = 3;
    for (int i = 0; i < 2000; i++) {
        int32_t p = random_coordinate(), d = random_depth(), u = path_phase((int32_t)(random_u32() % (SHUTTER_CLOSE + 1u)));
        CHECK_EQ(path_coordinate(p, p, p, u), p);
        CHECK_EQ(path_depth(d, d, d, u), d);
    }
}

static void test_records_are_read_at_their_offsets(void)
{
    struct smear_segment s = { .motion = 5 };
    const int32_t record[WORDS] = { 100, 200, 3000, -1, -1, 90, 180, 1000, 110, 220, 5000 };
    int32_t at[3];
    for (int k = 0; k < 3; k++) {
        path_place(at, record, record + s.motion, path_phase(k * SHUTTER_CLOSE / 2));
        CHECK_EQ(at[PATH_X], 90 + 10 * k);
        CHECK_EQ(at[PATH_Y], 180 + 20 * k);
        CHECK_EQ(at[PATH_DEPTH], 1000 + 2000 * k);
    }
}

#include "build/suites/path.h"
