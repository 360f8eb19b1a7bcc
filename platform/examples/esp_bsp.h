/* SPDX-License-Identifier: MIT */
/* esp_bsp.h - smear on the display of a board with a support package of ESP-IDF's: pins, size and order of bytes are the
 * board's. Where the chip has two cores, both draw. */
#include <bsp/esp-bsp.h>
#include <esp_lcd_panel_io.h>
#include <esp_lcd_panel_ops.h>
#ifdef BSP_LCD_MIPI_DSI_LANE_NUM
#include <esp_lcd_mipi_dsi.h>
#endif
#include <freertos/FreeRTOS.h>
#include <freertos/task.h>

/* Of larger displays the middle. */
#define SCREEN_WIDTH (BSP_LCD_H_RES < 320 ? BSP_LCD_H_RES : 320)
#define SCREEN_HEIGHT (BSP_LCD_V_RES < 240 ? BSP_LCD_V_RES : 240)
#define SCREEN_FORMAT (BSP_LCD_BIGENDIAN ? SMEAR_RGB565_SWAPPED : SMEAR_RGB565)
#define SCREEN_BANDS 2
#ifdef CONFIG_FREERTOS_UNICORE
#define SCREEN_WORKERS 1
#else
#define SCREEN_WORKERS 2
#endif

static esp_lcd_panel_handle_t panel;
static volatile bool is_sending;        /* a DSI takes one band at a time */

static int display_flush(void *user, const smear_band *band)
{
    const int x = (BSP_LCD_H_RES - SCREEN_WIDTH) / 2 + band->x, y = (BSP_LCD_V_RES - SCREEN_HEIGHT) / 2 + band->y;
    (void)user;
    while (is_sending)
        taskYIELD();
    is_sending = true;
    return esp_lcd_panel_draw_bitmap(panel, x, y, x + band->width, y + band->height, band->pixels) == ESP_OK ? SMEAR_OK : -100;
}

/* From the driver's interrupt. */
#ifdef BSP_LCD_MIPI_DSI_LANE_NUM
static bool display_sent(esp_lcd_panel_handle_t of, esp_lcd_dpi_panel_event_data_t *event, void *user)
#else
static bool display_sent(esp_lcd_panel_io_handle_t of, esp_lcd_panel_io_event_data_t *event, void *user)
#endif
{
    (void)of, (void)event, (void)user;
    is_sending = false;
    smear_band_done(ctx);
    return false;
}

static void display_idle(void *user)
{
    (void)user;
    taskYIELD();
}

static void display_begin(smear_desc *desc)
{
    static bsp_display_config_t config;
    esp_lcd_panel_io_handle_t io;
#ifdef BSP_LCD_MIPI_DSI_LANE_NUM
    esp_lcd_dpi_panel_event_callbacks_t callbacks = { .on_color_trans_done = display_sent };
    bsp_display_new(&config, &panel, &io);
    esp_lcd_dpi_panel_register_event_callbacks(panel, &callbacks, NULL);
#else
    esp_lcd_panel_io_callbacks_t callbacks = { .on_color_trans_done = display_sent };
    config.max_transfer_sz = BSP_LCD_H_RES * 64 * 2;
    bsp_display_new(&config, &panel, &io);
    esp_lcd_panel_io_register_event_callbacks(io, &callbacks, NULL);
    esp_lcd_panel_disp_on_off(panel, true);
#endif
    bsp_display_backlight_on();
    desc->flush = display_flush;
    desc->idle = display_idle;
}

#if SCREEN_WORKERS > 1
/* The other core's share of each frame. */
static void display_work(void *user)
{
    (void)user;
    for (;;) {
        smear_work(ctx, 1);
        vTaskDelay(1);                  /* other tasks, the watchdog's among them */
    }
}

static void display_workers(void)
{
    xTaskCreatePinnedToCore(display_work, "smear", 4096, NULL, 1, NULL, 1);
}
#endif
