/* SPDX-License-Identifier: MIT */
/* film.c - see film.h. */
#include "tools/view/film.h"

#include "tools/player/exact.h"
#include "tools/player/picture.h"
#include "tools/options/say.h"

#include <math.h>
#include <string.h>
#include <unistd.h>

enum { TRUTH_INSTANTS = 64 };

bool film_picture(const struct view *v, struct image *out, struct failure *f)
{
    const struct lane *lane = &v->main;
    if (!image_alloc(out, lane->device.width, lane->device.height, f))
        return false;
    picture_expand(out, lane->device.pixels, lane->device.stride, lane->options.format);
    return true;
}

/* SCENE-0000.png, the first number that is free. */
static bool free_name(const struct view *v, char name[400])
{
    char stem[280];
    if (!source_stem(v->source->name, stem, sizeof stem))
        snprintf(stem, sizeof stem, "smear");
    for (int i = 0; i < 10000; i++) {
        snprintf(name, 400, "%s-%04d.png", stem, i);
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
    if (!free_name(v, name)) {
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

/* ------------------------------------------------------------------ truth */

void film_measure(struct view *v)
{
    struct failure f = { "" };
    struct image truth, picture;
    struct instant instant = view_instant(v, v->at);
    struct present_options options = setup_frame(&v->main.setup, &v->main.options, instant.frame);
    view_busy(v, "measuring");
    if (!exact_picture(v->presenter, instant.time, &options, v->main.setup.width,
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
