/* SPDX-License-Identifier: MIT */
/* panel_cost.c - see panel.h: a panel that prints the same sum as panel.c, and what a frame takes without what its driver does. */
#include "panel.h"

#include "platform/platform.h"
#include "platform/print.h"

static uint32_t sum = 2166136261u, began, taken, flushed;

int panel_flush(void *user, const smear_band *band)
{
    const uint32_t start = platform_clock();
    const uint8_t *byte = (const uint8_t *)band->pixels, *end = byte + band->size;
    (void)user;
    for (; byte < end; byte++)
        sum = (sum ^ *byte) * 16777619u;
    flushed += platform_clock_count(platform_clock() - start);
    return 0;
}

int panel_next(int number)
{
    if (number == 0)
        platform_clock_start();
    else
        taken += (platform_clock_count(platform_clock() - began) - flushed) / PANEL_FRAMES;
    flushed = 0;
    began = platform_clock();
    if (number < PANEL_FRAMES)
        return 1;
    print_hex(sum);
    platform_print(" ");
    print_decimal(taken);
    platform_print(" ");
    platform_print(platform_clock_unit);
    platform_print("\n");
    return 0;
}
