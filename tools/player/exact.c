/* SPDX-License-Identifier: MIT */
/* exact.c - see exact.h. */
#include "tools/player/exact.h"

#include <math.h>
#include <stdlib.h>

enum { DEFAULT_INSTANTS = 8 };

bool exact_open(struct exact *exact, int width, int height, int places, smear_format format,
                smear_dither dither, smear_doubled doubled, struct failure *f)
{
    const struct device_setup setup = { .width = width, .height = height, .threads = 1,
                                        .methods = SMEAR_SET(SMEAR_RECONSTRUCT), .format = format, .dither = dither,
                                        .doubled = doubled };
    const struct presented nothing = { .draw_count = 0 };
    size_t pixels = (size_t)width * (size_t)height;
    *exact = (struct exact){ .width = width, .height = height, .places = places,
                             .sum = calloc(pixels * 3, sizeof *exact->sum),
                             .mean = calloc(pixels, sizeof *exact->mean) };
    if (exact->sum == NULL || exact->mean == NULL)
        return fail(f, "out of memory");
    return device_open(&exact->display, &setup, f) && device_fit(&exact->display, &nothing, f);
}

void exact_close(struct exact *exact)
{
    device_close(&exact->display);
    free(exact->sum);
    free(exact->mean);
    *exact = (struct exact){ .sum = NULL };
}

/* ------------------------------------------------------------------ instants */

struct exposure {
    struct present_options options;
    double open, length;
    int instants;
};

static struct exposure exposure_of(double time, const struct present_options *options, int instants)
{
    struct exposure e = { .options = *options,
                          .instants = instants > 0 ? instants : DEFAULT_INSTANTS };
    double close;
    present_exposure(time, options, &e.open, &close);
    e.length = close - e.open;
    if (options->cut || e.length == 0.0)
        e = (struct exposure){ .options = *options, .open = time, .instants = 1 };
    e.options.method = SMEAR_NONE;
    e.options.instant_only = true;
    return e;
}

static const struct presented *pose_instant(struct presenter *presenter, const struct exposure *e,
                                            int index, struct device *device, struct failure *f)
{
    double time = e->open + e->length * (index + 0.5) / e->instants;
    const struct presented *presented = presenter_frame(presenter, time, &e->options, f);
    return presented != NULL && device_fit(device, presented, f) ? presented : NULL;
}

static void add_counts(smear_stats *sum, const smear_stats *counts)
{
    sum->triangles_in += counts->triangles_in;
    sum->triangles_drawn += counts->triangles_drawn;
    sum->triangles_dropped += counts->triangles_dropped;
    sum->parts_added += counts->parts_added;
    sum->samples += counts->pixels;
    sum->pixels = counts->pixels;
    sum->tiles_complex = sum->tiles[SMEAR_ACCUMULATE] = counts->tiles[SMEAR_NONE];
    if (sum->arena_bytes < counts->arena_bytes)
        sum->arena_bytes = counts->arena_bytes;
}

/* ------------------------------------------------------------------ the mean */

int exact_places(const struct present_options *options, int width, int height)
{
    int places = options->edges == SMEAR_EDGES_SMOOTH ? 16 : 1;
    while (places > 1 && (width * places > 2048 || height * places > 2048))
        places /= 2;
    return places;
}

/* A pixel is as many of the device's along x and y as there are places in it. */
static void add_picture(double *sum, const struct device *device, int places, const double value[256])
{
    const uint32_t *picture = (const uint32_t *)(const void *)device->pixels;
    const int width = device->setup.width;
    for (int y = 0; y < device->setup.height; y++)
        for (int x = 0; x < width; x++, picture++) {
            double *to = sum + 3 * ((size_t)(y / places) * (size_t)(width / places) + (size_t)(x / places));
            to[0] += value[*picture >> 16 & 255];
            to[1] += value[*picture >> 8 & 255];
            to[2] += value[*picture & 255];
        }
}

static uint8_t code_of(double mean, bool is_linear)
{
    return is_linear ? present_srgb_encode(mean) : (uint8_t)floor(mean * 255.0 + 0.5);
}

