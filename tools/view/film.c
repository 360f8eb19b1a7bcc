/* SPDX-License-Identifier: MIT */
/* film.c - see film.h. */
#include "tools/view/film.h"

#include "tools/player/picture.h"
#include "tools/options/say.h"
#include "tools/options/sink.h"

#include <math.h>
#include <string.h>
#include <unistd.h>

#define PI 3.14159265358979323846

enum { MAX_SEARCH = 240, TRUTH_INSTANTS = 64 };

bool film_picture(const struct view *v, struct image *out, struct failure *f)
{
    const struct lane *lane = &v->main;
    if (!image_alloc(out, lane->device.width, lane->device.height, f))
        return false;
    picture_expand(out, lane->device.pixels, lane->device.stride, lane->options.format);
    return true;
}

/* SCENE-0000.ENDING, the first number that is free. */
static bool free_name(const struct view *v, const char *ending, char name[400])
{
    char stem[280];
    if (!source_stem(v->source->name, stem, sizeof stem))
        snprintf(stem, sizeof stem, "smear");
    for (char *c = stem; *c != '\0'; c++)
        if (*c == '%')                  /* would be a frame's number to a sink */
            *c = '_';
    for (int i = 0; i < 10000; i++) {
        snprintf(name, 400, "%s-%04d.%s", stem, i, ending);
        if (access(name, F_OK) != 0)
            return true;
    }
    return false;
}

void film_screenshot(struct view *v)
{
    struct failure f = { "" };
    struct image picture;
    char name[400];
    if (!free_name(v, "png", name)) {
        view_say(v, "too many screenshots");
        return;
    }
    if (film_picture(v, &picture, &f)) {
        if (png_save(name, &picture, &f))
            view_say(v, "wrote %s", name);
        image_free(&picture);
    }
    if (f.text[0] != '\0')
        view_say(v, "%s: %s", name, f.text);
}

/* ------------------------------------------------------------------ loops */

/* Frames from `first` until two in a row look as the first two do;
 * 0: none within the search; -1: it was ended. */
static long find_loop(struct view *v, long first)
{
    uint32_t start[2] = { 0, 0 }, last = 0;
    for (long i = 0; i <= MAX_SEARCH; i++) {
        if (!view_busy(v, "looking for a loop", i, MAX_SEARCH)
            || !view_draw_main(v, (first + i) * VIEW_UNITS))
            return -1;
        uint32_t crc = v->main.stats.crc32;
        if (i < 2)
            start[i] = crc;
        else if (last == start[0] && crc == start[1])
            return i - 1;
        last = crc;
    }
    return 0;
}

static long common_multiple(long a, long b)
{
    long x = a, y = b;
    while (y != 0) {
        long rest = x % y;
        x = y;
        y = rest;
    }
    return a / x * b;
}

/* Frames until scene and turntable are as they were, where that is known; else 0. */
static long whole_loop(const struct view *v)
{
    long period = view_period(v);
    if (v->orbit.spin == 0.0)
        return period;
    double turn = 2.0 * PI / fabs(v->orbit.spin) * view_fps(v);
    long frames = lround(turn);
    if (frames < 1 || frames > MAX_SEARCH || fabs(turn - (double)frames) > 1e-6)
        return 0;
    frames = period > 0 ? common_multiple(period, frames) : frames;
    return frames <= 4 * MAX_SEARCH ? frames : 0;
}

/* What is to be recorded; the user is told when there is nothing. */
static bool choose_frames(struct view *v, long *first, long *count)
{
    if (v->mark[0] >= 0 && v->mark[1] >= 0) {
        if (v->mark[1] < v->mark[0]) {
            view_say(v, "the last frame comes before the first");
            return false;
        }
        *first = (long)v->mark[0];
        *count = (long)(v->mark[1] - v->mark[0]) + 1;
        return true;
    }
    *count = whole_loop(v);
    if (*count > 0) {
        *first = 0;
        return true;
    }
    *first = (long)(v->at / VIEW_UNITS);
    *count = find_loop(v, *first);
    if (*count == 0)
        view_say(v, "no loop within %d frames; mark one with ( and )", MAX_SEARCH);
    else if (*count < 0)
        view_say(v, "no loop was looked for to the end");
    return *count > 0;
}

/* Adds the frames; *written leaves out a last one that is the first again. */
static bool add_frames(struct view *v, struct sink *sink, long first, long count, long *written,
                       struct failure *f)
{
    uint32_t crc_of_first = 0;
    for (long i = 0; i < count; i++) {
        struct image picture;
        if (!view_busy(v, "recording", i, count))
            return fail(f, "interrupted");
        if (!view_draw_main(v, (first + i) * VIEW_UNITS))
            return fail(f, "%s", v->message);
        if (i == 0)
            crc_of_first = v->main.stats.crc32;
        else if (i == count - 1 && v->main.stats.crc32 == crc_of_first)
            return true;
        if (!film_picture(v, &picture, f))
            return false;
        bool ok = sink_add(sink, &picture, NULL, i, f);
        image_free(&picture);
        if (!ok)
            return false;
        ++*written;
    }
    return true;
}

void film_record(struct view *v, enum film_kind kind)
{
    struct failure f = { "" };
    struct sink sink = { 0 };
    long first, count, written = 0;
    char name[400];
    if (!choose_frames(v, &first, &count))
        return;
    if (!free_name(v, kind == FILM_GIF ? "gif" : "apng", name) ||
        sink_open(&sink, "recording", name, count, false) != STATUS_OK) {
        view_say(v, "no name for the recording");
        return;
    }
    sink.fps = view_fps(v);
    if (add_frames(v, &sink, first, count, &written, &f) && sink_end(&sink, &f))
        view_say(v, "wrote %s, %ld frames", name, written);
    else
        view_say(v, "%s: %s", name, f.text);
    sink_cancel(&sink);
    v->is_dirty = true;
}

/* ------------------------------------------------------------------ truth */

void film_measure(struct view *v)
{
    struct failure f = { "" };
    struct image truth, picture;
    struct instant instant = view_instant(v, v->at);
    struct present_options options = setup_frame(&v->main.setup, &v->main.options, instant.frame);
    view_busy(v, "measuring", 0, 1);
    if (!presenter_exact(v->presenter, instant.time, &options, v->main.setup.width,
                         v->main.setup.height, options.shutter_degrees > 0.0 ? TRUTH_INSTANTS : 1,
                         &truth, &f)) {
        view_say(v, "%s", f.text);
        return;
    }
    if (film_picture(v, &picture, &f)) {
        v->has_error = image_compare(&truth, &picture, IMAGE_PIXELS_PER_DEGREE, &v->error, &f);
        image_free(&picture);
    }
    image_free(&truth);
    if (v->has_error)
        view_say(v, "rmse %.2f codes, ssim %.4f, flip %.4f", v->error.rmse, v->error.ssim,
                 v->error.flip);
    else
        view_say(v, "%s", f.text);
    v->is_dirty = true;
}
