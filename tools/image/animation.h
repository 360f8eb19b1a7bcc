/* SPDX-License-Identifier: MIT */
/* animation.h - what the writers of animations share; users see only the opaque type in image.h. */
#ifndef SMEAR_TOOLS_IMAGE_ANIMATION_H
#define SMEAR_TOOLS_IMAGE_ANIMATION_H

#include "tools/image/file.h"
#include "tools/image/image.h"
#include "tools/image/png.h"

struct animation_writer;

struct animation_format {
    size_t size;                /* of the format's writer, whose first member is the common part */
    bool (*begin)(struct animation_writer *w, struct failure *f);      /* with the file open */
    bool (*add)(struct animation_writer *w, const struct image *frame, int delay_ms,
                struct failure *f);
    bool (*end)(struct animation_writer *w, struct failure *f);        /* writes the file's tail */
    void (*release)(struct animation_writer *w);        /* frees what the format has allocated */
};

/* The common part; formats add their own state behind it. */
struct animation_writer {
    const struct animation_format *format;
    struct output out;
    int width, height;
    uint32_t frames;            /* added so far */
    bool broken;                /* a frame has failed; only cancelling is left */
    struct buffer bytes;        /* put together here, then written */
};

/* A writer of a format, zeroed, with its file open; or null. */
struct animation_writer *animation_begin(const struct animation_format *format, const char *path,
                                         int width, int height, struct failure *f);

/* Writes and empties w->bytes. */
bool animation_flush(struct animation_writer *w, struct failure *f);


#endif
