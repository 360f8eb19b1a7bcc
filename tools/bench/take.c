/* SPDX-License-Identifier: MIT */
/* take.c - sets up scenes and contexts, draws, collects what is flushed. */
#include "tools/bench/take.h"

#include "tools/player/crew.h"
#include "tools/player/picture.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { MOST_DRAWS = 512 };

int bench_frame(const struct presented *frame, struct crew *crew, smear_context *ctx);

/* What is measured. */
#if defined(__GNUC__)
__attribute__((noinline))
#endif
int bench_frame(const struct presented *frame, struct crew *crew, smear_context *ctx)
{
    int result = presented_submit(frame, ctx);
    return result == SMEAR_OK ? crew_render(crew, ctx) : result;
}

/* ------------------------------------------------------------------ rigs */

static size_t row_bytes(const struct take *take)
{
    return picture_row_bytes(take->width, take->format);
}

static int take_band(void *user, const smear_band *band)
{
    const struct rig *rig = user;
    if (rig->display != NULL)
        picture_put_band(rig->display, row_bytes(&rig->take), rig->take.format, band);
    return 0;
}

int take_whole(int height)
{
    return (height + 7) / 8 * 8;
}

static bool start_library(struct rig *rig, struct failure *f)
{
    const struct take *t = &rig->take;
    smear_desc desc = presented_desc(rig->frame, t->width, t->height);
    desc.format = (uint8_t)t->format;
    desc.display.dither = t->dithered ? SMEAR_DITHER_ORDERED : SMEAR_DITHER_NONE;
    desc.reach = (int16_t)t->reach;
    desc.methods |= (uint16_t)(t->windowed ? SMEAR_SET(SMEAR_RECONSTRUCT) : 0u);
    desc.methods |= (uint16_t)(t->method == SMEAR_AUTO && t->target >= SMEAR_DRAFT ? SMEAR_SET_SKETCH : 0u);
    if (!t->plain_context)
        present_tiles(&desc, true);
    desc.workers = (uint8_t)(t->workers > 1 ? t->workers : 1);
    desc.band_rows = t->windowed ? 0 : (int16_t)t->band_rows;
    if (t->instant_only)        /* other instants may show more draws */
        desc.max_draws = MOST_DRAWS;
    desc.vertex_cache = t->plain_context ? 0 : 4096;
    desc.flush = take_band;
    desc.idle = t->workers > 1 ? crew_idle : NULL;
    desc.user = rig;
    size_t bytes = smear_memory_size(&desc);
    rig->memory = bytes > 0 ? calloc(1, bytes) : NULL;
    if (rig->memory == NULL)
        return fail(f, "no memory for a context");
    int result = smear_init(&rig->ctx, &desc, rig->memory, bytes);
    return result == SMEAR_OK || fail(f, "the library takes no such context: %s", smear_error_text(result));
}

bool rig_seek_time(struct rig *rig, double seconds, struct failure *f)
{
    static const smear_layer plain = { .mask = 255, .two_camera = 1 };
    const struct take *t = &rig->take;
    struct present_options options = {
        .fps = rig->scene.fps, .shutter_degrees = TAKE_SHUTTER_DEGREES, .method = t->method,
        .samples = t->samples, .reconstruct = t->reconstruct, .target = t->target,
        .light = t->linear ? SMEAR_LIGHT_LINEAR : SMEAR_LIGHT_ENCODED,
        .shutter_poses = t->shutter_poses, .instant_only = t->instant_only,
        .filter = t->filter, .camera_step = t->camera_step, .pingpong = t->pingpong, .weights = t->weights,
        .texels_565 = t->texels_565, .clear = rig->scene.clear,
        .layer = t->plain ? &plain : NULL, .layer_count = t->plain
    };
    rig->frame = presenter_frame(rig->presenter, seconds, &options, f);
    return rig->frame != NULL;
}

bool rig_seek(struct rig *rig, int frame, struct failure *f)
{
    double seconds = frame < 0 ? rig->scene.time : frame / rig->scene.fps;
    return rig_seek_time(rig, seconds + rig->take.later / rig->scene.fps, f);
}

