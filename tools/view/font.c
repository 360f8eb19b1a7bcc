/* SPDX-License-Identifier: MIT */
/* font.c - see font.h. The letters are those that the library lays over frames. */
#include "tools/view/font.h"

#include <smear_overlay.h>
#include <string.h>

static bool is_set(char c, int x, int y)
{
    const smear_image *glyph = &smear_font_6x8.glyph;
    const int cell = (unsigned char)c - smear_font_6x8.first;
    return cell >= 0 && cell < glyph->cells && y >= 1 && glyph->pixels[cell * glyph->height + y - 1] >> (7 - x) & 1;
}

static void put(const struct surface *s, int x, int y, bool lit)
{
    if (x < 0 || y < 0 || x >= s->width || y >= s->height)
        return;
    uint32_t *p = &s->pixel[(size_t)y * s->pitch + (size_t)x];
    *p = lit ? 0xffffffu : *p >> 2 & 0x3f3f3fu;
}

void font_draw(const struct surface *s, int x, int y, int zoom, const char *text)
{
    int columns = (int)strlen(text) * FONT_WIDTH;
    for (int v = 0; v < FONT_HEIGHT * zoom; v++)
        for (int u = -zoom; u < columns * zoom; u++) {
            int column = u >= 0 ? u / zoom : 0;
            bool lit = u >= 0 && is_set(text[column / FONT_WIDTH], column % FONT_WIDTH, v / zoom);
            put(s, x + u, y + v, lit);
        }
}
