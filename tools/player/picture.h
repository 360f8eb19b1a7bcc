/* SPDX-License-Identifier: MIT */
/* picture.h - a frame as the display has it, as a picture of 8 bits per channel. */
#ifndef SMEAR_TOOLS_CLI_PICTURE_H
#define SMEAR_TOOLS_CLI_PICTURE_H

#include "tools/image/image.h"

#include <smear.h>
#include <stddef.h>
#include <stdint.h>

/* Bytes of a row of pixels; of a page of eight rows for SMEAR_L1_PAGES. */
size_t picture_row_bytes(int width, smear_format format);

/* Puts a band where it belongs in a frame whose rows, or pages, are `stride` bytes. */
void picture_put_band(uint8_t *pixels, size_t stride, smear_format format, const smear_band *band);

/* What smear_stats.crc32 is of a frame that is sent whole. */
uint32_t picture_crc(const uint8_t *pixels, size_t size, smear_format format);

/* Every level v of n becomes the code nearest to 255 v / n. `stride` is in bytes, from row to row
 * or from page to page. `out` has its size already. */
void picture_expand(struct image *out, const uint8_t *pixels, size_t stride, smear_format format);

/* The same with codes / 255 as floats; three channels. */
bool picture_to_floats(const struct image *picture, struct float_image *out, struct failure *f);

/* Floats of 1 or 3 channels to codes, rounded to nearest and clamped; fails when not finite. */
bool picture_from_floats(const struct float_image *floats, struct image *out, struct failure *f);

#endif
