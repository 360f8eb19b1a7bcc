/* SPDX-License-Identifier: MIT */
/* board.c - see board.h.
 *
 * Boards with little memory begin with `reconstruct`: the time-resolved methods want more of it.
 * Arenas leave room for a program's own data, stack and, on the Game Boy Advance, sound. Bus
 * clocks are what the panels' controllers take in practice, not their cautious data sheets;
 * their refresh is by an oscillator of their own, never quite the 60 Hz it is meant to be. */
#include "tools/view/board.h"

#include <string.h>

const struct board board_list[] = {
    { "oled", "128x64 OLED, SSD1306 on 8 MHz SPI, Cortex-M4 at 100 MHz, 128 kB of RAM",
      { "--size", "128x64", "--format", "l1pages", "--arena", "98304", "--method", "reconstruct",
        "--bus", "8000000", "--panel-hz", "105", "--cpu", "cortex-m4:100000000", "--tint",
        "05070a,cfe9ff", NULL } },
    { "rp2040", "240x240 IPS, ST7789 on 62.5 MHz SPI, Cortex-M0+ at 133 MHz, 264 kB of RAM",
      { "--size", "240x240", "--format", "rgb565be", "--arena", "229376", "--method",
        "reconstruct", "--bus", "62500000", "--panel-hz", "58.6", "--cpu",
        "cortex-m0plus:133000000", NULL } },
    { "round", "240x240 round IPS, GC9A01 on 62.5 MHz SPI, otherwise as rp2040",
      { "--size", "240x240", "--format", "rgb565be", "--arena", "229376", "--method",
        "reconstruct", "--bus", "62500000", "--panel-hz", "58.6", "--cpu",
        "cortex-m0plus:133000000", "--round", NULL } },
    { "gba", "Game Boy Advance: 240x160 in mode 3, ARM7TDMI at 16.78 MHz, 256 kB of work RAM",
      { "--size", "240x160", "--format", "rgb555", "--arena", "229376", "--method", "reconstruct",
        "--cpu", "arm7tdmi:16777216", NULL } },
    { "memlcd", "400x240 1-bit reflective memory display at 50 Hz, Cortex-M7 at 168 MHz, 1 MB",
      { "--size", "400x240", "--format", "l1", "--dither", "blue", "--arena", "1048576", "--bus",
        "6000000", "--cpu", "cortex-m7:168000000", "--tint", "322f29,b1aea7", NULL } },
    { "fb320", "320x240 framebuffer of a small Linux machine, RGB565, 2 MB for the context",
      { "--size", "320x240", "--format", "rgb565", "--arena", "2097152", NULL } },
    { NULL, NULL, { NULL } },
};

const struct board *board_find(const char *name)
{
    for (const struct board *b = board_list; b->name != NULL; b++)
        if (strcmp(b->name, name) == 0)
            return b;
    return NULL;
}
