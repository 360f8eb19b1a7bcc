/* SPDX-License-Identifier: MIT */
/* wires.h - a bus of eight wires, by a state machine of the PIO: bytes that are put into its queue go out. */
#ifndef SMEAR_PICO_WIRES_H
#define SMEAR_PICO_WIRES_H

#include "platform/pico/board.h"

#include <hardware/pio.h>
#include <pico/stdlib.h>

#define WIRES pio0
#define MACHINE 0u

/* Two instructions per byte: D0 to D7 with WR low, then WR high, by which the panel takes them. */
static inline void wires_open(void)
{
    static const uint16_t code[] = { 0x6008 /* out pins, 8  side 0 */, 0xb042 /* nop  side 1 */ };
    static const struct pio_program program = { code, 2, 0 };
    pio_add_program_at_offset(WIRES, &program, 0);
    for (uint pin = BOARD(DATA); pin < BOARD(DATA) + 8; pin++)
        pio_gpio_init(WIRES, pin);
    pio_gpio_init(WIRES, BOARD(CLK));
    pio_sm_set_consecutive_pindirs(WIRES, MACHINE, BOARD(DATA), 8, true);
    pio_sm_set_consecutive_pindirs(WIRES, MACHINE, BOARD(CLK), 1, true);
    pio_sm_config c = pio_get_default_sm_config();
    sm_config_set_wrap(&c, 0, 1);
    sm_config_set_out_pins(&c, BOARD(DATA), 8);
    sm_config_set_sideset(&c, 1, false, false);
    sm_config_set_sideset_pins(&c, BOARD(CLK));
    sm_config_set_fifo_join(&c, PIO_FIFO_JOIN_TX);
    sm_config_set_out_shift(&c, false, true, 8);
    sm_config_set_clkdiv(&c, (float)(BOARD(CLOCK_KHZ)) / (2.0f * BOARD(BUS_KHZ)));
    pio_sm_init(WIRES, MACHINE, 0, &c);
    pio_sm_set_enabled(WIRES, MACHINE, true);
}

static inline void wires_drain(void)
{
    WIRES->fdebug = 1u << (PIO_FDEBUG_TXSTALL_LSB + MACHINE);
    while ((WIRES->fdebug & 1u << (PIO_FDEBUG_TXSTALL_LSB + MACHINE)) == 0)
        tight_loop_contents();
}

static inline void wires_put(uint8_t byte)
{
    pio_sm_put_blocking(WIRES, MACHINE, (uint32_t)byte << 24);
}

static inline volatile void *wires_queue(void)
{
    return &WIRES->txf[MACHINE];
}

static inline uint wires_dreq(void)
{
    return pio_get_dreq(WIRES, MACHINE, true);
}

#endif
