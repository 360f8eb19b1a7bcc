/* SPDX-License-Identifier: MIT */
/* test_convert_tool.c - models as firmware data (tools/convert): every file at hand converts, and what comes out is
 * checked, opened, compiled and played by the animation module (src/model/anim.c), and looks like the file itself. Needs files, so it
 * runs on hosts only; test_anim.c plays the same data on every target. */
#include "tests/ref/accuracy.h"

#include "model/blob.h"
#include "tools/convert/build.h"
#include "tools/model/exact.h"
#include "tools/convert/track.h"
#include "tests/context_rig.h"

#include <sys/stat.h>


enum { WIDTH = 320, HEIGHT = 240 };

static const char arm_path[] = "tests/data/arm.gltf";

/* What is lost on the way. */
static const double sharp_bar = 2.0;            /* codes, RMSE over the whole picture; textures whole */
static const double blurred_bar = 0.1;          /* that, and this much of what the blur changes */
static const double position_bar = 0.15;        /* px at 240 rows: 8-bit weights and the default keys */
static const double rest_bar = 0.03;            /* px at 240 rows: int16 steps, and nodes in fixed point */
static const double fps = 12;                   /* slow enough for motion that one can see */

/* ------------------------------------------------------------------ models in hand */

static struct convert_options plain_options(void)
{
    return (struct convert_options){ .scale = 1, .texture_edge = 128, .colors = 256, .influences = 4,
                                     .clip_error_px = 0.1, .rows = 240, .fov_degrees = 45 };
}

/* A loaded file, the options it was converted with, and the result. */
struct converted_file {
    struct model model;
    struct convert_options options;
    int clip[64];
    struct conversion result;
};

static bool convert_loaded_file(struct converted_file *file, const struct convert_options *options, const char *name)
{
    struct failure f = { { 0 } };
    file->options = *options;
    if (options->clip == NULL) {
        for (int i = 0; i < file->model.clip_count && i < 64; i++)
            file->clip[i] = i;
        file->options.clip = file->clip;
        file->options.clip_count = file->model.clip_count < 64 ? file->model.clip_count : 64;
    }
    if (convert_model(&file->model, &file->options, &file->result, &f))
        return true;
    say("    %s: %s\n", name, f.text);
    return CHECK(!"the model converts");
}

static bool open_file(struct converted_file *file, const char *path, const struct convert_options *options)
{
    struct failure f = { { 0 } };
    *file = (struct converted_file){ .result = { .pile = NULL } };
    if (!model_load(path, &file->model, &f)) {
        say("    %s: %s\n", path, f.text);
        return CHECK(!"the model loads");
    }
    if (convert_loaded_file(file, options, path))
        return true;
    model_free(&file->model);
    return false;
}

static void close_file(struct converted_file *file)
{
    conversion_free(&file->result);
    model_free(&file->model);
}

static const char *name_of(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash != NULL ? slash + 1 : path;
}

static smear_actor *make_actor(const smear_model *model, int poses)
{
    smear_actor *actor = NULL;
    size_t bytes = smear_actor_memory(model, poses);
    void *memory = malloc(bytes);
    if (!CHECK(memory != NULL))
        return NULL;
    CHECK_EQ(smear_actor_init(&actor, model, poses, memory, bytes), SMEAR_OK);
    if (actor == NULL)
        free(memory);
    return actor;               /* lies where the memory begins */
}

/* Where a vertex of a draw is, in world units. */
static void measured_point(double out[3], const smear_draw *draw, int vertex)
{
    const smear_mesh *mesh = draw->mesh;
    for (int row = 0; row < 3; row++) {
        out[row] = draw->now->origin[row] / 65536.0;
        for (int k = 0; k < 3; k++)
            out[row] += draw->now->basis[3 * row + k] / 16777216.0
                      * ldexp((double)(mesh->position[3 * vertex + k] + mesh->offset[k]) * mesh->scale, -mesh->shift);
    }
}

/* ------------------------------------------------------------------ pictures */

static smear_camera camera_of(const struct scene_camera *from, double scale)
{
    smear_camera camera = { .near_plane = (int32_t)lround(from->znear * scale * 65536),
                            .far_plane = (int32_t)lround(fmin(from->zfar * scale, 32000) * 65536) };
    for (int row = 0; row < 3; row++) {
        for (int column = 0; column < 3; column++)
            camera.pose.basis[3 * row + column] = (int32_t)lround(from->pose[4 * column + row] * 16777216);
        camera.pose.origin[row] = (int32_t)lround(from->pose[12 + row] * scale * 65536);
    }
    camera.focal = (int32_t)lround(65536 / tan(from->yfov / 2));
    return camera;
}

/* One frame of the actor as it stands. */
static bool draw_actor(smear_actor *actor, const smear_camera *camera, smear_method method, uint8_t *rgb)
{
    smear_desc desc = { .width = WIDTH, .height = HEIGHT, .format = SMEAR_XRGB8888, .methods = (uint16_t)SMEAR_SET(method), .max_draws = 64,
                        .max_triangles = 20000 };
    smear_frame frame = { .camera = camera, .open = camera, .method = (uint8_t)method };
    RIG(r, &desc, false);
    const bool ok = CHECK_EQ(smear_begin(r.ctx, &frame), SMEAR_OK) && CHECK_EQ(smear_actor_submit(actor, r.ctx), SMEAR_OK)
                 && CHECK_EQ(smear_render(r.ctx), SMEAR_OK);
    rig_rgb(&r, rgb);
    return ok;
}

static double rmse_between(const uint8_t *a, const uint8_t *b)
{
    double sum = 0;
    for (int i = 0; i < 3 * WIDTH * HEIGHT; i++)
        sum += (double)(a[i] - b[i]) * (a[i] - b[i]);
    return sqrt(sum / (3.0 * WIDTH * HEIGHT));
}

struct differences {
    double sharp, blurred;      /* codes, RMSE */
    double contrast, motion;    /* the same of the file's picture against black, and sharp against blurred */
};

/* The frame at `time` of the file's clip, drawn from the file and from the result. */
static bool compare_pictures(const struct converted_file *file, const char *path, int clip, double time,
                             struct differences *out)
{
    struct failure f = { { 0 } };
    struct subject s OWNED(subject_close) = { 0 };
    struct scene_instant instant = { 0 };
    struct shot from_file[2] = { { 0 }, { 0 } };
    uint8_t *rgb = calloc(3, WIDTH * HEIGHT), *black = calloc(3, WIDTH * HEIGHT);
    const struct shot_options look = { .width = WIDTH, .height = HEIGHT };
    if (!CHECK(rgb != NULL && black != NULL) || !subject_open_file(&s, path, WIDTH, HEIGHT))
        return false;
    struct scene_view view = { .clip = file->model.clip_count > 0 ? clip : MODEL_CLIP_NONE, .loop = true,
                               .camera = s.model.camera_count > 0 ? 0 : -1, .aspect = (double)WIDTH / HEIGHT };
    scene_free(&s.scene);
    presenter_free(s.presenter);
    s.presenter = NULL;
    s.time = time;
    s.fps = fps;
    smear_actor *actor = make_actor(&file->result.model, 2);
    bool ok = scene_from_model(&s.model, &view, &s.scene, &f)
           && (s.presenter = presenter_new(&s.scene, &f)) != NULL && scene_pose(&s.scene, time, &instant, &f);
    ok = CHECK(ok) && actor != NULL;
    for (int i = 0; i < 2 && ok; i++) {
        struct present_options present = subject_options(&s);
        present.method = i == 0 ? SMEAR_NONE : SMEAR_RECONSTRUCT;
        ok = shot_take(&s, &present, &look, &from_file[i]);
    }
    if (ok) {
        smear_camera camera = camera_of(&instant.camera, largest_column(file->result.root));
        smear_play play = { .clip = (uint16_t)clip, .rest = file->result.model.clip_count == 0, .loop = 1 };
        play.time = (int32_t)lround((time - 1 / fps) * 65536);
        CHECK_EQ(smear_actor_advance(actor, &play), SMEAR_OK);
        play.time = (int32_t)lround(time * 65536);
        CHECK_EQ(smear_actor_advance(actor, &play), SMEAR_OK);
        ok = draw_actor(actor, &camera, SMEAR_NONE, rgb);
        out->sharp = rmse_between(rgb, from_file[0].rgb);
        out->contrast = rmse_between(black, from_file[0].rgb);
        out->motion = rmse_between(from_file[0].rgb, from_file[1].rgb);
        ok = ok && draw_actor(actor, &camera, SMEAR_RECONSTRUCT, rgb);
        out->blurred = rmse_between(rgb, from_file[1].rgb);
    }
    shot_free(&from_file[0]);
    shot_free(&from_file[1]);
    scene_instant_free(&s.scene, &instant);
    free(actor);
    free(rgb);
    free(black);
    return ok;
}

