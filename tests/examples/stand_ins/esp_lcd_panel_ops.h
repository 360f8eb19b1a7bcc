/* SPDX-License-Identifier: MIT */
/* A stand-in for ESP-IDF's headers of esp_lcd and SPI: what the example calls of them. */
#ifndef STAND_INS_ESP_LCD_H
#define STAND_INS_ESP_LCD_H
#include "panel.h"

typedef int esp_err_t;
#define ESP_OK 0
typedef struct esp_lcd_panel_t *esp_lcd_panel_handle_t;
typedef struct esp_lcd_panel_io_t *esp_lcd_panel_io_handle_t;
typedef int esp_lcd_spi_bus_handle_t;
typedef struct { int unused; } esp_lcd_panel_io_event_data_t;
typedef bool (*esp_lcd_panel_io_color_trans_done_cb_t)(esp_lcd_panel_io_handle_t io, esp_lcd_panel_io_event_data_t *event,
                                                       void *user);
typedef struct { int mosi_io_num, miso_io_num, sclk_io_num, quadwp_io_num, quadhd_io_num, max_transfer_sz; } spi_bus_config_t;
typedef struct {
    int cs_gpio_num, dc_gpio_num, spi_mode;
    unsigned pclk_hz;
    size_t trans_queue_depth;
    esp_lcd_panel_io_color_trans_done_cb_t on_color_trans_done;
    void *user_ctx;
    int lcd_cmd_bits, lcd_param_bits;
} esp_lcd_panel_io_spi_config_t;
typedef struct { int reset_gpio_num; unsigned bits_per_pixel; } esp_lcd_panel_dev_config_t;
enum { SPI2_HOST = 1, SPI_DMA_CH_AUTO = 3 };

typedef struct { esp_lcd_panel_io_color_trans_done_cb_t on_color_trans_done; } esp_lcd_panel_io_callbacks_t;
typedef struct { int unused; } esp_lcd_dpi_panel_event_data_t;
typedef bool (*esp_lcd_dpi_panel_color_trans_done_cb_t)(esp_lcd_panel_handle_t panel, esp_lcd_dpi_panel_event_data_t *event, void *user);
typedef struct { esp_lcd_dpi_panel_color_trans_done_cb_t on_color_trans_done; } esp_lcd_dpi_panel_event_callbacks_t;

static esp_lcd_panel_io_spi_config_t stand_in_io;
static esp_lcd_dpi_panel_color_trans_done_cb_t stand_in_dsi;      /* of a DSI, which takes one band at a time */
static int stand_in_top;        /* row of the display in which the panel's first one is */
static esp_err_t stand_in_ready = 1;

static inline void stand_in_interrupt(void)
{
    if (panel_queued == 0)
        return;
    panel_send_first();
    if (stand_in_dsi != NULL)
        stand_in_dsi(NULL, NULL, NULL);
    else
        stand_in_io.on_color_trans_done(NULL, NULL, stand_in_io.user_ctx);
}

static inline esp_err_t esp_lcd_panel_io_register_event_callbacks(esp_lcd_panel_io_handle_t io,
                                                                  const esp_lcd_panel_io_callbacks_t *callbacks, void *user)
{
    stand_in_io.on_color_trans_done = callbacks->on_color_trans_done;
    return (void)io, (void)user, ESP_OK;
}

static inline esp_err_t esp_lcd_dpi_panel_register_event_callbacks(esp_lcd_panel_handle_t panel,
                                                                   const esp_lcd_dpi_panel_event_callbacks_t *callbacks, void *user)
{
    stand_in_dsi = callbacks->on_color_trans_done;
    return (void)panel, (void)user, ESP_OK;
}

static inline esp_err_t spi_bus_initialize(int host, const spi_bus_config_t *bus, int dma)
{
    (void)host, (void)bus, (void)dma;
    return ESP_OK;
}

static inline esp_err_t esp_lcd_new_panel_io_spi(esp_lcd_spi_bus_handle_t bus, const esp_lcd_panel_io_spi_config_t *config,
                                                 esp_lcd_panel_io_handle_t *io)
{
    (void)bus;
    stand_in_io = *config;
    *io = NULL;
    return ESP_OK;
}

static inline esp_err_t esp_lcd_new_panel_st7789(esp_lcd_panel_io_handle_t io, const esp_lcd_panel_dev_config_t *config,
                                                 esp_lcd_panel_handle_t *panel)
{
    (void)io, (void)config;
    *panel = NULL;
    return ESP_OK;
}

typedef int gpio_num_t;
enum { GPIO_MODE_INPUT = 1 };
static inline int gpio_get_level(gpio_num_t pin) { return (void)pin, 0; }
static inline esp_err_t gpio_set_direction(gpio_num_t pin, int mode) { return (void)pin, (void)mode, ESP_OK; }
static inline void esp_rom_delay_us(uint32_t us) { (void)us; }
static inline esp_err_t esp_lcd_panel_io_tx_param(esp_lcd_panel_io_handle_t io, int code, const void *data, size_t size)
{
    return (void)io, (void)code, (void)data, (void)size, ESP_OK;
}

static inline esp_err_t esp_lcd_panel_reset(esp_lcd_panel_handle_t panel) { return (void)panel, ESP_OK; }
static inline esp_err_t esp_lcd_panel_init(esp_lcd_panel_handle_t panel) { return (void)panel, stand_in_ready = ESP_OK; }
static inline esp_err_t esp_lcd_panel_invert_color(esp_lcd_panel_handle_t panel, bool on) { return (void)panel, (void)on, ESP_OK; }
static inline esp_err_t esp_lcd_panel_disp_on_off(esp_lcd_panel_handle_t panel, bool on) { return (void)panel, (void)on, ESP_OK; }

/* The last column and row are those behind the window. */
static inline esp_err_t esp_lcd_panel_draw_bitmap(esp_lcd_panel_handle_t panel, int x0, int y0, int x1, int y1, const void *data)
{
    (void)panel;
    if (stand_in_dsi != NULL && panel_queued > 0)
        return 1;
    while (panel_queued >= 2)
        stand_in_interrupt();
    panel_queue_band(x0, y0 - stand_in_top, x1 - x0, y1 - y0, data);
    return stand_in_ready;
}

#endif
