/* SPDX-License-Identifier: MIT */
/* test_ref.c - the reference renderer against closed forms: it has to be right before anything is
 * measured with it. Most scenes are seen by an orthographic camera of one world unit per pixel,
 * whose arithmetic is exact, so that claims about pixel centres on edges can be made. */
#include "tests/host.h"

#include "tools/ref/ref.h"

enum { SIZE = 64 };

static const double pi = 3.14159265358979323846;

/* ------------------------------------------------------------------ small scenes */

static void matrix_identity(double m[16])
{
    memset(m, 0, 16 * sizeof *m);
    m[0] = m[5] = m[10] = m[15] = 1.0;
}

static struct scene_camera orthographic(void)
{
    struct scene_camera camera = { .orthographic = true, .half_height = SIZE / 2, .znear = 1.0,
                                   .zfar = 1000.0 };
    matrix_identity(camera.pose);
    return camera;
}

static struct scene_camera perspective(void)
{
    struct scene_camera camera = { .yfov = pi / 2.0, .znear = 0.5 };
    matrix_identity(camera.pose);
    return camera;
}

/* World coordinates that the camera shows at (x, y) of the screen at distance d. */
static void place(float *out, const struct scene_camera *camera, double x, double y, double d)
{
    double unit = camera->orthographic ? 1.0 : d / (SIZE / 2);
    out[0] = (float)((x - SIZE / 2) * unit);
    out[1] = (float)((SIZE / 2 - y) * unit);
    out[2] = (float)-d;
}

static const uint32_t quad_index[6] = { 0, 1, 2, 0, 2, 3 };

static struct scene_surface surface_of(const float *position, int vertices, const uint32_t *index,
                                       int triangles)
{
    return (struct scene_surface){
        .vertex_count = vertices, .triangle_count = triangles, .position = position, .index = index,
        .material = { .base = { 1.0f, 1.0f, 1.0f, 1.0f }, .unlit = true, .alpha_cutoff = 0.5f },
    };
}

static struct scene_draw draw_of(const struct scene_surface *surface)
{
    struct scene_draw draw = { .surface = surface, .position = surface->position,
                               .normal = surface->normal, .node = -1 };
    matrix_identity(draw.world);
    return draw;
}

static struct scene_instant instant_of(struct scene_draw *draw, int count,
                                       struct scene_camera camera)
{
    return (struct scene_instant){ .camera = camera, .draw_count = count, .draw = draw };
}

/* A rectangle that faces the camera. */
static void place_quad(float position[12], const struct scene_camera *camera, double left,
                       double top, double right, double bottom, double d)
{
    place(position, camera, left, top, d);
    place(position + 3, camera, left, bottom, d);
    place(position + 6, camera, right, bottom, d);
    place(position + 9, camera, right, top, d);
}

static bool draw_now(const struct scene_instant *now, bool encoded, struct ref_frame *frame)
{
    struct failure f = {{0}};
    struct ref_options options = { .width = SIZE, .height = SIZE, .encoded = encoded };
    return CHECK(ref_draw(now, NULL, NULL, &options, frame, &f));
}

static size_t at(int x, int y)
{
    return (size_t)y * SIZE + (size_t)x;
}

static int count_drawn(const struct ref_frame *frame)
{
    int count = 0;
    for (size_t i = 0; i < SIZE * SIZE; i++)
        count += frame->triangle[i] >= 0;
    return count;
}

/* ------------------------------------------------------------------ coverage */

static void draw_triangle(const float position[9], struct scene_camera camera,
                          struct ref_frame *frame)
{
    static const uint32_t index[3] = { 0, 1, 2 };
    struct scene_surface surface = surface_of(position, 3, index, 1);
    struct scene_draw draw = draw_of(&surface);
    struct scene_instant now = instant_of(&draw, 1, camera);
    draw_now(&now, false, frame);
}

/* Legs of n pixels through pixel centres: the top and the left leg are in, the long side is out. */
static void test_pixel_centres_on_edges_follow_the_top_left_rule(void)
{
    struct scene_camera camera = orthographic();
    for (int n = 1; n <= 20; n++) {
        float upper[9], lower[9];
        struct ref_frame a OWNED(ref_frame_free), b;
        place(upper, &camera, 5.5, 7.5, 10.0);
        place(upper + 3, &camera, 5.5, 7.5 + n, 10.0);
        place(upper + 6, &camera, 5.5 + n, 7.5, 10.0);
        place(lower, &camera, 5.5 + n, 7.5 + n, 10.0);
        memcpy(lower + 3, upper + 6, 3 * sizeof(float));
        memcpy(lower + 6, upper + 3, 3 * sizeof(float));
        draw_triangle(upper, camera, &a);
        draw_triangle(lower, camera, &b);
        CHECK_EQ(count_drawn(&a), n * (n + 1) / 2);
        CHECK_EQ(count_drawn(&b), n * (n - 1) / 2);
        CHECK_EQ(a.triangle[at(5, 7)], 0);
        CHECK_EQ(a.triangle[at(5 + n, 7)], -1);
        CHECK_EQ(a.triangle[at(5, 7 + n)], -1);
        ref_frame_free(&b);
    }
}

/* A grid of crooked cells, corners on quarters of pixels: each triangle drawn alone, each pixel in
 * one. */
static void check_grid_covers_once(struct scene_camera camera, double depth_step)
{
    enum { CELLS = 6, SIDE = CELLS + 1 };
    float corner[SIDE * SIDE][3];
    static int covered[SIZE * SIZE];
    uint32_t seed = 12345;
    memset(covered, 0, sizeof covered);
    for (int j = 0; j < SIDE; j++)
        for (int i = 0; i < SIDE; i++) {
            seed = seed * 1664525u + 1013904223u;
            bool inner = i > 0 && j > 0 && i < CELLS && j < CELLS;
            double dx = inner ? (seed >> 20 & 15) * 0.25 : 0.0;
            double dy = inner ? (seed >> 24 & 15) * 0.25 : 0.0;
            double depth = 20.0 + depth_step * (seed >> 28);
            place(corner[j * SIDE + i], &camera, 4.5 + 9.0 * i + dx, 4.5 + 9.0 * j + dy, depth);
        }
    for (int t = 0; t < 2 * CELLS * CELLS; t++) {
        int cell = t / 2, a = cell / CELLS * SIDE + cell % CELLS;
        int around[4] = { a, a + SIDE, a + SIDE + 1, a + 1 };
        float position[9];
        struct ref_frame frame OWNED(ref_frame_free);
        for (int k = 0; k < 3; k++)
            memcpy(position + 3 * k, corner[around[t % 2 == 0 ? k : (k + 2) % 4]],
                   sizeof corner[0]);
        draw_triangle(position, camera, &frame);
        for (size_t i = 0; i < SIZE * SIZE; i++)
            covered[i] += frame.triangle[i] == 0;
    }
    for (int y = 0; y < SIZE; y++)
        for (int x = 0; x < SIZE; x++) {
            bool inside = x >= 5 && x < 58 && y >= 5 && y < 58;
            bool border = x == 4 || y == 4 || x == 58 || y == 58;
            if (!border)
                CHECK_EQ(covered[at(x, y)], inside);
        }
}

