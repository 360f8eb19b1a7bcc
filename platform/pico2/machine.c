/* SPDX-License-Identifier: MIT */
/* machine.c - what of an RP2350 and of a board QEMU lacks, for images of chip.h. It runs on QEMU's musca-b1, whose two Cortex-M33
 * have memory where an RP2350 has flash and RAM.
 *
 *     machine [--frames N] [--keys FRAME:MASK,...] [--shot FILE]      run.sh starts it, with the image and its arguments
 *
 * It does as the chip's ROM: it looks for the block that makes an image one, starts core 0 by the image's vectors, and core 1 by
 * words of the FIFO. The protection unit lets an image reach its memory alone: where it reaches for a register, a fault comes here,
 * and this does what the register would. What a real chip would not take (a peripheral in reset, a wrong clock, a pin that is
 * isolated or has another function, a byte that the panel does not want) ends the run. The panel's frames, and keys, are as those
 * of platform/pico/run.mjs. No time passes between a band and its interrupt. */
#include "platform/common/arguments.h"
#include "platform/common/semihost.h"
#include "platform/pico/board.h"
#include "platform/words.h"

#include <stdbool.h>
#include <stddef.h>

#define REG(address) (*(volatile uint32_t *)(address))

/* Of the chip. Those whose names begin alike lie in one block. */
#define RESETS 0x40020000u
#define RESETS_DONE 0x40020008u
#define CRYSTAL 0x40048000u
#define CRYSTAL_STATUS 0x40048004u
#define PLL 0x40050000u
#define PLL_POWER 0x40050004u
#define PLL_MULTIPLE 0x40050008u
#define PLL_DIVIDERS 0x4005000cu
#define CLOCK_REF 0x40010030u
#define CLOCK_REF_SELECTED 0x40010038u
#define CLOCK_SYS 0x4001003cu
#define CLOCK_SYS_SELECTED 0x40010044u
#define CLOCK_PERI 0x40010048u
#define PINS 0x40028000u
#define PADS 0x40038000u
#define UART 0x40070000u
#define UART_FLAGS 0x40070018u
#define SPI0 0x40080000u
#define SPI1 0x40088000u
#define SPI0_DATA 0x40080008u
#define SPI1_DATA 0x40088008u
#define SPI0_STATUS 0x4008000cu
#define SPI1_STATUS 0x4008800cu
#define TIMER 0x400b0000u
#define TIMER_HIGH 0x400b0024u
#define TIMER_LOW 0x400b0028u
#define TICKS 0x40108018u
#define TICKS_CYCLES 0x4010801cu
#define DMA 0x50000000u
#define DMA_TO 0x50000004u
#define DMA_CONTROL 0x50000010u
#define DMA_FROM 0x50000014u
#define DMA_COUNT_STARTS 0x5000001cu
#define DMA_RAISED 0x50000400u
#define DMA_ENABLED 0x50000404u
#define DMA_STATUS 0x5000040cu
#define SIO_CORE 0xd0000000u
#define SIO_IN 0xd0000004u
#define SIO_SET 0xd0000018u
#define SIO_CLEAR 0xd0000020u
#define SIO_TOGGLE 0xd0000028u
#define SIO_DRIVE 0xd0000038u
#define SIO_RELEASE 0xd0000040u
#define FIFO_STATUS 0xd0000050u
#define FIFO_WRITE 0xd0000054u
#define FIFO_READ 0xd0000058u
#define BLOCK(address) ((address) >> 14)

/* Of the core. */
#define CORE_FAULT 0xe000ed28u
#define CORE_FAULT_ADDRESS 0xe000ed34u
#define CORE_PEND 0xe000e200u
#define CORE_ENABLE 0xe000e100u
#define CORE_VECTORS 0xe000ed08u
#define PROTECTION_KIND 0xe000edc0u
#define PROTECTION_REGION 0xe000ed98u
#define PROTECTION_BASE 0xe000ed9cu
#define PROTECTION_LIMIT 0xe000eda0u
#define PROTECTION 0xe000ed94u

