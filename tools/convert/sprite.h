/* SPDX-License-Identifier: MIT */
/* sprite.h - a picture as constant data for firmware: an image or a font of smear_overlay.h, as a C header. Host only. */
#ifndef SMEAR_TOOLS_CONVERT_SPRITE_H
#define SMEAR_TOOLS_CONVERT_SPRITE_H

#include "tools/image/image.h"

struct sprite_options {
    int cell_width, cell_height;        /* the picture is cut into cells, row by row; 0: it is one */
    bool mask;                          /* how much of a colour that firmware names: the alpha, or the brightness of a
                                         * picture that is opaque */
    bool font;                          /* a mask whose cells are letters */
    int first;                          /* character of the first */
    bool has_key;
    uint32_t key;                       /* 0xRRGGBB: pixels of this colour are holes */
};

struct sprite_report {
    int width, height, cells;           /* of a cell, and how many */
    const char *format;
    size_t bytes;                       /* of pixels and palette */
};

/* Writes a header into memory; *bytes is malloc'ed. `name` is a C identifier in lower case, `from` the file's name. */
bool sprite_to_header(const struct image *image, const struct sprite_options *options, const char *name, const char *from,
                      uint8_t **bytes, size_t *size, struct sprite_report *report, struct failure *f);

#endif
