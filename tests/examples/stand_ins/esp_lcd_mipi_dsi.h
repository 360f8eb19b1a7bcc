/* SPDX-License-Identifier: MIT */
/* A stand-in for ESP-IDF: see esp_lcd_panel_ops.h. */
#include "esp_lcd_panel_ops.h"
