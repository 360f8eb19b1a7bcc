/* SPDX-License-Identifier: MIT */
/* test_present.c - what the presenter hands over is the scene: tests convert the integers back to
 * floats by the definitions of smear.h and compare them with the floats that went in. */
#include "tools/player/exact.h"

#include "tools/scenes/tape.h"
#include "tests/host.h"

/* ------------------------------------------------------------------ a scene that tests fill in */

enum { MAX_DRAWS = 4, MAX_POSES = 16 };

struct mock {
    int draw_count;
    struct scene_draw draw[MAX_DRAWS];
    struct scene_camera camera;
    double spin;                    /* radians per second about y, of every draw */
    double velocity[3];             /* of every draw, per second */
    double camera_velocity[3];
    double cut_time;                /* from here on every draw's epoch is 1; 0: never */
    double camera_cut_time;
    double hidden_before;           /* draws are hidden before this */
    const float *later_position;    /* deformed draws: from time 0 on; earlier the surface's */
    int pose_count;
    double posed_at[MAX_POSES];
};

static void identity(double m[16])
{
    memset(m, 0, 16 * sizeof *m);
    m[0] = m[5] = m[10] = m[15] = 1.0;
}

/* m x rotation about y */
static void spin(double m[16], double angle)
{
    double c = cos(angle), s = sin(angle);
    for (int row = 0; row < 3; row++) {
        double x = m[row], z = m[8 + row];
        m[row] = c * x - s * z;
        m[8 + row] = s * x + c * z;
    }
}

static bool mock_pose(struct scene *scene, double time, struct scene_instant *out,
                      struct failure *f)
{
    struct mock *mock = scene->data;
    if (out->draw == NULL)
        out->draw = malloc(MAX_DRAWS * sizeof *out->draw);
    if (out->draw == NULL)
        return fail(f, "out of memory");
    if (mock->pose_count < MAX_POSES)
        mock->posed_at[mock->pose_count++] = time;
    out->draw_count = mock->draw_count;
    out->camera = mock->camera;
    out->camera.epoch = mock->camera_cut_time != 0.0 && time >= mock->camera_cut_time;
    for (int axis = 0; axis < 3; axis++)
        out->camera.pose[12 + axis] += mock->camera_velocity[axis] * time;
    for (int i = 0; i < mock->draw_count; i++) {
        struct scene_draw *draw = &out->draw[i];
        *draw = mock->draw[i];
        spin(draw->world, mock->spin * time);
        for (int axis = 0; axis < 3; axis++)
            draw->world[12 + axis] += mock->velocity[axis] * time;
        draw->epoch = mock->cut_time != 0.0 && time >= mock->cut_time;
        draw->hidden = mock->hidden_before != 0.0 && time < mock->hidden_before;
        draw->position = draw->surface->position;
        draw->normal = draw->surface->normal;
        if (draw->deformed && time >= 0.0)
            draw->position = mock->later_position;
    }
    return true;
}

static void mock_instant_free(struct scene *scene, struct scene_instant *instant)
{
    (void)scene;
    free(instant->draw);
}

static struct scene mock_scene(struct mock *mock)
{
    return (struct scene){ .name = "mock", .fps = 30, .pose = mock_pose,
                           .instant_free = mock_instant_free, .data = mock };
}

static void put_away(struct presenter **presenter)
{
    presenter_free(*presenter);
}

/* A presenter of a mock's scene; f says what goes wrong. */
#define PRESENTER(name, mock) \
    struct failure f = { "" }; \
    struct scene scene = mock_scene(mock); \
    struct presenter *name OWNED(put_away) = presenter_new(&scene, &f)

/* One draw at the identity, seen by a camera of 60 degrees at the origin. */
static struct mock mock_of(const struct scene_surface *surface)
{
    struct mock mock = { .draw_count = 1,
                         .camera = { .yfov = 1.0471975512, .znear = 0.25, .zfar = 64.0 } };
    identity(mock.camera.pose);
    for (int i = 0; i < MAX_DRAWS; i++) {
        mock.draw[i] = (struct scene_draw){ .surface = surface, .node = -1 };
        identity(mock.draw[i].world);
    }
    return mock;
}

