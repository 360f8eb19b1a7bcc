/* SPDX-License-Identifier: MIT */
/* test_parts.c - heaps of random triangles are the same picture whether there is room for all of them or for some, and whether one
 * core draws them or eight: colours, and velocities before the blur. Host only; fuzz/cases_many.c has longer lists. */
#include "tests/random.h"
#include "tests/rig.h"
#include "tests/test.h"

#include <pthread.h>
#include <sched.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void suite_parts(void);

/* ------------------------------------------------------------------ heaps */

enum { VERTICES = 60, TRIANGLES = 4000 };

static int16_t position[3 * VERTICES], other_position[3 * VERTICES];
static uint16_t indices[3 * TRIANGLES];

static smear_mesh make_heap(int triangles)
{
    const int32_t size[] = { 50, 300, 1000 }, s = size[between(0, 2)];
    const int vertices = between(3, VERTICES);
    for (int i = 0; i < 3 * vertices; i++) {
        position[i] = (int16_t)between(-s, s);
        other_position[i] = (int16_t)(position[i] ^ (chance(4) ? between(0, 15) : 0));
    }
    for (int i = 0; i < 3 * triangles; i++)
        indices[i] = (uint16_t)between(0, vertices - 1);
    return (smear_mesh){ .position = position, .index = indices, .vertex_count = (uint16_t)vertices, .triangle_count = (uint32_t)triangles,
                         .shift = 7 };
}

static smear_transform somewhere(void)
{
    return pose_at(uniform(-1.4, 1.4), uniform(-0.9, 0.9), uniform(-6, -1.5), 0, 0);
}

/* ------------------------------------------------------------------ few and many */

/* Draws of any motion before a camera that moves, by a filter that takes velocities of vertices, or of depth. */
struct heap {
    smear_mesh mesh;
    smear_material material;
    smear_transform pose[4];
    smear_draw draw[2];
    smear_camera camera, before;
    smear_frame frame;
};

static void make_frame(struct heap *h)
{
    static const uint8_t methods[] = { SMEAR_CAMERA, SMEAR_PINGPONG, SMEAR_RECONSTRUCT }, steps[] = { 0, 1, 2, 4 };
    *h = (struct heap){ .mesh = make_heap(between(4, 120)), .material.double_sided = chance(2), .camera = camera_at(0, 0, 0, 0) };
    for (int i = 0; i < 4; i++)
        h->pose[i] = somewhere();
    h->before = h->camera;
    h->camera.pose = pose_at(uniform(-0.3, 0.3), uniform(-0.3, 0.3), uniform(-0.3, 0.3), uniform(-0.09, 0.09), uniform(-0.09, 0.09));
    for (int i = 0; i < 2; i++)
        h->draw[i] = (smear_draw){ .mesh = &h->mesh, .material = &h->material, .now = &h->pose[2 * i],
                                   .open = chance(3) ? &h->pose[2 * i + 1] : NULL, .open_position = chance(3) ? other_position : NULL,
                                   .motion = (uint8_t)between(SMEAR_MOTION_FULL, SMEAR_MOTION_NONE) };
    h->frame = (smear_frame){ .camera = &h->camera, .open = &h->before, .method = methods[between(0, 2)], .clear = 0x203040,
                              .light_space = (uint8_t)between(0, 1), .filter.kind = (uint8_t)between(1, 3),
                              .filter.camera_step = steps[between(0, 3)], .filter.pingpong.passes = 1 };
}

static void check_room(int seed)
{
    smear_desc desc = { .width = 62, .height = 33, .methods = SMEAR_SET_FILTERS & ~SMEAR_SET(SMEAR_HALF), .reach = 8, .tile = 8,
                        .max_triangles = 4096, .max_draws = 4 };
    struct heap h;
    struct rig whole, parts;
    random_state = (uint32_t)seed * 2654435761u + 1u;
    make_frame(&h);
    const bool ok = rig_begin(&whole, &desc, true);
    desc.max_triangles = (uint32_t)between(4, 60);
    if (rig_begin(&parts, &desc, true) && ok) {
        CHECK_EQ(rig_frame(&whole, &h.frame, h.draw, 2), SMEAR_OK);
        CHECK_EQ(rig_frame(&parts, &h.frame, h.draw, 2), SMEAR_OK);
        const bool same = memcmp(whole.picture, parts.picture, whole.picture_room) == 0
                       && memcmp(whole.velocity, parts.velocity, (size_t)desc.width * (size_t)desc.height * 8) == 0;
        if (!CHECK(same)) {
            char text[60];
            snprintf(text, sizeof text, "    heap %d\n", seed);
            test_print(text);
        }
    }
    rig_end(&whole);
    rig_end(&parts);
}

static void test_colours_and_velocities_do_not_depend_on_the_room_for_triangles(void)
{
    for (int seed = 1; seed <= 3000; seed++)
        check_room(seed);
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

void suite_parts(void)
{
    RUN(test_colours_and_velocities_do_not_depend_on_the_room_for_triangles);
    RUN(test_many_triangles_are_the_same_picture_by_any_number_of_cores);
}
