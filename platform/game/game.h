/* SPDX-License-Identifier: MIT */
/* game.h - the game a turn at a time, for machines on which somebody else has the loop. */
#ifndef GAME_GAME_H
#define GAME_GAME_H

/* Opens the display for the screen of that name, null: the one it was built for. Returns 0, or 1 after saying why not. */
int game_open(const char *screen);

/* The race goes on to where the display's time is, by the keys that are held, and is drawn and shown; where no frame of it is due
 * yet it waits a moment, as display_wait does. Returns a smear_result. */
int game_turn(void);

#endif
