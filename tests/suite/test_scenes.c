/* SPDX-License-Identifier: MIT */
/* test_scenes.c - built-in scenes are what their names promise, and files become the scenes of the
 * command-line contract. Pictures come from the reference renderer. */
#include "tests/host.h"

#include "tools/ref/ref.h"

#include "tools/model/model.h"
#include "tools/scenes/build.h"
#include "tools/scenes/color.h"
#include "tools/scenes/scene.h"
#include "tools/scenes/stage.h"

#define PI 3.14159265358979323846

/* ------------------------------------------------------------------ scenes at hand */

/* A built-in scene with room for two instants. */
struct shown {
    struct scene scene;
    struct scene_instant now, before;
    struct failure f;
};

static bool open_scene(struct shown *s, const char *name)
{
    *s = (struct shown){0};
    return CHECK(scene_builtin(name, &s->scene, &s->f));
}

static void close_scene(struct shown *s)
{
    scene_instant_free(&s->scene, &s->now);
    scene_instant_free(&s->scene, &s->before);
    scene_free(&s->scene);
}

static bool is_in(const char *name, const char *family)
{
    return strncmp(name, family, strlen(family)) == 0;
}

/* ------------------------------------------------------------------ catalogue */

static void surface_is_sound(const struct scene_surface *s)
{
    int wild = 0, odd = 0;
    for (int i = 0; i < 3 * s->triangle_count; i++)
        wild += s->index[i] >= (uint32_t)s->vertex_count;
    for (int i = 0; i < 3 * s->vertex_count; i++)
        odd += !isfinite(s->position[i]) || fabsf(s->position[i]) > 1000;
    CHECK_EQ(wild, 0);
    CHECK_EQ(odd, 0);
    CHECK(s->vertex_count <= 65535);
    CHECK(s->material.image == NULL || s->uv != NULL);
    CHECK(s->color == NULL || s->face_color == NULL);
}

static void test_every_scene_of_the_catalogue_can_be_posed_at_any_time(void)
{
    static const double times[] = {0.5, 0, -3.7, 0.4667, 812.31};
    for (int i = 0; i < scene_catalog_count; i++) {
        struct shown s;
        if (!open_scene(&s, scene_catalog[i].name))
            continue;
        CHECK(strcmp(s.scene.name, scene_catalog[i].name) == 0);
        int least = is_in(s.scene.name, "fail/") ? 16 : 240;
        CHECK(s.scene.width >= least && s.scene.height >= least && s.scene.fps == 30);
        int draws = 0;
        for (size_t k = 0; k < sizeof times / sizeof *times; k++) {
            CHECK(scene_pose(&s.scene, times[k], &s.now, &s.f));
            CHECK(k == 0 || s.now.draw_count == draws);
            draws = s.now.draw_count;
            CHECK(s.now.camera.znear > 0 && s.now.camera.zfar > s.now.camera.znear);
            for (int d = 0; d < draws; d++)
                CHECK(isfinite(s.now.draw[d].world[12]) && isfinite(s.now.draw[d].world[0]));
        }
        for (int d = 0; d < draws; d++)
            surface_is_sound(s.now.draw[d].surface);
        CHECK(!scene_pose(&s.scene, NAN, &s.now, &s.f));
        CHECK(!scene_pose(&s.scene, 1e9, &s.now, &s.f));
        close_scene(&s);
    }
}

static void test_names_are_unique_and_unknown_ones_are_refused(void)
{
    for (int i = 0; i < scene_catalog_count; i++)
        for (int k = 0; k < i; k++)
            CHECK(strcmp(scene_catalog[i].name, scene_catalog[k].name) != 0);
    struct scene scene;
    struct failure f = {0};
    CHECK(!scene_builtin("suite/nothing", &scene, &f));
    CHECK(f.text[0] != '\0');
}

