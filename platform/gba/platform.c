/* SPDX-License-Identifier: MIT */
/* platform.c - platform.h on a Game Boy Advance.
 *
 * Text goes to mGBA's debug port, line by line; on a console nobody hears it. The clock is timers 0
 * and 1, cascaded: 32 bits of processor cycles. */
#include "platform/platform.h"
#include "platform/common/arguments.h"
#include "platform/gba/gba.h"
#include "platform/gba/stage.h"
#include "platform/print.h"
#include "smear_config.h"

#include <stdbool.h>

#ifndef GBA_SAYS_PLACES
#define GBA_SAYS_PLACES 0
#endif

enum { LINE_BYTES = 200 };

extern const char gba_command_line[];

int main(int argc, char **argv);
void gba_main(void);

const char platform_clock_unit[] = "cycles";

extern uint8_t link_fast_end[], link_warm_start[], link_context[], link_stack_limit[];
extern uint8_t link_assemble_load[], link_assemble_size[], link_draw_load[], link_draw_size[];

void gba_enter_stage(int stage)
{
    static int entered = SMEAR_STAGE_DRAW;        /* start.S */
    static uint8_t *const load[] = { link_assemble_load, link_draw_load };
    static uint8_t *const size[] = { link_assemble_size, link_draw_size };
    const uint32_t assembles = (uint32_t)link_assemble_size, all = (uint32_t)size[stage];
    const uint32_t words = (assembles < all ? assembles : all) / 4;     /* no more than the other stage's lie in the place of */
    if (words == 0 || stage == entered)
        return;
    entered = stage;
    GBA_DMA3_FROM = (uint32_t)load[stage];
    GBA_DMA3_TO = (uint32_t)link_fast_end;
    GBA_DMA3_CONTROL = 0x84000000u | words;
}

/* For places.sh: the arena as it is without places. */
static void say_place(int part, uint32_t address, uint32_t bytes)
{
    platform_print("place ");
    print_decimal((uint32_t)part);
    platform_print(" ");
    print_hex(address);
    platform_print(" ");
    print_decimal(bytes);
    platform_print("\n");
}

/* The context lies in fast memory. Two frames of half the screen's size lie side by side in the upper half of video memory's
 * picture (display.c). From there to the functions at its end it takes 2 cycles for 32 bits, where the arena takes 6. Writes of
 * single bytes go wrong there, so that parts with such stay. */
void *gba_place(int is_half, int part, void *address, uint32_t bytes)
{
    enum { SHOWN = 240 * 80 * 2 };
    static uint32_t end;                        /* of what is taken */
    if (address != NULL && GBA_SAYS_PLACES)
        say_place(part, (uint32_t)address, bytes);
    if (address == NULL || GBA_SAYS_PLACES || !is_half)
        return address;
    if (part == SMEAR_PART_CONTEXT && bytes <= (uint32_t)(link_stack_limit - link_context))
        return link_context;
    if (part == SMEAR_PART_COLOR)               /* the first of a context */
        end = GBA_VIDEO_MEMORY + SHOWN;
    if (part != SMEAR_PART_COLOR && part != SMEAR_PART_DEPTH && part != SMEAR_PART_INSTANTS && part != SMEAR_PART_BAND
        && part != SMEAR_PART_LINES)
        return address;
    const uint32_t at = end;
    if (bytes > (uint32_t)link_warm_start - at)
        return address;
    end = at + ((bytes + 7u) & ~7u);
    return (void *)at;
}

/* What the compiler calls for a memory barrier: one core that does everything in order needs none. */
void gba_barrier(void) __asm("__sync_synchronize");
void gba_barrier(void)
{
}

static void send_line(const char *text)
{
    volatile char *port = (volatile char *)0x04fff600u;
    GBA_REG16(0x04fff780u) = 0xc0de;
    if (GBA_REG16(0x04fff780u) != 0x1dea)
        return;
    do
        *port++ = *text;
    while (*text++ != '\0');
    GBA_REG16(0x04fff700u) = 0x100 | 3;
}

void platform_print(const char *text)
{
    static char line[LINE_BYTES];
    static uint32_t length;
    for (; *text != '\0'; text++) {
        bool ends = *text == '\n';
        if (!ends)
            line[length++] = *text;
        if (ends || length == LINE_BYTES - 1) {
            line[length] = '\0';
            send_line(line);
            length = 0;
        }
    }
}

void platform_clock_start(void)
{
    GBA_TIMER0_CONTROL = 0;
    GBA_TIMER1_CONTROL = 0;
    GBA_TIMER0 = 0;
    GBA_TIMER1 = 0;
    GBA_TIMER1_CONTROL = 0x84;      /* counts overflows of timer 0 */
    GBA_TIMER0_CONTROL = 0x80;
}

uint32_t platform_clock(void)
{
    uint32_t high, low, again;
    do {
        high = GBA_TIMER1;
        low = GBA_TIMER0;
        again = GBA_TIMER1;
    } while (high != again);
    return high << 16 | low;
}

uint32_t platform_clock_count(uint32_t ticks)
{
    return ticks;
}

/* The status goes to gbarun; on a console, all stands still. */
static void leave(int status)
{
    char text[] = "#exit 000\n";
    uint32_t value = (uint32_t)status & 0xffu;
    for (int i = 8; i >= 6; i--, value /= 10)
        text[i] = (char)('0' + value % 10);
    platform_print(text);
    for (;;) {
    }
}

void gba_main(void)
{
    static char line[COMMAND_LINE_BYTES] = "program ";
    static char *argument[MAX_ARGUMENTS + 1];
    for (int at = 8; at < COMMAND_LINE_BYTES - 1; at++)
        line[at] = ((const volatile char *)gba_command_line)[at - 8];
    leave(main(arguments_split(line, argument), argument));
}
