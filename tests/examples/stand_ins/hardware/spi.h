/* SPDX-License-Identifier: MIT */
/* A stand-in for pico-sdk's headers: what the example calls of them. */
#ifndef STAND_INS_PICO_H
#define STAND_INS_PICO_H
#include "../panel.h"

enum { spi0, GPIO_OUT, GPIO_FUNC_SPI };
static bool stand_in_is_data;

static inline unsigned spi_init(int spi, unsigned baud) { return (void)spi, baud; }
static inline void gpio_init(unsigned pin) { (void)pin; }
static inline void gpio_set_dir(unsigned pin, bool out) { (void)pin, (void)out; }
static inline void gpio_set_function(unsigned pin, int function) { (void)pin, (void)function; }
static inline void sleep_ms(uint32_t ms) { (void)ms; }

/* Chip select is 17, which stays low. */
static inline void gpio_put(unsigned pin, bool high)
{
    if (pin != 17)
        stand_in_is_data = high;
}

static inline int spi_write_blocking(int spi, const uint8_t *from, size_t bytes)
{
    (void)spi;
    if (bytes > 0)
        panel_wire(stand_in_is_data, from, bytes);
    return (int)bytes;
}

#endif
