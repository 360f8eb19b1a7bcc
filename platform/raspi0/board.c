/* SPDX-License-Identifier: MIT */
/* board.c - platform.h on a Raspberry Pi Zero, and its main: clock, caches, UART, messages to the firmware.
 *
 * Text goes to the UART of pin 14, 115200 baud. Arguments and status are a debugger's or an emulator's (semihosting); on a
 * board there are none, and the demo shows its loop. */
#include "platform/raspi0/board.h"

#include "platform/common/arguments.h"
#include "platform/common/semihost.h"
#include "platform/platform.h"
#include "platform/print.h"

enum {
    FAULT_STATUS = 99,
    MEGABYTE = 1 << 20,
    REGISTERS_START = 0x200, REGISTERS_END = 0x210,     /* megabytes */
    UART_PIN = 14, BAUD = 115200
};

/* Devices and tags of the firmware. */
enum { CLOCK_UART = 2, CLOCK_ARM = 3, GET_RATE = 0x30002, GET_MAX_RATE = 0x30004, SET_RATE = 0x38002 };

#define MAILBOX_READ   BOARD_REGISTER(0xb880u)
#define MAILBOX_STATUS BOARD_REGISTER(0xb898u)
#define MAILBOX_WRITE  BOARD_REGISTER(0xb8a0u)
#define MAILBOX_EMPTY  0x40000000u
#define MAILBOX_FULL   0x80000000u
#define PROPERTIES     8u           /* the mailbox's channel */
#define ANSWERED       0x80000000u

#define UART_DATA      BOARD_REGISTER(0x201000u)
#define UART_FLAGS     BOARD_REGISTER(0x201018u)
#define UART_WHOLE     BOARD_REGISTER(0x201024u)
#define UART_FRACTION  BOARD_REGISTER(0x201028u)
#define UART_LINE      BOARD_REGISTER(0x20102cu)
#define UART_CONTROL   BOARD_REGISTER(0x201030u)
#define UART_IS_FULL   0x20u

extern uint32_t link_page_table[], link_uncached[];

int main(int argc, char **argv);
void board_main(void);
void board_fault(uint32_t address);

volatile uint32_t board_message[BOARD_MESSAGE_WORDS] __attribute__((section(".uncached"), aligned(16)));

/* ------------------------------------------------------------------ platform.h */

/* Of QEMU with -icount shift=10, where each lasts 1.024 us of BOARD_TIME. */
const char platform_clock_unit[] = "instructions";

void platform_print(const char *text)
{
    for (; *text != '\0'; text++) {
        while ((UART_FLAGS & UART_IS_FULL) != 0) {
        }
        UART_DATA = (uint8_t)*text;
    }
}

void platform_clock_start(void)
{
}

uint32_t platform_clock(void)
{
    return BOARD_TIME;
}

uint32_t platform_clock_count(uint32_t ticks)
{
    return ticks - ticks / 128 * 3 - ticks % 128 * 3 / 128;     /* ticks / 1.024 */
}

/* ------------------------------------------------------------------ messages */

void board_send(const uint32_t *tags, uint32_t words)
{
    const uint32_t address = (uint32_t)board_message;
    board_message[0] = (words + 3) * 4;
    board_message[1] = 0;
    for (uint32_t i = 0; i < words; i++)
        board_message[2 + i] = tags[i];
    board_message[2 + words] = 0;
    __sync_synchronize();
    while ((MAILBOX_STATUS & MAILBOX_FULL) != 0) {
    }
    MAILBOX_WRITE = address | PROPERTIES;
}

bool board_answer(void)
{
    const uint32_t mine = (uint32_t)board_message | PROPERTIES;
    do {
        while ((MAILBOX_STATUS & MAILBOX_EMPTY) != 0) {
        }
    } while (MAILBOX_READ != mine);
    __sync_synchronize();
    return board_message[1] == ANSWERED;
}

uint32_t board_ask(uint32_t tag, uint32_t device)
{
    const uint32_t tags[] = { tag, 8, 0, device, 0 };
    board_send(tags, sizeof tags / sizeof *tags);
    return board_answer() ? board_message[6] : 0;
}

/* ------------------------------------------------------------------ pins */

