/* SPDX-License-Identifier: MIT */
/* chip.h - an RP2350 without an SDK: what platform/pico uses of the pico-sdk, under its names, in registers.
 *
 * Peripherals lie in blocks of 4000h, of which writes 2000h further on set bits, and those 3000h further on clear them. The
 * chip wakes by its ring oscillator; set_sys_clock_khz() wakes the crystal, the PLL and all that is used here.
 *
 * References: RP2350 data sheet; PL011 and PL022 manuals. */
#ifndef SMEAR_PICO2_CHIP_H
#define SMEAR_PICO2_CHIP_H

#include "platform/cortexm/interrupt.h"
#include "platform/pico/board.h"

#include <stdbool.h>
#include <stdint.h>

#define REG(address) (*(volatile uint32_t *)(address))
#define REG_SET(address) REG((address) + 0x2000u)
#define REG_CLEAR(address) REG((address) + 0x3000u)

typedef unsigned uint;
typedef uint64_t absolute_time_t;

_Static_assert(BOARD(BUS) != BUS_PARALLEL, "boards.h: a bus of eight wires needs the pico-sdk");

#define __not_in_flash_func(name) __attribute__((section(".ramfunc." #name))) name

/* ------------------------------------------------------------------ clocks, time */

#define TIMER_HIGH REG(0x400b0024u)     /* microseconds */
#define TIMER_LOW REG(0x400b0028u)

#define CLOCKS_CLK_PERI_CTRL_AUXSRC_VALUE_CLK_SYS 0u
#define clk_peri 0x40010048u

/* By a crystal of 12 MHz: 150 MHz and some others, chip.c says which. */
void set_sys_clock_khz(uint32_t khz, bool required);

static inline void clock_configure(uint32_t clock, uint32_t source, uint32_t auxiliary, uint32_t hz_source, uint32_t hz)
{
    (void)source, (void)hz_source, (void)hz;
    REG(clock) = 1u << 11 | auxiliary << 5;
}

static inline uint32_t time_us_32(void)
{
    return TIMER_LOW;
}

static inline absolute_time_t get_absolute_time(void)
{
    uint32_t high, low;
    do {
        high = TIMER_HIGH;
        low = TIMER_LOW;
    } while (high != TIMER_HIGH);
    return (uint64_t)high << 32 | low;
}

/* Digits of 16 bits: the core divides no 64. What 32 bits do not hold is left out. */
static inline uint32_t to_ms_since_boot(absolute_time_t us)
{
    const uint32_t middle = (uint32_t)(us >> 32) % 1000 << 16 | (uint32_t)us >> 16;
    const uint32_t last = middle % 1000 << 16 | ((uint32_t)us & 0xffff);
    return (middle / 1000 << 16) + last / 1000;
}

static inline absolute_time_t make_timeout_time_us(uint64_t us)
{
    return get_absolute_time() + us;
}

static inline bool time_reached(absolute_time_t end)
{
    return get_absolute_time() >= end;
}

static inline void busy_wait_us(uint32_t us)
{
    const uint32_t begin = time_us_32();
    while (time_us_32() - begin < us) {
    }
}

static inline void sleep_ms(uint32_t ms)
{
    busy_wait_us(1000 * ms);
}

static inline __attribute__((always_inline)) void busy_wait_at_least_cycles(uint32_t cycles)
{
    __asm volatile("1: subs %0, #3\n\tbcs 1b" : "+l"(cycles) : : "cc", "memory");
}

static inline void tight_loop_contents(void) {}

/* ------------------------------------------------------------------ pins */

#define SIO 0xd0000000u
#define PIN_CONTROL(pin) REG(0x40028004u + 8 * (pin))
#define PIN_PAD(pin) (0x40038004u + 4 * (pin))

enum { GPIO_FUNC_SPI = 1, GPIO_FUNC_UART = 2, GPIO_FUNC_SIO = 5 };
enum { GPIO_OUT = 1, GPIO_IRQ_EDGE_FALL = 4 };
enum { PAD_ISOLATED = 0x100, PAD_OUTPUT_OFF = 0x80, PAD_INPUT = 0x40, PAD_UP = 8, PAD_DOWN = 4 };

struct pin_events {
    uint32_t control[140], intr[6];
};

#define iobank0_hw ((volatile struct pin_events *)0x40028000u)

/* A pad wakes isolated, so that it keeps its level until its function is chosen. */
static inline void gpio_set_function(uint pin, uint32_t function)
{
    REG_SET(PIN_PAD(pin)) = PAD_INPUT;
    REG_CLEAR(PIN_PAD(pin)) = PAD_OUTPUT_OFF;
    PIN_CONTROL(pin) = function;
    REG_CLEAR(PIN_PAD(pin)) = PAD_ISOLATED;
}

static inline void gpio_put(uint pin, bool level)
{
    REG(SIO + (level ? 0x18u : 0x20u)) = 1u << pin;
}

static inline void gpio_set_dir(uint pin, bool out)
{
    REG(SIO + (out ? 0x38u : 0x40u)) = 1u << pin;
}

static inline void gpio_init(uint pin)
{
    gpio_set_dir(pin, false);
    gpio_put(pin, false);
    gpio_set_function(pin, GPIO_FUNC_SIO);
}

static inline void gpio_xor_mask(uint32_t pins)
{
    REG(SIO + 0x28u) = pins;
}

static inline uint32_t gpio_get_all(void)
{
    return REG(SIO + 4u);
}

static inline void gpio_set_pulls(uint pin, bool up, bool down)
{
    REG_CLEAR(PIN_PAD(pin)) = PAD_UP | PAD_DOWN;
    REG_SET(PIN_PAD(pin)) = (up ? PAD_UP : 0) | (down ? PAD_DOWN : 0);
}

