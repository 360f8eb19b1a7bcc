/* SPDX-License-Identifier: MIT */
/* deflate.h - compression to zlib (RFC 1950) data in memory. */
#ifndef SMEAR_TOOLS_IMAGE_DEFLATE_H
#define SMEAR_TOOLS_IMAGE_DEFLATE_H

#include "tools/image/buffer.h"

/* Appends a zlib stream of the `size` bytes (below 2^32) to `out`; false without memory. */
bool deflate_zlib(const uint8_t *bytes, size_t size, struct buffer *out);

#endif
