/* SPDX-License-Identifier: MIT */
/* truth.c - draws truths with the library, or reads what was drawn before. */
#include "tools/bench/truth.h"

#include "tools/bench/take.h"
#include "tools/player/exact.h"
#include "tools/scenes/color.h"

#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

enum { MAX_BYTES = 1 << 28, PATH_LIMIT = 512 };

/* ------------------------------------------------------------------ kept files */

/* False when there is none, or not of this size; that is no failure. */
static bool read_kept(const char *path, int width, int height, struct float_image *out)
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
    if (out->width == width && out->height == height && out->channels == 3)
        return true;
    float_image_free(out);
    return false;
}

/* FOLDER/truth/LEAF-INSTANTS-KIND-CRC.pfm */
static bool kept_path(char out[PATH_LIMIT], const char *folder, const char *scene, int instants,
                      const char *kind, uint32_t crc, struct failure *f)
{
    const char *slash = strrchr(scene, '/'), *leaf = slash != NULL ? slash + 1 : scene;
    snprintf(out, PATH_LIMIT, "%s/truth", folder);
    if (mkdir(out, 0777) != 0 && errno != EEXIST)
        return fail(f, "cannot make a folder for truths (%s)", strerror(errno));
    int length = snprintf(out, PATH_LIMIT, "%s/truth/%s-%d-%s-%08" PRIx32 ".pfm", folder, leaf,
                          instants, kind, crc);
    return length < PATH_LIMIT || fail(f, "the folder's name is too long");
}

/* The chart draws truths on several threads; outputs are written by one at a time (tools/image/file.h). */
static bool keep(const char *path, struct float_image *truth, struct failure *f)
{
    static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
    pthread_mutex_lock(&lock);
    const bool kept = pfm_save(path, truth, f);
    pthread_mutex_unlock(&lock);
    if (kept)
        return true;
    float_image_free(truth);
    return false;
}

/* ------------------------------------------------------------------ by the library */

static bool mean_of(struct rig *rig, int instants, double *mean, struct failure *f)
{
    const struct take *take = &rig->take;
    const struct scene *scene = &rig->scene;
    const struct present_options options = { .fps = scene->fps, .shutter_degrees = TAKE_SHUTTER_DEGREES, .clear = scene->clear,
                                             .light = take->linear ? SMEAR_LIGHT_LINEAR : SMEAR_LIGHT_ENCODED };
    const double time = take->frame < 0 ? scene->time : take->frame / scene->fps;
    return exact_mean(rig->presenter, time + take->later / scene->fps, &options, take->width, take->height, instants, mean, f);
}

/* Reads what is kept under the number of a mean of few instants, which changes with scene and rasterizer; else draws and keeps it. */
static bool truth_of_rig(struct rig *rig, const char *folder, struct float_image *out, struct failure *f)
{
    enum { LOOKS = 5 };
    const int width = rig->take.width, height = rig->take.height;
    const size_t values = 3 * (size_t)width * (size_t)height;
    double *mean = malloc(values * sizeof *mean);
    char path[PATH_LIMIT], kind[48];
    bool ok = mean != NULL ? mean_of(rig, LOOKS, mean, f) : fail(f, "no memory for a truth");
    snprintf(kind, sizeof kind, "%s-%.0f", rig->take.linear ? "linear" : "encoded", 1000.0 * rig->take.later);
    ok = ok && kept_path(path, folder, rig->take.scene, TRUTH_INSTANTS, kind,
                         crc32_update(0, (const uint8_t *)mean, values * sizeof *mean), f);
    if (ok && !read_kept(path, width, height, out)) {
        ok = mean_of(rig, TRUTH_INSTANTS, mean, f) && float_image_alloc(out, width, height, 3, f);
        for (size_t i = 0; i < values && ok; i++)
            out->value[i] = (float)(rig->take.linear ? color_encode(mean[i]) : mean[i]);
        ok = ok && keep(path, out, f);
    }
    free(mean);
    return ok;
}

bool truth_of_take(const struct take *of, const char *folder, struct float_image *out, struct failure *f)
{
    const struct take take = {
        .scene = of->scene, .width = of->width, .height = of->height, .clip = of->clip, .frame = of->frame, .later = of->later,
        .format = SMEAR_XRGB8888, .method = SMEAR_NONE, .linear = of->linear, .instant_only = true
    };
    struct rig rig;
    if (!rig_open(&rig, &take, f))
        return false;
    const bool ok = truth_of_rig(&rig, folder, out, f);
    rig_close(&rig);
    return ok;
}

/* ------------------------------------------------------------------ distance */

bool truth_round(const struct float_image *truth, struct image *out, struct failure *f)
{
    size_t values = 3 * (size_t)truth->width * (size_t)truth->height;
    if (!image_alloc(out, truth->width, truth->height, f))
        return false;
    for (size_t i = 0; i < values; i++)
        out->rgba[i / 3 * 4 + i % 3] = (uint8_t)floor(255.0 * (double)truth->value[i] + 0.5);
    return true;
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
