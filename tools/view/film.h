/* SPDX-License-Identifier: MIT */
/* film.h - what leaves the viewer as a file, and the comparison with the truth. The user is told
 * what was written, or why it was not. */
#ifndef SMEAR_TOOLS_VIEW_FILM_H
#define SMEAR_TOOLS_VIEW_FILM_H

#include "tools/view/view.h"

/* The main lane's frame, as `render` writes it, in SCENE-0000.png: the first number that is
 * free. */
void film_screenshot(struct view *view);

/* Distance of the main lane's frame from the mean of many exact instants. */
void film_measure(struct view *view);

/* The main lane's last frame as a picture. */
bool film_picture(const struct view *view, struct image *out, struct failure *f);

#endif
