/* SPDX-License-Identifier: MIT */
/* board.h - devices that `--board` stands for: nothing but options of the command line. */
#ifndef SMEAR_TOOLS_VIEW_BOARD_H
#define SMEAR_TOOLS_VIEW_BOARD_H

enum { BOARD_MAX_OPTIONS = 32 };

struct board {
    const char *name, *what;
    const char *option[BOARD_MAX_OPTIONS];      /* null ends them */
};

extern const struct board board_list[];         /* name null ends it */

/* Null when there is none of this name. */
const struct board *board_find(const char *name);

/* The value that a board gives an option; null when it gives none. All have a --size and an --arena. */
const char *board_option(const struct board *board, const char *option);

#endif