static struct convert_options whole_pictures(void)
{
    struct convert_options o = plain_options();
    o.texture = CONVERT_RGB8888;
    o.texture_edge = 4096;
    o.fit = 32;
    return o;
}

/* Returns the strongest blur. */
static double compare_file(const char *path, int clip, const double *part, int parts, const struct convert_options *o)
{
    struct converted_file file;
    double most_motion = 0;
    if (!open_file(&file, path, o))
        return 0;
    double duration = clip < file.model.clip_count ? file.model.clip[clip].duration : 0;
    for (int i = 0; i < parts; i++) {
        struct differences d;
        if (!compare_pictures(&file, path, clip, part[i] * duration, &d))
            break;
        say("    %-26s clip %d %5.2f s  %6.2f  %6.2f  %6.1f  %6.1f\n", name_of(path), clip, part[i] * duration,
            d.sharp, d.blurred, d.motion, d.contrast);
        CHECK_BAR(d.sharp, sharp_bar, name_of(path));
        CHECK_BAR(d.blurred, sharp_bar + blurred_bar * d.motion, name_of(path));
        CHECK(d.contrast > 10);
        most_motion = fmax(most_motion, d.motion);
        if (duration == 0)
            break;
    }
    close_file(&file);
    return most_motion;
}

static void test_what_is_played_looks_like_the_file(void)
{
    const double part[] = { 0.13, 0.5, 0.77 };
    const struct convert_options o = whole_pictures();
    const char *folder = asset_folder();
    char **list = folder != NULL ? asset_list(folder) : NULL;
    say("    %-26s %14s  %6s  %6s  %6s  %6s\n", "model", "", "sharp", "blur", "motion", "black");
    CHECK(compare_file(arm_path, 0, part, 3, &o) > 2 * sharp_bar);
    compare_file(arm_path, 1, part, 3, &o);
    if (list == NULL)
        say("    no folder of models: set SMEAR_ASSETS\n");
    for (char **path = list; path != NULL && *path != NULL; path++) {
        compare_file(*path, 0, part, 2, &o);
        if (strcmp(name_of(*path), "Fox.glb") == 0) {
            const double run[] = { 0, 0.1, 0.2, 0.4, 0.6, 0.8, 0.97 };
            compare_file(*path, 2, run, 7, &o);
        }
    }
    asset_list_free(list);
}

/* ------------------------------------------------------------------ headers */

static const char include_path[] = "-Iinclude -Ibuild/convert";

static bool run(const char *format, const char *a, const char *b)
{
    char command[400];
    snprintf(command, sizeof command, format, a, b);
    if (CHECK_EQ(system(command), 0))
        return true;
    say("    %s\n", command);
    return false;
}

static bool write_header(const struct conversion *c, const char *name, const char *from)
{
    struct failure f = { { 0 } };
    uint8_t *bytes;
    size_t size;
    char path[100];
    mkdir("build", 0777);
    mkdir("build/convert", 0777);
    snprintf(path, sizeof path, "build/convert/%s.h", name);
    if (!CHECK(convert_to_header(c, name, from, &bytes, &size, &f)))
        return false;
    bool ok = CHECK(file_write(path, bytes, size, &f));
    free(bytes);
    return ok;
}

/* The header compiles as C99 and as C++11. */
static void check_header(const struct conversion *model, const char *from)
{
    END_UNLESS(write_header(model, "model", from));
    FILE *c = fopen("build/convert/model.c", "w");
    REQUIRE(c != NULL);
    fputs("#include \"model.h\"\nconst smear_model *the_model(void);\n"
          "const smear_model *the_model(void) { return &model_model; }\n"
          "int the_bytes(void);\nint the_bytes(void) { return (int)(MODEL_ACTOR_BYTES(2)); }\n", c);
    fclose(c);
    run("${CC:-cc} -std=c99 -Wall -Wextra -pedantic -Werror %s -c -o build/convert/model.o %s",
        include_path, "build/convert/model.c");
    /* Where nobody compiles C++, C alone is tried. */
    run("! command -v ${CXX:-c++} >/dev/null || ${CXX:-c++} -std=c++11 -Wall -Wextra -pedantic -Werror %s -x c++ -fsyntax-only %s",
        include_path, "build/convert/model.c");
}

/* ------------------------------------------------------------------ every file at hand */

static uint8_t *blob_of(const struct conversion *c, size_t *size)
{
    struct failure f = { { 0 } };
    uint8_t *bytes = NULL;
    if (!CHECK(convert_to_blob(c, &bytes, size, &f)))
        say("    %s\n", f.text);
    return bytes;
}

/* The same draws in the same places. */
static void check_same_poses(smear_actor *a, smear_actor *b, const smear_model *model, const smear_play *play)
{
    CHECK_EQ(smear_actor_advance(a, play), SMEAR_OK);
    CHECK_EQ(smear_actor_advance(b, play), SMEAR_OK);
    for (int i = 0; i < model->draw_count; i++) {
        smear_draw x, y;
        CHECK_EQ(smear_actor_draw(a, i, &x), SMEAR_OK);
        CHECK_EQ(smear_actor_draw(b, i, &y), SMEAR_OK);
        CHECK_EQ(x.mesh->vertex_count, y.mesh->vertex_count);
        CHECK_EQ(x.mesh->scale, y.mesh->scale);
        CHECK_EQ(x.mesh->shift, y.mesh->shift);
        CHECK(memcmp(x.mesh->offset, y.mesh->offset, sizeof x.mesh->offset) == 0);
        CHECK(memcmp(x.mesh->position, y.mesh->position, 6u * x.mesh->vertex_count) == 0);
        CHECK(memcmp(x.mesh->index, y.mesh->index, 6u * x.mesh->triangle_count) == 0);
        CHECK(memcmp(x.now, y.now, sizeof *x.now) == 0);
        CHECK((x.open == NULL) == (y.open == NULL));
        if (x.mesh->normal != NULL)
            CHECK(memcmp(x.mesh->normal, y.mesh->normal, 3u * x.mesh->vertex_count) == 0);
        if (x.open_position != NULL)
            CHECK(memcmp(x.open_position, y.open_position, 6u * x.mesh->vertex_count) == 0);
        CHECK_EQ(x.material != NULL, y.material != NULL);
        if (x.material != NULL) {
            CHECK(memcmp(x.material->color, y.material->color, 4) == 0);
            CHECK_EQ(x.material->alpha, y.material->alpha);
            CHECK_EQ(x.material->texture != NULL, y.material->texture != NULL);
        }
    }
}