enum { WRONG = 2, COLUMNS = 0x2a, ROWS = 0x2b, MEMORY = 0x2c };

void start(void);
void fault(void);
void fault_at(uint32_t *saved);

/* ------------------------------------------------------------------ ends */

static void print_number(uint32_t value, uint32_t base, int digits)
{
    char text[12];
    int at = sizeof text - 1;
    text[at] = '\0';
    do
        text[--at] = "0123456789abcdef"[value % base];
    while ((value /= base) != 0 || at > (int)sizeof text - 1 - digits);
    semihost_print(text + at);
}

static _Noreturn void fail(const char *what, uint32_t value)
{
    semihost_print("machine.c: ");
    semihost_print(what);
    semihost_print(" ");
    print_number(value, 16, 1);
    semihost_print("\n");
    semihost_exit(WRONG);
}

static void demand(bool is_so, const char *what, uint32_t value)
{
    if (!is_so)
        fail(what, value);
}

/* ------------------------------------------------------------------ registers without a will of their own */

static struct word {
    uint32_t address, value;
} words[256];

/* A pad is isolated and pulled down, the PLL has no power, everything is held in reset, until it is written. */
static uint32_t first_value(uint32_t address)
{
    return BLOCK(address) == BLOCK(PADS) ? 0x116 : address == PLL_POWER ? 0x2d : address == RESETS ? 0x1fffffff : 0;
}

static uint32_t *word_at(uint32_t address)
{
    struct word *word = words;
    while (word->address != address) {
        if (word->address == 0)
            *word = (struct word){ address, first_value(address) };
        else if (++word == words + sizeof words / sizeof *words)
            fail("more registers than there is room for, at", address);
    }
    return &word->value;
}

static uint32_t value_of(uint32_t address)
{
    return *word_at(address);
}

static const struct {
    uint32_t base, reset;
} peripherals[] = {
    { PINS, 1u << 6 }, { PADS, 1u << 9 }, { PLL, 1u << 14 }, { UART, 1u << 26 }, { SPI0, 1u << 18 },
    { SPI1, 1u << 19 }, { TIMER, 1u << 23 }, { DMA, 1u << 2 }
};

/* By the crystal and what the PLL makes of it, in kHz; 0: not by the PLL. */
static uint32_t system_khz(void)
{
    const uint32_t dividers = value_of(PLL_DIVIDERS), last = (dividers >> 16 & 7) * (dividers >> 12 & 7);
    const bool has_power = (value_of(PLL_POWER) & 0x29) == 0, by_pll = value_of(CLOCK_SYS) == 1;
    return has_power && by_pll && last > 0 ? 12000 * value_of(PLL_MULTIPLE) / last : 0;
}

static void demand_awake(uint32_t address)
{
    for (size_t i = 0; i < sizeof peripherals / sizeof *peripherals; i++)
        if (BLOCK(peripherals[i].base) == BLOCK(address))
            demand((value_of(RESETS) & peripherals[i].reset) == 0, "is held in reset:", address);
    if (BLOCK(address) == BLOCK(UART) || BLOCK(address) == BLOCK(SPI0) || BLOCK(address) == BLOCK(SPI1))
        demand(value_of(CLOCK_PERI) == 0x800 && system_khz() == BOARD(CLOCK_KHZ), "has another clock:", address);
}

/* ------------------------------------------------------------------ pins */

static uint32_t out, drives, in;

static bool has_function(int pin, uint32_t function)
{
    return value_of(PINS + 4 + 8 * (uint32_t)pin) == function && (value_of(PADS + 4 + 4 * (uint32_t)pin) & 0x180) == 0;
}

/* What a pin is driven to. */
static bool level(int pin)
{
    demand(has_function(pin, 5) && drives >> pin & 1, "nobody drives pin", (uint32_t)pin);
    return out >> pin & 1;
}

