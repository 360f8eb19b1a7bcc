/* SPDX-License-Identifier: MIT */
/* panel.c - see panel.h. */
#include "tools/view/panel.h"

#include "tools/player/picture.h"

#include <stdlib.h>
#include <string.h>

enum { MAX_ZOOM = 8 };

#define BEZEL 0x202224u

/* ------------------------------------------------------------------ codes */

static uint32_t code_of(const uint8_t rgba[4])
{
    return (uint32_t)rgba[0] << 16 | (uint32_t)rgba[1] << 8 | rgba[2];
}

static bool is_word_format(smear_format format)
{
    return format == SMEAR_RGB565 || format == SMEAR_RGB565_SWAPPED || format == SMEAR_RGB555;
}

/* What picture_expand makes of every word, so that there is one rule. */
bool panel_codes_open(struct panel_codes *codes, smear_format format, struct failure *f)
{
    enum { WORDS = 65536, EDGE = 256 };
    struct image all = { 0 };
    *codes = (struct panel_codes){ .format = format };
    if (!is_word_format(format))
        return true;
    uint8_t *bytes = malloc((size_t)WORDS * 2);
    codes->of_word = malloc((size_t)WORDS * sizeof *codes->of_word);
    bool ok = bytes != NULL && codes->of_word != NULL && image_alloc(&all, EDGE, EDGE, f);
    for (uint32_t i = 0; i < WORDS && ok; i++)
        memcpy(bytes + 2 * i, &(uint16_t){ (uint16_t)i }, 2);
    if (ok)
        picture_expand(&all, bytes, (size_t)EDGE * 2, format);
    for (uint32_t i = 0; i < WORDS && ok; i++)
        codes->of_word[i] = code_of(all.rgba + (size_t)i * 4);
    free(bytes);
    image_free(&all);
    return ok || fail(f, "out of memory");
}

void panel_codes_close(struct panel_codes *codes)
{
    free(codes->of_word);
    codes->of_word = NULL;
}

bool panel_decode(const struct panel_codes *codes, const uint8_t *pixels, size_t stride, int width,
                  int height, uint32_t *out, struct failure *f)
{
    if (codes->format == SMEAR_XRGB8888) {
        for (int y = 0; y < height; y++)
            memcpy(out + (size_t)y * (size_t)width, pixels + (size_t)y * stride, (size_t)width * 4);
        return true;
    }
    if (codes->of_word != NULL) {
        for (int y = 0; y < height; y++, out += width) {
            const uint8_t *row = pixels + (size_t)y * stride;
            for (int x = 0; x < width; x++) {
                uint16_t word;
                memcpy(&word, row + 2 * x, 2);
                out[x] = codes->of_word[word];
            }
        }
        return true;
    }
    struct image picture;
    if (!image_alloc(&picture, width, height, f))
        return false;
    picture_expand(&picture, pixels, stride, codes->format);
    for (size_t i = 0; i < (size_t)width * (size_t)height; i++)
        out[i] = code_of(picture.rgba + 4 * i);
    image_free(&picture);
    return true;
}

/* ------------------------------------------------------------------ place */

static int min_int(int a, int b)
{
    return a < b ? a : b;
}

struct panel_place panel_place_on(const struct panel_look *look, int width, int height,
                                  const struct surface *s)
{
    int w = look->turns & 1 ? height : width, h = look->turns & 1 ? width : height;
    int fits = min_int(s->width / w, s->height / h);
    struct panel_place place = { .zoom = look->zoom > 0 ? look->zoom : min_int(fits, MAX_ZOOM) };
    if (place.zoom > 0) {
        place.width = w * place.zoom;
        place.height = h * place.zoom;
    } else if ((int64_t)s->width * h < (int64_t)s->height * w) {
        place.width = s->width;
        place.height = (int)((int64_t)s->width * h / w);
    } else {
        place.height = s->height;
        place.width = (int)((int64_t)s->height * w / h);
    }
    place.width = place.width > 0 ? place.width : 1;
    place.height = place.height > 0 ? place.height : 1;
    place.x = (s->width - place.width) / 2;
    place.y = (s->height - place.height) / 2;
    return place;
}

/* From a pixel of the turned panel to one of the panel. */
static void unturn(int turns, int width, int height, int *x, int *y)
{
    int u = *x, v = *y;
    switch (turns & 3) {
    case 1: *x = v; *y = height - 1 - u; break;
    case 2: *x = width - 1 - u; *y = height - 1 - v; break;
    case 3: *x = width - 1 - v; *y = u; break;
    default: break;
    }
}

void panel_locate(const struct panel_look *look, const struct panel_place *place, int width,
                  int height, int surface_x, int surface_y, int *x, int *y)
{
    int w = look->turns & 1 ? height : width, h = look->turns & 1 ? width : height;
    *x = (int)((int64_t)(surface_x - place->x) * w / place->width);
    *y = (int)((int64_t)(surface_y - place->y) * h / place->height);
    unturn(look->turns, width, height, x, y);
}

