/* SPDX-License-Identifier: MIT */
/* test_transform.c - screen positions and depth of vertices against the same numbers in double
 * precision: rigid, scaled, sheared, mirrored, tiny and huge transforms. Host only. */
#include "geometry/transform.h"

#include "tests/rig.h"

/* One vertex, exactly as smear.h says: where it is on the screen (pixels from the centre) and how far away. */
struct exact {
    double x, y, distance;
};

static struct exact exactly(const smear_mesh *mesh, const smear_transform *object, const smear_camera *camera,
                            int height, const int16_t v[3])
{
    double world[3], view[3];
    for (int i = 0; i < 3; i++) {
        world[i] = object->origin[i] / 65536.0;
        for (int j = 0; j < 3; j++)
            world[i] += object->basis[3 * i + j] / 16777216.0
                      * ldexp(((double)v[j] + mesh->offset[j]) * (mesh->scale != 0 ? mesh->scale : 1), -mesh->shift);
    }
    for (int j = 0; j < 3; j++) {
        view[j] = 0;
        for (int i = 0; i < 3; i++)
            view[j] += camera->pose.basis[3 * i + j] / 16777216.0 * (world[i] - camera->pose.origin[i] / 65536.0);
    }
    struct exact e = { 0, 0, -view[2] };
    double pixels = camera->half_height > 0 ? height / (2 * (camera->half_height / 65536.0))
                                            : camera->focal / 65536.0 * height / 2 / e.distance;
    e.x = view[0] * pixels;
    e.y = -view[1] * pixels;
    return e;
}

/* Depth units of smear.h, q11. */
static double exact_units(const smear_camera *camera, double distance)
{
    double near = camera->near_plane / 65536.0, far = camera->far_plane / 65536.0;
    double units = camera->half_height > 0 ? (far - distance) * SMEAR_DEPTH_NEAR / (far - near)
                                           : near * SMEAR_DEPTH_NEAR / distance;
    return units * 2048;
}

enum kind { RIGID, SCALED, SHEARED, MIRRORED, TINY, HUGE_SCENE, OFFSET, KINDS };

static void random_scene(enum kind kind, smear_mesh *mesh, smear_transform *object, smear_camera *camera)
{
    static const int16_t none[3];
    /* A mesh of 32767 steps and about `size` units, in front of the camera. */
    double size = kind == TINY ? uniform(0.002, 0.01) : kind == HUGE_SCENE ? uniform(500, 2000) : uniform(0.5, 4);
    int shift = 0;
    double scale = size / 32768;
    while (scale < 1 << 20 && shift < 60) {
        scale *= 2;
        shift++;
    }
    *mesh = (smear_mesh){ .position = none, .vertex_count = 1, .scale = (int32_t)scale, .shift = (int8_t)shift };
    random_rotation(object->basis, 1);
    if (kind == SCALED)
        for (int i = 0; i < 9; i++)
            object->basis[i] = (int32_t)(object->basis[i] * uniform(0.2, 3));
    if (kind == SHEARED)
        object->basis[1 + between(0, 1)] += 1 << 24;
    if (kind == MIRRORED)
        for (int i = 0; i < 3; i++)
            object->basis[3 * i] = -object->basis[3 * i];
    if (kind == OFFSET)
        for (int i = 0; i < 3; i++)
            mesh->offset[i] = between(-20000, 20000);
    random_rotation(camera->pose.basis, 1);
    double away = size * uniform(2, 12);
    for (int i = 0; i < 3; i++) {
        camera->pose.origin[i] = (int32_t)lrint(uniform(-3000, 3000) * 65536);
        double forward = -camera->pose.basis[3 * i + 2] / 16777216.0;
        object->origin[i] = camera->pose.origin[i] + (int32_t)lrint(forward * away * 65536);
    }
    camera->focal = (int32_t)lrint(uniform(0.7, 3) * 65536);
    camera->near_plane = (int32_t)lrint(size * 0.05 * 65536) + 1;
    camera->far_plane = 0;
    camera->half_height = 0;
}