static const uint32_t tetrahedron_index[12] = { 0, 1, 2, 0, 2, 3, 0, 3, 1, 1, 3, 2 };
static const float tetrahedron[12] = { -0.7f, -0.51f, -3.2f, 0.83f, -0.49f, -2.9f,
                                       0.013f, 0.77f, -3.1f, 0.11f, -0.12f, -2.03f };

static struct scene_surface surface_of(const float *position, int vertices, const uint32_t *index,
                                       int triangles)
{
    return (struct scene_surface){
        .vertex_count = vertices, .triangle_count = triangles, .position = position, .index = index,
        .material = { .base = { 1.0f, 1.0f, 1.0f, 1.0f }, .alpha_cutoff = 0.5f },
    };
}

/* A tetrahedron, and its scene. */
#define MOCK(surface, mock) \
    struct scene_surface surface = surface_of(tetrahedron, 4, tetrahedron_index, 4); \
    struct mock mock = mock_of(&surface)

static const struct present_options plain = { .fps = 30, .shutter_degrees = 180 };

/* ------------------------------------------------------------------ back to floats */

static double number(int32_t value, int fraction_bits)
{
    return ldexp(value, -fraction_bits);
}

/* A vertex in library units. */
static void world_of(const smear_mesh *mesh, const int16_t *position, int vertex,
                     const smear_transform *t, double out[3])
{
    for (int row = 0; row < 3; row++) {
        out[row] = number(t->origin[row], 16);
        for (int axis = 0; axis < 3; axis++) {
            double object = ((double)position[vertex * 3 + axis] + mesh->offset[axis]) *
                            ldexp(mesh->scale, -mesh->shift);
            out[row] += number(t->basis[row * 3 + axis], 24) * object;
        }
    }
}

/* Pixels right of and below the middle of a picture 240 pixels high, and library units of depth. */
static void screen_of(const double world[3], const smear_camera *camera, double out[3])
{
    double view[3] = { 0, 0, 0 };
    for (int axis = 0; axis < 3; axis++)
        for (int row = 0; row < 3; row++)
            view[axis] += number(camera->pose.basis[row * 3 + axis], 24) *
                          (world[row] - number(camera->pose.origin[row], 16));
    double scale = camera->half_height > 0 ? 120.0 / number(camera->half_height, 16)
                                           : 120.0 * number(camera->focal, 16) / -view[2];
    out[0] = view[0] * scale;
    out[1] = -view[1] * scale;
    out[2] = -view[2];
}

/* The same from the floats, in scene units. */
static void exact_screen(const struct scene_draw *draw, const float *position,
                         const struct scene_camera *camera, double out[3])
{
    double world[3], view[3] = { 0, 0, 0 };
    for (int row = 0; row < 3; row++) {
        world[row] = draw->world[12 + row];
        for (int axis = 0; axis < 3; axis++)
            world[row] += draw->world[axis * 4 + row] * position[axis];
    }
    for (int axis = 0; axis < 3; axis++)
        for (int row = 0; row < 3; row++)
            view[axis] += camera->pose[axis * 4 + row] * (world[row] - camera->pose[12 + row]);
    double scale = camera->orthographic ? 120.0 / camera->half_height
                                        : 120.0 / tan(camera->yfov / 2) / -view[2];
    out[0] = view[0] * scale;
    out[1] = -view[1] * scale;
    out[2] = -view[2];
}

/* The largest distance in pixels between a vertex handed over and the exact one, in the given pose
 * (0 now, 1 open, 2 close) of the mock's first draw; or of depths, in per cent. */
