/* SPDX-License-Identifier: MIT */
/* display.c - display.h on HDMI: two pages of 16 bits per pixel, which the firmware scales to the screen.
 *
 * Bands are copied to the hidden page. The firmware is asked to show it and to answer at the next vertical blank; the first
 * band of the frame after that waits for the answer. */
#include "platform/display.h"
#include "platform/platform.h"
#include "platform/print.h"
#include "platform/raspi0/board.h"

enum { PAGES = 2, LED = 47 };

/* Tags of the firmware. */
enum {
    SET_SIZE = 0x48003, SET_ALL = 0x48004, SET_DEPTH = 0x48005, SET_ORDER = 0x48006, SET_OFFSET = 0x48009, WAIT_BLANK = 0x4800e,
    ALLOCATE = 0x40001, GET_PITCH = 0x40008
};

static struct {
    uint8_t *page[PAGES];
    uint32_t pitch, height;
    uint32_t hidden;                /* page that is written to */
    bool is_waiting;                /* for the blank that shows the last frame */
    uint32_t frames, second;        /* shown since then, BOARD_TIME */
} screen;

/* Keys to ground. The first are those of the usual displays with a joystick for the 40 pins. */
static const struct {
    uint8_t pin, key;
} keys[] = {
    { 6, KEY_UP }, { 19, KEY_DOWN }, { 5, KEY_LEFT }, { 26, KEY_RIGHT }, { 13, KEY_A }, { 21, KEY_A }, { 20, KEY_START },
    { 16, KEY_START }
};

enum { KEYS = sizeof keys / sizeof *keys };

static int flush(void *user, const smear_band *band)
{
    (void)user;
    if (screen.is_waiting) {
        board_answer();
        screen.is_waiting = false;
    }
    const uint8_t *from = band->pixels;
    uint8_t *to = screen.page[screen.hidden] + (uint32_t)band->y * screen.pitch + 2 * (uint32_t)band->x;
    for (int y = 0; y < band->height; y++, from += band->stride, to += screen.pitch)
        __builtin_memcpy(to, from, 2 * (uint32_t)band->width);
    return 0;
}

static bool open_screen(uint32_t width, uint32_t height)
{
    const uint32_t tags[] = {
        SET_SIZE,  8, 0, width, height,
        SET_ALL,   8, 0, width, PAGES * height,
        SET_DEPTH, 4, 0, 16,
        SET_ORDER, 4, 0, 1,             /* red in the highest bits */
        ALLOCATE,  8, 0, 4096, 0,
        GET_PITCH, 4, 0, 0
    };
    enum { GOT_ALL = 10, GOT_DEPTH = 15, GOT_ADDRESS = 23, GOT_BYTES = 24, GOT_PITCH = 28 };
    board_send(tags, sizeof tags / sizeof *tags);
    if (!board_answer() || board_message[GOT_ADDRESS] == 0 || board_message[GOT_DEPTH] != 16
        || board_message[GOT_PITCH] < 2 * width || board_message[GOT_BYTES] < PAGES * height * board_message[GOT_PITCH])
        return false;
    screen.pitch = board_message[GOT_PITCH];
    screen.height = height;
    for (uint32_t i = 0; i < PAGES; i++)        /* the highest bits are the firmware's way to memory */
        screen.page[i] = (uint8_t *)(board_message[GOT_ADDRESS] & 0x3fffffffu) + i * height * screen.pitch;
    return true;
}

static void open_keys(void)
{
    uint32_t mask = 0;
    for (int i = 0; i < KEYS; i++) {
        board_pin_open(keys[i].pin, PIN_INPUT);
        mask |= 1u << keys[i].pin;
    }
    board_pull(mask, 2);
}

bool display_open(smear_desc *desc)
{
    if (desc->format != SMEAR_RGB565)
        return false;
    if (!open_screen((uint32_t)desc->width, (uint32_t)desc->height)) {
        platform_print("demo: the firmware gives no screen with two pages of 16 bits: gpu_mem in config.txt is too small\n");
        return false;
    }
    desc->bands = 1;
    desc->reuse.buffer_age = (desc->methods & SMEAR_SET_TEMPORAL) != 0 ? PAGES : 0;
    desc->flush = flush;
    screen.hidden = 1;
    screen.second = BOARD_TIME;
    board_pin_open(LED, PIN_OUTPUT);
    open_keys();
    return true;
}

void display_attach(smear_context *ctx)
{
    (void)ctx;
}

/* Says once in a second how many frames were shown in it. */
static void count_frame(void)
{
    const uint32_t elapsed = BOARD_TIME - screen.second;
    screen.frames++;
    if (elapsed < 1000000)
        return;
    const uint32_t tenths = screen.frames * 10000000u / elapsed;
    print_decimal(tenths / 10);
    platform_print(".");
    print_decimal(tenths % 10);
    platform_print(" frames per second\n");
    screen.frames = 0;
    screen.second = BOARD_TIME;
}

void display_show(void)
{
    const uint32_t tags[] = { SET_OFFSET, 8, 0, 0, screen.hidden * screen.height, WAIT_BLANK, 4, 0, 0 };
    if (screen.is_waiting)
        board_answer();
    board_send(tags, sizeof tags / sizeof *tags);
    screen.is_waiting = true;
    screen.hidden ^= 1;
    if ((screen.hidden & 1) != 0)
        BOARD_PIN_SET(LED) = 1u << LED % 32;
    else
        BOARD_PIN_CLEAR(LED) = 1u << LED % 32;
    count_frame();
}

/* Somebody may always be looking. */
bool display_wait(void)
{
    for (const uint32_t start = BOARD_TIME; BOARD_TIME - start < 10000;) {
    }
    return true;
}

uint32_t display_time(void) { return BOARD_TIME / 1000; }

unsigned display_keys(void)
{
    const uint32_t levels = BOARD_PIN_LEVELS;
    unsigned held = 0;
    for (int i = 0; i < KEYS; i++)
        if ((levels >> keys[i].pin & 1) == 0)
            held |= keys[i].key;
    return held;
}