static void check_blob(const struct conversion *c)
{
    size_t size, bytes;
    smear_model opened;
    uint8_t *blob = blob_of(c, &size);
    if (blob == NULL)
        return;
    CHECK_EQ(smear_mesh_check(blob, size), SMEAR_OK);
    CHECK_EQ(smear_mesh_check(blob, size - 1), SMEAR_MODEL_ERR_SIZE);
    bytes = smear_model_memory(blob, size);
    uint64_t *memory = malloc(bytes + 8);
    if (CHECK(memory != NULL)) {
        CHECK_EQ(smear_model_open(&opened, blob, size, memory, bytes - 1), SMEAR_ERR_MEMORY);
        CHECK_EQ(smear_model_open(&opened, blob, size, memory, bytes), SMEAR_OK);
        CHECK_EQ(opened.draw_count, c->model.draw_count);
        CHECK_EQ(opened.clip_count, c->model.clip_count);
        CHECK_EQ(opened.radius, c->model.radius);
        CHECK_EQ(opened.center[2], c->model.center[2]);
        smear_actor *a = make_actor(&c->model, 2), *b = make_actor(&opened, 2);
        for (int i = 0; a != NULL && b != NULL && i < opened.clip_count; i++) {
            const char *name = opened.text + opened.clip[i].name;
            CHECK(strcmp(name, c->model.text + c->model.clip[i].name) == 0);
            CHECK(smear_model_find_clip(&opened, name) >= 0);
            smear_play play = { .clip = (uint16_t)i, .time = 20000 * i + 9000, .loop = 1 };
            check_same_poses(a, b, &opened, &play);
        }
        const smear_play rest = { .rest = 1 };
        if (a != NULL && b != NULL)
            check_same_poses(a, b, &opened, &rest);
        free(a);
        free(b);
    }
    free(memory);
    free(blob);
}

static void check_meshes(const struct conversion *c)
{
    for (int i = 0; i < c->model.mesh_count; i++) {
        const smear_mesh *mesh = &c->model.mesh[i];
        bool *used = calloc(mesh->vertex_count + 1u, sizeof *used);
        CHECK(mesh->triangle_count > 0);
        for (uint32_t k = 0; used != NULL && k < 3 * mesh->triangle_count; k++)
            if (CHECK(mesh->index[k] < mesh->vertex_count))
                used[mesh->index[k]] = true;
        for (int v = 0; used != NULL && v < mesh->vertex_count; v++)
            if (!CHECK(used[v]))
                break;
        free(used);
    }
}

/* The ball has every vertex at every time, and is not much larger than it must be. */
static void check_ball(const struct conversion *c, const char *name)
{
    smear_actor *actor = make_actor(&c->model, 1);
    double farthest = 0, radius = c->model.radius / 65536.0;
    for (int i = 0; i < 40 * c->model.clip_count + 1; i++) {
        smear_play play = { .rest = i == 0, .clip = (uint16_t)(i > 0 ? (i - 1) / 40 : 0) };
        if (i > 0)
            play.time = (int32_t)(c->model.clip[play.clip].duration / 39 * (uint32_t)((i - 1) % 40));
        CHECK_EQ(smear_actor_advance(actor, &play), SMEAR_OK);
        for (int k = 0; k < c->model.draw_count; k++) {
            smear_draw draw;
            CHECK_EQ(smear_actor_draw(actor, k, &draw), SMEAR_OK);
            for (int v = 0; v < draw.mesh->vertex_count; v++) {
                double p[3], sum = 0;
                measured_point(p, &draw, v);
                for (int axis = 0; axis < 3; axis++)
                    sum += (p[axis] - c->model.center[axis] / 65536.0) * (p[axis] - c->model.center[axis] / 65536.0);
                farthest = fmax(farthest, sqrt(sum));
            }
        }
    }
    CHECK_BAR(farthest, radius, name);
    CHECK_BAR(radius, 2.2 * farthest, name);
    free(actor);
}

static void check_file(const char *path)
{
    struct converted_file file;
    const struct convert_options o = plain_options();
    END_UNLESS(open_file(&file, path, &o));
    const struct conversion *c = &file.result;
    size_t flash = c->bytes.meshes + c->bytes.textures + c->bytes.animation;
    say("    %-26s %5d %5d  %5.2f %5.2f  %7zu %6zu  %6.3f %6.3f\n", name_of(path), c->triangles, c->vertices,
        (double)c->transformed_in_file / c->triangles_in_file, (double)c->transformed / c->triangles, flash,
        c->bytes.actor[1], c->rest_error_px, c->error_px);
    CHECK_BAR(c->error_px, position_bar, name_of(path));
    CHECK_BAR(c->rest_error_px, rest_bar, name_of(path));
    CHECK(c->transformed <= c->transformed_in_file);
    CHECK(c->triangles <= c->triangles_in_file && c->triangles > 0);
    check_meshes(c);
    check_ball(c, name_of(path));
    check_blob(c);
    check_header(c, name_of(path));
    close_file(&file);
}

/* Its header compiles, too. */
static void test_every_file_converts_and_its_blob_plays_the_same(void)
{
    const char *folder = asset_folder();
    char **list = folder != NULL ? asset_list(folder) : NULL;
    say("    %-26s %5s %5s  %5s %5s  %7s %6s  %6s %6s\n", "model", "tri", "vert", "vc/t", "now", "flash", "ram", "rest",
        "clips");
    check_file(arm_path);
    if (list == NULL)
        say("    no folder of models: set SMEAR_ASSETS\n");
    for (char **path = list; path != NULL && *path != NULL; path++)
        check_file(*path);
    asset_list_free(list);
}

/* ------------------------------------------------------------------ the same bytes everywhere */

/* What the committed blob is: test_anim.c plays it on every target. */
static void test_the_blob_in_the_tests_is_what_the_tool_writes(void)
{
    struct converted_file file;
    struct failure f = { { 0 } };
    const struct convert_options o = plain_options();
    uint8_t *made, *kept;
    size_t made_size, kept_size;
    END_UNLESS(open_file(&file, arm_path, &o));
    made = blob_of(&file.result, &made_size);
    /* The fuzzer's seed, of which the Makefile makes arm_blob; its first seven bytes are the fuzzer's own. */
    if (made != NULL && CHECK(file_read("tests/fuzz/corpus/blob/arm", 1 << 20, &kept, &kept_size, &f))) {
        CHECK(kept_size == made_size + 7 && memcmp(kept + 7, made, made_size) == 0);
        free(kept);
    }
    free(made);
    close_file(&file);
}

static void test_functions_of_our_own_are_those_of_the_maths_library(void)
{
    for (int i = -1000; i <= 1000; i++) {
        double x = i * 0.006;
        CHECK_CLOSE(exact_sin(x), sin(x), 1e-13);
        CHECK_CLOSE(exact_cos(x), cos(x), 1e-13);
        CHECK_CLOSE(exact_asin(abs(i) * 0.0007), asin(abs(i) * 0.0007), 1e-13);
        CHECK_EQ(exact_srgb_encode(i / 1000.0), present_srgb_encode(i / 1000.0));
    }
    for (int code = 0; code < 256; code++)
        CHECK_EQ(exact_srgb_code((uint32_t)lround(present_srgb_decode((uint8_t)code) * 65535)), code);
    CHECK_EQ(exact_exponent(1), 0);
    CHECK_EQ(exact_exponent(1.01), 1);
    CHECK_EQ(exact_exponent(0.5), -1);
}