/* A mask of enum display_key. */
static void press(uint32_t mask)
{
    static const int pins[] = { BOARD(UP), BOARD(DOWN), BOARD(LEFT), BOARD(RIGHT), BOARD(A), BOARD(START) };
    for (int i = 0; i < 6; i++)
        if (pins[i] != NO_PIN)
            in = (in & ~(1u << pins[i])) | (uint32_t)((mask >> i & 1) == BOARD(LEVEL)) << pins[i];
}

/* ------------------------------------------------------------------ the panel, as panel.mjs has it */

static struct {
    const char *keys, *shot;
    uint32_t wanted, shown, looks;
    uint32_t seen;              /* commands up to 3fh: those that are wanted at the end */
    int code, count, half;
    int window[4], column, row;
    uint8_t data[4], pixels[BOARD(HEIGHT)][BOARD(WIDTH)][2];
} panel = { .wanted = UINT32_MAX };

static void take_pixel(uint8_t byte)
{
    demand(panel.column < BOARD(WIDTH) && panel.row < BOARD(HEIGHT), "pixels outside of the glass, in row", (uint32_t)panel.row);
    panel.pixels[panel.row][panel.column][panel.half] = byte;
    panel.half ^= 1;
    if (panel.half == 0 && ++panel.column > panel.window[1]) {
        panel.column = panel.window[0];
        panel.row++;
    }
}

static void take_byte(uint8_t byte)
{
    demand(has_function(BOARD(CLK), 1) && has_function(BOARD(DATA), 1), "the pins are not SPI's:", BOARD(CLK));
    demand(!level(BOARD(CS)), "the panel is not selected for", byte);
    if (BOARD(RESET) != NO_PIN)
        demand(level(BOARD(RESET)), "the panel is held in reset:", byte);
    if (!level(BOARD(DC))) {
        panel.code = byte;
        panel.count = panel.half = 0;
        panel.column = panel.window[0];
        panel.row = panel.window[2];
        panel.seen |= byte == 0x11 ? 1 : byte == 0x29 ? 2 : byte == 0x21 ? 4 : 0;
    } else if (panel.code == MEMORY) {
        take_pixel(byte);
    } else if (panel.code == COLUMNS || panel.code == ROWS) {
        demand(panel.count < 4, "a range has more than four bytes:", byte);
        panel.data[panel.count++] = byte;
        int *range = panel.code == COLUMNS ? panel.window : panel.window + 2;
        const int from = panel.code == COLUMNS ? BOARD(X) : BOARD(Y);
        range[0] = (panel.data[0] << 8 | panel.data[1]) - from;
        range[1] = (panel.data[2] << 8 | panel.data[3]) - from;
    } else {
        demand((panel.code == 0x36 && byte == BOARD(MADCTL)) || (panel.code == 0x3a && byte == 0x55), "the panel does not want", byte);
    }
}

static uint32_t crc(const uint8_t *bytes, size_t count)
{
    uint32_t c = ~0u;
    for (size_t i = 0; i < count; i++) {
        c ^= bytes[i];
        for (int bit = 0; bit < 8; bit++)
            c = c >> 1 ^ (0xedb88320u & (0u - (c & 1)));
    }
    return ~c;
}

/* A PPM file; the board's width and height have three digits. */
static void save(const char *path)
{
    static uint8_t row[3 * BOARD(WIDTH)];
#define DIGITS(n) '0' + (n) / 100, '0' + (n) / 10 % 10, '0' + (n) % 10
    static const char head[] = { 'P', '6', ' ', DIGITS(BOARD(WIDTH)), ' ', DIGITS(BOARD(HEIGHT)), ' ', '2', '5', '5', '\n' };
    enum { WRITE_BINARY = 5 };
    const int file = semihost_open(path, WRITE_BINARY);
    semihost_write(file, head, sizeof head);
    for (int y = 0; y < BOARD(HEIGHT); y++) {
        for (int x = 0; x < BOARD(WIDTH); x++) {
            const int code = panel.pixels[y][x][0] << 8 | panel.pixels[y][x][1];
            row[3 * x] = (uint8_t)(code >> 11 << 3 | code >> 13);
            row[3 * x + 1] = (uint8_t)((code >> 5 & 63) << 2 | (code >> 9 & 3));
            row[3 * x + 2] = (uint8_t)((code & 31) << 3 | (code >> 2 & 7));
        }
        semihost_write(file, row, sizeof row);
    }
    semihost_close(file);
}

