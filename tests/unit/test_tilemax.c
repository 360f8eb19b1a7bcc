/* SPDX-License-Identifier: MIT */
/* test_tilemax.c - the longest velocity of a tile and of its neighbourhood: ties, borders, odd
 * sizes, the corner rule, the classes. Needs neither libc nor floating point. */
#include "filter/tilemax.h"

#include "tests/random.h"
#include "tests/test.h"

enum { MOST_PIXELS = 48 * 40, MOST_COLUMNS = 8 };

static int8_t narrow[MOST_PIXELS * 2];
static int16_t wide[MOST_PIXELS * 2];
static struct smear_tile_motion motion[3 * MOST_COLUMNS];
static struct smear_tile_neighborhood around[3 * MOST_COLUMNS];
static struct smear_window window;

/* A window of tiles of 8 px whose ring holds `ring` rows; still. */
static void make_window(int width, int height, int ring, bool is_wide)
{
    window = (struct smear_window){ .lag = 1,
        .width = width, .height = height, .tile = 8, .tile_shift = 3, .reach = 8,
        .columns = (width + 7) / 8, .rows = (height + 7) / 8, .ring = ring, .motion = motion, .around = around
    };
    window.velocity8 = is_wide ? NULL : narrow;
    window.velocity16 = is_wide ? wide : NULL;
    for (int i = 0; i < MOST_PIXELS * 2; i++)
        wide[i] = narrow[i] = 0;
    for (int i = 0; i < 3 * MOST_COLUMNS; i++)
        motion[i] = (struct smear_tile_motion){ 0, 0, 0, 0, 0, 0 };
}

static void set_velocity(int x, int y, int vx, int vy)
{
    int at = 2 * (y % window.ring * window.width + x);
    narrow[at] = (int8_t)vx;
    narrow[at + 1] = (int8_t)vy;
    wide[at] = (int16_t)vx;
    wide[at + 1] = (int16_t)vy;
}

static bool is_motion(int row, int column, int x, int y)
{
    const struct smear_tile_motion *m = &window_motion(&window, row)[column];
    return CHECK_EQ(m->x, x) && CHECK_EQ(m->y, y);
}

static void test_the_longest_wins_and_the_first_of_equals_in_row_order(void)
{
    for (int is_wide = 0; is_wide < 2; is_wide++) {
        make_window(16, 16, 16, is_wide);
        set_velocity(5, 2, 3, 4);
        set_velocity(1, 3, 5, 0);           /* as long, but a row below */
        set_velocity(7, 7, 4, -2);
        smear_tilemax(&window, 0, 0);
        is_motion(0, 0, 3, 4);
        set_velocity(4, 2, -4, -3);         /* as long, and left of it */
        smear_tilemax(&window, 0, 0);
        is_motion(0, 0, -4, -3);
        set_velocity(7, 7, 4, -4);
        smear_tilemax(&window, 0, 0);
        is_motion(0, 0, 4, -4);
        const struct smear_tile_motion *m = &window_motion(&window, 0)[0];
        CHECK_EQ(m->min_x, -4);
        CHECK_EQ(m->max_x, 5);
        CHECK_EQ(m->min_y, -4);
        CHECK_EQ(m->max_y, 4);
    }
}

static void test_a_tile_sees_its_own_pixels_only(void)
{
    make_window(24, 24, 24, false);
    for (int y = 0; y < 24; y++)
        for (int x = 0; x < 24; x++)
            if (x / 8 != 1 || y / 8 != 1)
                set_velocity(x, y, 100, 100);
    smear_tilemax(&window, 1, 1);
    is_motion(1, 1, 0, 0);
    set_velocity(8, 8, 1, 0);
    set_velocity(15, 15, 0, 2);
    smear_tilemax(&window, 1, 1);
    is_motion(1, 1, 0, 2);
}