static void test_neighbouring_triangles_leave_no_gap_and_no_pixel_twice(void)
{
    check_grid_covers_once(orthographic(), 0.0);
    check_grid_covers_once(perspective(), 0.0);
    check_grid_covers_once(perspective(), 1.75);
}

/* The ground y = -1 seen level ends where the near and far planes cut it. At distance d it is 32/d
 * rows below the middle; two corners lie behind the eye. */
static void test_ground_through_the_eye_plane_is_cut_at_near_and_far(void)
{
    static const float position[12] = { -900, -1, -90, -900, -1, 30, 900, -1, 30, 900, -1, -90 };
    struct scene_surface surface = surface_of(position, 4, quad_index, 2);
    struct scene_draw draw = draw_of(&surface);
    struct scene_camera camera = perspective();
    camera.znear = 2.0;
    camera.zfar = 8.0;
    struct scene_instant now = instant_of(&draw, 1, camera);
    struct ref_frame frame OWNED(ref_frame_free) = { 0 };
    END_UNLESS(draw_now(&now, false, &frame));
    CHECK_EQ(count_drawn(&frame), 12 * SIZE);
    for (int y = 0; y < SIZE; y++) {
        double d = 32.0 / (y + 0.5 - 32.0);
        for (int x = 0; x < SIZE; x++) {
            CHECK_EQ(frame.triangle[at(x, y)] >= 0, y >= 36 && y < 48);
            if (y >= 36 && y < 48)
                CHECK_CLOSE(frame.depth[at(x, y)], d, 1e-9);
            else
                CHECK(isinf(frame.depth[at(x, y)]));
        }
    }
}

static double triple(const double a[3], const double b[3], const double c[3])
{
    return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2])
         + a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/* Where the ray of a pixel centre meets a triangle's plane: its distance along -Z, NAN when it
 * misses the triangle; *margin is how far it is from changing its mind, 0 on an edge. Both cameras
 * look from the origin. */
static double hit(const float corner[9], bool parallel, double x, double y, double *margin)
{
    double unit = parallel ? 1.0 : 1.0 / (SIZE / 2);
    double eye[3] = { 0, 0, 0 }, ray[3] = { 0, 0, -1.0 }, e1[3], e2[3], to_eye[3], none[3];
    double *across = parallel ? eye : ray;
    across[0] = (x - SIZE / 2) * unit;
    across[1] = (SIZE / 2 - y) * unit;
    for (int i = 0; i < 3; i++) {
        e1[i] = (double)corner[3 + i] - (double)corner[i];
        e2[i] = (double)corner[6 + i] - (double)corner[i];
        to_eye[i] = eye[i] - (double)corner[i];
        none[i] = -ray[i];
    }
    double scale = triple(none, e1, e2);
    double u = triple(none, to_eye, e2) / scale, v = triple(none, e1, to_eye) / scale;
    double least = fmin(fmin(u, v), 1.0 - u - v);
    *margin = fabs(least);
    return least < 0.0 ? NAN : triple(to_eye, e1, e2) / scale;
}

/* Random triangles, most of them through the eye plane, against one ray per pixel. */
static void test_wild_triangles_cover_what_rays_hit(void)
{
    static const uint32_t index[3] = { 0, 1, 2 };
    uint32_t seed = 4711;
    int wrong = 0, drawn = 0, cut = 0;
    for (int k = 0; k < 240; k++) {
        bool parallel = k % 3 == 2;
        float corner[9];
        struct scene_camera camera = parallel ? orthographic() : perspective();
        camera.zfar = k % 2 == 0 ? 6.0 : 0.0;
        for (int i = 0; i < 9; i++) {
            seed = seed * 1664525u + 1013904223u;
            double share = (seed >> 8) / 16777216.0;
            double wide = (parallel ? 80.0 : 16.0) * (share - 0.5);
            corner[i] = (float)(i % 3 == 2 ? 2.0 - 10.0 * share : wide);
        }
        struct scene_surface surface = surface_of(corner, 3, index, 1);
        surface.material.double_sided = true;
        struct scene_draw draw = draw_of(&surface);
        struct scene_instant now = instant_of(&draw, 1, camera);
        struct ref_frame frame OWNED(ref_frame_free) = { 0 };
        END_UNLESS(draw_now(&now, false, &frame));
        for (int y = 0; y < SIZE; y++)
            for (int x = 0; x < SIZE; x++) {
                double margin, d = hit(corner, parallel, x + 0.5, y + 0.5, &margin);
                double far = camera.zfar > 0.0 ? camera.zfar : INFINITY;
                bool inside = d >= camera.znear && d <= far;
                double limit = fmin(fabs(d - camera.znear), fabs(d - far));
                if (margin < 1e-7 || limit < 1e-7)
                    continue;
                wrong += (frame.triangle[at(x, y)] == 0) != inside;
                if (inside && frame.triangle[at(x, y)] == 0)
                    wrong += !(fabs(frame.depth[at(x, y)] / d - 1.0) < 1e-6);
                drawn += inside;
                cut += !isnan(d) && !inside;
            }
    }
    CHECK_EQ(wrong, 0);
    CHECK(drawn > 150000 && cut > 40000);
}

