/* SPDX-License-Identifier: MIT */
/* panel.h - what the lessons show their frames on, in two functions. On a board these are its display's driver: platform/examples
 * has them for fifteen libraries. Here panel.c prints the last frame as a PPM, and panel_cost.c counts instructions. */
#ifndef LESSONS_PANEL_H
#define LESSONS_PANEL_H

#include <smear.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { PANEL_WIDTH = 240, PANEL_HEIGHT = 240, PANEL_FRAMES = 30 };

/* smear_desc.flush: sends finished rows, top to bottom, which are of SMEAR_RGB565_SWAPPED. */
int panel_flush(void *user, const smear_band *band);

/* Waits until it is time for frame `number`. 0: there is none; a board's never ends. */
int panel_next(int number);

#ifdef __cplusplus
}
#endif

#endif
