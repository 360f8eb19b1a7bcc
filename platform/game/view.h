/* SPDX-License-Identifier: MIT */
/* view.h - what a race looks like. */
#ifndef GAME_VIEW_H
#define GAME_VIEW_H

#include "platform/game/race.h"

/* Draws at most: chunks, a gate, cars. */
enum { VIEW_CHUNKS = 4, VIEW_DRAWS = VIEW_CHUNKS + 1 + RACE_CARS };

void view_make(void);

/* Begins a frame of a context of this desc and submits all that is seen of it: a sketch where there is room for it. Returns a
 * smear_result. */
int view_submit(smear_context *ctx, const struct race *race, const smear_desc *desc);

#endif
