/* SPDX-License-Identifier: MIT */
/* test_edges.c - smooth edges are the same with any number of workers, in parts, kept or not; what is refused. Host only. */
#include "tests/rig.h"
#include "tests/test.h"
#include "tools/player/crew.h"

#include <stdlib.h>
#include <string.h>

void suite_edges(void);

/* ------------------------------------------------------------------ the same bits */

enum { WIDTH = 160, HEIGHT = 120, PIXELS = WIDTH * HEIGHT, FRAMES = 4 };

static smear_desc desc_of(uint32_t methods)
{
    return (smear_desc){ .width = WIDTH, .height = HEIGHT, .format = SMEAR_XRGB8888, .tile = 16, .methods = (uint16_t)methods };
}

static size_t bytes_of(const smear_desc *desc)
{
    return 4 * (size_t)(desc->width * desc->height);
}

/* Frame number `last` of the busy scene, whose camera stands still; the caller frees it. */
static uint8_t *picture_of(const smear_desc *desc, int method, smear_edges edges, bool linear, int last)
{
    struct rig r;
    struct failure f;
    uint8_t *picture = NULL;
    if (!rig_begin(&r, desc, false))
        return NULL;
    struct crew *crew = crew_start(desc->workers, &f);
    for (int i = 0; i <= last && CHECK(crew != NULL || desc->workers < 2); i++) {
        struct scene s, still;
        make_scene(&s, 0.1 * i, method);
        make_scene(&still, 0, method);
        s.pose[0] = still.pose[0];
        s.pose[1] = still.pose[1];
        s.camera = still.camera;
        s.frame.edges = edges;
        s.frame.light_space = linear ? SMEAR_LIGHT_LINEAR : SMEAR_LIGHT_ENCODED;
        rig_forget_output(&r);
        CHECK_EQ(smear_begin(r.ctx, &s.frame), SMEAR_OK);
        for (int d = 0; d < SCENE_DRAWS; d++)
            CHECK_EQ(smear_submit(r.ctx, &s.draw[d]), SMEAR_OK);
        CHECK_EQ(crew_render(crew, r.ctx), SMEAR_OK);
    }
    crew_stop(crew);
    CHECK(guards_intact(&r));
    picture = malloc(bytes_of(desc));
    if (picture != NULL)
        memcpy(picture, r.picture, bytes_of(desc));
    rig_end(&r);
    return picture;
}

static void check_same(const smear_desc *desc, int method, bool linear, const uint8_t *want, int last)
{
    uint8_t *got = picture_of(desc, method, SMEAR_EDGES_SMOOTH, linear, last);
    CHECK(want != NULL && got != NULL && memcmp(want, got, bytes_of(desc)) == 0);
    free(got);
}

static void test_workers_parts_and_what_is_kept_make_no_difference(void)
{
    static const int methods[] = { SMEAR_AUTO, SMEAR_SUBFRAMES };
    for (int k = 0; k < 4; k++) {
        const int method = methods[k & 1];
        const bool linear = k >= 2;
        smear_desc desc = desc_of(SMEAR_SET(method));
        uint8_t *want = picture_of(&desc, method, SMEAR_EDGES_SMOOTH, linear, FRAMES - 1);
        desc.idle = crew_idle;
        for (int workers = 2; workers <= 8; workers += 3) {
            desc.workers = (uint8_t)workers;
            check_same(&desc, method, linear, want, FRAMES - 1);
        }
        desc.workers = 1;
        desc.max_triangles = 14;        /* drawn in parts, and rows a few triangles at a time */
        check_same(&desc, method, linear, want, FRAMES - 1);
        desc = desc_of(SMEAR_SET(method));
        desc.reuse.cache_static = 1;
        check_same(&desc, method, linear, want, FRAMES - 1);
        desc.workers = 4;
        desc.idle = crew_idle;
        check_same(&desc, method, linear, want, FRAMES - 1);
        free(want);
    }
}

static void test_methods_beside_make_no_difference(void)
{
    smear_desc desc = desc_of(SMEAR_SET(SMEAR_AUTO));
    uint8_t *want = picture_of(&desc, SMEAR_AUTO, SMEAR_EDGES_SMOOTH, false, 1);
    desc.methods |= SMEAR_SET(SMEAR_TIMEMASK) | SMEAR_SET(SMEAR_ACCUMULATE);
    check_same(&desc, SMEAR_AUTO, false, want, 1);
    free(want);
}

/* Strips as narrow as they can be: a few columns are smoothed at once. */
static void test_narrow_strips_are_smooth(void)
{
    for (int tile = 8; tile <= 64; tile *= 2) {
        smear_desc desc = desc_of(SMEAR_SET(SMEAR_AUTO));
        desc.tile = desc.strip = (int16_t)tile;
        uint8_t *hard = picture_of(&desc, SMEAR_AUTO, SMEAR_EDGES_HARD, false, 0);
        uint8_t *want = picture_of(&desc, SMEAR_AUTO, SMEAR_EDGES_SMOOTH, false, 0);
        CHECK(hard != NULL && want != NULL && memcmp(hard, want, PIXELS * 4) != 0);
        desc.workers = 3;
        desc.idle = crew_idle;
        check_same(&desc, SMEAR_AUTO, false, want, 0);
        free(hard);
        free(want);
    }
}

