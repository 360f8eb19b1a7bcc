/* SPDX-License-Identifier: MIT */
/* A stand-in for TFT_eSPI's header: what the example calls of it. */
#include "panel.h"

struct TFT_eSPI {
    void init(uint8_t = 0) {}
    void setSwapBytes(bool swap) { swaps = swap; }
    void startWrite() { writing = true; }
    void endWrite() { writing = false; }
    void setAddrWindow(int32_t x, int32_t y, int32_t w, int32_t h) { panel_window(x, y, w, h); }
    void pushPixels(const void *data, uint32_t len)
    {
        if (writing && !swaps)
            panel_bytes(data, 2 * len);
    }

    bool swaps = false, writing = false;
};
