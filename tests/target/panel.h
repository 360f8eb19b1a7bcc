/* SPDX-License-Identifier: MIT */
/* panel.h - pixels as panels and emulators of them show them: the bits of a channel are repeated until there are eight. */
#pragma once

#include "smear.h"

#include <stdint.h>
#include <string.h>

/* The code of pixel x of a row in a display's format. */
static inline uint32_t panel_code(const uint8_t *row, int x, uint8_t format)
{
    uint32_t word;
    switch (format) {
    case SMEAR_L4:
        return row[x / 2] >> (x % 2 == 0 ? 4 : 0) & 15u;
    case SMEAR_RGB565_SWAPPED:
        return (uint32_t)row[2 * x] << 8 | row[2 * x + 1];
    case SMEAR_RGB565:
    case SMEAR_RGB555:
        return (uint32_t)row[2 * x + 1] << 8 | row[2 * x];
    default:                    /* XRGB8888 */
        memcpy(&word, row + 4 * x, sizeof word);
        return word;
    }
}

static inline uint32_t panel_widen(uint32_t code, int bits)
{
    return code << (8 - bits) | code >> (2 * bits - 8);
}

/* The colour that a display shows for a code, 0xRRGGBB. */
static inline uint32_t panel_color(uint32_t code, uint8_t format)
{
    switch (format) {
    case SMEAR_L4:
        return code * 0x111111u;
    case SMEAR_RGB565:
    case SMEAR_RGB565_SWAPPED:
        return panel_widen(code >> 11, 5) << 16 | panel_widen(code >> 5 & 63, 6) << 8 | panel_widen(code & 31, 5);
    case SMEAR_RGB555:
        return panel_widen(code & 31, 5) << 16 | panel_widen(code >> 5 & 31, 5) << 8 | panel_widen(code >> 10 & 31, 5);
    default:
        return code & 0xffffff;
    }
}
