/* SPDX-License-Identifier: MIT */
/* test_budget.c - smear_frame.budget: a frame is as fine as it may be, and is the same as by that target. Host only. */
#include "tests/rig.h"

enum { CUBES = 3 };

/* Cubes that go by, each faster than the other. */
static int draw_frame(struct rig *r, uint16_t target, uint32_t budget)
{
    static const smear_material material = { .color = { 230, 120, 60, 255 } };
    const smear_camera camera = camera_at(0, 0, 0, 0);
    smear_transform now[CUBES], open[CUBES], close[CUBES];
    smear_draw draw[CUBES];
    for (int i = 0; i < CUBES; i++) {
        const double way = 0.2 + 0.5 * i, x = 2.4 * (i - 1);
        now[i] = pose_at(x, 0.3 * i, -6, 0.3, 0.2);
        open[i] = pose_at(x - way, 0.3 * i, -6, 0.3, 0.2);
        close[i] = pose_at(x + way, 0.3 * i, -6, 0.3, 0.2);
        draw[i] = (smear_draw){ .mesh = &cube, .material = &material, .now = &now[i], .open = &open[i], .close = &close[i] };
    }
    const smear_frame frame = { .camera = &camera, .method = SMEAR_AUTO, .shutter.poses = 1, .target = target,
                                .budget = budget };
    rig_forget_output(r);
    return rig_frame(r, &frame, draw, CUBES);
}

static smear_stats stats_of(const struct rig *r)
{
    smear_stats s;
    smear_get_stats(r->ctx, &s);
    return s;
}

static bool rig_open(struct rig *r, uint32_t triangles)
{
    const smear_desc desc = { .width = 120, .height = 90, .format = SMEAR_XRGB8888, .methods = SMEAR_SET(SMEAR_AUTO), .tile = 16,
                              .debug.crc = 1, .max_triangles = triangles };
    return rig_begin(r, &desc, false);
}

static void test_a_budget_makes_a_frame_as_fine_as_it_may_be(void)
{
    static const uint16_t finest[] = { SMEAR_FINE, SMEAR_BALANCED, SMEAR_DRAFT, 1, 100 };
    struct rig r;
    if (rig_open(&r, 100))
        for (unsigned i = 0; i < sizeof finest / sizeof *finest; i++) {
            CHECK_EQ(draw_frame(&r, finest[i], UINT32_MAX), SMEAR_OK);
            const smear_stats whole = stats_of(&r);
            CHECK_EQ(whole.target, finest[i]);
            CHECK(whole.work > 1000 && whole.work < 1000000);
            uint32_t last = finest[i], steps = 0;
            for (uint32_t budget = whole.work; budget > 100; budget -= budget / 16 + 1) {
                CHECK_EQ(draw_frame(&r, finest[i], budget), SMEAR_OK);
                const smear_stats bound = stats_of(&r);
                CHECK(bound.target >= last);
                CHECK(bound.work <= budget || bound.target == SMEAR_DRAFT);
                steps += bound.target != last;
                last = bound.target;
                CHECK_EQ(draw_frame(&r, (uint16_t)bound.target, 0), SMEAR_OK);
                const smear_stats by_target = stats_of(&r);
                CHECK_EQ(by_target.crc32, bound.crc32);
                CHECK_EQ(by_target.samples, bound.samples);
                CHECK_EQ(by_target.work, 0);        /* nobody asked */
            }
            CHECK_EQ(last, SMEAR_DRAFT);
            CHECK(finest[i] >= SMEAR_BALANCED ? steps <= 3 : steps >= 3);
        }
    rig_end(&r);
}

/* Parts of a frame have their shares: none is more than the whole may have. */
static void test_parts_of_a_frame_share_the_budget(void)
{
    struct rig whole, parts;
    if (rig_open(&whole, 100) && rig_open(&parts, 16))
        for (uint32_t budget = 500; budget < 200000; budget += budget / 2) {
            CHECK_EQ(draw_frame(&parts, SMEAR_FINE, budget), SMEAR_OK);
            const smear_stats s = stats_of(&parts);
            CHECK(s.parts_added > 0);
            CHECK(s.work <= budget || s.target == SMEAR_DRAFT);
            CHECK_EQ(draw_frame(&whole, SMEAR_FINE, budget), SMEAR_OK);
            CHECK(stats_of(&whole).target <= s.target);
        }
    rig_end(&whole);
    rig_end(&parts);
}

#include "build/suites/budget.h"
