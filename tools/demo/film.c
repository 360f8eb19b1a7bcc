/* SPDX-License-Identifier: MIT */
/* film.c - see film.h. */
#include "tools/demo/film.h"

#include "tools/player/exact.h"
#include "tools/player/picture.h"

/* Half of each frame's time, as film cameras have it. The scenes are functions of time, so the
 * library gets the poses at which the shutter opens and closes. */
static struct present_options options_of(const struct scene *scene, enum film_look look)
{
    return (struct present_options){
        .fps = scene->fps, .shutter_degrees = look == FILM_SHARP ? 0 : 180, .exposure = SMEAR_CENTRED,
        .shutter_poses = true, .method = SMEAR_AUTO, .edges = SMEAR_EDGES_SMOOTH,
        .light = SMEAR_LIGHT_LINEAR, .clear = scene->clear,
    };
}

bool film_open(struct film *film, struct scene *scene, int width, int height, smear_format format,
               struct failure *f)
{
    const struct device_setup setup = { .width = width, .height = height, .format = format,
                                        .methods = SMEAR_SET(SMEAR_AUTO), .threads = 1 };
    *film = (struct film){ .scene = scene };
    film->presenter = presenter_new(scene, f);
    return film->presenter != NULL && device_open(&film->device, &setup, f);
}

void film_close(struct film *film)
{
    presenter_free(film->presenter);
    device_close(&film->device);
    *film = (struct film){ .scene = NULL };
}

bool film_take(struct film *film, double time, enum film_look look, struct image *out,
               struct failure *f)
{
    const struct device_setup *setup = &film->device.setup;
    const struct present_options options = options_of(film->scene, look);
    *out = (struct image){ .rgba = NULL };
    if (look == FILM_EXACT)
        return exact_picture(film->presenter, time, &options, setup->width, setup->height,
                             FILM_INSTANTS, out, f);
    const struct presented *presented = presenter_frame(film->presenter, time, &options, f);
    if (presented == NULL || !device_fit(&film->device, presented, f) ||
        !device_draw(&film->device, presented, f))
        return false;
    if (!image_alloc(out, setup->width, setup->height, f))
        return false;
    picture_expand(out, film->device.pixels, film->device.stride, setup->format);
    return true;
}