/* The last unit of eight columns is cut by the picture's side. */
static void test_any_width_is_smooth(void)
{
    for (int width = WIDTH - 8; width < WIDTH; width++) {
        smear_desc desc = desc_of(SMEAR_SET(SMEAR_AUTO));
        desc.width = (int16_t)width;
        uint8_t *hard = picture_of(&desc, SMEAR_AUTO, SMEAR_EDGES_HARD, false, 0);
        uint8_t *want = picture_of(&desc, SMEAR_AUTO, SMEAR_EDGES_SMOOTH, false, 0);
        CHECK(hard != NULL && want != NULL && memcmp(hard, want, bytes_of(&desc)) != 0);
        desc.workers = 2;
        desc.idle = crew_idle;
        check_same(&desc, SMEAR_AUTO, false, want, 0);
        free(hard);
        free(want);
    }
}

/* What is kept is drawn again when edges become smooth, and hard. */
static void test_what_is_kept_is_drawn_again(void)
{
    struct rig r[2];
    for (int i = 0; i < 2; i++) {
        smear_desc desc = desc_of(SMEAR_SET(SMEAR_AUTO));
        desc.reuse.cache_static = i == 0;
        CHECK(rig_begin(&r[i], &desc, false));
    }
    for (int k = 0; k < 6; k++) {
        uint8_t *picture[2];
        for (int i = 0; i < 2; i++) {
            struct scene s;
            make_scene(&s, 0, SMEAR_AUTO);
            s.frame.edges = (uint8_t)(k / 2 % 2);
            picture[i] = rig_copy(&r[i], &s.frame, s.draw, SCENE_DRAWS);
        }
        CHECK(picture[0] != NULL && picture[1] != NULL && memcmp(picture[0], picture[1], PIXELS * 4) == 0);
        free(picture[0]);
        free(picture[1]);
    }
    rig_end(&r[0]);
    rig_end(&r[1]);
}

/* ------------------------------------------------------------------ what is refused */

static void test_other_methods_refuse(void)
{
    struct scene s;
    struct rig r;
    const smear_desc desc = desc_of(SMEAR_SET(SMEAR_AUTO) | SMEAR_SET(SMEAR_TIMEMASK) | SMEAR_SET(SMEAR_ACCUMULATE));
    CHECK(rig_begin(&r, &desc, false));
    static const struct {
        int method, edges;
        bool good;
    } frames[] = {
        { SMEAR_AUTO, SMEAR_EDGES_SMOOTH, true },      { SMEAR_AUTO, 2, false },
        { SMEAR_NONE, SMEAR_EDGES_SMOOTH, false },     { SMEAR_TIMEMASK, SMEAR_EDGES_SMOOTH, false },
        { SMEAR_ACCUMULATE, SMEAR_EDGES_SMOOTH, false }, { SMEAR_NONE, SMEAR_EDGES_HARD, true },
    };
    for (size_t i = 0; i < sizeof frames / sizeof *frames; i++) {
        make_scene(&s, 0, frames[i].method);
        s.frame.edges = (uint8_t)frames[i].edges;
        const int result = smear_begin(r.ctx, &s.frame);
        CHECK_EQ(result == SMEAR_OK, frames[i].good);
        CHECK(frames[i].good || strstr(smear_error_text(result), "frame.edges: ") == smear_error_text(result));
    }
    rig_end(&r);
}

static void test_tiles_kept_without_the_picture_refuse(void)
{
    for (int cache = 0; cache < 2; cache++) {
        struct scene s;
        struct rig r;
        smear_desc desc = desc_of(SMEAR_SET(SMEAR_AUTO));
        desc.reuse.buffer_age = 1;
        desc.reuse.cache_static = (uint8_t)cache;
        CHECK(rig_begin(&r, &desc, false));
        make_scene(&s, 0, SMEAR_AUTO);
        s.frame.edges = SMEAR_EDGES_SMOOTH;
        CHECK_EQ(smear_begin(r.ctx, &s.frame) == SMEAR_OK, cache == 1);
        rig_end(&r);
    }
}

void suite_edges(void)
{
    RUN(test_workers_parts_and_what_is_kept_make_no_difference);
    RUN(test_methods_beside_make_no_difference);
    RUN(test_narrow_strips_are_smooth);
    RUN(test_any_width_is_smooth);
    RUN(test_what_is_kept_is_drawn_again);
    RUN(test_other_methods_refuse);
    RUN(test_tiles_kept_without_the_picture_refuse);
}
