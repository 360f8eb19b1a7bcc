/* SPDX-License-Identifier: MIT */
/* inflate.h - decompression of deflate (RFC 1951) and zlib (RFC 1950) data in memory. */
#ifndef SMEAR_TOOLS_IMAGE_INFLATE_H
#define SMEAR_TOOLS_IMAGE_INFLATE_H

#include "tools/failure.h"
#include "tools/image/buffer.h"

#include <stddef.h>
#include <stdint.h>

/* The most that deflate can expand: 258 bytes from 2 bits of a block, rounded up. A header that
 * promises more than this times the compressed size lies. */
enum { INFLATE_MAX_RATIO = 1032 };

/* One deflate stream from the start of `in` to at most `capacity` bytes at `out`. A stream that
 * would give more fails. *produced and *consumed (may be null) count bytes; data after the stream
 * is left alone. */
bool inflate_raw(const uint8_t *in, size_t in_size, uint8_t *out, size_t capacity, size_t *produced,
                 size_t *consumed, struct failure *f);

/* The same inside zlib's two-byte header and Adler-32 checksum, both checked. */
bool inflate_zlib(const uint8_t *in, size_t in_size, uint8_t *out, size_t capacity,
                  size_t *produced, size_t *consumed, struct failure *f);

/* Checksum of a zlib stream; start with 1. */
uint32_t adler32_update(uint32_t adler, const uint8_t *bytes, size_t size);

/* ------------------------------------------------------------------ the other way */

/* Compression to zlib (RFC 1950) data in memory. */

/* Appends a zlib stream of the `size` bytes (below 2^32) to `out`; false without memory. */
bool deflate_zlib(const uint8_t *bytes, size_t size, struct buffer *out);

#endif
