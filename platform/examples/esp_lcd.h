/* SPDX-License-Identifier: MIT */
/* esp_lcd.h - smear on a panel of ESP-IDF's esp_lcd: its driver queues a band while another is sent by DMA. */
#include <driver/gpio.h>
#include <driver/spi_master.h>
#include <esp_lcd_panel_io.h>
#include <esp_lcd_panel_ops.h>
#include <esp_lcd_panel_vendor.h>
#include <esp_rom_sys.h>
#include <freertos/FreeRTOS.h>
#include <freertos/task.h>

#ifndef SCREEN_WIDTH
#define SCREEN_WIDTH 240
#define SCREEN_HEIGHT 240
#endif
#define SCREEN_FORMAT SMEAR_RGB565_SWAPPED
#define SCREEN_BANDS 2
#define PIN_CLOCK 12
#define PIN_DATA 11
#define PIN_SELECT 10
#define PIN_COMMAND 9
#define PIN_RESET 8
#define PIN_TEARING (-1)                /* where it is wired: no tears, and frames last whole refreshes of the panel */

static esp_lcd_panel_handle_t panel;

/* Until the panel has scanned a few rows: what is sent stays behind it. */
static void display_wait(void)
{
    while (gpio_get_level((gpio_num_t)PIN_TEARING) == 0)
        ;
    while (gpio_get_level((gpio_num_t)PIN_TEARING) != 0)
        ;
    esp_rom_delay_us(2000);
}

static int display_flush(void *user, const smear_band *band)
{
    (void)user;
    if (PIN_TEARING >= 0 && band->y == 0)
        display_wait();
    return esp_lcd_panel_draw_bitmap(panel, band->x, band->y, band->x + band->width, band->y + band->height, band->pixels)
                   == ESP_OK ? SMEAR_OK : -100;
}

/* From the driver's interrupt. */
static bool display_sent(esp_lcd_panel_io_handle_t io, esp_lcd_panel_io_event_data_t *event, void *user)
{
    (void)io, (void)event, (void)user;
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
    spi_bus_config_t bus = { .mosi_io_num = PIN_DATA, .miso_io_num = -1, .sclk_io_num = PIN_CLOCK, .quadwp_io_num = -1,
                             .quadhd_io_num = -1, .max_transfer_sz = SCREEN_WIDTH * 64 * 2 };
    esp_lcd_panel_io_spi_config_t wires = { .cs_gpio_num = PIN_SELECT, .dc_gpio_num = PIN_COMMAND, .pclk_hz = 40 * 1000 * 1000,
                                            .trans_queue_depth = 2, .on_color_trans_done = display_sent,
                                            .lcd_cmd_bits = 8, .lcd_param_bits = 8 };
    esp_lcd_panel_dev_config_t kind = { .reset_gpio_num = PIN_RESET, .bits_per_pixel = 16 };
    esp_lcd_panel_io_handle_t io;
    spi_bus_initialize(SPI2_HOST, &bus, SPI_DMA_CH_AUTO);
    esp_lcd_new_panel_io_spi((esp_lcd_spi_bus_handle_t)SPI2_HOST, &wires, &io);
    esp_lcd_new_panel_st7789(io, &kind, &panel);
    esp_lcd_panel_reset(panel);
    esp_lcd_panel_init(panel);
    esp_lcd_panel_invert_color(panel, true);
    esp_lcd_panel_disp_on_off(panel, true);
    if (PIN_TEARING >= 0) {
        const uint8_t blanking = 0;
        gpio_set_direction((gpio_num_t)PIN_TEARING, GPIO_MODE_INPUT);
        esp_lcd_panel_io_tx_param(io, 0x35, &blanking, 1);
    }
    desc->flush = display_flush;
    desc->idle = display_idle;
}