/* Posing at other times in between leaves no trace. */
static void test_a_pose_depends_on_nothing_but_time(void)
{
    for (int i = 0; i < scene_catalog_count; i++) {
        struct shown s;
        if (!open_scene(&s, scene_catalog[i].name))
            continue;
        CHECK(scene_pose(&s.scene, 0.31, &s.before, &s.f));
        CHECK(scene_pose(&s.scene, 7.7, &s.now, &s.f));
        CHECK(scene_pose(&s.scene, 0.31, &s.now, &s.f));
        CHECK(memcmp(s.now.camera.pose, s.before.camera.pose, sizeof s.now.camera.pose) == 0);
        for (int d = 0; d < s.now.draw_count; d++) {
            const struct scene_draw *a = &s.now.draw[d], *b = &s.before.draw[d];
            CHECK(memcmp(a->world, b->world, sizeof a->world) == 0 && a->epoch == b->epoch);
            size_t bytes = (size_t)a->surface->vertex_count * 3 * sizeof(float);
            CHECK(memcmp(a->position, b->position, bytes) == 0);
            CHECK(a->normal == NULL || memcmp(a->normal, b->normal, bytes) == 0);
        }
        close_scene(&s);
    }
}

/* ------------------------------------------------------------------ peers */

static void test_peer_colors_are_whole_display_codes(void)
{
    for (int i = 0; i < scene_catalog_count; i++) {
        struct shown s;
        if (!is_in(scene_catalog[i].name, "peer/") || !open_scene(&s, scene_catalog[i].name))
            continue;
        CHECK(scene_pose(&s.scene, 0, &s.now, &s.f));
        CHECK_EQ(s.scene.clear, 0x101830);
        const struct scene_surface *surface = s.now.draw[0].surface;
        const float *color = surface->face_color != NULL ? surface->face_color : surface->color;
        int count = surface->face_color != NULL ? surface->triangle_count : surface->vertex_count;
        double worst = 0;
        for (int k = 0; color != NULL && k < 4 * count; k++)
            if (k % 4 != 3) {
                double code = 255 * color_encode((double)color[k]);
                worst = fmax(worst, fabs(code - floor(code + 0.5)));
            }
        CHECK(worst < 1e-3);
        CHECK(surface->material.unlit == (surface->normal == NULL));
        CHECK((color != NULL) == (surface->material.image == NULL));
        close_scene(&s);
    }
}

/* ------------------------------------------------------------------ pictures */

static bool draw_at(struct shown *s, double time, double earlier, struct ref_frame *out)
{
    struct ref_options options = {.width = s->scene.width, .height = s->scene.height,
                                  .encoded = true, .clear = s->scene.clear};
    return CHECK(scene_pose(&s->scene, time, &s->now, &s->f)) &&
           CHECK(scene_pose(&s->scene, earlier, &s->before, &s->f)) &&
           CHECK(ref_draw(&s->now, &s->before, &s->now, &options, out, &s->f));
}

/* Triangles, those of which something is seen, and pixels that they cover, in frames 0 and 7. */
static const struct peer_counts {
    const char *name;
    int triangles, seen, covered;
} peer_counts[] = {
    { "peer/A", 70000, 23486, 55491 }, { "peer/B64", 1512, 580, 153600 }, { "peer/C", 40, 4, 153600 },
    { "peer/D", 51200, 91672, 142743 }, { "peer/E", 1280, 484, 112553 }, { "peer/F", 10500, 4694, 55377 },
    { "peer/G", 60840, 13003, 84559 },
};

static void count_seen(const struct ref_frame *frame, int triangles, struct peer_counts *counts)
{
    bool *seen = calloc((size_t)triangles, sizeof *seen);
    for (int i = 0; CHECK(seen != NULL) && i < frame->width * frame->height; i++) {
        const int t = frame->triangle[i];
        counts->covered += t >= 0;
        counts->seen += t >= 0 && !seen[t];
        if (t >= 0)
            seen[t] = true;
    }
    free(seen);
}

static void test_peer_scenes_are_those_that_every_peer_was_measured_with(void)
{
    for (size_t i = 0; i < sizeof peer_counts / sizeof *peer_counts; i++) {
        const struct peer_counts *want = &peer_counts[i];
        struct peer_counts got = { want->name, 0, 0, 0 };
        struct shown s;
        if (!open_scene(&s, want->name))
            continue;
        for (int k = 0; k < 8; k += 7) {
            struct ref_frame frame OWNED(ref_frame_free) = { 0 };
            END_UNLESS(draw_at(&s, k / 30.0, k / 30.0, &frame));
            CHECK_CLOSE(s.now.camera.yfov, PI / 3, 1e-12);
            int triangles = 0;
            for (int d = 0; d < s.now.draw_count; d++)
                triangles += s.now.draw[d].surface->triangle_count;
            got.triangles = triangles;
            count_seen(&frame, triangles, &got);
        }
        CHECK_EQ(got.triangles, want->triangles);
        CHECK_NEAR(got.seen, want->seen, 3);
        CHECK_NEAR(got.covered, want->covered, 3);
        close_scene(&s);
    }
}

