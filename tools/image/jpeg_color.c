/* SPDX-License-Identifier: MIT */
/* jpeg_color.c - samples of components to pixels: those of which there are fewer are spread over the picture, and
 * brightness and colour differences become red, green and blue.
 *
 * Both are open to readers, too, and done as libjpeg does by default: a component of half the columns or half the rows is
 * interpolated (3/4 of the nearer sample, 1/4 of the farther), any other is repeated. */
#include "tools/image/jpeg.h"

#include <stdlib.h>
#include <string.h>

/* Row y of the picture takes its samples from `near` and, a quarter, from `far`; they are the same without interpolation. */
struct rows {
    const uint8_t *near, *far;
};

static const uint8_t *row_of(const struct jpeg_component *c, int y)
{
    y = y < 0 ? 0 : y < c->height ? y : c->height - 1;
    return c->sample + (size_t)y * (size_t)c->stride * 8;
}

static bool has_half_columns(const struct jpeg *j, const struct jpeg_component *c)
{
    return c->h * 2 == j->h && c->width > 2;
}

static bool has_half_rows(const struct jpeg *j, const struct jpeg_component *c)
{
    return c->v * 2 == j->v && (c->h == j->h || has_half_columns(j, c));
}

/* A sample of the component to each of two pixels beside it: 3/4 of it and 1/4 of its neighbour on that side. Ties are
 * rounded up at one side, down at the other. */
static void spread_columns(const uint8_t *in, int count, uint8_t *out)
{
    for (int i = 0; i < count; i++, out += 2) {
        const int here = in[i] * 3;
        out[0] = (uint8_t)(i > 0 ? (here + in[i - 1] + 1) >> 2 : in[i]);
        out[1] = (uint8_t)(i < count - 1 ? (here + in[i + 1] + 2) >> 2 : in[i]);
    }
}

static void spread_rows(const struct rows *r, int count, int bias, uint8_t *out)
{
    for (int i = 0; i < count; i++)
        out[i] = (uint8_t)((r->near[i] * 3 + r->far[i] + bias) >> 2);
}

/* Rounded once, in sixteenths. */
static void spread_both(const struct rows *r, int count, uint8_t *out)
{
    int before, here = r->near[0] * 3 + r->far[0], after = here;
    for (int i = 0; i < count; i++, out += 2) {
        before = i > 0 ? here : after;
        here = after;
        after = i < count - 1 ? r->near[i + 1] * 3 + r->far[i + 1] : here;
        out[0] = (uint8_t)((here * 3 + before + 8) >> 4);
        out[1] = (uint8_t)((here * 3 + after + 7) >> 4);
    }
}

/* The sample in which the middle of each pixel lies. */
static void repeat(const uint8_t *in, int width, int h, int h_most, uint8_t *out)
{
    for (int x = 0, part = h; x < width; x++, part += 2 * h) {
        if (part >= 2 * h_most) {
            part -= 2 * h_most;
            in++;
        }
        out[x] = *in;
    }
}

/* Row y of the component, as wide as the picture; what lies behind `out` has room for a sample more. */
static const uint8_t *spread(const struct jpeg *j, const struct jpeg_component *c, int y, uint8_t *out)
{
    const int at = (2 * y + 1) * c->v / (2 * j->v);
    const bool half_columns = has_half_columns(j, c), half_rows = has_half_rows(j, c);
    const struct rows rows = { row_of(c, at), row_of(c, y % 2 == 0 ? at - 1 : at + 1) };
    if (half_rows && half_columns)
        spread_both(&rows, c->width, out);
    else if (half_rows)
        spread_rows(&rows, c->width, y % 2 == 0 ? 1 : 2, out);
    else if (half_columns && c->v == j->v)
        spread_columns(rows.near, c->width, out);
    else if (c->h == j->h)
        return rows.near;
    else
        repeat(rows.near, j->width, c->h, j->h, out);
    return out;
}

static uint8_t to_8_bits(int32_t value)
{
    return (uint8_t)(value < 0 ? 0 : value > 255 ? 255 : value);
}

/* JFIF's colours, in 16 bits behind the point. */
static void convert_row(const uint8_t *luma, const uint8_t *blue, const uint8_t *red, int width, uint8_t *rgba)
{
    enum { HALF = 1 << 15 };
    for (int x = 0; x < width; x++, rgba += 4) {
        const int32_t y = luma[x], cb = blue[x] - 128, cr = red[x] - 128;
        rgba[0] = to_8_bits(y + ((91881 * cr + HALF) >> 16));
        rgba[1] = to_8_bits(y + ((-22554 * cb - 46802 * cr + HALF) >> 16));
        rgba[2] = to_8_bits(y + ((116130 * cb + HALF) >> 16));
    }
}

static void copy_row(const uint8_t *red, const uint8_t *green, const uint8_t *blue, int width, uint8_t *rgba)
{
    for (int x = 0; x < width; x++, rgba += 4) {
        rgba[0] = red[x];
        rgba[1] = green[x];
        rgba[2] = blue[x];
    }
}

