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
};

/* Makes the folder and those above it. `folder` must outlive the gallery. */
bool gallery_open(struct gallery *gallery, const char *folder, struct failure *f);

/* Writes the picture as FOLDER/NAME, a PNG. */
bool gallery_hang(const struct gallery *gallery, const char *name, const char *what,
                  const struct image *picture, struct failure *f);

/* Writes `count` blurred frames from time 0 on at the scene's pace, for ever repeated: a GIF or, when
 * the name does not end so, an APNG. */
bool gallery_show(const struct gallery *gallery, const char *name, const char *what,
                  struct film *film, int count, struct failure *f);

#endif
