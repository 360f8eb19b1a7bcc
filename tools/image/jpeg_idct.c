/* SPDX-License-Identifier: MIT */
/* jpeg_idct.c - blocks of 8 x 8 coefficients to samples, in integers of 32 bits.
 *
 * JPEG leaves the rounding of the transform open. It is that of libjpeg's accurate integer one here, so that pictures
 * are the same: cosines in 13 bits, columns rounded to 2 bits below a sample, rows to whole samples. */
#include "tools/image/jpeg.h"

#include <string.h>

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
