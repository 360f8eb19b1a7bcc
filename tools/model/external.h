/* SPDX-License-Identifier: MIT */
/* external.h - what a model brings along: files beside it, and pictures.
 *
 * A name in a model is a relative path with '/' between its parts. Names that leave for other
 * places on their own (absolute paths, drives, URLs) are refused; .. is allowed. */
#ifndef SMEAR_TOOLS_EXTERNAL_H
#define SMEAR_TOOLS_EXTERNAL_H

#include "tools/failure.h"
#include "tools/image/image.h"

#include <stddef.h>
#include <stdint.h>

/* No model, buffer or picture file may be larger; nor all arrays of a model together. */
#define MODEL_MAX_BYTES ((size_t)1 << 30)

/* Reads folder/name. `folder` null: fails, as there is no place to look. */
bool external_read(const char *folder, const char *name, uint8_t **bytes, size_t *size,
                   struct failure *f);

/* Decodes a PNG; any other format fails by its own name ("a JPEG picture; ..."). */
bool picture_decode(const uint8_t *bytes, size_t size, struct image *out, struct failure *f);

#endif
