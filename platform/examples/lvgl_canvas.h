/* SPDX-License-Identifier: MIT */
/* lvgl_canvas.h - smear on a canvas of LVGL 9, among its other widgets. */
#include <lvgl.h>
#include <string.h>

#define SCREEN_WIDTH 240
#define SCREEN_HEIGHT 240
#define SCREEN_FORMAT SMEAR_RGB565     /* in LVGL's order */

static uint16_t canvas_pixels[SCREEN_WIDTH * SCREEN_HEIGHT];
static lv_obj_t *canvas;

static int display_flush(void *user, const smear_band *band)
{
    const uint8_t *from = (const uint8_t *)band->pixels;
    (void)user;
    for (int y = band->y; y < band->y + band->height; y++, from += band->stride)
        memcpy(canvas_pixels + y * SCREEN_WIDTH + band->x, from, 2u * (unsigned)band->width);
    if (band->y + band->height == SCREEN_HEIGHT)
        lv_obj_invalidate(canvas);      /* the frame is whole: LVGL shows it at its next refresh */
    return SMEAR_OK;
}

static void display_begin(smear_desc *desc)
{
    canvas = lv_canvas_create(lv_screen_active());
    lv_canvas_set_buffer(canvas, canvas_pixels, SCREEN_WIDTH, SCREEN_HEIGHT, LV_COLOR_FORMAT_RGB565);
    desc->flush = display_flush;
}