void board_pin_open(unsigned pin, enum board_pin_function function)
{
    const unsigned shift = pin % 10 * 3;
    BOARD_PIN_FUNCTION(pin) = (BOARD_PIN_FUNCTION(pin) & ~(7u << shift)) | (uint32_t)function << shift;
}

/* The data sheet wants 150 cycles before and after the clock. */
static void wait_us(uint32_t count)
{
    for (const uint32_t start = BOARD_TIME; BOARD_TIME - start <= count;) {
    }
}

void board_pull(uint32_t mask, uint32_t pull)
{
    BOARD_PULL = pull;
    wait_us(1);
    BOARD_PULL_CLOCK = mask;
    wait_us(1);
    BOARD_PULL = 0;
    BOARD_PULL_CLOCK = 0;
}

/* ------------------------------------------------------------------ start */

/* 64ths of the divisor by 16 baud. */
static void open_uart(void)
{
    const uint32_t rate = board_ask(GET_RATE, CLOCK_UART);
    const uint32_t divisor = (rate * 4 + BAUD / 2) / BAUD;
    UART_CONTROL = 0;
    if (divisor >= 64) {
        UART_WHOLE = divisor / 64;
        UART_FRACTION = divisor % 64;
    }
    UART_LINE = 0x70;               /* 8 bits, queues */
    board_pin_open(UART_PIN, PIN_UART);
    UART_CONTROL = 0x101;           /* on, sends */
}

/* The firmware starts programs slower than the chip can go. */
static void be_fast(void)
{
    const uint32_t tags[] = { SET_RATE, 12, 0, CLOCK_ARM, board_ask(GET_MAX_RATE, CLOCK_ARM), 0 };
    if (tags[4] == 0)
        return;
    board_send(tags, sizeof tags / sizeof *tags);
    board_answer();
}

/* Sections of a megabyte, at their own addresses: the program's memory, cached; the firmware's, not cached, but writes are
 * gathered; registers; and nothing else. "ARM1176JZF-S Technical Reference Manual", 3.2.7 and 6.6. */
static void open_caches(void)
{
    enum { SECTION = 2, MAY_ALL = 3 << 10, CACHED = 1 << 12 | 3 << 2, UNCACHED = 1 << 12, DEVICE = 1 << 2 | 1 << 4 };
    const uint32_t cached = (uint32_t)link_uncached / MEGABYTE;
    for (uint32_t i = 0; i < 4096; i++) {
        const uint32_t kind = i < cached ? CACHED : i < REGISTERS_START ? UNCACHED : DEVICE;
        link_page_table[i] = i < REGISTERS_END ? i * MEGABYTE | SECTION | MAY_ALL | kind : 0;
    }
    uint32_t control;
    __asm volatile("mcr p15, 0, %1, c7, c7, 0\n\t"      /* caches: empty */
                   "mcr p15, 0, %1, c8, c7, 0\n\t"      /* addresses: forgotten */
                   "mcr p15, 0, %2, c2, c0, 0\n\t"      /* the table */
                   "mcr p15, 0, %1, c2, c0, 2\n\t"
                   "mcr p15, 0, %3, c3, c0, 0\n\t"      /* domain 0 */
                   "mcr p15, 0, %1, c7, c10, 4\n\t"
                   "mrc p15, 0, %0, c1, c0, 0"
                   : "=r"(control) : "r"(0), "r"(link_page_table), "r"(1) : "memory");
    control |= 1u << 23 | 1u << 22 | 1u << 12 | 1u << 11 | 1u << 2 | 1u;     /* tables of ARMv6, unaligned words, caches, branches */
    control &= ~2u;                                                          /* no alignment faults */
    __asm volatile("mcr p15, 0, %0, c1, c0, 0\n\t"
                   "mcr p15, 0, %1, c7, c5, 4"
                   : : "r"(control), "r"(0) : "memory");
}

void board_main(void)
{
    static char line[COMMAND_LINE_BYTES];
    static char *argument[MAX_ARGUMENTS + 1];
    open_caches();
    open_uart();
    be_fast();
    const int count = semihost_command_line(line, sizeof line) ? arguments_split(line, argument) : 0;
    const int status = main(count, argument);
    semihost_exit(status);
}

/* On a board the text is all there is to see. */
void board_fault(uint32_t address)
{
    platform_print("fault at ");
    print_hex(address);
    platform_print("\n");
    semihost_exit(FAULT_STATUS);
}