static void check_track(const char *path)
{
    struct model model OWNED(model_free) = { 0 };
    struct failure f = { { 0 } };
    struct track_pose track;
    struct model_pose pose OWNED(model_pose_free) = { 0 };
    const double root[16] = { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 };
    REQUIRE(model_load(path, &model, &f));
    bool ok = CHECK(track_pose_alloc(&track, &model, &f));
    for (int clip = -1; clip < model.clip_count && ok; clip++)
        for (int i = 0; i < 25 && ok; i++) {
            double time = clip < 0 ? 0 : (i - 2) * model.clip[clip].duration / 20;
            ok = CHECK(model_pose(&model, clip < 0 ? MODEL_CLIP_NONE : clip, time, false, &pose, &f));
            track_pose_set(&track, &model, clip, time, root);
            for (int k = 0; k < 16 * model.node_count && ok; k++)
                ok = CHECK_CLOSE(track.world[k / 16][k % 16], pose.node_world[k],
                                 1e-9 * (1 + fabs(pose.node_world[k])));
        }
    track_pose_free(&track);
}

static void test_clips_are_seen_as_the_model_poses_them(void)
{
    const char *folder = asset_folder();
    char **list = folder != NULL ? asset_list(folder) : NULL;
    check_track(arm_path);
    for (char **path = list; path != NULL && *path != NULL; path++)
        check_track(*path);
    asset_list_free(list);
}

/* Of other textures than those of every file. */
static void test_headers_of_other_textures_compile(void)
{
    static const enum convert_texture texture[] = { CONVERT_RGB565, CONVERT_RGB8888 };
    struct convert_options o = plain_options();
    for (int i = 0; i < 2; i++) {
        struct converted_file file;
        o.texture = texture[i];
        END_UNLESS(open_file(&file, arm_path, &o));
        check_header(&file.result, name_of(arm_path));
        close_file(&file);
    }
}

/* ------------------------------------------------------------------ damaged blobs */

enum { TABLES_AT = offsetof(struct smear_blob_head, table) };

static const size_t crc_at = offsetof(struct smear_blob_head, crc32);

static void set_crc(uint8_t *blob, size_t size)
{
    uint32_t crc = crc32_update(0, blob + SMEAR_BLOB_CRC_FROM, size - SMEAR_BLOB_CRC_FROM);
    for (int i = 0; i < 4; i++)
        blob[crc_at + (size_t)i] = (uint8_t)(crc >> 8 * i);
}

/* Whatever passes the check may be played and drawn. */
static void play_if_good(const uint8_t *blob, size_t size, uint8_t *rgb)
{
    smear_model model;
    size_t bytes = smear_model_memory(blob, size);
    if (bytes == 0)
        return;
    uint64_t *memory = malloc(bytes);
    smear_actor *actor = NULL;
    const smear_camera camera = { .pose = SMEAR_IDENTITY, .focal = 2 << 16, .near_plane = 1 << 12 };
    if (memory != NULL && CHECK_EQ(smear_model_open(&model, blob, size, memory, bytes), SMEAR_OK)
        && (actor = make_actor(&model, 2)) != NULL) {
        smear_transform place = SMEAR_IDENTITY;
        place.origin[2] = -4 * 65536;
        for (int i = 0; i < 2 * model.clip_count || i < 2; i++) {
            smear_play play = { .clip = (uint16_t)(i / 2), .rest = model.clip_count == 0, .loop = 1, .place = &place,
                                .time = 13000 + 40000 * (i % 2) };
            CHECK_EQ(smear_actor_advance(actor, &play), SMEAR_OK);
        }
        if (model.draw_count < 64)
            draw_actor(actor, &camera, SMEAR_RECONSTRUCT, rgb);
    }
    free(actor);
    free(memory);
}

static void test_a_blob_with_a_wrong_byte_anywhere_is_refused_or_harmless(void)
{
    struct converted_file file;
    const struct convert_options o = plain_options();
    const uint8_t damage[] = { 0xff, 0x01, 0x80 };
    uint8_t *rgb = malloc(3 * WIDTH * HEIGHT);
    size_t size, refused = 0, played = 0;
    if (!CHECK(rgb != NULL) || !open_file(&file, arm_path, &o))
        return;
    uint8_t *blob = blob_of(&file.result, &size);
    for (size_t i = 0; blob != NULL && i < size; i++)
        for (size_t k = 0; k < sizeof damage; k++) {
            blob[i] ^= damage[k];
            int error = smear_mesh_check(blob, size);
            CHECK(error < 0);
            CHECK(smear_mesh_reason(error)[0] != '\0' && strcmp(smear_mesh_reason(error), "unknown error") != 0);
            /* again with a checksum that fits */
            set_crc(blob, size);
            if (smear_mesh_check(blob, size) != SMEAR_OK) {
                refused++;
            } else if (played++ % (is_thorough() ? 1 : 16) == 0) {
                play_if_good(blob, size, rgb);
            }
            blob[i] ^= damage[k];
            set_crc(blob, size);
        }
    say("    %zu changes that the tables do not allow, %zu that are another model\n", refused, played);
    CHECK(refused > 1000 && played > 1000);
    if (blob != NULL)
        CHECK_EQ(smear_mesh_check(blob, size), SMEAR_OK);
    free(blob);
    free(rgb);
    close_file(&file);
}

/* One word or half word of a good blob is set, and the reason must be the right one. */
static void test_every_kind_of_damage_has_its_reason(void)
{
    struct converted_file file;
    const struct convert_options o = plain_options();
    size_t size;
    uint8_t *blob = NULL;
    if (!open_file(&file, arm_path, &o) || (blob = blob_of(&file.result, &size)) == NULL)
        return;
    const struct smear_blob_head *head = (const struct smear_blob_head *)(const void *)blob;
    const struct {
        int table;
        size_t offset;
        int bytes;
        uint32_t value;
        int error;
    } wrong[] = {
        { -1, 0, 4, 0x12345678u, SMEAR_MODEL_ERR_MAGIC }, { -1, 4, 4, SMEAR_MODEL_FORMAT + 1, SMEAR_MODEL_ERR_FORMAT },
        { -1, 8, 4, 1u << 20, SMEAR_MODEL_ERR_SIZE }, { -1, 8, 4, 16, SMEAR_MODEL_ERR_SIZE },
        { -1, 16, 2, 0, SMEAR_MODEL_ERR_TABLE }, { -1, TABLES_AT + 8 * BLOB_MESH, 4, 2, SMEAR_MODEL_ERR_TABLE },
        { -1, TABLES_AT + 4 + 8 * BLOB_KEY_VALUE, 4, 1u << 31, SMEAR_MODEL_ERR_TABLE },
        { BLOB_TEXTURE, 10, 2, 0, SMEAR_MODEL_ERR_TEXTURE }, { BLOB_TEXTURE, 10, 2, 4096, SMEAR_MODEL_ERR_TEXTURE },
        { BLOB_TEXTURE, 17, 1, 13, SMEAR_MODEL_ERR_TEXTURE }, { BLOB_TEXTURE, 8, 2, 1, SMEAR_MODEL_ERR_TEXTURE },
        { BLOB_TEXTURE, 14, 1, 3, SMEAR_MODEL_ERR_TEXTURE },
        { BLOB_MATERIAL, 0, 2, 7, SMEAR_MODEL_ERR_MATERIAL }, { BLOB_MATERIAL, 6, 1, 3, SMEAR_MODEL_ERR_MATERIAL },
        { BLOB_MESH, 0, 4, 0, SMEAR_MODEL_ERR_MESH }, { BLOB_MESH, 24, 4, 5000, SMEAR_MODEL_ERR_MESH },
        { BLOB_MESH, 28, 2, 3, SMEAR_MODEL_ERR_MESH }, { BLOB_MESH, 30, 1, 63, SMEAR_MODEL_ERR_MESH },
        { BLOB_NODE, 0, 2, 0, SMEAR_MODEL_ERR_NODE }, { BLOB_NODE, 4, 4, 1u << 27, SMEAR_MODEL_ERR_NODE },
        { BLOB_JOINT, 0, 2, 99, SMEAR_MODEL_ERR_SKIN }, { BLOB_SKIN, 2, 2, 9, SMEAR_MODEL_ERR_SKIN },
        { BLOB_DRAW, 0, 2, 99, SMEAR_MODEL_ERR_DRAW }, { BLOB_DRAW, 2, 2, 99, SMEAR_MODEL_ERR_DRAW },
        { BLOB_DRAW, 4, 2, 99, SMEAR_MODEL_ERR_DRAW }, { BLOB_DRAW, 14, 2, 99, SMEAR_MODEL_ERR_DRAW },
        { BLOB_INFLUENCE, 1, 1, 2, SMEAR_MODEL_ERR_DRAW }, { BLOB_DRAW, 16, 2, 77, SMEAR_MODEL_ERR_DRAW },
        { BLOB_TARGET, 4, 4, 9999, SMEAR_MODEL_ERR_MORPH }, { BLOB_DELTA, 0, 2, 99, SMEAR_MODEL_ERR_MORPH },
        { BLOB_CHANNEL, 0, 2, 99, SMEAR_MODEL_ERR_CLIP }, { BLOB_CHANNEL, 4, 2, 0, SMEAR_MODEL_ERR_CLIP },
        { BLOB_CHANNEL, 2, 1, 9, SMEAR_MODEL_ERR_CLIP }, { BLOB_CLIP, 0, 4, 999, SMEAR_MODEL_ERR_CLIP },
        { BLOB_CLIP, 12, 4, 16, SMEAR_MODEL_ERR_CLIP }, { BLOB_KEY_TIME, 4, 2, 0, SMEAR_MODEL_ERR_CLIP },
    };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        uint8_t *at = blob + (wrong[i].table >= 0 ? head->table[wrong[i].table].at : 0) + wrong[i].offset, before[4];
        memcpy(before, at, 4);
        for (int k = 0; k < wrong[i].bytes; k++)
            at[k] = (uint8_t)(wrong[i].value >> 8 * k);
        set_crc(blob, size);
        if (!CHECK_EQ(smear_mesh_check(blob, size), wrong[i].error))
            say("    table %d, offset %zu\n", wrong[i].table, wrong[i].offset);
        memcpy(at, before, 4);
    }
    set_crc(blob, size);
    CHECK_EQ(smear_mesh_check(blob, size), SMEAR_OK);
    CHECK_EQ(smear_mesh_check(blob + 2, size - 2), SMEAR_MODEL_ERR_ALIGN);
    CHECK_EQ(smear_mesh_check(NULL, size), SMEAR_MODEL_ERR_ALIGN);
    CHECK_EQ(smear_mesh_check(blob, 7), SMEAR_MODEL_ERR_SIZE);
    free(blob);
    close_file(&file);
}