static void test_back_faces_are_culled_and_mirrors_turn_the_winding(void)
{
    float position[12];
    struct scene_camera camera = orthographic();
    place_quad(position, &camera, 16, 16, 48, 48, 10.0);
    struct scene_surface surface = surface_of(position, 4, quad_index, 2);
    for (int way = 0; way < 8; way++) {
        bool turned = (way & 1) != 0, mirrored = (way & 2) != 0, both = (way & 4) != 0;
        struct scene_draw draw = draw_of(&surface);
        struct ref_frame frame OWNED(ref_frame_free);
        surface.material.double_sided = both;
        if (turned) {                       /* half a turn about y shows the back */
            draw.world[0] = draw.world[10] = -1.0;
            draw.world[14] = -20.0;
        }
        if (mirrored)
            draw.world[5] = -1.0;           /* upside down: same place */
        struct scene_instant now = instant_of(&draw, 1, camera);
        draw_now(&now, false, &frame);
        CHECK_EQ(count_drawn(&frame), turned && !both ? 0 : 32 * 32);
    }
}

static void test_nearer_wins_and_the_first_of_equals(void)
{
    float position[3][12];
    struct scene_surface surface[3];
    struct scene_draw draw[3];
    struct scene_camera camera = perspective();
    static const double depth[3] = { 8.0, 5.0, 5.0 };
    struct ref_frame frame;
    for (int i = 0; i < 3; i++) {
        place_quad(position[i], &camera, 10 + 4 * i, 10, 40 + 4 * i, 40, depth[i]);
        surface[i] = surface_of(position[i], 4, quad_index, 2);
        draw[i] = draw_of(&surface[i]);
    }
    struct scene_instant now = instant_of(draw, 3, camera);
    END_UNLESS(draw_now(&now, false, &frame));
    CHECK_EQ(frame.draw[at(12, 20)], 0);
    CHECK_EQ(frame.draw[at(20, 20)], 1);
    CHECK_EQ(frame.draw[at(43, 20)], 1);
    CHECK_EQ(frame.draw[at(45, 20)], 2);
    CHECK_EQ(frame.triangle[at(12, 38)], 0);    /* the first triangle of the first draw */
    CHECK_EQ(frame.triangle[at(47, 11)], 5);    /* the second of the third */
    ref_frame_free(&frame);
    draw[0].hidden = true;
    END_UNLESS(draw_now(&now, false, &frame));
    CHECK_EQ(frame.draw[at(12, 20)], -1);
    CHECK_EQ(frame.triangle[at(47, 11)], 5);    /* hidden draws keep their ids */
    ref_frame_free(&frame);
}

/* ------------------------------------------------------------------ depth and velocity */

/* A plane through (16, 16) at d = 4, (16, 48) at d = 4 and (48, *) at d = 8: along a row 1/d is
 * linear. */
static void test_inverse_depth_is_linear_on_the_screen(void)
{
    float position[12];
    struct scene_camera camera = perspective();
    struct ref_frame frame OWNED(ref_frame_free) = { 0 };
    place(position, &camera, 16, 16, 4.0);
    place(position + 3, &camera, 16, 48, 4.0);
    place(position + 6, &camera, 48, 48, 8.0);
    place(position + 9, &camera, 48, 16, 8.0);
    struct scene_surface surface = surface_of(position, 4, quad_index, 2);
    struct scene_draw draw = draw_of(&surface);
    struct scene_instant now = instant_of(&draw, 1, camera);
    END_UNLESS(draw_now(&now, false, &frame));
    for (int x = 16; x < 48; x++) {
        double share = (x + 0.5 - 16.0) / 32.0, d = 1.0 / (0.25 * (1.0 - share) + 0.125 * share);
        CHECK_CLOSE(frame.depth[at(x, 30)], d, 1e-6);
    }
}

static void test_velocity_is_the_screen_path_of_the_surface_point(void)
{
    float position[12];
    struct scene_camera camera = perspective();
    struct ref_options options = { .width = SIZE, .height = SIZE };
    struct ref_frame frame;
    struct failure f = {{0}};
    place_quad(position, &camera, 8, 8, 56, 56, 16.0);
    struct scene_surface surface = surface_of(position, 4, quad_index, 2);
    struct scene_draw draw = draw_of(&surface), before = draw;
    struct scene_instant now = instant_of(&draw, 1, camera), then = instant_of(&before, 1, camera);

    before.world[12] = -3.0;                /* came 3 to the right and 1 up: 32/16 px per unit */
    before.world[13] = -1.0;
    REQUIRE(ref_draw(&now, &then, &now, &options, &frame, &f));
    for (int y = 8; y < 56; y += 5)
        for (int x = 8; x < 56; x += 5) {
            CHECK_CLOSE(frame.velocity[2 * at(x, y)], 6.0, 1e-9);
            CHECK_CLOSE(frame.velocity[2 * at(x, y) + 1], -2.0, 1e-9);
        }
    CHECK(frame.velocity[0] == 0.0 && frame.velocity[1] == 0.0);
    ref_frame_free(&frame);

    matrix_identity(before.world);          /* came from d = 20 to d = 16: away from the middle */
    before.world[14] = -4.0;
    options.velocity_scale = 2.0;
    REQUIRE(ref_draw(&now, &then, &now, &options, &frame, &f));
    for (int x = 8; x < 56; x += 5)
        CHECK_CLOSE(frame.velocity[2 * at(x, 20)], 2.0 * (x - 31.5) * (1.0 - 16.0 / 20.0), 1e-9);
    ref_frame_free(&frame);

    matrix_identity(before.world);          /* the camera went 2 to the left instead */
    then.camera.pose[12] = 2.0;
    options.velocity_scale = 0.0;
    REQUIRE(ref_draw(&now, &then, &now, &options, &frame, &f));
    CHECK_CLOSE(frame.velocity[2 * at(20, 20)], 4.0, 1e-9);
    CHECK_CLOSE(frame.velocity[2 * at(20, 20) + 1], 0.0, 1e-9);
    ref_frame_free(&frame);

    before.world[14] = 20.0;                /* came from behind the eye: no path */
    REQUIRE(ref_draw(&now, &then, &now, &options, &frame, &f));
    CHECK(isnan(frame.velocity[2 * at(20, 20)]));
    ref_frame_free(&frame);
}

