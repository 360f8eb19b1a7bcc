/* SPDX-License-Identifier: MIT */
/* A stand-in for LovyanGFX's header: what the example calls of it. */
#include "panel.h"

namespace lgfx {
struct swap565_t { uint8_t high, low; };
}

struct LGFX {
    bool init() { return true; }
    void startWrite() { writing = true; }
    bool dmaBusy() { return panel_queued > 0; }
    void waitDMA()
    {
        while (panel_queued > 0)
            panel_send_first();
    }
    void pushImageDMA(int32_t x, int32_t y, int32_t w, int32_t h, const lgfx::swap565_t *data)
    {
        waitDMA();
        if (writing)
            panel_queue_band(x, y, w, h, data);
    }

    bool writing = false;
};