static double worst_error(const struct presented *presented, struct scene *scene, int pose,
                          double time)
{
    struct failure f = { "" };
    struct scene_instant exact = { 0 };
    const smear_draw *draw = &presented->draw[0];
    const smear_transform *transform[3] = { draw->now, draw->open, draw->close };
    const int16_t *position[3] = { draw->mesh->position, draw->open_position,
                                   draw->close_position };
    double worst = 0.0;
    if (!scene_pose(scene, time, &exact, &f))
        return INFINITY;
    if (position[pose] == NULL)
        position[pose] = draw->mesh->position;
    for (int i = 0; i < draw->mesh->vertex_count; i++) {
        double world[3], got[3], want[3];
        world_of(draw->mesh, position[pose], i, transform[pose], world);
        screen_of(world, &presented->camera[pose], got);
        exact_screen(&exact.draw[0], exact.draw[0].position + i * 3, &exact.camera, want);
        worst = fmax(worst, fmax(fabs(got[0] - want[0]), fabs(got[1] - want[1])));
        double depth = (got[2] - presented->camera_back) / presented->world_scale;
        double nearest = presented->near_plane / presented->world_scale;
        worst = fmax(worst, fabs(depth - want[2]) / fmax(want[2], nearest) * 100);
    }
    scene_instant_free(scene, &exact);
    return worst;
}

/* Presents `mock` and checks the three poses to within `slack` pixels. */
static void check_poses(struct mock *mock, double time, double slack)
{
    PRESENTER(presenter, mock);
    struct present_options options = plain;
    double open, close;
    const struct presented *p = presenter_frame(presenter, time, &options, &f);
    if (CHECK(p != NULL && p->draw_count == 1)) {
        CHECK_CLOSE(worst_error(p, &scene, 0, time), 0.0, slack);
        CHECK_CLOSE(worst_error(p, &scene, 1, time - 1.0 / 30), 0.0, slack);
        CHECK_CLOSE(worst_error(p, &scene, 2, time - 2.0 / 30), 0.0, slack);
        CHECK(!p->frame.shutter.poses);
    }
    options.shutter_poses = true;
    p = presenter_frame(presenter, time, &options, &f);
    if (CHECK(p != NULL && p->draw_count == 1)) {
        present_exposure(time, &options, &open, &close);
        CHECK_CLOSE(worst_error(p, &scene, 0, time), 0.0, slack);
        CHECK_CLOSE(worst_error(p, &scene, 1, open), 0.0, slack);
        CHECK_CLOSE(worst_error(p, &scene, 2, close), 0.0, slack);
        CHECK(p->frame.shutter.poses);
    }
}

/* ------------------------------------------------------------------ places and sizes */

static void test_scenes_far_from_the_origin_arrive(void)
{
    MOCK(surface, mock);
    for (int axis = 0; axis < 3; axis++) {
        mock.draw[0].world[12 + axis] = 1e7 + axis;
        mock.camera.pose[12 + axis] = 1e7 + axis;
    }
    mock.velocity[0] = 1.0;
    mock.spin = 1.0;
    check_poses(&mock, 0.1, 0.004);
}

static void test_small_things_far_from_their_own_origin_arrive(void)
{
    float far_away[12];
    for (int i = 0; i < 12; i++)
        far_away[i] = tetrahedron[i] * 0.01f + 500.0f;
    struct scene_surface surface = surface_of(far_away, 4, tetrahedron_index, 4);
    struct mock mock = mock_of(&surface);
    for (int axis = 0; axis < 3; axis++)
        mock.draw[0].world[12 + axis] = -500.0;
    mock.draw[0].world[14] -= 1.0;
    check_poses(&mock, 0.0, 0.004);
}

static void test_deformed_poses_share_their_grid(void)
{
    static const float later[12] = { -1.7f, -0.51f, -5.2f, 2.83f, -0.49f, -2.9f,
                                     0.013f, 1.77f, -3.1f, 0.11f, -0.12f, -1.53f };
    MOCK(surface, mock);
    mock.draw[0].deformed = true;
    mock.later_position = later;
    mock.velocity[0] = 0.3;
    check_poses(&mock, 0.001, 0.004);
    check_poses(&mock, 1.0, 0.004);
}

