/* SPDX-License-Identifier: MIT */
/* stm32_hal.h - smear on an ST7789 at SPI1 of an STM32, by DMA. Clocks, pins and DMA are CubeMX's, which writes main.h. */
#include "main.h"

#define SCREEN_WIDTH 240
#define SCREEN_HEIGHT 240
#define SCREEN_FORMAT SMEAR_RGB565_SWAPPED
#define SCREEN_BANDS 2

extern SPI_HandleTypeDef hspi1;
static volatile bool sending;

static void display_command(uint8_t command, uint16_t from, uint16_t to, uint16_t bytes)
{
    uint8_t data[4] = { (uint8_t)(from >> 8), (uint8_t)from, (uint8_t)(to >> 8), (uint8_t)to };
    HAL_GPIO_WritePin(LCD_DC_GPIO_Port, LCD_DC_Pin, GPIO_PIN_RESET);
    HAL_SPI_Transmit(&hspi1, &command, 1, HAL_MAX_DELAY);
    HAL_GPIO_WritePin(LCD_DC_GPIO_Port, LCD_DC_Pin, GPIO_PIN_SET);
    if (bytes != 0)
        HAL_SPI_Transmit(&hspi1, data, bytes, HAL_MAX_DELAY);
}

static void display_idle(void *user)
{
    (void)user;
    __WFE();                            /* every interrupt wakes it, before this or in it */
}

/* The bus must have run empty before the data/command line changes. */
static int display_flush(void *user, const smear_band *band)
{
    while (sending)
        display_idle(user);
    display_command(0x2a, (uint16_t)band->x, (uint16_t)(band->x + band->width - 1), 4);
    display_command(0x2b, (uint16_t)band->y, (uint16_t)(band->y + band->height - 1), 4);
    display_command(0x2c, 0, 0, 0);
    sending = true;
    return HAL_SPI_Transmit_DMA(&hspi1, (uint8_t *)band->pixels, (uint16_t)band->size) == HAL_OK ? SMEAR_OK : -100;
}

void HAL_SPI_TxCpltCallback(SPI_HandleTypeDef *spi)
{
    (void)spi;
    sending = false;
    smear_band_done(ctx);
}

static void display_begin(smear_desc *desc)
{
    display_command(0x11, 0, 0, 0);             /* out of sleep */
    HAL_Delay(120);
    display_command(0x3a, 0x5500, 0, 1);        /* 16 bits a pixel */
    display_command(0x21, 0, 0, 0);             /* these panels are inverted */
    display_command(0x29, 0, 0, 0);             /* on */
    desc->flush = display_flush;
    desc->idle = display_idle;
}
