/* SPDX-License-Identifier: MIT */
/* board.h - the row of boards.h that SMEAR_BOARD names, as constants: BOARD_WIDTH, BOARD_CS ...; NO_PIN is none. */
#ifndef SMEAR_PICO_BOARD_H
#define SMEAR_PICO_BOARD_H

#include <stdbool.h>
#include <stdint.h>

enum { NO_PIN = 255, CHIP_RP2040 = 2040, CHIP_RP2350 = 2350, BUS_PARALLEL = 8 };

#define BOARD(name, chip, width, height, x, y, madctl, inverted, bus, clk, data, rd, cs, dc, reset, light, bus_khz, khz, up, \
              down, left, right, a, start, level, led, te, sound)                                                        \
    enum {                                                                                                               \
        name##_CHIP = CHIP_##chip, name##_WIDTH = width, name##_HEIGHT = height, name##_X = x, name##_Y = y,             \
        name##_MADCTL = madctl, name##_INVERTED = inverted, name##_BUS = bus, name##_CLK = clk, name##_DATA = data,      \
        name##_RD = rd, name##_CS = cs, name##_DC = dc, name##_RESET = reset, name##_LIGHT = light,                      \
        name##_BUS_KHZ = bus_khz, name##_CLOCK_KHZ = khz, name##_UP = up, name##_DOWN = down, name##_LEFT = left,              \
        name##_RIGHT = right, name##_A = a, name##_START = start, name##_LEVEL = level, name##_LED = led,                \
        name##_TE = te, name##_SOUND = sound                                                                             \
    };
#include "boards.h"
#undef BOARD

#define BOARD_PASTE(name, what) name##_##what
#define BOARD_OF(name, what) BOARD_PASTE(name, what)
#define BOARD(what) ((int)BOARD_OF(SMEAR_BOARD, what))

#if defined PICO_RP2350 && PICO_RP2350
_Static_assert(BOARD(CHIP) == CHIP_RP2350, "boards.h: this board has an RP2040; the SDK compiles for an RP2350 (PICO_PLATFORM)");
#else
_Static_assert(BOARD(CHIP) == CHIP_RP2040, "boards.h: this board has an RP2350; it needs version 2 of the SDK and PICO_PLATFORM=rp2350");
#endif

/* On every eight pins the functions of the SPIs are the same: MOSI of SPI0 lies on 3 and 7 of the first 16 ... */
#define BOARD_IS_SPI(pin, which, of_four) ((pin) % 4 == (of_four) && (pin) / 8 % 2 == (which))
_Static_assert(BOARD(BUS) == BUS_PARALLEL || BOARD_IS_SPI(BOARD(CLK), BOARD(BUS), 2),
               "boards.h: the clock's pin is no SCK of this SPI: GP2, 6, 18, 22 of SPI 0; GP10, 14, 26 of SPI 1");
_Static_assert(BOARD(BUS) == BUS_PARALLEL || BOARD_IS_SPI(BOARD(DATA), BOARD(BUS), 3),
               "boards.h: the data pin is no MOSI (TX) of this SPI: GP3, 7, 19, 23 of SPI 0; GP11, 15, 27 of SPI 1");
_Static_assert(BOARD(BUS) != BUS_PARALLEL || BOARD(DATA) <= 22, "boards.h: D0 to D7 of a parallel bus are eight pins in a row");
_Static_assert(BOARD(CS) < 30 && BOARD(DC) < 30, "boards.h: a panel needs pins for chip select and data/command");

/* That draw: 2, or 1. */
int board_cores(void);

/* Core 1's entry; its stack is board.c's. */
void board_start_core1(void (*entry)(void));

#endif