/* The keys that are held from a frame on. */
static void hold_keys(uint32_t frame)
{
    for (const char *text = panel.keys; text != NULL && *text != '\0';) {
        const uint32_t from = read_decimal(text);
        while (*text != ':' && *text != '\0')
            text++;
        if (from == frame && *text == ':')
            press(read_decimal(text + 1));
        while (*text != '\0' && *text++ != ',') {
        }
    }
}

/* The board's light changes with every frame. */
static void end_frame(void)
{
    if (panel.wanted == UINT32_MAX)
        return;
    print_number(panel.shown, 10, 1);
    semihost_print(" ");
    print_number(crc(&panel.pixels[0][0][0], sizeof panel.pixels), 16, 8);
    semihost_print("\n");
    if (++panel.shown < panel.wanted)
        return;
    demand(panel.seen == (BOARD(INVERTED) ? 7 : 3) && (BOARD(LIGHT) == NO_PIN || level(BOARD(LIGHT))), "the panel is dark:",
           panel.seen);
    if (panel.shot != NULL)
        save(panel.shot);
    semihost_exit(0);
}

static void write_pins(uint32_t levels)
{
    const uint32_t changed = out ^ levels;
    out = levels;
    if (BOARD(LED) != NO_PIN && changed >> BOARD(LED) & 1 && drives >> BOARD(LED) & 1)
        end_frame();
}

/* ------------------------------------------------------------------ text */

/* A line "#exit N" ends the run. */
static void take_text(char c)
{
    static char line[256];
    static uint32_t length;
    line[length++] = c;
    if (c != '\n' && length < sizeof line - 1)
        return;
    line[length] = '\0';
    length = 0;
    if (line[0] == '#' && line[1] == 'e')
        semihost_exit((int)read_decimal(line + 6));
    semihost_print(line);
}

/* ------------------------------------------------------------------ cores, interrupts, time */

#define MUSCA_CPU 0x5001f000u           /* which core asks */
#define MUSCA_CONTROL 0x50021000u       /* where core 1 starts; which cores wait */
#define MUSCA_MAILBOX 0x50003000u       /* interrupt 6 of core 0 */
#define MUSCA_TIMER 0x50000000u         /* counts down, by 40 MHz */
#define IMAGE 0x10000000u

enum { MAILBOX_INTERRUPT = 6, DMA_INTERRUPT = 10, VECTORS = 64 };

static void interrupt_core0(void)
{
    if (REG(MUSCA_CPU) == 0)
        REG(CORE_PEND) = 1u << DMA_INTERRUPT;
    else
        REG(MUSCA_MAILBOX + 4u) = 1;
}

static void mailbox(void)
{
    REG(MUSCA_MAILBOX + 8u) = 1;
    REG(CORE_PEND) = 1u << DMA_INTERRUPT;
}

/* The image's, but for faults and the mailbox. */
static uint32_t vectors[VECTORS] __attribute__((aligned(512)));

/* What core 1 is to start with, of the words that it was sent. */
static struct {
    uint32_t word[6], answer;
    int count;
    bool has_answer;
} fifo;

static void start_core1(void);

/* QEMU reads the first two as they lie in this program's file. */
static const union {
    uint32_t stack;
    void (*handler)(void);
} core1_vectors[16] __attribute__((aligned(512))) = {
    { .stack = 0x1a480000u - 2048 }, { .handler = start_core1 }, [3] = { .handler = fault }
};

