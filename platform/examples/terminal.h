/* SPDX-License-Identifier: MIT */
/* terminal.h - smear in a terminal of 24-bit colours, on whatever runs C: a character shows two pixels, one above the other. */
#include <stdio.h>

#define SCREEN_WIDTH 96
#define SCREEN_HEIGHT 64
#define SCREEN_FORMAT SMEAR_XRGB8888

static void display_color(char which, uint32_t rgb)
{
    printf("\033[%c8;2;%d;%d;%dm", which, (int)(rgb >> 16 & 255), (int)(rgb >> 8 & 255), (int)(rgb & 255));
}

static int display_flush(void *user, const smear_band *band)
{
    (void)user;
    for (int y = 0; y + 1 < band->height; y += 2) {
        const uint32_t *upper = (const uint32_t *)band->pixels + (size_t)y * (size_t)band->width, *lower = upper + band->width;
        printf("\033[%d;1H", (band->y + y) / 2 + 1);
        for (int x = 0; x < band->width; x++) {
            display_color('3', upper[x]);
            display_color('4', lower[x]);
            printf("\342\226\200");             /* the upper half of a character */
        }
    }
    printf("\033[0m\n");
    return fflush(stdout) == 0 ? SMEAR_OK : -100;
}

static void display_begin(smear_desc *desc) { desc->flush = display_flush; }
