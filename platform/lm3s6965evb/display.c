/* SPDX-License-Identifier: MIT */
/* display.c - display.h on the OLED panel of the lm3s6965evb: an SSD0323 on SSI0 (PL022), 128x64
 * pixels of 4 bits, left one in the high nibble.
 *
 * Bands go out while the next one is drawn: flush queues the band, and the interrupt of the
 * transmit FIFO feeds it; the last byte's calls smear_band_done. D/C is low for commands and must
 * not change before the FIFO has run empty. Pins: PA2 clock, PA3 select, PA5 data, PC6 panel power,
 * PC7 D/C, PD0 select of the SD card on the same bus (high: not selected).
 *
 * References: LM3S6965 data sheet (SSI, GPIO), SSD0323 data sheet. */
#include "platform/display.h"

#include "platform/cortexm/interrupt.h"

#define REG(address) (*(volatile uint32_t *)(address))

#define RCGC1 REG(0x400fe104u)                  /* clocks of peripherals */
#define RCGC2 REG(0x400fe108u)

#define GPIO_A 0x40004000u
#define GPIO_C 0x40006000u
#define GPIO_D 0x40007000u
#define GPIO_E 0x40024000u
#define GPIO_F 0x40025000u
#define GPIO_PINS(port, mask) REG((port) + ((mask) << 2))
#define GPIO_DIRECTION(port) REG((port) + 0x400u)
#define GPIO_ALTERNATE(port) REG((port) + 0x420u)
#define GPIO_PULL_UP(port) REG((port) + 0x510u)
#define GPIO_DIGITAL(port) REG((port) + 0x51cu)

#define SSI_CR0 REG(0x40008000u)
#define SSI_CR1 REG(0x40008004u)
#define SSI_DATA REG(0x40008008u)
#define SSI_STATUS REG(0x4000800cu)
#define SSI_PRESCALE REG(0x40008010u)
#define SSI_MASK REG(0x40008014u)               /* of interrupts: 1 enables */

enum {
    NOT_FULL = 2, HAS_RECEIVED = 4, BUSY = 16,  /* SSI_STATUS */
    TRANSMIT = 8,                               /* SSI_MASK: FIFO half empty or less */
    SSI_INTERRUPT = 7,
    POWER = 0x40, DATA = 0x80,                  /* pins of port C */
    ROW_BYTES = 64, ROWS = 64
};

/* What is being sent, and the band that waits behind it. */
static struct {
    smear_context *ctx;
    const uint8_t *at, *end;        /* of the band that is being sent; equal: none is */
    smear_band next;
    volatile bool is_sending, has_next;
} bus;

/* The FIFO takes 8. What comes back is dropped, else the receiver would run full. */
static void send_polled(const uint8_t *byte, unsigned count)
{
    for (; count != 0; count--) {
        while (!(SSI_STATUS & NOT_FULL)) {
        }
        SSI_DATA = *byte++;
        while (SSI_STATUS & HAS_RECEIVED)
            (void)SSI_DATA;
    }
    while (SSI_STATUS & BUSY) {
    }
}

static void command(const uint8_t *byte, unsigned count)
{
    while (SSI_STATUS & BUSY) {
    }
    GPIO_PINS(GPIO_C, DATA) = 0;
    send_polled(byte, count);
    GPIO_PINS(GPIO_C, DATA) = DATA;
}

/* Points the panel at the band's place and lets the interrupt send them. */
static void start_band(const smear_band *band)
{
    const uint8_t window[6] = { 0x15, (uint8_t)(band->x / 2), (uint8_t)((band->x + band->width) / 2 - 1),
                                0x75, (uint8_t)band->y, (uint8_t)(band->y + band->height - 1) };
    command(window, sizeof window);
    bus.at = band->pixels;
    bus.end = bus.at + band->size;
    bus.is_sending = true;
    SSI_MASK = TRANSMIT;
}

/* The transmit FIFO has room. */
void interrupt_7(void)
{
    while (SSI_STATUS & HAS_RECEIVED)
        (void)SSI_DATA;
    for (int i = 0; i < 4 && bus.at != bus.end; i++)
        SSI_DATA = *bus.at++;
    if (bus.at != bus.end)
        return;
    SSI_MASK = 0;
    bus.is_sending = false;
    smear_band_done(bus.ctx);
    if (bus.has_next) {
        bus.has_next = false;
        start_band(&bus.next);
    }
}