static inline void gpio_acknowledge_irq(uint pin, uint32_t events)
{
    iobank0_hw->intr[pin / 8] = events << 4 * (pin % 8);
}

/* ------------------------------------------------------------------ serial port */

struct uart {
    uint32_t data, unused[5], flags, unused_too[2], divisor, fraction, line, control;
};

#define uart0 ((volatile struct uart *)0x40070000u)

static inline void uart_init(volatile struct uart *uart, uint32_t baud)
{
    const uint32_t eighths = (uint32_t)BOARD(CLOCK_KHZ) * 8000u / baud + 1;
    uart->divisor = eighths >> 7;
    uart->fraction = (eighths & 127) >> 1;
    uart->line = 0x70;                  /* 8 bits, queues */
    uart->control = 0x301;              /* on, both ways */
}

static inline void uart_putc(volatile struct uart *uart, char c)
{
    while (uart->flags & 0x20) {
    }
    uart->data = (uint8_t)c;
}

/* ------------------------------------------------------------------ SPI */

typedef struct {
    uint32_t cr0, cr1, dr, sr, cpsr, imsc, ris, mis, icr, dmacr;
} spi_hw_t;

#define spi0 ((volatile spi_hw_t *)0x40080000u)
#define spi1 ((volatile spi_hw_t *)0x40088000u)

enum { SPI_SSPICR_RORIC_BITS = 1, SPI_NOT_FULL = 2, SPI_RECEIVED = 4, SPI_BUSY = 16 };

static inline volatile spi_hw_t *spi_get_hw(volatile spi_hw_t *spi)
{
    return spi;
}

/* Mode 0, 8 bits, at most that fast; bytes that DMA brings are taken. */
static inline void spi_init(volatile spi_hw_t *spi, uint32_t hz)
{
    const uint32_t halves = (uint32_t)BOARD(CLOCK_KHZ) * 500u;
    spi->cpsr = 2;
    spi->cr0 = ((halves + hz - 1) / hz - 1) << 8 | 7;
    spi->dmacr = 2;
    spi->cr1 = 2;
}

static inline bool spi_is_busy(volatile spi_hw_t *spi)
{
    return (spi->sr & SPI_BUSY) != 0;
}

static inline bool spi_is_readable(volatile spi_hw_t *spi)
{
    return (spi->sr & SPI_RECEIVED) != 0;
}

static inline void spi_write_blocking(volatile spi_hw_t *spi, const uint8_t *bytes, uint32_t count)
{
    for (; count > 0; count--) {
        while ((spi->sr & SPI_NOT_FULL) == 0) {
        }
        spi->dr = *bytes++;
    }
}

static inline uint spi_get_dreq(volatile spi_hw_t *spi, bool transmits)
{
    return (spi == spi0 ? 25u : 27u) - transmits;
}

/* ------------------------------------------------------------------ DMA: one channel */

#define DMA 0x50000000u

enum { DMA_SIZE_8 = 0, DMA_IRQ_0 = 10 };

typedef struct {
    uint32_t control;
} dma_channel_config;

static inline int dma_claim_unused_channel(bool required)
{
    (void)required;
    return 0;
}

/* On; it reads one byte after the other, and starts no other channel than itself, which is none. */
static inline dma_channel_config dma_channel_get_default_config(uint channel)
{
    return (dma_channel_config){ 1u | 1u << 4 | channel << 13 };
}

static inline void channel_config_set_transfer_data_size(dma_channel_config *c, uint32_t size)
{
    c->control |= size << 2;
}

static inline void channel_config_set_dreq(dma_channel_config *c, uint dreq)
{
    c->control |= dreq << 17;
}

static inline void dma_channel_configure(uint channel, const dma_channel_config *c, volatile void *to, const void *from,
                                         uint32_t count, bool starts)
{
    (void)channel, (void)from, (void)count, (void)starts;
    REG(DMA + 4u) = (uint32_t)to;
    REG(DMA + 0x10u) = c->control;
}

static inline void dma_channel_set_irq0_enabled(uint channel, bool enabled)
{
    REG(DMA + 0x404u) = (uint32_t)enabled << channel;
}

static inline void dma_channel_acknowledge_irq0(uint channel)
{
    REG(DMA + 0x40cu) = 1u << channel;
}

/* The second register of the two starts it. */
static inline void dma_channel_transfer_from_buffer_now(uint channel, const void *from, uint32_t count)
{
    (void)channel;
    __asm volatile("dmb" : : : "memory");
    REG(DMA + 0x14u) = (uint32_t)from;
    REG(DMA + 0x1cu) = count;
}

/* ------------------------------------------------------------------ interrupts, cores */

/* Of DMA_IRQ_0, the only one. */
extern void (*chip_handler)(void);

static inline void irq_set_exclusive_handler(uint number, void (*handler)(void))
{
    (void)number;
    chip_handler = handler;
}

static inline void irq_set_enabled(uint number, bool enabled)
{
    (void)enabled;
    interrupt_enable(number);
}

static inline uint32_t save_and_disable_interrupts(void)
{
    return interrupts_off();
}

static inline void restore_interrupts(uint32_t state)
{
    interrupts_restore(state);
}

static inline void __wfi(void)
{
    __asm volatile("wfi");
}

/* Core 1 waits in the chip's ROM for these words, each of which it sends back. */
void multicore_launch_core1_with_stack(void (*entry)(void), uint32_t *stack, uint32_t bytes);

/* There is no bus of eight wires. */
static inline void wires_open(void) {}
static inline void wires_drain(void) {}
static inline void wires_put(uint8_t byte) { (void)byte; }
static inline uint wires_dreq(void) { return 0; }
static inline volatile void *wires_queue(void) { return 0; }

#endif