/* ------------------------------------------------------------------ depth */

static void check_depth(struct mock *mock, double nearest, double slack)
{
    PRESENTER(presenter, mock);
    const struct presented *p = presenter_frame(presenter, 0.0, &plain, &f);
    if (CHECK(p != NULL)) {
        double near_plane = p->near_plane / p->world_scale - p->camera_back / p->world_scale;
        CHECK_CLOSE(presented_depth(p, 65535), near_plane, near_plane * 0.002 + 1e-9);
        CHECK(isinf(presented_depth(p, 0)));
        CHECK(near_plane <= nearest);
        /* neighbouring codes around the nearest vertex are close together */
        uint16_t code = 65535;
        while (code > 1 && presented_depth(p, code) < nearest)
            code--;
        CHECK_CLOSE(presented_depth(p, code), nearest, slack);
    }
}

static void test_depth_codes_become_scene_units(void)
{
    MOCK(surface, mock);
    double nearest = -(double)tetrahedron[11];
    check_depth(&mock, nearest, nearest / 1000);
    mock.camera.znear = 1e-5;       /* moved out, or a step would be a tenth of the distance */
    check_depth(&mock, nearest, nearest / 1000);
    mock.camera.orthographic = true;
    mock.camera.half_height = 1.0;
    mock.camera.znear = 0.0;
    mock.camera.zfar = 1000.0;
    check_depth(&mock, nearest, 0.001);
}

/* ------------------------------------------------------------------ texture coordinates */

enum { STRIP = 50 };

/* A strip of STRIP squares with u one repeat further at each, for a picture of `edge` texels. */
static void check_strip(int edge, enum model_wrap wrap, double first, int want_shift,
                        bool is_doubled)
{
    float position[(STRIP + 1) * 6], uv[(STRIP + 1) * 4];
    uint32_t index[STRIP * 6];
    struct failure f = { "" };
    for (int i = 0; i <= STRIP * 2 + 1; i++) {
        position[i * 3] = (float)(i / 2) * 0.1f;
        position[i * 3 + 1] = (float)(i & 1);
        position[i * 3 + 2] = -5.0f;
        uv[i * 2] = (float)(first + i / 2 + 0.123);
        uv[i * 2 + 1] = (float)(i & 1) * 0.75f;
    }
    for (uint32_t i = 0; i < STRIP; i++) {
        uint32_t a = 2 * i;
        const uint32_t corners[6] = { a, a + 2, a + 1, a + 1, a + 2, a + 3 };
        memcpy(index + i * 6, corners, sizeof corners);
    }
    struct image image OWNED(image_free) = { 0 };
    REQUIRE(image_alloc(&image, edge, edge, &f));
    struct scene_surface surface = surface_of(position, (STRIP + 1) * 2, index, STRIP * 2);
    surface.uv = uv;
    surface.material.image = &image;
    surface.material.wrap_u = wrap;
    struct mock mock = mock_of(&surface);
    struct scene scene = mock_scene(&mock);
    struct presenter *presenter = presenter_new(&scene, &f);
    const struct presented *p = presenter_frame(presenter, 0.0, &plain, &f);
    if (CHECK(p != NULL && p->draw_count == 1)) {
        const smear_mesh *mesh = p->draw[0].mesh;
        double step = ldexp(1.0, -mesh->uv_shift), period = wrap == MODEL_WRAP_MIRROR ? 2.0 : 1.0;
        CHECK_EQ(mesh->uv_shift, want_shift);
        CHECK((mesh->vertex_count > (STRIP + 1) * 2) == is_doubled);
        CHECK_EQ(mesh->triangle_count, STRIP * 2);
        for (int t = 0; t < STRIP * 2; t++) {
            double moved = 0.0;
            for (int corner = 0; corner < 3; corner++) {
                const int16_t *got = mesh->uv + mesh->index[t * 3 + corner] * 2;
                const float *want = uv + index[t * 3 + corner] * 2;
                double by = got[0] * step - want[0];
                if (corner == 0)
                    moved = wrap == MODEL_WRAP_CLAMP ? 0.0 : floor(by / period + 0.5) * period;
                CHECK_CLOSE(by, moved, step * 0.51);
                CHECK_CLOSE(got[1] * step, (double)want[1], step * 0.51);
            }
        }
    }
    presenter_free(presenter);
}

