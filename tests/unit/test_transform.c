/* SPDX-License-Identifier: MIT */
/* test_transform.c - depth before orthographic cameras, places anywhere, outcodes. Where vertices are is held by golden frames and the
 * suite accuracy. Host only. */
#include "geometry/transform.h"

#include "tests/rig.h"

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
