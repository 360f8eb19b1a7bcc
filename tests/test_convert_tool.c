/* SPDX-License-Identifier: MIT */
/* test_convert_tool.c - models as firmware data (tools/convert): every file at hand converts, what comes out is checked,
 * opened, compiled and played by the animation module (src/anim.c), and looks like the file itself. Needs files, so it
 * runs on hosts only; test_anim.c plays the same data on every target. */
#include "accuracy.h"

#include "../src/blob.h"
#include "../tools/convert/build.h"
#include "../tools/convert/exact.h"
#include "../tools/convert/track.h"
#include "test.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

void suite_convert_tool(void);

#include "arm_blob.h"

enum { WIDTH = 320, HEIGHT = 240 };

static const char arm_path[] = "tests/arm.gltf";

/* What is lost on the way, over the whole picture. */
static const double sharp_bar = 1.6;            /* codes, RMSE; textures whole */
static const double blurred_bar = 1.6;
static const double position_bar = 0.15;        /* px at 240 rows: 8-bit weights and the default keys */

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

/* ------------------------------------------------------------------ pictures */

static int keep_band(void *user, const smear_band *band)
{
    uint8_t *rgb = user;
    for (int y = 0; y < band->height; y++) {
        const uint32_t *row = (const uint32_t *)band->pixels + (size_t)y * (band->stride / 4);
        for (int x = 0; x < band->width; x++)
            for (int k = 0; k < 3; k++)
                rgb[3 * ((size_t)(band->y + y) * (size_t)band->width + (size_t)x) + (size_t)k] =
                    (uint8_t)(row[x] >> (16 - 8 * k));
    }
    return 0;
}

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
    smear_desc desc = { .width = WIDTH, .height = HEIGHT, .format = SMEAR_XRGB8888, .max_draws = 64,
                        .max_triangles = 20000, .flush = keep_band, .user = rgb };
    smear_frame frame = { .camera = camera, .open = camera, .method = (uint8_t)method };
    smear_context *ctx;
    size_t bytes = smear_memory_size(&desc);
    void *memory = malloc(bytes);
    bool ok = CHECK(memory != NULL) && CHECK_EQ(smear_init(&ctx, &desc, memory, bytes), SMEAR_OK)
           && CHECK_EQ(smear_begin(ctx, &frame), SMEAR_OK) && CHECK_EQ(smear_actor_submit(actor, ctx), SMEAR_OK)
           && CHECK_EQ(smear_render(ctx), SMEAR_OK);
    free(memory);
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
    double sharp, blurred, contrast;    /* codes, RMSE; contrast: of the picture against black */
};

/* The frame at `time` of the file's clip, drawn from the file and from the result. */
static bool compare_pictures(const struct converted_file *file, const char *path, int clip, double time,
                             struct differences *out)
{
    struct failure f = { { 0 } };
    struct subject s;
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
        play.time = (int32_t)lround((time - 1.0 / 30) * 65536);
        CHECK_EQ(smear_actor_advance(actor, &play), SMEAR_OK);
        play.time = (int32_t)lround(time * 65536);
        CHECK_EQ(smear_actor_advance(actor, &play), SMEAR_OK);
        ok = draw_actor(actor, &camera, SMEAR_NONE, rgb);
        out->sharp = rmse_between(rgb, from_file[0].rgb);
        out->contrast = rmse_between(black, from_file[0].rgb);
        ok = ok && draw_actor(actor, &camera, SMEAR_RECONSTRUCT, rgb);
        out->blurred = rmse_between(rgb, from_file[1].rgb);
    }
    shot_free(&from_file[0]);
    shot_free(&from_file[1]);
    scene_instant_free(&s.scene, &instant);
    subject_close(&s);
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

static void compare_file(const char *path, int clip, const double *part, int parts, const struct convert_options *o)
{
    struct converted_file file;
    if (!open_file(&file, path, o))
        return;
    double duration = clip < file.model.clip_count ? file.model.clip[clip].duration : 0;
    for (int i = 0; i < parts; i++) {
        struct differences d;
        if (!compare_pictures(&file, path, clip, part[i] * duration, &d))
            break;
        say("    %-26s clip %d %5.2f s  %6.2f  %6.2f  %6.1f\n", name_of(path), clip, part[i] * duration, d.sharp,
            d.blurred, d.contrast);
        CHECK_BAR(d.sharp, sharp_bar, name_of(path));
        CHECK_BAR(d.blurred, blurred_bar, name_of(path));
        CHECK(d.contrast > 10);
    }
    close_file(&file);
}

static void test_what_is_played_looks_like_the_file(void)
{
    const double part[] = { 0.13, 0.5, 0.77 };
    const struct convert_options o = whole_pictures();
    const char *folder = asset_folder();
    char **list = folder != NULL ? asset_list(folder) : NULL;
    say("    %-26s %14s  %6s  %6s  %6s\n", "model", "", "sharp", "blur", "black");
    compare_file(arm_path, 0, part, 3, &o);
    compare_file(arm_path, 1, part, 3, &o);
    if (list == NULL)
        say("    no folder of models: set SMEAR_ASSETS\n");
    for (char **path = list; path != NULL && *path != NULL; path++)
        compare_file(*path, 0, part, 2, &o);
    for (char **path = list; path != NULL && *path != NULL; path++)
        if (strcmp(name_of(*path), "Fox.glb") == 0) {
            const double run[] = { 0, 0.1, 0.2, 0.4, 0.6, 0.8, 0.97 };
            compare_file(*path, 2, run, 7, &o);
        }
    asset_list_free(list);
}

void suite_convert_tool(void)
{
    RUN(test_what_is_played_looks_like_the_file);
}
