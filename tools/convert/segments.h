/* SPDX-License-Identifier: MIT */
/* segments.h - the lines of an OBJ file as constant data for firmware: segments of smear_ribbon.h, as a C header. Host only. */
#ifndef SMEAR_TOOLS_CONVERT_SEGMENTS_H
#define SMEAR_TOOLS_CONVERT_SEGMENTS_H

#include "tools/failure.h"

#include <stddef.h>
#include <stdint.h>

/* Writes a header into memory; *out is malloc'ed. Places are times `scale`; `name` is a C identifier in lower case, `from` the file's
 * name. */
bool segments_to_header(const uint8_t *bytes, size_t size, double scale, const char *name, const char *from, uint8_t **out,
                        size_t *out_size, int *count, struct failure *f);

#endif
