/* SPDX-License-Identifier: MIT */
/* pico_spi.h - smear on an ST7789 at a Raspberry Pi Pico, in the shortest way: platform/pico sends by DMA and draws with
 * both cores. */
#include <hardware/gpio.h>
#include <hardware/spi.h>
#include <pico/time.h>

#define SCREEN_WIDTH 240
#define SCREEN_HEIGHT 240
#define SCREEN_FORMAT SMEAR_RGB565_SWAPPED
#define PIN_SELECT 17
#define PIN_CLOCK 18
#define PIN_DATA 19
#define PIN_COMMAND 20

static void display_command(uint8_t command, uint16_t from, uint16_t to, size_t bytes)
{
    const uint8_t data[4] = { (uint8_t)(from >> 8), (uint8_t)from, (uint8_t)(to >> 8), (uint8_t)to };
    gpio_put(PIN_COMMAND, 0);
    spi_write_blocking(spi0, &command, 1);
    gpio_put(PIN_COMMAND, 1);
    spi_write_blocking(spi0, data, bytes);
}

static int display_flush(void *user, const smear_band *band)
{
    (void)user;
    display_command(0x2a, (uint16_t)band->x, (uint16_t)(band->x + band->width - 1), 4);
    display_command(0x2b, (uint16_t)band->y, (uint16_t)(band->y + band->height - 1), 4);
    display_command(0x2c, 0, 0, 0);
    spi_write_blocking(spi0, (const uint8_t *)band->pixels, band->size);
    return SMEAR_OK;
}

static void display_begin(smear_desc *desc)
{
    spi_init(spi0, 62500000);
    gpio_set_function(PIN_CLOCK, GPIO_FUNC_SPI);
    gpio_set_function(PIN_DATA, GPIO_FUNC_SPI);
    gpio_init(PIN_SELECT);
    gpio_set_dir(PIN_SELECT, GPIO_OUT);
    gpio_put(PIN_SELECT, 0);                    /* nothing else is on this bus */
    gpio_init(PIN_COMMAND);
    gpio_set_dir(PIN_COMMAND, GPIO_OUT);
    display_command(0x11, 0, 0, 0);             /* out of sleep */
    sleep_ms(120);
    display_command(0x3a, 0x5500, 0, 1);        /* 16 bits a pixel */
    display_command(0x21, 0, 0, 0);             /* these panels are inverted */
    display_command(0x29, 0, 0, 0);             /* on */
    desc->flush = display_flush;
}
