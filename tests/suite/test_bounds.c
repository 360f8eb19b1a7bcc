/* SPDX-License-Identifier: MIT */
/* test_bounds.c - smear_mesh.bounds: draws beyond a side of the view are left out, and no picture changes. Host only. */
#include "tests/rig.h"

enum { WIDTH = 64, HEIGHT = 48, CUBES = 12 };

/* Cubes that fly about, in view and out of it, and through the near plane; whose meshes have bounds, or not. */
struct flock {
    smear_mesh mesh[2];                 /* without, with bounds */
    smear_transform pose[CUBES][3];     /* now, open, close */
    smear_draw draw[CUBES];
    smear_camera camera;
    smear_frame frame;
};

static double random_between(double low, double high)
{
    static uint32_t state = 7;
    state = state * 1664525u + 1013904223u;
    return low + (high - low) * (state >> 8) / 16777216.0;
}

static void scatter(struct flock *f, uint8_t method, bool orthographic)
{
    *f = (struct flock){ .mesh = { cube, cube }, .camera = camera_at(0, 0, 0, 0) };
    smear_mesh_find_bounds(&f->mesh[1]);
    if (orthographic) {
        f->camera.focal = 0;
        f->camera.half_height = q16(3);
        f->camera.far_plane = q16(60);
    }
    for (int i = 0; i < CUBES; i++) {
        double x = random_between(-9, 9), y = random_between(-6, 6), z = random_between(-12, 3);
        for (int k = 0; k < 3; k++)
            f->pose[i][k] = pose_at(x + (k != 0) * random_between(-3, 3), y + (k != 0) * random_between(-3, 3),
                                    z + (k != 0) * random_between(-1, 1), random_between(0, 6), random_between(0, 6));
        f->draw[i] = (smear_draw){ .mesh = &f->mesh[0], .now = &f->pose[i][0] };
        if (i % 3 != 0) {
            f->draw[i].open = &f->pose[i][1];
            f->draw[i].close = &f->pose[i][2];
        }
    }
    f->frame = (smear_frame){ .camera = &f->camera, .method = method, .shutter.poses = 1, .clear = 0x203040 };
}

static void bound(struct flock *f, bool bounded)
{
    for (int i = 0; i < CUBES; i++)
        f->draw[i].mesh = &f->mesh[bounded];
}

static void test_no_picture_changes_by_any_method(void)
{
    uint32_t beside = 0;
    for (uint8_t method = SMEAR_NONE; method <= SMEAR_LAYERED; method++)
        for (int sharp = 0; sharp < 2; sharp++) {
            const bool is_filter = smear_method_is_filter(method);
            if (sharp && is_filter)
                continue;
            /* A time mask needs all moving triangles of a tile at once: the others find room in turn. */
            const bool scarce = sharp && method != SMEAR_TIMEMASK;
            smear_desc desc = { .width = WIDTH, .height = HEIGHT, .reach = 8, .format = SMEAR_XRGB8888,
                                .methods = SMEAR_SET(SMEAR_ACCUMULATE) | SMEAR_SET_TEMPORAL | SMEAR_SET_LAYERS,
                                .max_triangles = scarce ? 24 : 400 };
            if (!sharp)
                desc.methods |= SMEAR_SET_FILTERS;
            RIG(rig, &desc, false);
            for (int n = 0; n < 12; n++) {
                struct flock f;
                smear_stats stats;
                scatter(&f, method, n % 4 == 3 && method != SMEAR_CAMERA);
                uint8_t *want = rig_copy(&rig, &f.frame, f.draw, CUBES);
                smear_get_stats(rig.ctx, &stats);
                CHECK_EQ(stats.draws_beside, 0);
                bound(&f, true);
                CHECK_EQ(rig_frame(&rig, &f.frame, f.draw, CUBES), SMEAR_OK);
                CHECK(want != NULL && same_picture(&rig, want));
                smear_get_stats(rig.ctx, &stats);
                beside += stats.draws_beside;
                free(want);
            }
        }
    CHECK(beside > 300);
}

/* One cube: where it is left out, and where it must not be. */
static uint32_t left_out(struct flock *f)
{
    struct rig rig;
    smear_stats stats = { .draws_beside = 99 };
    smear_desc desc = { .width = WIDTH, .height = HEIGHT, .format = SMEAR_XRGB8888, .methods = SMEAR_SET(SMEAR_AUTO), .tile = 32 };
    f->draw[0].mesh = &f->mesh[1];
    if (rig_begin(&rig, &desc, false)) {
        CHECK_EQ(rig_frame(&rig, &f->frame, f->draw, 1), SMEAR_OK);
        smear_get_stats(rig.ctx, &stats);
    }
    rig_end(&rig);
    return stats.draws_beside;
}

static void test_what_is_beyond_one_side_at_all_times_is_left_out(void)
{
    struct flock f;
    scatter(&f, SMEAR_AUTO, false);
    smear_draw *d = &f.draw[0];
    d->open = &f.pose[0][1];
    d->close = &f.pose[0][2];
    for (int k = 0; k < 3; k++)
        f.pose[0][k] = pose_at(30, 0, -6, 0, 0);
    CHECK_EQ(left_out(&f), 1);
    f.pose[0][1] = pose_at(60, 0, -6, 0, 0);
    CHECK_EQ(left_out(&f), 1);
    f.pose[0][2] = pose_at(0, 0, -6, 0, 0);         /* comes into view */
    CHECK_EQ(left_out(&f), 0);
    f.pose[0][2] = pose_at(-30, 0, -6, 0, 0);       /* goes by */
    CHECK_EQ(left_out(&f), 0);
    for (int k = 0; k < 3; k++)
        f.pose[0][k] = pose_at(0, 0, 8, 0, 0);      /* behind the eye */
    CHECK_EQ(left_out(&f), 1);
    for (int k = 0; k < 3; k++)
        f.pose[0][k] = pose_at(0, 0, -0.5, 0, 0);   /* around it */
    CHECK_EQ(left_out(&f), 0);
}

/* Positions of their own at other poses: bounds are those of the mesh's alone. */
static void test_bounds_count_for_nothing_where_positions_differ(void)
{
    static int16_t moved[24];
    struct flock f;
    scatter(&f, SMEAR_AUTO, false);
    for (int i = 0; i < 24; i++)
        moved[i] = (int16_t)(cube_position[i] - (i % 3 == 0 ? 6000 : 0));
    f.pose[0][0] = pose_at(30, 0, -6, 0, 0);
    CHECK_EQ(left_out(&f), 1);
    f.draw[0].open = f.draw[0].close = NULL;
    f.draw[0].open_position = moved;
    CHECK_EQ(left_out(&f), 0);
}

static void test_bounds_are_found(void)
{
    static const int16_t positions[] = { 5, -3, 7, -32768, 32767, 0, 1, 2, 3 };
    smear_mesh mesh = { .position = positions, .vertex_count = 3 };
    static const int16_t want[6] = { -32768, -3, 0, 5, 32767, 7 };
    smear_mesh_find_bounds(&mesh);
    CHECK(memcmp(mesh.bounds, want, sizeof want) == 0);
    mesh.vertex_count = 0;
    smear_mesh_find_bounds(&mesh);
    for (int i = 0; i < 6; i++)
        CHECK_EQ(mesh.bounds[i], 0);
}

#include "build/suites/bounds.h"
