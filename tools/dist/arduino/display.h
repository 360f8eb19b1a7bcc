/* SPDX-License-Identifier: MIT */
/* display.h - which library knows the display: define one of these, here or by a compiler's option. Its pins and the display's size are in
 * the header that is named. */
#if !defined(DISPLAY_LOVYANGFX) && !defined(DISPLAY_ARDUINO_GFX) && !defined(DISPLAY_TFT_ESPI) && !defined(DISPLAY_ADAFRUIT_GFX) \
    && !defined(DISPLAY_U8G2) && !defined(DISPLAY_ILI9341_T4)
#ifdef __IMXRT1062__
#define DISPLAY_ILI9341_T4              /* Teensy 4.0 and 4.1 */
#else
#define DISPLAY_LOVYANGFX
#endif
#endif

#if defined(DISPLAY_LOVYANGFX)
#include "lovyangfx.h"                  /* all of ESP32, RP2040, RP2350, SAMD51: sends by DMA */
#elif defined(DISPLAY_ARDUINO_GFX)
#include "arduino_gfx.h"                /* "GFX Library for Arduino": nearly all boards and panels */
#elif defined(DISPLAY_TFT_ESPI)
#include "tft_espi.h"                   /* not on ESP32-P4 and C6, nor on RP2350 */
#elif defined(DISPLAY_ADAFRUIT_GFX)
#include "adafruit_gfx.h"               /* panels whose class is an Adafruit_SPITFT */
#elif defined(DISPLAY_U8G2)
#include "u8g2.h"                       /* one bit a pixel */
#elif defined(DISPLAY_ILI9341_T4)
#include "ili9341_t4.h"
#endif