static void test_repeats_move_until_texels_are_resolved(void)
{
    check_strip(64, MODEL_WRAP_REPEAT, 0.0, 10, false);     /* +-25 repeats fit 10 bits: enough */
    check_strip(1024, MODEL_WRAP_REPEAT, 0.0, 15, true);    /* 0.123 .. 1.123 less one */
    check_strip(1024, MODEL_WRAP_MIRROR, 0.0, 14, true);    /* 0.123 .. 1.123 as it is */
    check_strip(64, MODEL_WRAP_REPEAT, 1e5, 10, false);
    check_strip(1024, MODEL_WRAP_CLAMP, 0.0, 9, false);     /* clamped ones must not move */
}

/* ------------------------------------------------------------------ large surfaces */

static void test_large_surfaces_are_split_without_loss(void)
{
    enum { EDGE = 300, COUNT = EDGE * EDGE, TRIANGLES = (EDGE - 1) * (EDGE - 1) * 2 };
    struct failure f = { "" };
    float *position = malloc(sizeof *position * COUNT * 3);
    uint32_t *index = malloc(sizeof *index * TRIANGLES * 3), *at = index;
    REQUIRE(position != NULL && index != NULL);
    for (int i = 0; i < COUNT; i++) {
        position[i * 3] = (float)(i % EDGE) / EDGE - 0.5f;
        position[i * 3 + 1] = (float)(i / EDGE) / EDGE - 0.5f;
        position[i * 3 + 2] = -2.0f - (float)(i % 7) * 0.01f;
    }
    for (uint32_t y = 0; y + 1 < EDGE; y++) {
        for (uint32_t x = 0; x + 1 < EDGE; x++) {
            uint32_t a = y * EDGE + x;
            const uint32_t corners[6] = { a, a + 1, a + EDGE, a + EDGE, a + 1, a + EDGE + 1 };
            memcpy(at, corners, sizeof corners);
            at += 6;
        }
    }
    struct scene_surface surface = surface_of(position, COUNT, index, TRIANGLES);
    struct mock mock = mock_of(&surface);
    struct scene scene = mock_scene(&mock);
    struct presenter *presenter = presenter_new(&scene, &f);
    const struct presented *p = presenter_frame(presenter, 0.0, &plain, &f);
    if (CHECK(p != NULL && p->draw_count == 2)) {
        uint32_t corner = 0, wrong = 0;
        for (int i = 0; i < p->draw_count; i++) {
            const smear_mesh *mesh = p->draw[i].mesh;
            for (uint32_t j = 0; j < mesh->triangle_count * 3; j++, corner++) {
                double world[3];
                CHECK(mesh->index[j] < mesh->vertex_count);
                world_of(mesh, mesh->position, mesh->index[j], p->draw[i].now, world);
                for (int axis = 0; axis < 3; axis++) {
                    double want = position[index[corner] * 3 + (uint32_t)axis];
                    wrong += fabs(world[axis] / p->world_scale - want) > 2e-5;
                }
            }
        }
        CHECK_EQ(corner, TRIANGLES * 3);
        CHECK_EQ(p->triangle_count, TRIANGLES);
        CHECK_EQ(wrong, 0);
        CHECK_EQ(p->draw[0].mesh->scale, p->draw[1].mesh->scale);
        CHECK_EQ(p->draw[0].mesh->shift, p->draw[1].mesh->shift);
    }
    presenter_free(presenter);
    free(position);
    free(index);
}

