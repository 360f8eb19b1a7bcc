/* SPDX-License-Identifier: MIT */
/* test_parts.c - heaps of random triangles are the same picture whether one core draws them or eight, which share rows of sharp frames
 * in all formats. Host only; fuzz/cases_many.c has longer lists. */
#include "tests/rig.h"

#include <pthread.h>
#include <sched.h>

/* ------------------------------------------------------------------ heaps */

enum { VERTICES = 60, TRIANGLES = 4000 };

static int16_t position[3 * VERTICES];
static uint16_t indices[3 * TRIANGLES];

static smear_mesh make_heap(int triangles)
{
    const int32_t size[] = { 50, 300, 1000 }, s = size[between(0, 2)];
    const int vertices = between(3, VERTICES);
    for (int i = 0; i < 3 * vertices; i++)
        position[i] = (int16_t)between(-s, s);
    for (int i = 0; i < 3 * triangles; i++)
        indices[i] = (uint16_t)between(0, vertices - 1);
    return (smear_mesh){ .position = position, .index = indices, .vertex_count = (uint16_t)vertices, .triangle_count = (uint32_t)triangles,
                         .shift = 7 };
}

static smear_transform somewhere(void)
{
    return pose_at(uniform(-1.4, 1.4), uniform(-0.9, 0.9), uniform(-6, -1.5), 0, 0);
}

/* ------------------------------------------------------------------ one core and many */

struct core {
    smear_context *ctx;
    int worker;
    pthread_t thread;
};

static void *help(void *argument)
{
    struct core *core = argument;
    smear_work(core->ctx, core->worker);
    return NULL;
}

static void yield(void *user)
{
    (void)user;
    sched_yield();
}

static int draw_by_all(struct rig *r, const smear_frame *frame, const smear_draw *draw)
{
    struct core core[8];
    rig_forget_output(r);
    CHECK_EQ(smear_begin(r->ctx, frame), SMEAR_OK);
    CHECK_EQ(smear_submit(r->ctx, draw), SMEAR_OK);
    for (int i = 1; i < r->desc.workers; i++) {
        core[i] = (struct core){ .ctx = r->ctx, .worker = i };
        CHECK(pthread_create(&core[i].thread, NULL, help, &core[i]) == 0);
    }
    const int result = smear_render(r->ctx);
    for (int i = 1; i < r->desc.workers; i++)
        pthread_join(core[i].thread, NULL);
    return result;
}

/* 256 triangles and more are assembled by all cores; sharp rows, beside the memory of temporal methods, are drawn apart. */
static void check_workers(int seed)
{
    random_state = (uint32_t)seed * 2246822519u + 1u;
    const int triangles = between(256, chance(8) ? TRIANGLES : 500);
    const smear_mesh mesh = make_heap(triangles);
    const smear_material material = { .double_sided = 1 };
    const smear_camera camera = camera_at(0, 0, 0, 0);
    const smear_frame frame = { .camera = &camera, .method = chance(6) ? SMEAR_AUTO : SMEAR_NONE, .light_space = (uint8_t)between(0, 1) };
    smear_desc desc = { .width = (int16_t)between(1, 160), .height = (int16_t)between(40, 130), .max_draws = 4, .idle = yield,
                        .methods = SMEAR_SET(SMEAR_NONE) | SMEAR_SET(SMEAR_AUTO), .format = (uint8_t)between(0, SMEAR_L1) };
    smear_transform now = somewhere();
    smear_draw draw = { .id = 1, .mesh = &mesh, .material = &material, .now = &now };
    struct rig alone, all;
    smear_stats stats[2];
    desc.max_triangles = 2 * TRIANGLES;
    const bool ok = rig_begin(&alone, &desc, false);
    desc.workers = (uint8_t)between(2, 8);
    desc.max_triangles = (uint32_t)between(triangles / 4, 2 * TRIANGLES);
    if (rig_begin(&all, &desc, false) && ok)
        for (int k = 0; k < 2; k++) {
            now.origin[0] += between(-9000, 9000);
            CHECK_EQ(rig_frame(&alone, &frame, &draw, 1), SMEAR_OK);
            CHECK_EQ(draw_by_all(&all, &frame, &draw), SMEAR_OK);
            CHECK(alone.picture_size == all.picture_size);
            same_picture(&all, alone.picture);
            smear_get_stats(alone.ctx, &stats[0]);
            smear_get_stats(all.ctx, &stats[1]);
            CHECK(stats[1].parts_added != 0 || stats[0].triangles_drawn == stats[1].triangles_drawn);
            CHECK(stats[1].fill.segments.used <= stats[1].fill.segments.room && stats[1].fill.geometry.used <= stats[1].fill.geometry.room);
        }
    rig_end(&alone);
    rig_end(&all);
}

static void test_many_triangles_are_the_same_picture_by_any_number_of_cores(void)
{
    for (int seed = 1; seed <= 120; seed++)
        check_workers(seed);
}

#include "build/suites/parts.h"
