/* SPDX-License-Identifier: MIT */
/* A stand-in for Arduino_GFX's header: what the example calls of it. */
#include "panel.h"

struct Arduino_DataBus {};
static inline Arduino_DataBus *create_default_Arduino_DataBus() { return new Arduino_DataBus; }

struct Arduino_GFX {
    bool begin() { return begun = true; }
    void draw16bitBeRGBBitmap(int16_t x, int16_t y, uint16_t *bitmap, int16_t w, int16_t h)
    {
        panel_window(x, y, w, h);
        if (begun)
            panel_bytes(bitmap, 2u * (size_t)w * (size_t)h);
    }

    bool begun = false;
};

struct Arduino_ST7789 : Arduino_GFX {
    Arduino_ST7789(Arduino_DataBus *, int8_t, uint8_t, bool, int16_t, int16_t) {}
};