/* ------------------------------------------------------------------ colours and materials */

/* The draw of a surface with this material, or null where nothing is drawn. */
static const smear_draw *draw_with(struct scene_material material, struct presenter **presenter)
{
    static struct scene_surface surface;
    static struct mock mock;
    static struct scene scene;
    struct failure f = { "" };
    surface = surface_of(tetrahedron, 4, tetrahedron_index, 4);
    surface.material = material;
    mock = mock_of(&surface);
    scene = mock_scene(&mock);
    *presenter = presenter_new(&scene, &f);
    const struct presented *p = presenter_frame(*presenter, 0.0, &plain, &f);
    return CHECK(p != NULL) && p->draw_count == 1 ? &p->draw[0] : NULL;
}

static void test_materials_keep_what_they_mean(void)
{
    static const struct {
        enum model_alpha mode;
        float alpha, cutoff;
        bool is_drawn;
        int want_mode, want_alpha, want_cutoff;
    } cases[] = {
        { MODEL_ALPHA_OPAQUE, 0.0f, 0.5f, true, SMEAR_OPAQUE, 255, 0 },
        { MODEL_ALPHA_OPAQUE, 0.25f, 0.5f, true, SMEAR_OPAQUE, 255, 0 },
        { MODEL_ALPHA_BLEND, 0.25f, 0.5f, true, SMEAR_BLEND, 64, 0 },
        { MODEL_ALPHA_BLEND, 0.0f, 0.5f, false, 0, 0, 0 },
        { MODEL_ALPHA_MASK, 1.0f, 0.5f, true, SMEAR_CUTOUT, 255, 128 },
        { MODEL_ALPHA_MASK, 1.0f, 0.2f, true, SMEAR_CUTOUT, 255, 52 },
        { MODEL_ALPHA_MASK, 1.0f, 1.5f, false, 0, 0, 0 },
        { MODEL_ALPHA_MASK, 0.3f, 0.0f, true, SMEAR_OPAQUE, 255, 0 },
    };
    for (unsigned i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct presenter *presenter;
        struct scene_material material = { .base = { 0.5f, 0.0f, 1.0f, cases[i].alpha },
                                           .alpha = cases[i].mode, .alpha_cutoff = cases[i].cutoff,
                                           .double_sided = i & 1, .unlit = i >> 1 & 1 };
        const smear_draw *draw = draw_with(material, &presenter);
        CHECK_EQ(draw != NULL, cases[i].is_drawn);
        if (draw != NULL) {
            CHECK_EQ(draw->material->color[0], 188);
            CHECK_EQ(draw->material->color[1], 0);
            CHECK_EQ(draw->material->color[2], 255);
            CHECK_EQ(draw->material->color[3], cases[i].want_alpha);
            CHECK_EQ(draw->material->alpha, cases[i].want_mode);
            CHECK_EQ(draw->material->cutoff, cases[i].want_cutoff);
            CHECK_EQ(draw->material->double_sided, i & 1);
            CHECK_EQ(draw->material->unlit, i >> 1 & 1);
        }
        presenter_free(presenter);
    }
}

/* ------------------------------------------------------------------ motion */

