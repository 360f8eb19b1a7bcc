/* SPDX-License-Identifier: MIT */
/* A stand-in for ESP-IDF: while a task yields, the bus goes on. */
#include "../esp_lcd_panel_ops.h"

#define taskYIELD() stand_in_interrupt()
#define vTaskDelay(ticks) stand_in_interrupt()