static void test_cut_and_masked_draws_move_with_the_camera_only(void)
{
    float position[12];
    struct scene_camera camera = orthographic();
    struct ref_frame frame;
    struct failure f = {{0}};
    place_quad(position, &camera, 8, 8, 56, 56, 16.0);
    struct scene_surface surface = surface_of(position, 4, quad_index, 2);
    struct scene_draw draw = draw_of(&surface), before = draw;
    struct scene_instant now = instant_of(&draw, 1, camera), then = instant_of(&before, 1, camera);
    before.world[12] = -5.0;
    then.camera.pose[12] = -2.0;            /* the camera goes right: everything goes left by 2 */
    for (int way = 0; way < 7; way++) {
        static const double want[7] = { 3.0, -2.0, -2.0, -2.0, -2.0, 0.0, 0.0 };
        uint8_t motion = way == 4 ? SCENE_MOTION_CAMERA : way == 5 ? SCENE_MOTION_NONE
                                                                   : SCENE_MOTION_FULL;
        struct ref_options options = { .width = SIZE, .height = SIZE, .motion = &motion,
                                       .motion_count = 1 };
        before.epoch = way == 1;
        before.hidden = way == 2;
        then.draw_count = way != 3;
        then.camera.epoch = way == 6;
        REQUIRE(ref_draw(&now, &then, &now, &options, &frame, &f));
        CHECK_CLOSE(frame.velocity[2 * at(30, 30)], want[way], 1e-9);
        ref_frame_free(&frame);
    }
}

/* ------------------------------------------------------------------ light and colour */

static double lit_value(struct scene_surface *surface, const double world[16], bool encoded)
{
    struct ref_frame frame OWNED(ref_frame_free) = { 0 };
    struct scene_draw draw = draw_of(surface);
    if (world != NULL)
        memcpy(draw.world, world, sizeof draw.world);
    struct scene_instant now = instant_of(&draw, 1, orthographic());
    if (!draw_now(&now, encoded, &frame))
        return -1.0;
    double value = frame.triangle[at(32, 32)] >= 0 ? frame.color[3 * at(32, 32) + 1] : -2.0;
    return value;
}

static void test_light_is_a_third_and_a_cosine(void)
{
    float position[12], normal[12];
    static const float along[5][3] = { { 0.36f, 0.80f, 0.48f }, { 0.80f, -0.36f, 0.0f },
                                       { -0.36f, -0.80f, -0.48f }, { 0, 9.0f, 0 }, { 0, 0, 0 } };
    static const double want[5] = { 1.0, 0.3, 0.3, 0.3 + 0.7 * 0.80, 0.3 };
    struct scene_camera camera = orthographic();
    place_quad(position, &camera, 8, 8, 56, 56, 16.0);
    struct scene_surface surface = surface_of(position, 4, quad_index, 2);
    surface.material.unlit = false;
    CHECK_CLOSE(lit_value(&surface, NULL, false), 0.3 + 0.7 * 0.48, 1e-9);  /* flat: towards +Z */
    surface.normal = normal;
    for (int i = 0; i < 5; i++) {
        for (int k = 0; k < 4; k++)
            memcpy(normal + 3 * k, along[i], sizeof along[i]);
        CHECK_CLOSE(lit_value(&surface, NULL, false), want[i], 1e-7);
        CHECK_CLOSE(lit_value(&surface, NULL, true), ref_srgb_encode(want[i]), 1e-7);
    }
    for (int k = 0; k < 4; k++)             /* the light is interpolated, not the normal */
        memcpy(normal + 3 * k, along[k == 1 || k == 2 ? 0 : 2], sizeof along[0]);
    CHECK_CLOSE(lit_value(&surface, NULL, false), 0.3 + 0.7 * 24.5 / 48.0, 1e-7);
}

static void test_normals_follow_the_inverse_transpose_and_the_visible_side(void)
{
    float position[12], normal[12];
    double world[16];
    struct scene_camera camera = orthographic();
    place_quad(position, &camera, 8, 8, 56, 56, 16.0);
    struct scene_surface surface = surface_of(position, 4, quad_index, 2);
    surface.material.unlit = false;
    surface.material.double_sided = true;
    surface.normal = normal;
    for (int k = 0; k < 4; k++) {
        normal[3 * k] = 0.0f;
        normal[3 * k + 1] = normal[3 * k + 2] = 1.0f;
    }
    matrix_identity(world);
    world[5] = 2.0;                         /* y twice as tall: the normal leans to (0, 1/2, 1) */
    double cosine = (0.5 * 0.80 + 0.48) / sqrt(1.25);
    CHECK_CLOSE(lit_value(&surface, world, false), 0.3 + 0.7 * cosine, 1e-9);
    world[5] = -2.0;                        /* mirrored: (0, -1/2, 1), still seen from the front */
    cosine = (-0.5 * 0.80 + 0.48) / sqrt(1.25);
    CHECK_CLOSE(lit_value(&surface, world, false), 0.3 + 0.7 * cosine, 1e-9);
    matrix_identity(world);
    world[0] = world[10] = -1.0;            /* half a turn: (0, 1, -1), from behind (0, -1, 1) */
    world[14] = -32.0;
    CHECK_CLOSE(lit_value(&surface, world, false), 0.3, 1e-9);
    world[5] = -1.0;                        /* and upside down: (0, -1, -1), seen as (0, 1, 1) */
    cosine = (0.80 + 0.48) / sqrt(2.0);
    CHECK_CLOSE(lit_value(&surface, world, false), 0.3 + 0.7 * cosine, 1e-9);
    surface.normal = NULL;                  /* flat normals always face the eye */
    CHECK_CLOSE(lit_value(&surface, world, false), 0.3 + 0.7 * 0.48, 1e-9);
    world[0] = 1.0;
    CHECK_CLOSE(lit_value(&surface, world, false), 0.3 + 0.7 * 0.48, 1e-9);
}

