/* SPDX-License-Identifier: MIT */
/* smear_overlay.h - boxes, sprites and text over a frame: a lap time, a bar, a crosshair.
 *
 *     smear_overlay_item item[2] = { { 0 }, { 0 } };          // zero: white, opaque, 1:1
 *     item[0].x = 4, item[0].y = 4, item[0].text = "LAP 1", item[0].font = &smear_font_8x8;
 *     item[1].x = 4, item[1].y = 16, item[1].width = speed, item[1].height = 3;
 *     smear_overlay overlay = { item, 2 };
 *     frame.overlay = &overlay;                               // and smear_begin, smear_submit, smear_render as ever
 *
 * Items are drawn in their order into finished pixels, just before these become the display's: sharp whatever the method
 * is, in front of everything, in every format. They take no memory of the context but with desc.reuse.buffer_age, where
 * 4 bytes for each tile tell which tiles another text must be sent for. What is pointed to is read until smear_render
 * returns. `smear convert` makes images and fonts from PNG files. */
#ifndef SMEAR_OVERLAY_H
#define SMEAR_OVERLAY_H

#include "smear.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum smear_image_format {
    SMEAR_IMAGE_MASK1,          /* the item's colour where a bit is 1: eight pixels per byte, left one in bit 7 */
    SMEAR_IMAGE_MASK4,          /* 0 to 15: how much of the item's colour; two pixels per byte, left one in the high nibble */
    SMEAR_IMAGE_PALETTE4,       /* into palette[16], two pixels per byte, likewise */
    SMEAR_IMAGE_PALETTE8        /* into palette[256] */
} smear_image_format;

/* Pictures of one size below each other, each row from a byte on. Constant data that may stay in flash. */
typedef struct smear_image {
    const uint8_t *pixels;
    const uint32_t *palette;    /* 0xAARRGGBB, sRGB-encoded, straight alpha: 0 is a hole, the key colour */
    uint16_t width, height;     /* of one picture, 1..2048 */
    uint16_t cells;             /* pictures: phases of a movement, letters; 0 means 1 */
    uint8_t format;             /* smear_image_format */
} smear_image;

/* Letters: the cells of an image. Characters that it has not are gaps. */
typedef struct smear_font {
    smear_image glyph;
    uint8_t first;              /* character of the first cell */
    uint8_t advance;            /* pixels from letter to letter; 0 means the image's width */
} smear_font;

/* Built in, ASCII 32 to 126, one bit per pixel: bold in cells of 8 x 8, narrow in cells of 6 x 8. Firmware that names
 * none has none. */
extern const smear_font smear_font_8x8, smear_font_6x8;

/* Text where `text` is not null, else a cell of `image` where that is not null, else a box. */
typedef struct smear_overlay_item {
    int16_t x, y;               /* top left, pixels of the frame; may lie beyond it */
    uint16_t width, height;     /* of a box */
    uint8_t color[4];           /* r g b a, r g b sRGB-encoded, of boxes, text and masks; of images with a palette a alone
                                 * counts. a = 0 means white, opaque */
    uint8_t scale;              /* 1..8: each pixel is so many wide and high (a box, too); 0 means 1 */
    uint16_t cell;              /* of `image`, below its `cells` */
    const smear_image *image;
    const smear_font *font;     /* required with text */
    const char *text;           /* one line, up to its NUL */
} smear_overlay_item;

struct smear_overlay {
    const smear_overlay_item *item;
    uint16_t count;
};

#ifdef __cplusplus
}
#endif

#endif