/* Records of textures that all have the same texels, as many as there is room for: a small blob that would take a look at
 * 128 kB of texels for each. With a picture of its own for each record it is a good one. */
static void test_arrays_that_many_records_share_do_not_cost_time(void)
{
    enum { RECORDS = 400, TEXELS = 256 * 512, HEAD = (int)sizeof(struct smear_blob_head), OWN = 300 };
    const size_t records = RECORDS * sizeof(struct smear_blob_texture), size = HEAD + records + 4 + TEXELS;
    for (int shared = 0; shared < 2; shared++) {
        uint8_t *blob = calloc(size, 1);
        REQUIRE(blob != NULL);
        struct smear_blob_head *head = (struct smear_blob_head *)(void *)blob;
        *head = (struct smear_blob_head){ .magic = SMEAR_BLOB_MAGIC, .format = SMEAR_MODEL_FORMAT, .size = (uint32_t)size,
                                          .transform_count = 1 };
        for (int i = 0; i < BLOB_TABLES; i++)
            head->table[i].at = HEAD;
        head->table[BLOB_TEXTURE].count = RECORDS;
        struct smear_blob_texture *texture = (struct smear_blob_texture *)(void *)(blob + HEAD);
        for (int i = 0; i < RECORDS; i++)
            texture[i] = (struct smear_blob_texture){
                .palette = (uint32_t)(HEAD + records), .palette_count = 1, .format = SMEAR_TEXEL_PALETTE8,
                .texels = (uint32_t)(HEAD + records + 4) + (shared ? 0u : (uint32_t)(i * OWN)),
                .width = shared ? 256 : OWN, .height = shared ? 512 : 1
            };
        set_crc(blob, size);
        CHECK_EQ(smear_mesh_check(blob, size), shared ? SMEAR_MODEL_ERR_SHARED : (int)SMEAR_OK);
        CHECK(strstr(smear_mesh_reason(SMEAR_MODEL_ERR_SHARED), "share") != NULL);
        free(blob);
    }
}

/* ------------------------------------------------------------------ options */

static void test_scale_and_up_axis_reach_the_vertices(void)
{
    struct converted_file plain, large, z_up;
    struct convert_options o = plain_options();
    smear_draw a, b, c;
    END_UNLESS(open_file(&plain, arm_path, &o));
    o.scale = 3;
    REQUIRE(open_file(&large, arm_path, &o));
    o.scale = 1;
    o.z_up = true;
    REQUIRE(open_file(&z_up, arm_path, &o));
    const smear_play play = { .time = 20000 };
    struct converted_file *file[3] = { &plain, &large, &z_up };
    smear_actor *actor[3];
    for (int i = 0; i < 3; i++) {
        actor[i] = make_actor(&file[i]->result.model, 1);
        CHECK_EQ(smear_actor_advance(actor[i], &play), SMEAR_OK);
    }
    for (int i = 0; i < plain.result.model.draw_count; i++) {
        smear_actor_draw(actor[0], i, &a);
        smear_actor_draw(actor[1], i, &b);
        smear_actor_draw(actor[2], i, &c);
        for (int v = 0; v < a.mesh->vertex_count; v++) {
            double p[3], q[3], r[3];
            measured_point(p, &a, v);
            measured_point(q, &b, v);
            measured_point(r, &c, v);
            for (int k = 0; k < 3; k++)
                CHECK_CLOSE(q[k], 3 * p[k], 0.002);
            CHECK_CLOSE(r[0], p[0], 0.001);
            CHECK_CLOSE(r[1], p[2], 0.001);
            CHECK_CLOSE(r[2], -p[1], 0.001);
        }
    }
    for (int i = 0; i < 3; i++) {
        CHECK_BAR(file[i]->result.error_px, position_bar, "arm");
        free(actor[i]);
        close_file(file[i]);
    }
}

static void test_fit_makes_the_largest_extent_so_long(void)
{
    struct converted_file file;
    struct convert_options o = plain_options();
    o.fit = 5;
    END_UNLESS(open_file(&file, arm_path, &o));
    smear_actor *actor = make_actor(&file.result.model, 1);
    const smear_play rest = { .rest = 1 };
    double low[3] = { 1e9, 1e9, 1e9 }, high[3] = { -1e9, -1e9, -1e9 }, extent = 0;
    CHECK_EQ(smear_actor_advance(actor, &rest), SMEAR_OK);
    for (int i = 0; i < file.result.model.draw_count; i++) {
        smear_draw draw;
        smear_actor_draw(actor, i, &draw);
        for (int v = 0; v < draw.mesh->vertex_count; v++) {
            double p[3];
            measured_point(p, &draw, v);
            for (int k = 0; k < 3; k++) {
                low[k] = fmin(low[k], p[k]);
                high[k] = fmax(high[k], p[k]);
                extent = fmax(extent, high[k] - low[k]);
            }
        }
    }
    CHECK_CLOSE(extent, 5, 0.001);
    free(actor);
    close_file(&file);
}