static void test_tiles_at_the_right_and_the_bottom_end_with_the_frame(void)
{
    /* 17 x 11: the last column is a pixel wide, the last row three high; what lies beyond is not read. */
    make_window(17, 11, 11, true);
    set_velocity(16, 10, 7, -7);
    smear_tilemax(&window, 1, 2);
    is_motion(1, 2, 7, -7);
    CHECK_EQ(window_motion(&window, 1)[2].min_x, 0);
    smear_tilemax(&window, 1, 1);
    is_motion(1, 1, 0, 0);
    make_window(1, 1, 1, false);
    set_velocity(0, 0, -3, 1);
    smear_tilemax(&window, 0, 0);
    is_motion(0, 0, -3, 1);
    const struct smear_tile_motion *m = &window_motion(&window, 0)[0];
    CHECK(m->min_x == -3 && m->max_x == -3 && m->min_y == 1 && m->max_y == 1);
}

static void test_rows_are_found_around_the_ring(void)
{
    /* 40 rows in a ring of 20: tile row 4 lies at slots 12 .. 19, row 3 at 4 .. 11. */
    make_window(16, 40, 20, false);
    for (int y = 24; y < 40; y++)
        set_velocity(3, y, y, 0);
    smear_tilemax(&window, 4, 0);
    is_motion(4, 0, 39, 0);
    CHECK_EQ(window_motion(&window, 4)[0].min_x, 0);
    smear_tilemax(&window, 3, 0);
    is_motion(3, 0, 31, 0);
}

static void test_long_velocities_do_not_overflow(void)
{
    make_window(8, 8, 8, true);
    set_velocity(2, 2, 512, 0);
    set_velocity(3, 3, -362, -363);
    smear_tilemax(&window, 0, 0);
    is_motion(0, 0, -362, -363);
}

/* ------------------------------------------------------------------ neighbourhoods */

static void set_motion(int row, int column, int x, int y)
{
    window_motion(&window, row)[column] = (struct smear_tile_motion){
        (int16_t)x, (int16_t)y, (int16_t)x, (int16_t)x, (int16_t)y, (int16_t)y
    };
}

static const struct smear_tile_neighborhood *neighborhood_of(int row, int column, int known, bool corner)
{
    smear_neighbormax_row(&window, row, known, corner);
    return &window_around(&window, row)[column];
}

/* 1/8 px to 1/256 px; a neighbour's is 1.01 times shorter. */
static int32_t shortened(int v)
{
    /* v 32 / 1.01 to nearest = floor((v 6400 + 101) / 202) */
    int32_t n = v * 6400 + 101;
    return n >= 0 ? n / 202 : -((-n + 201) / 202);
}

static void test_the_own_motion_counts_a_hundredth_more(void)
{
    make_window(24, 24, 24, false);
    set_motion(1, 1, 100, 0);
    set_motion(0, 1, 0, 101);
    const struct smear_tile_neighborhood *a = neighborhood_of(1, 1, 2, false);
    CHECK_EQ(a->x, 0);                      /* 101 against 100 x 1.01: the first is at least as long */
    CHECK_EQ(a->y, shortened(101));
    set_motion(0, 1, 0, 100);
    a = neighborhood_of(1, 1, 2, false);
    CHECK_EQ(a->x, 3200);
    CHECK_EQ(a->y, 0);
    set_motion(0, 1, 0, -120);
    a = neighborhood_of(1, 1, 2, false);
    CHECK_EQ(a->x, 0);
    CHECK_EQ(a->y, shortened(-120));
}

