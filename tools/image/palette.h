/* SPDX-License-Identifier: MIT */
/* palette.h - up to 256 colours for a picture, and a picture in up to 256 colours. */
#ifndef SMEAR_TOOLS_IMAGE_PALETTE_H
#define SMEAR_TOOLS_IMAGE_PALETTE_H

#include "tools/image/image.h"

/* Colours are 0xAARRGGBB; their channels are alpha, red, green, blue. */
static inline uint32_t color_of(const uint8_t rgba[4])
{
    return (uint32_t)rgba[3] << 24 | (uint32_t)rgba[0] << 16 | (uint32_t)rgba[1] << 8 | rgba[2];
}

int color_channel(uint32_t argb, int k);

/* Finds `limit` (2..256) colours that serve so many others well, or those themselves where they are as few; sorted. Of more than
 * `distinct` ones low bits count alike; `refinements` are rounds of k-means at most. Returns how many; 0 without memory. What is given is
 * sorted, too. */
int palette_of(uint32_t *argb, size_t count, int limit, int distinct, int refinements, uint32_t palette[256]);

/* The entry nearest to a colour. */
int palette_nearest(uint32_t argb, const uint32_t *palette, int count);

struct palette {
    int count;                  /* 0..256 */
    uint8_t rgb[256][3];
};

/* A picture of which only the pixels with a non-zero mark count. */
struct marked_image {
    const struct image *image;
    const uint8_t *mark;        /* width x height; null: all count (palette_exact only) */
};

/* The colours of the marked pixels, when there are at most `limit` (1..256); else false. */
bool palette_exact(const struct marked_image *from, int limit, struct palette *out);

/* `limit` (2..256) colours that serve the marked pixels well. The same pixels always get the same
 * palette. False without memory. */
bool palette_choose(const struct marked_image *from, int limit, struct palette *out);

/* The entry for every marked pixel: its own colour where the palette has it, else one of the two
 * whose mixture comes nearest, chosen by an 8 x 8 pattern that is fixed to the picture, so that
 * what stands still keeps its dots. Writes index[y * width + x]. False without memory. */
bool palette_map(const struct marked_image *from, const struct palette *palette, uint8_t *index);

#endif
