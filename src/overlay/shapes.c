/* SPDX-License-Identifier: MIT */
/* shapes.c - sprites that are turned and lines, of smear_overlay.h. Nothing else in the library calls them, so that they are linked
 * where a program names them. */
#include "base/fixmath.h"
#include "overlay/overlay.h"

#if SMEAR_WITH_OVERLAY

/* ------------------------------------------------------------------ turned sprites */

static int32_t zoom_of(const smear_overlay_item *item)
{
    return item->zoom != 0 ? item->zoom : 256;
}

/* Returns the sine of 65536ths of a turn, q24, as smear_math.h does, whose polynomial it is. */
static int32_t sine_of(uint32_t turn)
{
    uint32_t t = turn & 0x7fffu, square, p;
    if (t > 0x4000u)
        t = 0x8000u - t;
    square = t * t << 2;
    p = 321073058u - mulh_u32(41457241u, square);
    p = 1369037671u - mulh_u32(p, square);
    p = 2774391505u - mulh_u32(p, square);
    p = 1686629674u - mulh_u32(p, square);
    t = mulh_u32(p << 1, t << 17) >> 6;
    return (turn & 0x8000u) != 0 ? -(int32_t)t : (int32_t)t;
}

/* A box around the circle that the corners of the image turn on. */
static void turned_find_box(const smear_overlay_item *item, int32_t box[4])
{
    const int32_t w = item->image != NULL ? item->image->width : 0, h = item->image != NULL ? item->image->height : 0;
    const int32_t radius = w == 0 ? 0 : ((max_i32(w, h) + (min_i32(w, h) >> 1) + 1) * zoom_of(item) >> 9) + 1;
    const int32_t x = item->x + (w >> 1), y = item->y + (h >> 1);
    box[0] = x - radius;
    box[1] = y - radius;
    box[2] = x + radius + 1;
    box[3] = y + radius + 1;
}

/* Goes over the row's pixels within the box in texels, q18: whatever the zoom is they are less than 2^31 there. */
static void turned_draw_row(const smear_overlay_item *item, const smear_shape_row *row)
{
    const smear_image *m = item->image;
    int32_t box[4];
    turned_find_box(item, box);
    if (m == NULL)
        return;
    const int32_t w = m->width, h = m->height, x0 = max_i32(row->x0, box[0]), x1 = min_i32(row->x1, box[2]);
    const int32_t cosine = sine_of(item->turn + 0x4000u) * 4 / zoom_of(item);
    const int32_t sine = sine_of(item->turn) * 4 / zoom_of(item);
    const int32_t dx = 2 * (x0 - item->x) + 1 - w, dy = 2 * (row->y - item->y) + 1 - h;
    int32_t u = (w << 17) + ((dx * cosine - dy * sine) >> 1), v = (h << 17) + ((dx * sine + dy * cosine) >> 1);
    const uint32_t pitch = smear_image_pitch(m), own = smear_overlay_color(item);
    const uint8_t *pixels = m->pixels + (uint32_t)item->cell * (uint32_t)h * pitch;
    for (int32_t x = x0; x < x1; x++, u += cosine, v += sine)
        if ((uint32_t)u < (uint32_t)w << 18 && (uint32_t)v < (uint32_t)h << 18) {
            const uint32_t argb = smear_image_pixel(m, pixels + (uint32_t)(v >> 18) * pitch, u >> 18, own);
            if (pixel_alpha(argb) != 0)
                smear_shape_cover(row, x, x + 1, argb);
        }
}

const smear_shape smear_shape_turned = { turned_find_box, turned_draw_row };

/* ------------------------------------------------------------------ lines */

/* Half of how thick a line is, and the half pixel in which its edge fades: 32nds of a pixel. */
static int32_t reach_of(const smear_overlay_item *item)
{
    return (item->width != 0 ? item->width : 16) + 16;
}

static void line_find_box(const smear_overlay_item *item, int32_t box[4])
{
    const int32_t corner = ((reach_of(item) * 3) >> 6) + 1;     /* 1.5 is more than the root of 2 */
    box[0] = item->x + (min_i32(item->to_x, 0) >> 4) - corner;
    box[1] = item->y + (min_i32(item->to_y, 0) >> 4) - corner;
    box[2] = item->x + (max_i32(item->to_x, 0) >> 4) + corner + 2;
    box[3] = item->y + (max_i32(item->to_y, 0) >> 4) + corner + 2;
}

/* Returns what `part` is of a length, q18. */
static int32_t part_of(int32_t part, uint32_t length)
{
    const int32_t ratio = (ratio_q30((int64_t)abs_i32(part) << 8, length) + 2048) >> 12;
    return part < 0 ? -ratio : ratio;
}

/* Lengths are in pixels, q18: along the line from its middle, and across from it. */
static void line_draw_row(const smear_overlay_item *item, const smear_shape_row *row)
{
    const int32_t x = item->to_x, y = item->to_y, reach = reach_of(item) << 13, dy = row->y - item->y;
    const uint32_t length = sqrt_floor_64((uint64_t)((uint32_t)(x * x) + (uint32_t)(y * y)) << 16);     /* q12 */
    const int32_t ux = length == 0 ? 1 << 18 : part_of(x, length), uy = length == 0 ? 0 : part_of(y, length);
    const int32_t half = (int32_t)(length << 5), color = (int32_t)smear_overlay_color(item);
    int32_t box[4], first, end;
    line_find_box(item, box);
    first = max_i32(row->x0, box[0]) - item->x;
    end = min_i32(row->x1, box[2]) - item->x;
    /* Leaves out columns that are further across than it reaches. */
    const int32_t slope = abs_i32(uy), middle = uy < 0 ? -dy * ux : dy * ux;
    if (slope > 1 << 10) {
        first = max_i32(first, (middle - reach) / slope);
        end = min_i32(end, (middle + reach) / slope + 1);
    }
    for (int32_t dx = first; dx < end; dx++) {
        const int32_t across = abs_i32(dx * uy - dy * ux), beyond = abs_i32(dx * ux + dy * uy - half) - half;
        const int32_t cover = min_i32(reach - max_i32(across, beyond), 1 << 18) >> 4;
        const uint32_t alpha = cover <= 0 ? 0 : (pixel_alpha((uint32_t)color) * (uint32_t)cover + (1u << 13)) >> 14;
        if (alpha != 0)
            smear_shape_cover(row, item->x + dx, item->x + dx + 1, ((uint32_t)color & 0xffffffu) | alpha << 24);
    }
}

const smear_shape smear_shape_line = { line_find_box, line_draw_row };

#endif
