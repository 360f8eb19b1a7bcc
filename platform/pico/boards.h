/* SPDX-License-Identifier: MIT */
/* boards.h - boards that the demo knows. `make TARGET=pico BOARD=picosystem demo-firmware` takes a row; a board of one's
 * own is one more row.
 *
 *   name       BOARD=
 *   chip       RP2040, or RP2350 (TARGET=pico2; by version 2 of the SDK TARGET=pico)
 *   glass      width, height as they are looked at; x, y of their first pixel in the controller's memory
 *   madctl     the controller's register 36h: rotation, mirroring, order of red and blue
 *   inverted   1 on glass that wants command 21h, as IPS panels do
 *   bus        0 or 1: that SPI; 8: eight wires in parallel, by PIO
 *   clk data   SCK and MOSI, or WR and the lowest of D0 to D7; then RD of a parallel bus
 *   cs ... light   chip select, data/command, reset, backlight
 *   bus kHz    at most; the clock of the chip in kHz
 *   keys       up, down, left, right, A, start, and the level of a key that is pressed
 *   led        toggles with every frame
 *   te         the panel's tearing-effect line: frames wait for its scan, and begin behind it
 *   sound      a speaker, heard by firmware of the pico-sdk
 *
 * NO: there is none. Pins are GP numbers. */
#ifndef NO
#define NO 255
#endif

/* name, chip, width, height, x, y, madctl, inverted, bus, clk, data, rd, cs, dc, reset, light, bus kHz, kHz, up, down, left,
 * right, A, start, level, led, te, sound */
/* A Pico with the usual breakout of 240x240 pixels, an ST7789, and keys to ground. Run in the emulator. */
BOARD(breakout,       RP2040, 240, 240, 0, 0, 0x00, 1, 0, 18, 19, NO, 17, 16, NO, 20, 66500, 133000, NO, NO, 13, 14, 12, 15, 0, 25, NO, NO)
/* Waveshare Pico-LCD-1.3: 240x240, ST7789. Run in the emulator. */
BOARD(lcd_1_3,        RP2040, 240, 240, 0, 0, 0x70, 1, 1, 10, 11, NO,  9,  8, 12, 13, 66500, 133000,  2, 18, 16, 20, 15, 17, 0, 25, NO, NO)
/* Waveshare Pico-LCD-1.44: 128x128, ST7735S. Run in the emulator. */
BOARD(lcd_1_44,       RP2040, 128, 128, 1, 2, 0x70, 0, 1, 10, 11, NO,  9,  8, 12, 13, 16625, 133000, NO, NO, 17,  2, 15,  3, 0, 25, NO, NO)
/* Pimoroni PicoSystem: 240x240, ST7789. Run in the emulator. */
BOARD(picosystem,     RP2040, 240, 240, 0, 0, 0x04, 1, 0,  6,  7, NO,  5,  9,  4, 12, 66500, 133000, 23, 20, 22, 21, 18, 16, 0, 13, NO, 11)
/* The same, tear-free: it waits for the panel. Run in the emulator. */
BOARD(picosystem_te,  RP2040, 240, 240, 0, 0, 0x04, 1, 0,  6,  7, NO,  5,  9,  4, 12, 66500, 133000, 23, 20, 22, 21, 18, 16, 0, 13,  8, 11)
/* Pimoroni Pico Display Pack 2.0: 320x240, ST7789. Run in the emulator. */
BOARD(display_pack_2, RP2040, 320, 240, 0, 0, 0x70, 1, 0, 18, 19, NO, 17, 16, NO, 20, 66500, 133000, NO, NO, 13, 14, 12, 15, 0, 25, NO, NO)
/* Pimoroni Tufty 2040: 320x240, ST7789 behind eight wires. Run in the emulator. */
BOARD(tufty,          RP2040, 320, 240, 0, 0, 0xb0, 1, 8, 12, 14, 13, 10, 11, NO,  2, 15000, 133000, 22,  6,  7,  9,  8, NO, 1, 25, NO, NO)
/* A Pico 2 with the usual breakout. Run in QEMU. */
BOARD(pico2_breakout, RP2350, 240, 240, 0, 0, 0x00, 1, 0, 18, 19, NO, 17, 16, NO, 20, 75000, 150000, NO, NO, 13, 14, 12, 15, 0, 25, NO, NO)
/* Thumby Color: 128x128, GC9107. Run in QEMU. */
BOARD(thumby_color,   RP2350, 128, 128, 0, 0, 0x00, 0, 0, 18, 19, NO, 17, 16,  4,  7, 75000, 150000,  1,  3,  0,  2, 21, 26, 0, 10, NO, NO)
