/* SPDX-License-Identifier: MIT */
/* zephyr_display.h - smear on the display that Zephyr's device tree has chosen. */
#include <zephyr/device.h>
#include <zephyr/drivers/display.h>

/* One band. SPI panels take the high byte first: PIXEL_FORMAT_RGB_565 of Zephyr 4.2 and before, then ..._RGB_565X. */
#define SCREEN_WIDTH 240
#define SCREEN_HEIGHT 240
#define SCREEN_FORMAT SMEAR_RGB565_SWAPPED

static const struct device *const display = DEVICE_DT_GET(DT_CHOSEN(zephyr_display));

static int display_flush(void *user, const smear_band *band)
{
    const struct display_buffer_descriptor size = { .buf_size = band->size, .width = (uint16_t)band->width,
                                                    .height = (uint16_t)band->height, .pitch = (uint16_t)band->width };
    (void)user;
    return display_write(display, (uint16_t)band->x, (uint16_t)band->y, &size, band->pixels);
}

static void display_begin(smear_desc *desc)
{
    display_blanking_off(display);
    desc->flush = display_flush;
}
