/* SPDX-License-Identifier: MIT */
/* board.h - what firmware.c needs of a board. Copy this folder and write these functions; those a
 * board has no use for stay empty, as said at each. tests/target/target_template.c is a board made of
 * threads. */
#ifndef SMEAR_TEMPLATE_BOARD_H
#define SMEAR_TEMPLATE_BOARD_H

#include <stdbool.h>
#include <stdint.h>

/* Starts to send `bytes` of pixels, rows y .. y + height - 1, and returns: sets the panel's window,
 * then starts the DMA channel of its bus. Its interrupt calls firmware_band_sent(). A board without
 * DMA sends them here and calls firmware_band_sent() itself, at the end. */
void board_send(const void *pixels, uint32_t bytes, int y, int height);

/* Writes what the data cache holds of these bytes to memory, where DMA reads them. Empty on cores
 * without a data cache (all but some Cortex-M7 and the like). */
void board_clean_cache(const void *bytes, uint32_t count);

/* Holds back the interrupt that calls firmware_band_sent(). Empty when there is none. */
uint32_t board_interrupts_off(void);
void board_interrupts_restore(uint32_t state);

/* Lets another core run `entry`, which never returns. Empty where there is one core: BOARD_CORES 1. */
void board_start_core(void (*entry)(void));

/* Called while there is nothing to do but wait; must return soon by itself. Sleeping (WFE, WFI) is
 * for boards with one core, where an interrupt ends it: another core that finishes its share sends
 * no event. */
void board_idle(void);

/* Waits until the display wants the next frame: its tearing-effect line, a timer, or nothing. False
 * ends the program. */
bool board_next_frame(void);

/* Called by the board when a band has been sent; may be called from an interrupt. */
void firmware_band_sent(void);

#endif