static double speed_at(const struct ref_frame *frame, int pixel)
{
    return hypot(frame->velocity[2 * pixel], frame->velocity[2 * pixel + 1]);
}

/* RMSE of the sharp frame against the blurred one, in codes of encoded light. */
static double error_of_none(struct shown *s)
{
    struct ref_truth_options options = {.time = s->scene.time, .shutter_degrees = 180,
                                        .instants = 24, .encoded = true, .threads = 2};
    struct ref_truth truth = {0};
    struct ref_frame sharp OWNED(ref_frame_free) = {0};
    double sum = -1;
    if (draw_at(s, s->scene.time, s->scene.time, &sharp) &&
        CHECK(ref_truth(&s->scene, &options, &truth, &s->f))) {
        int values = 3 * sharp.width * sharp.height;
        sum = 0;
        for (int i = 0; i < values; i++)
            sum += pow(255 * sharp.color[i] - truth.code[i], 2) / values;
    }
    ref_truth_free(&truth);
    return sqrt(sum);
}

/* RMSE of the study whose scenes the suite's are named after. */
static const struct { const char *name; double error; } study[] = {
    {"suite/translate", 9.01}, {"suite/propeller", 13.27}, {"suite/pan", 19.72},
    {"suite/dolly", 11.82}, {"suite/roll", 24.67}, {"suite/cross", 13.87},
    {"suite/fence_fg", 30.60}, {"suite/fence_obj", 11.47}, {"suite/enter", 10.90},
    {"suite/near", 9.71}, {"suite/long", 17.26}, {"suite/subpixel", 1.41}, {"suite/skin", 6.78},
    {"suite/swarm", 17.43}, {"suite/still", 0}, {"suite/teleport", 3.06},
    {"suite/textured", 27.83}, {"suite/morph", 3.91}, {"suite/cubic", 5.29}, {"suite/arena", 11.10},
};

static void test_suite_scenes_are_as_hard_as_those_of_the_study(void)
{
    int suite = 0;
    for (int i = 0; i < scene_catalog_count; i++)
        suite += is_in(scene_catalog[i].name, "suite/");
    CHECK_EQ(suite, 20);
    for (size_t i = 0; i < sizeof study / sizeof *study; i++) {
        struct shown s;
        if (!open_scene(&s, study[i].name))
            continue;
        CHECK_CLOSE(error_of_none(&s), study[i].error, 0.2 * study[i].error + 1e-9);
        close_scene(&s);
    }
}

static void test_teleport_cuts_between_the_last_frame_and_the_exposure(void)
{
    struct shown s;
    END_UNLESS(open_scene(&s, "suite/teleport"));
    double t = s.scene.time, trailing = t - 1.0 / 60;
    CHECK(scene_pose(&s.scene, t - 1 / 30.0, &s.before, &s.f));
    CHECK(scene_pose(&s.scene, t, &s.now, &s.f));
    CHECK(s.now.draw[1].epoch != s.before.draw[1].epoch);
    CHECK(fabs(s.now.draw[1].world[12] - s.before.draw[1].world[12]) > 1);
    CHECK(scene_pose(&s.scene, trailing, &s.before, &s.f));
    CHECK_EQ(s.now.draw[1].epoch, s.before.draw[1].epoch);
    close_scene(&s);
}

/* ------------------------------------------------------------------ demo */

