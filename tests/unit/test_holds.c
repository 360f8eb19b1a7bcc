/* SPDX-License-Identifier: MIT */
/* test_holds.c - a vertex that keeps a path on the screen is there where it is in space, at any instant; and the bounds of triangles
 * in space hold all that is seen of them. */
#define smear_assemble_path assemble_path_of_this_suite
#include "geometry/assemble_path.c"

#include "tests/host.h"

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
        if (!holds(screen, 0)) {
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
        if (keys_of(screen, &f) && !CHECK(holds(screen, 0)))
            return;
    }
}

/* ------------------------------------------------------------------ bounds of triangles in space */

enum { STEPS = 6, UNIT_LOG2 = 8 };

static int16_t corner[9];
static struct smear_shot shot;
static smear_camera *const eye = shot.camera;
static double way[3], bend[3];      /* of the eye: way phase + bend phase^2 */
static const smear_mesh one = { .position = corner, .vertex_count = 3, .triangle_count = 1, .shift = UNIT_LOG2 };

static void place_at(struct smear_placement *place, const struct smear_assembly *d, int key, int coarse)
{
    static const smear_transform still = SMEAR_IDENTITY;
    struct smear_view view;
    (void)d;
    smear_view_compose(&view, &still, &one, &eye[key].pose);
    smear_projection_make(&place->now, &view, &eye[key], 2 * HALF_HEIGHT, coarse);
    place->position = corner;
    place->extra_count = 0;
}

/* A triangle around the eye, which goes along a parabola. */
static void random_passage(void)
{
    for (int j = 0; j < 9; j++)
        corner[j] = (int16_t)between(-(1 << between(6, 14)), 1 << between(6, 14));
    for (int j = 0; j < 3; j++) {
        way[j] = uniform(-1, 1) * spread(0.01, 20);
        bend[j] = chance(2) ? 0 : uniform(-2, 2) * way[j];
    }
    for (int key = 0; key < KEYS; key++) {
        eye[key] = (smear_camera){ .pose = SMEAR_IDENTITY, .focal = 65536, .near_plane = 13107, .far_plane = 200 * 65536 };
        for (int j = 0; j < 3; j++)
            eye[key].pose.origin[j] = key == MIDDLE ? 0 : (int32_t)lrint((bend[j] + (key == OPEN ? -way[j] : way[j])) * 65536);
    }
}

/* Whether a point of the triangle, its first corners' parts in STEPS, is seen in the pixel (x, y) at a phase. */
static bool is_seen(int *x, int *y, int first, int second, double phase)
{
    double at[3];
    for (int j = 0; j < 3; j++)
        at[j] = ldexp((corner[j] * first + corner[3 + j] * second + corner[6 + j] * (STEPS - first - second)) / (double)STEPS, -UNIT_LOG2)
              - (way[j] + bend[j] * phase) * phase;
    const double w = -at[2];
    if (w < 0.2 || w > 200)
        return false;
    *x = (int)floor(at[0] / w * HALF_HEIGHT + HALF_WIDTH);
    *y = (int)floor(-at[1] / w * HALF_HEIGHT + HALF_HEIGHT);
    return *x >= 0 && *x < 2 * HALF_WIDTH && *y >= 0 && *y < 2 * HALF_HEIGHT;
}

/* Of both sides, so that one of them faces the eye. Returns how many points were seen, or -1. */
static int check_bounds(struct path_batch *batch)
{
    struct smear_path_bounds b[2];
    struct path_vertex v[3];
    int seen = 0;
    for (int i = 0; i < 3; i++)
        v[i] = (struct path_vertex){ .tag = (uint32_t)i, .outcodes = IN_SPACE };
    struct path_vertex *const vertex[3] = { &v[0], &v[1], &v[2] };
    find_places(batch, vertex);
    const bool has[2] = { find_bounds_in_space(&b[0], batch, &v[0], &v[1], &v[2]),
                          find_bounds_in_space(&b[1], batch, &v[0], &v[2], &v[1]) };
    for (int i = 0; i <= PHASES - 1; i++)
        for (int first = 0; first <= STEPS; first++)
            for (int second = 0; first + second <= STEPS; second++) {
                int x, y;
                if (!is_seen(&x, &y, first, second, i * 2.0 / (PHASES - 1) - 1))
                    continue;
                seen++;
                bool within = false;
                for (int side = 0; side < 2; side++)
                    within = within || (has[side] && x >= b[side].x0 && x < b[side].x1 && y >= b[side].y0 && y < b[side].y1);
                if (!CHECK(within))
                    return -1;
            }
    return seen;
}

static void test_bounds_hold_all_that_is_seen_of_a_triangle_in_space(void)
{
    static const smear_material material = { .color = { 255, 255, 255, 255 } };
    static struct smear_assembly d;
    struct smear_segment s = { .path = 1 };
    struct smear_bins g = { .row_px = 16, .row_end = 2 * HALF_HEIGHT / 16, .shot = &shot };
    struct smear_assembler a = { .bins = &g, .viewport = { 2 * HALF_WIDTH, 2 * HALF_HEIGHT }, .path_x1 = 2 * HALF_WIDTH };
    struct path_batch batch = { .a = &a, .d = &d, .segment = &s };
    int seen = 0;
    random_state = 3;
    d.material = &material;
    d.mesh = &one;
    d.place_fine = place_at;
    for (int n = 0; n < 10000; n++) {
        random_passage();
        const int more = check_bounds(&batch);
        if (more < 0) {
            CHECK_EQ(n, -1);
            return;
        }
        seen += more;
    }
    CHECK(seen > 50000);
}

/* Before an orthographic camera distances far beyond the far plane take all bits there are: sanitizers see to the rest. */
static void test_bounds_of_wild_passages_before_an_orthographic_camera_lie_in_the_frame(void)
{
    static const smear_material material = { .color = { 255, 255, 255, 255 } };
    static struct smear_assembly d;
    struct smear_segment s = { .path = 1, .flat_depth = 1 };
    struct smear_bins g = { .row_px = 16, .row_end = 2 * HALF_HEIGHT / 16, .shot = &shot };
    struct smear_assembler a = { .bins = &g, .viewport = { 2 * HALF_WIDTH, 2 * HALF_HEIGHT }, .path_x1 = 2 * HALF_WIDTH };
    struct path_batch batch = { .a = &a, .d = &d, .segment = &s };
    struct smear_path_bounds b;
    struct path_vertex v[3];
    int found = 0;
    random_state = 4;
    d.material = &material;
    d.mesh = &one;
    d.place_fine = place_at;
    d.at.now.depths.orthographic = true;
    for (int i = 0; i < 3; i++)
        v[i] = (struct path_vertex){ .tag = (uint32_t)i, .outcodes = IN_SPACE };
    struct path_vertex *const vertex[3] = { &v[0], &v[1], &v[2] };
    for (int n = 0; n < 10000; n++) {
        const int32_t far = between(2 * 65536, 100 * 65536);
        random_passage();
        for (int key = 0; key < KEYS; key++) {
            eye[key].half_height = 10 * 65536;
            eye[key].far_plane = far;
        }
        find_places(&batch, vertex);
        if (!find_bounds_in_space(&b, &batch, &v[0], &v[1], &v[2]))
            continue;
        found++;
        REQUIRE(b.x0 >= 0 && b.x0 < b.x1 && b.x1 <= 2 * HALF_WIDTH && b.y0 >= 0 && b.y0 < b.y1 && b.y1 <= 2 * HALF_HEIGHT);
    }
    CHECK(found > 1000);
}

#include "build/suites/holds.h"
