/* SPDX-License-Identifier: MIT */
/* truth.c - draws truths with the library, or reads what was drawn before. */
#include "tools/bench/truth.h"

#include "tools/bench/take.h"
#include "tools/ref/ref.h"

#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

enum { SHUTTER_DEGREES = TAKE_SHUTTER_DEGREES, MAX_BYTES = 1 << 28, PATH_LIMIT = 512 };

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

struct exposure {
    double open, length;        /* seconds */
};

static struct exposure exposure_of(const struct rig *rig)
{
    const struct scene *scene = &rig->scene;
    double length = SHUTTER_DEGREES / 360.0 / scene->fps;
    double time = rig->take.frame < 0 ? scene->time : rig->take.frame / scene->fps;
    return (struct exposure){ time + rig->take.later / scene->fps - length / 2.0, length };
}

/* `at` is 0 at shutter open, 1 at close. */
static bool instant(struct rig *rig, double at, struct image *out, struct failure *f)
{
    const struct exposure e = exposure_of(rig);
    return rig_seek_time(rig, e.open + e.length * at, f)
        && rig_picture(rig, CLEAR_OF_SCENE, out, f);
}

/* Of a few instants, so that a change of scene or rasterizer shows. */
static bool fingerprint_exact(struct rig *rig, uint32_t *crc, struct failure *f)
{
    enum { LOOKS = 5 };
    *crc = 0;
    for (int i = 0; i < LOOKS; i++) {
        struct image picture;
        if (!instant(rig, (i + 0.5) / LOOKS, &picture, f))
            return false;
        *crc = crc32_update(*crc, picture.rgba,
                            4 * (size_t)picture.width * (size_t)picture.height);
        image_free(&picture);
    }
    return true;
}

static bool draw_exact(struct rig *rig, int instants, struct float_image *out, struct failure *f)
{
    const size_t values = 3 * (size_t)rig->take.width * (size_t)rig->take.height;
    double *sum = calloc(values, sizeof *sum), value[256];
    bool ok = sum != NULL || fail(f, "no memory for a truth");
    for (int code = 0; code < 256; code++)
        value[code] = rig->take.linear ? ref_srgb_decode(code / 255.0) : code / 255.0;
    for (int i = 0; i < instants && ok; i++) {
        struct image picture;
        ok = instant(rig, (i + 0.5) / instants, &picture, f);
        if (!ok)
            break;
        for (size_t k = 0; k < values; k++)
            sum[k] += value[picture.rgba[k / 3 * 4 + k % 3]];
        image_free(&picture);
    }
    ok = ok && float_image_alloc(out, rig->take.width, rig->take.height, 3, f);
    for (size_t i = 0; i < values && ok; i++) {
        const double mean = sum[i] / instants;
        out->value[i] = (float)(rig->take.linear ? ref_srgb_encode(mean) : mean);
    }
    free(sum);
    return ok;
}

bool truth_of_take(const struct take *of, const char *folder, struct float_image *out, struct failure *f)
{
    const struct take take = {
        .scene = of->scene, .width = of->width, .height = of->height, .clip = of->clip, .frame = of->frame, .later = of->later,
        .format = SMEAR_XRGB8888, .method = SMEAR_NONE, .linear = of->linear, .instant_only = true
    };
    struct rig rig;
    uint32_t crc;
    char path[PATH_LIMIT], kind[48];
    if (!rig_open(&rig, &take, f))
        return false;
    snprintf(kind, sizeof kind, "%s-%.0f", take.linear ? "linear" : "encoded", 1000.0 * take.later);
    bool ok = fingerprint_exact(&rig, &crc, f) && kept_path(path, folder, take.scene, TRUTH_INSTANTS, kind, crc, f);
    if (ok && !read_kept(path, rig.take.width, rig.take.height, out))
        ok = draw_exact(&rig, TRUTH_INSTANTS, out, f) && keep(path, out, f);
    rig_close(&rig);
    return ok;
}

bool truth_exact(const char *scene, bool linear, double later, const char *folder,
                 struct float_image *out, struct failure *f)
{
    const struct take take = { .scene = scene, .frame = -1, .later = later, .linear = linear };
    return truth_of_take(&take, folder, out, f);
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
