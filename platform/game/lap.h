/* SPDX-License-Identifier: MIT */
/* lap.h - a race as it was driven: keys held, and for how many frames. */
#ifndef GAME_LAP_H
#define GAME_LAP_H

#include <stdint.h>

/* How far it has been played: its next keys, and frames that the last ones are still held. */
struct lap {
    int event, left;
};

/* Returns what is held in the next frame, display_key; 0 when it is over. */
unsigned lap_held(struct lap *lap);

#endif
