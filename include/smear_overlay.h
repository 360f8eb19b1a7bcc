/* SPDX-License-Identifier: MIT */
/* smear_overlay.h - what lies over a frame: boxes, sprites, text and lines, as a lap time, a bar, a needle; and points in the
 * world, as sparks, rain, snow, dust.
 *
 *     smear_overlay_item item[2] = { { 0 }, { 0 } };          // zero: white, opaque, 1:1
 *     item[0].x = 4, item[0].y = 4, item[0].text = "LAP 1", item[0].font = &smear_font_8x8;
 *     item[1].x = 4, item[1].y = 16, item[1].width = speed, item[1].height = 3;
 *     smear_overlay overlay = { item, 2, NULL };              // the last one: points
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

/* What `shape` draws, where it is not null; else text where `text` is not null, else a cell of `image` where that is not null,
 * else a box. */
typedef struct smear_shape smear_shape;

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
    const smear_shape *shape;
    int16_t to_x, to_y;         /* of smear_shape_line */
    uint16_t turn, zoom;        /* of smear_shape_turned */
} smear_overlay_item;

/* ------------------------------------------------------------------ shapes */

/* A cell of `image`, turned about its middle by `turn` 65536ths of a turn, counter-clockwise, and enlarged by `zoom` 256ths (0 means
 * 256); `scale` does not count. x, y is its top left as it is unturned at 1:1, so that its middle stays where it is. A pixel shows
 * the texel in which its own middle lies, to a 64th of a texel. */
extern const smear_shape smear_shape_turned;

/* A line with smooth edges and square ends, from the middle of pixel x, y to to_x, to_y 16ths of a pixel from there; `width` is how
 * thick it is, in 16ths of a pixel (0 means 16), and by half of that it goes on beyond both of its ends, so lines join. A pixel is
 * covered by how far its middle lies within: from not at all, half a pixel beyond the nearest side, to all of it, half a pixel within. */
extern const smear_shape smear_shape_line;

/* What a shape draws into: columns x0 .. x1 - 1 of row y of the finished frame. */
typedef struct smear_shape_row {
    uint32_t *pixel;            /* of column x0 on; 0x00RRGGBB, sRGB-encoded */
    int32_t x0, x1, y;
    uint8_t transfer;           /* how colours are blended; of no use to others */
} smear_shape_row;

/* Constant functions of an item, called once or more often for each row, by any core. A program may have shapes of its own; those
 * above are linked where they are named, as fonts are. */
struct smear_shape {
    void (*find_box)(const smear_overlay_item *item, int32_t box[4]);   /* the pixels that it may touch: x0, y0, and the ends x1, y1 */
    void (*draw_row)(const smear_overlay_item *item, const smear_shape_row *row);
};

/* Blends 0xAARRGGBB, straight alpha, over columns x0 .. x1 - 1 of a row, as far as it has them. */
void smear_shape_cover(const smear_shape_row *row, int32_t x0, int32_t x1, uint32_t color);

/* ------------------------------------------------------------------ points */

typedef enum smear_point_mode {
    SMEAR_POINT_ADD,            /* its light is added: sparks, rain; black shows nothing */
    SMEAR_POINT_BLEND           /* it covers what is behind it: snow, dust */
} smear_point_mode;

/* What the library finds out about a point while it renders; of no use to others. */
typedef struct smear_point_place {
    int32_t x, y, length;
    uint32_t gain;
    int16_t along_x, along_y, x0, x1, y0, y1;
    uint16_t depth, next;
} smear_point_place;

/* A soft dot with the light of a disc, and, where it or the camera moves, the streak that it leaves during the exposure: as
 * long and as faint as that of a dot drawn at ever so many instants, at the price of a dot. Light falls off smoothly,
 * over a pixel at least, so points neither twinkle nor vanish: smaller ones are fainter. */
typedef struct smear_point {
    int32_t now[3];             /* Q16.16 world units, any */
    int32_t before[3];          /* where it was one frame ago (with smear_shutter.poses: at shutter open); of a new one, as
                                 * `now`. It goes straight on, as frame.scale.object says */
    int32_t size;               /* Q16.16 world units, not negative: diameter of the disc; 128 pixels on the screen at most */
    uint8_t color[3];           /* r g b, sRGB-encoded */
    uint8_t fade;               /* 0: all of its light (ADD), opaque in the middle (BLEND); up to 255: nothing */
    uint8_t mode;               /* smear_point_mode */
    smear_point_place place;
} smear_point;

/* Points of a frame, drawn in their order over what the frame shows, whatever its method is, and below all items. Seen by
 * the frame's camera, between its planes. With SMEAR_NONE they are dots, now. A shutter's curve is a box for them. Streaks of
 * more than 700 pixels across or down are not drawn.
 *
 * Where the scene is nearer than the near side of the dot, a point is hidden, pixel by pixel, its whole streak at the depth
 * of mid-exposure. The scene's depth is that of the sharp picture in the middle of the exposure, whatever moves there;
 * SMEAR_ACCUMULATE compares at every instant the part of the streak that belongs to it. Blended draws hide nothing. */
typedef struct smear_points {
    smear_point *point;         /* `place` is written from smear_begin on until smear_render returns, all else is read: one
                                 * array is of one context at a time */
    uint16_t count;
} smear_points;

struct smear_overlay {
    const smear_overlay_item *item;
    uint16_t count;
    const smear_points *points; /* or null; not with smear_filter_begin */
};

#ifdef __cplusplus
}
#endif

#endif