static void take_word(uint32_t word)
{
    demand(fifo.count < 6, "core 1 runs, and got", word);
    fifo.word[fifo.count] = fifo.answer = word;
    fifo.has_answer = true;
    /* Anything that does not begin so begins anew. */
    fifo.count = fifo.count < 3 && word != (uint32_t)(fifo.count == 2) ? 0 : fifo.count + 1;
    if (fifo.count < 6)
        return;
    demand(fifo.word[3] == IMAGE, "core 1's vectors are not the image's:", fifo.word[3]);
    REG(MUSCA_CONTROL + 0x114u) = (uint32_t)core1_vectors;
    REG(MUSCA_CONTROL + 0x118u) = 0;
}

/* One instruction is one cycle where QEMU counts them, by 8 ns each. */
static uint64_t microseconds(void)
{
    static uint32_t before;
    static uint64_t ticks;
    demand(value_of(TICKS_CYCLES) == 12 && value_of(TICKS) == 1 && value_of(CLOCK_REF) == 2, "the timer has no ticks:", TICKS);
    const uint32_t now = 0u - REG(MUSCA_TIMER + 4u);
    ticks += now - before;
    before = now;
    return ticks * 25 / 8 / (BOARD(CLOCK_KHZ) / 1000);
}

/* ------------------------------------------------------------------ registers */

static void run_dma(uint32_t count)
{
    const uint32_t control = value_of(DMA_CONTROL), queue = value_of(DMA_TO);
    const bool first = queue == SPI0_DATA;
    const uint8_t *from = (const uint8_t *)value_of(DMA_FROM);
    demand((first || queue == SPI1_DATA) && (control & 0x7fffffu) == (0x11u | (first ? 24u : 26u) << 17), "DMA brings bytes to SPI alone:",
           control);
    demand(value_of(queue + 0x1cu) == 2, "SPI does not ask for DMA:", queue);
    for (; count > 0; count--)
        take_byte(*from++);
    *word_at(DMA_RAISED) |= 1;
    if (value_of(DMA_ENABLED) & 1)
        interrupt_core0();
}

static uint32_t read(uint32_t address)
{
    switch (address) {
    case RESETS_DONE: return ~value_of(RESETS) & 0x1fffffffu;
    case CRYSTAL_STATUS: return value_of(CRYSTAL) == 0xfabaa0 ? 1u << 31 : 0;
    case PLL: return value_of(address) | (uint32_t)((value_of(PLL_POWER) & 0x21) == 0) << 31;
    case CLOCK_REF_SELECTED: return 1u << (value_of(CLOCK_REF) & 3);
    case CLOCK_SYS_SELECTED: return 1u << (value_of(CLOCK_SYS) & 1);
    case UART_FLAGS: return 0;
    case SPI0_STATUS: case SPI1_STATUS: return 3;
    case TIMER_HIGH: return (uint32_t)(microseconds() >> 32);
    case TIMER_LOW: return (uint32_t)microseconds();
    case DMA_STATUS: return value_of(DMA_RAISED) & value_of(DMA_ENABLED);
    case SIO_CORE: return REG(MUSCA_CPU);
    case SIO_IN:
        /* A program looks at the keys once before its loop and once for each frame. */
        if (++panel.looks > 2)
            hold_keys(panel.looks - 2);
        return in;
    case FIFO_STATUS: return 2u | fifo.has_answer;
    case FIFO_READ: fifo.has_answer = false; return fifo.answer;
    default: return value_of(address);
    }
}

/* Half of the clock, divided, at most as fast as the panel; 8 bits. */
#define SPI_MODE (((uint32_t)((BOARD(CLOCK_KHZ) / 2 + BOARD(BUS_KHZ) - 1) / BOARD(BUS_KHZ)) - 1) << 8 | 7)

static void write(uint32_t address, uint32_t value)
{
    switch (address) {
    case UART: take_text((char)value); break;
    case SPI0_DATA: case SPI1_DATA:
        demand(value_of(address - 4) == 2 && value_of(address - 8) == SPI_MODE && value_of(address + 8) == 2,
               "SPI is off, or other than the panel wants:", address);
        take_byte((uint8_t)value);
        break;
    case DMA_COUNT_STARTS: run_dma(value); break;
    case DMA_STATUS: *word_at(DMA_RAISED) &= ~value; break;
    case SIO_SET: write_pins(out | value); break;
    case SIO_CLEAR: write_pins(out & ~value); break;
    case SIO_TOGGLE: write_pins(out ^ value); break;
    case SIO_DRIVE: drives |= value; break;
    case SIO_RELEASE: drives &= ~value; break;
    case FIFO_WRITE: take_word(value); break;
    default: *word_at(address) = value;
    }
}

