/* SPDX-License-Identifier: MIT */
/* test_bounds.c - smear_mesh.bounds: draws beyond a side of the view are left out. That no picture changes is what the generator of
 * frames (tests/fuzz) finds. Host only. */
#include "tests/rig.h"

enum { WIDTH = 64, HEIGHT = 48 };

/* A cube whose mesh has bounds. */
struct bounded {
    smear_mesh mesh;
    smear_transform pose[3];            /* now, open, close */
    smear_draw draw;
    smear_camera camera;
    smear_frame frame;
};

static void set_up(struct bounded *f)
{
    *f = (struct bounded){ .mesh = cube, .camera = camera_at(0, 0, 0, 0) };
    smear_mesh_find_bounds(&f->mesh);
    f->draw = (smear_draw){ .mesh = &f->mesh, .now = &f->pose[0], .open = &f->pose[1], .close = &f->pose[2] };
    f->frame = (smear_frame){ .camera = &f->camera, .method = SMEAR_AUTO, .shutter.poses = 1 };
}

/* All poses. */
static void put(struct bounded *f, double x, double z)
{
    for (int k = 0; k < 3; k++)
        f->pose[k] = pose_at(x, 0, z, 0, 0);
}

/* Where it is left out, and where it must not be. */
static uint32_t left_out(const struct bounded *f)
{
    smear_stats stats;
    const smear_desc desc = { .width = WIDTH, .height = HEIGHT, .format = SMEAR_XRGB8888, .methods = SMEAR_SET(SMEAR_AUTO), .tile = 32 };
    RIG(rig, &desc, false);
    CHECK_EQ(rig_frame(&rig, &f->frame, &f->draw, 1), SMEAR_OK);
    smear_get_stats(rig.ctx, &stats);
    return stats.draws_beside;
}

static void test_what_is_beyond_one_side_at_all_times_is_left_out(void)
{
    struct bounded f;
    set_up(&f);
    put(&f, 30, -6);
    CHECK_EQ(left_out(&f), 1);
    f.pose[1] = pose_at(60, 0, -6, 0, 0);
    CHECK_EQ(left_out(&f), 1);
    f.pose[2] = pose_at(0, 0, -6, 0, 0);        /* comes into view */
    CHECK_EQ(left_out(&f), 0);
    f.pose[2] = pose_at(-30, 0, -6, 0, 0);      /* goes by */
    CHECK_EQ(left_out(&f), 0);
    put(&f, 0, 8);                              /* behind the eye */
    CHECK_EQ(left_out(&f), 1);
    put(&f, 0, -0.5);                           /* around it */
    CHECK_EQ(left_out(&f), 0);
}

/* Positions of their own at other poses: bounds are those of the mesh's alone. */
static void test_bounds_count_for_nothing_where_positions_differ(void)
{
    static int16_t moved[24];
    struct bounded f;
    set_up(&f);
    for (int i = 0; i < 24; i++)
        moved[i] = (int16_t)(cube_position[i] - (i % 3 == 0 ? 6000 : 0));
    put(&f, 30, -6);
    CHECK_EQ(left_out(&f), 1);
    f.draw.open = f.draw.close = NULL;
    f.draw.open_position = moved;
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