/* With two bands there is never a third: the library waits for one to be sent. */
static int flush(void *user, const smear_band *band)
{
    (void)user;
    uint32_t state = interrupts_off();
    if (bus.is_sending) {
        bus.next = *band;
        bus.has_next = true;
    } else {
        start_band(band);
    }
    interrupts_restore(state);
    return 0;
}

/* An interrupt sets the event, so one that comes just before this is not missed. */
static void wait_for_event(void *user)
{
    (void)user;
    __asm volatile("wfe");
}

bool display_open(smear_desc *desc)
{
    static const uint8_t start[] = {
        0xae,                       /* off while it is set up */
        0x81, 0x32,                 /* contrast */
        0x86,                       /* half the current range */
        0xa0, 0x52,                 /* remap: nibbles, commons; rows are written from left to right */
        0xa1, 0x00, 0xa2, 0x4c,     /* start line, offset: of this panel */
        0xa4, 0xa8, 0x3f,           /* normal display, 64 rows */
        0xb1, 0x22, 0xb2, 0x46, 0xb3, 0xf1,     /* phases, row period, clock */
        0xbf, 0x0d, 0xbe, 0x02, 0xbc, 0x00,     /* voltages */
        0xb8, 0x01, 0x11, 0x22, 0x32, 0x43, 0x54, 0x65, 0x76,   /* grey levels */
        0xad, 0x03,                 /* converter on */
        0xaf                        /* on */
    };
    if (desc->width != 2 * ROW_BYTES || desc->height != ROWS || desc->format != SMEAR_L4)
        return false;
    desc->bands = 2;
    desc->reuse.buffer_age = (desc->methods & SMEAR_SET_TEMPORAL) != 0;      /* the panel's memory */
    desc->flush = flush;
    desc->idle = wait_for_event;

    RCGC1 |= 1u << 4;
    RCGC2 |= 1u << 0 | 1u << 2 | 1u << 3 | 1u << 4 | 1u << 5;
    GPIO_DIRECTION(GPIO_C) |= POWER | DATA;
    GPIO_DIGITAL(GPIO_C) |= POWER | DATA;
    GPIO_DIRECTION(GPIO_D) |= 1;
    GPIO_DIGITAL(GPIO_D) |= 1;
    GPIO_ALTERNATE(GPIO_A) |= 0x3c;
    GPIO_DIGITAL(GPIO_A) |= 0x3c;
    GPIO_PINS(GPIO_D, 1) = 1;
    GPIO_PINS(GPIO_C, POWER) = POWER;
    SSI_CR1 = 0;
    SSI_PRESCALE = 2;
    SSI_CR0 = 7;                    /* 8 bits, SPI mode 0 */
    SSI_MASK = 0;
    SSI_CR1 = 2;                    /* on, master */
    command(start, sizeof start);

    /* Keys: E0..E3 up, down, left, right; F1 select. They close to ground. */
    GPIO_PULL_UP(GPIO_E) |= 0x0f;
    GPIO_DIGITAL(GPIO_E) |= 0x0f;
    GPIO_PULL_UP(GPIO_F) |= 0x02;
    GPIO_DIGITAL(GPIO_F) |= 0x02;
    return true;
}

void display_attach(smear_context *ctx)
{
    bus.ctx = ctx;
    interrupt_enable(SSI_INTERRUPT);
}

void display_show(void)
{
    while (bus.is_sending)
        wait_for_event(NULL);
}

bool display_wait(void)
{
    for (volatile int i = 0; i < 10000; i++) {
    }
    return true;
}

/* No timer runs: each call is a frame of 1/30 s later. */
uint32_t display_time(void)
{
    static uint32_t calls;
    return ++calls * 34;
}

unsigned display_keys(void)
{
    unsigned held = ~GPIO_PINS(GPIO_E, 0x0fu) & 0x0fu;
    return held | (GPIO_PINS(GPIO_F, 0x02u) & 2u ? 0 : KEY_A);
}