static void test_colours_multiply_and_stop_at_one(void)
{
    float position[12];
    static const float color[16] = { 0.5f, 0.5f, 0.5f, 1, 0.5f, 0.5f, 0.5f, 1,
                                     0.5f, 0.5f, 0.5f, 1, 0.5f, 0.5f, 0.5f, 1 };
    static const float face[8] = { 0.25f, 0.25f, 0.25f, 1, 0.25f, 0.25f, 0.25f, 1 };
    struct scene_camera camera = orthographic();
    place_quad(position, &camera, 8, 8, 56, 56, 16.0);
    struct scene_surface surface = surface_of(position, 4, quad_index, 2);
    surface.material.base[1] = 0.5f;
    CHECK_CLOSE(lit_value(&surface, NULL, false), 0.5, 1e-9);
    surface.color = color;
    CHECK_CLOSE(lit_value(&surface, NULL, false), 0.25, 1e-9);
    surface.color = NULL;
    surface.face_color = face;
    CHECK_CLOSE(lit_value(&surface, NULL, false), 0.125, 1e-9);
    surface.face_color = NULL;
    surface.material.base[1] = 4.0f;
    CHECK_CLOSE(lit_value(&surface, NULL, false), 1.0, 1e-9);
}

/* ------------------------------------------------------------------ textures */

static uint8_t texel_value(long x, long y)
{
    return (uint8_t)(10 + 40 * x + 100 * y);
}

/* A 4 x 2 picture: red is distinct everywhere, alpha is 0 in one texel. */
static struct image small_image(void)
{
    static uint8_t rgba[4 * 8];
    for (int i = 0; i < 8; i++) {
        rgba[4 * i] = rgba[4 * i + 1] = rgba[4 * i + 2] = texel_value(i % 4, i / 4);
        rgba[4 * i + 3] = i == 1 ? 0 : 255;
    }
    return (struct image){ .width = 4, .height = 2, .rgba = rgba };
}

static long wrapped(long i, long n, enum model_wrap wrap)
{
    if (wrap == MODEL_WRAP_CLAMP)
        return i < 0 ? 0 : i >= n ? n - 1 : i;
    long period = wrap == MODEL_WRAP_MIRROR ? 2 * n : n, k = (i % period + period) % period;
    return k < n ? k : 2 * n - 1 - k;
}

/* 64 px across 16 texels (-6 .. 10 of a 4 wide picture): pixel x is inside texel x/4 - 6. */
static void test_texels_are_found_under_every_wrap_mode(void)
{
    static const float uv[8] = { -1.5f, -2.0f, -1.5f, 6.0f, 2.5f, 6.0f, 2.5f, -2.0f };
    static const enum model_wrap modes[3] = { MODEL_WRAP_REPEAT, MODEL_WRAP_CLAMP,
                                              MODEL_WRAP_MIRROR };
    float position[12];
    struct image image = small_image();
    struct scene_camera camera = orthographic();
    place_quad(position, &camera, 0, 0, 64, 64, 16.0);
    struct scene_surface surface = surface_of(position, 4, quad_index, 2);
    surface.uv = uv;
    surface.material.image = &image;
    for (int mode = 0; mode < 9; mode++) {
        struct scene_draw draw = draw_of(&surface);
        struct scene_instant now = instant_of(&draw, 1, camera);
        struct ref_frame frame OWNED(ref_frame_free) = { 0 };
        surface.material.wrap_u = modes[mode % 3];
        surface.material.wrap_v = modes[mode / 3];
        END_UNLESS(draw_now(&now, true, &frame));
        for (int y = 0; y < SIZE; y++)
            for (int x = 0; x < SIZE; x++) {
                uint8_t want = texel_value(wrapped(x / 4 - 6, 4, surface.material.wrap_u),
                                           wrapped(y / 4 - 4, 2, surface.material.wrap_v));
                CHECK_EQ(lround(frame.color[3 * at(x, y)] * 255.0), want);
            }
    }
}

static void test_bilinear_texels_mix_in_the_working_light(void)
{
    static const float uv[8] = { 0, 0, 0, 2, 4, 2, 4, 0 };
    float position[12];
    struct image image = small_image();
    struct scene_camera camera = orthographic();
    place_quad(position, &camera, 0, 0, 64, 64, 16.0);
    struct scene_surface surface = surface_of(position, 4, quad_index, 2);
    surface.uv = uv;
    surface.material.image = &image;
    surface.material.bilinear = true;
    for (int encoded = 0; encoded < 2; encoded++) {
        struct scene_draw draw = draw_of(&surface);
        struct scene_instant now = instant_of(&draw, 1, camera);
        struct ref_frame frame OWNED(ref_frame_free) = { 0 };
        END_UNLESS(draw_now(&now, encoded != 0, &frame));
        /* Pixel 5, 5 is at texel 1.375, 0.34: between columns 0 and 1, rows -1 and 0. */
        double value[4];
        for (int k = 0; k < 4; k++) {
            double code = texel_value(k & 1, k < 2 ? 1 : 0) / 255.0;
            value[k] = encoded ? code : ref_srgb_decode(code);
        }
        double v = 5.5 / 16.0 + 0.5, above = value[0] * 0.125 + value[1] * 0.875;
        double below = value[2] * 0.125 + value[3] * 0.875;
        CHECK_CLOSE(frame.color[3 * at(5, 5)], above * (1.0 - v) + below * v, 1e-9);
    }
}

/* Texture coordinates run 0..1 over a floor whose depth goes from 4 to 8 along x, as in the depth
 * test. */
static void test_texture_coordinates_are_perspective_correct(void)
{
    static const float uv[8] = { 0, 0, 0, 1, 1, 1, 1, 0 };
    float position[12];
    uint8_t rgba[4 * 256];
    struct image ramp = { .width = 256, .height = 1, .rgba = rgba };
    struct scene_camera camera = perspective();
    for (int i = 0; i < 256; i++)
        memset(rgba + 4 * i, i, 4);
    place(position, &camera, 16, 16, 4.0);
    place(position + 3, &camera, 16, 48, 4.0);
    place(position + 6, &camera, 48, 48, 8.0);
    place(position + 9, &camera, 48, 16, 8.0);
    struct scene_surface surface = surface_of(position, 4, quad_index, 2);
    surface.uv = uv;
    surface.material.image = &ramp;
    struct scene_draw draw = draw_of(&surface);
    struct scene_instant now = instant_of(&draw, 1, camera);
    struct ref_frame frame OWNED(ref_frame_free) = { 0 };
    END_UNLESS(draw_now(&now, true, &frame));
    for (int x = 16; x < 48; x++) {
        double share = (x + 0.5 - 16.0) / 32.0;
        double u = share / 8.0 / ((1.0 - share) / 4.0 + share / 8.0);
        CHECK_EQ(lround(frame.color[3 * at(x, 30)] * 255.0), (long)floor(u * 256.0));
    }
}

