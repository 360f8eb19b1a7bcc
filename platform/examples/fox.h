/* SPDX-License-Identifier: MIT */
/* fox.h - the model of show.h below a sprite that turns and a line of text: what all examples draw. C99 or C++11.
 *
 *     smear convert coin.png --cell 16x16 --key ff00ff --name coin -o coin.h */
#include "show.h"
#include "coin.h"

static smear_overlay_item item[2];
static smear_overlay overlay;

/* Once: the display, then the library. Returns SMEAR_OK or what smear_error_text() explains. */
static int fox_begin(void)
{
    frame.overlay = &overlay;
    item[0].x = 4, item[0].y = 4;
    item[0].image = &coin;
    item[1].x = 24, item[1].y = 8;
    item[1].text = "smear";
    item[1].font = &smear_font_8x8;
    overlay.item = item;
    overlay.count = 2;
    return show_begin();
}

/* Draws one frame: a thirtieth of a second further. */
static int fox_frame(void)
{
    static uint32_t number;
    item[0].cell = (uint16_t)(number++ / 3u % coin.cells);
    return show_frame();
}
