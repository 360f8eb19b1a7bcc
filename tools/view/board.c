/* SPDX-License-Identifier: MIT */
/* board.c - see board.h.
 *
 * Boards for which there is firmware of the demo draw as that does (platform/demo_player.c): by `auto`, in codes, with the
 * same reach and tile, and with a display that keeps what it is sent. Arenas leave room for a program's own data, stacks and,
 * on the Game Boy Advance, sound. Bus clocks are those of the firmware or what the panels' controllers take in practice,
 * not their cautious data sheets; their refresh is by an oscillator of their own, never quite the 60 Hz it is meant to be. */
#include "tools/view/board.h"

#include <math.h>
#include <smear_config.h>
#include <string.h>

/* The page goes without the finer dither. */
#if SMEAR_WITH_DISPLAY
#define FINE_DITHER "blue"
#else
#define FINE_DITHER "ordered"
#endif

#define AS_FIRMWARE "--method", "auto", "--quality", "draft", "--light", "encoded", "--keep-display"

const struct board board_list[] = {
    { "oled", "128x64 OLED, SSD1306 on 8 MHz SPI, Cortex-M4 at 100 MHz, 128 kB of RAM",
      { "--size", "128x64", "--format", "l1pages", "--arena", "98304", AS_FIRMWARE, "--tile", "8", "--reach", "4",
        "--bus", "8000000", "--panel-hz", "105", "--cpu", "cortex-m4:100000000", "--tint", "05070a,cfe9ff", NULL } },
    { "rp2040", "240x240 IPS, ST7789 on 66.5 MHz SPI, Cortex-M0+ at 133 MHz, 264 kB of RAM",
      { "--size", "240x240", "--format", "rgb565be", "--arena", "204800", AS_FIRMWARE, "--tile", "16", "--reach", "12",
        "--bus", "66500000", "--panel-hz", "58.6", "--cpu", "cortex-m0plus:133000000", NULL } },
    { "round", "240x240 round IPS, GC9A01 on 66.5 MHz SPI, otherwise as rp2040",
      { "--size", "240x240", "--format", "rgb565be", "--arena", "204800", AS_FIRMWARE, "--tile", "16", "--reach", "12",
        "--bus", "66500000", "--panel-hz", "58.6", "--cpu", "cortex-m0plus:133000000", "--round", NULL } },
    { "tufty", "320x240 IPS, ST7789 behind eight wires at 15 MHz, otherwise as rp2040",
      { "--size", "320x240", "--format", "rgb565be", "--arena", "212992", AS_FIRMWARE, "--tile", "16", "--reach", "12",
        "--bus", "120000000", "--panel-hz", "58.6", "--cpu", "cortex-m0plus:133000000", NULL } },
    { "lcd144", "128x128 LCD, ST7735S on 16.6 MHz SPI, otherwise as rp2040",
      { "--size", "128x128", "--format", "rgb565be", "--arena", "204800", AS_FIRMWARE, "--tile", "16", "--reach", "6",
        "--bus", "16625000", "--panel-hz", "61", "--cpu", "cortex-m0plus:133000000", NULL } },
    { "esp32s3", "240x240 IPS, ST7789 on 40 MHz SPI, Xtensa at 240 MHz, one core, 512 kB of RAM",
      { "--size", "240x240", "--format", "rgb565be", "--arena", "262144", AS_FIRMWARE, "--tile", "16", "--reach", "12",
        "--bus", "40000000", "--panel-hz", "58.6", "--cpu", "xtensa:240000000", NULL } },
    { "esp32c6", "240x240 IPS, ST7789 on 40 MHz SPI, RISC-V at 160 MHz, 512 kB of RAM",
      { "--size", "240x240", "--format", "rgb565be", "--arena", "262144", AS_FIRMWARE, "--tile", "16", "--reach", "12",
        "--bus", "40000000", "--panel-hz", "58.6", "--cpu", "rv32imc:160000000", NULL } },
    { "gba", "Game Boy Advance: 240x160 in mode 3, ARM7TDMI at 16.78 MHz, 256 kB of work RAM",
      { "--size", "240x160", "--format", "rgb555", "--arena", "229376", AS_FIRMWARE, "--tile", "16", "--reach", "8",
        "--cpu", "arm7tdmi:16777216", NULL } },
    { "pizero", "Raspberry Pi Zero on HDMI: 640x480, RGB565, 16 MB for the context",
      { "--size", "640x480", "--format", "rgb565", "--arena", "16777216", AS_FIRMWARE, "--tile", "32", "--reach", "24", NULL } },
    { "memlcd", "400x240 1-bit reflective memory display at 50 Hz, Cortex-M7 at 168 MHz, 1 MB",
      { "--size", "400x240", "--format", "l1", "--dither", FINE_DITHER, "--arena", "1048576", "--bus",
        "6000000", "--cpu", "cortex-m7:168000000", "--tint", "322f29,b1aea7", NULL } },
    { "fb320", "320x240 framebuffer of a small Linux machine, RGB565, 2 MB for the context",
      { "--size", "320x240", "--format", "rgb565", "--arena", "2097152", NULL } },
    { NULL, NULL, { NULL } },
};

const char *board_option(const struct board *board, const char *option)
{
    for (int i = 0; board->option[i] != NULL; i++)
        if (strcmp(board->option[i], option) == 0)
            return board->option[i + 1];
    return NULL;
}

const struct board *board_find(const char *name)
{
    for (const struct board *b = board_list; b->name != NULL; b++)
        if (strcmp(b->name, name) == 0)
            return b;
    return NULL;
}

/* ------------------------------------------------------------------ the bus */

/* Row r is written at start + write r / H and read at scan + refresh r / H. It shows the new frame when it is read after it was written;
 * both are straight lines, so they cross once. */

double bus_wire_us(const struct bus *bus, size_t bytes)
{
    return bus->hz > 0.0 ? (double)bytes * 8.0e6 / bus->hz : 0.0;
}

int bus_tear(const struct bus *bus, long index, double frame_us, double write_us, int height,
             bool *old_above)
{
    *old_above = false;
    if (bus->synced || !(bus->hz > 0.0) || !(bus->panel_hz > 0.0) || !(write_us > 0.0))
        return height;
    double refresh = 1e6 / bus->panel_hz, start = (double)index * frame_us, row;
    if (write_us > refresh) {
        /* slow: the first refresh that begins when half is written overtakes the writer */
        double scan = ceil((start + write_us / 2.0) / refresh) * refresh;
        row = (scan - start) / (write_us - refresh) * height;
    } else {
        /* fast: the refresh that is going on when writing starts is overtaken by the writer */
        double scan = floor(start / refresh) * refresh;
        row = write_us < refresh ? (start - scan) / (refresh - write_us) * height : height;
        *old_above = row < height;
    }
    return row < 0.0 ? 0 : row > height ? height : (int)row;
}