/* Worst error of 400 vertices in the view, pixels. */
static double worst_position(enum kind kind, bool orthographic, int height, double *worst_depth)
{
    double worst = 0;
    *worst_depth = 0;
    for (int n = 0; n < 400; n++) {
        smear_mesh mesh;
        smear_transform object;
        smear_camera camera;
        random_scene(kind, &mesh, &object, &camera);
        if (orthographic) {
            double reach = ldexp(mesh.scale, -mesh.shift) * 32768;
            camera.half_height = (int32_t)lrint(reach * 2 * 65536) + 1;
            camera.far_plane = (int32_t)fmin(reach * 40 * 65536 + camera.near_plane + 1, INT32_MAX);
        }
        struct smear_view view;
        struct smear_projection p;
        smear_view_compose(&view, &object, &mesh, &camera.pose);
        smear_projection_make(&p, &view, &camera, height, 0);
        const struct smear_viewport viewport = { height * 4 / 3, height };
        for (int k = 0; k < 8; k++) {
            const int16_t v[3] = { (int16_t)between(-32768, 32767), (int16_t)between(-32768, 32767),
                                   (int16_t)between(-32768, 32767) };
            struct exact want = exactly(&mesh, &object, &camera, height, v);
            if (want.distance < camera.near_plane / 65536.0 || fabs(want.x) > height || fabs(want.y) > height)
                continue;
            if (orthographic && want.distance > camera.far_plane / 65536.0)
                continue;
            struct smear_homogeneous h;
            struct smear_screen s;
            smear_transform_vertex(&h, &p, v);
            if (!CHECK(h.w > 0))
                return INFINITY;
            smear_project(&s, &p.depths, &h, &viewport);
            double ex = fabs((s.x - viewport.width * 128) / 256.0 - want.x);
            double ey = fabs((s.y - viewport.height * 128) / 256.0 - want.y);
            worst = fmax(worst, fmax(ex, ey));
            double units = fmax(exact_units(&camera, want.distance), SMEAR_DEPTH_MIN);
            double depth = orthographic ? fabs(s.depth - units) / (SMEAR_DEPTH_NEAR * 2048.0) : fabs(s.depth / units - 1);
            *worst_depth = fmax(*worst_depth, depth);
        }
    }
    return worst;
}

/* Rounding to 1/256 px is 0.002; 0.01 px leaves room for rows of 30 bits and the reciprocal. */
static void test_positions_are_within_a_hundredth_of_a_pixel(void)
{
    random_state = 1;
    for (int kind = RIGID; kind < KINDS; kind++)
        for (int orthographic = 0; orthographic < 2; orthographic++) {
            double depth, worst = worst_position((enum kind)kind, orthographic, 240, &depth);
            if (!CHECK_CLOSE(worst, 0.0, 0.01))
                CHECK_EQ(kind * 10 + orthographic, (int64_t)(worst * 1e6));
            /* A part in 2^15 for perspective, of the whole range for orthographic: half a code or less. */
            if (!CHECK_CLOSE(depth, 0.0, 1 / 32768.0))
                CHECK_EQ(kind * 10 + orthographic, (int64_t)(depth * 1e9));
        }
}

/* X, Y and W share a scale, so W has as many bits less as a pixel is smaller than the distance: the error grows with
 * the square of the height. */
static void test_positions_in_the_largest_frame_are_within_a_fifth_of_a_pixel(void)
{
    random_state = 2;
    for (int kind = RIGID; kind < KINDS; kind++) {
        double depth, worst = worst_position((enum kind)kind, false, 2048, &depth);
        if (!CHECK_CLOSE(worst, 0.0, 0.2))
            CHECK_EQ(kind, (int64_t)(worst * 1e6));
    }
}

static void test_the_near_plane_has_the_largest_depth_and_far_things_the_smallest(void)
{
    const smear_mesh mesh = { .shift = 8, .vertex_count = 1 };
    const smear_transform object = SMEAR_IDENTITY;
    smear_camera camera = { .pose = SMEAR_IDENTITY, .focal = 65536, .near_plane = 65536 };
    struct smear_view view;
    struct smear_projection p;
    smear_view_compose(&view, &object, &mesh, &camera.pose);
    smear_projection_make(&p, &view, &camera, 240, 0);
    const struct smear_viewport viewport = { 320, 240 };
    int32_t last = INT32_MAX;
    for (int z = 256; z <= 32767; z += z < 1024 ? 1 : 97) {
        const int16_t v[3] = { 0, 0, (int16_t)-z };
        struct smear_homogeneous h;
        struct smear_screen s;
        smear_transform_vertex(&h, &p, v);
        smear_project(&s, &p.depths, &h, &viewport);
        if (z == 256) {
            CHECK_EQ(h.distance, p.depths.near_distance);
            CHECK_NEAR(s.depth, SMEAR_DEPTH_MAX, 1 << 14);
        }
        CHECK(s.depth <= last && s.depth >= SMEAR_DEPTH_MIN);
        last = s.depth;
        CHECK_EQ(s.x, 160 * 256);
        CHECK_EQ(s.y, 120 * 256);
    }
}