/* ------------------------------------------------------------------ cut-outs and blending */

static void test_cutouts_show_what_lies_behind_with_its_depth(void)
{
    static const float uv[8] = { 0, 0, 0, 1, 1, 1, 1, 0 };
    float front[12], back[12];
    struct image image = small_image();     /* texel 1, 0 is a hole: pixels 16..31, 0..31 */
    struct scene_camera camera = orthographic();
    place_quad(front, &camera, 0, 0, 64, 64, 16.0);
    place_quad(back, &camera, 0, 0, 64, 64, 20.0);
    struct scene_surface surface[2] = { surface_of(front, 4, quad_index, 2),
                                        surface_of(back, 4, quad_index, 2) };
    surface[0].uv = uv;
    surface[0].material.image = &image;
    surface[0].material.alpha = MODEL_ALPHA_MASK;
    struct scene_draw draw[2] = { draw_of(&surface[0]), draw_of(&surface[1]) };
    struct scene_instant now = instant_of(draw, 2, camera);
    struct ref_frame frame OWNED(ref_frame_free) = { 0 };
    END_UNLESS(draw_now(&now, false, &frame));
    for (int y = 0; y < SIZE; y++)
        for (int x = 0; x < SIZE; x++) {
            bool hole = x >= 16 && x < 32 && y < 32;
            CHECK_EQ(frame.draw[at(x, y)], hole);
            CHECK_CLOSE(frame.depth[at(x, y)], hole ? 20.0 : 16.0, 1e-9);
        }
}

static void test_blended_draws_mix_after_everything_opaque(void)
{
    float position[3][12];
    struct scene_surface surface[3];
    struct scene_draw draw[3];
    struct scene_camera camera = orthographic();
    static const double depth[3] = { 10.0, 20.0, 30.0 };    /* blended, opaque white, blended */
    for (int i = 0; i < 3; i++) {
        place_quad(position[i], &camera, 0, 0, i == 1 ? 32 : 64, 64, depth[i]);
        surface[i] = surface_of(position[i], 4, quad_index, 2);
        if (i != 1) {
            surface[i].material.alpha = MODEL_ALPHA_BLEND;
            surface[i].material.base[3] = 0.25f;
            surface[i].material.base[1] = i == 0 ? 0.0f : 1.0f;
        }
        draw[i] = draw_of(&surface[i]);
    }
    for (int encoded = 0; encoded < 2; encoded++) {
        struct scene_instant now = instant_of(draw, 3, camera);
        struct ref_frame frame OWNED(ref_frame_free) = { 0 };
        END_UNLESS(draw_now(&now, encoded != 0, &frame));
        /* Black over white, the far one is hidden; beside it, in submission order, white last. */
        CHECK_CLOSE(frame.color[3 * at(10, 10) + 1], 0.75, 1e-9);
        CHECK_CLOSE(frame.depth[at(10, 10)], 20.0, 1e-9);
        CHECK_EQ(frame.draw[at(10, 10)], 1);
        CHECK_CLOSE(frame.color[3 * at(50, 10) + 1], 0.25, 1e-9);
        CHECK_EQ(frame.triangle[at(50, 10)], -1);
        CHECK(isinf(frame.depth[at(50, 10)]));
    }
}

/* ------------------------------------------------------------------ scenes of time */

struct slide {                      /* draws that move to the right at `speed` units per second */
    struct scene_draw draw[3];
    int draw_count;
    double speed;
    struct scene_camera camera;
};

static bool slide_pose(struct scene *scene, double time, struct scene_instant *out,
                       struct failure *f)
{
    const struct slide *slide = scene->data;
    if (out->store == NULL && (out->store = malloc(sizeof slide->draw)) == NULL)
        return fail(f, "no memory");
    memcpy(out->store, slide->draw, sizeof slide->draw);
    out->draw = out->store;
    out->draw_count = slide->draw_count;
    out->draw[0].world[12] = slide->speed * time;
    out->camera = slide->camera;
    return true;
}

static void slide_free(struct scene *scene, struct scene_instant *instant)
{
    (void)scene;
    free(instant->store);
}

static struct scene scene_of(struct slide *slide)
{
    return (struct scene){ .name = "slide", .width = SIZE, .height = SIZE, .fps = 10.0,
                           .pose = slide_pose, .instant_free = slide_free, .data = slide };
}

/* A white half plane whose right edge is at 20.5 px at t = 0 and moves 8 px per exposure. */
static struct slide edge_slide(float position[12], struct scene_surface *surface)
{
    struct slide slide = { .draw_count = 1, .speed = 160.0, .camera = orthographic() };
    place_quad(position, &slide.camera, -64, 0, 20.5, 64, 16.0);
    *surface = surface_of(position, 4, quad_index, 2);
    slide.draw[0] = draw_of(surface);
    return slide;
}

static void test_half_covered_white_is_188_in_linear_light_and_128_encoded(void)
{
    float position[12];
    struct scene_surface surface;
    struct slide slide = edge_slide(position, &surface);
    struct scene scene = scene_of(&slide);
    for (int encoded = 0; encoded < 2; encoded++) {
        struct ref_truth_options options = { .shutter_degrees = 180.0, .instants = 64, .threads = 1,
                                             .encoded = encoded != 0 };
        struct ref_truth truth;
        struct failure f = {{0}};
        REQUIRE(ref_truth(&scene, &options, &truth, &f));
        CHECK_EQ(truth.image.rgba[4 * at(20, 9)], encoded ? 128 : 188);
        for (int x = 10; x < 30; x++) {     /* the edge goes from 16.5 to 24.5 */
            double coverage = fmin(fmax((24.5 - (x + 0.5)) / 8.0, 0.0), 1.0);
            CHECK_CLOSE(truth.code[3 * at(x, 33)],
                        255.0 * (encoded ? coverage : ref_srgb_encode(coverage)), 1e-9);
        }
        ref_truth_free(&truth);
    }
}

