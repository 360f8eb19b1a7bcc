/* SPDX-License-Identifier: MIT */
/* overlay.c - see overlay.h. */
#include "overlay/overlay.h"

#include "kernels/fill.h"

#if SMEAR_WITH_OVERLAY

/* Columns [x0, x1) of a row, of which `out` is the first. */
struct part {
    uint32_t *out;
    int32_t x0, x1;
    smear_transfer transfer;
};

static int32_t scale_of(const smear_overlay_item *item)
{
    return item->scale != 0 ? item->scale : 1;
}

static int32_t advance_of(const smear_font *font)
{
    return font->advance != 0 ? font->advance : font->glyph.width;
}

int32_t smear_overlay_advance(const smear_overlay_item *item)
{
    return advance_of(item->font) * scale_of(item);
}

struct overlay_box smear_overlay_letter(const smear_overlay_item *item)
{
    const smear_image *m = &item->font->glyph;
    const int32_t scale = scale_of(item);
    return (struct overlay_box){ item->x, item->y, item->x + m->width * scale, item->y + m->height * scale };
}

uint32_t smear_overlay_color(const smear_overlay_item *item)
{
    const uint8_t *c = item->color;
    return c[3] == 0 ? 0xffffffffu : pixel_make(c[3], c[0], c[1], c[2]);
}

/* Returns the columns of a text: from its first letter to the end of its last. More letters than any frame has columns are
 * not counted. */
static int32_t text_width(const smear_overlay_item *item)
{
    const ptrdiff_t most = 65536;
    const char *end = item->text;
    while (*end != '\0')
        end++;
    const ptrdiff_t letters = end - item->text;
    return letters == 0 ? 0 : ((int32_t)(letters < most ? letters : most) - 1) * advance_of(item->font) + item->font->glyph.width;
}

struct overlay_box smear_overlay_box(const smear_overlay_item *item)
{
    const int32_t scale = scale_of(item);
    int32_t width = item->width, height = item->height;
    if (item->shape != NULL) {
        int32_t box[4];
        item->shape->find_box(item, box);
        return (struct overlay_box){ box[0], box[1], box[2], box[3] };
    }
    if (item->text != NULL) {
        width = text_width(item);
        height = item->font->glyph.height;
    } else if (item->image != NULL) {
        width = item->image->width;
        height = item->image->height;
    }
    return (struct overlay_box){ item->x, item->y, item->x + width * scale, item->y + height * scale };
}

bool smear_overlay_touches(const smear_overlay *overlay, const struct overlay_box *box)
{
    for (int32_t i = 0; i < overlay->count; i++) {
        const struct overlay_box b = smear_overlay_box(&overlay->item[i]);
        if (b.x0 < box->x1 && b.x1 > box->x0 && b.y0 < box->y1 && b.y1 > box->y0)
            return true;
    }
    return false;
}

/* ------------------------------------------------------------------ pixels */

/* Draws `argb` over columns [x0, x1) as far as they are in the part. */
static inline void cover(const struct part *p, int32_t x0, int32_t x1, uint32_t argb)
{
    const uint32_t alpha = pixel_alpha(argb);
    const int32_t first = max_i32(x0, p->x0), n = min_i32(x1, p->x1) - first;
    uint32_t *out = p->out + (first - p->x0);
    if (alpha == 255u)
        pixels_fill(out, argb & 0xffffffu, n);
    for (int32_t i = 0; alpha < 255u && i < n; i++)
        out[i] = pixel_blend(out[i], argb, alpha, p->transfer);
}

void smear_shape_cover(const smear_shape_row *row, int32_t x0, int32_t x1, uint32_t color)
{
    const struct part p = { row->pixel, row->x0, row->x1, row->transfer };
    if (max_i32(x0, row->x0) < min_i32(x1, row->x1))
        cover(&p, x0, x1, color);
}

static uint32_t row_bytes(const smear_image *m)
{
    return m->format == SMEAR_IMAGE_PALETTE8 ? m->width : m->format == SMEAR_IMAGE_MASK1 ? (m->width + 7u) / 8u
                                                                                         : (m->width + 1u) / 2u;
}

/* Returns the pixel of a row of an image as 0xAARRGGBB; of a mask, `argb` as far as it counts. */
static uint32_t pixel_of(const smear_image *m, const uint8_t *row, int32_t i, uint32_t argb)
{
    const uint32_t nibble = (i & 1) != 0 ? row[i >> 1] & 15u : (uint32_t)(row[i >> 1] >> 4);
    const uint32_t color = m->format == SMEAR_IMAGE_MASK4   ? (argb & 0xffffffu) | nibble * 17u << 24
                         : m->format == SMEAR_IMAGE_PALETTE4 ? m->palette[nibble]
                                                             : m->palette[row[i]];
    return (color & 0xffffffu) | code_times(pixel_alpha(color), pixel_alpha(argb)) << 24;
}

