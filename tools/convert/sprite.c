/* SPDX-License-Identifier: MIT */
/* sprite.c - see sprite.h. The smallest format that loses nothing is taken: masks of one bit where all pixels are there or
 * not, else of four; palettes of 16 or of 256 colours, alpha among them. */
#include "tools/convert/sprite.h"

#include "tools/image/buffer.h"

#include <smear_overlay.h>
#include <inttypes.h>

enum { COLORS = 256 };

struct sprite {
    const struct image *image;
    const struct sprite_options *options;
    int width, height, cells, format;
    uint32_t color[COLORS];             /* 0xAARRGGBB */
    int color_count;
    struct buffer pixels, text;
};

/* ------------------------------------------------------------------ pixels */

static const uint8_t *pixel_at(const struct sprite *s, int cell, int x, int y)
{
    const int across = s->image->width / s->width;
    return s->image->rgba + 4 * ((size_t)(cell / across * s->height + y) * (size_t)s->image->width
                                 + (size_t)(cell % across * s->width + x));
}

/* 0xAARRGGBB; all holes are 0. */
static uint32_t color_at(const struct sprite *s, int cell, int x, int y)
{
    const uint8_t *p = pixel_at(s, cell, x, y);
    const uint32_t rgb = (uint32_t)p[0] << 16 | (uint32_t)p[1] << 8 | p[2];
    return p[3] == 0 || (s->options->has_key && rgb == s->options->key) ? 0 : (uint32_t)p[3] << 24 | rgb;
}

static bool is_opaque(const struct image *image)
{
    for (size_t i = 0; i < (size_t)image->width * (size_t)image->height; i++)
        if (image->rgba[4 * i + 3] != 255)
            return false;
    return true;
}

/* 0 to 255: how much of a mask's pixel there is. */
static int mask_at(const struct sprite *s, int cell, int x, int y, bool by_alpha)
{
    const uint8_t *p = pixel_at(s, cell, x, y);
    return by_alpha ? p[3] : (p[0] * 77 + p[1] * 150 + p[2] * 29 + 128) >> 8;
}

static int find_color(const struct sprite *s, uint32_t color)
{
    int i = 0;
    while (i < s->color_count && s->color[i] != color)
        i++;
    return i;
}

/* Collects the colours; false where there are too many. */
static bool find_palette(struct sprite *s, struct failure *f)
{
    for (int cell = 0; cell < s->cells; cell++)
        for (int i = 0; i < s->width * s->height; i++) {
            const uint32_t color = color_at(s, cell, i % s->width, i / s->width);
            const int found = find_color(s, color);
            if (found == COLORS)
                return fail(f, "more than 256 colours: a sprite has a palette (give the picture one, or --mask)");
            s->color[found] = color;
            s->color_count += found == s->color_count;
        }
    s->format = s->color_count <= 16 ? SMEAR_IMAGE_PALETTE4 : SMEAR_IMAGE_PALETTE8;
    return true;
}

static bool find_mask_format(struct sprite *s, bool by_alpha)
{
    s->format = SMEAR_IMAGE_MASK1;
    for (int cell = 0; cell < s->cells; cell++)
        for (int i = 0; i < s->width * s->height; i++) {
            const int value = mask_at(s, cell, i % s->width, i / s->width, by_alpha);
            if (value != 0 && value != 255)
                s->format = SMEAR_IMAGE_MASK4;
        }
    return true;
}

/* Packs codes from the left, rows from a byte on. */
static void pack(struct sprite *s, bool by_alpha)
{
    const int bits = s->format == SMEAR_IMAGE_MASK1 ? 1 : s->format == SMEAR_IMAGE_PALETTE8 ? 8 : 4;
    for (int row = 0; row < s->cells * s->height; row++) {
        unsigned byte = 0;
        int filled = 0;
        for (int x = 0; x < s->width; x++) {
            const int cell = row / s->height, y = row % s->height;
            const int code = s->format >= SMEAR_IMAGE_PALETTE4 ? find_color(s, color_at(s, cell, x, y))
                                                               : (mask_at(s, cell, x, y, by_alpha) * ((1 << bits) - 1) + 127) / 255;
            byte = byte << bits | (unsigned)code;
            filled += bits;
            if (filled == 8 || x == s->width - 1) {
                buffer_byte(&s->pixels, byte << (8 - filled));
                byte = 0;
                filled = 0;
            }
        }
    }
}

