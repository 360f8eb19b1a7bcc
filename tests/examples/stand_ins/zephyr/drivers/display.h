/* SPDX-License-Identifier: MIT */
/* A stand-in for Zephyr's header of displays: what the example calls of it. */
#include "../../panel.h"

struct display_buffer_descriptor { uint32_t buf_size; uint16_t width, height, pitch; bool frame_incomplete; };

static inline int display_blanking_off(const struct device *device) { return (void)device, 0; }

static inline int display_write(const struct device *device, uint16_t x, uint16_t y,
                                const struct display_buffer_descriptor *size, const void *from)
{
    (void)device;
    panel_window(x, y, size->width, size->height);
    panel_bytes(from, size->pitch == size->width ? size->buf_size : 0);
    return 0;
}
