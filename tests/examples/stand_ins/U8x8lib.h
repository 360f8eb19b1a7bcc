/* SPDX-License-Identifier: MIT */
/* A stand-in for U8x8's header: what the example calls of it. */
#include "panel.h"

#define U8X8_PIN_NONE 255

struct U8X8_SSD1306_128X64_NONAME_HW_I2C {
    explicit U8X8_SSD1306_128X64_NONAME_HW_I2C(uint8_t) {}
    bool begin() { return true; }
    void drawTile(uint8_t x, uint8_t y, uint8_t count, uint8_t *tiles)
    {
        memcpy(panel_memory + y * PANEL_WIDTH + 8 * x, tiles, 8u * count);
    }
};
