/* SPDX-License-Identifier: MIT */
/* gallery.h - the folder of pictures: writes them one by one, each whole or not at all, and tells
 * what each shows. */
#ifndef SMEAR_TOOLS_DEMO_GALLERY_H
#define SMEAR_TOOLS_DEMO_GALLERY_H

#include "tools/failure.h"
#include "tools/image/image.h"

#include <stdbool.h>

struct gallery {
    const char *folder;
};

/* Makes the folder and those above it. `folder` must outlive the gallery. */
bool gallery_open(struct gallery *gallery, const char *folder, struct failure *f);

/* Writes the picture as FOLDER/NAME, a PNG. */
bool gallery_hang(const struct gallery *gallery, const char *name, const char *what,
                  const struct image *picture, struct failure *f);

/* Gives frame `index` of an animation; *out is allocated there, and empty on failure. */
typedef bool gallery_frame_fn(void *user, int index, struct image *out, struct failure *f);

/* Writes `count` frames, for ever repeated: a GIF or, when the name does not end so, an APNG. */
bool gallery_show(const struct gallery *gallery, const char *name, const char *what, double fps,
                  int count, gallery_frame_fn *frame, void *user, struct failure *f);

#endif
