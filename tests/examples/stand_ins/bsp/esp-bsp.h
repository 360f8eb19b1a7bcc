/* SPDX-License-Identifier: MIT */
/* A stand-in for a board's support package: a panel at a SPI, or with BOARD_DSI a taller one at a DSI, in whose middle is what the
 * others show. */
#ifndef STAND_INS_ESP_BSP_H
#define STAND_INS_ESP_BSP_H
#include "../esp_lcd_panel_ops.h"

#define BSP_LCD_BIGENDIAN 1
#ifdef BOARD_DSI
#define BSP_LCD_MIPI_DSI_LANE_NUM 2
#define BSP_LCD_H_RES 240
#define BSP_LCD_V_RES 300
typedef struct { int hdmi_resolution; } bsp_display_config_t;
#else
#define BSP_LCD_H_RES 240
#define BSP_LCD_V_RES 240
typedef struct { int max_transfer_sz; } bsp_display_config_t;
#endif

static inline esp_err_t bsp_display_new(const bsp_display_config_t *config, esp_lcd_panel_handle_t *panel, esp_lcd_panel_io_handle_t *io)
{
    (void)config;
    *io = NULL;
    *panel = NULL;
    stand_in_top = (BSP_LCD_V_RES - PANEL_HEIGHT) / 2;
    return stand_in_ready = ESP_OK;
}

static inline esp_err_t bsp_display_backlight_on(void) { return ESP_OK; }

#endif
