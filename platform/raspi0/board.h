/* SPDX-License-Identifier: MIT */
/* board.h - the BCM2835 of a Raspberry Pi Zero and 1. "BCM2835 ARM Peripherals", Broadcom, 2012; mailbox and tags:
 * "Mailbox property interface", the wiki of Raspberry Pi's firmware. */
#ifndef SMEAR_RASPI0_BOARD_H
#define SMEAR_RASPI0_BOARD_H

#include <stdbool.h>
#include <stdint.h>

#define BOARD_REGISTER(offset) (*(volatile uint32_t *)(0x20000000u + (offset)))

/* Microseconds. */
#define BOARD_TIME BOARD_REGISTER(0x3004u)

/* Functions of pins, three bits each, ten pins in a word; levels, 32 pins in a word. */
#define BOARD_PIN_FUNCTION(pin) BOARD_REGISTER(0x200000u + 4 * ((pin) / 10))
#define BOARD_PIN_SET(pin)      BOARD_REGISTER(0x20001cu + 4 * ((pin) / 32))
#define BOARD_PIN_CLEAR(pin)    BOARD_REGISTER(0x200028u + 4 * ((pin) / 32))
#define BOARD_PIN_LEVELS        BOARD_REGISTER(0x200034u)
#define BOARD_PULL              BOARD_REGISTER(0x200094u)
#define BOARD_PULL_CLOCK        BOARD_REGISTER(0x200098u)

enum board_pin_function { PIN_INPUT = 0, PIN_OUTPUT = 1, PIN_UART = 4 };

void board_pin_open(unsigned pin, enum board_pin_function function);

/* Pins of `mask`: a resistor to 3.3 V (2), to ground (1), or none (0). */
void board_pull(uint32_t mask, uint32_t pull);

/* A message to the firmware: its bytes, a word for the answer, tags, 0. One at a time is under way. */
enum { BOARD_MESSAGE_WORDS = 64 };
extern volatile uint32_t board_message[BOARD_MESSAGE_WORDS];

/* Sends tags, `words` words in all. */
void board_send(const uint32_t *tags, uint32_t words);

/* Waits for the answer to the last message, which replaces its tags from word 2 of board_message on; false where the firmware
 * understood nothing. */
bool board_answer(void);

/* What the firmware says of a device; 0 where it does not know. */
uint32_t board_ask(uint32_t tag, uint32_t device);

#endif
