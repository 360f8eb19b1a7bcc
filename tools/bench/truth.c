/* SPDX-License-Identifier: MIT */
/* truth.c - draws truths with the reference, or reads what was drawn before. */
#include "truth.h"

#include "../scenes/scene.h"
#include "../../tests/ref.h"

#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

enum { SHUTTER_DEGREES = 180, MAX_BYTES = 1 << 28, PATH_LIMIT = 512 };

/* A number that changes with the scene: of its reference pictures at the ends and the middle of the
 * exposure. */
static bool fingerprint(struct scene *scene, uint32_t *crc, struct failure *f)
{
    double length = SHUTTER_DEGREES / 360.0 / scene->fps;
    struct scene_instant instant = { 0 };
    struct ref_options options = { .width = scene->width, .height = scene->height,
                                   .encoded = true, .clear = scene->clear };
    bool ok = true;
    *crc = 0;
    for (int i = 0; i < 3 && ok; i++) {
        struct ref_frame frame;
        struct image picture;
        ok = scene_pose(scene, scene->time + length * (i - 1) / 2.0, &instant, f)
          && ref_draw(&instant, NULL, NULL, &options, &frame, f);
        if (!ok)
            break;
        ok = ref_frame_image(&frame, &picture, f);
        ref_frame_free(&frame);
        if (ok) {
            size_t bytes = (size_t)picture.width * (size_t)picture.height * 4;
            *crc = crc32_update(*crc, picture.rgba, bytes);
            image_free(&picture);
        }
    }
    scene_instant_free(scene, &instant);
    return ok;
}

/* False when there is none, or not of this size; that is no failure. */
static bool read_kept(const char *path, const struct scene *scene, struct float_image *out)
{
    struct failure ignored = { "" };
    uint8_t *bytes;
    size_t size;
    if (!file_read(path, MAX_BYTES, &bytes, &size, &ignored))
        return false;
    bool ok = pfm_decode(bytes, size, out, &ignored);
    free(bytes);
    if (!ok)
        return false;
    if (out->width == scene->width && out->height == scene->height && out->channels == 3)
        return true;
    float_image_free(out);
    return false;
}

static bool draw(struct scene *scene, struct float_image *out, struct failure *f)
{
    struct ref_truth_options options = {
        .time = scene->time, .shutter_degrees = SHUTTER_DEGREES, .exposure = REF_CENTRED,
        .instants = TRUTH_INSTANTS, .encoded = true, .threads = 2
    };
    struct ref_truth truth;
    if (!ref_truth(scene, &options, &truth, f))
        return false;
    bool ok = float_image_alloc(out, truth.width, truth.height, 3, f);
    size_t values = 3 * (size_t)truth.width * (size_t)truth.height;
    for (size_t i = 0; i < values && ok; i++)
        out->value[i] = (float)(truth.code[i] / 255.0);
    ref_truth_free(&truth);
    return ok;
}

bool truth_of(const char *name, const char *folder, struct float_image *out, struct failure *f)
{
    struct scene scene;
    uint32_t crc;
    char path[PATH_LIMIT];
    const char *slash = strrchr(name, '/'), *leaf = slash != NULL ? slash + 1 : name;
    snprintf(path, sizeof path, "%s/truth", folder);
    if (mkdir(path, 0777) != 0 && errno != EEXIST)
        return fail(f, "cannot make a folder for truths (%s)", strerror(errno));
    if (!scene_builtin(name, &scene, f))
        return false;
    bool ok = fingerprint(&scene, &crc, f);
    if (ok) {
        int length = snprintf(path, sizeof path, "%s/truth/%s-%d-%08" PRIx32 ".pfm", folder, leaf,
                              (int)TRUTH_INSTANTS, crc);
        ok = length < (int)sizeof path || fail(f, "the folder's name is too long");
    }
    if (ok && !read_kept(path, &scene, out)) {
        ok = draw(&scene, out, f);
        if (ok && !pfm_save(path, out, f)) {
            float_image_free(out);
            ok = false;
        }
    }
    scene_free(&scene);
    return ok;
}

double truth_rmse(const struct float_image *truth, const struct image *picture)
{
    size_t pixels = (size_t)truth->width * (size_t)truth->height;
    double sum = 0.0;
    for (size_t i = 0; i < pixels; i++)
        for (size_t c = 0; c < 3; c++) {
            double d = 255.0 * (double)truth->value[3 * i + c] - picture->rgba[4 * i + c];
            sum += d * d;
        }
    return sqrt(sum / (3.0 * (double)pixels));
}