static void test_textures_come_in_every_form(void)
{
    static const struct { enum convert_texture texture; int count, format; } forms[] = {
        { CONVERT_PALETTE8, 1, SMEAR_TEXEL_PALETTE8 }, { CONVERT_RGB8888, 1, SMEAR_TEXEL_8888 },
        { CONVERT_RGB565, 1, SMEAR_TEXEL_PALETTE8 },    /* it is cut out: 565 has no alpha */
        { CONVERT_BAKED, 0, 0 }, { CONVERT_NO_TEXTURE, 0, 0 },
    };
    for (size_t i = 0; i < sizeof forms / sizeof *forms; i++) {
        struct converted_file file;
        struct convert_options o = plain_options();
        o.texture = forms[i].texture;
        if (!open_file(&file, arm_path, &o))
            continue;
        CHECK_EQ(file.result.texture_count, forms[i].count);
        if (forms[i].count > 0 && file.result.texture_count > 0) {
            const smear_texture *t = &file.result.texture[0];
            CHECK_EQ(t->format, forms[i].format);
            CHECK_EQ(t->width, 4);
            CHECK_EQ(t->wrap_u, SMEAR_MIRROR);
            CHECK_EQ(t->wrap_v, SMEAR_CLAMP);
            if (t->format == SMEAR_TEXEL_PALETTE8) {
                CHECK_EQ(file.result.palette_count[0], 5);
                CHECK_EQ(t->palette[((const uint8_t *)t->texels)[1]], 0xff2878dcu);
                CHECK_EQ(t->palette[((const uint8_t *)t->texels)[3]] >> 24, 0);
            } else {
                CHECK_EQ(((const uint32_t *)t->texels)[0], 0xffe63c28u);
            }
        }
        int faces = 0;
        for (int k = 0; k < file.result.model.mesh_count; k++)
            faces += file.result.model.mesh[k].face_color != NULL;
        CHECK_EQ(faces, forms[i].texture == CONVERT_BAKED);
        check_blob(&file.result);
        close_file(&file);
    }
}

/* A picture is halved in linear light: black and white give code 188, and transparent texels do not count. */
static void test_pictures_shrink_in_linear_light(void)
{
    uint8_t rgba[4 * 16] = { 0 };
    struct model_material material = { .alpha = MODEL_ALPHA_MASK, .image = 0 };
    struct image image = { .width = 4, .height = 4, .rgba = rgba };
    struct model model = { .material_count = 1, .material = &material, .image_count = 1, .image = &image };
    struct convert_options o = plain_options();
    struct failure f = { { 0 } };
    struct image picture = { 0 };
    struct convert_pile *pile = calloc(1, sizeof *pile);
    struct converter c = { .model = &model, .options = &o, .pile = pile, .f = &f, .picture = &picture };
    for (int i = 0; i < 16; i++) {
        bool white = i % 2 == 1;
        memset(rgba + 4 * i, white ? 255 : 0, 3);
        rgba[4 * i + 3] = i % 4 == 2 ? 0 : 255;
    }
    o.texture_edge = 2;
    const struct image *small = shrunk_picture(&c, 0);
    if (CHECK(small != NULL) && CHECK_EQ(small->width, 2) && CHECK_EQ(small->height, 2)) {
        CHECK_EQ(small->rgba[0], 188);
        CHECK_EQ(small->rgba[3], 255);
        CHECK_EQ(small->rgba[4], 255);          /* the black ones beside it cannot be seen */
        CHECK_EQ(small->rgba[7], 128);
    }
    pile_free(pile);
}

static void test_mipmaps_are_halved_in_linear_light(void)
{
    uint8_t rgba[4 * 4 * 2];
    struct model_material material = { .alpha = MODEL_ALPHA_OPAQUE, .image = 0, .wrap_u = MODEL_WRAP_REPEAT, .wrap_v = MODEL_WRAP_REPEAT };
    struct image image = { .width = 4, .height = 2, .rgba = rgba };
    struct model model = { .material_count = 1, .material = &material, .image_count = 1, .image = &image };
    struct convert_options o = { .texture = CONVERT_RGB8888, .texture_edge = 128, .colors = 256, .mipmaps = true };
    for (int i = 0; i < 8; i++) {
        memset(rgba + 4 * i, i % 2 != 0 ? 255 : 0, 3);
        rgba[4 * i + 3] = 255;
    }
    for (int wrap = 0; wrap < 2; wrap++) {
        struct failure f = { { 0 } };
        struct image picture = { 0 };
        struct convert_pile *pile = calloc(1, sizeof *pile);
        struct converter c = { .model = &model, .options = &o, .pile = pile, .f = &f, .picture = &picture,
                               .texture = { .size = sizeof(struct out_texture) },
                               .texture_report = { .size = sizeof(struct convert_texture_report) } };
        int index = -1;
        material.wrap_u = wrap == 0 ? MODEL_WRAP_REPEAT : MODEL_WRAP_CLAMP;
        if (CHECK(texture_for(&c, &material, &index)) && CHECK_EQ(index, 0)) {
            const struct out_texture *t = c.texture.data;
            CHECK_EQ(t->texture.levels, wrap == 0 ? 2 : 0);
            CHECK_EQ((int64_t)convert_texel_count(&t->texture), wrap == 0 ? 8 + 2 + 1 : 8);
            for (int i = 8; wrap == 0 && i < 11; i++)           /* black and white, in equal parts */
                CHECK_EQ(((const uint32_t *)t->texture.texels)[i], 0xffbcbcbcu);
        }
        list_free(&c.texture);
        list_free(&c.texture_report);
        pile_free(pile);
    }
}

static void test_palettes_serve_their_picture(void)
{
    enum { EDGE = 64 };
    struct model_material material = { .alpha = MODEL_ALPHA_OPAQUE, .image = 0 };
    struct image image OWNED(image_free) = { 0 };
    struct model model = { .material_count = 1, .material = &material, .image_count = 1, .image = &image };
    struct convert_options o = plain_options();
    struct failure f = { { 0 } };
    double before = 1e9;
    REQUIRE(image_alloc(&image, EDGE, EDGE, &f));
    for (int y = 0; y < EDGE; y++)
        for (int x = 0; x < EDGE; x++) {
            uint8_t *p = image.rgba + 4 * (y * EDGE + x);
            p[0] = (uint8_t)(4 * x);
            p[1] = (uint8_t)(4 * y);
            p[2] = (uint8_t)(2 * (x + y));
        }
    for (o.colors = 4; o.colors <= 256; o.colors *= 4) {
        struct image picture = { 0 };
        struct convert_pile *pile = calloc(1, sizeof *pile);
        struct converter c = { .model = &model, .options = &o, .pile = pile, .f = &f, .picture = &picture,
                               .texture = { .size = sizeof(struct out_texture) },
                               .texture_report = { .size = sizeof(struct convert_texture_report) } };
        int texture;
        if (CHECK(texture_for(&c, &material, &texture))) {
            const struct convert_texture_report *r = c.texture_report.data;
            CHECK_EQ(r->colors, o.colors);
            say("    %3d colours: rms %.2f codes\n", r->colors, r->rms);
            CHECK(r->rms < before * 0.7);
            before = r->rms;
        }
        list_free(&c.texture);
        list_free(&c.texture_report);
        pile_free(pile);
    }
    CHECK_BAR(before, 5.5, "256 colours of a gradient");
}

static void test_nodes_that_stand_still_go_into_the_vertices_unless_kept(void)
{
    struct converted_file file;
    struct convert_options o = plain_options();
    uint8_t keep[8] = { 0, 0, 1, 0, 0, 0, 1, 0 };       /* the flag and a plate */
    END_UNLESS(open_file(&file, arm_path, &o));
    int nodes = file.result.model.node_count;
    close_file(&file);
    o.keep = keep;
    END_UNLESS(open_file(&file, arm_path, &o));
    CHECK_EQ(file.result.model.node_count, nodes + 1);  /* the plates share a mesh, so they had nodes */
    CHECK_BAR(file.result.error_px, position_bar, "arm");
    bool has_flag = false;
    for (int i = 0; i < file.result.model.node_count; i++)
        has_flag = has_flag || strcmp(file.result.node_name[i], "flag") == 0;
    CHECK(has_flag);
    close_file(&file);
}