static void test_other_poses_are_taken_at_the_right_times(void)
{
    static const struct { smear_exposure exposure; double open, close; } cases[] = {
        { SMEAR_CENTRED, 1.0 - 0.75 / 60, 1.0 + 0.75 / 60 },
        { SMEAR_TRAILING, 1.0 - 1.5 / 60, 1.0 },
        { SMEAR_LEADING, 1.0, 1.0 + 1.5 / 60 },
    };
    MOCK(surface, mock);
    PRESENTER(presenter, &mock);
    for (int i = 0; i < 3; i++) {
        struct present_options options = { .fps = 60, .shutter_degrees = 540, .shutter_poses = true,
                                           .exposure = cases[i].exposure };
        mock.pose_count = 0;
        CHECK(presenter_frame(presenter, 1.0, &options, &f) != NULL);
        CHECK_EQ(mock.pose_count, 3);
        CHECK_CLOSE(mock.posed_at[0], (cases[i].open + cases[i].close) / 2, 1e-12);    /* what is blurred */
        CHECK_CLOSE(mock.posed_at[1], cases[i].open, 1e-12);
        CHECK_CLOSE(mock.posed_at[2], cases[i].close, 1e-12);
    }
    mock.pose_count = 0;
    const struct present_options closed = { .fps = 60, .shutter_degrees = 0.2,
                                            .method = SMEAR_RECONSTRUCT };
    const struct presented *p = presenter_frame(presenter, 0.0, &closed, &f);
    CHECK(p != NULL && p->frame.method == SMEAR_NONE);
    CHECK_EQ(mock.pose_count, 3);
    CHECK_CLOSE(mock.posed_at[1], -1.0 / 60, 1e-12);
    CHECK_CLOSE(mock.posed_at[2], -2.0 / 60, 1e-12);
}

static void test_motion_modes_reach_their_draws(void)
{
    static const uint8_t motion[3] = { SCENE_MOTION_NONE, SCENE_MOTION_FULL, SCENE_MOTION_CAMERA };
    MOCK(surface, mock);
    PRESENTER(presenter, &mock);
    struct present_options options = plain;
    mock.draw_count = 4;
    options.motion = motion;
    options.motion_count = 3;
    const struct presented *p = presenter_frame(presenter, 0.0, &options, &f);
    if (CHECK(p != NULL && p->draw_count == 4)) {
        CHECK_EQ(p->draw[0].motion, SMEAR_MOTION_NONE);
        CHECK_EQ(p->draw[1].motion, SMEAR_MOTION_FULL);
        CHECK_EQ(p->draw[2].motion, SMEAR_MOTION_CAMERA);
        CHECK_EQ(p->draw[3].motion, SMEAR_MOTION_FULL);
        for (int i = 0; i < 4; i++)
            CHECK_EQ(p->draw[i].id, 0);
    }
}

/* With keep_ids, the pose kept from one frame must be the pose the next frame would have given. */
static void test_kept_poses_equal_given_ones(void)
{
    MOCK(surface, mock);
    PRESENTER(presenter, &mock);
    struct present_options options = plain;
    smear_transform kept = { { 0 }, { 0 } };
    smear_camera kept_camera = { .focal = 0 };
    options.keep_ids = true;
    mock.velocity[0] = 0.3;
    mock.camera_velocity[1] = 0.2;
    mock.spin = 0.5;
    for (int i = 0; i < 4; i++) {
        const struct presented *p = presenter_frame(presenter, i / 30.0, &options, &f);
        if (!CHECK(p != NULL && p->draw_count == 1))
            break;
        CHECK_EQ(p->draw[0].id, 1);
        CHECK(p->draw[0].open == NULL && p->frame.open == NULL);
        CHECK_CLOSE(worst_error(p, &scene, 0, i / 30.0), 0.0, 0.004);
        for (int j = 0; j < 9 && i > 0; j++)
            CHECK_NEAR(p->camera[1].pose.basis[j], kept_camera.pose.basis[j], 1);
        for (int j = 0; j < 3 && i > 0; j++)
            CHECK_NEAR(p->camera[1].pose.origin[j], kept_camera.pose.origin[j], 1);
        if (i > 0) {                /* the kept transform and camera, with today's mesh */
            double world[3], got[3], want[3];
            struct scene_instant before = { 0 };
            CHECK(scene_pose(&scene, (i - 1) / 30.0, &before, &f));
            world_of(p->draw[0].mesh, p->draw[0].mesh->position, 0, &kept, world);
            screen_of(world, &kept_camera, got);
            exact_screen(&before.draw[0], tetrahedron, &before.camera, want);
            CHECK_CLOSE(got[0], want[0], 0.004);
            CHECK_CLOSE(got[1], want[1], 0.004);
            scene_instant_free(&scene, &before);
        }
        kept = *p->draw[0].now;
        kept_camera = p->camera[0];
    }
}