/* Three components are brightness and colour differences unless Adobe's marker or their names say otherwise. */
static bool is_rgb(const struct jpeg *j)
{
    const struct jpeg_component *c = j->component;
    if (j->component_count == 1)
        return true;            /* grey is red, green and blue at once */
    if (j->has_jfif)
        return false;
    if (j->has_adobe)
        return j->transform == 0;
    return c[0].id == 'R' && c[1].id == 'G' && c[2].id == 'B';
}

bool jpeg_make_pixels(const struct jpeg *j, struct image *out, struct failure *f)
{
    const size_t room = (size_t)j->width + 2;
    uint8_t *spare = malloc(room * JPEG_COMPONENTS);
    if (spare == NULL)
        return fail(f, "out of memory (rows of %d pixels)", j->width);
    if (!image_alloc(out, j->width, j->height, f)) {
        free(spare);
        return false;
    }
    const bool rgb = is_rgb(j);
    for (int y = 0; y < j->height; y++) {
        const uint8_t *row[JPEG_COMPONENTS];
        for (int i = 0; i < j->component_count; i++)
            row[i] = spread(j, &j->component[i], y, spare + (size_t)i * room);
        for (int i = j->component_count; i < JPEG_COMPONENTS; i++)
            row[i] = row[0];
        (rgb ? copy_row : convert_row)(row[0], row[1], row[2], j->width, out->rgba + (size_t)y * (size_t)j->width * 4);
    }
    free(spare);
    return true;
}

/* ------------------------------------------------------------------ the inverse transform */

/* Blocks of 8 x 8 coefficients to samples, in integers of 32 bits. JPEG leaves the rounding of the transform open. It is that of
 * libjpeg's accurate integer one here, so that pictures are the same: cosines in 13 bits, columns rounded to 2 bits below a sample, rows
 * to whole samples. */

enum { COSINE_BITS = 13, COLUMN_BITS = 2 };

/* Where each coefficient lies in its block: 8 * row + column. */
static const uint8_t zigzag[64] = {
    0, 1, 8, 16, 9, 2, 3, 10, 17, 24, 32, 25, 18, 11, 4, 5, 12, 19, 26, 33, 40, 48, 41, 34, 27, 20, 13, 6, 7, 14, 21, 28,
    35, 42, 49, 56, 57, 50, 43, 36, 29, 22, 15, 23, 30, 37, 44, 51, 58, 59, 52, 45, 38, 31, 39, 46, 53, 60, 61, 54, 47, 55, 62, 63,
};

/* No picture needs more than 16 bits of a coefficient or of a column; with them no sum below exceeds 32. */
static int32_t to_16_bits(int32_t value)
{
    return value < -32768 ? -32768 : value > 32767 ? 32767 : value;
}

/* Eight frequencies to eight samples, times 2^COSINE_BITS. The numbers are sqrt(2) cos(k pi / 16); some are off by one in
 * the last place, as they are there, where they are sums of rounded ones. */
static void transform(const int32_t in[8], int32_t out[8])
{
    const int32_t sum = (in[0] + in[4]) * (1 << COSINE_BITS), difference = (in[0] - in[4]) * (1 << COSINE_BITS);
    const int32_t near = in[2] * 10703 + in[6] * 4433, far = in[2] * 4433 - in[6] * 10704;
    const int32_t even[4] = { sum + near, difference + far, difference - far, sum - near };
    const int32_t odd[4] = {
        in[1] * 11363 + in[3] * 9633 + in[5] * 6437 + in[7] * 2260,
        in[1] * 9633 - in[3] * 2259 - in[5] * 11362 - in[7] * 6436,
        in[1] * 6437 - in[3] * 11362 + in[5] * 2261 + in[7] * 9633,
        in[1] * 2260 - in[3] * 6436 + in[5] * 9633 - in[7] * 11363,
    };
    for (int i = 0; i < 4; i++) {
        out[i] = even[i] + odd[i];
        out[7 - i] = even[i] - odd[i];
    }
}

void jpeg_make_samples(const int16_t coefficient[64], const uint16_t quantum[64], uint8_t *to, size_t stride)
{
    enum { COLUMN_SHIFT = COSINE_BITS - COLUMN_BITS, ROW_SHIFT = COSINE_BITS + COLUMN_BITS + 3 };
    int32_t column[8][8] = { { 0 } }, row[8][8], out[8];
    for (int i = 0; i < 64; i++)
        if (coefficient[i] != 0)
            column[zigzag[i] & 7][zigzag[i] >> 3] = to_16_bits(coefficient[i] * quantum[i]);
    for (int x = 0; x < 8; x++) {
        transform(column[x], out);
        for (int y = 0; y < 8; y++)
            row[y][x] = to_16_bits((out[y] + (1 << (COLUMN_SHIFT - 1))) >> COLUMN_SHIFT);
    }
    for (int y = 0; y < 8; y++, to += stride) {
        transform(row[y], out);
        for (int x = 0; x < 8; x++) {
            const int32_t sample = ((out[x] + (1 << (ROW_SHIFT - 1))) >> ROW_SHIFT) + 128;
            to[x] = (uint8_t)(sample < 0 ? 0 : sample > 255 ? 255 : sample);
        }
    }
}