/* ------------------------------------------------------------------ showing */

/* Pixels whose centre lies outside the inscribed ellipse are hidden by the glass. */
static bool is_hidden(int x, int y, int width, int height)
{
    double u = (2 * x + 1 - width) / (double)width, v = (2 * y + 1 - height) / (double)height;
    return u * u + v * v > 1.0;
}

static uint32_t mix(uint32_t dark, uint32_t lit, uint32_t code)
{
    uint32_t out = 0;
    for (int shift = 0; shift < 24; shift += 8) {
        uint32_t d = dark >> shift & 255, l = lit >> shift & 255;
        out |= (d * (255 - code) + l * code + 127) / 255 << shift;
    }
    return out;
}

static uint32_t seen(const struct panel_look *look, const uint32_t *codes, int width, int height,
                     int x, int y)
{
    if (look->round && is_hidden(x, y, width, height))
        return BEZEL;
    uint32_t code = codes[(size_t)y * (size_t)width + (size_t)x];
    return look->has_tint ? mix(look->dark, look->lit, code & 255) : code;
}

/* One row of the turned panel at zoom 1. */
static void turned_row(const struct panel_look *look, const uint32_t *codes, int width, int height,
                       int row, uint32_t *out)
{
    int w = look->turns & 1 ? height : width;
    for (int i = 0; i < w; i++) {
        int x = i, y = row;
        unturn(look->turns, width, height, &x, &y);
        out[i] = seen(look, codes, width, height, x, y);
    }
}

static void show_enlarged(const struct panel_look *look, const struct panel_place *place,
                          const uint32_t *codes, int width, int height, const struct surface *s)
{
    int w = place->width / place->zoom, h = place->height / place->zoom;
    bool is_plain = look->turns == 0 && !look->round && !look->has_tint;
    uint32_t line[2 * 2048];                /* the library draws 2048 pixels, and may double them */
    for (int row = 0; row < h; row++) {
        int y = place->y + row * place->zoom, last = min_int(y + place->zoom, s->height);
        y = y > 0 ? y : 0;
        if (y >= last)
            continue;
        const uint32_t *from = codes + (size_t)row * (size_t)width;
        if (!is_plain) {
            turned_row(look, codes, width, height, row, line);
            from = line;
        }
        int x = place->x > 0 ? place->x : 0, end = min_int(place->x + place->width, s->width);
        uint32_t *to = s->pixel + (size_t)y * s->pitch;
        if (place->zoom == 1)
            memcpy(to + x, from + (x - place->x), (size_t)(end - x) * 4);
        else if (place->x >= 0 && place->x + place->width <= s->width)
            for (int i = 0; i < w; i++)
                for (int k = 0; k < place->zoom; k++)
                    to[x++] = from[i];
        else
            for (; x < end; x++)
                to[x] = from[(x - place->x) / place->zoom];
        size_t start = place->x > 0 ? (size_t)place->x : 0;
        for (int copy = y + 1; copy < last; copy++)
            memcpy(s->pixel + (size_t)copy * s->pitch + start, to + start,
                   ((size_t)end - start) * 4);
    }
}

/* The mean of the pixels under each pixel of the surface. */
static void show_shrunk(const struct panel_look *look, const struct panel_place *place,
                        const uint32_t *codes, int width, int height, const struct surface *s)
{
    int w = look->turns & 1 ? height : width, h = look->turns & 1 ? width : height;
    for (int v = 0; v < place->height; v++) {
        int y0 = v * h / place->height, y1 = (v + 1) * h / place->height;
        for (int u = 0; u < place->width; u++) {
            int x0 = u * w / place->width, x1 = (u + 1) * w / place->width;
            uint32_t sum[3] = { 0, 0, 0 }, count = 0;
            for (int y = y0; y < y1 || y == y0; y++) {
                for (int x = x0; x < x1 || x == x0; x++) {
                    int px = x, py = y;
                    unturn(look->turns, width, height, &px, &py);
                    uint32_t code = seen(look, codes, width, height, px, py);
                    sum[0] += code >> 16 & 255;
                    sum[1] += code >> 8 & 255;
                    sum[2] += code & 255;
                    count++;
                }
            }
            s->pixel[(size_t)(place->y + v) * s->pitch + (size_t)(place->x + u)] =
                sum[0] / count << 16 | sum[1] / count << 8 | sum[2] / count;
        }
    }
}

void panel_show(const struct panel_look *look, const struct panel_place *place,
                const uint32_t *codes, int width, int height, const struct surface *s)
{
    int below = place->y + place->height, right = place->x + place->width;
    surface_fill(s, 0, 0, s->width, place->y, BEZEL);
    surface_fill(s, 0, below, s->width, s->height - below, BEZEL);
    surface_fill(s, 0, place->y, place->x, place->height, BEZEL);
    surface_fill(s, right, place->y, s->width - right, place->height, BEZEL);
    if (place->zoom > 0)
        show_enlarged(look, place, codes, width, height, s);
    else
        show_shrunk(look, place, codes, width, height, s);
}