static void test_orthographic_depth_runs_evenly_from_near_to_far(void)
{
    const smear_mesh mesh = { .shift = 8, .vertex_count = 1 };
    const smear_transform object = SMEAR_IDENTITY;
    smear_camera camera = { .pose = SMEAR_IDENTITY, .half_height = 65536, .near_plane = 65536, .far_plane = 101 * 65536 };
    struct smear_view view;
    struct smear_projection p;
    smear_view_compose(&view, &object, &mesh, &camera.pose);
    smear_projection_make(&p, &view, &camera, 200, 0);
    CHECK(p.depths.orthographic);
    const struct smear_viewport viewport = { 200, 200 };
    for (int z = 256; z <= 101 * 256; z += 256) {
        const int16_t v[3] = { 128, 64, (int16_t)-z };
        struct smear_homogeneous h;
        struct smear_screen s;
        smear_transform_vertex(&h, &p, v);
        smear_project(&s, &p.depths, &h, &viewport);
        double units = (double)SMEAR_DEPTH_NEAR * 2048 * (101 * 256 - z) / (100 * 256);
        CHECK_CLOSE(s.depth, fmax(units, SMEAR_DEPTH_MIN), 8192.0);
        CHECK_EQ(s.x, 100 * 256 + 50 * 256);        /* size does not depend on distance */
        CHECK_EQ(s.y, 100 * 256 - 25 * 256);
    }
}

static void test_any_positive_w_and_any_place_project_without_overflow(void)
{
    static const int32_t value[] = { 0, 1, -1, 1000, -1000, (1 << 30) - 1, -(1 << 30) + 1, 1 << 20, -(1 << 20) };
    const smear_mesh mesh = { .shift = 8, .vertex_count = 1 };
    const smear_transform object = SMEAR_IDENTITY;
    const smear_camera camera = { .pose = SMEAR_IDENTITY, .focal = 65536, .near_plane = 1 };
    struct smear_view view;
    struct smear_projection p;
    smear_view_compose(&view, &object, &mesh, &camera.pose);
    smear_projection_make(&p, &view, &camera, 240, 0);
    const struct smear_viewport viewport = { 2048, 2048 };
    const double guard = SMEAR_GUARD_PX * 256.0;
    for (int i = 0; i < 9; i++)
        for (int j = 0; j < 9; j++)
            for (int32_t w = 1; w > 0 && w < 1 << 30; w = w * 3 + 1) {
                struct smear_homogeneous h = { value[i], value[j], w, w };
                struct smear_screen s;
                smear_project(&s, &p.depths, &h, &viewport);
                double x = 256.0 * h.x / w, got = s.x - viewport.width * 128;
                /* Right within the guard band, and beyond it where it is beyond it. The high product has steps of
                 * 2^-8 px for w from 2^10 on, larger ones below. */
                double slack = 2 + fabs(x) / (1 << 18) + 2048.0 / w;
                bool ok = fabs(x) <= guard ? CHECK_CLOSE(got, x, slack)
                                           : CHECK(x > 0 ? got > guard * 0.999 : got < -guard * 0.999);
                if (!ok)
                    return;
                CHECK(s.depth >= SMEAR_DEPTH_MIN && s.depth <= SMEAR_DEPTH_MAX);
            }
}

static void test_outcodes_name_the_sides_and_the_guard_band(void)
{
    const struct smear_viewport viewport = { 320, 240 };
    const int32_t guard = SMEAR_GUARD_PX << 8, cx = 160 << 8, cy = 120 << 8;
    const struct { int32_t x, y; int code; } at[] = {
        { cx, cy, 0 }, { 0, 0, 0 }, { 320 << 8, 240 << 8, 0 }, { -1, cy, OUT_LEFT }, { (320 << 8) + 1, cy, OUT_RIGHT },
        { cx, -1, OUT_TOP }, { cx, (240 << 8) + 1, OUT_BOTTOM }, { -1, -1, OUT_LEFT | OUT_TOP },
        { cx - guard, cy, OUT_LEFT }, { cx - guard - 1, cy, OUT_LEFT | OUT_GUARD },
        { cx + guard + 1, cy + guard + 1, OUT_RIGHT | OUT_BOTTOM | OUT_GUARD }, { cx, cy - guard - 1, OUT_TOP | OUT_GUARD }
    };
    for (int i = 0; i < (int)(sizeof at / sizeof at[0]); i++) {
        const struct smear_screen s = { .x = at[i].x, .y = at[i].y };
        CHECK_EQ(outcode_sides(&s, &viewport), at[i].code);
    }
}

#include "build/suites/transform.h"