static void test_demos_repeat_after_60_frames(void)
{
    for (int i = 0; i < scene_catalog_count; i++) {
        struct shown s;
        if (!is_in(scene_catalog[i].name, "demo/") || !open_scene(&s, scene_catalog[i].name))
            continue;
        for (int k = 0; k < 60; k += 19) {
            struct ref_frame first OWNED(ref_frame_free) = {0}, second = {0};
            if (draw_at(&s, k / 30.0, (k - 1) / 30.0, &first) &&
                draw_at(&s, (k + 60) / 30.0, (k + 59) / 30.0, &second)) {
                int picture = 0, motion = 0;
                for (int p = 0; p < first.width * first.height; p++) {
                    for (int c = 3 * p; c < 3 * p + 3; c++)
                        picture += fabs(first.color[c] - second.color[c]) > 0.5 / 255;
                    motion += fabs(speed_at(&first, p) - speed_at(&second, p)) > 0.01;
                }
                /* Rounding may move a pixel centre over an edge. */
                CHECK_NEAR(picture, 0, 24);
                CHECK_NEAR(motion, 0, 8);
            }
            ref_frame_free(&second);
        }
        close_scene(&s);
    }
}

/* ------------------------------------------------------------------ files */

/* Bounds (1, 2, 3) to (3, 3, 4): centre (2, 2.5, 3.5), half diagonal sqrt(6) / 2. */
static const char obj_text[] =
    "v 1 2 3\nv 3 2 3\nv 3 3 3\nv 1 3 4\nf 1 2 3\nf 1 3 4\n";

/* A triangle; a perspective camera on a node of uneven scale, turned by 90 degrees about y, and an
 * orthographic one that sees from its own plane on. */
static const char gltf_text[] =
    "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0,1,2]}],"
    "\"nodes\":[{\"mesh\":0},"
    "{\"camera\":0,\"translation\":[7,0.5,0],\"rotation\":[0,0.70710678,0,0.70710678],"
    "\"scale\":[2,3,0.25]},{\"camera\":1,\"translation\":[0,0,4]}],"
    "\"cameras\":[{\"name\":\"side\",\"type\":\"perspective\","
    "\"perspective\":{\"yfov\":0.8,\"znear\":0.5}},"
    "{\"type\":\"orthographic\",\"orthographic\":{\"xmag\":3,\"ymag\":2,\"znear\":0,\"zfar\":9}}],"
    "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],"
    "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\","
    "\"min\":[0,0,0],\"max\":[1,1,0]}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],"
    "\"buffers\":[{\"byteLength\":36,\"uri\":\"data:application/octet-stream;base64,"
    "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA\"}]}";

struct filed {
    struct model model;
    struct scene scene;
    struct scene_instant now;
    struct failure f;
};

static bool open_file(struct filed *s, const char *text, const struct scene_view *view)
{
    *s = (struct filed){0};
    return CHECK(model_parse((const uint8_t *)text, strlen(text), NULL, &s->model, &s->f)) &&
           CHECK(scene_from_model(&s->model, view, &s->scene, &s->f)) &&
           CHECK(scene_pose(&s->scene, 0, &s->now, &s->f));
}

static void close_file(struct filed *s)
{
    scene_instant_free(&s->scene, &s->now);
    scene_free(&s->scene);
    model_free(&s->model);
}

static bool is_rotation(const double m[16])
{
    struct vec3 x = vec3(m[0], m[1], m[2]), y = vec3(m[4], m[5], m[6]), z = vec3(m[8], m[9], m[10]);
    return fabs(vec3_length(x) - 1) < 1e-9 && fabs(vec3_dot(x, y)) < 1e-9 &&
           vec3_length(vec3_sub(vec3_cross(x, y), z)) < 1e-9 && m[15] == 1;
}

