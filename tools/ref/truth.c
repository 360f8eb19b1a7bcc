/* SPDX-License-Identifier: MIT */
/* ref_truth.c - the mean of many sharp instants over an exposure; what every blur is measured
 * against.
 *
 * Instant k stands at (k + 0.5) / N of the exposure (box shutter), is posed by the scene itself and
 * drawn by ref_draw. Even and odd instants are summed apart, by one thread each or by one thread in
 * turn, so that the sum is the same number either way. */
#include "tools/ref/ref.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>

enum { PARTS = 2 };

struct part {
    struct scene *scene;
    const struct ref_truth_options *options;
    struct ref_options draw;
    double start, length;       /* of the exposure, seconds */
    int first;                  /* this part's instants: first, first + PARTS ... */
    pthread_mutex_t *posing;    /* scenes pose one instant at a time */
    double *sum;                /* 3 per pixel */
    bool ok;
    struct failure failure;
};

static bool pose_locked(struct part *part, double time, struct scene_instant *instant)
{
    pthread_mutex_lock(part->posing);
    bool ok = scene_pose(part->scene, time, instant, &part->failure);
    pthread_mutex_unlock(part->posing);
    return ok;
}

static void *sum_part(void *argument)
{
    struct part *part = argument;
    struct scene_instant instant;
    size_t values = 3 * (size_t)part->draw.width * (size_t)part->draw.height;
    memset(&instant, 0, sizeof instant);
    part->ok = true;
    for (int k = part->first; k < part->options->instants && part->ok; k += PARTS) {
        struct ref_frame frame;
        double time = part->start + part->length * (k + 0.5) / part->options->instants;
        part->ok = pose_locked(part, time, &instant)
                && ref_draw(&instant, NULL, NULL, &part->draw, &frame, &part->failure);
        if (part->ok) {
            for (size_t i = 0; i < values; i++)
                part->sum[i] += frame.color[i];
            ref_frame_free(&frame);
        }
    }
    pthread_mutex_lock(part->posing);
    scene_instant_free(part->scene, &instant);
    pthread_mutex_unlock(part->posing);
    return NULL;
}

static bool sum_all(struct part part[PARTS], int threads, struct failure *f)
{
    pthread_t thread;
    bool started = threads > 1 && pthread_create(&thread, NULL, sum_part, &part[1]) == 0;
    sum_part(&part[0]);
    if (started)
        pthread_join(thread, NULL);
    else
        sum_part(&part[1]);
    for (int i = 0; i < PARTS; i++)
        if (!part[i].ok)
            return fail(f, "%s", part[i].failure.text);
    return true;
}

static bool truth_finish(struct ref_truth *out, const struct part part[PARTS], int instants,
                         bool encoded, struct failure *f)
{
    size_t pixels = (size_t)out->width * (size_t)out->height;
    if (!image_alloc(&out->image, out->width, out->height, f))
        return false;
    for (size_t i = 0; i < 3 * pixels; i++) {
        double mean = (part[0].sum[i] + part[1].sum[i]) / instants;
        double code = 255.0 * (encoded ? mean : ref_srgb_encode(mean));
        out->code[i] = code;
        /* Halves go up, also those that rounding has made smaller. */
        out->image.rgba[i / 3 * 4 + i % 3] = (uint8_t)floor(fmin(fmax(code, 0.0), 255.0) + 0.5 + 1e-6);
    }
    return true;
}

bool ref_truth(struct scene *scene, const struct ref_truth_options *options, struct ref_truth *out,
               struct failure *f)
{
    struct ref_truth_options o = *options;
    memset(out, 0, sizeof *out);
    o.width = o.width != 0 ? o.width : scene->width;
    o.height = o.height != 0 ? o.height : scene->height;
    o.fps = o.fps != 0.0 ? o.fps : scene->fps;
    o.instants = o.shutter_degrees == 0.0 ? 1 : o.instants;
    if (o.width < 1 || o.height < 1 || o.width > IMAGE_MAX_EDGE || o.height > IMAGE_MAX_EDGE
        || o.instants < 1 || o.instants > 65536 || !(o.fps > 0.0) || !(o.shutter_degrees >= 0.0))
        return fail(f, "no such exposure (%d x %d, %d instants)", o.width, o.height, o.instants);

    double length = o.shutter_degrees / 360.0 / o.fps;
    double before = o.exposure == REF_CENTRED ? 0.5 : o.exposure == REF_TRAILING ? 1.0 : 0.0;
    size_t values = 3 * (size_t)o.width * (size_t)o.height;
    pthread_mutex_t posing;
    if (pthread_mutex_init(&posing, NULL) != 0)
        return fail(f, "no lock (reference)");
    struct part part[PARTS];
    bool ok = true;
    memset(part, 0, sizeof part);
    for (int i = 0; i < PARTS; i++) {
        part[i].scene = scene;
        part[i].options = &o;
        part[i].draw = (struct ref_options){ .width = o.width, .height = o.height,
                                             .encoded = o.encoded, .clear = scene->clear };
        part[i].start = o.time - before * length;
        part[i].length = length;
        part[i].first = i;
        part[i].posing = &posing;
        part[i].sum = calloc(values, sizeof *part[i].sum);
        ok = ok && part[i].sum != NULL;
    }
    out->width = o.width;
    out->height = o.height;
    out->code = malloc(values * sizeof *out->code);
    if (!ok || out->code == NULL)
        ok = fail(f, "no memory for a frame (%d x %d)", o.width, o.height);
    ok = ok && sum_all(part, o.threads, f) && truth_finish(out, part, o.instants, o.encoded, f);
    for (int i = 0; i < PARTS; i++)
        free(part[i].sum);
    pthread_mutex_destroy(&posing);
    if (!ok)
        ref_truth_free(out);
    return ok;
}

void ref_truth_free(struct ref_truth *truth)
{
    free(truth->code);
    image_free(&truth->image);
    memset(truth, 0, sizeof *truth);
}