/* ------------------------------------------------------------------ failures */

static void check_refused(struct mock *mock, const struct present_options *options,
                          const char *part)
{
    PRESENTER(presenter, mock);
    CHECK(presenter_frame(presenter, 0.0, options, &f) == NULL);
    if (!CHECK(strstr(f.text, part) != NULL))
        test_print(f.text);
}

static void test_what_does_not_fit_is_refused(void)
{
    float bad[12];
    memcpy(bad, tetrahedron, sizeof bad);
    struct scene_surface surface = surface_of(tetrahedron, 4, tetrahedron_index, 4);
    struct scene_surface bad_surface = surface_of(bad, 4, tetrahedron_index, 4);
    struct present_options options = plain;
    struct mock mock = mock_of(&bad_surface);
    bad[5] = NAN;
    check_refused(&mock, &plain, "vertex position");
    mock = mock_of(&surface);
    mock.draw[0].world[3 * 4] = INFINITY;
    check_refused(&mock, &plain, "transform");
    mock = mock_of(&surface);
    mock.draw[0].world[0] = mock.draw[0].world[5] = mock.draw[0].world[10] = 1e9;
    mock.draw[0].world[14] = 3e9;   /* around the camera, so that its near plane cannot be moved */
    check_refused(&mock, &plain, "too far apart");
    mock = mock_of(&surface);
    mock.camera.znear = 0.0;
    check_refused(&mock, &plain, "near plane");
    mock = mock_of(&surface);
    mock.camera.zfar = 0.1;
    check_refused(&mock, &plain, "far plane");
    mock = mock_of(&surface);
    options.fps = 0.0;
    check_refused(&mock, &options, "frame rate");
    options = plain;
    options.shutter_degrees = NAN;
    check_refused(&mock, &options, "shutter");
    struct image large = { .width = 5000, .height = 1, .rgba = NULL };
    static const float uv[8] = { 0, 0, 1, 0, 1, 1, 0, 1 };
    surface.uv = uv;
    surface.material.image = &large;
    check_refused(&mock, &plain, "too large");
}

/* ------------------------------------------------------------------ truth */

/* A white square that covers the left half of the picture at some instants and the right half at
 * the others: the mean of two instants is half light everywhere. */
static void check_mean(smear_light_space light, int want)
{
    static const float square[12] = { -1, -1, -2, 0, -1, -2, 0, 1, -2, -1, 1, -2 };
    static const uint32_t index[6] = { 0, 1, 2, 0, 2, 3 };
    struct scene_surface surface = surface_of(square, 4, index, 2);
    surface.material.unlit = true;
    struct mock mock = mock_of(&surface);
    mock.camera.orthographic = true;
    mock.camera.half_height = 1.0;
    /* instants of an exposure of 1/60 s lie 1/120 s apart: it moves by one there */
    mock.velocity[0] = 120.0;
    mock.draw[0].world[12] = 0.5;
    PRESENTER(presenter, &mock);
    struct present_options options = plain;
    struct image image OWNED(image_free) = { 0 };
    options.light = light;
    if (CHECK(exact_picture(presenter, 0.0, &options, 24, 24, 2, &image, &f))) {
        int wrong = 0;
        for (int i = 0; i < 24 * 24 * 4; i++)
            wrong += image.rgba[i] != (i % 4 == 3 ? 255 : want);
        CHECK_EQ(wrong, 0);
    } else {
        test_print(f.text);
    }
}

static void test_exact_means_are_of_light_or_of_codes(void)
{
    check_mean(SMEAR_LIGHT_LINEAR, 188);
    check_mean(SMEAR_LIGHT_ENCODED, 128);
}

#include "build/suites/present.h"
