/* SPDX-License-Identifier: MIT */
/* lap.h - a race as it was driven: keys held, and for how many frames. */
#ifndef GAME_LAP_H
#define GAME_LAP_H

#include <stdint.h>

struct lap_keys {
    uint8_t keys, frames;           /* display_key */
};

extern const struct lap_keys lap_keys[];
extern const int lap_keys_count;

#endif
