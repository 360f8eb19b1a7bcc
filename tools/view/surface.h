/* SPDX-License-Identifier: MIT */
/* surface.h - pixels on their way to a screen, and how other machines lay them out. */
#ifndef SMEAR_TOOLS_VIEW_SURFACE_H
#define SMEAR_TOOLS_VIEW_SURFACE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* 0x00RRGGBB in this machine's byte order. */
struct surface {
    int width, height;
    size_t pitch;               /* pixels from row to row */
    uint32_t *pixel;
};

/* A pixel of 2, 3 or 4 bytes: `bits` of each of red, green and blue from `shift` on. */
struct layout {
    int bytes;
    int shift[3], bits[3];
    bool big_endian;
};

/* 0x00RRGGBB of this machine: rows may be copied as they are. */
bool layout_is_native(const struct layout *layout);

/* The masks of a visual or the fields of a framebuffer; false when there is no such layout. */
bool layout_from_masks(struct layout *layout, int bits_per_pixel, const uint32_t mask[3],
                       bool big_endian);

/* `count` pixels into count x layout->bytes bytes; each channel keeps its upper bits. */
void layout_pack(const struct layout *layout, uint8_t *out, const uint32_t *in, int count);

void surface_fill(const struct surface *s, int x, int y, int width, int height, uint32_t rgb);

#endif
