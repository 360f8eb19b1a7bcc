/* SPDX-License-Identifier: MIT */
/* gallery.h - the folder of pictures: writes them one by one, each whole or not at all, and tells what
 * each shows. */
#ifndef SMEAR_TOOLS_DEMO_GALLERY_H
#define SMEAR_TOOLS_DEMO_GALLERY_H

#include "../failure.h"
#include "../image/image.h"
#include "film.h"

#include <stdbool.h>

struct gallery {
    const char *folder;
    int pictures, failures;     /* written; missing */
};

/* Makes the folder and those above it. */
bool gallery_open(struct gallery *gallery, const char *folder, struct failure *f);

/* Writes FOLDER/NAME, a PNG. */
bool gallery_hang(struct gallery *gallery, const char *name, const char *what,
                  const struct image *picture, struct failure *f);

/* A film of `count` frames from frame `first` on, at `fps`; GIF or APNG by the end of the name. It
 * loops for ever. */
struct gallery_reel {
    const char *name, *what;
    enum film_look look;
    double fps;
    int first, count;           /* frames */
};
bool gallery_show(struct gallery *gallery, struct film *film, const struct gallery_reel *reel,
                  struct failure *f);

#endif