static void store(uint32_t address, uint32_t value)
{
    const uint32_t plain = address >> 30 == 1 ? address & ~0x3000u : address;
    demand_awake(plain);
    switch (address - plain) {
    case 0x0000u: write(plain, value); break;
    case 0x1000u: write(plain, value_of(plain) ^ value); break;
    case 0x2000u: write(plain, value_of(plain) | value); break;
    default: write(plain, value_of(plain) & ~value); break;
    }
}

/* ------------------------------------------------------------------ faults */

/* From the lowest word up: r4 to r11, the return code, then what the core has saved: r0 to r3, r12, lr, pc, status. */
enum { SAVED_R4 = 0, SAVED_CODE = 8, SAVED_R0 = 9, SAVED_R12 = 13, SAVED_PC = 15, SAVED_STATUS = 16 };

static uint32_t *register_of(uint32_t *saved, uint32_t number)
{
    demand(number < 13 || number == 14, "an instruction that is not known here uses register", number);
    return number < 4 ? &saved[SAVED_R0 + number] : number < 12 ? &saved[SAVED_R4 + number - 4] : &saved[SAVED_R12 + (number == 14)];
}

/* Loads and stores of words and bytes, without writing back. */
static bool decode(const uint16_t *code, uint32_t *number, bool *loads)
{
    if (code[0] >> 13 == 3) {                                       /* 011: words and bytes, by a constant */
        *number = code[0] & 7;
        *loads = code[0] >> 11 & 1;
        return true;
    }
    if (code[0] >> 12 == 5 && (code[0] >> 9 & 3) % 2 == 0) {        /* 0101: by a register */
        *number = code[0] & 7;
        *loads = code[0] >> 11 & 1;
        return (code[0] >> 9 & 7) != 6 || *loads;
    }
    if ((code[0] & 0xff20) == 0xf800) {                             /* 32 bits: without a sign, not of halves */
        *number = code[1] >> 12;
        *loads = code[0] >> 4 & 1;
        return code[0] >> 7 & 1 || (code[1] & 0xfc0) == 0 || (code[1] & 0xd00) == 0xc00;
    }
    return false;
}

/* Behind the instruction, of which a block of `it` may have been part. */
static void step_over(uint32_t *saved, uint32_t bytes)
{
    uint32_t status = saved[SAVED_STATUS], it = (status >> 25 & 3) | (status >> 8 & 0xfc);
    it = (it & 7) == 0 ? 0 : (it & 0xe0) | (it << 1 & 0x1f);
    saved[SAVED_STATUS] = (status & ~0x0600fc00u) | (it & 3) << 25 | (it & 0xfc) << 8;
    saved[SAVED_PC] += bytes;
}

static bool is_taken;

void fault_at(uint32_t *saved)
{
    const uint32_t why = REG(CORE_FAULT), address = REG(CORE_FAULT_ADDRESS);
    const uint16_t *code = (const uint16_t *)saved[SAVED_PC];
    uint32_t number;
    bool loads;
    while (__atomic_exchange_n(&is_taken, true, __ATOMIC_ACQUIRE)) {
    }
    demand((why & 0x82) == 0x82 && address >= 0x40000000u, "the image has a fault at", saved[SAVED_PC]);
    demand(decode(code, &number, &loads), "an instruction that is not known here, at", saved[SAVED_PC]);
    if (loads) {
        demand_awake(address);
        *register_of(saved, number) = read(address);
    } else {
        store(address, *register_of(saved, number));
    }
    step_over(saved, code[0] >> 11 >= 29 ? 4 : 2);
    REG(CORE_FAULT) = why;
    __atomic_store_n(&is_taken, false, __ATOMIC_RELEASE);
}

