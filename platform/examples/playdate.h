/* SPDX-License-Identifier: MIT */
/* playdate.h - smear on a Playdate, in the frame of its SDK: 400x240 pixels of one bit, rows of 52 bytes. */
#include "pd_api.h"
#include <string.h>

#define SCREEN_WIDTH LCD_COLUMNS
#define SCREEN_HEIGHT LCD_ROWS
#define SCREEN_FORMAT SMEAR_L1

static PlaydateAPI *playdate;                   /* from eventHandler() */

static int display_flush(void *user, const smear_band *band)
{
    uint8_t *frame = playdate->graphics->getFrame();
    const uint8_t *from = (const uint8_t *)band->pixels;
    (void)user;
    for (int y = band->y; y < band->y + band->height; y++, from += band->stride)
        memcpy(frame + y * LCD_ROWSIZE, from, SCREEN_WIDTH / 8);
    playdate->graphics->markUpdatedRows(band->y, band->y + band->height - 1);
    return SMEAR_OK;
}

static void display_begin(smear_desc *desc) { desc->flush = display_flush; }
