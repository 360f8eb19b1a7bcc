/* SPDX-License-Identifier: MIT */
/* truth.c - draws truths, with the reference or with the library, or reads what was drawn
 * before. */
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

/* ------------------------------------------------------------------ by the reference */

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

bool truth_reference(const char *name, const char *folder, struct float_image *out,
                     struct failure *f)
{
    struct scene scene;
    uint32_t crc;
    char path[PATH_LIMIT];
    if (!scene_builtin(name, &scene, f))
        return false;
    bool ok = fingerprint(&scene, &crc, f)
           && kept_path(path, folder, name, TRUTH_INSTANTS, "reference", crc, f);
    if (ok && !read_kept(path, scene.width, scene.height, out))
        ok = draw(&scene, out, f) && keep(path, out, f);
    scene_free(&scene);
    return ok;
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

/* Adds a picture that is `places` times as wide and high as the sums. */
static void add_picture(double *sum, const struct image *picture, int places, const double value[256])
{
    const int width = picture->width / places, height = picture->height / places;
    const uint8_t *p = picture->rgba;
    for (int y = 0; y < height * places; y++)
        for (int x = 0; x < width * places; x++, p += 4) {
            double *at = sum + 3 * ((size_t)(y / places) * (size_t)width + (size_t)(x / places));
            for (int c = 0; c < 3; c++)
                at[c] += value[p[c]];
        }
}

/* The rig draws `places` times as wide and high. */
static bool draw_exact(struct rig *rig, int instants, int places, struct float_image *out, struct failure *f)
{
    const int width = rig->take.width / places, height = rig->take.height / places;
    size_t values = 3 * (size_t)width * (size_t)height;
    double *sum = calloc(values, sizeof *sum), value[256];
    bool ok = sum != NULL || fail(f, "no memory for a truth");
    for (int code = 0; code < 256; code++)
        value[code] = rig->take.linear ? ref_srgb_decode(code / 255.0) : code / 255.0;
    for (int i = 0; i < instants && ok; i++) {
        struct image picture;
        ok = instant(rig, (i + 0.5) / instants, &picture, f);
        if (ok) {
            add_picture(sum, &picture, places, value);
            image_free(&picture);
        }
    }
    ok = ok && float_image_alloc(out, width, height, 3, f);
    for (size_t i = 0; i < values && ok; i++) {
        double mean = sum[i] / ((double)instants * places * places);
        out->value[i] = (float)(rig->take.linear ? ref_srgb_encode(mean) : mean);
    }
    free(sum);
    return ok;
}

static bool exact(const struct take *of, int instants, int places, const char *folder, struct float_image *out, struct failure *f)
{
    const struct take take = {
        .scene = of->scene, .width = of->width * places, .height = of->height * places, .clip = of->clip,
        .frame = of->frame, .later = of->later, .format = SMEAR_XRGB8888,
        .method = SMEAR_NONE, .linear = of->linear, .instant_only = true
    };
    struct rig rig;
    uint32_t crc;
    char path[PATH_LIMIT], kind[48], within[16] = "";
    if (!rig_open(&rig, &take, f))
        return false;
    if (places > 1)
        snprintf(within, sizeof within, "-%d", places);
    snprintf(kind, sizeof kind, "%s-%.0f%s", take.linear ? "linear" : "encoded", 1000.0 * take.later, within);
    bool ok = fingerprint_exact(&rig, &crc, f)
           && kept_path(path, folder, take.scene, instants, kind, crc, f);
    if (ok && !read_kept(path, rig.take.width / places, rig.take.height / places, out))
        ok = draw_exact(&rig, instants, places, out, f) && keep(path, out, f);
    rig_close(&rig);
    return ok;
}

bool truth_of_take(const struct take *of, const char *folder, struct float_image *out, struct failure *f)
{
    return exact(of, TRUTH_EXACT_INSTANTS, 1, folder, out, f);
}

bool truth_of_pixels(const struct take *of, int places, const char *folder, struct float_image *out, struct failure *f)
{
    return exact(of, TRUTH_INSTANTS, places, folder, out, f);
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