bool take_is_file(const char *scene)
{
    const size_t length = strlen(scene);
    return length > 4 && strcmp(scene + length - 4, ".glb") == 0;
}

enum { PATH_LIMIT = 512 };

/* The environment tells it to the program's copy under callgrind, too. */
static void model_path(char out[PATH_LIMIT], const char *file)
{
    const char *folder = getenv("SMEAR_ASSETS");
    snprintf(out, PATH_LIMIT, "%s/%s", folder != NULL && folder[0] != '\0' ? folder : "../shared/assets", file);
}

bool take_is_there(const char *scene)
{
    char path[PATH_LIMIT];
    model_path(path, scene);
    return !take_is_file(scene) || access(path, R_OK) == 0;
}

/* With the automatic camera, unless the file has one. */
static bool open_model(struct rig *rig, struct failure *f)
{
    const char *clip = rig->take.clip;
    char path[PATH_LIMIT];
    model_path(path, rig->take.scene);
    if (!model_load(path, &rig->model, f))
        return false;
    struct scene_view view = { .clip = rig->model.clip_count > 0 ? 0 : MODEL_CLIP_NONE, .loop = true,
                               .camera = rig->model.camera_count > 0 ? 0 : -1, .aspect = 4.0 / 3.0 };
    if (clip != NULL)
        view.clip = model_find_clip(&rig->model, clip);
    bool ok = view.clip >= 0 || clip == NULL || fail(f, "the model has no clip \"%s\"", clip);
    if (ok && scene_from_model(&rig->model, &view, &rig->scene, f))
        return true;
    model_free(&rig->model);
    return false;
}

bool rig_open(struct rig *rig, const struct take *take, struct failure *f)
{
    memset(rig, 0, sizeof *rig);
    rig->take = *take;
    rig->is_file = take_is_file(take->scene);
    bool ok = rig->is_file ? open_model(rig, f) : scene_builtin(take->scene, &rig->scene, f);
    if (ok && take->width == 0)
        rig->take.width = rig->scene.width;
    if (ok && take->height == 0)
        rig->take.height = rig->scene.height;
    if (ok)
        rig->presenter = presenter_new(&rig->scene, f);
    if (ok && take->workers > 1)
        ok = (rig->crew = crew_start(take->workers, f)) != NULL;
    ok = ok && rig->presenter != NULL && rig_seek(rig, take->frame, f) && start_library(rig, f);
    if (!ok)
        rig_close(rig);
    return ok;
}

void rig_close(struct rig *rig)
{
    crew_stop(rig->crew);
    presenter_free(rig->presenter);
    scene_free(&rig->scene);
    if (rig->is_file)
        model_free(&rig->model);
    free(rig->memory);
    memset(rig, 0, sizeof *rig);
}

bool rig_draw(struct rig *rig, struct failure *f)
{
    int result = bench_frame(rig->frame, rig->crew, rig->ctx);
    if (result != SMEAR_OK)
        return fail(f, "the library refused a frame: %s", smear_error_text(result));
    smear_get_stats(rig->ctx, &rig->stats);
    return true;
}

/* ------------------------------------------------------------------ pictures */

bool rig_picture(struct rig *rig, int32_t clear, struct image *out, struct failure *f)
{
    const struct presented *kept = rig->frame;
    struct presented frame = *kept;
    if (clear != CLEAR_OF_SCENE)
        frame.frame.clear = (uint32_t)clear;
    if (!image_alloc(out, rig->take.width, rig->take.height, f))
        return false;
    rig->frame = &frame;
    rig->display = malloc(row_bytes(&rig->take) * (size_t)rig->take.height);
    bool ok = rig->display != NULL ? rig_draw(rig, f) : fail(f, "no memory for a picture");
    rig->frame = kept;
    if (ok)
        picture_expand(out, rig->display, row_bytes(&rig->take), rig->take.format);
    free(rig->display);
    rig->display = NULL;
    if (!ok)
        image_free(out);
    return ok;
}
