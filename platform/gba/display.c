/* SPDX-License-Identifier: MIT */
/* display.c - display.h on a Game Boy Advance, 15 bits per pixel.
 *
 * All is mode 3, of 240x160 pixels. A frame of half the screen's size fills the screen, every pixel 2x2, and two such lie side by
 * side in the picture's upper half: the next frame is written to the hidden one, and the interrupt at the start of the vertical
 * blank shows it. Of frames of the screen's own size there is room for one. */
#include "platform/display.h"
#include "platform/gba/gba.h"

enum {
    SCREEN_WIDTH = 240, SCREEN_HEIGHT = 160, PAGE_WIDTH = 120, ROW_BYTES = 2 * SCREEN_WIDTH,
    SHOW_LAYER = 0x0400, MODE = 3,              /* GBA_DISPLAY_CONTROL */
    VERTICAL_BLANK = 1
};

static struct {
    bool is_paged;
    uint32_t hidden;                /* page that is written to */
    volatile bool is_waiting;       /* for the blank that shows the last frame */
    volatile uint32_t blanks;       /* so far: 16.74 ms each */
} screen;

static GBA_FAST void interrupt(void)
{
    if (screen.is_waiting) {
        GBA_BG2_X = (screen.hidden ^ 1) * PAGE_WIDTH << 8;
        screen.is_waiting = false;
    }
    screen.blanks++;
    GBA_INTERRUPT_FLAGS = VERTICAL_BLANK;
    GBA_BIOS_FLAGS |= VERTICAL_BLANK;
}

/* The processor stands still while DMA copies, two cycles per pixel and the time of the memory. */
static int flush(void *user, const smear_band *band)
{
    (void)user;
    while (screen.is_waiting) {
    }
    uint32_t from = (uint32_t)band->pixels, halfwords = (uint32_t)band->width;
    uint32_t to = GBA_VIDEO_MEMORY + (uint32_t)band->y * ROW_BYTES + (screen.hidden * PAGE_WIDTH + (uint32_t)band->x) * 2;
    for (int y = 0; y < band->height; y++) {
        GBA_DMA3_FROM = from;
        GBA_DMA3_TO = to;
        GBA_DMA3_CONTROL = 0x80000000u | halfwords;
        from += band->stride;
        to += ROW_BYTES;
    }
    return 0;
}

bool display_open(smear_desc *desc)
{
    bool is_half = 2 * desc->width == SCREEN_WIDTH && 2 * desc->height == SCREEN_HEIGHT;
    bool is_whole = desc->width == SCREEN_WIDTH && desc->height == SCREEN_HEIGHT;
    if (desc->format != SMEAR_RGB555 || (!is_half && !is_whole))
        return false;
    desc->bands = 1;
    /* Where pages flip, twice as much of a sharp frame is damaged, and nothing is saved. */
    desc->reuse.buffer_age = (desc->methods & SMEAR_SET_TEMPORAL) != 0 ? (uint8_t)(is_half + 1)
                           : desc->methods == SMEAR_SET(SMEAR_NONE)    ? !is_half
                                                                       : 0;
    desc->flush = flush;
    screen.is_paged = is_half;
    screen.hidden = is_half;
    GBA_DISPLAY_CONTROL = SHOW_LAYER | MODE;
    GBA_BG2_X = 0;
    GBA_BG2_XX = GBA_BG2_YY = is_half ? 0x80 : 0x100;
    GBA_HANDLER = interrupt;
    GBA_DISPLAY_STATUS = 8;         /* wants the vertical blank's interrupt */
    GBA_INTERRUPT_ENABLE = VERTICAL_BLANK;
    GBA_INTERRUPT_MASTER = 1;
    return true;
}

void display_attach(smear_context *ctx)
{
    (void)ctx;
}

/* Does not wait: the next frame's first band will, if it comes before the blank. */
void display_show(void)
{
    if (!screen.is_paged)
        return;
    screen.hidden ^= 1;
    screen.is_waiting = true;
}

/* Until the next vertical blank. */
bool display_wait(void)
{
    while (GBA_LINE >= SCREEN_HEIGHT) {
    }
    while (GBA_LINE < SCREEN_HEIGHT) {
    }
    return true;
}

uint32_t display_time(void) { return screen.blanks * 16 + (screen.blanks >> 1) + (screen.blanks >> 2); }

unsigned display_keys(void)
{
    /* A B select start right left up down R L: the shoulders are left and right, B is start. */
    const unsigned held = ~GBA_KEYS;
    return (held & 1 ? KEY_A : 0u) | (held & (8 | 2) ? KEY_START : 0u) | (held & (16 | 256) ? KEY_RIGHT : 0u) |
           (held & (32 | 512) ? KEY_LEFT : 0u) | (held & 64 ? KEY_UP : 0u) | (held & 128 ? KEY_DOWN : 0u);
}