static void test_clips_and_normals_can_be_left_out(void)
{
    struct converted_file file;
    struct convert_options o = plain_options();
    const int turn[] = { 1 };
    o.clip = turn;
    o.clip_count = 1;
    o.flat = true;
    END_UNLESS(open_file(&file, arm_path, &o));
    CHECK_EQ(file.result.model.clip_count, 1);
    CHECK_EQ(smear_model_find_clip(&file.result.model, "turn"), 0);
    CHECK_EQ(smear_model_find_clip(&file.result.model, "wave"), -1);
    CHECK_EQ(smear_model_find_clip(&file.result.model, "tur"), -1);
    for (int i = 0; i < file.result.model.mesh_count; i++)
        CHECK(file.result.model.mesh[i].normal == NULL);
    CHECK_EQ(file.result.model.normals, 0);
    CHECK_BAR(file.result.error_px, position_bar, "arm");
    close_file(&file);
    o.clip_count = 0;
    END_UNLESS(open_file(&file, arm_path, &o));
    CHECK_EQ(file.result.model.clip_count, 0);
    check_blob(&file.result);
    close_file(&file);
}

static void test_fewer_keys_for_a_larger_error(void)
{
    int before = 1 << 30;
    for (double error = 0.02; error < 2; error *= 4) {
        struct converted_file file;
        struct convert_options o = plain_options();
        int keys = 0;
        o.clip_error_px = error;
        END_UNLESS(open_file(&file, arm_path, &o));
        for (int i = 0; i < file.result.model.clip_count; i++)
            keys += file.result.clip_report[i].keys;
        say("    clip error %.2f px: %3d keys, measured %.3f px\n", error, keys, file.result.error_px);
        CHECK(keys < before);
        CHECK(file.result.error_px < error);
        before = keys;
        close_file(&file);
    }
}

static void test_what_cannot_be_converted_is_refused_with_a_reason(void)
{
    static const struct { double scale, fit; const char *reason; } cases[] = {
        { 1e15, 0, "more than 30000" }, { 1e5, 0, "more than 30000" }, { 1e-15, 0, "too small" },
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct model model;
        struct conversion c;
        struct failure f = { { 0 } };
        struct convert_options o = plain_options();
        o.scale = cases[i].scale;
        o.fit = cases[i].fit;
        REQUIRE(model_load(arm_path, &model, &f));
        CHECK(!convert_model(&model, &o, &c, &f));
        if (!CHECK(strstr(f.text, cases[i].reason) != NULL))
            say("    %s\n", f.text);
        model_free(&model);
    }
    const char nothing[] = "{\"asset\":{\"version\":\"2.0\"},\"nodes\":[{}],\"scenes\":[{\"nodes\":[0]}]}";
    struct model model;
    struct conversion c;
    struct failure f = { { 0 } };
    struct convert_options o = plain_options();
    if (CHECK(model_parse((const uint8_t *)nothing, sizeof nothing - 1, NULL, &model, &f))) {
        CHECK(!convert_model(&model, &o, &c, &f));
        CHECK(strstr(f.text, "nothing to draw") != NULL);
        model_free(&model);
    }
}

/* ------------------------------------------------------------------ lights */

#define LIT(LIGHTS, NODES) \
    "{'asset':{'version':'2.0'},'extensionsRequired':['KHR_lights_punctual'],'extensions':{'KHR_lights_punctual':{'lights':" LIGHTS "}}," \
    "'buffers':[{'byteLength':36,'uri':'data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA'}]," \
    "'bufferViews':[{'buffer':0,'byteLength':36}],'accessors':[{'bufferView':0,'componentType':5126,'type':'VEC3','count':3}]," \
    "'meshes':[{'primitives':[{'attributes':{'POSITION':0}}]}],'nodes':[{'mesh':0}," NODES "],'scenes':[{'nodes':[0,1,2,3,4,5,6]}]}"
#define SHINES(N) "'extensions':{'KHR_lights_punctual':{'light':" #N "}}"
#define TURNED "'rotation':[-0.6,0,0,0.8],"                 /* from -z to (0, -0.96, -0.28) */
#define SIX(FIRST) FIRST ",{},{},{},{},{}"

static bool parse_lit(const char *json, struct model *m, struct failure *f)
{
    char text[3000];
    size_t size = 0;
    for (; json[size] != '\0' && size < sizeof text; size++)
        text[size] = json[size] == '\'' ? '"' : json[size];
    *f = (struct failure){ { 0 } };
    return model_parse((const uint8_t *)text, size, NULL, m, f);
}

/* Of a file of six lights: two suns, a spot; a third sun, a point and what nobody knows are left out by name. */
static void test_lights_of_a_file_are_those_of_its_header(void)
{
    static const char six[] = LIT("[{'type':'directional','color':[0.5,0.25,1],'intensity':4},{'type':'directional','name':'rim'},"
                                  "{'type':'spot','name':'torch','color':[0,0.5,0.25],'intensity':0.5,'spot':{}},"
                                  "{'type':'area','name':'panel'},{'type':'point','name':'bulb'},{'type':'directional','name':'moon'}]",
                                  "{" TURNED SHINES(0) "},{" SHINES(1) "},{'translation':[1,2,3]," SHINES(2) "},{" SHINES(3) "},{"
                                  SHINES(4) "},{" SHINES(5) "}");
    static const char *const told[] = { "drawn as a point: torch spot", "unknown kinds: panel area",
                                        "beyond two directional ones and a point: bulb point, moon directional" };
    static const char *const written[] = { "model_sun = { { 0, 62915, 18350 }, { 9830, 4915, 19661 }, { 22937, 11469, 45875 } };",
                                           "&smear_lights_shader, { 0, 0, 65536 }, { 16384, 16384, 16384 },",
                                           "{ 0, 65535, 32768 }, { 131072, 262144, 393216 }, 131072", "#include \"smear_scene.h\"" };
    struct convert_options o = plain_options();
    struct converted_file file = { .result = { .pile = NULL } };
    struct failure f;
    uint8_t *header;
    size_t size;
    o.scale = 2;
    REQUIRE(parse_lit(six, &file.model, &f));
    for (size_t i = 0; i < sizeof told / sizeof *told; i++)
        if (!CHECK(strstr(file.model.warning, told[i]) != NULL))
            say("    %s\n", file.model.warning);
    REQUIRE(convert_loaded_file(&file, &o, "six lights"));
    REQUIRE(convert_to_header(&file.result, "model", "six.gltf", &header, &size, &f));
    char *text = calloc(size + 1, 1);
    REQUIRE(text != NULL);
    memcpy(text, header, size);
    for (size_t i = 0; i < sizeof written / sizeof *written; i++)
        if (!CHECK(strstr(text, written[i]) != NULL))
            say("    lacks %s\n%s\n", written[i], strstr(text, "model_sun"));
    free(text);
    free(header);
    check_header(&file.result, "six.gltf");
    close_file(&file);
}

