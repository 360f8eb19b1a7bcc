/* SPDX-License-Identifier: MIT */
/* font.h - printable ASCII in cells of 6 x 9 pixels, enlarged by whole numbers. */
#ifndef SMEAR_TOOLS_VIEW_FONT_H
#define SMEAR_TOOLS_VIEW_FONT_H

#include "tools/view/surface.h"

enum { FONT_WIDTH = 6, FONT_HEIGHT = 9 };

/* White on a darkened background, from (x, y) on; what leaves the surface is cut off. */
void font_draw(const struct surface *s, int x, int y, int zoom, const char *text);

#endif
