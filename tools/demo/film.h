/* SPDX-License-Identifier: MIT */
/* film.h - takes pictures of a scene through the library: the display of a device and the context
 * behind it, kept from picture to picture. */
#ifndef SMEAR_TOOLS_DEMO_FILM_H
#define SMEAR_TOOLS_DEMO_FILM_H

#include "tools/player/device.h"
#include "tools/failure.h"
#include "tools/image/image.h"
#include "tools/scenes/present.h"
#include "tools/scenes/scene.h"

#include <smear.h>
#include <stdbool.h>

enum film_look {
    FILM_SHARP,                 /* the instant */
    FILM_BLURRED,               /* by SMEAR_AUTO */
    FILM_EXACT                  /* the truth: the mean of FILM_INSTANTS instants, each posed anew */
};

enum { FILM_INSTANTS = 64 };

struct film {
    struct scene *scene;
    struct presenter *presenter;
    struct device device;
};

/* `film` is released by film_close in any case; the scene must live until then. FILM_EXACT needs
 * SMEAR_XRGB8888. */
bool film_open(struct film *film, struct scene *scene, int width, int height, smear_format format,
               struct failure *f);
void film_close(struct film *film);

/* *out is allocated here, and empty on failure. Every other format is widened to 8 bits. */
bool film_take(struct film *film, double time, enum film_look look, struct image *out,
               struct failure *f);

#endif