/* Two instants stand at a quarter and three quarters of the exposure. */
static void test_instants_stand_in_the_middle_of_their_share(void)
{
    float position[12];
    struct scene_surface surface;
    struct slide slide = edge_slide(position, &surface);
    struct scene scene = scene_of(&slide);
    struct ref_truth_options options = { .shutter_degrees = 180.0, .instants = 2, .encoded = true };
    struct ref_truth truth;
    struct failure f = {{0}};
    position[6] = position[9] += 0.25f;     /* at 20.75, so from 16.75 to 24.75 */
    REQUIRE(ref_truth(&scene, &options, &truth, &f));
    for (int x = 0; x < SIZE; x++) {
        int want = x + 0.5 < 18.75 ? 255 : x + 0.5 < 22.75 ? 128 : 0;
        CHECK_EQ(truth.image.rgba[4 * at(x, 9)], want);
    }
    ref_truth_free(&truth);
}

/* The first column that is not black and the first that is not white say where the edge went. */
static void test_the_exposure_lies_before_around_or_after_the_frame(void)
{
    static const double from[3] = { 16.5, 12.5, 20.5 };
    float position[12];
    struct scene_surface surface;
    struct slide slide = edge_slide(position, &surface);
    struct scene scene = scene_of(&slide);
    for (int way = 0; way < 3; way++) {
        struct ref_truth_options options = { .shutter_degrees = 180.0, .instants = 16,
                                             .exposure = (enum ref_exposure)way };
        struct ref_truth truth;
        struct failure f = {{0}};
        REQUIRE(ref_truth(&scene, &options, &truth, &f));
        for (int x = 0; x < SIZE; x++) {
            bool grey = x + 0.5 > from[way] && x + 0.5 < from[way] + 8.0;
            uint8_t code = truth.image.rgba[4 * at(x, 5)];
            CHECK_EQ(code != 255 && code != 0, grey);
        }
        ref_truth_free(&truth);
    }
    struct ref_truth_options still = { .instants = 16, .time = 0.05 };
    struct ref_truth truth;
    struct failure f = {{0}};
    if (CHECK(ref_truth(&scene, &still, &truth, &f))) {
        CHECK_EQ(truth.image.rgba[4 * at(27, 5)], 255);     /* sharp, at 28.5 */
        CHECK_EQ(truth.image.rgba[4 * at(28, 5)], 0);
        ref_truth_free(&truth);
    }
}

static void test_truth_does_not_depend_on_threads(void)
{
    float position[12];
    struct scene_surface surface;
    struct slide slide = edge_slide(position, &surface);
    struct scene scene = scene_of(&slide);
    struct ref_truth_options options = { .shutter_degrees = 123.0, .instants = 37, .time = 0.01 };
    struct ref_truth truth[2];
    struct failure f = {{0}};
    surface.material.base[1] = 0.37f;
    for (int i = 0; i < 2; i++) {
        options.threads = i + 1;
        REQUIRE(ref_truth(&scene, &options, &truth[i], &f));
    }
    CHECK(memcmp(truth[0].code, truth[1].code, 3 * sizeof(double) * SIZE * SIZE) == 0);
    ref_truth_free(&truth[0]);
    ref_truth_free(&truth[1]);
}

static void test_impossible_requests_fail_with_nothing_kept(void)
{
    float position[12];
    struct scene_surface surface;
    struct slide slide = edge_slide(position, &surface);
    struct scene scene = scene_of(&slide);
    struct scene_instant now = instant_of(slide.draw, 1, slide.camera);
    struct ref_options options = { .width = SIZE, .height = 0 };
    struct ref_truth_options exposure = { .shutter_degrees = 180.0 };
    struct ref_frame frame;
    struct ref_truth truth;
    struct failure f = {{0}};
    CHECK(!ref_draw(&now, NULL, NULL, &options, &frame, &f));
    CHECK(frame.color == NULL && f.text[0] != '\0');
    f.text[0] = '\0';
    CHECK(!ref_truth(&scene, &exposure, &truth, &f));
    CHECK(truth.code == NULL && f.text[0] != '\0');
    f.text[0] = '\0';
    options.height = SIZE;
    now.camera.half_height = 0.0;
    CHECK(!ref_draw(&now, NULL, NULL, &options, &frame, &f));
    CHECK(f.text[0] != '\0');
    static const uint32_t wild[6] = { 0, 1, 2, 0, 2, 4 };
    surface.index = wild;
    now.camera = orthographic();
    f.text[0] = '\0';
    CHECK(!ref_draw(&now, NULL, NULL, &options, &frame, &f));
    CHECK(f.text[0] != '\0');
}

/* ------------------------------------------------------------------ ids and comparison */

static void test_id_colours_survive_an_error_of_one_code(void)
{
    uint8_t rgb[3];
    for (int32_t id = -1; id < REF_ID_LIMIT - 1; id++) {
        ref_id_to_rgb(id, rgb);
        int32_t back = ref_id_from_rgb(rgb);
        for (int i = 0; i < 3; i++)
            rgb[i] = (uint8_t)(rgb[i] + 1);
        int32_t above = ref_id_from_rgb(rgb);
        for (int i = 0; i < 3; i++)
            rgb[i] = (uint8_t)(rgb[i] >= 2 ? rgb[i] - 2 : 0);
        if (back != id || above != id || ref_id_from_rgb(rgb) != id) {
            CHECK_EQ(back, id);
            CHECK_EQ(above, id);
            CHECK_EQ(ref_id_from_rgb(rgb), id);
            return;
        }
    }
}

/* A blended pane, a cut-out and a lit textured wall. */
static struct slide three_kinds(float position[3][12], struct scene_surface surface[3],
                                const struct image *image)
{
    static const float uv[8] = { 0, 0, 0, 1, 1, 1, 1, 0 };
    static const double depth[3] = { 5.0, 10.0, 15.0 };
    struct slide slide = { .draw_count = 3, .speed = 30.0, .camera = perspective() };
    for (int i = 0; i < 3; i++) {
        place_quad(position[i], &slide.camera, 8 + 3 * i, 8, 50 + 3 * i, 52, depth[i]);
        surface[i] = surface_of(position[i], 4, quad_index, 2);
        surface[i].uv = uv;
        surface[i].material.image = image;
        surface[i].material.unlit = i < 2;
        slide.draw[i] = draw_of(&surface[i]);
    }
    surface[0].material.alpha = MODEL_ALPHA_BLEND;
    surface[1].material.alpha = MODEL_ALPHA_MASK;
    return slide;
}

