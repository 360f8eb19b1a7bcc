/* SPDX-License-Identifier: MIT */
/* picture.h - a frame as the display has it, as a picture of 8 bits per channel. */
#ifndef SMEAR_TOOLS_CLI_PICTURE_H
#define SMEAR_TOOLS_CLI_PICTURE_H

#include "../image/image.h"

#include <smear.h>
#include <stddef.h>
#include <stdint.h>

/* Every level v of n becomes the code nearest to 255 v / n. `stride` is in bytes, from row to row
 * or from page to page. `out` has its size already. */
void picture_expand(struct image *out, const uint8_t *pixels, size_t stride, smear_format format);

/* The same with codes / 255 as floats; three channels. */
bool picture_to_floats(const struct image *picture, struct float_image *out, struct failure *f);

/* Floats of 1 or 3 channels to codes, rounded to nearest and clamped; fails when not finite. */
bool picture_from_floats(const struct float_image *floats, struct image *out, struct failure *f);

#endif
