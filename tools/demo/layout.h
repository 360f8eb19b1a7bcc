/* SPDX-License-Identifier: MIT */
/* layout.h - pictures made of pictures. *out is allocated by each function, and empty on
 * failure. */
#ifndef SMEAR_TOOLS_DEMO_LAYOUT_H
#define SMEAR_TOOLS_DEMO_LAYOUT_H

#include "tools/failure.h"
#include "tools/image/image.h"

/* Side by side, with a white line of `gap` pixels between neighbours. All of one size. */
bool layout_row(const struct image *pictures, int count, int gap, struct image *out,
                struct failure *f);

/* One above the other, with a black line between. */
bool layout_column(const struct image *pictures, int count, int gap, struct image *out,
                   struct failure *f);

/* Every pixel a square of scale x scale. */
bool layout_zoom(const struct image *picture, int scale, struct image *out, struct failure *f);

/* The same as lamps behind dark glass: squares of scale - 1 in the colour 0xRRGGBB x grey, with
 * seams between them. */
bool layout_lamps(const struct image *picture, int scale, unsigned color, struct image *out,
                  struct failure *f);

#endif