uint32_t smear_image_pitch(const smear_image *m) { return row_bytes(m); }

uint32_t smear_image_pixel(const smear_image *m, const uint8_t *row, int32_t i, uint32_t argb)
{
    if (m->format != SMEAR_IMAGE_MASK1)
        return pixel_of(m, row, i, argb);
    return (row[i >> 3] & 0x80 >> (i & 7)) != 0 ? argb : 0;
}

/* Most letters are opaque bits, 1:1. */
static inline bool is_plain(const smear_image *m, int32_t scale, uint32_t argb)
{
    return m->format == SMEAR_IMAGE_MASK1 && scale == 1 && argb >= 0xff000000u;
}

/* Draws a row of n bits that lies in the part. What the last byte has beyond them may be anything. */
static inline void draw_bits(uint32_t *out, const uint8_t *row, int32_t n, uint32_t color)
{
    for (; n > 0; n -= 8, out += 8) {
        uint32_t bits = (uint32_t)*row++ << 24;
        if (n < 8)
            bits &= 0xffffffffu << (32 - n);
        for (uint32_t i = 0; bits != 0; bits <<= 1, i++)
            if ((bits >> 31) != 0)
                out[i] = color;
    }
}

/* Draws a row of an image from column x on. */
static void draw_row(const struct part *p, const smear_image *m, const uint8_t *row, int32_t x, int32_t scale, uint32_t argb)
{
    int32_t i = 0;
    for (; i < m->width && x + scale <= p->x0; x += scale)
        i++;
    for (; i < m->width && x < p->x1; i++, x += scale) {
        if (m->format != SMEAR_IMAGE_MASK1)
            cover(p, x, x + scale, pixel_of(m, row, i, argb));
        else if ((row[i >> 3] & 0x80 >> (i & 7)) != 0)
            cover(p, x, x + scale, argb);
    }
}

static void draw_text(const struct part *p, const smear_overlay_item *item, int32_t line, int32_t scale, uint32_t argb)
{
    const smear_font *font = item->font;
    const smear_image *m = &font->glyph;
    const uint32_t cells = m->cells != 0 ? m->cells : 1u, pitch = row_bytes(m), size = pitch * m->height;
    const uint8_t *row = m->pixels + (uint32_t)line * pitch;
    const int32_t step = smear_overlay_advance(item), width = m->width * scale;
    const bool plain = is_plain(m, scale, argb);
    int32_t x = item->x;
    for (const char *c = item->text; *c != '\0' && x < p->x1; c++, x += step) {
        const uint32_t cell = (uint32_t)(uint8_t)*c - font->first;
        if (x + width <= p->x0 || cell >= cells)
            continue;
        const uint8_t *letter = row + cell * size;
        if (plain && x >= p->x0 && x + width <= p->x1)
            draw_bits(p->out + (x - p->x0), letter, width, argb & 0xffffffu);
        else
            draw_row(p, m, letter, x, scale, argb);
    }
}

/* Draws row `line` of an item, counted from its first, which the part reaches. */
static inline void draw_line(const struct part *p, const smear_overlay_item *item, int32_t line, int32_t scale, uint32_t argb)
{
    const smear_image *m = item->image;
    if (scale != 1)
        line /= scale;
    if (item->text != NULL)
        draw_text(p, item, line, scale, argb);
    else if (m != NULL)
        draw_row(p, m, m->pixels + ((uint32_t)item->cell * m->height + (uint32_t)line) * row_bytes(m), item->x, scale, argb);
    else
        cover(p, p->x0, p->x1, argb);
}

void smear_overlay_draw(const smear_overlay *overlay, const struct smear_raster_target *t, const struct overlay_box *area,
                        smear_transfer transfer)
{
    for (int32_t i = 0; i < overlay->count; i++) {
        const smear_overlay_item *item = &overlay->item[i];
        const struct overlay_box box = smear_overlay_box(item);
        const int32_t x0 = max_i32(box.x0, area->x0), x1 = min_i32(box.x1, area->x1), y1 = min_i32(box.y1, area->y1);
        const int32_t scale = scale_of(item);
        const uint32_t argb = smear_overlay_color(item);
        for (int32_t y = max_i32(box.y0, area->y0); x0 < x1 && y < y1; y++) {
            const struct part p = { t->color + target_row(&t->color_rows, t, y) + x0, x0, x1, transfer };
            const smear_shape_row row = { p.out, x0, x1, y, transfer };
            if (item->shape != NULL)
                item->shape->draw_row(item, &row);
            else
                draw_line(&p, item, y - box.y0, scale, argb);
        }
    }
}

#endif
