/* SPDX-License-Identifier: MIT */
/* A stand-in for ILI9341_T4's header and what Teensy's core brings: what the example calls of them. Pixels are in the order of
 * the machine, which is that of the panel here. */
#include "panel.h"

#define DMAMEM

namespace ILI9341_T4 {

struct DiffBuff {};
template <int SIZE> struct DiffBuffStatic : DiffBuff { char room[SIZE]; };

struct ILI9341Driver {
    ILI9341Driver(uint8_t, uint8_t, uint8_t, uint8_t, uint8_t, uint8_t = 255, uint8_t = 255, uint8_t = 255) {}
    bool begin(int spi_clock = 30000000, int = 4000000) { return spi_clock > 0; }
    void setFramebuffer(uint16_t *internal) { buffer = internal; }
    void setDiffBuffers(DiffBuff *first, DiffBuff *second) { differs = first != nullptr && second != nullptr && first != second; }
    void setRefreshRate(float) {}
    void setVSyncSpacing(int) {}
    /* Likewise copies the frame, which may be drawn over at once. */
    void update(const uint16_t *frame, bool = false)
    {
        if (buffer == nullptr || !differs)
            return;
        memcpy(buffer, frame, 2u * PANEL_WIDTH * PANEL_HEIGHT);
        panel_window(0, 0, PANEL_WIDTH, PANEL_HEIGHT);
        panel_bytes(buffer, 2u * PANEL_WIDTH * PANEL_HEIGHT);
    }

    uint16_t *buffer = nullptr;
    bool differs = false;
};

}
