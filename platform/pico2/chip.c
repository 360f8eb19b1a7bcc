/* SPDX-License-Identifier: MIT */
/* chip.c - an RP2350 from its ROM to main(): the block by which the ROM knows an image (data sheet, 5.9), vectors, clocks,
 * core 1. */
#include "platform/pico2/chip.h"

/* From sections.ld. */
extern uint32_t link_data_load[], link_data_start[], link_data_end[], link_bss_start[], link_bss_end[], link_stack_top[];

int main(void);
void reset_handler(void);

void (*chip_handler)(void);

/* An image that the cores run in their secure state, as they wake, from the vectors at its start. */
__attribute__((section(".image_def"), used)) static const uint32_t image_def[] = {
    0xffffded3,         /* begins */
    0x10210142,         /* an item of one word: a program, secure, for Arm, for an RP2350 */
    0x000001ff,         /* the last: one word lies before it */
    0,                  /* the next block is this one */
    0xab123579          /* ends */
};

void reset_handler(void)
{
    const uint32_t *from = link_data_load;
    for (uint32_t *to = link_data_start; to < link_data_end; to++)
        *to = *from++;
    for (uint32_t *to = link_bss_start; to < link_bss_end; to++)
        *to = 0;
    main();
}

static void fault(void)
{
    for (;;) {
    }
}

static void interrupt(void)
{
    chip_handler();
}

union vector {
    uint32_t *stack;
    void (*handler)(void);
};

/* The first sixteen are the architecture's. */
__attribute__((section(".vectors"), used)) static const union vector vectors[16 + DMA_IRQ_0 + 1] = {
    [0] = { .stack = link_stack_top },
    [1] = { .handler = reset_handler },
    [2] = { .handler = fault }, [3] = { .handler = fault }, [4] = { .handler = fault }, [5] = { .handler = fault },
    [6] = { .handler = fault }, [7] = { .handler = fault }, [11] = { .handler = fault }, [12] = { .handler = fault },
    [14] = { .handler = fault }, [15] = { .handler = fault },
    [16 + DMA_IRQ_0] = { .handler = interrupt }
};

/* ------------------------------------------------------------------ clocks */

#define RESETS 0x40020000u
#define RESETS_DONE REG(RESETS + 8u)
#define CRYSTAL 0x40048000u
#define PLL 0x40050000u
#define CLOCK_REF 0x40010030u
#define CLOCK_SYS 0x4001003cu
#define SELECTED 8u                     /* of a clock: a bit for each source */
#define TICKS_TIMER0 0x40108018u

enum {
    CRYSTAL_KHZ = 12000, MULTIPLE = 125, VCO_KHZ = CRYSTAL_KHZ * MULTIPLE,
    RESET_DMA = 1 << 2, RESET_PINS = 1 << 6, RESET_PADS = 1 << 9, RESET_PLL = 1 << 14, RESET_SPI = 3 << 18, RESET_TIMER = 1 << 23,
    RESET_UART = 1 << 26,
    RESET_USED = RESET_DMA | RESET_PINS | RESET_PADS | RESET_PLL | RESET_SPI | RESET_TIMER | RESET_UART
};

/* The last divider has two factors of 1 to 7, of which the first is the greater. */
enum { DIVIDER = VCO_KHZ / BOARD(CLOCK_KHZ), FIRST = DIVIDER % 5 == 0 ? 5 : 6, SECOND = DIVIDER / FIRST };
_Static_assert(BOARD(CLOCK_KHZ) * FIRST * SECOND == VCO_KHZ && SECOND <= FIRST,
               "boards.h: 150000 kHz, or another whole part of 1500 MHz by 5 or 6");

static void select(uint32_t clock, uint32_t source, uint32_t bit)
{
    REG(clock) = source;
    while ((REG(clock + SELECTED) & bit) == 0) {
    }
}

void set_sys_clock_khz(uint32_t khz, bool required)
{
    (void)khz, (void)required;
    /* The crystal needs a millisecond to swing: 47 times 256 of its cycles. */
    REG(CRYSTAL) = 0xaa0;
    REG(CRYSTAL + 0xcu) = 47;
    REG_SET(CRYSTAL) = 0xfab000;
    while ((REG(CRYSTAL + 4u) & 1u << 31) == 0) {
    }
    /* Nothing may run by the PLL while it is reset. */
    REG_CLEAR(CLOCK_SYS) = 1;
    while ((REG(CLOCK_SYS + SELECTED) & 1) == 0) {
    }
    select(CLOCK_REF, 2, 1u << 2);      /* the crystal */
    REG_SET(RESETS) = RESET_USED;
    REG_CLEAR(RESETS) = RESET_USED;
    while ((RESETS_DONE & (RESET_USED & ~(RESET_SPI | RESET_UART))) != (RESET_USED & ~(RESET_SPI | RESET_UART))) {
    }
    REG(PLL) = 1;
    REG(PLL + 8u) = MULTIPLE;
    REG_CLEAR(PLL + 4u) = 0x21;         /* power of the PLL and of its oscillator; then of the dividers */
    while ((REG(PLL) & 1u << 31) == 0) {
    }
    REG(PLL + 0xcu) = FIRST << 16 | SECOND << 12;
    REG_CLEAR(PLL + 4u) = 8;
    REG(CLOCK_SYS) = 0;
    select(CLOCK_SYS, 1, 1u << 1);
    clock_configure(clk_peri, 0, CLOCKS_CLK_PERI_CTRL_AUXSRC_VALUE_CLK_SYS, 0, 0);
    while ((RESETS_DONE & RESET_USED) != RESET_USED) {
    }
    REG(TICKS_TIMER0 + 4u) = CRYSTAL_KHZ / 1000;
    REG(TICKS_TIMER0) = 1;
}

/* ------------------------------------------------------------------ core 1 */

#define FIFO_STATUS REG(SIO + 0x50u)
#define FIFO_WRITE REG(SIO + 0x54u)
#define FIFO_READ REG(SIO + 0x58u)

enum { FIFO_VALID = 1, FIFO_READY = 2 };

void multicore_launch_core1_with_stack(void (*entry)(void), uint32_t *stack, uint32_t bytes)
{
    const uint32_t word[] = { 0, 0, 1, (uint32_t)vectors, (uint32_t)stack + bytes, (uint32_t)entry };
    for (uint32_t i = 0; i < sizeof word / sizeof *word;) {
        while (word[i] == 0 && (FIFO_STATUS & FIFO_VALID))
            (void)FIFO_READ;
        __asm volatile("sev");
        while ((FIFO_STATUS & FIFO_READY) == 0) {
        }
        FIFO_WRITE = word[i];
        __asm volatile("sev");
        while ((FIFO_STATUS & FIFO_VALID) == 0)
            __asm volatile("wfe");
        i = FIFO_READ == word[i] ? i + 1 : 0;
    }
}