/* ------------------------------------------------------------------ text */

static void put_pixels(struct sprite *s, const char *name)
{
    buffer_print(&s->text, "static const uint8_t %s_pixels[%zu] = {", name, s->pixels.size);
    for (size_t i = 0; i < s->pixels.size; i++)
        buffer_print(&s->text, "%s0x%02x%s", i % 16 == 0 ? "\n    " : " ", s->pixels.data[i], i + 1 < s->pixels.size ? "," : "\n};\n\n");
    if (s->color_count == 0)
        return;
    const int size = s->format == SMEAR_IMAGE_PALETTE4 ? 16 : COLORS;
    buffer_print(&s->text, "static const uint32_t %s_palette[%d] = {", name, size);
    for (int i = 0; i < s->color_count; i++)
        buffer_print(&s->text, "%s0x%08" PRIx32 "u%s", i % 8 == 0 ? "\n    " : " ", s->color[i], i + 1 < s->color_count ? "," : "\n};\n\n");
}

static void put_header(struct sprite *s, const char *name, const char *from, const struct sprite_report *r)
{
    static const char *const formats[] = { "MASK1", "MASK4", "PALETTE4", "PALETTE8" };
    struct buffer *out = &s->text;
    buffer_print(out, "/* %s.h - ", name);
    buffer_comment(out, from);
    buffer_print(out, " for smear, written by smear convert: %d of %dx%d pixels, %zu bytes.\n * Include it in one source file. */\n",
                 r->cells, r->width, r->height, r->bytes);
    buffer_print(out, "#include <smear_overlay.h>\n\n");
    put_pixels(s, name);
    buffer_print(out, "static const %s %s = {\n    ", s->options->font ? "smear_font" : "smear_image", name);
    buffer_print(out, "%s%s_pixels, ", s->options->font ? "{ " : "", name);
    if (s->color_count != 0)
        buffer_print(out, "%s_palette", name);
    else
        buffer_print(out, "(const uint32_t *)0");
    buffer_print(out, ", %d, %d, %d, SMEAR_IMAGE_%s", s->width, s->height, s->cells, formats[s->format]);
    if (s->options->font)
        buffer_print(out, " }, %d, 0", s->options->first);
    buffer_print(out, "\n};\n");
}

bool sprite_to_header(const struct image *image, const struct sprite_options *options, const char *name, const char *from,
                      uint8_t **bytes, size_t *size, struct sprite_report *report, struct failure *f)
{
    static const char *const formats[] = { "1-bit mask", "4-bit mask", "16 colours", "256 colours" };
    struct sprite s = { .image = image, .options = options, .width = options->cell_width, .height = options->cell_height };
    if (s.width == 0) {
        s.width = image->width;
        s.height = image->height;
    }
    if (image->width % s.width != 0 || image->height % s.height != 0)
        return fail(f, "%dx%d pixels cannot be cut into cells of %dx%d (--cell)", image->width, image->height, s.width, s.height);
    s.cells = image->width / s.width * (image->height / s.height);
    if (s.width > 2048 || s.height > 2048 || s.cells > 65535)
        return fail(f, "%d cells of %dx%d pixels: at most 65535 of 2048x2048", s.cells, s.width, s.height);
    const bool by_alpha = !is_opaque(image);
    if (!(options->mask || options->font ? find_mask_format(&s, by_alpha) : find_palette(&s, f)))
        return false;
    pack(&s, by_alpha);
    const size_t palette = s.color_count == 0 ? 0 : s.format == SMEAR_IMAGE_PALETTE4 ? 64 : 1024;
    *report = (struct sprite_report){ s.width, s.height, s.cells, formats[s.format], s.pixels.size + palette };
    s.text.failed = s.pixels.failed;
    if (!s.pixels.failed)
        put_header(&s, name, from, report);
    buffer_free(&s.pixels);
    return buffer_give(&s.text, bytes, size) || fail(f, "out of memory");
}
