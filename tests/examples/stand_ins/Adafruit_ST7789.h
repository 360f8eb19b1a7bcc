/* SPDX-License-Identifier: MIT */
/* A stand-in for the header of Adafruit's ST7789: what the example calls of it. */
#include "panel.h"

struct Adafruit_ST7789 {
    Adafruit_ST7789(int8_t, int8_t, int8_t) {}
    void init(uint16_t, uint16_t, uint8_t = 0) {}
    void startWrite() { writing = true; }
    void endWrite() { writing = false; }
    void setAddrWindow(uint16_t x, uint16_t y, uint16_t w, uint16_t h) { panel_window(x, y, w, h); }
    void writePixels(uint16_t *colors, uint32_t len, bool block = true, bool bigEndian = false)
    {
        if (writing && block && bigEndian)
            panel_bytes(colors, 2 * len);
    }

    bool writing = false;
};