__attribute__((naked)) void fault(void)
{
    __asm volatile("push {r4-r11, lr}\n\t"
                   "mov r0, sp\n\t"
                   "bl fault_at\n\t"
                   "pop {r4-r11, pc}");
}

/* ------------------------------------------------------------------ start */

/* Flash may be read and run, RAM and what lies here may be all; nothing else may be touched, but by handlers of faults. */
static void protect(void)
{
    static const uint32_t region[][2] = {
        { IMAGE | 6, IMAGE + 0x400000u - 32 }, { 0x20000000u | 2, 0x20080000u - 32 }, { 0x1a400000u | 2, 0x1a480000u - 32 }
    };
    REG(PROTECTION_KIND) = 0xff;
    for (uint32_t i = 0; i < 3; i++) {
        REG(PROTECTION_REGION) = i;
        REG(PROTECTION_BASE) = region[i][0];
        REG(PROTECTION_LIMIT) = region[i][1] | 1;
    }
    REG(PROTECTION) = 1;
    __asm volatile("dsb\n\tisb");
}

static _Noreturn void go(uint32_t stack, uint32_t entry)
{
    __asm volatile("msr msp, %0\n\tbx %1" : : "r"(stack), "r"(entry));
    __builtin_unreachable();
}

static void start_core1(void)
{
    protect();
    go(fifo.word[4], fifo.word[5]);
}

/* The chip's ROM takes an image with a block in its first 4 kB, of items of which one says what it is, that ends as it says. */
static bool is_image(void)
{
    for (uint32_t at = IMAGE; at < IMAGE + 4096 - 16; at += 4)
        if (REG(at) == 0xffffded3u) {
            bool is_program = false;
            uint32_t item = at + 4;
            while ((REG(item) & 0xff) != 0xff && item < IMAGE + 4096) {
                is_program = is_program || REG(item) == 0x10210142u;
                item += 4 * (REG(item) & 0x80 ? REG(item) >> 8 & 0xffff : REG(item) >> 8 & 0xff);
            }
            return is_program && REG(item) >> 8 == (item - at) / 4 - 1 && REG(item + 8) == 0xab123579u;
        }
    return false;
}

static void begin(void)
{
    static char line[256];
    static char *word[MAX_ARGUMENTS + 1];
    const int count = semihost_command_line(line, sizeof line) ? arguments_split(line, word) : 0;
    for (int i = 1; i + 1 < count; i += 2) {
        if (is_word(word[i], "--frames"))
            panel.wanted = read_decimal(word[i + 1]);
        else if (is_word(word[i], "--keys"))
            panel.keys = word[i + 1];
        else if (is_word(word[i], "--shot"))
            panel.shot = word[i + 1];
        else
            fail("there is no such option:", (uint32_t)i);
    }
    demand(is_image(), "no block of an image lies in the first 4 kB of", IMAGE);
    press(0);
    hold_keys(0);
    REG(MUSCA_TIMER + 8u) = REG(MUSCA_TIMER + 4u) = UINT32_MAX;
    REG(MUSCA_TIMER) = 1;
    for (uint32_t i = 0; i < VECTORS; i++)
        vectors[i] = i < 16 + DMA_INTERRUPT + 1 ? REG(IMAGE + 4 * i) : 0;
    vectors[3] = (uint32_t)fault;
    vectors[16 + MAILBOX_INTERRUPT] = (uint32_t)mailbox;
    REG(CORE_VECTORS) = (uint32_t)vectors;
    REG(CORE_ENABLE) = 1u << MAILBOX_INTERRUPT;
    protect();
    go(vectors[0], vectors[1]);
}

/* The loader sets no stack. */
__attribute__((naked, section(".text.start"))) void start(void)
{
    __asm volatile("ldr r0, =0x1a480000\n\t"
                   "mov sp, r0\n\t"
                   "b %0" : : "i"(begin));
}