static void test_the_neighbourhood_is_the_longest_of_nine(void)
{
    random_state = 1;
    for (int n = 0; n < 200; n++) {
        int columns = between(1, 5), rows = between(1, 3);
        make_window(columns * 8 - between(0, 7), rows * 8, rows * 8, true);
        for (int r = 0; r < rows; r++)
            for (int c = 0; c < columns; c++) {
                int x = between(-300, 300), y = between(-300, 300);
                set_motion(r, c, x, y);
            }
        for (int row = 0; row < rows; row++) {
            smear_neighbormax_row(&window, row, rows - 1, false);
            for (int c = 0; c < columns; c++) {
                int64_t longest = -1;
                int32_t x = 0, y = 0;
                for (int dy = -1; dy <= 1; dy++)
                    for (int dx = -1; dx <= 1; dx++) {
                        if (row + dy < 0 || row + dy >= rows || c + dx < 0 || c + dx >= columns)
                            continue;
                        const struct smear_tile_motion *m = &window_motion(&window, row + dy)[c + dx];
                        bool own = dx == 0 && dy == 0;
                        int64_t length = (int64_t)(m->x * m->x + m->y * m->y) * (own ? 101 * 101 : 100 * 100);
                        if (length > longest) {
                            longest = length;
                            x = own ? m->x * 32 : shortened(m->x);
                            y = own ? m->y * 32 : shortened(m->y);
                        }
                    }
                const struct smear_tile_neighborhood *a = &window_around(&window, row)[c];
                if (!CHECK_NEAR(a->x, x, 1) || !CHECK_NEAR(a->y, y, 1))
                    return;
            }
        }
    }
}

static void test_rows_not_yet_known_are_not_looked_at(void)
{
    make_window(24, 24, 24, false);
    set_motion(2, 1, 120, 0);
    CHECK_EQ(neighborhood_of(1, 1, 1, false)->kind, TILE_STATIC);
    CHECK_EQ(neighborhood_of(1, 1, 1, false)->x, 0);
    CHECK_EQ(neighborhood_of(1, 1, 2, false)->x, shortened(120));
}

static void test_with_the_corner_rule_a_diagonal_counts_only_when_it_points_here(void)
{
    static const struct { int x, y; bool counts; } from_top_left[] = {
        { 50, 50, true }, { -50, -50, true }, { 50, -50, false }, { -50, 50, false }, { 70, 0, false },
        { 0, 70, false }, { -70, 0, false }, { 0, -70, false }, { 90, 1, true }
    };
    for (int i = 0; i < (int)(sizeof from_top_left / sizeof from_top_left[0]); i++) {
        make_window(24, 24, 24, false);
        set_motion(0, 0, from_top_left[i].x, from_top_left[i].y);
        const struct smear_tile_neighborhood *a = neighborhood_of(1, 1, 2, true);
        CHECK_EQ(a->x != 0 || a->y != 0, from_top_left[i].counts);
        a = neighborhood_of(1, 1, 2, false);
        CHECK(a->x != 0 || a->y != 0);
        /* Beside and above it counts in any direction. */
        set_motion(0, 0, 0, 0);
        set_motion(0, 1, from_top_left[i].x, from_top_left[i].y);
        a = neighborhood_of(1, 1, 2, true);
        CHECK(a->x != 0 || a->y != 0);
    }
    /* The other diagonal. */
    make_window(24, 24, 24, false);
    set_motion(2, 0, 50, -50);
    CHECK(neighborhood_of(1, 1, 2, true)->x != 0);
    set_motion(2, 0, 50, 50);
    CHECK_EQ(neighborhood_of(1, 1, 2, true)->x, 0);
}

static void set_all(int x, int y)
{
    for (int row = 0; row < 3; row++)
        for (int column = 0; column < 3; column++) {
            set_motion(row, column, x, y);
            window_around(&window, row)[column].rough = 0;
        }
}

