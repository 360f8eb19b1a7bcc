/* SPDX-License-Identifier: MIT */
/* overlay.h - what is written over the picture: figures, the list of controls, messages. */
#ifndef SMEAR_TOOLS_VIEW_OVERLAY_H
#define SMEAR_TOOLS_VIEW_OVERLAY_H

#include "tools/view/view.h"

/* The lines for a place of `columns` x `rows` letters. */
void overlay_text(const struct view *view, int columns, int rows, struct text *out);

/* The pages that the list of controls takes there. */
int overlay_help_pages(int columns, int rows);

/* Draws the lines on a surface; letters are enlarged on large ones. */
void overlay_draw(const struct surface *s, const struct text *text);
/* How many letters a surface has room for. */
void overlay_room(const struct surface *s, int *columns, int *rows);

#endif
