/* SPDX-License-Identifier: MIT */
/* panel.c - see panel.h: a panel that prints its last frame as a PPM, and to standard error a sum of all bytes it was sent. */
#include "panel.h"

#include <stdio.h>

static uint32_t sum = 2166136261u;
static int now;

int panel_flush(void *user, const smear_band *band)
{
    const uint8_t *byte = (const uint8_t *)band->pixels, *end = byte + band->size;
    (void)user;
    for (; byte < end; byte += 2) {
        const unsigned high = byte[0], low = byte[1], green = (high & 7) << 3 | low >> 5;
        sum = ((sum ^ high) * 16777619u ^ low) * 16777619u;
        if (now == PANEL_FRAMES - 1)
            printf("%c%c%c", (int)((high & 248) | high >> 5), (int)(green << 2 | green >> 4), (int)((low & 31) << 3 | (low & 31) >> 2));
    }
    return 0;
}

int panel_next(int number)
{
    now = number;
    if (number == PANEL_FRAMES - 1)
        printf("P6 %d %d 255\n", PANEL_WIDTH, PANEL_HEIGHT);
    if (number == PANEL_FRAMES)
        fprintf(stderr, "%08lx\n", (unsigned long)sum);
    return number < PANEL_FRAMES;
}
