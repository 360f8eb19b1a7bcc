/* SPDX-License-Identifier: MIT */
/* screen.h - the screens that the game knows. */
#ifndef GAME_SCREEN_H
#define GAME_SCREEN_H

#include "platform/game/view.h"

struct screen {
    const char *name;
    smear_desc desc;                /* without callbacks */
    struct view_way way;
    uint8_t frames;                 /* of 1/30 s, by which a drawn frame goes on from the one before, at the board's rate */
};

/* The one of that name, or null. */
const struct screen *screen_find(const char *name);

#endif