static void test_classes_tell_still_alike_and_mixed_motion(void)
{
    make_window(24, 24, 24, false);
    set_all(0, 0);
    CHECK_EQ(neighborhood_of(1, 1, 2, false)->kind, TILE_STATIC);
    set_all(80, -40);
    CHECK_EQ(neighborhood_of(1, 1, 2, false)->kind, TILE_UNIFORM);
    set_motion(2, 2, 82, -42);
    CHECK_EQ(neighborhood_of(1, 1, 2, false)->kind, TILE_UNIFORM);
    set_motion(2, 2, 80, 60);               /* another way */
    CHECK_EQ(neighborhood_of(1, 1, 2, false)->kind, TILE_COMPLEX);
    set_all(0, 0);                          /* still beside fast */
    set_motion(0, 0, 60, 60);
    CHECK_EQ(neighborhood_of(1, 1, 2, false)->kind, TILE_COMPLEX);
    set_motion(0, 0, 3, 0);                 /* still beside what all but stands */
    CHECK_EQ(neighborhood_of(1, 1, 2, false)->kind, TILE_UNIFORM);
}

static void test_motion_that_changes_without_a_step_is_uniform(void)
{
    make_window(24, 24, 24, false);
    for (int row = 0; row < 3; row++)       /* zooming: neighbours' ranges meet */
        for (int column = 0; column < 3; column++) {
            set_motion(row, column, 40 * (column - 1), 40 * (row - 1));
            struct smear_tile_motion *m = &window_motion(&window, row)[column];
            m->min_x = (int16_t)(40 * (column - 1) - 18);
            m->max_x = (int16_t)(40 * (column - 1) + 18);
            m->min_y = (int16_t)(40 * (row - 1) - 18);
            m->max_y = (int16_t)(40 * (row - 1) + 18);
            window_around(&window, row)[column].rough = 5;
        }
    CHECK_EQ(neighborhood_of(1, 1, 2, false)->kind, TILE_UNIFORM);
    window_around(&window, 1)[1].rough = 60;        /* a step within the tile */
    CHECK_EQ(neighborhood_of(1, 1, 2, false)->kind, TILE_COMPLEX);
}

static void test_rows_apart_do_not_matter_to_motion_along_the_row(void)
{
    make_window(24, 24, 24, false);
    set_all(80, 0);
    set_motion(0, 1, -80, 0);
    CHECK_EQ(neighborhood_of(1, 1, 2, false)->kind, TILE_UNIFORM);
    set_all(80, 0);
    set_motion(1, 0, -80, 0);
    CHECK_EQ(neighborhood_of(1, 1, 2, false)->kind, TILE_COMPLEX);
    set_all(0, 80);
    set_motion(1, 0, 0, -80);
    CHECK_EQ(neighborhood_of(1, 1, 2, false)->kind, TILE_UNIFORM);
    set_motion(0, 1, 0, -80);
    CHECK_EQ(neighborhood_of(1, 1, 2, false)->kind, TILE_COMPLEX);
}

static void test_roughness_is_the_largest_step_to_the_left_or_above(void)
{
    for (int is_wide = 0; is_wide < 2; is_wide++) {
        make_window(24, 24, 24, is_wide);
        for (int y = 0; y < 24; y++)
            for (int x = 0; x < 24; x++)
                set_velocity(x, y, 2 * x, 3 * y);
        smear_tilemax(&window, 1, 1);
        CHECK_EQ(window_around(&window, 1)[1].rough, 3);
        set_velocity(7, 9, 14 - 40, 27);            /* the pixel left of the tile */
        smear_tilemax(&window, 1, 1);
        CHECK_EQ(window_around(&window, 1)[1].rough, 42);
        set_velocity(12, 7, 24, 21 + 60);           /* the pixel above the tile */
        smear_tilemax(&window, 1, 1);
        CHECK_EQ(window_around(&window, 1)[1].rough, 57);
        set_velocity(16, 9, -100, 0);               /* the one to the right belongs to its own tile */
        smear_tilemax(&window, 1, 1);
        CHECK_EQ(window_around(&window, 1)[1].rough, 57);
        smear_tilemax(&window, 0, 0);               /* nothing left of or above the frame */
        CHECK_EQ(window_around(&window, 0)[0].rough, 3);
    }
}

#include "build/suites/tilemax.h"