/* The mean of an exposure, drawn by `device`. */
static bool draw_mean(double *mean, struct presenter *presenter, struct device *device, const struct exposure *e, int places,
                      smear_stats *counts, struct failure *f)
{
    const size_t values = 3 * (size_t)(device->setup.width / places) * (size_t)(device->setup.height / places);
    double value[256];
    for (int code = 0; code < 256; code++)
        value[code] = e->options.light == SMEAR_LIGHT_LINEAR ? present_srgb_decode((uint8_t)code) : code / 255.0;
    for (size_t i = 0; i < values; i++)
        mean[i] = 0.0;
    *counts = (smear_stats){ 0 };
    for (int i = 0; i < e->instants; i++) {
        smear_stats instant;
        const struct presented *presented = pose_instant(presenter, e, i, device, f);
        if (presented == NULL || !device_draw(device, presented, f))
            return false;
        smear_get_stats(device->ctx, &instant);
        add_counts(counts, &instant);
        add_picture(mean, device, places, value);
    }
    for (size_t i = 0; i < values; i++)
        mean[i] /= (double)e->instants * places * places;
    return true;
}

bool exact_draw(struct exact *exact, struct presenter *presenter, struct device *device,
                double time, const struct present_options *options, int instants,
                smear_stats *counts, struct failure *f)
{
    const struct exposure e = exposure_of(time, options, instants);
    const bool is_linear = options->light == SMEAR_LIGHT_LINEAR;
    const size_t pixels = (size_t)exact->width * (size_t)exact->height;
    if (!draw_mean(exact->sum, presenter, device, &e, exact->places, counts, f))
        return false;
    for (size_t i = 0; i < pixels; i++) {
        const double *mean = exact->sum + 3 * i;
        exact->mean[i] = (uint32_t)code_of(mean[0], is_linear) << 16 | (uint32_t)code_of(mean[1], is_linear) << 8
                       | code_of(mean[2], is_linear);
    }
    if (!device_show(&exact->display, exact->mean, f))
        return false;
    smear_stats shown;
    smear_get_stats(exact->display.ctx, &shown);
    counts->crc32 = shown.crc32;
    return true;
}

bool exact_mean(struct presenter *presenter, double time, const struct present_options *options, int width, int height, int instants,
                double *mean, struct failure *f)
{
    const int places = exact_places(options, width, height);
    const struct exposure e = exposure_of(time, options, instants);
    const struct device_setup setup = { .width = width * places, .height = height * places, .threads = 1,
                                        .methods = SMEAR_SET(SMEAR_NONE), .format = SMEAR_XRGB8888, .dither = SMEAR_DITHER_NONE };
    struct device device;
    smear_stats counts;
    const bool ok = device_open(&device, &setup, f) && draw_mean(mean, presenter, &device, &e, places, &counts, f);
    device_close(&device);
    return ok;
}

bool exact_picture(struct presenter *presenter, double time, const struct present_options *options, int width, int height,
                   int instants, struct image *out, struct failure *f)
{
    const size_t values = 3 * (size_t)width * (size_t)height;
    double *mean = calloc(values, sizeof *mean);
    *out = (struct image){ .rgba = NULL };
    bool ok = mean != NULL || fail(f, "out of memory");
    ok = ok && exact_mean(presenter, time, options, width, height, instants, mean, f) && image_alloc(out, width, height, f);
    for (size_t i = 0; i < values && ok; i++)
        out->rgba[i / 3 * 4 + i % 3] = code_of(mean[i], options->light == SMEAR_LIGHT_LINEAR);
    free(mean);
    return ok;
}

bool exact_time(struct presenter *presenter, struct device *device, double time,
                const struct present_options *options, int instants, struct device_times *times,
                struct failure *f)
{
    const struct exposure e = exposure_of(time, options, instants);
    *times = (struct device_times){ 0 };
    for (int i = 0; i < e.instants; i++) {
        struct device_times t;
        const struct presented *presented = pose_instant(presenter, &e, i, device, f);
        if (presented == NULL || !device_time(device, presented, &t, f))
            return false;
        times->submit += t.submit;
        times->raster += t.raster;
        times->convert += t.convert;
        times->total += t.total;
    }
    return true;
}
