/* SPDX-License-Identifier: MIT */
/* A stand-in for the main.h of an STM32 project: what the example calls of the HAL. */
#include "panel.h"

typedef struct { int unused; } SPI_HandleTypeDef;
typedef enum { HAL_OK = 0 } HAL_StatusTypeDef;
typedef enum { GPIO_PIN_RESET, GPIO_PIN_SET } GPIO_PinState;
#define LCD_DC_GPIO_Port 0
#define LCD_DC_Pin 0
#define HAL_MAX_DELAY 0xffffffffu

SPI_HandleTypeDef hspi1;
static bool stand_in_is_data;
static const uint8_t *stand_in_from;
static uint16_t stand_in_bytes;

void HAL_SPI_TxCpltCallback(SPI_HandleTypeDef *spi);
static inline void HAL_Delay(uint32_t ms) { (void)ms; }
static inline void HAL_GPIO_WritePin(int port, int pin, GPIO_PinState state)
{
    (void)port, (void)pin;
    stand_in_is_data = state == GPIO_PIN_SET;
}

static inline HAL_StatusTypeDef HAL_SPI_Transmit(SPI_HandleTypeDef *spi, const uint8_t *data, uint16_t size, uint32_t timeout)
{
    (void)spi, (void)timeout;
    panel_wire(stand_in_is_data, data, size);
    return HAL_OK;
}

static inline HAL_StatusTypeDef HAL_SPI_Transmit_DMA(SPI_HandleTypeDef *spi, const uint8_t *data, uint16_t size)
{
    (void)spi;
    stand_in_from = data;
    stand_in_bytes = size;
    return HAL_OK;
}

/* The interrupt that ends the wait. */
static inline void __WFE(void)
{
    if (stand_in_from == NULL)
        return;
    panel_wire(stand_in_is_data, stand_in_from, stand_in_bytes);
    stand_in_from = NULL;
    HAL_SPI_TxCpltCallback(&hspi1);
}