static void test_the_automatic_camera_is_that_of_the_contract(void)
{
    static const double aspects[] = {4.0 / 3, 0.5};
    for (int i = 0; i < 2; i++) {
        struct filed s OWNED(close_file);
        struct scene_view view = {.clip = MODEL_CLIP_NONE, .camera = -1, .aspect = aspects[i]};
        if (open_file(&s, obj_text, &view)) {
            double r = sqrt(6) / 2, y = PI / 4, x = 2 * atan(aspects[i] * tan(y / 2));
            double d = r / sin((i == 0 ? y : x) / 2), unit = sqrt(0.25 + 0.1225 + 1);
            const struct scene_camera *c = &s.now.camera;
            CHECK_CLOSE(c->yfov, y, 1e-12);
            CHECK_CLOSE(c->pose[12], 2 + d * 0.5 / unit, 1e-6);
            CHECK_CLOSE(c->pose[13], 2.5 + d * 0.35 / unit, 1e-6);
            CHECK_CLOSE(c->pose[14], 3.5 + d / unit, 1e-6);
            CHECK_CLOSE(c->pose[8], 0.5 / unit, 1e-9);
            CHECK_CLOSE(c->pose[4 + 1], sqrt(1 - 0.1225 / unit / unit), 1e-9);
            CHECK(is_rotation(c->pose));
            CHECK_CLOSE(c->znear, fmax(d - 2 * r, d / 100), 1e-6);
            CHECK_CLOSE(c->zfar, d + 2 * r, 1e-6);
            CHECK_EQ(s.now.draw_count, 1);
            CHECK_EQ(s.now.draw[0].surface->triangle_count, 2);
            CHECK(s.now.draw[0].node >= 0 && !s.now.draw[0].deformed);
        }
    }
}

static void test_a_given_eye_looks_where_it_is_told_and_sees_the_scene(void)
{
    struct filed s;
    struct scene_view view = {.clip = MODEL_CLIP_NONE, .camera = -1, .has_eye = true,
                              .eye = {2, 12.5, 3.5}, .look = {2, 0, 3.5}, .fov_degrees = 70};
    if (open_file(&s, obj_text, &view)) {
        const struct scene_camera *c = &s.now.camera;
        CHECK(is_rotation(c->pose));
        CHECK_CLOSE(c->pose[9], 1, 1e-12);      /* straight down */
        CHECK_CLOSE(c->yfov, 70 * PI / 180, 1e-12);
        CHECK(c->znear > 0 && c->znear < 9.5 && c->zfar > 10.5);
    }
    close_file(&s);

    /* Amid the scene. */
    view.eye[1] = 2.5;
    if (open_file(&s, obj_text, &view))
        CHECK(s.now.camera.znear > 0 && s.now.camera.znear < 0.1 && s.now.camera.zfar > 1.2);
    close_file(&s);
}

static void test_cameras_of_the_file_lose_their_scale_but_not_their_view(void)
{
    struct filed s;
    struct scene_view view = {.clip = MODEL_CLIP_ALL, .camera = 0};
    if (open_file(&s, gltf_text, &view)) {
        const struct scene_camera *c = &s.now.camera;
        CHECK(is_rotation(c->pose) && !c->orthographic);
        CHECK_CLOSE(c->pose[8], 1, 1e-6);       /* looks along -x */
        CHECK_CLOSE(c->pose[12], 7, 1e-9);
        CHECK_CLOSE(c->yfov, 0.8, 1e-6);
        CHECK(c->zfar == 0);
    }
    close_file(&s);
    view.camera = 1;
    if (open_file(&s, gltf_text, &view)) {
        CHECK(s.now.camera.orthographic);
        CHECK_CLOSE(s.now.camera.half_height, 2, 1e-9);
        CHECK(s.now.camera.znear > 0 && s.now.camera.znear < 0.01);
    }
    close_file(&s);
}

static void test_impossible_views_are_refused(void)
{
    static const struct scene_view bad[] = {
        {.clip = MODEL_CLIP_NONE, .camera = 2},
        {.clip = MODEL_CLIP_NONE, .camera = -1, .has_eye = true, .fov_degrees = 45},
        {.clip = MODEL_CLIP_NONE, .camera = -1, .has_eye = true, .eye = {1, 1, 1}},
        {.clip = MODEL_CLIP_NONE, .camera = -1, .has_eye = true, .eye = {1, 1, 1},
         .fov_degrees = 180},
        {.clip = MODEL_CLIP_NONE, .camera = -1, .has_eye = true, .eye = {NAN, 1, 1},
         .fov_degrees = 45},
    };
    struct model model OWNED(model_free) = { 0 };
    struct failure parse = {0};
    REQUIRE(model_parse((const uint8_t *)gltf_text, strlen(gltf_text), NULL, &model, &parse));
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        struct scene scene;
        struct failure f = {0};
        CHECK(!scene_from_model(&model, &bad[i], &scene, &f));
        CHECK(f.text[0] != '\0');
    }
}

#include "build/suites/scenes.h"
