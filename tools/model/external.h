/* SPDX-License-Identifier: MIT */
/* external.h - what a model brings along: files beside it, and pictures.
 *
 * A name in a model is a relative path with '/' between its parts, written by whoever made the model. Absolute paths,
 * drives and URLs are refused, and so is whatever is no regular file or lies outside of the model's folder, by .. or by
 * a link, unless the user lets the model's files lie anywhere. */
#ifndef SMEAR_TOOLS_EXTERNAL_H
#define SMEAR_TOOLS_EXTERNAL_H

#include "tools/failure.h"
#include "tools/image/image.h"

#include <stddef.h>
#include <stdint.h>

/* Neither the model's file nor all it brings along together may be larger; nor all its arrays and pictures in memory. */
#define MODEL_MAX_BYTES ((size_t)256 << 20)
enum { MODEL_MAX_FILES = 4096 };

/* Where a model's files are looked up, and what has been read of them. */
struct external {
    const char *folder;         /* ending with a slash, or "": the current one; null: nothing can be looked up */
    bool anywhere;
    size_t bytes;
    int files;                  /* that were looked for */
};

bool external_read(struct external *e, const char *name, uint8_t **bytes, size_t *size, struct failure *f);

/* Decodes a PNG or JPEG; any other format fails by its own name ("a WebP picture; ..."). */
bool picture_decode(const uint8_t *bytes, size_t size, struct image *out, struct failure *f);

#endif
