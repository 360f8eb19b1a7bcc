/* SPDX-License-Identifier: MIT */
/* A stand-in for LVGL's header: what the example calls of it. An invalid canvas is shown at once. */
#include "panel.h"

typedef struct { const uint8_t *pixels; int width, height; } lv_obj_t;
typedef enum { LV_COLOR_FORMAT_RGB565 = 0x12 } lv_color_format_t;

static inline lv_obj_t *lv_screen_active(void) { return NULL; }

static inline lv_obj_t *lv_canvas_create(lv_obj_t *parent)
{
    static lv_obj_t canvas;
    (void)parent;
    return &canvas;
}

static inline void lv_canvas_set_buffer(lv_obj_t *canvas, void *buffer, int32_t w, int32_t h, lv_color_format_t format)
{
    (void)format;
    canvas->pixels = (const uint8_t *)buffer;
    canvas->width = w;
    canvas->height = h;
}

static inline void lv_obj_invalidate(const lv_obj_t *canvas)
{
    panel_window(0, 0, canvas->width, canvas->height);
    for (int i = 0; i < 2 * canvas->width * canvas->height; i += 2) {
        panel_bytes(canvas->pixels + i + 1, 1);
        panel_bytes(canvas->pixels + i, 1);
    }
}
