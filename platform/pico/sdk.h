/* SPDX-License-Identifier: MIT */
/* sdk.h - what display.c and board.c use of the pico-sdk, or of a file that has as much of it: SMEAR_CHIP_FILE. */
#ifndef SMEAR_PICO_SDK_H
#define SMEAR_PICO_SDK_H

#ifdef SMEAR_CHIP_FILE
#include SMEAR_CHIP_FILE
#else
#include "platform/pico/wires.h"

#include <hardware/clocks.h>
#include <hardware/dma.h>
#include <hardware/gpio.h>
#include <hardware/irq.h>
#include <hardware/spi.h>
#include <hardware/structs/iobank0.h>
#include <hardware/sync.h>
#include <hardware/uart.h>
#include <pico/multicore.h>
#include <pico/stdlib.h>
#endif

#endif
