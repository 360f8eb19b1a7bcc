/* SPDX-License-Identifier: MIT */
/* view.h - what a race looks like. */
#ifndef GAME_VIEW_H
#define GAME_VIEW_H

#include "platform/game/race.h"

/* Draws at most: the course, a gate, cars; and, where a desc has room for them, soft shadows of these. */
enum { VIEW_DRAWS = 2 + RACE_CARS, VIEW_SHADOWS = RACE_CARS };

/* How a frame is drawn, and what lies over it. */
struct view_way {
    uint8_t method;                 /* smear_method */
    uint8_t bare;                   /* 1: nothing lies over the picture */
    uint8_t waits;                  /* 1: for somebody to press start */
    uint8_t split;                  /* 1: its left half is shown sharp, its right half blurred */
    uint16_t rate;                  /* frames per second that are shown; 0: not known */
    uint16_t target, samples;       /* smear_frame */
    uint32_t budget;
};

void view_make(void);

/* Begins a frame of a context of this desc, so many frames of 1/30 s after the one before, 0: after a cut, and submits all that is
 * seen of it. Returns a smear_result. */
int view_submit(smear_context *ctx, const struct race *race, const smear_desc *desc, const struct view_way *way, uint32_t frames);

#endif