/* Light that is too bright for a picture is dimmed as a whole, a point by what it is in the middle of the model; a range ends it. */
static void test_lights_are_as_bright_as_a_picture_can_show(void)
{
    static const struct { const char *file; double sun, reach; } cases[] = {
        { LIT("[{'type':'directional','intensity':0.5}]", SIX("{" SHINES(0) "}")), 0.5, 0 },
        { LIT("[{'type':'directional','intensity':500}]", SIX("{" SHINES(0) "}")), 1, 0 },
        { LIT("[{'type':'point','intensity':0.25}]", SIX("{'translation':[0.5,0.5,9]," SHINES(0) "}")), 0, 2 },
        { LIT("[{'type':'point','intensity':5000}]", SIX("{'translation':[0.5,0.5,9]," SHINES(0) "}")), 0, 36 },
        { LIT("[{'type':'point','intensity':5000,'range':10}]", SIX("{'translation':[0.5,0.5,9]," SHINES(0) "}")), 0, 10 },
        { LIT("[{'type':'point','intensity':0}]", SIX("{" SHINES(0) "}")), 0, 0 },
        /* A lamp in the midst of the model; a cone without a soft border; a light that is hidden. */
        { LIT("[{'type':'point','intensity':5000}]", SIX("{'translation':[0.5,0.5,0]," SHINES(0) "}")), 0, 2 * sqrt(2) },
        { LIT("[{'type':'spot','intensity':0.25,'spot':{'innerConeAngle':0.5,'outerConeAngle':0.5}}]",
              SIX("{'translation':[0.5,0.5,9]," SHINES(0) "}")), 0, 2 },
        { LIT("[{'type':'directional','intensity':0}]", SIX("{'scale':[0,0,0]," SHINES(0) "}")), 0, 0 },
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct model m;
        struct model_lights lights;
        struct failure f;
        if (!CHECK(parse_lit(cases[i].file, &m, &f))) {
            say("    %s\n", f.text);
            continue;
        }
        CHECK((m.warning[0] != '\0') == (strstr(cases[i].file, "spot") != NULL));
        CHECK(model_find_lights(&m, &lights, &f));
        CHECK_CLOSE(lights.color[MODEL_SUN][0], cases[i].sun, 1e-9);
        CHECK_CLOSE(lights.reach, cases[i].reach, 1e-9);
        CHECK_EQ(lights.has[MODEL_SUN] + lights.has[MODEL_LAMP], cases[i].sun + cases[i].reach > 0);
        model_free(&m);
    }
}

static void test_lights_that_mean_nothing_are_refused_where_they_stand(void)
{
    static const struct { const char *file, *reason; } cases[] = {
        { LIT("[{'type':'point'}]", SIX("{" SHINES(1) "}")), "(nodes[1].extensions.KHR_lights_punctual.light)" },
        { LIT("[{'type':'point'}]", SIX("{" SHINES(-1) "}")), "(nodes[1].extensions.KHR_lights_punctual.light)" },
        { LIT("[{'type':'point'}]", SIX("{" SHINES('a') "}")), "(nodes[1].extensions.KHR_lights_punctual.light)" },
        { LIT("[]", SIX("{'extensions':{'KHR_lights_punctual':{}}}")), "(nodes[1].extensions.KHR_lights_punctual.light)" },
        { LIT("[]", SIX("{'extensions':{'KHR_lights_punctual':[]}}")), "(nodes[1].extensions.KHR_lights_punctual)" },
        { LIT("{}", SIX("{}")), "(extensions.KHR_lights_punctual.lights)" },
        { LIT("[1]", SIX("{}")), "(extensions.KHR_lights_punctual.lights[0])" },
        { LIT("[{}]", SIX("{}")), "a light has a type (extensions.KHR_lights_punctual.lights[0].type)" },
        { LIT("[{'type':1}]", SIX("{}")), "(extensions.KHR_lights_punctual.lights[0].type)" },
        { LIT("[{'type':'point','color':[1,1]}]", SIX("{}")), "(extensions.KHR_lights_punctual.lights[0].color)" },
        { LIT("[{'type':'point','color':[1,-1,0]}]", SIX("{}")), "-1 is no part of a colour" },
        { LIT("[{'type':'point','intensity':-2}]", SIX("{}")), "-2 is no intensity" },
        { LIT("[{'type':'point','intensity':'x'}]", SIX("{}")), "(extensions.KHR_lights_punctual.lights[0].intensity)" },
        { LIT("[{'type':'point','range':0}]", SIX("{}")), "0 is no distance" },
        { LIT("[{'type':'spot'}]", SIX("{}")), "(extensions.KHR_lights_punctual.lights[0].spot)" },
        { LIT("[{'type':'spot','spot':{'innerConeAngle':1}}]", SIX("{}")), "angles from 1 to 0.785398 are no cone" },
    };
    struct model m;
    struct model_lights lights;
    struct failure f;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        CHECK(!parse_lit(cases[i].file, &m, &f));
        CHECK_EQ(m.node_count, 0);
        if (!CHECK(strstr(f.text, cases[i].reason) != NULL))
            say("    %zu: %s\n", i, f.text);
    }
    REQUIRE(parse_lit(LIT("[{'type':'directional'}]", SIX("{'scale':[1,1,0]," SHINES(0) "}")), &m, &f));
    CHECK(!model_find_lights(&m, &lights, &f));
    CHECK(strstr(f.text, "no direction (scale of zero, nodes[1])") != NULL);
    model_free(&m);
}

/* ------------------------------------------------------------------ order */

static void test_triangles_are_ordered_for_the_vertex_cache(void)
{
    enum { EDGE = 80 };         /* a sheet whose rows are longer than the cache */
    static uint16_t index[6 * EDGE * EDGE];
    static int16_t position[3 * (EDGE + 1) * (EDGE + 1)];
    static uint32_t before[6 * EDGE * EDGE], after[6 * EDGE * EDGE];
    static struct convert_origin origin[(EDGE + 1) * (EDGE + 1)];
    struct convert_pile *pile = calloc(1, sizeof *pile);
    struct failure f = { { 0 } };
    int n = 0;
    for (int y = 0; y <= EDGE; y++)
        for (int x = 0; x <= EDGE; x++) {
            int v = y * (EDGE + 1) + x;
            position[3 * v] = (int16_t)x;
            position[3 * v + 1] = (int16_t)y;
            position[3 * v + 2] = 0;
            origin[v] = (struct convert_origin){ .vertex = v, .mesh_vertex = v };
        }
    for (int y = 0; y < EDGE; y++)
        for (int x = 0; x < EDGE; x++) {
            int a = y * (EDGE + 1) + x, corner[6] = { a, a + 1, a + EDGE + 2, a, a + EDGE + 2, a + EDGE + 1 };
            for (int k = 0; k < 6; k++)
                index[n++] = (uint16_t)corner[k];
        }
    struct raw_mesh mesh = { .vertex_count = (EDGE + 1) * (EDGE + 1), .triangle_count = 2 * EDGE * EDGE,
                             .position = position, .index = index, .origin = origin,
                             .origin_count = (EDGE + 1) * (EDGE + 1) };
    for (int i = 0; i < n; i++)
        before[i] = index[i];
    int area = 0;
    if (CHECK(order_triangles(&mesh, false, pile, &f))) {
        for (int i = 0; i < n; i++)
            after[i] = mesh.index[i];
        say("    vertices per triangle: %.3f, after %.3f\n",
            count_transforms(before, 2 * EDGE * EDGE) / (2.0 * EDGE * EDGE),
            count_transforms(after, 2 * EDGE * EDGE) / (2.0 * EDGE * EDGE));
        CHECK(count_transforms(after, 2 * EDGE * EDGE) < 0.62 * 2 * EDGE * EDGE);
        for (int t = 0; t < 2 * EDGE * EDGE; t++) {     /* still the sheet, each triangle the same way round */
            const int16_t *a = position + 3 * mesh.index[3 * t], *b = position + 3 * mesh.index[3 * t + 1];
            const int16_t *c = position + 3 * mesh.index[3 * t + 2];
            int twice = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
            CHECK_EQ(twice, 1);
            area += twice;
        }
        CHECK_EQ(area, 2 * EDGE * EDGE);
        for (int i = 0; i < mesh.origin_count; i++)
            CHECK_EQ(position[3 * origin[i].mesh_vertex], origin[i].vertex % (EDGE + 1));
    }
    pile_free(pile);
}

#include "build/suites/convert_tool.h"