static void test_id_scene_shows_the_triangles_of_the_frame(void)
{
    float position[3][12];
    struct scene_surface surface[3];
    struct image image = small_image();
    struct slide slide = three_kinds(position, surface, &image);
    struct scene scene = scene_of(&slide), ids;
    struct failure f = {{0}};
    struct scene_instant now = {0}, id_now = {0};
    REQUIRE(ref_id_scene(&scene, &ids, &f));
    for (int step = 0; step < 4; step++) {
        struct ref_frame frame OWNED(ref_frame_free) = { 0 }, id_frame;
        struct image picture OWNED(image_free) = {0};
        int wrong = 0, seen[6] = { 0 };
        if (!CHECK(scene_pose(&scene, 0.02 * step, &now, &f))
            || !CHECK(scene_pose(&ids, 0.02 * step, &id_now, &f)))
            return;
        draw_now(&now, false, &frame);
        draw_now(&id_now, step % 2 != 0, &id_frame);
        REQUIRE(ref_frame_image(&id_frame, &picture, &f));
        for (size_t i = 0; i < SIZE * SIZE; i++) {
            wrong += ref_id_from_rgb(picture.rgba + 4 * i) != frame.triangle[i];
            if (frame.triangle[i] >= 0)
                seen[frame.triangle[i]]++;
        }
        CHECK_EQ(wrong, 0);
        CHECK(seen[0] == 0 && seen[1] == 0);
        CHECK(seen[2] > 0 && seen[3] > 0 && seen[4] > 0 && seen[5] > 0);
        ref_frame_free(&id_frame);
    }
    scene_instant_free(&scene, &now);
    scene_instant_free(&ids, &id_now);
    scene_free(&ids);
}

struct copied {                     /* what a renderer that agrees would hand over */
    uint8_t rgb[3 * SIZE * SIZE], id[3 * SIZE * SIZE];
    float depth[SIZE * SIZE], velocity[2 * SIZE * SIZE];
};

static struct ref_planes planes_of(const struct ref_frame *frame, struct copied *copy)
{
    for (size_t i = 0; i < SIZE * SIZE; i++) {
        ref_id_to_rgb(frame->triangle[i], copy->id + 3 * i);
        copy->depth[i] = (float)frame->depth[i];
        for (size_t c = 0; c < 2; c++)
            copy->velocity[2 * i + c] = (float)frame->velocity[2 * i + c];
        for (size_t c = 0; c < 3; c++)
            copy->rgb[3 * i + c] =
                (uint8_t)lround(255.0 * ref_srgb_encode(frame->color[3 * i + c]));
    }
    return (struct ref_planes){ .width = SIZE, .height = SIZE, .rgb = copy->rgb,
                                .depth = copy->depth, .velocity = copy->velocity,
                                .id_rgb = copy->id };
}

static void test_comparison_finds_each_planted_difference(void)
{
    static struct copied copy;
    float position[12];
    struct scene_camera camera = orthographic();
    struct failure f = {{0}};
    struct ref_options options = { .width = SIZE, .height = SIZE };
    struct ref_frame frame OWNED(ref_frame_free) = { 0 };
    struct ref_difference d;
    place_quad(position, &camera, 8, 8, 56, 56, 16.0);
    struct scene_surface surface = surface_of(position, 4, quad_index, 2);
    struct scene_draw draw = draw_of(&surface), before = draw;
    struct scene_instant now = instant_of(&draw, 1, camera), then = instant_of(&before, 1, camera);
    before.world[12] = -4.0;
    surface.material.base[1] = 0.25f;
    REQUIRE(ref_draw(&now, &then, &now, &options, &frame, &f));

    struct ref_planes planes = planes_of(&frame, &copy);
    ref_compare(&frame, &planes, &d);
    CHECK_EQ(d.pixels, SIZE * SIZE);
    CHECK_EQ(d.same, 48 * 48);
    CHECK(d.triangle == 0 && d.coverage == 0 && d.off_edge == 0);
    CHECK(d.depth_max < 1e-7 && d.velocity_max < 1e-6 && d.color_max <= 0.5);
    CHECK_EQ(d.velocity_pixels, 46 * 46);

    ref_id_to_rgb(-1, copy.id + 3 * at(8, 20));         /* on the left edge */
    ref_id_to_rgb(0, copy.id + 3 * at(20, 20));         /* perhaps the diagonal's other side */
    ref_id_to_rgb(7, copy.id + 3 * at(3, 60));          /* far from everything */
    ref_id_to_rgb(7, copy.id + 3 * at(30, 50));
    ref_id_to_rgb(1 - frame.triangle[at(30, 30)], copy.id + 3 * at(30, 30));
    copy.depth[at(40, 12)] *= 1.25f;
    copy.velocity[2 * at(41, 12)] += 3.0f;
    copy.velocity[2 * at(41, 12) + 1] -= 4.0f;
    copy.velocity[2 * at(8, 50)] = 99.0f;               /* on the silhouette: not looked at */
    copy.rgb[3 * at(42, 12) + 2] = 205;
    ref_compare(&frame, &planes, &d);
    CHECK_EQ(d.coverage, 2);
    CHECK(d.triangle == 4 || d.triangle == 5);          /* 5 if (20, 20) is triangle 1 */
    CHECK_EQ(d.off_edge, 2);
    CHECK(d.off_edge_x == 30 && d.off_edge_y == 50);
    CHECK(d.depth_x == 40 && d.depth_y == 12);
    CHECK_CLOSE(d.depth_max, 0.25, 1e-6);
    CHECK(d.velocity_x == 41 && d.velocity_y == 12);
    CHECK_CLOSE(d.velocity_max, 5.0, 1e-6);
    CHECK_CLOSE(d.velocity_rms, 5.0 / sqrt(d.velocity_pixels), 1e-6);
    CHECK(d.color_x == 42 && d.color_y == 12);
    CHECK_CLOSE(d.color_max, 50.0, 1e-6);

    planes.width = SIZE - 1;
    ref_compare(&frame, &planes, &d);
    CHECK(d.off_edge == SIZE * SIZE && isinf(d.depth_max) && isinf(d.color_rms));
}

#include "build/suites/ref.h"
